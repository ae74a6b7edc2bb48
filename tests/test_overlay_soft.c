/* Soft edges against distances in floating point with room to spare, and shapes that make up others without gap or overlap. */
#include "support/check.h"
#include "support/overlay.h"
#include "support/random.h"

#include <math.h>

#define WHITE TUILE_COLOUR(255, 255, 255)
#define SIDE 40

static window_t window;

/* Sixteenths that a white shape over black has left: alpha is (255 k + 8) / 16, and 255 alpha / 255 is what is seen. */
static unsigned coverage_at(int32_t x, int32_t y) {
    const unsigned value = window_at(&window, x, y) & 255u;
    for (unsigned k = 0; k <= 16; k++) {
        if ((255 * k + 8) / 16 == value) { return k; }
    }
    fail_msg("%u is no coverage", value);
    return 0;
}

/* The definition: #{k = 1 ... 16: inside >= (2 k - 17) / 32 samples}. */
static unsigned coverage_of(long double inside) {
    unsigned count = 0;
    for (int k = 1; k <= 16; k++) {
        count += inside >= (2 * k - 17) / 32.0L;
    }
    return count;
}

/* Where a threshold is as near as that, either side of it is right. */
#define NEARLY 1e-9L

static void check_sample(int32_t x, int32_t y, long double inside, long double slack) {
    const unsigned drawn = coverage_at(x, y), least = coverage_of(inside - slack), most = coverage_of(inside + slack);
    if (drawn < least || drawn > most) { fail_msg("(%d, %d): %u sixteenths instead of %u ... %u", x, y, drawn, least, most); }
}

typedef struct numbers {
    int32_t n[6];
} numbers_t;

static void draw_disc(const void *context, tuile_canvas_t *canvas) {
    const numbers_t *v = context;
    tuile_draw_disc(canvas, v->n[0], v->n[1], v->n[2], WHITE);
}

static void discs_are_as_soft_as_distances_say(void **state) {
    random_source_t random = random_seed(5);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(400); round++) {
        const numbers_t v = {
            {random_between(&random, -200, 800), random_between(&random, -200, 800), random_between(&random, 1, 500)}};
        window_open(&window, SIDE, SIDE);
        window.shift = (unsigned)round % 2;
        window_draw(&window, SIDE, 16, draw_disc, &v);
        for (int32_t i = 0; i < (SIDE * SIDE) << 2 * window.shift; i++) {
            const int32_t x = i % (SIDE << window.shift), y = i / (SIDE << window.shift);
            const long double scale = 1 << window.shift, dx = x + 0.5L - v.n[0] / 16.0L * scale,
                              dy = y + 0.5L - v.n[1] / 16.0L * scale;
            check_sample(x, y, v.n[2] / 16.0L * scale - hypotl(dx, dy), NEARLY);
        }
    }
}

/* Smaller than a sample, anywhere in it. */
static void the_smallest_discs_are_as_soft_as_distances_say(void **state) {
    (void)state;
    for (int32_t i = 0; i < 16 * 16 * 20; i++) {
        const numbers_t v = {{64 + i % 16, 64 + i / 16 % 16, 1 + i / 256}};
        window_open(&window, 9, 9);
        window_draw(&window, 9, 9, draw_disc, &v);
        for (int32_t k = 0; k < 81; k++) {
            const long double dx = k % 9 + 0.5L - v.n[0] / 16.0L, dy = k / 9 + 0.5L - v.n[1] / 16.0L;
            check_sample(k % 9, k / 9, v.n[2] / 16.0L - hypotl(dx, dy), NEARLY);
        }
    }
}

static void draw_stroke(const void *context, tuile_canvas_t *canvas) {
    const numbers_t *v = context;
    tuile_draw_stroke(canvas, v->n[0], v->n[1], v->n[2], v->n[3], v->n[4], WHITE);
}

static long double segment_distance(const numbers_t *v, int32_t x, int32_t y) {
    const long double px = x + 0.5L - v->n[0] / 16.0L, py = y + 0.5L - v->n[1] / 16.0L;
    const long double dx = (v->n[2] - v->n[0]) / 16.0L, dy = (v->n[3] - v->n[1]) / 16.0L, length = dx * dx + dy * dy;
    long double along = length > 0 ? (px * dx + py * dy) / length : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    return hypotl(px - along * dx, py - along * dy);
}

/* The length of a stroke is rounded down to 1/512 sample. */
static void strokes_are_as_soft_as_distances_say(void **state) {
    random_source_t random = random_seed(6);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(400); round++) {
        numbers_t v = {{0}};
        for (int k = 0; k < 4; k++) {
            v.n[k] = random_between(&random, -100, 740);
        }
        v.n[4] = random_between(&random, 2, 200);
        if (round % 8 == 0) { v.n[2] = v.n[0]; }
        if (round % 8 == 1) { v.n[3] = v.n[1]; }
        if (round % 32 == 0) { v.n[3] = v.n[1]; }
        const long double length = hypotl(v.n[2] - v.n[0], v.n[3] - v.n[1]) / 16.0L;
        window_open(&window, SIDE, SIDE);
        window_draw(&window, SIDE, 16, draw_stroke, &v);
        for (int32_t i = 0; i < SIDE * SIDE; i++) {
            const long double distance = segment_distance(&v, i % SIDE, i / SIDE);
            check_sample(i % SIDE, i / SIDE, v.n[4] / 32.0L - distance, NEARLY + (length > 0 ? distance / (512 * length) : 0));
        }
    }
}

static void draw_half(const void *context, tuile_canvas_t *canvas) {
    const bam16_t *angles = context;
    tuile_draw_arc(canvas, TUILE_PX(20), TUILE_PX(20), 0, TUILE_PX(100), angles[0], angles[1], WHITE);
}

/* Far from the centre of a large slice only one of its edges is near: the distance from that line. Angles in degrees. */
static void edges_of_slices_are_as_soft_as_distances_say(void **state) {
    (void)state;
    for (unsigned degree = 0; degree < 360; degree += 7) {
        for (unsigned sweep = 20; sweep < 360; sweep += 23) {
            const bam16_t angles[] = {(bam16_t)(degree * 65536 / 360), (bam16_t)((degree + sweep) * 65536 / 360)};
            const long double turn = 6.283185307179586476925L / 65536;
            window_open(&window, SIDE, SIDE);
            window_draw(&window, SIDE, SIDE, draw_half, angles);
            for (int32_t i = 0; i < SIDE * SIDE; i++) {
                const long double dx = i % SIDE + 0.5L - 20, dy = i / SIDE + 0.5L - 20, far = hypotl(dx, dy);
                long double angle = atan2l(dy, dx) / turn - angles[0];
                angle -= 65536 * floorl(angle / 65536);
                const long double width = (uint16_t)(angles[1] - angles[0]), from = angle > 32768 ? angle - 65536 : angle;
                long double to = angle - width;
                to += to < -32768 ? 65536 : 0;
                if (far < 8) { continue; }
                const bool near_from = fabsl(from) < fabsl(to);
                const long double off = far * sinl(fabsl(near_from ? from : to) * turn);
                const bool inside = angle < width;
                if (fabsl(near_from ? from : to) > 16000 || off > 2) {
                    assert_int_equal(coverage_at(i % SIDE, i / SIDE), inside ? 16 : 0);
                } else {
                    check_sample(i % SIDE, i / SIDE, inside ? off : -off, 1 / 16.0L); /* floor, and which side a half belongs to */
                }
            }
        }
    }
}

/* ---- parts ---- */

static unsigned sums[SIDE * SIDE];

static void add_up(bool crisp, window_draw_fn draw, const numbers_t *numbers) {
    window_open(&window, SIDE, SIDE);
    window.crisp = crisp;
    window_draw(&window, 17, 9, draw, numbers);
    for (int32_t i = 0; i < SIDE * SIDE; i++) {
        sums[i] += coverage_at(i % SIDE, i / SIDE);
    }
}

static void draw_ring(const void *context, tuile_canvas_t *canvas) {
    const numbers_t *v = context;
    tuile_draw_ring(canvas, v->n[0], v->n[1], v->n[2], v->n[3], WHITE);
}

static void rings_make_up_a_disc(void **state) {
    random_source_t random = random_seed(7);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(200); round++) {
        numbers_t v = {{random_between(&random, 100, 500), random_between(&random, 100, 500)}};
        const int32_t outermost = random_between(&random, 20, 400);
        int32_t inner = 0;
        memset(sums, 0, sizeof sums);
        while (inner < outermost) {
            v.n[2] = inner;
            v.n[3] = inner + random_between(&random, 1, 90);
            if (v.n[3] > outermost) { v.n[3] = outermost; }
            inner = v.n[3];
            add_up(round % 2, draw_ring, &v);
        }
        v.n[2] = outermost;
        window_open(&window, SIDE, SIDE);
        window.crisp = round % 2;
        window_draw(&window, SIDE, SIDE, draw_disc, &v);
        for (int32_t i = 0; i < SIDE * SIDE; i++) {
            assert_int_equal(sums[i], coverage_at(i % SIDE, i / SIDE));
        }
    }
}

static void draw_arc(const void *context, tuile_canvas_t *canvas) {
    const numbers_t *v = context;
    tuile_draw_arc(canvas, v->n[0], v->n[1], v->n[2], v->n[3], (bam16_t)v->n[4], (bam16_t)v->n[5], WHITE);
}

/* Crisp: each pixel of the ring is in one arc. Soft, two arcs: each leaves what the other covers. */
static void arcs_make_up_a_ring(void **state) {
    random_source_t random = random_seed(8);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(300); round++) {
        const bool crisp = round % 2;
        const int32_t parts = crisp ? random_between(&random, 2, 9) : 2, first = random_between(&random, 0, 65535);
        /* Between pixels, so that none is the centre itself; angles of all kinds, eighths of the turn among them */
        numbers_t v = {{16 * random_between(&random, 10, 30), 16 * random_between(&random, 10, 30), 0, 280}};
        memset(sums, 0, sizeof sums);
        int32_t angle = first;
        for (int32_t k = 0; k < parts; k++) {
            v.n[4] = angle;
            angle += round % 3 == 0 ? (crisp ? 0x2000 : 0x8000) : random_between(&random, 1, crisp ? 7281 : 65535);
            if (k + 1 == parts) { angle = first; }
            v.n[5] = angle;
            add_up(crisp, draw_arc, &v);
        }
        window_open(&window, SIDE, SIDE);
        window.crisp = crisp;
        window_draw(&window, SIDE, SIDE, draw_ring, &v);
        for (int32_t i = 0; i < SIDE * SIDE; i++) {
            const unsigned whole = coverage_at(i % SIDE, i / SIDE);
            if (crisp || whole == 16) {
                assert_int_equal(sums[i], whole);
            } else {
                assert_in_range(sums[i] + 1, whole, whole + 2); /* each part is rounded */
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discs_are_as_soft_as_distances_say),
        cmocka_unit_test(the_smallest_discs_are_as_soft_as_distances_say),
        cmocka_unit_test(strokes_are_as_soft_as_distances_say),
        cmocka_unit_test(edges_of_slices_are_as_soft_as_distances_say),
        cmocka_unit_test(rings_make_up_a_disc),
        cmocka_unit_test(arcs_make_up_a_ring),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
