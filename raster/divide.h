/* Quotients for machines that do not divide (Cortex-M0+), where a division takes the compiler's function 130 instructions: a table
 * of reciprocals gives nearly all of it, and a remainder or two the rest. All are exact but slopes of sides, which need not be;
 * tests/test_divide.c walks all arguments.
 */
#ifndef TUILE_DIVIDE_H
#define TUILE_DIVIDE_H

#include "fixed.h"

#define DIVIDE_TABLE 512
extern const uint32_t divide_table[DIVIDE_TABLE];

/* Of dy: 2^(20 + shift) / dy, to the nearest, with as many places as leave its product with |dx| < 512 below 2^31: shift is 2 and
 * the places that dy has behind its first one. */
typedef struct divide_side {
    uint32_t shift, inverse;
} divide_side_t;
extern const divide_side_t divide_sides[DIVIDE_TABLE];

/* dx * 2^20 / dy, |dx| < 512, 0 < dy < 512: less than 1 + |dx| / (4 dy) too small, or |dx| / (4 dy) too large. */
TUILE_INLINE int32_t divide_side_by_table(int32_t dx, int32_t dy) {
    const divide_side_t side = divide_sides[dy];
    return (dx * (int32_t)side.inverse) >> side.shift;
}

/* quotient and rest of n by d, when they are off by little. */
TUILE_INLINE uint32_t divide_settle(uint32_t quotient, int32_t rest, int32_t d) {
    for (; rest < 0; rest += d) {
        quotient--;
    }
    for (; rest >= d; rest -= d) {
        quotient++;
    }
    return quotient;
}

/* floor((2^31 - 1) / area), 0 < area < 2^18. Below 512 it is the table's number, or one less for powers of two. Else that of the
 * upper 9 bits of area is off by 2^-8 of itself, and two corrections by the rest leave a few units. */
TUILE_INLINE int32_t divide_area_by_table(int32_t area) {
    if (area < DIVIDE_TABLE) { return (int32_t)(divide_table[area] - ((area & (area - 1)) == 0)); }
    unsigned shift = 0;
    while (area >> shift >= DIVIDE_TABLE) {
        shift++;
    }
    const int32_t inverse = (int32_t)(divide_table[area >> shift] >> 9); /* <= 2^14 */
    int32_t quotient = (inverse << 9) >> shift;
    int32_t rest = (int32_t)((uint32_t)INT32_MAX - (uint32_t)quotient * (uint32_t)area); /* |rest| < 2^24 */
    int32_t more = ((rest >> 8) * inverse) >> (14 + shift);
    quotient += more;
    rest -= more * area; /* below 2^18 in size */
    more = ((rest >> 1) * inverse) >> (21 + shift);
    return (int32_t)divide_settle((uint32_t)(quotient + more), rest - more * area, area);
}

/* floor((2^32 - 1) / d), 2^15 <= d < 2^16. */
TUILE_INLINE uint32_t divide_ones_by_table(uint32_t d) {
    const int32_t inverse = (int32_t)(divide_table[d >> 7] >> 9); /* 2^13 ... 2^14 */
    const uint32_t quotient = (uint32_t)inverse << 3;
    const int32_t rest = (int32_t)(UINT32_MAX - quotient * d), more = ((rest >> 8) * inverse) >> 21; /* |rest| < 2^25 */
    return divide_settle(quotient + (uint32_t)more, rest - more * (int32_t)d, (int32_t)d);
}

/* n / b by r, floor((2^31 - 1) / b): at most 4 too small before it is put right. */
TUILE_INLINE uint32_t divide_by_reciprocal(uint32_t n, uint32_t b, int32_t r) {
    const uint32_t quotient = (uint32_t)(fixed_mul_wide_by_halves((int32_t)(n >> 1), r) >> 30);
    return divide_settle(quotient, (int32_t)(n - quotient * b), (int32_t)b);
}

/* A divisor below 2^18 and its reciprocal, 2^-31 * (r + f / 2^31) but for 2^-44 of it. */
typedef struct divide_area {
    int32_t area, r, f;
} divide_area_t;

/* r = floor((2^31 - 1) / area): 2^31 = r * area + rest, and rest / area is rest * r / 2^31 but for rest / 2^31. */
TUILE_INLINE divide_area_t divide_area_of(int32_t area, int32_t r) {
    return (divide_area_t){area, r, (int32_t)(0x80000000u - (uint32_t)r * (uint32_t)area) * r}; /* rest <= area */
}

/* floor(n * 2^bits / area): |n| < 2^31 with bits 12, |n| < 2^18 with 28. n * f / 2^31 is cut where it is less than 2^17 or 2^5 off,
 * so the quotient is 1 or 4 off, or not, before its rest, which is known modulo 2^32, puts it right. */
TUILE_INLINE int64_t divide_scaled(int32_t n, unsigned bits, divide_area_t by) {
    const int32_t more = bits == 12 ? (n >> 16) * (by.f >> 16) * 2 : (n * (by.f >> 18)) >> 13;
    int64_t quotient = (fixed_mul_wide(n, by.r) + more) >> (31 - bits);
    int32_t rest = (int32_t)(((uint32_t)n << bits) - (uint32_t)quotient * (uint32_t)by.area);
    for (; rest < 0; rest += by.area) {
        quotient--;
    }
    for (; rest >= by.area; rest -= by.area) {
        quotient++;
    }
    return quotient;
}

/* floor(a / b), |a| < 2^46, 0 < b < 2^18, by 32-bit divisions: 14 bits of a at a time, so that remainders leave room for them. With
 * r above 0, divide_by_reciprocal. */
TUILE_INLINE int64_t divide_floor46_by_words(int64_t a, int32_t b, int32_t r) {
    const uint32_t divisor = (uint32_t)b;
    const uint64_t size = a < 0 ? ~(uint64_t)a : (uint64_t)a; /* floor(a / b) = -1 - floor((-1 - a) / b) */
    const uint32_t high = (uint32_t)(size >> 14), quotient = r > 0 ? divide_by_reciprocal(high, divisor, r) : high / divisor;
    const uint32_t low = (high - quotient * divisor) << 14 | ((uint32_t)size & 0x3fffu);
    const uint64_t whole = ((uint64_t)quotient << 14) + (r > 0 ? divide_by_reciprocal(low, divisor, r) : low / divisor);
    return (int64_t)(a < 0 ? ~whole : whole);
}

/* The same; r = floor((2^31 - 1) / b), which only some machines make use of. */
TUILE_INLINE int64_t divide_floor46(int64_t a, int32_t b, int32_t r) {
    return FIXED_WIDE_REGISTERS ? fixed_floor_div64(a, b) : divide_floor46_by_words(a, b, FIXED_BY_HALVES ? r : 0);
}

/* dx * 2^20 / dy, less than 1 + |dx| / (4 dy) too small or too large. */
TUILE_INLINE int32_t divide_side(int32_t dx, int32_t dy) {
    return FIXED_BY_HALVES ? divide_side_by_table(dx, dy) : dx * (INT32_C(1) << 20) / dy;
}

TUILE_INLINE int32_t divide_area(int32_t area) { return FIXED_BY_HALVES ? divide_area_by_table(area) : INT32_MAX / area; }

TUILE_INLINE uint32_t divide_ones(uint32_t d) { return FIXED_BY_HALVES ? divide_ones_by_table(d) : UINT32_MAX / d; }

/* 2^62 / w for w in [2^31, 2^32), in (2^30, 2^31], within 8 of the exact value.
 * A 17-bit quotient from one 32-bit division, then one Newton step: with r0 = r (1 + d), |d| < 2^-15, the step leaves d^2,
 * that is 2^-30, besides the truncations of its own products. */
TUILE_INLINE uint32_t fixed_reciprocal(uint32_t w) {
    const uint32_t r0 = divide_ones(w >> 16) << 14; /* <= 2^17 * 2^14 - 2^14, below 2^31 but for w = 2^31 */
    const uint32_t product = FIXED_BY_HALVES ? (uint32_t)fixed_mul_high((int32_t)r0, w) : (uint32_t)(((uint64_t)w * r0) >> 32);
    /* 2^30 (1 + d) */
    const int32_t error = (int32_t)(0x40000000u - product);      /* |error| <= 2^30 * 2^-15 + 1 */
    return r0 + (uint32_t)(((int32_t)(r0 >> 16) * error) >> 14); /* |product| <= 2^15 * (2^15 + 1) */
}

#endif
