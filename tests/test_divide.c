/* Quotients by table (raster/divide.h): all arguments there are, against the machine's division. */
#include "support/check.h"
#include "support/random.h"

#include "../raster/divide.h"

static void the_table_is_that_of_its_comment(void **state) {
    (void)state;
    assert_int_equal(divide_table[0], 0);
    for (uint32_t i = 1; i < DIVIDE_TABLE; i++) {
        assert_int_equal(divide_table[i], (1u << 31) / i);
    }
}

static void the_table_of_sides_is_that_of_its_comment(void **state) {
    (void)state;
    for (uint32_t i = 1; i < DIVIDE_TABLE; i++) {
        const uint32_t shift = divide_sides[i].shift;
        assert_true(i >> (shift - 2) == 1);
        assert_int_equal(divide_sides[i].inverse, ((UINT64_C(1) << (21 + shift)) / i + 1) / 2);
    }
}

/* Either way of dividing: less than 1 + |dx| / (4 dy) too small or too large; in quarters. */
static void slopes_of_short_sides_are_as_near_as_sides_need(void **state) {
    (void)state;
    for (int32_t dy = 1; dy < 512; dy += CHECK_SANITIZED ? 7 : 1) {
        for (int32_t dx = -511; dx < 512; dx++) {
            const int64_t exact = (int64_t)dx * (1 << 20), size = dx < 0 ? -dx : dx; /* times dy */
            const int64_t table = 4 * (divide_side_by_table(dx, dy) * (int64_t)dy - exact),
                          here = 4 * (divide_side(dx, dy) * (int64_t)dy - exact);
            assert_true(-4 * dy - size < table && table <= size);
            assert_true(-4 * dy - size < here && here < 4 * dy + size);
        }
    }
}

static void reciprocals_of_areas_are_floored(void **state) {
    (void)state;
    for (int32_t area = 1; area < 1 << 18; area++) {
        assert_int_equal(divide_area_by_table(area), INT32_MAX / area);
    }
}

static void ones_are_divided_by_16_bits(void **state) {
    (void)state;
    for (uint32_t d = 1u << 15; d < 1u << 16; d++) {
        assert_int_equal(divide_ones_by_table(d), UINT32_MAX / d);
    }
}

/* By what a floor is. */
static void scaled_numbers_are_divided_by_areas_and_floored(void **state) {
    random_source_t random = random_seed(0x5ca1ed);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(2000000); round++) {
        const unsigned bits = random_one_in(&random, 2) ? 12 : 28, size = bits == 12 ? 31 : 18;
        const int32_t end = (int32_t)((1u << size) - 1);
        const int32_t n = random_one_in(&random, 8)   ? end - (int32_t)(random_bits(&random) & 3)
                          : random_one_in(&random, 8) ? (int32_t)(random_bits(&random) & 3) - end
                                                      : (int32_t)random_any_size(&random, size);
        const int32_t area = random_one_in(&random, 8)
                                 ? (1 << 18) - 1 - (int32_t)(random_bits(&random) & 3)
                                 : (int32_t)(random_bits(&random) % ((1u << random_between(&random, 1, 18)) - 1)) + 1;
        const int64_t quotient = divide_scaled(n, bits, divide_area_of(area, INT32_MAX / area)),
                      scaled = (int64_t)n * (INT64_C(1) << bits);
        assert_true(quotient * area <= scaled && scaled < (quotient + 1) * area);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_is_that_of_its_comment),
        cmocka_unit_test(the_table_of_sides_is_that_of_its_comment),
        cmocka_unit_test(slopes_of_short_sides_are_as_near_as_sides_need),
        cmocka_unit_test(reciprocals_of_areas_are_floored),
        cmocka_unit_test(ones_are_divided_by_16_bits),
        cmocka_unit_test(scaled_numbers_are_divided_by_areas_and_floored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
