#include "display.h"

#define COMMAND_MAX_BYTES 64u

const char *tuile_hal_error_text(int error) {
    switch (error) {
    case TUILE_HAL_OK: return "no error";
    case TUILE_HAL_ARGUMENT: return "display: an argument is out of range";
    case TUILE_HAL_STATE: return "display: the call does not fit here (no window, window not filled, asleep, not initialised)";
    case TUILE_HAL_UNSUPPORTED: return "display: the bus or the panel cannot do this";
    case TUILE_HAL_IO: return "display: a transfer failed";
    case TUILE_HAL_TIMEOUT: return "display: a transfer or the tearing-effect line timed out";
    case TUILE_HAL_PROTOCOL: return "display: the panel refused what was sent";
    case TUILE_HAL_GONE: return "display: the device is gone; open it anew";
    default: return "display: unknown error";
    }
}

/* Every result of the bus goes through here: the one place where an error begins to stick. A port's own codes are not let
 * through, lest they be taken for another layer's. */
static int settle(tuile_display_t *display, int result) {
    if (result >= 0) { return TUILE_HAL_OK; }
    if (result > TUILE_HAL_ARGUMENT || result < TUILE_HAL_GONE) { result = TUILE_HAL_IO; }
    display->error = result;
    return result;
}

static int quiet(tuile_display_t *display) {
    const tuile_bus_t *bus = display->config.bus;

    if (!display->in_flight) { return TUILE_HAL_OK; }
    display->in_flight = false;
    return bus->wait ? settle(display, bus->wait(bus->context)) : TUILE_HAL_OK;
}

/* Before anything is sent. */
static int ready(tuile_display_t *display) {
    if (display->error) { return display->error; }
    if (!display->config.bus || display->asleep) { return TUILE_HAL_STATE; }
    return quiet(display);
}

static int delay(tuile_display_t *display, uint32_t delay_ms) {
    const tuile_bus_t *bus = display->config.bus;

    return delay_ms ? settle(display, bus->delay_ms(bus->context, delay_ms)) : TUILE_HAL_OK;
}

static int command(tuile_display_t *display, const uint8_t *bytes, size_t size_bytes) {
    const tuile_bus_t *bus = display->config.bus;
    size_t low_count = display->config.panel->parameters_low ? size_bytes : 1;

    return settle(display, bus->command(bus->context, bytes, low_count, size_bytes));
}

static int sequence(tuile_display_t *display, const tuile_sequence_t *steps) {
    const uint8_t *at = steps->bytes;
    size_t left = steps->size_bytes;

    while (left > 0) {
        size_t count = *at ? *at : 2u;
        int result;

        if (count + 1 > left || count > COMMAND_MAX_BYTES) {
            return settle(display, TUILE_HAL_PROTOCOL); /* our table is damaged: nothing can be sent after it */
        }
        result = *at ? command(display, at + 1, count) : delay(display, (uint32_t)at[1] << 8 | at[2]);
        if (result) { return result; }
        at += count + 1;
        left -= count + 1;
    }
    return TUILE_HAL_OK;
}

static bool has_pin(const tuile_display_t *display, tuile_pin_t pin) {
    return display->config.bus->pin && (display->config.bus->pins & TUILE_PIN_BIT(pin)) != 0;
}

static int set_pin(tuile_display_t *display, tuile_pin_t pin, uint8_t level) {
    const tuile_bus_t *bus = display->config.bus;

    return has_pin(display, pin) ? settle(display, bus->pin(bus->context, pin, level)) : TUILE_HAL_OK;
}

static int set_brightness(tuile_display_t *display, uint8_t level) {
    uint8_t bytes[2] = {display->config.panel->brightness_command, level};

    if (!has_pin(display, TUILE_PIN_BACKLIGHT) && bytes[0]) { return command(display, bytes, 2); }
    return set_pin(display, TUILE_PIN_BACKLIGHT, level);
}

static int reset(tuile_display_t *display) {
    const tuile_panel_t *panel = display->config.panel;
    uint8_t byte = panel->software_reset;
    int result = TUILE_HAL_OK;

    if (has_pin(display, TUILE_PIN_RESET)) {
        /* Driven high first, so that the pulse has an edge whatever the line was before. */
        if ((result = set_pin(display, TUILE_PIN_RESET, 1)) || (result = set_pin(display, TUILE_PIN_RESET, 0)) ||
            (result = delay(display, panel->reset_low_ms)) || (result = set_pin(display, TUILE_PIN_RESET, 1))) {
            return result;
        }
    } else if (byte) {
        /* The pause before it: power may have come up just now, or a fault have struck while the panel was waking, when
         * a software reset is forbidden (ILI9341, 8.2.2). */
        if ((result = delay(display, panel->reset_wait_ms)) || (result = command(display, &byte, 1))) { return result; }
    }
    return delay(display, panel->reset_wait_ms);
}

static int start(tuile_display_t *display) {
    const tuile_display_config_t *config = &display->config;
    const tuile_panel_t *panel = config->panel;
    const tuile_bus_t *bus = config->bus;
    uint8_t rotation[2] = {panel->rotation_command, (uint8_t)(panel->rotation_base | panel->rotation[config->rotation])};
    uint8_t format[2] = {panel->format_command, display->format_code};
    int result;

    display->refresh = true;
    display->in_frame = false;
    display->lit = false;
    display->asleep = false;
    display->left_bytes = 0;
    if (bus->clocks && (result = settle(display, bus->clocks(bus->context, config->command_clock_hz, config->pixel_clock_hz)))) {
        return result;
    }
    if ((result = set_pin(display, TUILE_PIN_BACKLIGHT, 0)) || (result = reset(display)) ||
        (result = sequence(display, &panel->init))) {
        return result;
    }
    if (panel->rotation_command && (result = command(display, rotation, 2))) { return result; }
    if (panel->format_command && (result = command(display, format, 2))) { return result; }
    if (config->tearing_timeout_ms && (result = sequence(display, &panel->tearing))) { return result; }
    return sequence(display, &panel->on);
}

int tuile_display_init(tuile_display_t *display, const tuile_display_config_t *config) {
    const tuile_bus_t *bus = config->bus;
    const tuile_panel_t *panel = config->panel;
    const tuile_panel_format_t *format = NULL;

    *display = (tuile_display_t){0};
    if (!bus || !panel || config->rotation > 3 || !bus->command || !bus->data || !bus->delay_ms ||
        (bus->max_chunk_bytes && bus->max_chunk_bytes < TUILE_CHUNK_LEAST_BYTES) || panel->format_count > TUILE_PANEL_FORMATS_MAX) {
        return TUILE_HAL_ARGUMENT;
    }
    for (unsigned i = 0; i < panel->format_count; i++) {
        if (panel->formats[i].wire == config->wire) { format = &panel->formats[i]; }
    }
    if (!format || (config->tearing_timeout_ms && (!bus->tearing || !panel->tearing.size_bytes))) { return TUILE_HAL_UNSUPPORTED; }
    display->config = *config;
    if (!config->command_clock_hz) { display->config.command_clock_hz = panel->command_clock_hz; }
    if (!config->pixel_clock_hz) { display->config.pixel_clock_hz = panel->pixel_clock_hz; }
    display->view = tuile_panel_view(panel, config->rotation);
    display->width = display->view.width;
    display->height = display->view.height;
    display->bits_per_pixel = format->bits_per_pixel;
    display->format_code = format->code;
    display->unit_bytes = format->bits_per_pixel % 3 == 0 ? 6 : 2;
    display->brightness = config->brightness ? config->brightness : 255;
    return start(display);
}

static int set_range(tuile_display_t *display, uint8_t code, uint32_t first, uint32_t last) {
    uint8_t bytes[5] = {code, (uint8_t)(first >> 8), (uint8_t)first, (uint8_t)(last >> 8), (uint8_t)last};

    return command(display, bytes, 5);
}

int tuile_display_window(tuile_display_t *display, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    const tuile_panel_view_t *view = &display->view;
    const tuile_bus_t *bus;
    const tuile_panel_t *panel;
    uint8_t code;
    int result = ready(display);

    if (result) { return result; }
    if (width == 0 || height == 0 || x >= view->width || y >= view->height || width > view->width - x ||
        height > view->height - y || x % view->align_x || width % view->align_x || y % view->align_y || height % view->align_y) {
        return TUILE_HAL_ARGUMENT;
    }
    bus = display->config.bus;
    panel = display->config.panel;
    if (!display->in_frame && display->config.tearing_timeout_ms &&
        (result = settle(display, bus->tearing(bus->context, display->config.tearing_timeout_ms)))) {
        return result;
    }
    display->in_frame = true;
    display->left_bytes = 0;
    x += view->x;
    y += view->y;
    code = panel->write_command;
    /* All three every time, though a row of tiles has the same rows: a glitch then costs one tile and not the frame. */
    if ((result = set_range(display, panel->column_command, x, x + width - 1)) ||
        (result = set_range(display, panel->row_command, y, y + height - 1)) || (result = command(display, &code, 1))) {
        return result;
    }
    display->left_bytes = width * height * display->bits_per_pixel / 8u; /* < 2^32 up to 178 million pixels */
    return TUILE_HAL_OK;
}

int tuile_display_write(tuile_display_t *display, const uint8_t *bytes, size_t size_bytes) {
    const tuile_bus_t *bus;
    size_t chunk_bytes = size_bytes;
    int result = ready(display);

    if (result) { return result; }
    if (display->left_bytes == 0 && size_bytes > 0) { return TUILE_HAL_STATE; }
    if (!bytes || size_bytes > display->left_bytes || (uint32_t)size_bytes * 8u % display->bits_per_pixel) {
        return TUILE_HAL_ARGUMENT;
    }
    bus = display->config.bus;
    if (bus->max_chunk_bytes && bus->max_chunk_bytes < size_bytes) {
        chunk_bytes = (size_t)(bus->max_chunk_bytes - bus->max_chunk_bytes % display->unit_bytes); /* < size_bytes */
    }
    while (size_bytes > 0) {
        size_t now = size_bytes < chunk_bytes ? size_bytes : chunk_bytes;

        if ((result = quiet(display)) || (result = settle(display, bus->data(bus->context, bytes, now)))) { return result; }
        display->in_flight = true;
        display->left_bytes -= (uint32_t)now;
        bytes += now;
        size_bytes -= now;
    }
    return TUILE_HAL_OK;
}

int tuile_display_wait(tuile_display_t *display) { return ready(display); }

int tuile_display_present(tuile_display_t *display) {
    int result = ready(display);

    if (result) { return result; }
    if (display->left_bytes) { return TUILE_HAL_STATE; }
    display->in_frame = false;
    if (!display->lit && (result = set_brightness(display, display->brightness))) { return result; }
    display->lit = true;
    display->refresh = false;
    return TUILE_HAL_OK;
}

int tuile_display_brightness(tuile_display_t *display, uint8_t level) {
    int result = ready(display);

    if (result) { return result; }
    if (!has_pin(display, TUILE_PIN_BACKLIGHT) && !display->config.panel->brightness_command) { return TUILE_HAL_UNSUPPORTED; }
    display->brightness = level;
    return display->lit ? set_brightness(display, level) : TUILE_HAL_OK;
}

int tuile_display_sleep(tuile_display_t *display) {
    int result = ready(display);

    if (result || (result = set_pin(display, TUILE_PIN_BACKLIGHT, 0)) ||
        (result = sequence(display, &display->config.panel->sleep))) {
        return result;
    }
    display->left_bytes = 0;
    display->asleep = true;
    return TUILE_HAL_OK;
}

int tuile_display_resume(tuile_display_t *display) {
    if (!display->config.bus) { return TUILE_HAL_STATE; }
    if (display->error == TUILE_HAL_GONE) { return display->error; }
    display->error = TUILE_HAL_OK;
    if (quiet(display) == TUILE_HAL_GONE) { return display->error; }
    display->error = TUILE_HAL_OK; /* what the old transfer came to no longer matters */
    return start(display);
}
