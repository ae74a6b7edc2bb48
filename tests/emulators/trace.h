/* What an emulator saw on the wires of a panel, or a board without one would put on them (firmware/board/wire_file.c), as a file.
 *
 * One record after another, each of 16 bytes and a payload: kind, flag, two bytes of zero, the payload's size in bytes (32 bits),
 * and the time in nanoseconds since the start (64 bits). Little-endian.
 *
 *     BYTES  flag: the level of D/C   the clock in Hz (32 bits), then the bytes that went out at that level, in one transaction
 *     RESET  flag: the level of the reset line
 *     LIGHT  flag: the backlight, 0 ... 255
 *     TEXT                            a line that the program told, without its end
 *     FRAME  flag: 1 when the program begins a frame, 0 when it has ended
 */
#ifndef TESTS_EMULATORS_TRACE_H
#define TESTS_EMULATORS_TRACE_H

#include <stdint.h>
#include <stdio.h>

#include "../../sim/chips/chip.h"

typedef enum trace_kind {
    TRACE_BYTES = 1,
    TRACE_RESET = 2,
    TRACE_LIGHT = 3,
    TRACE_TEXT = 4,
    TRACE_FRAME = 5,
} trace_kind_t;

typedef struct trace_event {
    trace_kind_t kind;
    uint8_t flag;
    uint32_t clock_hz; /* of BYTES */
    uint64_t time_ns;
    const uint8_t *bytes; /* behind them is a zero; valid until the next event */
    size_t size_bytes;
} trace_event_t;

/* Zero = default. */
typedef struct trace {
    FILE *file; /* open for reading; the caller's */
    uint8_t *room;
    size_t room_bytes;
} trace_t;

/* Reads the next event. 1; 0 at the end; -1 and one line in error for what is no trace, or is cut off. */
int trace_next(trace_t *trace, trace_event_t *event, sim_error_t *error);

/* Tells a panel's chip what came to it: BYTES and RESET; the others are not its business. 0, or -1 and one line in error. */
int trace_feed(sim_chip_t *chip, const trace_event_t *event, sim_error_t *error);

void trace_close(trace_t *trace);

#endif
