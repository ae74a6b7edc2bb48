#include "stream.h"

#include <stdbool.h>
#include <stddef.h>

/* Both number their formats alike, so that neither has to include the other. */
#define SAME(format, wire) _Static_assert((int)(format) + 1 == (int)(wire), "the numbers of formats differ")
SAME(TUILE_RGB565_BE, TUILE_WIRE_RGB565);
SAME(TUILE_RGB565_LE, TUILE_WIRE_RGB565_LE);
SAME(TUILE_RGB444, TUILE_WIRE_RGB444);
SAME(TUILE_RGB666, TUILE_WIRE_RGB666);
SAME(TUILE_RGB332, TUILE_WIRE_RGB332);
SAME(TUILE_GREY8, TUILE_WIRE_GREY8);
SAME(TUILE_GREY4, TUILE_WIRE_GREY4);
SAME(TUILE_MONO_PAGES, TUILE_WIRE_MONO_PAGES);
SAME(TUILE_MONO_ROWS, TUILE_WIRE_MONO_ROWS);
SAME(TUILE_MONO_PAGES_TURNED, TUILE_WIRE_MONO_PAGES_TURNED);
SAME(TUILE_GREY4_TURNED, TUILE_WIRE_GREY4_TURNED);
SAME(TUILE_RGB111, TUILE_WIRE_RGB111);
SAME(TUILE_XRGB1111, TUILE_WIRE_XRGB1111);
SAME(TUILE_BGR888, TUILE_WIRE_BGR888);
SAME(TUILE_XRGB8888, TUILE_WIRE_XRGB8888);

uint8_t tuile_stream_format(const tuile_display_t *display) { return (uint8_t)(display->wire - 1u); }

/* A tile is whole pixels of its own, and so must be its window; ragged: but for the last tile. */
static bool aligned(uint16_t tile, uint16_t size, uint8_t align, bool ragged) {
    return tile % align == 0 ? ragged || tile >= size || size % align == 0 : tile >= size && (ragged || size % align == 0);
}

int tuile_stream_check(const tuile_config_t *config, const tuile_display_t *display) {
    if (config->format + 1u != display->wire || config->width != display->width || config->height != display->height) {
        return TUILE_ERROR_ARGUMENT;
    }
    return aligned(config->tile_width, config->width, display->align_x, display->wire == TUILE_WIRE_RGB444) &&
                   aligned(config->tile_height, config->height, display->align_y, false)
               ? TUILE_OK
               : TUILE_ERROR_ARGUMENT;
}

bool tuile_stream_one_window(const tuile_config_t *config, const tuile_display_t *display) {
    return display->context == &display->panel && config->format <= TUILE_RGB565_LE && config->tile_width == config->width &&
           config->row_end == config->height && config->tile_step == 1 && !(config->tile_first | config->row_first);
}

int tuile_stream_send(tuile_display_t *display, const tuile_tile_t *tile, bool one_window) {
    int result = TUILE_HAL_OK;

    if (!one_window || tile->y == 0) {
        result = tuile_display_window(display, tile->x, tile->y, tile->width, one_window ? display->height : tile->height);
    }
    return result ? result : tuile_display_queue(display, tile->bytes, (size_t)tile->size_bytes);
}

static int send_tile(tuile_display_t *display, const tuile_tile_t *tile, bool one_window) {
    const int result = tuile_stream_send(display, tile, one_window);

    return result ? result : 1;
}

/* tuile_next, once the buffer that it draws into is off the wire. Vertices do not wait for it, nor does the end of the frame. */
static int draw(tuile_t *renderer, tuile_display_t *display, tuile_tile_t *tile) {
    if (display->in_flight > 1) {
        int result = tuile_prepare(renderer);

        if (result <= 0 || (result = tuile_display_wait_one(display))) { return result; }
    }
    return tuile_next(renderer, tile);
}

/* The next tile that is wanted, as draw; *index is its number, and then the one behind it. */
static int next(tuile_t *renderer, tuile_display_t *display, const tuile_stream_hooks_t *hooks, uint32_t *index,
                tuile_tile_t *tile) {
    const tuile_config_t *config = tuile_config(renderer);
    const uint32_t columns = (config->width + config->tile_width - 1u) / config->tile_width;
    const uint32_t rows = (config->height + config->tile_height - 1u) / config->tile_height;
    const uint32_t from = *index;

    for (; *index < columns * rows; ++*index) {
        const uint32_t x = *index % columns * config->tile_width, y = *index / columns * config->tile_height;
        const uint32_t right = config->width - x, below = config->height - y;
        if (hooks->wanted(hooks->context, x, y, right < config->tile_width ? right : config->tile_width,
                          below < config->tile_height ? below : config->tile_height)) {
            const int result = *index == from ? TUILE_OK : tuile_seek(renderer, *index);
            ++*index;
            return result ? result : draw(renderer, display, tile);
        }
    }
    return 0;
}

int tuile_stream_tiles(tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display, const tuile_stream_hooks_t *hooks,
                       tuile_stats_t *stats) {
    const tuile_config_t *config = tuile_config(renderer);
    const bool flows = hooks->flow && display->lit;
    bool shown = !flows || !display->in_flight; /* the frame before */
    tuile_tile_t tile = {0};
    const bool one_window = !hooks->wanted && !hooks->send && tuile_stream_one_window(config, display);
    uint32_t index = 0;
    int result, waited, ended;

    if (stats) { *stats = (tuile_stats_t){0}; }
    if ((shown && (result = tuile_display_wait(display))) || (result = tuile_stream_check(config, display)) ||
        (result = tuile_begin(renderer, scene))) {
        if (!shown) { (void)tuile_display_wait(display); }
        return result;
    }
    if (hooks->begun) { hooks->begun(hooks->context, scene); }
    while ((result = hooks->wanted ? next(renderer, display, hooks, &index, &tile) : draw(renderer, display, &tile)) > 0) {
        /* The first tile has a buffer of its own once but one is on the wire, since a renderer takes them in turn from frame to
         * frame. */
        if (!shown && (result = tuile_display_present(display)) < 0) { break; }
        shown = true;
        result = hooks->send ? hooks->send(hooks->context, display, &tile) : send_tile(display, &tile, one_window);
        /* With one buffer the next tile overwrites this one, so there is nothing to overlap with. With two it overwrites the
         * one before, and that may still be on the wire if this one was not sent. */
        if (result == 0 || (result > 0 && config->buffers < 2)) { result = tuile_display_wait(display); }
        if (result < 0) { break; }
    }
    const bool leave = flows && result == 0 && display->in_flight;
    waited = leave ? TUILE_HAL_OK : tuile_display_wait(display); /* also after an error: the buffers must be the renderer's again */
    ended = tuile_end(renderer, stats);
    if (leave && ended == TUILE_OK) { return TUILE_OK; }
    if (leave) { waited = tuile_display_wait(display); }
    if (result < 0) { return result; }
    if (waited < 0) { return waited; }
    return ended < 0 ? ended : tuile_display_present(display);
}

int tuile_stream_frame(tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display, tuile_stats_t *stats) {
    static const tuile_stream_hooks_t none;

    return tuile_stream_tiles(renderer, scene, display, &none, stats);
}

int tuile_stream_flow(tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display, tuile_stats_t *stats) {
    static const tuile_stream_hooks_t flow = {.flow = true};

    return tuile_stream_tiles(renderer, scene, display, &flow, stats);
}

int tuile_stream_settle(tuile_display_t *display) { return tuile_display_present(display); }

const char *tuile_stream_error_text(int error) {
    return error <= TUILE_HAL_ARGUMENT ? tuile_hal_error_text(error) : tuile_error_text(error);
}
