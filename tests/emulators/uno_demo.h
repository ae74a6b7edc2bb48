/* What the Uno's demo (firmware/uno/demo.c) must show, and when. */
#ifndef TESTS_EMULATORS_UNO_DEMO_H
#define TESTS_EMULATORS_UNO_DEMO_H

#include "../../sim/picture.h"

#include <stdbool.h>

typedef struct uno_demo {
    unsigned show, frame; /* the frame of the show's views */
    unsigned press_ms;    /* after it, the button is pressed for so long; 0: it is not */
    bool last;
} uno_demo_t;

/* Of the n-th frame, from 0: all shows by time, then a short press, a long one, and a show that stays. */
uno_demo_t uno_demo_at(unsigned n);

/* Reads the rate in the upper right corner, in tenths a second, and holds it against that of the frame before (0: there was none).
 * Then the corner of `wanted` is made as that of `seen`. -1 and one line in error when it is not a number, or another. */
int uno_demo_corner(const sim_picture_t *seen, sim_picture_t *wanted, double rate, sim_error_t *error);

#endif
