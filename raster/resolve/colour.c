/* Colours to wire bytes: from samples in the format's own steps, whose sums are only divided by their number, and from whole
 * components, which dithering wants.
 *
 * Fields of sums: RGB565 blue from bit 0, red 11, green 21; RGB444 blue 0, green 8, red 16; RGB332 blue 0, green 8, red 16;
 * RGB888 blue 0, red 16, green in a word of its own. Sums of sixteen take four bits more than a sample.
 */
#include "../tune.h"

#include "sum.h"

/* ---- sums ---- */

TUILE_INLINE uint32_t swapped(uint32_t x) { return (uint16_t)(x >> 8 | x << 8); }

TUILE_INLINE uint32_t spread_565(uint32_t sample) { return (sample | sample << 16) & 0x07e0f81fu; }

TUILE_INLINE uint32_t spread_565_swapped(uint32_t sample) { return spread_565(swapped(sample)); }

TUILE_INLINE uint32_t spread_444(uint32_t sample) { return (sample & 0xf00u) << 8 | (sample & 0xf0u) << 4 | (sample & 0xfu); }

TUILE_INLINE uint32_t spread_332(uint32_t sample) { return (sample & 0xe0u) << 11 | (sample & 0x1cu) << 6 | (sample & 3u); }

static void sum_565_be(const void *samples, size_t stride, resolve_run_t *run) {
    sum_words(samples, stride, run, spread_565_swapped);
}

static void sum_565_le(const void *samples, size_t stride, resolve_run_t *run) { sum_words(samples, stride, run, spread_565); }

static void sum_444(const void *samples, size_t stride, resolve_run_t *run) { sum_words(samples, stride, run, spread_444); }

static void sum_332(const void *samples, size_t stride, resolve_run_t *run) { sum_words(samples, stride, run, spread_332); }

TUILE_INLINE void sum_888_by(const uint32_t *at, size_t stride, resolve_run_t *run, unsigned shift) {
    const uint32_t along = 1u << shift;
    for (uint32_t i = 0; i < run->count; i++, at += along) {
        uint32_t others = 0, green = 0;
        for (uint32_t row = 0; row < along; row++) {
            for (uint32_t column = 0; column < along; column++) {
                const uint32_t sample = at[row * stride + column];
                others += sample & 0xff00ffu;
                green += sample >> 8 & 255u;
            }
        }
        run->sums[i] = others;
        run->green[i] = green;
    }
}

static void sum_888(const void *samples, size_t stride, resolve_run_t *run) {
    switch (run->shift) {
    case 0: sum_888_by(samples, stride, run, 0); break;
    case 1: sum_888_by(samples, stride, run, 1); break;
    default: sum_888_by(samples, stride, run, 2); break;
    }
}

/* ---- a pixel in the format's steps: 0x00rrggbb in fields of the format ---- */

typedef uint32_t (*pixel_fn)(const resolve_run_t *run, uint32_t i);

/* Of a sum in the format's own steps. */
TUILE_INLINE uint32_t mean(const resolve_run_t *run, uint32_t sum) {
    return (sum + ((1u << 2u * run->shift) >> 1)) >> 2u * run->shift;
}

TUILE_INLINE uint32_t own_565(const resolve_run_t *run, uint32_t i) {
    const uint32_t sum = run->sums[i];
    return mean(run, sum >> 11 & 0x3ffu) << 11 | mean(run, sum >> 21) << 5 | mean(run, sum & 0x7ffu);
}

TUILE_INLINE uint32_t own_444(const resolve_run_t *run, uint32_t i) {
    const uint32_t sum = run->sums[i];
    return mean(run, sum >> 16) << 8 | mean(run, sum >> 8 & 255u) << 4 | mean(run, sum & 255u);
}

TUILE_INLINE uint32_t own_332(const resolve_run_t *run, uint32_t i) {
    const uint32_t sum = run->sums[i];
    return mean(run, sum >> 16) << 5 | mean(run, sum >> 8 & 255u) << 2 | mean(run, sum & 255u);
}

/* sum <= 16 * 255, most <= 63: the numerator is below 2^25, the quotient by 128 * samples at most 64 * 255. */
TUILE_INLINE uint32_t steps_of(const resolve_run_t *run, uint32_t i, uint32_t sum, uint32_t most) {
    return pixel_div255((sum * (most * 128u) + run->thresholds[i % RESOLVE_MATRIX] * 255u) >> (7u + 2u * run->shift));
}

/* red and blue: the greatest steps. */
TUILE_INLINE uint32_t whole(const resolve_run_t *run, uint32_t i, uint32_t red, uint32_t green, uint32_t blue, unsigned red_at,
                            unsigned green_at) {
    return steps_of(run, i, run->sums[i] >> 16, red) << red_at | steps_of(run, i, run->green[i], green) << green_at |
           steps_of(run, i, run->sums[i] & 0xffffu, blue);
}

TUILE_INLINE uint32_t whole_565(const resolve_run_t *run, uint32_t i) { return whole(run, i, 31, 63, 31, 11, 5); }

TUILE_INLINE uint32_t whole_444(const resolve_run_t *run, uint32_t i) { return whole(run, i, 15, 15, 15, 8, 4); }

TUILE_INLINE uint32_t whole_332(const resolve_run_t *run, uint32_t i) { return whole(run, i, 7, 7, 3, 5, 2); }

TUILE_INLINE uint32_t whole_666(const resolve_run_t *run, uint32_t i) { return whole(run, i, 63, 63, 63, 16, 8); }

/* ---- into the tile ---- */

TUILE_INLINE size_t pixel_index(const resolve_run_t *run) { return (size_t)run->y * run->width + run->x; }

/* high: the byte that holds red, 0 or 1. */
TUILE_INLINE void put_16(const resolve_run_t *restrict run, uint8_t *restrict bytes, pixel_fn pixel, unsigned high) {
    uint8_t *to = bytes + 2u * pixel_index(run);
    for (uint32_t i = 0; i < run->count; i++, to += 2) {
        const uint32_t value = pixel(run, i);
        to[high] = (uint8_t)(value >> 8);
        to[high ^ 1u] = (uint8_t)value;
    }
}

/* Pixels of a tile in one string of 12 bits each, whatever its width. */
TUILE_INLINE void put_12(const resolve_run_t *restrict run, uint8_t *restrict bytes, pixel_fn pixel) {
    size_t index = pixel_index(run);
    for (uint32_t i = 0; i < run->count; i++, index++) {
        const uint32_t value = pixel(run, i);
        uint8_t *to = bytes + index / 2 * 3;
        if (index % 2 == 0) {
            to[0] = (uint8_t)(value >> 4);
            to[1] = (uint8_t)(value << 4);
        } else {
            to[1] |= (uint8_t)(value >> 8);
            to[2] = (uint8_t)value;
        }
    }
}

TUILE_INLINE void put_8(const resolve_run_t *restrict run, uint8_t *restrict bytes, pixel_fn pixel) {
    uint8_t *to = bytes + pixel_index(run);
    for (uint32_t i = 0; i < run->count; i++) {
        to[i] = (uint8_t)pixel(run, i);
    }
}

static void put_own_565_be(const resolve_run_t *restrict run, uint8_t *restrict bytes) { put_16(run, bytes, own_565, 0); }

static void put_own_565_le(const resolve_run_t *restrict run, uint8_t *restrict bytes) { put_16(run, bytes, own_565, 1); }

static void put_whole_565_be(const resolve_run_t *restrict run, uint8_t *restrict bytes) { put_16(run, bytes, whole_565, 0); }

static void put_whole_565_le(const resolve_run_t *restrict run, uint8_t *restrict bytes) { put_16(run, bytes, whole_565, 1); }

static void put_own_444(const resolve_run_t *restrict run, uint8_t *restrict bytes) { put_12(run, bytes, own_444); }

static void put_whole_444(const resolve_run_t *restrict run, uint8_t *restrict bytes) { put_12(run, bytes, whole_444); }

static void put_own_332(const resolve_run_t *restrict run, uint8_t *restrict bytes) { put_8(run, bytes, own_332); }

static void put_whole_332(const resolve_run_t *restrict run, uint8_t *restrict bytes) { put_8(run, bytes, whole_332); }

static void put_whole_666(const resolve_run_t *restrict run, uint8_t *restrict bytes) {
    uint8_t *to = bytes + 3u * pixel_index(run);
    for (uint32_t i = 0; i < run->count; i++, to += 3) {
        const uint32_t value = whole_666(run, i) << 2;
        to[0] = (uint8_t)(value >> 16);
        to[1] = (uint8_t)(value >> 8);
        to[2] = (uint8_t)value;
    }
}

resolve_way_t resolve_colour(pixel_kind_t kind, uint8_t format) {
    const bool own = kind != PIXEL_RGB888;
    switch (format) {
    case TUILE_RGB565_LE: return own ? (resolve_way_t){sum_565_le, put_own_565_le} : (resolve_way_t){sum_888, put_whole_565_le};
    case TUILE_RGB444: return own ? (resolve_way_t){sum_444, put_own_444} : (resolve_way_t){sum_888, put_whole_444};
    case TUILE_RGB332: return own ? (resolve_way_t){sum_332, put_own_332} : (resolve_way_t){sum_888, put_whole_332};
    case TUILE_RGB666: return (resolve_way_t){sum_888, put_whole_666};
    default: return own ? (resolve_way_t){sum_565_be, put_own_565_be} : (resolve_way_t){sum_888, put_whole_565_be};
    }
}
