/* The input of `tuile coverage`: one polygon a line, as whole numbers in 1/16 pixel, x0 y0 x1 y1 x2 y2 ... */
#ifndef SIM_COVERAGE_TEXT_H
#define SIM_COVERAGE_TEXT_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "../raster/tuile.h"
#include "error.h"

#define COVERAGE_TEXT_COORDINATE_MAX (32767 * 16)

typedef struct coverage_text {
    FILE *file;             /* not owned */
    const char *name;       /* stands for the file in errors; not owned */
    unsigned long line;     /* of the polygon last read, 1-based */
    unsigned long polygon;  /* its number among the polygons, 0-based */
    q28_4_t (*points)[2];   /* its vertices x, y, each within +-COVERAGE_TEXT_COORDINATE_MAX; valid until the next call */
    size_t count;           /* >= 3 */
    size_t capacity;        /* of points */
    unsigned long polygons; /* read so far */
} coverage_text_t;

/* Starts reading at file's current position. */
void coverage_text_open(coverage_text_t *text, FILE *file, const char *name);

/* Reads the next polygon into text->points. Blank lines are skipped; a line may be of any length and end in CR LF. Returns 1, or 0
 * at the end of the file, or -1 and an error that names the line: a word that is no whole number, a coordinate out of range, an odd
 * count of numbers, fewer than three vertices, a read error, out of memory. Nothing may be read after -1. */
int coverage_text_next(coverage_text_t *text, sim_error_t *error);

/* Releases points; the file stays open. */
void coverage_text_close(coverage_text_t *text);

#endif
