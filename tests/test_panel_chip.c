/* The simulated ILI9341: what it shows of the picture at each rotation, what its memory holds, and the illegal traffic that it
 * reports.
 *
 * Bytes and numbers that are expected come from the data sheet and from hand, never from the code under test. */
#include "support/check.h"

#include "../hal/display.h"
#include "../hal/panels/ili9341.h"
#include "../sim/bus.h"
#include "../sim/chips/ili9341.h"
#include "support/board.h"
#include "support/wire_script.h"

/* ---- the picture ------------------------------------------------------------------------------------------------ */

static void test_rotations_through_window_splits(void **state) {
    static const uint32_t splits[][2] = {{320, 320}, {320, 16}, {64, 48}, {37, 41}, {1, 320}};

    (void)state;
    for (uint8_t rotation = 0; rotation < 4; rotation++) {
        for (unsigned long_pixels = 0; long_pixels < 2; long_pixels++) {
            const uint8_t wire = long_pixels ? TUILE_WIRE_RGB666 : TUILE_WIRE_RGB565;
            for (size_t i = 0; i < sizeof splits / sizeof splits[0]; i++) {
                board_t board;
                board_open(&board, &(sim_bus_config_t){.max_chunk_bytes = i == 2 ? 4095 : 0});
                assert_int_equal(board_start(&board, rotation, wire), 0);
                assert_int_equal(board_draw(&board.display, wire, splits[i][0], splits[i][1]), 0);
                board_check_clean(&board);
                board_check_picture(&board, rotation, wire);
                board_check_glass(&board, rotation, wire);
                board_close(&board);
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
        board_open(&board, NULL);
        assert_int_equal(board_start(&board, rotation, TUILE_WIRE_RGB565), 0);
        assert_int_equal(tuile_display_window(&board.display, 0, 0, 2, 1), 0);
        assert_int_equal(tuile_display_write(&board.display, pixels, 4), 0);
        assert_int_equal(tuile_display_present(&board.display), 0);
        assert_int_equal(sim_dcs_memory(board.chip, where[rotation][0][0], where[rotation][0][1]), 0x3F000);
        assert_int_equal(sim_dcs_memory(board.chip, where[rotation][1][0], where[rotation][1][1]), 0x00FC0);
        board_close(&board);
    }
}

static void test_colours_seen(void **state) {
    static const uint8_t pixels[8] = {0xF8, 0x00, 0x07, 0xE0, 0x00, 0x1F, 0x84, 0x10};
    static const uint8_t expected[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {0x86, 0x82, 0x86}};
    static const uint8_t inversion[] = {0x21};
    board_t board;
    sim_picture_t seen;

    (void)state;
    board_open(&board, NULL);
    board_start(&board, 0, TUILE_WIRE_RGB565);
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
    board_check_clean(&board);
    board_close(&board);
}

/* B6h reverses the scan of gates (GS, 40h) and sources (SS, 20h). The module's row 0 is at the bottom without GS, its column 0 at
 * the left without SS; its filter is blue first from S1 on, so that from S720 on it is red first, which wants MADCTL without BGR.
 */
static void test_scan_directions(void **state) {
    static const struct {
        const char *script;
        uint32_t x, y;
    } cases[] = {
        {"B6:08 C2 27 ;36:08", 0, 0}, /* as the driver has it: C2h is GS and a normally white glass */
        {"B6:08 82 27 ;36:08", 0, 319},
        {"B6:08 E2 27 ;36:00", 239, 0},
        {"B6:08 A2 27 ;36:00", 239, 319},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        board_t board;
        sim_picture_t glass;
        board_open(&board, &(sim_bus_config_t){.blocking = true});
        assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
        assert_int_equal(tuile_display_present(&board.display), 0);
        assert_int_equal(wire_play(&board, cases[i].script), 0);
        assert_int_equal(wire_play(&board, "2A:00 00 00 00 ;2B:00 00 00 00 ;2C ;+F8 00"), 0);
        board_check_clean(&board);
        assert_int_equal(board.chip->glass(board.chip, &glass, NULL), 0);
        assert_memory_equal(sim_picture_at(&glass, cases[i].x, cases[i].y), "\xFF\0\0", 3);
        sim_picture_free(&glass);
        board_close(&board);
    }
}

/* ---- pixels past the end of the window, and continued ones ------------------------------------------------------ */

static void test_write_wraps_in_window_and_continues(void **state) {
    static const uint8_t column[] = {0x2A, 0, 10, 0, 11}, row[] = {0x2B, 0, 20, 0, 21}, write[] = {0x2C}, more[] = {0x3C};
    static const uint8_t five[] = {0, 1, 0, 2, 0, 3, 0, 4, 0, 5}, one[] = {0, 6};
    board_t board;
    tuile_bus_t *bus;

    (void)state;
    board_open(&board, &(sim_bus_config_t){.blocking = true});
    board_start(&board, 0, TUILE_WIRE_RGB565);
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
    board_check_clean(&board);
    board_close(&board);
}

/* With WEMODE = 0 (F6h) what exceeds the window is dropped. */
static void test_write_stops_at_the_window(void **state) {
    static const uint8_t interface[] = {0xF6, 0, 0, 0}, column[] = {0x2A, 0, 10, 0, 10}, row[] = {0x2B, 0, 20, 0, 20},
                         write[] = {0x2C};
    static const uint8_t two[] = {0, 1, 0, 2};
    board_t board;
    tuile_bus_t *bus;

    (void)state;
    board_open(&board, &(sim_bus_config_t){.blocking = true});
    board_start(&board, 0, TUILE_WIRE_RGB565);
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
    board_check_clean(&board);
    board_close(&board);
}

/* ---- legal traffic, and misuse of the bus ----------------------------------------------------------------------- */

static void test_sleep_is_legal_traffic(void **state) {
    (void)state;
    for (unsigned pins = 0; pins < 2; pins++) {
        board_t board;
        board_open(&board, &(sim_bus_config_t){.no_reset_pin = pins == 0});
        assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
        assert_int_equal(board_draw(&board.display, TUILE_WIRE_RGB565, 240, 32), 0);
        assert_int_equal(tuile_display_sleep(&board.display), 0);
        assert_int_equal(tuile_display_resume(&board.display), 0);
        assert_int_equal(board_draw(&board.display, TUILE_WIRE_RGB565, 240, 32), 0);
        board_check_clean(&board);
        board_check_picture(&board, 0, TUILE_WIRE_RGB565);
        board_close(&board);
    }
}

static void test_reading(void **state) {
    board_t board;
    uint8_t id[3], byte;
    tuile_bus_t *bus;

    (void)state;
    board_open(&board, NULL);
    board_start(&board, 3, TUILE_WIRE_RGB565);
    bus = &board.bus.bus;
    assert_int_equal(bus->read(bus->context, 0xD3, id, 3), 0);
    assert_memory_equal(id, "\x00\x93\x41", 3);
    assert_int_equal(bus->read(bus->context, 0x0B, &byte, 1), 0);
    assert_int_equal(byte, 0xA8);
    assert_int_equal(bus->read(bus->context, 0x0C, &byte, 1), 0);
    assert_int_equal(byte, 0x55);
    assert_int_equal(bus->read(bus->context, 0x0A, &byte, 1), 0);
    assert_int_equal(byte, 0x98); /* booster, sleep out, normal mode */
    assert_int_equal(tuile_display_present(&board.display), 0);
    assert_int_equal(bus->read(bus->context, 0x0A, &byte, 1), 0);
    assert_int_equal(byte, 0x9C); /* and display on, with the first frame */
    assert_int_equal(bus->read(bus->context, 0x2E, &byte, 1), TUILE_HAL_PROTOCOL);
    board_close(&board);
}

static void test_misuse_of_the_bus(void **state) {
    static const uint8_t nop[] = {0x00}, write[] = {0x2C}, pixels[4] = {0};
    board_t board;
    tuile_bus_t *bus;

    (void)state;
    board_open(&board, &(sim_bus_config_t){.max_chunk_bytes = 64});
    board_start(&board, 0, TUILE_WIRE_RGB565);
    bus = &board.bus.bus;
    bus->command(bus->context, write, 1, 1);
    assert_int_equal(bus->data(bus->context, pixels, 65), TUILE_HAL_STATE);
    assert_int_equal(bus->data(bus->context, pixels, 4), 0);
    assert_int_equal(bus->data(bus->context, pixels, 4), TUILE_HAL_STATE);
    assert_int_equal(bus->command(bus->context, nop, 1, 1), TUILE_HAL_STATE);
    assert_int_equal(bus->wait(bus->context), 0);
    assert_int_equal(bus->command(bus->context, nop, 1, 1), 0);
    assert_non_null(strstr(board.bus.error.text, "larger than the bus takes"));
    board_close(&board);
}

/* ---- illegal traffic -------------------------------------------------------------------------------------------- */

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

    board_open(&board, &(sim_bus_config_t){.blocking = true});
    if (!c->raw) { assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0); }
    result = wire_play(&board, c->script);
    if (!c->fault) {
        assert_string_equal(board.chip->fault.text, "");
        assert_int_equal(result, 0);
    } else {
        assert_int_equal(result, TUILE_HAL_PROTOCOL);
        if (!strstr(board.chip->fault.text, c->fault)) { fail_msg("\"%s\" has no \"%s\"", board.chip->fault.text, c->fault); }
        assert_null(strchr(board.chip->fault.text, '\n'));
        assert_string_equal(board.bus.error.text, board.chip->fault.text);
        /* Sticky: nothing more is taken. */
        assert_int_equal(wire_play(&board, "00"), TUILE_HAL_PROTOCOL);
    }
    board_close(&board);
}

#define ILLEGAL_COUNT (sizeof illegal_cases / sizeof illegal_cases[0])

int main(void) {
    static const struct CMUnitTest plain[] = {
        cmocka_unit_test(test_rotations_through_window_splits),
        cmocka_unit_test(test_memory_by_hand),
        cmocka_unit_test(test_colours_seen),
        cmocka_unit_test(test_scan_directions),
        cmocka_unit_test(test_write_wraps_in_window_and_continues),
        cmocka_unit_test(test_write_stops_at_the_window),
        cmocka_unit_test(test_sleep_is_legal_traffic),
        cmocka_unit_test(test_reading),
        cmocka_unit_test(test_misuse_of_the_bus),
    };
    enum { PLAIN_COUNT = sizeof plain / sizeof plain[0] };
    struct CMUnitTest tests[PLAIN_COUNT + ILLEGAL_COUNT];

    memcpy(tests, plain, sizeof plain);
    for (size_t i = 0; i < ILLEGAL_COUNT; i++) {
        tests[PLAIN_COUNT + i] = (struct CMUnitTest){
            .name = illegal_cases[i].name, .test_func = test_illegal, .initial_state = (void *)(uintptr_t)&illegal_cases[i]};
    }
    return cmocka_run_group_tests_name("panel chip", tests, NULL, NULL);
}
