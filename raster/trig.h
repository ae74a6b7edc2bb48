#ifndef TUILE_TRIG_H
#define TUILE_TRIG_H

#include "tuile.h"

/* Sine of an angle in 1/131072 of a turn (the lowest 17 bits count), so that half of any bam16_t is exact. Error below 2^-29. */
q2_30_t trig_sine(uint32_t angle);

#endif
