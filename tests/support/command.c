#include "command.h"

#include "check.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- files -------------------------------------------------------------------------------------------------- */

char *command_read(const char *path, size_t *size_bytes) {
    FILE *file = fopen(path, "rb");
    size_t used = 0, capacity = 4096;
    char *text = file ? malloc(capacity) : NULL;
    if (!text) {
        if (file) { (void)fclose(file); }
        return NULL;
    }
    for (size_t got; (got = fread(text + used, 1, capacity - used - 1, file)) > 0;) {
        used += got;
        if (capacity - used < 2) {
            capacity *= 2;
            text = realloc(text, capacity);
            assert_non_null(text);
        }
    }
    (void)fclose(file);
    text[used] = '\0';
    if (size_bytes) { *size_bytes = used; }
    return text;
}

void command_write(const char *path, const void *bytes, size_t size_bytes) {
    FILE *file = fopen(path, "wb");
    if (!file) { fail_msg("%s: %s", path, strerror(errno)); }
    assert_int_equal(fwrite(bytes, 1, size_bytes, file), size_bytes);
    assert_int_equal(fclose(file), 0);
}

char *command_folder(void) {
    char *folder = strdup("/tmp/tuile_test_XXXXXX");
    assert_non_null(folder);
    assert_non_null(mkdtemp(folder));
    return folder;
}

static void remove_files(const char *folder, int depth) {
    DIR *directory = opendir(folder);
    if (!directory) { return; }
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        char path[1024];
        struct stat status;
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) { continue; }
        (void)snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (lstat(path, &status) == 0 && S_ISDIR(status.st_mode) && depth > 0) {
            remove_files(path, depth - 1);
            (void)rmdir(path);
        } else {
            (void)unlink(path);
        }
    }
    (void)closedir(directory);
}

void command_remove(char *folder) {
    remove_files(folder, 1);
    (void)rmdir(folder);
    free(folder);
}

static int by_name(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

char *command_list(const char *folder) {
    char *names[1024], *list;
    size_t count = 0, bytes = 1;
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory)) != NULL && count < CHECK_COUNT(names);) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) { continue; }
        names[count] = strdup(entry->d_name);
        assert_non_null(names[count]);
        bytes += strlen(names[count++]) + 1;
    }
    (void)closedir(directory);
    qsort(names, count, sizeof *names, by_name);
    list = calloc(1, bytes);
    assert_non_null(list);
    for (size_t i = 0; i < count; i++) {
        (void)strcat(strcat(list, names[i]), "\n");
        free(names[i]);
    }
    return list;
}

/* ---- programs ----------------------------------------------------------------------------------------------- */

/* An unnamed file that both sides can seek in: no pipe has to be emptied while the program runs. */
static FILE *scratch(void) {
    FILE *file = tmpfile();
    assert_non_null(file);
    return file;
}

static char *drain(FILE *file, size_t *size_bytes) {
    struct stat status;
    assert_int_equal(fstat(fileno(file), &status), 0);
    char *text = malloc((size_t)status.st_size + 1);
    assert_non_null(text);
    rewind(file);
    *size_bytes = fread(text, 1, (size_t)status.st_size, file);
    text[*size_bytes] = '\0';
    (void)fclose(file);
    return text;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wcast-qual"
static void execute(const char *const *arguments) { (void)execvp(arguments[0], (char *const *)arguments); }
#pragma GCC diagnostic pop

void command_run(command_result_t *result, const char *const *arguments, const char *input, const char *out_path) {
    FILE *in = scratch(), *out = scratch(), *err = scratch();
    int status = 0;
    if (input) { assert_int_equal(fwrite(input, 1, strlen(input), in), strlen(input)); }
    assert_int_equal(fflush(in), 0);
    rewind(in);
    (void)fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const int to = out_path ? open(out_path, O_WRONLY | O_CREAT | O_TRUNC, 0666) : fileno(out);
        if (to < 0 || dup2(fileno(in), 0) < 0 || dup2(to, 1) < 0 || dup2(fileno(err), 2) < 0) { _exit(126); }
        execute(arguments);
        _exit(127);
    }
    while (waitpid(child, &status, 0) < 0) {
        assert_int_equal(errno, EINTR);
    }
    (void)fclose(in);
    result->code = WIFEXITED(status) ? WEXITSTATUS(status) : 256 + WTERMSIG(status);
    result->out = drain(out, &result->out_bytes);
    result->err = drain(err, &result->err_bytes);
    if (result->code == 127 || result->code == 126) { fail_msg("%s cannot be run", arguments[0]); }
}

void command_shell(command_result_t *result, const char *line) {
    const char *const arguments[] = {"/bin/sh", "-c", line, NULL};
    command_run(result, arguments, NULL, NULL);
}

void command_free(command_result_t *result) {
    free(result->out);
    free(result->err);
    memset(result, 0, sizeof *result);
}

bool command_failed_well(const command_result_t *result, const char *word, const char *other_word) {
    const char *end = strchr(result->err, '\n');
    const bool good = result->code > 0 && result->code < 126 && strncmp(result->err, "tuile: ", 7) == 0 && end != NULL &&
                      end[1] == '\0' && result->err_bytes > 8 && strlen(result->err) == result->err_bytes &&
                      (!word || strstr(result->err, word)) && (!other_word || strstr(result->err, other_word));
    if (!good) {
        print_message("exit code %d, stdout '%.300s', stderr '%s'; wanted one line with '%s' and '%s'\n", result->code, result->out,
                      result->err, word ? word : "", other_word ? other_word : "");
    }
    return good;
}
