/* Reads a trace of the PL061's pins and writes what panels on them showed.
 *
 * Usage: panel_trace FOLDER PANEL[:MODE] ... < TRACE   MODE: of SPI, 0 ... 3; 0 by default
 * Each pulse of the reset line begins a session; the first panel is there from the start, each further session has the next one,
 * just powered. FOLDER receives panel-N.ppm of session N = 1, 2 ...: the glass as the module lies, when the light last went out.
 * One line on stdout tells the counts of each session; an error, or more or fewer sessions than panels, ends all with a line on
 * stderr and the code 1. */
#include "pins.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../sim/panels.h"

typedef struct show {
    const char *folder;
    char **panels; /* of this session, and those to come */
    unsigned session;
} show_t;

static int plug(const show_t *show, pins_t *pins, sim_error_t *error) {
    const char *text = *show->panels, *mode = text ? strchr(text, ':') : NULL;
    const sim_panel_t *panel;
    char name[32];

    if (!text) { return sim_fail(error, "session %u has no panel", show->session); }
    (void)snprintf(name, sizeof name, "%.*s", (int)strcspn(text, ":"), text);
    panel = sim_panel_find(name);
    if (!panel) { return sim_fail(error, "there is no panel %s", name); }
    pins->spi_mode = (uint8_t)(mode ? (mode[1] - '0') & 3 : 0);
    pins->chip = panel->create(error);
    return pins->chip ? 0 : -1;
}

static void unplug(const show_t *show, pins_t *pins) {
    if (!pins->chip) { return; }
    (void)printf("%s: lights %u, commands %" PRIu64 ", data bytes %" PRIu64 ", warnings %u\n", *show->panels, pins->lights,
                 pins->commands, pins->data_bytes, pins->chip->warnings);
    pins->lights = 0;
    pins->commands = pins->data_bytes = 0;
    pins->chip->destroy(pins->chip);
    pins->chip = NULL;
}

static int begin_session(void *context, pins_t *pins, sim_error_t *error) {
    show_t *show = context;

    if (++show->session == 1) { return 0; }
    unplug(show, pins);
    show->panels++;
    return plug(show, pins, error);
}

static int write_glass(void *context, const sim_chip_t *chip, sim_error_t *error) {
    const show_t *show = context;
    sim_picture_t picture;
    char path[4096];
    int result = chip->glass(chip, &picture, error);

    if (result) { return result; }
    (void)snprintf(path, sizeof path, "%s/panel-%u.ppm", show->folder, show->session);
    result = sim_picture_write(&picture, path, error);
    sim_picture_free(&picture);
    return result;
}

static int read_trace(show_t *show, pins_t *pins, uint64_t *lines, sim_error_t *error) {
    char line[512];
    int result = plug(show, pins, error);

    while (result == 0 && fgets(line, sizeof line, stdin)) {
        result = pins_trace(pins, line, error);
        ++*lines;
    }
    if (result == 0) { result = pins_end(pins, error); }
    if (result == 0 && (show->session == 0 || show->panels[1])) {
        return sim_fail(error, "there were only %u sessions", show->session);
    }
    return result;
}

int main(int count, char **arguments) {
    show_t show = {.folder = arguments[1], .panels = arguments + 2};
    pins_t pins = {.begin = begin_session, .seen = write_glass, .context = &show};
    sim_error_t error = {""};
    uint64_t lines = 0;
    int result;

    if (count < 3) {
        (void)fputs("Usage: panel_trace FOLDER PANEL[:MODE] ... < TRACE\n", stderr);
        return 2;
    }
    result = read_trace(&show, &pins, &lines, &error);
    unplug(&show, &pins);
    if (result) { (void)fprintf(stderr, "panel_trace: %s (line %" PRIu64 " of the trace)\n", error.text, lines); }
    return result ? 1 : 0;
}
