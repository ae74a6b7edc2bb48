#include "commands.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int command_fail(const char *format, ...) {
    va_list arguments;
    (void)fflush(stdout);
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
