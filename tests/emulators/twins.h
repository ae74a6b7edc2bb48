/* Functions that are in assembly on some targets, held against their C twins, which are the same sources built with
 * -DTUILE_ASSEMBLY=0: twins.sh has given each of their functions the prefix c_.
 */
#ifndef TESTS_EMULATORS_TWINS_H
#define TESTS_EMULATORS_TWINS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A line of text and numbers to standard output: twins_tell("at ", 7, ", not ", 8, NULL). Numbers are int32_t. */
void twins_tell(const char *text, ...);

/* Are all bytes equal? If not, tells the first that differs, and what the caller calls it. */
bool twins_equal(const char *what, const void *assembly, const void *c, size_t size_bytes);

/* The test: are the twins equal? Each program has one. */
bool twins_test(void);

#endif
