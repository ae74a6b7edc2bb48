/* Walking a triangle's rows: both sides by their steppers, the bend, and what is carried to the next tile. */
#ifndef TUILE_FILL_TRIANGLE_ROWS_H
#define TUILE_FILL_TRIANGLE_ROWS_H

#include "triangle.h"

/* Sets one side from (x0, y0) to (x1, y1) at a row. */
TUILE_INLINE void side_start(triangle_t *triangle, bool left, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t row) {
    if (triangle->is_short) {
        *(left ? &triangle->side.brief.a : &triangle->side.brief.b) = short_edge_start(x0, y0, x1, y1, row);
    } else {
        edge_start(left ? &triangle->side.full.a : &triangle->side.full.b, x0, y0, x1, y1, row);
    }
}

/* The side that ends at the bend goes on below it. */
static TUILE_NOINLINE void triangle_bend(triangle_t *t) {
    side_start(t, t->bends_left, t->mid_x, t->mid_y, t->low_x, t->low_y, t->row_mid);
    t->row_mid = t->head.row_end;
}

/* Pixels from ... from + count - 1 of a row of the window, the first of them at index `at` of the tile. */
typedef struct triangle_span {
    int32_t row, from, count, at;
    uint64_t shade; /* at pixel 0 of the row */
} triangle_span_t;

typedef void (*triangle_span_fn)(const triangle_t *t, const raster_tile_t *tile, const triangle_span_t *span, const void *context);

/* is_short, clamp and span are constants where this is called, so that each combination gets a loop of its own. `at` is the index
 * of the tile's pixel for x = 0 of the window, which may be negative. */
TUILE_INLINE void triangle_rows(triangle_t *t, const raster_tile_t *tile, bool is_short, bool clamp, triangle_span_fn span,
                                const void *context) {
    const int32_t end = t->head.row_end < tile->bottom ? t->head.row_end : tile->bottom;
    const int32_t stride = tile->stride_px, tile_left = tile->left, tile_right = tile->right;
    const uint64_t dy = t->dy;
    int32_t row = t->row, at = (row - tile->top) * stride - tile_left;
    uint64_t shade = t->shade;

    for (;;) {
        int32_t rows = (t->row_mid < end ? t->row_mid : end) - row;
        short_edge_t sa = t->side.brief.a, sb = t->side.brief.b;
        edge_t fa = t->side.full.a, fb = t->side.full.b;
        row += rows;
        do {
            int32_t from = is_short ? short_edge_pixel(sa.x) : fa.x, to = is_short ? short_edge_pixel(sb.x) : fb.x;
            if (clamp) {
                from = from > tile_left ? from : tile_left;
                to = to < tile_right ? to : tile_right;
            }
            to -= from;
            if (to > 0) {
                const triangle_span_t pixels = {row - rows, from, to, at + from, shade};
                span(t, tile, &pixels, context);
            }
            if (is_short) {
                sa.x = (int32_t)((uint32_t)sa.x + (uint32_t)sa.slope); /* may wrap behind the last row */
                sb.x = (int32_t)((uint32_t)sb.x + (uint32_t)sb.slope);
            } else {
                edge_step(&fa);
                edge_step(&fb);
            }
            shade += dy;
            at += stride;
        } while (--rows);
        if (row >= t->head.row_end) { break; }
        if (is_short) {
            t->side.brief.a = sa;
            t->side.brief.b = sb;
        } else {
            t->side.full.a = fa;
            t->side.full.b = fb;
        }
        if (row == t->row_mid) { triangle_bend(t); }
        if (row >= end) { break; }
    }
    t->row = (int16_t)row;
    t->shade = shade;
}

#endif
