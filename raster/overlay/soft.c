/* Soft edges. A sample's coverage is told by the distance d of its centre from the edge alone: 16 steps across one sample, the k-th
 * where d reaches (2 k - 17) / 32 into the shape. Of circles squares are compared, four times where an edge passes; the rest of a
 * row is known from chords. */
#include "canvas.h"

static int64_t square(int64_t x) { return x * x; }

unsigned soft_disc(int64_t squared, int32_t radius, bool crisp) {
    unsigned coverage = 0;
    if (radius <= 0) { return 0; }
    if (crisp) { return squared <= square(radius) ? COVERAGE_FULL : 0; }
    if (radius >= 15 && squared <= square(radius - 15)) { return COVERAGE_FULL; }
    if (squared > square(radius + 15)) { return 0; }
    for (unsigned step = COVERAGE_FULL / 2; step > 0; step /= 2) {
        const int32_t least = radius + 17 - 2 * (int32_t)(coverage + step);
        if (least >= 0 && squared <= square(least)) { coverage += step; }
    }
    return coverage;
}

soft_span_t soft_chord(int32_t x, int64_t dy, int32_t radius) {
    if (radius < 0 || square(dy) > square(radius)) { return (soft_span_t){0, 0}; }
    const int32_t half = (int32_t)fixed_sqrt64((uint64_t)(square(radius) - square(dy)));
    return (soft_span_t){(x - half - 16 + 31) >> 5, ((x + half - 16) >> 5) + 1};
}

void soft_flush(soft_pen_t *pen) {
    if (pen->first < pen->end && pen->coverage > 0) {
        overlay_run(pen->canvas, pen->paint, pen->first, pen->y, pen->end - pen->first, pen->coverage);
    }
    pen->first = pen->end = 0;
}

void soft_put(soft_pen_t *pen, int32_t x, int32_t end, unsigned coverage) {
    if (x < pen->area.left) { x = pen->area.left; }
    if (end > pen->area.right) { end = pen->area.right; }
    if (x >= end) { return; }
    if (pen->first == pen->end || pen->end != x || pen->coverage != coverage) {
        soft_flush(pen);
        pen->first = x;
        pen->coverage = coverage;
    }
    pen->end = end;
}
