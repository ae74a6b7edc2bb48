/* What stands behind a display: a panel on a bus (panel.h), or a device with a controller of its own, as on USB.
 *
 * hal/display.c checks the calls, keeps the first error and the frame's state; a device only does. It is called in this order:
 * describe and start; then window, write ... (all of the window), for each part of a frame, and show. wait comes before anything
 * that follows a write; before another write wait_one does, if the device queues. After an error nothing but start, sleep or
 * describe is called. Results are 0 or a tuile_hal_error_t. */
#ifndef TUILE_HAL_DEVICE_H
#define TUILE_HAL_DEVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct tuile_display_config;

/* The display as the picture sees it. */
typedef struct tuile_view {
    uint16_t width, height;   /* pixels */
    uint8_t align_x, align_y; /* windows begin and end at multiples of these; >= 1 */
    uint8_t wire;             /* tuile_wire_t of all that is written; never DEFAULT */
    bool dimmable;            /* it has a brightness */
    bool queues;              /* it takes a write while one is held */
} tuile_view_t;

typedef struct tuile_device {
    /* Takes the configuration (it stays the caller's, and unchanged) and tells what follows from it. Sends nothing.
     * TUILE_HAL_ARGUMENT or _UNSUPPORTED when it cannot be had. */
    int (*describe)(void *context, const struct tuile_display_config *config, tuile_view_t *view);

    /* From whatever state it is in to awake and dark, ready for a window. Also after faults. */
    int (*start)(void *context);

    /* Where the bytes of the next writes go; within the view and aligned. */
    int (*window)(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height);

    /* The window's next bytes, whole pixels, never more than are left of it. May return early: the bytes then stay readable and
     * unchanged until wait has returned. */
    int (*write)(void *context, const uint8_t *bytes, size_t size_bytes);

    /* Returns when no buffer is held any more, whatever the result. NULL: write never returns early. */
    int (*wait)(void *context);

    /* Returns when at most the last write's buffer is held; none after an error. Only where the view queues. */
    int (*wait_one)(void *context);

    /* The frame is whole. first: nothing has been shown since start; let it be seen. */
    int (*show)(void *context, bool first);

    /* Only where the view is dimmable, while shown: 0 dark ... 255 full. */
    int (*brightness)(void *context, uint8_t level);

    /* Dark and asleep, left by start. Tries all its steps even if one fails. */
    int (*sleep)(void *context);
} tuile_device_t;

#endif
