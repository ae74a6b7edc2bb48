/* What the demo writes over its frames: how many a second, and by which method. Boards and the simulator draw it alike. */
#ifndef TUILE_FIRMWARE_CAPTION_H
#define TUILE_FIRMWARE_CAPTION_H

#include "../raster/overlay/overlay.h"

#define CAPTION_RATE_MOST 9999u

typedef struct caption {
    tuile_font_t font; /* opened */
    bool show_rate, show_method;
    uint16_t rate;  /* tenths of a frame a second, at most CAPTION_RATE_MOST; 0: not known yet, "--.- fps" */
    uint8_t method; /* tuile_method_t */
} caption_t;

/* Names by tuile_method_t. */
extern const char *const caption_methods[5];

/* Frames in a time as a rate, rounded to nearest and held to 1 ... CAPTION_RATE_MOST. us > 0. */
uint16_t caption_rate(uint32_t frames, uint32_t us);

/* A tuile_overlay_fn whose context is a caption_t: the rate in the upper left corner, the method in the upper right one, in white
 * on black, and twice as large where the window is 200 pixels wide or more. Constant while a frame is drawn. */
void caption_draw(void *context, tuile_canvas_t *canvas);

#endif
