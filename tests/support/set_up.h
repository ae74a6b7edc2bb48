/* A scene of one instance, and where its positions come to stand by the definitions in tuile.h. */
#ifndef TESTS_SUPPORT_SET_UP_H
#define TESTS_SUPPORT_SET_UP_H

#include <stdbool.h>
#include <stdint.h>

#include "../../raster/geometry/transform.h"
#include "../../raster/tuile.h"
#include "random.h"

typedef struct set_up {
    tuile_model_t model;
    tuile_instance_t instance;
    tuile_scene_t scene;
    uint16_t width, height;
} set_up_t;

/* A camera at the origin without rotation, focal length 100, near 1, far 1000, window 320 x 240; an instance there at 256 steps a
 * unit; no lights. It holds pointers to itself: a copy does too, to the original. */
void set_up_simple(set_up_t *s);

/* transform_make; gives its error. */
int set_up_transform(const set_up_t *s, transform_t *transform);

/* Any rotation, as the camera makes them. */
void random_rotation(random_source_t *random, q2_30_t rotation[3][3]);

/* The camera's view of a quantised position, in world units, by the definitions in tuile.h. */
void set_up_view(const set_up_t *s, const int16_t q[3], long double view[3]);

/* Window in pixels, depth in steps. */
void set_up_window(const set_up_t *s, const long double view[3], long double *x, long double *y, long double *depth);

/* Moves the instance so that a position of it comes to stand at a point of the view, as far as 16.16 can tell. */
bool set_up_stand(set_up_t *s, const int16_t q[3], const long double wanted[3]);

#endif
