/* What displays on USB have in common: how they are found and opened, one control and one bulk transfer, and what faults are
 * called.
 *
 * Over libusb-1.0, for hosts. Memory is taken when a device is opened and given back when it is closed. Transfers are libusb's
 * asynchronous ones; whoever waits drives libusb's events, so there is no thread. Nothing is tried twice. */
#ifndef TUILE_HAL_USB_USB_H
#define TUILE_HAL_USB_USB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../bus.h"

#define TUILE_USB_TEXT_BYTES 256u
#define TUILE_USB_CONTROL_BYTES 4096u /* of data; the most that Linux takes */

struct libusb_context;
struct libusb_device_handle;
struct libusb_transfer;

typedef struct tuile_usb_id {
    uint16_t vendor, product;
} tuile_usb_id_t;

/* A family of displays. */
typedef struct tuile_usb_kind {
    const char *name; /* for people */
    const tuile_usb_id_t *ids;
    uint8_t id_count;
    bool vendor_class; /* the interface's class is FFh */
    bool answers;      /* it has a bulk endpoint to the host, too */
} tuile_usb_kind_t;

/* Which one of several; zero = any. */
typedef struct tuile_usb_choice {
    const char *serial;
    uint8_t bus, address; /* as lsusb numbers them */
} tuile_usb_choice_t;

/* All of it is the driver's own. */
typedef struct tuile_usb {
    struct libusb_context *context;
    struct libusb_device_handle *handle; /* NULL: not open */
    struct libusb_transfer *control, *bulk;
    uint8_t *control_bytes; /* setup packet and data */
    char *text;             /* the owner's, of TUILE_USB_TEXT_BYTES: the first fault since it was emptied */
    const char *words;      /* what the last fault was */
    uint32_t timeout_ms;
    uint32_t moved;              /* bytes of the last transfer that was waited for */
    int control_done, bulk_done; /* libusb's flags */
    uint8_t bus, address;        /* where it is */
    uint8_t interface, out, in;  /* in: 0 where there is none */
    bool in_flight;              /* a bulk transfer has been submitted and not been waited for */
} tuile_usb_t;

/* Opens a device of the kind that is as it was chosen and can be had, in libusb's order, detaches the kernel's driver from the
 * interface and claims it. text: TUILE_USB_TEXT_BYTES, which outlive usb. 0, or with a line in text and everything freed:
 * TUILE_HAL_NOT_FOUND, _PERMISSION, _BUSY, _GONE, _IO, ... of the first device that could not be had. */
int tuile_usb_open(tuile_usb_t *usb, const tuile_usb_kind_t *kind, const tuile_usb_choice_t *choice, uint32_t timeout_ms,
                   char *text);

/* Cancels what is in flight, gives the interface back to the kernel's driver and frees everything. Also twice, and after a failed
 * open; *usb is then all zeros. */
void tuile_usb_close(tuile_usb_t *usb);

/* Returns when a device of the kind that is as it was chosen is there, whether it can be opened or not; TUILE_HAL_TIMEOUT when none
 * came. A serial number can only be read by opening. */
int tuile_usb_wait_for(const tuile_usb_kind_t *kind, const tuile_usb_choice_t *choice, uint32_t timeout_ms);

/* One control transfer to the interface; the direction is bit 7 of type. length <= TUILE_USB_CONTROL_BYTES. What came, or went, is
 * in usb->moved; less going out than length is an error. On an error usb->words tell it; text is the caller's to write. */
int tuile_usb_control(tuile_usb_t *usb, uint8_t type, uint8_t request, uint16_t value, void *data, uint16_t length);

/* Begins a bulk transfer on usb->out or usb->in. bytes are held until tuile_usb_bulk_wait has returned, unless an error is. */
int tuile_usb_bulk(tuile_usb_t *usb, uint8_t endpoint, uint8_t *bytes, size_t size_bytes);

/* Returns when no bulk transfer is in flight, with what the last one came to; usb->moved are its bytes. Going out short of what was
 * asked is TUILE_HAL_IO. 0 when there was none. */
int tuile_usb_bulk_wait(tuile_usb_t *usb);

/* After a bulk fault: the endpoint starts anew. */
int tuile_usb_clear_halt(tuile_usb_t *usb, uint8_t endpoint);

/* Writes "kind bus-address: ..." into text if that is empty, and returns code. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
int tuile_usb_fail(tuile_usb_t *usb, int code, const char *format, ...);

#endif
