/* tuile mesh: compiled models as files and as C, drawn as their sources are, and simplified. */
#include "support/check.h"
#include "support/cli.h"

#include <unistd.h>

static void c_and_tuile_files_hold_the_same_bytes(void **state) {
    command_result_t result;
    size_t size, dumped;
    (void)state;
    char *out = cli_good("mesh @/torus.obj -o @/torus.tuile");
    assert_non_null(strstr(out, "faces 400"));
    free(out);
    cli_good_silent("mesh @/torus.obj -o @/torus.c");
    cli_good_silent("mesh @/torus.obj -o @/named.c --name the_torus");
    cli_shell(&result,
              "cc -std=c11 -Wall -Wextra -Werror -c @/torus.c -o @/torus.o && cc -std=c99 -pedantic -Wall -Wextra -Werror -c "
              "@/named.c -o @/named.o");
    if (result.code) { fail_msg("%s", result.err); }
    command_free(&result);
    cli_put("dump.c",
            "#include <stdint.h>\n#include <stdio.h>\n#include <stdlib.h>\nextern const uint32_t the_torus[];\n"
            "int main(int count, char **arguments) { return fwrite(the_torus, 1, (size_t)atol(arguments[count - 1]), stdout) "
            "== 0; }\n");
    char *bytes = command_read(cli_path("torus.tuile"), &size), line[256];
    (void)snprintf(line, sizeof line, "cc @/dump.c @/named.o -o @/dump && @/dump %zu > @/dumped", size);
    cli_shell(&result, line);
    if (result.code) { fail_msg("%s", result.err); }
    command_free(&result);
    char *copy = command_read(cli_path("dumped"), &dumped);
    assert_int_equal(dumped, size);
    assert_memory_equal(copy, bytes, size);
    char *text = command_read(cli_path("torus.c"), NULL);
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
        cli_good_silent(line);
        for (unsigned shade = 0; shade < 2; shade++) {
            (void)snprintf(line, sizeof line, "render @/%s.obj --hash --shade %s", names[i], shade ? "gouraud" : "flat");
            char *source = cli_good(line);
            (void)snprintf(line, sizeof line, "render @/%s.tuile --hash --shade %s", names[i], shade ? "gouraud" : "flat");
            cli_answers(line, source);
            free(source);
        }
    }
}

static void simplifying_keeps_to_the_number_of_faces(void **state) {
    (void)state;
    char *out = cli_good("mesh @/torus.obj -o @/small.tuile --max-faces 150");
    assert_in_range(cli_number_after(out, "faces "), 50, 150);
    free(out);
    cli_good_silent("render @/torus.obj --max-faces 150 --report @/small.json");
    char *text = command_read(cli_path("small.json"), NULL);
    assert_in_range(cli_number_after(text, "\"faces\": "), 50, 150);
    free(text);
    out = cli_good("mesh @/torus.obj -o @/all.tuile --max-faces 400");
    assert_int_equal(cli_number_after(out, "faces "), 400);
    free(out);
    char *simple = cli_good("render @/torus.obj --max-faces 150 --hash"), *compiled = cli_good("render @/small.tuile --hash");
    assert_string_equal(simple, compiled);
    free(simple);
    free(compiled);
    (void)unlink(cli_path("small.json"));
}

/* The room: the walls, the floor and the box on it. Five nodes of type 1 at most (hull, then what is inside), by hand: the six
 * walls are the hull; of the box, all but its bottom, which lies on the floor and so is on the hull as well. */
static void a_display_tree_is_made_and_reported(void **state) {
    (void)state;
    char *out = cli_good("mesh @/room.obj -o @/tree.tuile --tree");
    const char *line = strstr(out, "\ntree: faces 12 -> ");
    assert_non_null(line);
    unsigned faces, splits, convex, planes, complexity, depth, size;
    assert_int_equal(sscanf(line, "\ntree: faces 12 -> %u, splits %u, type-1 %u, type-2 %u, complexity %u, depth %u, bytes %u\n",
                            &faces, &splits, &convex, &planes, &complexity, &depth, &size),
                     7);
    assert_int_equal(faces, 12);
    assert_int_equal(splits, 0);
    assert_int_equal(convex, 2);
    assert_int_equal(planes, 0);
    assert_int_equal(complexity, 0);
    assert_int_equal(depth, 2);
    assert_int_equal(size, 2 * 4 * 4);
    free(out);
    size_t bytes, copied; /* it goes through unchanged, and is told from one without a tree */
    char *with = command_read(cli_path("tree.tuile"), &bytes);
    cli_good_silent("mesh @/tree.tuile -o @/copy.tuile --tree");
    char *copy = command_read(cli_path("copy.tuile"), &copied);
    assert_int_equal(copied, bytes);
    assert_memory_equal(copy, with, bytes);
    free(with);
    free(copy);
    cli_good_silent("mesh @/room.obj -o @/plain.tuile");
    cli_fails("mesh @/plain.tuile -o @/no.tuile --tree", "plain.tuile", "display tree");
    out = cli_good("mesh @/torus.obj -o @/few.tuile --max-faces 150 --tree"); /* counted before they are cut */
    assert_in_range(cli_number_after(out, "tree: faces "), 50, 150);
    free(out);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(c_and_tuile_files_hold_the_same_bytes),
        cmocka_unit_test(a_model_and_its_compiled_form_are_drawn_alike),
        cmocka_unit_test(simplifying_keeps_to_the_number_of_faces),
        cmocka_unit_test(a_display_tree_is_made_and_reported),
    };
    return cmocka_run_group_tests_name("cli_mesh", tests, cli_set_up, cli_tear_down);
}
