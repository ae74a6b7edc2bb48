/* The fast way of a texture: small triangles of a mesh, RGB565 texels, or bytes that number such colours, into RGB565 samples; the
 * nearest texel, affine coordinates, white light.
 *
 * Both coordinates are in one 32-bit number that one addition steps. From the top down: t's whole texels modulo the height, 8 bits
 * of its fraction, those of s modulo the width, 8 bits of fraction, bits that are 0. So they repeat by themselves; what s carries
 * into t is 1/256 texel each time that it passes the texture's side. A mask leaves the whole texels; moved up by the 8 bits of
 * fraction those of s stand right below those of t, t's own fall out above, and what is left below is shifted out. With sides of up
 * to 256 texels.
 *
 * Light: 64 levels. A colour is texel * m / 64, rounded, with m = round(light / 4), light 2 ... 253 of 255: within one step of the
 * exact product (0.71 for red and blue, 0.95 for green, which has 64).
 */
#ifndef TUILE_FILL_TEXTURED_H
#define TUILE_FILL_TEXTURED_H

#include "triangle.h"

/* Bits of fraction of a coordinate. */
#define TEXTURED_FRACTION 8

/* v + x dx + y dy at the centre of pixel (x, y), modulo 2^32. */
typedef struct textured_map {
    uint32_t v, dx, dy;
    uint32_t mask, shift;    /* of the whole texels; from them to an index */
    const void *texels;      /* of the level: uint16_t, or uint8_t if there is a palette */
    const uint16_t *palette; /* NULL: none */
} textured_map_t;

typedef struct textured {
    triangle_t triangle; /* its value is 0: no number */
    textured_map_t map;
} textured_t;

/* Constants of the loops over pixels. A compiler that knew them would make most of them anew for each pixel, in more than one
 * instruction; this one finds them in registers or on the stack. x86-64 has few registers, and instructions that take a number from
 * memory: there they lie where, for all that the compiler knows, a pixel's store might change them, so that it does not load them
 * into registers that are not there. */
#if defined(__GNUC__)
#define TEXTURED_UNKNOWN(x) __asm__("" : "+r"(x))
#else
#define TEXTURED_UNKNOWN(x) ((void)0)
#endif

#if defined(__GNUC__) && defined(__x86_64__)
typedef uint64_t __attribute__((may_alias)) textured_long_t;
typedef uint32_t __attribute__((may_alias)) textured_word_t;
#else
typedef uint64_t textured_long_t;
typedef uint32_t textured_word_t;
#endif

typedef struct textured_numbers {
    textured_word_t fold, green, round_red_blue, round_green;
    textured_long_t spread, fields, round, lit_fields, gather;
} textured_numbers_t;

#define TEXTURED_NUMBERS                                                                                                      \
    {                                                                                                                         \
        .fold = 1u << TEXTURED_FRACTION | 1u, .green = 0x7e0, .round_red_blue = 0x10020, .round_green = 0x400,                \
        .spread = UINT64_C(1) << 32 | 1u, .fields = UINT64_C(0x7e0) << 32 | 0xf81f, .round = UINT64_C(0x400) << 32 | 0x10020, \
        .lit_fields = UINT64_C(0x7e0) << 38 | UINT32_C(0xf81f) << 6, .gather = UINT64_C(1) << 42 | 1u << 10                   \
    }

#if defined(__GNUC__) && defined(__x86_64__)
typedef struct textured_constants {
    const textured_numbers_t *numbers;
} textured_constants_t;

#define TEXTURED_NUMBER(c, name) ((c)->numbers->name)

TUILE_INLINE textured_constants_t textured_constants(void) {
    static const textured_numbers_t numbers = TEXTURED_NUMBERS;
    textured_constants_t c = {&numbers};
    TEXTURED_UNKNOWN(c.numbers);
    return c;
}
#else
typedef textured_numbers_t textured_constants_t;

#define TEXTURED_NUMBER(c, name) ((c)->name)

TUILE_INLINE textured_constants_t textured_constants(void) {
    textured_constants_t c = TEXTURED_NUMBERS;
    if (FIXED_WIDE_REGISTERS) {
        TEXTURED_UNKNOWN(c.fold);
        TEXTURED_UNKNOWN(c.spread);
        TEXTURED_UNKNOWN(c.fields);
        TEXTURED_UNKNOWN(c.round);
        TEXTURED_UNKNOWN(c.lit_fields);
        TEXTURED_UNKNOWN(c.gather);
    } else {
        TEXTURED_UNKNOWN(c.round_red_blue);
        TEXTURED_UNKNOWN(c.round_green);
        if (FIXED_BY_HALVES) {
            TEXTURED_UNKNOWN(c.fold);
            TEXTURED_UNKNOWN(c.green);
        }
    }
    return c;
}
#endif

/* Where a texel lies: its index. */
TUILE_INLINE uint32_t textured_index(uint32_t at, uint32_t mask, uint32_t shift, const textured_constants_t *c) {
    const uint32_t whole = at & mask;
    return (FIXED_WIDE_REGISTERS || FIXED_BY_HALVES ? whole * TEXTURED_NUMBER(c, fold) : whole + (whole << TEXTURED_FRACTION)) >>
           shift;
}

/* light: Q8.24, below 254. biased: with TEXTURED_BIAS added to it. */
#define TEXTURED_BIAS 0x2000000u
TUILE_INLINE uint32_t textured_levels_of(uint32_t biased) { return biased >> 26; }
TUILE_INLINE uint32_t textured_levels(uint32_t light) { return textured_levels_of(light + TEXTURED_BIAS); }

TUILE_INLINE uint16_t textured_swapped(uint16_t sample) { return (uint16_t)(sample >> 8 | sample << 8); }

/* Red and blue in one product, green in another. */
TUILE_INLINE uint16_t textured_lit_by_words(uint32_t texel, uint32_t levels, const textured_constants_t *c, bool swap) {
    const uint32_t green = texel & TEXTURED_NUMBER(c, green), red_blue = texel - green;
    const uint32_t a = red_blue * levels + TEXTURED_NUMBER(c, round_red_blue), b = green * levels + TEXTURED_NUMBER(c, round_green);
    const uint16_t sample = (uint16_t)((a ^ ((a ^ b) & 0x1f800u)) >> 6);
    return swap ? textured_swapped(sample) : sample;
}

/* All in one of 64 bits, green 32 above; a last product brings the fields together in the upper 16. */
TUILE_INLINE uint16_t textured_lit_by_long_words(uint32_t texel, uint32_t levels, const textured_constants_t *c, bool swap) {
    const uint64_t fields =
        ((texel * TEXTURED_NUMBER(c, spread)) & TEXTURED_NUMBER(c, fields)) * levels + TEXTURED_NUMBER(c, round);
    const uint64_t above = (fields & TEXTURED_NUMBER(c, lit_fields)) * TEXTURED_NUMBER(c, gather);
#if defined(__GNUC__)
    if (swap) { return (uint16_t)__builtin_bswap64(above); }
#endif
    return swap ? textured_swapped((uint16_t)(above >> 48)) : (uint16_t)(above >> 48);
}

/* swap: high byte first. */
TUILE_INLINE uint16_t textured_lit(uint32_t texel, uint32_t levels, const textured_constants_t *c, bool swap) {
    return FIXED_WIDE_REGISTERS ? textured_lit_by_long_words(texel, levels, c, swap)
                                : textured_lit_by_words(texel, levels, c, swap);
}

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
