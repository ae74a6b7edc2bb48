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
#define TUILE_SELDOM static __attribute__((noinline, unused)) /* of a header, too long to be in line */
#define TUILE_LIKELY(x) __builtin_expect(!!(x), 1)
#define TUILE_UNLIKELY(x) __builtin_expect(!!(x), 0)
#else
#define TUILE_INLINE static inline
#define TUILE_NOINLINE
#define TUILE_SELDOM static inline
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

/* Registers of 64 bits, so that numbers of that size cost no more than shorter ones. A test may say otherwise, here and below. */
#ifndef FIXED_WIDE_REGISTERS
#define FIXED_WIDE_REGISTERS (UINTPTR_MAX > UINT32_MAX)
#endif

/* Machines that multiply 32 bits by 32 to 32 only (Cortex-M0+) make longer products of halves: a third of what the compiler's
 * functions for any two 64-bit numbers take. */
#ifndef FIXED_BY_HALVES
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__)
#define FIXED_BY_HALVES 1
#else
#define FIXED_BY_HALVES 0
#endif
#endif

/* The lower half. By a register of its own where it counts, since gcc 12 makes two shifts of it before a product otherwise. */
TUILE_INLINE uint32_t fixed_low_half(uint32_t a) {
    uint32_t low = (uint16_t)a;
#if FIXED_BY_HALVES && defined(__GNUC__)
    __asm__("" : "+r"(low));
#endif
    return low;
}

TUILE_INLINE int64_t fixed_mul_wide_by_halves(int32_t a, int32_t b) {
    const int32_t ah = a >> 16, bh = b >> 16;
    const uint32_t al = fixed_low_half((uint32_t)a), bl = fixed_low_half((uint32_t)b), low = al * bl;
    const int32_t cross = ah * (int32_t)bl; /* >= -2^31, < 2^31 - 2^15 */
    const int32_t other = bh * (int32_t)al;
    const uint32_t middle = (low >> 16) + fixed_low_half((uint32_t)cross) + fixed_low_half((uint32_t)other); /* < 3 * 2^16 */
    const int32_t high = ah * bh + (cross >> 16) + (other >> 16) + (int32_t)(middle >> 16);
    return (int64_t)((uint64_t)(uint32_t)high << 32 | middle << 16 | fixed_low_half(low));
}

/* a * b, exactly. */
TUILE_INLINE int64_t fixed_mul_wide(int32_t a, int32_t b) {
    return FIXED_BY_HALVES ? fixed_mul_wide_by_halves(a, b) : (int64_t)a * b;
}

TUILE_INLINE int32_t fixed_mul_round_by_halves(int32_t a, int32_t b) {
    const int32_t ah = a >> 16, bh = b >> 16;
    const uint32_t al = fixed_low_half((uint32_t)a), bl = fixed_low_half((uint32_t)b);
    const int32_t cross = ah * (int32_t)bl, other = bh * (int32_t)al; /* as above */
    const uint32_t middle = (al * bl >> 16) + fixed_low_half((uint32_t)cross) + fixed_low_half((uint32_t)other) + (1u << 15);
    return ah * bh + (cross >> 16) + (other >> 16) + (int32_t)(middle >> 16);
}

/* a * b / 2^32, rounded, a half up. */
TUILE_INLINE int32_t fixed_mul_round(int32_t a, int32_t b) {
    if (FIXED_BY_HALVES) { return fixed_mul_round_by_halves(a, b); }
    const int64_t product = (int64_t)a * b;
    return (int32_t)((uint32_t)(product >> 32) + ((uint32_t)product >> 31));
}

TUILE_INLINE uint64_t fixed_mul_part_by_halves(uint64_t a, uint32_t b) {
    const uint32_t low = (uint32_t)a;
    const uint32_t first = fixed_low_half(low) * b, second = (low >> 16) * b, third = (uint32_t)(a >> 32) * b;
    return first + ((uint64_t)second << 16) + ((uint64_t)third << 32);
}

/* a * b modulo 2^64, 0 <= b < 2^16. */
TUILE_INLINE uint64_t fixed_mul_part(uint64_t a, uint32_t b) { return FIXED_BY_HALVES ? fixed_mul_part_by_halves(a, b) : a * b; }

/* The same for a negative b too, |b| < 2^16. */
TUILE_INLINE uint64_t fixed_mul_signed_part(uint64_t a, int_fast32_t b) {
    if (!FIXED_BY_HALVES) { return a * (uint64_t)b; }
    return b < 0 ? 0 - fixed_mul_part_by_halves(a, (uint32_t)-b) : fixed_mul_part_by_halves(a, (uint32_t)b);
}

/* floor(a * b / 2^32), |a| <= 2^31: |result| < 2^31. */
TUILE_INLINE int32_t fixed_mul_high(int_fast32_t a, uint32_t b) {
    if (FIXED_BY_HALVES) { /* b as a signed number, and 2^32 a where that is less than b */
        const int32_t high = (int32_t)(fixed_mul_wide_by_halves((int32_t)a, (int32_t)b) >> 32);
        return (int32_t)b < 0 ? (int32_t)((uint32_t)high + (uint32_t)a) : high;
    }
    return (int32_t)(((int64_t)a * b) >> 32);
}

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

#endif
