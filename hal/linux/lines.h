/* One GPIO line, held for the life of a display, through libgpiod: lines_v1.c for its API 1, lines_v2.c for its API 2, lines.c for
 * what they share. The header gpiod.h that the compiler finds decides which of the two is built. */
#ifndef TUILE_HAL_LINUX_LINES_H
#define TUILE_HAL_LINUX_LINES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "fault.h"

/* Where a line is. */
typedef struct tuile_linux_line {
    const char *chip; /* "gpiochip0" or a path; NULL: not connected */
    uint32_t offset;  /* 0 ... the chip's lines - 1 */
    bool active_low;  /* the wire is the inverse of what is said */
} tuile_linux_line_t;

typedef enum tuile_linux_use {
    TUILE_LINUX_OUTPUT_0, /* and the level it begins with, active_low not yet applied */
    TUILE_LINUX_OUTPUT_1,
    TUILE_LINUX_EDGES, /* from 0 to 1 */
} tuile_linux_use_t;

/* All zeros: nothing is held, and it may be released all the same. */
typedef struct tuile_linux_request {
    void *chip;   /* struct gpiod_chip; API 2: NULL, a request needs none */
    void *handle; /* API 1: struct gpiod_line; API 2: struct gpiod_line_request */
    void *events; /* API 2: struct gpiod_edge_event_buffer */
    uint32_t offset;
    const char *name; /* what the line is for, in messages */
} tuile_linux_request_t;

typedef struct tuile_linux_chip {
    char name[32], label[32]; /* as the kernel limits them */
    uint32_t lines;
} tuile_linux_chip_t;

typedef void (*tuile_linux_used_t)(void *context, uint32_t offset, const char *consumer);

/* The version of libgpiod that is linked, "1.6.3"; its first digit is the API. */
const char *tuile_linux_gpiod_version(void);

/* What a chip tells of itself. chip as in tuile_linux_line_t. used, if it is not NULL, is called for each line that somebody has;
 * consumer is "" where that one gave no name, and is used's for the time of the call. */
int tuile_linux_chip(tuile_linux_chip_t *info, const char *chip, tuile_linux_used_t used, void *context,
                     tuile_linux_fault_t *fault);

/* TUILE_HAL_BUSY when another program or the kernel has the line; TUILE_HAL_NOT_FOUND without such a chip or line. After an error
 * nothing is held. The line's strings need not outlive the call, name has to outlive the request. */
int tuile_linux_line_request(tuile_linux_request_t *request, const tuile_linux_line_t *line, tuile_linux_use_t use,
                             const char *name, const char *consumer, tuile_linux_fault_t *fault);

int tuile_linux_line_set(const tuile_linux_request_t *request, bool level, tuile_linux_fault_t *fault);

/* Forgets the edges until now and returns with the next one, or TUILE_HAL_TIMEOUT. A signal does not end it. */
int tuile_linux_line_edge(const tuile_linux_request_t *request, uint32_t timeout_ms, tuile_linux_fault_t *fault);

void tuile_linux_line_release(tuile_linux_request_t *request);

/* ---- between lines.c and the two versions ----------------------------------------------------------------------- */

#define TUILE_LINUX_CHIP_PATH_BYTES 128u

/* "/dev/gpiochip0" of "gpiochip0"; a path stays as it is. ENAMETOOLONG, or 0. */
int tuile_linux_chip_path(char path[TUILE_LINUX_CHIP_PATH_BYTES], const char *chip);

int tuile_linux_no_such_line(const tuile_linux_line_t *line, const char *name, uint32_t lines, tuile_linux_fault_t *fault);

/* For errors of a request; consumer NULL: the one who has it did not give a name. */
int tuile_linux_not_had(const tuile_linux_line_t *line, const char *name, int error, const char *consumer,
                        tuile_linux_fault_t *fault);

/* Edges are there: 1; none within timeout_ns: 0; -1 and errno. */
int tuile_linux_edges_wait(const tuile_linux_request_t *request, uint64_t timeout_ns);

/* Takes as many as the kernel keeps for a line. Negative and errno when that fails. */
int tuile_linux_edges_take(const tuile_linux_request_t *request);

#define TUILE_LINUX_EDGES_KEPT 16 /* by the kernel, for a line */

#endif
