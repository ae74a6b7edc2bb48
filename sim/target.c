#include "target.h"

#include <time.h>

static uint64_t now_ns(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

static int open_sim(target_t *target, tuile_display_config_t *display, sim_error_t *error) {
    const target_config_t *config = &target->config;
    sim_bus_config_t bus = {.max_chunk_bytes = config->max_chunk_bytes};
    target->chip = config->module->create(error);
    if (!target->chip) { return -1; }
    if (config->mcu) {
        bus.clock_hz = sim_mcu_clock(config->mcu, display->pixel_clock_hz);
        bus.command_clock_hz = sim_mcu_clock(config->mcu, display->command_clock_hz);
        bus.command_gap_ns = bus.chunk_gap_ns = sim_mcu_transfer_ns(config->mcu);
        bus.blocking = config->mcu->polled;
        bus.queues = config->mcu->queues;
    }
    sim_bus_open(&target->bus, &bus, target->chip);
    display->bus = &target->bus.bus;
    return 0;
}

/* What an open that failed came to; text: the driver's words. */
static int refuse(const target_t *target, int result, const char *text, sim_error_t *error) {
    return sim_fail(error, "%s: %s%s%s", target->config.text, tuile_hal_error_text(result), text[0] ? ": " : "", text);
}

static tuile_linux_line_t line_of(const target_line_t *line) {
    return (tuile_linux_line_t){line->chip[0] ? line->chip : NULL, line->offset, line->active_low};
}

static int open_spi(target_t *target, tuile_display_config_t *display, sim_error_t *error) {
    const target_config_t *config = &target->config;
    const tuile_linux_config_t port = {.spi = config->device,
                                       .mode = config->mode,
                                       .dc = line_of(&config->dc),
                                       .reset = line_of(&config->reset),
                                       .backlight = line_of(&config->backlight),
                                       .tearing = line_of(&config->tearing),
                                       .no_worker = config->no_worker};
    const int result = tuile_linux_open(&target->port, &port);
    if (result) { return refuse(target, result, target->port.fault.text, error); }
    display->bus = &target->port.bus;
    return 0;
}

static int open_gud(target_t *target, tuile_display_config_t *display, sim_error_t *error) {
    const target_config_t *config = &target->config;
    const tuile_gud_config_t gud = {.serial = config->serial[0] ? config->serial : NULL,
                                    .width = config->mode_width,
                                    .height = config->mode_height,
                                    .no_compression = config->no_compression,
                                    .timeout_ms = config->timeout_ms};
    int result = config->wait_ms ? tuile_gud_wait_for(&gud, config->wait_ms) : TUILE_HAL_OK;
    if (result == TUILE_HAL_OK) { result = tuile_gud_open(&target->gud, &gud); }
    if (result) { return refuse(target, result, target->gud.error_text, error); }
    display->device = &tuile_gud_device;
    display->device_context = &target->gud;
    return 0;
}

static int open_ax206(target_t *target, tuile_display_config_t *display, sim_error_t *error) {
    const target_config_t *config = &target->config;
    const tuile_ax206_config_t frame = {.serial = config->serial[0] ? config->serial : NULL, .timeout_ms = config->timeout_ms};
    int result = config->wait_ms ? tuile_ax206_wait_for(&frame, config->wait_ms) : TUILE_HAL_OK;
    if (result == TUILE_HAL_OK) { result = tuile_ax206_open(&target->ax206, &frame); }
    if (result) { return refuse(target, result, target->ax206.error_text, error); }
    display->device = &tuile_ax206_device;
    display->device_context = &target->ax206;
    return 0;
}

static int start(target_t *target, const tuile_display_config_t *display, sim_error_t *error) {
    const int result = tuile_display_init(&target->display, display);
    return result ? refuse(target, result, target_detail(target), error) : 0;
}

static int (*const open_by_kind[])(target_t *target, tuile_display_config_t *display, sim_error_t *error) = {
    [TARGET_SIM] = open_sim, [TARGET_SPI] = open_spi, [TARGET_GUD] = open_gud, [TARGET_AX206] = open_ax206};

int target_open(target_t *target, const target_config_t *config, uint8_t rotation, uint8_t wire, sim_error_t *error) {
    *target = (target_t){.config = *config, .rotation = rotation};
    tuile_display_config_t display = {.panel = &target->config.panel,
                                      .rotation = rotation,
                                      .wire = wire,
                                      .brightness = config->brightness,
                                      .identify = config->identify,
                                      .tearing_timeout_ms = config->tearing_timeout_ms,
                                      .command_clock_hz = config->command_clock_hz,
                                      .pixel_clock_hz = config->clock_hz};
    if (!display.command_clock_hz) { display.command_clock_hz = config->panel.command_clock_hz; }
    if (!display.pixel_clock_hz) { display.pixel_clock_hz = config->panel.pixel_clock_hz; }
    if (open_by_kind[config->kind](target, &display, error) || start(target, &display, error)) {
        target_close(target);
        return -1;
    }
    return 0;
}

void target_close(target_t *target) {
    (void)tuile_display_close(&target->display);
    tuile_linux_close(&target->port);
    tuile_gud_close(&target->gud);
    tuile_ax206_close(&target->ax206);
    if (target->chip) { target->chip->destroy(target->chip); }
    target->chip = NULL;
}

const char *target_detail(const target_t *target) {
    if (target->config.kind == TARGET_GUD) { return target->gud.error_text; }
    if (target->config.kind == TARGET_AX206) { return target->ax206.error_text; }
    if (!target->chip) { return target->port.fault.text; }
    return target->bus.error.text[0] ? target->bus.error.text : target->chip->fault.text;
}

void target_begin_frame(target_t *target) {
    target->bus.counts = (sim_bus_counts_t){0};
    target->begun_ns = now_ns();
}

void target_frame_figures(const target_t *target, uint64_t *bytes, uint64_t *frame_ns) {
    const sim_bus_counts_t *counts = &target->bus.counts;
    *bytes = counts->command_bytes + counts->data_bytes;
    *frame_ns = target_is_simulated(target) ? counts->wire_ns + counts->gap_ns : now_ns() - target->begun_ns;
}

bool target_is_simulated(const target_t *target) { return target->chip != NULL; }

int target_picture(const target_t *target, sim_picture_t *seen, sim_picture_t *glass, sim_error_t *error) {
    if (!target->chip) { return sim_fail(error, "%s: only a simulated display can be looked at", target->config.text); }
    if (seen && sim_bus_picture(&target->bus, target->rotation, seen, error)) { return -1; }
    return glass ? target->chip->glass(target->chip, glass, error) : 0;
}
