/* What views of a frame are painted with: pixels of the window as squares, outlines, a ramp of colours, numbers. */
#ifndef SIM_SHOW_PAINT_H
#define SIM_SHOW_PAINT_H

#include "picture.h"

/* A picture whose pixels are those of the window, `zoom` times as large. */
typedef struct paint {
    const sim_picture_t *picture;
    unsigned zoom;
} paint_t;

/* Coordinates of the picture; outside of it nothing happens. */
void paint_point(const paint_t *p, unsigned x, unsigned y, const uint8_t rgb[3]);

/* Coordinates of the window: one pixel; a rectangle's border of one point, drawn within it. */
void paint_pixel(const paint_t *p, unsigned x, unsigned y, const uint8_t rgb[3]);
void paint_outline(const paint_t *p, unsigned left, unsigned top, unsigned right, unsigned bottom, const uint8_t rgb[3]);

/* 0 ... 1 to black, blue, magenta, orange, white. */
void paint_heat(double value, uint8_t rgb[3]);

/* A number in white on black, its top left corner at a pixel of the window, moved to where it fits. Digits are 3 x 5 pixels of the
 * window, with one pixel of black around. */
void paint_number(const paint_t *p, unsigned x, unsigned y, unsigned number);
unsigned paint_number_width(unsigned number);
#define PAINT_NUMBER_HEIGHT 7u

#endif
