/* Triangles: set up once, then filled row by row through as many tiles as they reach. */
#ifndef TUILE_FILL_TRIANGLE_H
#define TUILE_FILL_TRIANGLE_H

#include "../geometry/vertex.h"
#include "edge.h"
#include "span.h"

typedef struct triangle {
    fill_head_t head;
    int16_t row, row_mid;   /* next row to fill; row where the short side bends */
    bool bends_left;        /* the short side is the left one */
    bool is_short;          /* all sides are: edge.h */
    uint64_t shade, dx, dy; /* depth and light at the centre of pixel (0, row), and per pixel right and down: triangle.c */
    uint32_t value;         /* flat: colour; ids: id; gouraud: material */
    int16_t mid_x, mid_y, low_x, low_y; /* the side below the bend */
    union {
        struct {
            short_edge_t a, b; /* left and right side */
        } brief;
        struct {
            edge_t a, b;
        } full;
    } side;
} triangle_t;

/* What of a state is to be kept: `full` is not of short sides. */
TUILE_INLINE uint16_t triangle_state_bytes(bool is_short) {
    const size_t bytes = offsetof(triangle_t, side) + (is_short ? 2 * sizeof(short_edge_t) : 2 * sizeof(edge_t));
    return (uint16_t)((bytes + 7u) & ~(size_t)7u);
}

/* All sides are short (edge.h); v0 is a topmost vertex. */
TUILE_INLINE bool triangle_sides_short(const vertex_t *v0, const vertex_t *v1, const vertex_t *v2) {
    const int32_t x0 = v0->x, x1 = v1->x, x2 = v2->x;
    const int32_t least = x0 < x1 ? (x0 < x2 ? x0 : x2) : (x1 < x2 ? x1 : x2),
                  most = x0 > x1 ? (x0 > x2 ? x0 : x2) : (x1 > x2 ? x1 : x2);
    return most - least < SHORT_SIDE && (v1->y < v2->y ? v2->y : v1->y) - v0->y < SHORT_SIDE;
}

/* v0 is a topmost vertex, v0 v1 v2 is counter-clockwise as seen, with an area above 0, and it spans some row >= first_row.
 * gouraud: light gradients are wanted. Leaves size_bytes, record and value alone. */
void triangle_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, int32_t first_row,
                    bool gouraud);

/* The shade that the tested spans of the triangle follow: at the centre of pixel (0, 0), and per pixel right and down. */
void triangle_shade(const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, bool gouraud, uint64_t *shade, uint64_t *dx,
                    uint64_t *dy);

/* Light at the centre of any pixel (x, y): light + x dx + y dy modulo 2^32, Q8.24 with the rounding half. */
typedef struct light_plane {
    uint32_t light, dx, dy;
} light_plane_t;

/* The planes that the tested spans of the triangle follow; lights may be NULL. A gradient steeper than 2^31 (32768 steps a pixel)
 * belongs to a sliver: its depth is right at the pixels of the face and modulo 2^32 only. */
void triangle_planes(const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, depth_plane_t *plane, light_plane_t *lights);

/* The same for painting: no depth is made. */
void triangle_paint_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, int32_t first_row,
                          bool gouraud);

/* All of these fill the rows from triangle->row to the tile's bottom or the triangle's end, and leave the state there;
 * triangle->row < tile->bottom. The first two are for short sides, within the tile's columns, where the first of equals wins. */
void triangle_fill_gouraud(triangle_t *triangle, const raster_tile_t *tile, const uint16_t *ramp);
void triangle_fill_flat(triangle_t *triangle, const raster_tile_t *tile);
void triangle_fill_any(triangle_t *triangle, const raster_tile_t *tile, span_kind_t kind, bool last, const uint16_t *ramp);

/* ramp: SPAN_GOURAUD only. */
TUILE_INLINE void triangle_fill(triangle_t *triangle, const raster_tile_t *tile, span_kind_t kind, bool last,
                                const uint16_t *ramp) {
    if (TUILE_UNLIKELY(!triangle->is_short || last || triangle->head.left < tile->left || triangle->head.right > tile->right ||
                       kind == SPAN_IDS)) {
        triangle_fill_any(triangle, tile, kind, last, ramp);
    } else if (kind == SPAN_GOURAUD) {
        triangle_fill_gouraud(triangle, tile, ramp);
    } else {
        triangle_fill_flat(triangle, tile);
    }
}

/* The same without a depth test, over whatever is there. */
void triangle_paint_gouraud(triangle_t *triangle, const raster_tile_t *tile, const uint16_t *ramp);
void triangle_paint_flat(triangle_t *triangle, const raster_tile_t *tile);
void triangle_paint_any(triangle_t *triangle, const raster_tile_t *tile, span_kind_t kind, const uint16_t *ramp);

TUILE_INLINE void triangle_paint(triangle_t *triangle, const raster_tile_t *tile, span_kind_t kind, const uint16_t *ramp) {
    if (TUILE_UNLIKELY(!triangle->is_short || triangle->head.left < tile->left || triangle->head.right > tile->right ||
                       kind == SPAN_IDS)) {
        triangle_paint_any(triangle, tile, kind, ramp);
    } else if (kind == SPAN_GOURAUD) {
        triangle_paint_gouraud(triangle, tile, ramp);
    } else {
        triangle_paint_flat(triangle, tile);
    }
}

/* The same without drawing. */
void triangle_skip(triangle_t *triangle, int32_t row);

#endif
