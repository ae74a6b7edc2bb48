/* The frame loop that boards and the simulator share: tiles from a renderer to a display. */
#ifndef TUILE_FIRMWARE_STREAM_H
#define TUILE_FIRMWARE_STREAM_H

#include "../hal/display.h"
#include "../raster/tuile.h"

/* The renderer's format (tuile_format_t) whose bytes an initialised display takes. */
uint8_t tuile_stream_format(const tuile_display_t *display);

/* Do a renderer's window, format and tiles go with the display? 0 or TUILE_ERROR_ARGUMENT, as tuile_stream_frame has it. */
int tuile_stream_check(const tuile_config_t *config, const tuile_display_t *display);

/* Does one window do for all tiles? Their rows run on in it when they are as wide as the display and of whole bytes, and it is
 * filled when none is left out. A device of its own may do more with a window than to set it. */
bool tuile_stream_one_window(const tuile_config_t *config, const tuile_display_t *display);

/* Sends a whole tile into a window of its own, or into the one of the frame, which the first tile opens: so its commands need not
 * go out between two tiles. 0 or a tuile_hal_error_t; tile->bytes may be on the wire then, and those of the tile before as well
 * where the display queues. */
int tuile_stream_send(tuile_display_t *display, const tuile_tile_t *tile, bool one_window);

/* Draws one frame and sends it. With two tile buffers (tuile_config_t.buffers) a tile is on the wire while the next is drawn. Where
 * the display queues and one window does, a tile that is drawn waits for the one on the wire by itself: drawing waits for a buffer
 * only. The renderer's window must be as large as the display, its format the display's (tuile_stream_format) and its tiles aligned
 * as the display's windows are, else TUILE_ERROR_ARGUMENT before anything is drawn.
 *
 * Returns 0, a tuile_error_t (-1 ... -31) from the renderer or a tuile_hal_error_t (-33 and below) from the display: the one
 * that came first. A display's error sticks in the display, so it is not lost behind a renderer's. Whatever happens, the
 * renderer is ended and no buffer is on the wire when the call returns. On success the whole frame is out and presented.
 * stats may be NULL; all zero when the frame was not begun. */
int tuile_stream_frame(tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display, tuile_stats_t *stats);

/* One of many frames: as tuile_stream_frame, but the last tile may still be on the wire when the call returns, or the last two, and
 * they go out while the next frame is prepared: in a row of such frames the wire rests only where it has nothing to send. The next
 * call of it, or tuile_stream_settle, waits for that tile, presents its frame, and returns its faults; until then neither the block
 * nor the display may be used otherwise, while scene and models may change. With one buffer, in a display's first frame and after
 * errors it is tuile_stream_frame. */
int tuile_stream_flow(tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display, tuile_stats_t *stats);

/* Behind the last frame of tuile_stream_flow: returns when all is out and presented. 0 or a tuile_hal_error_t. */
int tuile_stream_settle(tuile_display_t *display);

/* What a frame loop may do otherwise; NULL: as tuile_stream_frame does. */
typedef struct tuile_stream_hooks {
    void *context;
    /* After tuile_begin has accepted the scene, before anything is drawn. */
    void (*begun)(void *context, const tuile_scene_t *scene);
    /* Is this tile to be drawn at all? */
    bool (*wanted)(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height);
    /* Sends a tile, or not; its bytes are the hook's to change until they are on the wire. 1: it did; 0: it did not; or a
     * tuile_hal_error_t. */
    int (*send)(void *context, tuile_display_t *display, const tuile_tile_t *tile);
    bool flow; /* as tuile_stream_flow */
} tuile_stream_hooks_t;

/* tuile_stream_frame with hooks. */
int tuile_stream_tiles(tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display, const tuile_stream_hooks_t *hooks,
                       tuile_stats_t *stats);

/* One line of English about either kind of error; never NULL. */
const char *tuile_stream_error_text(int error);

#endif
