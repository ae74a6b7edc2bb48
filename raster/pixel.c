#include "pixel.h"

pixel_kind_t pixel_kind_of(uint8_t format, bool dither) {
    switch (format) {
    case TUILE_FACE_IDS: return PIXEL_IDS;
    case TUILE_RGB666: return PIXEL_RGB888;
    case TUILE_GREY8:
    case TUILE_GREY4:
    case TUILE_MONO_PAGES:
    case TUILE_MONO_ROWS: return PIXEL_LUMA16;
    default: break;
    }
    if (dither) { return PIXEL_RGB888; }
    return format == TUILE_RGB444      ? PIXEL_RGB444
           : format == TUILE_RGB332    ? PIXEL_RGB332
           : format == TUILE_RGB565_LE ? PIXEL_RGB565_LE
                                       : PIXEL_RGB565_BE;
}

/* A component to 0 ... most by rounding. */
TUILE_INLINE uint32_t steps(uint32_t component, uint32_t most) { return (component * most + 127u) / 255u; }

TUILE_INLINE uint32_t spread(uint32_t step, uint32_t most) { return (step * 255u + most / 2u) / most; }

TUILE_INLINE uint32_t swap16(uint32_t x) { return (x >> 8 | x << 8) & 0xffffu; }

uint32_t pixel_pack(pixel_kind_t kind, uint32_t rgb) {
    const uint32_t red = rgb >> 16 & 255u, green = rgb >> 8 & 255u, blue = rgb & 255u;
    uint32_t value;
    switch (kind) {
    case PIXEL_RGB444: return steps(red, 15) << 8 | steps(green, 15) << 4 | steps(blue, 15);
    case PIXEL_RGB332: return steps(red, 7) << 5 | steps(green, 7) << 2 | steps(blue, 3);
    case PIXEL_LUMA16:
        return ((red * 13933u + green * 46871u + blue * 4732u) * 257u + 32768u) >> 16; /* 255 * 2^16 * 257 + 2^15 < 2^32 */
    case PIXEL_RGB888:
    case PIXEL_IDS: return rgb;
    default: break;
    }
    value = steps(red, 31) << 11 | steps(green, 63) << 5 | steps(blue, 31);
    return kind == PIXEL_RGB565_BE ? swap16(value) : value; /* stored by a little-endian machine */
}

uint32_t pixel_unpack(pixel_kind_t kind, uint32_t sample) {
    switch (kind) {
    case PIXEL_RGB444: return PIXEL_RGB((sample >> 8) * 17u, (sample >> 4 & 15u) * 17u, (sample & 15u) * 17u);
    case PIXEL_RGB332: return PIXEL_RGB(spread(sample >> 5, 7), spread(sample >> 2 & 7u, 7), (sample & 3u) * 85u);
    case PIXEL_LUMA16: return (sample + 128u - (sample >> 8)) / 256u * 0x010101u;
    case PIXEL_RGB888:
    case PIXEL_IDS: return sample;
    default: break;
    }
    if (kind == PIXEL_RGB565_BE) { sample = swap16(sample); }
    return PIXEL_RGB(spread(sample >> 11, 31), spread(sample >> 5 & 63u, 63), spread(sample & 31u, 31));
}

uint32_t pixel_lit(pixel_kind_t kind, const uint8_t colour[3], uint32_t light) {
    return pixel_pack(kind, PIXEL_RGB(pixel_div255(colour[0] * light + 127u), pixel_div255(colour[1] * light + 127u),
                                      pixel_div255(colour[2] * light + 127u)));
}
