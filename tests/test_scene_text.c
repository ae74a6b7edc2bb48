/* The readers of text scenes and of coverage polygons, and the camera that a scene is seen by. */
#include "reference/scene_generator.h"
#include "support/check.h"
#include "support/scene_parse.h"

#include "../sim/coverage_text.h"

#include <math.h>

/* ---- text scenes ------------------------------------------------------------------------------------------ */

static void text_reads_every_line(void **state) {
    (void)state;
    scene_text_t scene = scene_parse("# a scene\r\n"
                                     "poly 7 0,0,5  1.50,0,5\t1/2,+.25,5 # trailing\r\n"
                                     "screen 64 32\n\n"
                                     "camera persp 7/3 0.125\n"
                                     "origin -10/4 3.0\nysign -1\nsample 1/2 0.50\nnear max\ntie last\n"
                                     "poly 7 -0,0,9 0.000,1,9 5,5,9 # same ID");
    assert_int_equal(scene.width, 64);
    assert_int_equal(scene.height, 32);
    assert_int_equal(scene.projection, TUILE_PERSPECTIVE);
    const struct {
        scene_number_t number;
        int64_t numerator, denominator;
    } numbers[] = {{scene.focal, 7, 3},          {scene.near, 1, 8},           {scene.origin[0], -5, 2},
                   {scene.origin[1], 3, 1},      {scene.sample[0], 1, 2},      {scene.sample[1], 1, 2},
                   {scene.vertices[1][0], 3, 2}, {scene.vertices[2][0], 1, 2}, {scene.vertices[2][1], 1, 4},
                   {scene.vertices[2][2], 5, 1}, {scene.vertices[3][0], 0, 1}, {scene.vertices[4][0], 0, 1}};
    for (size_t i = 0; i < CHECK_COUNT(numbers); i++) {
        assert_int_equal(numbers[i].number.numerator, numbers[i].numerator);
        assert_int_equal(numbers[i].number.denominator, numbers[i].denominator);
    }
    assert_int_equal(scene.y_sign, -1);
    assert_true(scene.near_max && scene.tie_last);
    assert_int_equal(scene.poly_count, 2);
    assert_int_equal(scene.polys[0].id, 7);
    assert_int_equal(scene.polys[0].line, 2);
    assert_int_equal(scene.polys[1].first, 3);
    assert_int_equal(scene.polys[1].count, 3);
    assert_int_equal(scene.polys[1].line, 11);
    scene_text_free(&scene);
}

static void text_has_defaults(void **state) {
    (void)state;
    scene_text_t scene = scene_parse("camera persp 9\nscreen 63 32");
    assert_int_equal(scene.origin[0].numerator, 63);
    assert_int_equal(scene.origin[0].denominator, 2);
    assert_int_equal(scene.origin[1].numerator, 16);
    assert_int_equal(scene.near.numerator, 1);
    assert_int_equal(scene.sample[0].numerator, 0);
    assert_int_equal(scene.y_sign, 1);
    assert_false(scene.near_max || scene.tie_last);
    assert_int_equal(scene.poly_count, 0);
    scene_text_free(&scene);
}

static void text_names_the_bad_line(void **state) {
    (void)state;
    static const struct {
        const char *text, *line, *what;
    } cases[] = {
        {"screen 9 9\nscreens 9 9\ncamera ortho", "line 2:", "unknown keyword 'screens'"},
        {"screen 9", "line 1:", "screen height is missing"},
        {"screen 9 9 9", "line 1:", "'9' after all"},
        {"screen 0 9", "line 1:", "1 to 1024"},
        {"screen 9 1025", "line 1:", "1 to 1024"},
        {"screen 9.5 9", "line 1:", "1 to 1024"},
        {"screen 9 9\nscreen 9 9", "line 2:", "before, on line 1"},
        {"camera ortho", "scene:", "no `screen`"},
        {"screen 9 9", "scene:", "no `camera`"},
        {"camera", "line 1:", "ortho or persp"},
        {"camera fisheye", "line 1:", "'fisheye'"},
        {"camera ortho 1", "line 1:", "'1' after all"},
        {"camera persp", "line 1:", "F is missing"},
        {"camera persp 0", "line 1:", "greater than 0"},
        {"camera persp -3", "line 1:", "greater than 0"},
        {"camera persp 99999", "line 1:", "beyond"},
        {"camera persp 3 0", "line 1:", "NEAR must be"},
        {"camera persp 3 1 1", "line 1:", "'1' after all"},
        {"origin 1", "line 1:", "CY is missing"},
        {"ysign 2", "line 1:", "1 or -1"},
        {"sample 1/0 0", "line 1:", "divides by zero"},
        {"sample 1e3 0", "line 1:", "neither a decimal nor a fraction"},
        {"sample 1/2/3 0", "line 1:", "neither"},
        {"sample 1/-2 0", "line 1:", "neither"},
        {"sample . 0", "line 1:", "neither"},
        {"sample - 0", "line 1:", "neither"},
        {"sample 0x1 0", "line 1:", "neither"},
        {"near middle", "line 1:", "min or max"},
        {"tie", "line 1:", "first or last"},
        {"poly", "line 1:", "ID is missing"},
        {"poly 0 0,0,0 1,0,0 0,1,0", "line 1:", "'0' is not a whole number of 1"},
        {"poly -1 0,0,0 1,0,0 0,1,0", "line 1:", "'-1'"},
        {"poly 4294967296 0,0,0 1,0,0 0,1,0", "line 1:", "4294967295"},
        {"poly 1 0,0,0 1,0,0", "line 1:", "2 vertices"},
        {"poly 1 0,0,0 1,0 0,1,0", "line 1:", "vertex 2, '1,0', is not x,y,z"},
        {"poly 1 0,0,0 1,0,0,0 0,1,0", "line 1:", "vertex 2"},
        {"poly 1 0,0,0 1,,0 0,1,0", "line 1:", "vertex 2: y is missing"},
        {"poly 1 0,0,0 1,0,zz 0,1,0", "line 1:", "vertex 2: z 'zz'"},
        {"poly 1 0,0,0 1,0,9223372036854775808 0,1,0", "line 1:", "64 bits"},
        {"poly 1 0,0,0 1,0,0.1234567890123456789 0,1,0", "line 1:", "64 bits"},
        {"\n\npoly 1 0,0,0 1,0,0 0,0,0 1,0,0", "line 3:", "three distinct"},
        {"poly 1 0,0,0 1,1,1 3,3,3 2,2,2", "line 1:", "one line"},
        {"poly 1 0,0,0 4,0,0 4,4,0 0,4,1", "line 1:", "not planar: vertex 4"},
        /* Flat but for a part in 10^36, which no double tells. */
        {"poly 1 0,0,0 1/1000000000000000000,0,0 0,1/1000000000000000000,0 1,1,1/1000000000000000000", "line 1:", "not planar"},
    };
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        scene_text_t scene;
        sim_error_t error = {""};
        if (scene_text_parse(&scene, cases[i].text, strlen(cases[i].text), "scene", &error) == 0) {
            fail_msg("taken: %s", cases[i].text);
        }
        if (strncmp(error.text, "scene: ", 7) != 0 || !strstr(error.text, cases[i].line) || !strstr(error.text, cases[i].what)) {
            fail_msg("%s\ngave: %s", cases[i].text, error.text);
        }
        assert_null(scene.polys);
        assert_null(scene.vertices);
    }
}

#define LARGEST "9223372036854775807"
static void text_takes_odd_but_good_polygons(void **state) {
    (void)state;
    static const char *const cases[] = {
        "poly 1 0,0,0 0,0,0 1,0,0 1,0,0 0,1,0",                      /* repeated vertices */
        "poly 1 0,0,0 1,1,1 2,2,2 5,4,4 -3,-3,-3",                   /* begins along one line */
        "poly 4294967295 0,0,0 2,2,0 2,0,0 0,2,0",                   /* crosses itself, signed area 0 */
        "poly 1 1/3,1/7,0 2/3,1/7,1/11 1/3,2/7,1/13 2/3,2/7,24/143", /* planar in fractions only */
        "poly 1 " LARGEST ",0,0 0," LARGEST ",0 0,0," LARGEST " -" LARGEST "," LARGEST "," LARGEST, /* as large as numbers go */
        "poly 1 0,0,0 1.00000000000000000000000000,0,0 0,1,0",
    };
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        char text[512];
        (void)snprintf(text, sizeof text, "screen 4 4\ncamera ortho\n%s\n", cases[i]);
        scene_text_t scene = scene_parse(text);
        assert_int_equal(scene.poly_count, 1);
        scene_text_free(&scene);
    }
}

static void text_counts_corners(void **state) {
    (void)state;
    for (int count = 255; count <= 256; count++) {
        char text[8192] = "screen 4 4\ncamera ortho\npoly 1";
        for (int i = 0; i < count; i++) {
            (void)snprintf(text + strlen(text), sizeof text - strlen(text), " %d,%d,0", i, i * i);
        }
        scene_text_t scene;
        sim_error_t error = {""};
        assert_int_equal(scene_text_parse(&scene, text, strlen(text), "scene", &error), count == 255 ? 0 : -1);
        scene_text_free(&scene);
    }
    static const char gone[] = "screen 4 4\0 4";
    scene_text_t scene;
    assert_int_equal(scene_text_parse(&scene, gone, sizeof gone - 1, "scene", NULL), -1);
}

static void expect_steps(const char *vertices, int exponent, bool exact, double error_max, const int (*steps)[3]) {
    char text[512];
    (void)snprintf(text, sizeof text, "screen 4 4\ncamera ortho\npoly 5 %s", vertices);
    scene_text_t scene = scene_parse(text);
    mesh_t mesh;
    scene_quantisation_t quantisation;
    sim_error_t error = {""};
    assert_int_equal(scene_text_mesh(&scene, &mesh, &quantisation, &error), 0);
    assert_int_equal(quantisation.exponent, exponent);
    assert_int_equal(quantisation.exact, exact);
    assert_true(fabs(quantisation.error_max - error_max) < 1e-9);
    assert_int_equal(mesh.face_count, 1);
    assert_int_equal(mesh.faces[0].count, 3);
    for (int i = 0; i < 3; i++) {
        for (int c = 0; c < 3; c++) {
            assert_true(mesh.positions[mesh.corners[i]][c] == steps[i][c]);
        }
    }
    free(mesh.positions);
    free(mesh.corners);
    free(mesh.faces);
    free(mesh.materials);
    scene_text_free(&scene);
}

static void text_quantises(void **state) {
    (void)state;
    expect_steps("0,0,0 32767,0,0 0,-32767,2", 0, true, 0, (const int[3][3]){{0, 0, 0}, {32767, 0, 0}, {0, -32767, 2}});
    expect_steps("0,0,0 4,0,0 0,8,2", 0, true, 0, (const int[3][3]){{0, 0, 0}, {4, 0, 0}, {0, 8, 2}});
    expect_steps("0,0,0 0.5,0,0 0,-3.75,2", -2, true, 0, (const int[3][3]){{0, 0, 0}, {2, 0, 0}, {0, -15, 8}});
    expect_steps("0,0,0 65534,0,0 0,2,-65534", 1, true, 0, (const int[3][3]){{0, 0, 0}, {32767, 0, 0}, {0, 1, -32767}});
    expect_steps("0,0,0 1048576,0,0 0,64,0", 6, true, 0, (const int[3][3]){{0, 0, 0}, {16384, 0, 0}, {0, 1, 0}});
    expect_steps("0,0,0 32768,0,0 0,1,0", 1, false, 1, (const int[3][3]){{0, 0, 0}, {16384, 0, 0}, {0, 1, 0}});
    expect_steps("0,0,0 32767.5,0,0 0,-1,0", 1, false, 1, (const int[3][3]){{0, 0, 0}, {16384, 0, 0}, {0, 0, 0}});
    /* 1/3 at the finest power of two that holds 10: 10 * 2048 = 20480 */
    expect_steps("0,0,0 10,0,0 0,1/3,0", -11, false, 1.0 / 6144, (const int[3][3]){{0, 0, 0}, {20480, 0, 0}, {0, 683, 0}});
    expect_steps("0,0,0 1/65536,0,0 0,1/65536,1/32768", -16, true, 0, (const int[3][3]){{0, 0, 0}, {1, 0, 0}, {0, 1, 2}});
}

/* What the renderer is told to do, done in floating point from the struct's own numbers. */
typedef struct seen_point {
    double x, y, distance;
} seen_point_t;

static double q16(q16_16_t value) { return value / 65536.0; }

static seen_point_t project(const scene_view_t *view, const double position[3]) {
    const tuile_camera_t *camera = &view->camera;
    double world[3], eye[3];
    for (int i = 0; i < 3; i++) {
        world[i] = q16(view->pose.translation[i]);
        for (int k = 0; k < 3; k++) {
            world[i] +=
                ldexp(view->pose.rotation[i][k], -30) * position[k] * ldexp(view->pose.scale.mantissa, view->pose.scale.exponent);
        }
    }
    for (int i = 0; i < 3; i++) {
        eye[i] = 0;
        for (int k = 0; k < 3; k++) {
            eye[i] += ldexp(camera->rotation[i][k], -30) * (world[k] - q16(camera->eye[k]));
        }
        assert_true(fabs(world[i]) < 32768 && fabs(eye[i]) < 32768);
    }
    double w = camera->projection == TUILE_PERSPECTIVE ? -eye[2] : 1;
    return (seen_point_t){q16(camera->centre_x) + q16(camera->focal_x) * eye[0] / w,
                          q16(camera->centre_y) - q16(camera->focal_y) * eye[1] / w, -eye[2]};
}

/* Every vertex of a scene lands where the text's formulas say, seen from a renderer that samples at centres; distances are within
 * near and far, and ordered as the text orders z. */
static void expect_view(const char *text, bool exact) {
    scene_text_t scene = scene_parse(text);
    mesh_t mesh;
    scene_quantisation_t quantisation;
    scene_view_t view;
    sim_error_t error = {""};
    assert_int_equal(scene_text_mesh(&scene, &mesh, &quantisation, &error), 0);
    if (scene_text_camera(&scene, &quantisation, &view, &error) < 0) { fail_msg("%s\n%s", error.text, text); }
    assert_int_equal(view.exact, exact);
    assert_true(view.camera.far > view.camera.near && view.camera.near > 0);
    assert_int_equal(view.camera.projection, scene.projection);
    for (size_t i = 0; i < scene.vertex_count; i++) {
        double at[3];
        for (int c = 0; c < 3; c++) {
            at[c] = scene_number_value(scene.vertices[i][c]);
        }
        if (scene.projection == TUILE_PERSPECTIVE && at[2] <= 0) { continue; }
        seen_point_t seen = project(&view, mesh.positions[mesh.corners[i]]);
        double x = at[0], y = at[1];
        if (scene.projection == TUILE_PERSPECTIVE) {
            x = scene_number_value(scene.origin[0]) + scene_number_value(scene.focal) * at[0] / at[2];
            y = scene_number_value(scene.origin[1]) + scene.y_sign * scene_number_value(scene.focal) * at[1] / at[2];
            double unit = at[2] / seen.distance;
            if (quantisation.exact) { assert_true(fabs(unit - ldexp(1, quantisation.exponent)) < 1e-9); }
            assert_true(seen.distance < q16(view.camera.far));
            assert_int_equal(seen.distance >= q16(view.camera.near), at[2] >= scene_number_value(scene.near));
        } else {
            assert_true(seen.distance > q16(view.camera.near) && seen.distance < q16(view.camera.far));
            seen_point_t other = project(&view, mesh.positions[mesh.corners[0]]);
            double z = scene.near_max ? -at[2] : at[2],
                   other_z = scene_number_value(scene.vertices[0][2]) * (scene.near_max ? -1 : 1);
            if (quantisation.exact) { assert_true((seen.distance > other.distance) == (z > other_z)); }
            /* The depth step is the one that near and far make, or a little more. */
            double unit = ldexp(1, quantisation.exponent - view.pose.scale.exponent);
            double step = (q16(view.camera.far) - q16(view.camera.near)) * unit / 65535;
            assert_true(view.depth_step >= step && view.depth_step < step * 1.002);
        }
        double slack = quantisation.error_max * 1.5 + (exact ? 1e-6 : 0.02) * (1 + fabs(x) + fabs(y));
        assert_true(fabs(seen.x - (x + 0.5 - scene_number_value(scene.sample[0]))) <= slack);
        assert_true(fabs(seen.y - (y + 0.5 - scene_number_value(scene.sample[1]))) <= slack);
    }
    free(mesh.positions);
    free(mesh.corners);
    free(mesh.faces);
    free(mesh.materials);
    scene_text_free(&scene);
}

static void text_places_the_camera(void **state) {
    (void)state;
    static const struct {
        const char *text;
        bool exact;
    } cases[] = {
        {"screen 64 48\ncamera ortho\npoly 1 1,2,3 40,5,-7 9,30,0", true},
        {"screen 64 48\ncamera ortho\nnear max\nsample 1/2 1/2\npoly 1 1,2,3 40,5,-7 9,30,0", true},
        {"screen 64 48\ncamera ortho\nsample 1/3 0\npoly 1 1,2,3 40,5,-7 9,30,0", false},
        {"screen 64 48\ncamera ortho\npoly 1 1,2,3 40,5,3 9,30,3", true},
        {"screen 64 48\ncamera ortho\npoly 1 1,2,32767 40,5,-32767 9,30,0", true},
        {"screen 64 48\ncamera ortho\nnear max\npoly 1 1,2,32767 40,5,-32767 9,30,0", true},
        {"screen 64 48\ncamera ortho\npoly 1 1,2,32767 40,5,32766 9,30,32766", true},
        {"screen 64 48\ncamera ortho\npoly 1 1,2,-32767 40,5,-32766 9,30,-32766", true},
        {"screen 64 48\ncamera ortho\npoly 1 1,2,-32767 40,5,-100 9,30,-32766", true},
        {"screen 64 48\ncamera ortho\npoly 1 1.125,2,3 40,5.5,-7 9,30,0.25", true},
        {"screen 64 48\ncamera ortho\npoly 1 1/3,2,3 40,5.5,-7 9,30,0.25", true},
        {"screen 64 48\ncamera ortho\npoly 1 -65534,2,0 65534,6,64000 100,300,-65534", true},
        {"screen 64 48\ncamera ortho\npoly 1 -1048576,0,0 1048576,0,0 0,1048576,0", true},
        {"screen 1 1\ncamera ortho\npoly 1 0,0,0 1/1048576,0,0 0,1/1048576,3/1048576", true},
        {"screen 1 1\ncamera ortho\npoly 1 0,0,0 1/4294967296,0,0 0,1/4294967296,3/4294967296", true},
        {"screen 64 48\ncamera persp 50\npoly 1 1,2,3 -4,5,7 9,-3,1", true},
        {"screen 64 48\ncamera persp 50\nysign -1\nsample 1/2 1/2\norigin 0 10.5\npoly 1 1,2,3 -4,5,7 9,-3,1 ", true},
        {"screen 64 48\ncamera persp 50 7/3\npoly 1 1,2,3 -4,5,7 9,-3,1", false},
        {"screen 64 48\ncamera persp 100/3\npoly 1 1,2,3 -4,5,7 9,-3,1", false},
        {"screen 64 48\ncamera persp 50 1/8\npoly 1 1.5,2,3 -4,5.25,7 9,-3,0.125", true},
        {"screen 64 48\ncamera persp 50 1000\npoly 1 1.5,2,3 -4,5.25,7 9,-3,0.125", true},
        {"screen 64 48\ncamera persp 50 99999\npoly 1 1,2,3 -4,5,32767 9,-3,1", true},
        {"screen 64 48\ncamera persp 50\npoly 1 100000,2,100000 -40000,5,70000 90000,-30000,20002", true},
    };
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        expect_view(cases[i].text, cases[i].exact);
    }
    for (uint64_t seed = 1; seed <= 200; seed++) {
        char *text = scene_generate(seed, NULL);
        assert_non_null(text);
        expect_view(text, strstr(text, "1/3") == NULL);
        free(text);
    }
    scene_text_t scene = scene_parse("screen 4 4\ncamera ortho\npoly 1 0,0,0 9999999999,0,0 0,9999999999,0");
    mesh_t mesh;
    scene_quantisation_t quantisation;
    scene_view_t view;
    sim_error_t error = {""};
    assert_int_equal(scene_text_mesh(&scene, &mesh, &quantisation, &error), 0);
    assert_int_equal(scene_text_camera(&scene, &quantisation, &view, &error), -1);
    assert_non_null(strstr(error.text, "too large"));
    free(mesh.positions);
    free(mesh.corners);
    free(mesh.faces);
    free(mesh.materials);
    scene_text_free(&scene);
}

static void text_reads_files(void **state) {
    (void)state;
    scene_text_t scene;
    sim_error_t error = {""};
    assert_int_equal(scene_text_read(&scene, "/nonexistent/scene.txt", &error), -1);
    assert_non_null(strstr(error.text, "cannot be opened"));
    char name[] = "scene-text.tmp";
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    (void)fputs("screen 4 4\ncamera ortho\n", file);
    for (int i = 0; i < 20000; i++) { /* longer than any one read */
        (void)fprintf(file, "poly %d 0,0,0 1,0,0 0,1,0\n", i + 1);
    }
    assert_int_equal(fclose(file), 0);
    int result = scene_text_read(&scene, name, &error);
    (void)remove(name);
    assert_int_equal(result, 0);
    assert_int_equal(scene.poly_count, 20000);
    assert_int_equal(scene.polys[19999].id, 20000);
    scene_text_free(&scene);
}

/* ---- coverage polygons ------------------------------------------------------------------------------------ */

static FILE *file_of(const char *text) {
    FILE *file = tmpfile();
    assert_non_null(file);
    (void)fputs(text, file);
    rewind(file);
    return file;
}

static void polygons_are_read(void **state) {
    (void)state;
    FILE *file = file_of("0 0 16 0 0 16\r\n\n \t\n+5 -7 524272 -524272 1 2 3 4");
    coverage_text_t text;
    sim_error_t error = {""};
    coverage_text_open(&text, file, "polygons");
    assert_int_equal(coverage_text_next(&text, &error), 1);
    assert_int_equal(text.count, 3);
    assert_int_equal(text.polygon, 0);
    assert_int_equal(text.line, 1);
    assert_int_equal(text.points[1][0], 16);
    assert_int_equal(coverage_text_next(&text, &error), 1);
    assert_int_equal(text.count, 4);
    assert_int_equal(text.polygon, 1);
    assert_int_equal(text.line, 4);
    assert_int_equal(text.points[0][0], 5);
    assert_int_equal(text.points[0][1], -7);
    assert_int_equal(text.points[1][0], 524272);
    assert_int_equal(text.points[1][1], -524272);
    assert_int_equal(text.points[3][1], 4);
    assert_int_equal(coverage_text_next(&text, &error), 0);
    coverage_text_close(&text);
    (void)fclose(file);
}

static void polygons_may_be_long(void **state) {
    (void)state;
    FILE *file = tmpfile();
    assert_non_null(file);
    for (int i = 0; i < 100000; i++) {
        (void)fprintf(file, "%d %d ", i, -i);
    }
    rewind(file);
    coverage_text_t text;
    coverage_text_open(&text, file, "polygons");
    assert_int_equal(coverage_text_next(&text, NULL), 1);
    assert_int_equal(text.count, 100000);
    assert_int_equal(text.points[99999][1], -99999);
    assert_int_equal(coverage_text_next(&text, NULL), 0);
    coverage_text_close(&text);
    (void)fclose(file);
}

static void polygons_name_the_bad_line(void **state) {
    (void)state;
    static const struct {
        const char *text, *what;
    } cases[] = {
        {"0 0 1 0 0 1\n0 0 1 0 0\n", "odd"},
        {"0 0 1 0 0 1\n0 0 1 0\n", "three vertices"},
        {"0 0 1 0 0 1\n0 0 1 0 0 1.5\n", "whole"},
        {"0 0 1 0 0 1\n0 0 1 0 0 524273\n", "beyond"},
        {"0 0 1 0 0 1\n0 0 1 0 0 -\n", "whole"},
        {"0 0 1 0 0 1\nx\n", "whole"},
        {"0 0 1 0 0 1\n0", "odd"},
        {"0 0 1 0 0 1\n0 0 -99999999999999999999 0 0 1", "beyond"},
        {"0 0 1 0 0 1\n0,0 1,0 0,1", "whole"},
        {"0 0 1 0 0 1\n0 0 1 0 0 1 # no comments here", "whole"},
    };
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        FILE *file = file_of(cases[i].text);
        coverage_text_t text;
        sim_error_t error = {""};
        coverage_text_open(&text, file, "polygons");
        assert_int_equal(coverage_text_next(&text, &error), 1);
        assert_int_equal(coverage_text_next(&text, &error), -1);
        if (!strstr(error.text, "polygons: line 2: ") || !strstr(error.text, cases[i].what)) {
            fail_msg("%s\ngave: %s", cases[i].text, error.text);
        }
        coverage_text_close(&text);
        (void)fclose(file);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_reads_every_line),      cmocka_unit_test(text_has_defaults),
        cmocka_unit_test(text_names_the_bad_line),    cmocka_unit_test(text_takes_odd_but_good_polygons),
        cmocka_unit_test(text_counts_corners),        cmocka_unit_test(text_quantises),
        cmocka_unit_test(text_places_the_camera),     cmocka_unit_test(text_reads_files),
        cmocka_unit_test(polygons_are_read),          cmocka_unit_test(polygons_may_be_long),
        cmocka_unit_test(polygons_name_the_bad_line),
    };
    return cmocka_run_group_tests_name("scene_text", tests, NULL, NULL);
}
