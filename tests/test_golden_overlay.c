/* The overlay in frames: called for each tile, over the faces and before samples become wire bytes, by every method, in any memory.
 */
#include "support/check.h"
#include "support/frame.h"
#include "support/golden.h"
#include "support/overlay.h"
#include "support/stage.h"

#include "../sim/font.h"
#include "../sim/wire.h"

#define WIDTH 120
#define HEIGHT 90
#define MISSING 2u /* of the text */

static uint8_t *font_bytes;
static tuile_font_t font;
static stage_t stage;

static int set_up(void **state) {
    size_t size;
    mesh_t mesh;
    view_options_t options = VIEW_OPTIONS_DEFAULT;
    const mesh_options_t with = {.tree = true};
    (void)state;
    assert_int_equal(font_load(NULL, &font_bytes, &size, NULL), 0);
    assert_int_equal(tuile_font_open(&font, font_bytes, size), 0);
    model_torus(&mesh, 24, 10, false);
    model_compile_with(&stage.compiled, &mesh, &with);
    mesh_free(&mesh);
    memcpy(options.background, (const uint8_t[3]){0x18, 0x20, 0x30}, 3);
    stage_aim(&stage, &options, WIDTH, HEIGHT);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    stage_close(&stage);
    free(font_bytes);
    return 0;
}

static void draw(const void *context, tuile_canvas_t *canvas) {
    const tuile_gauge_t gauge = {.x = 31,
                                 .y = 31,
                                 .radius = 28,
                                 .value = 637,
                                 .high = 1000,
                                 .decimals = 1,
                                 .face = TUILE_ARGB(144, 0, 0, 0),
                                 .track = TUILE_COLOUR(96, 104, 120),
                                 .fill = TUILE_COLOUR(240, 160, 40),
                                 .needle = TUILE_COLOUR(255, 255, 255),
                                 .font = &font};
    const tuile_text_style_t style = {TUILE_COLOUR(255, 240, 160), TUILE_ARGB(128, 0, 0, 0), TUILE_ALIGN_RIGHT, 1};
    (void)context;
    assert_int_equal(tuile_draw_gauge(canvas, &gauge), 0);
    tuile_text_styled(canvas, &font, WIDTH - 2, 2,
                      "37.5 fps\n20 \xc2\xb0"
                      "C\n\xe6\x97\xa5\xe6\x9c\xac",
                      &style);
    tuile_draw_rounded(canvas, 8, 74, 104, 12, 5, TUILE_ARGB(160, 32, 64, 128));
    tuile_text(canvas, &font, 14, 75,
               "Gr\xc3\xbc\xc3\x9f"
               "e, \xc3\x85ngstr\xc3\xb6m!",
               TUILE_COLOUR(255, 255, 255));
    tuile_draw_stroke(canvas, TUILE_PX(70), TUILE_PX(60), TUILE_PX(112), TUILE_PX(40), 24, TUILE_COLOUR(255, 64, 64));
}

static void callback(void *context, tuile_canvas_t *canvas) { draw(context, canvas); }

static tuile_config_t config_of(unsigned method, unsigned effects) {
    tuile_config_t config = stage_panel_config(&stage);
    config.width = WIDTH;
    config.height = HEIGHT;
    config.tree_depth = stage.compiled.model.tree_depth;
    config.corners = stage.compiled.model.corners_max;
    config.method = (uint8_t)method;
    config.effects = (uint8_t)effects;
    config.overlay = callback;
    return config;
}

/* The frame as it is without the overlay, which is then drawn over the whole picture. */
static void expect(const tuile_config_t *config, uint16_t *picture) {
    static window_t window;
    tuile_config_t without = *config;
    without.overlay = NULL;
    uint8_t *faces = frame_draw(&stage.view.scene, &without, (size_t)2 << 20, NULL);
    window_open(&window, WIDTH, HEIGHT);
    window.kind = config->format == TUILE_RGB565_BE ? PIXEL_RGB565_BE : PIXEL_RGB565_LE;
    for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
        window.samples[i] = faces[2 * i] | (uint32_t)faces[2 * i + 1] << 8;
    }
    window_draw(&window, WIDTH, HEIGHT, draw, NULL);
    assert_int_equal(window.glyphs_missing, MISSING);
    for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
        picture[i] = (uint16_t)window.samples[i];
    }
    free(faces);
}

static void check_frame(const tuile_config_t *config, size_t size_bytes, const void *expected) {
    tuile_stats_t stats;
    uint8_t *picture = frame_draw(&stage.view.scene, config, size_bytes, &stats);
    if (memcmp(picture, expected, frame_bytes(config)) != 0) {
        fail_msg("method %u, effects %u, tile %ux%u, %zu bytes: another picture", config->method, config->effects,
                 config->tile_width, config->tile_height, size_bytes);
    }
    assert_int_equal(stats.glyphs_missing, MISSING);
    free(picture);
}

static void every_method_has_it_over_its_faces(void **state) {
    static const uint16_t tiles[][2] = {{0, 0}, {32, 32}, {17, 5}, {WIDTH, HEIGHT}};
    static uint16_t expected[WIDTH * HEIGHT];
    (void)state;
    for (unsigned method = 0; method <= TUILE_TREE; method++) {
        for (unsigned k = 0; k < 2 * CHECK_COUNT(tiles); k++) {
            tuile_config_t config = config_of(method, k % 2);
            config.format = k % 3 ? TUILE_RGB565_BE : TUILE_RGB565_LE;
            config.tile_width = tiles[k / 2][0];
            config.tile_height = tiles[k / 2][1];
            expect(&config, expected);
            check_frame(&config, (size_t)1 << 20, expected);
        }
    }
}

static void frames_of_many_passes_have_it_once(void **state) {
    static uint16_t expected[WIDTH * HEIGHT];
    (void)state;
    for (unsigned k = 0; k < 24; k++) {
        tuile_config_t config = config_of(k % 2 ? TUILE_TREE : TUILE_ZBUFFER, k / 2 % 2);
        config.tile_height = 8;
        expect(&config, expected);
        check_frame(&config, frame_least_bytes(&config) + k * k * 64, expected);
    }
}

/* Formats that are resolved, with samples: the same in any tiles. */
static void resolved_formats_have_it_in_any_tiles(void **state) {
    (void)state;
    for (unsigned format = 0; format < TUILE_FORMAT_COUNT; format++) {
        for (unsigned aa = 0; aa <= TUILE_AA_4X4 && format != TUILE_FACE_IDS; aa++) {
            tuile_config_t config = config_of(TUILE_ZBUFFER, 0);
            config.format = (uint8_t)format;
            config.aa = (uint8_t)aa;
            config.dither = (format + aa) % 2;
            config.tile_height = 24;
            uint8_t *expected = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
            tuile_config_t without = config;
            without.overlay = NULL;
            uint8_t *faces = frame_draw(&stage.view.scene, &without, (size_t)1 << 20, NULL);
            assert_memory_not_equal(faces, expected, frame_bytes(&config));
            free(faces);
            config.tile_width = 40;
            config.tile_height = 16;
            config.method = TUILE_SCANLINE;
            check_frame(&config, (size_t)1 << 20, expected);
            free(expected);
        }
    }
}

static void face_ids_have_no_overlay(void **state) {
    static uint64_t block[8192];
    tuile_config_t config = config_of(TUILE_ZBUFFER, 0);
    tuile_t *renderer;
    (void)state;
    config.format = TUILE_FACE_IDS;
    config.tile_height = 2;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_ERROR_ARGUMENT);
    config.overlay = NULL;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
}

/* ---- pictures ---- */

static const struct {
    const char *name;
    uint8_t format, aa;
} pictures[] = {{"overlay-torus", TUILE_RGB565_BE, TUILE_AA_NONE}, {"overlay-torus-grey4-aa-2x2", TUILE_GREY4, TUILE_AA_2X2}};

static size_t draw_picture(unsigned i, uint8_t *bytes, sim_picture_t *seen) {
    static uint64_t block[1 << 15];
    tuile_config_t config = config_of(TUILE_ZBUFFER, 0);
    tuile_t *renderer;
    tuile_tile_t tile;
    size_t size = 0;
    int result;
    config.shade = TUILE_GOURAUD;
    config.format = pictures[i].format;
    config.aa = pictures[i].aa;
    config.tile_width = 32;
    config.tile_height = 16;
    assert_int_equal(sim_picture_create(seen, WIDTH, HEIGHT, NULL), 0);
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
    assert_int_equal(tuile_begin(renderer, &stage.view.scene), 0);
    while ((result = tuile_next(renderer, &tile)) == 1) {
        assert_int_equal(wire_paste(seen, config.format, &tile, NULL), 0);
        memcpy(bytes + size, tile.bytes, tile.size_bytes);
        size += tile.size_bytes;
    }
    assert_int_equal(result, 0);
    assert_int_equal(tuile_end(renderer, NULL), 0);
    return size;
}

static void a_dial_and_text_over_a_torus_look_as_they_did(void **state) {
    golden_t golden;
    (void)state;
    golden_open(&golden, "tests/golden/overlay.txt");
    for (unsigned i = 0; i < CHECK_COUNT(pictures); i++) {
        static uint8_t bytes[4 * WIDTH * HEIGHT];
        sim_picture_t seen = {0};
        const size_t size = draw_picture(i, bytes, &seen);
        golden_picture(&golden, pictures[i].name, bytes, size, &seen);
        sim_picture_free(&seen);
    }
    golden_close(&golden);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_has_it_over_its_faces),
        cmocka_unit_test(frames_of_many_passes_have_it_once),
        cmocka_unit_test(resolved_formats_have_it_in_any_tiles),
        cmocka_unit_test(face_ids_have_no_overlay),
        cmocka_unit_test(a_dial_and_text_over_a_torus_look_as_they_did),
    };
    return cmocka_run_group_tests_name("golden_overlay", tests, set_up, tear_down);
}
