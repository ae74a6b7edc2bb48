/* What the parts of the importer share: import.c collects faces, import_material.c materials and images, import_join.c makes one
 * mesh of it all.
 */
#ifndef SIM_MESH_IMPORT_H
#define SIM_MESH_IMPORT_H

#include "stages.h"

#include <assimp/scene.h>

/* One of the file's materials, once a face has it. */
typedef struct import_material {
    bool used;
    char name[64];
    uint8_t colour[3];
    tuile_material_t surface; /* all but the colour */
    unsigned channel;         /* of texture coordinates */
} import_material_t;

enum {
    IMPORT_TINTED = 1, /* its vertices have colours */
    IMPORT_BARE = 2,   /* its vertices have no texture coordinates */
};

typedef struct collector {
    const char *path;
    const struct aiScene *scene;
    const mesh_options_t *options;
    bool flat_normals;      /* those of the file are of facets: of no use for smooth shading */
    mesh_t mesh;            /* until joined, a position, normal, texture coordinate and tint for each of the file's vertices */
    double (*texcoords)[2]; /* of each vertex, in repeats, t downwards; zeros without */
    uint8_t (*tints)[4];    /* of each vertex: its colour; white without */
    bool textured, tinted;  /* any vertex has these */
    uint8_t (*colour)[3];   /* of each face */
    uint32_t *material;     /* of each face: 4 * its place in materials, and IMPORT_... */
    import_material_t *materials;
    size_t positions, normals, texcoord_room, tint_room, corners, faces, colours, face_materials; /* capacities */
    sim_error_t *error;
} collector_t;

static inline uint8_t import_byte(double value) { return (uint8_t)(value >= 1 ? 255 : value > 0 ? value * 255 + 0.5 : 0); }

/* Looks at a material of the file when a face has it first, and reads its image. NULL: error is set. */
const import_material_t *import_material(collector_t *c, unsigned index);

/* Joins vertices at equal positions, drops the faces that have fewer than three of them, sets materials up and makes normals.
 * second: the same faces elsewhere; NULL: no second key frame. */
int import_join(collector_t *c, const collector_t *second);

/* From repeats to texels of each face's texture: shifts those of each material that repeat by whole repeats, so that they lie
 * around 0, and chooses its uv_bits. */
int import_fit_texcoords(collector_t *c);

int import_no_memory(const collector_t *c);

#endif
