/* Lists of random small and large triangles in random tiles, for the loops over small triangles: what tests of theirs share. */
#ifndef TESTS_EMULATORS_TWINS_FACES_H
#define TESTS_EMULATORS_TWINS_FACES_H

#include "../../raster/visibility/rows.h"
#include "../support/random.h"

enum {
    FACES = 12,
    SIDE = 48,         /* the largest tile */
    AROUND = 3 * SIDE, /* pixels before and behind it, which must stay as they are */
    PIXELS = SIDE * SIDE + 2 * AROUND,
};

typedef struct faces_pixels {
    uint16_t depth[PIXELS], colour[PIXELS];
} faces_pixels_t;

extern vertex_t faces_vertices[3 * FACES];

/* The renderer; arena_end, record_bytes and vertices are the test's to set. */
extern tuile_t t;

/* What a case is drawn in; lists of columns.h are not asked for. */
void faces_random_tile(random_source_t *random, faces_pixels_t *pixels);

/* Makes face `number` of a list, next: that behind it. small: it is short, and inside the tile where there are no columns, in which
 * all are short (columns.h). One in polygon_one_in is no triangle. */
record_t *faces_random_record(random_source_t *random, uint32_t number, uint16_t next, bool small, int polygon_one_in);

void faces_random_pixels(random_source_t *random, faces_pixels_t *pixels);

bool faces_short(const vertex_t *v);

/* It touches no column beside the tile. */
bool faces_inside(const vertex_t *v);

/* There is a column to the right of the tile. */
bool faces_further(void);

/* Faces of lists in columns that are handed on: to the right, below, and those of the former that reach below, too. */
typedef struct faces_on {
    uint32_t right, below, both;
} faces_on_t;

/* Counts a face, by its corners. */
void faces_count_on(faces_on_t *on, const vertex_t *v);

#endif
