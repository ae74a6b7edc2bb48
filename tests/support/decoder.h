/* A reader of compiled models of our own, and checks of what it has read: by brute force, whether the spheres and cones say the
 * truth and every face stands where the mesh has it. */
#ifndef TESTS_SUPPORT_DECODER_H
#define TESTS_SUPPORT_DECODER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../../sim/mesh/mesh.h"

/* Models as OBJ text: a cube from -1 to 1 of 6 quads, and the corners of a square of 4 x 4. */
#define DECODER_CUBE_VERTICES "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
#define DECODER_CUBE_FACES "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n"
#define DECODER_SQUARE "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n"

typedef struct decoder_face {
    uint32_t cluster, corners, material, source;
    bool convex;
    int32_t q[255][3];
    int8_t normals[255][3], plane[3];
} decoder_face_t;

typedef struct decoder_model {
    decoder_face_t *faces;
    uint32_t face_count, vertex_count, cluster_count, material_count;
    double step;
    int32_t offset[3];
    const uint8_t *bytes, *materials;
} decoder_model_t;

typedef struct compiled {
    mesh_t mesh;
    mesh_report_t report;
    uint8_t *bytes;
    size_t size_bytes;
    decoder_model_t model;
} compiled_t;

/* Numbers of a compiled model, little-endian. */
uint32_t decoder_u32(const uint8_t *p);
uint32_t decoder_u16(const uint8_t *p);
int32_t decoder_s16(const uint8_t *p);

/* CRC-32, bit by bit: that of models and of PNG files. */
uint32_t decoder_crc(const uint8_t *bytes, size_t size_bytes);

/* The normal of a face of the grid, as long as twice its area. */
void decoder_plane(const decoder_face_t *face, double n[3]);

/* Random numbers in -1 ... 1; the same ones in every run, decoder_check_cones takes of them too. */
double decoder_random_unit(void);
void decoder_random_seed(uint64_t seed);

/* A cluster that is said to face away has only faces that do, from any eye or direction. Returns how many were. */
size_t decoder_check_cones(const decoder_model_t *m, int eyes);

/* Every face stands where the mesh has it, with its winding, its first corner first, to within half a step on each axis. */
void decoder_check_faces(const decoder_model_t *m, const mesh_t *mesh);

/* Compiles c->mesh, reads the result into c->model and checks what has to hold of every model; fails the test on an error. */
void decoder_compile_mesh(compiled_t *c, const mesh_options_t *options);

/* The same of a file that is imported first. */
compiled_t decoder_compile_file(const char *path, const mesh_options_t *options);

/* Frees the mesh, the bytes and what was read of them. */
void decoder_drop(compiled_t *c);

/* The face that was made of a face of the source; fails the test when there is none. */
const decoder_face_t *decoder_face_of_source(const decoder_model_t *m, uint32_t source);

#endif
