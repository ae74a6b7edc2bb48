/* Whole pictures by the public header alone, in blocks of memory that notice what is written beside them. */
#ifndef TESTS_SUPPORT_FRAME_H
#define TESTS_SUPPORT_FRAME_H

#include <stddef.h>
#include <stdint.h>

#include "../../raster/tuile.h"

/* A block of exactly size_bytes between two margins; under a sanitizer without them, so that it sees what goes beyond. */
typedef struct block {
    uint8_t *memory, *bytes;
    size_t size_bytes;
} block_t;

void block_open(block_t *block, size_t size_bytes);
/* Fails the test when a margin has changed. */
void block_close(block_t *block);

/* The least block for the configuration. */
size_t frame_least_bytes(const tuile_config_t *config);

/* Of the whole picture: a pixel's wire bytes, or, where pixels share bytes, 1 byte for GREY4 (0 ... 15), MONO (0, 1) and formats
 * with a bit of each colour (0 ... 7, red above), and 2 for RGB444, little-endian, 0x0rgb. */
size_t frame_bytes(const tuile_config_t *config);

/* A picture with nothing in it yet, to be released with free. */
uint8_t *frame_blank(const tuile_config_t *config);

/* Puts a tile in its place; fails the test when it reaches out of the picture. */
void frame_paste(uint8_t *picture, const tuile_config_t *config, const tuile_tile_t *tile);

/* The whole picture, to be released with free. stats may be NULL. */
uint8_t *frame_draw(const tuile_scene_t *scene, const tuile_config_t *config, size_t size_bytes, tuile_stats_t *stats);

/* The same as face ids, 0 = background. */
uint32_t *frame_draw_ids(const tuile_scene_t *scene, uint16_t width, uint16_t height);

#endif
