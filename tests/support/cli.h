/* The program as a user meets it: runs the binary that TUILE names, on models in a folder of its own. */
#ifndef TESTS_SUPPORT_CLI_H
#define TESTS_SUPPORT_CLI_H

#include <stdbool.h>

#include "command.h"

/* Before and after a group of tests: a folder with cube.obj, torus.obj, octahedron.obj and room.obj in it. */
int cli_set_up(void **state);
int cli_tear_down(void **state);

/* The program under test. */
const char *cli_program(void);

const char *cli_folder(void);

/* A file of the folder; it stays valid over one more call. */
const char *cli_path(const char *name);
bool cli_exists(const char *name);
void cli_put(const char *name, const char *text);

/* A line for the shell: @ stands for the folder, % at its beginning for the program. */
void cli_shell(command_result_t *result, const char *line);

/* Arguments of the program. It must succeed; stdout is to be released with free. */
char *cli_good(const char *arguments);
void cli_good_silent(const char *arguments);

/* The same, for an exact answer. */
void cli_answers(const char *arguments, const char *expected);

/* It must fail with one line that has both words in it, and leave the folder as it was. */
void cli_fails(const char *arguments, const char *word, const char *other_word);

/* The number behind the first place of the word; fails the test when it is not there. */
unsigned cli_number_after(const char *text, const char *word);

#endif
