/* Clipping: the cases of Sutherland-Hodgman by hand, and fuzz across the near plane and the guard band against long double. */
#include "support/check.h"

#include <math.h>

#include "../raster/fill/polygon.h"
#include "../raster/geometry/clip.h"
#include "../raster/geometry/vector.h"
#include "reference/coverage_reference.h"
#include "support/random.h"

#define POINTS_MAX 64

typedef struct view {
    tuile_model_t model;
    tuile_instance_t instance;
    tuile_scene_t scene;
    transform_t transform;
    int32_t width, height;
} view_t;

static void view_clear(view_t *v, int32_t width, int32_t height) {
    memset(v, 0, sizeof *v);
    v->width = width;
    v->height = height;
    v->model.step = TUILE_SCALE_ONE;
    v->model.radius = 57000;
    v->instance.model = &v->model;
    v->instance.pose.scale = TUILE_SCALE_ONE;
    tuile_rotation(v->instance.pose.rotation, 0, 0);
    tuile_rotation(v->scene.camera.rotation, 0, 0);
    v->scene.instances = &v->instance;
    v->scene.instance_count = 1;
    v->scene.camera.focal_x = v->scene.camera.focal_y = TUILE_Q16(1);
}

static void view_make(view_t *v) {
    assert_int_equal(transform_make(&v->transform, &v->scene, &v->instance, (uint16_t)v->width, (uint16_t)v->height), TUILE_OK);
}

/* A window of 64 x 48 pixels, orthographic, one pixel a unit, y up; units count from the window's corner. The guard band: x from
 * 32 - 1024 = -992 to 1056, y from 24 - 1024 = -1000 to 1048; faces are cut half a pixel inside of it. */
static void flat_view(view_t *v) {
    view_clear(v, 64, 48);
    v->scene.camera.projection = TUILE_ORTHOGRAPHIC;
    v->scene.camera.near = TUILE_Q16(1);
    v->scene.camera.far = TUILE_Q16(1001);
    v->instance.pose.translation[2] = TUILE_Q16(-501);
    view_make(v);
}

enum { GUARD_LEFT = -992 * 16 + 8, GUARD_RIGHT = 1056 * 16 - 8, GUARD_TOP = -1000 * 16 + 8, GUARD_BOTTOM = 1048 * 16 - 8 };

static int clip(const view_t *v, const int16_t (*q)[3], unsigned count, vertex_t *vertices, vertex_t *out, unsigned capacity) {
    uint8_t corners[POINTS_MAX];
    (void)vertex_stage(&v->transform, q[0], NULL, count, vertices);
    for (unsigned i = 0; i < count; i++) {
        corners[i] = (uint8_t)i;
    }
    const clip_face_t face = {q[0], NULL, vertices, corners, count};
    return clip_polygon(&v->transform, &face, out, capacity);
}

/* Clips and expects these points, in order, from any of them on. Window units are 1/16 pixel; y of the model points up. */
static void check_clip(const int16_t (*q)[3], unsigned count, const int32_t (*expected)[2], int expected_count) {
    view_t v;
    vertex_t vertices[POINTS_MAX], out[POINTS_MAX];
    flat_view(&v);
    const int got = clip(&v, q, count, vertices, out, POINTS_MAX);
    assert_int_equal(got, expected_count);
    int turn = 0;
    for (; turn < got; turn++) {
        int same = 0;
        for (; same < got; same++) {
            const vertex_t *p = &out[(same + turn) % got];
            /* halving ends within a unit of the fine grid, so what is cut may be snapped to either side of a tie */
            if (abs(p->x - expected[same][0]) > 1 || abs(p->y - expected[same][1]) > 1) { break; }
        }
        if (same == got) { return; }
    }
    for (int i = 0; i < got; i++) {
        print_message("(%d, %d) expected (%d, %d)\n", out[i].x, out[i].y, (int)expected[i][0], (int)expected[i][1]);
    }
    assert_true(got == 0);
}

static void a_triangle_inside_is_left_alone(void **state) {
    static const int16_t q[3][3] = {{0, 0, 0}, {40, 0, 0}, {0, -30, 0}};
    static const int32_t expected[][2] = {{0, 0}, {640, 0}, {0, 480}};
    (void)state;
    check_clip(q, 3, expected, 3);
}

static void a_triangle_cut_at_one_corner_is_a_quadrilateral(void **state) {
    /* left corner at x = -1992; the cut at -991.5 is 1000.5 / 2000 of the way */
    static const int16_t q[3][3] = {{-1992, 0, 0}, {8, 100, 0}, {8, -100, 0}};
    static const int32_t expected[][2] = {{GUARD_LEFT, 800}, {GUARD_LEFT, -800}, {128, -1600}, {128, 1600}};
    (void)state;
    check_clip(q, 3, expected, 4);
}

static void a_triangle_cut_at_two_corners_is_a_triangle(void **state) {
    static const int16_t q[3][3] = {{2104, 1000, 0}, {8, 0, 0}, {2104, -1000, 0}};
    /* (1055.5 - 8) / 2096 * 1000 = 499.76 */
    static const int32_t expected[][2] = {{GUARD_RIGHT, -7996}, {128, 0}, {GUARD_RIGHT, 7996}};
    (void)state;
    check_clip(q, 3, expected, 3);
}

static void a_triangle_cut_by_two_planes_is_a_pentagon(void **state) {
    /* beyond the left side with one corner, below with another */
    static const int16_t q[3][3] = {{-1992, 0, 0}, {8, 0, 0}, {8, -2048, 0}};
    /* hypotenuse: y = (x + 1992) * 2048 / 2000, at x = -991.5: 1024.51; below at y = 1047.5: x = -1992 + 1022.95 = -969.05 */
    static const int32_t expected[][2] = {
        {GUARD_LEFT, 16392}, {GUARD_LEFT, 0}, {128, 0}, {128, GUARD_BOTTOM}, {-15505, GUARD_BOTTOM}};
    (void)state;
    check_clip(q, 3, expected, 5);
}

static void what_is_cut_off_entirely_is_nothing(void **state) {
    static const int16_t q[3][3] = {{-3000, 0, 0}, {-1000, 100, 0}, {-1500, -100, 0}},
                         deep[3][3] = {{0, 0, 501}, {9, 9, 600}, {5, 9, 800}};
    static const int16_t round_the_corner[3][3] = {{-3000, -900, 0}, {-900, -3000, 0}, {-3000, -3000, 0}};
    (void)state;
    check_clip(q, 3, NULL, 0);
    check_clip(deep, 3, NULL, 0);
    check_clip(round_the_corner, 3, NULL, 0);
}

static void a_polygon_round_the_guard_band_becomes_its_corners(void **state) {
    static const int16_t q[4][3] = {{-9000, 9000, 0}, {-9000, -9000, 0}, {9000, -9000, 0}, {9000, 9000, 0}};
    static const int32_t expected[][2] = {
        {GUARD_LEFT, GUARD_TOP}, {GUARD_LEFT, GUARD_BOTTOM}, {GUARD_RIGHT, GUARD_BOTTOM}, {GUARD_RIGHT, GUARD_TOP}};
    (void)state;
    check_clip(q, 4, expected, 4);
}

/* Half a pixel of centre puts x = -992 exactly on the plane: it is inside, and nothing is added. */
static void a_vertex_on_the_plane_is_inside(void **state) {
    static const int16_t q[3][3] = {{-992, 0, 0}, {8, 100, 0}, {8, -100, 0}};
    view_t v;
    vertex_t vertices[3], out[8];
    (void)state;
    flat_view(&v);
    v.scene.camera.centre_x = TUILE_Q16(0.5);
    view_make(&v);
    assert_int_equal(clip(&v, q, 3, vertices, out, 8), 3);
    assert_int_equal(vertices[0].x, VERTEX_OUTSIDE); /* it went through the clipper */
    assert_int_equal(out[0].x, GUARD_LEFT);
    v.scene.camera.centre_x = TUILE_Q16(0.4375); /* a sixteenth further out */
    view_make(&v);
    assert_int_equal(clip(&v, q, 3, vertices, out, 8), 4);
}

/* Front and back: a triangle that leads from before the near plane to behind the far plane keeps its middle. */
static void near_and_far_plane_cut_a_band(void **state) {
    static const int16_t q[3][3] = {{0, 0, 1500}, {40, 0, -1500}, {0, 40, -1500}};
    /* depth runs over 3000 units; what lies within 500 of the origin is kept: 1/3 ... 2/3 of the way */
    static const int32_t expected[][2] = {{213, 0}, {427, 0}, {0, -427}, {0, -213}};
    (void)state;
    check_clip(q, 3, expected, 4);
}

static void a_polygon_that_is_not_convex_keeps_its_prongs(void **state) {
    static const int16_t q[8][3] = {{20, 40, 0},  {-2000, 40, 0},  {-2000, 20, 0},  {10, 20, 0},
                                    {10, -20, 0}, {-2000, -20, 0}, {-2000, -40, 0}, {20, -40, 0}};
    static const int32_t expected[][2] = {{320, -640}, {GUARD_LEFT, -640}, {GUARD_LEFT, -320}, {160, -320},
                                          {160, 320},  {GUARD_LEFT, 320},  {GUARD_LEFT, 640},  {320, 640}};
    (void)state;
    check_clip(q, 8, expected, 8);
}

static void too_many_vertices_are_told_and_nothing_is_written_behind(void **state) {
    random_source_t random = random_seed(40);
    unsigned overflowed = 0;
    view_t v;
    (void)state;
    flat_view(&v);
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        int16_t q[POINTS_MAX][3];
        vertex_t vertices[POINTS_MAX], out[2 * POINTS_MAX], full[2 * POINTS_MAX], guard;
        const unsigned count = (unsigned)random_between(&random, 3, 24);
        for (unsigned i = 0; i < count; i++) {
            for (int j = 0; j < 3; j++) {
                q[i][j] = (int16_t)random_between(&random, j == 2 ? -700 : -1800, j == 2 ? 700 : 1800);
            }
        }
        memset(full, 0x77, sizeof full);
        const int all = clip(&v, (const int16_t(*)[3])q, count, vertices, full, 2 * POINTS_MAX);
        assert_true(all >= 0);
        memset(&guard, 0x5a, sizeof guard);
        for (unsigned capacity = 0; capacity <= (unsigned)all + 1; capacity++) {
            memset(out, 0x5a, sizeof out);
            const int got = clip(&v, (const int16_t(*)[3])q, count, vertices, out, capacity);
            for (unsigned i = capacity; i < 2 * POINTS_MAX; i++) {
                assert_memory_equal(&out[i], &guard, sizeof guard);
            }
            if (all > 0 && capacity < (unsigned)all) {
                assert_int_equal(got, -1);
                overflowed++;
            } else if (all > 0) {
                assert_int_equal(got, all);
                assert_memory_equal(out, full, sizeof out[0] * (unsigned)all);
            }
        }
    }
    assert_true(overflowed > 1000);
}

/* ---- fuzz -----------------------------------------------------------------------------------------------------------------------
 */

typedef long double real_t;

typedef struct shape {
    real_t p[POINTS_MAX][3]; /* view space, then window x, y */
    int count;
} shape_t;

static void exact_view(const view_t *v, const int16_t q[3], real_t view[3]) {
    const tuile_camera_t *camera = &v->scene.camera;
    const tuile_pose_t *pose = &v->instance.pose;
    real_t world[3];
    for (int i = 0; i < 3; i++) {
        world[i] = ((real_t)pose->translation[i] - camera->eye[i]) / 65536;
        for (int j = 0; j < 3; j++) {
            world[i] += pose->rotation[i][j] * 0x1p-30L * ldexpl(q[j], v->model.step.exponent);
        }
    }
    for (int i = 0; i < 3; i++) {
        view[i] = 0;
        for (int j = 0; j < 3; j++) {
            view[i] += camera->rotation[i][j] * 0x1p-30L * world[j];
        }
    }
}

/* a[0] x + a[1] y + a[2] z + a[3] >= 0 stays */
static void exact_cut(shape_t *s, const real_t a[4]) {
    shape_t out;
    out.count = 0;
    for (int i = 0; i < s->count; i++) {
        const real_t *p = s->p[i], *n = s->p[(i + 1) % s->count];
        const real_t dp = a[0] * p[0] + a[1] * p[1] + a[2] * p[2] + a[3], dn = a[0] * n[0] + a[1] * n[1] + a[2] * n[2] + a[3];
        if (dp >= 0) { memcpy(out.p[out.count++], p, sizeof out.p[0]); }
        if ((dp >= 0) != (dn >= 0)) {
            for (int k = 0; k < 3; k++) {
                out.p[out.count][k] = (p[k] * dn - n[k] * dp) / (dn - dp);
            }
            out.count++;
        }
    }
    *s = out;
}

/* The visible part in the window, with `margin` pixels round it, in pixels; perspective. */
static void exact_clip(const view_t *v, const int16_t (*q)[3], const unsigned *corners, unsigned count, real_t margin, shape_t *s) {
    const tuile_camera_t *c = &v->scene.camera;
    const real_t fx = c->focal_x / 65536.0L, fy = c->focal_y / 65536.0L, cx = c->centre_x / 65536.0L, cy = c->centre_y / 65536.0L;
    s->count = (int)count;
    for (unsigned i = 0; i < count; i++) {
        exact_view(v, q[corners[i]], s->p[i]);
    }
    exact_cut(s, (const real_t[4]){0, 0, -1, -c->near / 65536.0L});
    exact_cut(s, (const real_t[4]){0, 0, 1, c->far / 65536.0L});
    /* left: cx + fx x / w >= -margin, w = -z */
    exact_cut(s, (const real_t[4]){fx, 0, -(cx + margin), 0});
    exact_cut(s, (const real_t[4]){-fx, 0, -(v->width + margin - cx), 0});
    exact_cut(s, (const real_t[4]){0, -fy, -(cy + margin), 0});
    exact_cut(s, (const real_t[4]){0, fy, -(v->height + margin - cy), 0});
    for (int i = 0; i < s->count; i++) {
        const real_t w = -s->p[i][2];
        s->p[i][0] = cx + fx * s->p[i][0] / w;
        s->p[i][1] = cy - fy * s->p[i][1] / w;
    }
}

static real_t distance_to_side(const real_t a[2], const real_t b[2], real_t x, real_t y) {
    const real_t dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
    real_t t = length > 0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / length : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypotl(x - a[0] - t * dx, y - a[1] - t * dy);
}

static real_t distance_to_shape(const shape_t *s, real_t x, real_t y) {
    real_t least = 1e9L;
    for (int i = 0; i < s->count; i++) {
        least = fminl(least, distance_to_side(s->p[i], s->p[(i + 1) % s->count], x, y));
    }
    return least;
}

static bool shape_contains(const shape_t *s, real_t x, real_t y) {
    bool inside = false;
    for (int i = 0; i < s->count; i++) {
        const real_t *a = s->p[i], *b = s->p[(i + 1) % s->count];
        if ((a[1] <= y) != (b[1] <= y) && a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]) <= x) { inside = !inside; }
    }
    return inside;
}

static void shape_of_vertices(shape_t *s, const vertex_t *vertices, int count) {
    s->count = count;
    for (int i = 0; i < count; i++) {
        s->p[i][0] = vertices[i].x / 16.0L;
        s->p[i][1] = vertices[i].y / 16.0L;
    }
}

/* A camera anywhere, a triangle of -reach ... reach units round it: most cross near plane and guard band. The third of rounds is a
 * ground plane just below the eye, or through it. */
static bool random_view(random_source_t *random, view_t *v, int16_t (*q)[3], int count) {
    static const int reaches[] = {3, 100, 1000, 30000};
    const int reach = reaches[random_between(random, 0, 3)];
    const bool ground = random_one_in(random, 3);
    view_clear(v, 48, 36);
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < 3; j++) {
            q[i][j] = (int16_t)random_between(random, -reach, reach);
        }
        if (ground) { q[i][1] = 0; }
    }
    v->model.step.exponent = reach == 3 ? -2 : 0;
    for (int i = 0; i < count && reach == 3; i++) {
        for (int j = 0; j < 3; j++) {
            q[i][j] = (int16_t)(q[i][j] * 4 + (ground && j == 1 ? 0 : random_between(random, -2, 2)));
        }
    }
    tuile_camera_t *camera = &v->scene.camera;
    const q16_16_t eye[3] = {random_between(random, -65536, 65536),
                             ground ? random_between(random, 0, 3) * 65536 : random_between(random, -65536, 65536),
                             random_between(random, -65536, 65536)};
    const q16_16_t at[3] = {random_between(random, -5 * 65536, 5 * 65536), random_between(random, -5 * 65536, 5 * 65536),
                            random_between(random, -5 * 65536, 5 * 65536)};
    if (tuile_camera_look_at(camera, eye, at, (const q16_16_t[3]){0, 65536, 0}) != TUILE_OK) { return false; }
    camera->focal_x = random_between(random, 20 * 65536, 100 * 65536);
    camera->focal_y = random_between(random, 20 * 65536, 100 * 65536);
    camera->centre_x = TUILE_Q16(24);
    camera->centre_y = TUILE_Q16(18);
    camera->near = random_one_in(random, 2) ? TUILE_Q16(0.1) : TUILE_Q16(1);
    camera->far = random_one_in(random, 2) ? TUILE_Q16(60) : TUILE_Q16(32000);
    return transform_make(&v->transform, &v->scene, &v->instance, 48, 36) == TUILE_OK;
}

static void clipped_triangles_keep_their_shape_in_the_window(void **state) {
    random_source_t random = random_seed(41);
    real_t worst = 0;
    unsigned seen = 0, vanished = 0, clipped = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(60000); round++) {
        view_t v;
        int16_t q[3][3];
        vertex_t vertices[3], out[POINTS_MAX];
        shape_t exact, got;
        static const unsigned corners[3] = {0, 1, 2};
        if (!random_view(&random, &v, q, 3)) { continue; }
        const int count = clip(&v, (const int16_t(*)[3])q, 3, vertices, out, POINTS_MAX);
        assert_true(count >= 0 && count <= 9);
        exact_clip(&v, (const int16_t(*)[3])q, corners, 3, 8, &exact);
        shape_of_vertices(&got, out, count);
        clipped += vertices[0].x == VERTEX_OUTSIDE || vertices[1].x == VERTEX_OUTSIDE || vertices[2].x == VERTEX_OUTSIDE;
        seen += exact.count > 0;
        bool covers = false;
        /* Centres further than 1/16 px from all edges are inside both or outside both. */
        for (int y = 0; y < v.height; y++) {
            for (int x = 0; x < v.width; x++) {
                const real_t px = x + 0.5L, py = y + 0.5L;
                const bool inside = shape_contains(&exact, px, py);
                covers |= inside;
                if (inside == shape_contains(&got, px, py)) { continue; }
                const real_t away = distance_to_shape(&exact, px, py);
                worst = fmaxl(worst, away);
                assert_true(away <= 1 / 16.0L);
            }
        }
        /* Points along the exact edges, in the window, lie on an edge of what came out. */
        for (int i = 0; i < exact.count && count > 0; i++) {
            const real_t *a = exact.p[i], *b = exact.p[(i + 1) % exact.count];
            for (int t = 1; t < 8; t++) {
                const real_t x = a[0] + (b[0] - a[0]) * t / 8, y = a[1] + (b[1] - a[1]) * t / 8;
                if (x < 0 || y < 0 || x > v.width || y > v.height) { continue; }
                const real_t away = distance_to_shape(&got, x, y);
                worst = fmaxl(worst, away);
                assert_true(away <= 1 / 16.0L);
            }
        }
        vanished += count == 0 && covers;
    }
    print_message("clip: %u triangles in the window, %u clipped; deviation %.5Lf px; %u vanished\n", seen, clipped, worst,
                  vanished);
    assert_int_equal(vanished, 0);
    assert_true(seen > 500 && clipped > 1000);
}

/* The sides of two faces on a common edge: the point where it leaves is the same, to the last bit of depth. */
static void a_shared_edge_is_cut_at_one_point(void **state) {
    random_source_t random = random_seed(42);
    unsigned shared = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(200000); round++) {
        view_t v;
        int16_t q[4][3];
        vertex_t vertices[4], out[2][POINTS_MAX];
        static const uint8_t faces[2][3] = {{0, 1, 2}, {1, 0, 3}};
        int count[2];
        if (!random_view(&random, &v, q, 4)) { continue; }
        (void)vertex_stage(&v.transform, q[0], NULL, 4, vertices);
        if (vertices[0].x == VERTEX_OUTSIDE || vertices[1].x != VERTEX_OUTSIDE) { continue; }
        for (int f = 0; f < 2; f++) {
            const clip_face_t face = {q[0], NULL, vertices, faces[f], 3};
            count[f] = clip_polygon(&v.transform, &face, out[f], POINTS_MAX);
        }
        /* Corner 0 is inside. What follows it in the first face is the cut, and so is what precedes it in the second. */
        vertex_t cut[2];
        bool found = true;
        for (int f = 0; f < 2; f++) {
            int at = -1, times = 0;
            for (int i = 0; i < count[f]; i++) {
                if (memcmp(&out[f][i], &vertices[0], sizeof vertices[0]) == 0) { at = i, times++; }
            }
            found &= times == 1;
            if (times == 1) { cut[f] = out[f][(at + (f ? count[f] - 1 : 1)) % count[f]]; }
        }
        if (!found) { continue; }
        assert_memory_equal(&cut[0], &cut[1], sizeof cut[0]);
        shared++;
    }
    print_message("shared edges: %u\n", shared);
    assert_true(shared > (CHECK_SANITIZED ? 50 : 1000));
}

static void mark(void *context, int32_t row, int32_t first, int32_t end) {
    uint8_t *hits = context;
    for (int32_t x = first; x < end; x++) {
        hits[row * 48 + x]++;
    }
}

/* Two faces of one plane on either side of an edge, each clipped alone: in their union, but for its rim, each pixel is met once. */
static void no_crack_and_no_overlap_along_a_wide_common_edge(void **state) {
    random_source_t random = random_seed(44);
    unsigned along = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(60000); round++) {
        view_t v;
        int16_t q[4][3];
        vertex_t vertices[4];
        static const unsigned ring_of_both[4] = {0, 3, 1, 2}, corners[2][3] = {{0, 1, 2}, {1, 0, 3}};
        shape_t both;
        uint8_t hits[48 * 36] = {0};
        if (!random_view(&random, &v, q, 4)) { continue; }
        bool fits = true;
        for (int j = 0; j < 3; j++) {
            const int32_t p = q[0][j] + q[1][j] - q[2][j];
            fits &= abs(p) < 32768;
            q[3][j] = (int16_t)p;
        }
        if (!fits) { continue; }
        (void)vertex_stage(&v.transform, q[0], NULL, 4, vertices);
        for (int f = 0; f < 2; f++) {
            vertex_t out[POINTS_MAX];
            const uint8_t bytes[3] = {(uint8_t)corners[f][0], (uint8_t)corners[f][1], (uint8_t)corners[f][2]};
            const clip_face_t face = {q[0], NULL, vertices, bytes, 3};
            const int count = clip_polygon(&v.transform, &face, out, POINTS_MAX);
            const polygon_ring_t ring = {out, NULL, NULL, (uint32_t)count};
            polygon_chain_t chains[8];
            if (count > 0) { polygon_coverage(&ring, 48, 36, chains, 8, mark, hits); }
        }
        /* The quadrilateral is a parallelogram, so its exact part is one convex shape. */
        exact_clip(&v, (const int16_t(*)[3])q, ring_of_both, 4, 8, &both);
        for (int i = 0; i < 48 * 36; i++) {
            const real_t x = i % 48 + 0.5L, y = i / 48 + 0.5L;
            if (hits[i] == 1 || !shape_contains(&both, x, y) || distance_to_shape(&both, x, y) <= 1 / 8.0L) { continue; }
            assert_int_equal(hits[i], 1);
        }
        for (int i = 0; i < 48 * 36; i++) {
            along += hits[i];
        }
    }
    assert_true(along > 10000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_triangle_inside_is_left_alone),
        cmocka_unit_test(a_triangle_cut_at_one_corner_is_a_quadrilateral),
        cmocka_unit_test(a_triangle_cut_at_two_corners_is_a_triangle),
        cmocka_unit_test(a_triangle_cut_by_two_planes_is_a_pentagon),
        cmocka_unit_test(what_is_cut_off_entirely_is_nothing),
        cmocka_unit_test(a_polygon_round_the_guard_band_becomes_its_corners),
        cmocka_unit_test(a_vertex_on_the_plane_is_inside),
        cmocka_unit_test(near_and_far_plane_cut_a_band),
        cmocka_unit_test(a_polygon_that_is_not_convex_keeps_its_prongs),
        cmocka_unit_test(too_many_vertices_are_told_and_nothing_is_written_behind),
        cmocka_unit_test(clipped_triangles_keep_their_shape_in_the_window),
        cmocka_unit_test(a_shared_edge_is_cut_at_one_point),
        cmocka_unit_test(no_crack_and_no_overlap_along_a_wide_common_edge),
    };
    return cmocka_run_group_tests_name("clip", tests, NULL, NULL);
}
