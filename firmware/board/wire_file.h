/* A bus for boards without a panel: what would go over the wire goes to a file of the host, by semihosting, as
 * tests/emulators/trace.h describes it. Its time is that of the bytes, at the clocks that the display asks for, and of pauses.
 * tests/emulators/wire_trace lets a model of the panel's chip read it. */
#ifndef TUILE_FIRMWARE_BOARD_WIRE_FILE_H
#define TUILE_FIRMWARE_BOARD_WIRE_FILE_H

#include "../../hal/bus.h"

/* Creates the file and fills in *bus, whose context it keeps. There is only one. 0, or TUILE_HAL_IO. */
int wire_file_open(tuile_bus_t *bus, const char *path);

/* A line of text between the transfers. 0, or TUILE_HAL_IO. */
int wire_file_tell(const char *line);

#endif
