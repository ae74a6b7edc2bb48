/* Any block of memory gives the same picture: the least one, passes, tiles drawn without a list, faces cut by the near plane. */
#include "support/check.h"
#include "support/frame.h"
#include "support/stage.h"

#include <math.h>

static void the_least_block_for_a_large_model_is_below_8_kilobytes_and_draws_it(void **state) {
    stage_t stage;
    tuile_stats_t stats;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    tuile_config_t config = stage_panel_config(&stage);
    config.tile_height = 4;
    uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, &stats);
    assert_int_equal(stats.passes, 1);
    const size_t least = frame_least_bytes(&config);
    assert_int_equal(
        least, TUILE_LEAST_BYTES((size_t)320, (size_t)240, (size_t)4, TUILE_RGB565_BE, (size_t)2, (size_t)config.cluster_vertices));
    assert_in_range(least, 1, 8192);
    uint8_t *picture = frame_draw(&stage.view.scene, &config, least, &stats);
    assert_memory_equal(picture, expected, frame_bytes(&config));
    assert_int_equal(stats.size_bytes, least);
    assert_int_equal(stats.least_bytes, least);
    assert_true(stats.tiles_narrow > 0);
    assert_int_equal(stats.tiles, 80);
    assert_int_equal(stats.faces, 5800);
    free(picture);
    free(expected);
    stage_close(&stage);
}

static void a_large_model_takes_one_pass_in_64_kilobytes(void **state) {
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    for (unsigned shade = 0; shade < 2; shade++) {
        tuile_stats_t stats;
        tuile_config_t config = stage_panel_config(&stage);
        config.tile_height = 8;
        config.shade = (uint8_t)shade;
        free(frame_draw(&stage.view.scene, &config, 65536, &stats));
        assert_int_equal(stats.passes, 1);
        assert_int_equal(stats.tiles_narrow, 0);
        assert_in_range(stats.peak_bytes, stats.least_bytes / 2, 65536);
    }
    stage_close(&stage);
}

static void the_peak_told_is_a_block_that_gives_as_few_passes(void **state) {
    stage_t stage;
    tuile_stats_t first, second;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    tuile_config_t config = stage_panel_config(&stage);
    config.tile_height = 8;
    free(frame_draw(&stage.view.scene, &config, 1 << 20, &first));
    free(frame_draw(&stage.view.scene, &config, (first.peak_bytes + 7u) & ~(size_t)7, &second));
    assert_int_equal(first.passes, 1);
    assert_int_equal(second.passes, first.passes);
    stage_close(&stage);
}

static void forty_sizes_of_memory_and_five_of_tiles_give_one_picture(void **state) {
    static const uint16_t tiles[][2] = {{240, 4}, {240, 16}, {32, 32}, {64, 8}, {240, 320}};
    const unsigned sizes = CHECK_SANITIZED ? 5 : 44;
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    for (unsigned shade = 0; shade < 2; shade++) {
        tuile_config_t config = stage_panel_config(&stage);
        config.shade = (uint8_t)shade;
        uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, NULL);
        for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
            uint32_t passes_least = 0, passes_most = 0, early = 0, late = 0;
            config.tile_width = tiles[i][0];
            config.tile_height = tiles[i][1];
            const size_t least = frame_least_bytes(&config);
            for (unsigned k = 0; k < sizes; k++) {
                const unsigned at = k * 43 / (sizes - 1);
                tuile_stats_t stats;
                uint8_t *picture = frame_draw(&stage.view.scene, &config, least + at * at * 64, &stats);
                if (memcmp(picture, expected, frame_bytes(&config)) != 0) {
                    fail_msg("tiles %ux%u, shade %u, %zu bytes: another picture", tiles[i][0], tiles[i][1], shade,
                             least + at * at * 64);
                }
                free(picture);
                if (k == 0) {
                    passes_least = stats.passes;
                    assert_true(stats.tiles_narrow > 0);
                }
                passes_most = stats.passes;
                early += k < sizes / 2 ? stats.passes : 0;
                late += k >= sizes - sizes / 2 ? stats.passes : 0;
            }
            assert_int_equal(passes_most, 1);
            assert_true(passes_least > 1 && late < early);
        }
        free(expected);
    }
    stage_close(&stage);
}

static void odd_sizes_of_the_block_are_used_up_to_a_multiple_of_eight(void **state) {
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    tuile_config_t config = stage_panel_config(&stage);
    config.tile_height = 4;
    uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, NULL);
    const size_t least = frame_least_bytes(&config);
    for (size_t more = 1; more < 8; more += CHECK_SANITIZED ? 3 : 1) {
        uint8_t *picture = frame_draw(&stage.view.scene, &config, least + more, NULL);
        assert_memory_equal(picture, expected, frame_bytes(&config));
        free(picture);
    }
    free(expected);
    stage_close(&stage);
}

static void faces_cut_by_the_near_plane_need_no_more_than_the_least_block(void **state) {
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_room(&mesh);
    stage_open(&stage, &mesh, 120, 90);
    view_options_t inside = VIEW_OPTIONS_DEFAULT;
    inside.has_eye = inside.has_at = inside.has_near = true;
    inside.eye[2] = 3.5;
    inside.at[0] = 0.3;
    inside.near = 0.01;
    inside.fov = 90;
    for (unsigned frame = 0; frame < 8; frame++) {
        inside.at[0] = 4 * cos(frame * 0.785398);
        inside.at[2] = 3.5 + 4 * sin(frame * 0.785398);
        inside.at[1] = 0.2;
        stage_aim(&stage, &inside, 120, 90);
        for (unsigned shade = 0; shade < 2; shade++) {
            tuile_config_t config = {.width = 120, .height = 90, .shade = (uint8_t)shade, .corners = 10};
            tuile_stats_t stats;
            uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, &stats);
            assert_true(stats.faces_clipped > 0);
            config.cluster_vertices = stage.compiled.model.cluster_vertices_max;
            config.tile_width = 24;
            config.tile_height = 6;
            uint8_t *picture = frame_draw(&stage.view.scene, &config, frame_least_bytes(&config), &stats);
            assert_memory_equal(picture, expected, frame_bytes(&config));
            free(picture);
            free(expected);
        }
    }
    stage_close(&stage);
}

/* A comb of a floor whose teeth reach through the near plane: every other corner is cut off and two others take its place. */
static void a_polygon_of_many_corners_cut_by_the_near_plane_fits_the_least_block(void **state) {
    static const unsigned counts[] = {6, 20, 40, 60, 100, 180, 254};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(counts) - (CHECK_SANITIZED ? 2 : 0); i++) {
        const unsigned n = counts[i];
        model_compiled_t comb;
        mesh_t mesh;
        uint32_t corners[254];
        model_start(&mesh);
        for (unsigned k = 0; k < n - 2; k++) {
            corners[k] = model_position(&mesh, (double)k / 32 - (n - 3) / 64.0, -1, k % 2 ? -0.25 : -3);
        }
        corners[n - 2] = model_position(&mesh, 4, -1, -4);
        corners[n - 1] = model_position(&mesh, -4, -1, -4);
        model_face(&mesh, corners, n, model_material(&mesh, 255, 255, 255));
        model_compile(&comb, &mesh);
        assert_int_equal(comb.model.face_count, 1);
        tuile_instance_t instance = {.model = &comb.model, .pose = {.scale = TUILE_SCALE_ONE}, .two_sided = true};
        for (unsigned a = 0; a < 3; a++) {
            instance.pose.rotation[a][a] = TUILE_ONE_Q30;
        }
        tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .ambient = 255, .camera = stage_plain_camera(64, 48)};
        scene.camera.projection = TUILE_PERSPECTIVE;
        scene.camera.eye[2] = 0;
        scene.camera.focal_x = scene.camera.focal_y = 24 << 16;
        scene.camera.near = 1 << 15;
        tuile_config_t config = {
            .width = 64, .height = 48, .tile_width = n < 100 ? 16 : 64, .tile_height = n < 100 ? 8 : 48, .corners = (uint16_t)n};
        tuile_stats_t stats;
        uint8_t *expected = frame_draw(&scene, &config, 1 << 20, &stats);
        assert_int_equal(stats.faces_clipped, 1);
        config.cluster_vertices = comb.model.cluster_vertices_max;
        block_t block;
        tuile_t *renderer;
        tuile_tile_t tile;
        block_open(&block, frame_least_bytes(&config));
        uint8_t *picture = frame_blank(&config);
        assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), TUILE_OK);
        assert_int_equal(tuile_begin(renderer, &scene), TUILE_OK);
        int result;
        while ((result = tuile_next(renderer, &tile)) == 1) {
            frame_paste(picture, &config, &tile);
        }
        if (result != 0) {
            fail_msg("%u corners, clusters of at most %u vertices: %s", n, config.cluster_vertices, tuile_error_text(result));
        }
        assert_memory_equal(picture, expected, frame_bytes(&config));
        block_close(&block);
        free(picture);
        free(expected);
        model_free(&comb);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_least_block_for_a_large_model_is_below_8_kilobytes_and_draws_it),
        cmocka_unit_test(a_large_model_takes_one_pass_in_64_kilobytes),
        cmocka_unit_test(the_peak_told_is_a_block_that_gives_as_few_passes),
        cmocka_unit_test(forty_sizes_of_memory_and_five_of_tiles_give_one_picture),
        cmocka_unit_test(odd_sizes_of_the_block_are_used_up_to_a_multiple_of_eight),
        cmocka_unit_test(faces_cut_by_the_near_plane_need_no_more_than_the_least_block),
        cmocka_unit_test(a_polygon_of_many_corners_cut_by_the_near_plane_fits_the_least_block),
    };
    return cmocka_run_group_tests_name("memory", tests, NULL, NULL);
}
