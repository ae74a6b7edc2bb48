/* The thread that keeps the wire busy: buffers are handed over and joined, and signals stay with the caller's threads. */
#include "support/check.h"

#include "mock/linux.h"

#include <dirent.h>
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

static mock_linux_t mock;
static tuile_linux_t port;

static void open_board(bool no_worker) {
    tuile_linux_config_t config = mock_linux_config();
    static const uint8_t write_memory[1] = {0x2C}, sleep_out[1] = {0x11};

    tuile_linux_close(&port); /* after a test that failed */
    config.no_worker = no_worker;
    mock = (mock_linux_t){.bufsiz = 2048};
    mock_linux_open(&mock, "ili9341");
    assert_int_equal(mock_linux_port(&mock, &port, &config), 0);
    assert_int_equal(port.bus.delay_ms(port.bus.context, 5), 0);
    assert_int_equal(port.bus.command(port.bus.context, sleep_out, 1, 1), 0);
    assert_int_equal(port.bus.delay_ms(port.bus.context, 120), 0);
    assert_int_equal(port.bus.command(port.bus.context, write_memory, 1, 1), 0);
    mock.transfers = 0;
}

static void close_board(void) {
    tuile_linux_close(&port);
    assert_string_equal(mock.misuse.text, "");
    assert_int_equal(mock_linux_descriptors(&mock), 0);
    mock_linux_close(&mock);
}

static void go(unsigned messages) {
    for (unsigned i = 0; i < messages; i++) {
        (void)sem_post(&mock.go);
    }
}

/* The kernel holds the first message: if data() sent it itself, it would not come back before somebody else lets it go. */
static void data_return_while_the_wire_is_busy(void **state) {
    static uint8_t bytes[4000];

    (void)state;
    open_board(false);
    mock.hold = true;
    alarm(60);
    assert_int_equal(port.bus.data(port.bus.context, bytes, sizeof bytes), 0);
    assert_int_equal(mock.transfers, 0);
    go(2);
    assert_int_equal(port.bus.wait(port.bus.context), 0);
    assert_int_equal(mock.transfers, 2);
    assert_int_equal(port.bus.wait(port.bus.context), 0); /* nothing is there to wait for */
    alarm(0);
    close_board();
}

static void *go_late(void *argument) {
    (void)argument;
    (void)usleep(20000);
    go(1);
    (void)usleep(20000);
    go(1);
    return NULL;
}

static void wait_returns_when_all_is_out(void **state) {
    static uint8_t bytes[4000];

    (void)state;
    for (unsigned round = 0; round < 3; round++) {
        pthread_t thread;
        open_board(false);
        mock.hold = true;
        assert_int_equal(port.bus.data(port.bus.context, bytes, sizeof bytes), 0);
        assert_int_equal(pthread_create(&thread, NULL, go_late, NULL), 0);
        if (round < 2) {
            assert_int_equal(port.bus.wait(port.bus.context), 0);
        } else {
            tuile_linux_close(&port); /* joins too */
        }
        assert_int_equal(mock.transfers, 2);
        assert_int_equal(pthread_join(thread, NULL), 0);
        close_board();
    }
}

/* A port that is closed at once sends what it was given, also when the thread has not even looked at it. */
static void closing_sends_what_was_handed_over(void **state) {
    static uint8_t bytes[4];

    (void)state;
    for (unsigned round = 0; round < 50; round++) {
        open_board(false);
        assert_int_equal(port.bus.data(port.bus.context, bytes, sizeof bytes), 0);
        tuile_linux_close(&port);
        assert_int_equal(mock.transfers, 1);
        close_board();
    }
}

/* No thread has room for a stack as large as all addresses. */
static void a_thread_that_cannot_start_need_not_be_stopped(void **state) {
    tuile_linux_worker_t worker;
    pthread_attr_t usual, huge;

    (void)state;
    assert_int_equal(pthread_getattr_default_np(&usual), 0);
    assert_int_equal(pthread_attr_init(&huge), 0);
    assert_int_equal(pthread_attr_setstacksize(&huge, (size_t)1 << 47), 0);
    assert_int_equal(pthread_setattr_default_np(&huge), 0);
    assert_int_not_equal(tuile_linux_worker_start(&worker, NULL, NULL), 0);
    assert_int_equal(pthread_setattr_default_np(&usual), 0);
    assert_false(worker.running);
    tuile_linux_worker_stop(&worker);
    (void)pthread_attr_destroy(&huge);
    (void)pthread_attr_destroy(&usual);
}

static void without_it_data_return_when_they_are_out(void **state) {
    static uint8_t bytes[4000];

    (void)state;
    open_board(true);
    assert_null(port.bus.wait);
    assert_int_equal(port.bus.data(port.bus.context, bytes, sizeof bytes), 0);
    assert_int_equal(mock.transfers, 2);
    close_board();
}

/* One buffer after the other, each told apart by its first byte. */
static void each_buffer_is_sent_once_and_in_order(void **state) {
    static uint8_t bytes[2][4];

    (void)state;
    open_board(false);
    for (unsigned i = 0; i < 500; i++) {
        bytes[i % 2][0] = (uint8_t)(i * 7);
        assert_int_equal(port.bus.data(port.bus.context, bytes[i % 2], 4), 0);
        assert_int_equal(port.bus.wait(port.bus.context), 0);
        assert_int_equal(mock.transfers, i + 1);
        assert_int_equal(mock.log[i].first, (uint8_t)(i * 7));
        assert_int_equal(mock.log[i].size_bytes, 4);
    }
    close_board();
}

/* ---- signals ---------------------------------------------------------------------------------------------------- */

static unsigned threads(unsigned long ids[64]) {
    DIR *folder = opendir("/proc/self/task");
    unsigned count = 0;

    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        if (entry->d_name[0] != '.' && count < 64) { ids[count++] = strtoul(entry->d_name, NULL, 10); }
    }
    (void)closedir(folder);
    return count;
}

/* The signals that a thread does not take, as proc(5) tells: bit n - 1 is signal n. */
static unsigned long long blocked(unsigned long id) {
    char path[64], line[128];
    unsigned long long mask = 0;
    FILE *file;

    (void)snprintf(path, sizeof path, "/proc/self/task/%lu/status", id);
    file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        (void)sscanf(line, "SigBlk: %llx", &mask);
    }
    (void)fclose(file);
    return mask;
}

static void signals_are_left_to_the_others(void **state) {
    static const int taken[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGALRM, SIGUSR1, SIGCHLD};
    const tuile_linux_config_t config = mock_linux_config();
    unsigned long before[64], after[64], own = 0;
    unsigned before_count, after_count;
    sigset_t mask;

    (void)state;
    mock = (mock_linux_t){0};
    mock_linux_open(&mock, "ili9341");
    before_count = threads(before);
    assert_int_equal(tuile_linux_open(&port, &config), 0);
    after_count = threads(after);
    assert_int_equal(after_count, before_count + 1);
    for (unsigned i = 0; i < after_count; i++) {
        bool known = false;
        for (unsigned k = 0; k < before_count; k++) {
            known = known || after[i] == before[k];
        }
        if (!known) { own = after[i]; }
    }
    assert_true(own != 0);
    assert_int_equal(pthread_sigmask(SIG_BLOCK, NULL, &mask), 0);
    for (size_t i = 0; i < CHECK_COUNT(taken); i++) {
        assert_true(blocked(own) >> (taken[i] - 1) & 1);
        assert_false(sigismember(&mask, taken[i])); /* the caller's stays as it was */
    }
    close_board();
    assert_int_equal(threads(after), before_count);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(data_return_while_the_wire_is_busy),
        cmocka_unit_test(wait_returns_when_all_is_out),
        cmocka_unit_test(without_it_data_return_when_they_are_out),
        cmocka_unit_test(each_buffer_is_sent_once_and_in_order),
        cmocka_unit_test(signals_are_left_to_the_others),
        cmocka_unit_test(closing_sends_what_was_handed_over),
        cmocka_unit_test(a_thread_that_cannot_start_need_not_be_stopped),
    };
    print_message("libgpiod %s, a made-up kernel\n", tuile_linux_gpiod_version());
    return cmocka_run_group_tests_name("sending thread", tests, NULL, mock_linux_end);
}
