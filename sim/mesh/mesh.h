/* The model compiler: a file of some format in, the bytes of geometry/model.h out.
 *
 *   import (Assimp)  ->  mesh_t  ->  simplify (meshoptimizer)  ->  check and split  ->  quantise  ->  cluster  ->  encode  -> write
 *                                                                                  \  display tree  /
 */
#ifndef SIM_MESH_MESH_H
#define SIM_MESH_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../../raster/tuile.h"
#include "../error.h"

/* Polygons as imported: doubles, heap memory owned by the struct. */
typedef struct mesh_face {
    uint32_t first;    /* in mesh_t.corners */
    uint32_t count;    /* >= 3 */
    uint32_t material; /* in mesh_t.materials */
    uint32_t source;   /* the importer's number of the face, 0-based */
} mesh_face_t;

/* A texture as geometry/model.h has it; heap memory owned by the mesh. */
typedef struct mesh_texture {
    char *name;       /* of the image file, as the model names it */
    uint8_t *texels;  /* all levels */
    uint8_t *palette; /* NULL: none */
    size_t size_bytes, palette_bytes;
    uint16_t width, height, key;
    uint8_t format, levels, flags;
} mesh_texture_t;

/* A second key frame, of the same faces. */
typedef struct mesh_morph {
    double (*positions)[3]; /* of each position of the mesh; NULL: there is no second key frame */
    double (*normals)[3];
    size_t normal_count;
    uint32_t *corner_normals;
} mesh_morph_t;

typedef struct mesh {
    double (*positions)[3];
    size_t position_count;
    double (*normals)[3]; /* unit; normal_count may be 0: then the compiler makes them */
    size_t normal_count;
    uint32_t *corners;        /* index of each corner's position */
    uint32_t *corner_normals; /* index of each corner's normal; NULL when normal_count is 0 */
    double (*texcoords)[2];   /* of each corner: s, t in texels of its face's texture, t downwards; NULL: none */
    uint8_t (*colours)[4];    /* of each corner: red, green, blue, alpha; NULL: none */
    size_t corner_count;
    mesh_face_t *faces;
    size_t face_count;
    uint8_t (*materials)[3];    /* red, green, blue; at least one */
    tuile_material_t *surfaces; /* all of each material but its colour; NULL: opaque, lit, without a texture */
    size_t material_count;
    mesh_texture_t *textures;
    size_t texture_count;
    mesh_morph_t morph;
    size_t source_face_count; /* faces that the importer delivered, skipped ones included */
    size_t skipped_count;     /* degenerate ones among them */
    size_t loose_count;       /* points and lines in the file: no faces, left out and not numbered */
    char warnings[512];       /* lines for people; empty when there is nothing to tell */
} mesh_t;

/* Frees what mesh owns and clears it; a cleared mesh may be freed again. */
void mesh_free(mesh_t *mesh);

/* How textures are stored; the rest is 1 + tuile_texel_t. AUTO, unless they are to be fast: ARGB4444 for images with alpha, else PALETTE4 for at most 16
 * colours, GREY8 where all is grey, PALETTE8 for at most 256 colours, RGB565. Colours are counted as RGB565 shows them. */
typedef enum mesh_texels {
    MESH_TEXELS_AUTO = 0,
} mesh_texels_t;

/* Vertex colours of the file: for each vertex, or as one mean for each face. */
typedef enum mesh_vertex_colours {
    MESH_COLOURS_AUTO = 0, /* for each vertex if they differ within a face, or in alpha */
    MESH_COLOURS_VERTICES = 1,
    MESH_COLOURS_FACES = 2,
} mesh_vertex_colours_t;

typedef struct mesh_options {
    bool keep_order;  /* faces stay in the order given (text scenes: ties are decided by it) */
    bool triangles;   /* every polygon is cut into triangles, which keep its source number */
    bool keep_planar; /* take polygons for planar: no test, no split for it; a mesh without normals is then lit flat */
    double step;      /* quantisation step in model units, offset 0; 0 = the finest that holds the model */
    bool tree;        /* with a display tree: faces are cut, and lie in its order */
    bool two_sided;   /* faces are seen from both sides: those of a tree that look inwards are turned round, so that of coplanar
                         ones the first stays first */
    bool no_textures; /* images are not looked for */
    uint8_t vertex_colours; /* mesh_vertex_colours_t */
    uint8_t texture_format; /* mesh_texels_t */
    uint16_t texture_size;  /* texels across or down at most, 1 ... TUILE_TEXTURE_MAX: halved until they fit; 0 = as they are */
    bool texture_fast;      /* as small faces are drawn fastest: sides become powers of two, AUTO takes PALETTE8 or RGB565 */
    bool no_mips;           /* level 0 only */
    bool bilinear;          /* textured materials are to be interpolated */
    bool texture_keyed;     /* texels of this colour are not there: */
    uint8_t texture_key[3]; /* red, green, blue */
    const char *morph_path; /* a model of the same faces as second key frame; NULL = none. Not with a tree */
    /* How far a tree is: `done` of `of` faces, which grow more as faces are cut. NULL = nobody asks. */
    void (*progress)(void *context, size_t done, size_t of);
    void *progress_context;
} mesh_options_t;

/* Reads a model file through Assimp. Polygons stay polygons, transforms of the node tree are applied, equal positions are
 * joined, every corner gets a normal, and faces are numbered in the order in which Assimp delivers them.
 * 0, or -1 and one line in error when the file is missing, empty, damaged, has a vertex that is not finite, an index out of range,
 * no faces, ... mesh is then cleared. Not for two threads at once: Assimp's log is global. */
int mesh_import(mesh_t *mesh, const char *path, sim_error_t *error);

/* The same with textures, vertex colours and a second key frame, as options say (NULL = all zero); mesh_import is without. An image
 * that is missing or broken, and texture coordinates out of range are errors. What was left out besides is told in
 * mesh->warnings. */
int mesh_import_with(mesh_t *mesh, const char *path, const mesh_options_t *options, sim_error_t *error);

/* Triangulates and reduces to at most max_faces triangles (>= 1), which are numbered anew from 0 and get new normals. A mesh
 * that makes no more triangles than that is left as it is, polygons and all. -1 when it cannot be reduced so far: mesh is
 * then unchanged. */
int mesh_simplify(mesh_t *mesh, size_t max_faces, sim_error_t *error);

typedef struct mesh_tree_report {
    size_t faces_in, faces_out;
    size_t splits;
    size_t convex_nodes, plane_nodes; /* the latter is the complexity of the tree */
    size_t depth;                     /* nodes on the longest path */
    size_t size_bytes;                /* of the section */
    size_t non_planar;                /* polygons cut into triangles because they are not flat on the grid of steps */
    size_t seam_corners;              /* corners inserted where others were cut */
    size_t dropped;                   /* pieces without an area once rounded */
} mesh_tree_report_t;

typedef struct mesh_report {
    size_t vertices; /* of all clusters, so those on borders more than once */
    size_t faces;
    size_t polygons;   /* faces with more than three corners among them */
    size_t non_planar; /* polygons cut into triangles because they are not planar */
    size_t split;      /* polygons cut for another reason: over 255 corners, not convex and lit unevenly, or as asked for */
    size_t skipped;    /* degenerate faces left out, by the importer or because they have no area once quantised */
    size_t clusters;
    size_t size_bytes;
    mesh_tree_report_t tree;   /* zeros without a tree, and of one that was loaded */
    char warnings[512];        /* lines for people, of import and simplification */
    double quantisation_error; /* largest distance of a vertex from its quantised place, model units; 0 = exact */
} mesh_report_t;

/* Compiles to the bytes of geometry/model.h; *bytes is malloc'ed, 4-byte aligned. The same mesh gives the same bytes.
 * options NULL = all zero; report may be NULL. -1 when no face is left, or the model does not fit options->step. */
int mesh_compile(const mesh_t *mesh, const mesh_options_t *options, uint8_t **bytes, size_t *size_bytes, mesh_report_t *report,
                 sim_error_t *error);

/* Writes a .tuile or a .c file (by the path's end), whole or not at all: a file of that name is replaced only by a complete one.
 * A .c file defines one object, `const uint32_t name[]`; name NULL or "" = made from the file's name. -1 when name is no C
 * identifier, or the file cannot be written. */
int mesh_write(const uint8_t *bytes, size_t size_bytes, const char *path, const char *name, sim_error_t *error);

/* Loads whatever a user may name: .tuile bytes as they are (known by their first four), anything else through import and compile
 * with options (NULL = all zero). max_faces 0 = all; faces that a tree cuts are counted before. A .tuile with more faces than
 * that is refused, and so is one without a tree, or with polygons, where options ask for a tree or for triangles. report may be
 * NULL; of a .tuile it has the counts that the file tells. *bytes is malloc'ed, 4-byte aligned. */
int mesh_load(const char *path, size_t max_faces, const mesh_options_t *options, uint8_t **bytes, size_t *size_bytes,
              mesh_report_t *report, sim_error_t *error);

#endif
