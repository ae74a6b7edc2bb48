/* Windows and polygons: does a face fill a window, miss it, or neither (S15)?
 *
 * All that a picture asks about a window is asked at the centres of its pixels. So the window of pixels left ... right - 1, top ...
 * bottom - 1 is taken for the rectangle that spans these centres, and the answers mean
 *     SURROUNDING   the face covers all of them,
 *     DISJOINT      it covers none,
 *     INTERSECTING  neither was proved. In a window of one pixel this is never the answer.
 *
 * Document 002 asks four questions, from the cheapest to the dearest:
 *   T1  is the bounding box inside the window?      window_holds
 *   T2  are box and window disjoint?                window_misses
 *   T3  does a side of the polygon meet the window? four sub-cases: a proper crossing, a corner of the window on a side, a corner
 * of the polygon on a side of the window, a corner of one on a corner of the other T4  if not, is a corner of the window inside the
 * polygon? Sub-cases two to four of T3 say what holds when a cross product is 0, and they do not say it for all: sides that run
 * along the window's, a corner that only touches from outside, a polygon that is the window, a diagonal from corner to corner that
 * goes through no side's interior, a polygon that crosses itself. Here no cross product is 0. The fill rule - even-odd, a centre on
 * a left or top edge is in - is that of centres moved by (e, e^2) with an infinitesimal e: a point so moved lies on no line through
 * whole coordinates. The window is moved with its centres, so every case is the first one or none, and the answers fit the pixels
 * that are drawn. A cross product that is 0 takes its sign from what the move adds to it (window_side).
 */
#ifndef TUILE_VISIBILITY_WINDOW_H
#define TUILE_VISIBILITY_WINDOW_H

#include "../fill/polygon.h"

typedef struct window {
    int16_t left, top, right, bottom; /* pixels left ... right - 1, top ... bottom - 1 */
} window_t;

typedef enum window_relation { WINDOW_DISJOINT, WINDOW_INTERSECTING, WINDOW_SURROUNDING } window_relation_t;

/* T1: the box lies in the window. */
TUILE_INLINE bool window_holds(const window_t *window, const window_t *box) {
    return box->left >= window->left && box->right <= window->right && box->top >= window->top && box->bottom <= window->bottom;
}

/* T2: box and window share no pixel. */
TUILE_INLINE bool window_misses(const window_t *window, const window_t *box) {
    return box->right <= window->left || box->left >= window->right || box->bottom <= window->top || box->top >= window->bottom;
}

/* The line through a side: a x + b y + c >= 0 iff the centre of pixel (x, y) is on its inner side, which lies to the left of the
 * way from the first corner to the second as seen. Never ambiguous: c holds the sign of the infinitesimal move. Differences of
 * coordinates are below 2^15 (guard band), pixels are in the frame: |values| < 2^31, |a|, |b| < 2^19. */
typedef struct window_side {
    int32_t a, b, c;
} window_side_t;

TUILE_INLINE window_side_t window_side(int32_t x0, int32_t y0, int32_t x1, int32_t y1) {
    const int32_t dx = x1 - x0, dy = y1 - y0;
    const int32_t outside_on_zero = !(dy > 0 || (dy == 0 && dx < 0)); /* dy e - dx e^2 < 0 */
    return (window_side_t){16 * dy, -16 * dx, dy * (8 - x0) - dx * (8 - y0) - outside_on_zero};
}

/* The sum fits; a single product need not be near it, so it is added modulo 2^32. */
TUILE_INLINE int32_t window_side_at(const window_side_t *side, int32_t x, int32_t y) {
    return (int32_t)((uint32_t)side->c + (uint32_t)(side->a * x) + (uint32_t)(side->b * y));
}

/* Values at the corners of the window that are farthest out and farthest in. */
TUILE_INLINE void window_side_range(const window_side_t *side, const window_t *window, int32_t *least, int32_t *most) {
    const int32_t base = window_side_at(side, window->left, window->top);
    const int32_t across = side->a * (window->right - 1 - window->left), down = side->b * (window->bottom - 1 - window->top);
    *least = base + (across < 0 ? across : 0) + (down < 0 ? down : 0);
    *most = base + (across > 0 ? across : 0) + (down > 0 ? down : 0);
}

/* T3 and T4 of a triangle, counter-clockwise as seen, whose box meets the window: it is the intersection of three half-planes. */
TUILE_INLINE window_relation_t window_triangle(const window_side_t sides[3], const window_t *window) {
    bool inside = true;
    for (unsigned i = 0; i < 3; i++) {
        int32_t least, most;
        window_side_range(&sides[i], window, &least, &most);
        if (most < 0) { return WINDOW_DISJOINT; }
        inside &= least >= 0;
    }
    return inside ? WINDOW_SURROUNDING : WINDOW_INTERSECTING;
}

/* T3 and T4 of any polygon, by one walk round it. */
window_relation_t window_ring(const polygon_ring_t *ring, const window_t *window);

/* ---- windows of up to 32 pixels: what is covered, as bits of one word; pixel (x, y) is bit (y - top) * width + x - left ---- */

#define WINDOW_MASK_PX 32

TUILE_INLINE int32_t window_area(const window_t *window) { return (window->right - window->left) * (window->bottom - window->top); }

/* All pixels of a window. */
TUILE_INLINE uint32_t window_mask_full(const window_t *window) { return 0xffffffffu >> (WINDOW_MASK_PX - window_area(window)); }

/* Of a triangle, whose box is `box`. */
uint32_t window_mask_triangle(const window_side_t sides[3], const window_t *box, const window_t *window);

/* Of any polygon. */
uint32_t window_mask_ring(const polygon_ring_t *ring, const window_t *window);

/* What two windows share; right <= left or bottom <= top when that is nothing. */
TUILE_INLINE window_t window_cut(const window_t *a, const window_t *b) {
    return (window_t){a->left > b->left ? a->left : b->left, a->top > b->top ? a->top : b->top,
                      a->right < b->right ? a->right : b->right, a->bottom < b->bottom ? a->bottom : b->bottom};
}

/* The pixels whose centres lie in the bounding box, by the fill rule. */
window_t window_of_ring(const polygon_ring_t *ring);

#endif
