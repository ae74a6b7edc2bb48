/* Fog over a face: the last of its stages. */
#ifndef TUILE_SURFACE_FOG_STAGE_H
#define TUILE_SURFACE_FOG_STAGE_H

#include "surface.h"

/* Sets surface->fog and surface->depth: the depth of the corners, exact but for 2^-16 step a pixel, held to what all corners
 * span. */
void fog_open(surface_t *surface, const surface_face_t *face);

void fog_stage(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb);

#endif
