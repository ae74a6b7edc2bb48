/* The simulator as a board: a tuile_bus_t with a model of a panel chip at its other end, and a clock.
 *
 * The clock counts the wire (bits / clock + gaps), the pauses that the driver asks for, and the work that the caller reports with
 * sim_bus_work, or that a listener of sim_bus_listen knows of. Data may be on the wire while the caller works, as with DMA: a
 * buffer in flight is not read before the next wait, so whoever overwrites it too early sees the damage on the glass. */
#ifndef SIM_BUS_H
#define SIM_BUS_H

#include <stdbool.h>
#include <stdint.h>

#include "../hal/bus.h"
#include "chips/chip.h"

/* Zero = default, throughout. */
typedef struct sim_bus_config {
    uint32_t clock_hz;         /* the real clock for pixels; 0 = just what the display asks for */
    uint32_t command_clock_hz; /* the real clock for commands; 0 likewise */
    uint32_t command_gap_ns;   /* per command: set-up, D/C, chip select */
    uint32_t chunk_gap_ns;     /* per chunk of data */
    uint32_t max_chunk_bytes;  /* 0 = no limit */
    uint32_t refresh_hz;       /* of the panel; 0 = the tearing-effect line is not connected */
    bool blocking;             /* data return when they are out, and there is no wait */
    bool queues;               /* data are taken while others are on the wire, and follow them without a gap: wait_one */
    bool no_reset_pin;
    bool no_backlight_pin; /* the backlight is always on */

    /* A fault, once: transfer number fail_transfer (1 = the first; commands and chunks both count) ends in fail_code, for a
     * chunk in flight at the wait; one that waits behind it does not go out. fail_parts of 2 parts of it reach the chip
     * nevertheless: 0, 1 or 2. */
    uint64_t fail_transfer;
    int fail_code; /* 0 = TUILE_HAL_IO; TUILE_HAL_GONE lasts: all later transfers fail alike */
    uint8_t fail_parts;
} sim_bus_config_t;

/* Sums since sim_bus_open, or since the caller zeroed them. */
typedef struct sim_bus_counts {
    uint64_t commands, chunks; /* transactions */
    uint64_t command_bytes, data_bytes;
    uint64_t wire_ns;  /* bits / clock, rounded up per transaction */
    uint64_t gap_ns;   /* as far as the wire rests for them */
    uint64_t delay_ns; /* pauses asked for */
    uint64_t work_ns;  /* reported by sim_bus_work, or by a listener */
    uint64_t idle_ns;  /* spent waiting for data on the wire, after any work */
} sim_bus_counts_t;

/* Data on the wire, or waiting for it. */
typedef struct sim_bus_flight {
    const uint8_t *bytes;
    size_t size_bytes;
    uint64_t start_ns, end_ns;
    int result;
    uint8_t parts;
} sim_bus_flight_t;

/* What the caller has computed for since the last call, in ns. */
typedef uint64_t (*sim_bus_work_fn)(void *context);

typedef struct sim_bus {
    tuile_bus_t bus; /* what a display is given */
    sim_bus_config_t config;
    sim_chip_t *chip;
    sim_bus_counts_t counts;
    uint64_t now_ns;    /* since power came up */
    uint64_t transfers; /* so far: commands and chunks */
    sim_error_t error;  /* the first misuse of the bus by the display, or the chip's fault */

    sim_bus_work_fn listener; /* NULL: none */
    void *listener_context;
    uint32_t asked_command_hz, asked_pixel_hz;
    sim_bus_flight_t flights[2]; /* of buffers that are not the caller's, in their order */
    unsigned flying;             /* how many */
    uint8_t backlight;
    bool gone;
} sim_bus_t;

/* chip outlives the bus and stays the caller's. config may be NULL. */
void sim_bus_open(sim_bus_t *bus, const sim_bus_config_t *config, sim_chip_t *chip);

/* The caller has computed for work_ns; data in flight went on meanwhile. */
void sim_bus_work(sim_bus_t *bus, uint64_t work_ns);

/* From now on `work` is asked before anything is done on the bus, and before each wait, what was computed meanwhile. */
void sim_bus_listen(sim_bus_t *bus, sim_bus_work_fn work, void *context);

/* What is seen by someone who holds the device so that a display of this rotation reads upright; black when the backlight is off.
 * Data in flight have not arrived. out is the caller's to free. 0, or -1 and one line in error. */
int sim_bus_picture(const sim_bus_t *bus, unsigned rotation, sim_picture_t *out, sim_error_t *error);

#endif
