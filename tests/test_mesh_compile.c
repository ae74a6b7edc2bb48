/* The model compiler: what it makes of small models whose outcome is known by hand, and, by brute force, whether the spheres and
 * cones it writes for larger ones say the truth. The bytes are read back by a reader of our own. */
#include "support/check.h"

#include <math.h>

#include "../raster/geometry/model.h"
#include "../sim/mesh/mesh.h"
#include "../sim/mesh/stages.h"
#include "support/decoder.h"
#include "support/folder.h"

/* ---- small models ----------------------------------------------------------------------------------------------- */

static void test_cube(void **state) {
    (void)state;
    compiled_t c = decoder_compile_file(folder_put_text("cube.obj", DECODER_CUBE_VERTICES DECODER_CUBE_FACES), NULL);
    assert_int_equal(c.mesh.position_count, 8);
    assert_int_equal(c.mesh.source_face_count, 6);
    assert_int_equal(c.report.faces, 6);
    assert_int_equal(c.report.polygons, 6);
    assert_int_equal(c.report.non_planar + c.report.split + c.report.skipped, 0);
    assert_true(c.report.quantisation_error == 0);
    assert_true(c.model.step == 1.0 / 16384); /* the finest power of two that holds 1 in 32767 steps */
    decoder_check_faces(&c.model, &c.mesh);
    const int8_t planes[6][3] = {{0, 0, -127}, {0, 0, 127}, {0, -127, 0}, {0, 127, 0}, {-127, 0, 0}, {127, 0, 0}};
    for (uint32_t s = 0; s < 6; s++) { /* edges of 90 degrees are not smoothed: all normals are the plane's */
        const decoder_face_t *face = decoder_face_of_source(&c.model, s);
        assert_memory_equal(face->plane, planes[s], 3);
        assert_true(face->convex);
        for (int i = 0; i < 4; i++) {
            assert_memory_equal(face->normals[i], planes[s], 3);
        }
    }
    assert_true(decoder_check_cones(&c.model, 300) > 0);
    decoder_drop(&c);
}

static void test_smooth_normals(void **state) {
    (void)state;
    /* Two squares with 45 degrees between them: smooth across the shared edge x = 0, flat at the other ends. */
    compiled_t c = decoder_compile_file(folder_put_text("roof.obj", "v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv -1 1 1\nv -1 0 1\n"
                                                                    "f 4 3 2 1\nf 1 2 5 6\n"),
                                        NULL);
    const decoder_face_t *flat = decoder_face_of_source(&c.model, 0);
    /* Halfway between (0, 0, 1) and (1, 0, 1) / sqrt 2: sin and cos of 22.5 degrees are 0.38268 and 0.92388. */
    const int8_t own[3] = {0, 0, 127}, mean[3] = {49, 0, 117};
    assert_memory_equal(flat->normals[0], own, 3);
    assert_memory_equal(flat->normals[1], own, 3);
    assert_memory_equal(flat->normals[2], mean, 3);
    assert_memory_equal(flat->normals[3], mean, 3);
    decoder_drop(&c);
}

static void test_palette(void **state) {
    (void)state;
    static uint8_t colours[4096][3], palette[256][3];
    static uint32_t index[4096];
    size_t count;
    for (int i = 0; i < 4096; i++) {
        colours[i][0] = (uint8_t)(i % 16 * 17);
        colours[i][1] = (uint8_t)(i / 16 % 16 * 17);
        colours[i][2] = (uint8_t)(i / 256 * 17);
    }
    assert_int_equal(mesh_palette((const uint8_t(*)[3])colours, 256, palette, &count, index), 0);
    assert_int_equal(count, 256);
    for (size_t i = 0; i < 256; i++) { /* 256 colours are kept, in order of first use */
        assert_int_equal(index[i], i);
        assert_memory_equal(palette[i], colours[i], 3);
    }
    assert_int_equal(mesh_palette((const uint8_t(*)[3])colours, 4096, palette, &count, index), 0);
    assert_int_equal(count, 256);
    for (size_t i = 0; i < 4096; i++) { /* 16 neighbours to a colour: within two levels of 17 in each channel */
        for (int k = 0; k < 3; k++) {
            assert_true(abs(palette[index[i]][k] - colours[i][k]) <= 34);
        }
    }
}

/* ---- larger models ---------------------------------------------------------------------------------------------- */

/* A lumpy ball of quads (bent a little, so cut or not as the lumps have it) with triangles at the poles; alternate == true paints
 * its halves in two colours. */
static mesh_t make_ball(uint32_t rings, uint32_t sectors, double lumps) {
    mesh_t mesh = {0};
    size_t faces = (size_t)rings * sectors;
    mesh.position_count = (rings - 1) * sectors + 2;
    mesh.positions = calloc(mesh.position_count, sizeof *mesh.positions);
    mesh.corners = calloc(4 * faces, sizeof *mesh.corners);
    mesh.faces = calloc(faces, sizeof *mesh.faces);
    mesh.materials = calloc(2, sizeof *mesh.materials);
    assert_true(mesh.positions && mesh.corners && mesh.faces && mesh.materials);
    mesh.material_count = 2;
    mesh.materials[0][0] = 200;
    mesh.materials[1][2] = 200;
    for (uint32_t r = 1; r < rings; r++) {
        for (uint32_t s = 0; s < sectors; s++) {
            double u = 3.14159265358979 * r / rings, v = 2 * 3.14159265358979 * s / sectors,
                   radius = 10 + lumps * decoder_random_unit();
            double *at = mesh.positions[(r - 1) * sectors + s];
            at[0] = radius * sin(u) * cos(v) + 3;
            at[1] = radius * cos(u) - 100;
            at[2] = -radius * sin(u) * sin(v);
        }
    }
    uint32_t top = (uint32_t)mesh.position_count - 2, bottom = top + 1;
    memcpy(mesh.positions[top], (const double[3]){3, -90, 0}, sizeof mesh.positions[top]);
    memcpy(mesh.positions[bottom], (const double[3]){3, -110, 0}, sizeof mesh.positions[bottom]);
    for (uint32_t r = 0; r < rings; r++) {
        for (uint32_t s = 0; s < sectors; s++) {
            uint32_t next = (s + 1) % sectors, *c = mesh.corners + mesh.corner_count;
            uint32_t a = r ? (r - 1) * sectors + s : top, b = r + 1 < rings ? r * sectors + s : bottom;
            uint32_t d = r + 1 < rings ? r * sectors + next : bottom, e = r ? (r - 1) * sectors + next : top;
            uint32_t count = 0;
            c[count++] = a;
            c[count++] = b;
            if (d != b) { c[count++] = d; }
            if (e != a) { c[count++] = e; }
            mesh.faces[mesh.face_count] = (mesh_face_t){.first = (uint32_t)mesh.corner_count,
                                                        .count = count,
                                                        .material = s < sectors / 2,
                                                        .source = (uint32_t)mesh.face_count};
            mesh.face_count++;
            mesh.corner_count += count;
        }
    }
    mesh.source_face_count = mesh.face_count;
    return mesh;
}

static void test_ball(void **state) {
    (void)state;
    const double lumps[3] = {0, 0.05, 2};
    for (int l = 0; l < 3; l++) {
        const mesh_options_t keep = {.keep_planar = true};
        for (int kept = 0; kept < 2; kept++) {
            decoder_random_seed(7);
            compiled_t c = {.mesh = make_ball(24, 48, lumps[l])};
            decoder_compile_mesh(&c, kept ? &keep : NULL);
            if (kept || l == 0) { /* rings of trapezoids: planar */
                decoder_check_faces(&c.model, &c.mesh);
                assert_int_equal(c.report.polygons, 22 * 48);
            } else {
                assert_true(c.report.non_planar > 500);
                assert_int_equal(c.report.faces, 24 * 48 + c.report.non_planar);
            }
            assert_true(c.report.quantisation_error > 0 && c.report.quantisation_error <= c.model.step * 0.8661);
            assert_true(kept || l == 2 || c.report.clusters < c.report.faces / 6); /* where faces share vertices and normals */
            size_t away = decoder_check_cones(&c.model, 60);
            assert_true(l == 2 || away > 60 * c.report.faces / 5); /* of those that face away, about half, most are found */
            decoder_drop(&c);
        }
    }
}

/* A soup of triangles without a common edge ends in clusters all the same, which are disjoint and complete. */
static void test_soup(void **state) {
    (void)state;
    compiled_t c = {.mesh = make_ball(16, 32, 0)};
    double(*positions)[3] = calloc(c.mesh.corner_count, sizeof *positions);
    assert_non_null(positions);
    for (size_t f = 0; f < c.mesh.face_count; f++) {
        for (uint32_t i = 0; i < c.mesh.faces[f].count; i++) { /* each face drawn in a little */
            uint32_t at = c.mesh.faces[f].first + i;
            for (int k = 0; k < 3; k++) {
                double middle = 0;
                for (uint32_t j = 0; j < c.mesh.faces[f].count; j++) {
                    middle += c.mesh.positions[c.mesh.corners[c.mesh.faces[f].first + j]][k] / c.mesh.faces[f].count;
                }
                positions[at][k] = middle + 0.9 * (c.mesh.positions[c.mesh.corners[at]][k] - middle);
            }
        }
    }
    for (size_t i = 0; i < c.mesh.corner_count; i++) {
        c.mesh.corners[i] = (uint32_t)i;
    }
    free(c.mesh.positions);
    c.mesh.positions = positions;
    c.mesh.position_count = c.mesh.corner_count;
    decoder_compile_mesh(&c, NULL);
    decoder_check_faces(&c.model, &c.mesh);
    assert_true(c.report.clusters <= c.report.faces / 2); /* with nothing to share, a face more or less is not worth much */
    (void)decoder_check_cones(&c.model, 30);
    decoder_drop(&c);
}

static void test_keep_order(void **state) {
    (void)state;
    compiled_t c = {.mesh = make_ball(24, 48, 0)};
    const mesh_options_t options = {.keep_order = true, .keep_planar = true};
    decoder_compile_mesh(&c, &options);
    decoder_check_faces(&c.model, &c.mesh);
    for (uint32_t f = 0; f < c.model.face_count; f++) {
        assert_int_equal(c.model.faces[f].source, f);
    }
    assert_int_equal(decoder_u32(c.bytes + 92), 0); /* no map needed */
    assert_true(decoder_check_cones(&c.model, 30) > 0);
    decoder_drop(&c);
}

static void test_wide_source_map(void **state) {
    (void)state;
    compiled_t c = {.mesh = make_ball(6, 12, 0)};
    c.mesh.source_face_count = 70000;
    c.mesh.faces[5].source = 69999;
    decoder_compile_mesh(&c, NULL);
    assert_int_equal(decoder_u16(c.bytes + 14), MODEL_FLAG_SOURCE32);
    decoder_check_faces(&c.model, &c.mesh);
    decoder_drop(&c);
}

static void test_same_bytes(void **state) {
    (void)state;
    compiled_t a = {.mesh = make_ball(20, 30, 1)}, b = {.mesh = a.mesh};
    decoder_compile_mesh(&a, NULL);
    decoder_compile_mesh(&b, NULL);
    assert_int_equal(a.size_bytes, b.size_bytes);
    assert_memory_equal(a.bytes, b.bytes, a.size_bytes);
    b.mesh = (mesh_t){0};
    decoder_drop(&a);
    decoder_drop(&b);
}

static void test_simplify(void **state) {
    (void)state;
    const size_t targets[4] = {3000, 1000, 200, 20};
    for (int t = 0; t < 4; t++) {
        compiled_t c = {.mesh = make_ball(40, 80, 0.02)};
        sim_error_t error = {""};
        assert_int_equal(mesh_simplify(&c.mesh, targets[t], &error), 0);
        assert_true(c.mesh.face_count <= targets[t] && c.mesh.face_count > targets[t] / 2);
        assert_int_equal(c.mesh.source_face_count, c.mesh.face_count);
        decoder_compile_mesh(&c, NULL);
        size_t colours[2] = {0, 0}, outward = 0;
        for (uint32_t f = 0; f < c.model.face_count; f++) {
            const decoder_face_t *face = &c.model.faces[f];
            double n[3], from_middle = 0;
            decoder_plane(face, n);
            for (int k = 0; k < 3; k++) {
                from_middle += n[k] * (c.model.step * (face->q[0][k] + c.model.offset[k]) - (k == 0 ? 3 : k == 1 ? -100 : 0));
            }
            outward += from_middle > 0;
            colours[face->material]++;
        }
        assert_true(outward >= c.model.face_count - c.model.face_count / 50); /* it is still a ball, and not inside out */
        assert_true(colours[0] > 0 && colours[1] > 0);
        (void)decoder_check_cones(&c.model, 20);
        decoder_drop(&c);
    }
    compiled_t cube = {.mesh = make_ball(4, 4, 0)};
    sim_error_t error = {""};
    size_t before = cube.mesh.face_count;
    assert_int_equal(mesh_simplify(&cube.mesh, 0, &error), -1);
    assert_int_equal(mesh_simplify(&cube.mesh, 24, &error), 0); /* 8 quads and 8 triangles make 24 */
    assert_int_equal(cube.mesh.face_count, before);
    assert_int_equal(cube.mesh.faces[5].count, 4);
    mesh_free(&cube.mesh);
}

/* ---- the grid --------------------------------------------------------------------------------------------------- */

static void compile_triangle(compiled_t *c, double scale, double shift, double step) {
    static const double places[3][3] = {{0, 0, 0}, {1, 0, 0.25}, {0, 1, 0}};
    *c = (compiled_t){0};
    c->mesh = (mesh_t){.position_count = 3, .corner_count = 3, .face_count = 1, .material_count = 1, .source_face_count = 1};
    c->mesh.positions = calloc(3, sizeof *c->mesh.positions);
    c->mesh.corners = calloc(3, sizeof *c->mesh.corners);
    c->mesh.faces = calloc(1, sizeof *c->mesh.faces);
    c->mesh.materials = calloc(1, sizeof *c->mesh.materials);
    assert_true(c->mesh.positions && c->mesh.corners && c->mesh.faces && c->mesh.materials);
    c->mesh.faces[0].count = 3;
    for (uint32_t i = 0; i < 3; i++) {
        c->mesh.corners[i] = i;
        for (int k = 0; k < 3; k++) {
            c->mesh.positions[i][k] = places[i][k] * scale + shift;
        }
    }
    const mesh_options_t options = {.step = step};
    decoder_compile_mesh(c, &options);
    decoder_check_faces(&c->model, &c->mesh);
}

static void test_grid(void **state) {
    (void)state;
    compiled_t c;
    compile_triangle(&c, 4, 32763, 0); /* integers up to 32767: exact in steps of 1, as they stand */
    assert_true(c.report.quantisation_error == 0 && c.model.step == 1 && c.model.offset[0] == 0);
    decoder_drop(&c);
    compile_triangle(&c, 4, 32764, 0); /* 32768 is one too far for that */
    assert_true(c.model.step < 1.001 * 4 / 65533 && c.model.offset[0] != 0);
    assert_true(c.report.quantisation_error < c.model.step);
    decoder_drop(&c);
    compile_triangle(&c, 4, 0.3, 0.0625); /* a step of one's own: offset 0 */
    assert_true(c.model.step == 0.0625 && c.model.offset[1] == 0);
    assert_int_equal(decoder_u32(c.bytes + 48), 2147483648u);
    decoder_drop(&c);
    compile_triangle(&c, 1e-30, 0, 0);
    assert_true(c.model.step < 1.001e-30 / 16384);
    decoder_drop(&c);
    compile_triangle(&c, 1e30, 1e29, 0);
    decoder_drop(&c);
    compile_triangle(&c, 1, 1e7, 0); /* far from the origin: the offset's 31 bits limit the step */
    assert_true(c.model.step < 1e7 / 2147000000.0 + 1.001 / 65533);
    decoder_drop(&c);
    for (int i = 0; i < 2000; i++) { /* nothing leaves the range for any size and place */
        compile_triangle(&c, exp(5 * decoder_random_unit()), exp(8 * decoder_random_unit()) * decoder_random_unit(), 0);
        decoder_drop(&c);
    }
}

static void test_grid_refuses(void **state) {
    (void)state;
    compiled_t c;
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes;
    compile_triangle(&c, 4, 0, 0);
    const mesh_options_t fine = {.step = 4.0 / 32768};
    assert_int_equal(mesh_compile(&c.mesh, &fine, &bytes, &size_bytes, NULL, &error), -1);
    assert_non_null(strstr(error.text, "take a step of 0.00012207"));
    assert_null(bytes);
    c.mesh.positions[1][2] = NAN;
    assert_int_equal(mesh_compile(&c.mesh, NULL, &bytes, &size_bytes, NULL, &error), -1);
    c.mesh.positions[1][2] = INFINITY;
    assert_int_equal(mesh_compile(&c.mesh, NULL, &bytes, &size_bytes, NULL, &error), -1);
    memset(c.mesh.positions, 0, 9 * sizeof(double));
    assert_int_equal(mesh_compile(&c.mesh, NULL, &bytes, &size_bytes, NULL, &error), -1);
    c.mesh.corners[2] = 3;
    assert_int_equal(mesh_compile(&c.mesh, NULL, &bytes, &size_bytes, NULL, &error), -1);
    assert_non_null(strstr(error.text, "corner 2"));
    decoder_drop(&c);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cube),
        cmocka_unit_test(test_smooth_normals),
        cmocka_unit_test(test_palette),
        cmocka_unit_test(test_ball),
        cmocka_unit_test(test_soup),
        cmocka_unit_test(test_keep_order),
        cmocka_unit_test(test_wide_source_map),
        cmocka_unit_test(test_same_bytes),
        cmocka_unit_test(test_simplify),
        cmocka_unit_test(test_grid),
        cmocka_unit_test(test_grid_refuses),
    };
    return cmocka_run_group_tests_name("mesh compile", tests, folder_make, folder_remove);
}
