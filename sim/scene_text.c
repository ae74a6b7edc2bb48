/* Text scenes. The whole file is read first, then parsed line by line; whatever is decided about a polygon (is it flat? has it an
 * area?) is decided on the numbers as typed, with integers as wide as they need to be. */
#include "scene_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef __int128 int128_t;

/* ---- wide integers ---------------------------------------------------------------------------------------- */

/* Sign and magnitude. Whether a vertex lies on a plane is the sign of a determinant of differences of fractions. With numerators
 * and denominators below 2^63 a difference times its common denominators is below 2^(127 + 252), the determinant, a sum of six
 * products of three, below 2^(3 * 379 + 3) = 2^1140. 40 limbs hold 2^1280. */
enum { WIDE_LIMBS = 40 };

typedef struct wide {
    int sign;  /* -1, 0, 1 */
    int count; /* limbs in use; the highest is not 0 */
    uint32_t limb[WIDE_LIMBS];
} wide_t;

static wide_t wide_from(int64_t value) {
    wide_t w = {.sign = (value > 0) - (value < 0)};
    uint64_t magnitude = value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
    for (; magnitude; magnitude >>= 32) { w.limb[w.count++] = (uint32_t)magnitude; }
    return w;
}

static int wide_compare_magnitude(const wide_t *a, const wide_t *b) {
    if (a->count != b->count) { return a->count < b->count ? -1 : 1; }
    for (int i = a->count - 1; i >= 0; i--) {
        if (a->limb[i] != b->limb[i]) { return a->limb[i] < b->limb[i] ? -1 : 1; }
    }
    return 0;
}

static wide_t wide_multiply(const wide_t *a, const wide_t *b) {
    wide_t product = {.sign = a->sign * b->sign};
    for (int i = 0; i < a->count; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < b->count || carry; j++) {
            uint64_t sum = product.limb[i + j] + carry + (j < b->count ? (uint64_t)a->limb[i] * b->limb[j] : 0);
            product.limb[i + j] = (uint32_t)sum;
            carry = sum >> 32;
        }
    }
    product.count = a->count + b->count;
    while (product.count > 0 && product.limb[product.count - 1] == 0) { product.count--; }
    return product;
}

static wide_t wide_subtract(const wide_t *a, const wide_t *b) {
    if (b->sign == 0) { return *a; }
    int order = wide_compare_magnitude(a, b);
    if (a->sign != b->sign) { /* magnitudes add */
        wide_t sum = {.sign = -b->sign};
        int count = a->count > b->count ? a->count : b->count;
        uint64_t carry = 0;
        for (int i = 0; i < count || carry; i++) {
            carry += (uint64_t)a->limb[i] + b->limb[i];
            sum.limb[i] = (uint32_t)carry;
            carry >>= 32;
            sum.count = i + 1;
        }
        return sum;
    }
    if (order == 0) { return (wide_t){0}; }
    const wide_t *large = order > 0 ? a : b, *small = order > 0 ? b : a;
    wide_t difference = {.sign = a->sign * order};
    int64_t borrow = 0;
    for (int i = 0; i < large->count; i++) {
        int64_t digit = (int64_t)large->limb[i] - small->limb[i] - borrow;
        borrow = digit < 0;
        difference.limb[i] = (uint32_t)(digit + (borrow << 32));
        if (difference.limb[i]) { difference.count = i + 1; }
    }
    return difference;
}

static wide_t wide_multiply_int(wide_t a, int64_t b) {
    wide_t factor = wide_from(b);
    return wide_multiply(&a, &factor);
}

/* ---- exact vectors ---------------------------------------------------------------------------------------- */

typedef struct wide_vector {
    wide_t at[3];
} wide_vector_t;

/* (to - from) times a positive number that makes it whole. */
static wide_vector_t vector_between(const scene_number_t from[3], const scene_number_t to[3]) {
    wide_vector_t vector;
    for (int i = 0; i < 3; i++) {
        wide_t a = wide_multiply_int(wide_from(to[i].numerator), from[i].denominator);
        wide_t b = wide_multiply_int(wide_from(from[i].numerator), to[i].denominator);
        vector.at[i] = wide_subtract(&a, &b);
        for (int k = 0; k < 3; k++) {
            if (k != i) {
                vector.at[i] = wide_multiply_int(wide_multiply_int(vector.at[i], from[k].denominator), to[k].denominator);
            }
        }
    }
    return vector;
}

static bool vector_is_zero(const wide_vector_t *v) { return v->at[0].sign == 0 && v->at[1].sign == 0 && v->at[2].sign == 0; }

static wide_vector_t vector_cross(const wide_vector_t *a, const wide_vector_t *b) {
    wide_vector_t cross;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        wide_t plus = wide_multiply(&a->at[j], &b->at[k]), minus = wide_multiply(&a->at[k], &b->at[j]);
        cross.at[i] = wide_subtract(&plus, &minus);
    }
    return cross;
}

static int vector_dot_sign(const wide_vector_t *a, const wide_vector_t *b) {
    wide_t sum = {0};
    for (int i = 0; i < 3; i++) {
        wide_t term = wide_multiply(&a->at[i], &b->at[i]);
        term.sign = -term.sign;
        sum = wide_subtract(&sum, &term);
    }
    return sum.sign;
}

/* Numbers are in lowest terms, so equal numbers have equal parts. */
static bool same_vertex(const scene_number_t a[3], const scene_number_t b[3]) {
    for (int i = 0; i < 3; i++) {
        if (a[i].numerator != b[i].numerator || a[i].denominator != b[i].denominator) { return false; }
    }
    return true;
}

/* ---- reading ---------------------------------------------------------------------------------------------- */

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
    for (size_t i = 0; i < count; i++) { quoted.text[i] = word.start[i]; }
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
    while (parser->at < parser->end && is_blank(*parser->at)) { parser->at++; }
    word_t word = {parser->at, 0};
    while (parser->at < parser->end && !is_blank(*parser->at)) { parser->at++; }
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
    for (; at < end && is_digit(*at); at++, digits++) { fits = fits && append_digit(&numerator, (unsigned)(*at - '0')); }
    if (at < end && *at == '.') {
        size_t zeros = 0; /* those at the end of a decimal do not count against its length */
        for (at++; at < end && is_digit(*at); at++, digits++) {
            zeros++;
            if (*at == '0') { continue; }
            for (; zeros > 1 && fits; zeros--) { fits = append_digit(&numerator, 0) && append_digit(&denominator, 0); }
            fits = fits && append_digit(&numerator, (unsigned)(*at - '0')) && append_digit(&denominator, 0);
            zeros = 0;
        }
    } else if (at < end && *at == '/' && digits) {
        size_t below = 0;
        denominator = 0;
        for (at++; at < end && is_digit(*at); at++, below++) { fits = fits && append_digit(&denominator, (unsigned)(*at - '0')); }
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
    case NUMBER_GOOD:
        return 0;
    case NUMBER_TOO_LONG:
        return FAIL(parser, "%s '%s' has more digits than 64 bits hold", what, quote(word).text);
    case NUMBER_ZERO_DENOMINATOR:
        return FAIL(parser, "%s '%s' divides by zero", what, quote(word).text);
    case NUMBER_MALFORMED:
    default:
        return FAIL(parser, "%s '%s' is neither a decimal nor a fraction", what, quote(word).text);
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
    for (const char *c = at; c < end; c++) { commas += *c == ','; }
    if (commas != 2) {
        return FAIL(parser, "vertex %zu, '%s', is not x,y,z (no blanks around the commas)", number, quote(word).text);
    }
    for (int i = 0; i < 3; i++) {
        word_t part = {at, 0};
        while (at < end && *at != ',') { at++; }
        part.length = (size_t)(at - part.start);
        at++; /* the comma; behind the last number nothing looks at it */
        char what[48];
        (void)snprintf(what, sizeof what, "vertex %zu: %c", number, "xyz"[i]);
        if (read_number(parser, part, what, &vertex[i]) < 0) { return -1; }
    }
    return add_vertex(parser, vertex);
}

/* Flat, with an area: three vertices span a plane, all others lie on it. */
static int check_poly(parser_t *parser, const scene_poly_t *poly) {
    scene_number_t(*v)[3] = parser->scene->vertices + poly->first;
    size_t second = 1;
    while (second < poly->count && same_vertex(v[0], v[second])) { second++; }
    size_t third = second;
    while (third < poly->count && (same_vertex(v[0], v[third]) || same_vertex(v[second], v[third]))) { third++; }
    if (third >= poly->count) {
        return FAIL(parser, "polygon %lu has fewer than three distinct vertices", (unsigned long)poly->id);
    }

    wide_vector_t along = vector_between(v[0], v[second]), normal = {0};
    for (; third < poly->count; third++) {
        wide_vector_t other = vector_between(v[0], v[third]);
        normal = vector_cross(&along, &other);
        if (!vector_is_zero(&normal)) { break; }
    }
    if (third == poly->count) {
        return FAIL(parser, "polygon %lu has no area: its vertices lie on one line", (unsigned long)poly->id);
    }
    for (size_t k = third + 1; k < poly->count; k++) {
        wide_vector_t other = vector_between(v[0], v[k]);
        if (vector_dot_sign(&normal, &other) != 0) {
            return FAIL(parser, "polygon %lu is not planar: vertex %zu is off the plane of vertices 1, %zu and %zu",
                        (unsigned long)poly->id, k + 1, second + 1, third + 1);
        }
    }
    return 0;
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
    case KEY_SCREEN:
        return read_screen(parser);
    case KEY_CAMERA:
        return read_camera(parser);
    case KEY_ORIGIN:
        return read_pair(parser, "origin CX", "origin CY", scene->origin);
    case KEY_YSIGN: {
        bool minus;
        if (read_choice(parser, "ysign", "1", "-1", &minus) < 0) { return -1; }
        scene->y_sign = minus ? -1 : 1;
        return 0;
    }
    case KEY_SAMPLE:
        return read_pair(parser, "sample SX", "sample SY", scene->sample);
    case KEY_NEAR:
        return read_choice(parser, "near", "min", "max", &scene->near_max);
    case KEY_TIE:
    default:
        return read_choice(parser, "tie", "first", "last", &scene->tie_last);
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
    for (int i = 0; i < 2; i++) { scene->origin[i] = scene->sample[i] = (scene_number_t){0, 1}; }
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

/* ---- to the renderer -------------------------------------------------------------------------------------- */

enum {
    STEPS_MAX = 32767,
    EXPONENT_MIN = -32,
    EXPONENT_MAX = 62,
    DEPTH_STEPS = 65472
}; /* a few steps at the ends are the renderer's */

static int128_t floor_divide(int128_t a, int128_t b) { /* b > 0 */
    int128_t quotient = a / b;
    return quotient - (a % b < 0);
}

static int128_t absolute(int128_t a) { return a < 0 ? -a : a; }

/* Multiplies a fraction by 2^shift, -63 <= shift <= 63: both parts stay below 2^126. */
static void scale_fraction(scene_number_t number, int shift, int128_t *numerator, int128_t *denominator) {
    *numerator = (int128_t)number.numerator * (shift > 0 ? (int128_t)1 << shift : 1);
    *denominator = (int128_t)number.denominator * (shift < 0 ? (int128_t)1 << -shift : 1);
}

/* Is number a whole multiple of 2^exponent? */
static bool is_multiple(scene_number_t number, int exponent) {
    int128_t numerator, denominator;
    scale_fraction(number, -exponent, &numerator, &denominator);
    return numerator % denominator == 0;
}

static bool is_in_range(scene_number_t number, int exponent) {
    int128_t numerator, denominator;
    scale_fraction(number, -exponent, &numerator, &denominator);
    int128_t whole = absolute(numerator) / denominator; /* STEPS_MAX * denominator may not fit */
    return whole < STEPS_MAX || (whole == STEPS_MAX && absolute(numerator) % denominator == 0);
}

/* number / 2^exponent to the nearest whole number, halves up. */
static int32_t to_steps(scene_number_t number, int exponent) {
    int128_t numerator, denominator;
    scale_fraction(number, -exponent, &numerator, &denominator);
    int128_t steps = floor_divide(numerator, denominator), rest = numerator - steps * denominator;
    return (int32_t)(steps + (rest >= denominator - rest));
}

/* Every coordinate of the scene obeys test at this exponent. */
static bool all_coordinates(const scene_text_t *scene, int exponent, bool (*test)(scene_number_t, int)) {
    for (size_t i = 0; i < scene->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            if (!test(scene->vertices[i][k], exponent)) { return false; }
        }
    }
    return true;
}

static scene_quantisation_t quantise(const scene_text_t *scene) {
    scene_quantisation_t quantisation = {.exact = true};
    /* Nearest to 1: coarser only if the range asks for it, finer only if the fractions do. */
    while (quantisation.exponent < EXPONENT_MAX && !all_coordinates(scene, quantisation.exponent, is_in_range)) {
        quantisation.exponent++;
    }
    if (all_coordinates(scene, quantisation.exponent, is_multiple)) { return quantisation; }
    while (quantisation.exponent > EXPONENT_MIN && all_coordinates(scene, quantisation.exponent - 1, is_in_range)) {
        quantisation.exponent--;
        if (all_coordinates(scene, quantisation.exponent, is_multiple)) { return quantisation; }
    }
    quantisation.exact = false;
    for (size_t i = 0; i < scene->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            int128_t numerator, denominator;
            scale_fraction(scene->vertices[i][k], -quantisation.exponent, &numerator, &denominator);
            int128_t rest = numerator - floor_divide(numerator, denominator) * denominator;
            double part = (double)rest / (double)denominator, error = ldexp(part < 0.5 ? part : 1 - part, quantisation.exponent);
            quantisation.error_max = error > quantisation.error_max ? error : quantisation.error_max;
        }
    }
    return quantisation;
}

int scene_text_mesh(const scene_text_t *scene, mesh_t *mesh, scene_quantisation_t *quantisation, sim_error_t *error) {
    *mesh = (mesh_t){0};
    *quantisation = quantise(scene);
    if (scene->vertex_count > UINT32_MAX || scene->poly_count > UINT32_MAX) {
        return sim_fail(error, "the scene has more vertices than a model can count");
    }
    size_t vertices = scene->vertex_count ? scene->vertex_count : 1, polys = scene->poly_count ? scene->poly_count : 1;
    mesh->positions = calloc(vertices, sizeof *mesh->positions);
    mesh->corners = calloc(vertices, sizeof *mesh->corners);
    mesh->faces = calloc(polys, sizeof *mesh->faces);
    mesh->materials = calloc(1, sizeof *mesh->materials);
    if (!mesh->positions || !mesh->corners || !mesh->faces || !mesh->materials) {
        free(mesh->positions);
        free(mesh->corners);
        free(mesh->faces);
        free(mesh->materials);
        *mesh = (mesh_t){0};
        return sim_fail(error, "out of memory");
    }
    mesh->position_count = mesh->corner_count = scene->vertex_count;
    mesh->face_count = mesh->source_face_count = scene->poly_count;
    mesh->material_count = 1;
    memset(mesh->materials[0], 255, sizeof mesh->materials[0]);
    for (size_t i = 0; i < scene->vertex_count; i++) {
        mesh->corners[i] = (uint32_t)i;
        for (int k = 0; k < 3; k++) { mesh->positions[i][k] = to_steps(scene->vertices[i][k], quantisation->exponent); }
    }
    for (size_t i = 0; i < scene->poly_count; i++) {
        mesh->faces[i] = (mesh_face_t){
            .first = (uint32_t)scene->polys[i].first, .count = (uint32_t)scene->polys[i].count, .source = (uint32_t)i};
    }
    return 0;
}

mesh_options_t scene_text_mesh_options(void) { return (mesh_options_t){.keep_order = true, .keep_planar = true, .step = 1}; }

/* number * 2^60, rounded down; |number| <= 2^14. *exact is cleared when there was anything to round. */
static int128_t to_fixed60(scene_number_t number, bool *exact) {
    int128_t scaled = (int128_t)number.numerator * ((int128_t)1 << 60);
    if (scaled % number.denominator != 0) { *exact = false; }
    return floor_divide(scaled, number.denominator);
}

/* The nearest q16.16, halves up, of a fixed-point number with 60 fractional bits and |value| <= 2^15 - 1. */
static q16_16_t fixed60_to_q16(int128_t value, bool *exact) {
    const int128_t unit = (int128_t)1 << 44;
    if (value % unit != 0) { *exact = false; }
    return (q16_16_t)floor_divide(value + unit / 2, unit);
}

static void axes(tuile_pose_t *pose, int y, int z) {
    pose->rotation[0][0] = TUILE_ONE_Q30;
    pose->rotation[1][1] = y * TUILE_ONE_Q30;
    pose->rotation[2][2] = z * TUILE_ONE_Q30;
}

static void perspective(const scene_text_t *scene, int exponent, scene_view_t *view) {
    tuile_camera_t *camera = &view->camera;
    axes(&view->pose, -scene->y_sign, -1);
    view->pose.scale = TUILE_SCALE_ONE;
    camera->focal_x = camera->focal_y = fixed60_to_q16(to_fixed60(scene->focal, &view->exact), &view->exact);
    if (camera->focal_x < 1) { camera->focal_x = camera->focal_y = 1; }

    int128_t numerator, denominator;
    scale_fraction(scene->near, 16 - exponent, &numerator, &denominator);
    int128_t near = floor_divide(numerator, denominator), rest = numerator - near * denominator;
    if (near > INT32_MAX - 1) { /* beyond every vertex, as it was */
        near = INT32_MAX - 1;
    } else if (rest) {
        near += rest >= denominator - rest;
        view->exact = false;
    }
    camera->near = near < 1 ? 1 : (q16_16_t)near;
    camera->far = INT32_MAX;
}

static int orthographic(const scene_text_t *scene, int exponent, scene_view_t *view, sim_error_t *error) {
    tuile_camera_t *camera = &view->camera;
    int sign = scene->near_max ? 1 : -1; /* view z of the scene's z: larger is nearer */
    axes(&view->pose, -1, sign);
    int64_t front = 0, back = 0; /* largest and least view z, steps */
    for (size_t i = 0; i < scene->vertex_count; i++) {
        int64_t z = sign * (int64_t)to_steps(scene->vertices[i][2], exponent);
        front = i == 0 || z > front ? z : front;
        back = i == 0 || z < back ? z : back;
    }
    /* One world unit is 2^shrink steps: enough of them for distances to fit (below 2^15 units), and for one unit to be at least
     * 2^-16 pixels. A shrink of up to 16 leaves whole steps exact in q16.16, and 2^-32 <= step makes 16 enough. */
    for (int shrink = exponent < -16 ? -16 - exponent : 0; shrink <= 16 && exponent + shrink <= 14; shrink++) {
        int64_t unit = 65536 >> shrink; /* one step, q16.16 */
        int64_t range = (front - back) * unit, margin = range / 4096 > unit ? range / 4096 : unit;
        int64_t far = unit + 2 * margin + range, eye = front * unit + unit + margin;
        if (far > INT32_MAX || eye > INT32_MAX || eye < -INT32_MAX) { continue; }
        view->pose.scale = (tuile_scale_t){1, -shrink};
        camera->focal_x = camera->focal_y = (q16_16_t)1 << (16 + exponent + shrink);
        camera->eye[2] = (q16_16_t)eye;
        camera->near = (q16_16_t)unit;
        camera->far = (q16_16_t)far;
        view->depth_step = ldexp((double)(2 * margin + range), exponent + shrink - 16) / DEPTH_STEPS;
        return 0;
    }
    return sim_fail(error, "the scene's coordinates are too large for an orthographic camera: one int16 step is 2^%d pixels",
                    exponent);
}

int scene_text_camera(const scene_text_t *scene, const scene_quantisation_t *quantisation, scene_view_t *view, sim_error_t *error) {
    *view = (scene_view_t){.exact = true, .tie = scene->tie_last ? TUILE_TIE_LAST : TUILE_TIE_FIRST};
    tuile_camera_t *camera = &view->camera;
    camera->projection = scene->projection;
    for (int i = 0; i < 3; i++) { camera->rotation[i][i] = TUILE_ONE_Q30; }
    /* The text samples pixel i at i + SX, Tuile at i + 1/2: the picture moves by the difference. */
    const int128_t half = (int128_t)1 << 59;
    q16_16_t centre[2];
    for (int i = 0; i < 2; i++) {
        centre[i] = fixed60_to_q16(to_fixed60(scene->origin[i], &view->exact) + half - to_fixed60(scene->sample[i], &view->exact),
                                   &view->exact);
    }
    camera->centre_x = centre[0];
    camera->centre_y = centre[1];
    if (scene->projection == TUILE_ORTHOGRAPHIC) { return orthographic(scene, quantisation->exponent, view, error); }
    perspective(scene, quantisation->exponent, view);
    return 0;
}
