/* The tile z-buffer (S4, S13): 16 bits of depth per pixel of one tile, whatever the size of the window. Faces come in the order of
 * their records, so the first one wins a tie by coming first.
 */
#include "../tune.h"

#include "../assembly.h"
#include "../features.h"
#include "smalls_thumb.h"
#include "zbuffer_textured.h"

static size_t zbuffer_tile_bytes(const tuile_config_t *config) {
    return sizeof(uint16_t) * (size_t)config->tile_width * config->tile_height;
}

static void zbuffer_clear(tuile_t *t) {
    t->tile.depth = t->tile_memory;
    frame_fill_words(t->tile.depth, 0, (size_t)t->tile.stride_px * (size_t)(t->tile.bottom - t->tile.top) * sizeof(uint16_t));
}

/* By kind, which is a constant. */
TUILE_INLINE void smalls_of(tuile_t *t, walk_t *walk, uint32_t limit, small_kind_t kind) {
    if (ASSEMBLY_SMALL) {
        smalls_thumb(t, walk, limit, kind);
    } else {
        smalls_draw(t, walk, limit, kind);
    }
}

void smalls_plain(tuile_t *t, walk_t *walk, uint32_t limit) {
    if (t->span_kind == SPAN_GOURAUD) {
        smalls_of(t, walk, limit, SMALL_GOURAUD);
    } else {
        smalls_of(t, walk, limit, SMALL_FLAT);
    }
}

static void zbuffer_draw_now(tuile_t *t, uint32_t number) {
    if (TUILE_HAS(TEXTURES) && t->textured) {
        zbuffer_textured_now(t, number);
    } else {
        rows_draw_now(t, number, ROWS_TESTED);
    }
}

static int zbuffer_draw_tile(tuile_t *t, uint16_t row) {
    if (TUILE_HAS(TEXTURES) && t->textured) { return zbuffer_textured_tile(t, row); }
    rows_draw_tile(t, row, ROWS_TESTED);
    return FRAME_OK;
}

const visibility_method_t visibility_zbuffer = {
    .tile_bytes = zbuffer_tile_bytes,
    .gather = bin_pass,
    .clear = zbuffer_clear,
    .draw_now = zbuffer_draw_now,
    .draw_tile = zbuffer_draw_tile,
};
