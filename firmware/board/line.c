#include "line.h"

static void put(line_t *line, char c) {
    if (line->used + 1u < sizeof line->text) { line->text[line->used++] = c; }
    line->text[line->used] = 0;
}

void line_word(line_t *line, const char *word) {
    if (line->used) { put(line, ' '); }
    while (*word) {
        put(line, *word++);
    }
}

void line_number(line_t *line, uint32_t number) {
    char digits[11];
    unsigned at = sizeof digits - 1;

    digits[at] = 0;
    do {
        digits[--at] = (char)('0' + number % 10u);
        number /= 10u;
    } while (number);
    line_word(line, digits + at);
}

const char *line_option(const char *options, const char *name) {
    while (*options) {
        const char *n = name;

        while (*n && *options == *n) {
            n++;
            options++;
        }
        if (*n == 0 && *options == '=') { return options + 1; }
        while (*options && *options != ' ') {
            options++;
        }
        while (*options == ' ') {
            options++;
        }
    }
    return NULL;
}

uint32_t line_value(const char *text, uint32_t usual) {
    uint32_t value = 0;

    if (!text) { return usual; }
    for (; *text >= '0' && *text <= '9'; text++) {
        value = value * 10u + (uint32_t)(*text - '0');
    }
    return value;
}
