/* What the display tree's compiler works on: the faces of a solid as pieces that planes cut, exactly.
 *
 * A piece is a polygon of any shape, even-odd, in the plane of its face. Each of its sides lies on a line: an edge of the solid, or
 * the cut of its face by a plane. Every point made on a line is noted there, so that in the end all pieces along that line can be
 * given all of its points: then rounding moves them together and no crack opens.
 */
#ifndef SIM_MESH_TREE_SPACE_H
#define SIM_MESH_TREE_SPACE_H

#include "tree_exact.h"

#define SPACE_NONE UINT32_MAX

/* A set of numbers, found by hash and a question. */
typedef struct space_table {
    struct space_slot {
        uint32_t item, hash;
    } * slots;
    size_t capacity, count; /* capacity: 0 or a power of two */
} space_table_t;

/* How far rounding to the grid may have moved a plane, at a distance of r steps from `centre`: rounding * (2 + r * tilt). A face
 * whose corners each moved by `rounding` turns by 1 / height for each of its heights, which add up to its outline over twice its
 * area. */
typedef struct space_slack {
    double centre[3], tilt;
} space_slack_t;

typedef struct space_line {
    bool edge;
    uint32_t of[2];                /* points of an edge; planes of a cut: the face's and the cutting one */
    uint32_t marks;                /* list of the points made on it */
    uint32_t sorted, sorted_count; /* once sorted: where they stand in space_t.sorted */
} space_line_t;

typedef struct space_mark {
    uint32_t point, next;
} space_mark_t;

/* What varies over a face: its normal in 1/127, texture coordinates and colour as solid_vertex_t has them. */
enum { SPACE_NORMAL = 0, SPACE_TEXCOORD = 3, SPACE_COLOUR = 5, SPACE_VARYING = 9 };

typedef struct space_corner {
    uint32_t point, line; /* the line of the side that begins here */
    float varying[SPACE_VARYING];
} space_corner_t;

typedef struct space_face {
    uint32_t plane, material, source;
    bool turned; /* its normal is the opposite of the plane's */
    bool even;   /* nothing varies over it */
} space_face_t;

typedef struct space_piece {
    uint32_t first, count, face; /* corners in space_t.corners */
} space_piece_t;

typedef struct space {
    exact_plane_t *planes;
    space_slack_t *slacks; /* of each plane; of the face with the least tilt in it */
    double rounding;       /* the largest distance of a corner from its place in the model, in steps; 0 when the grid is exact */
    exact_point_t *points; /* those of the solid by the number of their place, then those made */
    space_line_t *lines;
    space_mark_t *marks;
    space_corner_t *corners;
    space_face_t *faces;
    space_piece_t *pieces;
    size_t plane_count, point_count, line_count, mark_count, corner_count, face_count, piece_count;
    size_t plane_capacity, slack_capacity, point_capacity, line_capacity, mark_capacity, corner_capacity, face_capacity,
        piece_capacity;
    uint32_t *places; /* of each place: a vertex of the solid there */
    const solid_t *solid;
    space_table_t plane_table, point_table, edge_table;
    int8_t *signs; /* of the corners of the piece that is being cut */
    space_corner_t *halves[2];
    size_t sign_capacity, half_capacity[2];
    uint32_t *sorted;
    size_t sorted_count, sorted_capacity;
    size_t non_planar, splits;
    bool failed; /* out of memory, or more than 32 bits count: everything is void */
} space_t;

/* One piece for each face of the solid, in order; polygons that are not exactly flat in triangles. solid must outlive it. */
bool space_open(space_t *space, const solid_t *solid);
void space_close(space_t *space);

/* Cuts a piece that has corners strictly on both sides: parts[0] lies on the plus side. False when out of memory. */
bool space_cut(space_t *space, uint32_t piece, uint32_t plane, uint32_t parts[2]);

#define SPACE_SLACK_MAX 64.0 /* a sliver may tilt by any angle, but more than this is believed */

/* How far from the plane, in steps, a point may seem to lie and yet lie in it, for all that the grid tells. */
double space_slack(const space_t *space, uint32_t plane, const exact_point_t *point);

/* After the last cut: puts the points of each line in order. False without memory. */
bool space_sort_lines(space_t *space);

/* The points of a line strictly between two of its points, in the order in which a walk from the first to the second meets them:
 * their number, the first of them and the step to the next. After space_sort_lines. */
typedef struct space_run {
    const uint32_t *at;
    size_t count;
    int step;
    int axis;
} space_run_t;
space_run_t space_between(const space_t *space, uint32_t line, uint32_t from, uint32_t to);

#endif
