/* Microcontrollers. What the serial clock can be: it is divided from another, so a panel gets the nearest one that is not faster.
 * And how fast the core is: sim/predict.h. */
#ifndef SIM_MCU_H
#define SIM_MCU_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sim_mcu {
    const char *name;
    uint32_t source_hz;        /* what is divided */
    uint16_t least, most;      /* divisors */
    uint16_t step;             /* between them; 0: powers of two only */
    const char *documentation; /* where it says so */

    uint32_t core_hz;
    const char *core;         /* whose instructions stand for this one's, as `make bench` names its targets */
    uint32_t cycles_milli;    /* cycles of an instruction, times 1000 */
    const char *cycles_from;  /* where that is from, in a few words */
    uint32_t transfer_cycles; /* of the driver, for each command and each chunk of pixels */
    bool polled;              /* the core feeds the wire itself: nothing overlaps */
    bool queues;              /* its driver takes pixels while others are on the wire (tuile_bus_t.wait_one) */
} sim_mcu_t;

extern const sim_mcu_t sim_mcus[];
extern const size_t sim_mcu_count;

/* By name; NULL when there is none. */
const sim_mcu_t *sim_mcu_find(const char *name);

/* The driver's time for a command or a chunk, in ns, rounded up. */
uint32_t sim_mcu_transfer_ns(const sim_mcu_t *mcu);

/* The fastest clock not above the one asked for, in Hz, rounded down; the slowest that it has when all are above. asked_hz > 0. */
uint32_t sim_mcu_clock(const sim_mcu_t *mcu, uint32_t asked_hz);

#endif
