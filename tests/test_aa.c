/* Anti-aliasing: a pixel is the exact mean of its samples, which are those of a larger picture, in every method, tile and memory;
 * how near that comes to what a pixel really covers. */
#include "support/check.h"
#include "support/frame.h"
#include "support/models.h"
#include "support/stage.h"

/* ---- scenes: a torus, a staircase and a room from within, whose faces reach behind the eye and far out of the window
 * ------------- */

enum { TORUS, STAIRCASE, ROOM, SCENES };
static const char *const names[SCENES] = {"torus", "staircase", "room"};

static void scene_open(stage_t *stage, unsigned scene, uint16_t width, uint16_t height) {
    mesh_t mesh;
    const mesh_options_t with = {.tree = true};
    view_options_t options = VIEW_OPTIONS_DEFAULT;
    if (scene == TORUS) { model_torus(&mesh, 32, 14, false); }
    if (scene == STAIRCASE) { model_staircase(&mesh, 5); }
    if (scene == ROOM) {
        model_room(&mesh);
        options.has_eye = options.has_at = options.has_near = true;
        memcpy(options.eye, (const double[3]){0.3, 0.4, 3.5}, sizeof options.eye);
        memcpy(options.at, (const double[3]){-1, 0, 0}, sizeof options.at);
        options.fov = 100;
        options.near = 0.5;
    }
    memcpy(options.background, (const uint8_t[3]){0x18, 0x20, 0x30}, 3);
    model_compile_with(&stage->compiled, &mesh, &with);
    mesh_free(&mesh);
    stage_aim(stage, &options, width, height);
}

static tuile_config_t scene_config(const stage_t *stage, uint16_t width, uint16_t height) {
    const tuile_model_t *model = &stage->compiled.model;
    return (tuile_config_t){.width = width,
                            .height = height,
                            .cluster_vertices = model->cluster_vertices_max,
                            .corners = model->corners_max,
                            .tree_depth = model->tree_depth};
}

/* The same view on a window `times` as large. */
static tuile_scene_t scene_enlarged(const tuile_scene_t *scene, int32_t times) {
    tuile_scene_t larger = *scene;
    larger.camera.focal_x *= times;
    larger.camera.focal_y *= times;
    larger.camera.centre_x *= times;
    larger.camera.centre_y *= times;
    return larger;
}

/* ---- the samples are those of a larger picture ------------------------------------------------------------------------------- */

static const struct {
    uint8_t format;
    unsigned at[3], bits[3]; /* of red, green, blue in a pixel of frame.h */
} own_steps[] = {
    {TUILE_RGB565_LE, {11, 5, 0}, {5, 6, 5}},
    {TUILE_RGB565_BE, {11, 5, 0}, {5, 6, 5}}, /* once its bytes are swapped */
    {TUILE_RGB444, {8, 4, 0}, {4, 4, 4}},
    {TUILE_RGB332, {5, 2, 0}, {3, 3, 2}},
};

/* Components of a pixel, in steps. */
static void components(unsigned kind, const uint8_t *picture, size_t index, unsigned out[3]) {
    const uint8_t format = own_steps[kind].format;
    unsigned value = format == TUILE_RGB332 ? picture[index] : picture[2 * index] | (unsigned)picture[2 * index + 1] << 8;
    if (format == TUILE_RGB565_BE) { value = (value >> 8 | value << 8) & 0xffff; }
    for (unsigned i = 0; i < 3; i++) {
        out[i] = value >> own_steps[kind].at[i] & ((1u << own_steps[kind].bits[i]) - 1);
    }
}

/* small: width x height pixels, each the mean of along x along of large, rounded half up. */
static bool is_the_mean(unsigned kind, const uint8_t *small, const uint8_t *large, unsigned width, unsigned height,
                        unsigned along) {
    for (unsigned y = 0; y < height; y++) {
        for (unsigned x = 0; x < width; x++) {
            unsigned sum[3] = {0}, part[3], mean[3];
            for (unsigned i = 0; i < along * along; i++) {
                components(kind, large, (size_t)(y * along + i / along) * width * along + x * along + i % along, part);
                sum[0] += part[0], sum[1] += part[1], sum[2] += part[2];
            }
            components(kind, small, (size_t)y * width + x, mean);
            for (unsigned c = 0; c < 3; c++) {
                if (mean[c] != (2 * sum[c] + along * along) / (2 * along * along)) { return false; }
            }
        }
    }
    return true;
}

/* In all tiles, and in as little memory as will do, where faces are drawn as they come. */
static void compare_tiles(const tuile_scene_t *scene, const tuile_config_t *config, const uint8_t *expected, const char *name) {
    static const uint16_t tiles[][2] = {{0, 0}, {16, 8}, {14, 5}, {61, 1}};
    for (unsigned i = 0; i < CHECK_COUNT(tiles) + 2; i++) {
        tuile_config_t c = *config;
        size_t size = (size_t)1 << 20;
        if (i < CHECK_COUNT(tiles)) {
            c.tile_width = tiles[i][0];
            c.tile_height = tiles[i][1];
        } else if (c.method == TUILE_ZBUFFER) {
            c.tile_width = i == CHECK_COUNT(tiles) ? 0 : 20;
            c.tile_height = 3;
            size = frame_least_bytes(&c);
        } else {
            continue;
        }
        uint8_t *picture = frame_draw(scene, &c, size, NULL);
        if (memcmp(picture, expected, frame_bytes(&c)) != 0) {
            fail_msg("%s, method %u, format %u, aa %u, tiles %u: another picture", name, c.method, c.format, c.aa, i);
        }
        free(picture);
    }
}

static void a_pixel_is_the_mean_of_a_picture_that_many_times_as_large(void **state) {
    const uint16_t width = 61, height = 43;
    (void)state;
    for (unsigned run = 0; run < SCENES * 4; run++) {
        const unsigned s = run / 4, aa = 1 + run % 2, shade = run / 2 % 2, along = 1u << aa;
        stage_t stage;
        scene_open(&stage, s, width, height);
        const tuile_scene_t larger = scene_enlarged(&stage.view.scene, (int32_t)along);
        for (unsigned k = 0; k < CHECK_COUNT(own_steps) * (TUILE_TREE + 1); k++) {
            const unsigned kind = k / (TUILE_TREE + 1);
            tuile_config_t config = scene_config(&stage, width, height);
            config.shade = (uint8_t)shade;
            config.effects = k % 3 == 2 ? TUILE_SURFACES : 0;
            config.format = own_steps[kind].format;
            config.method = (uint8_t)(k % (TUILE_TREE + 1));
            tuile_config_t large = config;
            large.width = (uint16_t)(width * along);
            large.height = (uint16_t)(height * along);
            config.aa = (uint8_t)aa;
            uint8_t *picture = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
            uint8_t *samples = frame_draw(&larger, &large, (size_t)1 << 20, NULL);
            if (!is_the_mean(kind, picture, samples, width, height, along)) {
                fail_msg("%s, method %u, format %u, aa %u, shade %u", names[s], config.method, config.format, aa, shade);
            }
            if (shade == (k & 1)) { compare_tiles(&stage.view.scene, &config, picture, names[s]); }
            free(samples);
            free(picture);
        }
        stage_close(&stage);
    }
}

/* ---- windows as large as they may be ----------------------------------------------------------------------------------------- */

/* 1920 samples are drawn in four windows of 960, whose origins are moved by whole pixels. */
static void the_largest_window_of_samples_is_the_picture_of_its_quarters(void **state) {
    const uint16_t side = TUILE_SAMPLES_MAX / 4, half = TUILE_SAMPLES_MAX / 2;
    stage_t stage;
    (void)state;
    scene_open(&stage, TORUS, side, side);
    uint8_t *first = NULL, *samples = malloc((size_t)2 * TUILE_SAMPLES_MAX * TUILE_SAMPLES_MAX);
    assert_non_null(samples);
    for (unsigned quarter = 0; quarter < 4; quarter++) {
        const unsigned left = quarter % 2 * half, top = quarter / 2 * half;
        tuile_scene_t scene = scene_enlarged(&stage.view.scene, 4);
        scene.camera.centre_x -= (q16_16_t)(left * 65536);
        scene.camera.centre_y -= (q16_16_t)(top * 65536);
        tuile_config_t config = scene_config(&stage, half, half);
        config.format = TUILE_RGB565_LE;
        uint8_t *picture = frame_draw(&scene, &config, (size_t)1 << 20, NULL);
        for (unsigned y = 0; y < half; y++) {
            memcpy(samples + 2 * ((size_t)(top + y) * TUILE_SAMPLES_MAX + left), picture + (size_t)2 * y * half, (size_t)2 * half);
        }
        free(picture);
    }
    for (unsigned method = 0; method <= TUILE_TREE; method++) {
        tuile_config_t config = scene_config(&stage, side, side);
        config.format = TUILE_RGB565_LE;
        config.aa = TUILE_AA_4X4;
        config.method = (uint8_t)method;
        config.tile_height = 8;
        uint8_t *picture = frame_draw(&stage.view.scene, &config, (size_t)2 << 20, NULL);
        if (!first && !is_the_mean(0, picture, samples, side, side, 4)) { fail_msg("not the mean of the quarters"); }
        if (!first) {
            first = picture;
            continue;
        }
        if (memcmp(first, picture, frame_bytes(&config)) != 0) { fail_msg("method %u: another picture", method); }
        free(picture);
    }
    free(first);
    free(samples);
    stage_close(&stage);
}

/* A room from within: faces that are cut at the eye and where coordinates end, at 64 samples beside the window. */
static void methods_agree_on_the_largest_windows(void **state) {
    static const uint16_t windows[][3] = {
        {480, 480, TUILE_AA_4X4}, {960, 3, TUILE_AA_2X2}, {1, 480, TUILE_AA_4X4}, {479, 333, TUILE_AA_4X4}};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(windows); i++) {
        stage_t stage;
        scene_open(&stage, ROOM, windows[i][0], windows[i][1]);
        tuile_config_t config = scene_config(&stage, windows[i][0], windows[i][1]);
        config.aa = (uint8_t)windows[i][2];
        config.shade = TUILE_GOURAUD;
        uint8_t *expected = frame_draw(&stage.view.scene, &config, (size_t)2 << 20, NULL);
        for (unsigned method = 1; method < TUILE_TREE; method++) {
            config.method = (uint8_t)method;
            config.tile_width = 128;
            config.tile_height = 24;
            uint8_t *picture = frame_draw(&stage.view.scene, &config, (size_t)2 << 20, NULL);
            if (memcmp(expected, picture, frame_bytes(&config)) != 0) {
                fail_msg("window %u, method %u: another picture", i, method);
            }
            free(picture);
        }
        free(expected);
        stage_close(&stage);
    }
}

static void one_sample_more_than_the_largest_window_is_refused(void **state) {
    tuile_t *renderer;
    size_t wanted;
    (void)state;
    for (unsigned aa = 0; aa < 3; aa++) {
        const unsigned most = aa == 0 ? TUILE_WINDOW_MAX_PX : (unsigned)TUILE_SAMPLES_MAX >> aa;
        tuile_config_t config = {.width = (uint16_t)most, .height = (uint16_t)most, .tile_height = 1, .aa = (uint8_t)aa};
        assert_int_equal(tuile_init(&renderer, &config, NULL, 0, &wanted), TUILE_ERROR_MEMORY);
        config.width++;
        assert_int_equal(tuile_init(&renderer, &config, NULL, 0, &wanted), TUILE_ERROR_ARGUMENT);
        config.width--;
        config.height++;
        assert_int_equal(tuile_init(&renderer, &config, NULL, 0, &wanted), TUILE_ERROR_ARGUMENT);
    }
}

/* ---- quality ----------------------------------------------------------------------------------------------------------------- */

/* Against 16x16 samples a pixel, over those pixels whose 256 samples are not all alike: the mean of |error| as a part of full
 * scale. Grey, so that the format's own rounding (1 / 510) does not count. */
static double mean_error(unsigned scene, unsigned aa, bool contrast) {
    const uint16_t side = 64;
    stage_t stage;
    double error = 0;
    size_t edges = 0;
    scene_open(&stage, scene, side, side);
    tuile_scene_t seen = stage.view.scene;
    tuile_instance_t white = stage.view.instance;
    tuile_material_t materials[8];
    assert_in_range(stage.compiled.model.material_count, 1, 8);
    for (unsigned i = 0; i < 8; i++) {
        materials[i] = (tuile_material_t){.colour = {255, 255, 255}, .alpha = 255, .texture = TUILE_NO_TEXTURE};
    }
    if (contrast) { /* white on black, nothing between: silhouettes alone, each as bad as can be */
        white.materials = materials;
        seen.instances = &white;
        seen.ambient = 255;
        memset(seen.background, 0, sizeof seen.background);
    }
    const tuile_scene_t larger = scene_enlarged(&seen, 16);
    tuile_config_t config = scene_config(&stage, side, side), large = scene_config(&stage, 16 * side, 16 * side);
    config.format = large.format = TUILE_GREY8;
    config.aa = (uint8_t)aa;
    uint8_t *picture = frame_draw(&seen, &config, (size_t)1 << 20, NULL),
            *samples = frame_draw(&larger, &large, (size_t)1 << 20, NULL);
    for (unsigned i = 0; i < (unsigned)side * side; i++) {
        unsigned sum = 0, least = 255, most = 0;
        for (unsigned k = 0; k < 256; k++) {
            const unsigned sample = samples[((size_t)i / side * 16 + k / 16) * 16 * side + i % side * 16 + k % 16];
            sum += sample;
            least = sample < least ? sample : least;
            most = sample > most ? sample : most;
        }
        if (least == most) { continue; }
        edges++;
        error += picture[i] * 256 > sum ? picture[i] * 256 - sum : sum - picture[i] * 256;
    }
    free(picture);
    free(samples);
    stage_close(&stage);
    assert_true(edges > 100);
    return error / (256.0 * 255.0) / (double)edges;
}

static void the_mean_error_on_edges_is_below_2_hundredths_with_4x4_samples(void **state) {
    (void)state;
    for (unsigned s = 0; s < SCENES; s++) {
        double errors[2][3] = {{0}};
        for (unsigned i = 0; i < (s == ROOM ? 3 : 6); i++) { /* the room fills the window */
            errors[i / 3][i % 3] = mean_error(s, i % 3, i / 3);
        }
        print_message("%-10s none %.2f %%, 2x2 %.2f %%, 4x4 %.2f %%\n", names[s], 100 * errors[0][0], 100 * errors[0][1],
                      100 * errors[0][2]);
        if (s != ROOM) {
            print_message("%-10s none %.2f %%, 2x2 %.2f %%, 4x4 %.2f %%, white on black\n", "", 100 * errors[1][0],
                          100 * errors[1][1], 100 * errors[1][2]);
        }
        assert_true(errors[0][2] < 0.02 && errors[1][2] < 0.03);
        assert_true(errors[0][1] < 0.6 * errors[0][0] && errors[0][2] < 0.6 * errors[0][1]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pixel_is_the_mean_of_a_picture_that_many_times_as_large),
        cmocka_unit_test(the_largest_window_of_samples_is_the_picture_of_its_quarters),
        cmocka_unit_test(methods_agree_on_the_largest_windows),
        cmocka_unit_test(one_sample_more_than_the_largest_window_is_refused),
        cmocka_unit_test(the_mean_error_on_edges_is_below_2_hundredths_with_4x4_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
