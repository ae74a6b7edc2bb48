#include "wire_file.h"

#include "semihosting.h"

#include <stdbool.h>

/* Kinds of records (tests/emulators/trace.h). */
#define BYTES 1u
#define RESET 2u
#define LIGHT 3u
#define TEXT 4u
#define HEAD_BYTES 16u
#define CLOCK_BYTES 4u

typedef struct rate {
    uint32_t clock_hz, byte_ns;
} rate_t;

static intptr_t file;
static uint64_t now_ns; /* since the start: what the wire takes, and pauses; the core takes none */
static rate_t command_rate, pixel_rate;

static void put(uint8_t *to, uint32_t word) {
    for (unsigned i = 0; i < 4; i++) {
        to[i] = (uint8_t)(word >> 8 * i);
    }
}

/* rate: of BYTES, else NULL. */
static int record(uint8_t kind, uint8_t flag, const rate_t *rate, const void *bytes, size_t size_bytes) {
    uint8_t head[HEAD_BYTES + CLOCK_BYTES] = {kind, flag};
    const uint32_t clock_bytes = rate ? CLOCK_BYTES : 0;

    put(head + 4, (uint32_t)size_bytes + clock_bytes);
    put(head + 8, (uint32_t)now_ns);
    put(head + 12, (uint32_t)(now_ns >> 32));
    if (rate) {
        put(head + HEAD_BYTES, rate->clock_hz);
        now_ns += (uint64_t)size_bytes * rate->byte_ns;
    }
    return semihosting_write(file, head, HEAD_BYTES + clock_bytes) || (size_bytes && semihosting_write(file, bytes, size_bytes))
               ? TUILE_HAL_IO
               : TUILE_HAL_OK;
}

static int clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    (void)context;
    if (!command_clock_hz || !pixel_clock_hz) { return TUILE_HAL_ARGUMENT; }
    command_rate = (rate_t){command_clock_hz, 1000000000u / command_clock_hz * 8u};
    pixel_rate = (rate_t){pixel_clock_hz, 1000000000u / pixel_clock_hz * 8u};
    return TUILE_HAL_OK;
}

static int command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    const int result = low_count ? record(BYTES, false, &command_rate, bytes, low_count) : TUILE_HAL_OK;

    (void)context;
    if (result || size_bytes == low_count) { return result; }
    return record(BYTES, true, &command_rate, bytes + low_count, size_bytes - low_count);
}

static int data(void *context, const uint8_t *bytes, size_t size_bytes) {
    (void)context;
    return record(BYTES, true, &pixel_rate, bytes, size_bytes);
}

static int delay_ms(void *context, uint32_t delay_ms) {
    (void)context;
    now_ns += (uint64_t)delay_ms * 1000000u;
    return TUILE_HAL_OK;
}

static int pin(void *context, tuile_pin_t pin, uint8_t level) {
    (void)context;
    return record(pin == TUILE_PIN_BACKLIGHT ? LIGHT : RESET, level, NULL, NULL, 0);
}

int wire_file_open(tuile_bus_t *bus, const char *path) {
    *bus = (tuile_bus_t){
        .clocks = clocks,
        .command = command,
        .data = data,
        .delay_ms = delay_ms,
        .pin = pin,
        .pins = TUILE_PIN_BIT(TUILE_PIN_RESET) | TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT),
    };
    file = semihosting_create(path);
    return file < 0 ? TUILE_HAL_IO : TUILE_HAL_OK;
}

int wire_file_tell(const char *line) {
    size_t size_bytes = 0;

    while (line[size_bytes]) {
        size_bytes++;
    }
    return record(TEXT, 0, NULL, line, size_bytes);
}
