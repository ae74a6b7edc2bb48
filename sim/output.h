/* Files that appear whole or not at all: every file that the tools write goes through here. */
#ifndef SIM_OUTPUT_H
#define SIM_OUTPUT_H

#include "error.h"

#include <limits.h>
#include <stdio.h>

typedef struct output {
    FILE *file;
    char path[PATH_MAX];   /* as named by the user */
    char target[PATH_MAX]; /* the file that is replaced: where path is a symbolic link, what it names */
    char beside[PATH_MAX]; /* where it is written until output_close renames it; empty: target is written to directly */
} output_t;

/* Opens a new file beside path, with the permissions of the file that it will replace or those that a new file gets here. A path
 * that is not a regular file (a pipe, a device) is written to directly. 0, or -1 and one line in error. */
int output_open(output_t *output, const char *path, sim_error_t *error);

/* Writes out and renames. On failure (a full disk) nothing is left behind and what was at path stays. */
int output_close(output_t *output, sim_error_t *error);

/* Closes and leaves nothing behind; what was at path stays. */
void output_discard(output_t *output);

#endif
