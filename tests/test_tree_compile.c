/* The display tree that the model compiler makes (S9 to S11): what the document says of its size, that it is a tree by the layout
 * in geometry/model.h, that it draws from back to front, and that cutting opens no crack. */
#include "support/check.h"
#include "support/models.h"
#include "support/random.h"
#include "support/tree_check.h"
#include "support/tree_models.h"

#include <math.h>

/* ---- convex models ------------------------------------------------------------------------------------------ */

/* One node, nothing cut, all faces of a kind; outside and as a room. */
static void check_convex(void (*make)(mesh_t *mesh, unsigned size), unsigned size) {
    for (int inside = 0; inside < 2; inside++) {
        compiled_t c = {0};
        make(&c.mesh, size);
        if (inside) { tree_model_turn_inside_out(&c.mesh); }
        tree_check_t tree = tree_check_all(&c, true, NULL);
        assert_int_equal(c.report.tree.plane_nodes, 0);
        assert_int_equal(c.report.tree.convex_nodes, 1);
        assert_int_equal(c.report.tree.splits, 0);
        assert_int_equal(c.report.tree.depth, 1);
        assert_int_equal(tree.nodes[0].inward, inside ? c.mesh.face_count : 0);
        assert_int_equal(tree.nodes[0].outward, inside ? 0 : c.mesh.face_count);
        tree_check_free(&tree);
        decoder_drop(&c);
    }
}

static void make_cube(mesh_t *mesh, unsigned size) {
    model_cube(mesh);
    tree_model_scale(mesh, size);
}

static void make_icosphere(mesh_t *mesh, unsigned divisions) { tree_model_icosphere(mesh, divisions, 30000); }

static void make_hull(mesh_t *mesh, unsigned seed) {
    random_source_t random = random_seed(seed + 1);
    tree_model_hull(mesh, &random);
}

static void convex_models_are_one_node(void **state) {
    (void)state;
    check_convex(make_cube, 1);
    check_convex(make_cube, 32767);
    for (unsigned divisions = 1; divisions <= 6; divisions++) {
        check_convex(make_icosphere, divisions);
    }
    for (unsigned seed = 0; seed < CHECK_ROUNDS(32u); seed++) {
        check_convex(make_hull, seed);
    }
}

/* Convex in its own coordinates, but not quite on the grid: facets that lay in one plane, or in planes that nearly met, lean a step
 * this way or that. kind 0: a sphere of quads cut in two; 1: a prism that stands askew, its ends cut into fans of slivers. */
static void make_rounded(mesh_t *mesh, unsigned kind) {
    enum { SIDES = 40, BELTS = 24 };
    const double turn = 6.283185307179586 / SIDES;
    model_start(mesh);
    const uint32_t grey = model_material(mesh, 128, 128, 128);
    uint32_t at[BELTS + 1][SIDES];
    const int rows = kind == 0 ? BELTS + 1 : 2;
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < SIDES; j++) {
            const double polar = 3.141592653589793 * i / BELTS, r = kind == 0 ? sin(polar) : 1.0,
                         h = kind == 0 ? cos(polar) : 2 * i - 1;
            const double x = r * cos(turn * j), z = r * sin(turn * j);
            const bool pole = kind == 0 && (i == 0 || i == BELTS);
            at[i][j] = pole && j
                           ? at[i][0]
                           : model_position(mesh, 0.8 * x - 0.6 * h, 0.48 * x + 0.64 * h - 0.6 * z, 0.36 * x + 0.48 * h + 0.8 * z);
        }
    }
    for (int i = 0; i + 1 < rows; i++) {
        for (int j = 0; j < SIDES; j++) {
            const uint32_t a = at[i][j], b = at[i][(j + 1) % SIDES], c = at[i + 1][(j + 1) % SIDES], d = at[i + 1][j];
            if (kind == 1 || i > 0) { model_face(mesh, (const uint32_t[3]){a, b, d}, 3, grey); }
            if (kind == 1 || i + 2 < rows) { model_face(mesh, (const uint32_t[3]){b, c, d}, 3, grey); }
        }
    }
    for (int j = 1; kind == 1 && j + 1 < SIDES; j++) {
        model_face(mesh, (const uint32_t[3]){at[0][0], at[0][j + 1], at[0][j]}, 3, grey);
        model_face(mesh, (const uint32_t[3]){at[1][0], at[1][j], at[1][j + 1]}, 3, grey);
    }
}

/* It was 439 planes and 660 sets for a sphere of 1 840 triangles. */
static void what_was_convex_before_it_was_rounded_is_one_node(void **state) {
    (void)state;
    for (unsigned kind = 0; kind < 2; kind++) {
        mesh_t mesh = {0};
        mesh_report_t report;
        sim_error_t error = {""};
        uint8_t *bytes;
        size_t size_bytes;
        const mesh_options_t options = {.tree = true};
        make_rounded(&mesh, kind);
        assert_int_equal(mesh_compile(&mesh, &options, &bytes, &size_bytes, &report, &error), 0);
        assert_int_equal(report.tree.plane_nodes, 0);
        assert_int_equal(report.tree.convex_nodes, 1);
        assert_int_equal(report.tree.faces_out, mesh.face_count);
        free(bytes);
        mesh_free(&mesh);
    }
}

/* A dent of ten steps is none of rounding: the two faces of a folded sheet are not one set. On an exact grid neither is one step.
 */
static void a_dent_is_not_rounded_away(void **state) {
    (void)state;
    for (int exact = 0; exact < 2; exact++) {
        mesh_t mesh = {0};
        mesh_report_t report;
        sim_error_t error = {""};
        uint8_t *bytes;
        size_t size_bytes;
        const double dent = exact ? 1 : 10, off = exact ? 0 : 0.4;
        const mesh_options_t options = {.tree = true, .step = 1};
        const double low[3] = {-1000 + off, -1000, -1000}, high[3] = {1000, 1000 + off, 1000};
        model_start(&mesh);
        const uint32_t grey = model_material(&mesh, 128, 128, 128);
        model_box(&mesh, low, high, grey);
        uint32_t *corner = mesh.corners + mesh.faces[4].first; /* the top becomes four triangles round a middle that lies deeper */
        uint32_t rim[4];
        memcpy(rim, corner, sizeof rim);
        const uint32_t middle = model_position(&mesh, 0, 1000 - dent, 0);
        mesh.face_count = 4;
        model_face(&mesh, (const uint32_t[3]){rim[0], rim[1], middle}, 3, grey);
        model_face(&mesh, (const uint32_t[3]){rim[1], rim[2], middle}, 3, grey);
        model_face(&mesh, (const uint32_t[3]){rim[2], rim[3], middle}, 3, grey);
        model_face(&mesh, (const uint32_t[3]){rim[3], rim[0], middle}, 3, grey);
        assert_int_equal(mesh_compile(&mesh, &options, &bytes, &size_bytes, &report, &error), 0);
        assert_true(report.tree.convex_nodes + report.tree.plane_nodes > 1);
        free(bytes);
        mesh_free(&mesh);
    }
}

/* A list in one plane has an inside on neither side; and a single face is convex. */
static void a_flat_model_is_one_node(void **state) {
    (void)state;
    compiled_t c = {0};
    model_start(&c.mesh);
    for (int i = 0; i < 3; i++) {
        const int32_t corners[4][3] = {{100 * i, 0, 0}, {100 * i + 150, 0, 0}, {100 * i + 150, 90, 45}, {100 * i, 90, 45}};
        tree_model_quad(&c.mesh, corners);
    }
    tree_check_t tree = tree_check_all(&c, false, NULL);
    assert_int_equal(tree.node_count, 1);
    assert_int_equal(tree.nodes[0].outward, 3);
    for (uint32_t f = 0; f < 3; f++) {
        assert_int_equal(c.model.faces[f].source, f);
    }
    tree_check_free(&tree);
    decoder_drop(&c);
}

/* ---- nested sets -------------------------------------------------------------------------------------------- */

/* The document's own example: n steps, that is n risers and n treads, take n nodes of type 1 and none of type 2. From the hull of
 * what is left the lowest riser and the highest tread are taken each time. */
static void a_staircase_of_n_steps_has_n_nodes(void **state) {
    (void)state;
    for (int n = 1; n <= 12; n++) {
        compiled_t c = {0};
        model_start(&c.mesh);
        for (int i = 0; i < n; i++) {
            const int32_t x = 200 * i, y = 150 * i;
            const int32_t riser[4][3] = {{x, y, 0}, {x, y, 700}, {x, y + 150, 700}, {x, y + 150, 0}};
            const int32_t tread[4][3] = {{x, y + 150, 0}, {x, y + 150, 700}, {x + 200, y + 150, 700}, {x + 200, y + 150, 0}};
            tree_model_quad(&c.mesh, riser);
            tree_model_quad(&c.mesh, tread);
        }
        tree_check_t tree = tree_check_all(&c, false, NULL);
        random_source_t random = random_seed(7);
        assert_int_equal(c.report.tree.plane_nodes, 0);
        assert_int_equal(c.report.tree.convex_nodes, n);
        assert_int_equal(c.report.tree.splits, 0);
        assert_int_equal(c.report.faces, 2 * n);
        for (int i = 0; i < n; i++) {
            assert_int_equal(tree.nodes[i].inward + tree.nodes[i].outward, 2);
        }
        (void)tree_check_order(&c, &tree, 40, 20, &random);
        tree_check_free(&tree);
        decoder_drop(&c);
    }
}

static void nested_boxes_are_nodes_within_one_another(void **state) {
    enum { BOXES = 9 };
    (void)state;
    compiled_t c = {0};
    model_start(&c.mesh);
    for (int i = 0; i < BOXES; i++) { /* out of their order; every other one is a room */
        const int32_t size = 100 * ((i * 4) % BOXES + 1);
        tree_model_box(&c.mesh, -size, -size, -size, size + 3, size + 2, size + 1);
    }
    for (int i = 0; i < BOXES; i += 2) {
        mesh_t part = c.mesh;
        part.faces += 6 * i;
        part.face_count = 6;
        tree_model_turn_inside_out(&part);
    }
    tree_check_t tree = tree_check_all(&c, true, NULL);
    random_source_t random = random_seed(8);
    assert_int_equal(c.report.tree.plane_nodes, 0);
    assert_int_equal(c.report.tree.convex_nodes, BOXES);
    assert_int_equal(c.report.tree.depth, BOXES);
    for (int n = 0; n < BOXES; n++) { /* from the largest */
        const tree_check_node_t *node = &tree.nodes[n];
        const uint32_t one_of = c.model.faces[node->first].source / 6;
        assert_int_equal(node->inward, one_of % 2 ? 0 : 6);
        assert_int_equal(node->outward, one_of % 2 ? 6 : 0);
        assert_int_equal((one_of * 4) % BOXES, BOXES - 1 - n);
    }
    assert_true(tree_check_order(&c, &tree, 100, 20, &random) > 1000);
    tree_check_free(&tree);
    decoder_drop(&c);
}

/* ---- models that must be cut -------------------------------------------------------------------------------- */

/* Each of three slivers lies over the next one: none has the others on one side, and no order of whole faces is right. */
static void faces_that_overlap_in_a_ring_are_cut(void **state) {
    static const double turns[3][2] = {{1, 0}, {-0.5, 0.8660254}, {-0.5, -0.8660254}};
    (void)state;
    compiled_t c = {0};
    model_start(&c.mesh);
    for (int i = 0; i < 3; i++) {
        static const int32_t sliver[3][3] = {{-1000, -300, -200}, {1000, -300, 200}, {1000, -240, 200}};
        int32_t turned[3][3];
        for (int k = 0; k < 3; k++) {
            turned[k][0] = (int32_t)lround(sliver[k][0] * turns[i][0] - sliver[k][1] * turns[i][1]);
            turned[k][1] = (int32_t)lround(sliver[k][0] * turns[i][1] + sliver[k][1] * turns[i][0]);
            turned[k][2] = sliver[k][2];
        }
        tree_model_triangle(&c.mesh, turned);
    }
    tree_check_t tree = tree_check_all(&c, false, NULL);
    random_source_t random = random_seed(9);
    assert_int_equal(tree.nodes[0].kind, 2);
    assert_true(c.report.tree.splits >= 1);
    (void)tree_check_order(&c, &tree, 200, 50, &random);
    tree_check_free(&tree);
    decoder_drop(&c);
}

/* Three bars, each over the second and under the third, closed: 18 faces. */
static void bars_that_overlap_in_a_ring_stay_closed(void **state) {
    (void)state;
    compiled_t c = {0};
    random_source_t random = random_seed(10);
    model_start(&c.mesh);
    tree_model_box(&c.mesh, -900, -200, -60, 900, -100, 60);
    tree_model_box(&c.mesh, 100, -900, 0, 220, 900, 170);
    tree_model_box(&c.mesh, -120, -300, -300, -20, -30, 300);
    tree_model_box(&c.mesh, -400, -70, -200, 400, 60, -130);
    model_flat_normals(&c.mesh);
    tree_check_t tree = tree_check_all(&c, true, NULL);
    assert_true(c.report.tree.splits > 0 && c.report.tree.plane_nodes > 0);
    assert_true(tree_check_order(&c, &tree, 100, 60, &random) > 1000);
    tree_check_free(&tree);
    decoder_drop(&c);
}

/* Triangles that cross each other anywhere, over the whole range of coordinates: normals of 34 bits. */
static void random_triangles_are_drawn_from_back_to_front(void **state) {
    (void)state;
    random_source_t random = random_seed(11);
    size_t splits = 0, compared = 0;
    for (int round = 0; round < CHECK_ROUNDS(48); round++) {
        compiled_t c = {0};
        const int32_t size = round % 3 == 0 ? 32767 : round % 3 == 1 ? 3000 : 40;
        model_start(&c.mesh);
        for (int t = 0; t < 24; t++) {
            int32_t corners[3][3];
            for (int i = 0; i < 9; i++) {
                corners[i / 3][i % 3] = random_between(&random, -size, size);
            }
            tree_model_triangle(&c.mesh, corners);
        }
        tree_check_t tree = tree_check_all(&c, false, NULL);
        splits += c.report.tree.splits;
        compared += tree_check_order(&c, &tree, 20, 40, &random);
        tree_check_free(&tree);
        decoder_drop(&c);
    }
    assert_true(splits > (size_t)CHECK_ROUNDS(48) * 20 && compared > (size_t)CHECK_ROUNDS(48) * 200);
}

/* Closed models through one another: no side is left without its opposite, whatever was cut and rounded. small: faces of few
 * steps, of which many vanish. */
static void what_was_closed_stays_closed(void **state) {
    (void)state;
    random_source_t random = random_seed(12);
    size_t seams = 0, dropped = 0;
    for (int round = 0; round < CHECK_ROUNDS(24); round++) {
        compiled_t c = {0};
        const int32_t size = round % 2 ? 24 : 30000;
        model_start(&c.mesh);
        for (int i = 0; i < 10; i++) { /* tetrahedra */
            int32_t at[4][3];
            for (int k = 0; k < 12; k++) {
                at[k / 3][k % 3] = random_between(&random, -size, size);
            }
            if (tree_model_volume(at[0], at[1], at[2], at[3]) == 0) { continue; }
            static const uint8_t faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
            uint32_t places[4];
            for (int k = 0; k < 4; k++) {
                places[k] = model_position(&c.mesh, at[k][0], at[k][1], at[k][2]);
            }
            for (int f = 0; f < 4; f++) {
                const uint32_t corners[3] = {places[faces[f][0]], places[faces[f][1]], places[faces[f][2]]};
                model_face(&c.mesh, corners, 3, model_material(&c.mesh, 200, 200, 200));
            }
        }
        if (round % 4 < 2) { model_flat_normals(&c.mesh); } /* pieces stay polygons, or become triangles */
        tree_check_t tree = tree_check_all(&c, true, NULL);
        seams += c.report.tree.seam_corners;
        dropped += c.report.tree.dropped;
        (void)tree_check_order(&c, &tree, 10, 40, &random);
        tree_check_free(&tree);
        decoder_drop(&c);
    }
    assert_true(seams > (size_t)CHECK_ROUNDS(24) * 10 && (CHECK_SANITIZED || dropped > 0));
}

static void a_torus_stays_closed(void **state) {
    (void)state;
    compiled_t c = {0};
    random_source_t random = random_seed(13);
    model_torus(&c.mesh, 12, 8, true);
    tree_model_scale(&c.mesh, 9000);
    tree_check_t tree = tree_check_all(&c, true, NULL);
    assert_true(tree_check_order(&c, &tree, 40, 40, &random) > 500);
    tree_check_free(&tree);
    decoder_drop(&c);
}

/* Polygons that are not convex: cut, their parts hang together by sides that lie upon one another. */
static void stars_through_one_another_stay_closed(void **state) {
    static const int32_t axes[4][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                          {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
                                          {{2, 1, 2}, {-2, 2, 1}, {-1, -2, 2}},
                                          {{6, 2, 3}, {-3, 6, 2}, {-2, -3, 6}}};
    (void)state;
    random_source_t random = random_seed(14);
    for (int round = 0; round < CHECK_ROUNDS(16); round++) {
        compiled_t c = {0};
        model_start(&c.mesh);
        for (int i = 0; i < 3; i++) {
            const int32_t middle[3] = {random_between(&random, -200, 200), random_between(&random, -200, 200),
                                       random_between(&random, -200, 200)};
            tree_model_star_bar(&c.mesh, random_between(&random, 3, 7), axes[(round + i) % 4], middle);
        }
        model_flat_normals(&c.mesh);
        tree_check_t tree = tree_check_all(&c, true, NULL);
        assert_int_equal(c.report.tree.non_planar, 0);
        assert_true(c.report.polygons > 20);
        assert_true(tree_check_order(&c, &tree, 10, 60, &random) > 100);
        tree_check_free(&tree);
        decoder_drop(&c);
    }
}

/* A model as people make them: open, with faces through one another and upon one another. */
static void a_spider_is_drawn_from_back_to_front(void **state) {
    (void)state;
    compiled_t c = {0};
    sim_error_t error = {""};
    random_source_t random = random_seed(15);
    const char *path = getenv("SPIDER");
    if (!path) { skip(); }
    assert_int_equal(mesh_import(&c.mesh, path, &error), 0);
    double most = 0;
    for (size_t p = 0; p < c.mesh.position_count; p++) {
        for (int k = 0; k < 3; k++) {
            most = fmax(most, fabs(c.mesh.positions[p][k]));
        }
    }
    tree_model_scale(&c.mesh, 32000 / most);
    tree_check_t tree = tree_check_all(&c, false, NULL);
    assert_true(c.report.tree.splits > 500);
    assert_true(tree_check_order(&c, &tree, 16, 60, &random) > 1000);
    tree_check_free(&tree);
    decoder_drop(&c);
}

/* ---- what else is promised ---------------------------------------------------------------------------------- */

static void a_bent_polygon_is_split_and_counted(void **state) {
    (void)state;
    compiled_t c = {0};
    model_start(&c.mesh);
    const int32_t bent[4][3] = {{0, 0, 0}, {1000, 0, 0}, {1000, 1000, 1}, {0, 1000, 0}}; /* a quarter of a step: planar elsewhere */
    tree_model_quad(&c.mesh, bent);
    mesh_options_t options = {.step = 1};
    decoder_compile_mesh(&c, &options);
    assert_int_equal(c.report.faces, 1);
    assert_int_equal(c.report.non_planar, 0);
    assert_int_equal(decoder_u32(c.bytes + 96), 0);
    assert_int_equal(decoder_u32(c.bytes + 100), 0);
    free(c.bytes);
    free(c.model.faces);
    options.tree = true;
    decoder_compile_mesh(&c, &options);
    assert_int_equal(c.report.faces, 2);
    assert_int_equal(c.report.non_planar, 1);
    assert_int_equal(c.report.tree.non_planar, 1);
    decoder_drop(&c);
}

/* An outline whose area, counted with its sign, is 0 has a plane all the same. It and a triangle go through one another: one of
 * them is cut in two, and that is the whole tree. */
static void a_bow_tie_is_cut_as_any_face(void **state) {
    static const int32_t bow[4][3] = {{0, 0, 0}, {100, 100, 0}, {100, 0, 0}, {0, 100, 0}};
    static const int32_t through[3][3] = {{30, -20, -70}, {30, 130, -70}, {30, 60, 90}};
    (void)state;
    compiled_t c = {0};
    model_start(&c.mesh);
    tree_model_quad(&c.mesh, bow);
    tree_model_triangle(&c.mesh, through);
    const mesh_options_t options = {.tree = true, .step = 1, .two_sided = true, .keep_planar = true, .keep_order = true};
    decoder_compile_mesh(&c, &options);
    tree_check_t tree = tree_check_read(&c);
    assert_int_equal(c.report.faces, 3);
    assert_int_equal(c.report.tree.splits, 1);
    assert_int_equal(c.report.tree.plane_nodes, 1);
    assert_int_equal(c.report.tree.convex_nodes, 2 + (tree.nodes[1].child[0] >= 0));
    assert_int_equal(c.report.non_planar, 0);
    tree_check_free(&tree);
    decoder_drop(&c);
}

/* Of faces in one plane the one with the lower number in the file wins a tie. Two-sided, they are all turned outwards, so that
 * they stand in one list, in the order of the source. */
static void coplanar_faces_keep_their_order(void **state) {
    (void)state;
    for (int two_sided = 0; two_sided < 2; two_sided++) {
        compiled_t c = {0};
        model_start(&c.mesh);
        tree_model_box(&c.mesh, 0, 0, -900, 1000, 1000, -800);
        for (int i = 0; i < 100; i++) { /* above the box, seen from above and from below in turn */
            const int32_t x = 9 * (i * 37 % 100), up[4][3] = {{x, 0, 0}, {x + 50, 0, 0}, {x + 50, 300, 0}, {x, 300, 0}};
            const int32_t down[4][3] = {{x, 0, 0}, {x, 300, 0}, {x + 50, 300, 0}, {x + 50, 0, 0}};
            tree_model_quad(&c.mesh, i % 2 ? down : up);
        }
        model_flat_normals(&c.mesh);
        const mesh_options_t options = {.two_sided = two_sided, .keep_order = two_sided};
        tree_check_t tree = tree_check_all(&c, false, &options);
        const tree_check_node_t *node = &tree.nodes[0];
        uint32_t at[2] = {0}, last[2] = {0};
        assert_int_equal(node->inward, two_sided ? 0 : 50);
        assert_int_equal(node->outward, two_sided ? 100 + 5 : 50 + 5); /* the box is open above: its top is not on the hull */
        for (uint32_t i = 0; i < node->inward + node->outward; i++) {
            const decoder_face_t *face = &c.model.faces[node->first + i];
            if (face->source < 6) { continue; }
            const int list = i >= node->inward;
            assert_true(at[list]++ == 0 || face->source > last[list]);
            last[list] = face->source;
            double n[3];
            decoder_plane(face, n);
            assert_true(n[2] * face->plane[2] > 0 && face->normals[0][2] == face->plane[2]);
            assert_true(list == 0 ? face->plane[2] < 0 : face->plane[2] > 0);
        }
        assert_int_equal(at[0] + at[1], 100);
        tree_check_free(&tree);
        decoder_drop(&c);
    }
}

/* Faces that share no vertex, all in one node: 128 vertices are 42 triangles, 255 are 4 of these polygons. The reader checks the
 * limits of vertices. */
static void clusters_keep_to_their_limits(void **state) {
    (void)state;
    for (int polygons = 0; polygons < 2; polygons++) {
        compiled_t c = {0};
        model_start(&c.mesh);
        for (int i = 0; i < 200; i++) {
            const double x = polygons ? i : 150 * (i % 20),
                         y = 150 * (i / 20) * !polygons; /* polygons upon one another: joining them is cheap */
            const uint32_t count = polygons ? 60 : 3;
            uint32_t corners[60];
            for (uint32_t k = 0; k < count; k++) {
                const double turn = 6.283185307179586 * k / count;
                corners[k] = model_position(&c.mesh, round(x + 70 * cos(turn)), round(y + 70 * sin(turn)), 5);
            }
            model_face(&c.mesh, corners, count, model_material(&c.mesh, 200, 200, 200));
        }
        tree_check_t tree = tree_check_all(&c, false, NULL);
        assert_int_equal(tree.node_count, 1);
        assert_true(c.report.clusters >= (polygons ? 50 : 5));
        tree_check_free(&tree);
        decoder_drop(&c);
    }
}

static void the_same_mesh_gives_the_same_bytes(void **state) {
    (void)state;
    compiled_t c = {0};
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes;
    model_torus(&c.mesh, 12, 8, true);
    tree_model_scale(&c.mesh, 900);
    tree_check_t tree = tree_check_all(&c, true, NULL);
    const mesh_options_t options = {.tree = true, .step = 1};
    assert_int_equal(mesh_compile(&c.mesh, &options, &bytes, &size_bytes, NULL, &error), 0);
    assert_int_equal(size_bytes, c.size_bytes);
    assert_memory_equal(bytes, c.bytes, size_bytes);
    free(bytes);
    tree_check_free(&tree);
    decoder_drop(&c);
}

typedef struct heard {
    size_t calls, done, of;
} heard_t;

static void hear(void *context, size_t done, size_t of) {
    heard_t *heard = context;
    assert_true(done <= of && done >= heard->done && of >= heard->of);
    *heard = (heard_t){heard->calls + 1, done, of};
}

static void progress_goes_to_its_end(void **state) {
    (void)state;
    compiled_t c = {0};
    heard_t heard = {0};
    model_torus(&c.mesh, 12, 8, true);
    tree_model_scale(&c.mesh, 900);
    const mesh_options_t options = {.progress = hear, .progress_context = &heard};
    tree_check_t tree = tree_check_all(&c, true, &options);
    assert_true(heard.calls > 10);
    assert_int_equal(heard.done, heard.of);
    assert_int_equal(heard.of, c.mesh.face_count + c.report.tree.splits);
    tree_check_free(&tree);
    decoder_drop(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(convex_models_are_one_node),
        cmocka_unit_test(what_was_convex_before_it_was_rounded_is_one_node),
        cmocka_unit_test(a_dent_is_not_rounded_away),
        cmocka_unit_test(a_flat_model_is_one_node),
        cmocka_unit_test(a_staircase_of_n_steps_has_n_nodes),
        cmocka_unit_test(nested_boxes_are_nodes_within_one_another),
        cmocka_unit_test(faces_that_overlap_in_a_ring_are_cut),
        cmocka_unit_test(bars_that_overlap_in_a_ring_stay_closed),
        cmocka_unit_test(random_triangles_are_drawn_from_back_to_front),
        cmocka_unit_test(what_was_closed_stays_closed),
        cmocka_unit_test(a_torus_stays_closed),
        cmocka_unit_test(stars_through_one_another_stay_closed),
        cmocka_unit_test(a_spider_is_drawn_from_back_to_front),
        cmocka_unit_test(a_bent_polygon_is_split_and_counted),
        cmocka_unit_test(a_bow_tie_is_cut_as_any_face),
        cmocka_unit_test(coplanar_faces_keep_their_order),
        cmocka_unit_test(clusters_keep_to_their_limits),
        cmocka_unit_test(the_same_mesh_gives_the_same_bytes),
        cmocka_unit_test(progress_goes_to_its_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
