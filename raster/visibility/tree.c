/* The compiled display tree (S9, S10): the painter's order without a sort.
 *
 * A walk over the tree of each model names its faces from back to front wherever the observer stands, inside the model too. At a
 * plane the half behind it comes first; at a convex set first come the faces whose inside is seen, then what lies inside, then the
 * faces whose outside is seen. A plane costs one dot product; the side of a face is the signed area that culls back faces anyway.
 * Faces become records in the order of the walk and are painted in that order: no depth is kept and none is computed.
 *
 * Memory: no depth. In a pass, beside vertices and records, 2 bytes for each cluster of the largest model, which tell where its
 * vertices stand once some face has wanted them, and 4 bytes for each level of the deepest tree (config.tree_depth). When a pass is
 * one tile and drawn as it comes, only one cluster is kept.
 *
 * Ties: of coplanar faces the one with the lower index is seen, so it is painted later: sets are walked backwards (forwards with
 * TUILE_TIE_LAST). Coplanar faces that overlap are never parted by the compiler.
 *
 * Order is exact, corners are snapped to 1/16 pixel: when the eye is in a plane of the tree, a face that ends at it may reach over
 * a pixel's centre that belongs to the other side, and be painted later though it lies behind. That happens to pixels within 1/16
 * pixel of such a line, a few in a million (tests/test_tree_draw.c).
 */
#include "../tune.h"

#include "arrange.h"
#include "paint.h"
#include "painter.h"
#include "piece.h"

#include "../geometry/tree.h"

#define CLUSTER_UNSEEN 0xffffu
#define CLUSTER_CULLED 0xfffeu
#define AFTER 0x80000000u /* on the stack: a convex set whose child has been drawn */

typedef struct walk {
    uint32_t *stack;
    uint32_t stack_count;
    uint32_t cluster;        /* immediate pass: whose vertices are there; UINT32_MAX: none */
    frame_cluster_t current; /* immediate pass */
    unsigned outer, inner;   /* the SIDE_ of the window on which the outside, the inside of an outward face is seen */
    bool two_sided, backwards;
} walk_t;

/* The cluster's vertices, wherever they are. FRAME_OK, BIN_CULLED or FRAME_FULL. */
static int cluster_find(tuile_t *t, walk_t *walk, uint32_t k, frame_cluster_t *cluster) {
    const uint8_t *bytes = t->instance->model->clusters + (size_t)k * MODEL_CLUSTER_BYTES;
    if (t->immediate) {
        int result = FRAME_OK;
        if (walk->cluster != k) {
            t->vertex_count = 0;
            walk->cluster = k;
            result = bin_cluster_open(t, bytes, &walk->current);
            if (result == BIN_CULLED) { walk->current.bytes = NULL; }
        }
        *cluster = walk->current;
        return result == FRAME_OK && cluster->bytes == NULL ? BIN_CULLED : result;
    }
    uint16_t *slot = &t->cluster_slots[k];
    if (*slot == CLUSTER_CULLED) { return BIN_CULLED; }
    if (*slot != CLUSTER_UNSEEN) {
        bin_cluster_at(t, bytes, *slot, cluster);
        return FRAME_OK;
    }
    const uint32_t mark = t->vertex_count;
    if (mark + SOURCE_SLOTS >= CLUSTER_CULLED) { return FRAME_FULL; }
    const int result = bin_cluster_open(t, bytes, cluster);
    if (result == FRAME_OK) { *slot = (uint16_t)(cluster->vertices - t->vertices); }
    if (result == BIN_CULLED) { *slot = CLUSTER_CULLED; }
    return result;
}

/* Faces first ... end - 1 of cluster k, as far as they show one of `sides`. */
static int draw_part(tuile_t *t, walk_t *walk, uint32_t k, uint32_t first, uint32_t end, unsigned sides) {
    const uint8_t *bytes = t->instance->model->clusters + (size_t)k * MODEL_CLUSTER_BYTES;
    const uint32_t base = model_u32(bytes + CLUSTER_AT_FIRST_FACE), mark = t->vertex_count, binned = t->record_count;
    frame_cluster_t cluster;
    int result = cluster_find(t, walk, k, &cluster);
    if (result != FRAME_OK) { return result == BIN_CULLED ? FRAME_OK : result; }
    t->sides = (uint8_t)sides;
    result = face_bin_run(t, &cluster, first - base, end - base, walk->backwards);
    if (!t->immediate && t->record_count == binned && end - first == model_u16(bytes + CLUSTER_AT_FACE_COUNT)) {
        /* None of its faces is left, and no other set has faces there. */
        if (t->vertex_count > mark) { t->cluster_slots[k] = CLUSTER_UNSEEN; }
        pass_give_back(t, mark);
    }
    return result;
}

static uint32_t cluster_first(const tuile_model_t *model, uint32_t k) {
    return model_u32(model->clusters + (size_t)k * MODEL_CLUSTER_BYTES + CLUSTER_AT_FIRST_FACE);
}

static uint32_t cluster_end(const tuile_model_t *model, uint32_t k) {
    return cluster_first(model, k) + model_u16(model->clusters + (size_t)k * MODEL_CLUSTER_BYTES + CLUSTER_AT_FACE_COUNT);
}

/* Faces first ... end - 1 of the model; `cluster` has the first of them or comes before it. */
static int draw_run(tuile_t *t, walk_t *walk, uint32_t cluster, uint32_t first, uint32_t end, unsigned sides) {
    const tuile_model_t *model = t->instance->model;
    uint32_t k = cluster, last;
    int result = FRAME_OK;
    if (first == end || sides == 0) { return FRAME_OK; }
    while (cluster_end(model, k) <= first) {
        k++;
    }
    for (last = k; cluster_end(model, last) < end; last++) {}
    for (uint32_t i = 0; i <= last - k && result == FRAME_OK; i++) {
        const uint32_t c = walk->backwards ? last - i : k + i;
        const uint32_t from = cluster_first(model, c) > first ? cluster_first(model, c) : first,
                       to = cluster_end(model, c) < end ? cluster_end(model, c) : end;
        result = draw_part(t, walk, c, from, to, sides);
    }
    return result;
}

/* The faces of a set that show their inside (`outside` false) or their outside. */
static int draw_set(tuile_t *t, walk_t *walk, const tree_convex_t *set, bool outside) {
    const unsigned wanted = walk->two_sided ? SIDE_FRONT | SIDE_BACK : SIDE_FRONT;
    const unsigned outward = (outside ? walk->outer : walk->inner) & wanted,
                   inward = (outside ? walk->inner : walk->outer) & wanted;
    const uint32_t middle = set->first + set->inward, end = middle + set->outward;
    const int result = walk->backwards ? draw_run(t, walk, set->cluster, middle, end, outward)
                                       : draw_run(t, walk, set->cluster, set->first, middle, inward);
    if (result != FRAME_OK) { return result; }
    return walk->backwards ? draw_run(t, walk, set->cluster, set->first, middle, inward)
                           : draw_run(t, walk, set->cluster, middle, end, outward);
}

static bool push(const tuile_t *t, walk_t *walk, uint32_t entry) {
    if (walk->stack_count >= t->config.tree_depth) { return false; }
    walk->stack[walk->stack_count++] = entry;
    return true;
}

/* From the node at `at` down, following what comes first; what comes later goes on the stack. */
static int descend(tuile_t *t, walk_t *walk, uint32_t at) {
    const uint8_t *tree = t->instance->model->tree;
    for (;;) {
        const uint8_t *node = tree + 4 * (size_t)at;
        const uint32_t word = model_u32(node);
        t->stats.nodes++;
        if (TREE_KIND(word) == TREE_CONVEX) {
            const tree_convex_t set = tree_convex(node);
            int result = draw_set(t, walk, &set, false);
            if (result == FRAME_OK && !(word & TREE_FIRST)) { result = draw_set(t, walk, &set, true); }
            if (result != FRAME_OK || !(word & TREE_FIRST)) { return result; }
            if (!push(t, walk, at | AFTER)) { return TUILE_ERROR_MODEL; }
            at += TREE_CONVEX_WORDS;
        } else {
            const tree_plane_t plane = tree_plane(node);
            const bool plus = tree_side(&plane, &t->transform) >= 0;
            const uint32_t first = word & TREE_FIRST ? at + TREE_PLANE_WORDS : 0, second = tree_second(node);
            const uint32_t far = plus ? second : first, near = plus ? first : second;
            if (far && near && !push(t, walk, near)) { return TUILE_ERROR_MODEL; }
            at = far ? far : near;
        }
    }
}

/* One instance, back to front. */
static int draw_instance(tuile_t *t, unsigned number) {
    walk_t walk = {.stack = t->tree_stack, .cluster = UINT32_MAX, .backwards = t->config.tie == TUILE_TIE_FIRST};
    int result = bin_instance_open(t, number);
    if (result != FRAME_OK) { return result == BIN_CULLED ? FRAME_OK : result; }
    const tuile_model_t *model = t->instance->model;
    walk.two_sided = (t->sides & SIDE_BACK) != 0;
    walk.outer = t->transform.mirrored ? SIDE_BACK : SIDE_FRONT;
    walk.inner = walk.outer ^ (SIDE_FRONT | SIDE_BACK);
    for (uint32_t k = 0; !t->immediate && k < model->cluster_count; k++) {
        t->cluster_slots[k] = CLUSTER_UNSEEN;
    }
    result = descend(t, &walk, 0);
    while (result == FRAME_OK && walk.stack_count > 0) {
        const uint32_t entry = walk.stack[--walk.stack_count];
        if (entry & AFTER) {
            const tree_convex_t set = tree_convex(model->tree + 4 * (size_t)(entry & ~AFTER));
            result = draw_set(t, &walk, &set, true);
        } else {
            result = descend(t, &walk, entry);
        }
    }
    return result;
}

static int tree_gather(tuile_t *t) {
    const unsigned count = t->scene->instance_count;
    bool grouped = false;
    bin_begin(t);
    for (unsigned i = 0; i < count;) {
        unsigned end = i + 1;
        while (end < count && !(t->instance_order[end] & ARRANGE_FIRST)) {
            end++;
        }
        const uint32_t first = t->record_count;
        for (unsigned k = i; k < end; k++) {
            const unsigned number = t->instance_order[k] & ~ARRANGE_FIRST;
            const int result = end - i > 1 ? bin_instance(t, number) : draw_instance(t, number);
            if (result != FRAME_OK) { return result; }
        }
        if (end - i > 1) {
            const int result = painter_order(t, first, t->record_count);
            if (result != FRAME_OK) { return result; }
            grouped = true;
        }
        i = end;
    }
    if (grouped) { bin_again(t, t->pass_first); } /* their records have moved */
    return FRAME_OK;
}

/* Stack, cluster slots and the order of instances at the start of the arena. */
static int tree_begin(tuile_t *t, uint8_t **arena) {
    const tuile_scene_t *scene = t->scene;
    uint32_t clusters = 0;
    for (unsigned i = 0; i < scene->instance_count; i++) {
        const tuile_model_t *model = scene->instances[i].model;
        if (model->tree == NULL) { return TUILE_ERROR_TREE; }
        if (model->tree_depth > t->config.tree_depth) { return TUILE_ERROR_LIMITS; }
        if (model->cluster_count > clusters) { clusters = model->cluster_count; }
    }
    const size_t order = TUILE_ALIGN8(2 * (size_t)scene->instance_count), stack = TUILE_ALIGN8(4 * (size_t)t->config.tree_depth);
    const size_t slots = TUILE_ALIGN8(2 * (size_t)clusters), room = (size_t)(t->arena_end - *arena);
    const size_t least = TUILE_CLIP_BYTES + 8 * (size_t)t->config.cluster_vertices + TUILE_CORNERS_BYTES(t->config.corners);
    t->tree_stack = (uint32_t *)(void *)*arena;
    t->instance_order = (uint16_t *)(void *)(*arena + stack);
    if (stack + order + least > room) {
        t->wanted_bytes = (size_t)t->stats.size_bytes + (stack + order + least - room);
        return TUILE_ERROR_MEMORY;
    }
    *arena += stack + order;
    const int grouped = arrange_instances(t, *arena, (size_t)(t->arena_end - *arena));
    if (grouped < 0) { return grouped; }
    t->stats.instances_sorted = (uint32_t)grouped;
    t->keep = grouped > 0; /* the painter wants all faces of a group at once */
    if (stack + order + slots + least <= room) {
        t->cluster_slots = (uint16_t *)(void *)*arena;
        *arena += slots;
        pass_reaches(t, *arena + least);
    } else if (t->keep) {
        t->wanted_bytes = (size_t)t->stats.size_bytes + (stack + order + slots + least - room);
        return TUILE_ERROR_MEMORY;
    } else {
        t->immediate_only = true; /* no room for the slots */
    }
    return TUILE_OK;
}

const visibility_method_t visibility_tree = {
    .begin = tree_begin,
    .gather = tree_gather,
    .draw_now = paint_draw_now,
    .draw_tile = paint_draw_tile,
    .piece_mask = piece_mask,
};
