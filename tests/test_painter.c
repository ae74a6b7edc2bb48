/* The painter's algorithm: the tests for a pair of faces one by one, cycles and crossing faces, and that the picture is the
 * z-buffer's to the last bit, in whatever memory and tiles. */
#include "support/check.h"
#include "support/frame.h"
#include "support/scenes.h"
#include "support/stage.h"

#include "reference/scene_generator.h"

/* ---- scenes as text ---- */

static uint32_t *ids_by(const test_scene_t *scene, tuile_method_t method, const tuile_config_t *config, tuile_stats_t *stats) {
    tuile_config_t c = {0};
    if (config) { c = *config; }
    c.method = (uint8_t)method;
    return test_scene_ids(scene, &c, 1 << 20, stats);
}

/* Draws by both methods; fails when a pixel differs. */
static void expect_same(const char *text, const char *name, tuile_stats_t *stats) {
    test_scene_t scene;
    test_scene_open(&scene, text);
    uint32_t *expected = ids_by(&scene, TUILE_ZBUFFER, NULL, NULL), *ids = ids_by(&scene, TUILE_PAINTER, NULL, stats);
    const unsigned width = scene.text.width, height = scene.text.height;
    for (unsigned i = 0; i < width * height; i++) {
        if (ids[i] != expected[i]) {
            fail_msg("%s: pixel %u,%u is of face %u, should be of %u\n%s", name, i % width, i / width, ids[i], expected[i], text);
        }
    }
    free(ids);
    free(expected);
    test_scene_close(&scene);
}

static void random_scenes_give_the_picture_of_the_z_buffer(void **state) {
    static const scene_generator_t options[] = {
        {0}, {.no_perspective = true, .faces = 20}, {.no_orthographic = true, .faces = 20}, {.convex = true, .faces = 40}};
    uint32_t splits = 0, moved = 0;
    (void)state;
    for (unsigned kind = 0; kind < CHECK_COUNT(options); kind++) {
        for (uint64_t seed = 1; seed <= CHECK_ROUNDS(200); seed++) {
            char name[32], *text = scene_generate(1000 * kind + seed, &options[kind]);
            tuile_stats_t stats;
            assert_non_null(text);
            (void)snprintf(name, sizeof name, "kind %u seed %u", kind, (unsigned)seed);
            expect_same(text, name, &stats);
            splits += stats.splits;
            moved += stats.moved;
            free(text);
        }
    }
    assert_true(splits > 0 && moved > 0);
}

/* Larger windows, in which pieces of pieces have room to go wrong. */
static void large_random_scenes_do_so_too(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= CHECK_ROUNDS(24); seed++) {
        const scene_generator_t options = {.width = 160, .height = 120, .faces = 30, .simple = seed % 2, .convex = seed % 3 == 0};
        char name[32], *text = scene_generate(7000 + seed, &options);
        tuile_stats_t stats;
        assert_non_null(text);
        (void)snprintf(name, sizeof name, "seed %u", (unsigned)seed);
        expect_same(text, name, &stats);
        free(text);
    }
}

/* Three bars, each over the next one and under the one before. */
static const char cycle[] = "screen 32 32\ncamera ortho\nsample 1/2 1/2\n"
                            "poly 1 2,4,0 30,4,20 30,8,20 2,8,0\n"
                            "poly 2 24,2,0 28,2,0 28,30,20 24,30,20\n"
                            "poly 3 0,2,30 6,2,30 30,26,-4 24,26,-4\n";

/* The smaller z is in front. Bars 1 and 2 meet at (26, 6): z = 17 and 3; 2 and 3 near (26, 26): 17 and below 0; 3 and 1 near (5,
 * 5): above 20 and 2. */
static void a_cycle_of_three_bars_is_cut(void **state) {
    tuile_stats_t stats;
    test_scene_t scene;
    (void)state;
    expect_same(cycle, "cycle", &stats);
    assert_in_range(stats.splits, 1, 3);
    test_scene_open(&scene, cycle);
    uint32_t *ids = ids_by(&scene, TUILE_PAINTER, NULL, NULL);
    assert_int_equal(ids[6 * 32 + 26], 2);
    assert_int_equal(ids[24 * 32 + 25], 3);
    assert_int_equal(ids[5 * 32 + 5], 1);
    free(ids);
    test_scene_close(&scene);
}

/* tests/models/crossing.txt: they change places where both have z = 5, at x = 12. */
static void crossing_rectangles_are_cut_once(void **state) {
    static const char text[] = "screen 24 12\ncamera ortho\nsample 1/2 1/2\n"
                               "poly 1 2,2,0 22,2,10 22,8,10 2,8,0\npoly 2 2,4,10 22,4,0 22,10,0 2,10,10\n";
    tuile_stats_t stats;
    test_scene_t scene;
    (void)state;
    expect_same(text, "crossing", &stats);
    assert_int_equal(stats.splits, 1);
    test_scene_open(&scene, text);
    uint32_t *ids = ids_by(&scene, TUILE_PAINTER, NULL, NULL);
    for (unsigned y = 4; y < 8; y++) {
        for (unsigned x = 2; x < 22; x++) {
            assert_int_equal(ids[y * 24 + x], x < 12 ? 1 : 2);
        }
    }
    free(ids);
    test_scene_close(&scene);
}

/* A long face through ten parallel ones: each side of each is right, whichever was cut. */
static void a_face_through_ten_others_is_cut_ten_times(void **state) {
    char text[1024];
    size_t used =
        (size_t)snprintf(text, sizeof text, "screen 64 20\ncamera ortho\nsample 1/2 1/2\npoly 1 2,6,0 62,6,60 62,14,60 2,14,0\n");
    tuile_stats_t stats;
    (void)state;
    for (int k = 0; k < 10; k++) {
        const int x = 6 * k + 2, z = 6 * k + 3;
        used += (size_t)snprintf(text + used, sizeof text - used, "poly %d %d,2,%d %d,2,%d %d,18,%d %d,18,%d\n", k + 2, x, z, x + 6,
                                 z, x + 6, z, x, z);
    }
    expect_same(text, "ten", &stats);
    assert_int_equal(stats.splits, 10);
}

/* Faces in one plane: the lower number, or the higher one, is seen, whatever their order is otherwise. */
static void of_faces_in_one_plane_the_tie_rule_decides(void **state) {
    static const char *const ties[] = {"first", "last"};
    static const char *const planes[] = {"0 0 0 0", "0 20 0 20", "0 0 20 20", "7 3 27 23"};
    (void)state;
    for (unsigned i = 0; i < 2 * CHECK_COUNT(planes); i++) {
        int z[4]; /* at the corners (4, 4), (24, 4), (4, 24), (24, 24) of a square */
        char text[512];
        tuile_stats_t stats;
        test_scene_t scene;
        assert_int_equal(sscanf(planes[i / 2], "%d %d %d %d", &z[0], &z[1], &z[2], &z[3]), 4);
        (void)snprintf(text, sizeof text,
                       "screen 28 28\ncamera ortho\nsample 1/2 1/2\ntie %s\npoly 1 4,4,%d 24,4,%d 24,24,%d 4,24,%d\n"
                       "poly 2 4,4,%d 24,24,%d 4,24,%d\npoly 3 4,4,%d 24,4,%d 24,24,%d\npoly 4 4,4,%d 24,4,%d 24,24,%d 4,24,%d\n",
                       ties[i % 2], z[0], z[1], z[3], z[2], z[0], z[3], z[2], z[0], z[1], z[3], z[0], z[1], z[3], z[2]);
        expect_same(text, ties[i % 2], &stats);
        test_scene_open(&scene, text);
        uint32_t *ids = ids_by(&scene, TUILE_PAINTER, NULL, NULL);
        for (unsigned y = 4; y < 24; y++) {
            for (unsigned x = 4; x < 24; x++) {
                assert_int_equal(ids[y * 28 + x], i % 2 ? 4 : 1);
            }
        }
        free(ids);
        test_scene_close(&scene);
    }
}

/* ---- models ---- */

static void expect_same_frame(const stage_t *stage, const tuile_config_t *config, const char *name) {
    tuile_config_t c = *config;
    tuile_stats_t stats;
    c.method = TUILE_ZBUFFER;
    uint8_t *expected = frame_draw(&stage->view.scene, &c, 1 << 20, NULL);
    c.method = TUILE_PAINTER;
    uint8_t *picture = frame_draw(&stage->view.scene, &c, 1 << 20, &stats);
    if (memcmp(picture, expected, frame_bytes(&c)) != 0) {
        fail_msg("%s, shade %u, format %u: another picture", name, c.shade, c.format);
    }
    free(picture);
    free(expected);
}

static void cube(mesh_t *mesh) { model_cube(mesh); }
static void torus(mesh_t *mesh) { model_torus(mesh, 40, 24, true); }
static void torus_of_quads(mesh_t *mesh) { model_torus(mesh, 30, 20, false); }
static void sphere(mesh_t *mesh) { model_sphere(mesh, 12, 20); }
static void staircase(mesh_t *mesh) { model_staircase(mesh, 8); }

static void models_give_the_picture_of_the_z_buffer(void **state) {
    static const struct {
        const char *name;
        void (*make)(mesh_t *mesh);
    } models[] = {{"cube", cube},           {"torus", torus},     {"torus of quads", torus_of_quads}, {"sphere", sphere},
                  {"staircase", staircase}, {"room", model_room}, {"octahedron", model_octahedron}};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(models); i++) {
        stage_t stage;
        mesh_t mesh;
        models[i].make(&mesh);
        stage_open(&stage, &mesh, 120, 90);
        for (unsigned view = 0; view < 5; view++) {
            view_options_t options = VIEW_OPTIONS_DEFAULT;
            options.has_eye = view > 0;
            options.eye[0] = view - 2.5;
            options.eye[1] = 1.1;
            options.eye[2] = 3.3;
            stage_aim(&stage, &options, 120, 90);
            stage.view.instance.two_sided = view % 2;
            tuile_config_t config = {.width = 120, .height = 90, .corners = 10};
            for (unsigned kind = 0; kind < 6; kind++) {
                config.shade = kind % 2;
                config.format = kind / 2 == 1 ? TUILE_FACE_IDS : TUILE_RGB565_BE;
                config.tie = kind / 2 == 2 ? TUILE_TIE_LAST : TUILE_TIE_FIRST;
                expect_same_frame(&stage, &config, models[i].name);
            }
        }
        stage_close(&stage);
    }
}

/* ---- memory and tiles ---- */

static void any_tile_gives_the_same_picture(void **state) {
    static const uint16_t tiles[][2] = {{0, 1}, {0, 7}, {16, 16}, {5, 3}, {1, 64}, {200, 200}};
    const scene_generator_t options = {.width = 64, .height = 48, .faces = 16};
    uint64_t random = 5;
    (void)state;
    for (uint64_t seed = 1; seed <= CHECK_ROUNDS(10); seed++) {
        char *text = scene_generate(300 + seed, &options);
        test_scene_t scene;
        test_scene_open(&scene, text);
        uint32_t *expected = ids_by(&scene, TUILE_ZBUFFER, NULL, NULL);
        for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
            const tuile_config_t config = {.method = TUILE_PAINTER, .tile_width = tiles[i][0], .tile_height = tiles[i][1]};
            for (unsigned way = 0; way < 4; way++) {
                uint32_t *ids = way < 3 ? test_scene_ids_in_order(&scene, &config, 1 << 17, way, &random)
                                        : test_scene_ids(&scene, &config, 1 << 17, NULL);
                assert_memory_equal(ids, expected, 4u * scene.text.width * scene.text.height);
                free(ids);
            }
        }
        free(expected);
        test_scene_close(&scene);
        free(text);
    }
}

/* Draws in a block of so many bytes. True when it could, and then the picture is right; else `wanted` is a larger size. */
static bool draws_in(const test_scene_t *scene, tuile_config_t config, size_t size_bytes, const uint32_t *expected, size_t *wanted,
                     tuile_stats_t *stats) {
    const unsigned width = scene->text.width;
    block_t block;
    tuile_t *renderer;
    tuile_tile_t tile;
    int result;
    block_open(&block, size_bytes);
    config.width = scene->text.width;
    config.height = scene->text.height;
    config.format = TUILE_FACE_IDS;
    config.method = TUILE_PAINTER;
    config.tie = (uint8_t)scene->view.tie;
    config.cluster_vertices = scene->model.cluster_vertices_max;
    config.corners = scene->model.corners_max;
    assert_int_equal(tuile_init(&renderer, &config, block.bytes, size_bytes, NULL), 0);
    assert_int_equal(tuile_begin(renderer, &scene->scene), 0);
    while ((result = tuile_next(renderer, &tile)) == 1) {
        for (unsigned i = 0; i < (unsigned)tile.width * tile.height; i++) {
            uint32_t id;
            memcpy(&id, tile.bytes + 4 * (size_t)i, 4);
            if (id) { id = tuile_model_source_face(&scene->model, id - 1) + 1; }
            assert_int_equal(id, expected[(tile.y + i / tile.width) * width + tile.x + i % tile.width]);
        }
    }
    if (result != 0) {
        assert_int_equal(result, TUILE_ERROR_MEMORY);
        *wanted = tuile_wanted(renderer);
        assert_true(*wanted > size_bytes);
    }
    assert_int_equal(tuile_end(renderer, stats), 0);
    block_close(&block);
    return result == 0;
}

static void small_blocks_give_the_same_picture_or_tell_a_size(void **state) {
    static const uint16_t tiles[][2] = {{0, 4}, {16, 16}, {7, 5}};
    const scene_generator_t options = {.width = 64, .height = 48, .faces = 16};
    unsigned refused = 0, in_passes = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= CHECK_ROUNDS(6); seed++) {
        char *text = scene_generate(400 + seed, &options);
        test_scene_t scene;
        test_scene_open(&scene, text);
        uint32_t *expected = ids_by(&scene, TUILE_ZBUFFER, NULL, NULL);
        for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
            tuile_config_t config = {.method = TUILE_PAINTER, .tile_width = tiles[i][0], .tile_height = tiles[i][1]};
            const size_t least = test_scene_least(&scene, &config);
            for (unsigned k = 0; k < 12; k++) {
                size_t size_bytes = least + k * k * 96, wanted = 0;
                tuile_stats_t stats;
                unsigned tries = 0;
                while (!draws_in(&scene, config, size_bytes, expected, &wanted, &stats)) {
                    size_bytes = wanted;
                    refused++;
                    assert_true(tries++ < 40); /* cuts cannot be foreseen: the size told grows by an eighth at least */
                }
                in_passes += stats.passes > 1;
            }
        }
        free(expected);
        test_scene_close(&scene);
        free(text);
    }
    assert_true(refused > 0 && in_passes > 0);
}

/* The formula at the top of painter.c: 2 bytes a face and 2 more, where nothing is cut. */
static void sorting_takes_two_bytes_a_face(void **state) {
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_torus(&mesh, 40, 24, true);
    stage_open(&stage, &mesh, 120, 90);
    tuile_config_t config = {.width = 120, .height = 90, .tile_height = 90, .buffers = 1};
    tuile_stats_t depth, order, again;
    config.cluster_vertices = stage.compiled.model.cluster_vertices_max;
    config.method = TUILE_ZBUFFER;
    free(frame_draw(&stage.view.scene, &config, 1 << 20, &depth)); /* one tile: no state is carried */
    config.method = TUILE_PAINTER;
    free(frame_draw(&stage.view.scene, &config, 1 << 20, &order));
    assert_int_equal(order.splits, 0);
    assert_in_range(order.faces_binned, 1, depth.faces_binned); /* the z-buffer keeps faces without columns, in 8 bytes each */
    const uint32_t empty_bytes = 8 * (depth.faces_binned - order.faces_binned);
    /* Colours of one material by light: the z-buffer keeps them where there is memory to spare (frame/frame.c). */
    const uint32_t depth_bytes = TUILE_ALIGN64(2u * 120u * 90u) + TUILE_ALIGN8(2u * 256u + 2u);
    assert_int_equal(order.peak_bytes, TUILE_ALIGN8(depth.peak_bytes - depth_bytes - empty_bytes + 2 * (order.faces_binned + 1)));
    const size_t enough = TUILE_ALIGN8((size_t)order.peak_bytes);
    free(frame_draw(&stage.view.scene, &config, enough, &again));
    assert_int_equal(again.passes, 1);
    /* There is one tile only, so with less there is no way. */
    block_t block;
    tuile_t *renderer;
    tuile_tile_t tile;
    block_open(&block, enough - 8);
    assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), 0);
    assert_int_equal(tuile_begin(renderer, &stage.view.scene), 0);
    assert_int_equal(tuile_next(renderer, &tile), TUILE_ERROR_MEMORY);
    const size_t wanted = tuile_wanted(renderer);
    block_close(&block);
    assert_in_range(wanted, enough, 2 * enough);
    free(frame_draw(&stage.view.scene, &config, wanted, &again));
    stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_give_the_picture_of_the_z_buffer),
        cmocka_unit_test(large_random_scenes_do_so_too),
        cmocka_unit_test(a_cycle_of_three_bars_is_cut),
        cmocka_unit_test(crossing_rectangles_are_cut_once),
        cmocka_unit_test(a_face_through_ten_others_is_cut_ten_times),
        cmocka_unit_test(of_faces_in_one_plane_the_tie_rule_decides),
        cmocka_unit_test(models_give_the_picture_of_the_z_buffer),
        cmocka_unit_test(any_tile_gives_the_same_picture),
        cmocka_unit_test(small_blocks_give_the_same_picture_or_tell_a_size),
        cmocka_unit_test(sorting_takes_two_bytes_a_face),
    };
    return cmocka_run_group_tests_name("painter", tests, NULL, NULL);
}
