/* Integer arithmetic that everything else is made of. Each function states its bounds; tests walk their extremes.
 * Signed shifts to the right are arithmetic on every compiler this project supports (asserted below).
 */
#ifndef TUILE_FIXED_H
#define TUILE_FIXED_H

#include <stdbool.h>
#include <stdint.h>

_Static_assert((-1 >> 1) == -1, "signed shifts to the right must be arithmetic");

#if defined(__GNUC__)
#define TUILE_INLINE static inline __attribute__((always_inline))
#define TUILE_NOINLINE __attribute__((noinline))
#define TUILE_LIKELY(x) __builtin_expect(!!(x), 1)
#define TUILE_UNLIKELY(x) __builtin_expect(!!(x), 0)
#else
#define TUILE_INLINE static inline
#define TUILE_NOINLINE
#define TUILE_LIKELY(x) (x)
#define TUILE_UNLIKELY(x) (x)
#endif

/* Leading zero bits of x > 0. */
TUILE_INLINE unsigned fixed_clz32(uint32_t x) {
#if defined(__GNUC__)
    return sizeof(unsigned) == 4 ? (unsigned)__builtin_clz((unsigned)x) : (unsigned)__builtin_clzl((unsigned long)x);
#else
    unsigned n = 0;
    while (!(x & 0x80000000u)) {
        x <<= 1, n++;
    }
    return n;
#endif
}

TUILE_INLINE unsigned fixed_clz64(uint64_t x) {
    const uint32_t high = (uint32_t)(x >> 32);
    return high ? fixed_clz32(high) : 32u + fixed_clz32((uint32_t)x);
}

/* a * 2^bits modulo 2^64, without the undefined left shift of a negative number. */
TUILE_INLINE int64_t fixed_shift_left64(int64_t a, unsigned bits) { return (int64_t)((uint64_t)a << bits); }

/* floor(a / b), b > 0. */
TUILE_INLINE int32_t fixed_floor_div(int32_t a, int32_t b) {
    const int32_t quotient = a / b;
    return quotient - (a % b < 0);
}

TUILE_INLINE int64_t fixed_floor_div64(int64_t a, int64_t b) {
    const int64_t quotient = a / b;
    return quotient - (a % b < 0);
}

/* floor(a * b / 2^32), |a| <= 2^31: |result| < 2^31. */
TUILE_INLINE int32_t fixed_mul_high(intptr_t a, uint32_t b) { return (int32_t)(((int64_t)a * b) >> 32); }

/* floor(a * b / 2^shift) through a 96-bit product, shift <= 62; the result must fit in 63 bits, |a| <= 2^62. */
TUILE_INLINE int64_t fixed_mul_shift(int64_t a, int32_t b, unsigned shift) {
    const int64_t high = (a >> 32) * b;
    const int64_t low = (int64_t)(uint32_t)a * b;
    if (shift <= 32) {
        return (int64_t)(((uint64_t)high << (32 - shift)) + (uint64_t)(low >> shift));
    } /* modulo 2^64: the sum fits */
    return (high + (low >> 32)) >> (shift - 32);
}

/* floor(sqrt(x)). */
static inline uint32_t fixed_sqrt64(uint64_t x) {
    uint64_t root = 0, bit = (uint64_t)1 << 62;
    while (bit > x) {
        bit >>= 2;
    }
    for (; bit; bit >>= 2) {
        if (x >= root + bit) {
            x -= root + bit;
            root = (root >> 1) + bit;
        } else {
            root >>= 1;
        }
    }
    return (uint32_t)root;
}

/* 2^62 / w for w in [2^31, 2^32), in (2^30, 2^31], within 8 of the exact value.
 * A 17-bit quotient from one 32-bit division, then one Newton step: with r0 = r (1 + d), |d| < 2^-15, the step leaves d^2,
 * that is 2^-30, besides the truncations of its own products. */
TUILE_INLINE uint32_t fixed_reciprocal(uint32_t w) {
    const uint32_t r0 = (0xffffffffu / (w >> 16)) << 14;           /* <= 2^17 * 2^14 - 2^14, below 2^31 but for w = 2^31 */
    const uint32_t product = (uint32_t)(((uint64_t)w * r0) >> 32); /* 2^30 (1 + d) */
    const int32_t error = (int32_t)(0x40000000u - product);        /* |error| <= 2^30 * 2^-15 + 1 */
    return r0 + (uint32_t)(((int32_t)(r0 >> 16) * error) >> 14);   /* |product| <= 2^15 * (2^15 + 1) */
}

#endif
