/* From samples to wire bytes, tile by tile, without a scene: packing by hand-made tables, rounding and dithering against exact
 * fractions. */
#include "support/check.h"
#include "support/random.h"

#include "../raster/frame/frame.h"
#include "../raster/resolve/resolve.h"

#define SIDE_MAX 64u /* samples */

typedef struct tile {
    tuile_t t;
    uint32_t samples[SIDE_MAX * SIDE_MAX]; /* of 2 or 4 bytes each */
    uint8_t bytes[SIDE_MAX * SIDE_MAX * 4];
} tile_t;

/* A tile of width x height pixels at (left, top) of the window. */
static void tile_open(tile_t *tile, uint8_t format, uint8_t aa, bool dither, unsigned left, unsigned top, unsigned width,
                      unsigned height) {
    memset(tile, 0, sizeof *tile);
    memset(tile->bytes, 0xee, sizeof tile->bytes);
    tile->t.config.format = tile->t.given.format = format;
    tile->t.given.dither = dither;
    tile->t.samples = aa;
    tile->t.pixel_kind = (uint8_t)pixel_kind_of(format, dither);
    tile->t.working = tile->samples;
    tile->t.colours[0] = tile->bytes;
    tile->t.tile.left = (int32_t)(left << aa);
    tile->t.tile.top = (int32_t)(top << aa);
    tile->t.tile.right = (int32_t)((left + width) << aa);
    tile->t.tile.bottom = (int32_t)((top + height) << aa);
    tile->t.tile.stride_px = (int32_t)(width << aa);
}

static void tile_set(tile_t *tile, unsigned x, unsigned y, uint32_t sample) {
    const size_t index = (size_t)y * (size_t)tile->t.tile.stride_px + x;
    if (pixel_bytes((pixel_kind_t)tile->t.pixel_kind) == 4) {
        tile->samples[index] = sample;
    } else {
        ((uint16_t *)(void *)tile->samples)[index] = (uint16_t)sample;
    }
}

static void tile_fill(tile_t *tile, uint32_t sample) {
    const unsigned width = (unsigned)tile->t.tile.stride_px, height = (unsigned)(tile->t.tile.bottom - tile->t.tile.top);
    for (unsigned y = 0; y < height; y++) {
        for (unsigned x = 0; x < width; x++) {
            tile_set(tile, x, y, sample);
        }
    }
}

static bool is_mono(unsigned format) {
    return format == TUILE_MONO_PAGES || format == TUILE_MONO_PAGES_TURNED || format == TUILE_MONO_ROWS;
}

static bool is_colour(unsigned format) { return format < TUILE_GREY8 || format >= TUILE_RGB111; }

/* Do pixels of one row share bytes? */
static bool shares_bytes(unsigned format) {
    return format == TUILE_RGB444 || format == TUILE_GREY4 || format == TUILE_MONO_ROWS || format == TUILE_MONO_PAGES_TURNED ||
           format == TUILE_RGB111 || format == TUILE_XRGB1111;
}

/* ---- the matrix ---- */

static void the_matrix_is_bayers(void **state) {
    static const uint8_t expected[8][8] = {
        {0, 32, 8, 40, 2, 34, 10, 42},    {48, 16, 56, 24, 50, 18, 58, 26}, {12, 44, 4, 36, 14, 46, 6, 38},
        {60, 28, 52, 20, 62, 30, 54, 22}, {3, 35, 11, 43, 1, 33, 9, 41},    {51, 19, 59, 27, 49, 17, 57, 25},
        {15, 47, 7, 39, 13, 45, 5, 37},   {63, 31, 55, 23, 61, 29, 53, 21},
    };
    (void)state;
    for (unsigned y = 0; y < 24; y++) {
        for (unsigned x = 0; x < 24; x++) {
            assert_int_equal(resolve_bayer(x, y), expected[y % 8][x % 8]);
        }
    }
}

/* ---- bytes of each format, by hand ---- */

typedef struct packing {
    uint8_t format;
    unsigned width, height;
    uint32_t samples[18];
    uint8_t bytes[16];
    unsigned count;
} packing_t;

static void pixels_are_packed_as_the_header_says(void **state) {
    static const packing_t packings[] = {
        {TUILE_RGB444, 2, 1, {0x123, 0x456}, {0x12, 0x34, 0x56}, 3},
        /* One string of pixels, whatever the width; the last half byte is 0. */
        {TUILE_RGB444, 3, 1, {0x123, 0x456, 0x789}, {0x12, 0x34, 0x56, 0x78, 0x90}, 5},
        {TUILE_RGB444, 1, 3, {0xabc, 0xdef, 0xfed}, {0xab, 0xcd, 0xef, 0xfe, 0xd0}, 5},
        {TUILE_RGB444, 3, 2, {0x111, 0x222, 0x333, 0x444, 0x555, 0x666}, {0x11, 0x12, 0x22, 0x33, 0x34, 0x44, 0x55, 0x56, 0x66}, 9},
        /* Six bits, in the upper part of a byte: 0, 255 and 128 * 63 / 255 = 31.6. */
        {TUILE_RGB666, 2, 1, {0xff0080, 0x800000}, {0xfc, 0x00, 32 << 2, 32 << 2, 0, 0}, 6},
        {TUILE_RGB332, 3, 1, {0xe0, 0x1c, 0x03}, {0xe0, 0x1c, 0x03}, 3},
        {TUILE_GREY8, 3, 1, {0, 65535, 257 * 100}, {0, 255, 100}, 3},
        {TUILE_GREY4, 2, 1, {65535, 0}, {0xf0}, 1},
        /* Rows begin on whole bytes. */
        {TUILE_GREY4, 3, 2, {4369, 2 * 4369, 3 * 4369, 4 * 4369, 5 * 4369, 6 * 4369}, {0x12, 0x30, 0x45, 0x60}, 4},
        {TUILE_MONO_PAGES, 2, 8, {65535, 0, 0, 0, 0, 65535, 65535, 0, 0, 0, 0, 0, 0, 0, 65535, 65535}, {0x89, 0x84}, 2},
        {TUILE_MONO_PAGES, 1, 9, {0, 0, 0, 0, 0, 0, 0, 65535, 65535}, {0x80, 0x01}, 2},
        {TUILE_MONO_PAGES, 3, 3, {65535, 65535, 0, 0, 65535, 0, 0, 65535, 65535}, {0x01, 0x07, 0x04}, 3},
        {TUILE_MONO_ROWS, 8, 1, {65535, 0, 0, 0, 0, 0, 65535, 0}, {0x82}, 1},
        {TUILE_MONO_ROWS, 9, 1, {0, 65535, 0, 0, 0, 0, 0, 0, 65535}, {0x40, 0x80}, 2},
        {TUILE_MONO_ROWS, 3, 2, {65535, 0, 65535, 0, 65535, 0}, {0xa0, 0x40}, 2},
        /* Columns of eight beside one another, the left one in bit 0; bytes run down. */
        {TUILE_MONO_PAGES_TURNED, 8, 1, {65535, 0, 0, 0, 0, 0, 65535, 0}, {0x41}, 1},
        {TUILE_MONO_PAGES_TURNED, 2, 3, {65535, 0, 65535, 65535, 0, 65535}, {0x01, 0x03, 0x02}, 3},
        {TUILE_MONO_PAGES_TURNED,
         9,
         2,
         {65535, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 65535, 65535},
         {0x01, 0x80, 0x00, 0x01},
         4},
        /* Columns begin on whole bytes. */
        {TUILE_GREY4_TURNED, 1, 2, {65535, 0}, {0xf0}, 1},
        {TUILE_GREY4_TURNED, 2, 3, {4369, 2 * 4369, 3 * 4369, 4 * 4369, 5 * 4369, 6 * 4369}, {0x13, 0x50, 0x24, 0x60}, 4},
        /* One string: 100 010, 001 111, 000 011; 127 is below one half and 128 above. */
        {TUILE_RGB111, 3, 2, {0xff0000, 0x00ff00, 0x0000ff, 0xffffff, 0x000000, 0x00ffff}, {0x22, 0x0f, 0x03}, 3},
        {TUILE_RGB111, 3, 1, {0x807f80, 0x7f807f, 0x7f7f80}, {0x2a, 0x08}, 2},
        {TUILE_XRGB1111, 3, 2, {0xff0000, 0x00ff00, 0x0000ff, 0xffffff, 0xffff00, 0x000000}, {0x42, 0x10, 0x76, 0x00}, 4},
        {TUILE_XRGB1111, 2, 1, {0x807f80, 0x7f807f}, {0x52}, 1},
        {TUILE_BGR888, 2, 1, {0x123456, 0xabcdef}, {0x56, 0x34, 0x12, 0xef, 0xcd, 0xab}, 6},
        {TUILE_XRGB8888, 2, 1, {0x123456, 0xabcdef}, {0x56, 0x34, 0x12, 0x00, 0xef, 0xcd, 0xab, 0x00}, 8},
    };
    static tile_t tile;
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(packings); i++) {
        const packing_t *p = &packings[i];
        tile_open(&tile, p->format, TUILE_AA_NONE, is_mono(p->format), 0, 0, p->width, p->height);
        for (unsigned k = 0; k < p->width * p->height; k++) {
            tile_set(&tile, k % p->width, k / p->width, p->samples[k]);
        }
        resolve_tile(&tile.t);
        assert_int_equal(TUILE_WIRE_BYTES(p->format, p->width, p->height), p->count);
        if (memcmp(tile.bytes, p->bytes, p->count) != 0) { fail_msg("packing %u", i); }
        assert_int_equal(tile.bytes[p->count], 0xee);
    }
}

/* Samples of 565 are the wire's own bytes; here through the mean of four that are equal. */
static void rgb565_has_the_byte_order_of_its_format(void **state) {
    static tile_t tile;
    (void)state;
    for (unsigned dither = 0; dither < 2; dither++) {
        for (unsigned format = TUILE_RGB565_BE; format <= TUILE_RGB565_LE; format++) {
            const unsigned low = format == TUILE_RGB565_BE;
            tile_open(&tile, (uint8_t)format, TUILE_AA_2X2, dither, 0, 0, 1, 1);
            /* Red 31, green 0, blue 31: 0xf81f. */
            tile_fill(&tile, dither ? 0xff00ffu : low ? 0x1ff8u : 0xf81fu);
            resolve_tile(&tile.t);
            assert_int_equal(tile.bytes[low], 0x1f);
            assert_int_equal(tile.bytes[1 - low], 0xf8);
            assert_int_equal(tile.bytes[2], 0xee);
        }
    }
}

static void pixel_by_pixel_a_long_row_is_the_same_as_short_ones(void **state) {
    static tile_t whole, part;
    random_source_t random = random_seed(11);
    (void)state;
    for (unsigned format = TUILE_RGB444; format < TUILE_FORMAT_COUNT; format++) {
        const bool dither = is_mono(format);
        if (shares_bytes(format)) { continue; }
        tile_open(&whole, (uint8_t)format, 0, dither, 3, 8, 61, 1);
        const size_t bytes = TUILE_WIRE_BYTES(format, 1u, 1u);
        uint32_t samples[61];
        for (unsigned x = 0; x < 61; x++) {
            samples[x] = (uint32_t)random_between(&random, 0, format == TUILE_RGB332 ? 255 : is_colour(format) ? 0xffffff : 65535);
            tile_set(&whole, x, 0, samples[x]);
        }
        resolve_tile(&whole.t);
        for (unsigned x = 0; x < 61; x++) {
            tile_open(&part, (uint8_t)format, 0, dither, 3 + x, 8, 1, 1);
            tile_set(&part, 0, 0, samples[x]);
            resolve_tile(&part.t);
            assert_memory_equal(part.bytes, whole.bytes + bytes * x, bytes);
        }
    }
}

/* ---- a pixel as steps ---- */

/* Components of pixel (x, y) of a resolved tile: their steps. */
static void steps_at(const tile_t *tile, unsigned x, unsigned y, unsigned steps[3]) {
    const size_t width = (size_t)tile->t.tile.stride_px >> tile->t.samples, index = y * width + x;
    const size_t height = (size_t)(tile->t.tile.bottom - tile->t.tile.top) >> tile->t.samples;
    const uint8_t *b = tile->bytes;
    unsigned value;
    switch (tile->t.config.format) {
    case TUILE_RGB565_BE:
    case TUILE_RGB565_LE:
        value = b[2 * index] | (unsigned)b[2 * index + 1] << 8;
        if (tile->t.config.format == TUILE_RGB565_BE) { value = (value >> 8 | value << 8) & 0xffff; }
        steps[0] = value >> 11, steps[1] = value >> 5 & 63, steps[2] = value & 31;
        break;
    case TUILE_RGB444: {
        const uint8_t *pair = b + index / 2 * 3;
        value = index % 2 ? (pair[1] & 15u) << 8 | pair[2] : (unsigned)pair[0] << 4 | pair[1] >> 4;
        steps[0] = value >> 8, steps[1] = value >> 4 & 15, steps[2] = value & 15;
        break;
    }
    case TUILE_RGB666:
        for (unsigned i = 0; i < 3; i++) {
            assert_int_equal(b[3 * index + i] & 3, 0);
            steps[i] = b[3 * index + i] >> 2;
        }
        break;
    case TUILE_RGB332: steps[0] = b[index] >> 5, steps[1] = b[index] >> 2 & 7, steps[2] = b[index] & 3; break;
    case TUILE_GREY8: steps[0] = b[index]; break;
    case TUILE_GREY4: steps[0] = b[y * ((width + 1) / 2) + x / 2] >> (x % 2 ? 0 : 4) & 15; break;
    case TUILE_GREY4_TURNED: steps[0] = b[x * ((height + 1) / 2) + y / 2] >> (y % 2 ? 0 : 4) & 15; break;
    case TUILE_MONO_PAGES: steps[0] = b[y / 8 * width + x] >> y % 8 & 1; break;
    case TUILE_MONO_PAGES_TURNED: steps[0] = b[x / 8 * height + y] >> x % 8 & 1; break;
    case TUILE_RGB111:
        assert_int_equal(b[index / 2] >> 6, 0);
        for (unsigned i = 0; i < 3; i++) {
            steps[i] = b[index / 2] >> (index % 2 ? 2 - i : 5 - i) & 1;
        }
        break;
    case TUILE_XRGB1111:
        value = b[y * ((width + 1) / 2) + x / 2] >> (x % 2 ? 0 : 4) & 15;
        steps[0] = value >> 2, steps[1] = value >> 1 & 1, steps[2] = value & 1;
        break;
    case TUILE_BGR888: steps[0] = b[3 * index + 2], steps[1] = b[3 * index + 1], steps[2] = b[3 * index]; break;
    case TUILE_XRGB8888:
        assert_int_equal(b[4 * index + 3], 0);
        steps[0] = b[4 * index + 2], steps[1] = b[4 * index + 1], steps[2] = b[4 * index];
        break;
    default: steps[0] = b[y * ((width + 7) / 8) + x / 8] >> (7 - x % 8) & 1; break;
    }
}

/* Greatest steps of the components. */
static const unsigned *most_of(uint8_t format) {
    static const unsigned most[TUILE_FORMAT_COUNT][3] = {
        [TUILE_RGB565_BE] = {31, 63, 31},
        [TUILE_RGB565_LE] = {31, 63, 31},
        [TUILE_RGB444] = {15, 15, 15},
        [TUILE_RGB666] = {63, 63, 63},
        [TUILE_RGB332] = {7, 7, 3},
        [TUILE_GREY8] = {255},
        [TUILE_GREY4] = {15},
        [TUILE_MONO_PAGES] = {1},
        [TUILE_MONO_ROWS] = {1},
        [TUILE_MONO_PAGES_TURNED] = {1},
        [TUILE_GREY4_TURNED] = {15},
        [TUILE_RGB111] = {1, 1, 1},
        [TUILE_XRGB1111] = {1, 1, 1},
        [TUILE_BGR888] = {255, 255, 255},
        [TUILE_XRGB8888] = {255, 255, 255},
    };
    return most[format];
}

/* ---- dithering ---- */

/* All values of a component (the others have other values, so that none takes another's place), 8x8 pixels. */
static void dither_values(uint8_t format, uint8_t aa, unsigned left, unsigned top, uint32_t step) {
    static tile_t tile;
    const uint32_t full = is_colour(format) ? 255 : 65535;
    const unsigned components = is_colour(format) ? 3 : 1, *most = most_of(format);
    unsigned before[64][3];
    memset(before, 0, sizeof before);
    tile_open(&tile, format, aa, true, left, top, 8, 8);
    for (uint32_t value = 0; value <= full; value += step) {
        const uint32_t values[3] = {value, components == 1 ? 0 : full - value, components == 1 ? 0 : (value * 7) % 256};
        uint64_t sums[3] = {0};
        tile_fill(&tile, components == 1 ? value : PIXEL_RGB(values[0], values[1], values[2]));
        resolve_tile(&tile.t);
        for (unsigned i = 0; i < 64; i++) {
            unsigned steps[3] = {0};
            steps_at(&tile, i % 8, i / 8, steps);
            for (unsigned c = 0; c < components; c++) {
                sums[c] += steps[c];
                if (values[c] == full) { assert_int_equal(steps[c], most[c]); }
                if (values[c] == 0) { assert_int_equal(steps[c], 0); }
            }
            assert_true(steps[0] >= before[i][0]); /* monotone; the second component falls */
            assert_true(value == 0 || components == 1 || steps[1] <= before[i][1]);
            memcpy(before[i], steps, sizeof steps);
        }
        /* |sum / 64 - value * most / full| <= 1 / 128 */
        for (unsigned c = 0; c < components; c++) {
            const int64_t off = 2 * ((int64_t)(sums[c] * full) - (int64_t)64 * values[c] * most[c]);
            if (off > (int64_t)full || off < -(int64_t)full) { fail_msg("format %u, %u: component %u", format, value, c); }
        }
    }
}

static void the_mean_of_a_dithered_block_is_within_a_128th_of_a_step(void **state) {
    (void)state;
    for (unsigned format = 0; format < TUILE_FORMAT_COUNT; format++) {
        if (format == TUILE_FACE_IDS) { continue; }
        dither_values((uint8_t)format, TUILE_AA_NONE, 0, 0, CHECK_SANITIZED && !is_colour(format) ? 15 : 1);
        dither_values((uint8_t)format, TUILE_AA_NONE, 13, 40,
                      is_colour(format) ? 1 : 51); /* any 8x8 pixels, not only aligned ones */
        dither_values((uint8_t)format, TUILE_AA_2X2, 0, 0, is_colour(format) ? 3 : 255);
        dither_values((uint8_t)format, TUILE_AA_4X4, 5, 1, is_colour(format) ? 3 : 255);
    }
}

/* ---- one rounding ---- */

/* The pixel is the floor of the exact mean plus its threshold. full: greatest value of a sample; 0: of each component its most. */
static void pixel_check(const tile_t *tile, unsigned x, unsigned y, const uint64_t sums[3], uint32_t full) {
    const unsigned components = is_colour(tile->t.config.format) ? 3 : 1, *most = most_of(tile->t.config.format);
    const unsigned left = (unsigned)tile->t.tile.left >> tile->t.samples, top = (unsigned)tile->t.tile.top >> tile->t.samples;
    const uint64_t threshold = tile->t.given.dither ? 2 * resolve_bayer(left + x, top + y) + 1 : 64;
    unsigned steps[3];
    steps_at(tile, x, y, steps);
    for (unsigned c = 0; c < components; c++) {
        const uint64_t whole = full != 0 ? full : most[c];
        const uint64_t below = whole << 2 * tile->t.samples;
        assert_int_equal(steps[c], (sums[c] * most[c] * 128 + threshold * below) / (128 * below));
    }
}

static void random_tile(uint8_t format, uint8_t aa, bool dither, random_source_t *random) {
    static tile_t tile;
    const unsigned width = (unsigned)random_between(random, 1, (int)(SIDE_MAX >> aa)),
                   height = (unsigned)random_between(random, 1, 8);
    tile_open(&tile, format, aa, dither, (unsigned)random_between(random, 0, 900), 8 * (unsigned)random_between(random, 0, 100),
              width, height);
    const pixel_kind_t kind = (pixel_kind_t)tile.t.pixel_kind;
    uint64_t sums[SIDE_MAX * 8][3];
    memset(sums, 0, sizeof sums);
    const int contrast = random_between(random, 0, 3); /* 0: full values only, as extreme sums */
    for (unsigned y = 0; y < height << aa; y++) {
        for (unsigned x = 0; x < width << aa; x++) {
            const unsigned red = contrast ? (unsigned)random_between(random, 0, 255) : 255,
                           green = contrast ? (unsigned)random_between(random, 0, 255) : 255,
                           blue = contrast ? (unsigned)random_between(random, 0, 255) : 255;
            uint64_t *sum = sums[(y >> aa) * width + (x >> aa)];
            uint32_t r = red, g = green, b = blue, sample = PIXEL_RGB(red, green, blue);
            if (kind == PIXEL_LUMA16) {
                sample = r = red << 8 | green;
            } else if (kind == PIXEL_RGB444) {
                r = red >> 4, g = green >> 4, b = blue >> 4;
                sample = r << 8 | g << 4 | b;
            } else if (kind == PIXEL_RGB332) {
                r = red >> 5, g = green >> 5, b = blue >> 6;
                sample = r << 5 | g << 2 | b;
            } else if (kind == PIXEL_RGB565_BE || kind == PIXEL_RGB565_LE) {
                r = red >> 3, g = green >> 2, b = blue >> 3;
                sample = r << 11 | g << 5 | b;
                if (kind == PIXEL_RGB565_BE) { sample = (sample >> 8 | sample << 8) & 0xffff; }
            }
            tile_set(&tile, x, y, sample);
            sum[0] += r, sum[1] += g, sum[2] += b;
        }
    }
    resolve_tile(&tile.t);
    for (unsigned i = 0; i < width * height; i++) {
        pixel_check(&tile, i % width, i / width, sums[i], kind == PIXEL_LUMA16 ? 65535 : kind == PIXEL_RGB888 ? 255 : 0);
    }
    assert_int_equal(tile.bytes[TUILE_WIRE_BYTES(format, width, height)], 0xee);
}

static void samples_are_added_exactly_and_rounded_once(void **state) {
    random_source_t random = random_seed(5);
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(200u); round++) {
        for (unsigned format = 0; format < TUILE_FORMAT_COUNT; format++) {
            for (unsigned aa = 0; aa < 3; aa++) {
                const bool drawn_in_place = aa == 0 && format <= TUILE_RGB565_LE;
                if (format == TUILE_FACE_IDS) { continue; }
                if (!is_mono(format) && !drawn_in_place) { random_tile((uint8_t)format, (uint8_t)aa, false, &random); }
                random_tile((uint8_t)format, (uint8_t)aa, true, &random);
            }
        }
    }
}

/* All values of a component whose samples are whole, without dithering: floor(value * most / 255 + 1/2), whose remainder is never
 * one half, since 255 is odd. */
static void without_dithering_components_go_to_the_nearest_step(void **state) {
    static tile_t tile;
    (void)state;
    for (unsigned format = TUILE_RGB666; format < TUILE_FORMAT_COUNT; format++) {
        if (pixel_kind_of((uint8_t)format, false) != PIXEL_RGB888) { continue; }
        const unsigned *most = most_of((uint8_t)format);
        for (unsigned i = 0; i < 3 * 256; i++) {
            const unsigned value = i / 3, values[3] = {value, 255 - value, value * 7 % 256};
            tile_open(&tile, (uint8_t)format, (uint8_t)(i % 3), false, 5, 3, 3, 2);
            tile_fill(&tile, PIXEL_RGB(values[0], values[1], values[2]));
            resolve_tile(&tile.t);
            for (unsigned k = 0; k < 6; k++) {
                unsigned steps[3];
                steps_at(&tile, k % 3, k / 3, steps);
                for (unsigned c = 0; c < 3; c++) {
                    assert_int_equal(steps[c], (2 * values[c] * most[c] + 255) / 510);
                }
            }
        }
    }
}

/* ---- turned ---- */

/* Two formats of one kind of sample hold the same steps at each pixel, wherever the tile lies: the matrix does not turn. */
static void same_steps(uint8_t format, uint8_t other, random_source_t *random) {
    static tile_t tiles[2];
    const uint8_t aa = (uint8_t)random_between(random, 0, 2);
    const bool dither = is_mono(format) || random_between(random, 0, 1) != 0;
    const unsigned width = (unsigned)random_between(random, 1, (int)(SIDE_MAX >> aa)),
                   height = (unsigned)random_between(random, 1, 16);
    const unsigned left = (unsigned)random_between(random, 0, 100), top = (unsigned)random_between(random, 0, 100);
    tile_open(&tiles[0], format, aa, dither, left, top, width, height);
    tile_open(&tiles[1], other, aa, dither, left, top, width, height);
    assert_int_equal(tiles[0].t.pixel_kind, tiles[1].t.pixel_kind);
    for (unsigned y = 0; y < height << aa; y++) {
        for (unsigned x = 0; x < width << aa; x++) {
            const uint32_t sample = (uint32_t)(random_bits(random) & (is_colour(format) ? 0xffffff : 0xffff));
            tile_set(&tiles[0], x, y, sample);
            tile_set(&tiles[1], x, y, sample);
        }
    }
    resolve_tile(&tiles[0].t);
    resolve_tile(&tiles[1].t);
    for (unsigned i = 0; i < width * height; i++) {
        unsigned steps[2][3] = {{0}};
        steps_at(&tiles[0], i % width, i / width, steps[0]);
        steps_at(&tiles[1], i % width, i / width, steps[1]);
        assert_memory_equal(steps[0], steps[1], sizeof steps[0]);
    }
}

static void turned_pixels_are_those_of_the_upright_format(void **state) {
    static const uint8_t pairs[][2] = {{TUILE_MONO_PAGES, TUILE_MONO_PAGES_TURNED},
                                       {TUILE_MONO_ROWS, TUILE_MONO_PAGES_TURNED},
                                       {TUILE_GREY4, TUILE_GREY4_TURNED},
                                       {TUILE_RGB111, TUILE_XRGB1111},
                                       {TUILE_BGR888, TUILE_XRGB8888}};
    random_source_t random = random_seed(29);
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(200u); round++) {
        for (unsigned i = 0; i < CHECK_COUNT(pairs); i++) {
            same_steps(pairs[i][0], pairs[i][1], &random);
        }
    }
}

/* ---- luminance ---- */

static void grey_is_the_weighted_sum_of_the_components(void **state) {
    random_source_t random = random_seed(77);
    (void)state;
    for (unsigned grey = 0; grey < 256; grey++) {
        assert_int_equal(pixel_pack(PIXEL_LUMA16, grey * 0x010101u), grey * 257);
        assert_int_equal(pixel_unpack(PIXEL_LUMA16, grey * 257), grey * 0x010101u);
    }
    for (unsigned i = 0; i < 100000; i++) {
        const uint32_t rgb = (uint32_t)(random_bits(&random) & 0xffffff);
        const double exact = 257.0 * (0.2126 * (rgb >> 16) + 0.7152 * (rgb >> 8 & 255) + 0.0722 * (rgb & 255));
        const double off = pixel_pack(PIXEL_LUMA16, rgb) - exact;
        if (off > 0.85 || off < -0.85) { fail_msg("%06x: %g", rgb, off); } /* a rounding, and weights in 65536ths */
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_matrix_is_bayers),
        cmocka_unit_test(pixels_are_packed_as_the_header_says),
        cmocka_unit_test(rgb565_has_the_byte_order_of_its_format),
        cmocka_unit_test(pixel_by_pixel_a_long_row_is_the_same_as_short_ones),
        cmocka_unit_test(the_mean_of_a_dithered_block_is_within_a_128th_of_a_step),
        cmocka_unit_test(samples_are_added_exactly_and_rounded_once),
        cmocka_unit_test(without_dithering_components_go_to_the_nearest_step),
        cmocka_unit_test(turned_pixels_are_those_of_the_upright_format),
        cmocka_unit_test(grey_is_the_weighted_sum_of_the_components),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
