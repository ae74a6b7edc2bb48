#include "morph.h"

#include "../fixed.h"

void morph_positions(const int16_t *a, const int16_t *b, const int8_t *fractions, unsigned count, uint16_t morph, int16_t *whole,
                     int8_t *fraction) {
    for (unsigned i = 0; i < 3 * count; i++) {
        const int32_t at = morph_coordinate(a[i], b[i], fractions ? fractions[i] : 0, morph);
        const int32_t steps = (at + 128) >> 8; /* 256 * 32767 + 127 is the most: steps fit */
        whole[i] = (int16_t)steps;
        fraction[i] = (int8_t)(at - 256 * steps);
    }
}

/* floor(sqrt(square)) for square <= 3 * 2^22, by Newton's steps from above: four or five for normals that are not opposite. */
static int32_t root(int32_t square) {
    int32_t length = 3548, next = (length + square / length) / 2;
    while (next < length && next > 0) {
        length = next;
        next = (length + square / length) / 2;
    }
    return square > 0 ? length : 0;
}

static void morph_normal(const int8_t *a, const int8_t *b, uint16_t morph, int8_t *out) {
    int32_t v[3], squares = 0;
    for (unsigned i = 0; i < 3; i++) {
        const int32_t sum = a[i] * (int32_t)(TUILE_MORPH_ONE - morph) + b[i] * (int32_t)morph; /* |sum| <= 2^22 */
        v[i] = (sum + 1024) >> 11;                                                             /* 1/16: |v| <= 2048 */
        squares += v[i] * v[i];
    }
    const int32_t length = root(squares);
    for (unsigned i = 0; i < 3; i++) {
        const int32_t unit = length ? fixed_floor_div(254 * v[i] + length, 2 * length) : 0;
        out[i] = (int8_t)(unit > 127 ? 127 : unit < -127 ? -127 : unit); /* the root was rounded down */
    }
}

void morph_normals(const int8_t *a, const int8_t *b, unsigned count, uint16_t morph, int8_t *out) {
    for (; count; count--, a += 3, b += 3, out += 3) {
        const bool still = a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
        if (still || morph == TUILE_MORPH_ONE) {
            out[0] = b[0], out[1] = b[1], out[2] = b[2];
        } else {
            morph_normal(a, b, morph, out);
        }
    }
}
