#include "gud_pixels.h"

#include "gud_model.h"

unsigned sim_gud_format_bits(uint8_t format) {
    switch (format) {
    case SIM_GUD_R1: return 1;
    case SIM_GUD_XRGB1111: return 4;
    case SIM_GUD_R8:
    case SIM_GUD_RGB332: return 8;
    case SIM_GUD_RGB565: return 16;
    case SIM_GUD_RGB888: return 24;
    case SIM_GUD_XRGB8888: return 32;
    default: return 0;
    }
}

uint32_t sim_gud_row_bytes(uint8_t format, uint32_t width) { return (width * sim_gud_format_bits(format) + 7u) / 8u; }

/* Bits repeated downwards until there are 8. */
static uint8_t widen(unsigned value, unsigned bits) {
    unsigned wide = value << (8u - bits);

    for (unsigned have = bits; have < 8; have *= 2) {
        wide |= wide >> have;
    }
    return (uint8_t)wide;
}

void sim_gud_decode(uint8_t format, const uint8_t *row, uint32_t x, uint8_t *rgb) {
    unsigned value;

    switch (format) {
    case SIM_GUD_R1: rgb[0] = rgb[1] = rgb[2] = row[x / 8u] & 0x80u >> x % 8u ? 255 : 0; break;
    case SIM_GUD_R8: rgb[0] = rgb[1] = rgb[2] = row[x]; break;
    case SIM_GUD_XRGB1111:
        value = x % 2u ? row[x / 2u] & 15u : row[x / 2u] >> 4;
        for (unsigned i = 0; i < 3; i++) {
            rgb[i] = value & 4u >> i ? 255 : 0;
        }
        break;
    case SIM_GUD_RGB332:
        rgb[0] = widen(row[x] >> 5, 3);
        rgb[1] = widen(row[x] >> 2 & 7u, 3);
        rgb[2] = widen(row[x] & 3u, 2);
        break;
    case SIM_GUD_RGB565:
        value = sim_usb_u16(row + 2u * (size_t)x);
        rgb[0] = widen(value >> 11, 5);
        rgb[1] = widen(value >> 5 & 63u, 6);
        rgb[2] = widen(value & 31u, 5);
        break;
    default: /* blue, green, red, and a byte more for XRGB8888 */
        row += (size_t)x * sim_gud_format_bits(format) / 8u;
        for (unsigned i = 0; i < 3; i++) {
            rgb[i] = row[2u - i];
        }
    }
}
