/* What the kernel says, in the HAL's codes and in a line for people. */
#ifndef TUILE_HAL_LINUX_FAULT_H
#define TUILE_HAL_LINUX_FAULT_H

#include <stdbool.h>

typedef struct tuile_linux_fault {
    char text[256]; /* the last fault; no newline; empty: there was none */
} tuile_linux_fault_t;

/* The tuile_hal_error_t of an errno. A device that is not there is NOT_FOUND as long as it is being opened, and GONE once it was.
 */
int tuile_linux_code(int error, bool opening);

/* "what: the system's words", and what to do about it where that is known. Returns tuile_linux_code. */
__attribute__((format(printf, 4, 5))) int tuile_linux_fail(tuile_linux_fault_t *fault, int error, bool opening, const char *format,
                                                           ...);

/* Just the text; returns code. */
__attribute__((format(printf, 3, 4))) int tuile_linux_say(tuile_linux_fault_t *fault, int code, const char *format, ...);

#endif
