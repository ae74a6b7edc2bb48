#include "wire.h"

#include <stdbool.h>

/* How a format lies on the wire: pixels of so many bits one behind the other, the upper bit first; rows in one string or on whole
 * bytes. */
typedef struct wire_format {
    unsigned pixel_bits;
    bool rows_on_bytes;
    unsigned start[3], bits[3]; /* of red, green and blue in a pixel, from its first bit; grey: three times the same */
    unsigned columns, rows;     /* what a tile's place is a multiple of */
} wire_format_t;

/* PAGES and RGB111 are read on their own; turned formats as those that they are when rows and columns are exchanged. */
static const wire_format_t formats[TUILE_FORMAT_COUNT] = {
    [TUILE_RGB565_BE] = {16, false, {0, 5, 11}, {5, 6, 5}, 1, 1}, [TUILE_RGB565_LE] = {16, false, {0, 5, 11}, {5, 6, 5}, 1, 1},
    [TUILE_RGB444] = {12, false, {0, 4, 8}, {4, 4, 4}, 2, 1},     [TUILE_RGB666] = {24, false, {0, 8, 16}, {6, 6, 6}, 1, 1},
    [TUILE_RGB332] = {8, false, {0, 3, 6}, {3, 3, 2}, 1, 1},      [TUILE_GREY8] = {8, false, {0, 0, 0}, {8, 8, 8}, 1, 1},
    [TUILE_GREY4] = {4, true, {0, 0, 0}, {4, 4, 4}, 2, 1},        [TUILE_MONO_PAGES] = {1, true, {0, 0, 0}, {1, 1, 1}, 1, 8},
    [TUILE_MONO_ROWS] = {1, true, {0, 0, 0}, {1, 1, 1}, 8, 1},    [TUILE_RGB111] = {4, false, {0, 1, 2}, {1, 1, 1}, 2, 1},
    [TUILE_XRGB1111] = {4, true, {1, 2, 3}, {1, 1, 1}, 2, 1},     [TUILE_BGR888] = {24, false, {16, 8, 0}, {8, 8, 8}, 1, 1},
    [TUILE_XRGB8888] = {32, false, {16, 8, 0}, {8, 8, 8}, 1, 1},
};

/* The format of the turned picture. */
static uint8_t unturned(uint8_t format) {
    return format == TUILE_MONO_PAGES_TURNED ? TUILE_MONO_PAGES : format == TUILE_GREY4_TURNED ? TUILE_GREY4 : format;
}

static unsigned read_bits(const uint8_t *bytes, size_t first, unsigned count) {
    unsigned value = 0;
    for (size_t bit = first; bit < first + count; bit++) {
        value = value << 1 | ((unsigned)bytes[bit / 8] >> (7 - bit % 8) & 1u);
    }
    return value;
}

static uint8_t widen(unsigned value, unsigned bits) {
    if (bits == 5) { /* to six bits first, which is what the panel's memory holds */
        value = value << 1 | value >> 4;
        bits = 6;
    }
    unsigned wide = value << (8 - bits);
    for (unsigned have = bits; have < 8; have *= 2) {
        wide |= wide >> have;
    }
    return (uint8_t)wide;
}

static size_t tile_bytes(uint8_t format, size_t width, size_t height) {
    const size_t bits = formats[format].pixel_bits;
    if (format == TUILE_MONO_PAGES) { return (height + 7) / 8 * width; }
    return formats[format].rows_on_bytes ? (width * bits + 7) / 8 * height : (width * height * bits + 7) / 8;
}

/* Of a tile `width` pixels wide, whose format is not turned. */
static void pixel(uint8_t *rgb, uint8_t format, const uint8_t *bytes, size_t width, size_t x, size_t y) {
    const wire_format_t *f = &formats[format];
    const size_t row_bits = f->rows_on_bytes ? (width * f->pixel_bits + 7) / 8 * 8 : width * f->pixel_bits;
    size_t first = y * row_bits + x * f->pixel_bits;
    if (format == TUILE_RGB111) { first = first % 8 ? first + 1 : first + 2; } /* two pixels in the lower six bits of a byte */
    uint8_t swapped[2];
    for (unsigned c = 0; c < 3; c++) {
        if (format == TUILE_MONO_PAGES) {
            rgb[c] = bytes[y / 8 * width + x] & 1u << y % 8 ? 255 : 0;
        } else if (format == TUILE_RGB565_LE) {
            swapped[0] = bytes[first / 8 + 1];
            swapped[1] = bytes[first / 8];
            rgb[c] = widen(read_bits(swapped, f->start[c], f->bits[c]), f->bits[c]);
        } else {
            rgb[c] = widen(read_bits(bytes, first + f->start[c], f->bits[c]), f->bits[c]);
        }
    }
}

void wire_unit(uint8_t format, unsigned *columns, unsigned *rows) {
    const wire_format_t *f = &formats[unturned(format)];
    const bool turned = unturned(format) != format;
    *columns = turned ? f->rows : f->columns;
    *rows = turned ? f->columns : f->rows;
}

int wire_paste(const sim_picture_t *picture, uint8_t format, const tuile_tile_t *tile, sim_error_t *error) {
    if (format >= TUILE_FORMAT_COUNT || format == TUILE_FACE_IDS) { return sim_fail(error, "format %u: no pixels", format); }
    const uint8_t upright = unturned(format);
    const bool turned = upright != format;
    const size_t size = turned ? tile_bytes(upright, tile->height, tile->width) : tile_bytes(format, tile->width, tile->height);
    unsigned columns, rows;
    wire_unit(format, &columns, &rows);
    if ((uint32_t)tile->x + tile->width > picture->width || (uint32_t)tile->y + tile->height > picture->height) {
        return sim_fail(error, "a tile of %ux%u at %u,%u reaches out of %ux%u pixels", tile->width, tile->height, tile->x, tile->y,
                        picture->width, picture->height);
    }
    if (tile->size_bytes != size) {
        return sim_fail(error, "a tile of %ux%u has %u bytes, but takes %zu", tile->width, tile->height, tile->size_bytes, size);
    }
    if (tile->x % columns != 0 || tile->y % rows != 0) {
        return sim_fail(error, "a tile at %u,%u begins within a byte", tile->x, tile->y);
    }
    for (unsigned y = 0; y < tile->height; y++) {
        for (unsigned x = 0; x < tile->width; x++) {
            uint8_t *to = sim_picture_at(picture, tile->x + x, tile->y + y);
            pixel(to, upright, tile->bytes, turned ? tile->height : tile->width, turned ? y : x, turned ? x : y);
        }
    }
    return 0;
}
