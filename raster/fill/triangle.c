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

#include "gradient.h"

#define SMALL_DEPTH (1 << 17)

TUILE_INLINE uint64_t shade_pack(int64_t depth, int64_t light) { return ((uint64_t)depth << 32) + (uint64_t)light; }

TUILE_INLINE bool depths_near(int32_t z1, int32_t z2) {
    return (uint32_t)(z1 + SMALL_DEPTH) < 2 * SMALL_DEPTH && (uint32_t)(z2 + SMALL_DEPTH) < 2 * SMALL_DEPTH;
}

/* v0 is a topmost vertex. */
TUILE_INLINE bool sides_short(const vertex_t *v0, const vertex_t *v1, const vertex_t *v2) {
    const int32_t x0 = v0->x, x1 = v1->x, x2 = v2->x;
    const int32_t least = x0 < x1 ? (x0 < x2 ? x0 : x2) : (x1 < x2 ? x1 : x2),
                  most = x0 > x1 ? (x0 > x2 ? x0 : x2) : (x1 > x2 ? x1 : x2);
    return most - least < SHORT_SIDE && (v1->y < v2->y ? v2->y : v1->y) - v0->y < SHORT_SIDE;
}

/* Sets one side from (x0, y0) to (x1, y1) at a row. */
TUILE_INLINE void side_start(triangle_t *triangle, bool left, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t row) {
    if (triangle->is_short) {
        *(left ? &triangle->side.brief.a : &triangle->side.brief.b) = short_edge_start(x0, y0, x1, y1, row);
    } else {
        edge_start(left ? &triangle->side.full.a : &triangle->side.full.b, x0, y0, x1, y1, row);
    }
}

/* The side that ends at the bend goes on below it. */
static TUILE_NOINLINE void bend(triangle_t *t) {
    side_start(t, t->bends_left, t->mid_x, t->mid_y, t->low_x, t->low_y, t->row_mid);
    t->row_mid = t->head.row_end;
}

/* Both sides from the top down, and what is needed at the bend. mid is not below low. */
TUILE_INLINE void sides_start(triangle_t *t, bool bends_left, int32_t x0, int32_t y0, const vertex_t *mid, const vertex_t *low,
                              int32_t row) {
    const int32_t row_mid = edge_row(mid->y), row_end = edge_row(low->y);
    t->bends_left = bends_left;
    t->row_mid = t->head.row_end = (int16_t)row_end;
    side_start(t, !bends_left, x0, y0, low->x, low->y, row);
    if (row >= row_mid) {
        side_start(t, bends_left, mid->x, mid->y, low->x, low->y, row);
        return;
    }
    side_start(t, bends_left, x0, y0, mid->x, mid->y, row);
    if (row_mid < row_end) {
        t->row_mid = (int16_t)row_mid;
        t->mid_x = mid->x;
        t->mid_y = mid->y;
        t->low_x = low->x;
        t->low_y = low->y;
    }
}

typedef struct gradients {
    gradient_t depth, light;
} gradients_t;

/* Of depth and light only those that are wanted. */
TUILE_INLINE gradients_t gradients_of(const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, bool is_short, bool tested,
                                      bool gouraud) {
    const int32_t x0 = v0->x, y0 = v0->y, x1 = v1->x - x0, y1 = v1->y - y0, x2 = v2->x - x0, y2 = v2->y - y0;
    const int32_t area = x2 * y1 - x1 * y2, reciprocal = INT32_MAX / area;
    const int32_t z0 = (int32_t)(v0->depth_light >> 8), light0 = (int32_t)(v0->depth_light & 0xff);
    const int32_t z1 = (int32_t)(v1->depth_light >> 8) - z0, z2 = (int32_t)(v2->depth_light >> 8) - z0;
    const bool small = is_short && depths_near(z1, z2);
    gradients_t g = {{0, 0}, {0, 0}};
    if (tested) {
        g.depth = small ? gradient_small(z1, z2, x1, y1, x2, y2, reciprocal, 12) : gradient_exact(z1, z2, x1, y1, x2, y2, area, 12);
    }
    if (gouraud) {
        const int32_t l1 = (int32_t)(v1->depth_light & 0xff) - light0, l2 = (int32_t)(v2->depth_light & 0xff) - light0;
        g.light = small ? gradient_small(l1, l2, x1, y1, x2, y2, reciprocal, 28) : gradient_exact(l1, l2, x1, y1, x2, y2, area, 28);
    }
    return g;
}

/* Depth and light at v0, with the rounding half, as the gradients count them. */
TUILE_INLINE int64_t depth_of(const vertex_t *v0) { return ((int64_t)(v0->depth_light >> 8) << 8) + 0x8000; }
TUILE_INLINE int64_t light_of(const vertex_t *v0) { return ((int64_t)(v0->depth_light & 0xff) << 24) + 0x800000; }

/* All but the sides. */
TUILE_INLINE void shade_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, int32_t row,
                              bool tested, bool gouraud) {
    const int32_t to_x = 8 - v0->x, to_y = 16 * row + 8 - v0->y;
    const gradients_t g = gradients_of(v0, v1, v2, triangle->is_short, tested, gouraud);
    uint64_t shade = 0, dx = 0, dy = 0;
    if (tested) {
        shade = shade_pack(depth_of(v0) + gradient_part(g.depth, to_x & 15, to_y & 15), 0);
        dx = shade_pack(g.depth.dx, 0), dy = shade_pack(g.depth.dy, 0);
    }
    if (gouraud) {
        shade += shade_pack(0, light_of(v0) + gradient_part(g.light, to_x & 15, to_y & 15));
        dx += shade_pack(0, g.light.dx);
        dy += shade_pack(0, g.light.dy);
    }
    triangle->shade = shade + dx * (uint64_t)(int64_t)(to_x >> 4) + dy * (uint64_t)(int64_t)(to_y >> 4);
    triangle->dx = dx;
    triangle->dy = dy;
}

TUILE_INLINE void start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, int32_t first_row,
                        bool tested, bool gouraud) {
    const int32_t x0 = v0->x, x1 = v1->x, x2 = v2->x, first = edge_row(v0->y), row = first > first_row ? first : first_row;
    const int32_t least = x0 < x1 ? (x0 < x2 ? x0 : x2) : (x1 < x2 ? x1 : x2),
                  most = x0 > x1 ? (x0 > x2 ? x0 : x2) : (x1 > x2 ? x1 : x2);
    const bool bends_left = v1->y < v2->y;

    triangle->row = (int16_t)row;
    triangle->head.left = (int16_t)edge_row(least);
    triangle->head.right = (int16_t)edge_row(most);
    triangle->is_short = most - least < SHORT_SIDE && (bends_left ? v2->y : v1->y) - v0->y < SHORT_SIDE;
    if (tested || gouraud) { shade_start(triangle, v0, v1, v2, row, tested, gouraud); }
    if (bends_left) {
        sides_start(triangle, true, x0, v0->y, v1, v2, row);
    } else {
        sides_start(triangle, false, x0, v0->y, v2, v1, row);
    }
}

TUILE_NOINLINE void triangle_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                                   int32_t first_row, bool gouraud) {
    start(triangle, v0, v1, v2, first_row, true, gouraud);
}

TUILE_NOINLINE void triangle_shade(const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, bool gouraud, uint64_t *shade,
                                   uint64_t *dx, uint64_t *dy) {
    triangle_t triangle;
    triangle.is_short = sides_short(v0, v1, v2);
    shade_start(&triangle, v0, v1, v2, 0, true, gouraud);
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
    const gradients_t g = gradients_of(v0, v1, v2, sides_short(v0, v1, v2), true, lights != NULL);
    plane->dx = g.depth.dx;
    plane->dy = g.depth.dy;
    plane->z = gradient_origin(g.depth, depth_of(v0), v0);
    plane->low = 0;
    plane->high = UINT32_MAX;
    if (lights) {
        lights->light = (uint32_t)gradient_origin(g.light, light_of(v0), v0);
        lights->dx = (uint32_t)g.light.dx;
        lights->dy = (uint32_t)g.light.dy;
    }
}

TUILE_NOINLINE void triangle_paint_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                                         int32_t first_row, bool gouraud) {
    start(triangle, v0, v1, v2, first_row, false, gouraud);
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
        if (row == t->row_mid) { bend(t); }
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
        if (t->row == t->row_mid && t->row < t->head.row_end) { bend(t); }
    }
}
