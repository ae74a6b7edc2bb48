#include "usb.h"

#include <libusb-1.0/libusb.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- faults ----------------------------------------------------------------------------------------------------- */

static int fault(tuile_usb_t *usb, int error) {
    switch (error) {
    case LIBUSB_ERROR_ACCESS:
        usb->words = "no permission; hal/linux/60-tuile.rules lets users have it (make install-udev)";
        return TUILE_HAL_PERMISSION;
    case LIBUSB_ERROR_NO_DEVICE: usb->words = "the device is gone, open it anew"; return TUILE_HAL_GONE;
    case LIBUSB_ERROR_NOT_FOUND: usb->words = "there is no such interface or endpoint"; return TUILE_HAL_NOT_FOUND;
    case LIBUSB_ERROR_BUSY: usb->words = "another program has the device"; return TUILE_HAL_BUSY;
    case LIBUSB_ERROR_TIMEOUT: usb->words = "timed out"; return TUILE_HAL_TIMEOUT;
    case LIBUSB_ERROR_PIPE: usb->words = "stalled"; return TUILE_HAL_PROTOCOL;
    case LIBUSB_ERROR_OVERFLOW: usb->words = "the device sent more than was asked for"; return TUILE_HAL_PROTOCOL;
    case LIBUSB_ERROR_NO_MEM: usb->words = "larger than the system takes (usbcore.usbfs_memory_mb)"; return TUILE_HAL_SIZE;
    case LIBUSB_ERROR_NOT_SUPPORTED: usb->words = "the system cannot do this"; return TUILE_HAL_UNSUPPORTED;
    default: usb->words = "the transfer failed"; return TUILE_HAL_IO;
    }
}

int tuile_usb_fail(tuile_usb_t *usb, int code, const char *format, ...) {
    va_list arguments;
    int count;

    if (usb->text[0]) { return code; }
    count = snprintf(usb->text, TUILE_USB_TEXT_BYTES, "usb %u-%u: ", usb->bus, usb->address); /* at most 14 characters */
    va_start(arguments, format);
    (void)vsnprintf(usb->text + count, TUILE_USB_TEXT_BYTES - (size_t)count, format, arguments);
    va_end(arguments);
    return code;
}

/* ---- which ------------------------------------------------------------------------------------------------------ */

static bool is_kind(libusb_device *device, const tuile_usb_kind_t *kind) {
    struct libusb_device_descriptor descriptor;

    if (libusb_get_device_descriptor(device, &descriptor)) { return false; }
    for (unsigned i = 0; i < kind->id_count; i++) {
        if (descriptor.idVendor == kind->ids[i].vendor && descriptor.idProduct == kind->ids[i].product) { return true; }
    }
    return false;
}

static bool is_there(libusb_device *device, const tuile_usb_choice_t *choice) {
    return (!choice->bus || choice->bus == libusb_get_bus_number(device)) &&
           (!choice->address || choice->address == libusb_get_device_address(device));
}

/* Whether this is the one, as far as its serial number tells; < 0: a fault of libusb's. */
static int has_serial(libusb_device_handle *handle, const char *serial) {
    struct libusb_device_descriptor descriptor;
    unsigned char text[128];
    int count;

    if (!serial) { return 1; }
    if (libusb_get_device_descriptor(libusb_get_device(handle), &descriptor) || !descriptor.iSerialNumber) { return 0; }
    count = libusb_get_string_descriptor_ascii(handle, descriptor.iSerialNumber, text, (int)sizeof text);
    if (count < 0) { return count; }
    return (size_t)count == strlen(serial) && !memcmp(text, serial, (size_t)count);
}

static bool take_interface(tuile_usb_t *usb, const tuile_usb_kind_t *kind, const struct libusb_interface_descriptor *interface) {
    usb->out = usb->in = 0;
    if (kind->vendor_class && interface->bInterfaceClass != LIBUSB_CLASS_VENDOR_SPEC) { return false; }
    for (unsigned i = 0; i < interface->bNumEndpoints; i++) {
        const struct libusb_endpoint_descriptor *endpoint = &interface->endpoint[i];
        if ((endpoint->bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) != LIBUSB_TRANSFER_TYPE_BULK) { continue; }
        if (endpoint->bEndpointAddress & LIBUSB_ENDPOINT_IN) {
            if (!usb->in) { usb->in = endpoint->bEndpointAddress; }
        } else if (!usb->out) {
            usb->out = endpoint->bEndpointAddress;
        }
    }
    usb->interface = interface->bInterfaceNumber;
    return usb->out && (usb->in || !kind->answers);
}

/* The first interface that can carry pixels. */
static int find_interface(tuile_usb_t *usb, libusb_device *device, const tuile_usb_kind_t *kind) {
    struct libusb_config_descriptor *config;
    bool found = false;
    const int error = libusb_get_active_config_descriptor(device, &config);

    if (error) { return tuile_usb_fail(usb, fault(usb, error), "%s: its configuration cannot be read", kind->name); }
    for (unsigned i = 0; i < config->bNumInterfaces && !found; i++) {
        found = config->interface[i].num_altsetting > 0 && take_interface(usb, kind, &config->interface[i].altsetting[0]);
    }
    libusb_free_config_descriptor(config);
    if (found) { return TUILE_HAL_OK; }
    return tuile_usb_fail(usb, TUILE_HAL_UNSUPPORTED, "%s: no interface with the bulk endpoints that it needs", kind->name);
}

/* ---- opening ---------------------------------------------------------------------------------------------------- */

static void let_go(tuile_usb_t *usb) {
    if (usb->handle) { libusb_close(usb->handle); }
    usb->handle = NULL;
}

/* 1: it is another one. */
static int try_device(tuile_usb_t *usb, libusb_device *device, const tuile_usb_kind_t *kind, const tuile_usb_choice_t *choice) {
    int result;

    usb->bus = libusb_get_bus_number(device);
    usb->address = libusb_get_device_address(device);
    if ((result = find_interface(usb, device, kind))) { return result; }
    if ((result = libusb_open(device, &usb->handle))) {
        usb->handle = NULL;
        result = fault(usb, result);
        return tuile_usb_fail(usb, result, "%s cannot be opened: %s", kind->name, usb->words);
    }
    if ((result = has_serial(usb->handle, choice->serial)) != 1) {
        let_go(usb);
        if (result == 0) { return 1; }
        result = fault(usb, result);
        return tuile_usb_fail(usb, result, "%s: its serial number cannot be read: %s", kind->name, usb->words);
    }
    /* Not everywhere can it be asked for; then claiming tells. */
    (void)libusb_set_auto_detach_kernel_driver(usb->handle, 1);
    if ((result = libusb_claim_interface(usb->handle, usb->interface))) {
        let_go(usb);
        result = fault(usb, result);
        return tuile_usb_fail(usb, result, "%s cannot be claimed: %s", kind->name, usb->words);
    }
    return TUILE_HAL_OK;
}

static int find(tuile_usb_t *usb, const tuile_usb_kind_t *kind, const tuile_usb_choice_t *choice) {
    libusb_device **devices;
    int first = TUILE_HAL_NOT_FOUND, result = 1;
    const ssize_t count = libusb_get_device_list(usb->context, &devices);

    for (ssize_t i = 0; i < count && result; i++) {
        if (!is_kind(devices[i], kind) || !is_there(devices[i], choice)) { continue; }
        result = try_device(usb, devices[i], kind, choice);
        if (result < 0 && first == TUILE_HAL_NOT_FOUND) { first = result; }
    }
    if (count >= 0) { libusb_free_device_list(devices, 1); }
    if (result == TUILE_HAL_OK) {
        usb->text[0] = 0; /* what another one came to */
        return TUILE_HAL_OK;
    }
    if (!usb->text[0]) {
        (void)snprintf(usb->text, TUILE_USB_TEXT_BYTES, "usb: no %s is attached%s%s", kind->name,
                       choice->serial ? " that has the serial number " : "", choice->serial ? choice->serial : "");
    }
    return first;
}

int tuile_usb_open(tuile_usb_t *usb, const tuile_usb_kind_t *kind, const tuile_usb_choice_t *choice, uint32_t timeout_ms,
                   char *text) {
    int result;

    *usb = (tuile_usb_t){.text = text, .timeout_ms = timeout_ms};
    text[0] = 0;
    if ((result = libusb_init(&usb->context))) {
        usb->context = NULL;
        result = fault(usb, result);
        (void)snprintf(text, TUILE_USB_TEXT_BYTES, "usb: libusb does not start: %s", usb->words);
        return result;
    }
    if ((result = find(usb, kind, choice))) {
        tuile_usb_close(usb);
        return result;
    }
    usb->control = libusb_alloc_transfer(0);
    usb->bulk = libusb_alloc_transfer(0);
    usb->control_bytes = malloc(LIBUSB_CONTROL_SETUP_SIZE + TUILE_USB_CONTROL_BYTES);
    if (!usb->control || !usb->bulk || !usb->control_bytes) {
        result = tuile_usb_fail(usb, TUILE_HAL_IO, "out of memory for %s", kind->name);
        tuile_usb_close(usb);
    }
    return result;
}

void tuile_usb_close(tuile_usb_t *usb) {
    if (usb->in_flight) {
        (void)libusb_cancel_transfer(usb->bulk);
        (void)tuile_usb_bulk_wait(usb);
    }
    libusb_free_transfer(usb->control);
    libusb_free_transfer(usb->bulk);
    free(usb->control_bytes);
    if (usb->handle) {
        (void)libusb_release_interface(usb->handle, usb->interface);
        let_go(usb);
    }
    if (usb->context) { libusb_exit(usb->context); }
    *usb = (tuile_usb_t){0};
}

/* ---- transfers -------------------------------------------------------------------------------------------------- */

static void LIBUSB_CALL done(struct libusb_transfer *transfer) { *(int *)transfer->user_data = 1; }

/* Only when it is done is its buffer nobody's: a fault of the events themselves cancels it, and it is waited for nevertheless. */
static int finish(tuile_usb_t *usb, struct libusb_transfer *transfer, int *flag) {
    while (!*flag) {
        const int result = libusb_handle_events_completed(usb->context, flag);
        if (result && result != LIBUSB_ERROR_INTERRUPTED) { (void)libusb_cancel_transfer(transfer); }
    }
    usb->moved = (uint32_t)transfer->actual_length;
    switch (transfer->status) {
    case LIBUSB_TRANSFER_COMPLETED: return TUILE_HAL_OK;
    case LIBUSB_TRANSFER_TIMED_OUT: return fault(usb, LIBUSB_ERROR_TIMEOUT);
    case LIBUSB_TRANSFER_STALL: return fault(usb, LIBUSB_ERROR_PIPE);
    case LIBUSB_TRANSFER_NO_DEVICE: return fault(usb, LIBUSB_ERROR_NO_DEVICE);
    case LIBUSB_TRANSFER_OVERFLOW: return fault(usb, LIBUSB_ERROR_OVERFLOW);
    default: return fault(usb, LIBUSB_ERROR_IO);
    }
}

static int cut_short(tuile_usb_t *usb) {
    usb->words = "the device took less than it was sent";
    return TUILE_HAL_IO;
}

int tuile_usb_control(tuile_usb_t *usb, uint8_t type, uint8_t request, uint16_t value, void *data, uint16_t length) {
    uint8_t *bytes = usb->control_bytes + LIBUSB_CONTROL_SETUP_SIZE;
    const bool in = (type & LIBUSB_ENDPOINT_IN) != 0;
    int result;

    usb->moved = 0;
    if (length > TUILE_USB_CONTROL_BYTES) { return fault(usb, LIBUSB_ERROR_NO_MEM); }
    libusb_fill_control_setup(usb->control_bytes, type, request, value, usb->interface, length);
    if (!in && length) { memcpy(bytes, data, length); }
    usb->control_done = 0;
    libusb_fill_control_transfer(usb->control, usb->handle, usb->control_bytes, done, &usb->control_done, usb->timeout_ms);
    if ((result = libusb_submit_transfer(usb->control))) { return fault(usb, result); }
    if ((result = finish(usb, usb->control, &usb->control_done))) { return result; }
    if (!in) { return usb->moved < length ? cut_short(usb) : TUILE_HAL_OK; }
    if (usb->moved) { memcpy(data, bytes, usb->moved); }
    return TUILE_HAL_OK;
}

int tuile_usb_bulk(tuile_usb_t *usb, uint8_t endpoint, uint8_t *bytes, size_t size_bytes) {
    int result;

    if (size_bytes > INT32_MAX) { return fault(usb, LIBUSB_ERROR_NO_MEM); }
    usb->bulk_done = 0;
    libusb_fill_bulk_transfer(usb->bulk, usb->handle, endpoint, bytes, (int)size_bytes, done, &usb->bulk_done, usb->timeout_ms);
    if ((result = libusb_submit_transfer(usb->bulk))) { return fault(usb, result); }
    usb->in_flight = true;
    return TUILE_HAL_OK;
}

int tuile_usb_bulk_wait(tuile_usb_t *usb) {
    int result;

    if (!usb->in_flight) { return TUILE_HAL_OK; }
    result = finish(usb, usb->bulk, &usb->bulk_done);
    usb->in_flight = false;
    if (result || usb->bulk->endpoint & LIBUSB_ENDPOINT_IN) { return result; }
    return usb->moved < (uint32_t)usb->bulk->length ? cut_short(usb) : TUILE_HAL_OK;
}

int tuile_usb_clear_halt(tuile_usb_t *usb, uint8_t endpoint) {
    const int result = libusb_clear_halt(usb->handle, endpoint);

    return result ? fault(usb, result) : TUILE_HAL_OK;
}

/* ---- waiting for a device --------------------------------------------------------------------------------------- */

static bool is_attached(libusb_context *context, const tuile_usb_kind_t *kind, const tuile_usb_choice_t *choice) {
    libusb_device **devices;
    bool found = false;
    const ssize_t count = libusb_get_device_list(context, &devices);

    for (ssize_t i = 0; i < count && !found; i++) {
        libusb_device_handle *handle;
        if (!is_kind(devices[i], kind) || !is_there(devices[i], choice)) { continue; }
        found = !choice->serial;
        if (choice->serial && !libusb_open(devices[i], &handle)) {
            found = has_serial(handle, choice->serial) == 1;
            libusb_close(handle);
        }
    }
    if (count >= 0) { libusb_free_device_list(devices, 1); }
    return found;
}

/* Whatever arrives ends the wait for events, and the list is looked at anew: nothing may be sent from in here. */
static int LIBUSB_CALL arrived(libusb_context *context, libusb_device *device, libusb_hotplug_event event, void *user_data) {
    (void)context;
    (void)device;
    (void)event;
    (void)user_data;
    return 0;
}

static int64_t now_ms(void) {
    struct timespec now;

    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static int wait_in(libusb_context *context, const tuile_usb_kind_t *kind, const tuile_usb_choice_t *choice, int64_t end_ms) {
    libusb_hotplug_callback_handle callback;
    tuile_usb_t none = {0};
    int result = TUILE_HAL_TIMEOUT;
    const int error =
        libusb_hotplug_register_callback(context, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED, 0, LIBUSB_HOTPLUG_MATCH_ANY,
                                         LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, arrived, NULL, &callback);

    if (error) { return fault(&none, error); }
    for (;;) {
        const int64_t left_ms = end_ms - now_ms();
        struct timeval left = {.tv_sec = left_ms / 1000, .tv_usec = left_ms % 1000 * 1000};

        if (is_attached(context, kind, choice)) {
            result = TUILE_HAL_OK;
            break;
        }
        if (left_ms <= 0) { break; }
        result = libusb_handle_events_timeout_completed(context, &left, NULL);
        if (result && result != LIBUSB_ERROR_INTERRUPTED) {
            result = fault(&none, result);
            break;
        }
        result = TUILE_HAL_TIMEOUT;
    }
    libusb_hotplug_deregister_callback(context, callback);
    return result;
}

int tuile_usb_wait_for(const tuile_usb_kind_t *kind, const tuile_usb_choice_t *choice, uint32_t timeout_ms) {
    libusb_context *context;
    tuile_usb_t none = {0};
    int result = libusb_init(&context);

    if (result) { return fault(&none, result); }
    result = wait_in(context, kind, choice, now_ms() + timeout_ms);
    libusb_exit(context);
    return result;
}
