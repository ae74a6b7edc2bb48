#include "fault.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "../bus.h"

int tuile_linux_code(int error, bool opening) {
    switch (error) {
    case ESHUTDOWN:
    case ENODEV:
    case ENXIO: return opening ? TUILE_HAL_NOT_FOUND : TUILE_HAL_GONE;
    case ENOENT:
    case ENOTDIR:
    case ENOTTY: return opening ? TUILE_HAL_NOT_FOUND : TUILE_HAL_IO; /* NOTTY: a file, but no device of this kind */
    case EACCES:
    case EPERM: return TUILE_HAL_PERMISSION;
    case EBUSY: return TUILE_HAL_BUSY;
    case EMSGSIZE: return TUILE_HAL_SIZE;
    case ETIMEDOUT: return TUILE_HAL_TIMEOUT;
    case ENAMETOOLONG: return TUILE_HAL_ARGUMENT;
    case EINVAL: return opening ? TUILE_HAL_UNSUPPORTED : TUILE_HAL_IO; /* a mode, or edges, that the controller has not */
    default: return TUILE_HAL_IO;
    }
}

static const char *advice(int code) {
    switch (code) {
    case TUILE_HAL_PERMISSION: return "; hal/linux/60-tuile.rules lets users have it (make install-udev)";
    case TUILE_HAL_GONE: return "; the device is gone, open it anew";
    default: return "";
    }
}

int tuile_linux_fail(tuile_linux_fault_t *fault, int error, bool opening, const char *format, ...) {
    const int code = tuile_linux_code(error, opening);
    char what[128], buffer[64];
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    (void)snprintf(fault->text, sizeof fault->text, "%s: %s%s", what, strerror_r(error, buffer, sizeof buffer), advice(code));
    return code;
}

int tuile_linux_say(tuile_linux_fault_t *fault, int code, const char *format, ...) {
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(fault->text, sizeof fault->text, format, arguments);
    va_end(arguments);
    return code;
}
