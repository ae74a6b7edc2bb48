/* Bresenham's line (S16), both ends drawn, cut to a tile without changing a pixel.
 *
 * The document walks along the longer axis (y when both are equal), `major` steps; an error term that begins at h = major / 2,
 * rounded down, grows by `minor` with each of them, and where it reaches `major` it is reduced by that and the walk steps aside.
 * After i steps along it has therefore made
 *     m(i) = floor((h + i * minor) / major)
 * steps aside, and the error term is the remainder of that division. So the walk may be entered at any pixel, and the pixels
 * inside a rectangle are those of one range of i: m(i) >= m from i = ceil((m * major - h) / minor) on.
 *
 * A line and its reverse differ where it passes halfway between two pixels: each rounds the way it walks.
 */
#ifndef TUILE_DRAW_LINE_H
#define TUILE_DRAW_LINE_H

#include "../fill/span.h"

/* |coordinate| at most, for lines and for triangles by edge tables: differences fit in 2^30, and an error term in 31 bits. */
#define LINE_RANGE ((int32_t)1 << 29)

typedef struct line {
    int32_t x, y;  /* the next pixel */
    int32_t count; /* pixels to come, this one included */
    int32_t cumul, major, minor;
    int8_t along_x, along_y, aside_x, aside_y;
} line_t;

/* The part of the line in the tile, in the order of its pixels. False when there is none; then line->count is 0. */
bool line_start(line_t *line, const int32_t from[2], const int32_t to[2], const raster_tile_t *tile);

/* On to the next pixel; line->count > 1. cumul + minor < 2^31. */
TUILE_INLINE void line_step(line_t *line) {
    line->count--;
    line->x += line->along_x;
    line->y += line->along_y;
    line->cumul += line->minor;
    if (line->cumul >= line->major) {
        line->cumul -= line->major;
        line->x += line->aside_x;
        line->y += line->aside_y;
    }
}

/* Draws it into the tile's colours, of pixel_bytes each (2 or 4); depth is neither read nor written, and may be NULL. */
void line_draw(const raster_tile_t *tile, const int32_t from[2], const int32_t to[2], uint32_t value, unsigned pixel_bytes);

#endif
