/* The ILI9488 as its data sheet (V1.00) tells it, on a 320 x 480 module of the usual kind. */
#ifndef SIM_CHIPS_ILI9488_H
#define SIM_CHIPS_ILI9488_H

#include "mipi_dcs.h"

extern const sim_dcs_part_t sim_ili9488_part;

/* Blue first, the first source at the right. NULL and one line in error without memory. Freed with chip->destroy(chip). */
sim_chip_t *sim_ili9488_create(sim_error_t *error);

#endif
