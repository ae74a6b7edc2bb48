/* The fast way of a texture: small triangles of a mesh, RGB565 texels, or bytes that number such colours, into RGB565 samples; the
 * nearest texel, affine coordinates, white light. Both coordinates are in one 64-bit number that one addition steps: t above, s
 * below, each as the part of a texel's place in memory that it decides, so that they repeat by themselves.
 *
 * Light: 64 levels. A colour is texel * m / 64, rounded, with m = round(light / 4), light 2 ... 253 of 255: within one step of the
 * exact product (0.71 for red and blue, 0.95 for green, which has 64).
 */
#ifndef TUILE_FILL_TEXTURED_H
#define TUILE_FILL_TEXTURED_H

#include "triangle.h"

/* v + x dx + y dy at the centre of pixel (x, y), modulo 2^64: above t times the width, below s, both in texels of the level,
 * Q16.16. */
typedef struct textured_map {
    uint64_t v, dx, dy;
    uint64_t mask;           /* what of them tells the texel: (height - 1) * width << 48 | (width - 1) << 16 */
    const void *texels;      /* of the level, at most 65536: uint16_t, or uint8_t if there is a palette */
    const uint16_t *palette; /* NULL: none */
} textured_map_t;

typedef struct textured {
    triangle_t triangle; /* its value is 0: no number */
    textured_map_t map;
} textured_t;

TUILE_INLINE uint64_t textured_pack(int64_t t, int64_t s) { return ((uint64_t)t << 32) + (uint64_t)s; }

/* Where a texel lies: its index. */
TUILE_INLINE uint32_t textured_index(uint64_t at, uint64_t mask) {
    const uint64_t inside = at & mask;
    return ((uint32_t)(inside >> 32) | (uint32_t)inside) >> 16; /* of each half the upper 16 bits */
}

/* light: Q8.24, below 254. */
TUILE_INLINE uint32_t textured_levels(uint32_t light) { return (light + 0x2000000u) >> 26; }

TUILE_INLINE uint32_t textured_lit(uint32_t texel, uint32_t levels) {
    const uint32_t red_blue = (texel & 0xf81fu) * levels + 0x10020u, green = (texel & 0x07e0u) * levels + 0x400u;
    return (red_blue >> 6 & 0xf81fu) | (green >> 6 & 0x07e0u);
}

/* A texel of the map at a place, lit. */
TUILE_INLINE uint32_t textured_texel(const void *texels, const uint16_t *palette, uint32_t index, bool paletted) {
    return paletted ? palette[((const uint8_t *)texels)[index]] : ((const uint16_t *)texels)[index];
}

/* What the spans of a tile are drawn into. */
typedef struct textured_tile {
    uint16_t *samples;
    bool swap; /* high byte first */
} textured_tile_t;

/* As triangle_fill: the rows from triangle.row to the tile's bottom or the triangle's end. Short sides; the first of equals wins.
 */
void textured_fill(textured_t *textured, const raster_tile_t *tile, const textured_tile_t *to);

/* Pixels (x ... x + count - 1, y), without depth. light: Q8.24 at x, and per pixel. */
void textured_run(const textured_map_t *map, int32_t x, int32_t y, int32_t count, uint32_t light, uint32_t light_dx, bool swap,
                  uint16_t *samples);

#endif
