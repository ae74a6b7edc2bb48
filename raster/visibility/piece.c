#include "piece.h"

#include "../memory.h"

polygon_ring_t piece_ring(const tuile_t *t, const record_t *face, uint8_t list[3]) {
    if (!frame_record_is_triangle(face)) { return frame_record_ring(t, face); }
    const int low = face->d1 < face->d2 ? (face->d1 < 0 ? face->d1 : 0) : (face->d2 < 0 ? face->d2 : 0);
    list[0] = (uint8_t)-low;
    list[1] = (uint8_t)(face->d1 - low);
    list[2] = (uint8_t)(face->d2 - low);
    return (polygon_ring_t){&t->vertices[face->v0] + low, list, NULL, 3};
}

/* ---- one face against another ---- */

#define STEEP ((int64_t)1 << 33) /* a gradient of 2^17 steps a pixel: the face is seen from its edge */
#define ONE_STEP ((int64_t)1 << 16)

static int64_t absolute(int64_t a) { return a < 0 ? -a : a; }

/* The value of an affine function at a point in sixteenths of a pixel, of one that is known at pixels. |dx|, |dy| <= 2 STEEP. */
static int64_t value_at(int64_t z, int64_t dx, int64_t dy, int32_t x, int32_t y) {
    return z + ((dx * (x - 8) + dy * (y - 8)) >> 4);
}

/* By how much the corners of a polygon are off its plane, and so the depths of its pixels from being affine. */
static int64_t deviation(const polygon_ring_t *ring, const depth_plane_t *plane) {
    int64_t most = 0;
    for (uint32_t i = 0; i < ring->count; i++) {
        const vertex_t *v = polygon_ring_vertex(ring, i);
        const int64_t depth = ((int64_t)(v->depth_light >> 8) << 8) + 0x8000;
        const int64_t off = absolute(depth - value_at(plane->z, plane->dx, plane->dy, v->x, v->y));
        most = off > most ? off : most;
    }
    return most;
}

/* The plane that a z-buffer follows, and by how much depths may be off it; -1: no plane. */
static int64_t face_plane(const tuile_t *t, const record_t *face, depth_plane_t *plane) {
    if (frame_record_is_triangle(face)) {
        const vertex_t *v0 = &t->vertices[face->v0];
        triangle_planes(v0, v0 + face->d1, v0 + face->d2, plane, NULL);
        return 0;
    }
    const polygon_ring_t ring = frame_record_ring(t, face);
    return polygon_plane(&ring, plane) ? deviation(&ring, plane) : -1;
}

bool duel_open(duel_t *duel, const tuile_t *t, const record_t *a, const record_t *b, bool wins_tie) {
    const int64_t off_a = face_plane(t, a, &duel->a), off_b = face_plane(t, b, &duel->b);
    duel->wins_tie = wins_tie;
    duel->z = duel->dx = duel->dy = 0;
    duel->band = INT64_MAX;
    if (off_a < 0 || off_b < 0) { return false; }
    if (absolute(duel->a.dx) <= STEEP && absolute(duel->a.dy) <= STEEP && absolute(duel->b.dx) <= STEEP &&
        absolute(duel->b.dy) <= STEEP) {
        duel->z = duel->a.z - duel->b.z;
        duel->dx = duel->a.dx - duel->b.dx;
        duel->dy = duel->a.dy - duel->b.dy;
        duel->band = 2 * ONE_STEP + off_a + off_b;
    }
    return true;
}

/* ---- which pixels ---- */

void piece_mask(const tuile_t *t, const record_t *record, int32_t y, int32_t from, int32_t to, uint32_t mask[PIECE_MASK_WORDS]) {
    const piece_slot_t *piece = frame_record_piece(t, record);
    const record_t face = frame_record_face(t, record);
    const int32_t count = to - from;
    const bool row = y >= piece->bounds.top && y < piece->bounds.bottom;
    memset(mask, 0, (size_t)((count + 31) >> 5) * sizeof *mask);
    for (int32_t i = 0; i < count; i++) {
        if (row && from + i >= piece->bounds.left && from + i < piece->bounds.right) { mask[i >> 5] |= 1u << (i & 31); }
    }
    for (uint16_t at = piece->cuts; at && row;) {
        const cut_slot_t *cut = (const cut_slot_t *)(const void *)&t->vertices[at];
        const record_t other = {.v0 = cut->v0, .d1 = cut->d1, .d2 = cut->d2};
        duel_t duel;
        (void)duel_open(&duel, t, &face, &other, cut->wins_tie);
        for (int32_t i = 0; i < count; i++) {
            if (piece_mask_bit(mask, i) && duel_front(&duel, from + i, y) != cut->front) { mask[i >> 5] &= ~(1u << (i & 31)); }
        }
        at = cut->next;
    }
}

/* ---- cutting ---- */

/* What to keep of a ring: where  z + x dx + y dy >= 0,  Q.8 at a point in sixteenths of a pixel. |value| < 2^42. */
typedef struct side {
    int64_t z, dx, dy; /* Q.16, as of a plane, but with z - 8 dx / 16 - 8 dy / 16 taken in */
    bool whole;        /* keep all */
} side_t;

static int64_t side_value(const side_t *side, const vertex_t *v) {
    return side->whole ? 1 : (side->z + ((side->dx * v->x + side->dy * v->y) >> 4)) >> 8;
}

/* The least and greatest pixel bounds that the ring, one unit wider, allows. */
static void bounds_shrink(face_bounds_t *bounds, const vertex_t *ring, uint32_t count) {
    int32_t left = INT32_MAX, right = INT32_MIN, top = INT32_MAX, bottom = INT32_MIN;
    for (uint32_t i = 0; i < count; i++) {
        left = ring[i].x < left ? ring[i].x : left;
        right = ring[i].x > right ? ring[i].x : right;
        top = ring[i].y < top ? ring[i].y : top;
        bottom = ring[i].y > bottom ? ring[i].y : bottom;
    }
    if (count == 0) {
        bounds->left = bounds->right = bounds->top = bounds->bottom = 0;
        return;
    }
    left = edge_row(left - 1), right = edge_row(right + 1), top = edge_row(top - 1), bottom = edge_row(bottom + 1);
    bounds->left = (int16_t)(left > bounds->left ? left : bounds->left);
    bounds->right = (int16_t)(right < bounds->right ? right : bounds->right);
    bounds->top = (int16_t)(top > bounds->top ? top : bounds->top);
    bounds->bottom = (int16_t)(bottom < bounds->bottom ? bottom : bounds->bottom);
    if (bounds->left >= bounds->right || bounds->top >= bounds->bottom) {
        bounds->left = bounds->right = bounds->top = bounds->bottom = 0;
    }
}

/* The point of side a b where the value, positive at a and negative at b, is 0; depth from the plane. */
static vertex_t crossing(const vertex_t *a, int64_t value_a, const vertex_t *b, int64_t value_b, const depth_plane_t *plane) {
    const int64_t whole = value_a - value_b; /* < 2^43; differences of coordinates < 2^16 */
    const int64_t half = whole / 2;
    vertex_t v;
    v.x = (int16_t)(a->x + fixed_floor_div64((b->x - a->x) * value_a + half, whole));
    v.y = (int16_t)(a->y + fixed_floor_div64((b->y - a->y) * value_a + half, whole));
    int64_t depth = value_at(plane->z - 0x8000, plane->dx, plane->dy, v.x, v.y) >> 8;
    depth = depth < 0 ? 0 : depth > 0xffffff ? 0xffffff : depth;
    v.depth_light = (uint32_t)depth << 8;
    return v;
}

typedef struct source {
    polygon_ring_t ring;
    uint8_t list[3];
    record_t face;
    face_bounds_t bounds;
    uint16_t number, cuts;
    depth_plane_t plane; /* of the face; wanted where `whole` is not set */
} source_t;

static void source_open(source_t *source, const tuile_t *t, const record_t *record, const face_bounds_t *bounds, uint16_t number) {
    source->face = frame_record_face(t, record);
    source->bounds = *bounds;
    source->number = number;
    source->cuts = 0;
    if (frame_record_is_piece(record)) {
        const piece_slot_t *piece = frame_record_piece(t, record);
        source->ring = (polygon_ring_t){(const vertex_t *)(piece + 1), NULL, NULL, piece->count};
        source->number = piece->number;
        source->cuts = piece->cuts;
    } else {
        source->ring = piece_ring(t, &source->face, source->list);
    }
}

/* The next slots, NULL when there are not so many. */
static void *take(tuile_t *t, uint32_t slots, const uint8_t *end) {
    uint8_t *at = (uint8_t *)(t->vertices + t->vertex_count);
    if (at + slots * sizeof(vertex_t) > end || t->vertex_count + slots > t->vertex_limit) { return NULL; }
    t->vertex_count += slots;
    return at;
}

/* A piece of the source into the record; cut: NULL, or the cut that makes it. */
static int piece_make(tuile_t *t, record_t *record, const source_t *source, const side_t *side, const cut_slot_t *cut,
                      const uint8_t *end) {
    uint16_t cuts = source->cuts;
    if (cut) {
        cut_slot_t *slot = take(t, 1, end);
        if (slot == NULL) { return FRAME_FULL; }
        *slot = *cut;
        slot->next = cuts;
        cuts = (uint16_t)((vertex_t *)(void *)slot - t->vertices);
    }
    piece_slot_t *piece = take(t, sizeof(piece_slot_t) / sizeof(vertex_t), end);
    if (piece == NULL) { return FRAME_FULL; }
    vertex_t *ring = (vertex_t *)(piece + 1);
    uint32_t count = 0;
    for (uint32_t i = 0; i < source->ring.count; i++) {
        const uint32_t j = i + 1 == source->ring.count ? 0 : i + 1;
        const vertex_t *a = polygon_ring_vertex(&source->ring, i), *b = polygon_ring_vertex(&source->ring, j);
        const int64_t value_a = side_value(side, a), value_b = side_value(side, b);
        if (value_a >= 0) {
            if (take(t, 1, end) == NULL) { return FRAME_FULL; }
            ring[count++] = *a;
        }
        if ((value_a > 0 && value_b < 0) || (value_a < 0 && value_b > 0)) {
            if (take(t, 1, end) == NULL) { return FRAME_FULL; }
            ring[count++] =
                value_a > 0 ? crossing(a, value_a, b, value_b, &source->plane) : crossing(b, value_b, a, value_a, &source->plane);
        }
    }
    *piece = (piece_slot_t){source->bounds, source->face.v0, source->face.d1, source->face.d2, source->number,
                            cuts,           (uint16_t)count, {0, 0, 0}};
    bounds_shrink(&piece->bounds, ring, count);
    record->v0 = (uint16_t)((vertex_t *)(void *)piece - t->vertices);
    record->d1 = 0;
    record->d2 = 1;
    return FRAME_OK;
}

/* The record of the second piece begins as a copy of the first one's. */
static record_t *copy_record(tuile_t *t, uint32_t number, uint32_t added) {
    record_t *record = frame_record(t, added);
    memcpy(record, frame_record(t, number), t->record_bytes);
    return record;
}

int piece_cut(tuile_t *t, uint32_t number, uint32_t added, const face_bounds_t *bounds, const record_t *other, uint16_t own_number,
              bool wins_tie, const uint8_t *end) {
    record_t *record = frame_record(t, number);
    source_t source;
    duel_t duel;
    source_open(&source, t, record, bounds, own_number);
    if (!duel_open(&duel, t, &source.face, other, wins_tie)) { return TUILE_ERROR_RANGE; } /* never: neither covers a pixel */
    source.plane = duel.a;
    /* Beyond the band, and the corners that are made move by one unit at most. */
    const int64_t wider = duel.band == INT64_MAX ? 0 : duel.band + ((absolute(duel.dx) + absolute(duel.dy)) >> 4) + 512;
    const int64_t z = duel.z - ((duel.dx + duel.dy) >> 1);
    const side_t behind = {wider - z, -duel.dx, -duel.dy, duel.band == INT64_MAX},
                 front = {wider + z, duel.dx, duel.dy, duel.band == INT64_MAX};
    cut_slot_t cut = {other->v0, other->d1, other->d2, 0, false, wins_tie};
    int result = piece_make(t, record, &source, &behind, &cut, end);
    if (result == FRAME_OK) {
        cut.front = true;
        result = piece_make(t, copy_record(t, number, added), &source, &front, &cut, end);
    }
    return result;
}

int piece_cut_at(tuile_t *t, uint32_t number, uint32_t added, const face_bounds_t *bounds, int axis, int32_t at,
                 uint16_t own_number, const uint8_t *end) {
    record_t *record = frame_record(t, number);
    source_t source;
    source_open(&source, t, record, bounds, own_number);
    const bool planar =
        face_plane(t, &source.face, &source.plane) >= 0 && absolute(source.plane.dx) <= STEEP && absolute(source.plane.dy) <= STEEP;
    const int64_t one = (int64_t)1 << 20, line = -(int64_t)at * (INT32_C(1) << 20);
    const side_t high = {line, axis ? 0 : one, axis ? one : 0, !planar}, low = {-line, axis ? 0 : -one, axis ? -one : 0, !planar};
    const face_bounds_t whole = *bounds;
    *(axis ? &source.bounds.bottom : &source.bounds.right) = (int16_t)at;
    int result = piece_make(t, record, &source, &low, NULL, end);
    if (result == FRAME_OK) {
        source.bounds = whole;
        *(axis ? &source.bounds.top : &source.bounds.left) = (int16_t)at;
        result = piece_make(t, copy_record(t, number, added), &source, &high, NULL, end);
    }
    return result;
}
