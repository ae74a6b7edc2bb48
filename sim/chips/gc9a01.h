/* The GC9A01 as the data sheet of the GC9A01A (V1.0) tells it, and drivers have found it, on its round module. */
#ifndef SIM_CHIPS_GC9A01_H
#define SIM_CHIPS_GC9A01_H

#include "mipi_dcs.h"

extern const sim_dcs_part_t sim_gc9a01_part;

/* IPS, blue first, the first source at the right. NULL and one line in error without memory. Freed with chip->destroy(chip). */
sim_chip_t *sim_gc9a01_create(sim_error_t *error);

#endif
