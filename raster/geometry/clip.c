/* Sutherland-Hodgman (S5) in homogeneous window coordinates, as a pipeline: each plane keeps only the first and the last vertex
 * that came by and hands its output to the next plane, so no polygon is ever stored, whatever its number of corners.
 *
 * Where a side meets a plane is found by halving: of a point inside and one outside the middle replaces the one on its side, until
 * they are neighbours in the integer grid. That takes 48 additions instead of a division of 96 by 48 bits, cannot overflow,
 * and ends on the inner side. The search always runs from the inner to the outer end, so that two faces that share an edge get
 * the same point, and a vertex that is inside keeps the window coordinates that it has in all its other faces: no cracks.
 */
#include "clip.h"

#define VALUES 10

typedef struct clip_point {
    int64_t x, y, w;       /* fine */
    int32_t light;         /* Q8.16 */
    int16_t original;      /* corner's index among the cluster's vertices where its window vertex is good, else -1 */
    int32_t value[VALUES]; /* attributes: s, t, then light and colour as Q8.16 */
} clip_point_t;

typedef struct clip_plane {
    clip_point_t first, last;
    bool first_inside, last_inside, any;
    uint8_t kind;
} clip_plane_t;

enum { CLIP_NEAR, CLIP_FAR, CLIP_LEFT, CLIP_RIGHT, CLIP_TOP, CLIP_BOTTOM, CLIP_PLANES };

typedef struct clip_state {
    const transform_t *transform;
    const vertex_t *vertices;
    vertex_t *out;
    clip_attributes_t *attributes;
    unsigned capacity, count, planes;
    bool overflow;
    clip_plane_t plane[CLIP_PLANES];
} clip_state_t;

/* coordinate * 2^k - bound * w, >= 0 on the greater side; perspective: |coordinate|, |w| <= 2^48, |bound| < 2^16. Where k is large,
 * both sides are cut to what fits: the coordinate is far outside then. */
static int64_t beyond(const transform_t *transform, int64_t coordinate, int64_t w, int32_t bound) {
    if (!transform->perspective) { return coordinate - fixed_shift_left64(bound, (unsigned)-transform->k); }
    const int k = transform->k;
    if (k <= 13) { return fixed_shift_left64(coordinate, (unsigned)k) - w * bound; }
    return fixed_shift_left64(coordinate, 13) - ((w * bound) >> (k - 13));
}

static bool is_inside(const transform_t *transform, const clip_point_t *p, unsigned kind) {
    if (p->original >= 0) { return true; }
    const int32_t low_x = transform->guard_x + GUARD_CLIP, low_y = transform->guard_y + GUARD_CLIP;
    const int32_t span = GUARD_SPAN - 2 * GUARD_CLIP;
    switch (kind) {
    case CLIP_NEAR: return p->w >= transform->w_low;
    case CLIP_FAR: return p->w <= transform->w_high;
    case CLIP_LEFT: return beyond(transform, p->x, p->w, low_x) >= 0;
    case CLIP_RIGHT: return beyond(transform, p->x, p->w, low_x + span) <= 0;
    case CLIP_TOP: return beyond(transform, p->y, p->w, low_y) >= 0;
    default: return beyond(transform, p->y, p->w, low_y + span) <= 0;
    }
}

static int64_t middle(int64_t a, int64_t b) { return (a + b) >> 1; }

/* The part of the way, as Q30, that the search below has found. */
typedef struct clip_way {
    int64_t low, high;
} clip_way_t;

static void crossing_values(clip_point_t *inner, const clip_point_t *from, const clip_point_t *to, int64_t way) {
    for (unsigned i = 0; i < VALUES; i++) {
        inner->value[i] = from->value[i] + (int32_t)(((int64_t)to->value[i] - from->value[i]) * way >> 30);
    }
}

static clip_point_t crossing(const clip_state_t *state, const clip_point_t *from, const clip_point_t *to, unsigned kind) {
    typedef struct place {
        int64_t x, y, w;
        int32_t light;
    } place_t;
    const transform_t *transform = state->transform;
    place_t inner = {from->x, from->y, from->w, from->light}, outer = {to->x, to->y, to->w, to->light};
    clip_way_t way = {0, (int64_t)1 << 60};
    for (int step = 0; step < 52; step++) {
        const place_t half = {middle(inner.x, outer.x), middle(inner.y, outer.y), middle(inner.w, outer.w),
                              (int32_t)middle(inner.light, outer.light)};
        const clip_point_t mid = {.x = half.x, .y = half.y, .w = half.w, .original = -1};
        const bool done = (mid.x == inner.x || mid.x == outer.x) && (mid.y == inner.y || mid.y == outer.y) &&
                          (mid.w == inner.w || mid.w == outer.w);
        const int64_t halfway = middle(way.low, way.high);
        if (is_inside(transform, &mid, kind)) {
            inner = half;
            way.low = halfway;
        } else {
            outer = half;
            way.high = halfway;
        }
        if (done) { break; }
    }
    clip_point_t found = {.x = inner.x, .y = inner.y, .w = inner.w, .light = inner.light, .original = -1};
    if (state->attributes) { crossing_values(&found, from, to, way.low >> 30); }
    return found;
}

static void output(clip_state_t *state, const clip_point_t *p) {
    if (state->count == state->capacity) {
        state->overflow = true;
        return;
    }
    if (state->attributes) {
        clip_attributes_t *to = &state->attributes[state->count];
        to->s = p->value[0];
        to->t = p->value[1];
        for (unsigned i = 0; i < 4; i++) {
            to->light[i] = (uint8_t)(p->value[2 + i] >> 16);
            to->colour[i] = (uint8_t)(p->value[6 + i] >> 16);
        }
    }
    if (p->original >= 0) {
        state->out[state->count++] = state->vertices[p->original];
    } else if (vertex_project(state->transform, p->x, p->y, p->w, (uint8_t)(p->light >> 16), true, &state->out[state->count])) {
        state->count++;
    }
}

/* Sends a point into plane `at` and what comes out of it on to the next ones. A plane turns one point into two at most, and
 * the pending ones are of different planes but for a pair, so the list holds CLIP_PLANES + 2. */
static void feed(clip_state_t *state, const clip_point_t *point, unsigned at) {
    struct {
        clip_point_t point;
        unsigned plane;
    } pending[CLIP_PLANES + 2];
    unsigned count = 0;

    pending[count].point = *point;
    pending[count++].plane = at;
    while (count) {
        count--;
        const clip_point_t p = pending[count].point;
        const unsigned k = pending[count].plane;
        if (k == state->planes) {
            output(state, &p);
            continue;
        }
        clip_plane_t *plane = &state->plane[k];
        const bool inside = is_inside(state->transform, &p, plane->kind);
        if (inside) { /* pushed first, so that the crossing before it leaves the list before it */
            pending[count].point = p;
            pending[count++].plane = k + 1;
        }
        if (plane->any && inside != plane->last_inside) {
            pending[count].point =
                inside ? crossing(state, &p, &plane->last, plane->kind) : crossing(state, &plane->last, &p, plane->kind);
            pending[count++].plane = k + 1;
        }
        if (!plane->any) {
            plane->first = p;
            plane->first_inside = inside;
            plane->any = true;
        }
        plane->last = p;
        plane->last_inside = inside;
    }
}

/* The side from the last vertex back to the first, plane by plane. */
static void close_planes(clip_state_t *state) {
    for (unsigned k = 0; k < state->planes; k++) {
        const clip_plane_t *plane = &state->plane[k];
        if (plane->any && plane->first_inside != plane->last_inside) {
            const clip_point_t p = plane->first_inside ? crossing(state, &plane->first, &plane->last, plane->kind)
                                                       : crossing(state, &plane->last, &plane->first, plane->kind);
            feed(state, &p, k + 1);
        }
    }
}

static clip_point_t corner_point(const transform_t *transform, const clip_face_t *face, unsigned i) {
    const unsigned corner = face->corners[i];
    const int16_t *q = face->positions + 3 * (size_t)corner;
    const int8_t *f = face->fractions ? face->fractions + 3 * (size_t)corner : NULL;
    const vertex_t *vertex = &face->vertices[corner];
    return (clip_point_t){.x = transform_finer(&transform->x, q, f),
                          .y = transform_finer(&transform->y, q, f),
                          .w = transform_finer(&transform->w, q, f),
                          .light = (int32_t)(vertex->depth_light & 0xff) << 16,
                          .original = (int16_t)(vertex->x == VERTEX_OUTSIDE ? -1 : (int)corner)};
}

static void corner_values(const clip_face_t *face, unsigned i, clip_point_t *p) {
    const size_t corner = face->corners[i];
    if (face->texcoords) {
        const uint8_t *at = face->texcoords + 4 * corner;
        p->value[0] = (int16_t)(at[0] | at[1] << 8) * 256;
        p->value[1] = (int16_t)(at[2] | at[3] << 8) * 256;
    }
    for (unsigned k = 0; k < 4; k++) {
        p->value[2 + k] = face->lights ? (int32_t)face->lights[4 * corner + k] << 16 : 0;
        p->value[6 + k] = (int32_t)(face->colours ? face->colours[4 * corner + k] : 255) << 16;
    }
}

int clip_polygon(const transform_t *transform, const clip_face_t *face, vertex_t *out, unsigned capacity) {
    clip_state_t state;
    unsigned crossed = 0; /* planes that some corner is outside of */

    state.transform = transform;
    state.vertices = face->vertices;
    state.out = out;
    state.capacity = capacity;
    state.count = 0;
    state.planes = 0;
    state.overflow = false;
    state.attributes = face->attributes;
    for (unsigned i = 0; i < face->count; i++) {
        const clip_point_t p = corner_point(transform, face, i);
        for (unsigned kind = 0; kind < CLIP_PLANES; kind++) {
            crossed |= (unsigned)!is_inside(transform, &p, kind) << kind;
        }
    }
    for (unsigned kind = 0; kind < CLIP_PLANES; kind++) {
        if (crossed & (1u << kind)) {
            state.plane[state.planes].kind = (uint8_t)kind;
            state.plane[state.planes].any = false;
            state.planes++;
        }
    }
    for (unsigned i = 0; i < face->count; i++) {
        clip_point_t p = corner_point(transform, face, i);
        if (face->attributes) { corner_values(face, i, &p); }
        feed(&state, &p, 0);
    }
    close_planes(&state);
    if (state.overflow) { return -1; }
    return state.count < 3 ? 0 : (int)state.count;
}
