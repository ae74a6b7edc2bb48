/* The SSD1351 as its data sheet (Rev 1.5) tells it, on the usual modules: segment 0 at the left, the last common at the top, even
 * commons from one side and odd ones from the other, red where the data sheet says C. */
#ifndef SIM_CHIPS_SSD1351_H
#define SIM_CHIPS_SSD1351_H

#include "oled.h"

/* 128 x 128 and, with commons 0 to 95 only, 128 x 96. NULL and one line in error without memory. Freed with chip->destroy(chip).
 * A pixel of the memory has 18 bits, the first to come over the wire in the upper 6. */
sim_chip_t *sim_ssd1351_create(sim_error_t *error);
sim_chip_t *sim_ssd1351_128x96_create(sim_error_t *error);

#endif
