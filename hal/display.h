/* What the frame loop sees: a display is a panel on a bus, or a device with a controller of its own, and a rotation.
 *
 * OWNERSHIP, the one rule: a buffer given to tuile_display_write belongs to the display until the next tuile_display_write or
 * tuile_display_wait returns. write waits for the write before it; so do all other calls that send something, but for
 * tuile_display_queue: it may leave two buffers with the display, its own and that of the write before, which
 * tuile_display_wait_one then gives back. A call that returns an error leaves no buffer with the display.
 *
 * BYTES. Pixels are in wire order already, in the format that display->wire names, row by row of the window without gaps; a buffer
 * has no alignment but a byte's. A window of pixels smaller than a byte is made of whole bytes (align_x, align_y); but in RGB444,
 * whose rows run on, one that ends at the right edge may be of any width, and a half byte fills up what is left of its last.
 *
 * ERRORS. TUILE_HAL_ARGUMENT, _STATE and _UNSUPPORTED are about the call: nothing was sent and nothing has changed. Every
 * other error is about the world: the first one sticks, every later call but tuile_display_resume and _close returns it and sends
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
#include "device.h"
#include "panel.h"

/* Zero = default, throughout. Only read by tuile_display_init. */
typedef struct tuile_display_config {
    const tuile_bus_t *bus;                 /* a panel on a bus: both outlive the display */
    const TUILE_FLASH tuile_panel_t *panel; /* */

    const TUILE_FLASH tuile_device_t *device; /* or a device of its own (tuile_gud_device ...), */
    void *device_context;                     /* with its context: both outlive the display */

    uint8_t rotation;            /* quarter turns clockwise, 0 ... 3 */
    uint8_t wire;                /* tuile_wire_t; one of the panel's formats. At a quarter turn either name of it will do */
    uint8_t brightness;          /* 1 ... 255; 0 = full */
    bool identify;               /* the panel is asked who it is: TUILE_HAL_IDENTITY for another, _PROTOCOL if nobody answers */
    uint32_t command_clock_hz;   /* 0 = the panel's */
    uint32_t pixel_clock_hz;     /* 0 = the panel's usual one; may exceed what is rated */
    uint32_t tearing_timeout_ms; /* 0 = frames do not wait for the tearing-effect line */
} tuile_display_config_t;

/* Readable: the first block. The rest is the display's own. A display must not be moved: it is its own device's context. */
typedef struct tuile_display {
    uint16_t width, height;   /* as the picture is seen: changed places at a quarter turn */
    uint8_t align_x, align_y; /* windows begin and end at multiples of these */
    uint8_t wire;             /* tuile_wire_t of what is written: DEFAULT is resolved, quarter turns too */
    bool dimmable;            /* it has a brightness */
    bool refresh;             /* the glass may show anything: send every pixel. Set by init and resume, cleared by present */
    int error;                /* the error that sticks, or 0 */

    const TUILE_FLASH tuile_device_t *device; /* NULL: not initialised, or closed */
    void *context;
    tuile_panel_state_t panel; /* the context of a panel on a bus */
    uint32_t left_bytes;       /* of the window, still to be written */
    uint8_t brightness;
    uint8_t in_flight; /* buffers that the device may hold: 0 ... 2 */
    bool lit;          /* something has been shown since the start */
    bool asleep;
    bool queues; /* the device takes a write while it holds one; last, since the fields above are then near the beginning */
} tuile_display_t;

/* Resets and initialises the panel, about 250 ms. It stays dark until the first present, since its memory holds noise. An error
 * of the world sticks (tuile_display_resume may try again); one of the arguments leaves a display that refuses everything with
 * TUILE_HAL_STATE. */
int tuile_display_init(tuile_display_t *display, const tuile_display_config_t *config);

/* Where the next pixels go: row by row, in the picture's own coordinates. 0 <= x, x + width <= display->width, likewise y;
 * multiples of the display's alignment. The first window of a frame waits for the tearing-effect line if the display was told to.
 */
int tuile_display_window(tuile_display_t *display, uint32_t x, uint32_t y, uint32_t width, uint32_t height);

/* Sends pixels in wire order into the window, whole pixels, no more than fit into what is left of it. May return early, see
 * OWNERSHIP. size_bytes beyond the bus's chunk: all chunks but the last, or the last two in a queue, are waited for here. */
int tuile_display_write(tuile_display_t *display, const uint8_t *bytes, size_t size_bytes);

/* tuile_display_write that does not wait for the write before it, where bus and panel have a queue (tuile_bus_t.wait_one): these
 * bytes then follow by themselves. At most one waits for another, so a third waits for the first here. */
int tuile_display_queue(tuile_display_t *display, const uint8_t *bytes, size_t size_bytes);

/* Returns when nothing is on the wire. */
int tuile_display_wait(tuile_display_t *display);

/* Returns when at most the buffer given last is with the display. */
int tuile_display_wait_one(tuile_display_t *display);

/* Ends a frame: waits, and lets it be seen if it is the first. TUILE_HAL_STATE when the last window was not filled. */
int tuile_display_present(tuile_display_t *display);

/* 0 dark ... 255 full; takes effect at once, or with the first present. TUILE_HAL_UNSUPPORTED when neither the bus has a
 * backlight line nor the panel a command. */
int tuile_display_brightness(tuile_display_t *display, uint8_t level);

/* Backlight off, panel asleep; then only tuile_display_resume is accepted. About 120 ms. */
int tuile_display_sleep(tuile_display_t *display);

/* After an error or sleep: forgets the error, resets and initialises the panel, sets refresh. About 250 ms, 370 ms without a
 * reset line. TUILE_HAL_GONE stays. */
int tuile_display_resume(tuile_display_t *display);

/* Leaves the panel dark and asleep, whatever errors there were before, unless the device is gone or sleeps already; then the
 * display refuses everything with TUILE_HAL_STATE. The bus or device is the caller's to close. Returns what putting it to sleep
 * came to. For the end of a program, signals included. */
int tuile_display_close(tuile_display_t *display);

#endif
