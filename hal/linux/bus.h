/* A panel on a Linux board: spidev for the bytes, GPIO lines for D/C, reset, backlight and tearing.
 *
 * Data are sent by a thread of the port's own: data() hands the buffer over and returns, wait() returns when it is out. Nothing is
 * allocated between open and close, and nothing is tried twice: only a pause or a wait for an edge that a signal cuts short goes on
 * with the time that is left. How long a transfer may take is the kernel's to say: its time-out is TUILE_HAL_TIMEOUT here. */
#ifndef TUILE_HAL_LINUX_BUS_H
#define TUILE_HAL_LINUX_BUS_H

#include <stdbool.h>
#include <stdint.h>

#include "../bus.h"
#include "fault.h"
#include "lines.h"
#include "spi.h"
#include "worker.h"

/* Zero = default, throughout. Only read by tuile_linux_open, strings included. */
typedef struct tuile_linux_config {
    const char *spi;              /* "/dev/spidev0.0" */
    uint8_t mode;                 /* SPI mode 0 ... 3 */
    tuile_linux_line_t dc;        /* 1 for data; must be there */
    tuile_linux_line_t reset;     /* 0 holds the panel in reset */
    tuile_linux_line_t backlight; /* 1 is on; dark until the first frame is shown */
    tuile_linux_line_t tearing;   /* goes to 1 when the vertical blank begins */
    const char *consumer;         /* who has the lines, for others to see; NULL = "tuile" */
    bool no_worker;               /* data() returns when the bytes are out */
} tuile_linux_config_t;

/* Readable: the first two. A port must not be moved while it is open. */
typedef struct tuile_linux {
    tuile_bus_t bus;           /* what a display is given */
    tuile_linux_fault_t fault; /* text: one line about whatever went wrong last */

    tuile_linux_spi_t spi;
    tuile_linux_request_t dc, reset, backlight, tearing;
    tuile_linux_worker_t worker;
    uint32_t command_clock_hz, pixel_clock_hz; /* 0: the device tree's */
    int8_t dc_level;                           /* as it was last set; -1: not known */
    bool open;
} tuile_linux_t;

/* Opens the device, requests the lines and starts the thread. Any tuile_hal_error_t, and a line of text in port->fault; after an
 * error nothing is held. Nothing is sent. */
int tuile_linux_open(tuile_linux_t *port, const tuile_linux_config_t *config);

/* Waits for what is on the wire, ends the thread, lets go of the lines and the device. What becomes of a line that nobody holds is
 * the chip's affair, so tuile_display_close comes before. Does nothing to a port that is closed, not opened, or all zeros. */
void tuile_linux_close(tuile_linux_t *port);

#endif
