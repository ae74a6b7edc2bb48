/* Pixels as GUD packs them. */
#ifndef SIM_GUD_PIXELS_H
#define SIM_GUD_PIXELS_H

#include <stdint.h>

/* Of a pixel, filling included; 0 for numbers that name no format. */
unsigned sim_gud_format_bits(uint8_t format);

/* Of a row: it begins a new byte. */
uint32_t sim_gud_row_bytes(uint8_t format, uint32_t width);

/* Pixel x of a packed row as red, green, blue in 8 bits each: bits are repeated downwards. */
void sim_gud_decode(uint8_t format, const uint8_t *row, uint32_t x, uint8_t *rgb);

#endif
