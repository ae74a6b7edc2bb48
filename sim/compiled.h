/* Files of what the tools compile for flash: the bytes as they are, or as a C source. */
#ifndef SIM_COMPILED_H
#define SIM_COMPILED_H

#include "error.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct compiled_kind {
    const char *things;    /* "models", for messages */
    const char *extension; /* ".tuile", of the bytes as they are */
    const char *prefix;    /* of objects in C whose file's name is no name in C */
    void (*put_heading)(FILE *file, const uint8_t *bytes, size_t size_bytes, const char *name); /* the comment of a source */
} compiled_kind_t;

/* By the end of the path; whole or not at all. A source defines `const uint32_t name[]`; name NULL or "": from the file's name. 0,
 * or -1 and one line in error. */
int compiled_write(const compiled_kind_t *kind, const uint8_t *bytes, size_t size_bytes, const char *path, const char *name,
                   sim_error_t *error);

#endif
