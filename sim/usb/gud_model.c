#include "gud_model.h"

#include "gud_pixels.h"

#include <errno.h>
#include <lz4.h>
#include <stdlib.h>
#include <string.h>

enum {
    GET_STATUS = 0x00,
    GET_DESCRIPTOR = 0x01,
    GET_FORMATS = 0x40,
    GET_PROPERTIES = 0x41,
    GET_CONNECTORS = 0x50,
    GET_CONNECTOR_PROPERTIES = 0x51,
    GET_CONNECTOR_TV_MODE_VALUES = 0x52,
    SET_CONNECTOR_FORCE_DETECT = 0x53,
    GET_CONNECTOR_STATUS = 0x54,
    GET_CONNECTOR_MODES = 0x55,
    GET_CONNECTOR_EDID = 0x56,
    SET_BUFFER = 0x60,
    SET_STATE_CHECK = 0x61,
    SET_STATE_COMMIT = 0x62,
    SET_CONTROLLER_ENABLE = 0x63,
    SET_DISPLAY_ENABLE = 0x64,
};

enum { TYPE_IN = 0xC1, TYPE_OUT = 0x41 };
enum { FLAG_STATUS_ON_SET = 1, FLAG_FULL_UPDATE = 2 };
enum { PROPERTY_BACKLIGHT = 12, PROPERTY_ROTATION = 50 };
enum { DISPLAY_BYTES = 30, MODE_BYTES = 24, CONNECTOR_BYTES = 5, PROPERTY_BYTES = 10, BUFFER_BYTES = 25, STATE_BYTES = 26 };
enum { ANSWER_MAX_BYTES = 2048, DESCRIPTORS_MAX_BYTES = 18 + 9 + 16 * 256 };

#define MAGIC 0x1D50614Du
#define FIRST_BACKLIGHT 50

/* Where a picture comes to lie: what SET_BUFFER told. */
typedef struct place {
    uint32_t x, y, width, height, length;
    bool lz4;
} place_t;

typedef struct sim_gud {
    sim_usb_t usb;
    sim_gud_config_t config;
    sim_gud_counts_t counts;
    uint8_t descriptors[DESCRIPTORS_MAX_BYTES];
    uint8_t format_count, mode_count;
    uint32_t most_width, most_height; /* of all modes */

    uint8_t status;
    bool status_due; /* a set was sent, and the host has to read its status */
    uint8_t broken;

    sim_gud_state_t checked, state; /* width 0: none */

    place_t place;
    uint32_t expected, received; /* bytes of the transfer under way; expected 0: none */
    uint8_t *transfer;           /* as it came */
    uint8_t *pixels;             /* after decompression */
    bool halted;
    uint8_t *memory; /* 8-bit red, green, blue, in rows of the framebuffer that is seen */
} sim_gud_t;

static sim_gud_t *gud_of(sim_usb_t *usb) { return (sim_gud_t *)usb; } /* a member at the beginning, hence the casts */
static const sim_gud_t *gud_of_const(const sim_usb_t *usb) { return (const sim_gud_t *)usb; }

#define REFUSE(gud, code, ...) ((gud)->status = (code), sim_usb_refuse(&(gud)->usb, __VA_ARGS__))

static uint8_t *put16(uint8_t *to, uint32_t value) {
    to[0] = (uint8_t)value;
    to[1] = (uint8_t)(value >> 8);
    return to + 2;
}

static uint8_t *put32(uint8_t *to, uint32_t value) { return put16(put16(to, value), value >> 16); }

/* ---- pixels ----------------------------------------------------------------------------------------------------- */

static bool turned(const sim_gud_t *gud) { return gud->state.rotation % 2u; }
static uint32_t seen_width(const sim_gud_t *gud) { return turned(gud) ? gud->state.height : gud->state.width; }
static uint32_t seen_height(const sim_gud_t *gud) { return turned(gud) ? gud->state.width : gud->state.height; }

static void place_pixels(sim_gud_t *gud, const uint8_t *bytes) {
    const place_t *place = &gud->place;
    const uint32_t pitch = sim_gud_row_bytes(gud->state.format, place->width);

    for (uint32_t y = 0; y < place->height; y++) {
        for (uint32_t x = 0; x < place->width; x++) {
            sim_gud_decode(gud->state.format, bytes + (size_t)y * pitch, x,
                           gud->memory + 3u * ((size_t)(place->y + y) * seen_width(gud) + place->x + x));
        }
    }
}

static int picture(const sim_usb_t *usb, sim_picture_t *out, sim_error_t *error) {
    const sim_gud_t *gud = gud_of_const(usb);
    const uint32_t width = gud->state.width, height = gud->state.height;

    if (!width) { return sim_picture_create(out, gud->config.modes[0][0], gud->config.modes[0][1], error); }
    if (sim_picture_create(out, width, height, error)) { return -1; }
    if (!gud->state.controller || !gud->state.display) { return 0; }
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            uint32_t from_x = x, from_y = y;
            switch (gud->state.rotation) {
            case 1: from_x = height - 1 - y, from_y = x; break; /* the framebuffer's right side lies on top */
            case 2: from_x = width - 1 - x, from_y = height - 1 - y; break;
            case 3: from_x = y, from_y = width - 1 - x; break;
            default: break;
            }
            memcpy(sim_picture_at(out, x, y), gud->memory + 3u * ((size_t)from_y * seen_width(gud) + from_x), 3);
        }
    }
    return 0;
}

/* ---- answers ---------------------------------------------------------------------------------------------------- */

static uint8_t *put_mode(const sim_gud_t *gud, unsigned index, uint8_t *to) {
    const uint32_t width = gud->config.modes[index][0], height = gud->config.modes[index][1];

    to = put32(to, (width + 24u) * (height + 6u) * 60u / 1000u);
    to = put16(put16(put16(put16(to, width), width + 8u), width + 16u), width + 24u);
    to = put16(put16(put16(put16(to, height), height + 2u), height + 4u), height + 6u);
    return put32(to, gud->config.preferred == index + 1 ? 1u << 10 : 0);
}

static uint8_t *put_property(uint8_t *to, uint32_t id, uint32_t value) { return put32(put32(put16(to, id), value), 0); }

static uint8_t *put_display(const sim_gud_t *gud, uint8_t *to) {
    uint32_t least_width = UINT32_MAX, least_height = UINT32_MAX;

    for (unsigned i = 0; i < gud->mode_count; i++) {
        if (gud->config.modes[i][0] < least_width) { least_width = gud->config.modes[i][0]; }
        if (gud->config.modes[i][1] < least_height) { least_height = gud->config.modes[i][1]; }
    }
    to = put32(to, gud->config.magic ? gud->config.magic : MAGIC);
    *to++ = gud->config.version ? gud->config.version : 1;
    to = put32(to, (gud->config.status_on_set ? FLAG_STATUS_ON_SET : 0u) | (gud->config.full_update ? FLAG_FULL_UPDATE : 0u));
    *to++ = gud->config.lz4 ? 1 : 0;
    to = put32(to, gud->config.max_buffer_bytes);
    return put32(put32(put32(put32(to, least_width), gud->most_width), least_height), gud->most_height);
}

static uint8_t connector_status(const sim_gud_t *gud, unsigned connector) {
    const uint8_t status = gud->config.status[connector];

    return status ? (uint8_t)(status - 1) : SIM_GUD_CONNECTED;
}

static int get(sim_gud_t *gud, uint8_t request, uint32_t value, uint8_t *data, size_t length) {
    uint8_t bytes[ANSWER_MAX_BYTES], *to = bytes;
    size_t count;

    if (request == GET_STATUS) {
        gud->counts.status_reads++;
        gud->status_due = false;
        if (length != 1) { return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "GET_STATUS asks for %zu bytes, not 1", length); }
        data[0] = gud->status;
        return gud->broken != SIM_GUD_SILENT;
    }
    if ((request & 0xF0u) != 0x50 || request == GET_CONNECTORS) {
        if (value) { return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "request %02X has a value, %u", request, value); }
    } else if (value >= gud->config.connectors) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "request %02X is about connector %u of %u", request, value,
                      gud->config.connectors);
    }
    switch (request) {
    case GET_DESCRIPTOR: to = put_display(gud, to); break;
    case GET_FORMATS:
        memcpy(to, gud->config.formats, gud->format_count);
        to += gud->format_count;
        break;
    case GET_PROPERTIES:
        if (gud->config.rotations) { to = put_property(to, PROPERTY_ROTATION, gud->config.rotations); }
        break;
    case GET_CONNECTORS:
        memset(to, 0, (size_t)gud->config.connectors * CONNECTOR_BYTES); /* panels without flags */
        to += gud->config.connectors * CONNECTOR_BYTES;
        break;
    case GET_CONNECTOR_PROPERTIES:
        if (gud->config.backlight) { to = put_property(to, PROPERTY_BACKLIGHT, FIRST_BACKLIGHT); }
        break;
    case GET_CONNECTOR_STATUS: *to++ = connector_status(gud, value); break;
    case GET_CONNECTOR_MODES:
        for (unsigned i = 0; i < gud->mode_count && !gud->config.modes_from_edid; i++) {
            to = put_mode(gud, i, to);
        }
        break;
    case GET_CONNECTOR_EDID:
        if (gud->config.edid_bytes) { memcpy(to, gud->config.edid, gud->config.edid_bytes); }
        to += gud->config.edid_bytes;
        break;
    default: return REFUSE(gud, SIM_GUD_NOT_SUPPORTED, "request %02X is not one that is read", request);
    }
    gud->status = SIM_GUD_OK;
    count = (size_t)(to - bytes) < length ? (size_t)(to - bytes) : length;
    memcpy(data, bytes, count);
    return (int)count;
}

/* ---- state ------------------------------------------------------------------------------------------------------ */

static bool has_format(const sim_gud_t *gud, uint8_t format) {
    return format && memchr(gud->config.formats, format, gud->format_count) != NULL;
}

/* Fields that name the mode; a host may have made the rest anew. */
static bool has_mode(const sim_gud_t *gud, const uint8_t *mode) {
    uint8_t own[MODE_BYTES];

    for (unsigned i = 0; i < gud->mode_count; i++) {
        put_mode(gud, i, own);
        if (!memcmp(own + 4, mode + 4, 2) && !memcmp(own + 12, mode + 12, 2)) { return true; }
    }
    return false;
}

static int check_property(sim_gud_t *gud, const uint8_t *property, sim_gud_state_t *state, unsigned *seen) {
    const uint32_t id = sim_usb_u16(property), value = sim_usb_u32(property + 2);

    if (sim_usb_u32(property + 6)) { return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "property %u is above 32 bits", id); }
    if (id == PROPERTY_BACKLIGHT && gud->config.backlight && !(*seen & 1u)) {
        if (value > 100) { return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "a backlight of %u per cent", value); }
        *seen |= 1;
        state->backlight = (uint8_t)value;
        return 0;
    }
    if (id == PROPERTY_ROTATION && gud->config.rotations && !(*seen & 2u)) {
        *seen |= 2;
        for (uint8_t turns = 0; turns < 4; turns++) {
            if (value == 1u << turns && value & gud->config.rotations) {
                state->rotation = turns;
                return 0;
            }
        }
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "rotation %02X of %02X", value, gud->config.rotations);
    }
    return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "property %u is not here, or came twice", id);
}

static int check(sim_gud_t *gud, const uint8_t *data, size_t length) {
    sim_gud_state_t state = gud->state;
    unsigned seen = 0;
    const unsigned wanted = (gud->config.backlight ? 1u : 0u) | (gud->config.rotations ? 2u : 0u);

    gud->checked.width = 0;
    if (length < STATE_BYTES || (length - STATE_BYTES) % PROPERTY_BYTES) {
        return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "a state of %zu bytes", length);
    }
    state.width = (uint16_t)sim_usb_u16(data + 4);
    state.height = (uint16_t)sim_usb_u16(data + 12);
    state.format = data[MODE_BYTES];
    state.connector = data[MODE_BYTES + 1];
    if (!has_mode(gud, data)) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "a mode of %u x %u is not offered", state.width, state.height);
    }
    if (sim_usb_u32(data) == 0 || sim_usb_u16(data + 10) < state.width || sim_usb_u16(data + 18) < state.height) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "a mode without a clock, or whose total is less than what is seen");
    }
    if (!has_format(gud, state.format)) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "format %02X is not offered", state.format);
    }
    if (state.connector >= gud->config.connectors || connector_status(gud, state.connector) == SIM_GUD_DISCONNECTED) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "nothing is connected to connector %u", state.connector);
    }
    for (size_t at = STATE_BYTES; at < length; at += PROPERTY_BYTES) {
        const int result = check_property(gud, data + at, &state, &seen);
        if (result) { return result; }
    }
    if (seen != wanted) { return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "a state without all properties"); }
    gud->counts.checks++;
    gud->checked = state;
    return 0;
}

static int commit(sim_gud_t *gud) {
    const bool controller = gud->state.controller, display = gud->state.display;

    if (!gud->checked.width) { return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "a commit without a state that was checked"); }
    if (!controller) { return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "a commit while the controller is off"); }
    gud->state = gud->checked;
    gud->state.controller = controller;
    gud->state.display = display;
    gud->checked.width = 0;
    gud->expected = gud->received = 0;
    gud->counts.commits++;
    return 0;
}

static int enable(sim_gud_t *gud, uint8_t request, uint8_t value) {
    if (value > 1) { return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "request %02X sets %u, not 0 or 1", request, value); }
    if (request == SET_CONTROLLER_ENABLE) {
        gud->state.controller = value;
        if (!value) { gud->state.display = false; }
        return 0;
    }
    if (value && (!gud->state.controller || !gud->state.width)) {
        return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "the display is enabled before the controller and its state");
    }
    gud->state.display = value;
    return 0;
}

/* ---- buffers ---------------------------------------------------------------------------------------------------- */

/* A whole frame needs no announcement. */
static void expect_frame(sim_gud_t *gud) {
    gud->place = (place_t){.width = seen_width(gud), .height = seen_height(gud)};
    gud->place.length = sim_gud_row_bytes(gud->state.format, gud->place.width) * gud->place.height;
    gud->expected = gud->place.length;
    gud->received = 0;
}

static int set_buffer(sim_gud_t *gud, const uint8_t *data) {
    const place_t place = {.x = sim_usb_u32(data),
                           .y = sim_usb_u32(data + 4),
                           .width = sim_usb_u32(data + 8),
                           .height = sim_usb_u32(data + 12),
                           .length = sim_usb_u32(data + 16),
                           .lz4 = data[20] == 1};
    const uint32_t compressed = sim_usb_u32(data + 21);
    const unsigned bits = sim_gud_format_bits(gud->state.format);

    gud->expected = gud->received = 0;
    gud->counts.set_buffers++;
    if (!gud->state.width || !gud->state.controller) {
        return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "SET_BUFFER before there is a mode and a controller");
    }
    if (!place.width || !place.height || place.x >= seen_width(gud) || place.y >= seen_height(gud) ||
        place.width > seen_width(gud) - place.x || place.height > seen_height(gud) - place.y) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "SET_BUFFER %u x %u at (%u, %u) reaches out of %u x %u", place.width,
                      place.height, place.x, place.y, seen_width(gud), seen_height(gud));
    }
    if (place.x * bits % 8u) { return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "SET_BUFFER begins within a byte, x = %u", place.x); }
    if (place.length != sim_gud_row_bytes(gud->state.format, place.width) * place.height) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "SET_BUFFER tells %u bytes for %u x %u pixels", place.length, place.width,
                      place.height);
    }
    if (gud->config.max_buffer_bytes && place.length > gud->config.max_buffer_bytes) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "SET_BUFFER of %u bytes, more than %u", place.length,
                      gud->config.max_buffer_bytes);
    }
    if (data[20] > (gud->config.lz4 ? 1 : 0)) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "SET_BUFFER with compression %02X", data[20]);
    }
    if (place.lz4 ? !compressed || compressed > place.length : compressed != 0) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "SET_BUFFER with a compressed length of %u for %u", compressed, place.length);
    }
    if (gud->config.full_update && (place.lz4 || place.x || place.y || place.width != seen_width(gud))) {
        return REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "SET_BUFFER of a part, but updates are whole frames");
    }
    gud->place = place;
    gud->expected = place.lz4 ? compressed : place.length;
    if (gud->config.full_update) { expect_frame(gud); } /* it only says that a frame begins anew */
    return 0;
}

static int finish(sim_gud_t *gud) {
    const uint8_t *bytes = gud->transfer;

    gud->expected = 0;
    gud->counts.payload_bytes += gud->received;
    if (gud->place.lz4) {
        const int count =
            LZ4_decompress_safe((const char *)gud->transfer, (char *)gud->pixels, (int)gud->received, (int)gud->place.length);
        if (count != (int)gud->place.length) {
            gud->halted = true;
            return REFUSE(gud, SIM_GUD_ERROR, "the block decompresses to %d bytes, not %u", count, gud->place.length);
        }
        bytes = gud->pixels;
        gud->counts.compressed++;
    }
    gud->counts.pixel_bytes += gud->place.length;
    gud->counts.updates++;
    place_pixels(gud, bytes);
    return 0;
}

static int bulk(sim_usb_t *usb, uint8_t endpoint, uint8_t *data, size_t length) {
    sim_gud_t *gud = gud_of(usb);
    size_t left;

    if (endpoint != gud->config.endpoint) { return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "a transfer to endpoint %02X", endpoint); }
    if (gud->halted) { return -EPIPE; }
    if (gud->status_due) { sim_usb_refuse(usb, "pixels come before the status of the set was read"); }
    if (!gud->expected && gud->config.full_update && gud->state.width && gud->state.controller) { expect_frame(gud); }
    if (!gud->expected) {
        gud->halted = true;
        return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "%zu bytes come without SET_BUFFER", length);
    }
    left = gud->expected - gud->received;
    if (length == 0 || length > left) {
        gud->halted = true;
        return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "%zu bytes come where %zu are left", length, left);
    }
    memcpy(gud->transfer + gud->received, data, length);
    gud->received += (uint32_t)length;
    if (length < left) {
        /* A short packet ends a transfer. In a stream of whole frames a transfer may end after any row. */
        const uint32_t unit =
            gud->config.full_update ? sim_gud_row_bytes(gud->state.format, gud->place.width) : gud->config.packet_bytes;
        if (length % gud->config.packet_bytes && gud->received % unit) {
            gud->expected = 0;
            return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "the transfer ends %zu bytes early", left - length);
        }
        return (int)length;
    }
    return finish(gud) ? -EPIPE : (int)length;
}

/* ---- requests --------------------------------------------------------------------------------------------------- */

static int set(sim_gud_t *gud, uint8_t request, const uint8_t *data, size_t length) {
    static const struct {
        uint8_t request;
        uint8_t bytes;
    } sizes[] = {{SET_CONNECTOR_FORCE_DETECT, 0},
                 {SET_BUFFER, BUFFER_BYTES},
                 {SET_STATE_COMMIT, 0},
                 {SET_CONTROLLER_ENABLE, 1},
                 {SET_DISPLAY_ENABLE, 1}};

    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        if (sizes[i].request == request && sizes[i].bytes != length) {
            return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "request %02X has %zu bytes, not %u", request, length, sizes[i].bytes);
        }
    }
    if (gud->broken) {
        gud->status = gud->broken; /* the device's fault, not the host's */
        return -EPIPE;
    }
    switch (request) {
    case SET_CONNECTOR_FORCE_DETECT: return 0;
    case SET_BUFFER: return set_buffer(gud, data);
    case SET_STATE_CHECK: return check(gud, data, length);
    case SET_STATE_COMMIT: return commit(gud);
    case SET_CONTROLLER_ENABLE:
    case SET_DISPLAY_ENABLE: return enable(gud, request, data[0]);
    default: return REFUSE(gud, SIM_GUD_NOT_SUPPORTED, "request %02X is not one that is set", request);
    }
}

static int control(sim_usb_t *usb, const uint8_t setup[8], uint8_t *data, size_t length) {
    sim_gud_t *gud = gud_of(usb);
    const uint32_t value = sim_usb_u16(setup + 2);
    const bool in = setup[0] == TYPE_IN;
    int result;

    if ((!in && setup[0] != TYPE_OUT) || sim_usb_u16(setup + 4) != gud->config.interface) {
        return REFUSE(gud, SIM_GUD_PROTOCOL_ERROR, "request type %02X to interface %u", setup[0], sim_usb_u16(setup + 4));
    }
    if (gud->status_due && !in) { sim_usb_refuse(usb, "request %02X comes before the status of the set was read", setup[1]); }
    gud->status_due = gud->status_due && setup[1] == GET_STATUS;
    if (in) { return get(gud, setup[1], value, data, length); }
    if (value && (setup[1] != SET_CONNECTOR_FORCE_DETECT || value >= gud->config.connectors)) {
        result = REFUSE(gud, SIM_GUD_INVALID_PARAMETER, "request %02X has a value, %u", setup[1], value);
    } else {
        result = set(gud, setup[1], data, length);
    }
    if (!result) { gud->status = SIM_GUD_OK; }
    /* With the flag a device need not be able to stall a set: it tells by the status alone. */
    if (gud->config.status_on_set) {
        gud->status_due = true;
        return (int)length;
    }
    return result ? result : (int)length;
}

static void reset(sim_usb_t *usb) {
    sim_gud_t *gud = gud_of(usb);

    gud->status = SIM_GUD_OK;
    gud->status_due = gud->halted = false;
    gud->state = (sim_gud_state_t){.backlight = gud->config.backlight ? FIRST_BACKLIGHT : 0};
    gud->checked = (sim_gud_state_t){0};
    gud->expected = gud->received = 0;
}

static void clear_halt(sim_usb_t *usb, uint8_t endpoint) {
    if (endpoint == gud_of(usb)->config.endpoint) { gud_of(usb)->halted = false; }
}

/* ---- life ------------------------------------------------------------------------------------------------------- */

static void destroy(sim_usb_t *usb) {
    sim_gud_t *gud = gud_of(usb);

    free(gud->transfer);
    free(gud->pixels);
    free(gud->memory);
    free(gud);
}

static void describe(sim_gud_t *gud) {
    const sim_gud_config_t *config = &gud->config;
    const uint32_t total = 9u + 16u * (config->interface + 1u);
    uint8_t *to = gud->descriptors;

    memcpy(to, (const uint8_t[8]){18, 1, 0x00, 0x02, 0, 0, 0, 64}, 8);
    to = put16(put16(put16(to + 8, config->vendor), config->product), 0x0100);
    memcpy(to, (const uint8_t[4]){1, 2, config->serial ? 3 : 0, 1}, 4);
    to += 4;
    memcpy(to, (const uint8_t[2]){9, 2}, 2);
    to = put16(to + 2, total);
    memcpy(to, (const uint8_t[5]){(uint8_t)(config->interface + 1), 1, 0, 0x80, 250}, 5);
    to += 5;
    for (unsigned i = 0; i < config->interface;
         i++, to += 16) { /* another class's, in front of it, with an endpoint like its own */
        memcpy(to, (const uint8_t[16]){9, 4, (uint8_t)i, 0, 1, 8, 0, 0, 0, 7, 5, (uint8_t)(15 - i % 8u), 2, 64}, 16);
    }
    memcpy(to, (const uint8_t[9]){9, 4, config->interface, 0, 1, 0xFF, 0, 0, 0}, 9);
    to += 9;
    memcpy(to, (const uint8_t[4]){7, 5, config->endpoint, 2}, 4);
    to = put16(to + 4, config->packet_bytes);
    *to++ = 0;
    gud->usb.descriptors = gud->descriptors;
    gud->usb.descriptors_bytes = (size_t)(to - gud->descriptors);
}

static int settle_config(sim_gud_t *gud, sim_error_t *error) {
    static const uint8_t all[] = {SIM_GUD_R1,     SIM_GUD_R8,     SIM_GUD_XRGB1111, SIM_GUD_RGB332,
                                  SIM_GUD_RGB565, SIM_GUD_RGB888, SIM_GUD_XRGB8888};
    sim_gud_config_t *config = &gud->config;

    if (!config->width && !config->height) { config->width = 320, config->height = 240; }
    if (!config->modes[0][0]) { config->modes[0][0] = config->width, config->modes[0][1] = config->height; }
    if (!config->formats[0]) { memcpy(config->formats, all, sizeof all); }
    if (!config->connectors) { config->connectors = 1; }
    if (!config->vendor) { config->vendor = 0x1D50, config->product = 0x614D; }
    if (!config->endpoint) { config->endpoint = 1; }
    if (!config->packet_bytes) { config->packet_bytes = 512; }
    while (gud->format_count < SIM_GUD_FORMATS_MAX && config->formats[gud->format_count]) {
        if (!sim_gud_format_bits(config->formats[gud->format_count])) {
            return sim_fail(error, "a GUD display has no format %02X", config->formats[gud->format_count]);
        }
        gud->format_count++;
    }
    while (gud->mode_count < SIM_GUD_MODES_MAX && config->modes[gud->mode_count][0]) {
        const uint16_t *mode = config->modes[gud->mode_count++];
        if (!mode[1] || mode[0] > SIM_PICTURE_MAX_PX || mode[1] > SIM_PICTURE_MAX_PX) {
            return sim_fail(error, "a GUD display has no mode of %u x %u", mode[0], mode[1]);
        }
        if (mode[0] > gud->most_width) { gud->most_width = mode[0]; }
        if (mode[1] > gud->most_height) { gud->most_height = mode[1]; }
    }
    if (!gud->most_width || !gud->most_height || config->connectors > SIM_GUD_CONNECTORS_MAX ||
        (config->rotations && !(config->rotations & 1u)) || config->rotations > 15 || config->edid_bytes > ANSWER_MAX_BYTES ||
        config->edid_bytes % 128u || (config->full_update && config->lz4)) {
        return sim_fail(error, "a GUD display that contradicts itself: modes, connectors, rotations, EDID or LZ4 of whole frames");
    }
    return 0;
}

sim_usb_t *sim_gud_create(const sim_gud_config_t *config, sim_error_t *error) {
    sim_gud_t *gud = calloc(1, sizeof *gud);
    size_t pixels;

    if (!gud) {
        sim_fail(error, "out of memory for a GUD display");
        return NULL;
    }
    if (config) { gud->config = *config; }
    if (settle_config(gud, error) || (pixels = (size_t)gud->most_width * gud->most_height) == 0) {
        destroy(&gud->usb);
        return NULL;
    }
    gud->transfer = malloc(4u * pixels);
    gud->pixels = malloc(4u * pixels);
    gud->memory = malloc(3u * pixels);
    if (!gud->transfer || !gud->pixels || !gud->memory) {
        sim_fail(error, "out of memory for a GUD display of %u x %u", gud->most_width, gud->most_height);
        destroy(&gud->usb);
        return NULL;
    }
    for (size_t i = 0; i < 3u * pixels; i++) {
        gud->memory[i] = (uint8_t)(i * 2654435761u >> 13);
    }
    gud->usb.control = control;
    gud->usb.bulk = bulk;
    gud->usb.reset = reset;
    gud->usb.clear_halt = clear_halt;
    gud->usb.picture = picture;
    gud->usb.destroy = destroy;
    gud->usb.strings[0] = "Tuile";
    gud->usb.strings[1] = "GUD display";
    gud->usb.strings[2] = gud->config.serial;
    describe(gud);
    reset(&gud->usb);
    return &gud->usb;
}

sim_gud_counts_t *sim_gud_counts(sim_usb_t *usb) { return &gud_of(usb)->counts; }

sim_gud_state_t sim_gud_state(const sim_usb_t *usb) { return gud_of_const(usb)->state; }

void sim_gud_break(sim_usb_t *usb, uint8_t status) { gud_of(usb)->broken = status; }
