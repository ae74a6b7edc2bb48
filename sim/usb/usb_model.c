#include "usb_model.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* USB 2.0, tables 9-4 and 9-5. */
enum {
    GET_STATUS = 0,
    CLEAR_FEATURE = 1,
    GET_DESCRIPTOR = 6,
    GET_CONFIGURATION = 8,
    SET_CONFIGURATION = 9,
    GET_INTERFACE = 10,
    SET_INTERFACE = 11,
};
enum { DEVICE = 1, CONFIGURATION = 2, STRING = 3 };
enum { DEVICE_BYTES = 18 };

int sim_usb_refuse(sim_usb_t *usb, const char *format, ...) {
    usb->faults++;
    if (!usb->fault.text[0]) {
        va_list arguments;
        va_start(arguments, format);
        (void)vsnprintf(usb->fault.text, sizeof usb->fault.text, format, arguments);
        va_end(arguments);
    }
    return -EPIPE;
}

static int answer(uint8_t *data, size_t length, const void *bytes, size_t size_bytes) {
    const size_t now = size_bytes < length ? size_bytes : length;

    memcpy(data, bytes, now);
    return (int)now;
}

/* UTF-16 behind its length; index 0 lists the languages: US English. */
static int answer_string(const sim_usb_t *usb, unsigned index, uint8_t *data, size_t length) {
    static const uint8_t languages[4] = {4, STRING, 0x09, 0x04};
    const char *text = index >= 1 && index <= 3 ? usb->strings[index - 1] : NULL;
    uint8_t bytes[254] = {0, STRING};
    size_t count = 2;

    if (index == 0) { return answer(data, length, languages, sizeof languages); }
    if (!text) { return -EPIPE; }
    for (; *text && count < sizeof bytes; text++, count += 2) {
        bytes[count] = (uint8_t)*text;
    }
    bytes[0] = (uint8_t)count;
    return answer(data, length, bytes, count);
}

static int answer_descriptor(const sim_usb_t *usb, uint32_t value, uint8_t *data, size_t length) {
    switch (value >> 8) {
    case DEVICE: return answer(data, length, usb->descriptors, DEVICE_BYTES);
    case CONFIGURATION:
        if (value & 255u) { return -EPIPE; }
        return answer(data, length, usb->descriptors + DEVICE_BYTES, usb->descriptors_bytes - DEVICE_BYTES);
    case STRING: return answer_string(usb, value & 255u, data, length);
    default: return -EPIPE; /* a full-speed device has no qualifier: not the host's fault */
    }
}

static int standard(sim_usb_t *usb, const uint8_t setup[8], uint8_t *data, size_t length) {
    static const uint8_t zeros[2] = {0, 0}, one[1] = {1};

    switch (setup[1]) {
    case GET_DESCRIPTOR: return answer_descriptor(usb, sim_usb_u16(setup + 2), data, length);
    case GET_STATUS: return answer(data, length, zeros, 2);
    case GET_CONFIGURATION: return answer(data, length, one, 1);
    case GET_INTERFACE: return answer(data, length, zeros, 1);
    case SET_CONFIGURATION:
        if (usb->reset) { usb->reset(usb); }
        return 0;
    case SET_INTERFACE: return sim_usb_u16(setup + 2) ? -EPIPE : 0;
    case CLEAR_FEATURE:
        if ((setup[0] & 31u) == 2 && usb->clear_halt) { usb->clear_halt(usb, setup[4]); }
        return 0;
    default: return -EPIPE;
    }
}

int sim_usb_control(sim_usb_t *usb, const uint8_t setup[8], uint8_t *data, size_t length) {
    const bool is_standard = (setup[0] & 0x60u) == 0;
    int result;

    if (sim_usb_u16(setup + 6) != length) {
        return sim_usb_refuse(usb, "a control transfer of %zu bytes whose wLength is %u", length, sim_usb_u16(setup + 6));
    }
    result = is_standard ? standard(usb, setup, data, length) : usb->control(usb, setup, data, length);
    if (result > 0) { usb->control_bytes += (uint64_t)result; }
    return result;
}

int sim_usb_bulk(sim_usb_t *usb, uint8_t endpoint, uint8_t *data, size_t length) {
    const int result = usb->bulk(usb, endpoint, data, length);

    if (result > 0) { usb->bulk_bytes += (uint64_t)result; }
    return result;
}
