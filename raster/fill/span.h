/* The tile that is being drawn, and the innermost loops: pixels first ... first + count - 1 of one row, depth tested.
 *
 * Depth is Q16.16 with the rounding half added; only its upper half is compared and kept. A face wins a pixel when it is nearer
 * than what is there; on a tie the first one stays, or with `last` the later one takes over.
 */
#ifndef TUILE_FILL_SPAN_H
#define TUILE_FILL_SPAN_H

#include "../fixed.h"

#include <stddef.h>

typedef struct raster_tile {
    uint16_t *depth;                  /* stride_px * height */
    void *colour;                     /* the same number of pixels, 2 or 4 bytes each */
    int32_t left, top, right, bottom; /* pixels of the window: left ... right - 1 */
    int32_t stride_px;
} raster_tile_t;

/* What every state that is carried from one row of tiles to the next begins with. */
typedef struct fill_head {
    uint16_t size_bytes;
    uint16_t record;     /* the face's record: it orders faces, and tells colour and vertices */
    int16_t row_end;     /* the face covers no row from here on */
    int16_t left, right; /* pixels that it may touch: left ... right - 1 */
} fill_head_t;

typedef enum span_kind { SPAN_FLAT, SPAN_GOURAUD, SPAN_IDS } span_kind_t;

TUILE_INLINE bool span_wins(uint16_t depth, uint16_t stored, bool last) { return last ? depth >= stored : depth > stored; }

TUILE_INLINE void span_flat(uint16_t *depth, uint16_t *colour, int32_t count, uint32_t z, uint32_t dz, uint16_t value, bool last) {
    for (int32_t i = 0; i < count; i++) {
        const uint16_t near = (uint16_t)(z >> 16);
        if (span_wins(near, depth[i], last)) {
            depth[i] = near;
            colour[i] = value;
        }
        z += dz;
    }
}

/* shade: depth Q16.16 in the upper half, light Q8.24 in the lower; ramp: 64 colours. */
TUILE_INLINE void span_gouraud(uint16_t *depth, uint16_t *colour, int32_t count, uint64_t shade, uint64_t dx, const uint16_t *ramp,
                               bool last) {
    for (int32_t i = 0; i < count; i++) {
        const uint16_t z = (uint16_t)(shade >> 48);
        if (span_wins(z, depth[i], last)) {
            depth[i] = z;
            colour[i] = ramp[(uint32_t)shade >> 26];
        }
        shade += dx;
    }
}

TUILE_INLINE void span_ids(uint16_t *depth, uint32_t *ids, int32_t count, uint32_t z, uint32_t dz, uint32_t id, bool last) {
    for (int32_t i = 0; i < count; i++) {
        const uint16_t near = (uint16_t)(z >> 16);
        if (span_wins(near, depth[i], last)) {
            depth[i] = near;
            ids[i] = id;
        }
        z += dz;
    }
}

#endif
