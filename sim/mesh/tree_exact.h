/* Planes and points of the display tree's compiler, without rounding.
 *
 * All points are ORIGINAL ones (whole steps, |coordinate| < 2^15), an original edge cut by a plane, or where three planes meet; and
 * all planes are support planes of original faces. So nothing is ever computed from a computed point, and sizes stay bounded:
 *
 *     plane    |n[k]| < 2^33 (a cross product of differences < 2^16), |d| = |n . p| <= 3 * 2^33 * 2^15 < 2^50
 *     point    (x, y, z) / w;  of three planes, w = det(n1, n2, n3) < 3 * 2^33 * 2^67 < 2^102, and x < 3 * 2^50 * 2^67 < 2^119
 *     side     n . x + d w < 2^155: 192 bits, as a product of 64 and 128 bits is summed in two halves
 *     order    x1 w2 against x2 w1: 256 bits
 *
 * Both questions are asked of doubles first. A coordinate divided out is wrong by less than 2^15 * 2^-51 = 2^-36 (x, w and the
 * quotient are rounded once each, 3 * 2^-53), and n . q + d in doubles is wrong by less than S * 2^-34 in all, S = |n0| + |n1| +
 * |n2|: the inputs give S * 2^-36, seven roundings of values <= 2 S * 2^15 give at most 7 * S * 2^-37. At whole points it is exact,
 * as every partial sum is an integer below 2^53. Beyond its error a double tells the sign; else the integers do.
 */
#ifndef SIM_MESH_TREE_EXACT_H
#define SIM_MESH_TREE_EXACT_H

#include "stages.h"

__extension__ typedef unsigned __int128 mesh_uint128_t;

/* n . q + d = 0. No common divisor of n; the first component that is not 0 is positive: equal planes are equal bits. */
typedef struct exact_plane {
    int64_t n[3], d;
    double f[3], e, doubt; /* the same for the filter, and its error at points that are not whole */
    int16_t through[3];    /* one of its points */
} exact_plane_t;

/* x / w, reduced, w > 0: equal points are equal bits. */
typedef struct exact_point {
    mesh_int128_t x[3], w;
    double at[3];
    double doubt; /* 0 for whole points, else 1 */
} exact_point_t;

/* The plane through a whole point. normal: any multiple of its normal with components below 2^62, not 0. True when the plane's
 * own normal is the opposite one. */
bool exact_plane_make(exact_plane_t *plane, const int64_t normal[3], const int16_t through[3]);

void exact_point_whole(exact_point_t *point, const int16_t at[3]);
/* a and b must lie strictly on opposite sides. */
void exact_point_on_edge(exact_point_t *point, const int16_t a[3], const int16_t b[3], const exact_plane_t *plane);
/* The normals must not be dependent. */
void exact_point_of_planes(exact_point_t *point, const exact_plane_t *p, const exact_plane_t *q, const exact_plane_t *r);

/* The sign of n . q + d: -1, 0, 1. */
int exact_side(const exact_plane_t *plane, const exact_point_t *point);
int exact_side_unfiltered(const exact_plane_t *plane, const exact_point_t *point);

/* The sign of a - b on one axis. */
int exact_order(const exact_point_t *a, const exact_point_t *b, int axis);
int exact_order_unfiltered(const exact_point_t *a, const exact_point_t *b, int axis);

/* Whether two points are one; and a number that equal points share. */
bool exact_same(const exact_point_t *a, const exact_point_t *b);
uint64_t exact_hash(const exact_point_t *point);

/* The direction in which two planes meet, components < 2^67. */
void exact_cross(const int64_t a[3], const int64_t b[3], mesh_int128_t cross[3]);

/* To the nearest 1/256, halves up, times 256. */
void exact_round(const exact_point_t *point, int32_t at[3]);

#endif
