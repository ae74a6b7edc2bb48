/* How a colour stands in a tile while it is drawn. Tiles whose samples are the wire's own bytes are drawn in them; all others are
 * resolved (resolve/resolve.h). */
#ifndef TUILE_PIXEL_H
#define TUILE_PIXEL_H

#include "fixed.h"
#include "tuile.h"

typedef enum pixel_kind {
    PIXEL_RGB565_BE, /* 2 bytes, as on the wire */
    PIXEL_RGB565_LE,
    PIXEL_RGB444, /* 2 bytes, a number: 0x0rgb */
    PIXEL_RGB332, /* 2 bytes, a number: 0 ... 255 */
    PIXEL_LUMA16, /* 2 bytes, luminance: 65535 = white */
    PIXEL_RGB888, /* 4 bytes, a number: 0x00rrggbb */
    PIXEL_IDS,    /* 4 bytes */
} pixel_kind_t;

TUILE_INLINE unsigned pixel_bytes(pixel_kind_t kind) { return kind >= PIXEL_RGB888 ? 4 : 2; }

/* x / 255 rounded down, for x < 65536. */
TUILE_INLINE uint32_t pixel_div255(uint32_t x) { return (x * 257u + 257u) >> 16; }

#define PIXEL_RGB(red, green, blue) ((uint32_t)(red) << 16 | (uint32_t)(green) << 8 | (uint32_t)(blue))

/* How samples of a format are kept. */
pixel_kind_t pixel_kind_of(uint8_t format, bool dither);

/* A colour 0x00rrggbb as a sample, each component rounded to the nearest step (255 -> the greatest). Luminance: the weights of
 * ITU-R BT.709 on the components as they are, 0.2126, 0.7152 and 0.0722. */
uint32_t pixel_pack(pixel_kind_t kind, uint32_t rgb);

/* Back to 0x00rrggbb: steps spread evenly over 0 ... 255, rounded. */
uint32_t pixel_unpack(pixel_kind_t kind, uint32_t sample);

/* colour * light / 255, rounded, as a sample. light 0 ... 255. */
uint32_t pixel_lit(pixel_kind_t kind, const uint8_t colour[3], uint32_t light);

#endif
