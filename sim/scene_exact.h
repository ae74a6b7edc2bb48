/* What can only be decided on the numbers as typed: is a polygon flat, has it an area? */
#ifndef SIM_SCENE_EXACT_H
#define SIM_SCENE_EXACT_H

#include "scene_text.h"

typedef enum scene_polygon {
    SCENE_POLYGON_GOOD,
    SCENE_POLYGON_FEW,  /* fewer than three distinct vertices */
    SCENE_POLYGON_LINE, /* all on one line */
    SCENE_POLYGON_BENT, /* vertex *off is not in the plane of the vertices plane[0 ... 2] */
} scene_polygon_t;

/* Exact, whatever the numbers are. count >= 3. */
scene_polygon_t scene_polygon_check(const scene_number_t (*vertices)[3], size_t count, size_t plane[3], size_t *off);

#endif
