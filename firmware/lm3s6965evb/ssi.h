/* The LM3S6965's SSI0 as a bus: clock PA2, data PA5, D/C PC7, the panel's chip select by way of PD0. Transfers are polled. */
#ifndef TUILE_FIRMWARE_LM3S6965EVB_SSI_H
#define TUILE_FIRMWARE_LM3S6965EVB_SSI_H

#include "../../hal/bus.h"

/* Opens the peripheral and fills in *bus. There is only one, so it has no context. */
void ssi_open(tuile_bus_t *bus);

#endif
