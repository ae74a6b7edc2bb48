/* Fog: how much of a sample's colour its depth takes away.
 *
 * A depth z, in 1/65536 step, is 65528 * 65536 * near / w in perspective and 65536 * (8 + 65520 * (far - w) / (far - near)) in an
 * orthographic view, where near and far are the camera's. So the place x of a sample in the fog, (w - fog near) divided by
 * (fog far - fog near) or by the half-life, is a / z - b or b - a z. Both are made from all 32 bits of the depth, a / z by one
 * reciprocal, so that far ranges, which have few whole steps of depth, show no bands.
 *
 * Linear: the fog's share is x held to 0 ... 1. Exponential: 1 - 2^-x by a table of 2^-x in 1/64, linear between: its error is
 * below (ln 2 / 64)^2 / 8, 1/65536.
 *
 * Error: the share is within 1/8192 of the exact one as long as b < 256 (the fog begins at most 256 times its own length away),
 * less than 1/32 level; with the rounding of the colour a component is within 1/2 + 1/32 level. A nearer sample never has more fog
 * by more than 2 / 65536, the slack of the reciprocal.
 */
#ifndef TUILE_SURFACE_FOG_H
#define TUILE_SURFACE_FOG_H

#include "../fill/span.h"
#include "../tuile.h"

#define FOG_ONE 65536u

typedef struct fog {
    uint32_t rgb;  /* 0x00rrggbb */
    uint8_t kind;  /* tuile_fog_kind_t */
    bool inverse;  /* x = a / z - b, else b - a z; 1 / 65536 each */
    int16_t shift; /* a = mantissa * 2^shift, as fog_share has it */
    uint32_t mantissa;
    int64_t b;
} fog_t;

/* TUILE_ERROR_ARGUMENT for a kind that is none or distances out of the range that tuile_fog_t states. kind NONE: nothing is set but
 * the kind. */
int fog_make(fog_t *fog, const tuile_fog_t *from, const tuile_camera_t *camera);

/* The fog's share at a depth in 1/65536 step, 0 ... FOG_ONE. Depths below one step, which no face has, count as one step. */
uint32_t fog_share(const fog_t *fog, uint32_t depth);

/* What a colour that is blended so (tuile_blend_t) fades to: behind it all has its own fog already, so what is added fades to
 * black, and what multiplies to white. */
TUILE_INLINE uint32_t fog_goal(const fog_t *fog, uint8_t blend) {
    return blend == TUILE_BLEND_ADD ? 0 : blend == TUILE_BLEND_MULTIPLY ? 0xffffffu : fog->rgb;
}

/* A colour 0xaarrggbb at a depth, fading to another, 0x00rrggbb; its alpha stays. */
uint32_t fog_fade(const fog_t *fog, uint32_t depth, uint32_t argb, uint32_t to);

/* The same, into the fog itself. */
TUILE_INLINE uint32_t fog_apply(const fog_t *fog, uint32_t depth, uint32_t argb) { return fog_fade(fog, depth, argb, fog->rgb); }

#endif
