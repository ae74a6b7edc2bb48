/* A tile, run by run. */
#include "../tune.h"

#include "resolve.h"

#include "../features.h"
#include "../frame/frame.h"

static void thresholds_make(resolve_run_t *run, bool dither, uint32_t x, uint32_t y) {
    for (uint32_t i = 0; i < RESOLVE_MATRIX; i++) {
        run->thresholds[i] = (dither ? 2u * resolve_bayer(x + i, y) + 1u : 64u) << 2u * run->shift;
    }
}

void resolve_tile(const tuile_t *t) {
    const pixel_kind_t kind = (pixel_kind_t)t->pixel_kind;
    const resolve_way_t way =
        !TUILE_HAS(SAMPLES) || t->samples == 0 ? resolve_single(kind, t->config.format) : resolve_mean(kind, t->config.format);
    const uint8_t *row = t->working;
    resolve_run_t run;
    run.shift = t->samples;
    run.stride = (size_t)t->tile.stride_px;
    run.width = (uint32_t)t->tile.stride_px >> run.shift;
    const uint32_t left = (uint32_t)t->tile.left >> run.shift, top = (uint32_t)t->tile.top >> run.shift;
    run.height = ((uint32_t)t->tile.bottom >> run.shift) - top;
    for (run.y = 0; run.y < run.height; run.y++, row += (run.stride << run.shift) * pixel_bytes(kind)) {
        thresholds_make(&run, t->given.dither, left, top + run.y);
        for (run.x = 0; run.x < run.width; run.x += RESOLVE_RUN) {
            run.count = run.width - run.x < RESOLVE_RUN ? run.width - run.x : RESOLVE_RUN;
            run.samples = row + ((size_t)run.x << run.shift) * pixel_bytes(kind);
            if (way.sum) { way.sum(&run); }
            way.put(&run, t->colours[t->next_buffer]);
        }
    }
}
