/* Options of tuile render for light, materials and fog. */
#ifndef SIM_RENDER_LIGHT_H
#define SIM_RENDER_LIGHT_H

#include "options.h"
#include "view.h"

#define RENDER_LIGHTS_MAX 255

/* Starts as zero. */
typedef struct render_light {
    tuile_light_t light[RENDER_LIGHTS_MAX];
    double at[RENDER_LIGHTS_MAX][4]; /* direction, or position and range, model units */
    unsigned count;
    bool has_intensity[RENDER_LIGHTS_MAX];
    bool has_ambient, has_specular, has_emission, two_sided;
    double ambient; /* 0 ... 1 */
    uint8_t ambient_colour[3], specular, shininess, emission[3];
    tuile_fog_t fog;
    double fog_near, fog_far;
    tuile_material_t *materials; /* the model's, changed */
} render_light_t;

extern const char render_light_usage[];

/* True: the option was one of these. A value that is wrong fails the options. */
bool render_light_option(render_light_t *light, options_t *options, const char *argument);

/* Effects that are wanted, into config. */
void render_light_apply(const render_light_t *light, tuile_config_t *config);

/* Lights, materials and fog into the scene of a view that is made, whose instance has this model. */
int render_light_place(render_light_t *light, view_t *view, sim_error_t *error);

void render_light_free(render_light_t *light);

#endif
