/* Vectors, angles and cameras, against long double and exact integers. */
#include "support/check.h"

#include <math.h>

#include "../raster/geometry/vector.h"
#include "../raster/tuile.h"
#include "support/random.h"

#define TURN 6.283185307179586476925286766559L

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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unit_vectors_are_within_a_few_units),
        cmocka_unit_test(cross_products_are_exact_to_the_ends),
        cmocka_unit_test(sines_of_all_angles),
        cmocka_unit_test(focal_lengths),
        cmocka_unit_test(the_narrowest_field_of_view_does_not_divide_by_zero),
        cmocka_unit_test(rotations_turn_counter_clockwise),
        cmocka_unit_test(looking_at_a_point),
    };
    return cmocka_run_group_tests_name("camera", tests, NULL, NULL);
}
