/* Depth and light of a triangle are affine in the window. At any pixel of it
 *     value(x, row) = value at (0, first row) + x * d/dx + rows * d/dy        modulo 2^32, Q16.16,
 * so the result does not depend on the way by which a row is reached: tiles, passes and bands all see the same bits. The centre of
 * a covered pixel lies inside the triangle, so the true value lies between those of the corners, and the vertex stage keeps these away
 * from both ends of the range by more than the error below: the modulus never shows, not even for a sliver whose gradient
 * overflows 32 bits, since such a one is never two pixels wide.
 *
 * Gradients. With area twice the area in (1/16 px)^2, d/dx = num / area, where num is a 2x2 determinant.
 *   Large: the exact quotient, floored: error below 2^-16 a pixel, over 2 * 2048 pixels 1/16 step.
 *   Small (sides below 32 pixels, depth below 512 steps apart): num * (2^31 / area) / 2^31. The reciprocal is off by less than 1, so
 *   the gradient by |num| / 2^31 per 1/16 px: |num| < 2^27 gives 2^-8 step a pixel, over 2 * 32 pixels 1/4 step; light, |num| < 2^18,
 *   2^-9 level a pixel, 1/8 level.
 * With the rounding to nearest the depth is within 1/2 + 1/4 + 2^-15 step of the exact plane through the snapped vertices.
 */
#include "triangle.h"

#define SMALL_SIDE 512
#define SMALL_DEPTH (1 << 17)

typedef struct gradient {
    int64_t dx, dy; /* Q.16 per pixel */
} gradient_t;

/* c1, c2: the values at v1 and v2 less the one at v0; unit_bits: log2 of (Q.16 of a value unit) * 16 px. */
TUILE_INLINE gradient_t gradient_exact(int32_t c1, int32_t c2, int32_t x1, int32_t y1, int32_t x2, int32_t y2, int32_t area,
                                       unsigned unit_bits) {
    const int64_t nx = (int64_t)c2 * y1 - (int64_t)c1 * y2, ny = (int64_t)c1 * x2 - (int64_t)c2 * x1; /* < 2^40 */
    return (gradient_t){fixed_floor_div64(fixed_shift_left64(nx, unit_bits), area),
                        fixed_floor_div64(fixed_shift_left64(ny, unit_bits), area)};
}

TUILE_INLINE gradient_t gradient_small(int32_t c1, int32_t c2, int32_t x1, int32_t y1, int32_t x2, int32_t y2, int32_t reciprocal,
                                       unsigned unit_bits) {
    return (gradient_t){((int64_t)(c2 * y1 - c1 * y2) * reciprocal) >> (31 - unit_bits),
                        ((int64_t)(c1 * x2 - c2 * x1) * reciprocal) >> (31 - unit_bits)};
}

/* value: Q.16; to_x, to_y: from v0 to the wanted point, 1/16 px. */
TUILE_INLINE uint32_t value_at(uint32_t value, gradient_t g, int32_t to_x, int32_t to_y) {
    const uint64_t offset = (uint64_t)g.dx * (uint64_t)(int64_t)to_x + (uint64_t)g.dy * (uint64_t)(int64_t)to_y;
    return value + (uint32_t)(offset >> 4); /* bits 4 ... 35: what overflows 64 bits does not reach them */
}

TUILE_NOINLINE void triangle_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, int32_t area,
                                   int32_t first_row, bool gouraud) {
    const int32_t x0 = v0->x, y0 = v0->y, x1 = v1->x - x0, y1 = v1->y - y0, x2 = v2->x - x0, y2 = v2->y - y0;
    const int32_t row1 = edge_row(v1->y), row2 = edge_row(v2->y);
    int32_t row = edge_row(y0);
    if (row < first_row) { row = first_row; }

    /* Sides. */
    triangle->row = (int16_t)row;
    if (y1 < y2) {
        triangle->bends_left = true;
        triangle->row_mid = (int16_t)row1;
        triangle->row_end = (int16_t)row2;
        triangle->mid = *v1;
        triangle->low = *v2;
        edge_start(&triangle->b, x0, y0, v2->x, v2->y, row);
        if (row < row1) {
            edge_start(&triangle->a, x0, y0, v1->x, v1->y, row);
        } else {
            edge_start(&triangle->a, v1->x, v1->y, v2->x, v2->y, row);
        }
    } else {
        triangle->bends_left = false;
        triangle->row_mid = (int16_t)row2;
        triangle->row_end = (int16_t)row1;
        triangle->mid = *v2;
        triangle->low = *v1;
        edge_start(&triangle->a, x0, y0, v1->x, v1->y, row);
        if (row < row2) {
            edge_start(&triangle->b, x0, y0, v2->x, v2->y, row);
        } else {
            edge_start(&triangle->b, v2->x, v2->y, v1->x, v1->y, row);
        }
    }
    if (row >= triangle->row_mid) { triangle->row_mid = triangle->row_end; }
    const int32_t least = x1 < x2 ? (x1 < 0 ? x1 : 0) : (x2 < 0 ? x2 : 0), most = x1 > x2 ? (x1 > 0 ? x1 : 0) : (x2 > 0 ? x2 : 0);
    triangle->left = (int16_t)edge_row(x0 + least);
    triangle->right = (int16_t)edge_row(x0 + most);

    /* Gradients. */
    const uint32_t depth0 = v0->depth_light >> 8, light0 = v0->depth_light & 0xff;
    const int32_t z1 = (int32_t)(v1->depth_light >> 8) - (int32_t)depth0, z2 = (int32_t)(v2->depth_light >> 8) - (int32_t)depth0;
    const int32_t l1 = (int32_t)(v1->depth_light & 0xff) - (int32_t)light0, l2 = (int32_t)(v2->depth_light & 0xff) - (int32_t)light0;
    const int32_t to_x = 8 - x0, to_y = 16 * row + 8 - y0;
    const bool small = most - least < SMALL_SIDE && (y1 > y2 ? y1 : y2) < SMALL_SIDE &&
                       (uint32_t)(z1 + SMALL_DEPTH) < 2 * SMALL_DEPTH && (uint32_t)(z2 + SMALL_DEPTH) < 2 * SMALL_DEPTH;
    const int32_t reciprocal = INT32_MAX / area;
    gradient_t g = small ? gradient_small(z1, z2, x1, y1, x2, y2, reciprocal, 12) : gradient_exact(z1, z2, x1, y1, x2, y2, area, 12);
    triangle->z = value_at((depth0 << 8) + 0x8000u, g, to_x, to_y);
    triangle->dzdx = (uint32_t)g.dx;
    triangle->dzdy = (uint32_t)g.dy;
    if (gouraud) {
        g = small ? gradient_small(l1, l2, x1, y1, x2, y2, reciprocal, 20) : gradient_exact(l1, l2, x1, y1, x2, y2, area, 20);
        triangle->light = value_at((light0 << 16) + 0x8000u, g, to_x, to_y);
        triangle->dldx = (uint32_t)g.dx;
        triangle->dldy = (uint32_t)g.dy;
    } else {
        triangle->light = triangle->dldx = triangle->dldy = 0;
    }
}

/* The side that ends at the bend goes on below it. */
static TUILE_NOINLINE void bend(triangle_t *t) {
    edge_start(t->bends_left ? &t->a : &t->b, t->mid.x, t->mid.y, t->low.x, t->low.y, t->row_mid);
    t->row_mid = t->row_end;
}

/* kind and last are constants where this is called, so that each gets a loop of its own. */
TUILE_INLINE void fill_rows(triangle_t *t, const raster_tile_t *tile, span_kind_t kind, bool last, const uint16_t *ramp) {
    const int32_t end = t->row_end < tile->bottom ? t->row_end : tile->bottom;
    int32_t row = t->row;
    size_t line = (size_t)(row - tile->top) * (size_t)tile->stride_px;
    uint32_t z = t->z, light = t->light;
    const uint32_t dzdx = t->dzdx, dzdy = t->dzdy, dldx = t->dldx, dldy = t->dldy;

    while (row < end) {
        const int32_t until = t->row_mid < end ? t->row_mid : end;
        edge_t a = t->a, b = t->b;
        for (; row < until; row++) {
            const int32_t from = a.x > tile->left ? a.x : tile->left, to = b.x < tile->right ? b.x : tile->right;
            if (from < to) {
                const size_t at = line + (size_t)(from - tile->left);
                const uint32_t span_z = z + dzdx * (uint32_t)from;
                if (kind == SPAN_GOURAUD) {
                    span_gouraud(tile->depth + at, (uint16_t *)tile->colour + at, to - from, span_z, dzdx,
                                 light + dldx * (uint32_t)from, dldx, ramp, last);
                } else if (kind == SPAN_FLAT) {
                    span_flat(tile->depth + at, (uint16_t *)tile->colour + at, to - from, span_z, dzdx, (uint16_t)t->value, last);
                } else {
                    span_ids(tile->depth + at, (uint32_t *)tile->colour + at, to - from, span_z, dzdx, t->value, last);
                }
            }
            edge_step(&a);
            edge_step(&b);
            z += dzdy;
            if (kind == SPAN_GOURAUD) { light += dldy; }
            line += (size_t)tile->stride_px;
        }
        t->a = a;
        t->b = b;
        if (row == t->row_mid && row < t->row_end) { bend(t); }
    }
    t->row = (int16_t)row;
    t->z = z;
    t->light = light;
}

TUILE_NOINLINE void triangle_fill(triangle_t *triangle, const raster_tile_t *tile, span_kind_t kind, bool last, const uint16_t *ramp) {
    switch ((unsigned)kind * 2 + last) {
    case SPAN_FLAT * 2: fill_rows(triangle, tile, SPAN_FLAT, false, NULL); break;
    case SPAN_FLAT * 2 + 1: fill_rows(triangle, tile, SPAN_FLAT, true, NULL); break;
    case SPAN_GOURAUD * 2: fill_rows(triangle, tile, SPAN_GOURAUD, false, ramp); break;
    case SPAN_GOURAUD * 2 + 1: fill_rows(triangle, tile, SPAN_GOURAUD, true, ramp); break;
    case SPAN_IDS * 2: fill_rows(triangle, tile, SPAN_IDS, false, NULL); break;
    default: fill_rows(triangle, tile, SPAN_IDS, true, NULL); break;
    }
}

void triangle_skip(triangle_t *t, int32_t target) {
    if (target > t->row_end) { target = t->row_end; }
    while (t->row < target) {
        const int32_t until = t->row_mid < target ? t->row_mid : target;
        for (; t->row < until; t->row++) {
            edge_step(&t->a);
            edge_step(&t->b);
            t->z += t->dzdy;
            t->light += t->dldy;
        }
        if (t->row == t->row_mid && t->row < t->row_end) { bend(t); }
    }
}
