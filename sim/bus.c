#include "bus.h"

#include <string.h>

#define CLOCK_DEFAULT_HZ 10000000u /* a display that never told its clocks */

static uint32_t command_clock(const sim_bus_t *bus) {
    return bus->config.command_clock_hz ? bus->config.command_clock_hz : bus->asked_command_hz;
}

static uint32_t pixel_clock(const sim_bus_t *bus) { return bus->config.clock_hz ? bus->config.clock_hz : bus->asked_pixel_hz; }

/* size_bytes < 2^30 keeps the product below 2^64. */
static uint64_t wire_time(uint64_t size_bytes, uint32_t clock_hz) {
    return (size_bytes * 8u * UINT64_C(1000000000) + clock_hz - 1) / clock_hz;
}

static int misuse(sim_bus_t *bus, const char *what) {
    if (!bus->error.text[0]) { sim_fail(&bus->error, "simulated bus: %s", what); }
    return TUILE_HAL_STATE;
}

static void catch_up(sim_bus_t *bus) {
    if (bus->listener) { sim_bus_work(bus, bus->listener(bus->listener_context)); }
}

/* Counts a transfer and tells what becomes of it; *parts of 2 reach the chip. */
static int fate(sim_bus_t *bus, uint8_t *parts) {
    int code = bus->config.fail_code ? bus->config.fail_code : TUILE_HAL_IO;

    bus->transfers++;
    *parts = 2;
    if (bus->gone) {
        *parts = 0;
        return TUILE_HAL_GONE;
    }
    if (bus->transfers != bus->config.fail_transfer) { return TUILE_HAL_OK; }
    *parts = bus->config.fail_parts > 2 ? 2 : bus->config.fail_parts;
    bus->gone = code == TUILE_HAL_GONE;
    return code;
}

static int deliver(sim_bus_t *bus, bool data, const uint8_t *bytes, size_t size_bytes, uint32_t clock_hz, uint64_t at_ns) {
    if (size_bytes > 0 && bus->chip->receive(bus->chip, data, bytes, size_bytes, clock_hz, at_ns)) {
        if (!bus->error.text[0]) { bus->error = bus->chip->fault; }
        return TUILE_HAL_PROTOCOL;
    }
    return TUILE_HAL_OK;
}

static int bus_clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    sim_bus_t *bus = context;

    if (command_clock_hz == 0 || pixel_clock_hz == 0) { return misuse(bus, "a clock of 0 Hz"); }
    bus->asked_command_hz = command_clock_hz;
    bus->asked_pixel_hz = pixel_clock_hz;
    return TUILE_HAL_OK;
}

static int bus_command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    sim_bus_t *bus = context;
    uint64_t start_ns, wire_ns = wire_time(size_bytes, command_clock(bus));
    uint8_t parts;
    size_t arrive, low;
    int result, refused;

    catch_up(bus);
    start_ns = bus->now_ns + bus->config.command_gap_ns;
    if (bus->flying) { return misuse(bus, "a command while data are in flight"); }
    if (low_count == 0 || low_count > size_bytes || size_bytes > 64) {
        return misuse(bus, "a command without a command byte, or of more than 64 bytes");
    }
    result = fate(bus, &parts);
    arrive = size_bytes * parts / 2;
    low = arrive < low_count ? arrive : low_count;
    bus->counts.commands++;
    bus->counts.command_bytes += size_bytes;
    bus->counts.wire_ns += wire_ns;
    bus->counts.gap_ns += bus->config.command_gap_ns;
    bus->now_ns = start_ns + wire_ns;
    refused = deliver(bus, false, bytes, low, command_clock(bus), start_ns);
    refused = refused ? refused : deliver(bus, true, bytes + low, arrive - low, command_clock(bus), start_ns);
    return result ? result : refused;
}

/* Until `left` are in flight; none after an error. */
static int land(sim_bus_t *bus, unsigned left) {
    int result = TUILE_HAL_OK;

    while (!result && bus->flying > left) {
        const sim_bus_flight_t flight = bus->flights[0];
        int refused;

        bus->flights[0] = bus->flights[1];
        bus->flying--;
        if (bus->now_ns < flight.end_ns) {
            bus->counts.idle_ns += flight.end_ns - bus->now_ns;
            bus->now_ns = flight.end_ns;
        }
        refused = deliver(bus, true, flight.bytes, flight.size_bytes * flight.parts / 2, pixel_clock(bus), flight.start_ns);
        result = flight.result ? flight.result : refused;
    }
    if (result) { bus->flying = 0; }
    return result;
}

static int bus_data(void *context, const uint8_t *bytes, size_t size_bytes) {
    sim_bus_t *bus = context;
    uint64_t wire_ns = wire_time(size_bytes, pixel_clock(bus)), rest_ns;
    sim_bus_flight_t flight = {.bytes = bytes, .size_bytes = size_bytes};

    catch_up(bus);
    if (bus->flying > (bus->config.queues ? 1u : 0u)) { return misuse(bus, "data while data are in flight"); }
    if (!bytes || size_bytes == 0) { return misuse(bus, "data of no bytes"); }
    if (bus->config.max_chunk_bytes && size_bytes > bus->config.max_chunk_bytes) {
        return misuse(bus, "a chunk larger than the bus takes");
    }
    flight.start_ns = bus->now_ns + bus->config.chunk_gap_ns;
    if (bus->flying && flight.start_ns < bus->flights[0].end_ns) { flight.start_ns = bus->flights[0].end_ns; }
    rest_ns = flight.start_ns - (bus->flying && bus->flights[0].end_ns > bus->now_ns ? bus->flights[0].end_ns : bus->now_ns);
    flight.end_ns = flight.start_ns + wire_ns;
    if (!bus->flying || !bus->flights[0].result) { /* else it will never be on the wire */
        flight.result = fate(bus, &flight.parts);
        bus->counts.chunks++;
        bus->counts.data_bytes += size_bytes;
        bus->counts.wire_ns += wire_ns;
        bus->counts.gap_ns += rest_ns;
    }
    bus->flights[bus->flying++] = flight;
    return bus->config.blocking ? land(bus, 0) : TUILE_HAL_OK;
}

static int bus_wait(void *context) {
    catch_up(context);
    return land(context, 0);
}

static int bus_wait_one(void *context) {
    catch_up(context);
    return land(context, 1);
}

static int bus_read(void *context, uint8_t command, uint8_t *bytes, size_t size_bytes) {
    sim_bus_t *bus = context;
    uint64_t wire_ns = wire_time(size_bytes + 1, command_clock(bus));
    uint8_t parts;
    int result;

    catch_up(bus);
    if (bus->flying) { return misuse(bus, "a read while data are in flight"); }
    result = fate(bus, &parts);
    bus->counts.commands++;
    bus->counts.command_bytes += size_bytes + 1;
    bus->counts.wire_ns += wire_ns;
    bus->counts.gap_ns += bus->config.command_gap_ns;
    bus->now_ns += bus->config.command_gap_ns;
    if (!result && bus->chip->read(bus->chip, command, bytes, size_bytes, bus->now_ns)) {
        result = TUILE_HAL_PROTOCOL;
        bus->error = bus->error.text[0] ? bus->error : bus->chip->fault;
    }
    bus->now_ns += wire_ns;
    return result;
}

static int bus_delay_ms(void *context, uint32_t delay_ms) {
    sim_bus_t *bus = context;

    catch_up(bus);
    bus->now_ns += delay_ms * UINT64_C(1000000);
    bus->counts.delay_ns += delay_ms * UINT64_C(1000000);
    return TUILE_HAL_OK;
}

static int bus_pin(void *context, tuile_pin_t pin, uint8_t level) {
    sim_bus_t *bus = context;

    if (!(bus->bus.pins & TUILE_PIN_BIT(pin))) { return misuse(bus, "a pin that is not there"); }
    if (pin == TUILE_PIN_BACKLIGHT) {
        bus->backlight = level;
    } else {
        bus->chip->reset(bus->chip, level == 0, bus->now_ns);
    }
    return TUILE_HAL_OK;
}

static int bus_tearing(void *context, uint32_t timeout_ms) {
    sim_bus_t *bus = context;
    uint64_t period_ns = UINT64_C(1000000000) / bus->config.refresh_hz, blank_ns;

    catch_up(bus);
    blank_ns = (bus->now_ns / period_ns + 1) * period_ns;
    if (!bus->chip->tearing || blank_ns - bus->now_ns > timeout_ms * UINT64_C(1000000)) { return TUILE_HAL_TIMEOUT; }
    bus->counts.idle_ns += blank_ns - bus->now_ns;
    bus->now_ns = blank_ns;
    return TUILE_HAL_OK;
}

void sim_bus_open(sim_bus_t *bus, const sim_bus_config_t *config, sim_chip_t *chip) {
    *bus = (sim_bus_t){.chip = chip, .asked_command_hz = CLOCK_DEFAULT_HZ, .asked_pixel_hz = CLOCK_DEFAULT_HZ};
    if (config) { bus->config = *config; }
    bus->backlight = bus->config.no_backlight_pin ? 255 : 0;
    bus->bus = (tuile_bus_t){
        .context = bus,
        .clocks = bus_clocks,
        .command = bus_command,
        .data = bus_data,
        .wait = bus->config.blocking ? NULL : bus_wait,
        .wait_one = bus->config.queues && !bus->config.blocking ? bus_wait_one : NULL,
        .read = bus_read,
        .delay_ms = bus_delay_ms,
        .pin = bus_pin,
        .tearing = bus->config.refresh_hz ? bus_tearing : NULL,
        .max_chunk_bytes = bus->config.max_chunk_bytes,
        .pins = (bus->config.no_reset_pin ? 0 : TUILE_PIN_BIT(TUILE_PIN_RESET)) |
                (bus->config.no_backlight_pin ? 0 : TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT)),
    };
}

void sim_bus_work(sim_bus_t *bus, uint64_t work_ns) {
    bus->now_ns += work_ns;
    bus->counts.work_ns += work_ns;
}

void sim_bus_listen(sim_bus_t *bus, sim_bus_work_fn work, void *context) {
    bus->listener = work;
    bus->listener_context = context;
}

int sim_bus_picture(const sim_bus_t *bus, unsigned rotation, sim_picture_t *out, sim_error_t *error) {
    sim_picture_t glass = {0};
    int result;

    *out = (sim_picture_t){0};
    if (bus->chip->glass(bus->chip, &glass, error)) { return -1; }
    if (bus->backlight == 0) { memset(glass.rgb, 0, (size_t)glass.width * glass.height * 3u); }
    result = sim_picture_turn(&glass, -(int)(rotation & 3u), out, error);
    sim_picture_free(&glass);
    return result;
}
