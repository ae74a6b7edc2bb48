/* The vertices of most clusters, in assembly: vertex_thumb.c, vertex_thumb1.c. */
#ifndef TUILE_GEOMETRY_VERTEX_THUMB_H
#define TUILE_GEOMETRY_VERTEX_THUMB_H

#include "vertex.h"

/* What all W with the same number of leading zeros share, where they are fast and strictly inside far plane: first <= W < first +
 * range. Neighbours mostly have it in common. */
typedef struct vertex_octave {
    uint32_t first, range;
    unsigned zeros, shift, depth_shift;
    int32_t half;
    bool second; /* some W lie in the octave below: vertex_thumb1.c alone */
} vertex_octave_t;

/* transform->run, of what the vertices of all clusters share; all else of the transform is there. ASSEMBLY_VERTICES only. */
void vertex_thumb_make(transform_t *transform);

/* vertex_stage_region for count >= 1 vertices of a cluster that is in `octave`, in perspective, with no light but a one-sided one.
 * Writes transform->run alone. ASSEMBLY_VERTICES only. */
unsigned vertex_thumb(transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out,
                      const vertex_octave_t *octave);

#endif
