/* Cameras by what people think in: round a point, on a node, as far away as a thing needs. tuile.h has tuile_camera_look_at. */
#ifndef TUILE_SCENE_CAMERA_H
#define TUILE_SCENE_CAMERA_H

#include "../tuile.h"
#include "sphere.h"

/* Sets rotation and eye: `distance` from the target, looking at it. yaw 0 and pitch 0: from +z; yaw goes round by way of +x (a
 * quarter turn: from +x), pitch upwards (a quarter turn: from +y, and on over the pole upside down), roll turns the camera
 * counter-clockwise about its view. Rotation within 16 * 2^-30. TUILE_ERROR_CAMERA for a distance of 0 or less, TUILE_ERROR_RANGE
 * where the eye does not fit the numbers. */
int tuile_camera_orbit(tuile_camera_t *camera, const q16_16_t target[3], q16_16_t distance, bam16_t yaw, bam16_t pitch,
                       bam16_t roll);

/* Sets rotation and eye to those of a pose in the world, such as tuile_node_t.world: it looks along the pose's -z, +y is up.
 * TUILE_ERROR_CAMERA when the rotation's rows are no unit vectors. */
int tuile_camera_attach(tuile_camera_t *camera, const tuile_pose_t *world);

/* Moves the eye along the view so that the sphere just fits into a window of so many pixels, its centre at the principal point, and
 * sets near and far to hold it. Perspective: focal_x and focal_y stay. Orthographic: they are multiplied so that it fits; they tell
 * the shape of a pixel only. TUILE_ERROR_CAMERA for a radius or a focal length of 0 or less, a principal point outside the window,
 * or a rotation whose rows are no unit vectors; TUILE_ERROR_RANGE where something does not fit the numbers. */
int tuile_camera_fit(tuile_camera_t *camera, const tuile_sphere_t *sphere, uint16_t width, uint16_t height);

#endif
