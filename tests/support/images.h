/* Image files made by hand, for what reads them. */
#ifndef TESTS_SUPPORT_IMAGES_H
#define TESTS_SUPPORT_IMAGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct image_bytes {
    uint8_t *at; /* malloc'ed */
    size_t size;
} image_bytes_t;

/* A PNG file of rows as they are: colour_type and depth of the format, palette entries of 3 bytes, and their alphas. */
typedef struct images_png {
    uint32_t width, height;
    int colour_type, depth;
    bool interlaced;
    const uint8_t *rows; /* packed, without gaps */
    size_t row_bytes;
    const uint8_t (*palette)[3];
    const uint8_t *alphas;
    int entries;
    double gamma; /* 0: not told */
} images_png_t;

image_bytes_t images_png(const images_png_t *png);

/* 8 bits of red, green, blue and, with alpha, alpha. */
image_bytes_t images_png_rgb(uint32_t width, uint32_t height, const uint8_t *pixels, bool alpha);

/* A JPEG file of the best quality; components 1: grey, 3: RGB, 4: CMYK. */
image_bytes_t images_jpeg(uint32_t width, uint32_t height, const uint8_t *pixels, int components);

/* Into the folder of folder.h; returns its path. */
const char *images_put(const char *name, image_bytes_t bytes);

/* A PNG file there, 4 x 2, of four colours, left to right, in two rows alike. */
void images_put_stripes(const char *name);

#endif
