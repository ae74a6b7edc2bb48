#include "wire_script.h"

#include "check.h"

/* One item's bytes, up to the next semicolon. Returns what follows them. */
static const char *read_bytes(const char *script, uint8_t bytes[64], size_t *count) {
    *count = 0;
    while (*script && *script != ';') {
        char *end;
        assert_true(*count < 64);
        bytes[(*count)++] = (uint8_t)strtoul(script, &end, 16);
        assert_ptr_not_equal(end, script);
        script = end + (*end == ':');
        while (*script == ' ') {
            script++;
        }
    }
    return script;
}

int wire_play(board_t *board, const char *script) {
    tuile_bus_t *bus = &board->bus.bus;
    int result = 0;

    while (*script && result == 0) {
        const char kind = *script;
        uint8_t bytes[64];
        size_t count;
        if (kind == '@' || kind == 'R') {
            char *end;
            const unsigned value = (unsigned)strtoul(script + 1, &end, 10);
            script = end;
            result = kind == '@' ? bus->delay_ms(bus->context, value) : bus->pin(bus->context, TUILE_PIN_RESET, (uint8_t)value);
        } else {
            script = read_bytes(script + (kind == '+'), bytes, &count);
            result = kind == '+' ? bus->data(bus->context, bytes, count) : bus->command(bus->context, bytes, 1, count);
        }
        while (*script == ' ' || *script == ';') {
            script++;
        }
    }
    return result;
}
