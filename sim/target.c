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
    }
    sim_bus_open(&target->bus, &bus, target->chip);
    display->bus = &target->bus.bus;
    return 0;
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
    if (result) { return sim_fail(error, "%s: %s: %s", config->text, tuile_hal_error_text(result), target->port.fault.text); }
    display->bus = &target->port.bus;
    return 0;
}

static int start(target_t *target, const tuile_display_config_t *display, sim_error_t *error) {
    const int result = tuile_display_init(&target->display, display);
    const char *detail = target_detail(target);
    if (result == TUILE_HAL_OK) { return 0; }
    return sim_fail(error, "%s: %s%s%s", target->config.text, tuile_hal_error_text(result), detail[0] ? ": " : "", detail);
}

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
    if ((config->kind == TARGET_SPI ? open_spi : open_sim)(target, &display, error) || start(target, &display, error)) {
        target_close(target);
        return -1;
    }
    return 0;
}

void target_close(target_t *target) {
    (void)tuile_display_close(&target->display);
    tuile_linux_close(&target->port);
    if (target->chip) { target->chip->destroy(target->chip); }
    target->chip = NULL;
}

const char *target_detail(const target_t *target) {
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
