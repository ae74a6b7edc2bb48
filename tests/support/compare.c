#include "compare.h"

#include "check.h"
#include "frame.h"

#define PLENTY_BYTES ((size_t)4 << 20)

void compare_expected(const tuile_scene_t *scene, const tuile_config_t *config, uint8_t *expected[2]) {
    for (unsigned i = 0; i < 2; i++) {
        tuile_config_t c = *config;
        c.method = i == 0 ? TUILE_ZBUFFER : TUILE_TREE;
        expected[i] = frame_draw(scene, &c, PLENTY_BYTES, NULL);
    }
}

static void compare_tiles(const tuile_scene_t *scene, const tuile_config_t *config, uint8_t *const expected[2], const char *name) {
    static const uint16_t tiles[][2] = {{0, 0}, {32, 32}, {40, 7}};
    for (unsigned k = 0; k < CHECK_COUNT(tiles) * (TUILE_TREE + 1); k++) {
        tuile_config_t c = *config;
        c.method = (uint8_t)(k % (TUILE_TREE + 1));
        c.tile_width = tiles[k / (TUILE_TREE + 1)][0];
        c.tile_height = tiles[k / (TUILE_TREE + 1)][1];
        uint8_t *picture = frame_draw(scene, &c, PLENTY_BYTES, NULL);
        if (memcmp(picture, expected[c.method == TUILE_TREE], frame_bytes(&c)) != 0) {
            fail_msg("%s: shade %u, method %u, tiles %u: another picture", name, c.shade, c.method, k / (TUILE_TREE + 1));
        }
        free(picture);
    }
}

static void compare_memory(const tuile_scene_t *scene, const tuile_config_t *config, uint8_t *const expected[2], size_t more_bytes,
                           const char *name) {
    for (unsigned k = 0; k < 24; k++) {
        tuile_config_t c = *config;
        c.method = k % 2 ? TUILE_TREE : TUILE_ZBUFFER;
        const size_t size = frame_least_bytes(&c) + more_bytes + (k / 2) * (k / 2) * 128;
        uint8_t *picture = frame_draw(scene, &c, size, NULL);
        if (memcmp(picture, expected[k % 2], frame_bytes(&c)) != 0) {
            fail_msg("%s: shade %u, method %u, %zu bytes: another picture", name, c.shade, c.method, size);
        }
        free(picture);
    }
}

void compare_all_ways(const tuile_scene_t *scene, const tuile_config_t *config, uint8_t *const expected[2], size_t more_bytes,
                      const char *name) {
    compare_tiles(scene, config, expected, name);
    compare_memory(scene, config, expected, more_bytes, name);
}
