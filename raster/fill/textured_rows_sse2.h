/* Rows and pixels of visibility/smalls_sse2.c. */
#ifndef TUILE_FILL_TEXTURED_ROWS_SSE2_H
#define TUILE_FILL_TEXTURED_ROWS_SSE2_H

#include "../divide.h"
#include "textured.h"

/* Vectors of 16 bytes, whose sums are modulo 2^32 and 2^64. */
typedef int16_t __attribute__((vector_size(16))) sse2_words_t;
typedef uint32_t __attribute__((vector_size(16))) sse2_longs_t;
typedef uint64_t __attribute__((vector_size(16))) sse2_quads_t;

/* What a level decides. */
typedef struct textured_rows_level {
    textured_word_t mask;
    uint32_t shift;
    const void *texels;
} textured_rows_level_t;

/* What the loops over rows and pixels find in memory: what changes from row to row is in two vectors, which are stored for each row
 * since an instruction takes a number from memory at no cost. Others are only read; as the numbers of textured.h they lie where a
 * pixel's store might change them, for all that the compiler knows, so that registers are left for what changes from pixel to
 * pixel. */
typedef struct textured_rows {
    union {
        sse2_longs_t vector;
        struct {
            int32_t left, right; /* short_edge_t, in columns of the face */
            uint32_t map;        /* of the texture, in the column */
            uint32_t unused;     /* anything */
        } n;
    } edges;
    union {
        sse2_quads_t vector;
        struct {
            uint64_t shade; /* in the column */
            uint16_t *depth;
        } n;
    } place;
    sse2_longs_t edges_down; /* a row down */
    sse2_quads_t place_down;
    textured_numbers_t numbers;
    ptrdiff_t colour; /* from a pixel's depth to its colour, bytes */
    textured_rows_level_t level;
    const uint16_t *palette;
    ptrdiff_t first, end; /* the tile's columns, in columns of the face, where it touches others */
} textured_rows_t;

TUILE_INLINE uint16_t *textured_rows_at(uint16_t *pixels, ptrdiff_t bytes) { return (uint16_t *)(void *)((char *)pixels + bytes); }

/* A side in columns of the face, as small_side makes it; behind the last row it may wrap. */
typedef struct textured_side {
    int32_t x, slope;
} textured_side_t;

TUILE_INLINE textured_side_t textured_side(int32_t start, int64_t dx, int64_t dy, int32_t t) {
    const int32_t slope = divide_side((int32_t)dx, (int32_t)dy);
    return (textured_side_t){start + ((t * slope) >> 4), slope};
}

/* Where the face's rows are, counted from the tile's first one, and what is needed for the side below the corner between. */
typedef struct textured_bend {
    int64_t mid_x, mid_y, low_x, low_y; /* from the first corner, 1/16 pixel */
    int32_t start;                      /* of the sides from the first corner: small_start */
    int32_t top;                        /* of the first corner, from the centres of the tile's first row, 1/16 pixel */
    int32_t row, until, end;            /* the row to be filled; where its sides end, and what is in the tile */
    bool left;                          /* the corner between is on the left side */
} textured_bend_t;

TUILE_INLINE textured_side_t textured_side_below(const textured_bend_t *b, int32_t row) {
    return textured_side(b->start + (int32_t)b->mid_x * (INT32_C(1) << 16), b->low_x - b->mid_x, b->low_y - b->mid_y,
                         16 * row - b->top - (int32_t)b->mid_y);
}

/* The rows from bend->row < bend->until to its end. dx, map_dx: per pixel. clamp: the face touches columns beside the tile. */
TUILE_INLINE void textured_rows_fill(textured_rows_t *rows, const textured_bend_t *bend, uint64_t dx, uint32_t map_dx,
                                     bool paletted, bool clamp) {
    const uint32_t shift = rows->level.shift;
    const void *const texels = rows->level.texels;
    const uint16_t *const palette = rows->palette;
    const textured_constants_t constants = {&rows->numbers};
    sse2_longs_t edges = rows->edges.vector;
    sse2_quads_t place = rows->place.vector;
    int32_t count = bend->until - bend->row, rest = bend->end - bend->until;
    for (;;) {
        do {
            rows->edges.vector = edges;
            __asm__("" : "+m"(rows->edges));
            ptrdiff_t from = rows->edges.n.left, to = rows->edges.n.right;
            TEXTURED_UNKNOWN(from); /* is widened once, by the load */
            TEXTURED_UNKNOWN(to);
            from >>= 20, to >>= 20;
            if (clamp) {
                from = from > rows->first ? from : rows->first;
                to = to < rows->end ? to : rows->end;
            }
            if (TUILE_LIKELY(from < to)) {
                rows->place.vector = place;
                __asm__("" : "+m"(rows->place));
                uint16_t *const depth = rows->place.n.depth + to, *again = depth, *colour = textured_rows_at(depth, rows->colour);
                TEXTURED_UNKNOWN(again); /* else one instruction more makes the address of both */
                TEXTURED_UNKNOWN(colour);
                uint64_t shade = rows->place.n.shade + dx * (uint64_t)from;
                uint32_t map = rows->edges.n.map + map_dx * (uint32_t)from;
                ptrdiff_t i = 2 * (from - to); /* bytes, up to 0 */
                do {
                    const uint16_t z = (uint16_t)(shade >> 48);
                    if (z > *textured_rows_at(depth, i)) {
                        const uint32_t index = textured_index(map, rows->level.mask, shift, &constants),
                                       texel = textured_texel(texels, palette, index, paletted);
                        *textured_rows_at(again, i) = z;
                        *textured_rows_at(colour, i) = textured_lit(texel, textured_levels_of((uint32_t)shade), &constants, true);
                    }
                    shade += dx;
                    map += map_dx;
                    i += 2;
                } while (i);
            }
            edges += rows->edges_down;
            place += rows->place_down;
        } while (--count);
        if (rest == 0) { return; }
        const textured_side_t below = textured_side_below(bend, bend->until);
        rows->edges.vector = edges;
        __asm__("" : "+m"(rows->edges));
        if (bend->left) {
            rows->edges.n.left = below.x;
            rows->edges_down[0] = (uint32_t)below.slope;
        } else {
            rows->edges.n.right = below.x;
            rows->edges_down[1] = (uint32_t)below.slope;
        }
        edges = rows->edges.vector;
        count = rest;
        rest = 0;
    }
}

#endif
