/* The SSD1322 as its data sheet (Rev 1.2) tells it, on the usual module: segments 112 to 367 wired, the highest at the left, both
 * sides of the chip to each common, common 0 at the top. */
#ifndef SIM_CHIPS_SSD1322_H
#define SIM_CHIPS_SSD1322_H

#include "oled.h"

/* 256 x 64. NULL and one line in error without memory. Freed with chip->destroy(chip). */
sim_chip_t *sim_ssd1322_create(sim_error_t *error);

#endif
