/* The hidden-surface methods as a user meets them: render, mesh and faces. */
#include "support/check.h"
#include "support/cli.h"

#include <unistd.h>

static const char *const methods[] = {"zbuffer", "scanline", "warnock", "painter", "tree"};

static void an_octahedron_is_drawn_alike_by_all(void **state) {
    (void)state;
    /* Convex and seen from one side: no two faces are near another in depth, so that the pictures are the same. */
    char *expected = cli_good("render @/octahedron.obj --frames 3 --hash");
    for (unsigned m = 0; m < CHECK_COUNT(methods); m++) {
        char line[256];
        (void)snprintf(line, sizeof line, "render @/octahedron.obj --frames 3 --hash --method %s", methods[m]);
        cli_answers(line, expected);
    }
    free(expected);
}

static void a_tree_is_compiled_on_the_fly_or_must_be_in_the_file(void **state) {
    (void)state;
    cli_good_silent("mesh @/torus.obj -o @/plain.tuile");
    cli_good_silent("mesh @/torus.obj -o @/tree.tuile --tree");
    char *source = cli_good("render @/torus.obj --method tree --hash");
    cli_answers("render @/tree.tuile --method tree --hash", source);
    free(source);
    cli_fails("render @/plain.tuile --method tree --hash", "plain.tuile", "--tree");
    cli_fails("render @/plain.tuile --method tree --hash", "tuile mesh", "--tree");
    cli_good_silent("render @/plain.tuile --method painter --hash"); /* no other needs one */
    (void)unlink(cli_path("plain.tuile"));
    (void)unlink(cli_path("tree.tuile"));
}

static void a_method_that_there_is_not_is_refused(void **state) {
    (void)state;
    cli_fails("render @/cube.obj --method bsp", "--method", "bsp");
    cli_fails("faces --method bsp tests/models/crossing.txt", "--method", "bsp");
}

/* tests/models/crossing.txt: rectangles over columns 2 ... 21, the first over rows 2 ... 7, the second over rows 4 ... 9; where
 * they overlap the first is in front as far as column 11, then the second. */
static void crossing_rectangles_are_printed_alike_by_all(void **state) {
    char expected[24 * 12 * 2 + 1], *at = expected;
    (void)state;
    for (unsigned y = 0; y < 12; y++) {
        for (unsigned x = 0; x < 24; x++) {
            const bool across = x >= 2 && x < 22, first = across && y >= 2 && y < 8, second = across && y >= 4 && y < 10;
            *at++ = first && (!second || x < 12) ? '1' : second ? '2' : '0';
            *at++ = x == 23 ? '\n' : ' ';
        }
    }
    *at = '\0';
    for (unsigned m = 0; m < CHECK_COUNT(methods); m++) {
        static const char *const more[] = {"", " --tile 5x3", " --tile 24x1"};
        for (unsigned i = 0; i < CHECK_COUNT(more); i++) {
            char line[256];
            (void)snprintf(line, sizeof line, "faces --method %s%s tests/models/crossing.txt", methods[m], more[i]);
            cli_answers(line, expected);
        }
    }
}

/* A block that is large enough to be laid out, and too small for what the method keeps of a tile's faces. */
static void too_little_memory_for_a_scene_names_a_size_that_works(void **state) {
    static const char *const options[] = {"--method scanline --tile 240x64", "--method warnock --tile 240x64",
                                          "--method painter --tile 240x320"};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(options); i++) {
        command_result_t result;
        char line[256];
        unsigned wanted = 1000, tries = 0, by_scene = 0;
        for (;; tries++) {
            (void)snprintf(line, sizeof line, "%% render @/torus.obj --frames 2 --hash %s --memory %u", options[i], wanted);
            cli_shell(&result, line);
            if (result.code == 0) { break; }
            const bool laid_out = strstr(result.err, "frame 0") != NULL; /* it was the scene that did not fit */
            if (!command_failed_well(&result, "--memory", laid_out ? "would do" : "at least")) { fail_msg("%s", line); }
            const unsigned more = cli_number_after(result.err, laid_out ? "too few for this method; " : "at least ");
            assert_true(more > wanted && tries < 10);
            by_scene += laid_out;
            wanted = more;
            command_free(&result);
        }
        assert_true(by_scene > 0);
        (void)snprintf(line, sizeof line, "render @/torus.obj --frames 2 --hash %s", options[i]);
        cli_answers(line, result.out);
        command_free(&result);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_octahedron_is_drawn_alike_by_all),
        cmocka_unit_test(a_tree_is_compiled_on_the_fly_or_must_be_in_the_file),
        cmocka_unit_test(a_method_that_there_is_not_is_refused),
        cmocka_unit_test(crossing_rectangles_are_printed_alike_by_all),
        cmocka_unit_test(too_little_memory_for_a_scene_names_a_size_that_works),
    };
    return cmocka_run_group_tests_name("cli_methods", tests, cli_set_up, cli_tear_down);
}
