/* The callback of a tile. In a file of its own, so that builds without overlays have nothing else of them. */
#include "../frame/frame.h"
#include "overlay.h"

void overlay_tile(tuile_t *t) {
    const unsigned shift = t->samples;
    tuile_canvas_t canvas = {.samples = t->working ? t->working : t->colours[t->next_buffer],
                             .stride = t->tile.stride_px,
                             .width = t->given.width,
                             .height = t->given.height,
                             .kind = t->pixel_kind,
                             .shift = t->samples};
    canvas.tile = (tuile_box_t){t->tile.left >> shift, t->tile.top >> shift, t->tile.right >> shift, t->tile.bottom >> shift};
    canvas.clip = (tuile_box_t){0, 0, t->given.width, t->given.height};
    t->given.overlay(t->given.overlay_context, &canvas);
    t->stats.glyphs_missing += canvas.glyphs_missing;
}
