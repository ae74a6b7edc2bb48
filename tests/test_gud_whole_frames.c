/* The model of a GUD display whose updates are whole frames, without announcement; found by the kernel's own driver. */
#include "support/check.h"

#include "../sim/usb/gud_model.h"

enum { WIDTH = 16, HEIGHT = 4, FRAME_BYTES = WIDTH * HEIGHT * 2 };

static int set(sim_usb_t *usb, uint8_t request, const void *bytes, size_t size_bytes) {
    const uint8_t setup[8] = {0x41, request, 0, 0, 0, 0, (uint8_t)size_bytes, 0};
    uint8_t data[64] = {0};

    if (size_bytes > 0) { memcpy(data, bytes, size_bytes); }
    return sim_usb_control(usb, setup, data, size_bytes);
}

/* Mode set in the kernel's order: check, controller on, commit, display on. */
static void show_rgb565(sim_usb_t *usb) {
    static const uint8_t modes[8] = {0xC1, 0x55, 0, 0, 0, 0, 24, 0}, on = 1;
    uint8_t state[26] = {[24] = SIM_GUD_RGB565};

    assert_int_equal(sim_usb_control(usb, modes, state, 24), 24);
    assert_int_equal(set(usb, 0x61, state, sizeof state), sizeof state);
    assert_int_equal(set(usb, 0x63, &on, 1), 1);
    assert_int_equal(set(usb, 0x62, NULL, 0), 0);
    assert_int_equal(set(usb, 0x64, &on, 1), 1);
}

static void test_the_second_whole_frame_was_refused(void **state) {
    sim_gud_config_t config = {.width = WIDTH, .height = HEIGHT, .full_update = true};
    sim_usb_t *usb = sim_gud_create(&config, NULL);
    uint8_t frame[FRAME_BYTES];
    sim_picture_t picture;

    (void)state;
    assert_non_null(usb);
    show_rgb565(usb);
    for (unsigned i = 0; i < 3; i++) {
        memset(frame, i == 1 ? 0x00 : 0xFF, sizeof frame);
        if (sim_usb_bulk(usb, 1, frame, sizeof frame) != FRAME_BYTES) { fail_msg("frame %u: %s", i, usb->fault.text); }
        assert_int_equal(usb->picture(usb, &picture, NULL), 0);
        assert_int_equal(picture.rgb[0], i == 1 ? 0 : 255);
        assert_int_equal(picture.rgb[WIDTH * HEIGHT * 3 - 1], i == 1 ? 0 : 255);
        sim_picture_free(&picture);
    }
    assert_int_equal(sim_gud_counts(usb)->updates, 3);
    usb->destroy(usb);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_the_second_whole_frame_was_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
