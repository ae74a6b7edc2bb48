/* Opening a compiled font: nothing in it is believed before it was checked. */
#include "font.h"

#include "../geometry/model.h"

static uint32_t glyph_code(const uint8_t *glyph) { return model_u32(glyph + GLYPH_AT_CODE) & 0x1fffffu; }

static bool check_glyph(const uint8_t *glyph, uint32_t bit_bytes) {
    const uint32_t code = glyph_code(glyph), at = model_u32(glyph + GLYPH_AT_BITS);
    const unsigned width = glyph[GLYPH_AT_WIDTH], height = glyph[GLYPH_AT_HEIGHT];
    return code <= FONT_CODE_MAX && (code < 0xd800u || code > 0xdfffu) && (model_u32(glyph) & 0xe00000u) == 0 &&
           width <= FONT_BOX_MAX && height <= FONT_BOX_MAX && (width == 0) == (height == 0) && at <= bit_bytes &&
           GLYPH_BIT_BYTES(width, height) <= bit_bytes - at;
}

int tuile_font_open(tuile_font_t *font, const void *data, size_t size_bytes) {
    const uint8_t *bytes = data;
    if (font == NULL || bytes == NULL || (uintptr_t)bytes % 4 != 0) { return TUILE_ERROR_ARGUMENT; }
    if (size_bytes < FONT_HEADER_BYTES || size_bytes > UINT32_MAX || model_u32(bytes + FONT_AT_MAGIC) != FONT_MAGIC ||
        model_u16(bytes + FONT_AT_VERSION) != FONT_VERSION || model_u32(bytes + FONT_AT_SIZE) != size_bytes ||
        model_crc32(0, bytes + FONT_AT_VERSION, size_bytes - FONT_AT_VERSION) != model_u32(bytes + FONT_AT_CRC32)) {
        return TUILE_ERROR_FONT;
    }
    const uint32_t count = model_u16(bytes + FONT_AT_GLYPHS), bits = model_u32(bytes + FONT_AT_BITS);
    const uint8_t *glyphs = bytes + FONT_HEADER_BYTES;
    const unsigned height = bytes[FONT_AT_HEIGHT], ascent = bytes[FONT_AT_ASCENT], advance = bytes[FONT_AT_ADVANCE];
    if (count == 0 || height == 0 || height > FONT_BOX_MAX || ascent > height || advance == 0 || bytes[FONT_AT_ZERO] != 0 ||
        bits != FONT_HEADER_BYTES + count * FONT_GLYPH_BYTES || bits > size_bytes) {
        return TUILE_ERROR_FONT;
    }
    int16_t top = 0, bottom = (int16_t)height;
    for (uint32_t i = 0; i < count; i++) {
        const uint8_t *glyph = glyphs + i * FONT_GLYPH_BYTES;
        if (!check_glyph(glyph, (uint32_t)size_bytes - bits) ||
            (i > 0 && glyph_code(glyph) <= glyph_code(glyph - FONT_GLYPH_BYTES))) {
            return TUILE_ERROR_FONT;
        }
        const int16_t first = (int8_t)glyph[GLYPH_AT_TOP], end = (int16_t)(first + glyph[GLYPH_AT_HEIGHT]);
        top = first < top ? first : top;
        bottom = end > bottom ? end : bottom;
    }
    font->top = top;
    font->bottom = bottom;
    font->glyphs = glyphs;
    font->bits = bytes + bits;
    font->glyph_count = (uint16_t)count;
    font->height = (uint8_t)height;
    font->ascent = (uint8_t)ascent;
    font->advance = (uint8_t)advance;
    return TUILE_OK;
}

const uint8_t *font_glyph(const tuile_font_t *font, uint32_t code) {
    uint32_t low = 0, high = font->glyph_count;
    /* Most fonts begin with all of ASCII. */
    const uint32_t guess = code - glyph_code(font->glyphs);
    if (guess < high && glyph_code(font->glyphs + guess * FONT_GLYPH_BYTES) == code) {
        return font->glyphs + guess * FONT_GLYPH_BYTES;
    }
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        const uint8_t *glyph = font->glyphs + middle * FONT_GLYPH_BYTES;
        const uint32_t found = glyph_code(glyph);
        if (found == code) { return glyph; }
        if (found < code) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return NULL;
}

unsigned font_advance(const tuile_font_t *font, uint32_t code) {
    const uint8_t *glyph = font_glyph(font, code);
    return glyph ? glyph[GLYPH_AT_CODE + 3] : font->advance;
}
