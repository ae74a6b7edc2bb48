/* One sample a pixel. */
#include "../tune.h"

#include "put.h"

#include "../features.h"

TUILE_INLINE uint32_t sample_16(const resolve_run_t *run, uint32_t i) { return ((const uint16_t *)run->samples)[i]; }

/* floor(value * most / 255 + threshold / 128) by one product, for value <= 255 and most <= 63. The factor is too large by less than
 * 1 / 2^23, the result before the shift by less than 255 / 2^23 of a step, and fractions short of a whole step are so by
 * 1 / (255 * 128) at least, which is more. The sum is below 64 * 2^23. */
TUILE_INLINE uint32_t steps_of(uint32_t value, uint32_t most, uint32_t threshold) {
    return (value * ((most * 0x800000u + 254u) / 255u) + (threshold << 16)) >> 23;
}

TUILE_INLINE uint32_t whole(const resolve_run_t *run, uint32_t i, uint32_t red, uint32_t green, uint32_t blue, unsigned red_at,
                            unsigned green_at) {
    const uint32_t sample = ((const uint32_t *)run->samples)[i], threshold = put_threshold(run, i);
    return steps_of(sample >> 16, red, threshold) << red_at | steps_of(sample >> 8 & 255u, green, threshold) << green_at |
           steps_of(sample & 255u, blue, threshold);
}

TUILE_INLINE uint32_t whole_565(const resolve_run_t *run, uint32_t i) { return whole(run, i, 31, 63, 31, 11, 5); }

TUILE_INLINE uint32_t whole_444(const resolve_run_t *run, uint32_t i) { return whole(run, i, 15, 15, 15, 8, 4); }

TUILE_INLINE uint32_t whole_332(const resolve_run_t *run, uint32_t i) { return whole(run, i, 7, 7, 3, 5, 2); }

TUILE_INLINE uint32_t whole_666(const resolve_run_t *run, uint32_t i) { return whole(run, i, 63, 63, 63, 16, 8); }

TUILE_INLINE uint32_t whole_111(const resolve_run_t *run, uint32_t i) { return whole(run, i, 1, 1, 1, 2, 1); }

/* Components of 8 bits are whole steps, which no threshold moves. */
TUILE_INLINE uint32_t sample_32(const resolve_run_t *run, uint32_t i) { return ((const uint32_t *)run->samples)[i]; }

/* At most 65535 + (127 * step >> 7). */
TUILE_INLINE uint32_t raised(const resolve_run_t *run, uint32_t i, uint32_t step) {
    return (sample_16(run, i) * 128u + put_threshold(run, i) * step) >> 7;
}

TUILE_INLINE uint32_t grey8(const resolve_run_t *run, uint32_t i) { return put_grey8(raised(run, i, 257)); }

TUILE_INLINE uint32_t grey4(const resolve_run_t *run, uint32_t i) { return put_grey4(raised(run, i, 4369)); }

#define PUT(name, ...) \
    static void name(const resolve_run_t *restrict run, uint8_t *restrict bytes) { __VA_ARGS__; }
PUT(single_565_be, put_16(run, bytes, whole_565, 0))
PUT(single_565_le, put_16(run, bytes, whole_565, 1))
PUT(single_444, put_12(run, bytes, whole_444))
PUT(single_444_own, put_12(run, bytes, sample_16))
PUT(single_666, put_18(run, bytes, whole_666))
PUT(single_332, put_8(run, bytes, whole_332))
PUT(single_332_own, put_8(run, bytes, sample_16))
PUT(single_grey8, put_8(run, bytes, grey8))
PUT(single_grey4, put_4(run, bytes, grey4))
PUT(single_pages, put_pages(run, bytes, sample_16, 0))
PUT(single_rows, put_rows(run, bytes, sample_16, 0))
PUT(single_pages_turned, put_pages_turned(run, bytes, sample_16, 0))
PUT(single_grey4_turned, put_4_turned(run, bytes, grey4))
PUT(single_111, put_3(run, bytes, whole_111))
PUT(single_1111, put_4(run, bytes, whole_111))
PUT(single_888, put_little(run, bytes, sample_32, 3))
PUT(single_8888, put_little(run, bytes, sample_32, 4))

/* A build may have fewer formats. */
#define WAY(format, put) ((resolve_way_t){NULL, TUILE_HAS_FORMAT(format) ? (put) : NULL})

resolve_way_t resolve_single(pixel_kind_t kind, uint8_t format) {
    const bool own = kind != PIXEL_RGB888;
    switch (format) {
    case TUILE_RGB565_LE: return WAY(TUILE_RGB565_LE, single_565_le);
    case TUILE_RGB444: return WAY(TUILE_RGB444, own ? single_444_own : single_444);
    case TUILE_RGB666: return WAY(TUILE_RGB666, single_666);
    case TUILE_RGB332: return WAY(TUILE_RGB332, own ? single_332_own : single_332);
    case TUILE_GREY8: return WAY(TUILE_GREY8, single_grey8);
    case TUILE_GREY4: return WAY(TUILE_GREY4, single_grey4);
    case TUILE_MONO_PAGES: return WAY(TUILE_MONO_PAGES, single_pages);
    case TUILE_MONO_ROWS: return WAY(TUILE_MONO_ROWS, single_rows);
    case TUILE_MONO_PAGES_TURNED: return WAY(TUILE_MONO_PAGES_TURNED, single_pages_turned);
    case TUILE_GREY4_TURNED: return WAY(TUILE_GREY4_TURNED, single_grey4_turned);
    case TUILE_RGB111: return WAY(TUILE_RGB111, single_111);
    case TUILE_XRGB1111: return WAY(TUILE_XRGB1111, single_1111);
    case TUILE_BGR888: return WAY(TUILE_BGR888, single_888);
    case TUILE_XRGB8888: return WAY(TUILE_XRGB8888, single_8888);
    default: return WAY(TUILE_RGB565_BE, single_565_be);
    }
}
