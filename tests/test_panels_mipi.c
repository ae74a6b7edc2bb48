/* The panels of the MIPI DCS family, each by itself: the bytes of the start, where windows lie in the memory, how pixels lie on the
 * wire, the glass, clocks and identities. What each chip refuses is in test_panels_mipi_illegal.c.
 *
 * Bytes and numbers that are expected come from the data sheets, from the tables of other drivers and from hand, never from the
 * code under test. What all panels have in common is in test_panels.c. */
#include "support/check.h"

#include "../firmware/stream.h"
#include "../sim/chips/mipi_dcs.h"
#include "support/board.h"
#include "support/recorder.h"
#include "support/wire_script.h"

static const sim_panel_t *panel_of(const char *name) {
    const sim_panel_t *panel = sim_panel_find(name);

    if (!panel) { fail_msg("no panel %s", name); }
    return panel;
}

static void open_started(board_t *board, const char *name, uint8_t rotation, uint8_t wire) {
    board_open_panel(board, panel_of(name), &(sim_bus_config_t){.blocking = true});
    assert_int_equal(board_start(board, rotation, wire), 0);
}

/* ---- bytes of the start ------------------------------------------------------------------------------------------ */

#define RESET "backlight 0\nreset 1\nreset 0\ndelay 1\nreset 1\ndelay 120\n"

static const struct {
    const char *panel, *expected;
} starts[] = {
    {"st7789-240x240", RESET "11\ndelay 120\n"
                             "B0|00 C0\n"
                             "13\n"
                             "21\n36|00\n3A|55\n"},
    {"st7735-128x160", RESET "B1|01 2C 2D\n"
                             "B2|01 2C 2D\n"
                             "B3|01 2C 2D 01 2C 2D\n"
                             "B4|07\n"
                             "C0|A2 02 84\n"
                             "C1|C5\n"
                             "C2|0A 00\n"
                             "C3|8A 2A\n"
                             "C4|8A EE\n"
                             "C5|0E\n"
                             "E0|02 1C 07 12 37 32 29 2D 29 25 2B 39 00 01 03 10\n"
                             "E1|03 1D 07 06 2E 2C 29 2D 2E 2E 37 3F 00 00 02 10\n"
                             "11\ndelay 120\n"
                             "13\n"
                             "20\n36|C8\n3A|05\n"},
    {"gc9a01", RESET "FE\nEF\nEB|14\n"
                     "84|40\n85|FF\n86|FF\n87|FF\n88|0A\n89|21\n8A|00\n8B|80\n8C|01\n8D|01\n8E|FF\n8F|FF\n"
                     "90|08 08 08 08\n"
                     "B6|00 00\n"
                     "BD|06\nBC|00\nFF|60 01 04\n"
                     "C3|13\nC4|13\nC9|22\n"
                     "BE|11\nE1|10 0E\nDF|21 0C 02\n"
                     "F0|45 09 08 08 26 2A\nF1|43 70 72 36 37 6F\nF2|45 09 08 08 26 2A\nF3|43 70 72 36 37 6F\n"
                     "ED|1B 0B\nAE|77\nCD|63\n"
                     "70|07 07 04 0E 0F 09 07 08 03\n"
                     "E8|34\n"
                     "62|18 0D 71 ED 70 70 18 0F 71 EF 70 70\n"
                     "63|18 11 71 F1 70 70 18 13 71 F3 70 70\n"
                     "64|28 29 F1 01 F1 00 07\n"
                     "66|3C 00 CD 67 45 45 10 00 00 00\n"
                     "67|00 3C 00 00 00 01 54 10 32 98\n"
                     "74|10 85 80 00 00 4E 00\n"
                     "98|3E 07\n"
                     "11\ndelay 120\n"
                     "21\n36|48\n3A|55\n"},
    {"ili9488", RESET "E0|00 03 09 08 16 0A 3F 78 4C 09 0A 08 16 1A 0F\n"
                      "E1|00 16 19 03 0F 05 32 45 46 04 0E 0D 35 37 0F\n"
                      "C0|17 15\nC1|41\nC5|00 12 80\n"
                      "B0|00\nB1|A0 11\nB4|02\nB6|02 02 3B\nB7|C6\n"
                      "F7|A9 51 2C 82\n"
                      "11\ndelay 120\n"
                      "20\n36|48\n3A|66\n"},
    {"st7796", RESET "F0|C3\nF0|96\n"
                     "B4|01\nB6|80 02 3B\n"
                     "E8|40 8A 00 00 29 19 A5 33\n"
                     "C1|06\nC2|A7\nC5|18\n"
                     "E0|F0 09 0B 06 04 15 2F 54 42 3C 17 14 18 1B\n"
                     "E1|E0 09 0B 06 04 03 2B 43 42 3B 16 14 17 1B\n"
                     "F0|3C\nF0|69\n"
                     "11\ndelay 120\n"
                     "20\n36|48\n3A|55\n"},
};

static void test_bytes_of_the_start(void **state) {
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(starts); i++) {
        recorder_t recorder;
        tuile_bus_t bus = recorder_bus(&recorder);
        tuile_display_t display;
        assert_int_equal(
            tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = panel_of(starts[i].panel)->panel}), 0);
        assert_string_equal(recorder.log, starts[i].expected);
        recorder_forget(&recorder);
        assert_int_equal(tuile_display_present(&display), 0);
        assert_int_equal(tuile_display_sleep(&display), 0);
        assert_string_equal(recorder.log, "29\nbacklight 255\nbacklight 0\n28\n10\ndelay 120\n");
    }
}

/* Without a reset line: a pause, a software reset, a pause. */
static void test_software_reset(void **state) {
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(starts); i++) {
        recorder_t recorder;
        tuile_bus_t bus = recorder_bus(&recorder);
        tuile_display_t display;
        bus.pins = 0;
        assert_int_equal(
            tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = panel_of(starts[i].panel)->panel}), 0);
        assert_int_equal(strncmp(recorder.log, "delay 120\n01\ndelay 120\n", 23), 0);
    }
}

/* What the glasses of one chip differ in: address mode at each rotation, inversion. */
static void test_address_mode_and_inversion(void **state) {
    static const struct {
        const char *panel;
        uint8_t inversion, mode[4];
    } cases[] = {
        {"st7789-240x320", 0x21, {0x00, 0x60, 0xC0, 0xA0}},  {"st7789-240x240", 0x21, {0x00, 0x60, 0xC0, 0xA0}},
        {"st7789-135x240", 0x21, {0x00, 0x60, 0xC0, 0xA0}},  {"st7789-170x320", 0x21, {0x00, 0x60, 0xC0, 0xA0}},
        {"st7789-172x320", 0x21, {0x00, 0x60, 0xC0, 0xA0}},  {"st7789-240x280", 0x21, {0x00, 0x60, 0xC0, 0xA0}},
        {"st7735-128x160", 0x20, {0xC8, 0xA8, 0x08, 0x68}},  {"st7735-128x160-green", 0x20, {0xC8, 0xA8, 0x08, 0x68}},
        {"st7735-128x128", 0x20, {0xC8, 0xA8, 0x08, 0x68}},  {"st7735-80x160", 0x21, {0xC8, 0xA8, 0x08, 0x68}},
        {"st7735-80x160-0", 0x20, {0xC0, 0xA0, 0x00, 0x60}}, {"gc9a01", 0x21, {0x48, 0x28, 0x88, 0xE8}},
        {"ili9488", 0x20, {0x48, 0x28, 0x88, 0xE8}},         {"st7796", 0x20, {0x48, 0x28, 0x88, 0xE8}},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        for (uint8_t rotation = 0; rotation < 4; rotation++) {
            char expected[32];
            recorder_t recorder;
            tuile_bus_t bus = recorder_bus(&recorder);
            tuile_display_t display;
            const tuile_display_config_t config = {.bus = &bus, .panel = panel_of(cases[i].panel)->panel, .rotation = rotation};
            assert_int_equal(tuile_display_init(&display, &config), 0);
            snprintf(expected, sizeof expected, "\n%02X\n36|%02X\n3A|", cases[i].inversion, cases[i].mode[rotation]);
            if (!strstr(recorder.log, expected)) { fail_msg("%s, rotation %u: no %s", cases[i].panel, rotation, expected); }
        }
    }
}

static void test_pixel_format_bytes(void **state) {
    static const struct {
        const char *panel;
        uint8_t wire, code;
    } cases[] = {
        {"st7789-240x320", TUILE_WIRE_RGB565, 0x55},
        {"st7789-240x320", TUILE_WIRE_RGB444, 0x53},
        {"st7789-240x320", TUILE_WIRE_RGB666, 0x66},
        {"st7735-128x160", TUILE_WIRE_RGB565, 0x05},
        {"st7735-128x160", TUILE_WIRE_RGB444, 0x03},
        {"st7735-128x160", TUILE_WIRE_RGB666, 0x06},
        {"gc9a01", TUILE_WIRE_RGB565, 0x55},
        {"gc9a01", TUILE_WIRE_RGB444, 0x53},
        {"gc9a01", TUILE_WIRE_RGB666, 0x66},
        {"ili9488", TUILE_WIRE_RGB666, 0x66},
        {"ili9488", TUILE_WIRE_RGB111, 0x61},
        {"st7796", TUILE_WIRE_RGB565, 0x55},
        {"st7796", TUILE_WIRE_RGB666, 0x66},
        {"ili9488", TUILE_WIRE_RGB565, 0},
        {"st7796", TUILE_WIRE_RGB444, 0},
        {"st7789-240x320", TUILE_WIRE_RGB565_LE, 0},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        char expected[16];
        recorder_t recorder;
        tuile_bus_t bus = recorder_bus(&recorder);
        tuile_display_t display;
        const tuile_display_config_t config = {.bus = &bus, .panel = panel_of(cases[i].panel)->panel, .wire = cases[i].wire};
        const int result = tuile_display_init(&display, &config);
        if (cases[i].code == 0) {
            assert_int_equal(result, TUILE_HAL_UNSUPPORTED);
            assert_string_equal(recorder.log, "");
            continue;
        }
        assert_int_equal(result, 0);
        snprintf(expected, sizeof expected, "\n3A|%02X\n", cases[i].code);
        assert_string_equal(recorder.log + recorder.length - 7, expected);
    }
}

/* ---- where windows lie -------------------------------------------------------------------------------------------- */

/* Column and row of the picture's first pixel at each rotation, as drivers tabulate them. */
static void test_offsets(void **state) {
    static const struct {
        const char *panel;
        uint16_t offset[4][2];
    } cases[] = {
        {"st7789-240x320", {{0, 0}, {0, 0}, {0, 0}, {0, 0}}},
        {"st7789-240x240", {{0, 0}, {0, 0}, {0, 80}, {80, 0}}},
        {"st7789-135x240", {{52, 40}, {40, 53}, {53, 40}, {40, 52}}},
        {"st7789-170x320", {{35, 0}, {0, 35}, {35, 0}, {0, 35}}},
        {"st7789-172x320", {{34, 0}, {0, 34}, {34, 0}, {0, 34}}},
        {"st7789-240x280", {{0, 20}, {20, 0}, {0, 20}, {20, 0}}},
        {"st7735-128x160", {{0, 0}, {0, 0}, {0, 0}, {0, 0}}},
        {"st7735-128x160-green", {{2, 1}, {1, 2}, {2, 1}, {1, 2}}},
        {"st7735-128x128", {{2, 3}, {3, 2}, {2, 1}, {1, 2}}},
        {"st7735-80x160", {{26, 1}, {1, 26}, {26, 1}, {1, 26}}},
        {"st7735-80x160-0", {{24, 0}, {0, 24}, {24, 0}, {0, 24}}},
        {"gc9a01", {{0, 0}, {0, 0}, {0, 0}, {0, 0}}},
        {"ili9488", {{0, 0}, {0, 0}, {0, 0}, {0, 0}}},
        {"st7796", {{0, 0}, {0, 0}, {0, 0}, {0, 0}}},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        for (unsigned rotation = 0; rotation < 4; rotation++) {
            const tuile_panel_view_t view = tuile_panel_view(panel_of(cases[i].panel)->panel, rotation);
            if (view.x != cases[i].offset[rotation][0] || view.y != cases[i].offset[rotation][1]) {
                fail_msg("%s, rotation %u: (%u, %u)", cases[i].panel, rotation, view.x, view.y);
            }
        }
    }
}

/* 12 x 5 pixels at (3, 7) of the 135 x 240 glass, turned once: columns 40 + 3 ... = 2B ... 36, rows 53 + 7 ... = 3C ... 40. */
static void test_window_bytes(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_display_t display;
    tuile_display_config_t config = {.bus = &bus, .panel = panel_of("st7789-135x240")->panel, .rotation = 1};

    (void)state;
    assert_int_equal(tuile_display_init(&display, &config), 0);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_window(&display, 3, 7, 12, 5), 0);
    assert_string_equal(recorder.log, "2A|00 2B 00 36\n2B|00 3C 00 40\n2C\n");

    /* The GC9A01 wants rows first where they are exchanged for columns, and only there. */
    config.panel = panel_of("gc9a01")->panel;
    assert_int_equal(tuile_display_init(&display, &config), 0);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_window(&display, 3, 7, 12, 5), 0);
    assert_string_equal(recorder.log, "2B|00 07 00 0B\n2A|00 03 00 0E\n2B|00 07 00 0B\n2C\n");
    config.rotation = 2;
    assert_int_equal(tuile_display_init(&display, &config), 0);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_window(&display, 3, 7, 12, 5), 0);
    assert_string_equal(recorder.log, "2A|00 03 00 0E\n2B|00 07 00 0B\n2C\n");
}

/* The chip's own numbers, unmirrored, of the picture's first pixel. */
static void test_first_pixel_in_the_memory(void **state) {
    static const struct {
        const char *panel;
        uint16_t cell[4][2];
    } cases[] = {
        {"st7789-135x240", {{52, 40}, {186, 40}, {186, 279}, {52, 279}}},
        {"st7789-240x280", {{0, 20}, {239, 20}, {239, 299}, {0, 299}}},
        {"st7735-128x128", {{129, 128}, {2, 128}, {2, 1}, {129, 1}}}, /* the first row and column are at the lower right */
        {"gc9a01", {{239, 0}, {0, 0}, {0, 239}, {239, 239}}},         /* the first column is at the right */
        {"ili9488", {{319, 0}, {0, 0}, {0, 479}, {319, 479}}},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        for (uint8_t rotation = 0; rotation < 4; rotation++) {
            static const uint8_t white[3] = {0xFC, 0xFC, 0xFC};
            board_t board;
            open_started(&board, cases[i].panel, rotation, TUILE_WIRE_RGB666);
            assert_int_equal(tuile_display_window(&board.display, 0, 0, 1, 1), 0);
            assert_int_equal(tuile_display_write(&board.display, white, 3), 0);
            assert_int_equal(tuile_display_wait(&board.display), 0);
            if (sim_dcs_memory(board.chip, cases[i].cell[rotation][0], cases[i].cell[rotation][1]) != 0x3FFFF) {
                fail_msg("%s, rotation %u: not there", cases[i].panel, rotation);
            }
            board_check_clean(&board);
            board_close(&board);
        }
    }
}

/* The chip knows nothing of the glass: memory beside it is taken, and not seen. */
static void test_memory_beside_the_glass(void **state) {
    static const uint8_t black[2] = {0, 0};
    board_t board;
    sim_picture_t before, after;

    (void)state;
    open_started(&board, "st7789-135x240", 0, TUILE_WIRE_RGB565);
    assert_int_equal(board_draw(&board.display, TUILE_WIRE_RGB565, 135, 240), 0);
    assert_int_equal(board.chip->glass(board.chip, &before, NULL), 0);
    /* the cells around the corners of 52 ... 186 by 40 ... 279 */
    assert_int_equal(wire_play(&board, "2A:00 33 00 33 ;2B:00 28 00 28 ;2C ;+00 00 ;2A:00 34 00 34 ;2B:00 27 00 27 ;2C ;+00 00"),
                     0);
    assert_int_equal(wire_play(&board, "2A:00 BB 00 BB ;2B:01 17 01 17 ;2C ;+00 00 ;2A:00 BA 00 BA ;2B:01 18 01 18 ;2C ;+00 00"),
                     0);
    assert_int_equal(sim_dcs_memory(board.chip, 51, 40), 0);
    assert_int_equal(sim_dcs_memory(board.chip, 186, 280), 0);
    assert_int_equal(board.chip->glass(board.chip, &after, NULL), 0);
    assert_memory_equal(before.rgb, after.rgb, 135 * 240 * 3);
    sim_picture_free(&after);
    /* and one within */
    assert_int_equal(wire_play(&board, "2A:00 BA 00 BA ;2B:01 17 01 17 ;2C"), 0);
    assert_int_equal(board.bus.bus.data(&board.bus, black, 2), 0);
    assert_int_equal(board.chip->glass(board.chip, &after, NULL), 0);
    assert_memory_not_equal(before.rgb, after.rgb, 135 * 240 * 3);
    assert_memory_equal(before.rgb, after.rgb, (135 * 240 - 1) * 3);
    sim_picture_free(&before);
    sim_picture_free(&after);
    board_close(&board);
}

/* ---- pixels on the wire ------------------------------------------------------------------------------------------- */

#define SIX(red, green, blue) ((uint32_t)(red) << 12 | (green) << 6 | (blue))

/* Three pixels into the first of four cells of a row, then a command; extra goes before. Upper bits are repeated. */
static void test_pixels_by_hand(void **state) {
    static const struct {
        const char *panel;
        uint8_t wire;
        const char *extra, *pixels;
        uint32_t expected[3];
    } cases[] = {
        /* 8, 1, 15 - 0, 15, 4 - 9, 0, 0 and half a byte that is nobody's: 1000 is 100010, 0001 000100, 0100 010001, 1001 100110 */
        {"st7789-240x320", TUILE_WIRE_RGB444, "", "+81 F0 F4 90 0F", {SIX(34, 4, 63), SIX(0, 63, 17), SIX(38, 0, 0)}},
        {"st7735-128x160", TUILE_WIRE_RGB444, "", "+81 ;+F0 F4 ;+90 0F", {SIX(34, 4, 63), SIX(0, 63, 17), SIX(38, 0, 0)}},
        {"gc9a01", TUILE_WIRE_RGB444, "", "+81 F0 F4 90 0F", {SIX(34, 4, 63), SIX(0, 63, 17), SIX(38, 0, 0)}},
        /* 10000 is 100001 */
        {"st7789-240x320", TUILE_WIRE_RGB565, "", "+F8 00 07 E0 84 1F", {SIX(63, 0, 0), SIX(0, 63, 0), SIX(33, 32, 63)}},
        {"st7789-240x320", TUILE_WIRE_RGB565, "B0:00 C8", "+00 F8 E0 07 1F 84", {SIX(63, 0, 0), SIX(0, 63, 0), SIX(33, 32, 63)}},
        {"st7735-128x160", TUILE_WIRE_RGB565, "", "+F8 00 07 E0 84 1F", {SIX(63, 0, 0), SIX(0, 63, 0), SIX(33, 32, 63)}},
        {"gc9a01", TUILE_WIRE_RGB565, "", "+F8 00 07 E0 84 1F", {SIX(63, 0, 0), SIX(0, 63, 0), SIX(33, 32, 63)}},
        {"st7796", TUILE_WIRE_RGB565, "", "+F8 00 07 E0 84 1F", {SIX(63, 0, 0), SIX(0, 63, 0), SIX(33, 32, 63)}},
        /* the two lower bits of a byte do not matter */
        {"st7789-240x320", TUILE_WIRE_RGB666, "", "+FF 03 00 00 FC 04 80 40 20", {SIX(63, 0, 0), SIX(0, 63, 1), SIX(32, 16, 8)}},
        {"st7735-128x160", TUILE_WIRE_RGB666, "", "+FF 03 00 00 FC 04 80 40 20", {SIX(63, 0, 0), SIX(0, 63, 1), SIX(32, 16, 8)}},
        {"gc9a01", TUILE_WIRE_RGB666, "", "+FF 03 00 00 FC 04 80 40 20", {SIX(63, 0, 0), SIX(0, 63, 1), SIX(32, 16, 8)}},
        {"ili9488", TUILE_WIRE_RGB666, "", "+FF 03 00 00 FC 04 80 40 20", {SIX(63, 0, 0), SIX(0, 63, 1), SIX(32, 16, 8)}},
        {"st7796", TUILE_WIRE_RGB666, "", "+FF 03 00 00 FC 04 80 40 20", {SIX(63, 0, 0), SIX(0, 63, 1), SIX(32, 16, 8)}},
        /* two pixels a byte: 11 100 011, 00 110 000; the two upper bits do not matter */
        {"ili9488", TUILE_WIRE_RGB111, "", "+E3 30", {SIX(63, 0, 0), SIX(0, 63, 63), SIX(63, 63, 0)}},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        board_t board;
        open_started(&board, cases[i].panel, 0, cases[i].wire);
        assert_int_equal(wire_play(&board, cases[i].extra), 0);
        assert_int_equal(wire_play(&board, "36:00 ;2A:00 0A 00 0D ;2B:00 14 00 14 ;2C"), 0);
        assert_int_equal(wire_play(&board, cases[i].pixels), 0);
        assert_int_equal(wire_play(&board, "13"), 0);
        board_check_clean(&board);
        for (uint32_t pixel = 0; pixel < 3; pixel++) {
            const uint32_t held = sim_dcs_memory(board.chip, 10 + pixel, 20);
            if (held != cases[i].expected[pixel]) {
                fail_msg("%s, wire %u: pixel %u is %05X, not %05X", cases[i].panel, cases[i].wire, pixel, held,
                         cases[i].expected[pixel]);
            }
        }
        board_close(&board);
    }
}

/* 135 columns of two pixels a byte and a half. */
static void test_windows_that_end_at_an_odd_edge(void **state) {
    static const uint8_t pixels[203] = {0};
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_display_t display;
    const tuile_display_config_t config = {.bus = &bus, .panel = panel_of("st7789-135x240")->panel, .wire = TUILE_WIRE_RGB444};

    (void)state;
    assert_int_equal(tuile_display_init(&display, &config), 0);
    assert_int_equal(display.align_x, 2);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_window(&display, 0, 0, 133, 2), TUILE_HAL_ARGUMENT);
    assert_int_equal(tuile_display_window(&display, 1, 0, 134, 2), TUILE_HAL_ARGUMENT);
    assert_int_equal(tuile_display_window(&display, 0, 0, 137, 2), TUILE_HAL_ARGUMENT);
    assert_string_equal(recorder.log, "");
    /* 135 pixels are 202 bytes and a half */
    assert_int_equal(tuile_display_window(&display, 0, 0, 135, 1), 0);
    assert_int_equal(tuile_display_write(&display, pixels, 201), 0); /* 134 pixels */
    assert_int_equal(tuile_display_write(&display, pixels, 1), TUILE_HAL_ARGUMENT);
    assert_int_equal(tuile_display_present(&display), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_write(&display, pixels, 2), 0);
    assert_int_equal(tuile_display_present(&display), 0);
    assert_int_equal(tuile_display_window(&display, 134, 0, 1, 1), 0);
    assert_int_equal(tuile_display_write(&display, pixels, 3), TUILE_HAL_ARGUMENT);
    assert_int_equal(tuile_display_write(&display, pixels, 2), 0);
    assert_int_equal(display.left_bytes, 0);
}

/* And what the frame loop makes of them: tiles of 32 columns, the last one of 7; and one tile of all 135. */
static void test_frames_that_end_at_an_odd_edge(void **state) {
    static uint64_t block[8192];
    static const uint16_t tile_widths[] = {32, 0};
    const tuile_scene_t scene = {.background = {0x88, 0x11, 0xFF}};
    board_t board;
    tuile_t *renderer;
    tuile_panel_t aligned = *panel_of("st7789-135x240")->panel;

    (void)state;
    for (unsigned i = 0; i < 2; i++) {
        const tuile_config_t config = {
            .width = 135, .height = 240, .tile_width = tile_widths[i], .tile_height = 7, .format = TUILE_RGB444};
        sim_picture_t seen;
        open_started(&board, "st7789-135x240", 0, TUILE_WIRE_RGB444);
        assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
        assert_int_equal(tuile_stream_frame(renderer, &scene, &board.display, NULL), 0);
        board_check_clean(&board);
        assert_int_equal(sim_bus_picture(&board.bus, 0, &seen, NULL), 0);
        for (size_t pixel = 0; pixel < 135 * 240; pixel++) { /* 8, 1, 15 as above: 34, 4, 63 in 8 bits */
            assert_memory_equal(seen.rgb + 3 * pixel, "\x8A\x10\xFF", 3);
        }
        sim_picture_free(&seen);
        board_close(&board);
    }
    /* Where rows do not run on, the last tile would be cut: it is refused before anything is sent. */
    aligned.align_x = 2;
    board_open_panel(&board, panel_of("st7789-135x240"), NULL);
    assert_int_equal(tuile_display_init(&board.display, &(tuile_display_config_t){.bus = &board.bus.bus, .panel = &aligned}), 0);
    assert_int_equal(tuile_init(&renderer, &(tuile_config_t){.width = 135, .height = 240, .tile_width = 32, .tile_height = 7},
                                block, sizeof block, NULL),
                     0);
    const uint64_t transfers = board.bus.transfers;
    assert_int_equal(tuile_stream_frame(renderer, &scene, &board.display, NULL), TUILE_ERROR_ARGUMENT);
    assert_true(board.bus.transfers == transfers);
    board_close(&board);
}

/* ---- glass -------------------------------------------------------------------------------------------------------- */

/* Pixels from the first that is not black to the last one. */
static void lit_span(const sim_picture_t *picture, uint32_t y, uint32_t *first, uint32_t *count) {
    *first = *count = 0;
    for (uint32_t x = 0; x < picture->width; x++) {
        if (sim_picture_at(picture, x, y)[0] == 0) { continue; }
        if (*count == 0) { *first = x; }
        *count = x - *first + 1;
    }
}

/* (2x - 239)^2 + (2y - 239)^2 <= 240^2. Row 0: 57600 - 239^2 = 479, odd numbers up to 21: 22 pixels. Row 35: 57600 - 169^2 = 29039,
 * odd numbers up to 169: 170 pixels. Row 119: all. */
static void test_round_glass(void **state) {
    static const struct {
        uint32_t y, first, count;
    } rows[] = {{0, 109, 22}, {35, 35, 170}, {119, 0, 240}, {120, 0, 240}, {204, 35, 170}, {239, 109, 22}};
    static uint8_t white[240 * 240 * 2];
    board_t board;

    (void)state;
    assert_int_equal(panel_of("gc9a01")->panel->round, 1);
    memset(white, 0xFF, sizeof white);
    open_started(&board, "gc9a01", 0, TUILE_WIRE_RGB565);
    assert_int_equal(tuile_display_window(&board.display, 0, 0, 240, 240), 0);
    assert_int_equal(tuile_display_write(&board.display, white, sizeof white), 0);
    assert_int_equal(tuile_display_present(&board.display), 0);
    for (unsigned uncut = 0; uncut < 2; uncut++) {
        sim_picture_t seen;
        board.chip->uncut = uncut == 1;
        assert_int_equal(sim_bus_picture(&board.bus, 0, &seen, NULL), 0);
        for (size_t i = 0; i < CHECK_COUNT(rows); i++) {
            uint32_t first, count;
            lit_span(&seen, rows[i].y, &first, &count);
            assert_int_equal(first, uncut ? 0 : rows[i].first);
            assert_int_equal(count, uncut ? 240 : rows[i].count);
        }
        sim_picture_free(&seen);
    }
    board_close(&board);
}

/* Before the first frame, asleep, and with the other inversion. */
static void test_glass_without_voltage_and_inverted(void **state) {
    static const struct {
        const char *panel;
        uint8_t dark;
        const char *other;
    } cases[] = {
        {"st7789-240x240", 0, "20"},    {"st7735-80x160", 0, "20"}, {"gc9a01", 0, "20"},   {"st7735-128x160", 255, "21"},
        {"st7735-80x160-0", 255, "21"}, {"ili9488", 255, "21"},     {"st7796", 255, "21"},
    };
    static const uint8_t red[3] = {0xFC, 0, 0};

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        const uint8_t dark[3] = {cases[i].dark, cases[i].dark, cases[i].dark};
        board_t board;
        sim_picture_t glass;
        open_started(&board, cases[i].panel, 0, TUILE_WIRE_RGB666);
        assert_int_equal(tuile_display_window(&board.display, 0, 0, 1, 1), 0);
        assert_int_equal(tuile_display_write(&board.display, red, 3), 0);
        for (unsigned step = 0; step < 4; step++) {
            const uint8_t *const expected[] = {dark, (const uint8_t *)"\xFF\0\0", (const uint8_t *)"\0\xFF\xFF", dark};
            if (step == 1) { assert_int_equal(tuile_display_present(&board.display), 0); }
            if (step == 2) { assert_int_equal(wire_play(&board, cases[i].other), 0); }
            if (step == 3) { assert_int_equal(tuile_display_sleep(&board.display), 0); }
            assert_int_equal(board.chip->glass(board.chip, &glass, NULL), 0);
            assert_memory_equal(sim_picture_at(&glass, 0, 0), expected[step], 3);
            sim_picture_free(&glass);
        }
        board_check_clean(&board);
        board_close(&board);
    }
}

/* ---- clocks and identities ---------------------------------------------------------------------------------------- */

static void test_rated_clocks(void **state) {
    static const struct {
        const char *panel;
        uint32_t rated_hz;
    } cases[] = {{"st7789-240x320", 62500000},
                 {"st7735-128x160", 15151515},
                 {"gc9a01", 100000000},
                 {"ili9488", 20000000},
                 {"st7796", 15151515}};
    static const uint8_t pixels[6] = {0};

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        for (uint32_t more = 0; more < 2; more++) {
            board_t board;
            board_open_panel(&board, panel_of(cases[i].panel), NULL);
            assert_int_equal(board.panel->panel->rated_pixel_clock_hz, cases[i].rated_hz);
            const tuile_display_config_t config = {
                .bus = &board.bus.bus, .panel = board.panel->panel, .pixel_clock_hz = cases[i].rated_hz + more};
            assert_int_equal(tuile_display_init(&board.display, &config), 0);
            assert_int_equal(board.chip->warnings, 0); /* commands are slow */
            assert_int_equal(tuile_display_window(&board.display, 0, 0, 1, 2), 0);
            assert_int_equal(tuile_display_write(&board.display, pixels, tuile_wire_bits(board.display.wire) / 4), 0);
            assert_int_equal(tuile_display_wait(&board.display), 0);
            assert_int_equal(board.chip->warnings, more);
            board_check_clean(&board); /* a warning is no fault */
            board_close(&board);
        }
    }
}

static void test_identities(void **state) {
    static const struct {
        const char *panel;
        uint8_t command, id[3];
    } cases[] = {
        {"st7789-170x320", 0x04, {0x85, 0x85, 0x52}}, {"st7735-128x160", 0x04, {0x5C, 0x89, 0xF0}},
        {"gc9a01", 0x04, {0x00, 0x9A, 0x01}},         {"ili9488", 0xD3, {0x00, 0x94, 0x88}},
        {"st7796", 0xD3, {0x00, 0x77, 0x96}},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        uint8_t id[3] = {0};
        board_t board;
        tuile_panel_t other;
        board_open_panel(&board, panel_of(cases[i].panel), NULL);
        tuile_display_config_t config = {.bus = &board.bus.bus, .panel = board.panel->panel, .identify = true};
        if (config.panel->id_command) {
            assert_int_equal(tuile_display_init(&board.display, &config), 0);
            other = *config.panel;
            other.id[2] ^= 1;
            config.panel = &other;
            assert_int_equal(tuile_display_init(&board.display, &config), TUILE_HAL_IDENTITY);
        } else {
            assert_int_equal(tuile_display_init(&board.display, &config), TUILE_HAL_UNSUPPORTED);
            assert_int_equal(board_start(&board, 0, TUILE_WIRE_DEFAULT), 0);
        }
        assert_int_equal(board.bus.bus.read(&board.bus, cases[i].command, id, 3), 0);
        assert_memory_equal(id, cases[i].id, 3);
        assert_int_equal(board.bus.bus.read(&board.bus, cases[i].command ^ (0x04 ^ 0xD3), id, 3), TUILE_HAL_PROTOCOL);
        board_close(&board);
    }
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bytes_of_the_start),
        cmocka_unit_test(test_software_reset),
        cmocka_unit_test(test_address_mode_and_inversion),
        cmocka_unit_test(test_pixel_format_bytes),
        cmocka_unit_test(test_offsets),
        cmocka_unit_test(test_window_bytes),
        cmocka_unit_test(test_first_pixel_in_the_memory),
        cmocka_unit_test(test_memory_beside_the_glass),
        cmocka_unit_test(test_pixels_by_hand),
        cmocka_unit_test(test_windows_that_end_at_an_odd_edge),
        cmocka_unit_test(test_frames_that_end_at_an_odd_edge),
        cmocka_unit_test(test_round_glass),
        cmocka_unit_test(test_glass_without_voltage_and_inverted),
        cmocka_unit_test(test_rated_clocks),
        cmocka_unit_test(test_identities),
    };
    return cmocka_run_group_tests_name("panels of the MIPI DCS family", tests, NULL, NULL);
}
