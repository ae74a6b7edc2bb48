/* A canvas without a renderer: a window drawn whole or tile by tile, and looked at as text. */
#ifndef TESTS_SUPPORT_OVERLAY_H
#define TESTS_SUPPORT_OVERLAY_H

#include "../../raster/overlay/overlay.h"
#include "../../raster/pixel.h"

#define WINDOW_SAMPLES_MAX (128 * 128)

/* Samples of the whole window, 4 bytes each in memory whatever the kind. */
typedef struct window {
    int32_t width, height; /* pixels */
    pixel_kind_t kind;
    unsigned shift;
    bool crisp;
    uint32_t samples[WINDOW_SAMPLES_MAX];
    uint32_t glyphs_missing;
} window_t;

typedef void (*window_draw_fn)(const void *context, tuile_canvas_t *canvas);

/* A black window of 24-bit colours, a sample a pixel. */
void window_open(window_t *window, int32_t width, int32_t height);

/* Draws tile by tile over what is there, tile_width x tile_height pixels each. Fails the test when bytes beside a tile change. */
void window_draw(window_t *window, int32_t tile_width, int32_t tile_height, window_draw_fn draw, const void *context);

uint32_t window_at(const window_t *window, int32_t x, int32_t y);

/* Compares with rows of text: '.' black, '#' white, 1 ... 9, a ... f sixteenths of white. As many rows as the window has. Prints
 * both where they differ. */
bool window_looks(const window_t *window, const char *const *rows);

#endif
