/* The active edge list of document 002 (S14), of one face: the sides that cross the row that is being drawn, from left to right.
 *
 * An entry is the document's (xc, Δx, Δyc, zc), in integers that lose nothing:
 *   xc, Δx  an edge_t. The crossing is x - (d - 1 - n) / d, where x is the first pixel whose centre is not left of it; Δx is q + r
 * / d. Δyc     the rows that are left to the lower end. At 0 the side has ended: the row is no longer its own, and the document
 * keeps it there once more unless another side goes on from its end. Whoever draws passes over it. zc      kept where a span may
 * start, that is on odd ranks: the plane's value at the centre of pixel x, by which all pixels of the span are stepped. A row
 * further down it grows by dy, and by dx for each pixel that x moved: the document's
 *           -(aΔx + b) / c in its two whole-pixel values. At the crossing itself it is  z - dx (d - 1 - n) / d.
 * B, the document's table of sides by the row where they begin, is the ring itself, walked on those rows where a side begins.
 *
 * Entries lie in a pool and are linked by their distance in bytes from the pool's start; 0 ends a list. A face of n corners has at
 * most n of them at once, a triangle 2.
 */
#ifndef TUILE_FILL_ACTIVE_H
#define TUILE_FILL_ACTIVE_H

#include "edge.h"
#include "polygon.h"

/* Stands at the start of its own memory, which is 8-byte aligned. */
typedef struct active_pool {
    uint32_t top, limit; /* bytes used, and there */
    uint32_t free_edges;
} active_pool_t;

typedef struct active_edge {
    uint32_t next;
    int16_t rows;         /* Δyc */
    bool deep;            /* z is kept */
    int16_t end_x, end_y; /* the lower end, 1/16 pixel */
    edge_t edge;
    uint64_t z;
} active_edge_t;
_Static_assert(sizeof(active_edge_t) == 40, "what the method's memory is reckoned with");

/* What is affine in the window: z at the centre of pixel (0, 0), and per pixel right and down. All modulo 2^64. */
typedef struct active_plane {
    uint64_t z, dx, dy;
} active_plane_t;

typedef struct active_list {
    uint32_t first;
    int16_t row_next; /* B: the next row where a side begins */
    int16_t row_end;  /* no side has a row from here on */
} active_list_t;

TUILE_INLINE void *active_at(active_pool_t *pool, uint32_t offset) { return (uint8_t *)pool + offset; }

/* The offset of an item of `size_bytes`, a multiple of 8, that begins with the offset of the next one: taken from a free list, or
 * from what was never used. 0: there is no room. */
TUILE_INLINE uint32_t active_take(active_pool_t *pool, uint32_t *free_list, uint32_t size_bytes) {
    const uint32_t at = *free_list;
    if (at) {
        *free_list = *(const uint32_t *)active_at(pool, at);
        return at;
    }
    if (pool->limit - pool->top < size_bytes) { return 0; }
    pool->top += size_bytes;
    return pool->top - size_bytes;
}

TUILE_INLINE void active_give(active_pool_t *pool, uint32_t *free_list, uint32_t at) {
    *(uint32_t *)active_at(pool, at) = *free_list;
    *free_list = at;
}

/* Enters the sides that cross `row` and begin in rows from ... row: those of B[row] with from = row; all, into an empty list, with
 * from = INT32_MIN. Sides that ended on this row where one of these begins are dropped. False: the pool is full. */
bool active_enter(active_pool_t *pool, active_list_t *list, const polygon_ring_t *ring, const active_plane_t *plane, int32_t from,
                  int32_t row);

/* Moves the list down to `row`, one below the row it is on. On row_next, active_enter is to follow. */
void active_step(active_pool_t *pool, active_list_t *list, const active_plane_t *plane, int32_t row);

/* Empties the list. */
void active_drop(active_pool_t *pool, active_list_t *list);

#endif
