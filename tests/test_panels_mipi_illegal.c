/* What each chip of the MIPI DCS family refuses, and what it takes although it looks odd: from the data sheets, a line a case. The
 * ILI9341 is in test_panel_chip.c. */
#include "support/check.h"

#include "support/board.h"
#include "support/wire_script.h"

typedef struct illegal {
    const char *panel, *name, *script;
    const char *fault; /* part of the one line; NULL: legal after all */
    bool raw;          /* the chip has just been powered */
} illegal_t;

#define DOCA "E8:40 8A 00 00 29 19 A5 33"
#define GAMMA "F0:45 09 08 08 26 2A"

static const illegal_t illegal_cases[] = {
    {"st7789-240x320", "12 bits a pixel are legal", "3A:53 ;2C ;+12 34 56 ;13", NULL, false},
    {"st7789-240x320", "an odd one of them is legal", "3A:53 ;2C ;+12 34 56 78 9A ;13", NULL, false},
    {"st7789-240x320", "half of one is not", "3A:53 ;2C ;+12 ;13", "cuts a pixel after 1 of its 2 bytes", false},
    {"st7789-240x320", "half of the third is not", "3A:53 ;2C ;+12 34 56 78 ;13", "cuts a pixel after 1 of its 2 bytes", false},
    {"st7789-240x320", "16-bit pixel cut", "2C ;+12 34 56 ;13", "cuts a pixel after 1 of its 2 bytes", false},
    {"st7789-240x320", "24 bits a pixel", "3A:77", "pixel format 77h is reserved", false},
    {"st7789-240x320", "12 bits at the RGB interface", "3A:35", "pixel format 35h is reserved", false},
    {"st7789-240x320", "bit 7 of the pixel format", "3A:D5", "pixel format D5h is reserved", false},
    {"st7789-240x320", "bit 3 of the pixel format", "3A:5D", "pixel format 5Dh is reserved", false},
    {"st7789-240x320", "16 bits expanded in another way", "B0:00 F0 ;2C", "EPF = 3", false},
    {"st7789-240x320", "18 bits have nothing to expand", "B0:00 F0 ;3A:66 ;2C ;+00 00 00 ;13", NULL, false},
    {"st7789-240x320", "it is the other way after a software reset", "01 ;@120 ;11 ;@5 ;3A:55 ;2C", "EPF = 3", false},
    {"st7789-240x320", "and after a reset", "R0 ;@1 ;R1 ;@120 ;11 ;@5 ;3A:55 ;2C", "EPF = 3", false},
    {"st7789-240x320", "low byte first of 12 bits", "B0:00 C8 ;3A:53 ;2C", "low byte first (B0h) with 12 bits", false},
    {"st7789-240x320", "low byte first of 18 bits", "B0:00 C8 ;3A:66 ;2C", "low byte first (B0h) with 18 bits", false},
    {"st7789-240x320", "memory by the RGB interface", "B0:11 C0", "B0h with parameter 1 = 11h is not modelled", false},
    {"st7789-240x320", "other transfers of pixels", "B0:00 C1", "B0h with parameter 2 = C1h is not modelled", false},
    {"st7789-240x320", "MADCTL turned about", "C0:0C", "C0h with parameter 1 = 0Ch is not modelled", false},
    {"st7789-240x320", "MADCTL as at reset", "C0:2C", NULL, false},
    {"st7789-240x320", "gates from the other end", "E4:27 00 11", "E4h with parameter 3 = 11h is not modelled", false},
    {"st7789-240x320", "NV memory is not to be burnt", "FA:5A 69 EE 04", "unknown command FAh", false},
    {"st7789-240x320", "too few parameters", "E0:D0 00 ;13", "E0h takes 14 parameters and got 2", false},
    {"st7789-240x320", "too many parameters", "B2:0C 0C 00 33 33 33", "B2h takes 5 parameters and got more", false},
    {"st7789-240x320", "parameters with D/C low", "2A ;00 ;00 ;00 ;EF", "2Ah takes 4 parameters and got 0", false},
    {"st7789-240x320", "data before memory write", "2A:00 00 00 EF ;+00 00", "2Ah takes 4 parameters and got more", false},
    {"st7789-240x320", "data after another command", "2C ;+00 00 ;13 ;+00 00", "belong to no command", false},
    {"st7789-240x320", "columns beyond the memory", "2A:00 00 00 F0", "columns from 0 to 240: the last is 239", false},
    {"st7789-240x320", "rows beyond the memory", "2B:00 00 01 40", "rows from 0 to 320: the last is 319", false},
    {"st7789-240x320", "exchanged: columns to 319 are legal", "36:60 ;2A:00 00 01 3F ;2B:00 00 00 EF ;2C", NULL, false},
    {"st7789-240x320", "exchanged: rows to 240 are not", "36:60 ;2B:00 00 00 F0", "rows from 0 to 240: the last is 239", false},
    {"st7789-240x320", "command 4 ms after sleep in", "10 ;@4 ;13", "too early after sleep in; it takes 5 ms", false},
    {"st7789-240x320", "command 5 ms after sleep in is legal", "10 ;@5 ;13", NULL, false},
    {"st7789-240x320", "sleep out 119 ms after sleep in", "10 ;@119 ;11", "sleep out", false},
    {"st7789-240x320", "a reset of 0 us", "R0 ;R1 ;@120 ;13", "it takes 10 us", false},
    {"st7735-128x160", "NOP is legal", "00", NULL, false},
    {"st7735-128x160", "command 119 ms after sleep in", "10 ;@119 ;13", "too early after sleep in; it takes 120 ms", false},
    {"st7735-128x160", "command 120 ms after sleep in is legal", "10 ;@120 ;13", NULL, false},
    {"st7735-128x160", "command 119 ms after power on", "@119 ;13", "too early after a reset; it takes 120 ms", true},
    {"st7735-128x160", "command 119 ms after sleep out", "@120 ;11 ;@119 ;29", "too early after sleep out; it takes 120 ms", true},
    {"st7735-128x160", "commands after 120 ms are legal", "@120 ;11 ;@120 ;29", NULL, true},
    {"st7735-128x160", "24 bits a pixel", "3A:07", "pixel format 07h is reserved", false},
    {"st7735-128x160", "the upper half of the pixel format does not matter", "3A:36 ;2C ;+00 00 00 ;13", NULL, false},
    {"st7735-128x160", "columns beyond 128", "2A:00 00 00 80", "columns from 0 to 128: the last is 127", false},
    {"st7735-128x160", "rows beyond 160", "2B:00 00 00 A0", "rows from 0 to 160: the last is 159", false},
    {"st7735-128x160-green", "132 columns are legal", "2A:00 00 00 83", NULL, false},
    {"st7735-128x160-green", "columns beyond 132", "2A:00 00 00 84", "columns from 0 to 132: the last is 131", false},
    {"st7735-128x160-green", "162 rows are legal", "2B:00 00 00 A1", NULL, false},
    {"st7735-128x160-green", "rows beyond 162", "2B:00 00 00 A2", "rows from 0 to 162: the last is 161", false},
    {"st7735-128x128", "rows beyond 132", "2B:00 00 00 84", "rows from 0 to 132: the last is 131", false},
    {"st7735-80x160-0", "columns beyond 128", "2A:00 00 00 80", "columns from 0 to 128: the last is 127", false},
    {"st7735-128x160", "colour table", "2D", "not modelled", false},
    {"st7735-128x160", "NV memory is not to be burnt", "D1:00", "unknown command D1h", false},
    {"st7735-128x160", "too few parameters", "B3:01 2C 2D ;13", "B3h takes 6 parameters and got 3", false},
    {"st7735-128x160", "too many parameters", "C5:0E 00", "C5h takes 1 parameters and got more", false},
    {"st7735-128x160", "data before memory write", "13 ;+00 00", "belong to no command", false},
    {"gc9a01", "NOP", "00", "NOP disturbs", false},
    {"gc9a01", "inner registers before they are enabled", "@5 ;" GAMMA, "F0h before its command set was enabled", true},
    {"gc9a01", "inner registers, enabled, are legal", "@5 ;FE ;EF ;" GAMMA, NULL, true},
    {"gc9a01", "enabled in the wrong order", "@5 ;EF ;FE ;" GAMMA, "F0h before its command set was enabled", true},
    {"gc9a01", "not enabled right after one another", "@5 ;FE ;13 ;EF ;" GAMMA, "F0h before its command set was enabled", true},
    {"gc9a01", "a software reset closes them", "01 ;@120 ;" GAMMA, "F0h before its command set was enabled", false},
    {"gc9a01", "exchanged: columns first", "36:28 ;2A:00 00 00 EF", "not right after rows", false},
    {"gc9a01", "exchanged: columns later", "36:28 ;2B:00 00 00 EF ;13 ;2A:00 00 00 EF", "not right after rows", false},
    {"gc9a01", "exchanged: rows first is legal", "36:28 ;2B:00 00 00 EF ;2A:00 00 00 EF ;2B:00 00 00 EF ;2C", NULL, false},
    {"gc9a01", "not exchanged: columns first is legal", "36:88 ;2A:00 00 00 EF", NULL, false},
    {"gc9a01", "rows beyond the memory", "2B:00 00 00 F0", "rows from 0 to 240: the last is 239", false},
    {"gc9a01", "sources from the other end", "B6:00 20", "B6h with parameter 2 = 20h is not modelled", false},
    {"gc9a01", "24 bits a pixel", "3A:77", "pixel format 77h is reserved", false},
    {"gc9a01", "too few parameters", "66:3C 00 ;13", "66h takes 10 parameters and got 2", false},
    {"gc9a01", "data before memory write", "13 ;+00 00", "belong to no command", false},
    {"ili9488", "16 bits a pixel", "3A:55", "pixel format 55h is reserved, or not one of the serial interface's", false},
    {"ili9488", "16 bits a pixel beside 18 of the RGB interface", "3A:65", "pixel format 65h", false},
    {"ili9488", "24 bits a pixel", "3A:77", "pixel format 77h", false},
    {"ili9488", "12 bits a pixel", "3A:63", "pixel format 63h", false},
    {"ili9488", "3 bits a pixel are legal", "3A:61 ;2C ;+12 ;13", NULL, false},
    {"ili9488", "18-bit pixel cut", "2C ;+01 02 ;13", "cuts a pixel after 2 of its 3 bytes", false},
    {"ili9488", "480 rows are legal", "2B:00 00 01 DF", NULL, false},
    {"ili9488", "rows beyond the memory", "2B:00 00 01 E0", "rows from 0 to 480: the last is 479", false},
    {"ili9488", "columns beyond the memory", "2A:00 00 01 40", "columns from 0 to 320: the last is 319", false},
    {"ili9488", "320 lines", "B6:02 02 27", "B6h with parameter 3 = 27h is not modelled", false},
    {"ili9488", "memory by the RGB interface", "B6:22 02 3B", "B6h with parameter 1 = 22h is not modelled", false},
    {"ili9488", "too few parameters", "B1:A0 ;13", "B1h takes 2 parameters and got 1", false},
    {"ili9488", "idle mode", "39", "not modelled", false},
    {"ili9488", "data before memory write", "13 ;+00 00 00", "belong to no command", false},
    {"st7796", "table 2 is closed", DOCA, "E8h before its command set was enabled", false},
    {"st7796", "half open", "F0:C3 ;" DOCA, "E8h before its command set was enabled", false},
    {"st7796", "the other half open", "F0:96 ;" DOCA, "E8h before its command set was enabled", false},
    {"st7796", "open is legal", "F0:C3 ;F0:96 ;" DOCA, NULL, false},
    {"st7796", "half closed", "F0:C3 ;F0:96 ;F0:3C ;" DOCA, "E8h before its command set was enabled", false},
    {"st7796", "the other half closed", "F0:C3 ;F0:96 ;F0:69 ;" DOCA, "E8h before its command set was enabled", false},
    {"st7796", "a key of two parameters", "F0:C3 96", "F0h takes 1 parameters and got more", false},
    {"st7796", "12 bits a pixel", "3A:53", "pixel format 53h", false},
    {"st7796", "rows beyond the memory", "2B:00 00 01 E0", "rows from 0 to 480: the last is 479", false},
    {"st7796", "data before memory write", "13 ;+00 00", "belong to no command", false},
};

static void test_illegal(void **state) {
    const illegal_t *c = *state;
    const sim_panel_t *panel = sim_panel_find(c->panel);
    board_t board;
    int result;

    assert_non_null(panel);
    board_open_panel(&board, panel, &(sim_bus_config_t){.blocking = true});
    if (!c->raw) { assert_int_equal(board_start(&board, 0, TUILE_WIRE_DEFAULT), 0); }
    result = wire_play(&board, c->script);
    if (!c->fault) {
        assert_string_equal(board.chip->fault.text, "");
        assert_int_equal(result, 0);
    } else {
        assert_int_equal(result, TUILE_HAL_PROTOCOL);
        if (!strstr(board.chip->fault.text, c->fault)) { fail_msg("\"%s\" has no \"%s\"", board.chip->fault.text, c->fault); }
        assert_null(strchr(board.chip->fault.text, '\n'));
    }
    board_close(&board);
}

int main(void) {
    enum { ILLEGAL_COUNT = CHECK_COUNT(illegal_cases) };
    static char names[ILLEGAL_COUNT][96];
    struct CMUnitTest tests[ILLEGAL_COUNT];

    for (size_t i = 0; i < ILLEGAL_COUNT; i++) {
        snprintf(names[i], sizeof names[i], "%s: %s", illegal_cases[i].panel, illegal_cases[i].name);
        tests[i] =
            (struct CMUnitTest){.name = names[i], .test_func = test_illegal, .initial_state = (void *)(uintptr_t)&illegal_cases[i]};
    }
    return cmocka_run_group_tests_name("illegal traffic of the MIPI DCS family", tests, NULL, NULL);
}
