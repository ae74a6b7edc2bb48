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

enum { TOUCHES = -2 };

typedef struct outline {
    const char *what;
    int32_t points[24][3];
    size_t count;
    long triangles; /* -1: any number; TOUCHES: the same, and a corner lies amid a side from the start */
    int64_t twice;  /* area */
} outline_t;

/* The directed sides of triangles and, backwards, of the outline they were cut from, cancel out, so that each triangle's sides are
 * sides of a neighbour or of the outline, whole. All triangles being turned like the outline, each point of it is then covered
 * once: no overlap, no gap. And no corner of a triangle lies amid the side of another: no T-junction. */
static bool conforms(const int32_t (*points)[3], size_t count, const uint32_t (*triangles)[3], long made) {
    const size_t sides = 3 * (size_t)made + count;
    const int32_t *(*side)[2] = malloc((sides + 1) * sizeof *side);
    bool good = side != NULL;
    for (size_t s = 0; good && s < sides; s++) {
        const size_t t = s / 3, c = s - 3 * (size_t)made;
        const bool ring = s >= 3 * (size_t)made;
        side[s][ring] = points[ring ? c : triangles[t][s % 3]];
        side[s][!ring] = points[ring ? (c + 1) % count : triangles[t][(s + 1) % 3]];
    }
    for (size_t s = 0; good && s < sides; s++) {
        const size_t bytes = 3 * sizeof(int32_t);
        if (!side[s][0] || memcmp(side[s][0], side[s][1], bytes) == 0) { continue; }
        size_t other = s + 1;
        while (other < sides &&
               (!side[other][0] || memcmp(side[s][0], side[other][1], bytes) || memcmp(side[s][1], side[other][0], bytes))) {
            other++;
        }
        good = other < sides;
        if (good) { side[other][0] = NULL; }
    }
    for (size_t s = 0; good && s < 3 * (size_t)made; s++) {
        const int32_t *p = points[triangles[s / 3][s % 3]], *q = points[triangles[s / 3][(s + 1) % 3]];
        for (size_t c = 0; good && c < 3 * (size_t)made; c++) {
            const int32_t *r = points[triangles[c / 3][c % 3]];
            int64_t along = 0;
            bool on_line = true;
            for (int k = 0; k < 3; k++) {
                const int l = (k + 1) % 3;
                along += (int64_t)(r[k] - p[k]) * (q[k] - r[k]); /* > 0 between them, if on the line */
                on_line = on_line && (int64_t)(q[k] - p[k]) * (r[l] - p[l]) == (int64_t)(q[l] - p[l]) * (r[k] - p[k]);
            }
            good = !on_line || along <= 0;
        }
    }
    free((void *)side);
    return good;
}

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
        {"a hole whose bridge begins in the middle of a side, with a corner twice",
         {{0, 0, 0},
          {9, 0, 0},
          {9, 9, 0},
          {0, 9, 0},
          {0, 3, 0},
          {3, 3, 0},
          {3, 6, 0},
          {3, 6, 0},
          {6, 6, 0},
          {6, 3, 0},
          {4, 3, 0},
          {3, 3, 0},
          {0, 3, 0}},
         13,
         -1,
         144},
        {"two holes, one bridged to the other, all in line",
         {{0, 0, 0},
          {12, 0, 0},
          {12, 6, 0},
          {0, 6, 0},
          {0, 2, 0},
          {2, 2, 0},
          {2, 4, 0},
          {4, 4, 0},
          {4, 2, 0},
          {6, 2, 0},
          {6, 4, 0},
          {8, 4, 0},
          {8, 2, 0},
          {6, 2, 0},
          {4, 2, 0},
          {2, 2, 0},
          {0, 2, 0}},
         17,
         -1,
         128},
        {"corners in line on every side, twice each",
         {{0, 0, 0},
          {2, 0, 0},
          {2, 0, 0},
          {5, 0, 0},
          {5, 0, 0},
          {5, 1, 0},
          {5, 5, 0},
          {5, 5, 0},
          {3, 5, 0},
          {0, 5, 0},
          {0, 3, 0},
          {0, 3, 0},
          {0, 1, 0}},
         13,
         -1,
         50},
        {"a spike inwards and a spike of two parts",
         {{0, 0, 0}, {6, 0, 0}, {6, 3, 0}, {3, 3, 0}, {6, 3, 0}, {6, 6, 0}, {0, 6, 0}, {0, 9, 0}, {0, 8, 0}, {0, 9, 0}, {0, 6, 0}},
         11,
         -1,
         72},
        {"a hole that touches a corner from inside, and an ear over both",
         {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {7, 7, 0}, {8, 4, 0}, {0, 0, 0}, {4, 8, 0}, {7, 7, 0}, {9, 9, 0}, {0, 9, 0}},
         10,
         -1,
         106},
        {"a corner amid the line between two others", {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {4, 4, 0}, {0, 8, 0}}, 5, 3, 96},
        {"one whose corner touches a side",
         {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {5, 8, 0}, {4, 0, 0}, {3, 8, 0}, {0, 8, 0}},
         7,
         TOUCHES,
         112},
        {"one that touches itself", {{0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 0}}, 6, -1, 16},
        {"no area", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}, 4, 0, 0},
    };
    for (size_t o = 0; o < sizeof outlines / sizeof *outlines; o++) {
        const outline_t *outline = &outlines[o];
        for (int axis = 0; axis < 3; axis++) {
            for (size_t turn = 0; turn < outline->count; turn++) { /* from every side, beginning anywhere */
                int32_t points[24][3];
                uint32_t triangles[24][3];
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
                if (count && outline->triangles != TOUCHES &&
                    !conforms((const int32_t(*)[3])points, outline->count, (const uint32_t(*)[3])triangles, count)) {
                    fail_msg("%s from corner %zu: sides of triangles that are no sides of others", outline->what, turn);
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

/* A star with a star-shaped hole, written as one ring with a bridge from any corner, with corners repeated and corners in the
 * middle of sides: cut exactly. */
static void test_triangulate_rings(void **state) {
    (void)state;
    enum { CORNERS = 24, MOST = 4 * (2 * CORNERS + 2) };
    for (int round = 0; round < CHECK_ROUNDS(600); round++) {
        int32_t corners[2 * CORNERS + 2][3] = {{0}}, points[MOST][3];
        uint32_t triangles[MOST][3];
        int64_t whole = 0, sum = 0;
        size_t count = 0;
        const int start = round % CORNERS;
        for (int i = 0; i < 2 * CORNERS + 2; i++) { /* once round outside, from `start` to itself, then back inside */
            const bool inside = i > CORNERS;
            const int spoke = start + (inside ? 2 * CORNERS + 1 - i : i);
            const double angle = 2 * 3.14159265358979 * spoke / CORNERS;
            /* even, for the corners in the middle; the last corner of each ring is its first */
            const double radius = 5e5 * (inside ? 4 + 3 * decoder_random_unit() : 14 + 5 * decoder_random_unit());
            corners[i][0] = 2 * (int32_t)(radius * cos(angle));
            corners[i][1] = 2 * (int32_t)(radius * sin(angle));
        }
        memcpy(corners[CORNERS], corners[0], sizeof corners[0]);
        memcpy(corners[2 * CORNERS + 1], corners[CORNERS + 1], sizeof corners[0]);
        for (int i = 0; i < 2 * CORNERS + 2; i++) {
            const int32_t *p = corners[i], *q = corners[(i + 1) % (2 * CORNERS + 2)];
            const bool bridge = i == CORNERS || i == 2 * CORNERS + 1;
            const bool middle = bridge ? round % 2 : decoder_random_unit() > 0.3;
            for (int n = decoder_random_unit() > 0.5 ? 2 : 1; n > 0; n--) {
                memcpy(points[count++], p, sizeof *points);
            }
            for (int k = 0; middle && k < 3; k++) {
                points[count][k] = (p[k] + q[k]) / 2;
            }
            count += middle;
            whole += (int64_t)p[0] * q[1] - (int64_t)p[1] * q[0];
        }
        const long made = mesh_triangulate((const int32_t(*)[3])points, count, triangles);
        for (long t = 0; t < made; t++) {
            const int32_t *a = points[triangles[t][0]], *b = points[triangles[t][1]], *c = points[triangles[t][2]];
            const int64_t area = (int64_t)(b[0] - a[0]) * (c[1] - a[1]) - (int64_t)(b[1] - a[1]) * (c[0] - a[0]);
            assert_true(area > 0);
            sum += area;
        }
        assert_true(sum == whole);
        assert_true(conforms((const int32_t(*)[3])points, count, (const uint32_t(*)[3])triangles, made));
    }
}

/* Asked for, every polygon is cut: its triangles keep number and colour, and stand in the order of the polygons where order is
 * kept. */
static void test_triangles_when_asked(void **state) {
    (void)state;
    const mesh_options_t cut = {.triangles = true}, in_order = {.triangles = true, .keep_order = true};
    compiled_t c = decoder_compile_file(folder_put_text("cube.obj", DECODER_CUBE_VERTICES DECODER_CUBE_FACES), &cut);
    uint32_t made[6] = {0};
    assert_int_equal(c.report.faces, 12);
    assert_int_equal(c.report.polygons, 0);
    assert_int_equal(c.report.split, 6);
    for (uint32_t f = 0; f < c.model.face_count; f++) {
        assert_int_equal(c.model.faces[f].corners, 3);
        made[c.model.faces[f].source]++;
    }
    for (int i = 0; i < 6; i++) {
        assert_int_equal(made[i], 2);
    }
    decoder_drop(&c);
    c = decoder_compile_file(folder_path("cube.obj"), NULL);
    assert_int_equal(c.report.faces, 6);
    decoder_drop(&c);
    c = decoder_compile_file(folder_path("cube.obj"), &in_order);
    for (uint32_t f = 0; f < 12; f++) {
        assert_int_equal(c.model.faces[f].source, f / 2);
    }
    /* What is compiled stays as it is: with polygons in it there are no triangles to be had. */
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes;
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("cube.tuile"), NULL, &error), 0);
    assert_int_equal(mesh_load(folder_path("cube.tuile"), 0, &cut, &bytes, &size_bytes, NULL, &error), 0);
    free(bytes);
    decoder_drop(&c);
    c = decoder_compile_file(folder_path("cube.obj"), NULL);
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("cube.tuile"), NULL, &error), 0);
    assert_int_equal(mesh_load(folder_path("cube.tuile"), 0, &cut, &bytes, &size_bytes, NULL, &error), -1);
    assert_non_null(strstr(error.text, "polygons"));
    decoder_drop(&c);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_concave),           cmocka_unit_test(test_non_planar),
        cmocka_unit_test(test_many_corners),      cmocka_unit_test(test_degenerate_faces),
        cmocka_unit_test(test_triangulate),       cmocka_unit_test(test_triangulate_stars),
        cmocka_unit_test(test_triangulate_rings), cmocka_unit_test(test_triangles_when_asked),
    };
    return cmocka_run_group_tests_name("mesh polygons", tests, folder_make, folder_remove);
}
