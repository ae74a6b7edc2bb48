/* Golden pictures: what was drawn when someone last looked at it. A list in tests/golden holds lines "NAME HASH", beside it lie
 * pictures NAME.png. UPDATE_GOLDEN=1 in the environment writes all of them anew; then look at them. */
#ifndef TESTS_SUPPORT_GOLDEN_H
#define TESTS_SUPPORT_GOLDEN_H

#include "../../sim/picture.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct golden {
    const char *path;
    char *old;
    char written[8192];
    unsigned wrong;
} golden_t;

/* Fails the test when the list is missing. */
void golden_open(golden_t *golden, const char *path);

/* Does the list have this line? */
bool golden_hash(golden_t *golden, const char *name, const char *hash);

/* Compares the hash of the bytes that were drawn with the list, and what is seen with the picture. Where the picture differs,
 * build/golden gets what was drawn and where it differs. */
void golden_picture(golden_t *golden, const char *name, const uint8_t *bytes, size_t size_bytes, const sim_picture_t *drawn);

/* In the end the list must have had these lines and no others, and no picture may have differed. */
void golden_close(golden_t *golden);

#endif
