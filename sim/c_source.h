/* Constant data as C sources: names of objects, words. */
#ifndef SIM_C_SOURCE_H
#define SIM_C_SOURCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#define C_NAME_MAX_CHARS 63 /* what C promises to tell apart */

/* Whether an object of a C program may be called so. */
bool c_is_identifier(const char *name);

/* The end of a file's name from its last dot on, "" without one. */
const char *c_extension(const char *path);

/* The file's name without its end, other characters as _; prefix in front where that is no identifier. */
void c_default_name(const char *path, const char *prefix, char name[C_NAME_MAX_CHARS + 1]);

/* "extern const uint32_t name[n]; const uint32_t name[n] = {...};" with the bytes as little-endian words, zeros behind them. 0, or
 * the errno of the failure. */
int c_put_words(FILE *file, const uint8_t *bytes, size_t size_bytes, const char *name);

#endif
