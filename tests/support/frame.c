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

/* Bytes of a pixel in a picture: formats that pack pixels have one number of one or two bytes for each. */
static size_t pixel_bytes_of(uint8_t format) {
    switch (format) {
    case TUILE_FACE_IDS:
    case TUILE_XRGB8888: return 4;
    case TUILE_RGB666:
    case TUILE_BGR888: return 3;
    case TUILE_RGB332:
    case TUILE_GREY8:
    case TUILE_GREY4:
    case TUILE_MONO_PAGES:
    case TUILE_MONO_ROWS:
    case TUILE_MONO_PAGES_TURNED:
    case TUILE_GREY4_TURNED:
    case TUILE_RGB111:
    case TUILE_XRGB1111: return 1;
    default: return 2;
    }
}

static size_t tile_bytes_of(uint8_t format, size_t width, size_t height) {
    switch (format) {
    case TUILE_RGB444: return (width * height * 12 + 7) / 8;
    case TUILE_GREY4: return (width * 4 + 7) / 8 * height;
    case TUILE_MONO_PAGES: return width * ((height + 7) / 8);
    case TUILE_MONO_ROWS:
    case TUILE_MONO_PAGES_TURNED: return (width + 7) / 8 * height;
    case TUILE_GREY4_TURNED: return (height * 4 + 7) / 8 * width;
    case TUILE_RGB111: return (width * height + 1) / 2;
    case TUILE_XRGB1111: return (width * 4 + 7) / 8 * height;
    default: return width * height * pixel_bytes_of(format);
    }
}

/* Pixel (x, y) of a tile, as it stands in a picture. */
static void unpack(uint8_t *to, uint8_t format, const tuile_tile_t *tile, size_t x, size_t y) {
    const size_t width = tile->width, index = y * width + x;
    const uint8_t *bytes = tile->bytes;
    switch (format) {
    case TUILE_RGB444:
        to[0] = (uint8_t)(index % 2 ? bytes[index / 2 * 3 + 2] : bytes[index / 2 * 3] << 4 | bytes[index / 2 * 3 + 1] >> 4);
        to[1] = index % 2 ? bytes[index / 2 * 3 + 1] & 15 : bytes[index / 2 * 3] >> 4;
        break;
    case TUILE_XRGB1111:
    case TUILE_GREY4: to[0] = bytes[y * ((width + 1) / 2) + x / 2] >> (x % 2 ? 0 : 4) & 15; break;
    case TUILE_MONO_PAGES: to[0] = bytes[y / 8 * width + x] >> y % 8 & 1; break;
    case TUILE_MONO_ROWS: to[0] = bytes[y * ((width + 7) / 8) + x / 8] >> (7 - x % 8) & 1; break;
    case TUILE_MONO_PAGES_TURNED: to[0] = bytes[x / 8 * tile->height + y] >> x % 8 & 1; break;
    case TUILE_GREY4_TURNED: to[0] = bytes[x * ((tile->height + 1u) / 2) + y / 2] >> (y % 2 ? 0 : 4) & 15; break;
    case TUILE_RGB111: to[0] = bytes[index / 2] >> (index % 2 ? 0 : 3) & 7; break;
    default: memcpy(to, bytes + index * pixel_bytes_of(format), pixel_bytes_of(format)); break;
    }
}

void frame_paste(uint8_t *picture, const tuile_config_t *config, const tuile_tile_t *tile) {
    const size_t pixel = pixel_bytes_of(config->format);
    assert_int_equal(tile->size_bytes, tile_bytes_of(config->format, tile->width, tile->height));
    assert_in_range(tile->x + tile->width, 1, config->width);
    assert_in_range(tile->y + tile->height, 1, config->height);
    for (unsigned y = 0; y < tile->height; y++) {
        for (unsigned x = 0; x < tile->width; x++) {
            unpack(picture + pixel * ((size_t)(tile->y + y) * config->width + tile->x + x), config->format, tile, x, y);
        }
    }
}

size_t frame_bytes(const tuile_config_t *config) { return pixel_bytes_of(config->format) * config->width * config->height; }

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
