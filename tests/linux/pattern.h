/* What drm_pattern draws, for those who look at what arrived. */
#ifndef TESTS_LINUX_PATTERN_H
#define TESTS_LINUX_PATTERN_H

#include <stdint.h>

/* The second picture changes a rectangle of the first: columns and rows from first to before end. */
enum { PATTERN_LEFT = 13, PATTERN_RIGHT = 41, PATTERN_TOP = 7, PATTERN_BOTTOM = 29 };

/* 00RRGGBB; round 0 or 1. Over 64 x 33 pixels each component takes all of 256 values; the next 33 rows are the same, so that there
 * is something to compress. */
static inline uint32_t pattern_pixel(uint32_t x, uint32_t y, uint32_t round) {
    const uint32_t row = y % 33;
    const uint32_t red = (4 * x + 65 * row + 31 * round) & 255, green = (61 * x + 4 * row + 97 * round) & 255;
    const uint32_t blue = (12 * x + 67 * row + 171 * round) & 255;

    return red << 16 | green << 8 | blue;
}

#endif
