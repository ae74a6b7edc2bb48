#include "gud_protocol.h"

static const struct {
    uint8_t format, wire;
} formats[] = {
    {0x01, TUILE_WIRE_MONO_ROWS}, {0x08, TUILE_WIRE_GREY8},  {0x20, TUILE_WIRE_XRGB1111}, {0x30, TUILE_WIRE_RGB332},
    {0x40, TUILE_WIRE_RGB565_LE}, {0x50, TUILE_WIRE_BGR888}, {0x80, TUILE_WIRE_XRGB8888},
};

uint8_t tuile_gud_wire(uint8_t format) {
    for (unsigned i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (formats[i].format == format) { return formats[i].wire; }
    }
    return 0;
}

uint8_t tuile_gud_format(uint8_t wire) {
    for (unsigned i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (formats[i].wire == wire) { return formats[i].format; }
    }
    return 0;
}

static const char *request_name(uint8_t request) {
    switch (request) {
    case TUILE_GUD_GET_STATUS: return "GET_STATUS";
    case TUILE_GUD_GET_DESCRIPTOR: return "GET_DESCRIPTOR";
    case TUILE_GUD_GET_FORMATS: return "GET_FORMATS";
    case TUILE_GUD_GET_PROPERTIES: return "GET_PROPERTIES";
    case TUILE_GUD_GET_CONNECTORS: return "GET_CONNECTORS";
    case TUILE_GUD_GET_CONNECTOR_PROPERTIES: return "GET_CONNECTOR_PROPERTIES";
    case TUILE_GUD_SET_FORCE_DETECT: return "SET_CONNECTOR_FORCE_DETECT";
    case TUILE_GUD_GET_CONNECTOR_STATUS: return "GET_CONNECTOR_STATUS";
    case TUILE_GUD_GET_MODES: return "GET_CONNECTOR_MODES";
    case TUILE_GUD_GET_EDID: return "GET_CONNECTOR_EDID";
    case TUILE_GUD_SET_BUFFER: return "SET_BUFFER";
    case TUILE_GUD_SET_STATE_CHECK: return "SET_STATE_CHECK";
    case TUILE_GUD_SET_STATE_COMMIT: return "SET_STATE_COMMIT";
    case TUILE_GUD_SET_CONTROLLER_ENABLE: return "SET_CONTROLLER_ENABLE";
    default: return "SET_DISPLAY_ENABLE";
    }
}

static const char *status_name(uint8_t status) {
    static const char *const names[] = {"no error", "busy", "not supported", "protocol error", "invalid parameter", "error"};

    return status < sizeof names / sizeof names[0] ? names[status] : "a status that is not in the protocol";
}

static int read_status(tuile_gud_t *gud, uint8_t *status) {
    const int result = tuile_usb_control(&gud->usb, 0xC1, TUILE_GUD_GET_STATUS, 0, status, 1);

    if (!result && gud->usb.moved < 1) {
        gud->usb.words = "an empty answer";
        return TUILE_HAL_PROTOCOL;
    }
    return result;
}

/* A device that has timed out is not asked: it would time out again. */
int tuile_gud_explain(tuile_gud_t *gud, int result, const char *what) {
    const char *words = gud->usb.words;
    uint8_t status = 0;
    int asked;

    if (result != TUILE_HAL_PROTOCOL && result != TUILE_HAL_IO) { return tuile_usb_fail(&gud->usb, result, "%s: %s", what, words); }
    asked = read_status(gud, &status);
    if (asked == TUILE_HAL_GONE) { return tuile_usb_fail(&gud->usb, asked, "%s: %s", what, gud->usb.words); }
    if (asked) { return tuile_usb_fail(&gud->usb, result, "%s: %s; no status: %s", what, words, gud->usb.words); }
    return tuile_usb_fail(&gud->usb, result, "%s: %s; status: %s", what, words, status_name(status));
}

int tuile_gud_get(tuile_gud_t *gud, uint8_t request, uint16_t value, void *data, uint16_t least, uint16_t most, uint16_t *count) {
    const int result = tuile_usb_control(&gud->usb, 0xC1, request, value, data, most);

    if (result) { return tuile_gud_explain(gud, result, request_name(request)); }
    if (gud->usb.moved < least) {
        return tuile_usb_fail(&gud->usb, TUILE_HAL_PROTOCOL, "%s: %u bytes, not %u", request_name(request), gud->usb.moved, least);
    }
    if (count) { *count = (uint16_t)gud->usb.moved; }
    return TUILE_HAL_OK;
}

int tuile_gud_set(tuile_gud_t *gud, uint8_t request, uint16_t value, void *data, uint16_t length) {
    uint8_t status = 0;
    int result = tuile_usb_control(&gud->usb, 0x41, request, value, data, length);

    if (result) { return tuile_gud_explain(gud, result, request_name(request)); }
    if (!gud->status_on_set) { return TUILE_HAL_OK; }
    if ((result = read_status(gud, &status))) {
        return tuile_usb_fail(&gud->usb, result, "%s: no status: %s", request_name(request), gud->usb.words);
    }
    if (!status) { return TUILE_HAL_OK; }
    return tuile_usb_fail(&gud->usb, TUILE_HAL_PROTOCOL, "%s: refused; status: %s", request_name(request), status_name(status));
}
