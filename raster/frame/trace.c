/* Telling those who watch which faces came to a tile. Made from the records alone, so that nothing on the way of the pixels knows
 * of it. */
#include "../visibility/piece.h"
#include "frame.h"

/* Of pixels first ... end - 1 of a row, those that a piece keeps. */
static void trace_piece(const tuile_t *t, const record_t *record, int32_t row, int32_t first, int32_t end) {
    const tuile_trace_t *trace = t->config.trace;
    uint32_t mask[PIECE_MASK_WORDS];
    t->method->piece_mask(t, record, row, first, end, mask);
    for (int32_t x = first; x < end; x++) {
        const int32_t from = x;
        while (x < end && piece_mask_bit(mask, x - first)) {
            x++;
        }
        if (x > from) { trace->span(trace->context, (unsigned)row, (unsigned)from, (unsigned)x); }
    }
}

static void trace_row(const tuile_t *t, const record_t *record, const polygon_ring_t *ring, int32_t row) {
    const tuile_trace_t *trace = t->config.trace;
    polygon_cursor_t cursor = {0, 0, false};
    while (polygon_crossing(ring, row, &cursor)) {
        int32_t first = cursor.x;
        if (!polygon_crossing(ring, row, &cursor)) { return; }
        int32_t end = cursor.x;
        first = first > t->tile.left ? first : t->tile.left;
        end = end < t->tile.right ? end : t->tile.right;
        if (first >= end) { continue; }
        if (frame_record_is_piece(record)) {
            trace_piece(t, record, row, first, end);
        } else {
            trace->span(trace->context, (unsigned)row, (unsigned)first, (unsigned)end);
        }
    }
}

void trace_face(tuile_t *t, uint32_t number) {
    const tuile_trace_t *trace = t->config.trace;
    const record_t *record = frame_record(t, number);
    const record_t face = frame_record_face(t, record);
    const int8_t corners[3] = {0, face.d1, face.d2};
    vertex_t triangle[3];
    polygon_ring_t ring = {triangle, NULL, NULL, 3};
    int32_t first, end;
    frame_record_rows(t, record, &first, &end);
    first = first > t->tile.top ? first : t->tile.top;
    end = end < t->tile.bottom ? end : t->tile.bottom;
    if (first >= end) { return; }
    if (frame_record_is_triangle(&face)) {
        for (unsigned i = 0; i < 3; i++) {
            triangle[i] = (&t->vertices[face.v0])[corners[i]];
        }
    } else {
        ring = frame_record_ring(t, &face);
    }
    if (trace->face) { trace->face(trace->context, number, t->span_kind == SPAN_IDS ? frame_record_id(record) : 0); }
    for (int32_t row = first; trace->span && row < end; row++) {
        trace_row(t, record, &ring, row);
    }
}

void trace_tile(tuile_t *t) {
    const tuile_trace_t *trace = t->config.trace;
    if (trace->tile) {
        trace->tile(trace->context, (unsigned)t->tile.left, (unsigned)t->tile.top, (unsigned)t->tile.right,
                    (unsigned)t->tile.bottom);
    }
    for (uint32_t number = 0; !t->immediate && number < t->record_count; number++) {
        trace_face(t, number);
    }
}
