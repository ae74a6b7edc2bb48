/* Windows and polygons: the four tests of document 002 case by case, and random ones against brute force on pixel centres. */
#include "../raster/visibility/window.h"
#include "reference/coverage_reference.h"
#include "support/canvas.h"
#include "support/check.h"

enum { D = WINDOW_DISJOINT, I = WINDOW_INTERSECTING, S = WINDOW_SURROUNDING };

/* The window of all cases: pixels 2 ... 5 each way. */
static const window_t four = {2, 2, 6, 6};

typedef struct example {
    const char *name;
    uint32_t count;
    int32_t points[8][2]; /* in pixels: whole numbers are pixel centres */
    int expected;
} example_t;

static const example_t examples[] = {
    {"far to the left, but its sides go on to the window", 3, {{-9, 2}, {-1, 3}, {-9, 9}}, D},
    {"T3 a: a side crosses two of the window's", 3, {{0, 3}, {9, 4}, {0, 9}}, I},
    {"T3 a: a side ends in the window", 3, {{0, 3}, {4, 4}, {0, 5}}, I},
    {"T3 a: a corner of the window is cut off", 3, {{0, 0}, {5, 0}, {0, 5}}, I},
    {"T3 b: the window's corner on a right side, the face beyond", 3, {{0, 0}, {4, 0}, {0, 4}}, D},
    {"T3 b: the window's corner on a left side, the face on the window's side", 3, {{4, 0}, {0, 4}, {40, 40}}, S},
    {"T3 b: the window's lower right corner on a right side of a face round it", 4, {{0, 0}, {8, 2}, {2, 8}, {0, 8}}, I},
    {"T3 c: a corner of the face on the window's left side, from outside", 3, {{-2, 3}, {2, 4}, {-2, 5}}, D},
    {"T3 c: the same on its right side, where a left edge counts", 3, {{9, 3}, {5, 4}, {9, 5}}, I},
    {"T3 c: on the window's left side, and through it", 4, {{0, 2}, {2, 4}, {4, 8}, {0, 8}}, I},
    {"T3 d: corner on corner, from outside", 3, {{0, 0}, {2, 2}, {0, 2}}, D},
    {"T3 d: corner on corner, on through the window", 3, {{0, 5}, {2, 2}, {9, 9}}, I},
    {"T3 d: a side from corner to corner of the window, through no side of it", 3, {{2, 2}, {5, 5}, {2, 5}}, I},
    {"the same, beyond the corners", 3, {{0, 0}, {9, 9}, {0, 9}}, I},
    {"the face is the window: its centres' hull, half open", 4, {{2, 2}, {6, 2}, {6, 6}, {2, 6}}, S},
    {"closed at the left and top only, so it lacks a column and a row", 4, {{2, 2}, {5, 2}, {5, 5}, {2, 5}}, I},
    {"a side along the window's left side, the face on the window's side", 4, {{2, 0}, {9, 0}, {9, 9}, {2, 9}}, S},
    {"a side along the window's left side, the face beyond", 4, {{-2, 0}, {2, 0}, {2, 9}, {-2, 9}}, D},
    {"a side along the window's right side, the face to its right: its left edge is in", 4, {{5, 0}, {9, 0}, {9, 9}, {5, 9}}, I},
    {"a side along the window's top, the face above", 4, {{0, -2}, {9, -2}, {9, 2}, {0, 2}}, D},
    {"a side along the window's bottom, the face below: its top edge is in", 4, {{0, 5}, {9, 5}, {9, 9}, {0, 9}}, I},
    {"T4: round the window", 3, {{-20, -20}, {40, -20}, {-20, 40}}, S},
    {"T4: not convex, the window in its notch", 7, {{0, 0}, {9, 0}, {9, 9}, {8, 9}, {8, 1}, {0, 1}, {0, 0}}, D},
    {"T4: not convex, the window in its body", 5, {{0, 0}, {9, 0}, {9, 9}, {7, 1}, {0, 9}}, I},
    {"T4: it crosses itself, the window in the left half", 4, {{0, -40}, {40, 40}, {40, -40}, {0, 40}}, S},
    {"T4: twice round is outside", 8, {{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {9, 0}, {9, 9}, {0, 9}}, D},
    {"there and back on one line through the window", 3, {{0, 3}, {9, 4}, {0, 3}}, I},
};

static canvas_face_t face_in_pixels(const int32_t (*points)[2], uint32_t count, bool backwards) {
    int32_t fine[8][2];
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t at = backwards ? count - 1 - i : i;
        fine[i][0] = CENTRE(points[at][0]);
        fine[i][1] = CENTRE(points[at][1]);
    }
    return face_of_points((const int32_t(*)[2])fine, count);
}

static void the_four_tests_case_by_case(void **state) {
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(examples); i++) {
        for (unsigned backwards = 0; backwards < 2; backwards++) {
            canvas_face_t face = face_in_pixels(examples[i].points, examples[i].count, backwards);
            const polygon_ring_t ring = face_ring(&face);
            const int found = (int)window_ring(&ring, &four);
            if (found != examples[i].expected) { fail_msg("%s: %d", examples[i].name, found); }
        }
    }
}

static void triangles_answer_as_polygons_do(void **state) {
    unsigned count = 0;
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(examples); i++) {
        canvas_face_t face = face_in_pixels(examples[i].points, examples[i].count, false);
        if (examples[i].count != 3 || !face_to_triangle(&face)) { continue; }
        window_side_t sides[3];
        for (uint32_t k = 0; k < 3; k++) {
            const vertex_t *a = face_corner(&face, k), *b = face_corner(&face, (k + 1) % 3);
            sides[k] = window_side(a->x, a->y, b->x, b->y);
        }
        const polygon_ring_t ring = face_ring(&face);
        const window_t box = window_of_ring(&ring);
        const int found = window_misses(&four, &box) ? D : (int)window_triangle(sides, &four);
        if (found != examples[i].expected) { fail_msg("%s: %d", examples[i].name, found); }
        count++;
    }
    assert_int_equal(count, 13);
}

static void boxes_against_windows(void **state) {
    static const struct {
        window_t box;
        bool held, missed;
    } boxes[] = {
        {{2, 2, 6, 6}, true, false},  {{3, 3, 4, 4}, true, false},  {{1, 2, 6, 6}, false, false},   {{2, 1, 6, 6}, false, false},
        {{2, 2, 7, 6}, false, false}, {{2, 2, 6, 7}, false, false}, {{-5, 0, 2, 9}, false, true},   {{6, 0, 9, 9}, false, true},
        {{0, -5, 9, 2}, false, true}, {{0, 6, 9, 9}, false, true},  {{-5, -5, 3, 3}, false, false}, {{5, 5, 9, 9}, false, false},
    };
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(boxes); i++) {
        assert_int_equal(window_holds(&four, &boxes[i].box), boxes[i].held);
        assert_int_equal(window_misses(&four, &boxes[i].box), boxes[i].missed);
    }
    /* (1.5, 2) ... (4.5, 7) in pixels: centres 1.5 is not below 1.5, so column 1 is in, and row 7 - 0.5 is the last above 7. */
    static const int32_t points[3][2] = {{24, 32}, {72, 40}, {30, 112}};
    canvas_face_t face = face_of_points(points, 3);
    const polygon_ring_t ring = face_ring(&face);
    const window_t box = window_of_ring(&ring);
    assert_int_equal(box.left, 1);
    assert_int_equal(box.top, 2);
    assert_int_equal(box.right, 4);
    assert_int_equal(box.bottom, 7);
}

/* One corner at a random place of a grid of centres, so that every sub-case comes up; or anywhere. */
#define SIZE_PX 12

static void check_random(random_source_t *random, uint32_t count, unsigned *decided, unsigned *open) {
    int32_t points[16][2];
    canvas_random_points(random, points, count, SIZE_PX, random_one_in(random, 8) ? 16000 : 400);
    canvas_face_t face = face_of_points((const int32_t(*)[2])points, count);
    const polygon_ring_t ring = face_ring(&face);
    const window_t box = window_of_ring(&ring);
    canvas_face_t turned = face;
    const bool triangle = count == 3 && face_to_triangle(&turned);
    window_side_t sides[3];
    for (uint32_t k = 0; triangle && k < 3; k++) {
        const vertex_t *a = face_corner(&turned, k), *b = face_corner(&turned, (k + 1) % 3);
        sides[k] = window_side(a->x, a->y, b->x, b->y);
    }
    for (unsigned w = 0; w < 6; w++) {
        const int32_t left = random_between(random, 0, SIZE_PX - 1), top = random_between(random, 0, SIZE_PX - 1);
        const int32_t right = random_between(random, left + 1, SIZE_PX), bottom = random_between(random, top + 1, SIZE_PX);
        const window_t window = {(int16_t)left, (int16_t)top, (int16_t)right, (int16_t)bottom};
        uint32_t mask = 0;
        bool all = true, none = true;
        for (int32_t y = top; y < bottom; y++) {
            for (int32_t x = left; x < right; x++) {
                const bool in = coverage_reference_pixel((const int32_t(*)[2])points, count, x, y);
                all &= in;
                none &= !in;
                if (in && window_area(&window) <= WINDOW_MASK_PX) { mask |= 1u << ((y - top) * (right - left) + x - left); }
            }
        }
        const window_relation_t found = window_ring(&ring, &window);
        assert_true(found != WINDOW_SURROUNDING || all);
        assert_true(found != WINDOW_DISJOINT || none);
        assert_true(!window_misses(&window, &box) || none);
        assert_true(window_area(&window) > 1 || found != WINDOW_INTERSECTING);
        *(found == WINDOW_INTERSECTING ? open : decided) += 1;
        if (window_area(&window) <= WINDOW_MASK_PX) { assert_int_equal(window_mask_ring(&ring, &window), mask); }
        if (!triangle) { continue; }
        const window_relation_t quick = window_misses(&window, &box) ? WINDOW_DISJOINT : window_triangle(sides, &window);
        assert_int_equal(quick == WINDOW_SURROUNDING, all); /* convex: its corners tell */
        assert_true(quick != WINDOW_DISJOINT || none);
        assert_true(quick == found || (quick == WINDOW_INTERSECTING && found == WINDOW_DISJOINT) ||
                    (quick == WINDOW_DISJOINT && found == WINDOW_INTERSECTING));
        if (window_area(&window) == 1) { assert_true(quick != WINDOW_INTERSECTING); }
        if (window_area(&window) <= WINDOW_MASK_PX && !window_misses(&window, &box)) {
            assert_int_equal(window_mask_triangle(sides, &box, &window), mask);
        }
    }
}

static void random_polygons_and_windows_agree_with_their_pixels(void **state) {
    random_source_t random = random_seed(15);
    unsigned decided = 0, open = 0;
    (void)state;
    for (unsigned i = 0; i < CHECK_ROUNDS(200000u); i++) {
        check_random(&random, (uint32_t)(random_one_in(&random, 2) ? 3 : random_between(&random, 3, 16)), &decided, &open);
    }
    assert_true(decided > open / 2 && open > decided / 20); /* both answers are common */
}

static void the_widest_polygons_do_not_overflow(void **state) {
    /* Corners 32767 apart, both ways, round a window of 1024 x 1024 pixels and beside it. */
    static const int32_t round[4][2] = {{-8192, -8192}, {24575, -8192}, {24575, 24575}, {-8192, 24575}};
    static const int32_t slope[3][2] = {{-8192, 24575}, {24575, -8192}, {24575, 24575}};
    const window_t whole = {0, 0, 1024, 1024}, lower = {700, 700, 1024, 1024}, upper = {0, 0, 300, 300};
    canvas_face_t face = face_of_points(round, 4);
    polygon_ring_t ring = face_ring(&face);
    (void)state;
    assert_int_equal(window_ring(&ring, &whole), S);
    face = face_of_points(slope, 3);
    ring = face_ring(&face);
    assert_int_equal(window_ring(&ring, &whole), I);
    assert_int_equal(window_ring(&ring, &lower), S);
    assert_int_equal(window_ring(&ring, &upper), D);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_four_tests_case_by_case),
        cmocka_unit_test(triangles_answer_as_polygons_do),
        cmocka_unit_test(boxes_against_windows),
        cmocka_unit_test(random_polygons_and_windows_agree_with_their_pixels),
        cmocka_unit_test(the_widest_polygons_do_not_overflow),
    };
    return cmocka_run_group_tests_name("window", tests, NULL, NULL);
}
