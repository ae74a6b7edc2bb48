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

#include "../assembly.h"
#include "../divide.h"
#include "model.h"
#include "vertex_thumb.h"

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

/* 31 bits, in a whole register. By halves: the result fits in 32 bits, so all sums are modulo 2^32. */
TUILE_INLINE int_fast32_t coarse(const transform_row_t *row, int32_t x, int32_t y, int32_t z) {
    if (!FIXED_BY_HALVES) {
        return (int_fast32_t)((row->t + (int64_t)row->m[0] * x + (int64_t)row->m[1] * y + (int64_t)row->m[2] * z) >> 16);
    }
    /* 16 bits by 16 signed ones */
    const int32_t px = (int32_t)fixed_low_half((uint32_t)row->m[0]) * x, py = (int32_t)fixed_low_half((uint32_t)row->m[1]) * y,
                  pz = (int32_t)fixed_low_half((uint32_t)row->m[2]) * z;
    const uint32_t low = fixed_low_half((uint32_t)row->t) + fixed_low_half((uint32_t)px) + fixed_low_half((uint32_t)py) +
                         fixed_low_half((uint32_t)pz);
    return (int32_t)((uint32_t)(row->t >> 16) + (uint32_t)((row->m[0] >> 16) * x) + (uint32_t)((row->m[1] >> 16) * y) +
                     (uint32_t)((row->m[2] >> 16) * z) + (uint32_t)(px >> 16) + (uint32_t)(py >> 16) + (uint32_t)(pz >> 16) +
                     (low >> 16));
}

/* Light at the next of the normals, if there are any. */
TUILE_INLINE uint8_t next_light(const transform_t *transform, const int8_t **normal, bool lit) {
    if (!lit) { return LIGHT_MIN; }
    const int8_t *n = *normal;
    *normal = n + 3;
    return vertex_light(transform, n[0], n[1], n[2]);
}

/* But for its bounds, and whether there is a second one. */
TUILE_INLINE void octave_set(const transform_t *transform, vertex_octave_t *octave, unsigned zeros) {
    const unsigned shift = (unsigned)(30 - transform->k - (int32_t)zeros);
    octave->zeros = zeros;
    octave->shift = shift;
    octave->depth_shift = (unsigned)(transform->depth_shift - (int32_t)zeros);
    octave->half = (int32_t)(1u << (shift - 1));
}

/* False: W is to be projected from fine coordinates. */
TUILE_INLINE bool octave_of(const transform_t *transform, vertex_octave_t *octave, int32_t w) {
    const int32_t first = transform->w_fast, last = (int32_t)(transform->w_high >> 16) - 2;
    if (w < first || w >= last) { return false; }
    const unsigned zeros = fixed_clz32((uint32_t)w); /* >= 1, since w_fast > 0 */
    const uint32_t low = 0x80000000u >> zeros, end = low * 2;
    octave_set(transform, octave, zeros);
    octave->first = low > (uint32_t)first ? low : (uint32_t)first;
    octave->range = (end < (uint32_t)last ? end : (uint32_t)last) - octave->first;
    return true;
}

/* One octave for all of a cluster, by its sphere, in which depths need no lower bound. Fractions may lie 1 step beside it. */
static bool octave_of_cluster(const transform_t *transform, vertex_octave_t *octave, const uint8_t *cluster) {
    const uint32_t slope = transform->w_slope;
    const uint64_t reach = fixed_mul_part(slope, model_u16(cluster + CLUSTER_AT_RADIUS)) + 2 * slope + 2; /* < 2^34 */
    if (reach > INT32_MAX / 2) { return false; } /* more than half of what W can be */
    const int32_t w = (int32_t)coarse(&transform->w, model_i16(cluster + CLUSTER_AT_CENTRE),
                                      model_i16(cluster + CLUSTER_AT_CENTRE + 2), model_i16(cluster + CLUSTER_AT_CENTRE + 4));
    const int32_t first = transform->w_fast, last = (int32_t)(transform->w_high >> 16) - 2;
    if (w < first || w - (int32_t)reach < first || (uint32_t)w + (uint32_t)reach >= (uint32_t)last) { return false; }
    const unsigned zeros = fixed_clz32((uint32_t)w + (uint32_t)reach);
    const uint32_t least = ((uint32_t)w - (uint32_t)reach) >> (30 - zeros); /* in halves of the octave's first number */
    if (least < (ASSEMBLY_THUMB1 ? 1 : 2)) { return false; }
    octave_set(transform, octave, zeros);
    octave->second = least < 2;
    return octave->depth_shift <= 21;
}

/* lit and even are constants where this is called. even: all of the cluster is in `octave`, and there is no light but a one-sided
 * one, or none is wanted. */
TUILE_INLINE unsigned perspective(const transform_t *transform, const int16_t *q, const int8_t *normal, unsigned count,
                                  vertex_t *out, vertex_octave_t octave, bool lit, bool even) {
    const int32_t low_x = transform->guard_x + GUARD_MARGIN, low_y = transform->guard_y + GUARD_MARGIN;
    const int32_t region_x = transform->region_x, region_y = transform->region_y;
    const uint32_t region_width = transform->region_width, region_height = transform->region_height;
    const vertex_sun_t sun = vertex_sun(transform);
    unsigned any = 0;

    for (const vertex_t *const end = out + count; out != end; q += 3, out++) {
        const uint8_t light = !lit ? LIGHT_MIN : even ? vertex_sun_front(&sun, normal) : vertex_sun_light(transform, &sun, normal);
        if (lit) { normal += 3; }
        const int32_t w = (int32_t)coarse(&transform->w, q[0], q[1], q[2]);
        if (!even && TUILE_UNLIKELY((uint32_t)w - octave.first >= octave.range) && !octave_of(transform, &octave, w)) {
            *out = vertex_from_fine(transform, q, NULL, light);
            any |= VERTEX_ANY_BEYOND | (out->x == VERTEX_OUTSIDE);
            continue;
        }
        /* The bit is there but for a model whose cluster reaches beyond its sphere: any picture will do then. */
        const uint32_t r = fixed_reciprocal((uint32_t)w << octave.zeros | 0x80000000u);
        const int32_t x = (fixed_mul_high(coarse(&transform->x, q[0], q[1], q[2]), r) + octave.half) >> octave.shift;
        const int32_t y = (fixed_mul_high(coarse(&transform->y, q[0], q[1], q[2]), r) + octave.half) >> octave.shift;
        uint32_t depth = r >> octave.depth_shift;
        if (!even && depth < VERTEX_DEPTH_MIN) { depth = VERTEX_DEPTH_MIN; }
        *out = (vertex_t){(int16_t)x, (int16_t)y, depth << 8 | light};
        if (TUILE_LIKELY((uint32_t)(x - region_x) < region_width && (uint32_t)(y - region_y) < region_height)) { continue; }
        any |= VERTEX_ANY_BEYOND;
        if (TUILE_UNLIKELY((uint32_t)(x - low_x) >= GUARD_SPAN - 2 * GUARD_MARGIN ||
                           (uint32_t)(y - low_y) >= GUARD_SPAN - 2 * GUARD_MARGIN)) {
            *out = outside(light);
            any |= VERTEX_ANY_OUTSIDE;
        }
    }
    return any;
}

static unsigned orthographic(const transform_t *transform, const int16_t *q, const int8_t *normal, unsigned count, vertex_t *out) {
    const bool lit = normal != NULL;
    unsigned any = 0;
    for (; count; count--, q += 3, out++) {
        const uint8_t light = next_light(transform, &normal, lit);
        *out = vertex_from_fine(transform, q, NULL, light);
        if (out->x == VERTEX_OUTSIDE) { any |= VERTEX_ANY_OUTSIDE; }
        if ((uint32_t)(out->x - transform->region_x) >= transform->region_width ||
            (uint32_t)(out->y - transform->region_y) >= transform->region_height) {
            any |= VERTEX_ANY_BEYOND;
        }
    }
    return any;
}

static TUILE_NOINLINE unsigned perspective_any(const transform_t *transform, const int16_t *positions, const int8_t *normals,
                                               unsigned count, vertex_t *out) {
    const vertex_octave_t none = {.range = 0};
    return normals ? perspective(transform, positions, normals, count, out, none, true, false)
                   : perspective(transform, positions, NULL, count, out, none, false, false);
}

unsigned vertex_stage_region(transform_t *transform, const uint8_t *cluster, const int16_t *positions, const int8_t *normals,
                             unsigned count, vertex_t *out) {
    vertex_octave_t octave;
    const bool one_sided = transform->light_count <= 1 && !transform->two_sided;
    if (!transform->perspective) { return orthographic(transform, positions, normals, count, out); }
    if ((normals && !one_sided) || !octave_of_cluster(transform, &octave, cluster)) {
        return perspective_any(transform, positions, normals, count, out);
    }
    if (ASSEMBLY_VERTICES) { return vertex_thumb(transform, positions, normals, count, out, &octave); }
    return normals ? perspective(transform, positions, normals, count, out, octave, true, true)
                   : perspective(transform, positions, NULL, count, out, octave, false, true);
}

bool vertex_stage(const transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out) {
    const unsigned any = transform->perspective ? perspective_any(transform, positions, normals, count, out)
                                                : orthographic(transform, positions, normals, count, out);
    return any & VERTEX_ANY_OUTSIDE;
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
