/* A text scene drawn in whole pixels: outlines by Bresenham's lines, or triangles by Bresenham edges (raster/draw/). A study of the
 * documents' ways beside the renderer's own fill: no depth, later polygons over earlier ones. */
#ifndef SIM_SCENE_DRAW_H
#define SIM_SCENE_DRAW_H

#include "../raster/draw/edge_table.h"
#include "scene_text.h"

typedef enum scene_drawing_kind { SCENE_DRAW_FILL, SCENE_DRAW_LINES, SCENE_DRAW_TRIANGLES } scene_drawing_kind_t;

typedef struct scene_drawing {
    scene_drawing_kind_t kind;        /* SCENE_DRAW_FILL is the renderer's, not drawn here */
    edge_policy_t policy;             /* SCENE_DRAW_TRIANGLES */
    uint16_t tile_width, tile_height; /* 0 = the whole window; the picture does not depend on it */
} scene_drawing_t;

/* Draws the polygons in the order of the file into ids, width * height, row by row: 1 + the index of the one drawn last, 0 where
 * none is. mesh, quantisation and view: as made of the scene. Each corner is taken to the sample point nearest to its place in the
 * window, halves right and down, exactly on the numbers that the camera has. Perspective: lines and triangles end at the near
 * plane. SCENE_DRAW_LINES draws each side as it stands in the polygon, SCENE_DRAW_TRIANGLES cuts polygons into triangles first.
 * Returns 0, or -1 and error: a polygon that crosses itself, of which there are no triangles; one that comes to lie beyond
 * LINE_RANGE; out of memory. */
int scene_draw(const scene_text_t *scene, const mesh_t *mesh, const scene_quantisation_t *quantisation, const scene_view_t *view,
               const scene_drawing_t *drawing, uint32_t *ids, sim_error_t *error);

#endif
