/* Models on whole coordinates, as the tests of display trees need them. */
#ifndef TESTS_SUPPORT_TREE_MODELS_H
#define TESTS_SUPPORT_TREE_MODELS_H

#include "../../sim/mesh/mesh.h"
#include "random.h"

/* Multiplies all positions and rounds them. */
void tree_model_scale(mesh_t *mesh, double factor);
void tree_model_turn_inside_out(mesh_t *mesh);

/* Added to a mesh, which model_start began. */
void tree_model_triangle(mesh_t *mesh, const int32_t corners[3][3]);
void tree_model_quad(mesh_t *mesh, const int32_t corners[4][3]);
void tree_model_box(mesh_t *mesh, int32_t x0, int32_t y0, int32_t z0, int32_t x1, int32_t y1, int32_t z1);
/* A bar with the outline of a star, about an axis of its own: two faces that are not convex, and 2 * points sides. */
void tree_model_star_bar(mesh_t *mesh, int points, const int32_t axes[3][3], const int32_t middle[3]);

/* A mesh of its own: an icosahedron whose faces are cut into divisions^2, all corners then moved out to the sphere. */
void tree_model_icosphere(mesh_t *mesh, unsigned divisions, double radius);
/* The hull of random points by its definition: every triangle that has all others on one side. */
void tree_model_hull(mesh_t *mesh, random_source_t *random);

/* dot(cross(b - a, c - a), d - a), exact. */
int64_t tree_model_volume(const int32_t a[3], const int32_t b[3], const int32_t c[3], const int32_t d[3]);

#endif
