/* Where the bounding sphere of a model stands in the world. */
#ifndef TUILE_SCENE_SPHERE_H
#define TUILE_SCENE_SPHERE_H

#include "../geometry/wide.h"
#include "../tuile.h"

typedef struct tuile_sphere {
    q16_16_t centre[3], radius; /* radius is rounded up and holds the rounding of the centre */
} tuile_sphere_t;

/* TUILE_OK, or TUILE_ERROR_RANGE when it does not fit the numbers; scale > 0. */
int tuile_sphere(tuile_sphere_t *sphere, const tuile_model_t *model, const tuile_pose_t *pose);

/* The same with all bits. */
void sphere_wide(wide_t centre[3], wide_t *radius, const tuile_model_t *model, const tuile_pose_t *pose);

#endif
