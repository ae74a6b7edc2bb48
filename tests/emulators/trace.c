#include "trace.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define HEAD_BYTES 16u
#define PAYLOAD_MAX (1u << 26)

static uint32_t word(const uint8_t *bytes) {
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static int read_payload(trace_t *trace, size_t size_bytes, sim_error_t *error) {
    if (size_bytes + 1 > trace->room_bytes) {
        uint8_t *room = realloc(trace->room, size_bytes + 1);

        if (!room) { return sim_fail(error, "out of memory"); }
        trace->room = room;
        trace->room_bytes = size_bytes + 1;
    }
    trace->room[size_bytes] = 0;
    return fread(trace->room, 1, size_bytes, trace->file) == size_bytes ? 0 : sim_fail(error, "the trace is cut off");
}

int trace_next(trace_t *trace, trace_event_t *event, sim_error_t *error) {
    uint8_t head[HEAD_BYTES];
    const size_t got = fread(head, 1, sizeof head, trace->file);
    size_t size_bytes;

    if (got == 0 && feof(trace->file)) { return 0; }
    if (got != sizeof head) { return sim_fail(error, "the trace is cut off"); }
    size_bytes = word(head + 4);
    *event = (trace_event_t){
        .kind = (trace_kind_t)head[0],
        .flag = head[1],
        .time_ns = (uint64_t)word(head + 12) << 32 | word(head + 8),
        .size_bytes = size_bytes,
    };
    if (head[0] < TRACE_BYTES || head[0] > TRACE_FRAME || head[2] || head[3] || size_bytes > PAYLOAD_MAX ||
        (head[0] == TRACE_BYTES && size_bytes < 4)) {
        return sim_fail(error, "this is no trace of a panel's wires");
    }
    if (read_payload(trace, size_bytes, error)) { return -1; }
    event->bytes = trace->room;
    if (event->kind == TRACE_BYTES) {
        event->clock_hz = word(trace->room);
        event->bytes += 4;
        event->size_bytes -= 4;
    }
    return 1;
}

int trace_feed(sim_chip_t *chip, const trace_event_t *event, sim_error_t *error) {
    if (event->kind == TRACE_RESET) { chip->reset(chip, event->flag == 0, event->time_ns); }
    if (event->kind == TRACE_BYTES) {
        (void)chip->receive(chip, event->flag != 0, event->bytes, event->size_bytes, event->clock_hz, event->time_ns);
    }
    if (!chip->fault.text[0]) { return 0; }
    return sim_fail(error, "%s, at %" PRIu64 " us", chip->fault.text, event->time_ns / 1000u);
}

void trace_close(trace_t *trace) {
    free(trace->room);
    *trace = (trace_t){.file = trace->file};
}
