/* Photo frames with an AX206 chip that take pictures over USB (1908:0102, "dpf"): SCSI commands in the bulk-only transport, RGB565.
 *
 *     tuile_ax206_t frame;
 *     tuile_ax206_open(&frame, NULL);
 *     tuile_display_init(&display, &(tuile_display_config_t){.device = &tuile_ax206_device, .device_context = &frame});
 *     ...
 *     tuile_display_close(&display);
 *     tuile_ax206_close(&frame);
 *
 * The only wire is RGB565, high byte first; there is no rotation. Brightness has 7 steps and dark. The kernel's driver is detached
 * while the device is open. tuile_display_write returns while the pixels of a window that came in one write are on their way; a
 * window that comes in several is gathered first. Nothing is allocated between open and close but by libusb. */
#ifndef TUILE_HAL_USB_AX206_H
#define TUILE_HAL_USB_AX206_H

#include "../device.h"
#include "usb.h"

/* Zero = default, throughout. Only read by the call that it is given to. */
typedef struct tuile_ax206_config {
    const char *serial;   /* which of several frames: by its serial number, */
    uint8_t bus, address; /* or by its place, as lsusb numbers it; 0: any that can be had */
    uint32_t timeout_ms;  /* of each transfer; 0: 5000 */
} tuile_ax206_config_t;

#define TUILE_AX206_COMMAND_BYTES 31u
#define TUILE_AX206_STATUS_BYTES 13u

/* Readable: the first block. The rest is the driver's own. It must not be moved while it is open. */
typedef struct tuile_ax206 {
    char error_text[TUILE_USB_TEXT_BYTES]; /* the first fault since it was opened or started; no newline; empty: none */
    uint16_t width, height;                /* pixels, as the frame tells them */

    tuile_usb_t usb;
    uint8_t command[TUILE_AX206_COMMAND_BYTES];
    uint8_t status[TUILE_AX206_STATUS_BYTES];
    uint32_t tag;          /* of the last command */
    const char *doing;     /* what it was about */
    uint8_t *stage;        /* a window that is being gathered */
    uint32_t window_bytes; /* of the window */
    uint32_t staged_bytes;
    uint16_t x, y, window_width, window_height;
    bool status_due; /* a command's data are out, its status has not been read */
    bool bad;        /* host and frame may disagree on what comes next */
} tuile_ax206_t;

/* Finds a frame, claims it and reads its size; config may be NULL. 0, or an error with one line in frame->error_text and nothing
 * held: TUILE_HAL_NOT_FOUND, _PERMISSION, _BUSY, _PROTOCOL, ... */
int tuile_ax206_open(tuile_ax206_t *frame, const tuile_ax206_config_t *config);

/* Gives the device back and frees everything; tuile_display_close comes before. error_text stays. Also twice, after a failed
 * open, and of a struct that is all zeros. */
void tuile_ax206_close(tuile_ax206_t *frame);

/* Returns 0 as soon as a frame is attached that config chooses, TUILE_HAL_TIMEOUT when none was within timeout_ms. */
int tuile_ax206_wait_for(const tuile_ax206_config_t *config, uint32_t timeout_ms);

/* For tuile_display_config_t.device; its context is an open tuile_ax206_t. */
extern const tuile_device_t tuile_ax206_device;

#endif
