/* One model under a camera, a scene ready to be drawn. */
#ifndef TESTS_SUPPORT_STAGE_H
#define TESTS_SUPPORT_STAGE_H

#include "models.h"

#include "../../sim/view.h"

/* view points into the struct itself, so a stage stays where it is. */
typedef struct stage {
    model_compiled_t compiled;
    view_t view;
} stage_t;

/* Compiles and frees the mesh, and aims the default camera at it. Fails the test when that does not work, as all of these do. */
void stage_open(stage_t *stage, mesh_t *mesh, uint16_t width, uint16_t height);
/* The torus of the figures: 5800 triangles. */
void stage_open_torus(stage_t *stage, uint16_t width, uint16_t height);
void stage_close(stage_t *stage);

/* Another camera; without options (NULL) the default one before a dark blue background. */
void stage_aim(stage_t *stage, const view_options_t *options, uint16_t width, uint16_t height);

/* 240x320 pixels, and clusters as large as the model's. */
tuile_config_t stage_panel_config(const stage_t *stage);

/* An orthographic camera at 40 units looking along -z, 16 pixels a unit. */
tuile_camera_t stage_plain_camera(uint16_t width, uint16_t height);

/* The model as it is, moved along x by whole units. */
tuile_instance_t stage_placed(const tuile_model_t *model, int x);

#endif
