/* A test card: what a display must show if all of its settings are right. It is an overlay (raster/overlay/overlay.h) over nothing,
 * so that it goes to a display by the way of every frame.
 *
 * A border of one pixel along the edge (and, on a round glass, along the circle); each corner named, TL, TR, BL, BR, for the eye
 * and for the test in white on black; an arrow that points up; three bars, red, green, blue from left to right; a ramp of sixteen
 * greys from black, left, to white. */
#ifndef SIM_CARD_H
#define SIM_CARD_H

#include <stdbool.h>

#include "../raster/overlay/overlay.h"

typedef struct card {
    const tuile_font_t *font;
    const char *title; /* a line below the arrow, left out where it has no room; may be NULL */
    bool round;
} card_t;

/* Where things are, in pixels. Everything is within the border, and nothing overlaps. */
typedef struct card_layout {
    tuile_box_t arrow, bars, ramp;
    int32_t inset_x, inset_y; /* of the corners' names from the edges */
} card_layout_t;

card_layout_t card_layout(const card_t *card, uint16_t width, uint16_t height);

/* tuile_config_t.overlay; context is a card_t. Windows of at least 64x32 pixels hold all of it. */
void card_draw(void *context, tuile_canvas_t *canvas);

#endif
