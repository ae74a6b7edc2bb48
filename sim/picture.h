/* Pictures of 8-bit red, green, blue: what a simulated panel shows, and files of them. */
#ifndef SIM_PICTURE_H
#define SIM_PICTURE_H

#include <stddef.h>
#include <stdint.h>

#include "error.h"

#define SIM_PICTURE_MAX_PX 16384u /* width and height */

/* Rows from the top, 3 bytes a pixel, no gaps. {0} is an empty picture; rgb is from malloc and owned by the struct. */
typedef struct sim_picture {
    uint32_t width, height;
    uint8_t *rgb;
} sim_picture_t;

/* All functions here return 0, or -1 and one line in error (which may be NULL); out is then an empty picture. An out parameter
 * is overwritten, not freed: give an empty picture or one that was freed. */

/* Black. 1 ... SIM_PICTURE_MAX_PX each way. */
int sim_picture_create(sim_picture_t *out, uint32_t width, uint32_t height, sim_error_t *error);
void sim_picture_free(sim_picture_t *picture);

static inline uint8_t *sim_picture_at(const sim_picture_t *picture, uint32_t x, uint32_t y) {
    return picture->rgb + 3u * ((size_t)y * picture->width + x);
}

/* Writes PPM (P6) when the name ends in ".ppm", PNG when it ends in ".png"; other ends are an error. The file appears whole or not
 * at all: it is written beside its place and renamed, and what was there before stays until then. A path that is not a regular
 * file (a pipe, a device) is written to directly. */
int sim_picture_write(const sim_picture_t *picture, const char *path, sim_error_t *error);

/* Reads PNG (any kind, alpha over black) or binary PPM of 8 bits, told apart by their first bytes. */
int sim_picture_read(sim_picture_t *out, const char *path, sim_error_t *error);

/* Turned by quarter turns clockwise; negative ones turn back. */
int sim_picture_turn(const sim_picture_t *picture, int quarter_turns, sim_picture_t *out, sim_error_t *error);

/* Every pixel as a square of factor x factor. */
int sim_picture_magnify(const sim_picture_t *picture, uint32_t factor, sim_picture_t *out, sim_error_t *error);

/* Half as wide and high, rounded up; each pixel the mean of its 2 x 2, rounded to nearest (fewer at an odd edge). */
int sim_picture_halve(const sim_picture_t *picture, sim_picture_t *out, sim_error_t *error);

/* For people: where both pictures agree out is a dim grey a; where they differ it is red, with the size of the difference from
 * 64 (least) to 255. count (may be NULL) receives the number of pixels that differ. Pictures of unlike size are an error. */
int sim_picture_difference(const sim_picture_t *a, const sim_picture_t *b, sim_picture_t *out, size_t *count, sim_error_t *error);

/* So many empty pictures, NULL when out of memory; and away with all of them (NULL: nothing is done). */
sim_picture_t *sim_pictures_create(size_t count);
void sim_pictures_free(sim_picture_t *pictures, size_t count);

#endif
