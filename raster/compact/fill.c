/* Faces into the tile: coverage by the exact crossing of each side with each row (fill/edge.h), depth by the planes of
 * fill/polygon.c and fill/triangle.c, dots by Bayer's matrix. */
#include "inside.h"

#include "../fill/gradient.h"
#include "../memory.h"
#include "../resolve/bayer.h"

#define MATRIX 8u
#define SHORT_SIDE 512                 /* 1/16 pixel, as fill/edge.h */
#define SMALL_DEPTH (INT32_C(1) << 17) /* 1/256 step, as fill/triangle_set_up.h */
#define STEEP (INT64_C(1) << 33)       /* as fill/polygon.c */

/* A pixel is white iff luma >= ceil((128 - (2 b + 1)) * 65535 / 128) (resolve/put.h), that is 127 - 2 b <= floor(128 luma / 65535).
 * The quotient is luma >> 9 but for luma = 65535, whose level is 0 either way. */
uint8_t compact_level(uint16_t luma) { return (uint8_t)((128u - (luma >> 9)) / 2u); }

/* ---- depth: z + x dx + y dy at the centre of pixel (x, y), Q.16 with the rounding half ---- */

typedef struct plane {
    uint64_t z, dx, dy; /* modulo 2^64 */
    uint32_t low, high; /* polygons are held between these */
    bool held;
} plane_t;

/* Twice the area of v0 v1 v2 in (1/16 px)^2, positive for counter-clockwise as seen. */
static int32_t area_of(const tuile_compact_point_t *v0, const tuile_compact_point_t *v1, const tuile_compact_point_t *v2) {
    const int32_t x1 = (int32_t)v1->x - v0->x, y1 = (int32_t)v1->y - v0->y, x2 = (int32_t)v2->x - v0->x,
                  y2 = (int32_t)v2->y - v0->y;

    return x2 * y1 - x1 * y2;
}

/* Gradients of a triangle from corner a to b and c, counter-clockwise as seen; 0 where it has no area. */
static TUILE_NOINLINE gradient_t gradient_of(const compact_ring_t *ring, uint8_t a, uint8_t b, uint8_t c, bool small) {
    const int32_t x1 = (int32_t)ring->point[b].x - ring->point[a].x, y1 = (int32_t)ring->point[b].y - ring->point[a].y;
    const int32_t x2 = (int32_t)ring->point[c].x - ring->point[a].x, y2 = (int32_t)ring->point[c].y - ring->point[a].y;
    const int32_t z1 = (int32_t)(ring->depth[b] - ring->depth[a]), z2 = (int32_t)(ring->depth[c] - ring->depth[a]);
    const int32_t area = x2 * y1 - x1 * y2;

    if (area <= 0) { return (gradient_t){0, 0}; }
    if (small && z1 >= -SMALL_DEPTH && z1 < SMALL_DEPTH && z2 >= -SMALL_DEPTH && z2 < SMALL_DEPTH) {
        return gradient_small(z1, z2, x1, y1, x2, y2, INT32_MAX / area, 12);
    }
    return gradient_exact(z1, z2, x1, y1, x2, y2, area, 12);
}

static int64_t held(int64_t value, int64_t low, int64_t high) { return value < low ? low : value > high ? high : value; }

/* From the largest triangle of the fan round the first corner. False: the polygon has no area. */
static bool polygon_plane(const compact_ring_t *ring, plane_t *plane) {
    const tuile_compact_point_t *v0 = &ring->point[0];
    uint8_t second = 0, third = 0;
    int32_t most = 0;
    uint32_t low = ring->depth[0], high = low;

    for (uint8_t i = 1; i < ring->count; i++) {
        low = ring->depth[i] < low ? ring->depth[i] : low;
        high = ring->depth[i] > high ? ring->depth[i] : high;
        if (i + 1u == ring->count) { break; }
        const int32_t area = area_of(v0, &ring->point[i], &ring->point[i + 1]), size = area < 0 ? -area : area;
        if (size > most) {
            most = size;
            second = (uint8_t)(area < 0 ? i + 1 : i);
            third = (uint8_t)(area < 0 ? i : i + 1);
        }
    }
    if (most == 0) { return false; }
    const gradient_t g = gradient_of(ring, 0, second, third, false);
    const int64_t dx = held(g.dx, -STEEP, STEEP), dy = held(g.dy, -STEEP, STEEP);
    plane->dx = (uint64_t)dx;
    plane->dy = (uint64_t)dy;
    plane->z = (uint64_t)(((int64_t)ring->depth[0] << 8) + 0x8000 + ((dx * (8 - v0->x) + dy * (8 - v0->y)) >> 4));
    plane->low = (low << 8) + 0x8000u;
    plane->high = (high << 8) + 0x8000u;
    plane->held = true;
    return true;
}

/* Is each side of the triangle short? `top` is a topmost corner. */
static bool sides_short(const compact_ring_t *ring, uint8_t top) {
    int16_t least = INT16_MAX, most = INT16_MIN, lowest = INT16_MIN;

    for (uint8_t i = 0; i < 3; i++) {
        const tuile_compact_point_t *p = &ring->point[i];
        least = p->x < least ? p->x : least;
        most = p->x > most ? p->x : most;
        lowest = p->y > lowest ? p->y : lowest;
    }
    return (int32_t)most - least < SHORT_SIDE && (int32_t)lowest - ring->point[top].y < SHORT_SIDE;
}

static void triangle_plane(const compact_ring_t *ring, plane_t *plane) {
    const int16_t a = ring->point[0].y, b = ring->point[1].y, c = ring->point[2].y;
    const uint8_t top = b < a && b <= c ? 1
                        : c < a         ? 2
                                        : 0,
                  next = (uint8_t)(top == 2 ? 0 : top + 1), last = (uint8_t)(3 - top - next);
    const gradient_t g = gradient_of(ring, top, next, last, sides_short(ring, top));
    const int32_t to_x = 8 - (int32_t)ring->point[top].x, to_y = 8 - (int32_t)ring->point[top].y;

    plane->dx = (uint64_t)g.dx;
    plane->dy = (uint64_t)g.dy;
    plane->z = (uint64_t)(((int64_t)ring->depth[top] << 8) + 0x8000 + gradient_part(g, to_x & 15, to_y & 15)) +
               plane->dx * (uint64_t)(int64_t)(to_x >> 4) + plane->dy * (uint64_t)(int64_t)(to_y >> 4);
    plane->held = false;
}

/* ---- coverage ---- */

/* The first row of centres at or below y; the first column alike. */
static int16_t row_of(int16_t y) { return (int16_t)(((int32_t)y + 7) >> 4); }

/* The first pixel of a row whose centre is on the side from a down to b or right of it. Coordinates span less than 2^15, so that
 * both products, and their sum, stay within 2^31. */
static int16_t side_at(const tuile_compact_point_t *a, const tuile_compact_point_t *b, int16_t row) {
    const int32_t dx = (int32_t)b->x - a->x, dy = (int32_t)b->y - a->y, d = 16 * dy;
    const int32_t whole = ((int32_t)a->x - 8) >> 4, part = ((int32_t)a->x - 8) & 15;

    return (int16_t)(whole + fixed_floor_div(part * dy + (16 * (int32_t)row + 8 - a->y) * dx + d - 1, d));
}

/* The crossings of a row with the sides, from left to right. */
static uint8_t crossings_of(const compact_ring_t *ring, int16_t row, int16_t crossings[COMPACT_RING]) {
    uint8_t count = 0;

    for (uint8_t i = 0; i < ring->count; i++) {
        const tuile_compact_point_t *a = &ring->point[i], *b = &ring->point[i + 1u == ring->count ? 0 : i + 1];
        const int16_t from = row_of(a->y), to = row_of(b->y);
        const bool down = from <= row && row < to;

        if (!down && !(to <= row && row < from)) { continue; }
        const int16_t x = down ? side_at(a, b, row) : side_at(b, a, row);
        uint8_t at = count++;
        for (; at > 0 && crossings[at - 1] > x; at--) {
            crossings[at] = crossings[at - 1];
        }
        crossings[at] = x;
    }
    return count;
}

/* ---- pixels ---- */

/* Pixels from ... to - 1 of a row, all in the tile. plane: NULL: over whatever is there. */
static void span(tuile_compact_t *compact, int16_t row, int16_t from, int16_t to, const plane_t *plane, uint8_t level) {
    const uint16_t width = (uint16_t)(compact->right - compact->left), y = (uint16_t)((uint16_t)row - compact->top);
    const uint8_t bit = (uint8_t)(1u << (y & 7u));
    uint8_t *byte = compact->bits + (size_t)(y / 8u) * width + ((uint16_t)from - compact->left);
    uint16_t *depth = plane ? compact->depth + (size_t)y * width + ((uint16_t)from - compact->left) : NULL;
    uint8_t numbers[MATRIX];
    uint64_t z = 0;

    for (uint8_t i = 0; i < MATRIX; i++) {
        numbers[i] = (uint8_t)resolve_bayer(i, (uint32_t)row);
    }
    if (plane) { z = plane->z + plane->dx * (uint64_t)from + plane->dy * (uint64_t)row; }
    for (; from < to; from++, byte++) {
        if (plane) {
            const int64_t exact = (int64_t)z;
            const uint32_t q16 = !plane->held ? (uint32_t)z : (uint32_t)held(exact, plane->low, plane->high);
            const uint16_t near = (uint16_t)(q16 >> 16), there = *depth;

            z += plane->dx;
            if (near > there) { *depth = near; }
            depth++;
            if (near <= there) { continue; }
        }
        *byte = (uint8_t)(numbers[(uint8_t)from % MATRIX] >= level ? *byte | bit : *byte & ~bit);
    }
}

void compact_clear(tuile_compact_t *compact) {
    const size_t pixels = (size_t)(compact->right - compact->left) * (size_t)(compact->bottom - compact->top);
    const uint8_t level = compact_level(compact->view.background);

    memset(compact->bits, 0, (size_t)(compact->right - compact->left) * (size_t)((compact->bottom - compact->top + 7u) / 8u));
    if (compact->depth) { memset(compact->depth, 0, 2 * pixels); }
    for (uint16_t row = compact->top; row < compact->bottom && level < 64; row++) {
        span(compact, (int16_t)row, (int16_t)compact->left, (int16_t)compact->right, NULL, level);
    }
}

bool compact_rows(const tuile_compact_t *compact, const compact_ring_t *ring, int16_t *first, int16_t *end) {
    int16_t left = INT16_MAX, top = INT16_MAX, right = INT16_MIN, bottom = INT16_MIN;

    for (uint8_t i = 0; i < ring->count; i++) {
        const tuile_compact_point_t *p = &ring->point[i];
        left = p->x < left ? p->x : left;
        right = p->x > right ? p->x : right;
        top = p->y < top ? p->y : top;
        bottom = p->y > bottom ? p->y : bottom;
    }
    top = row_of(top);
    bottom = row_of(bottom);
    *first = top > (int16_t)compact->top ? top : (int16_t)compact->top;
    *end = bottom < (int16_t)compact->bottom ? bottom : (int16_t)compact->bottom;
    return *first < *end && row_of(left) < (int16_t)compact->right && row_of(right) > (int16_t)compact->left;
}

void compact_fill(tuile_compact_t *compact, const compact_ring_t *ring, int16_t first, int16_t end, uint8_t level) {
    plane_t plane;
    bool planned = compact->depth == NULL;

    for (int16_t row = first; row < end; row++) {
        int16_t crossings[COMPACT_RING];
        const uint8_t count = crossings_of(ring, row, crossings);

        for (uint8_t i = 0; i + 1u < count; i = (uint8_t)(i + 2u)) {
            const int16_t from = crossings[i] > (int16_t)compact->left ? crossings[i] : (int16_t)compact->left;
            const int16_t to = crossings[i + 1] < (int16_t)compact->right ? crossings[i + 1] : (int16_t)compact->right;

            if (from >= to) { continue; }
            if (!planned) {
                if (ring->count == 3) {
                    triangle_plane(ring, &plane);
                } else if (!polygon_plane(ring, &plane)) {
                    return;
                }
                planned = true;
            }
            span(compact, row, from, to, compact->depth ? &plane : NULL, level);
        }
    }
}
