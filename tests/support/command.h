/* Programs run as a user would run them: what they print on either stream, and how they end. */
#ifndef TESTS_SUPPORT_COMMAND_H
#define TESTS_SUPPORT_COMMAND_H

#include <stdbool.h>
#include <stddef.h>

typedef struct command_result {
    int code;        /* of exit; 256 + the signal that killed it */
    char *out, *err; /* zero-terminated */
    size_t out_bytes, err_bytes;
} command_result_t;

/* Runs the program named by arguments[0] (a path, or found on PATH) until it ends. input (may be NULL) is what it reads on stdin;
 * out_path (may be NULL) is a file that its stdout goes to instead of result->out. Fails the test when it cannot be started. */
void command_run(command_result_t *result, const char *const *arguments, const char *input, const char *out_path);
void command_free(command_result_t *result);

/* The same by a line for the shell. */
void command_shell(command_result_t *result, const char *line);

/* A line on stderr that begins "tuile: " and no other, an exit code that is neither 0 nor a signal's; and every one
 * of the words (may be NULL) in that line. */
bool command_failed_well(const command_result_t *result, const char *word, const char *other_word);

/* The names of the files in a folder, sorted, one a line. To be released with free. */
char *command_list(const char *folder);

/* A whole file, with a zero behind it, to be released with free; NULL when it cannot be read. size_bytes may be NULL. */
char *command_read(const char *path, size_t *size_bytes);
void command_write(const char *path, const void *bytes, size_t size_bytes);

/* A folder of its own under /tmp; command_remove deletes it and the files in it, folders one deep too. */
char *command_folder(void);
void command_remove(char *folder);

#endif
