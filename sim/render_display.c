#include "render_display.h"

#include "../firmware/stream.h"
#include "commands.h"
#include "render_format.h"
#include "render_value.h"

#include <stdio.h>
#include <string.h>

const char render_display_usage[] =
    "  --panel NAME             a simulated panel, ili9341 by default; `tuile panels` lists them\n"
    "  --display WHERE          or any display: `tuile card --help` says how they are named\n"
    "  --rotate 0|90|180|270    how the panel is held\n"
    "  --mcu NAME               a microcontroller that drives it: its clocks, and how many frames a second it would show;\n"
    "                           `tuile mcus` lists them\n"
    "  --clock HZ               clock of the bus for pixels, like 40M; 0 asks for the panel's usual one\n";

bool render_display_option(render_display_t *part, options_t *options, const char *argument) {
    static const char *const rotations[] = {"0", "90", "180", "270", NULL};
    const bool panel = strcmp(argument, "--panel") == 0;
    int choice;
    if (panel || strcmp(argument, "--display") == 0) {
        const char *value = options_value(options);
        sim_error_t error = {""};
        if (!value) { return true; }
        part->named = true;
        if ((panel ? target_parse_panel : target_parse)(&part->config, value, &error) != 0) {
            (void)command_fail("%s", error.text);
            options->failed = true;
        }
    } else if (strcmp(argument, "--rotate") == 0) {
        if (options_choice(options, &choice, rotations)) { part->rotation = (uint8_t)choice; }
    } else if (strcmp(argument, "--mcu") == 0) {
        const char *value = options_value(options);
        if (!value) { return true; }
        part->mcu = sim_mcu_find(value);
        if (!part->mcu) {
            (void)command_fail("--mcu %s: there is none; `tuile mcus` lists them", value);
            options->failed = true;
        }
    } else if (strcmp(argument, "--clock") == 0) {
        (void)render_value_clock(options, &part->clock_hz);
    } else {
        return false;
    }
    return true;
}

/* The format by whichever of its names: at a quarter turn it has two. DEFAULT when the panel has none such. */
static uint8_t find_wire(const tuile_panel_t *panel, uint8_t wire) {
    for (unsigned i = 0; i < panel->format_count; i++) {
        if (panel->formats[i].wire == wire || panel->formats[i].turned == wire) { return panel->formats[i].wire; }
    }
    return TUILE_WIRE_DEFAULT;
}

static int refuse_wire(const tuile_panel_t *panel, uint8_t wire) {
    char list[160] = "";
    for (unsigned i = 0; i < panel->format_count; i++) {
        const size_t used = strlen(list);
        (void)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "",
                       render_format_name((uint8_t)(panel->formats[i].wire - 1)));
    }
    return command_fail("--format %s: %s takes %s", render_format_name((uint8_t)(wire - 1)), panel->name, list);
}

int render_display_open(const render_display_t *part, target_t *target, uint8_t wire) {
    target_config_t config = part->config;
    sim_error_t error = {""};
    if (!part->named && target_parse_panel(&config, "ili9341", &error) != 0) { return command_fail("%s", error.text); }
    if (part->mcu && config.kind != TARGET_SIM) {
        return command_fail("--mcu %s: goes with a simulated panel, not with %s", part->mcu->name, config.text);
    }
    if (part->mcu && config.mcu && config.mcu != part->mcu) {
        return command_fail("--mcu %s: %s names another", part->mcu->name, config.text);
    }
    if (part->mcu) { config.mcu = part->mcu; }
    if (part->clock_hz) { config.clock_hz = (uint32_t)part->clock_hz; }
    if (config.module && wire != TUILE_WIRE_DEFAULT) {
        const uint8_t found = find_wire(&config.panel, wire);
        if (!found) { return refuse_wire(&config.panel, wire); }
        wire = found;
    }
    return target_open(target, &config, part->rotation, wire, &error) ? command_fail("%s", error.text) : 0;
}

void render_display_warn(const render_display_t *part, const target_t *target) {
    if ((part->clock_hz || part->config.clock_hz) && target->chip && target->chip->warning.text[0]) {
        (void)fprintf(stderr, "tuile: note: %s\n", target->chip->warning.text);
    }
}

void render_display_apply(const target_t *target, tuile_config_t *config) {
    config->width = target->display.width;
    config->height = target->display.height;
    config->format = tuile_stream_format(&target->display);
}

int render_display_check_tile(const target_t *target, const tuile_config_t *config) {
    const tuile_display_t *display = &target->display;
    if ((config->tile_width && config->tile_width < config->width && config->tile_width % display->align_x != 0) ||
        (config->tile_height && config->tile_height < config->height && config->tile_height % display->align_y != 0)) {
        return command_fail("--tile %ux%u: tiles of this display are multiples of %ux%u pixels", config->tile_width,
                            config->tile_height, display->align_x, display->align_y);
    }
    return 0;
}
