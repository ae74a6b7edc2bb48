/* Which of many boxes may meet a given one, 32 of them at a time: the window is divided into 16 bands of rows and 16 of columns,
 * and each band has a bit for each box that reaches into it. Boxes are known by their places in a list.
 */
#ifndef TUILE_VISIBILITY_BANDS_H
#define TUILE_VISIBILITY_BANDS_H

#include "../frame/frame.h"

#define BANDS_EACH_WAY 16

typedef struct bands {
    uint32_t (*words)[2 * BANDS_EACH_WAY]; /* of 32 places: rows, columns */
    uint32_t count;                        /* words that there is room for */
    int32_t left, top;
    uint8_t shift_x, shift_y; /* a band has 2^shift columns or rows */
} bands_t;

/* Over memory that is there. No box is set; all will lie in this one. */
void bands_open(bands_t *bands, void *memory, uint32_t places, const face_bounds_t *all);

TUILE_INLINE size_t bands_bytes(uint32_t places) { return (size_t)(places + 31) / 32 * (2 * BANDS_EACH_WAY * sizeof(uint32_t)); }

/* Sets or clears a box. */
void bands_set(const bands_t *bands, uint32_t place, const face_bounds_t *box, bool set);

/* Places behind `at` move up by one; the one behind it gets what `at` has. count: places so far; there must be room for one more.
 */
void bands_insert(const bands_t *bands, uint32_t at, uint32_t count);

/* Of the 32 places from 32 * word on: those whose boxes share a band with this one in both ways. */
TUILE_INLINE uint32_t bands_near(const bands_t *bands, uint32_t word, const face_bounds_t *box) {
    const uint32_t *bits = bands->words[word];
    const int32_t row_last = (box->bottom - 1 - bands->top) >> bands->shift_y,
                  column_last = BANDS_EACH_WAY + ((box->right - 1 - bands->left) >> bands->shift_x);
    uint32_t rows = 0, columns = 0;
    for (int32_t row = (box->top - bands->top) >> bands->shift_y; row <= row_last; row++) {
        rows |= bits[row];
    }
    for (int32_t column = BANDS_EACH_WAY + ((box->left - bands->left) >> bands->shift_x); column <= column_last; column++) {
        columns |= bits[column];
    }
    return rows & columns;
}

#endif
