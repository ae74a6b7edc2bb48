/* What the fuzz programs found, each failure made small. */
#include "support/check.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/stage.h"

enum { WIDTH = 24, HEIGHT = 20 };

/* Two squares through one another, a bow tie through both. */
static const char *const crossing = "screen 24 20\ncamera ortho\nsample 1/2 1/2\n"
                                    "poly 1 2,2,0 22,2,20 22,18,20 2,18,0\n"
                                    "poly 2 2,3,20 22,3,0 22,17,0 2,17,20\n"
                                    "poly 3 1,1,9 23,19,9 23,1,9 1,19,9\n";

/* Draws with a block of exactly so many bytes; the frame's result. */
static int draw(const test_scene_t *scene, tuile_config_t config, size_t size, uint32_t *ids, size_t *wanted,
                tuile_stats_t *stats) {
    void *block = malloc(size);
    tuile_t *renderer;
    tuile_tile_t tile;
    assert_non_null(block);
    config.width = WIDTH;
    config.height = HEIGHT;
    config.format = TUILE_FACE_IDS;
    config.cluster_vertices = scene->model.cluster_vertices_max;
    config.corners = scene->model.corners_max;
    config.tree_depth = scene->model.tree_depth;
    int result = tuile_init(&renderer, &config, block, size, wanted);
    if (result == TUILE_OK) {
        assert_int_equal(tuile_begin(renderer, &scene->scene), TUILE_OK);
        while ((result = tuile_next(renderer, &tile)) == 1) {
            for (unsigned y = 0; y < tile.height; y++) {
                memcpy(ids + (size_t)(tile.y + y) * WIDTH + tile.x, tile.bytes + 4u * y * tile.width, 4u * (size_t)tile.width);
            }
        }
        *wanted = tuile_wanted(renderer);
        assert_int_equal(tuile_end(renderer, stats), TUILE_OK);
    }
    free(block);
    return result;
}

typedef struct canvas {
    uint32_t ids[HEIGHT][WIDTH], id;
} canvas_t;

static void on_face(void *context, uint32_t number, uint32_t id) {
    (void)number;
    ((canvas_t *)context)->id = id;
}

static void on_span(void *context, unsigned row, unsigned first, unsigned end) {
    canvas_t *canvas = context;
    assert_true(row < HEIGHT && first < end && end <= WIDTH);
    for (unsigned x = first; x < end; x++) {
        canvas->ids[row][x] = canvas->id;
    }
}

/* The record of a piece was taken for that of a polygon, and its corners were read from anywhere. Painting what is told, span after
 * span, makes the picture. */
static void pieces_are_told_as_they_are_painted(void **state) {
    (void)state;
    static const tuile_config_t configs[] = {{.tile_height = 0}, {.tile_height = 3}, {.tile_width = 7, .tile_height = 5}};
    for (unsigned k = 0; k < CHECK_COUNT(configs); k++) {
        canvas_t canvas = {{{0}}, 0};
        const tuile_trace_t trace = {.context = &canvas, .face = on_face, .span = on_span};
        tuile_config_t config = configs[k];
        uint32_t ids[WIDTH * HEIGHT];
        tuile_stats_t stats;
        size_t wanted;
        test_scene_t scene;
        config.method = TUILE_PAINTER;
        config.trace = &trace;
        test_scene_open(&scene, crossing);
        assert_int_equal(draw(&scene, config, 1 << 18, ids, &wanted, &stats), TUILE_OK);
        assert_true(stats.splits > 0);
        assert_memory_equal(ids, canvas.ids, sizeof ids);
        test_scene_close(&scene);
    }
}

/* One frame of two models in each other's way; true when it was drawn, and then no more than the block was used. */
static bool draw_two(const tuile_scene_t *scene, const tuile_config_t *config, size_t size) {
    void *block = malloc(size);
    tuile_t *renderer;
    tuile_tile_t tile;
    tuile_stats_t stats;
    int result;
    assert_non_null(block);
    assert_int_equal(tuile_init(&renderer, config, block, size, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, scene), TUILE_OK);
    do {
        result = tuile_next(renderer, &tile);
    } while (result == 1);
    assert_int_equal(tuile_end(renderer, &stats), TUILE_OK);
    assert_true(result == TUILE_OK || result == TUILE_ERROR_MEMORY);
    if (result == TUILE_OK) { assert_in_range(stats.peak_bytes, 1, size); }
    free(block);
    return result == TUILE_OK;
}

/* The painter asks for a place more than it fills, and reported it as used: a byte or two more than the block has, where the last
 * cut takes the last of it. Blocks about the least that does. */
static void no_more_memory_is_reported_than_there_is(void **state) {
    (void)state;
    random_source_t random = random_seed(1);
    model_compiled_t compiled;
    mesh_t mesh;
    model_octahedron(&mesh);
    model_compile(&compiled, &mesh);
    for (unsigned round = 0; round < (CHECK_SANITIZED ? 8 : 24); round++) {
        const tuile_config_t config = {.width = 32,
                                       .height = 32,
                                       .tile_width = 32,
                                       .tile_height = 32,
                                       .method = TUILE_PAINTER,
                                       .cluster_vertices = compiled.model.cluster_vertices_max};
        const tuile_instance_t instance = {.model = &compiled.model, .pose = {.scale = TUILE_SCALE_ONE}, .two_sided = true};
        tuile_instance_t two[2] = {instance, instance};
        const tuile_scene_t scene = {.instances = two, .instance_count = 2, .camera = stage_plain_camera(32, 32)};
        size_t least = 0;
        tuile_t *renderer;
        for (int i = 0; i < 2; i++) {
            tuile_rotation(two[i].pose.rotation, i, (bam16_t)random_between(&random, 0, 65535));
        }
        (void)tuile_init(&renderer, &config, NULL, 0, &least);
        while (!draw_two(&scene, &config, least)) {
            least += 64;
        }
        for (size_t less = 0; less < 64; less++) {
            (void)draw_two(&scene, &config, least - less);
        }
    }
    model_free(&compiled);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_are_told_as_they_are_painted),
        cmocka_unit_test(no_more_memory_is_reported_than_there_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
