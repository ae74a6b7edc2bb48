/* The faces of a tile row in the order of their records, and what of them is carried from row to row. Two methods draw by it: the
 * z-buffer with tested spans, and whoever has put the records in the order of the painter, with painted ones. `tested` is a
 * constant wherever these functions are called, so that each gets loops of its own.
 *
 * A tile row meets those faces whose bucket it is and those carried from the row above. Both lists are sorted by record, so one
 * merge gives the order.
 *
 * One column (strips): a face is set up, drawn and, if it reaches beyond the strip, its state is written to the stream. The stream
 * is moved to the end of the free room first, so that the new one can grow where the old one was. Several columns: all faces of the
 * row enter the stream before the first tile is drawn; each tile draws from copies, so that tiles may come in any order. Behind the
 * last tile the states that reach further are moved on to the next row.
 */
#ifndef TUILE_VISIBILITY_ROWS_H
#define TUILE_VISIBILITY_ROWS_H

#include "../fill/small.h"
#include "../frame/textured.h"
#include "../memory.h"
#include "columns.h"

/* How a method draws its rows: `tested` below, a constant wherever these functions are called. */
enum {
    ROWS_PAINTED = false,
    ROWS_TESTED = true,
    ROWS_TEXTURED = 2, /* tested; and faces that may be drawn with their texture at once, are */
};

/* A state in the stream, seen as any of its kinds. */
typedef union state {
    fill_head_t head;
    triangle_t triangle;
    textured_t textured;
    polygon_t polygon;
} state_t;

/* Pieces of faces (piece.h), for painted rows only. The states are those of the whole face. */
bool piece_start(tuile_t *t, state_t *state, const record_t *record, uint32_t number, int32_t row);
bool piece_fill(tuile_t *t, state_t *state, const record_t *record);
bool piece_skip(const tuile_t *t, state_t *state, const record_t *record, int32_t row);

/* `face` has the corners, `record` the rest. */
TUILE_INLINE bool face_start(tuile_t *t, state_t *state, const record_t *face, const record_t *record, uint32_t number, int32_t row,
                             unsigned tested) {
    t->stats.faces_setup++;
    if (tested == ROWS_TEXTURED && frame_record_is_triangle(face) && textured_start(t, &state->textured, record, row)) {
        state->head.record = (uint16_t)number;
        return true;
    }
    if (TUILE_LIKELY(frame_record_is_triangle(face))) {
        const vertex_t *v0 = &t->vertices[face->v0], *v1 = v0 + face->d1, *v2 = v0 + face->d2;
        if (tested) {
            triangle_start(&state->triangle, v0, v1, v2, row, t->span_kind == SPAN_GOURAUD);
        } else {
            triangle_paint_start(&state->triangle, v0, v1, v2, row, t->span_kind == SPAN_GOURAUD);
        }
        state->head.size_bytes = triangle_state_bytes(state->triangle.is_short);
        state->triangle.value = t->span_kind == SPAN_GOURAUD ? record->material : frame_value(t, record, number);
    } else {
        const polygon_ring_t ring = frame_record_ring(t, face);
        if (!(tested ? polygon_start(&state->polygon, &ring, row) : polygon_paint_start(&state->polygon, &ring, row))) {
            return false;
        }
        state->polygon.value = frame_value(t, record, number);
        state->head.size_bytes = (uint16_t)((state->head.size_bytes + 7u) & ~7u);
    }
    state->head.record = (uint16_t)number;
    return true;
}

/* False when the face covers no row from `row` on. */
TUILE_INLINE bool state_start(tuile_t *t, state_t *state, const record_t *record, uint32_t number, int32_t row, unsigned tested) {
    if (!tested && TUILE_UNLIKELY(frame_record_is_piece(record))) { return piece_start(t, state, record, number, row); }
    return face_start(t, state, record, record, number, row, tested);
}

/* Draws what of the face lies in the tile. True when the face reaches below it. */
TUILE_INLINE bool state_fill(tuile_t *t, state_t *state, const record_t *record, unsigned tested) {
    const bool last = t->config.tie == TUILE_TIE_LAST;
    if (TUILE_LIKELY(frame_record_is_triangle(record))) {
        triangle_t *triangle = &state->triangle;
        if (tested == ROWS_TEXTURED && triangle->value == 0) {
            const textured_tile_t to = {t->working ? t->working : (uint16_t *)(void *)t->colours[t->next_buffer],
                                        t->pixel_kind == PIXEL_RGB565_BE};
            textured_fill(&state->textured, &t->tile, &to);
            return triangle->row < triangle->head.row_end;
        }
        if (tested == ROWS_TEXTURED && !t->numbered) { shade_open(t); }
        const uint16_t *ramp = t->span_kind == SPAN_GOURAUD ? frame_ramp(t, triangle->value) : NULL;
        if (tested) {
            triangle_fill(triangle, &t->tile, t->span_kind, last, ramp);
        } else {
            triangle_paint(triangle, &t->tile, t->span_kind, ramp);
        }
        return triangle->row < triangle->head.row_end;
    }
    if (!tested && record->d2 != 0) { return piece_fill(t, state, record); }
    if (tested == ROWS_TEXTURED && !t->numbered) { shade_open(t); }
    const polygon_ring_t ring = frame_record_ring(t, record);
    const span_kind_t kind = t->span_kind == SPAN_IDS ? SPAN_IDS : SPAN_FLAT;
    if (tested) {
        polygon_fill(&state->polygon, &ring, &t->tile, kind, last);
    } else {
        polygon_paint(&state->polygon, &ring, &t->tile, kind);
    }
    return state->polygon.row < state->head.row_end;
}

TUILE_INLINE bool face_skip(const tuile_t *t, state_t *state, const record_t *face, int32_t row) {
    if (frame_record_is_triangle(face)) {
        triangle_skip(&state->triangle, row);
        return state->triangle.row < state->head.row_end;
    }
    const polygon_ring_t ring = frame_record_ring(t, face);
    polygon_skip(&state->polygon, &ring, row);
    return state->polygon.row < state->head.row_end;
}

TUILE_INLINE bool state_skip(const tuile_t *t, state_t *state, int32_t row, unsigned tested) {
    const record_t *record = frame_record(t, state->head.record);
    if (!tested && TUILE_UNLIKELY(frame_record_is_piece(record))) { return piece_skip(t, state, record, row); }
    return face_skip(t, state, record, row);
}

static inline bool state_in_columns(const tuile_t *t, const state_t *state) {
    return state->head.left < t->tile.right && state->head.right > t->tile.left;
}

/* ---- lists of records ---- */

static inline uint16_t list_reverse(const tuile_t *t, uint16_t list) {
    uint32_t reversed = RECORD_NONE;
    for (uint32_t number = list, next; number != RECORD_NONE; number = next) {
        record_t *record = frame_record(t, number - 1u);
        next = record->next;
        record->next = (uint16_t)reversed;
        reversed = number;
    }
    return (uint16_t)reversed;
}

/* Both sorted, without a common record; so is the result. */
static inline uint16_t list_merge(const tuile_t *t, uint16_t a, uint16_t b) {
    if (a == RECORD_NONE || b == RECORD_NONE) { return a | b; }
    const uint16_t merged = a < b ? a : b;
    uint32_t from = merged, other = a < b ? b : a;
    for (;;) { /* `from` is the lesser one */
        uint16_t *next;
        do {
            next = &frame_record(t, from - 1u)->next;
            from = *next;
        } while (from - 1u < other - 1u); /* at its list's end it is none, and not less */
        *next = (uint16_t)other;
        if (from == RECORD_NONE) { return merged; }
        const uint32_t greater = from;
        from = other, other = greater;
    }
}

/* ---- rows of tiles ---- */

/* Walks the faces of the current row in order: those of `list` and those of the old stream. */
typedef struct walk {
    uint16_t list;          /* records to be set up */
    uint8_t *old, *old_end; /* states carried from above */
    uint8_t *out;           /* where the new stream grows */
    list_end_t left;        /* records that go on without a state */
    list_end_t right;       /* columns.h: those that the next column takes over */
} walk_t;

static inline void walk_begin(tuile_t *t, walk_t *walk) {
    uint8_t *limit = (uint8_t *)frame_record(t, t->record_count) + t->record_bytes; /* first byte of the last record */
    limit -= (uintptr_t)limit & 7u;
    const size_t size = (size_t)(t->stream_end - t->stream);
    walk->list = list_merge(t, list_reverse(t, t->buckets[t->row]), t->uncarried);
    t->buckets[t->row] = RECORD_NONE;
    walk->old = limit - size;
    walk->old_end = limit;
    if (size) { memmove(walk->old, t->stream, size); }
    walk->out = t->states;
    walk->left = walk->right = (list_end_t){RECORD_NONE, NULL};
}

static inline void walk_end(tuile_t *t, walk_t *walk) {
    t->stream = t->states;
    t->stream_end = walk->out;
    t->uncarried = walk->left.first;
}

/* Appends a state to the new stream; a record that finds no room there goes into the list of those without one. */
static inline void walk_keep(tuile_t *t, walk_t *walk, const state_t *state) {
    const size_t size = state->head.size_bytes;
    if ((size_t)(walk->old - walk->out) >= size) {
        if ((const uint8_t *)state != walk->out) { memmove(walk->out, state, size); }
        walk->out += size;
        return;
    }
    list_append(t, &walk->left, state->head.record);
    t->stats.faces_resumed++;
}

/* The next state in order, set up in `local` or lying in the old stream, and its record; NULL at the end. A state stays where it is
 * until the next call, since the new stream never overtakes the old one. */
TUILE_INLINE state_t *walk_next(tuile_t *t, walk_t *walk, state_t *local, int32_t row, const record_t **record, unsigned tested) {
    for (;;) {
        state_t *carried = (state_t *)(void *)walk->old;
        if (walk->list != RECORD_NONE && (walk->old == walk->old_end || walk->list - 1u < carried->head.record)) {
            const uint32_t number = walk->list - 1u;
            *record = frame_record(t, number);
            walk->list = (*record)->next;
            if (state_start(t, local, *record, number, row, tested)) { return local; }
            continue;
        }
        if (walk->old == walk->old_end) { return NULL; }
        walk->old += carried->head.size_bytes;
        *record = frame_record(t, carried->head.record);
        return carried;
    }
}

/* The paint of a record's face, whose ramp is that of the material. False: it cannot be drawn so. */
TUILE_INLINE bool small_prepare(tuile_t *t, const record_t *record, uint32_t number, small_kind_t kind, bool smooth,
                                const small_face_t *face, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                                small_paint_t *paint) {
    if (kind == SMALL_FLAT) {
        const uint32_t kept = paint->ramp ? paint->ramp[record->light] : 0;
        paint->value = (uint16_t)(TUILE_LIKELY(kept) ? kept : frame_value(t, record, number));
    } else if (kind == SMALL_TEXTURED) {
        const record_surface_t *extra = (const record_surface_t *)(const void *)record;
        if (TUILE_UNLIKELY(!textured_fits(t, record)) ||
            (!smooth && (extra->green != record->light || extra->blue != record->light))) {
            return false;
        }
        const small_corners_t *c = &face->corners;
        const textured_face_t textured =
            textured_face(t, record, v0, v1, v2, (int32_t)c->x1, (int32_t)c->y1, (int32_t)c->x2, (int32_t)c->y2);
        if (!textured_map_make(&paint->map, &t->textured_last, &textured, (int32_t)face->to_x, (int32_t)face->to_y & 15)) {
            return false;
        }
        paint->map.v += paint->map.dy * (uint32_t)(face->to_y >> 4);
    }
    return true;
}

/* small_fill of those that touch columns beside the tile; kind and smooth are no constants here. */
static TUILE_NOINLINE bool small_fill_clamped(const small_face_t *face, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2,
                                              const small_tile_t *tile, small_kind_t kind, bool smooth, uint8_t light,
                                              const small_paint_t *paint) {
    return small_fill(face, v0, v1, v2, tile, kind, smooth, light, paint, true);
}

/* Draws small triangles without a state, up to the next face that is not one, or to record `limit`. */
TUILE_INLINE void smalls_draw(tuile_t *t, walk_t *walk, uint32_t limit, small_kind_t kind) {
    small_tile_t tile = small_tile(&t->tile);
    const uint8_t *const arena_end = t->arena_end;
    const vertex_t *const vertices = t->vertices;
    const uintptr_t record_bytes = kind == SMALL_GOURAUD ? sizeof(record_t) : t->record_bytes;
    const unsigned known = t->tile_columns > 1 ? SMALL_IS_SHORT
                           : t->small          ? SMALL_IS_SHORT | SMALL_IS_INSIDE
                                               : 0; /* columns.h has none but those */
    const bool smooth = kind == SMALL_GOURAUD || (kind == SMALL_TEXTURED && t->config.shade == TUILE_GOURAUD);
    small_paint_t paint = {0};
    const uint32_t column = (uint32_t)t->tile.left / t->config.tile_width;
    uintptr_t list = walk->list;
    uint32_t count = 0;
    int32_t material = -1;
    if (kind == SMALL_TEXTURED) {
        paint.constants = textured_constants();
        tile.colour = (t->working ? (uint16_t *)t->working : (uint16_t *)(void *)t->colours[t->next_buffer]) - tile.depth;
    }
    for (; (uint32_t)list - 1u < limit; count++) { /* RECORD_NONE is not */
        const record_t *record = (const record_t *)(const void *)(arena_end - list * record_bytes);
        if (TUILE_UNLIKELY(!frame_record_is_triangle(record))) { break; }
        const uint32_t number = (uint32_t)list - 1u;
        const vertex_t *v0 = vertices + record->v0, *v1 = v0 + record->d1, *v2 = v0 + record->d2;
        small_face_t face;
        if (TUILE_UNLIKELY(!small_open(&face, v0, v1, v2, &tile, known))) { break; }
        if (kind != SMALL_TEXTURED && TUILE_UNLIKELY(record->material != material)) {
            material = record->material;
            paint.ramp = kind == SMALL_GOURAUD ? frame_ramp(t, record->material) : frame_flat_ramp(t, record->material);
        }
        if (!small_prepare(t, record, number, kind, smooth, &face, v0, v1, v2, &paint)) { break; }
        bool reaches;
        if (TUILE_LIKELY(known & SMALL_IS_INSIDE) || small_inside(&face.corners, &tile)) {
            reaches = small_fill(&face, v0, v1, v2, &tile, kind, smooth, record->light, &paint, false);
            list = record->next;
        } else { /* copies, so that here all stay in registers */
            const small_face_t beside = face;
            const small_tile_t on = tile;
            const small_paint_t in = paint;
            reaches = small_fill_clamped(&beside, v0, v1, v2, &on, kind, smooth, record->light, &in);
            list = record->next;
            if (t->tile_columns > 1) {
                columns_hand_on(t, number, column, (int32_t)tile.bottom, &walk->right, &walk->left);
                continue;
            }
        }
        if (reaches) { list_append(t, &walk->left, number); }
    }
    walk->list = (uint16_t)list;
    t->stats.faces_setup += count;
    if (kind == SMALL_TEXTURED && count) { t->textured_any = true; }
}

/* Whether the method draws small triangles so. */
TUILE_INLINE bool smalls_wanted(const tuile_t *t, unsigned tested) {
    return tested == ROWS_TEXTURED ? t->pixel_kind == PIXEL_RGB565_BE
                                   : tested == ROWS_TESTED && t->config.tie == TUILE_TIE_FIRST && t->span_kind != SPAN_IDS;
}

/* smalls_draw of the kinds of zbuffer.c, and of zbuffer_textured.c: one copy of each serves strips and columns. */
void smalls_plain(tuile_t *t, walk_t *walk, uint32_t limit);
void smalls_textured(tuile_t *t, walk_t *walk, uint32_t limit);

TUILE_INLINE void walk_smalls(tuile_t *t, walk_t *walk, uint32_t limit, unsigned tested) {
    if (tested == ROWS_TEXTURED) {
        const uint32_t number = walk->list - (uint32_t)1;
        if (number < limit && textured_fits(t, frame_record(t, number))) { smalls_textured(t, walk, limit); }
    } else {
        smalls_plain(t, walk, limit);
    }
}

static inline uint32_t stream_next(const uint8_t *at, const uint8_t *end) {
    return at == end ? UINT32_MAX : ((const state_t *)(const void *)at)->head.record;
}

/* All faces of the row through the only column. */
TUILE_INLINE void row_draw(tuile_t *t, int32_t top, unsigned tested) {
    const bool smalls = tested && smalls_wanted(t, tested);
    walk_t walk;
    state_t local, *state;
    const record_t *record;
    walk_begin(t, &walk);
    for (;;) {
        if (smalls) { walk_smalls(t, &walk, stream_next(walk.old, walk.old_end), tested); }
        state = walk_next(t, &walk, &local, top, &record, tested);
        if (state == NULL) { break; }
        if (state_fill(t, state, record, tested)) { walk_keep(t, &walk, state); }
    }
    walk_end(t, &walk);
}

/* All faces past the row, undrawn. */
TUILE_INLINE void row_pass_by(tuile_t *t, int32_t top, int32_t bottom, unsigned tested) {
    walk_t walk;
    state_t local, *state;
    const record_t *record;
    walk_begin(t, &walk);
    while ((state = walk_next(t, &walk, &local, top, &record, tested)) != NULL) {
        if (state_skip(t, state, bottom, tested)) { walk_keep(t, &walk, state); }
    }
    walk_end(t, &walk);
}

/* All faces of the row into the stream; small triangles into the columns' lists, where there are such. */
TUILE_INLINE void row_gather(tuile_t *t, int32_t top, unsigned tested) {
    walk_t walk;
    state_t local, *state;
    const record_t *record;
    walk_begin(t, &walk);
    if (tested && t->columned) { columns_begin(t); }
    for (;;) {
        if (tested && t->columned) { walk.list = columns_enter(t, walk.list, stream_next(walk.old, walk.old_end)); }
        state = walk_next(t, &walk, &local, top, &record, tested);
        if (state == NULL) { break; }
        walk_keep(t, &walk, state);
    }
    walk_end(t, &walk);
}

/* Draws a face that has no state. */
TUILE_INLINE void column_uncarried(tuile_t *t, uint32_t number, int32_t top, unsigned tested) {
    state_t local;
    const record_t *record = frame_record(t, number);
    if (state_start(t, &local, record, number, top, tested) && state_in_columns(t, &local)) {
        (void)state_fill(t, &local, record, tested);
    }
}

/* Draws from a copy of a state. */
TUILE_INLINE void column_carried(tuile_t *t, const state_t *carried, unsigned tested) {
    state_t local;
    if (!state_in_columns(t, carried)) { return; }
    const record_t *record = frame_record(t, carried->head.record);
    if (tested != ROWS_TEXTURED && TUILE_LIKELY(frame_record_is_triangle(record) && carried->triangle.is_short)) {
        memcpy(&local, carried, triangle_state_bytes(true));
    } else {
        memcpy(&local, carried, carried->head.size_bytes);
    }
    (void)state_fill(t, &local, record, tested);
}

/* The small triangles of a column, undrawn. */
static inline void column_pass_by(tuile_t *t, uint32_t column, int32_t bottom) {
    list_end_t right = {RECORD_NONE, NULL}, below = {RECORD_NONE, NULL};
    for (uint16_t list = list_merge(t, columns_take(t, column), *columns_right(t)); list != RECORD_NONE;) {
        const uint32_t number = list - 1u;
        list = frame_record(t, number)->next;
        columns_hand_on(t, number, column, bottom, &right, &below);
    }
    *columns_right(t) = right.first;
    *columns_below(t) = list_merge(t, *columns_below(t), below.first);
}

/* One of several columns, those before it having been drawn or passed by. The faces without a state are set up again for each. */
TUILE_INLINE void column_draw(tuile_t *t, int32_t top, unsigned tested) {
    const uint32_t column = (uint32_t)t->tile.left / t->config.tile_width;
    const uint8_t *at = t->stream;
    uint16_t list = t->uncarried;
    walk_t walk = {.list = RECORD_NONE};
    const bool columned = tested && t->columned;
    if (columned) {
        for (; *columns_next(t) < column; ++*columns_next(t)) {
            column_pass_by(t, *columns_next(t), t->tile.bottom);
        }
        *columns_next(t) = (uint16_t)(column + 1u);
        walk.list = list_merge(t, columns_take(t, column), *columns_right(t));
    }
    for (;;) {
        const uint32_t carried = stream_next(at, t->stream_end), uncarried = list - (uint32_t)1, /* NONE: UINT32_MAX */
            limit = carried < uncarried ? carried : uncarried;
        if (columned) { walk_smalls(t, &walk, limit, tested); }
        if (walk.list - (uint32_t)1 < limit) { /* it has a number, or no texture that is drawn at once */
            const uint32_t number = walk.list - (uint32_t)1;
            walk.list = frame_record(t, number)->next;
            column_uncarried(t, number, top, tested);
            columns_hand_on(t, number, column, t->tile.bottom, &walk.right, &walk.left);
        } else if (limit == UINT32_MAX) {
            break;
        } else if (limit == carried) {
            column_carried(t, (const state_t *)(const void *)at, tested);
            at += ((const state_t *)(const void *)at)->head.size_bytes;
        } else {
            column_uncarried(t, uncarried, top, tested);
            list = frame_record(t, uncarried)->next;
        }
    }
    if (columned) {
        *columns_right(t) = walk.right.first;
        *columns_below(t) = list_merge(t, *columns_below(t), walk.left.first);
    }
}

/* Behind the last column: states move on to the next row, in place. */
TUILE_INLINE void row_advance(tuile_t *t, int32_t bottom, unsigned tested) {
    uint8_t *out = t->stream;
    for (uint8_t *at = t->stream; at < t->stream_end;) {
        state_t *state = (state_t *)(void *)at;
        const uint16_t size = state->head.size_bytes;
        at += size;
        if (state->head.row_end > bottom && state_skip(t, state, bottom, tested)) {
            if ((uint8_t *)state != out) { memmove(out, state, size); }
            out += size;
        }
    }
    t->stream_end = out;

    uint16_t kept = RECORD_NONE, *end = &kept;
    for (uint16_t list = t->uncarried; list != RECORD_NONE;) {
        const uint16_t number = list;
        record_t *record = frame_record(t, number - 1u);
        int32_t first, row_end;
        list = record->next;
        frame_record_rows(t, record, &first, &row_end);
        if (row_end > bottom) {
            *end = number;
            end = &record->next;
        }
    }
    *end = RECORD_NONE;
    t->uncarried = kept;
    if (!tested || !t->columned) { return; }
    for (uint32_t column = *columns_next(t); column < t->tile_columns; column++) {
        column_pass_by(t, column, bottom);
    }
    t->uncarried = list_merge(t, kept, *columns_below(t));
}

static inline int32_t row_top(const tuile_t *t, uint16_t row) { return row * t->config.tile_height; }

static inline int32_t row_bottom(const tuile_t *t, uint16_t row) {
    const int32_t bottom = row_top(t, row) + t->config.tile_height;
    return bottom < t->config.height ? bottom : t->config.height;
}

/* A face that goes away after the call. */
TUILE_INLINE void rows_draw_now(tuile_t *t, uint32_t number, unsigned tested) {
    state_t local;
    const record_t *record = frame_record(t, number);
    if (state_start(t, &local, record, number, t->tile.top, tested) && state_in_columns(t, &local)) {
        (void)state_fill(t, &local, record, tested);
    }
}

/* All faces of tile row `row` into the tile. */
TUILE_INLINE void rows_draw_tile(tuile_t *t, uint16_t row, unsigned tested) {
    while (t->row < row) {
        if (t->row_ready) {
            row_advance(t, row_bottom(t, t->row), tested);
            t->row_ready = false;
        } else {
            row_pass_by(t, row_top(t, t->row), row_bottom(t, t->row), tested);
        }
        t->row++;
    }
    if (t->tile_columns == 1) {
        row_draw(t, row_top(t, row), tested);
        t->row++;
        return;
    }
    if (!t->row_ready) {
        row_gather(t, row_top(t, row), tested);
        t->row_ready = true;
    }
    column_draw(t, row_top(t, row), tested);
}

#endif
