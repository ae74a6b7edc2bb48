#include <gpiod.h>

#include "lines.h"

#ifndef GPIOD_LINE_BULK_MAX_LINES /* API 2 */

#include <errno.h>
#include <stdio.h>

#include "../bus.h"

const char *tuile_linux_gpiod_version(void) { return gpiod_api_version(); }

static struct gpiod_chip *open_chip(const char *chip, const char *name, tuile_linux_fault_t *fault, int *result) {
    char path[TUILE_LINUX_CHIP_PATH_BYTES];
    struct gpiod_chip *opened = NULL;

    errno = tuile_linux_chip_path(path, chip);
    if (!errno) { opened = gpiod_chip_open(path); }
    if (!opened) { *result = tuile_linux_fail(fault, errno, true, "%s%s%s", name, *name ? ": " : "", chip); }
    return opened;
}

static int chip_info(tuile_linux_chip_t *info, struct gpiod_chip *chip, const char *chip_name, tuile_linux_fault_t *fault) {
    struct gpiod_chip_info *told = gpiod_chip_get_info(chip);

    if (!told) { return tuile_linux_fail(fault, errno, true, "%s", chip_name); }
    (void)snprintf(info->name, sizeof info->name, "%s", gpiod_chip_info_get_name(told));
    (void)snprintf(info->label, sizeof info->label, "%s", gpiod_chip_info_get_label(told));
    info->lines = (uint32_t)gpiod_chip_info_get_num_lines(told);
    gpiod_chip_info_free(told);
    return TUILE_HAL_OK;
}

int tuile_linux_chip(tuile_linux_chip_t *info, const char *chip, tuile_linux_used_t used, void *context,
                     tuile_linux_fault_t *fault) {
    int result = TUILE_HAL_OK;
    struct gpiod_chip *opened = open_chip(chip, "", fault, &result);

    if (!opened) { return result; }
    result = chip_info(info, opened, chip, fault);
    for (uint32_t i = 0; !result && used && i < info->lines; i++) {
        struct gpiod_line_info *line = gpiod_chip_get_line_info(opened, i);
        const char *consumer = line ? gpiod_line_info_get_consumer(line) : NULL;
        if (line && gpiod_line_info_is_used(line)) { used(context, i, consumer ? consumer : ""); }
        gpiod_line_info_free(line);
    }
    gpiod_chip_close(opened);
    return result;
}

static int configure(struct gpiod_line_settings *settings, const tuile_linux_line_t *line, tuile_linux_use_t use) {
    gpiod_line_settings_set_active_low(settings, line->active_low);
    if (use == TUILE_LINUX_EDGES) {
        return gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT) ||
               gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_RISING);
    }
    return gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT) ||
           gpiod_line_settings_set_output_value(settings,
                                                use == TUILE_LINUX_OUTPUT_1 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE);
}

/* NULL and errno. */
static struct gpiod_line_request *request_line(struct gpiod_chip *chip, const tuile_linux_line_t *line, tuile_linux_use_t use,
                                               const char *consumer) {
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    struct gpiod_line_config *lines = gpiod_line_config_new();
    struct gpiod_request_config *request = gpiod_request_config_new();
    struct gpiod_line_request *made = NULL;
    int error;

    errno = ENOMEM;
    if (settings && lines && request && !configure(settings, line, use) &&
        !gpiod_line_config_add_line_settings(lines, &line->offset, 1, settings)) {
        gpiod_request_config_set_consumer(request, consumer);
        gpiod_request_config_set_event_buffer_size(request, TUILE_LINUX_EDGES_KEPT);
        made = gpiod_chip_request_lines(chip, request, lines);
    }
    error = errno;
    gpiod_request_config_free(request);
    gpiod_line_config_free(lines);
    gpiod_line_settings_free(settings);
    errno = error;
    return made;
}

static int not_had(struct gpiod_chip *chip, const tuile_linux_line_t *line, const char *name, tuile_linux_fault_t *fault) {
    const int error = errno;
    struct gpiod_line_info *info = gpiod_chip_get_line_info(chip, line->offset);
    const int result = tuile_linux_not_had(line, name, error, info ? gpiod_line_info_get_consumer(info) : NULL, fault);

    gpiod_line_info_free(info);
    return result;
}

int tuile_linux_line_request(tuile_linux_request_t *request, const tuile_linux_line_t *line, tuile_linux_use_t use,
                             const char *name, const char *consumer, tuile_linux_fault_t *fault) {
    int result = TUILE_HAL_OK;
    tuile_linux_chip_t info;
    struct gpiod_chip *chip = open_chip(line->chip, name, fault, &result);

    *request = (tuile_linux_request_t){.offset = line->offset, .name = name};
    if (!chip) { return result; }
    if (!(result = chip_info(&info, chip, line->chip, fault))) {
        if (line->offset >= info.lines) {
            result = tuile_linux_no_such_line(line, name, info.lines, fault);
        } else if (!(request->handle = request_line(chip, line, use, consumer))) {
            result = not_had(chip, line, name, fault);
        } else if (use == TUILE_LINUX_EDGES && !(request->events = gpiod_edge_event_buffer_new(TUILE_LINUX_EDGES_KEPT))) {
            result = tuile_linux_not_had(line, name, ENOMEM, NULL, fault);
        }
    }
    gpiod_chip_close(chip);
    if (result) { tuile_linux_line_release(request); }
    return result;
}

int tuile_linux_line_set(const tuile_linux_request_t *request, bool level, tuile_linux_fault_t *fault) {
    const enum gpiod_line_value value = level ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;

    if (gpiod_line_request_set_value(request->handle, request->offset, value)) {
        return tuile_linux_fail(fault, errno, false, "%s line", request->name);
    }
    return TUILE_HAL_OK;
}

int tuile_linux_edges_wait(const tuile_linux_request_t *request, uint64_t timeout_ns) {
    return gpiod_line_request_wait_edge_events(request->handle, (int64_t)timeout_ns);
}

int tuile_linux_edges_take(const tuile_linux_request_t *request) {
    return gpiod_line_request_read_edge_events(request->handle, request->events, TUILE_LINUX_EDGES_KEPT);
}

void tuile_linux_line_release(tuile_linux_request_t *request) {
    if (request->handle) { gpiod_line_request_release(request->handle); }
    if (request->events) { gpiod_edge_event_buffer_free(request->events); }
    *request = (tuile_linux_request_t){0};
}

#endif
