/* The frame loop that boards and the simulator share: tiles from a renderer to a display. */
#ifndef TUILE_FIRMWARE_STREAM_H
#define TUILE_FIRMWARE_STREAM_H

#include "../hal/display.h"
#include "../raster/tuile.h"

/* The renderer's format (tuile_format_t) whose bytes an initialised display takes. */
uint8_t tuile_stream_format(const tuile_display_t *display);

/* Draws one frame and sends it. With two tile buffers (tuile_config_t.buffers) a tile is on the wire while the next is drawn.
 * The renderer's window must be as large as the display, its format the display's (tuile_stream_format) and its tiles aligned as
 * the display's windows are, else TUILE_ERROR_ARGUMENT before anything is drawn.
 *
 * Returns 0, a tuile_error_t (-1 ... -31) from the renderer or a tuile_hal_error_t (-33 and below) from the display: the one
 * that came first. A display's error sticks in the display, so it is not lost behind a renderer's. Whatever happens, the
 * renderer is ended and no buffer is on the wire when the call returns. On success the whole frame is out and presented.
 * stats may be NULL; all zero when the frame was not begun. */
int tuile_stream_frame(tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display, tuile_stats_t *stats);

/* One line of English about either kind of error; never NULL. */
const char *tuile_stream_error_text(int error);

#endif
