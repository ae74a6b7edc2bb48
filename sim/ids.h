/* A whole frame of TUILE_FACE_IDS, put together from its tiles. */
#ifndef SIM_IDS_H
#define SIM_IDS_H

#include "../raster/tuile.h"

/* Draws one frame into ids, width * height of the renderer's configuration, row by row. 0 or a tuile_error_t. */
int ids_draw(tuile_t *renderer, const tuile_scene_t *scene, uint32_t *ids);

#endif
