/* The way of a picture over the wire to the glass of a panel, in four rotations. */
#include "support/board.h"
#include "support/check.h"
#include "support/frame.h"
#include "support/stage.h"

#include "../firmware/stream.h"

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
            board_open(&board, NULL);
            assert_int_equal(board_start(&board, (uint8_t)(rotation), TUILE_WIRE_RGB565), 0);
            tuile_config_t config = {.width = board.display.width,
                                     .height = board.display.height,
                                     .tile_width = tiles[i][0],
                                     .tile_height = tiles[i][1]};
            assert_int_equal(config.width, rotation % 2 ? 320 : 240);
            assert_int_equal(config.height, rotation % 2 ? 240 : 320);
            stage_aim(&stage, NULL, config.width, config.height);
            uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 18, NULL);
            block_t block;
            block_open(&block, 1 << 18);
            assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), 0);
            memset(&board.bus.counts, 0, sizeof board.bus.counts);
            assert_int_equal(tuile_stream_frame(renderer, &stage.view.scene, &board.display, &stats), 0);
            assert_string_equal(board.chip->fault.text, "");
            assert_string_equal(board.bus.error.text, "");
            /* Column, row and write commands for each tile, or for all that are as wide as the panel; and display on; the pixels.
             */
            const uint32_t windows = tiles[i][0] ? stats.tiles : 1;
            assert_int_equal(board.bus.counts.command_bytes, (5 + 5 + 1) * windows + 1);
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
        board_open(&board, NULL);
        assert_int_equal(board_start(&board, (uint8_t)(0), TUILE_WIRE_RGB565), 0);
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

/* With tiles of 30 rows a frame has 11, so that each frame's first tile goes where the last but one of the frame before was. */
static void frames_that_flow_into_one_another_reach_the_glass_whole(void **state) {
    static uint64_t block[16384];
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    sim_picture_t seen[2] = {{0}};
    for (unsigned flow = 0; flow < 2; flow++) {
        board_t board;
        tuile_t *renderer;
        tuile_config_t config = stage_panel_config(&stage);
        config.tile_height = 30;
        board_open(&board, NULL);
        assert_int_equal(board_start(&board, (uint8_t)(0), TUILE_WIRE_RGB565), 0);
        assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
        for (unsigned frame = 0; frame < 3; frame++) {
            assert_int_equal((flow ? tuile_stream_flow : tuile_stream_frame)(renderer, &stage.view.scene, &board.display, NULL), 0);
            if (frame) { assert_int_equal(board.bus.flying != 0, flow); }
        }
        assert_int_equal(tuile_stream_settle(&board.display), 0);
        assert_string_equal(board.bus.error.text, "");
        assert_int_equal(sim_bus_picture(&board.bus, 0, &seen[flow], NULL), 0);
        board_close(&board);
    }
    assert_memory_equal(seen[0].rgb, seen[1].rgb, 240 * 320 * 3);
    sim_picture_free(&seen[0]);
    sim_picture_free(&seen[1]);
    stage_close(&stage);
}

static void one_buffer_reaches_the_glass_whole(void **state) {
    static uint64_t block[4096];
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    sim_picture_t seen[2] = {{0}};
    for (unsigned buffers = 1; buffers <= 2; buffers++) {
        board_t board;
        tuile_t *renderer;
        tuile_config_t config = stage_panel_config(&stage);
        config.tile_height = 8;
        config.buffers = (uint8_t)buffers;
        board_open(&board, NULL);
        assert_int_equal(board_start(&board, (uint8_t)(0), TUILE_WIRE_RGB565), 0);
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
        cmocka_unit_test(the_panel_shows_the_picture_in_all_rotations),
        cmocka_unit_test(a_renderer_that_does_not_fit_the_display_sends_nothing),
        cmocka_unit_test(frames_that_flow_into_one_another_reach_the_glass_whole),
        cmocka_unit_test(one_buffer_reaches_the_glass_whole),
    };
    return cmocka_run_group_tests_name("panel_picture", tests, NULL, NULL);
}
