/* Which of two faces is to be painted first: the tests of the painter's algorithm (S12; Newell, Newell and Sancha), in the window,
 * where depth is affine, on the very numbers that faces are drawn from.
 *
 * Tests on corners are exact: a plane through three corners on the grid, the depth of a fourth, times the area: below 2^58. They
 * are trusted where two faces are more than two steps apart, by which the depths that a z-buffer compares (rounded, 16 bits) cannot
 * change their order any more; they and the test of projections save time only. Where faces are nearer, or on both sides of one
 * another, the pixels that both cover decide. So a face is painted after another one exactly if it is seen there, and the picture
 * is the z-buffer's.
 */
#ifndef TUILE_VISIBILITY_PRIORITY_H
#define TUILE_VISIBILITY_PRIORITY_H

#include "piece.h"

#define PRIORITY_MARGIN 512u /* two steps, in 1/256 step */

/* A face or piece, ready to be compared. Not to be copied: the ring may lead into the struct. */
typedef struct priority_face {
    const record_t *record;
    record_t whole;      /* the record of the face that a piece is of */
    uint16_t number;     /* decides ties */
    bool is_piece;       /* its pixels lie within one unit of the ring's hull, not inside */
    bool empty;          /* has no area, as far as is known */
    polygon_ring_t ring; /* what is compared: of a piece its own */
    uint8_t list[3];
    int32_t x0, y0, z0;
    int64_t nx, ny, area; /* (z - z0) area = nx (x - x0) + ny (y - y0); area > 0, or 0: not made yet */
    int64_t slack;        /* by how much depths of its pixels may be off the plane, 1/256 step */
} priority_face_t;

void priority_open(priority_face_t *face, const tuile_t *t, uint32_t number);

/* The bounds of a record, cut to the pass. */
void priority_bounds(const tuile_t *t, const record_t *record, face_bounds_t *bounds);

TUILE_INLINE bool priority_boxes_meet(const face_bounds_t *a, const face_bounds_t *b) {
    return a->left < b->right && b->left < a->right && a->top < b->bottom && b->top < a->bottom;
}

typedef enum priority {
    PRIORITY_FREE,   /* p hides nothing of q: it may be painted before it */
    PRIORITY_AFTER,  /* p hides something of q, and q nothing of p */
    PRIORITY_CROSSED /* each hides something of the other */
} priority_t;

/* p's boxes meet q's. */
priority_t priority_compare(const tuile_t *t, priority_face_t *p, const face_bounds_t *p_bounds, priority_face_t *q,
                            const face_bounds_t *q_bounds);

/* Corners of `face` lie on both sides of the plane, and `face` was not cut by it. */
bool priority_straddles(const tuile_t *t, priority_face_t *face, priority_face_t *plane);

/* Of two equally deep faces p is seen. */
TUILE_INLINE bool priority_wins_tie(const tuile_t *t, uint32_t p, uint32_t q) {
    return t->config.tie == TUILE_TIE_LAST ? p > q : p < q;
}

#endif
