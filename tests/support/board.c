#include "board.h"

#include "../../hal/panels/ili9341.h"
#include "../../sim/chips/ili9341.h"
#include "check.h"

void board_open(board_t *board, const sim_bus_config_t *config) {
    sim_error_t error = {""};

    board->chip = sim_ili9341_create(&error);
    assert_non_null(board->chip);
    sim_bus_open(&board->bus, config, board->chip);
}

void board_close(board_t *board) { board->chip->destroy(board->chip); }

void board_check_clean(const board_t *board) {
    assert_string_equal(board->chip->fault.text, "");
    assert_string_equal(board->bus.error.text, "");
}

int board_start(board_t *board, uint8_t rotation, uint8_t wire) {
    return tuile_display_init(
        &board->display,
        &(tuile_display_config_t){.bus = &board->bus.bus, .panel = &tuile_ili9341, .rotation = rotation, .wire = wire});
}

uint32_t board_colour(uint32_t width, uint32_t x, uint32_t y) { return (y * width + x) * 40503u & 0x3FFFF; }

void board_put_pixel(uint8_t *to, uint8_t wire, uint32_t c) {
    unsigned red = c >> 12, green = c >> 6 & 63, blue = c & 63;

    if (wire == TUILE_WIRE_RGB666) {
        to[0] = (uint8_t)(red << 2);
        to[1] = (uint8_t)(green << 2);
        to[2] = (uint8_t)(blue << 2);
    } else {
        to[0] = (uint8_t)((red >> 1) << 3 | green >> 3);
        to[1] = (uint8_t)((green & 7) << 5 | blue >> 1);
    }
}

/* What 6 bits, or the 5 upper ones of them repeated into 6, look like in 8. */
void board_check_pixel(const uint8_t *rgb, uint8_t wire, uint32_t c) {
    unsigned part[3] = {c >> 12, c >> 6 & 63, c & 63};

    for (unsigned i = 0; i < 3; i++) {
        unsigned six = wire == TUILE_WIRE_RGB565 && i != 1 ? (part[i] & 62) | part[i] >> 5 : part[i];
        if (rgb[i] != (six << 2 | six >> 4)) { fail_msg("colour %05X: part %u is %u", c, i, rgb[i]); }
    }
}

int board_draw(tuile_display_t *display, uint8_t wire, uint32_t tile_width, uint32_t tile_height) {
    static uint8_t buffers[2][3 * 320 * 320];
    unsigned which = 0;
    uint32_t pixel_bytes = wire == TUILE_WIRE_RGB666 ? 3 : 2;

    for (uint32_t y = 0; y < display->height; y += tile_height) {
        for (uint32_t x = 0; x < display->width; x += tile_width) {
            uint32_t width = display->width - x < tile_width ? display->width - x : tile_width;
            uint32_t height = display->height - y < tile_height ? display->height - y : tile_height;
            uint8_t *to = buffers[which];
            int result;
            which = 1 - which;
            for (uint32_t row = 0; row < height; row++) {
                for (uint32_t column = 0; column < width; column++) {
                    board_put_pixel(to + pixel_bytes * (row * width + column), wire,
                                    board_colour(display->width, x + column, y + row));
                }
            }
            if ((result = tuile_display_window(display, x, y, width, height)) ||
                (result = tuile_display_write(display, to, pixel_bytes * width * height))) {
                return result;
            }
        }
    }
    return tuile_display_present(display);
}

void board_check_picture(const board_t *board, uint8_t rotation, uint8_t wire) {
    sim_picture_t seen;
    uint32_t width = rotation & 1 ? 320 : 240, height = rotation & 1 ? 240 : 320;

    assert_int_equal(sim_bus_picture(&board->bus, rotation, &seen, NULL), 0);
    assert_int_equal(seen.width, width);
    assert_int_equal(seen.height, height);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            board_check_pixel(sim_picture_at(&seen, x, y), wire, board_colour(width, x, y));
        }
    }
    sim_picture_free(&seen);
}
