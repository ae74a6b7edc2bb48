/* Fonts in files, and what users say of them. */
#include "../raster/overlay/font.h"
#include "c_source.h"
#include "compiled.h"
#include "font.h"
#include "input.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* ---- ranges ---- */

/* A code point at *text, decimal or 0x and hexadecimal; false when there is none. */
static bool parse_code(const char **text, uint32_t *code) {
    char *end;
    if (**text < '0' || **text > '9') { return false; }
    const bool hex = (*text)[0] == '0' && ((*text)[1] == 'x' || (*text)[1] == 'X');
    errno = 0;
    const unsigned long value = strtoul(*text, &end, hex ? 16 : 10);
    if (errno || value > FONT_CODE_MAX || end == *text) { return false; }
    *text = end;
    *code = (uint32_t)value;
    return true;
}

int font_ranges_parse(const char *text, font_range_t ranges[FONT_RANGES_MAX], size_t *count, sim_error_t *error) {
    const char *at = text;
    for (*count = 0; *count < FONT_RANGES_MAX;) {
        font_range_t *range = &ranges[*count];
        if (!parse_code(&at, &range->first)) { break; }
        range->last = range->first;
        if (*at == '-') {
            at++;
            if (!parse_code(&at, &range->last) || range->last < range->first) { break; }
        }
        ++*count;
        if (*at == '\0') { return 0; }
        if (*at++ != ',') { break; }
    }
    return sim_fail(error, "--range %.80s: wants up to %d code points or ranges, like 32-126,0xB0,0x20AC", text, FONT_RANGES_MAX);
}

/* ---- writing ---- */

static void put_heading(FILE *file, const uint8_t *bytes, size_t size_bytes, const char *name) {
    (void)fprintf(file,
                  "/* A compiled font for tuile_font_open(&font, %s, sizeof %s).\n"
                  " * %u glyphs, lines of %u dots, %zu bytes. The words are little-endian, as the machine has to be. */\n",
                  name, name, bytes[FONT_AT_GLYPHS] | (unsigned)bytes[FONT_AT_GLYPHS + 1] << 8, bytes[FONT_AT_HEIGHT], size_bytes);
}

int font_write(const uint8_t *bytes, size_t size_bytes, const char *path, const char *name, sim_error_t *error) {
    static const compiled_kind_t kind = {"fonts", ".tuilefont", "font_", put_heading};
    return compiled_write(&kind, bytes, size_bytes, path, name, error);
}

/* ---- reading ---- */

static int compile_text(const char *text, size_t text_bytes, const char *name, uint8_t **bytes, size_t *size_bytes,
                        sim_error_t *error) {
    font_source_t source;
    if (font_bdf_parse(&source, text, text_bytes, name, error) != 0) { return -1; }
    const int failed = font_compile(&source, NULL, 0, bytes, size_bytes, NULL, error);
    font_source_free(&source);
    return failed;
}

int font_read_source(font_source_t *source, const char *path, sim_error_t *error) {
    uint8_t *text;
    size_t text_bytes;
    if (input_read(path, FONT_FILE_MAX, &text, &text_bytes, error) != 0) { return -1; }
    const int failed = font_bdf_parse(source, (const char *)text, text_bytes, path, error);
    free(text);
    return failed;
}

int font_load(const char *path, uint8_t **bytes, size_t *size_bytes, sim_error_t *error) {
    tuile_font_t font;
    uint8_t *text;
    size_t text_bytes;
    if (!path) {
        /* Both are labels in one file's bytes (font_default.c). */
        /* cppcheck-suppress comparePointers */
        return compile_text(font_default_text, (size_t)(font_default_end - font_default_text), "tuile-6x10.bdf", bytes, size_bytes,
                            error);
    }
    if (strcmp(c_extension(path), ".tuilefont") != 0) {
        if (input_read(path, FONT_FILE_MAX, &text, &text_bytes, error) != 0) { return -1; }
        const int failed = compile_text((const char *)text, text_bytes, path, bytes, size_bytes, error);
        free(text);
        return failed;
    }
    if (input_read(path, FONT_FILE_MAX, bytes, size_bytes, error) != 0) { return -1; }
    const int result = tuile_font_open(&font, *bytes, *size_bytes);
    if (result == 0) { return 0; }
    free(*bytes);
    *bytes = NULL;
    return sim_fail(error, "%s: %s", path, tuile_error_text(result));
}
