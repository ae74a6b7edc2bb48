/* The edge stepper (S7, generalised to sub-pixels): where a side of a polygon meets the centres of the pixel rows, exactly.
 *
 * For a side from (x0, y0) down to (x1, y1), y0 < y1, in 1/16 pixel, the first pixel of row j whose centre is on the side or right
 * of it is
 *     x = ceil(((x0 - 8) * dy + (16 j + 8 - y0) * dx) / (16 dy)),   dx = x1 - x0, dy = y1 - y0.
 * The stepper keeps x and the remainder n of that quotient, 0 <= n < d = 16 dy, with  x * d + n = numerator + d - 1.  A row further
 * down the numerator grows by 16 dx: q = floor(dx / dy) whole pixels and a remainder r, so a row costs three additions and a
 * comparison, and x is exact on every row. It serves left sides (first pixel in) and right sides (first pixel out) alike, which is
 * why faces that share a side share no pixel and leave none out.
 *
 * Rows: a side counts on row j iff y0 <= 16 j + 8 < y1, that is edge_row(y0) <= j < edge_row(y1).
 */
#ifndef TUILE_FILL_EDGE_H
#define TUILE_FILL_EDGE_H

#include "../fixed.h"
#include "../tuile.h"

typedef struct edge {
    int32_t x;       /* pixel */
    int32_t n, r, d; /* 0 <= n, r < d */
    int32_t q;
} edge_t;

/* The first pixel row (or column) whose centre is at or beyond coordinate: ceil((coordinate - 8) / 16). */
TUILE_INLINE int32_t edge_row(q28_4_t coordinate) { return (coordinate + 7) >> 4; }

/* At row, edge_row(y0) <= row. |differences of coordinates| < 2^15 and 16 row + 8 - y0 < 2^15, so that all is below 2^31:
 * |15 dy + (16 row + 8 - y0) dx + 16 dy - 1| < 2^19 + 2^30 + 2^19. */
TUILE_INLINE void edge_start(edge_t *edge, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t row) {
    const int32_t dx = x1 - x0, dy = y1 - y0, d = 16 * dy;
    const int32_t whole = (x0 - 8) >> 4, part = (x0 - 8) & 15;
    const int32_t numerator = part * dy + (16 * row + 8 - y0) * dx + d - 1;
    int32_t quotient = numerator / d, remainder = numerator % d;
    if (remainder < 0) { quotient--, remainder += d; }
    edge->x = whole + quotient;
    edge->n = remainder;
    edge->d = d;
    quotient = dx / dy, remainder = dx % dy;
    if (remainder < 0) { quotient--, remainder += dy; }
    edge->q = quotient;
    edge->r = 16 * remainder;
}

/* The same for |coordinates| <= 2^19 and any row in range: 64 bits for the prestep, the stepper itself stays in 32. */
static inline void edge_start_wide(edge_t *edge, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t row) {
    const int32_t dx = x1 - x0, dy = y1 - y0;                                                     /* < 2^20 */
    const int32_t d = 16 * dy;                                                                    /* < 2^24 */
    const int64_t numerator = (int64_t)(x0 - 8) * dy + ((int64_t)16 * row + 8 - y0) * dx + d - 1; /* < 2^42 */
    const int64_t x = fixed_floor_div64(numerator, d);
    edge->x = (int32_t)x;
    edge->n = (int32_t)(numerator - x * d);
    edge->d = d;
    edge->q = fixed_floor_div(dx, dy);
    edge->r = 16 * (dx - edge->q * dy);
}

/* A short side, |dx| < SHORT_SIDE and dy < SHORT_SIDE, needs no remainder: x as Q.20, one addition a row.
 *
 * With S = floor(2^20 dx / dy) the stepper holds, t sixteenths of a pixel below (x0, y0),  v = 2^20 X + 2^20 - 1 - e,  where X is
 * the exact quotient that edge_start takes the ceiling of and 0 <= e < t / 16 + 1 <= 33 collects what S and the prestep lost. X is
 * a multiple of 1 / (16 dy), hence floor(v / 2^20) = ceil(X) as long as 1 + e <= 2^20 / (16 dy), which is at least 128. */
#define SHORT_SIDE 512

typedef struct short_edge {
    int32_t x; /* v above: pixel << 20 */
    int32_t slope;
} short_edge_t;

TUILE_INLINE int32_t short_edge_pixel(int32_t x) { return x >> 20; }

/* edge_row(y0) <= row < edge_row(y1), so that t < dy and |t * slope| < 2^29. 8 - 2^15 <= x0 < 2^15 - 2^4. */
TUILE_INLINE short_edge_t short_edge_start(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t row) {
    const int32_t slope = fixed_floor_div((x1 - x0) * (INT32_C(1) << 20), y1 - y0);
    const int32_t t = 16 * row + 8 - y0;
    return (short_edge_t){(x0 - 8) * (INT32_C(1) << 16) + ((t * slope) >> 4) + (INT32_C(1) << 20) - 1, slope};
}

/* One row down. */
TUILE_INLINE void edge_step(edge_t *edge) {
    edge->x += edge->q;
    edge->n += edge->r;
    if (edge->n >= edge->d) {
        edge->n -= edge->d;
        edge->x++;
    }
}

#endif
