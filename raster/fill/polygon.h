/* Polygons of any shape, even-odd (S6), by the same edge stepper.
 *
 * Going round a polygon, sides that lead down alternate with sides that lead up. A maximal run of one kind is a chain: on
 * each row it has at most one side, so a chain is one edge stepper that moves on from side to side. A convex polygon has two
 * chains; in general there is an even number, and on each row the chains' crossings, sorted, pair up to spans. Two chains need no
 * order: the span runs from the lesser to the greater.
 *
 * The document keeps tables of left and right edges per row, filled before anything is drawn; chains give the same spans (its
 * worked example is a test) with memory that does not grow with the height.
 */
#ifndef TUILE_FILL_POLYGON_H
#define TUILE_FILL_POLYGON_H

#include "../geometry/vertex.h"
#include "edge.h"
#include "span.h"

/* A ring of points: either window vertices, by index, or pairs of q28_4_t. */
typedef struct polygon_ring {
    const vertex_t *vertices; /* used when wide is NULL */
    const uint8_t *corners;   /* corner i is vertices[corners[i]]; NULL: vertices[i] */
    const q28_4_t (*wide)[2]; /* |coordinate| <= 32767 * 16 */
    uint32_t count;
} polygon_ring_t;

/* Corner i of a ring of window vertices. */
TUILE_INLINE const vertex_t *polygon_ring_vertex(const polygon_ring_t *ring, uint32_t i) {
    return &ring->vertices[ring->corners ? ring->corners[i] : i];
}

typedef struct polygon_chain {
    edge_t edge;
    int32_t row_first, row_turn, row_end; /* rows of the chain; the row where the current side ends */
    uint32_t corner;                      /* where the current side starts; the next corner is `direction` away */
    int32_t direction;
} polygon_chain_t;

/* Finds at most `capacity` chains, each set to its first row. Returns their number, which may be greater than capacity: the rest is
 * not stored then. 0: the polygon covers no row of pixel centres. */
unsigned polygon_chains(const polygon_ring_t *ring, polygon_chain_t *chains, unsigned capacity);

/* Moves a chain to a row within row_first ... row_end - 1, not above the one it is on. */
void polygon_chain_seek(const polygon_ring_t *ring, polygon_chain_t *chain, int32_t row);

/* The stepper one row down. */
void polygon_chain_step(const polygon_ring_t *ring, polygon_chain_t *chain, int32_t row);

/* A place among the crossings of a row, which are ordered by pixel and side. Begins as {0}. */
typedef struct polygon_cursor {
    int32_t x;
    uint32_t side;
    bool begun;
} polygon_cursor_t;

/* Moves on to the next crossing of the ring with a row, found without any memory by one walk round the ring. False when there is
 * none. For polygons of more chains than there is room for. */
bool polygon_crossing(const polygon_ring_t *ring, int32_t row, polygon_cursor_t *cursor);

/* ---- faces of more than three corners ---- */

#define POLYGON_CHAINS 8 /* more chains than that are found row by row with polygon_crossing */

/* The plane that the spans of a polygon follow; false when it has no area. */
bool polygon_plane(const polygon_ring_t *ring, depth_plane_t *plane);

typedef struct polygon {
    fill_head_t head;
    int16_t row;
    uint8_t chain_count; /* 0: too many */
    uint32_t value;
    depth_plane_t depth; /* depth.z at the centre of pixel (0, row) */
    polygon_chain_t chains[POLYGON_CHAINS];
} polygon_t;

/* Sets a face up from first_row on; false when it covers no pixel row there. Leaves record and value alone. */
bool polygon_start(polygon_t *polygon, const polygon_ring_t *ring, int32_t first_row);

/* The same for painting: no depth is made. */
bool polygon_paint_start(polygon_t *polygon, const polygon_ring_t *ring, int32_t first_row);

/* Fills down to the tile's bottom. kind: SPAN_FLAT or SPAN_IDS. */
void polygon_fill(polygon_t *polygon, const polygon_ring_t *ring, const raster_tile_t *tile, span_kind_t kind, bool last);

/* The same without a depth test, over whatever is there. */
void polygon_paint(polygon_t *polygon, const polygon_ring_t *ring, const raster_tile_t *tile, span_kind_t kind);

/* The same without drawing. */
void polygon_skip(polygon_t *polygon, const polygon_ring_t *ring, int32_t row);

/* ---- coverage alone ---- */

typedef void (*polygon_span_fn)(void *context, int32_t row, int32_t first, int32_t end);

/* Calls span for each non-empty run of covered pixels first ... end - 1, cut to the window, top to bottom and left to right.
 * chains: scratch for `capacity` chains; any capacity, 0 included, gives the same spans. */
void polygon_coverage(const polygon_ring_t *ring, int32_t width, int32_t height, polygon_chain_t *chains, unsigned capacity,
                      polygon_span_fn span, void *context);

#endif
