/* A USB device as seen from its cable: what every model of a USB display offers to whoever plays the host's side, be it umockdev's
 * usbfs or a USB/IP server.
 *
 * Models are written from the protocols, not from the drivers, and refuse what the protocol forbids, also where a real device would
 * let it pass. */
#ifndef SIM_USB_MODEL_H
#define SIM_USB_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../error.h"
#include "../picture.h"

typedef struct sim_usb sim_usb_t;

/* Results are the bytes that were moved, 0 ... length, or -EPIPE: the device stalls, and fault says why if the host was wrong. */
struct sim_usb {
    /* A class or vendor request; standard ones never get here. setup is as on the wire. data are length = wLength bytes: what the
     * host sends, or room for the answer, which may be shorter. */
    int (*control)(sim_usb_t *usb, const uint8_t setup[8], uint8_t *data, size_t length);
    /* A bulk transfer, or a part of one that ends with a whole packet: hosts cut long ones. endpoint with bit 7 set: to the host.
     */
    int (*bulk)(sim_usb_t *usb, uint8_t endpoint, uint8_t *data, size_t length);
    /* The host has reset the port or chosen the configuration: everything but the picture is as after power came up. */
    void (*reset)(sim_usb_t *usb);
    /* The host has cleared the halt of an endpoint. NULL: none is ever halted. */
    void (*clear_halt)(sim_usb_t *usb, uint8_t endpoint);
    /* What is seen on the glass, as the module lies at rotation 0; black when it is off or its backlight is. out is the caller's
     * to free. */
    int (*picture)(const sim_usb_t *usb, sim_picture_t *out, sim_error_t *error);
    void (*destroy)(sim_usb_t *usb);

    const uint8_t *descriptors; /* device descriptor, 18 bytes, then the configuration's, as sysfs has them in `descriptors` */
    size_t descriptors_bytes;
    const char *strings[3]; /* of the indices 1 ... 3: manufacturer, product, serial number; ASCII, at most 126; NULL: none */

    sim_error_t fault; /* the first thing that was refused; empties only when the owner empties it. Later traffic is still judged */
    uint32_t faults;
    uint64_t control_bytes, bulk_bytes; /* moved either way, without setup packets */
};

/* Any control transfer: standard requests (descriptors, strings, configuration, interface, status, halt) are answered here, the
 * others by usb->control. Counts control_bytes. */
int sim_usb_control(sim_usb_t *usb, const uint8_t setup[8], uint8_t *data, size_t length);

/* A bulk transfer. Counts bulk_bytes. */
int sim_usb_bulk(sim_usb_t *usb, uint8_t endpoint, uint8_t *data, size_t length);

/* For models: remembers the first fault, counts it and returns -EPIPE. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
int sim_usb_refuse(sim_usb_t *usb, const char *format, ...);

/* Little-endian fields of setup packets and messages. */
static inline uint32_t sim_usb_u16(const uint8_t *bytes) { return bytes[0] | (uint32_t)bytes[1] << 8; }
static inline uint32_t sim_usb_u32(const uint8_t *bytes) { return sim_usb_u16(bytes) | sim_usb_u16(bytes + 2) << 16; }

#endif
