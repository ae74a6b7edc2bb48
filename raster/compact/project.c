/* Vertices, with the arithmetic of geometry/vertex.c, which has the bounds and derives them. */
#include "inside.h"

#include "../divide.h"
#include "../geometry/model.h"

#define DEPTH_MIN UINT32_C(512)
#define DEPTH_MAX (UINT32_C(65529) * 256u)
#define GUARD_SPAN INT32_C(32768)
#define GUARD_MARGIN 16

static int64_t row_sum(const tuile_compact_row_t *row, const int16_t q[3]) {
    return (int64_t)row->m[0] * q[0] + (int64_t)row->m[1] * q[1] + (int64_t)row->m[2] * q[2] + row->t;
}

static int32_t row_coarse(const tuile_compact_row_t *row, const int16_t q[3]) { return (int32_t)(row_sum(row, q) >> 16); }

static int64_t row_fine(const tuile_compact_row_t *row, const int16_t q[3], const int8_t *f) {
    const int32_t low = (int32_t)row->low[0] * q[0] + (int32_t)row->low[1] * q[1] + (int32_t)row->low[2] * q[2];
    int64_t sum = row_sum(row, q) + ((low + (1 << 13)) >> 14);

    if (f) { sum += ((int64_t)row->m[0] * f[0] + (int64_t)row->m[1] * f[1] + (int64_t)row->m[2] * f[2]) >> 8; }
    return sum;
}

compact_place_t compact_place(const tuile_compact_view_t *view, const int16_t q[3], const int8_t *f) {
    return (compact_place_t){row_fine(&view->x, q, f), row_fine(&view->y, q, f), row_fine(&view->w, q, f)};
}

static int32_t held(int32_t value, int32_t low, int32_t high) { return value < low ? low : value > high ? high : value; }

/* Window coordinates within the guard band, relative to its corner. */
static bool within_guard(int32_t x, int32_t y) {
    return x >= GUARD_MARGIN && x < GUARD_SPAN - GUARD_MARGIN && y >= GUARD_MARGIN && y < GUARD_SPAN - GUARD_MARGIN;
}

/* A window coordinate relative to the guard band; far beyond it, any number there. */
static int32_t fine_coordinate(int64_t value, uint32_t r, unsigned shift, int16_t guard) {
    const int64_t at = ((fixed_mul_shift(value, (int32_t)r, shift) + 1) >> 1) - guard;

    return at < -1 ? -1 : at > GUARD_SPAN ? GUARD_SPAN : (int32_t)at;
}

bool compact_project(const tuile_compact_view_t *view, const compact_place_t *place, bool clamp, tuile_compact_point_t *point,
                     uint32_t *depth) {
    if (place->w < view->w_low || place->w > view->w_high) { return false; }
    const unsigned n = fixed_clz64((uint64_t)place->w);
    uint32_t r = fixed_reciprocal((uint32_t)(((uint64_t)place->w << n) >> 32));

    if (r > INT32_MAX) { r = INT32_MAX; }
    const unsigned shift = 93u - (unsigned)(view->k + (int)n);
    int32_t x = fine_coordinate(place->x, r, shift, view->guard_x), y = fine_coordinate(place->y, r, shift, view->guard_y);
    const uint32_t z = r >> (view->depth_shift + 16u - n);

    if (clamp) {
        x = held(x, 0, GUARD_SPAN - 1);
        y = held(y, 0, GUARD_SPAN - 1);
    } else if (!within_guard(x, y)) {
        return false;
    }
    *point = (tuile_compact_point_t){(int16_t)(x + view->guard_x), (int16_t)(y + view->guard_y)};
    *depth = z < DEPTH_MIN ? DEPTH_MIN : z > DEPTH_MAX ? DEPTH_MAX : z;
    return true;
}

/* A window coordinate of the 32-bit path. */
static int32_t coarse_coordinate(const tuile_compact_row_t *row, const int16_t q[3], uint32_t r, unsigned shift) {
    const int32_t high = (int32_t)(((int64_t)row_coarse(row, q) * r) >> 32);

    return (high + (int32_t)(UINT32_C(1) << (shift - 1u))) >> shift;
}

static bool project_position(const tuile_compact_view_t *view, const int16_t q[3], const int8_t *f, tuile_compact_point_t *point,
                             uint32_t *depth) {
    const int32_t w = row_coarse(&view->w, q);

    if (f || (uint32_t)w - (uint32_t)view->w_fast >= view->w_range) {
        const compact_place_t place = compact_place(view, q, f);

        return compact_project(view, &place, false, point, depth);
    }
    const unsigned n = fixed_clz32((uint32_t)w);
    const uint32_t r = fixed_reciprocal((uint32_t)w << n), z = r >> (view->depth_shift - n);
    const unsigned shift = (unsigned)(30 - view->k - (int)n);
    const int32_t x = coarse_coordinate(&view->x, q, r, shift), y = coarse_coordinate(&view->y, q, r, shift);

    *point = (tuile_compact_point_t){(int16_t)x, (int16_t)y};
    *depth = z < DEPTH_MIN ? DEPTH_MIN : z;
    return within_guard(x - view->guard_x, y - view->guard_y);
}

bool compact_position(const tuile_compact_t *compact, uint16_t number, int16_t q[3], int8_t f[3]) {
    const TUILE_FLASH uint8_t *position = compact->positions + 6u * (size_t)number;
    bool any = false;

    for (unsigned i = 0; i < 3; i++) {
        q[i] = model_i16(position + 2 * i);
        f[i] = compact->fractions ? (int8_t)compact->fractions[3u * (size_t)number + i] : 0;
        any |= f[i] != 0;
    }
    return any;
}

void compact_vertices(tuile_compact_t *compact) {
    for (uint16_t i = 0; i < compact->vertex_count; i++) {
        tuile_compact_point_t *point = &compact->points[i];
        int16_t q[3];
        int8_t f[3];
        uint32_t depth = 0;
        const bool fractions = compact_position(compact, i, q, f);

        if (!project_position(&compact->view, q, fractions ? f : NULL, point, &depth)) { point->x = COMPACT_OUTSIDE; }
        if (compact->depths) { compact->depths[i] = depth; }
    }
}
