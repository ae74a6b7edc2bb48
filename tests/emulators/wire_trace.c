/* Reads what a board has put on its wire and writes what a panel at the other end showed.
 *
 * Usage: wire_trace PANEL ROTATION FOLDER < TRACE   ROTATION: 0, 90, 180 or 270
 * TRACE is as trace.h has it. Each line of text goes to stdout; after "frame NAME METHOD NUMBER ..." and "demo NAME METHOD NUMBER
 * ..." FOLDER receives NAME-METHOD-NUMBER.ppm, the picture as it is seen. An error ends it with one line on stderr and the code 1.
 */
#include "trace.h"

#include <inttypes.h>
#include <stdlib.h>

#include "../../sim/panels.h"

static int quarter_turns;

static int write_picture(sim_chip_t *chip, const char *folder, const char *line, sim_error_t *error) {
    char name[32], method[32], path[4096];
    unsigned number;
    sim_picture_t glass = {0}, seen = {0};

    if (sscanf(line, "frame %31s %31s %u", name, method, &number) != 3 &&
        sscanf(line, "demo %31s %31s %u", name, method, &number) != 3) {
        return 0;
    }
    (void)snprintf(path, sizeof path, "%s/%s-%s-%02u.ppm", folder, name, method, number);
    const int result = chip->glass(chip, &glass, error) || sim_picture_turn(&glass, -quarter_turns, &seen, error) ||
                       sim_picture_write(&seen, path, error);
    sim_picture_free(&glass);
    sim_picture_free(&seen);
    return result ? -1 : 0;
}

static int read_all(sim_chip_t *chip, const char *folder, uint64_t *events, sim_error_t *error) {
    trace_t trace = {.file = stdin};
    trace_event_t event;
    int result;

    while ((result = trace_next(&trace, &event, error)) > 0) {
        if (event.kind == TRACE_TEXT) {
            (void)printf("%s\n", (const char *)event.bytes);
            result = write_picture(chip, folder, (const char *)event.bytes, error);
        } else {
            result = trace_feed(chip, &event, error);
        }
        if (result) { break; }
        ++*events;
    }
    trace_close(&trace);
    return result || *events ? result : sim_fail(error, "the trace is empty");
}

int main(int count, char **arguments) {
    const sim_panel_t *panel = count == 4 ? sim_panel_find(arguments[1]) : NULL;
    const unsigned long degrees = count == 4 ? strtoul(arguments[2], NULL, 10) : 1;
    sim_error_t error = {""};
    uint64_t events = 0;
    sim_chip_t *chip;
    int result;

    if (!panel || degrees % 90 != 0) {
        (void)fputs("Usage: wire_trace PANEL ROTATION FOLDER < TRACE\n", stderr);
        return 2;
    }
    quarter_turns = (int)(degrees / 90 % 4);
    chip = panel->create(&error);
    result = chip ? read_all(chip, arguments[3], &events, &error) : sim_fail(&error, "out of memory");
    if (result) { (void)fprintf(stderr, "wire_trace: record %" PRIu64 ": %s\n", events + 1, error.text); }
    if (result == 0 && chip->warnings) {
        (void)fprintf(stderr, "wire_trace: %s: %s\n", panel->chip, chip->warning.text);
        result = 1;
    }
    if (chip) { chip->destroy(chip); }
    return result ? 1 : 0;
}
