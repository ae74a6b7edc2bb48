/* Of tuile render: more models than one, on one another, levels of detail, and the way between key frames. */
#ifndef SIM_RENDER_WORLD_H
#define SIM_RENDER_WORLD_H

#include "mesh/mesh.h"
#include "options.h"
#include "view.h"

#include "../raster/scene/node.h"

#define WORLD_THINGS 63 /* beside the main model */
#define WORLD_LEVELS 8

/* --add. Lengths in units of the main model, along the axes of the parent. */
typedef struct world_thing {
    char path[512];
    double at[3], scale, turn[3]; /* turn: degrees about x, then y, then z */
    double spin;                  /* degrees a frame about its own y */
    double morph;                 /* 0 ... 1 */
    long parent;                  /* of the things in their order, 0 = the main model; -1 = the world */
    bool has_colour;
    uint8_t colour[3];
    tuile_material_t *materials;
} world_thing_t;

typedef struct world_model {
    uint8_t *bytes;
    tuile_model_t model;
} world_model_t;

typedef struct render_world {
    world_thing_t things[WORLD_THINGS];
    unsigned thing_count;
    struct {
        char path[512]; /* "none": nothing is drawn from there on */
        double distance;
    } levels[WORLD_LEVELS];
    unsigned level_count;
    bool has_morph_at, morph_swing;
    double morph_at;
    /* Made by render_world_load and render_world_place. */
    world_model_t models[WORLD_THINGS + WORLD_LEVELS];
    unsigned model_count;
    const tuile_model_t *level_models[WORLD_LEVELS + 1];
    q16_16_t reach[WORLD_LEVELS + 1];
    tuile_lod_t lod;
    tuile_node_t nodes[WORLD_THINGS + 1];
    tuile_instance_t instances[WORLD_THINGS + 1];
    tuile_collected_t collected;
    int unit; /* log2 of world units per model unit */
    unsigned frames;
} render_world_t;

extern const char render_world_usage[];

/* An option of this part: takes its value. False when it is another's. */
bool render_world_option(render_world_t *world, options_t *options, const char *argument);

/* Is there more than the main model? */
bool render_world_has_more(const render_world_t *world);

/* Loads and opens the other models by the options of the main one, and puts the sphere that holds all things into the view's
 * options. 0, or -1 and one line in error. */
int render_world_load(render_world_t *world, const tuile_model_t *model, const mesh_options_t *options, view_options_t *view,
                      sim_error_t *error);

/* The main model's counts and limits become those of all models together, which a renderer is to be laid out for. */
void render_world_sizes(const render_world_t *world, tuile_model_t *sizes);

/* Makes the nodes, once the view is there. 0, or -1 and one line in error. */
int render_world_place(render_world_t *world, const view_t *view, unsigned frames, sim_error_t *error);

/* Puts what is to be seen in a frame into the view's scene, after view_frame. 0, or -1 and one line in error. */
int render_world_frame(render_world_t *world, view_t *view, unsigned frame, sim_error_t *error);

/* The importer's number of a face, counted on through the instances of the scene, 0-based. */
uint32_t render_world_source(const tuile_scene_t *scene, uint32_t face);

void render_world_free(render_world_t *world);

#endif
