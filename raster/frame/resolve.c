/* The one place that knows how a colour looks on the wire. */
#include "frame.h"

uint16_t resolve_colour(uint8_t format, uint8_t red, uint8_t green, uint8_t blue) {
    /* To 5 and 6 bits by rounding: 255 -> 31, 255 -> 63. */
    const uint32_t r = (red * 31u + 127u) / 255u, g = (green * 63u + 127u) / 255u, b = (blue * 31u + 127u) / 255u;
    const uint32_t value = r << 11 | g << 5 | b;
    return (uint16_t)(format == TUILE_RGB565_BE ? value >> 8 | value << 8 : value); /* stored by a little-endian machine */
}

/* x / 255 rounded down, for x < 65536. */
static uint32_t div255(uint32_t x) { return (x * 257u + 257u) >> 16; }

uint16_t resolve_lit(uint8_t format, const uint8_t colour[3], uint32_t light) {
    return resolve_colour(format, (uint8_t)div255(colour[0] * light + 127u), (uint8_t)div255(colour[1] * light + 127u),
                          (uint8_t)div255(colour[2] * light + 127u));
}
