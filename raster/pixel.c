#include "pixel.h"

pixel_kind_t pixel_kind_of(uint8_t format, bool dither) {
    switch (format) {
    case TUILE_FACE_IDS: return PIXEL_IDS;
    case TUILE_RGB666:
    case TUILE_RGB111:
    case TUILE_XRGB1111:
    case TUILE_BGR888:
    case TUILE_XRGB8888: return PIXEL_RGB888;
    case TUILE_GREY8:
    case TUILE_GREY4:
    case TUILE_GREY4_TURNED:
    case TUILE_MONO_PAGES:
    case TUILE_MONO_PAGES_TURNED:
    case TUILE_MONO_ROWS: return PIXEL_LUMA16;
    default: break;
    }
    if (dither) { return PIXEL_RGB888; }
    return format == TUILE_RGB444      ? PIXEL_RGB444
           : format == TUILE_RGB332    ? PIXEL_RGB332
           : format == TUILE_RGB565_LE ? PIXEL_RGB565_LE
                                       : PIXEL_RGB565_BE;
}

TUILE_INLINE uint32_t spread(uint32_t step, uint32_t most) { return (step * 255u + most / 2u) / most; }

uint32_t pixel_pack(pixel_kind_t kind, uint32_t rgb) {
    const uint32_t red = rgb >> 16 & 255u, green = rgb >> 8 & 255u, blue = rgb & 255u;
    switch (kind) {
    case PIXEL_RGB444: return pixel_steps(red, 15) << 8 | pixel_steps(green, 15) << 4 | pixel_steps(blue, 15);
    case PIXEL_RGB332: return pixel_steps(red, 7) << 5 | pixel_steps(green, 7) << 2 | pixel_steps(blue, 3);
    case PIXEL_LUMA16:
        return ((red * 13933u + green * 46871u + blue * 4732u) * 257u + 32768u) >> 16; /* 255 * 2^16 * 257 + 2^15 < 2^32 */
    case PIXEL_RGB888:
    case PIXEL_IDS: return rgb;
    default: break;
    }
    return pixel_pack565(kind, red, green, blue);
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
    if (kind == PIXEL_RGB565_BE) { sample = pixel_swap16(sample); }
    return PIXEL_RGB(spread(sample >> 11, 31), spread(sample >> 5 & 63u, 63), spread(sample & 31u, 31));
}
