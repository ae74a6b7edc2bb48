/* The ST7735R as its data sheet (V0.2) tells it, on some of the modules that it is sold on. */
#ifndef SIM_CHIPS_ST7735_H
#define SIM_CHIPS_ST7735_H

#include "mipi_dcs.h"

/* Pins GM2 to GM0 choose the memory. */
extern const sim_dcs_part_t sim_st7735_132x162_part, sim_st7735_132x132_part, sim_st7735_128x160_part;

/* All lie with the first source and gate at the lower right. NULL and one line in error without memory. Freed with
 * chip->destroy(chip). */
sim_chip_t *sim_st7735_128x160_create(sim_error_t *error);       /* blue first */
sim_chip_t *sim_st7735_128x160_green_create(sim_error_t *error); /* blue first, two columns and a row of memory before the glass */
sim_chip_t *sim_st7735_128x128_create(sim_error_t *error);       /* blue first, two columns and a row before, three rows behind */
sim_chip_t *sim_st7735_80x160_create(sim_error_t *error);        /* blue first, IPS */
sim_chip_t *sim_st7735_80x160_0_create(sim_error_t *error);      /* red first */

#endif
