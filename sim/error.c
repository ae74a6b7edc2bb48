#include "error.h"

#include <stdarg.h>
#include <stdio.h>

int sim_fail(sim_error_t *error, const char *format, ...) {
    if (error) {
        va_list arguments;
        va_start(arguments, format);
        (void)vsnprintf(error->text, sizeof error->text, format, arguments);
        va_end(arguments);
    }
    return -1;
}
