#include "commands.h"

#include <errno.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool bar_open; /* a message must not stand behind a bar */

void command_progress(unsigned done, unsigned of) {
    enum { CELLS = 36 };
    if (!isatty(STDERR_FILENO)) { return; }
    (void)fprintf(stderr, "\r[");
    for (unsigned i = 0; i < CELLS; i++) {
        (void)fputc(i < done * CELLS / of ? '#' : '.', stderr);
    }
    (void)fprintf(stderr, "] %u/%u%s", done, of, done == of ? "\n" : "");
    bar_open = done < of;
}

int command_fail(const char *format, ...) {
    va_list arguments;
    (void)fflush(stdout);
    if (bar_open) { (void)fputc('\n', stderr); }
    bar_open = false;
    (void)fputs("tuile: ", stderr);
    va_start(arguments, format);
    (void)vfprintf(stderr, format, arguments);
    va_end(arguments);
    (void)fputc('\n', stderr);
    return EXIT_FAILURE;
}

int command_finish(void) {
    if (fflush(stdout) != 0 || ferror(stdout)) { return command_fail("standard output: %s", strerror(errno)); }
    return EXIT_SUCCESS;
}
