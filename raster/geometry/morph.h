/* Between two key frames: positions and normals of a cluster, a part of the way from the first to the second.
 *
 * A position goes straight: a + (b - a) * morph / TUILE_MORPH_ONE, cut to 1/256 step, so that it moves by less than a pixel's
 * sixteenth at a time as long as a step is smaller than 16 pixels. It is never more than 1/256 step from the exact place, and lies
 * in the box of its two ends. A normal takes the direction of the straight mixture of its ends, at full length: rounding turns it
 * by 0.4 degrees at most, as it does in the model. Where the ends are opposite there is no direction half way, and no light.
 */
#ifndef TUILE_GEOMETRY_MORPH_H
#define TUILE_GEOMETRY_MORPH_H

#include "../tuile.h"

/* One coordinate in 1/256 step. a, b: of the key frames, in steps; fraction: 1/256 step, of both; morph: 0 ... TUILE_MORPH_ONE.
 * |b - a| * morph <= 65535 * 32768 < 2^31. */
static inline int32_t morph_coordinate(int16_t a, int16_t b, int8_t fraction, uint16_t morph) {
    return 256 * a + fraction + (((b - a) * (int32_t)morph) >> 7);
}

/* 3 x count coordinates, as whole steps and fractions of them in 1/256. fractions: of both key frames; NULL: none. */
void morph_positions(const int16_t *a, const int16_t *b, const int8_t *fractions, unsigned count, uint16_t morph, int16_t *whole,
                     int8_t *fraction);

/* count normals of 3 x int8. */
void morph_normals(const int8_t *a, const int8_t *b, unsigned count, uint16_t morph, int8_t *out);

#endif
