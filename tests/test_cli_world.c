/* tuile render with several models: where they stand, told by picking; levels of detail, key frames, the camera in orbit. */
#include "support/check.h"
#include "support/cli.h"

#include "../sim/picture.h"

#include <math.h>
#include <unistd.h>

/* 20 pixels a unit, the origin at 120,160, z towards the eye. */
#define ORTHO " --ortho 16 --eye 0,0,10 --at 0,0,0 --near 1 --far 20 --spin 0"

/* "face N" that is picked at a pixel, 0 for the background; z receives the third coordinate of the point. */
static unsigned picked(const char *arguments, int x, int y, double *z) {
    char line[1024];
    (void)snprintf(line, sizeof line, "render %s --pick %d,%d", arguments, x, y);
    char *out = cli_good(line), *at = strstr(out, "face ");
    unsigned face = 0;
    double point[3] = {0, 0, 0};
    if (at && sscanf(at, "face %u at %lf,%lf,%lf", &face, &point[0], &point[1], &point[2]) != 4) { fail_msg("%s", out); }
    if (!at) { assert_non_null(strstr(out, "background")); }
    if (z) { *z = point[2]; }
    free(out);
    return face;
}

/* Faces of the cube: 1 looks along +z, 2 along -z, 3 +x, 4 -x, 5 +y, 6 -y. */
static void models_stand_where_they_were_put(void **state) {
    static const char scene[] = "@/cube.obj --add @/cube.obj,at=3,0,0 --add @/cube.obj,at=-3,0,0,turn=0,180,0,scale=0.5" ORTHO;
    (void)state;
    assert_int_equal(picked(scene, 120, 160, NULL), 1);
    assert_int_equal(picked(scene, 180, 160, NULL), 6 + 1);
    assert_int_equal(picked(scene, 180 + 18, 160, NULL), 6 + 1);
    assert_int_equal(picked(scene, 150, 160, NULL), 0);
    assert_int_equal(picked(scene, 60, 160, NULL), 12 + 2);
    assert_int_equal(picked(scene, 60 + 8, 160, NULL), 12 + 2);
    assert_int_equal(picked(scene, 60 + 12, 160, NULL), 0);
}

static void models_hang_on_others(void **state) {
    /* The first at (0, 3, 0), turned by a quarter about z and half as large: what is 3 along its x is 1.5 higher. */
    static const char scene[] =
        "@/cube.obj --add @/cube.obj,at=0,3,0,turn=0,0,90,scale=0.5,parent=0 --add @/cube.obj,parent=1,at=3,0,0,turn=0,90,0" ORTHO;
    (void)state;
    assert_int_equal(picked(scene, 120, 160, NULL), 1);
    assert_int_equal(picked(scene, 120, 100, NULL), 6 + 1);
    assert_int_equal(picked(scene, 120, 70, NULL), 12 + 4); /* its -x looks along z */
    assert_int_equal(picked(scene, 120, 70 - 9, NULL), 12 + 4);
    assert_int_equal(picked(scene, 120, 70 - 11, NULL), 0);
    /* Three angles, about x first: x stays, then goes to -z, and stays there. So -x looks at the eye. */
    static const char turned[] = "@/cube.obj --add @/cube.obj,at=3,0,0,turn=90,90,90" ORTHO;
    assert_int_equal(picked(turned, 180, 160, NULL), 6 + 4);
}

static void what_hangs_on_a_spinning_model_goes_round_it(void **state) {
    static const char scene[] = "@/cube.obj --add @/cube.obj,spin=180 --add @/cube.obj,at=3,0,0,parent=1" ORTHO;
    char line[512];
    (void)state;
    assert_int_equal(picked(scene, 180, 160, NULL), 12 + 1);
    (void)snprintf(line, sizeof line, "%s --frames 2", scene); /* picks in the last one */
    assert_int_equal(picked(line, 180, 160, NULL), 0);
    assert_int_equal(picked(line, 60, 160, NULL), 12 + 2);
}

static void all_methods_draw_the_same_world(void **state) {
    static const char *const methods[] = {"zbuffer", "scanline", "warnock", "painter"};
    char line[1024], *first = NULL;
    (void)state;
    for (unsigned k = 0; k < 8; k++) {
        (void)snprintf(
            line, sizeof line,
            "render @/torus.obj --add @/octahedron.obj,at=1,0,0,colour=ff8000 --add @/cube.obj,at=0,1.5,0,scale=0.4,turn=30,20,10"
            ",parent=1 --frames 3 --hash --method %s%s",
            methods[k % 4], k < 4 ? "" : " --memory 40K --tile 64x16");
        char *out = cli_good(line);
        if (first) { assert_string_equal(out, first); }
        if (first) {
            free(out);
        } else {
            first = out;
        }
    }
    free(first);
    cli_good_silent("render @/torus.obj --add @/octahedron.obj,at=3,0,0 --method tree --hash");
}

static void the_view_frames_all_models_whatever_their_spin(void **state) {
    static const char scene[] = "render @/cube.obj --add @/cube.obj,at=40,0,0 --add @/cube.obj,spin=30,at=0,1,0 --add "
                                "@/cube.obj,at=0,0,60,parent=2 --frames 12 --report @/report.json --hash";
    (void)state;
    cli_good_silent(scene);
    char *report = command_read(cli_path("report.json"), NULL);
    unsigned frames = 0;
    for (const char *at = report; (at = strstr(at, "\"instances\": ")) != NULL; at++, frames++) {
        assert_int_equal(cli_number_after(at, "\"instances\": "), 4 * cli_number_after(at, "\"passes\": "));
        assert_int_equal(cli_number_after(at, "\"instances_outside\": "), 0);
        assert_int_equal(cli_number_after(at, "\"faces_clipped\": "), 0);
    }
    assert_int_equal(frames, 12);
    free(report);
    (void)unlink(cli_path("report.json"));
}

static void a_colour_takes_the_place_of_the_model_s(void **state) {
    sim_picture_t picture = {0};
    (void)state;
    cli_good_silent("render @/cube.obj --add @/cube.obj,at=3,0,0,colour=0000fc --out @/colours.ppm" ORTHO);
    assert_int_equal(sim_picture_read(&picture, cli_path("colours.ppm"), NULL), 0);
    const uint8_t *main_cube = picture.rgb + 3 * (160 * 240 + 120), *added = picture.rgb + 3 * (160 * 240 + 180);
    assert_true(main_cube[0] > 60 && main_cube[2] > 60);
    assert_true(added[0] == 0 && added[1] == 0 && added[2] > 60);
    sim_picture_free(&picture);
    (void)unlink(cli_path("colours.ppm"));
}

/* ---- levels of detail ---- */

static void the_distance_chooses_the_model(void **state) {
    static const struct {
        int distance;
        const char *faces;
    } stops[] = {{4, ": 6 faces"}, {6, ": 8 faces"}, {19, ": 8 faces"}, {25, ": 0 faces"}};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(stops); i++) {
        char line[256];
        (void)snprintf(
            line, sizeof line,
            "render @/cube.obj --lod @/octahedron.obj:5 --lod none:20 --at 0,0,0 --eye 0,0,%d --near 1 --far 40 --report "
            "@/report.json",
            stops[i].distance);
        char *out = cli_good(line);
        if (!strstr(out, stops[i].faces)) { fail_msg("%s", out); }
        free(out);
    }
    (void)unlink(cli_path("report.json"));
    char *out = cli_good("render @/cube.obj --lod @/octahedron.obj:5 --at 0,0,0 --eye 0,0,1000");
    assert_non_null(strstr(out, ": 8 faces"));
    free(out);
}

/* ---- key frames ---- */

static void key_frames_are_mixed(void **state) {
    double z;
    (void)state;
    cli_put("low.obj", "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nf 1 2 3 4\n");
    cli_put("high.obj", "v -2 -2 4\nv 2 -2 4\nv 2 2 4\nv -2 2 4\nf 1 2 3 4\n");
#define SQUARE "@/low.obj --morph @/high.obj" ORTHO
    assert_int_equal(picked(SQUARE " --morph-at 0", 120, 160, &z), 1);
    assert_true(fabs(z) < 0.001);
    assert_int_equal(picked(SQUARE " --morph-at 0.25", 120, 160, &z), 1);
    assert_true(fabs(z - 1) < 0.001);
    assert_int_equal(picked(SQUARE, 120, 160, &z), 1);
    assert_true(fabs(z - 4) < 0.001);
    assert_int_equal(picked(SQUARE " --morph-swing --frames 4", 120, 160, &z),
                     1); /* the last one: three quarters of the way there and back */
    assert_true(fabs(z - 2) < 0.001);
    cli_good_silent("mesh @/low.obj --morph @/high.obj -o @/both.tuile");
    assert_int_equal(picked("@/cube.obj --add @/both.tuile,at=0,0,2,morph=0.5" ORTHO, 120, 160, &z), 7);
    assert_true(fabs(z - 2) < 0.001); /* on the model itself */
    (void)unlink(cli_path("both.tuile"));
    (void)unlink(cli_path("low.obj"));
    (void)unlink(cli_path("high.obj"));
}

/* ---- the camera ---- */

static void an_orbit_is_an_eye(void **state) {
    static const char *const pairs[][2] = {
        {"--orbit 0,0,8", "--eye 0,0,8"},
        {"--orbit 90,0,8", "--eye 8,0,0"},
        {"--orbit=-90,0,8", "--eye -8,0,0"},
        {"--orbit 0,90,8", "--eye 0,8,0 --up 0,0,-1"},
        {"--orbit 450,-90,8", "--eye 0,-8,0 --up 1,0,0"},
    };
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(pairs); i++) {
        char lines[2][256];
        for (unsigned k = 0; k < 2; k++) {
            (void)snprintf(lines[k], sizeof lines[k], "render @/octahedron.obj %s --at 0,0,0 --light 1,-2,-3 --hash", pairs[i][k]);
        }
        char *orbit = cli_good(lines[0]), *eye = cli_good(lines[1]);
        if (strcmp(orbit, eye) != 0) { fail_msg("%s: not %s", pairs[i][0], pairs[i][1]); }
        free(orbit);
        free(eye);
    }
    /* Without a distance all is framed, as far away as by default: the direction that is the default's. */
    cli_good_silent("render @/torus.obj --orbit 20,30,0 --hash");
}

/* ---- errors ---- */

static void wrong_worlds_are_told(void **state) {
    (void)state;
    cli_fails("render @/cube.obj --add", "--add", NULL);
    cli_fails("render @/cube.obj --add @/missing.obj", "missing.obj", NULL);
    cli_fails("render @/cube.obj --add @/cube.obj,at=1,2", "--add", "at=X,Y,Z");
    cli_fails("render @/cube.obj --add @/cube.obj,size=2", "--add", "wrong from here: size=2");
    cli_fails("render @/cube.obj --add @/cube.obj,scale=0", "--add", "scale");
    cli_fails("render @/cube.obj --add @/cube.obj,scale=-1", "--add", "scale");
    cli_fails("render @/cube.obj --add @/cube.obj,parent=1", "--add", "parent"); /* itself */
    cli_fails("render @/cube.obj --add @/cube.obj,parent=-1", "--add", "parent");
    cli_fails("render @/cube.obj --add @/cube.obj,parent=0.5", "--add", "parent");
    cli_fails("render @/cube.obj --add @/cube.obj,colour=red", "--add", "colour");
    cli_fails("render @/cube.obj --add @/cube.obj,morph=1.5", "--add", "morph");
    cli_fails("render @/cube.obj --add @/cube.obj,morph=0.5", "--add", "key frame");
    cli_fails("render @/cube.obj --add ,at=1,2,3", "--add", "FILE");
    cli_fails("render @/cube.obj --add @/cube.obj,at=nan,0,0", "--add", "at=");
    cli_fails("render @/cube.obj --add @/cube.obj,at=1e9,0,0 --eye 0,0,4 --far 8", "--near", "--far");
    cli_fails("render @/cube.obj --lod @/cube.obj", "--lod", "DISTANCE");
    cli_fails("render @/cube.obj --lod @/cube.obj:0", "--lod", "DISTANCE");
    cli_fails("render @/cube.obj --lod @/cube.obj:5 --lod @/cube.obj:5", "--lod", "farther");
    cli_fails("render @/cube.obj --lod none:5 --lod @/cube.obj:6", "--lod", "last");
    cli_fails("render @/cube.obj --lod @/missing.obj:5", "missing.obj", NULL);
    cli_fails("render @/cube.obj --morph-at 0.5", "--morph-at", "key frame");
    cli_fails("render @/cube.obj --morph-swing", "--morph-swing", "key frame");
    cli_fails("render @/cube.obj --morph-at 1.5", "--morph-at", NULL);
    cli_fails("render @/cube.obj --orbit 1,2", "--orbit", NULL);
    cli_fails("render @/cube.obj --orbit 1,2,-3", "--orbit", "negative");
    cli_fails("render @/cube.obj --orbit 1,2,3 --eye 1,2,3", "--orbit", "--eye");
    cli_fails("render @/cube.obj --add @/cube.obj --show zbuffer-overdraw --out @/x.png", "--show", "--add");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_stand_where_they_were_put),
        cmocka_unit_test(models_hang_on_others),
        cmocka_unit_test(what_hangs_on_a_spinning_model_goes_round_it),
        cmocka_unit_test(all_methods_draw_the_same_world),
        cmocka_unit_test(the_view_frames_all_models_whatever_their_spin),
        cmocka_unit_test(a_colour_takes_the_place_of_the_model_s),
        cmocka_unit_test(the_distance_chooses_the_model),
        cmocka_unit_test(key_frames_are_mixed),
        cmocka_unit_test(an_orbit_is_an_eye),
        cmocka_unit_test(wrong_worlds_are_told),
    };
    return cmocka_run_group_tests_name("cli_world", tests, cli_set_up, cli_tear_down);
}
