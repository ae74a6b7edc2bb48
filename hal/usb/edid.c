#include "edid.h"

#include <string.h>

#include "gud_protocol.h"

enum { BLOCK_BYTES = 128, FIRST_TIMING = 54, TIMING_BYTES = 18, TIMINGS = 4 };
enum { INTERLACED = 0x80, SYNC_KIND = 0x18, VERTICAL_POSITIVE = 0x04, HORIZONTAL_POSITIVE = 0x02 };

/* VESA E-EDID, 3.10.2: the high bits of the numbers stand apart from the low ones. */
static void convert(const uint8_t *timing, bool preferred, uint8_t mode[TUILE_GUD_MODE_BYTES]) {
    const uint32_t width = timing[2] | (timing[4] & 0xF0u) << 4, blank_x = timing[3] | (timing[4] & 0x0Fu) << 8;
    const uint32_t height = timing[5] | (timing[7] & 0xF0u) << 4, blank_y = timing[6] | (timing[7] & 0x0Fu) << 8;
    const uint32_t front_x = timing[8] | (timing[11] & 0xC0u) << 2, sync_x = timing[9] | (timing[11] & 0x30u) << 4;
    const uint32_t front_y = timing[10] >> 4 | (timing[11] & 0x0Cu) << 2, sync_y = (timing[10] & 0x0Fu) | (timing[11] & 0x03u) << 4;
    uint32_t flags = preferred ? 1u << 10 : 0;

    if ((timing[17] & SYNC_KIND) == SYNC_KIND) { /* separate syncs, whose signs are known */
        flags |= timing[17] & HORIZONTAL_POSITIVE ? 1u : 2u;
        flags |= timing[17] & VERTICAL_POSITIVE ? 4u : 8u;
    }
    mode = tuile_gud_put32(mode, 10u * tuile_gud_get16(timing)); /* from 10 kHz to kHz */
    mode = tuile_gud_put16(tuile_gud_put16(mode, width), width + front_x);
    mode = tuile_gud_put16(tuile_gud_put16(mode, width + front_x + sync_x), width + blank_x);
    mode = tuile_gud_put16(tuile_gud_put16(mode, height), height + front_y);
    mode = tuile_gud_put16(tuile_gud_put16(mode, height + front_y + sync_y), height + blank_y);
    tuile_gud_put32(mode, flags);
}

unsigned tuile_edid_modes(const uint8_t *edid, size_t size_bytes, uint8_t modes[4][TUILE_GUD_MODE_BYTES]) {
    static const uint8_t header[8] = {0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0};
    unsigned count = 0;
    uint8_t sum = 0;

    if (size_bytes < BLOCK_BYTES || memcmp(edid, header, sizeof header)) { return 0; }
    for (unsigned i = 0; i < BLOCK_BYTES; i++) {
        sum = (uint8_t)(sum + edid[i]);
    }
    if (sum) { return 0; }
    for (unsigned i = 0; i < TIMINGS; i++) {
        const uint8_t *timing = edid + FIRST_TIMING + i * TIMING_BYTES;
        if (!tuile_gud_get16(timing) || timing[17] & INTERLACED) { continue; } /* no clock: it is text or a range */
        convert(timing, count == 0, modes[count]);
        count++;
    }
    return count;
}
