/* All panels that the simulator knows, in all rotations and formats: what is drawn is what is seen, whole and in parts, also after
 * a fault at any transfer.
 *
 * The driver's data and the chip's model are two readings of one data sheet; the test picture goes from one to the other. */
#include "support/check.h"

#include "support/board.h"

/* ---- the list --------------------------------------------------------------------------------------------------- */

static void test_names(void **state) {
    (void)state;
    for (size_t i = 0; i < sim_panel_count; i++) {
        assert_ptr_equal(sim_panel_find(sim_panels[i].panel->name), &sim_panels[i]);
        assert_non_null(sim_panels[i].chip);
    }
    assert_null(sim_panel_find("ili9340"));
}

/* The glass lies within the memory, and each format has a name. */
static void test_data_are_consistent(void **state) {
    (void)state;
    for (size_t i = 0; i < sim_panel_count; i++) {
        const tuile_panel_t *panel = sim_panels[i].panel;
        assert_true(panel->offset_x + panel->view_width <= panel->ram_width);
        assert_true(panel->offset_y + panel->view_height <= panel->ram_height);
        assert_true(panel->format_count >= 1 && panel->format_count <= TUILE_PANEL_FORMATS_MAX);
        for (unsigned format = 0; format < panel->format_count; format++) {
            assert_true(tuile_wire_bits(panel->formats[format].wire) > 0);
        }
        assert_true(panel->command_clock_hz <= panel->rated_pixel_clock_hz);
    }
}

/* ---- pictures --------------------------------------------------------------------------------------------------- */

static void start(board_t *board, const sim_panel_t *panel, const sim_bus_config_t *config, uint8_t rotation, unsigned format) {
    board_open_panel(board, panel, config);
    assert_int_equal(board_start(board, rotation, panel->panel->formats[format].wire), 0);
    assert_int_equal(board->display.width, rotation & 1 ? panel->panel->view_height : panel->panel->view_width);
    assert_int_equal(board->display.height, rotation & 1 ? panel->panel->view_width : panel->panel->view_height);
}

static void test_picture_in_each_rotation_and_format(void **state) {
    static const uint32_t splits[][2] = {{480, 480}, {480, 16}, {64, 48}, {37, 41}, {480, 1}, {16, 480}};
    const sim_panel_t *panel = *state;

    for (uint8_t rotation = 0; rotation < 4; rotation++) {
        for (unsigned format = 0; format < panel->panel->format_count; format++) {
            const size_t split = (rotation + 2u * format) % CHECK_COUNT(splits);
            board_t board;
            start(&board, panel, &(sim_bus_config_t){.max_chunk_bytes = split % 2 ? 4095 : 0, .blocking = split == 2}, rotation,
                  format);
            assert_int_equal(board_draw(&board.display, board.display.wire, splits[split][0], splits[split][1]), 0);
            board_check_clean(&board);
            board_check_picture(&board, rotation, board.display.wire);
            board_check_glass(&board, rotation, board.display.wire);
            board_close(&board);
        }
    }
}

typedef struct window {
    uint32_t x, y, width, height;
} window_t;

/* The test picture of another width: what partial windows are filled with, so that they differ from what was there. */
#define OTHER_WIDTH 1021

static void put_window(tuile_display_t *display, const window_t *window) {
    static uint8_t bytes[2][4 * 480 * 64];
    static unsigned which;
    size_t size_bytes;

    which = 1 - which;
    size_bytes = board_encode(bytes[which], display->wire, OTHER_WIDTH, window->x, window->y, window->width, window->height);
    assert_int_equal(tuile_display_window(display, window->x, window->y, window->width, window->height), 0);
    assert_int_equal(tuile_display_write(display, bytes[which], size_bytes), 0);
}

static void check_windows(const board_t *board, uint8_t rotation, const window_t *windows, size_t count) {
    const uint8_t wire = board->display.wire;
    sim_picture_t seen;

    assert_int_equal(sim_bus_picture(&board->bus, rotation, &seen, NULL), 0);
    for (uint32_t y = 0; y < seen.height; y++) {
        for (uint32_t x = 0; x < seen.width; x++) {
            uint32_t width = seen.width;
            uint8_t expected[3];
            for (size_t i = 0; i < count; i++) {
                const window_t *w = &windows[i];
                if (x - w->x < w->width && y - w->y < w->height) { width = OTHER_WIDTH; }
            }
            board_seen(expected, wire, board_colour(width, x, y));
            if (memcmp(sim_picture_at(&seen, x, y), expected, 3) != 0) {
                fail_msg("%s, rotation %u, wire %u: pixel (%u, %u) is not right", board->panel->panel->name, rotation, wire, x, y);
            }
        }
    }
    sim_picture_free(&seen);
}

/* Into a picture that is there: windows in the four corners, along the four edges and inside, the smallest too. The
 * smallest glass has four units of alignment across. */
static void test_partial_windows(void **state) {
    const sim_panel_t *panel = *state;

    for (unsigned i = 0; i < 4u * panel->panel->format_count; i++) {
        const uint8_t rotation = i & 3u;
        board_t board;
        start(&board, panel, &(sim_bus_config_t){.max_chunk_bytes = 70}, rotation, i / 4);
        const uint32_t ax = board.display.align_x, ay = board.display.align_y;
        const uint32_t right = board.display.width, bottom = board.display.height;
        const uint32_t last = (right - 1) / ax * ax; /* where the last whole unit begins; it is cut where the width is odd */
        const window_t windows[] = {
            /* corners */
            {0, 0, 3 * ax, 2 * ay},
            {last - 2 * ax, 0, right - last + 2 * ax, ay},
            {0, bottom - ay, 4 * ax, ay},
            {last, bottom - ay, right - last, ay},
            /* edges */
            {ax, 0, 2 * ax, ay},
            {2 * ax, bottom - 2 * ay, ax, 2 * ay},
            {0, 2 * ay, 2 * ax, ay},
            {last - ax, 2 * ay, right - last + ax, ay},
            /* inside: one unit, a row, a column */
            {right / 2 / ax * ax, bottom / 2 / ay * ay, ax, ay},
            {ax, ay, right / 2 / ax * ax, ay},
            {right / 4 / ax * ax, 2 * ay, ax, bottom / 2 / ay * ay},
        };
        assert_int_equal(board_draw(&board.display, board.display.wire, right, 64), 0);
        for (size_t window = 0; window < CHECK_COUNT(windows); window++) {
            put_window(&board.display, &windows[window]);
        }
        assert_int_equal(tuile_display_present(&board.display), 0);
        board_check_clean(&board);
        check_windows(&board, rotation, windows, CHECK_COUNT(windows));
        board_close(&board);
    }
}

/* Half of an alignment is refused before anything is sent. */
static void test_windows_that_are_not_aligned(void **state) {
    const sim_panel_t *panel = *state;

    for (uint8_t rotation = 0; rotation < 4; rotation++) {
        for (unsigned format = 0; format < panel->panel->format_count; format++) {
            board_t board;
            start(&board, panel, NULL, rotation, format);
            const uint32_t ax = board.display.align_x, ay = board.display.align_y;
            const uint64_t transfers = board.bus.transfers;
            if (ax > 1) {
                assert_int_equal(tuile_display_window(&board.display, ax / 2, 0, ax, ay), TUILE_HAL_ARGUMENT);
                assert_int_equal(tuile_display_window(&board.display, 0, 0, ax + ax / 2, ay), TUILE_HAL_ARGUMENT);
            }
            if (ay > 1) {
                assert_int_equal(tuile_display_window(&board.display, 0, ay / 2, ax, ay), TUILE_HAL_ARGUMENT);
                assert_int_equal(tuile_display_window(&board.display, 0, 0, ax, ay + ay / 2), TUILE_HAL_ARGUMENT);
            }
            assert_int_equal(tuile_display_window(&board.display, 0, 0, board.display.width + ax, ay), TUILE_HAL_ARGUMENT);
            assert_int_equal(tuile_display_window(&board.display, 0, 0, ax, board.display.height + ay), TUILE_HAL_ARGUMENT);
            assert_true(board.bus.transfers == transfers);
            board_close(&board);
        }
    }
}

static void test_sleep_and_resume_are_legal_traffic(void **state) {
    const sim_panel_t *panel = *state;

    for (unsigned no_reset_pin = 0; no_reset_pin < (panel->panel->software_reset ? 2 : 1); no_reset_pin++) {
        board_t board;
        start(&board, panel, &(sim_bus_config_t){.no_reset_pin = no_reset_pin == 1}, 1, 0);
        assert_int_equal(board_draw(&board.display, board.display.wire, 480, 480), 0);
        assert_int_equal(tuile_display_resume(&board.display), 0);
        assert_int_equal(tuile_display_present(&board.display), 0);
        assert_int_equal(tuile_display_sleep(&board.display), 0);
        assert_int_equal(tuile_display_resume(&board.display), 0);
        assert_int_equal(board_draw(&board.display, board.display.wire, 480, 480), 0);
        board_check_clean(&board);
        board_check_picture(&board, 1, board.display.wire);
        assert_int_equal(tuile_display_close(&board.display), 0);
        board_check_clean(&board);
        board_close(&board);
    }
}

/* ---- faults ----------------------------------------------------------------------------------------------------- */

/* Encoded and worked out once a panel, since hundreds of frames are drawn of it. */
typedef struct frame {
    uint8_t *bytes;
    size_t size_bytes, half_bytes;
    uint32_t half_rows;
    sim_picture_t seen;
} frame_t;

static void frame_open(frame_t *frame, const board_t *board) {
    const tuile_display_t *display = &board->display;
    const uint32_t width = display->width, height = display->height;

    *frame = (frame_t){.half_rows = height / 2 / display->align_y * display->align_y};
    frame->bytes = malloc((size_t)4 * width * height);
    assert_non_null(frame->bytes);
    frame->half_bytes = board_encode(frame->bytes, display->wire, width, 0, 0, width, frame->half_rows);
    frame->size_bytes = frame->half_bytes + board_encode(frame->bytes + frame->half_bytes, display->wire, width, 0,
                                                         frame->half_rows, width, height - frame->half_rows);
    assert_int_equal(sim_picture_create(&frame->seen, width, height, NULL), 0);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            board_seen(sim_picture_at(&frame->seen, x, y), display->wire, board_colour(width, x, y));
        }
    }
}

static void frame_close(frame_t *frame) {
    free(frame->bytes);
    sim_picture_free(&frame->seen);
}

/* Two windows. */
static int frame_draw(const frame_t *frame, tuile_display_t *display) {
    const uint32_t width = frame->seen.width, rest = frame->seen.height - frame->half_rows;
    int result = tuile_display_window(display, 0, 0, width, frame->half_rows);

    if (!result) { result = tuile_display_write(display, frame->bytes, frame->half_bytes); }
    if (!result) { result = tuile_display_window(display, 0, frame->half_rows, width, rest); }
    if (!result) { result = tuile_display_write(display, frame->bytes + frame->half_bytes, frame->size_bytes - frame->half_bytes); }
    return result ? result : tuile_display_present(display);
}

static int start_identified(board_t *board, uint8_t rotation) {
    return tuile_display_init(&board->display, &(tuile_display_config_t){.bus = &board->bus.bus,
                                                                         .panel = board->panel->panel,
                                                                         .rotation = rotation,
                                                                         .identify = board->panel->panel->id_command != 0});
}

static void check_fault_at(const sim_panel_t *panel, const frame_t *frame, uint8_t rotation, sim_bus_config_t config) {
    board_t board;
    sim_picture_t seen;
    int result;

    board_open_panel(&board, panel, &config);
    result = start_identified(&board, rotation);
    if (result == 0) { result = frame_draw(frame, &board.display); }
    assert_int_equal(result, TUILE_HAL_IO);
    assert_int_equal(board.display.error, TUILE_HAL_IO);
    assert_int_equal(tuile_display_wait(&board.display), TUILE_HAL_IO);
    assert_int_equal(frame_draw(frame, &board.display), TUILE_HAL_IO);
    assert_true(board.bus.transfers == config.fail_transfer); /* nothing was tried again */
    assert_int_equal(tuile_display_resume(&board.display), 0);
    assert_true(board.display.refresh);
    assert_int_equal(frame_draw(frame, &board.display), 0);
    assert_false(board.display.refresh);
    board_check_clean(&board);
    assert_int_equal(sim_bus_picture(&board.bus, rotation, &seen, NULL), 0);
    assert_int_equal(seen.width, frame->seen.width);
    if (memcmp(seen.rgb, frame->seen.rgb, (size_t)3 * seen.width * seen.height) != 0) {
        fail_msg("%s: not the picture after a fault of %u parts at transfer %u", panel->panel->name, config.fail_parts,
                 (unsigned)config.fail_transfer);
    }
    sim_picture_free(&seen);
    board_close(&board);
}

static void test_fault_at_every_transfer(void **state) {
    const sim_panel_t *panel = *state;
    const uint8_t rotation = (uint8_t)((panel - sim_panels) % 4);
    const unsigned step = CHECK_SANITIZED ? 5 : 1;

    for (unsigned no_reset_pin = 0; no_reset_pin < (panel->panel->software_reset ? 2 : 1); no_reset_pin++) {
        const sim_bus_config_t config = {.no_reset_pin = no_reset_pin == 1, .blocking = no_reset_pin == 1};
        frame_t frame;
        board_t board;
        uint64_t transfers;
        board_open_panel(&board, panel, &config);
        assert_int_equal(start_identified(&board, rotation), 0);
        frame_open(&frame, &board);
        assert_int_equal(frame_draw(&frame, &board.display), 0);
        transfers = board.bus.transfers;
        board_close(&board);
        assert_true(transfers > 8);
        for (uint64_t transfer = 1; transfer <= transfers; transfer += step) {
            for (uint8_t parts = 0; parts <= 2; parts++) {
                sim_bus_config_t faulty = config;
                faulty.fail_transfer = transfer;
                faulty.fail_parts = parts;
                if (no_reset_pin && parts == 0) { continue; } /* nothing arrived: as with the pin */
                check_fault_at(panel, &frame, rotation, faulty);
            }
        }
        frame_close(&frame);
    }
}

/* Each of these once a panel. */
static const struct {
    const char *name;
    CMUnitTestFunction function;
} sweeps[] = {
    {"picture in each rotation and format", test_picture_in_each_rotation_and_format},
    {"partial windows", test_partial_windows},
    {"windows that are not aligned", test_windows_that_are_not_aligned},
    {"sleep and resume", test_sleep_and_resume_are_legal_traffic},
    {"fault at every transfer", test_fault_at_every_transfer},
};

int main(void) {
    enum { MOST = 64, PLAIN = 2 };
    static char names[MOST * CHECK_COUNT(sweeps)][96];
    static struct CMUnitTest tests[PLAIN + MOST * CHECK_COUNT(sweeps)] = {cmocka_unit_test(test_names),
                                                                          cmocka_unit_test(test_data_are_consistent)};
    size_t count = 0;

    if (sim_panel_count > MOST) { return 1; }
    for (size_t i = 0; i < sim_panel_count; i++) {
        for (size_t sweep = 0; sweep < CHECK_COUNT(sweeps); sweep++) {
            snprintf(names[count], sizeof names[count], "%s: %s", sim_panels[i].panel->name, sweeps[sweep].name);
            tests[PLAIN + count] = (struct CMUnitTest){
                .name = names[count], .test_func = sweeps[sweep].function, .initial_state = (void *)(uintptr_t)&sim_panels[i]};
            count++;
        }
    }
    return _cmocka_run_group_tests("panels", tests, PLAIN + count, NULL, NULL);
}
