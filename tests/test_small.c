/* Small triangles (fill/small.h) are drawn to the bit as by the way of large ones, whose coverage test_fill holds against exact
 * integers and whose depth and light test_depth and test_interpolation_light do.
 */
#include "support/check.h"

#include "../raster/fill/small.h"
#include "support/canvas.h"
#include "support/random.h"

#define SIDE CANVAS_PX
#define PIXELS (SIDE * SIDE)

typedef struct picture {
    uint16_t depth[PIXELS], colour[PIXELS];
} picture_t;

static picture_t behind; /* what lies there before: depths among the triangle's, so that it wins some pixels */
static uint16_t ramp[64];

static raster_tile_t tile_of(picture_t *picture, int32_t left, int32_t top, int32_t bottom) {
    const ptrdiff_t first = (ptrdiff_t)top * SIDE;
    return (raster_tile_t){picture->depth + first, picture->colour + first, left, top, left + SIDE, bottom, SIDE};
}

typedef struct case_s {
    vertex_t v[3];
    int32_t left;        /* column of the window where the tile begins */
    int32_t tile_height; /* rows of the window are 0 ... SIDE - 1 */
    small_kind_t kind;
} case_t;

/* The rows whose centres are between the lowest and the highest corner. */
static void rows_of(const case_t *c, int32_t *first, int32_t *end) {
    *first = edge_row(c->v[0].y);
    *end = edge_row(c->v[1].y > c->v[2].y ? c->v[1].y : c->v[2].y);
}

static void draw_large(const case_t *c, picture_t *picture) {
    triangle_t triangle;
    int32_t first, end;
    rows_of(c, &first, &end);
    if (first >= end || end <= 0) { return; } /* triangle_start wants a row */
    triangle_start(&triangle, &c->v[0], &c->v[1], &c->v[2], 0, c->kind == SMALL_GOURAUD);
    triangle.value = 0x1234;
    for (int32_t top = 0; top < SIDE; top += c->tile_height) {
        const int32_t bottom = top + c->tile_height < SIDE ? top + c->tile_height : SIDE;
        const raster_tile_t tile = tile_of(picture, c->left, top, bottom);
        if (triangle.row >= bottom || triangle.row >= triangle.head.row_end) { continue; }
        triangle_fill_any(&triangle, &tile, c->kind == SMALL_GOURAUD ? SPAN_GOURAUD : SPAN_FLAT, false, ramp);
    }
}

/* Set up anew in each tile. False: it was not small. */
static bool draw_small(const case_t *c, picture_t *picture) {
    int32_t first, end;
    rows_of(c, &first, &end);
    const small_paint_t paint = {.value = 0x1234, .ramp = ramp};
    for (int32_t top = 0; top < SIDE; top += c->tile_height) {
        const int32_t bottom = top + c->tile_height < SIDE ? top + c->tile_height : SIDE;
        const raster_tile_t whole = tile_of(picture, c->left, top, bottom);
        const small_tile_t tile = small_tile(&whole);
        small_face_t face;
        if (first >= bottom || end <= top || first >= end) { continue; }
        if (!small_open(&face, &c->v[0], &c->v[1], &c->v[2], &tile, 0)) { return false; }
        const bool clamp = !small_inside(&face.corners, &tile), smooth = c->kind == SMALL_GOURAUD;
        const bool below = small_fill(&face, &c->v[0], &c->v[1], &c->v[2], &tile, c->kind, smooth, 0, &paint, clamp);
        assert_int_equal(below, end > bottom);
    }
    return true;
}

/* True: it was small, and both are the same. */
static bool check_same(const case_t *c) {
    static picture_t large, small;
    large = small = behind;
    if (!draw_small(c, &small)) { return false; }
    draw_large(c, &large);
    assert_memory_equal(&small, &large, sizeof small);
    return true;
}

static void set_behind(random_source_t *random, const case_t *c) {
    for (size_t i = 0; i < PIXELS; i++) {
        const uint32_t near = c->v[random_bits(random) % 3].depth_light >> 16;
        behind.depth[i] = (uint16_t)(random_one_in(random, 2) ? 0 : near);
        behind.colour[i] = (uint16_t)random_bits(random);
    }
    for (size_t i = 0; i < 64; i++) {
        ramp[i] = (uint16_t)random_bits(random);
    }
}

/* Counter-clockwise as seen, a topmost corner first, with an area. */
static bool case_order(case_t *c) {
    const int32_t area = face_area(&c->v[0], &c->v[1], &c->v[2]);
    if (area == 0) { return false; }
    if (area < 0) {
        const vertex_t swap = c->v[1];
        c->v[1] = c->v[2];
        c->v[2] = swap;
    }
    while (c->v[0].y > c->v[1].y || c->v[0].y > c->v[2].y) {
        const vertex_t first = c->v[0];
        c->v[0] = c->v[1];
        c->v[1] = c->v[2];
        c->v[2] = first;
    }
    return true;
}

static void random_case(random_source_t *random, case_t *c) {
    const int32_t size = 1 << random_between(random, 2, 9), steep = 1 << random_between(random, 0, 23);
    const int32_t x = random_between(random, -100, 16 * SIDE), y = random_between(random, -100, 16 * SIDE),
                  z = random_between(random, (int32_t)VERTEX_DEPTH_MIN, (int32_t)VERTEX_DEPTH_MAX);
    c->left = random_one_in(random, 2) ? 0 : random_between(random, 1, 900);
    c->tile_height = random_one_in(random, 4) ? SIDE : random_between(random, 1, 20);
    c->kind = random_one_in(random, 2) ? SMALL_FLAT : SMALL_GOURAUD;
    for (int i = 0; i < 3; i++) {
        int64_t depth = z + random_between(random, -steep, steep);
        depth = depth < (int64_t)VERTEX_DEPTH_MIN   ? (int64_t)VERTEX_DEPTH_MIN
                : depth > (int64_t)VERTEX_DEPTH_MAX ? (int64_t)VERTEX_DEPTH_MAX
                                                    : depth;
        c->v[i] = (vertex_t){(int16_t)(16 * c->left + x + random_between(random, 0, size)),
                             (int16_t)(y + random_between(random, 0, size)),
                             (uint32_t)depth << 8 | (uint32_t)random_between(random, LIGHT_MIN, LIGHT_MAX)};
    }
}

static void random_triangles_have_the_bits_of_the_other_way(void **state) {
    random_source_t random = random_seed(0x5a11);
    unsigned compared = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(60000u); round++) {
        case_t c;
        random_case(&random, &c);
        if (!case_order(&c)) { continue; }
        if (round % 64 == 0) { set_behind(&random, &c); }
        compared += check_same(&c);
    }
    assert_true(compared > CHECK_ROUNDS(60000u) / 2);
}

static case_t case_of(const int32_t (*points)[2], int32_t left) {
    case_t c = {.left = left, .tile_height = SIDE, .kind = SMALL_GOURAUD};
    for (int i = 0; i < 3; i++) {
        c.v[i] =
            (vertex_t){(int16_t)points[i][0], (int16_t)points[i][1], (uint32_t)(1000000 + 3000 * i) << 8 | (uint32_t)(50 + 60 * i)};
    }
    assert_true(case_order(&c));
    return c;
}

/* 511 sixteenths of a pixel are short, 512 are not (fill/edge.h). */
static void a_side_of_32_pixels_is_not_small(void **state) {
    (void)state;
    for (int32_t more = -1; more <= 1; more++) {
        const int32_t across[3][2] = {{40, 40}, {40 + 512 + more, 90}, {60, 200}},
                      down[3][2] = {{40, 40}, {90, 40 + 512 + more}, {20, 90}},
                      apart[3][2] = {{300, 40}, {40, 90}, {40 + 512 + more, 200}};
        const case_t wide = case_of(across, 0), high = case_of(down, 0), between = case_of(apart, 0);
        assert_int_equal(check_same(&wide), more < 0);
        assert_int_equal(check_same(&high), more < 0);
        assert_int_equal(check_same(&between), more < 0);
    }
}

/* A column counts where a centre may lie at or right of the leftmost corner: x = 16 column + 8 is the last that belongs to it. */
static void columns_beside_the_tile_are_left_alone(void **state) {
    (void)state;
    for (int32_t left = 0; left <= 100; left += 50) {
        const int32_t first = 16 * left - 7, end = 16 * (left + SIDE) + 8; /* edge_row: left, and left + SIDE */
        for (int32_t more = -300; more <= 300; more += more < -2 || more > 1 ? 13 : 1) {
            const int32_t on_left[3][2] = {{first + more, 40}, {first + 100, 20}, {first + 90, 90}},
                          on_right[3][2] = {{end + more, 40}, {end - 100, 20}, {end - 90, 90}};
            const case_t cases[2] = {case_of(on_left, left), case_of(on_right, left)};
            for (int i = 0; i < 2; i++) {
                const raster_tile_t whole = {.left = left, .right = left + SIDE, .bottom = SIDE};
                const small_tile_t tile = small_tile(&whole);
                small_face_t face;
                assert_true(check_same(&cases[i]));
                assert_true(small_open(&face, &cases[i].v[0], &cases[i].v[1], &cases[i].v[2], &tile, SMALL_IS_SHORT));
                assert_int_equal(small_inside(&face.corners, &tile), i == 0 ? more >= 0 : more <= 0);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_triangles_have_the_bits_of_the_other_way),
        cmocka_unit_test(a_side_of_32_pixels_is_not_small),
        cmocka_unit_test(columns_beside_the_tile_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
