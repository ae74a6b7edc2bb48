/* What the frame loop sees: a display is a bus, a panel and a rotation.
 *
 * OWNERSHIP, the one rule: a buffer given to tuile_display_write belongs to the display until the next tuile_display_write or
 * tuile_display_wait returns. write waits for the write before it; so do all other calls that send something. A call that
 * returns an error leaves no buffer with the display.
 *
 * ERRORS. TUILE_HAL_ARGUMENT, _STATE and _UNSUPPORTED are about the call: nothing was sent and nothing has changed. Every
 * other error is about the world: the first one sticks, every later call but tuile_display_resume returns it and sends
 * nothing, and no call tries anything twice. As data may still be on its way when write returns, a fault may be reported by
 * the call after the one it befell, at the latest by tuile_display_wait or _present.
 * tuile_display_resume starts the panel again and asks for a full refresh. TUILE_HAL_GONE is final: the port must open its
 * device anew and tuile_display_init be called.
 *
 * A frame: window, write ... for each part of it, then present.
 */
#ifndef TUILE_HAL_DISPLAY_H
#define TUILE_HAL_DISPLAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "bus.h"
#include "panel.h"

/* Zero = default, throughout. Only read by tuile_display_init. */
typedef struct tuile_display_config {
    const tuile_bus_t *bus;      /* outlives the display */
    const tuile_panel_t *panel;  /* outlives the display */
    uint8_t rotation;            /* quarter turns clockwise, 0 ... 3 */
    uint8_t wire;                /* tuile_wire_t; one of the panel's formats */
    uint8_t brightness;          /* 1 ... 255; 0 = full */
    uint32_t command_clock_hz;   /* 0 = the panel's */
    uint32_t pixel_clock_hz;     /* 0 = the panel's usual one; may exceed what is rated */
    uint32_t tearing_timeout_ms; /* 0 = frames do not wait for the tearing-effect line */
} tuile_display_config_t;

/* Readable: width, height, refresh, error. The rest is the display's own. */
typedef struct tuile_display {
    uint16_t width, height; /* as the picture is seen: changed places at a quarter turn */
    bool refresh;           /* the glass may show anything: send every pixel. Set by init and resume, cleared by present */
    int error;              /* the error that sticks, or 0 */

    tuile_display_config_t config;
    tuile_panel_view_t view;
    uint32_t left_bytes; /* of the window, still to be written */
    uint8_t bits_per_pixel;
    uint8_t format_code;
    uint8_t unit_bytes; /* chunks are multiples of it */
    uint8_t brightness;
    bool in_flight; /* the bus may hold a buffer */
    bool in_frame;  /* a window has been set since the last present */
    bool lit;       /* the backlight is on */
    bool asleep;
} tuile_display_t;

/* Resets and initialises the panel, about 250 ms. The backlight stays dark until the first present, since the panel's memory
 * holds noise. An error of the world sticks (tuile_display_resume may try again); one of the arguments leaves a display that
 * refuses everything with TUILE_HAL_STATE. */
int tuile_display_init(tuile_display_t *display, const tuile_display_config_t *config);

/* Where the next pixels go: row by row, in the picture's own coordinates. 0 <= x, x + width <= display->width, likewise y;
 * multiples of the panel's alignment. The first window of a frame waits for the tearing-effect line if the display was told to. */
int tuile_display_window(tuile_display_t *display, uint32_t x, uint32_t y, uint32_t width, uint32_t height);

/* Sends pixels in wire order into the window, whole pixels, no more than fit into what is left of it. May return early, see
 * OWNERSHIP. size_bytes beyond the bus's chunk: all chunks but the last are waited for here. */
int tuile_display_write(tuile_display_t *display, const uint8_t *bytes, size_t size_bytes);

/* Returns when nothing is on the wire. */
int tuile_display_wait(tuile_display_t *display);

/* Ends a frame: waits, and lights the backlight if it is dark. TUILE_HAL_STATE when the last window was not filled. */
int tuile_display_present(tuile_display_t *display);

/* 0 dark ... 255 full; takes effect at once, or with the first present. TUILE_HAL_UNSUPPORTED when neither the bus has a
 * backlight line nor the panel a command. */
int tuile_display_brightness(tuile_display_t *display, uint8_t level);

/* Backlight off, panel asleep; then only tuile_display_resume is accepted. About 120 ms. */
int tuile_display_sleep(tuile_display_t *display);

/* After an error or sleep: forgets the error, resets and initialises the panel, sets refresh. About 250 ms, 370 ms without a
 * reset line. TUILE_HAL_GONE stays. */
int tuile_display_resume(tuile_display_t *display);

#endif
