/* The triangles of a compiled model where they stand in the window, in real numbers: by the definitions in tuile.h, without the
 * snap of the vertices and without any rounding but long double's. */
#ifndef TESTS_REFERENCE_EXACT_FACE_H
#define TESTS_REFERENCE_EXACT_FACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../../raster/tuile.h"

/* A corner: the model's own numbers, and where they come to stand. */
typedef struct exact_corner {
    int16_t position[3];
    long double x, y, w, depth; /* pixels; distance along the view axis; depth in steps */
    long double snapped_x, snapped_y;
    long double over[2]; /* x * w and y * w, wherever the corner is */
    long double s, t;    /* texels of level 0 */
} exact_corner_t;

typedef struct exact_face {
    exact_corner_t corner[3];
    unsigned material;
    bool in_front; /* all of it is in front of the eye; else x, y and depth of some corner say nothing */
} exact_face_t;

/* What a face has at a point of the window. */
typedef struct exact_point {
    bool inside;        /* the point is in the face */
    long double border; /* distance from the face's border, pixels, inside and outside */
    long double depth;  /* steps */
    long double s, t;   /* texels */
} exact_point_t;

/* All faces of the only instance, in the model's order; to be released with free. Every face is a triangle, else the test fails. */
exact_face_t *exact_faces(const tuile_scene_t *scene);

/* At the centre of pixel (x, y). snapped: through the corners as the renderer has them, to 1/16 pixel. */
exact_point_t exact_at(const exact_face_t *face, uint32_t x, uint32_t y, bool snapped);

/* At any point of the window, of a face that may reach behind the eye: s, t and depth of what is seen there of its plane. False
 * where that is behind the eye. Perspective. */
bool exact_plane_at(const exact_face_t *face, long double x, long double y, exact_point_t *point);

/* Is the front of it seen? Not so for faces edge-on. */
bool exact_front(const exact_face_t *face);

/* The matrix from positions to clip coordinates with which x / w and y / w are -1 ... 1 over the window, y upwards. */
void exact_clip_matrix(const tuile_scene_t *scene, uint32_t width, uint32_t height, double clip[4][4]);

#endif
