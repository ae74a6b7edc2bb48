/* tuile card and tuile render on a panel that hangs on a made-up board: the whole way from the command line to the glass, and how
 * they leave it, by themselves, by Ctrl-C, and after a fault. The commands run in this process, as the board's lines are its files.
 */
#include "support/check.h"

#include "mock/linux.h"
#include "support/cli.h"

#include "../sim/chips/mipi_dcs.h"
#include "../sim/commands.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#define DISPLAY "spi:/dev/spidev0.0,panel=ili9341,dc=gpiochip0:25,rst=gpiochip0:27,bl=gpiochip0:18,clock=20M"

static mock_linux_t mock;

static void open_board(void) {
    mock = (mock_linux_t){.real_time = true};
    mock_linux_open(&mock, "ili9341");
}

/* The lines are free, nothing is open, the light is out and the panel asleep: it answers 08h, on in nothing but normal mode. */
static void check_left_dark(void) {
    uint8_t mode = 0xFF;
    assert_string_equal(mock.misuse.text, "");
    assert_string_equal(mock.chip->fault.text, "");
    assert_int_equal(mock_linux_held(&mock), 0);
    assert_int_equal(mock_linux_descriptors(&mock), 0);
    assert_false(mock.level[MOCK_BACKLIGHT]);
    assert_int_equal(mock.chip->read(mock.chip, 0x0A, &mode, 1, mock.now_ns + 200000000u), 0);
    assert_int_equal(mode, 0x08);
}

static int run(int (*command)(int, char **), const char *const *arguments) {
    char *list[16];
    int count = 0;
    while (arguments[count]) {
        list[count] = strdup(arguments[count]);
        count++;
    }
    const int code = command(count, list);
    for (int i = 0; i < count; i++) {
        free(list[i]);
    }
    return code;
}

/* When the panel is lit, and what it shows then. */
static struct watcher {
    pthread_t thread;
    int signal; /* to send when it is lit; 0: none */
    bool lit;
} watcher;

static void *watch(void *context) {
    struct watcher *w = context;
    for (unsigned i = 0; i < 2000 && !w->lit; i++) {
        const struct timespec pause = {0, 5000000};
        (void)nanosleep(&pause, NULL);
        w->lit = mock.level[MOCK_BACKLIGHT];
    }
    if (w->lit && w->signal) { (void)kill(getpid(), w->signal); }
    return NULL;
}

static void start_watching(int number) {
    watcher = (struct watcher){.signal = number};
    assert_int_equal(pthread_create(&watcher.thread, NULL, watch, &watcher), 0);
}

static void stop_watching(void) {
    assert_int_equal(pthread_join(watcher.thread, NULL), 0);
    assert_true(watcher.lit);
}

static void the_card_is_shown_and_the_panel_left_dark(void **state) {
    static const char *const arguments[] = {"--display", DISPLAY, "--rotate", "90", "--hold", "0.2", NULL};
    (void)state;
    open_board();
    start_watching(0);
    assert_int_equal(run(command_card, arguments), 0);
    stop_watching();
    check_left_dark();
    /* Its memory holds the card still: red in the left third of its middle. The panel sleeps, so the memory is looked at. */
    const uint32_t red = sim_dcs_memory(mock.chip, 240 - 1 - 120, 60), corner = sim_dcs_memory(mock.chip, 239, 0);
    assert_int_equal(red, 0x3F000);
    assert_int_equal(corner, 0x3FFFF);
    mock_linux_close(&mock);
}

static void ctrl_c_ends_it_and_leaves_the_panel_dark(void **state) {
    static const char *const card[] = {"--display", DISPLAY, NULL};
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(signals); i++) {
        open_board();
        start_watching(signals[i]);
        assert_int_equal(run(command_card, card), 128 + signals[i]);
        stop_watching();
        check_left_dark();
        mock_linux_close(&mock);
    }
}

static void ctrl_c_ends_frames_without_number(void **state) {
    const char *const frames[] = {cli_path("cube.obj"), "--display", DISPLAY, "--frames", "100000", NULL};
    (void)state;
    open_board();
    start_watching(SIGINT);
    assert_int_equal(run(command_render, frames), 128 + SIGINT);
    stop_watching();
    check_left_dark();
    mock_linux_close(&mock);
}

static void a_fault_in_mid_frame_ends_it_with_a_line_and_leaves_the_panel_dark(void **state) {
    static const char *const card[] = {"--display", DISPLAY, NULL};
    (void)state;
    open_board();
    mock.fail_call = 120; /* behind the start */
    assert_int_equal(run(command_card, card), 1);
    assert_true(mock.calls > 120);
    check_left_dark();
    mock_linux_close(&mock);
}

static void a_device_that_goes_away_ends_it_at_once(void **state) {
    static const char *const card[] = {"--display", DISPLAY, NULL};
    (void)state;
    open_board();
    mock.fail_call = 120;
    mock.fail_errno = ESHUTDOWN;
    assert_int_equal(run(command_card, card), 1);
    assert_int_equal(mock_linux_held(&mock), 0);
    assert_int_equal(mock_linux_descriptors(&mock), 0);
    mock_linux_close(&mock);
}

static void real_displays_cannot_be_looked_at(void **state) {
    const char *const frames[] = {cli_path("cube.obj"), "--display", DISPLAY, "--hash", NULL};
    (void)state;
    open_board();
    assert_int_equal(run(command_render, frames), 1);
    check_left_dark();
    mock_linux_close(&mock);
}

static int tear_down(void **state) { return cli_tear_down(state) | mock_linux_end(state); }

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_card_is_shown_and_the_panel_left_dark),
        cmocka_unit_test(ctrl_c_ends_it_and_leaves_the_panel_dark),
        cmocka_unit_test(ctrl_c_ends_frames_without_number),
        cmocka_unit_test(a_fault_in_mid_frame_ends_it_with_a_line_and_leaves_the_panel_dark),
        cmocka_unit_test(a_device_that_goes_away_ends_it_at_once),
        cmocka_unit_test(real_displays_cannot_be_looked_at),
    };
    return cmocka_run_group_tests_name("card on a board", tests, cli_set_up, tear_down);
}
