/* tuile coverage and tuile faces: polygons and scenes as text, known by hand. */
#include "support/check.h"
#include "support/cli.h"

/* ---- coverage ----------------------------------------------------------------------------------------------- */

static void coverage_of_polygons_known_by_hand(void **state) {
    (void)state;
    cli_put("polygons", "16 16 48 16 48 48 16 48\n" /* two by two pixels */
                        "8 8 40 8 40 40 8 40\n"     /* edges through centres: left and top are drawn */
                        "\n"
                        "0 0 16 0 16 32 48 32 48 0 64 0 64 48 0 48\r\n" /* a U */
                        "-160 -160 1600 -160 1600 1600 -160 1600\n"     /* larger than the window */
                        "0 0 64 64 64 0 0 64\n"                         /* crosses itself in the middle */
                        "0 0 16 0 32 0\n"                               /* without area */
                        "48 48 16 48 16 16 48 16");                     /* the first, the other way round and without a newline */
    cli_answers("coverage 4 4 < @/polygons", "polygon 0\n1 1 2\n2 1 2\n"
                                             "polygon 1\n0 0 1\n1 0 1\n"
                                             "polygon 2\n0 0 0\n0 3 3\n1 0 0\n1 3 3\n2 0 3\n"
                                             "polygon 3\n0 0 3\n1 0 3\n2 0 3\n3 0 3\n"
                                             "polygon 4\n0 3 3\n1 0 0\n1 2 3\n2 0 0\n2 2 3\n3 3 3\n"
                                             "polygon 5\n"
                                             "polygon 6\n1 1 2\n2 1 2\n");
    cli_answers("coverage 4 4 < /dev/null", "");
    cli_put("far", "-524272 -524272 524272 -524272 524272 524272 -524272 524272\n");
    cli_answers("coverage 2 1 < @/far", "polygon 0\n0 0 1\n");
}

static void coverage_names_the_bad_line(void **state) {
    static const char *const bad[] = {"1 2 3 4 5\n",        "1 2 3 4\n",     "1 2 3 4 5 x\n", "1 2 3 4 5 6.5\n",
                                      "1 2 3 4 5 524273\n", "- 2 3 4 5 6\n", "1 2 3 4 5 6 7", "1e3 2 3 4 5 6\n"};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        char text[128];
        (void)snprintf(text, sizeof text, "0 0 16 0 16 16\n\n%s", bad[i]);
        cli_put("bad", text);
        cli_fails("coverage 4 4 < @/bad", "standard input", "line 3");
    }
    cli_fails("coverage 0 4 < /dev/null", "0", "width");
    cli_fails("coverage 4 32768 < /dev/null", "32768", "height");
    cli_fails("coverage four 4 < /dev/null", "four", NULL);
    cli_fails("coverage 4 4 < @", "standard input", NULL); /* a folder cannot be read */
}

/* ---- faces -------------------------------------------------------------------------------------------------- */

static void faces_of(const char *scene, const char *expected) {
    cli_put("scene", scene);
    cli_answers("faces @/scene", expected);
    cli_answers("faces - < @/scene", expected);
    cli_answers("faces --tile 2x1 --memory 12K @/scene", expected);
    cli_answers("faces --method zbuffer --tile=1x1 @/scene", expected);
}

static void faces_of_scenes_known_by_hand(void **state) {
    static const char *const two = "poly 7 0,0,5 3,0,5 3,3,5 0,3,5\npoly 9 1,1,3 4,1,3 4,3,3 1,3,3\n";
    char text[512];
    (void)state;
    (void)snprintf(text, sizeof text, "screen 4 3\ncamera ortho\nsample 1/2 1/2\n%s", two);
    faces_of(text, "7 7 7 0\n7 9 9 9\n7 9 9 9\n");
    (void)snprintf(text, sizeof text, "screen 4 3\ncamera ortho\nsample 1/2 1/2\nnear max # the other end\n%s", two);
    faces_of(text, "7 7 7 0\n7 7 7 9\n7 7 7 9\n");
    faces_of("screen 2 1\ncamera ortho\nsample 1/2 1/2\npoly 3 0,0,1 1,0,1 1,1,1 0,1,1\npoly 4 0,0,1 2,0,1 2,1,1 0,1,1\n", "3 4\n");
    faces_of("screen 2 1\ncamera ortho\nsample 1/2 1/2\ntie last\npoly 3 0,0,1 1,0,1 1,1,1 0,1,1\npoly 4 0,0,1 2,0,1 2,1,1 0,1,1\n",
             "4 4\n");
    /* Sampled at whole points unless told otherwise; what lies on a right or lower edge is outside. */
    faces_of("screen 3 3\ncamera ortho\npoly 1 0,0,1 2,0,1 2,2,1 0,2,1\n", "1 1 0\n1 1 0\n0 0 0\n");
    faces_of("screen 3 3\ncamera ortho\nsample 1/2 1/2\npoly 1 1/2,0.5,1 5/2,0.5,1 2.5,5/2,1 0.5,5/2,1\n", "1 1 0\n1 1 0\n0 0 0\n");
    faces_of("screen 4 4\ncamera ortho\nsample 1/2 1/2\npoly 1 0,0,1 4,4,1 4,0,1 0,4,1\n", "0 0 0 1\n1 0 1 1\n1 0 1 1\n0 0 0 1\n");
    faces_of("screen 3 2\ncamera ortho\n", "0 0 0\n0 0 0\n");
    faces_of("camera persp 5\nscreen 1 1\n", "0\n");
    /* Either winding is seen, and ids may repeat. */
    faces_of("screen 2 1\ncamera ortho\nsample 1/2 1/2\npoly 6 0,0,1 1,0,1 1,1,1 0,1,1\npoly 6 1,0,1 1,1,1 2,1,1 2,0,1\n", "6 6\n");
}

static void faces_in_perspective_known_by_hand(void **state) {
    (void)state;
    /* F = 2 about (2, 2): +-1 at Z = 2 is 1 ... 3, +-3/8 at Z = 3/2 is 1.5 ... 2.5. */
    faces_of("screen 4 4\ncamera persp 2\nsample 1/2 1/2\npoly 3 -1,-1,2 1,-1,2 1,1,2 -1,1,2\npoly 5 -3/8,-3/8,3/2 3/8,-3/8,3/2 "
             "3/8,3/8,3/2 -3/8,3/8,3/2\n",
             "0 0 0 0\n0 5 3 0\n0 3 3 0\n0 0 0 0\n");
    faces_of("screen 4 4\ncamera persp 2\nsample 1/2 1/2\npoly 4 -1,0,2 1,0,2 1,1,2 -1,1,2\n",
             "0 0 0 0\n0 0 0 0\n0 4 4 0\n0 0 0 0\n");
    faces_of("screen 4 4\ncamera persp 2\nsample 1/2 1/2\nysign -1\npoly 4 -1,0,2 1,0,2 1,1,2 -1,1,2\n",
             "0 0 0 0\n0 4 4 0\n0 0 0 0\n0 0 0 0\n");
    faces_of("screen 4 4\ncamera persp 2\nsample 1/2 1/2\norigin 3 1\npoly 4 -1,-1,2 1,-1,2 1,1,2 -1,1,2\n",
             "0 0 4 4\n0 0 4 4\n0 0 0 0\n0 0 0 0\n");
    /* Behind the eye, and before the near plane. */
    faces_of("screen 2 2\ncamera persp 2\nsample 1/2 1/2\npoly 4 -9,-9,-2 9,-9,-2 9,9,-2 -9,9,-2\n", "0 0\n0 0\n");
    faces_of("screen 2 2\ncamera persp 2 3\nsample 1/2 1/2\npoly 4 -9,-9,2 9,-9,2 9,9,2 -9,9,2\n", "0 0\n0 0\n");
    /* A floor through the near plane: below the horizon all of it. y = 2 + 2 * 1 / Z, at Z = 4 it ends at 2.5. */
    faces_of("screen 2 4\ncamera persp 2\nsample 1/2 1/2\npoly 8 -99,1,-4 99,1,-4 99,1,4 -99,1,4\n", "0 0\n0 0\n8 8\n8 8\n");
}

static void a_bad_scene_names_the_line(void **state) {
    static const struct {
        const char *line, *word;
    } bad[] = {
        {"polygon 1 0,0,1 1,0,1 1,1,1", "line 3"},
        {"poly 0 0,0,1 1,0,1 1,1,1", "line 3"},
        {"poly 1 0,0,1 1,0,1", "line 3"},
        {"poly 1 0,0 1,0 1,1", "line 3"},
        {"poly 1 0,0,1 4,0,1 4,4,1 0,4,2", "line 3"}, /* not planar */
        {"poly 1 0,0,1 4,0,x 4,4,1", "line 3"},
        {"poly 1 0,0,1 4,0,1/0 4,4,1", "line 3"},
        {"screen 4 4", "line 3"},
        {"near middle", "line 3"},
        {"tie both", "line 3"},
        {"sample 1", "line 3"},
    };
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        char text[256];
        (void)snprintf(text, sizeof text, "screen 4 4\ncamera ortho\n%s\n", bad[i].line);
        cli_put("scene", text);
        cli_fails("faces @/scene", bad[i].word, "scene");
    }
    cli_put("scene", "screen 0 4\ncamera ortho\n");
    cli_fails("faces @/scene", "line 1", NULL);
    cli_put("scene", "screen 4 1025\ncamera ortho\n");
    cli_fails("faces @/scene", "line 1", NULL);
    cli_put("scene", "camera ortho\n");
    cli_fails("faces @/scene", "screen", NULL);
    cli_put("scene", "screen 4 4\n");
    cli_fails("faces @/scene", "camera", NULL);
    cli_put("scene", "");
    cli_fails("faces @/scene", "scene", NULL);
    cli_fails("faces @/none", "none", NULL);
    cli_put("scene", "screen 4 4\ncamera ortho\n");
    cli_fails("faces --memory 100 @/scene", "--memory", "wants");
    cli_fails("faces --method bsp @/scene", "--method", "zbuffer");
    cli_fails("faces --colour @/scene", "--colour", NULL);
}

static void faces_says_when_coordinates_are_rounded(void **state) {
    command_result_t result;
    (void)state;
    cli_put("scene", "screen 3 1\ncamera ortho\nsample 1/2 1/2\npoly 2 1/3,0,1 7/3,0,1 7/3,1,1 1/3,1,1\n");
    cli_shell(&result, "% faces @/scene");
    assert_int_equal(result.code, 0);
    assert_string_equal(result.out, "2 2 0\n");
    assert_int_equal(strncmp(result.err, "tuile: ", 7), 0);
    assert_non_null(strstr(result.err, "rounded"));
    command_free(&result);
}

static void two_scenes_at_once_are_refused(void **state) {
    (void)state;
    cli_put("scene", "screen 4 4\ncamera ortho\n");
    cli_put("other", "screen 4 4\ncamera ortho\n");
    cli_fails("faces @/scene @/other", "other", NULL);
    cli_fails("render @/cube.obj @/torus.obj", "torus.obj", NULL);
    cli_fails("mesh @/cube.obj @/torus.obj -o @/x.tuile", "torus.obj", NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coverage_of_polygons_known_by_hand), cmocka_unit_test(coverage_names_the_bad_line),
        cmocka_unit_test(faces_of_scenes_known_by_hand),      cmocka_unit_test(faces_in_perspective_known_by_hand),
        cmocka_unit_test(a_bad_scene_names_the_line),         cmocka_unit_test(faces_says_when_coordinates_are_rounded),
        cmocka_unit_test(two_scenes_at_once_are_refused),
    };
    return cmocka_run_group_tests_name("cli_text", tests, cli_set_up, cli_tear_down);
}
