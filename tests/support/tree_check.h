/* A reader of our own of the display tree in a compiled model, and what has to hold of every tree, checked on the model's bytes.
 *
 * Models are compiled with a step of 1 from whole coordinates, and faces of more than three corners are flat. Then the plane of a
 * face is known exactly, by its number, whatever pieces it was cut into; and no corner of a piece is further than sqrt(3) / 2 from
 * where it would be without rounding. */
#ifndef TESTS_SUPPORT_TREE_CHECK_H
#define TESTS_SUPPORT_TREE_CHECK_H

#include "decoder.h"
#include "random.h"

typedef struct tree_check_node {
    unsigned kind; /* TREE_CONVEX, TREE_PLANE */
    uint32_t first, inward, outward, cluster;
    int64_t n[3], d;
    int child[2]; /* -1: none */
    unsigned depth;
    uint32_t faces_first, faces_end; /* of all nodes below and itself */
} tree_check_node_t;

typedef struct tree_check {
    tree_check_node_t *nodes; /* in preorder */
    int node_count;
    unsigned convex_nodes, plane_nodes, depth;
} tree_check_t;

/* Reads the section word by word; fails the test where it is not what model.h says, or the report says otherwise. */
tree_check_t tree_check_read(const compiled_t *c);
void tree_check_free(tree_check_t *tree);

/* The faces of a convex node have all others of it, and all below it, on the side that their list says; the children of a plane lie
 * on its two sides. */
void tree_check_sides(const compiled_t *c, const tree_check_t *tree);

/* The pieces of each face of the mesh have its area and material together. */
void tree_check_areas(const compiled_t *c);

/* Each side of a face has its opposite as often, all positions rounded. For closed models. */
void tree_check_closed(const compiled_t *c);

/* From random eyes along random rays, what is nearer is drawn later. Returns how many pairs of faces were compared. */
size_t tree_check_order(const compiled_t *c, const tree_check_t *tree, int eyes, int rays, random_source_t *random);

/* Compiles, reads and does all of the above; closed: the last but one too. */
tree_check_t tree_check_all(compiled_t *c, bool closed, const mesh_options_t *options);

#endif
