#include "stage.h"

#include "check.h"

void stage_aim(stage_t *stage, const view_options_t *options, uint16_t width, uint16_t height) {
    view_options_t o = options ? *options : VIEW_OPTIONS_DEFAULT;
    sim_error_t error = {""};
    if (!options) { memcpy(o.background, (const uint8_t[3]){0x18, 0x20, 0x30}, 3); }
    if (view_make(&stage->view, &o, &stage->compiled.model, width, height, 1, &error) != 0) { fail_msg("%s", error.text); }
}

void stage_open(stage_t *stage, mesh_t *mesh, uint16_t width, uint16_t height) {
    model_compile(&stage->compiled, mesh);
    stage_aim(stage, NULL, width, height);
}

void stage_close(stage_t *stage) { model_free(&stage->compiled); }

void stage_open_torus(stage_t *stage, uint16_t width, uint16_t height) {
    mesh_t mesh;
    model_torus(&mesh, 100, 29, true);
    stage_open(stage, &mesh, width, height);
    assert_int_equal(stage->compiled.model.face_count, 5800);
}

tuile_config_t stage_panel_config(const stage_t *stage) {
    return (tuile_config_t){.width = 240, .height = 320, .cluster_vertices = stage->compiled.model.cluster_vertices_max};
}

tuile_camera_t stage_plain_camera(uint16_t width, uint16_t height) {
    tuile_camera_t camera = {
        .projection = TUILE_ORTHOGRAPHIC, .focal_x = 16 << 16, .focal_y = 16 << 16, .near = 1 << 16, .far = 80 << 16};
    for (unsigned i = 0; i < 3; i++) {
        camera.rotation[i][i] = TUILE_ONE_Q30;
    }
    camera.eye[2] = 40 << 16;
    camera.centre_x = (q16_16_t)width * 32768;
    camera.centre_y = (q16_16_t)height * 32768;
    return camera;
}

tuile_instance_t stage_placed(const tuile_model_t *model, int x) {
    tuile_instance_t instance = {.model = model, .pose = {.scale = TUILE_SCALE_ONE, .translation = {x * 65536, 0, 0}}};
    for (unsigned i = 0; i < 3; i++) {
        instance.pose.rotation[i][i] = TUILE_ONE_Q30;
    }
    return instance;
}
