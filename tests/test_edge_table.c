/* Triangles by Bresenham edges: the document's policy against its own listing, the others against their definitions in rational
 * numbers, neighbours without gaps but for the inner pixel, and tiles. */
#include "support/check.h"

#include "../raster/draw/edge_table.h"
#include "support/random.h"

enum { POLICIES = 6 };
static const char *const policy_names[POLICIES] = {"document", "ends", "upwards", "outer", "mid", "inner"};

typedef struct span {
    int32_t first, last;
} span_t;

/* ---- the listing of document 003, S17, its spans collected ----------------------------------------------------------- */

enum { ROWS = 64, ORIGIN = 16 }; /* rows -16 ... 47 */

static void cote(int xi, int yi, int xf, int yf, int *px, bool ends) {
    int x = xi;
    int y = yi;
    int dx = xf - xi;
    int dy = yf - yi;
    int xinc = (dx > 0) ? 1 : -1;
    int yinc = (dy > 0) ? 1 : -1;
    dx = abs(dx);
    dy = abs(dy);
    px[y] = x;
    if (dx > dy) {
        int cumul = dx >> 1;
        for (int i = 1; i <= dx; i++) {
            x += xinc;
            cumul += dy;
            if (cumul >= dx) {
                cumul -= dx;
                y += yinc;
            }
            px[y] = x;
        }
    } else {
        int cumul = dy >> 1;
        for (int i = 1; i <= dy; i++) {
            y += yinc;
            cumul += dx;
            if (cumul >= dy) {
                cumul -= dy;
                x += xinc;
            }
            px[y] = x;
        }
    }
    if (ends) { px[yi] = xi, px[yf] = xf; }
}

static void triangle(int x1, int y1, int x2, int y2, int x3, int y3, span_t *spans, bool ends) {
    int right[ROWS], left[ROWS];
    int *xd = right + ORIGIN, *xg = left + ORIGIN;
    if ((x2 - x1) * (y3 - y1) - (x3 - x1) * (y2 - y1) > 0) {
        cote(x1, y1, x2, y2, xd, ends);
        cote(x2, y2, x3, y3, xd, ends);
        cote(x1, y1, x3, y3, xg, ends);
    } else {
        cote(x1, y1, x2, y2, xg, ends);
        cote(x2, y2, x3, y3, xg, ends);
        cote(x1, y1, x3, y3, xd, ends);
    }
    for (int y = y1; y <= y3; y++) {
        spans[y - y1] = (span_t){xg[y], xd[y]};
    }
}

/* Sorted by y, the first given first. */
static void sorted(const int32_t corners[3][2], int32_t out[3][2]) {
    memcpy(out, corners, 6 * sizeof(int32_t));
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < 2; i++) {
            if (out[i][1] > out[i + 1][1]) {
                for (int k = 0; k < 2; k++) {
                    const int32_t swap = out[i][k];
                    out[i][k] = out[i + 1][k];
                    out[i + 1][k] = swap;
                }
            }
        }
    }
}

/* ---- the definitions in edge_table.h, by rational numbers --------------------------------------------------------------- */

/* The row (or, for a steep side, the column) of step i, counted from the first end: i * minor / major, halves up. */
static int64_t rounded(int64_t i, int64_t minor, int64_t major) {
    return major ? (int64_t)(((int128_t)2 * i * minor + major) / ((int128_t)2 * major)) : 0;
}

/* The pixels of a side on a row, in the order in which they are walked. */
static span_t run_of(const int32_t from[2], const int32_t to[2], int32_t row) {
    const int64_t dx = (int64_t)to[0] - from[0], width = llabs(dx), height = (int64_t)to[1] - from[1];
    const int32_t sign = dx < 0 ? -1 : 1;
    if (width <= height) {
        const int32_t x = from[0] + sign * (int32_t)rounded(row - (int64_t)from[1], width, height);
        return (span_t){x, x};
    }
    int64_t ends[2];
    for (int e = 0; e < 2; e++) { /* the first step on this row, the first one beyond it */
        int64_t low = 0, high = width + 1;
        while (low < high) {
            const int64_t i = (low + high) / 2;
            if (rounded(i, height, width) >= (int64_t)row + e - from[1]) {
                high = i;
            } else {
                low = i + 1;
            }
        }
        ends[e] = low - e;
    }
    return (span_t){from[0] + sign * (int32_t)ends[0], from[0] + sign * (int32_t)ends[1]};
}

static int32_t low_of(span_t s) { return s.first < s.last ? s.first : s.last; }
static int32_t high_of(span_t s) { return s.first < s.last ? s.last : s.first; }

static int32_t pick(const int32_t from[2], const int32_t to[2], int32_t row, edge_policy_t policy, bool left) {
    const span_t run = run_of(from, to, row);
    switch (policy) {
    case EDGE_ENDS: return row == from[1] ? from[0] : row == to[1] ? to[0] : run.last;
    case EDGE_OUTER: return left ? low_of(run) : high_of(run);
    case EDGE_INNER: return left ? high_of(run) : low_of(run);
    case EDGE_MID: return low_of(run) + (high_of(run) - low_of(run)) / 2;
    case EDGE_DOCUMENT:
    case EDGE_UPWARDS:
    default: return run.last;
    }
}

/* Not for EDGE_DOCUMENT. p: sorted. */
static span_t expected_span(const int32_t p[3][2], int32_t row, edge_policy_t policy) {
    if (p[0][1] == p[2][1]) {
        const span_t a = {p[0][0], p[1][0]}, b = {p[2][0], p[2][0]};
        return (span_t){low_of(a) < b.first ? low_of(a) : b.first, high_of(a) > b.first ? high_of(a) : b.first};
    }
    const int128_t cross = (int128_t)((int64_t)p[1][0] - p[0][0]) * ((int64_t)p[2][1] - p[0][1]) -
                           (int128_t)((int64_t)p[2][0] - p[0][0]) * ((int64_t)p[1][1] - p[0][1]);
    const bool left = cross <= 0;
    const int32_t straight = pick(p[0], p[2], row, policy, !left);
    int32_t bent = 0;
    bool known = false;
    for (int side = 0; side < 2; side++) {
        if (p[side][1] == p[side + 1][1] || row < p[side][1] || row > p[side + 1][1]) { continue; }
        const int32_t x = pick(p[side], p[side + 1], row, policy, left);
        if (!known || policy == EDGE_ENDS || policy == EDGE_UPWARDS || policy == EDGE_MID || /* the later one */
            (policy == EDGE_OUTER) == (left ? x < bent : x > bent)) {
            bent = x;
        }
        known = true;
    }
    assert_true(known);
    span_t span = left ? (span_t){bent, straight} : (span_t){straight, bent};
    if (span.first > span.last && policy != EDGE_INNER) { span = (span_t){span.last, span.first}; }
    return span;
}

static bool same_span(span_t a, span_t b) {
    return (a.first > a.last && b.first > b.last) || (a.first == b.first && a.last == b.last);
}

/* ---- all small triangles -------------------------------------------------------------------------------------------- */

enum { BOX = 6 }; /* corners 0 ... 5 across, doubled so that sides are flat */

static void each_triangle(void (*check)(const int32_t corners[3][2])) {
    for (int32_t n = 0; n < BOX * BOX * BOX * BOX * BOX * BOX; n++) {
        int32_t corners[3][2];
        int32_t digits = n;
        for (int c = 0; c < 3; c++) {
            corners[c][0] = digits % BOX * 3 - 4;
            digits /= BOX;
            corners[c][1] = digits % BOX - 2;
            digits /= BOX;
        }
        if (CHECK_SANITIZED && n % 16) { continue; }
        check((const int32_t(*)[2])corners);
    }
}

static void compare_with_listing(const int32_t corners[3][2]) {
    int32_t p[3][2];
    span_t spans[ROWS];
    sorted(corners, p);
    triangle(p[0][0], p[0][1], p[1][0], p[1][1], p[2][0], p[2][1], spans, false);
    edge_table_t table;
    assert_true(edge_table_start(&table, corners, EDGE_DOCUMENT, -100));
    assert_int_equal(table.row, p[0][1]);
    assert_int_equal(table.last_row, p[2][1]);
    for (int32_t y = p[0][1]; y <= p[2][1]; y++) {
        span_t got;
        edge_table_next(&table, &got.first, &got.last);
        assert_int_equal(got.first, spans[y - p[0][1]].first);
        assert_int_equal(got.last, spans[y - p[0][1]].last);
    }
    if (p[0][1] == p[1][1] || p[1][1] == p[2][1]) { return; }
    /* The document's remedy as it words it, where no side lies in one row. */
    triangle(p[0][0], p[0][1], p[1][0], p[1][1], p[2][0], p[2][1], spans, true);
    assert_true(edge_table_start(&table, corners, EDGE_ENDS, -100));
    for (int32_t y = p[0][1]; y <= p[2][1]; y++) {
        span_t got;
        edge_table_next(&table, &got.first, &got.last);
        assert_int_equal(got.first, low_of(spans[y - p[0][1]]));
        assert_int_equal(got.last, high_of(spans[y - p[0][1]]));
    }
}

static void document_is_the_listing(void **state) {
    (void)state;
    each_triangle(compare_with_listing);
}

static void compare_with_definition(const int32_t corners[3][2]) {
    int32_t p[3][2];
    sorted(corners, p);
    for (int policy = EDGE_ENDS; policy < POLICIES; policy++) {
        edge_table_t table;
        assert_true(edge_table_start(&table, corners, (edge_policy_t)policy, -100));
        for (int32_t y = p[0][1]; y <= p[2][1]; y++) {
            span_t got;
            const span_t expected = expected_span((const int32_t(*)[2])p, y, (edge_policy_t)policy);
            edge_table_next(&table, &got.first, &got.last);
            if (!same_span(got, expected)) {
                fail_msg("%s, %d,%d %d,%d %d,%d, row %d: %d ... %d, expected %d ... %d", policy_names[policy], p[0][0], p[0][1],
                         p[1][0], p[1][1], p[2][0], p[2][1], y, got.first, got.last, expected.first, expected.last);
            }
        }
    }
}

static void each_policy_is_its_definition(void **state) {
    (void)state;
    each_triangle(compare_with_definition);
}

static bool draws(const int32_t corners[3][2], edge_policy_t policy, int32_t x, int32_t y) {
    edge_table_t table;
    span_t span;
    if (!edge_table_start(&table, corners, policy, y) || table.row != y) { return false; }
    edge_table_next(&table, &span.first, &span.last);
    return span.first <= x && x <= span.last;
}

/* What the policies promise: no order of the corners matters, ends and outer draw all corners, outer all sides; no row is empty
 * but with inner. */
static void check_promises(const int32_t corners[3][2]) {
    static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    const raster_tile_t wide = {NULL, NULL, -100, -100, 100, 100, 200};
    int32_t p[3][2];
    sorted(corners, p);
    for (int policy = EDGE_ENDS; policy < POLICIES; policy++) {
        span_t first[ROWS];
        for (int o = 0; o < 6; o++) {
            int32_t turned[3][2];
            edge_table_t table;
            for (int c = 0; c < 3; c++) {
                memcpy(turned[c], corners[orders[o][c]], sizeof turned[c]);
            }
            assert_true(edge_table_start(&table, (const int32_t(*)[2])turned, (edge_policy_t)policy, -100));
            for (int32_t y = p[0][1]; y <= p[2][1]; y++) {
                span_t got, *known = &first[y - p[0][1]];
                edge_table_next(&table, &got.first, &got.last);
                if (o == 0) { *known = got; }
                assert_true(same_span(got, *known));
                assert_true(policy == EDGE_INNER || got.first <= got.last);
            }
        }
    }
    for (int c = 0; c < 3; c++) {
        assert_true(draws(corners, EDGE_ENDS, corners[c][0], corners[c][1]));
        assert_true(draws(corners, EDGE_OUTER, corners[c][0], corners[c][1]));
        const int32_t *a = corners[c], *b = corners[(c + 1) % 3];
        line_t line;
        assert_true(a[1] < b[1] ? line_start(&line, a, b, &wide) : line_start(&line, b, a, &wide));
        for (;; line_step(&line)) {
            assert_true(draws(corners, EDGE_OUTER, line.x, line.y));
            if (line.count == 1) { break; }
        }
    }
}

static void the_policies_keep_their_promises(void **state) {
    (void)state;
    each_triangle(check_promises);
}

/* What edge_table.h says in exact terms: distances of the chosen pixel of the side (0, 0) - (dx, dy) from where it meets a row's
 * centre line and from its span X1 ... X2 there, all times 2 dy. */
static void a_chosen_pixel_lies_near_its_side(void **state) {
    (void)state;
    for (int64_t dy = 1; dy <= 12; dy++) {
        for (int64_t dx = -60; dx <= 60; dx++) {
            const int32_t far_left[3][2] = {{0, 0}, {(int32_t)dx, (int32_t)dy}, {-500, (int32_t)dy}}; /* a right side */
            for (int32_t y = 1; y < dy; y++) {
                const int64_t middle = 2 * dx * y, x1 = dx * (2 * y - 1), x2 = dx * (2 * y + 1), unit = 2 * dy;
                const bool flat = llabs(dx) > dy;
                for (int policy = 0; policy < POLICIES; policy++) {
                    edge_table_t table;
                    span_t span;
                    assert_true(edge_table_start(&table, far_left, (edge_policy_t)policy, y));
                    edge_table_next(&table, &span.first, &span.last);
                    const int64_t x = unit * span.last, low = x1 < x2 ? x1 : x2, high = x1 < x2 ? x2 : x1;
                    if (!flat) {
                        assert_true(llabs(x - middle) <= dy);
                    } else if (policy == EDGE_OUTER) {
                        assert_true(high - unit <= x && x <= high); /* the last whole number up to X2 */
                    } else if (policy == EDGE_INNER) {
                        assert_true(low <= x && x <= low + unit);
                    } else if (policy == EDGE_MID) {
                        assert_true(llabs(x - middle) <= unit);
                    }
                }
            }
        }
    }
}

/* ---- the faults that the document names ------------------------------------------------------------------------------ */

static void a_corner_may_stay_undrawn_and_ends_mends_it(void **state) {
    /* Both sides from (0, 0) are flat and go right: the first row begins behind the corner (figure 8). */
    static const int32_t tip[3][2] = {{0, 0}, {20, 2}, {30, 6}};
    /* The side (10, 5) - (0, 5) overwrites the corner where it begins; only (0, 5) is left of the row. */
    static const int32_t top[3][2] = {{0, 0}, {10, 5}, {0, 5}};
    (void)state;
    assert_false(draws(tip, EDGE_DOCUMENT, 0, 0));
    assert_false(draws(tip, EDGE_UPWARDS, 0, 0));
    assert_true(draws(tip, EDGE_ENDS, 0, 0));
    assert_true(draws(tip, EDGE_OUTER, 0, 0));
    assert_true(draws(top, EDGE_DOCUMENT, 0, 5));
    assert_false(draws(top, EDGE_DOCUMENT, 10, 5));
    assert_false(draws(top, EDGE_DOCUMENT, 5, 5));
    for (int policy = EDGE_ENDS; policy < POLICIES; policy++) {
        assert_true(draws(top, (edge_policy_t)policy, 5, 5));
    }
    assert_true(draws(top, EDGE_ENDS, 10, 5));
}

static void the_direction_matters_and_upwards_mends_it(void **state) {
    static const int32_t one[3][2] = {{0, 0}, {10, 5}, {0, 5}}, other[3][2] = {{0, 0}, {0, 5}, {10, 5}};
    unsigned different = 0;
    (void)state;
    for (int32_t x = -1; x <= 11; x++) {
        different += draws(one, EDGE_DOCUMENT, x, 5) != draws(other, EDGE_DOCUMENT, x, 5);
        assert_int_equal(draws(one, EDGE_UPWARDS, x, 5), draws(other, EDGE_UPWARDS, x, 5));
        assert_int_equal(draws(one, EDGE_UPWARDS, x, 5), x >= 0 && x <= 10);
    }
    assert_int_equal(different, 2); /* (0, 5) in one, (10, 5) in the other */
    /* A flat side takes its rightmost pixel where it is walked to the right and its leftmost where it is walked to the left: (0, 0)
     * - (9, 1) has row 0 up to column 4, its mirror row 0 from column -4. */
    static const int32_t right[3][2] = {{0, 0}, {9, 1}, {0, 9}}, left[3][2] = {{0, 0}, {-9, 1}, {0, 9}};
    assert_true(draws(right, EDGE_DOCUMENT, 4, 0) && !draws(right, EDGE_DOCUMENT, 5, 0));
    assert_true(draws(left, EDGE_DOCUMENT, -4, 0) && !draws(left, EDGE_DOCUMENT, -5, 0));
}

/* By hand: right side (0, 0) - (9, 3): round(i / 3) is 0 0 1 1 1 2 2 2 3 3, so its runs are 0 1, 2 3 4, 5 6 7, 8 9. */
static void a_triangle_known_by_hand(void **state) {
    static const int32_t corners[3][2] = {{0, 0}, {9, 3}, {0, 3}};
    static const int32_t last[POLICIES][4] = {{1, 4, 7, -1}, {0, 4, 7, 9}, {1, 4, 7, 9}, {1, 4, 7, 9}, {0, 3, 6, 8}, {0, 2, 5, 8}};
    (void)state;
    for (int policy = 0; policy < POLICIES; policy++) {
        edge_table_t table;
        assert_true(edge_table_start(&table, corners, (edge_policy_t)policy, 0));
        for (int y = 0; y < (policy == EDGE_DOCUMENT ? 3 : 4); y++) {
            span_t span;
            edge_table_next(&table, &span.first, &span.last);
            assert_int_equal(span.first, 0);
            assert_int_equal(span.last, last[policy][y]);
        }
    }
}

/* ---- neighbours ----------------------------------------------------------------------------------------------------- */

enum { CELLS = 5, WIDE = 61, HIGH = 41 };

static void draw_mesh(const int32_t (*points)[2], unsigned diagonals, edge_policy_t policy, uint32_t *picture) {
    const raster_tile_t tile = {NULL, picture, 0, 0, WIDE, HIGH, WIDE};
    for (int cell = 0; cell < CELLS * CELLS; cell++) {
        const int32_t *a = points[cell / CELLS * (CELLS + 1) + cell % CELLS], *b = a + 2, *c = a + 2 * (CELLS + 1), *d = c + 2;
        const bool turned = diagonals >> cell & 1;
        const int32_t first[3][2] = {{a[0], a[1]}, {b[0], b[1]}, {turned ? d[0] : c[0], turned ? d[1] : c[1]}};
        const int32_t second[3][2] = {{d[0], d[1]}, {c[0], c[1]}, {turned ? a[0] : b[0], turned ? a[1] : b[1]}};
        edge_table_fill(&tile, first, policy, 1, 4);
        edge_table_fill(&tile, second, policy, 1, 4);
    }
}

/* A rectangle cut into triangles: inside it, no pixel may be missing. Flat sides everywhere, also in one row. */
static void only_inner_leaves_gaps_between_neighbours(void **state) {
    random_source_t random = random_seed(18);
    unsigned gaps[POLICIES] = {0};
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(2000); round++) {
        int32_t points[(CELLS + 1) * (CELLS + 1)][2];
        const unsigned diagonals = (unsigned)random_bits(&random);
        for (int i = 0; i < (CELLS + 1) * (CELLS + 1); i++) {
            const int column = i % (CELLS + 1), row = i / (CELLS + 1);
            const bool rim_x = column == 0 || column == CELLS, rim_y = row == 0 || row == CELLS;
            points[i][0] = column * (WIDE - 1) / CELLS + (rim_x ? 0 : random_between(&random, -2, 2));
            points[i][1] = row * (HIGH - 1) / CELLS + (rim_y ? 0 : random_between(&random, -1, 1));
        }
        for (int policy = 0; policy < POLICIES; policy++) {
            uint32_t picture[HIGH * WIDE] = {0};
            draw_mesh((const int32_t(*)[2])points, diagonals, (edge_policy_t)policy, picture);
            for (int y = 1; y < HIGH - 1; y++) {
                for (int x = 1; x < WIDE - 1; x++) {
                    gaps[policy] += picture[y * WIDE + x] == 0;
                }
            }
        }
    }
    for (int policy = 0; policy < POLICIES; policy++) {
        if ((gaps[policy] > 0) != (policy == EDGE_INNER)) { fail_msg("%s leaves %u gaps", policy_names[policy], gaps[policy]); }
    }
}

/* The smallest case: a flat side between two triangles. (0, 0) - (12, 2) has the run 3 ... 8 on row 1. */
static void a_gap_known_by_hand(void **state) {
    static const int32_t above[3][2] = {{0, 0}, {12, 2}, {12, -10}}, below[3][2] = {{0, 0}, {12, 2}, {0, 12}};
    (void)state;
    for (int32_t x = 0; x <= 12; x++) {
        const bool gap = x > 3 && x < 8;
        assert_int_equal(draws(above, EDGE_INNER, x, 1) || draws(below, EDGE_INNER, x, 1), !gap);
        for (int policy = 0; policy < EDGE_INNER; policy++) {
            assert_true(draws(above, (edge_policy_t)policy, x, 1) || draws(below, (edge_policy_t)policy, x, 1));
        }
    }
}

/* ---- tiles ---------------------------------------------------------------------------------------------------------- */

enum { SIDE = 18, MARGIN = 2 };

static void check_tile(const int32_t corners[3][2], edge_policy_t policy, int32_t left, int32_t top, unsigned *drawn) {
    uint32_t wide[SIDE + 2 * MARGIN][SIDE + 2 * MARGIN];
    uint16_t narrow[SIDE + 2 * MARGIN][SIDE + 2 * MARGIN];
    const raster_tile_t tile = {NULL, &wide[MARGIN][MARGIN], left, top, left + SIDE, top + SIDE, SIDE + 2 * MARGIN};
    raster_tile_t tile16 = tile;
    int32_t p[3][2];
    tile16.colour = &narrow[MARGIN][MARGIN];
    memset(wide, 0, sizeof wide);
    memset(narrow, 0, sizeof narrow);
    edge_table_fill(&tile, corners, policy, 90000, 4);
    edge_table_fill(&tile16, corners, policy, 9, 2);
    sorted(corners, p);
    for (int32_t y = -MARGIN; y < SIDE + MARGIN; y++) {
        span_t span = {0, -1};
        const int32_t row = top + y;
        if (y >= 0 && y < SIDE && p[0][1] <= row && row <= p[2][1]) { span = expected_span((const int32_t(*)[2])p, row, policy); }
        for (int32_t x = -MARGIN; x < SIDE + MARGIN; x++) {
            const bool expected = x >= 0 && x < SIDE && span.first <= left + x && left + x <= span.last;
            if (wide[y + MARGIN][x + MARGIN] != (expected ? 90000 : 0) || narrow[y + MARGIN][x + MARGIN] != (expected ? 9 : 0)) {
                fail_msg("%s, %d,%d %d,%d %d,%d: pixel %d,%d of the tile at %d,%d", policy_names[policy], p[0][0], p[0][1], p[1][0],
                         p[1][1], p[2][0], p[2][1], left + x, row, left, top);
            }
            *drawn += expected;
        }
    }
}

static void a_tile_is_a_part_of_the_triangle_at_any_size(void **state) {
    random_source_t random = random_seed(19);
    unsigned drawn = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(30000); round++) {
        const edge_policy_t policy = (edge_policy_t)(1 + round % (POLICIES - 1));
        const int32_t reach = round % 4 == 0 ? 15 : round % 4 == 1 ? 300 : LINE_RANGE;
        int32_t corners[3][2];
        for (int c = 0; c < 3; c++) {
            for (int k = 0; k < 2; k++) {
                corners[c][k] = random_one_in(&random, 6)   ? reach
                                : random_one_in(&random, 6) ? -reach
                                                            : random_between(&random, -reach, reach);
            }
        }
        const double t = random_one_in(&random, 4) ? 0 : random_real(&random, 0, 1);
        const int32_t *a = corners[round % 3], *b = corners[(round / 3 + round + 1) % 3];
        const int32_t left = (int32_t)((1 - t) * a[0] + t * b[0]) - random_between(&random, 0, SIDE);
        const int32_t top = (int32_t)((1 - t) * a[1] + t * b[1]) - random_between(&random, 0, SIDE);
        check_tile((const int32_t(*)[2])corners, policy, left, top, &drawn);
    }
    assert_true(drawn > (unsigned)CHECK_ROUNDS(30000) * 50);
}

/* The document's policy, whose oracle is the listing: entered at any row it is the same. */
static void document_may_be_entered_at_any_row(void **state) {
    random_source_t random = random_seed(20);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(4000); round++) {
        int32_t corners[3][2], p[3][2];
        span_t spans[ROWS];
        for (int c = 0; c < 3; c++) {
            corners[c][0] = random_between(&random, -300, 300);
            corners[c][1] = random_between(&random, -10, 40);
        }
        sorted((const int32_t(*)[2])corners, p);
        triangle(p[0][0], p[0][1], p[1][0], p[1][1], p[2][0], p[2][1], spans, false);
        for (int32_t first = p[0][1] - 1; first <= p[2][1] + 1; first++) {
            edge_table_t table;
            const bool some = edge_table_start(&table, (const int32_t(*)[2])corners, EDGE_DOCUMENT, first);
            assert_int_equal(some, first <= p[2][1]);
            while (some && table.row <= table.last_row) {
                const span_t expected = spans[table.row - p[0][1]];
                span_t got;
                edge_table_next(&table, &got.first, &got.last);
                assert_int_equal(got.first, expected.first);
                assert_int_equal(got.last, expected.last);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_triangle_known_by_hand),
        cmocka_unit_test(document_is_the_listing),
        cmocka_unit_test(each_policy_is_its_definition),
        cmocka_unit_test(the_policies_keep_their_promises),
        cmocka_unit_test(a_chosen_pixel_lies_near_its_side),
        cmocka_unit_test(a_corner_may_stay_undrawn_and_ends_mends_it),
        cmocka_unit_test(the_direction_matters_and_upwards_mends_it),
        cmocka_unit_test(a_gap_known_by_hand),
        cmocka_unit_test(only_inner_leaves_gaps_between_neighbours),
        cmocka_unit_test(a_tile_is_a_part_of_the_triangle_at_any_size),
        cmocka_unit_test(document_may_be_entered_at_any_row),
    };
    return cmocka_run_group_tests_name("edge_table", tests, NULL, NULL);
}
