/* Picking: the face under a pixel is the one in the picture, and its point lies on that face. */
#include "support/check.h"
#include "support/frame.h"
#include "support/random.h"
#include "support/stage.h"

#include <math.h>

typedef struct corners {
    int32_t at[255][3];
    unsigned count;
} corners_t;

/* Positions of the corners of the visible face, from the mesh that was compiled: the model's order is found through its source map.
 */
static corners_t source_corners(const tuile_model_t *model, const mesh_t *mesh, uint32_t face) {
    const mesh_face_t *source = &mesh->faces[tuile_model_source_face(model, face)];
    const long double step = ldexpl((long double)model->step.mantissa, model->step.exponent);
    corners_t corners = {.count = source->count};
    for (unsigned i = 0; i < source->count; i++) {
        for (unsigned a = 0; a < 3; a++) {
            corners.at[i][a] = (int32_t)(floorl((long double)mesh->positions[mesh->corners[source->first + i]][a] / step + 0.5L)) -
                               model->offset[a];
        }
    }
    return corners;
}

static long double distance_from_plane(const corners_t *corners, const q16_16_t point[3]) {
    long double normal[3] = {0, 0, 0}, dot = 0, squares = 0;
    for (unsigned i = 0; i < corners->count; i++) {
        const int32_t *p = corners->at[i], *q = corners->at[(i + 1) % corners->count];
        for (unsigned a = 0; a < 3; a++) {
            const unsigned b = (a + 1) % 3, c = (a + 2) % 3;
            normal[a] += (long double)(p[b] - q[b]) * (long double)(p[c] + q[c]);
        }
    }
    for (unsigned a = 0; a < 3; a++) {
        dot += normal[a] * ((long double)point[a] / 65536 - corners->at[0][a]);
        squares += normal[a] * normal[a];
    }
    return fabsl(dot) / sqrtl(squares);
}

static void project(const tuile_scene_t *scene, const tuile_hit_t *hit, long double window[2]) {
    const tuile_instance_t *instance = &scene->instances[hit->instance];
    const tuile_model_t *model = instance->model;
    const tuile_camera_t *camera = &scene->camera;
    const long double step = ldexpl((long double)model->step.mantissa, model->step.exponent) *
                             ldexpl((long double)instance->pose.scale.mantissa, instance->pose.scale.exponent);
    long double world[3], view[3];
    for (unsigned i = 0; i < 3; i++) {
        world[i] = (long double)instance->pose.translation[i] / 65536 - (long double)camera->eye[i] / 65536;
        for (unsigned k = 0; k < 3; k++) {
            world[i] += (long double)instance->pose.rotation[i][k] / TUILE_ONE_Q30 * step *
                        (model->offset[k] + (long double)hit->point[k] / 65536);
        }
    }
    for (unsigned i = 0; i < 3; i++) {
        view[i] = 0;
        for (unsigned k = 0; k < 3; k++) {
            view[i] += (long double)camera->rotation[i][k] / TUILE_ONE_Q30 * world[k];
        }
    }
    const long double w = camera->projection == TUILE_PERSPECTIVE ? -view[2] : 1;
    window[0] = (long double)camera->centre_x / 65536 + (long double)camera->focal_x / 65536 * view[0] / w;
    window[1] = (long double)camera->centre_y / 65536 - (long double)camera->focal_y / 65536 * view[1] / w;
}

static void coarse_torus(mesh_t *mesh) { model_torus(mesh, 30, 12, true); }

static void coarse_sphere(mesh_t *mesh) { model_sphere(mesh, 9, 16); }

static void picking_agrees_with_the_picture_and_its_point_lies_on_the_face(void **state) {
    static void (*const make[])(mesh_t *) = {model_cube, model_octahedron, model_room, coarse_torus, coarse_sphere};
    static uint64_t block[(TUILE_PICK_BYTES(160u, 255u) + TUILE_CORNERS_BYTES(10u) + 7) / 8];
    random_source_t random = random_seed(11);
    long double worst_pixel = 0, worst_plane = 0;
    unsigned hits = 0, misses = 0;
    (void)state;
    for (unsigned k = 0; k < CHECK_COUNT(make); k++) {
        stage_t stage;
        mesh_t mesh, copy;
        make[k](&copy);
        make[k](&mesh);
        stage_open(&stage, &mesh, 120, 160);
        for (unsigned frame = 0; frame < 6; frame++) {
            view_options_t options = VIEW_OPTIONS_DEFAULT;
            options.has_ortho = frame % 3 == 2;
            options.ortho = k == 2 ? 12 : 3;
            options.has_spin = true;
            options.spin = 57.3;
            stage_aim(&stage, &options, 120, 160);
            view_frame(&stage.view, frame);
            stage.view.instance.two_sided = frame % 2 != 0;
            uint32_t *ids = frame_draw_ids(&stage.view.scene, 120, 160);
            const tuile_config_t config = {.width = 120, .height = 160, .corners = stage.compiled.model.corners_max};
            for (unsigned n = 0; n < CHECK_ROUNDS(400); n++) {
                const uint16_t x = (uint16_t)random_between(&random, 0, 119), y = (uint16_t)random_between(&random, 0, 159);
                tuile_hit_t hit;
                const int result = tuile_pick(&stage.view.scene, &config, x, y, block, sizeof block, &hit);
                assert_int_equal(result, ids[y * 120 + x] != 0);
                if (result == 0) {
                    misses++;
                    continue;
                }
                hits++;
                assert_int_equal(hit.instance, 0);
                assert_int_equal(hit.face + 1, ids[y * 120 + x]);
                assert_true(hit.depth > 0);
                const corners_t corners = source_corners(&stage.compiled.model, &copy, hit.face);
                long double window[2];
                project(&stage.view.scene, &hit, window);
                for (unsigned a = 0; a < 2; a++) {
                    const long double off = fabsl(window[a] - ((a ? y : x) + 0.5L));
                    worst_pixel = off > worst_pixel ? off : worst_pixel;
                }
                const long double from_plane = distance_from_plane(&corners, hit.point);
                worst_plane = from_plane > worst_plane ? from_plane : worst_plane;
            }
            free(ids);
        }
        mesh_free(&copy);
        stage_close(&stage);
    }
    print_message(
        "picked %u faces, %u times background; off the pixel's centre by at most %.2Lg px, off the plane by %.2Lg steps\n", hits,
        misses, worst_pixel, worst_plane);
    assert_true(hits > CHECK_ROUNDS(2000) && misses > CHECK_ROUNDS(1000));
    assert_true(worst_pixel < 0.02L);
    assert_true(worst_plane < 0.001L);
}

static void picking_names_the_instance_and_refuses_what_is_outside(void **state) {
    static uint64_t block[2048];
    model_compiled_t cube, octahedron;
    mesh_t mesh;
    tuile_hit_t hit;
    const tuile_config_t config = {.width = 160, .height = 64};
    (void)state;
    model_cube(&mesh);
    model_compile(&cube, &mesh);
    model_octahedron(&mesh);
    model_compile(&octahedron, &mesh);
    const tuile_instance_t instances[3] = {stage_placed(&cube.model, -3), stage_placed(&octahedron.model, 0),
                                           stage_placed(&cube.model, 3)};
    const tuile_scene_t scene = {.instances = instances, .instance_count = 3, .camera = stage_plain_camera(160, 64)};
    for (uint16_t i = 0; i < 3; i++) {
        assert_int_equal(tuile_pick(&scene, &config, (uint16_t)(34 + 48 * i), 30, block, sizeof block, &hit), 1);
        assert_int_equal(hit.instance, i);
        assert_int_equal(tuile_model_source_face(instances[i].model, hit.face), 0);
        if (i != 1) { /* (34.5 - 32) / 16, (32 - 30.5) / 16 and the front at z = 1, in model units of the cube */
            const double step = ldexp(cube.model.step.mantissa, cube.model.step.exponent);
            assert_true(fabs(step * (cube.model.offset[0] + hit.point[0] / 65536.0) - 2.5 / 16) < 1e-6);
            assert_true(fabs(step * (cube.model.offset[1] + hit.point[1] / 65536.0) - 1.5 / 16) < 1e-6);
            assert_true(fabs(step * (cube.model.offset[2] + hit.point[2] / 65536.0) - 1) < 1e-6);
        }
    }
    assert_int_equal(tuile_pick(&scene, &config, 0, 0, block, sizeof block, &hit), 0);
    assert_int_equal(tuile_pick(&scene, &config, 160, 0, block, sizeof block, &hit), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_pick(&scene, &config, 0, 64, block, sizeof block, &hit), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_pick(&scene, &config, 0, 0, block, 64, &hit), TUILE_ERROR_MEMORY);
    assert_int_equal(tuile_pick(NULL, &config, 0, 0, block, sizeof block, &hit), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_pick(&scene, NULL, 0, 0, block, sizeof block, &hit), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_pick(&scene, &config, 0, 0, block, sizeof block, NULL), TUILE_ERROR_ARGUMENT);
    assert_in_range(TUILE_PICK_BYTES((size_t)64, (size_t)255), 1, sizeof block);
    const size_t least = TUILE_PICK_BYTES((size_t)64, (size_t)255);
    assert_int_equal(tuile_pick(&scene, &config, 82, 30, block, least, &hit), 1);
    model_free(&cube);
    model_free(&octahedron);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(picking_agrees_with_the_picture_and_its_point_lies_on_the_face),
        cmocka_unit_test(picking_names_the_instance_and_refuses_what_is_outside),
    };
    return cmocka_run_group_tests_name("pick", tests, NULL, NULL);
}
