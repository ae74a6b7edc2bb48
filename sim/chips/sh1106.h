/* The SH1106 as its data sheet (V2.3) tells it, on the usual module: 128 of its 132 segments wired, the first and last two not. */
#ifndef SIM_CHIPS_SH1106_H
#define SIM_CHIPS_SH1106_H

#include "oled.h"

/* 128 x 64. NULL and one line in error without memory. Freed with chip->destroy(chip). */
sim_chip_t *sim_sh1106_create(sim_error_t *error);

#endif
