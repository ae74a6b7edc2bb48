#include "line.h"

/* Whole numbers low ... high; empty when low > high. 64 bits, in set-up only. */
typedef struct range {
    int64_t low, high;
} range_t;

/* Steps k >= 0 with low <= start + k * step < end, step being 1 or -1. */
static range_t steps_inside(int32_t start, int32_t step, int32_t low, int32_t end) {
    const int64_t to_low = (int64_t)low - start, to_last = (int64_t)end - 1 - start;
    range_t range = step > 0 ? (range_t){to_low, to_last} : (range_t){-to_last, -to_low};
    if (range.low < 0) { range.low = 0; }
    return range;
}

/* The first step along after which at least m > 0 aside have been made; minor > 0, m * major < 2^61. */
static int64_t first_with(const line_t *line, int64_t m) {
    return (m * line->major - line->major / 2 + line->minor - 1) / line->minor;
}

bool line_start(line_t *line, const int32_t from[2], const int32_t to[2], const raster_tile_t *tile) {
    const int32_t dx = to[0] - from[0], dy = to[1] - from[1];
    const int32_t width = dx < 0 ? -dx : dx, height = dy < 0 ? -dy : dy;
    const int8_t step_x = dx > 0 ? 1 : -1, step_y = dy > 0 ? 1 : -1;
    const bool flat = width > height;
    const range_t columns = steps_inside(from[0], step_x, tile->left, tile->right);
    const range_t rows = steps_inside(from[1], step_y, tile->top, tile->bottom);
    range_t along = flat ? columns : rows;
    const range_t aside = flat ? rows : columns;

    *line = (line_t){.major = flat ? width : height, .minor = flat ? height : width};
    if (flat) {
        line->along_x = step_x, line->aside_y = step_y;
    } else {
        line->along_y = step_y, line->aside_x = step_x;
    }
    if (aside.low > line->minor || aside.high < 0) { return false; }
    if (along.high > line->major) { along.high = line->major; }
    if (aside.low > 0 && line->minor > 0) {
        const int64_t first = first_with(line, aside.low);
        if (first > along.low) { along.low = first; }
    }
    if (aside.high < line->minor && line->minor > 0) {
        const int64_t last = first_with(line, aside.high + 1) - 1;
        if (last < along.high) { along.high = last; }
    }
    if (along.low > along.high) { return false; }

    const int32_t i = (int32_t)along.low;
    const int64_t sum = line->major / 2 + (int64_t)i * line->minor;
    const int32_t m = line->major ? (int32_t)(sum / line->major) : 0;
    line->cumul = (int32_t)(sum - (int64_t)m * line->major);
    line->x = from[0] + i * line->along_x + m * line->aside_x;
    line->y = from[1] + i * line->along_y + m * line->aside_y;
    line->count = (int32_t)(along.high - along.low + 1);
    return true;
}

void line_draw(const raster_tile_t *tile, const int32_t from[2], const int32_t to[2], uint32_t value, unsigned pixel_bytes) {
    line_t line;
    if (!line_start(&line, from, to, tile)) { return; }
    const int32_t along = line.along_x + line.along_y * tile->stride_px, aside = line.aside_x + line.aside_y * tile->stride_px;
    int32_t at = (line.y - tile->top) * tile->stride_px + line.x - tile->left;
    for (int32_t left = line.count;;) {
        if (pixel_bytes == 4) {
            ((uint32_t *)tile->colour)[at] = value;
        } else {
            ((uint16_t *)tile->colour)[at] = (uint16_t)value;
        }
        if (--left == 0) { return; }
        at += along;
        line.cumul += line.minor;
        if (line.cumul >= line.major) {
            line.cumul -= line.major;
            at += aside;
        }
    }
}
