#include "tree_check.h"

#include "../../raster/geometry/model.h"
#include "check.h"

#include <math.h>

#define ROUNDED 0.8661 /* sqrt(3) / 2 and a little */

/* ---- reading ------------------------------------------------------------------------------------------------ */

typedef struct reader {
    const uint8_t *words;
    uint32_t count, at;
    tree_check_t tree;
    uint32_t *places; /* of each node, in words */
    int *waiting;     /* nodes whose second child is still to come */
    int waiting_count;
} reader_t;

static uint32_t word(const reader_t *r, uint32_t at) {
    assert_true(at < r->count);
    return decoder_u32(r->words + 4 * (size_t)at);
}

/* Words that are not the first of a node: bit 0 is free. */
static uint32_t value(const reader_t *r, uint32_t at) {
    assert_int_equal(word(r, at) & 1, 0);
    return word(r, at) >> 1;
}

/* As a signed number of 31 bits. */
static int64_t signed_value(const reader_t *r, uint32_t at) {
    const int64_t plain = value(r, at);
    return plain >= 1 << 30 ? plain - ((int64_t)1 << 31) : plain;
}

static int read_node(reader_t *r, bool second, unsigned depth) {
    const int index = r->tree.node_count++;
    const uint32_t head = word(r, r->at), kind = head >> 1 & 3;
    tree_check_node_t *node = &r->tree.nodes[index];
    *node = (tree_check_node_t){.kind = kind, .child = {-1, -1}, .depth = depth};
    assert_int_equal(head & 1, 1);
    assert_int_equal(head >> 4 & 1, second);
    assert_int_equal(head >> 5 & 7, 0);
    r->places[index] = r->at;
    r->tree.depth = depth > r->tree.depth ? depth : r->tree.depth;
    if (kind == 1) {
        node->cluster = head >> 8;
        node->first = value(r, r->at + 1);
        node->inward = value(r, r->at + 2);
        node->outward = value(r, r->at + 3);
        assert_true(node->inward + node->outward >= 1);
        r->tree.convex_nodes++;
        r->at += 4;
    } else {
        assert_int_equal(kind, 2);
        assert_int_equal(head >> 8, 0);
        for (uint32_t k = 0; k < 3; k++) {
            node->n[k] = signed_value(r, r->at + 2 + k);
            assert_true(llabs(node->n[k]) < 1 << 30);
        }
        assert_true(node->n[0] || node->n[1] || node->n[2]);
        assert_true(value(r, r->at + 5) < 1 << 30);
        node->d = signed_value(r, r->at + 6) * (1 << 30) + value(r, r->at + 5);
        assert_true(llabs(node->d) < (int64_t)1 << 48);
        r->tree.plane_nodes++;
        if (value(r, r->at + 1)) { r->waiting[r->waiting_count++] = index; }
        assert_true((head & 8) || value(r, r->at + 1));
        r->at += 7;
    }
    node->child[0] = head & 8 ? index + 1 : -1;
    return index;
}

static void read_nodes(reader_t *r) {
    int node = read_node(r, false, 1);
    for (;;) {
        while (r->tree.nodes[node].child[0] >= 0) { /* it stands right behind */
            node = read_node(r, false, r->tree.nodes[node].depth + 1);
        }
        if (!r->waiting_count) { break; }
        const int parent = r->waiting[--r->waiting_count];
        assert_int_equal(value(r, r->at++), r->places[parent]);
        assert_int_equal(value(r, r->places[parent] + 1), r->at);
        r->tree.nodes[parent].child[1] = r->tree.node_count;
        node = read_node(r, true, r->tree.nodes[parent].depth + 1);
    }
    assert_int_equal(r->at, r->count);
}

/* Nodes name all faces, each once, in order. */
static void read_faces(reader_t *r, const compiled_t *c) {
    uint32_t next = 0;
    for (int n = 0; n < r->tree.node_count; n++) {
        const tree_check_node_t *node = &r->tree.nodes[n];
        r->tree.nodes[n].faces_first = next;
        if (node->kind != TREE_CONVEX) { continue; }
        assert_int_equal(node->first, next);
        assert_true(next < c->model.face_count);
        assert_int_equal(node->cluster, c->model.faces[next].cluster);
        next += node->inward + node->outward;
    }
    assert_int_equal(next, c->model.face_count);
    for (int n = r->tree.node_count - 1; n >= 0; n--) {
        tree_check_node_t *node = &r->tree.nodes[n];
        node->faces_end = node->faces_first + node->inward + node->outward;
        for (int k = 0; k < 2; k++) {
            if (node->child[k] >= 0) { node->faces_end = r->tree.nodes[node->child[k]].faces_end; }
        }
    }
}

tree_check_t tree_check_read(const compiled_t *c) {
    const uint32_t at = decoder_u32(c->bytes + 96);
    reader_t r = {.words = c->bytes + at, .count = decoder_u32(c->bytes + 100)};
    assert_true(at >= 108 && at % 4 == 0 && at + 4 * (uint64_t)r.count <= c->size_bytes && r.count >= 4);
    r.tree.nodes = calloc(r.count, sizeof *r.tree.nodes);
    r.places = calloc(r.count, sizeof *r.places);
    r.waiting = calloc(r.count, sizeof *r.waiting);
    assert_non_null(r.tree.nodes);
    assert_non_null(r.places);
    assert_non_null(r.waiting);
    read_nodes(&r);
    read_faces(&r, c);
    free(r.places);
    free(r.waiting);
    assert_int_equal(r.tree.depth, decoder_u16(c->bytes + 104));
    assert_int_equal(decoder_u16(c->bytes + 106), 0);
    const mesh_tree_report_t *report = &c->report.tree;
    assert_int_equal(report->depth, r.tree.depth);
    assert_int_equal(report->convex_nodes, r.tree.convex_nodes);
    assert_int_equal(report->plane_nodes, r.tree.plane_nodes);
    assert_int_equal(report->faces_out, c->model.face_count);
    assert_int_equal(report->size_bytes, 4 * r.count);
    return r.tree;
}

void tree_check_free(tree_check_t *tree) {
    free(tree->nodes);
    *tree = (tree_check_t){0};
}

/* ---- geometry ----------------------------------------------------------------------------------------------- */

typedef struct plane {
    double n[3], d, length;
} plane_t;

static double value_at(const plane_t *plane, const double q[3]) {
    return plane->n[0] * q[0] + plane->n[1] * q[1] + plane->n[2] * q[2] + plane->d;
}

/* Of a face of the mesh: exact, as whole numbers that small are in doubles; from its first corners that are not in line, turned as
 * the whole polygon is. */
static plane_t plane_of_source(const mesh_t *mesh, uint32_t source) {
    size_t index = source < mesh->face_count ? source : mesh->face_count - 1;
    plane_t plane = {.d = 0};
    while (mesh->faces[index].source > source) { /* some may have been left out by the importer */
        index--;
    }
    const mesh_face_t *face = &mesh->faces[index];
    assert_int_equal(face->source, source);
    for (uint32_t i = 0; i < face->count; i++) { /* about the first corner */
        const double *o = mesh->positions[mesh->corners[face->first]];
        const double *p = mesh->positions[mesh->corners[face->first + i]];
        const double *q = mesh->positions[mesh->corners[face->first + (i + 1) % face->count]];
        for (int k = 0; k < 3; k++) {
            const int y = (k + 1) % 3, z = (k + 2) % 3;
            plane.n[k] += (p[y] - o[y]) * (q[z] - o[z]) - (p[z] - o[z]) * (q[y] - o[y]);
        }
    }
    for (int k = 0; k < 3; k++) {
        plane.d -= plane.n[k] * mesh->positions[mesh->corners[face->first]][k];
        plane.length += plane.n[k] * plane.n[k];
    }
    plane.length = sqrt(plane.length);
    return plane;
}

/* All corners of some faces lie on the side `sign` of a plane, but for the rounding of their places. */
static void check_side(const compiled_t *c, uint32_t first, uint32_t end, const plane_t *plane, double sign) {
    for (uint32_t f = first; f < end; f++) {
        for (uint32_t i = 0; i < c->model.faces[f].corners; i++) {
            const int32_t *q = c->model.faces[f].q[i];
            const double at[3] = {q[0], q[1], q[2]};
            if (sign * value_at(plane, at) < -ROUNDED * plane->length - 1) {
                fail_msg("corner %u of face %u is %g steps on the wrong side of a plane", i, f,
                         -sign * value_at(plane, at) / plane->length);
            }
        }
    }
}

void tree_check_sides(const compiled_t *c, const tree_check_t *tree) {
    for (int n = 0; n < tree->node_count; n++) {
        const tree_check_node_t *node = &tree->nodes[n];
        if (node->kind == TREE_CONVEX) {
            for (uint32_t i = 0; i < node->inward + node->outward; i++) {
                const decoder_face_t *face = &c->model.faces[node->first + i];
                const plane_t plane = plane_of_source(&c->mesh, face->source);
                double turned = 0; /* two-sided faces may be reversed */
                for (int k = 0; k < 3; k++) {
                    turned += plane.n[k] * face->plane[k];
                }
                check_side(c, node->faces_first, node->faces_end, &plane, (i < node->inward) == (turned > 0) ? 1 : -1);
            }
            continue;
        }
        plane_t plane = {.d = (double)node->d};
        for (int k = 0; k < 3; k++) {
            plane.n[k] = (double)node->n[k];
            plane.length += plane.n[k] * plane.n[k];
        }
        plane.length = sqrt(plane.length);
        for (int k = 0; k < 2; k++) {
            if (node->child[k] < 0) { continue; }
            const tree_check_node_t *child = &tree->nodes[node->child[k]];
            check_side(c, child->faces_first, child->faces_end, &plane, k ? -1 : 1);
        }
    }
}

/* Moving a corner by ROUNDED changes an area by as much times half of the two sides beside it. */
void tree_check_areas(const compiled_t *c) {
    for (uint32_t s = 0; s < c->mesh.face_count; s++) {
        const plane_t plane = plane_of_source(&c->mesh, c->mesh.faces[s].source);
        double sum[3] = {0}, slack = 2, off = 0, turned = 0;
        for (uint32_t f = 0; f < c->model.face_count; f++) {
            const decoder_face_t *face = &c->model.faces[f];
            if (face->source != c->mesh.faces[s].source) { continue; }
            double n[3];
            assert_int_equal(face->material, c->mesh.faces[s].material);
            decoder_plane(face, n);
            turned = 0;
            for (int k = 0; k < 3; k++) {
                turned += plane.n[k] * face->plane[k];
                assert_true(fabs(fabs(plane.n[k] / plane.length) - fabs(face->plane[k] / 127.0)) < 0.0041);
            }
            for (int k = 0; k < 3; k++) {
                sum[k] += turned > 0 ? n[k] : -n[k];
            }
            for (uint32_t i = 0; i < face->corners; i++) {
                double squares = 0;
                for (int k = 0; k < 3; k++) {
                    const double side = face->q[i][k] - face->q[(i + 1) % face->corners][k];
                    squares += side * side;
                }
                slack += 2 * ROUNDED * (sqrt(squares) + ROUNDED);
            }
        }
        for (int k = 0; k < 3; k++) {
            off += (sum[k] - plane.n[k]) * (sum[k] - plane.n[k]);
        }
        if (sqrt(off) > slack) { fail_msg("the pieces of face %u lack %g of an area of %g", s, sqrt(off) / 2, plane.length / 2); }
    }
}

typedef struct side {
    int32_t low[3], high[3];
    int32_t balance;
} side_t;

static int compare_sides(const void *x, const void *y) {
    const side_t *a = x, *b = y;
    const int order = memcmp(a->low, b->low, sizeof a->low);
    return order ? order : memcmp(a->high, b->high, sizeof a->high);
}

void tree_check_closed(const compiled_t *c) {
    size_t count = 0;
    for (uint32_t f = 0; f < c->model.face_count; f++) {
        count += c->model.faces[f].corners;
    }
    side_t *sides = calloc(count + 1, sizeof *sides);
    assert_non_null(sides);
    size_t at = 0;
    for (uint32_t f = 0; f < c->model.face_count; f++) {
        const decoder_face_t *face = &c->model.faces[f];
        for (uint32_t i = 0; i < face->corners; i++, at++) {
            const int32_t *p = face->q[i], *q = face->q[(i + 1) % face->corners];
            const bool swap = memcmp(p, q, sizeof face->q[0]) > 0;
            memcpy(sides[at].low, swap ? q : p, sizeof sides[at].low);
            memcpy(sides[at].high, swap ? p : q, sizeof sides[at].high);
            sides[at].balance = swap ? -1 : 1;
        }
    }
    qsort(sides, count, sizeof *sides, compare_sides);
    for (size_t i = 0, j; i < count; i = j) {
        int32_t balance = 0;
        for (j = i; j < count && compare_sides(&sides[i], &sides[j]) == 0; j++) {
            balance += sides[j].balance;
        }
        if (balance && memcmp(sides[i].low, sides[i].high, sizeof sides[i].low)) {
            fail_msg("%d of %zu sides between (%d %d %d) and (%d %d %d) have no opposite", balance, j - i, sides[i].low[0],
                     sides[i].low[1], sides[i].low[2], sides[i].high[0], sides[i].high[1], sides[i].high[2]);
        }
    }
    free(sides);
}

/* ---- the painter's order ------------------------------------------------------------------------------------ */

typedef struct painter {
    const compiled_t *c;
    const tree_check_t *tree;
    plane_t *planes; /* of each face of the model, its own side first */
    uint32_t *order;
    size_t count;
    double eye[3];
} painter_t;

static void draw_faces(painter_t *p, const tree_check_node_t *node, bool inside_seen) {
    for (uint32_t i = 0; i < node->inward + node->outward; i++) {
        const bool front = value_at(&p->planes[node->first + i], p->eye) > 0; /* the side that its normal points to is seen */
        if ((i < node->inward ? front : !front) == inside_seen) { p->order[p->count++] = node->first + i; }
    }
}

/* S10, as it is written there. Trees of tests are shallow. */
static void draw(painter_t *p, int index) {
    const tree_check_node_t *node = &p->tree->nodes[index];
    if (node->kind == TREE_CONVEX) {
        draw_faces(p, node, true);
        if (node->child[0] >= 0) { draw(p, node->child[0]); }
        draw_faces(p, node, false);
        return;
    }
    const double side =
        (double)node->n[0] * p->eye[0] + (double)node->n[1] * p->eye[1] + (double)node->n[2] * p->eye[2] + (double)node->d;
    for (int k = 0; k < 2; k++) {
        const int child = node->child[side > 0 ? 1 - k : k];
        if (child >= 0) { draw(p, child); }
    }
}

/* Where a ray meets a face: the distance, or -1 when it passes it, or comes nearer than a step to its outline: there rounding has a
 * say in what is covered. */
static double meet(const painter_t *p, uint32_t f, const double ray[3]) {
    const plane_t *plane = &p->planes[f];
    const decoder_face_t *face = &p->c->model.faces[f];
    const double slope = plane->n[0] * ray[0] + plane->n[1] * ray[1] + plane->n[2] * ray[2];
    const double t = -value_at(plane, p->eye) / slope;
    if (!(t > 0) || fabs(slope) < 1e-3 * plane->length) { return -1; }
    double at[3], nearest = 1e30;
    int axis = 0, crossings = 0;
    for (int k = 0; k < 3; k++) {
        at[k] = p->eye[k] + t * ray[k];
        axis = fabs(plane->n[k]) > fabs(plane->n[axis]) ? k : axis;
    }
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    for (uint32_t i = 0; i < face->corners; i++) {
        const int32_t *a = face->q[i], *b = face->q[(i + 1) % face->corners];
        double side[3], off[3], along = 0, length = 0, squares = 0;
        for (int k = 0; k < 3; k++) {
            side[k] = b[k] - a[k];
            off[k] = at[k] - a[k];
            along += side[k] * off[k];
            length += side[k] * side[k];
        }
        const double part = length > 0 ? fmin(1, fmax(0, along / length)) : 0;
        for (int k = 0; k < 3; k++) {
            squares += (off[k] - part * side[k]) * (off[k] - part * side[k]);
        }
        nearest = fmin(nearest, sqrt(squares));
        if ((a[y] > at[y]) != (b[y] > at[y]) && a[x] + (at[y] - a[y]) * side[x] / side[y] > at[x]) { crossings++; }
    }
    return crossings % 2 && nearest > 2 ? t : -1;
}

static size_t check_ray(const painter_t *p, const double ray[3]) {
    double nearest = 1e30;
    size_t compared = 0;
    uint32_t by = 0;
    for (size_t i = 0; i < p->count; i++) { /* what is drawn later must not be behind what was drawn before it */
        const double t = meet(p, p->order[i], ray);
        if (t < 0) { continue; }
        compared += nearest < 1e30;
        if (t > nearest + 2) {
            fail_msg("from (%g %g %g), face %u at %g is drawn over face %u at %g", p->eye[0], p->eye[1], p->eye[2], p->order[i], t,
                     by, nearest);
        }
        if (t < nearest) {
            nearest = t;
            by = p->order[i];
        }
    }
    return compared;
}

size_t tree_check_order(const compiled_t *c, const tree_check_t *tree, int eyes, int rays, random_source_t *random) {
    painter_t p = {.c = c, .tree = tree};
    size_t compared = 0;
    p.planes = calloc(c->model.face_count, sizeof *p.planes);
    p.order = calloc(c->model.face_count, sizeof *p.order);
    assert_non_null(p.planes);
    assert_non_null(p.order);
    double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30};
    for (uint32_t f = 0; f < c->model.face_count; f++) {
        const decoder_face_t *face = &c->model.faces[f];
        double turned = 0;
        p.planes[f] = plane_of_source(&c->mesh, face->source);
        for (int k = 0; k < 3; k++) {
            turned += p.planes[f].n[k] * face->plane[k];
            low[k] = fmin(low[k], face->q[0][k]);
            high[k] = fmax(high[k], face->q[0][k]);
        }
        for (int k = 0; k < 3 && turned < 0; k++) {
            p.planes[f].n[k] = -p.planes[f].n[k];
        }
        p.planes[f].d = turned < 0 ? -p.planes[f].d : p.planes[f].d;
    }
    for (int e = 0; e < eyes; e++) {
        for (int k = 0; k < 3; k++) { /* within the model, and around it */
            const double reach = e % 2 ? 0 : high[k] - low[k];
            p.eye[k] = random_real(random, low[k] - reach, high[k] + reach);
        }
        p.count = 0;
        draw(&p, 0);
        assert_int_equal(p.count, c->model.face_count);
        for (int r = 0; r < rays; r++) {
            const decoder_face_t *at = &c->model.faces[random_between(random, 0, (int32_t)c->model.face_count - 1)];
            const uint32_t corner = (uint32_t)random_between(random, 0, (int32_t)at->corners - 1);
            const double u = random_real(random, 0, 1), v = random_real(random, 0, 1 - u);
            double ray[3], length = 0;
            for (int k = 0; k < 3; k++) { /* to a point on, or next to, a face */
                const int32_t from = at->q[corner][k];
                ray[k] = from + u * (at->q[(corner + 1) % at->corners][k] - from) +
                         v * (at->q[(corner + 2) % at->corners][k] - from) - p.eye[k];
                length += ray[k] * ray[k];
            }
            for (int k = 0; k < 3; k++) {
                ray[k] /= sqrt(length);
            }
            compared += check_ray(&p, ray);
        }
    }
    free(p.planes);
    free(p.order);
    return compared;
}

tree_check_t tree_check_all(compiled_t *c, bool closed, const mesh_options_t *options) {
    mesh_options_t with = options ? *options : (mesh_options_t){0};
    with.tree = true;
    with.step = 1;
    decoder_compile_mesh(c, &with);
    tree_check_t tree = tree_check_read(c);
    tree_check_sides(c, &tree);
    tree_check_areas(c);
    if (closed) { tree_check_closed(c); }
    return tree;
}
