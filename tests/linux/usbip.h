/* The far end of USB/IP: serves a model of a USB device to a host that speaks the protocol, such as Linux' virtual host controller.
 *
 * Messages are a header of 48 bytes, numbers big-endian, and then data. Each request is answered before the next is read, so there
 * is nothing to take back, unless the device is told to hold its bulk transfers. */
#ifndef TESTS_LINUX_USBIP_H
#define TESTS_LINUX_USBIP_H

#include "../../sim/usb/usb_model.h"

#define USBIP_HEADER_BYTES 48u
#define USBIP_HELD_MAX 16u

/* Zero = default, throughout. */
typedef struct usbip {
    int socket;     /* a stream; stays the caller's */
    sim_usb_t *usb; /* stays the caller's */
    bool hold;      /* bulk transfers from now on wait until the host takes them back, as of a device that hangs */

    uint32_t submits, bulks, unlinks; /* so far */
    uint32_t held[USBIP_HELD_MAX];    /* their numbers */
    uint32_t held_count;
} usbip_t;

/* Takes one message and answers it. 1; 0 when the other end has closed; -1 and one line in error when it broke the protocol or off
 * in the middle of a message. */
int usbip_serve(usbip_t *usbip, sim_error_t *error);

#endif
