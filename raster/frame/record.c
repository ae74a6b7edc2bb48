/* What the 8 bytes of a record stand for. */
#include "frame.h"

polygon_ring_t frame_record_ring(const tuile_t *t, const record_t *record) {
    const polygon_slot_t *slot = (const polygon_slot_t *)(const void *)&t->vertices[record->v0];
    return (polygon_ring_t){t->vertices + slot->base, slot->listed ? (const uint8_t *)(slot + 1) : NULL, NULL, slot->count};
}

void frame_record_rows(const tuile_t *t, const record_t *record, int32_t *first, int32_t *end) {
    int32_t top, bottom;
    if (frame_record_is_piece(record)) {
        const face_bounds_t *bounds = &frame_record_piece(t, record)->bounds;
        *first = bounds->top;
        *end = bounds->bottom;
        return;
    }
    if (frame_record_is_triangle(record)) {
        const vertex_t *v0 = &t->vertices[record->v0], *v1 = v0 + record->d1, *v2 = v0 + record->d2;
        top = v0->y;
        bottom = v1->y > v2->y ? v1->y : v2->y;
    } else {
        const polygon_ring_t ring = frame_record_ring(t, record);
        top = INT32_MAX;
        bottom = INT32_MIN;
        for (uint32_t i = 0; i < ring.count; i++) {
            const int32_t y = polygon_ring_vertex(&ring, i)->y;
            top = y < top ? y : top;
            bottom = y > bottom ? y : bottom;
        }
    }
    *first = edge_row(top);
    *end = edge_row(bottom);
}
