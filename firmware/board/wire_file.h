/* A bus for boards without a panel: what would go over the wire goes to a file of the host, by semihosting.
 * tests/emulators/wire_trace lets a model of the panel's chip read it.
 *
 * The file is a row of records: a letter, the number of bytes that follow (24 bits, little-endian), and those:
 *
 *     c bytes with D/C low       d bytes with D/C high
 *     r level of the reset line  w milliseconds of a pause, 32 bits, little-endian
 *     t a line of text
 */
#ifndef TUILE_FIRMWARE_BOARD_WIRE_FILE_H
#define TUILE_FIRMWARE_BOARD_WIRE_FILE_H

#include "../../hal/bus.h"

/* Creates the file and fills in *bus, whose context it keeps. There is only one. 0, or TUILE_HAL_IO. */
int wire_file_open(tuile_bus_t *bus, const char *path);

/* A line of text between the transfers. 0, or TUILE_HAL_IO. */
int wire_file_tell(const char *line);

#endif
