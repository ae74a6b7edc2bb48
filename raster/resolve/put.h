/* How pixels lie in the bytes of a tile, for functions that tell a pixel of the run: its bits, or its luminance. */
#ifndef TUILE_RESOLVE_PUT_H
#define TUILE_RESOLVE_PUT_H

#include "resolve.h"

typedef uint32_t (*resolve_pixel_fn)(const resolve_run_t *run, uint32_t i);

TUILE_INLINE size_t put_index(const resolve_run_t *run) { return (size_t)run->y * run->width + run->x; }

TUILE_INLINE uint32_t put_threshold(const resolve_run_t *run, uint32_t i) { return run->thresholds[i % RESOLVE_MATRIX]; }

/* high: which byte holds red, 0 or 1. */
TUILE_INLINE void put_16(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn pixel, unsigned high) {
    uint8_t *to = bytes + 2u * put_index(run);
    for (uint32_t i = 0; i < run->count; i++, to += 2) {
        const uint32_t value = pixel(run, i);
        to[high] = (uint8_t)(value >> 8);
        to[high ^ 1u] = (uint8_t)value;
    }
}

/* Pixels of a tile in one string of 12 bits each, whatever its width. */
TUILE_INLINE void put_12(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn pixel) {
    const size_t index = put_index(run);
    uint8_t *to = bytes + index / 2 * 3;
    bool second = index % 2 != 0;
    for (uint32_t i = 0; i < run->count; i++, second = !second) {
        const uint32_t value = pixel(run, i);
        if (second) {
            to[1] |= (uint8_t)(value >> 8);
            to[2] = (uint8_t)value;
            to += 3;
        } else {
            to[0] = (uint8_t)(value >> 4);
            to[1] = (uint8_t)(value << 4);
        }
    }
}

/* 0x00rrggbb, six bits each. */
TUILE_INLINE void put_18(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn pixel) {
    uint8_t *to = bytes + 3u * put_index(run);
    for (uint32_t i = 0; i < run->count; i++, to += 3) {
        const uint32_t value = pixel(run, i) << 2;
        to[0] = (uint8_t)(value >> 16);
        to[1] = (uint8_t)(value >> 8);
        to[2] = (uint8_t)value;
    }
}

TUILE_INLINE void put_8(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn pixel) {
    uint8_t *to = bytes + put_index(run);
    for (uint32_t i = 0; i < run->count; i++) {
        to[i] = (uint8_t)pixel(run, i);
    }
}

/* Pixels of a tile in one string of two a byte: 00RGBRGB, whatever its width. */
TUILE_INLINE void put_3(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn pixel) {
    const size_t index = put_index(run);
    for (uint32_t i = 0; i < run->count; i++) {
        uint8_t *to = bytes + (index + i) / 2;
        const uint32_t value = pixel(run, i);
        *to = (uint8_t)((index + i) % 2 ? *to | value : value << 3);
    }
}

/* 0x00rrggbb, its bytes from the lowest one on: 3, or 4. */
TUILE_INLINE void put_little(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn pixel, unsigned size) {
    uint8_t *to = bytes + size * put_index(run);
    for (uint32_t i = 0; i < run->count; i++, to += size) {
        const uint32_t value = pixel(run, i);
        for (unsigned byte = 0; byte < size; byte++) {
            to[byte] = (uint8_t)(value >> 8 * byte);
        }
    }
}

/* Rows begin on whole bytes. */
TUILE_INLINE void put_4(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn pixel) {
    uint8_t *to = bytes + (size_t)run->y * ((run->width + 1) / 2) + run->x / 2;
    uint32_t i = 0;
    for (; i + 1 < run->count; i += 2) {
        *to++ = (uint8_t)(pixel(run, i) << 4 | pixel(run, i + 1));
    }
    if (i < run->count) { *to = (uint8_t)(pixel(run, i) << 4); }
}

/* The same with x and y exchanged: columns begin on whole bytes. */
TUILE_INLINE void put_4_turned(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn pixel) {
    const size_t column = (run->height + 1) / 2;
    uint8_t *to = bytes + run->x * column + run->y / 2;
    const bool second = run->y % 2 != 0;
    for (uint32_t i = 0; i < run->count; i++, to += column) {
        const uint32_t value = pixel(run, i);
        *to = (uint8_t)(second ? *to | value : value << 4);
    }
}

/* ---- luminance: 65535 = 255 * 257 = 15 * 4369, so a step of GREY8 is 257, one of GREY4 4369 ---- */

/* raised: the mean of a pixel's samples plus its threshold, at most 65535 + 256. Quotients: of 257 q + r with q < 256, x >> 8 is q
 * or, for r > 255 - q, q + 1. */
TUILE_INLINE uint32_t put_grey8(uint32_t raised) { return (raised - (raised >> 8)) >> 8; }

/* At most 65535 + 4368; 15 x / 65535, whose quotient is below 65536. */
TUILE_INLINE uint32_t put_grey4(uint32_t raised) { return (raised * 15u + 1u + (raised * 15u >> 16)) >> 16; }

/* White from which sum on: the least with (sum * 128 + threshold * 65535) / (128 * samples) >= 65535. */
TUILE_INLINE void put_limits(const resolve_run_t *run, uint32_t limits[RESOLVE_MATRIX], unsigned shift) {
    for (unsigned i = 0; i < RESOLVE_MATRIX; i++) {
        limits[i] = (((128u << 2u * shift) - run->thresholds[i]) * 65535u + 127u) / 128u;
    }
}

TUILE_INLINE void put_pages(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn sum, unsigned shift) {
    uint8_t *to = bytes + (size_t)(run->y / 8) * run->width + run->x;
    const unsigned bit = run->y % 8;
    const unsigned keep = bit == 0 ? 0 : 255;
    uint32_t limits[RESOLVE_MATRIX];
    put_limits(run, limits, shift);
    for (uint32_t i = 0; i < run->count; i++) {
        to[i] = (uint8_t)((to[i] & keep) | (unsigned)(sum(run, i) >= limits[i % RESOLVE_MATRIX]) << bit);
    }
}

/* Bytes of 8 pixels beside one another, `apart` bytes from one to the next; the leftmost pixel is bit `first`, 0 or 7. */
TUILE_INLINE void put_dots(const resolve_run_t *restrict run, uint8_t *restrict to, size_t apart, unsigned first,
                           resolve_pixel_fn sum, unsigned shift) {
    uint32_t limits[RESOLVE_MATRIX];
    put_limits(run, limits, shift);
    for (uint32_t i = 0; i < run->count; i += 8, to += apart) {
        const uint32_t here = run->count - i < 8 ? run->count - i : 8;
        unsigned dots = 0;
        for (uint32_t k = 0; k < here; k++) {
            dots |= (unsigned)(sum(run, i + k) >= limits[k]) << (k ^ first);
        }
        *to = (uint8_t)dots;
    }
}

TUILE_INLINE void put_rows(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn sum, unsigned shift) {
    put_dots(run, bytes + (size_t)run->y * ((run->width + 7) / 8) + run->x / 8, 1, 7, sum, shift);
}

TUILE_INLINE void put_pages_turned(const resolve_run_t *restrict run, uint8_t *restrict bytes, resolve_pixel_fn sum,
                                   unsigned shift) {
    put_dots(run, bytes + (size_t)(run->x / 8) * run->height + run->y, run->height, 0, sum, shift);
}

#endif
