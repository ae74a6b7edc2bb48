/* Small models that the project makes itself: as a mesh, as an OBJ file, and compiled. */
#ifndef TESTS_SUPPORT_MODELS_H
#define TESTS_SUPPORT_MODELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../../raster/tuile.h"
#include "../../sim/mesh/mesh.h"

/* An empty mesh of one grey material; then positions and faces. Fails the test when out of memory. */
void model_start(mesh_t *mesh);
uint32_t model_position(mesh_t *mesh, double x, double y, double z);
/* Makes a material when the mesh has none of that colour. */
uint32_t model_material(mesh_t *mesh, unsigned red, unsigned green, unsigned blue);
/* Corners are positions, counter-clockwise seen from the front. */
void model_face(mesh_t *mesh, const uint32_t *corners, uint32_t count, uint32_t material);
/* A box from low to high of 6 quads, in the order +z, -z, +x, -x, +y, -y. */
void model_box(mesh_t *mesh, const double low[3], const double high[3], uint32_t material);

/* From -1 to 1, 6 quads as model_box. */
void model_cube(mesh_t *mesh);
/* Every face lit by its own normal, at each of its corners. Without it the compiler makes normals that are smooth within 60
 * degrees. */
void model_flat_normals(mesh_t *mesh);
/* About the y axis, radii 1 and 0.4; rings * sides quads, or twice as many triangles. Closed: positions are shared. */
void model_torus(mesh_t *mesh, unsigned rings, unsigned sides, bool triangles);
/* About the origin, radius 1; belts between the poles, quads but for the triangles at the poles. Closed. */
void model_sphere(mesh_t *mesh, unsigned belts, unsigned sides);
/* Boxes beside one another that grow by equal steps; they touch, so that there are faces back to back. */
void model_staircase(mesh_t *mesh, unsigned steps);
/* From -4 to 4 each way, floor y = -2, ceiling 2, seen from the inside; the wall at z = -4 is one ring of ten corners with a window
 * in it, and a box stands on the floor. Each wall has a colour of its own. */
void model_room(mesh_t *mesh);
/* Eight triangles, red where x * y * z > 0, else blue. */
void model_octahedron(mesh_t *mesh);

/* OBJ text; materials in a file of the same name with .mtl, when there are several. Positions are written in full. */
void model_write_obj(const mesh_t *mesh, const char *path);

typedef struct model_compiled {
    uint8_t *bytes;
    size_t size_bytes;
    mesh_report_t report;
    tuile_model_t model;
} model_compiled_t;

/* Compiles, opens and frees the mesh. */
void model_compile(model_compiled_t *compiled, mesh_t *mesh);
/* The same with options, NULL = all zero; the mesh stays. */
void model_compile_with(model_compiled_t *compiled, const mesh_t *mesh, const mesh_options_t *options);
void model_free(model_compiled_t *compiled);

#endif
