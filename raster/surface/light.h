/* Light of faces that is not white, or not light alone: colours, emission, highlights and vertex colours.
 *
 * At each corner a channel is min(1, light + emission) * vertex colour; the highlight is that of the corner times the material's
 * level. What differs between corners is affine over the face. So of light and vertex colour the product is interpolated, which is
 * the product of what is interpolated wherever one of them is the same all over.
 *
 * Channels are Q9.23 and stand 64 levels too high, so that no rounding wraps: value = (v >> 23) - 64, held to 0 ... 255. Gradients
 * of faces within 32 pixels come from one 31-bit reciprocal: |num| < 2^18, so 2^-13 level a sixteenth of a pixel, over 2 * 512 of
 * these 1/8 level; others are exact quotients, floored, 2^-23 level a pixel. With the rounding to the nearest a channel is within
 * 1/2 + 1/8 + 1/64 level of the exact plane through the snapped corners, at every pixel of the face, slivers' too: planes are taken
 * modulo 2^32, and there the value is one between the corners'.
 *
 * A polygon that was not cut into triangles has the values of its first corner.
 */
#ifndef TUILE_SURFACE_LIGHT_H
#define TUILE_SURFACE_LIGHT_H

#include "surface.h"

enum { LIGHT_CHANNELS = 1, LIGHT_HIGHLIGHT = 2, LIGHT_ALPHA = 4 };

/* Is the face of this kind? Else its light is one number a corner. */
bool light_is_coloured(const surface_face_t *face);

/* What varies over the face, LIGHT_... or-ed: sets those of surface->channel. factor: red, green, blue where they are the same all
 * over, else 255. */
unsigned light_make(surface_t *surface, const surface_face_t *face, uint8_t factor[3]);

/* A plane through three values 0 ... 255 at corners whose area is not 0. */
light_plane_t light_plane(const surface_corner_t corner[3], const uint8_t value[3]);

TUILE_INLINE uint32_t light_held(uint32_t v) {
    const int32_t level = (int32_t)(v >> 23) - 64;
    return level < 0 ? 0 : level > 255 ? 255u : (uint32_t)level;
}

/* Stages: light on what is there; highlights over it; the alpha of vertex colours times what is there. */
void light_stage_channels(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb);
void light_stage_highlight(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb);
void light_stage_alpha(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb);

#endif
