/* Small triangles of a list in assembly: fill/small_thumb.c. Their C twin is smalls_draw of visibility/rows.h. */
#ifndef TUILE_FILL_SMALL_THUMB_H
#define TUILE_FILL_SMALL_THUMB_H

#include "../frame/frame.h"
#include "small.h"

enum { SMALL_RUN_SHORT = 256 }; /* no material */

/* What the loop reads, and where it has come to. */
typedef struct small_run {
    uint32_t limit; /* the loop ends at the record of this number, or at the end of the list */
    const uint8_t *arena_end;
    const vertex_t *vertices;
    int32_t known;         /* the material, where there is a ramp and faces are known to be short and inside the tile's columns;
                            * SMALL_RUN_SHORT more, where there is one and they are known to be short; else -1 */
    int32_t top;           /* 16 * the tile's first row + 8 */
    int32_t height;        /* rows */
    uint16_t *depth;       /* of the pixel in the tile's first row and in column 0 of the window */
    int32_t stride;        /* bytes */
    uint32_t record_bytes; /* with light: not read, those of record_t */
    const uint16_t *ramp;  /* by the light of pixels, or flat of records; flat: NULL: `given` is the colour */
    ptrdiff_t colour;      /* from a pixel's depth to its colour, bytes */
    int32_t material;      /* of the ramp */
    int32_t left, width;   /* small_tile_t */
    uint32_t given;
    small_place_t place;
    uint16_t *right; /* where the number of the next face handed to the next column is put; NULL: there is none */
} small_run_t;

/* Draws faces from run->place.list on, with light at the corners or flat, until it meets one that it leaves to the caller: behind
 * the limit, no triangle, of another material, whose colour in the ramp is 0, or not short. Hands on what reaches beyond the tile
 * as columns_hand_on of visibility/columns.h does. */
void small_thumb_gouraud(small_run_t *run);
void small_thumb_flat(small_run_t *run);

#endif
