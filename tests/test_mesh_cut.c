/* Texture coordinates of faces that the compiler cuts or leaves out: polygons, display trees, simplification. */
#include "support/check.h"

#include <math.h>

#include "../raster/tuile.h"
#include "../sim/mesh/mesh.h"
#include "support/built.h"
#include "support/decoder.h"
#include "support/folder.h"
#include "support/images.h"

#define MTL "newmtl striped\nKd 1 0.2 0\nmap_Kd stripes.png\n"

static const char *put_quad(const char *texcoords) {
    char text[1024];
    images_put_stripes("stripes.png");
    (void)folder_put_text("a.mtl", MTL);
    (void)snprintf(text, sizeof text, "mtllib a.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n%susemtl striped\nf 1/1 2/2 3/3 4/4\n",
                   texcoords);
    return folder_put_text("quad.obj", text);
}

static void polygons_stay_where_their_texture_is_affine(void **state) {
    (void)state;
    static const struct {
        const char *texcoords;
        size_t faces;
    } cases[] = {{"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n", 1},     {"vt 0 0\nvt 1 0.5\nvt 1.25 1.5\nvt 0.25 1\n", 1},
                 {"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 0.99\n", 2},  /* 0.01 of 2 texels is more than 1/64 */
                 {"vt 0 0\nvt 1 0\nvt 1.003 1\nvt 0 1\n", 1}, /* 0.003 of 4 texels is less */
                 {"vt 0 0\nvt 1 0\nvt 1.005 1\nvt 0 1\n", 2}, {"vt 0 0\nvt 1 0\nvt 0 0\nvt 0 1\n", 2}};
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        built_t b = built_load(put_quad(cases[i].texcoords), NULL);
        if (b.report.faces != cases[i].faces) { fail_msg("case %u: %zu faces", i, b.report.faces); }
        free(b.bytes);
    }
}

/* Three quads through one another; texture coordinates are s = x + z / 2, t = 1 - y repeats of 4 x 2 texels all over them. */
static void faces_cut_for_a_tree_have_their_texture_where_it_was(void **state) {
    (void)state;
    images_put_stripes("stripes.png");
    (void)folder_put_text("a.mtl", MTL);
    built_t b =
        built_load(folder_put_text("cut.obj", "mtllib a.mtl\nv 0 0 0\nv 8 0 0\nv 8 8 0\nv 0 8 0\n"
                                              "v 3 -1 -4\nv 3 9 -4\nv 3 9 4\nv 3 -1 4\nv -1 1 -4\nv 9 6 -4\nv 9 6 4\nv -1 1 4\n"
                                              "vt 0 0\nvt 8 0\nvt 8 8\nvt 0 8\nvt 1 -1\nvt 1 9\nvt 5 9\nvt 5 -1\n"
                                              "vt -3 1\nvt 7 6\nvt 11 6\nvt 1 1\nusemtl striped\n"
                                              "f 1/1 2/2 3/3 4/4\nf 5/5 6/6 7/7 8/8\nf 9/9 10/10 11/11 12/12\n"),
                   &(mesh_options_t){.tree = true});
    tuile_model_t model;
    assert_int_equal(tuile_model_open(&model, b.bytes, b.size), 0);
    assert_true(b.report.tree.splits > 2);
    const double step = ldexp(model.step.mantissa, model.step.exponent), unit = ldexp(1, tuile_model_material(&model, 0).uv_bits);
    unsigned checked = 0;
    assert_int_equal(tuile_model_material(&model, 0).texture, 0);
    for (uint32_t v = 0; v < model.vertex_count; v++) {
        double place[3];
        for (int k = 0; k < 3; k++) {
            const double fraction = model.fractions ? (double)(int8_t)model.fractions[3 * v + (unsigned)k] / 256 : 0;
            place[k] = (decoder_s16(model.positions + 6 * (size_t)v + 2 * k) + fraction + model.offset[k]) * step;
        }
        const double s = decoder_s16(model.texcoords + 4 * (size_t)v) / unit,
                     t = decoder_s16(model.texcoords + 4 * (size_t)v + 2) / unit;
        /* Shifted to the middle: s, -3 ... 11, by 4 repeats, t, -8 ... 2, by -3. */
        assert_true(fabs(s - 4 * (place[0] + place[2] / 2 - 4)) <= 0.52 / unit);
        assert_true(fabs(t - 2 * (1 - place[1] + 3)) <= 0.52 / unit);
        checked++;
    }
    if (checked < 15) { fail_msg("%u", checked); }
    free(b.bytes);
}

typedef struct corner {
    double place[3], texcoord[2]; /* steps, units */
} corner_t;

typedef struct walker {
    void (*face)(void *context, uint32_t source, const corner_t *corners, unsigned count);
    void *context;
} walker_t;

/* All faces of a model with their corners. */
static void walk(const tuile_model_t *m, const walker_t *walker) {
    uint32_t index = 0;
    for (uint32_t k = 0; k < m->cluster_count; k++) {
        const uint8_t *cluster = m->clusters + 28 * (size_t)k, *face = m->faces + decoder_u32(cluster + 20);
        for (unsigned f = 0; f < decoder_u16(cluster + 24); f++, index++) {
            const unsigned count = cluster[27] ? face[0] : 3;
            const uint8_t *corner = cluster[27] ? face + 3 : face;
            corner_t corners[255];
            for (unsigned c = 0; c < count; c++) {
                const size_t v = decoder_u32(cluster + 12) + corner[c];
                for (size_t i = 0; i < 3; i++) {
                    const double fraction = m->fractions ? (double)(int8_t)m->fractions[3 * v + i] / 256 : 0;
                    corners[c].place[i] = decoder_s16(m->positions + 6 * v + 2 * i) + fraction;
                }
                for (size_t i = 0; i < 2; i++) {
                    corners[c].texcoord[i] = decoder_s16(m->texcoords + 4 * v + 2 * i);
                }
            }
            walker->face(walker->context, tuile_model_source_face(m, index), corners, count);
            face += cluster[27] ? 4 + count : 4;
        }
    }
}

typedef struct whole {
    corner_t (*triangles)[3]; /* of each source face */
    unsigned checked, between;
} whole_t;

static void keep_triangle(void *context, uint32_t source, const corner_t *corners, unsigned count) {
    whole_t *whole = context;
    assert_int_equal(count, 3);
    memcpy(whole->triangles[source], corners, 3 * sizeof *corners);
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* A piece's corners lie, to 1/256 step, in the triangle that it was cut from, and have the coordinates of that place. */
static void check_piece(void *context, uint32_t source, const corner_t *corners, unsigned count) {
    whole_t *whole = context;
    const corner_t *of = whole->triangles[source];
    double u[3], v[3], gradients[2][3];
    for (int k = 0; k < 3; k++) {
        u[k] = of[1].place[k] - of[0].place[k];
        v[k] = of[2].place[k] - of[0].place[k];
    }
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), area = uu * vv - uv * uv;
    assert_true(area > 0);
    for (int i = 0; i < 2; i++) {
        const double to_u = of[1].texcoord[i] - of[0].texcoord[i], to_v = of[2].texcoord[i] - of[0].texcoord[i];
        for (int k = 0; k < 3; k++) {
            gradients[i][k] = (to_u * (vv * u[k] - uv * v[k]) + to_v * (uu * v[k] - uv * u[k])) / area;
        }
    }
    for (unsigned c = 0; c < count; c++) {
        double from[3];
        for (int k = 0; k < 3; k++) {
            from[k] = corners[c].place[k] - of[0].place[k];
        }
        for (int i = 0; i < 2; i++) {
            const double expected = of[0].texcoord[i] + dot(gradients[i], from);
            const double tolerance = 0.51 + sqrt(dot(gradients[i], gradients[i])) * sqrt(3) / 512;
            if (!(fabs(corners[c].texcoord[i] - expected) <= tolerance)) {
                fail_msg("face %u: %g, not %g", source, corners[c].texcoord[i], expected);
            }
            whole->checked++;
        }
        whole->between += corners[c].place[0] != floor(corners[c].place[0]);
    }
}

static void pieces_of_the_spider_have_the_texture_of_their_faces(void **state) {
    (void)state;
    const char *path = getenv("SPIDER");
    if (!path) { skip(); }
    tuile_model_t model;
    built_t plain = built_load(path, NULL), tree = built_load(path, &(mesh_options_t){.tree = true});
    assert_true(tree.report.tree.seam_corners > 100);
    assert_int_equal(tuile_model_open(&model, plain.bytes, plain.size), 0);
    whole_t whole = {.triangles = calloc(model.source_face_count, sizeof *whole.triangles)};
    assert_non_null(whole.triangles);
    walk(&model, &(walker_t){keep_triangle, &whole});
    assert_int_equal(tuile_model_open(&model, tree.bytes, tree.size), 0);
    walk(&model, &(walker_t){check_piece, &whole});
    assert_true(whole.checked > 20000 && whole.between > 1000);
    free(whole.triangles);
    free(plain.bytes);
    free(tree.bytes);
}

static void simplified_faces_have_their_texture_where_it_was(void **state) {
    (void)state;
    char *text = malloc(1 << 16);
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, "mtllib a.mtl\nusemtl striped\n");
    images_put_stripes("stripes.png");
    (void)folder_put_text("a.mtl", MTL);
    for (int y = 0; y <= 16; y++) {
        for (int x = 0; x <= 16; x++) { /* two sheets that meet at x = 8, where s leaps by 5 */
            used += (size_t)sprintf(text + used, "v %d %d 0\nvt %g %g\nvt %g %g\n", x, y, x / 4.0, y / 4.0, x / 4.0 + 5, y / 4.0);
        }
    }
    for (int y = 0; y < 16; y++) {
        for (int x = 0; x < 16; x++) {
            const int a = 17 * y + x + 1, corners[4] = {a, a + 1, a + 18, a + 17};
            used += (size_t)sprintf(text + used, "f");
            for (int i = 0; i < 4; i++) {
                used += (size_t)sprintf(text + used, " %d/%d", corners[i], 2 * corners[i] - (x < 8));
            }
            used += (size_t)sprintf(text + used, "\n");
        }
    }
    const char *path = folder_put_text("sheet.obj", text);
    free(text);
    built_t b;
    sim_error_t error = {""};
    if (mesh_load(path, 40, NULL, &b.bytes, &b.size, &b.report, &error)) { fail_msg("%s", error.text); }
    assert_true(b.report.faces <= 40);
    assert_string_equal(b.report.warnings, "");
    tuile_model_t model;
    assert_int_equal(tuile_model_open(&model, b.bytes, b.size), 0);
    const double step = ldexp(model.step.mantissa, model.step.exponent), unit = ldexp(1, tuile_model_material(&model, 0).uv_bits);
    unsigned sides[2] = {0};
    for (uint32_t v = 0; v < model.vertex_count; v++) {
        const double x = (decoder_s16(model.positions + 6 * (size_t)v) + model.offset[0]) * step;
        const double s = decoder_s16(model.texcoords + 4 * (size_t)v) / unit;
        /* In texels: x, or x + 20, less 4 or 5 repeats of 4; s reaches from 0 to 9 repeats. */
        const double shift = nearbyint((x - s) / 4) * 4;
        assert_true(fabs(x - s - shift) < 0.01);
        assert_true(shift == 20 || shift == 0 || shift == 16 || shift == -4);
        sides[shift > 8]++;
        if (x < 7.9) { assert_true(shift > 8); }
        if (x > 8.1) { assert_true(shift < 8); }
    }
    assert_true(sides[0] >= 3 && sides[1] >= 3);
    free(b.bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_stay_where_their_texture_is_affine),
        cmocka_unit_test(faces_cut_for_a_tree_have_their_texture_where_it_was),
        cmocka_unit_test(pieces_of_the_spider_have_the_texture_of_their_faces),
        cmocka_unit_test(simplified_faces_have_their_texture_where_it_was),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
