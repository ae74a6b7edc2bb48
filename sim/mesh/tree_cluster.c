/* Clusters of a model with a display tree. The faces of a node stand together, those that look inwards first, and nodes stand in
 * preorder: what is left to choose is the order within a node, where the tree has none, and where the sequence is cut.
 */
#include "tree.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define FACES_MAX 64u         /* of a cluster */
#define ARRANGED_FROM 32u     /* faces of a list: fewer are one cluster anyway */
#define COST_CUT_IN_NODE 60.0 /* instructions: a node in two clusters needs both, perhaps one after the other */
#define COST_VISIT 300.0 /* a walk comes to a cluster more than once; without it there are five faces to a cluster, with it 30 */

/* ---- the order within a node -------------------------------------------------------------------------------- */

typedef struct arranger {
    solid_t *solid;
    uint32_t *planes;
    uint32_t *local; /* of each vertex and place of the solid: its number among those of the list, or SPACE_NONE */
    uint32_t *local_place;
    solid_face_t *faces;
    uint32_t *face_planes;
} arranger_t;

/* The faces first ... first + count - 1 as a solid of their own. */
static bool part_of(arranger_t *a, size_t first, size_t count, solid_t *part) {
    const solid_t *solid = a->solid;
    *part = (solid_t){.step = solid->step, .step_value = solid->step_value, .face_count = count};
    for (size_t f = first; f < first + count; f++) {
        part->corner_count += solid->faces[f].count;
    }
    part->faces = mesh_array(count, sizeof *part->faces);
    part->corners = mesh_array(part->corner_count, sizeof *part->corners);
    part->vertices = mesh_array(part->corner_count, sizeof *part->vertices);
    part->places = mesh_array(part->corner_count, sizeof *part->places);
    if (!part->faces || !part->corners || !part->vertices || !part->places) { return false; }
    size_t at = 0;
    for (size_t f = 0; f < count; f++) {
        const solid_face_t *face = &solid->faces[first + f];
        part->faces[f] = *face;
        part->faces[f].first = (uint32_t)at;
        for (uint32_t i = 0; i < face->count; i++, at++) {
            const uint32_t v = solid->corners[face->first + i], place = solid->places[v];
            if (a->local[v] == SPACE_NONE) {
                if (a->local_place[place] == SPACE_NONE) { a->local_place[place] = (uint32_t)part->place_count++; }
                a->local[v] = (uint32_t)part->vertex_count++;
                part->vertices[a->local[v]] = solid->vertices[v];
                part->places[a->local[v]] = a->local_place[place];
            }
            part->corners[at] = a->local[v];
        }
    }
    for (size_t f = first; f < first + count; f++) {
        for (uint32_t i = 0; i < solid->faces[f].count; i++) {
            const uint32_t v = solid->corners[solid->faces[f].first + i];
            a->local[v] = a->local_place[solid->places[v]] = SPACE_NONE;
        }
    }
    return true;
}

/* Coplanar faces may lie upon one another, and then the one that came first has to stay first: the places that the faces of one
 * plane have are given to them in their old order. order: old numbers. */
static bool keep_coplanar_order(const uint32_t *planes, uint32_t *order, size_t count) {
    keyed_face_t *by_place = mesh_array(count, sizeof *by_place), *by_number = mesh_array(count, sizeof *by_number);
    for (size_t i = 0; by_place && by_number && i < count; i++) {
        by_place[i] = (keyed_face_t){planes[order[i]], (uint32_t)i};
        by_number[i] = (keyed_face_t){planes[i], (uint32_t)i};
    }
    const bool good = by_place && by_number;
    if (good) {
        qsort(by_place, count, sizeof *by_place, keyed_face_order);
        qsort(by_number, count, sizeof *by_number, keyed_face_order);
        for (size_t i = 0; i < count; i++) {
            order[by_place[i].item] = by_number[i].item;
        }
    }
    free(by_place);
    free(by_number);
    return good;
}

static int arrange_list(arranger_t *a, size_t first, size_t count, sim_error_t *error) {
    if (count < ARRANGED_FROM) { return 0; }
    solid_t part = {0};
    clusters_t clusters = {0};
    int status = part_of(a, first, count, &part) ? 0 : sim_fail(error, "out of memory for the order of %zu faces", count);
    if (!status) { status = clusters_grow(&clusters, &part, false, error); }
    if (!status && !keep_coplanar_order(a->planes + first, clusters.faces, count)) {
        status = sim_fail(error, "out of memory for the order of %zu faces", count);
    }
    for (size_t i = 0; !status && i < count; i++) {
        a->faces[i] = a->solid->faces[first + clusters.faces[i]];
        a->face_planes[i] = a->planes[first + clusters.faces[i]];
    }
    if (!status) {
        memcpy(a->solid->faces + first, a->faces, count * sizeof *a->faces);
        memcpy(a->planes + first, a->face_planes, count * sizeof *a->face_planes);
    }
    clusters_free(&clusters);
    solid_free(&part);
    return status;
}

int tree_arrange(const tree_t *tree, solid_t *solid, uint32_t *planes, sim_error_t *error) {
    arranger_t a = {.solid = solid, .planes = planes};
    a.local = mesh_array(solid->vertex_count, sizeof *a.local);
    a.local_place = mesh_array(solid->place_count, sizeof *a.local_place);
    a.faces = mesh_array(solid->face_count, sizeof *a.faces);
    a.face_planes = mesh_array(solid->face_count, sizeof *a.face_planes);
    int status = 0;
    if (a.local && a.local_place && a.faces && a.face_planes) {
        memset(a.local, 0xff, solid->vertex_count * sizeof *a.local);
        memset(a.local_place, 0xff, solid->place_count * sizeof *a.local_place);
        for (size_t n = 0; !status && n < tree->node_count; n++) {
            const tree_node_t *node = &tree->nodes[n];
            if (node->kind != TREE_CONVEX) { continue; }
            status = arrange_list(&a, node->first, node->inward, error);
            if (!status) { status = arrange_list(&a, node->first + node->inward, node->outward, error); }
        }
    } else {
        status = sim_fail(error, "out of memory for the order of %zu faces", solid->face_count);
    }
    free(a.local);
    free(a.local_place);
    free(a.faces);
    free(a.face_planes);
    return status;
}

/* ---- cuts --------------------------------------------------------------------------------------------------- */

typedef struct cutter {
    const solid_t *solid;
    double eye_distance;
    uint32_t *seen, round; /* of each vertex: the round in which it was counted last */
    bool *border;          /* of each face: it begins a node, or the faces that look outwards */
    double *least;         /* cost of all faces before this one */
    uint32_t *from;        /* where the last cluster of them begins */
} cutter_t;

typedef struct cluster_sum {
    size_t vertices;
    double low[3], high[3], sum[3];
} cluster_sum_t;

static void add_to(cutter_t *c, cluster_sum_t *sum, const solid_face_t *face) {
    for (uint32_t i = 0; i < face->count; i++) {
        const uint32_t v = c->solid->corners[face->first + i];
        if (c->seen[v] == c->round) { continue; }
        c->seen[v] = c->round;
        sum->vertices++;
        for (int k = 0; k < 3; k++) {
            sum->low[k] = fmin(sum->low[k], c->solid->vertices[v].position[k]);
            sum->high[k] = fmax(sum->high[k], c->solid->vertices[v].position[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        sum->sum[k] += face->unit[k];
    }
}

static double price(const cutter_t *c, const cluster_sum_t *sum, size_t first, size_t end) {
    double length = 0, diagonal = 0, cosine = 1;
    for (int k = 0; k < 3; k++) {
        length += sum->sum[k] * sum->sum[k];
        diagonal += (sum->high[k] - sum->low[k]) * (sum->high[k] - sum->low[k]);
    }
    length = fmax(sqrt(length), 1e-9);
    for (size_t f = first; f < end; f++) {
        const double *unit = c->solid->faces[f].unit;
        cosine = fmin(cosine, (unit[0] * sum->sum[0] + unit[1] * sum->sum[1] + unit[2] * sum->sum[2]) / length);
    }
    return COST_VISIT + clusters_price(sum->vertices, end - first, cosine, sqrt(diagonal), c->eye_distance);
}

/* All clusters that begin at a face: a step of the cheapest way through the sequence. */
static void extend(cutter_t *c, size_t first) {
    cluster_sum_t sum = {.low = {DBL_MAX, DBL_MAX, DBL_MAX}, .high = {-DBL_MAX, -DBL_MAX, -DBL_MAX}};
    bool triangles = true;
    c->round++;
    for (size_t f = first; f < c->solid->face_count && f - first < FACES_MAX; f++) {
        add_to(c, &sum, &c->solid->faces[f]);
        triangles = triangles && c->solid->faces[f].count == 3;
        /* A cluster of triangles that is full may still become one of polygons. */
        if (sum.vertices > MESH_CORNERS_MAX) { return; }
        if (triangles && sum.vertices > MODEL_TRIANGLE_CLUSTER_VERTICES) { continue; }
        const bool inside = f + 1 < c->solid->face_count && !c->border[f + 1];
        const double cost = c->least[first] + price(c, &sum, first, f + 1) + (inside ? COST_CUT_IN_NODE : 0);
        if (cost < c->least[f + 1]) {
            c->least[f + 1] = cost;
            c->from[f + 1] = (uint32_t)first;
        }
    }
}

static bool read_back(const cutter_t *c, clusters_t *clusters) {
    const size_t faces = c->solid->face_count;
    for (size_t f = faces; f > 0; f = c->from[f]) {
        clusters->count++;
    }
    clusters->faces = mesh_array(faces, sizeof *clusters->faces);
    clusters->first = mesh_array(clusters->count + 1, sizeof *clusters->first);
    if (!clusters->faces || !clusters->first) { return false; }
    for (size_t f = 0; f < faces; f++) {
        clusters->faces[f] = (uint32_t)f;
    }
    size_t k = clusters->count;
    for (size_t f = faces; f > 0; f = c->from[f]) {
        clusters->first[k--] = (uint32_t)f;
    }
    return true;
}

int tree_cut_clusters(const tree_t *tree, const solid_t *solid, clusters_t *clusters, sim_error_t *error) {
    const size_t faces = solid->face_count;
    cutter_t c = {.solid = solid, .eye_distance = fmax(clusters_eye_distance(solid), 1)};
    *clusters = (clusters_t){0};
    c.seen = mesh_array(solid->vertex_count, sizeof *c.seen);
    c.border = mesh_array(faces + 1, sizeof *c.border);
    c.least = mesh_array(faces + 1, sizeof *c.least);
    c.from = mesh_array(faces + 1, sizeof *c.from);
    bool good = c.seen && c.border && c.least && c.from;
    for (size_t n = 0; good && n < tree->node_count; n++) {
        const tree_node_t *node = &tree->nodes[n];
        if (node->kind == TREE_CONVEX) { c.border[node->first] = c.border[node->first + node->inward] = true; }
    }
    for (size_t f = 1; good && f <= faces; f++) {
        c.least[f] = INFINITY;
    }
    for (size_t f = 0; good && f < faces; f++) {
        extend(&c, f);
    }
    good = good && read_back(&c, clusters);
    free(c.seen);
    free(c.border);
    free(c.least);
    free(c.from);
    if (good) { return 0; }
    clusters_free(clusters);
    return sim_fail(error, "out of memory for the clusters of %zu faces", faces);
}
