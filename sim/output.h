/* Text files that appear whole or not at all. */
#ifndef SIM_OUTPUT_H
#define SIM_OUTPUT_H

#include "error.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct output {
    FILE *file;
    char path[4096], beside[4112]; /* beside: where it is written until output_close renames it */
} output_t;

/* Opens a file beside path; a path that is not a regular file (a pipe, a device) is written to directly. */
int output_open(output_t *output, const char *path, sim_error_t *error);

/* Flushes and renames. On failure (a full disk) nothing is left behind and what was at path stays. */
int output_close(output_t *output, sim_error_t *error);

void output_discard(output_t *output);

#endif
