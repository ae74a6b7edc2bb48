/* The ILI9341 as its data sheet (V1.11) tells it, on a 240 x 320 module of the usual kind. */
#ifndef SIM_CHIPS_ILI9341_H
#define SIM_CHIPS_ILI9341_H

#include "mipi_dcs.h"

extern const sim_dcs_part_t sim_ili9341_part;

/* The usual module: filter in BGR order, rows wired from the other end. NULL and one line in error without memory.
 * Freed with chip->destroy(chip). */
sim_chip_t *sim_ili9341_create(sim_error_t *error);

#endif
