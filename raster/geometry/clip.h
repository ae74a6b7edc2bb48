/* Clipping of the few faces that need it: near plane, far plane, guard band. */
#ifndef TUILE_GEOMETRY_CLIP_H
#define TUILE_GEOMETRY_CLIP_H

#include "vertex.h"

/* What else a corner has: a vertex that clipping made gets what is in between. */
typedef struct clip_attributes {
    int32_t s, t;      /* texture coordinates, 1/256 of the model's unit */
    uint8_t light[4];  /* red, green, blue, highlight */
    uint8_t colour[4]; /* red, green, blue, alpha */
} clip_attributes_t;

/* A face as the clipper sees it: corner i has position positions[corners[i]] and window vertex vertices[corners[i]]; and so for its
 * attributes, where they are wanted. */
typedef struct clip_face {
    const int16_t *positions; /* 3 x int16 each */
    const int8_t *fractions;  /* 3 x int8 each, in 1/256; NULL: none */
    const vertex_t *vertices;
    const uint8_t *corners;
    unsigned count;
    clip_attributes_t *attributes; /* where those of out[] go, `capacity` of them; NULL: none are wanted */
    const uint8_t *texcoords;      /* 2 x int16 each; NULL: 0 */
    const uint8_t *lights;         /* 4 bytes each; NULL: 0 */
    const uint8_t *colours;        /* 4 bytes each; NULL: 255 */
} clip_face_t;

/* Writes the clipped polygon to out[0 ...] and returns its number of vertices: 0 when nothing is left (fewer than three),
 * -1 when there were more than capacity. A face that is not convex may come out with bridges along the clip planes that enclose no
 * area: even-odd filling ignores them. */
int clip_polygon(const transform_t *transform, const clip_face_t *face, vertex_t *out, unsigned capacity);

#endif
