#include "solids.h"

#include "check.h"
#include "frame.h"
#include "set_up.h"

#include <math.h>

enum { MEMORY_BYTES = 1 << 20 };

void solid_model_open(solid_model_t *model, mesh_t *mesh, bool two_sided) {
    const mesh_options_t options = {.tree = true, .two_sided = two_sided};
    model->mesh = *mesh;
    memset(mesh, 0, sizeof *mesh);
    model_compile_with(&model->compiled, &model->mesh, &options);
    assert_non_null(model->compiled.model.tree);
}

void solid_model_close(solid_model_t *model) {
    mesh_free(&model->mesh);
    model_free(&model->compiled);
}

void solids_start(solids_t *solids, uint16_t width, uint16_t height) {
    memset(solids, 0, sizeof *solids);
    solids->width = width;
    solids->height = height;
    solids->light = (tuile_light_t){{TUILE_ONE_Q14 / 5 * 3, 0, -TUILE_ONE_Q14 / 5 * 4}, 170};
    solids->scene = (tuile_scene_t){
        .instances = solids->instances, .lights = &solids->light, .light_count = 1, .ambient = 60, .background = {8, 16, 24}};
    tuile_camera_t *camera = &solids->scene.camera;
    for (unsigned i = 0; i < 3; i++) {
        camera->rotation[i][i] = TUILE_ONE_Q30;
    }
    camera->focal_x = camera->focal_y = height * 56754; /* height / 2 / tan(30 degrees) */
    camera->centre_x = width * 32768;
    camera->centre_y = height * 32768;
    camera->near = 1 << 14;
    camera->far = 256 << 16;
}

tuile_instance_t *solids_add(solids_t *solids, const solid_model_t *model) {
    assert_true(solids->scene.instance_count < SOLIDS_MAX);
    const unsigned number = solids->scene.instance_count++;
    tuile_instance_t *instance = &solids->instances[number];
    solids->models[number] = model;
    *instance = (tuile_instance_t){.model = &model->compiled.model, .pose = {.scale = TUILE_SCALE_ONE}};
    for (unsigned i = 0; i < 3; i++) {
        instance->pose.rotation[i][i] = TUILE_ONE_Q30;
    }
    return instance;
}

void solids_place(tuile_instance_t *instance, double x, double y, double z) {
    instance->pose.translation[0] = (q16_16_t)lround(x * 65536);
    instance->pose.translation[1] = (q16_16_t)lround(y * 65536);
    instance->pose.translation[2] = (q16_16_t)lround(z * 65536);
}

void solids_turn(tuile_instance_t *instance, random_source_t *random, bool mirrored) {
    random_rotation(random, instance->pose.rotation);
    for (unsigned i = 0; i < 3 && mirrored; i++) {
        instance->pose.rotation[i][0] = -instance->pose.rotation[i][0];
    }
}

void solids_world(const tuile_instance_t *instance, const double position[3], double world[3]) {
    const tuile_pose_t *pose = &instance->pose;
    for (unsigned i = 0; i < 3; i++) {
        world[i] = pose->translation[i] / 65536.0;
        for (unsigned k = 0; k < 3; k++) {
            world[i] += pose->rotation[i][k] / 1073741824.0 * ldexp(pose->scale.mantissa, pose->scale.exponent) * position[k];
        }
    }
}

void solids_look(solids_t *solids, const double eye[3], const double at[3]) {
    q16_16_t from[3], to[3];
    for (unsigned i = 0; i < 3; i++) {
        from[i] = (q16_16_t)lround(eye[i] * 65536);
        to[i] = (q16_16_t)lround(at[i] * 65536);
    }
    const q16_16_t up[2][3] = {{0, 65536, 0}, {65536, 0, 0}};
    if (tuile_camera_look_at(&solids->scene.camera, from, to, up[0]) != TUILE_OK) {
        assert_int_equal(tuile_camera_look_at(&solids->scene.camera, from, to, up[1]), TUILE_OK);
    }
}

void solids_orthographic(solids_t *solids, double pixels_per_unit) {
    tuile_camera_t *camera = &solids->scene.camera;
    camera->projection = TUILE_ORTHOGRAPHIC;
    camera->focal_x = camera->focal_y = (q16_16_t)lround(pixels_per_unit * 65536);
    camera->near = -(64 << 16);
    camera->far = 64 << 16;
}

tuile_config_t solids_config(const solids_t *solids, tuile_method_t method) {
    tuile_config_t config = {.width = solids->width, .height = solids->height, .method = (uint8_t)method};
    for (unsigned i = 0; i < solids->scene.instance_count; i++) {
        const tuile_model_t *model = solids->instances[i].model;
        if (model->cluster_vertices_max > config.cluster_vertices) { config.cluster_vertices = model->cluster_vertices_max; }
        if (model->corners_max > config.corners) { config.corners = model->corners_max; }
        if (model->tree_depth > config.tree_depth) { config.tree_depth = model->tree_depth; }
    }
    return config;
}

/* ---- depth by definition ---- */

/* From the observer's place to a position of the instance, in the camera's directions. */
static void view_of(const tuile_scene_t *scene, const tuile_instance_t *instance, const double position[3], double view[3]) {
    double world[3];
    solids_world(instance, position, world);
    for (unsigned i = 0; i < 3; i++) {
        view[i] = 0;
        for (unsigned k = 0; k < 3; k++) {
            view[i] += scene->camera.rotation[i][k] / 1073741824.0 * (world[k] - scene->camera.eye[k] / 65536.0);
        }
    }
}

/* The plane through the corners of the face that the piece was cut from, as it stands on the grid: normal and distance. */
static void plane_of(const solids_t *solids, uint32_t id, double plane[4]) {
    unsigned number = 0;
    uint32_t face = id - 1;
    while (face >= solids->instances[number].model->face_count) {
        face -= solids->instances[number++].model->face_count;
        assert_true(number < solids->scene.instance_count);
    }
    const tuile_instance_t *instance = &solids->instances[number];
    const mesh_t *mesh = &solids->models[number]->mesh;
    const mesh_face_t *source = &mesh->faces[tuile_model_source_face(instance->model, face)];
    const double step = ldexp(instance->model->step.mantissa, instance->model->step.exponent);
    double first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
    memset(plane, 0, 4 * sizeof *plane);
    for (uint32_t i = 0; i <= source->count; i++) {
        double position[3], view[3];
        for (unsigned k = 0; k < 3; k++) {
            position[k] = step * floor(mesh->positions[mesh->corners[source->first + i % source->count]][k] / step + 0.5);
        }
        view_of(&solids->scene, instance, position, view);
        for (unsigned k = 0; k < 3 && i > 0; k++) { /* Newell, about the first corner */
            const unsigned b = (k + 1) % 3, c = (k + 2) % 3;
            plane[k] += (last[b] - view[b]) * (last[c] + view[c] - 2 * first[c]);
        }
        memcpy(last, view, sizeof last);
        if (i == 0) { memcpy(first, view, sizeof first); }
    }
    for (unsigned k = 0; k < 3; k++) {
        plane[3] += plane[k] * first[k];
    }
}

static double depth_at(const tuile_camera_t *camera, const double plane[4], double x, double y) {
    const double near = camera->near / 65536.0, far = camera->far / 65536.0;
    const double right = (x - camera->centre_x / 65536.0) * 65536 / camera->focal_x,
                 up = (camera->centre_y / 65536.0 - y) * 65536 / camera->focal_y;
    if (camera->projection == TUILE_PERSPECTIVE) { /* w * (right, up, -1) is on the plane */
        return 65528 * near * (plane[0] * right + plane[1] * up - plane[2]) / plane[3];
    }
    const double w = -(plane[3] - plane[0] * right - plane[1] * up) / plane[2];
    return 8 + 65520 * (far - w) / (far - near);
}

double solids_depth(const solids_t *solids, uint32_t id, double x, double y, double *within) {
    const tuile_camera_t *camera = &solids->scene.camera;
    double plane[4];
    plane_of(solids, id, plane);
    const double depth = depth_at(camera, plane, x, y);
    *within = fabs(depth_at(camera, plane, x + 0.0625, y) - depth) + fabs(depth_at(camera, plane, x, y + 0.0625) - depth);
    if (!isfinite(depth) || !isfinite(*within)) { *within = HUGE_VAL; } /* edge on: it has no place but by snapping */
    return isfinite(depth) ? depth : 0;
}

/* ---- pictures ---- */

/* Two faces in one plane, and not two pieces of one. */
static bool one_plane(const solids_t *solids, uint32_t a, uint32_t b) {
    double p[4], q[4], squares[2] = {0, 0}, dot = 0;
    bool one_face = true;
    plane_of(solids, a, p);
    plane_of(solids, b, q);
    for (unsigned k = 0; k < 4; k++) {
        squares[0] += p[k] * p[k];
        squares[1] += q[k] * q[k];
        dot += p[k] * q[k];
        one_face = one_face && p[k] == q[k];
    }
    return !one_face && dot * dot > squares[0] * squares[1] * (1 - 1e-14);
}

/* Does the display tree show this face when the pixel is sampled 1/16 pixel beside? */
static bool shown_beside(const solids_t *solids, tuile_tie_t tie, unsigned x, unsigned y, uint32_t id) {
    tuile_config_t config = solids_config(solids, TUILE_TREE);
    bool shown = false;
    config.format = TUILE_FACE_IDS;
    config.tie = (uint8_t)tie;
    for (int i = 0; i < 9 && !shown; i++) {
        tuile_scene_t scene = solids->scene;
        scene.camera.centre_x += (i % 3 - 1) * 4096;
        scene.camera.centre_y += (i / 3 - 1) * 4096;
        uint32_t *ids = (uint32_t *)(void *)frame_draw(&scene, &config, MEMORY_BYTES, NULL);
        shown = ids[(size_t)y * solids->width + x] == id;
        free(ids);
    }
    return shown;
}

void solids_compare(const solids_t *solids, const uint32_t *ids, const uint32_t *expected, const char *name, tuile_tie_t tie,
                    solids_difference_t *difference) {
    for (unsigned y = 0; y < solids->height; y++) {
        for (unsigned x = 0; x < solids->width; x++) {
            const uint32_t is = ids[(size_t)y * solids->width + x], by_depth = expected[(size_t)y * solids->width + x];
            difference->pixels++;
            difference->covered += by_depth != 0;
            if (is == by_depth) { continue; }
            double within[2];
            if (is == 0 || by_depth == 0) { /* the same faces cover it in both */
                fail_msg("%s: face %u at %u,%u instead of %u", name, is, x, y, by_depth);
            }
            const double depth = solids_depth(solids, is, x + 0.5, y + 0.5, &within[0]),
                         deeper = solids_depth(solids, by_depth, x + 0.5, y + 0.5, &within[1]);
            if (fabs(depth - deeper) > 1 + within[0] + within[1]) {
                difference->beside++;
                if (shown_beside(solids, tie, x, y, by_depth)) { continue; }
                fail_msg("%s: face %u at %u,%u (depth %f +- %f) instead of %u (depth %f +- %f)", name, is, x, y, depth, within[0],
                         by_depth, deeper, within[1]);
            }
            if (one_plane(solids, is, by_depth)) {
                difference->ties++;
                if ((is < by_depth) != (tie == TUILE_TIE_FIRST)) {
                    fail_msg("%s: face %u at %u,%u instead of %u, in one plane", name, is, x, y, by_depth);
                }
            } else {
                difference->differ++;
            }
        }
    }
}

void solids_check(const solids_t *solids, const char *name, tuile_tie_t tie, solids_difference_t *difference) {
    tuile_config_t by_tree = solids_config(solids, TUILE_TREE), by_depth = solids_config(solids, TUILE_ZBUFFER);
    by_tree.tie = by_depth.tie = (uint8_t)tie;
    by_tree.format = by_depth.format = TUILE_FACE_IDS;
    uint32_t *ids = (uint32_t *)(void *)frame_draw(&solids->scene, &by_tree, MEMORY_BYTES, NULL),
             *expected = (uint32_t *)(void *)frame_draw(&solids->scene, &by_depth, MEMORY_BYTES, NULL);
    solids_compare(solids, ids, expected, name, tie, difference);
    by_tree.format = by_depth.format = TUILE_RGB565_LE;
    for (unsigned shade = TUILE_FLAT; shade <= TUILE_GOURAUD; shade++) {
        by_tree.shade = by_depth.shade = (uint8_t)shade;
        uint8_t *colours = frame_draw(&solids->scene, &by_tree, MEMORY_BYTES, NULL),
                *others = frame_draw(&solids->scene, &by_depth, MEMORY_BYTES, NULL);
        for (size_t i = 0; i < (size_t)solids->width * solids->height; i++) {
            if (ids[i] != expected[i] || memcmp(colours + 2 * i, others + 2 * i, 2) == 0) { continue; }
            if (shade == TUILE_GOURAUD && by_depth.corners > 3) {
                difference->differ++; /* polygons are cut into a fan then, each part of which has a depth of its own */
            } else {
                fail_msg("%s, shade %u: another colour of face %u at %zu,%zu", name, shade, ids[i], i % solids->width,
                         i / solids->width);
            }
        }
        free(colours);
        free(others);
    }
    free(ids);
    free(expected);
}
