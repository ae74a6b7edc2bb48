#include "../tune.h"

#include "paint.h"

#include "rows.h"

int paint_draw_tile(tuile_t *t, uint16_t row) {
    rows_draw_tile(t, row, false);
    return FRAME_OK;
}

void paint_draw_now(tuile_t *t, uint32_t number) { rows_draw_now(t, number, false); }

void paint_rectangle(tuile_t *t, uint32_t number, int32_t left, int32_t top, int32_t right, int32_t bottom) {
    const raster_tile_t tile = t->tile;
    int32_t first, end;
    frame_record_rows(t, frame_record(t, number), &first, &end);
    if (first >= bottom || end <= top) { return; }
    const size_t at = (size_t)(top - tile.top) * (size_t)tile.stride_px + (size_t)(left - tile.left);
    t->tile.colour = (uint8_t *)tile.colour + at * TUILE_FORMAT_BYTES(t->config.format);
    t->tile.left = left;
    t->tile.top = top;
    t->tile.right = right;
    t->tile.bottom = bottom;
    rows_draw_now(t, number, false);
    t->tile = tile;
}
