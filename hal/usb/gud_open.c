#include <lz4.h>
#include <stdlib.h>
#include <string.h>

#include "edid.h"
#include "gud_protocol.h"

/* What it takes to draw on a display is read once, when it is opened. */

enum { DISPLAY_BYTES = 30, CONNECTOR_BYTES = 5, PROPERTY_BYTES = 10 };
enum { FORMATS_MAX = 32, CONNECTORS_MAX = 32, PROPERTIES_MAX = 32, MODES_MAX = 128, EDID_MAX_BYTES = 2048 };
enum { FLAG_STATUS_ON_SET = 1, FLAG_FULL_UPDATE = 2, COMPRESSION_LZ4 = 1 };
enum { DISCONNECTED = 0, CONNECTED = 1, STATUS_MASK = 3 };

#define MAGIC 0x1D50614Du
#define MODE_PREFERRED (1u << 10)
#define TIMEOUT_MS 3000u
#define UPDATE_MOST_BYTES (4u << 20) /* usbfs has 16 MB for all of its users */

static const tuile_usb_id_t ids[] = {{0x1D50, 0x614D}, {0x16D0, 0x10A9}, {0x1209, 0x4FB3}};
static const tuile_usb_kind_t kind = {.name = "GUD display", .ids = ids, .id_count = 3, .vendor_class = true};

/* The sizes between which modes lie. */
typedef struct limits {
    uint32_t least_width, most_width, least_height, most_height;
} limits_t;

static int read_display(tuile_gud_t *gud, const tuile_gud_config_t *config, limits_t *limits) {
    uint8_t display[DISPLAY_BYTES];
    uint32_t flags;
    const int result = tuile_gud_get(gud, TUILE_GUD_GET_DESCRIPTOR, 0, display, DISPLAY_BYTES, DISPLAY_BYTES, NULL);

    if (result) { return result; }
    if (tuile_gud_get32(display) != MAGIC) {
        return tuile_usb_fail(&gud->usb, TUILE_HAL_PROTOCOL, "not a GUD display: the magic number is %08X",
                              tuile_gud_get32(display));
    }
    if (display[4] != 1) {
        return tuile_usb_fail(&gud->usb, TUILE_HAL_UNSUPPORTED, "version %u of the GUD protocol; 1 is known here", display[4]);
    }
    flags = tuile_gud_get32(display + 5);
    gud->status_on_set = (flags & FLAG_STATUS_ON_SET) != 0;
    gud->full_update = (flags & FLAG_FULL_UPDATE) != 0;
    gud->lz4 = (display[9] & COMPRESSION_LZ4) != 0 && !gud->full_update && !config->no_compression;
    gud->buffer_most_bytes = tuile_gud_get32(display + 10);
    if (!gud->buffer_most_bytes || gud->buffer_most_bytes > UPDATE_MOST_BYTES) { gud->buffer_most_bytes = UPDATE_MOST_BYTES; }
    limits->least_width = tuile_gud_get32(display + 14);
    limits->most_width = tuile_gud_get32(display + 18);
    limits->least_height = tuile_gud_get32(display + 22);
    limits->most_height = tuile_gud_get32(display + 26);
    return TUILE_HAL_OK;
}

static int read_formats(tuile_gud_t *gud) {
    uint8_t formats[FORMATS_MAX];
    uint16_t count;
    const int result = tuile_gud_get(gud, TUILE_GUD_GET_FORMATS, 0, formats, 1, FORMATS_MAX, &count);

    if (result) { return result; }
    for (unsigned i = 0; i < count; i++) {
        const uint8_t wire = tuile_gud_wire(formats[i]);
        if (wire) { gud->wires |= 1u << wire; }
    }
    if (gud->wires) { return TUILE_HAL_OK; }
    return tuile_usb_fail(&gud->usb, TUILE_HAL_UNSUPPORTED, "the display offers no pixel format that is known here");
}

/* A list of records: an answer that ends within one was cut on its way. count is of records. */
static int get_list(tuile_gud_t *gud, uint8_t request, uint16_t value, void *data, uint16_t record_bytes, uint16_t most,
                    uint16_t *count) {
    uint16_t bytes;
    const int result = tuile_gud_get(gud, request, value, data, 0, (uint16_t)(most * record_bytes), &bytes);

    if (result) { return result; }
    *count = bytes / record_bytes;
    if (bytes % record_bytes == 0) { return TUILE_HAL_OK; }
    return tuile_usb_fail(&gud->usb, TUILE_HAL_PROTOCOL, "an answer of %u bytes to request %02X: not records of %u", bytes, request,
                          record_bytes);
}

static int read_properties(tuile_gud_t *gud, uint8_t request, uint16_t connector) {
    uint8_t bytes[PROPERTIES_MAX * PROPERTY_BYTES];
    uint16_t count;
    const int result = get_list(gud, request, connector, bytes, PROPERTY_BYTES, PROPERTIES_MAX, &count);

    for (unsigned at = 0; !result && at < (unsigned)count * PROPERTY_BYTES; at += PROPERTY_BYTES) {
        tuile_gud_property_t *property = &gud->properties[gud->property_count++];
        property->id = (uint16_t)tuile_gud_get16(bytes + at);
        property->value = tuile_gud_get32(bytes + at + 2) | (uint64_t)tuile_gud_get32(bytes + at + 6) << 32;
        if (property->id == TUILE_GUD_ROTATION && request == TUILE_GUD_GET_PROPERTIES) { gud->rotations = property->value & 15u; }
        if (request == TUILE_GUD_GET_PROPERTIES) { gud->device_property_count++; }
        if (property->id == TUILE_GUD_BACKLIGHT && request == TUILE_GUD_GET_CONNECTOR_PROPERTIES) { gud->dimmable = true; }
    }
    return result;
}

/* ---- connectors ------------------------------------------------------------------------------------------------- */

static int read_status(tuile_gud_t *gud, uint16_t connector, uint8_t *status) {
    const int result = tuile_gud_set(gud, TUILE_GUD_SET_FORCE_DETECT, connector, NULL, 0);

    return result ? result : tuile_gud_get(gud, TUILE_GUD_GET_CONNECTOR_STATUS, connector, status, 1, 1, NULL);
}

/* The one that was asked for, else the first that says it is connected, else the first that does not know. */
static int choose_connector(tuile_gud_t *gud, const tuile_gud_config_t *config) {
    uint8_t bytes[CONNECTORS_MAX * CONNECTOR_BYTES];
    uint16_t count;
    unsigned first = 0, end;
    int chosen = -1, result = get_list(gud, TUILE_GUD_GET_CONNECTORS, 0, bytes, CONNECTOR_BYTES, CONNECTORS_MAX, &count);

    if (result) { return result; }
    end = gud->connectors = (uint8_t)count;
    if (config->connector) { first = config->connector - 1u, end = config->connector; }
    if (end > gud->connectors) {
        return tuile_usb_fail(&gud->usb, TUILE_HAL_NOT_FOUND, "there is no connector %u, only %u", config->connector,
                              gud->connectors);
    }
    for (unsigned i = first; i < end; i++) {
        uint8_t status;
        if ((result = read_status(gud, (uint16_t)i, &status))) { return result; }
        if ((status & STATUS_MASK) == DISCONNECTED) { continue; }
        if (chosen < 0) { chosen = (int)i; }
        if ((status & STATUS_MASK) == CONNECTED) {
            chosen = (int)i;
            break;
        }
    }
    if (chosen < 0) { return tuile_usb_fail(&gud->usb, TUILE_HAL_NOT_FOUND, "nothing is connected to the display's connector"); }
    gud->connector = (uint8_t)chosen;
    return TUILE_HAL_OK;
}

/* ---- mode ------------------------------------------------------------------------------------------------------- */

static bool fits(const uint8_t *mode, const limits_t *limits, const tuile_gud_config_t *config) {
    const uint32_t width = tuile_gud_get16(mode + 4), height = tuile_gud_get16(mode + 12);

    if (!width || !height || width < limits->least_width || width > limits->most_width || height < limits->least_height ||
        height > limits->most_height) {
        return false;
    }
    return (!config->width || config->width == width) && (!config->height || config->height == height);
}

static int choose_mode(tuile_gud_t *gud, const tuile_gud_config_t *config, const limits_t *limits) {
    uint8_t edid[EDID_MAX_BYTES], modes[MODES_MAX][TUILE_GUD_MODE_BYTES];
    const uint8_t *chosen = NULL;
    uint16_t edid_bytes, mode_count;
    unsigned count;
    int result;

    if ((result = tuile_gud_get(gud, TUILE_GUD_GET_EDID, gud->connector, edid, 0, sizeof edid, &edid_bytes)) ||
        (result = get_list(gud, TUILE_GUD_GET_MODES, gud->connector, modes, TUILE_GUD_MODE_BYTES, MODES_MAX, &mode_count))) {
        return result;
    }
    count = mode_count;
    if (!count) { count = tuile_edid_modes(edid, edid_bytes, modes); }
    for (unsigned i = 0; i < count; i++) {
        if (!fits(modes[i], limits, config)) { continue; }
        if (!chosen) { chosen = modes[i]; }
        if (tuile_gud_get32(modes[i] + 20) & MODE_PREFERRED) {
            chosen = modes[i];
            break;
        }
    }
    if (!chosen && (config->width || config->height)) {
        return tuile_usb_fail(&gud->usb, TUILE_HAL_UNSUPPORTED, "the display has no mode of %u x %u", config->width,
                              config->height);
    }
    if (!chosen) { return tuile_usb_fail(&gud->usb, TUILE_HAL_UNSUPPORTED, "the display names no mode"); }
    memcpy(gud->mode, chosen, TUILE_GUD_MODE_BYTES);
    gud->width = (uint16_t)tuile_gud_get16(chosen + 4);
    gud->height = (uint16_t)tuile_gud_get16(chosen + 12);
    return TUILE_HAL_OK;
}

/* ---- life ------------------------------------------------------------------------------------------------------- */

static int allocate(tuile_gud_t *gud) {
    const size_t frame_bytes = 4u * (size_t)gud->width * gud->height; /* of the largest format */

    gud->stage = malloc(frame_bytes);
    if (gud->lz4) {
        gud->compressed = malloc(frame_bytes < gud->buffer_most_bytes ? frame_bytes : gud->buffer_most_bytes);
        gud->lz4_state = malloc((size_t)LZ4_sizeofState());
    }
    if (gud->stage && (!gud->lz4 || (gud->compressed && gud->lz4_state))) { return TUILE_HAL_OK; }
    return tuile_usb_fail(&gud->usb, TUILE_HAL_IO, "out of memory for a display of %u x %u", gud->width, gud->height);
}

int tuile_gud_open(tuile_gud_t *gud, const tuile_gud_config_t *config) {
    static const tuile_gud_config_t usual = {0};
    limits_t limits;
    int result;

    *gud = (tuile_gud_t){0};
    if (!config) { config = &usual; }
    if ((result = tuile_usb_open(&gud->usb, &kind,
                                 &(tuile_usb_choice_t){.serial = config->serial, .bus = config->bus, .address = config->address},
                                 config->timeout_ms ? config->timeout_ms : TIMEOUT_MS, gud->error_text))) {
        return result;
    }
    if ((result = read_display(gud, config, &limits)) || (result = read_formats(gud)) ||
        (result = read_properties(gud, TUILE_GUD_GET_PROPERTIES, 0)) || (result = choose_connector(gud, config)) ||
        (result = read_properties(gud, TUILE_GUD_GET_CONNECTOR_PROPERTIES, gud->connector)) ||
        (result = choose_mode(gud, config, &limits)) || (result = allocate(gud))) {
        tuile_gud_close(gud);
    }
    return result;
}

void tuile_gud_close(tuile_gud_t *gud) {
    tuile_usb_close(&gud->usb);
    free(gud->stage);
    free(gud->compressed);
    free(gud->lz4_state);
    gud->stage = gud->compressed = NULL;
    gud->lz4_state = NULL;
}

int tuile_gud_wait_for(const tuile_gud_config_t *config, uint32_t timeout_ms) {
    tuile_usb_choice_t choice = {0};

    if (config) { choice = (tuile_usb_choice_t){.serial = config->serial, .bus = config->bus, .address = config->address}; }
    return tuile_usb_wait_for(&kind, &choice, timeout_ms);
}
