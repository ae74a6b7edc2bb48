/* The inside of the compact renderer. */
#ifndef TUILE_COMPACT_INSIDE_H
#define TUILE_COMPACT_INSIDE_H

#include "../fixed.h"
#include "compact.h"

#define COMPACT_RING (TUILE_COMPACT_CORNERS + 2u)
#define COMPACT_OUTSIDE INT16_MIN

/* A face in the window: the corners of a polygon, in order. */
typedef struct compact_ring {
    tuile_compact_point_t point[COMPACT_RING];
    uint32_t depth[COMPACT_RING]; /* 1/256 step */
    uint8_t count;
} compact_ring_t;

/* ---- project.c ---- */

/* Fine coordinates, as transform_row_t has them. */
typedef struct compact_place {
    int64_t x, y, w;
} compact_place_t;

/* Position q + f / 256; f may be NULL. */
compact_place_t compact_place(const tuile_compact_view_t *view, const int16_t q[3], const int8_t *f);

/* A place in the window. False outside near plane, far plane or guard band; clamp: what is beyond the guard span is moved to its
 * edge instead. */
bool compact_project(const tuile_compact_view_t *view, const compact_place_t *place, bool clamp, tuile_compact_point_t *point,
                     uint32_t *depth);

/* All vertices of the model. */
void compact_vertices(tuile_compact_t *compact);

/* Reads vertex `number` of the model. False: f is zero. */
bool compact_position(const tuile_compact_t *compact, uint16_t number, int16_t q[3], int8_t f[3]);

/* ---- clip.c ---- */

/* The face with these vertices of the model, of which some are outside, cut to what is inside. False: it has too many corners then.
 * ring->count may be 0. */
bool compact_clip(const tuile_compact_t *compact, const uint16_t *numbers, uint8_t count, compact_ring_t *ring);

/* ---- side.c ---- */

/* Is the front of a polygon seen, as its plane tells? outward: its normal in the model. */
bool compact_plane_front(const tuile_compact_t *compact, const uint16_t *numbers, uint8_t count,
                         const TUILE_FLASH uint8_t *outward);

/* ---- fill.c ---- */

/* Black where Bayer's number of a pixel is below this: 0 (white) ... 64 (black). luma: 65535 = white. */
uint8_t compact_level(uint16_t luma);

/* A tile of background. */
void compact_clear(tuile_compact_t *compact);

/* The rows of the tile that the ring may cover pixels of; false: none. */
bool compact_rows(const tuile_compact_t *compact, const compact_ring_t *ring, int16_t *first, int16_t *end);

/* The ring's pixels in these rows of the tile. By z-buffer, or over whatever is there. */
void compact_fill(tuile_compact_t *compact, const compact_ring_t *ring, int16_t first, int16_t end, uint8_t level);

#endif
