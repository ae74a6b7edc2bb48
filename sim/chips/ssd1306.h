/* The SSD1306 as its data sheet (Rev 1.1) tells it, on the usual modules: without a voltage of their own for the glass, which the
 * chip's charge pump makes, and with segment 127 at the left and the last common at the top. */
#ifndef SIM_CHIPS_SSD1306_H
#define SIM_CHIPS_SSD1306_H

#include "oled.h"

/* 128 x 64: even commons from one side, odd ones from the other. 128 x 32: in sequence. NULL and one line in error without memory.
 * Freed with chip->destroy(chip). */
sim_chip_t *sim_ssd1306_128x64_create(sim_error_t *error);
sim_chip_t *sim_ssd1306_128x32_create(sim_error_t *error);

#endif
