#include "../tune.h"

#include "active.h"

TUILE_INLINE active_edge_t *edge_at(active_pool_t *pool, uint32_t offset) { return active_at(pool, offset); }

/* zc where the rank is odd, and nowhere else. A side that has ended takes a rank among all, as in the document, but none from those
 * that have not: between two that met in a vertex above this row others may lie. */
static void rank(active_pool_t *pool, const active_list_t *list, const active_plane_t *plane, int32_t row) {
    bool odd = false, odd_of_all = false;
    for (uint32_t at = list->first; at;) {
        active_edge_t *e = edge_at(pool, at);
        const bool ended = e->row_end <= row;
        odd_of_all = !odd_of_all;
        odd ^= !ended;
        const bool deep = ended ? odd_of_all : odd;
        if (deep && !e->deep) { e->z = plane->z + plane->dx * (uint64_t)(int64_t)e->edge.x + plane->dy * (uint64_t)(int64_t)row; }
        e->deep = deep;
        at = e->next;
    }
}

/* ---- B ---- */

/* a < b in the alphabetical order of (xc, Δx); Δx is q + r / d, r and d below 2^20. */
static bool before(const edge_t *a, const edge_t *b) {
    if (a->x != b->x) { return a->x < b->x; }
    if (active_left_of(a, b)) { return true; }
    return !active_left_of(b, a) && (a->q < b->q || (a->q == b->q && (int64_t)a->r * b->d < (int64_t)b->r * a->d));
}

/* A side to be linked in; 0: the pool is full. */
TUILE_INLINE uint32_t side_take(active_pool_t *pool, const vertex_t *upper, const vertex_t *lower, int32_t end, int32_t row) {
    const uint32_t at = active_take(pool, &pool->free_edges, sizeof(active_edge_t));
    if (TUILE_LIKELY(at != 0)) {
        active_edge_t *e = edge_at(pool, at);
        edge_start(&e->edge, upper->x, upper->y, lower->x, lower->y, row);
        e->row_end = (int16_t)end;
        e->deep = false;
        e->end_x = lower->x;
        e->end_y = lower->y;
    }
    return at;
}

TUILE_INLINE bool insert(active_pool_t *pool, active_list_t *list, const vertex_t *upper, const vertex_t *lower, int32_t end,
                         int32_t row) {
    const uint32_t at = side_take(pool, upper, lower, end, row);
    if (at == 0) { return false; }
    active_edge_t *e = edge_at(pool, at);
    uint32_t *link = &list->first;
    while (*link && !before(&e->edge, &edge_at(pool, *link)->edge)) {
        link = &edge_at(pool, *link)->next;
    }
    e->next = *link;
    *link = at;
    return true;
}

static void drop(active_pool_t *pool, uint32_t *link) {
    const uint32_t at = *link;
    *link = edge_at(pool, at)->next;
    active_give(pool, &pool->free_edges, at);
}

/* Drops what has Δyc < 0 on this row. */
static void drop_ended(active_pool_t *pool, active_list_t *list, int32_t row) {
    for (uint32_t *link = &list->first; *link;) {
        active_edge_t *e = edge_at(pool, *link);
        if (e->row_end < row) {
            drop(pool, link);
        } else {
            link = &e->next;
        }
    }
}

/* Drops what ended on this row in the point where a side begins. When that was one side, and the new one stands where it stood, it
 * takes its entry over: true. */
static bool replace(active_pool_t *pool, active_list_t *list, const active_plane_t *plane, const vertex_t *upper,
                    const vertex_t *lower, int32_t end, int32_t row) {
    const active_edge_t *left = NULL;
    for (uint32_t *link = &list->first; *link;) {
        active_edge_t *e = edge_at(pool, *link);
        if (e->row_end == row && e->end_x == upper->x && e->end_y == upper->y) {
            const int32_t x = e->edge.x;
            edge_start(&e->edge, upper->x, upper->y, lower->x, lower->y, row);
            if ((left == NULL || active_left_of(&left->edge, &e->edge)) &&
                (e->next == 0 || active_left_of(&e->edge, &edge_at(pool, e->next)->edge))) {
                if (e->deep) { e->z += plane->dx * (uint64_t)(int64_t)(e->edge.x - x); }
                e->row_end = (int16_t)end;
                e->end_x = lower->x;
                e->end_y = lower->y;
                return true;
            }
            drop(pool, link);
            continue;
        }
        left = e;
        link = &e->next;
    }
    return false;
}

/* Enters the sides that cross `row`: with `all` into an empty list, else those of B[row]. Finds the next row where a side begins
 * or ends. */
TUILE_INLINE bool enter(active_pool_t *pool, active_list_t *list, const polygon_ring_t *ring, const active_plane_t *plane, bool all,
                        bool *ranks, int32_t row) {
    int32_t row_next = INT16_MAX, row_end = INT16_MIN;
    const vertex_t *a = polygon_ring_vertex(ring, ring->count - 1);
    int32_t a_row = edge_row(a->y);
    for (uint32_t i = 0; i < ring->count; i++) {
        const vertex_t *b = polygon_ring_vertex(ring, i);
        const int32_t b_row = edge_row(b->y);
        const bool down = a_row < b_row;
        const int32_t first = down ? a_row : b_row, end = down ? b_row : a_row;
        if (first < end && end > row) { /* else it crosses no row of centres, or none any more */
            const int32_t next = first > row ? first : end;
            row_next = next < row_next ? next : row_next;
            row_end = end > row_end ? end : row_end;
            if (all ? first <= row : first == row) {
                const vertex_t *upper = down ? a : b, *lower = down ? b : a;
                if (all || !replace(pool, list, plane, upper, lower, end, row)) {
                    if (!insert(pool, list, upper, lower, end, row)) { return false; }
                    *ranks = true;
                }
            }
        }
        a = b;
        a_row = b_row;
    }
    list->row_next = (int16_t)row_next;
    list->row_end = (int16_t)row_end;
    return true;
}

bool active_begin(active_pool_t *pool, active_list_t *list, const polygon_ring_t *ring, const active_plane_t *plane, int32_t row) {
    bool ranks;
    list->first = 0;
    list->review = false;
    if (!enter(pool, list, ring, plane, true, &ranks, row)) { return false; }
    rank(pool, list, plane, row);
    return true;
}

bool active_begin_triangle(active_pool_t *pool, active_list_t *list, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                           const active_plane_t *plane, int32_t row) {
    const bool bends_left = v1->y < v2->y;
    const vertex_t *mid = bends_left ? v1 : v2, *low = bends_left ? v2 : v1;
    const int32_t row_mid = edge_row(mid->y), row_end = edge_row(low->y);
    const bool bent = row >= row_mid;
    const uint32_t bending = bent ? side_take(pool, mid, low, row_end, row) : side_take(pool, v0, mid, row_mid, row);
    list->first = bending;
    if (bending == 0) { return false; }
    edge_at(pool, bending)->next = 0;
    const uint32_t straight = side_take(pool, v0, low, row_end, row);
    if (straight == 0) { return false; }
    edge_at(pool, straight)->next = bends_left ? 0 : bending;
    if (bends_left) {
        edge_at(pool, bending)->next = straight;
    } else {
        list->first = straight;
    }
    active_edge_t *left = edge_at(pool, list->first);
    left->z = plane->z + plane->dx * (uint64_t)(int64_t)left->edge.x + plane->dy * (uint64_t)(int64_t)row;
    left->deep = true;
    list->row_next = (int16_t)(bent ? row_end : row_mid);
    list->row_end = (int16_t)row_end;
    list->review = false;
    return true;
}

bool active_change(active_pool_t *pool, active_list_t *list, const polygon_ring_t *ring, const active_plane_t *plane, int32_t row) {
    bool ranks = list->review, ended = false;
    if (list->review) { drop_ended(pool, list, row); }
    if (!enter(pool, list, ring, plane, false, &ranks, row)) { return false; }
    for (uint32_t at = list->first; at; at = edge_at(pool, at)->next) {
        ended |= edge_at(pool, at)->row_end == row;
    }
    if (ended) { list->row_next = (int16_t)(row + 1); }
    if (ranks || ended) { rank(pool, list, plane, row); }
    list->review = ended;
    return true;
}

void active_drop(active_pool_t *pool, active_list_t *list) {
    while (list->first) {
        const uint32_t at = list->first;
        list->first = edge_at(pool, at)->next;
        active_give(pool, &pool->free_edges, at);
    }
}

/* ---- crossings ---- */

void active_sort(active_pool_t *pool, active_list_t *list, const active_plane_t *plane, int32_t row) {
    uint32_t at = list->first;
    list->first = 0;
    list->review = true; /* a side that has ended may be among them, with a rank of its own */
    while (at) {
        active_edge_t *e = edge_at(pool, at);
        const uint32_t next = e->next;
        uint32_t *link = &list->first;
        while (*link && !active_left_of(&e->edge, &edge_at(pool, *link)->edge)) {
            link = &edge_at(pool, *link)->next;
        }
        e->next = *link;
        *link = at;
        at = next;
    }
    rank(pool, list, plane, row);
}
