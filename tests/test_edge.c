/* The edge stepper: the sources' worked example 1, and all kinds of sides against exact integers. */
#include "support/check.h"

#include "../raster/fill/edge.h"
#include "support/canvas.h"
#include "support/random.h"

static void worked_example_1_row_by_row(void **state) {
    static const int32_t q[10] = {0, 1, 0, 1, 0, 0, 1, 0, 1, 0}, n_before[10] = {9, 3, 7, 1, 5, 9, 3, 7, 1, 5};
    static const int32_t shown[10] = {3, 4, 4, 5, 5, 5, 6, 6, 7, 7}, n_after[10] = {13, 7, 11, 5, 9, 13, 7, 11, 5, 9};
    edge_t edge;
    int32_t before = 3;
    (void)state;
    edge_start(&edge, CENTRE(3), CENTRE(0), CENTRE(7), CENTRE(10), 0);
    for (int y = 0; y < 10; y++) {
        edge_t direct, wide;
        assert_int_equal(edge.x, shown[y]);
        assert_int_equal(edge.x - before, q[y]);
        /* The remainder is scaled by 16 * 16 here (sixteenths of a pixel, sixteenths of dy), and between the sources' multiples
         * what rounds up is the greatest number below the next one: 256 N + 255. */
        assert_int_equal(edge.n, 256 * n_before[y] + 255);
        assert_int_equal(edge.n + 256 * 4, 256 * n_after[y] + 255);
        assert_int_equal(edge.d, 256 * 10);
        edge_start(&direct, CENTRE(3), CENTRE(0), CENTRE(7), CENTRE(10), y);
        edge_start_wide(&wide, CENTRE(3), CENTRE(0), CENTRE(7), CENTRE(10), y);
        assert_memory_equal(&direct, &edge, sizeof edge);
        assert_memory_equal(&wide, &edge, sizeof edge);
        before = edge.x;
        edge_step(&edge);
    }
    assert_int_equal(edge_row(CENTRE(0)), 0);
    assert_int_equal(edge_row(CENTRE(10)), 10);
}

/* x is the ceiling of numerator / d iff (x - 1) d < numerator <= x d. */
static bool is_ceiling(int64_t x, int64_t numerator, int64_t d) { return numerator <= x * d && (x - 1) * d < numerator; }

static int64_t edge_numerator(int32_t x0, int32_t y0, int32_t dx, int32_t dy, int32_t row) {
    return (int64_t)(x0 - 8) * dy + ((int64_t)16 * row + 8 - y0) * dx;
}

/* All sides of at most 16 pixels (3 under sanitizers) at every phase. */
static void stepper_is_exact_on_all_short_sides(void **state) {
    const int32_t reach = CHECK_SANITIZED ? 40 : 256;
    uint64_t wrong = 0;
    (void)state;
    for (int32_t dy = 1; dy <= reach; dy++) {
        for (int32_t dx = -reach; dx <= reach; dx++) {
            for (int32_t phase = 0; phase < 256; phase++) {
                const int32_t x0 = (phase & 15) - 8, y0 = (phase >> 4) - 8;
                const int32_t first = edge_row(y0), end = edge_row(y0 + dy);
                edge_t edge, wide;
                if (first >= end) { continue; }
                short_edge_t brief = short_edge_start(x0, y0, x0 + dx, y0 + dy, first);
                edge_start(&edge, x0, y0, x0 + dx, y0 + dy, first);
                edge_start_wide(&wide, x0, y0, x0 + dx, y0 + dy, first);
                wrong += edge.x != wide.x || edge.n != wide.n || edge.r != wide.r || edge.d != wide.d || edge.q != wide.q;
                wrong += 16 * first + 8 < y0 || 16 * (first - 1) + 8 >= y0;
                for (int32_t row = first; row < end; row++) {
                    wrong += !is_ceiling(edge.x, edge_numerator(x0, y0, dx, dy, row), 16 * dy) || edge.n < 0 || edge.n >= edge.d;
                    wrong += short_edge_pixel(brief.x) != edge.x;
                    brief.x = (int32_t)((uint32_t)brief.x + (uint32_t)brief.slope);
                    edge_step(&edge);
                }
            }
        }
    }
    assert_int_equal(wrong, 0);
}

/* Sides of less than SHORT_SIDE, wherever they lie in the guard span and whatever row they are begun on. */
static void short_stepper_is_exact_to_its_bounds(void **state) {
    random_source_t random = random_seed(14);
    uint64_t rows = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(3000000); round++) {
        const bool longest = random_one_in(&random, 2);
        const int32_t dy = longest ? SHORT_SIDE - random_between(&random, 1, 4) : random_between(&random, 1, SHORT_SIDE - 1);
        const int32_t dx = random_between(&random, 1 - SHORT_SIDE, SHORT_SIDE - 1);
        const int32_t x0 = random_between(&random, INT16_MIN + 1 + SHORT_SIDE, INT16_MAX - 16 - SHORT_SIDE),
                      y0 = random_between(&random, -16000, 16000);
        const int32_t first = edge_row(y0), end = edge_row(y0 + dy);
        if (first >= end) { continue; }
        const int32_t begin = random_between(&random, first, end - 1);
        short_edge_t edge = short_edge_start(x0, y0, x0 + dx, y0 + dy, begin);
        for (int32_t row = begin; row < end; row++, rows++) {
            assert_true(is_ceiling(short_edge_pixel(edge.x), edge_numerator(x0, y0, dx, dy, row), (int64_t)16 * dy));
            edge.x = (int32_t)((uint32_t)edge.x + (uint32_t)edge.slope);
        }
    }
    assert_true(rows > 1000);
}

static void stepper_is_exact_on_long_sides(void **state) {
    random_source_t random = random_seed(11);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(40000); round++) {
        const bool far = round % 2;
        const int32_t low = far ? -32767 * 16 : -16000, high = far ? 32767 * 16 : 16767;
        const int32_t x0 = random_between(&random, low, high),
                      x1 = random_one_in(&random, 8) ? x0 : random_between(&random, low, high);
        int32_t y0 = random_between(&random, low, high),
                y1 = random_one_in(&random, 3) ? y0 + random_between(&random, 1, 300) : random_between(&random, low, high);
        if (y0 > y1) {
            const int32_t swap = y0;
            y0 = y1;
            y1 = swap;
        }
        const int32_t first = edge_row(y0), end = edge_row(y1);
        if (first >= end) { continue; }
        const int32_t start = random_between(&random, first, end - 1), stop = start + 400 < end ? start + 400 : end;
        edge_t edge, narrow;
        edge_start_wide(&edge, x0, y0, x1, y1, start);
        if (!far) {
            edge_start(&narrow, x0, y0, x1, y1, start);
            assert_memory_equal(&narrow, &edge, sizeof edge);
        }
        for (int32_t row = start; row < stop; row++) {
            const int64_t numerator = edge_numerator(x0, y0, x1 - x0, y1 - y0, row), d = (int64_t)16 * (y1 - y0);
            assert_true(is_ceiling(edge.x, numerator, d));
            assert_true(edge.n >= 0 && edge.n < edge.d && edge.d == d);
            assert_true((int64_t)edge.x * edge.d + edge.n == numerator + edge.d - 1);
            edge_step(&edge);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(worked_example_1_row_by_row),
        cmocka_unit_test(stepper_is_exact_on_all_short_sides),
        cmocka_unit_test(short_stepper_is_exact_to_its_bounds),
        cmocka_unit_test(stepper_is_exact_on_long_sides),
    };
    return cmocka_run_group_tests_name("edge", tests, NULL, NULL);
}
