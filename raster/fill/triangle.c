/* Depth and light of a triangle are affine in the window. Both go in one 64-bit number, depth as Q16.16 above and light as Q8.24
 * below, so that one addition steps both. At any pixel of the triangle shade(x, row) = shade at (0, first row) + x * d/dx + rows *
 * d/dy        modulo 2^64, so the result does not depend on the way by which a row is reached: tiles, passes and bands all see the
 * same bits. The centre of a covered pixel lies inside the triangle, so the true values lie between those of the corners, and the
 * vertex stage keeps these away from both ends of the range by more than the error below: neither does the modulus show, nor does
 * light reach into depth, not even for a sliver whose gradient overflows its half, since such a one is never two pixels wide.
 *
 * Gradients. With area twice the area in (1/16 px)^2, d/dx = num / area, where num is a 2x2 determinant.
 *   Large: the exact quotient, floored: error below 2^-16 a pixel, over 2 * 2048 pixels 1/16 step.
 *   Small (sides short, below 32 pixels, depth below 512 steps apart): num * (2^31 / area) / 2^31. The reciprocal is off by less
 * than 1, so the gradient by |num| / 2^31 per 1/16 px: |num| < 2^27 gives 2^-8 step a pixel, over 2 * 32 pixels 1/4 step; light,
 * |num| < 2^18, 2^-9 level a pixel, 1/8 level. With the rounding to nearest the depth is within 1/2 + 1/4 + 2^-15 step of the exact
 * plane through the snapped vertices.
 */
#include "../tune.h"

#include "triangle.h"

#include "triangle_set_up.h"

TUILE_NOINLINE void triangle_bend(triangle_t *t) {
    side_start(t, t->bends_left, t->mid_x, t->mid_y, t->low_x, t->low_y, t->row_mid);
    t->row_mid = t->head.row_end;
}

TUILE_NOINLINE void triangle_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                                   int32_t first_row, bool gouraud) {
    triangle_set_up(triangle, v0, v1, v2, first_row, true, gouraud);
}

TUILE_NOINLINE void triangle_shade(const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, bool gouraud, uint64_t *shade,
                                   uint64_t *dx, uint64_t *dy) {
    triangle_t triangle;
    triangle.is_short = triangle_sides_short(v0, v1, v2);
    triangle_shade_start(&triangle, v0, v1, v2, 0, true, gouraud);
    *shade = triangle.shade;
    *dx = triangle.dx;
    *dy = triangle.dy;
}

/* A value at the centre of pixel (0, 0), modulo 2^64: c0 is the value at v0, Q.16 with the rounding half. */
TUILE_INLINE int64_t gradient_origin(gradient_t g, int64_t c0, const vertex_t *v0) {
    const int32_t to_x = 8 - v0->x, to_y = 8 - v0->y;
    return (int64_t)((uint64_t)c0 + (uint64_t)gradient_part(g, to_x & 15, to_y & 15) + (uint64_t)g.dx * (uint64_t)(to_x >> 4) +
                     (uint64_t)g.dy * (uint64_t)(to_y >> 4));
}

void triangle_planes(const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, depth_plane_t *plane, light_plane_t *lights) {
    const triangle_gradients_t g = triangle_gradients_of(v0, v1, v2, triangle_sides_short(v0, v1, v2), true, lights != NULL);
    plane->dx = g.depth.dx;
    plane->dy = g.depth.dy;
    plane->z = gradient_origin(g.depth, triangle_depth_of(v0), v0);
    plane->low = 0;
    plane->high = UINT32_MAX;
    if (lights) {
        lights->light = (uint32_t)gradient_origin(g.light, triangle_light_of(v0), v0);
        lights->dx = (uint32_t)g.light.dx;
        lights->dy = (uint32_t)g.light.dy;
    }
}

TUILE_NOINLINE void triangle_paint_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                                         int32_t first_row, bool gouraud) {
    triangle_set_up(triangle, v0, v1, v2, first_row, false, gouraud);
}

/* tested, kind, last, clamp and is_short are constants where this is called, so that each combination gets a loop of its own. `at`
 * is the index of the tile's pixel for x = 0 of the window, which may be negative. */
TUILE_INLINE void fill_rows(triangle_t *t, const raster_tile_t *tile, bool tested, bool is_short, bool clamp, span_kind_t kind,
                            bool last, const uint16_t *ramp) {
    const int32_t end = t->head.row_end < tile->bottom ? t->head.row_end : tile->bottom;
    const int32_t stride = tile->stride_px, tile_left = tile->left, tile_right = tile->right;
    const uint64_t dx = t->dx, dy = t->dy;
    int32_t row = t->row, at = (row - tile->top) * stride - tile_left;
    uint64_t shade = t->shade;

    for (;;) {
        int32_t rows = (t->row_mid < end ? t->row_mid : end) - row;
        /* One or the other: where sides are short the state ends behind `brief`, and may do so at the end of the block. */
        short_edge_t sa = {0}, sb = {0};
        edge_t fa = {0}, fb = {0};
        if (is_short) {
            sa = t->side.brief.a;
            sb = t->side.brief.b;
        } else {
            fa = t->side.full.a;
            fb = t->side.full.b;
        }
        row += rows;
        do {
            int32_t from = is_short ? short_edge_pixel(sa.x) : fa.x, to = is_short ? short_edge_pixel(sb.x) : fb.x;
            if (clamp) {
                from = from > tile_left ? from : tile_left;
                to = to < tile_right ? to : tile_right;
            }
            to -= from;
            if (to > 0 && !tested) {
                if (kind == SPAN_GOURAUD) {
                    paint_gouraud((uint16_t *)tile->colour + (at + from), to, (uint32_t)shade + (uint32_t)dx * (uint32_t)from,
                                  (uint32_t)dx, ramp);
                } else if (kind == SPAN_FLAT) {
                    paint_flat((uint16_t *)tile->colour + (at + from), to, (uint16_t)t->value);
                } else {
                    paint_ids((uint32_t *)tile->colour + (at + from), to, t->value);
                }
            } else if (to > 0) {
                uint16_t *depth = tile->depth + (at + from);
                if (kind == SPAN_GOURAUD) {
                    span_gouraud(depth, (uint16_t *)tile->colour + (at + from), to, shade + dx * (uint64_t)(int64_t)from, dx, ramp,
                                 last);
                } else {
                    const uint32_t z = (uint32_t)(shade >> 32) + (uint32_t)(dx >> 32) * (uint32_t)from;
                    if (kind == SPAN_FLAT) {
                        span_flat(depth, (uint16_t *)tile->colour + (at + from), to, z, (uint32_t)(dx >> 32), (uint16_t)t->value,
                                  last);
                    } else {
                        span_ids(depth, (uint32_t *)tile->colour + (at + from), to, z, (uint32_t)(dx >> 32), t->value, last);
                    }
                }
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

TUILE_NOINLINE void triangle_fill_gouraud(triangle_t *t, const raster_tile_t *tile, const uint16_t *ramp) {
    fill_rows(t, tile, true, true, false, SPAN_GOURAUD, false, ramp);
}

TUILE_NOINLINE void triangle_fill_flat(triangle_t *t, const raster_tile_t *tile) {
    fill_rows(t, tile, true, true, false, SPAN_FLAT, false, NULL);
}

TUILE_NOINLINE void triangle_paint_gouraud(triangle_t *t, const raster_tile_t *tile, const uint16_t *ramp) {
    fill_rows(t, tile, false, true, false, SPAN_GOURAUD, false, ramp);
}

TUILE_NOINLINE void triangle_paint_flat(triangle_t *t, const raster_tile_t *tile) {
    fill_rows(t, tile, false, true, false, SPAN_FLAT, false, NULL);
}

TUILE_INLINE void fill_any(triangle_t *t, const raster_tile_t *tile, bool tested, span_kind_t kind, bool last,
                           const uint16_t *ramp) {
    if (kind == SPAN_GOURAUD) {
        t->is_short ? fill_rows(t, tile, tested, true, true, SPAN_GOURAUD, last, ramp)
                    : fill_rows(t, tile, tested, false, true, SPAN_GOURAUD, last, ramp);
    } else if (kind == SPAN_FLAT) {
        t->is_short ? fill_rows(t, tile, tested, true, true, SPAN_FLAT, last, NULL)
                    : fill_rows(t, tile, tested, false, true, SPAN_FLAT, last, NULL);
    } else {
        t->is_short ? fill_rows(t, tile, tested, true, true, SPAN_IDS, last, NULL)
                    : fill_rows(t, tile, tested, false, true, SPAN_IDS, last, NULL);
    }
}

TUILE_NOINLINE void triangle_fill_any(triangle_t *t, const raster_tile_t *tile, span_kind_t kind, bool last, const uint16_t *ramp) {
    fill_any(t, tile, true, kind, last, ramp);
}

TUILE_NOINLINE void triangle_paint_any(triangle_t *t, const raster_tile_t *tile, span_kind_t kind, const uint16_t *ramp) {
    fill_any(t, tile, false, kind, false, ramp);
}

void triangle_skip(triangle_t *t, int32_t target) {
    if (target > t->head.row_end) { target = t->head.row_end; }
    while (t->row < target) {
        const int32_t until = t->row_mid < target ? t->row_mid : target;
        for (; t->row < until; t->row++) {
            if (t->is_short) {
                t->side.brief.a.x = (int32_t)((uint32_t)t->side.brief.a.x + (uint32_t)t->side.brief.a.slope);
                t->side.brief.b.x = (int32_t)((uint32_t)t->side.brief.b.x + (uint32_t)t->side.brief.b.slope);
            } else {
                edge_step(&t->side.full.a);
                edge_step(&t->side.full.b);
            }
            t->shade += t->dy;
        }
        if (t->row == t->row_mid && t->row < t->head.row_end) { triangle_bend(t); }
    }
}
