/* Several columns of tiles: small triangles by the column where they are drawn next. They have no state (fill/small.h): each tile
 * sets those of its own column up again, and hands on what reaches farther right, or below.
 *
 * The lists stand behind the vertices of the pass, before the states: one for each column, as the last record of a ring; then, from
 * the first record on, those that reach below the row, and those that the next column takes over; then that column's number. A
 * record is in one list at a time, since it has one `next`.
 */
#ifndef TUILE_VISIBILITY_COLUMNS_H
#define TUILE_VISIBILITY_COLUMNS_H

#include "../frame/frame.h"

static inline uint16_t *columns_lists(const tuile_t *t) { return (uint16_t *)(void *)(t->vertices + t->vertex_count); }
static inline uint16_t *columns_below(const tuile_t *t) { return columns_lists(t) + t->tile_columns; }
static inline uint16_t *columns_right(const tuile_t *t) { return columns_lists(t) + t->tile_columns + 1; }
static inline uint16_t *columns_next(const tuile_t *t) { return columns_lists(t) + t->tile_columns + 2; }

/* No face of the row in any of them yet. */
static inline void columns_begin(const tuile_t *t) {
    for (unsigned i = 0; i < t->tile_columns + 3u; i++) {
        columns_lists(t)[i] = 0; /* RECORD_NONE, and column 0 */
    }
}

/* Records in a list from the first to the last one. */
typedef struct list_end {
    uint16_t first, *end;
} list_end_t;

TUILE_INLINE void list_append(const tuile_t *t, list_end_t *list, uint32_t number) {
    record_t *record = frame_record(t, number);
    record->next = RECORD_NONE;
    *(list->end ? list->end : &list->first) = (uint16_t)(number + 1u);
    list->end = &record->next;
}

/* Behind all records of the column where it begins. Records come in their order. False: the face is not a small triangle. */
static inline bool columns_enter(const tuile_t *t, uint32_t number) {
    record_t *record = frame_record(t, number);
    if (!frame_record_is_triangle(record)) { return false; }
    const vertex_t *v0 = &t->vertices[record->v0], *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    if (!t->small && !triangle_sides_short(v0, v1, v2)) { return false; }
    int32_t least = v0->x < v1->x ? v0->x : v1->x;
    least = edge_row(least < v2->x ? least : v2->x);
    uint16_t *ring = &columns_lists(t)[least > 0 ? (uint32_t)least / t->config.tile_width : 0];
    if (*ring == RECORD_NONE) {
        record->next = (uint16_t)(number + 1u);
    } else {
        record_t *last = frame_record(t, *ring - 1u);
        record->next = last->next;
        last->next = (uint16_t)(number + 1u);
    }
    *ring = (uint16_t)(number + 1u);
    return true;
}

/* The ring of a column as a list; it is empty then. */
static inline uint16_t columns_take(const tuile_t *t, uint32_t column) {
    uint16_t *ring = &columns_lists(t)[column];
    if (*ring == RECORD_NONE) { return RECORD_NONE; }
    record_t *last = frame_record(t, *ring - 1u);
    const uint16_t first = last->next;
    last->next = RECORD_NONE;
    *ring = RECORD_NONE;
    return first;
}

/* A small triangle behind a tile of the column: on to the next one, or to those that reach below row `bottom` - 1. */
static inline void columns_hand_on(const tuile_t *t, uint32_t number, uint32_t column, int32_t bottom, list_end_t *right,
                                   list_end_t *below) {
    const record_t *record = frame_record(t, number);
    const vertex_t *v0 = &t->vertices[record->v0], *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    int32_t most = v0->x > v1->x ? v0->x : v1->x;
    most = edge_row(most > v2->x ? most : v2->x);
    if (column + 1u < t->tile_columns && most > (int32_t)((column + 1u) * t->config.tile_width)) {
        list_append(t, right, number);
    } else if (edge_row(v1->y > v2->y ? v1->y : v2->y) > bottom) {
        list_append(t, below, number);
    }
}

#endif
