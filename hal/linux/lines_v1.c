#include <gpiod.h>

#include "lines.h"

#ifdef GPIOD_LINE_BULK_MAX_LINES /* API 1 */

#include <errno.h>
#include <stdio.h>

#include "../bus.h"

const char *tuile_linux_gpiod_version(void) { return gpiod_version_string(); }

static struct gpiod_chip *open_chip(const char *chip, const char *name, tuile_linux_fault_t *fault, int *result) {
    char path[TUILE_LINUX_CHIP_PATH_BYTES];
    struct gpiod_chip *opened = NULL;

    errno = tuile_linux_chip_path(path, chip);
    if (!errno) { opened = gpiod_chip_open(path); }
    if (!opened) { *result = tuile_linux_fail(fault, errno, true, "%s%s%s", name, *name ? ": " : "", chip); }
    return opened;
}

int tuile_linux_chip(tuile_linux_chip_t *info, const char *chip, tuile_linux_used_t used, void *context,
                     tuile_linux_fault_t *fault) {
    int result = TUILE_HAL_OK;
    struct gpiod_chip *opened = open_chip(chip, "", fault, &result);

    if (!opened) { return result; }
    (void)snprintf(info->name, sizeof info->name, "%s", gpiod_chip_name(opened));
    (void)snprintf(info->label, sizeof info->label, "%s", gpiod_chip_label(opened));
    info->lines = gpiod_chip_num_lines(opened);
    for (uint32_t i = 0; used && i < info->lines; i++) {
        struct gpiod_line *line = gpiod_chip_get_line(opened, i);
        if (line && gpiod_line_is_used(line)) { used(context, i, gpiod_line_consumer(line) ? gpiod_line_consumer(line) : ""); }
    }
    gpiod_chip_close(opened);
    return TUILE_HAL_OK;
}

int tuile_linux_line_request(tuile_linux_request_t *request, const tuile_linux_line_t *line, tuile_linux_use_t use,
                             const char *name, const char *consumer, tuile_linux_fault_t *fault) {
    const int flags = line->active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
    int result = TUILE_HAL_OK, failed;
    struct gpiod_chip *chip = open_chip(line->chip, name, fault, &result);
    struct gpiod_line *handle = NULL;

    *request = (tuile_linux_request_t){0};
    if (!chip) { return result; }
    if (line->offset >= gpiod_chip_num_lines(chip)) {
        result = tuile_linux_no_such_line(line, name, gpiod_chip_num_lines(chip), fault);
    } else if (!(handle = gpiod_chip_get_line(chip, line->offset))) {
        result = tuile_linux_not_had(line, name, errno, NULL, fault);
    } else {
        failed = use == TUILE_LINUX_EDGES ? gpiod_line_request_rising_edge_events_flags(handle, consumer, flags)
                                          : gpiod_line_request_output_flags(handle, consumer, flags, use == TUILE_LINUX_OUTPUT_1);
        if (failed) { result = tuile_linux_not_had(line, name, errno, gpiod_line_consumer(handle), fault); }
    }
    if (result) {
        gpiod_chip_close(chip);
        return result;
    }
    *request = (tuile_linux_request_t){.chip = chip, .handle = handle, .offset = line->offset, .name = name};
    return TUILE_HAL_OK;
}

int tuile_linux_line_set(const tuile_linux_request_t *request, bool level, tuile_linux_fault_t *fault) {
    if (gpiod_line_set_value(request->handle, level)) { return tuile_linux_fail(fault, errno, false, "%s line", request->name); }
    return TUILE_HAL_OK;
}

int tuile_linux_edges_wait(const tuile_linux_request_t *request, uint64_t timeout_ns) {
    const struct timespec timeout = {(time_t)(timeout_ns / UINT64_C(1000000000)), (long)(timeout_ns % UINT64_C(1000000000))};

    return gpiod_line_event_wait(request->handle, &timeout);
}

int tuile_linux_edges_take(const tuile_linux_request_t *request) {
    struct gpiod_line_event events[TUILE_LINUX_EDGES_KEPT];

    return gpiod_line_event_read_multiple(request->handle, events, TUILE_LINUX_EDGES_KEPT);
}

void tuile_linux_line_release(tuile_linux_request_t *request) {
    if (request->handle) { gpiod_line_release(request->handle); }
    if (request->chip) { gpiod_chip_close(request->chip); }
    *request = (tuile_linux_request_t){0};
}

#endif
