/* GPIO lines through the real libgpiod, a made-up kernel behind it: levels from the first to the last, edges, and what is said when
 * a line cannot be had. */
#include "support/check.h"

#include "mock/linux.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static mock_linux_t mock;
static tuile_linux_t port;

static void open_mock(void) {
    tuile_linux_close(&port); /* after a test that failed */
    mock = (mock_linux_t){0};
    mock_linux_open(&mock, "ili9341");
}

static void close_mock(void) {
    tuile_linux_close(&port);
    assert_string_equal(mock.misuse.text, "");
    assert_int_equal(mock_linux_descriptors(&mock), 0);
    assert_int_equal(mock_linux_held(&mock), 0);
    mock_linux_close(&mock);
}

/* ---- levels ----------------------------------------------------------------------------------------------------- */

static void lines_begin_running_and_dark(void **state) {
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    open_mock();
    mock.level[MOCK_BACKLIGHT] = true;
    assert_int_equal(tuile_linux_open(&port, &config), 0);
    assert_int_equal(mock_linux_held(&mock), 3);
    /* the device and three lines; libgpiod 1 keeps the chip open for each */
    assert_int_equal(mock_linux_descriptors(&mock), tuile_linux_gpiod_version()[0] == '1' ? 7 : 4);
    assert_true(mock.level[MOCK_DC]);
    assert_true(mock.level[MOCK_RESET]);
    assert_false(mock.level[MOCK_BACKLIGHT]);
    assert_string_equal(mock.requests[MOCK_DC].consumer, "tuile");
    assert_int_equal(port.bus.pins, TUILE_PIN_BIT(TUILE_PIN_RESET) | TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT));
    assert_null(port.bus.tearing);
    close_mock();
}

static void pins_follow(void **state) {
    static const struct {
        uint8_t level;
        bool line;
    } cases[] = {{0, false}, {1, true}, {0, false}, {128, true}, {255, true}};

    (void)state;
    for (unsigned low = 0; low < 2; low++) {
        tuile_linux_config_t config = mock_linux_config();

        config.consumer = "lamp";
        config.reset.active_low = config.backlight.active_low = config.dc.active_low = low;
        open_mock();
        mock.level[MOCK_RESET] = !low;
        assert_int_equal(tuile_linux_open(&port, &config), 0);
        assert_int_equal(mock.level[MOCK_DC], !low);
        assert_int_equal(mock.level[MOCK_RESET], !low);
        assert_int_equal(mock.level[MOCK_BACKLIGHT], low);
        assert_string_equal(mock.requests[MOCK_RESET].consumer, "lamp");
        for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
            assert_int_equal(port.bus.pin(port.bus.context, TUILE_PIN_BACKLIGHT, cases[i].level), 0);
            assert_int_equal(mock.level[MOCK_BACKLIGHT], cases[i].line != low);
            assert_int_equal(mock.level[MOCK_RESET], !low);
            mock.now_ns += 1000000; /* the chip wants 10 us of reset */
        }
        for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
            assert_int_equal(port.bus.pin(port.bus.context, TUILE_PIN_RESET, cases[i].level), 0);
            assert_int_equal(mock.level[MOCK_RESET], cases[i].line != low);
            assert_int_equal(mock.level[MOCK_BACKLIGHT], !low);
            mock.now_ns += 1000000;
        }
        close_mock();
    }
}

static void lines_that_are_not_connected_are_not_asked_for(void **state) {
    tuile_linux_config_t config = mock_linux_config();

    (void)state;
    config.reset.chip = config.backlight.chip = NULL;
    open_mock();
    assert_int_equal(tuile_linux_open(&port, &config), 0);
    assert_int_equal(port.bus.pins, 0);
    assert_int_equal(mock_linux_held(&mock), 1);
    close_mock();
    config.backlight.chip = "gpiochip0";
    open_mock();
    assert_int_equal(tuile_linux_open(&port, &config), 0);
    assert_int_equal(port.bus.pins, TUILE_PIN_BIT(TUILE_PIN_BACKLIGHT));
    assert_int_equal(mock_linux_held(&mock), 2);
    close_mock();
}

/* ---- what cannot be had ----------------------------------------------------------------------------------------- */

static void check_refused(const tuile_linux_config_t *config, int code, const char *text) {
    const int result = tuile_linux_open(&port, config);

    if (result != code || strcmp(port.fault.text, text) != 0) {
        fail_msg("%d '%s', not %d '%s'", result, port.fault.text, code, text);
    }
    assert_null(port.bus.command);
    assert_int_equal(mock_linux_descriptors(&mock), 0);
    assert_int_equal(mock_linux_held(&mock), 0);
}

static void each_refusal_has_a_code_and_a_line(void **state) {
    const tuile_linux_config_t good = mock_linux_config();
    tuile_linux_config_t config = good;

    (void)state;
    open_mock();
    config.spi = NULL;
    check_refused(&config, TUILE_HAL_ARGUMENT, "spi: no device named");
    config.spi = "/dev/spidev9.0";
    check_refused(&config, TUILE_HAL_NOT_FOUND, "/dev/spidev9.0: No such file or directory");
    config.spi = "/dev/null";
    check_refused(&config, TUILE_HAL_NOT_FOUND, "/dev/null: mode 0: Inappropriate ioctl for device");
    config = good;
    config.mode = 4;
    check_refused(&config, TUILE_HAL_ARGUMENT, "/dev/spidev0.0: SPI modes are 0 to 3");
    config = good;
    config.dc.chip = NULL;
    check_refused(&config, TUILE_HAL_ARGUMENT, "dc: a panel on SPI needs this line");
    config.dc.chip = "gpiochip9";
    check_refused(&config, TUILE_HAL_NOT_FOUND, "dc: gpiochip9: No such file or directory");
    config.dc.chip = "/dev/gpiochip9";
    check_refused(&config, TUILE_HAL_NOT_FOUND, "dc: /dev/gpiochip9: No such file or directory");
    config = good;
    config.reset.offset = MOCK_LINES;
    check_refused(&config, TUILE_HAL_NOT_FOUND, "reset: gpiochip0 has no line 54, only 0 to 53");
    config.reset.offset = UINT32_MAX;
    check_refused(&config, TUILE_HAL_NOT_FOUND, "reset: gpiochip0 has no line 4294967295, only 0 to 53");
    config.reset.offset = MOCK_TAKEN;
    check_refused(&config, TUILE_HAL_BUSY, "reset: line 8 of gpiochip0 is in use by spi0 CS0");
    config.reset.offset = MOCK_DC; /* named twice */
    config.consumer = "a lamp";
    check_refused(&config, TUILE_HAL_BUSY, "reset: line 25 of gpiochip0 is in use by a lamp");
    config = good;
    config.tearing = (tuile_linux_line_t){.chip = "gpiochip0", .offset = MOCK_TAKEN};
    check_refused(&config, TUILE_HAL_BUSY, "tearing: line 8 of gpiochip0 is in use by spi0 CS0");
    assert_int_equal(tuile_linux_open(&port, &good), 0); /* nothing was left behind */
    close_mock();
}

static void a_file_is_no_chip(void **state) {
    tuile_linux_config_t config = mock_linux_config();

    (void)state;
    open_mock();
    config.dc.chip = "/dev/null";
    assert_int_equal(tuile_linux_open(&port, &config), TUILE_HAL_NOT_FOUND);
    assert_non_null(strstr(port.fault.text, "dc: /dev/null: "));
    close_mock();
}

static void names_that_are_too_long(void **state) {
    tuile_linux_config_t config = mock_linux_config();
    char name[200];

    (void)state;
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    open_mock();
    config.spi = name;
    assert_int_equal(tuile_linux_open(&port, &config), TUILE_HAL_ARGUMENT);
    config = mock_linux_config();
    config.dc.chip = name;
    assert_int_equal(tuile_linux_open(&port, &config), TUILE_HAL_ARGUMENT);
    close_mock();
}

/* As a user without rights: root has them all. The node is a file that nobody may open; the others are anybody's. */
static void check_forbidden(const char *node, const tuile_linux_config_t *config, const char *text) {
    char *root = umockdev_testbed_get_root_dir(mock.bed), line[300];
    const uid_t before = geteuid();
    FILE *file;

    (void)snprintf(line, sizeof line, "chmod -R a+rwX %s; chmod a+rw %s/dev/*; rm -f %s/dev/%s", root, root, root, node);
    assert_int_equal(system(line), 0);
    (void)snprintf(line, sizeof line, "%s/dev/%s", root, node);
    file = fopen(line, "w");
    assert_non_null(file);
    (void)fclose(file);
    assert_int_equal(chmod(line, 0), 0);
    if (before == 0) { assert_int_equal(seteuid(65534), 0); }
    check_refused(config, TUILE_HAL_PERMISSION, text);
    if (before == 0) { assert_int_equal(seteuid(before), 0); }
    g_free(root);
    close_mock();
    (void)mock_linux_end(NULL);
}

static void no_permission_names_the_rules(void **state) {
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    open_mock();
    check_forbidden("spidev0.0", &config,
                    "/dev/spidev0.0: Permission denied; hal/linux/60-tuile.rules lets users have it (make install-udev)");
    open_mock();
    check_forbidden("gpiochip0", &config,
                    "dc: gpiochip0: Permission denied; hal/linux/60-tuile.rules lets users have it (make install-udev)");
}

/* ---- edges ------------------------------------------------------------------------------------------------------ */

static uint64_t now_ms(void) {
    struct timespec now;

    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000u + (uint64_t)now.tv_nsec / 1000000u;
}

static void open_with_tearing(bool active_low) {
    tuile_linux_config_t config = mock_linux_config();

    config.tearing = (tuile_linux_line_t){"gpiochip0", MOCK_TEARING, active_low};
    open_mock();
    assert_int_equal(tuile_linux_open(&port, &config), 0);
    assert_true(mock.requests[MOCK_TEARING].edges);
    assert_int_equal(mock.requests[MOCK_TEARING].active_low, active_low);
    assert_non_null(port.bus.tearing);
}

static void no_edge_is_a_timeout(void **state) {
    uint64_t begin;

    (void)state;
    open_with_tearing(false);
    begin = now_ms();
    assert_int_equal(port.bus.tearing(port.bus.context, 30), TUILE_HAL_TIMEOUT);
    assert_in_range(now_ms() - begin, 29, 2000);
    assert_string_equal(port.fault.text, "tearing line: no edge within 30 ms");
    close_mock();
}

/* The blank of the frame before is over. The kernel keeps 16 edges. */
static void edges_of_the_past_are_forgotten(void **state) {
    (void)state;
    open_with_tearing(true);
    for (unsigned i = 0; i < 16; i++) {
        mock_linux_edge(&mock);
    }
    assert_int_equal(port.bus.tearing(port.bus.context, 20), TUILE_HAL_TIMEOUT);
    close_mock();
}

static void *edge_soon(void *argument) {
    (void)argument;
    (void)usleep(30000);
    mock_linux_edge(&mock);
    return NULL;
}

static void the_next_edge_ends_the_wait(void **state) {
    pthread_t thread;
    uint64_t begin;

    (void)state;
    open_with_tearing(false);
    mock_linux_edge(&mock);
    begin = now_ms();
    assert_int_equal(pthread_create(&thread, NULL, edge_soon, NULL), 0);
    assert_int_equal(port.bus.tearing(port.bus.context, 10000), 0);
    assert_in_range(now_ms() - begin, 29, 5000);
    assert_int_equal(pthread_join(thread, NULL), 0);
    close_mock();
}

/* The chip was unplugged: its descriptor is readable, and there is nothing in it. */
static void a_line_that_is_gone(void **state) {
    (void)state;
    open_with_tearing(false);
    assert_int_equal(close(mock.requests[MOCK_TEARING].fill), 0);
    mock.requests[MOCK_TEARING].edges = false;
    assert_int_equal(port.bus.tearing(port.bus.context, 1000), TUILE_HAL_IO);
    close_mock();
}

/* ---- signals ---------------------------------------------------------------------------------------------------- */

static volatile sig_atomic_t alarms;
static void on_alarm(int number) {
    (void)number;
    alarms++;
}

static void signals_do_not_shorten_pauses(void **state) {
    const struct sigaction action = {.sa_handler = on_alarm}; /* without SA_RESTART */
    const struct itimerval often = {{0, 3000}, {0, 3000}}, never = {{0, 0}, {0, 0}};
    struct sigaction before;
    uint64_t begin, pause, wait;

    (void)state;
    open_with_tearing(false);
    assert_int_equal(sigaction(SIGALRM, &action, &before), 0);
    assert_int_equal(setitimer(ITIMER_REAL, &often, NULL), 0);
    begin = now_ms();
    assert_int_equal(port.bus.delay_ms(port.bus.context, 40), 0);
    pause = now_ms() - begin;
    begin = now_ms();
    assert_int_equal(port.bus.tearing(port.bus.context, 40), TUILE_HAL_TIMEOUT);
    wait = now_ms() - begin;
    assert_int_equal(setitimer(ITIMER_REAL, &never, NULL), 0);
    assert_int_equal(sigaction(SIGALRM, &before, NULL), 0);
    assert_true(alarms > 2);
    assert_in_range(pause, 39, 2000);
    assert_in_range(wait, 39, 2000);
    close_mock();
}

static void pauses_of_whole_seconds(void **state) {
    uint64_t begin;
    const tuile_linux_config_t config = mock_linux_config();

    (void)state;
    open_mock();
    assert_int_equal(tuile_linux_open(&port, &config), 0);
    begin = now_ms();
    assert_int_equal(port.bus.delay_ms(port.bus.context, 1010), 0);
    assert_in_range(now_ms() - begin, 1009, 4000);
    close_mock();
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_begin_running_and_dark),
        cmocka_unit_test(pins_follow),
        cmocka_unit_test(lines_that_are_not_connected_are_not_asked_for),
        cmocka_unit_test(each_refusal_has_a_code_and_a_line),
        cmocka_unit_test(a_file_is_no_chip),
        cmocka_unit_test(names_that_are_too_long),
        cmocka_unit_test(no_permission_names_the_rules),
        cmocka_unit_test(no_edge_is_a_timeout),
        cmocka_unit_test(edges_of_the_past_are_forgotten),
        cmocka_unit_test(the_next_edge_ends_the_wait),
        cmocka_unit_test(a_line_that_is_gone),
        cmocka_unit_test(signals_do_not_shorten_pauses),
        cmocka_unit_test(pauses_of_whole_seconds),
    };
    print_message("libgpiod %s, a made-up kernel\n", tuile_linux_gpiod_version());
    return cmocka_run_group_tests_name("GPIO lines", tests, NULL, mock_linux_end);
}
