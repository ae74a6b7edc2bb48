/* What the model compiler makes of single polygons: which stay whole, which are cut or dropped, and where. The bytes are read back
 * by a reader of our own. */
#include "support/check.h"

#include <math.h>

#include "../sim/mesh/mesh.h"
#include "../sim/mesh/stages.h"
#include "support/decoder.h"
#include "support/folder.h"

/* ---- polygons --------------------------------------------------------------------------------------------------- */

static void test_concave(void **state) {
    (void)state;
    /* An arrow head; lit evenly it stays one face that is not convex. */
    const char *arrow = "v 0 0 0\nv 4 -2 0\nv 0 4 0\nv -4 -2 0\n";
    char text[200];
    (void)snprintf(text, sizeof text, "%sf 1 2 3 4\n", arrow);
    compiled_t c = decoder_compile_file(folder_put_text("arrow.obj", text), NULL);
    assert_int_equal(c.report.faces, 1);
    assert_int_equal(c.report.split, 0);
    assert_false(c.model.faces[0].convex);
    decoder_check_faces(&c.model, &c.mesh);
    decoder_drop(&c);
    /* Lit unevenly it is cut through the reflex corner: the only cut there is. */
    (void)snprintf(text, sizeof text, "%svn 0 0 1\nvn 0 1 1\nf 1//1 2//1 3//2 4//2\n", arrow);
    c = decoder_compile_file(folder_put_text("arrow.obj", text), NULL);
    assert_int_equal(c.report.faces, 2);
    assert_int_equal(c.report.split, 1);
    assert_int_equal(c.report.non_planar, 0);
    for (uint32_t f = 0; f < 2; f++) {
        double n[3];
        int reflex = 0;
        assert_int_equal(c.model.faces[f].source, 0);
        decoder_plane(&c.model.faces[f], n);
        assert_true(n[2] > 0);
        for (int i = 0; i < 3; i++) {
            reflex += c.model.faces[f].q[i][0] == 0 && c.model.faces[f].q[i][1] == 0;
        }
        assert_int_equal(reflex, 1);
    }
    decoder_drop(&c);
}

static void test_non_planar(void **state) {
    (void)state;
    compiled_t c = decoder_compile_file(folder_put_text("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.25\nv 0 1 0\nf 1 2 3 4\n"), NULL);
    assert_int_equal(c.report.non_planar, 1);
    assert_int_equal(c.report.faces, 2);
    assert_int_equal(c.report.polygons, 0);
    decoder_drop(&c);
    const mesh_options_t keep = {.keep_planar = true, .keep_order = true};
    c = decoder_compile_file(folder_path("bent.obj"), &keep);
    assert_int_equal(c.report.non_planar, 0);
    assert_int_equal(c.report.faces, 1);
    assert_int_equal(c.report.polygons, 1);
    decoder_drop(&c);
    /* A step is 1 / 16384 here; the corners are 1/4 of the lift off the plane: 3 steps of lift pass, 5 do not. */
    c = decoder_compile_file(folder_put_text("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.00018310546875\nv 0 1 0\nf 1 2 3 4\n"), NULL);
    assert_int_equal(c.report.non_planar, 0);
    decoder_drop(&c);
    c = decoder_compile_file(folder_put_text("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.00030517578125\nv 0 1 0\nf 1 2 3 4\n"), NULL);
    assert_int_equal(c.report.non_planar, 1);
    decoder_drop(&c);
}

static void test_many_corners(void **state) {
    (void)state;
    char text[40000];
    const int sizes[3] = {255, 256, 1000};
    for (int s = 0; s < 3; s++) {
        size_t at = 0;
        for (int i = 0; i < sizes[s]; i++) {
            double angle = 2 * 3.14159265358979 * i / sizes[s];
            at += (size_t)snprintf(text + at, sizeof text - at, "v %.5f %.5f 0\n", cos(angle), sin(angle));
        }
        at += (size_t)snprintf(text + at, sizeof text - at, "f");
        for (int i = 1; i <= sizes[s]; i++) {
            at += (size_t)snprintf(text + at, sizeof text - at, " %d", i);
        }
        (void)snprintf(text + at, sizeof text - at, "\n");
        compiled_t c = decoder_compile_file(folder_put_text("disc.obj", text), NULL);
        assert_int_equal(c.report.faces, sizes[s] == 255 ? 1 : sizes[s] - 2);
        assert_int_equal(c.report.split, sizes[s] == 255 ? 0 : 1);
        assert_int_equal(decoder_u16(c.bytes + 36), sizes[s] == 255 ? 255 : 3);
        decoder_drop(&c);
    }
}

static void test_degenerate_faces(void **state) {
    (void)state;
    /* One corner twice, all corners at two places, collinear corners, and points and lines, which are no faces. */
    compiled_t c = decoder_compile_file(
        folder_put_text("bad.obj", DECODER_SQUARE "v 8 0 0\nf 1 1 2\nf 1 2 3\nf 1 2 1 2\nf 1 2 5\nf 1 3 3 4\n"), NULL);
    assert_int_equal(c.mesh.source_face_count, 5);
    assert_int_equal(c.mesh.skipped_count, 2);
    assert_int_equal(c.report.skipped, 3);
    assert_int_equal(c.report.faces, 2);
    assert_int_equal(decoder_face_of_source(&c.model, 4)->corners, 3); /* a quad that repeats a corner is a triangle */
    (void)decoder_face_of_source(&c.model, 1);
    decoder_drop(&c);
    c = decoder_compile_file(folder_put_text("loose.obj", DECODER_SQUARE "f 1 2 3\nl 1 2 3\np 4\n"), NULL);
    assert_int_equal(c.report.faces, 1);
    assert_int_equal(c.mesh.source_face_count, 1);
    assert_int_equal(c.mesh.loose_count, 3);
    decoder_drop(&c);
    /* 1 / 70000 of the model is less than a step: that triangle vanishes in the rounding. */
    c = decoder_compile_file(folder_put_text("speck.obj",
                                             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.3 0.3 0.1\nv 0.300001 0.3 0.1\nv 0.3 0.300001 0.1\n"
                                             "f 1 2 3\nf 4 5 6\n"),
                             NULL);
    assert_int_equal(c.report.faces, 1);
    assert_int_equal(c.report.skipped, 1);
    decoder_drop(&c);
}

/* ---- ear clipping ----------------------------------------------------------------------------------------------- */

typedef struct outline {
    const char *what;
    int32_t points[16][3];
    size_t count;
    long triangles; /* -1: any number */
    int64_t twice;  /* area */
} outline_t;

static void test_triangulate(void **state) {
    (void)state;
    static const outline_t outlines[] = {
        {"a triangle", {{0, 0, 5}, {4, 0, 5}, {0, 4, 5}}, 3, 1, 16},
        {"a square", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 4, 2, 32},
        {"an arrow head", {{0, 0, 0}, {4, -2, 0}, {0, 4, 0}, {-4, -2, 0}}, 4, 2, 32},
        {"a corner amid each side",
         {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {4, 4, 0}, {2, 4, 0}, {0, 4, 0}, {0, 2, 0}},
         8,
         6,
         32},
        {"a repeated corner", {{0, 0, 0}, {4, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 5, 2, 32},
        {"a spike", {{0, 0, 0}, {4, 0, 0}, {9, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 6, -1, 32},
        {"a comb", {{0, 0, 0}, {8, 0, 0}, {8, 4, 0}, {6, 1, 0}, {5, 4, 0}, {4, 1, 0}, {3, 4, 0}, {2, 1, 0}, {0, 4, 0}}, 9, 7, 40},
        {"a hole joined by a bridge",
         {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0}, {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}},
         10,
         8,
         144},
        {"one that touches itself", {{0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 0}}, 6, -1, 16},
        {"no area", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}, 4, 0, 0},
    };
    for (size_t o = 0; o < sizeof outlines / sizeof *outlines; o++) {
        const outline_t *outline = &outlines[o];
        for (int axis = 0; axis < 3; axis++) {
            for (size_t turn = 0; turn < outline->count; turn++) { /* from every side, beginning anywhere */
                int32_t points[16][3];
                uint32_t triangles[16][3];
                int64_t twice = 0;
                for (size_t i = 0; i < outline->count; i++) {
                    for (int k = 0; k < 3; k++) {
                        points[i][(k + axis) % 3] = outline->points[(i + turn) % outline->count][k];
                    }
                }
                long count = mesh_triangulate((const int32_t(*)[3])points, outline->count, triangles);
                for (long t = 0; t < count; t++) {
                    const int32_t *a = points[triangles[t][0]], *b = points[triangles[t][1]], *c = points[triangles[t][2]];
                    int x = axis % 3, y = (axis + 1) % 3;
                    int64_t area = (int64_t)(b[x] - a[x]) * (c[y] - a[y]) - (int64_t)(b[y] - a[y]) * (c[x] - a[x]);
                    assert_true(area > 0);
                    twice += area;
                }
                if (twice != outline->twice || (outline->triangles >= 0 && count != outline->triangles)) {
                    fail_msg("%s from corner %zu: %ld triangles with twice the area %lld", outline->what, turn, count,
                             (long long)twice);
                }
            }
        }
    }
}

/* Star-shaped polygons of any jaggedness: the areas of the triangles add up to the polygon's. */
static void test_triangulate_stars(void **state) {
    (void)state;
    enum { CORNERS = 60 };
    for (int round = 0; round < 200; round++) {
        int32_t points[CORNERS][3];
        uint32_t triangles[CORNERS][3];
        int64_t whole = 0, sum = 0;
        for (int i = 0; i < CORNERS; i++) {
            double angle = 2 * 3.14159265358979 * i / CORNERS,
                   radius = round % 2 ? 20 + 15 * decoder_random_unit() : 6e7 + 5e7 * decoder_random_unit();
            points[i][0] = (int32_t)(radius * cos(angle));
            points[i][1] = (int32_t)(radius * sin(angle));
            points[i][2] = 0;
        }
        for (int i = 0; i < CORNERS; i++) {
            const int32_t *p = points[i], *q = points[(i + 1) % CORNERS];
            whole += (int64_t)p[0] * q[1] - (int64_t)p[1] * q[0];
        }
        long count = mesh_triangulate((const int32_t(*)[3])points, CORNERS, triangles);
        for (long t = 0; t < count; t++) {
            const int32_t *a = points[triangles[t][0]], *b = points[triangles[t][1]], *c = points[triangles[t][2]];
            sum += (int64_t)(b[0] - a[0]) * (c[1] - a[1]) - (int64_t)(b[1] - a[1]) * (c[0] - a[0]);
        }
        assert_true(sum == whole || round % 2); /* on the coarse grid corners may fold over one another */
    }
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_concave),          cmocka_unit_test(test_non_planar),  cmocka_unit_test(test_many_corners),
        cmocka_unit_test(test_degenerate_faces), cmocka_unit_test(test_triangulate), cmocka_unit_test(test_triangulate_stars),
    };
    return cmocka_run_group_tests_name("mesh polygons", tests, folder_make, folder_remove);
}
