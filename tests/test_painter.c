/* The painter's algorithm: the tests for a pair of faces one by one, cycles and crossing faces, and that the picture is the z-buffer's
 * to the last bit, in whatever memory and tiles. */
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
        for (uint64_t seed = 1; seed <= CHECK_ROUNDS(500); seed++) {
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
    print_message("%u splits, %u moved\n", splits, moved);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_give_the_picture_of_the_z_buffer),
    };
    return cmocka_run_group_tests_name("painter", tests, NULL, NULL);
}
