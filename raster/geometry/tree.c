/* Checking a display tree (model.h) in one pass and without memory.
 *
 * Nodes lie behind their parents, so there can be no cycle once each node but the root has exactly one parent. A node that follows
 * a node with a first child is that child. Any other is a second child: it names its parent, and the parent names it; as there are
 * no more second children than parents that name one, each has one. That a named place is a node and not the middle of one is
 * told by bit 0, which has been checked for every word before it.
 */
#include "tree.h"

#define N_LIMIT (INT32_C(1) << 30)
#define D_LIMIT ((int64_t)1 << 48)
#define RESERVED 0xe0u

static bool words_even(const uint8_t *words, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        if (words[4 * (size_t)i] & TREE_START) { return false; }
    }
    return true;
}

/* Faces first ... first + count - 1 begin in cluster number k, where k only moves on. */
static bool check_cluster(const tuile_model_t *model, uint32_t first, uint32_t named, uint32_t *k) {
    for (; *k < model->cluster_count; ++*k) {
        const uint8_t *cluster = model->clusters + (size_t)*k * MODEL_CLUSTER_BYTES;
        if (first - model_u32(cluster + CLUSTER_AT_FIRST_FACE) < model_u16(cluster + CLUSTER_AT_FACE_COUNT)) { break; }
    }
    return *k == named;
}

static bool check_plane(const uint8_t *node) {
    const tree_plane_t plane = tree_plane(node);
    bool any = false;
    for (unsigned i = 0; i < 3; i++) {
        if (plane.n[i] <= -N_LIMIT || plane.n[i] >= N_LIMIT) { return false; }
        any |= plane.n[i] != 0;
    }
    return any && plane.d > -D_LIMIT && plane.d < D_LIMIT;
}

bool tree_check(const tuile_model_t *model) {
    const uint8_t *tree = model->tree;
    const uint32_t words = model->tree_words;
    uint32_t at = 0, faces = 0, cluster = 0, links = 0, seconds = 0;
    bool second = false;

    if (words >= UINT32_C(1) << 28 || model->tree_depth == 0) { return false; }
    while (at < words) {
        uint32_t parent = 0;
        if (second) {
            parent = tree_word(tree, at) >> 1;
            if (!words_even(tree + 4 * (size_t)at, 1) || parent >= at) { return false; }
            if (++at == words) { return false; }
        }
        const uint8_t *node = tree + 4 * (size_t)at;
        const uint32_t word = tree_word(tree, at), size = TREE_KIND(word) == TREE_CONVEX ? TREE_CONVEX_WORDS : TREE_PLANE_WORDS;
        if (!(word & TREE_START) || word & RESERVED || TREE_KIND(word) < TREE_CONVEX || TREE_KIND(word) > TREE_PLANE ||
            ((word & TREE_SECOND) != 0) != second || words - at < size || !words_even(node + 4, size - 1)) {
            return false;
        }
        if (second) {
            const uint32_t above = tree_word(tree, parent);
            if (!(above & TREE_START) || TREE_KIND(above) != TREE_PLANE || tree_second(tree + 4 * (size_t)parent) != at) {
                return false;
            }
            seconds++;
        }
        if (TREE_KIND(word) == TREE_CONVEX) {
            const tree_convex_t set = tree_convex(node);
            if (set.first != faces || set.inward > model->face_count - faces ||
                set.outward > model->face_count - faces - set.inward || set.inward + set.outward == 0 ||
                !check_cluster(model, faces, set.cluster, &cluster)) {
                return false;
            }
            faces += set.inward + set.outward;
        } else {
            const uint32_t to = tree_second(node);
            if (TREE_VALUE(word) != 0 || !check_plane(node) || (to == 0 && !(word & TREE_FIRST)) || (to != 0 && to <= at)) {
                return false;
            }
            links += to != 0;
        }
        at += size;
        second = !(word & TREE_FIRST);
    }
    return second && faces == model->face_count && links == seconds;
}
