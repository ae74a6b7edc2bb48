#include "recorder.h"

#include "check.h"

static void note(recorder_t *recorder, const char *format, ...) {
    va_list arguments;
    int length;

    va_start(arguments, format);
    length = vsnprintf(recorder->log + recorder->length, sizeof recorder->log - recorder->length, format, arguments);
    va_end(arguments);
    assert_true(length >= 0 && (size_t)length < sizeof recorder->log - recorder->length);
    recorder->length += (size_t)length;
}

static int record_result(const recorder_t *recorder) {
    return recorder->calls == recorder->fail_at ? TUILE_HAL_IO : recorder->fail_with;
}

static int record_clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    recorder_t *recorder = context;

    recorder->command_clock_hz = command_clock_hz;
    recorder->pixel_clock_hz = pixel_clock_hz;
    return 0;
}

/* D/C low before the bar, high after it. */
static int record_command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    recorder_t *recorder = context;

    recorder->calls++;
    for (size_t i = 0; i < size_bytes; i++) {
        note(recorder, "%s%02X", i == 0 ? "" : i == low_count ? "|" : " ", bytes[i]);
    }
    note(recorder, "\n");
    return record_result(recorder);
}

static int record_data(void *context, const uint8_t *bytes, size_t size_bytes) {
    recorder_t *recorder = context;

    recorder->calls++;
    note(recorder, "data %zu: %02X\n", size_bytes, bytes[0]);
    return record_result(recorder);
}

static int record_wait(void *context) {
    recorder_t *recorder = context;

    recorder->calls++;
    note(recorder, "wait\n");
    return record_result(recorder);
}

static int record_delay(void *context, uint32_t delay_ms) {
    recorder_t *recorder = context;

    recorder->calls++;
    note(recorder, "delay %u\n", delay_ms);
    return record_result(recorder);
}

static int record_pin(void *context, tuile_pin_t pin, uint8_t level) {
    recorder_t *recorder = context;

    recorder->calls++;
    note(recorder, "%s %u\n", pin == TUILE_PIN_RESET ? "reset" : "backlight", level);
    return record_result(recorder);
}

tuile_bus_t recorder_bus(recorder_t *recorder) {
    memset(recorder, 0, sizeof *recorder);
    return (tuile_bus_t){
        .context = recorder,
        .clocks = record_clocks,
        .command = record_command,
        .data = record_data,
        .wait = record_wait,
        .delay_ms = record_delay,
        .pin = record_pin,
        .pins = TUILE_PIN_BIT(TUILE_PIN_RESET) | TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT),
    };
}

void recorder_forget(recorder_t *recorder) {
    recorder->length = 0;
    recorder->log[0] = '\0';
}
