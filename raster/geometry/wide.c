#include "wide.h"

wide_t wide_make(int64_t mantissa, int32_t exponent) {
    if (mantissa == 0) { return (wide_t){0, 0}; }
    if (mantissa == INT64_MIN) { mantissa = -INT64_MAX; }
    const uint64_t magnitude = (uint64_t)(mantissa < 0 ? -mantissa : mantissa);
    const int up = (int)fixed_clz64(magnitude) - 2;
    if (up >= 0) { return (wide_t){fixed_shift_left64(mantissa, (unsigned)up), exponent - up}; }
    wide_t result = {mantissa >> 1, exponent + 1};
    if (result.mantissa == -((int64_t)1 << 62)) { result = (wide_t){result.mantissa / 2, result.exponent + 1}; }
    return result;
}

wide_t wide_multiply(wide_t a, wide_t b) {
    const int64_t mask = ((int64_t)1 << 31) - 1;
    const int32_t ah = (int32_t)(a.mantissa >> 31), bh = (int32_t)(b.mantissa >> 31); /* 31 bits and a sign */
    const int32_t al = (int32_t)(a.mantissa & mask), bl = (int32_t)(b.mantissa & mask);
    return wide_make(fixed_mul_wide(ah, bh) + (fixed_mul_wide(ah, bl) >> 31) + (fixed_mul_wide(al, bh) >> 31),
                     a.exponent + b.exponent + 62);
}

wide_t wide_add(wide_t a, wide_t b) {
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

wide_t wide_reciprocal(wide_t a) {
    const int64_t divisor = a.mantissa >> 31; /* 2^30 <= |divisor| <= 2^31 */
    if (divisor == 0) { return a; }
    const wide_t rough = wide_make(((int64_t)1 << 62) / divisor, -62 - 31 - a.exponent);
    const wide_t error = wide_add(wide_make(1, 0), wide_negate(wide_multiply(a, rough)));
    return wide_add(rough, wide_multiply(rough, error));
}

int64_t wide_to_integer(wide_t a, int32_t shift) {
    const int32_t exponent = a.exponent + shift;
    if (a.mantissa == 0 || exponent < -63) { return 0; }
    if (exponent > 0) { return a.mantissa < 0 ? -((int64_t)1 << 62) : (int64_t)1 << 62; }
    if (exponent == 0) { return a.mantissa; }
    return ((a.mantissa >> (-exponent - 1)) + 1) >> 1;
}

wide_t wide_dot(const wide_t a[3], const wide_t b[3]) {
    return wide_add(wide_add(wide_multiply(a[0], b[0]), wide_multiply(a[1], b[1])), wide_multiply(a[2], b[2]));
}

void wide_cross(const wide_t a[3], const wide_t b[3], wide_t c[3]) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        c[i] = wide_add(wide_multiply(a[j], b[k]), wide_negate(wide_multiply(a[k], b[j])));
    }
}
