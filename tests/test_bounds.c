/* A bound stands beside every piece of arithmetic; here each is walked to its ends. The results are checked where that is cheap,
 * but the point is UBSan's: run under it, an overflow anywhere fails the test. */
#include "support/check.h"

#include "../raster/fill/polygon.h"
#include "../raster/fill/triangle.h"
#include "../raster/geometry/clip.h"
#include "../raster/geometry/cull.h"
#include "../raster/geometry/model.h"
#include "../raster/geometry/transform.h"
#include "support/random.h"

/* Is x the ceiling of numerator / d? */
static bool is_ceiling(int128_t x, int128_t numerator, int128_t d) { return numerator <= x * d && (x - 1) * d < numerator; }

static void check_edge(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t row, bool wide) {
    edge_t edge;
    if (wide) {
        edge_start_wide(&edge, x0, y0, x1, y1, row);
    } else {
        edge_start(&edge, x0, y0, x1, y1, row);
    }
    for (int32_t at = row; at < row + 3 && 16 * at + 8 < y1; at++) {
        const int128_t numerator = (int128_t)(x0 - 8) * (y1 - y0) + (int128_t)(16 * at + 8 - y0) * (x1 - x0);
        assert_true(is_ceiling(edge.x, numerator, (int128_t)16 * (y1 - y0)));
        edge_step(&edge);
    }
}

/* The guard span at each place where a window may put it, sides from end to end of it, at the first and last row. */
static void edges_across_the_guard_span(void **state) {
    (void)state;
    for (int window = 1; window <= TUILE_WINDOW_MAX_PX; window += window < 16 ? 1 : 63) {
        const int32_t low = (window * 16 - GUARD_SPAN) / 2, high = low + GUARD_SPAN - 1;
        const int32_t ends[4] = {low, high, low + 1, high - 1};
        for (int i = 0; i < 4; i++) {
            for (int j = 0; j < 4; j++) {
                check_edge(ends[i], low, ends[j], high, edge_row(low), false);
                check_edge(ends[i], low, ends[j], high, edge_row(high) - 1, false);
                check_edge(ends[i], low, ends[j], low + 16, edge_row(low), false);
                check_edge(ends[i], high - 16, ends[j], high, edge_row(high) - 1, false);
            }
        }
    }
}

static void wide_edges_across_the_coordinates(void **state) {
    static const int32_t far = 32767 * 16, near[] = {1, 15, 16, 17, 1000};
    (void)state;
    for (int i = 0; i < 4; i++) {
        const int32_t x0 = i & 1 ? far : -far, x1 = i & 2 ? far : -far;
        check_edge(x0, -far, x1, far, edge_row(-far), true);
        check_edge(x0, -far, x1, far, edge_row(far) - 1, true);
        check_edge(x0, -far, x1, far, 0, true);
        for (size_t k = 0; k < CHECK_COUNT(near); k++) {
            check_edge(x0, -near[k], x1, near[k] + 8, 0, true);
            check_edge(x0, far - 15 - near[k], x1, far, edge_row(far - 15 - near[k]), true);
        }
    }
}

static void short_edges_at_the_ends_of_the_coordinates(void **state) {
    static const int32_t ends[] = {INT16_MIN + 8, INT16_MIN + 17, -8, 0, 8, INT16_MAX - 16, INT16_MAX - 17};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(ends); i++) {
        for (int32_t dx = 1 - SHORT_SIDE; dx < SHORT_SIDE; dx++) {
            for (int32_t dy = 1; dy < SHORT_SIDE; dy += dy < 40 ? 1 : 29) {
                const int32_t x0 = ends[i], y0 = -3, first = edge_row(y0), end = edge_row(y0 + dy);
                if (x0 + dx < INT16_MIN + 8 || x0 + dx > INT16_MAX - 16 || first >= end) { continue; }
                for (int last = 0; last < 2; last++) {
                    const int32_t row = last ? end - 1 : first;
                    const short_edge_t edge = short_edge_start(x0, y0, x0 + dx, y0 + dy, row);
                    const int128_t numerator = (int128_t)(x0 - 8) * dy + (int128_t)(16 * row + 8 - y0) * dx;
                    assert_true(is_ceiling(short_edge_pixel(edge.x), numerator, (int128_t)16 * dy));
                }
            }
        }
    }
}

static void leftmost_short_edge(void) {
    const short_edge_t edge = short_edge_start(INT16_MIN + 8, 0, INT16_MIN + 8, 32, 0);
    if (short_edge_pixel(edge.x) != -2048) { abort(); }
}

static void a_short_edge_at_its_stated_left_end_does_not_overflow(void **state) {
    (void)state;
    assert_true(check_survives(leftmost_short_edge));
}

/* Triangles whose corners are ends of the guard span, of small sides too, with depth and light at both ends. */
static void triangles_at_the_ends_of_everything(void **state) {
    enum { SIZE = 16 };
    static uint16_t depth[SIZE * SIZE], colour[SIZE * SIZE], ramp[64];
    random_source_t random = random_seed(50);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(400000); round++) {
        static const int windows[] = {1, 16, 240, 1024};
        const int32_t window = windows[random_between(&random, 0, 3)], low = (window * 16 - GUARD_SPAN) / 2,
                      high = low + GUARD_SPAN - 1;
        vertex_t v[3];
        for (int i = 0; i < 3; i++) {
            int32_t at[2];
            for (int j = 0; j < 2; j++) {
                static const int32_t small[] = {0, 1, 2, 15, 16, 256, 510, 511};
                switch (round % 4) {
                case 0: at[j] = random_one_in(&random, 2) ? low : high; break;
                case 1:
                    at[j] = random_one_in(&random, 3) ? 8 : random_one_in(&random, 2) ? low + random_between(&random, 0, 1) : high;
                    break;
                case 2: at[j] = small[random_between(&random, 0, 7)]; break;
                default: at[j] = high - small[random_between(&random, 0, 7)]; break;
                }
            }
            const uint32_t z = random_one_in(&random, 2)   ? VERTEX_DEPTH_MIN
                               : random_one_in(&random, 2) ? 65529u * 256
                                                           : VERTEX_DEPTH_MIN + (1u << 17) - 1;
            v[i] = (vertex_t){(int16_t)at[0], (int16_t)at[1], z << 8 | (random_one_in(&random, 2) ? LIGHT_MIN : LIGHT_MAX)};
        }
        const int32_t area = (v[2].x - v[0].x) * (v[1].y - v[0].y) - (v[1].x - v[0].x) * (v[2].y - v[0].y);
        if (area == 0) { continue; }
        if (area < 0) {
            const vertex_t swap = v[1];
            v[1] = v[2];
            v[2] = swap;
        }
        const int top = v[1].y < v[0].y && v[1].y <= v[2].y ? 1 : v[2].y < v[0].y && v[2].y <= v[1].y ? 2 : 0;
        const vertex_t *v0 = &v[top], *v1 = &v[(top + 1) % 3], *v2 = &v[(top + 2) % 3];
        const int32_t begin = edge_row(v0->y), end = edge_row(v1->y > v2->y ? v1->y : v2->y);
        if (begin >= end) { continue; }
        const int32_t first = random_one_in(&random, 3)   ? INT16_MIN
                              : random_one_in(&random, 2) ? end - 1
                                                          : random_between(&random, begin, end - 1);
        triangle_t t;
        triangle_start(&t, v0, v1, v2, first, true);
        t.value = 1;
        const int32_t left = random_one_in(&random, 2) ? t.head.left : random_between(&random, t.head.left, t.head.right);
        const raster_tile_t tile = {depth, colour, left, t.row, left + SIZE, t.row + SIZE, SIZE};
        memset(depth, 0, sizeof depth);
        triangle_fill(&t, &tile, SPAN_GOURAUD, random_one_in(&random, 2), ramp);
        triangle_skip(&t, INT16_MAX);
        assert_int_equal(t.row, t.head.row_end);
        for (int i = 0; i < SIZE * SIZE; i++) {
            assert_true(depth[i] == 0 || (depth[i] >= 2 && depth[i] <= 65529));
        }
    }
}

static void polygons_at_the_ends_of_everything(void **state) {
    enum { SIZE = 16 };
    static uint16_t depth[SIZE * SIZE];
    static uint32_t ids[SIZE * SIZE];
    random_source_t random = random_seed(51);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(100000); round++) {
        static const int windows[] = {1, 16, 240, 1024};
        const int32_t window = windows[random_between(&random, 0, 3)], low = (window * 16 - GUARD_SPAN) / 2,
                      high = low + GUARD_SPAN - 1;
        vertex_t v[24];
        const uint32_t count = (uint32_t)random_between(&random, 4, 24);
        for (uint32_t i = 0; i < count; i++) {
            const int32_t x = random_one_in(&random, 4)   ? 8
                              : random_one_in(&random, 2) ? low + random_between(&random, 0, 1)
                                                          : high;
            const int32_t y = random_one_in(&random, 4)   ? 8
                              : random_one_in(&random, 2) ? low + random_between(&random, 0, 1)
                                                          : high;
            const uint32_t z = random_one_in(&random, 2) ? VERTEX_DEPTH_MIN : 65529u * 256;
            v[i] = (vertex_t){(int16_t)x, (int16_t)y, z << 8};
        }
        const polygon_ring_t ring = {v, NULL, NULL, count};
        polygon_t p;
        if (!polygon_start(&p, &ring, random_one_in(&random, 2) ? INT16_MIN : 0)) { continue; }
        p.value = 1;
        const int32_t left = random_one_in(&random, 2) ? p.head.left : 0;
        const raster_tile_t tile = {depth, ids, left, p.row, left + SIZE, p.row + SIZE, SIZE};
        memset(depth, 0, sizeof depth);
        polygon_fill(&p, &ring, &tile, SPAN_IDS, false);
        polygon_skip(&p, &ring, INT16_MAX);
        assert_int_equal(p.row, p.head.row_end);
        for (int i = 0; i < SIZE * SIZE; i++) {
            assert_true(depth[i] == 0 || (depth[i] >= 2 && depth[i] <= 65529));
        }
    }
}

/* Scenes at the ends of their number formats: whatever transform_make lets pass must go through vertex stage, clipper and culling.
 */
static void scenes_at_the_ends_of_their_ranges(void **state) {
    random_source_t random = random_seed(52);
    unsigned made = 0, refused = 0, clipped = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(200000); round++) {
        enum { COUNT = 8 };
        static const int16_t ends[] = {-32767, 32767, 0, 1, -1, INT16_MIN};
        static const q16_16_t lengths[] = {1, INT32_MAX, INT32_MIN, 0, -1, 65536, -65536, 1 << 24};
        const tuile_light_t lights[2] = {{{TUILE_ONE_Q14, TUILE_ONE_Q14, TUILE_ONE_Q14}, 255},
                                         {{INT16_MIN, INT16_MIN, INT16_MAX}, 255}};
        tuile_model_t model;
        tuile_instance_t instance;
        tuile_scene_t scene;
        transform_t transform;
        memset(&model, 0, sizeof model);
        memset(&instance, 0, sizeof instance);
        memset(&scene, 0, sizeof scene);
#define ANY(array) ((array)[random_between(&random, 0, CHECK_COUNT(array) - 1)])
        model.radius = 57000; /* round the origin it holds every position but INT16_MIN's corners */
        model.step = (tuile_scale_t){random_one_in(&random, 2) ? 1 : UINT32_MAX, random_between(&random, -60, 30)};
        if (random_one_in(&random, 20)) { model.step.exponent = random_one_in(&random, 2) ? -1000 : 1000; }
        instance.pose.scale = (tuile_scale_t){random_one_in(&random, 2) ? 1 : UINT32_MAX, random_between(&random, -30, 20)};
        instance.model = &model;
        for (int i = 0; i < 3; i++) {
            model.offset[i] = random_one_in(&random, 2) ? 0 : random_one_in(&random, 2) ? 1 << 30 : -(1 << 30);
            instance.pose.translation[i] = random_one_in(&random, 2) ? 0 : ANY(lengths);
            scene.camera.eye[i] = random_one_in(&random, 2) ? 0 : ANY(lengths);
        }
        tuile_rotation(instance.pose.rotation, random_between(&random, 0, 2), (bam16_t)random_between(&random, 0, 65535));
        tuile_rotation(scene.camera.rotation, random_between(&random, 0, 2), (bam16_t)random_between(&random, 0, 65535));
        scene.instances = &instance;
        scene.instance_count = 1;
        scene.lights = lights;
        scene.light_count = 2;
        scene.ambient = 255;
        scene.camera.projection = random_one_in(&random, 2) ? TUILE_PERSPECTIVE : TUILE_ORTHOGRAPHIC;
        scene.camera.focal_x = ANY(lengths);
        scene.camera.focal_y = ANY(lengths);
        scene.camera.centre_x = ANY(lengths);
        scene.camera.centre_y = ANY(lengths);
        scene.camera.near = ANY(lengths);
        scene.camera.far = ANY(lengths);
        const uint16_t size = random_one_in(&random, 2) ? 1 : TUILE_WINDOW_MAX_PX;
        if (transform_make(&transform, &scene, &instance, size, size) != TUILE_OK) {
            refused++;
            continue;
        }
        made++;
        const transform_region_t region = {0, 0, size, size};
        transform_region(&transform, &region);
        int16_t q[COUNT][3];
        int8_t normals[COUNT][3];
        uint8_t corners[COUNT];
        vertex_t vertices[COUNT], out[64];
        for (int i = 0; i < COUNT; i++) {
            corners[i] = (uint8_t)i;
            for (int j = 0; j < 3; j++) {
                q[i][j] = random_one_in(&random, 2) ? ends[random_between(&random, 0, 4)]
                                                    : (int16_t)random_between(&random, -32767, 32767);
                normals[i][j] = random_one_in(&random, 2) ? -128 : 127;
            }
        }
        (void)vertex_stage(&transform, q[0], normals[0], COUNT, vertices);
        const clip_face_t face = {q[0], NULL, vertices, corners, COUNT};
        const int count = clip_polygon(&transform, &face, out, 64);
        assert_true(count >= 0);
        clipped += count > 0;
        for (int i = 0; i < count; i++) {
            assert_true(out[i].x >= transform.guard_x && out[i].x < transform.guard_x + GUARD_SPAN);
            assert_true(out[i].y >= transform.guard_y && out[i].y < transform.guard_y + GUARD_SPAN);
            assert_true(out[i].depth_light >> 8 >= VERTEX_DEPTH_MIN && out[i].depth_light >> 8 <= 65529 * 256);
            assert_true((out[i].depth_light & 0xff) >= LIGHT_MIN && (out[i].depth_light & 0xff) <= LIGHT_MAX);
        }
        uint8_t cluster[MODEL_CLUSTER_BYTES];
        for (size_t i = 0; i < sizeof cluster; i++) {
            cluster[i] = random_one_in(&random, 2) ? 0xff : random_one_in(&random, 2) ? 0x7f : 0x80;
        }
        (void)cull_outside(&transform, cluster);
        cluster[CLUSTER_AT_CUTOFF] = 254;
        if (transform.eye_shift < 32) { (void)cull_faces_away(&transform, cluster); } /* more: see below */
    }
    print_message("extreme scenes: %u made, %u refused, %u with something left of the face\n", made, refused, clipped);
    assert_true(made > 100 && clipped > 10);
}

/* An eye 2^55 steps away. */
static void farthest_eye(void) {
    static tuile_model_t model;
    static tuile_instance_t instance;
    static tuile_scene_t scene;
    transform_t transform;
    uint8_t cluster[MODEL_CLUSTER_BYTES] = {0};
    model.radius = 57000;
    model.step = (tuile_scale_t){1, -45};
    instance.model = &model;
    instance.pose.scale = TUILE_SCALE_ONE;
    tuile_rotation(instance.pose.rotation, 0, 0);
    tuile_rotation(scene.camera.rotation, 0, 0);
    scene.camera.eye[2] = 1 << 26;
    scene.camera.focal_x = scene.camera.focal_y = 1 << 20;
    scene.camera.near = 1 << 16;
    scene.camera.far = INT32_MAX;
    scene.instances = &instance;
    scene.instance_count = 1;
    if (transform_make(&transform, &scene, &instance, 64, 64) != TUILE_OK) { return; }
    cluster[CLUSTER_AT_AXIS + 2] = 127;
    if (cull_faces_away(&transform, cluster)) { abort(); } /* it faces the eye */
}

static void an_eye_too_far_away_is_not_shifted_by_more_than_31(void **state) {
    (void)state;
    assert_true(check_survives(farthest_eye));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_across_the_guard_span),
        cmocka_unit_test(wide_edges_across_the_coordinates),
        cmocka_unit_test(short_edges_at_the_ends_of_the_coordinates),
        cmocka_unit_test(a_short_edge_at_its_stated_left_end_does_not_overflow),
        cmocka_unit_test(triangles_at_the_ends_of_everything),
        cmocka_unit_test(polygons_at_the_ends_of_everything),
        cmocka_unit_test(scenes_at_the_ends_of_their_ranges),
        cmocka_unit_test(an_eye_too_far_away_is_not_shifted_by_more_than_31),
    };
    return cmocka_run_group_tests_name("bounds", tests, NULL, NULL);
}
