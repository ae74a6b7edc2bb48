/* Rotation matrices of entries in Q2.30, multiplied and checked. */
#ifndef TUILE_SCENE_ROTATION_H
#define TUILE_SCENE_ROTATION_H

#include "../tuile.h"

/* Entries may leave -1 ... 1 by so much: nine bits less than would let three products overflow 64 bits. */
#define ROTATION_ENTRY_MAX (TUILE_ONE_Q30 + (INT32_C(1) << 20))

/* Rows of unit length, to 2^-15: matrices that were never filled in, or have a scale, do not pass. */
bool rotation_is_unit(const q2_30_t rotation[3][3]);

/* out = a * b, each entry rounded by half a unit at most. False where an entry leaves ROTATION_ENTRY_MAX, which products of
 * rotations do not. Entries of a and b: within ROTATION_ENTRY_MAX. out may be neither of them. */
bool rotation_multiply(q2_30_t out[3][3], const q2_30_t a[3][3], const q2_30_t b[3][3]);

#endif
