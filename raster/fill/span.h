/* The tile that is being drawn, and the innermost loops: pixels first ... first + count - 1 of one row.
 *
 * Tested spans: depth is Q16.16 with the rounding half added; only its upper half is compared and kept. A face wins a pixel when it
 * is nearer than what is there; on a tie the first one stays, or with `last` the later one takes over.
 * Painted spans ask for no depth and overwrite what is there.
 */
#ifndef TUILE_FILL_SPAN_H
#define TUILE_FILL_SPAN_H

#include "../fixed.h"

#include <stddef.h>

typedef struct raster_tile {
    uint16_t *depth;                  /* stride_px * height; for tested spans only */
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

/* The depth of a face at the centre of any pixel (x, y): z + x dx + y dy, Q.16 with the rounding half, held between low and high: a
 * polygon's corners need not lie in one plane after snapping. Of triangles the pixels of the face need no holding. */
typedef struct depth_plane {
    int64_t z, dx, dy;
    uint32_t low, high;
} depth_plane_t;

/* |x|, |y| <= 2048. For pixels of the face this is the very depth that its tested spans compare. Modulo 2^64, since a sliver's
 * gradients are beyond all bounds where the sliver is not. */
TUILE_INLINE uint16_t depth_at(const depth_plane_t *plane, int32_t x, int32_t y) {
    const int64_t z =
        (int64_t)((uint64_t)plane->z + (uint64_t)plane->dx * (uint64_t)(int64_t)x + (uint64_t)plane->dy * (uint64_t)(int64_t)y);
    return (uint16_t)((z < plane->low ? plane->low : z > plane->high ? plane->high : (uint32_t)z) >> 16);
}

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

/* Two colours at once where a span is long enough to pay for aligning. Words and half words are stored to the same pixels, which
 * the compiler must not take for different objects. */
#if defined(__GNUC__)
typedef uint32_t __attribute__((may_alias)) span_word_t;
#else
typedef uint32_t span_word_t;
#endif

TUILE_INLINE void paint_flat(uint16_t *colour, int32_t count, uint16_t value) {
    if (count >= 8) {
        const uint32_t both = value * 0x10001u;
        if ((uintptr_t)colour & 2u) {
            *colour++ = value;
            count--;
        }
        for (; count >= 8; count -= 8, colour += 8) {
            span_word_t *word = (span_word_t *)(void *)colour;
            word[0] = both;
            word[1] = both;
            word[2] = both;
            word[3] = both;
        }
    }
    for (; count > 0; count--) {
        *colour++ = value;
    }
}

/* light: Q8.24. */
TUILE_INLINE void paint_gouraud(uint16_t *colour, int32_t count, uint32_t light, uint32_t dx, const uint16_t *ramp) {
    for (int32_t i = 0; i < count; i++) {
        colour[i] = ramp[light >> 26];
        light += dx;
    }
}

TUILE_INLINE void paint_ids(uint32_t *ids, int32_t count, uint32_t id) {
    for (int32_t i = 0; i < count; i++) {
        ids[i] = id;
    }
}

#endif
