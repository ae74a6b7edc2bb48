/* The program as a user meets it: what it prints, what it writes, and how it refuses. Runs the binary that TUILE names. */
#include "support/check.h"
#include "support/command.h"
#include "support/models.h"

#include "../sim/picture.h"

#include <ctype.h>
#include <unistd.h>

static char *folder;

static const char *program(void) {
    const char *path = getenv("TUILE");
    return path && *path ? path : "build/tuile";
}

static const char *path_of(const char *name) {
    static char path[2][512];
    static unsigned turn;
    turn ^= 1;
    (void)snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

static void put(const char *name, const char *text) { command_write(path_of(name), text, strlen(text)); }

/* A line for the shell: @ stands for the folder, % at its beginning for the program. */
static void shell(command_result_t *result, const char *line) {
    char full[4096];
    size_t used = 0;
    for (const char *at = line; *at; at++) {
        const char *text = *at == '@' ? folder : *at == '%' && at == line ? program() : NULL;
        const char one[2] = {*at, '\0'};
        used += (size_t)snprintf(full + used, sizeof full - used, "%s", text ? text : one);
        assert_true(used < sizeof full);
    }
    command_shell(result, full);
}

/* Arguments of the program. It must succeed; stdout is to be released with free. */
static char *good(const char *arguments) {
    char line[2048];
    command_result_t result;
    (void)snprintf(line, sizeof line, "%% %s", arguments);
    shell(&result, line);
    if (result.code != 0) { fail_msg("tuile %s: exit code %d\n%s", arguments, result.code, result.err); }
    char *out = strdup(result.out);
    command_free(&result);
    return out;
}

static void good_silent(const char *arguments) { free(good(arguments)); }

/* The same, for an exact answer. */
static void answers(const char *arguments, const char *expected) {
    char *out = good(arguments);
    if (strcmp(out, expected) != 0) { fail_msg("tuile %s\n--- printed\n%s--- expected\n%s", arguments, out, expected); }
    free(out);
}

/* It must fail with one line that has both words in it, and leave the folder as it was. */
static void fails(const char *arguments, const char *word, const char *other_word) {
    char line[2048], *before = command_list(folder), *after;
    command_result_t result;
    (void)snprintf(line, sizeof line, "%% %s", arguments);
    shell(&result, line);
    if (!command_failed_well(&result, word, other_word)) { fail_msg("tuile %s", arguments); }
    after = command_list(folder);
    if (strcmp(before, after) != 0) { fail_msg("tuile %s\n--- before\n%s--- left behind\n%s", arguments, before, after); }
    free(before);
    free(after);
    command_free(&result);
}

static bool exists(const char *name) { return access(path_of(name), F_OK) == 0; }

static int set_up(void **state) {
    mesh_t mesh;
    (void)state;
    folder = command_folder();
    model_cube(&mesh);
    model_write_obj(&mesh, path_of("cube.obj"));
    mesh_free(&mesh);
    model_torus(&mesh, 20, 10, true);
    model_write_obj(&mesh, path_of("torus.obj"));
    mesh_free(&mesh);
    model_octahedron(&mesh);
    model_write_obj(&mesh, path_of("octahedron.obj"));
    mesh_free(&mesh);
    model_room(&mesh);
    model_write_obj(&mesh, path_of("room.obj"));
    mesh_free(&mesh);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    command_remove(folder);
    return 0;
}

/* ---- usage -------------------------------------------------------------------------------------------------- */

static void help_goes_to_stdout_and_wrong_usage_to_stderr(void **state) {
    static const char *const commands[] = {"render", "mesh", "faces", "coverage"};
    static const char *const spellings[] = {"--help", "-h", "help"};
    command_result_t result;
    (void)state;
    for (unsigned i = 0; i < 3; i++) {
        char *out = good(spellings[i]);
        assert_int_equal(strncmp(out, "Usage: tuile COMMAND", 20), 0);
        for (unsigned c = 0; c < 4; c++) {
            assert_non_null(strstr(out, commands[c]));
        }
        free(out);
    }
    shell(&result, "%");
    assert_int_equal(result.code, 2);
    assert_string_equal(result.out, "");
    assert_int_equal(strncmp(result.err, "Usage: tuile", 12), 0);
    command_free(&result);
    for (unsigned c = 0; c < 4; c++) {
        char line[64], begin[64];
        (void)snprintf(line, sizeof line, "%s --help", commands[c]);
        (void)snprintf(begin, sizeof begin, "Usage: tuile %s ", commands[c]);
        char *out = good(line);
        assert_int_equal(strncmp(out, begin, strlen(begin)), 0);
        free(out);
        (void)snprintf(line, sizeof line, "%% %s", commands[c]);
        shell(&result, line);
        assert_int_equal(result.code, 2);
        assert_string_equal(result.out, "");
        assert_int_equal(strncmp(result.err, begin, strlen(begin)), 0);
        command_free(&result);
    }
    fails("paint", "paint", "--help");
}

static void help_of_render_names_every_option(void **state) {
    static const char *const options[] = {"--panel",     "--rotate", "--clock", "--method", "--shade",  "--memory", "--tile",
                                          "--max-faces", "--frames", "--spin",  "--eye",    "--at",     "--up",     "--fov",
                                          "--near",      "--far",    "--ortho", "--pitch",  "--centre", "--light",  "--background",
                                          "--out",       "--sheet",  "--ids",   "--pick",   "--hash",   "--report"};
    char *out = good("render --help");
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(options); i++) {
        if (!strstr(out, options[i])) { fail_msg("%s", options[i]); }
    }
    free(out);
}

/* ---- coverage ----------------------------------------------------------------------------------------------- */

static void coverage_of_polygons_known_by_hand(void **state) {
    (void)state;
    put("polygons", "16 16 48 16 48 48 16 48\n" /* two by two pixels */
                    "8 8 40 8 40 40 8 40\n"     /* edges through centres: left and top are drawn */
                    "\n"
                    "0 0 16 0 16 32 48 32 48 0 64 0 64 48 0 48\r\n" /* a U */
                    "-160 -160 1600 -160 1600 1600 -160 1600\n"     /* larger than the window */
                    "0 0 64 64 64 0 0 64\n"                         /* crosses itself in the middle */
                    "0 0 16 0 32 0\n"                               /* without area */
                    "48 48 16 48 16 16 48 16");                     /* the first, the other way round and without a newline */
    answers("coverage 4 4 < @/polygons", "polygon 0\n1 1 2\n2 1 2\n"
                                         "polygon 1\n0 0 1\n1 0 1\n"
                                         "polygon 2\n0 0 0\n0 3 3\n1 0 0\n1 3 3\n2 0 3\n"
                                         "polygon 3\n0 0 3\n1 0 3\n2 0 3\n3 0 3\n"
                                         "polygon 4\n0 3 3\n1 0 0\n1 2 3\n2 0 0\n2 2 3\n3 3 3\n"
                                         "polygon 5\n"
                                         "polygon 6\n1 1 2\n2 1 2\n");
    answers("coverage 4 4 < /dev/null", "");
    put("far", "-524272 -524272 524272 -524272 524272 524272 -524272 524272\n");
    answers("coverage 2 1 < @/far", "polygon 0\n0 0 1\n");
}

static void coverage_names_the_bad_line(void **state) {
    static const char *const bad[] = {"1 2 3 4 5\n",        "1 2 3 4\n",     "1 2 3 4 5 x\n", "1 2 3 4 5 6.5\n",
                                      "1 2 3 4 5 524273\n", "- 2 3 4 5 6\n", "1 2 3 4 5 6 7", "1e3 2 3 4 5 6\n"};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        char text[128];
        (void)snprintf(text, sizeof text, "0 0 16 0 16 16\n\n%s", bad[i]);
        put("bad", text);
        fails("coverage 4 4 < @/bad", "standard input", "line 3");
    }
    fails("coverage 0 4 < /dev/null", "0", "width");
    fails("coverage 4 32768 < /dev/null", "32768", "height");
    fails("coverage four 4 < /dev/null", "four", NULL);
    fails("coverage 4 4 < @", "standard input", NULL); /* a folder cannot be read */
}

/* ---- faces -------------------------------------------------------------------------------------------------- */

static void faces_of(const char *scene, const char *expected) {
    put("scene", scene);
    answers("faces @/scene", expected);
    answers("faces - < @/scene", expected);
    answers("faces --tile 2x1 --memory 12K @/scene", expected);
    answers("faces --method zbuffer --tile=1x1 @/scene", expected);
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
        put("scene", text);
        fails("faces @/scene", bad[i].word, "scene");
    }
    put("scene", "screen 0 4\ncamera ortho\n");
    fails("faces @/scene", "line 1", NULL);
    put("scene", "screen 4 1025\ncamera ortho\n");
    fails("faces @/scene", "line 1", NULL);
    put("scene", "camera ortho\n");
    fails("faces @/scene", "screen", NULL);
    put("scene", "screen 4 4\n");
    fails("faces @/scene", "camera", NULL);
    put("scene", "");
    fails("faces @/scene", "scene", NULL);
    fails("faces @/none", "none", NULL);
    put("scene", "screen 4 4\ncamera ortho\n");
    fails("faces --memory 100 @/scene", "--memory", "wants");
    fails("faces --method bsp @/scene", "--method", "zbuffer");
    fails("faces --colour @/scene", "--colour", NULL);
}

static void faces_says_when_coordinates_are_rounded(void **state) {
    command_result_t result;
    (void)state;
    put("scene", "screen 3 1\ncamera ortho\nsample 1/2 1/2\npoly 2 1/3,0,1 7/3,0,1 7/3,1,1 1/3,1,1\n");
    shell(&result, "% faces @/scene");
    assert_int_equal(result.code, 0);
    assert_string_equal(result.out, "2 2 0\n");
    assert_int_equal(strncmp(result.err, "tuile: ", 7), 0);
    assert_non_null(strstr(result.err, "rounded"));
    command_free(&result);
}

static void two_scenes_at_once_are_refused(void **state) {
    (void)state;
    put("scene", "screen 4 4\ncamera ortho\n");
    put("other", "screen 4 4\ncamera ortho\n");
    fails("faces @/scene @/other", "other", NULL);
    fails("render @/cube.obj @/torus.obj", "torus.obj", NULL);
    fails("mesh @/cube.obj @/torus.obj -o @/x.tuile", "torus.obj", NULL);
}

/* ---- options ------------------------------------------------------------------------------------------------ */

static void options_out_of_range_are_refused_by_name(void **state) {
    static const struct {
        const char *option, *value;
    } bad[] = {
        {"--panel", "st7789"},
        {"--rotate", "45"},
        {"--rotate", "-90"},
        {"--clock", "fast"},
        {"--clock", "2000M"},
        {"--clock", "-1"},
        {"--method", "painter"},
        {"--shade", "phong"},
        {"--memory", "much"},
        {"--memory", "-1"},
        {"--memory", "2048M"},
        {"--memory", "16Kx"},
        {"--tile", "0x4"},
        {"--tile", "16"},
        {"--tile", "1025x1"},
        {"--tile", "16x16x16"},
        {"--max-faces", "0"},
        {"--max-faces", "1.5"},
        {"--frames", "0"},
        {"--frames", "100001"},
        {"--frames", "x"},
        {"--spin", "nan"},
        {"--spin", "1e7"},
        {"--eye", "1,2"},
        {"--eye", "1,2,3,4"},
        {"--eye", "1,2,inf"},
        {"--at", "x,y,z"},
        {"--up", "0,0,0"},
        {"--up", "1,2"},
        {"--fov", "0"},
        {"--fov", "180"},
        {"--near", "1e13"},
        {"--far", "-"},
        {"--ortho", "0"},
        {"--ortho", "-3"},
        {"--pitch", "0,1"},
        {"--pitch", "1"},
        {"--centre", "1e5,0"},
        {"--light", "0,0,0"},
        {"--light", "1"},
        {"--background", "12345"},
        {"--background", "12345g"},
        {"--background", "+12345"},
        {"--pick", "1"},
        {"--pick", "-1,0"},
        {"--pick", "240,0"},
        {"--pick", "0,320"},
        {"--pick", "1.5,2"},
        {"--far", "0"},
        {"--near", "100"},
        {"--near", "0"},
        {"--ortho", "1e-8"},
    };
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        char line[128];
        (void)snprintf(line, sizeof line, "render @/cube.obj %s %s", bad[i].option, bad[i].value);
        fails(line, bad[i].option, NULL);
        (void)snprintf(line, sizeof line, "render @/cube.obj %s=%s --hash", bad[i].option, bad[i].value);
        fails(line, bad[i].option, NULL);
    }
    fails("render @/cube.obj --eye 0,0,5 --at 0,0,5", "--eye", "--at");
    fails("render @/cube.obj --eye 0,5,0 --at 0,0,0", "--up", NULL);
    fails("render @/cube.obj --sparkle", "--sparkle", NULL);
    fails("render @/cube.obj -x", "-x", NULL);
    fails("mesh @/cube.obj -o @/x.tuile --max-faces 0", "--max-faces", NULL);
    fails("mesh @/cube.obj -o @/x.tuile --shrink", "--shrink", NULL);
}

static void an_option_without_its_value_is_refused(void **state) {
    static const char *const options[] = {"--panel",     "--rotate", "--clock", "--method", "--shade",  "--memory", "--tile",
                                          "--max-faces", "--frames", "--spin",  "--eye",    "--at",     "--up",     "--fov",
                                          "--near",      "--far",    "--ortho", "--pitch",  "--centre", "--light",  "--background",
                                          "--out",       "--sheet",  "--ids",   "--pick",   "--report"};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(options); i++) {
        char line[128];
        (void)snprintf(line, sizeof line, "render @/cube.obj %s", options[i]);
        fails(line, options[i], "value");
    }
    fails("mesh @/cube.obj -o", "-o", "value");
    fails("faces @/scene --tile", "--tile", "value");
}

static void a_value_for_an_option_that_takes_none_is_refused(void **state) {
    (void)state;
    fails("render @/cube.obj --hash=no", "--hash", NULL);
    fails("render --hash=no @/cube.obj", "--hash", NULL);
}

static void values_may_follow_an_equals_sign(void **state) {
    (void)state;
    char *a = good("render @/cube.obj --hash --rotate 90 --memory auto --eye 3,2,5 --background 102030");
    char *b = good("render @/cube.obj --hash --rotate=90 --memory=auto --eye=3,2,5 --background=102030");
    assert_string_equal(a, b);
    free(a);
    free(b);
}

static void a_near_plane_far_behind_the_camera_hides_nothing(void **state) {
    (void)state;
    char *a = good("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --near -100 --far 100 --hash");
    char *b = good("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --near -1000000 --far 100 --hash");
    assert_string_equal(a, b);
    free(a);
    free(b);
}

/* ---- models that cannot be drawn ------------------------------------------------------------------------------ */

static void models_that_cannot_be_drawn_are_refused_by_name(void **state) {
    static const struct {
        const char *name, *text;
    } bad[] = {
        {"empty.obj", ""},
        {"noface.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
        {"novertex.obj", "f 1 2 3\n"},
        {"outside.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"},
        {"zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"},
        {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"},
        {"infinite.obj", "v 0 0 0\nv 1e60 0 0\nv 0 1 0\nf 1 2 3\n"},
        {"repeated.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\n"},
        {"collinear.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"},
        {"onepoint.obj", "v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n"},
        {"truncated.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2"},
        {"garbage.obj", "\x01\x02\x03\xff\xfe nothing of the sort\n"},
        {"text.obj", "This is a letter and not a model.\n"},
        {"garbage.stl", "\x01\x02\x03\xff\xfe nothing of the sort\n"},
        {"garbage.glb", "glTF\x02"},
        {"unknown.xyzzy", "v 0 0 0\n"},
        {"noending", "v 0 0 0\n"},
        {"short.tuile", "TUIL"},
    };
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        char line[256];
        put(bad[i].name, bad[i].text);
        (void)snprintf(line, sizeof line, "render @/%s --out @/picture.png --ids @/ids --report @/report --sheet @/sheet.png",
                       bad[i].name);
        fails(line, bad[i].name, NULL);
        (void)snprintf(line, sizeof line, "mesh @/%s -o @/compiled.tuile", bad[i].name);
        fails(line, bad[i].name, NULL);
    }
    fails("render @/missing.obj", "missing.obj", NULL);
    fails("render @", folder, NULL);
    fails("mesh @/missing.obj -o @/x.c", "missing.obj", NULL);
}

static void damaged_compiled_models_are_refused(void **state) {
    size_t size;
    (void)state;
    good_silent("mesh @/cube.obj -o @/cube.tuile");
    char *bytes = command_read(path_of("cube.tuile"), &size);
    assert_non_null(bytes);
    for (size_t cut = 4; cut < size; cut += size / 7) {
        command_write(path_of("cut.tuile"), bytes, cut);
        fails("render @/cut.tuile", "cut.tuile", NULL);
    }
    for (size_t at = 4; at < size; at += size / 7) {
        bytes[at] ^= 1;
        command_write(path_of("flipped.tuile"), bytes, size);
        fails("render @/flipped.tuile", "flipped.tuile", NULL);
        bytes[at] ^= 1;
    }
    free(bytes);
    fails("render @/cube.tuile --max-faces 3", "cube.tuile", "6");
}

/* ---- outputs that cannot be written --------------------------------------------------------------------------- */

static void outputs_into_a_folder_that_is_not_there_are_refused_by_name(void **state) {
    (void)state;
    fails("render @/cube.obj --out @/none/picture.png", "none/picture.png", NULL);
    fails("render @/cube.obj --sheet @/none/sheet.png", "none/sheet.png", NULL);
    fails("render @/cube.obj --ids @/none/ids.txt", "none/ids.txt", NULL);
    fails("render @/cube.obj --report @/none/report.json", "none/report.json", NULL);
    fails("render @/cube.obj --report @/report.json --out @/none/picture.png", "none/picture.png", NULL);
    fails("render @/cube.obj --report @/report.json --ids @/none/ids.txt", "none/ids.txt", NULL);
    fails("render @/cube.obj --report @/report.json --pick 0,320", "--pick", NULL);
    fails("mesh @/cube.obj -o @/none/cube.tuile", "none/cube.tuile", NULL);
    fails("mesh @/cube.obj -o @/none/cube.c", "none/cube.c", NULL);
    fails("mesh @/cube.obj -o @/cube.txt", "cube.txt", ".tuile");
    fails("mesh @/cube.obj -o @/cube.c --name 9lives", "9lives", NULL);
    fails("render @/cube.obj --out @/picture.gif", "picture.gif", ".png");
    fails("render @/cube.obj --out @/picture", "picture", ".png");
    fails("render @/cube.obj --frames 2 --out @/picture.png", "--out", "%03d");
    fails("render @/cube.obj --frames 2 --ids @/ids.txt", "--ids", "%03d");
    fails("render @/cube.obj --out @/%s.png", "--out", NULL);
    fails("render @/cube.obj --out @/%d-%d.png", "--out", NULL);
    fails("render @/cube.obj --out @/%999d.png", "--out", NULL);
    fails("render @/cube.obj --out @/%n.png", "--out", NULL);
}

static void a_full_disk_is_an_error_of_every_output(void **state) {
    (void)state;
    if (access("/dev/full", W_OK) != 0) { skip(); }
    assert_int_equal(symlink("/dev/full", path_of("full.png")), 0);
    assert_int_equal(symlink("/dev/full", path_of("full.ppm")), 0);
    assert_int_equal(symlink("/dev/full", path_of("full.tuile")), 0);
    assert_int_equal(symlink("/dev/full", path_of("full.c")), 0);
    fails("render @/cube.obj --out @/full.png", "full.png", "space");
    fails("render @/cube.obj --out @/full.ppm", "full.ppm", "space");
    fails("render @/cube.obj --sheet @/full.png", "full.png", "space");
    fails("render @/cube.obj --ids /dev/full", "/dev/full", "space");
    fails("render @/cube.obj --report /dev/full", "/dev/full", "space");
    fails("render @/cube.obj --report @/r.json --out @/full.png", "full.png", "space");
    fails("mesh @/cube.obj -o @/full.tuile", "full.tuile", "space");
    fails("mesh @/cube.obj -o @/full.c", "full.c", "space");
    fails("render @/cube.obj --hash > /dev/full", "standard output", "space");
    fails("render @/cube.obj --pick 1,1 > /dev/full", "standard output", "space");
    fails("render --help > /dev/full", "standard output", "space");
    fails("--help > /dev/full", "standard output", "space");
    put("scene", "screen 400 400\ncamera ortho\n");
    fails("faces @/scene > /dev/full", "standard output", "space");
    put("polygons", "0 0 16 0 16 16\n");
    fails("coverage 4 4 < @/polygons > /dev/full", "standard output", "space");
    static const char *const links[] = {"full.png", "full.ppm", "full.tuile", "full.c"};
    for (unsigned i = 0; i < CHECK_COUNT(links); i++) {
        assert_int_equal(unlink(path_of(links[i])), 0);
    }
}

static void an_error_in_a_later_frame_is_one_line_too(void **state) {
    (void)state;
    if (access("/dev/full", W_OK) != 0) { skip(); }
    assert_int_equal(symlink("/dev/full", path_of("later-1.png")), 0);
    put("later-0.png", "there before");
    fails("render @/cube.obj --frames 3 --out @/later-%d.png --report @/r.json", "later-1.png", "space");
    fails("render @/cube.obj --frames 3 --sheet @/none/sheet.png --report @/r.json", "none/sheet.png", NULL);
    fails("render @/cube.obj --frames 3 --pick 500,0 --report @/r.json", "--pick", NULL);
    assert_false(exists("r.json"));
    assert_int_equal(unlink(path_of("later-1.png")), 0);
    assert_int_equal(unlink(path_of("later-0.png")), 0);
}

static void what_was_there_stays_when_writing_fails(void **state) {
    (void)state;
    put("keep.json", "old");
    put("keep.txt", "old");
    fails("render @/cube.obj --report @/keep.json --ids @/keep.txt --out @/none/x.png", "none/x.png", NULL);
    fails("render @/cube.obj --report @/keep.json --pick 999,0", "--pick", NULL);
    static const char *const names[] = {"keep.json", "keep.txt"};
    for (unsigned i = 0; i < 2; i++) {
        char *text = command_read(path_of(names[i]), NULL);
        assert_string_equal(text, "old");
        free(text);
        (void)unlink(path_of(names[i]));
    }
}

/* ---- memory --------------------------------------------------------------------------------------------------- */

static unsigned number_after(const char *text, const char *word) {
    const char *at = strstr(text, word);
    if (!at) { fail_msg("no '%s' in: %s", word, text); }
    return at ? (unsigned)strtoul(at + strlen(word), NULL, 10) : 0;
}

static void too_little_memory_says_how_much_would_do(void **state) {
    command_result_t result;
    char line[256];
    (void)state;
    fails("render @/torus.obj --memory 1000", "--memory", "at least");
    fails("render @/torus.obj --memory 0", "--memory", "at least");
    shell(&result, "% render @/torus.obj --tile 240x4 --memory 1000");
    const unsigned wanted = number_after(result.err, "at least ");
    command_free(&result);
    assert_in_range(wanted, 5000, 10000);
    (void)snprintf(line, sizeof line, "render @/torus.obj --tile 240x4 --hash --memory %u", wanted - 1);
    fails(line, "--memory", "at least");
    (void)snprintf(line, sizeof line, "render @/torus.obj --tile 240x4 --hash --memory %u", wanted);
    char *least = good(line), *plenty = good("render @/torus.obj --hash"),
         *some = good("render @/torus.obj --hash --memory 16K --tile 32x32");
    assert_string_equal(least, plenty);
    assert_string_equal(some, plenty);
    free(least);
    free(plenty);
    free(some);
}

/* ---- pictures and figures -------------------------------------------------------------------------------------- */

static void frames_are_named_by_their_pattern(void **state) {
    (void)state;
    good_silent(
        "render @/cube.obj --frames 3 --out @/frame-%03d.png --ids @/ids-%d.txt --sheet @/sheet.png --report @/report.json");
    static const char *const names[] = {"frame-000.png", "frame-001.png", "frame-002.png", "ids-0.txt",
                                        "ids-1.txt",     "ids-2.txt",     "sheet.png",     "report.json"};
    for (unsigned i = 0; i < CHECK_COUNT(names); i++) {
        if (!exists(names[i])) { fail_msg("%s", names[i]); }
    }
    assert_false(exists("frame-003.png"));
    sim_picture_t frames[2] = {{0}}, sheet = {0};
    assert_int_equal(sim_picture_read(&frames[0], path_of("frame-000.png"), NULL), 0);
    assert_int_equal(sim_picture_read(&frames[1], path_of("frame-001.png"), NULL), 0);
    assert_int_equal(sim_picture_read(&sheet, path_of("sheet.png"), NULL), 0);
    assert_int_equal(frames[0].width, 240);
    assert_int_equal(frames[0].height, 320);
    assert_true(memcmp(frames[0].rgb, frames[1].rgb, 240 * 320 * 3) != 0);
    assert_int_equal(sheet.width, 2 * 120 + 3 * 4);
    assert_int_equal(sheet.height, 2 * 160 + 3 * 4);
    sim_picture_free(&frames[0]);
    sim_picture_free(&frames[1]);
    sim_picture_free(&sheet);
    for (unsigned i = 0; i < CHECK_COUNT(names); i++) {
        (void)unlink(path_of(names[i]));
    }
}

static void ppm_and_png_show_the_same(void **state) {
    sim_picture_t png = {0}, ppm = {0};
    (void)state;
    good_silent("render @/room.obj --rotate 270 --out @/a.png");
    good_silent("render @/room.obj --rotate 270 --out @/a.ppm");
    size_t size;
    char *bytes = command_read(path_of("a.ppm"), &size);
    assert_int_equal(strncmp(bytes, "P6\n320 240\n255\n", 15), 0);
    assert_int_equal(size, 15 + 320 * 240 * 3);
    free(bytes);
    assert_int_equal(sim_picture_read(&png, path_of("a.png"), NULL), 0);
    assert_int_equal(sim_picture_read(&ppm, path_of("a.ppm"), NULL), 0);
    assert_int_equal(png.width, 320);
    assert_int_equal(png.height, 240);
    assert_memory_equal(png.rgb, ppm.rgb, 320 * 240 * 3);
    sim_picture_free(&png);
    sim_picture_free(&ppm);
    (void)unlink(path_of("a.png"));
    (void)unlink(path_of("a.ppm"));
}

static void the_background_is_the_colour_asked_for(void **state) {
    sim_picture_t picture = {0};
    (void)state;
    good_silent("render @/cube.obj --background FF0000 --out @/red.png");
    assert_int_equal(sim_picture_read(&picture, path_of("red.png"), NULL), 0);
    assert_memory_equal(sim_picture_at(&picture, 0, 0), ((const uint8_t[3]){255, 0, 0}), 3);
    assert_memory_equal(sim_picture_at(&picture, 239, 319), ((const uint8_t[3]){255, 0, 0}), 3);
    sim_picture_free(&picture);
    (void)unlink(path_of("red.png"));
}

static void the_hash_tells_pictures_apart_and_is_the_same_again(void **state) {
    static const char *const lines[] = {
        "render @/octahedron.obj --hash",
        "render @/octahedron.obj --hash --rotate 90",
        "render @/octahedron.obj --hash --rotate 180",
        "render @/octahedron.obj --hash --rotate 270",
        "render @/octahedron.obj --hash --background 010000",
        "render @/octahedron.obj --hash --background 800000",
        "render @/octahedron.obj --hash --fov 46",
        "render @/octahedron.obj --hash --light 0,-1,0",
    };
    char *out[CHECK_COUNT(lines)];
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(lines); i++) {
        out[i] = good(lines[i]);
        assert_int_equal(strncmp(out[i], "frame 0 ", 8), 0);
        assert_int_equal(strspn(out[i] + 8, "0123456789abcdef"), 16);
        assert_string_equal(out[i] + 24, "\n");
        answers(lines[i], out[i]);
        for (unsigned k = 0; k < i; k++) {
            const bool alike = i == 4 && k == 0; /* 1 of 255 is nothing in five bits */
            if ((strcmp(out[i], out[k]) == 0) != alike) { fail_msg("%s and %s", lines[i], lines[k]); }
        }
    }
    for (unsigned i = 0; i < CHECK_COUNT(lines); i++) {
        free(out[i]);
    }
}

static void a_turn_by_spin_is_a_turn_of_the_model(void **state) {
    (void)state;
    char *four = good("render @/octahedron.obj --frames 4 --hash"),
         *again = good("render @/octahedron.obj --frames 4 --spin 90 --hash");
    char *back = good("render @/octahedron.obj --frames 5 --spin 90 --hash");
    assert_string_equal(four, again);
    assert_int_equal(strncmp(back, four, strlen(four)), 0);
    assert_int_equal(strncmp(back + strlen(four) + 8, four + 8, 16), 0); /* frame 4 is frame 0 */
    free(four);
    free(again);
    free(back);
}

/* ---- ids and picking ------------------------------------------------------------------------------------------- */

/* 240 numbers a row, 320 rows. */
static uint32_t *read_ids(const char *name) {
    char *text = command_read(path_of(name), NULL), *at = text;
    uint32_t *ids = malloc(sizeof *ids * 240 * 320);
    assert_non_null(text);
    assert_non_null(ids);
    for (unsigned i = 0; i < 240 * 320; i++) {
        char *end;
        ids[i] = (uint32_t)strtoul(at, &end, 10);
        assert_true(end > at);
        assert_int_equal(*end, i % 240 == 239 ? '\n' : ' ');
        at = end + 1;
    }
    assert_int_equal(*at, '\0');
    free(text);
    (void)unlink(path_of(name));
    return ids;
}

/* 80 pixels a unit: the side towards the eye covers x 40 ... 199, y 80 ... 239. */
static void ids_of_a_cube_are_the_numbers_of_its_lines(void **state) {
    static const char *const sides[] = {
        "--eye 0,0,5", "--eye 0,0,-5", "--eye 5,0,0", "--eye -5,0,0", "--eye 0,5,0 --up 0,0,-1", "--eye 0,-5,0 --up 0,0,1",
    };
    (void)state;
    for (unsigned side = 0; side < 6; side++) {
        char line[256];
        (void)snprintf(line, sizeof line, "render @/cube.obj --ortho 4 --at 0,0,0 %s --ids @/ids", sides[side]);
        good_silent(line);
        uint32_t *ids = read_ids("ids");
        for (unsigned y = 0; y < 320; y++) {
            for (unsigned x = 0; x < 240; x++) {
                const bool inside = x >= 40 && x < 200 && y >= 80 && y < 240;
                if (ids[y * 240 + x] != (inside ? side + 1 : 0)) {
                    fail_msg("side %u: face %u at %u,%u", side, ids[y * 240 + x], x, y);
                }
            }
        }
        free(ids);
    }
}

static void ids_of_triangles_are_the_numbers_of_their_lines(void **state) {
    (void)state;
    put("halves.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                      "v -3 -3 -1\nv 3 -3 -1\nv 0 3 -1\n"
                      "f 1 2 3\nf 5 6 7\nf 1 3 4\nf 7 6 5\n"); /* the last one faces away */
    good_silent("render @/halves.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --ids @/ids");
    uint32_t *ids = read_ids("ids");
    for (unsigned y = 80; y < 240; y++) {
        for (unsigned x = 40; x < 200; x++) { /* the diagonal leads from (40, 240) to (200, 80) */
            const unsigned below = x - 40 + y - 80;
            if (below == 159) { continue; } /* centres on the diagonal */
            assert_int_equal(ids[y * 240 + x], below > 159 ? 1 : 3);
        }
    }
    assert_int_equal(ids[300 * 240 + 120], 2);
    assert_int_equal(ids[0], 0);
    free(ids);
}

static void picking_tells_face_and_place(void **state) {
    (void)state;
    answers("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --pick 120,160", "pick 120,160: face 1 at 0.00625,-0.00625,1\n");
    answers("render @/cube.obj --ortho 4 --eye 5,0,0 --at 0,0,0 --pick 40,80", "pick 40,80: face 3 at 1,0.99375,0.99375\n");
    answers("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --pick 39,160", "pick 39,160: background\n");
    /* A quarter turn about y brings -x to the front; the point is in the model's own units. */
    answers("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --frames 2 --spin 90 --pick 120,160",
            "pick 120,160: face 4 at -1,-0.00625,0.00625\n");
}

/* ---- the report ------------------------------------------------------------------------------------------------ */

/* JSON, as far as RFC 8259 goes but for the insides of strings. NULL where it is not. */
static const char *json_value(const char *at, int depth);

static const char *json_blank(const char *at) {
    while (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r') {
        at++;
    }
    return at;
}

static const char *json_string(const char *at) {
    if (*at++ != '"') { return NULL; }
    for (; *at && *at != '"'; at++) {
        if (*at == '\\' && *++at == '\0') { return NULL; }
        if ((unsigned char)*at < ' ') { return NULL; }
    }
    return *at == '"' ? at + 1 : NULL;
}

static const char *json_number(const char *at) {
    at += *at == '-';
    if (!isdigit((unsigned char)*at) || (*at == '0' && isdigit((unsigned char)at[1]))) { return NULL; }
    while (isdigit((unsigned char)*at)) {
        at++;
    }
    if (*at == '.') {
        if (!isdigit((unsigned char)*++at)) { return NULL; }
        while (isdigit((unsigned char)*at)) {
            at++;
        }
    }
    return at;
}

static const char *json_list(const char *at, char end, int depth) {
    at = json_blank(at + 1);
    if (*at == end) { return at + 1; }
    for (;; at = json_blank(at + 1)) {
        if (end == '}') {
            at = json_string(at);
            at = at ? json_blank(at) : NULL;
            if (!at || *at != ':') { return NULL; }
            at++;
        }
        at = json_value(json_blank(at), depth - 1);
        at = at ? json_blank(at) : NULL;
        if (!at) { return NULL; }
        if (*at == end) { return at + 1; }
        if (*at != ',') { return NULL; }
    }
}

static const char *json_value(const char *at, int depth) {
    static const char *const words[] = {"true", "false", "null"};
    if (depth == 0) { return NULL; }
    if (*at == '{') { return json_list(at, '}', depth); }
    if (*at == '[') { return json_list(at, ']', depth); }
    if (*at == '"') { return json_string(at); }
    for (unsigned i = 0; i < 3; i++) {
        if (strncmp(at, words[i], strlen(words[i])) == 0) { return at + strlen(words[i]); }
    }
    return json_number(at);
}

static void the_report_is_json_with_every_figure_of_every_frame(void **state) {
    static const char *const fields[] = {"frame",
                                         "hash",
                                         "width",
                                         "height",
                                         "tile_width",
                                         "tile_height",
                                         "faces",
                                         "clusters",
                                         "clusters_outside",
                                         "clusters_facing_away",
                                         "vertices",
                                         "faces_tested",
                                         "faces_back",
                                         "faces_degenerate",
                                         "faces_outside",
                                         "faces_clipped",
                                         "faces_clipped_away",
                                         "faces_binned",
                                         "faces_setup",
                                         "faces_resumed",
                                         "passes",
                                         "tiles",
                                         "tiles_immediate",
                                         "size_bytes",
                                         "least_bytes",
                                         "peak_bytes",
                                         "wire_bytes",
                                         "wire_ns",
                                         "fps_bus"};
    (void)state;
    char *out = good("render @/torus.obj --frames 3 --hash --tile 240x8 --memory 64K --report @/report.json");
    char *text = command_read(path_of("report.json"), NULL);
    assert_non_null(text);
    const char *end = json_value(json_blank(text), 8);
    if (!end || *json_blank(end) != '\0') { fail_msg("no JSON:\n%s", text); }
    const char *frame = text;
    for (unsigned k = 0; k < 3; k++) {
        char hash[64];
        frame = strstr(frame + 1, "{\"frame\"");
        assert_non_null(frame);
        const char *close = strchr(frame, '}');
        assert_non_null(close);
        for (unsigned i = 0; i < CHECK_COUNT(fields); i++) {
            char name[64];
            (void)snprintf(name, sizeof name, "\"%s\": ", fields[i]);
            const char *at = strstr(frame, name);
            if (!at || at > close) { fail_msg("frame %u has no %s", k, fields[i]); }
        }
        assert_int_equal(number_after(frame, "\"frame\": "), k);
        assert_int_equal(number_after(frame, "\"width\": "), 240);
        assert_int_equal(number_after(frame, "\"height\": "), 320);
        assert_int_equal(number_after(frame, "\"tile_height\": "), 8);
        assert_int_equal(number_after(frame, "\"faces\": "), 400);
        assert_int_equal(number_after(frame, "\"passes\": "), 1);
        assert_int_equal(number_after(frame, "\"tiles\": "), 40);
        assert_int_equal(number_after(frame, "\"size_bytes\": "), 65536);
        assert_int_equal(number_after(frame, "\"wire_bytes\": "), 153600 + 40 * 11);
        /* Bits at the clock, and no less. */
        assert_true(number_after(frame, "\"wire_ns\": ") > 1000000);
        const char *at = strstr(frame, "\"hash\": \"");
        (void)snprintf(hash, sizeof hash, "frame %u %.16s\n", k, at + 9);
        if (!strstr(out, hash)) { fail_msg("the report has '%s', printed was\n%s", hash, out); }
    }
    free(text);
    free(out);
    (void)unlink(path_of("report.json"));
}

static void a_faster_clock_shortens_the_time_on_the_wire(void **state) {
    (void)state;
    good_silent("render @/cube.obj --clock 10M --tile 240x320 --report @/slow.json");
    good_silent("render @/cube.obj --clock 5M --tile 240x320 --report @/slower.json");
    char *slow = command_read(path_of("slow.json"), NULL), *slower = command_read(path_of("slower.json"), NULL);
    /* 153 600 bytes of 8 bits at 100 and at 200 ns, but for the commands of one window. */
    assert_in_range(number_after(slow, "\"wire_ns\": "), 122880000, 122990000);
    assert_in_range(number_after(slower, "\"wire_ns\": "), 245760000, 245980000);
    free(slow);
    free(slower);
    (void)unlink(path_of("slow.json"));
    (void)unlink(path_of("slower.json"));
}

/* ---- mesh ------------------------------------------------------------------------------------------------------ */

static void c_and_tuile_files_hold_the_same_bytes(void **state) {
    command_result_t result;
    size_t size, dumped;
    (void)state;
    char *out = good("mesh @/torus.obj -o @/torus.tuile");
    assert_non_null(strstr(out, "faces 400"));
    free(out);
    good_silent("mesh @/torus.obj -o @/torus.c");
    good_silent("mesh @/torus.obj -o @/named.c --name the_torus");
    shell(&result, "cc -std=c11 -Wall -Wextra -Werror -c @/torus.c -o @/torus.o && cc -std=c99 -pedantic -Wall -Wextra -Werror -c "
                   "@/named.c -o @/named.o");
    if (result.code) { fail_msg("%s", result.err); }
    command_free(&result);
    put("dump.c", "#include <stdint.h>\n#include <stdio.h>\n#include <stdlib.h>\nextern const uint32_t the_torus[];\n"
                  "int main(int count, char **arguments) { return fwrite(the_torus, 1, (size_t)atol(arguments[count - 1]), stdout) "
                  "== 0; }\n");
    char *bytes = command_read(path_of("torus.tuile"), &size), line[256];
    (void)snprintf(line, sizeof line, "cc @/dump.c @/named.o -o @/dump && @/dump %zu > @/dumped", size);
    shell(&result, line);
    if (result.code) { fail_msg("%s", result.err); }
    command_free(&result);
    char *copy = command_read(path_of("dumped"), &dumped);
    assert_int_equal(dumped, size);
    assert_memory_equal(copy, bytes, size);
    char *text = command_read(path_of("torus.c"), NULL);
    assert_non_null(strstr(text, "const uint32_t torus"));
    free(text);
    free(copy);
    free(bytes);
}

static void a_model_and_its_compiled_form_are_drawn_alike(void **state) {
    static const char *const names[] = {"cube", "torus", "octahedron", "room"};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(names); i++) {
        char line[256];
        (void)snprintf(line, sizeof line, "mesh @/%s.obj -o @/%s.tuile", names[i], names[i]);
        good_silent(line);
        for (unsigned shade = 0; shade < 2; shade++) {
            (void)snprintf(line, sizeof line, "render @/%s.obj --hash --shade %s", names[i], shade ? "gouraud" : "flat");
            char *source = good(line);
            (void)snprintf(line, sizeof line, "render @/%s.tuile --hash --shade %s", names[i], shade ? "gouraud" : "flat");
            answers(line, source);
            free(source);
        }
    }
}

static void simplifying_keeps_to_the_number_of_faces(void **state) {
    (void)state;
    char *out = good("mesh @/torus.obj -o @/small.tuile --max-faces 150");
    assert_in_range(number_after(out, "faces "), 50, 150);
    free(out);
    good_silent("render @/torus.obj --max-faces 150 --report @/small.json");
    char *text = command_read(path_of("small.json"), NULL);
    assert_in_range(number_after(text, "\"faces\": "), 50, 150);
    free(text);
    out = good("mesh @/torus.obj -o @/all.tuile --max-faces 400");
    assert_int_equal(number_after(out, "faces "), 400);
    free(out);
    char *simple = good("render @/torus.obj --max-faces 150 --hash"), *compiled = good("render @/small.tuile --hash");
    assert_string_equal(simple, compiled);
    free(simple);
    free(compiled);
    (void)unlink(path_of("small.json"));
}

/* ---- README ---------------------------------------------------------------------------------------------------- */

/* Calls use with each block of README.md between ```kind and ```. */
static unsigned readme_blocks(const char *kind, void (*use)(char *block)) {
    char *text = command_read("README.md", NULL), *at = text, fence[16];
    unsigned count = 0;
    if (!text) { skip(); }
    (void)snprintf(fence, sizeof fence, "\n```%s\n", kind);
    while (at && (at = strstr(at, fence)) != NULL) {
        at += strlen(fence);
        char *end = strstr(at, "\n```");
        assert_non_null(end);
        char *block = strndup(at, (size_t)(end + 1 - at));
        assert_non_null(block);
        use(block);
        free(block);
        count++;
        at = end + 1;
        at = strchr(at, '\n');
    }
    free(text);
    return count;
}

static unsigned commands_run;

/* Lines with build/tuile in them, by the program under test. */
static void run_lines(char *block) {
    char *rest = block;
    for (char *line; (line = strsep(&rest, "\n")) != NULL;) {
        static const char usual[] = "build/tuile ";
        char full[2048] = "";
        command_result_t result;
        if (!strstr(line, usual)) { continue; }
        for (const char *at = line; *at;) {
            const size_t used = strlen(full);
            const bool here = strncmp(at, usual, sizeof usual - 1) == 0;
            (void)snprintf(full + used, sizeof full - used, here ? "%s " : "%.1s", here ? program() : at);
            at += here ? sizeof usual - 1 : 1;
        }
        command_shell(&result, full);
        if (result.code != 0) { fail_msg("%s\nexit code %d\n%s", line, result.code, result.err); }
        if (strstr(line, " coverage ") || strstr(line, " faces ") || strstr(line, " --hash")) { assert_true(result.out_bytes > 0); }
        command_free(&result);
        commands_run++;
    }
}

static void the_commands_of_the_readme_work(void **state) {
    (void)state;
    commands_run = 0;
    assert_true(readme_blocks("sh", run_lines) > 0);
    assert_true(commands_run > 0);
}

static void compile_block(char *block) {
    command_result_t result;
    put("readme.c", block);
    shell(&result, "cc -std=c11 -Wall -Wextra -Werror -I. -fsyntax-only @/readme.c");
    if (result.code != 0) { fail_msg("%s", result.err); }
    command_free(&result);
}

static void the_code_of_the_readme_compiles(void **state) {
    (void)state;
    assert_true(readme_blocks("c", compile_block) > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(help_goes_to_stdout_and_wrong_usage_to_stderr),
        cmocka_unit_test(help_of_render_names_every_option),
        cmocka_unit_test(coverage_of_polygons_known_by_hand),
        cmocka_unit_test(coverage_names_the_bad_line),
        cmocka_unit_test(faces_of_scenes_known_by_hand),
        cmocka_unit_test(faces_in_perspective_known_by_hand),
        cmocka_unit_test(a_bad_scene_names_the_line),
        cmocka_unit_test(faces_says_when_coordinates_are_rounded),
        cmocka_unit_test(two_scenes_at_once_are_refused),
        cmocka_unit_test(options_out_of_range_are_refused_by_name),
        cmocka_unit_test(an_option_without_its_value_is_refused),
        cmocka_unit_test(a_value_for_an_option_that_takes_none_is_refused),
        cmocka_unit_test(values_may_follow_an_equals_sign),
        cmocka_unit_test(a_near_plane_far_behind_the_camera_hides_nothing),
        cmocka_unit_test(models_that_cannot_be_drawn_are_refused_by_name),
        cmocka_unit_test(damaged_compiled_models_are_refused),
        cmocka_unit_test(outputs_into_a_folder_that_is_not_there_are_refused_by_name),
        cmocka_unit_test(a_full_disk_is_an_error_of_every_output),
        cmocka_unit_test(an_error_in_a_later_frame_is_one_line_too),
        cmocka_unit_test(what_was_there_stays_when_writing_fails),
        cmocka_unit_test(too_little_memory_says_how_much_would_do),
        cmocka_unit_test(frames_are_named_by_their_pattern),
        cmocka_unit_test(ppm_and_png_show_the_same),
        cmocka_unit_test(the_background_is_the_colour_asked_for),
        cmocka_unit_test(the_hash_tells_pictures_apart_and_is_the_same_again),
        cmocka_unit_test(a_turn_by_spin_is_a_turn_of_the_model),
        cmocka_unit_test(ids_of_a_cube_are_the_numbers_of_its_lines),
        cmocka_unit_test(ids_of_triangles_are_the_numbers_of_their_lines),
        cmocka_unit_test(picking_tells_face_and_place),
        cmocka_unit_test(the_report_is_json_with_every_figure_of_every_frame),
        cmocka_unit_test(a_faster_clock_shortens_the_time_on_the_wire),
        cmocka_unit_test(c_and_tuile_files_hold_the_same_bytes),
        cmocka_unit_test(a_model_and_its_compiled_form_are_drawn_alike),
        cmocka_unit_test(simplifying_keeps_to_the_number_of_faces),
        cmocka_unit_test(the_commands_of_the_readme_work),
        cmocka_unit_test(the_code_of_the_readme_compiles),
    };
    return cmocka_run_group_tests_name("cli", tests, set_up, tear_down);
}
