/* The nodes of a display tree as the words of model.h. */
#include "tree.h"

#define NODES_DEEP_MAX 65535u
#define WORDS_MAX (1u << 31) /* places are stored shifted by one */

static bool put(tree_t *tree, uint32_t word) {
    if (tree->word_count + 1 >= WORDS_MAX ||
        !mesh_reserve(&tree->words, &tree->word_capacity, tree->word_count + 1, sizeof *tree->words)) {
        return false;
    }
    tree->words[tree->word_count++] = word;
    return true;
}

/* The value of `bits` bits, by its two's complement, above bit 0. */
static bool put_value(tree_t *tree, int64_t value) { return put(tree, (uint32_t)((uint64_t)value << 1)); }

/* The cluster of a face; faces come in rising order. */
static uint32_t cluster_of(const clusters_t *clusters, uint32_t *at, uint32_t face) {
    while (clusters->first[*at + 1] <= face) {
        ++*at;
    }
    return *at;
}

static bool put_node(tree_t *tree, const tree_node_t *node, bool is_second, uint32_t cluster) {
    const uint32_t head = TREE_START | node->kind << 1 | (node->child[0] != TREE_NO_NODE ? TREE_FIRST : 0) |
                          (is_second ? TREE_SECOND : 0) | cluster << 8;
    if (node->kind == TREE_CONVEX) {
        return put(tree, head) && put_value(tree, node->first) && put_value(tree, node->inward) && put_value(tree, node->outward);
    }
    const tree_plane_t *plane = &tree->planes[node->plane];
    const int64_t low = plane->d & ((1 << 30) - 1), high = (plane->d - low) / (1 << 30);
    return put(tree, head) && put_value(tree, 0) && put_value(tree, plane->n[0]) && put_value(tree, plane->n[1]) &&
           put_value(tree, plane->n[2]) && put_value(tree, low) && put_value(tree, high);
}

int tree_write_words(tree_t *tree, const clusters_t *clusters, sim_error_t *error) {
    if (tree->depth > NODES_DEEP_MAX || clusters->count > TREE_CLUSTERS_MAX) {
        return sim_fail(error, "the display tree is %zu nodes deep and has %zu clusters, more than the %u and %u of the format",
                        tree->depth, clusters->count, NODES_DEEP_MAX, TREE_CLUSTERS_MAX);
    }
    uint32_t *second_of = mesh_array(tree->node_count, sizeof *second_of), cluster = 0; /* a parent's word + 1, or 0 */
    bool good = second_of != NULL;
    for (size_t n = 0; good && n < tree->node_count; n++) {
        const tree_node_t *node = &tree->nodes[n];
        if (second_of[n]) {
            const uint32_t parent = second_of[n] - 1;
            good = put_value(tree, parent);
            if (good) { tree->words[parent + 1] = (uint32_t)tree->word_count << 1; }
        }
        if (good && node->child[1] != TREE_NO_NODE) { second_of[node->child[1]] = (uint32_t)tree->word_count + 1; }
        good = good &&
               put_node(tree, node, second_of[n] != 0, node->kind == TREE_CONVEX ? cluster_of(clusters, &cluster, node->first) : 0);
    }
    free(second_of);
    return good ? 0 : sim_fail(error, "the display tree of %zu nodes does not fit", tree->node_count);
}
