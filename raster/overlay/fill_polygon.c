/* Polygons, by the coverage of faces: moved so that the tile's corner is the window's, and scaled to samples. */
#include "../fill/polygon.h"
#include "canvas.h"

#define POLYGON_RANGE (INT32_C(32767) * 16) /* of polygon_ring_t */

typedef struct polygon_target {
    const tuile_canvas_t *canvas;
    overlay_paint_t paint;
    tuile_box_t area;
} polygon_target_t;

static void put_span(void *context, int32_t row, int32_t first, int32_t end) {
    const polygon_target_t *target = context;
    overlay_run(target->canvas, &target->paint, target->area.left + first, target->area.top + row, end - first, COVERAGE_FULL);
}

/* Held before it is moved, so that it stands in the same place in every tile. */
static q28_4_t placed(q28_4_t at, unsigned shift, int32_t origin) {
    const int32_t most = (TUILE_WINDOW_MAX_PX + 1023) * 16;
    const int32_t held = at > most + TUILE_WINDOW_MAX_PX * 16 ? most + TUILE_WINDOW_MAX_PX * 16 : at < -most ? -most : at;
    return held * (1 << shift) - 16 * origin;
}

int tuile_draw_polygon(tuile_canvas_t *canvas, const q28_4_t (*points)[2], unsigned count, uint32_t colour) {
    q28_4_t corners[TUILE_POLYGON_CORNERS][2];
    polygon_chain_t chains[POLYGON_CHAINS];
    polygon_target_t target = {.canvas = canvas, .paint = overlay_paint(canvas, colour)};
    if (count > TUILE_POLYGON_CORNERS || (points == NULL && count > 0)) { return TUILE_ERROR_ARGUMENT; }
    if (!overlay_samples(canvas, &target.area)) { return TUILE_OK; }
    for (unsigned i = 0; i < count; i++) {
        corners[i][0] = placed(points[i][0], canvas->shift, target.area.left);
        corners[i][1] = placed(points[i][1], canvas->shift, target.area.top);
    }
    const polygon_ring_t ring = {.wide = corners, .count = count};
    polygon_coverage(&ring, target.area.right - target.area.left, target.area.bottom - target.area.top, chains, POLYGON_CHAINS,
                     put_span, &target);
    return TUILE_OK;
}
_Static_assert((INT32_C(2) * TUILE_WINDOW_MAX_PX + 1023) * 4 * 16 <= POLYGON_RANGE, "held points are in range in samples");
