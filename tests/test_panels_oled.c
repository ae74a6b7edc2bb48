/* OLED panels: the bytes that start each and tell it a window, and the picture in every rotation, through windows of any kind and
 * faults at every transfer, looked at on models of the chips.
 *
 * Bytes that are expected are from the data sheets and typed by hand. */
#include "support/board.h"
#include "support/check.h"
#include "support/frame.h"
#include "support/recorder.h"
#include "support/stage.h"

#include "../firmware/stream.h"
#include "../sim/chips/oled.h"

static const char *const names[] = {"ssd1351", "ssd1351-128x96", "ssd1306-128x64", "ssd1306-128x32",
                                    "sh1106",  "ssd1322",        "ssd0323"};

static const tuile_panel_t *panel_of(const char *name) {
    const sim_panel_t *found = sim_panel_find(name);

    assert_non_null(found);
    return found->panel;
}

static void open_named(board_t *board, const char *name, const sim_bus_config_t *config) {
    const sim_panel_t *found = sim_panel_find(name);

    assert_non_null(found);
    board_open_panel(board, found, config);
}

/* ---- bytes ------------------------------------------------------------------------------------------------------ */

#define RESET "backlight 0\nreset 1\nreset 0\ndelay 1\nreset 1\ndelay 10\n"
#define SSD1351(mux)                                                                                                         \
    RESET "FD|12\nFD|B1\nAE\nB3|F1\nCA|" mux "\nA1|00\nA2|00\nB5|00\nAB|01\nB1|32\nB4|A0 B5 55\nBB|17\nBE|05\nC1|C8 80 C8\n" \
          "C7|0F\nB6|01\nA6\n"
#define SSD1306(mux, wiring) RESET "AE\nD5 80\nA8 " mux "\nD3 00\n40\n8D 14\n20 00\nDA " wiring "\n81 CF\nD9 F1\nDB 40\nA4\nA6\n"
#define SH1106 RESET "AE\nD5 80\nA8 3F\nD3 00\n40\nAD 8B\n32\nDA 12\n81 CF\nD9 22\nDB 35\nA4\nA6\n"
#define SSD1322                                                                                                              \
    RESET "FD|12\nAE\nB3|91\nCA|3F\nA2|00\nA1|00\nAB|01\nB4|A0 FD\nC1|9F\nC7|0F\nB9\nB1|E2\nD1|A2 20\nBB|1F\nB6|08\nBE|07\n" \
          "A9\nA6\n"
#define SSD0323 \
    RESET "AE\nB3 91\nA8 3F\nA1 00\nAD 02\n86\nB8 01 11 22 32 43 54 65 76\n81 70\nB2 51\nB1 55\nBC 10\nBE 1C\nBF 0F\nA4\n"

/* What comes last is the rotation. */
static const struct {
    const char *name, *start, *turn[4];
} starts[] = {
    {"ssd1351", SSD1351("7F"), {"A0|74\n", "A0|77\n", "A0|66\n", "A0|65\n"}},
    {"ssd1351-128x96", SSD1351("5F"), {"A0|74\n", "A0|77\n", "A0|66\n", "A0|65\n"}},
    {"ssd1306-128x64", SSD1306("3F", "12"), {"A1\nC8\n", "A0\nC8\n", "A0\nC0\n", "A1\nC0\n"}},
    {"ssd1306-128x32", SSD1306("1F", "02"), {"A1\nC8\n", "A0\nC8\n", "A0\nC0\n", "A1\nC0\n"}},
    {"sh1106", SH1106, {"A1\nC8\n", "A0\nC8\n", "A0\nC0\n", "A1\nC0\n"}},
    {"ssd1322", SSD1322, {"A0|06 11\n", "A0|04 11\n", "A0|14 11\n", "A0|16 11\n"}},
    {"ssd0323", SSD0323, {"A0 52\nA2 40\n", "A0 51\nA2 40\n", "A0 41\nA2 00\n", "A0 42\nA2 00\n"}},
};

static void each_panel_is_started_by_its_bytes(void **state) {
    (void)state;
    assert_int_equal(CHECK_COUNT(starts), CHECK_COUNT(names));
    for (size_t i = 0; i < CHECK_COUNT(starts); i++) {
        for (uint8_t rotation = 0; rotation < 4; rotation++) {
            recorder_t recorder;
            tuile_bus_t bus = recorder_bus(&recorder);
            tuile_display_t display;
            char expected[1024];
            const tuile_display_config_t config = {.bus = &bus, .panel = panel_of(starts[i].name), .rotation = rotation};

            (void)snprintf(expected, sizeof expected, "%s%s", starts[i].start, starts[i].turn[rotation]);
            assert_int_equal(tuile_display_init(&display, &config), 0);
            assert_string_equal(recorder.log, expected);
        }
    }
}

/* A window of 8 x 16 at (16, 8), its bytes, the end of the first frame, and sleep. Backlight lines are left out. */
static const struct {
    const char *name;
    const char *window[4];
    const char *on, *sleep;
} windows[] = {
    /* 128 columns from the left or the right; at a quarter turn x is a row */
    {"ssd1351",
     {"15|10 17\n75|08 17\n5C\ndata 256: 00\n", "15|08 17\n75|10 17\n5C\ndata 256: 00\n", "15|10 17\n75|08 17\n5C\ndata 256: 00\n",
      "15|08 17\n75|10 17\n5C\ndata 256: 00\n"},
     "AF\nC7|0F\n",
     "AE\n"},
    {"ssd1306-128x64",
     {"21 10 17\n22 01 02\ndata 16: 00\n", "21 08 17\n22 02 02\ndata 16: 00\n", "21 10 17\n22 01 02\ndata 16: 00\n",
      "21 08 17\n22 02 02\ndata 16: 00\n"},
     "AF\n81 CF\n",
     "AE\n8D 10\n"},
    /* columns 18 = 1, 2 and 10 = 0, A; a page each time */
    {"sh1106",
     {"B1 11 02\ndata 8: 00\nwait\nB2 11 02\ndata 8: 00\n", "B2 10 0A\ndata 16: 00\n",
      "B1 11 02\ndata 8: 00\nwait\nB2 11 02\ndata 8: 00\n", "B2 10 0A\ndata 16: 00\n"},
     "AF\n81 CF\n",
     "AE\n"},
    /* (112 + 16) / 4 = 20h, (112 + 8) / 4 = 1Eh ... (112 + 20) / 4 = 21h */
    {"ssd1322",
     {"15|20 21\n75|08 17\n5C\ndata 64: 00\n", "15|1E 21\n75|10 17\n5C\ndata 64: 00\n", "15|20 21\n75|08 17\n5C\ndata 64: 00\n",
      "15|1E 21\n75|10 17\n5C\ndata 64: 00\n"},
     "AF\nC1|9F\n",
     "AE\n"},
    {"ssd0323",
     {"15 08 0B\n75 08 17\ndata 64: 00\n", "15 04 0B\n75 10 17\ndata 64: 00\n", "15 08 0B\n75 08 17\ndata 64: 00\n",
      "15 04 0B\n75 10 17\ndata 64: 00\n"},
     "AF\n81 70\n",
     "AE\n"},
};

static void a_window_is_told_in_the_panels_own_numbers(void **state) {
    static const uint8_t zeros[256];
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(windows); i++) {
        for (uint8_t rotation = 0; rotation < 4; rotation++) {
            recorder_t recorder;
            tuile_bus_t bus = recorder_bus(&recorder);
            tuile_display_t display;
            const tuile_display_config_t config = {.bus = &bus, .panel = panel_of(windows[i].name), .rotation = rotation};

            bus.pins = 0;
            assert_int_equal(tuile_display_init(&display, &config), 0);
            recorder_forget(&recorder);
            assert_int_equal(tuile_display_window(&display, 16, 8, 8, 16), 0);
            assert_int_equal(tuile_display_write(&display, zeros, 128u * tuile_wire_bits(display.wire) / 8u), 0);
            assert_string_equal(recorder.log, windows[i].window[rotation]);
            assert_int_equal(tuile_display_wait(&display), 0);
            recorder_forget(&recorder);
            assert_int_equal(tuile_display_present(&display), 0);
            assert_string_equal(recorder.log, windows[i].on);
            recorder_forget(&recorder);
            assert_int_equal(tuile_display_present(&display), 0); /* it is on already */
            assert_string_equal(recorder.log, "");
            assert_int_equal(tuile_display_sleep(&display), 0);
            assert_string_equal(recorder.log, windows[i].sleep);
        }
    }
}

/* QEMU's lm3s6965evb has an SSD0323 that knows these commands only, and takes the parameters of others for commands. */
static void the_ssd0323_is_started_by_commands_that_qemu_knows(void **state) {
    static const uint8_t known[] = {0x15, 0x75, 0x81, 0x84, 0x85, 0x86, 0xA0, 0xA1, 0xA2, 0xA4, 0xA5, 0xA6, 0xA7,
                                    0xA8, 0xAD, 0xAE, 0xAF, 0xB1, 0xB2, 0xB3, 0xB8, 0xBC, 0xBE, 0xBF, 0xE3};
    static const uint8_t pixel[2] = {0};
    unsigned commands = 0;
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_display_t display;
    const tuile_display_config_t config = {.bus = &bus, .panel = panel_of("ssd0323")};
    (void)state;
    bus.pins = 0;
    assert_int_equal(tuile_display_init(&display, &config), 0);
    assert_int_equal(tuile_display_window(&display, 0, 0, 2, 2), 0);
    assert_int_equal(tuile_display_write(&display, pixel, 2), 0);
    assert_int_equal(tuile_display_present(&display), 0);
    for (const char *line = recorder.log; *line; line = strchr(line, '\n') + 1) {
        if (strncmp(line, "delay", 5) == 0 || strncmp(line, "data", 4) == 0 || strncmp(line, "wait", 4) == 0) { continue; }
        if (!memchr(known, (int)strtoul(line, NULL, 16), sizeof known)) { fail_msg("%.2s", line); }
        commands++;
    }
    assert_int_equal(commands, 14 + 2 + 2 + 2); /* start, rotation, window, on and brightness */
}

/* ---- the picture ------------------------------------------------------------------------------------------------ */

static void check_all(const board_t *board, uint8_t rotation) {
    board_check_clean(board);
    board_check_picture(board, rotation, board->display.wire);
    board_check_glass(board, rotation, board->display.wire);
}

static void pictures_in_every_rotation_through_splits_and_chunks(void **state) {
    static const struct {
        uint32_t tile_width, tile_height, max_chunk_bytes;
    } splits[] = {{480, 480, 0}, {480, 8, 0}, {40, 24, 0}, {37, 41, 4095}, {1, 480, 0}, {480, 480, 6}, {13, 16, 7}, {480, 480, 65}};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(names); i++) {
        for (uint8_t rotation = 0; rotation < 4; rotation++) {
            for (size_t j = 0; j < CHECK_COUNT(splits); j++) {
                const tuile_panel_t *panel = panel_of(names[i]);
                board_t board;

                open_named(&board, names[i],
                           &(sim_bus_config_t){.max_chunk_bytes = splits[j].max_chunk_bytes, .blocking = j % 2 != 0});
                assert_int_equal(board_start(&board, rotation, TUILE_WIRE_DEFAULT), 0);
                assert_int_equal(board.display.wire,
                                 rotation % 2 && panel->formats[0].turned ? panel->formats[0].turned : panel->formats[0].wire);
                assert_int_equal(board_draw(&board.display, board.display.wire, splits[j].tile_width, splits[j].tile_height), 0);
                check_all(&board, rotation);
                assert_int_equal(board.chip->warnings, 0); /* no clock is beyond what its data sheet promises */
                board_close(&board);
            }
        }
    }
}

/* The picture in 3 x 3 parts of which those at the edges are as small as can be, in two orders; each is written once, over noise.
 */
static void windows_at_all_edges(void **state) {
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(names); i++) {
        for (unsigned turn = 0; turn < 8; turn++) {
            const uint8_t rotation = turn % 4;
            board_t board;
            tuile_display_t *display = &board.display;

            open_named(&board, names[i], NULL);
            assert_int_equal(board_start(&board, rotation, TUILE_WIRE_DEFAULT), 0);
            const uint32_t across[4] = {0, display->align_x, (uint32_t)display->width - display->align_x, display->width};
            const uint32_t down[4] = {0, display->align_y, (uint32_t)display->height - display->align_y, display->height};
            for (unsigned part = 0; part < 9; part++) {
                const unsigned now = turn < 4 ? part : 8 - part, column = now % 3, row = now / 3;

                assert_int_equal(board_draw_window(display, display->wire, across[column], down[row],
                                                   across[column + 1] - across[column], down[row + 1] - down[row]),
                                 0);
            }
            assert_int_equal(tuile_display_present(display), 0);
            check_all(&board, rotation);
            board_close(&board);
        }
    }
}

/* Offsets: what is not wired to the glass keeps the noise that it had. */
static void nothing_is_written_beyond_the_glass(void **state) {
    static const struct {
        const char *name;
        unsigned width, height, first, last; /* of the memory; segments of the glass */
    } cases[] = {{"sh1106", 132, 64, 2, 129}, {"ssd1322", 480, 128, 112, 367}};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        for (uint8_t rotation = 0; rotation < 4; rotation++) {
            board_t board, fresh;

            open_named(&board, cases[i].name, NULL);
            open_named(&fresh, cases[i].name, NULL);
            assert_int_equal(board_start(&board, rotation, TUILE_WIRE_DEFAULT), 0);
            assert_int_equal(board_draw(&board.display, board.display.wire, 480, 480), 0);
            for (unsigned y = 0; y < cases[i].height; y++) {
                for (unsigned x = 0; x < cases[i].width; x++) {
                    if (x < cases[i].first || x > cases[i].last || y >= 64) {
                        assert_int_equal(sim_oled_memory(board.chip, x, y), sim_oled_memory(fresh.chip, x, y));
                    }
                }
            }
            board_close(&fresh);
            board_close(&board);
        }
    }
}

static void misaligned_windows_send_nothing(void **state) {
    static const uint8_t aligned[][2] = {{1, 1}, {1, 1}, {1, 8}, {1, 8}, {1, 8}, {4, 1}, {2, 1}}; /* as `names` */
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(names); i++) {
        for (uint8_t rotation = 0; rotation < 4; rotation++) {
            const uint32_t x = aligned[i][rotation % 2], y = aligned[i][1 - rotation % 2];
            board_t board;

            open_named(&board, names[i], NULL);
            assert_int_equal(board_start(&board, rotation, TUILE_WIRE_DEFAULT), 0);
            assert_int_equal(board.display.align_x, x);
            assert_int_equal(board.display.align_y, y);
            const uint64_t sent = board.bus.transfers;
            for (uint32_t off = 1; off < x; off++) {
                assert_int_equal(tuile_display_window(&board.display, off, 0, x, y), TUILE_HAL_ARGUMENT);
                assert_int_equal(tuile_display_window(&board.display, 0, 0, x + off, y), TUILE_HAL_ARGUMENT);
            }
            for (uint32_t off = 1; off < y; off++) {
                assert_int_equal(tuile_display_window(&board.display, 0, off, x, y), TUILE_HAL_ARGUMENT);
                assert_int_equal(tuile_display_window(&board.display, 0, 0, x, y + off), TUILE_HAL_ARGUMENT);
            }
            assert_true(board.bus.transfers == sent);
            board_close(&board);
        }
    }
}

/* Either name of a format will do at a quarter turn, and only there. */
static void turned_bytes_are_for_quarter_turns(void **state) {
    static const struct {
        const char *name;
        uint8_t wire, turned;
    } cases[] = {{"ssd1306-128x64", TUILE_WIRE_MONO_PAGES, TUILE_WIRE_MONO_PAGES_TURNED},
                 {"ssd1322", TUILE_WIRE_GREY4, TUILE_WIRE_GREY4_TURNED}};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        for (uint8_t rotation = 0; rotation < 4; rotation++) {
            board_t board;

            open_named(&board, cases[i].name, NULL);
            assert_int_equal(board_start(&board, rotation, cases[i].wire), 0);
            assert_int_equal(board.display.wire, rotation % 2 ? cases[i].turned : cases[i].wire);
            assert_int_equal(board_start(&board, rotation, cases[i].turned), rotation % 2 ? 0 : TUILE_HAL_UNSUPPORTED);
            assert_int_equal(board_start(&board, rotation, TUILE_WIRE_RGB565), TUILE_HAL_UNSUPPORTED);
            board_close(&board);
        }
    }
}

/* ---- light ------------------------------------------------------------------------------------------------------ */

static unsigned brightest(const board_t *board) {
    sim_picture_t glass;
    unsigned most = 0;

    assert_int_equal(board->chip->glass(board->chip, &glass, NULL), 0);
    for (size_t i = 0; i < (size_t)glass.width * glass.height * 3; i++) {
        most = glass.rgb[i] > most ? glass.rgb[i] : most;
    }
    sim_picture_free(&glass);
    return most;
}

static void noise_is_never_seen(void **state) {
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(names); i++) {
        for (unsigned pins = 0; pins < 2; pins++) {
            board_t board;
            tuile_display_t *display = &board.display;

            open_named(&board, names[i], &(sim_bus_config_t){.no_reset_pin = pins != 0, .no_backlight_pin = true});
            assert_int_equal(brightest(&board), 0);
            assert_int_equal(board_start(&board, 0, TUILE_WIRE_DEFAULT), 0);
            assert_int_equal(brightest(&board), 0);
            assert_int_equal(board_draw_window(display, display->wire, 0, 0, display->width, display->height), 0);
            assert_int_equal(tuile_display_wait(display), 0);
            assert_int_equal(brightest(&board), 0);
            assert_int_equal(tuile_display_present(display), 0);
            check_all(&board, 0);

            /* Awake or asleep, it starts anew, and dark. */
            assert_int_equal(tuile_display_resume(display), 0);
            assert_int_equal(brightest(&board), 0);
            assert_int_equal(board_draw(display, display->wire, 480, 480), 0);
            check_all(&board, 0);
            assert_int_equal(tuile_display_sleep(display), 0);
            assert_int_equal(brightest(&board), 0);
            assert_int_equal(tuile_display_resume(display), 0);
            assert_int_equal(board_draw(display, display->wire, 480, 480), 0);
            check_all(&board, 0);
            assert_int_equal(tuile_display_close(display), 0);
            assert_int_equal(brightest(&board), 0);
            board_check_clean(&board);
            board_close(&board);
        }
    }
}

/* The level's share of the module's usual contrast, and of that what white looks like. */
static void brightness_is_the_panels_contrast(void **state) {
    static const struct {
        const char *name;
        unsigned half, quarter; /* of 255, for levels 128 and 64 */
    } cases[] = {
        {"ssd1306-128x64", 128, 64}, /* 207 * 128 / 255 = 104, 255 * 104 / 207 = 128; 52, 64 */
        {"sh1106", 128, 64},         /* the same */
        {"ssd1322", 128, 64},        /* 159 * 128 / 255 = 80, 128; 40, 64 */
        {"ssd0323", 127, 63},        /* 112 * 128 / 255 = 56, 127; 28, 63 */
        {"ssd1351", 143, 79},        /* 15 * 128 / 255 = 8: 9 sixteenths; 15 * 64 / 255 = 4: 5 */
    };
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        board_t board;

        open_named(&board, cases[i].name, &(sim_bus_config_t){.no_backlight_pin = true});
        assert_int_equal(board_start(&board, 0, TUILE_WIRE_DEFAULT), 0);
        assert_int_equal(board_draw(&board.display, board.display.wire, 480, 480), 0);
        assert_int_equal(brightest(&board), 255);
        assert_int_equal(tuile_display_brightness(&board.display, 128), 0);
        assert_int_equal(brightest(&board), cases[i].half);
        assert_int_equal(tuile_display_brightness(&board.display, 64), 0);
        assert_int_equal(brightest(&board), cases[i].quarter);
        assert_int_equal(tuile_display_brightness(&board.display, 255), 0);
        check_all(&board, 0);
        board_close(&board);
    }
}

/* ---- faults ----------------------------------------------------------------------------------------------------- */

/* A start and a frame in quarters; 0, or the fault. */
static int start_and_draw(board_t *board, uint8_t rotation) {
    const int result = board_start(board, rotation, TUILE_WIRE_DEFAULT);

    return result ? result
                  : board_draw(&board->display, board->display.wire, board->display.width / 2u, board->display.height / 2u);
}

/* Without a reset line a command that was cut takes the next bytes for its parameters, and these chips have no other way back. */
static void the_picture_is_right_after_a_fault_at_any_transfer(void **state) {
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(names); i++) {
        for (unsigned variant = 0; variant < 10; variant++) {
            static const uint8_t parts[5] = {0, 1, 2, 0, 2};
            const uint8_t rotation = variant % 2 ? 1 : 2;
            sim_bus_config_t config = {.max_chunk_bytes = 900, .no_reset_pin = variant / 2 >= 3};
            board_t board;

            config.fail_parts = parts[variant / 2];
            open_named(&board, names[i], &config);
            assert_int_equal(start_and_draw(&board, rotation), 0);
            const uint64_t count = board.bus.transfers;
            board_close(&board);
            assert_true(count > 20);
            for (config.fail_transfer = 1; config.fail_transfer <= count; config.fail_transfer++) {
                open_named(&board, names[i], &config);
                assert_int_equal(start_and_draw(&board, rotation), TUILE_HAL_IO);
                assert_true(board.bus.transfers == config.fail_transfer);
                assert_int_equal(tuile_display_resume(&board.display), 0);
                assert_int_equal(board_draw(&board.display, board.display.wire, 480, 480), 0);
                board_check_clean(&board);
                board_check_picture(&board, rotation, board.display.wire);
                board_close(&board);
            }
        }
    }
}

/* ---- the frame loop --------------------------------------------------------------------------------------------- */

/* A scene through the frame loop at a quarter turn, against the same scene in bytes that are not turned. */
static void check_scene(const char *name, uint8_t plain, unsigned step) {
    for (uint8_t rotation = 1; rotation < 4; rotation += 2) {
        stage_t stage;
        mesh_t mesh;
        board_t board;
        tuile_t *renderer;
        block_t block;
        sim_picture_t seen = {0};

        open_named(&board, name, NULL);
        assert_int_equal(board_start(&board, rotation, TUILE_WIRE_DEFAULT), 0);
        tuile_config_t config = {.width = board.display.width,
                                 .height = board.display.height,
                                 .tile_width = 24,
                                 .tile_height = 20,
                                 .format = tuile_stream_format(&board.display)};
        model_octahedron(&mesh);
        stage_open(&stage, &mesh, config.width, config.height);
        block_open(&block, 1 << 18);
        assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), 0);
        assert_int_equal(tuile_stream_frame(renderer, &stage.view.scene, &board.display, NULL), 0);
        board_check_clean(&board);
        config.format = plain;
        config.tile_height = 24; /* whole pages */
        uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 18, NULL);
        unsigned changes = 0;
        assert_int_equal(sim_bus_picture(&board.bus, rotation, &seen, NULL), 0);
        for (size_t p = 0; p < (size_t)config.width * config.height; p++) {
            assert_int_equal(seen.rgb[3 * p], step * expected[p]);
            changes += p > 0 && expected[p] != expected[p - 1];
        }
        assert_true(changes > 50);
        sim_picture_free(&seen);
        free(expected);
        block_close(&block);
        stage_close(&stage);
        board_close(&board);
    }
}

static void scenes_stand_upright_at_a_quarter_turn(void **state) {
    (void)state;
    check_scene("ssd1306-128x64", TUILE_MONO_PAGES, 255);
    check_scene("sh1106", TUILE_MONO_PAGES, 255);
    check_scene("ssd1322", TUILE_GREY4, 17);
    check_scene("ssd0323", TUILE_GREY4, 17);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_panel_is_started_by_its_bytes),
        cmocka_unit_test(a_window_is_told_in_the_panels_own_numbers),
        cmocka_unit_test(the_ssd0323_is_started_by_commands_that_qemu_knows),
        cmocka_unit_test(pictures_in_every_rotation_through_splits_and_chunks),
        cmocka_unit_test(windows_at_all_edges),
        cmocka_unit_test(nothing_is_written_beyond_the_glass),
        cmocka_unit_test(misaligned_windows_send_nothing),
        cmocka_unit_test(turned_bytes_are_for_quarter_turns),
        cmocka_unit_test(noise_is_never_seen),
        cmocka_unit_test(brightness_is_the_panels_contrast),
        cmocka_unit_test(the_picture_is_right_after_a_fault_at_any_transfer),
        cmocka_unit_test(scenes_stand_upright_at_a_quarter_turn),
    };
    return cmocka_run_group_tests_name("OLED panels", tests, NULL, NULL);
}
