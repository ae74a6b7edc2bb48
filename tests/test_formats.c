/* Formats in whole pictures: the same through any tiles, memory and method; blocks that the macros size; dots that show shading. */
#include "support/board.h"
#include "support/check.h"
#include "support/frame.h"
#include "support/models.h"
#include "support/stage.h"

#include "../firmware/stream.h"

#define WIDTH 61u
#define HEIGHT 43u

/* Columns and rows that a tile's sides must be multiples of, unless it reaches the end of the window; 0 means 1. */
static const uint8_t units[TUILE_FORMAT_COUNT][2] = {
    [TUILE_RGB444] = {2, 0},
    [TUILE_GREY4] = {2, 0},
    [TUILE_MONO_PAGES] = {0, 8},
    [TUILE_MONO_ROWS] = {8, 0},
    [TUILE_MONO_PAGES_TURNED] = {8, 0},
    [TUILE_GREY4_TURNED] = {0, 2},
    [TUILE_RGB111] = {2, 0},
    [TUILE_XRGB1111] = {2, 0},
};

static bool fits(unsigned format, unsigned tile_width, unsigned tile_height) {
    const unsigned columns = units[format][0] ? units[format][0] : 1, rows = units[format][1] ? units[format][1] : 1;
    return (tile_width % columns == 0 || tile_width == WIDTH) && (tile_height % rows == 0 || tile_height == HEIGHT);
}

/* ---- nothing crawls ---- */

static void compare(const tuile_scene_t *scene, const tuile_config_t *config, size_t size_bytes, const uint8_t *expected) {
    uint8_t *picture = frame_draw(scene, config, size_bytes, NULL);
    if (memcmp(picture, expected, frame_bytes(config)) != 0) {
        fail_msg("format %u, dither %u, aa %u, method %u, tiles %ux%u, %zu bytes: another picture", config->format, config->dither,
                 config->aa, config->method, config->tile_width, config->tile_height, size_bytes);
    }
    free(picture);
}

/* Tiles that suit all formats, then tiles that do not suit some of those whose pixels share bytes. */
static void compare_all(const tuile_scene_t *scene, tuile_config_t config, const uint8_t *expected) {
    static const uint16_t tiles[][2] = {{0, 0}, {16, 8}, {24, 24}, {61, 16}, {14, 5}, {7, 43}, {8, 5}, {7, 6}};
    for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
        if (!fits(config.format, tiles[i][0], tiles[i][1])) { continue; }
        for (unsigned method = 0; method < TUILE_TREE; method++) {
            config.method = (uint8_t)method;
            config.tile_width = tiles[i][0];
            config.tile_height = tiles[i][1];
            compare(scene, &config, (size_t)1 << 20, expected);
        }
    }
    for (unsigned i = 1; i < 3; i++) { /* faces as they come; several passes */
        config.method = TUILE_ZBUFFER;
        config.tile_width = i == 1 ? 16 : 0;
        config.tile_height = 8;
        compare(scene, &config, frame_least_bytes(&config) + (i - 1) * 4000, expected);
    }
}

static void tiles_memory_and_method_do_not_move_the_matrix(void **state) {
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_torus(&mesh, 32, 14, false);
    stage_open(&stage, &mesh, WIDTH, HEIGHT);
    for (unsigned format = 0; format < TUILE_FORMAT_COUNT; format++) {
        for (unsigned i = 0; i < 6; i++) {
            tuile_config_t config = {
                .width = WIDTH, .height = HEIGHT, .format = (uint8_t)format, .dither = i % 2, .aa = (uint8_t)(i / 2)};
            if (format == TUILE_FACE_IDS && i > 0) { continue; }
            config.cluster_vertices = stage.compiled.model.cluster_vertices_max;
            config.shade = TUILE_GOURAUD;
            /* Colours that are kept whole are shaded pixel by pixel, others may be shaded by ramps. */
            uint8_t *expected = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
            compare_all(&stage.view.scene, config, expected);
            free(expected);
        }
    }
    stage_close(&stage);
}

static void the_tree_draws_every_format_as_the_z_buffer_does(void **state) {
    stage_t stage;
    mesh_t mesh;
    const mesh_options_t with = {.tree = true};
    (void)state;
    model_sphere(&mesh, 9, 16);
    model_compile_with(&stage.compiled, &mesh, &with);
    mesh_free(&mesh);
    stage_aim(&stage, NULL, WIDTH, HEIGHT);
    for (unsigned format = 0; format < TUILE_FORMAT_COUNT; format++) {
        tuile_config_t config = {.width = WIDTH, .height = HEIGHT, .format = (uint8_t)format};
        config.aa = format == TUILE_FACE_IDS ? TUILE_AA_NONE : TUILE_AA_2X2;
        config.tree_depth = stage.compiled.model.tree_depth;
        uint8_t *expected = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
        config.method = TUILE_TREE;
        if (format != TUILE_FACE_IDS) { compare(&stage.view.scene, &config, (size_t)1 << 20, expected); }
        free(expected);
    }
    stage_close(&stage);
}

static void tiles_that_would_share_bytes_are_refused(void **state) {
    static const struct {
        uint8_t format;
        uint16_t width, height;
        int result;
    } tiles[] = {
        {TUILE_RGB444, 15, 4, TUILE_ERROR_ARGUMENT},
        {TUILE_RGB444, 16, 3, TUILE_ERROR_MEMORY},
        {TUILE_RGB444, 61, 4, TUILE_ERROR_MEMORY},
        {TUILE_GREY4, 15, 4, TUILE_ERROR_ARGUMENT},
        {TUILE_GREY4, 61, 1, TUILE_ERROR_MEMORY},
        {TUILE_MONO_ROWS, 12, 4, TUILE_ERROR_ARGUMENT},
        {TUILE_MONO_ROWS, 16, 3, TUILE_ERROR_MEMORY},
        {TUILE_MONO_PAGES, 16, 12, TUILE_ERROR_ARGUMENT},
        {TUILE_MONO_PAGES, 15, 16, TUILE_ERROR_MEMORY},
        {TUILE_MONO_PAGES, 15, 43, TUILE_ERROR_MEMORY},
        {TUILE_RGB666, 15, 3, TUILE_ERROR_MEMORY},
        {TUILE_RGB332, 15, 3, TUILE_ERROR_MEMORY},
        {TUILE_MONO_PAGES_TURNED, 12, 16, TUILE_ERROR_ARGUMENT},
        {TUILE_MONO_PAGES_TURNED, 16, 3, TUILE_ERROR_MEMORY},
        {TUILE_MONO_PAGES_TURNED, 61, 3, TUILE_ERROR_MEMORY},
        {TUILE_GREY4_TURNED, 16, 3, TUILE_ERROR_ARGUMENT},
        {TUILE_GREY4_TURNED, 15, 4, TUILE_ERROR_MEMORY},
        {TUILE_GREY4_TURNED, 15, 43, TUILE_ERROR_MEMORY},
        {TUILE_RGB111, 15, 4, TUILE_ERROR_ARGUMENT},
        {TUILE_RGB111, 16, 3, TUILE_ERROR_MEMORY},
        {TUILE_RGB111, 61, 3, TUILE_ERROR_MEMORY},
        {TUILE_XRGB1111, 15, 4, TUILE_ERROR_ARGUMENT},
        {TUILE_XRGB1111, 16, 3, TUILE_ERROR_MEMORY},
        {TUILE_XRGB1111, 61, 3, TUILE_ERROR_MEMORY},
        {TUILE_BGR888, 15, 3, TUILE_ERROR_MEMORY},
        {TUILE_XRGB8888, 15, 3, TUILE_ERROR_MEMORY},
    };
    tuile_t *renderer;
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
        const tuile_config_t config = {.width = WIDTH,
                                       .height = HEIGHT,
                                       .format = tiles[i].format,
                                       .tile_width = tiles[i].width,
                                       .tile_height = tiles[i].height};
        const int result = tuile_init(&renderer, &config, NULL, 0, NULL);
        if (result != tiles[i].result) { fail_msg("%u: %d", i, result); }
    }
}

/* Whatever the size of the block. */
static void the_default_height_suits_every_format(void **state) {
    static uint64_t block[10000];
    (void)state;
    for (unsigned format = 0; format < TUILE_FORMAT_COUNT; format++) {
        unsigned heights = 0, before = 0;
        for (size_t size_bytes = 0; size_bytes <= sizeof block; size_bytes += 400) {
            const tuile_config_t config = {.width = WIDTH, .height = HEIGHT, .format = (uint8_t)format, .cluster_vertices = 8};
            tuile_t *renderer;
            const int result = tuile_init(&renderer, &config, block, size_bytes, NULL);
            if (result == TUILE_ERROR_MEMORY) { continue; }
            assert_int_equal(result, 0);
            const unsigned height = tuile_config(renderer)->tile_height;
            assert_true(fits(format, WIDTH, height));
            heights += height != before;
            before = height;
        }
        assert_true(heights > 1);
    }
}

/* ---- formats that hold the same pixels ---- */

static void expect_same_picture(const tuile_scene_t *scene, tuile_config_t config, uint8_t format, uint8_t other) {
    config.format = format;
    uint8_t *picture = frame_draw(scene, &config, (size_t)1 << 20, NULL);
    config.format = other;
    uint8_t *same = frame_draw(scene, &config, (size_t)1 << 20, NULL);
    if (memcmp(picture, same, frame_bytes(&config)) != 0) { fail_msg("format %u is not %u", other, format); }
    free(picture);
    free(same);
}

static void turned_pictures_are_the_same_pixels(void **state) {
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_torus(&mesh, 32, 14, false);
    stage_open(&stage, &mesh, WIDTH, HEIGHT);
    for (unsigned i = 0; i < 6; i++) {
        const tuile_config_t config = {.width = WIDTH,
                                       .height = HEIGHT,
                                       .tile_width = 16,
                                       .tile_height = 8,
                                       .shade = TUILE_GOURAUD,
                                       .dither = i % 2,
                                       .aa = (uint8_t)(i / 2)};
        expect_same_picture(&stage.view.scene, config, TUILE_MONO_PAGES, TUILE_MONO_PAGES_TURNED);
        expect_same_picture(&stage.view.scene, config, TUILE_GREY4, TUILE_GREY4_TURNED);
        expect_same_picture(&stage.view.scene, config, TUILE_RGB111, TUILE_XRGB1111);
    }
    stage_close(&stage);
}

/* Without dithering and with one sample a pixel all formats whose colours are kept whole are roundings of the same samples. */
static void whole_colours_are_rounded_to_each_format(void **state) {
    stage_t stage;
    mesh_t mesh;
    tuile_config_t config = {.width = WIDTH, .height = HEIGHT, .shade = TUILE_GOURAUD};
    uint8_t *pictures[4];
    static const uint8_t formats[] = {TUILE_BGR888, TUILE_XRGB8888, TUILE_RGB666, TUILE_RGB111};
    (void)state;
    model_torus(&mesh, 32, 14, false);
    stage_open(&stage, &mesh, WIDTH, HEIGHT);
    for (unsigned i = 0; i < 4; i++) {
        config.format = formats[i];
        pictures[i] = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
    }
    unsigned seen[256] = {0}, different = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        const uint8_t *bgr = pictures[0] + 3 * i;
        assert_memory_equal(pictures[1] + 4 * i, bgr, 3);
        assert_int_equal(pictures[1][4 * i + 3], 0);
        for (unsigned c = 0; c < 3; c++) { /* red, green, blue */
            const unsigned value = bgr[2 - c];
            assert_int_equal(pictures[2][3 * i + c], (2 * value * 63 + 255) / 510 << 2);
            assert_int_equal(pictures[3][i] >> (2 - c) & 1, value >= 128);
            different += seen[value]++ == 0;
        }
    }
    assert_true(different > 50);
    for (unsigned i = 0; i < 4; i++) {
        free(pictures[i]);
    }
    stage_close(&stage);
}

/* ---- memory ---- */

/* A constant expression. */
_Static_assert(TUILE_BLOCK_BYTES(64u, 128u, 8u, TUILE_MONO_PAGES, 1u, 64u, 0, TUILE_AA_NONE, true) < 9000u,
               "dots in a small block");

static void the_macro_is_the_least_block_of_every_configuration(void **state) {
    static const uint16_t tiles[][2] = {{120, 8}, {16, 16}, {32, 24}, {120, 90}};
    unsigned compared = 0;
    (void)state;
    for (unsigned i = 0; i < TUILE_FORMAT_COUNT * 2 * 3 * 4 * 2 * CHECK_COUNT(tiles); i++) {
        unsigned rest = i;
        tuile_config_t config = {.width = 120, .height = 90, .cluster_vertices = 40};
        config.format = (uint8_t)(rest % TUILE_FORMAT_COUNT), rest /= TUILE_FORMAT_COUNT;
        config.dither = rest % 2, rest /= 2;
        config.aa = (uint8_t)(rest % 3), rest /= 3;
        config.effects = (uint8_t)(rest % 4), rest /= 4;
        config.buffers = (uint8_t)(1 + rest % 2), rest /= 2;
        config.tile_width = tiles[rest][0];
        config.tile_height = tiles[rest][1];
        if (config.format == TUILE_FACE_IDS && (config.dither || config.aa || config.effects)) { continue; }
        assert_int_equal(frame_least_bytes(&config),
                         TUILE_BLOCK_BYTES((size_t)90, (size_t)config.tile_width, (size_t)config.tile_height, config.format,
                                           (size_t)config.buffers, (size_t)40, config.effects, config.aa, config.dither));
        compared++;
    }
    assert_int_equal(compared, (15 * 24 + 1) * 2 * CHECK_COUNT(tiles));
}

/* What the macro adds up, once by hand: 64 columns of 16 rows in 2x2 samples of RGB444, dithered: 4096 samples of 4 bytes, a number
 * and a depth of 2 bytes each, two tiles of 1536 bytes. */
static void the_macro_counts_the_samples(void **state) {
    const size_t small =
        TUILE_BLOCK_BYTES((size_t)64, (size_t)64, (size_t)16, TUILE_RGB444, (size_t)2, (size_t)64, 0, TUILE_AA_2X2, true);
    const size_t none = TUILE_LEAST_BYTES((size_t)64, (size_t)64, (size_t)16, TUILE_RGB444, (size_t)2, (size_t)64);
    (void)state;
    assert_int_equal(none, TUILE_STATE_BYTES + 1024 * 2 + 2 * 1536 + 128 + 8 + 64 * 8 + TUILE_CLIP_BYTES);
    assert_int_equal(small - none, 4096 * (4 + 2 + 2) - 1024 * 2 + TUILE_SURFACE_BYTES(64));
}

/* ---- dots ---- */

/* Each pixel of a block turns white when it gets brighter, never back; so a block has at least as many dots as if all of it were as
 * dark as its darkest pixel, and at most as many as for its brightest: means within 1/128, and half a step of GREY8. */
static void dots_follow_the_luminance_of_a_sphere(void **state) {
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_sphere(&mesh, 18, 32);
    stage_open(&stage, &mesh, 128, 64);
    for (unsigned aa = 0; aa < 3; aa++) {
        tuile_config_t grey = {.width = 128, .height = 64, .format = TUILE_GREY8, .shade = TUILE_GOURAUD, .aa = (uint8_t)aa},
                       dots = grey;
        dots.format = aa == 1 ? TUILE_MONO_ROWS : TUILE_MONO_PAGES;
        uint8_t *shaded = frame_draw(&stage.view.scene, &grey, (size_t)1 << 20, NULL),
                *dotted = frame_draw(&stage.view.scene, &dots, (size_t)1 << 20, NULL);
        unsigned darkest = 64, brightest = 0;
        for (unsigned block = 0; block < 128 / 8 * 64 / 8; block++) {
            unsigned count = 0, least = 255, most = 0;
            for (unsigned i = 0; i < 64; i++) {
                const size_t at = (size_t)(block / 16 * 8 + i / 8) * 128 + block % 16 * 8 + i % 8;
                count += dotted[at];
                least = shaded[at] < least ? shaded[at] : least;
                most = shaded[at] > most ? shaded[at] : most;
            }
            assert_true(count / 64.0 >= (least - 0.5) / 255 - 1.0 / 128);
            assert_true(count / 64.0 <= (most + 0.5) / 255 + 1.0 / 128);
            darkest = count < darkest ? count : darkest;
            brightest = count > brightest ? count : brightest;
        }
        assert_true(brightest - darkest > 24); /* of 64 */
        free(shaded);
        free(dotted);
    }
    stage_close(&stage);
}

static void a_white_or_black_window_has_no_dots_of_the_other_kind(void **state) {
    tuile_scene_t scene = {.camera = stage_plain_camera(WIDTH, HEIGHT)};
    (void)state;
    static const uint8_t formats[] = {TUILE_MONO_PAGES, TUILE_MONO_ROWS, TUILE_MONO_PAGES_TURNED};
    for (unsigned i = 0; i < 9; i++) {
        const tuile_config_t config = {.width = WIDTH, .height = HEIGHT, .format = formats[i % 3], .aa = (uint8_t)(i / 3)};
        for (unsigned white = 0; white < 2; white++) {
            memset(scene.background, white ? 255 : 0, 3);
            uint8_t *picture = frame_draw(&scene, &config, (size_t)1 << 20, NULL);
            for (unsigned k = 0; k < WIDTH * HEIGHT; k++) {
                assert_int_equal(picture[k], white);
            }
            free(picture);
        }
    }
}

/* ---- the panel's own formats ---- */

static void the_panel_takes_both_of_its_formats(void **state) {
    static uint64_t block[8192];
    static const uint8_t formats[] = {TUILE_RGB565_BE, TUILE_RGB666};
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_torus(&mesh, 32, 14, false);
    stage_open(&stage, &mesh, 240, 320);
    for (unsigned i = 0; i < 4; i++) {
        board_t board;
        tuile_t *renderer;
        tuile_config_t config = stage_panel_config(&stage);
        sim_picture_t seen = {0};
        config.format = formats[i % 2];
        config.dither = config.format == TUILE_RGB666;
        board_open(&board, NULL);
        assert_int_equal(board_start(&board, 0, i / 2 == 0 ? TUILE_WIRE_RGB565 : TUILE_WIRE_RGB666), 0);
        assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
        const int result = tuile_stream_frame(renderer, &stage.view.scene, &board.display, NULL);
        assert_int_equal(result, i % 2 == i / 2 ? 0 : TUILE_ERROR_ARGUMENT);
        if (result == 0 && config.format == TUILE_RGB666) {
            uint8_t *picture = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
            assert_int_equal(sim_bus_picture(&board.bus, 0, &seen, NULL), 0);
            for (size_t k = 0; k < (size_t)240 * 320 * 3; k++) {
                assert_int_equal(seen.rgb[k], picture[k] | picture[k] >> 6); /* the panel repeats the upper bits below */
            }
            free(picture);
            sim_picture_free(&seen);
        }
        board_check_clean(&board);
        board_close(&board);
    }
    stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_memory_and_method_do_not_move_the_matrix),
        cmocka_unit_test(the_tree_draws_every_format_as_the_z_buffer_does),
        cmocka_unit_test(tiles_that_would_share_bytes_are_refused),
        cmocka_unit_test(the_default_height_suits_every_format),
        cmocka_unit_test(turned_pictures_are_the_same_pixels),
        cmocka_unit_test(whole_colours_are_rounded_to_each_format),
        cmocka_unit_test(the_macro_is_the_least_block_of_every_configuration),
        cmocka_unit_test(the_macro_counts_the_samples),
        cmocka_unit_test(dots_follow_the_luminance_of_a_sphere),
        cmocka_unit_test(a_white_or_black_window_has_no_dots_of_the_other_kind),
        cmocka_unit_test(the_panel_takes_both_of_its_formats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
