#include "../tune.h"

#include "../divide.h"

#include "fog.h"

#include "../geometry/wide.h"

static wide_t q16(int64_t value) { return wide_make(value, -16); }

/* a as mantissa * 2^shift, 2^30 <= mantissa < 2^31, or 0. */
static void store_a(fog_t *fog, wide_t a) {
    fog->mantissa = (uint32_t)(a.mantissa >> 31);
    fog->shift = (int16_t)(a.exponent + 31);
}

int fog_make(fog_t *fog, const tuile_fog_t *from, const tuile_camera_t *camera) {
    const bool linear = from->kind == TUILE_FOG_LINEAR;
    fog->kind = from->kind;
    if (from->kind == TUILE_FOG_NONE) { return TUILE_OK; }
    if (from->kind > TUILE_FOG_EXPONENTIAL || (linear && (from->near < 0 || from->far <= from->near)) || from->far <= 0) {
        return TUILE_ERROR_ARGUMENT;
    }
    /* In the fog's own lengths, times 65536. */
    const wide_t length = q16((int64_t)from->far - (linear ? from->near : 0));
    const wide_t per_unit = wide_multiply(wide_make(65536, 0), wide_reciprocal(length));
    fog->rgb = (uint32_t)from->colour[0] << 16 | (uint32_t)from->colour[1] << 8 | from->colour[2];
    fog->inverse = camera->projection == TUILE_PERSPECTIVE;
    if (fog->inverse) {
        store_a(fog, wide_multiply(wide_multiply(wide_make((int64_t)65528 << 16, 0), q16(camera->near)), per_unit));
        fog->b = wide_to_integer(wide_multiply(q16(from->near), per_unit), 0);
        return TUILE_OK;
    }
    const wide_t range = q16((int64_t)camera->far - camera->near);
    const wide_t per_depth = wide_multiply(range, wide_reciprocal(wide_make((int64_t)65520 << 16, 0)));
    const wide_t from_zero =
        wide_add(q16((int64_t)camera->far - from->near), wide_multiply(wide_make(INT32_C(8) << 16, 0), per_depth));
    store_a(fog, wide_multiply(per_depth, per_unit));
    fog->b = wide_to_integer(wide_multiply(from_zero, per_unit), 0);
    return TUILE_OK;
}

/* 2^-(i / 64) in 1/65536, rounded. */
static const uint32_t halves[65] = {
    65536, 64830, 64132, 63441, 62757, 62081, 61413, 60751, 60097, 59449, 58809, 58176, 57549, 56929, 56316, 55709, 55109,
    54515, 53928, 53347, 52773, 52204, 51642, 51085, 50535, 49991, 49452, 48920, 48393, 47871, 47356, 46846, 46341, 45842,
    45348, 44859, 44376, 43898, 43425, 42958, 42495, 42037, 41584, 41136, 40693, 40255, 39821, 39392, 38968, 38548, 38133,
    37722, 37316, 36914, 36516, 36123, 35734, 35349, 34968, 34591, 34219, 33850, 33486, 33125, 32768,
};

static int64_t shifted(int64_t value, int32_t right) {
    if (right < 0) { return INT64_MAX / 2; } /* a / z is above 2^61: farther than any fog */
    return right > 62 ? 0 : value >> right;
}

uint32_t fog_share(const fog_t *fog, uint32_t depth) {
    if (depth < 65536) { depth = 65536; }
    int64_t x;
    if (fog->inverse) {
        const unsigned n = fixed_clz32(depth);
        x = shifted((int64_t)fog->mantissa * fixed_reciprocal(depth << n), 62 - fog->shift - (int32_t)n) - fog->b;
    } else {
        const int64_t product = (int64_t)((uint64_t)fog->mantissa * (depth >> 1));
        x = fog->b - shifted(product, -fog->shift - 1);
    }
    if (x <= 0) { return 0; }
    if (fog->kind == TUILE_FOG_LINEAR) { return x < (int64_t)FOG_ONE ? (uint32_t)x : FOG_ONE; }
    if (x >= INT32_C(17) << 16) { return FOG_ONE; }
    const uint32_t whole = (uint32_t)x >> 16, at = (uint32_t)x >> 10 & 63u, rest = (uint32_t)x & 1023u;
    const uint32_t left = (halves[at] << 10) - (halves[at] - halves[at + 1]) * rest; /* 1/2^26 */
    return FOG_ONE - (left >> (10 + whole));
}

/* a + (b - a) share, rounded, for a component. */
TUILE_INLINE uint32_t mixed(uint32_t a, uint32_t b, uint32_t share) {
    return (a * (FOG_ONE - share) + b * share + FOG_ONE / 2) >> 16;
}

uint32_t fog_fade(const fog_t *fog, uint32_t depth, uint32_t argb, uint32_t to) {
    const uint32_t share = fog_share(fog, depth);
    return (argb & 0xff000000u) | mixed(argb >> 16 & 255u, to >> 16 & 255u, share) << 16 |
           mixed(argb >> 8 & 255u, to >> 8 & 255u, share) << 8 | mixed(argb & 255u, to & 255u, share);
}
