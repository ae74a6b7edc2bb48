/* Options of tuile render that say how surfaces are drawn: their textures, or their plain colours. */
#ifndef SIM_RENDER_SURFACE_H
#define SIM_RENDER_SURFACE_H

#include "../raster/tuile.h"
#include "options.h"

typedef struct render_surface {
    bool plain;
    uint8_t texturing; /* tuile_texturing_t */
} render_surface_t;

extern const char render_surface_usage[];

/* An option of this part: takes its value. False when it is another's. */
bool render_surface_option(render_surface_t *surface, options_t *options, const char *argument);

/* Lays the renderer out for what the model has: textures, vertex colours. */
void render_surface_apply(const render_surface_t *surface, const tuile_model_t *model, tuile_config_t *config);

#endif
