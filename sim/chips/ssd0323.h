/* The SSD0323 (the SSD1325 takes the same commands) on a module of the OSRAM Pictiva 128 x 64 kind: segment 0 at the left, commons
 * 0 to 63 of its 80 wired, 63 at the top, even ones from one side and odd ones from the other.
 *
 * Where the data sheet leaves open how the reversed scan and the display offset go together, two modules' own settings tell: with
 * rows reversed, A2h is 40h on this glass and 4Ch on one that begins at common 12, and with rows as they are 0 and 8 rows further
 * down. Both say that the reversal is one of all 80 commons. */
#ifndef SIM_CHIPS_SSD0323_H
#define SIM_CHIPS_SSD0323_H

#include "oled.h"

/* 128 x 64. NULL and one line in error without memory. Freed with chip->destroy(chip). */
sim_chip_t *sim_ssd0323_create(sim_error_t *error);

#endif
