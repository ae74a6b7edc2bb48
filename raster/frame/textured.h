/* What is asked of a record before its face is drawn with its texture at once, in line. */
#ifndef TUILE_FRAME_TEXTURED_H
#define TUILE_FRAME_TEXTURED_H

#include "frame.h"

/* Another source of vertices, or another material of it. */
void textured_source_open(tuile_t *t, const record_t *record, uint16_t at);

/* Whether faces of the record's material and source may be; t->textured_last and t->textured_texcoords are then of them. */
TUILE_INLINE bool textured_fits(tuile_t *t, const record_t *record) {
    const uint16_t source = ((const record_surface_t *)(const void *)record)->source;
    if (TUILE_UNLIKELY(t->textured_source != source || t->textured_number != record->material)) {
        textured_source_open(t, record, source);
    }
    return t->textured_fits;
}

TUILE_INLINE texture_corner_t textured_corner(const vertex_t *vertex, const int16_t *texcoords) {
    return (texture_corner_t){vertex->x, vertex->y, vertex->depth_light >> 8, texcoords[0], texcoords[1]};
}

/* The map of a record's triangle that has short sides, where textured_fits: surface/textured.h. */
TUILE_INLINE bool textured_face(tuile_t *t, textured_map_t *map, const record_t *record, int_fast32_t to_x, int_fast32_t to_y) {
    const vertex_t *v0 = &t->vertices[record->v0];
    const int16_t *texcoords = t->textured_texcoords + 2 * (ptrdiff_t)record->v0;
    const texture_corner_t a = textured_corner(v0, texcoords), b = textured_corner(v0 + record->d1, texcoords + 2 * record->d1),
                           c = textured_corner(v0 + record->d2, texcoords + 2 * record->d2);
    return textured_map_at(map, &t->textured_last, &a, &b, &c, 8u - t->textured_last.uv_bits, to_x, to_y);
}

#endif
