/* The compiler of the display tree (S11): what its stages hand to one another.
 *
 *   solid  ->  pieces (tree_space)  ->  nodes (tree_build, with tree_list)  ->  a solid of more faces, in the order of the tree
 *   (tree_solid)  ->  clusters in that order (tree_cluster)  ->  words (tree_words)
 */
#ifndef SIM_MESH_TREE_H
#define SIM_MESH_TREE_H

#include "tree_space.h"

#define TREE_NO_NODE UINT32_MAX

typedef struct tree_node {
    uint32_t kind;                   /* TREE_CONVEX, TREE_PLANE */
    uint32_t plane;                  /* of a plane node: in tree_t.planes, in the space while building */
    uint32_t first, inward, outward; /* of a convex node: its faces; pieces in tree_t.pieces while building */
    uint32_t child[2];               /* a convex node has at most the first */
} tree_node_t;

typedef struct tree_plane {
    int64_t n[3], d;
} tree_plane_t;

typedef struct tree {
    tree_node_t *nodes; /* in preorder */
    uint32_t *pieces;   /* while building */
    uint8_t *reversed;  /* of each entry of pieces: turn it round (two-sided faces) */
    tree_plane_t *planes;
    uint32_t *words;
    size_t node_count, piece_count, plane_count, word_count;
    size_t node_capacity, piece_capacity, reversed_capacity, word_capacity;
    size_t depth; /* nodes on the longest path */
} tree_t;

void tree_free(tree_t *tree);

/* ---- tree_list.c: what is asked about a list of pieces ------------------------------------------------------ */

#define TREE_CUTS_KEPT 6u
/* What a plane costs: so much for each piece that it cuts, and the difference between the numbers of pieces on its two sides. Cuts
 * alone, balance only between equals, is the document's example, and poor: planes near the hull cut little, part off next to
 * nothing, and the faces far away are cut again and again. DESIGN.md has the figures; 5 to 12 are about as good. */
#define TREE_COST_CUT 8u

typedef struct tree_list {
    const space_t *space;
    const uint32_t *pieces; /* the list at hand */
    size_t count;
    uint32_t round; /* what is marked with it belongs to the list at hand */
    uint32_t *plane_round, *point_round, *piece_round;
    size_t plane_round_capacity, point_round_capacity, piece_round_capacity;
    uint32_t *planes, *points; /* its support planes and points, each once */
    size_t plane_count, point_count, plane_capacity, point_capacity;
    uint32_t (*witnesses)[2];         /* of each plane: points found on its plus and minus side, in lists before too */
    int8_t *hull;                     /* of each plane of the list, after tree_list_hull */
    uint32_t (*cuts)[TREE_CUTS_KEPT]; /* of each plane: pieces that it cut when last tried */
    size_t witness_capacity, hull_capacity, cut_capacity;
} tree_list_t;

enum { HULL_INSIDE = 0, HULL_PLUS = 1, HULL_MINUS = -1, HULL_FLAT = 2 };

void tree_list_close(tree_list_t *list);

/* Looks at a list: marks it and collects its planes and points. */
bool tree_list_look(tree_list_t *list, const space_t *space, const uint32_t *pieces, size_t count);

/* list->hull of each of its planes: the side on which the whole list lies, HULL_INSIDE where it lies on both, HULL_FLAT on none.
 * Returns whether any plane is not inside. */
bool tree_list_hull(tree_list_t *list);

/* The support plane that costs least: TREE_COST_CUT for each piece that it cuts, and the difference of the numbers of pieces on its
 * sides (those in the plane count as plus). Each of them must have points of the list on both sides. */
uint32_t tree_list_choose(tree_list_t *list);

/* Bit 0: the piece has corners on the plus side; bit 1: on the minus side. */
unsigned tree_sides(const space_t *space, uint32_t piece, uint32_t plane);

/* ---- tree_build.c ------------------------------------------------------------------------------------------- */

int tree_build(tree_t *tree, space_t *space, const mesh_options_t *options, sim_error_t *error);

/* ---- tree_solid.c ------------------------------------------------------------------------------------------- */

typedef struct tree_counts {
    size_t seam_corners, dropped;
} tree_counts_t;

/* A solid of the pieces in the order of the nodes; the nodes then name its faces, and the planes of the tree are rounded ones. */
int tree_make_solid(tree_t *tree, space_t *space, solid_t *out, const mesh_options_t *options, tree_counts_t *counts,
                    sim_error_t *error);

/* ---- tree_cluster.c ----------------------------------------------------------------------------------------- */

/* Puts the faces of large nodes in an order that makes good clusters. planes: a number that coplanar faces share. */
int tree_arrange(const tree_t *tree, solid_t *solid, uint32_t *planes, sim_error_t *error);

/* Cuts the faces into clusters as they come. */
int tree_cut_clusters(const tree_t *tree, const solid_t *solid, clusters_t *clusters, sim_error_t *error);

/* ---- tree_words.c ------------------------------------------------------------------------------------------- */

/* The section of model.h. */
int tree_write_words(tree_t *tree, const clusters_t *clusters, sim_error_t *error);

#endif
