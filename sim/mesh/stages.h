/* What the stages of the model compiler hand to one another. Not for users of mesh.h. */
#ifndef SIM_MESH_STAGES_H
#define SIM_MESH_STAGES_H

#include <stdlib.h>

#include "../../raster/geometry/model.h"
#include "mesh.h"

#define MESH_NO_NORMAL UINT32_MAX /* in mesh_t.corner_normals while normals are being made */
#define MESH_CORNERS_MAX 255u     /* of a compiled face */

__extension__ typedef __int128 mesh_int128_t;

static inline void *mesh_array(size_t count, size_t item_bytes) { return calloc(count ? count : 1, item_bytes); }

/* array.c: count items of item_bytes; *capacity grows by doubling. False when memory is short: *array is then as it was. */
bool mesh_reserve(void *array, size_t *capacity, size_t count, size_t item_bytes);

/* Adds a line to mesh->warnings; what does not fit is left out (import_material.c). */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
void mesh_warn(mesh_t *mesh, const char *format, ...);

/* ---- files (check.c) --------------------------------------------------------------------------------------- */

/* The whole file with a NUL behind it, malloc'ed. Missing, a folder, unreadable and empty files are errors. */
int mesh_read_file(const char *path, char **text, size_t *size_bytes, sim_error_t *error);

/* Finds the damage in OBJ, PLY and OFF files that Assimp lets pass or hangs on: files cut short, numbers that are none or not
 * finite, indices out of range. textures: texture coordinates are looked at as well. text is overwritten. */
int mesh_check_text(const char *path, char *text, size_t size_bytes, bool textures, sim_error_t *error);

/* The same for PLY, text and binary (check_ply.c). */
int mesh_check_ply(const char *path, char *text, size_t size_bytes, sim_error_t *error);

/* ---- normals.c --------------------------------------------------------------------------------------------- */

/* Newell's normal of a polygon, not normalised: twice its area long. */
void mesh_face_normal(const mesh_t *mesh, const mesh_face_t *face, double normal[3]);

/* Gives a normal to each corner that has none: the mean of the faces around its vertex, weighted by angle, that differ from its
 * own by less than the crease angle of 60 degrees. flat: the face's own. */
int mesh_make_normals(mesh_t *mesh, bool flat, sim_error_t *error);

/* ---- affine.c ---------------------------------------------------------------------------------------------- */

/* Are texture coordinates, within 1/64 texel, and colours, within half of 1/255, affine over the face? Else it has to become
 * triangles. True of faces without either. */
bool mesh_face_affine(const mesh_t *mesh, const mesh_face_t *face);

/* ---- palette.c --------------------------------------------------------------------------------------------- */

#define MESH_MATERIALS_MAX 256u

/* At most MESH_MATERIALS_MAX colours for all, in order of first use; index[i] is the one of colours[i]. 0, or -1 without memory.
 */
int mesh_palette(const uint8_t (*colours)[3], size_t count, uint8_t (*palette)[3], size_t *palette_count, uint32_t *index);

/* The same for red, green, blue and alpha, and at most `most` entries, 1 ... MESH_MATERIALS_MAX. count >= 1. */
int mesh_palette_of(const uint8_t (*colours)[4], size_t count, size_t most, uint8_t (*palette)[4], size_t *palette_count,
                    uint32_t *index);

/* ---- triangulate.c ----------------------------------------------------------------------------------------- */

#define MESH_TRIANGULATE_RANGE (1 << 28) /* |coordinate| at most */

/* Cuts a polygon into at most count - 2 triangles, each with an area and, where the polygon does not cross itself as seen along
 * its Newell normal, turned like it. triangles[i] are indices into points. Returns their number, 0 when the polygon has no area,
 * -1 without memory. */
long mesh_triangulate(const int32_t (*points)[3], size_t count, uint32_t (*triangles)[3]);

/* ---- quantise.c: the mesh on its integer grid -------------------------------------------------------------- */

/* No padding: vertices are compared by their bytes. */
typedef struct solid_vertex {
    int16_t position[3];
    int8_t normal[3];
    int8_t fraction[3];  /* in 1/256 step: of corners that a tree made */
    int16_t texcoord[2]; /* 0 where the material has no texture */
    uint8_t colour[4];   /* 0 where the mesh has no vertex colours */
    int16_t morph[3];    /* position in the second key frame; 0 without one */
    int8_t morph_normal[3], zero;
} solid_vertex_t;

typedef struct solid_face {
    uint32_t first, count; /* in solid_t.corners; count 3 ... 255 */
    uint32_t material, source;
    bool convex;
    bool crossing;     /* of a tree: some part of it turns the other way */
    bool piece;        /* cut by the display tree's compiler: its corners were rounded, its normal is that of its support plane */
    int64_t normal[3]; /* Newell's, exact: twice the area long; of a piece any length */
    double unit[3];
    double morph_unit[3]; /* of the second key frame */
} solid_face_t;

typedef struct solid {
    tuile_scale_t step;
    double step_value;
    int32_t offset[3];
    solid_vertex_t *vertices; /* distinct */
    uint32_t *places;         /* of each vertex: a number that all vertices at its position share */
    size_t vertex_count, place_count;
    uint32_t *corners; /* vertices */
    size_t corner_count;
    solid_face_t *faces;
    size_t face_count;
    size_t polygons, non_planar, split, skipped;
    double error;                    /* model units */
    bool textured, coloured, morphs; /* whether vertices have these */
} solid_t;

void solid_free(solid_t *solid);

/* Newell's normal, exact. |coordinate| <= 2^16; count < 2^28. */
void solid_newell(const int32_t (*points)[3], size_t count, int64_t normal[3]);

/* Strictly convex as seen along its normal, and winding around once. */
bool solid_convex(const int32_t (*points)[3], size_t count, const int64_t normal[3]);

/* mesh must have normals. */
int solid_quantise(solid_t *solid, const mesh_t *mesh, const mesh_options_t *options, sim_error_t *error);

/* ---- bounds.c ---------------------------------------------------------------------------------------------- */

typedef struct bounds_sphere {
    int16_t centre[3];
    uint16_t radius; /* rounded up: holds every point */
} bounds_sphere_t;

typedef struct bounds_cone {
    int8_t axis[3];
    uint8_t cutoff; /* see model.h; 255 = never */
} bounds_cone_t;

/* vertices: indices into solid->vertices, count >= 1. */
bounds_sphere_t bounds_of_vertices(const solid_t *solid, const uint32_t *vertices, size_t count);

/* faces: indices into solid->faces. -1 without memory. */
int bounds_of_normals(const solid_t *solid, const uint32_t *faces, size_t count, bounds_cone_t *cone);

/* ---- neighbours.c ------------------------------------------------------------------------------------------ */

typedef struct keyed_face {
    uint64_t key;
    uint32_t item;
} keyed_face_t;

/* For qsort: by key, then by item, so that the order is the same everywhere. */
int keyed_face_order(const void *x, const void *y);

/* Pairs of faces with an edge in common, malloc'ed; their number, or -1 without memory; to be freed in both cases. */
long solid_neighbours(const solid_t *solid, uint32_t (**pairs)[2]);

/* Where the middle of some faces comes in z order: near keys lie near in space. count >= 1. */
uint64_t solid_z_order(const solid_t *solid, const uint32_t *faces, size_t count);

/* ---- cluster.c --------------------------------------------------------------------------------------------- */

typedef struct clusters {
    uint32_t *faces; /* all faces of the solid, cluster by cluster */
    uint32_t *first; /* count + 1 entries: cluster k has faces[first[k]] ... faces[first[k + 1] - 1] */
    size_t count;
} clusters_t;

void clusters_free(clusters_t *clusters);

/* What a cluster costs, in instructions of a small core: see cluster.c. cosine: of the widest angle between its axis and its
 * normals; diagonal: of the box around it, in steps. */
double clusters_price(size_t vertices, size_t faces, double cosine, double diagonal, double eye_distance);
double clusters_eye_distance(const solid_t *solid);

int clusters_grow(clusters_t *clusters, const solid_t *solid, bool keep_order, sim_error_t *error);

/* ---- encode.c ---------------------------------------------------------------------------------------------- */

/* The display tree's section, as words. */
typedef struct tree_section {
    const uint32_t *words;
    size_t count, depth;
} tree_section_t;

/* tree NULL: none. */
int solid_encode(const solid_t *solid, const clusters_t *clusters, const mesh_t *mesh, const tree_section_t *tree, uint8_t **bytes,
                 size_t *size_bytes, size_t *vertex_count, sim_error_t *error);

#endif
