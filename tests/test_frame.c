/* Whole frames through the public header: tiles in any order, what is refused, several models in one scene, and light. */
#include "support/check.h"
#include "support/frame.h"
#include "support/random.h"
#include "support/stage.h"

#include <math.h>

/* ---- order and ownership ------------------------------------------------------------------------------------ */

static void tiles_sought_backwards_or_at_random_give_the_same_picture(void **state) {
    static const uint16_t tiles[][2] = {{240, 16}, {64, 32}};
    static const size_t sizes[] = {16384, 26000, 65536, 1 << 20};
    random_source_t random = random_seed(5);
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    for (unsigned i = 0; i < 2; i++) {
        tuile_config_t config = stage_panel_config(&stage);
        config.tile_width = tiles[i][0];
        config.tile_height = tiles[i][1];
        config.shade = TUILE_GOURAUD;
        uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, NULL);
        for (unsigned s = CHECK_SANITIZED ? 2 : 0; s < CHECK_COUNT(sizes); s++) {
            for (unsigned way = 0; way < 2; way++) {
                block_t block;
                tuile_t *renderer;
                tuile_tile_t tile;
                uint8_t *picture = frame_blank(&config);
                block_open(&block, sizes[s] < frame_least_bytes(&config) ? frame_least_bytes(&config) : sizes[s]);
                assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), 0);
                assert_int_equal(tuile_begin(renderer, &stage.view.scene), 0);
                const uint32_t count = (uint32_t)((240 + tiles[i][0] - 1) / tiles[i][0] * ((320 + tiles[i][1] - 1) / tiles[i][1]));
                uint32_t order[400];
                for (uint32_t k = 0; k < count; k++) {
                    order[k] = count - 1 - k;
                }
                for (uint32_t k = count - 1; way == 1 && k > 0; k--) {
                    const uint32_t j = (uint32_t)random_between(&random, 0, (int32_t)k), swap = order[k];
                    order[k] = order[j];
                    order[j] = swap;
                }
                for (uint32_t k = 0; k < count; k++) {
                    assert_int_equal(tuile_seek(renderer, order[k]), 0);
                    assert_int_equal(tuile_next(renderer, &tile), 1);
                    frame_paste(picture, &config, &tile);
                }
                assert_memory_equal(picture, expected, frame_bytes(&config));
                block_close(&block);
                free(picture);
            }
        }
        free(expected);
    }
    stage_close(&stage);
}

static void two_renderers_in_turns_draw_a_band_each(void **state) {
    stage_t stage;
    tuile_t *renderers[2];
    block_t blocks[2];
    tuile_tile_t tile;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    tuile_config_t config = stage_panel_config(&stage);
    config.tile_height = 16;
    uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, NULL), *picture = frame_blank(&config);
    for (unsigned i = 0; i < 2; i++) {
        tuile_config_t band = config;
        band.row_first = i ? 160 : 0;
        band.row_end = i ? 0 : 160;
        block_open(&blocks[i], 32768);
        assert_int_equal(tuile_init(&renderers[i], &band, blocks[i].bytes, blocks[i].size_bytes, NULL), 0);
        assert_int_equal(tuile_begin(renderers[i], &stage.view.scene), 0);
    }
    for (unsigned k = 0; k < 10; k++) {
        for (unsigned i = 0; i < 2; i++) {
            assert_int_equal(tuile_next(renderers[i], &tile), 1);
            assert_int_equal(tile.y, 160 * i + 16 * k);
            frame_paste(picture, &config, &tile);
        }
    }
    for (unsigned i = 0; i < 2; i++) {
        assert_int_equal(tuile_next(renderers[i], &tile), 0);
        assert_int_equal(tuile_next(renderers[i], &tile), 0);
        assert_int_equal(tuile_end(renderers[i], NULL), 0);
        block_close(&blocks[i]);
    }
    assert_memory_equal(picture, expected, frame_bytes(&config));
    free(picture);
    free(expected);
    stage_close(&stage);
}

static void a_tile_on_the_wire_is_not_touched_while_the_next_is_drawn(void **state) {
    static const size_t more[] = {0, 4000, 200000};
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    for (unsigned m = 0; m < 3; m++) {
        tuile_config_t config = stage_panel_config(&stage);
        config.tile_height = 16;
        block_t block;
        tuile_t *renderer;
        tuile_tile_t tile, next;
        uint8_t copy[240 * 16 * 2];
        block_open(&block, frame_least_bytes(&config) + more[m]);
        assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), 0);
        for (unsigned frame = 0; frame < 2; frame++) {
            assert_int_equal(tuile_begin(renderer, &stage.view.scene), 0);
            assert_int_equal(tuile_next(renderer, &tile), 1);
            for (;;) {
                memcpy(copy, tile.bytes, tile.size_bytes);
                const int result = tuile_next(renderer, &next);
                assert_memory_equal(tile.bytes, copy, tile.size_bytes);
                if (result == 0) { break; }
                assert_ptr_not_equal(next.bytes, tile.bytes);
                tile = next;
            }
            /* Nor by the end of the frame. */
            assert_int_equal(tuile_end(renderer, NULL), 0);
            assert_memory_equal(tile.bytes, copy, tile.size_bytes);
        }
        block_close(&block);
    }
    stage_close(&stage);
}

/* What is prepared is left out of the next tile, and neither buffer is touched by it: with more passes than one, too. */
static void what_is_prepared_touches_no_tile_and_is_not_done_again(void **state) {
    static const size_t more[] = {0, 4000, 200000};
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    for (unsigned m = 0; m < 3; m++) {
        tuile_config_t config = stage_panel_config(&stage);
        config.tile_height = 16;
        block_t block;
        tuile_t *renderer;
        tuile_tile_t tile, sent[2] = {0}; /* by turns, as its buffers */
        tuile_stats_t plain, prepared;
        uint8_t copies[2][240 * 16 * 2], *picture = frame_blank(&config), *again = frame_blank(&config);
        unsigned turn = 0;
        block_open(&block, frame_least_bytes(&config) + more[m]);
        assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), 0);
        assert_int_equal(tuile_prepare(NULL), TUILE_ERROR_ARGUMENT);
        assert_int_equal(tuile_prepare(renderer), TUILE_ERROR_SEQUENCE);
        for (unsigned frame = 0; frame < 2; frame++) { /* the second knows the first one's passes */
            assert_int_equal(tuile_begin(renderer, &stage.view.scene), 0);
            for (; tuile_next(renderer, &tile) == 1; turn ^= 1) {
                frame_paste(picture, &config, &tile);
                sent[turn] = tile;
            }
            assert_int_equal(tuile_end(renderer, &plain), 0);
        }
        assert_int_equal(tuile_begin(renderer, &stage.view.scene), 0);
        for (;; turn ^= 1) {
            for (unsigned i = 0; i < 2; i++) {
                memcpy(copies[i], sent[i].bytes, sent[i].size_bytes);
            }
            const int result = tuile_prepare(renderer);
            assert_int_equal(tuile_prepare(renderer), result);
            for (unsigned i = 0; i < 2; i++) {
                assert_memory_equal(sent[i].bytes, copies[i], sent[i].size_bytes);
            }
            assert_int_equal(tuile_next(renderer, &tile), result);
            if (result == 0) { break; }
            frame_paste(again, &config, &tile);
            sent[turn] = tile;
        }
        assert_int_equal(tuile_end(renderer, &prepared), 0);
        assert_memory_equal(again, picture, frame_bytes(&config));
        assert_int_equal(prepared.passes, plain.passes);
        assert_int_equal(prepared.vertices, plain.vertices);
        assert_int_equal(prepared.faces_binned, plain.faces_binned);
        free(picture);
        free(again);
        block_close(&block);
    }
    stage_close(&stage);
}

static void one_buffer_takes_less_memory_for_the_same_picture(void **state) {
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    tuile_config_t config = stage_panel_config(&stage), one = config;
    one.buffers = 1;
    one.tile_height = config.tile_height = 16;
    assert_int_equal(frame_least_bytes(&config) - frame_least_bytes(&one), 240 * 16 * 2);
    uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 18, NULL),
            *picture = frame_draw(&stage.view.scene, &one, 20000, NULL);
    assert_memory_equal(picture, expected, frame_bytes(&config));
    free(picture);
    free(expected);
    stage_close(&stage);
}

static void a_frame_that_was_broken_off_leaves_no_trace_in_the_next(void **state) {
    stage_t stage;
    block_t block;
    tuile_t *renderer;
    tuile_tile_t tile;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    tuile_config_t config = stage_panel_config(&stage);
    config.tile_height = 16;
    uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, NULL), *picture = frame_blank(&config);
    block_open(&block, 40000);
    assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), 0);
    for (unsigned stop = 0; stop < 20; stop += 3) {
        assert_int_equal(tuile_begin(renderer, &stage.view.scene), 0);
        for (unsigned k = 0; k < stop; k++) {
            assert_int_equal(tuile_next(renderer, &tile), 1);
        }
        assert_int_equal(tuile_end(renderer, NULL), 0);
    }
    assert_int_equal(tuile_begin(renderer, &stage.view.scene), 0);
    while (tuile_next(renderer, &tile) == 1) {
        frame_paste(picture, &config, &tile);
    }
    assert_memory_equal(picture, expected, frame_bytes(&config));
    block_close(&block);
    free(picture);
    free(expected);
    stage_close(&stage);
}

static void the_other_order_of_bytes_is_the_same_picture(void **state) {
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    for (unsigned shade = 0; shade < 2; shade++) {
        tuile_config_t config = stage_panel_config(&stage);
        config.shade = (uint8_t)shade;
        uint8_t *big = frame_draw(&stage.view.scene, &config, 1 << 18, NULL);
        config.format = TUILE_RGB565_LE;
        uint8_t *little = frame_draw(&stage.view.scene, &config, 1 << 18, NULL);
        for (size_t i = 0; i < frame_bytes(&config); i++) {
            if (big[i] != little[i ^ 1]) { fail_msg("byte %zu", i); }
        }
        free(big);
        free(little);
    }
    stage_close(&stage);
}

/* ---- what is refused ---------------------------------------------------------------------------------------- */

static void a_configuration_out_of_range_is_an_argument_error(void **state) {
    static const tuile_config_t bad[] = {
        {.width = 0, .height = 8},
        {.width = 8, .height = 0},
        {.width = 1025, .height = 8},
        {.width = 8, .height = 1025},
        {.width = 8, .height = 8, .tile_width = 1025},
        {.width = 8, .height = 8, .tile_height = 1025},
        {.width = 8, .height = 8, .format = TUILE_FORMAT_COUNT},
        {.width = 8, .height = 8, .method = TUILE_TREE + 1},
        {.width = 8, .height = 8, .shade = 2},
        {.width = 8, .height = 8, .tie = 2},
        {.width = 8, .height = 8, .buffers = 3},
        {.width = 8, .height = 8, .cluster_vertices = 256},
        {.width = 8, .height = 8, .corners = 256},
        {.width = 8, .height = 8, .row_first = 9},
        {.width = 8, .height = 8, .row_end = 9},
        {.width = 8, .height = 8, .row_first = 5, .row_end = 4},
    };
    static const tuile_config_t good = {.width = 8, .height = 8};
    static uint64_t block[2048];
    tuile_t *renderer;
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        const int result = tuile_init(&renderer, &bad[i], block, sizeof block, NULL);
        if (result != TUILE_ERROR_ARGUMENT) { fail_msg("configuration %u: %d", i, result); }
        assert_null(renderer);
    }
    assert_int_equal(tuile_init(NULL, &good, block, sizeof block, NULL), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_init(&renderer, NULL, block, sizeof block, NULL), TUILE_ERROR_ARGUMENT);
    for (unsigned off = 1; off < 8; off++) {
        assert_int_equal(tuile_init(&renderer, &good, (uint8_t *)block + off, sizeof block - 8, NULL), TUILE_ERROR_ARGUMENT);
    }
    assert_int_equal(tuile_init(&renderer, &good, NULL, sizeof block, NULL), TUILE_ERROR_MEMORY);
    assert_int_equal(tuile_init(&renderer, &good, block, sizeof block, NULL), TUILE_OK);
    const tuile_config_t *c = tuile_config(renderer);
    assert_int_equal(c->tile_width, 8);
    assert_in_range(c->tile_height, 1, 8);
    assert_int_equal(c->buffers, 2);
    assert_int_equal(c->cluster_vertices, 255);
    assert_int_equal(c->corners, 4);
    assert_int_equal(c->tile_step, 1);
    assert_int_equal(c->row_end, 8);
}

static void calls_out_of_sequence_are_refused(void **state) {
    static uint64_t block[2048];
    const tuile_config_t config = {.width = 16, .height = 8, .tile_width = 8, .tile_height = 4};
    const tuile_scene_t nothing = {.instances = NULL};
    tuile_stats_t stats;
    tuile_tile_t tile;
    tuile_t *renderer;
    (void)state;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    assert_int_equal(tuile_next(renderer, &tile), TUILE_ERROR_SEQUENCE);
    assert_int_equal(tuile_seek(renderer, 0), TUILE_ERROR_SEQUENCE);
    assert_int_equal(tuile_end(renderer, &stats), TUILE_ERROR_SEQUENCE);
    assert_int_equal(tuile_begin(renderer, NULL), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_begin(NULL, &nothing), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_next(NULL, &tile), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_seek(NULL, 0), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_end(NULL, &stats), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_begin(renderer, &nothing), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, &nothing), TUILE_ERROR_SEQUENCE);
    assert_int_equal(tuile_next(renderer, NULL), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_seek(renderer, 4), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_seek(renderer, 3), TUILE_OK);
    assert_int_equal(tuile_next(renderer, &tile), 1);
    assert_int_equal(tuile_next(renderer, &tile), 0);
    assert_int_equal(tuile_end(renderer, &stats), TUILE_OK);
    assert_int_equal(stats.tiles, 1);
    assert_int_equal(tuile_end(renderer, &stats), TUILE_ERROR_SEQUENCE);
}

static void a_scene_that_cannot_be_drawn_is_refused_at_its_beginning(void **state) {
    static uint64_t block[8192];
    static tuile_light_t lights[9];
    stage_t stage;
    tuile_tile_t tile;
    tuile_t *renderer;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    tuile_config_t config = stage_panel_config(&stage);
    config.tile_height = 4;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);

    tuile_scene_t scene = stage.view.scene;
    for (unsigned i = 0; i < 9; i++) {
        lights[i] = (tuile_light_t){{0, 0, -TUILE_ONE_Q14}, 20};
    }
    scene.lights = lights;
    scene.light_count = 9;
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_ERROR_ARGUMENT);
    scene.light_count = 8;
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_OK);
    assert_int_equal(tuile_next(renderer, &tile), 1);
    assert_int_equal(tuile_end(renderer, NULL), TUILE_OK);
    scene.lights = NULL;
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_ERROR_ARGUMENT);
    scene.light_count = 0;
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_OK);
    assert_int_equal(tuile_end(renderer, NULL), TUILE_OK);

    scene = stage.view.scene;
    scene.instances = NULL;
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_ERROR_ARGUMENT);
    tuile_instance_t empty = stage.view.instance;
    empty.model = NULL;
    scene.instances = &empty;
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_ERROR_ARGUMENT);

    /* A cluster larger than the configuration promised. */
    config.cluster_vertices = (uint16_t)(stage.compiled.model.cluster_vertices_max - 1);
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, &stage.view.scene), TUILE_ERROR_LIMITS);
    stage_close(&stage);

    /* A face with more corners. */
    mesh_t mesh;
    model_room(&mesh);
    stage_open(&stage, &mesh, 240, 320);
    assert_int_equal(stage.compiled.model.corners_max, 10);
    for (unsigned corners = 0; corners <= 10; corners += corners ? 1 : 9) {
        config = stage_panel_config(&stage);
        config.tile_height = 4;
        config.corners = (uint16_t)corners;
        assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
        assert_int_equal(tuile_begin(renderer, &stage.view.scene), corners == 10 ? TUILE_OK : TUILE_ERROR_LIMITS);
    }
    stage_close(&stage);
}

static void a_bad_camera_is_an_error_and_not_a_picture(void **state) {
    static uint64_t block[8192];
    stage_t stage;
    tuile_tile_t tile;
    tuile_t *renderer;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    tuile_config_t config = stage_panel_config(&stage);
    config.tile_height = 4;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    for (unsigned k = 0; k < 4; k++) {
        tuile_scene_t scene = stage.view.scene;
        scene.camera.near = k == 0 ? 0 : k == 1 ? -1 : scene.camera.near;
        scene.camera.far = k == 2 ? scene.camera.near : scene.camera.far;
        scene.camera.focal_x = k == 3 ? 0 : scene.camera.focal_x;
        int result = tuile_begin(renderer, &scene);
        const bool begun = result == TUILE_OK;
        if (begun) { result = tuile_next(renderer, &tile); }
        if (result != TUILE_ERROR_CAMERA) { fail_msg("camera %u: %d", k, result); }
        if (begun) { assert_int_equal(tuile_end(renderer, NULL), TUILE_OK); }
    }
    stage_close(&stage);
}

/* ---- instances ---------------------------------------------------------------------------------------------- */

static void a_scene_without_instances_is_background(void **state) {
    const tuile_config_t config = {.width = 33, .height = 17, .tile_width = 8, .tile_height = 8};
    const tuile_scene_t scene = {.background = {0x18, 0x20, 0x30}};
    tuile_stats_t stats;
    (void)state;
    uint8_t *picture = frame_draw(&scene, &config, 4608, &stats);
    for (size_t i = 0; i < frame_bytes(&config); i += 2) { /* 24 -> 3 of 31, 32 -> 8 of 63, 48 -> 6 of 31 */
        assert_int_equal(picture[i] << 8 | picture[i + 1], 3 << 11 | 8 << 5 | 6);
    }
    assert_int_equal(stats.faces, 0);
    assert_int_equal(stats.tiles, 15);
    free(picture);
    uint32_t *ids = frame_draw_ids(&scene, 33, 17);
    for (unsigned i = 0; i < 33 * 17; i++) {
        assert_int_equal(ids[i], 0);
    }
    free(ids);
}

static void ids_are_counted_through_two_models(void **state) {
    model_compiled_t cube, octahedron;
    mesh_t mesh;
    (void)state;
    model_cube(&mesh);
    model_compile(&cube, &mesh);
    model_octahedron(&mesh);
    model_compile(&octahedron, &mesh);
    const tuile_instance_t instances[3] = {stage_placed(&cube.model, -3), stage_placed(&octahedron.model, 0),
                                           stage_placed(&cube.model, 3)};
    const tuile_light_t light = {{0, 0, -TUILE_ONE_Q14}, 255};
    tuile_scene_t scene = {
        .instances = instances, .instance_count = 3, .lights = &light, .light_count = 1, .camera = stage_plain_camera(160, 64)};
    uint32_t *ids = frame_draw_ids(&scene, 160, 64);

    /* The cube's front is its first face in the source; it covers 32 x 32 pixels about (80 - 48, 32) and (80 + 48, 32). */
    const uint32_t front = ids[32 * 160 + 32];
    assert_in_range(front, 1, 6);
    assert_int_equal(tuile_model_source_face(&cube.model, front - 1), 0);
    assert_int_equal(ids[32 * 160 + 128], front + 6 + 8);
    for (unsigned y = 0; y < 64; y++) {
        for (unsigned x = 0; x < 160; x++) {
            const uint32_t id = ids[y * 160 + x];
            if (y >= 16 && y < 48 && x >= 16 && x < 48) {
                assert_int_equal(id, front);
            } else if (y >= 16 && y < 48 && x >= 112 && x < 144) {
                assert_int_equal(id, front + 14);
            } else if (id != 0) {
                assert_in_range(id, 7, 14);
            }
        }
    }
    /* Of the octahedron the four octants with z > 0, one in each quarter: source 0 is +x +y, 1 is -x +y, 2 is +x -y. */
    static const struct { unsigned x, y, source; } quarters[] = {{84, 28, 0}, {75, 28, 1}, {84, 35, 2}, {75, 35, 3}};
    for (unsigned q = 0; q < 4; q++) {
        const uint32_t id = ids[quarters[q].y * 160 + quarters[q].x];
        assert_in_range(id, 7, 14);
        assert_int_equal(tuile_model_source_face(&octahedron.model, id - 7), quarters[q].source);
    }
    free(ids);

    /* Colours: the cube's grey on both sides, red and blue between. */
    for (unsigned shade = 0; shade < 2; shade++) {
        const tuile_config_t config = {.width = 160, .height = 64, .format = TUILE_RGB565_LE, .shade = (uint8_t)shade};
        uint16_t *picture = (uint16_t *)(void *)frame_draw(&scene, &config, 1 << 16, NULL);
        const unsigned left = picture[32 * 160 + 32], right = picture[32 * 160 + 128], red = picture[28 * 160 + 84],
                       blue = picture[28 * 160 + 75];
        assert_int_equal(left, right);
        assert_in_range(left >> 11, 23, 25); /* 204 / 255 of 31, light at most 253 / 255 */
        assert_in_range(left >> 5 & 63, 49, 51);
        assert_true(red >> 11 > 4 * (red & 31));
        assert_true((blue & 31) > 3 * (blue >> 11));
        free(picture);
    }
    model_free(&cube);
    model_free(&octahedron);
}

/* A row of small triangles, each of its own colour. */
static void many_colours(model_compiled_t *compiled, unsigned count, unsigned blue) {
    mesh_t mesh;
    model_start(&mesh);
    for (unsigned i = 0; i < count; i++) {
        const double x = i % 16 * 0.25 - 2, y = i / 16 * 0.25 - 2;
        const uint32_t corners[3] = {model_position(&mesh, x, y, 0), model_position(&mesh, x + 0.25, y, 0),
                                     model_position(&mesh, x, y + 0.25, 0)};
        model_face(&mesh, corners, 3, model_material(&mesh, i, 255 - i, blue));
    }
    model_compile(compiled, &mesh);
    assert_int_equal(compiled->model.material_count, count);
}

static void instances_of_one_model_share_its_materials(void **state) {
    static uint64_t block[16384];
    model_compiled_t a, b;
    tuile_t *renderer;
    const tuile_config_t config = {.width = 160, .height = 64, .tile_height = 8, .shade = TUILE_GOURAUD};
    const tuile_light_t light = {{0, 0, -TUILE_ONE_Q14}, 255};
    (void)state;
    many_colours(&a, 200, 0);
    many_colours(&b, 57, 255);
    const tuile_instance_t same[3] = {stage_placed(&a.model, -3), stage_placed(&a.model, 3), stage_placed(&a.model, 100)};
    tuile_scene_t scene = {
        .instances = same, .instance_count = 3, .lights = &light, .light_count = 1, .camera = stage_plain_camera(160, 64)};
    uint16_t *picture = (uint16_t *)(void *)frame_draw(&scene, &config, sizeof block, NULL);
    for (unsigned y = 0; y < 64; y++) { /* six units to the right, the same triangles */
        for (unsigned x = 0; x < 64; x++) {
            assert_int_equal(picture[y * 160 + x], picture[y * 160 + x + 96]);
        }
    }
    free(picture);
    const tuile_instance_t both[2] = {stage_placed(&a.model, -3), stage_placed(&b.model, 3)};
    scene.instances = both;
    scene.instance_count = 2;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_ERROR_ARGUMENT); /* 257 materials */
    model_free(&b);
    many_colours(&b, 56, 255);
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_OK);
    assert_int_equal(tuile_end(renderer, NULL), TUILE_OK);

    /* However few ramps there is room for. */
    uint8_t *expected = frame_draw(&scene, &config, 1 << 20, NULL);
    for (size_t size = frame_least_bytes(&config); size < 60000; size += 5003) {
        uint8_t *other = frame_draw(&scene, &config, size, NULL);
        assert_memory_equal(other, expected, frame_bytes(&config));
        free(other);
    }
    free(expected);
    model_free(&a);
    model_free(&b);
}

/* ---- light -------------------------------------------------------------------------------------------------- */

static void interpolated_light_on_a_flat_face_is_the_face_s_own(void **state) {
    stage_t stage;
    mesh_t mesh;
    unsigned seen = 0;
    (void)state;
    model_cube(&mesh);
    model_flat_normals(&mesh);
    stage_open(&stage, &mesh, 120, 90);
    for (unsigned k = 0; k < 24; k++) {
        view_options_t options = VIEW_OPTIONS_DEFAULT;
        options.has_eye = true;
        options.eye[0] = 5 * cos(0.7 * k);
        options.eye[1] = 0.4 * k - 4;
        options.eye[2] = 5 * sin(0.7 * k);
        options.has_ortho = k % 2 != 0;
        options.ortho = 4;
        stage_aim(&stage, &options, 120, 90);
        tuile_config_t config = {.width = 120, .height = 90, .format = TUILE_RGB565_LE};
        uint16_t *flat = (uint16_t *)(void *)frame_draw(&stage.view.scene, &config, 1 << 18, NULL);
        config.shade = TUILE_GOURAUD;
        uint16_t *gouraud = (uint16_t *)(void *)frame_draw(&stage.view.scene, &config, 1 << 18, NULL);
        for (unsigned i = 0; i < 120 * 90; i++) {
            const int red = (flat[i] >> 11) - (gouraud[i] >> 11), green = (flat[i] >> 5 & 63) - (gouraud[i] >> 5 & 63);
            const int blue = (flat[i] & 31) - (gouraud[i] & 31);
            if (abs(red) > 1 || abs(green) > 1 || abs(blue) > 1) {
                fail_msg("camera %u, pixel %u: %04x and %04x", k, i, flat[i], gouraud[i]);
            }
            seen += flat[i] != 0;
        }
        free(flat);
        free(gouraud);
    }
    assert_true(seen > 24 * 1000);
    stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_sought_backwards_or_at_random_give_the_same_picture),
        cmocka_unit_test(two_renderers_in_turns_draw_a_band_each),
        cmocka_unit_test(a_tile_on_the_wire_is_not_touched_while_the_next_is_drawn),
        cmocka_unit_test(what_is_prepared_touches_no_tile_and_is_not_done_again),
        cmocka_unit_test(one_buffer_takes_less_memory_for_the_same_picture),
        cmocka_unit_test(a_frame_that_was_broken_off_leaves_no_trace_in_the_next),
        cmocka_unit_test(the_other_order_of_bytes_is_the_same_picture),
        cmocka_unit_test(a_configuration_out_of_range_is_an_argument_error),
        cmocka_unit_test(calls_out_of_sequence_are_refused),
        cmocka_unit_test(a_scene_that_cannot_be_drawn_is_refused_at_its_beginning),
        cmocka_unit_test(a_bad_camera_is_an_error_and_not_a_picture),
        cmocka_unit_test(a_scene_without_instances_is_background),
        cmocka_unit_test(ids_are_counted_through_two_models),
        cmocka_unit_test(instances_of_one_model_share_its_materials),
        cmocka_unit_test(interpolated_light_on_a_flat_face_is_the_face_s_own),
    };
    return cmocka_run_group_tests_name("frame", tests, NULL, NULL);
}
