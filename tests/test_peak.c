/* The sizes that the renderer tells: a block of the peak suffices for the frame again, one of the least for a beginning, and one of
 * what was wanted for the tile that failed. All methods, by one tile, strips and columns, with textures and without. */
#include "support/check.h"
#include "support/frame.h"
#include "support/models.h"

#include "../sim/view.h"

typedef struct peak_stage {
    model_compiled_t compiled;
    view_t view;
} peak_stage_t;

enum { WIDTH = 120, HEIGHT = 88, TEXTURE_PX = 8 };

/* Every material takes one texture of coloured texels, or a fifth of them is see-through. */
static void dress(mesh_t *mesh, bool translucent) {
    mesh->texcoords = calloc(mesh->corner_count, sizeof *mesh->texcoords);
    mesh->surfaces = calloc(mesh->material_count, sizeof *mesh->surfaces);
    mesh->textures = calloc(1, sizeof *mesh->textures);
    assert_true(mesh->texcoords && mesh->surfaces && mesh->textures);
    for (size_t c = 0; c < mesh->corner_count; c++) {
        for (unsigned k = 0; k < 2; k++) {
            mesh->texcoords[c][k] = 11 * mesh->positions[mesh->corners[c]][2 * k];
        }
    }
    for (size_t m = 0; m < mesh->material_count; m++) {
        mesh->surfaces[m] = (tuile_material_t){.alpha = translucent && m % 5 == 0 ? 128 : 255, .uv_bits = 4};
    }
    mesh_texture_t *texture = &mesh->textures[mesh->texture_count++];
    *texture = (mesh_texture_t){.width = TEXTURE_PX, .height = TEXTURE_PX, .format = TUILE_TEXEL_RGB565, .levels = 1};
    texture->size_bytes = 2 * TEXTURE_PX * TEXTURE_PX;
    texture->texels = malloc(texture->size_bytes);
    texture->name = strdup("texels");
    assert_true(texture->texels && texture->name);
    for (size_t i = 0; i < texture->size_bytes; i++) {
        texture->texels[i] = (uint8_t)(i * 2654435761u >> 13);
    }
}

static void torus(mesh_t *mesh) { model_torus(mesh, 32, 17, true); }
static void quads(mesh_t *mesh) { model_torus(mesh, 21, 12, false); }
static void stairs(mesh_t *mesh) { model_staircase(mesh, 7); }

/* Leaves of a fan that cut through one another, each in a colour of its own. */
static void crossing(mesh_t *mesh) {
    model_start(mesh);
    for (unsigned k = 0; k < 23; k++) {
        const double a = 0.27 * k, b = 0.11 * k - 1;
        const uint32_t corners[4] = {model_position(mesh, -1, b - a / 8, -1), model_position(mesh, 1, a / 8 - b, -1 + a / 3),
                                     model_position(mesh, 1, b + 0.3, 1), model_position(mesh, -1, -b, 1 - a / 4)};
        model_face(mesh, corners, 3, model_material(mesh, 10 * k, 255 - 10 * k, 90));
        model_face(mesh, (const uint32_t[3]){corners[0], corners[2], corners[3]}, 3, model_material(mesh, 10 * k, 90, 10 * k));
    }
}

typedef struct peak_model {
    const char *name;
    void (*make)(mesh_t *mesh);
    bool inside; /* the eye is, so that faces are clipped */
} peak_model_t;

static const peak_model_t models[] = {{"torus", torus, false},       {"quads", quads, false},
                                      {"cube", model_cube, false},   {"stairs", stairs, false},
                                      {"room", model_room, true},    {"torus from within", torus, true},
                                      {"crossing", crossing, false}, {"crossing from within", crossing, true}};

enum { PLAIN = 0, TEXTURED = 1, TRANSLUCENT = 2, COLOURED_LIGHT = 3, KINDS = 4 };

static void open_model(peak_stage_t *stage, const peak_model_t *model, unsigned kind) {
    const mesh_options_t with = {.tree = true};
    view_options_t options = VIEW_OPTIONS_DEFAULT;
    sim_error_t error = {""};
    mesh_t mesh;
    model->make(&mesh);
    if (kind != PLAIN) { dress(&mesh, kind == TRANSLUCENT); }
    model_compile_with(&stage->compiled, &mesh, &with);
    mesh_free(&mesh);
    if (model->inside) {
        options.has_eye = options.has_at = options.has_near = true;
        options.eye[0] = 0.31, options.eye[1] = 0.14, options.eye[2] = 0.9;
        options.at[0] = -1;
        options.fov = 100;
        options.near = 0.2;
    }
    assert_int_equal(view_make(&stage->view, &options, &stage->compiled.model, WIDTH, HEIGHT, 1, &error), 0);
    view_frame(&stage->view, 0);
    stage->view.instance.two_sided = model->make == crossing;
    if (kind == COLOURED_LIGHT) { stage->view.scene.ambient_colour[0] = 200; }
}

/* Every method, shading and way to cut the window, and what the material wants; `number` counts on through all of them. */
static bool config_of(unsigned number, const peak_stage_t *stage, unsigned kind, tuile_config_t *config, char what[80]) {
    static const uint16_t tiles[][2] = {{WIDTH, HEIGHT}, {WIDTH, 8}, {40, 22}, {24, HEIGHT}};
    static const char *const methods[] = {"z-buffer", "scan line", "Warnock", "painter", "tree"};
    const unsigned tile = number % 4, shade = number / 4 % 2, method = number / 8;
    if (method > TUILE_TREE) { return false; }
    *config = (tuile_config_t){.width = WIDTH,
                               .height = HEIGHT,
                               .tile_width = tiles[tile][0],
                               .tile_height = tiles[tile][1],
                               .method = (uint8_t)method,
                               .shade = (uint8_t)shade,
                               .effects = kind == PLAIN         ? 0
                                          : kind == TRANSLUCENT ? TUILE_LAYERS
                                                                : TUILE_SURFACES,
                               .cluster_vertices = stage->compiled.model.cluster_vertices_max,
                               .corners = stage->compiled.model.corners_max,
                               .tree_depth = stage->compiled.model.tree_depth};
    (void)snprintf(what, 80, "%s, %s, tiles %ux%u, kind %u", methods[method], shade ? "Gouraud" : "flat", tiles[tile][0],
                   tiles[tile][1], kind);
    return true;
}

/* The frame in a block of exactly so many bytes: the result of the last call, and what is wanted. */
static int attempt(const tuile_scene_t *scene, const tuile_config_t *config, size_t size_bytes, uint32_t from_tile,
                   uint8_t *picture, tuile_stats_t *stats, size_t *wanted) {
    block_t block;
    tuile_t *renderer;
    tuile_tile_t tile;
    block_open(&block, size_bytes);
    memset(stats, 0, sizeof *stats);
    *wanted = 0;
    int result = tuile_init(&renderer, config, block.bytes, size_bytes, wanted);
    if (result == TUILE_OK) {
        result = tuile_begin(renderer, scene);
        *wanted = result == TUILE_ERROR_MEMORY ? tuile_wanted(renderer) : 0;
    }
    if (result == TUILE_OK) {
        assert_int_equal(tuile_seek(renderer, from_tile), TUILE_OK);
        while ((result = tuile_next(renderer, &tile)) == 1) {
            frame_paste(picture, config, &tile);
        }
        *wanted = result == TUILE_ERROR_MEMORY ? tuile_wanted(renderer) : 0;
        assert_int_equal(tuile_end(renderer, stats), TUILE_OK);
    }
    block_close(&block);
    return result;
}

enum { PLENTY = 1 << 19 };

static unsigned wrong;

static void check_peak(const tuile_scene_t *scene, const tuile_config_t *config, size_t size_bytes, const uint8_t *expected,
                       const char *model, const char *what) {
    tuile_stats_t first, second;
    size_t wanted;
    uint8_t *picture = frame_blank(config);
    if (attempt(scene, config, size_bytes, 0, picture, &first, &wanted) == 0) {
        assert_in_range(first.peak_bytes, 1, size_bytes);
        const size_t again = first.peak_bytes > first.least_bytes ? first.peak_bytes : first.least_bytes;
        const int result = attempt(scene, config, again, 0, picture, &second, &wanted);
        if (result != 0 || second.passes > first.passes || memcmp(picture, expected, frame_bytes(config)) != 0) {
            print_message("%s, %s, %zu bytes: %s in the %u bytes of the peak (wanted %zu), %u passes for %u\n", model, what,
                          size_bytes, tuile_error_text(result), first.peak_bytes, wanted, second.passes, first.passes);
            wrong++;
        }
    }
    free(picture);
}

/* The block that was told to be too small by so much: it is not, with so many bytes, at the tile that failed. */
static void check_wanted(const tuile_scene_t *scene, const tuile_config_t *config, size_t size_bytes, const char *model,
                         const char *what) {
    tuile_stats_t first, second;
    size_t wanted, again;
    uint8_t *picture = frame_blank(config);
    if (attempt(scene, config, size_bytes, 0, picture, &first, &wanted) == TUILE_ERROR_MEMORY &&
        !(config->method == TUILE_PAINTER && strncmp(model, "crossing", 8) == 0)) { /* cuts cannot be foreseen */
        tuile_config_t one = *config;
        one.tile_first = (uint16_t)first.tiles;
        one.tile_step = 4096;
        const int result = attempt(scene, &one, wanted, first.tiles, picture, &second, &again);
        if (result != 0) {
            print_message("%s, %s, %zu bytes, tile %u: %s in the %zu bytes that were wanted: then %zu\n", model, what, size_bytes,
                          first.tiles, tuile_error_text(result), wanted, again);
            wrong++;
        }
    }
    free(picture);
}

typedef void check_fn(const tuile_scene_t *scene, const tuile_config_t *config, const uint8_t *expected, const char *model,
                      const char *what);

/* Where each case takes long a part of them, of each model others. */
enum { ALL = CHECK_SANITIZED ? 9 : 1, SOME = CHECK_SANITIZED ? 9 : 3 };

static void for_each(unsigned step, check_fn *check) {
    wrong = 0;
    for (unsigned m = 0; m < CHECK_COUNT(models); m++) {
        for (unsigned kind = 0; kind < KINDS; kind++) {
            peak_stage_t stage;
            tuile_config_t config;
            char what[80];
            open_model(&stage, &models[m], kind);
            for (unsigned number = (m + kind) % step; config_of(number, &stage, kind, &config, what); number += step) {
                uint8_t *expected = frame_draw(&stage.view.scene, &config, PLENTY, NULL);
                check(&stage.view.scene, &config, expected, models[m].name, what);
                free(expected);
            }
            model_free(&stage.compiled);
        }
    }
    assert_int_equal(wrong, 0);
}

static void peak_of_plenty(const tuile_scene_t *scene, const tuile_config_t *config, const uint8_t *expected, const char *model,
                           const char *what) {
    check_peak(scene, config, PLENTY, expected, model, what);
}

static void peak_of_little(const tuile_scene_t *scene, const tuile_config_t *config, const uint8_t *expected, const char *model,
                           const char *what) {
    const size_t least = frame_least_bytes(config);
    for (unsigned k = 0; k < 6; k += 2) {
        check_peak(scene, config, least + k * k * 1200u + k, expected, model, what);
    }
}

static void wanted_of_little(const tuile_scene_t *scene, const tuile_config_t *config, const uint8_t *expected, const char *model,
                             const char *what) {
    const size_t least = frame_least_bytes(config);
    (void)expected;
    for (unsigned k = 1; k < 6; k += 3) {
        check_wanted(scene, config, least + k * k * 500u + k, model, what);
    }
}

static void least_is_the_bound(const tuile_scene_t *scene, const tuile_config_t *config, const uint8_t *expected, const char *model,
                               const char *what) {
    const size_t least = frame_least_bytes(config);
    tuile_stats_t stats;
    size_t wanted;
    uint8_t *picture = frame_blank(config);
    int result = attempt(scene, config, least, 0, picture, &stats, &wanted);
    /* The z-buffer draws any scene. */
    if (result != 0 ? result != TUILE_ERROR_MEMORY || config->method == TUILE_ZBUFFER
                    : memcmp(picture, expected, frame_bytes(config)) != 0) {
        print_message("%s, %s: %s in the least block\n", model, what, tuile_error_text(result));
        wrong++;
    }
    result = attempt(scene, config, least - 1, 0, picture, &stats, &wanted);
    assert_int_equal(result, TUILE_ERROR_MEMORY);
    assert_int_equal(wanted, least);
    free(picture);
}

static void a_block_of_the_peak_was_too_small_where_the_window_is_one_tile_with_textures(void **state) {
    (void)state;
    for_each(SOME, peak_of_plenty);
}

static void a_block_of_the_peak_gives_the_same_passes_when_there_are_several(void **state) {
    (void)state;
    for_each(ALL, peak_of_little);
}

static void a_block_of_what_was_wanted_was_too_small_with_textures(void **state) {
    (void)state;
    for_each(ALL, wanted_of_little);
}

static void a_block_of_the_least_begins_and_one_byte_less_does_not(void **state) {
    (void)state;
    for_each(SOME, least_is_the_bound);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_block_of_the_peak_was_too_small_where_the_window_is_one_tile_with_textures),
        cmocka_unit_test(a_block_of_the_peak_gives_the_same_passes_when_there_are_several),
        cmocka_unit_test(a_block_of_what_was_wanted_was_too_small_with_textures),
        cmocka_unit_test(a_block_of_the_least_begins_and_one_byte_less_does_not),
    };
    return cmocka_run_group_tests_name("peak", tests, NULL, NULL);
}
