/* The frame loop, against a renderer of our own, so that it can be made to fail at will.
 *
 * Numbers that are expected come from hand, never from the code under test. */
#include "support/check.h"

#include "../hal/display.h"
#include "../hal/panels/ili9341.h"
#include "../raster/tuile.h"
#include "../sim/bus.h"
#include "../sim/chips/ili9341.h"
#include "support/board.h"

/* A renderer of 10 tiles of 240 x 32, that fails where it is told to and looks at what the loop does. Its buffers are poisoned
 * before they are drawn anew: two of them, or one, as a real renderer has. */
struct tuile {
    tuile_config_t config;
    unsigned next, begun, ended;
    int begin_error, next_error, end_error;
    unsigned fail_at; /* tile */
    sim_bus_t *bus;
    uint64_t work_ns;     /* of a tile */
    uint64_t vertices_ns; /* before the first */
    bool prepared;
    bool left; /* the last tile may be on the wire when a frame ends */
    uint8_t buffers[2][240 * 32 * 2];
};

static int fake_begin(tuile_t *renderer, const tuile_scene_t *scene) {
    (void)scene;
    if (renderer->begin_error) { return renderer->begin_error; }
    renderer->begun++;
    renderer->next = 0;
    renderer->prepared = false;
    return 0;
}

static int fake_prepare(tuile_t *renderer) {
    if (renderer->next == 0 && !renderer->prepared) { sim_bus_work(renderer->bus, renderer->vertices_ns); }
    renderer->prepared = true;
    if (renderer->next_error && renderer->next == renderer->fail_at && renderer->fail_at % 2 == 0) { return renderer->next_error; }
    return renderer->next < 10;
}

static int fake_next(tuile_t *renderer, tuile_tile_t *tile) {
    uint8_t *to = renderer->buffers[renderer->config.buffers == 2 ? renderer->next & 1 : 0];
    uint32_t y = 32 * renderer->next;

    *tile = (tuile_tile_t){0};
    if (renderer->next_error && renderer->next == renderer->fail_at) { return renderer->next_error; }
    if (renderer->next == 10) { return 0; }
    (void)fake_prepare(renderer);
    sim_bus_work(renderer->bus, renderer->work_ns);
    memset(to, 0, sizeof renderer->buffers[0]);
    board_encode(to, TUILE_WIRE_RGB565, 240, 0, y, 240, 32);
    *tile = (tuile_tile_t){0, (uint16_t)y, 240, 32, to, sizeof renderer->buffers[0]};
    renderer->next++;
    return 1;
}

static int fake_seek(tuile_t *renderer, uint32_t tile_index) {
    renderer->next = tile_index;
    return 0;
}

static int fake_end(tuile_t *renderer, tuile_stats_t *stats) {
    if (!renderer->left) { assert_int_equal(renderer->bus->flying, 0); } /* the block is the renderer's again */
    renderer->ended++;
    if (stats) { stats->tiles = renderer->next; }
    return renderer->end_error;
}

static const tuile_config_t *fake_config(const tuile_t *renderer) { return &renderer->config; }

static const char *fake_error_text(int error) { return error ? "renderer" : "no error"; }

/* The loop itself, over that renderer, whatever else is linked. */
#define tuile_begin fake_begin
#define tuile_next fake_next
#define tuile_prepare fake_prepare
#define tuile_seek fake_seek
#define tuile_end fake_end
#define tuile_config fake_config
#define tuile_error_text fake_error_text
#define tuile_stream_frame stream_frame_under_test
#define tuile_stream_tiles stream_tiles_under_test
#define tuile_stream_flow stream_flow_under_test
#define tuile_stream_settle stream_settle_under_test
#define tuile_stream_one_window stream_one_window_under_test
#define tuile_stream_send stream_send_under_test
#define next stream_next
#define tuile_stream_error_text stream_error_text_under_test
#define tuile_stream_format stream_format_under_test
#define tuile_stream_check stream_check_under_test
#include "../firmware/stream.c"
#undef tuile_stream_check
#undef next

static const tuile_scene_t nothing;

static void open_stream(board_t *board, tuile_t *renderer, const sim_bus_config_t *config, uint8_t buffers) {
    board_open(board, config);
    memset(renderer, 0, sizeof *renderer);
    renderer->config = (tuile_config_t){.width = 240, .height = 320, .format = TUILE_RGB565_BE, .buffers = buffers};
    renderer->bus = &board->bus;
}

/* Tiles as the renderer above makes them, all of them: one window does. */
static void fill_display(tuile_t *renderer) {
    renderer->config.tile_width = 240;
    renderer->config.tile_height = 32;
    renderer->config.tile_step = 1;
    renderer->config.row_end = 320;
}

/* By one buffer or two; a window for each tile, one for all, and one into which the bus queues. */
static void test_stream_frame(void **state) {
    static tuile_t renderer;

    (void)state;
    for (unsigned variant = 0; variant < 6; variant++) {
        const uint8_t buffers = (uint8_t)(1 + variant % 2);
        board_t board;
        tuile_stats_t stats;
        open_stream(&board, &renderer, &(sim_bus_config_t){.queues = variant / 2 == 2}, buffers);
        if (variant / 2) { fill_display(&renderer); }
        assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
        for (unsigned frame = 1; frame <= 2; frame++) {
            assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, frame == 1 ? &stats : NULL), 0);
            assert_int_equal(renderer.ended, frame);
        }
        assert_int_equal(stats.tiles, 10);
        board_check_clean(&board);
        board_check_picture(&board, 0, TUILE_WIRE_RGB565);
        board_close(&board);
    }
}

/* Tiles as wide as the display, all of them: one window, 3 commands in the place of 30. Where some are left out,
 * each has its own. */
static void test_stream_sends_whole_frames_into_one_window(void **state) {
    static const struct {
        uint16_t tile_width, tile_first, tile_step, row_first, row_end;
        uint32_t commands;
    } cases[] = {
        {240, 0, 1, 0, 320, 3},  {120, 0, 1, 0, 320, 30},  {240, 1, 1, 0, 320, 30},
        {240, 0, 2, 0, 320, 30}, {240, 0, 1, 32, 320, 30}, {240, 0, 1, 0, 288, 30},
    };
    static tuile_t renderer;

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        board_t board;
        open_stream(&board, &renderer, NULL, 2);
        renderer.config.tile_width = cases[i].tile_width;
        renderer.config.tile_height = 32;
        renderer.config.tile_first = cases[i].tile_first;
        renderer.config.tile_step = cases[i].tile_step;
        renderer.config.row_first = cases[i].row_first;
        renderer.config.row_end = cases[i].row_end;
        assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), 0);
        memset(&board.bus.counts, 0, sizeof board.bus.counts);
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), 0);
        assert_int_equal(board.bus.counts.commands, cases[i].commands);
        board_check_clean(&board);
        board_check_picture(&board, 0, TUILE_WIRE_RGB565);
        board_close(&board);
    }
}

/* A frame that ended in the middle of the window leaves nothing behind: the next one begins at the top. */
static void test_stream_begins_anew_after_a_frame_that_broke_off(void **state) {
    static tuile_t renderer;
    board_t board;

    (void)state;
    open_stream(&board, &renderer, NULL, 2);
    fill_display(&renderer);
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
    renderer.next_error = TUILE_ERROR_RANGE;
    for (renderer.fail_at = 0; renderer.fail_at <= 10; renderer.fail_at++) {
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), TUILE_ERROR_RANGE);
    }
    renderer.next_error = 0;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), 0);
    board_check_clean(&board);
    board_check_picture(&board, 0, TUILE_WIRE_RGB565);
    board_close(&board);
}

/* The simulator must show what a renderer does that says it has two buffers and has one: else the loop's overlap is not tested. */
static void test_stream_overlaps_with_two_buffers_only(void **state) {
    static tuile_t renderer;
    board_t board;

    (void)state;
    open_stream(&board, &renderer, NULL, 2);
    renderer.config.buffers = 3; /* taken for two or more by the loop, for one by the renderer above */
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), 0);
    /* every tile but the last went out with the colours of the one after it */
    for (uint32_t x = 0; x < 240; x++) {
        uint32_t c = board_colour(240, x, 32);
        assert_int_equal(sim_dcs_memory(board.chip, x, 0), (c & ~0x1001u) | (c >> 5 & 0x1000) | (c >> 5 & 1));
    }
    board_close(&board);
}

static void test_stream_refuses_a_mismatch(void **state) {
    static tuile_t renderer;
    board_t board;
    tuile_stats_t stats = {.tiles = 99};

    (void)state;
    open_stream(&board, &renderer, NULL, 2);
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
    renderer.config.width = 239;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_ARGUMENT);
    renderer.config.width = 240;
    renderer.config.format = TUILE_RGB565_LE;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_ARGUMENT);
    renderer.config.format = TUILE_RGB565_BE;
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB666), 0);
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_ARGUMENT);
    assert_int_equal(renderer.begun, 0);
    assert_int_equal(stats.tiles, 0);
    board_close(&board);
}

/* A panel whose bytes are 8 rows takes no window that begins within one. */
static void test_stream_refuses_tiles_that_are_not_aligned(void **state) {
    static tuile_t renderer;
    board_t board;
    tuile_panel_t panel = tuile_ili9341;

    (void)state;
    open_stream(&board, &renderer, NULL, 2);
    panel.align_y = 64;
    panel.align_x = 240;
    assert_int_equal(tuile_display_init(&board.display, &(tuile_display_config_t){.bus = &board.bus.bus, .panel = &panel}), 0);
    renderer.config.tile_width = 240;
    renderer.config.tile_height = 32;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), TUILE_ERROR_ARGUMENT);
    assert_int_equal(renderer.begun, 0);
    renderer.config.tile_height = 1024; /* larger than the window: one tile */
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL),
                     TUILE_HAL_ARGUMENT); /* fakes strips of 32 */
    assert_int_equal(renderer.begun, 1);
    board_close(&board);
}

static void test_stream_renderer_errors(void **state) {
    static tuile_t renderer;
    board_t board;
    tuile_stats_t stats;

    (void)state;
    open_stream(&board, &renderer, NULL, 2);
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
    renderer.begin_error = TUILE_ERROR_CAMERA;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_CAMERA);
    assert_int_equal(renderer.ended, 0);
    renderer.begin_error = 0;
    renderer.next_error = TUILE_ERROR_RANGE;
    for (renderer.fail_at = 0; renderer.fail_at <= 10; renderer.fail_at++) {
        renderer.begun = renderer.ended = 0;
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_RANGE);
        assert_int_equal(renderer.begun, 1);
        assert_int_equal(renderer.ended, 1);
        assert_int_equal(stats.tiles, renderer.fail_at);
        assert_int_equal(board.display.error, 0);
        assert_true(board.display.refresh); /* never presented */
    }
    renderer.next_error = 0;
    renderer.end_error = TUILE_ERROR_SEQUENCE;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_ERROR_SEQUENCE);
    renderer.end_error = 0;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), 0);
    board_check_clean(&board);
    board_check_picture(&board, 0, TUILE_WIRE_RGB565);
    board_close(&board);
}

static void test_stream_display_faults(void **state) {
    static tuile_t renderer;

    (void)state;
    /* 21 transfers of the start, 10 tiles of 4; or a window of 3 and 10 tiles, which are queued */
    for (uint64_t transfer = 22; transfer <= 61 + 13; transfer++) {
        const bool queues = transfer > 61;
        board_t board;
        tuile_stats_t stats;
        open_stream(&board, &renderer,
                    &(sim_bus_config_t){.fail_transfer = queues ? transfer - 40 : transfer, .fail_parts = 1, .queues = queues}, 2);
        if (queues) { fill_display(&renderer); }
        assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_HAL_IO);
        assert_int_equal(board.bus.transfers, queues ? transfer - 40 : transfer); /* nothing goes out after it */
        assert_int_equal(renderer.begun, 1);
        assert_int_equal(renderer.ended, 1);
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), TUILE_HAL_IO);
        assert_int_equal(renderer.begun, 1); /* nothing is drawn for a display that is out of order */
        assert_int_equal(tuile_display_resume(&board.display), 0);
        assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, &stats), 0);
        board_check_clean(&board);
        board_check_picture(&board, 0, TUILE_WIRE_RGB565);
        board_close(&board);
    }
}

/* A fault of the last tile's transfer must not hide behind a renderer's error at the tile after it, nor get lost. */
static void test_stream_both_fail(void **state) {
    static tuile_t renderer;
    board_t board;

    (void)state;
    open_stream(&board, &renderer, &(sim_bus_config_t){.fail_transfer = 24}, 2); /* the data of tile 0 */
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
    renderer.next_error = TUILE_ERROR_RANGE;
    renderer.fail_at = 1;
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), TUILE_ERROR_RANGE);
    assert_int_equal(renderer.ended, 1);
    assert_int_equal(board.display.error, TUILE_HAL_IO);
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), TUILE_HAL_IO);
    board_close(&board);
}

/* A tile takes 5 ms to draw, its window 11 bytes at 10 MHz and its pixels 15 360 at 62.5 MHz. A frame by itself ends
 * with those of its last tile; of frames that flow only the last one does. */
static void test_frames_that_flow_overlap_at_their_ends(void **state) {
    static tuile_t renderer;
    static const uint64_t tile_ns = 5000000 + 8800, pixels_ns = 1966080;
    const tuile_display_config_t config = {.panel = &tuile_ili9341, .pixel_clock_hz = 62500000};

    (void)state;
    for (uint8_t buffers = 1; buffers <= 2; buffers++) {
        board_t board;
        uint64_t before_ns;
        tuile_display_config_t on = config;
        open_stream(&board, &renderer, NULL, buffers);
        on.bus = &board.bus.bus;
        assert_int_equal(tuile_display_init(&board.display, &on), 0);
        assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), 0);
        assert_true(board.display.lit); /* the first frame is shown at once */
        assert_int_equal(board.bus.flying, 0);
        renderer.left = buffers == 2;
        renderer.work_ns = 5000000;
        before_ns = board.bus.now_ns;
        for (unsigned frame = 0; frame < 3; frame++) {
            assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), 0);
            assert_int_equal(board.bus.flying != 0, buffers == 2);
        }
        assert_int_equal(stream_settle_under_test(&board.display), 0);
        assert_int_equal(board.bus.flying, 0);
        assert_int_equal(board.bus.now_ns - before_ns, 30 * tile_ns + (buffers == 2 ? 1 : 30) * pixels_ns);
        renderer.left = false;
        before_ns = board.bus.now_ns;
        for (unsigned frame = 0; frame < 3; frame++) {
            assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), 0);
        }
        assert_int_equal(board.bus.now_ns - before_ns, 30 * tile_ns + (buffers == 2 ? 3 : 30) * pixels_ns);
        assert_string_equal(board.bus.error.text, "");
        board_check_picture(&board, 0, TUILE_WIRE_RGB565);
        board_close(&board);
    }
}

/* Two buffers, one window of 8.8 us; a tile is drawn in 1 ms, its pixels take w = 1.96608 ms. Let the wire of a frame begin at t.
 * Each tile from the third on is drawn when the one two before it is out: the last from t + 8 w. Queued, it needs no more of the
 * processor, which has the next frame's vertices ready at t + 8 w + 1 ms + v and the first tile 1 ms later, if its buffer is free
 * by t + 9 w. Pixels begin behind that, and not before t + 10 w. Without a queue the last tile is handed over at t + 9 w, and
 * vertices begin then. */
static void test_vertices_do_not_wait_for_the_wire_where_it_queues(void **state) {
    static tuile_t renderer;
    static const uint64_t w = 1966080, window = 8800, ms = 1000000;
    static const struct {
        bool queues;
        uint64_t vertices_ns, period_ns;
    } cases[] = {
        {true, 4 * ms, 8 * w + ms + 4 * ms + ms + window}, /* the longer of both: 14 ms of drawing but for 6 pauses of the tiles */
        {false, 4 * ms, 9 * w + 4 * ms + ms + window},
        {true, ms / 2, 10 * w + window}, /* the wire never rests */
        {false, ms / 2, 10 * w + window},
        {true, 0, 10 * w + window},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        tuile_display_config_t config = {.panel = &tuile_ili9341, .pixel_clock_hz = 62500000};
        board_t board;
        uint64_t before_ns = 0;
        open_stream(&board, &renderer, &(sim_bus_config_t){.queues = cases[i].queues}, 2);
        fill_display(&renderer);
        config.bus = &board.bus.bus;
        assert_int_equal(tuile_display_init(&board.display, &config), 0);
        renderer.vertices_ns = cases[i].vertices_ns;
        renderer.work_ns = ms;
        renderer.left = true;
        for (unsigned frame = 0; frame < 6; frame++) {
            if (frame >= 3) { assert_int_equal(board.bus.now_ns - before_ns, cases[i].period_ns); }
            before_ns = board.bus.now_ns;
            assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), 0);
        }
        assert_int_equal(stream_settle_under_test(&board.display), 0);
        board_check_picture(&board, 0, TUILE_WIRE_RGB565);
        assert_string_equal(board.bus.error.text, "");
        board_close(&board);
    }
}

/* A frame's first window waits for the panel to have shown its last line, that of a frame that flows as well: every 100 ms, which
 * is more than a frame's 19.7 and what is left of the one before. */
static void test_each_frame_that_flows_waits_for_the_tearing_line(void **state) {
    static tuile_t renderer;
    tuile_display_config_t config = {.panel = &tuile_ili9341, .pixel_clock_hz = 62500000, .tearing_timeout_ms = 200};
    board_t board;

    (void)state;
    open_stream(&board, &renderer, &(sim_bus_config_t){.refresh_hz = 10}, 2);
    config.bus = &board.bus.bus;
    assert_int_equal(tuile_display_init(&board.display, &config), 0);
    renderer.left = true;
    for (unsigned frame = 0; frame < 4; frame++) {
        const uint64_t before = board.bus.now_ns / 100000000;
        assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), 0);
        assert_int_equal(board.bus.now_ns / 100000000, before + 1);
    }
    assert_int_equal(stream_settle_under_test(&board.display), 0);
    board_close(&board);
}

/* 21 transfers of the start, 13 of a frame in one window: the last two tiles of the second are the 46th and the 47th. */
static void test_a_fault_of_two_tiles_left_behind_is_told_by_the_next_call(void **state) {
    static tuile_t renderer;

    (void)state;
    for (unsigned variant = 0; variant < 4; variant++) {
        const uint64_t transfer = 46 + variant % 2;
        board_t board;
        open_stream(&board, &renderer, &(sim_bus_config_t){.fail_transfer = transfer, .queues = true}, 2);
        fill_display(&renderer);
        assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
        assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), 0);
        assert_int_equal(board.bus.transfers, 34);
        renderer.left = true;
        assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), 0);
        assert_int_equal(board.bus.flying, 2);
        assert_int_equal(variant / 2 ? stream_settle_under_test(&board.display)
                                     : stream_flow_under_test(&renderer, &nothing, &board.display, NULL),
                         TUILE_HAL_IO);
        assert_int_equal(board.display.error, TUILE_HAL_IO);
        assert_int_equal(board.bus.flying, 0);
        assert_int_equal(board.bus.transfers, transfer);
        board_close(&board);
    }
}

/* 21 transfers of the start and 40 of a frame; the last of the next frame is the 101st, which a frame that
 * flows leaves on the wire. */
static void test_a_fault_of_the_tile_left_behind_is_told_by_the_next_call(void **state) {
    static tuile_t renderer;

    (void)state;
    for (unsigned settle = 0; settle < 2; settle++) {
        board_t board;
        open_stream(&board, &renderer, &(sim_bus_config_t){.fail_transfer = 101}, 2);
        assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
        assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), 0);
        assert_int_equal(board.bus.transfers, 61);
        renderer.left = true;
        assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), 0);
        assert_int_equal(board.bus.transfers, 101);
        assert_int_equal(settle ? stream_settle_under_test(&board.display)
                                : stream_flow_under_test(&renderer, &nothing, &board.display, NULL),
                         TUILE_HAL_IO);
        assert_int_equal(renderer.ended, settle ? 2 : 3);
        assert_int_equal(board.display.error, TUILE_HAL_IO);
        assert_int_equal(board.bus.transfers, 101); /* nothing more was sent */
        renderer.begun = 0;
        assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), TUILE_HAL_IO);
        assert_int_equal(renderer.begun, 0);
        board_close(&board);
    }
}

static void check_renderer_s_error(bool queues) {
    static tuile_t renderer;
    board_t board;

    open_stream(&board, &renderer, &(sim_bus_config_t){.queues = queues}, 2);
    if (queues) { fill_display(&renderer); }
    renderer.left = true;
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
    for (unsigned kind = 0; kind < 4; kind++) {
        for (unsigned i = 0; i < 2; i++) {
            assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), 0);
        }
        assert_int_equal(board.bus.flying, queues ? 2 : 1);
        renderer.begin_error = kind == 0 ? TUILE_ERROR_CAMERA : 0;
        renderer.next_error = kind == 1 || kind == 2 ? TUILE_ERROR_CAMERA : 0;
        renderer.fail_at = kind == 1 ? 0 : 10;
        renderer.end_error = kind == 3 ? TUILE_ERROR_CAMERA : 0;
        assert_int_equal(stream_flow_under_test(&renderer, &nothing, &board.display, NULL), TUILE_ERROR_CAMERA);
        assert_int_equal(board.bus.flying, 0);
        assert_int_equal(board.display.error, 0);
        renderer.begin_error = renderer.next_error = renderer.end_error = 0;
    }
    assert_int_equal(stream_frame_under_test(&renderer, &nothing, &board.display, NULL), 0);
    board_check_clean(&board);
    board_check_picture(&board, 0, TUILE_WIRE_RGB565);
    board_close(&board);
}

static void test_a_renderer_s_error_leaves_nothing_on_the_wire(void **state) {
    (void)state;
    check_renderer_s_error(false);
    check_renderer_s_error(true);
}

static void test_error_texts(void **state) {
    (void)state;
    for (int error = TUILE_HAL_GONE; error <= TUILE_HAL_ARGUMENT; error++) {
        assert_non_null(tuile_hal_error_text(error));
        assert_string_not_equal(tuile_hal_error_text(error), tuile_hal_error_text(-1000));
        assert_ptr_equal(stream_error_text_under_test(error), tuile_hal_error_text(error));
        for (int other = TUILE_HAL_GONE; other < error; other++) {
            assert_string_not_equal(tuile_hal_error_text(error), tuile_hal_error_text(other));
        }
    }
    assert_string_equal(stream_error_text_under_test(TUILE_ERROR_MEMORY), "renderer");
    assert_string_equal(tuile_hal_error_text(0), "no error");
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stream_frame),
        cmocka_unit_test(test_stream_sends_whole_frames_into_one_window),
        cmocka_unit_test(test_stream_begins_anew_after_a_frame_that_broke_off),
        cmocka_unit_test(test_stream_overlaps_with_two_buffers_only),
        cmocka_unit_test(test_stream_refuses_a_mismatch),
        cmocka_unit_test(test_stream_refuses_tiles_that_are_not_aligned),
        cmocka_unit_test(test_stream_renderer_errors),
        cmocka_unit_test(test_stream_display_faults),
        cmocka_unit_test(test_stream_both_fail),
        cmocka_unit_test(test_frames_that_flow_overlap_at_their_ends),
        cmocka_unit_test(test_vertices_do_not_wait_for_the_wire_where_it_queues),
        cmocka_unit_test(test_a_fault_of_two_tiles_left_behind_is_told_by_the_next_call),
        cmocka_unit_test(test_each_frame_that_flows_waits_for_the_tearing_line),
        cmocka_unit_test(test_a_fault_of_the_tile_left_behind_is_told_by_the_next_call),
        cmocka_unit_test(test_a_renderer_s_error_leaves_nothing_on_the_wire),
        cmocka_unit_test(test_error_texts),
    };
    return cmocka_run_group_tests_name("stream", tests, NULL, NULL);
}
