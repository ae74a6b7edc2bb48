#include "panel.h"

#include "display.h"

#define COMMAND_MAX_BYTES 64u

tuile_panel_view_t tuile_panel_view(const TUILE_FLASH tuile_panel_t *panel, unsigned rotation) {
    unsigned mode = panel->mode[rotation & 3u];
    unsigned x = panel->offset_x, y = panel->offset_y;
    uint8_t align_x = panel->align_x ? panel->align_x : 1, align_y = panel->align_y ? panel->align_y : 1;

    if (mode & TUILE_MIRROR_X) { x = (unsigned)panel->ram_width - panel->view_width - panel->offset_x; }
    if (mode & TUILE_MIRROR_Y) { y = (unsigned)panel->ram_height - panel->view_height - panel->offset_y; }
    if (mode & TUILE_EXCHANGE) {
        return (tuile_panel_view_t){(uint16_t)y, (uint16_t)x, panel->view_height, panel->view_width, align_y, align_x};
    }
    return (tuile_panel_view_t){(uint16_t)x, (uint16_t)y, panel->view_width, panel->view_height, align_x, align_y};
}

/* ---- what goes over the bus ------------------------------------------------------------------------------------ */

static int delay(const tuile_panel_state_t *state, uint32_t delay_ms) {
    return delay_ms ? state->bus->delay_ms(state->bus->context, delay_ms) : TUILE_HAL_OK;
}

static int command(const tuile_panel_state_t *state, const uint8_t *bytes, size_t size_bytes) {
    return state->bus->command(state->bus->context, bytes, state->panel->parameters_low ? size_bytes : 1, size_bytes);
}

static int command_byte(const tuile_panel_state_t *state, uint8_t code, uint8_t parameter) {
    const uint8_t bytes[2] = {code, parameter};

    return command(state, bytes, 2);
}

static int command_alone(const tuile_panel_state_t *state, uint8_t code) { return command(state, &code, 1); }

/* A command as it stands in a table. */
static int command_of(const tuile_panel_state_t *state, const TUILE_FLASH uint8_t *bytes, size_t size_bytes) {
#if TUILE_FLASH_APART
    uint8_t copy[COMMAND_MAX_BYTES];

    for (size_t i = 0; i < size_bytes; i++) {
        copy[i] = bytes[i];
    }
    return command(state, copy, size_bytes);
#else
    return command(state, bytes, size_bytes);
#endif
}

static int sequence(const tuile_panel_state_t *state, const TUILE_FLASH tuile_sequence_t *steps) {
    const TUILE_FLASH uint8_t *at = steps->bytes;
    size_t left = steps->size_bytes;

    while (left > 0) {
        size_t count = *at ? *at : 2u;
        int result;

        if (count + 1 > left || count > COMMAND_MAX_BYTES) {
            return TUILE_HAL_PROTOCOL; /* our table is damaged: nothing can be sent after it */
        }
        result = *at ? command_of(state, at + 1, count) : delay(state, (uint32_t)at[1] << 8 | at[2]);
        if (result) { return result; }
        at += count + 1;
        left -= count + 1;
    }
    return TUILE_HAL_OK;
}

static bool has_pin(const tuile_panel_state_t *state, tuile_pin_t pin) {
    return state->bus->pin && (state->bus->pins & TUILE_PIN_BIT(pin)) != 0;
}

static int set_pin(const tuile_panel_state_t *state, tuile_pin_t pin, uint8_t level) {
    return has_pin(state, pin) ? state->bus->pin(state->bus->context, pin, level) : TUILE_HAL_OK;
}

/* ---- configuration ---------------------------------------------------------------------------------------------- */

static bool exchanges(const TUILE_FLASH tuile_panel_t *panel, unsigned rotation) {
    return (panel->mode[rotation] & TUILE_EXCHANGE) != 0;
}

/* The name for quarter turns is for quarter turns only. */
static const TUILE_FLASH tuile_panel_format_t *find_format(const TUILE_FLASH tuile_panel_t *panel, unsigned rotation,
                                                           uint8_t wire) {
    for (unsigned i = 0; i < panel->format_count; i++) {
        if (wire == TUILE_WIRE_DEFAULT || panel->formats[i].wire == wire ||
            (panel->formats[i].turned == wire && exchanges(panel, rotation))) {
            return &panel->formats[i];
        }
    }
    return NULL;
}

static int describe(void *context, const tuile_display_config_t *config, tuile_view_t *view) {
    tuile_panel_state_t *state = context;
    const tuile_bus_t *bus = config->bus;
    const TUILE_FLASH tuile_panel_t *panel = config->panel;
    const TUILE_FLASH tuile_panel_format_t *format;

    if (!bus || !panel || !bus->command || !bus->data || !bus->delay_ms ||
        (bus->max_chunk_bytes && bus->max_chunk_bytes < TUILE_CHUNK_LEAST_BYTES) || panel->format_count > TUILE_PANEL_FORMATS_MAX) {
        return TUILE_HAL_ARGUMENT;
    }
    format = find_format(panel, config->rotation, config->wire);
    if (!format || (config->tearing_timeout_ms && (!bus->tearing || !panel->tearing.size_bytes)) ||
        (config->identify && (!bus->read || !panel->id_command))) {
        return TUILE_HAL_UNSUPPORTED;
    }
    *state = (tuile_panel_state_t){
        .panel = panel,
        .bus = bus,
        .view = tuile_panel_view(panel, config->rotation),
        .command_clock_hz = config->command_clock_hz ? config->command_clock_hz : panel->command_clock_hz,
        .pixel_clock_hz = config->pixel_clock_hz ? config->pixel_clock_hz : panel->pixel_clock_hz,
        .tearing_timeout_ms = config->tearing_timeout_ms,
        .rotation = config->rotation,
        .format_code = format->code,
        .identify = config->identify,
    };
    *view = (tuile_view_t){
        .width = state->view.width,
        .height = state->view.height,
        .align_x = state->view.align_x,
        .align_y = state->view.align_y,
        .wire = format->wire,
        .dimmable = has_pin(state, TUILE_PIN_BACKLIGHT) || panel->brightness_command,
        .queues = TUILE_BUS_QUEUES && bus->wait_one &&
                  panel->addressing != TUILE_ADDRESS_PAGE, /* whose pages have commands between them */
    };
    if (exchanges(panel, config->rotation) && format->turned) { view->wire = format->turned; }
    /* A byte of two pixels belongs to one row of one window. */
    if (tuile_wire_bits(format->wire) % 8u == 4 && !format->turned && view->align_x % 2u) {
        view->align_x = (uint8_t)(2u * view->align_x);
    }
    state->unit_bytes = tuile_wire_bits(view->wire) % 3u == 0 ? 6 : 2;
    return tuile_wire_bits(view->wire) ? TUILE_HAL_OK : TUILE_HAL_ARGUMENT;
}

/* ---- start ------------------------------------------------------------------------------------------------------ */

static int reset(const tuile_panel_state_t *state) {
    const TUILE_FLASH tuile_panel_t *panel = state->panel;
    int result = TUILE_HAL_OK;

    if (has_pin(state, TUILE_PIN_RESET)) {
        /* Driven high first, so that the pulse has an edge whatever the line was before. */
        if ((result = set_pin(state, TUILE_PIN_RESET, 1)) || (result = set_pin(state, TUILE_PIN_RESET, 0)) ||
            (result = delay(state, panel->reset_low_ms)) || (result = set_pin(state, TUILE_PIN_RESET, 1))) {
            return result;
        }
    } else if (panel->software_reset) {
        /* The pause before it: power may have come up just now, or a fault have struck while the panel was waking, when
         * a software reset is forbidden (ILI9341, 8.2.2). */
        if ((result = delay(state, panel->reset_wait_ms)) || (result = command_alone(state, panel->software_reset))) {
            return result;
        }
    }
    return delay(state, panel->reset_wait_ms);
}

/* Nothing but zeros or ones is what an open line reads as: then nobody answered, and that is said apart from a wrong answer. */
static int identify(const tuile_panel_state_t *state) {
    const TUILE_FLASH tuile_panel_t *panel = state->panel;
    uint8_t answer[sizeof panel->id] = {0};
    uint8_t both = 0xFF, any = 0;
    bool same = true;
    int result = state->bus->read(state->bus->context, panel->id_command, answer, panel->id_count);

    if (result) { return result; }
    for (unsigned i = 0; i < panel->id_count; i++) {
        both &= answer[i];
        any |= answer[i];
        same = same && answer[i] == panel->id[i];
    }
    if (same) { return TUILE_HAL_OK; }
    return any == 0 || both == 0xFF ? TUILE_HAL_PROTOCOL : TUILE_HAL_IDENTITY;
}

static int orient(const tuile_panel_state_t *state) {
    const TUILE_FLASH tuile_panel_t *panel = state->panel;
    const uint8_t invert = panel->invert_command[panel->inverted ? 1 : 0];
    int result = TUILE_HAL_OK;

    if (invert && (result = command_alone(state, invert))) { return result; }
    if (panel->rotation_command &&
        (result = command_byte(state, panel->rotation_command, panel->rotation_base | panel->rotation[state->rotation]))) {
        return result;
    }
    if ((result = sequence(state, &panel->turn[state->rotation]))) { return result; }
    return panel->format_command ? command_byte(state, panel->format_command, state->format_code) : TUILE_HAL_OK;
}

static int start(void *context) {
    tuile_panel_state_t *state = context;
    const tuile_bus_t *bus = state->bus;
    int result = TUILE_HAL_OK;

    state->in_frame = false;
    if (bus->clocks && (result = bus->clocks(bus->context, state->command_clock_hz, state->pixel_clock_hz))) { return result; }
    if ((result = set_pin(state, TUILE_PIN_BACKLIGHT, 0)) || (result = reset(state))) { return result; }
    if (state->identify && (result = identify(state))) { return result; }
    if ((result = sequence(state, &state->panel->init)) || (result = orient(state))) { return result; }
    return state->tearing_timeout_ms ? sequence(state, &state->panel->tearing) : TUILE_HAL_OK;
}

/* ---- a frame ---------------------------------------------------------------------------------------------------- */

static int set_range(const tuile_panel_state_t *state, uint8_t code, uint32_t first, uint32_t count, uint8_t unit) {
    const uint32_t last = unit ? (first + count) / unit - 1 : first + count - 1;
    uint8_t bytes[5] = {code};

    if (unit) { first /= unit; }
    if (state->panel->addressing == TUILE_ADDRESS_8) {
        bytes[1] = (uint8_t)first;
        bytes[2] = (uint8_t)last;
        return command(state, bytes, 3);
    }
    bytes[1] = (uint8_t)(first >> 8);
    bytes[2] = (uint8_t)first;
    bytes[3] = (uint8_t)(last >> 8);
    bytes[4] = (uint8_t)last;
    return command(state, bytes, 5);
}

static int window(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    tuile_panel_state_t *state = context;
    const TUILE_FLASH tuile_panel_t *panel = state->panel;
    const bool exchanged = exchanges(panel, state->rotation);
    int result = TUILE_HAL_OK;

    if (!state->in_frame && state->tearing_timeout_ms &&
        (result = state->bus->tearing(state->bus->context, state->tearing_timeout_ms))) {
        return result;
    }
    state->in_frame = true;
    x += state->view.x;
    y += state->view.y;
    if (exchanged && panel->fixed_axes) {
        uint32_t swap = x;
        x = y;
        y = swap;
        swap = width;
        width = height;
        height = swap;
    }
    if (panel->addressing == TUILE_ADDRESS_PAGE) {
        state->page = (uint8_t)(y / 8u);
        state->page_column = (uint16_t)x;
        state->page_bytes = width;
        state->page_left_bytes = 0;
        return TUILE_HAL_OK;
    }
    /* All of it every time, though a row of tiles has the same rows: a glitch then costs one tile and not the frame. */
    if (panel->row_first && exchanged && (result = set_range(state, panel->row_command, y, height, panel->unit_y))) {
        return result;
    }
    if ((result = set_range(state, panel->column_command, x, width, panel->unit_x)) ||
        (result = set_range(state, panel->row_command, y, height, panel->unit_y))) {
        return result;
    }
    return panel->write_command ? command_alone(state, panel->write_command) : TUILE_HAL_OK;
}

static int next_page(tuile_panel_state_t *state) {
    const uint8_t bytes[3] = {(uint8_t)(0xB0u | state->page), (uint8_t)(0x10u | state->page_column >> 4),
                              (uint8_t)(state->page_column & 15u)};

    state->page++;
    state->page_left_bytes = state->page_bytes;
    return state->bus->command(state->bus->context, bytes, 3, 3);
}

static int wait(void *context) {
    const tuile_bus_t *bus = ((const tuile_panel_state_t *)context)->bus;

    return bus->wait ? bus->wait(bus->context) : TUILE_HAL_OK;
}

static int wait_one(void *context) {
    const tuile_bus_t *bus = ((const tuile_panel_state_t *)context)->bus;

    return bus->wait_one(bus->context);
}

static int write(void *context, const uint8_t *bytes, size_t size_bytes) {
    tuile_panel_state_t *state = context;
    const tuile_bus_t *bus = state->bus;
    const bool pages = state->panel->addressing == TUILE_ADDRESS_PAGE, queues = TUILE_BUS_QUEUES && bus->wait_one && !pages;
    size_t chunk_bytes = size_bytes;
    int result = TUILE_HAL_OK;

    if (bus->max_chunk_bytes && bus->max_chunk_bytes < size_bytes) {
        chunk_bytes = (size_t)(bus->max_chunk_bytes - bus->max_chunk_bytes % state->unit_bytes); /* < size_bytes */
    }
    for (bool first = true; size_bytes > 0; first = false) {
        size_t now = size_bytes < chunk_bytes ? size_bytes : chunk_bytes;

        if (queues) {
            result = bus->wait_one(bus->context);
        } else if (!first) {
            result = wait(state);
        }
        if (result) { return result; }
        if (pages && state->page_left_bytes == 0 && (result = next_page(state))) { return result; }
        if (pages && now > state->page_left_bytes) { now = (size_t)state->page_left_bytes; }
        if ((result = bus->data(bus->context, bytes, now))) { return result; }
        if (pages) { state->page_left_bytes -= (uint32_t)now; }
        bytes += now;
        size_bytes -= now;
    }
    return TUILE_HAL_OK;
}

/* ---- light ------------------------------------------------------------------------------------------------------ */

static int brightness(void *context, uint8_t level) {
    const tuile_panel_state_t *state = context;
    const TUILE_FLASH tuile_panel_t *panel = state->panel;
    const unsigned most = panel->brightness_most ? panel->brightness_most : 255u;

    if (has_pin(state, TUILE_PIN_BACKLIGHT)) { return set_pin(state, TUILE_PIN_BACKLIGHT, level); }
    return command_byte(state, panel->brightness_command, (uint8_t)((level * most + 127u) / 255u));
}

static int show(void *context, bool first) {
    tuile_panel_state_t *state = context;

    state->in_frame = false;
    return first ? sequence(state, &state->panel->on) : TUILE_HAL_OK;
}

static int sleep(void *context) {
    tuile_panel_state_t *state = context;
    const int dark = set_pin(state, TUILE_PIN_BACKLIGHT, 0);
    const int asleep = sequence(state, &state->panel->sleep);

    return dark ? dark : asleep;
}

const TUILE_FLASH tuile_device_t tuile_panel_device = {
    .describe = describe,
    .start = start,
    .window = window,
    .write = write,
    .wait = wait,
    .wait_one = TUILE_BUS_QUEUES ? wait_one : NULL,
    .show = show,
    .brightness = brightness,
    .sleep = sleep,
};
