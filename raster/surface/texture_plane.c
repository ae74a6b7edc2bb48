/* Texture coordinates: planes and what is computed from them.
 *
 * Perspective planes. Coordinates are taken from the first corner, rounded to 18 bits with the sign: half a unit is the 2^18th part
 * of what the face is across, 1/8 texel for 32768. The depth has 24 bits, whole, so u = s * depth has 41. Gradients are exact
 * quotients, floored; that of q with 18 bits of fraction:
 *     |2 * 2^42 * 2^15| << 4 < 2^63,  |2 * 2^25 * 2^15| << 22 < 2^64.
 * Over 2 * 2048 pixels floors are off by 2^12 in u, which is 2^12 / q units: 1/16 of a unit where the face is 256 times as far as
 * at its nearest; and by 2^12 / 2^18 in q, so that s is off by 2^-22 of itself there.
 */
#include "../tune.h"

#include "texture_affine.h"

#include "../divide.h"

#define S_BITS 18u
#define Q_BITS 24u
#define Q_FRACTION 18u

/* ---- perspective ---- */

static texture_affine64_t gradient64(const texture_frame_t *f, const texture_corner_t *a, int64_t c0, int64_t c1, int64_t c2,
                                     unsigned fraction) {
    c1 -= c0;
    c2 -= c0;
    const int64_t nx = c2 * f->y1 - c1 * f->y2, ny = c1 * f->x2 - c2 * f->x1;
    const gradient_t g = {fixed_floor_div64(fixed_shift_left64(nx, 4 + fraction), f->area),
                          fixed_floor_div64(fixed_shift_left64(ny, 4 + fraction), f->area)};
    return (texture_affine64_t){texture_origin(g, fixed_shift_left64(c0, fraction), a), g.dx, g.dy};
}

#define CUT_LEAST 14

TUILE_INLINE int32_t cut_off(int32_t x, int bits) { return bits > 0 ? (x + (1 << (bits - 1))) >> bits : x * (1 << -bits); }

static TUILE_NOINLINE void perspective_make(texture_plane_t *plane, const texture_frame_t *f, const texture_corner_t *corner[3],
                                            uint32_t least, uint32_t most) {
    const texture_span3_t s = texture_span3(corner[0]->s, corner[1]->s, corner[2]->s),
                          t = texture_span3(corner[0]->t, corner[1]->t, corner[2]->t);
    const uint32_t across = (uint32_t)(s.most - s.least), down = (uint32_t)(t.most - t.least),
                   wide = (across > down ? across : down) | 1u;
    int64_t q[3], u[3], v[3];
    const unsigned n = fixed_clz32(most);
    /* Of Q.8 texels `cut` bits are rounded off, or zeros appended. */
    const int bits = 33 - (int)S_BITS - (int)fixed_clz32(wide), cut = bits < -CUT_LEAST ? -CUT_LEAST : bits;
    for (unsigned i = 0; i < 3; i++) {
        const int32_t ds = corner[i]->s - corner[0]->s, dt = corner[i]->t - corner[0]->t;
        q[i] = (int64_t)(((uint64_t)corner[i]->depth << n) >> (32 - Q_BITS));
        u[i] = q[i] * cut_off(ds, cut);
        v[i] = q[i] * cut_off(dt, cut);
    }
    plane->perspective = true;
    plane->u = gradient64(f, corner[0], u[0], u[1], u[2], 0);
    plane->v = gradient64(f, corner[0], v[0], v[1], v[2], 0);
    plane->q = gradient64(f, corner[0], q[0], q[1], q[2], Q_FRACTION);
    plane->s0 = corner[0]->s * 256;
    plane->t0 = corner[0]->t * 256;
    /* texels Q16.16 = u / (q / 2^18) * 2^cut * 2^8 */
    plane->shift = (int8_t)(8 + (int)Q_FRACTION + cut);
    const int64_t q_least = (int64_t)(((uint64_t)least << n) >> (32 - Q_BITS));
    plane->q_least = (q_least > 1 ? q_least : 1) << (Q_FRACTION - 1);
    for (unsigned i = 0; plane->mips && i < 3; i++) {
        plane->level_q += texture_log2((uint64_t)(q[i] > 1 ? q[i] : 1) << Q_FRACTION);
    }
}

void texture_plane_make(texture_plane_t *plane, const tuile_texture_t *texture, const texture_corner_t corner[3],
                        texture_wish_t wish) {
    const texture_corner_t *turned[3] = {&corner[0], &corner[1], &corner[2]};
    texture_frame_t f = {
        corner[1].x - corner[0].x, corner[1].y - corner[0].y, corner[2].x - corner[0].x, corner[2].y - corner[0].y, 0, false};
    f.area = f.x2 * f.y1 - f.x1 * f.y2;
    if (f.area < 0) {
        turned[1] = &corner[2];
        turned[2] = &corner[1];
        f = (texture_frame_t){f.x2, f.y2, f.x1, f.y1, -f.area, false};
    }
    if (f.area == 0) { f.area = 1; } /* such a face has no pixel: any plane will do, but not a division by 0 */
    const texture_span3_t x = texture_span3(0, f.x1, f.x2), y = texture_span3(0, f.y1, f.y2);
    f.is_short = x.most - x.least < SHORT_SIDE && y.most - y.least < SHORT_SIDE;
    plane->texture = *texture;
    plane->bilinear = wish.bilinear;
    plane->mips = wish.mips && texture->levels > 1;
    plane->level_q = plane->mips ? texture_level_plane(corner, f.area) : 0;
    plane->level_number = (uint8_t)(plane->mips ? texture_level_held(plane->level_q, texture->levels) : 0);
    plane->level = texture_level(texture, plane->level_number);
    const bool is_triangle = wish.most == 0; /* else three corners do not tell how far apart depths and coordinates are */
    if (!wish.perspective || wish.affine || (is_triangle ? texture_affine_will_do(corner) : wish.least == wish.most)) {
        texture_affine_make(plane, &f, turned[0], turned[1], turned[2]);
        return;
    }
    const uint32_t a = corner[0].depth, b = corner[1].depth, c = corner[2].depth;
    perspective_make(plane, &f, turned, is_triangle ? (a < b ? (a < c ? a : c) : (b < c ? b : c)) : wish.least,
                     is_triangle ? (a > b ? (a > c ? a : c) : (b > c ? b : c)) : wish.most);
}

/* ---- coordinates ---- */

typedef struct place {
    int32_t s, t; /* Q16.16 */
    int64_t q;
} place_t;

/* The value of a plane at a pixel. */
TUILE_INLINE int64_t at64(const texture_affine64_t *p, int32_t x, int32_t y) {
    return (int64_t)((uint64_t)p->v + (uint64_t)p->dx * (uint64_t)(int64_t)x + (uint64_t)p->dy * (uint64_t)(int64_t)y);
}

#define Q_MOST ((int64_t)1 << (Q_BITS + Q_FRACTION))

TUILE_INLINE uint64_t q_held(const texture_plane_t *plane, int64_t q) {
    return (uint64_t)(q < plane->q_least ? plane->q_least : q > Q_MOST ? Q_MOST : q);
}

/* Exact but for the roundings above. Beyond the face, where q may be anything, place.q tells whether the rest is right: not where
 * it is below q_least or above Q_MOST. */
static place_t place_at(const texture_plane_t *plane, int32_t x, int32_t y) {
    place_t place;
    place.q = at64(&plane->q, x, y);
    const uint64_t q = q_held(plane, place.q);
    const unsigned n = fixed_clz64(q);                       /* 21 ... 45 */
    uint32_t r = fixed_reciprocal((uint32_t)(q << n >> 32)); /* 1 / q = r * 2^(n - 94) */
    if (r > INT32_MAX) { r = INT32_MAX; }
    const unsigned shift = (unsigned)(94 - (int)n - plane->shift); /* 16 ... 61 */
    const int64_t s = fixed_mul_shift(at64(&plane->u, x, y), (int32_t)r, shift),
                  t = fixed_mul_shift(at64(&plane->v, x, y), (int32_t)r, shift);
    if (s != (int32_t)s || t != (int32_t)t) { place.q = 0; }
    place.s = (int32_t)((uint32_t)plane->s0 + (uint32_t)s);
    place.t = (int32_t)((uint32_t)plane->t0 + (uint32_t)t);
    return place;
}

unsigned texture_level_at(const texture_plane_t *plane, int32_t x, int32_t y) {
    const uint64_t q = q_held(plane, at64(&plane->q, (x & -TEXTURE_BLOCK) + TEXTURE_BLOCK / 2, y));
    return texture_level_held(plane->level_q - 3 * texture_log2(q), plane->texture.levels);
}

#define BLOCK TEXTURE_BLOCK
#define BLOCK_BITS 4
_Static_assert(BLOCK == 1 << BLOCK_BITS, "BLOCK_BITS");

/* Is what lies between two places of a block linear within a quarter texel? */
TUILE_INLINE bool block_linear(const texture_plane_t *plane, const place_t *a, const place_t *b) {
    const int64_t least = a->q < b->q ? a->q : b->q, most = a->q < b->q ? b->q : a->q;
    if (least < plane->q_least || most > Q_MOST) { return false; }
    const int32_t ds = (int32_t)((uint32_t)b->s - (uint32_t)a->s), dt = (int32_t)((uint32_t)b->t - (uint32_t)a->t);
    const uint32_t across = ds < 0 ? 0u - (uint32_t)ds : (uint32_t)ds, down = dt < 0 ? 0u - (uint32_t)dt : (uint32_t)dt;
    return (uint64_t)((most - least) >> 11) * (across > down ? across : down) <= (uint64_t)(least >> 11) << 16;
}

static void perspective_coordinates(const texture_plane_t *plane, int32_t x, int32_t y, int32_t count, int32_t *s, int32_t *t) {
    const int32_t end = x + count;
    int32_t block = x & -BLOCK;
    place_t from = place_at(plane, block, y);
    while (x < end) {
        const int32_t next = block + BLOCK, stop = next < end ? next : end;
        const place_t to = place_at(plane, next, y);
        if (block_linear(plane, &from, &to)) {
            const int32_t ds = (int32_t)((uint32_t)to.s - (uint32_t)from.s) >> BLOCK_BITS,
                          dt = (int32_t)((uint32_t)to.t - (uint32_t)from.t) >> BLOCK_BITS;
            uint32_t at_s = (uint32_t)from.s + (uint32_t)(ds * (x - block)), at_t = (uint32_t)from.t + (uint32_t)(dt * (x - block));
            for (; x < stop; x++, at_s += (uint32_t)ds, at_t += (uint32_t)dt) {
                *s++ = (int32_t)at_s;
                *t++ = (int32_t)at_t;
            }
        } else {
            for (; x < stop; x++) {
                const place_t place = place_at(plane, x, y);
                *s++ = place.s;
                *t++ = place.t;
            }
        }
        block = next;
        from = to;
    }
}

void texture_coordinates(const texture_plane_t *plane, int32_t x, int32_t y, int32_t count, int32_t *s, int32_t *t) {
    if (plane->perspective) {
        perspective_coordinates(plane, x, y, count, s, t);
        return;
    }
    uint32_t at_s = plane->s.v + plane->s.dx * (uint32_t)x + plane->s.dy * (uint32_t)y,
             at_t = plane->t.v + plane->t.dx * (uint32_t)x + plane->t.dy * (uint32_t)y;
    for (int32_t i = 0; i < count; i++, at_s += plane->s.dx, at_t += plane->t.dx) {
        s[i] = (int32_t)at_s;
        t[i] = (int32_t)at_t;
    }
}
