/* The ST7789 as the data sheet of the ST7789V (V1.0) tells it, on the modules that it is sold on: IPS, red first. */
#ifndef SIM_CHIPS_ST7789_H
#define SIM_CHIPS_ST7789_H

#include "mipi_dcs.h"

extern const sim_dcs_part_t sim_st7789_part;

/* NULL and one line in error without memory. Freed with chip->destroy(chip). */
sim_chip_t *sim_st7789_240x320_create(sim_error_t *error);
sim_chip_t *sim_st7789_240x240_create(sim_error_t *error); /* on the first 240 gates */
sim_chip_t *sim_st7789_135x240_create(sim_error_t *error); /* on sources 53 to 187 of 240, gates 41 to 280 */
sim_chip_t *sim_st7789_170x320_create(sim_error_t *error);
sim_chip_t *sim_st7789_172x320_create(sim_error_t *error);
sim_chip_t *sim_st7789_240x280_create(sim_error_t *error);

#endif
