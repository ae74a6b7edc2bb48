/* Passes over bands of the window.
 *
 * A pass takes as many tile rows as its vertices and records find room for. It starts from what fitted last time; when the arena
 * overflows the band is halved and tried again, down to one tile row. When even that does not fit, each tile of the row is drawn in
 * a pass of its own: one in which faces are not kept but drawn as they come, which needs room for one cluster and one face only,
 * or, with methods that must see all faces of a tile at once, a narrow one over this tile alone. When that does not fit either, the
 * frame ends with TUILE_ERROR_MEMORY, and tuile_wanted tells what would be enough. Since depth, light and coverage of a face at a
 * pixel do not depend on where a pass begins, and faces come in the same order, the picture is the same in all cases.
 */
#include "frame.h"

#include "../assembly.h"
#include "../layer/layer.h"
#include "../visibility/columns.h"

/* column: of a narrow pass. */
static void pass_set(tuile_t *t, uint32_t first, uint32_t end, uint32_t column, bool narrow) {
    const tuile_config_t *c = &t->config;
    t->pass_first = (uint16_t)first;
    t->pass_end = (uint16_t)end;
    t->pass_column = (uint16_t)column;
    t->narrow = narrow;
    t->immediate = narrow && t->method->draw_now != NULL && !t->keep;
    t->draw_now = frame_deferred(t) ? shade_now : t->method->draw_now;
    t->region.top = (uint16_t)(first * c->tile_height);
    t->region.bottom = (uint16_t)(end * c->tile_height < c->height ? end * c->tile_height : c->height);
    t->region.left = (uint16_t)(narrow ? column * c->tile_width : 0);
    const uint32_t right = narrow ? (column + 1) * c->tile_width : c->width;
    t->region.right = (uint16_t)(right < c->width ? right : c->width);
}

static bool pass_covers(const tuile_t *t, uint32_t row, uint32_t column) {
    return t->pass_valid && row >= t->pass_first && row < t->pass_end && (!t->narrow || t->immediate || column == t->pass_column);
}

void pass_give_up(tuile_t *t, uint32_t slots) {
    const size_t bytes = frame_bytes_with(t, slots);
    if (bytes > t->passing_bytes) { t->passing_bytes = (uint32_t)bytes; }
}

void pass_reaches(tuile_t *t, const uint8_t *end) {
    const size_t used = TUILE_ALIGN8((size_t)(end - (const uint8_t *)t)); /* the last bytes of a block are used by eights only */
    /* What a method asks for may be a few bytes more than it takes: the block was large enough all the same. */
    const uint32_t enough = used < t->stats.size_bytes ? (uint32_t)used : t->stats.size_bytes;
    if (enough > t->stats.peak_bytes) { t->stats.peak_bytes = enough; }
}

void pass_measure(tuile_t *t, size_t carried_bytes) {
    const size_t kept = frame_bytes_with(t, t->vertex_count) + carried_bytes;
    pass_reaches(t, (const uint8_t *)t->vertices + (kept > t->passing_bytes ? kept : t->passing_bytes));
}

/* Small triangles in lists by column, where the method draws them so and there is room for the lists. */
static size_t columns_bytes(const tuile_t *t) {
    const size_t bytes = ((t->tile_columns + 3u) * sizeof(uint16_t) + 7u) & ~(size_t)7u;
    size_t room;
    (void)frame_room(t, &room);
    const bool wanted = t->tile_columns > 1 && !t->narrow && t->config.method == TUILE_ZBUFFER &&
                        t->config.tie == TUILE_TIE_FIRST && t->span_kind != SPAN_IDS && !frame_layers(t) &&
                        (!t->textured || t->pixel_kind == PIXEL_RGB565_BE);
    return wanted && room >= bytes ? bytes : 0;
}

static void rows_restart(tuile_t *t, uint32_t row) {
    const size_t lists = columns_bytes(t);
    t->row = (uint16_t)row;
    t->row_ready = false;
    t->columned = lists != 0;
    t->states = (uint8_t *)(t->vertices + t->vertex_count) + lists;
    t->stream = t->stream_end = t->states;
    t->uncarried = RECORD_NONE;
}

/* ---- what would be enough ---- */

/* Takes the place of draw_now: the block that would hold this face for the whole pass. */
static void count_face(tuile_t *t, uint32_t number) {
    const record_t *record = frame_record(t, number);
    uint32_t corners = 3, slots = 0;
    bool clipped = false;
    if (!frame_record_is_triangle(record)) {
        const polygon_ring_t ring = frame_record_ring(t, record);
        corners = ring.count;
        clipped = ring.corners == NULL;
        slots = 1 + corners + (corners + 7) / 8;
    } else if (record->v0 >= t->cluster_end) {
        clipped = true;
        slots = 3; /* vertices of its own */
    }
    if (clipped && frame_deferred(t)) {
        slots += SOURCE_SLOTS + corners * (uint32_t)(sizeof(clip_attributes_t) / sizeof(vertex_t));
    }
    t->wanted_bytes += t->record_bytes + slots * sizeof(vertex_t);
    if (t->method->face_bytes) { t->wanted_bytes += t->method->face_bytes(corners); }
    t->counted++;
}

/* Of a block with `more` bytes more, ramps and rows of layers take up to an eighth each, as long as they are not all there. */
static size_t with_larger_layout(const tuile_t *t, size_t more) {
    const bool rows = frame_layers(t) && t->layer_rows < t->config.tile_height;
    if (!t->ramps_few && !rows) { return more; }
    return (more + RAMP_FLAT_BYTES + (rows ? TUILE_LAYER_BYTES((size_t)t->config.tile_width, 1u) : 0) + 16) / 3 * 4;
}

/* A tile whose faces do not fit: counts them. */
static int pass_want(tuile_t *t, uint32_t row, uint32_t column) {
    const uint32_t vertices_before = t->stats.vertices, clusters_before = t->stats.clusters;
    const size_t size_bytes = t->stats.size_bytes;
    pass_set(t, row, row + 1, column, true);
    t->immediate = true;
    t->draw_now = count_face;
    t->counted = 0;
    t->wanted_bytes = (size_t)((uint8_t *)t->vertices - (uint8_t *)t) + 64;
    const int result = bin_pass(t);
    t->pass_valid = false;
    if (result < 0) { return result; }
    const size_t vertices = t->stats.vertices - vertices_before, clusters = t->stats.clusters - clusters_before;
    t->wanted_bytes += vertices * sizeof(vertex_t) + t->passing_bytes;
    if (frame_deferred(t)) { /* light: half a slot a vertex, rounded up */
        t->wanted_bytes += clusters * sizeof(source_slot_t) + (t->lamps != NULL ? vertices * 4 + clusters * 4 : 0);
    }
    if (t->method->room_bytes) { t->wanted_bytes += t->method->room_bytes(&t->config, t->counted); }
    t->wanted_bytes =
        size_bytes + (t->wanted_bytes > size_bytes ? with_larger_layout(t, t->wanted_bytes - size_bytes) : size_bytes / 8);
    return TUILE_ERROR_MEMORY;
}

/* ---- passes ---- */

/* A pass did not fit: the next one is tried with fewer rows, and in the end with one tile only. False when that has been tried. */
static bool pass_shrink(tuile_t *t) {
    t->pass_valid = false;
    if (t->narrow) { return false; }
    t->rows_hint = (uint16_t)((t->pass_end - t->pass_first) / 2);
    return t->rows_hint > 0 || (t->method->draw_now != NULL && !t->keep) || t->tile_columns > 1;
}

/* A pass that holds tile `column` of row `row`. */
static int pass_begin(tuile_t *t, uint32_t row, uint32_t column) {
    const uint32_t end = (uint32_t)(t->config.row_end + t->config.tile_height - 1) / t->config.tile_height;
    uint32_t rows;
    for (;;) {
        rows = t->immediate_only ? 0 : t->rows_hint;
        if (rows > end - row) { rows = end > row ? end - row : 1; }
        pass_set(t, row, row + (rows ? rows : 1), column, rows == 0);
        if (t->immediate) {
            t->pass_valid = true;
            return FRAME_OK; /* each tile runs its own */
        }
        const int result = t->method->gather(t);
        if (result < 0) { return result; }
        if (result == FRAME_OK) { break; }
        if (!pass_shrink(t)) { return pass_want(t, row, column); }
    }
    pass_measure(t, 0);
    /* What fitted with room to spare may be tried larger next time. */
    const size_t total = (size_t)t->vertex_limit * sizeof(vertex_t);
    const size_t used = t->vertex_count * sizeof(vertex_t) + (size_t)t->record_count * t->record_bytes;
    t->rows_hint = (uint16_t)rows;
    if (used <= total / 2 && !t->shrunk) {
        const uint32_t more = rows ? rows * 2 : 1;
        t->rows_hint = (uint16_t)(more > t->tile_rows ? t->tile_rows : more);
        if (t->pass_end < end) { pass_reaches(t, (const uint8_t *)t->vertices + 2 * used); }
    }
    t->pass_valid = true;
    rows_restart(t, row);
    return TUILE_OK;
}

/* ---- tiles ---- */

#if ASSEMBLY_THUMB2
#define STORE "stmia %0!, {r2, r3, r4, r5, r6, r8, r9, r12}\n\t"
#define STORES(text) \
    __asm__ volatile(text : "+r"(bytes) : "r"(a), "r"(b), "r"(c), "r"(d), "r"(e), "r"(f), "r"(g), "r"(h) : "memory")
/* Blocks of 64 bytes, two at a time: eight registers in one store. */
static void fill_blocks(void *bytes, uint32_t word, size_t blocks) {
    register uint32_t a __asm__("r2") = word, b __asm__("r3") = word, c __asm__("r4") = word, d __asm__("r5") = word;
    register uint32_t e __asm__("r6") = word, f __asm__("r8") = word, g __asm__("r9") = word, h __asm__("r12") = word;
    const char *const end = (char *)bytes + blocks * 64;
    if (blocks % 2) { STORES(STORE STORE); }
    while (bytes != end) {
        STORES(STORE STORE STORE STORE);
    }
}
#elif defined(__GNUC__) && defined(__thumb__)
/* Blocks of 64 bytes. Thumb stores several registers at once, which the compiler does not find. */
static void fill_blocks(void *bytes, uint32_t word, size_t blocks) {
    register uint32_t a __asm__("r2") = word, b __asm__("r3") = word, c __asm__("r4") = word, d __asm__("r5") = word;
    for (const char *const end = (char *)bytes + blocks * 64; bytes != end;) {
        __asm__ volatile("stmia %0!, {r2, r3, r4, r5}\n\tstmia %0!, {r2, r3, r4, r5}\n\t"
                         "stmia %0!, {r2, r3, r4, r5}\n\tstmia %0!, {r2, r3, r4, r5}"
                         : "+l"(bytes)
                         : "l"(a), "l"(b), "l"(c), "l"(d)
                         : "memory");
    }
}
#else
static void fill_blocks(void *bytes, uint32_t word, size_t blocks) {
    const uint64_t both = (uint64_t)word << 32 | word; /* two registers of a 32-bit machine go in one store */
    for (uint64_t *at = bytes; blocks; blocks--, at += 8) {
        at[0] = both, at[1] = both, at[2] = both, at[3] = both;
        at[4] = both, at[5] = both, at[6] = both, at[7] = both;
    }
}
#endif

TUILE_NOINLINE void frame_fill_words(void *bytes, uint32_t word, size_t size_bytes) {
    fill_blocks(bytes, word, (size_bytes + 63) / 64);
}

static void tile_clear(tuile_t *t) {
    const size_t pixels = (size_t)t->tile.stride_px * (size_t)(t->tile.bottom - t->tile.top);
    if (t->method->clear) { t->method->clear(t); }
    if (frame_deferred(t)) {
        shade_clear(t);
    } else {
        frame_fill_words(t->tile.colour, t->span_kind == SPAN_IDS ? 0 : t->background * 0x10001u, pixels * frame_sample_bytes(t));
    }
}

static void draw_now_traced(tuile_t *t, uint32_t number) {
    (frame_deferred(t) ? shade_now : t->method->draw_now)(t, number);
    trace_face(t, number);
}

static int draw_immediate(tuile_t *t, uint32_t row, uint32_t column) {
    pass_set(t, row, row + 1, column, true);
    tile_clear(t);
    if (t->config.trace) {
        trace_tile(t);
        t->draw_now = draw_now_traced;
    }
    const int result = t->method->gather(t);
    t->stats.tiles_narrow++;
    t->stats.peak_bytes = t->stats.size_bytes;
    if (result == FRAME_OK && frame_layers(t)) { return layer_tile(t); }
    return result > 0 ? TUILE_ERROR_MEMORY : result;
}

int pass_prepare(tuile_t *t, uint32_t row, uint32_t column) {
    return pass_covers(t, row, column) ? TUILE_OK : pass_begin(t, row, column);
}

int pass_draw(tuile_t *t, uint32_t row, uint32_t column) {
    for (;;) {
        const int error = pass_prepare(t, row, column);
        if (error) { return error; }
        if (t->immediate) { return draw_immediate(t, row, column); }
        if (row < t->row || (row == t->row && t->row_ready && t->columned && column < *columns_next(t))) {
            bin_again(t, (uint16_t)row);
            rows_restart(t, row);
        }
        tile_clear(t);
        const int result = t->method->draw_tile(t, (uint16_t)row);
        if (result <= 0) {
            if (t->config.trace) { trace_tile(t); }
            pass_measure(t, (size_t)(t->stream_end - t->stream) + (t->columned ? columns_bytes(t) : 0));
            t->stats.tiles_narrow += t->narrow;
            if (result == 0 && frame_deferred(t)) { shade_tile(t); }
            return result == 0 && frame_layers(t) ? layer_tile(t) : result;
        }
        t->shrunk = true;
        if (!pass_shrink(t)) { return pass_want(t, row, column); }
    }
}
