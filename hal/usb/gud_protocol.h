/* Numbers of the GUD protocol, and its requests. All fields are little-endian and packed. */
#ifndef TUILE_HAL_USB_GUD_PROTOCOL_H
#define TUILE_HAL_USB_GUD_PROTOCOL_H

#include "../wire.h"
#include "gud.h"

enum {
    TUILE_GUD_GET_STATUS = 0x00,
    TUILE_GUD_GET_DESCRIPTOR = 0x01,
    TUILE_GUD_GET_FORMATS = 0x40,
    TUILE_GUD_GET_PROPERTIES = 0x41,
    TUILE_GUD_GET_CONNECTORS = 0x50,
    TUILE_GUD_GET_CONNECTOR_PROPERTIES = 0x51,
    TUILE_GUD_SET_FORCE_DETECT = 0x53,
    TUILE_GUD_GET_CONNECTOR_STATUS = 0x54,
    TUILE_GUD_GET_MODES = 0x55,
    TUILE_GUD_GET_EDID = 0x56,
    TUILE_GUD_SET_BUFFER = 0x60,
    TUILE_GUD_SET_STATE_CHECK = 0x61,
    TUILE_GUD_SET_STATE_COMMIT = 0x62,
    TUILE_GUD_SET_CONTROLLER_ENABLE = 0x63,
    TUILE_GUD_SET_DISPLAY_ENABLE = 0x64,
};

enum { TUILE_GUD_BACKLIGHT = 12, TUILE_GUD_ROTATION = 50 }; /* properties: of the connector, of the device */

/* 0 for numbers that are not known here. */
uint8_t tuile_gud_wire(uint8_t format);
uint8_t tuile_gud_format(uint8_t wire);

/* Requests. On a fault the line in gud->error_text names the request, and the status that the device gives for it. value: the
 * connector, for requests about one. */

/* Reads at most `most` bytes; fewer than `least` are TUILE_HAL_PROTOCOL. count may be NULL. */
int tuile_gud_get(tuile_gud_t *gud, uint8_t request, uint16_t value, void *data, uint16_t least, uint16_t most, uint16_t *count);
int tuile_gud_set(tuile_gud_t *gud, uint8_t request, uint16_t value, void *data, uint16_t length);

/* After a fault of what was sent: the device's status goes into the line of text. Returns result, or TUILE_HAL_GONE if the device
 * no longer answers because it is gone. */
int tuile_gud_explain(tuile_gud_t *gud, int result, const char *what);

static inline uint8_t *tuile_gud_put16(uint8_t *to, uint32_t value) {
    to[0] = (uint8_t)value;
    to[1] = (uint8_t)(value >> 8);
    return to + 2;
}
static inline uint8_t *tuile_gud_put32(uint8_t *to, uint32_t value) {
    return tuile_gud_put16(tuile_gud_put16(to, value), value >> 16);
}
static inline uint32_t tuile_gud_get16(const uint8_t *from) { return from[0] | (uint32_t)from[1] << 8; }
static inline uint32_t tuile_gud_get32(const uint8_t *from) { return tuile_gud_get16(from) | tuile_gud_get16(from + 2) << 16; }

#endif
