/* The sums of a pixel's samples. The number of samples is a constant in each loop. */
#ifndef TUILE_RESOLVE_SUM_H
#define TUILE_RESOLVE_SUM_H

#include "resolve.h"

/* A sample of two bytes, its components apart far enough for sums of sixteen. */
typedef uint32_t (*sum_spread_fn)(uint32_t sample);

TUILE_INLINE void sum_words_by(const uint16_t *at, size_t stride, resolve_run_t *run, sum_spread_fn spread, unsigned shift) {
    const uint32_t along = 1u << shift;
    for (uint32_t i = 0; i < run->count; i++, at += along) {
        uint32_t sum = 0;
        for (uint32_t row = 0; row < along; row++) {
            for (uint32_t column = 0; column < along; column++) {
                sum += spread(at[row * stride + column]);
            }
        }
        run->sums[i] = sum;
    }
}

TUILE_INLINE void sum_words(const void *samples, size_t stride, resolve_run_t *run, sum_spread_fn spread) {
    switch (run->shift) {
    case 0: sum_words_by(samples, stride, run, spread, 0); break;
    case 1: sum_words_by(samples, stride, run, spread, 1); break;
    default: sum_words_by(samples, stride, run, spread, 2); break;
    }
}

#endif
