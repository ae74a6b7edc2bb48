/* The cone test.
 *
 * A face with outward normal n through p faces away from the eye e when dot(p - e, n) >= 0. Let all normals of a cluster lie within
 * an angle alpha < 90 degrees of the axis a, and all points within radius r of the centre c. For v = c - e the direction v leaves
 * every such n on the far side when angle(v, a) <= 90 - alpha, that is dot(v, a) >= sin(alpha) |v| |a|; and moving from c to any
 * point of the sphere changes dot(v, n) by r at most, which the term r |a| covers, with 128 for |a| there. The cutoff in the model
 * is sin(alpha), rounded up.
 *
 * In integers: dot - r |a| >= (cutoff / 254) |a| |v|, both sides squared once the left one is known to be positive. |v| has 22 bits
 * a component, so the squares stay below 2^62.
 */
#include "cull.h"

#include "model.h"

#define AXIS_LENGTH_MAX 128 /* axes are about 127 long; one that were longer would cull nothing */

static bool sphere_outside(const transform_t *transform, int32_t x, int32_t y, int32_t z, uint32_t radius) {
    for (unsigned p = 0; p < PLANE_COUNT; p++) {
        const transform_plane_t *plane = &transform->planes[p];
        const int64_t value = (int64_t)plane->n[0] * x + (int64_t)plane->n[1] * y + (int64_t)plane->n[2] * z + plane->d;
        if (value + (int64_t)((uint64_t)plane->length * radius) < 0) { return true; }
    }
    return false;
}

bool cull_outside(const transform_t *transform, const uint8_t *cluster) {
    return sphere_outside(transform, model_i16(cluster + CLUSTER_AT_CENTRE), model_i16(cluster + CLUSTER_AT_CENTRE + 2),
                          model_i16(cluster + CLUSTER_AT_CENTRE + 4), model_u16(cluster + CLUSTER_AT_RADIUS));
}

bool cull_model_outside(const transform_t *transform, const tuile_model_t *model) {
    return sphere_outside(transform, model->centre[0], model->centre[1], model->centre[2], model->radius);
}

bool cull_faces_away(const transform_t *transform, const uint8_t *cluster) {
    const uint32_t cutoff = cluster[CLUSTER_AT_CUTOFF];
    if (cutoff == 255 || !transform->cones) { return false; }

    int64_t dot = 0;
    uint64_t squares = 0;
    uint32_t axis_squares = 0;
    for (unsigned i = 0; i < 3; i++) {
        const int32_t axis = (int8_t)cluster[CLUSTER_AT_AXIS + i];
        int32_t v = transform->eye[i];
        if (transform->perspective) { v = (model_i16(cluster + CLUSTER_AT_CENTRE + 2 * i) >> transform->eye_shift) - v; }
        dot += (int64_t)axis * v;
        squares += (uint64_t)((int64_t)v * v);
        axis_squares += (uint32_t)(axis * axis);
    }
    if (transform->mirrored) { dot = -dot; } /* the faces that look at the eye are the back faces */
    if (transform->perspective) {
        /* What the shifts cut off is below 2 in each component and in the radius. */
        const int64_t radius = (model_u16(cluster + CLUSTER_AT_RADIUS) >> transform->eye_shift) + (transform->eye_shift ? 8 : 1);
        dot -= radius * AXIS_LENGTH_MAX;
    }
    if (dot < 0 || axis_squares > AXIS_LENGTH_MAX * AXIS_LENGTH_MAX) { return false; }
    const uint64_t scaled = ((uint64_t)cutoff * cutoff * axis_squares + 64515u) / 64516u; /* (cutoff / 254)^2 |a|^2, rounded up */
    return (uint64_t)(dot * dot) >= scaled * squares;
}
