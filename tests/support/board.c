#include "board.h"

#include "../../sim/panels.h"
#include "check.h"

void board_open_panel(board_t *board, const sim_panel_t *panel, const sim_bus_config_t *config) {
    sim_error_t error = {""};

    *board = (board_t){.panel = panel, .chip = panel->create(&error)};
    assert_non_null(board->chip);
    board->chip->uncut = true;
    sim_bus_open(&board->bus, config, board->chip);
}

void board_open(board_t *board, const sim_bus_config_t *config) {
    const sim_panel_t *panel = sim_panel_find("ili9341");

    assert_non_null(panel);
    board_open_panel(board, panel, config);
}

void board_close(board_t *board) { board->chip->destroy(board->chip); }

void board_check_clean(const board_t *board) {
    assert_string_equal(board->chip->fault.text, "");
    assert_string_equal(board->bus.error.text, "");
}

int board_start(board_t *board, uint8_t rotation, uint8_t wire) {
    return tuile_display_init(
        &board->display,
        &(tuile_display_config_t){.bus = &board->bus.bus, .panel = board->panel->panel, .rotation = rotation, .wire = wire});
}

/* ---- the test picture ------------------------------------------------------------------------------------------- */

/* Odd factors and a shift can be undone modulo 2^18, so no two pixels are alike. */
uint32_t board_colour(uint32_t width, uint32_t x, uint32_t y) {
    uint32_t c = (y * width + x) * 40503u & 0x3FFFF;

    c ^= c >> 9;
    c = c * 58163u & 0x3FFFF;
    return c ^ c >> 9;
}

/* Bits of a pixel as they come over the wire, the first one highest. */
typedef struct field {
    uint32_t value;
    unsigned bits;
} field_t;

static uint32_t eight_bits(uint32_t six) { return six << 2 | six >> 4; }

static field_t field_of(uint8_t wire, uint32_t c) {
    const uint32_t red = c >> 12, green = c >> 6 & 63, blue = c & 63;
    const uint32_t rgb565 = (red >> 1) << 11 | green << 5 | blue >> 1;
    const uint32_t rgb111 = (red >> 5) << 2 | (green >> 5) << 1 | blue >> 5;
    const uint32_t bgr888 = eight_bits(blue) << 16 | eight_bits(green) << 8 | eight_bits(red);

    switch (wire) {
    case TUILE_WIRE_RGB565: return (field_t){rgb565, 16};
    case TUILE_WIRE_RGB565_LE: return (field_t){(rgb565 & 255) << 8 | rgb565 >> 8, 16};
    case TUILE_WIRE_RGB444: return (field_t){(red >> 2) << 8 | (green >> 2) << 4 | blue >> 2, 12};
    case TUILE_WIRE_RGB666: return (field_t){red << 18 | green << 10 | blue << 2, 24};
    case TUILE_WIRE_RGB332: return (field_t){(red >> 3) << 5 | (green >> 3) << 2 | blue >> 4, 8};
    case TUILE_WIRE_GREY8: return (field_t){c >> 10, 8};
    case TUILE_WIRE_GREY4:
    case TUILE_WIRE_GREY4_TURNED: return (field_t){c >> 14, 4};
    case TUILE_WIRE_MONO_PAGES:
    case TUILE_WIRE_MONO_PAGES_TURNED:
    case TUILE_WIRE_MONO_ROWS: return (field_t){c >> 17, 1};
    case TUILE_WIRE_RGB111: return (field_t){rgb111, 3};
    case TUILE_WIRE_XRGB1111: return (field_t){rgb111, 4};
    case TUILE_WIRE_BGR888: return (field_t){bgr888, 24};
    case TUILE_WIRE_XRGB8888: return (field_t){bgr888 << 8, 32};
    default: fail_msg("wire format %u", wire); return (field_t){0, 0};
    }
}

/* Where the first of them is in a window of width x height, counted from bit 7 of the first byte. */
static size_t place_of(uint8_t wire, size_t bits, size_t width, size_t height, size_t x, size_t y) {
    switch (wire) {
    case TUILE_WIRE_MONO_PAGES: return 8 * (y / 8 * width + x) + 7 - y % 8;
    case TUILE_WIRE_MONO_PAGES_TURNED: return 8 * (x / 8 * height + y) + 7 - x % 8;
    case TUILE_WIRE_GREY4_TURNED: return 4 * (x * height + y);
    case TUILE_WIRE_RGB111: return (y * width + x) / 2 * 8 + 2 + (y * width + x) % 2 * 3;
    default: return bits * (y * width + x);
    }
}

static void put(uint8_t *to, size_t place, field_t field) {
    while (field.bits > 0) {
        const unsigned room = 8 - (unsigned)(place % 8), now = field.bits < room ? field.bits : room;
        field.bits -= now;
        to[place / 8] |= (uint8_t)((field.value >> field.bits & ((1u << now) - 1)) << (room - now));
        place += now;
    }
}

size_t board_encode(uint8_t *to, uint8_t wire, uint32_t picture_width, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    const size_t bits = wire == TUILE_WIRE_RGB111 ? 4 : field_of(wire, 0).bits, size_bytes = (bits * width * height + 7) / 8;

    memset(to, 0, size_bytes);
    for (uint32_t row = 0; row < height; row++) {
        for (uint32_t column = 0; column < width; column++) {
            const field_t field = field_of(wire, board_colour(picture_width, x + column, y + row));
            put(to, place_of(wire, bits, width, height, column, row), field);
        }
    }
    return size_bytes;
}

void board_seen(uint8_t rgb[3], uint8_t wire, uint32_t c) {
    const unsigned part[3] = {c >> 12, c >> 6 & 63, c & 63};

    for (unsigned i = 0; i < 3; i++) {
        unsigned six = part[i], eight;
        switch (wire) {
        case TUILE_WIRE_RGB565:
        case TUILE_WIRE_RGB565_LE: six = i == 1 ? six : (six & 62) | six >> 5; break;
        case TUILE_WIRE_RGB444: six = (six & 60) | six >> 4; break;
        default: break;
        }
        switch (wire) {
        case TUILE_WIRE_RGB332: eight = i == 2 ? six >> 4 : six >> 3; break;
        case TUILE_WIRE_GREY8: eight = c >> 10; break;
        case TUILE_WIRE_GREY4:
        case TUILE_WIRE_GREY4_TURNED: eight = 17 * (c >> 14); break;
        case TUILE_WIRE_MONO_PAGES:
        case TUILE_WIRE_MONO_PAGES_TURNED:
        case TUILE_WIRE_MONO_ROWS: eight = 255 * (c >> 17); break;
        case TUILE_WIRE_RGB111:
        case TUILE_WIRE_XRGB1111: eight = 255 * (six >> 5); break;
        default: eight = eight_bits(six); break;
        }
        if (wire == TUILE_WIRE_RGB332) { eight = i == 2 ? 85 * eight : eight << 5 | eight << 2 | eight >> 1; }
        rgb[i] = (uint8_t)eight;
    }
}

void board_check_pixel(const uint8_t *rgb, uint8_t wire, uint32_t c) {
    uint8_t expected[3];

    board_seen(expected, wire, c);
    if (memcmp(rgb, expected, 3) != 0) {
        fail_msg("colour %05X is %02X%02X%02X, not %02X%02X%02X", c, rgb[0], rgb[1], rgb[2], expected[0], expected[1], expected[2]);
    }
}

/* ---- drawn and looked at ---------------------------------------------------------------------------------------- */

int board_draw_window(tuile_display_t *display, uint8_t wire, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    static uint8_t buffers[2][4 * 320 * 480];
    static unsigned which;
    int result;

    assert_true(width * height <= 320 * 480);
    which = 1 - which;
    const size_t size_bytes = board_encode(buffers[which], wire, display->width, x, y, width, height);
    result = tuile_display_window(display, x, y, width, height);
    return result ? result : tuile_display_write(display, buffers[which], size_bytes);
}

static uint32_t round_up(uint32_t value, uint32_t unit) { return (value + unit - 1) / unit * unit; }

int board_draw(tuile_display_t *display, uint8_t wire, uint32_t tile_width, uint32_t tile_height) {
    tile_width = round_up(tile_width, display->align_x ? display->align_x : 1);
    tile_height = round_up(tile_height, display->align_y ? display->align_y : 1);
    for (uint32_t y = 0; y < display->height; y += tile_height) {
        for (uint32_t x = 0; x < display->width; x += tile_width) {
            const uint32_t width = display->width - x < tile_width ? display->width - x : tile_width;
            const uint32_t height = display->height - y < tile_height ? display->height - y : tile_height;
            const int result = board_draw_window(display, wire, x, y, width, height);
            if (result) { return result; }
        }
    }
    return tuile_display_present(display);
}

static void check_at(const board_t *board, const sim_picture_t *picture, uint32_t at_x, uint32_t at_y, uint8_t rotation,
                     uint8_t wire, uint32_t width, uint32_t x, uint32_t y) {
    const uint8_t *rgb = sim_picture_at(picture, at_x, at_y);
    uint8_t expected[3];

    board_seen(expected, wire, board_colour(width, x, y));
    if (memcmp(rgb, expected, 3) != 0) {
        fail_msg("%s, rotation %u, wire %u: pixel (%u, %u) is %02X%02X%02X, not %02X%02X%02X", board->panel->panel->name, rotation,
                 wire, x, y, rgb[0], rgb[1], rgb[2], expected[0], expected[1], expected[2]);
    }
}

void board_check_picture(const board_t *board, uint8_t rotation, uint8_t wire) {
    const tuile_panel_t *panel = board->panel->panel;
    const uint32_t width = rotation & 1 ? panel->view_height : panel->view_width;
    const uint32_t height = rotation & 1 ? panel->view_width : panel->view_height;
    sim_picture_t seen;

    assert_int_equal(sim_bus_picture(&board->bus, rotation, &seen, NULL), 0);
    assert_int_equal(seen.width, width);
    assert_int_equal(seen.height, height);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            check_at(board, &seen, x, y, rotation, wire, width, x, y);
        }
    }
    sim_picture_free(&seen);
}

void board_check_glass(const board_t *board, uint8_t rotation, uint8_t wire) {
    const uint32_t right = board->panel->panel->view_width - 1u, bottom = board->panel->panel->view_height - 1u;
    const uint32_t width = rotation & 1 ? bottom + 1 : right + 1, height = rotation & 1 ? right + 1 : bottom + 1;
    sim_picture_t glass;

    assert_int_equal(board->chip->glass(board->chip, &glass, NULL), 0);
    assert_int_equal(glass.width, right + 1);
    assert_int_equal(glass.height, bottom + 1);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            const uint32_t glass_x = rotation == 0 ? x : rotation == 1 ? right - y : rotation == 2 ? right - x : y;
            const uint32_t glass_y = rotation == 0 ? y : rotation == 1 ? x : rotation == 2 ? bottom - y : bottom - x;
            check_at(board, &glass, glass_x, glass_y, rotation, wire, width, x, y);
        }
    }
    sim_picture_free(&glass);
}
