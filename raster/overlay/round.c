/* Discs, rings, arcs and rounded rectangles. */
#include "canvas.h"

/* ---- arcs ----
 *
 * With the unit vector (cos, sin) of an angle, c = cos dy - sin dx tells how far a sample at (dx, dy) from the centre is beyond the
 * ray, clockwise. Let a be the coverage of what is beyond `from` and b that of what is not beyond `to`. The slice is both of them,
 * or, from half a turn on, any of them; where both edges may pass through one sample, up to a quarter of a turn, a + b - 16. The
 * rest of the turn is covered by exactly as much as the slice leaves. */

typedef struct wedge {
    int32_t from[2], to[2]; /* cos, sin; Q2.30 */
    uint16_t sweep;
    bool crisp;
} wedge_t;

/* Crisp: within half a turn clockwise of a ray, the ray included. */
static bool beyond(const int32_t ray[2], int32_t dx, int32_t dy) {
    const int64_t across = (int64_t)ray[0] * dy - (int64_t)ray[1] * dx;
    return across > 0 || (across == 0 && (int64_t)ray[0] * dx + (int64_t)ray[1] * dy >= 0);
}

/* |dx|, |dy| < 2^26: products below 2^56. */
static unsigned beyond_soft(const int32_t ray[2], int32_t dx, int32_t dy) {
    return soft_edge((int32_t)(((int64_t)ray[0] * dy - (int64_t)ray[1] * dx) >> 30));
}

static unsigned wedge_coverage(const wedge_t *wedge, int32_t dx, int32_t dy) {
    if (wedge->crisp) {
        const bool a = beyond(wedge->from, dx, dy), b = !beyond(wedge->to, dx, dy);
        return (wedge->sweep <= 0x8000u ? a && b : a || b) ? COVERAGE_FULL : 0;
    }
    const unsigned a = beyond_soft(wedge->from, dx, dy), b = COVERAGE_FULL - beyond_soft(wedge->to, dx, dy);
    if (wedge->sweep <= 0x4000u) { return a + b > COVERAGE_FULL ? a + b - COVERAGE_FULL : 0; }
    if (wedge->sweep <= 0x8000u) { return a < b ? a : b; }
    if (wedge->sweep < 0xc000u) { return a > b ? a : b; }
    return a + b < COVERAGE_FULL ? a + b : COVERAGE_FULL;
}

/* ---- rings ---- */

typedef struct ring {
    int32_t x, y, inner, outer; /* 1/32 sample */
    const wedge_t *wedge;       /* NULL: all round */
} ring_t;

static void ring_put(soft_pen_t *pen, const ring_t *ring, int32_t dy, int32_t x, int32_t end, unsigned coverage) {
    if (ring->wedge == NULL) {
        soft_put(pen, x, end, coverage);
        return;
    }
    if (x < pen->area.left) { x = pen->area.left; }
    if (end > pen->area.right) { end = pen->area.right; }
    for (; x < end; x++) {
        const unsigned part = wedge_coverage(ring->wedge, 32 * x + 16 - ring->x, dy);
        if (part > 0) { soft_put(pen, x, x + 1, (coverage * part + COVERAGE_FULL / 2) / COVERAGE_FULL); }
    }
}

static bool span_has(soft_span_t span, int32_t x) { return span.first <= x && x < span.end; }

/* From left to right: where the coverage is known for a whole span it goes there, else sample by sample. */
static void ring_row(soft_pen_t *pen, const ring_t *ring) {
    const bool crisp = pen->canvas->crisp;
    const int32_t soft = crisp ? 0 : 15, dy = 32 * pen->y + 16 - ring->y;
    const soft_span_t outer = soft_chord(ring->x, dy, ring->outer + soft), full = soft_chord(ring->x, dy, ring->outer - soft),
                      inner = soft_chord(ring->x, dy, ring->inner > 0 ? ring->inner + soft : -1),
                      hole = soft_chord(ring->x, dy, ring->inner > 0 ? ring->inner - soft : -1);
    int32_t x = outer.first > pen->area.left ? outer.first : pen->area.left;
    const int32_t end = outer.end < pen->area.right ? outer.end : pen->area.right;
    while (x < end) {
        int32_t next = x + 1;
        if (span_has(hole, x)) {
            next = hole.end;
        } else if (span_has(full, x) && !span_has(inner, x)) {
            next = x < inner.first && inner.first < full.end ? inner.first : full.end;
            ring_put(pen, ring, dy, x, next, COVERAGE_FULL);
        } else {
            const int64_t dx = 32 * x + 16 - ring->x, squared = dx * dx + (int64_t)dy * dy;
            const unsigned with = soft_disc(squared, ring->outer, crisp), without = soft_disc(squared, ring->inner, crisp);
            if (with > without) { ring_put(pen, ring, dy, x, next, with - without); }
        }
        x = next;
    }
    soft_flush(pen);
}

static void draw_ring(tuile_canvas_t *canvas, q28_4_t x, q28_4_t y, q28_4_t inner, q28_4_t outer, const wedge_t *wedge,
                      uint32_t colour) {
    const ring_t ring = {soft_length(canvas, x), soft_length(canvas, y), soft_length(canvas, inner), soft_length(canvas, outer),
                         wedge};
    const overlay_paint_t paint = overlay_paint(canvas, colour);
    soft_pen_t pen = {.canvas = canvas, .paint = &paint};
    if (ring.outer <= 0 || ring.outer <= ring.inner || !overlay_samples(canvas, &pen.area)) { return; }
    const int32_t top = (ring.y - ring.outer - 31) >> 5, bottom = ((ring.y + ring.outer + 15 - 16) >> 5) + 1;
    const int32_t end = bottom < pen.area.bottom ? bottom : pen.area.bottom;
    for (pen.y = top > pen.area.top ? top : pen.area.top; pen.y < end; pen.y++) {
        ring_row(&pen, &ring);
    }
}

void tuile_draw_disc(tuile_canvas_t *canvas, q28_4_t x, q28_4_t y, q28_4_t radius, uint32_t colour) {
    draw_ring(canvas, x, y, 0, radius, NULL, colour);
}

void tuile_draw_ring(tuile_canvas_t *canvas, q28_4_t x, q28_4_t y, q28_4_t inner, q28_4_t outer, uint32_t colour) {
    draw_ring(canvas, x, y, inner, outer, NULL, colour);
}

void tuile_draw_arc(tuile_canvas_t *canvas, q28_4_t x, q28_4_t y, q28_4_t inner, q28_4_t outer, bam16_t from, bam16_t to,
                    uint32_t colour) {
    const wedge_t wedge = {
        {tuile_cos(from), tuile_sin(from)}, {tuile_cos(to), tuile_sin(to)}, (uint16_t)(to - from), canvas->crisp};
    if (from != to) { draw_ring(canvas, x, y, inner, outer, &wedge, colour); }
}

/* ---- rounded rectangles ---- */

typedef struct rounded {
    int64_t left, top, right, bottom; /* samples */
    int32_t radius;
} rounded_t;

/* A corner's samples, `along` and `aside` of its two straight edges, 0 ... radius - 1. */
static unsigned corner_coverage(const soft_pen_t *pen, int32_t radius, int32_t along, int32_t aside) {
    const int64_t dx = 32 * (int64_t)(radius - along) - 16, dy = 32 * (int64_t)(radius - aside) - 16;
    return soft_disc(dx * dx + dy * dy, 32 * radius, pen->canvas->crisp);
}

static void rounded_row(soft_pen_t *pen, const rounded_t *r) {
    const int64_t from_top = pen->y - r->top, from_bottom = r->bottom - 1 - pen->y;
    const int64_t aside = from_top < from_bottom ? from_top : from_bottom;
    for (int64_t x = r->left > pen->area.left ? r->left : pen->area.left; x < r->right && x < pen->area.right;) {
        const int64_t from_left = x - r->left, from_right = r->right - 1 - x;
        const int64_t along = from_left < from_right ? from_left : from_right;
        int64_t next = x + 1;
        if (aside < r->radius && along < r->radius) {
            soft_put(pen, (int32_t)x, (int32_t)next, corner_coverage(pen, r->radius, (int32_t)along, (int32_t)aside));
        } else {
            next = aside < r->radius ? r->right - r->radius : r->right;
            next = next > pen->area.right ? pen->area.right : next;
            soft_put(pen, (int32_t)x, (int32_t)next, COVERAGE_FULL);
        }
        x = next;
    }
    soft_flush(pen);
}

void tuile_draw_rounded(tuile_canvas_t *canvas, int32_t x, int32_t y, int32_t width, int32_t height, int32_t radius,
                        uint32_t colour) {
    const int32_t most = (width < height ? width : height) / 2, scale = 1 << canvas->shift;
    const overlay_paint_t paint = overlay_paint(canvas, colour);
    soft_pen_t pen = {.canvas = canvas, .paint = &paint};
    tuile_box_t box;
    if (width <= 0 || height <= 0 || !overlay_cut(canvas, x, y, (int64_t)x + width, (int64_t)y + height, &box)) { return; }
    radius = radius > most ? most : radius < 0 ? 0 : radius;
    if (radius > SOFT_RANGE / 16) { radius = SOFT_RANGE / 16; }
    const rounded_t r = {(int64_t)x * scale, (int64_t)y * scale, ((int64_t)x + width) * scale, ((int64_t)y + height) * scale,
                         radius * scale};
    (void)overlay_samples(canvas, &pen.area);
    for (pen.y = box.top * scale; pen.y < box.bottom * scale; pen.y++) {
        rounded_row(&pen, &r);
    }
}
