/* The polygons of `tuile coverage`, read character by character: lines may be longer than any buffer. */
#include "coverage_text.h"

#include <stdbool.h>
#include <stdlib.h>

void coverage_text_open(coverage_text_t *text, FILE *file, const char *name) {
    *text = (coverage_text_t){.file = file, .name = name};
}

void coverage_text_close(coverage_text_t *text) {
    free(text->points);
    text->points = NULL;
    text->count = text->capacity = 0;
}

/* The next character that is not a blank within the line. */
static int skip_blanks(FILE *file) {
    int c = getc(file);
    while (c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f') {
        c = getc(file);
    }
    return c;
}

static bool ends_word(int c) { return c == EOF || c == '\n' || c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

static int fail(const coverage_text_t *text, sim_error_t *error, const char *what) {
    return sim_fail(error, "%.120s: line %lu: %s", text->name, text->line, what);
}

/* A whole number that begins with character c. Leaves the character behind it unread. */
static int read_coordinate(coverage_text_t *text, int c, q28_4_t *value, sim_error_t *error) {
    bool negative = c == '-';
    if (c == '-' || c == '+') { c = getc(text->file); }
    q28_4_t magnitude = 0;
    bool digits = false;
    for (; c >= '0' && c <= '9'; c = getc(text->file)) {
        digits = true;
        magnitude = magnitude * 10 + (c - '0');
        if (magnitude > COVERAGE_TEXT_COORDINATE_MAX) {
            return fail(text, error, "a coordinate is beyond +-32767 pixels (524272 sixteenths)");
        }
    }
    if (!digits || !ends_word(c)) { return fail(text, error, "a coordinate is not a whole number of 1/16 pixels"); }
    (void)ungetc(c, text->file); /* ungetc leaves EOF alone */
    *value = negative ? -magnitude : magnitude;
    return 0;
}

static int add_point(coverage_text_t *text, q28_4_t x, q28_4_t y, sim_error_t *error) {
    if (text->count == text->capacity) {
        size_t capacity = text->capacity ? text->capacity * 2 : 16;
        void *grown =
            capacity > SIZE_MAX / sizeof *text->points / 2 ? NULL : realloc(text->points, capacity * sizeof *text->points);
        if (!grown) { return fail(text, error, "out of memory"); }
        text->points = grown;
        text->capacity = capacity;
    }
    text->points[text->count][0] = x;
    text->points[text->count][1] = y;
    text->count++;
    return 0;
}

int coverage_text_next(coverage_text_t *text, sim_error_t *error) {
    text->count = 0;
    int c;
    do {
        text->line++;
        c = skip_blanks(text->file);
    } while (c == '\n');
    if (c == EOF) { return ferror(text->file) ? fail(text, error, "cannot be read") : 0; }
    while (c != '\n' && c != EOF) {
        q28_4_t x = 0, y = 0;
        if (read_coordinate(text, c, &x, error) < 0) { return -1; }
        c = skip_blanks(text->file);
        if (c == '\n' || c == EOF) { return fail(text, error, "the count of numbers is odd: the last vertex has no y"); }
        if (read_coordinate(text, c, &y, error) < 0 || add_point(text, x, y, error) < 0) { return -1; }
        c = skip_blanks(text->file);
    }
    if (ferror(text->file)) { return fail(text, error, "cannot be read"); }
    if (text->count < 3) { return fail(text, error, "a polygon takes at least three vertices"); }
    text->polygon = text->polygons++;
    return 1;
}
