/* Sine and cosine of 16-bit angles to 2^-29, for setting frames up: series on one octant, no table. */
#include "trig.h"

#include "fixed.h"

/* x * y in Q.32, rounded; both below 1. */
static uint64_t multiply_q32(uint64_t x, uint64_t y) { return (x * y + 0x80000000u) >> 32; }

/* 0 <= eighth <= 16384 (an eighth of a turn): x = eighth * 2 pi / 131072 in Q.32. The series end where the next term is below
 * 2^-32 for x <= pi / 4. Coefficients are 2^32 / n!, rounded. */
static uint64_t angle_q32(uint32_t eighth) { return (eighth * UINT64_C(26986075409) + 65536u) >> 17; } /* 2^32 * 2 pi */

static int32_t sine_series(uint32_t eighth) {
    const uint64_t x = angle_q32(eighth), x2 = multiply_q32(x, x);
    uint64_t sum = 108; /* 1/11! */
    sum = 11836 - multiply_q32(sum, x2);
    sum = 852176 - multiply_q32(sum, x2);
    sum = 35791394 - multiply_q32(sum, x2);
    sum = 715827883 - multiply_q32(sum, x2);
    return (int32_t)((x - multiply_q32(multiply_q32(sum, x2), x) + 2) >> 2);
}

static int32_t cosine_series(uint32_t eighth) {
    const uint64_t x = angle_q32(eighth), x2 = multiply_q32(x, x);
    uint64_t sum = 1184; /* 1/10! */
    sum = 106522 - multiply_q32(sum, x2);
    sum = 5965232 - multiply_q32(sum, x2);
    sum = 178956971 - multiply_q32(sum, x2);
    sum = 2147483648u - multiply_q32(sum, x2);
    return (int32_t)((0x100000000u - multiply_q32(sum, x2) + 2) >> 2);
}

q2_30_t trig_sine(uint32_t angle) {
    const uint32_t within = angle & 0x7fffu; /* in its quarter */
    const bool mirrored = angle & 0x8000u, negative = angle & 0x10000u;
    const uint32_t a = mirrored ? 0x8000u - within : within;
    const int32_t value = a <= 0x4000u ? sine_series(a) : cosine_series(0x8000u - a);
    return negative ? -value : value;
}

q2_30_t tuile_sin(bam16_t angle) { return trig_sine(2u * angle); }
q2_30_t tuile_cos(bam16_t angle) { return trig_sine(2u * angle + 0x8000u); }
