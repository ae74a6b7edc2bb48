/* Compiled fonts: a header, glyphs in the order of their code points, bits. All numbers little-endian.
 *
 * A glyph's bits run row by row without gaps, the first of them in bit 7 of its first byte: 5x7 dots take 5 bytes.
 */
#ifndef TUILE_OVERLAY_FONT_H
#define TUILE_OVERLAY_FONT_H

#include "overlay.h"

#define FONT_MAGIC 0x4e465554u /* "TUFN" */
#define FONT_VERSION 1u
#define FONT_HEADER_BYTES 24u
enum {
    FONT_AT_MAGIC = 0,    /* u32 */
    FONT_AT_CRC32 = 4,    /* u32, of all bytes from FONT_AT_VERSION on: model_crc32 */
    FONT_AT_VERSION = 8,  /* u16 */
    FONT_AT_GLYPHS = 10,  /* u16, 1 ... 65535 */
    FONT_AT_SIZE = 12,    /* u32, of all */
    FONT_AT_HEIGHT = 16,  /* u8, 1 ... FONT_BOX_MAX */
    FONT_AT_ASCENT = 17,  /* u8, 0 ... height */
    FONT_AT_ADVANCE = 18, /* u8, of characters without a glyph: 1 ... 255 */
    FONT_AT_ZERO = 19,    /* u8 */
    FONT_AT_BITS = 20,    /* u32, where the bits begin: behind the glyphs */
};

#define FONT_GLYPH_BYTES 12u
enum {
    GLYPH_AT_CODE = 0,    /* u32: bits 0 ... 20 the code point, 24 ... 31 the advance in pixels */
    GLYPH_AT_BITS = 4,    /* u32, from the start of the bits, in bytes */
    GLYPH_AT_LEFT = 8,    /* i8, from the pen to the box */
    GLYPH_AT_TOP = 9,     /* i8, from the top of the line to the box */
    GLYPH_AT_WIDTH = 10,  /* u8, of the box, 0 ... FONT_BOX_MAX; 0: nothing to draw */
    GLYPH_AT_HEIGHT = 11, /* u8; 0 when the width is */
};
#define FONT_BOX_MAX 127u
#define FONT_CODE_MAX 0x10ffffu
#define GLYPH_BIT_BYTES(width, height) (((uint32_t)(width) * (uint32_t)(height) + 7u) / 8u)

/* The glyph of a code point, NULL when there is none. */
const uint8_t *font_glyph(const tuile_font_t *font, uint32_t code);

/* How far a character moves the pen, in dots. */
unsigned font_advance(const tuile_font_t *font, uint32_t code);

#endif
