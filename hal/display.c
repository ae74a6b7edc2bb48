#include "display.h"

const char *tuile_hal_error_text(int error) {
    switch (error) {
    case TUILE_HAL_OK: return "no error";
    case TUILE_HAL_ARGUMENT: return "display: an argument is out of range";
    case TUILE_HAL_STATE: return "display: the call does not fit here (no window, window not filled, asleep, not initialised)";
    case TUILE_HAL_UNSUPPORTED: return "display: the bus or the panel cannot do this";
    case TUILE_HAL_IO: return "display: a transfer failed";
    case TUILE_HAL_TIMEOUT: return "display: a transfer or the tearing-effect line timed out";
    case TUILE_HAL_PROTOCOL: return "display: the panel refused what was sent, or did not answer";
    case TUILE_HAL_GONE: return "display: the device is gone; open it anew";
    case TUILE_HAL_BUSY: return "display: somebody else uses the line or the device";
    case TUILE_HAL_NOT_FOUND: return "display: no such device, chip or line";
    case TUILE_HAL_PERMISSION: return "display: no permission to use the device";
    case TUILE_HAL_SIZE: return "display: a transfer is larger than the system takes";
    case TUILE_HAL_IDENTITY: return "display: another panel answers than was named";
    default: return "display: unknown error";
    }
}

/* Every result of the device goes through here: the one place where an error begins to stick. A port's own codes are not let
 * through, lest they be taken for another layer's. */
static int settle(tuile_display_t *display, int result) {
    if (result >= 0) { return TUILE_HAL_OK; }
    if (result > TUILE_HAL_ARGUMENT || result < TUILE_HAL_IDENTITY) { result = TUILE_HAL_IO; }
    display->error = result;
    return result;
}

static int quiet(tuile_display_t *display) {
    if (!display->in_flight) { return TUILE_HAL_OK; }
    display->in_flight = 0;
    return display->device->wait ? settle(display, display->device->wait(display->context)) : TUILE_HAL_OK;
}

static int awake(const tuile_display_t *display) {
    if (display->error) { return display->error; }
    return !display->device || display->asleep ? TUILE_HAL_STATE : TUILE_HAL_OK;
}

/* Before anything is sent. */
static int ready(tuile_display_t *display) {
    const int result = awake(display);

    return result ? result : quiet(display);
}

static int start(tuile_display_t *display) {
    display->refresh = true;
    display->lit = false;
    display->asleep = false;
    display->left_bytes = 0;
    return settle(display, display->device->start(display->context));
}

int tuile_display_init(tuile_display_t *display, const tuile_display_config_t *config) {
    const TUILE_FLASH tuile_device_t *device = config->device ? config->device : &tuile_panel_device;
    tuile_view_t view;
    int result;

    *display = (tuile_display_t){0};
    if (config->rotation > 3 || config->wire >= TUILE_WIRE_COUNT) { return TUILE_HAL_ARGUMENT; }
    display->context = config->device ? config->device_context : &display->panel;
    if ((result = device->describe(display->context, config, &view))) { return result; }
    display->device = device;
    display->width = view.width;
    display->height = view.height;
    display->align_x = view.align_x;
    display->align_y = view.align_y;
    display->wire = view.wire;
    display->dimmable = view.dimmable;
    if (TUILE_BUS_QUEUES) { display->queues = view.queues; }
    display->brightness = config->brightness ? config->brightness : 255;
    return start(display);
}

/* Pixels of 12 bits run on from row to row, so a window may end at an odd edge. */
static bool ends_at_edge(const tuile_display_t *display, uint32_t x, uint32_t width) {
    return display->wire == TUILE_WIRE_RGB444 && x + width == display->width;
}

int tuile_display_window(tuile_display_t *display, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    int result = ready(display);

    if (result) { return result; }
    if (width == 0 || height == 0 || x >= display->width || y >= display->height || width > display->width - x ||
        height > display->height - y || x % display->align_x || (width % display->align_x && !ends_at_edge(display, x, width)) ||
        y % display->align_y || height % display->align_y) {
        return TUILE_HAL_ARGUMENT;
    }
    display->left_bytes = 0;
    if ((result = settle(display, display->device->window(display->context, x, y, width, height)))) { return result; }
    display->left_bytes = (width * height * tuile_wire_bits(display->wire) + 7u) / 8u; /* < 2^32 up to 134 million pixels */
    return TUILE_HAL_OK;
}

int tuile_display_wait_one(tuile_display_t *display) {
    int result = awake(display);

    if (!TUILE_BUS_QUEUES || result || display->in_flight < 2) { return result; }
    result = settle(display, display->device->wait_one(display->context));
    display->in_flight = !result;
    return result;
}

/* Nothing is held, or one buffer by a device that queues. */
static int write(tuile_display_t *display, const uint8_t *bytes, size_t size_bytes) {
    int result;

    if (display->left_bytes == 0 && size_bytes > 0) { return TUILE_HAL_STATE; }
    if (!bytes || size_bytes > display->left_bytes ||
        ((uint32_t)size_bytes * 8u % tuile_wire_bits(display->wire) && size_bytes != display->left_bytes)) {
        return TUILE_HAL_ARGUMENT;
    }
    if (size_bytes == 0) { return TUILE_HAL_OK; }
    if ((result = settle(display, display->device->write(display->context, bytes, size_bytes)))) {
        if (TUILE_BUS_QUEUES) { display->in_flight = 0; }
        return result;
    }
    display->in_flight = TUILE_BUS_QUEUES ? (uint8_t)(display->in_flight + 1u) : 1u;
    display->left_bytes -= (uint32_t)size_bytes;
    return TUILE_HAL_OK;
}

int tuile_display_write(tuile_display_t *display, const uint8_t *bytes, size_t size_bytes) {
    const int result = ready(display);

    return result ? result : write(display, bytes, size_bytes);
}

int tuile_display_queue(tuile_display_t *display, const uint8_t *bytes, size_t size_bytes) {
    if (!TUILE_BUS_QUEUES || !display->queues) { return tuile_display_write(display, bytes, size_bytes); }
    const int result = tuile_display_wait_one(display);

    return result ? result : write(display, bytes, size_bytes);
}

int tuile_display_wait(tuile_display_t *display) { return ready(display); }

int tuile_display_present(tuile_display_t *display) {
    int result = ready(display);

    if (result) { return result; }
    if (display->left_bytes) { return TUILE_HAL_STATE; }
    if ((result = settle(display, display->device->show(display->context, !display->lit)))) { return result; }
    if (!display->lit && display->dimmable &&
        (result = settle(display, display->device->brightness(display->context, display->brightness)))) {
        return result;
    }
    display->lit = true;
    display->refresh = false;
    return TUILE_HAL_OK;
}

int tuile_display_brightness(tuile_display_t *display, uint8_t level) {
    int result = ready(display);

    if (result) { return result; }
    if (!display->dimmable) { return TUILE_HAL_UNSUPPORTED; }
    display->brightness = level;
    return display->lit ? settle(display, display->device->brightness(display->context, level)) : TUILE_HAL_OK;
}

int tuile_display_sleep(tuile_display_t *display) {
    int result = ready(display);

    if (result) { return result; }
    if ((result = settle(display, display->device->sleep(display->context)))) { return result; }
    display->left_bytes = 0;
    display->asleep = true;
    return TUILE_HAL_OK;
}

int tuile_display_resume(tuile_display_t *display) {
    if (!display->device) { return TUILE_HAL_STATE; }
    if (display->error == TUILE_HAL_GONE) { return display->error; }
    display->error = TUILE_HAL_OK;
    if (quiet(display) == TUILE_HAL_GONE) { return display->error; }
    display->error = TUILE_HAL_OK; /* what the old transfer came to no longer matters */
    return start(display);
}

int tuile_display_close(tuile_display_t *display) {
    int result = TUILE_HAL_OK;

    if (!display->device) { return TUILE_HAL_STATE; }
    if (display->error != TUILE_HAL_GONE && quiet(display) != TUILE_HAL_GONE && !display->asleep) {
        result = display->device->sleep(display->context);
    }
    *display = (tuile_display_t){.error = display->error == TUILE_HAL_GONE ? TUILE_HAL_GONE : TUILE_HAL_OK};
    return result;
}
