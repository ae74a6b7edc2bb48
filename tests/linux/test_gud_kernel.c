/* What the kernel's own driver of GUD displays drew on the model of one: the pattern of pattern.h, a frame and then a part of
 * another, by way of each format. Expected pixels are what the driver's conversions make of the pattern: components are cut off,
 * and grey is (3 red + 6 green + blue) / 10. */
#include "../support/check.h"

#include "../../sim/picture.h"
#include "guest.h"
#include "pattern.h"

enum { WIDTH = 70, HEIGHT = 66 };

static unsigned grey_of(uint32_t rgb) { return (3 * (rgb >> 16) + 6 * (rgb >> 8 & 255) + (rgb & 255)) / 10; }

/* What 8 bits are after a way through fewer of them: the highest repeated downwards. */
static unsigned through_1(unsigned value) { return value >= 128 ? 255 : 0; }
static unsigned through_2(unsigned value) { return (value >> 6) * 85; }
static unsigned through_3(unsigned value) { return (value >> 5) << 5 | (value >> 5) << 2 | value >> 6; }
static unsigned through_5(unsigned value) { return (value >> 3) << 3 | value >> 5; }
static unsigned through_6(unsigned value) { return (value >> 2) << 2 | value >> 6; }

static void expect(unsigned format, uint32_t rgb, uint8_t out[3]) {
    unsigned red = rgb >> 16, green = rgb >> 8 & 255, blue = rgb & 255;

    switch (format) {
    case 0x01: red = green = blue = through_1(grey_of(rgb)); break;
    case 0x08: red = green = blue = grey_of(rgb); break;
    case 0x20:
        red = through_1(red);
        green = through_1(green);
        blue = through_1(blue);
        break;
    case 0x30:
        red = through_3(red);
        green = through_3(green);
        blue = through_2(blue);
        break;
    case 0x40:
        red = through_5(red);
        green = through_6(green);
        blue = through_5(blue);
        break;
    default: break;
    }
    out[0] = (uint8_t)red;
    out[1] = (uint8_t)green;
    out[2] = (uint8_t)blue;
}

/* The second frame's part begins on a whole byte: the driver moves its left side there, and takes what the buffer holds. */
static bool in_part(uint32_t x, uint32_t y) {
    return x >= PATTERN_LEFT && x < PATTERN_RIGHT && y >= PATTERN_TOP && y < PATTERN_BOTTOM;
}

static void assert_arrived(const char *name, unsigned format) {
    sim_picture_t picture;
    sim_error_t error;
    char device[64];

    (void)snprintf(device, sizeof device, "%s-device", name);
    guest_assert_code(name, 0);
    guest_assert_text(name, ".out", "70x66\n");
    guest_assert_code(device, 0);
    guest_assert_text(device, ".err", ""); /* nothing that the model refused */
    if (sim_picture_read(&picture, guest_path(device, ".ppm"), &error)) { fail_msg("%s", error.text); }
    assert_int_equal(picture.width, WIDTH);
    assert_int_equal(picture.height, HEIGHT);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            uint8_t expected[3];
            expect(format, pattern_pixel(x, y, in_part(x, y)), expected);
            if (memcmp(sim_picture_at(&picture, x, y), expected, 3) != 0) {
                const uint8_t *is = sim_picture_at(&picture, x, y);
                fail_msg("%s: pixel %u,%u is %02x%02x%02x, not %02x%02x%02x", name, x, y, is[0], is[1], is[2], expected[0],
                         expected[1], expected[2]);
            }
        }
    }
    sim_picture_free(&picture);
}

static void test_r1(void **state) {
    (void)state;
    assert_arrived("gud-01", 0x01);
}

static void test_r8(void **state) {
    (void)state;
    assert_arrived("gud-08", 0x08);
}

static void test_xrgb1111(void **state) {
    (void)state;
    assert_arrived("gud-20", 0x20);
}

static void test_rgb332(void **state) {
    (void)state;
    assert_arrived("gud-30", 0x30);
}

static void test_rgb565(void **state) {
    (void)state;
    assert_arrived("gud-40", 0x40);
}

static void test_rgb888(void **state) {
    (void)state;
    assert_arrived("gud-50", 0x50);
}

static void test_xrgb8888(void **state) {
    (void)state;
    assert_arrived("gud-80", 0x80);
}

static void test_compressed(void **state) {
    (void)state;
    assert_arrived("gud-lz4", 0x40);
    assert_int_equal(guest_number("gud-lz4-device", ".out", "updates "), 2);
    assert_true(guest_number("gud-lz4-device", ".out", "compressed ") >= 1);
    assert_true(guest_number("gud-lz4-device", ".out", "bulk bytes ") < guest_number("gud-lz4-device", ".out", "pixel bytes "));
}

static void test_status_after_each_set(void **state) {
    (void)state;
    assert_arrived("gud-status", 0x40);
    /* Check, controller on, commit, display on, two buffers at least. */
    assert_true(guest_number("gud-status-device", ".out", "status reads ") >= 6);
}

/* 70 x 66 x 2 = 9 240 bytes in 7 lines at a time, 10 updates; 28 x 22 in 17 lines, 2. */
static void test_split_by_lines(void **state) {
    (void)state;
    assert_arrived("gud-split", 0x40);
    assert_int_equal(guest_number("gud-split-device", ".out", "updates "), 12);
}

static void test_whole_frames(void **state) {
    (void)state;
    assert_arrived("gud-full", 0x40);
    assert_int_equal(guest_number("gud-full-device", ".out", "updates "), 2);
    assert_int_equal(guest_number("gud-full-device", ".out", "pixel bytes "), 2 * WIDTH * HEIGHT * 2);
}

static void test_a_part_is_all_that_is_sent(void **state) {
    (void)state;
    assert_int_equal(guest_number("gud-40-device", ".out", "updates "), 2);
    assert_int_equal(guest_number("gud-40-device", ".out", "pixel bytes "),
                     (WIDTH * HEIGHT + (PATTERN_RIGHT - PATTERN_LEFT) * (PATTERN_BOTTOM - PATTERN_TOP)) * 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_r1),
        cmocka_unit_test(test_r8),
        cmocka_unit_test(test_xrgb1111),
        cmocka_unit_test(test_rgb332),
        cmocka_unit_test(test_rgb565),
        cmocka_unit_test(test_rgb888),
        cmocka_unit_test(test_xrgb8888),
        cmocka_unit_test(test_compressed),
        cmocka_unit_test(test_status_after_each_set),
        cmocka_unit_test(test_split_by_lines),
        cmocka_unit_test(test_whole_frames),
        cmocka_unit_test(test_a_part_is_all_that_is_sent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
