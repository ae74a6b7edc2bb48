/* Lines: Bresenham's, and soft strokes. */
#include "../draw/line.h"
#include "canvas.h"

static int32_t hold(int32_t x, int32_t most) { return x > most ? most : x < -most ? -most : x; }

void tuile_draw_line(tuile_canvas_t *canvas, int32_t from_x, int32_t from_y, int32_t to_x, int32_t to_y, uint32_t colour) {
    const int32_t from[2] = {hold(from_x, LINE_RANGE), hold(from_y, LINE_RANGE)},
                  to[2] = {hold(to_x, LINE_RANGE), hold(to_y, LINE_RANGE)};
    const overlay_paint_t paint = overlay_paint(canvas, colour);
    tuile_box_t box;
    line_t line;
    if (!overlay_cut(canvas, canvas->tile.left, canvas->tile.top, canvas->tile.right, canvas->tile.bottom, &box)) { return; }
    const raster_tile_t tile = {.left = box.left, .top = box.top, .right = box.right, .bottom = box.bottom};
    for (bool left = line_start(&line, from, to, &tile); left;) {
        const tuile_box_t pixel = {line.x, line.y, line.x + 1, line.y + 1};
        overlay_fill(canvas, &paint, &pixel);
        left = line.count > 1;
        if (left) { line_step(&line); }
    }
}

/* ---- strokes ----
 *
 * All points at most `radius` from a segment from a to b. With d = b - a and p from a, those beside it have 0 <= d . p <= |d|^2 and
 * the distance |d x p| / |d|; the others are in a disc round an end. |d| is taken in 1/16 of a length, rounded down: a distance is
 * then too great by less than 1/512 of itself where a stroke is a sample long or longer. */

typedef struct stroke {
    int32_t a[2], d[2], radius; /* 1/32 sample; d below 2^26 */
    int64_t length_squared;     /* < 2^53 */
    int64_t length16;           /* 16 |d| < 2^31 */
} stroke_t;

static unsigned stroke_coverage(const stroke_t *s, int64_t px, int64_t py, bool crisp) {
    const int64_t along = s->d[0] * px + s->d[1] * py;
    if (along <= 0 || s->length_squared == 0) { return soft_disc(px * px + py * py, s->radius, crisp); }
    if (along >= s->length_squared) {
        px -= s->d[0], py -= s->d[1];
        return soft_disc(px * px + py * py, s->radius, crisp);
    }
    int64_t across = (s->d[0] * py - s->d[1] * px) * 16; /* < 2^57 */
    across = across < 0 ? -across : across;
    if (crisp) { return across <= s->radius * s->length16 ? COVERAGE_FULL : 0; }
    if (across <= (s->radius - 15) * s->length16) { return COVERAGE_FULL; }
    if (across > (s->radius + 15) * s->length16) { return 0; }
    return soft_edge(s->radius - (int32_t)((across + s->length16 - 1) / s->length16));
}

/* Samples that the band of the whole straight line may touch, within the box of the stroke. */
static soft_span_t stroke_span(const stroke_t *s, int32_t py) {
    const int32_t reach = s->radius + 16;
    int64_t low = (s->d[0] < 0 ? s->d[0] : 0) - reach, high = (s->d[0] > 0 ? s->d[0] : 0) + reach;
    int64_t centre = (int64_t)s->d[0] * py, dy = s->d[1];
    if (dy < 0) { centre = -centre, dy = -dy; }
    if (dy > 0) {
        const int64_t half = reach * (s->length16 / 16 + 1);
        const int64_t from = fixed_floor_div64(centre - half, dy), to = fixed_floor_div64(centre + half, dy) + 1;
        low = from > low ? from : low;
        high = to < high ? to : high;
    }
    return (soft_span_t){(int32_t)((s->a[0] + low - 16) >> 5), (int32_t)((s->a[0] + high - 16) >> 5) + 1};
}

static void stroke_row(soft_pen_t *pen, const stroke_t *s) {
    const int32_t py = 32 * pen->y + 16 - s->a[1];
    const soft_span_t span = stroke_span(s, py);
    int32_t x = span.first > pen->area.left ? span.first : pen->area.left;
    const int32_t end = span.end < pen->area.right ? span.end : pen->area.right;
    for (; x < end; x++) {
        soft_put(pen, x, x + 1, stroke_coverage(s, 32 * x + 16 - s->a[0], py, pen->canvas->crisp));
    }
    soft_flush(pen);
}

void tuile_draw_stroke(tuile_canvas_t *canvas, q28_4_t from_x, q28_4_t from_y, q28_4_t to_x, q28_4_t to_y, q28_4_t width,
                       uint32_t colour) {
    stroke_t s = {{soft_length(canvas, from_x), soft_length(canvas, from_y)},
                  {soft_length(canvas, to_x), soft_length(canvas, to_y)},
                  soft_length(canvas, width) / 2,
                  0,
                  0};
    const overlay_paint_t paint = overlay_paint(canvas, colour);
    soft_pen_t pen = {.canvas = canvas, .paint = &paint};
    if (s.radius <= 0 || !overlay_samples(canvas, &pen.area)) { return; }
    s.d[0] -= s.a[0], s.d[1] -= s.a[1];
    s.length_squared = (int64_t)s.d[0] * s.d[0] + (int64_t)s.d[1] * s.d[1];
    s.length16 = fixed_sqrt64((uint64_t)s.length_squared * 256u);
    const int32_t reach = s.radius + 16;
    const int32_t top = (s.a[1] + (s.d[1] < 0 ? s.d[1] : 0) - reach - 16) >> 5,
                  bottom = ((s.a[1] + (s.d[1] > 0 ? s.d[1] : 0) + reach - 16) >> 5) + 1;
    const int32_t end = bottom < pen.area.bottom ? bottom : pen.area.bottom;
    for (pen.y = top > pen.area.top ? top : pen.area.top; pen.y < end; pen.y++) {
        stroke_row(&pen, &s);
    }
}
