/* The frame loop that sends only what has changed.
 *
 * Each tile is divided into cells of some pixels' width; of each cell a sum of 32 bits is kept. A cell whose sum is as it was is
 * not sent; neighbouring cells that are sent share a window, and a gap between two windows is sent along when that is cheaper on
 * the wire than a window of its own. With `changes`, tiles that nothing has moved in are not drawn at all.
 *
 * Two pictures of a cell may have one sum, with a chance of one in 2^32: full_every bounds how long that would stay to be seen. A
 * frame in which nearly all has changed gains nothing, so the sums are left out for some frames then: a flight through a
 * landscape costs what it costs without. */
#ifndef TUILE_FIRMWARE_UPDATE_H
#define TUILE_FIRMWARE_UPDATE_H

#include "../raster/scene/changes.h"
#include "stream.h"

/* Sums that are kept, of 4 bytes each. All numbers are pixels; tile_width as the renderer has it (its window's, if it was given as
 * 0), cell_width as below. */
#define TUILE_UPDATE_CELLS(width, height, tile_width, tile_height, cell_width)                          \
    ((((width) + (tile_width)-1u) / (tile_width)) * (((tile_width) + (cell_width)-1u) / (cell_width)) * \
     (((height) + (tile_height)-1u) / (tile_height)))

/* Zero = default, but for sums. Counters are of the last frame. */
typedef struct tuile_update {
    uint32_t *sums; /* the caller's, sum_count of them: TUILE_UPDATE_CELLS; whatever is in them at first */
    uint32_t sum_count;
    uint16_t cell_width;      /* pixels, a multiple of 8; 0 = the tile's width */
    uint16_t full_every;      /* frames from one that is sent whole to the next; 0 = only when the display asks for it */
    uint16_t window_bytes;    /* what a window of its own costs on the wire; 0 = 16 */
    tuile_changes_t *changes; /* the caller's; NULL = every tile is drawn */
    uint16_t overlay_x, overlay_y, overlay_width, overlay_height; /* with changes and an overlay: where that may draw something new;
                                                                     width 0 = anywhere */

    uint32_t cells, cells_sent, tiles_skipped, windows;
    uint32_t bytes_whole, bytes_sent; /* of pixels: of all tiles, of those sent */
    bool whole;                       /* the frame was sent whole */
    bool one_window;                  /* every tile of it was, into one window */

    const tuile_config_t *config; /* from here on: its own */
    tuile_display_t *display;
    uint32_t frames; /* since the last whole one */
    uint32_t cells_compared, cells_changed;
    uint16_t resting; /* frames for which no sums are made */
    uint8_t probes;   /* frames behind a rest that sum a part */
    bool probing;     /* this is one of them */
    bool valid;       /* what is on the glass is the frame before; sums of 0 tell nothing about it */
    bool summing;     /* this frame makes sums */
} tuile_update_t;

/* The next frame is sent whole. */
void tuile_update_forget(tuile_update_t *update);

/* tuile_stream_frame, of what has changed since the last call. When the display asks for a refresh, after errors too, the frame is
 * whole. TUILE_ERROR_ARGUMENT also when sum_count is too small or cell_width is no multiple of 8. */
int tuile_update_frame(tuile_update_t *update, tuile_t *renderer, const tuile_scene_t *scene, tuile_display_t *display,
                       tuile_stats_t *stats);

#endif
