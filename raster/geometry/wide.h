/* Numbers of about 61 bits with an exponent of their own: what floating point would be used for when a frame is set up
 * (matrices, planes), a few hundred operations a frame. Not for vertices, faces or pixels.
 */
#ifndef TUILE_GEOMETRY_WIDE_H
#define TUILE_GEOMETRY_WIDE_H

#include "../fixed.h"
#include "../tuile.h"

#if FIXED_BY_HALVES && defined(__GNUC__)
#define WIDE_BY_WORDS __attribute__((packed, aligned(4))) /* gcc calls memcpy in Thumb-1 for structures whose alignment is 8 */
#else
#define WIDE_BY_WORDS
#endif

/* mantissa * 2^exponent, with 2^61 <= |mantissa| < 2^62, or 0. Exponents stay within +-2^14 by far in all that is done here. */
typedef struct WIDE_BY_WORDS wide {
    int64_t mantissa;
    int32_t exponent;
} wide_t;

/* mantissa * 2^exponent, whatever the mantissa; its lowest bits may be lost. */
wide_t wide_make(int64_t mantissa, int32_t exponent);

/* Relative error below 2^-58: three truncations of a product of 2^60 or more. */
wide_t wide_multiply(wide_t a, wide_t b);

/* Error below 2^-60 of the larger summand. */
wide_t wide_add(wide_t a, wide_t b);

/* 1 / a, 0 for 0; relative error below 2^-56: a 30-bit quotient and one Newton step. */
wide_t wide_reciprocal(wide_t a);

/* a * 2^shift rounded to an integer; saturates at +-2^62. */
int64_t wide_to_integer(wide_t a, int32_t shift);

wide_t wide_dot(const wide_t a[3], const wide_t b[3]);

/* c may be neither a nor b. */
void wide_cross(const wide_t a[3], const wide_t b[3], wide_t c[3]);

static inline wide_t wide_scale(tuile_scale_t scale) { return wide_make(scale.mantissa, scale.exponent); }
static inline wide_t wide_negate(wide_t a) { return (wide_t){-a.mantissa, a.exponent}; }
static inline wide_t wide_abs(wide_t a) { return a.mantissa < 0 ? wide_negate(a) : a; }

/* The least n with |a| < 2^n; -32768 for 0. */
static inline int32_t wide_bits(wide_t a) { return a.mantissa == 0 ? -32768 : a.exponent + 62; }

/* -1, 0, 1 */
static inline int wide_sign(wide_t a) { return (a.mantissa > 0) - (a.mantissa < 0); }

#endif
