/* The way of a vertex to the window, and its light, against long double. */
#include "support/check.h"

#include <math.h>

#include "../raster/geometry/model.h"
#include "../raster/geometry/transform.h"
#include "../raster/geometry/vertex.h"
#include "support/random.h"
#include "support/set_up.h"

/* ---- from the model to the window ------------------------------------------------------------------------------------------ */

/* The position next to a point of the view; left alone where there is none in 16 bits. */
static void aim(const set_up_t *s, const long double view[3], int16_t q[3]) {
    const tuile_pose_t *pose = &s->instance.pose;
    const tuile_camera_t *camera = &s->scene.camera;
    long double world[3];
    for (int i = 0; i < 3; i++) {
        world[i] = camera->eye[i] / 65536.0L - pose->translation[i] / 65536.0L;
        for (int j = 0; j < 3; j++) {
            world[i] += camera->rotation[j][i] * 0x1p-30L * view[j];
        }
    }
    for (int i = 0; i < 3; i++) {
        long double at = 0;
        for (int j = 0; j < 3; j++) {
            at += pose->rotation[j][i] * 0x1p-30L * world[j];
        }
        at = ldexpl(at / pose->scale.mantissa / s->model.step.mantissa, -pose->scale.exponent - s->model.step.exponent) -
             s->model.offset[i];
        if (fabsl(at) < 32767) { q[i] = (int16_t)lroundl(at); }
    }
}

/* What is known of a cluster's sphere changes none of its vertices. Returns whether some of them are in the window. */
static bool check_in_sphere(random_source_t *random, transform_t *transform, const int16_t centre[3]) {
    enum { VERTICES = 8 };
    const int32_t reach = random_between(random, 0, 1 << random_between(random, 0, 15));
    const int32_t radius = (reach * 7 + 3) / 4; /* at least sqrt(3) times as much */
    uint8_t cluster[MODEL_CLUSTER_BYTES] = {0};
    int16_t q[VERTICES][3];
    vertex_t alone[VERTICES], together[VERTICES];
    bool inside = false;
    if (radius > UINT16_MAX) { return false; }
    for (int i = 0; i < 3; i++) {
        cluster[CLUSTER_AT_CENTRE + 2 * i] = (uint8_t)centre[i];
        cluster[CLUSTER_AT_CENTRE + 2 * i + 1] = (uint8_t)((uint16_t)centre[i] >> 8);
        for (int v = 0; v < VERTICES; v++) { /* the corners of a box, and what lies between */
            const int32_t to = v < 4 ? (v >> i & 1 ? reach : -reach) : random_between(random, -reach, reach), at = centre[i] + to;
            q[v][i] = (int16_t)(at < -32767 ? -32767 : at > 32767 ? 32767 : at);
        }
    }
    cluster[CLUSTER_AT_RADIUS] = (uint8_t)radius;
    cluster[CLUSTER_AT_RADIUS + 1] = (uint8_t)(radius >> 8);
    (void)vertex_stage(transform, q[0], NULL, VERTICES, alone);
    (void)vertex_stage_region(transform, cluster, q[0], NULL, VERTICES, together);
    assert_memory_equal(alone, together, sizeof alone);
    for (int v = 0; v < VERTICES; v++) {
        inside |= alone[v].x != VERTEX_OUTSIDE;
    }
    return inside;
}

static void one_vertex_by_hand(void **state) {
    set_up_t s;
    transform_t transform;
    vertex_t v[2];
    (void)state;
    set_up_simple(&s);
    s.scene.camera.focal_y = TUILE_Q16(50); /* pixels twice as high as wide */
    assert_int_equal(set_up_transform(&s, &transform), TUILE_OK);
    /* (4, 2, -8): x = 160 + 100 * 4 / 8 = 210, y = 120 - 50 * 2 / 8 = 107.5, depth = 65528 / 8 = 8191 */
    static const int16_t q[6] = {4 * 256, 2 * 256, -8 * 256, 0, 0, -256};
    vertex_stage(&transform, q, NULL, 2, v);
    assert_int_equal(v[0].x, 210 * 16);
    assert_int_equal(v[0].y, 107 * 16 + 8);
    assert_true(labs((long)(v[0].depth_light >> 8) - 8191 * 256) <= 256);
    assert_int_equal(v[1].x, 160 * 16); /* on the near plane, which is in */
    assert_true(labs((long)(v[1].depth_light >> 8) - 65528 * 256) <= 256);
    s.scene.camera.projection = TUILE_ORTHOGRAPHIC;
    s.scene.camera.focal_x = TUILE_Q16(10);
    s.scene.camera.near = 0;
    s.scene.camera.far = TUILE_Q16(16);
    assert_int_equal(set_up_transform(&s, &transform), TUILE_OK);
    /* x = 160 + 40, y = 120 - 100, depth = 8 + 65520 * 8 / 16 */
    vertex_stage(&transform, q, NULL, 1, v);
    assert_int_equal(v[0].x, 200 * 16);
    assert_int_equal(v[0].y, 20 * 16);
    assert_true(labs((long)(v[0].depth_light >> 8) - 32768 * 256) <= 256);
}

static void vertices_land_within_their_error(void **state) {
    random_source_t random = random_seed(32);
    long double worst[2] = {0, 0}, worst_depth[2] = {0, 0};
    unsigned made[2] = {0, 0}, inside[2] = {0, 0}, outside[2] = {0, 0}, refused = 0, in_spheres = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(40000); round++) {
        enum { COUNT = 24 };
        set_up_t s;
        transform_t transform;
        set_up_simple(&s);
        const int ortho = round % 2, steps = random_between(&random, -20, 10);
        const long double step = ldexpl(1, steps); /* world units a step, when all is multiplied */
        const long double size = step * 20000;
        s.model.step = (tuile_scale_t){(uint32_t)random_between(&random, 1, 1 << 20), 0};
        s.instance.pose.scale = (tuile_scale_t){(uint32_t)random_between(&random, 1, INT32_MAX), 0};
        s.model.step.exponent = random_between(&random, -60, 60);
        s.instance.pose.scale.exponent =
            steps - s.model.step.exponent - (int32_t)log2((double)s.model.step.mantissa * s.instance.pose.scale.mantissa);
        s.model.radius = 57000;
        for (int i = 0; i < 3; i++) {
            if (random_one_in(&random, 3)) { s.model.offset[i] = (int32_t)random_any_size(&random, 30); }
        }
        random_rotation(&random, s.instance.pose.rotation);
        random_rotation(&random, s.scene.camera.rotation);
        s.width = (uint16_t)random_between(&random, 1, 1024);
        s.height = (uint16_t)random_between(&random, 1, 1024);
        tuile_camera_t *camera = &s.scene.camera;
        const double focal = random_real(&random, 0.3, 4) * s.width;
        camera->focal_x = TUILE_Q16(focal);
        camera->focal_y = TUILE_Q16(focal * random_real(&random, 0.5, 2));
        camera->centre_x = TUILE_Q16(s.width * random_real(&random, -0.5, 1.5));
        camera->centre_y = TUILE_Q16(s.height * random_real(&random, -0.5, 1.5));
        /* The model stands somewhere in front: put its origin there by the translation, as far as 16.16 can tell. */
        const long double far = fminl(30000, fmaxl(0.05L, size * (long double)exp2(random_real(&random, -2, 4))));
        const long double near = fmaxl(far / (long double)exp2(random_real(&random, 0.5, 14)), 0.01L);
        camera->near = (q16_16_t)(near * 65536);
        camera->far = (q16_16_t)(far * 65536) + 2;
        if (ortho) {
            camera->projection = TUILE_ORTHOGRAPHIC;
            const long double px = (long double)(s.width * random_real(&random, 0.2, 3)) / size;
            if (px > 15000 || px < 0.01L) { continue; }
            camera->focal_x = (q16_16_t)(px * 65536);
            camera->focal_y = (q16_16_t)(px * 65536 * (long double)random_real(&random, 0.5, 2));
            if (random_one_in(&random, 2)) { camera->near = -camera->near; }
        }
        const long double distance = fminl(far, near + size * (long double)random_real(&random, 0, 3));
        if (!set_up_stand(&s, (const int16_t[3]){0, 0, 0}, (const long double[3]){0, 0, -distance})) { continue; }
        const int error = set_up_transform(&s, &transform);
        if (error) {
            assert_int_equal(error, TUILE_ERROR_RANGE);
            refused++;
            continue;
        }
        made[ortho]++;
        int16_t q[COUNT][3];
        vertex_t v[COUNT], again[COUNT];
        for (int i = 0; i < COUNT; i++) {
            for (int j = 0; j < 3; j++) {
                q[i][j] = (int16_t)random_between(&random, -32767, 32767);
            }
            if (i % 2 == 0) { /* aimed at the window, as near as any */
                const long double n = camera->near / 65536.0L, f = camera->far / 65536.0L;
                const long double w = ortho ? (long double)random_real(&random, (double)n, (double)f)
                                            : n * exp2l((long double)random_real(&random, 0, 1) * log2l(f / n));
                const long double px = (long double)random_real(&random, 0, s.width),
                                  py = (long double)random_real(&random, 0, s.height);
                const long double scale = ortho ? 1 : w;
                aim(&s,
                    (const long double[3]){(px - camera->centre_x / 65536.0L) * scale * 65536 / camera->focal_x,
                                           (camera->centre_y / 65536.0L - py) * scale * 65536 / camera->focal_y, -w},
                    q[i]);
            }
        }
        const bool any_outside = vertex_stage(&transform, q[0], NULL, COUNT, v);
        bool found_outside = false;
        for (int i = 0; i < COUNT; i++) {
            found_outside |= v[i].x == VERTEX_OUTSIDE;
        }
        assert_int_equal(any_outside, found_outside);
        for (int i = 0; i < COUNT; i++) {
            in_spheres += check_in_sphere(&random, &transform, q[i]);
        }
        vertex_stage(&transform, q[COUNT / 2], NULL, COUNT / 2, again); /* the same positions in another cluster */
        assert_memory_equal(again, v + COUNT / 2, COUNT / 2 * sizeof v[0]);
        for (int i = 0; i < COUNT; i++) {
            long double view[3], x, y, depth;
            set_up_view(&s, q[i], view);
            set_up_window(&s, view, &x, &y, &depth);
            const long double w = -view[2], slack = 0.05L; /* of the snap */
            const long double low_x = transform.guard_x / 16.0L, low_y = transform.guard_y / 16.0L, span = GUARD_SPAN / 16.0L;
            const long double n = camera->near / 65536.0L, f = camera->far / 65536.0L, plane = (f - n) * 0x1p-15L + w * 0x1p-18L;
            const bool surely_in = w > n + plane && w < f - plane && x > low_x + 1 + slack && y > low_y + 1 + slack &&
                                   x < low_x + span - 1 - slack && y < low_y + span - 1 - slack;
            const bool surely_out = w < n - plane || w > f + plane || x < low_x + 1 - slack - 0.07L ||
                                    y < low_y + 1 - slack - 0.07L || x > low_x + span - 1 + slack + 0.07L ||
                                    y > low_y + span - 1 + slack + 0.07L;
            if (v[i].x == VERTEX_OUTSIDE) {
                assert_false(surely_in);
                outside[ortho]++;
                continue;
            }
            assert_false(surely_out);
            inside[ortho]++;
            const long double ex = fabsl(v[i].x / 16.0L - x), ey = fabsl(v[i].y / 16.0L - y);
            worst[ortho] = fmaxl(worst[ortho], fmaxl(ex, ey));
            const long double off = fabsl((long double)(v[i].depth_light >> 8) / 256 - fmaxl(depth, 2));
            worst_depth[ortho] = fmaxl(worst_depth[ortho], off);
            assert_true(ex <= 1 / 32.0L + 1 / 64.0L && ey <= 1 / 32.0L + 1 / 64.0L);
            assert_true(off <= 1);
            assert_true(v[i].depth_light >> 8 >= 512 && v[i].depth_light >> 8 <= 65529 * 256);
        }
    }
    print_message("%u clusters with vertices in the window\n", in_spheres);
    assert_true(in_spheres > made[0]);
    for (int ortho = 0; ortho < 2; ortho++) {
        print_message("%s: %u set-ups, %u vertices in, %u out; window error %.5Lf px (snap 1/32 + %.5Lf), depth %.4Lf step\n",
                      ortho ? "orthographic" : "perspective", made[ortho], inside[ortho], outside[ortho], worst[ortho],
                      worst[ortho] - 1 / 32.0L, worst_depth[ortho]);
        assert_true(inside[ortho] > made[ortho] && outside[ortho] > made[ortho] / 10);
        assert_true(made[ortho] > 50);
    }
    print_message("refused for range: %u\n", refused);
}

static void impossible_set_ups_are_refused(void **state) {
    set_up_t s, ok;
    transform_t transform;
    (void)state;
    set_up_simple(&ok);
    set_up_simple(&s);
#define REFUSED(change, error)                                     \
    do {                                                           \
        s = ok;                                                    \
        s.instance.model = &s.model;                               \
        change;                                                    \
        assert_int_equal(set_up_transform(&s, &transform), error); \
    } while (0)
    REFUSED((void)0, TUILE_OK);
    REFUSED(s.scene.camera.near = 0, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.near = -1, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.far = s.scene.camera.near, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.focal_x = 0, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.focal_y = -5, TUILE_ERROR_CAMERA);
    REFUSED(s.scene.camera.projection = (tuile_projection_t)2, TUILE_ERROR_CAMERA);
    REFUSED(s.instance.model = NULL, TUILE_ERROR_ARGUMENT);
    REFUSED(s.instance.pose.scale.mantissa = 0, TUILE_ERROR_ARGUMENT);
    REFUSED(s.instance.pose.scale.exponent = 1001, TUILE_ERROR_ARGUMENT);
    REFUSED(s.scene.light_count = TRANSFORM_LIGHTS_MAX + 1, TUILE_ERROR_ARGUMENT);
    REFUSED(s.instance.pose.scale.exponent = 60, TUILE_ERROR_RANGE);
#undef REFUSED
}

/* ---- lights -------------------------------------------------------------------------------------------------------------------
 */

static uint8_t light_of(const set_up_t *s, int nx, int ny, int nz) {
    transform_t transform;
    assert_int_equal(set_up_transform(s, &transform), TUILE_OK);
    return vertex_light(&transform, nx, ny, nz);
}

static void assert_near(int value, int expected) { assert_true(abs(value - expected) <= 1); }

static void lights_by_hand(void **state) {
    static const tuile_light_t along_z = {{0, 0, -TUILE_ONE_Q14}, 255}, half_z = {{0, 0, -TUILE_ONE_Q14}, 100};
    static const tuile_light_t oblique = {{0, -14189, -8192}, 200}; /* 60 degrees from the z axis */
    set_up_t s;
    (void)state;
    set_up_simple(&s);
    assert_int_equal(light_of(&s, 0, 0, 127), LIGHT_MIN); /* darkness is 2 */
    s.scene.ambient = 77;
    assert_int_equal(light_of(&s, 0, 0, 127), 77);
    s.scene.ambient = 255;
    assert_int_equal(light_of(&s, 0, 0, 127), LIGHT_MAX);

    s.scene.ambient = 0;
    s.scene.lights = &half_z;
    s.scene.light_count = 1;
    assert_near(light_of(&s, 0, 0, 127), 2 + 100);         /* facing; ambient is 2 at least */
    assert_int_equal(light_of(&s, 0, 0, -127), LIGHT_MIN); /* away */
    assert_int_equal(light_of(&s, 127, 0, 0), LIGHT_MIN);  /* grazing */
    assert_near(light_of(&s, 0, 110, 64), 2 + 50);         /* 60 degrees: half */
    s.scene.lights = &oblique;
    assert_near(light_of(&s, 0, 0, 127), 2 + 100);
    assert_near(light_of(&s, 0, 127, 0), 2 + 173); /* 200 cos 30 */
    s.scene.lights = &along_z;
    assert_int_equal(light_of(&s, 0, 0, 127), LIGHT_MAX); /* clamped */

    const tuile_light_t both[3] = {half_z, {{-TUILE_ONE_Q14, 0, 0}, 60}, {{TUILE_ONE_Q14, 0, 0}, 90}};
    s.scene.lights = both;
    s.scene.light_count = 3;
    s.scene.ambient = 20;
    assert_near(light_of(&s, 90, 0, 90), 20 + 70 + 42); /* 100 and 60 at 45 degrees, each floored; the third shines from behind */
    s.scene.ambient = 200;
    assert_int_equal(light_of(&s, 90, 0, 90), LIGHT_MAX);

    s.instance.two_sided = true; /* what is turned away is lit as if it were not */
    s.scene.ambient = 0;
    s.scene.lights = &half_z;
    s.scene.light_count = 1;
    assert_near(light_of(&s, 0, 0, -127), 2 + 100);

    s.instance.two_sided = false;
    tuile_rotation(s.instance.pose.rotation, 1, 0x4000); /* leads z to x: the normal along -x faces the light now */
    assert_near(light_of(&s, -127, 0, 0), 2 + 100);
    assert_int_equal(light_of(&s, 127, 0, 0), LIGHT_MIN);
}

static void lights_add_up_in_any_direction(void **state) {
    random_source_t random = random_seed(33);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        set_up_t s;
        tuile_light_t lights[TRANSFORM_LIGHTS_MAX];
        set_up_simple(&s);
        random_rotation(&random, s.instance.pose.rotation);
        s.scene.light_count = (uint8_t)random_between(&random, 0, TRANSFORM_LIGHTS_MAX);
        s.scene.lights = lights;
        s.scene.ambient = (uint8_t)random_between(&random, 0, 255);
        for (int l = 0; l < s.scene.light_count; l++) {
            q2_30_t r[3][3];
            random_rotation(&random, r);
            for (int i = 0; i < 3; i++) {
                lights[l].direction[i] = (q2_14_t)(r[0][i] >> 16);
            }
            lights[l].intensity = (uint8_t)random_between(&random, 0, 255);
        }
        const int n[3] = {random_between(&random, -127, 127), random_between(&random, -127, 127),
                          random_between(&random, -127, 127)};
        if (n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 128 * 128) { continue; }
        double sum = s.scene.ambient < LIGHT_MIN ? LIGHT_MIN : s.scene.ambient;
        for (int l = 0; l < s.scene.light_count; l++) {
            double dot = 0;
            for (int i = 0; i < 3; i++) {
                for (int j = 0; j < 3; j++) {
                    dot -= s.instance.pose.rotation[i][j] * 0x1p-30 * n[j] / 127.0 * lights[l].direction[i] / 16384.0;
                }
            }
            sum += dot > 0 ? dot * lights[l].intensity : 0;
        }
        const double expected = sum > LIGHT_MAX ? LIGHT_MAX : sum;
        /* floored for each light */
        assert_true(fabs(light_of(&s, n[0], n[1], n[2]) - expected) <= 1 + 1.05 * s.scene.light_count);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_vertex_by_hand),
        cmocka_unit_test(vertices_land_within_their_error),
        cmocka_unit_test(impossible_set_ups_are_refused),
        cmocka_unit_test(lights_by_hand),
        cmocka_unit_test(lights_add_up_in_any_direction),
    };
    return cmocka_run_group_tests_name("vertex", tests, NULL, NULL);
}
