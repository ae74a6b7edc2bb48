/* A panel as seen from the wire: what every model of a panel chip offers to the simulated bus.
 *
 * Models are written from the data sheets, not from the drivers: they and the drivers are two readings of one document. They refuse
 * what the document forbids, also where a real chip would let it pass, so that a driver that works here is within its rights. */
#ifndef SIM_CHIPS_CHIP_H
#define SIM_CHIPS_CHIP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../error.h"
#include "../picture.h"

typedef struct sim_chip sim_chip_t;

/* Times are nanoseconds since power came up and never go back. */
struct sim_chip {
    /* The reset line: held, or let go. */
    void (*reset)(sim_chip_t *chip, bool held, uint64_t now_ns);
    /* Bytes with D/C high (data) or low, at a clock. 0, or -1 and chip->fault. */
    int (*receive)(sim_chip_t *chip, bool data, const uint8_t *bytes, size_t size_bytes, uint32_t clock_hz, uint64_t now_ns);
    /* A command that is answered. 0, or -1 and chip->fault. */
    int (*read)(sim_chip_t *chip, uint8_t command, uint8_t *bytes, size_t size_bytes, uint64_t now_ns);
    /* What is seen on the glass by the light of a backlight, as the module lies at rotation 0. out is the caller's to free. */
    int (*glass)(const sim_chip_t *chip, sim_picture_t *out, sim_error_t *error);
    void (*destroy)(sim_chip_t *chip);

    const char *name;
    bool tearing;        /* the tearing-effect line is switched on */
    bool uncut;          /* the owner's: a round glass shows what lies beyond its circle too, instead of black */
    sim_error_t fault;   /* the first illegal traffic; empties only when the owner empties it. Until then nothing is taken */
    sim_error_t warning; /* the first that is legal in practice but not by the data sheet */
    uint32_t warnings;
};

#endif
