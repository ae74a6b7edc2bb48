/* The whole renderer against exact references: random scenes, pixel by pixel; memory and tiles of any size; any order of tiles. */
#include "support/scenes.h"

#include "../raster/tuile.h"
#include "reference/scene_generator.h"

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__SANITIZE_ADDRESS__)
#define SCENES 150
#else
#define SCENES 1500
#endif

static void check_seeds(const scene_generator_t *options, uint64_t first, unsigned count) {
    for (uint64_t seed = first; seed < first + count; seed++) {
        char *text = scene_generate(seed, options);
        test_scene_t scene;
        assert_non_null(text);
        test_scene_open(&scene, text);
        uint32_t *ids = test_scene_ids(&scene, NULL, 1 << 20, NULL);
        const unsigned wrong = test_scene_wrong_pixels(&scene, text, ids);
        free(ids);
        if (wrong) { fail_msg("seed %llu: %u pixels wrong\n%s", (unsigned long long)seed, wrong, text); }
        test_scene_close(&scene);
        free(text);
    }
}

static void random_orthographic_scenes_equal_the_exact_reference(void **state) {
    const scene_generator_t options = {.no_perspective = true};
    (void)state;
    check_seeds(&options, 1, SCENES);
}

static void random_perspective_scenes_equal_the_exact_reference(void **state) {
    const scene_generator_t options = {.no_orthographic = true};
    (void)state;
    check_seeds(&options, 100001, SCENES);
}

static void a_ground_plane_through_the_near_plane_reaches_the_horizon(void **state) {
    static const int reach[] = {100, 1000, 30000};
    (void)state;
    for (unsigned i = 0; i < sizeof reach / sizeof *reach; i++) {
        const int r = reach[i];
        char text[512];
        test_scene_t scene;
        (void)snprintf(text, sizeof text,
                       "screen 160 120\ncamera persp 150 1\nsample 1/2 1/2\n"
                       "poly 1 %d,1,%d %d,1,%d %d,1,%d\npoly 2 %d,1,%d %d,1,%d %d,1,%d\n",
                       -r, -r, r, -r, r, r, -r, -r, r, r, -r, r);
        test_scene_open(&scene, text);
        uint32_t *ids = test_scene_ids(&scene, NULL, 1 << 20, NULL);
        assert_int_equal(test_scene_wrong_pixels(&scene, text, ids), 0);
        unsigned seen = 0;
        for (unsigned p = 160 * 62; p < 160 * 120; p++) {
            seen += ids[p] != 0;
        }
        assert_in_range(seen, 160u * 58u * (r == 100 ? 97u : 99u) / 100u, 160u * 58u);
        free(ids);
        test_scene_close(&scene);
    }
}

/* Triangles of all sizes round the eye, so that most cross the near plane, over a ground plane. */
static void random_triangles_across_the_near_plane_never_vanish(void **state) {
    uint64_t random = 7;
    (void)state;
    for (unsigned round = 0; round < (SCENES >= 1000 ? 220u : 30u); round++) {
        static const int reaches[] = {20, 100, 1000, 30000};
        char text[4096];
        size_t used = (size_t)snprintf(text, sizeof text, "screen 48 36\ncamera persp 40 1\nsample 1/2 1/2\n");
        for (unsigned k = 0; k < 10; k++) {
            const int r = reaches[(round + k) % 4];
            used += (size_t)snprintf(text + used, sizeof text - used, "poly %u", k + 1);
            for (unsigned c = 0; c < 3; c++) {
                used += (size_t)snprintf(text + used, sizeof text - used, " %d,%d,%d", scene_generator_between(&random, -r, r),
                                         scene_generator_between(&random, -r, r),
                                         scene_generator_between(&random, c == 0 ? 2 : -r, c == 1 ? 0 : r));
            }
            text[used++] = '\n';
            text[used] = '\0';
        }
        test_scene_t scene;
        test_scene_open(&scene, text);
        uint32_t *ids = test_scene_ids(&scene, NULL, 1 << 20, NULL);
        const unsigned wrong = test_scene_wrong_pixels(&scene, text, ids);
        if (wrong) { fail_msg("round %u: %u pixels wrong\n%s", round, wrong, text); }
        free(ids);
        test_scene_close(&scene);
    }
}

static void any_memory_and_any_tile_give_the_same_picture(void **state) {
    static const uint16_t tiles[][2] = {{0, 0}, {0, 1}, {0, 7}, {16, 16}, {5, 3}, {1, 64}, {200, 200}};
    const scene_generator_t options = {.width = 64, .height = 48, .faces = 12};
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        char *text = scene_generate(seed, &options);
        test_scene_t scene;
        test_scene_open(&scene, text);
        uint32_t *expected = test_scene_ids(&scene, NULL, 1 << 20, NULL);
        for (unsigned i = 0; i < sizeof tiles / sizeof *tiles; i++) {
            tuile_config_t config = {.tile_width = tiles[i][0], .tile_height = tiles[i][1] ? tiles[i][1] : 4};
            const size_t least = test_scene_least(&scene, &config);
            for (unsigned k = 0; k < 44; k++) {
                uint32_t *ids = test_scene_ids(&scene, &config, least + k * k * 2, NULL);
                assert_memory_equal(ids, expected, 4u * scene.text.width * scene.text.height);
                free(ids);
            }
        }
        free(expected);
        test_scene_close(&scene);
        free(text);
    }
}

static void tiles_may_be_drawn_in_any_order(void **state) {
    const scene_generator_t options = {.width = 60, .height = 44, .faces = 12};
    static const uint16_t tiles[][2] = {{60, 5}, {13, 9}};
    uint64_t random = 3;
    (void)state;
    for (uint64_t seed = 50; seed < 60; seed++) {
        char *text = scene_generate(seed, &options);
        test_scene_t scene;
        test_scene_open(&scene, text);
        uint32_t *expected = test_scene_ids(&scene, NULL, 1 << 20, NULL);
        for (unsigned i = 0; i < 2; i++) {
            for (unsigned way = 0; way < 3; way++) {
                const tuile_config_t config = {.tile_width = tiles[i][0], .tile_height = tiles[i][1]};
                uint32_t *ids = test_scene_ids_in_order(&scene, &config, 1 << 16, way, &random);
                assert_memory_equal(ids, expected, 4u * scene.text.width * scene.text.height);
                free(ids);
            }
        }
        free(expected);
        test_scene_close(&scene);
        free(text);
    }
}

static void two_renderers_share_a_frame_by_bands_or_by_alternate_tiles(void **state) {
    const scene_generator_t options = {.width = 60, .height = 44, .faces = 12};
    (void)state;
    for (uint64_t seed = 70; seed < 80; seed++) {
        char *text = scene_generate(seed, &options);
        test_scene_t scene;
        test_scene_open(&scene, text);
        uint32_t *expected = test_scene_ids(&scene, NULL, 1 << 20, NULL);
        const tuile_config_t shares[][2] = {
            {{.tile_height = 4, .row_end = 20}, {.tile_height = 4, .row_first = 20}},
            {{.tile_height = 4, .tile_first = 0, .tile_step = 2}, {.tile_height = 4, .tile_first = 1, .tile_step = 2}},
            {{.tile_width = 16, .tile_height = 8, .tile_first = 0, .tile_step = 3},
             {.tile_width = 16, .tile_height = 8, .tile_first = 1, .tile_step = 3}},
        };
        for (unsigned i = 0; i < 3; i++) {
            uint32_t *a = test_scene_ids(&scene, &shares[i][0], 1 << 16, NULL),
                     *b = test_scene_ids(&scene, &shares[i][1], 1 << 16, NULL);
            for (unsigned p = 0; p < (unsigned)scene.text.width * scene.text.height; p++) {
                if (a[p] != TEST_NOT_DRAWN) { assert_int_equal(a[p], expected[p]); }
                if (b[p] != TEST_NOT_DRAWN) { assert_int_equal(b[p], expected[p]); }
                if (i < 2) { assert_true((a[p] == TEST_NOT_DRAWN) != (b[p] == TEST_NOT_DRAWN)); }
            }
            free(a);
            free(b);
        }
        free(expected);
        test_scene_close(&scene);
        free(text);
    }
}

static void a_block_below_the_least_size_is_refused_with_the_size_wanted(void **state) {
    tuile_config_t config = {.width = 240, .height = 320, .tile_height = 4};
    size_t wanted = 0;
    tuile_t *renderer;
    uint64_t block[2048];
    (void)state;
    assert_int_equal(tuile_init(&renderer, &config, block, 64, &wanted), TUILE_ERROR_MEMORY);
    assert_int_equal(wanted, TUILE_LEAST_BYTES((size_t)320, (size_t)240, (size_t)4, TUILE_RGB565_BE, (size_t)2, (size_t)255));
    assert_true(wanted <= sizeof block);
    assert_int_equal(tuile_init(&renderer, &config, block, wanted - 1, NULL), TUILE_ERROR_MEMORY);
    assert_int_equal(tuile_init(&renderer, &config, block, wanted, NULL), TUILE_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_orthographic_scenes_equal_the_exact_reference),
        cmocka_unit_test(random_perspective_scenes_equal_the_exact_reference),
        cmocka_unit_test(a_ground_plane_through_the_near_plane_reaches_the_horizon),
        cmocka_unit_test(random_triangles_across_the_near_plane_never_vanish),
        cmocka_unit_test(any_memory_and_any_tile_give_the_same_picture),
        cmocka_unit_test(tiles_may_be_drawn_in_any_order),
        cmocka_unit_test(two_renderers_share_a_frame_by_bands_or_by_alternate_tiles),
        cmocka_unit_test(a_block_below_the_least_size_is_refused_with_the_size_wanted),
    };
    return cmocka_run_group_tests_name("visibility", tests, NULL, NULL);
}
