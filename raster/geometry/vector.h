/* Vectors of three: cross products and unit length, for setting frames up. */
#ifndef TUILE_GEOMETRY_VECTOR_H
#define TUILE_GEOMETRY_VECTOR_H

#include "../fixed.h"
#include "../tuile.h"

/* unit = v / |v| in Q2.30 with an error of a few 2^-30; false for the zero vector. |v[i]| <= 2^62. */
static inline bool vector_normalise(q2_30_t unit[3], const int64_t v[3]) {
    uint64_t all = 0;
    for (int i = 0; i < 3; i++) {
        all |= (uint64_t)(v[i] < 0 ? -v[i] : v[i]);
    }
    if (all == 0) { return false; }
    const int up = (int)fixed_clz64(all) - 33; /* the largest component becomes 31 bits wide: squares add up to less than 2^64 */
    int64_t scaled[3] = {0};
    uint64_t sum = 0;
    for (int i = 0; i < 3; i++) {
        scaled[i] = up >= 0 ? fixed_shift_left64(v[i], (unsigned)up) : v[i] >> -up;
        sum += (uint64_t)(scaled[i] * scaled[i]);
    }
    const int64_t length = fixed_sqrt64(sum);
    for (int i = 0; i < 3; i++) {
        unit[i] = (q2_30_t)fixed_floor_div64(fixed_shift_left64(scaled[i], 30) + length / 2, length);
    }
    return true;
}

/* Q2.30 x Q2.30 in Q4.60; |components| <= 1.0 each, so the differences stay below 2^61. */
static inline void vector_cross(int64_t cross[3], const q2_30_t a[3], const q2_30_t b[3]) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        cross[i] = (int64_t)a[j] * b[k] - (int64_t)a[k] * b[j];
    }
}

#endif
