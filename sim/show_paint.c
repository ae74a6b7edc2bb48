#include "show_paint.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

void paint_point(const paint_t *p, unsigned x, unsigned y, const uint8_t rgb[3]) {
    if (x < p->picture->width && y < p->picture->height) { memcpy(sim_picture_at(p->picture, x, y), rgb, 3); }
}

void paint_pixel(const paint_t *p, unsigned x, unsigned y, const uint8_t rgb[3]) {
    for (unsigned i = 0; i < p->zoom * p->zoom; i++) {
        paint_point(p, x * p->zoom + i % p->zoom, y * p->zoom + i / p->zoom, rgb);
    }
}

void paint_outline(const paint_t *p, unsigned left, unsigned top, unsigned right, unsigned bottom, const uint8_t rgb[3]) {
    for (unsigned x = left * p->zoom; x < right * p->zoom; x++) {
        paint_point(p, x, top * p->zoom, rgb);
        paint_point(p, x, bottom * p->zoom - 1, rgb);
    }
    for (unsigned y = top * p->zoom; y < bottom * p->zoom; y++) {
        paint_point(p, left * p->zoom, y, rgb);
        paint_point(p, right * p->zoom - 1, y, rgb);
    }
}

void paint_heat(double value, uint8_t rgb[3]) {
    static const uint8_t stops[5][3] = {{8, 8, 24}, {32, 48, 160}, {176, 32, 128}, {248, 144, 24}, {255, 255, 224}};
    const double at = value <= 0 ? 0 : value >= 1 ? 3.999 : value * 3.999;
    const int i = (int)at;
    for (int k = 0; k < 3; k++) {
        rgb[k] = (uint8_t)(stops[i][k] + (at - i) * (stops[i + 1][k] - stops[i][k]));
    }
}

/* Rows of three bits, from the top. */
static const uint8_t digits[10][5] = {
    {7, 5, 5, 5, 7}, {2, 6, 2, 2, 7}, {7, 1, 7, 4, 7}, {7, 1, 3, 1, 7}, {5, 5, 7, 1, 1},
    {7, 4, 7, 1, 7}, {7, 4, 7, 5, 7}, {7, 1, 2, 2, 2}, {7, 5, 7, 5, 7}, {7, 5, 7, 1, 7},
};

unsigned paint_number_width(unsigned number) { return 4 * (unsigned)snprintf(NULL, 0, "%u", number) + 1; }

void paint_number(const paint_t *p, unsigned x, unsigned y, unsigned number) {
    static const uint8_t white[3] = {255, 255, 255}, black[3] = {0, 0, 0};
    const unsigned width = paint_number_width(number), columns = p->picture->width / p->zoom, rows = p->picture->height / p->zoom;
    char text[12];
    if (width > columns || PAINT_NUMBER_HEIGHT > rows) { return; }
    x = x + width > columns ? columns - width : x;
    y = y + PAINT_NUMBER_HEIGHT > rows ? rows - PAINT_NUMBER_HEIGHT : y;
    for (unsigned i = 0; i < width * PAINT_NUMBER_HEIGHT; i++) {
        paint_pixel(p, x + i % width, y + i / width, black);
    }
    (void)snprintf(text, sizeof text, "%u", number);
    for (unsigned d = 0; text[d]; d++) {
        for (unsigned i = 0; i < 15; i++) {
            const bool on = (digits[text[d] - '0'][i / 3] >> (2 - i % 3) & 1) != 0;
            if (on) { paint_pixel(p, x + 1 + 4 * d + i % 3, y + 1 + i / 3, white); }
        }
    }
}
