/* BDF 2.1: lines of a keyword and what belongs to it; glyphs as rows of hexadecimal digits. Keywords that say nothing about dots
 * (names, sizes in points, properties of other programs) are passed over; what does is believed only as far as it fits. */
#include "../raster/overlay/font.h"
#include "font.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE_MAX_CHARS 1000

typedef struct reader {
    const char *at, *end, *name;
    unsigned line;
    char text[LINE_MAX_CHARS + 1]; /* the current line, no newline */
    sim_error_t *error;
} reader_t;

#define FAIL(reader, ...) fail_at(reader, (reader)->line, __VA_ARGS__)

#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static int
fail_at(const reader_t *reader, unsigned line, const char *format, ...) {
    char what[400];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return sim_fail(reader->error, "%s:%u: %s", reader->name, line, what);
}

/* The next line that is neither empty nor a comment: 1, at the end 0, or -1. */
static int next_line(reader_t *reader) {
    do {
        if (reader->at == reader->end) { return 0; }
        reader->line++;
        const char *newline = memchr(reader->at, '\n', (size_t)(reader->end - reader->at));
        const char *stop = newline ? newline : reader->end;
        size_t length = (size_t)(stop - reader->at);
        if (length > 0 && reader->at[length - 1] == '\r') { length--; }
        if (length > LINE_MAX_CHARS) { return FAIL(reader, "a line of more than %d characters", LINE_MAX_CHARS); }
        if (memchr(reader->at, '\0', length)) { return FAIL(reader, "a zero byte; this is no BDF file"); }
        memcpy(reader->text, reader->at, length);
        while (length > 0 && (reader->text[length - 1] == ' ' || reader->text[length - 1] == '\t')) {
            length--;
        }
        reader->text[length] = '\0';
        reader->at = newline ? newline + 1 : reader->end;
    } while (reader->text[0] == '\0' || strncmp(reader->text, "COMMENT", 7) == 0);
    return 1;
}

/* What follows the keyword; NULL when the line begins otherwise. */
static const char *after(const reader_t *reader, const char *keyword) {
    const size_t length = strlen(keyword);
    if (strncmp(reader->text, keyword, length) != 0) { return NULL; }
    const char *rest = reader->text + length;
    return *rest == '\0' || *rest == ' ' || *rest == '\t' ? rest : NULL;
}

/* `least` to `most` whole numbers and nothing else, each low ... high. */
static int numbers(const reader_t *reader, const char *text, const char *what, long *values, unsigned least, unsigned most,
                   long low, long high) {
    unsigned count = 0;
    for (;;) {
        char *end;
        while (*text == ' ' || *text == '\t') {
            text++;
        }
        if (*text == '\0') { break; }
        if (count == most) { return FAIL(reader, "%s: more than %u number%s", what, most, most == 1 ? "" : "s"); }
        errno = 0;
        values[count] = strtol(text, &end, 10);
        if (end == text || (*end != ' ' && *end != '\t' && *end != '\0')) {
            return FAIL(reader, "%s: \"%.40s\" is no whole number", what, text);
        }
        if (errno == ERANGE || values[count] < low || values[count] > high) {
            return FAIL(reader, "%s: %.*s is out of range, %ld to %ld", what, (int)(end - text > 40 ? 40 : end - text), text, low,
                        high);
        }
        text = end;
        count++;
    }
    return count < least ? FAIL(reader, "%s: wants %u number%s, but has %u", what, least, least == 1 ? "" : "s", count) : 0;
}

/* ---- a glyph ---- */

static int hex_digit(char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

static int parse_row(const reader_t *reader, uint8_t *row, size_t bytes) {
    if (strlen(reader->text) != 2 * bytes) {
        return FAIL(reader, "a row of this glyph wants %zu hexadecimal digits, not \"%.40s\"", 2 * bytes, reader->text);
    }
    for (size_t i = 0; i < bytes; i++) {
        const int high = hex_digit(reader->text[2 * i]), low = hex_digit(reader->text[2 * i + 1]);
        if (high < 0 || low < 0) { return FAIL(reader, "\"%.40s\" are no hexadecimal digits", reader->text); }
        row[i] = (uint8_t)(high << 4 | low);
    }
    return 0;
}

static int parse_rows(reader_t *reader, font_source_glyph_t *glyph) {
    const size_t bytes = ((size_t)glyph->width + 7) / 8, rows = (size_t)glyph->height;
    if (bytes * rows > 0) {
        glyph->rows = calloc(rows, bytes);
        if (!glyph->rows) { return sim_fail(reader->error, "out of memory"); }
    }
    for (size_t i = 0; i <= rows; i++) {
        const int more = next_line(reader);
        if (more < 0) { return -1; }
        const bool ended = more && after(reader, "ENDCHAR");
        if (i == rows && ended) { return 0; }
        if (!more || ended || after(reader, "STARTCHAR") || after(reader, "ENDFONT")) {
            return i < rows ? FAIL(reader, "the glyph that begins in line %u has %zu rows instead of %zu", glyph->line, i, rows)
                            : FAIL(reader, "ENDCHAR is missing for the glyph that begins in line %u", glyph->line);
        }
        if (i == rows) {
            return FAIL(reader, "the glyph that begins in line %u has more than %zu rows, or ENDCHAR is missing", glyph->line,
                        rows);
        }
        if (bytes > 0 && parse_row(reader, glyph->rows + i * bytes, bytes) != 0) { return -1; }
    }
    return 0;
}

typedef struct heads {
    bool encoding, advance, box;
} heads_t;

static int parse_head(const reader_t *reader, font_source_glyph_t *glyph, long *code, heads_t *has) {
    const char *rest;
    long values[4];
    if ((rest = after(reader, "ENCODING")) != NULL) {
        values[1] = 0;
        if (numbers(reader, rest, "ENCODING", values, 1, 2, -1, FONT_CODE_MAX) != 0) { return -1; }
        if (values[0] >= 0xd800 && values[0] <= 0xdfff) {
            return FAIL(reader, "ENCODING: %ld is half of a pair of UTF-16, no character", values[0]);
        }
        *code = values[0];
        has->encoding = true;
    } else if ((rest = after(reader, "DWIDTH")) != NULL) {
        if (numbers(reader, rest, "DWIDTH", values, 2, 2, -32768, 32767) != 0) { return -1; }
        if (values[0] < 0 || values[0] > 255 || values[1] != 0) {
            return FAIL(reader, "DWIDTH: only steps of 0 to 255 dots to the right are supported");
        }
        glyph->advance = (int)values[0];
        has->advance = true;
    } else if ((rest = after(reader, "BBX")) != NULL) {
        if (numbers(reader, rest, "BBX", values, 4, 4, -32768, 32767) != 0) { return -1; }
        if (values[0] < 0 || values[1] < 0 || values[0] > (long)FONT_BOX_MAX || values[1] > (long)FONT_BOX_MAX) {
            return FAIL(reader, "BBX: a box of %ldx%ld dots; 0 to %u each are supported", values[0], values[1], FONT_BOX_MAX);
        }
        if (values[2] < -128 || values[2] > 127 || values[3] < -128 || values[3] > 127) {
            return FAIL(reader, "BBX: a box at %ld,%ld; -128 to 127 are supported", values[2], values[3]);
        }
        glyph->width = (int)values[0], glyph->height = (int)values[1];
        glyph->left = (int)values[2], glyph->below = (int)values[3];
        has->box = true;
    } else if (after(reader, "ENDCHAR") || after(reader, "STARTCHAR") || after(reader, "ENDFONT")) {
        return FAIL(reader, "BITMAP is missing for the glyph that begins in line %u", glyph->line);
    }
    return 0;
}

static int parse_glyph(reader_t *reader, font_source_glyph_t *glyph, long *code) {
    heads_t has = {false, false, false};
    memset(glyph, 0, sizeof *glyph);
    glyph->line = reader->line;
    *code = -1;
    for (;;) {
        const int more = next_line(reader);
        if (more < 0) { return -1; }
        if (!more) { return FAIL(reader, "the file ends within the glyph that begins in line %u", glyph->line); }
        if (after(reader, "BITMAP")) { break; }
        if (parse_head(reader, glyph, code, &has) != 0) { return -1; }
    }
    if (!has.encoding || !has.advance || !has.box) {
        return FAIL(reader, "%s is missing for the glyph that begins in line %u",
                    !has.encoding  ? "ENCODING"
                    : !has.advance ? "DWIDTH"
                                   : "BBX",
                    glyph->line);
    }
    return parse_rows(reader, glyph);
}

/* ---- the font ---- */

typedef struct font_heads {
    bool font, ascent, descent, chars, ended;
    long box[4], default_char, char_count;
} font_heads_t;

static int parse_font_head(const reader_t *reader, font_source_t *source, font_heads_t *heads) {
    const char *rest;
    long value = 0;
    if ((rest = after(reader, "FONTBOUNDINGBOX")) != NULL) {
        return numbers(reader, rest, "FONTBOUNDINGBOX", heads->box, 4, 4, -32768, 32767);
    }
    if ((rest = after(reader, "FONT_ASCENT")) != NULL || (rest = after(reader, "FONT_DESCENT")) != NULL) {
        const bool ascent = after(reader, "FONT_ASCENT") != NULL;
        if (numbers(reader, rest, ascent ? "FONT_ASCENT" : "FONT_DESCENT", &value, 1, 1, 0, FONT_BOX_MAX) != 0) { return -1; }
        *(ascent ? &source->ascent : &source->descent) = (int)value;
        *(ascent ? &heads->ascent : &heads->descent) = true;
    } else if ((rest = after(reader, "DEFAULT_CHAR")) != NULL) {
        return numbers(reader, rest, "DEFAULT_CHAR", &heads->default_char, 1, 1, -1, INT32_MAX);
    } else if ((rest = after(reader, "CHARS")) != NULL) {
        heads->chars = true;
        return numbers(reader, rest, "CHARS", &heads->char_count, 1, 1, 0, 1114112);
    }
    return 0;
}

static int add_glyph(reader_t *reader, font_source_t *source, size_t *room) {
    font_source_glyph_t glyph;
    long code;
    const int failed = parse_glyph(reader, &glyph, &code);
    if (failed || code < 0) {
        free(glyph.rows);
        source->unencoded++;
        return failed;
    }
    if (source->count == *room) {
        font_source_glyph_t *larger = realloc(source->glyphs, (*room * 2 + 64) * sizeof *larger);
        if (!larger) {
            free(glyph.rows);
            return sim_fail(reader->error, "out of memory");
        }
        source->glyphs = larger;
        *room = *room * 2 + 64;
    }
    glyph.code = (uint32_t)code;
    source->glyphs[source->count++] = glyph;
    return 0;
}

static int compare_codes(const void *a, const void *b) {
    const font_source_glyph_t *first = a, *second = b;
    if (first->code != second->code) { return first->code < second->code ? -1 : 1; }
    return (first->line > second->line) - (first->line < second->line);
}

/* Of the whole: nothing twice, nothing missing, a line height. */
static int finish(const reader_t *reader, font_source_t *source, const font_heads_t *heads) {
    if (!heads->ended) { return FAIL(reader, "ENDFONT is missing: the file was cut short"); }
    if (heads->chars && (size_t)heads->char_count != source->count + source->unencoded) {
        return FAIL(reader, "CHARS promises %ld glyphs, but there are %zu", heads->char_count, source->count + source->unencoded);
    }
    if (source->count == 0) { return FAIL(reader, "no glyph has a code point"); }
    qsort(source->glyphs, source->count, sizeof *source->glyphs, compare_codes);
    for (size_t i = 1; i < source->count; i++) {
        const font_source_glyph_t *glyph = &source->glyphs[i];
        if (glyph->code == glyph[-1].code) {
            return fail_at(reader, glyph->line, "code point %u has a glyph already, in line %u", glyph->code, glyph[-1].line);
        }
    }
    if (!heads->ascent) { source->ascent = (int)(heads->box[1] + heads->box[3]); }
    if (!heads->descent) { source->descent = (int)-heads->box[3]; }
    if (source->ascent < 0 || source->descent < 0 || source->ascent + source->descent < 1 ||
        source->ascent + source->descent > (int)FONT_BOX_MAX) {
        return FAIL(reader, "lines of %d + %d dots; 1 to %u in all are supported", source->ascent, source->descent, FONT_BOX_MAX);
    }
    source->advance = (int)(heads->box[0] < 1 ? 1 : heads->box[0] > 255 ? 255 : heads->box[0]);
    for (size_t i = 0; i < source->count; i++) {
        const font_source_glyph_t *glyph = &source->glyphs[i];
        if ((long)glyph->code == heads->default_char && glyph->advance > 0) { source->advance = glyph->advance; }
    }
    return 0;
}

static int parse(reader_t *reader, font_source_t *source) {
    font_heads_t heads = {.default_char = -1};
    size_t room = 0;
    int more = next_line(reader);
    if (more < 0) { return -1; }
    if (!more || !after(reader, "STARTFONT")) { return FAIL(reader, "no BDF file: it does not begin with STARTFONT"); }
    while (!heads.ended) {
        more = next_line(reader);
        if (more < 0) { return -1; }
        if (!more) { break; }
        if (after(reader, "ENDFONT")) {
            heads.ended = true;
        } else if (after(reader, "STARTCHAR")) {
            if (add_glyph(reader, source, &room) != 0) { return -1; }
        } else if (after(reader, "ENDCHAR") || after(reader, "BITMAP")) {
            return FAIL(reader, "\"%.40s\" without STARTCHAR", reader->text);
        } else if (parse_font_head(reader, source, &heads) != 0) {
            return -1;
        }
    }
    return finish(reader, source, &heads);
}

int font_bdf_parse(font_source_t *source, const char *text, size_t size_bytes, const char *name, sim_error_t *error) {
    sim_error_t own = {""};
    reader_t reader = {.at = text, .end = text + size_bytes, .name = name, .error = error ? error : &own};
    reader.error->text[0] = '\0';
    memset(source, 0, sizeof *source);
    if (parse(&reader, source) == 0) { return 0; }
    font_source_free(source);
    return -1;
}

void font_source_free(font_source_t *source) {
    for (size_t i = 0; i < source->count; i++) {
        free(source->glyphs[i].rows);
    }
    free(source->glyphs);
    memset(source, 0, sizeof *source);
}
