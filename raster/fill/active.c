#include "../tune.h"

#include "active.h"

TUILE_INLINE active_edge_t *edge_at(active_pool_t *pool, uint32_t offset) { return active_at(pool, offset); }

/* Is a / b < c / d, 0 <= a < b, 0 <= c < d, all below 2^20? */
TUILE_INLINE bool less_fraction(int32_t a, int32_t b, int32_t c, int32_t d) { return (int64_t)a * d < (int64_t)c * b; }

/* The crossing is x - 1 + (n + 1) / d. */
TUILE_INLINE bool left_of(const edge_t *a, const edge_t *b) {
    return a->x < b->x || (a->x == b->x && (int64_t)(a->n + 1) * b->d < (int64_t)(b->n + 1) * a->d);
}

/* (xc, Δx) in alphabetical order. */
static bool before(const edge_t *a, const edge_t *b) {
    if (left_of(a, b)) { return true; }
    return !left_of(b, a) && (a->q < b->q || (a->q == b->q && less_fraction(a->r, a->d, b->r, b->d)));
}

/* zc where the rank is odd, and nowhere else. A side that has ended takes a rank among all, as in the document, but none from those
 * that have not: between two that met in a vertex above this row others may lie. */
static void rank(active_pool_t *pool, const active_list_t *list, const active_plane_t *plane, int32_t row) {
    bool odd = false, odd_of_all = false;
    for (uint32_t at = list->first; at;) {
        active_edge_t *e = edge_at(pool, at);
        odd_of_all = !odd_of_all;
        if (e->rows > 0) { odd = !odd; }
        const bool deep = e->rows > 0 ? odd : odd_of_all;
        if (deep && !e->deep) { e->z = plane->z + plane->dx * (uint64_t)(int64_t)e->edge.x + plane->dy * (uint64_t)(int64_t)row; }
        e->deep = deep;
        at = e->next;
    }
}

/* ---- B ---- */

/* Sides that ended in this point: the side that begins there takes their place. */
static void drop_ended(active_pool_t *pool, active_list_t *list, const vertex_t *corner) {
    for (uint32_t *link = &list->first; *link;) {
        const uint32_t at = *link;
        active_edge_t *e = edge_at(pool, at);
        if (e->rows == 0 && e->end_x == corner->x && e->end_y == corner->y) {
            *link = e->next;
            active_give(pool, &pool->free_edges, at);
        } else {
            link = &e->next;
        }
    }
}

static bool insert(active_pool_t *pool, active_list_t *list, const vertex_t *upper, const vertex_t *lower, int32_t row) {
    const uint32_t at = active_take(pool, &pool->free_edges, sizeof(active_edge_t));
    if (at == 0) { return false; }
    active_edge_t *e = edge_at(pool, at);
    edge_start(&e->edge, upper->x, upper->y, lower->x, lower->y, row);
    e->rows = (int16_t)(edge_row(lower->y) - row);
    e->deep = false;
    e->end_x = lower->x;
    e->end_y = lower->y;
    uint32_t *link = &list->first;
    while (*link && !before(&e->edge, &edge_at(pool, *link)->edge)) {
        link = &edge_at(pool, *link)->next;
    }
    e->next = *link;
    *link = at;
    return true;
}

bool active_enter(active_pool_t *pool, active_list_t *list, const polygon_ring_t *ring, const active_plane_t *plane, int32_t from,
                  int32_t row) {
    int32_t row_next = INT16_MAX, row_end = INT16_MIN;
    const vertex_t *a = polygon_ring_vertex(ring, ring->count - 1);
    int32_t a_row = edge_row(a->y);
    for (uint32_t i = 0; i < ring->count; i++) {
        const vertex_t *b = polygon_ring_vertex(ring, i);
        const int32_t b_row = edge_row(b->y);
        const int32_t first = a_row < b_row ? a_row : b_row, end = a_row < b_row ? b_row : a_row;
        if (first == end) { /* crosses no row of centres */
        } else if (first > row) {
            row_next = first < row_next ? first : row_next;
        } else if (first >= from && end > row) {
            const vertex_t *upper = a_row < b_row ? a : b, *lower = a_row < b_row ? b : a;
            drop_ended(pool, list, upper);
            if (!insert(pool, list, upper, lower, row)) { return false; }
        }
        row_end = end > row_end ? end : row_end;
        a = b;
        a_row = b_row;
    }
    list->row_next = (int16_t)row_next;
    list->row_end = (int16_t)row_end;
    rank(pool, list, plane, row);
    return true;
}

/* ---- from row to row ---- */

/* Behind all entries that are not right of it: sides that come to cross one another change places, others do not. */
static TUILE_NOINLINE void put_back(active_pool_t *pool, active_list_t *list, uint32_t at) {
    active_edge_t *e = edge_at(pool, at);
    uint32_t *link = &list->first;
    while (!left_of(&e->edge, &edge_at(pool, *link)->edge)) { /* it is left of the last one */
        link = &edge_at(pool, *link)->next;
    }
    e->next = *link;
    *link = at;
}

void active_step(active_pool_t *pool, active_list_t *list, const active_plane_t *plane, int32_t row) {
    active_edge_t *last = NULL;
    uint32_t *link = &list->first;
    bool changed = false;
    for (uint32_t at = *link; at;) {
        active_edge_t *e = edge_at(pool, at);
        const uint32_t this = at;
        const int32_t x = e->edge.x;
        at = e->next;
        edge_step(&e->edge);
        if (e->deep) { e->z += plane->dy + plane->dx * (uint64_t)(int64_t)(e->edge.x - x); }
        if (TUILE_UNLIKELY(--e->rows <= 0)) {
            changed = true;
            if (e->rows < 0) {
                *link = at;
                active_give(pool, &pool->free_edges, this);
                continue;
            }
        }
        if (TUILE_UNLIKELY(last && left_of(&e->edge, &last->edge))) {
            changed = true;
            *link = at;
            put_back(pool, list, this);
            continue;
        }
        last = e;
        link = &e->next;
    }
    if (changed && row != list->row_next) { rank(pool, list, plane, row); }
}

void active_drop(active_pool_t *pool, active_list_t *list) {
    while (list->first) {
        const uint32_t at = list->first;
        list->first = edge_at(pool, at)->next;
        active_give(pool, &pool->free_edges, at);
    }
}
