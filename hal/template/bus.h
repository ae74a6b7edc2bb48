/* An empty port: copy this folder, fill in what the board has, delete what it has not. */
#ifndef TUILE_HAL_TEMPLATE_BUS_H
#define TUILE_HAL_TEMPLATE_BUS_H

#include "../bus.h"

/* What the port has to remember; the caller owns it. */
typedef struct template_port {
    uint32_t command_clock_hz;
    uint32_t pixel_clock_hz;
} template_port_t;

/* Opens the board's peripheral and fills in *bus, which refers to *port: both outlive every display on it. */
int template_bus_open(tuile_bus_t *bus, template_port_t *port);

#endif
