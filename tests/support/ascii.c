#include "ascii.h"

#include <stdio.h>
#include <string.h>

void ascii_clear(ascii_picture_t *picture, int32_t width, int32_t height) {
    picture->width = width;
    picture->height = height;
    picture->outside = width > ASCII_MAX_PX || height > ASCII_MAX_PX;
    for (int32_t y = 0; y < height && y < ASCII_MAX_PX; y++) {
        memset(picture->rows[y], '.', ASCII_MAX_PX);
        picture->rows[y][width < ASCII_MAX_PX ? width : ASCII_MAX_PX] = 0;
    }
}

void ascii_hit(ascii_picture_t *picture, int32_t x, int32_t y) {
    if (x < 0 || y < 0 || x >= picture->width || y >= picture->height) {
        picture->outside = true;
        return;
    }
    char *cell = &picture->rows[y][x];
    *cell = *cell == '.' ? '#' : *cell == '#' ? '2' : *cell < '9' ? (char)(*cell + 1) : '9';
}

void ascii_span(void *context, int32_t row, int32_t first, int32_t end) {
    ascii_picture_t *picture = context;
    if (first >= end) { picture->outside = true; }
    for (int32_t x = first; x < end; x++) {
        ascii_hit(picture, x, row);
    }
}

bool ascii_same(const ascii_picture_t *picture, const char *const *rows, const char *what) {
    bool same = !picture->outside;
    for (int32_t y = 0; y < picture->height; y++) {
        same &= strcmp(picture->rows[y], rows[y]) == 0;
    }
    if (same) { return true; }
    printf("%s%s\n  expected, difference, drawn:\n", what, picture->outside ? ": drawn outside the window, or an empty span" : "");
    for (int32_t y = 0; y < picture->height; y++) {
        char difference[ASCII_MAX_PX + 1];
        for (int32_t x = 0; x < picture->width; x++) {
            const char drawn = picture->rows[y][x], wanted = rows[y][x];
            difference[x] = drawn == wanted ? ' ' : wanted == '.' ? '+' : drawn == '.' ? '-' : '*';
        }
        difference[picture->width] = 0;
        printf("  %s |%s| %s\n", rows[y], difference, picture->rows[y]);
    }
    return false;
}

bool ascii_equal(const ascii_picture_t *picture, const ascii_picture_t *expected, const char *what) {
    const char *rows[ASCII_MAX_PX];
    for (int32_t y = 0; y < expected->height; y++) {
        rows[y] = expected->rows[y];
    }
    return picture->width == expected->width && picture->height == expected->height && ascii_same(picture, rows, what);
}
