/* docs/gallery.md: each of its commands runs, and draws the picture that is shown below it. */
#include "support/check.h"
#include "support/cli.h"

#include "../sim/picture.h"

#define GALLERY "docs/gallery.md"
#define PICTURES "docs/pictures/gallery/"

/* Text with every `from` in it as `to`; to be released with free. */
static char *replaced(const char *text, const char *from, const char *to) {
    size_t size = strlen(text) + 1;
    for (const char *at = text; (at = strstr(at, from)) != NULL; at += strlen(from)) {
        size += strlen(to);
    }
    char *out = calloc(1, size), *end = out;
    assert_non_null(out);
    while (*text) {
        const bool here = strncmp(text, from, strlen(from)) == 0;
        const char *piece = here ? to : text;
        const size_t length = here ? strlen(to) : 1;
        memcpy(end, piece, length);
        end += length;
        text += here ? strlen(from) : 1;
    }
    return out;
}

/* All blocks between ```sh and ``` as one script. */
static char *script_of(const char *text) {
    static const char fence[] = "\n```sh\n";
    char *script = calloc(1, strlen(text) + 1);
    assert_non_null(script);
    while ((text = strstr(text, fence)) != NULL) {
        text += sizeof fence - 1;
        const char *end = strstr(text, "\n```");
        assert_non_null(end);
        (void)strncat(script, text, (size_t)(end + 1 - text));
        text = end;
    }
    return script;
}

/* The gallery's commands, with pictures into a folder of the test's own. */
static void draw_all(const char *gallery) {
    char folder[512], program[512];
    command_result_t result;
    const char *bunny = getenv("BUNNY_6000");
    assert_non_null(bunny);
    assert_int_equal(setenv("BUNNY", bunny, 1), 0);
    (void)snprintf(folder, sizeof folder, "%s/", cli_folder());
    (void)snprintf(program, sizeof program, "%s ", cli_program());
    char *script = script_of(gallery), *here = replaced(script, PICTURES, folder), *ours = replaced(here, "build/tuile ", program);
    assert_true(strstr(ours, program) != NULL);
    char *careful = calloc(1, strlen(ours) + 8);
    assert_non_null(careful);
    (void)strcat(strcat(careful, "set -e\n"), ours);
    command_shell(&result, careful);
    if (result.code != 0) { fail_msg("exit code %d\n%s", result.code, result.err); }
    command_free(&result);
    free(careful);
    free(ours);
    free(here);
    free(script);
}

static bool is_same(const char *name) {
    char path[512];
    sim_picture_t drawn = {0}, kept = {0};
    sim_error_t error = {""};
    (void)snprintf(path, sizeof path, PICTURES "%s", name);
    if (sim_picture_read(&kept, path, &error) != 0) {
        print_message("%s\n", error.text);
        return false;
    }
    if (sim_picture_read(&drawn, cli_path(name), &error) != 0) { fail_msg("%s", error.text); }
    const bool same = drawn.width == kept.width && drawn.height == kept.height &&
                      memcmp(drawn.rgb, kept.rgb, (size_t)3 * kept.width * kept.height) == 0;
    if (!same) { print_message("%s is drawn otherwise now; if that is meant, `make gallery` and look at it\n", name); }
    sim_picture_free(&drawn);
    sim_picture_free(&kept);
    return same;
}

static void every_command_draws_its_picture(void **state) {
    char *gallery = command_read(GALLERY, NULL);
    unsigned count = 0, wrong = 0;
    (void)state;
    assert_non_null(gallery);
    draw_all(gallery);
    char *names = command_list(cli_folder()), *rest = names;
    for (char *name; (name = strsep(&rest, "\n")) != NULL;) {
        char shown[256];
        if (strlen(name) < 5 || strcmp(name + strlen(name) - 4, ".png") != 0) { continue; }
        (void)snprintf(shown, sizeof shown, "](pictures/gallery/%s)", name);
        if (!strstr(gallery, shown)) { fail_msg("%s is drawn and not shown", name); }
        wrong += !is_same(name);
        count++;
    }
    free(names);
    free(gallery);
    assert_true(count > 0);
    if (wrong) { fail_msg("%u of %u pictures differ from those in " PICTURES, wrong, count); }
}

static void no_picture_is_left_over(void **state) {
    char *gallery = command_read(GALLERY, NULL), *names = command_list(PICTURES), *rest = names;
    (void)state;
    assert_non_null(gallery);
    for (char *name; (name = strsep(&rest, "\n")) != NULL;) {
        char command[256];
        (void)snprintf(command, sizeof command, "--out " PICTURES "%s\n", name);
        if (*name && !strstr(gallery, command)) { fail_msg(PICTURES "%s: no command draws it", name); }
    }
    free(names);
    free(gallery);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_command_draws_its_picture),
        cmocka_unit_test(no_picture_is_left_over),
    };
    return cmocka_run_group_tests_name("gallery", tests, cli_set_up, cli_tear_down);
}
