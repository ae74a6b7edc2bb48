/* A bus that writes down what it is told, and fails where it is told to. */
#ifndef TESTS_SUPPORT_RECORDER_H
#define TESTS_SUPPORT_RECORDER_H

#include <stddef.h>
#include <stdint.h>

#include "../../hal/display.h"

typedef struct recorder {
    char log[8192];
    size_t length;
    unsigned calls;
    int fail_with;    /* every call from now on */
    unsigned fail_at; /* or this one, counted from 1 */
    uint32_t command_clock_hz, pixel_clock_hz;
} recorder_t;

/* Empties the recorder and makes a bus with both pins that writes into it: a line a call, of a command the bytes, with a bar where
 * D/C goes from low to high; of data the size and the first byte. The recorder has to outlive the bus. */
tuile_bus_t recorder_bus(recorder_t *recorder);

/* Empties the log only: calls are counted on, faults stay. */
void recorder_forget(recorder_t *recorder);

#endif
