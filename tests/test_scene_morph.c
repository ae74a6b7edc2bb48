/* Instances between two key frames: pictures against models that stand where the mixture should, numbers against exact ones. */
#include "support/check.h"

#include <math.h>

#include "../raster/geometry/morph.h"
#include "support/frame.h"
#include "support/morph.h"
#include "support/random.h"
#include "support/stage.h"

/* ---- numbers ---- */

static void positions_are_within_a_256th_of_a_step_and_between_their_ends(void **state) {
    static const int16_t ends[] = {INT16_MIN, INT16_MAX, 0, 1, -1, 1000};
    static const uint16_t parts[] = {0, 1, 16384, 32767, 32768};
    random_source_t random = random_seed(81);
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(400000); round++) {
        const bool extreme = round < 1000;
        const int16_t a = (int16_t)(extreme ? ends[random_between(&random, 0, 5)] : random_between(&random, INT16_MIN, INT16_MAX));
        const int16_t b = (int16_t)(extreme ? ends[random_between(&random, 0, 5)] : random_between(&random, INT16_MIN, INT16_MAX));
        const uint16_t m = (uint16_t)(extreme ? parts[random_between(&random, 0, 4)] : random_between(&random, 0, 32768));
        const int8_t f = (int8_t)(round % 3 ? 0 : random_between(&random, -128, 127));
        int16_t whole[3];
        int8_t fraction[3];
        const int16_t as[3] = {a, b, a}, bs[3] = {b, a, a};
        const int8_t fs[3] = {f, f, f};
        morph_positions(as, bs, fs, 1, m, whole, fraction);
        /* in 1/256 step, times 32768 */
        const int64_t exact = ((int64_t)a * 256 + f) * 32768 + ((int64_t)b - a) * 256 * m;
        const int64_t at = (int64_t)whole[0] * 256 + fraction[0];
        assert_true(at * 32768 <= exact && exact - at * 32768 < 32768);
        assert_true(at >= (a < b ? a : b) * 256 + f && at <= (a < b ? b : a) * 256 + f);
        assert_int_equal(whole[2] * 256 + fraction[2], a * 256 + f);
        if (m == TUILE_MORPH_ONE) { assert_int_equal(at, b * 256 + f); }
    }
}

static void random_normal(random_source_t *random, int8_t n[3]) {
    double v[3], length = 0;
    while (length < 0.1 || length > 1) {
        length = 0;
        for (int i = 0; i < 3; i++) {
            v[i] = random_real(random, -1, 1);
            length += v[i] * v[i];
        }
    }
    for (int i = 0; i < 3; i++) {
        n[i] = (int8_t)lround(127 * v[i] / sqrt(length));
    }
}

static void normals_have_the_direction_of_the_mixture_and_full_length(void **state) {
    random_source_t random = random_seed(82);
    double worst = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(200000); round++) {
        int8_t a[3], b[3], n[3];
        const uint16_t m = (uint16_t)random_between(&random, 1, 32767);
        double mix[3], squares = 0, length = 0, dot = 0;
        random_normal(&random, a);
        random_normal(&random, b);
        morph_normals(a, b, 1, m, n);
        for (int i = 0; i < 3; i++) {
            mix[i] = a[i] + (b[i] - a[i]) * (m / 32768.0);
            squares += mix[i] * mix[i];
            length += n[i] * n[i];
            dot += mix[i] * n[i];
        }
        if (squares < 32 * 32) { continue; } /* ends more than 150 degrees apart */
        worst = fmax(worst, acos(fmin(1, dot / sqrt(squares * length))));
        assert_true(sqrt(length) > 126 && sqrt(length) < 128.5);
    }
    print_message("morph_normals: %.3f degrees\n", worst * 57.29577951);
    assert_true(worst * 57.29577951 < 0.6);
}

static void normals_are_exact_at_the_ends_and_where_they_stay(void **state) {
    const int8_t a[6] = {127, 0, 0, 1, 2, 3}, b[6] = {0, 127, 0, 1, 2, 3}, back[3] = {-127, 0, 0};
    int8_t n[6];
    (void)state;
    morph_normals(a, b, 2, TUILE_MORPH_ONE, n);
    assert_memory_equal(n, b, 6);
    morph_normals(a, b, 2, 16384, n);
    assert_memory_equal(n, ((const int8_t[6]){90, 90, 0, 1, 2, 3}), 6); /* 127 / sqrt 2 = 89.8 */
    morph_normals(a, back, 1, 16384, n);
    assert_memory_equal(n, ((const int8_t[3]){0, 0, 0}), 3);
}

/* ---- pictures ---- */

/* Half as high, about the middle. */
static void squash(const tuile_model_t *model, const int16_t from[3], int16_t to[3]) {
    const int middle = (model->low[1] + model->high[1]) / 2;
    to[0] = from[0], to[2] = from[2];
    to[1] = (int16_t)(middle + (from[1] - middle) / 2);
}

static void tilt(const int8_t from[3], int8_t to[3]) {
    to[0] = from[2], to[1] = from[1], to[2] = (int8_t)(from[0] == -128 ? 127 : -from[0]);
}

/* To a place an even number of steps away, and half way there. */
static void shear(const tuile_model_t *model, const int16_t from[3], int16_t to[3]) {
    to[0] = from[0], to[2] = from[2];
    to[1] = (int16_t)(from[1] - 2 * ((from[1] - model->low[1]) / 4));
}
static void shear_half(const tuile_model_t *model, const int16_t from[3], int16_t to[3]) {
    to[0] = from[0], to[2] = from[2];
    to[1] = (int16_t)(from[1] - (from[1] - model->low[1]) / 4);
}

/* So near that faces are clipped by the near plane and the guard band. */
static void aim(stage_t *stage, unsigned camera) {
    view_options_t options = VIEW_OPTIONS_DEFAULT;
    if (camera == 1) {
        options.has_eye = options.has_near = true;
        options.eye[0] = 0.9, options.eye[1] = 0.55, options.eye[2] = 0.2;
        options.near = 0.05;
    }
    options.has_ortho = camera == 2;
    options.ortho = 2;
    stage_aim(stage, &options, 96, 80);
}

/* Model a at `morph` and model b look alike: by all methods, through tiles, in little memory, deferred and not. */
static void same_pictures(stage_t *stage, const model_compiled_t *a, uint16_t morph, const model_compiled_t *b) {
    for (unsigned k = 0; k < 3 * 4 * 2 * 2; k++) {
        tuile_config_t config = {.width = 96, .height = 80, .tile_width = 96, .tile_height = 16, .method = (uint8_t)(k / 3 % 4)};
        tuile_stats_t stats;
        config.shade = (uint8_t)(k / 12 % 2);
        config.effects = k / 24 ? TUILE_SURFACES : 0;
        config.cluster_vertices = a->model.cluster_vertices_max;
        config.corners = a->model.corners_max;
        aim(stage, k % 3);
        tuile_instance_t *instance = &stage->view.instance;
        instance->model = &b->model;
        instance->morph = 0;
        uint8_t *expected = frame_draw(&stage->view.scene, &config, 1 << 20, NULL);
        instance->model = &a->model;
        instance->morph = morph;
        uint8_t *picture = frame_draw(&stage->view.scene, &config, 1 << 20, &stats);
        if (memcmp(picture, expected, frame_bytes(&config)) != 0) { fail_msg("case %u: another picture", k); }
        assert_true(k % 3 != 1 || stats.faces_clipped > 0);
        free(picture);
        if (config.method == TUILE_ZBUFFER) {
            const size_t least = frame_least_bytes(&config) + TUILE_MORPH_BYTES(config.cluster_vertices, TUILE_MORPH_FACES);
            for (size_t extra = 0; extra < 40000; extra += 8001) {
                picture = frame_draw(&stage->view.scene, &config, least + extra, NULL);
                assert_memory_equal(picture, expected, frame_bytes(&config));
                free(picture);
            }
        }
        free(expected);
    }
}

static void open_torus(stage_t *stage, bool triangles) {
    mesh_t mesh;
    model_torus(&mesh, 24, 13, triangles);
    stage_open(stage, &mesh, 96, 80);
}

static void at_its_end_the_second_key_frame_is_seen(void **state) {
    (void)state;
    for (unsigned triangles = 0; triangles < 2; triangles++) {
        stage_t stage;
        model_compiled_t a, b;
        open_torus(&stage, triangles);
        morph_add(&a, &stage.compiled, squash, tilt);
        morph_apply(&b, &stage.compiled, squash, tilt);
        same_pictures(&stage, &a, TUILE_MORPH_ONE, &b);
        model_free(&a);
        model_free(&b);
        stage_close(&stage);
    }
}

static void half_way_the_model_half_way_is_seen(void **state) {
    stage_t stage;
    model_compiled_t a, b;
    (void)state;
    open_torus(&stage, true);
    morph_add(&a, &stage.compiled, shear, NULL);
    morph_apply(&b, &stage.compiled, shear_half, NULL);
    same_pictures(&stage, &a, TUILE_MORPH_ONE / 2, &b);
    model_free(&a);
    model_free(&b);
    stage_close(&stage);
}

static void without_morph_the_first_key_frame_is_seen_and_nothing_is_paid(void **state) {
    stage_t stage;
    model_compiled_t a, b;
    tuile_stats_t stats, plain;
    const tuile_config_t config = {.width = 96, .height = 80};
    (void)state;
    open_torus(&stage, true);
    morph_add(&a, &stage.compiled, squash, tilt);
    morph_add(&b, &stage.compiled, squash, tilt);
    stage.view.instance.model = &a.model;
    b.model.morph_positions = NULL;
    uint8_t *picture = frame_draw(&stage.view.scene, &config, 1 << 20, &stats);
    stage.view.instance.model = &b.model;
    uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, &plain);
    assert_memory_equal(picture, expected, frame_bytes(&config));
    assert_int_equal(stats.peak_bytes, plain.peak_bytes);
    free(picture);
    free(expected);
    model_free(&a);
    model_free(&b);
    stage_close(&stage);
}

/* The upper half of a square, four steps high, comes down by two. */
static void lower(const tuile_model_t *model, const int16_t from[3], int16_t to[3]) {
    to[0] = from[0], to[2] = from[2];
    to[1] = (int16_t)(from[1] == model->high[1] ? from[1] - 2 : from[1]);
}

/* A step is 16 pixels here. */
static void motion_is_as_smooth_as_pixels_are(void **state) {
    mesh_t mesh;
    model_compiled_t whole, a;
    const mesh_options_t coarse = {.step = 1};
    (void)state;
    model_start(&mesh);
    const uint32_t corners[4] = {model_position(&mesh, -2, -2, 0), model_position(&mesh, 2, -2, 0), model_position(&mesh, 2, 2, 0),
                                 model_position(&mesh, -2, 2, 0)};
    model_face(&mesh, corners, 4, model_material(&mesh, 200, 200, 200));
    model_compile_with(&whole, &mesh, &coarse);
    mesh_free(&mesh);
    morph_add(&a, &whole, lower, NULL);
    tuile_instance_t instance = stage_placed(&a.model, 0);
    const tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .camera = stage_plain_camera(80, 80)};
    for (unsigned m = 0; m <= TUILE_MORPH_ONE; m += 64) {
        instance.morph = (uint16_t)m;
        uint32_t *ids = frame_draw_ids(&scene, 80, 80);
        unsigned top = 0;
        while (ids[top * 80 + 40] == 0) {
            top++;
        }
        /* The edge is 8 to 40 pixels from the top, and covers the pixels whose centres are below it; it is snapped to 1/16, and
         * up to 1/16 too low. */
        const double edge = 8 + 32.0 * m / TUILE_MORPH_ONE;
        assert_in_range(top, (unsigned)ceil(edge - 0.04 - 0.5), (unsigned)ceil(edge + 0.1 - 0.5));
        free(ids);
    }
    model_free(&whole);
    model_free(&a);
}

static void too_little_memory_is_told_at_the_beginning(void **state) {
    stage_t stage;
    model_compiled_t a;
    block_t block;
    tuile_t *renderer;
    tuile_config_t config = {.width = 96, .height = 80, .tile_width = 96, .tile_height = 8};
    (void)state;
    open_torus(&stage, true);
    morph_add(&a, &stage.compiled, squash, tilt);
    stage.view.instance.model = &a.model;
    stage.view.instance.morph = 7;
    config.cluster_vertices = a.model.cluster_vertices_max;
    for (unsigned effects = 0; effects < 2; effects++) {
        config.effects = (uint8_t)effects;
        block_open(&block, frame_least_bytes(&config));
        assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), TUILE_OK);
        assert_int_equal(tuile_begin(renderer, &stage.view.scene), TUILE_ERROR_MEMORY);
        const size_t wanted = tuile_wanted(renderer);
        assert_true(wanted > block.size_bytes);
        assert_true(wanted <= block.size_bytes + TUILE_MORPH_BYTES(config.cluster_vertices, TUILE_MORPH_FACES));
        block_close(&block);
        free(frame_draw(&stage.view.scene, &config, wanted, NULL));
    }
    model_free(&a);
    stage_close(&stage);
}

static int begin(const tuile_scene_t *scene, const tuile_config_t *config) {
    static uint64_t block[32768];
    tuile_t *renderer;
    assert_int_equal(tuile_init(&renderer, config, block, sizeof block, NULL), TUILE_OK);
    const int result = tuile_begin(renderer, scene);
    if (result == TUILE_OK) { assert_int_equal(tuile_end(renderer, NULL), TUILE_OK); }
    return result;
}

static void morph_out_of_range_or_of_a_model_without_it_is_an_error(void **state) {
    stage_t stage;
    model_compiled_t a;
    tuile_config_t config = {.width = 96, .height = 80};
    (void)state;
    open_torus(&stage, true);
    morph_add(&a, &stage.compiled, squash, tilt);
    stage.view.instance.morph = 1;
    assert_int_equal(begin(&stage.view.scene, &config), TUILE_ERROR_ARGUMENT);
    stage.view.instance.model = &a.model;
    assert_int_equal(begin(&stage.view.scene, &config), TUILE_OK);
    stage.view.instance.morph = TUILE_MORPH_ONE;
    assert_int_equal(begin(&stage.view.scene, &config), TUILE_OK);
    stage.view.instance.morph = TUILE_MORPH_ONE + 1;
    assert_int_equal(begin(&stage.view.scene, &config), TUILE_ERROR_ARGUMENT);
    stage.view.instance.morph = 1;
    config.method = TUILE_TREE;
    assert_int_equal(begin(&stage.view.scene, &config), TUILE_ERROR_TREE);
    model_free(&a);
    stage_close(&stage);
}

/* All of it into the plane of its lowest point. */
static void flatten(const tuile_model_t *model, const int16_t from[3], int16_t to[3]) {
    to[0] = from[0], to[1] = from[1], to[2] = (int16_t)(model->low[2]);
}

static void a_point_is_picked_on_the_face_where_it_is(void **state) {
    mesh_t mesh;
    stage_t stage;
    model_compiled_t a;
    tuile_hit_t hit;
    static uint64_t block[8192];
    const tuile_config_t config = {.width = 64, .height = 64};
    (void)state;
    model_cube(&mesh);
    stage_open(&stage, &mesh, 64, 64);
    morph_add(&a, &stage.compiled, flatten, NULL);
    stage.view.scene.camera = stage_plain_camera(64, 64);
    stage.view.instance = stage_placed(&a.model, 0);
    for (unsigned k = 0; k <= 4; k++) {
        stage.view.instance.morph = (uint16_t)(k * 8192);
        assert_int_equal(tuile_pick(&stage.view.scene, &config, 32, 32, block, sizeof block, &hit), 1);
        const double front = a.model.high[2] + (a.model.low[2] - a.model.high[2]) * (k / 4.0);
        assert_true(fabs(hit.point[2] / 65536.0 - front) <= 1.0 / 256);
    }
    model_free(&a);
    stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions_are_within_a_256th_of_a_step_and_between_their_ends),
        cmocka_unit_test(normals_have_the_direction_of_the_mixture_and_full_length),
        cmocka_unit_test(normals_are_exact_at_the_ends_and_where_they_stay),
        cmocka_unit_test(at_its_end_the_second_key_frame_is_seen),
        cmocka_unit_test(half_way_the_model_half_way_is_seen),
        cmocka_unit_test(without_morph_the_first_key_frame_is_seen_and_nothing_is_paid),
        cmocka_unit_test(motion_is_as_smooth_as_pixels_are),
        cmocka_unit_test(too_little_memory_is_told_at_the_beginning),
        cmocka_unit_test(morph_out_of_range_or_of_a_model_without_it_is_an_error),
        cmocka_unit_test(a_point_is_picked_on_the_face_where_it_is),
    };
    return cmocka_run_group_tests_name("scene morph", tests, NULL, NULL);
}
