/* Reads a trace of the PL061's pins and writes what a panel on them showed.
 *
 * Usage: panel_trace PANEL MODE FOLDER < TRACE   MODE: of SPI, 0 ... 3
 * FOLDER receives lit-1.ppm, lit-2.ppm ...: the glass as the module lies, each time the light goes out. One line on stdout tells
 * the counts of all; an error ends it with one line on stderr and the code 1. */
#include "pins.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../sim/panels.h"

typedef struct show {
    const char *folder;
    unsigned count;
} show_t;

static int write_glass(void *context, const sim_chip_t *chip, sim_error_t *error) {
    show_t *show = context;
    sim_picture_t picture;
    char path[4096];
    int result = chip->glass(chip, &picture, error);

    if (result) { return result; }
    (void)snprintf(path, sizeof path, "%s/lit-%u.ppm", show->folder, ++show->count);
    result = sim_picture_write(&picture, path, error);
    sim_picture_free(&picture);
    return result;
}

int main(int count, char **arguments) {
    show_t show;
    pins_t pins = {.seen = write_glass, .context = &show};
    const sim_panel_t *panel = count == 4 ? sim_panel_find(arguments[1]) : NULL;
    sim_error_t error = {""};
    char line[512];
    uint64_t lines = 0;
    int result = 0;

    if (!panel) {
        (void)fputs("Usage: panel_trace PANEL MODE FOLDER < TRACE\n", stderr);
        return 2;
    }
    show = (show_t){.folder = arguments[3]};
    pins.spi_mode = (uint8_t)(strtoul(arguments[2], NULL, 10) & 3u);
    pins.chip = panel->create(&error);
    if (!pins.chip) { result = -1; }
    while (result == 0 && fgets(line, sizeof line, stdin)) {
        result = pins_trace(&pins, line, &error);
        lines++;
    }
    if (result == 0) { result = pins_end(&pins, &error); }
    if (result == 0) {
        (void)printf("lines %" PRIu64 ", resets %u, lights %u, pictures %u, commands %" PRIu64 ", data bytes %" PRIu64
                     ", warnings %u\n",
                     lines, pins.resets, pins.lights, show.count, pins.commands, pins.data_bytes, pins.chip->warnings);
    } else {
        (void)fprintf(stderr, "panel_trace: %s (line %" PRIu64 ")\n", error.text, lines);
    }
    if (pins.chip) { pins.chip->destroy(pins.chip); }
    return result ? 1 : 0;
}
