/* Luminance to wire bytes: grey, and dots. 65535 = 255 * 257 = 15 * 4369, so a step of GREY8 is 257, one of GREY4 4369. */
#include "../tune.h"

#include "sum.h"

TUILE_INLINE uint32_t same(uint32_t sample) { return sample; }

static void sum_luma(const void *samples, size_t stride, resolve_run_t *run) { sum_words(samples, stride, run, same); }

/* The mean of a pixel's samples plus its threshold, in 65535ths of white; sums are at most 16 * 65535, so the numerator is below
 * 2^28 and the result at most 65535 + step - 1. */
TUILE_INLINE uint32_t raised(const resolve_run_t *run, uint32_t i, uint32_t step) {
    return (run->sums[i] * 128u + run->thresholds[i % RESOLVE_MATRIX] * step) >> (7u + 2u * run->shift);
}

static void put_grey8(const resolve_run_t *restrict run, uint8_t *restrict bytes) {
    uint8_t *to = bytes + (size_t)run->y * run->width + run->x;
    for (uint32_t i = 0; i < run->count; i++) {
        const uint32_t x = raised(run, i, 257);
        to[i] = (uint8_t)((x - (x >> 8)) >> 8); /* x / 257: of 257 q + r, q < 256, x >> 8 is q or, for r > 255 - q, q + 1 */
    }
}

/* Rows begin on whole bytes. */
static void put_grey4(const resolve_run_t *restrict run, uint8_t *restrict bytes) {
    uint8_t *to = bytes + (size_t)run->y * ((run->width + 1) / 2) + run->x / 2;
    for (uint32_t i = 0; i < run->count; i++) {
        const uint32_t x = raised(run, i, 4369) * 15u;
        const uint32_t value = (x + 1u + (x >> 16)) >> 16; /* x / 65535, for quotients below 65536 */
        if (i % 2 == 0) {
            to[i / 2] = (uint8_t)(value << 4);
        } else {
            to[i / 2] |= (uint8_t)value;
        }
    }
}

/* ---- dots ---- */

/* White from which sum on: the least with (sum * 128 + threshold * 65535) / (128 * samples) >= 65535. */
static void limits_make(const resolve_run_t *run, uint32_t limits[RESOLVE_MATRIX]) {
    for (unsigned i = 0; i < RESOLVE_MATRIX; i++) {
        limits[i] = (((128u << 2u * run->shift) - run->thresholds[i]) * 65535u + 127u) / 128u;
    }
}

static void put_pages(const resolve_run_t *restrict run, uint8_t *restrict bytes) {
    uint8_t *to = bytes + (size_t)(run->y / 8) * run->width + run->x;
    const unsigned bit = run->y % 8;
    const uint8_t keep = bit == 0 ? 0 : 255;
    uint32_t limits[RESOLVE_MATRIX];
    limits_make(run, limits);
    for (uint32_t i = 0; i < run->count; i++) {
        to[i] = (uint8_t)((to[i] & keep) | (unsigned)(run->sums[i] >= limits[i % RESOLVE_MATRIX]) << bit);
    }
}

static void put_rows(const resolve_run_t *restrict run, uint8_t *restrict bytes) {
    uint8_t *to = bytes + (size_t)run->y * ((run->width + 7) / 8) + run->x / 8;
    uint32_t limits[RESOLVE_MATRIX];
    limits_make(run, limits);
    for (uint32_t i = 0; i < run->count; i += 8) {
        const uint32_t here = run->count - i < 8 ? run->count - i : 8;
        unsigned dots = 0;
        for (uint32_t k = 0; k < here; k++) {
            dots |= (unsigned)(run->sums[i + k] >= limits[k]) << (7 - k);
        }
        to[i / 8] = (uint8_t)dots;
    }
}

resolve_way_t resolve_grey(uint8_t format) {
    switch (format) {
    case TUILE_GREY4: return (resolve_way_t){sum_luma, put_grey4};
    case TUILE_MONO_PAGES: return (resolve_way_t){sum_luma, put_pages};
    case TUILE_MONO_ROWS: return (resolve_way_t){sum_luma, put_rows};
    default: return (resolve_way_t){sum_luma, put_grey8};
    }
}
