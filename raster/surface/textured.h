/* Which faces take the fast way of fill/textured.h: decided by the face alone, so that every method gives it the same colours. */
#ifndef TUILE_SURFACE_TEXTURED_H
#define TUILE_SURFACE_TEXTURED_H

#include "../divide.h"
#include "../fill/textured.h"
#include "texture_affine.h"

/* A mip level of a texture that takes the fast way. */
typedef struct textured_level {
    const uint8_t *texels;
    uint32_t mask; /* fill/textured.h */
    uint32_t always;
    uint32_t t_unit, s_unit; /* what 1/256 texel comes to in a number */
    uint8_t number, shift;
    uint8_t upper, lower; /* the level is wanted where texels >> upper <= pixels < (texels >> lower | always): areas as below */
    uint8_t from_corner;  /* from a corner's coordinates down to texels of the level */
    uint8_t up, down;     /* a step is a high product of a determinant of coordinates times 2^up and the reciprocal over 2^down */
} textured_level_t;

/* What a material and its texture decide, and the level that was wanted last. */
typedef struct textured_material {
    const uint8_t *texels;
    const uint16_t *palette; /* NULL: texels are colours */
    uint8_t log2_width, log2_height, levels, uv_bits;
    bool fit; /* faces of the material may take it */
    bool affine;
    uint8_t pixels_up;
    uint16_t one;     /* a texel, in coordinates */
    uint16_t across;  /* faces are less than that across, in units of coordinates */
    int32_t s_inside; /* coordinates s modulo the width */
    textured_level_t level;
} textured_material_t;

/* uv_bits: of the coordinates of corners. */
void textured_material_open(textured_material_t *m, const tuile_material_t *material, const tuile_texture_t *texture,
                            uint8_t texturing, bool perspective, unsigned uv_bits);

/* Makes the level current at which a texel is about a pixel. False: faces of that level do not take it. */
bool textured_level_find(textured_material_t *m, uint32_t texels, uint32_t pixels);

/* A triangle with short sides and an area above 0, its corners counter-clockwise: from the first one to the others in 1/16 pixel,
 * depths, and coordinates in texels of level 0 times 2^uv_bits. */
typedef struct textured_face {
    int32_t x1, y1, x2, y2;
    uint32_t depth0, depth1, depth2;
    int32_t s0, t0, s1, t1, s2, t2; /* s1 ... t2: from the first corner's */
} textured_face_t;

/* Whether coordinates may be affine over the face, by texture.h. */
bool textured_affine(const textured_material_t *m, const textured_face_t *f);

/* |x| or |x| - 1. */
TUILE_INLINE uint32_t textured_size(int32_t x) { return (uint32_t)(x ^ -(int32_t)(x < 0)); }

/* At least how far it is across, in coordinates. */
TUILE_INLINE uint32_t textured_across(const textured_face_t *f) {
    return textured_size(f->s1) + textured_size(f->s2) + textured_size(f->t1) + textured_size(f->t2) + 4;
}

/* Makes the face's level the current one. area: x2 * y1 - x1 * y2. False: it does not take it. */
TUILE_INLINE bool textured_level_make(textured_material_t *m, const textured_face_t *f, int32_t area) {
    const uint32_t texels = textured_size(f->s1 * f->t2 - f->s2 * f->t1), pixels = (uint32_t)area << m->pixels_up;
    const textured_level_t *level = &m->level;
    return TUILE_LIKELY(texels >> level->upper <= pixels && (texels >> level->lower | level->always) > pixels) ||
           textured_level_find(m, texels, pixels);
}

/* How a determinant becomes a step: it is multiplied by a * 2^up / 2^32 and rounded, a half up. Where registers are long, 2^up is
 * in the factor. */
typedef struct textured_scale {
    int64_t factor;
    unsigned up;
} textured_scale_t;

TUILE_INLINE textured_scale_t textured_scale(int32_t reciprocal, unsigned up) {
    return FIXED_WIDE_REGISTERS ? (textured_scale_t){(int64_t)((uint64_t)reciprocal << up), 0} : (textured_scale_t){reciprocal, up};
}

TUILE_INLINE int32_t textured_step(int32_t determinant, textured_scale_t scale) {
    if (FIXED_WIDE_REGISTERS) { return (int32_t)((determinant * scale.factor + (INT64_C(1) << 31)) >> 32); }
    return fixed_mul_round((int32_t)((uint32_t)determinant << scale.up), (int32_t)scale.factor);
}

/* Makes the map of a face of such a material in white light, v at the centre of the pixel that lies to_x, to_y (0 ... 15)
 * sixteenths of a pixel from the first corner. False: it takes the other way, since it is more than 127 texels or 8 textures
 * across, its depths are too far apart (texture.h; sums that stand for the ranges are tried first), it is a sliver of many texels,
 * or its level does not fit.
 *
 * Errors, beside that of the affine plane, in texels of the level: steps are rounded to 2^-8, half of that for each of up to 32
 * columns and 32 rows, 1/8; the reciprocal, 2^-10 a pixel, 1/16; what s carries into t, 9/256; the corner, 1/256. With the 1/4 of
 * the plane 0.48.
 *
 * Bounds: determinants are below 2^(17 + uv_bits), times 2^up below 2^30, so a step is below 2^29 / area and 30 of them are below
 * 2^31 from an area of 8 on; the face is as much less across where that is smaller. */
TUILE_INLINE bool textured_map_make(textured_map_t *map, textured_material_t *m, const textured_face_t *f, int32_t to_x,
                                    int32_t to_y) {
    const uint32_t across = textured_across(f);
    const uint32_t deep =
        ((textured_size((int32_t)(f->depth1 - f->depth0)) + textured_size((int32_t)(f->depth2 - f->depth0))) >> 8) + 1;
    if (TUILE_UNLIKELY(across >= m->across)) { return false; }
    if (TUILE_UNLIKELY(deep * (across + m->one) > (f->depth0 >> 8) * m->one)) { /* < 2^17 * 2^15 */
        const textured_face_t copy = *f;                                        /* so that here it need not be in memory */
        if (!textured_affine(m, &copy)) { return false; }
    }
    const int32_t area = f->x2 * f->y1 - f->x1 * f->y2;
    if (TUILE_UNLIKELY(area < 8) && 8 * across > m->across * (uint32_t)area) { return false; }
    if (!textured_level_make(m, f, area)) { return false; }
    const textured_level_t *level = &m->level;
    const textured_scale_t scale = textured_scale(divide_area(area) >> level->down, level->up); /* sides are short */
    const int32_t s_x = textured_step(f->s2 * f->y1 - f->s1 * f->y2, scale),
                  t_x = textured_step(f->t2 * f->y1 - f->t1 * f->y2, scale),
                  s_y = textured_step(f->s1 * f->x2 - f->s2 * f->x1, scale),
                  t_y = textured_step(f->t1 * f->x2 - f->t2 * f->x1, scale);
    const uint32_t t_unit = level->t_unit, s_unit = level->s_unit;
    map->dx = (uint32_t)t_x * t_unit + (uint32_t)s_x * s_unit;
    map->dy = (uint32_t)t_y * t_unit + (uint32_t)s_y * s_unit;
    const int32_t s_corner = (f->s0 & m->s_inside) * (1 << TEXTURED_FRACTION) >> level->from_corner,
                  t_corner = f->t0 * (1 << TEXTURED_FRACTION) >> level->from_corner;
    map->v = (uint32_t)(t_corner + ((t_x * to_x + t_y * to_y) >> 4)) * t_unit +
             (uint32_t)(s_corner + ((s_x * to_x + s_y * to_y) >> 4)) * s_unit;
    map->mask = level->mask;
    map->shift = level->shift;
    map->texels = level->texels;
    map->palette = m->palette;
    return true;
}

/* The same with v that of pixel (0, 0). x0, y0: the first corner. */
TUILE_INLINE bool textured_map_at_origin(textured_map_t *map, textured_material_t *m, const textured_face_t *f, int32_t x0,
                                         int32_t y0) {
    const int32_t to_x = 8 - x0, to_y = 8 - y0;
    if (!textured_map_make(map, m, f, to_x & 15, to_y & 15)) { return false; }
    map->v += map->dx * (uint32_t)(to_x >> 4) + map->dy * (uint32_t)(to_y >> 4);
    return true;
}

#endif
