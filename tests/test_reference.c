/* The references are checked before anything is checked against them: against numbers from the documents, numbers worked by hand,
 * and each other (they share no code). So is the generator of scenes. */
#include "reference/coverage_reference.h"
#include "reference/scene_generator.h"
#include "reference/visibility_reference.h"
#include "support/check.h"
#include "support/scene_parse.h"

/* ---- coverage --------------------------------------------------------------------------------------------- */

/* Polygons of the documents have whole coordinates and are sampled there: their point (x, y) is the centre of pixel (x, y). */
static void at_centres(int32_t (*points)[2], const int (*document)[2], size_t count) {
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < 2; c++) {
            points[i][c] = 16 * document[i][c] + 8;
        }
    }
}

static void expect_spans(const int32_t (*points)[2], size_t count, int width, int height, const reference_span_t *expected,
                         size_t expected_count) {
    reference_spans_t spans = {0};
    assert_int_equal(coverage_reference(&spans, points, count, width, height), 0);
    assert_int_equal(spans.count, expected_count);
    for (size_t i = 0; i < expected_count; i++) {
        assert_int_equal(spans.items[i].y, expected[i].y);
        assert_int_equal(spans.items[i].x0, expected[i].x0);
        assert_int_equal(spans.items[i].x1, expected[i].x1);
    }
    coverage_reference_free(&spans);
}

/* Document 000, figures 5 and 8, and its table of XG and XD (S7, example 2). */
static const int figure_5[21][2] = {{1, 12},  {5, 10}, {8, 10}, {10, 6}, {13, 12}, {16, 12}, {18, 14},
                                    {20, 13}, {20, 8}, {17, 8}, {21, 4}, {17, 0},  {15, 2},  {13, 2},
                                    {11, 0},  {9, 4},  {7, 2},  {5, 2},  {1, 0},   {5, 4},   {1, 8}};
static const reference_span_t figure_5_spans[] = {{1, 2, 2},    {1, 11, 11}, {1, 16, 17},  {2, 3, 6},    {2, 10, 18}, {3, 4, 7},
                                                  {3, 10, 19},  {4, 5, 20},  {5, 4, 19},   {6, 3, 9},    {6, 10, 18}, {7, 2, 9},
                                                  {7, 11, 17},  {8, 1, 8},   {8, 11, 19},  {9, 1, 8},    {9, 12, 19}, {10, 1, 4},
                                                  {10, 12, 19}, {11, 1, 2},  {11, 13, 19}, {12, 16, 19}, {13, 17, 19}};

static void coverage_of_figure_5(void **state) {
    (void)state;
    int32_t points[21][2];
    at_centres(points, figure_5, 21);
    expect_spans((const int32_t(*)[2])points, 21, 32, 32, figure_5_spans, CHECK_COUNT(figure_5_spans));
}

/* Touching spans stay apart until they are merged: [3, 9] and [10, 18] of row 6. */
static void coverage_merges_touching_spans(void **state) {
    (void)state;
    int32_t points[21][2];
    at_centres(points, figure_5, 21);
    reference_spans_t spans = {0};
    assert_int_equal(coverage_reference(&spans, (const int32_t(*)[2])points, 21, 32, 32), 0);
    coverage_reference_merge(&spans);
    assert_int_equal(spans.count, CHECK_COUNT(figure_5_spans) - 1);
    for (size_t i = 0; i < spans.count; i++) {
        if (spans.items[i].y == 6) {
            assert_int_equal(spans.items[i].x0, 3);
            assert_int_equal(spans.items[i].x1, 18);
        }
    }
    coverage_reference_free(&spans);
}

/* Document 000, left edge (3, 0) - (7, 10): the table's row "x shown"; as a right edge it ends one pixel before. */
static void coverage_steps_like_the_worked_edge(void **state) {
    (void)state;
    static const int shown[10] = {3, 4, 4, 5, 5, 5, 6, 6, 7, 7};
    static const int left[4][2] = {{3, 0}, {7, 10}, {30, 10}, {30, 0}}, right[4][2] = {{-5, 0}, {-5, 10}, {7, 10}, {3, 0}};
    int32_t points[4][2];
    reference_span_t expected[10];
    for (int y = 0; y < 10; y++) {
        expected[y] = (reference_span_t){y, shown[y], 29};
    }
    at_centres(points, left, 4);
    expect_spans((const int32_t(*)[2])points, 4, 32, 32, expected, 10);
    for (int y = 0; y < 10; y++) {
        expected[y] = (reference_span_t){y, 0, shown[y] - 1};
    }
    at_centres(points, right, 4);
    expect_spans((const int32_t(*)[2])points, 4, 32, 32, expected, 10);
}

static void coverage_of_squares(void **state) {
    (void)state;
    /* Through centres: left and top in, right and bottom out. */
    expect_spans((const int32_t[4][2]){{8, 8}, {40, 8}, {40, 40}, {8, 40}}, 4, 8, 8,
                 (const reference_span_t[]){{0, 0, 1}, {1, 0, 1}}, 2);
    /* A sixteenth later on every side: the other pixels. */
    expect_spans((const int32_t[4][2]){{9, 9}, {41, 9}, {41, 41}, {9, 41}}, 4, 8, 8,
                 (const reference_span_t[]){{1, 1, 2}, {2, 1, 2}}, 2);
    /* Between centres. */
    expect_spans((const int32_t[4][2]){{9, 9}, {24, 9}, {24, 24}, {9, 24}}, 4, 8, 8, NULL, 0);
    /* One centre on its corner: only the top left corner counts. */
    expect_spans((const int32_t[4][2]){{8, 8}, {16, 8}, {16, 16}, {8, 16}}, 4, 8, 8, (const reference_span_t[]){{0, 0, 0}}, 1);
    expect_spans((const int32_t[4][2]){{0, 8}, {8, 8}, {8, 16}, {0, 16}}, 4, 8, 8, NULL, 0);
    expect_spans((const int32_t[4][2]){{0, 0}, {8, 0}, {8, 8}, {0, 8}}, 4, 8, 8, NULL, 0);
    /* Larger than the window, and beside it. */
    expect_spans((const int32_t[4][2]){{-900, -900}, {900, -900}, {900, 900}, {-900, 900}}, 4, 2, 2,
                 (const reference_span_t[]){{0, 0, 1}, {1, 0, 1}}, 2);
    expect_spans((const int32_t[4][2]){{-90, 0}, {-9, 0}, {-9, 90}, {-90, 90}}, 4, 2, 2, NULL, 0);
    /* No area. */
    expect_spans((const int32_t[3][2]){{0, 0}, {80, 80}, {40, 40}}, 3, 8, 8, NULL, 0);
}

/* A bow tie, 4 pixels wide, its diagonals through centres: the left half ends where the right half begins. A square walked twice is
 * outside. */
static void coverage_is_even_odd(void **state) {
    (void)state;
    expect_spans((const int32_t[4][2]){{0, 0}, {64, 64}, {64, 0}, {0, 64}}, 4, 8, 8,
                 (const reference_span_t[]){{0, 3, 3}, {1, 0, 0}, {1, 2, 3}, {2, 0, 0}, {2, 2, 3}, {3, 3, 3}}, 6);
    expect_spans((const int32_t[8][2]){{0, 0}, {64, 0}, {64, 64}, {0, 64}, {0, 0}, {64, 0}, {64, 64}, {0, 64}}, 8, 8, 8, NULL, 0);
}

static void random_points(uint64_t *seed, int32_t (*points)[2], size_t count, int32_t reach) {
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < 2; c++) {
            points[i][c] = scene_generator_between(seed, -reach / 4, reach);
        }
    }
}

/* Two ways of asking, one answer. */
static void coverage_by_row_is_coverage_by_pixel(void **state) {
    (void)state;
    enum { SIZE = 12 };
    uint64_t seed = 1;
    reference_spans_t spans = {0};
    for (int round = 0; round < 4000; round++) {
        int32_t points[9][2];
        size_t count = (size_t)scene_generator_between(&seed, 3, 9);
        random_points(&seed, points, count, SIZE * 16);
        if (round % 2) { /* many vertices on centres */
            for (size_t i = 0; i < count; i++) {
                points[i][0] = points[i][0] / 8 * 8, points[i][1] = points[i][1] / 8 * 8;
            }
        }
        bool drawn[SIZE][SIZE] = {{false}};
        assert_int_equal(coverage_reference(&spans, (const int32_t(*)[2])points, count, SIZE, SIZE), 0);
        for (size_t i = 0; i < spans.count; i++) {
            for (int x = spans.items[i].x0; x <= spans.items[i].x1; x++) {
                assert_false(drawn[spans.items[i].y][x]);
                drawn[spans.items[i].y][x] = true;
            }
        }
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                assert_int_equal(drawn[y][x], coverage_reference_pixel((const int32_t(*)[2])points, count, x, y));
            }
        }
    }
    coverage_reference_free(&spans);
}

/* A fan around a point: every pixel of the square is in exactly one triangle. */
static void coverage_is_watertight(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int round = 0; round < 500; round++) {
        int32_t hub[2] = {scene_generator_between(&seed, 1, 159), scene_generator_between(&seed, 1, 159)};
        static const int32_t rim[8][2] = {{0, 0}, {72, 0}, {160, 0}, {160, 88}, {160, 160}, {56, 160}, {0, 160}, {0, 8}};
        int drawn[10][10] = {{0}};
        for (int i = 0; i < 8; i++) {
            const int32_t points[3][2] = {{hub[0], hub[1]}, {rim[i][0], rim[i][1]}, {rim[(i + 1) % 8][0], rim[(i + 1) % 8][1]}};
            for (int y = 0; y < 10; y++) {
                for (int x = 0; x < 10; x++) {
                    drawn[y][x] += coverage_reference_pixel(points, 3, x, y);
                }
            }
        }
        for (int y = 0; y < 10; y++) {
            for (int x = 0; x < 10; x++) {
                assert_int_equal(drawn[y][x], 1);
            }
        }
    }
}

/* The extremes of `tuile coverage`. */
static void coverage_holds_the_largest_coordinates(void **state) {
    (void)state;
    const int32_t far = 32767 * 16;
    expect_spans((const int32_t[3][2]){{-far, -far}, {far, -far}, {far, far}}, 3, 4, 2,
                 (const reference_span_t[]){{0, 0, 3}, {1, 1, 3}}, 2);
}

/* ---- visibility ------------------------------------------------------------------------------------------- */

static visibility_reference_t *prepare(const char *text, const visibility_options_t *options) {
    scene_text_t scene = scene_parse(text);
    visibility_reference_t *reference;
    sim_error_t error = {""};
    if (visibility_reference_make(&reference, &scene, options, &error) < 0) { fail_msg("%s\n%s", error.text, text); }
    scene_text_free(&scene);
    return reference;
}

/* The picture as characters: '.' background, else the face's index; rows as given. */
static void expect_picture(const char *text, const char *const *rows, int height) {
    visibility_reference_t *reference = prepare(text, NULL);
    for (int y = 0; y < height; y++) {
        char row[64] = "";
        for (int x = 0; rows[y][x]; x++) {
            int32_t face = visibility_reference_at(reference, x, y).face;
            row[x] = (char)(face < 0 ? '.' : '0' + face);
            row[x + 1] = 0;
        }
        assert_string_equal(row, rows[y]);
    }
    visibility_reference_free(reference);
}

static void visibility_of_figure_5(void **state) {
    (void)state;
    char text[1024] = "screen 24 16\ncamera ortho\npoly 1";
    for (size_t i = 0; i < 21; i++) {
        (void)snprintf(text + strlen(text), sizeof text - strlen(text), " %d,%d,0", figure_5[i][0], figure_5[i][1]);
    }
    visibility_reference_t *reference = prepare(text, NULL);
    for (int y = 0; y < 16; y++) {
        for (int x = 0; x < 24; x++) {
            bool expected = false;
            for (size_t i = 0; i < CHECK_COUNT(figure_5_spans); i++) {
                expected = expected || (figure_5_spans[i].y == y && figure_5_spans[i].x0 <= x && x <= figure_5_spans[i].x1);
            }
            assert_int_equal(visibility_reference_at(reference, x, y).face, expected ? 0 : -1);
        }
    }
    visibility_reference_free(reference);
}

static void visibility_of_a_square(void **state) {
    (void)state;
    static const char *const at_points[] = {".....", ".00..", ".00..", "....."};
    expect_picture("screen 5 4\ncamera ortho\npoly 9 1,1,0 3,1,0 3,3,0 1,3,0", at_points, 4);
    /* Sampled at centres the square from 1.5 to 3.5 covers the same pixels; a hair to the left, one column more. */
    expect_picture("screen 5 4\ncamera ortho\nsample 1/2 1/2\npoly 9 1.5,1.5,0 3.5,1.5,0 3.5,3.5,0 1.5,3.5,0", at_points, 4);
    static const char *const shifted[] = {".....", ".000.", ".000.", "....."};
    expect_picture("screen 5 4\ncamera ortho\nsample 1/2 1/2\npoly 9 1.5,1.5,0 3.51,1.5,0 3.51,3.5,0 1.5,3.5,0", shifted, 4);
}

/* Two roofs through each other: z = x and z = 4 - x are equal at x = 2, where the order decides. */
static void visibility_of_crossing_faces(void **state) {
    (void)state;
#define ROOFS "poly 1 0,0,0 5,0,5 5,1,5 0,1,0\npoly 2 0,0,4 5,0,-1 5,1,-1 0,1,4\n"
    static const char *const min_first[] = {"00011"}, *const min_last[] = {"00111"}, *const max_first[] = {"11000"};
    expect_picture("screen 5 1\ncamera ortho\n" ROOFS, min_first, 1);
    expect_picture("screen 5 1\ncamera ortho\ntie last\n" ROOFS, min_last, 1);
    expect_picture("screen 5 1\ncamera ortho\nnear max\n" ROOFS, max_first, 1);
    visibility_reference_t *reference = prepare("screen 5 1\ncamera ortho\n" ROOFS, NULL);
    assert_int_equal(visibility_reference_at(reference, 2, 0).doubt & VISIBILITY_DEPTH, 0 /* the top edge passes through it */);
    assert_int_equal(visibility_reference_at(reference, 2, 0).doubt & VISIBILITY_EDGE, VISIBILITY_EDGE);
    visibility_reference_free(reference);
    reference = prepare("screen 5 1\ncamera ortho\nsample 0 1/2\n" ROOFS, NULL);
    assert_int_equal(visibility_reference_at(reference, 2, 0).doubt, VISIBILITY_DEPTH);
    assert_int_equal(visibility_reference_at(reference, 1, 0).doubt, 0);
    assert_true(visibility_reference_allows(reference, 2, 0, 0));
    assert_true(visibility_reference_allows(reference, 2, 0, 1));
    assert_false(visibility_reference_allows(reference, 2, 0, -1));
    assert_false(visibility_reference_allows(reference, 1, 0, 1));
    visibility_reference_free(reference);
#undef ROOFS
}

static void visibility_of_coplanar_faces(void **state) {
    (void)state;
#define FACES "poly 1 0,0,0 4,0,4 4,4,8 0,4,4\npoly 2 2,0,2 6,0,6 6,4,10 2,4,6\n"
    static const char *const first[] = {"000011."}, *const last[] = {"001111."};
    expect_picture("screen 7 1\ncamera ortho\nsample 0 1/2\n" FACES, first, 1);
    expect_picture("screen 7 1\ncamera ortho\nsample 0 1/2\ntie last\n" FACES, last, 1);
    visibility_reference_t *reference = prepare("screen 7 1\ncamera ortho\nsample 0 1/2\n" FACES, NULL);
    assert_int_equal(visibility_reference_at(reference, 3, 0).doubt, VISIBILITY_COPLANAR);
    assert_int_equal(visibility_reference_at(reference, 1, 0).doubt, 0);
    assert_int_equal(visibility_reference_at(reference, 6, 0).doubt, VISIBILITY_EDGE);
    visibility_reference_free(reference);
#undef FACES
}

/* F = 4, C = (4, 3): the square |X|, |Y| <= 1 at Z = 2 is the window's 2 ... 6 by 1 ... 5; at Z = 4, 3 ... 5 by 2 ... 4. */
static void visibility_in_perspective(void **state) {
    (void)state;
    static const char *const rows[] = {"........", "..0000..", "..0000..", "..0000..", "..0000..", "........"};
    expect_picture("screen 8 6\ncamera persp 4\npoly 1 -1,-1,2 1,-1,2 1,1,2 -1,1,2\npoly 2 -1,-1,4 1,-1,4 1,1,4 -1,1,4", rows, 6);
    static const char *const small[] = {"........", "........", "...00...", "...00...", "........", "........"};
    expect_picture("screen 8 6\ncamera persp 4\npoly 1 -1,-1,4 1,-1,4 1,1,4 -1,1,4\npoly 2 -1,-1,-4 1,-1,-4 1,1,-4 -1,1,-4", small,
                   6);
    /* y up: the square 1 ... 2 above the axis is above the middle of the window (rows 1 and 2 of 0 ... 5, out at its lower edge).
     */
    static const char *const up[] = {"........", "....00..", "....00..", "........", "........", "........"};
    expect_picture("screen 8 6\ncamera persp 4\nysign -1\npoly 1 0,0,2 1,0,2 1,1,2 0,1,2", up, 6);
    static const char *const down[] = {"........", "........", "........", "....00..", "....00..", "........"};
    expect_picture("screen 8 6\ncamera persp 4\npoly 1 0,0,2 1,0,2 1,1,2 0,1,2", down, 6);
    static const char *const moved[] = {"00......", "00......", "........", "........", "........", "........"};
    expect_picture("screen 8 6\ncamera persp 4\norigin 0 0\npoly 1 0,0,2 1,0,2 1,1,2 0,1,2", moved, 6);
}

/* The floor Y = 2, |X| <= 4, from Z = -4 to Z = 8, F = 4, NEAR = 2, C = (4, 0). Row y sees it at Z = 8 / y: row 1 at its far edge Z
 * = 8 (which is the upper one: in), row 4 at Z = 2 = NEAR, where the cut is (the lower edge: out). On row y it spans 4 +- 2 y. */
static void visibility_across_the_near_plane(void **state) {
    (void)state;
    static const char *const rows[] = {"........", "..0000..", "00000000", "00000000", "........", "........"};
    expect_picture("screen 8 6\ncamera persp 4 2\norigin 4 0\npoly 1 -4,2,-4 4,2,-4 4,2,8 -4,2,8", rows, 6);
    /* NEAR at 8 / 5: one row more. */
    static const char *const nearer[] = {"........", "..0000..", "00000000", "00000000", "00000000", "........"};
    expect_picture("screen 8 6\ncamera persp 4 8/5\norigin 4 0\npoly 1 -4,2,-4 4,2,-4 4,2,8 -4,2,8", nearer, 6);
    /* The ceiling Y = -2 stays above, though its part behind the eye would project below. */
    static const char *const none[] = {"........", "........", "........", "........", "........", "........"};
    expect_picture("screen 8 6\ncamera persp 4 2\norigin 4 0\npoly 1 -4,-2,-4 4,-2,-4 4,-2,8 -4,-2,8", none, 6);
    /* A face in the near plane itself is kept. */
    static const char *const kept[] = {"....00..", "....00..", "........", "........", "........", "........"};
    expect_picture("screen 8 6\ncamera persp 4 2\norigin 4 0\npoly 1 0,0,2 1,0,2 1,1,2 0,1,2", kept, 6);
}

/* A face whose plane holds the eye is a line; it hides nothing. */
static void visibility_of_faces_edge_on(void **state) {
    (void)state;
    static const char *const rows[] = {"0000", "0000"};
    expect_picture("screen 4 2\ncamera persp 1\npoly 1 -9,-9,4 9,-9,4 9,9,4 -9,9,4\npoly 2 0,-2,2 0,2,2 0,2,3 0,-2,3", rows, 2);
    expect_picture("screen 4 2\ncamera ortho\npoly 1 -9,-9,4 9,-9,4 9,9,4 -9,9,4\npoly 2 2,-2,2 2,2,2 2,2,3 2,-2,3", rows, 2);
    visibility_reference_t *reference =
        prepare("screen 4 2\ncamera ortho\npoly 1 -9,-9,4 9,-9,4 9,9,4 -9,9,4\npoly 2 2,-2,2 2,2,2 2,2,3 2,-2,3", NULL);
    assert_int_equal(visibility_reference_at(reference, 1, 1).doubt, 0);
    assert_int_equal(visibility_reference_at(reference, 2, 1).doubt, VISIBILITY_EDGE); /* snapping may open it */
    visibility_reference_free(reference);
}

static void expect_parses(const char *text, uint64_t seed, scene_text_t *scene) {
    sim_error_t error = {""};
    if (scene_text_parse(scene, text, strlen(text), "generated", &error) < 0) {
        fail_msg("seed %llu: %s\n%s", (unsigned long long)seed, error.text, text);
    }
}

/* One face seen from the front is what the other reference says it is. */
static void visibility_of_one_face_is_its_coverage(void **state) {
    (void)state;
    enum { SIZE = 12 };
    uint64_t seed = 3;
    for (int round = 0; round < 1000; round++) {
        int32_t points[9][2];
        size_t count = (size_t)scene_generator_between(&seed, 4, 9);
        random_points(&seed, points, count, SIZE * 16);
        bool perspective = round % 2;
        char text[512];
        (void)snprintf(text, sizeof text, "screen %d %d\nsample 1/2 1/2\n%s\npoly 1", SIZE, SIZE,
                       perspective ? "camera persp 1\norigin 0 0" : "camera ortho");
        for (size_t i = 0; i < count; i++) {
            (void)snprintf(text + strlen(text), sizeof text - strlen(text), perspective ? " %d,%d,16" : " %d/16,%d/16,3",
                           (int)points[i][0], (int)points[i][1]);
        }
        visibility_reference_t *reference = prepare(text, NULL);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                assert_int_equal(visibility_reference_at(reference, x, y).face,
                                 coverage_reference_pixel((const int32_t(*)[2])points, count, x, y) ? 0 : -1);
            }
        }
        visibility_reference_free(reference);
    }
}

/* A polygon cut by hand at Z = NEAR and the same left to the reference. Triangle (0, 0, 6) (6, 0, -2) (0, 6, -2) meets Z = 2 at
 * half of its two long edges: (3, 0, 2) and (0, 3, 2). */
static void visibility_cuts_as_by_hand(void **state) {
    (void)state;
    visibility_reference_t *whole =
        prepare("screen 40 40\ncamera persp 20 2\norigin 3 3\nsample 1/3 1/7\npoly 1 0,0,6 6,0,-2 0,6,-2", NULL);
    visibility_reference_t *cut =
        prepare("screen 40 40\ncamera persp 20 2\norigin 3 3\nsample 1/3 1/7\npoly 1 0,0,6 3,0,2 0,3,2", NULL);
    int seen = 0;
    for (int y = 0; y < 40; y++) {
        for (int x = 0; x < 40; x++) {
            assert_int_equal(visibility_reference_at(whole, x, y).face, visibility_reference_at(cut, x, y).face);
            seen += visibility_reference_at(cut, x, y).face == 0;
        }
    }
    assert_in_range(seen, 400, 500); /* the window triangle 30 by 30 */
    visibility_reference_free(whole);
    visibility_reference_free(cut);
}

/* Pixels without doubt stay as they are when all samples move within the displacement. */
static void visibility_without_doubt_is_stable(void **state) {
    (void)state;
    static const int moves[][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    long certain = 0, doubtful = 0, coplanar = 0, background = 0;
    for (uint64_t seed = 1; seed <= 120; seed++) {
        char *text = scene_generate(seed, NULL);
        assert_non_null(text);
        scene_text_t scene;
        expect_parses(text, seed, &scene);
        sim_error_t error = {""};
        visibility_reference_t *reference, *moved[CHECK_COUNT(moves)];
        assert_int_equal(visibility_reference_make(&reference, &scene, NULL, &error), 0);
        scene_number_t sample[2] = {scene.sample[0], scene.sample[1]};
        for (size_t m = 0; m < CHECK_COUNT(moves); m++) {
            for (int c = 0; c < 2; c++) { /* by 1/16 */
                scene.sample[c] =
                    (scene_number_t){16 * sample[c].numerator + moves[m][c] * sample[c].denominator, 16 * sample[c].denominator};
            }
            assert_int_equal(visibility_reference_make(&moved[m], &scene, NULL, &error), 0);
        }
        for (int y = 0; y < scene.height; y++) {
            for (int x = 0; x < scene.width; x++) {
                visibility_pixel_t pixel = visibility_reference_at(reference, x, y);
                assert_true(visibility_reference_allows(reference, x, y, pixel.face));
                int allowed = 0;
                for (int32_t face = -1; face < (int32_t)scene.poly_count; face++) {
                    allowed += visibility_reference_allows(reference, x, y, face);
                }
                assert_int_equal(allowed == 1, pixel.doubt == 0);
                certain += !pixel.doubt;
                doubtful += pixel.doubt != 0;
                coplanar += pixel.doubt == VISIBILITY_COPLANAR;
                background += pixel.face < 0;
                for (size_t m = 0; m < CHECK_COUNT(moves); m++) {
                    int32_t face = visibility_reference_at(moved[m], x, y).face;
                    if (!visibility_reference_allows(reference, x, y, face)) {
                        fail_msg("seed %llu: pixel %d %d is %d, moved (%d, %d) / 16 it is %d\n%s", (unsigned long long)seed, x, y,
                                 (int)pixel.face, moves[m][0], moves[m][1], (int)face, text);
                    }
                }
            }
        }
        for (size_t m = 0; m < CHECK_COUNT(moves); m++) {
            visibility_reference_free(moved[m]);
        }
        visibility_reference_free(reference);
        scene_text_free(&scene);
        free(text);
    }
    assert_true(certain > 2 * doubtful && coplanar > 0 && background > 0 && background < certain);
}

static void visibility_refuses_numbers_too_long(void **state) {
    (void)state;
    scene_text_t scene = scene_parse("screen 8 8\ncamera ortho\npoly 1 0,0,1/9999999967 1,0,1/9999999967 0,1,1/9999999967\n");
    visibility_reference_t *reference;
    sim_error_t error = {""};
    assert_int_equal(visibility_reference_make(&reference, &scene, NULL, &error), 0); /* one prime is 34 bits */
    visibility_reference_free(reference);
    scene_text_free(&scene);
    scene = scene_parse("screen 8 8\ncamera ortho\npoly 1 0,0,1/9999999967 1/1000003,0,1/9999999967 0,1,1/9999999967\n");
    assert_int_equal(visibility_reference_make(&reference, &scene, NULL, &error), -1);
    assert_non_null(strstr(error.text, "too long"));
    scene_text_free(&scene);
}

/* ---- the scene generator ---------------------------------------------------------------------------------- */

static void generator_keeps_its_word(void **state) {
    (void)state;
    static const scene_generator_t settings[] = {{.no_perspective = true},
                                                 {.no_orthographic = true, .no_near_cut = true},
                                                 {.convex = true},
                                                 {.simple = true, .no_coplanar = true},
                                                 {.width = 256, .height = 256, .faces = 3}};
    int near_cuts = 0, behind = 0, cut_scenes = 0;
    for (size_t s = 0; s < CHECK_COUNT(settings); s++) {
        for (uint64_t seed = 0; seed < 300; seed++) {
            char *text = scene_generate(seed, &settings[s]), *again = scene_generate(seed, &settings[s]);
            assert_non_null(text);
            assert_string_equal(text, again);
            scene_text_t scene;
            expect_parses(text, seed, &scene);
            if (settings[s].faces) { assert_int_equal(scene.poly_count, settings[s].faces); }
            assert_false(settings[s].no_perspective && scene.projection == TUILE_PERSPECTIVE);
            assert_false(settings[s].no_orthographic && scene.projection == TUILE_ORTHOGRAPHIC);
            for (size_t p = 0; p < scene.poly_count; p++) {
                int before = 0, after = 0;
                for (size_t i = 0; i < scene.polys[p].count; i++) {
                    const scene_number_t *vertex = scene.vertices[scene.polys[p].first + i];
                    for (int c = 0; c < 3; c++) {
                        assert_true(llabs(vertex[c].numerator) <= 4000 && vertex[c].denominator == 1);
                    }
                    before += scene_number_value(vertex[2]) < scene_number_value(scene.near);
                    after += scene_number_value(vertex[2]) >= scene_number_value(scene.near);
                }
                if (scene.projection == TUILE_PERSPECTIVE) {
                    assert_false(settings[s].no_near_cut && before);
                    near_cuts += before && after;
                    behind += before && !after;
                    cut_scenes++;
                }
            }
            visibility_reference_t *reference;
            sim_error_t error = {""};
            assert_int_equal(visibility_reference_make(&reference, &scene, NULL, &error), 0);
            visibility_reference_free(reference);
            scene_text_free(&scene);
            free(text);
            free(again);
        }
    }
    assert_true(near_cuts > 100 && behind > 50 && cut_scenes > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverage_of_figure_5),
        cmocka_unit_test(coverage_merges_touching_spans),
        cmocka_unit_test(coverage_steps_like_the_worked_edge),
        cmocka_unit_test(coverage_of_squares),
        cmocka_unit_test(coverage_is_even_odd),
        cmocka_unit_test(coverage_by_row_is_coverage_by_pixel),
        cmocka_unit_test(coverage_is_watertight),
        cmocka_unit_test(coverage_holds_the_largest_coordinates),
        cmocka_unit_test(visibility_of_figure_5),
        cmocka_unit_test(visibility_of_a_square),
        cmocka_unit_test(visibility_of_crossing_faces),
        cmocka_unit_test(visibility_of_coplanar_faces),
        cmocka_unit_test(visibility_in_perspective),
        cmocka_unit_test(visibility_across_the_near_plane),
        cmocka_unit_test(visibility_of_faces_edge_on),
        cmocka_unit_test(visibility_of_one_face_is_its_coverage),
        cmocka_unit_test(visibility_cuts_as_by_hand),
        cmocka_unit_test(visibility_without_doubt_is_stable),
        cmocka_unit_test(visibility_refuses_numbers_too_long),
        cmocka_unit_test(generator_keeps_its_word),
    };
    return cmocka_run_group_tests_name("reference", tests, NULL, NULL);
}
