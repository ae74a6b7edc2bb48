#include "cli.h"

#include "check.h"
#include "models.h"

#include <unistd.h>

static char *folder;

const char *cli_program(void) {
    const char *path = getenv("TUILE");
    return path && *path ? path : "build/tuile";
}

const char *cli_folder(void) { return folder; }

const char *cli_path(const char *name) {
    static char path[2][512];
    static unsigned turn;
    turn ^= 1;
    (void)snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

void cli_put(const char *name, const char *text) { command_write(cli_path(name), text, strlen(text)); }

void cli_shell(command_result_t *result, const char *line) {
    char full[4096];
    size_t used = 0;
    for (const char *at = line; *at; at++) {
        const char *text = *at == '@' ? folder : *at == '%' && at == line ? cli_program() : NULL;
        const char one[2] = {*at, '\0'};
        used += (size_t)snprintf(full + used, sizeof full - used, "%s", text ? text : one);
        assert_true(used < sizeof full);
    }
    command_shell(result, full);
}

char *cli_good(const char *arguments) {
    char line[2048];
    command_result_t result;
    (void)snprintf(line, sizeof line, "%% %s", arguments);
    cli_shell(&result, line);
    if (result.code != 0) { fail_msg("tuile %s: exit code %d\n%s", arguments, result.code, result.err); }
    char *out = strdup(result.out);
    command_free(&result);
    return out;
}

void cli_good_silent(const char *arguments) { free(cli_good(arguments)); }

void cli_answers(const char *arguments, const char *expected) {
    char *out = cli_good(arguments);
    if (strcmp(out, expected) != 0) { fail_msg("tuile %s\n--- printed\n%s--- expected\n%s", arguments, out, expected); }
    free(out);
}

void cli_fails(const char *arguments, const char *word, const char *other_word) {
    char line[2048], *before = command_list(folder), *after;
    command_result_t result;
    (void)snprintf(line, sizeof line, "%% %s", arguments);
    cli_shell(&result, line);
    if (!command_failed_well(&result, word, other_word)) { fail_msg("tuile %s", arguments); }
    after = command_list(folder);
    if (strcmp(before, after) != 0) { fail_msg("tuile %s\n--- before\n%s--- left behind\n%s", arguments, before, after); }
    free(before);
    free(after);
    command_free(&result);
}

bool cli_exists(const char *name) { return access(cli_path(name), F_OK) == 0; }

int cli_set_up(void **state) {
    mesh_t mesh;
    (void)state;
    folder = command_folder();
    model_cube(&mesh);
    model_write_obj(&mesh, cli_path("cube.obj"));
    mesh_free(&mesh);
    model_torus(&mesh, 20, 10, true);
    model_write_obj(&mesh, cli_path("torus.obj"));
    mesh_free(&mesh);
    model_octahedron(&mesh);
    model_write_obj(&mesh, cli_path("octahedron.obj"));
    mesh_free(&mesh);
    model_room(&mesh);
    model_write_obj(&mesh, cli_path("room.obj"));
    mesh_free(&mesh);
    return 0;
}

int cli_tear_down(void **state) {
    (void)state;
    command_remove(folder);
    return 0;
}

unsigned cli_number_after(const char *text, const char *word) {
    const char *at = strstr(text, word);
    if (!at) { fail_msg("no '%s' in: %s", word, text); }
    return at ? (unsigned)strtoul(at + strlen(word), NULL, 10) : 0;
}
