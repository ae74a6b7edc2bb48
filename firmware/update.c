#include "update.h"

#define WINDOW_BYTES 16u /* MIPI DCS: 11 bytes of commands, and what the pauses between them come to */
/* Frames without sums after one that had changed nearly everywhere. Two frames follow, one to know and one to compare, with sums of
 * one row of tiles in PROBED, which tell whether the rest is to go on. */
#define REST_FRAMES 20u
#define PROBED 4u

/* How the bytes of a tile lie: lines of so many bytes. Of turned formats lines run along y, so that cells are whole lines. */
typedef struct layout {
    uint32_t line_bytes, line_count;
    uint32_t step_bytes; /* from a column to the eighth after it */
    bool turned;
    bool solid; /* lines end in the middle of a byte: all or nothing */
} layout_t;

static layout_t layout_of(const tuile_tile_t *tile, uint8_t wire) {
    const uint32_t bits = tuile_wire_bits(wire); /* of a pixel, and so the bytes of eight */
    uint32_t lines = tile->height;

    if (wire == TUILE_WIRE_RGB444 && tile->width % 2u) { return (layout_t){tile->size_bytes, 1, .solid = true}; }
    if (wire == TUILE_WIRE_MONO_PAGES_TURNED || wire == TUILE_WIRE_GREY4_TURNED) {
        const uint32_t line_bytes = (bits * 8u * tile->height + 7u) / 8u;
        return (layout_t){line_bytes, (tile->width + 7u) / 8u, line_bytes, .turned = true};
    }
    if (wire == TUILE_WIRE_MONO_PAGES) { lines = (lines + 7u) / 8u; }
    return (layout_t){tile->size_bytes / lines, lines, wire == TUILE_WIRE_MONO_PAGES ? 8 : bits};
}

/* Bytes of a line, or of all lines where they are turned, up to a column: a multiple of 8, or the tile's width. */
static uint32_t place(const layout_t *layout, const tuile_tile_t *tile, uint32_t x) {
    return x < tile->width ? x / 8u * layout->step_bytes : layout->turned ? tile->size_bytes : layout->line_bytes;
}

/* Multiply and rotate, a word at a time where the bytes lie so; each step is a bijection of the sum. */
static uint32_t add(uint32_t sum, uint32_t word) {
    sum = (sum ^ word) * 0x9E3779B1u;
    return sum >> 15 | sum << 17;
}

static uint32_t word_at(const uint8_t *bytes) {
    uint32_t word;

    __builtin_memcpy(&word, __builtin_assume_aligned(bytes, 4), 4);
    return word;
}

/* Of lines that lie stride_bytes apart, `count` bytes each. A function of its own, for its registers: of all that is done for a
 * pixel that stays as it is, this takes most. */
__attribute__((noinline)) static uint32_t sum_lines(const uint8_t *bytes, uint32_t stride_bytes, uint32_t count, uint32_t lines) {
    const bool words = (((uintptr_t)bytes | stride_bytes) & 3u) == 0;
    uint32_t sum = 1;

    for (; lines > 0; lines--, bytes += stride_bytes) {
        const uint8_t *at = bytes, *const end = bytes + count;

        for (; words && end - at >= 16; at += 16) {
            sum = add(add(add(add(sum, word_at(at)), word_at(at + 4)), word_at(at + 8)), word_at(at + 12));
        }
        for (; words && end - at >= 4; at += 4) {
            sum = add(sum, word_at(at));
        }
        while (at < end) {
            sum = add(sum, *at++);
        }
    }
    return sum ? sum : 1; /* 0: not known */
}

static uint32_t sum_of(const layout_t *layout, const tuile_tile_t *tile, uint32_t from, uint32_t end) {
    const uint32_t first = place(layout, tile, from), count = place(layout, tile, end) - first;

    return sum_lines(tile->bytes + first, layout->line_bytes, count, layout->turned ? 1 : layout->line_count);
}

/* ---- windows --------------------------------------------------------------------------------------------------- */

/* Columns of a tile that go out together. */
typedef struct run {
    uint32_t from, end;
} run_t;

static uint32_t run_bytes(const layout_t *layout, const tuile_tile_t *tile, const run_t *run) {
    const uint32_t across = place(layout, tile, run->end) - place(layout, tile, run->from);

    return layout->turned ? across : across * layout->line_count;
}

static int open_window(tuile_update_t *update, const layout_t *layout, const tuile_tile_t *tile, const run_t *run) {
    update->windows++;
    update->bytes_sent += run_bytes(layout, tile, run);
    return tuile_display_window(update->display, tile->x + run->from, tile->y, run->end - run->from, tile->height);
}

/* Line by line, since the tile's other bytes are still wanted. */
static int send_lines(tuile_update_t *update, const layout_t *layout, const tuile_tile_t *tile, const run_t *run) {
    const uint32_t first = place(layout, tile, run->from), count = place(layout, tile, run->end) - first;
    int result = open_window(update, layout, tile, run);

    if (layout->turned) { return result ? result : tuile_display_write(update->display, tile->bytes + first, count); }
    for (uint32_t line = 0; result == TUILE_HAL_OK && line < layout->line_count; line++) {
        result = tuile_display_write(update->display, tile->bytes + (size_t)line * layout->line_bytes + first, count);
    }
    return result;
}

/* The last of a tile: moved together first, so that it goes out by itself while the next tile is drawn. */
static int send_last(tuile_update_t *update, const layout_t *layout, const tuile_tile_t *tile, const run_t *run) {
    const uint32_t first = place(layout, tile, run->from), count = place(layout, tile, run->end) - first;
    int result;

    if (layout->turned) { return send_lines(update, layout, tile, run); }
    if ((result = tuile_display_wait(update->display)) || (result = open_window(update, layout, tile, run))) { return result; }
    if (count < layout->line_bytes) {
        for (uint32_t line = 0; line < layout->line_count; line++) {
            __builtin_memmove(tile->bytes + (size_t)line * count, tile->bytes + (size_t)line * layout->line_bytes + first, count);
        }
    }
    return tuile_display_write(update->display, tile->bytes, (size_t)count * layout->line_count);
}

/* Is what lies between two runs cheaper to send than another window? */
static bool bridges(const tuile_update_t *update, const layout_t *layout, const tuile_tile_t *tile, const run_t *run,
                    uint32_t from) {
    const run_t gap = {run->end, from};

    return run_bytes(layout, tile, &gap) <= (update->window_bytes ? update->window_bytes : WINDOW_BYTES);
}

static uint32_t cell_width(const tuile_update_t *update) {
    return update->cell_width && update->cell_width < update->config->tile_width ? update->cell_width : update->config->tile_width;
}

/* The sum of the tile's first cell. */
static uint32_t *sums_of(const tuile_update_t *update, const tuile_tile_t *tile) {
    const tuile_config_t *c = update->config;
    const uint32_t columns = (c->width + c->tile_width - 1u) / c->tile_width;
    const uint32_t cells = (c->tile_width + cell_width(update) - 1u) / cell_width(update);

    return update->sums + (size_t)((uint32_t)tile->y / c->tile_height * columns + (uint32_t)tile->x / c->tile_width) * cells;
}

/* Whether a cell is to be sent; its sum is kept. */
static bool changed(tuile_update_t *update, const layout_t *layout, const tuile_tile_t *tile, const run_t *cell, uint32_t *sum) {
    const bool summing = update->summing && (!update->probing || (uint32_t)tile->y / update->config->tile_height % PROBED == 0);
    const uint32_t before = *sum;

    update->cells++;
    *sum = summing ? sum_of(layout, tile, cell->from, cell->end) : 0;
    update->cells_compared += summing && before != 0;
    update->cells_changed += summing && before != 0 && *sum != before;
    return update->whole || !summing || *sum != before;
}

static int send(void *context, tuile_display_t *display, const tuile_tile_t *tile) {
    tuile_update_t *update = context;
    const layout_t layout = layout_of(tile, display->wire);
    const uint32_t step = layout.solid ? tile->width : cell_width(update);
    uint32_t *sum = sums_of(update, tile);
    run_t run = {0, 0};
    int result = TUILE_HAL_OK;

    update->bytes_whole += tile->size_bytes;
    for (uint32_t from = 0; from < tile->width && result == TUILE_HAL_OK; from += step, sum++) {
        const run_t cell = {from, tile->width - from < step ? tile->width : from + step};
        if (!changed(update, &layout, tile, &cell, sum)) { continue; }
        update->cells_sent++;
        if (run.end > 0 && cell.from > run.end && !bridges(update, &layout, tile, &run, cell.from)) {
            result = send_lines(update, &layout, tile, &run);
            run.from = cell.from;
        } else if (run.end == 0) {
            run.from = cell.from;
        }
        run.end = cell.end;
    }
    if (update->one_window) {
        update->windows += tile->y == 0;
        update->bytes_sent += tile->size_bytes;
        result = tuile_stream_send(display, tile, true);
    } else if (result == TUILE_HAL_OK && run.end > 0) {
        result = send_last(update, &layout, tile, &run);
    }
    return result ? result : run.end > 0;
}

/* ---- tiles ----------------------------------------------------------------------------------------------------- */

static bool in_overlay(const tuile_update_t *update, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    if (!update->config->overlay) { return false; }
    if (update->overlay_width == 0) { return true; }
    return x < (uint32_t)update->overlay_x + update->overlay_width && update->overlay_x < x + width &&
           y < (uint32_t)update->overlay_y + update->overlay_height && update->overlay_y < y + height;
}

static bool touched(const tuile_update_t *update, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    return !update->changes || update->whole || tuile_changes_touch(update->changes, x, y, width, height) ||
           in_overlay(update, x, y, width, height);
}

static bool wanted(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    tuile_update_t *update = context;

    if (update->one_window || touched(update, x, y, width, height)) { return true; }
    update->tiles_skipped++;
    update->bytes_whole += width * height * tuile_wire_bits(update->display->wire) / 8u;
    return false;
}

/* Is every strip of the frame sent, and all of it? */
static bool goes_whole(const tuile_update_t *update) {
    const tuile_config_t *c = update->config;
    bool all = update->whole || !update->summing;

    for (uint32_t y = 0; all && y < c->height; y += c->tile_height) {
        const uint32_t below = c->height - y;
        all = touched(update, 0, y, c->width, below < c->tile_height ? below : c->tile_height);
    }
    return all;
}

static void begun(void *context, const tuile_scene_t *scene) {
    tuile_update_t *update = context;

    if (update->changes) { tuile_changes_next(update->changes, scene); }
    update->one_window = tuile_stream_one_window(update->config, update->display) && goes_whole(update);
}

/* ---- frames ---------------------------------------------------------------------------------------------------- */

void tuile_update_forget(tuile_update_t *update) { update->valid = false; }

/* What this frame is to be. */
static void plan(tuile_update_t *update, const tuile_display_t *display) {
    const bool due = update->full_every && update->frames >= update->full_every;

    update->cells = update->cells_sent = update->tiles_skipped = update->windows = 0;
    update->cells_compared = update->cells_changed = 0;
    update->bytes_whole = update->bytes_sent = 0;
    update->summing = update->resting == 0;
    if (!update->summing && --update->resting == 0) { update->probes = 2; }
    update->probing = update->summing && update->probes != 0;
    if (update->probing) { update->probes--; }
    for (uint32_t i = 0; i < update->sum_count && !update->valid; i++) {
        update->sums[i] = 0;
    }
    update->whole = !update->valid || display->refresh || due;
    update->frames = update->whole ? 1 : update->frames + 1;
    update->valid = false; /* until the frame is out */
}

static bool nearly_all(const tuile_update_t *update) {
    return update->cells_compared != 0 && (update->probing || update->cells_compared == update->cells) &&
           update->tiles_skipped == 0 && update->cells_changed >= update->cells_compared - update->cells_compared / 8u;
}

int tuile_update_frame(tuile_update_t *update, tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display,
                       tuile_stats_t *stats) {
    const tuile_stream_hooks_t hooks = {.context = update, .begun = begun, .wanted = wanted, .send = send};
    const tuile_config_t *c = tuile_config(renderer);
    int result;

    update->config = c;
    update->display = display;
    if (stats) { *stats = (tuile_stats_t){0}; }
    if (!update->sums || update->cell_width % 8u || c->tile_width == 0 || c->tile_height == 0 ||
        update->sum_count < TUILE_UPDATE_CELLS((uint32_t)c->width, (uint32_t)c->height, (uint32_t)c->tile_width,
                                               (uint32_t)c->tile_height, cell_width(update))) {
        return TUILE_ERROR_ARGUMENT;
    }
    plan(update, display);
    result = tuile_stream_tiles(renderer, scene, display, &hooks, stats);
    if (result) {
        if (update->changes) { tuile_changes_forget(update->changes); }
        return result;
    }
    update->valid = true;
    if (nearly_all(update)) { update->resting = REST_FRAMES; }
    return TUILE_OK;
}
