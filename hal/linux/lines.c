#include "lines.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "../bus.h"

int tuile_linux_chip_path(char path[TUILE_LINUX_CHIP_PATH_BYTES], const char *chip) {
    const int length = snprintf(path, TUILE_LINUX_CHIP_PATH_BYTES, "%s%s", strchr(chip, '/') ? "" : "/dev/", chip);

    return length < (int)TUILE_LINUX_CHIP_PATH_BYTES ? 0 : ENAMETOOLONG;
}

int tuile_linux_no_such_line(const tuile_linux_line_t *line, const char *name, uint32_t lines, tuile_linux_fault_t *fault) {
    return tuile_linux_say(fault, TUILE_HAL_NOT_FOUND, "%s: %s has no line %u, only 0 to %u", name, line->chip, line->offset,
                           lines - 1);
}

int tuile_linux_not_had(const tuile_linux_line_t *line, const char *name, int error, const char *consumer,
                        tuile_linux_fault_t *fault) {
    if (error == EBUSY) {
        return tuile_linux_say(fault, TUILE_HAL_BUSY, "%s: line %u of %s is in use by %s", name, line->offset, line->chip,
                               consumer && *consumer ? consumer : "somebody without a name");
    }
    return tuile_linux_fail(fault, error, true, "%s: line %u of %s", name, line->offset, line->chip);
}

static uint64_t now_ns(void) {
    struct timespec now;

    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * UINT64_C(1000000000) + (uint64_t)now.tv_nsec;
}

int tuile_linux_line_edge(const tuile_linux_request_t *request, uint32_t timeout_ms, tuile_linux_fault_t *fault) {
    const uint64_t end_ns = now_ns() + timeout_ms * UINT64_C(1000000);
    bool stale = true; /* what the kernel has kept since the last frame says nothing of the blank that comes */

    for (;;) {
        const uint64_t at_ns = now_ns();
        const int ready = tuile_linux_edges_wait(request, stale || at_ns >= end_ns ? 0 : end_ns - at_ns);

        if (ready < 0 && errno == EINTR) { continue; } /* nothing was taken: the time that is left still holds */
        if (ready < 0 || (ready > 0 && tuile_linux_edges_take(request) < 0)) {
            return tuile_linux_fail(fault, errno, false, "%s line", request->name);
        }
        if (!stale && ready > 0) { return TUILE_HAL_OK; }
        if (!stale && at_ns >= end_ns) {
            return tuile_linux_say(fault, TUILE_HAL_TIMEOUT, "%s line: no edge within %u ms", request->name, timeout_ms);
        }
        stale = false;
    }
}
