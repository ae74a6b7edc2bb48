/* Coloured and point lights, and highlights, at a point of an instance: everything in the model's space, so that vertices need not
 * be moved. Made anew for each instance; for scenes in white directional light geometry/vertex.h has a shorter way.
 *
 *   light     = ambient + sum over lights of intensity * colour * falloff * max(0, N . L)
 *   highlight = sum over lights that N faces of intensity * (greatest component of colour) * falloff * (N . H)^(2^shininess)
 *   H         = (L + V) / |L + V|, Blinn and Phong's, V the way to the eye; in an orthographic view V is the same everywhere
 *   falloff   = 1 for directional lights, (1 - d^2 / range^2)^2 for points, 0 from range on
 *
 * For N . L a normal is taken as long as it is stored, 127 = 1, as the short way does; for N . H it is brought to unit length, for
 * the power would make much of a length that is 1/127 off.
 *
 * Errors. Unit vectors Q.20 within 2^-18; falloff within 2^-13; so light is within 1/2 + 1/32 level for one light and 1/32 more for
 * each other one. N . H is within 2^-18, its 128th power within 2^-11: highlights likewise within 1/2 + 1/4 level for the first.
 */
#ifndef TUILE_GEOMETRY_LAMP_H
#define TUILE_GEOMETRY_LAMP_H

#include "transform.h"

typedef struct lamp {
    int64_t at[3];      /* point: 1/256 step * 2^shift */
    int32_t toward[3];  /* directional: unit vector, Q.20 */
    uint16_t colour[3]; /* 1/256 level, at most 65280 */
    uint16_t greatest;  /* of colour */
    uint32_t range;     /* point: in the units of `at`, 2^29 ... 2^30 - 1 */
    uint32_t per_range; /* 2^48 / (range^2 / 2^28) */
    int16_t shift;      /* at most 36 */
    bool point;
} lamp_t;

typedef struct lamps {
    uint32_t ambient[3]; /* 1/65536 level */
    int32_t eye[3];      /* perspective: steps * 2^eye_bits; else the way to the observer, Q.20 */
    int16_t eye_bits;
    bool perspective;
    uint16_t count; /* of the lights that can be seen at all */
    lamp_t lamp[];
} lamps_t;

#define LAMPS_BYTES(count) (sizeof(lamps_t) + (size_t)(count) * sizeof(lamp_t))

/* lamps: room for all lights of the scene, whose kinds and ranges are right; transform: made for the instance. */
void lamps_make(lamps_t *lamps, const tuile_scene_t *scene, const tuile_instance_t *instance, const transform_t *transform);

typedef struct lamp_point {
    int32_t at[3];    /* 1/256 step, |.| <= 2^24 */
    int8_t normal[3]; /* 127 = 1.0 */
    bool both_sides;  /* lit from behind as from before */
    int8_t shininess; /* log2 of the exponent, 0 ... 7; -1: no highlight is wanted */
} lamp_point_t;

/* Red, green, blue, highlight: 255 = 1.0, more is held at 255. */
void lamps_light(const lamps_t *lamps, const lamp_point_t *point, uint8_t light[4]);

/* 1 / sqrt(x) = result * 2^-(62 - *half), x > 0; 2^30 - 8 <= result <= 2^31, relative error below 2^-27. */
uint32_t lamp_inverse_root(uint64_t x, unsigned *half);

#endif
