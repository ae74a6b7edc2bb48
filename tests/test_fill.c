/* Coverage: small pictures, the sources' worked example 2, random polygons against the reference, meshes of shared edges. */
#include "support/check.h"

#include "../raster/fill/polygon.h"
#include "../raster/fill/triangle.h"
#include "reference/coverage_reference.h"
#include "support/ascii.h"
#include "support/canvas.h"
#include "support/random.h"

/* ---- pictures ---------------------------------------------------------------------------------------------------------------- */

/* The polygon from any corner, either way round, by every path, gives the picture. */
static void check_picture(const char *what, const int32_t (*points)[2], uint32_t count, const char *const *rows, int32_t height) {
    const int32_t width = (int32_t)strlen(rows[0]);
    for (uint32_t turn = 0; turn < 2 * count; turn++) {
        int32_t turned[CANVAS_CORNERS_MAX][2];
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t from = turn < count ? (i + turn) % count : (2 * count - 1 + turn - i) % count;
            memcpy(turned[i], points[from], sizeof turned[i]);
        }
        const polygon_ring_t ring = {NULL, NULL, (const q28_4_t(*)[2])turned, count};
        for (unsigned capacity = 0; capacity <= 8; capacity++) {
            polygon_chain_t chains[8];
            ascii_picture_t picture;
            ascii_clear(&picture, width, height);
            polygon_coverage(&ring, width, height, chains, capacity, ascii_span, &picture);
            assert_true(ascii_same(&picture, rows, what));
        }
        canvas_face_t face = face_of_points((const int32_t(*)[2])turned, count);
        for (int as_triangle = 0; as_triangle < (count == 3 ? 2 : 1); as_triangle++) {
            if (as_triangle && !face_to_triangle(&face)) { break; }
            for (int32_t tile = 1; tile <= width; tile += 2) {
                for (int policy = 0; policy < CANVAS_COUNT; policy++) {
                    canvas_t canvas = {.width = width, .height = height};
                    ascii_picture_t picture;
                    canvas_draw_kind(&face, &canvas, tile, tile, (canvas_policy_t)policy, (span_kind_t)((uint32_t)tile / 2 % 3));
                    ascii_clear(&picture, width, height);
                    for (int32_t at = 0; at < width * height; at++) {
                        if (canvas.ids[at]) { ascii_hit(&picture, at % width, at / width); }
                    }
                    assert_true(ascii_same(&picture, rows, what));
                }
            }
        }
    }
}

#define CHECK_PICTURE(points, ...)                                                     \
    do {                                                                               \
        static const char *const rows[] = {__VA_ARGS__};                               \
        check_picture(__func__, points, CHECK_COUNT(points), rows, CHECK_COUNT(rows)); \
    } while (0)

static void left_edge_is_in_and_right_edge_is_out(void **state) {
    static const int32_t points[][2] = {{CENTRE(1), 16}, {CENTRE(4), 16}, {CENTRE(4), 48}, {CENTRE(1), 48}};
    (void)state;
    CHECK_PICTURE(points, "......", ".###..", ".###..", "......");
}

static void top_edge_is_in_and_bottom_edge_is_out(void **state) {
    static const int32_t points[][2] = {{16, CENTRE(1)}, {64, CENTRE(1)}, {64, CENTRE(3)}, {16, CENTRE(3)}};
    (void)state;
    CHECK_PICTURE(points, "......", ".###..", ".###..", "......");
}

static void a_vertex_on_a_centre_is_in_when_it_is_leftmost_only(void **state) {
    static const int32_t points[][2] = {
        {CENTRE(2), CENTRE(0)}, {CENTRE(4), CENTRE(2)}, {CENTRE(2), CENTRE(4)}, {CENTRE(0), CENTRE(2)}};
    (void)state;
    CHECK_PICTURE(points, ".....", ".##..", "####.", ".##..", ".....");
}

static void a_diagonal_is_in_the_triangle_right_of_it(void **state) {
    static const int32_t points[][2] = {{CENTRE(0), CENTRE(0)}, {CENTRE(4), CENTRE(0)}, {CENTRE(4), CENTRE(4)}};
    (void)state;
    CHECK_PICTURE(points, "####.", ".###.", "..##.", "...#.", ".....");
}

static void a_diagonal_is_out_of_the_triangle_left_of_it(void **state) {
    static const int32_t points[][2] = {{CENTRE(0), CENTRE(0)}, {CENTRE(4), CENTRE(4)}, {CENTRE(0), CENTRE(4)}};
    (void)state;
    CHECK_PICTURE(points, ".....", "#....", "##...", "###..", ".....");
}

static void a_sliver_between_rows_of_centres_covers_nothing(void **state) {
    static const int32_t points[][2] = {{0, 9}, {96, 16}, {0, 24}};
    (void)state;
    CHECK_PICTURE(points, "......", "......", "......");
}

static void a_sliver_between_columns_of_centres_covers_nothing(void **state) {
    static const int32_t points[][2] = {{9, 0}, {24, 20}, {16, 48}};
    (void)state;
    CHECK_PICTURE(points, "......", "......", "......");
}

static void a_sliver_with_its_left_side_on_centres_is_one_pixel_wide(void **state) {
    static const int32_t points[][2] = {{CENTRE(2), 0}, {CENTRE(2) + 1, 24}, {CENTRE(2), 48}};
    (void)state;
    CHECK_PICTURE(points, "..#...", "..#...", "..#...");
}

static void a_bow_tie_is_two_triangles(void **state) {
    static const int32_t points[][2] = {{0, 0}, {64, 64}, {64, 0}, {0, 64}};
    (void)state;
    CHECK_PICTURE(points, "...#", "#.##", "#.##", "...#");
}

static void what_is_wound_round_twice_is_not_covered(void **state) {
    static const int32_t points[][2] = {{0, 0}, {64, 0}, {64, 64}, {0, 64}, {0, 0}, {64, 0}, {64, 64}, {0, 64}};
    (void)state;
    CHECK_PICTURE(points, "....", "....", "....", "....");
}

static void a_hole_is_a_ring_bridged_to_the_outer_one(void **state) {
    static const int32_t points[][2] = {{0, 0},   {96, 0},  {96, 96}, {0, 96},  {0, 0},
                                        {32, 32}, {32, 64}, {64, 64}, {64, 32}, {32, 32}};
    (void)state;
    CHECK_PICTURE(points, "######", "######", "##..##", "##..##", "######", "######");
}

static void collinear_and_repeated_vertices_change_nothing(void **state) {
    static const int32_t points[][2] = {{16, 16}, {16, 16}, {40, 16}, {41, 16}, {80, 16}, {80, 24},
                                        {80, 24}, {80, 25}, {80, 64}, {50, 64}, {16, 64}, {16, 40}};
    (void)state;
    CHECK_PICTURE(points, "......", ".####.", ".####.", ".####.", "......");
}

static void a_spike_without_width_covers_nothing(void **state) {
    static const int32_t points[][2] = {{16, 16}, {48, 16}, {90, 40}, {48, 16}, {48, 48}, {16, 48}};
    (void)state;
    CHECK_PICTURE(points, "......", ".##...", ".##...", "......");
}

static void horizontal_edges_on_centres_begin_and_end_rows(void **state) {
    static const int32_t points[][2] = {{0, CENTRE(0)},  {32, CENTRE(0)}, {32, CENTRE(2)},
                                        {64, CENTRE(2)}, {64, CENTRE(4)}, {0, CENTRE(4)}};
    (void)state;
    CHECK_PICTURE(points, "##..", "##..", "####", "####", "....");
}

static void a_reflex_corner_cuts_a_notch(void **state) {
    static const int32_t points[][2] = {{0, 0}, {CENTRE(3), CENTRE(3)}, {112, 0}, {112, 64}, {0, 64}};
    (void)state;
    CHECK_PICTURE(points, "......#", "#....##", "##..###", "#######");
}

static void what_is_outside_the_window_is_cut(void **state) {
    static const int32_t points[][2] = {{-400, -100}, {400, -100}, {400, 24}, {-400, 24}};
    (void)state;
    CHECK_PICTURE(points, "####", "....", "....");
}

static void two_triangles_with_a_common_diagonal_meet_every_pixel_once(void **state) {
    static const int32_t points[4][2] = {
        {CENTRE(0), CENTRE(0)}, {CENTRE(4), CENTRE(0)}, {CENTRE(4), CENTRE(4)}, {CENTRE(0), CENTRE(4)}};
    static const char *const rows[] = {"####.", "####.", "####.", "####.", "....."};
    (void)state;
    for (int diagonal = 0; diagonal < 2; diagonal++) {
        ascii_picture_t picture;
        ascii_clear(&picture, 5, 5);
        for (int half = 0; half < 2; half++) {
            q28_4_t triangle[3][2];
            for (int i = 0; i < 3; i++) {
                memcpy(triangle[i], points[(diagonal + 2 * half + i) % 4], sizeof triangle[i]);
            }
            const polygon_ring_t ring = {NULL, NULL, (const q28_4_t(*)[2])triangle, 3};
            polygon_chain_t chains[2];
            polygon_coverage(&ring, 5, 5, chains, 2, ascii_span, &picture);
        }
        assert_true(ascii_same(&picture, rows, __func__));
    }
}

/* ---- worked example 2 ------------------------------------------------------------------------------------------------------ */

static const int32_t example_2[21][2] = {{1, 12},  {5, 10}, {8, 10}, {10, 6}, {13, 12}, {16, 12}, {18, 14},
                                         {20, 13}, {20, 8}, {17, 8}, {21, 4}, {17, 0},  {15, 2},  {13, 2},
                                         {11, 0},  {9, 4},  {7, 2},  {5, 2},  {1, 0},   {5, 4},   {1, 8}};

/* XG and XD of each row, -1 = none. */
static const int32_t example_2_rows[14][2][3] = {
    {{1, 11, 17}, {0, 10, 16}},   {{2, 11, 16}, {2, 11, 17}},  {{3, 10, -1}, {6, 18, -1}}, {{4, 10, -1}, {7, 19, -1}},
    {{5, -1, -1}, {20, -1, -1}},  {{4, -1, -1}, {19, -1, -1}}, {{3, 10, -1}, {9, 18, -1}}, {{2, 11, -1}, {9, 17, -1}},
    {{1, 11, -1}, {8, 19, -1}},   {{1, 12, -1}, {8, 19, -1}},  {{1, 12, -1}, {4, 19, -1}}, {{1, 13, -1}, {2, 19, -1}},
    {{16, -1, -1}, {19, -1, -1}}, {{17, -1, -1}, {19, -1, -1}}};

typedef struct example_spans {
    int32_t row[64], first[64], end[64];
    unsigned count;
} example_spans_t;

static void collect(void *context, int32_t row, int32_t first, int32_t end) {
    example_spans_t *spans = context;
    assert_true(spans->count < 64);
    spans->row[spans->count] = row;
    spans->first[spans->count] = first;
    spans->end[spans->count++] = end;
}

static void worked_example_2_spans_of_all_rows(void **state) {
    q28_4_t points[21][2];
    (void)state;
    for (int i = 0; i < 21; i++) {
        points[i][0] = CENTRE(example_2[i][0]);
        points[i][1] = CENTRE(example_2[i][1]);
    }
    const polygon_ring_t ring = {NULL, NULL, (const q28_4_t(*)[2])points, 21};
    for (unsigned capacity = 0; capacity <= 8; capacity += 8) {
        polygon_chain_t chains[8];
        example_spans_t spans = {.count = 0};
        unsigned at = 0;
        polygon_coverage(&ring, 24, 20, chains, capacity, collect, &spans);
        for (int row = 0; row < 14; row++) {
            for (int k = 0; k < 3 && example_2_rows[row][0][k] >= 0; k++) {
                const int32_t left = example_2_rows[row][0][k], right = example_2_rows[row][1][k];
                if (left > right) { continue; } /* empty */
                assert_true(at < spans.count);
                assert_int_equal(spans.row[at], row);
                assert_int_equal(spans.first[at], left);
                assert_int_equal(spans.end[at], right + 1);
                at++;
            }
        }
        assert_int_equal(spans.count, at);
    }
    polygon_chain_t chains[8];
    assert_int_equal(polygon_chains(&ring, chains, 8), 8); /* the capacity above does hold them */
}

/* Runs of more chains than there is room for are told, and only those that fit are written. */
static void more_chains_than_capacity_are_counted_but_not_stored(void **state) {
    q28_4_t points[21][2];
    polygon_chain_t chains[8], untouched;
    (void)state;
    memset(chains, 0x5a, sizeof chains);
    memset(&untouched, 0x5a, sizeof untouched);
    for (int i = 0; i < 21; i++) {
        points[i][0] = CENTRE(example_2[i][0]);
        points[i][1] = CENTRE(example_2[i][1]);
    }
    const polygon_ring_t ring = {NULL, NULL, (const q28_4_t(*)[2])points, 21};
    assert_int_equal(polygon_chains(&ring, chains, 3), 8);
    assert_memory_not_equal(&chains[2], &untouched, sizeof untouched);
    for (int i = 3; i < 8; i++) {
        assert_memory_equal(&chains[i], &untouched, sizeof untouched);
    }
}

static void worked_example_2_through_the_frame_path(void **state) {
    static const char *const rows[] = {"........................", /* 0 */
                                       "..#........#....##......", /* 2-2, 11-11, 16-17 */
                                       "...####...#########.....", /* 3-6, 10-18 */
                                       "....####..##########....", /* 4-7, 10-19 */
                                       ".....################...", /* 5-20 */
                                       "....################....", /* 4-19 */
                                       "...################.....", /* 3-9, 10-18 */
                                       "..########.#######......", /* 2-9, 11-17 */
                                       ".########..#########....", /* 1-8, 11-19 */
                                       ".########...########....", /* 1-8, 12-19 */
                                       ".####.......########....", /* 1-4, 12-19 */
                                       ".##..........#######....", /* 1-2, 13-19 */
                                       "................####....", /* 16-19 */
                                       ".................###....", /* 17-19 */
                                       "........................"};
    int32_t points[21][2];
    (void)state;
    for (int i = 0; i < 21; i++) {
        points[i][0] = CENTRE(example_2[i][0]);
        points[i][1] = CENTRE(example_2[i][1]);
    }
    check_picture(__func__, (const int32_t(*)[2])points, 21, rows, CHECK_COUNT(rows));
}

/* The list of edges with their roles: a left edge gives the first pixel in, a right one the first out, row by row. */
static void worked_example_2_edges_and_roles(void **state) {
    static const struct {
        char role;
        int32_t low[2], high[2];
    } edges[16] = {{'G', {17, 0}, {15, 2}},   {'D', {11, 0}, {13, 2}},  {'G', {11, 0}, {9, 4}},   {'D', {7, 2}, {9, 4}},
                   {'D', {1, 0}, {5, 2}},     {'G', {1, 0}, {5, 4}},    {'G', {5, 4}, {1, 8}},    {'G', {1, 8}, {1, 12}},
                   {'D', {5, 10}, {1, 12}},   {'D', {10, 6}, {8, 10}},  {'G', {10, 6}, {13, 12}}, {'G', {16, 12}, {18, 14}},
                   {'D', {20, 13}, {18, 14}}, {'D', {20, 8}, {20, 13}}, {'D', {21, 4}, {17, 8}},  {'D', {17, 0}, {21, 4}}};
    int32_t found[14][2][3];
    unsigned count[14][2] = {{0}};
    (void)state;
    for (unsigned i = 0; i < 16; i++) {
        const int side = edges[i].role == 'D';
        edge_t edge;
        edge_start(&edge, CENTRE(edges[i].low[0]), CENTRE(edges[i].low[1]), CENTRE(edges[i].high[0]), CENTRE(edges[i].high[1]),
                   edges[i].low[1]);
        for (int y = edges[i].low[1]; y < edges[i].high[1]; y++, edge_step(&edge)) {
            unsigned at = count[y][side]++;
            assert_true(at < 3);
            for (; at > 0 && found[y][side][at - 1] > edge.x - side; at--) {
                found[y][side][at] = found[y][side][at - 1];
            }
            found[y][side][at] = edge.x - side;
        }
    }
    for (int y = 0; y < 14; y++) {
        for (int side = 0; side < 2; side++) {
            for (unsigned k = 0; k < 3; k++) {
                assert_int_equal(k < count[y][side], example_2_rows[y][side][k] >= 0);
                if (k < count[y][side]) { assert_int_equal(found[y][side][k], example_2_rows[y][side][k]); }
            }
        }
    }
}

/* ---- coverage against the reference ---------------------------------------------------------------------------------------------
 */

typedef struct comparison {
    const reference_spans_t *expected;
    size_t at;
    uint64_t wrong;
} comparison_t;

static void compare_span(void *context, int32_t row, int32_t first, int32_t end) {
    comparison_t *comparison = context;
    if (comparison->at >= comparison->expected->count) {
        comparison->wrong += (uint64_t)(end - first);
        return;
    }
    const reference_span_t *span = &comparison->expected->items[comparison->at++];
    comparison->wrong += span->y != row || span->x0 != first || span->x1 + 1 != end;
}

/* 2^20 polygons (2^16 under sanitizers). */
static void coverage_of_a_million_polygons_is_exact(void **state) {
    random_source_t random = random_seed(1);
    reference_spans_t expected = {0};
    uint64_t spans = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(1 << 20); round++) {
        int32_t points[24][2];
        polygon_chain_t chains[16];
        const uint32_t count = (uint32_t)random_between(&random, 3, random_one_in(&random, 4) ? 24 : 5);
        const int32_t size = random_between(&random, 1, random_one_in(&random, 16) ? 30 : 8);
        canvas_random_points(&random, points, count, size, 32767 * 16);
        assert_int_equal(coverage_reference(&expected, (const int32_t(*)[2])points, count, size, size), 0);
        const polygon_ring_t ring = {NULL, NULL, (const q28_4_t(*)[2])points, count};
        comparison_t comparison = {&expected, 0, 0};
        const unsigned capacity = random_one_in(&random, 16) ? (unsigned)random_between(&random, 0, 16) : 16;
        polygon_coverage(&ring, size, size, chains, capacity, compare_span, &comparison);
        assert_int_equal(comparison.wrong, 0);
        assert_int_equal(comparison.at, expected.count);
        spans += expected.count;
    }
    assert_true(spans > (uint64_t)CHECK_ROUNDS(1 << 20) / 2); /* it was about something */
    coverage_reference_free(&expected);
}

/* The two references agree with one another, so that a slip in one does not pass for truth. */
static void the_reference_agrees_with_point_parity(void **state) {
    random_source_t random = random_seed(2);
    reference_spans_t expected = {0};
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        int32_t points[24][2];
        const uint32_t count = (uint32_t)random_between(&random, 3, 12);
        canvas_random_points(&random, points, count, 6, 32767 * 16);
        assert_int_equal(coverage_reference(&expected, (const int32_t(*)[2])points, count, 6, 6), 0);
        bool covered[6][6] = {{false}};
        for (size_t i = 0; i < expected.count; i++) {
            for (int32_t x = expected.items[i].x0; x <= expected.items[i].x1; x++) {
                covered[expected.items[i].y][x] = true;
            }
        }
        for (int32_t y = 0; y < 6; y++) {
            for (int32_t x = 0; x < 6; x++) {
                assert_int_equal(covered[y][x], coverage_reference_pixel((const int32_t(*)[2])points, count, x, y));
            }
        }
    }
    coverage_reference_free(&expected);
}

static void check_frame_coverage(uint64_t seed, uint32_t least, uint32_t most, int rounds) {
    random_source_t random = random_seed(seed);
    reference_spans_t expected = {0};
    unsigned stateless = 0;
    for (int round = 0; round < rounds; round++) {
        int32_t points[CANVAS_CORNERS_MAX][2];
        static canvas_t canvas, whole;
        const uint32_t count = (uint32_t)random_between(&random, (int32_t)least, (int32_t)most);
        const int32_t size = random_between(&random, 1, 20);
        canvas_random_points(&random, points, count, size, 16383 - 160);
        canvas_face_t face = face_of_points((const int32_t(*)[2])points, count);
        for (uint32_t i = 0; i < count; i++) {
            face.vertices[i].depth_light = (uint32_t)random_between(&random, 512, 65529 * 256) << 8;
        }
        if (count == 3 && !face_to_triangle(&face)) { continue; }
        assert_int_equal(coverage_reference(&expected, (const int32_t(*)[2])points, count, size, size), 0);
        if (count > 3) {
            const polygon_ring_t ring = face_ring(&face);
            polygon_chain_t chains[1];
            stateless += polygon_chains(&ring, chains, 0) > POLYGON_CHAINS;
        }
        whole.width = whole.height = canvas.width = canvas.height = size;
        canvas_draw(&face, &whole, size, size, CANVAS_CARRY);
        const int32_t tile_width = random_between(&random, 1, size), tile_height = random_between(&random, 1, size);
        canvas_draw_kind(&face, &canvas, tile_width, tile_height, (canvas_policy_t)random_between(&random, 0, CANVAS_COUNT - 1),
                         (span_kind_t)(round % 3));
        /* Neither coverage nor depth depends on tiles, on how a row was reached, nor on what is drawn. */
        assert_memory_equal(canvas.ids, whole.ids, sizeof canvas.ids[0] * (size_t)(size * size));
        assert_memory_equal(canvas.depth, whole.depth, sizeof canvas.depth[0] * (size_t)(size * size));
        for (size_t i = 0; i < expected.count; i++) {
            for (int32_t x = expected.items[i].x0; x <= expected.items[i].x1; x++) {
                assert_int_equal(whole.ids[expected.items[i].y * size + x], 1);
                whole.ids[expected.items[i].y * size + x] = 0;
            }
        }
        for (int32_t i = 0; i < size * size; i++) {
            assert_int_equal(whole.ids[i], 0);
        }
    }
    if (most > 20) { assert_true(stateless > (unsigned)rounds / 100); }
    coverage_reference_free(&expected);
}

static void triangles_of_the_frame_path_cover_exactly(void **state) {
    (void)state;
    check_frame_coverage(3, 3, 3, CHECK_ROUNDS(300000));
}

static void polygons_of_the_frame_path_cover_exactly(void **state) {
    (void)state;
    check_frame_coverage(4, 4, 12, CHECK_ROUNDS(150000));
}

static void polygons_of_more_chains_than_fit_cover_exactly(void **state) {
    (void)state;
    check_frame_coverage(5, 16, CANVAS_CORNERS_MAX, CHECK_ROUNDS(1600));
}

/* ---- meshes -------------------------------------------------------------------------------------------------------------------
 */

static void count_hits(const canvas_face_t *face, uint8_t *hits, int32_t size) {
    static canvas_t canvas;
    canvas.width = canvas.height = size;
    canvas_draw(face, &canvas, size, size, CANVAS_CARRY);
    for (int32_t i = 0; i < size * size; i++) {
        hits[i] = (uint8_t)(hits[i] + (canvas.ids[i] != 0));
    }
}

static void add_span(void *context, int32_t row, int32_t first, int32_t end) {
    uint8_t *hits = context;
    for (int32_t x = first; x < end; x++) {
        hits[row * CANVAS_PX + x]++;
    }
}

static canvas_face_t face_of_triangle(const int32_t a[2], const int32_t b[2], const int32_t c[2]) {
    int32_t points[3][2];
    memcpy(points[0], a, sizeof points[0]);
    memcpy(points[1], b, sizeof points[1]);
    memcpy(points[2], c, sizeof points[2]);
    return face_of_points((const int32_t(*)[2])points, 3);
}

/* Points of a net, shifted at random by less than would fold it; its border is the canvas. */
static void every_pixel_of_a_net_is_met_once(void **state) {
    enum { NET = 9 };
    random_source_t random = random_seed(6);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(1500); round++) {
        const int32_t size = random_between(&random, 2, 24), cells = random_between(&random, 1, NET - 1);
        const bool ties = random_one_in(&random, 3);
        int32_t net[NET][NET][2];
        uint8_t hits[CANVAS_PX * CANVAS_PX] = {0};
        static uint8_t spans[CANVAS_PX * CANVAS_PX];
        memset(spans, 0, sizeof spans);
        const int32_t spacing = 16 * size / cells, slack = (spacing - 1) / 4;
        for (int32_t j = 0; j <= cells; j++) {
            for (int32_t i = 0; i <= cells; i++) {
                int32_t x = 16 * size * i / cells, y = 16 * size * j / cells;
                if (i > 0 && i < cells) { x += random_between(&random, -slack, slack); }
                if (j > 0 && j < cells) { y += random_between(&random, -slack, slack); }
                if (ties && slack > 16 && i > 0 && i < cells) { x = CENTRE((x - 8) >> 4); }
                if (ties && slack > 16 && j > 0 && j < cells) { y = CENTRE((y - 8) >> 4); }
                net[j][i][0] = x;
                net[j][i][1] = y;
            }
        }
        bool planar = true;
        for (int pass = 0; pass < 2 && planar; pass++) { /* first look, then draw */
            random_source_t diagonals = random_seed((uint64_t)round);
            for (int32_t j = 0; j < cells; j++) {
                for (int32_t i = 0; i < cells; i++) {
                    const int32_t *p[4] = {net[j][i], net[j][i + 1], net[j + 1][i + 1], net[j + 1][i]};
                    const int turn = random_between(&diagonals, 0, 1);
                    for (int half = 0; half < 2; half++) {
                        canvas_face_t face = face_of_triangle(p[turn], p[(turn + 1 + half) % 4], p[(turn + 2 + half) % 4]);
                        if (pass == 0) {
                            planar &= face_area(&face.vertices[0], &face.vertices[1], &face.vertices[2]) < 0;
                            continue;
                        }
                        const q28_4_t wide[3][2] = {{face.vertices[0].x, face.vertices[0].y},
                                                    {face.vertices[1].x, face.vertices[1].y},
                                                    {face.vertices[2].x, face.vertices[2].y}};
                        const polygon_ring_t ring = {NULL, NULL, wide, 3};
                        polygon_chain_t chains[2];
                        polygon_coverage(&ring, size, size, chains, half ? 2 : 0, add_span, spans);
                        assert_true(face_to_triangle(&face));
                        count_hits(&face, hits, size);
                    }
                }
            }
        }
        for (int32_t y = 0; planar && y < size; y++) {
            for (int32_t x = 0; x < size; x++) {
                assert_int_equal(hits[y * size + x], 1);
                assert_int_equal(spans[y * CANVAS_PX + x], 1);
            }
        }
    }
}

/* A fan over any ring: each pixel is met an odd number of times iff the ring covers it, however the fan folds. */
static void a_fan_is_odd_where_its_ring_covers(void **state) {
    random_source_t random = random_seed(7);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        enum { SIZE = 10 };
        int32_t points[16][2];
        uint8_t hits[SIZE * SIZE] = {0};
        const uint32_t count = (uint32_t)random_between(&random, 3, 16);
        canvas_random_points(&random, points, count, SIZE, 16000);
        const int32_t hub[2] = {random_one_in(&random, 2) ? CENTRE(5) : random_between(&random, -50, 200),
                                random_between(&random, -50, 200)};
        for (uint32_t i = 0; i < count; i++) {
            canvas_face_t face = face_of_triangle(hub, points[i], points[(i + 1) % count]);
            if (face_to_triangle(&face)) { count_hits(&face, hits, SIZE); }
        }
        for (int32_t i = 0; i < SIZE * SIZE; i++) {
            assert_int_equal(hits[i] & 1, coverage_reference_pixel((const int32_t(*)[2])points, count, i % SIZE, i / SIZE));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(left_edge_is_in_and_right_edge_is_out),
        cmocka_unit_test(top_edge_is_in_and_bottom_edge_is_out),
        cmocka_unit_test(a_vertex_on_a_centre_is_in_when_it_is_leftmost_only),
        cmocka_unit_test(a_diagonal_is_in_the_triangle_right_of_it),
        cmocka_unit_test(a_diagonal_is_out_of_the_triangle_left_of_it),
        cmocka_unit_test(a_sliver_between_rows_of_centres_covers_nothing),
        cmocka_unit_test(a_sliver_between_columns_of_centres_covers_nothing),
        cmocka_unit_test(a_sliver_with_its_left_side_on_centres_is_one_pixel_wide),
        cmocka_unit_test(a_bow_tie_is_two_triangles),
        cmocka_unit_test(what_is_wound_round_twice_is_not_covered),
        cmocka_unit_test(a_hole_is_a_ring_bridged_to_the_outer_one),
        cmocka_unit_test(collinear_and_repeated_vertices_change_nothing),
        cmocka_unit_test(a_spike_without_width_covers_nothing),
        cmocka_unit_test(horizontal_edges_on_centres_begin_and_end_rows),
        cmocka_unit_test(a_reflex_corner_cuts_a_notch),
        cmocka_unit_test(what_is_outside_the_window_is_cut),
        cmocka_unit_test(two_triangles_with_a_common_diagonal_meet_every_pixel_once),
        cmocka_unit_test(worked_example_2_spans_of_all_rows),
        cmocka_unit_test(more_chains_than_capacity_are_counted_but_not_stored),
        cmocka_unit_test(worked_example_2_through_the_frame_path),
        cmocka_unit_test(worked_example_2_edges_and_roles),
        cmocka_unit_test(coverage_of_a_million_polygons_is_exact),
        cmocka_unit_test(the_reference_agrees_with_point_parity),
        cmocka_unit_test(triangles_of_the_frame_path_cover_exactly),
        cmocka_unit_test(polygons_of_the_frame_path_cover_exactly),
        cmocka_unit_test(polygons_of_more_chains_than_fit_cover_exactly),
        cmocka_unit_test(every_pixel_of_a_net_is_met_once),
        cmocka_unit_test(a_fan_is_odd_where_its_ring_covers),
    };
    return cmocka_run_group_tests_name("fill", tests, NULL, NULL);
}
