/* The compact renderer: the pictures of the full one, dot by dot. */
#include "../firmware/scenes.h"
#include "../raster/compact/compact.h"
#include "../raster/geometry/model.h"
#include "support/built.h"
#include "support/check.h"
#include "support/frame.h"
#include "support/solids.h"

#define WIDTH 128
#define HEIGHT 64

static void torus(mesh_t *mesh) { model_torus(mesh, 12, 7, false); }
static void torus_of_triangles(mesh_t *mesh) { model_torus(mesh, 9, 6, true); }
static void sphere(mesh_t *mesh) { model_sphere(mesh, 6, 11); }
static void staircase(mesh_t *mesh) { model_staircase(mesh, 5); }

/* Two bars that go through one another: faces are cut by the display tree, with corners between whole steps. */
static void crossed_bars(mesh_t *mesh) {
    model_start(mesh);
    model_box(mesh, (const double[3]){-1.3, -0.37, -0.31}, (const double[3]){1.2, 0.45, 0.33}, model_material(mesh, 200, 90, 60));
    model_box(mesh, (const double[3]){-0.43, -1.3, -0.35}, (const double[3]){0.41, 1.2, 0.37}, model_material(mesh, 80, 160, 240));
    for (size_t p = 0; p < mesh->position_count; p++) {
        double *at = mesh->positions[p];
        at[0] += 0.21 * at[1] + (p < 8 ? 0.07 : 0.13) * at[2];
        at[1] += 0.11 * at[2] - 0.03 * at[0];
    }
}

/* Sheets that cross themselves: of two lobes the larger one tells which side is the front, but from near the smaller one may look
 * larger. */
static void bow_ties(mesh_t *mesh) {
    model_start(mesh);
    for (unsigned i = 0; i < 6; i++) {
        const double z = 0.3 * i - 0.7, way = i % 2 ? -1 : 1, lean = 0.17 * i;
        const uint32_t corners[4] = {model_position(mesh, -1 * way, -0.9, z), model_position(mesh, 1 * way, 0.7, z + lean),
                                     model_position(mesh, 1 * way, -0.7, z + lean), model_position(mesh, -1 * way, 0.9, z)};
        model_face(mesh, corners, 4, model_material(mesh, 60 + 30 * i, 200 - 20 * i, 120));
    }
}

static const struct {
    const char *name;
    void (*make)(mesh_t *mesh);
    double size; /* from the middle to the outside */
} models[] = {
    {"cube", model_cube, 1},     {"torus", torus, 1.2},   {"triangles", torus_of_triangles, 1.2}, {"sphere", sphere, 1},
    {"staircase", staircase, 3}, {"room", model_room, 4}, {"octahedron", model_octahedron, 1},    {"crossed bars", crossed_bars, 1},
    {"bow ties", bow_ties, 1}};

static const uint8_t methods[] = {TUILE_ZBUFFER, TUILE_TREE};
static const uint16_t tiles[][2] = {{0, 0}, {0, 8}, {32, 8}, {16, 16}, {48, 24}, {8, 8}};

static uint8_t *picture_of_compact(const uint8_t *bytes, const tuile_model_t *model, const tuile_compact_view_t *view,
                                   uint8_t method, const uint16_t tile_size[2]) {
    const tuile_config_t whole = {.width = WIDTH, .height = HEIGHT, .format = TUILE_MONO_PAGES};
    const tuile_compact_config_t config = {WIDTH, HEIGHT, tile_size[0], tile_size[1], method};
    uint8_t *picture = frame_blank(&whole);
    tuile_compact_t compact;
    tuile_tile_t tile;
    block_t block;
    int result;

    block_open(&block, TUILE_COMPACT_BYTES(method, model->vertex_count, model->tree_depth, tile_size[0] ? tile_size[0] : WIDTH,
                                           tile_size[1] ? tile_size[1] : HEIGHT));
    assert_int_equal(tuile_compact_open(&compact, &config, bytes, block.bytes, block.size_bytes - 1), TUILE_ERROR_MEMORY);
    assert_int_equal(tuile_compact_open(&compact, &config, bytes, block.bytes, block.size_bytes), 0);
    assert_int_equal(tuile_compact_next(&compact, &tile), 0); /* no frame has been begun */
    tuile_compact_begin(&compact, view);
    while ((result = tuile_compact_next(&compact, &tile)) == 1) {
        frame_paste(picture, &whole, &tile);
    }
    assert_int_equal(result, 0);
    block_close(&block);
    return picture;
}

static unsigned lit_dots(const uint8_t *picture) {
    unsigned count = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        count += picture[i];
    }
    return count;
}

static unsigned different_dots(const uint8_t *a, const uint8_t *b) {
    unsigned count = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        count += a[i] != b[i];
    }
    return count;
}

/* Both renderers' pictures of the scene by both methods; returns how many dots the full one's have lit. */
static unsigned check_scene(const tuile_scene_t *scene, tuile_config_t config, const uint8_t *bytes, unsigned round,
                            const char *name) {
    const tuile_model_t *model = scene->instances[0].model;
    tuile_compact_view_t view;
    unsigned lit = 0;
    config.format = TUILE_MONO_PAGES;
    config.shade = TUILE_FLAT;
    assert_int_equal(tuile_compact_view(&view, scene, WIDTH, HEIGHT), 0);
    for (unsigned m = 0; m < CHECK_COUNT(methods); m++) {
        const uint16_t *tile = tiles[(round + m) % CHECK_COUNT(tiles)];
        config.method = methods[m];
        uint8_t *expected = frame_draw(scene, &config, 1 << 20, NULL);
        uint8_t *picture = picture_of_compact(bytes, model, &view, methods[m], tile);
        const unsigned different = different_dots(picture, expected);
        if (different) { fail_msg("%s, method %u, tiles of %ux%u: %u dots differ", name, methods[m], tile[0], tile[1], different); }
        lit += lit_dots(expected);
        free(picture);
        free(expected);
    }
    return lit;
}

/* The eye outside and inside, near the faces, so that some are cut at the near plane and the guard band; mirrored models too. */
static void models_are_drawn_as_by_the_full_renderer(void **state) {
    random_source_t random = random_seed(31);
    (void)state;
    for (unsigned m = 0; m < CHECK_COUNT(models); m++) {
        solid_model_t model;
        unsigned lit = 0;
        mesh_t mesh;
        const unsigned rounds = CHECK_ROUNDS(160);
        models[m].make(&mesh);
        solid_model_open(&model, &mesh, false);
        for (unsigned round = 0; round < rounds; round++) {
            solids_t solids;
            double point[3], eye[3], at[3];
            char name[64];
            solids_start(&solids, WIDTH, HEIGHT);
            tuile_instance_t *instance = solids_add(&solids, &model);
            if (random_one_in(&random, 2)) { instance->pose.scale = (tuile_scale_t){3, -1}; }
            solids_place(instance, random_between(&random, -4, 4), random_between(&random, -4, 4), random_between(&random, -4, 4));
            solids_turn(instance, &random, round % 4 == 3);
            const double reach = models[m].size * (round % 2 ? 2.5 : 0.9);
            for (unsigned k = 0; k < 3; k++) {
                point[k] = random_real(&random, -reach, reach);
            }
            solids_world(instance, point, eye);
            for (unsigned k = 0; k < 3; k++) {
                point[k] = random_real(&random, -0.5, 0.5) * models[m].size;
            }
            solids_world(instance, point, at);
            solids_look(&solids, eye, at);
            solids.scene.camera.near = random_one_in(&random, 2) ? 1 << 12 : 1 << 15;
            solids.scene.background[0] = solids.scene.background[1] = solids.scene.background[2] = (uint8_t)(round % 3 * 40);
            (void)snprintf(name, sizeof name, "%s, round %u", models[m].name, round);
            lit += check_scene(&solids.scene, solids_config(&solids, TUILE_ZBUFFER), model.compiled.bytes, round, name);
        }
        assert_true(lit > rounds * 2 * WIDTH * HEIGHT / 50); /* there was something to see */
        solid_model_close(&model);
    }
}

/* What the smallest board shows, all the way round. */
static void scenes_of_boards_are_drawn_as_by_the_full_renderer(void **state) {
    static const char *const names[][2] = {{"cube", "firmware/models/cube.obj"}, {"room", "tests/models/room.obj"}};
    const mesh_options_t options = {.tree = true};
    (void)state;
    for (unsigned s = 0; s < CHECK_COUNT(names); s++) {
        const scene_script_t *script = scene_find(names[s][0]);
        built_t built = built_load(names[s][1], &options);
        scene_stage_t stage;
        assert_int_equal(scene_open(&stage, script, built.bytes, built.size, WIDTH, HEIGHT), 0);
        for (uint32_t frame = 0; frame < script->period; frame++) {
            tuile_config_t config = {.width = WIDTH, .height = HEIGHT};
            char name[64];
            assert_int_equal(scene_frame(&stage, frame), 0);
            scene_configure(&stage, &config);
            (void)snprintf(name, sizeof name, "%s, frame %u", names[s][0], frame);
            assert_true(check_scene(&stage.scene, config, built.bytes, frame, name) > 500);
        }
        free(built.bytes);
    }
}

static void what_is_not_drawn_is_refused(void **state) {
    static _Alignas(8) uint8_t block[16384];
    const tuile_compact_config_t good = {WIDTH, HEIGHT, 32, 8, TUILE_ZBUFFER};
    tuile_compact_config_t config = good;
    const mesh_options_t no_tree = {.tree = false};
    tuile_compact_view_t view;
    tuile_compact_t compact;
    model_compiled_t compiled;
    tuile_instance_t instances[2] = {{.pose = {.scale = TUILE_SCALE_ONE}}};
    tuile_light_t lights[3] = {{.direction = {0, 0, -16384}, .intensity = 100}};
    tuile_scene_t scene = {.instances = instances, .instance_count = 1, .lights = lights, .light_count = 1};
    const tuile_material_t material = {.colour = {9, 9, 9}};
    mesh_t mesh;
    (void)state;
    model_cube(&mesh);
    model_compile_with(&compiled, &mesh, &no_tree);
#define OPEN(bytes) tuile_compact_open(&compact, &config, bytes, block, sizeof block)
    assert_int_equal(OPEN(compiled.bytes), 0);
    config.method = TUILE_TREE;
    assert_int_equal(OPEN(compiled.bytes), TUILE_ERROR_TREE);
    config.method = TUILE_PAINTER;
    assert_int_equal(OPEN(compiled.bytes), TUILE_ERROR_ARGUMENT);
    config = good, config.tile_height = 12;
    assert_int_equal(OPEN(compiled.bytes), TUILE_ERROR_ARGUMENT);
    config = good, config.tile_width = WIDTH + 1;
    assert_int_equal(OPEN(compiled.bytes), TUILE_ERROR_ARGUMENT);
    config = good, config.width = TUILE_WINDOW_MAX_PX + 1;
    assert_int_equal(OPEN(compiled.bytes), TUILE_ERROR_ARGUMENT);
    config = good, config.height = 0;
    assert_int_equal(OPEN(compiled.bytes), TUILE_ERROR_ARGUMENT);
    config = good;
    compiled.bytes[0] ^= 1;
    assert_int_equal(OPEN(compiled.bytes), TUILE_ERROR_MODEL);
    compiled.bytes[0] ^= 1;
    uint8_t *flags = compiled.bytes + (compiled.model.materials - compiled.bytes) + MATERIAL_AT_FLAGS;
    *flags |= TUILE_MATERIAL_TWO_SIDED;
    assert_int_equal(OPEN(compiled.bytes), TUILE_ERROR_EFFECTS);
    *flags &= (uint8_t)~TUILE_MATERIAL_TWO_SIDED;

    for (unsigned i = 0; i < 3; i++) {
        instances[0].pose.rotation[i][i] = scene.camera.rotation[i][i] = TUILE_ONE_Q30;
    }
    instances[0].model = &compiled.model;
    scene.camera.focal_x = scene.camera.focal_y = TUILE_Q16(64);
    scene.camera.near = TUILE_Q16(1), scene.camera.far = TUILE_Q16(10);
#define VIEW() tuile_compact_view(&view, &scene, WIDTH, HEIGHT)
    assert_int_equal(VIEW(), 0);
    scene.camera.projection = TUILE_ORTHOGRAPHIC;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    scene.camera.projection = TUILE_PERSPECTIVE, instances[0].two_sided = true;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    instances[0].two_sided = false, lights[0].colour[1] = 9;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    lights[0].colour[1] = 0, lights[0].kind = TUILE_LIGHT_POINT;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    lights[0].kind = TUILE_LIGHT_DIRECTIONAL, scene.light_count = 3;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    scene.light_count = 1, scene.line_count = 1;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    scene.line_count = 0, scene.sprite_count = 1;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    scene.sprite_count = 0, scene.fog.kind = TUILE_FOG_LINEAR;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    scene.fog.kind = TUILE_FOG_NONE, scene.ambient_colour[2] = 1;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    scene.ambient_colour[2] = 0, instances[0].morph = 1;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    instances[0].morph = 0, instances[0].materials = &material;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    instances[0].materials = NULL, scene.instance_count = 2;
    assert_int_equal(VIEW(), TUILE_ERROR_EFFECTS);
    scene.instance_count = 1, scene.camera.near = 0;
    assert_int_equal(VIEW(), TUILE_ERROR_CAMERA);
    model_free(&compiled);
    mesh_free(&mesh);
}

/* Faces with more corners than there is room for. */
static void faces_beyond_the_limits_are_refused(void **state) {
    static _Alignas(8) uint8_t block[16384];
    const tuile_compact_config_t config = {WIDTH, HEIGHT, 32, 8, TUILE_ZBUFFER};
    (void)state;
    for (uint32_t count = 12; count <= 13; count++) {
        model_compiled_t compiled;
        tuile_compact_t compact;
        uint32_t corners[16];
        mesh_t mesh;
        model_start(&mesh);
        for (uint32_t i = 0; i < count; i++) { /* on a parabola: convex */
            corners[i] = model_position(&mesh, i, (double)(i * i), 0);
        }
        model_face(&mesh, corners, count, model_material(&mesh, 9, 9, 9));
        model_compile(&compiled, &mesh);
        assert_int_equal(tuile_compact_open(&compact, &config, compiled.bytes, block, sizeof block),
                         count > TUILE_COMPACT_CORNERS ? TUILE_ERROR_LIMITS : 0);
        model_free(&compiled);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_are_drawn_as_by_the_full_renderer),
        cmocka_unit_test(scenes_of_boards_are_drawn_as_by_the_full_renderer),
        cmocka_unit_test(what_is_not_drawn_is_refused),
        cmocka_unit_test(faces_beyond_the_limits_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
