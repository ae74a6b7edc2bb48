/* Records as faces to be shaded, for those who shade by themselves. */
#ifndef TUILE_FRAME_SHADE_H
#define TUILE_FRAME_SHADE_H

#include "frame.h"

#include "../surface/surface.h"

/* The surface of a record's face, for samples of a kind; PIXEL_RGB888 for surface_run. */
void shade_surface(const tuile_t *t, const record_t *record, surface_t *surface, pixel_kind_t kind);

/* The bounding box of a record's face, within the tile. */
void shade_box(const tuile_t *t, const record_t *record, int32_t *left, int32_t *top, int32_t *right, int32_t *bottom);

/* The plane of its depth; false when it has no area. */
bool shade_depth(const tuile_t *t, const record_t *record, depth_plane_t *depth);

#endif
