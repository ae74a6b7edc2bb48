/* A panel on the pins of QEMU's PL061, as its trace tells them: changes of levels become bytes with D/C, resets and light for a
 * model of the panel's chip.
 *
 * The lines are those of board.dts. A bit is taken at the clock's sampling edge while the chip is selected, D/C with each bit. It
 * is an error when a byte is cut off, when D/C changes within one, and when the clock is not at rest as the chip select moves.
 * At power-up all lines are low; they count as nobody's until they change. A change of the last line tells that a program has
 * ended, which must have put its light out. */
#ifndef TESTS_LINUX_PINS_H
#define TESTS_LINUX_PINS_H

#include <stdbool.h>
#include <stdint.h>

#include "../../sim/chips/chip.h"

enum { PINS_CLOCK, PINS_MOSI, PINS_SELECT, PINS_KEY, PINS_DC, PINS_RESET, PINS_BACKLIGHT, PINS_END, PINS_COUNT };

typedef struct pins {
    sim_chip_t *chip;
    uint8_t spi_mode; /* 0 ... 3 */
    /* A pulse of the reset line begins; chip and spi_mode may be changed. 0, or -1 and error. NULL: nothing is to be done. */
    int (*begin)(void *context, struct pins *pins, sim_error_t *error);
    /* What is seen at the moment the light goes out. 0, or -1 and error. */
    int (*seen)(void *context, const sim_chip_t *chip, sim_error_t *error);
    void *context;

    uint64_t commands, data_bytes; /* bytes with D/C low and high */
    uint32_t resets, lights;       /* pulses of the reset line, times the light went on */

    uint8_t levels; /* a bit for each line */
    bool chip_seen; /* the chip has been deselected once: before that the lines are nobody's */
    uint8_t byte, bit_count;
    bool dc;
    uint64_t start_us, first_bit_us;
} pins_t;

/* A change at a time; times do not go back. 0, or -1 and one line in error. */
int pins_change(pins_t *pins, unsigned line, bool level, uint64_t time_us, sim_error_t *error);

/* A line of the trace: "PID@SECONDS.MICROSECONDS:pl061_set_output NAME setting output LINE to LEVEL". 0, or -1 and error. */
int pins_trace(pins_t *pins, const char *text, sim_error_t *error);

/* At the end of the trace, or of a program: a byte that is cut off is an error, and so is a light that is still on. */
int pins_end(pins_t *pins, sim_error_t *error);

#endif
