/* The models of OLED controllers: what each makes of bytes on the wire, how its memory comes to the glass, and the illegal traffic
 * that it reports.
 *
 * What is expected is from the data sheets, by hand. */
#include "support/board.h"
#include "support/check.h"

#include "../sim/chips/oled.h"

/* ---- scripts ---------------------------------------------------------------------------------------------------- */

/* Steps with semicolons between them: "A0|06 11" is a command, with D/C high from the bar on; "+12 34" are data, "@5" is a pause of
 * 5 ms, "R0" and "R1" the reset line. Returns the first error. */
static int play(board_t *board, const char *script) {
    tuile_bus_t *bus = &board->bus.bus;
    int result = 0;

    while (*script && result == 0) {
        uint8_t bytes[64];
        size_t count = 0, low = 0;
        const char kind = *script;
        char *end;

        if (kind == '@' || kind == 'R') {
            const unsigned value = (unsigned)strtoul(script + 1, &end, 10);
            result = kind == '@' ? bus->delay_ms(bus->context, value) : bus->pin(bus->context, TUILE_PIN_RESET, (uint8_t)value);
            script = end;
        } else {
            script += kind == '+';
            while (*script && *script != ';') {
                bytes[count++] = (uint8_t)strtoul(script, &end, 16);
                script = end;
                if (*script == '|') { low = count; }
                script += *script == '|' || *script == ' ';
            }
            result =
                kind == '+' ? bus->data(bus->context, bytes, count) : bus->command(bus->context, bytes, low ? low : count, count);
        }
        script += *script == ';';
    }
    return result;
}

/* raw: the chip has just been powered; otherwise the driver has started it, at rotation 0. */
static void open_chip(board_t *board, const char *name, bool raw) {
    const sim_panel_t *panel = sim_panel_find(name);

    assert_non_null(panel);
    board_open_panel(board, panel, &(sim_bus_config_t){.blocking = true, .no_backlight_pin = true});
    assert_int_equal(play(board, "@1"), 0);
    if (!raw) { assert_int_equal(board_start(board, 0, TUILE_WIRE_DEFAULT), 0); }
}

static void check_cell(const board_t *board, unsigned segment, unsigned row, uint32_t value) {
    const uint32_t found = sim_oled_memory(board->chip, segment, row);

    if (found != value) { fail_msg("segment %u, row %u: %X, not %X", segment, row, found, value); }
}

/* The 8 rows of a page, the upper one in bit 0. */
static void check_page(const board_t *board, unsigned segment, unsigned page, unsigned value) {
    for (unsigned bit = 0; bit < 8; bit++) {
        check_cell(board, segment, 8 * page + bit, value >> bit & 1);
    }
}

/* ---- memory ----------------------------------------------------------------------------------------------------- */

static void ssd1306_addressing(void **state) {
    board_t board;
    (void)state;
    open_chip(&board, "ssd1306-128x64", false);
    /* Columns, then pages; past the end the window begins again. A0h: column 0 is segment 0; A1h: segment 127. */
    assert_int_equal(play(&board, "A0;21 0A 0B;22 02 03;+01 02 04 08;+10"), 0);
    check_page(&board, 10, 2, 0x10);
    check_page(&board, 11, 2, 0x02);
    check_page(&board, 10, 3, 0x04);
    check_page(&board, 11, 3, 0x08);
    assert_int_equal(play(&board, "A1;21 0A 0B;22 02 03;+81 42"), 0);
    check_page(&board, 117, 2, 0x81);
    check_page(&board, 116, 2, 0x42);
    check_page(&board, 10, 2, 0x10); /* what is there stays where it is (10.1.8) */
    /* Pages, then columns (10.1.3). */
    assert_int_equal(play(&board, "A0;20 01;21 14 15;22 06 07;+01 02 04 08 10"), 0);
    check_page(&board, 20, 6, 0x10);
    check_page(&board, 20, 7, 0x02);
    check_page(&board, 21, 6, 0x04);
    check_page(&board, 21, 7, 0x08);
    /* Page addressing: column 7Eh of page 5, and after the last one back to where it began. */
    assert_int_equal(play(&board, "20 02;B5;17;0E;+01 02 04;B4;03;12;+08"), 0);
    check_page(&board, 35, 4, 0x08);
    check_page(&board, 126, 5, 0x04);
    check_page(&board, 127, 5, 0x02);
    board_check_clean(&board);
    board_close(&board);
}

static void sh1106_addressing(void **state) {
    board_t board;
    (void)state;
    open_chip(&board, "sh1106", false);
    assert_int_equal(play(&board, "A0;B7;18;02;+01 02"), 0); /* columns 130 and 131, the last */
    check_page(&board, 130, 7, 0x01);
    check_page(&board, 131, 7, 0x02);
    assert_int_equal(play(&board, "A1;B0;10;00;+80 40;B1;+20"), 0); /* a page leaves the column */
    check_page(&board, 131, 0, 0x80);
    check_page(&board, 130, 0, 0x40);
    check_page(&board, 129, 1, 0x20);
    board_check_clean(&board);
    board_close(&board);
}

static void ssd1322_halves_of_bytes(void **state) {
    static const struct {
        const char *script;
        unsigned first, expected[4]; /* from this segment on */
    } cases[] = {
        {"A0|00 11", 112, {4, 3, 2, 1}}, /* as after a reset: the last half is the lowest segment */
        {"A0|04 11", 112, {1, 2, 3, 4}},
        {"A0|02 11", 364, {1, 2, 3, 4}}, /* columns from the other end: 479 - 112 = 367 */
        {"A0|06 11", 364, {4, 3, 2, 1}},
    };
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        board_t board;
        open_chip(&board, "ssd1322", false);
        assert_int_equal(play(&board, cases[i].script), 0);
        assert_int_equal(play(&board, "15|1C 1C;75|7F 7F;5C;+12;+34"), 0);
        for (unsigned j = 0; j < 4; j++) {
            check_cell(&board, cases[i].first + j, 127, cases[i].expected[j]);
        }
        board_check_clean(&board);
        board_close(&board);
    }
}

static void ssd1322_pointer(void **state) {
    board_t board;
    (void)state;
    open_chip(&board, "ssd1322", false);
    assert_int_equal(play(&board, "A0|04 11;15|00 01;75|00 01;5C;+11 11 22 22 33 33 44 44 55 55"), 0);
    check_cell(&board, 0, 0, 5);
    check_cell(&board, 4, 0, 2);
    check_cell(&board, 0, 1, 3);
    check_cell(&board, 7, 1, 4);
    assert_int_equal(play(&board, "A0|05 11;15|76 77;75|00 01;5C;+11 11 22 22 33 33 44 44 55 55"), 0);
    check_cell(&board, 472, 0, 5);
    check_cell(&board, 472, 1, 2);
    check_cell(&board, 476, 0, 3);
    check_cell(&board, 479, 1, 4);
    board_check_clean(&board);
    board_close(&board);
}

static void ssd0323_halves_of_bytes_and_pointer(void **state) {
    static const struct {
        const char *script;
        unsigned first, expected[2];
    } cases[] = {
        {"A0 40", 0, {2, 1}}, /* as after a reset: the lower half is the lower segment */
        {"A0 42", 0, {1, 2}},
        {"A0 41", 126, {2, 1}}, /* columns from the other end, bytes as they are */
        {"A0 43", 126, {1, 2}},
    };
    board_t board;
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        open_chip(&board, "ssd0323", false);
        assert_int_equal(play(&board, cases[i].script), 0);
        assert_int_equal(play(&board, "15 00 00;75 4F 4F;+12"), 0);
        check_cell(&board, cases[i].first, 79, cases[i].expected[0]);
        check_cell(&board, cases[i].first + 1, 79, cases[i].expected[1]);
        board_check_clean(&board);
        board_close(&board);
    }
    open_chip(&board, "ssd0323", false);
    assert_int_equal(play(&board, "A0 42;15 02 03;75 05 06;+11 22 33 44 55"), 0);
    check_cell(&board, 4, 5, 5);
    check_cell(&board, 6, 5, 2);
    check_cell(&board, 4, 6, 3);
    check_cell(&board, 6, 6, 4);
    assert_int_equal(play(&board, "A0 46;15 02 03;75 05 06;+11 22 33"), 0);
    check_cell(&board, 4, 5, 1);
    check_cell(&board, 4, 6, 2);
    check_cell(&board, 6, 5, 3);
    board_close(&board);
}

/* A memory write goes on where the last one ended; columns and rows told anew begin anew. */
static void ssd1351_pointer(void **state) {
    board_t board;
    (void)state;
    open_chip(&board, "ssd1351", false);
    assert_int_equal(play(&board, "15|0A 0B;75|14 15;5C;+00 01 00;+02;5C;+00 03"), 0);
    check_cell(&board, 10, 20, 2); /* 5 bits b of blue are 2b in 6 */
    check_cell(&board, 11, 20, 4);
    check_cell(&board, 10, 21, 6);
    assert_int_equal(play(&board, "15|0A 0B;5C;+00 04"), 0); /* the row stays */
    check_cell(&board, 10, 21, 8);
    assert_int_equal(play(&board, "15|0A 0B;75|14 15;5C;+F8 00 07 E0"), 0);
    check_cell(&board, 10, 20, 0x3F000);
    check_cell(&board, 11, 20, 0x00FC0);
    assert_int_equal(play(&board, "A0|77;15|0A 0B;75|14 15;5C;+00 01 00 02 00 03"), 0); /* rows first, segment 127 - column */
    check_cell(&board, 117, 20, 2);
    check_cell(&board, 117, 21, 4);
    check_cell(&board, 116, 20, 6);
    check_cell(&board, 10, 20, 0x3F000);
    board_check_clean(&board);
    board_close(&board);
}

/* ---- glass ------------------------------------------------------------------------------------------------------ */

/* The picture, drawn by the driver at rotation 0, shown after a script: row `row` of it at line y, or nothing (< 0). */
typedef struct shown {
    const char *name, *script;
    int (*row)(int y);
} shown_t;

enum { NOISE = 1000 }; /* rows of the memory that were not written */

static int as_it_is(int y) { return y; }
static int dark(int y) { return -1 - y; }
static int flipped_64(int y) { return 63 - y; }
static int five_down_64(int y) { return (y + 5) % 64; }
static int flipped_five_down_64(int y) { return (68 - y) % 64; }
static int last_48(int y) { return y - 16; } /* commons 47 to 0 are at the bottom */
static int first_48(int y) { return y < 16 ? -1 : 63 - y; }
/* Line 63 - k is wired to the pin of common k, odd ones to the upper half; there a sequence has common k / 2 (+ 32). */
static int in_sequence(int y) { return 63 - ((63 - y) / 2 + ((63 - y) % 2 ? 32 : 0)); }
static int split_32(int y) { return 2 * y - 31; } /* line 31 - k of a sequence has common 2 k, and they are scanned up to 31 */
static int down_96_of_128(int y) { return (y + 96) % 128; }
static int down_32_of_128(int y) { return (y + 32) % 128; }
static int flipped_128(int y) { return 127 - y; }
static int up_8(int y) { return y < 56 ? y + 8 : -1; }
static int flipped_up_8(int y) { return 55 - y; } /* common 63 - y shows row 63 - y + 72 - 80 */
static int five_from_noise(int y) { return y < 59 ? y + 5 : NOISE; }

static const shown_t shown[] = {
    {"ssd1306-128x64", "E3", as_it_is},
    {"ssd1306-128x64", "A0", as_it_is}, /* for data to come only (10.1.8) */
    {"ssd1306-128x64", "C0", flipped_64},
    {"ssd1306-128x64", "45", five_down_64},
    {"ssd1306-128x64", "D3 05", five_down_64},
    {"ssd1306-128x64", "C0;D3 05", flipped_five_down_64},
    {"ssd1306-128x64", "42;D3 03", five_down_64},
    {"ssd1306-128x64", "A8 2F", last_48},
    {"ssd1306-128x64", "A8 2F;C0", first_48},
    {"ssd1306-128x64", "DA 02", in_sequence},
    {"ssd1306-128x64", "AE", dark},
    {"ssd1306-128x64", "AE;AF", as_it_is},
    {"ssd1306-128x64", "8D 10", dark},
    {"ssd1306-128x64", "81 00", dark},
    {"ssd1306-128x64", "81 FF", as_it_is},
    {"ssd1306-128x32", "DA 12", split_32},
    {"sh1106", "C0", flipped_64},
    {"sh1106", "45", five_down_64},
    {"sh1106", "D3 05", five_down_64},
    {"sh1106", "DA 02", in_sequence},
    {"sh1106", "AD 8A", dark},
    {"ssd1322", "A0|16 11", flipped_64},
    {"ssd1322", "A1|05", five_from_noise},
    {"ssd1322", "C1|00", dark},
    {"ssd1322", "A4", dark},
    {"ssd1322", "A4;A6", as_it_is},
    /* 79 - common, and common, and 64 of the 80 that are shown */
    {"ssd0323", "A2 48", up_8},
    {"ssd0323", "A0 42;A2 00", flipped_64},
    {"ssd0323", "A0 42;A2 48", flipped_up_8},
    {"ssd0323", "A1 05", five_from_noise},
    {"ssd0323", "A6", dark},
    {"ssd0323", "A6;A4", as_it_is},
    {"ssd1351", "A2|60", down_96_of_128}, /* what a reset leaves */
    {"ssd1351", "A1|20", down_32_of_128},
    {"ssd1351", "A0|64", flipped_128},
    {"ssd1351", "A0|76", as_it_is},
    {"ssd1351", "A4", dark},
    {"ssd1351-128x96", "A1|00", as_it_is},
};

static void memory_comes_to_the_glass(void **state) {
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(shown); i++) {
        board_t board;
        sim_picture_t glass;

        open_chip(&board, shown[i].name, false);
        const uint8_t wire = board.display.wire;
        assert_int_equal(board_draw(&board.display, wire, 480, 480), 0);
        assert_int_equal(play(&board, shown[i].script), 0);
        board_check_clean(&board);
        assert_int_equal(board.chip->glass(board.chip, &glass, NULL), 0);
        for (int y = 0; y < (int)glass.height; y++) {
            const int row = shown[i].row(y);

            for (uint32_t x = 0; x < glass.width && row != NOISE; x++) {
                uint8_t expected[3] = {0};

                if (row >= 0) { board_seen(expected, wire, board_colour(glass.width, x, (uint32_t)row)); }
                if (memcmp(sim_picture_at(&glass, x, (uint32_t)y), expected, 3) != 0) {
                    fail_msg("%s after %s: pixel %u,%d is not row %d", shown[i].name, shown[i].script, x, y, row);
                }
            }
        }
        sim_picture_free(&glass);
        board_close(&board);
    }
}

/* Two pixels at the top left: a value, what is seen of it, and after which commands. */
static void values_come_to_the_glass(void **state) {
    static const struct {
        const char *name, *script;
        uint8_t rgb[3];
    } cases[] = {
        {"ssd1306-128x64", "21 00 00;22 00 00;+01", {255, 255, 255}},
        {"ssd1306-128x64", "21 00 00;22 00 00;+01;A7", {0, 0, 0}},
        {"ssd1306-128x64", "21 00 00;22 00 00;+FE;A7", {255, 255, 255}},
        {"ssd1306-128x64", "21 00 00;22 00 00;+FE;A5", {255, 255, 255}},
        {"ssd1306-128x64", "21 00 00;22 00 00;+FE;A5;A4", {0, 0, 0}},
        {"sh1106", "B0;10;02;+FE;A7", {255, 255, 255}},
        {"sh1106", "B0;10;02;+FE;A5", {255, 255, 255}},
        {"ssd1322", "15|1C 1C;75|00 00;5C;+A0 00", {170, 170, 170}},
        {"ssd1322", "15|1C 1C;75|00 00;5C;+A0 00;A7", {85, 85, 85}},
        {"ssd1322", "15|1C 1C;75|00 00;5C;+A0 00;A5", {255, 255, 255}},
        {"ssd1322", "15|1C 1C;75|00 00;5C;+A0 00;A5;A6", {170, 170, 170}},
        {"ssd1322", "15|1C 1C;75|00 00;5C;+F0 00;C7|03", {63, 63, 63}}, /* 4 sixteenths of 255 */
        {"ssd0323", "15 00 00;75 00 00;+A0", {170, 170, 170}},
        {"ssd0323", "15 00 00;75 00 00;+A0;A7", {85, 85, 85}},
        {"ssd0323", "15 00 00;75 00 00;+A0;A5", {255, 255, 255}},
        {"ssd0323", "15 00 00;75 00 00;+F0;85", {127, 127, 127}}, /* half */
        {"ssd0323", "15 00 00;75 00 00;+F0;84", {63, 63, 63}},    /* a quarter */
        {"ssd0323", "15 00 00;75 00 00;+F0;84;86", {255, 255, 255}},
        {"ssd1351", "15|00 00;75|00 00;5C;+F8 00", {255, 0, 0}},
        {"ssd1351", "15|00 00;75|00 00;5C;+F8 00;A0|70", {0, 0, 255}},                                  /* colours swapped */
        {"ssd1351", "R0;@1;R1;@1;FD|B1;C1|C8 80 C8;A0|74;15|00 00;75|60 60;5C;+F8 00;AF", {255, 0, 0}}, /* A2h is 60h */
        {"ssd1351", "15|00 00;75|00 00;5C;+07 E0", {0, 255, 0}},
        {"ssd1351", "15|00 00;75|00 00;5C;+07 E0;A7", {255, 0, 255}},
        {"ssd1351", "15|00 00;75|00 00;5C;+00 00;A5", {255, 255, 255}},
        {"ssd1351", "15|00 00;75|00 00;5C;+84 10", {0x86, 0x82, 0x86}},
        {"ssd1351", "15|00 00;75|00 00;5C;+FF FF;C1|C8 40 00", {0, 127, 255}}, /* A is blue, B green, C red */
    };
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        board_t board;
        sim_picture_t glass;

        open_chip(&board, cases[i].name, false);
        assert_int_equal(tuile_display_present(&board.display), 0);
        assert_int_equal(play(&board, cases[i].script), 0);
        assert_int_equal(board.chip->glass(board.chip, &glass, NULL), 0);
        if (memcmp(sim_picture_at(&glass, 0, 0), cases[i].rgb, 3) != 0) {
            const uint8_t *rgb = sim_picture_at(&glass, 0, 0);
            fail_msg("%s after %s: %u %u %u", cases[i].name, cases[i].script, rgb[0], rgb[1], rgb[2]);
        }
        sim_picture_free(&glass);
        board_close(&board);
    }
}

/* Whoever switches on before writing shows it, as on the bench. */
static void memory_holds_noise_after_power_up(void **state) {
    static const char *const cases[][2] = {
        {"ssd1306-128x64", "8D 14;AF"}, {"sh1106", "AF"}, {"ssd1322", "AF"}, {"ssd0323", "AF"}, {"ssd1351", "AF"}};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        board_t board;
        sim_picture_t glass;
        unsigned changes = 0;

        open_chip(&board, cases[i][0], true);
        assert_int_equal(play(&board, cases[i][1]), 0);
        assert_int_equal(board.chip->glass(board.chip, &glass, NULL), 0);
        for (size_t p = 1; p < (size_t)glass.width * glass.height; p++) {
            changes += memcmp(glass.rgb + 3 * p, glass.rgb + 3 * p - 3, 3) != 0;
        }
        assert_true(changes > glass.width * glass.height / 4);
        sim_picture_free(&glass);
        board_close(&board);
    }
}

/* The pump of an SSD1306 module stands still after a reset, so nothing is seen: 8Dh 14h is what drivers forget. */
static void ssd1306_without_its_pump_is_dark(void **state) {
    board_t board;
    sim_picture_t glass;
    (void)state;
    open_chip(&board, "ssd1306-128x64", true);
    assert_int_equal(play(&board, "A5;AF"), 0);
    assert_int_equal(board.chip->glass(board.chip, &glass, NULL), 0);
    assert_int_equal(glass.rgb[0], 0);
    sim_picture_free(&glass);
    board_close(&board);
}

static void a_clock_beyond_the_data_sheets_is_a_warning(void **state) {
    static const struct {
        const char *name;
        uint32_t rated_hz;
    } cases[] = {
        {"ssd1306-128x64", 10000000}, {"sh1106", 4000000}, {"ssd1322", 10000000}, {"ssd0323", 4000000}, {"ssd1351", 20000000}};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        for (unsigned above = 0; above < 2; above++) {
            const sim_panel_t *panel = sim_panel_find(cases[i].name);
            board_t board;

            board_open_panel(&board, panel,
                             &(sim_bus_config_t){.clock_hz = cases[i].rated_hz + above, .command_clock_hz = 1000000});
            assert_int_equal(board_start(&board, 0, TUILE_WIRE_DEFAULT), 0);
            assert_int_equal(board_draw(&board.display, board.display.wire, 480, 480), 0);
            board_check_clean(&board);
            assert_int_equal(board.chip->warnings > 0, above);
            assert_int_equal(board.chip->warning.text[0] != '\0', above);
            board_close(&board);
        }
    }
}

/* ---- illegal traffic -------------------------------------------------------------------------------------------- */

typedef struct illegal {
    const char *panel, *script;
    const char *fault; /* part of the one line; NULL: legal after all */
    bool raw;          /* the chip has just been powered */
} illegal_t;

static const illegal_t illegal_cases[] = {
    /* windows */
    {"ssd1306-128x64", "21 00 80", "columns from 0 to 128", false},
    {"ssd1306-128x64", "21 05 04", "columns from 5 to 4", false},
    {"ssd1306-128x64", "22 00 08", "pages from 0 to 8", false},
    {"ssd1306-128x64", "22 03 02", "pages from 3 to 2", false},
    {"ssd1306-128x32", "21 00 7F;22 00 07;+00", NULL, false}, /* all of the chip's memory */
    {"sh1106", "B0;18;04;+00", "columns from 132 to 131", false},
    {"sh1106", "B0;18;03;+00 00", "before columns and rows", false}, /* the counter stops after 131 */
    {"ssd1322", "15|00 78", "columns from 0 to 120", false},
    {"ssd1322", "15|01 00", "columns from 1 to 0", false},
    {"ssd1322", "75|00 80", "rows from 0 to 128", false},
    {"ssd0323", "15 00 40", "columns from 0 to 64", false},
    {"ssd0323", "75 00 50", "rows from 0 to 80", false},
    {"ssd0323", "75 02 01", "rows from 2 to 1", false},
    {"ssd1351", "15|00 80", "columns from 0 to 128", false},
    {"ssd1351", "75|00 80", "rows from 0 to 128", false},
    {"ssd1351", "75|7F 7E", "rows from 127 to 126", false},
    /* parameters: their number and D/C */
    {"ssd1306-128x64", "21|00 7F", "D/C is high at parameter 1 of command 21h", false},
    {"ssd1306-128x64", "21 00|7F", "D/C is high at parameter 2 of command 21h", false},
    {"ssd1306-128x64", "81;+00", "D/C is high at parameter 1 of command 81h", false},
    {"sh1106", "81|CF", "D/C is high at parameter 1", false},
    {"ssd0323", "15|00 3F", "D/C is high at parameter 1", false},
    {"ssd1322", "15 00 3F", "15h takes 2 parameters and got 0", false},
    {"ssd1322", "15|00;5C", "15h takes 2 parameters and got 1", false},
    {"ssd1322", "A0|06;AF", "A0h takes 2 parameters and got 1", false},
    {"ssd1322", "A1|00 00", "belong to no command", false},
    {"ssd1351", "15 00 7F", "15h takes 2 parameters and got 0", false},
    {"ssd1351", "C1|C8 80;AF", "C1h takes 3 parameters and got 2", false},
    {"ssd1351", "AF|00", "belong to no command", false},
    /* data */
    {"ssd1306-128x64", "+00", "before columns and rows", false},
    {"ssd1306-128x64", "21 00 7F;+00", "before columns and rows", false},
    {"ssd1306-128x64", "21 00 7F;22 00 07;20 01;+00", "before columns and rows", false},
    {"sh1106", "B0;+00", "before columns and rows", false},
    {"sh1106", "10;02;+00", "before columns and rows", false},
    {"ssd0323", "+00", "before columns and rows", false},
    {"ssd0323", "15 00 3F;+00", "before columns and rows", false},
    {"ssd0323", "15 00 3F;75 00 3F;A0 41;+00", "before columns and rows", false},
    {"ssd1322", "15|1C 1C;75|00 00;+00", "belong to no command", false},
    {"ssd1322", "5C;+00", "before columns and rows", false},
    {"ssd1322", "15|1C 1C;75|00 00;A0|14 11;5C;+00", "before columns and rows", false},
    {"ssd1322", "15|1C 1C;75|00 00;5C;+00 00;A6;+00", "belong to no command", false},
    {"ssd1322", "15|1C 1C;75|00 00;5C;+00 00 00;A6", "cuts data after 1 of 2 bytes", false},
    {"ssd1351", "15|00 00;75|00 00;+00", "belong to no command", false},
    {"ssd1351", "15|00 00;75|00 00;A0|66;5C;+00", "before columns and rows", false},
    {"ssd1351", "15|00 00;75|00 00;5C;+00;5C", "cuts data after 1 of 2 bytes", false},
    /* commands */
    {"ssd1306-128x64", "80", "unknown command 80h", false},
    {"ssd1306-128x64", "C1", "unknown command C1h", false},
    {"ssd1306-128x64", "5C", NULL, false}, /* start line 28 */
    {"ssd1306-128x64", "2F", "2Fh is not modelled", false},
    {"ssd1306-128x64", "B0", "B0h is not for addressing mode 0", false},
    {"ssd1306-128x64", "05", "05h is not for addressing mode 0", false},
    {"ssd1306-128x64", "20 02;21 00 7F", "21h is not for addressing mode 2", false},
    {"ssd1306-128x64", "22 00 07", "22h is not for addressing mode 2", true},
    {"ssd1306-128x64", "20 03", "addressing mode (20h) is 3", false},
    {"sh1106", "20", "unknown command 20h", false},
    {"sh1106", "8D", "unknown command 8Dh", false},
    {"sh1106", "E0", "E0h is not modelled", false},
    {"ssd1322", "81", "unknown command 81h", false},
    {"ssd1322", "A8|00 3F", "A8h is not modelled", false},
    {"ssd0323", "FD", "unknown command FDh", false},
    {"ssd0323", "23", "23h is not modelled", false},
    {"ssd0323", "B0 28;B4 02", NULL, false},
    {"ssd1351", "81", "unknown command 81h", false},
    {"ssd1351", "9F", "9Fh is not modelled", false},
    {"ssd1351", "5D", "5Dh is not modelled", false},
    /* values */
    {"ssd1306-128x64", "8D 00", "charge pump (8Dh) is 0", false},
    {"ssd1306-128x64", "A8 0E", "multiplex ratio (A8h) is 14", false},
    {"ssd1306-128x64", "D3 40", "display offset (D3h) is 64", false},
    {"ssd1306-128x64", "D9 F0", "phase 1 (D9h) is 0", false},
    {"ssd1306-128x64", "DA 32", "32h is not modelled", false},
    {"sh1106", "AD 14", "charge pump (ADh) is 20", false},
    {"ssd1322", "A0|08 11", "reserved bits", false},
    {"ssd1322", "A0|06 10", "reserved bits", false},
    {"ssd1322", "A0|26 11", "commons in pairs", false},
    {"ssd1322", "CA|7F;A0|06 11", "commons in pairs", false},
    {"ssd1322", "C7|10", "master current (C7h) is 16", false},
    {"ssd1322", "CA|0E", "multiplex ratio (CAh) is 14", false},
    {"ssd0323", "A0 08", "reserved bits", false},
    {"ssd0323", "A2 50", "display offset (A2h) is 80", false},
    {"ssd0323", "81 80", "contrast (81h) is 128", false},
    {"ssd1351", "A0|7C", "reserved bit", false},
    {"ssd1351", "A0|B4", "only 65k colours", false},
    {"ssd1351", "CA|80", "multiplex ratio (CAh) is 128", false},
    /* locks */
    {"ssd1351", "A2|00", "A2h is locked until FDh B1h", true},
    {"ssd1351", "B1|32", "B1h is locked", true},
    {"ssd1351", "B3|F1", "B3h is locked", true},
    {"ssd1351", "BB|17", "BBh is locked", true},
    {"ssd1351", "BE|05", "BEh is locked", true},
    {"ssd1351", "C1|C8 80 C8", "C1h is locked", true},
    {"ssd1351", "FD|B1;C1|C8 80 C8", NULL, true},
    {"ssd1351", "FD|B0;C1|C8 80 C8", "C1h is locked", false},
    {"ssd1351", "FD|16;AF", "AFh while commands are locked", false},
    {"ssd1351", "15|00 00;75|00 00;5C;FD|16;+00", "data while commands are locked", false},
    {"ssd1351", "FD|16;FD|12;AF", NULL, false},
    {"ssd1351", "FD|00", "command lock (FDh) knows no 00h", false},
    {"ssd1322", "FD|16;AF", "AFh while commands are locked", false},
    {"ssd1322", "FD|16;FD|12;AF", NULL, false},
    {"ssd1322", "FD|B1", "command lock (FDh) knows no B1h", false},
    /* the reset line */
    {"ssd1306-128x64", "R0;R1", "reset was held for 0 ns; it takes 3 us", false},
    {"sh1106", "R0;R1", "reset was held for 0 ns; it takes 10 us", false},
    {"ssd1322", "R0;@1;AE", "traffic while reset is held", false},
    {"ssd0323", "R0;@1;R1;AE", "too early after a reset", false},
    {"ssd1351", "R0;@1;R1;@1;FD|12", NULL, false},
    {"ssd1351", "R0;@1;R1;@1;A2|00", "locked", false}, /* a reset locks again */
    {"ssd1322", "15|1C 1C;75|00 00;R0;@1;R1;@1;5C;+00", "before columns and rows", false},
    {"ssd1322", "A0|06;R0;@1;R1;@1;AE", NULL, false},          /* and ends what was under way */
    {"ssd1306-128x64", "80;AE", "unknown command 80h", false}, /* the first fault stays */
};

static void illegal_traffic(void **state) {
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(illegal_cases); i++) {
        const illegal_t *c = &illegal_cases[i];
        board_t board;

        open_chip(&board, c->panel, c->raw);
        int result = play(&board, c->script);
        if (!c->fault) {
            if (board.chip->fault.text[0]) { fail_msg("%s: %s", c->script, board.chip->fault.text); }
            assert_int_equal(result, 0);
        } else {
            if (result == 0) { result = play(&board, "@0;AE"); } /* what the reset line does is told at the next traffic */
            assert_int_equal(result, TUILE_HAL_PROTOCOL);
            if (!strstr(board.chip->fault.text, c->fault)) { fail_msg("%s: \"%s\"", c->script, board.chip->fault.text); }
            assert_null(strchr(board.chip->fault.text, '\n'));
            assert_string_equal(board.bus.error.text, board.chip->fault.text);
            assert_int_equal(play(&board, "AE"), TUILE_HAL_PROTOCOL); /* nothing more is taken */
        }
        board_close(&board);
    }
}

static void nothing_can_be_read(void **state) {
    static const char *const names[] = {"ssd1306-128x64", "sh1106", "ssd1322", "ssd0323", "ssd1351"};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(names); i++) {
        board_t board;
        uint8_t byte;

        open_chip(&board, names[i], false);
        assert_int_equal(board.bus.bus.read(&board.bus, 0x5D, &byte, 1), TUILE_HAL_PROTOCOL);
        assert_non_null(strstr(board.chip->fault.text, "reading 5Dh"));
        board_close(&board);
    }
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(ssd1306_addressing),
        cmocka_unit_test(sh1106_addressing),
        cmocka_unit_test(ssd1322_halves_of_bytes),
        cmocka_unit_test(ssd1322_pointer),
        cmocka_unit_test(ssd0323_halves_of_bytes_and_pointer),
        cmocka_unit_test(ssd1351_pointer),
        cmocka_unit_test(memory_comes_to_the_glass),
        cmocka_unit_test(values_come_to_the_glass),
        cmocka_unit_test(memory_holds_noise_after_power_up),
        cmocka_unit_test(ssd1306_without_its_pump_is_dark),
        cmocka_unit_test(a_clock_beyond_the_data_sheets_is_a_warning),
        cmocka_unit_test(illegal_traffic),
        cmocka_unit_test(nothing_can_be_read),
    };
    return cmocka_run_group_tests_name("OLED chips", tests, NULL, NULL);
}
