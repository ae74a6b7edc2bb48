/* What a run of the guest left in the shared folder: of each step NAME.out, NAME.err and NAME.code. Every function fails the test
 * when a file is not there. */
#ifndef TESTS_LINUX_GUEST_H
#define TESTS_LINUX_GUEST_H

#include <stdint.h>

/* A file of the shared folder's out; valid until the next call. */
const char *guest_path(const char *name, const char *end);

/* To be released with free. */
char *guest_text(const char *name, const char *end);
void guest_assert_text(const char *name, const char *end, const char *expected);

/* That the step ended with this exit code. */
void guest_assert_code(const char *name, int code);

/* The number behind a word. */
unsigned long guest_number(const char *name, const char *end, const char *word);

/* That two pictures are the same, pixel by pixel, in the bits of red, green and blue that are kept: FFFFFF, or what a format has.
 */
void guest_assert_same_picture(const char *path, const char *other_path, uint32_t kept);

#endif
