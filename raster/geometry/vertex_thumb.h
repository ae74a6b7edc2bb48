/* The vertices of most clusters, in assembly: vertex_thumb.c. */
#ifndef TUILE_GEOMETRY_VERTEX_THUMB_H
#define TUILE_GEOMETRY_VERTEX_THUMB_H

#include "vertex.h"

/* What all W with the same number of leading zeros share, where they are fast and strictly inside far plane: first <= W < first +
 * range. Neighbours mostly have it in common. */
typedef struct vertex_octave {
    uint32_t first, range;
    unsigned zeros, shift, depth_shift;
    int32_t half;
} vertex_octave_t;

/* vertex_stage_region for count >= 1 vertices of a cluster that is in `octave`, in perspective, with no light but a one-sided one.
 * ASSEMBLY_THUMB only. */
unsigned vertex_thumb(const transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out,
                      const vertex_octave_t *octave);

#endif
