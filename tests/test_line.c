/* Bresenham's line: against the document's own listing, and cut to tiles against exact arithmetic. */
#include "support/check.h"

#include "../raster/draw/line.h"
#include "support/random.h"

/* ---- the listing of document 003, S16, its pixels collected --------------------------------------------------------- */

typedef struct pixels {
    int32_t (*at)[2];
    int count;
} pixels_t;

static pixels_t collected;

static void pixel(int x, int y) {
    collected.at[collected.count][0] = x;
    collected.at[collected.count++][1] = y;
}

static void ligne(int xi, int yi, int xf, int yf) {
    int x = xi;
    int y = yi;
    int dx = xf - xi;
    int dy = yf - yi;
    int xinc = (dx > 0) ? 1 : -1;
    int yinc = (dy > 0) ? 1 : -1;
    dx = abs(dx);
    dy = abs(dy);
    pixel(x, y);
    if (dx > dy) {
        int cumul = dx >> 1;
        for (int i = 1; i <= dx; i++) {
            x += xinc;
            cumul += dy;
            if (cumul >= dx) {
                cumul -= dx;
                y += yinc;
            }
            pixel(x, y);
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
            pixel(x, y);
        }
    }
}

static void listing(const int32_t from[2], const int32_t to[2], int longest) {
    collected.at = realloc(collected.at, (size_t)(longest + 1) * sizeof *collected.at);
    assert_non_null(collected.at);
    collected.count = 0;
    ligne(from[0], from[1], to[0], to[1]);
}

/* ---- whole lines ---------------------------------------------------------------------------------------------------- */

enum { REACH = 24 };

static void all_vectors_have_the_pixels_of_the_listing_in_its_order(void **state) {
    const raster_tile_t wide = {NULL, NULL, -1000, -1000, 1000, 1000, 2000};
    (void)state;
    for (int32_t dy = -REACH; dy <= REACH; dy++) {
        for (int32_t dx = -REACH; dx <= REACH; dx++) {
            const int32_t from[2] = {3, -7}, to[2] = {3 + dx, -7 + dy};
            line_t line;
            listing(from, to, REACH);
            assert_true(line_start(&line, from, to, &wide));
            assert_int_equal(line.count, collected.count);
            for (int i = 0;; i++) {
                assert_int_equal(line.x, collected.at[i][0]);
                assert_int_equal(line.y, collected.at[i][1]);
                if (line.count == 1) { break; }
                line_step(&line);
            }
            assert_int_equal(line.x, to[0]);
            assert_int_equal(line.y, to[1]);
        }
    }
}

/* (0, 0) to (8, 3) by hand: 3 i / 8, halves up, is 0 0.375 0.75 1.125 1.5 1.875 2.25 2.625 3. */
static void a_line_known_by_hand(void **state) {
    static const int32_t from[2] = {0, 0}, to[2] = {8, 3};
    uint32_t colours[4][9];
    uint16_t narrow[4][9];
    const raster_tile_t tile = {NULL, colours, 0, 0, 9, 4, 9}, tile16 = {NULL, narrow, 0, 0, 9, 4, 9};
    static const char *const expected[4] = {"##.......", "..##.....", "....###..", ".......##"};
    (void)state;
    memset(colours, 0, sizeof colours);
    memset(narrow, 0, sizeof narrow);
    line_draw(&tile, from, to, 70000, 4);
    line_draw(&tile16, from, to, 7, 2);
    for (int y = 0; y < 4; y++) {
        for (int x = 0; x < 9; x++) {
            assert_int_equal(colours[y][x], expected[y][x] == '#' ? 70000 : 0);
            assert_int_equal(narrow[y][x], expected[y][x] == '#' ? 7 : 0);
        }
    }
}

/* The listing is the same in its mirrors, but not backwards: a line that passes halfway between two pixels takes the one it walks
 * to. It does so where 2 i minor is an odd multiple of major. */
static void a_line_and_its_reverse_differ_exactly_on_halves(void **state) {
    const raster_tile_t wide = {NULL, NULL, -1000, -1000, 1000, 1000, 2000};
    const int32_t origin[2] = {0, 0};
    unsigned halves = 0;
    (void)state;
    for (int32_t dy = 0; dy <= REACH; dy++) {
        for (int32_t dx = 0; dx <= REACH; dx++) {
            const int32_t to[2] = {dx, dy}, mirrored[2] = {-dx, dy}, transposed[2] = {dy, dx};
            const int32_t major = dx > dy ? dx : dy, minor = dx > dy ? dy : dx;
            line_t line, mirror, swapped, back;
            int32_t backwards[REACH + 1][2];
            assert_true(line_start(&back, to, origin, &wide));
            for (int i = major; i >= 0; i--) {
                backwards[i][0] = back.x, backwards[i][1] = back.y;
                if (i) { line_step(&back); }
            }
            assert_true(line_start(&line, origin, to, &wide));
            assert_true(line_start(&mirror, origin, mirrored, &wide));
            assert_true(line_start(&swapped, origin, transposed, &wide));
            for (int32_t i = 0; i <= major; i++) {
                const bool half = major > 0 && 2 * i * minor % (2 * major) == major;
                assert_int_equal(mirror.x, -line.x);
                assert_int_equal(mirror.y, line.y);
                assert_int_equal(swapped.x, line.y);
                assert_int_equal(swapped.y, line.x);
                assert_int_equal(backwards[i][0] != line.x || backwards[i][1] != line.y, half);
                halves += half;
                if (i < major) { line_step(&line), line_step(&mirror), line_step(&swapped); }
            }
        }
    }
    assert_true(halves > 50);
}

/* ---- tiles ---------------------------------------------------------------------------------------------------------- */

enum { SIDE = 20, MARGIN = 3 };

/* The tile's pixels after the line was drawn, margins beside and between the rows included, are exactly those `on` says. */
static void check_tile(const int32_t from[2], const int32_t to[2], int32_t left, int32_t top,
                       bool (*on)(const int32_t[2], const int32_t[2], int32_t, int32_t)) {
    uint32_t colours[SIDE + 2 * MARGIN][SIDE + 2 * MARGIN];
    const raster_tile_t tile = {NULL, &colours[MARGIN][MARGIN], left, top, left + SIDE, top + SIDE, SIDE + 2 * MARGIN};
    memset(colours, 0, sizeof colours);
    line_draw(&tile, from, to, 1, 4);
    for (int32_t y = -MARGIN; y < SIDE + MARGIN; y++) {
        for (int32_t x = -MARGIN; x < SIDE + MARGIN; x++) {
            const bool inside = x >= 0 && x < SIDE && y >= 0 && y < SIDE;
            const uint32_t expected = inside && on(from, to, left + x, top + y);
            if (colours[y + MARGIN][x + MARGIN] != expected) {
                fail_msg("line %d,%d - %d,%d: pixel %d,%d of the tile at %d,%d is %u", from[0], from[1], to[0], to[1], left + x,
                         top + y, left, top, colours[y + MARGIN][x + MARGIN]);
            }
        }
    }
}

static bool in_listing(const int32_t from[2], const int32_t to[2], int32_t x, int32_t y) {
    (void)from, (void)to;
    for (int i = 0; i < collected.count; i++) {
        if (collected.at[i][0] == x && collected.at[i][1] == y) { return true; }
    }
    return false;
}

/* On the line as a rational number: is y the nearest to it in column x, halves the way it is walked? */
static bool is_nearest(const int32_t from[2], const int32_t to[2], int32_t x, int32_t y) {
    const int64_t dx = (int64_t)to[0] - from[0], dy = (int64_t)to[1] - from[1];
    const bool flat = llabs(dx) > llabs(dy);
    const int64_t major = flat ? llabs(dx) : llabs(dy), minor = flat ? llabs(dy) : llabs(dx);
    int64_t i = flat ? x - (int64_t)from[0] : y - (int64_t)from[1], m = flat ? y - (int64_t)from[1] : x - (int64_t)from[0];
    if ((flat ? dx : dy) < 0) { i = -i; }
    if ((flat ? dy : dx) < 0) { m = -m; }
    if (i < 0 || i > major) { return false; }
    if (major == 0) { return m == 0; }
    const int128_t twice = (int128_t)2 * i * minor - (int128_t)2 * m * major; /* of the distance, times major */
    return -major <= twice && twice < major;
}

static void a_tile_has_the_lines_own_pixels(void **state) {
    random_source_t random = random_seed(16);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(3000); round++) {
        const int32_t reach = round % 3 == 0 ? 10 : round % 3 == 1 ? 60 : 400;
        const int32_t from[2] = {random_between(&random, -reach, reach), random_between(&random, -reach, reach)};
        const int32_t to[2] = {random_between(&random, -reach, reach), random_between(&random, -reach, reach)};
        listing(from, to, 2 * reach);
        for (int tile = 0; tile < 4; tile++) { /* near a pixel of the line */
            const int32_t *at = collected.at[random_between(&random, 0, collected.count - 1)];
            check_tile(from, to, at[0] - random_between(&random, -4, SIDE + 4), at[1] - random_between(&random, -4, SIDE + 4),
                       in_listing);
        }
    }
}

static void a_tile_far_along_a_line_walked_pixel_by_pixel(void **state) {
    static const int32_t ends[][2] = {{3000000, 1234567}, {-2999999, 2999998}, {1, -2500000}, {-1111111, -2222222}};
    const int32_t from[2] = {5, -9};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(ends); i++) {
        listing(from, ends[i], 3000010);
        const int count = collected.count;
        int32_t(*const all)[2] = collected.at;
        for (int k = 1; k <= 8; k++) { /* the pixels near the one that the tile is laid on */
            const int at = (int)((int64_t)count * k / 8) - 1, first = at > 60 ? at - 60 : 0;
            collected.at = all + first;
            collected.count = (at + 60 < count ? at + 60 : count) - first;
            check_tile(from, ends[i], all[at][0] - 7, all[at][1] - 11, in_listing);
        }
        collected.at = all;
    }
}

static int32_t any_coordinate(random_source_t *random) {
    switch (random_between(random, 0, 3)) {
    case 0: return random_one_in(random, 2) ? LINE_RANGE : -LINE_RANGE;
    case 1: return random_between(random, -40, 40);
    default: return random_between(random, -LINE_RANGE, LINE_RANGE);
    }
}

static void a_tile_anywhere_along_the_longest_lines(void **state) {
    random_source_t random = random_seed(17);
    unsigned met = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        const int32_t from[2] = {any_coordinate(&random), any_coordinate(&random)};
        const int32_t to[2] = {any_coordinate(&random), any_coordinate(&random)};
        const double t = random_real(&random, 0, 1);
        const int32_t near_x = (int32_t)((1 - t) * from[0] + t * to[0]), near_y = (int32_t)((1 - t) * from[1] + t * to[1]);
        const int32_t left = near_x - random_between(&random, -2, SIDE + 2), top = near_y - random_between(&random, -2, SIDE + 2);
        const raster_tile_t tile = {NULL, NULL, left, top, left + SIDE, top + SIDE, SIDE};
        line_t line;
        check_tile(from, to, left, top, is_nearest);
        met += line_start(&line, from, to, &tile);
    }
    assert_true(met > (unsigned)CHECK_ROUNDS(20000) / 2);
}

/* The rational test above is the listing's, too. */
static void the_listing_takes_the_nearest_pixel(void **state) {
    const int32_t from[2] = {0, 0};
    (void)state;
    for (int32_t dy = -REACH; dy <= REACH; dy++) {
        for (int32_t dx = -REACH; dx <= REACH; dx++) {
            const int32_t to[2] = {dx, dy};
            int on = 0;
            listing(from, to, REACH);
            for (int32_t y = -REACH; y <= REACH; y++) {
                for (int32_t x = -REACH; x <= REACH; x++) {
                    on += is_nearest(from, to, x, y);
                }
            }
            assert_int_equal(on, collected.count);
            for (int i = 0; i < collected.count; i++) {
                assert_true(is_nearest(from, to, collected.at[i][0], collected.at[i][1]));
            }
        }
    }
}

static int tear_down(void **state) {
    (void)state;
    free(collected.at);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_vectors_have_the_pixels_of_the_listing_in_its_order),
        cmocka_unit_test(a_line_known_by_hand),
        cmocka_unit_test(a_line_and_its_reverse_differ_exactly_on_halves),
        cmocka_unit_test(the_listing_takes_the_nearest_pixel),
        cmocka_unit_test(a_tile_has_the_lines_own_pixels),
        cmocka_unit_test(a_tile_far_along_a_line_walked_pixel_by_pixel),
        cmocka_unit_test(a_tile_anywhere_along_the_longest_lines),
    };
    return cmocka_run_group_tests_name("line", tests, NULL, tear_down);
}
