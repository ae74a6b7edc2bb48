#include "ax206.h"

#include <stdlib.h>
#include <string.h>

#include "../display.h"

/* USB Mass Storage Class, Bulk-Only Transport 1.0, 5.1 and 5.2: a command of 31 bytes, data, a status of 13. The 16 bytes of SCSI
 * in the command are the vendor's. */
enum { COMMAND_BYTES = TUILE_AX206_COMMAND_BYTES, STATUS_BYTES = TUILE_AX206_STATUS_BYTES, CDB_BYTES = 16, SIZE_BYTES = 5 };
enum { DIRECTION_IN = 0x80, CLASS_OUT = 0x21, MASS_STORAGE_RESET = 0xFF };
enum { VENDOR = 0xCD, READ_SIZE = 2, USER = 6, SET_PROPERTY = 0x01, BLIT = 0x12 };
enum { PROPERTY_BRIGHTNESS = 1, BRIGHTEST = 7 };

#define TIMEOUT_MS 5000u

static const tuile_usb_id_t ids[] = {{0x1908, 0x0102}};
static const tuile_usb_kind_t kind = {.name = "AX206 frame", .ids = ids, .id_count = 1, .answers = true};

static void put16(uint8_t *to, uint32_t value) {
    to[0] = (uint8_t)value;
    to[1] = (uint8_t)(value >> 8);
}

static void put32(uint8_t *to, uint32_t value) {
    put16(to, value);
    put16(to + 2, value >> 16);
}

/* ---- transport -------------------------------------------------------------------------------------------------- */

static int fail(tuile_ax206_t *frame, int result) {
    frame->bad = true;
    frame->status_due = false;
    return tuile_usb_fail(&frame->usb, result, "%s: %s", frame->doing, frame->usb.words);
}

static int transfer(tuile_ax206_t *frame, uint8_t endpoint, uint8_t *bytes, size_t size_bytes) {
    const int result = tuile_usb_bulk(&frame->usb, endpoint, bytes, size_bytes);

    return result ? result : tuile_usb_bulk_wait(&frame->usb);
}

/* The end of the command under way: its data, if they are still going out, and its status. */
static int finish(tuile_ax206_t *frame) {
    const uint8_t *status = frame->status;
    int result = tuile_usb_bulk_wait(&frame->usb);

    if (result) { return fail(frame, result); }
    if (!frame->status_due) { return TUILE_HAL_OK; }
    frame->status_due = false;
    if ((result = transfer(frame, frame->usb.in, frame->status, STATUS_BYTES))) { return fail(frame, result); }
    if (frame->usb.moved != STATUS_BYTES || memcmp(status, "USBS", 4) || memcmp(status + 4, frame->command + 4, 4)) {
        frame->usb.words = "what came is not the status of the command";
        return fail(frame, TUILE_HAL_PROTOCOL);
    }
    if (status[12]) {
        frame->usb.words = "the frame says that the command failed";
        return fail(frame, TUILE_HAL_PROTOCOL);
    }
    return TUILE_HAL_OK;
}

static int command(tuile_ax206_t *frame, const char *doing, const uint8_t cdb[CDB_BYTES], uint32_t length, uint8_t direction) {
    uint8_t *bytes = frame->command;
    int result;

    frame->doing = doing;
    memcpy(bytes, "USBC", 4);
    put32(bytes + 4, ++frame->tag);
    put32(bytes + 8, length);
    bytes[12] = direction;
    bytes[13] = 0;
    bytes[14] = CDB_BYTES;
    memcpy(bytes + 15, cdb, CDB_BYTES);
    if ((result = transfer(frame, frame->usb.out, bytes, COMMAND_BYTES))) { return fail(frame, result); }
    frame->status_due = true;
    return TUILE_HAL_OK;
}

/* The transport's own way back after a fault. A frame that does not know the request stalls it; the halts are cleared all the same.
 */
static int recover(tuile_ax206_t *frame) {
    int result;

    frame->doing = "starting the transport anew";
    result = tuile_usb_control(&frame->usb, CLASS_OUT, MASS_STORAGE_RESET, 0, NULL, 0);
    if (result && result != TUILE_HAL_PROTOCOL) { return fail(frame, result); }
    if ((result = tuile_usb_clear_halt(&frame->usb, frame->usb.in)) ||
        (result = tuile_usb_clear_halt(&frame->usb, frame->usb.out))) {
        return fail(frame, result);
    }
    frame->bad = false;
    return TUILE_HAL_OK;
}

/* ---- commands --------------------------------------------------------------------------------------------------- */

static int read_size(tuile_ax206_t *frame) {
    static const uint8_t cdb[CDB_BYTES] = {VENDOR, 0, 0, 0, 0, READ_SIZE};
    uint8_t size[SIZE_BYTES];
    int result = command(frame, "reading the size", cdb, SIZE_BYTES, DIRECTION_IN);

    if (result) { return result; }
    if ((result = transfer(frame, frame->usb.in, size, SIZE_BYTES))) { return fail(frame, result); }
    if (frame->usb.moved < 4) {
        frame->usb.words = "the answer is too short";
        return fail(frame, TUILE_HAL_PROTOCOL);
    }
    if ((result = finish(frame))) { return result; }
    frame->width = (uint16_t)(size[0] | (unsigned)size[1] << 8);
    frame->height = (uint16_t)(size[2] | (unsigned)size[3] << 8);
    if (frame->width && frame->height) { return TUILE_HAL_OK; }
    frame->usb.words = "it is 0";
    return fail(frame, TUILE_HAL_PROTOCOL);
}

static int set_brightness(tuile_ax206_t *frame, uint8_t value) {
    const uint8_t cdb[CDB_BYTES] = {VENDOR, 0, 0, 0, 0, USER, SET_PROPERTY, PROPERTY_BRIGHTNESS, 0, value, 0};
    const int result = command(frame, "setting the brightness", cdb, 0, 0);

    return result ? result : finish(frame);
}

/* The window's pixels; they are on their way when this returns. */
static int blit(tuile_ax206_t *frame, const uint8_t *bytes) {
    uint8_t cdb[CDB_BYTES] = {VENDOR, 0, 0, 0, 0, USER, BLIT};
    int result;

    put16(cdb + 7, frame->x);
    put16(cdb + 9, frame->y);
    put16(cdb + 11, frame->x + frame->window_width - 1u);
    put16(cdb + 13, frame->y + frame->window_height - 1u);
    if ((result = command(frame, "pixels", cdb, frame->window_bytes, 0))) { return result; }
    result = tuile_usb_bulk(&frame->usb, frame->usb.out, (uint8_t *)(uintptr_t)bytes, frame->window_bytes);
    return result ? fail(frame, result) : TUILE_HAL_OK;
}

/* ---- device ----------------------------------------------------------------------------------------------------- */

static int describe(void *context, const tuile_display_config_t *config, tuile_view_t *view) {
    const tuile_ax206_t *frame = context;

    if (!frame->usb.handle) { return TUILE_HAL_ARGUMENT; }
    if ((config->wire != TUILE_WIRE_DEFAULT && config->wire != TUILE_WIRE_RGB565) || config->rotation ||
        config->tearing_timeout_ms || config->identify) {
        return TUILE_HAL_UNSUPPORTED;
    }
    *view = (tuile_view_t){.width = frame->width, .height = frame->height, .align_x = 1, .align_y = 1, .wire = TUILE_WIRE_RGB565};
    view->dimmable = true;
    return TUILE_HAL_OK;
}

static int start(void *context) {
    tuile_ax206_t *frame = context;
    int result;

    (void)tuile_usb_bulk_wait(&frame->usb);
    if (frame->status_due) { frame->bad = true; } /* the command before was left in its middle */
    frame->status_due = false;
    frame->error_text[0] = 0;
    if (frame->bad && (result = recover(frame))) { return result; }
    return set_brightness(frame, 0);
}

static int window(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    tuile_ax206_t *frame = context;

    frame->x = (uint16_t)x;
    frame->y = (uint16_t)y;
    frame->window_width = (uint16_t)width;
    frame->window_height = (uint16_t)height;
    frame->window_bytes = 2u * width * height;
    frame->staged_bytes = 0;
    return TUILE_HAL_OK;
}

static int write(void *context, const uint8_t *bytes, size_t size_bytes) {
    tuile_ax206_t *frame = context;

    if (size_bytes == frame->window_bytes) { return blit(frame, bytes); }
    memcpy(frame->stage + frame->staged_bytes, bytes, size_bytes);
    frame->staged_bytes += (uint32_t)size_bytes;
    return frame->staged_bytes == frame->window_bytes ? blit(frame, frame->stage) : TUILE_HAL_OK;
}

static int wait(void *context) { return finish(context); }

static int show(void *context, bool first) {
    (void)context; /* the light is the brightness, which is set after this */
    (void)first;
    return TUILE_HAL_OK;
}

static int brightness(void *context, uint8_t level) {
    const unsigned value = (level * (unsigned)BRIGHTEST + 127u) / 255u;

    return set_brightness(context, (uint8_t)(value || !level ? value : 1u));
}

static int sleep(void *context) {
    tuile_ax206_t *frame = context;
    const int waited = finish(frame);
    /* A command that follows a fault would not be understood. */
    const int ready = frame->bad ? recover(frame) : TUILE_HAL_OK;
    const int dark = ready ? ready : set_brightness(frame, 0);

    return waited ? waited : dark;
}

const tuile_device_t tuile_ax206_device = {
    .describe = describe,
    .start = start,
    .window = window,
    .write = write,
    .wait = wait,
    .show = show,
    .brightness = brightness,
    .sleep = sleep,
};

/* ---- life ------------------------------------------------------------------------------------------------------- */

int tuile_ax206_open(tuile_ax206_t *frame, const tuile_ax206_config_t *config) {
    tuile_usb_choice_t choice = {0};
    int result;

    *frame = (tuile_ax206_t){0};
    if (config) { choice = (tuile_usb_choice_t){.serial = config->serial, .bus = config->bus, .address = config->address}; }
    if ((result = tuile_usb_open(&frame->usb, &kind, &choice, config && config->timeout_ms ? config->timeout_ms : TIMEOUT_MS,
                                 frame->error_text))) {
        return result;
    }
    if (!(result = read_size(frame))) {
        frame->stage = malloc(2u * (size_t)frame->width * frame->height);
        if (!frame->stage) { result = tuile_usb_fail(&frame->usb, TUILE_HAL_IO, "out of memory for a frame"); }
    }
    if (result) {
        if (frame->bad && result != TUILE_HAL_GONE) { (void)recover(frame); } /* so that the next one finds it in order */
        tuile_ax206_close(frame);
    }
    return result;
}

void tuile_ax206_close(tuile_ax206_t *frame) {
    tuile_usb_close(&frame->usb);
    free(frame->stage);
    frame->stage = NULL;
}

int tuile_ax206_wait_for(const tuile_ax206_config_t *config, uint32_t timeout_ms) {
    tuile_usb_choice_t choice = {0};

    if (config) { choice = (tuile_usb_choice_t){.serial = config->serial, .bus = config->bus, .address = config->address}; }
    return tuile_usb_wait_for(&kind, &choice, timeout_ms);
}
