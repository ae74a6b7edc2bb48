/* The display layer, the ILI9341's data, the simulated bus and chip, and the frame loop.
 *
 * Bytes and numbers that are expected come from the data sheet and from hand, never from the code under test. The frame loop is
 * tested against a renderer of our own, so that it can be made to fail at will. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../hal/display.h"
#include "../hal/panels/ili9341.h"
#include "../hal/template/bus.h"
#include "../raster/tuile.h"
#include "../sim/bus.h"
#include "../sim/chips/ili9341.h"

/* ---- a bus that writes down what it is told --------------------------------------------------------------- */

typedef struct recorder {
    char log[8192];
    size_t length;
    unsigned calls;
    int fail_with;    /* every call from now on */
    unsigned fail_at; /* or this one, counted from 1 */
    uint32_t command_clock_hz, pixel_clock_hz;
} recorder_t;

static void note(recorder_t *recorder, const char *format, ...) {
    va_list arguments;
    int length;

    va_start(arguments, format);
    length = vsnprintf(recorder->log + recorder->length, sizeof recorder->log - recorder->length, format, arguments);
    va_end(arguments);
    assert_true(length >= 0 && (size_t)length < sizeof recorder->log - recorder->length);
    recorder->length += (size_t)length;
}

static int record_result(const recorder_t *recorder) {
    return recorder->calls == recorder->fail_at ? TUILE_HAL_IO : recorder->fail_with;
}

static int record_clocks(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz) {
    recorder_t *recorder = context;

    recorder->command_clock_hz = command_clock_hz;
    recorder->pixel_clock_hz = pixel_clock_hz;
    return 0;
}

/* D/C low before the bar, high after it. */
static int record_command(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes) {
    recorder_t *recorder = context;

    recorder->calls++;
    for (size_t i = 0; i < size_bytes; i++) {
        note(recorder, "%s%02X", i == 0 ? "" : i == low_count ? "|" : " ", bytes[i]);
    }
    note(recorder, "\n");
    return record_result(recorder);
}

static int record_data(void *context, const uint8_t *bytes, size_t size_bytes) {
    recorder_t *recorder = context;

    recorder->calls++;
    note(recorder, "data %zu: %02X\n", size_bytes, bytes[0]);
    return record_result(recorder);
}

static int record_wait(void *context) {
    recorder_t *recorder = context;

    recorder->calls++;
    note(recorder, "wait\n");
    return record_result(recorder);
}

static int record_delay(void *context, uint32_t delay_ms) {
    recorder_t *recorder = context;

    recorder->calls++;
    note(recorder, "delay %u\n", delay_ms);
    return record_result(recorder);
}

static int record_pin(void *context, tuile_pin_t pin, uint8_t level) {
    recorder_t *recorder = context;

    recorder->calls++;
    note(recorder, "%s %u\n", pin == TUILE_PIN_RESET ? "reset" : "backlight", level);
    return record_result(recorder);
}

static tuile_bus_t recording_bus(recorder_t *recorder) {
    memset(recorder, 0, sizeof *recorder);
    return (tuile_bus_t){
        .context = recorder,
        .clocks = record_clocks,
        .command = record_command,
        .data = record_data,
        .wait = record_wait,
        .delay_ms = record_delay,
        .pin = record_pin,
        .pins = TUILE_PIN_BIT(TUILE_PIN_RESET) | TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT),
    };
}

static void forget(recorder_t *recorder) {
    recorder->length = 0;
    recorder->log[0] = '\0';
}

/* ---- bytes ------------------------------------------------------------------------------------------------- */

#define VENDOR_BLOCK                                    \
    "EF|03 80 02\n"                                     \
    "CF|00 C1 30\n"                                     \
    "ED|64 03 12 81\n"                                  \
    "E8|85 00 78\n"                                     \
    "CB|39 2C 00 34 02\n"                               \
    "F7|20\n"                                           \
    "EA|00 00\n"                                        \
    "C0|23\n"                                           \
    "C1|10\n"                                           \
    "C5|3E 28\n"                                        \
    "C7|86\n"                                           \
    "B1|00 13\n"                                        \
    "F2|00\n"                                           \
    "26|01\n"                                           \
    "E0|0F 31 2B 0C 0E 08 4E F1 37 07 10 03 0E 09 00\n" \
    "E1|00 0E 14 03 11 07 31 C1 48 08 0F 0C 31 36 0F\n" \
    "B6|08 C2 27\n"                                     \
    "11\n"                                              \
    "delay 120\n"

static void test_ili9341_init_bytes(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder);
    tuile_display_t display;

    (void)state;
    assert_int_equal(tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341}), 0);
    assert_string_equal(recorder.log, "backlight 0\n"
                                      "reset 1\nreset 0\ndelay 1\nreset 1\ndelay 120\n" VENDOR_BLOCK "36|08\n"
                                      "3A|55\n"
                                      "29\n");
    assert_int_equal(recorder.command_clock_hz, 10000000);
    assert_int_equal(recorder.pixel_clock_hz, 40000000);
    assert_true(display.refresh);
    assert_int_equal(display.width, 240);
    assert_int_equal(display.height, 320);
}

static void test_ili9341_init_bytes_without_pins_turned_18_bits(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder);
    tuile_display_t display;
    tuile_display_config_t config = {
        .bus = &bus, .panel = &tuile_ili9341, .rotation = 1, .wire = TUILE_WIRE_RGB666, .pixel_clock_hz = 62500000};

    (void)state;
    bus.pins = 0;
    assert_int_equal(tuile_display_init(&display, &config), 0);
    assert_string_equal(recorder.log, "delay 120\n"
                                      "01\n"
                                      "delay 120\n" VENDOR_BLOCK "36|68\n"
                                      "3A|66\n"
                                      "29\n");
    assert_int_equal(recorder.pixel_clock_hz, 62500000);
    assert_int_equal(display.width, 320);
    assert_int_equal(display.height, 240);
}

static void test_address_mode_of_each_rotation(void **state) {
    static const char *const expected[4] = {"36|08\n", "36|68\n", "36|C8\n", "36|A8\n"};

    (void)state;
    for (uint8_t rotation = 0; rotation < 4; rotation++) {
        recorder_t recorder;
        tuile_bus_t bus = recording_bus(&recorder);
        tuile_display_t display;
        assert_int_equal(
            tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341, .rotation = rotation}), 0);
        assert_non_null(strstr(recorder.log, expected[rotation]));
    }
}

static void test_window_and_write_bytes(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder);
    tuile_display_t display;
    uint8_t pixels[2 * 30 * 4] = {0xAB};

    (void)state;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341});
    forget(&recorder);
    /* 30 x 4 at (10, 260): columns 10 ... 39 = 0A ... 27, rows 260 ... 263 = 0104 ... 0107 */
    assert_int_equal(tuile_display_window(&display, 10, 260, 30, 4), 0);
    assert_int_equal(tuile_display_write(&display, pixels, sizeof pixels), 0);
    assert_int_equal(tuile_display_present(&display), 0);
    assert_string_equal(recorder.log, "2A|00 0A 00 27\n"
                                      "2B|01 04 01 07\n"
                                      "2C\n"
                                      "data 240: AB\n"
                                      "wait\n"
                                      "backlight 255\n");
    assert_false(display.refresh);
}

/* SSD1306 and its kin take parameters with D/C low. */
static void test_parameters_low(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder);
    tuile_panel_t panel = tuile_ili9341;
    tuile_display_t display;

    (void)state;
    panel.parameters_low = 1;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &panel});
    assert_non_null(strstr(recorder.log, "\nCF 00 C1 30\n"));
    forget(&recorder);
    tuile_display_window(&display, 0, 0, 1, 1);
    assert_string_equal(recorder.log, "2A 00 00 00 00\n2B 00 00 00 00\n2C\n");
}

static void test_chunks(void **state) {
    static const struct {
        uint8_t wire;
        uint32_t max_chunk_bytes, size_bytes;
        const char *expected;
    } cases[] = {
        {TUILE_WIRE_RGB565, 0, 1000, "data 1000: 00\n"},
        {TUILE_WIRE_RGB565, 1000, 1000, "data 1000: 00\n"},
        {TUILE_WIRE_RGB565, 999, 1000, "data 998: 00\nwait\ndata 2: 00\n"},
        {TUILE_WIRE_RGB565, 7, 14, "data 6: 00\nwait\ndata 6: 00\nwait\ndata 2: 00\n"},
        {TUILE_WIRE_RGB565, 6, 14, "data 6: 00\nwait\ndata 6: 00\nwait\ndata 2: 00\n"},
        {TUILE_WIRE_RGB666, 500, 1500, "data 498: 00\nwait\ndata 498: 00\nwait\ndata 498: 00\nwait\ndata 6: 00\n"},
        {TUILE_WIRE_RGB666, 11, 9, "data 9: 00\n"},
        {TUILE_WIRE_RGB666, 8, 9, "data 6: 00\nwait\ndata 3: 00\n"},
    };
    uint8_t pixels[1500] = {0};

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        recorder_t recorder;
        tuile_bus_t bus = recording_bus(&recorder);
        tuile_display_t display;
        bus.max_chunk_bytes = cases[i].max_chunk_bytes;
        tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341, .wire = cases[i].wire});
        assert_int_equal(tuile_display_window(&display, 0, 0, 240, 320), 0);
        forget(&recorder);
        assert_int_equal(tuile_display_write(&display, pixels, cases[i].size_bytes), 0);
        assert_string_equal(recorder.log, cases[i].expected);
    }
}

/* ---- geometry ---------------------------------------------------------------------------------------------- */

static void check_view(const tuile_panel_t *panel, unsigned rotation, unsigned x, unsigned y, unsigned width, unsigned height) {
    tuile_panel_view_t view = tuile_panel_view(panel, rotation);

    assert_int_equal(view.x, x);
    assert_int_equal(view.y, y);
    assert_int_equal(view.width, width);
    assert_int_equal(view.height, height);
}

static void test_geometry_by_hand(void **state) {
    tuile_panel_t panel = tuile_ili9341;

    (void)state;
    check_view(&panel, 0, 0, 0, 240, 320);
    check_view(&panel, 1, 0, 0, 320, 240);
    check_view(&panel, 2, 0, 0, 240, 320);
    check_view(&panel, 3, 0, 0, 320, 240);

    /* The 135 x 240 glass of an ST7789: drivers tabulate (52, 40), (40, 53), (53, 40), (40, 52). */
    panel.view_width = 135;
    panel.view_height = 240;
    panel.offset_x = 52;
    panel.offset_y = 40;
    check_view(&panel, 0, 52, 40, 135, 240);
    check_view(&panel, 1, 40, 53, 240, 135);
    check_view(&panel, 2, 53, 40, 135, 240);
    check_view(&panel, 3, 40, 52, 240, 135);

    /* The square one: (0, 0), (0, 0), (0, 80), (80, 0). */
    panel.view_width = 240;
    panel.offset_x = panel.offset_y = 0;
    check_view(&panel, 0, 0, 0, 240, 240);
    check_view(&panel, 1, 0, 0, 240, 240);
    check_view(&panel, 2, 0, 80, 240, 240);
    check_view(&panel, 3, 80, 0, 240, 240);

    /* An axis of alignment goes with its axis. */
    panel.align_x = 4;
    panel.align_y = 8;
    assert_int_equal(tuile_panel_view(&panel, 0).align_x, 4);
    assert_int_equal(tuile_panel_view(&panel, 1).align_x, 8);
    assert_int_equal(tuile_panel_view(&panel, 1).align_y, 4);
}

static void test_window_with_offset_and_alignment(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder);
    tuile_panel_t panel = tuile_ili9341;
    tuile_display_t display;

    (void)state;
    panel.view_width = 135;
    panel.view_height = 240;
    panel.offset_x = 52;
    panel.offset_y = 40;
    panel.align_y = 8;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &panel, .rotation = 1});
    forget(&recorder);
    /* columns 40 + 8 ... + 15, rows 53 + 100 ... 53 + 134 */
    assert_int_equal(tuile_display_window(&display, 8, 100, 8, 35), 0);
    assert_string_equal(recorder.log, "2A|00 30 00 37\n2B|00 99 00 BB\n2C\n");
    assert_int_equal(tuile_display_window(&display, 4, 100, 8, 35), TUILE_HAL_ARGUMENT);
    assert_int_equal(tuile_display_window(&display, 8, 100, 4, 35), TUILE_HAL_ARGUMENT);
}

/* ---- the simulated board ----------------------------------------------------------------------------------- */

typedef struct board {
    sim_chip_t *chip;
    sim_bus_t bus;
    tuile_display_t display;
} board_t;

static void open_board(board_t *board, const sim_bus_config_t *config) {
    sim_error_t error = {""};

    board->chip = sim_ili9341_create(&error);
    assert_non_null(board->chip);
    sim_bus_open(&board->bus, config, board->chip);
}

static void close_board(board_t *board) { board->chip->destroy(board->chip); }

static void check_clean(const board_t *board) {
    assert_string_equal(board->chip->fault.text, "");
    assert_string_equal(board->bus.error.text, "");
}

static int start_display(board_t *board, uint8_t rotation, uint8_t wire) {
    return tuile_display_init(
        &board->display,
        &(tuile_display_config_t){.bus = &board->bus.bus, .panel = &tuile_ili9341, .rotation = rotation, .wire = wire});
}

/* A test picture: 18 bits of colour that are unlike for each of the 76 800 pixels, as the factor is odd. */
static uint32_t colour(uint32_t width, uint32_t x, uint32_t y) { return (y * width + x) * 40503u & 0x3FFFF; }

static void put_pixel(uint8_t *to, uint8_t wire, uint32_t c) {
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
static void check_pixel(const uint8_t *rgb, uint8_t wire, uint32_t c) {
    unsigned part[3] = {c >> 12, c >> 6 & 63, c & 63};

    for (unsigned i = 0; i < 3; i++) {
        unsigned six = wire == TUILE_WIRE_RGB565 && i != 1 ? (part[i] & 62) | part[i] >> 5 : part[i];
        if (rgb[i] != (six << 2 | six >> 4)) { fail_msg("colour %05X: part %u is %u", c, i, rgb[i]); }
    }
}

static int draw(tuile_display_t *display, uint8_t wire, uint32_t tile_width, uint32_t tile_height) {
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
                    put_pixel(to + pixel_bytes * (row * width + column), wire, colour(display->width, x + column, y + row));
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

static void check_picture(const board_t *board, uint8_t rotation, uint8_t wire) {
    sim_picture_t seen;
    uint32_t width = rotation & 1 ? 320 : 240, height = rotation & 1 ? 240 : 320;

    assert_int_equal(sim_bus_picture(&board->bus, rotation, &seen, NULL), 0);
    assert_int_equal(seen.width, width);
    assert_int_equal(seen.height, height);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            check_pixel(sim_picture_at(&seen, x, y), wire, colour(width, x, y));
        }
    }
    sim_picture_free(&seen);
}

/* Where pixel (x, y) of the picture is on the glass as it lies at rotation 0: turned clockwise, by hand. */
static void on_glass(uint8_t rotation, uint32_t x, uint32_t y, uint32_t *glass_x, uint32_t *glass_y) {
    *glass_x = rotation == 0 ? x : rotation == 1 ? 239 - y : rotation == 2 ? 239 - x : y;
    *glass_y = rotation == 0 ? y : rotation == 1 ? x : rotation == 2 ? 319 - y : 319 - x;
}

static void check_turned(const board_t *board, uint8_t rotation, uint8_t wire) {
    sim_picture_t glass;
    uint32_t width = rotation & 1 ? 320 : 240, height = rotation & 1 ? 240 : 320;

    assert_int_equal(board->chip->glass(board->chip, &glass, NULL), 0);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            uint32_t glass_x, glass_y;
            on_glass(rotation, x, y, &glass_x, &glass_y);
            check_pixel(sim_picture_at(&glass, glass_x, glass_y), wire, colour(width, x, y));
        }
    }
    sim_picture_free(&glass);
}

static void test_rotations_through_window_splits(void **state) {
    static const uint32_t splits[][2] = {{320, 320}, {320, 16}, {64, 48}, {37, 41}, {1, 320}};

    (void)state;
    for (uint8_t rotation = 0; rotation < 4; rotation++) {
        for (uint8_t wire = TUILE_WIRE_RGB565; wire <= TUILE_WIRE_RGB666; wire++) {
            for (size_t i = 0; i < sizeof splits / sizeof splits[0]; i++) {
                board_t board;
                open_board(&board, &(sim_bus_config_t){.max_chunk_bytes = i == 2 ? 4095 : 0});
                assert_int_equal(start_display(&board, rotation, wire), 0);
                assert_int_equal(draw(&board.display, wire, splits[i][0], splits[i][1]), 0);
                check_clean(&board);
                check_picture(&board, rotation, wire);
                check_turned(&board, rotation, wire);
                close_board(&board);
            }
        }
    }
}

/* With C2h in B6h the memory is as the picture is; red is in the upper bits whatever the filter's order. */
static void test_memory_by_hand(void **state) {
    /* The first two pixels of a row, red then green. Rotation 1: MV and MX, so the row runs down the last column. */
    static const uint8_t pixels[4] = {0xF8, 0x00, 0x07, 0xE0};
    static const uint32_t where[4][2][2] = {{{0, 0}, {1, 0}}, {{239, 0}, {239, 1}}, {{239, 319}, {238, 319}}, {{0, 319}, {0, 318}}};

    (void)state;
    for (uint8_t rotation = 0; rotation < 4; rotation++) {
        board_t board;
        open_board(&board, NULL);
        assert_int_equal(start_display(&board, rotation, TUILE_WIRE_RGB565), 0);
        assert_int_equal(tuile_display_window(&board.display, 0, 0, 2, 1), 0);
        assert_int_equal(tuile_display_write(&board.display, pixels, 4), 0);
        assert_int_equal(tuile_display_present(&board.display), 0);
        assert_int_equal(sim_dcs_memory(board.chip, where[rotation][0][0], where[rotation][0][1]), 0x3F000);
        assert_int_equal(sim_dcs_memory(board.chip, where[rotation][1][0], where[rotation][1][1]), 0x00FC0);
        close_board(&board);
    }
}

static void test_colours_seen(void **state) {
    static const uint8_t pixels[8] = {0xF8, 0x00, 0x07, 0xE0, 0x00, 0x1F, 0x84, 0x10};
    static const uint8_t expected[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {0x86, 0x82, 0x86}};
    static const uint8_t inversion[] = {0x21};
    board_t board;
    sim_picture_t seen;

    (void)state;
    open_board(&board, NULL);
    start_display(&board, 0, TUILE_WIRE_RGB565);
    tuile_display_window(&board.display, 0, 0, 4, 1);
    tuile_display_write(&board.display, pixels, 8);
    assert_int_equal(tuile_display_wait(&board.display), 0);
    sim_bus_picture(&board.bus, 0, &seen, NULL);
    assert_int_equal(sim_picture_at(&seen, 0, 0)[0], 0); /* dark until the first present */
    sim_picture_free(&seen);

    assert_int_equal(tuile_display_present(&board.display), 0);
    sim_bus_picture(&board.bus, 0, &seen, NULL);
    for (unsigned i = 0; i < 4; i++) {
        assert_memory_equal(sim_picture_at(&seen, i, 0), expected[i], 3);
    }
    sim_picture_free(&seen);

    board.bus.bus.command(&board.bus, inversion, 1, 1);
    sim_bus_picture(&board.bus, 0, &seen, NULL);
    assert_int_equal(sim_picture_at(&seen, 0, 0)[0], 0);
    assert_int_equal(sim_picture_at(&seen, 0, 0)[1], 255);
    assert_int_equal(sim_picture_at(&seen, 0, 0)[2], 255);
    sim_picture_free(&seen);
    check_clean(&board);
    close_board(&board);
}

/* ---- pixels past the end of the window, and continued ones ------------------------------------------------- */

static void test_write_wraps_in_window_and_continues(void **state) {
    static const uint8_t column[] = {0x2A, 0, 10, 0, 11}, row[] = {0x2B, 0, 20, 0, 21}, write[] = {0x2C}, more[] = {0x3C};
    static const uint8_t five[] = {0, 1, 0, 2, 0, 3, 0, 4, 0, 5}, one[] = {0, 6};
    board_t board;
    tuile_bus_t *bus;

    (void)state;
    open_board(&board, &(sim_bus_config_t){.blocking = true});
    start_display(&board, 0, TUILE_WIRE_RGB565);
    bus = &board.bus.bus;
    bus->command(bus->context, column, 1, 5);
    bus->command(bus->context, row, 1, 5);
    bus->command(bus->context, write, 1, 1);
    bus->data(bus->context, five, sizeof five);
    bus->command(bus->context, more, 1, 1);
    assert_int_equal(bus->data(bus->context, one, sizeof one), 0);
    /* the fifth pixel fell on the first, the sixth on the second; blue 5 bits b are 2b in 6 bits */
    assert_int_equal(sim_dcs_memory(board.chip, 10, 20), 10);
    assert_int_equal(sim_dcs_memory(board.chip, 11, 20), 12);
    assert_int_equal(sim_dcs_memory(board.chip, 10, 21), 6);
    assert_int_equal(sim_dcs_memory(board.chip, 11, 21), 8);
    check_clean(&board);
    close_board(&board);
}

/* With WEMODE = 0 (F6h) what exceeds the window is dropped. */
static void test_write_stops_at_the_window(void **state) {
    static const uint8_t interface[] = {0xF6, 0, 0, 0}, column[] = {0x2A, 0, 10, 0, 10}, row[] = {0x2B, 0, 20, 0, 20},
                         write[] = {0x2C};
    static const uint8_t two[] = {0, 1, 0, 2};
    board_t board;
    tuile_bus_t *bus;

    (void)state;
    open_board(&board, &(sim_bus_config_t){.blocking = true});
    start_display(&board, 0, TUILE_WIRE_RGB565);
    bus = &board.bus.bus;
    bus->command(bus->context, interface, 1, 4);
    bus->command(bus->context, column, 1, 5);
    bus->command(bus->context, row, 1, 5);
    bus->command(bus->context, write, 1, 1);
    assert_int_equal(bus->data(bus->context, two, sizeof two), 0);
    assert_int_equal(sim_dcs_memory(board.chip, 10, 20), 2);
    bus->command(bus->context, write, 1, 1);
    assert_int_equal(bus->data(bus->context, two + 2, 2), 0);
    assert_int_equal(sim_dcs_memory(board.chip, 10, 20), 4);
    check_clean(&board);
    close_board(&board);
}

/* ---- arguments and states ---------------------------------------------------------------------------------- */

static void test_arguments_send_nothing(void **state) {
    static const uint32_t windows[][4] = {{0, 0, 0, 1},   {0, 0, 1, 0},          {240, 0, 1, 1},
                                          {0, 320, 1, 1}, {1, 0, 240, 1},        {0, 1, 1, 320},
                                          {0, 0, 241, 1}, {0, 0, UINT32_MAX, 1}, {UINT32_MAX, 0, 2, 1}};
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder), broken;
    tuile_display_t display;
    tuile_display_config_t config = {.bus = &bus, .panel = &tuile_ili9341};
    uint8_t pixels[16] = {0};

    (void)state;
    tuile_display_init(&display, &config);
    forget(&recorder);
    assert_int_equal(tuile_display_write(&display, pixels, 2), TUILE_HAL_STATE);
    for (size_t i = 0; i < sizeof windows / sizeof windows[0]; i++) {
        assert_int_equal(tuile_display_window(&display, windows[i][0], windows[i][1], windows[i][2], windows[i][3]),
                         TUILE_HAL_ARGUMENT);
    }
    assert_string_equal(recorder.log, "");
    assert_int_equal(tuile_display_window(&display, 0, 0, 3, 2), 0);
    forget(&recorder);
    assert_int_equal(tuile_display_write(&display, pixels, 3), TUILE_HAL_ARGUMENT);  /* half a pixel */
    assert_int_equal(tuile_display_write(&display, pixels, 14), TUILE_HAL_ARGUMENT); /* a pixel too much */
    assert_int_equal(tuile_display_write(&display, NULL, 2), TUILE_HAL_ARGUMENT);
    assert_string_equal(recorder.log, "");
    assert_int_equal(tuile_display_write(&display, pixels, 10), 0);
    assert_int_equal(tuile_display_present(&display), TUILE_HAL_STATE); /* one pixel is missing */
    assert_int_equal(tuile_display_write(&display, pixels, 2), 0);
    assert_int_equal(tuile_display_write(&display, pixels, 2), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_present(&display), 0);
    assert_int_equal(display.error, 0);

    config.rotation = 4;
    assert_int_equal(tuile_display_init(&display, &config), TUILE_HAL_ARGUMENT);
    assert_int_equal(tuile_display_window(&display, 0, 0, 1, 1), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_resume(&display), TUILE_HAL_STATE);
    config.rotation = 0;
    config.wire = 9;
    assert_int_equal(tuile_display_init(&display, &config), TUILE_HAL_UNSUPPORTED);
    config.wire = 0;
    config.tearing_timeout_ms = 20;
    assert_int_equal(tuile_display_init(&display, &config), TUILE_HAL_UNSUPPORTED);
    config.tearing_timeout_ms = 0;
    broken = bus;
    broken.max_chunk_bytes = 5;
    config.bus = &broken;
    assert_int_equal(tuile_display_init(&display, &config), TUILE_HAL_ARGUMENT);
    broken = bus;
    broken.delay_ms = NULL;
    assert_int_equal(tuile_display_init(&display, &config), TUILE_HAL_ARGUMENT);
}

static void test_brightness_and_sleep(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder);
    tuile_panel_t panel = tuile_ili9341;
    tuile_display_t display;

    (void)state;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341, .brightness = 100});
    forget(&recorder);
    assert_int_equal(tuile_display_brightness(&display, 7), 0); /* not lit yet */
    assert_string_equal(recorder.log, "");
    assert_int_equal(tuile_display_present(&display), 0);
    assert_int_equal(tuile_display_brightness(&display, 200), 0);
    assert_int_equal(tuile_display_sleep(&display), 0);
    assert_string_equal(recorder.log, "backlight 7\nbacklight 200\nbacklight 0\n28\n10\ndelay 120\n");
    assert_int_equal(tuile_display_window(&display, 0, 0, 1, 1), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_wait(&display), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_resume(&display), 0);
    assert_true(display.refresh);
    forget(&recorder);
    assert_int_equal(tuile_display_present(&display), 0);
    assert_string_equal(recorder.log, "backlight 200\n");

    bus.pins = 0;
    assert_int_equal(tuile_display_brightness(&display, 1), TUILE_HAL_UNSUPPORTED);
    panel.brightness_command = 0x51;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &panel});
    forget(&recorder);
    assert_int_equal(tuile_display_present(&display), 0);
    assert_string_equal(recorder.log, "51|FF\n");
}

static void test_sleep_is_legal_traffic(void **state) {
    (void)state;
    for (unsigned pins = 0; pins < 2; pins++) {
        board_t board;
        open_board(&board, &(sim_bus_config_t){.no_reset_pin = pins == 0});
        assert_int_equal(start_display(&board, 0, TUILE_WIRE_RGB565), 0);
        assert_int_equal(draw(&board.display, TUILE_WIRE_RGB565, 240, 32), 0);
        assert_int_equal(tuile_display_sleep(&board.display), 0);
        assert_int_equal(tuile_display_resume(&board.display), 0);
        assert_int_equal(draw(&board.display, TUILE_WIRE_RGB565, 240, 32), 0);
        check_clean(&board);
        check_picture(&board, 0, TUILE_WIRE_RGB565);
        close_board(&board);
    }
}

static void test_tearing(void **state) {
    static const uint8_t pixels[2] = {0};
    board_t board;
    tuile_display_config_t config = {.panel = &tuile_ili9341, .tearing_timeout_ms = 20};
    uint64_t before_ns;

    (void)state;
    open_board(&board, &(sim_bus_config_t){.refresh_hz = 100});
    config.bus = &board.bus.bus;
    assert_int_equal(tuile_display_init(&board.display, &config), 0);
    assert_true(board.chip->tearing);
    for (unsigned frame = 0; frame < 3; frame++) {
        before_ns = board.bus.now_ns;
        assert_int_equal(tuile_display_window(&board.display, 0, 0, 1, 1), 0);
        /* a multiple of 10 ms, then 11 bytes at 10 MHz */
        assert_int_equal(board.bus.now_ns % 10000000, 8800);
        assert_true(board.bus.now_ns - before_ns < 10010000);
        tuile_display_write(&board.display, pixels, 2);
        before_ns = board.bus.now_ns;
        assert_int_equal(tuile_display_window(&board.display, 0, 0, 1, 1), 0);
        assert_true(board.bus.now_ns - before_ns < 100000);
        tuile_display_write(&board.display, pixels, 2);
        assert_int_equal(tuile_display_present(&board.display), 0);
    }
    close_board(&board);

    open_board(&board, &(sim_bus_config_t){.refresh_hz = 1});
    config.bus = &board.bus.bus;
    config.tearing_timeout_ms = 1;
    assert_int_equal(tuile_display_init(&board.display, &config), 0);
    assert_int_equal(tuile_display_window(&board.display, 0, 0, 1, 1), TUILE_HAL_TIMEOUT);
    assert_int_equal(board.display.error, TUILE_HAL_TIMEOUT);
    close_board(&board);
}

static void test_reading(void **state) {
    board_t board;
    uint8_t id[3], byte;
    tuile_bus_t *bus;

    (void)state;
    open_board(&board, NULL);
    start_display(&board, 3, TUILE_WIRE_RGB565);
    bus = &board.bus.bus;
    assert_int_equal(bus->read(bus->context, 0xD3, id, 3), 0);
    assert_memory_equal(id, "\x00\x93\x41", 3);
    assert_int_equal(bus->read(bus->context, 0x0B, &byte, 1), 0);
    assert_int_equal(byte, 0xA8);
    assert_int_equal(bus->read(bus->context, 0x0C, &byte, 1), 0);
    assert_int_equal(byte, 0x55);
    assert_int_equal(bus->read(bus->context, 0x0A, &byte, 1), 0);
    assert_int_equal(byte, 0x9C); /* booster, sleep out, normal mode, display on */
    assert_int_equal(bus->read(bus->context, 0x2E, &byte, 1), TUILE_HAL_PROTOCOL);
    close_board(&board);
}

static void test_template_port_opens(void **state) {
    tuile_bus_t bus;
    template_port_t port;
    tuile_display_t display;

    (void)state;
    assert_int_equal(template_bus_open(&bus, &port), 0);
    assert_int_equal(tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341}),
                     TUILE_HAL_UNSUPPORTED);
}

/* ---- errors ------------------------------------------------------------------------------------------------ */

static void test_first_error_sticks(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder);
    tuile_display_t display;
    uint8_t pixels[4] = {0};
    unsigned calls;

    (void)state;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341});
    tuile_display_window(&display, 0, 0, 1, 2);
    assert_int_equal(tuile_display_write(&display, pixels, 2), 0);
    recorder.fail_with = TUILE_HAL_TIMEOUT;
    assert_int_equal(tuile_display_write(&display, pixels, 2), TUILE_HAL_TIMEOUT); /* of the one before */
    recorder.fail_with = TUILE_HAL_IO;
    calls = recorder.calls;
    assert_int_equal(tuile_display_write(&display, pixels, 2), TUILE_HAL_TIMEOUT);
    assert_int_equal(tuile_display_window(&display, 0, 0, 1, 1), TUILE_HAL_TIMEOUT);
    assert_int_equal(tuile_display_wait(&display), TUILE_HAL_TIMEOUT);
    assert_int_equal(tuile_display_present(&display), TUILE_HAL_TIMEOUT);
    assert_int_equal(tuile_display_brightness(&display, 3), TUILE_HAL_TIMEOUT);
    assert_int_equal(tuile_display_sleep(&display), TUILE_HAL_TIMEOUT);
    assert_int_equal(recorder.calls, calls);
    assert_int_equal(tuile_display_resume(&display), TUILE_HAL_IO); /* once, not again and again */
    assert_int_equal(recorder.calls, calls + 1);
    recorder.fail_with = 0;
    assert_int_equal(tuile_display_wait(&display), TUILE_HAL_IO);
    assert_int_equal(tuile_display_resume(&display), 0);
    assert_true(display.refresh);
    assert_int_equal(tuile_display_write(&display, pixels, 2), TUILE_HAL_STATE); /* the window is forgotten */
}

static void test_codes_of_a_port_do_not_pass(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder);
    tuile_display_t display;

    (void)state;
    recorder.fail_with = -5;
    assert_int_equal(tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341}), TUILE_HAL_IO);
    recorder.fail_with = -1000;
    assert_int_equal(tuile_display_resume(&display), TUILE_HAL_IO);
}

static void test_gone_is_final(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recording_bus(&recorder);
    tuile_display_t display;
    tuile_display_config_t config = {.bus = &bus, .panel = &tuile_ili9341};
    unsigned calls;

    (void)state;
    tuile_display_init(&display, &config);
    recorder.fail_with = TUILE_HAL_GONE;
    assert_int_equal(tuile_display_window(&display, 0, 0, 1, 1), TUILE_HAL_GONE);
    recorder.fail_with = 0;
    calls = recorder.calls;
    assert_int_equal(tuile_display_resume(&display), TUILE_HAL_GONE);
    assert_int_equal(tuile_display_wait(&display), TUILE_HAL_GONE);
    assert_int_equal(recorder.calls, calls);
    assert_int_equal(tuile_display_init(&display, &config), 0);

    /* also when it shows only at the wait for a buffer in flight */
    assert_int_equal(tuile_display_window(&display, 0, 0, 1, 1), 0);
    assert_int_equal(tuile_display_write(&display, (const uint8_t[2]){0}, 2), 0);
    forget(&recorder);
    recorder.fail_with = TUILE_HAL_GONE;
    assert_int_equal(tuile_display_resume(&display), TUILE_HAL_GONE);
    recorder.fail_with = 0;
    assert_int_equal(tuile_display_resume(&display), TUILE_HAL_GONE);
    assert_string_equal(recorder.log, "wait\n");
}

/* Pauses and pins can fail too, which the simulated board's do not. */
static void test_fault_at_every_call(void **state) {
    static const uint8_t pixel[2] = {0};
    unsigned count = 0;

    (void)state;
    for (unsigned call = 0; call == 0 || call <= count; call++) {
        recorder_t recorder;
        tuile_bus_t bus = recording_bus(&recorder);
        tuile_display_t display;
        int result;
        recorder.fail_at = call;
        bus.pins = call % 2 ? bus.pins : TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT);
        if ((result = tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341})) == 0 &&
            (result = tuile_display_window(&display, 0, 0, 1, 1)) == 0 && (result = tuile_display_write(&display, pixel, 2)) == 0 &&
            (result = tuile_display_present(&display)) == 0 && (result = tuile_display_brightness(&display, 9)) == 0) {
            result = tuile_display_sleep(&display);
        }
        if (call == 0) {
            assert_int_equal(result, 0);
            count = recorder.calls;
            assert_true(count > 30);
        } else {
            assert_int_equal(result, TUILE_HAL_IO);
            assert_int_equal(recorder.calls, call);
            assert_int_equal(tuile_display_resume(&display), 0);
        }
    }
}

static void test_damaged_sequence(void **state) {
    static const uint8_t sequences[][4] = {{4, 0xEF, 3, 128}, {1, 0x29, 0, 1}, {1, 0x29, 2, 1}, {65, 0, 0, 0}};

    (void)state;
    for (size_t i = 0; i < sizeof sequences / sizeof sequences[0]; i++) {
        recorder_t recorder;
        tuile_bus_t bus = recording_bus(&recorder);
        tuile_panel_t panel = tuile_ili9341;
        tuile_display_t display;
        panel.on = (tuile_sequence_t){sequences[i], 4};
        assert_int_equal(tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &panel}), TUILE_HAL_PROTOCOL);
    }
}

/* Makes a display and a frame; the one fault must come up by the end of the frame, and stick. */
static void check_fault_at(uint64_t transfer, uint8_t parts, bool no_reset_pin, bool blocking) {
    board_t board;
    int result;
    uint64_t transfers;

    open_board(&board, &(sim_bus_config_t){.fail_transfer = transfer,
                                           .fail_parts = parts,
                                           .no_reset_pin = no_reset_pin,
                                           .blocking = blocking,
                                           .max_chunk_bytes = 20000});
    result = start_display(&board, 1, TUILE_WIRE_RGB565);
    if (result == 0) { result = draw(&board.display, TUILE_WIRE_RGB565, 320, 40); }
    assert_int_equal(result, TUILE_HAL_IO);
    assert_int_equal(board.display.error, TUILE_HAL_IO);
    transfers = board.bus.transfers;
    assert_true(transfers == transfer);
    assert_int_equal(draw(&board.display, TUILE_WIRE_RGB565, 320, 40), TUILE_HAL_IO);
    assert_true(board.bus.transfers == transfers);
    assert_int_equal(tuile_display_resume(&board.display), 0);
    assert_true(board.display.refresh);
    assert_int_equal(draw(&board.display, TUILE_WIRE_RGB565, 320, 40), 0);
    assert_false(board.display.refresh);
    check_clean(&board);
    check_picture(&board, 1, TUILE_WIRE_RGB565);
    close_board(&board);
}

static uint64_t count_transfers(bool no_reset_pin) {
    board_t board;
    uint64_t transfers;

    open_board(&board, &(sim_bus_config_t){.no_reset_pin = no_reset_pin, .max_chunk_bytes = 20000});
    assert_int_equal(start_display(&board, 1, TUILE_WIRE_RGB565), 0);
    assert_int_equal(draw(&board.display, TUILE_WIRE_RGB565, 320, 40), 0);
    transfers = board.bus.transfers;
    close_board(&board);
    return transfers;
}

static void test_fault_at_every_transfer(void **state) {
    (void)state;
    for (unsigned variant = 0; variant < 12; variant++) {
        bool no_reset_pin = variant % 2, blocking = variant / 2 % 2;
        uint64_t count = count_transfers(no_reset_pin);
        /* 18 + 3 commands of the start, one more without the pin; 6 tiles of 3 commands and 2 chunks */
        assert_true(count == 21u + no_reset_pin + 30u);
        for (uint64_t transfer = 1; transfer <= count; transfer++) {
            check_fault_at(transfer, (uint8_t)(variant / 4), no_reset_pin, blocking);
        }
    }
}

static void test_gone_at_every_transfer(void **state) {
    (void)state;
    for (uint64_t transfer = 1; transfer <= 51; transfer++) {
        board_t board;
        int result;
        open_board(&board, &(sim_bus_config_t){.fail_transfer = transfer, .fail_code = TUILE_HAL_GONE, .max_chunk_bytes = 20000});
        result = start_display(&board, 1, TUILE_WIRE_RGB565);
        if (result == 0) { result = draw(&board.display, TUILE_WIRE_RGB565, 320, 40); }
        assert_int_equal(result, TUILE_HAL_GONE);
        assert_int_equal(tuile_display_resume(&board.display), TUILE_HAL_GONE);
        assert_true(board.bus.transfers == transfer);
        close_board(&board);
    }
}

/* ---- ownership --------------------------------------------------------------------------------------------- */

static bool row_is(const board_t *board, uint32_t row, uint8_t value) {
    for (uint32_t x = 0; x < 240; x++) {
        if (sim_dcs_memory(board->chip, x, row) != (value ? 0x3FFFF : 0u)) { return false; }
    }
    return true;
}

static void test_buffer_in_flight_is_not_ours(void **state) {
    board_t board;
    uint8_t a[480], b[480];

    (void)state;
    open_board(&board, NULL);
    start_display(&board, 0, TUILE_WIRE_RGB565);
    tuile_display_window(&board.display, 0, 0, 240, 3);
    memset(a, 0xFF, sizeof a);
    memset(b, 0xFF, sizeof b);
    assert_int_equal(tuile_display_write(&board.display, a, sizeof a), 0);
    memset(a, 0, sizeof a); /* too early: the simulator shows it */
    assert_int_equal(tuile_display_write(&board.display, b, sizeof b), 0);
    assert_true(row_is(&board, 0, 0));
    memset(a, 0xFF, sizeof a); /* now it is ours again */
    assert_int_equal(tuile_display_write(&board.display, a, sizeof a), 0);
    memset(b, 0, sizeof b); /* b is out */
    assert_int_equal(tuile_display_wait(&board.display), 0);
    memset(a, 0, sizeof a); /* and a */
    assert_true(row_is(&board, 1, 0xFF));
    assert_true(row_is(&board, 2, 0xFF));
    close_board(&board);
}

/* ---- time -------------------------------------------------------------------------------------------------- */

static void test_time_on_the_wire(void **state) {
    static uint8_t frame[153600];
    board_t board;
    uint64_t before_ns;
    tuile_display_config_t config = {.panel = &tuile_ili9341, .pixel_clock_hz = 62500000};

    (void)state;
    open_board(&board, &(sim_bus_config_t){.command_gap_ns = 1000, .chunk_gap_ns = 2000, .max_chunk_bytes = 4096});
    config.bus = &board.bus.bus;
    assert_int_equal(tuile_display_init(&board.display, &config), 0);
    memset(&board.bus.counts, 0, sizeof board.bus.counts);
    before_ns = board.bus.now_ns;
    tuile_display_window(&board.display, 0, 0, 240, 320);
    tuile_display_write(&board.display, frame, sizeof frame);
    assert_int_equal(tuile_display_present(&board.display), 0);
    assert_int_equal(board.bus.counts.commands, 3);
    assert_int_equal(board.bus.counts.command_bytes, 11);
    assert_int_equal(board.bus.counts.chunks, 38); /* 37 of 4096 and one of 2048 */
    assert_int_equal(board.bus.counts.data_bytes, 153600);
    /* 153600 * 8 bits * 16 ns; 11 * 8 bits * 100 ns */
    assert_int_equal(board.bus.counts.wire_ns, 19660800 + 8800);
    assert_int_equal(board.bus.counts.gap_ns, 3 * 1000 + 38 * 2000);
    assert_int_equal(board.bus.now_ns - before_ns, 19660800 + 8800 + 79000);
    assert_true(board.chip->warnings > 0); /* beyond the rated 10 MHz */
    assert_non_null(strstr(board.chip->warning.text, "62500000 Hz"));
    close_board(&board);
}

static void test_real_clock_differs_from_the_one_asked_for(void **state) {
    static uint8_t row[480];
    board_t board;

    (void)state;
    open_board(&board, &(sim_bus_config_t){.clock_hz = 15625000, .command_clock_hz = 9000000});
    start_display(&board, 0, TUILE_WIRE_RGB565);
    memset(&board.bus.counts, 0, sizeof board.bus.counts);
    tuile_display_window(&board.display, 0, 0, 240, 1);
    tuile_display_write(&board.display, row, sizeof row);
    tuile_display_wait(&board.display);
    /* 480 * 8 * 64 ns; 5, 5 and 1 bytes at 9 MHz: 4444.4, 4444.4 and 888.8 ns, each rounded up */
    assert_int_equal(board.bus.counts.wire_ns, 245760 + 4445 + 4445 + 889);
    close_board(&board);
}

static void test_work_overlaps_the_wire(void **state) {
    static uint8_t strip[2][240 * 32 * 2]; /* 15 360 bytes: 12 288 000 ns at 10 MHz */
    board_t board;
    uint64_t before_ns;
    tuile_display_config_t config = {.panel = &tuile_ili9341, .pixel_clock_hz = 10000000};

    (void)state;
    for (unsigned blocking = 0; blocking < 2; blocking++) {
        open_board(&board, &(sim_bus_config_t){.blocking = blocking});
        config.bus = &board.bus.bus;
        assert_int_equal(tuile_display_init(&board.display, &config), 0);
        assert_int_equal(board.chip->warnings, 0);
        memset(&board.bus.counts, 0, sizeof board.bus.counts);
        before_ns = board.bus.now_ns;
        for (uint32_t i = 0; i < 10; i++) {
            sim_bus_work(&board.bus, 5000000);
            tuile_display_window(&board.display, 0, 32 * i, 240, 32);
            tuile_display_write(&board.display, strip[i & 1], sizeof strip[0]);
        }
        assert_int_equal(tuile_display_present(&board.display), 0);
        /* With overlap only the first 5 ms of work are seen. */
        assert_int_equal(board.bus.now_ns - before_ns, 10 * (12288000 + 8800) + (blocking ? 10 : 1) * 5000000);
        assert_int_equal(board.bus.counts.work_ns, 50000000);
        assert_int_equal(board.bus.counts.idle_ns, blocking ? 122880000 : 122880000 - 45000000);
        close_board(&board);
    }
}

/* ---- illegal traffic --------------------------------------------------------------------------------------- */

/* A script for the wire: "2A:00 00" is a command with parameters, "+12 34" data, "@5" a pause of 5 ms, "R0" and "R1" the reset
 * line. A semicolon before all but the first of them. */
static int play(board_t *board, const char *script) {
    tuile_bus_t *bus = &board->bus.bus;
    int result = 0;

    while (*script && result == 0) {
        uint8_t bytes[64];
        size_t count = 0;
        char kind = *script;
        char *end;
        if (kind == '@' || kind == 'R') {
            unsigned value = (unsigned)strtoul(script + 1, &end, 10);
            script = end;
            result = kind == '@' ? bus->delay_ms(bus->context, value) : bus->pin(bus->context, TUILE_PIN_RESET, (uint8_t)value);
        } else {
            script += kind == '+';
            do {
                bytes[count++] = (uint8_t)strtoul(script, &end, 16);
                script = end;
            } while ((*script == ':' ||
                      (*script == ' ' && script[1] && strchr("0123456789ABCDEF", script[1]) && (kind == '+' || count > 1))) &&
                     *script++);
            result = kind == '+' ? bus->data(bus->context, bytes, count) : bus->command(bus->context, bytes, 1, count);
        }
        while (*script == ' ' || *script == ';') {
            script++;
        }
    }
    return result;
}

typedef struct illegal {
    const char *name;
    const char *script;
    const char *fault; /* part of the one line; NULL: legal after all */
    bool raw;          /* the chip has just been powered */
} illegal_t;

static const illegal_t illegal_cases[] = {
    {"unknown command", "FF", "unknown command FFh", false},
    {"NV memory is not to be burnt", "D1:55 AA 66", "unknown command D1h", false},
    {"too few parameters", "2A:00 00 00 ;29", "2Ah takes 4 parameters and got 3", false},
    {"no parameter at all", "36 ;29", "36h takes 1 parameters and got 0", false},
    {"too many parameters", "2A:00 00 00 EF 00", "2Ah takes 4 parameters and got more", false},
    {"too many parameters of a vendor command", "C0:23 00", "C0h takes 1 parameters and got more", false},
    {"too few parameters of a vendor command", "E0:0F 31 2B ;29", "E0h takes 15 parameters and got 3", false},
    {"data before memory write", "2A:00 00 00 EF ;+00 00", "2Ah takes 4 parameters and got more", false},
    {"data after display on", "29 ;+00 00", "belong to no command", false},
    {"data after memory write was ended", "2C ;+00 00 ;00 ;+00 00", "belong to no command", false},
    {"columns beyond the memory", "2A:00 00 00 F0", "columns from 0 to 240", false},
    {"rows beyond the memory", "2B:00 00 01 40", "rows from 0 to 320", false},
    {"columns backwards", "2A:00 05 00 04", "columns from 5 to 4", false},
    {"rows backwards", "2B:00 05 00 04", "rows from 5 to 4", false},
    {"exchanged: columns to 319 are legal", "36:28 ;2A:00 00 01 3F ;2B:00 00 00 EF ;2C", NULL, false},
    {"exchanged: columns to 320 are not", "36:28 ;2A:00 00 01 40", "columns from 0 to 320", false},
    {"exchanged: rows to 240 are not", "36:28 ;2B:00 00 00 F0", "rows from 0 to 240", false},
    {"window from before the exchange", "2A:00 00 00 EF ;2B:00 00 01 3F ;36:28 ;2C", "rows from 0 to 319", false},
    {"pixel cut by a command", "2C ;+12 34 56 ;29", "cuts a pixel after 1 of its 2 bytes", false},
    {"18-bit pixel cut by a command", "3A:66 ;2C ;+12 34 56 78 9A ;00", "cuts a pixel after 2 of its 3 bytes", false},
    {"pixel over two chunks is legal", "2C ;+12 ;+34 ;29", NULL, false},
    {"continue without a write", "2A:00 00 00 EF ;3C", "without a memory write", false},
    {"continue in other columns", "2C ;+00 00 ;2A:00 00 00 EF ;3C", "without a memory write", false},
    {"continue in other rows", "2C ;+00 00 ;2B:00 00 00 EF ;3C", "without a memory write", false},
    {"continue in another direction", "2C ;+00 00 ;36:88 ;3C", "without a memory write", false},
    {"reserved pixel format", "3A:53", "pixel format 53h is reserved", false},
    {"scrolling", "37:00 01", "not modelled", false},
    {"no scrolling is legal", "33:00 00 01 40 00 00 ;37:00 00", NULL, false},
    {"a scrolling area", "33:00 02 01 3E 00 00", "not modelled", false},
    {"partial mode", "12", "not modelled", false},
    {"other byte order", "F6:01 00 20", "not modelled", false},
    {"memory write while asleep", "28 ;10 ;@120 ;2C", "asleep", false},
    {"command 4 ms after sleep in", "10 ;@4 ;28", "28h", false},
    {"sleep out 119 ms after sleep in", "10 ;@119 ;11", "sleep out", false},
    {"sleep out 120 ms after sleep in is legal", "10 ;@120 ;11 ;@5 ;29", NULL, false},
    {"sleep in 100 ms after sleep out", "10 ;@120 ;11 ;@100 ;10", "sleep in", false},
    {"software reset 100 ms after sleep out", "10 ;@120 ;11 ;@100 ;01", "software reset during", false},
    {"software reset, then 4 ms", "01 ;@4 ;28", "too early after a reset", false},
    {"software reset, then sleep out after 119 ms", "01 ;@119 ;11", "sleep out", false},
    {"software reset, then sleep out after 120 ms is legal", "01 ;@120 ;11 ;@120 ;29", NULL, false},
    {"software reset ends a broken transfer", "2A:00 00 ;01 ;@5 ;28", NULL, false},
    {"software reset ends a cut pixel", "2C ;+12 ;01 ;@5 ;28", NULL, false},
    {"reset, then 4 ms", "R0 ;@1 ;R1 ;@4 ;28", "too early after a reset", false},
    {"reset of the awake chip, then sleep out after 119 ms", "R0 ;@1 ;R1 ;@119 ;11", "sleep out", false},
    {"reset of the awake chip, then sleep out after 120 ms is legal", "R0 ;@1 ;R1 ;@120 ;11", NULL, false},
    {"traffic while reset is held", "R0 ;@1 ;29", "reset is held", false},
    {"reset let go at once", "R0 ;R1 ;@120 ;29", "reset was held for 0 ns", false},
    {"power on, then 4 ms", "@4 ;28", "too early after a reset", true},
    {"sleep out 5 ms after power on is legal", "@5 ;11", NULL, true},
    {"command 4 ms after sleep out", "@5 ;11 ;@4 ;29", "29h", true},
    {"pixels before the initialisation", "@120 ;2C ;+00 00", "asleep", true},
    {"sticky", "FF ;29", "unknown command FFh", false},
};

static void test_illegal(void **state) {
    const illegal_t *c = *state;
    board_t board;
    int result;

    open_board(&board, &(sim_bus_config_t){.blocking = true});
    if (!c->raw) { assert_int_equal(start_display(&board, 0, TUILE_WIRE_RGB565), 0); }
    result = play(&board, c->script);
    if (!c->fault) {
        assert_string_equal(board.chip->fault.text, "");
        assert_int_equal(result, 0);
    } else {
        assert_int_equal(result, TUILE_HAL_PROTOCOL);
        if (!strstr(board.chip->fault.text, c->fault)) { fail_msg("\"%s\" has no \"%s\"", board.chip->fault.text, c->fault); }
        assert_null(strchr(board.chip->fault.text, '\n'));
        assert_string_equal(board.bus.error.text, board.chip->fault.text);
        /* Sticky: nothing more is taken. */
        assert_int_equal(play(&board, "00"), TUILE_HAL_PROTOCOL);
    }
    close_board(&board);
}

static void test_misuse_of_the_bus(void **state) {
    static const uint8_t nop[] = {0x00}, write[] = {0x2C}, pixels[4] = {0};
    board_t board;
    tuile_bus_t *bus;

    (void)state;
    open_board(&board, &(sim_bus_config_t){.max_chunk_bytes = 64});
    start_display(&board, 0, TUILE_WIRE_RGB565);
    bus = &board.bus.bus;
    bus->command(bus->context, write, 1, 1);
    assert_int_equal(bus->data(bus->context, pixels, 65), TUILE_HAL_STATE);
    assert_int_equal(bus->data(bus->context, pixels, 4), 0);
    assert_int_equal(bus->data(bus->context, pixels, 4), TUILE_HAL_STATE);
    assert_int_equal(bus->command(bus->context, nop, 1, 1), TUILE_HAL_STATE);
    assert_int_equal(bus->wait(bus->context), 0);
    assert_int_equal(bus->command(bus->context, nop, 1, 1), 0);
    assert_non_null(strstr(board.bus.error.text, "larger than the bus takes"));
    close_board(&board);
}

/* ---- the frame loop ---------------------------------------------------------------------------------------- */

/* A renderer of 10 tiles of 240 x 32, that fails where it is told to and looks at what the loop does. Its buffers are poisoned
 * before they are drawn anew: two of them, or one, as a real renderer has. */
struct tuile {
    tuile_config_t config;
    unsigned next, begun, ended;
    int begin_error, next_error, end_error;
    unsigned fail_at; /* tile */
    const sim_bus_t *bus;
    uint8_t buffers[2][240 * 32 * 2];
};

static int fake_begin(tuile_t *renderer, const tuile_scene_t *scene) {
    (void)scene;
    if (renderer->begin_error) { return renderer->begin_error; }
    renderer->begun++;
    renderer->next = 0;
    return 0;
}

static int fake_next(tuile_t *renderer, tuile_tile_t *tile) {
    uint8_t *to = renderer->buffers[renderer->config.buffers == 2 ? renderer->next & 1 : 0];
    uint32_t y = 32 * renderer->next;

    *tile = (tuile_tile_t){0};
    if (renderer->next_error && renderer->next == renderer->fail_at) { return renderer->next_error; }
    if (renderer->next == 10) { return 0; }
    memset(to, 0, sizeof renderer->buffers[0]);
    for (uint32_t row = 0; row < 32; row++) {
        for (uint32_t x = 0; x < 240; x++) {
            put_pixel(to + 2 * (row * 240 + x), TUILE_WIRE_RGB565, colour(240, x, y + row));
        }
    }
    *tile = (tuile_tile_t){0, (uint16_t)y, 240, 32, to, sizeof renderer->buffers[0]};
    renderer->next++;
    return 1;
}

static int fake_end(tuile_t *renderer, tuile_stats_t *stats) {
    assert_null(renderer->bus->flying); /* the block is the renderer's again */
    renderer->ended++;
    if (stats) { stats->tiles = renderer->next; }
    return renderer->end_error;
}

static const tuile_config_t *fake_config(const tuile_t *renderer) { return &renderer->config; }

static const char *fake_error_text(int error) { return error ? "renderer" : "no error"; }

/* The loop itself, over that renderer, whatever else is linked. */
#define tuile_begin fake_begin
#define tuile_next fake_next
#define tuile_end fake_end
#define tuile_config fake_config
#define tuile_error_text fake_error_text
#define tuile_stream_frame stream_frame_under_test
#define tuile_stream_error_text stream_error_text_under_test
#define check stream_check
#define send stream_send
#include "../firmware/stream.c"
#undef check
#undef send

static const tuile_scene_t nothing;

static void open_stream(board_t *board, tuile_t *renderer, const sim_bus_config_t *config, uint8_t buffers) {
    open_board(board, config);
    memset(renderer, 0, sizeof *renderer);
    renderer->config = (tuile_config_t){.width = 240, .height = 320, .format = TUILE_RGB565_BE, .buffers = buffers};
    renderer->bus = &board->bus;
}

static void test_stream_frame(void **state) {
    static tuile_t renderer;

    (void)state;
    for (uint8_t buffers = 1; buffers <= 2; buffers++) {
        board_t board;
        tuile_stats_t stats;
        open_stream(&board, &renderer, NULL, buffers);
        assert_int_equal(start_display(&board, 0, TUILE_WIRE_RGB565), 0);
        for (unsigned frame = 1; frame <= 2; frame++) {
            assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, frame == 1 ? &stats : NULL), 0);
            assert_int_equal(renderer.ended, frame);
        }
        assert_int_equal(stats.tiles, 10);
        check_clean(&board);
        check_picture(&board, 0, TUILE_WIRE_RGB565);
        close_board(&board);
    }
}

/* The simulator must show what a renderer does that says it has two buffers and has one: else the loop's overlap is not tested. */
static void test_stream_overlaps_with_two_buffers_only(void **state) {
    static tuile_t renderer;
    board_t board;

    (void)state;
    open_stream(&board, &renderer, NULL, 2);
    renderer.config.buffers = 3; /* taken for two or more by the loop, for one by the renderer above */
    assert_int_equal(start_display(&board, 0, TUILE_WIRE_RGB565), 0);
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), 0);
    /* every tile but the last went out with the colours of the one after it */
    for (uint32_t x = 0; x < 240; x++) {
        uint32_t c = colour(240, x, 32);
        assert_int_equal(sim_dcs_memory(board.chip, x, 0), (c & ~0x1001u) | (c >> 5 & 0x1000) | (c >> 5 & 1));
    }
    close_board(&board);
}

static void test_stream_refuses_a_mismatch(void **state) {
    static tuile_t renderer;
    board_t board;
    tuile_stats_t stats = {.tiles = 99};

    (void)state;
    open_stream(&board, &renderer, NULL, 2);
    assert_int_equal(start_display(&board, 0, TUILE_WIRE_RGB565), 0);
    renderer.config.width = 239;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_ARGUMENT);
    renderer.config.width = 240;
    renderer.config.format = TUILE_RGB565_LE;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_ARGUMENT);
    renderer.config.format = TUILE_RGB565_BE;
    assert_int_equal(start_display(&board, 0, TUILE_WIRE_RGB666), 0);
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_ARGUMENT);
    assert_int_equal(renderer.begun, 0);
    assert_int_equal(stats.tiles, 0);
    close_board(&board);
}

static void test_stream_renderer_errors(void **state) {
    static tuile_t renderer;
    board_t board;
    tuile_stats_t stats;

    (void)state;
    open_stream(&board, &renderer, NULL, 2);
    assert_int_equal(start_display(&board, 0, TUILE_WIRE_RGB565), 0);
    renderer.begin_error = TUILE_ERROR_CAMERA;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_CAMERA);
    assert_int_equal(renderer.ended, 0);
    renderer.begin_error = 0;
    renderer.next_error = TUILE_ERROR_RANGE;
    for (renderer.fail_at = 0; renderer.fail_at <= 10; renderer.fail_at++) {
        renderer.begun = renderer.ended = 0;
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_RANGE);
        assert_int_equal(renderer.begun, 1);
        assert_int_equal(renderer.ended, 1);
        assert_int_equal(stats.tiles, renderer.fail_at);
        assert_int_equal(board.display.error, 0);
        assert_true(board.display.refresh); /* never presented */
    }
    renderer.next_error = 0;
    renderer.end_error = TUILE_ERROR_SEQUENCE;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_SEQUENCE);
    renderer.end_error = 0;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), 0);
    check_clean(&board);
    check_picture(&board, 0, TUILE_WIRE_RGB565);
    close_board(&board);
}

static void test_stream_display_faults(void **state) {
    static tuile_t renderer;

    (void)state;
    /* 21 transfers of the start, 10 tiles of 4 */
    for (uint64_t transfer = 22; transfer <= 61; transfer++) {
        board_t board;
        tuile_stats_t stats;
        open_stream(&board, &renderer, &(sim_bus_config_t){.fail_transfer = transfer, .fail_parts = 1}, 2);
        assert_int_equal(start_display(&board, 0, TUILE_WIRE_RGB565), 0);
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_HAL_IO);
        assert_int_equal(renderer.begun, 1);
        assert_int_equal(renderer.ended, 1);
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_HAL_IO);
        assert_int_equal(renderer.begun, 1); /* nothing is drawn for a display that is out of order */
        assert_int_equal(tuile_display_resume(&board.display), 0);
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), 0);
        check_clean(&board);
        check_picture(&board, 0, TUILE_WIRE_RGB565);
        close_board(&board);
    }
}

/* A fault of the last tile's transfer must not hide behind a renderer's error at the tile after it, nor get lost. */
static void test_stream_both_fail(void **state) {
    static tuile_t renderer;
    board_t board;

    (void)state;
    open_stream(&board, &renderer, &(sim_bus_config_t){.fail_transfer = 25}, 2); /* the data of tile 0 */
    assert_int_equal(start_display(&board, 0, TUILE_WIRE_RGB565), 0);
    renderer.next_error = TUILE_ERROR_RANGE;
    renderer.fail_at = 1;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), TUILE_ERROR_RANGE);
    assert_int_equal(renderer.ended, 1);
    assert_int_equal(board.display.error, TUILE_HAL_IO);
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), TUILE_HAL_IO);
    close_board(&board);
}

static void test_error_texts(void **state) {
    (void)state;
    for (int error = TUILE_HAL_GONE; error <= TUILE_HAL_ARGUMENT; error++) {
        assert_non_null(tuile_hal_error_text(error));
        assert_string_not_equal(tuile_hal_error_text(error), tuile_hal_error_text(-1000));
        assert_ptr_equal(stream_error_text_under_test(error), tuile_hal_error_text(error));
        for (int other = TUILE_HAL_GONE; other < error; other++) {
            assert_string_not_equal(tuile_hal_error_text(error), tuile_hal_error_text(other));
        }
    }
    assert_string_equal(stream_error_text_under_test(TUILE_ERROR_MEMORY), "renderer");
    assert_string_equal(tuile_hal_error_text(0), "no error");
}

/* ------------------------------------------------------------------------------------------------------------ */

#define ILLEGAL_COUNT (sizeof illegal_cases / sizeof illegal_cases[0])

int main(void) {
    static const struct CMUnitTest plain[] = {
        cmocka_unit_test(test_ili9341_init_bytes),
        cmocka_unit_test(test_ili9341_init_bytes_without_pins_turned_18_bits),
        cmocka_unit_test(test_address_mode_of_each_rotation),
        cmocka_unit_test(test_window_and_write_bytes),
        cmocka_unit_test(test_parameters_low),
        cmocka_unit_test(test_chunks),
        cmocka_unit_test(test_geometry_by_hand),
        cmocka_unit_test(test_window_with_offset_and_alignment),
        cmocka_unit_test(test_rotations_through_window_splits),
        cmocka_unit_test(test_memory_by_hand),
        cmocka_unit_test(test_colours_seen),
        cmocka_unit_test(test_write_wraps_in_window_and_continues),
        cmocka_unit_test(test_write_stops_at_the_window),
        cmocka_unit_test(test_arguments_send_nothing),
        cmocka_unit_test(test_brightness_and_sleep),
        cmocka_unit_test(test_sleep_is_legal_traffic),
        cmocka_unit_test(test_tearing),
        cmocka_unit_test(test_reading),
        cmocka_unit_test(test_template_port_opens),
        cmocka_unit_test(test_first_error_sticks),
        cmocka_unit_test(test_codes_of_a_port_do_not_pass),
        cmocka_unit_test(test_gone_is_final),
        cmocka_unit_test(test_fault_at_every_call),
        cmocka_unit_test(test_damaged_sequence),
        cmocka_unit_test(test_fault_at_every_transfer),
        cmocka_unit_test(test_gone_at_every_transfer),
        cmocka_unit_test(test_buffer_in_flight_is_not_ours),
        cmocka_unit_test(test_time_on_the_wire),
        cmocka_unit_test(test_real_clock_differs_from_the_one_asked_for),
        cmocka_unit_test(test_work_overlaps_the_wire),
        cmocka_unit_test(test_misuse_of_the_bus),
        cmocka_unit_test(test_stream_frame),
        cmocka_unit_test(test_stream_overlaps_with_two_buffers_only),
        cmocka_unit_test(test_stream_refuses_a_mismatch),
        cmocka_unit_test(test_stream_renderer_errors),
        cmocka_unit_test(test_stream_display_faults),
        cmocka_unit_test(test_stream_both_fail),
        cmocka_unit_test(test_error_texts),
    };
    enum { PLAIN_COUNT = sizeof plain / sizeof plain[0] };
    struct CMUnitTest tests[PLAIN_COUNT + ILLEGAL_COUNT];

    memcpy(tests, plain, sizeof plain);
    for (size_t i = 0; i < ILLEGAL_COUNT; i++) {
        tests[PLAIN_COUNT + i] = (struct CMUnitTest){
            .name = illegal_cases[i].name, .test_func = test_illegal, .initial_state = (void *)(uintptr_t)&illegal_cases[i]};
    }
    return cmocka_run_group_tests_name("hal", tests, NULL, NULL);
}
