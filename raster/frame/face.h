/* What the two ways from faces to records share: face.c, and face_plain.c for most faces. */
#ifndef TUILE_FRAME_FACE_H
#define TUILE_FRAME_FACE_H

#include "frame.h"

/* Twice the signed area in (1/16 px)^2, positive for counter-clockwise as seen (the window's y points down). Inside the guard
 * band differences are below 2^15, so the products are below 2^30. */
TUILE_INLINE int32_t signed_area(const vertex_t *a, const vertex_t *b, const vertex_t *c) {
    const int32_t x1 = b->x - a->x, y1 = b->y - a->y, x2 = c->x - a->x, y2 = c->y - a->y;
    return x2 * y1 - x1 * y2;
}

TUILE_INLINE int32_t least3(int32_t a, int32_t b, int32_t c) { return a < b ? (a < c ? a : c) : (b < c ? b : c); }
TUILE_INLINE int32_t most3(int32_t a, int32_t b, int32_t c) { return a > b ? (a > c ? a : c) : (b > c ? b : c); }

TUILE_INLINE uint8_t flat_light(const tuile_t *t, const int8_t *normal, bool back) {
    const int32_t sign = back ? -1 : 1;
    return vertex_light(&t->transform, sign * normal[0], sign * normal[1], sign * normal[2]);
}

/* What a larger record holds besides. id: of the face, less 1. */
TUILE_INLINE void face_extend(const tuile_t *t, record_t *record, uint32_t id) {
    if (t->numbers == NULL) {
        ((record_id_t *)(void *)record)->id = id + 1;
        return;
    }
    record_surface_t *surface = frame_record_surface(record);
    surface->source = t->source;
    surface->green = surface->blue = record->light;
    if (TUILE_HAS(LIGHTS) && TUILE_UNLIKELY(t->coloured && t->config.shade == TUILE_FLAT)) { frame_lights_flat(t, surface); }
}

/* After the `count` faces of a plain cluster: number: records that there are now; longest: all bits of the sides' lengths. */
TUILE_INLINE void face_binned(tuile_t *t, uint32_t count, uint32_t number, uint32_t degenerate, uint32_t outside,
                              uint32_t longest) {
    if (longest >= SHORT_SIDE) { t->small = false; }
    const uint32_t binned = number - t->record_count;
    t->record_count = number;
    t->stats.faces_binned += binned;
    t->stats.faces_degenerate += degenerate;
    t->stats.faces_outside += outside;
    t->stats.faces_back += count - binned - degenerate - outside;
}

/* Records for the triangles of a cluster that lies within the region, seen from the front only, where there is room for all of them
 * at once. False: it is not such a cluster, and nothing was done. */
bool face_bin_plain(tuile_t *t, const frame_cluster_t *cluster, unsigned count);

#endif
