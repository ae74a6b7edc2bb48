/* Pieces of faces. A face that crosses another one is not cut into new polygons: its corners are on the grid of 1/16 pixel, those
 * of the parts would not be, and parts that are snapped leave cracks. A piece is the face itself, with its own coverage, and a list
 * of cuts; each keeps the pixels where the face is seen before another one, or the pixels where it is not, by the very comparison
 * that a z-buffer makes there. So two pieces share no pixel and leave none out, whatever the arithmetic rounds.
 *
 * For the tests of the painter's algorithm a piece also has a ring of corners: the face's ring clipped along the line where the two
 * planes cross, a little beyond it. Its corners are rounded to the grid too, so the piece lies within one unit (1/16 pixel) of the
 * ring's hull: what is decided by rings allows for that.
 */
#ifndef TUILE_VISIBILITY_PIECE_H
#define TUILE_VISIBILITY_PIECE_H

#include "../frame/frame.h"

/* The corners of a whole face, triangle or not. list: room for those of a triangle. */
polygon_ring_t piece_ring(const tuile_t *t, const record_t *face, uint8_t list[3]);

/* Face a against face b, as a z-buffer decides it, pixel by pixel. */
typedef struct duel {
    depth_plane_t a, b;
    int64_t z, dx, dy; /* a less b, as depth_plane_t, regardless of the ranges of depth that polygons are held in */
    int64_t band;      /* where they differ by this or more, the difference decides; INT64_MAX: it never does */
    bool wins_tie;     /* a is seen where both are equally deep */
} duel_t;

/* Neither is a piece. False when one of them has no area. */
bool duel_open(duel_t *duel, const tuile_t *t, const record_t *a, const record_t *b, bool wins_tie);

/* Is a seen before b at pixel (x, y)? */
TUILE_INLINE bool duel_front(const duel_t *duel, int32_t x, int32_t y) {
    const int64_t difference = duel->z + duel->dx * x + duel->dy * y; /* < 2^47 */
    if (difference >= duel->band) { return true; }
    if (difference <= -duel->band) { return false; }
    const uint16_t a = depth_at(&duel->a, x, y), b = depth_at(&duel->b, x, y);
    return a > b || (a == b && duel->wins_tie);
}

#define PIECE_MASK_WORDS (TUILE_SAMPLES_MAX / 32)

/* Bit i: pixel (from + i, y) is in the piece, as far as bounds and cuts tell; 0 <= to - from <= TUILE_SAMPLES_MAX. The bits from
 * to - from on are 0. */
void piece_mask(const tuile_t *t, const record_t *record, int32_t y, int32_t from, int32_t to, uint32_t mask[PIECE_MASK_WORDS]);

TUILE_INLINE bool piece_mask_bit(const uint32_t *mask, int32_t i) { return mask[i >> 5] >> (i & 31) & 1u; }

/* Cuts record `number` in two: the piece behind `other` stays in its place, the one before it becomes record `added`, which must be
 * there. bounds: of the record. Slots are taken below `end`; FULL when there are not enough of them. */
int piece_cut(tuile_t *t, uint32_t number, uint32_t added, const face_bounds_t *bounds, const record_t *other, uint16_t own_number,
              bool wins_tie, const uint8_t *end);

/* The same along a line between pixels: columns (axis 0) or rows (axis 1) below `at`, and the others. */
int piece_cut_at(tuile_t *t, uint32_t number, uint32_t added, const face_bounds_t *bounds, int axis, int32_t at,
                 uint16_t own_number, const uint8_t *end);

#endif
