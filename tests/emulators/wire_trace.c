/* Reads what a board has put on its wire and writes what a panel at the other end showed.
 *
 * Usage: wire_trace PANEL ROTATION FOLDER < TRACE   ROTATION: 0, 90, 180 or 270
 * TRACE is as firmware/board/wire_file.h has it. Each line of text goes to stdout; after "frame NAME METHOD NUMBER ...", or "demo"
 * in the place of "frame", FOLDER receives NAME-METHOD-NUMBER.ppm, the picture as it is seen. An error ends it with one line on
 * stderr and the code 1. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../sim/panels.h"

#define RECORD_MOST_BYTES (1u << 24)

typedef struct trace {
    const sim_panel_t *panel;
    sim_chip_t *chip;
    int quarter_turns;
    const char *folder;
    uint8_t *bytes; /* of a record */
    uint64_t now_ns;
} trace_t;

static int write_picture(trace_t *trace, const char *line, sim_error_t *error) {
    char name[32], method[32], path[4096];
    unsigned number;
    sim_picture_t glass = {0}, seen = {0};

    if (sscanf(line, "frame %31s %31s %u", name, method, &number) != 3 &&
        sscanf(line, "demo %31s %31s %u", name, method, &number) != 3) {
        return 0;
    }
    (void)snprintf(path, sizeof path, "%s/%s-%s-%02u.ppm", trace->folder, name, method, number);
    const int result = trace->chip->glass(trace->chip, &glass, error) ||
                       sim_picture_turn(&glass, -trace->quarter_turns, &seen, error) || sim_picture_write(&seen, path, error);
    sim_picture_free(&glass);
    sim_picture_free(&seen);
    return result ? -1 : 0;
}

static int tell(trace_t *trace, size_t size_bytes, sim_error_t *error) {
    trace->bytes[size_bytes] = 0;
    (void)printf("%s\n", (const char *)trace->bytes);
    return write_picture(trace, (const char *)trace->bytes, error);
}

/* Bytes go at the clock that the data sheet promises, pixels and commands alike. */
static int receive(trace_t *trace, bool data, size_t size_bytes) {
    const uint32_t clock_hz = trace->panel->panel->rated_pixel_clock_hz;

    trace->now_ns += 8u * (uint64_t)size_bytes * 1000000000u / clock_hz;
    return trace->chip->receive(trace->chip, data, trace->bytes, size_bytes, clock_hz, trace->now_ns);
}

static uint32_t little_endian(const uint8_t *bytes, unsigned count) {
    uint32_t value = 0;

    for (unsigned i = 0; i < count; i++) {
        value |= (uint32_t)bytes[i] << 8 * i;
    }
    return value;
}

static int take(trace_t *trace, int kind, size_t size_bytes, sim_error_t *error) {
    switch (kind) {
    case 'c':
    case 'd':
        if (receive(trace, kind == 'd', size_bytes) == 0) { return 0; }
        return sim_fail(error, "%s: %s", trace->panel->chip, trace->chip->fault.text);
    case 'r':
        if (size_bytes != 1) { break; }
        trace->chip->reset(trace->chip, trace->bytes[0] == 0, trace->now_ns);
        if (!trace->chip->fault.text[0]) { return 0; }
        return sim_fail(error, "%s: %s", trace->panel->chip, trace->chip->fault.text);
    case 'w':
        if (size_bytes != 4) { break; }
        trace->now_ns += little_endian(trace->bytes, 4) * UINT64_C(1000000);
        return 0;
    case 't': return tell(trace, size_bytes, error);
    default: break;
    }
    return sim_fail(error, "a record of kind 0x%02x with %zu bytes", (unsigned)kind, size_bytes);
}

static int read_all(trace_t *trace, uint64_t *records, sim_error_t *error) {
    uint8_t head[4];
    size_t got;

    while ((got = fread(head, 1, sizeof head, stdin)) == sizeof head) {
        const size_t size_bytes = little_endian(head + 1, 3);

        if (fread(trace->bytes, 1, size_bytes, stdin) != size_bytes) { return sim_fail(error, "the trace ends within a record"); }
        if (take(trace, head[0], size_bytes, error)) { return -1; }
        ++*records;
    }
    if (got) { return sim_fail(error, "the trace ends within a record"); }
    return *records ? 0 : sim_fail(error, "the trace is empty");
}

int main(int count, char **arguments) {
    trace_t trace = {.panel = count == 4 ? sim_panel_find(arguments[1]) : NULL};
    const unsigned long degrees = count == 4 ? strtoul(arguments[2], NULL, 10) : 1;
    sim_error_t error = {""};
    uint64_t records = 0;
    int result;

    if (!trace.panel || degrees % 90 != 0) {
        (void)fputs("Usage: wire_trace PANEL ROTATION FOLDER < TRACE\n", stderr);
        return 2;
    }
    trace.quarter_turns = (int)(degrees / 90 % 4);
    trace.folder = arguments[3];
    trace.chip = trace.panel->create(&error);
    trace.bytes = malloc(RECORD_MOST_BYTES + 1);
    result = trace.chip && trace.bytes ? read_all(&trace, &records, &error) : sim_fail(&error, "out of memory");
    if (result) { (void)fprintf(stderr, "wire_trace: record %" PRIu64 ": %s\n", records + 1, error.text); }
    if (result == 0 && trace.chip && trace.chip->warnings) {
        (void)fprintf(stderr, "wire_trace: %s: %s\n", trace.panel->chip, trace.chip->warning.text);
        result = 1;
    }
    if (trace.chip) { trace.chip->destroy(trace.chip); }
    free(trace.bytes);
    return result ? 1 : 0;
}
