/* The vertex stage: each vertex of a surviving cluster once per pass.
 *
 * Perspective. With W normalised to 32 bits by n places, r = 2^62 / (W << n), so 1 / W = r * 2^(n - 62), and
 *     x in 1/16 pixel = X * 2^k / W = (X * r / 2^32) >> (30 - k - n)        depth in 1/256 = 2^24 * 2^ew / W = r >> (depth_shift -
 * n). Errors, in 1/16 pixel, for W >= w_fast: X cut to coarse 1/32, the product cut 1/8, r and W 2^-20 of |x|: below 1/5 in all,
 * that is 1/80 pixel before the snap. Vertices nearer than w_fast are projected from fine coordinates instead. The choice depends
 * on the vertex alone, so a vertex that stands in two clusters comes out the same in both.
 */
#include "../tune.h"

#include "vertex.h"

static vertex_t outside(uint8_t light) { return (vertex_t){VERTEX_OUTSIDE, 0, light}; }

TUILE_NOINLINE bool vertex_project(const transform_t *transform, int64_t x, int64_t y, int64_t w, uint8_t light, bool clamp,
                                   vertex_t *out) {
    int64_t wx, wy, depth;

    if (w < transform->w_low || w > transform->w_high) { return false; }
    if (transform->perspective) {
        const unsigned n = fixed_clz64((uint64_t)w); /* 17 <= n <= 46 */
        uint32_t r = fixed_reciprocal((uint32_t)(((uint64_t)w << n) >> 32));
        if (r > INT32_MAX) { r = INT32_MAX; }
        const unsigned shift = 93u - (unsigned)(transform->k + (int)n); /* one bit is kept for rounding */
        wx = (fixed_mul_shift(x, (int32_t)r, shift) + 1) >> 1;
        wy = (fixed_mul_shift(y, (int32_t)r, shift) + 1) >> 1;
        depth = r >> ((unsigned)transform->depth_shift + 16u - n);
    } else {
        const unsigned shift = (unsigned)-transform->k;
        wx = ((x >> (shift - 1)) + 1) >> 1;
        wy = ((y >> (shift - 1)) + 1) >> 1;
        depth = w >> transform->depth_shift;
    }
    depth = depth < VERTEX_DEPTH_MIN ? VERTEX_DEPTH_MIN : depth > VERTEX_DEPTH_MAX ? VERTEX_DEPTH_MAX : depth;
    wx -= transform->guard_x;
    wy -= transform->guard_y;
    if (clamp) {
        wx = wx < 0 ? 0 : wx > GUARD_SPAN - 1 ? GUARD_SPAN - 1 : wx;
        wy = wy < 0 ? 0 : wy > GUARD_SPAN - 1 ? GUARD_SPAN - 1 : wy;
    } else if (wx < GUARD_MARGIN || wx >= GUARD_SPAN - GUARD_MARGIN || wy < GUARD_MARGIN || wy >= GUARD_SPAN - GUARD_MARGIN) {
        return false;
    }
    *out = (vertex_t){(int16_t)(wx + transform->guard_x), (int16_t)(wy + transform->guard_y), (uint32_t)depth << 8 | light};
    return true;
}

static TUILE_NOINLINE vertex_t vertex_from_fine(const transform_t *transform, const int16_t *q, const int8_t *f, uint8_t light) {
    vertex_t vertex;
    const bool inside = vertex_project(transform, transform_finer(&transform->x, q, f), transform_finer(&transform->y, q, f),
                                       transform_finer(&transform->w, q, f), light, false, &vertex);
    return inside ? vertex : outside(light);
}

TUILE_INLINE int32_t coarse(const transform_row_t *row, int32_t x, int32_t y, int32_t z) {
    return (int32_t)(((int64_t)row->m[0] * x + (int64_t)row->m[1] * y + (int64_t)row->m[2] * z + row->t) >> 16);
}

/* Light at the next of the normals, if there are any. */
TUILE_INLINE uint8_t next_light(const transform_t *transform, const int8_t **normal) {
    const int8_t *n = *normal;
    if (n == NULL) { return LIGHT_MIN; }
    *normal = n + 3;
    return vertex_light(transform, n[0], n[1], n[2]);
}

static bool perspective(const transform_t *transform, const int16_t *q, const int8_t *normal, unsigned count, vertex_t *out) {
    const int32_t first = transform->w_fast, last = (int32_t)(transform->w_high >> 16) - 2;
    const uint32_t range = last > first ? (uint32_t)(last - first) : 0; /* strictly inside far plane, too */
    const int32_t k = transform->k, depth_shift = transform->depth_shift;
    const int32_t low_x = transform->guard_x + GUARD_MARGIN, low_y = transform->guard_y + GUARD_MARGIN;
    bool any_outside = false;

    for (; count; count--, q += 3, out++) {
        const uint8_t light = next_light(transform, &normal);
        const int32_t w = coarse(&transform->w, q[0], q[1], q[2]);
        if (TUILE_UNLIKELY((uint32_t)w - (uint32_t)first >= range)) {
            *out = vertex_from_fine(transform, q, NULL, light);
            any_outside |= out->x == VERTEX_OUTSIDE;
            continue;
        }
        const int32_t n = (int32_t)fixed_clz32((uint32_t)w);
        const uint32_t r = fixed_reciprocal((uint32_t)w << n);
        const unsigned shift = (unsigned)(30 - k - n);
        const int32_t half = (int32_t)(1u << (shift - 1));
        const int32_t x = (fixed_mul_high(coarse(&transform->x, q[0], q[1], q[2]), r) + half) >> shift;
        const int32_t y = (fixed_mul_high(coarse(&transform->y, q[0], q[1], q[2]), r) + half) >> shift;
        uint32_t depth = r >> (depth_shift - n);
        if (depth < VERTEX_DEPTH_MIN) { depth = VERTEX_DEPTH_MIN; }
        *out = (vertex_t){(int16_t)x, (int16_t)y, depth << 8 | light};
        if (TUILE_UNLIKELY((uint32_t)(x - low_x) >= GUARD_SPAN - 2 * GUARD_MARGIN ||
                           (uint32_t)(y - low_y) >= GUARD_SPAN - 2 * GUARD_MARGIN)) {
            *out = outside(light);
            any_outside = true;
        }
    }
    return any_outside;
}

static bool orthographic(const transform_t *transform, const int16_t *q, const int8_t *normal, unsigned count, vertex_t *out) {
    bool any_outside = false;
    for (; count; count--, q += 3, out++) {
        const uint8_t light = next_light(transform, &normal);
        *out = vertex_from_fine(transform, q, NULL, light);
        any_outside |= out->x == VERTEX_OUTSIDE;
    }
    return any_outside;
}

TUILE_NOINLINE bool vertex_stage(const transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count,
                                 vertex_t *out) {
    return transform->perspective ? perspective(transform, positions, normals, count, out)
                                  : orthographic(transform, positions, normals, count, out);
}

bool vertex_fractions(const transform_t *transform, const int16_t *positions, const int8_t *fractions, unsigned count,
                      vertex_t *out) {
    bool any_outside = false;
    for (unsigned i = 0; i < count; i++, positions += 3, fractions += 3) {
        if (!(fractions[0] | fractions[1] | fractions[2])) { continue; }
        out[i] = vertex_from_fine(transform, positions, fractions, (uint8_t)out[i].depth_light);
        any_outside |= out[i].x == VERTEX_OUTSIDE;
    }
    return any_outside;
}
