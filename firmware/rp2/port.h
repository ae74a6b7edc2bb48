/* SPI0 of RP2040 and RP2350 as a bus: commands are polled, data go by DMA while the core goes on, and it sleeps in wait(). Data
 * that come while others are on the wire are begun by the interrupt at the end of those, which is the first core's: so the second
 * core may only send what it has waited for the wire with (a window before each tile, as in firmware/cores.h). */
#ifndef TUILE_FIRMWARE_RP2_PORT_H
#define TUILE_FIRMWARE_RP2_PORT_H

#include "../../hal/bus.h"

/* The wiring of Pimoroni's and many other displays, and a reset line. */
#define PORT_PIN_DC 16u     /* high for data */
#define PORT_PIN_SELECT 17u /* low selects the panel */
#define PORT_PIN_CLOCK 18u
#define PORT_PIN_DATA 19u
#define PORT_PIN_BACKLIGHT 20u /* PWM: high is bright */
#define PORT_PIN_RESET 21u     /* low resets */

/* Opens the peripherals and fills in *bus. There is only one, so it has no context. Clocks run (clocks_open). */
void port_open(tuile_bus_t *bus);

#endif
