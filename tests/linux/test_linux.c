/* What tests/linux/run_linux did in the guest: programs built for arm64 under Debian's own kernel. */
#include "../support/check.h"

#include "../../sim/picture.h"
#include "../support/command.h"
#include "guest.h"

/* A picture from the guest is what the simulator here draws for the same arguments, in the bits that are kept; of several frames,
 * the one that is named. */
static void assert_simulated(const char *name, const char *arguments, int rotation, unsigned frame, uint32_t kept) {
    char line[1024], expected_path[512];
    sim_picture_t expected, glass;
    sim_error_t error = {""};
    command_result_t result;

    (void)snprintf(expected_path, sizeof expected_path, "%s", guest_path(name, "-expected"));
    (void)snprintf(line, sizeof line, "%s %s --out %s-%%d.ppm", getenv("TUILE"), arguments, expected_path);
    command_shell(&result, line);
    if (result.code != 0) { fail_msg("%s: %s", line, result.err); }
    command_free(&result);
    (void)snprintf(line, sizeof line, "%s-%u.ppm", expected_path, frame);
    /* As the module lies. */
    if (sim_picture_read(&expected, line, &error) || sim_picture_turn(&expected, rotation / 90, &glass, &error) ||
        sim_picture_write(&glass, line, &error)) {
        fail_msg("%s", error.text);
    }
    sim_picture_free(&expected);
    sim_picture_free(&glass);
    guest_assert_same_picture(guest_path(name, ".ppm"), line, kept);
}

/* The same for what a panel on the pins showed last; nothing was wrong in any session. */
static void assert_session(unsigned session, const char *arguments, int rotation) {
    char name[32];

    guest_assert_text("panels", ".err", "");
    (void)snprintf(name, sizeof name, "panel-%u", session);
    assert_simulated(name, arguments, rotation, 0, 0xFFFFFF);
}

static void assert_failed_well(const char *step, const char *words, const char *other_words) {
    char *out = guest_text(step, ".out"), *err = guest_text(step, ".err");
    const command_result_t result = {
        .code = (int)guest_number(step, ".code", ""), .out = out, .err = err, .out_bytes = strlen(out), .err_bytes = strlen(err)};

    if (!command_failed_well(&result, words, other_words)) { fail_msg("%s ended with %d: %s", step, result.code, err); }
    free(out);
    free(err);
}

#define ROOM "render tests/models/room.obj --eye 0,1,3 --at 0,1,0 --shade gouraud"

static void test_a_frame_on_a_panel_with_offsets(void **state) {
    (void)state;
    guest_assert_code("st7735", 0);
    assert_session(1, ROOM " --panel st7735-80x160", 0);
}

static void test_a_card_on_a_display_of_dots(void **state) {
    (void)state;
    guest_assert_code("ssd1306", 0);
    assert_session(2, "card --panel ssd1306-128x64", 0);
}

static void test_a_frame_on_an_ili9341_held_sideways(void **state) {
    (void)state;
    guest_assert_code("ili9341", 0);
    assert_session(3, ROOM " --rotate 90 --panel ili9341", 90);
}

#define RULES "hal/linux/60-tuile.rules lets users have it (make install-udev)\n"

static void test_displays_tells_what_is_attached(void **state) {
    (void)state;
    guest_assert_code("displays", 0);
    guest_assert_text("displays", ".err", "");
    guest_assert_text("displays", ".out",
                      "SPI, transfers of up to 1000 bytes (bufsiz)\n"
                      "  /dev/spidev0.0: ready\n"
                      "GPIO, through libgpiod 1.6.3\n"
                      "  gpiochip0: 9030000.pl061, 8 lines\n"
                      "    line 0 is in use by sck\n"
                      "    line 1 is in use by mosi\n"
                      "    line 2 is in use by spi0 CS0\n"
                      "USB\n"
                      "  001-002: 1d50:614d GUD: ready, up to 160x120 pixels\n");
    guest_assert_text("displays-device", ".err", "");
}

static void test_displays_tells_what_users_may_not_have(void **state) {
    (void)state;
    guest_assert_code("displays-denied", 0);
    guest_assert_text("displays-denied", ".out",
                      "SPI, transfers of up to 1000 bytes (bufsiz)\n"
                      "  /dev/spidev0.0: Permission denied; " RULES "GPIO, through libgpiod 1.6.3\n"
                      "  gpiochip0: Permission denied; " RULES "USB\n"
                      "  001-002: 1d50:614d GUD: no permission; " RULES);
}

static void test_what_is_not_there(void **state) {
    (void)state;
    assert_failed_well("no-chip", "gpiochip7", "No such file");
    assert_failed_well("no-line", "gpiochip0 has no line 8", "0 to 7");
    assert_failed_well("no-device", "/dev/spidev9.0", "No such file");
}

static void test_lines_in_use(void **state) {
    (void)state;
    assert_failed_well("kernels-line", "line 2 of gpiochip0", "in use by spi0 CS0");
    assert_failed_well("lines-in-use", "line 4 of gpiochip0", "in use by tuile");
}

static void test_no_permission(void **state) {
    (void)state;
    assert_failed_well("no-permission", "/dev/spidev0.0: Permission denied", "60-tuile.rules");
    assert_failed_well("no-permission-for-lines", "gpiochip0: Permission denied", "60-tuile.rules");
}

/* The line that ended it, and what the next program finds. */
static void test_an_interrupt_leaves_the_panel_dark_and_the_lines_free(void **state) {
    (void)state;
    guest_assert_code("interrupted", 128 + 2);
    guest_assert_text("panels", ".err", ""); /* among others: a light that is left on */
    guest_assert_code("after-interrupt", 0);
    assert_session(5, "card --panel st7735-80x160", 0);
}

/* The same for what a USB display showed last, if it refused nothing: the 16 bits that went over the wire, which each model widens
 * in its own way. */
static void assert_usb(const char *name, const char *arguments, unsigned frame) {
    char device[64];

    (void)snprintf(device, sizeof device, "%s-device", name);
    guest_assert_code(name, 0);
    guest_assert_code(device, 0);
    guest_assert_text(device, ".err", "");
    assert_simulated(device, arguments, 0, frame, 0xF8FCF8);
}

/* 160 x 120 x 2 bytes a frame. */
static void test_two_frames_by_way_of_the_kernels_usb(void **state) {
    (void)state;
    assert_usb("gud", ROOM " --frames 2 --spin 20 --size 160x120 --format rgb565le", 1);
    assert_int_equal(guest_number("gud-device", ".out", "pixel bytes "), 2 * 160 * 120 * 2);
    assert_true(guest_number("gud-device", ".out", "updates ") > 2); /* parts of the frames */
    assert_true(guest_number("gud-device", ".out", "status reads ") > 0);
}

/* The second frame is the simulator's though only parts of it were sent. */
static void test_only_what_has_changed_is_sent(void **state) {
    unsigned long bytes;

    (void)state;
    assert_usb("gud-parts", "render tests/models/beams.obj --frames 2 --spin 5 --size 160x120 --format rgb565le", 1);
    bytes = guest_number("gud-parts-device", ".out", "pixel bytes ");
    assert_true(bytes > 160 * 120 * 2 && bytes < 2 * 160 * 120 * 2);
}

static void test_compressed(void **state) {
    (void)state;
    assert_usb("gud-lz4", ROOM " --size 160x120 --format rgb565le", 0);
    assert_int_equal(guest_number("gud-lz4-device", ".out", "pixel bytes "), 160 * 120 * 2);
    assert_true(guest_number("gud-lz4-device", ".out", "bulk bytes ") < 160 * 120 * 2);
}

static void test_a_photo_frame(void **state) {
    (void)state;
    assert_usb("ax206", ROOM " --size 240x160 --format rgb565le", 0);
}

static void test_unplugged_within_a_frame(void **state) {
    (void)state;
    assert_failed_well("gud-unplugged", "frame 0: display: the device is gone; open it anew: usb 1-", NULL);
    assert_int_equal(guest_number("gud-unplugged-device", ".out", "bulks "), 3);
}

static void test_a_device_that_hangs(void **state) {
    (void)state;
    assert_failed_well("gud-hung", "frame 0: display: a transfer or the tearing-effect line timed out: usb 1-", NULL);
    assert_int_equal(guest_number("gud-hung-device", ".out", "unlinks "), 1); /* taken back, once */
}

static void test_no_usb_display(void **state) {
    (void)state;
    assert_failed_well("gud-none", "no GUD display", NULL);
    assert_failed_well("gud-denied", "ermission", "60-tuile.rules");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_frame_on_a_panel_with_offsets),
        cmocka_unit_test(test_a_card_on_a_display_of_dots),
        cmocka_unit_test(test_a_frame_on_an_ili9341_held_sideways),
        cmocka_unit_test(test_displays_tells_what_is_attached),
        cmocka_unit_test(test_displays_tells_what_users_may_not_have),
        cmocka_unit_test(test_what_is_not_there),
        cmocka_unit_test(test_lines_in_use),
        cmocka_unit_test(test_no_permission),
        cmocka_unit_test(test_an_interrupt_leaves_the_panel_dark_and_the_lines_free),
        cmocka_unit_test(test_two_frames_by_way_of_the_kernels_usb),
        cmocka_unit_test(test_only_what_has_changed_is_sent),
        cmocka_unit_test(test_compressed),
        cmocka_unit_test(test_a_photo_frame),
        cmocka_unit_test(test_unplugged_within_a_frame),
        cmocka_unit_test(test_a_device_that_hangs),
        cmocka_unit_test(test_no_usb_display),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
