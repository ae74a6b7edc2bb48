/* How the program is used and how it refuses: help, options, models that cannot be drawn, outputs that cannot be written. */
#include "support/check.h"
#include "support/cli.h"

#include <unistd.h>

/* ---- usage -------------------------------------------------------------------------------------------------- */

static void help_goes_to_stdout_and_wrong_usage_to_stderr(void **state) {
    static const char *const commands[] = {"render", "mesh", "font", "faces", "coverage"};
    static const char *const spellings[] = {"--help", "-h", "help"};
    command_result_t result;
    (void)state;
    for (unsigned i = 0; i < 3; i++) {
        char *out = cli_good(spellings[i]);
        assert_int_equal(strncmp(out, "Usage: tuile COMMAND", 20), 0);
        for (unsigned c = 0; c < CHECK_COUNT(commands); c++) {
            assert_non_null(strstr(out, commands[c]));
        }
        free(out);
    }
    cli_shell(&result, "%");
    assert_int_equal(result.code, 2);
    assert_string_equal(result.out, "");
    assert_int_equal(strncmp(result.err, "Usage: tuile", 12), 0);
    command_free(&result);
    for (unsigned c = 0; c < CHECK_COUNT(commands); c++) {
        char line[64], begin[64];
        (void)snprintf(line, sizeof line, "%s --help", commands[c]);
        (void)snprintf(begin, sizeof begin, "Usage: tuile %s ", commands[c]);
        char *out = cli_good(line);
        assert_int_equal(strncmp(out, begin, strlen(begin)), 0);
        free(out);
        (void)snprintf(line, sizeof line, "%% %s", commands[c]);
        cli_shell(&result, line);
        assert_int_equal(result.code, 2);
        assert_string_equal(result.out, "");
        assert_int_equal(strncmp(result.err, begin, strlen(begin)), 0);
        command_free(&result);
    }
    cli_fails("paint", "paint", "--help");
}

static void help_of_render_names_every_option(void **state) {
    static const char *const options[] = {"--panel",     "--rotate", "--clock", "--method", "--shade",  "--memory", "--tile",
                                          "--max-faces", "--frames", "--spin",  "--eye",    "--at",     "--up",     "--fov",
                                          "--near",      "--far",    "--ortho", "--pitch",  "--centre", "--light",  "--background",
                                          "--out",       "--sheet",  "--ids",   "--pick",   "--hash",   "--report"};
    char *out = cli_good("render --help");
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(options); i++) {
        if (!strstr(out, options[i])) { fail_msg("%s", options[i]); }
    }
    free(out);
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
        {"--clock", "M"},
        {"--clock", "2000M"},
        {"--clock", "-1"},
        {"--method", "raytrace"},
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
        cli_fails(line, bad[i].option, NULL);
        (void)snprintf(line, sizeof line, "render @/cube.obj %s=%s --hash", bad[i].option, bad[i].value);
        cli_fails(line, bad[i].option, NULL);
    }
    cli_fails("render @/cube.obj --eye 0,0,5 --at 0,0,5", "--eye", "--at");
    cli_fails("render @/cube.obj --eye 0,5,0 --at 0,0,0", "--up", NULL);
    cli_fails("render @/cube.obj --sparkle", "--sparkle", NULL);
    cli_fails("render @/cube.obj -x", "-x", NULL);
    cli_fails("mesh @/cube.obj -o @/x.tuile --max-faces 0", "--max-faces", NULL);
    cli_fails("mesh @/cube.obj -o @/x.tuile --shrink", "--shrink", NULL);
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
        cli_fails(line, options[i], "value");
    }
    cli_fails("mesh @/cube.obj -o", "-o", "value");
    cli_fails("faces @/scene --tile", "--tile", "value");
}

static void a_value_for_an_option_that_takes_none_is_refused(void **state) {
    (void)state;
    cli_fails("render @/cube.obj --hash=no", "--hash", NULL);
    cli_fails("render --hash=no @/cube.obj", "--hash", NULL);
}

static void values_may_follow_an_equals_sign(void **state) {
    (void)state;
    char *a = cli_good("render @/cube.obj --hash --rotate 90 --memory auto --eye 3,2,5 --background 102030");
    char *b = cli_good("render @/cube.obj --hash --rotate=90 --memory=auto --eye=3,2,5 --background=102030");
    assert_string_equal(a, b);
    free(a);
    free(b);
}

static void a_near_plane_far_behind_the_camera_hides_nothing(void **state) {
    (void)state;
    char *a = cli_good("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --near -100 --far 100 --hash");
    char *b = cli_good("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --near -1000000 --far 100 --hash");
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
        cli_put(bad[i].name, bad[i].text);
        (void)snprintf(line, sizeof line, "render @/%s --out @/picture.png --ids @/ids --report @/report --sheet @/sheet.png",
                       bad[i].name);
        cli_fails(line, bad[i].name, NULL);
        (void)snprintf(line, sizeof line, "mesh @/%s -o @/compiled.tuile", bad[i].name);
        cli_fails(line, bad[i].name, NULL);
    }
    cli_fails("render @/missing.obj", "missing.obj", NULL);
    cli_fails("render @", cli_folder(), NULL);
    cli_fails("mesh @/missing.obj -o @/x.c", "missing.obj", NULL);
}

static void damaged_compiled_models_are_refused(void **state) {
    size_t size;
    (void)state;
    cli_good_silent("mesh @/cube.obj -o @/cube.tuile");
    char *bytes = command_read(cli_path("cube.tuile"), &size);
    assert_non_null(bytes);
    for (size_t cut = 4; cut < size; cut += size / 7) {
        command_write(cli_path("cut.tuile"), bytes, cut);
        cli_fails("render @/cut.tuile", "cut.tuile", NULL);
    }
    for (size_t at = 4; at < size; at += size / 7) {
        bytes[at] ^= 1;
        command_write(cli_path("flipped.tuile"), bytes, size);
        cli_fails("render @/flipped.tuile", "flipped.tuile", NULL);
        bytes[at] ^= 1;
    }
    free(bytes);
    cli_fails("render @/cube.tuile --max-faces 3", "cube.tuile", "6");
}

/* ---- outputs that cannot be written --------------------------------------------------------------------------- */

static void outputs_into_a_folder_that_is_not_there_are_refused_by_name(void **state) {
    (void)state;
    cli_fails("render @/cube.obj --out @/none/picture.png", "none/picture.png", NULL);
    cli_fails("render @/cube.obj --sheet @/none/sheet.png", "none/sheet.png", NULL);
    cli_fails("render @/cube.obj --ids @/none/ids.txt", "none/ids.txt", NULL);
    cli_fails("render @/cube.obj --report @/none/report.json", "none/report.json", NULL);
    cli_fails("render @/cube.obj --report @/report.json --out @/none/picture.png", "none/picture.png", NULL);
    cli_fails("render @/cube.obj --report @/report.json --ids @/none/ids.txt", "none/ids.txt", NULL);
    cli_fails("render @/cube.obj --report @/report.json --pick 0,320", "--pick", NULL);
    cli_fails("mesh @/cube.obj -o @/none/cube.tuile", "none/cube.tuile", NULL);
    cli_fails("mesh @/cube.obj -o @/none/cube.c", "none/cube.c", NULL);
    cli_fails("mesh @/cube.obj -o @/cube.txt", "cube.txt", ".tuile");
    cli_fails("mesh @/cube.obj -o @/cube.c --name 9lives", "9lives", NULL);
    cli_fails("render @/cube.obj --out @/picture.gif", "picture.gif", ".png");
    cli_fails("render @/cube.obj --out @/picture", "picture", ".png");
    cli_fails("render @/cube.obj --frames 2 --out @/picture.png", "--out", "%03d");
    cli_fails("render @/cube.obj --frames 2 --ids @/ids.txt", "--ids", "%03d");
    cli_fails("render @/cube.obj --out @/%s.png", "--out", NULL);
    cli_fails("render @/cube.obj --out @/%d-%d.png", "--out", NULL);
    cli_fails("render @/cube.obj --out @/%999d.png", "--out", NULL);
    cli_fails("render @/cube.obj --out @/%n.png", "--out", NULL);
}

static void a_full_disk_is_an_error_of_every_output(void **state) {
    (void)state;
    if (access("/dev/full", W_OK) != 0) { skip(); }
    assert_int_equal(symlink("/dev/full", cli_path("full.png")), 0);
    assert_int_equal(symlink("/dev/full", cli_path("full.ppm")), 0);
    assert_int_equal(symlink("/dev/full", cli_path("full.tuile")), 0);
    assert_int_equal(symlink("/dev/full", cli_path("full.c")), 0);
    cli_fails("render @/cube.obj --out @/full.png", "full.png", "space");
    cli_fails("render @/cube.obj --out @/full.ppm", "full.ppm", "space");
    cli_fails("render @/cube.obj --sheet @/full.png", "full.png", "space");
    cli_fails("render @/cube.obj --ids /dev/full", "/dev/full", "space");
    cli_fails("render @/cube.obj --report /dev/full", "/dev/full", "space");
    cli_fails("render @/cube.obj --report @/r.json --out @/full.png", "full.png", "space");
    cli_fails("mesh @/cube.obj -o @/full.tuile", "full.tuile", "space");
    cli_fails("mesh @/cube.obj -o @/full.c", "full.c", "space");
    cli_fails("render @/cube.obj --hash > /dev/full", "standard output", "space");
    cli_fails("render @/cube.obj --pick 1,1 > /dev/full", "standard output", "space");
    cli_fails("render --help > /dev/full", "standard output", "space");
    cli_fails("--help > /dev/full", "standard output", "space");
    cli_put("scene", "screen 400 400\ncamera ortho\n");
    cli_fails("faces @/scene > /dev/full", "standard output", "space");
    cli_put("polygons", "0 0 16 0 16 16\n");
    cli_fails("coverage 4 4 < @/polygons > /dev/full", "standard output", "space");
    static const char *const links[] = {"full.png", "full.ppm", "full.tuile", "full.c"};
    for (unsigned i = 0; i < CHECK_COUNT(links); i++) {
        assert_int_equal(unlink(cli_path(links[i])), 0);
    }
}

static void an_error_in_a_later_frame_is_one_line_too(void **state) {
    (void)state;
    if (access("/dev/full", W_OK) != 0) { skip(); }
    assert_int_equal(symlink("/dev/full", cli_path("later-1.png")), 0);
    cli_put("later-0.png", "there before");
    cli_fails("render @/cube.obj --frames 3 --out @/later-%d.png --report @/r.json", "later-1.png", "space");
    cli_fails("render @/cube.obj --frames 3 --sheet @/none/sheet.png --report @/r.json", "none/sheet.png", NULL);
    cli_fails("render @/cube.obj --frames 3 --pick 500,0 --report @/r.json", "--pick", NULL);
    assert_false(cli_exists("r.json"));
    assert_int_equal(unlink(cli_path("later-1.png")), 0);
    assert_int_equal(unlink(cli_path("later-0.png")), 0);
}

static void what_was_there_stays_when_writing_fails(void **state) {
    (void)state;
    cli_put("keep.json", "old");
    cli_put("keep.txt", "old");
    cli_fails("render @/cube.obj --report @/keep.json --ids @/keep.txt --out @/none/x.png", "none/x.png", NULL);
    cli_fails("render @/cube.obj --report @/keep.json --pick 999,0", "--pick", NULL);
    static const char *const names[] = {"keep.json", "keep.txt"};
    for (unsigned i = 0; i < 2; i++) {
        char *text = command_read(cli_path(names[i]), NULL);
        assert_string_equal(text, "old");
        free(text);
        (void)unlink(cli_path(names[i]));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(help_goes_to_stdout_and_wrong_usage_to_stderr),
        cmocka_unit_test(help_of_render_names_every_option),
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
    };
    return cmocka_run_group_tests_name("cli_usage", tests, cli_set_up, cli_tear_down);
}
