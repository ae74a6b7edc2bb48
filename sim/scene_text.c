/* Reading text scenes. The whole file is read first, then parsed line by line. */
#include "scene_text.h"

#include "scene_exact.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef __int128 int128_t;

typedef struct word {
    const char *start;
    size_t length;
} word_t;

enum { KEY_SCREEN, KEY_CAMERA, KEY_ORIGIN, KEY_YSIGN, KEY_SAMPLE, KEY_NEAR, KEY_TIE, KEY_COUNT };

typedef struct parser {
    scene_text_t *scene;
    const char *name;
    unsigned long line;            /* 1-based */
    unsigned long seen[KEY_COUNT]; /* the line on which each was given, 0 = not yet */
    const char *at, *end;          /* what is left of the line, comment removed */
    size_t poly_capacity, vertex_capacity;
    sim_error_t *error;
} parser_t;

/* A word of the input made fit for an error message: printable and short. */
typedef struct quoted {
    char text[44];
} quoted_t;

static quoted_t quote(word_t word) {
    quoted_t quoted;
    size_t room = sizeof quoted.text - 4, count = word.length < room ? word.length : room;
    for (size_t i = 0; i < count; i++) {
        quoted.text[i] = word.start[i];
    }
    for (size_t i = 0; i < count; i++) {
        if (quoted.text[i] < ' ' || quoted.text[i] > '~') { quoted.text[i] = '?'; }
    }
    memcpy(quoted.text + count, word.length > room ? "..." : "", word.length > room ? 4 : 1);
    return quoted;
}

#define FAIL(parser, ...) fail_at(parser, (parser)->line, __VA_ARGS__)

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static int
fail_at(const parser_t *parser, unsigned long line, const char *format, ...) {
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return sim_fail(parser->error, "%.120s: line %lu: %s", parser->name, line, text);
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
static bool is_digit(char c) { return c >= '0' && c <= '9'; }

/* The next word of the line; length 0 at its end. */
static word_t next_word(parser_t *parser) {
    while (parser->at < parser->end && is_blank(*parser->at)) {
        parser->at++;
    }
    word_t word = {parser->at, 0};
    while (parser->at < parser->end && !is_blank(*parser->at)) {
        parser->at++;
    }
    word.length = (size_t)(parser->at - word.start);
    return word;
}

static bool word_is(word_t word, const char *text) {
    return word.length == strlen(text) && memcmp(word.start, text, word.length) == 0;
}

static int expect_end(parser_t *parser, const char *keyword) {
    word_t word = next_word(parser);
    return word.length ? FAIL(parser, "'%s' after all that `%s` takes", quote(word).text, keyword) : 0;
}

static uint64_t greatest_common_divisor(uint64_t a, uint64_t b) {
    while (b) {
        uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

typedef enum number_fault { NUMBER_GOOD, NUMBER_MALFORMED, NUMBER_TOO_LONG, NUMBER_ZERO_DENOMINATOR } number_fault_t;

static bool append_digit(uint64_t *value, unsigned digit) {
    if (*value > ((uint64_t)INT64_MAX - digit) / 10) { return false; }
    *value = *value * 10 + digit;
    return true;
}

/* [+-] digits [. digits], [+-] . digits, [+-] digits / digits. */
static number_fault_t parse_number(word_t word, scene_number_t *number) {
    const char *at = word.start, *end = word.start + word.length;
    bool negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) { at++; }
    uint64_t numerator = 0, denominator = 1;
    size_t digits = 0;
    bool fits = true;
    for (; at < end && is_digit(*at); at++, digits++) {
        fits = fits && append_digit(&numerator, (unsigned)(*at - '0'));
    }
    if (at < end && *at == '.') {
        size_t zeros = 0; /* those at the end of a decimal do not count against its length */
        for (at++; at < end && is_digit(*at); at++, digits++) {
            zeros++;
            if (*at == '0') { continue; }
            for (; zeros > 1 && fits; zeros--) {
                fits = append_digit(&numerator, 0) && append_digit(&denominator, 0);
            }
            fits = fits && append_digit(&numerator, (unsigned)(*at - '0')) && append_digit(&denominator, 0);
            zeros = 0;
        }
    } else if (at < end && *at == '/' && digits) {
        size_t below = 0;
        denominator = 0;
        for (at++; at < end && is_digit(*at); at++, below++) {
            fits = fits && append_digit(&denominator, (unsigned)(*at - '0'));
        }
        if (!below) { return NUMBER_MALFORMED; }
    }
    if (!digits || at != end) { return NUMBER_MALFORMED; }
    if (!fits) { return NUMBER_TOO_LONG; }
    if (!denominator) { return NUMBER_ZERO_DENOMINATOR; }
    uint64_t divisor = greatest_common_divisor(numerator, denominator);
    number->numerator = (int64_t)(numerator / divisor);
    number->denominator = (int64_t)(denominator / divisor);
    if (negative) { number->numerator = -number->numerator; }
    return NUMBER_GOOD;
}

/* what: how the line calls this number, for errors. */
static int read_number(parser_t *parser, word_t word, const char *what, scene_number_t *number) {
    if (!word.length) { return FAIL(parser, "%s is missing", what); }
    switch (parse_number(word, number)) {
    case NUMBER_GOOD: return 0;
    case NUMBER_TOO_LONG: return FAIL(parser, "%s '%s' has more digits than 64 bits hold", what, quote(word).text);
    case NUMBER_ZERO_DENOMINATOR: return FAIL(parser, "%s '%s' divides by zero", what, quote(word).text);
    case NUMBER_MALFORMED:
    default: return FAIL(parser, "%s '%s' is neither a decimal nor a fraction", what, quote(word).text);
    }
}

/* A number within +-bound: what later goes into a q16.16. */
static int read_bounded(parser_t *parser, const char *what, int64_t bound, scene_number_t *number) {
    word_t word = next_word(parser);
    if (read_number(parser, word, what, number) < 0) { return -1; }
    int128_t magnitude = number->numerator < 0 ? -(int128_t)number->numerator : number->numerator;
    if (magnitude > (int128_t)bound * number->denominator) {
        return FAIL(parser, "%s '%s' is beyond +-%lld", what, quote(word).text, (long long)bound);
    }
    return 0;
}

static int read_whole(parser_t *parser, const char *what, int64_t low, int64_t high, int64_t *value) {
    word_t word = next_word(parser);
    scene_number_t number;
    if (read_number(parser, word, what, &number) < 0) { return -1; }
    if (number.denominator != 1 || number.numerator < low || number.numerator > high) {
        return FAIL(parser, "%s '%s' is not a whole number of %lld to %lld", what, quote(word).text, (long long)low,
                    (long long)high);
    }
    *value = number.numerator;
    return 0;
}

/* One of two words; *second tells which. */
static int read_choice(parser_t *parser, const char *keyword, const char *first_word, const char *second_word, bool *second) {
    word_t word = next_word(parser);
    *second = word_is(word, second_word);
    if (*second || word_is(word, first_word)) { return 0; }
    if (!word.length) { return FAIL(parser, "`%s` takes %s or %s", keyword, first_word, second_word); }
    return FAIL(parser, "`%s` takes %s or %s, not '%s'", keyword, first_word, second_word, quote(word).text);
}

/* Makes room for one more item. The new capacity is kept even where the caller fails afterwards. */
static void *grow(void *items, size_t *capacity, size_t count, size_t item_bytes) {
    if (count < *capacity) { return items; }
    size_t wanted = *capacity ? *capacity * 2 : 64;
    if (wanted > SIZE_MAX / item_bytes / 2) { return NULL; }
    void *grown = realloc(items, wanted * item_bytes);
    if (grown) { *capacity = wanted; }
    return grown;
}

static int add_vertex(parser_t *parser, const scene_number_t vertex[3]) {
    scene_text_t *scene = parser->scene;
    void *grown = grow(scene->vertices, &parser->vertex_capacity, scene->vertex_count, sizeof *scene->vertices);
    if (!grown) { return FAIL(parser, "out of memory"); }
    scene->vertices = grown;
    memcpy(scene->vertices[scene->vertex_count++], vertex, 3 * sizeof *vertex);
    return 0;
}

static int read_vertex(parser_t *parser, word_t word, size_t number) {
    scene_number_t vertex[3];
    const char *at = word.start, *end = word.start + word.length;
    size_t commas = 0;
    for (const char *c = at; c < end; c++) {
        commas += *c == ',';
    }
    if (commas != 2) {
        return FAIL(parser, "vertex %zu, '%s', is not x,y,z (no blanks around the commas)", number, quote(word).text);
    }
    for (int i = 0; i < 3; i++) {
        word_t part = {at, 0};
        while (at < end && *at != ',') {
            at++;
        }
        part.length = (size_t)(at - part.start);
        at++; /* the comma; behind the last number nothing looks at it */
        char what[48];
        (void)snprintf(what, sizeof what, "vertex %zu: %c", number, "xyz"[i]);
        if (read_number(parser, part, what, &vertex[i]) < 0) { return -1; }
    }
    return add_vertex(parser, vertex);
}

static int check_poly(parser_t *parser, const scene_poly_t *poly) {
    size_t plane[3] = {0}, off = 0;
    switch (scene_polygon_check((const scene_number_t(*)[3])parser->scene->vertices + poly->first, poly->count, plane, &off)) {
    case SCENE_POLYGON_FEW: return FAIL(parser, "polygon %lu has fewer than three distinct vertices", (unsigned long)poly->id);
    case SCENE_POLYGON_LINE: return FAIL(parser, "polygon %lu has no area: its vertices lie on one line", (unsigned long)poly->id);
    case SCENE_POLYGON_BENT:
        return FAIL(parser, "polygon %lu is not planar: vertex %zu is off the plane of vertices 1, %zu and %zu",
                    (unsigned long)poly->id, off + 1, plane[1] + 1, plane[2] + 1);
    default: return 0;
    }
}

static int read_poly(parser_t *parser) {
    scene_text_t *scene = parser->scene;
    int64_t id = 0;
    if (read_whole(parser, "polygon ID", 1, UINT32_MAX, &id) < 0) { return -1; }
    scene_poly_t poly = {.id = (uint32_t)id, .first = scene->vertex_count, .line = parser->line};
    for (word_t word = next_word(parser); word.length; word = next_word(parser)) {
        if (++poly.count > SCENE_TEXT_CORNERS_MAX) {
            return FAIL(parser, "polygon %lu has more than %d vertices", (unsigned long)poly.id, SCENE_TEXT_CORNERS_MAX);
        }
        if (read_vertex(parser, word, poly.count) < 0) { return -1; }
    }
    if (poly.count < 3) {
        return FAIL(parser, "polygon %lu has %zu vertices; it takes at least three", (unsigned long)poly.id, poly.count);
    }
    if (check_poly(parser, &poly) < 0) { return -1; }
    void *grown = grow(scene->polys, &parser->poly_capacity, scene->poly_count, sizeof *scene->polys);
    if (!grown) { return FAIL(parser, "out of memory"); }
    scene->polys = grown;
    scene->polys[scene->poly_count++] = poly;
    return 0;
}

static int read_screen(parser_t *parser) {
    int64_t width, height;
    if (read_whole(parser, "screen width", 1, TUILE_WINDOW_MAX_PX, &width) < 0 ||
        read_whole(parser, "screen height", 1, TUILE_WINDOW_MAX_PX, &height) < 0) {
        return -1;
    }
    parser->scene->width = (uint16_t)width;
    parser->scene->height = (uint16_t)height;
    return 0;
}

enum { CAMERA_NUMBER_MAX = 16383 }; /* of origin, sample and focal length: the difference of two fits q16.16 */

static int read_camera(parser_t *parser) {
    scene_text_t *scene = parser->scene;
    bool perspective;
    if (read_choice(parser, "camera", "ortho", "persp", &perspective) < 0) { return -1; }
    scene->projection = perspective ? TUILE_PERSPECTIVE : TUILE_ORTHOGRAPHIC;
    if (!perspective) { return 0; }
    if (read_bounded(parser, "focal length F", CAMERA_NUMBER_MAX, &scene->focal) < 0) { return -1; }
    if (scene->focal.numerator <= 0) { return FAIL(parser, "focal length F must be greater than 0"); }
    word_t word = next_word(parser);
    if (!word.length) { return 0; }
    if (read_number(parser, word, "NEAR", &scene->near) < 0) { return -1; }
    return scene->near.numerator > 0 ? 0 : FAIL(parser, "NEAR must be greater than 0");
}

static int read_pair(parser_t *parser, const char *what_x, const char *what_y, scene_number_t pair[2]) {
    if (read_bounded(parser, what_x, CAMERA_NUMBER_MAX, &pair[0]) < 0) { return -1; }
    return read_bounded(parser, what_y, CAMERA_NUMBER_MAX, &pair[1]);
}

static int read_setting(parser_t *parser, int key) {
    scene_text_t *scene = parser->scene;
    switch (key) {
    case KEY_SCREEN: return read_screen(parser);
    case KEY_CAMERA: return read_camera(parser);
    case KEY_ORIGIN: return read_pair(parser, "origin CX", "origin CY", scene->origin);
    case KEY_YSIGN: {
        bool minus;
        if (read_choice(parser, "ysign", "1", "-1", &minus) < 0) { return -1; }
        scene->y_sign = minus ? -1 : 1;
        return 0;
    }
    case KEY_SAMPLE: return read_pair(parser, "sample SX", "sample SY", scene->sample);
    case KEY_NEAR: return read_choice(parser, "near", "min", "max", &scene->near_max);
    case KEY_TIE:
    default: return read_choice(parser, "tie", "first", "last", &scene->tie_last);
    }
}

static int read_line(parser_t *parser) {
    static const char *const keys[KEY_COUNT] = {"screen", "camera", "origin", "ysign", "sample", "near", "tie"};
    word_t word = next_word(parser);
    if (!word.length) { return 0; }
    if (word_is(word, "poly")) { return read_poly(parser); }
    for (int key = 0; key < KEY_COUNT; key++) {
        if (!word_is(word, keys[key])) { continue; }
        if (parser->seen[key]) { return FAIL(parser, "`%s` was given before, on line %lu", keys[key], parser->seen[key]); }
        parser->seen[key] = parser->line;
        return read_setting(parser, key) < 0 ? -1 : expect_end(parser, keys[key]);
    }
    return FAIL(parser, "unknown keyword '%s'", quote(word).text);
}

/* What depends on several lines. */
static int finish(parser_t *parser) {
    scene_text_t *scene = parser->scene;
    if (!parser->seen[KEY_SCREEN]) { return sim_fail(parser->error, "%.120s: there is no `screen` line", parser->name); }
    if (!parser->seen[KEY_CAMERA]) { return sim_fail(parser->error, "%.120s: there is no `camera` line", parser->name); }
    if (scene->projection == TUILE_ORTHOGRAPHIC) {
        scene->origin[0] = scene->origin[1] = (scene_number_t){0, 1};
        scene->y_sign = 1;
    } else if (!parser->seen[KEY_ORIGIN]) {
        for (int i = 0; i < 2; i++) {
            int size = i ? scene->height : scene->width;
            scene->origin[i] = size % 2 ? (scene_number_t){size, 2} : (scene_number_t){size / 2, 1};
        }
    }
    return 0;
}

int scene_text_parse(scene_text_t *scene, const char *text, size_t size, const char *name, sim_error_t *error) {
    *scene = (scene_text_t){.focal = {1, 1}, .near = {1, 1}, .y_sign = 1};
    for (int i = 0; i < 2; i++) {
        scene->origin[i] = scene->sample[i] = (scene_number_t){0, 1};
    }
    parser_t parser = {.scene = scene, .name = name, .error = error};
    int result = 0;
    for (size_t at = 0; at < size && result == 0;) {
        const char *start = text + at, *newline = memchr(start, '\n', size - at);
        size_t length = newline ? (size_t)(newline - start) : size - at;
        const char *comment = memchr(start, '#', length);
        parser.line++;
        parser.at = start;
        parser.end = comment ? comment : start + length;
        result = read_line(&parser);
        at += length + 1;
    }
    if (result == 0) { result = finish(&parser); }
    if (result < 0) { scene_text_free(scene); }
    return result;
}

/* The whole of a file; NULL and error on failure. */
static char *read_all(const char *path, size_t *size, sim_error_t *error) {
    bool standard_input = strcmp(path, "-") == 0;
    FILE *file = standard_input ? stdin : fopen(path, "rb");
    if (!file) {
        (void)sim_fail(error, "%.200s: cannot be opened", path);
        return NULL;
    }
    char *text = NULL;
    size_t capacity = 0, count = 0, got = 1;
    bool memory = true;
    while (got && memory) {
        if (capacity - count < 4096) {
            char *grown = capacity > SIZE_MAX / 4 ? NULL : realloc(text, capacity * 2 + 65536);
            memory = grown != NULL;
            if (!memory) { break; }
            text = grown;
            capacity = capacity * 2 + 65536;
        }
        got = fread(text + count, 1, capacity - count, file);
        count += got;
    }
    bool good = memory && !ferror(file);
    if (!standard_input) { (void)fclose(file); }
    if (!good) {
        free(text);
        (void)sim_fail(error, "%.200s: %s", path, memory ? "cannot be read" : "is too large for the memory there is");
        return NULL;
    }
    *size = count;
    return text;
}

int scene_text_read(scene_text_t *scene, const char *path, sim_error_t *error) {
    *scene = (scene_text_t){0};
    size_t size = 0;
    char *text = read_all(path, &size, error);
    if (!text) { return -1; }
    int result = scene_text_parse(scene, text, size, strcmp(path, "-") == 0 ? "stdin" : path, error);
    free(text);
    return result;
}

void scene_text_free(scene_text_t *scene) {
    free(scene->polys);
    free(scene->vertices);
    *scene = (scene_text_t){0};
}
