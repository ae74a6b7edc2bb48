#include "options.h"

#include "commands.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void options_open(options_t *options, int count, char **arguments) {
    memset(options, 0, sizeof *options);
    options->count = count;
    options->arguments = arguments;
}

const char *options_next(options_t *options) {
    if (!options->failed && options->inlined && !options->taken) {
        (void)command_fail("%s takes no value, but got %s", options->name, options->inlined);
        options->failed = true;
    }
    if (options->failed || options->at >= options->count) { return NULL; }
    const char *argument = options->arguments[options->at++];
    options->name = options->inlined = NULL;
    options->taken = false;
    if (argument[0] != '-' || argument[1] == '\0') { return argument; }
    const char *equals = strchr(argument, '=');
    options->name = argument;
    if (equals && argument[1] == '-') {
        (void)snprintf(options->buffer, sizeof options->buffer, "%.*s", (int)(equals - argument), argument);
        options->name = options->buffer;
        options->inlined = equals + 1;
    }
    return options->name;
}

static bool fail(options_t *options) {
    options->failed = true;
    return false;
}

const char *options_value(options_t *options) {
    options->taken = true;
    if (options->inlined) { return options->inlined; }
    if (options->at >= options->count) {
        (void)command_fail("%s wants a value", options->name);
        (void)fail(options);
        return NULL;
    }
    return options->arguments[options->at++];
}

bool options_numbers(options_t *options, double *values, size_t count, double low, double high) {
    const char *text = options_value(options), *at = text;
    if (!text) { return false; }
    for (size_t i = 0; i < count; i++) {
        char *end;
        errno = 0;
        values[i] = strtod(at, &end);
        const char expected = i + 1 < count ? ',' : '\0';
        if (end == at || *end != expected || !isfinite(values[i])) {
            (void)command_fail(count == 1 ? "%s %s: not a number" : "%s %s: wants numbers with commas between, like 1,2,3",
                               options->name, text);
            return fail(options);
        }
        if (values[i] < low || values[i] > high) {
            (void)command_fail("%s %s: out of range, %g to %g", options->name, text, low, high);
            return fail(options);
        }
        at = end + 1;
    }
    return true;
}

bool options_number(options_t *options, double *value, double low, double high) {
    return options_numbers(options, value, 1, low, high);
}

bool options_integer(options_t *options, long *value, long low, long high) {
    const char *text = options_value(options);
    char *end;
    if (!text) { return false; }
    errno = 0;
    *value = strtol(text, &end, 10);
    if (end == text || *end != '\0') {
        (void)command_fail("%s %s: not a whole number", options->name, text);
        return fail(options);
    }
    if (errno == ERANGE || *value < low || *value > high) {
        (void)command_fail("%s %s: out of range, %ld to %ld", options->name, text, low, high);
        return fail(options);
    }
    return true;
}

bool options_size(options_t *options, size_t *bytes) {
    const char *text = options_value(options);
    char *end;
    if (!text) { return false; }
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    unsigned long long unit = 1;
    if (end != text && (*end == 'K' || *end == 'k')) { unit = 1024, end++; }
    if (end != text && unit == 1 && (*end == 'M' || *end == 'm')) { unit = 1024ull * 1024ull, end++; }
    if (end == text || *end != '\0' || text[0] == '-') {
        (void)command_fail("%s %s: wants bytes, like 16K, 1M or 8192", options->name, text);
        return fail(options);
    }
    if (errno == ERANGE || value > (1ull << 30) / unit) {
        (void)command_fail("%s %s: out of range, at most 1024M", options->name, text);
        return fail(options);
    }
    *bytes = (size_t)(value * unit);
    return true;
}

bool options_choice(options_t *options, int *index, const char *const *names) {
    const char *text = options_value(options);
    if (!text) { return false; }
    for (*index = 0; names[*index]; (*index)++) {
        if (strcmp(names[*index], text) == 0) { return true; }
    }
    char list[256] = "";
    for (int i = 0; names[i]; i++) {
        const size_t used = strlen(list);
        (void)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", names[i]);
    }
    (void)command_fail("%s %s: unknown; one of %s", options->name, text, list);
    return fail(options);
}

bool options_tile(options_t *options, uint16_t *width, uint16_t *height) {
    const char *text = options_value(options);
    unsigned w = 0, h = 0;
    char rest;
    if (!text) { return false; }
    if (sscanf(text, "%4ux%4u%c", &w, &h, &rest) != 2 || w < 1 || w > 1024 || h < 1 || h > 1024) {
        (void)command_fail("%s %s: wants WIDTHxHEIGHT in pixels, 1x1 to 1024x1024, like 240x16", options->name, text);
        return fail(options);
    }
    *width = (uint16_t)w;
    *height = (uint16_t)h;
    return true;
}

void options_unknown(options_t *options) {
    (void)command_fail("unknown option %s", options->name);
    (void)fail(options);
}

const char *const options_methods[] = {"zbuffer", "scanline", "warnock", "painter", "tree", NULL};
