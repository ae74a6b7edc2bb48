/* The faces of a tile as Warnock's subdivision needs them: a box and sides for the window tests, depth and light as planes over the
 * window. They are set up once a tile, in the free room, 88 bytes each: a face is looked at in many windows.
 *
 * Depth. A face's depth is affine over the pixels, z + x dx + y dy in Q16.16 with the rounding half, exact in integers; what the
 * z-buffer compares are the upper 16 bits, for polygons of more than three corners after clamping to the range of the corners.
 * Hence
 *     - over a window a plane is least and greatest at corner pixels, and so is the difference of two;
 *     - planes are evaluated in windows that the face does not fill: what they say there beyond the face's own range `low` ...
 * `high` counts for nothing, since no covered pixel has it;
 *     - a plane steeper than 2^31 (32768 steps a pixel) belongs to a sliver seen from its edge: its range decides alone. So |z|
 * stays below 2^31 * 2^12 in windows, and 64 bits suffice.
 */
#ifndef TUILE_VISIBILITY_WARNOCK_FACE_H
#define TUILE_VISIBILITY_WARNOCK_FACE_H

#include "../frame/frame.h"
#include "window.h"

typedef struct warnock_face {
    window_t box;       /* of pixels that it may cover */
    uint32_t low, high; /* its depth at a pixel that it covers is never beyond, Q16.16 */
    int64_t z;          /* at the centre of pixel (0, 0); modulo 2^32 when steep */
    int32_t dx, dy;     /* modulo 2^32 when steep */
    light_plane_t light;
    uint32_t value; /* flat: colour; ids: id; gouraud: material, but of polygons the colour */
    uint16_t record;
    bool is_triangle, is_steep;
    window_side_t sides[3]; /* of a triangle */
} warnock_face_t;
_Static_assert(sizeof(warnock_face_t) <= 88, "the memory stated above and in warnock.c");

/* False when the face covers nothing. box: of the face. */
bool warnock_face_start(tuile_t *t, warnock_face_t *face, uint32_t number, const window_t *box);

/* The bounding box of a record's face, in pixels. False when it misses the tile. */
TUILE_INLINE bool warnock_face_box(const tuile_t *t, const record_t *record, const window_t *tile, window_t *box) {
    if (TUILE_UNLIKELY(!frame_record_is_triangle(record))) {
        const polygon_ring_t ring = frame_record_ring(t, record);
        *box = window_of_ring(&ring);
        return !window_misses(tile, box);
    }
    const vertex_t *v0 = &t->vertices[record->v0], *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    const int32_t first = 16 * tile->left + 8, last = 16 * tile->right - 8, x0 = v0->x, x1 = v1->x, x2 = v2->x;
    if ((x0 <= first && x1 <= first && x2 <= first) || (x0 > last && x1 > last && x2 > last)) { return false; }
    const int32_t left = x1 < x2 ? x1 : x2, right = x1 > x2 ? x1 : x2;
    *box = (window_t){(int16_t)edge_row(x0 < left ? x0 : left), (int16_t)edge_row(v0->y),
                      (int16_t)edge_row(x0 > right ? x0 : right), (int16_t)edge_row(v1->y > v2->y ? v1->y : v2->y)};
    return true; /* the record is in this row of tiles */
}

uint16_t warnock_face_polygon_depth(const tuile_t *t, const warnock_face_t *face, int32_t x, int32_t y);

/* The depth that the z-buffer would compare at a pixel that the face covers. */
TUILE_INLINE uint16_t warnock_face_depth(const tuile_t *t, const warnock_face_t *face, int32_t x, int32_t y) {
    if (TUILE_UNLIKELY(!face->is_triangle)) { return warnock_face_polygon_depth(t, face, x, y); }
    return (uint16_t)(((uint32_t)face->z + (uint32_t)face->dx * (uint32_t)x + (uint32_t)face->dy * (uint32_t)y) >> 16);
}

/* Does `a` hide `b` at all pixels of the window that both cover? Never true when it does not; may be false when it does.
 * first: a wins at equal depth. */
bool warnock_face_hides(const warnock_face_t *a, const warnock_face_t *b, const window_t *window, bool first);

/* The least depth of a face over the corner pixels of a window that it fills. */
TUILE_INLINE uint32_t warnock_face_least(const warnock_face_t *face, const window_t *window) {
    if (TUILE_UNLIKELY(face->is_steep)) { return face->low; }
    const int64_t across = (int64_t)face->dx * (window->right - 1 - window->left),
                  down = (int64_t)face->dy * (window->bottom - 1 - window->top);
    const int64_t z = face->z + (int64_t)face->dx * window->left + (int64_t)face->dy * window->top + (across < 0 ? across : 0) +
                      (down < 0 ? down : 0);
    return z < face->low ? face->low : z > face->high ? face->high : (uint32_t)z;
}

/* T1 to T4. A box that is the window itself says nothing: the face may fill it. brief: a face that is smaller than the window both
 * ways cannot fill it; whether it misses the window all the same is left to the window's parts. */
TUILE_INLINE window_relation_t warnock_face_relation(const tuile_t *t, const warnock_face_t *face, const window_t *window,
                                                     bool brief) {
    const window_t *box = &face->box;
    if (window_misses(window, box)) { return WINDOW_DISJOINT; }
    if (brief) {
        if (box->right - box->left < window->right - window->left && box->bottom - box->top < window->bottom - window->top) {
            return WINDOW_INTERSECTING;
        }
    } else if (window_holds(window, box) && !window_holds(box, window)) {
        return WINDOW_INTERSECTING;
    }
    if (TUILE_LIKELY(face->is_triangle)) { return window_triangle(face->sides, window); }
    const polygon_ring_t ring = frame_record_ring(t, frame_record(t, face->record));
    return window_ring(&ring, window);
}

/* The pixels of a window that the face covers, as bits. */
TUILE_INLINE uint32_t warnock_face_mask(const tuile_t *t, const warnock_face_t *face, const window_t *window) {
    if (TUILE_LIKELY(face->is_triangle)) { return window_mask_triangle(face->sides, &face->box, window); }
    const polygon_ring_t ring = frame_record_ring(t, frame_record(t, face->record));
    return window_mask_ring(&ring, window);
}

/* The face into the pixels of a window that are told by bits. */
void warnock_face_bits(tuile_t *t, const warnock_face_t *face, const window_t *window, uint32_t bits);

/* The face into all pixels of a window, which it fills. */
void warnock_face_fill(tuile_t *t, const warnock_face_t *face, const window_t *window);

/* The face into those pixels of a window that it covers. */
void warnock_face_paint(tuile_t *t, const warnock_face_t *face, const window_t *window);

TUILE_INLINE uint32_t warnock_face_light(const warnock_face_t *face, int32_t x, int32_t y) {
    return face->light.light + face->light.dx * (uint32_t)x + face->light.dy * (uint32_t)y;
}

/* Where a pixel of the window lies in the tile. */
TUILE_INLINE size_t warnock_pixel_at(const tuile_t *t, int32_t x, int32_t y) {
    return (size_t)(y - t->tile.top) * (size_t)t->tile.stride_px + (size_t)(x - t->tile.left);
}

/* The face into one pixel. */
TUILE_INLINE void warnock_face_pixel(tuile_t *t, const warnock_face_t *face, int32_t x, int32_t y) {
    const size_t at = warnock_pixel_at(t, x, y);
    if (t->span_kind == SPAN_GOURAUD && face->is_triangle) {
        ((uint16_t *)t->tile.colour)[at] = frame_ramp(t, face->value)[warnock_face_light(face, x, y) >> 26];
    } else if (t->span_kind == SPAN_IDS) {
        ((uint32_t *)t->tile.colour)[at] = face->value;
    } else {
        ((uint16_t *)t->tile.colour)[at] = (uint16_t)face->value;
    }
}

#endif
