#include "pins.h"

#include <stdlib.h>
#include <string.h>

static bool level_of(const pins_t *pins, unsigned line) { return (pins->levels >> line & 1) != 0; }

static bool selected(const pins_t *pins) { return pins->chip_seen && !level_of(pins, PINS_SELECT); }

/* Modes 0 and 1 rest low, 2 and 3 high; 0 and 3 are sampled as the clock rises. */
static bool rests_high(const pins_t *pins) { return pins->spi_mode >= 2; }
static bool sampled_high(const pins_t *pins) { return pins->spi_mode == 0 || pins->spi_mode == 3; }

static int take_bit(pins_t *pins, uint64_t time_us, sim_error_t *error) {
    const bool dc = level_of(pins, PINS_DC);
    uint64_t span_us;

    if (pins->bit_count == 0) {
        pins->dc = dc;
        pins->first_bit_us = time_us;
    }
    if (dc != pins->dc) { return sim_fail(error, "pins: D/C changed at bit %u of a byte", pins->bit_count); }
    pins->byte = (uint8_t)(pins->byte << 1 | level_of(pins, PINS_MOSI));
    if (++pins->bit_count < 8) { return 0; }
    pins->bit_count = 0;
    if (dc) {
        pins->data_bytes++;
    } else {
        pins->commands++;
    }
    span_us = time_us > pins->first_bit_us ? time_us - pins->first_bit_us : 1; /* seven periods */
    if (pins->chip->receive(pins->chip, dc, &pins->byte, 1, (uint32_t)(7000000 / span_us), (time_us - pins->start_us) * 1000)) {
        return sim_fail(error, "%s", pins->chip->fault.text);
    }
    return 0;
}

static int select_chip(pins_t *pins, sim_error_t *error) {
    const bool was = pins->chip_seen;

    pins->chip_seen = true; /* the first change is to high */
    if (was && pins->bit_count > 0) {
        return sim_fail(error, "pins: the chip select moved after %u bits of a byte", pins->bit_count);
    }
    if (was && level_of(pins, PINS_CLOCK) != rests_high(pins)) {
        return sim_fail(error, "pins: the clock rests %s; in mode %u it rests %s", rests_high(pins) ? "low" : "high",
                        pins->spi_mode, rests_high(pins) ? "high" : "low");
    }
    return 0;
}

int pins_change(pins_t *pins, unsigned line, bool level, uint64_t time_us, sim_error_t *error) {
    const uint64_t now_ns = (time_us - (pins->start_us ? pins->start_us : time_us)) * 1000;

    if (pins->start_us == 0) { pins->start_us = time_us; }
    if (line >= PINS_COUNT) { return sim_fail(error, "pins: there is no line %u", line); }
    if (level == level_of(pins, line)) { return 0; }
    pins->levels = (uint8_t)((pins->levels & ~(1u << line)) | (unsigned)level << line);
    switch (line) {
    case PINS_CLOCK: return selected(pins) && level == sampled_high(pins) ? take_bit(pins, time_us, error) : 0;
    case PINS_SELECT: return select_chip(pins, error);
    case PINS_RESET:
        pins->resets += !level;
        if (!level && pins->begin && pins->begin(pins->context, pins, error)) { return -1; }
        pins->chip->reset(pins->chip, !level, now_ns);
        return pins->chip->fault.text[0] ? sim_fail(error, "%s", pins->chip->fault.text) : 0;
    case PINS_BACKLIGHT: pins->lights += level; return level ? 0 : pins->seen(pins->context, pins->chip, error);
    case PINS_END: return pins_end(pins, error);
    default: return 0;
    }
}

int pins_trace(pins_t *pins, const char *text, sim_error_t *error) {
    static const char event[] = ":pl061_set_output ", words[] = " setting output ";
    const char *at = strchr(text, '@'), *name = strstr(text, event), *line = strstr(text, words);
    char *end = NULL;
    uint64_t time_us;
    unsigned long number, level;

    if (!at || !line) { return sim_fail(error, "pins: not a line of the trace: %.80s", text); }
    time_us = strtoull(at + 1, &end, 10) * 1000000;
    if (*end != '.' || end + 7 != name) { return sim_fail(error, "pins: no time in a line of the trace: %.80s", text); }
    time_us += strtoull(end + 1, NULL, 10);
    number = strtoul(line + sizeof words - 1, &end, 10);
    if (strncmp(end, " to ", 4) != 0) { return sim_fail(error, "pins: no level in a line of the trace: %.80s", text); }
    level = strtoul(end + 4, &end, 10);
    if (level > 1 || (*end && *end != '\n')) { return sim_fail(error, "pins: no level in a line of the trace: %.80s", text); }
    return pins_change(pins, (unsigned)number, level == 1, time_us, error);
}

int pins_end(pins_t *pins, sim_error_t *error) {
    if (pins->bit_count > 0) { return sim_fail(error, "pins: it ends after %u bits of a byte", pins->bit_count); }
    return level_of(pins, PINS_BACKLIGHT) ? sim_fail(error, "pins: the light is left on") : 0;
}
