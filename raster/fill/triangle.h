/* Triangles: set up once, then filled row by row through as many tiles as they reach. */
#ifndef TUILE_FILL_TRIANGLE_H
#define TUILE_FILL_TRIANGLE_H

#include "../geometry/vertex.h"
#include "edge.h"
#include "span.h"

typedef struct triangle {
    uint16_t size_bytes; /* first in every state that is carried from tile row to tile row */
    uint16_t record;     /* the face's record: it orders faces, and tells colour and vertices */
    int16_t row, row_mid, row_end; /* next row to fill; row where the short side bends; end */
    int16_t left, right;           /* pixels that it may touch: left ... right - 1 */
    bool bends_left;               /* the short side is the left one */
    bool is_short;                 /* all sides are: edge.h */
    uint64_t shade, dx, dy;        /* depth and light at the centre of pixel (0, row), and per pixel right and down: triangle.c */
    uint32_t value; /* flat: colour; ids: id; gouraud: material */
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

/* v[0] is a topmost vertex, v[0] v[1] v[2] is counter-clockwise as seen (area > 0, see face.h), and it spans some row >= first_row.
 * gouraud: light gradients are wanted. Leaves size_bytes, record and value alone. */
void triangle_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, int32_t area, int32_t first_row,
                    bool gouraud);

/* Fills the rows from triangle->row to the tile's bottom or the triangle's end, and leaves the state there. triangle->row <
 * tile->bottom. ramp: SPAN_GOURAUD only. */
void triangle_fill(triangle_t *triangle, const raster_tile_t *tile, span_kind_t kind, bool last, const uint16_t *ramp);

/* The same without drawing. */
void triangle_skip(triangle_t *triangle, int32_t row);

#endif
