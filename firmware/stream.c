#include "stream.h"

#include <stddef.h>

static int check(const tuile_config_t *config, const tuile_display_t *display) {
    const bool short_pixels = config->format == TUILE_RGB565_BE && display->config.wire == TUILE_WIRE_RGB565;
    const bool long_pixels = config->format == TUILE_RGB666 && display->config.wire == TUILE_WIRE_RGB666;
    if (!short_pixels && !long_pixels) { return TUILE_ERROR_ARGUMENT; }
    return config->width == display->width && config->height == display->height ? TUILE_OK : TUILE_ERROR_ARGUMENT;
}

static int send(tuile_display_t *display, const tuile_tile_t *tile, unsigned buffers) {
    int result = tuile_display_window(display, tile->x, tile->y, tile->width, tile->height);

    if (result == TUILE_HAL_OK) { result = tuile_display_write(display, tile->bytes, (size_t)tile->size_bytes); }
    /* With one buffer the next tile overwrites this one, so there is nothing to overlap with. */
    return result == TUILE_HAL_OK && buffers < 2 ? tuile_display_wait(display) : result;
}

int tuile_stream_frame(tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display, tuile_stats_t *stats) {
    const tuile_config_t *config = tuile_config(renderer);
    tuile_tile_t tile;
    int result, waited, ended;

    if (stats) { *stats = (tuile_stats_t){0}; }
    if ((result = tuile_display_wait(display)) || (result = check(config, display)) || (result = tuile_begin(renderer, scene))) {
        return result;
    }
    while ((result = tuile_next(renderer, &tile)) > 0) {
        if ((result = send(display, &tile, config->buffers)) < 0) { break; }
    }
    waited = tuile_display_wait(display); /* also after an error: the tile buffers must be the renderer's again */
    ended = tuile_end(renderer, stats);
    if (result < 0) { return result; }
    if (waited < 0) { return waited; }
    return ended < 0 ? ended : tuile_display_present(display);
}

const char *tuile_stream_error_text(int error) {
    return error <= TUILE_HAL_ARGUMENT ? tuile_hal_error_text(error) : tuile_error_text(error);
}
