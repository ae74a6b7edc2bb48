#include "scenes.h"

#include "../reference/scene_generator.h"
#include "../reference/visibility_reference.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

static void open_scene(test_scene_t *scene, const char *text, bool tree) {
    sim_error_t error = {""};
    scene_quantisation_t quantisation;
    mesh_options_t options = scene_text_mesh_options();
    mesh_report_t report;
    size_t size_bytes;

    memset(scene, 0, sizeof *scene);
    options.tree = tree;
    if (scene_text_parse(&scene->text, text, strlen(text), "scene", &error) != 0 ||
        scene_text_mesh(&scene->text, &scene->mesh, &quantisation, &error) != 0 ||
        scene_text_camera(&scene->text, &quantisation, &scene->view, &error) != 0) {
        fail_msg("%s\n%s", error.text, text);
    }
    if (scene->mesh.face_count) {
        if (mesh_compile(&scene->mesh, &options, &scene->bytes, &size_bytes, &report, &error) != 0) {
            fail_msg("%s\n%s", error.text, text);
        }
        assert_int_equal(tuile_model_open(&scene->model, scene->bytes, size_bytes), 0);
        scene->scene.instance_count = 1;
    }
    scene->instance = (tuile_instance_t){&scene->model, scene->view.pose, true};
    scene->scene.instances = &scene->instance;
    scene->scene.camera = scene->view.camera;
}

void test_scene_open(test_scene_t *scene, const char *text) { open_scene(scene, text, false); }

void test_scene_open_tree(test_scene_t *scene, const char *text) { open_scene(scene, text, true); }

void test_scene_close(test_scene_t *scene) {
    scene_text_free(&scene->text);
    mesh_free(&scene->mesh);
    free(scene->bytes);
}

static tuile_config_t complete(const test_scene_t *scene, const tuile_config_t *config) {
    tuile_config_t c = {0};
    if (config) { c = *config; }
    c.width = scene->text.width;
    c.height = scene->text.height;
    c.format = TUILE_FACE_IDS;
    c.tie = (uint8_t)scene->view.tie;
    if (c.cluster_vertices == 0 && scene->scene.instance_count) { c.cluster_vertices = scene->model.cluster_vertices_max; }
    if (scene->scene.instance_count) {
        c.corners = scene->model.corners_max;
        c.tree_depth = scene->model.tree_depth;
    }
    return c;
}

static tuile_t *open_renderer(const test_scene_t *scene, const tuile_config_t *config, size_t memory_bytes, void **block) {
    const tuile_config_t c = complete(scene, config);
    tuile_t *renderer;
    *block = malloc(memory_bytes);
    assert_int_equal(tuile_init(&renderer, &c, *block, memory_bytes, NULL), 0);
    assert_int_equal(tuile_begin(renderer, &scene->scene), 0);
    return renderer;
}

static void store(const test_scene_t *scene, const tuile_tile_t *tile, uint32_t *ids) {
    for (unsigned y = 0; y < tile->height; y++) {
        for (unsigned x = 0; x < tile->width; x++) {
            uint32_t id;
            memcpy(&id, tile->bytes + 4u * ((size_t)y * tile->width + x), 4);
            if (id) { id = tuile_model_source_face(&scene->model, id - 1) + 1; }
            ids[(size_t)(tile->y + y) * scene->text.width + tile->x + x] = id;
        }
    }
}

static uint32_t *blank(const test_scene_t *scene) {
    const size_t pixels = (size_t)scene->text.width * scene->text.height;
    uint32_t *ids = malloc(pixels * sizeof *ids);
    for (size_t i = 0; i < pixels; i++) {
        ids[i] = TEST_NOT_DRAWN;
    }
    return ids;
}

uint32_t *test_scene_ids(const test_scene_t *scene, const tuile_config_t *config, size_t memory_bytes, tuile_stats_t *stats) {
    void *block;
    tuile_tile_t tile;
    tuile_t *renderer = open_renderer(scene, config, memory_bytes, &block);
    uint32_t *ids = blank(scene);
    int result;
    while ((result = tuile_next(renderer, &tile)) == 1) {
        store(scene, &tile, ids);
    }
    assert_int_equal(result, 0);
    assert_int_equal(tuile_end(renderer, stats), 0);
    free(block);
    return ids;
}

uint32_t *test_scene_ids_in_order(const test_scene_t *scene, const tuile_config_t *config, size_t memory_bytes, unsigned way,
                                  uint64_t *random) {
    void *block;
    tuile_tile_t tile;
    tuile_t *renderer = open_renderer(scene, config, memory_bytes, &block);
    const tuile_config_t *c = tuile_config(renderer);
    const uint32_t columns = (uint32_t)(c->width + c->tile_width - 1) / c->tile_width,
                   rows = (uint32_t)(c->height + c->tile_height - 1) / c->tile_height;
    const uint32_t count = columns * rows;
    uint32_t *ids = blank(scene), *order = malloc(count * sizeof *order);
    for (uint32_t i = 0; i < count; i++) {
        order[i] = way == 0 ? count - 1 - i : i % rows * columns + i / rows;
    }
    for (uint32_t i = count - 1; way == 2 && i > 0; i--) {
        const uint32_t j = (uint32_t)scene_generator_between(random, 0, (int32_t)i), swap = order[i];
        order[i] = order[j];
        order[j] = swap;
    }
    for (uint32_t i = 0; i < count; i++) {
        assert_int_equal(tuile_seek(renderer, order[i]), 0);
        assert_int_equal(tuile_next(renderer, &tile), 1);
        store(scene, &tile, ids);
    }
    assert_int_equal(tuile_end(renderer, NULL), 0);
    free(order);
    free(block);
    return ids;
}

size_t test_scene_least(const test_scene_t *scene, const tuile_config_t *config) {
    const tuile_config_t c = complete(scene, config);
    tuile_t *renderer;
    size_t wanted = 0;
    assert_int_equal(tuile_init(&renderer, &c, NULL, 0, &wanted), TUILE_ERROR_MEMORY);
    return wanted;
}

unsigned test_scene_wrong_pixels(const test_scene_t *scene, const char *text, const uint32_t *ids) {
    visibility_reference_t *reference;
    sim_error_t error = {""};
    unsigned wrong = 0;
    if (visibility_reference_make(&reference, &scene->text, NULL, &error) != 0) { fail_msg("%s\n%s", error.text, text); }
    for (int y = 0; y < scene->text.height; y++) {
        for (int x = 0; x < scene->text.width; x++) {
            const int32_t face = (int32_t)ids[y * scene->text.width + x] - 1;
            const visibility_pixel_t expected = visibility_reference_at(reference, x, y);
            const bool right = expected.doubt ? visibility_reference_allows(reference, x, y, face) : face == expected.face;
            if (!right && wrong++ < 4) {
                print_message("pixel %d,%d: face %d, expected %d, doubt %u\n", x, y, face, expected.face, expected.doubt);
            }
        }
    }
    visibility_reference_free(reference);
    return wrong;
}
