#include "gud.h"

#include <lz4.h>
#include <string.h>

#include "../display.h"
#include "gud_protocol.h"

enum { BUFFER_BYTES = 25, STATE_BYTES = TUILE_GUD_MODE_BYTES + 2, PROPERTY_BYTES = 10 };

/* ---- configuration ---------------------------------------------------------------------------------------------- */

/* The best first: colours, then greys, then fewer of either; of equals the one of fewer bytes. */
static const uint8_t by_quality[] = {TUILE_WIRE_RGB565_LE, TUILE_WIRE_BGR888,   TUILE_WIRE_XRGB8888, TUILE_WIRE_RGB332,
                                     TUILE_WIRE_GREY8,     TUILE_WIRE_XRGB1111, TUILE_WIRE_MONO_ROWS};

static uint8_t align_x(uint8_t wire) {
    const unsigned bits = tuile_wire_bits(wire);

    return (uint8_t)(bits < 8 ? 8u / bits : 1u);
}

/* A row ends with a byte, or its last pixels could not be in any window; and a device that cannot hold a row takes nothing. */
static bool can_show(const tuile_gud_t *gud, uint8_t wire, uint32_t width) {
    return gud->wires & 1u << wire && width % align_x(wire) == 0 && width * tuile_wire_bits(wire) / 8u <= gud->buffer_most_bytes;
}

static uint8_t choose_wire(const tuile_gud_t *gud, uint8_t wire, uint32_t width) {
    for (unsigned i = 0; i < sizeof by_quality; i++) {
        if ((wire == TUILE_WIRE_DEFAULT || wire == by_quality[i]) && can_show(gud, by_quality[i], width)) { return by_quality[i]; }
    }
    return 0;
}

static void set_property(tuile_gud_t *gud, uint16_t id, uint64_t value) {
    for (unsigned i = 0; i < gud->property_count; i++) {
        if (gud->properties[i].id == id) { gud->properties[i].value = value; }
    }
}

static int describe(void *context, const tuile_display_config_t *config, tuile_view_t *view) {
    tuile_gud_t *gud = context;
    const bool turned = config->rotation % 2u != 0;
    const uint16_t width = turned ? gud->height : gud->width, height = turned ? gud->width : gud->height;
    /* The protocol turns pictures against the clock. */
    const unsigned rotation = 1u << (4u - config->rotation) % 4u;
    const uint8_t wire = choose_wire(gud, config->wire, width);

    if (!gud->usb.handle) { return TUILE_HAL_ARGUMENT; }
    if (!wire || (config->rotation && !(gud->rotations & rotation)) || config->tearing_timeout_ms || config->identify) {
        return TUILE_HAL_UNSUPPORTED;
    }
    gud->wire = wire;
    gud->format = tuile_gud_format(wire);
    gud->view_width = width;
    gud->view_height = height;
    set_property(gud, TUILE_GUD_ROTATION, rotation);
    *view = (tuile_view_t){.width = width, .height = height, .align_x = align_x(wire), .align_y = 1, .wire = wire};
    view->dimmable = gud->dimmable;
    return TUILE_HAL_OK;
}

/* ---- state ------------------------------------------------------------------------------------------------------ */

static int set_byte(tuile_gud_t *gud, uint8_t request, uint8_t value) { return tuile_gud_set(gud, request, 0, &value, 1); }

static uint8_t *put_properties(const tuile_gud_t *gud, unsigned first, unsigned end, uint8_t *to) {
    for (unsigned i = first; i < end; i++) {
        const tuile_gud_property_t *property = &gud->properties[i];
        to = tuile_gud_put32(tuile_gud_put16(to, property->id), (uint32_t)property->value);
        to = tuile_gud_put32(to, (uint32_t)(property->value >> 32));
    }
    return to;
}

/* All of it, every time: mode, format, connector, and all properties that the display has named. */
static int check_state(tuile_gud_t *gud) {
    uint8_t bytes[STATE_BYTES + TUILE_GUD_PROPERTIES_MAX * PROPERTY_BYTES], *to = bytes + STATE_BYTES;

    memcpy(bytes, gud->mode, TUILE_GUD_MODE_BYTES);
    bytes[TUILE_GUD_MODE_BYTES] = gud->format;
    bytes[TUILE_GUD_MODE_BYTES + 1] = gud->connector;
    to = put_properties(gud, gud->device_property_count, gud->property_count, to); /* the connector's come first here */
    to = put_properties(gud, 0, gud->device_property_count, to);
    return tuile_gud_set(gud, TUILE_GUD_SET_STATE_CHECK, 0, bytes, (uint16_t)(to - bytes));
}

static int wait(void *context);

/* The kernel's order but for the last step: the display is enabled when the first frame is there. */
static int start(void *context) {
    tuile_gud_t *gud = context;
    int result;

    (void)tuile_usb_bulk_wait(&gud->usb);
    gud->error_text[0] = 0;
    if (gud->bulk_bad && (result = tuile_usb_clear_halt(&gud->usb, gud->usb.out))) {
        return tuile_usb_fail(&gud->usb, result, "clearing the halt: %s", gud->usb.words);
    }
    if ((result = check_state(gud)) || (result = set_byte(gud, TUILE_GUD_SET_CONTROLLER_ENABLE, 1)) ||
        (result = tuile_gud_set(gud, TUILE_GUD_SET_STATE_COMMIT, 0, NULL, 0)) ||
        (result = set_byte(gud, TUILE_GUD_SET_DISPLAY_ENABLE, 0))) {
        return result;
    }
    gud->lit = false;
    return TUILE_HAL_OK;
}

static int light(tuile_gud_t *gud, bool on) {
    const int result = gud->lit == on ? TUILE_HAL_OK : set_byte(gud, TUILE_GUD_SET_DISPLAY_ENABLE, on);

    if (!result) { gud->lit = on; }
    return result;
}

/* The device's 0 is its dimmest light, so that dark is a display that is switched off. */
static int brightness(void *context, uint8_t level) {
    tuile_gud_t *gud = context;
    int result;

    if (!level) { return light(gud, false); }
    set_property(gud, TUILE_GUD_BACKLIGHT, (level * 100u + 127u) / 255u);
    if ((result = check_state(gud)) || (result = tuile_gud_set(gud, TUILE_GUD_SET_STATE_COMMIT, 0, NULL, 0))) { return result; }
    return light(gud, true);
}

static int sleep(void *context) {
    tuile_gud_t *gud = context;
    const int waited = wait(gud);
    const int dark = set_byte(gud, TUILE_GUD_SET_DISPLAY_ENABLE, 0);
    const int off = set_byte(gud, TUILE_GUD_SET_CONTROLLER_ENABLE, 0);

    gud->lit = false;
    if (waited) { return waited; }
    return dark ? dark : off;
}

/* ---- pixels ----------------------------------------------------------------------------------------------------- */

static int wait(void *context) {
    tuile_gud_t *gud = context;
    const int result = tuile_usb_bulk_wait(&gud->usb);

    if (!result) { return TUILE_HAL_OK; }
    gud->bulk_bad = true;
    return tuile_gud_explain(gud, result, "pixels");
}

static int announce(tuile_gud_t *gud, const tuile_gud_window_t *part, uint32_t length, uint32_t compressed_length) {
    uint8_t bytes[BUFFER_BYTES], *to = bytes;

    to = tuile_gud_put32(tuile_gud_put32(to, part->x), part->y);
    to = tuile_gud_put32(tuile_gud_put32(to, part->width), part->height);
    to = tuile_gud_put32(to, length);
    *to++ = compressed_length ? 1 : 0;
    tuile_gud_put32(to, compressed_length);
    return tuile_gud_set(gud, TUILE_GUD_SET_BUFFER, 0, bytes, BUFFER_BYTES);
}

/* One update. bytes are held until the next wait. */
static int send_part(tuile_gud_t *gud, const tuile_gud_window_t *part, const uint8_t *bytes, uint32_t length) {
    int compressed_length = 0, result;

    /* A block that would not be smaller does not fit, and the pixels go as they are. */
    if (gud->lz4 && length > 1) {
        compressed_length = LZ4_compress_fast_extState(gud->lz4_state, (const char *)bytes, (char *)gud->compressed, (int)length,
                                                       (int)length - 1, 1);
        if (compressed_length > 0) { bytes = gud->compressed; }
    }
    /* Whole frames are announced only when the one before them was cut. */
    if ((!gud->full_update || gud->bulk_bad) && (result = announce(gud, part, length, (uint32_t)compressed_length))) {
        return result;
    }
    result = tuile_usb_bulk(&gud->usb, gud->usb.out, (uint8_t *)(uintptr_t)bytes,
                            compressed_length > 0 ? (uint32_t)compressed_length : length);
    if (!result) {
        gud->bulk_bad = false;
        return TUILE_HAL_OK;
    }
    gud->bulk_bad = true;
    return tuile_gud_explain(gud, result, "pixels");
}

/* In as many updates as the device's buffer asks for, cut between rows; the last one is on its way when this returns. */
static int send(tuile_gud_t *gud, const tuile_gud_window_t *window, const uint8_t *bytes) {
    const uint32_t pitch = window->width * tuile_wire_bits(gud->wire) / 8u, most = gud->buffer_most_bytes / pitch;
    tuile_gud_window_t part = *window;
    int result;

    for (uint32_t done = 0; done < window->height; done += part.height) {
        if ((result = wait(gud))) { return result; }
        part.y = window->y + done;
        part.height = window->height - done < most ? window->height - done : most;
        if ((result = send_part(gud, &part, bytes + (size_t)done * pitch, part.height * pitch))) { return result; }
    }
    return TUILE_HAL_OK;
}

static int window(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    tuile_gud_t *gud = context;

    gud->window = (tuile_gud_window_t){x, y, width, height};
    gud->window_bytes = width * tuile_wire_bits(gud->wire) / 8u * height;
    gud->staged_bytes = 0;
    return TUILE_HAL_OK;
}

/* Into the frame, row by row; a write may end within a row. */
static void keep(tuile_gud_t *gud, const uint8_t *bytes, size_t size_bytes) {
    const unsigned bits = tuile_wire_bits(gud->wire);
    const size_t row = gud->window.width * bits / 8u, pitch = gud->view_width * bits / 8u;
    size_t at = gud->staged_bytes;

    gud->staged_bytes += (uint32_t)size_bytes;
    while (size_bytes > 0) {
        const size_t column = at % row, now = size_bytes < row - column ? size_bytes : row - column;
        memcpy(gud->stage + (gud->window.y + at / row) * pitch + gud->window.x * bits / 8u + column, bytes, now);
        at += now;
        bytes += now;
        size_bytes -= now;
    }
}

static int write(void *context, const uint8_t *bytes, size_t size_bytes) {
    tuile_gud_t *gud = context;

    if (gud->full_update) {
        keep(gud, bytes, size_bytes);
        return TUILE_HAL_OK;
    }
    if (size_bytes == gud->window_bytes) { return send(gud, &gud->window, bytes); }
    memcpy(gud->stage + gud->staged_bytes, bytes, size_bytes);
    gud->staged_bytes += (uint32_t)size_bytes;
    return gud->staged_bytes == gud->window_bytes ? send(gud, &gud->window, gud->stage) : TUILE_HAL_OK;
}

static int show(void *context, bool first) {
    tuile_gud_t *gud = context;
    int result;

    if (gud->full_update) {
        const tuile_gud_window_t frame = {0, 0, gud->view_width, gud->view_height};
        if ((result = send(gud, &frame, gud->stage)) || (result = wait(gud))) { return result; }
    }
    return first ? light(gud, true) : TUILE_HAL_OK;
}

const tuile_device_t tuile_gud_device = {
    .describe = describe,
    .start = start,
    .window = window,
    .write = write,
    .wait = wait,
    .show = show,
    .brightness = brightness,
    .sleep = sleep,
};
