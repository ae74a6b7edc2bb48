/* Displays that speak GUD, the Generic USB Display protocol: microcontrollers with a panel, and whatever else implements it.
 *
 *     tuile_gud_t gud;
 *     tuile_gud_open(&gud, NULL);
 *     tuile_display_init(&display, &(tuile_display_config_t){.device = &tuile_gud_device, .device_context = &gud});
 *     ...
 *     tuile_display_close(&display);
 *     tuile_gud_close(&gud);
 *
 * A display config's wire is one that the device offers; DEFAULT is the best of them: RGB565_LE, then BGR888, XRGB8888, RGB332,
 * GREY8, XRGB1111, MONO_ROWS. rotation takes the device's own property, TUILE_HAL_UNSUPPORTED where it has none. The kernel's
 * driver is detached while the device is open.
 *
 * tuile_display_write returns while the pixels of a window that came in one write are on their way; a window that comes in several
 * is gathered first. Where the device wants whole frames they are gathered, too, and tuile_display_present sends them and waits.
 * Nothing is allocated between open and close but by libusb. */
#ifndef TUILE_HAL_USB_GUD_H
#define TUILE_HAL_USB_GUD_H

#include "../device.h"
#include "usb.h"

/* Zero = default, throughout. Only read by the call that it is given to. */
typedef struct tuile_gud_config {
    const char *serial;     /* which of several displays: by its serial number, */
    uint8_t bus, address;   /* or by its place, as lsusb numbers it; 0: any that can be had */
    uint16_t width, height; /* the mode, in pixels; 0: the one that the device prefers, else its first */
    uint8_t connector;      /* from 1; 0: the first that something is connected to */
    bool no_compression;    /* pixels are sent as they are, though the device takes LZ4 */
    uint32_t timeout_ms;    /* of each transfer; 0: 3000 */
} tuile_gud_config_t;

#define TUILE_GUD_MODE_BYTES 24u
#define TUILE_GUD_PROPERTIES_MAX 64u

typedef struct tuile_gud_property {
    uint16_t id;
    uint64_t value;
} tuile_gud_property_t;

/* Where pixels go. */
typedef struct tuile_gud_window {
    uint32_t x, y, width, height;
} tuile_gud_window_t;

/* Readable: the first block. The rest is the driver's own. It must not be moved while it is open. */
typedef struct tuile_gud {
    char error_text[TUILE_USB_TEXT_BYTES]; /* the first fault since it was opened or started; no newline; empty: none */
    uint16_t width, height;                /* of the mode, in pixels */
    uint32_t wires;                        /* what the device offers: bit TUILE_WIRE_... for each */
    bool lz4, full_update;                 /* how it takes pixels */
    bool dimmable;

    tuile_usb_t usb;
    bool status_on_set;
    uint8_t connector, connectors;
    uint8_t rotations;                                         /* mask of quarter turns against the clock */
    uint8_t mode[TUILE_GUD_MODE_BYTES];                        /* as it goes over the wire */
    tuile_gud_property_t properties[TUILE_GUD_PROPERTIES_MAX]; /* the device's, then the connector's */
    uint8_t property_count, device_property_count;
    uint32_t buffer_most_bytes; /* of one update */

    uint8_t wire, format; /* of the display that stands on it */
    uint16_t view_width, view_height;

    uint8_t *stage;      /* a window, or a frame, that is being gathered */
    uint8_t *compressed; /* one update */
    void *lz4_state;
    tuile_gud_window_t window;
    uint32_t window_bytes, staged_bytes;
    bool lit;      /* the display is enabled */
    bool bulk_bad; /* the endpoint may be halted, and a frame cut */
} tuile_gud_t;

/* Finds a display, claims it and reads what it can do; config may be NULL. It shows nothing yet, and its state is as it was. 0, or
 * an error with one line in gud->error_text and nothing held: TUILE_HAL_NOT_FOUND (no display, or nothing connected to it),
 * _PERMISSION, _BUSY, _UNSUPPORTED (no such mode, or no format that is known here), _PROTOCOL (it does not answer as a GUD
 * display), ... */
int tuile_gud_open(tuile_gud_t *gud, const tuile_gud_config_t *config);

/* Gives the device back and frees everything; tuile_display_close comes before. error_text stays. Also twice, after a failed
 * open, and of a struct that is all zeros. */
void tuile_gud_close(tuile_gud_t *gud);

/* Returns 0 as soon as a display is attached that config chooses (its serial, bus and address), TUILE_HAL_TIMEOUT when none was
 * within timeout_ms. */
int tuile_gud_wait_for(const tuile_gud_config_t *config, uint32_t timeout_ms);

/* For tuile_display_config_t.device; its context is an open tuile_gud_t. */
extern const tuile_device_t tuile_gud_device;

#endif
