/* The active edge list of document 002 (S14), of one face: the sides that cross the row that is being drawn, from left to right.
 *
 * An entry is the document's (xc, Δx, Δyc, zc), in integers that lose nothing:
 *
 *   xc, Δx   an edge_t. x is the first pixel whose centre is not left of the crossing, which is (d - 1 - n) / d before it;
 *            Δx is q + r / d.
 *
 *   Δyc      row_end less the current row. At 0 the side has ended: the row is no longer its own, and the document keeps it
 *            there once more unless another side goes on from its end. Whoever draws passes over it.
 *
 *   zc       kept on odd ranks, where a span may start: the plane's value at the centre of pixel x, from where the pixels of
 *            the span are stepped. A row further down it grows by dy, and by dx for each pixel that x moved: the document's
 *            -(aΔx + b) / c in its two whole-pixel values. At the crossing itself it is z - dx (d - 1 - n) / d.
 *
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
    int16_t row_end;      /* Δyc rows below the current one */
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
    int16_t row_next; /* the next row where a side begins or ends, or has ended the row before */
    int16_t row_end;  /* no side has a row from here on */
    bool review;      /* active_change is to look for sides that have ended, and to count the ranks anew */
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

/* Begins a list at a row. False: the pool is full. */
bool active_begin(active_pool_t *pool, active_list_t *list, const polygon_ring_t *ring, const active_plane_t *plane, int32_t row);

/* The same for a triangle that covers the row: v0 is a topmost vertex, v0 v1 v2 is counter-clockwise as seen. */
bool active_begin_triangle(active_pool_t *pool, active_list_t *list, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                           const active_plane_t *plane, int32_t row);

/* What the document does behind the step, on rows where a side begins or ends: sides with Δyc < 0 are dropped, those with Δyc = 0
 * where another one begins too, B[row] is inserted. False: the pool is full. */
bool active_change(active_pool_t *pool, active_list_t *list, const polygon_ring_t *ring, const active_plane_t *plane, int32_t row);

/* Empties the list. */
void active_drop(active_pool_t *pool, active_list_t *list);

/* Sorts a list whose sides have come to cross one another; all others keep their order. */
void active_sort(active_pool_t *pool, active_list_t *list, const active_plane_t *plane, int32_t row);

/* The crossing is x - 1 + (n + 1) / d. */
TUILE_INLINE bool active_left_of(const edge_t *a, const edge_t *b) {
    return a->x < b->x || (a->x == b->x && (int64_t)(a->n + 1) * b->d < (int64_t)(b->n + 1) * a->d);
}

/* Moves two sides down to `row`: all of a list on which nothing begins or ends. */
TUILE_INLINE void active_step_two(active_pool_t *pool, active_list_t *list, const active_plane_t *plane, active_edge_t *a,
                                  active_edge_t *b, int32_t row) {
    const int32_t x = a->edge.x;
    edge_step(&a->edge);
    edge_step(&b->edge);
    a->z += plane->dy + plane->dx * (uint64_t)(int64_t)(a->edge.x - x);
    if (TUILE_UNLIKELY(active_left_of(&b->edge, &a->edge))) { active_sort(pool, list, plane, row); }
}

/* Moves the sides down to `row`, one below the row they are on. On row_next, active_change has to follow. */
TUILE_INLINE void active_step(active_pool_t *pool, active_list_t *list, const active_plane_t *plane, int32_t row) {
    const active_edge_t *last = NULL;
    bool crossed = false;
    for (uint32_t at = list->first; at;) {
        active_edge_t *e = (active_edge_t *)active_at(pool, at);
        const int32_t x = e->edge.x;
        edge_step(&e->edge);
        if (e->deep) { e->z += plane->dy + plane->dx * (uint64_t)(int64_t)(e->edge.x - x); }
        crossed |= last && active_left_of(&e->edge, &last->edge);
        last = e;
        at = e->next;
    }
    if (TUILE_UNLIKELY(crossed)) { active_sort(pool, list, plane, row); }
}

#endif
