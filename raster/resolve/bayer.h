/* The matrix that dithers. */
#ifndef TUILE_RESOLVE_BAYER_H
#define TUILE_RESOLVE_BAYER_H

#include <stdint.h>

/* The value of Bayer's 8x8 matrix at a pixel of the window, 0 ... 63. B. E. Bayer, An optimum method for two-level rendition of
 * continuous-tone pictures, 1973: each matrix is made of four of half the size, 4 m + {0, 2; 3, 1}, so the lowest bits of x and y,
 * which tell neighbours apart, weigh most. */
static inline unsigned resolve_bayer(uint32_t x, uint32_t y) {
    unsigned value = 0;
    for (unsigned bit = 0; bit < 3; bit++) {
        value = 4u * value + 2u * (unsigned)((x ^ y) >> bit & 1u) + (unsigned)(y >> bit & 1u);
    }
    return value;
}

#endif
