/* The pieces of a display tree as a solid again: points that others made on a side are inserted into it, and only then positions
 * are rounded. What was one point stays one, so the pieces hold together as they did: each side has its opposite.
 */
#include "tree.h"

#include <math.h>
#include <meshoptimizer.h>
#include <string.h>

typedef struct rounded {
    int32_t at[3]; /* in 1/256 step */
    float varying[SPACE_VARYING];
    bool whole; /* nothing had to be rounded */
} rounded_t;

typedef struct maker {
    space_t *space;
    solid_t *out;
    tree_counts_t *counts;
    uint32_t *planes; /* of each face made */
    solid_vertex_t *vertices;
    rounded_t *outline; /* of the piece at hand */
    int32_t (*points)[3];
    uint32_t (*triangles)[3];
    size_t plane_capacity, vertex_capacity, face_capacity, outline_capacity, point_capacity, triangle_capacity;
    size_t count; /* corners of the outline */
} maker_t;

/* ---- the outline of a piece --------------------------------------------------------------------------------- */

static bool add_corner(maker_t *m, uint32_t point, const float varying[SPACE_VARYING]) {
    if (!mesh_reserve(&m->outline, &m->outline_capacity, m->count + 1, sizeof *m->outline)) { return false; }
    rounded_t *to = &m->outline[m->count++];
    exact_round(&m->space->points[point], to->at);
    to->whole = m->space->points[point].w == 1;
    memcpy(to->varying, varying, sizeof to->varying);
    return true;
}

static bool trace(maker_t *m, const space_piece_t *piece) {
    const space_t *space = m->space;
    m->count = 0;
    for (uint32_t i = 0; i < piece->count; i++) {
        const space_corner_t *from = &space->corners[piece->first + i];
        const space_corner_t *to = &space->corners[piece->first + (i + 1) % piece->count];
        if (!add_corner(m, from->point, from->varying)) { return false; }
        const space_run_t run = space_between(space, from->line, from->point, to->point);
        const double start = space->points[from->point].at[run.axis], end = space->points[to->point].at[run.axis];
        for (size_t k = 0; k < run.count; k++) {
            const uint32_t point = *(run.step > 0 ? run.at + k : run.at - k);
            double part = (space->points[point].at[run.axis] - start) / (end - start);
            part = part >= 0 && part <= 1 ? part : 0.5;
            float varying[SPACE_VARYING];
            for (int j = 0; j < SPACE_VARYING; j++) {
                varying[j] = (float)(from->varying[j] + (to->varying[j] - from->varying[j]) * part);
            }
            if (!add_corner(m, point, varying)) { return false; }
        }
        m->counts->seam_corners += run.count;
    }
    return true;
}

static void reverse_order(maker_t *m) {
    for (size_t i = 0, j = m->count; i < j; i++) { /* the middle one meets itself */
        const rounded_t swap = m->outline[--j];
        m->outline[j] = m->outline[i];
        m->outline[i] = swap;
    }
}

static void reverse(maker_t *m) {
    reverse_order(m);
    for (size_t i = 0; i < m->count; i++) {
        for (int k = 0; k < 3; k++) {
            m->outline[i].varying[SPACE_NORMAL + k] *= -1;
        }
    }
}

static bool same_place(const rounded_t *a, const rounded_t *b) { return memcmp(a->at, b->at, sizeof a->at) == 0; }

static void drop(maker_t *m, size_t i) {
    memmove(m->outline + i, m->outline + i + 1, (m->count - i - 1) * sizeof *m->outline);
    m->count--;
}

/* Rounding moves corners onto one another, and sides. What is taken away are sides of no length and sides with their opposites:
 * the others of the solid still have theirs. */
static void tidy(maker_t *m) {
    for (size_t i = 0; i < m->count && m->count >= 3;) {
        const size_t after = (i + 1) % m->count, before = (i + m->count - 1) % m->count;
        if (same_place(&m->outline[i], &m->outline[after])) {
            drop(m, after);
        } else if (same_place(&m->outline[before], &m->outline[after])) {
            drop(m, i > after ? i : after);
            drop(m, i > after ? after : i);
        } else {
            i++;
            continue;
        }
        i = 0;
    }
}

/* ---- faces -------------------------------------------------------------------------------------------------- */

static double squares(const int64_t v[3]) {
    return (double)v[0] * (double)v[0] + (double)v[1] * (double)v[1] + (double)v[2] * (double)v[2];
}

static bool emit(maker_t *m, const space_face_t *from, bool reversed, const uint32_t *pick, size_t count, bool convex) {
    solid_t *out = m->out;
    const size_t corners = out->corner_count + count;
    solid_face_t face = {.first = (uint32_t)out->corner_count,
                         .count = (uint32_t)count,
                         .material = from->material,
                         .source = from->source,
                         .convex = convex};
    if (corners >= UINT32_MAX || !mesh_reserve(&m->vertices, &m->vertex_capacity, corners, sizeof *m->vertices) ||
        !mesh_reserve(&out->faces, &m->face_capacity, out->face_count + 1, sizeof *out->faces) ||
        !mesh_reserve(&m->planes, &m->plane_capacity, out->face_count + 1, sizeof *m->planes)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        face.normal[k] = m->space->planes[from->plane].n[k] * (from->turned != reversed ? -1 : 1);
    }
    for (int k = 0; k < 3; k++) {
        face.unit[k] = (double)face.normal[k] / sqrt(squares(face.normal));
    }
    for (size_t i = 0; i < count; i++) {
        const rounded_t *corner = &m->outline[pick ? pick[i] : i];
        solid_vertex_t *vertex = &m->vertices[out->corner_count + i];
        *vertex = (solid_vertex_t){.fraction = {0}};
        for (int k = 0; k < 3; k++) {
            vertex->position[k] = (int16_t)((corner->at[k] + 128) >> 8);
            vertex->fraction[k] = (int8_t)(corner->at[k] - 256 * vertex->position[k]);
            vertex->normal[k] = (int8_t)lrintf(corner->varying[SPACE_NORMAL + k]);
        }
        for (int k = 0; k < 2; k++) {
            vertex->texcoord[k] = (int16_t)lrintf(corner->varying[SPACE_TEXCOORD + k]);
        }
        for (int k = 0; k < 4; k++) {
            vertex->colour[k] = (uint8_t)lrintf(corner->varying[SPACE_COLOUR + k]);
        }
        face.piece = face.piece || !corner->whole;
    }
    out->corner_count = corners;
    m->planes[out->face_count] = from->plane;
    out->faces[out->face_count++] = face;
    out->polygons += count > 3;
    return true;
}

/* A fan of all its triangles, those without area too, from the corner from which most of them look the right way. */
static long fan(maker_t *m, const int64_t normal[3]) {
    size_t best = 0, most = 0;
    for (size_t apex = 0; apex < m->count; apex++) {
        size_t good = 0;
        for (size_t i = 1; i + 1 < m->count; i++) {
            const int32_t *p = m->points[apex], *q = m->points[(apex + i) % m->count], *r = m->points[(apex + i + 1) % m->count];
            const int32_t three[3][3] = {{p[0], p[1], p[2]}, {q[0], q[1], q[2]}, {r[0], r[1], r[2]}};
            int64_t turn[3];
            solid_newell(three, 3, turn);
            good +=
                (double)turn[0] * (double)normal[0] + (double)turn[1] * (double)normal[1] + (double)turn[2] * (double)normal[2] > 0;
        }
        if (good > most) {
            most = good;
            best = apex;
        }
    }
    for (size_t i = 1; i + 1 < m->count; i++) {
        m->triangles[i - 1][0] = (uint32_t)best;
        m->triangles[i - 1][1] = (uint32_t)((best + i) % m->count);
        m->triangles[i - 1][2] = (uint32_t)((best + i + 1) % m->count);
    }
    return (long)m->count - 2;
}

static bool emit_triangles(maker_t *m, const space_face_t *face, bool reversed, const int64_t normal[3]) {
    long count = mesh_triangulate((const int32_t(*)[3])m->points, m->count, m->triangles);
    if (count >= 0 && (size_t)count + 2 != m->count && !face->even) { /* a triangle was left out, and with it the end of a side */
        count = fan(m, normal);
    }
    for (long t = 0; t < count; t++) {
        const uint32_t *pick = m->triangles[t];
        if (same_place(&m->outline[pick[0]], &m->outline[pick[1]]) || same_place(&m->outline[pick[1]], &m->outline[pick[2]]) ||
            same_place(&m->outline[pick[2]], &m->outline[pick[0]])) {
            continue; /* its sides are each other's opposites */
        }
        if (!emit(m, face, reversed, pick, 3, true)) { return false; }
    }
    return count >= 0;
}

typedef struct flat {
    int64_t x, y; /* in 1/256 step: below 2^24 */
} flat_t;

static int turn(flat_t a, flat_t b, flat_t c) {
    const int64_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); /* < 2^51 */
    return (area > 0) - (area < 0);
}

static bool within(int64_t a, int64_t b, int64_t c) { return (a <= c && c <= b) || (b <= c && c <= a); }

static bool on_side(flat_t a, flat_t b, flat_t p) { return turn(a, b, p) == 0 && within(a.x, b.x, p.x) && within(a.y, b.y, p.y); }

/* Touching counts. */
static bool sides_meet(flat_t a, flat_t b, flat_t c, flat_t d) {
    if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) { return true; }
    return on_side(a, b, c) || on_side(a, b, d) || on_side(c, d, a) || on_side(c, d, b);
}

/* May some part of the outline turn the other way? Where no two sides cross or touch, none does. */
static bool crosses(const maker_t *m, const int64_t normal[3]) {
    int drop = 0;
    for (int k = 1; k < 3; k++) {
        if (llabs(normal[k]) > llabs(normal[drop])) { drop = k; }
    }
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
#define POINT(i) ((flat_t){m->points[(i) % m->count][u], m->points[(i) % m->count][v]})
    for (size_t i = 0; i < m->count; i++) {
        if (on_side(POINT(i), POINT(i + 1), POINT(i + 2)) || on_side(POINT(i + 1), POINT(i + 2), POINT(i))) { return true; }
        for (size_t j = i + 2; j < m->count && (i > 0 || j + 1 < m->count); j++) {
            if (sides_meet(POINT(i), POINT(i + 1), POINT(j), POINT(j + 1))) { return true; }
        }
    }
#undef POINT
    return false;
}

/* A piece of a face that crosses itself may be the part of it that turns the other way: it is turned round, since its side is told
 * by how it turns. */
static void turn_to(maker_t *m, const int64_t normal[3]) {
    int64_t turned[3];
    solid_newell((const int32_t(*)[3])m->points, m->count, turned);
    const double along =
        (double)turned[0] * (double)normal[0] + (double)turned[1] * (double)normal[1] + (double)turned[2] * (double)normal[2];
    if (along >= 0) { return; }
    reverse_order(m);
    for (size_t i = 0; i < m->count; i++) {
        memcpy(m->points[i], m->outline[i].at, sizeof m->points[i]);
    }
}

/* Light is interpolated right on triangles and in fans only: what is lit unevenly and not convex becomes triangles. */
static bool make_faces(maker_t *m, const space_piece_t *piece, bool reversed, bool last) {
    const space_face_t *face = &m->space->faces[piece->face];
    if (!trace(m, piece)) { return false; }
    if (reversed) { reverse(m); }
    /* A model of nothing but spikes keeps one of them: an empty one is none. */
    if (!last || m->out->face_count) { tidy(m); }
    if (m->count < 3) {
        m->counts->dropped++;
        return true;
    }
    if (!mesh_reserve(&m->points, &m->point_capacity, m->count, sizeof *m->points) ||
        !mesh_reserve(&m->triangles, &m->triangle_capacity, m->count, sizeof *m->triangles)) {
        return false;
    }
    int64_t normal[3];
    for (int k = 0; k < 3; k++) {
        normal[k] = m->space->planes[face->plane].n[k] * (face->turned != reversed ? -1 : 1);
        for (size_t i = 0; i < m->count; i++) {
            m->points[i][k] = m->outline[i].at[k];
        }
    }
    turn_to(m, normal);
    bool convex = m->count == 3 || solid_convex((const int32_t(*)[3])m->points, m->count, normal);
    if (m->count <= MESH_CORNERS_MAX && (convex || face->even)) {
        if (!emit(m, face, reversed, NULL, m->count, convex)) { return false; }
        m->out->faces[m->out->face_count - 1].crossing = !convex && crosses(m, normal);
        return true;
    }
    return emit_triangles(m, face, reversed, normal);
}

static bool make_all(maker_t *m, tree_t *tree) {
    for (size_t n = 0; n < tree->node_count; n++) {
        tree_node_t *node = &tree->nodes[n];
        const uint32_t lists[2] = {node->inward, node->outward};
        uint32_t piece = node->first;
        node->first = (uint32_t)m->out->face_count;
        for (int l = 0; l < 2; l++) {
            const size_t before = m->out->face_count;
            for (uint32_t i = 0; i < lists[l]; i++, piece++) {
                if (!make_faces(m, &m->space->pieces[tree->pieces[piece]], tree->reversed[piece], piece + 1 == tree->piece_count)) {
                    return false;
                }
            }
            *(l ? &node->outward : &node->inward) = (uint32_t)(m->out->face_count - before);
        }
    }
    return true;
}

/* One vertex for each place and what varies there, and a number for each place. */
static bool join(maker_t *m) {
    solid_t *out = m->out;
    out->corners = mesh_array(out->corner_count, sizeof *out->corners);
    if (!out->corners || !m->vertices) { return false; }
    out->vertex_count =
        meshopt_generateVertexRemap(out->corners, NULL, out->corner_count, m->vertices, out->corner_count, sizeof *m->vertices);
    for (size_t c = 0; c < out->corner_count; c++) { /* in place: a vertex never moves up */
        m->vertices[out->corners[c]] = m->vertices[c];
    }
    out->vertices = m->vertices;
    m->vertices = NULL;
    struct place {
        int16_t position[3];
        int8_t fraction[3], none;
    } *places = mesh_array(out->vertex_count, sizeof *places);
    out->places = mesh_array(out->vertex_count, sizeof *out->places);
    if (!places || !out->places) {
        free(places);
        return false;
    }
    for (size_t v = 0; v < out->vertex_count; v++) {
        memcpy(places[v].position, out->vertices[v].position, sizeof places[v].position);
        memcpy(places[v].fraction, out->vertices[v].fraction, sizeof places[v].fraction);
    }
    out->place_count = meshopt_generateVertexRemap(out->places, NULL, out->vertex_count, places, out->vertex_count, sizeof *places);
    free(places);
    return true;
}

/* ---- nodes -------------------------------------------------------------------------------------------------- */

/* A plane whose numbers fit model.h: the normal rounded if it must be, turned about a point of the plane. That moves it by less
 * than 2^-12 steps anywhere in the model: each component is off by half of 2^-29 of the largest, over a distance of at most 2^17.
 */
static tree_plane_t stored_plane(const exact_plane_t *exact) {
    tree_plane_t plane = {.d = 0};
    int64_t most = 0;
    for (int k = 0; k < 3; k++) {
        most = llabs(exact->n[k]) > most ? llabs(exact->n[k]) : most;
    }
    const int64_t limit = (1 << 30) - 1;
    for (int k = 0; k < 3; k++) {
        plane.n[k] = exact->n[k];
        if (most > limit) { plane.n[k] = llround((double)exact->n[k] * ((double)limit / (double)most)); }
        plane.d -= plane.n[k] * exact->through[k];
    }
    return plane;
}

/* Nodes that rounding left without faces fall out, and planes with nothing on one side. */
static bool prune(tree_t *tree, const space_t *space) {
    uint32_t *stands_for = mesh_array(tree->node_count, sizeof *stands_for), *depth = mesh_array(tree->node_count, sizeof *depth);
    tree->planes = mesh_array(tree->node_count, sizeof *tree->planes);
    if (!stands_for || !depth || !tree->planes) {
        free(stands_for);
        free(depth);
        return false;
    }
    for (size_t n = tree->node_count; n-- > 0;) { /* children stand behind their parents */
        tree_node_t *node = &tree->nodes[n];
        for (int c = 0; c < 2; c++) {
            if (node->child[c] != TREE_NO_NODE) { node->child[c] = stands_for[node->child[c]]; }
        }
        const bool bare = node->kind == TREE_CONVEX ? node->inward + node->outward == 0
                                                    : node->child[0] == TREE_NO_NODE || node->child[1] == TREE_NO_NODE;
        stands_for[n] = !bare ? (uint32_t)n : node->child[0] != TREE_NO_NODE ? node->child[0] : node->child[1];
    }
    size_t kept = 0;
    if (stands_for[0] != TREE_NO_NODE) { depth[stands_for[0]] = 1; }
    for (size_t n = 0; n < tree->node_count; n++) { /* stands_for: now the new place of a node */
        tree_node_t *node = &tree->nodes[n];
        if (!depth[n]) { continue; }
        for (int c = 0; c < 2; c++) {
            if (node->child[c] != TREE_NO_NODE) { depth[node->child[c]] = depth[n] + 1; }
        }
        tree->depth = depth[n] > tree->depth ? depth[n] : tree->depth;
        stands_for[n] = (uint32_t)kept;
        if (node->kind == TREE_PLANE) {
            tree->planes[tree->plane_count] = stored_plane(&space->planes[node->plane]);
            node->plane = (uint32_t)tree->plane_count++;
        }
        tree->nodes[kept++] = *node;
    }
    for (size_t n = 0; n < kept; n++) {
        for (int c = 0; c < 2; c++) {
            uint32_t *child = &tree->nodes[n].child[c];
            if (*child != TREE_NO_NODE) { *child = stands_for[*child]; }
        }
    }
    tree->node_count = kept;
    free(stands_for);
    free(depth);
    return true;
}

int tree_make_solid(tree_t *tree, space_t *space, solid_t *out, const mesh_options_t *options, tree_counts_t *counts,
                    sim_error_t *error) {
    const solid_t *in = space->solid;
    maker_t m = {.space = space, .out = out, .counts = counts};
    *out = (solid_t){.step = in->step,
                     .step_value = in->step_value,
                     .offset = {in->offset[0], in->offset[1], in->offset[2]},
                     .non_planar = in->non_planar + space->non_planar,
                     .split = in->split,
                     .skipped = in->skipped,
                     .error = in->error,
                     .textured = in->textured,
                     .coloured = in->coloured};
    *counts = (tree_counts_t){0};
    bool good = space_sort_lines(space) && make_all(&m, tree) && prune(tree, space);
    const size_t faces = out->face_count;
    good = good && (!faces || join(&m));
    int status = good ? 0 : sim_fail(error, "out of memory for the %zu pieces of a display tree", space->piece_count);
    if (good && !faces) { status = sim_fail(error, "no face of the model has an area once it is cut; there is nothing to draw"); }
    if (!status && !options->keep_order) { status = tree_arrange(tree, out, m.planes, error); }
    free(m.planes);
    free(m.vertices);
    free(m.outline);
    free(m.points);
    free(m.triangles);
    return status;
}
