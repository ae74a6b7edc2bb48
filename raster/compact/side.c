/* The side of a polygon that crosses itself, or meets itself: parts of it may turn the other way in the window, so its plane tells.
 */
#include "inside.h"

#include "../geometry/model.h"

/* A position in 1/256 step: 25 bits with its sign. */
static void place_of(const tuile_compact_t *compact, uint16_t number, int32_t place[3]) {
    int16_t q[3];
    int8_t f[3];

    (void)compact_position(compact, number, q, f);
    for (uint8_t k = 0; k < 3; k++) {
        place[k] = 256 * (int32_t)q[k] + f[k];
    }
}

static uint64_t magnitude(int64_t value) { return (uint64_t)(value < 0 ? -value : value); }

/* (b - a) x (c - a): below 2^53. */
static uint64_t cross(const int32_t a[3], const int32_t b[3], const int32_t c[3], int64_t normal[3]) {
    uint64_t size = 0;

    for (uint8_t k = 0; k < 3; k++) {
        const uint8_t i = (uint8_t)(k == 2 ? 0 : k + 1), j = (uint8_t)(3 - k - i);

        normal[k] = (int64_t)(b[i] - a[i]) * (c[j] - a[j]) - (int64_t)(b[j] - a[j]) * (c[i] - a[i]);
        size += magnitude(normal[k]);
    }
    return size;
}

/* Of the triangles of the fan round the first corner the largest is the least disturbed by rounding. |normal[k]| < 2^30. */
static void normal_of(const tuile_compact_t *compact, const uint16_t *numbers, uint8_t count, const int32_t first[3],
                      int32_t normal[3]) {
    int64_t best[3] = {0, 0, 0};
    uint64_t most = 0;
    int32_t last[3];

    place_of(compact, numbers[1], last);
    for (uint8_t i = 2; i < count; i++) {
        int32_t place[3];
        int64_t found[3];

        place_of(compact, numbers[i], place);
        const uint64_t size = cross(first, last, place, found);
        for (uint8_t k = 0; k < 3; k++) {
            if (size > most) { best[k] = found[k]; }
            last[k] = place[k];
        }
        if (size > most) { most = size; }
    }
    const unsigned shift = most >> 30 ? 31u - fixed_clz32((uint32_t)(most >> 29)) : 0; /* most < 2^55 */
    for (uint8_t k = 0; k < 3; k++) {
        normal[k] = (int32_t)(best[k] >> shift);
    }
}

bool compact_plane_front(const tuile_compact_t *compact, const uint16_t *numbers, uint8_t count,
                         const TUILE_FLASH uint8_t *outward) {
    const tuile_compact_view_t *view = &compact->view;
    const int bits = view->observer_bits - 8;
    int64_t height = 0, turned = 0; /* |height| < 3 * 2^61 */
    int32_t first[3], normal[3];

    place_of(compact, numbers[0], first);
    normal_of(compact, numbers, count, first, normal);
    for (uint8_t k = 0; k < 3; k++) {
        const int32_t at = bits >= 0 ? (int32_t)((uint32_t)first[k] << bits) : first[k] >> (bits < -30 ? 30 : -bits);

        height += normal[k] * ((int64_t)view->observer[k] - at);
        turned += (int64_t)normal[k] * (int8_t)outward[k];
    }
    return ((height >= 0) == (turned >= 0)) != view->mirrored;
}
