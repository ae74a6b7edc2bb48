/* What is asked of a record before its face is drawn with its texture at once, in line. */
#ifndef TUILE_FRAME_TEXTURED_H
#define TUILE_FRAME_TEXTURED_H

#include "frame.h"

/* Another source of vertices, or another material of it: wanted, as textured_source. False: its faces may not be drawn so. */
bool textured_source_open(tuile_t *t, const record_t *record, uint32_t wanted);

/* Whether faces of the record's material and source may be; t->textured_last and t->textured_texcoords are then of them. */
TUILE_INLINE bool textured_fits(tuile_t *t, const record_t *record) {
    const uint32_t wanted = ((const record_surface_t *)(const void *)record)->source | (uint32_t)record->material << 16;
    return TUILE_LIKELY(t->textured_source == wanted) || textured_source_open(t, record, wanted);
}

/* The triangle with short sides of a record, where textured_fits: surface/textured.h. x1 ... y2: from the first corner. */
TUILE_INLINE textured_face_t textured_face(const tuile_t *t, const record_t *record, const vertex_t *v0, const vertex_t *v1,
                                           const vertex_t *v2, int32_t x1, int32_t y1, int32_t x2, int32_t y2) {
    const int16_t *c0 = (const int16_t *)(const void *)t->textured_texcoords + 2 * (size_t)record->v0, *c1 = c0 + 2 * record->d1,
                  *c2 = c0 + 2 * record->d2;
    return (textured_face_t){.x1 = x1,
                             .y1 = y1,
                             .x2 = x2,
                             .y2 = y2,
                             .depth0 = v0->depth_light >> 8,
                             .depth1 = v1->depth_light >> 8,
                             .depth2 = v2->depth_light >> 8,
                             .s0 = c0[0],
                             .t0 = c0[1],
                             .s1 = c1[0] - c0[0],
                             .t1 = c1[1] - c0[1],
                             .s2 = c2[0] - c0[0],
                             .t2 = c2[1] - c0[1]};
}

#endif
