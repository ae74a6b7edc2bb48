/* How a frame came about, as a picture: for teaching and for debugging. */
#ifndef SIM_SHOW_H
#define SIM_SHOW_H

#include "../raster/tuile.h"
#include "picture.h"

typedef enum show_kind {
    SHOW_OVERDRAW, /* how many faces cover each pixel, as a heat map */
    SHOW_TILES,    /* the tiles, and how many faces come to each */
    SHOW_EDGES,    /* active edges on each line, as a plot beside the picture */
    SHOW_WINDOWS,  /* Warnock's windows, coloured by why they were divided no further */
    SHOW_ORDER,    /* from the first face painted to the last one, as a ramp of colours, cuts outlined */
} show_kind_t;

typedef struct show_view {
    tuile_method_t method;
    show_kind_t kind;
} show_view_t;

/* "METHOD-VIEW", like "warnock-windows". False and one line in error when there is no such view of that method. */
int show_parse(const char *text, show_view_t *view, sim_error_t *error);

/* Draws a frame by config with the view's method and makes the picture, `zoom` times as large. summary receives one line of
 * figures. model: of the scene's instance, for the source of its faces. */
int show_draw(const show_view_t *view, const tuile_config_t *config, const tuile_scene_t *scene, const tuile_model_t *model,
              unsigned zoom, sim_picture_t *out, char *summary, size_t summary_size, sim_error_t *error);

#endif
