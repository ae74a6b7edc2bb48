/* Pixels on their way to the panel: faults at every transfer, whose buffer it is, time on the wire.
 *
 * Numbers that are expected come from hand, never from the code under test. */
#include "support/check.h"

#include "../hal/display.h"
#include "../hal/panels/ili9341.h"
#include "../sim/bus.h"
#include "../sim/chips/ili9341.h"
#include "support/board.h"

/* ---- faults ----------------------------------------------------------------------------------------------------- */

/* Makes a display and a frame; the one fault must come up by the end of the frame, and stick. */
static void check_fault_at(uint64_t transfer, uint8_t parts, bool no_reset_pin, bool blocking, bool queues) {
    board_t board;
    int result;
    uint64_t transfers;

    board_open(&board, &(sim_bus_config_t){.fail_transfer = transfer,
                                           .fail_parts = parts,
                                           .no_reset_pin = no_reset_pin,
                                           .blocking = blocking,
                                           .queues = queues,
                                           .max_chunk_bytes = 20000});
    result = board_start(&board, 1, TUILE_WIRE_RGB565);
    if (result == 0) { result = board_draw(&board.display, TUILE_WIRE_RGB565, 320, 40); }
    assert_int_equal(result, TUILE_HAL_IO);
    assert_int_equal(board.display.error, TUILE_HAL_IO);
    transfers = board.bus.transfers;
    assert_true(transfers == transfer);
    assert_int_equal(board_draw(&board.display, TUILE_WIRE_RGB565, 320, 40), TUILE_HAL_IO);
    assert_true(board.bus.transfers == transfers);
    assert_int_equal(tuile_display_resume(&board.display), 0);
    assert_true(board.display.refresh);
    assert_int_equal(board_draw(&board.display, TUILE_WIRE_RGB565, 320, 40), 0);
    assert_false(board.display.refresh);
    board_check_clean(&board);
    board_check_picture(&board, 1, TUILE_WIRE_RGB565);
    board_close(&board);
}

static uint64_t count_transfers(bool no_reset_pin) {
    board_t board;
    uint64_t transfers;

    board_open(&board, &(sim_bus_config_t){.no_reset_pin = no_reset_pin, .max_chunk_bytes = 20000});
    assert_int_equal(board_start(&board, 1, TUILE_WIRE_RGB565), 0);
    assert_int_equal(board_draw(&board.display, TUILE_WIRE_RGB565, 320, 40), 0);
    transfers = board.bus.transfers;
    board_close(&board);
    return transfers;
}

static void test_fault_at_every_transfer(void **state) {
    (void)state;
    for (unsigned variant = 0; variant < 18; variant++) {
        bool no_reset_pin = variant % 2, blocking = variant / 2 % 3 == 1, queues = variant / 2 % 3 == 2;
        uint64_t count = count_transfers(no_reset_pin);
        /* 18 + 3 commands of the start, one more without the pin; 6 tiles of 3 commands and 2 chunks */
        assert_true(count == 21u + no_reset_pin + 30u);
        for (uint64_t transfer = 1; transfer <= count; transfer++) {
            check_fault_at(transfer, (uint8_t)(variant / 6), no_reset_pin, blocking, queues);
        }
    }
}

static void test_gone_at_every_transfer(void **state) {
    (void)state;
    for (uint64_t transfer = 1; transfer <= 51; transfer++) {
        board_t board;
        int result;
        board_open(&board, &(sim_bus_config_t){.fail_transfer = transfer, .fail_code = TUILE_HAL_GONE, .max_chunk_bytes = 20000});
        result = board_start(&board, 1, TUILE_WIRE_RGB565);
        if (result == 0) { result = board_draw(&board.display, TUILE_WIRE_RGB565, 320, 40); }
        assert_int_equal(result, TUILE_HAL_GONE);
        assert_int_equal(tuile_display_resume(&board.display), TUILE_HAL_GONE);
        assert_true(board.bus.transfers == transfer);
        board_close(&board);
    }
}

/* ---- ownership -------------------------------------------------------------------------------------------------- */

static bool row_is(const board_t *board, uint32_t row, uint8_t value) {
    for (uint32_t x = 0; x < 240; x++) {
        if (sim_dcs_memory(board->chip, x, row) != (value ? 0x3FFFF : 0u)) { return false; }
    }
    return true;
}

static void test_buffer_in_flight_is_not_ours(void **state) {
    board_t board;
    uint8_t a[480], b[480];

    (void)state;
    board_open(&board, NULL);
    board_start(&board, 0, TUILE_WIRE_RGB565);
    tuile_display_window(&board.display, 0, 0, 240, 3);
    memset(a, 0xFF, sizeof a);
    memset(b, 0xFF, sizeof b);
    assert_int_equal(tuile_display_write(&board.display, a, sizeof a), 0);
    memset(a, 0, sizeof a); /* too early: the simulator shows it */
    assert_int_equal(tuile_display_write(&board.display, b, sizeof b), 0);
    assert_true(row_is(&board, 0, 0));
    memset(a, 0xFF, sizeof a); /* now it is ours again */
    assert_int_equal(tuile_display_write(&board.display, a, sizeof a), 0);
    memset(b, 0, sizeof b); /* b is out */
    assert_int_equal(tuile_display_wait(&board.display), 0);
    memset(a, 0, sizeof a); /* and a */
    assert_true(row_is(&board, 1, 0xFF));
    assert_true(row_is(&board, 2, 0xFF));
    board_close(&board);
}

static void open_rows(board_t *board, const sim_bus_config_t *config, uint32_t rows) {
    board_open(board, config);
    board_start(board, 0, TUILE_WIRE_RGB565);
    tuile_display_window(&board->display, 0, 0, 240, rows);
}

static void test_two_buffers_are_in_flight_where_the_bus_queues(void **state) {
    board_t board;
    uint8_t rows[3][480];

    (void)state;
    open_rows(&board, &(sim_bus_config_t){.queues = true}, 4);
    assert_true(board.display.queues);
    memset(rows, 0xFF, sizeof rows);
    assert_int_equal(tuile_display_queue(&board.display, rows[0], 480), 0);
    assert_int_equal(tuile_display_wait_one(&board.display), 0);
    memset(rows[0], 0, 480); /* still the display's: there is but one */
    assert_int_equal(tuile_display_queue(&board.display, rows[1], 480), 0);
    assert_int_equal(board.bus.flying, 2);
    assert_false(row_is(&board, 0, 0) || row_is(&board, 0, 0xFF)); /* neither has arrived: noise */
    memset(rows[1], 0, 480);                                       /* too early */
    assert_int_equal(tuile_display_wait_one(&board.display), 0);
    assert_int_equal(board.bus.flying, 1);
    memset(rows[0], 0xFF, 480); /* ours */
    assert_int_equal(tuile_display_queue(&board.display, rows[2], 480), 0);
    assert_int_equal(tuile_display_queue(&board.display, rows[0], 480), 0); /* waits for rows[1] */
    assert_int_equal(board.bus.flying, 2);
    memset(rows[1], 0xFF, 480);
    assert_int_equal(tuile_display_wait(&board.display), 0);
    assert_int_equal(board.bus.flying, 0);
    memset(rows, 0x55, sizeof rows);
    assert_true(row_is(&board, 0, 0) && row_is(&board, 1, 0) && row_is(&board, 2, 0xFF) && row_is(&board, 3, 0xFF));
    board_check_clean(&board);
    board_close(&board);
}

/* A write waits for the one before it on every bus, and a queue that is none, whether the bus has no wait_one or the panel has
 * commands between its pages, is a write. */
static void test_a_write_waits_where_there_is_a_queue_and_a_queue_where_there_is_none(void **state) {
    static const uint8_t row[480];
    board_t board;

    (void)state;
    for (unsigned queues = 0; queues < 2; queues++) {
        open_rows(&board, &(sim_bus_config_t){.queues = queues}, 2);
        assert_int_equal(tuile_display_write(&board.display, row, 480), 0);
        assert_int_equal((queues ? tuile_display_write : tuile_display_queue)(&board.display, row, 480), 0);
        assert_int_equal(board.bus.flying, 1);
        assert_int_equal(tuile_display_wait_one(&board.display), 0);
        assert_int_equal(board.bus.flying, 1);
        board_check_clean(&board);
        board_close(&board);
    }
    board_open_panel(&board, sim_panel_find("sh1106"), &(sim_bus_config_t){.queues = true});
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_DEFAULT), 0);
    assert_false(board.display.queues);
    assert_int_equal(tuile_display_window(&board.display, 0, 0, 128, 64), 0);
    for (unsigned i = 0; i < 4; i++) {
        assert_int_equal(tuile_display_queue(&board.display, row, 256), 0); /* two pages each */
    }
    assert_int_equal(tuile_display_present(&board.display), 0);
    board_check_clean(&board);
    board_close(&board);
}

/* The first of two fails: it is told by whatever waits for it, and the second does not go out. */
static void test_a_fault_of_the_first_of_two_holds_the_second_back(void **state) {
    static const uint8_t rows[2][480];
    board_t board;

    (void)state;
    for (unsigned way = 0; way < 4; way++) {
        int result;
        open_rows(&board, &(sim_bus_config_t){.queues = true, .fail_transfer = 24}, 3); /* 20 of the start, 3 of the window */
        assert_int_equal(tuile_display_queue(&board.display, rows[0], 480), 0);
        assert_int_equal(tuile_display_queue(&board.display, rows[1], 480), 0);
        result = way == 0   ? tuile_display_wait_one(&board.display)
                 : way == 1 ? tuile_display_wait(&board.display)
                 : way == 2 ? tuile_display_queue(&board.display, rows[0], 480)
                            : tuile_display_window(&board.display, 0, 0, 240, 1);
        assert_int_equal(result, TUILE_HAL_IO);
        assert_int_equal(board.display.error, TUILE_HAL_IO);
        assert_int_equal(board.display.in_flight, 0);
        assert_int_equal(board.bus.flying, 0);
        assert_int_equal(board.bus.transfers, 24);
        assert_int_equal(tuile_display_wait_one(&board.display), TUILE_HAL_IO);
        assert_int_equal(tuile_display_queue(&board.display, rows[0], 480), TUILE_HAL_IO);
        assert_int_equal(board.bus.transfers, 24);
        assert_false(row_is(&board, 1, 0));
        board_close(&board);
    }
}

static int refuse_data(void *context, const uint8_t *bytes, size_t size_bytes) {
    (void)context, (void)bytes, (void)size_bytes;
    return TUILE_HAL_GONE;
}

static void test_a_queue_that_is_refused_leaves_no_buffer(void **state) {
    static const uint8_t row[480];
    board_t board;

    (void)state;
    open_rows(&board, &(sim_bus_config_t){.queues = true}, 2);
    assert_int_equal(tuile_display_queue(&board.display, row, 480), 0);
    board.bus.bus.data = refuse_data;
    assert_int_equal(tuile_display_queue(&board.display, row, 480), TUILE_HAL_GONE);
    assert_int_equal(board.display.in_flight, 0);
    board_close(&board);
}

/* Of a write of three chunks two are in flight when it returns; the next waits for the first of them. */
static void test_chunks_are_queued_as_well(void **state) {
    static const uint8_t rows[1440];
    board_t board;

    (void)state;
    open_rows(&board, &(sim_bus_config_t){.queues = true, .max_chunk_bytes = 480}, 6);
    assert_int_equal(tuile_display_write(&board.display, rows, sizeof rows), 0);
    assert_int_equal(board.bus.flying, 2);
    assert_int_equal(tuile_display_queue(&board.display, rows, sizeof rows), 0);
    assert_int_equal(board.bus.flying, 2);
    assert_int_equal(tuile_display_present(&board.display), 0);
    board_check_clean(&board);
    board_close(&board);
}

static void test_a_queue_keeps_the_rules_of_a_write(void **state) {
    static const uint8_t rows[960];
    board_t board;

    (void)state;
    board.display = (tuile_display_t){0};
    assert_int_equal(tuile_display_queue(&board.display, rows, 480), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_wait_one(&board.display), TUILE_HAL_STATE);
    open_rows(&board, &(sim_bus_config_t){.queues = true}, 2);
    assert_int_equal(tuile_display_queue(&board.display, rows, 961), TUILE_HAL_ARGUMENT);
    assert_int_equal(tuile_display_queue(&board.display, rows, 480), 0);
    assert_int_equal(tuile_display_queue(&board.display, rows, 482), TUILE_HAL_ARGUMENT);
    assert_int_equal(tuile_display_present(&board.display), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_queue(&board.display, rows, 480), 0);
    assert_int_equal(tuile_display_queue(&board.display, rows, 480), TUILE_HAL_STATE);
    assert_int_equal(tuile_display_present(&board.display), 0);
    assert_int_equal(tuile_display_sleep(&board.display), 0);
    assert_int_equal(tuile_display_wait_one(&board.display), TUILE_HAL_STATE);
    board_check_clean(&board);
    board_close(&board);
}

/* ---- time ------------------------------------------------------------------------------------------------------- */

static void test_time_on_the_wire(void **state) {
    static uint8_t frame[153600];
    board_t board;
    uint64_t before_ns;
    tuile_display_config_t config = {.panel = &tuile_ili9341, .pixel_clock_hz = 62500000};

    (void)state;
    board_open(&board, &(sim_bus_config_t){.command_gap_ns = 1000, .chunk_gap_ns = 2000, .max_chunk_bytes = 4096});
    config.bus = &board.bus.bus;
    assert_int_equal(tuile_display_init(&board.display, &config), 0);
    assert_int_equal(tuile_display_present(&board.display), 0); /* switches the panel on, which only the first frame does */
    memset(&board.bus.counts, 0, sizeof board.bus.counts);
    before_ns = board.bus.now_ns;
    tuile_display_window(&board.display, 0, 0, 240, 320);
    tuile_display_write(&board.display, frame, sizeof frame);
    assert_int_equal(tuile_display_present(&board.display), 0);
    assert_int_equal(board.bus.counts.commands, 3);
    assert_int_equal(board.bus.counts.command_bytes, 11);
    assert_int_equal(board.bus.counts.chunks, 38); /* 37 of 4096 and one of 2048 */
    assert_int_equal(board.bus.counts.data_bytes, 153600);
    /* 153600 * 8 bits * 16 ns; 11 * 8 bits * 100 ns */
    assert_int_equal(board.bus.counts.wire_ns, 19660800 + 8800);
    assert_int_equal(board.bus.counts.gap_ns, 3 * 1000 + 38 * 2000);
    assert_int_equal(board.bus.now_ns - before_ns, 19660800 + 8800 + 79000);
    assert_true(board.chip->warnings > 0); /* beyond the rated 10 MHz */
    assert_non_null(strstr(board.chip->warning.text, "62500000 Hz"));
    board_close(&board);
}

static void test_real_clock_differs_from_the_one_asked_for(void **state) {
    static uint8_t row[480];
    board_t board;

    (void)state;
    board_open(&board, &(sim_bus_config_t){.clock_hz = 15625000, .command_clock_hz = 9000000});
    board_start(&board, 0, TUILE_WIRE_RGB565);
    memset(&board.bus.counts, 0, sizeof board.bus.counts);
    tuile_display_window(&board.display, 0, 0, 240, 1);
    tuile_display_write(&board.display, row, sizeof row);
    tuile_display_wait(&board.display);
    /* 480 * 8 * 64 ns; 5, 5 and 1 bytes at 9 MHz: 4444.4, 4444.4 and 888.8 ns, each rounded up */
    assert_int_equal(board.bus.counts.wire_ns, 245760 + 4445 + 4445 + 889);
    board_close(&board);
}

static void test_work_overlaps_the_wire(void **state) {
    static uint8_t strip[2][240 * 32 * 2]; /* 15 360 bytes: 12 288 000 ns at 10 MHz */
    board_t board;
    uint64_t before_ns;
    tuile_display_config_t config = {.panel = &tuile_ili9341, .pixel_clock_hz = 10000000};

    (void)state;
    for (unsigned blocking = 0; blocking < 2; blocking++) {
        board_open(&board, &(sim_bus_config_t){.blocking = blocking});
        config.bus = &board.bus.bus;
        assert_int_equal(tuile_display_init(&board.display, &config), 0);
        assert_int_equal(board.chip->warnings, 0);
        assert_int_equal(tuile_display_present(&board.display), 0);
        memset(&board.bus.counts, 0, sizeof board.bus.counts);
        before_ns = board.bus.now_ns;
        for (uint32_t i = 0; i < 10; i++) {
            sim_bus_work(&board.bus, 5000000);
            tuile_display_window(&board.display, 0, 32 * i, 240, 32);
            tuile_display_write(&board.display, strip[i & 1], sizeof strip[0]);
        }
        assert_int_equal(tuile_display_present(&board.display), 0);
        /* With overlap only the first 5 ms of work are seen. */
        assert_int_equal(board.bus.now_ns - before_ns, 10 * (12288000 + 8800) + (blocking ? 10 : 1) * 5000000);
        assert_int_equal(board.bus.counts.work_ns, 50000000);
        assert_int_equal(board.bus.counts.idle_ns, blocking ? 122880000 : 122880000 - 45000000);
        board_close(&board);
    }
}

/* Strips of 1.96608 ms on the wire, in one window of 8.8 us. Two are drawn at once, then one at a time as a buffer is free: the
 * wire rests for the first drawing only, whatever the driver takes for a chunk. Without a queue it rests for each of these pauses.
 */
static void test_the_wire_does_not_rest_between_two_that_are_queued(void **state) {
    static uint8_t strip[2][240 * 32 * 2];
    tuile_display_config_t config = {.panel = &tuile_ili9341, .pixel_clock_hz = 62500000};
    board_t board;
    uint64_t before_ns;

    (void)state;
    for (unsigned queues = 0; queues < 2; queues++) {
        board_open(&board, &(sim_bus_config_t){.queues = queues, .chunk_gap_ns = 3000});
        config.bus = &board.bus.bus;
        assert_int_equal(tuile_display_init(&board.display, &config), 0);
        assert_int_equal(tuile_display_present(&board.display), 0);
        memset(&board.bus.counts, 0, sizeof board.bus.counts);
        before_ns = board.bus.now_ns;
        for (uint32_t i = 0; i < 10; i++) {
            assert_int_equal(tuile_display_wait_one(&board.display), 0);
            sim_bus_work(&board.bus, 1000000);
            if (i == 0) { tuile_display_window(&board.display, 0, 0, 240, 320); }
            assert_int_equal(tuile_display_queue(&board.display, strip[i & 1], sizeof strip[0]), 0);
        }
        assert_int_equal(tuile_display_present(&board.display), 0);
        assert_int_equal(board.bus.now_ns - before_ns, 1000000 + 8800 + 10 * 1966080 + (queues ? 1 : 10) * 3000);
        assert_int_equal(board.bus.counts.wire_ns, 8800 + 10 * 1966080);
        assert_int_equal(board.bus.counts.gap_ns, (queues ? 1 : 10) * 3000);
        assert_int_equal(board.bus.counts.work_ns, 10000000);
        board_check_clean(&board);
        board_close(&board);
    }
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fault_at_every_transfer),
        cmocka_unit_test(test_gone_at_every_transfer),
        cmocka_unit_test(test_buffer_in_flight_is_not_ours),
        cmocka_unit_test(test_two_buffers_are_in_flight_where_the_bus_queues),
        cmocka_unit_test(test_a_write_waits_where_there_is_a_queue_and_a_queue_where_there_is_none),
        cmocka_unit_test(test_a_fault_of_the_first_of_two_holds_the_second_back),
        cmocka_unit_test(test_a_queue_that_is_refused_leaves_no_buffer),
        cmocka_unit_test(test_chunks_are_queued_as_well),
        cmocka_unit_test(test_a_queue_keeps_the_rules_of_a_write),
        cmocka_unit_test(test_the_wire_does_not_rest_between_two_that_are_queued),
        cmocka_unit_test(test_time_on_the_wire),
        cmocka_unit_test(test_real_clock_differs_from_the_one_asked_for),
        cmocka_unit_test(test_work_overlaps_the_wire),
    };
    return cmocka_run_group_tests_name("transfer", tests, NULL, NULL);
}
