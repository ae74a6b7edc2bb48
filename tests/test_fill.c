/* Filling: the edge stepper and the worked examples of the sources, coverage, depth and light, against hand and exact arithmetic.
 */
#include "support/check.h"

#include <math.h>
#include <sys/mman.h>
#include <unistd.h>

#include "../raster/fill/polygon.h"
#include "../raster/fill/triangle.h"
#include "reference/coverage_reference.h"
#include "support/ascii.h"
#include "support/random.h"

/* A whole coordinate of the sources is the centre of a pixel here. */
#define CENTRE(c) (16 * (c) + 8)

#define CANVAS_PX 48
#define CORNERS_MAX 64

/* ---- drawing through the frame's path ---------------------------------------------------------------------------------------- */

typedef struct face {
    vertex_t vertices[CORNERS_MAX];
    uint8_t corners[CORNERS_MAX]; /* corner i is vertices[corners[i]] */
    uint32_t count;
    bool as_triangle; /* three corners, counter-clockwise as seen, a topmost one first */
} face_t;

/* Part of a window: pixels left ... left + width - 1, top ... */
typedef struct canvas {
    int32_t left, top, width, height;
    uint16_t depth[CANVAS_PX * CANVAS_PX];
    uint32_t ids[CANVAS_PX * CANVAS_PX]; /* 0: not drawn */
} canvas_t;

typedef enum policy {
    POLICY_CARRY,   /* the state goes from tile row to tile row */
    POLICY_RESTART, /* set up again in every tile row */
    POLICY_SKIP,    /* set up at the top of the face and skipped to the tile row */
    POLICY_COUNT
} policy_t;

typedef union face_state {
    triangle_t triangle;
    polygon_t polygon;
} face_state_t;

static polygon_ring_t face_ring(const face_t *face) { return (polygon_ring_t){face->vertices, face->corners, NULL, face->count}; }

static const vertex_t *corner(const face_t *face, uint32_t i) { return &face->vertices[face->corners[i]]; }

static int32_t triangle_area(const vertex_t *a, const vertex_t *b, const vertex_t *c) {
    return (c->x - a->x) * (b->y - a->y) - (b->x - a->x) * (c->y - a->y);
}

/* Turns a face of three corners into what triangle_start asks for. False when it has no area. */
static bool face_to_triangle(face_t *face) {
    const int32_t area = triangle_area(corner(face, 0), corner(face, 1), corner(face, 2));
    if (area == 0) { return false; }
    if (area < 0) {
        const uint8_t swap = face->corners[1];
        face->corners[1] = face->corners[2];
        face->corners[2] = swap;
    }
    uint32_t top = 0;
    for (uint32_t i = 1; i < 3; i++) {
        top = corner(face, i)->y < corner(face, top)->y ? i : top;
    }
    const uint8_t turned[3] = {face->corners[top], face->corners[(top + 1) % 3], face->corners[(top + 2) % 3]};
    memcpy(face->corners, turned, 3);
    face->as_triangle = true;
    return true;
}

static bool face_start(const face_t *face, face_state_t *state, int32_t row, span_kind_t kind) {
    int32_t bottom = INT32_MIN, top = INT32_MAX;
    for (uint32_t i = 0; i < face->count; i++) {
        bottom = corner(face, i)->y > bottom ? corner(face, i)->y : bottom;
        top = corner(face, i)->y < top ? corner(face, i)->y : top;
    }
    if (edge_row(bottom) <= row || edge_row(bottom) <= edge_row(top)) { return false; }
    memset(state, 0xa5, sizeof *state);
    if (face->as_triangle) {
        const vertex_t *v0 = corner(face, 0), *v1 = corner(face, 1), *v2 = corner(face, 2);
        triangle_start(&state->triangle, v0, v1, v2, row, kind == SPAN_GOURAUD);
        state->triangle.value = 1;
        return true;
    }
    const polygon_ring_t ring = face_ring(face);
    const bool any = polygon_start(&state->polygon, &ring, row);
    state->polygon.value = 1;
    return any;
}

static void face_skip(const face_t *face, face_state_t *state, int32_t row) {
    const polygon_ring_t ring = face_ring(face);
    if (face->as_triangle) {
        triangle_skip(&state->triangle, row);
    } else {
        polygon_skip(&state->polygon, &ring, row);
    }
}

/* Draws one tile from the state and copies it to the canvas. Pixels beside and behind the tile must not change. */
static void face_fill_tile(const face_t *face, face_state_t *state, canvas_t *canvas, int32_t left, int32_t top, int32_t width,
                           int32_t height, span_kind_t kind) {
    static uint16_t depth[(CANVAS_PX + 2) * CANVAS_PX], colours[(CANVAS_PX + 2) * CANVAS_PX], ramp[64];
    static uint32_t ids[(CANVAS_PX + 2) * CANVAS_PX];
    if (ramp[0] == 0) {
        for (int i = 0; i < 64; i++) {
            ramp[i] = 1;
        }
    }
    const int32_t stride = width + 2;
    memset(depth, 0, sizeof depth[0] * (size_t)(stride * height));
    memset(ids, 0, sizeof ids[0] * (size_t)(stride * height));
    memset(colours, 0, sizeof colours[0] * (size_t)(stride * height));
    const raster_tile_t tile = {depth, kind == SPAN_IDS ? (void *)ids : colours, left, top, left + width, top + height, stride};
    if (face->as_triangle) {
        if (state->triangle.row >= tile.bottom || state->triangle.row >= state->triangle.head.row_end) { return; }
        triangle_fill(&state->triangle, &tile, kind, false, ramp);
    } else {
        const polygon_ring_t ring = face_ring(face);
        polygon_fill(&state->polygon, &ring, &tile, kind == SPAN_IDS ? SPAN_IDS : SPAN_FLAT, false);
    }
    for (int32_t i = 0; kind != SPAN_IDS && i < stride * height; i++) {
        ids[i] = colours[i];
    }
    for (int32_t y = 0; y < height; y++) {
        assert_int_equal(ids[y * stride + width], 0);
        assert_int_equal(ids[y * stride + width + 1], 0);
        for (int32_t x = 0; x < width; x++) {
            const int32_t at = (top - canvas->top + y) * canvas->width + left - canvas->left + x;
            canvas->ids[at] = ids[y * stride + x];
            canvas->depth[at] = depth[y * stride + x];
        }
    }
}

/* Tiles start at the canvas's corner. */
static void face_draw_kind(const face_t *face, canvas_t *canvas, int32_t tile_width, int32_t tile_height, policy_t policy,
                           span_kind_t kind) {
    face_state_t state;
    bool started = false;
    memset(canvas->ids, 0, sizeof canvas->ids[0] * (size_t)(canvas->width * canvas->height));
    memset(canvas->depth, 0, sizeof canvas->depth[0] * (size_t)(canvas->width * canvas->height));
    for (int32_t y = 0; y < canvas->height; y += tile_height) {
        const int32_t height = canvas->height - y < tile_height ? canvas->height - y : tile_height, top = canvas->top + y;
        if (policy == POLICY_RESTART || (policy == POLICY_CARRY && !started)) {
            started = face_start(face, &state, top, kind);
        } else if (policy == POLICY_SKIP) {
            started = face_start(face, &state, INT16_MIN, kind);
            if (started) { face_skip(face, &state, top); }
        }
        if (!started) { continue; }
        for (int32_t x = 0; x < canvas->width; x += tile_width) {
            const int32_t width = canvas->width - x < tile_width ? canvas->width - x : tile_width;
            face_state_t copy = state;
            face_fill_tile(face, x + width < canvas->width ? &copy : &state, canvas, canvas->left + x, top, width, height, kind);
        }
    }
}

static void face_draw(const face_t *face, canvas_t *canvas, int32_t tile_width, int32_t tile_height, policy_t policy) {
    face_draw_kind(face, canvas, tile_width, tile_height, policy, SPAN_IDS);
}

static face_t face_of_points(const int32_t (*points)[2], uint32_t count) {
    face_t face = {.count = count};
    for (uint32_t i = 0; i < count; i++) {
        face.vertices[i] = (vertex_t){(int16_t)points[i][0], (int16_t)points[i][1], 30000u << 16 | 100u};
        face.corners[i] = (uint8_t)i;
    }
    return face;
}

/* ---- pictures ---------------------------------------------------------------------------------------------------------------- */

/* The polygon from any corner, either way round, by every path, gives the picture. */
static void check_picture(const char *what, const int32_t (*points)[2], uint32_t count, const char *const *rows, int32_t height) {
    const int32_t width = (int32_t)strlen(rows[0]);
    for (uint32_t turn = 0; turn < 2 * count; turn++) {
        int32_t turned[CORNERS_MAX][2];
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
        face_t face = face_of_points((const int32_t(*)[2])turned, count);
        for (int as_triangle = 0; as_triangle < (count == 3 ? 2 : 1); as_triangle++) {
            if (as_triangle && !face_to_triangle(&face)) { break; }
            for (int32_t tile = 1; tile <= width; tile += 2) {
                for (int policy = 0; policy < POLICY_COUNT; policy++) {
                    canvas_t canvas = {.width = width, .height = height};
                    ascii_picture_t picture;
                    face_draw_kind(&face, &canvas, tile, tile, (policy_t)policy, (span_kind_t)((uint32_t)tile / 2 % 3));
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

/* ---- the worked examples ------------------------------------------------------------------------------------------------------
 */

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

/* ---- the stepper against exact integers -----------------------------------------------------------------------------------------
 */

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

/* ---- coverage against the reference ---------------------------------------------------------------------------------------------
 */

enum { KIND_TINY, KIND_LOCAL, KIND_TIES, KIND_HUGE, KIND_SLIVER, KIND_DEGENERATE, KIND_OFF, KIND_WALK, KIND_COMB, KIND_COUNT };

/* Points of some kind in and round a window of `size` pixels, within +-limit. */
static void random_points(random_source_t *random, int32_t (*points)[2], uint32_t count, int32_t size, int32_t limit) {
    const int kind = random_between(random, 0, KIND_COUNT - 1);
    const int32_t cx = random_between(random, -16, 16 * size + 16), cy = random_between(random, -16, 16 * size + 16);
    const int32_t sx = random_between(random, -limit, limit), sy = random_between(random, -limit, limit);
    for (uint32_t i = 0; i < count; i++) {
        int32_t x = random_between(random, -64, 16 * size + 64), y = random_between(random, -64, 16 * size + 64);
        switch (kind) {
        case KIND_TINY: x = cx + random_between(random, -20, 20), y = cy + random_between(random, -20, 20); break;
        case KIND_TIES: x = CENTRE(random_between(random, -1, size)), y = CENTRE(random_between(random, -1, size)); break;
        case KIND_HUGE: x = random_between(random, -limit, limit), y = random_between(random, -limit, limit); break;
        case KIND_SLIVER: { /* along a line */
            const int32_t t = random_between(random, -1000, 1000);
            x = cx + (int32_t)((int64_t)sx * t / 1000) + random_between(random, -1, 1);
            y = cy + (int32_t)((int64_t)sy * t / 1000) + random_between(random, -1, 1);
            break;
        }
        case KIND_DEGENERATE: /* all alike, or on one row or column, now and then something else */
            if (!random_one_in(random, 4)) { x = cx; }
            if (!random_one_in(random, 3)) { y = cy; }
            break;
        case KIND_OFF: x += random_one_in(random, 2) ? limit / 2 : 0; break;
        case KIND_WALK:
            x = (i ? points[i - 1][0] : cx) + random_between(random, -40, 40);
            y = (i ? points[i - 1][1] : cy) + random_between(random, -40, 40);
            break;
        case KIND_COMB: y = i % 2 ? random_between(random, -20, 8 * size) : random_between(random, 8 * size, 16 * size + 20); break;
        default: break;
        }
        points[i][0] = x < -limit ? -limit : x > limit ? limit : x;
        points[i][1] = y < -limit ? -limit : y > limit ? limit : y;
    }
}

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
        random_points(&random, points, count, size, 32767 * 16);
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
        random_points(&random, points, count, 6, 32767 * 16);
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
        int32_t points[CORNERS_MAX][2];
        static canvas_t canvas, whole;
        const uint32_t count = (uint32_t)random_between(&random, (int32_t)least, (int32_t)most);
        const int32_t size = random_between(&random, 1, 20);
        random_points(&random, points, count, size, 16383 - 160);
        face_t face = face_of_points((const int32_t(*)[2])points, count);
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
        face_draw(&face, &whole, size, size, POLICY_CARRY);
        const int32_t tile_width = random_between(&random, 1, size), tile_height = random_between(&random, 1, size);
        face_draw_kind(&face, &canvas, tile_width, tile_height, (policy_t)random_between(&random, 0, POLICY_COUNT - 1),
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
    check_frame_coverage(5, 16, CORNERS_MAX, CHECK_ROUNDS(1600));
}

/* ---- meshes -------------------------------------------------------------------------------------------------------------------
 */

static void count_hits(const face_t *face, uint8_t *hits, int32_t size) {
    static canvas_t canvas;
    canvas.width = canvas.height = size;
    face_draw(face, &canvas, size, size, POLICY_CARRY);
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

static face_t face_of_triangle(const int32_t a[2], const int32_t b[2], const int32_t c[2]) {
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
                        face_t face = face_of_triangle(p[turn], p[(turn + 1 + half) % 4], p[(turn + 2 + half) % 4]);
                        if (pass == 0) {
                            planar &= triangle_area(&face.vertices[0], &face.vertices[1], &face.vertices[2]) < 0;
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
        random_points(&random, points, count, SIZE, 16000);
        const int32_t hub[2] = {random_one_in(&random, 2) ? CENTRE(5) : random_between(&random, -50, 200),
                                random_between(&random, -50, 200)};
        for (uint32_t i = 0; i < count; i++) {
            face_t face = face_of_triangle(hub, points[i], points[(i + 1) % count]);
            if (face_to_triangle(&face)) { count_hits(&face, hits, SIZE); }
        }
        for (int32_t i = 0; i < SIZE * SIZE; i++) {
            assert_int_equal(hits[i] & 1, coverage_reference_pixel((const int32_t(*)[2])points, count, i % SIZE, i / SIZE));
        }
    }
}

/* ---- depth and light ------------------------------------------------------------------------------------------------------------
 */

/* 64 colours between pages that must not be touched: colour i is i. */
static const uint16_t *guarded_ramp(void) {
    static uint16_t *ramp;
    if (ramp == NULL) {
        const size_t page = (size_t)sysconf(_SC_PAGESIZE), span = 128 * 1024 / page * page + page;
        uint8_t *memory = mmap(NULL, 2 * span + page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        assert_true(memory != MAP_FAILED);
        assert_int_equal(mprotect(memory + span, page, PROT_READ | PROT_WRITE), 0);
        ramp = (uint16_t *)(void *)(memory + span + page - 128);
        for (int i = 0; i < 64; i++) {
            ramp[i] = (uint16_t)i;
        }
    }
    return ramp;
}

/* value at the centre of pixel (x, y) on the plane through three points, as a fraction over the area. */
static int128_t plane_numerator(const vertex_t v[3], const int32_t value[3], int32_t x, int32_t y, int64_t *denominator) {
    const int64_t x1 = v[1].x - v[0].x, y1 = v[1].y - v[0].y, x2 = v[2].x - v[0].x, y2 = v[2].y - v[0].y;
    const int64_t d1 = (int64_t)value[1] - value[0], d2 = (int64_t)value[2] - value[0];
    const int64_t px = 16 * x + 8 - v[0].x, py = 16 * y + 8 - v[0].y;
    *denominator = x1 * y2 - x2 * y1;
    return (int128_t)value[0] * *denominator + (int128_t)(d1 * y2 - d2 * y1) * px + (int128_t)(x1 * d2 - x2 * d1) * py;
}

typedef struct depth_errors {
    double depth_small, depth_large, light;
    uint64_t pixels, small_pixels;
} depth_errors_t;

/* One triangle, seen through a tile of a window; errors are noted in steps of depth and in light levels beyond what the ramp
 * rounds. */
static void measure_triangle(const vertex_t v[3], int32_t left, int32_t top, int32_t width, int32_t height,
                             depth_errors_t *errors) {
    static uint16_t depth[CANVAS_PX * CANVAS_PX], colour[CANVAS_PX * CANVAS_PX];
    face_t face = {.count = 3};
    for (int i = 0; i < 3; i++) {
        face.vertices[i] = v[i];
        face.corners[i] = (uint8_t)i;
    }
    if (!face_to_triangle(&face)) { return; }
    const vertex_t t[3] = {*corner(&face, 0), *corner(&face, 1), *corner(&face, 2)};
    const int32_t low = t[1].y > t[2].y ? t[1].y : t[2].y;
    if (edge_row(low) <= top || edge_row(t[0].y) >= edge_row(low)) { return; }
    memset(depth, 0, sizeof depth);
    memset(colour, 0xff, sizeof colour);
    triangle_t state;
    triangle_start(&state, &t[0], &t[1], &t[2], top, true);
    const raster_tile_t tile = {depth, colour, left, top, left + width, top + height, width};
    if (state.row >= tile.bottom) { return; }
    triangle_fill(&state, &tile, SPAN_GOURAUD, false, guarded_ramp());

    int32_t z[3], l[3], spread = 0, least = 0, most = 0;
    for (int i = 0; i < 3; i++) {
        z[i] = (int32_t)(t[i].depth_light >> 8);
        l[i] = (int32_t)(t[i].depth_light & 0xff);
        spread = abs(z[i] - z[0]) > spread ? abs(z[i] - z[0]) : spread;
        least = t[i].x - t[0].x < least ? t[i].x - t[0].x : least;
        most = t[i].x - t[0].x > most ? t[i].x - t[0].x : most;
    }
    const bool small = most - least < 512 && low - t[0].y < 512 && spread < 1 << 17;
    for (int32_t y = 0; y < height; y++) {
        for (int32_t x = 0; x < width; x++) {
            const int32_t at = y * width + x;
            if (colour[at] == 0xffff) { continue; }
            int64_t denominator;
            int128_t numerator = plane_numerator(t, z, left + x, top + y, &denominator);
            const double error = fabs(
                (double)((long double)((int128_t)depth[at] * 256 * denominator - numerator) / (256.0L * (long double)denominator)));
            double *worst = small ? &errors->depth_small : &errors->depth_large;
            *worst = error > *worst ? error : *worst;
            /* colour = floor((light + 1/2 + e) / 4): by how much does e leave the range that gives this colour? */
            numerator = plane_numerator(t, l, left + x, top + y, &denominator);
            const double light = (double)((long double)numerator / (long double)denominator) + 0.5;
            const double under = 4.0 * colour[at] - light, over = light - (4.0 * colour[at] + 4.0);
            errors->light = under > errors->light ? under : over > errors->light ? over : errors->light;
            assert_true(colour[at] < 64);
            errors->pixels++;
            errors->small_pixels += small;
        }
    }
}

static uint32_t random_depth_light(random_source_t *random, int32_t low, int32_t high) {
    const uint32_t depth =
        (uint32_t)(random_one_in(random, 4) ? (random_one_in(random, 2) ? low : high) : random_between(random, low, high));
    const uint32_t light =
        (uint32_t)(random_one_in(random, 4) ? (random_one_in(random, 2) ? 2 : 253) : random_between(random, 2, 253));
    return depth << 8 | light;
}

/* The bounds that stand at the top of triangle.c. */
static void depth_and_light_of_triangles_stay_near_their_planes(void **state) {
    random_source_t random = random_seed(8);
    depth_errors_t errors = {0, 0, 0, 0, 0};
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(400000); round++) {
        static const int32_t sizes[] = {24, 320, 1024};
        const int32_t window = sizes[round % 3], guard = (window * 16 - GUARD_SPAN) / 2;
        const int32_t width = 24, height = 16;
        const int32_t left = random_between(&random, 0, window - width), top = random_between(&random, 0, window - height);
        vertex_t v[3];
        const int shape = random_between(&random, 0, 4);
        int32_t low = 512, high = 65529 * 256;
        if (random_one_in(&random, 2)) {
            low = random_between(&random, 512, 65529 * 256 - (1 << 17) + 1);
            high = low + (1 << 17) - 1;
        }
        const int32_t cx = 16 * left + random_between(&random, 0, 16 * width),
                      cy = 16 * top + random_between(&random, 0, 16 * height);
        const int32_t far_x = random_between(&random, guard, guard + GUARD_SPAN - 1),
                      far_y = random_between(&random, guard, guard + GUARD_SPAN - 1);
        for (int i = 0; i < 3; i++) {
            int32_t x = random_between(&random, guard, guard + GUARD_SPAN - 1),
                    y = random_between(&random, guard, guard + GUARD_SPAN - 1);
            switch (shape) {
            case 0: x = cx + random_between(&random, -255, 255), y = cy + random_between(&random, -255, 255); break;
            case 1: x = cx + random_between(&random, -20, 20), y = cy + random_between(&random, -255, 255); break;
            case 2: x = cx + random_between(&random, -255, 255), y = cy + random_between(&random, -20, 20); break;
            case 3: /* a sliver through the tile */
                x = (i == 0 ? cx : i == 1 ? far_x : cx - (far_x - cx) / 8) + random_between(&random, -1, 1);
                y = (i == 0 ? cy : i == 1 ? far_y : cy - (far_y - cy) / 8) + random_between(&random, -1, 1);
                break;
            default: break;
            }
            x = x < guard ? guard : x > guard + GUARD_SPAN - 1 ? guard + GUARD_SPAN - 1 : x;
            y = y < guard ? guard : y > guard + GUARD_SPAN - 1 ? guard + GUARD_SPAN - 1 : y;
            v[i] = (vertex_t){(int16_t)x, (int16_t)y, random_depth_light(&random, low, high)};
        }
        measure_triangle(v, left, top, width, height, &errors);
    }
    print_message("depth error: %.6f step small, %.6f large; light: %.6f level beyond the ramp's; %llu pixels, %llu small\n",
                  errors.depth_small, errors.depth_large, errors.light, (unsigned long long)errors.pixels,
                  (unsigned long long)errors.small_pixels);
    assert_true(errors.small_pixels > 10000 && errors.pixels - errors.small_pixels > 10000);
    assert_true(errors.depth_small <= 0.5 + 0.25 + 0x1p-15);
    assert_true(errors.depth_large <= 0.5 + 0.0625 + 0x1p-15);
    assert_true(errors.light <= 0.125 + 0x1p-9);
}

/* Small triangles of the least areas and the steepest gradients: where the reciprocal is worst. */
static void depth_of_the_thinnest_small_triangles(void **state) {
    depth_errors_t errors = {0, 0, 0, 0, 0};
    random_source_t random = random_seed(9);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(200000); round++) {
        const int32_t steep = (1 << 17) - 1, base = random_between(&random, 512, 65529 * 256 - steep);
        const int32_t x = random_between(&random, 0, 15), y = random_between(&random, 0, 15);
        const int32_t length = random_between(&random, 300, 511), wide = random_between(&random, 0, 511);
        vertex_t v[3];
        for (int i = 0; i < 3; i++) {
            const int32_t t = i == 0 ? 0 : i == 1 ? length : random_between(&random, 0, length);
            const bool across = round % 2;
            const int32_t other = t * wide / length + random_between(&random, 0, 1);
            v[i] = (vertex_t){(int16_t)(x + (across ? t : other)), (int16_t)(y + (across ? other : t)),
                              (uint32_t)(base + (random_one_in(&random, 2) ? steep : 0)) << 8 |
                                  (random_one_in(&random, 2) ? 2u : 253u)};
        }
        measure_triangle(v, 0, 0, 34, 34, &errors);
    }
    print_message("thin: depth error %.6f step, light %.6f level, %llu pixels\n", errors.depth_small, errors.light,
                  (unsigned long long)errors.small_pixels);
    assert_true(errors.small_pixels > 1000);
    assert_true(errors.depth_small <= 0.5 + 0.25 + 0x1p-15);
    assert_true(errors.light <= 0.125 + 0x1p-9);
}

/* Gouraud light does not depend on where the fill began, on columns, nor on skipping. */
static void light_does_not_depend_on_the_way_to_a_row(void **state) {
    random_source_t random = random_seed(10);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(40000); round++) {
        enum { SIZE = 16 };
        uint16_t depth[2][SIZE * SIZE] = {{0}}, colour[2][SIZE * SIZE] = {{0}};
        int32_t points[3][2];
        random_points(&random, points, 3, SIZE, 16000);
        face_t face = face_of_points((const int32_t(*)[2])points, 3);
        for (int i = 0; i < 3; i++) {
            face.vertices[i].depth_light = random_depth_light(&random, 512, 65529 * 256);
        }
        if (!face_to_triangle(&face)) { continue; }
        const vertex_t *v0 = corner(&face, 0), *v1 = corner(&face, 1), *v2 = corner(&face, 2);
        const int32_t end = edge_row(v1->y > v2->y ? v1->y : v2->y);
        const int32_t begin = edge_row(v0->y), split = random_between(&random, 0, SIZE - 1),
                      column = random_between(&random, 1, SIZE - 1);
        if (end <= 0 || begin >= end || begin >= SIZE) { continue; }
        triangle_t whole, part;
        const raster_tile_t tile = {depth[0], colour[0], 0, 0, SIZE, SIZE, SIZE};
        triangle_start(&whole, v0, v1, v2, 0, true);
        if (whole.row < SIZE) { triangle_fill(&whole, &tile, SPAN_GOURAUD, false, guarded_ramp()); }
        for (int lower = 0; lower < 2; lower++) {
            const int32_t top = lower ? split : 0, bottom = lower ? SIZE : split;
            if (top >= bottom || end <= top) { continue; }
            for (int right = 0; right < 2; right++) {
                const int32_t x0 = right ? column : 0, x1 = right ? SIZE : column;
                if (lower && random_one_in(&random, 2)) {
                    triangle_start(&part, v0, v1, v2, top, true);
                } else {
                    triangle_start(&part, v0, v1, v2, INT16_MIN, true);
                    triangle_skip(&part, top);
                }
                const raster_tile_t quarter = {depth[1] + top * SIZE + x0, colour[1] + top * SIZE + x0, x0, top, x1, bottom, SIZE};
                if (part.row >= bottom) { continue; }
                triangle_fill(&part, &quarter, SPAN_GOURAUD, false, guarded_ramp());
            }
        }
        assert_memory_equal(depth[0], depth[1], sizeof depth[0]);
        assert_memory_equal(colour[0], colour[1], sizeof colour[0]);
    }
}

static void the_nearer_face_wins_and_ties_go_as_asked(void **state) {
    (void)state;
    for (int last = 0; last < 2; last++) {
        for (int polygon = 0; polygon < 2; polygon++) {
            uint16_t depth[16] = {0};
            uint32_t ids[16] = {0};
            const raster_tile_t tile = {depth, ids, 0, 0, 4, 4, 4};
            static const uint32_t depths[4] = {1000, 1000, 999, 1001}, seen[2][4] = {{1, 1, 1, 4}, {1, 2, 2, 4}};
            for (uint32_t f = 0; f < 4; f++) {
                const uint32_t z = depths[f] << 16;
                const vertex_t v[4] = {{0, 0, z}, {0, 64, z}, {64, 64, z}, {64, 0, z}};
                if (polygon) {
                    polygon_t p;
                    const polygon_ring_t ring = {v, NULL, NULL, 4};
                    assert_true(polygon_start(&p, &ring, 0));
                    p.value = f + 1;
                    polygon_fill(&p, &ring, &tile, SPAN_IDS, last);
                } else {
                    for (int half = 0; half < 2; half++) {
                        triangle_t t;
                        const vertex_t *v1 = half ? &v[2] : &v[1], *v2 = half ? &v[3] : &v[2];
                        triangle_start(&t, &v[0], v1, v2, 0, false);
                        t.value = f + 1;
                        triangle_fill(&t, &tile, SPAN_IDS, last, NULL);
                    }
                }
                for (int i = 0; i < 16; i++) {
                    assert_int_equal(ids[i], seen[last][f]);
                }
            }
        }
    }
}

static void depth_of_polygons_stays_near_their_plane(void **state) {
    random_source_t random = random_seed(12);
    double worst = 0;
    uint64_t pixels = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(100000); round++) {
        enum { SIZE = 16 };
        static canvas_t canvas;
        int32_t points[12][2];
        const uint32_t count = (uint32_t)random_between(&random, 4, 12);
        random_points(&random, points, count, SIZE, 16000);
        face_t face = face_of_points((const int32_t(*)[2])points, count);
        const int32_t steep = random_one_in(&random, 2) ? 200 : 20000;
        const int64_t gx = random_between(&random, -steep, steep), gy = random_between(&random, -steep, steep);
        int64_t low = INT64_MAX, high = INT64_MIN;
        for (uint32_t i = 0; i < count; i++) {
            const int64_t z = gx * points[i][0] + gy * points[i][1];
            low = z < low ? z : low;
            high = z > high ? z : high;
        }
        if (high - low > 65529 * 256 - 512) { continue; }
        const int64_t base = random_between(&random, 512, (int32_t)(65529 * 256 - (high - low))) - low;
        for (uint32_t i = 0; i < count; i++) {
            face.vertices[i].depth_light = (uint32_t)(base + gx * points[i][0] + gy * points[i][1]) << 8;
        }
        canvas.width = canvas.height = SIZE;
        face_draw(&face, &canvas, SIZE, SIZE, POLICY_CARRY);
        for (int32_t i = 0; i < SIZE * SIZE; i++) {
            if (!canvas.ids[i]) { continue; }
            const double exact = (double)(base + gx * CENTRE(i % SIZE) + gy * CENTRE(i / SIZE)) / 256;
            const double error = fabs(canvas.depth[i] - exact);
            worst = error > worst ? error : worst;
            pixels++;
        }
    }
    print_message("planar polygons: depth error %.6f step, %llu pixels\n", worst, (unsigned long long)pixels);
    assert_true(pixels > 10000);
    assert_true(worst <= 0.5 + 0.0625 + 0x1p-15);
}

/* Corners that do not lie in one plane: depth is within the range of the face, whatever the plane does. */
static void depth_of_uneven_polygons_stays_in_their_range(void **state) {
    random_source_t random = random_seed(13);
    uint64_t pixels = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        enum { SIZE = 16 };
        static canvas_t canvas;
        int32_t points[24][2];
        const uint32_t count = (uint32_t)random_between(&random, 4, 24);
        random_points(&random, points, count, SIZE, 16000);
        face_t face = face_of_points((const int32_t(*)[2])points, count);
        uint32_t low = UINT32_MAX, high = 0;
        const int32_t from = random_between(&random, 512, 65529 * 256), to = random_between(&random, from, 65529 * 256);
        for (uint32_t i = 0; i < count; i++) {
            face.vertices[i].depth_light = random_depth_light(&random, from, to);
            const uint32_t depth = ((face.vertices[i].depth_light >> 8) + 128) >> 8; /* to the nearest step */
            low = depth < low ? depth : low;
            high = depth > high ? depth : high;
        }
        canvas.width = canvas.height = SIZE;
        face_draw(&face, &canvas, SIZE, SIZE, (policy_t)(round % POLICY_COUNT));
        for (int32_t i = 0; i < SIZE * SIZE; i++) {
            if (!canvas.ids[i]) { continue; }
            assert_true(canvas.depth[i] >= low && canvas.depth[i] <= high);
            pixels++;
        }
    }
    assert_true(pixels > 1000);
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
        cmocka_unit_test(worked_example_1_row_by_row),
        cmocka_unit_test(worked_example_2_spans_of_all_rows),
        cmocka_unit_test(more_chains_than_capacity_are_counted_but_not_stored),
        cmocka_unit_test(worked_example_2_through_the_frame_path),
        cmocka_unit_test(worked_example_2_edges_and_roles),
        cmocka_unit_test(stepper_is_exact_on_all_short_sides),
        cmocka_unit_test(short_stepper_is_exact_to_its_bounds),
        cmocka_unit_test(stepper_is_exact_on_long_sides),
        cmocka_unit_test(coverage_of_a_million_polygons_is_exact),
        cmocka_unit_test(the_reference_agrees_with_point_parity),
        cmocka_unit_test(triangles_of_the_frame_path_cover_exactly),
        cmocka_unit_test(polygons_of_the_frame_path_cover_exactly),
        cmocka_unit_test(polygons_of_more_chains_than_fit_cover_exactly),
        cmocka_unit_test(every_pixel_of_a_net_is_met_once),
        cmocka_unit_test(a_fan_is_odd_where_its_ring_covers),
        cmocka_unit_test(depth_and_light_of_triangles_stay_near_their_planes),
        cmocka_unit_test(depth_of_the_thinnest_small_triangles),
        cmocka_unit_test(light_does_not_depend_on_the_way_to_a_row),
        cmocka_unit_test(the_nearer_face_wins_and_ties_go_as_asked),
        cmocka_unit_test(depth_of_polygons_stays_near_their_plane),
        cmocka_unit_test(depth_of_uneven_polygons_stays_in_their_range),
    };
    return cmocka_run_group_tests_name("fill", tests, NULL, NULL);
}
