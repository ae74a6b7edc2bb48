/* Several samples a pixel: sums first, a run at a time, then steps. The number of samples is a constant in each loop of sums.
 *
 * Fields of sums: RGB565 blue from bit 0, red 11, green 21; RGB444 and RGB332 blue 0, green 8, red 16; RGB888 blue 0, red 16, green
 * in a word of its own. Sums of sixteen take four bits more than a sample.
 */
#include "../tune.h"

#include "put.h"

#include "../features.h"

/* ---- sums ---- */

/* Two samples of two bytes, beside one another. */
typedef uint32_t (*sum_pair_fn)(const uint16_t *at);

TUILE_INLINE void sum_pairs_by(resolve_run_t *run, sum_pair_fn pair, unsigned shift) {
    const uint32_t along = 1u << shift;
    const uint16_t *at = run->samples;
    const size_t stride = run->stride;
    for (uint32_t i = 0; i < run->count; i++, at += along) {
        const uint16_t *from = at;
        uint32_t sum = 0;
        for (uint32_t row = 0; row < along; row++, from += stride) {
            sum += pair(from);
            if (along == 4) { sum += pair(from + 2); }
        }
        run->sums[i] = sum;
    }
}

TUILE_INLINE void sum_pairs(resolve_run_t *run, sum_pair_fn pair) {
    if (run->shift == 1) {
        sum_pairs_by(run, pair, 1);
    } else {
        sum_pairs_by(run, pair, 2);
    }
}

/* Of two samples in a word the fields are taken alternately: red and blue of one with green of the other. */
TUILE_INLINE uint32_t pair_565(uint32_t word) { return (word & 0x07e0f81fu) + ((word >> 16 | word << 16) & 0x07e0f81fu); }

TUILE_INLINE uint32_t pair_565_le(const uint16_t *at) { return pair_565(at[0] | (uint32_t)at[1] << 16); }

TUILE_INLINE uint32_t pair_565_be(const uint16_t *at) {
    const uint8_t *byte = (const uint8_t *)at;
    return pair_565((uint32_t)byte[0] << 24 | (uint32_t)byte[1] << 16 | (uint32_t)byte[2] << 8 | byte[3]);
}

TUILE_INLINE uint32_t spread_444(uint32_t sample) { return (sample & 0xf00u) << 8 | (sample & 0xf0u) << 4 | (sample & 0xfu); }

TUILE_INLINE uint32_t pair_444(const uint16_t *at) { return spread_444(at[0]) + spread_444(at[1]); }

TUILE_INLINE uint32_t spread_332(uint32_t sample) { return (sample & 0xe0u) << 11 | (sample & 0x1cu) << 6 | (sample & 3u); }

TUILE_INLINE uint32_t pair_332(const uint16_t *at) { return spread_332(at[0]) + spread_332(at[1]); }

TUILE_INLINE uint32_t pair_luma(const uint16_t *at) { return (uint32_t)at[0] + at[1]; }

static void sum_565_be(resolve_run_t *run) { sum_pairs(run, pair_565_be); }

static void sum_565_le(resolve_run_t *run) { sum_pairs(run, pair_565_le); }

static void sum_444(resolve_run_t *run) { sum_pairs(run, pair_444); }

static void sum_332(resolve_run_t *run) { sum_pairs(run, pair_332); }

static void sum_luma(resolve_run_t *run) { sum_pairs(run, pair_luma); }

TUILE_INLINE void sum_888_by(resolve_run_t *run, unsigned shift) {
    const uint32_t along = 1u << shift;
    const uint32_t *at = run->samples;
    const size_t stride = run->stride;
    for (uint32_t i = 0; i < run->count; i++, at += along) {
        uint32_t others = 0, green = 0;
        for (uint32_t row = 0; row < along; row++) {
            for (uint32_t column = 0; column < along; column++) {
                const uint32_t sample = at[row * stride + column];
                others += sample & 0xff00ffu;
                green += sample & 0xff00u;
            }
        }
        run->sums[i] = others;
        run->green[i] = green >> 8;
    }
}

static void sum_888(resolve_run_t *run) {
    if (run->shift == 1) {
        sum_888_by(run, 1);
    } else {
        sum_888_by(run, 2);
    }
}

/* ---- sums in the format's own steps: all fields at once are rounded and divided; what falls out of one is masked off ---- */

/* ones: 1 in each field. */
TUILE_INLINE uint32_t means(const resolve_run_t *run, uint32_t i, uint32_t ones) {
    return (run->sums[i] + (ones << (2u * run->shift - 1u))) >> 2u * run->shift;
}

TUILE_INLINE uint32_t own_565(const resolve_run_t *run, uint32_t i) {
    const uint32_t x = means(run, i, UINT32_C(1) << 21 | 1u << 11 | 1u);
    return (x & 0xf81fu) | (x >> 16 & 0x7e0u);
}

TUILE_INLINE uint32_t own_444(const resolve_run_t *run, uint32_t i) {
    const uint32_t x = means(run, i, 0x10101u);
    return (x >> 8 & 0xf00u) | (x >> 4 & 0xf0u) | (x & 15u);
}

TUILE_INLINE uint32_t own_332(const resolve_run_t *run, uint32_t i) {
    const uint32_t x = means(run, i, 0x10101u);
    return (x >> 11 & 0xe0u) | (x >> 6 & 0x1cu) | (x & 3u);
}

/* ---- sums of whole components ---- */

/* sum <= 16 * 255, most <= 63: the numerator is below 2^25, its quotient by 128 * samples at most 64 * 255. */
TUILE_INLINE uint32_t steps_of(const resolve_run_t *run, uint32_t i, uint32_t sum, uint32_t most) {
    return pixel_div255((sum * (most * 128u) + put_threshold(run, i) * 255u) >> (7u + 2u * run->shift));
}

TUILE_INLINE uint32_t whole(const resolve_run_t *run, uint32_t i, uint32_t red, uint32_t green, uint32_t blue, unsigned red_at,
                            unsigned green_at) {
    return steps_of(run, i, run->sums[i] >> 16, red) << red_at | steps_of(run, i, run->green[i], green) << green_at |
           steps_of(run, i, run->sums[i] & 0xffffu, blue);
}

TUILE_INLINE uint32_t whole_565(const resolve_run_t *run, uint32_t i) { return whole(run, i, 31, 63, 31, 11, 5); }

TUILE_INLINE uint32_t whole_444(const resolve_run_t *run, uint32_t i) { return whole(run, i, 15, 15, 15, 8, 4); }

TUILE_INLINE uint32_t whole_332(const resolve_run_t *run, uint32_t i) { return whole(run, i, 7, 7, 3, 5, 2); }

TUILE_INLINE uint32_t whole_666(const resolve_run_t *run, uint32_t i) { return whole(run, i, 63, 63, 63, 16, 8); }

TUILE_INLINE uint32_t whole_111(const resolve_run_t *run, uint32_t i) { return whole(run, i, 1, 1, 1, 2, 1); }

/* Components of 8 bits are steps themselves. */
TUILE_INLINE uint32_t mean_8(const resolve_run_t *run, uint32_t i, uint32_t sum) {
    return (sum * 128u + put_threshold(run, i)) >> (7u + 2u * run->shift);
}

TUILE_INLINE uint32_t whole_888(const resolve_run_t *run, uint32_t i) {
    return PIXEL_RGB(mean_8(run, i, run->sums[i] >> 16), mean_8(run, i, run->green[i]), mean_8(run, i, run->sums[i] & 0xffffu));
}

/* ---- luminance ---- */

/* Sums are at most 16 * 65535, so the numerator is below 2^28. */
TUILE_INLINE uint32_t raised(const resolve_run_t *run, uint32_t i, uint32_t step) {
    return (run->sums[i] * 128u + put_threshold(run, i) * step) >> (7u + 2u * run->shift);
}

TUILE_INLINE uint32_t grey8(const resolve_run_t *run, uint32_t i) { return put_grey8(raised(run, i, 257)); }

TUILE_INLINE uint32_t grey4(const resolve_run_t *run, uint32_t i) { return put_grey4(raised(run, i, 4369)); }

TUILE_INLINE uint32_t sum_of(const resolve_run_t *run, uint32_t i) { return run->sums[i]; }

/* ---- into the tile ---- */

#define PUT(name, ...) \
    static void name(const resolve_run_t *restrict run, uint8_t *restrict bytes) { __VA_ARGS__; }
PUT(mean_565_be, put_16(run, bytes, whole_565, 0))
PUT(mean_565_le, put_16(run, bytes, whole_565, 1))
PUT(mean_565_be_own, put_16(run, bytes, own_565, 0))
PUT(mean_565_le_own, put_16(run, bytes, own_565, 1))
PUT(mean_444, put_12(run, bytes, whole_444))
PUT(mean_444_own, put_12(run, bytes, own_444))
PUT(mean_666, put_18(run, bytes, whole_666))
PUT(mean_332, put_8(run, bytes, whole_332))
PUT(mean_332_own, put_8(run, bytes, own_332))
PUT(mean_grey8, put_8(run, bytes, grey8))
PUT(mean_grey4, put_4(run, bytes, grey4))
PUT(mean_pages, put_pages(run, bytes, sum_of, run->shift))
PUT(mean_rows, put_rows(run, bytes, sum_of, run->shift))
PUT(mean_pages_turned, put_pages_turned(run, bytes, sum_of, run->shift))
PUT(mean_grey4_turned, put_4_turned(run, bytes, grey4))
PUT(mean_111, put_3(run, bytes, whole_111))
PUT(mean_1111, put_4(run, bytes, whole_111))
PUT(mean_888, put_little(run, bytes, whole_888, 3))
PUT(mean_8888, put_little(run, bytes, whole_888, 4))

/* A build may have fewer formats. */
#define WAY(format, sum, put) (TUILE_HAS_FORMAT(format) ? (resolve_way_t){sum, put} : (resolve_way_t){NULL, NULL})

resolve_way_t resolve_mean(pixel_kind_t kind, uint8_t format) {
    const bool own = kind != PIXEL_RGB888;
    switch (format) {
    case TUILE_RGB565_LE:
        return own ? WAY(TUILE_RGB565_LE, sum_565_le, mean_565_le_own) : WAY(TUILE_RGB565_LE, sum_888, mean_565_le);
    case TUILE_RGB444: return own ? WAY(TUILE_RGB444, sum_444, mean_444_own) : WAY(TUILE_RGB444, sum_888, mean_444);
    case TUILE_RGB666: return WAY(TUILE_RGB666, sum_888, mean_666);
    case TUILE_RGB332: return own ? WAY(TUILE_RGB332, sum_332, mean_332_own) : WAY(TUILE_RGB332, sum_888, mean_332);
    case TUILE_GREY8: return WAY(TUILE_GREY8, sum_luma, mean_grey8);
    case TUILE_GREY4: return WAY(TUILE_GREY4, sum_luma, mean_grey4);
    case TUILE_MONO_PAGES: return WAY(TUILE_MONO_PAGES, sum_luma, mean_pages);
    case TUILE_MONO_ROWS: return WAY(TUILE_MONO_ROWS, sum_luma, mean_rows);
    case TUILE_MONO_PAGES_TURNED: return WAY(TUILE_MONO_PAGES_TURNED, sum_luma, mean_pages_turned);
    case TUILE_GREY4_TURNED: return WAY(TUILE_GREY4_TURNED, sum_luma, mean_grey4_turned);
    case TUILE_RGB111: return WAY(TUILE_RGB111, sum_888, mean_111);
    case TUILE_XRGB1111: return WAY(TUILE_XRGB1111, sum_888, mean_1111);
    case TUILE_BGR888: return WAY(TUILE_BGR888, sum_888, mean_888);
    case TUILE_XRGB8888: return WAY(TUILE_XRGB8888, sum_888, mean_8888);
    default: return own ? WAY(TUILE_RGB565_BE, sum_565_be, mean_565_be_own) : WAY(TUILE_RGB565_BE, sum_888, mean_565_be);
    }
}
