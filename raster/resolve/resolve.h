/* Samples to wire bytes: the one place that knows how a colour looks on the wire.
 *
 * A pixel's samples are added up, exactly, and their sum becomes steps of the format in one rounding:
 *
 *     steps = floor(sum * most / (full * samples) + threshold)
 *
 * with `most` the greatest step of the format and `full` the greatest value of a sample. The threshold is 1/2, or, dithered,
 * (2 b + 1) / 128 with b from Bayer's matrix of 0 ... 63 at the pixel's place in the window. Where the sum stands f of a step above
 * a whole one, #{b: (2 b + 1) / 128 >= 1 - f} = floor(64 f + 1/2) of the 64 pixels of any 8x8 block take the higher step: the mean
 * of the block is within 1/128 step of the colour. Sums of 0 and of full * samples stay whole, since 0 < threshold < 1: black is
 * black and white is white.
 */
#ifndef TUILE_RESOLVE_RESOLVE_H
#define TUILE_RESOLVE_RESOLVE_H

#include "../pixel.h"
#include "bayer.h"

#define RESOLVE_RUN 32    /* pixels that are resolved at once: whole periods of the matrix */
#define RESOLVE_MATRIX 8u /* pixels along the matrix */

/* Pixels of a row. */
typedef struct resolve_run {
    const void *samples;                 /* the top left one of the first pixel */
    size_t stride;                       /* samples from row to row */
    unsigned shift;                      /* log2 of the samples along a pixel: 0, 1 or 2 */
    uint32_t sums[RESOLVE_RUN];          /* of a pixel's samples, in fields of one word (mean.c) */
    uint32_t green[RESOLVE_RUN];         /* RGB888: the sums that have no room there */
    uint32_t thresholds[RESOLVE_MATRIX]; /* of pixel i at i % 8: 128ths of a step, times the samples of a pixel */
    uint32_t width, height;              /* of the tile, in pixels */
    uint32_t x, y, count;                /* the run: its first pixel in the tile, 1 ... RESOLVE_RUN; x is a multiple of 8 */
} resolve_run_t;

/* Adds up the samples of the run's pixels. */
typedef void (*resolve_sum_fn)(resolve_run_t *run);

/* Puts the run into the bytes of its tile. Runs come from left to right and rows from top to bottom, so that a byte which several
 * pixels share is set by the first of them. */
typedef void (*resolve_put_fn)(const resolve_run_t *restrict run, uint8_t *restrict bytes);

typedef struct resolve_way {
    resolve_sum_fn sum; /* NULL: there is nothing to add */
    resolve_put_fn put;
} resolve_way_t;

/* For one sample a pixel (single.c), and for several (mean.c). Not for FACE_IDS, nor for samples that are wire bytes. */
resolve_way_t resolve_single(pixel_kind_t kind, uint8_t format);
resolve_way_t resolve_mean(pixel_kind_t kind, uint8_t format);

#endif
