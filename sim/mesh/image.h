/* Image files as pixels. Values are taken as they are: no gamma, no colour profile. */
#ifndef SIM_MESH_IMAGE_H
#define SIM_MESH_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "../error.h"

#define IMAGE_SIDE_MAX 16384u /* pixels across or down */

typedef struct image {
    uint32_t width, height;
    uint8_t (*pixels)[4]; /* red, green, blue, alpha; row 0 on top */
} image_t;

void image_free(image_t *image);

/* PNG (1 to 16 bits, grey, palette, alpha, interlaced) and JPEG (grey and colour), known by their first bytes. -1 and an error that
 * begins with `name` when the bytes are neither, broken, cut short, of no size or larger than IMAGE_SIDE_MAX; image is then
 * cleared. */
int image_decode(image_t *image, const uint8_t *bytes, size_t size_bytes, const char *name, sim_error_t *error);

#endif
