/* tuile font: compile a bitmap font for flash. */
#include "commands.h"
#include "font.h"
#include "options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] = "Usage: tuile font FONT.bdf -o OUT.c|OUT.tuilefont [--range 32-255,0x20AC] [--name NAME]\n"
                            "\n"
                            "Reads a bitmap font as BDF 2.1, whose encodings are taken as Unicode, and writes it compact and "
                            "checked, as a C file with one\n"
                            "const object for flash or as a .tuilefont file with the same bytes.\n"
                            "\n"
                            "  -o FILE          where to write; the ending decides the form\n"
                            "  --range R,R,...  code points to take, decimal or 0x..., or ranges of them; by default all\n"
                            "  --name NAME      C identifier of the object (.c only); by default from FILE\n";

static int compile(const char *in, const char *out, const char *name, const font_range_t *ranges, size_t range_count) {
    sim_error_t error = {""};
    font_source_t source;
    font_report_t report;
    uint8_t *bytes = NULL;
    size_t size_bytes;
    if (font_read_source(&source, in, &error) != 0) { return command_fail("%s", error.text); }
    const int failed = font_compile(&source, ranges, range_count, &bytes, &size_bytes, &report, &error) != 0 ||
                       font_write(bytes, size_bytes, out, name, &error) != 0;
    const size_t unencoded = source.unencoded;
    font_source_free(&source);
    free(bytes);
    if (failed) { return command_fail("%s", error.text); }
    (void)printf("%s: glyphs %zu, %zu bytes\n", out, report.glyphs, report.size_bytes);
    if (report.absent) { (void)printf("code points of --range that the font has not: %zu\n", report.absent); }
    if (unencoded) { (void)printf("glyphs without a code point, left out: %zu\n", unencoded); }
    return command_finish();
}

int command_font(int count, char **arguments) {
    const char *in = NULL, *out = NULL, *name = NULL, *argument;
    font_range_t ranges[FONT_RANGES_MAX];
    size_t range_count = 0;
    options_t options;
    sim_error_t error = {""};

    options_open(&options, count, arguments);
    while ((argument = options_next(&options)) != NULL) {
        if (!options.name) {
            if (in) { return command_fail("font: one font at a time, but got %s and %s", in, argument), EXIT_USAGE; }
            in = argument;
        } else if (strcmp(argument, "-o") == 0) {
            out = options_value(&options);
        } else if (strcmp(argument, "--name") == 0) {
            name = options_value(&options);
        } else if (strcmp(argument, "--range") == 0) {
            const char *value = options_value(&options);
            if (value && font_ranges_parse(value, ranges, &range_count, &error) != 0) {
                return command_fail("%s", error.text), EXIT_USAGE;
            }
        } else if (strcmp(argument, "--help") == 0) {
            (void)fputs(usage, stdout);
            return command_finish();
        } else {
            options_unknown(&options);
        }
    }
    if (options.failed) { return EXIT_USAGE; }
    if (!in || !out) {
        (void)fputs(usage, stderr);
        return EXIT_USAGE;
    }
    return compile(in, out, name, ranges, range_count);
}
