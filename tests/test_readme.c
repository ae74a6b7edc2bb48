/* What README.md and the pages for newcomers show works: their commands run, their code compiles. */
#include "support/check.h"
#include "support/cli.h"

/* Calls use with each block of a page between ```kind and ```. */
static unsigned page_blocks(const char *page, const char *kind, void (*use)(char *block)) {
    char *text = command_read(page, NULL), *at = text, fence[16];
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
            (void)snprintf(full + used, sizeof full - used, here ? "%s " : "%.1s", here ? cli_program() : at);
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
    assert_true(page_blocks("README.md", "sh", run_lines) > 0);
    assert_true(commands_run > 0);
}

static void the_commands_of_troubleshooting_work(void **state) {
    (void)state;
    commands_run = 0;
    assert_int_equal(page_blocks("docs/troubleshooting.md", "sh", run_lines), 2);
    assert_true(commands_run > 0);
}

static void the_commands_of_predict_work(void **state) {
    (void)state;
    commands_run = 0;
    assert_int_equal(page_blocks("docs/predict.md", "sh", run_lines), 1);
    assert_int_equal(commands_run, 3);
}

static void compile_block(char *block) {
    command_result_t result;
    cli_put("readme.c", block);
    cli_shell(&result, "cc -std=c11 -Wall -Wextra -Werror -I. -fsyntax-only @/readme.c");
    if (result.code != 0) { fail_msg("%s", result.err); }
    command_free(&result);
}

static void the_code_of_the_readme_compiles(void **state) {
    (void)state;
    assert_true(page_blocks("README.md", "c", compile_block) > 0);
}

static void the_code_of_porting_compiles(void **state) {
    (void)state;
    assert_int_equal(page_blocks("docs/porting.md", "c", compile_block), 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_commands_of_the_readme_work),      cmocka_unit_test(the_code_of_the_readme_compiles),
        cmocka_unit_test(the_commands_of_troubleshooting_work), cmocka_unit_test(the_commands_of_predict_work),
        cmocka_unit_test(the_code_of_porting_compiles),
    };
    return cmocka_run_group_tests_name("readme", tests, cli_set_up, cli_tear_down);
}
