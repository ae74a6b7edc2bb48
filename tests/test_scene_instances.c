/* Many instances: those that cannot be seen are dropped whole, and each may have materials of its own. */
#include "support/check.h"

#include "../raster/geometry/cull.h"
#include "../raster/geometry/vertex.h"
#include "support/frame.h"
#include "support/random.h"
#include "support/stage.h"

static void random_pose(random_source_t *random, tuile_pose_t *pose, double spread) {
    tuile_rotation(pose->rotation, random_between(random, 0, 2), (bam16_t)random_between(random, 0, 65535));
    pose->scale = (tuile_scale_t){(uint32_t)random_between(random, 1, 1000), random_between(random, -2, 3)};
    for (unsigned i = 0; i < 3; i++) {
        pose->translation[i] = (q16_16_t)(random_real(random, -spread, spread) * 65536);
    }
}

static void no_model_with_a_vertex_in_the_window_is_dropped(void **state) {
    static vertex_t vertices[4096];
    static const transform_region_t regions[2] = {{20, 16, 70, 48}, {60, 50, 90, 80}};
    random_source_t random = random_seed(83);
    stage_t stage;
    mesh_t mesh;
    unsigned dropped = 0, sooner = 0, kept = 0, missed = 0;
    (void)state;
    model_torus(&mesh, 12, 7, true);
    stage_open(&stage, &mesh, 100, 80);
    const tuile_model_t *model = &stage.compiled.model;
    assert_true(model->vertex_count < CHECK_COUNT(vertices));
    for (int round = 0; round < CHECK_ROUNDS(8000); round++) {
        transform_t transform;
        const transform_region_t region = regions[round / 2 % 2];
        tuile_scene_t scene = stage.view.scene;
        scene.camera.projection = round % 2 ? TUILE_ORTHOGRAPHIC : TUILE_PERSPECTIVE;
        if (round % 2) { scene.camera.focal_x = scene.camera.focal_y = 65536 / 150; }
        random_pose(&random, &stage.view.instance.pose, 6000);
        if (round % 5 == 0) { /* the camera may be in it */
            for (unsigned i = 0; i < 3; i++) {
                stage.view.instance.pose.translation[i] = scene.camera.eye[i];
            }
        }
        if (transform_make(&transform, &scene, &stage.view.instance, 100, 80) != TUILE_OK) { continue; }
        transform_region(&transform, &region);
        unsigned inside = 0;
        (void)vertex_stage(&transform, (const int16_t *)(const void *)model->positions, NULL, model->vertex_count, vertices);
        for (uint32_t v = 0; v < model->vertex_count; v++) {
            inside += vertices[v].x != VERTEX_OUTSIDE && vertices[v].x >= region.left * 16 && vertices[v].x <= region.right * 16 &&
                      vertices[v].y >= region.top * 16 && vertices[v].y <= region.bottom * 16;
        }
        const bool outside = cull_model_outside(&transform, model);
        const bool early = cull_instance_outside(&scene.camera, &stage.view.instance, &region);
        sooner += early;
        if ((outside || early) && inside) { fail_msg("round %d: %u vertices in the window", round, inside); }
        dropped += outside;
        kept += inside > 0;
        missed += !outside && !inside;
    }
    print_message("dropped %u, %u of them sooner, with vertices inside %u, neither %u\n", dropped, sooner, kept, missed);
    assert_true(dropped > missed && sooner > dropped / 10 * 8 && kept > 100 / (CHECK_SANITIZED ? 16 : 1));
    stage_close(&stage);
}

static void instances_beside_the_window_cost_no_cluster_and_change_nothing(void **state) {
    stage_t stage;
    mesh_t mesh;
    tuile_instance_t all[9], seen[3];
    (void)state;
    model_octahedron(&mesh);
    const mesh_options_t with = {.tree = true};
    model_compile_with(&stage.compiled, &mesh, &with);
    mesh_free(&mesh);
    for (int i = 0; i < 9; i++) {
        all[i] = stage_placed(&stage.compiled.model, (i - 4) * 3); /* 16 pixels a unit: three of them in 100 pixels */
        if (i >= 3 && i < 6) { seen[i - 3] = all[i]; }
    }
    const tuile_light_t light = {{0, 0, -TUILE_ONE_Q14}, 255};
    tuile_scene_t scene = {.lights = &light, .light_count = 1, .camera = stage_plain_camera(100, 80)};
    for (unsigned k = 0; k < 5 * 2; k++) {
        tuile_stats_t stats;
        tuile_config_t config = {.width = 100, .height = 80, .tile_height = 80, .method = (uint8_t)(k / 2)};
        config.effects = k % 2 ? TUILE_SURFACES : 0;
        scene.instances = seen;
        scene.instance_count = 3;
        uint8_t *expected = frame_draw(&scene, &config, 1 << 20, &stats);
        assert_int_equal(stats.instances, 3 * stats.passes);
        assert_int_equal(stats.instances_outside, 0);
        const uint32_t clusters = stats.clusters;
        scene.instances = all;
        scene.instance_count = 9;
        uint8_t *picture = frame_draw(&scene, &config, 1 << 20, &stats);
        assert_memory_equal(picture, expected, frame_bytes(&config));
        assert_int_equal(stats.instances, 9);
        assert_int_equal(stats.instances_outside, 6);
        assert_int_equal(stats.clusters, clusters);
        free(picture);
        free(expected);
    }
    /* Ids are counted through those that are dropped, too. */
    uint32_t *ids = frame_draw_ids(&scene, 100, 80);
    const uint32_t *middle = &ids[40 * 100 + 50];
    assert_in_range(middle[5], 4 * 8 + 1, 5 * 8);
    assert_in_range(middle[5 - 48], 3 * 8 + 1, 4 * 8);
    assert_in_range(middle[5 + 43], 5 * 8 + 1, 6 * 8);
    free(ids);
    model_free(&stage.compiled);
}

/* ---- materials ---- */

static uint16_t rgb565(unsigned red, unsigned green, unsigned blue) {
    return (uint16_t)(red >> 3 << 11 | green >> 2 << 5 | blue >> 3);
}

/* A square that faces the camera. */
static void open_square(model_compiled_t *compiled) {
    mesh_t mesh;
    model_start(&mesh);
    const uint32_t corners[4] = {model_position(&mesh, -0.5, -0.5, 0), model_position(&mesh, 0.5, -0.5, 0),
                                 model_position(&mesh, 0.5, 0.5, 0), model_position(&mesh, -0.5, 0.5, 0)};
    model_face(&mesh, corners, 4, model_material(&mesh, 10, 20, 30));
    model_compile(compiled, &mesh);
}

/* `count` squares beside one another, four pixels each, with colours that only materials of their own can give. */
static void draw_squares(const tuile_model_t *model, unsigned count, const tuile_config_t *config, uint16_t *row) {
    static tuile_instance_t instances[300];
    static tuile_material_t materials[300];
    tuile_scene_t scene = {.instances = instances, .instance_count = (uint16_t)count, .ambient = 255};
    scene.camera = stage_plain_camera(config->width, config->height);
    scene.camera.focal_x = 4 << 16;
    scene.camera.centre_x = 2 << 16;
    for (unsigned i = 0; i < count; i++) {
        instances[i] = stage_placed(model, (int)i);
        materials[i] = (tuile_material_t){
            .colour = {(uint8_t)(8 * (i % 32)), (uint8_t)(8 * (i / 32 % 32)), 255}, .alpha = 255, .texture = TUILE_NO_TEXTURE};
        instances[i].materials = &materials[i];
    }
    uint8_t *picture = frame_draw(&scene, config, 1 << 18, NULL);
    memcpy(row, picture + frame_bytes(config) / 2, 2u * config->width);
    free(picture);
}

static void assert_squares(const uint16_t *row, unsigned count) {
    for (unsigned i = 0; i < count; i++) {
        const unsigned red = 8 * (i % 32), green = 8 * (i / 32 % 32);
        /* light stops at 253 / 255, and the brightest of 64 light levels is the last: less than a step of the colour */
        const int seen = row[4 * i + 2], full = rgb565(red, green, 255);
        assert_true(abs((seen >> 11) - (full >> 11)) <= 1 && abs((seen >> 5 & 63) - (full >> 5 & 63)) <= 1);
        assert_in_range(seen & 31, 30, 31);
    }
}

static void each_instance_has_the_materials_that_it_brings(void **state) {
    static uint16_t row[1024];
    model_compiled_t square;
    (void)state;
    open_square(&square);
    for (unsigned k = 0; k < 4 * 2 * 2; k++) {
        tuile_config_t config = {.width = 400, .height = 16, .format = TUILE_RGB565_LE, .method = (uint8_t)(k % 4)};
        config.shade = (uint8_t)(k / 4 % 2);
        config.effects = k / 8 ? TUILE_SURFACES : 0;
        draw_squares(&square.model, 100, &config, row);
        assert_squares(row, 100);
    }
    model_free(&square);
}

static void more_than_256_materials_want_deferred_shading(void **state) {
    static uint64_t block[32768];
    static uint16_t row[1024];
    static tuile_material_t materials[257];
    static tuile_instance_t instances[257];
    model_compiled_t square;
    tuile_t *renderer;
    (void)state;
    open_square(&square);
    tuile_config_t config = {.width = 1024, .height = 8, .format = TUILE_RGB565_LE, .effects = TUILE_SURFACES};
    draw_squares(&square.model, 257 - 1, &config, row);
    assert_squares(row, 256);
    for (unsigned i = 0; i < 257; i++) {
        instances[i] = stage_placed(&square.model, 0);
        instances[i].materials = &materials[i];
    }
    tuile_scene_t scene = {.instances = instances, .instance_count = 257, .camera = stage_plain_camera(1024, 8)};
    for (unsigned k = 0; k < 3; k++) {
        config.effects = k == 1 ? TUILE_SURFACES : 0;
        config.format = k == 2 ? TUILE_FACE_IDS : TUILE_RGB565_LE;
        assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
        assert_int_equal(tuile_begin(renderer, &scene), k == 0 ? TUILE_ERROR_ARGUMENT : TUILE_OK);
        if (k > 0) { assert_int_equal(tuile_end(renderer, NULL), TUILE_OK); }
    }
    model_free(&square);
}

static void materials_out_of_range_are_refused(void **state) {
    static uint64_t block[8192];
    model_compiled_t square;
    tuile_t *renderer;
    (void)state;
    open_square(&square);
    const tuile_config_t config = {.width = 64, .height = 64, .tile_height = 8, .effects = TUILE_SURFACES};
    const struct {
        tuile_material_t material;
        int error;
    } cases[] = {
        {{.uv_bits = 8, .shininess = 7, .blend = TUILE_BLEND_MULTIPLY, .texture = 9}, TUILE_OK},
        {{.uv_bits = 9}, TUILE_ERROR_ARGUMENT},
        {{.shininess = 8}, TUILE_ERROR_ARGUMENT},
        {{.blend = 3}, TUILE_ERROR_ARGUMENT},
    };
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        tuile_instance_t instance = stage_placed(&square.model, 0);
        instance.materials = &cases[i].material;
        const tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .camera = stage_plain_camera(64, 64)};
        assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
        assert_int_equal(tuile_begin(renderer, &scene), cases[i].error);
    }
    model_free(&square);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_model_with_a_vertex_in_the_window_is_dropped),
        cmocka_unit_test(instances_beside_the_window_cost_no_cluster_and_change_nothing),
        cmocka_unit_test(each_instance_has_the_materials_that_it_brings),
        cmocka_unit_test(materials_out_of_range_are_refused),
        cmocka_unit_test(more_than_256_materials_want_deferred_shading),
    };
    return cmocka_run_group_tests_name("scene instances", tests, NULL, NULL);
}
