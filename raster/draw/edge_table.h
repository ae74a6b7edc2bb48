/* Triangles of whole pixels between Bresenham edges (S17): a drawing mode of its own, with outlines that count, unlike the
 * renderer's fill, which knows sixteenths of pixels and samples.
 *
 * Corners are sorted by y, P1, P2, P3. The border through P2 (sides P1 P2 and P2 P3) is left or right of the side P1 P3 by the
 * sign of a cross product. Each row y1 ... y3, both included, is drawn from the left border's pixel to the right border's, both
 * included. The pixels of Bresenham's walk along a side (line.h; always from the smaller y to the larger) that lie in one row are
 * its *run* there: one pixel if the side is steep, several if it is flat (|dx| > |dy|). The policy says which of them counts:
 *
 *   DOCUMENT  the last one walked, as the document lists it. On row y2 the side P2 P3 has the last word. A side that lies in one
 * row is walked from the corner given first; it overwrites what was known of that row, so that the picture depends on the order of
 * the corners, and may lack corners. Where the borders have crossed nothing is drawn. ENDS      the same, but on its first and last
 * row a side has its corner's x (px[yi] = xi, px[yf] = xf). All corners are drawn. UPWARDS   the last one walked, and no side
 * depends on the order of the corners. OUTER     the one furthest outside: the leftmost of a left side, the rightmost of a right
 * one; on row y2 of both sides. Draws every pixel that the three sides have when drawn as lines from the smaller y to the larger.
 *   MID       the one halfway between outer and inner, rounded to the left; on row y2 that of the side P2 P3.
 *   INNER     the one furthest inside; on row y2 of both sides. The one policy that leaves gaps between neighbours: of a flat
 * side's run it leaves the middle to neither.
 *
 * With the others two triangles that share a side have the same pixel of it in each row (or, with OUTER, all), so no gap is left.
 * A side in one row has no one pixel; but for DOCUMENT it is left to the two sides that end on it, and a triangle in one row
 * is drawn from its leftmost corner to its rightmost. With ENDS, UPWARDS and MID borders may cross in triangles thinner than a run;
 * the row is then drawn between them all the same. With OUTER they never do, and with INNER the row is empty.
 *
 * In exact terms: where a flat side passes row y, |Y - y| <= 1/2, it has the columns X1 ... X2; its run is the whole numbers among
 * them, ends that are whole going to the row that is walked to. OUTER and INNER are the first and last of them, up to one pixel
 * inside X1 ... X2; MID lies at most one pixel from where the side meets the row's centre line (on rows where it does not end). The
 * one pixel of a steep side is at most half a pixel from there, whatever the policy.
 *
 * The document stores both tables: 8 bytes a row, 32 KB for its 4096 rows. Here each side gives up its run row by row, by quotient
 * and remainder, and can be entered at any row: no table, the same 148 bytes for any height, one division of 64 bits a side and
 * tile.
 */
#ifndef TUILE_DRAW_EDGE_TABLE_H
#define TUILE_DRAW_EDGE_TABLE_H

#include "../fill/edge.h"
#include "line.h"

typedef enum edge_policy { EDGE_DOCUMENT, EDGE_ENDS, EDGE_UPWARDS, EDGE_OUTER, EDGE_MID, EDGE_INNER } edge_policy_t;

/* A side on one of its rows. Offsets count steps in x from its first end. */
typedef struct edge_side {
    int32_t x0, y0, x1, y1; /* y0 <= y1 */
    int32_t begin;          /* flat: offset of the run's first pixel */
    edge_t rows;            /* .x: steep: offset of the one pixel; flat: of the first pixel of the next row */
    bool flat;
} edge_side_t;

typedef struct edge_table {
    edge_side_t side[3]; /* P1 P2, P2 P3, P1 P3 */
    int32_t row, last_row;
    edge_policy_t policy;
    bool bends_left; /* P2 is on the left */
} edge_table_t;

/* corners: |coordinates| <= LINE_RANGE. The walk begins at first_row or y1, whichever is later; false when y3 < first_row. */
bool edge_table_start(edge_table_t *table, const int32_t corners[3][2], edge_policy_t policy, int32_t first_row);

/* The pixels of table->row, first ... last, none when first > last; then goes on to the next row, while row <= last_row. */
void edge_table_next(edge_table_t *table, int32_t *first, int32_t *last);

/* Draws it into the tile's colours, of pixel_bytes each (2 or 4); depth is neither read nor written, and may be NULL. */
void edge_table_fill(const raster_tile_t *tile, const int32_t corners[3][2], edge_policy_t policy, uint32_t value,
                     unsigned pixel_bytes);

#endif
