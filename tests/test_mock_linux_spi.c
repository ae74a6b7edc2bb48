/* A panel on a Linux board: plain spidev calls and the real libgpiod, a made-up kernel behind them, and a model of the panel's
 * chip at the end. What is drawn is what is seen; sizes, clocks and levels are as they have to be. */
#include "support/check.h"

#include "../hal/panels/ili9341.h"
#include "../sim/bus.h"
#include "mock/linux.h"
#include "support/board.h"
#include "support/random.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spidev.h>

static mock_linux_t mock; /* cleared by open_board */
static tuile_linux_t port;

static void open_board(const char *panel, uint32_t bufsiz, const tuile_linux_config_t *config) {
    tuile_linux_close(&port); /* after a test that failed */
    mock = (mock_linux_t){.bufsiz = bufsiz};
    mock_linux_open(&mock, panel);
    if (mock_linux_port(&mock, &port, config)) { fail_msg("%s", port.fault.text); }
}

static void close_board(void) {
    tuile_linux_close(&port);
    assert_string_equal(mock.misuse.text, "");
    assert_int_equal(mock_linux_descriptors(&mock), 0);
    assert_int_equal(mock_linux_held(&mock), 0);
    mock_linux_close(&mock);
}

/* ---- pictures --------------------------------------------------------------------------------------------------- */

static void check_seen(uint8_t rotation, uint8_t wire) {
    sim_picture_t seen = mock_linux_picture(&mock, rotation);

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
        tuile_display_t display;
        tuile_linux_config_t config = mock_linux_config();
        const uint8_t rotation = i % 4, wire = i % 2 ? TUILE_WIRE_RGB666 : TUILE_WIRE_RGB565;

        config.no_worker = i % 3 == 2;
        open_board("ili9341", sizes[i], &config);
        assert_int_equal(tuile_display_init(
                             &display,
                             &(tuile_display_config_t){
                                 .bus = &port.bus, .panel = &tuile_ili9341, .rotation = rotation, .wire = wire, .identify = true}),
                         0);
        assert_int_equal(board_draw(&display, wire, 120, 40), 0);
        check_seen(rotation, wire);
        assert_int_equal(tuile_display_close(&display), 0);
        close_board();
    }
}

/* Two windows of noise. */
static sim_picture_t draw_noise(tuile_display_t *display, const tuile_bus_t *bus, const tuile_panel_t *panel, uint8_t rotation,
                                sim_picture_t (*look)(const void *), const void *looked_at) {
    static uint8_t bytes[320 * 480 * 4];
    random_source_t noise = random_seed(77);
    uint32_t half;
    size_t size_bytes;
    sim_picture_t seen;

    for (size_t i = 0; i < sizeof bytes; i++) {
        bytes[i] = (uint8_t)random_bits(&noise);
    }
    assert_int_equal(tuile_display_init(display, &(tuile_display_config_t){.bus = bus, .panel = panel, .rotation = rotation}), 0);
    half = display->width / 2u / display->align_x * display->align_x;
    size_bytes = (size_t)half * display->height * tuile_wire_bits(display->wire) / 8u;
    assert_int_equal(tuile_display_window(display, 0, 0, half, display->height), 0);
    assert_int_equal(tuile_display_write(display, bytes, size_bytes), 0);
    assert_int_equal(tuile_display_window(display, half, 0, display->width - half, display->height), 0);
    size_bytes = (size_t)(display->width - half) * display->height * tuile_wire_bits(display->wire) / 8u;
    assert_int_equal(tuile_display_write(display, bytes + 1, size_bytes), 0);
    assert_int_equal(tuile_display_present(display), 0);
    seen = look(looked_at);
    assert_int_equal(tuile_display_close(display), 0);
    return seen;
}

static sim_picture_t look_at_mock(const void *context) { return mock_linux_picture(context, 0); }

static sim_picture_t look_at_bus(const void *context) {
    sim_picture_t seen;

    assert_int_equal(sim_bus_picture(context, 0, &seen, NULL), 0);
    return seen;
}

/* Bit for bit: every panel that the simulator knows. */
static void every_panel_shows_what_the_simulator_shows(void **state) {
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    for (size_t i = 0; i < sim_panel_count; i++) {
        const sim_panel_t *panel = &sim_panels[i];
        sim_error_t error = {""};
        sim_chip_t *chip = panel->create(&error);
        sim_bus_t bus;
        tuile_display_t display;
        sim_picture_t expected, seen;

        sim_bus_open(&bus, NULL, chip);
        expected = draw_noise(&display, &bus.bus, panel->panel, (uint8_t)(i % 4), look_at_bus, &bus);
        open_board(panel->panel->name, 0, &config);
        seen = draw_noise(&display, &port.bus, panel->panel, (uint8_t)(i % 4), look_at_mock, &mock);
        assert_int_equal(seen.width, expected.width);
        assert_int_equal(seen.height, expected.height);
        if (memcmp(seen.rgb, expected.rgb, (size_t)seen.width * seen.height * 3u) != 0) { fail_msg("%s", panel->panel->name); }
        close_board();
        sim_picture_free(&seen);
        sim_picture_free(&expected);
        chip->destroy(chip);
    }
}

/* ---- sizes ------------------------------------------------------------------------------------------------------ */

/* Whole pixels of 2 and of 3 bytes: multiples of 6, the largest that bufsiz allows where the kernel counts each transfer rounded up
 * to 128 bytes. A bufsiz that is no multiple of it, 1000 or 65535, had full chunks refused. */
static void data_are_cut_to_bufsiz(void **state) {
    static const struct {
        uint32_t bufsiz, size_bytes, pieces, first, last;
    } cases[] = {
        {4096, 10000, 3, 4092, 1816}, {4095, 10000, 3, 3966, 2068},
        {0, 10000, 3, 4092, 1816},    {65536, 10000, 1, 10000, 10000},
        {6, 600, 100, 6, 6},          {7, 14, 3, 6, 2},
        {1000, 2000, 3, 894, 212},    {4097, 4093, 2, 4092, 1},
        {4092, 4092, 2, 3966, 126},   {11, 24, 4, 6, 6},
        {20000, 20000, 2, 19968, 32}, {16383, 20000, 2, 16254, 3746},
    };
    static uint8_t bytes[20000];
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        open_board("ili9341", cases[i].bufsiz, &config);
        assert_int_equal(port.bus.max_chunk_bytes, 0);
        assert_int_equal(port.bus.data(port.bus.context, bytes, cases[i].size_bytes), 0);
        assert_int_equal(port.bus.wait(port.bus.context), 0);
        assert_int_equal(mock.transfers, cases[i].pieces);
        for (unsigned k = 0; k < mock.transfers; k++) {
            assert_int_equal(mock.log[k].size_bytes, k + 1 < mock.transfers ? cases[i].first : cases[i].last);
            assert_int_equal(mock.log[k].count, 1);
        }
        mock.misuse.text[0] = '\0'; /* the chip asked for a command first */
        close_board();
    }
}

static void bufsiz_too_small_for_a_pixel(void **state) {
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    mock = (mock_linux_t){.bufsiz = 5};
    mock_linux_open(&mock, "ili9341");
    assert_int_equal(tuile_linux_open(&port, &config), TUILE_HAL_SIZE);
    assert_string_equal(port.fault.text, "/dev/spidev0.0: spidev's bufsiz is 5 bytes, which holds no pixels");
    close_board();
}

/* The parameter may have been written to since the module was loaded. */
/* A parameter that tells nothing is taken for spidev's usual one. */
static void bufsiz_that_is_no_number(void **state) {
    static const char *const texts[] = {"", "none\n", "0\n"};

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(texts); i++) {
        mock = (mock_linux_t){.bufsiz_text = texts[i]};
        mock_linux_open(&mock, "ili9341");
        assert_int_equal(tuile_linux_spi_bufsiz(), 4096);
        close_board();
    }
}

/* Programs that this one starts do not hold the bus, and looking whether it is there holds nothing. */
static void descriptors_are_neither_inherited_nor_left(void **state) {
    const tuile_linux_config_t config = mock_linux_config();
    tuile_linux_fault_t fault;

    (void)state;
    open_board("ili9341", 0, &config);
    assert_true(fcntl(port.spi.fd, F_GETFD) & FD_CLOEXEC);
    tuile_linux_close(&port);
    assert_int_equal(tuile_linux_spi_probe(config.spi, &fault), 0);
    assert_int_equal(mock_linux_descriptors(&mock), 0);
    assert_int_equal(tuile_linux_spi_probe("/dev/null", &fault), TUILE_HAL_NOT_FOUND); /* it is there, but no bus */
    close_board();
}

static void message_larger_than_the_kernel_takes(void **state) {
    static const uint8_t bytes[4000] = {0};
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    open_board("ili9341", 4096, &config);
    mock.real_bufsiz = 2048;
    assert_int_equal(port.bus.data(port.bus.context, bytes, sizeof bytes), 0);
    assert_int_equal(port.bus.wait(port.bus.context), TUILE_HAL_SIZE);
    assert_string_equal(port.fault.text, "/dev/spidev0.0: 4000 bytes: Message too long");
    assert_int_equal(port.bus.wait(port.bus.context), 0); /* told once */
    close_board();
}

/* ---- clocks, levels, modes -------------------------------------------------------------------------------------- */

static void check_transfer(unsigned i, bool dc, uint32_t size_bytes, uint32_t clock_hz, uint8_t first) {
    assert_int_equal(mock.log[i].dc, dc);
    assert_int_equal(mock.log[i].size_bytes, size_bytes);
    assert_int_equal(mock.log[i].clock_hz, clock_hz);
    assert_int_equal(mock.log[i].bits, 8);
    assert_int_equal(mock.log[i].first, first);
}

static void commands_are_slow_and_pixels_fast(void **state) {
    static const uint8_t gamma[2] = {0x26, 0x01}, window[5] = {0x2A, 0, 3, 0, 7}, write_memory[1] = {0x2C}, pixels[20] = {0xAB};

    (void)state;
    for (unsigned threads = 0; threads < 2; threads++) {
        tuile_linux_config_t config = mock_linux_config();
        unsigned calls;

        config.no_worker = threads == 0;
        open_board("ili9341", 0, &config);
        mock.calls = 0;
        assert_int_equal(port.bus.clocks(port.bus.context, 9000000, 62500000), 0);
        assert_int_equal(port.bus.command(port.bus.context, gamma, 1, 2), 0);
        assert_int_equal(port.bus.command(port.bus.context, window, 1, 5), 0);
        assert_int_equal(port.bus.command(port.bus.context, write_memory, 1, 1), 0);
        for (unsigned i = 0; i < 2; i++) {
            assert_int_equal(port.bus.data(port.bus.context, pixels, 20), 0);
            if (port.bus.wait) { assert_int_equal(port.bus.wait(port.bus.context), 0); }
        }
        assert_true((port.bus.wait == NULL) == (threads == 0));
        assert_int_equal(mock.transfers, 7);
        check_transfer(0, false, 1, 9000000, 0x26);
        check_transfer(1, true, 1, 9000000, 0x01);
        check_transfer(2, false, 1, 9000000, 0x2A);
        check_transfer(3, true, 4, 9000000, 0);
        check_transfer(4, false, 1, 9000000, 0x2C);
        check_transfer(5, true, 20, 62500000, 0xAB);
        check_transfer(6, true, 20, 62500000, 0xAB);
        /* 7 messages; D/C is low, high, low, high, low, high, and is high already for the last */
        assert_int_equal(mock.calls, 7 + 6);

        /* parameters that are sent with D/C low are one transfer with their command */
        calls = mock.calls;
        assert_int_equal(port.bus.command(port.bus.context, gamma, 2, 2), 0);
        check_transfer(7, false, 2, 9000000, 0x26);
        assert_int_equal(mock.calls, calls + 2);
        mock.misuse.text[0] = '\0'; /* the ILI9341 does not take them so */

        assert_int_equal(port.bus.command(port.bus.context, gamma, 0, 2), TUILE_HAL_ARGUMENT);
        assert_int_equal(port.bus.command(port.bus.context, gamma, 3, 2), TUILE_HAL_ARGUMENT);
        assert_int_equal(port.bus.command(port.bus.context, pixels, 1, 65), TUILE_HAL_ARGUMENT);
        assert_int_equal(mock.calls, calls + 2);
        close_board();
    }
}

static void flags_of_the_device_tree_stay(void **state) {
    static const struct {
        uint32_t before;
        uint8_t mode;
        uint32_t after;
    } cases[] = {
        {0, 0, 0},
        {0, 3, SPI_CPOL | SPI_CPHA},
        {SPI_MODE_3, 0, 0},
        {SPI_CS_HIGH | SPI_3WIRE | SPI_MODE_1, 2, SPI_CS_HIGH | SPI_3WIRE | SPI_MODE_2},
        {SPI_NO_CS | SPI_LSB_FIRST, 0, SPI_NO_CS}, /* another program has left it so; panels take the highest bit first */
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        tuile_linux_config_t config = mock_linux_config();

        config.mode = cases[i].mode;
        mock = (mock_linux_t){.mode = cases[i].before};
        mock_linux_open(&mock, "ili9341");
        assert_int_equal(tuile_linux_open(&port, &config), 0);
        assert_int_equal(mock.mode, cases[i].after);
        close_board();
    }
}

/* ---- reading ---------------------------------------------------------------------------------------------------- */

static void answers_come_without_the_dummy_clocks(void **state) {
    /* On the wire: eight ones, then 00 93 41; a one, then 00 93 41; 5A at once. */
    static const uint8_t id4[] = {0xFF, 0x00, 0x93, 0x41}, id[] = {0x80, 0x49, 0xA0, 0x80}, plain[] = {0x5A};
    static const struct {
        uint8_t command;
        const uint8_t *wire;
        size_t wire_bytes, size_bytes;
        uint8_t expected[3];
    } cases[] = {
        {0xD3, id4, 4, 3, {0x00, 0x93, 0x41}},
        {0x04, id, 4, 3, {0x00, 0x93, 0x41}},
        {0x09, id, 4, 3, {0x00, 0x93, 0x41}},
        {0xDA, plain, 1, 1, {0x5A}},
    };
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        uint8_t bytes[3] = {0};

        open_board("ili9341", 0, &config);
        mock.reply = cases[i].wire;
        assert_int_equal(port.bus.clocks(port.bus.context, i == 3 ? 1500000 : 10000000, 40000000), 0);
        assert_int_equal(port.bus.read(port.bus.context, cases[i].command, bytes, cases[i].size_bytes), 0);
        assert_memory_equal(bytes, cases[i].expected, cases[i].size_bytes);
        /* one message, so that chip select is held; slower than commands */
        assert_int_equal(mock.transfers, 2);
        assert_int_equal(mock.log[0].count, 2);
        check_transfer(0, false, 1, i == 3 ? 1500000 : 2000000, cases[i].command);
        check_transfer(1, false, (uint32_t)cases[i].wire_bytes, i == 3 ? 1500000 : 2000000, 0);
        close_board();
    }
    open_board("ili9341", 0, &config);
    mock.calls = 0;
    assert_int_equal(port.bus.read(port.bus.context, 0xDA, (uint8_t[1]){0}, 0), TUILE_HAL_ARGUMENT);
    assert_int_equal(port.bus.read(port.bus.context, 0xDA, (uint8_t[17]){0}, 17), TUILE_HAL_ARGUMENT);
    assert_int_equal(mock.calls, 0);
    close_board();
}

static void another_panel_is_told(void **state) {
    static const uint8_t other[] = {0, 0, 0x94, 0x88}, nobody[] = {0xFF, 0xFF, 0xFF, 0xFF};
    const tuile_linux_config_t config = mock_linux_config();
    tuile_display_t display;

    (void)state;
    open_board("ili9341", 0, &config);
    mock.reply = other;
    assert_int_equal(
        tuile_display_init(&display, &(tuile_display_config_t){.bus = &port.bus, .panel = &tuile_ili9341, .identify = true}),
        TUILE_HAL_IDENTITY);
    mock.reply = nobody;
    assert_int_equal(
        tuile_display_init(&display, &(tuile_display_config_t){.bus = &port.bus, .panel = &tuile_ili9341, .identify = true}),
        TUILE_HAL_PROTOCOL);
    close_board();
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(ili9341_shows_what_is_drawn),
        cmocka_unit_test(every_panel_shows_what_the_simulator_shows),
        cmocka_unit_test(data_are_cut_to_bufsiz),
        cmocka_unit_test(bufsiz_too_small_for_a_pixel),
        cmocka_unit_test(bufsiz_that_is_no_number),
        cmocka_unit_test(descriptors_are_neither_inherited_nor_left),
        cmocka_unit_test(message_larger_than_the_kernel_takes),
        cmocka_unit_test(commands_are_slow_and_pixels_fast),
        cmocka_unit_test(flags_of_the_device_tree_stay),
        cmocka_unit_test(answers_come_without_the_dummy_clocks),
        cmocka_unit_test(another_panel_is_told),
    };
    print_message("libgpiod %s, a made-up kernel\n", tuile_linux_gpiod_version());
    return cmocka_run_group_tests_name("a panel on spidev", tests, NULL, mock_linux_end);
}
