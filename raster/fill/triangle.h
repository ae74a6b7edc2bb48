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
    uint8_t material;
    edge_t a, b;           /* left and right side */
    uint32_t z, dzdx, dzdy;    /* depth at the centre of pixel (0, row), modulo 2^32 */
    uint32_t light, dldx, dldy;
    uint32_t value; /* flat: colour; ids: id */
    vertex_t mid, low; /* the side below the bend */
} triangle_t;

/* v[0] is a topmost vertex, v[0] v[1] v[2] is counter-clockwise as seen (area > 0, see face.h), and it spans some row >= first_row.
 * gouraud: light gradients are wanted. Leaves record, material and value alone. */
void triangle_start(triangle_t *triangle, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2, int32_t area, int32_t first_row,
                    bool gouraud);

/* Fills the rows from triangle->row to the tile's bottom or the triangle's end, and leaves the state there. */
void triangle_fill(triangle_t *triangle, const raster_tile_t *tile, span_kind_t kind, bool last, const uint16_t *ramp);

/* The same without drawing. */
void triangle_skip(triangle_t *triangle, int32_t row);

#endif
