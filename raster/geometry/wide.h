/* Numbers of about 61 bits with an exponent of their own: what floating point would be used for when a frame is set up
 * (matrices, planes), a few hundred operations a frame. Not for vertices, faces or pixels.
 */
#ifndef TUILE_GEOMETRY_WIDE_H
#define TUILE_GEOMETRY_WIDE_H

#include "../fixed.h"

/* mantissa * 2^exponent, with 2^61 <= |mantissa| < 2^62, or 0. Exponents stay within +-2^14 by far in all that is done here. */
typedef struct wide {
    int64_t mantissa;
    int32_t exponent;
} wide_t;

static inline wide_t wide_make(int64_t mantissa, int32_t exponent) {
    if (mantissa == 0) { return (wide_t){0, 0}; }
    if (mantissa == INT64_MIN) { mantissa = -INT64_MAX; }
    const uint64_t magnitude = (uint64_t)(mantissa < 0 ? -mantissa : mantissa);
    const int up = (int)fixed_clz64(magnitude) - 2;
    if (up >= 0) { return (wide_t){fixed_shift_left64(mantissa, (unsigned)up), exponent - up}; }
    wide_t result = {mantissa >> 1, exponent + 1};
    if (result.mantissa == -((int64_t)1 << 62)) { result = (wide_t){result.mantissa / 2, result.exponent + 1}; }
    return result;
}

static inline wide_t wide_negate(wide_t a) { return (wide_t){-a.mantissa, a.exponent}; }
static inline wide_t wide_abs(wide_t a) { return a.mantissa < 0 ? wide_negate(a) : a; }

/* Relative error below 2^-58: three truncations of a product of 2^60 or more. */
static inline wide_t wide_multiply(wide_t a, wide_t b) {
    const int64_t mask = ((int64_t)1 << 31) - 1;
    const int64_t ah = a.mantissa >> 31, al = a.mantissa & mask, bh = b.mantissa >> 31, bl = b.mantissa & mask;
    return wide_make(ah * bh + ((ah * bl) >> 31) + ((al * bh) >> 31), a.exponent + b.exponent + 62);
}

/* Error below 2^-60 of the larger summand. */
static inline wide_t wide_add(wide_t a, wide_t b) {
    if (a.mantissa == 0) { return b; }
    if (b.mantissa == 0) { return a; }
    if (a.exponent < b.exponent) {
        const wide_t swap = a;
        a = b;
        b = swap;
    }
    const int32_t shift = a.exponent - b.exponent;
    return shift > 62 ? a : wide_make(a.mantissa + (b.mantissa >> shift), a.exponent);
}

/* 1 / a, 0 for 0; relative error below 2^-56: a 30-bit quotient and one Newton step. */
static inline wide_t wide_reciprocal(wide_t a) {
    const int64_t divisor = a.mantissa >> 31; /* 2^30 <= |divisor| <= 2^31 */
    if (divisor == 0) { return a; }
    const wide_t rough = wide_make(((int64_t)1 << 62) / divisor, -62 - 31 - a.exponent);
    const wide_t error = wide_add(wide_make(1, 0), wide_negate(wide_multiply(a, rough)));
    return wide_add(rough, wide_multiply(rough, error));
}

/* a * 2^shift rounded to an integer; saturates at +-2^62. */
static inline int64_t wide_to_integer(wide_t a, int32_t shift) {
    const int32_t exponent = a.exponent + shift;
    if (a.mantissa == 0 || exponent < -63) { return 0; }
    if (exponent > 0) { return a.mantissa < 0 ? -((int64_t)1 << 62) : (int64_t)1 << 62; }
    if (exponent == 0) { return a.mantissa; }
    return ((a.mantissa >> (-exponent - 1)) + 1) >> 1;
}

/* The least n with |a| < 2^n; -32768 for 0. */
static inline int32_t wide_bits(wide_t a) { return a.mantissa == 0 ? -32768 : a.exponent + 62; }

/* -1, 0, 1 */
static inline int wide_sign(wide_t a) { return (a.mantissa > 0) - (a.mantissa < 0); }

#endif
