/* Dropping whole clusters before any of their vertices is touched. */
#ifndef TUILE_GEOMETRY_CULL_H
#define TUILE_GEOMETRY_CULL_H

#include "transform.h"

/* The cluster's bounding sphere lies outside near plane, far plane or a side of the region. Never true for a cluster with a
 * vertex inside; may be false for one that misses the region round a corner. cluster: geometry/model.h. */
bool cull_outside(const transform_t *transform, const uint8_t *cluster);

/* The same of the bounding sphere of the whole model. Sets transform->crossed, which cull_outside goes by: it is to be called
 * first. */
bool cull_model_outside(transform_t *transform, const tuile_model_t *model);

/* The same before there is a transform, which takes thirty times as long to make; a sphere that misses the region by less than an
 * eighth of its radius may be kept. camera: in samples. Pose and camera have passed transform_check. */
bool cull_instance_outside(const tuile_camera_t *camera, const tuile_instance_t *instance, const transform_region_t *region);

/* Every face of the cluster faces away from the eye, whichever point of it is looked at. */
bool cull_faces_away(const transform_t *transform, const uint8_t *cluster);

#endif
