/* Models with display trees among others in a world, and two pictures of it compared: one by the display tree, one by depth. */
#ifndef TESTS_SUPPORT_SOLIDS_H
#define TESTS_SUPPORT_SOLIDS_H

#include "models.h"
#include "random.h"

/* A model and the mesh that it was made of. */
typedef struct solid_model {
    mesh_t mesh;
    model_compiled_t compiled;
} solid_model_t;

/* Takes the mesh; compiles it with a display tree. */
void solid_model_open(solid_model_t *model, mesh_t *mesh, bool two_sided);
void solid_model_close(solid_model_t *model);

/* The scenes here have models whose instances are `solids` in the same order. */
enum { SOLIDS_MAX = 12 };
typedef struct solids {
    const solid_model_t *models[SOLIDS_MAX];
    tuile_instance_t instances[SOLIDS_MAX];
    tuile_light_t light;
    tuile_scene_t scene; /* points into this struct */
    uint16_t width, height;
} solids_t;

/* Nothing in it yet; a perspective camera of 60 degrees or so at the origin, near 1/4, far 256. */
void solids_start(solids_t *solids, uint16_t width, uint16_t height);
/* As it stands in its own coordinates. */
tuile_instance_t *solids_add(solids_t *solids, const solid_model_t *model);
void solids_place(tuile_instance_t *instance, double x, double y, double z);
/* Any rotation; a reflection too when that is wanted. */
void solids_turn(tuile_instance_t *instance, random_source_t *random, bool mirrored);

/* The world's place of a position of the model. */
void solids_world(const tuile_instance_t *instance, const double position[3], double world[3]);
void solids_look(solids_t *solids, const double eye[3], const double at[3]);
/* The same camera with parallel rays. */
void solids_orthographic(solids_t *solids, double pixels_per_unit);

/* Least limits for all models of the scene. */
tuile_config_t solids_config(const solids_t *solids, tuile_method_t method);

/* The depth at a point of the window of the plane in which a face of the scene lies (1 + its number through all instances), by the
 * definition in tuile.h, and by how much it differs within 1/16 pixel of the point. */
double solids_depth(const solids_t *solids, uint32_t id, double x, double y, double *within);

typedef struct solids_difference {
    uint64_t pixels, covered;
    uint64_t differ; /* and may, being as good as equally deep */
    uint64_t beside; /* differ, and would not were they sampled 1/16 pixel beside: with the eye in a plane of the tree, faces on
                        both sides of it meet at a line, as the eye sees them, and are both snapped over the pixel's centre; then
                        the order of the tree, which is right off that line, cannot tell the nearer one */
    uint64_t ties;   /* differ too, and lie in one plane: depth, known to a step, took one of them */
} solids_difference_t;

/* Compares face ids pixel by pixel: where they differ both faces must be as deep there as depth of 16 bits can tell: within a step,
 * and what 1/16 pixel, the grid of vertices, makes of it; or else the pixel lies beside such a face's edge. Of two faces in one
 * plane `ids` must have the first, or the last. Fails the test where that is not so. */
void solids_compare(const solids_t *solids, const uint32_t *ids, const uint32_t *expected, const char *name, tuile_tie_t tie,
                    solids_difference_t *difference);

/* Draws by the display tree and by depth, in face ids and in both shadings: ids are compared as above, colours must be the same
 * wherever the same face is seen. Only where Gouraud shading cuts polygons into parts they are counted too, as the parts of one
 * that is not flat once snapped lie a little before or behind it. */
void solids_check(const solids_t *solids, const char *name, tuile_tie_t tie, solids_difference_t *difference);

#endif
