/* Texture coordinates: planes and what is computed from them.
 *
 * Affine planes are Q16.16 texels modulo 2^32. Small faces (sides below 32 pixels, less than 128 texels across) share one 31-bit
 * reciprocal of the area, for others the quotients are exact: fill/triangle.c has the bound of the first, |num| / 2^31 per 1/16
 * pixel, here |num| < 2^25, 2^-10 texel a pixel, over 2 * 32 pixels 1/16 texel; floors of the second, 2^-16 a pixel, over 2 * 2048
 * pixels 1/16 texel.
 *
 * Perspective planes. Coordinates are taken from the first corner, rounded to 18 bits with the sign: half a unit is the 2^18th part
 * of what the face is across, 1/8 texel for 32768. The depth has 24 bits, whole, so u = s * depth has 41. Gradients are exact
 * quotients, floored; that of q with 18 bits of fraction:
 *     |2 * 2^42 * 2^15| << 4 < 2^63,  |2 * 2^25 * 2^15| << 22 < 2^64.
 * Over 2 * 2048 pixels floors are off by 2^12 in u, which is 2^12 / q units: 1/16 of a unit where the face is 256 times as far as
 * at its nearest; and by 2^12 / 2^18 in q, so that s is off by 2^-22 of itself there.
 */
#include "../tune.h"

#include "texture.h"

#include "../fill/edge.h"
#include "../fill/gradient.h"

#define SMALL_TEXELS (1 << 15) /* Q.8 */
#define S_BITS 18u
#define Q_BITS 24u
#define Q_FRACTION 18u
#define U_FRACTION 0u

typedef struct span3 {
    int32_t least, most;
} span3_t;

TUILE_INLINE span3_t span3(int32_t a, int32_t b, int32_t c) {
    return (span3_t){a < b ? (a < c ? a : c) : (b < c ? b : c), a > b ? (a > c ? a : c) : (b > c ? b : c)};
}

/* v + x dx + y dy from the value at a corner, modulo 2^64. */
TUILE_INLINE int64_t origin(gradient_t g, int64_t at_corner, const texture_corner_t *corner) {
    const int32_t to_x = 8 - corner->x, to_y = 8 - corner->y;
    return (int64_t)((uint64_t)at_corner + (uint64_t)gradient_part(g, to_x & 15, to_y & 15) +
                     (uint64_t)g.dx * (uint64_t)(int64_t)(to_x >> 4) + (uint64_t)g.dy * (uint64_t)(int64_t)(to_y >> 4));
}

/* Window and area of a face whose corners have been put in counter-clockwise order. */
typedef struct frame3 {
    int32_t x1, y1, x2, y2, area;
    bool is_short;
} frame3_t;

/* ---- affine ---- */

TUILE_INLINE texture_affine32_t affine(const frame3_t *f, const texture_corner_t *a, int32_t c0, int32_t c1, int32_t c2, bool small,
                                       int32_t reciprocal) {
    c1 -= c0;
    c2 -= c0;
    const gradient_t g = small ? gradient_small(c1, c2, f->x1, f->y1, f->x2, f->y2, reciprocal, 12)
                               : gradient_exact(c1, c2, f->x1, f->y1, f->x2, f->y2, f->area, 12);
    return (texture_affine32_t){(uint32_t)origin(g, (int64_t)c0 * 256, a), (uint32_t)g.dx, (uint32_t)g.dy};
}

TUILE_INLINE bool near_zero(int32_t c, int32_t limit) { return (uint32_t)(c + limit) < 2u * (uint32_t)limit; }

static void affine_make(texture_plane_t *plane, const frame3_t *f, const texture_corner_t *a, const texture_corner_t *b,
                        const texture_corner_t *c) {
    const bool small = f->is_short && near_zero(b->s - a->s, SMALL_TEXELS) && near_zero(c->s - a->s, SMALL_TEXELS) &&
                       near_zero(b->t - a->t, SMALL_TEXELS) && near_zero(c->t - a->t, SMALL_TEXELS);
    const int32_t reciprocal = small ? INT32_MAX / f->area : 0;
    plane->perspective = false;
    plane->s = affine(f, a, a->s, b->s, c->s, small, reciprocal);
    plane->t = affine(f, a, a->t, b->t, c->t, small, reciprocal);
}

/* ---- levels ---- */

/* log2 x in 1/256, within 0.09: the mantissa taken for its logarithm. */
static int32_t log2_q8(uint64_t x) {
    const unsigned n = fixed_clz64(x | 1);
    return (int32_t)(63 - n) * 256 + (int32_t)((x << n) >> 55 & 255);
}

/* A pixel is drawn from the level at which it is about a texel large, by areas. Texels' area over pixels' area is K / q^3 on a
 * plane, and of the whole face K / (q0 q1 q2). Returns 2 log2 of the side of a pixel in texels, Q.8; plus 3 log2 q in perspective.
 */
static int32_t level_plane(const texture_corner_t corner[3], int32_t area) {
    const int64_t s1 = corner[1].s - corner[0].s, t1 = corner[1].t - corner[0].t, s2 = corner[2].s - corner[0].s,
                  t2 = corner[2].t - corner[0].t;
    const int64_t turned = s1 * t2 - s2 * t1; /* twice the area in texels, Q.16; |s|, |t| < 2^24; the window's: Q.8 */
    return log2_q8((uint64_t)(turned < 0 ? -turned : turned)) - 8 * 256 - log2_q8((uint32_t)area);
}

TUILE_INLINE unsigned level_held(int32_t side_squared, unsigned levels) {
    const int32_t level = (side_squared + 256) >> 9; /* half of it, rounded to the nearest */
    return level < 0 ? 0 : level >= (int32_t)levels ? levels - 1 : (unsigned)level;
}

/* ---- perspective ---- */

static texture_affine64_t gradient64(const frame3_t *f, const texture_corner_t *a, int64_t c0, int64_t c1, int64_t c2,
                                     unsigned fraction) {
    c1 -= c0;
    c2 -= c0;
    const int64_t nx = c2 * f->y1 - c1 * f->y2, ny = c1 * f->x2 - c2 * f->x1;
    const gradient_t g = {fixed_floor_div64(fixed_shift_left64(nx, 4 + fraction), f->area),
                          fixed_floor_div64(fixed_shift_left64(ny, 4 + fraction), f->area)};
    return (texture_affine64_t){origin(g, fixed_shift_left64(c0, fraction), a), g.dx, g.dy};
}

#define CUT_LEAST 14

TUILE_INLINE int32_t cut_off(int32_t x, int bits) { return bits > 0 ? (x + (1 << (bits - 1))) >> bits : x * (1 << -bits); }

static TUILE_NOINLINE void perspective_make(texture_plane_t *plane, const frame3_t *f, const texture_corner_t *corner[3],
                                            uint32_t most) {
    const span3_t s = span3(corner[0]->s, corner[1]->s, corner[2]->s), t = span3(corner[0]->t, corner[1]->t, corner[2]->t);
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
    plane->u = gradient64(f, corner[0], u[0], u[1], u[2], U_FRACTION);
    plane->v = gradient64(f, corner[0], v[0], v[1], v[2], U_FRACTION);
    plane->q = gradient64(f, corner[0], q[0], q[1], q[2], Q_FRACTION);
    plane->s0 = corner[0]->s * 256;
    plane->t0 = corner[0]->t * 256;
    /* texels Q16.16 = u / (q / 2^18) * 2^cut * 2^8 */
    plane->shift = (int8_t)(8 + (int)Q_FRACTION - (int)U_FRACTION + cut);
    const int64_t least = q[0] < q[1] ? (q[0] < q[2] ? q[0] : q[2]) : (q[1] < q[2] ? q[1] : q[2]);
    plane->q_least = (least > 1 ? least : 1) << (Q_FRACTION - 1);
    for (unsigned i = 0; plane->mips && i < 3; i++) {
        plane->level_q += log2_q8((uint64_t)(q[i] > 1 ? q[i] : 1) << Q_FRACTION);
    }
}

/* A quarter texel, by the bound in texture.h; coordinates in Q.8. */
static bool affine_will_do(const texture_corner_t corner[3]) {
    const uint32_t a = corner[0].depth, b = corner[1].depth, c = corner[2].depth;
    const uint32_t least = a < b ? (a < c ? a : c) : (b < c ? b : c), most = a > b ? (a > c ? a : c) : (b > c ? b : c);
    const span3_t s = span3(corner[0].s, corner[1].s, corner[2].s), t = span3(corner[0].t, corner[1].t, corner[2].t);
    const uint32_t across = (uint32_t)(s.most - s.least), down = (uint32_t)(t.most - t.least);
    return (uint64_t)(most - least) * (across > down ? across : down) <= (uint64_t)least * 256u;
}

void texture_plane_make(texture_plane_t *plane, const tuile_texture_t *texture, const texture_corner_t corner[3],
                        texture_wish_t wish) {
    const texture_corner_t *turned[3] = {&corner[0], &corner[1], &corner[2]};
    frame3_t f = {
        corner[1].x - corner[0].x, corner[1].y - corner[0].y, corner[2].x - corner[0].x, corner[2].y - corner[0].y, 0, false};
    f.area = f.x2 * f.y1 - f.x1 * f.y2;
    if (f.area < 0) {
        turned[1] = &corner[2];
        turned[2] = &corner[1];
        f = (frame3_t){f.x2, f.y2, f.x1, f.y1, -f.area, false};
    }
    const span3_t x = span3(0, f.x1, f.x2), y = span3(0, f.y1, f.y2);
    f.is_short = x.most - x.least < SHORT_SIDE && y.most - y.least < SHORT_SIDE;
    plane->texture = *texture;
    plane->bilinear = wish.bilinear;
    plane->mips = wish.mips && texture->levels > 1;
    plane->level_q = plane->mips ? level_plane(corner, f.area) : 0;
    plane->level_number = (uint8_t)(plane->mips ? level_held(plane->level_q, texture->levels) : 0);
    plane->level = texture_level(texture, plane->level_number);
    if (!wish.perspective || wish.affine || affine_will_do(corner)) {
        affine_make(plane, &f, turned[0], turned[1], turned[2]);
        return;
    }
    const uint32_t a = corner[0].depth, b = corner[1].depth, c = corner[2].depth;
    perspective_make(plane, &f, turned, a > b ? (a > c ? a : c) : (b > c ? b : c));
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
    return level_held(plane->level_q - 3 * log2_q8(q), plane->texture.levels);
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
