/* The stages of the compact renderer against those of the full one: vertices, clipping, depth, side by side. */
#include "../raster/compact/inside.h"
#include "../raster/fill/polygon.h"
#include "../raster/fill/triangle.h"
#include "../raster/geometry/clip.h"
#include "support/check.h"
#include "support/random.h"

#define WIDTH 128
#define HEIGHT 64
#define VERTICES 64
#define REACH 18000 /* |components| of positions: within the bounding sphere */

/* A model of random positions, one in two with fractions, in front of a camera. */
typedef struct stand {
    tuile_model_t model;
    tuile_instance_t instance;
    tuile_light_t light;
    tuile_scene_t scene;
    transform_t transform;
    int16_t positions[3 * VERTICES];
    int8_t fractions[3 * VERTICES];
    vertex_t vertices[VERTICES];
    tuile_compact_t compact;
    tuile_compact_point_t points[VERTICES];
    uint32_t depths[VERTICES];
} stand_t;

static q16_16_t anywhere(random_source_t *random, int32_t reach) { return random_between(random, -reach, reach); }

/* False: such a camera is refused. */
static bool stand_make(stand_t *s, random_source_t *random) {
    const int32_t bits = random_between(random, -4, 4);
    q16_16_t eye[3], at[3];
    const q16_16_t up[3] = {0, TUILE_Q16(1), 0};
    *s = (stand_t){.model = {.step = {1, -12 + bits}, .radius = 32000}};
    s->instance = (tuile_instance_t){.model = &s->model, .pose = {.scale = TUILE_SCALE_ONE}};
    tuile_rotation(s->instance.pose.rotation, random_between(random, 0, 2), (bam16_t)random_between(random, 0, 65535));
    s->scene = (tuile_scene_t){.instances = &s->instance, .instance_count = 1, .lights = &s->light, .light_count = 1};
    for (unsigned i = 0; i < 3; i++) { /* the model reaches 4.4 units, times 2^bits */
        eye[i] = anywhere(random, TUILE_Q16(random_one_in(random, 2) ? 3 : 12));
        at[i] = anywhere(random, TUILE_Q16(2));
    }
    if (tuile_camera_look_at(&s->scene.camera, eye, at, up)) { return false; }
    const q16_16_t focal = random_one_in(random, 4) ? TUILE_Q16(30000) : TUILE_Q16(900); /* a telescope now and then */
    s->scene.camera.focal_x = random_between(random, TUILE_Q16(20), focal);
    s->scene.camera.focal_y = random_between(random, TUILE_Q16(20), focal);
    s->scene.camera.centre_x = TUILE_Q16(WIDTH / 2), s->scene.camera.centre_y = TUILE_Q16(HEIGHT / 2);
    s->scene.camera.near = 1 << random_between(random, 4, 15);
    s->scene.camera.far = s->scene.camera.near + (1 << random_between(random, 14, 23));
    if (transform_make(&s->transform, &s->scene, &s->instance, WIDTH, HEIGHT)) { return false; }
    const transform_region_t region = {0, 0, WIDTH, HEIGHT};
    transform_region(&s->transform, &region);
    for (unsigned i = 0; i < 3 * VERTICES; i++) {
        s->positions[i] = (int16_t)random_between(random, -REACH, REACH);
        s->fractions[i] = (int8_t)(i / 3 % 2 ? random_between(random, -127, 127) : 0);
    }
    assert_int_equal(tuile_compact_view(&s->compact.view, &s->scene, WIDTH, HEIGHT), 0);
    s->compact.positions = (const uint8_t *)s->positions;
    s->compact.fractions = (const uint8_t *)s->fractions;
    s->compact.vertex_count = VERTICES;
    s->compact.points = s->points;
    s->compact.depths = s->depths;
    (void)vertex_stage(&s->transform, s->positions, NULL, VERTICES, s->vertices);
    (void)vertex_fractions(&s->transform, s->positions, s->fractions, VERTICES, s->vertices);
    compact_vertices(&s->compact);
    return true;
}

static void vertices_come_to_the_same_places(void **state) {
    random_source_t random = random_seed(5);
    unsigned inside = 0, outside = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(4000); round++) {
        stand_t s;
        if (!stand_make(&s, &random)) { continue; }
        for (unsigned i = 0; i < VERTICES; i++) {
            const int16_t *q = s.positions + 3 * (size_t)i;
            const int8_t *f = s.fractions + 3 * (size_t)i;
            const compact_place_t place = compact_place(&s.compact.view, q, f);
            assert_int_equal(place.x, transform_finer(&s.transform.x, q, f));
            assert_int_equal(place.y, transform_finer(&s.transform.y, q, f));
            assert_int_equal(place.w, transform_finer(&s.transform.w, q, f));
            assert_int_equal(s.points[i].x == COMPACT_OUTSIDE, s.vertices[i].x == VERTEX_OUTSIDE);
            if (s.vertices[i].x == VERTEX_OUTSIDE) {
                outside++;
                continue;
            }
            inside++;
            assert_int_equal(s.points[i].x, s.vertices[i].x);
            assert_int_equal(s.points[i].y, s.vertices[i].y);
            assert_int_equal(s.depths[i], s.vertices[i].depth_light >> 8);
        }
    }
    assert_true(inside > CHECK_ROUNDS(4000) * 4 && outside > CHECK_ROUNDS(4000) * 4);
}

/* Places at and beyond the ends of what there is, too. */
static void places_are_projected_alike(void **state) {
    random_source_t random = random_seed(6);
    unsigned seen = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(4000); round++) {
        stand_t s;
        if (!stand_make(&s, &random)) { continue; }
        const int64_t low = s.transform.w_low, high = s.transform.w_high, ends[4] = {low - 1, low, high, high + 1};
        for (unsigned i = 0; i < 40; i++) {
            compact_place_t place = {random_any_size(&random, 46), random_any_size(&random, 46),
                                     i < 4 ? ends[i] : low + (int64_t)(random_bits(&random) % (uint64_t)(high - low))};
            if (i >= 30) { place.w = (int64_t)1 << (46 - (i - 30)); } /* whose reciprocals are powers of two as well */
            for (unsigned clamp = 0; clamp < 2; clamp++) {
                vertex_t vertex = {0};
                tuile_compact_point_t point;
                uint32_t depth;
                const bool expected = vertex_project(&s.transform, place.x, place.y, place.w, 0, clamp, &vertex);
                assert_int_equal(compact_project(&s.compact.view, &place, clamp, &point, &depth), expected);
                if (!expected) { continue; }
                seen++;
                assert_int_equal(point.x, vertex.x);
                assert_int_equal(point.y, vertex.y);
                assert_int_equal(depth, vertex.depth_light >> 8);
            }
        }
    }
    assert_true(seen > CHECK_ROUNDS(4000) * 10);
}

static void faces_are_clipped_to_the_same_corners(void **state) {
    random_source_t random = random_seed(7);
    unsigned cut = 0, refused = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(4000); round++) {
        stand_t s;
        if (!stand_make(&s, &random)) { continue; }
        for (unsigned i = 0; i < 12; i++) {
            const uint8_t count = (uint8_t)random_between(&random, 3, 6);
            uint16_t numbers[6];
            uint8_t corners[6];
            vertex_t out[96];
            compact_ring_t ring;
            for (unsigned k = 0; k < count; k++) {
                corners[k] = (uint8_t)random_between(&random, 0, VERTICES - 1);
                numbers[k] = corners[k];
            }
            const clip_face_t face = {
                .positions = s.positions, .fractions = s.fractions, .vertices = s.vertices, .corners = corners, .count = count};
            const int left = clip_polygon(&s.transform, &face, out, CHECK_COUNT(out));
            assert_true(left >= 0);
            if (!compact_clip(&s.compact, numbers, count, &ring)) { /* more than 14 corners somewhere on the way */
                refused++;
                continue;
            }
            assert_int_equal(ring.count < 3 ? 0 : ring.count, left);
            for (int k = 0; k < left; k++) {
                assert_int_equal(ring.point[k].x, out[k].x);
                assert_int_equal(ring.point[k].y, out[k].y);
                assert_int_equal(ring.depth[k], out[k].depth_light >> 8);
            }
            cut += left > 0;
        }
    }
    assert_true(cut > CHECK_ROUNDS(4000) * 4 && refused < cut / 20);
}

/* ---- depth ---- */

typedef struct pair {
    uint16_t depth[WIDTH * HEIGHT], colour[WIDTH * HEIGHT], compact_depth[WIDTH * HEIGHT];
    uint8_t bits[WIDTH * HEIGHT / 8];
} pair_t;

/* A triangle as face.c orders it: a topmost corner first; of equally high ones the one that it takes. */
static unsigned top_of(const vertex_t v[3]) { return v[1].y < v[0].y && v[1].y <= v[2].y ? 1 : v[2].y < v[0].y ? 2 : 0; }

static int64_t area_of(const vertex_t *v, unsigned count) {
    int64_t area = 0;
    for (unsigned i = 1; i + 1 < count; i++) {
        area += (int64_t)(v[i + 1].x - v[0].x) * (v[i].y - v[0].y) - (int64_t)(v[i].x - v[0].x) * (v[i + 1].y - v[0].y);
    }
    return area;
}

/* Does its box hold a pixel's centre of the window? Others never come to be filled there (frame/face.c). */
static bool in_window(const vertex_t *v, unsigned count) {
    int32_t left = INT32_MAX, right = INT32_MIN, top = INT32_MAX, bottom = INT32_MIN;
    for (unsigned i = 0; i < count; i++) {
        left = v[i].x < left ? v[i].x : left;
        right = v[i].x > right ? v[i].x : right;
        top = v[i].y < top ? v[i].y : top;
        bottom = v[i].y > bottom ? v[i].y : bottom;
    }
    return edge_row(top) < edge_row(bottom) && edge_row(left) < edge_row(right) && edge_row(top) < HEIGHT && edge_row(bottom) > 0 &&
           edge_row(left) < WIDTH && edge_row(right) > 0;
}

static void fill_full(const vertex_t *v, unsigned count, pair_t *pair) {
    const raster_tile_t tile = {pair->depth, pair->colour, 0, 0, WIDTH, HEIGHT, WIDTH};
    if (!in_window(v, count)) { return; }
    if (count == 3) {
        const unsigned top = top_of(v);
        const vertex_t *v0 = &v[top], *v1 = &v[(top + 1) % 3], *v2 = &v[(top + 2) % 3];
        triangle_t triangle = {.value = 1};
        triangle_start(&triangle, v0, v1, v2, 0, false);
        if (triangle.row < triangle.head.row_end && triangle.row < HEIGHT) {
            triangle_fill(&triangle, &tile, SPAN_FLAT, false, NULL);
        }
        return;
    }
    const polygon_ring_t ring = {v, NULL, NULL, count};
    polygon_t polygon = {.value = 1};
    if (polygon_start(&polygon, &ring, 0) && polygon.row < HEIGHT) { polygon_fill(&polygon, &ring, &tile, SPAN_FLAT, false); }
}

static void fill_compact(const vertex_t *v, unsigned count, pair_t *pair) {
    tuile_compact_t compact = {.depth = pair->compact_depth, .bits = pair->bits, .right = WIDTH, .bottom = HEIGHT};
    compact_ring_t ring = {.count = (uint8_t)count};
    int16_t first, end;
    for (unsigned i = 0; i < count; i++) {
        ring.point[i] = (tuile_compact_point_t){v[i].x, v[i].y};
        ring.depth[i] = v[i].depth_light >> 8;
    }
    if (compact_rows(&compact, &ring, &first, &end)) { compact_fill(&compact, &ring, first, end, 0); }
}

/* Triangles and polygons of all sizes, flat ones and such as are seen from their edges; corners in one row now and then. */
static void faces_have_the_same_depth_at_every_pixel(void **state) {
    random_source_t random = random_seed(8);
    static pair_t pair;
    uint64_t covered = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(20000); round++) {
        const int32_t size = 1 << random_between(&random, 4, 14), far = random_between(&random, 600, 15000000);
        const int32_t range = 1 << random_between(&random, 0, 22), x = random_between(&random, -200, 2200),
                      y = random_between(&random, -200, 1200);
        const unsigned count = (unsigned)random_between(&random, 3, 6);
        vertex_t v[6];
        for (unsigned i = 0; i < count; i++) {
            const int32_t depth = far + random_between(&random, 0, range), px = x + random_between(&random, -size, size);
            int32_t py = y + random_between(&random, -size, size);
            if (i > 0 && random_one_in(&random, 4)) { py = v[i - 1].y; }
            v[i] = (vertex_t){(int16_t)(px < -15000  ? -15000
                                        : px > 15000 ? 15000
                                                     : px),
                              (int16_t)(py < -15000  ? -15000
                                        : py > 15000 ? 15000
                                                     : py),
                              (uint32_t)(depth > 16775000 ? 16775000 : depth) << 8};
        }
        if (count == 4 && random_one_in(&random, 4)) { /* a parallelogram: two triangles of one size, not in one plane */
            v[3].x = (int16_t)(v[0].x + v[2].x - v[1].x);
            v[3].y = (int16_t)(v[0].y + v[2].y - v[1].y);
            if (v[3].x < -15000 || v[3].x > 15000 || v[3].y < -15000 || v[3].y > 15000) { continue; }
        }
        const int64_t area = area_of(v, count);
        if (count == 3 ? area <= 0 : area < 0) { continue; }
        if (round % 8 == 0) { memset(&pair, 0, sizeof pair); }
        fill_full(v, count, &pair);
        fill_compact(v, count, &pair);
        if (memcmp(pair.depth, pair.compact_depth, sizeof pair.depth) != 0) {
            fail_msg("round %u: %u corners, %d across", round, count, size);
        }
        for (unsigned i = 0; round % 8 == 7 && i < WIDTH * HEIGHT; i++) {
            covered += pair.depth[i] != 0;
        }
    }
    assert_true(covered > CHECK_ROUNDS(20000) * 20);
}

/* ceil((128 - (2 b + 1)) * 65535 / 128) is the least luminance that is white where Bayer's number is b. */
static void levels_are_the_thresholds_of_the_matrix(void **state) {
    (void)state;
    for (uint32_t luma = 0; luma <= 65535; luma++) {
        unsigned level = 0;
        while (level < 64 && luma < ((127 - 2 * level) * 65535 + 127) / 128) {
            level++;
        }
        if (compact_level((uint16_t)luma) != level) { fail_msg("luma %u: %u, not %u", luma, compact_level((uint16_t)luma), level); }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vertices_come_to_the_same_places),        cmocka_unit_test(places_are_projected_alike),
        cmocka_unit_test(faces_are_clipped_to_the_same_corners),   cmocka_unit_test(faces_have_the_same_depth_at_every_pixel),
        cmocka_unit_test(levels_are_the_thresholds_of_the_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
