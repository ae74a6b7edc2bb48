/* The display tree in any block of memory, by tiles of any shape, out of turn and in bands: one picture, or an error and a size. */
#include "support/check.h"
#include "support/frame.h"
#include "support/solids.h"

static void torus(mesh_t *mesh) { model_torus(mesh, 32, 16, true); }
static void staircase(mesh_t *mesh) { model_staircase(mesh, 6); }

/* A model among others: two of one, far enough apart, and the room of polygons round them all. */
static void open_two(solids_t *solids, solid_model_t *model, void (*make)(mesh_t *mesh), double size) {
    mesh_t mesh;
    make(&mesh);
    solid_model_open(model, &mesh, false);
    solids_start(solids, 96, 64);
    (void)solids_add(solids, model);
    tuile_instance_t *second = solids_add(solids, model);
    solids_place(second, 1.7 * size, 0.3 * size, -2.6 * size);
    random_source_t random = random_seed(5);
    solids_turn(second, &random, true);
    second->two_sided = true;
    solids_look(solids, (const double[3]){0.4 * size, 1.1 * size, 2.2 * size}, (const double[3]){0.3 * size, 0, 0});
    solids->scene.camera.near = (q16_16_t)(32768 * size);
}

/* Draws until the end or an error; gives that. */
static int draw(const tuile_scene_t *scene, const tuile_config_t *config, size_t size_bytes, uint8_t *picture, size_t *wanted,
                tuile_stats_t *stats) {
    block_t block;
    tuile_t *renderer;
    tuile_tile_t tile;
    block_open(&block, size_bytes);
    assert_int_equal(tuile_init(&renderer, config, block.bytes, size_bytes, NULL), TUILE_OK);
    int result = tuile_begin(renderer, scene);
    if (result == TUILE_OK) {
        while ((result = tuile_next(renderer, &tile)) == 1) {
            frame_paste(picture, config, &tile);
        }
        assert_int_equal(tuile_end(renderer, stats), TUILE_OK);
    }
    if (result == TUILE_ERROR_MEMORY) {
        *wanted = tuile_wanted(renderer);
        assert_true(*wanted > size_bytes);
    }
    block_close(&block);
    return result;
}

static const uint16_t tiles[][2] = {{96, 4}, {96, 64}, {16, 16}, {7, 5}, {1, 64}};

static void any_memory_and_any_tiles_give_one_picture(void **state) {
    static void (*const make[])(mesh_t *) = {torus, staircase};
    unsigned in_passes = 0;
    (void)state;
    for (unsigned m = 0; m < CHECK_COUNT(make); m++) {
        solids_t solids;
        solid_model_t model;
        open_two(&solids, &model, make[m], m == 0 ? 1.2 : 6);
        for (unsigned kind = 0; kind < 3; kind++) {
            tuile_config_t config = solids_config(&solids, TUILE_TREE);
            config.shade = kind == 1;
            config.format = kind == 2 ? TUILE_FACE_IDS : TUILE_RGB565_BE;
            tuile_stats_t most;
            uint8_t *expected = frame_draw(&solids.scene, &config, 1 << 20, &most);
            assert_int_equal(most.passes, 1);
            assert_int_equal(most.instances_sorted, 0);
            for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
                config.tile_width = tiles[i][0];
                config.tile_height = tiles[i][1];
                const size_t least = frame_least_bytes(&config);
                unsigned narrow = 0, last_passes = 0;
                for (unsigned k = 0; k < (CHECK_SANITIZED ? 6 : 24); k++) {
                    tuile_stats_t stats;
                    const size_t size_bytes = least + (CHECK_SANITIZED ? 16 * k : k) * k * 160 + k % 3;
                    uint8_t *picture = frame_draw(&solids.scene, &config, size_bytes, &stats);
                    if (memcmp(picture, expected, frame_bytes(&config)) != 0) {
                        fail_msg("model %u, kind %u, tiles %ux%u, %zu bytes: another picture", m, kind, tiles[i][0], tiles[i][1],
                                 size_bytes);
                    }
                    assert_true(stats.nodes > 0);
                    if (k == 0) { narrow = stats.tiles_narrow; }
                    in_passes += stats.passes > 1 && stats.tiles_narrow == 0;
                    last_passes = stats.passes;
                    free(picture);
                }
                assert_true(narrow > 0); /* the least block draws tile by tile, */
                assert_int_equal(last_passes, 1);
            }
            free(expected);
        }
        solid_model_close(&model);
    }
    assert_true(in_passes > 0); /* between the two there are bands of tiles */
}

/* 1024 bytes and no depth: what the header tells of the z-buffer, less 2 bytes a pixel, more 4 bytes a level, 8 for the order of
 * up to four instances and 8 for a ramp's tag. */
static void the_least_block_is_told_and_needs_no_depth(void **state) {
    static const uint16_t depths[] = {1, 2, 3, 17, 64, 300};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(depths); i++) {
        for (unsigned format = 0; format < 2; format++) {
            tuile_config_t config = {.width = 96, .height = 64, .tile_width = 32, .tile_height = 16, .cluster_vertices = 40};
            config.format = format ? TUILE_FACE_IDS : TUILE_RGB565_LE;
            config.corners = 10;
            config.tree_depth = depths[i];
            config.method = TUILE_ZBUFFER;
            const size_t by_depth = frame_least_bytes(&config);
            config.method = TUILE_TREE;
            assert_int_equal(frame_least_bytes(&config), by_depth - 2 * 32 * 16 + (4 * (size_t)depths[i] + 7) / 8 * 8 + 16);
            static uint64_t block[8192];
            tuile_t *renderer;
            const size_t least = frame_least_bytes(&config);
            assert_int_equal(tuile_init(&renderer, &config, block, least - 1, NULL), TUILE_ERROR_MEMORY);
            assert_int_equal(tuile_init(&renderer, &config, block, least, NULL), TUILE_OK);
        }
    }
}

static void tiles_out_of_turn_and_in_bands_give_one_picture(void **state) {
    solids_t solids;
    solid_model_t model;
    random_source_t random = random_seed(9);
    (void)state;
    open_two(&solids, &model, staircase, 6);
    for (unsigned k = 0; k < CHECK_ROUNDS(60); k++) {
        tuile_config_t config = solids_config(&solids, TUILE_TREE);
        config.format = k % 2 ? TUILE_FACE_IDS : TUILE_RGB565_BE;
        config.shade = k / 2 % 2;
        uint8_t *expected = frame_draw(&solids.scene, &config, 1 << 20, NULL), *picture = frame_blank(&config);
        config.tile_width = tiles[k % CHECK_COUNT(tiles)][0];
        config.tile_height = tiles[k % CHECK_COUNT(tiles)][1];
        const size_t size_bytes = frame_least_bytes(&config) + (size_t)random_between(&random, 0, 20000);
        block_t block;
        tuile_t *renderer;
        tuile_tile_t tile;
        block_open(&block, size_bytes);
        assert_int_equal(tuile_init(&renderer, &config, block.bytes, size_bytes, NULL), TUILE_OK);
        assert_int_equal(tuile_begin(renderer, &solids.scene), TUILE_OK);
        const uint32_t columns = (96u + config.tile_width - 1) / config.tile_width,
                       rows = (64u + config.tile_height - 1) / config.tile_height, count = columns * rows;
        uint32_t order[96 * 64];
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t at = (uint32_t)random_between(&random, 0, (int32_t)i);
            order[i] = order[at];
            order[at] = i;
        }
        for (uint32_t i = 0; i < count; i++) {
            assert_int_equal(tuile_seek(renderer, order[i]), TUILE_OK);
            assert_int_equal(tuile_next(renderer, &tile), 1);
            frame_paste(picture, &config, &tile);
        }
        assert_int_equal(tuile_end(renderer, NULL), TUILE_OK);
        assert_memory_equal(picture, expected, frame_bytes(&config));
        block_close(&block);
        /* Two renderers: one draws the rows above a line, the other those below; or each every other tile. */
        memset(picture, 0, frame_bytes(&config));
        for (unsigned half = 0; half < 2; half++) {
            tuile_config_t part = config;
            size_t wanted;
            if (k % 3) {
                part.row_first = half ? 30 : 0;
                part.row_end = half ? 64 : 30;
            } else {
                part.tile_first = (uint16_t)half;
                part.tile_step = 2;
            }
            assert_int_equal(draw(&solids.scene, &part, size_bytes, picture, &wanted, NULL), 0);
        }
        assert_memory_equal(picture, expected, frame_bytes(&config));
        free(picture);
        free(expected);
    }
    solid_model_close(&model);
}

/* The order of n instances takes n * n + 4 n + 2 bytes: with 60 of them more than the least block has. */
static void many_instances_in_a_small_block_tell_a_size_that_works(void **state) {
    enum { MANY = 60 };
    static tuile_instance_t instances[MANY];
    solids_t solids;
    solid_model_t model;
    mesh_t mesh;
    (void)state;
    model_cube(&mesh);
    solid_model_open(&model, &mesh, false);
    solids_start(&solids, 96, 64);
    tuile_instance_t *first = solids_add(&solids, &model);
    tuile_config_t config = solids_config(&solids, TUILE_TREE);
    config.tile_height = 4;
    for (unsigned i = 0; i < MANY; i++) {
        instances[i] = *first;
        solids_place(&instances[i], (double)(i % 10) * 3 - 13.5, (double)(i / 10) * 3 - 7.5, -20 - (double)(i * 7 % 10));
    }
    solids.scene.instances = instances;
    solids.scene.instance_count = MANY;
    uint8_t *expected = frame_draw(&solids.scene, &config, 1 << 20, NULL), *picture = frame_blank(&config);
    size_t wanted = 0, before = frame_least_bytes(&config);
    assert_int_equal(draw(&solids.scene, &config, before, picture, &wanted, NULL), TUILE_ERROR_MEMORY);
    while (draw(&solids.scene, &config, wanted, picture, &wanted, NULL) == TUILE_ERROR_MEMORY) { /* what it is wanted for */
        assert_true(wanted > before && wanted < before + MANY * MANY + 4 * MANY + 256);
        before = wanted;
    }
    assert_memory_equal(picture, expected, frame_bytes(&config));
    config.method = TUILE_ZBUFFER;
    uint8_t *by_depth = frame_draw(&solids.scene, &config, 1 << 20, NULL);
    assert_memory_equal(by_depth, expected, frame_bytes(&config)); /* cubes far apart: no two depths are near another */
    free(by_depth);
    free(picture);
    free(expected);
    solid_model_close(&model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_memory_and_any_tiles_give_one_picture),
        cmocka_unit_test(the_least_block_is_told_and_needs_no_depth),
        cmocka_unit_test(tiles_out_of_turn_and_in_bands_give_one_picture),
        cmocka_unit_test(many_instances_in_a_small_block_tell_a_size_that_works),
    };
    return cmocka_run_group_tests_name("tree_memory", tests, NULL, NULL);
}
