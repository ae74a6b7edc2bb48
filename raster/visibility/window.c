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

uint32_t window_mask_triangle(const window_side_t sides[3], const window_t *box, const window_t *window) {
    const window_t part = window_cut(box, window);
    const int32_t width = window->right - window->left;
    const uint32_t a0 = (uint32_t)sides[0].a, a1 = (uint32_t)sides[1].a, a2 = (uint32_t)sides[2].a;
    uint32_t e0 = (uint32_t)window_side_at(&sides[0], part.left, part.top),
             e1 = (uint32_t)window_side_at(&sides[1], part.left, part.top),
             e2 = (uint32_t)window_side_at(&sides[2], part.left, part.top);
    uint32_t mask = 0;
    int32_t row = (part.top - window->top) * width + part.left - window->left;
    const int32_t count = part.right - part.left;
    for (int32_t y = part.top; y < part.bottom; y++, row += width) {
        uint32_t f0 = e0, f1 = e1, f2 = e2, out = 0, bit = 1;
        for (int32_t i = count; i > 0; i--, bit += bit) {
            if ((int32_t)(f0 | f1 | f2) >= 0) { out += bit; }
            f0 += a0;
            f1 += a1;
            f2 += a2;
        }
        mask |= out << row;
        e0 += (uint32_t)sides[0].b;
        e1 += (uint32_t)sides[1].b;
        e2 += (uint32_t)sides[2].b;
    }
    return mask;
}

/* A side turns all pixels at or right of it over, in the rows that it passes. */
uint32_t window_mask_ring(const polygon_ring_t *ring, const window_t *window) {
    const int32_t width = window->right - window->left;
    const uint32_t all = 0xffffffffu >> (WINDOW_MASK_PX - width);
    const vertex_t *from = polygon_ring_vertex(ring, ring->count - 1);
    uint32_t mask = 0;
    for (uint32_t i = 0; i < ring->count; i++) {
        const vertex_t *to = polygon_ring_vertex(ring, i);
        const vertex_t *upper = from->y < to->y ? from : to, *lower = from->y < to->y ? to : from;
        int32_t y = edge_row(upper->y), end = edge_row(lower->y);
        from = to;
        y = y > window->top ? y : window->top;
        end = end < window->bottom ? end : window->bottom;
        if (y >= end) { continue; }
        const window_side_t side = window_side(upper->x, upper->y, lower->x, lower->y);
        int32_t e = window_side_at(&side, window->left, y);
        for (; y < end; y++) {
            int32_t x = 0;
            for (uint32_t at = (uint32_t)e; x < width && (int32_t)at < 0; x++) {
                at += (uint32_t)side.a;
            }
            if (x < width) { mask ^= (all & ~((1u << x) - 1u)) << ((y - window->top) * width); }
            e = (int32_t)((uint32_t)e + (uint32_t)side.b);
        }
    }
    return mask;
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
