/* Clipping of the few faces that need it: near plane, far plane, guard band. */
#ifndef TUILE_GEOMETRY_CLIP_H
#define TUILE_GEOMETRY_CLIP_H

#include "vertex.h"

/* A face as the clipper sees it: corner i has position positions[corners[i]] and window vertex vertices[corners[i]]. */
typedef struct clip_face {
    const int16_t *positions; /* 3 x int16 each */
    const int8_t *fractions;  /* 3 x int8 each, in 1/256; NULL: none */
    const vertex_t *vertices;
    const uint8_t *corners;
    unsigned count;
} clip_face_t;

/* Writes the clipped polygon to out[0 ...] and returns its number of vertices: 0 when nothing is left (fewer than three),
 * -1 when there were more than capacity. A face that is not convex may come out with bridges along the clip planes that enclose no
 * area: even-odd filling ignores them. */
int clip_polygon(const transform_t *transform, const clip_face_t *face, vertex_t *out, unsigned capacity);

#endif
