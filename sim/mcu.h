/* What a controller's serial clock can be: it is divided from another, so a panel gets the nearest one that is not faster. */
#ifndef SIM_MCU_H
#define SIM_MCU_H

#include <stddef.h>
#include <stdint.h>

typedef struct sim_mcu {
    const char *name;
    uint32_t source_hz;        /* what is divided */
    uint16_t least, most;      /* divisors */
    uint16_t step;             /* between them; 0: powers of two only */
    const char *documentation; /* where it says so */
} sim_mcu_t;

extern const sim_mcu_t sim_mcus[];
extern const size_t sim_mcu_count;

/* By name; NULL when there is none. */
const sim_mcu_t *sim_mcu_find(const char *name);

/* The fastest clock not above the one asked for, in Hz, rounded down; the slowest that it has when all are above. asked_hz > 0. */
uint32_t sim_mcu_clock(const sim_mcu_t *mcu, uint32_t asked_hz);

#endif
