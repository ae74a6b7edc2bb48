/* Fonts: BDF text read and checked, then compiled for flash (raster/overlay/font.h has the layout). */
#ifndef SIM_FONT_H
#define SIM_FONT_H

#include "error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FONT_FILE_MAX ((size_t)64 << 20) /* bytes of a BDF file */
#define FONT_RANGES_MAX 64

/* A glyph as the file has it: rows of whole bytes, the leftmost dot in bit 7. */
typedef struct font_source_glyph {
    uint32_t code;
    unsigned line;     /* where it begins in the file */
    int advance;       /* 0 ... 255 */
    int left, below;   /* from the pen and the base line to the lower left corner of the box, up and right */
    int width, height; /* of the box, 0 ... FONT_BOX_MAX */
    uint8_t *rows;     /* NULL for an empty box */
} font_source_glyph_t;

typedef struct font_source {
    font_source_glyph_t *glyphs; /* in the order of their code points */
    size_t count;
    size_t unencoded; /* glyphs that the file gives no code point, which are left out */
    int ascent, descent;
    int advance; /* of the file's default character, else of its bounding box */
} font_source_t;

/* First and last code point. */
typedef struct font_range {
    uint32_t first, last;
} font_range_t;

typedef struct font_report {
    size_t glyphs, size_bytes;
    size_t absent; /* code points of the ranges that the source has not */
} font_report_t;

/* Reads BDF text. name stands in messages, as NAME:LINE. 0, or -1 and one line in error. */
int font_bdf_parse(font_source_t *source, const char *text, size_t size_bytes, const char *name, sim_error_t *error);
void font_source_free(font_source_t *source);

/* Compiles the glyphs of the ranges, or all when range_count is 0. Ranges of one code point must be there, of longer ones what is
 * there is taken. *bytes is from malloc. report may be NULL. 0, or -1 and one line in error. */
int font_compile(const font_source_t *source, const font_range_t *ranges, size_t range_count, uint8_t **bytes, size_t *size_bytes,
                 font_report_t *report, sim_error_t *error);

/* "32-126,0xb0,0x20AC-0x20AC": at most FONT_RANGES_MAX. 0, or -1 and one line in error. */
int font_ranges_parse(const char *text, font_range_t ranges[FONT_RANGES_MAX], size_t *count, sim_error_t *error);

/* Writes a compiled font by the end of the name: .c, with an object called `name` (NULL: from the file's name), or .tuilefont. */
int font_write(const uint8_t *bytes, size_t size_bytes, const char *path, const char *name, sim_error_t *error);

/* Reads a BDF file. 0, or -1 and one line in error. */
int font_read_source(font_source_t *source, const char *path, sim_error_t *error);

/* A font ready to be opened: a .tuilefont file or a .bdf file, which is compiled whole; path NULL: the project's own,
 * sim/fonts/tuile-6x10.bdf, which is part of the program. *bytes is from malloc. */
int font_load(const char *path, uint8_t **bytes, size_t *size_bytes, sim_error_t *error);

/* The text of the project's own font. */
extern const char font_default_text[];
extern const char font_default_end[];

#endif
