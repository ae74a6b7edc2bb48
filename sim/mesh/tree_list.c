/* What the display tree's compiler asks about a list of pieces: which of its planes have all of it on one side, and which plane
 * parts it best.
 *
 * Both questions are asked of every list, and lists of one tree are much alike: a child is its parent without a few pieces. So each
 * plane remembers what decided about it last. A plane is not on the hull as long as one point on either side of it, found once, is
 * still in the list; and it is no candidate as long as the pieces that it still cuts, found once, make it dearer than the best
 * plane.
 */
#include "tree.h"

#include <math.h>
#include <string.h>

/* A plane is tried on all pieces, but given up as soon as it costs more than the best one. So all can be tried, and are, in models
 * of 36 000 triangles and some more. Beyond, when so many corners have been looked at for one node, the best plane so far is taken:
 * those tried first are those that cut fewest when last tried, in the order of their faces. */
#define CHOICE_WORK 1000000000u

void tree_list_close(tree_list_t *list) {
    void *owned[] = {list->plane_round, list->point_round, list->piece_round, list->planes,
                     list->points,      list->witnesses,   list->hull,        list->cuts};
    for (size_t i = 0; i < sizeof owned / sizeof owned[0]; i++) {
        free(owned[i]);
    }
    *list = (tree_list_t){0};
}

/* As mesh_reserve; what is new is filled with a byte. */
static bool reserve_filled(void *array, size_t *capacity, size_t count, size_t item_bytes, int fill) {
    const size_t before = *capacity;
    if (count <= before) { return true; }
    if (!mesh_reserve(array, capacity, count, item_bytes)) { return false; }
    uint8_t *bytes;
    memcpy(&bytes, array, sizeof bytes);
    memset(bytes + before * item_bytes, fill, (*capacity - before) * item_bytes);
    return true;
}

static bool make_room(tree_list_t *list, const space_t *space) {
    const size_t planes = space->plane_count, points = space->point_count;
    return reserve_filled(&list->plane_round, &list->plane_round_capacity, planes, sizeof *list->plane_round, 0) &&
           reserve_filled(&list->point_round, &list->point_round_capacity, points, sizeof *list->point_round, 0) &&
           reserve_filled(&list->piece_round, &list->piece_round_capacity, space->piece_count, sizeof *list->piece_round, 0) &&
           mesh_reserve(&list->planes, &list->plane_capacity, planes, sizeof *list->planes) &&
           mesh_reserve(&list->points, &list->point_capacity, points, sizeof *list->points) &&
           reserve_filled(&list->witnesses, &list->witness_capacity, planes, sizeof *list->witnesses, 0xff) &&
           reserve_filled(&list->hull, &list->hull_capacity, planes, sizeof *list->hull, 0) &&
           reserve_filled(&list->cuts, &list->cut_capacity, planes, sizeof *list->cuts, 0xff);
}

bool tree_list_look(tree_list_t *list, const space_t *space, const uint32_t *pieces, size_t count) {
    list->space = space;
    if (!make_room(list, space)) { return false; }
    list->pieces = pieces;
    list->count = count;
    list->plane_count = list->point_count = 0;
    list->round++;
    for (size_t i = 0; i < count; i++) {
        const space_piece_t *piece = &space->pieces[pieces[i]];
        const uint32_t plane = space->faces[piece->face].plane;
        list->piece_round[pieces[i]] = list->round;
        if (list->plane_round[plane] != list->round) {
            list->plane_round[plane] = list->round;
            list->planes[list->plane_count++] = plane;
        }
        for (uint32_t c = 0; c < piece->count; c++) {
            const uint32_t point = space->corners[piece->first + c].point;
            if (list->point_round[point] != list->round) {
                list->point_round[point] = list->round;
                list->points[list->point_count++] = point;
            }
        }
    }
    return true;
}

/* ---- the hull ----------------------------------------------------------------------------------------------- */

/* The side on which a point lies for certain: 0 when it may as well lie in the plane, given what rounding to the grid has done to
 * both. A model that was convex before it was rounded is convex, then, and what is drawn out of order for that could not have been
 * told from order in the model as it was. Where the grid holds the model exactly, nothing is given. */
static int certain_side(const space_t *space, uint32_t plane, uint32_t point) {
    const exact_plane_t *p = &space->planes[plane];
    const exact_point_t *q = &space->points[point];
    const int side = exact_side(p, q);
    if (side == 0 || space->rounding <= 0) { return side; }
    const double height = fabs(p->f[0] * q->at[0] + p->f[1] * q->at[1] + p->f[2] * q->at[2] + p->e);
    const double length = sqrt(p->f[0] * p->f[0] + p->f[1] * p->f[1] + p->f[2] * p->f[2]);
    return height > length * SPACE_SLACK_MAX || height > length * space_slack(space, plane, q) ? side : 0;
}

/* A point that showed a plane to be inside is likely to do so again: it moves halfway to the front. */
static int hull_side(tree_list_t *list, uint32_t plane) {
    uint32_t *witness = list->witnesses[plane];
    bool known[2];
    for (int s = 0; s < 2; s++) {
        known[s] = witness[s] != SPACE_NONE && list->point_round[witness[s]] == list->round;
    }
    for (size_t i = 0; i < list->point_count && !(known[0] && known[1]); i++) {
        const int side = certain_side(list->space, plane, list->points[i]);
        const int s = side < 0;
        if (!side || known[s]) { continue; }
        known[s] = true;
        witness[s] = list->points[i];
        list->points[i] = list->points[i / 2];
        list->points[i / 2] = witness[s];
    }
    if (known[0] && known[1]) { return HULL_INSIDE; }
    return known[0] ? HULL_PLUS : known[1] ? HULL_MINUS : HULL_FLAT;
}

bool tree_list_hull(tree_list_t *list) {
    bool any = false;
    for (size_t p = 0; p < list->plane_count; p++) {
        const int side = hull_side(list, list->planes[p]);
        list->hull[list->planes[p]] = (int8_t)side;
        any = any || side != HULL_INSIDE;
    }
    return any;
}

/* ---- the plane that parts best ------------------------------------------------------------------------------ */

unsigned tree_sides(const space_t *space, uint32_t piece_index, uint32_t plane) {
    const space_piece_t *piece = &space->pieces[piece_index];
    unsigned sides = 0;
    for (uint32_t c = 0; c < piece->count && sides != 3; c++) {
        const int side = exact_side(&space->planes[plane], &space->points[space->corners[piece->first + c].point]);
        sides |= side > 0 ? 1u : side < 0 ? 2u : 0u;
    }
    return sides;
}

/* Pieces that the plane cut before and that are still there: at least so many it cuts. */
static unsigned cuts_known(const tree_list_t *list, uint32_t plane) {
    unsigned known = 0;
    for (unsigned i = 0; i < TREE_CUTS_KEPT; i++) {
        const uint32_t piece = list->cuts[plane][i];
        known += piece != SPACE_NONE && list->piece_round[piece] == list->round;
    }
    return known;
}

typedef struct tree_choice {
    uint32_t plane;
    size_t cost;
    size_t work; /* corners looked at so far, about */
} tree_choice_t;

static void try_plane(tree_list_t *list, uint32_t plane, tree_choice_t *best) {
    size_t cuts = 0, counts[2] = {0};
    uint32_t found[TREE_CUTS_KEPT];
    memset(found, 0xff, sizeof found); /* SPACE_NONE */
    for (size_t i = 0; i < list->count && TREE_COST_CUT * cuts < best->cost; i++) {
        const unsigned sides = tree_sides(list->space, list->pieces[i], plane);
        best->work += 3;
        if (sides == 3) {
            if (cuts < TREE_CUTS_KEPT) { found[cuts] = list->pieces[i]; }
            cuts++;
        } else {
            counts[sides == 2]++; /* in the plane: to the plus side */
        }
    }
    memcpy(list->cuts[plane], found, sizeof found);
    const size_t imbalance = counts[0] > counts[1] ? counts[0] - counts[1] : counts[1] - counts[0];
    if (TREE_COST_CUT * cuts + imbalance < best->cost) {
        best->plane = plane;
        best->cost = TREE_COST_CUT * cuts + imbalance;
    }
}

uint32_t tree_list_choose(tree_list_t *list) {
    tree_choice_t best = {.plane = list->planes[0], .cost = SIZE_MAX};
    for (unsigned hope = 0; hope <= TREE_CUTS_KEPT && TREE_COST_CUT * hope < best.cost; hope++) {
        for (size_t p = 0; p < list->plane_count; p++) {
            if (cuts_known(list, list->planes[p]) != hope) { continue; }
            try_plane(list, list->planes[p], &best);
            if (best.work > CHOICE_WORK) { return best.plane; }
        }
    }
    return best.plane;
}
