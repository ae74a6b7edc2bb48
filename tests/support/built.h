/* Models compiled from files of the test's folder, for tests that read their bytes. */
#ifndef TESTS_SUPPORT_BUILT_H
#define TESTS_SUPPORT_BUILT_H

#include <stddef.h>
#include <stdint.h>

#include "../../sim/mesh/mesh.h"

typedef struct built {
    uint8_t *bytes; /* to be released with free */
    size_t size;
    mesh_report_t report;
} built_t;

/* Compiles a file; fails the test on an error. */
built_t built_load(const char *path, const mesh_options_t *options);

#endif
