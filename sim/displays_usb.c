#include "displays_usb.h"

#include <libusb-1.0/libusb.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* hal/linux/60-tuile.rules has the same numbers. */
static const struct {
    uint16_t vendor, product;
    const char *name;
    bool gud;
} known[] = {
    {0x1D50, 0x614D, "GUD", true},
    {0x16D0, 0x10A9, "GUD", true},
    {0x1209, 0x4FB3, "GUD", true},
    {0x1908, 0x0102, "AX206", false},
};

#define RULES "hal/linux/60-tuile.rules lets users have it (make install-udev)"

enum { GUD_GET_DESCRIPTOR = 0x01, GUD_DESCRIPTOR_BYTES = 30, TIMEOUT_MS = 500 };
#define GUD_MAGIC 0x1D50614Du

typedef struct found {
    const char *name; /* NULL: of none of the known numbers */
    bool gud;
    int interface;
    char place[16]; /* 001-004, as lsusb has it */
    uint16_t vendor, product;
} found_t;

static bool takes_bulk(const struct libusb_interface_descriptor *interface) {
    for (int i = 0; i < interface->bNumEndpoints; i++) {
        const struct libusb_endpoint_descriptor *endpoint = &interface->endpoint[i];
        if ((endpoint->bmAttributes & 3) == LIBUSB_TRANSFER_TYPE_BULK && !(endpoint->bEndpointAddress & LIBUSB_ENDPOINT_IN)) {
            return true;
        }
    }
    return false;
}

/* The interface that pixels go to: of an AX206 the first, of others the first of the vendor's own class. -1: there is none. */
static int interface_of(libusb_device *device, bool vendor_class) {
    struct libusb_config_descriptor *config = NULL;
    int number = -1;
    if (libusb_get_active_config_descriptor(device, &config) && libusb_get_config_descriptor(device, 0, &config)) { return -1; }
    for (int i = 0; i < config->bNumInterfaces && number < 0; i++) {
        const struct libusb_interface_descriptor *interface = config->interface[i].altsetting;
        if (config->interface[i].num_altsetting > 0 && takes_bulk(interface) &&
            (!vendor_class || interface->bInterfaceClass == LIBUSB_CLASS_VENDOR_SPEC)) {
            number = interface->bInterfaceNumber;
        }
    }
    libusb_free_config_descriptor(config);
    return number;
}

static uint32_t get32(const uint8_t *from) {
    return from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
}

static void print_begin(const found_t *found) {
    (void)printf("  %s: %04x:%04x %s", found->place, found->vendor, found->product, found->name ? found->name : "GUD");
}

static const char *words(int error) {
    switch (error) {
    case LIBUSB_ERROR_ACCESS: return "no permission; " RULES;
    case LIBUSB_ERROR_BUSY: return "in use by another program";
    case LIBUSB_ERROR_NO_DEVICE: return "it is gone";
    default: return libusb_strerror(error);
    }
}

/* True when it is a display. A device of unknown numbers is one if it says so, and is not mentioned otherwise. */
static bool print_open(libusb_device_handle *handle, const found_t *found) {
    uint8_t told[GUD_DESCRIPTOR_BYTES] = {0};
    bool is_gud = false;
    int result;
    if (libusb_kernel_driver_active(handle, found->interface) == 1) {
        if (!found->name) { return false; }
        print_begin(found);
        (void)printf(": ready; the kernel's driver has it, and loses it to whoever opens it\n");
        return true;
    }
    if ((result = libusb_claim_interface(handle, found->interface)) == 0) {
        if (found->gud) {
            result = libusb_control_transfer(handle, LIBUSB_ENDPOINT_IN | LIBUSB_REQUEST_TYPE_VENDOR | LIBUSB_RECIPIENT_INTERFACE,
                                             GUD_GET_DESCRIPTOR, 0, (uint16_t)found->interface, told, sizeof told, TIMEOUT_MS);
            is_gud = result == GUD_DESCRIPTOR_BYTES && get32(told) == GUD_MAGIC;
        }
        (void)libusb_release_interface(handle, found->interface);
    }
    if (!found->name && !is_gud) { return false; }
    print_begin(found);
    if (is_gud) {
        (void)printf(": ready, up to %ux%u pixels\n", get32(told + 18), get32(told + 26));
    } else if (result < 0) {
        (void)printf(": %s\n", words(result));
    } else {
        (void)printf(": %s\n", found->gud ? "it does not answer as a GUD display" : "ready");
    }
    return true;
}

static bool print_device(libusb_device *device) {
    struct libusb_device_descriptor descriptor;
    libusb_device_handle *handle;
    found_t found = {.gud = true};
    bool shown = true;
    int result;
    if (libusb_get_device_descriptor(device, &descriptor)) { return false; }
    found.vendor = descriptor.idVendor;
    found.product = descriptor.idProduct;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (known[i].vendor == found.vendor && known[i].product == found.product) {
            found.name = known[i].name;
            found.gud = known[i].gud;
        }
    }
    found.interface = interface_of(device, found.gud);
    if (found.interface < 0 && !found.name) { return false; }
    (void)snprintf(found.place, sizeof found.place, "%03u-%03u", libusb_get_bus_number(device), libusb_get_device_address(device));
    if (found.interface < 0) {
        print_begin(&found);
        (void)printf(": it has no interface that takes pixels\n");
        return true;
    }
    if ((result = libusb_open(device, &handle)) == 0) {
        shown = print_open(handle, &found);
        libusb_close(handle);
        return shown;
    }
    if (!found.name) { return false; }
    print_begin(&found);
    (void)printf(": %s\n", words(result));
    return true;
}

static int by_place(const void *a, const void *b) {
    libusb_device *const one = *(libusb_device *const *)a, *const other = *(libusb_device *const *)b;
    const int buses = libusb_get_bus_number(one) - libusb_get_bus_number(other);
    return buses ? buses : libusb_get_device_address(one) - libusb_get_device_address(other);
}

void displays_usb_print(void) {
    libusb_context *context = NULL;
    libusb_device **devices = NULL;
    ssize_t count;
    bool any = false;
    const int result = libusb_init(&context);
    if (result) {
        (void)printf("no USB displays: %s\n", libusb_strerror(result));
        return;
    }
    count = libusb_get_device_list(context, &devices);
    (void)printf("USB\n");
    if (count > 0) { qsort(devices, (size_t)count, sizeof *devices, by_place); }
    for (ssize_t i = 0; i < count; i++) {
        any = print_device(devices[i]) || any;
    }
    if (count >= 0) { libusb_free_device_list(devices, 1); }
    if (count < 0) {
        (void)printf("  no displays: %s\n", libusb_strerror((int)count));
    } else if (!any) {
        (void)printf("  no displays: none of %zd devices is one that speaks GUD, or an AX206\n", count);
    }
    libusb_exit(context);
}
