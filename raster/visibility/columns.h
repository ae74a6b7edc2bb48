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

/* Into which column pixels go, without a division for each: pixel / width = (pixel * factor) >> shift, as far as windows reach
 * (2^11), since factor * width is above 2^22 by less than width. */
typedef struct columns_scale {
    uint32_t factor;
    unsigned shift;
} columns_scale_t;

static inline columns_scale_t columns_scale(uint32_t width) {
    if (width == 1) { return (columns_scale_t){1, 0}; } /* 2^22 times a pixel would be too large */
    return (columns_scale_t){((UINT32_C(1) << 22) + width - 1) / width, 22};
}
_Static_assert(TUILE_WINDOW_MAX_PX <= 1 << 11, "products of a pixel and a factor are below 2^32");

/* Of a list whose records come in their order, those up to record `limit` into the rings of the columns where they begin. Returns
 * the rest, whose first face is none of the limit, or not a small triangle. */
static inline uint16_t columns_enter(const tuile_t *t, uint16_t list, uint32_t limit) {
    const columns_scale_t scale = columns_scale(t->config.tile_width);
    uint16_t *const lists = columns_lists(t);
    uint8_t *const arena_end = t->arena_end;
    const vertex_t *const vertices = t->vertices;
    const uintptr_t record_bytes = t->record_bytes;
    const bool small = t->small;
    for (uintptr_t number = list; (uint32_t)number - 1u < limit;) {
        record_t *record = (record_t *)(void *)(arena_end - number * record_bytes);
        const vertex_t *v0 = vertices + record->v0, *v1 = v0 + record->d1, *v2 = v0 + record->d2;
        const uint16_t next = record->next;
        if (!frame_record_is_triangle(record) || (!small && !triangle_sides_short(v0, v1, v2))) { return (uint16_t)number; }
        int32_t least = v0->x < v1->x ? v0->x : v1->x;
        least = edge_row(least < v2->x ? least : v2->x);
        uint16_t *const ring = lists + (least > 0 ? ((uint32_t)least * scale.factor) >> scale.shift : 0);
        if (*ring == RECORD_NONE) {
            record->next = (uint16_t)number;
        } else {
            record_t *last = (record_t *)(void *)(arena_end - *ring * record_bytes);
            record->next = last->next;
            last->next = (uint16_t)number;
        }
        *ring = (uint16_t)number;
        number = list = next;
    }
    return list;
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
