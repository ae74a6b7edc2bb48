/* Which faces take the fast way of fill/textured.h: decided by the face alone, so that every method gives it the same colours. */
#ifndef TUILE_SURFACE_TEXTURED_H
#define TUILE_SURFACE_TEXTURED_H

#include "../divide.h"
#include "../fill/textured.h"
#include "texture_affine.h"

/* A mip level of a texture that takes the fast way. */
typedef struct textured_level {
    const uint8_t *texels;
    uint64_t mask;         /* fill/textured.h */
    uint8_t number, width; /* log2 */
    uint8_t upper, lower;  /* the level is wanted where texels >> upper <= pixels < (texels >> lower | always): areas as below */
    uint32_t always;
    bool fit;
} textured_level_t;

/* What a material and its texture decide, and the level that was wanted last. */
typedef struct textured_material {
    const uint8_t *texels;
    const uint16_t *palette; /* NULL: texels are colours */
    uint8_t log2_width, log2_height, levels, uv_bits;
    bool fit; /* faces of the material may take it */
    bool affine;
    textured_level_t level;
} textured_material_t;

void textured_material_open(textured_material_t *m, const tuile_material_t *material, const tuile_texture_t *texture,
                            uint8_t texturing, bool perspective);

/* Makes the level current at which a texel is about a pixel. */
void textured_level_find(textured_material_t *m, uint32_t texels, uint32_t pixels);

TUILE_INLINE uint32_t textured_size(int32_t x) { return x < 0 ? 0u - (uint32_t)x : (uint32_t)x; }

/* A face of such a material with short sides, in white light, its corners counter-clockwise; s and t of corners times 2^bits are
 * texels, Q.8. False: it takes the other way, since it is more than 128 texels across, its depths are too far apart (texture.h:
 * here sums stand for the ranges), or its level has more than 65536 texels or is a line. v is that of the pixel whose centre lies
 * to_x, to_y sixteenths of a pixel from a.
 *
 * Gradients by the reciprocal of the area as in surface/texture_affine.h, off by 2^-10 texel a pixel, and floored for a sixteenth
 * of a pixel, 2^-12 a pixel: over 2 * 32 pixels 5/64 texel. */
TUILE_INLINE bool textured_map_at(textured_map_t *map, textured_material_t *m, const texture_corner_t *a, const texture_corner_t *b,
                                  const texture_corner_t *c, unsigned bits, int_fast32_t to_x, int_fast32_t to_y) {
    const int32_t x1 = b->x - a->x, y1 = b->y - a->y, x2 = c->x - a->x, y2 = c->y - a->y;
    const int32_t s1 = (b->s - a->s) * (1 << bits), t1 = (b->t - a->t) * (1 << bits), s2 = (c->s - a->s) * (1 << bits),
                  t2 = (c->t - a->t) * (1 << bits);
    const uint32_t across = textured_size(s1) + textured_size(s2) + textured_size(t1) + textured_size(t2);
    const uint32_t deep = textured_size((int32_t)(b->depth - a->depth)) + textured_size((int32_t)(c->depth - a->depth));
    if (TUILE_UNLIKELY(across >= TEXTURE_SMALL || (!m->affine && (uint64_t)deep * (across + 256u) > (uint64_t)a->depth << 8))) {
        return false;
    }
    const int32_t area = x2 * y1 - x1 * y2;
    const int32_t reciprocal = divide_area(area);                                           /* sides are short */
    const uint32_t texels = textured_size(s1 * t2 - s2 * t1) >> 7, pixels = (uint32_t)area; /* twice the areas, Q.9 and Q.8 */
    const textured_level_t *level = &m->level;
    if (TUILE_UNLIKELY(texels >> level->upper > pixels || (texels >> level->lower | level->always) <= pixels)) {
        textured_level_find(m, texels, pixels);
    }
    if (TUILE_UNLIKELY(!level->fit)) { return false; }
    /* Q.8 texels of level 0 a sixteenth of a pixel, times 2^31; to Q.16 of the level, times the width for t. */
    const unsigned down = 23u + level->number, down_t = down - level->width;
    const uint64_t dx = textured_pack((int64_t)(t2 * y1 - t1 * y2) * reciprocal >> down_t,
                                      (int64_t)(s2 * y1 - s1 * y2) * reciprocal >> down),
                   dy = textured_pack((int64_t)(t1 * x2 - t2 * x1) * reciprocal >> down_t,
                                      (int64_t)(s1 * x2 - s2 * x1) * reciprocal >> down);
    const uint64_t at_corner = textured_pack(fixed_shift_left64(a->t, 8 + bits + level->width) >> level->number,
                                             fixed_shift_left64(a->s, 8 + bits) >> level->number);
    map->v = at_corner + dx * (uint64_t)to_x + dy * (uint64_t)to_y;
    map->dx = dx << 4;
    map->dy = dy << 4;
    map->mask = level->mask;
    map->texels = level->texels;
    map->palette = m->palette;
    return true;
}

/* The same with v that of pixel (0, 0). */
TUILE_INLINE bool textured_map(textured_map_t *map, textured_material_t *m, const texture_corner_t *a, const texture_corner_t *b,
                               const texture_corner_t *c, unsigned bits) {
    return textured_map_at(map, m, a, b, c, bits, 8 - a->x, 8 - a->y);
}

#endif
