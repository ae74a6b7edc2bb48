/* Cameras round a point, on a node, and as far away as a sphere needs, against long double. */
#include "support/check.h"

#include <math.h>

#include "../raster/scene/camera.h"
#include "support/frame.h"
#include "support/random.h"
#include "support/stage.h"

#define TURN 6.283185307179586476925286766559L

static const q16_16_t origin[3] = {0, 0, 0};

static void assert_camera(const tuile_camera_t *camera, const int rotation[3][3], int x, int y, int z) {
    const int eye[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            assert_int_equal(camera->rotation[i][j], rotation[i][j] * TUILE_ONE_Q30);
        }
        assert_int_equal(camera->eye[i], eye[i] * 65536);
    }
}

static void quarters_of_an_orbit_are_exact(void **state) {
    tuile_camera_t camera = {0};
    const q16_16_t target[3] = {1 << 16, 2 << 16, 3 << 16};
    (void)state;
    assert_int_equal(tuile_camera_orbit(&camera, target, 5 << 16, 0, 0, 0), TUILE_OK);
    assert_camera(&camera, (const int[3][3]){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1, 2, 8);
    assert_int_equal(tuile_camera_orbit(&camera, target, 5 << 16, 0x4000, 0, 0), TUILE_OK);
    assert_camera(&camera, (const int[3][3]){{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, 6, 2, 3);
    assert_int_equal(tuile_camera_orbit(&camera, target, 5 << 16, 0, 0x4000, 0), TUILE_OK);
    assert_camera(&camera, (const int[3][3]){{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 1, 7, 3);
    assert_int_equal(tuile_camera_orbit(&camera, target, 5 << 16, 0, 0, 0x4000), TUILE_OK); /* its x axis points up */
    assert_camera(&camera, (const int[3][3]){{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}, 1, 2, 8);
    assert_int_equal(tuile_camera_orbit(&camera, target, 5 << 16, 0, 0x8000, 0), TUILE_OK); /* over the pole, upside down */
    assert_camera(&camera, (const int[3][3]){{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, 1, 2, -2);
}

static void an_orbit_is_what_looking_at_the_point_is(void **state) {
    random_source_t random = random_seed(85);
    long double worst = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(100000); round++) {
        tuile_camera_t camera = {0};
        const q16_16_t target[3] = {(q16_16_t)random_any_size(&random, 30), (q16_16_t)random_any_size(&random, 30), 0};
        const q16_16_t distance = random_between(&random, 1, 1 << 30);
        const bam16_t yaw = (bam16_t)random_between(&random, 0, 65535), pitch = (bam16_t)random_between(&random, 0, 65535);
        const bam16_t roll = (bam16_t)random_between(&random, 0, 65535);
        assert_int_equal(tuile_camera_orbit(&camera, target, distance, yaw, pitch, roll), TUILE_OK);
        const long double a = yaw * TURN / 65536, b = pitch * TURN / 65536, c = roll * TURN / 65536;
        const long double back[3] = {sinl(a) * cosl(b), sinl(b), cosl(a) * cosl(b)}, right[3] = {cosl(a), 0, -sinl(a)};
        const long double up[3] = {-sinl(a) * sinl(b), cosl(b), -cosl(a) * sinl(b)};
        for (int i = 0; i < 3; i++) {
            const long double rows[3] = {right[i] * cosl(c) + up[i] * sinl(c), up[i] * cosl(c) - right[i] * sinl(c), back[i]};
            for (int k = 0; k < 3; k++) {
                worst = fmaxl(worst, fabsl(camera.rotation[k][i] - 0x1p30L * rows[k]));
            }
            assert_true(fabsl(camera.eye[i] - (target[i] + distance * back[i])) <= 0.51L + 16.0L * distance * 0x1p-30L);
        }
    }
    print_message("orbit: %.3Lf * 2^-30\n", worst);
    assert_true(worst <= 16);
}

static void orbits_without_a_distance_or_beyond_the_numbers_are_errors(void **state) {
    const q16_16_t far_out[3] = {0, 0, INT32_MAX - 5};
    tuile_camera_t camera = {0}, before = camera;
    (void)state;
    assert_int_equal(tuile_camera_orbit(&camera, origin, 0, 0, 0, 0), TUILE_ERROR_CAMERA);
    assert_int_equal(tuile_camera_orbit(&camera, origin, -1, 0, 0, 0), TUILE_ERROR_CAMERA);
    assert_int_equal(tuile_camera_orbit(&camera, far_out, 6, 0, 0, 0), TUILE_ERROR_RANGE);
    assert_memory_equal(&camera, &before, sizeof camera);
    assert_int_equal(tuile_camera_orbit(&camera, far_out, 5, 0, 0, 0), TUILE_OK);
    assert_int_equal(camera.eye[2], INT32_MAX);
    assert_int_equal(tuile_camera_orbit(&camera, origin, INT32_MAX, 0x8000, 0, 0), TUILE_OK);
    assert_int_equal(camera.eye[2], -INT32_MAX);
}

static void a_camera_on_a_pose_sees_as_the_pose_looks(void **state) {
    tuile_pose_t pose = {.scale = TUILE_SCALE_ONE, .translation = {7, 8, 9}};
    tuile_camera_t camera = {0};
    (void)state;
    tuile_rotation(pose.rotation, 1, 0x4000); /* leads -z to -x */
    assert_int_equal(tuile_camera_attach(&camera, &pose), TUILE_OK);
    assert_memory_equal(camera.eye, pose.translation, sizeof camera.eye);
    assert_int_equal(camera.rotation[2][0], TUILE_ONE_Q30); /* the view's +z, behind it, is the world's +x */
    assert_int_equal(camera.rotation[0][2], -TUILE_ONE_Q30);
    assert_int_equal(camera.rotation[1][1], TUILE_ONE_Q30);
    pose.rotation[1][1] = 0;
    assert_int_equal(tuile_camera_attach(&camera, &pose), TUILE_ERROR_CAMERA);
}

/* How far the sphere reaches from the principal point, in pixels along one axis, and the room there is. */
static long double reach_px(const tuile_camera_t *camera, const tuile_sphere_t *sphere, int axis) {
    long double v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = 0;
        for (int j = 0; j < 3; j++) {
            v[i] += camera->rotation[i][j] * 0x1p-30L * ((long double)sphere->centre[j] - camera->eye[j]);
        }
    }
    const long double focal = (axis ? camera->focal_y : camera->focal_x) * 0x1p-16L, r = sphere->radius, d = -v[2];
    if (camera->projection == TUILE_ORTHOGRAPHIC) { return (fabsl(v[axis]) + r) * 0x1p-16L * focal; }
    return focal * tanl(asinl(r / hypotl(d, v[axis])) + fabsl(atanl(v[axis] / d)));
}

static void a_sphere_just_fits_between_the_sides_and_the_planes(void **state) {
    random_source_t random = random_seed(86);
    long double loosest = 0;
    unsigned drawn = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(100000); round++) {
        const uint16_t width = (uint16_t)random_between(&random, 1, 1024), height = (uint16_t)random_between(&random, 1, 1024);
        tuile_camera_t camera = {.projection = (tuile_projection_t)(round % 2)};
        const tuile_sphere_t sphere = {{(q16_16_t)random_any_size(&random, 29), (q16_16_t)random_any_size(&random, 29), 5},
                                       random_between(&random, 1 << 10, 1 << 26)};
        (void)tuile_camera_orbit(&camera, origin, 1, (bam16_t)random_between(&random, 0, 65535),
                                 (bam16_t)random_between(&random, 0, 65535), 0);
        camera.focal_x = random_between(&random, 1 << 14, 1 << 26);
        camera.focal_y = random_one_in(&random, 2) ? camera.focal_x : random_between(&random, 1 << 14, 1 << 26);
        camera.centre_x = random_between(&random, 1, width * 65536 - 1);
        camera.centre_y = random_between(&random, 1, height * 65536 - 1);
        const q16_16_t ratio[2] = {camera.focal_x, camera.focal_y};
        const int result = tuile_camera_fit(&camera, &sphere, width, height);
        if (result == TUILE_ERROR_RANGE) { continue; }
        assert_int_equal(result, TUILE_OK);
        drawn++;
        long double fill = 0;
        for (int axis = 0; axis < 2; axis++) {
            const long double size = axis ? height : width, centre = (axis ? camera.centre_y : camera.centre_x) * 0x1p-16L;
            const long double half = fminl(centre, size - centre), share = reach_px(&camera, &sphere, axis) / half;
            /* Eye and rotation are rounded, by what is little of any sphere that can be seen. */
            assert_true(share <= 1 + 0x1p-8L);
            fill = fmaxl(fill, share);
        }
        const long double d = camera.eye[0] - (long double)sphere.centre[0], e = camera.eye[1] - (long double)sphere.centre[1];
        const long double distance = sqrtl(d * d + e * e + powl(camera.eye[2] - (long double)sphere.centre[2], 2));
        assert_true(camera.near > 0 && camera.near <= distance - sphere.radius + 2 && camera.far >= distance + sphere.radius);
        const long double shape = (long double)camera.focal_x / camera.focal_y * ratio[1] / ratio[0];
        if (camera.focal_x > 4096 && camera.focal_y > 4096) { assert_true(fabsl(shape - 1) < 0.001L); }
        const bool wide =
            camera.projection == TUILE_PERSPECTIVE && (camera.focal_x < width * 32768 || camera.focal_y < height * 32768);
        if (!wide && camera.focal_x > 4096 && camera.focal_y > 4096) { loosest = fmaxl(loosest, 1 - fill); }
    }
    print_message("%u fit; loosest by %.4Lf of the window\n", drawn, loosest);
    assert_true(drawn > (unsigned)CHECK_ROUNDS(100000) / 4 && loosest < 0.01L);
}

static void a_model_that_was_framed_lies_in_the_window_and_touches_its_sides(void **state) {
    stage_t stage;
    mesh_t mesh;
    tuile_sphere_t sphere;
    (void)state;
    model_sphere(&mesh, 24, 48);
    stage_open(&stage, &mesh, 100, 60);
    stage.view.instance.pose.translation[1] = 777 << 16;
    assert_int_equal(tuile_sphere(&sphere, &stage.compiled.model, &stage.view.instance.pose), TUILE_OK);
    for (unsigned k = 0; k < 2; k++) {
        tuile_camera_t *camera = &stage.view.scene.camera;
        camera->projection = (tuile_projection_t)k;
        assert_int_equal(tuile_camera_orbit(camera, origin, 1, 5000, 3000, 0), TUILE_OK);
        assert_int_equal(tuile_camera_fit(camera, &sphere, 100, 60), TUILE_OK);
        uint32_t *ids = frame_draw_ids(&stage.view.scene, 100, 60);
        unsigned top = 60, bottom = 0;
        for (unsigned i = 0; i < 6000; i++) {
            if (ids[i]) {
                top = i / 100 < top ? i / 100 : top;
                bottom = i / 100;
                assert_in_range(i % 100, 18, 81);
            }
        }
        assert_in_range(top, 0, 1);
        assert_in_range(bottom, 58, 59);
        free(ids);
    }
    stage_close(&stage);
}

static void what_cannot_be_framed_is_an_error(void **state) {
    tuile_camera_t good = {.focal_x = 100 << 16, .focal_y = 100 << 16, .centre_x = 50 << 16, .centre_y = 50 << 16}, camera;
    tuile_sphere_t sphere = {{0, 0, 0}, 1 << 16};
    (void)state;
    assert_int_equal(tuile_camera_orbit(&good, origin, 1, 0, 0, 0), TUILE_OK);
#define FIT(change, error)                                                                \
    do {                                                                                  \
        camera = good;                                                                    \
        sphere = (tuile_sphere_t){{0, 0, 0}, 1 << 16};                                    \
        change;                                                                           \
        const tuile_camera_t before = camera;                                             \
        assert_int_equal(tuile_camera_fit(&camera, &sphere, 100, 100), error);            \
        assert_true((error) == TUILE_OK || memcmp(&before, &camera, sizeof camera) == 0); \
    } while (0)
    FIT((void)0, TUILE_OK);
    FIT(sphere.radius = 0, TUILE_ERROR_CAMERA);
    FIT(sphere.radius = INT32_MIN, TUILE_ERROR_CAMERA);
    FIT(camera.focal_x = 0, TUILE_ERROR_CAMERA);
    FIT(camera.focal_y = -1, TUILE_ERROR_CAMERA);
    FIT(camera.centre_x = 0, TUILE_ERROR_CAMERA);
    FIT(camera.centre_y = 100 << 16, TUILE_ERROR_CAMERA);
    FIT(camera.rotation[1][1] = 0, TUILE_ERROR_CAMERA);
    FIT(sphere.radius = INT32_MAX, TUILE_ERROR_RANGE);
    FIT(sphere.centre[2] = INT32_MAX, TUILE_ERROR_RANGE);
    FIT((camera.focal_x = camera.focal_y = INT32_MAX, sphere.radius = 1000 << 16), TUILE_ERROR_RANGE);
    FIT((camera.projection = TUILE_ORTHOGRAPHIC, sphere.radius = 1), TUILE_ERROR_RANGE); /* more than 32767 pixels a unit */
}

static void a_sphere_holds_its_model(void **state) {
    random_source_t random = random_seed(87);
    model_compiled_t compiled;
    mesh_t mesh;
    (void)state;
    model_staircase(&mesh, 5);
    model_compile(&compiled, &mesh);
    const tuile_model_t *model = &compiled.model;
    for (int round = 0; round < CHECK_ROUNDS(2000); round++) {
        tuile_pose_t pose = {.scale = {(uint32_t)random_between(&random, 1, 4000), -10}};
        tuile_sphere_t sphere;
        tuile_rotation(pose.rotation, round % 3, (bam16_t)random_between(&random, 0, 65535));
        for (int i = 0; i < 3; i++) {
            pose.translation[i] = (q16_16_t)random_any_size(&random, 28);
        }
        assert_int_equal(tuile_sphere(&sphere, model, &pose), TUILE_OK);
        for (uint32_t v = 0; v < model->vertex_count; v++) {
            long double square = 0;
            for (int i = 0; i < 3; i++) {
                long double at = pose.translation[i];
                for (int j = 0; j < 3; j++) {
                    int16_t stored;
                    memcpy(&stored, model->positions + 6 * v + 2 * j, 2);
                    at += pose.rotation[i][j] * 0x1p-30L * ((long double)model->offset[j] + stored) *
                          ldexpl(model->step.mantissa, model->step.exponent) * pose.scale.mantissa * 64;
                }
                square += (at - sphere.centre[i]) * (at - sphere.centre[i]);
            }
            assert_true(sqrtl(square) <= sphere.radius);
        }
    }
    tuile_pose_t large = {.scale = {1, 20}};
    tuile_sphere_t sphere;
    tuile_rotation(large.rotation, 0, 0);
    assert_int_equal(tuile_sphere(&sphere, model, &large), TUILE_ERROR_RANGE);
    model_free(&compiled);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quarters_of_an_orbit_are_exact),
        cmocka_unit_test(an_orbit_is_what_looking_at_the_point_is),
        cmocka_unit_test(orbits_without_a_distance_or_beyond_the_numbers_are_errors),
        cmocka_unit_test(a_camera_on_a_pose_sees_as_the_pose_looks),
        cmocka_unit_test(a_sphere_just_fits_between_the_sides_and_the_planes),
        cmocka_unit_test(a_model_that_was_framed_lies_in_the_window_and_touches_its_sides),
        cmocka_unit_test(what_cannot_be_framed_is_an_error),
        cmocka_unit_test(a_sphere_holds_its_model),
    };
    return cmocka_run_group_tests_name("scene camera", tests, NULL, NULL);
}
