#include "../tune.h"

#include "paint.h"

#include "piece.h"
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
    t->tile.colour = (uint8_t *)tile.colour + at * frame_sample_bytes(t);
    t->tile.left = left;
    t->tile.top = top;
    t->tile.right = right;
    t->tile.bottom = bottom;
    rows_draw_now(t, number, false);
    t->tile = tile;
}

/* ---- pieces ---- */

bool piece_start(tuile_t *t, state_t *state, const record_t *record, uint32_t number, int32_t row) {
    const record_t face = frame_record_face(t, record);
    return face_start(t, state, &face, record, number, row, false);
}

bool piece_skip(const tuile_t *t, state_t *state, const record_t *record, int32_t row) {
    const record_t face = frame_record_face(t, record);
    return face_skip(t, state, &face, row);
}

/* Pixels left ... right - 1 of the state's row, which the state has behind it then. */
static void piece_run(tuile_t *t, const state_t *state, const record_t *face, int32_t row, int32_t left, int32_t right) {
    const raster_tile_t tile = t->tile;
    state_t local;
    memcpy(&local, state, state->head.size_bytes);
    const size_t at = (size_t)(row - tile.top) * (size_t)tile.stride_px + (size_t)(left - tile.left);
    t->tile.colour = (uint8_t *)tile.colour + at * frame_sample_bytes(t);
    t->tile.left = left;
    t->tile.top = row;
    t->tile.right = right;
    t->tile.bottom = row + 1;
    if (frame_record_is_triangle(face)) {
        const uint16_t *ramp = t->span_kind == SPAN_GOURAUD ? frame_ramp(t, local.triangle.value) : NULL;
        triangle_paint_any(&local.triangle, &t->tile, t->span_kind, ramp);
    } else {
        const polygon_ring_t ring = frame_record_ring(t, face);
        polygon_paint(&local.polygon, &ring, &t->tile, t->span_kind == SPAN_IDS ? SPAN_IDS : SPAN_FLAT);
    }
    t->tile = tile;
}

/* Row by row, run by run of the pixels that the cuts keep. */
bool piece_fill(tuile_t *t, state_t *state, const record_t *record) {
    const record_t face = frame_record_face(t, record);
    const face_bounds_t *bounds = &frame_record_piece(t, record)->bounds;
    const int32_t left = bounds->left > t->tile.left ? bounds->left : t->tile.left;
    const int32_t right = bounds->right < t->tile.right ? bounds->right : t->tile.right;
    const int32_t end = bounds->bottom < t->tile.bottom ? bounds->bottom : t->tile.bottom;
    bool more = face_skip(t, state, &face, bounds->top > t->tile.top ? bounds->top : t->tile.top);
    int32_t row = frame_record_is_triangle(&face) ? state->triangle.row : state->polygon.row;
    for (; more && row < end && left < right; row++) {
        uint32_t mask[PIECE_MASK_WORDS];
        piece_mask(t, record, row, left, right, mask);
        for (int32_t i = 0; i < right - left;) {
            int32_t from = i;
            while (i < right - left && piece_mask_bit(mask, i)) {
                i++;
            }
            if (i > from) { piece_run(t, state, &face, row, left + from, left + i); }
            i++;
        }
        more = face_skip(t, state, &face, row + 1);
    }
    return more && row < bounds->bottom && face_skip(t, state, &face, t->tile.bottom);
}
