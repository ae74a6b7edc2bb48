/* From what a user says of a camera to the renderer's fixed-point scene. */
#ifndef SIM_VIEW_H
#define SIM_VIEW_H

#include "../raster/tuile.h"
#include "error.h"

#include <stdbool.h>

/* In model units and degrees. A `has_` that is false asks for a default that frames the model. */
typedef struct view_options {
    bool has_eye, has_at, has_near, has_far, has_light, has_ortho, has_centre, has_spin, has_orbit, has_sphere;
    double eye[3], at[3], up[3];
    double fov; /* full vertical angle, degrees */
    double near, far;
    double light[3];  /* the way it travels, world */
    double ortho;     /* height of the window in model units */
    double pitch[2];  /* size of a pixel, x and y, relative: 1, 1 are square ones */
    double centre[2]; /* principal point, pixels */
    double spin;      /* degrees a frame, about `up` through `at` */
    double orbit[3];  /* the eye round `at`: yaw and pitch in degrees, and the distance, 0 = that which frames all */
    double sphere_centre[3], sphere_radius; /* what is framed; else the model */
    double ambient, diffuse;                /* 0 ... 1 */
    uint8_t background[3];
} view_options_t;

#define VIEW_OPTIONS_DEFAULT ((view_options_t){.up = {0, 1, 0}, .fov = 45, .pitch = {1, 1}, .ambient = 0.15, .diffuse = 0.75})

/* A scene of one instance; what it points to lies inside the struct, which must not be moved. */
typedef struct view {
    tuile_scene_t scene;
    tuile_instance_t instance;
    tuile_light_t light;
    double at[3], up[3]; /* world */
    double unit;         /* world units per model unit, a power of two */
    double spin;
} view_t;

/* Fails when the camera is degenerate or cannot be expressed, saying which option to change. */
int view_make(view_t *view, const view_options_t *options, const tuile_model_t *model, uint16_t width, uint16_t height,
              unsigned frames, sim_error_t *error);

/* Turns the model for a frame, counted from 0. */
void view_frame(view_t *view, unsigned frame);

#endif
