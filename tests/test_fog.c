/* Fog against its definition in long double, over the whole range of depths. */
#include "support/check.h"

#include "../raster/surface/fog.h"

#include <math.h>

typedef struct fog_case {
    tuile_fog_t fog;
    tuile_camera_t camera;
    const char *name;
} fog_case_t;

static const fog_case_t cases[] = {
    {{TUILE_FOG_LINEAR, {200, 210, 220}, TUILE_Q16(1), TUILE_Q16(20)},
     {.projection = TUILE_PERSPECTIVE, .near = TUILE_Q16(0.5), .far = TUILE_Q16(40)},
     "linear"},
    {{TUILE_FOG_LINEAR, {255, 0, 128}, 0, TUILE_Q16(30000)},
     {.projection = TUILE_PERSPECTIVE, .near = TUILE_Q16(1), .far = TUILE_Q16(32000)},
     "linear, far"},
    {{TUILE_FOG_LINEAR, {0, 255, 0}, TUILE_Q16(2000), TUILE_Q16(2010)},
     {.projection = TUILE_PERSPECTIVE, .near = TUILE_Q16(100), .far = TUILE_Q16(4000)},
     "a thin wall"},
    {{TUILE_FOG_EXPONENTIAL, {90, 100, 110}, TUILE_Q16(2), TUILE_Q16(3)},
     {.projection = TUILE_PERSPECTIVE, .near = TUILE_Q16(0.1), .far = TUILE_Q16(100)},
     "exponential"},
    {{TUILE_FOG_EXPONENTIAL, {90, 100, 110}, 0, 1},
     {.projection = TUILE_PERSPECTIVE, .near = 1, .far = TUILE_Q16(32000)},
     "exponential, the least numbers"},
    {{TUILE_FOG_LINEAR, {1, 2, 3}, TUILE_Q16(1), TUILE_Q16(20)},
     {.projection = TUILE_ORTHOGRAPHIC, .near = TUILE_Q16(-5), .far = TUILE_Q16(40)},
     "orthographic, linear"},
    {{TUILE_FOG_EXPONENTIAL, {255, 255, 255}, TUILE_Q16(-3), TUILE_Q16(7)},
     {.projection = TUILE_ORTHOGRAPHIC, .near = TUILE_Q16(-30000), .far = TUILE_Q16(30000)},
     "orthographic, exponential"},
};

static long double exact_share(const fog_case_t *c, uint32_t depth) {
    const long double near = c->camera.near / 65536.0L, far = c->camera.far / 65536.0L, z = depth / 65536.0L;
    const long double w =
        c->camera.projection == TUILE_PERSPECTIVE ? 65528.0L * near / z : far - (z - 8.0L) * (far - near) / 65520.0L;
    const long double begin = c->fog.near / 65536.0L, end = c->fog.far / 65536.0L;
    long double share = c->fog.kind == TUILE_FOG_LINEAR ? (w - begin) / (end - begin)
                        : w < begin                     ? 0
                                                        : 1.0L - exp2l(-(w - begin) / end);
    return share < 0 ? 0 : share > 1 ? 1 : share;
}

static void fog_is_within_its_bound_of_the_definition(void **state) {
    (void)state;
    for (unsigned k = 0; k < CHECK_COUNT(cases); k++) {
        fog_t fog;
        assert_int_equal(fog_make(&fog, &cases[k].fog, &cases[k].camera), TUILE_OK);
        for (uint64_t depth = 65536; depth <= UINT32_MAX; depth += depth / 4099 + 1) {
            const long double off = fog_share(&fog, (uint32_t)depth) / 65536.0L - exact_share(&cases[k], (uint32_t)depth);
            if (fabsl(off) > 1.0L / 8192) { fail_msg("%s: depth %llx: off by %Lg", cases[k].name, (unsigned long long)depth, off); }
        }
    }
}

static void nearer_is_never_foggier(void **state) {
    (void)state;
    for (unsigned k = 0; k < CHECK_COUNT(cases); k++) {
        fog_t fog;
        uint32_t last = FOG_ONE;
        assert_int_equal(fog_make(&fog, &cases[k].fog, &cases[k].camera), TUILE_OK);
        for (uint64_t depth = 65536; depth <= UINT32_MAX; depth += depth / 8209 + 1) {
            const uint32_t share = fog_share(&fog, (uint32_t)depth);
            assert_in_range(share, 0, last + 2 < FOG_ONE ? last + 2 : FOG_ONE);
            last = share;
        }
    }
}

/* Where the exact fog of black and white changes by less than a level between neighbours, so does this. */
static void fog_has_no_bands(void **state) {
    (void)state;
    for (unsigned k = 0; k < CHECK_COUNT(cases); k++) {
        fog_t fog;
        tuile_fog_t white = cases[k].fog;
        memset(white.colour, 255, 3);
        assert_int_equal(fog_make(&fog, &white, &cases[k].camera), TUILE_OK);
        for (uint64_t depth = 65536; depth <= UINT32_MAX; depth += depth / 2053 + 1) {
            const uint64_t next = depth + depth / 2053 + 1;
            if (next > UINT32_MAX) { break; }
            const long double change = exact_share(&cases[k], (uint32_t)depth) - exact_share(&cases[k], (uint32_t)next);
            if (change > 0.9L / 255) { continue; }
            const int a = (int)(fog_apply(&fog, (uint32_t)depth, 0) & 255), b = (int)(fog_apply(&fog, (uint32_t)next, 0) & 255);
            assert_in_range(a - b + 1, 0, 2);
        }
    }
}

static void the_ends_of_fog_are_exact(void **state) {
    fog_t fog;
    const tuile_camera_t camera = {.projection = TUILE_PERSPECTIVE, .near = TUILE_Q16(1), .far = TUILE_Q16(100)};
    const tuile_fog_t linear = {TUILE_FOG_LINEAR, {16, 32, 64}, TUILE_Q16(2), TUILE_Q16(4)};
    (void)state;
    assert_int_equal(fog_make(&fog, &linear, &camera), TUILE_OK);
    /* 65528 / w steps: before 2 units nothing, from 4 units on all, half of it at 3. */
    assert_int_equal(fog_apply(&fog, 65528u * 65536u / 100u * 51u, 0x80ff8001u), 0x80ff8001u);
    assert_int_equal(fog_apply(&fog, 65528u / 4u * 65536u - 65536u, 0x40ff8001u), 0x40102040u);
    assert_int_equal(fog_apply(&fog, (uint32_t)(65528.0 * 65536.0 / 3.0), 0x00000000u), 0x00081020u);
    const tuile_fog_t half = {TUILE_FOG_EXPONENTIAL, {200, 100, 50}, TUILE_Q16(2), TUILE_Q16(1)};
    assert_int_equal(fog_make(&fog, &half, &camera), TUILE_OK);
    assert_int_equal(fog_apply(&fog, (uint32_t)(65528.0 * 65536.0 / 3.0), 0), 0x00643219u); /* one half-life */
    assert_int_equal(fog_apply(&fog, 65528u / 4u * 65536u, 0), 0x00964b26u);                /* two: three quarters */
}

static void distances_out_of_order_are_refused(void **state) {
    static const tuile_fog_t wrong[] = {{3, {0}, 0, 1},
                                        {TUILE_FOG_LINEAR, {0}, 5, 5},
                                        {TUILE_FOG_LINEAR, {0}, -1, 5},
                                        {TUILE_FOG_LINEAR, {0}, 6, 5},
                                        {TUILE_FOG_EXPONENTIAL, {0}, 0, 0},
                                        {TUILE_FOG_EXPONENTIAL, {0}, 0, -4}};
    fog_t fog;
    (void)state;
    for (unsigned k = 0; k < CHECK_COUNT(wrong); k++) {
        assert_int_equal(fog_make(&fog, &wrong[k], &cases[0].camera), TUILE_ERROR_ARGUMENT);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fog_is_within_its_bound_of_the_definition),
        cmocka_unit_test(nearer_is_never_foggier),
        cmocka_unit_test(fog_has_no_bands),
        cmocka_unit_test(the_ends_of_fog_are_exact),
        cmocka_unit_test(distances_out_of_order_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
