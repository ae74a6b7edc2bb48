/* From glyphs as BDF has them to a font for flash: boxes are cut to the dots that are set. */
#include "../raster/geometry/model.h"
#include "../raster/overlay/font.h"
#include "font.h"

#include <stdlib.h>
#include <string.h>

static bool dot(const font_source_glyph_t *glyph, int x, int y) {
    const int bytes = (glyph->width + 7) / 8;
    return glyph->rows[y * bytes + x / 8] >> (7 - x % 8) & 1;
}

/* A box of dots within the glyph's. */
typedef struct ink {
    int left, top, right, bottom;
} ink_t;

static ink_t find_ink(const font_source_glyph_t *glyph) {
    ink_t ink = {glyph->width, glyph->height, 0, 0};
    for (int y = 0; y < glyph->height; y++) {
        for (int x = 0; x < glyph->width; x++) {
            if (!dot(glyph, x, y)) { continue; }
            ink.left = x < ink.left ? x : ink.left;
            ink.right = x + 1 > ink.right ? x + 1 : ink.right;
            ink.top = y < ink.top ? y : ink.top;
            ink.bottom = y + 1;
        }
    }
    return ink.right == 0 ? (ink_t){0, 0, 0, 0} : ink;
}

static void put32(uint8_t *to, uint32_t value) {
    for (unsigned i = 0; i < 4; i++) {
        to[i] = (uint8_t)(value >> 8 * i);
    }
}

/* Where the glyphs go, and how many bytes of bits there are by now. */
typedef struct out {
    uint8_t *glyphs, *bits;
    uint32_t bit_bytes;
} out_t;

static int put_glyph(out_t *out, size_t index, const font_source_t *source, const font_source_glyph_t *glyph, sim_error_t *error) {
    const ink_t ink = find_ink(glyph);
    const int width = ink.right - ink.left, height = ink.bottom - ink.top;
    const int left = width ? glyph->left + ink.left : 0, top = width ? source->ascent - glyph->below - glyph->height + ink.top : 0;
    uint8_t *to = out->glyphs + index * FONT_GLYPH_BYTES;
    if (left < -128 || left > 127 || top < -128 || top > 127) {
        return sim_fail(error, "code point %u: its dots begin at %d,%d of the line; -128 to 127 are supported", glyph->code, left,
                        top);
    }
    put32(to + GLYPH_AT_CODE, glyph->code | (uint32_t)glyph->advance << 24);
    put32(to + GLYPH_AT_BITS, out->bit_bytes);
    to[GLYPH_AT_LEFT] = (uint8_t)left;
    to[GLYPH_AT_TOP] = (uint8_t)top;
    to[GLYPH_AT_WIDTH] = (uint8_t)width;
    to[GLYPH_AT_HEIGHT] = (uint8_t)height;
    for (int i = 0; i < width * height; i++) {
        if (dot(glyph, ink.left + i % width, ink.top + i / width)) {
            out->bits[out->bit_bytes + (uint32_t)i / 8] |= (uint8_t)(0x80 >> i % 8);
        }
    }
    out->bit_bytes += GLYPH_BIT_BYTES(width, height);
    return 0;
}

static const font_source_glyph_t *find(const font_source_t *source, uint32_t code) {
    for (size_t i = 0; i < source->count; i++) {
        if (source->glyphs[i].code == code) { return &source->glyphs[i]; }
    }
    return NULL;
}

static bool is_wanted(const font_range_t *ranges, size_t count, uint32_t code) {
    for (size_t i = 0; i < count; i++) {
        if (ranges[i].first <= code && code <= ranges[i].last) { return true; }
    }
    return count == 0;
}

static int check_ranges(const font_source_t *source, const font_range_t *ranges, size_t count, sim_error_t *error) {
    for (size_t i = 0; i < count; i++) {
        if (ranges[i].first == ranges[i].last && !find(source, ranges[i].first)) {
            return sim_fail(error, "the font has no glyph for U+%04X, which is asked for by itself", ranges[i].first);
        }
    }
    return 0;
}

/* Code points of the ranges, each counted once: ranges may overlap. */
static size_t count_asked(const font_range_t *ranges, size_t count) {
    size_t asked = 0;
    for (uint32_t code = 0; count > 0 && code <= FONT_CODE_MAX; code++) {
        asked += is_wanted(ranges, count, code);
    }
    return asked;
}

int font_compile(const font_source_t *source, const font_range_t *ranges, size_t range_count, uint8_t **bytes, size_t *size_bytes,
                 font_report_t *report, sim_error_t *error) {
    size_t count = 0, most = 0;
    *bytes = NULL;
    if (check_ranges(source, ranges, range_count, error) != 0) { return -1; }
    for (size_t i = 0; i < source->count; i++) {
        const font_source_glyph_t *glyph = &source->glyphs[i];
        if (!is_wanted(ranges, range_count, glyph->code)) { continue; }
        count++;
        most += GLYPH_BIT_BYTES(glyph->width, glyph->height);
    }
    if (count == 0) { return sim_fail(error, "the font has no glyph in the range that is asked for"); }
    if (count > UINT16_MAX) { return sim_fail(error, "%zu glyphs; at most %u are supported, see --range", count, UINT16_MAX); }
    const size_t table = FONT_HEADER_BYTES + count * FONT_GLYPH_BYTES;
    uint8_t *font = calloc(1, table + most + 3);
    if (!font) { return sim_fail(error, "out of memory"); }
    out_t out = {font + FONT_HEADER_BYTES, font + table, 0};
    size_t index = 0;
    for (size_t i = 0; i < source->count; i++) {
        if (!is_wanted(ranges, range_count, source->glyphs[i].code)) { continue; }
        if (put_glyph(&out, index++, source, &source->glyphs[i], error) != 0) {
            free(font);
            return -1;
        }
    }
    const size_t size = (table + out.bit_bytes + 3) / 4 * 4; /* whole words: what a C source has sizeof */
    put32(font + FONT_AT_MAGIC, FONT_MAGIC);
    put32(font + FONT_AT_VERSION, FONT_VERSION | (uint32_t)count << 16);
    put32(font + FONT_AT_SIZE, (uint32_t)size);
    put32(font + FONT_AT_HEIGHT,
          (uint32_t)(source->ascent + source->descent) | (uint32_t)source->ascent << 8 | (uint32_t)source->advance << 16);
    put32(font + FONT_AT_BITS, (uint32_t)table);
    put32(font + FONT_AT_CRC32, model_crc32(0, font + FONT_AT_VERSION, size - FONT_AT_VERSION));
    *bytes = font;
    *size_bytes = size;
    if (report) { *report = (font_report_t){count, size, range_count ? count_asked(ranges, range_count) - count : 0}; }
    return 0;
}
