/* Sutherland-Hodgman (S5), plane after plane in one array, with the points and the order of geometry/clip.c. */
#include "inside.h"

#include "../geometry/model.h"

#define GUARD_CLIP 8
#define GUARD_SPAN INT32_C(32768)

enum { CLIP_NEAR, CLIP_FAR, CLIP_LEFT, CLIP_RIGHT, CLIP_TOP, CLIP_BOTTOM, CLIP_PLANES };

typedef struct corner {
    compact_place_t place;
    uint16_t original; /* vertex of the model where its point in the window is good, else NONE */
} corner_t;

#define NONE UINT16_MAX

/* coordinate * 2^k - bound * w: geometry/clip.c has the bounds. */
static int64_t beyond(const tuile_compact_view_t *view, int64_t coordinate, int64_t w, int32_t bound) {
    const int k = view->k;

    if (k <= 13) { return fixed_shift_left64(coordinate, (unsigned)k) - w * bound; }
    return fixed_shift_left64(coordinate, 13) - ((w * bound) >> (k - 13));
}

static bool is_inside(const tuile_compact_view_t *view, const compact_place_t *p, unsigned kind) {
    if (kind == CLIP_NEAR) { return p->w >= view->w_low; }
    if (kind == CLIP_FAR) { return p->w <= view->w_high; }
    const bool across = kind <= CLIP_RIGHT, low = kind == CLIP_LEFT || kind == CLIP_TOP;
    const int32_t bound = (across ? view->guard_x : view->guard_y) + (low ? GUARD_CLIP : GUARD_SPAN - GUARD_CLIP);
    const int64_t by = beyond(view, across ? p->x : p->y, p->w, bound);

    return low ? by >= 0 : by <= 0;
}

static bool corner_inside(const tuile_compact_view_t *view, const corner_t *corner, unsigned kind) {
    return corner->original != NONE || is_inside(view, &corner->place, kind);
}

static int64_t middle(int64_t a, int64_t b) { return (a + b) >> 1; }

/* Where the side from inner to outer meets the plane, from within. */
static void crossing(const tuile_compact_view_t *view, const corner_t *from, const corner_t *to, unsigned kind, corner_t *found) {
    compact_place_t inner = from->place, outer = to->place;

    for (uint8_t step = 0; step < 52; step++) {
        const compact_place_t half = {middle(inner.x, outer.x), middle(inner.y, outer.y), middle(inner.w, outer.w)};
        const bool done = (half.x == inner.x || half.x == outer.x) && (half.y == inner.y || half.y == outer.y) &&
                          (half.w == inner.w || half.w == outer.w);

        if (is_inside(view, &half, kind)) {
            inner = half;
        } else {
            outer = half;
        }
        if (done) { break; }
    }
    found->place = inner;
    found->original = NONE;
}

/* The corners inside of one plane, in place: they are first moved to the end of the array, so that what comes out does not overtake
 * what is still to be read. False: it would. */
static bool clip_plane(const tuile_compact_view_t *view, corner_t corners[COMPACT_RING], uint8_t *count, unsigned kind) {
    const uint8_t from = (uint8_t)(COMPACT_RING - *count);
    corner_t first, last = {.original = NONE};
    bool first_inside = false, last_inside = false;
    uint8_t out = 0;

    if (*count == 0) { return true; }
    for (uint8_t i = *count; i > 0; i--) {
        corners[from + i - 1] = corners[i - 1];
    }
    first = corners[from];
    for (uint8_t at = from; at < COMPACT_RING; at++) {
        const corner_t corner = corners[at];
        const bool inside = corner_inside(view, &corner, kind);

        if (at == from) {
            first_inside = inside;
        } else if (inside != last_inside) {
            if (out > at) { return false; }
            crossing(view, inside ? &corner : &last, inside ? &last : &corner, kind, &corners[out++]);
        }
        if (inside) {
            if (out > at) { return false; }
            corners[out++] = corner;
        }
        last = corner;
        last_inside = inside;
    }
    if (first_inside != last_inside) {
        if (out == COMPACT_RING) { return false; }
        crossing(view, first_inside ? &first : &last, first_inside ? &last : &first, kind, &corners[out++]);
    }
    *count = out;
    return true;
}

bool compact_clip(const tuile_compact_t *compact, const uint16_t *numbers, uint8_t count, compact_ring_t *ring) {
    const tuile_compact_view_t *view = &compact->view;
    corner_t corners[COMPACT_RING];
    unsigned crossed = 0; /* planes that some corner is outside of */

    for (uint8_t i = 0; i < count; i++) {
        int16_t q[3];
        int8_t f[3];
        const bool fractions = compact_position(compact, numbers[i], q, f);

        corners[i].place = compact_place(view, q, fractions ? f : NULL);
        corners[i].original = compact->points[numbers[i]].x == COMPACT_OUTSIDE ? NONE : numbers[i];
        for (unsigned kind = 0; kind < CLIP_PLANES; kind++) {
            if (!corner_inside(view, &corners[i], kind)) { crossed |= 1u << kind; }
        }
    }
    for (unsigned kind = 0; kind < CLIP_PLANES; kind++) {
        if ((crossed >> kind & 1u) && !clip_plane(view, corners, &count, kind)) { return false; }
    }
    ring->count = 0;
    for (uint8_t i = 0; i < count; i++) {
        const uint16_t number = corners[i].original;
        const uint8_t at = ring->count;

        if (number != NONE) {
            ring->point[at] = compact->points[number];
            ring->depth[at] = compact->depths ? compact->depths[number] : 0;
            ring->count++;
        } else if (compact_project(view, &corners[i].place, true, &ring->point[at], &ring->depth[at])) {
            ring->count++;
        }
    }
    return true;
}
