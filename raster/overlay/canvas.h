/* The inside of the overlay: areas of a tile, and colours put into its samples. */
#ifndef TUILE_OVERLAY_CANVAS_H
#define TUILE_OVERLAY_CANVAS_H

#include "../fixed.h"
#include "../pixel.h"
#include "overlay.h"

#define COVERAGE_FULL 16u /* sixteenths of a sample */

/* A colour, and what it is in the samples of the canvas. */
typedef struct overlay_paint {
    uint32_t argb, sample;
} overlay_paint_t;

/* overlay.c */
overlay_paint_t overlay_paint(const tuile_canvas_t *canvas, uint32_t argb);

/* What of pixels left ... right - 1, top ... bottom - 1 is in the tile and not clipped; false when nothing is. */
bool overlay_cut(const tuile_canvas_t *canvas, int64_t left, int64_t top, int64_t right, int64_t bottom, tuile_box_t *box);

/* Fills a box that overlay_cut has made. */
void overlay_fill(const tuile_canvas_t *canvas, const overlay_paint_t *paint, const tuile_box_t *box);

/* Samples x ... x + count - 1 of row y of the window, in the tile and not clipped: colour over what is there, with its alpha times
 * coverage / 16, rounded. */
void overlay_run(const tuile_canvas_t *canvas, const overlay_paint_t *paint, int32_t x, int32_t y, int32_t count,
                 unsigned coverage);

/* ---- soft edges: lengths in 1/32 sample, below 2^25 ---- */

#define SOFT_RANGE TUILE_OVERLAY_RANGE

/* What of the tile is not clipped, in samples; false: nothing. */
bool overlay_samples(const tuile_canvas_t *canvas, tuile_box_t *area);

/* 1/16 pixels to 1/32 samples: |result| <= 2^22 * 2 * 4. */
TUILE_INLINE int32_t soft_length(const tuile_canvas_t *canvas, q28_4_t length) {
    const int32_t held = length > SOFT_RANGE ? SOFT_RANGE : length < -SOFT_RANGE ? -SOFT_RANGE : length;
    return held * (2 << canvas->shift);
}

/* Sixteenths of coverage of a sample whose centre is `inside` within a straight edge, rounded down to 1/32 sample:
 * #{k = 1 ... 16: inside >= 2 k - 17}. */
TUILE_INLINE unsigned soft_edge(int32_t inside) { return inside >= 15 ? 16u : inside < -15 ? 0u : (unsigned)(inside + 17) / 2u; }

/* The same of a disc, by the square of the distance from its centre. crisp: inside or not. */
unsigned soft_disc(int64_t squared, int32_t radius, bool crisp);

/* Samples first ... end - 1 of a row. */
typedef struct soft_span {
    int32_t first, end;
} soft_span_t;

/* Those of a row whose centres are at most `radius` from x, the row's centres being dy off; empty for radius < 0. */
soft_span_t soft_chord(int32_t x, int64_t dy, int32_t radius);

/* Coverage of a row from left to right, put into the tile run by run. */
typedef struct soft_pen {
    const tuile_canvas_t *canvas;
    const overlay_paint_t *paint;
    tuile_box_t area;
    int32_t y, first, end;
    unsigned coverage;
} soft_pen_t;

/* Samples x ... end - 1 of row pen->y, cut to the area; x is not left of where the last ones ended. */
void soft_put(soft_pen_t *pen, int32_t x, int32_t end, unsigned coverage);

/* After each row. */
void soft_flush(soft_pen_t *pen);

#endif
