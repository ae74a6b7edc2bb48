/* Whole frames through the public header: any memory and any order of tiles, what is refused, closed surfaces without holes,
 * picking, and the way of a picture over the wire in four rotations. */
#include "support/check.h"
#include "support/models.h"
#include "support/random.h"

#include "../firmware/stream.h"
#include "../hal/panels/ili9341.h"
#include "../sim/bus.h"
#include "../sim/chips/ili9341.h"
#include "../sim/view.h"

#include <math.h>

#define CANARY 0xa5
#define MARGIN_BYTES 64u

/* ---- scenes ------------------------------------------------------------------------------------------------- */

/* One model under a camera; view points into itself, so a stage stays where it is. */
typedef struct stage {
    model_compiled_t compiled;
    view_t view;
} stage_t;

static void stage_aim(stage_t *stage, const view_options_t *options, uint16_t width, uint16_t height) {
    view_options_t o = options ? *options : VIEW_OPTIONS_DEFAULT;
    sim_error_t error = {""};
    if (!options) { memcpy(o.background, (const uint8_t[3]){0x18, 0x20, 0x30}, 3); }
    if (view_make(&stage->view, &o, &stage->compiled.model, width, height, 1, &error) != 0) { fail_msg("%s", error.text); }
}

static void stage_open(stage_t *stage, mesh_t *mesh, uint16_t width, uint16_t height) {
    model_compile(&stage->compiled, mesh);
    stage_aim(stage, NULL, width, height);
}

static void stage_close(stage_t *stage) { model_free(&stage->compiled); }

/* The torus of the figures: 5800 triangles. */
static void open_torus(stage_t *stage, uint16_t width, uint16_t height) {
    mesh_t mesh;
    model_torus(&mesh, 100, 29, true);
    stage_open(stage, &mesh, width, height);
    assert_int_equal(stage->compiled.model.face_count, 5800);
}

/* A block of exactly size_bytes between two margins; under a sanitizer without them, so that it sees what goes beyond. */
typedef struct block {
    uint8_t *memory, *bytes;
    size_t size_bytes;
} block_t;

static void block_open(block_t *block, size_t size_bytes) {
    const size_t margin = CHECK_SANITIZED ? 0 : MARGIN_BYTES;
    block->memory = malloc(size_bytes + 2 * margin);
    assert_non_null(block->memory);
    memset(block->memory, CANARY, size_bytes + 2 * margin);
    block->bytes = block->memory + margin;
    block->size_bytes = size_bytes;
}

static void block_close(block_t *block) {
    for (size_t i = 0; !CHECK_SANITIZED && i < MARGIN_BYTES; i++) {
        assert_int_equal(block->memory[i], CANARY);
        assert_int_equal(block->bytes[block->size_bytes + i], CANARY);
    }
    free(block->memory);
}

static void paste(uint8_t *picture, const tuile_config_t *config, const tuile_tile_t *tile) {
    const size_t pixel = TUILE_FORMAT_BYTES(config->format);
    assert_int_equal(tile->size_bytes, pixel * tile->width * tile->height);
    assert_in_range(tile->x + tile->width, 1, config->width);
    assert_in_range(tile->y + tile->height, 1, config->height);
    for (unsigned y = 0; y < tile->height; y++) {
        memcpy(picture + pixel * ((size_t)(tile->y + y) * config->width + tile->x), tile->bytes + pixel * y * tile->width,
               pixel * tile->width);
    }
}

static size_t picture_bytes(const tuile_config_t *config) {
    return (size_t)TUILE_FORMAT_BYTES(config->format) * config->width * config->height;
}

static uint8_t *blank(const tuile_config_t *config) {
    uint8_t *picture = malloc(picture_bytes(config));
    assert_non_null(picture);
    memset(picture, 0x5a, picture_bytes(config));
    return picture;
}

static size_t least_bytes(const tuile_config_t *config) {
    tuile_t *renderer;
    size_t wanted = 0;
    assert_int_equal(tuile_init(&renderer, config, NULL, 0, &wanted), TUILE_ERROR_MEMORY);
    return wanted;
}

/* The whole picture, to be released with free. */
static uint8_t *draw(const tuile_scene_t *scene, const tuile_config_t *config, size_t size_bytes, tuile_stats_t *stats) {
    block_t block;
    tuile_t *renderer;
    tuile_tile_t tile;
    uint8_t *picture = blank(config);
    int result;
    block_open(&block, size_bytes);
    assert_int_equal(tuile_init(&renderer, config, block.bytes, size_bytes, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, scene), TUILE_OK);
    while ((result = tuile_next(renderer, &tile)) == 1) {
        paste(picture, config, &tile);
    }
    assert_int_equal(result, 0);
    assert_int_equal(tuile_end(renderer, stats), TUILE_OK);
    block_close(&block);
    return picture;
}

static uint32_t *draw_ids(const tuile_scene_t *scene, uint16_t width, uint16_t height) {
    const tuile_config_t config = {.width = width, .height = height, .format = TUILE_FACE_IDS, .corners = 255};
    return (uint32_t *)(void *)draw(scene, &config, 1 << 20, NULL);
}

static tuile_config_t panel_config(const stage_t *stage) {
    return (tuile_config_t){.width = 240, .height = 320, .cluster_vertices = stage->compiled.model.cluster_vertices_max};
}

/* An orthographic camera at 40 units looking along -z, 16 pixels a unit. */
static tuile_camera_t plain_camera(uint16_t width, uint16_t height) {
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

/* ---- memory ------------------------------------------------------------------------------------------------- */

static void the_least_block_for_a_large_model_is_below_8_kilobytes_and_draws_it(void **state) {
    stage_t stage;
    tuile_stats_t stats;
    (void)state;
    open_torus(&stage, 240, 320);
    tuile_config_t config = panel_config(&stage);
    config.tile_height = 4;
    uint8_t *expected = draw(&stage.view.scene, &config, 1 << 20, &stats);
    assert_int_equal(stats.passes, 1);
    const size_t least = least_bytes(&config);
    assert_int_equal(
        least, TUILE_LEAST_BYTES((size_t)320, (size_t)240, (size_t)4, TUILE_RGB565_BE, (size_t)2, (size_t)config.cluster_vertices));
    assert_in_range(least, 1, 8192);
    uint8_t *picture = draw(&stage.view.scene, &config, least, &stats);
    assert_memory_equal(picture, expected, picture_bytes(&config));
    assert_int_equal(stats.size_bytes, least);
    assert_int_equal(stats.least_bytes, least);
    assert_true(stats.tiles_immediate > 0);
    assert_int_equal(stats.tiles, 80);
    assert_int_equal(stats.faces, 5800);
    free(picture);
    free(expected);
    stage_close(&stage);
}

static void a_large_model_takes_one_pass_in_64_kilobytes(void **state) {
    stage_t stage;
    (void)state;
    open_torus(&stage, 240, 320);
    for (unsigned shade = 0; shade < 2; shade++) {
        tuile_stats_t stats;
        tuile_config_t config = panel_config(&stage);
        config.tile_height = 8;
        config.shade = (uint8_t)shade;
        free(draw(&stage.view.scene, &config, 65536, &stats));
        assert_int_equal(stats.passes, 1);
        assert_int_equal(stats.tiles_immediate, 0);
        assert_in_range(stats.peak_bytes, stats.least_bytes / 2, 65536);
    }
    stage_close(&stage);
}

static void the_peak_told_is_a_block_that_gives_as_few_passes(void **state) {
    stage_t stage;
    tuile_stats_t first, second;
    (void)state;
    open_torus(&stage, 240, 320);
    tuile_config_t config = panel_config(&stage);
    config.tile_height = 8;
    free(draw(&stage.view.scene, &config, 1 << 20, &first));
    free(draw(&stage.view.scene, &config, (first.peak_bytes + 7u) & ~(size_t)7, &second));
    assert_int_equal(first.passes, 1);
    assert_int_equal(second.passes, first.passes);
    stage_close(&stage);
}

static void forty_sizes_of_memory_and_five_of_tiles_give_one_picture(void **state) {
    static const uint16_t tiles[][2] = {{240, 4}, {240, 16}, {32, 32}, {64, 8}, {240, 320}};
    const unsigned sizes = CHECK_SANITIZED ? 5 : 44;
    stage_t stage;
    (void)state;
    open_torus(&stage, 240, 320);
    for (unsigned shade = 0; shade < 2; shade++) {
        tuile_config_t config = panel_config(&stage);
        config.shade = (uint8_t)shade;
        uint8_t *expected = draw(&stage.view.scene, &config, 1 << 20, NULL);
        for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
            uint32_t passes_least = 0, passes_most = 0, early = 0, late = 0;
            config.tile_width = tiles[i][0];
            config.tile_height = tiles[i][1];
            const size_t least = least_bytes(&config);
            for (unsigned k = 0; k < sizes; k++) {
                const unsigned at = k * 43 / (sizes - 1);
                tuile_stats_t stats;
                uint8_t *picture = draw(&stage.view.scene, &config, least + at * at * 64, &stats);
                if (memcmp(picture, expected, picture_bytes(&config)) != 0) {
                    fail_msg("tiles %ux%u, shade %u, %zu bytes: another picture", tiles[i][0], tiles[i][1], shade,
                             least + at * at * 64);
                }
                free(picture);
                if (k == 0) {
                    passes_least = stats.passes;
                    assert_true(stats.tiles_immediate > 0);
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
    open_torus(&stage, 240, 320);
    tuile_config_t config = panel_config(&stage);
    config.tile_height = 4;
    uint8_t *expected = draw(&stage.view.scene, &config, 1 << 20, NULL);
    const size_t least = least_bytes(&config);
    for (size_t more = 1; more < 8; more += CHECK_SANITIZED ? 3 : 1) {
        uint8_t *picture = draw(&stage.view.scene, &config, least + more, NULL);
        assert_memory_equal(picture, expected, picture_bytes(&config));
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
    inside.has_eye = inside.has_at = inside.has_near = inside.has_fov = true;
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
            uint8_t *expected = draw(&stage.view.scene, &config, 1 << 20, &stats);
            assert_true(stats.faces_clipped > 0);
            config.cluster_vertices = stage.compiled.model.cluster_vertices_max;
            config.tile_width = 24;
            config.tile_height = 6;
            uint8_t *picture = draw(&stage.view.scene, &config, least_bytes(&config), &stats);
            assert_memory_equal(picture, expected, picture_bytes(&config));
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
        tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .ambient = 255, .camera = plain_camera(64, 48)};
        scene.camera.projection = TUILE_PERSPECTIVE;
        scene.camera.eye[2] = 0;
        scene.camera.focal_x = scene.camera.focal_y = 24 << 16;
        scene.camera.near = 1 << 15;
        tuile_config_t config = {
            .width = 64, .height = 48, .tile_width = n < 100 ? 16 : 64, .tile_height = n < 100 ? 8 : 48, .corners = (uint16_t)n};
        tuile_stats_t stats;
        uint8_t *expected = draw(&scene, &config, 1 << 20, &stats);
        assert_int_equal(stats.faces_clipped, 1);
        config.cluster_vertices = comb.model.cluster_vertices_max;
        block_t block;
        tuile_t *renderer;
        tuile_tile_t tile;
        block_open(&block, least_bytes(&config));
        uint8_t *picture = blank(&config);
        assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), TUILE_OK);
        assert_int_equal(tuile_begin(renderer, &scene), TUILE_OK);
        int result;
        while ((result = tuile_next(renderer, &tile)) == 1) {
            paste(picture, &config, &tile);
        }
        if (result != 0) {
            fail_msg("%u corners, clusters of at most %u vertices: %s", n, config.cluster_vertices, tuile_error_text(result));
        }
        assert_memory_equal(picture, expected, picture_bytes(&config));
        block_close(&block);
        free(picture);
        free(expected);
        model_free(&comb);
    }
}

/* ---- order and ownership ------------------------------------------------------------------------------------ */

static void tiles_sought_backwards_or_at_random_give_the_same_picture(void **state) {
    static const uint16_t tiles[][2] = {{240, 16}, {64, 32}};
    static const size_t sizes[] = {16384, 26000, 65536, 1 << 20};
    random_source_t random = random_seed(5);
    stage_t stage;
    (void)state;
    open_torus(&stage, 240, 320);
    for (unsigned i = 0; i < 2; i++) {
        tuile_config_t config = panel_config(&stage);
        config.tile_width = tiles[i][0];
        config.tile_height = tiles[i][1];
        config.shade = TUILE_GOURAUD;
        uint8_t *expected = draw(&stage.view.scene, &config, 1 << 20, NULL);
        for (unsigned s = CHECK_SANITIZED ? 2 : 0; s < CHECK_COUNT(sizes); s++) {
            for (unsigned way = 0; way < 2; way++) {
                block_t block;
                tuile_t *renderer;
                tuile_tile_t tile;
                uint8_t *picture = blank(&config);
                block_open(&block, sizes[s] < least_bytes(&config) ? least_bytes(&config) : sizes[s]);
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
                    paste(picture, &config, &tile);
                }
                assert_memory_equal(picture, expected, picture_bytes(&config));
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
    open_torus(&stage, 240, 320);
    tuile_config_t config = panel_config(&stage);
    config.tile_height = 16;
    uint8_t *expected = draw(&stage.view.scene, &config, 1 << 20, NULL), *picture = blank(&config);
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
            paste(picture, &config, &tile);
        }
    }
    for (unsigned i = 0; i < 2; i++) {
        assert_int_equal(tuile_next(renderers[i], &tile), 0);
        assert_int_equal(tuile_next(renderers[i], &tile), 0);
        assert_int_equal(tuile_end(renderers[i], NULL), 0);
        block_close(&blocks[i]);
    }
    assert_memory_equal(picture, expected, picture_bytes(&config));
    free(picture);
    free(expected);
    stage_close(&stage);
}

static void a_tile_on_the_wire_is_not_touched_while_the_next_is_drawn(void **state) {
    static const size_t more[] = {0, 4000, 200000};
    stage_t stage;
    (void)state;
    open_torus(&stage, 240, 320);
    for (unsigned m = 0; m < 3; m++) {
        tuile_config_t config = panel_config(&stage);
        config.tile_height = 16;
        block_t block;
        tuile_t *renderer;
        tuile_tile_t tile, next;
        uint8_t copy[240 * 16 * 2];
        block_open(&block, least_bytes(&config) + more[m]);
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

static void one_buffer_takes_less_memory_for_the_same_picture(void **state) {
    stage_t stage;
    (void)state;
    open_torus(&stage, 240, 320);
    tuile_config_t config = panel_config(&stage), one = config;
    one.buffers = 1;
    one.tile_height = config.tile_height = 16;
    assert_int_equal(least_bytes(&config) - least_bytes(&one), 240 * 16 * 2);
    uint8_t *expected = draw(&stage.view.scene, &config, 1 << 18, NULL), *picture = draw(&stage.view.scene, &one, 20000, NULL);
    assert_memory_equal(picture, expected, picture_bytes(&config));
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
    open_torus(&stage, 240, 320);
    tuile_config_t config = panel_config(&stage);
    config.tile_height = 16;
    uint8_t *expected = draw(&stage.view.scene, &config, 1 << 20, NULL), *picture = blank(&config);
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
        paste(picture, &config, &tile);
    }
    assert_memory_equal(picture, expected, picture_bytes(&config));
    block_close(&block);
    free(picture);
    free(expected);
    stage_close(&stage);
}

static void the_other_order_of_bytes_is_the_same_picture(void **state) {
    stage_t stage;
    (void)state;
    open_torus(&stage, 240, 320);
    for (unsigned shade = 0; shade < 2; shade++) {
        tuile_config_t config = panel_config(&stage);
        config.shade = (uint8_t)shade;
        uint8_t *big = draw(&stage.view.scene, &config, 1 << 18, NULL);
        config.format = TUILE_RGB565_LE;
        uint8_t *little = draw(&stage.view.scene, &config, 1 << 18, NULL);
        for (size_t i = 0; i < picture_bytes(&config); i++) {
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
        {.width = 8, .height = 8, .format = 3},
        {.width = 8, .height = 8, .method = 1},
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
    open_torus(&stage, 240, 320);
    tuile_config_t config = panel_config(&stage);
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
        config = panel_config(&stage);
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
    open_torus(&stage, 240, 320);
    tuile_config_t config = panel_config(&stage);
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
    uint8_t *picture = draw(&scene, &config, 4096, &stats);
    for (size_t i = 0; i < picture_bytes(&config); i += 2) { /* 24 -> 3 of 31, 32 -> 8 of 63, 48 -> 6 of 31 */
        assert_int_equal(picture[i] << 8 | picture[i + 1], 3 << 11 | 8 << 5 | 6);
    }
    assert_int_equal(stats.faces, 0);
    assert_int_equal(stats.tiles, 15);
    free(picture);
    uint32_t *ids = draw_ids(&scene, 33, 17);
    for (unsigned i = 0; i < 33 * 17; i++) {
        assert_int_equal(ids[i], 0);
    }
    free(ids);
}

static tuile_instance_t placed(const tuile_model_t *model, int x) {
    tuile_instance_t instance = {.model = model, .pose = {.scale = TUILE_SCALE_ONE, .translation = {x * 65536, 0, 0}}};
    for (unsigned i = 0; i < 3; i++) {
        instance.pose.rotation[i][i] = TUILE_ONE_Q30;
    }
    return instance;
}

static void ids_are_counted_through_two_models(void **state) {
    model_compiled_t cube, octahedron;
    mesh_t mesh;
    (void)state;
    model_cube(&mesh);
    model_compile(&cube, &mesh);
    model_octahedron(&mesh);
    model_compile(&octahedron, &mesh);
    const tuile_instance_t instances[3] = {placed(&cube.model, -3), placed(&octahedron.model, 0), placed(&cube.model, 3)};
    const tuile_light_t light = {{0, 0, -TUILE_ONE_Q14}, 255};
    tuile_scene_t scene = {
        .instances = instances, .instance_count = 3, .lights = &light, .light_count = 1, .camera = plain_camera(160, 64)};
    uint32_t *ids = draw_ids(&scene, 160, 64);

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
        uint16_t *picture = (uint16_t *)(void *)draw(&scene, &config, 1 << 16, NULL);
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
    const tuile_instance_t same[3] = {placed(&a.model, -3), placed(&a.model, 3), placed(&a.model, 100)};
    tuile_scene_t scene = {
        .instances = same, .instance_count = 3, .lights = &light, .light_count = 1, .camera = plain_camera(160, 64)};
    uint16_t *picture = (uint16_t *)(void *)draw(&scene, &config, sizeof block, NULL);
    for (unsigned y = 0; y < 64; y++) { /* six units to the right, the same triangles */
        for (unsigned x = 0; x < 64; x++) {
            assert_int_equal(picture[y * 160 + x], picture[y * 160 + x + 96]);
        }
    }
    free(picture);
    const tuile_instance_t both[2] = {placed(&a.model, -3), placed(&b.model, 3)};
    scene.instances = both;
    scene.instance_count = 2;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_ERROR_ARGUMENT); /* 257 materials */
    model_free(&b);
    many_colours(&b, 56, 255);
    assert_int_equal(tuile_begin(renderer, &scene), TUILE_OK);
    assert_int_equal(tuile_end(renderer, NULL), TUILE_OK);

    /* However few ramps there is room for. */
    uint8_t *expected = draw(&scene, &config, 1 << 20, NULL);
    for (size_t size = least_bytes(&config); size < 60000; size += 5003) {
        uint8_t *other = draw(&scene, &config, size, NULL);
        assert_memory_equal(other, expected, picture_bytes(&config));
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
        uint16_t *flat = (uint16_t *)(void *)draw(&stage.view.scene, &config, 1 << 18, NULL);
        config.shade = TUILE_GOURAUD;
        uint16_t *gouraud = (uint16_t *)(void *)draw(&stage.view.scene, &config, 1 << 18, NULL);
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

/* ---- closed surfaces ---------------------------------------------------------------------------------------- */

/* Background that cannot be reached from the border of the picture through background. */
static unsigned enclosed_background(const uint32_t *ids, unsigned width, unsigned height) {
    uint8_t *reached = calloc(width, height);
    uint32_t *stack = malloc(sizeof *stack * (4u * width * height + 4u * (width + height)));
    size_t depth = 0;
    unsigned enclosed = 0;
    assert_non_null(reached);
    assert_non_null(stack);
    for (unsigned p = 0; p < width * height; p++) {
        const unsigned x = p % width, y = p / width;
        if (x == 0 || y == 0 || x == width - 1 || y == height - 1) { stack[depth++] = p; }
    }
    while (depth > 0) {
        const uint32_t p = stack[--depth];
        if (reached[p] || ids[p] != 0) { continue; }
        reached[p] = 1;
        if (p % width > 0) { stack[depth++] = p - 1; }
        if (p % width < width - 1) { stack[depth++] = p + 1; }
        if (p / width > 0) { stack[depth++] = p - width; }
        if (p / width < height - 1) { stack[depth++] = p + width; }
    }
    for (unsigned p = 0; p < width * height; p++) {
        enclosed += ids[p] == 0 && !reached[p];
    }
    free(reached);
    free(stack);
    return enclosed;
}

/* Seen from outside and uncut, a closed surface shows a front wherever it shows anything. */
static void check_fronts_cover_all(stage_t *stage, unsigned frame) {
    uint32_t *fronts = draw_ids(&stage->view.scene, 120, 160);
    stage->view.instance.two_sided = true;
    uint32_t *both = draw_ids(&stage->view.scene, 120, 160);
    stage->view.instance.two_sided = false;
    unsigned covered = 0;
    for (unsigned p = 0; p < 120 * 160; p++) {
        if ((fronts[p] != 0) != (both[p] != 0)) { fail_msg("frame %u: a hole at %u,%u", frame, p % 120, p / 120); }
        covered += fronts[p] != 0;
    }
    assert_true(covered > 1000);
    free(fronts);
    free(both);
}

static void closed_surfaces_have_no_holes_in_any_frame_of_a_spin(void **state) {
    (void)state;
    for (unsigned k = 0; k < 5; k++) {
        stage_t stage;
        mesh_t mesh;
        if (k == 0) { model_torus(&mesh, 40, 17, true); }
        if (k == 1) { model_torus(&mesh, 100, 29, true); }
        if (k == 2) { model_torus(&mesh, 24, 12, false); }
        if (k == 3) { model_sphere(&mesh, 9, 16); }
        if (k == 4) { model_sphere(&mesh, 60, 90); }
        stage_open(&stage, &mesh, 120, 160);
        const unsigned frames = CHECK_SANITIZED ? 6 : 36;
        for (unsigned frame = 0; frame < frames; frame++) {
            view_options_t options = VIEW_OPTIONS_DEFAULT;
            options.has_ortho = frame % 5 == 4;
            options.ortho = 3.1;
            options.up[0] = 0.3;
            options.has_spin = true;
            options.spin = 360.0 / frames + 1.0 / 7;
            stage_aim(&stage, &options, 120, 160);
            view_frame(&stage.view, frame);
            check_fronts_cover_all(&stage, frame);
            if (k >= 3) {
                uint32_t *ids = draw_ids(&stage.view.scene, 120, 160);
                assert_int_equal(enclosed_background(ids, 120, 160), 0);
                free(ids);
            }
        }
        stage_close(&stage);
    }
}

static void a_ball_cut_by_the_near_plane_has_no_holes(void **state) {
    const unsigned frames = CHECK_ROUNDS(64);
    stage_t stage;
    mesh_t mesh;
    unsigned cut = 0;
    (void)state;
    model_sphere(&mesh, 24, 40);
    stage_open(&stage, &mesh, 120, 160);
    stage.view.instance.two_sided = true;
    for (unsigned frame = 0; frame < frames; frame++) {
        view_options_t options = VIEW_OPTIONS_DEFAULT;
        const double away = 0.8 + 1.2 * (frame % 8) / 8;
        options.has_eye = options.has_at = options.has_near = true;
        options.eye[0] = away * cos(0.37 * frame);
        options.eye[1] = 0.2 * sin(0.9 * frame);
        options.eye[2] = away * sin(0.37 * frame);
        options.near = 0.35;
        options.has_fov = true;
        options.fov = 90;
        stage_aim(&stage, &options, 120, 160);
        stage.view.instance.two_sided = true;
        const tuile_config_t config = {.width = 120, .height = 160, .format = TUILE_FACE_IDS};
        tuile_stats_t stats;
        uint32_t *ids = (uint32_t *)(void *)draw(&stage.view.scene, &config, 1 << 20, &stats);
        cut += stats.faces_clipped > 0;
        assert_int_equal(enclosed_background(ids, 120, 160), 0);
        free(ids);
    }
    assert_true(cut > frames / 4);
    stage_close(&stage);
}

static void from_the_inside_of_a_closed_surface_no_background_is_seen(void **state) {
    (void)state;
    for (unsigned k = 0; k < 2; k++) {
        const unsigned frames = CHECK_ROUNDS(48);
        stage_t stage;
        mesh_t mesh;
        unsigned cut = 0;
        if (k == 0) { model_torus(&mesh, 60, 24, true); }
        if (k == 1) { model_sphere(&mesh, 24, 40); }
        stage_open(&stage, &mesh, 120, 160);
        for (unsigned frame = 0; frame < frames; frame++) {
            view_options_t options = VIEW_OPTIONS_DEFAULT;
            const double angle = 0.61 * frame;
            options.has_eye = options.has_at = options.has_near = options.has_fov = true;
            options.eye[0] = cos(0.13 * frame) * (k == 0 ? 1.0 : 0.9);
            options.eye[2] = sin(0.13 * frame) * (k == 0 ? 1.0 : 0.9);
            options.at[0] = options.eye[0] + cos(angle);
            options.at[1] = 0.5 * sin(1.7 * frame);
            options.at[2] = options.eye[2] + sin(angle);
            options.near = 0.005;
            options.fov = 110;
            stage_aim(&stage, &options, 120, 160);
            stage.view.instance.two_sided = true;
            const tuile_config_t config = {.width = 120, .height = 160, .format = TUILE_FACE_IDS};
            tuile_stats_t stats;
            uint32_t *ids = (uint32_t *)(void *)draw(&stage.view.scene, &config, 1 << 20, &stats);
            cut += stats.faces_clipped > 0;
            for (unsigned p = 0; p < 120 * 160; p++) {
                if (ids[p] == 0) { fail_msg("surface %u, frame %u: background at %u,%u", k, frame, p % 120, p / 120); }
            }
            free(ids);
        }
        assert_true(cut > 0);
        stage_close(&stage);
    }
}

/* ---- picking ------------------------------------------------------------------------------------------------ */

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
            uint32_t *ids = draw_ids(&stage.view.scene, 120, 160);
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
    const tuile_instance_t instances[3] = {placed(&cube.model, -3), placed(&octahedron.model, 0), placed(&cube.model, 3)};
    const tuile_scene_t scene = {.instances = instances, .instance_count = 3, .camera = plain_camera(160, 64)};
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

/* ---- over the wire ------------------------------------------------------------------------------------------ */

typedef struct board {
    sim_chip_t *chip;
    sim_bus_t bus;
    tuile_display_t display;
} board_t;

static void board_open(board_t *board, unsigned rotation) {
    sim_error_t error = {""};
    board->chip = sim_ili9341_create(&error);
    if (!board->chip) { fail_msg("%s", error.text); }
    sim_bus_open(&board->bus, NULL, board->chip);
    const tuile_display_config_t config = {.bus = &board->bus.bus, .panel = &tuile_ili9341, .rotation = (uint8_t)rotation};
    assert_int_equal(tuile_display_init(&board->display, &config), 0);
}

static void board_close(board_t *board) { board->chip->destroy(board->chip); }

/* 5 and 6 bits out of the 8 that a picture has. */
static unsigned to_565(const uint8_t rgb[3]) { return (unsigned)(rgb[0] >> 3) << 11 | (unsigned)(rgb[1] >> 2) << 5 | rgb[2] >> 3; }

static void the_panel_shows_the_picture_in_all_rotations(void **state) {
    static const uint16_t tiles[][2] = {{0, 16}, {33, 29}};
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_octahedron(&mesh); /* no symmetry hides a wrong turn: colours differ and the camera is aside */
    stage_open(&stage, &mesh, 240, 320);
    for (unsigned i = 0; i < 2; i++) {
        sim_picture_t glass[4] = {{0}};
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            board_t board;
            sim_picture_t seen = {0};
            tuile_stats_t stats;
            tuile_t *renderer;
            sim_error_t error = {""};
            board_open(&board, rotation);
            tuile_config_t config = {.width = board.display.width,
                                     .height = board.display.height,
                                     .tile_width = tiles[i][0],
                                     .tile_height = tiles[i][1]};
            assert_int_equal(config.width, rotation % 2 ? 320 : 240);
            assert_int_equal(config.height, rotation % 2 ? 240 : 320);
            stage_aim(&stage, NULL, config.width, config.height);
            uint8_t *expected = draw(&stage.view.scene, &config, 1 << 18, NULL);
            block_t block;
            block_open(&block, 1 << 18);
            assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), 0);
            memset(&board.bus.counts, 0, sizeof board.bus.counts);
            assert_int_equal(tuile_stream_frame(renderer, &stage.view.scene, &board.display, &stats), 0);
            assert_string_equal(board.chip->fault.text, "");
            assert_string_equal(board.bus.error.text, "");
            /* Column, row and write commands for each tile; the pixels. */
            assert_int_equal(board.bus.counts.command_bytes, (5 + 5 + 1) * stats.tiles);
            assert_int_equal(board.bus.counts.data_bytes, 153600);
            assert_int_equal(sim_bus_picture(&board.bus, rotation, &seen, &error), 0);
            assert_int_equal(seen.width, config.width);
            assert_int_equal(seen.height, config.height);
            unsigned colours = 0;
            for (size_t p = 0; p < (size_t)seen.width * seen.height; p++) {
                const unsigned wire = (unsigned)expected[2 * p] << 8 | expected[2 * p + 1];
                if (to_565(seen.rgb + 3 * p) != wire) {
                    fail_msg("rotation %u, pixel %zu: %04x, not %04x", rotation, p, to_565(seen.rgb + 3 * p), wire);
                }
                colours += p > 0 && memcmp(seen.rgb + 3 * p, seen.rgb + 3 * p - 3, 3) != 0;
            }
            assert_true(colours > 300);
            assert_int_equal(board.chip->glass(board.chip, &glass[rotation], &error), 0);
            assert_int_equal(glass[rotation].width, 240);
            assert_int_equal(glass[rotation].height, 320);
            sim_picture_free(&seen);
            free(expected);
            block_close(&block);
            board_close(&board);
        }
        for (unsigned rotation = 0; rotation < 2; rotation++) { /* a half turn */
            sim_picture_t turned;
            assert_int_equal(sim_picture_turn(&glass[rotation], 2, &turned, NULL), 0);
            assert_memory_equal(turned.rgb, glass[rotation + 2].rgb, 240 * 320 * 3);
            sim_picture_free(&turned);
        }
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            sim_picture_free(&glass[rotation]);
        }
    }
    stage_close(&stage);
}

static void a_renderer_that_does_not_fit_the_display_sends_nothing(void **state) {
    static const struct {
        tuile_config_t config;
        int expected;
    } cases[] = {
        {{.width = 240, .height = 320, .tile_height = 4}, TUILE_OK},
        {{.width = 320, .height = 240, .tile_height = 4}, TUILE_ERROR_ARGUMENT},
        {{.width = 240, .height = 319, .tile_height = 4}, TUILE_ERROR_ARGUMENT},
        {{.width = 240, .height = 320, .tile_height = 4, .format = TUILE_RGB565_LE}, TUILE_ERROR_ARGUMENT},
        {{.width = 240, .height = 320, .tile_height = 4, .format = TUILE_FACE_IDS}, TUILE_ERROR_ARGUMENT},
    };
    static uint64_t block[4096];
    const tuile_scene_t scene = {.background = {255, 0, 0}};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        board_t board;
        tuile_t *renderer;
        tuile_stats_t stats;
        board_open(&board, 0);
        memset(&board.bus.counts, 0, sizeof board.bus.counts);
        assert_int_equal(tuile_init(&renderer, &cases[i].config, block, sizeof block, NULL), 0);
        assert_int_equal(tuile_stream_frame(renderer, &scene, &board.display, &stats), cases[i].expected);
        assert_int_equal(board.bus.counts.data_bytes, cases[i].expected ? 0 : 153600);
        if (cases[i].expected) { assert_int_equal(board.bus.counts.commands, 0); }
        assert_int_equal(stats.tiles, cases[i].expected ? 0 : 80);
        /* The renderer is free for another frame. */
        assert_int_equal(tuile_begin(renderer, &scene), TUILE_OK);
        board_close(&board);
    }
}

static void one_buffer_reaches_the_glass_whole(void **state) {
    static uint64_t block[4096];
    stage_t stage;
    (void)state;
    open_torus(&stage, 240, 320);
    sim_picture_t seen[2] = {{0}};
    for (unsigned buffers = 1; buffers <= 2; buffers++) {
        board_t board;
        tuile_t *renderer;
        tuile_config_t config = panel_config(&stage);
        config.tile_height = 8;
        config.buffers = (uint8_t)buffers;
        board_open(&board, 0);
        assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
        assert_int_equal(tuile_stream_frame(renderer, &stage.view.scene, &board.display, NULL), 0);
        assert_int_equal(sim_bus_picture(&board.bus, 0, &seen[buffers - 1], NULL), 0);
        board_close(&board);
    }
    assert_memory_equal(seen[0].rgb, seen[1].rgb, 240 * 320 * 3);
    sim_picture_free(&seen[0]);
    sim_picture_free(&seen[1]);
    stage_close(&stage);
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
        cmocka_unit_test(tiles_sought_backwards_or_at_random_give_the_same_picture),
        cmocka_unit_test(two_renderers_in_turns_draw_a_band_each),
        cmocka_unit_test(a_tile_on_the_wire_is_not_touched_while_the_next_is_drawn),
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
        cmocka_unit_test(closed_surfaces_have_no_holes_in_any_frame_of_a_spin),
        cmocka_unit_test(a_ball_cut_by_the_near_plane_has_no_holes),
        cmocka_unit_test(from_the_inside_of_a_closed_surface_no_background_is_seen),
        cmocka_unit_test(picking_agrees_with_the_picture_and_its_point_lies_on_the_face),
        cmocka_unit_test(picking_names_the_instance_and_refuses_what_is_outside),
        cmocka_unit_test(the_panel_shows_the_picture_in_all_rotations),
        cmocka_unit_test(a_renderer_that_does_not_fit_the_display_sends_nothing),
        cmocka_unit_test(one_buffer_reaches_the_glass_whole),
    };
    return cmocka_run_group_tests_name("frame", tests, NULL, NULL);
}
