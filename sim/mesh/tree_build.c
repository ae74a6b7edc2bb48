/* From a list of pieces to nodes (S11), with a stack of its own: trees may be thousands of nodes deep. */
#include "tree.h"

#include <string.h>

void tree_free(tree_t *tree) {
    free(tree->nodes);
    free(tree->pieces);
    free(tree->reversed);
    free(tree->planes);
    free(tree->words);
    *tree = (tree_t){0};
}

/* A list that waits to be compiled. */
typedef struct task {
    uint32_t *pieces;
    size_t count;
    uint32_t parent; /* its node will be the child of this one */
    uint32_t which;
    size_t planes_above[2]; /* support planes of the parent's list, and of its parent's */
} task_t;

typedef struct builder {
    tree_t *tree;
    space_t *space;
    const mesh_options_t *options;
    tree_list_t list;
    task_t *stack;
    size_t task_count, task_capacity;
    size_t placed; /* pieces that have a node */
    bool unsound;
} builder_t;

static bool push(builder_t *b, task_t task) {
    if (!mesh_reserve(&b->stack, &b->task_capacity, b->task_count + 1, sizeof *b->stack)) { return false; }
    b->stack[b->task_count++] = task;
    return true;
}

static uint32_t new_node(builder_t *b, const task_t *task, uint32_t kind) {
    tree_t *tree = b->tree;
    if (tree->node_count >= TREE_NO_NODE - 1 ||
        !mesh_reserve(&tree->nodes, &tree->node_capacity, tree->node_count + 1, sizeof *tree->nodes)) {
        return TREE_NO_NODE;
    }
    const uint32_t node = (uint32_t)tree->node_count++;
    tree->nodes[node] = (tree_node_t){.kind = kind, .first = (uint32_t)tree->piece_count, .child = {TREE_NO_NODE, TREE_NO_NODE}};
    if (task->parent != TREE_NO_NODE) { tree->nodes[task->parent].child[task->which] = node; }
    return node;
}

static bool place_piece(builder_t *b, uint32_t piece, bool reversed) {
    tree_t *tree = b->tree;
    if (!mesh_reserve(&tree->pieces, &tree->piece_capacity, tree->piece_count + 1, sizeof *tree->pieces) ||
        !mesh_reserve(&tree->reversed, &tree->reversed_capacity, tree->piece_count + 1, sizeof *tree->reversed)) {
        return false;
    }
    tree->pieces[tree->piece_count] = piece;
    tree->reversed[tree->piece_count++] = reversed;
    b->placed++;
    return true;
}

/* Does the list lie on the side that the face's normal points to? One that lies in the plane itself has no inside; the back of its
 * first face is taken for that, so that faces seen from the front and from the back are drawn at the same time, and the first of
 * them wins a tie. */
static bool looks_inward(const builder_t *b, uint32_t piece) {
    const space_face_t *face = &b->space->faces[b->space->pieces[piece].face];
    const space_face_t *first = &b->space->faces[b->space->pieces[b->list.pieces[0]].face];
    const int8_t side = b->list.hull[face->plane];
    return side == (face->turned ? HULL_MINUS : HULL_PLUS) || (side == HULL_FLAT && face->turned != first->turned);
}

/* The faces on the hull to a node, the rest to its child. False: task->pieces is still the caller's, here and below. */
static bool make_convex(builder_t *b, const task_t *task) {
    const uint32_t node = new_node(b, task, TREE_CONVEX);
    size_t left = 0;
    if (node == TREE_NO_NODE) { return false; }
    tree_node_t *at = &b->tree->nodes[node];
    for (int outward = 0; outward < 2; outward++) {
        for (size_t i = 0; i < task->count; i++) {
            const uint32_t piece = task->pieces[i];
            if (b->list.hull[b->space->faces[b->space->pieces[piece].face].plane] == HULL_INSIDE) { continue; }
            const bool inward = looks_inward(b, piece), turn = inward && b->options->two_sided;
            if ((inward && !turn) == (outward == 1)) { continue; }
            if (!place_piece(b, piece, turn)) { return false; }
            ++*(outward ? &at->outward : &at->inward);
        }
    }
    for (size_t i = 0; i < task->count; i++) {
        if (b->list.hull[b->space->faces[b->space->pieces[task->pieces[i]].face].plane] == HULL_INSIDE) {
            task->pieces[left++] = task->pieces[i];
        }
    }
    task_t child = {.pieces = task->pieces, .count = left, .parent = node};
    child.planes_above[0] = b->list.plane_count;
    child.planes_above[1] = task->planes_above[0];
    if (!left) {
        free(task->pieces);
        return true;
    }
    return push(b, child);
}

/* Faces in the plane go to the plus side, all of them: they are on the hull of that child, which is what the proof of termination
 * needs.
 */
static bool share_out(builder_t *b, const task_t *task, uint32_t plane, task_t children[2]) {
    for (size_t i = 0; i < task->count; i++) {
        uint32_t parts[2] = {task->pieces[i], task->pieces[i]};
        const unsigned sides = tree_sides(b->space, task->pieces[i], plane);
        if (sides == 3 && !space_cut(b->space, task->pieces[i], plane, parts)) { return false; }
        if (sides != 2) { children[0].pieces[children[0].count++] = parts[0]; }
        if (sides & 2) { children[1].pieces[children[1].count++] = parts[1]; }
    }
    return true;
}

static bool make_plane(builder_t *b, const task_t *task) {
    const uint32_t node = new_node(b, task, TREE_PLANE), plane = tree_list_choose(&b->list);
    if (node == TREE_NO_NODE) { return false; }
    b->tree->nodes[node].plane = plane;
    task_t children[2];
    for (uint32_t i = 0; i < 2; i++) {
        children[i] = (task_t){.pieces = mesh_array(task->count, sizeof *task->pieces), .parent = node, .which = i};
        children[i].planes_above[0] = b->list.plane_count;
        children[i].planes_above[1] = task->planes_above[0];
    }
    const bool shared = children[0].pieces && children[1].pieces && share_out(b, task, plane, children);
    if (!shared || !push(b, children[1])) { free(children[1].pieces); }
    if (!shared || !push(b, children[0])) { /* on top: the first child is next */
        free(children[0].pieces);
        return false;
    }
    free(task->pieces);
    return true;
}

static void tell(const builder_t *b) {
    const mesh_options_t *options = b->options;
    if (options->progress) { options->progress(options->progress_context, b->placed, b->space->face_count + b->space->splits); }
}

/* The next list. The number of its support planes falls strictly from a list to its grandchildren (3.3 in the document): that is
 * why all this ends, and it is checked. */
static bool next(builder_t *b) {
    const task_t task = b->stack[--b->task_count];
    if (!tree_list_look(&b->list, b->space, task.pieces, task.count)) {
        free(task.pieces);
        return false;
    }
    b->unsound = task.planes_above[1] && b->list.plane_count >= task.planes_above[1];
    const bool convex = tree_list_hull(&b->list);
    if (b->unsound || !(convex ? make_convex(b, &task) : make_plane(b, &task))) {
        free(task.pieces);
        return false;
    }
    return true;
}

int tree_build(tree_t *tree, space_t *space, const mesh_options_t *options, sim_error_t *error) {
    builder_t b = {.tree = tree, .space = space, .options = options};
    task_t all = {
        .pieces = mesh_array(space->piece_count, sizeof *all.pieces), .count = space->piece_count, .parent = TREE_NO_NODE};
    bool good = all.pieces != NULL && all.count > 0;
    for (size_t i = 0; good && i < all.count; i++) {
        all.pieces[i] = (uint32_t)i;
    }
    if (!good || !push(&b, all)) {
        good = false;
        free(all.pieces);
    }
    while (good && b.task_count) {
        good = next(&b);
        tell(&b);
    }
    while (b.task_count) {
        free(b.stack[--b.task_count].pieces);
    }
    free(b.stack);
    tree_list_close(&b.list);
    if (b.unsound) {
        return sim_fail(error, "internal: a display tree did not come nearer to its end at node %zu", tree->node_count);
    }
    return good ? 0 : sim_fail(error, "out of memory for the display tree of %zu faces", space->face_count);
}
