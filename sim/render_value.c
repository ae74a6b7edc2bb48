#include "render_value.h"

#include "commands.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool render_value_next_colour(const char **text, uint8_t colour[3]) {
    if (strspn(*text, "0123456789abcdefABCDEF") != 6) { return false; }
    const unsigned long rgb = strtoul(*text, NULL, 16);
    for (unsigned i = 0; i < 3; i++) {
        colour[i] = (uint8_t)(rgb >> (16 - 8 * i));
    }
    *text += 6;
    return true;
}

bool render_value_colour(const char *text, uint8_t colour[3]) {
    return strlen(text) == 6 && render_value_next_colour(&text, colour);
}

bool render_value_background(options_t *options, uint8_t background[3]) {
    const char *text = options_value(options);
    if (!text) { return false; }
    if (!render_value_colour(text, background)) {
        (void)command_fail("--background %s: wants six hexadecimal digits, RRGGBB", text);
        options->failed = true;
        return false;
    }
    return true;
}

bool render_value_warnock(options_t *options, uint8_t *variants) {
    static const char *const names[] = {"quarters", "single", "box", "sorted", "pixels"};
    const char *text = options_value(options), *at = text;
    unsigned mask = 0;
    if (!text) { return false; }
    for (;;) {
        const size_t length = strcspn(at, ",");
        unsigned i = 0;
        while (i < 5 && (strlen(names[i]) != length || strncmp(names[i], at, length) != 0)) {
            i++;
        }
        if (i == 5) {
            (void)command_fail("--warnock %s: wants quarters, single, box, sorted or pixels, or several with commas between", text);
            options->failed = true;
            return false;
        }
        mask |= 1u << i;
        at += length;
        if (*at++ == '\0') { break; }
    }
    *variants = (uint8_t)mask;
    return true;
}

bool render_value_hz(const char *text, size_t *hz) {
    char *end;
    double value = strtod(text, &end);
    if (end != text && *end == 'M') { value *= 1e6, end++; }
    if (end != text && (*end == 'k' || *end == 'K')) { value *= 1e3, end++; }
    if (end == text || *end != '\0' || !(value >= 0 && value <= 1e9)) { return false; }
    *hz = (size_t)value;
    return true;
}

bool render_value_clock(options_t *options, size_t *hz) {
    const char *text = options_value(options);
    if (!text) { return false; }
    if (!render_value_hz(text, hz)) {
        (void)command_fail("--clock %s: wants Hz, like 62.5M, up to 1000M", text);
        options->failed = true;
        return false;
    }
    return true;
}

bool render_value_pattern(const char *option, const char *name, long frames) {
    const char *percent = name ? strchr(name, '%') : NULL;
    if (!name) { return true; }
    if (!percent) {
        if (frames == 1) { return true; }
        (void)command_fail("%s %s: the name needs a number like %%03d, since there are %ld frames", option, name, frames);
        return false;
    }
    const char *at = percent + 1;
    while (*at >= '0' && *at <= '9') {
        at++;
    }
    if (*at != 'd' || at - percent > 3 || strchr(at, '%')) {
        (void)command_fail("%s %s: only one number, like %%d or %%03d, may stand in the name", option, name);
        return false;
    }
    return true;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
void render_value_frame_name(char *name, size_t size, const char *pattern, unsigned frame) {
    (void)snprintf(name, size, pattern, (int)frame);
}
#pragma GCC diagnostic pop
