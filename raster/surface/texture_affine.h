/* The planes of faces over which texture coordinates are affine enough (texture.h), in line: most faces of a mesh are such.
 *
 * Affine planes are Q16.16 texels modulo 2^32. Small faces (sides below 32 pixels, less than 128 texels across) share one 31-bit
 * reciprocal of the area, for others the quotients are exact: fill/triangle.c has the bound of the first, |num| / 2^31 per 1/16
 * pixel, here |num| < 2^25, 2^-10 texel a pixel, over 2 * 32 pixels 1/16 texel; floors of the second, 2^-16 a pixel, over 2 * 2048
 * pixels 1/16 texel.
 */
#ifndef TUILE_SURFACE_TEXTURE_AFFINE_H
#define TUILE_SURFACE_TEXTURE_AFFINE_H

#include "../fill/edge.h"
#include "../fill/gradient.h"
#include "texture.h"

#define TEXTURE_SMALL (INT32_C(1) << 15) /* Q.8 */

typedef struct texture_span3 {
    int32_t least, most;
} texture_span3_t;

TUILE_INLINE texture_span3_t texture_span3(int32_t a, int32_t b, int32_t c) {
    return (texture_span3_t){a < b ? (a < c ? a : c) : (b < c ? b : c), a > b ? (a > c ? a : c) : (b > c ? b : c)};
}

/* v + x dx + y dy from the value at a corner, modulo 2^64. */
TUILE_INLINE int64_t texture_origin(gradient_t g, int64_t at_corner, const texture_corner_t *corner) {
    const int32_t to_x = 8 - corner->x, to_y = 8 - corner->y;
    return (int64_t)((uint64_t)at_corner + (uint64_t)gradient_part(g, to_x & 15, to_y & 15) +
                     (uint64_t)g.dx * (uint64_t)(int64_t)(to_x >> 4) + (uint64_t)g.dy * (uint64_t)(int64_t)(to_y >> 4));
}

/* Window and area of a face whose corners have been put in counter-clockwise order. */
typedef struct texture_frame {
    int32_t x1, y1, x2, y2, area;
    bool is_short;
} texture_frame_t;

TUILE_INLINE texture_affine32_t texture_affine(const texture_frame_t *f, const texture_corner_t *a, int32_t c0, int32_t c1,
                                               int32_t c2, bool small, int32_t reciprocal) {
    c1 -= c0;
    c2 -= c0;
    const gradient_t g = small ? gradient_small(c1, c2, f->x1, f->y1, f->x2, f->y2, reciprocal, 12)
                               : gradient_exact(c1, c2, f->x1, f->y1, f->x2, f->y2, f->area, 12);
    return (texture_affine32_t){(uint32_t)texture_origin(g, (int64_t)c0 * 256, a), (uint32_t)g.dx, (uint32_t)g.dy};
}

TUILE_INLINE bool texture_near_zero(int32_t c, int32_t limit) { return (uint32_t)(c + limit) < 2u * (uint32_t)limit; }

TUILE_INLINE void texture_affine_make(texture_plane_t *plane, const texture_frame_t *f, const texture_corner_t *a,
                                      const texture_corner_t *b, const texture_corner_t *c) {
    const bool small = f->is_short && texture_near_zero(b->s - a->s, TEXTURE_SMALL) &&
                       texture_near_zero(c->s - a->s, TEXTURE_SMALL) && texture_near_zero(b->t - a->t, TEXTURE_SMALL) &&
                       texture_near_zero(c->t - a->t, TEXTURE_SMALL);
    const int32_t reciprocal = small ? INT32_MAX / f->area : 0;
    plane->perspective = false;
    plane->s = texture_affine(f, a, a->s, b->s, c->s, small, reciprocal);
    plane->t = texture_affine(f, a, a->t, b->t, c->t, small, reciprocal);
}

/* A quarter texel, by the bound in texture.h; coordinates in Q.8. */
TUILE_INLINE bool texture_affine_will_do(const texture_corner_t corner[3]) {
    const uint32_t a = corner[0].depth, b = corner[1].depth, c = corner[2].depth;
    const uint32_t least = a < b ? (a < c ? a : c) : (b < c ? b : c), most = a > b ? (a > c ? a : c) : (b > c ? b : c);
    const texture_span3_t s = texture_span3(corner[0].s, corner[1].s, corner[2].s),
                          t = texture_span3(corner[0].t, corner[1].t, corner[2].t);
    const uint32_t across = (uint32_t)(s.most - s.least), down = (uint32_t)(t.most - t.least);
    return (uint64_t)(most - least) * (across > down ? across : down) <= (uint64_t)least * 256u;
}

/* log2 x in 1/256, within 0.09: the mantissa taken for its logarithm. */
TUILE_INLINE int32_t texture_log2(uint64_t x) {
    const unsigned n = fixed_clz64(x | 1);
    return (int32_t)(63 - n) * 256 + (int32_t)((x << n) >> 55 & 255);
}

/* A pixel is drawn from the level at which it is about a texel large, by areas. Texels' area over pixels' area is K / q^3 on a
 * plane, and of the whole face K / (q0 q1 q2). Returns 2 log2 of the side of a pixel in texels, Q.8; plus 3 log2 q in perspective.
 */
TUILE_INLINE int32_t texture_level_plane(const texture_corner_t corner[3], int32_t area) {
    const int64_t s1 = corner[1].s - corner[0].s, t1 = corner[1].t - corner[0].t, s2 = corner[2].s - corner[0].s,
                  t2 = corner[2].t - corner[0].t;
    const int64_t turned = s1 * t2 - s2 * t1; /* twice the area in texels, Q.16; |s|, |t| < 2^24; the window's: Q.8 */
    return texture_log2((uint64_t)(turned < 0 ? -turned : turned)) - 8 * 256 - texture_log2((uint32_t)area);
}

TUILE_INLINE unsigned texture_level_held(int32_t side_squared, unsigned levels) {
    const int32_t level = (side_squared + 256) >> 9; /* half of it, rounded to the nearest */
    return level < 0 ? 0 : level >= (int32_t)levels ? levels - 1 : (unsigned)level;
}

#endif
