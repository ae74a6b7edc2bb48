/* The scenes that boards draw: the same by every method, at any window, in any order; and the player that shows them. */
#include "support/check.h"

#include "../firmware/player.h"
#include "../sim/target.h"
#include "support/built.h"
#include "support/folder.h"

#define BLOCK_BYTES (512u * 1024u)

static _Alignas(8) uint8_t block[BLOCK_BYTES];

static built_t build(const scene_script_t *script) {
    const mesh_options_t options = {.tree = (script->methods >> TUILE_TREE & 1u) != 0};
    const char *spider = getenv("SPIDER");
    const char *path = strcmp(script->model, "cube") == 0   ? "firmware/models/cube.obj"
                       : strcmp(script->model, "room") == 0 ? "tests/models/room.obj"
                                                            : spider;
    assert_non_null(path);
    return built_load(path, &options);
}

/* A display, and what it shows as rows of red, green, blue. */
typedef struct shown {
    target_t target;
    player_t player;
    player_config_t config;
    built_t model;
} shown_t;

static void open_panel(shown_t *s, const char *panel, unsigned rotation) {
    target_config_t config;
    sim_error_t error = {""};
    if (target_parse_panel(&config, panel, &error) != 0 ||
        target_open(&s->target, &config, (uint8_t)rotation, TUILE_WIRE_DEFAULT, &error) != 0) {
        fail_msg("%s", error.text);
    }
}

static void open_scene(shown_t *s, const char *name, uint8_t method) {
    const scene_script_t *script = scene_find(name);
    assert_non_null(script);
    s->model = build(script);
    s->config = (player_config_t){.model = s->model.bytes,
                                  .model_bytes = s->model.size,
                                  .display = &s->target.display,
                                  .block = block,
                                  .block_bytes = sizeof block,
                                  .method = method};
    assert_int_equal(player_open(&s->player, script, &s->config), 0);
}

static void close_all(shown_t *s) {
    target_close(&s->target);
    free(s->model.bytes);
}

static sim_picture_t picture_of(shown_t *s, uint32_t frame) {
    sim_picture_t picture = {0};
    sim_error_t error = {""};
    const int result = player_frame(&s->player, frame);
    if (result) { fail_msg("frame %u: %s %s", frame, tuile_stream_error_text(result), target_detail(&s->target)); }
    if (target_picture(&s->target, &picture, NULL, &error)) { fail_msg("%s", error.text); }
    return picture;
}

static size_t difference(const sim_picture_t *a, const sim_picture_t *b) {
    size_t count = 0;
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    for (size_t i = 0; i < (size_t)a->width * a->height; i++) {
        count += memcmp(a->rgb + 3 * i, b->rgb + 3 * i, 3) != 0;
    }
    return count;
}

static const char *const drawn[] = {"cube", "room", "spider"};

/* ---- scenes ----------------------------------------------------------------------------------------------------- */

static void names_find_their_scenes(void **state) {
    (void)state;
    assert_true(scene_count >= 4);
    for (unsigned i = 0; i < scene_count; i++) {
        assert_ptr_equal(scene_find(scenes[i]->name), scenes[i]);
    }
    assert_null(scene_find("cub"));
    assert_null(scene_find("cubes"));
    assert_null(scene_find(""));
}

static void every_method_draws_the_same_scene(void **state) {
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(drawn); i++) {
        const scene_script_t *script = scene_find(drawn[i]);
        sim_picture_t first[3];
        for (uint8_t method = 0; method <= TUILE_TREE; method++) {
            if (!(script->methods >> method & 1u)) { continue; }
            shown_t s = {0};
            open_panel(&s, "ili9341", 1);
            open_scene(&s, drawn[i], method);
            for (unsigned frame = 0; frame < 3; frame++) {
                sim_picture_t picture = picture_of(&s, 5 * frame);
                if (method == 0) {
                    first[frame] = picture;
                    continue;
                }
                const size_t count = difference(&picture, &first[frame]);
                /* The tree's cuts may tell ties of depth another way (DESIGN.md). */
                if (count > (method == TUILE_TREE ? 240u * 320u / 1000u : 0u)) {
                    fail_msg("%s, method %u, frame %u: %zu pixels differ", drawn[i], method, 5 * frame, count);
                }
                sim_picture_free(&picture);
            }
            close_all(&s);
        }
        for (unsigned frame = 0; frame < 3; frame++) {
            sim_picture_free(&first[frame]);
        }
    }
}

static void frames_differ_and_come_round(void **state) {
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(drawn); i++) {
        shown_t s = {0};
        open_panel(&s, "ili9341", 0);
        open_scene(&s, drawn[i], TUILE_ZBUFFER);
        sim_picture_t third = picture_of(&s, 3), fourth = picture_of(&s, 4);
        sim_picture_t later = picture_of(&s, 3u + 7u * s.player.stage.script->period);
        assert_true(difference(&third, &fourth) > 100);
        assert_int_equal(difference(&third, &later), 0);
        sim_picture_free(&third);
        sim_picture_free(&fourth);
        sim_picture_free(&later);
        close_all(&s);
    }
}

/* Turning models stay whole, and fill the window: their bounding sphere touches two of its sides. */
static void turning_models_fit_any_window(void **state) {
    static const uint16_t sizes[][2] = {{128, 64}, {64, 128}, {240, 320}, {84, 48}, {16, 16}, {1024, 1024}, {1024, 8}, {3, 500}};
    static const char *const turning[] = {"cube", "spider"};
    (void)state;
    for (unsigned k = 0; k < CHECK_COUNT(turning); k++) {
        const scene_script_t *script = scene_find(turning[k]);
        built_t model = build(script);
        for (unsigned i = 0; i < CHECK_COUNT(sizes); i++) {
            scene_stage_t stage;
            assert_int_equal(scene_open(&stage, script, model.bytes, model.size, sizes[i][0], sizes[i][1]), 0);
            for (uint32_t frame = 0; frame < script->period; frame += 3) {
                tuile_config_t config = {.width = sizes[i][0], .height = sizes[i][1], .tile_height = 8};
                tuile_stats_t stats;
                tuile_tile_t tile;
                tuile_t *renderer;
                int result;
                scene_configure(&stage, &config);
                assert_int_equal(scene_frame(&stage, frame), 0);
                assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
                assert_int_equal(tuile_begin(renderer, &stage.scene), 0);
                while ((result = tuile_next(renderer, &tile)) == 1) {}
                assert_int_equal(result, 0);
                assert_int_equal(tuile_end(renderer, &stats), 0);
                assert_int_equal(stats.faces_clipped, 0);
                if (sizes[i][0] >= 16 && sizes[i][1] >= 8) { assert_true(stats.faces_setup > 0); }
            }
        }
        free(model.bytes);
    }
}

static void damaged_models_are_refused(void **state) {
    const scene_script_t *script = scene_find("cube");
    built_t model = build(script);
    scene_stage_t stage;
    (void)state;
    model.bytes[model.size / 2] ^= 1;
    assert_int_equal(scene_open(&stage, script, model.bytes, model.size, 128, 64), TUILE_ERROR_MODEL);
    free(model.bytes);
}

/* ---- the player ------------------------------------------------------------------------------------------------- */

static void a_method_that_the_script_does_not_name_is_refused(void **state) {
    shown_t s = {0};
    (void)state;
    open_panel(&s, "ili9341", 0);
    open_scene(&s, "spider", TUILE_ZBUFFER);
    s.config.method = TUILE_TREE;
    assert_int_equal(player_open(&s.player, scene_find("spider"), &s.config), TUILE_ERROR_ARGUMENT);
    s.config.method = 255;
    assert_int_equal(player_open(&s.player, scene_find("spider"), &s.config), TUILE_ERROR_ARGUMENT);
    s.config.method = TUILE_TREE + 1;
    assert_int_equal(player_open(&s.player, scene_find("spider"), &s.config), TUILE_ERROR_ARGUMENT);
    close_all(&s);
}

/* A panel of pages takes tiles of whole pages, at either way it is held. */
static void tiles_suit_the_display(void **state) {
    static const char *const panels[] = {"ssd1306-128x64", "ssd0323", "ili9341"};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(panels); i++) {
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            shown_t s = {0}, narrow = {0};
            open_panel(&s, panels[i], rotation);
            open_panel(&narrow, panels[i], rotation);
            open_scene(&s, "cube", TUILE_ZBUFFER);
            const unsigned usual = tuile_config(s.player.renderer)->tile_height;
            open_scene(&narrow, "cube", TUILE_ZBUFFER); /* in the same block */
            narrow.config.block_bytes = 6000;
            const int result = player_open(&narrow.player, scene_find("cube"), &narrow.config);
            if (result == TUILE_ERROR_MEMORY) {
                narrow.config.block_bytes = narrow.player.wanted_bytes;
                assert_int_equal(player_open(&narrow.player, scene_find("cube"), &narrow.config), 0);
            } else {
                assert_int_equal(result, 0);
            }
            const tuile_config_t *config = tuile_config(narrow.player.renderer);
            assert_int_equal(config->tile_height % narrow.target.display.align_y, 0);
            assert_true(config->tile_height < usual);
            sim_picture_t narrow_picture = picture_of(&narrow, 5);
            assert_int_equal(player_open(&s.player, scene_find("cube"), &s.config), 0);
            sim_picture_t picture = picture_of(&s, 5);
            assert_int_equal(difference(&picture, &narrow_picture), 0);
            sim_picture_free(&picture);
            sim_picture_free(&narrow_picture);
            close_all(&s);
            close_all(&narrow);
        }
    }
}

/* However small the block: it is too small, or tiles begin where windows may. */
static void no_block_makes_tiles_that_the_display_refuses(void **state) {
    static const char *const panels[] = {"ssd1306-128x64", "ssd0323", "ssd1322"};
    unsigned small = 0, heights = 0;
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(panels); i++) {
        for (unsigned rotation = 0; rotation < 2; rotation++) {
            shown_t s = {0};
            open_panel(&s, panels[i], rotation);
            open_scene(&s, "cube", TUILE_ZBUFFER);
            for (size_t bytes = 1000; bytes < 9000; bytes += 100) {
                s.config.block_bytes = bytes;
                const int result = player_open(&s.player, scene_find("cube"), &s.config);
                if (result == TUILE_ERROR_MEMORY) {
                    assert_true(s.player.wanted_bytes > bytes);
                    small++;
                    continue;
                }
                assert_int_equal(result, 0);
                assert_int_equal(tuile_config(s.player.renderer)->tile_height % s.target.display.align_y, 0);
                assert_int_equal(player_frame(&s.player, 1), 0);
                heights |= 1u << ((unsigned)tuile_config(s.player.renderer)->tile_height / s.target.display.align_y % 32u);
            }
            close_all(&s);
        }
    }
    assert_true(small > 20);
    assert_true((heights & (heights - 1)) != 0); /* of more than one height */
}

/* A model is as large as its distance makes it. */
static void models_of_any_size_look_alike(void **state) {
    static const double factors[] = {1, 1.0 / 1048576, 1048576};
    sim_picture_t first = {0};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(factors); i++) {
        char text[1024], *at = text;
        shown_t s = {0};
        for (unsigned v = 0; v < 8; v++) {
            at += sprintf(at, "v %.12g %.12g %.12g\n", (v & 1 ? 3 : -1) * factors[i], (v & 2 ? 1 : -1) * factors[i],
                          (v & 4 ? 1 : -2) * factors[i]);
        }
        (void)sprintf(at, "f 5 6 8 7\nf 2 1 3 4\nf 6 2 4 8\nf 1 5 7 3\nf 7 8 4 3\nf 1 2 6 5\n");
        const mesh_options_t tree = {.tree = true};
        s.model = built_load(folder_put_text("box.obj", text), &tree);
        open_panel(&s, "ili9341", 0);
        s.config = (player_config_t){.model = s.model.bytes,
                                     .model_bytes = s.model.size,
                                     .display = &s.target.display,
                                     .block = block,
                                     .block_bytes = sizeof block};
        assert_int_equal(player_open(&s.player, scene_find("cube"), &s.config), 0);
        sim_picture_t picture = picture_of(&s, 3);
        if (i == 0) {
            first = picture;
        } else {
            assert_int_equal(difference(&picture, &first), 0);
            sim_picture_free(&picture);
        }
        close_all(&s);
    }
    sim_picture_free(&first);
}

/* What it wants, it draws with. */
static void too_little_memory_is_told_in_bytes(void **state) {
    shown_t s = {0};
    unsigned tries = 0;
    (void)state;
    open_panel(&s, "ssd0323", 0);
    open_scene(&s, "spider", TUILE_WARNOCK);
    s.config.tile_height = 8;
    s.config.block_bytes = 64;
    int result = TUILE_ERROR_MEMORY;
    for (; result == TUILE_ERROR_MEMORY && tries < 20; tries++) {
        result = player_open(&s.player, scene_find("spider"), &s.config);
        if (result == 0) { result = player_frame(&s.player, 2); }
        if (result == TUILE_ERROR_MEMORY) {
            assert_true(s.player.wanted_bytes > s.config.block_bytes);
            s.config.block_bytes = s.player.wanted_bytes;
        }
    }
    assert_int_equal(result, 0);
    assert_true(tries > 2); /* too little to lay it out, then too little for the faces of a tile */
    close_all(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_find_their_scenes),       cmocka_unit_test(every_method_draws_the_same_scene),
        cmocka_unit_test(frames_differ_and_come_round),  cmocka_unit_test(turning_models_fit_any_window),
        cmocka_unit_test(damaged_models_are_refused),    cmocka_unit_test(a_method_that_the_script_does_not_name_is_refused),
        cmocka_unit_test(tiles_suit_the_display),        cmocka_unit_test(no_block_makes_tiles_that_the_display_refuses),
        cmocka_unit_test(models_of_any_size_look_alike), cmocka_unit_test(too_little_memory_is_told_in_bytes),
    };
    return cmocka_run_group_tests_name("scenes", tests, folder_make, folder_remove);
}
