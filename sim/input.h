/* Files read whole. */
#ifndef SIM_INPUT_H
#define SIM_INPUT_H

#include "error.h"

#include <stddef.h>
#include <stdint.h>

/* Reads a file of at most most_bytes, which may be a pipe. *bytes is from malloc. 0, or -1 and one line in error. */
int input_read(const char *path, size_t most_bytes, uint8_t **bytes, size_t *size_bytes, sim_error_t *error);

#endif
