/* Sine and cosine of 16-bit angles to 2^-29, for setting frames up: series on one octant, no table. */
#include "fixed.h"
#include "tuile.h"

/* x * y, Q2.30, rounded; |x|, |y| <= 2^30 (1.0). */
static int32_t multiply_q30(int32_t x, int32_t y) { return (int32_t)(((int64_t)x * y + (1 << 29)) >> 30); }

/* 0 <= eighth <= 8192 (an eighth of a turn): x = eighth * 2 pi / 65536 in Q2.30. The series end where the next term is below
 * 2^-31 for x <= pi / 4. Coefficients are 2^30 / n!, rounded. */
static int32_t angle_q30(uint32_t eighth) { return (int32_t)(((uint64_t)eighth * 6746518852u + 32768u) >> 16); } /* 2^30 * 2 pi */

static int32_t sine_series(uint32_t eighth) {
    const int32_t x = angle_q30(eighth), x2 = multiply_q30(x, x);
    int32_t sum = 2959; /* 1/9! */
    sum = 213044 - multiply_q30(sum, x2);
    sum = 8947849 - multiply_q30(sum, x2);
    sum = 178956971 - multiply_q30(sum, x2);
    return x - multiply_q30(multiply_q30(sum, x2), x);
}

static int32_t cosine_series(uint32_t eighth) {
    const int32_t x = angle_q30(eighth), x2 = multiply_q30(x, x);
    int32_t sum = 296; /* 1/10! */
    sum = 26631 - multiply_q30(sum, x2);
    sum = 1491308 - multiply_q30(sum, x2);
    sum = 44739243 - multiply_q30(sum, x2);
    sum = 536870912 - multiply_q30(sum, x2);
    return TUILE_ONE_Q30 - multiply_q30(sum, x2);
}

q2_30_t tuile_sin(bam16_t angle) {
    const uint32_t within = angle & 0x3fffu; /* in its quarter */
    const bool mirrored = angle & 0x4000u, negative = angle & 0x8000u;
    const uint32_t a = mirrored ? 0x4000u - within : within;
    const int32_t value = a <= 0x2000u ? sine_series(a) : cosine_series(0x4000u - a);
    return negative ? -value : value;
}

q2_30_t tuile_cos(bam16_t angle) { return tuile_sin((bam16_t)(angle + 0x4000u)); }
