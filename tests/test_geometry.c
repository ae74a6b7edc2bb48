/* Numbers, vectors, angles, cameras, the way of a vertex to the window, lights and culling, against long double and exact integers.
 */
#include "support/check.h"

#include <math.h>

#include "../raster/geometry/cull.h"
#include "../raster/geometry/model.h"
#include "../raster/geometry/transform.h"
#include "../raster/geometry/vector.h"
#include "../raster/geometry/vertex.h"
#include "../raster/geometry/wide.h"
#include "support/random.h"

#define TURN 6.283185307179586476925286766559L

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

/* ---- vectors, angles, cameras ---------------------------------------------------------------------------------------------------
 */

static void unit_vectors_are_within_a_few_units(void **state) {
    random_source_t random = random_seed(29);
    long double worst = 0;
    q2_30_t unit[3];
    (void)state;
    assert_false(vector_normalise(unit, (const int64_t[3]){0, 0, 0}));
    for (int i = 0; i < 3; i++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            for (unsigned bit = 0; bit <= 62; bit++) {
                int64_t v[3] = {0, 0, 0};
                v[i] = sign * (INT64_C(1) << bit);
                assert_true(vector_normalise(unit, v));
                for (int j = 0; j < 3; j++) {
                    assert_int_equal(unit[j], i == j ? sign * TUILE_ONE_Q30 : 0);
                }
            }
        }
    }
    for (int round = 0; round < CHECK_ROUNDS(500000); round++) {
        const unsigned bits = (unsigned)random_between(&random, 1, 62);
        int64_t v[3];
        for (int i = 0; i < 3; i++) {
            v[i] = random_any_size(&random, bits);
        }
        if (random_one_in(&random, 50)) { v[0] = v[1] = v[2] = random_one_in(&random, 2) ? INT64_C(1) << 62 : -(INT64_C(1) << 62); }
        if (v[0] == 0 && v[1] == 0 && v[2] == 0) { continue; }
        assert_true(vector_normalise(unit, v));
        const long double length = sqrtl((long double)v[0] * (long double)v[0] + (long double)v[1] * (long double)v[1] +
                                         (long double)v[2] * (long double)v[2]);
        for (int i = 0; i < 3; i++) {
            worst = fmaxl(worst, fabsl((long double)unit[i] - 0x1p30L * (long double)v[i] / length));
        }
    }
    print_message("vector_normalise: %.3Lf * 2^-30\n", worst);
    assert_true(worst <= 4);
}

static void cross_products_are_exact_to_the_ends(void **state) {
    static const q2_30_t values[] = {TUILE_ONE_Q30, -TUILE_ONE_Q30, 0, 1, -1, TUILE_ONE_Q30 - 1};
    random_source_t random = random_seed(30);
    int64_t cross[3];
    (void)state;
    vector_cross(cross, (const q2_30_t[3]){TUILE_ONE_Q30, 0, 0}, (const q2_30_t[3]){0, TUILE_ONE_Q30, 0});
    assert_true(cross[0] == 0 && cross[1] == 0 && cross[2] == INT64_C(1) << 60);
    for (int round = 0; round < 20000; round++) {
        q2_30_t a[3], b[3];
        for (int i = 0; i < 3; i++) {
            a[i] = values[random_between(&random, 0, CHECK_COUNT(values) - 1)];
            b[i] = values[random_between(&random, 0, CHECK_COUNT(values) - 1)];
        }
        vector_cross(cross, a, b);
        assert_true(cross[0] == (int128_t)a[1] * b[2] - (int128_t)a[2] * b[1]);
        assert_true(cross[1] == (int128_t)a[2] * b[0] - (int128_t)a[0] * b[2]);
        assert_true(cross[2] == (int128_t)a[0] * b[1] - (int128_t)a[1] * b[0]);
    }
}

static void sines_of_all_angles(void **state) {
    long double worst = 0;
    (void)state;
    assert_int_equal(tuile_sin(0), 0);
    assert_int_equal(tuile_sin(0x4000), TUILE_ONE_Q30);
    assert_int_equal(tuile_sin(0x8000), 0);
    assert_int_equal(tuile_sin(0xc000), -TUILE_ONE_Q30);
    assert_int_equal(tuile_cos(0), TUILE_ONE_Q30);
    assert_int_equal(tuile_cos(0x4000), 0);
    assert_int_equal(tuile_cos(0x8000), -TUILE_ONE_Q30);
    assert_int_equal(tuile_cos(0xc000), 0);
    for (uint32_t a = 0; a < 65536; a++) {
        const long double angle = (long double)a * TURN / 65536;
        const int32_t s = tuile_sin((bam16_t)a), c = tuile_cos((bam16_t)a);
        worst = fmaxl(worst, fmaxl(fabsl((long double)s - 0x1p30L * sinl(angle)), fabsl((long double)c - 0x1p30L * cosl(angle))));
        assert_int_equal(s, -tuile_sin((bam16_t)(65536 - a)));
        assert_int_equal(s, tuile_sin((bam16_t)(32768 - a)));
        assert_int_equal(c, tuile_cos((bam16_t)(65536 - a)));
        assert_true(s <= TUILE_ONE_Q30 && s >= -TUILE_ONE_Q30);
    }
    print_message("sine: %.3Lf * 2^-30\n", worst);
    assert_true(worst <= 2);
}

static void focal_lengths(void **state) {
    (void)state;
    assert_int_equal(tuile_focal_px(0, 240), 0);
    assert_int_equal(tuile_focal_px(0x8000, 240), 0);
    assert_int_equal(tuile_focal_px(0x4000, 0), 0);
    assert_int_equal(tuile_focal_px(0x4000, 240), 120 << 16); /* a quarter turn: half the size */
    for (uint32_t fov = 1; fov < 32768; fov++) {
        static const uint16_t sizes[] = {1, 240, 1024, 65535};
        for (size_t i = 0; i < CHECK_COUNT(sizes); i++) {
            const long double half = (long double)fov * TURN / 131072;
            const long double exact = 65536.0L * sizes[i] / 2 / tanl(half);
            const q16_16_t focal = tuile_focal_px((bam16_t)fov, sizes[i]);
            if (exact < INT32_MAX - 65536.0L) {
                /* Sine and cosine are off by 2^-29: what is that of (1 + cos fov) / sin fov? */
                const long double share = 0x1p-29L / sinl(2 * half) + 0x1p-29L / (1 + cosl(2 * half));
                assert_true(fabsl((long double)focal - exact) <= 1 + 1.001L * exact * share);
            } else if (exact > INT32_MAX + 65536.0L) {
                assert_int_equal(focal, 0);
            }
        }
    }
}

static void narrowest_field_of_view(void) {
    if (tuile_focal_px(1, 1) < 0 || tuile_focal_px(1, 1024) != 0) { abort(); }
}

static void the_narrowest_field_of_view_does_not_divide_by_zero(void **state) {
    (void)state;
    assert_true(check_survives(narrowest_field_of_view));
}

static void rotations_turn_counter_clockwise(void **state) {
    (void)state;
    for (int axis = 0; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        q2_30_t r[3][3];
        tuile_rotation(r, axis, 0x4000);
        assert_int_equal(r[v][u], TUILE_ONE_Q30); /* a quarter turn about x leads y to z, and so on */
        assert_int_equal(r[u][v], -TUILE_ONE_Q30);
        assert_int_equal(r[axis][axis], TUILE_ONE_Q30);
        assert_int_equal(r[u][u], 0);
        for (uint32_t angle = 0; angle < 65536; angle += 17) {
            tuile_rotation(r, axis, (bam16_t)angle);
            for (int i = 0; i < 3; i++) {
                for (int j = 0; j < 3; j++) {
                    int64_t dot = 0;
                    for (int k = 0; k < 3; k++) {
                        dot += (int64_t)r[i][k] * r[j][k];
                    }
                    assert_true(llabs(dot - (i == j ? INT64_C(1) << 60 : 0)) <= INT64_C(6) << 30);
                }
            }
        }
    }
}

static void assert_rotation(const tuile_camera_t *camera, const double expected[3][3]) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            assert_true(fabs(camera->rotation[i][j] - expected[i][j] * 0x1p30) <= 4);
        }
    }
}

static void looking_at_a_point(void **state) {
    static const q16_16_t origin[3] = {0, 0, 0}, up[3] = {0, TUILE_Q16(1), 0};
    tuile_camera_t camera;
    (void)state;
    memset(&camera, 0, sizeof camera);
    const q16_16_t front[3] = {0, 0, TUILE_Q16(5)}, right[3] = {TUILE_Q16(5), 0, 0}, above[3] = {0, TUILE_Q16(7), 0};
    assert_int_equal(tuile_camera_look_at(&camera, front, origin, up), TUILE_OK);
    assert_rotation(&camera, (const double[3][3]){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    assert_memory_equal(camera.eye, front, sizeof front);
    assert_int_equal(tuile_camera_look_at(&camera, right, origin, up), TUILE_OK);
    assert_rotation(&camera, (const double[3][3]){{0, 0, -1}, {0, 1, 0}, {1, 0, 0}});
    assert_int_equal(tuile_camera_look_at(&camera, above, origin, (const q16_16_t[3]){0, 0, -TUILE_Q16(1)}), TUILE_OK);
    assert_rotation(&camera, (const double[3][3]){{1, 0, 0}, {0, 0, -1}, {0, 1, 0}});
    /* up leans: it is only a hint */
    assert_int_equal(tuile_camera_look_at(&camera, front, origin, (const q16_16_t[3]){0, TUILE_Q16(1), TUILE_Q16(3)}), TUILE_OK);
    assert_rotation(&camera, (const double[3][3]){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    assert_int_equal(tuile_camera_look_at(&camera, front, front, up), TUILE_ERROR_CAMERA);
    assert_int_equal(tuile_camera_look_at(&camera, above, origin, up), TUILE_ERROR_CAMERA);
    assert_int_equal(tuile_camera_look_at(&camera, front, origin, origin), TUILE_ERROR_CAMERA);
    random_source_t random = random_seed(31);
    for (int round = 0; round < CHECK_ROUNDS(100000); round++) {
        q16_16_t eye[3], at[3], upward[3];
        for (int i = 0; i < 3; i++) {
            eye[i] = (q16_16_t)random_any_size(&random, 31);
            at[i] = (q16_16_t)random_any_size(&random, 31);
            upward[i] = (q16_16_t)random_any_size(&random, 31);
        }
        if (tuile_camera_look_at(&camera, eye, at, upward) != TUILE_OK) { continue; }
        long double view[3], forward = 0;
        for (int i = 0; i < 3; i++) {
            view[i] = 0;
            for (int j = 0; j < 3; j++) {
                view[i] += (long double)camera.rotation[i][j] * ((long double)at[j] - eye[j]) * 0x1p-30L;
            }
            forward = fmaxl(forward, fabsl((long double)at[i] - eye[i]));
        }
        /* the point is in the middle, in front */
        assert_true(view[2] < 0 && fabsl(view[0]) <= forward * 0x1p-16L && fabsl(view[1]) <= forward * 0x1p-16L);
    }
}

/* ---- S1: from the model to the window
 * --------------------------------------------------------------------------------------------- */

typedef struct set_up {
    tuile_model_t model;
    tuile_instance_t instance;
    tuile_scene_t scene;
    uint16_t width, height;
} set_up_t;

static void identity(q2_30_t rotation[3][3]) { tuile_rotation(rotation, 0, 0); }

static void simple_set_up(set_up_t *s) {
    memset(s, 0, sizeof *s);
    s->model.step = (tuile_scale_t){1, -8};
    s->model.radius = 60000;
    s->instance.model = &s->model;
    s->instance.pose.scale = TUILE_SCALE_ONE;
    identity(s->instance.pose.rotation);
    s->scene.instances = &s->instance;
    s->scene.instance_count = 1;
    identity(s->scene.camera.rotation);
    s->scene.camera.focal_x = s->scene.camera.focal_y = TUILE_Q16(100);
    s->scene.camera.centre_x = TUILE_Q16(160);
    s->scene.camera.centre_y = TUILE_Q16(120);
    s->scene.camera.near = TUILE_Q16(1);
    s->scene.camera.far = TUILE_Q16(1000);
    s->width = 320;
    s->height = 240;
}

static int make(const set_up_t *s, transform_t *transform) {
    return transform_make(transform, &s->scene, &s->instance, s->width, s->height);
}

static void random_rotation(random_source_t *random, q2_30_t rotation[3][3]) {
    tuile_camera_t camera;
    q16_16_t at[3], up[3];
    do {
        for (int i = 0; i < 3; i++) {
            at[i] = random_between(random, -1000000, 1000000);
            up[i] = random_between(random, -1000000, 1000000);
        }
    } while (tuile_camera_look_at(&camera, (const q16_16_t[3]){0, 0, 0}, at, up) != TUILE_OK);
    memcpy(rotation, camera.rotation, sizeof camera.rotation);
}

/* The camera's view of a quantised position, in world units, by the definitions in tuile.h. */
static void exact_view(const set_up_t *s, const int16_t q[3], long double view[3]) {
    const tuile_pose_t *pose = &s->instance.pose;
    const tuile_camera_t *camera = &s->scene.camera;
    long double model[3], world[3];
    for (int i = 0; i < 3; i++) {
        model[i] = ldexpl((long double)s->model.step.mantissa * ((long double)s->model.offset[i] + q[i]), s->model.step.exponent);
    }
    for (int i = 0; i < 3; i++) {
        world[i] = 0;
        for (int j = 0; j < 3; j++) {
            world[i] += (long double)pose->rotation[i][j] * 0x1p-30L * model[j];
        }
        world[i] = ldexpl(world[i] * (long double)pose->scale.mantissa, pose->scale.exponent) +
                   (long double)pose->translation[i] / 65536 - (long double)camera->eye[i] / 65536;
    }
    for (int i = 0; i < 3; i++) {
        view[i] = 0;
        for (int j = 0; j < 3; j++) {
            view[i] += (long double)camera->rotation[i][j] * 0x1p-30L * world[j];
        }
    }
}

/* Window in pixels, depth in steps. */
static void exact_window(const set_up_t *s, const long double view[3], long double *x, long double *y, long double *depth) {
    const tuile_camera_t *camera = &s->scene.camera;
    const long double near = camera->near / 65536.0L, far = camera->far / 65536.0L, w = -view[2];
    const long double fx = camera->focal_x / 65536.0L, fy = camera->focal_y / 65536.0L;
    const bool perspective = camera->projection == TUILE_PERSPECTIVE;
    *x = camera->centre_x / 65536.0L + fx * view[0] / (perspective ? w : 1);
    *y = camera->centre_y / 65536.0L - fy * view[1] / (perspective ? w : 1);
    *depth = perspective ? 65528 * near / w : 8 + 65520 * (far - w) / (far - near);
}

/* Moves the instance so that a position of it comes to stand at a point of the view, as far as 16.16 can tell. */
static bool stand(set_up_t *s, const int16_t q[3], const long double wanted[3]) {
    long double view[3];
    exact_view(s, q, view);
    for (int i = 0; i < 3; i++) {
        long double move = s->instance.pose.translation[i] / 65536.0L;
        for (int j = 0; j < 3; j++) {
            move += (long double)s->scene.camera.rotation[j][i] * 0x1p-30L * (wanted[j] - view[j]);
        }
        if (fabsl(move) > 32000) { return false; }
        s->instance.pose.translation[i] = (q16_16_t)(move * 65536);
    }
    return true;
}

/* The position next to a point of the view; left alone where there is none in 16 bits. */
static void aim(const set_up_t *s, const long double view[3], int16_t q[3]) {
    const tuile_pose_t *pose = &s->instance.pose;
    const tuile_camera_t *camera = &s->scene.camera;
    long double world[3];
    for (int i = 0; i < 3; i++) {
        world[i] = camera->eye[i] / 65536.0L - pose->translation[i] / 65536.0L;
        for (int j = 0; j < 3; j++) {
            world[i] += camera->rotation[j][i] * 0x1p-30L * view[j];
        }
    }
    for (int i = 0; i < 3; i++) {
        long double at = 0;
        for (int j = 0; j < 3; j++) {
            at += pose->rotation[j][i] * 0x1p-30L * world[j];
        }
        at = ldexpl(at / pose->scale.mantissa / s->model.step.mantissa, -pose->scale.exponent - s->model.step.exponent) -
             s->model.offset[i];
        if (fabsl(at) < 32767) { q[i] = (int16_t)lroundl(at); }
    }
}

static void one_vertex_by_hand(void **state) {
    set_up_t s;
    transform_t transform;
    vertex_t v[2];
    (void)state;
    simple_set_up(&s);
    s.scene.camera.focal_y = TUILE_Q16(50); /* pixels twice as high as wide */
    assert_int_equal(make(&s, &transform), TUILE_OK);
    /* (4, 2, -8): x = 160 + 100 * 4 / 8 = 210, y = 120 - 50 * 2 / 8 = 107.5, depth = 65528 / 8 = 8191 */
    static const int16_t q[6] = {4 * 256, 2 * 256, -8 * 256, 0, 0, -256};
    vertex_stage(&transform, q, NULL, 2, v);
    assert_int_equal(v[0].x, 210 * 16);
    assert_int_equal(v[0].y, 107 * 16 + 8);
    assert_true(labs((long)(v[0].depth_light >> 8) - 8191 * 256) <= 256);
    assert_int_equal(v[1].x, 160 * 16); /* on the near plane, which is in */
    assert_true(labs((long)(v[1].depth_light >> 8) - 65528 * 256) <= 256);
    s.scene.camera.projection = TUILE_ORTHOGRAPHIC;
    s.scene.camera.focal_x = TUILE_Q16(10);
    s.scene.camera.near = 0;
    s.scene.camera.far = TUILE_Q16(16);
    assert_int_equal(make(&s, &transform), TUILE_OK);
    /* x = 160 + 40, y = 120 - 100, depth = 8 + 65520 * 8 / 16 */
    vertex_stage(&transform, q, NULL, 1, v);
    assert_int_equal(v[0].x, 200 * 16);
    assert_int_equal(v[0].y, 20 * 16);
    assert_true(labs((long)(v[0].depth_light >> 8) - 32768 * 256) <= 256);
}

static void vertices_land_within_their_error(void **state) {
    random_source_t random = random_seed(32);
    long double worst[2] = {0, 0}, worst_depth[2] = {0, 0};
    unsigned made[2] = {0, 0}, inside[2] = {0, 0}, outside[2] = {0, 0}, refused = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(40000); round++) {
        enum { COUNT = 24 };
        set_up_t s;
        transform_t transform;
        simple_set_up(&s);
        const int ortho = round % 2, steps = random_between(&random, -20, 10);
        const long double step = ldexpl(1, steps); /* world units a step, when all is multiplied */
        const long double size = step * 20000;
        s.model.step = (tuile_scale_t){(uint32_t)random_between(&random, 1, 1 << 20), 0};
        s.instance.pose.scale = (tuile_scale_t){(uint32_t)random_between(&random, 1, INT32_MAX), 0};
        s.model.step.exponent = random_between(&random, -60, 60);
        s.instance.pose.scale.exponent =
            steps - s.model.step.exponent - (int32_t)log2((double)s.model.step.mantissa * s.instance.pose.scale.mantissa);
        s.model.radius = 57000;
        for (int i = 0; i < 3; i++) {
            if (random_one_in(&random, 3)) { s.model.offset[i] = (int32_t)random_any_size(&random, 30); }
        }
        random_rotation(&random, s.instance.pose.rotation);
        random_rotation(&random, s.scene.camera.rotation);
        s.width = (uint16_t)random_between(&random, 1, 1024);
        s.height = (uint16_t)random_between(&random, 1, 1024);
        tuile_camera_t *camera = &s.scene.camera;
        const double focal = random_real(&random, 0.3, 4) * s.width;
        camera->focal_x = TUILE_Q16(focal);
        camera->focal_y = TUILE_Q16(focal * random_real(&random, 0.5, 2));
        camera->centre_x = TUILE_Q16(s.width * random_real(&random, -0.5, 1.5));
        camera->centre_y = TUILE_Q16(s.height * random_real(&random, -0.5, 1.5));
        /* The model stands somewhere in front: put its origin there by the translation, as far as 16.16 can tell. */
        const long double far = fminl(30000, fmaxl(0.05L, size * (long double)exp2(random_real(&random, -2, 4))));
        const long double near = fmaxl(far / (long double)exp2(random_real(&random, 0.5, 14)), 0.01L);
        camera->near = (q16_16_t)(near * 65536);
        camera->far = (q16_16_t)(far * 65536) + 2;
        if (ortho) {
            camera->projection = TUILE_ORTHOGRAPHIC;
            const long double px = (long double)(s.width * random_real(&random, 0.2, 3)) / size;
            if (px > 15000 || px < 0.01L) { continue; }
            camera->focal_x = (q16_16_t)(px * 65536);
            camera->focal_y = (q16_16_t)(px * 65536 * (long double)random_real(&random, 0.5, 2));
            if (random_one_in(&random, 2)) { camera->near = -camera->near; }
        }
        const long double distance = fminl(far, near + size * (long double)random_real(&random, 0, 3));
        if (!stand(&s, (const int16_t[3]){0, 0, 0}, (const long double[3]){0, 0, -distance})) { continue; }
        const int error = make(&s, &transform);
        if (error) {
            assert_int_equal(error, TUILE_ERROR_RANGE);
            refused++;
            continue;
        }
        made[ortho]++;
        int16_t q[COUNT][3];
        vertex_t v[COUNT], again[COUNT];
        for (int i = 0; i < COUNT; i++) {
            for (int j = 0; j < 3; j++) {
                q[i][j] = (int16_t)random_between(&random, -32767, 32767);
            }
            if (i % 2 == 0) { /* aimed at the window, as near as any */
                const long double n = camera->near / 65536.0L, f = camera->far / 65536.0L;
                const long double w = ortho ? (long double)random_real(&random, (double)n, (double)f)
                                            : n * exp2l((long double)random_real(&random, 0, 1) * log2l(f / n));
                const long double px = (long double)random_real(&random, 0, s.width),
                                  py = (long double)random_real(&random, 0, s.height);
                const long double scale = ortho ? 1 : w;
                aim(&s,
                    (const long double[3]){(px - camera->centre_x / 65536.0L) * scale * 65536 / camera->focal_x,
                                           (camera->centre_y / 65536.0L - py) * scale * 65536 / camera->focal_y, -w},
                    q[i]);
            }
        }
        const bool any_outside = vertex_stage(&transform, q[0], NULL, COUNT, v);
        bool found_outside = false;
        for (int i = 0; i < COUNT; i++) {
            found_outside |= v[i].x == VERTEX_OUTSIDE;
        }
        assert_int_equal(any_outside, found_outside);
        vertex_stage(&transform, q[COUNT / 2], NULL, COUNT / 2, again); /* the same positions in another cluster */
        assert_memory_equal(again, v + COUNT / 2, COUNT / 2 * sizeof v[0]);
        for (int i = 0; i < COUNT; i++) {
            long double view[3], x, y, depth;
            exact_view(&s, q[i], view);
            exact_window(&s, view, &x, &y, &depth);
            const long double w = -view[2], slack = 0.05L; /* of the snap */
            const long double low_x = transform.guard_x / 16.0L, low_y = transform.guard_y / 16.0L, span = GUARD_SPAN / 16.0L;
            const long double n = camera->near / 65536.0L, f = camera->far / 65536.0L, plane = (f - n) * 0x1p-15L + w * 0x1p-18L;
            const bool surely_in = w > n + plane && w < f - plane && x > low_x + 1 + slack && y > low_y + 1 + slack &&
                                   x < low_x + span - 1 - slack && y < low_y + span - 1 - slack;
            const bool surely_out = w < n - plane || w > f + plane || x < low_x + 1 - slack - 0.07L ||
                                    y < low_y + 1 - slack - 0.07L || x > low_x + span - 1 + slack + 0.07L ||
                                    y > low_y + span - 1 + slack + 0.07L;
            if (v[i].x == VERTEX_OUTSIDE) {
                assert_false(surely_in);
                outside[ortho]++;
                continue;
            }
            assert_false(surely_out);
            inside[ortho]++;
            const long double ex = fabsl(v[i].x / 16.0L - x), ey = fabsl(v[i].y / 16.0L - y);
            worst[ortho] = fmaxl(worst[ortho], fmaxl(ex, ey));
            const long double off = fabsl((long double)(v[i].depth_light >> 8) / 256 - fmaxl(depth, 2));
            worst_depth[ortho] = fmaxl(worst_depth[ortho], off);
            assert_true(ex <= 1 / 32.0L + 1 / 64.0L && ey <= 1 / 32.0L + 1 / 64.0L);
            assert_true(off <= 1);
            assert_true(v[i].depth_light >> 8 >= 512 && v[i].depth_light >> 8 <= 65529 * 256);
        }
    }
    for (int ortho = 0; ortho < 2; ortho++) {
        print_message("%s: %u set-ups, %u vertices in, %u out; window error %.5Lf px (snap 1/32 + %.5Lf), depth %.4Lf step\n",
                      ortho ? "orthographic" : "perspective", made[ortho], inside[ortho], outside[ortho], worst[ortho],
                      worst[ortho] - 1 / 32.0L, worst_depth[ortho]);
        assert_true(inside[ortho] > made[ortho] && outside[ortho] > made[ortho] / 10);
        assert_true(made[ortho] > 50);
    }
    print_message("refused for range: %u\n", refused);
}

static void impossible_set_ups_are_refused(void **state) {
    set_up_t s, ok;
    transform_t transform;
    (void)state;
    simple_set_up(&ok);
    simple_set_up(&s);
#define REFUSED(change, error)                         \
    do {                                               \
        s = ok;                                        \
        s.instance.model = &s.model;                   \
        change;                                        \
        assert_int_equal(make(&s, &transform), error); \
    } while (0)
    REFUSED((void)0, TUILE_OK);
    REFUSED(s.scene.camera.near = 0, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.near = -1, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.far = s.scene.camera.near, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.focal_x = 0, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.focal_y = -5, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.projection = (tuile_projection_t)2, TUILE_ERROR_CAMERA);
    REFUSED(s.instance.model = NULL, TUILE_ERROR_ARGUMENT);
    REFUSED(s.instance.pose.scale.mantissa = 0, TUILE_ERROR_ARGUMENT);
    REFUSED(s.instance.pose.scale.exponent = 1001, TUILE_ERROR_ARGUMENT);
    REFUSED(s.scene.light_count = TRANSFORM_LIGHTS_MAX + 1, TUILE_ERROR_ARGUMENT);
    REFUSED(s.instance.pose.scale.exponent = 60, TUILE_ERROR_RANGE);
#undef REFUSED
}

/* ---- lights -------------------------------------------------------------------------------------------------------------------
 */

static uint8_t light_of(const set_up_t *s, int nx, int ny, int nz) {
    transform_t transform;
    assert_int_equal(make(s, &transform), TUILE_OK);
    return vertex_light(&transform, nx, ny, nz);
}

static void assert_near(int value, int expected) { assert_true(abs(value - expected) <= 1); }

static void lights_by_hand(void **state) {
    static const tuile_light_t along_z = {{0, 0, -TUILE_ONE_Q14}, 255}, half_z = {{0, 0, -TUILE_ONE_Q14}, 100};
    static const tuile_light_t oblique = {{0, -14189, -8192}, 200}; /* 60 degrees from the z axis */
    set_up_t s;
    (void)state;
    simple_set_up(&s);
    assert_int_equal(light_of(&s, 0, 0, 127), LIGHT_MIN); /* darkness is 2 */
    s.scene.ambient = 77;
    assert_int_equal(light_of(&s, 0, 0, 127), 77);
    s.scene.ambient = 255;
    assert_int_equal(light_of(&s, 0, 0, 127), LIGHT_MAX);

    s.scene.ambient = 0;
    s.scene.lights = &half_z;
    s.scene.light_count = 1;
    assert_near(light_of(&s, 0, 0, 127), 2 + 100);         /* facing; ambient is 2 at least */
    assert_int_equal(light_of(&s, 0, 0, -127), LIGHT_MIN); /* away */
    assert_int_equal(light_of(&s, 127, 0, 0), LIGHT_MIN);  /* grazing */
    assert_near(light_of(&s, 0, 110, 64), 2 + 50);         /* 60 degrees: half */
    s.scene.lights = &oblique;
    assert_near(light_of(&s, 0, 0, 127), 2 + 100);
    assert_near(light_of(&s, 0, 127, 0), 2 + 173); /* 200 cos 30 */
    s.scene.lights = &along_z;
    assert_int_equal(light_of(&s, 0, 0, 127), LIGHT_MAX); /* clamped */

    const tuile_light_t both[3] = {half_z, {{-TUILE_ONE_Q14, 0, 0}, 60}, {{TUILE_ONE_Q14, 0, 0}, 90}};
    s.scene.lights = both;
    s.scene.light_count = 3;
    s.scene.ambient = 20;
    assert_near(light_of(&s, 90, 0, 90), 20 + 70 + 42); /* 100 and 60 at 45 degrees, each floored; the third shines from behind */
    s.scene.ambient = 200;
    assert_int_equal(light_of(&s, 90, 0, 90), LIGHT_MAX);

    s.instance.two_sided = true; /* what is turned away is lit as if it were not */
    s.scene.ambient = 0;
    s.scene.lights = &half_z;
    s.scene.light_count = 1;
    assert_near(light_of(&s, 0, 0, -127), 2 + 100);

    s.instance.two_sided = false;
    tuile_rotation(s.instance.pose.rotation, 1, 0x4000); /* leads z to x: the normal along -x faces the light now */
    assert_near(light_of(&s, -127, 0, 0), 2 + 100);
    assert_int_equal(light_of(&s, 127, 0, 0), LIGHT_MIN);
}

static void lights_add_up_in_any_direction(void **state) {
    random_source_t random = random_seed(33);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        set_up_t s;
        tuile_light_t lights[TRANSFORM_LIGHTS_MAX];
        simple_set_up(&s);
        random_rotation(&random, s.instance.pose.rotation);
        s.scene.light_count = (uint8_t)random_between(&random, 0, TRANSFORM_LIGHTS_MAX);
        s.scene.lights = lights;
        s.scene.ambient = (uint8_t)random_between(&random, 0, 255);
        for (int l = 0; l < s.scene.light_count; l++) {
            q2_30_t r[3][3];
            random_rotation(&random, r);
            for (int i = 0; i < 3; i++) {
                lights[l].direction[i] = (q2_14_t)(r[0][i] >> 16);
            }
            lights[l].intensity = (uint8_t)random_between(&random, 0, 255);
        }
        const int n[3] = {random_between(&random, -127, 127), random_between(&random, -127, 127),
                          random_between(&random, -127, 127)};
        if (n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 128 * 128) { continue; }
        double sum = s.scene.ambient < LIGHT_MIN ? LIGHT_MIN : s.scene.ambient;
        for (int l = 0; l < s.scene.light_count; l++) {
            double dot = 0;
            for (int i = 0; i < 3; i++) {
                for (int j = 0; j < 3; j++) {
                    dot -= s.instance.pose.rotation[i][j] * 0x1p-30 * n[j] / 127.0 * lights[l].direction[i] / 16384.0;
                }
            }
            sum += dot > 0 ? dot * lights[l].intensity : 0;
        }
        const double expected = sum > LIGHT_MAX ? LIGHT_MAX : sum;
        /* floored for each light */
        assert_true(fabs(light_of(&s, n[0], n[1], n[2]) - expected) <= 1 + 1.05 * s.scene.light_count);
    }
}

/* ---- culling ------------------------------------------------------------------------------------------------------------------
 */

#define CLUSTER_VERTICES 12
#define CLUSTER_FACES 8

typedef struct test_cluster {
    uint8_t bytes[MODEL_CLUSTER_BYTES];
    int16_t q[CLUSTER_VERTICES][3];
    uint8_t faces[CLUSTER_FACES][3];
    long double normals[CLUSTER_FACES][3];
} test_cluster_t;

static void put16(uint8_t *p, int32_t value) {
    p[0] = (uint8_t)(value & 0xff);
    p[1] = (uint8_t)((value >> 8) & 0xff);
}

static long double dot3(const long double a[3], const long double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Vertices near one plane through a random centre; sphere, axis and cutoff by definition. */
static void random_cluster(random_source_t *random, test_cluster_t *c) {
    const int size = random_between(random, 3, random_one_in(random, 2) ? 300 : 8000), bump = random_between(random, 0, size / 2);
    const int axis_aligned = random_one_in(random, 3) ? random_between(random, 0, 2) : -1;
    q2_30_t r[3][3];
    int32_t centre[3], radius = 0;
    random_rotation(random, r);
    for (int i = 0; i < 3; i++) {
        centre[i] = random_between(random, -32767 + 2 * size, 32767 - 2 * size);
    }
    for (int v = 0; v < CLUSTER_VERTICES; v++) {
        const double local[3] = {random_real(random, -size, size), random_real(random, -size, size),
                                 random_real(random, -bump, bump)};
        for (int i = 0; i < 3; i++) {
            double at = 0;
            for (int j = 0; j < 3; j++) {
                at += r[j][i] * 0x1p-30 * local[j];
            }
            if (axis_aligned >= 0) { at = i == axis_aligned ? 0 : local[i == (axis_aligned + 1) % 3]; }
            c->q[v][i] = (int16_t)(centre[i] + (int)at);
        }
        const double dx = c->q[v][0] - centre[0], dy = c->q[v][1] - centre[1], dz = c->q[v][2] - centre[2];
        const int32_t away = (int32_t)ceil(sqrt(dx * dx + dy * dy + dz * dz));
        radius = away > radius ? away : radius;
    }
    long double mean[3] = {0, 0, 0};
    const long double up[3] = {r[2][0], r[2][1], r[2][2]};
    for (int f = 0; f < CLUSTER_FACES; f++) {
        long double length = 0;
        for (int tries = 0; length == 0 && tries < 100; tries++) {
            for (int i = 0; i < 3; i++) {
                c->faces[f][i] = (uint8_t)random_between(random, 0, CLUSTER_VERTICES - 1);
            }
            const int16_t *p0 = c->q[c->faces[f][0]], *p1 = c->q[c->faces[f][1]], *p2 = c->q[c->faces[f][2]];
            for (int i = 0; i < 3; i++) {
                const int j = (i + 1) % 3, k = (i + 2) % 3;
                c->normals[f][i] = (long double)(p1[j] - p0[j]) * (p2[k] - p0[k]) - (long double)(p1[k] - p0[k]) * (p2[j] - p0[j]);
            }
            length = sqrtl(dot3(c->normals[f], c->normals[f]));
        }
        if (length == 0) { length = 1; }
        if (axis_aligned >= 0 ? c->normals[f][axis_aligned] < 0 : dot3(c->normals[f], up) < 0) { length = -length; }
        for (int i = 0; i < 3; i++) {
            c->normals[f][i] /= length;
            mean[i] += c->normals[f][i];
        }
    }
    memset(c->bytes, 0, sizeof c->bytes);
    for (int i = 0; i < 3; i++) {
        put16(c->bytes + CLUSTER_AT_CENTRE + 2 * i, centre[i]);
    }
    put16(c->bytes + CLUSTER_AT_RADIUS, radius);
    const long double length = sqrtl(dot3(mean, mean));
    long double axis[3], least = 1;
    for (int i = 0; i < 3; i++) {
        const int a = length > 0 ? (int)lroundl(mean[i] / length * 127) : 0;
        c->bytes[CLUSTER_AT_AXIS + i] = (uint8_t)(a & 0xff);
        axis[i] = a;
    }
    const long double axis_length = sqrtl(dot3(axis, axis));
    for (int f = 0; f < CLUSTER_FACES; f++) {
        least = fminl(least, axis_length > 0 ? dot3(axis, c->normals[f]) / axis_length : -1);
    }
    if (least <= 0) {
        c->bytes[CLUSTER_AT_CUTOFF] = 255;
    } else {
        const long double cutoff = ceill(254 * sqrtl(fmaxl(0, 1 - least * least)) - 1e-12L);
        c->bytes[CLUSTER_AT_CUTOFF] = (uint8_t)(cutoff > 254 ? 255 : cutoff);
    }
}

static bool random_view(random_source_t *random, set_up_t *s) {
    simple_set_up(s);
    const bool ortho = random_one_in(random, 2);
    s->model.step = (tuile_scale_t){1, -8};
    if (random_one_in(random, 2)) {
        random_rotation(random, s->instance.pose.rotation);
        random_rotation(random, s->scene.camera.rotation);
    } else if (random_one_in(random, 2)) {
        tuile_rotation(s->instance.pose.rotation, random_between(random, 0, 2), (bam16_t)(random_between(random, 0, 3) * 0x4000));
    }
    for (int i = 0; i < 3; i++) {
        s->scene.camera.eye[i] =
            random_between(random, -200, 200) * (random_one_in(random, 2) ? 65536 : 1 << random_between(random, 8, 20));
        s->instance.pose.translation[i] = random_between(random, -65536, 65536);
        s->model.offset[i] = random_between(random, -1000, 1000);
    }
    s->scene.camera.near = TUILE_Q16(0.5);
    s->scene.camera.far = TUILE_Q16(20) + random_between(random, 0, 400) * 65536;
    if (ortho) {
        s->scene.camera.projection = TUILE_ORTHOGRAPHIC;
        s->scene.camera.focal_x = s->scene.camera.focal_y = random_between(random, 6553, 655360);
    }
    return ortho;
}

static void clusters_with_a_vertex_in_the_region_are_never_dropped(void **state) {
    random_source_t random = random_seed(34);
    unsigned culled = 0, seen = 0, missed = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(200000); round++) {
        set_up_t s;
        test_cluster_t c;
        transform_t transform;
        (void)random_view(&random, &s);
        random_cluster(&random, &c);
        if (!random_one_in(&random, 4)) {
            const int16_t centre[3] = {model_i16(c.bytes + CLUSTER_AT_CENTRE), model_i16(c.bytes + CLUSTER_AT_CENTRE + 2),
                                       model_i16(c.bytes + CLUSTER_AT_CENTRE + 4)};
            const double z = random_real(&random, 0, 40);
            const long double wanted[3] = {(long double)random_real(&random, -2 * z, 2 * z),
                                           (long double)random_real(&random, -2 * z, 2 * z), -(long double)z};
            if (!stand(&s, centre, wanted)) { continue; }
        }
        assert_int_equal(make(&s, &transform), TUILE_OK);
        const int32_t left = random_between(&random, 0, 319), top = random_between(&random, 0, 239);
        const transform_region_t region = {(uint16_t)left, (uint16_t)top, (uint16_t)random_between(&random, left + 1, 320),
                                           (uint16_t)random_between(&random, top + 1, 240)};
        transform_region(&transform, &region);
        bool inside = false;
        long double near_by[6] = {-1, -1, -1, -1, -1, -1}; /* greatest distance inside each plane, by any vertex */
        for (int v = 0; v < CLUSTER_VERTICES; v++) {
            long double view[3], x, y, depth;
            exact_view(&s, c.q[v], view);
            exact_window(&s, view, &x, &y, &depth);
            const long double w = -view[2], n = s.scene.camera.near / 65536.0L, f = s.scene.camera.far / 65536.0L;
            inside |= w > n && w < f && x > region.left && x < region.right && y > region.top && y < region.bottom;
            near_by[0] = fmaxl(near_by[0], w - n);
            near_by[1] = fmaxl(near_by[1], f - w);
        }
        const bool dropped = cull_outside(&transform, c.bytes);
        assert_false(dropped && inside);
        /* Far behind the eye or beyond the far plane, by more than the sphere can reach: dropped for certain. */
        const long double diameter = 2 * (long double)model_u16(c.bytes + CLUSTER_AT_RADIUS) / 256 + 0.5L;
        if (near_by[0] < -diameter || near_by[1] < -diameter) { missed += !dropped; }
        culled += dropped;
        seen += inside;
    }
    print_message("clusters: %u dropped, %u with a vertex in the region\n", culled, seen);
    assert_int_equal(missed, 0);
    assert_true(culled > 1000 / (CHECK_SANITIZED ? 16 : 1) && seen > 1000 / (CHECK_SANITIZED ? 16 : 1));
}

static void clusters_with_a_front_face_are_never_dropped(void **state) {
    random_source_t random = random_seed(35);
    unsigned dropped = 0, could = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(300000); round++) {
        set_up_t s;
        test_cluster_t c;
        transform_t transform;
        const bool ortho = random_view(&random, &s);
        random_cluster(&random, &c);
        if (random_one_in(&random, 2)) { /* the eye beside the cluster, or in it */
            const int16_t centre[3] = {model_i16(c.bytes + CLUSTER_AT_CENTRE), model_i16(c.bytes + CLUSTER_AT_CENTRE + 2),
                                       model_i16(c.bytes + CLUSTER_AT_CENTRE + 4)};
            const double radius = model_u16(c.bytes + CLUSTER_AT_RADIUS) / 256.0;
            long double wanted[3];
            for (int i = 0; i < 3; i++) {
                wanted[i] = (long double)random_real(&random, -1.5 * radius, 1.5 * radius);
            }
            if (!stand(&s, centre, wanted)) { continue; }
        }
        assert_int_equal(make(&s, &transform), TUILE_OK);
        bool front = false;
        for (int f = 0; f < CLUSTER_FACES; f++) {
            /* In view space: the way the eye looks at a corner, against the face's normal turned there. */
            long double p[3], normal[3], model_normal[3];
            exact_view(&s, c.q[c.faces[f][0]], p);
            for (int i = 0; i < 3; i++) {
                model_normal[i] = 0;
                for (int j = 0; j < 3; j++) {
                    model_normal[i] += s.instance.pose.rotation[i][j] * 0x1p-30L * c.normals[f][j];
                }
            }
            for (int i = 0; i < 3; i++) {
                normal[i] = 0;
                for (int j = 0; j < 3; j++) {
                    normal[i] += s.scene.camera.rotation[i][j] * 0x1p-30L * model_normal[j];
                }
            }
            const long double facing = ortho ? -normal[2] : dot3(p, normal);
            const long double rounding =
                ortho ? 1e-9L : 1e-9L * sqrtl(dot3(p, p)); /* of normal and matrices, not of the cone test */
            front |= facing < -rounding;
        }
        const bool away = cull_faces_away(&transform, c.bytes);
        assert_false(away && front);
        dropped += away;
        could += !front;
        c.bytes[CLUSTER_AT_CUTOFF] = 255;
        assert_false(cull_faces_away(&transform, c.bytes));
    }
    print_message("cones: %u dropped of %u that face away\n", dropped, could);
    assert_true(dropped > could / 4);
}

/* A flat cluster seen from behind, from before, and by a two-sided instance. */
static void a_wall_is_dropped_from_behind_only(void **state) {
    set_up_t s;
    transform_t transform;
    uint8_t cluster[MODEL_CLUSTER_BYTES] = {0};
    (void)state;
    for (int ortho = 0; ortho < 2; ortho++) {
        simple_set_up(&s);
        s.scene.camera.projection = ortho ? TUILE_ORTHOGRAPHIC : TUILE_PERSPECTIVE;
        put16(cluster + CLUSTER_AT_CENTRE + 4, -10 * 256);
        put16(cluster + CLUSTER_AT_RADIUS, 256);
        cluster[CLUSTER_AT_AXIS + 2] = (uint8_t)-127;
        cluster[CLUSTER_AT_CUTOFF] = 0;
        assert_int_equal(make(&s, &transform), TUILE_OK);
        assert_true(cull_faces_away(&transform, cluster));
        cluster[CLUSTER_AT_AXIS + 2] = 127;
        assert_false(cull_faces_away(&transform, cluster));
        cluster[CLUSTER_AT_AXIS + 2] = (uint8_t)-127;
        s.instance.two_sided = true;
        assert_int_equal(make(&s, &transform), TUILE_OK);
        assert_false(cull_faces_away(&transform, cluster));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floor_divisions_round_down),
        cmocka_unit_test(leading_zeros_and_shifts),
        cmocka_unit_test(products_are_floored),
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
        cmocka_unit_test(unit_vectors_are_within_a_few_units),
        cmocka_unit_test(cross_products_are_exact_to_the_ends),
        cmocka_unit_test(sines_of_all_angles),
        cmocka_unit_test(focal_lengths),
        cmocka_unit_test(the_narrowest_field_of_view_does_not_divide_by_zero),
        cmocka_unit_test(rotations_turn_counter_clockwise),
        cmocka_unit_test(looking_at_a_point),
        cmocka_unit_test(one_vertex_by_hand),
        cmocka_unit_test(vertices_land_within_their_error),
        cmocka_unit_test(impossible_set_ups_are_refused),
        cmocka_unit_test(lights_by_hand),
        cmocka_unit_test(lights_add_up_in_any_direction),
        cmocka_unit_test(clusters_with_a_vertex_in_the_region_are_never_dropped),
        cmocka_unit_test(clusters_with_a_front_face_are_never_dropped),
        cmocka_unit_test(a_wall_is_dropped_from_behind_only),
    };
    return cmocka_run_group_tests_name("geometry", tests, NULL, NULL);
}
