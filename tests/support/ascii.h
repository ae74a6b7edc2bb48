/* Small pictures of coverage as text: '.' not covered, '#' covered once, '2' ... '9' more often. */
#ifndef TESTS_SUPPORT_ASCII_H
#define TESTS_SUPPORT_ASCII_H

#include <stdbool.h>
#include <stdint.h>

#define ASCII_MAX_PX 64

typedef struct ascii_picture {
    int32_t width, height;
    char rows[ASCII_MAX_PX][ASCII_MAX_PX + 1];
    bool outside; /* something was drawn beyond the window, or an empty span */
} ascii_picture_t;

void ascii_clear(ascii_picture_t *picture, int32_t width, int32_t height);

/* A polygon_span_fn: picture is an ascii_picture_t. */
void ascii_span(void *picture, int32_t row, int32_t first, int32_t end);

void ascii_hit(ascii_picture_t *picture, int32_t x, int32_t y);

/* Compares with the rows as written, one string each, as many as the picture has rows. Where they differ prints both and, between
 * them, where: '+' drawn too much, '-' missing. */
bool ascii_same(const ascii_picture_t *picture, const char *const *rows, const char *what);

/* The same for two pictures. */
bool ascii_equal(const ascii_picture_t *picture, const ascii_picture_t *expected, const char *what);

#endif
