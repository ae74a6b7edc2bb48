/* Small textured triangles of a list in assembly: fill/textured_thumb.c and fill/textured_thumb1.c. Their C twin is smalls_draw of
 * visibility/rows.h. */
#ifndef TUILE_FILL_TEXTURED_THUMB_H
#define TUILE_FILL_TEXTURED_THUMB_H

#include "../frame/frame.h"
#include "small.h"

/* Of a level: as in textured_level_t. */
typedef struct textured_run_level {
    uint32_t upper, lower, always, up, down, t_unit, s_unit, from_corner;
    uint32_t mask; /* textured_map_t: mask, with shift in its lowest 8 bits, which are 0 there */
    const void *texels;
} textured_run_level_t;

enum { TEXTURED_RUN_LEVELS = TEXTURED_FRACTION }; /* no more take the fast way: their larger side is 2^8 ... 2 */

/* What the loop reads, and where it has come to. The assembly copies all but the place, and what is behind it, to its stack. */
typedef struct textured_run {
    uint32_t mask; /* of the current level: textured_map_t: mask, with shift in its lowest 8 bits, which are 0 there */
    const void *texels;
    ptrdiff_t colour; /* from a pixel's depth to its colour, bytes, less 2 */
    uint32_t round;   /* TEXTURED_RUN_ROUND */
    const uint16_t *palette;
    uint32_t limit; /* the loop ends at the record of this number, or at the end of the list */
    const uint8_t *arena_end;
    uint32_t record_bytes;
    uint32_t source; /* as t->textured_source: that of the faces; out too */
    uint32_t known;  /* not 0: they are short and inside the tile's columns */
    const vertex_t *vertices;
    const uint8_t *texcoords; /* of slot 0 */
    int32_t top;              /* 16 * the tile's first row + 8 */
    int32_t height;           /* rows */
    uint16_t *depth;          /* of the pixel in the tile's first row and in column 0 of the window */
    int32_t stride;           /* bytes */
    uint32_t across;          /* textured_material_t: its own, less 4 */
    uint32_t one;             /* its own, more 4 */
    uint32_t log2_one;        /* uv_bits */
    uint32_t pixels_up;
    uint32_t upper, lower, always, up, down, t_unit, s_unit, from_corner; /* textured_run_level_t: of the current level */
    int32_t s_inside;
    uint32_t instance;              /* of the source */
    const uint8_t *model_texcoords; /* those of a source: 4 * (first_vertex - its slot) bytes behind */
    int32_t left, width;            /* small_tile_t */
    small_place_t place;
    textured_run_level_t levels[TEXTURED_RUN_LEVELS + 1]; /* from number `first_level` on, one behind the last wanted at most; such
                                                           * as are not made have lower 31, always 0; upper ends at 31 */
    uint32_t first_level;
    uint16_t *right;   /* where the number of the next face handed to the next column is put; NULL: there is none */
    uint32_t is_short; /* not 0: all faces are known to be short */
} textured_run_t;

/* What rounds red, blue and, by its low half, green. The pixels of a row are counted in the bits from 22 on, less 1. */
#define TEXTURED_RUN_ROUND (0x10020u - (1u << 22))

/* Draws faces from run->place.list on with light at the corners, until it meets one that it leaves to the caller: behind the limit,
 * no triangle, of another source, or a level that is none of those at hand, not short, or one that textured_map_make looks at
 * twice. Another source of the same instance and material, without colours and attributes, goes. What
 * reaches beyond the tile is handed on as columns_hand_on of visibility/columns.h does. Thumb-2: any face that covers no centre of
 * the tile goes, which counts as drawn. */
void textured_thumb(textured_run_t *run);

#endif
