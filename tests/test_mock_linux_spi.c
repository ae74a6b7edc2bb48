/* A panel on a Linux board: plain spidev calls and the real libgpiod, a made-up kernel behind them, and a model of the panel's
 * chip at the end. What is drawn is what is seen; sizes, clocks and levels are as they have to be. */
#include "support/check.h"

#include "../hal/panels/ili9341.h"
#include "mock/linux.h"
#include "support/board.h"

#include <errno.h>

/* ---- pictures --------------------------------------------------------------------------------------------------- */

static void check_seen(const mock_linux_t *mock, uint8_t rotation, uint8_t wire) {
    sim_picture_t seen = mock_linux_picture(mock, rotation);

    assert_int_equal(seen.width, rotation & 1 ? 320 : 240);
    for (uint32_t y = 0; y < seen.height; y++) {
        for (uint32_t x = 0; x < seen.width; x++) {
            board_check_pixel(sim_picture_at(&seen, x, y), wire, board_colour(seen.width, x, y));
        }
    }
    sim_picture_free(&seen);
}

static void ili9341_shows_what_is_drawn(void **state) {
    static const uint32_t sizes[] = {0, 4096, 4095, 65536, 1000, 1000000};

    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(sizes); i++) {
        static mock_linux_t mock;
        tuile_linux_t port;
        tuile_display_t display;
        tuile_linux_config_t config = mock_linux_config();
        const uint8_t rotation = i % 4, wire = i % 2 ? TUILE_WIRE_RGB666 : TUILE_WIRE_RGB565;

        memset(&mock, 0, sizeof mock);
        mock.bufsiz = sizes[i];
        mock_linux_open(&mock, "ili9341");
        config.no_worker = i % 3 == 2;
        assert_int_equal(mock_linux_port(&mock, &port, &config), 0);
        assert_int_equal(tuile_display_init(
                             &display,
                             &(tuile_display_config_t){
                                 .bus = &port.bus, .panel = &tuile_ili9341, .rotation = rotation, .wire = wire, .identify = true}),
                         0);
        assert_int_equal(board_draw(&display, wire, 120, 40), 0);
        assert_string_equal(mock.misuse.text, "");
        check_seen(&mock, rotation, wire);
        assert_int_equal(tuile_display_close(&display), 0);
        tuile_linux_close(&port);
        assert_int_equal(mock_linux_descriptors(&mock), 0);
        mock_linux_close(&mock);
    }
}

int main(void) {
    static const struct CMUnitTest tests[] = {cmocka_unit_test(ili9341_shows_what_is_drawn)};
    return cmocka_run_group_tests_name("a panel on spidev", tests, NULL, NULL);
}
