/* The ST7796S as its data sheet (V1.0) tells it, on a 320 x 480 module of the usual kind. */
#ifndef SIM_CHIPS_ST7796_H
#define SIM_CHIPS_ST7796_H

#include "mipi_dcs.h"

extern const sim_dcs_part_t sim_st7796_part;

/* Blue first, the first source at the right. NULL and one line in error without memory. Freed with chip->destroy(chip). */
sim_chip_t *sim_st7796_create(sim_error_t *error);

#endif
