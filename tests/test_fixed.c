/* Numbers: fixed.h and wide.h against long double and exact integers. */
#include "support/check.h"

#include <math.h>

#include "../raster/divide.h"
#include "../raster/fixed.h"
#include "../raster/geometry/wide.h"
#include "support/random.h"

/* ---- fixed.h ------------------------------------------------------------------------------------------------------------------
 */

static const int64_t corners64[] = {0,
                                    1,
                                    -1,
                                    2,
                                    -2,
                                    255,
                                    -256,
                                    65535,
                                    -65536,
                                    INT32_MAX,
                                    INT32_MIN,
                                    (int64_t)INT32_MAX + 1,
                                    UINT32_MAX,
                                    -(int64_t)UINT32_MAX,
                                    INT64_C(1) << 46,
                                    -(INT64_C(1) << 46),
                                    (INT64_C(1) << 62) - 1,
                                    INT64_C(1) << 62,
                                    -(INT64_C(1) << 62)};

static int128_t floor_shift(int128_t a, unsigned bits) {
    const int128_t one = (int128_t)1 << bits;
    return a / one - (a % one < 0);
}

static void floor_divisions_round_down(void **state) {
    random_source_t random = random_seed(20);
    (void)state;
    assert_int_equal(fixed_floor_div(7, 2), 3);
    assert_int_equal(fixed_floor_div(-7, 2), -4);
    assert_int_equal(fixed_floor_div(-8, 2), -4);
    assert_int_equal(fixed_floor_div(INT32_MIN, 1), INT32_MIN);
    assert_int_equal(fixed_floor_div(INT32_MIN, INT32_MAX), -2);
    assert_int_equal(fixed_floor_div64(INT64_MIN, INT64_MAX), -2);
    assert_int_equal(fixed_floor_div64(-1, INT64_MAX), -1);
    for (int round = 0; round < CHECK_ROUNDS(400000); round++) {
        const int64_t a = random_any_size(&random, 62), b = llabs(random_any_size(&random, 62)) + 1;
        const int64_t q = fixed_floor_div64(a, b);
        assert_true((int128_t)q * b <= a && a < ((int128_t)q + 1) * b);
        const int32_t c = (int32_t)random_any_size(&random, 31), d = (int32_t)(llabs(random_any_size(&random, 30)) + 1);
        const int64_t p = fixed_floor_div(c, d);
        assert_true(p * d <= c && c < (p + 1) * d);
    }
}

static void leading_zeros_and_shifts(void **state) {
    (void)state;
    for (unsigned bit = 0; bit < 64; bit++) {
        assert_int_equal(fixed_clz64(UINT64_C(1) << bit), 63 - bit);
        assert_int_equal(fixed_clz64(UINT64_MAX >> bit), bit);
        if (bit < 32) { assert_int_equal(fixed_clz32(UINT32_MAX >> bit), bit); }
        assert_true(fixed_shift_left64(-1, bit) == INT64_MIN >> (63 - bit));
        assert_true(fixed_shift_left64(0, bit) == 0);
    }
}

static void products_are_floored(void **state) {
    random_source_t random = random_seed(21);
    static const uint32_t b32[] = {0, 1, 0x7fffffff, 0x80000000u, 0xffffffffu};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(corners64); i++) {
        for (size_t j = 0; j < CHECK_COUNT(b32); j++) {
            const int32_t a = (int32_t)corners64[i];
            assert_true(fixed_mul_high(a, b32[j]) == floor_shift((int128_t)a * b32[j], 32));
        }
    }
    for (int round = 0; round < CHECK_ROUNDS(2000000); round++) {
        const int64_t a = random_one_in(&random, 4) ? corners64[random_between(&random, 0, CHECK_COUNT(corners64) - 1)]
                                                    : random_any_size(&random, 62);
        int32_t b = (int32_t)random_any_size(&random, 31);
        if (random_one_in(&random, 4)) { b = random_one_in(&random, 2) ? INT32_MAX : -INT32_MAX; }
        const unsigned shift = (unsigned)random_between(&random, 0, 62);
        const int128_t exact = floor_shift((int128_t)a * b, shift);
        if (exact >= (int128_t)1 << 62 || exact < -((int128_t)1 << 62)) { continue; }
        assert_true(fixed_mul_shift(a, b, shift) == exact);
    }
}

/* What machines without long products make of halves is the product. */
static void products_by_halves_are_exact(void **state) {
    static const int32_t ends[] = {0, 1, -1, 0xffff, -0xffff, 0x10000, -0x10000, 0x7fff8000, INT32_MAX, -INT32_MAX, INT32_MIN};
    random_source_t random = random_seed(0x4a1f);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(1000000); round++) {
        const int32_t a =
            random_one_in(&random, 4) ? ends[random_bits(&random) % CHECK_COUNT(ends)] : (int32_t)random_any_size(&random, 31);
        const int32_t b =
            random_one_in(&random, 4) ? ends[random_bits(&random) % CHECK_COUNT(ends)] : (int32_t)random_any_size(&random, 31);
        const uint64_t wide = random_bits(&random);
        const uint32_t part = random_one_in(&random, 4) ? 0xffffu : (uint32_t)random_bits(&random) & 0xffffu;
        assert_true(fixed_mul_wide_by_halves(a, b) == (int64_t)a * b);
        assert_true(fixed_mul_part_by_halves(wide, part) == wide * part);
        assert_true(fixed_mul_wide(a, b) == (int64_t)a * b);
        assert_true(fixed_mul_round_by_halves(a, b) == ((int64_t)a * b + (INT64_C(1) << 31)) >> 32);
        assert_true(fixed_mul_round(a, b) == ((int64_t)a * b + (INT64_C(1) << 31)) >> 32);
        assert_true(fixed_mul_part(wide, part) == wide * part);
        assert_true(fixed_mul_signed_part(wide, -(int_fast32_t)part) == 0 - wide * part);
    }
}

/* By what a floor is. */
static void divisions_by_words_round_down(void **state) {
    static const int64_t ends[] = {0, 1, -1, (1 << 14) - 1, -(1 << 14), ((int64_t)1 << 46) - 1, 1 - ((int64_t)1 << 46)};
    random_source_t random = random_seed(0xd1f);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(1000000); round++) {
        const int64_t a = random_one_in(&random, 8) ? ends[random_bits(&random) % CHECK_COUNT(ends)] : random_any_size(&random, 46);
        const int32_t b = random_one_in(&random, 8)
                              ? (1 << 18) - 1
                              : (int32_t)(random_bits(&random) % ((1u << random_between(&random, 1, 18)) - 1)) + 1;
        const int64_t quotient = divide_floor46_by_words(a, b, random_one_in(&random, 2) ? INT32_MAX / b : 0);
        assert_true(quotient * b <= a && a < (quotient + 1) * b);
    }
}

static void multiply_by_the_least_number(void) {
    if (fixed_mul_shift(-1, INT32_MIN, 0) != INT64_C(1) << 31) { abort(); }
}

static void mul_shift_of_int32_min_overflows_in_between(void **state) {
    (void)state;
    assert_true(check_survives(multiply_by_the_least_number));
}

static void square_roots_are_floored(void **state) {
    random_source_t random = random_seed(22);
    (void)state;
    assert_int_equal(fixed_sqrt64(0), 0);
    assert_int_equal(fixed_sqrt64(UINT64_MAX), UINT32_MAX);
    for (int round = 0; round < CHECK_ROUNDS(400000); round++) {
        uint64_t x = random_bits(&random) >> random_between(&random, 0, 63);
        if (random_one_in(&random, 3)) { /* next to a square */
            const uint64_t r = x >> 32;
            x = r * r + (uint64_t)random_between(&random, -1, 1);
        }
        const uint64_t r = fixed_sqrt64(x);
        assert_true(r * r <= x && x < (uint128_t)(r + 1) * (r + 1));
    }
}

static int64_t worst_reciprocal, least_reciprocal;

static void check_reciprocal(uint32_t w) {
    const uint32_t r = fixed_reciprocal(w);
    /* |r - 2^62 / w| <= 8, that is |r w - 2^62| <= 8 w */
    const int64_t off = (int64_t)((int128_t)r * w - ((int128_t)1 << 62) < 0 ? ((int128_t)1 << 62) - (int128_t)r * w
                                                                            : (int128_t)r * w - ((int128_t)1 << 62));
    assert_true(off <= 8 * (int64_t)w);
    worst_reciprocal = off / w > worst_reciprocal ? off / w : worst_reciprocal;
    least_reciprocal = r < least_reciprocal ? r : least_reciprocal;
    assert_true(r <= 0x80000000u);
}

static void reciprocals_are_within_8(void **state) {
    random_source_t random = random_seed(23);
    (void)state;
    worst_reciprocal = 0;
    least_reciprocal = INT64_MAX;
    for (uint32_t high = 0x8000; high <= 0xffff; high++) {
        static const uint32_t lows[] = {0, 1, 0x7fff, 0x8000, 0xfffe, 0xffff};
        for (size_t i = 0; i < CHECK_COUNT(lows); i++) {
            check_reciprocal(high << 16 | lows[i]);
        }
        for (int i = 0; i < (CHECK_SANITIZED ? 4 : 200); i++) {
            check_reciprocal(high << 16 | (uint32_t)random_between(&random, 0, 0xffff));
        }
    }
    print_message("reciprocal: error below %lld, least value 2^30 + %lld\n", (long long)worst_reciprocal + 1,
                  (long long)(least_reciprocal - (1 << 30)));
}

static void reciprocals_stay_above_2_30(void **state) {
    (void)state;
    for (uint32_t w = 0xffffffffu; w > 0xffffffffu - 100000u; w--) {
        assert_true(fixed_reciprocal(w) > 1u << 30);
    }
}

/* ---- wide.h -------------------------------------------------------------------------------------------------------------------
 */

static void assert_normal(wide_t a) {
    const int64_t m = a.mantissa < 0 ? -a.mantissa : a.mantissa;
    assert_true(m == 0 || (m >= INT64_C(1) << 61 && m < INT64_C(1) << 62));
}

static wide_t random_wide(random_source_t *random) {
    int64_t m = (int64_t)(random_bits(random) >> 3) | INT64_C(1) << 61;
    if (random_one_in(random, 3)) { m = (INT64_C(1) << 61) + (int64_t)(random_bits(random) >> (random_between(random, 20, 63))); }
    if (random_one_in(random, 4)) {
        m = (INT64_C(1) << 62) - 1 - (int64_t)(random_bits(random) >> (random_between(random, 20, 63)));
    }
    return (wide_t){random_one_in(random, 2) ? -m : m, random_between(random, -40, 40)};
}

static void wide_numbers_are_normalised_and_keep_their_value(void **state) {
    random_source_t random = random_seed(24);
    static const int64_t extremes[] = {0,
                                       1,
                                       -1,
                                       INT64_MAX,
                                       INT64_MIN,
                                       INT64_MIN + 1,
                                       INT64_C(1) << 62,
                                       -(INT64_C(1) << 62),
                                       (INT64_C(1) << 62) - 1,
                                       (INT64_C(1) << 61),
                                       -(INT64_C(1) << 61),
                                       -(INT64_C(1) << 62) + 1,
                                       -(INT64_C(1) << 62) - 1};
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(200000); round++) {
        const int64_t m = round < (int)CHECK_COUNT(extremes) ? extremes[round] : random_any_size(&random, 62);
        const wide_t a = wide_make(m, 5);
        assert_normal(a);
        assert_int_equal(wide_sign(a), (m > 0) - (m < 0));
        if (m == 0) {
            assert_int_equal(wide_bits(a), -32768);
            continue;
        }
        /* exact but for one bit of the largest ones */
        const int128_t value = a.exponent >= 5 ? (int128_t)a.mantissa * ((int128_t)1 << (a.exponent - 5))
                                               : floor_shift(a.mantissa, (unsigned)(5 - a.exponent));
        const int128_t off = value - m;
        assert_true(off >= -1 && off <= 1);
        if (m > -(INT64_C(1) << 62) && m < INT64_C(1) << 62) { assert_true(off == 0); }
        const int32_t bits = wide_bits(a) - 5;
        const uint128_t magnitude = (uint128_t)(m < 0 ? -(int128_t)m : m);
        if (m != INT64_MIN && off == 0) {
            assert_true(magnitude < (uint128_t)1 << bits && magnitude >= (uint128_t)1 << (bits - 1));
        }
    }
}

static void wide_products_are_as_near_as_they_say(void **state) {
    random_source_t random = random_seed(25);
    long double worst = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(2000000); round++) {
        const wide_t a = random_wide(&random), b = random_wide(&random), p = wide_multiply(a, b);
        assert_normal(p);
        const int shift = p.exponent - a.exponent - b.exponent;
        assert_true(shift >= 60 && shift <= 62);
        const int128_t exact = (int128_t)a.mantissa * b.mantissa, off = (int128_t)p.mantissa * ((int128_t)1 << shift) - exact;
        const long double error = fabsl((long double)off / (long double)exact);
        worst = error > worst ? error : worst;
    }
    print_message("wide_multiply: relative error 2^%.3Lf\n", log2l(worst));
    assert_true(worst < 0x1p-58L);
}

static void wide_sums_are_as_near_as_they_say(void **state) {
    random_source_t random = random_seed(26);
    long double worst = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(1000000); round++) {
        wide_t a = random_wide(&random), b = random_wide(&random);
        if (random_one_in(&random, 3)) { b.exponent = a.exponent; }
        if (abs(a.exponent - b.exponent) > 62) { continue; }
        const wide_t s = wide_add(a, b);
        assert_normal(s);
        const int32_t low = a.exponent < b.exponent ? a.exponent : b.exponent;
        const int128_t exact =
            (int128_t)a.mantissa * ((int128_t)1 << (a.exponent - low)) + (int128_t)b.mantissa * ((int128_t)1 << (b.exponent - low));
        const int128_t got = s.exponent >= low ? (int128_t)s.mantissa * ((int128_t)1 << (s.exponent - low))
                                               : floor_shift(s.mantissa, (unsigned)(low - s.exponent));
        const long double larger = fmaxl(ldexpl(fabsl((long double)a.mantissa), a.exponent - low),
                                         ldexpl(fabsl((long double)b.mantissa), b.exponent - low));
        const long double error = fabsl((long double)(got - exact)) / larger;
        worst = error > worst ? error : worst;
    }
    print_message("wide_add: error 2^%.3Lf of the larger summand\n", log2l(worst));
    assert_true(worst < 0x1p-60L);
    const wide_t zero = {0, 0}, one = wide_make(1, 0), tiny = wide_make(1, -200);
    assert_true(wide_add(zero, one).mantissa == one.mantissa && wide_add(one, zero).exponent == one.exponent);
    assert_true(wide_add(tiny, one).mantissa == one.mantissa && wide_add(one, wide_negate(one)).mantissa == 0);
}

static void check_reciprocals(int sign, const char *what) {
    random_source_t random = random_seed(27);
    long double worst = 0;
    for (int round = 0; round < CHECK_ROUNDS(1000000); round++) {
        wide_t a = random_wide(&random);
        if (wide_sign(a) != sign) { a = wide_negate(a); }
        const wide_t r = wide_reciprocal(a);
        assert_normal(r);
        const long double product = ldexpl((long double)a.mantissa * (long double)r.mantissa, a.exponent + r.exponent);
        worst = fmaxl(worst, fabsl(product - 1));
    }
    print_message("wide_reciprocal of %s numbers: relative error 2^%.4Lf\n", what, log2l(worst));
    assert_true(worst < 0x1p-56L);
}

static void wide_reciprocals_are_as_near_as_they_say(void **state) {
    (void)state;
    check_reciprocals(1, "positive");
}

static void wide_reciprocals_of_negative_numbers_too(void **state) {
    (void)state;
    check_reciprocals(-1, "negative");
}

static void wide_numbers_are_rounded_to_integers(void **state) {
    random_source_t random = random_seed(28);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(400000); round++) {
        const wide_t a = random_wide(&random);
        const int32_t shift = random_between(&random, -110, 60), exponent = a.exponent + shift;
        const int64_t got = wide_to_integer(a, shift);
        if (exponent > 0) {
            assert_true(got == (a.mantissa < 0 ? -(INT64_C(1) << 62) : INT64_C(1) << 62));
        } else if (exponent >= -64) { /* floor(x + 1/2) */
            const int128_t half = exponent < 0 ? (int128_t)1 << (-exponent - 1) : 0;
            assert_true(got == floor_shift((int128_t)a.mantissa + half, (unsigned)-exponent));
        } else {
            assert_true(got == 0);
        }
    }
    assert_true(wide_to_integer((wide_t){0, 0}, 200) == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floor_divisions_round_down),
        cmocka_unit_test(leading_zeros_and_shifts),
        cmocka_unit_test(products_are_floored),
        cmocka_unit_test(products_by_halves_are_exact),
        cmocka_unit_test(divisions_by_words_round_down),
        cmocka_unit_test(mul_shift_of_int32_min_overflows_in_between),
        cmocka_unit_test(square_roots_are_floored),
        cmocka_unit_test(reciprocals_are_within_8),
        cmocka_unit_test(reciprocals_stay_above_2_30),
        cmocka_unit_test(wide_numbers_are_normalised_and_keep_their_value),
        cmocka_unit_test(wide_products_are_as_near_as_they_say),
        cmocka_unit_test(wide_sums_are_as_near_as_they_say),
        cmocka_unit_test(wide_reciprocals_are_as_near_as_they_say),
        cmocka_unit_test(wide_reciprocals_of_negative_numbers_too),
        cmocka_unit_test(wide_numbers_are_rounded_to_integers),
    };
    return cmocka_run_group_tests_name("fixed", tests, NULL, NULL);
}
