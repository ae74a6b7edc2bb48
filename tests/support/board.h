/* A simulated board: the bus, a panel behind it and a display; and a test picture, written in any wire format and looked at. */
#ifndef TESTS_SUPPORT_BOARD_H
#define TESTS_SUPPORT_BOARD_H

#include <stdint.h>

#include "../../hal/display.h"
#include "../../sim/bus.h"
#include "../../sim/panels.h"

typedef struct board {
    const sim_panel_t *panel;
    sim_chip_t *chip;
    sim_bus_t bus;
    tuile_display_t display;
} board_t;

/* Powers the chip and opens the bus; config may be NULL. The display is not started. A round glass shows its whole square. */
void board_open_panel(board_t *board, const sim_panel_t *panel, const sim_bus_config_t *config);
void board_open(board_t *board, const sim_bus_config_t *config); /* the ILI9341 */
void board_close(board_t *board);

/* Fails the test when the chip or the bus has met with a fault. */
void board_check_clean(const board_t *board);

/* Starts the display, and returns what tuile_display_init does. */
int board_start(board_t *board, uint8_t rotation, uint8_t wire);

/* A test picture: 18 bits of colour, red in the upper 6, green, blue. They are unlike for each of the first 262 144 pixels, and
 * each bit alone changes as noise does, so that formats of few bits tell pixels apart too. */
uint32_t board_colour(uint32_t width, uint32_t x, uint32_t y);

/* Such a colour as it is seen after the wire, in 8 bits a channel; wire is any format but DEFAULT. Formats keep the upper bits;
 * grey and mono keep those of red. A chip of the MIPI family holds 18 bits, so 4 and 5 bits are repeated into 6 and these into 8.
 */
void board_seen(uint8_t rgb[3], uint8_t wire, uint32_t c);

/* Fails the test when rgb is not that. */
void board_check_pixel(const uint8_t *rgb, uint8_t wire, uint32_t c);

/* A window of the test picture, which is picture_width wide, as it goes over the wire in any format but DEFAULT: written from
 * hal/wire.h alone. Returns the count of bytes; at most 4 a pixel; bits left in the last are 0. */
size_t board_encode(uint8_t *to, uint8_t wire, uint32_t picture_width, uint32_t x, uint32_t y, uint32_t width, uint32_t height);

/* Writes one window of the test picture, from two buffers by turns; at most 320 x 480 pixels. Returns the first error. */
int board_draw_window(tuile_display_t *display, uint8_t wire, uint32_t x, uint32_t y, uint32_t width, uint32_t height);

/* Draws the test picture in tiles and presents it; ends at the first error, and returns it. A tile's size is rounded up to the
 * display's alignment; a tile larger than the picture is cut. */
int board_draw(tuile_display_t *display, uint8_t wire, uint32_t tile_width, uint32_t tile_height);

/* Fails the test when a viewer of the turned board does not see the test picture. */
void board_check_picture(const board_t *board, uint8_t rotation, uint8_t wire);

/* Fails it when the test picture is not turned clockwise by the rotation on the glass as that lies at rotation 0. */
void board_check_glass(const board_t *board, uint8_t rotation, uint8_t wire);

#endif
