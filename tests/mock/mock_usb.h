/* USB devices for libusb, made up by umockdev: sysfs and usbfs of a few ports, a model of a device (sim/usb) at each, and faults.
 *
 * Bytes that go out are read when the URB is reaped, as late as a controller may read them: whoever writes to a buffer that is on
 * its way sees the damage. */
#ifndef TESTS_MOCK_MOCK_USB_H
#define TESTS_MOCK_MOCK_USB_H

#include <stdbool.h>
#include <stdint.h>

#include "../../sim/usb/usb_model.h"

typedef enum mock_usb_fault {
    MOCK_USB_FINE = 0,
    MOCK_USB_STALL,     /* the endpoint stalls; a bulk endpoint stays halted until that is cleared */
    MOCK_USB_PROTO,     /* no answer: -EPROTO */
    MOCK_USB_HOLD,      /* it is never done, unless it is discarded */
    MOCK_USB_SHORT,     /* half of the bytes go over */
    MOCK_USB_GONE,      /* unplugged while it was under way, and from then on */
    MOCK_USB_NO_MEMORY, /* the kernel does not take it: ENOMEM */
} mock_usb_fault_t;

#define MOCK_USB_FAULTS 7

typedef struct mock_usb mock_usb_t;

/* How libusb cuts long transfers. */
typedef enum mock_usb_kernel {
    MOCK_USB_WHOLE = 0, /* a transfer is one URB */
    MOCK_USB_CUT,       /* of 16 KB each, and the rest is not cancelled when one falls short */
} mock_usb_kernel_t;

/* Readable and writable between transfers. */
typedef struct mock_usb_state {
    mock_usb_fault_t fault;
    unsigned fault_at; /* the URB that it befalls, from 1 */
    bool then_gone;    /* and from then on the device is gone */
    bool struck;       /* it has befallen one that it made a difference to */
    bool out;          /* that one's direction */

    unsigned submitted, reaped, discarded;
    unsigned pending; /* submitted and not reaped */
    unsigned halts_cleared;
    unsigned claims, releases;
    unsigned largest_bytes; /* of a URB */
    bool driver;            /* the kernel's driver has the interface */
    bool busy;              /* somebody else has */
    bool gone;
    mock_usb_kernel_t kernel;
} mock_usb_state_t;

/* Plugs a device in as 1-PORT, bus 1, address PORT + 1; ports are 1 ... 4. The model stays the caller's and outlives it. The first
 * one makes the bed that they stand in. */
mock_usb_t *mock_usb_plug(unsigned port, sim_usb_t *model);
mock_usb_state_t *mock_usb_state(mock_usb_t *device);

/* Pulls it out: it disappears from sysfs, too. */
void mock_usb_unplug(mock_usb_t *device);

/* Takes away the right to open it, from everybody but root. */
void mock_usb_forbid(mock_usb_t *device);

/* Away with all devices and the bed. At the end of each test. */
void mock_usb_clear(void);

/* For cmocka: the same, in case the test before has failed. */
int mock_usb_set_up(void **state);

/* Makes the bed without a device in it, so that libusb sees none of the machine's. */
void mock_usb_bed(void);

/* File descriptors that this process has. Those that the bed's threads are about to close are waited for until there are as many as
 * expected; 0: not waited for. */
unsigned mock_usb_descriptors(unsigned expected);

#endif
