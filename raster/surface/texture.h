/* Texture coordinates over a face, and texels (S21, S22).
 *
 * s and t are linear in space, so s/w, t/w and 1/w are affine in the window, and s = (s/w) / (1/w). A depth is proportional to 1/w.
 *
 * Affine. Let a point of the face have the weights b_i of the corners, in the window. The coordinate is u = sum(b_i q_i u_i) / q
 * with q = sum(b_i q_i), and what affine interpolation gives is off by sum(b_i u_i (q_i - q)) / q, a covariance, so by at most
 *     (most u - least u) (most q - least q) / (4 least q)            (Grüss)
 * A face for which that is at most 1/4 texel for s and t is drawn so. In an orthographic view all are.
 *
 * Perspective. s and t are made at every 16th column of the window, whatever the run, and are linear between, as long as the same
 * bound, for those 16 columns, is at most 1/4 texel; else they are made for each sample.
 *
 * Errors besides: of roundings, below 1/4 texel (texture_plane.c). So an address is within 1/2 texel of the exact one through the
 * snapped corners, on faces that are up to 32768 texels across and 256 times as far off at one end as at the other.
 *
 * Texels are addressed by floor(s), floor(t), brought into the texture by repeating or clamping. Nothing else reaches memory, so no
 * coordinates lead out of a texture.
 */
#ifndef TUILE_SURFACE_TEXTURE_H
#define TUILE_SURFACE_TEXTURE_H

#include "../fixed.h"
#include "../tuile.h"

#include <stddef.h>

/* One mip level. */
typedef struct texture_level {
    const uint8_t *texels;
    uint16_t width, height;
    uint32_t row_bytes;
} texture_level_t;

/* v + x dx + y dy at the centre of pixel (x, y), modulo 2^64. */
typedef struct texture_affine64 {
    int64_t v, dx, dy;
} texture_affine64_t;

/* The same modulo 2^32: texels, Q16.16. */
typedef struct texture_affine32 {
    uint32_t v, dx, dy;
} texture_affine32_t;

typedef struct texture_plane {
    tuile_texture_t texture;
    texture_level_t level;
    uint8_t level_number;
    bool bilinear, mips;
    bool perspective;
    int32_t level_q; /* texture_plane.c */
    /* Affine: */
    texture_affine32_t s, t;
    /* Perspective: s = s0 + u / q, and so for t: texture_plane.c has their units. */
    texture_affine64_t u, v, q;
    int32_t s0, t0;  /* texels, Q16.16 */
    int8_t shift;    /* texels Q16.16 = u * 2^-shift * (reciprocal of q) */
    int64_t q_least; /* half of what it is over the face */
} texture_plane_t;

/* A corner: window, depth, and coordinates in texels of level 0, Q.8. */
typedef struct texture_corner {
    int32_t x, y; /* 1/16 pixel */
    uint32_t depth;
    int32_t s, t;
} texture_corner_t;

typedef struct texture_wish {
    bool bilinear, affine, mips, perspective;
    uint32_t least, most; /* of a polygon, which reaches beyond the corners: its depths; most = 0: a triangle */
} texture_wish_t;

/* Sets all of plane up. Corners with an area other than 0. */
void texture_plane_make(texture_plane_t *plane, const tuile_texture_t *texture, const texture_corner_t corner[3],
                        texture_wish_t wish);

/* In perspective the level is chosen for so many columns at once: that at sample (x, y). */
#define TEXTURE_BLOCK 16
unsigned texture_level_at(const texture_plane_t *plane, int32_t x, int32_t y);

/* Coordinates of samples (x ... x + count - 1, y) in texels of level 0, Q16.16; any count. */
void texture_coordinates(const texture_plane_t *plane, int32_t x, int32_t y, int32_t count, int32_t *s, int32_t *t);

/* Texels of a level at those coordinates, as 0xaarrggbb: the nearest ones or interpolated. number: the level's. */
void texture_fetch(const texture_plane_t *plane, const texture_level_t *level, unsigned number, const int32_t *s, const int32_t *t,
                   int32_t count, uint32_t *argb);

/* The texture at samples (x ... x + count - 1, y), count <= 32, as 0xaarrggbb. */
void texture_run(const texture_plane_t *plane, int32_t x, int32_t y, int32_t count, uint32_t *argb);

/* Mip level `number` < texture->levels. */
texture_level_t texture_level(const tuile_texture_t *texture, unsigned number);

/* One texel of level 0, 0xaarrggbb, brought into the texture as its flags say; any s and t. A texel that is the key is 0. */
uint32_t texture_texel(const tuile_texture_t *texture, int32_t s, int32_t t);

/* The texel (s, t) of a level, 0 <= s < width, 0 <= t < height. */
uint32_t texture_level_texel(const tuile_texture_t *texture, const texture_level_t *level, uint32_t s, uint32_t t);

/* Bytes of a row of a level. */
TUILE_INLINE uint32_t texture_row_bytes(uint8_t format, uint32_t width) {
    return format == TUILE_TEXEL_PALETTE4                                   ? (width + 1) / 2
           : format == TUILE_TEXEL_RGB565 || format == TUILE_TEXEL_ARGB4444 ? 2 * width
                                                                            : width;
}

#endif
