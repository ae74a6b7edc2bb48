#include "../tune.h"

#include "window.h"

window_relation_t window_ring(const polygon_ring_t *ring, const window_t *window) {
    const int32_t left = 16 * window->left + 8, right = 16 * window->right - 8; /* centres, to be moved by e */
    const int32_t top = 16 * window->top + 8, bottom = 16 * window->bottom - 8;
    const vertex_t *from = polygon_ring_vertex(ring, ring->count - 1);
    bool inside = false;
    for (uint32_t i = 0; i < ring->count; i++) {
        const vertex_t *to = polygon_ring_vertex(ring, i);
        const int32_t x0 = from->x, y0 = from->y, x1 = to->x, y1 = to->y;
        const bool beyond =
            (x0 <= left && x1 <= left) || (x0 > right && x1 > right) || (y0 <= top && y1 <= top) || (y0 > bottom && y1 > bottom);
        const bool passes_row = (y0 <= top) != (y1 <= top);
        from = to;
        if (beyond && !passes_row) { continue; }
        const window_side_t side = window_side(x0, y0, x1, y1);
        if (!beyond) { /* T3: the corners of the window lie on both sides of the line */
            int32_t least, most;
            window_side_range(&side, window, &least, &most);
            if (least < 0 && most >= 0) { return WINDOW_INTERSECTING; }
        }
        /* T4: sides at or left of the top left corner. */
        if (passes_row) { inside ^= (window_side_at(&side, window->left, window->top) >= 0) == (y1 > y0); }
    }
    return inside ? WINDOW_SURROUNDING : WINDOW_DISJOINT;
}

window_t window_of_ring(const polygon_ring_t *ring) {
    int32_t left = INT32_MAX, right = INT32_MIN, top = INT32_MAX, bottom = INT32_MIN;
    for (uint32_t i = 0; i < ring->count; i++) {
        const vertex_t *v = polygon_ring_vertex(ring, i);
        left = v->x < left ? v->x : left;
        right = v->x > right ? v->x : right;
        top = v->y < top ? v->y : top;
        bottom = v->y > bottom ? v->y : bottom;
    }
    return (window_t){(int16_t)edge_row(left), (int16_t)edge_row(top), (int16_t)edge_row(right), (int16_t)edge_row(bottom)};
}
