/* The panels that the simulator knows: the driver's data of each, and a model of the chip and glass at the other end. */
#ifndef SIM_PANELS_H
#define SIM_PANELS_H

#include "../hal/panel.h"
#include "chips/chip.h"

typedef struct sim_panel {
    const tuile_panel_t *panel;
    const char *chip;                          /* its name in the data sheet */
    sim_chip_t *(*create)(sim_error_t *error); /* just powered; NULL and one line in error without memory */
} sim_panel_t;

extern const sim_panel_t sim_panels[];
extern const size_t sim_panel_count;

/* By the panel's name ("ili9341"); NULL when there is none. */
const sim_panel_t *sim_panel_find(const char *name);

#endif
