/* The display layer and the ILI9341's data: the bytes of the start, windows, chunks, errors and how it resumes after them.
 *
 * Bytes and numbers that are expected come from the data sheet and from hand, never from the code under test. */
#include "support/check.h"

#include "../hal/display.h"
#include "../hal/panels/ili9341.h"
#include "../hal/template/bus.h"
#include "../sim/bus.h"
#include "support/board.h"
#include "support/recorder.h"

/* ---- bytes ------------------------------------------------------------------------------------------------------ */

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
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_display_t display;

    (void)state;
    assert_int_equal(tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341}), 0);
    assert_string_equal(recorder.log, "backlight 0\n"
                                      "reset 1\nreset 0\ndelay 1\nreset 1\ndelay 120\n" VENDOR_BLOCK "36|08\n"
                                      "3A|55\n");
    assert_int_equal(recorder.command_clock_hz, 10000000);
    assert_int_equal(recorder.pixel_clock_hz, 40000000);
    assert_true(display.refresh);
    assert_int_equal(display.width, 240);
    assert_int_equal(display.height, 320);
}

static void test_ili9341_init_bytes_without_pins_turned_18_bits(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_display_t display;
    tuile_display_config_t config = {
        .bus = &bus, .panel = &tuile_ili9341, .rotation = 1, .wire = TUILE_WIRE_RGB666, .pixel_clock_hz = 62500000};

    (void)state;
    bus.pins = 0;
    assert_int_equal(tuile_display_init(&display, &config), 0);
    assert_string_equal(recorder.log, "delay 120\n"
                                      "01\n"
                                      "delay 120\n" VENDOR_BLOCK "36|68\n"
                                      "3A|66\n");
    assert_int_equal(recorder.pixel_clock_hz, 62500000);
    assert_int_equal(display.width, 320);
    assert_int_equal(display.height, 240);
}

static void test_address_mode_of_each_rotation(void **state) {
    static const char *const expected[4] = {"36|08\n", "36|68\n", "36|C8\n", "36|A8\n"};

    (void)state;
    for (uint8_t rotation = 0; rotation < 4; rotation++) {
        recorder_t recorder;
        tuile_bus_t bus = recorder_bus(&recorder);
        tuile_display_t display;
        assert_int_equal(
            tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341, .rotation = rotation}), 0);
        assert_non_null(strstr(recorder.log, expected[rotation]));
    }
}

static void test_window_and_write_bytes(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_display_t display;
    uint8_t pixels[2 * 30 * 4] = {0xAB};

    (void)state;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341});
    recorder_forget(&recorder);
    /* 30 x 4 at (10, 260): columns 10 ... 39 = 0A ... 27, rows 260 ... 263 = 0104 ... 0107 */
    assert_int_equal(tuile_display_window(&display, 10, 260, 30, 4), 0);
    assert_int_equal(tuile_display_write(&display, pixels, sizeof pixels), 0);
    assert_int_equal(tuile_display_present(&display), 0);
    assert_string_equal(recorder.log, "2A|00 0A 00 27\n"
                                      "2B|01 04 01 07\n"
                                      "2C\n"
                                      "data 240: AB\n"
                                      "wait\n"
                                      "29\n"
                                      "backlight 255\n");
    assert_false(display.refresh);
}

/* SSD1306 and its kin take parameters with D/C low. */
static void test_parameters_low(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_panel_t panel = tuile_ili9341;
    tuile_display_t display;

    (void)state;
    panel.parameters_low = 1;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &panel});
    assert_non_null(strstr(recorder.log, "\nCF 00 C1 30\n"));
    recorder_forget(&recorder);
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
        tuile_bus_t bus = recorder_bus(&recorder);
        tuile_display_t display;
        bus.max_chunk_bytes = cases[i].max_chunk_bytes;
        tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341, .wire = cases[i].wire});
        assert_int_equal(tuile_display_window(&display, 0, 0, 240, 320), 0);
        recorder_forget(&recorder);
        assert_int_equal(tuile_display_write(&display, pixels, cases[i].size_bytes), 0);
        assert_string_equal(recorder.log, cases[i].expected);
    }
}

/* ---- geometry --------------------------------------------------------------------------------------------------- */

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
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_panel_t panel = tuile_ili9341;
    tuile_display_t display;

    (void)state;
    panel.view_width = 135;
    panel.view_height = 240;
    panel.offset_x = 52;
    panel.offset_y = 40;
    panel.align_y = 8;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &panel, .rotation = 1});
    recorder_forget(&recorder);
    /* columns 40 + 8 ... + 15, rows 53 + 100 ... 53 + 134 */
    assert_int_equal(tuile_display_window(&display, 8, 100, 8, 35), 0);
    assert_string_equal(recorder.log, "2A|00 30 00 37\n2B|00 99 00 BB\n2C\n");
    assert_int_equal(tuile_display_window(&display, 4, 100, 8, 35), TUILE_HAL_ARGUMENT);
    assert_int_equal(tuile_display_window(&display, 8, 100, 4, 35), TUILE_HAL_ARGUMENT);
}

/* ---- arguments and states --------------------------------------------------------------------------------------- */

static void test_arguments_send_nothing(void **state) {
    static const uint32_t windows[][4] = {{0, 0, 0, 1},   {0, 0, 1, 0},          {240, 0, 1, 1},
                                          {0, 320, 1, 1}, {1, 0, 240, 1},        {0, 1, 1, 320},
                                          {0, 0, 241, 1}, {0, 0, UINT32_MAX, 1}, {UINT32_MAX, 0, 2, 1}};
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder), broken;
    tuile_display_t display;
    tuile_display_config_t config = {.bus = &bus, .panel = &tuile_ili9341};
    uint8_t pixels[16] = {0};

    (void)state;
    tuile_display_init(&display, &config);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_write(&display, pixels, 2), TUILE_HAL_STATE);
    for (size_t i = 0; i < sizeof windows / sizeof windows[0]; i++) {
        assert_int_equal(tuile_display_window(&display, windows[i][0], windows[i][1], windows[i][2], windows[i][3]),
                         TUILE_HAL_ARGUMENT);
    }
    assert_string_equal(recorder.log, "");
    assert_int_equal(tuile_display_window(&display, 0, 0, 3, 2), 0);
    recorder_forget(&recorder);
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
    config.wire = TUILE_WIRE_MONO_PAGES;
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
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_panel_t panel = tuile_ili9341;
    tuile_display_t display;

    (void)state;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341, .brightness = 100});
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_brightness(&display, 7), 0); /* not lit yet */
    assert_string_equal(recorder.log, "");
    assert_int_equal(tuile_display_present(&display), 0);
    assert_int_equal(tuile_display_brightness(&display, 200), 0);
    assert_int_equal(tuile_display_sleep(&display), 0);
    assert_string_equal(recorder.log, "29\nbacklight 7\nbacklight 200\nbacklight 0\n28\n10\ndelay 120\n");
    assert_int_equal(tuile_display_window(&display, 0, 0, 1, 1), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_wait(&display), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_resume(&display), 0);
    assert_true(display.refresh);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_present(&display), 0);
    assert_string_equal(recorder.log, "29\nbacklight 200\n");

    bus.pins = 0;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341});
    assert_int_equal(tuile_display_brightness(&display, 1), TUILE_HAL_UNSUPPORTED);
    panel.brightness_command = 0x51;
    tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &panel});
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_present(&display), 0);
    assert_string_equal(recorder.log, "29\n51|FF\n");
}

static void test_tearing(void **state) {
    static const uint8_t pixels[2] = {0};
    board_t board;
    tuile_display_config_t config = {.panel = &tuile_ili9341, .tearing_timeout_ms = 20};
    uint64_t before_ns;

    (void)state;
    board_open(&board, &(sim_bus_config_t){.refresh_hz = 100});
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
    board_close(&board);

    board_open(&board, &(sim_bus_config_t){.refresh_hz = 1});
    config.bus = &board.bus.bus;
    config.tearing_timeout_ms = 1;
    assert_int_equal(tuile_display_init(&board.display, &config), 0);
    assert_int_equal(tuile_display_window(&board.display, 0, 0, 1, 1), TUILE_HAL_TIMEOUT);
    assert_int_equal(board.display.error, TUILE_HAL_TIMEOUT);
    board_close(&board);
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

/* ---- errors ----------------------------------------------------------------------------------------------------- */

static void test_first_error_sticks(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder);
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
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_display_t display;

    (void)state;
    recorder.fail_with = -5;
    assert_int_equal(tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &tuile_ili9341}), TUILE_HAL_IO);
    recorder.fail_with = -1000;
    assert_int_equal(tuile_display_resume(&display), TUILE_HAL_IO);
}

static void test_gone_is_final(void **state) {
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder);
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
    recorder_forget(&recorder);
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
        tuile_bus_t bus = recorder_bus(&recorder);
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
            /* a backlight that does not go out does not keep the panel from being put to sleep: three calls more */
            assert_int_equal(recorder.calls, call == count - 3 ? count : call);
            assert_int_equal(tuile_display_resume(&display), 0);
        }
    }
}

static void test_damaged_sequence(void **state) {
    static const uint8_t sequences[][4] = {{4, 0xEF, 3, 128}, {1, 0x29, 0, 1}, {1, 0x29, 2, 1}, {65, 0, 0, 0}};

    (void)state;
    for (size_t i = 0; i < sizeof sequences / sizeof sequences[0]; i++) {
        recorder_t recorder;
        tuile_bus_t bus = recorder_bus(&recorder);
        tuile_panel_t panel = tuile_ili9341;
        tuile_display_t display;
        panel.init = (tuile_sequence_t){sequences[i], 4};
        assert_int_equal(tuile_display_init(&display, &(tuile_display_config_t){.bus = &bus, .panel = &panel}), TUILE_HAL_PROTOCOL);
    }
}

static void test_close_leaves_it_dark(void **state) {
    static const uint8_t pixel[2] = {0};
    recorder_t recorder;
    tuile_bus_t bus = recorder_bus(&recorder);
    tuile_display_t display;
    const tuile_display_config_t config = {.bus = &bus, .panel = &tuile_ili9341};

    (void)state;
    tuile_display_init(&display, &config);
    tuile_display_window(&display, 0, 0, 1, 1);
    tuile_display_write(&display, pixel, 2);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_close(&display), 0);
    assert_string_equal(recorder.log, "wait\nbacklight 0\n28\n10\ndelay 120\n");
    assert_int_equal(tuile_display_close(&display), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_resume(&display), TUILE_HAL_STATE);

    /* an error that sticks is no reason to leave it lit */
    tuile_display_init(&display, &config);
    recorder.fail_at = recorder.calls + 1;
    assert_int_equal(tuile_display_window(&display, 0, 0, 1, 1), TUILE_HAL_IO);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_close(&display), 0);
    assert_string_equal(recorder.log, "backlight 0\n28\n10\ndelay 120\n");

    /* asleep already, or gone: nothing to say */
    tuile_display_init(&display, &config);
    tuile_display_sleep(&display);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_close(&display), 0);
    tuile_display_init(&display, &config);
    recorder.fail_with = TUILE_HAL_GONE;
    assert_int_equal(tuile_display_window(&display, 0, 0, 1, 1), TUILE_HAL_GONE);
    recorder_forget(&recorder);
    assert_int_equal(tuile_display_close(&display), 0);
    assert_string_equal(recorder.log, "");
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ili9341_init_bytes),
        cmocka_unit_test(test_ili9341_init_bytes_without_pins_turned_18_bits),
        cmocka_unit_test(test_address_mode_of_each_rotation),
        cmocka_unit_test(test_window_and_write_bytes),
        cmocka_unit_test(test_parameters_low),
        cmocka_unit_test(test_chunks),
        cmocka_unit_test(test_geometry_by_hand),
        cmocka_unit_test(test_window_with_offset_and_alignment),
        cmocka_unit_test(test_arguments_send_nothing),
        cmocka_unit_test(test_brightness_and_sleep),
        cmocka_unit_test(test_tearing),
        cmocka_unit_test(test_template_port_opens),
        cmocka_unit_test(test_first_error_sticks),
        cmocka_unit_test(test_codes_of_a_port_do_not_pass),
        cmocka_unit_test(test_gone_is_final),
        cmocka_unit_test(test_fault_at_every_call),
        cmocka_unit_test(test_damaged_sequence),
        cmocka_unit_test(test_close_leaves_it_dark),
    };
    return cmocka_run_group_tests_name("display", tests, NULL, NULL);
}
