#include "frame.h"

#include "check.h"

#define CANARY 0xa5
#define MARGIN_BYTES 64u

void block_open(block_t *block, size_t size_bytes) {
    const size_t margin = CHECK_SANITIZED ? 0 : MARGIN_BYTES;
    block->memory = malloc(size_bytes + 2 * margin);
    assert_non_null(block->memory);
    memset(block->memory, CANARY, size_bytes + 2 * margin);
    block->bytes = block->memory + margin;
    block->size_bytes = size_bytes;
}

void block_close(block_t *block) {
    for (size_t i = 0; !CHECK_SANITIZED && i < MARGIN_BYTES; i++) {
        assert_int_equal(block->memory[i], CANARY);
        assert_int_equal(block->bytes[block->size_bytes + i], CANARY);
    }
    free(block->memory);
}

void frame_paste(uint8_t *picture, const tuile_config_t *config, const tuile_tile_t *tile) {
    const size_t pixel = TUILE_WIRE_BYTES(config->format, 1u, 1u);
    assert_int_equal(tile->size_bytes, pixel * tile->width * tile->height);
    assert_in_range(tile->x + tile->width, 1, config->width);
    assert_in_range(tile->y + tile->height, 1, config->height);
    for (unsigned y = 0; y < tile->height; y++) {
        memcpy(picture + pixel * ((size_t)(tile->y + y) * config->width + tile->x), tile->bytes + pixel * y * tile->width,
               pixel * tile->width);
    }
}

size_t frame_bytes(const tuile_config_t *config) {
    return (size_t)TUILE_WIRE_BYTES(config->format, 1u, 1u) * config->width * config->height;
}

uint8_t *frame_blank(const tuile_config_t *config) {
    uint8_t *picture = malloc(frame_bytes(config));
    assert_non_null(picture);
    memset(picture, 0x5a, frame_bytes(config));
    return picture;
}

size_t frame_least_bytes(const tuile_config_t *config) {
    tuile_t *renderer;
    size_t wanted = 0;
    assert_int_equal(tuile_init(&renderer, config, NULL, 0, &wanted), TUILE_ERROR_MEMORY);
    return wanted;
}

uint8_t *frame_draw(const tuile_scene_t *scene, const tuile_config_t *config, size_t size_bytes, tuile_stats_t *stats) {
    block_t block;
    tuile_t *renderer;
    tuile_tile_t tile;
    uint8_t *picture = frame_blank(config);
    int result;
    block_open(&block, size_bytes);
    assert_int_equal(tuile_init(&renderer, config, block.bytes, size_bytes, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, scene), TUILE_OK);
    while ((result = tuile_next(renderer, &tile)) == 1) {
        frame_paste(picture, config, &tile);
    }
    assert_int_equal(result, 0);
    assert_int_equal(tuile_end(renderer, stats), TUILE_OK);
    block_close(&block);
    return picture;
}

uint32_t *frame_draw_ids(const tuile_scene_t *scene, uint16_t width, uint16_t height) {
    const tuile_config_t config = {.width = width, .height = height, .format = TUILE_FACE_IDS, .corners = 255};
    return (uint32_t *)(void *)frame_draw(scene, &config, 1 << 20, NULL);
}
