/* The scan-line z-buffer (S14): a line sweeps down the tile, and only what crosses it is there: one row of depth, and for each face
 * its active edge list (fill/active.h).
 *
 * What the method needs beside the colours of a tile, in bytes; w and h are the tile's width and height:
 *   tile memory   2 w, rounded up to 64, the depth of one line; 2 h, the buckets: faces by the row where they begin
 *   free room     24; 56 for each face that is active at once, 40 for each of its sides that the line crosses: 136 a triangle
 *
 * Faces and edges lie in a pool in the free room. Those active are a list in the order of their records, so that the first of
 * equals wins by coming first, as with the z-buffer: coverage, depth and light are the same numbers. Newcomers are merged into that
 * list while a line is drawn, and faces that end leave it.
 *
 * One column (strips): the active faces go on into the next row of tiles, as though the window had not been cut. Several columns:
 * the buckets stay as they are for the whole row of tiles, and each tile begins with an empty list; a face that began higher up
 * enters it on the tile's first row.
 */
#include "../tune.h"

#include "../fill/active.h"
#include "rows.h"

typedef struct face {
    uint32_t next;
    active_list_t edges;
    uint16_t record;
    uint16_t polygon;   /* depth is held between low and high */
    uint32_t value;     /* flat: colour; ids: id; gouraud: material */
    uint32_t low, high; /* of polygons */
    active_plane_t plane;
} face_t;
_Static_assert(sizeof(face_t) == 56, "what the method's memory is reckoned with");

/* At the start of the free room. */
typedef struct sweep {
    active_pool_t pool;
    uint32_t free_faces;
    uint32_t faces; /* active */
    uint32_t unused;
} sweep_t;
_Static_assert(sizeof(sweep_t) == 24, "what the method's memory is reckoned with");

TUILE_INLINE face_t *face_at(sweep_t *sweep, uint32_t offset) { return active_at(&sweep->pool, offset); }

static size_t line_bytes(const tuile_config_t *config) { return TUILE_ALIGN64(sizeof(uint16_t) * (size_t)config->tile_width); }

static uint16_t *buckets(const tuile_t *t) { return (uint16_t *)(void *)((uint8_t *)t->tile_memory + line_bytes(&t->config)); }

static size_t scanline_tile_bytes(const tuile_config_t *config) {
    return line_bytes(config) + sizeof(uint16_t) * (size_t)config->tile_height;
}

static size_t scanline_room_bytes(const tuile_config_t *config, uint32_t records) {
    (void)config;
    return sizeof(sweep_t) + records * sizeof(face_t);
}

/* A triangle's third side takes the place of the one that it follows on. */
static size_t scanline_face_bytes(uint32_t corners) { return (corners == 3 ? 2 : corners) * sizeof(active_edge_t); }

/* ---- faces ---- */

/* The corners of any face; three: room for them. */
static polygon_ring_t face_ring(const tuile_t *t, const record_t *record, uint8_t three[3]) {
    if (!frame_record_is_triangle(record)) { return frame_record_ring(t, record); }
    int32_t least = record->d1 < record->d2 ? record->d1 : record->d2;
    least = least < 0 ? least : 0;
    three[0] = (uint8_t)-least;
    three[1] = (uint8_t)(record->d1 - least);
    three[2] = (uint8_t)(record->d2 - least);
    return (polygon_ring_t){&t->vertices[record->v0 + least], three, NULL, 3};
}

static bool in_columns(const tuile_t *t, const record_t *record) {
    int32_t least = INT32_MAX, most = INT32_MIN;
    if (frame_record_is_triangle(record)) {
        const vertex_t *v0 = &t->vertices[record->v0];
        const int32_t x0 = v0->x, x1 = v0[record->d1].x, x2 = v0[record->d2].x;
        least = x0 < x1 ? (x0 < x2 ? x0 : x2) : (x1 < x2 ? x1 : x2);
        most = x0 > x1 ? (x0 > x2 ? x0 : x2) : (x1 > x2 ? x1 : x2);
    } else {
        const polygon_ring_t ring = frame_record_ring(t, record);
        for (uint32_t i = 0; i < ring.count; i++) {
            const int32_t x = polygon_ring_vertex(&ring, i)->x;
            least = x < least ? x : least;
            most = x > most ? x : most;
        }
    }
    return edge_row(least) < t->tile.right && edge_row(most) > t->tile.left;
}

static void face_end(sweep_t *sweep, uint32_t at) {
    active_drop(&sweep->pool, &face_at(sweep, at)->edges);
    active_give(&sweep->pool, &sweep->free_faces, at);
}

static bool triangle_begin(const tuile_t *t, sweep_t *sweep, face_t *face, const record_t *record, int32_t row) {
    const vertex_t *v0 = &t->vertices[record->v0], *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    face->polygon = false;
    triangle_shade(v0, v1, v2, t->span_kind == SPAN_GOURAUD, &face->plane.z, &face->plane.dx, &face->plane.dy);
    return active_begin_triangle(&sweep->pool, &face->edges, v0, v1, v2, &face->plane, row);
}

/* A list without sides when the polygon has no area. */
static bool polygon_begin(const tuile_t *t, sweep_t *sweep, face_t *face, const record_t *record, int32_t row) {
    const polygon_ring_t ring = frame_record_ring(t, record);
    depth_plane_t plane;
    face->polygon = true;
    face->edges = (active_list_t){0};
    if (!polygon_plane(&ring, &plane)) { return true; }
    face->plane = (active_plane_t){(uint64_t)plane.z, (uint64_t)plane.dx, (uint64_t)plane.dy};
    face->low = plane.low;
    face->high = plane.high;
    return active_begin(&sweep->pool, &face->edges, &ring, &face->plane, row);
}

/* Links the face of a record in at its first row in the tile. */
static TUILE_NOINLINE int sweep_face_start(tuile_t *t, sweep_t *sweep, uint32_t *link, uint32_t number, int32_t row) {
    const record_t *record = frame_record(t, number);
    if (t->tile_columns > 1 && !in_columns(t, record)) { return FRAME_OK; }
    const uint32_t at = active_take(&sweep->pool, &sweep->free_faces, sizeof(face_t));
    if (at == 0) { return FRAME_FULL; }
    face_t *face = face_at(sweep, at);
    t->stats.faces_setup++;
    face->record = (uint16_t)number;
    const bool fits =
        frame_record_is_triangle(record) ? triangle_begin(t, sweep, face, record, row) : polygon_begin(t, sweep, face, record, row);
    if (!fits) { return FRAME_FULL; }
    if (face->edges.first == 0) {
        face_end(sweep, at);
        return FRAME_OK;
    }
    face->value = t->span_kind == SPAN_GOURAUD && !face->polygon ? record->material : frame_value(t, record, number);
    face->next = *link;
    *link = at;
    return FRAME_OK;
}

/* A side begins or ends on `row`. False: the pool is full. */
static TUILE_NOINLINE bool face_change(const tuile_t *t, sweep_t *sweep, face_t *face, int32_t row) {
    uint8_t three[3];
    const polygon_ring_t ring = face_ring(t, frame_record(t, face->record), three);
    return active_change(&sweep->pool, &face->edges, &ring, &face->plane, row);
}

/* ---- spans ---- */

typedef struct line {
    uint16_t *depth;
    uint8_t *colour;
    int32_t left, right;
} line_t;

/* kind and last are constants in the loops that most frames are drawn by. */
TUILE_INLINE void span_draw(const line_t *line, const face_t *face, int32_t from, int32_t count, uint32_t z, uint32_t dx,
                            span_kind_t kind, bool last) {
    const int32_t at = from - line->left;
    if (kind == SPAN_IDS) {
        span_ids(line->depth + at, (uint32_t *)(void *)line->colour + at, count, z, dx, face->value, last);
    } else {
        span_flat(line->depth + at, (uint16_t *)(void *)line->colour + at, count, z, dx, (uint16_t)face->value, last);
    }
}

/* Where the plane leaves the range of the polygon's corners, pixel by pixel. */
static TUILE_NOINLINE void span_clamped(const line_t *line, const face_t *face, int32_t from, int32_t to, int64_t z,
                                        span_kind_t kind, bool last) {
    const int64_t low = face->low, high = face->high, dx = (int64_t)face->plane.dx;
    for (; from < to; from++, z += dx) {
        span_draw(line, face, from, 1, (uint32_t)(z < low ? low : z > high ? high : z), 0, kind, last);
    }
}

/* From one side to the next. */
TUILE_INLINE void sides_draw(tuile_t *t, const line_t *line, const face_t *face, const active_edge_t *a, const active_edge_t *b,
                             span_kind_t kind, bool last) {
    int32_t from = a->edge.x, to = b->edge.x;
    uint64_t z = a->z;
    if (TUILE_UNLIKELY(from < line->left)) {
        z += face->plane.dx * (uint64_t)(int64_t)(line->left - from);
        from = line->left;
    }
    if (to > line->right) { to = line->right; }
    if (from >= to) { return; }
    if (face->polygon) {
        const int64_t end = (int64_t)z + (int64_t)face->plane.dx * (to - from - 1), low = face->low, high = face->high;
        if (TUILE_LIKELY((int64_t)z >= low && (int64_t)z <= high && end >= low && end <= high)) {
            span_draw(line, face, from, to - from, (uint32_t)z, (uint32_t)face->plane.dx, kind, last);
        } else {
            span_clamped(line, face, from, to, (int64_t)z, kind, last);
        }
    } else if (kind == SPAN_GOURAUD) {
        const int32_t first = from - line->left;
        span_gouraud(line->depth + first, (uint16_t *)(void *)line->colour + first, to - from, z, face->plane.dx,
                     frame_ramp(t, face->value), last);
    } else {
        span_draw(line, face, from, to - from, (uint32_t)(z >> 32), (uint32_t)(face->plane.dx >> 32), kind, last);
    }
}

/* The document's "traiter les segments intersectés": entries two by two, those that have ended passed over. On every row an even
 * number is left. */
TUILE_INLINE void face_draw(tuile_t *t, sweep_t *sweep, const line_t *line, const face_t *face, int32_t row, span_kind_t kind,
                            bool last) {
    for (uint32_t at = face->edges.first; at;) {
        const active_edge_t *a = active_at(&sweep->pool, at), *b;
        at = a->next;
        if (a->row_end <= row) { continue; }
        do {
            b = active_at(&sweep->pool, at);
            at = b->next;
        } while (b->row_end <= row);
        sides_draw(t, line, face, a, b, kind, last);
    }
}

/* ---- the sweep ---- */

/* One row: newcomers merged in, all faces drawn and moved on to the next row. */
TUILE_INLINE int line_draw(tuile_t *t, sweep_t *sweep, const line_t *line, int32_t row, span_kind_t kind, bool last) {
    uint32_t newcomer = buckets(t)[row - t->tile.top], *link = &sweep->faces, active = 0;
    for (;;) {
        const uint32_t at = *link;
        face_t *face = face_at(sweep, at);
        if (TUILE_UNLIKELY(newcomer != RECORD_NONE) && (at == 0 || newcomer - 1 < face->record)) {
            const uint32_t number = newcomer - 1;
            newcomer = frame_record(t, number)->next;
            const int result = sweep_face_start(t, sweep, link, number, row);
            if (result != FRAME_OK) { return result; }
            continue;
        }
        if (at == 0) { break; }
        active++;
        active_edge_t *a = active_at(&sweep->pool, face->edges.first), *b = active_at(&sweep->pool, a->next);
        if (TUILE_LIKELY(b->next == 0 && row + 1 < face->edges.row_next)) { /* most faces on most rows */
            sides_draw(t, line, face, a, b, kind, last);
            active_step_two(&sweep->pool, &face->edges, &face->plane, a, b, row + 1);
            link = &face->next;
            continue;
        }
        face_draw(t, sweep, line, face, row, kind, last);
        if (row + 1 == face->edges.row_end) {
            *link = face->next;
            face_end(sweep, at);
            continue;
        }
        active_step(&sweep->pool, &face->edges, &face->plane, row + 1);
        if (TUILE_UNLIKELY(row + 1 == face->edges.row_next) && !face_change(t, sweep, face, row + 1)) { return FRAME_FULL; }
        link = &face->next;
    }
    if (active > t->stats.active_max) { t->stats.active_max = active; }
    return FRAME_OK;
}

TUILE_INLINE int lines_draw(tuile_t *t, sweep_t *sweep, span_kind_t kind, bool last) {
    line_t line = {t->tile_memory, t->tile.colour, t->tile.left, t->tile.right};
    const size_t width = (size_t)t->tile.stride_px, stride = width * frame_sample_bytes(t);
    for (int32_t row = t->tile.top; row < t->tile.bottom; row++, line.colour += stride) {
        if (buckets(t)[row - t->tile.top] == RECORD_NONE && sweep->faces == 0) { continue; }
        frame_fill_words(line.depth, 0, sizeof(uint16_t) * width);
        const int result = line_draw(t, sweep, &line, row, kind, last);
        if (result != FRAME_OK) { return result; }
    }
    return FRAME_OK;
}

static TUILE_NOINLINE int lines_gouraud(tuile_t *t, sweep_t *sweep) { return lines_draw(t, sweep, SPAN_GOURAUD, false); }
static TUILE_NOINLINE int lines_flat(tuile_t *t, sweep_t *sweep) { return lines_draw(t, sweep, SPAN_FLAT, false); }
static TUILE_NOINLINE int lines_any(tuile_t *t, sweep_t *sweep) {
    return lines_draw(t, sweep, t->span_kind, t->config.tie == TUILE_TIE_LAST);
}

static void sweep_empty(sweep_t *sweep, size_t room_bytes) {
    sweep->pool.top = sizeof(sweep_t);
    sweep->pool.limit = (uint32_t)room_bytes;
    sweep->pool.free_edges = sweep->free_faces = sweep->faces = 0;
}

/* ---- rows of tiles ---- */

/* Rows of tiles were left out: what is active above them goes into the list of those to be set up. */
static void sweep_release(tuile_t *t, sweep_t *sweep) {
    uint16_t list = RECORD_NONE, *end = &list;
    for (uint32_t at = sweep->faces; at; at = face_at(sweep, at)->next) {
        const uint16_t number = face_at(sweep, at)->record;
        *end = (uint16_t)(number + 1u);
        end = &frame_record(t, number)->next;
    }
    *end = RECORD_NONE;
    t->uncarried = list_merge(t, t->uncarried, list);
}

/* Moves the lists down to tile row `row`: t->uncarried has the faces without a state that began above it, and some that have ended.
 */
static void rows_leave(tuile_t *t, sweep_t *sweep, uint16_t row) {
    if (t->row == row) { return; }
    sweep_release(t, sweep);
    sweep->faces = 0;
    for (; t->row < row; t->row++) {
        if (t->row_ready) {
            for (uint32_t i = 0; i < t->config.tile_height; i++) {
                t->uncarried = list_merge(t, t->uncarried, buckets(t)[i]);
            }
        }
        t->row_ready = false;
        t->uncarried = list_merge(t, t->uncarried, list_reverse(t, t->buckets[t->row]));
        t->buckets[t->row] = RECORD_NONE;
    }
}

/* All faces of the tile row into the buckets of their first rows, each sorted. */
static void row_enter(tuile_t *t, int32_t top) {
    uint16_t *bucket = buckets(t), *end = &t->uncarried;
    for (uint32_t i = 0; i < t->config.tile_height; i++) {
        bucket[i] = RECORD_NONE;
    }
    for (uint16_t list = t->buckets[t->row], next; list != RECORD_NONE; list = next) { /* from the last record on */
        record_t *record = frame_record(t, list - 1u);
        int32_t first, row_end;
        frame_record_rows(t, record, &first, &row_end);
        uint16_t *of_row = &bucket[first > top ? first - top : 0];
        next = record->next;
        record->next = *of_row;
        *of_row = list;
    }
    t->buckets[t->row] = RECORD_NONE;
    while (*end != RECORD_NONE) {
        record_t *record = frame_record(t, *end - 1u);
        int32_t first, row_end;
        frame_record_rows(t, record, &first, &row_end);
        if (row_end > top) {
            end = &record->next;
        } else {
            *end = record->next;
        }
    }
    bucket[0] = list_merge(t, bucket[0], t->uncarried);
    t->uncarried = RECORD_NONE;
    t->row_ready = true;
}

static int scanline_draw_tile(tuile_t *t, uint16_t row) {
    size_t room_bytes;
    sweep_t *sweep = (sweep_t *)(void *)frame_room(t, &room_bytes);
    if (room_bytes < sizeof(sweep_t)) { return FRAME_FULL; }
    if (t->stream == t->stream_end) { sweep_empty(sweep, room_bytes); } /* the first tile of a pass */
    rows_leave(t, sweep, row);
    if (!t->row_ready) { row_enter(t, t->tile.top); }
    if (t->tile_columns > 1) { sweep_empty(sweep, room_bytes); }

    const bool any = t->span_kind == SPAN_IDS || t->config.tie == TUILE_TIE_LAST;
    const int result = any ? lines_any(t, sweep) : t->span_kind == SPAN_GOURAUD ? lines_gouraud(t, sweep) : lines_flat(t, sweep);
    if (result != FRAME_OK) { return result; }
    t->stream = (uint8_t *)sweep; /* what pass_measure counts */
    t->stream_end = t->stream + sweep->pool.top;
    if (t->tile_columns == 1) {
        t->row++;
        t->row_ready = false;
    } else {
        sweep->faces = 0; /* all of them are in the buckets */
    }
    return FRAME_OK;
}

const visibility_method_t visibility_scanline = {
    .tile_bytes = scanline_tile_bytes,
    .gather = bin_pass,
    .draw_tile = scanline_draw_tile,
    .room_bytes = scanline_room_bytes,
    .face_bytes = scanline_face_bytes,
};
