#include "ax206_model.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { ENDPOINT_OUT = 0x01, ENDPOINT_IN = 0x81, PACKET_BYTES = 64 };
enum { COMMAND_BYTES = 31, STATUS_BYTES = 13, SIZE_BYTES = 5, CDB = 15 }; /* CDB: where it begins in a command */
enum { VENDOR = 0xCD, READ_SIZE = 2, USER = 6 };                          /* bytes 0 and 5 of a CDB */
enum { SET_PROPERTY = 0x01, BLIT = 0x12 };                                /* byte 6 */
enum { PROPERTY_BRIGHTNESS = 1, BRIGHTEST = 7 };
enum { DIRECTION_IN = 0x80 };
enum { MASS_STORAGE_RESET = 0xFF, GET_MAX_LUN = 0xFE };

typedef enum phase { COMMAND, DATA_OUT, DATA_IN, STATUS } phase_t;

typedef struct sim_ax206 {
    sim_usb_t usb;
    sim_ax206_counts_t counts;
    uint8_t descriptors[18 + 9 + 9 + 7 + 7];
    uint16_t width, height;
    uint8_t brightness;
    uint8_t broken;

    phase_t phase;
    uint8_t tag[4];
    uint8_t status;           /* of the command under way */
    uint32_t expected, moved; /* bytes of its data */
    uint16_t x0, y0, x1, y1;  /* of a blit, both ends inclusive */
    bool halted;              /* the whole transport, until it is reset or its halts are cleared */
    uint8_t *memory;          /* RGB565, high byte first */
    uint8_t *data;            /* of the blit under way */
} sim_ax206_t;

static sim_ax206_t *ax206_of(sim_usb_t *usb) { return (sim_ax206_t *)usb; }
static const sim_ax206_t *ax206_of_const(const sim_usb_t *usb) { return (const sim_ax206_t *)usb; }

#define REFUSE(frame, ...) ((frame)->halted = true, sim_usb_refuse(&(frame)->usb, __VA_ARGS__))

static int blit(sim_ax206_t *frame, const uint8_t *cdb, uint32_t length) {
    frame->x0 = (uint16_t)sim_usb_u16(cdb + 7);
    frame->y0 = (uint16_t)sim_usb_u16(cdb + 9);
    frame->x1 = (uint16_t)sim_usb_u16(cdb + 11);
    frame->y1 = (uint16_t)sim_usb_u16(cdb + 13);
    if (frame->x0 > frame->x1 || frame->y0 > frame->y1 || frame->x1 >= frame->width || frame->y1 >= frame->height) {
        return REFUSE(frame, "a blit of (%u, %u) to (%u, %u) on %u x %u", frame->x0, frame->y0, frame->x1, frame->y1, frame->width,
                      frame->height);
    }
    if (length != 2u * (frame->x1 - frame->x0 + 1u) * (frame->y1 - frame->y0 + 1u)) {
        return REFUSE(frame, "a blit of (%u, %u) to (%u, %u) with %u bytes", frame->x0, frame->y0, frame->x1, frame->y1, length);
    }
    frame->phase = DATA_OUT;
    return 0;
}

static int set_property(sim_ax206_t *frame, const uint8_t *cdb, uint32_t length) {
    const uint32_t id = sim_usb_u16(cdb + 7), value = sim_usb_u16(cdb + 9);

    if (id != PROPERTY_BRIGHTNESS || value > BRIGHTEST || length) {
        return REFUSE(frame, "property %u is set to %u with %u bytes of data", id, value, length);
    }
    if (!frame->broken) { frame->brightness = (uint8_t)value; }
    frame->counts.properties++;
    frame->phase = STATUS;
    return 0;
}

static int command(sim_ax206_t *frame, const uint8_t *bytes, size_t length) {
    const uint8_t *cdb = bytes + CDB;
    const uint32_t data_bytes = length == COMMAND_BYTES ? sim_usb_u32(bytes + 8) : 0;
    bool in;

    if (length != COMMAND_BYTES || memcmp(bytes, "USBC", 4) || bytes[12] & 0x7Fu || bytes[13] || bytes[14] != 16) {
        return REFUSE(frame, "%zu bytes that are no command block", length);
    }
    in = (bytes[12] & DIRECTION_IN) != 0;
    memcpy(frame->tag, bytes + 4, 4);
    frame->expected = data_bytes;
    frame->moved = 0;
    frame->status = frame->broken;
    if (cdb[0] != VENDOR) { return REFUSE(frame, "SCSI command %02X", cdb[0]); }
    if (cdb[5] == READ_SIZE) {
        if (data_bytes != SIZE_BYTES || !in) { return REFUSE(frame, "the size is read in %u bytes", data_bytes); }
        frame->counts.size_reads++;
        frame->phase = DATA_IN;
        return 0;
    }
    if (cdb[5] == USER && cdb[6] == BLIT && !in) { return blit(frame, cdb, data_bytes); }
    if (cdb[5] == USER && cdb[6] == SET_PROPERTY) { return set_property(frame, cdb, data_bytes); }
    return REFUSE(frame, "vendor command %02X %02X, data %s", cdb[5], cdb[6], in ? "in" : "out");
}

static int data_out(sim_ax206_t *frame, const uint8_t *bytes, size_t length) {
    const uint32_t row = 2u * (frame->x1 - frame->x0 + 1u);

    if (length == 0 || length > frame->expected - frame->moved) {
        return REFUSE(frame, "%zu bytes of a blit where %u are left", length, frame->expected - frame->moved);
    }
    memcpy(frame->data + frame->moved, bytes, length);
    frame->moved += (uint32_t)length;
    if (frame->moved < frame->expected) {
        if (length % PACKET_BYTES) { frame->phase = STATUS, frame->status = 1; } /* the host has ended the data early */
        return (int)length;
    }
    for (uint32_t y = frame->y0; y <= frame->y1 && !frame->broken; y++) {
        memcpy(frame->memory + 2u * ((size_t)y * frame->width + frame->x0), frame->data + (size_t)(y - frame->y0) * row, row);
    }
    frame->counts.blits++;
    frame->counts.pixel_bytes += frame->moved;
    frame->phase = STATUS;
    return (int)length;
}

static int data_in(sim_ax206_t *frame, uint8_t *bytes, size_t length) {
    const uint8_t size[SIZE_BYTES] = {(uint8_t)frame->width, (uint8_t)(frame->width >> 8), (uint8_t)frame->height,
                                      (uint8_t)(frame->height >> 8), 0};

    if (length < SIZE_BYTES) { return REFUSE(frame, "the size is read into %zu bytes", length); }
    memcpy(bytes, size, SIZE_BYTES);
    frame->moved = SIZE_BYTES;
    frame->phase = STATUS;
    return SIZE_BYTES;
}

static int status(sim_ax206_t *frame, uint8_t *bytes, size_t length) {
    static const uint8_t signature[4] = {'U', 'S', 'B', 'S'};

    if (length < STATUS_BYTES) { return REFUSE(frame, "the status is read into %zu bytes", length); }
    memcpy(bytes, signature, sizeof signature);
    memcpy(bytes + 4, frame->tag, 4);
    for (unsigned i = 0; i < 4; i++) { /* what was left of the data */
        bytes[8 + i] = (uint8_t)((frame->expected - frame->moved) >> 8 * i);
    }
    bytes[12] = frame->status;
    frame->phase = COMMAND;
    return STATUS_BYTES;
}

static int bulk(sim_usb_t *usb, uint8_t endpoint, uint8_t *data, size_t length) {
    sim_ax206_t *frame = ax206_of(usb);
    int result;

    if (endpoint != ENDPOINT_OUT && endpoint != ENDPOINT_IN) {
        return sim_usb_refuse(usb, "a transfer on endpoint %02X", endpoint);
    }
    if (frame->halted) { return -EPIPE; }
    if (endpoint == ENDPOINT_OUT) {
        if (frame->phase == DATA_OUT) { return data_out(frame, data, length); }
        if (frame->phase != COMMAND) { return REFUSE(frame, "%zu bytes come while the frame has an answer to give", length); }
        result = command(frame, data, length);
        return result ? result : (int)length;
    }
    if (frame->phase == DATA_IN) { return data_in(frame, data, length); }
    if (frame->phase == STATUS) { return status(frame, data, length); }
    return REFUSE(frame, "%zu bytes are read while there is nothing to say", length);
}

static void reset(sim_usb_t *usb) {
    sim_ax206_t *frame = ax206_of(usb);

    frame->phase = COMMAND;
    frame->halted = false;
}

static int control(sim_usb_t *usb, const uint8_t setup[8], uint8_t *data, size_t length) {
    if (setup[0] == 0x21 && setup[1] == MASS_STORAGE_RESET && length == 0) {
        reset(usb);
        return 0;
    }
    if (setup[0] == 0xA1 && setup[1] == GET_MAX_LUN && length == 1) {
        data[0] = 0;
        return 1;
    }
    return sim_usb_refuse(usb, "request %02X %02X is not one of the bulk-only transport", setup[0], setup[1]);
}

static int picture(const sim_usb_t *usb, sim_picture_t *out, sim_error_t *error) {
    const sim_ax206_t *frame = ax206_of_const(usb);

    if (sim_picture_create(out, frame->width, frame->height, error)) { return -1; }
    if (!frame->brightness) { return 0; }
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++) {
        const uint8_t *pixel = frame->memory + 2u * i;
        const unsigned red = pixel[0] >> 3, green = (pixel[0] & 7u) << 3 | pixel[1] >> 5, blue = pixel[1] & 31u;
        out->rgb[3u * i] = (uint8_t)(red << 3 | red >> 2);
        out->rgb[3u * i + 1u] = (uint8_t)(green << 2 | green >> 4);
        out->rgb[3u * i + 2u] = (uint8_t)(blue << 3 | blue >> 2);
    }
    return 0;
}

static void destroy(sim_usb_t *usb) {
    sim_ax206_t *frame = ax206_of(usb);

    free(frame->memory);
    free(frame->data);
    free(frame);
}

sim_usb_t *sim_ax206_create(const sim_ax206_config_t *config, sim_error_t *error) {
    static const uint8_t descriptors[] = {
        18, 1, 0x00, 0x02, 0,  0,    0, 64,   0x08, 0x19, 0x02, 0x01, 0x00, 0x01, 1, 2, 0, 1, /* device 1908:0102 */
        9,  2, 32,   0,    1,  1,    0, 0x80, 50,                                             /* configuration */
        9,  4, 0,    0,    2,  0xFF, 0, 0,    0,                                              /* interface */
        7,  5, 0x01, 2,    64, 0,    0,                                                       /* endpoints */
        7,  5, 0x81, 2,    64, 0,    0,
    };
    sim_ax206_t *frame = calloc(1, sizeof *frame);
    size_t bytes;

    if (!frame) {
        sim_fail(error, "out of memory for a photo frame");
        return NULL;
    }
    frame->width = config && config->width ? config->width : 480;
    frame->height = config && config->height ? config->height : 320;
    bytes = 2u * (size_t)frame->width * frame->height;
    frame->memory = malloc(bytes);
    frame->data = malloc(bytes);
    if (!frame->memory || !frame->data) {
        sim_fail(error, "out of memory for a photo frame of %u x %u", frame->width, frame->height);
        destroy(&frame->usb);
        return NULL;
    }
    for (size_t i = 0; i < bytes; i++) {
        frame->memory[i] = (uint8_t)(i * 2654435761u >> 13);
    }
    frame->brightness = BRIGHTEST;
    memcpy(frame->descriptors, descriptors, sizeof descriptors);
    if (config && config->serial) { frame->descriptors[16] = 3; }
    frame->usb.control = control;
    frame->usb.bulk = bulk;
    frame->usb.reset = reset;
    frame->usb.clear_halt = NULL; /* a command that was not understood takes a reset */
    frame->usb.picture = picture;
    frame->usb.destroy = destroy;
    frame->usb.descriptors = frame->descriptors;
    frame->usb.descriptors_bytes = sizeof descriptors;
    frame->usb.strings[0] = "AX206";
    frame->usb.strings[1] = "USB-Display";
    frame->usb.strings[2] = config ? config->serial : NULL;
    return &frame->usb;
}

sim_ax206_counts_t *sim_ax206_counts(sim_usb_t *usb) { return &ax206_of(usb)->counts; }

unsigned sim_ax206_brightness(const sim_usb_t *usb) { return ax206_of_const(usb)->brightness; }

void sim_ax206_break(sim_usb_t *usb, uint8_t status_byte) { ax206_of(usb)->broken = status_byte; }
