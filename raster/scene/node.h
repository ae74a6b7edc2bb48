/* A scene whose parts hang on one another: wheels on a car, a hand on an arm.
 *
 *   world rotation    = parent's rotation * rotation
 *   world scale       = parent's scale * scale
 *   world translation = parent's translation + parent's rotation * (parent's scale * translation)
 *
 * Poses are composed anew from the local ones at each update, so nothing drifts from frame to frame and nothing need be made
 * orthonormal again. Errors of a node that hangs n deep, beside those of the local poses: rotation 1.5 n * 2^-30 in all (Frobenius
 * norm), scale n * 2^-32 of it, translation n * 2^-17 units from rounding plus (n - 1)^2 * 2^-30 of the longest way between a node
 * and its parent. What leaves the numbers is an error, and never wraps around.
 */
#ifndef TUILE_SCENE_NODE_H
#define TUILE_SCENE_NODE_H

#include "../tuile.h"
#include "lod.h"

#define TUILE_NODE_WORLD (-1) /* the parent of nodes that hang on nothing */

typedef struct tuile_node {
    int32_t parent;            /* index of a node that stands before this one, or TUILE_NODE_WORLD */
    bool hidden;               /* neither it nor what hangs on it is drawn */
    tuile_instance_t instance; /* its pose is the one relative to the parent; model NULL: nothing is drawn here, it is a joint */
    const tuile_lod_t *lod;    /* models in the place of instance.model; NULL: none */
    /* Set by tuile_nodes_update and _collect. */
    tuile_pose_t world;
    bool concealed; /* it, or a node it hangs on, is hidden */
    uint8_t level;  /* of lod; to be set to TUILE_LOD_FRESH at first, or 0 to begin with the finest */
} tuile_node_t;

/* Sets the world poses. TUILE_OK; or, with the index of the node in *faulty (may be NULL): TUILE_ERROR_ARGUMENT for a parent that
 * does not stand before its child, a rotation whose rows are no unit vectors, a scale of 0 or beyond 2^+-1000;
 * TUILE_ERROR_RANGE for a world pose that does not fit the numbers. Nodes before that one are set. */
int tuile_nodes_update(tuile_node_t *nodes, uint16_t count, uint16_t *faulty);

typedef struct tuile_collected {
    uint16_t instances; /* that are to be drawn */
    uint16_t too_far;   /* left out, beyond the last level of detail */
    uint16_t hidden;    /* left out with what they hang on */
} tuile_collected_t;

/* Writes what is to be drawn for a scene: instances of the nodes in their order, in world poses, with the models that suit the
 * camera. Materials of an instance with levels of detail must suit all of its models. TUILE_OK, TUILE_ERROR_ARGUMENT for a bad
 * lod, or TUILE_ERROR_MEMORY when more than `capacity` are wanted: collected->instances tells how many. */
int tuile_nodes_collect(tuile_node_t *nodes, uint16_t count, const tuile_camera_t *camera, tuile_instance_t *instances,
                        uint16_t capacity, tuile_collected_t *collected);

#endif
