/* Depth and light of what is filled: near their planes, and the same however a row was reached. */
#include "support/check.h"

#include <math.h>
#include <sys/mman.h>
#include <unistd.h>

#include "../raster/fill/polygon.h"
#include "../raster/fill/triangle.h"
#include "support/canvas.h"
#include "support/random.h"

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
    canvas_face_t face = {.count = 3};
    for (int i = 0; i < 3; i++) {
        face.vertices[i] = v[i];
        face.corners[i] = (uint8_t)i;
    }
    if (!face_to_triangle(&face)) { return; }
    const vertex_t t[3] = {*face_corner(&face, 0), *face_corner(&face, 1), *face_corner(&face, 2)};
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
        canvas_random_points(&random, points, 3, SIZE, 16000);
        canvas_face_t face = face_of_points((const int32_t(*)[2])points, 3);
        for (int i = 0; i < 3; i++) {
            face.vertices[i].depth_light = random_depth_light(&random, 512, 65529 * 256);
        }
        if (!face_to_triangle(&face)) { continue; }
        const vertex_t *v0 = face_corner(&face, 0), *v1 = face_corner(&face, 1), *v2 = face_corner(&face, 2);
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
        canvas_random_points(&random, points, count, SIZE, 16000);
        canvas_face_t face = face_of_points((const int32_t(*)[2])points, count);
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
        canvas_draw(&face, &canvas, SIZE, SIZE, CANVAS_CARRY);
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
        canvas_random_points(&random, points, count, SIZE, 16000);
        canvas_face_t face = face_of_points((const int32_t(*)[2])points, count);
        uint32_t low = UINT32_MAX, high = 0;
        const int32_t from = random_between(&random, 512, 65529 * 256), to = random_between(&random, from, 65529 * 256);
        for (uint32_t i = 0; i < count; i++) {
            face.vertices[i].depth_light = random_depth_light(&random, from, to);
            const uint32_t depth = ((face.vertices[i].depth_light >> 8) + 128) >> 8; /* to the nearest step */
            low = depth < low ? depth : low;
            high = depth > high ? depth : high;
        }
        canvas.width = canvas.height = SIZE;
        canvas_draw(&face, &canvas, SIZE, SIZE, (canvas_policy_t)(round % CANVAS_COUNT));
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
        cmocka_unit_test(depth_and_light_of_triangles_stay_near_their_planes),
        cmocka_unit_test(depth_of_the_thinnest_small_triangles),
        cmocka_unit_test(light_does_not_depend_on_the_way_to_a_row),
        cmocka_unit_test(the_nearer_face_wins_and_ties_go_as_asked),
        cmocka_unit_test(depth_of_polygons_stays_near_their_plane),
        cmocka_unit_test(depth_of_uneven_polygons_stays_in_their_range),
    };
    return cmocka_run_group_tests_name("depth", tests, NULL, NULL);
}
