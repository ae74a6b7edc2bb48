/* Gradients of what is affine over a triangle in the window. x1, y1, x2, y2: from the first corner to the others, 1/16 pixel;
 * area = x2 y1 - x1 y2 > 0. fill/triangle.c has the bounds of both forms.
 */
#ifndef TUILE_FILL_GRADIENT_H
#define TUILE_FILL_GRADIENT_H

#include "../divide.h"

typedef struct gradient {
    int64_t dx, dy; /* Q.16 per pixel */
} gradient_t;

/* c1, c2: the values at v1 and v2 less the one at v0; unit_bits: log2 of (Q.16 of a value unit) * 16 px. */
TUILE_INLINE gradient_t gradient_exact(int32_t c1, int32_t c2, int32_t x1, int32_t y1, int32_t x2, int32_t y2, int32_t area,
                                       unsigned unit_bits) {
    const int64_t nx = (int64_t)c2 * y1 - (int64_t)c1 * y2, ny = (int64_t)c1 * x2 - (int64_t)c2 * x1; /* < 2^40 */
    return (gradient_t){fixed_floor_div64(fixed_shift_left64(nx, unit_bits), area),
                        fixed_floor_div64(fixed_shift_left64(ny, unit_bits), area)};
}

/* The exact ones of sides below 32 pixels: |c| < 2^24 with unit_bits 12, or < 2^8 with 28; area < 2^18, reciprocal = floor((2^31 -
 * 1) / area). */
TUILE_INLINE gradient_t gradient_exact_short(int32_t c1, int32_t c2, int32_t x1, int32_t y1, int32_t x2, int32_t y2, int32_t area,
                                             int32_t reciprocal, unsigned unit_bits) {
    const uint32_t room = UINT32_C(1) << 21; /* |c| < 2^21: sums of products with sides stay below 2^31 */
    if (FIXED_BY_HALVES && (unit_bits == 28 || (((uint32_t)c1 + room) | ((uint32_t)c2 + room)) < 2 * room)) {
        const divide_area_t by = divide_area_of(area, reciprocal);
        return (gradient_t){divide_scaled(c2 * y1 - c1 * y2, unit_bits, by), divide_scaled(c1 * x2 - c2 * x1, unit_bits, by)};
    }
    const int64_t nx = fixed_mul_wide(c2, y1) - fixed_mul_wide(c1, y2); /* < 2^(46 - unit_bits) */
    const int64_t ny = fixed_mul_wide(c1, x2) - fixed_mul_wide(c2, x1);
    return (gradient_t){divide_floor46(fixed_shift_left64(nx, unit_bits), area, reciprocal),
                        divide_floor46(fixed_shift_left64(ny, unit_bits), area, reciprocal)};
}

TUILE_INLINE gradient_t gradient_small(int32_t c1, int32_t c2, int32_t x1, int32_t y1, int32_t x2, int32_t y2, int32_t reciprocal,
                                       unsigned unit_bits) {
    return (gradient_t){fixed_mul_wide(c2 * y1 - c1 * y2, reciprocal) >> (31 - unit_bits),
                        fixed_mul_wide(c1 * x2 - c2 * x1, reciprocal) >> (31 - unit_bits)};
}

/* What the fraction of a pixel adds, x and y in sixteenths: the whole pixels are added modulo 2^64 afterwards. */
TUILE_INLINE int64_t gradient_part(gradient_t g, int32_t x, int32_t y) { return (g.dx * x + g.dy * y) >> 4; }

#endif
