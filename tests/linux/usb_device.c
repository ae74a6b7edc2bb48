/* Plugs a model of a USB display into this kernel's virtual host controller (vhci-hcd) and serves it until it is unplugged: by
 *     echo 0 >/sys/devices/platform/vhci_hcd.0/detach
 * or by itself.
 *
 * Usage: usb_device gud|ax206 PICTURE.ppm [OPTION...]
 *   size=WxH  serial=TEXT
 *   format=N  (of gud, hexadecimal; several in the order they are offered)  buffer=BYTES  rotations=MASK
 *   lz4  status  full  backlight
 *   unplug=N  the cable is pulled when bulk transfer N has come, before it is answered
 *   hold=N    from bulk transfer N on nothing is answered
 * PICTURE is the last that was not black. One line on stdout tells the counts, one on stderr what the model refused. */
#include "usbip.h"

#include "../../sim/usb/ax206_model.h"
#include "../../sim/usb/gud_model.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define CONTROLLER "/sys/devices/platform/vhci_hcd.0/"
#define DEVICE_ID 65538 /* bus 1, device 2, as a server would number it */
#define HIGH_SPEED 3

typedef struct plug {
    usbip_t usbip;
    const char *kind, *path;
    sim_gud_config_t gud;
    uint32_t unplug, hold;
    sim_picture_t seen;
} plug_t;

static int write_attribute(const char *path, const char *text) {
    const int file = open(path, O_WRONLY | O_CLOEXEC);
    const bool written = file >= 0 && write(file, text, strlen(text)) == (ssize_t)strlen(text);

    if (file >= 0) { (void)close(file); }
    return written ? 0 : -1;
}

static int option(plug_t *plug, const char *text) {
    const char *value = strchr(text, '=');
    const size_t length = value ? (size_t)(value++ - text) : strlen(text);
    const unsigned long number = value ? strtoul(value, NULL, 0) : 0;
    sim_gud_config_t *gud = &plug->gud;
    unsigned width, height;
    char name[16];

    (void)snprintf(name, sizeof name, "%.*s", (int)length, text);
    if (value && strcmp(name, "size") == 0 && sscanf(value, "%ux%u", &width, &height) == 2) {
        gud->width = (uint16_t)width;
        gud->height = (uint16_t)height;
    } else if (value && strcmp(name, "serial") == 0) {
        gud->serial = value;
    } else if (value && strcmp(name, "format") == 0) {
        const size_t count = strnlen((const char *)gud->formats, SIM_GUD_FORMATS_MAX - 1);
        gud->formats[count] = (uint8_t)strtoul(value, NULL, 16);
    } else if (value && strcmp(name, "buffer") == 0) {
        gud->max_buffer_bytes = (uint32_t)number;
    } else if (value && strcmp(name, "rotations") == 0) {
        gud->rotations = (uint8_t)number;
    } else if (value && strcmp(name, "unplug") == 0) {
        plug->unplug = (uint32_t)number;
    } else if (value && strcmp(name, "hold") == 0) {
        plug->hold = (uint32_t)number;
    } else if (strcmp(text, "lz4") == 0) {
        gud->lz4 = true;
    } else if (strcmp(text, "status") == 0) {
        gud->status_on_set = true;
    } else if (strcmp(text, "full") == 0) {
        gud->full_update = true;
    } else if (strcmp(text, "backlight") == 0) {
        gud->backlight = true;
    } else {
        return -1;
    }
    return 0;
}

static sim_usb_t *create(const plug_t *plug, sim_error_t *error) {
    const sim_ax206_config_t ax206 = {.width = plug->gud.width, .height = plug->gud.height, .serial = plug->gud.serial};

    if (strcmp(plug->kind, "ax206") == 0) { return sim_ax206_create(&ax206, error); }
    return sim_gud_create(&plug->gud, error);
}

static int attach(plug_t *plug, sim_error_t *error) {
    int pair[2];
    char text[64];

    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0) {
        return sim_fail(error, "socketpair: %s", strerror(errno));
    }
    plug->usbip.socket = pair[0];
    (void)snprintf(text, sizeof text, "0 %d %d %d", pair[1], DEVICE_ID, HIGH_SPEED);
    if (write_attribute(CONTROLLER "attach", text) != 0) { return sim_fail(error, CONTROLLER "attach: %s", strerror(errno)); }
    (void)close(pair[1]); /* the kernel's now */
    return 0;
}

/* The picture on the glass, unless it is black. */
static int look(plug_t *plug, sim_error_t *error) {
    sim_picture_t picture;
    size_t i = 0, size_bytes;

    if (plug->usbip.usb->picture(plug->usbip.usb, &picture, error)) { return -1; }
    size_bytes = (size_t)picture.width * picture.height * 3;
    while (i < size_bytes && picture.rgb[i] == 0) {
        i++;
    }
    if (i < size_bytes) {
        sim_picture_free(&plug->seen);
        plug->seen = picture;
    } else {
        sim_picture_free(&picture);
    }
    return 0;
}

static int serve(plug_t *plug, sim_error_t *error) {
    int result;

    do {
        const uint32_t next = plug->usbip.bulks + 1;
        plug->usbip.hold = (plug->hold && next >= plug->hold) || (plug->unplug && next >= plug->unplug);
        result = usbip_serve(&plug->usbip, error);
        if (plug->unplug && plug->usbip.bulks >= plug->unplug) {
            plug->unplug = 0;
            plug->hold = 1;
            if (write_attribute(CONTROLLER "detach", "0") != 0) {
                return sim_fail(error, CONTROLLER "detach: %s", strerror(errno));
            }
        }
    } while (result == 1 && look(plug, error) == 0);
    return result < 0 ? -1 : 0;
}

static int report(const plug_t *plug, sim_error_t *error) {
    const usbip_t *usbip = &plug->usbip;

    (void)printf("submits %u, bulks %u, unlinks %u, bulk bytes %" PRIu64 ", faults %u", usbip->submits, usbip->bulks,
                 usbip->unlinks, usbip->usb->bulk_bytes, usbip->usb->faults);
    if (strcmp(plug->kind, "gud") == 0) {
        const sim_gud_counts_t *counts = sim_gud_counts(usbip->usb);
        const sim_gud_state_t state = sim_gud_state(usbip->usb);
        (void)printf(", updates %u, compressed %u, pixel bytes %" PRIu64 ", commits %u, status reads %u, format %02X, size %ux%u",
                     counts->updates, counts->compressed, counts->pixel_bytes, counts->commits, counts->status_reads, state.format,
                     state.width, state.height);
    }
    (void)printf("\n");
    if (usbip->usb->fault.text[0]) { (void)fprintf(stderr, "usb_device: %s\n", usbip->usb->fault.text); }
    return plug->seen.rgb ? sim_picture_write(&plug->seen, plug->path, error) : 0;
}

int main(int count, char **arguments) {
    plug_t plug = {0};
    sim_error_t error = {""};
    int result;

    for (int i = 3; i < count; i++) {
        if (option(&plug, arguments[i]) != 0) { count = 0; }
    }
    if (count < 3) {
        (void)fputs("Usage: usb_device gud|ax206 PICTURE.ppm [OPTION...]\n", stderr);
        return 2;
    }
    plug.kind = arguments[1];
    plug.path = arguments[2];
    plug.usbip.usb = create(&plug, &error);
    result = plug.usbip.usb ? attach(&plug, &error) : -1;
    if (result == 0) { result = serve(&plug, &error); }
    if (result == 0) { result = report(&plug, &error); }
    if (result != 0) { (void)fprintf(stderr, "usb_device: %s\n", error.text); }
    if (plug.usbip.usb) { plug.usbip.usb->destroy(plug.usbip.usb); }
    sim_picture_free(&plug.seen);
    return result ? 1 : 0;
}
