#include "wire_file.h"

#include "semihosting.h"

static intptr_t file;

static int record(char kind, const void *bytes, size_t size_bytes) {
    const uint8_t head[4] = {(uint8_t)kind, (uint8_t)size_bytes, (uint8_t)(size_bytes >> 8), (uint8_t)(size_bytes >> 16)};

    if (size_bytes == 0) { return TUILE_HAL_OK; }
    return semihosting_write(file, head, sizeof head) || semihosting_write(file, bytes, size_bytes) ? TUILE_HAL_IO : TUILE_HAL_OK;
}

static int command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    const int result = record('c', bytes, low_count);

    (void)context;
    return result ? result : record('d', bytes + low_count, size_bytes - low_count);
}

static int data(void *context, const uint8_t *bytes, size_t size_bytes) {
    (void)context;
    return record('d', bytes, size_bytes);
}

static int delay_ms(void *context, uint32_t delay_ms) {
    const uint8_t bytes[4] = {(uint8_t)delay_ms, (uint8_t)(delay_ms >> 8), (uint8_t)(delay_ms >> 16), (uint8_t)(delay_ms >> 24)};

    (void)context;
    return record('w', bytes, sizeof bytes);
}

static int pin(void *context, tuile_pin_t pin, uint8_t level) {
    (void)context;
    (void)pin; /* reset is the only one */
    return record('r', &level, 1);
}

int wire_file_open(tuile_bus_t *bus, const char *path) {
    *bus = (tuile_bus_t){
        .command = command,
        .data = data,
        .delay_ms = delay_ms,
        .pin = pin,
        .pins = TUILE_PIN_BIT(TUILE_PIN_RESET),
    };
    file = semihosting_create(path);
    return file < 0 ? TUILE_HAL_IO : TUILE_HAL_OK;
}

int wire_file_tell(const char *line) {
    size_t size_bytes = 0;

    while (line[size_bytes]) {
        size_bytes++;
    }
    return record('t', line, size_bytes);
}
