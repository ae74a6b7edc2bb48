/* Groups of neighbouring faces that are transformed, or dropped, as one.
 *
 * What a grouping costs is estimated, and faces are grouped so that it costs little. A cluster is looked at whatever happens; its
 * vertices and faces are worked on only if it does not face away. For an eye anywhere around the model that has the chance
 *
 *     1 - (1 - sin(alpha) - r / D) / 2        alpha: half angle of its normals, r: its radius, D: distance of the eye
 *
 * from the test in bounds.c, so flat and small clusters are cheap, and large ones save vertices on their borders. Every
 * face begins as a cluster; the two neighbours whose union saves most are joined, again and again. Then faces on borders change
 * sides where that pays. On an organic model of 5856 triangles, seen from eight sides, that costs 13 % less than the best that
 * meshoptimizer's meshlets, grown one after another from a seed, do for any size and cone weight. Ranking by the saving relative
 * to what the two cost, which makes clusters more alike in size, was tried and was no better.
 */
#include "stages.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Instructions on a small core: of a cluster that is looked at; of one that does not face away, besides; of a vertex, and of a face
 * that is turned away: the others are drawn whatever cluster they are in. */
#define COST_CLUSTER 60.0
#define COST_KEPT 150.0
#define COST_VERTEX 65.0
#define COST_FACE 20.0
#define EYE_DISTANCE 2.0 /* D, in half diagonals of the model */

#define VERTICES_MAX 44u /* of a cluster of several faces: more save little, and each takes eight bytes of the least block */
#define FACES_MAX 128u
#define BORDER_PASSES 8
#define NOT_HERE UINT32_MAX

typedef struct group {
    uint32_t *faces, *near; /* near: clusters that it touches, by names that may be out of date */
    size_t face_count, near_count, face_capacity, near_capacity;
    double cost;
    uint32_t version; /* of candidates: one with an older version is void */
} group_t;

typedef struct candidate {
    double gain;
    uint32_t a, b, version_a, version_b;
} candidate_t;

typedef struct grower {
    const solid_t *solid;
    double eye_distance; /* in steps */
    group_t *groups;     /* one for each face at first; an empty one was joined to another */
    uint32_t *parent;    /* of each group: union-find */
    uint32_t *group_of;  /* of each face, for the border pass */
    uint32_t *seen;      /* of each vertex: the round in which it was counted last */
    uint32_t *met;       /* the same for groups */
    uint32_t round;
    candidate_t *heap;
    size_t heap_count, heap_capacity;
    bool failed;
} grower_t;

/* ---- cost --------------------------------------------------------------------------------------------------- */

typedef struct tally {
    size_t vertices, faces;
    double low[3], high[3], sum[3];
} tally_t;

static void tally_add(grower_t *g, tally_t *tally, uint32_t face_index) {
    const solid_face_t *face = &g->solid->faces[face_index];
    for (uint32_t i = 0; i < face->count; i++) {
        uint32_t v = g->solid->corners[face->first + i];
        if (g->seen[v] == g->round) { continue; }
        g->seen[v] = g->round;
        tally->vertices++;
        for (int k = 0; k < 3; k++) {
            tally->low[k] = fmin(tally->low[k], g->solid->vertices[v].position[k]);
            tally->high[k] = fmax(tally->high[k], g->solid->vertices[v].position[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        tally->sum[k] += face->unit[k];
    }
    tally->faces++;
}

double clusters_eye_distance(const solid_t *solid) {
    double low[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, high[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX}, squares = 0;
    for (size_t v = 0; v < solid->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], solid->vertices[v].position[k]);
            high[k] = fmax(high[k], solid->vertices[v].position[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        squares += (high[k] - low[k]) * (high[k] - low[k]);
    }
    return EYE_DISTANCE * sqrt(squares) / 2;
}

double clusters_price(size_t vertices, size_t faces, double cosine, double diagonal, double eye_distance) {
    double sine = cosine > 0 ? sqrt(fmax(0, 1 - cosine * cosine)) : 1;
    double away = fmax(0, 1 - sine - diagonal / 2 / eye_distance) / 2;
    return COST_CLUSTER + (1 - away) * (COST_KEPT + COST_VERTEX * (double)vertices + COST_FACE * (double)faces);
}

/* The cost of the union of two lists of faces, without the face `left_out`; infinite when it is too large, 0 when it is empty.
 * The sphere is taken around the box and the cone around the mean: near enough to compare. */
static double cost_of(grower_t *g, const group_t *a, const group_t *b, uint32_t left_out, uint32_t added) {
    tally_t tally = {.low = {DBL_MAX, DBL_MAX, DBL_MAX}, .high = {-DBL_MAX, -DBL_MAX, -DBL_MAX}};
    const group_t *lists[2] = {a, b};
    g->round++;
    for (int l = 0; l < 2; l++) {
        for (size_t i = 0; lists[l] && i < lists[l]->face_count; i++) {
            if (lists[l]->faces[i] != left_out) { tally_add(g, &tally, lists[l]->faces[i]); }
        }
    }
    if (added != NOT_HERE) { tally_add(g, &tally, added); }
    if (tally.faces == 0) { return 0; }
    if (tally.faces > FACES_MAX || (tally.faces > 1 && tally.vertices > VERTICES_MAX)) { return INFINITY; }
    double length = sqrt(tally.sum[0] * tally.sum[0] + tally.sum[1] * tally.sum[1] + tally.sum[2] * tally.sum[2]);
    double cosine = 1, diagonal = 0;
    for (int l = 0; l < 2; l++) {
        for (size_t i = 0; lists[l] && i < lists[l]->face_count; i++) {
            const double *unit = g->solid->faces[lists[l]->faces[i]].unit;
            if (lists[l]->faces[i] != left_out) {
                cosine =
                    fmin(cosine, (unit[0] * tally.sum[0] + unit[1] * tally.sum[1] + unit[2] * tally.sum[2]) / fmax(length, 1e-9));
            }
        }
    }
    if (added != NOT_HERE) {
        const double *unit = g->solid->faces[added].unit;
        cosine = fmin(cosine, (unit[0] * tally.sum[0] + unit[1] * tally.sum[1] + unit[2] * tally.sum[2]) / fmax(length, 1e-9));
    }
    for (int k = 0; k < 3; k++) {
        diagonal += (tally.high[k] - tally.low[k]) * (tally.high[k] - tally.low[k]);
    }
    return clusters_price(tally.vertices, tally.faces, cosine, sqrt(diagonal), g->eye_distance);
}

/* ---- the heap of candidates ---------------------------------------------------------------------------------- */

/* Equal gains are common (regular meshes); the rest of the order keeps the result the same everywhere. */
static bool better(const candidate_t *x, const candidate_t *y) {
    if (x->gain > y->gain || x->gain < y->gain) { return x->gain > y->gain; }
    return x->a != y->a ? x->a < y->a : x->b < y->b;
}

static void push(grower_t *g, candidate_t candidate) {
    if (!mesh_reserve(&g->heap, &g->heap_capacity, g->heap_count + 1, sizeof *g->heap)) {
        g->failed = true;
        return;
    }
    size_t at = g->heap_count++;
    for (; at > 0 && better(&candidate, &g->heap[(at - 1) / 2]); at = (at - 1) / 2) {
        g->heap[at] = g->heap[(at - 1) / 2];
    }
    g->heap[at] = candidate;
}

static candidate_t pop(grower_t *g) {
    candidate_t best = g->heap[0], last = g->heap[--g->heap_count];
    size_t at = 0;
    for (size_t child = 1; child < g->heap_count; child = 2 * at + 1) {
        if (child + 1 < g->heap_count && better(&g->heap[child + 1], &g->heap[child])) { child++; }
        if (!better(&g->heap[child], &last)) { break; }
        g->heap[at] = g->heap[child];
        at = child;
    }
    g->heap[at] = last;
    return best;
}

/* ---- joining ------------------------------------------------------------------------------------------------- */

static uint32_t find(grower_t *g, uint32_t group) {
    while (g->parent[group] != group) {
        g->parent[group] = g->parent[g->parent[group]];
        group = g->parent[group];
    }
    return group;
}

static void propose(grower_t *g, uint32_t a, uint32_t b) {
    if (a == b) { return; }
    if (a > b) {
        uint32_t swap = a;
        a = b;
        b = swap;
    }
    double gain = g->groups[a].cost + g->groups[b].cost - cost_of(g, &g->groups[a], &g->groups[b], NOT_HERE, NOT_HERE);
    if (gain > 0) { push(g, (candidate_t){gain, a, b, g->groups[a].version, g->groups[b].version}); }
}

static void append(grower_t *g, uint32_t **list, size_t *count, size_t *capacity, uint32_t item) {
    if (!mesh_reserve(list, capacity, *count + 1, sizeof **list)) {
        g->failed = true;
        return;
    }
    (*list)[(*count)++] = item;
}

static void add_face(grower_t *g, group_t *group, uint32_t face) {
    append(g, &group->faces, &group->face_count, &group->face_capacity, face);
}

static void link_groups(grower_t *g, uint32_t a, uint32_t b) {
    append(g, &g->groups[a].near, &g->groups[a].near_count, &g->groups[a].near_capacity, b);
    append(g, &g->groups[b].near, &g->groups[b].near_count, &g->groups[b].near_capacity, a);
}

static void group_clear(group_t *group) {
    free(group->faces);
    free(group->near);
    *group = (group_t){.version = group->version + 1};
}

static void merge(grower_t *g, uint32_t a, uint32_t b) {
    group_t *into = &g->groups[a], *from = &g->groups[b];
    for (size_t i = 0; i < from->face_count; i++) {
        add_face(g, into, from->faces[i]);
    }
    for (size_t i = 0; i < from->near_count; i++) {
        append(g, &into->near, &into->near_count, &into->near_capacity, from->near[i]);
    }
    g->parent[b] = a;
    group_clear(from);
    into->version++;
    into->cost = cost_of(g, into, NULL, NOT_HERE, NOT_HERE);
    g->round++;
    size_t kept = 0; /* names brought up to date, each once */
    for (size_t i = 0; i < into->near_count; i++) {
        uint32_t other = find(g, into->near[i]);
        if (other != a && g->met[other] != g->round) {
            g->met[other] = g->round;
            into->near[kept++] = other;
        }
    }
    into->near_count = kept;
    for (size_t i = 0; i < kept && !g->failed; i++) {
        propose(g, a, into->near[i]);
    }
}

static void merge_all(grower_t *g) {
    while (g->heap_count && !g->failed) {
        candidate_t best = pop(g);
        if (g->groups[best.a].version == best.version_a && g->groups[best.b].version == best.version_b) {
            merge(g, best.a, best.b);
        }
    }
}

/* ---- neighbours ---------------------------------------------------------------------------------------------- */

static bool link_by_edges(grower_t *g) {
    uint32_t(*pairs)[2];
    long count = solid_neighbours(g->solid, &pairs);
    for (long i = 0; i < count; i++) {
        link_groups(g, pairs[i][0], pairs[i][1]);
    }
    free(pairs);
    return count >= 0 && !g->failed;
}

/* The groups there are, in z order. */
static keyed_face_t *sorted_groups(const grower_t *g, size_t *count) {
    keyed_face_t *order = mesh_array(g->solid->face_count, sizeof *order);
    *count = 0;
    for (uint32_t k = 0; order && k < g->solid->face_count; k++) {
        if (g->groups[k].face_count) {
            order[(*count)++] = (keyed_face_t){solid_z_order(g->solid, g->groups[k].faces, g->groups[k].face_count), k};
        }
    }
    if (order) { qsort(order, *count, sizeof *order, keyed_face_order); }
    return order;
}

/* Loose parts have no edges in common: those that lie next to one another in space are offered to each other, until that changes
 * nothing. */
static void merge_loose(grower_t *g) {
    size_t before = SIZE_MAX, count = 0;
    while (!g->failed) {
        keyed_face_t *order = sorted_groups(g, &count);
        if (!order) {
            g->failed = true;
            return;
        }
        for (size_t i = 0; i < count && count < before; i++) {
            for (size_t j = i + 1; j <= i + 3 && j < count; j++) {
                link_groups(g, order[i].item, order[j].item);
                propose(g, order[i].item, order[j].item);
            }
        }
        free(order);
        if (count >= before) { return; }
        before = count;
        merge_all(g);
    }
}

/* ---- borders ------------------------------------------------------------------------------------------------- */

static void move_face(grower_t *g, uint32_t face, uint32_t from, uint32_t to) {
    group_t *a = &g->groups[from];
    size_t i = 0;
    while (a->faces[i] != face) {
        i++;
    }
    memmove(a->faces + i, a->faces + i + 1, (--a->face_count - i) * sizeof *a->faces);
    add_face(g, &g->groups[to], face);
    g->group_of[face] = to;
    a->cost = cost_of(g, a, NULL, NOT_HERE, NOT_HERE);
    g->groups[to].cost = cost_of(g, &g->groups[to], NULL, NOT_HERE, NOT_HERE);
}

/* near: the faces next to each face, before any were joined: first[f] ... first[f + 1] - 1. */
static void trade(grower_t *g, const uint32_t *first, const uint32_t *near) {
    bool moved = true;
    for (int pass = 0; pass < BORDER_PASSES && moved && !g->failed; pass++) {
        moved = false;
        for (uint32_t f = 0; f < g->solid->face_count && !g->failed; f++) {
            uint32_t own = g->group_of[f], best = own;
            double most = 1e-6, without = -1;
            for (uint32_t n = first[f]; n < first[f + 1]; n++) {
                uint32_t other = g->group_of[near[n]];
                if (other == own || other == best) { continue; }
                if (without < 0) { without = cost_of(g, &g->groups[own], NULL, f, NOT_HERE); }
                double gain =
                    g->groups[own].cost + g->groups[other].cost - without - cost_of(g, &g->groups[other], NULL, NOT_HERE, f);
                if (gain > most) {
                    most = gain;
                    best = other;
                }
            }
            if (best != own) {
                move_face(g, f, own, best);
                moved = true;
            }
        }
    }
}

/* ---- putting it together --------------------------------------------------------------------------------------- */

static void grow_freely(grower_t *g) {
    size_t count = g->solid->face_count, links = 0;
    if (!link_by_edges(g)) {
        g->failed = true;
        return;
    }
    for (size_t f = 0; f < count; f++) {
        links += g->groups[f].near_count;
    }
    uint32_t *first = mesh_array(count + 1, sizeof *first), *near = mesh_array(links, sizeof *near);
    g->failed = !first || !near || links >= UINT32_MAX;
    for (uint32_t f = 0; f < count && !g->failed; f++) { /* kept for the border pass, as merging forgets them */
        const group_t *group = &g->groups[f];
        first[f + 1] = first[f] + (uint32_t)group->near_count;
        for (size_t i = 0; i < group->near_count; i++) {
            near[first[f] + i] = group->near[i];
            if (group->near[i] > f) { propose(g, f, group->near[i]); }
        }
    }
    merge_all(g);
    merge_loose(g);
    for (uint32_t f = 0; f < count && !g->failed; f++) {
        g->group_of[f] = find(g, f);
    }
    if (!g->failed) { trade(g, first, near); }
    free(first);
    free(near);
}

/* Runs of faces as they come: a run goes on while that costs less than to begin another. */
static void grow_in_order(grower_t *g) {
    uint32_t run = 0;
    for (uint32_t f = 1; f < g->solid->face_count && !g->failed; f++) {
        double joined = cost_of(g, &g->groups[run], &g->groups[f], NOT_HERE, NOT_HERE);
        if (joined <= g->groups[run].cost + g->groups[f].cost) {
            add_face(g, &g->groups[run], f);
            g->groups[run].cost = joined;
            group_clear(&g->groups[f]);
        } else {
            run = f;
        }
    }
}

static bool begin(grower_t *g) {
    const solid_t *solid = g->solid;
    g->eye_distance = clusters_eye_distance(solid);
    g->groups = mesh_array(solid->face_count, sizeof *g->groups);
    g->parent = mesh_array(solid->face_count, sizeof *g->parent);
    g->group_of = mesh_array(solid->face_count, sizeof *g->group_of);
    g->seen = mesh_array(solid->vertex_count, sizeof *g->seen);
    g->met = mesh_array(solid->face_count, sizeof *g->met);
    if (!g->groups || !g->parent || !g->group_of || !g->seen || !g->met) { return false; }
    for (uint32_t f = 0; f < solid->face_count; f++) {
        g->parent[f] = f;
        add_face(g, &g->groups[f], f);
        if (!g->failed) { g->groups[f].cost = cost_of(g, &g->groups[f], NULL, NOT_HERE, NOT_HERE); }
    }
    return !g->failed;
}

static bool collect(const grower_t *g, clusters_t *clusters, bool keep_order) {
    size_t count = 0;
    keyed_face_t *order = sorted_groups(g, &count);
    clusters->faces = mesh_array(g->solid->face_count, sizeof *clusters->faces);
    clusters->first = mesh_array(count + 1, sizeof *clusters->first);
    if (!order || !clusters->faces || !clusters->first) {
        free(order);
        return false;
    }
    for (size_t k = 0; keep_order && k < count; k++) {
        order[k].key = order[k].item; /* a run is named by its first face */
    }
    qsort(order, count, sizeof *order, keyed_face_order);
    for (size_t k = 0; k < count; k++) {
        const group_t *group = &g->groups[order[k].item];
        memcpy(clusters->faces + clusters->first[k], group->faces, group->face_count * sizeof *group->faces);
        clusters->first[k + 1] = clusters->first[k] + (uint32_t)group->face_count;
    }
    clusters->count = count;
    free(order);
    return true;
}

void clusters_free(clusters_t *clusters) {
    free(clusters->faces);
    free(clusters->first);
    *clusters = (clusters_t){0};
}

int clusters_grow(clusters_t *clusters, const solid_t *solid, bool keep_order, sim_error_t *error) {
    grower_t g = {.solid = solid};
    *clusters = (clusters_t){0};
    g.failed = !begin(&g);
    if (!g.failed && keep_order) {
        grow_in_order(&g);
    } else if (!g.failed) {
        grow_freely(&g);
    }
    g.failed = g.failed || !collect(&g, clusters, keep_order);
    for (size_t f = 0; g.groups && f < solid->face_count; f++) {
        group_clear(&g.groups[f]);
    }
    free(g.groups);
    free(g.parent);
    free(g.group_of);
    free(g.seen);
    free(g.met);
    free(g.heap);
    if (g.failed) {
        clusters_free(clusters);
        return sim_fail(error, "out of memory for the clusters of %zu faces", solid->face_count);
    }
    return 0;
}
