/* A display that speaks GUD, the Generic USB Display protocol, as the protocol tells it. */
#ifndef SIM_GUD_MODEL_H
#define SIM_GUD_MODEL_H

#include "usb_model.h"

/* Numbers of the pixel formats on the wire. */
enum {
    SIM_GUD_R1 = 0x01,
    SIM_GUD_R8 = 0x08,
    SIM_GUD_XRGB1111 = 0x20,
    SIM_GUD_RGB332 = 0x30,
    SIM_GUD_RGB565 = 0x40,
    SIM_GUD_RGB888 = 0x50,
    SIM_GUD_XRGB8888 = 0x80,
};

/* What GET_STATUS says. */
enum {
    SIM_GUD_OK = 0,
    SIM_GUD_BUSY = 1,
    SIM_GUD_NOT_SUPPORTED = 2,
    SIM_GUD_PROTOCOL_ERROR = 3,
    SIM_GUD_INVALID_PARAMETER = 4,
    SIM_GUD_ERROR = 5,
    SIM_GUD_SILENT = 255, /* of sim_gud_break: nothing, an answer of no bytes */
};

enum { SIM_GUD_DISCONNECTED = 0, SIM_GUD_CONNECTED = 1, SIM_GUD_UNKNOWN = 2 };

#define SIM_GUD_FORMATS_MAX 8
#define SIM_GUD_MODES_MAX 8
#define SIM_GUD_CONNECTORS_MAX 2

/* Only read when the model is made, but for edid. Zero = default, throughout. */
typedef struct sim_gud_config {
    uint16_t width, height;               /* of the only mode; 0: 320 x 240 */
    uint16_t modes[SIM_GUD_MODES_MAX][2]; /* or several: width, height, ended by 0 */
    uint8_t preferred;                    /* which of them carries the flag, from 1; 0: none */

    uint8_t formats[SIM_GUD_FORMATS_MAX]; /* in the order that they are offered, ended by 0; none: all seven */
    uint32_t max_buffer_bytes;            /* 0: the host derives it from the mode */
    bool lz4;
    bool status_on_set; /* the flag: the host reads the status after each set */
    bool full_update;   /* the flag: whole frames without SET_BUFFER */

    bool backlight;                         /* the connectors have the property: 0 ... 100, 50 after reset */
    uint8_t rotations;                      /* the device has the property: mask of quarter turns, bit 0 = none; 0: it has not */
    uint8_t connectors;                     /* 1 or 2; 0: 1 */
    uint8_t status[SIM_GUD_CONNECTORS_MAX]; /* one more than SIM_GUD_...; 0: connected */
    const uint8_t *edid;                    /* outlives the model; NULL: none */
    uint16_t edid_bytes;                    /* a multiple of 128, at most 2048 */
    bool modes_from_edid;                   /* GET_MODES is answered by nothing */

    uint16_t vendor, product;    /* 0: 1D50:614D */
    uint8_t interface, endpoint; /* numbers; endpoint 0: 1 */
    uint16_t packet_bytes;       /* largest packet of the bulk endpoint; 0: 512 */
    const char *serial;          /* outlives the model; NULL: none */
    uint32_t magic;              /* for tests: the magic number that is told; 0: the right one */
    uint8_t version;             /* of the protocol; 0: 1 */
} sim_gud_config_t;

/* Readable: what arrived since the model was made, or since the caller zeroed it. */
typedef struct sim_gud_counts {
    uint32_t set_buffers, updates; /* updates: pixels that arrived whole */
    uint32_t compressed;           /* of them, by LZ4 */
    uint64_t payload_bytes;        /* of updates, as they came over the wire */
    uint64_t pixel_bytes;          /* the same after decompression */
    uint32_t checks, commits;
    uint32_t status_reads;
} sim_gud_counts_t;

/* A device that has just been plugged in, its picture noise. config may be NULL. NULL and one line in error without memory or for a
 * configuration that contradicts itself. Freed with usb->destroy(usb). */
sim_usb_t *sim_gud_create(const sim_gud_config_t *config, sim_error_t *error);

sim_gud_counts_t *sim_gud_counts(sim_usb_t *usb);

/* State that was committed. 0 before the first. */
typedef struct sim_gud_state {
    uint16_t width, height;
    uint8_t format, connector;
    uint8_t rotation;  /* quarter turns against the clock, as the protocol counts */
    uint8_t backlight; /* per cent */
    bool controller, display;
} sim_gud_state_t;
sim_gud_state_t sim_gud_state(const sim_usb_t *usb);

/* For faults: the status that all sets end with from now on; 0 ends it. */
void sim_gud_break(sim_usb_t *usb, uint8_t status);

#endif
