/* Texels at coordinates. Textures whose sides are powers of two and which repeat, the usual ones, have loops of their own: a mask
 * brings a coordinate in. */
#include "../tune.h"

#include "texture.h"

/* ---- one coordinate of a level ---- */

typedef struct axis {
    uint32_t size, whole; /* of the level, of level 0 */
    unsigned shift;       /* the level's number */
    bool clamp, halved;   /* size is exactly whole / 2^shift */
} axis_t;

static axis_t axis_of(uint32_t size, uint32_t whole, unsigned number, bool clamp) {
    return (axis_t){size, whole, number, clamp, size << number == whole};
}

/* Texels of level 0 to texels of the level, both Q16.16. Where sides were rounded down the period is another one: the coordinate
 * is brought in first. */
static int32_t to_level(const axis_t *axis, int32_t at) {
    if (axis->halved) { return at >> axis->shift; }
    const int64_t whole = (int64_t)axis->whole << 16;
    int64_t in = at;
    if (axis->clamp) {
        in = in < 0 ? 0 : in >= whole ? whole - 1 : in;
    } else {
        in %= whole;
        in += in < 0 ? whole : 0;
    }
    return (int32_t)(in * axis->size / axis->whole);
}

/* A whole texel into 0 ... size - 1. */
TUILE_INLINE uint32_t bring_in(const axis_t *axis, int32_t at) {
    const int32_t size = (int32_t)axis->size;
    if ((uint32_t)at < axis->size) { return (uint32_t)at; }
    if (axis->clamp) { return at < 0 ? 0 : axis->size - 1; }
    const int32_t rest = at % size;
    return (uint32_t)(rest < 0 ? rest + size : rest);
}

/* ---- any texture ---- */

static void fetch_nearest(const tuile_texture_t *texture, const texture_level_t *level, const axis_t axis[2], const int32_t *s,
                          const int32_t *t, int32_t count, uint32_t *argb) {
    for (int32_t i = 0; i < count; i++) {
        argb[i] = texture_level_texel(texture, level, bring_in(&axis[0], to_level(&axis[0], s[i]) >> 16),
                                      bring_in(&axis[1], to_level(&axis[1], t[i]) >> 16));
    }
}

/* a + (b - a) * part / 256 of all four components, two at a time; part 0 ... 255. */
TUILE_INLINE uint32_t between(uint32_t a, uint32_t b, uint32_t part) {
    const uint32_t even = ((a & 0xff00ffu) * (256u - part) + (b & 0xff00ffu) * part + 0x800080u) >> 8 & 0xff00ffu;
    const uint32_t odd = ((a >> 8 & 0xff00ffu) * (256u - part) + (b >> 8 & 0xff00ffu) * part + 0x800080u) & 0xff00ff00u;
    return even | odd;
}

/* A texel that is not there has no colour: it takes that of the other one, and fades. */
TUILE_INLINE uint32_t mixed(uint32_t a, uint32_t b, uint32_t part) {
    if (a >> 24 == 0) { a = b & 0xffffffu; }
    if (b >> 24 == 0) { b = a & 0xffffffu; }
    return between(a, b, part);
}

static void fetch_bilinear(const tuile_texture_t *texture, const texture_level_t *level, const axis_t axis[2], const int32_t *s,
                           const int32_t *t, int32_t count, uint32_t *argb) {
    for (int32_t i = 0; i < count; i++) {
        const int32_t at_s = (int32_t)((uint32_t)to_level(&axis[0], s[i]) - 0x8000u),
                      at_t = (int32_t)((uint32_t)to_level(&axis[1], t[i]) - 0x8000u);
        const uint32_t s0 = bring_in(&axis[0], at_s >> 16), s1 = bring_in(&axis[0], (at_s >> 16) + 1);
        const uint32_t t0 = bring_in(&axis[1], at_t >> 16), t1 = bring_in(&axis[1], (at_t >> 16) + 1);
        const uint32_t across = (uint32_t)at_s >> 8 & 255u, down = (uint32_t)at_t >> 8 & 255u;
        const uint32_t upper =
            mixed(texture_level_texel(texture, level, s0, t0), texture_level_texel(texture, level, s1, t0), across);
        const uint32_t lower =
            mixed(texture_level_texel(texture, level, s0, t1), texture_level_texel(texture, level, s1, t1), across);
        argb[i] = mixed(upper, lower, down);
    }
}

/* ---- the usual ones ---- */

static bool is_power(uint32_t size) { return (size & (size - 1)) == 0; }

static void fetch_powers(const tuile_texture_t *texture, const texture_level_t *level, unsigned number, const int32_t *s,
                         const int32_t *t, int32_t count, uint32_t *argb) {
    const uint32_t mask_s = level->width - 1u, mask_t = level->height - 1u;
    const unsigned shift = 16 + number;
    for (int32_t i = 0; i < count; i++) {
        argb[i] = texture_level_texel(texture, level, (uint32_t)(s[i] >> shift) & mask_s, (uint32_t)(t[i] >> shift) & mask_t);
    }
}

void texture_fetch(const texture_plane_t *plane, const texture_level_t *level, unsigned number, const int32_t *s, const int32_t *t,
                   int32_t count, uint32_t *argb) {
    const tuile_texture_t *texture = &plane->texture;
    const axis_t axis[2] = {axis_of(level->width, texture->width, number, texture->flags & TUILE_TEXTURE_CLAMP_S),
                            axis_of(level->height, texture->height, number, texture->flags & TUILE_TEXTURE_CLAMP_T)};
    if (plane->bilinear) {
        fetch_bilinear(texture, level, axis, s, t, count, argb);
    } else if (!axis[0].clamp && !axis[1].clamp && axis[0].halved && axis[1].halved && is_power(level->width) &&
               is_power(level->height)) {
        fetch_powers(texture, level, number, s, t, count, argb);
    } else {
        fetch_nearest(texture, level, axis, s, t, count, argb);
    }
}

#define RUN 32

void texture_run(const texture_plane_t *plane, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    int32_t s[RUN], t[RUN];
    texture_coordinates(plane, x, y, count, s, t);
    if (!plane->perspective || !plane->mips) {
        texture_fetch(plane, &plane->level, plane->level_number, s, t, count, argb);
        return;
    }
    for (int32_t i = 0; i < count;) {
        const int32_t next = ((x + i) & -TEXTURE_BLOCK) + TEXTURE_BLOCK - x, end = next < count ? next : count;
        const unsigned number = texture_level_at(plane, x + i, y);
        const texture_level_t level = number == plane->level_number ? plane->level : texture_level(&plane->texture, number);
        texture_fetch(plane, &level, number, s + i, t + i, end - i, argb + i);
        i = end;
    }
}
