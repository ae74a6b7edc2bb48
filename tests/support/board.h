/* A simulated board: the bus, the ILI9341 behind it and a display; and a test picture, drawn and looked at. */
#ifndef TESTS_SUPPORT_BOARD_H
#define TESTS_SUPPORT_BOARD_H

#include <stdint.h>

#include "../../hal/display.h"
#include "../../sim/bus.h"

typedef struct board {
    sim_chip_t *chip;
    sim_bus_t bus;
    tuile_display_t display;
} board_t;

/* Powers the chip and opens the bus; config may be NULL. The display is not started. */
void board_open(board_t *board, const sim_bus_config_t *config);
void board_close(board_t *board);

/* Fails the test when the chip or the bus has met with a fault. */
void board_check_clean(const board_t *board);

/* Starts the display, and returns what tuile_display_init does. */
int board_start(board_t *board, uint8_t rotation, uint8_t wire);

/* A test picture: 18 bits of colour that are unlike for each of the 76 800 pixels, as the factor is odd. */
uint32_t board_colour(uint32_t width, uint32_t x, uint32_t y);

/* Such a colour as it goes over the wire, in 2 or 3 bytes. */
void board_put_pixel(uint8_t *to, uint8_t wire, uint32_t c);

/* Fails the test when such a colour does not look as it has to after the wire, in 8 bits a channel. */
void board_check_pixel(const uint8_t *rgb, uint8_t wire, uint32_t c);

/* Draws the test picture in tiles, from two buffers by turns, and presents it; ends at the first error, and returns it. */
int board_draw(tuile_display_t *display, uint8_t wire, uint32_t tile_width, uint32_t tile_height);

/* Fails the test when a viewer of the turned board does not see the test picture. */
void board_check_picture(const board_t *board, uint8_t rotation, uint8_t wire);

#endif
