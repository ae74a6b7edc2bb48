/* Setting a triangle up, in line: fill/triangle.c has the bounds. */
#ifndef TUILE_FILL_TRIANGLE_SET_UP_H
#define TUILE_FILL_TRIANGLE_SET_UP_H

#include "gradient.h"
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
void triangle_bend(triangle_t *t);

#define TRIANGLE_SMALL_DEPTH (INT32_C(1) << 17)

TUILE_INLINE uint64_t triangle_shade_pack(int64_t depth, int64_t light) { return ((uint64_t)depth << 32) + (uint64_t)light; }

TUILE_INLINE bool triangle_depths_near(int32_t z1, int32_t z2) {
    return ((uint32_t)(z1 + TRIANGLE_SMALL_DEPTH) | (uint32_t)(z2 + TRIANGLE_SMALL_DEPTH)) < 2 * TRIANGLE_SMALL_DEPTH; /* 2^18 */
}

/* Both sides from the top down, and what is needed at the bend. mid is not below low. */
TUILE_INLINE void triangle_sides_start(triangle_t *t, bool bends_left, int32_t x0, int32_t y0, const vertex_t *mid,
                                       const vertex_t *low, int32_t row) {
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

typedef struct triangle_gradients {
    gradient_t depth, light;
} triangle_gradients_t;

/* Of depth and light only those that are wanted. */
TUILE_INLINE triangle_gradients_t triangle_gradients_of(const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, bool is_short,
                                                        bool tested, bool gouraud) {
    const int32_t x0 = v0->x, y0 = v0->y, x1 = v1->x - x0, y1 = v1->y - y0, x2 = v2->x - x0, y2 = v2->y - y0;
    const int32_t area = x2 * y1 - x1 * y2, reciprocal = INT32_MAX / area;
    const int32_t z0 = (int32_t)(v0->depth_light >> 8), light0 = (int32_t)(v0->depth_light & 0xff);
    const int32_t z1 = (int32_t)(v1->depth_light >> 8) - z0, z2 = (int32_t)(v2->depth_light >> 8) - z0;
    const bool small = is_short && triangle_depths_near(z1, z2);
    triangle_gradients_t g = {{0, 0}, {0, 0}};
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
TUILE_INLINE int64_t triangle_depth_of(const vertex_t *v0) { return ((int64_t)(v0->depth_light >> 8) << 8) + 0x8000; }
TUILE_INLINE int64_t triangle_light_of(const vertex_t *v0) { return ((int64_t)(v0->depth_light & 0xff) << 24) + 0x800000; }

/* All but the sides. */
TUILE_INLINE void triangle_shade_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                                       int32_t row, bool tested, bool gouraud) {
    const int32_t to_x = 8 - v0->x, to_y = 16 * row + 8 - v0->y;
    const triangle_gradients_t g = triangle_gradients_of(v0, v1, v2, triangle->is_short, tested, gouraud);
    uint64_t shade = 0, dx = 0, dy = 0;
    if (tested) {
        shade = triangle_shade_pack(triangle_depth_of(v0) + gradient_part(g.depth, to_x & 15, to_y & 15), 0);
        dx = triangle_shade_pack(g.depth.dx, 0), dy = triangle_shade_pack(g.depth.dy, 0);
    }
    if (gouraud) {
        shade += triangle_shade_pack(0, triangle_light_of(v0) + gradient_part(g.light, to_x & 15, to_y & 15));
        dx += triangle_shade_pack(0, g.light.dx);
        dy += triangle_shade_pack(0, g.light.dy);
    }
    triangle->shade = shade + dx * (uint64_t)(int64_t)(to_x >> 4) + dy * (uint64_t)(int64_t)(to_y >> 4);
    triangle->dx = dx;
    triangle->dy = dy;
}

TUILE_INLINE void triangle_set_up(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                                  int32_t first_row, bool tested, bool gouraud) {
    const int32_t x0 = v0->x, x1 = v1->x, x2 = v2->x, first = edge_row(v0->y), row = first > first_row ? first : first_row;
    const int32_t least = x0 < x1 ? (x0 < x2 ? x0 : x2) : (x1 < x2 ? x1 : x2),
                  most = x0 > x1 ? (x0 > x2 ? x0 : x2) : (x1 > x2 ? x1 : x2);
    const bool bends_left = v1->y < v2->y;

    triangle->row = (int16_t)row;
    triangle->head.left = (int16_t)edge_row(least);
    triangle->head.right = (int16_t)edge_row(most);
    triangle->is_short = most - least < SHORT_SIDE && (bends_left ? v2->y : v1->y) - v0->y < SHORT_SIDE;
    if (tested || gouraud) { triangle_shade_start(triangle, v0, v1, v2, row, tested, gouraud); }
    if (bends_left) {
        triangle_sides_start(triangle, true, x0, v0->y, v1, v2, row);
    } else {
        triangle_sides_start(triangle, false, x0, v0->y, v2, v1, row);
    }
}

#endif
