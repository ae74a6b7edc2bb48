/* Faults of a panel on a Linux board: every ioctl of a start and a frame fails once, is cut short, or finds the device gone. The
 * fault comes up by the end of the frame, nothing is tried twice, the panel recovers, and nothing stays open. */
#include "support/check.h"

#include "../hal/panels/ili9341.h"
#include "mock/linux.h"
#include "support/board.h"

#include <errno.h>

static mock_linux_t mock;
static tuile_linux_t port;

/* 240 x 16 pixels in 2 tiles; with a bufsiz of 2048 each is two messages. */
#define FRAME_ROWS 16u
#define TILE_ROWS 8u

static int draw(tuile_display_t *display) {
    for (uint32_t y = 0; y < FRAME_ROWS; y += TILE_ROWS) {
        const int result = board_draw_window(display, TUILE_WIRE_RGB565, 0, y, 240, TILE_ROWS);
        if (result) { return result; }
    }
    return tuile_display_present(display);
}

static void check_seen(void) {
    sim_picture_t seen = mock_linux_picture(&mock, 0);

    for (uint32_t y = 0; y < FRAME_ROWS; y++) {
        for (uint32_t x = 0; x < 240; x++) {
            board_check_pixel(sim_picture_at(&seen, x, y), TUILE_WIRE_RGB565, board_colour(240, x, y));
        }
    }
    sim_picture_free(&seen);
}

static void open_board(const tuile_linux_config_t *config) {
    tuile_linux_close(&port); /* after a test that failed */
    mock = (mock_linux_t){.bufsiz = 2048};
    mock_linux_open(&mock, "ili9341");
    if (mock_linux_port(&mock, &port, config)) { fail_msg("%s", port.fault.text); }
    mock.calls = 0;
}

static void close_board(void) {
    tuile_linux_close(&port);
    assert_int_equal(mock_linux_descriptors(&mock), 0);
    assert_int_equal(mock_linux_held(&mock), 0);
    mock_linux_close(&mock);
}

static int start_and_draw(tuile_display_t *display, const tuile_panel_t *panel) {
    const int result = tuile_display_init(display, &(tuile_display_config_t){.bus = &port.bus, .panel = panel});

    return result ? result : draw(display);
}

/* ---- sweeps ----------------------------------------------------------------------------------------------------- */

/* The ILI9341 without its vendor's block but for the order of the gates, which is most of the ioctls. */
static const uint8_t init[] = {4, 0xB6, 0x08, 0xC2, 0x27, 1, 0x11, TUILE_SEQUENCE_DELAY_MS(120)};

static tuile_panel_t brief(void) {
    tuile_panel_t panel = tuile_ili9341;

    panel.init = (tuile_sequence_t)TUILE_SEQUENCE(init);
    return panel;
}

/* Start: backlight off, reset 1, 0, 1: 4. A command with parameters takes D/C low, message, D/C high, message: 4; there is one here
 * and 17 in the whole block. Sleep out: 2. The address mode, D/C being low: 3. The pixel format: 4. Of a tile: 4 for either half of
 * the window, 2 for the memory write, 3 for the pixels. Display on: 2, backlight: 1. */
#define CALLS(parametrised) (4u + 4u * (parametrised) + 2u + 3u + 4u + 2u * (4u + 4u + 2u + 3u) + 3u)

/* Without the line there is no pulse of it (3 fewer), but a software reset, whose D/C goes low for it, and no longer for the
 * command after it (2 - 1 more). */
#define FEWER_WITHOUT_RESET 2u

static void sweep(const tuile_panel_t *panel, unsigned count, bool cut, bool no_worker, bool no_reset) {
    tuile_linux_config_t config = mock_linux_config();
    tuile_display_t display;

    config.no_worker = no_worker;
    if (no_reset) {
        config.reset.chip = NULL;
        count -= FEWER_WITHOUT_RESET;
    }
    open_board(&config);
    assert_int_equal(start_and_draw(&display, panel), 0);
    assert_string_equal(mock.misuse.text, "");
    assert_int_equal(mock.calls, count);
    check_seen();
    close_board();
    for (unsigned call = 1; call <= count; call++) {
        open_board(&config);
        mock.fail_call = call;
        mock.cut = cut;
        assert_int_equal(start_and_draw(&display, panel), TUILE_HAL_IO);
        if (mock.calls != call) { fail_msg("call %u failed, and there were %u", call, mock.calls); }
        assert_string_not_equal(port.fault.text, "");
        assert_int_equal(draw(&display), TUILE_HAL_IO);
        assert_int_equal(mock.calls, call);
        assert_int_equal(tuile_display_resume(&display), 0);
        assert_true(display.refresh);
        assert_int_equal(draw(&display), 0);
        if (mock.misuse.text[0]) { fail_msg("call %u: %s", call, mock.misuse.text); }
        check_seen();
        assert_int_equal(tuile_display_close(&display), 0);
        assert_false(mock.level[MOCK_BACKLIGHT]);
        close_board();
    }
}

static void each_ioctl_fails_once(void **state) {
    const tuile_panel_t panel = brief();

    (void)state;
    for (unsigned variant = 0; variant < 4; variant++) {
        sweep(&panel, CALLS(1u), false, variant & 1, variant & 2);
    }
    sweep(&tuile_ili9341, CALLS(17u), false, false, false);
}

static void each_message_is_cut_short_once(void **state) {
    const tuile_panel_t panel = brief();

    (void)state;
    for (unsigned variant = 0; variant < 4; variant++) {
        sweep(&panel, CALLS(1u), true, variant & 1, variant & 2);
    }
}

static void the_device_goes_at_each_ioctl(void **state) {
    const tuile_linux_config_t config = mock_linux_config();
    const tuile_panel_t panel = brief();

    (void)state;
    for (unsigned call = 1; call <= CALLS(1u); call++) {
        tuile_display_t display;
        open_board(&config);
        mock.fail_call = call;
        mock.fail_errno = ESHUTDOWN;
        assert_int_equal(start_and_draw(&display, &panel), TUILE_HAL_GONE);
        assert_int_equal(tuile_display_resume(&display), TUILE_HAL_GONE);
        assert_int_equal(tuile_display_wait(&display), TUILE_HAL_GONE);
        assert_int_equal(tuile_display_close(&display), 0);
        assert_int_equal(mock.calls, call);
        close_board();
    }
}

/* Whatever ioctl of tuile_linux_open fails, nothing stays open. */
static void opening_fails_at_each_ioctl(void **state) {
    tuile_linux_config_t config = mock_linux_config();
    unsigned count;

    (void)state;
    config.tearing = (tuile_linux_line_t){.chip = "gpiochip0", .offset = MOCK_TEARING};
    mock = (mock_linux_t){0};
    mock_linux_open(&mock, "ili9341");
    assert_int_equal(tuile_linux_open(&port, &config), 0);
    count = mock.calls;
    close_board();
    assert_true(count >= 2u + 4u * 2u); /* two for the mode; the chip's info and the request for each line */
    for (unsigned call = 1; call <= count; call++) {
        mock = (mock_linux_t){.fail_call = call};
        mock_linux_open(&mock, "ili9341");
        assert_int_equal(tuile_linux_open(&port, &config), TUILE_HAL_IO);
        assert_non_null(strstr(port.fault.text, ": Input/output error"));
        assert_int_equal(mock_linux_descriptors(&mock), 0);
        assert_int_equal(mock_linux_held(&mock), 0);
        mock.fail_call = 0;
        assert_int_equal(tuile_linux_open(&port, &config), 0);
        close_board();
    }
}

/* ---- codes ------------------------------------------------------------------------------------------------------ */

static void each_errno_has_its_code(void **state) {
    static const struct {
        int error, code;
        const char *words;
    } cases[] = {
        {EIO, TUILE_HAL_IO, "Input/output error"},
        {EINTR, TUILE_HAL_IO, "Interrupted system call"}, /* some of it may be out: not tried again */
        {EINVAL, TUILE_HAL_IO, "Invalid argument"},
        {ENOMEM, TUILE_HAL_IO, "Cannot allocate memory"},
        {ENODEV, TUILE_HAL_GONE, "No such device; the device is gone, open it anew"},
        {ENXIO, TUILE_HAL_GONE, "No such device or address; the device is gone, open it anew"},
        {ESHUTDOWN, TUILE_HAL_GONE, "Cannot send after transport endpoint shutdown; the device is gone, open it anew"},
        {EMSGSIZE, TUILE_HAL_SIZE, "Message too long"},
        {ETIMEDOUT, TUILE_HAL_TIMEOUT, "Connection timed out"},
        {EPERM, TUILE_HAL_PERMISSION, "Operation not permitted; hal/linux/60-tuile.rules lets users have it (make install-udev)"},
        {EBUSY, TUILE_HAL_BUSY, "Device or resource busy"},
    };
    static const uint8_t bytes[3000] = {0x2C};
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        char text[300];

        open_board(&config);
        mock.fail_errno = cases[i].error;
        mock.fail_call = 1;
        assert_int_equal(port.bus.command(port.bus.context, bytes, 1, 1), cases[i].code);
        (void)snprintf(text, sizeof text, "dc line: %s", cases[i].words);
        assert_string_equal(port.fault.text, text);
        assert_int_equal(mock.calls, 1);
        close_board();

        open_board(&config);
        mock.fail_errno = cases[i].error;
        mock.fail_call = 2;
        assert_int_equal(port.bus.command(port.bus.context, bytes, 1, 1), cases[i].code);
        (void)snprintf(text, sizeof text, "/dev/spidev0.0: 1 bytes: %s", cases[i].words);
        assert_string_equal(port.fault.text, text);
        assert_int_equal(mock.calls, 2);
        close_board();

        /* of data on the thread: at the wait; and the chunk after it is not sent */
        open_board(&config);
        mock.fail_errno = cases[i].error;
        mock.fail_call = 1;
        assert_int_equal(port.bus.data(port.bus.context, bytes, sizeof bytes), 0);
        assert_int_equal(port.bus.wait(port.bus.context), cases[i].code);
        (void)snprintf(text, sizeof text, "/dev/spidev0.0: 2046 bytes: %s", cases[i].words);
        assert_string_equal(port.fault.text, text);
        assert_int_equal(mock.calls, 1);
        close_board();

        open_board(&config);
        mock.fail_errno = cases[i].error;
        mock.fail_call = 1;
        assert_int_equal(port.bus.pin(port.bus.context, TUILE_PIN_BACKLIGHT, 9), cases[i].code);
        (void)snprintf(text, sizeof text, "backlight line: %s", cases[i].words);
        assert_string_equal(port.fault.text, text);
        close_board();
    }
}

/* What is not there yet is NOT_FOUND, what was there is GONE; a mode that a controller has not is told when it is asked for. */
static void opening_and_using_are_told_apart(void **state) {
    static const struct {
        int error, opening, open;
    } cases[] = {
        {ENODEV, TUILE_HAL_NOT_FOUND, TUILE_HAL_GONE},          {ENXIO, TUILE_HAL_NOT_FOUND, TUILE_HAL_GONE},
        {ESHUTDOWN, TUILE_HAL_NOT_FOUND, TUILE_HAL_GONE},       {ENOENT, TUILE_HAL_NOT_FOUND, TUILE_HAL_IO},
        {ENOTDIR, TUILE_HAL_NOT_FOUND, TUILE_HAL_IO},           {ENOTTY, TUILE_HAL_NOT_FOUND, TUILE_HAL_IO},
        {EINVAL, TUILE_HAL_UNSUPPORTED, TUILE_HAL_IO},          {EACCES, TUILE_HAL_PERMISSION, TUILE_HAL_PERMISSION},
        {EPERM, TUILE_HAL_PERMISSION, TUILE_HAL_PERMISSION},    {EBUSY, TUILE_HAL_BUSY, TUILE_HAL_BUSY},
        {ENAMETOOLONG, TUILE_HAL_ARGUMENT, TUILE_HAL_ARGUMENT}, {EMSGSIZE, TUILE_HAL_SIZE, TUILE_HAL_SIZE},
        {ETIMEDOUT, TUILE_HAL_TIMEOUT, TUILE_HAL_TIMEOUT},      {EIO, TUILE_HAL_IO, TUILE_HAL_IO},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        assert_int_equal(tuile_linux_code(cases[i].error, true), cases[i].opening);
        assert_int_equal(tuile_linux_code(cases[i].error, false), cases[i].open);
    }
}

static void a_short_message_is_told(void **state) {
    static const uint8_t bytes[2000] = {0};
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    open_board(&config);
    mock.fail_call = 1;
    mock.cut = true;
    assert_int_equal(port.bus.data(port.bus.context, bytes, sizeof bytes), 0);
    assert_int_equal(port.bus.wait(port.bus.context), TUILE_HAL_IO);
    assert_string_equal(port.fault.text, "/dev/spidev0.0: 1000 of 2000 bytes were sent");
    close_board();
}

/* A level that could not be set may be either: it is set again before the next byte. */
static void dc_is_not_known_after_a_fault(void **state) {
    static const uint8_t command[1] = {0x00}, bytes[2] = {0};
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    open_board(&config);
    mock.fail_call = 1;
    assert_int_equal(port.bus.command(port.bus.context, command, 1, 1), TUILE_HAL_IO);
    assert_int_equal(port.bus.data(port.bus.context, bytes, 2), 0);
    assert_int_equal(port.bus.wait(port.bus.context), 0);
    assert_int_equal(mock.calls, 3); /* the one that failed, the level, the message */
    close_board();
}

static void closing_twice_and_closing_nothing(void **state) {
    const tuile_linux_config_t config = mock_linux_config();
    tuile_linux_t nothing = {0};

    (void)state;
    tuile_linux_close(&nothing);
    open_board(&config);
    tuile_linux_close(&port);
    assert_null(port.bus.command);
    tuile_linux_close(&port);
    close_board();
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_ioctl_fails_once),
        cmocka_unit_test(each_message_is_cut_short_once),
        cmocka_unit_test(the_device_goes_at_each_ioctl),
        cmocka_unit_test(opening_fails_at_each_ioctl),
        cmocka_unit_test(each_errno_has_its_code),
        cmocka_unit_test(opening_and_using_are_told_apart),
        cmocka_unit_test(a_short_message_is_told),
        cmocka_unit_test(dc_is_not_known_after_a_fault),
        cmocka_unit_test(closing_twice_and_closing_nothing),
    };
    print_message("libgpiod %s, a made-up kernel\n", tuile_linux_gpiod_version());
    return cmocka_run_group_tests_name("faults on spidev", tests, NULL, mock_linux_end);
}
