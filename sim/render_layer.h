/* tuile render: what is drawn with depth over the opaque faces, and how faces are blended. */
#ifndef SIM_RENDER_LAYER_H
#define SIM_RENDER_LAYER_H

#include "../raster/tuile.h"
#include "error.h"
#include "options.h"
#include "render_image.h"

#define RENDER_LAYER_MAX 64 /* of lines, and of points */
#define RENDER_SPRITES_MAX 16

typedef struct render_sprite {
    double at[3], size[2]; /* model units */
    render_image_t image;
} render_sprite_t;

typedef struct render_layer {
    bool has_alpha, has_blend, smooth;
    uint8_t alpha, blend, edges, edge_colour[3];
    double line_at[RENDER_LAYER_MAX][6], point_at[RENDER_LAYER_MAX][3]; /* model units */
    tuile_line_t lines[RENDER_LAYER_MAX];
    render_sprite_t sprites[RENDER_SPRITES_MAX];
    /* In a frame the sprites stand behind the points: the scene takes one array. */
    tuile_sprite_t points[RENDER_LAYER_MAX + RENDER_SPRITES_MAX];
    uint16_t line_count, point_count, sprite_count;
    const tuile_instance_t *given; /* the scene's */
    tuile_instance_t *instances;   /* of the frame: the scene's with materials of their own */
    tuile_material_t *materials;
} render_layer_t;

extern const char render_layer_usage[];

/* An option of this part: takes its value. False when it is another's. */
bool render_layer_option(render_layer_t *part, options_t *options, const char *argument);

/* Loads the sprites' pictures and sets what the renderer must be laid out for. 0, or an exit code and a message. */
int render_layer_apply(render_layer_t *part, tuile_config_t *config);

/* Has the model translucent faces of its own: by its materials, or, unless plain, by its textures or the colours of its vertices?
 */
bool render_layer_translucent(const tuile_model_t *model, bool plain);

/* Puts lines, points, sprites and materials into the scene of a frame. unit: world units per model unit. 0, or -1 and one line in
 * error. */
int render_layer_frame(render_layer_t *part, tuile_scene_t *scene, double unit, sim_error_t *error);

void render_layer_free(render_layer_t *part);

#endif
