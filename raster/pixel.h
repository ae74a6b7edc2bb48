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

/* A component to 0 ... most by rounding, most < 256. */
TUILE_INLINE uint32_t pixel_steps(uint32_t component, uint32_t most) {
    const uint32_t sum = component * most + 127u;
    return FIXED_BY_HALVES ? pixel_div255(sum) : sum / 255u; /* where a division by a constant is none, it is shorter */
}

TUILE_INLINE uint32_t pixel_swap16(uint32_t x) { return (x >> 8 | x << 8) & 0xffffu; }

/* PIXEL_RGB565_BE or _LE. */
TUILE_INLINE uint32_t pixel_pack565(pixel_kind_t kind, uint32_t red, uint32_t green, uint32_t blue) {
    const uint32_t value = pixel_steps(red, 31) << 11 | pixel_steps(green, 63) << 5 | pixel_steps(blue, 31);
    return kind == PIXEL_RGB565_BE ? pixel_swap16(value) : value; /* stored by a little-endian machine */
}

/* How samples of a format are kept. */
pixel_kind_t pixel_kind_of(uint8_t format, bool dither);

/* A colour 0x00rrggbb as a sample, each component rounded to the nearest step (255 -> the greatest). Luminance: the weights of
 * ITU-R BT.709 on the components as they are, 0.2126, 0.7152 and 0.0722. */
uint32_t pixel_pack(pixel_kind_t kind, uint32_t rgb);

/* Back to 0x00rrggbb: steps spread evenly over 0 ... 255, rounded. */
uint32_t pixel_unpack(pixel_kind_t kind, uint32_t sample);

/* colour * light / 255, rounded, as a sample. light 0 ... 255. */
TUILE_INLINE uint32_t pixel_lit(pixel_kind_t kind, const uint8_t colour[3], uint32_t light) {
    const uint32_t red = pixel_div255(colour[0] * light + 127u), green = pixel_div255(colour[1] * light + 127u),
                   blue = pixel_div255(colour[2] * light + 127u);
    return TUILE_LIKELY(kind <= PIXEL_RGB565_LE) ? pixel_pack565(kind, red, green, blue)
                                                 : pixel_pack(kind, PIXEL_RGB(red, green, blue));
}

#endif
