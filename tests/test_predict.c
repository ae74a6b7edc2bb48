/* Predicted pace: events counted from a picture that is known, costs made up here, and the clock of a bus on which drawing and
 * sending overlap. All expected values are from hand. */
#include "support/check.h"

#include "../firmware/stream.h"
#include "../sim/predict.h"
#include "../sim/view.h"
#include "support/board.h"
#include "support/cli.h"
#include "support/scenes.h"

#include <math.h>
#include <unistd.h>

/* ---- arithmetic --------------------------------------------------------------------------------------------------- */

static void instructions_are_events_times_their_costs(void **state) {
    (void)state;
    predict_costs_t costs = {.core = "x",
                             .milli = {[PREDICT_FRAME] = 1000000, [PREDICT_VERTEX] = 12250, [PREDICT_SMALL_FRAGMENT] = 400}};
    predict_events_t events = {{[PREDICT_FRAME] = 1, [PREDICT_VERTEX] = 2, [PREDICT_TILE] = 99, [PREDICT_SMALL_FRAGMENT] = 10}};
    assert_int_equal(predict_instructions(&costs, &events), 1000 + 29); /* 24.5 + 4 = 28.5, to the nearest: up */
    events.count[PREDICT_SMALL_FRAGMENT] = 9;
    assert_int_equal(predict_instructions(&costs, &events), 1000 + 28); /* 24.5 + 3.6 = 28.1 */
    for (unsigned i = 0; i < PREDICT_EVENT_COUNT; i++) {
        costs.milli[i] = 1000u << 18;
        events.count[i] = INT32_MAX;
    }
    assert_true(predict_instructions(&costs, &events) == ((uint64_t)INT32_MAX << 18) * PREDICT_EVENT_COUNT);
}

static void time_is_cycles_of_the_core(void **state) {
    (void)state;
    const sim_mcu_t mcu = {.core_hz = 125000000, .cycles_milli = 1400};
    assert_int_equal(predict_ns(&mcu, 0), 0);
    assert_int_equal(predict_ns(&mcu, 1000), 11200); /* 1400 cycles of 8 ns */
    assert_int_equal(predict_ns(&mcu, 1), 12);       /* 11.2, rounded up */
    assert_int_equal(predict_ns(&mcu, 125000000), 1400000000);
    /* 2^33 * 1.4 * 8 ns = 96 207 267 430.4 ns */
    assert_true(predict_ns(&mcu, UINT64_C(1) << 33) == UINT64_C(96207267431));
    const sim_mcu_t slow = {.core_hz = 16000000, .cycles_milli = 1000, .transfer_cycles = 3};
    assert_int_equal(predict_ns(&slow, 16), 1000);
    assert_int_equal(sim_mcu_transfer_ns(&slow), 188); /* 187.5 */
}

static void the_longer_of_both_binds(void **state) {
    (void)state;
    char text[160];
    assert_int_equal(predict_bound(2, 1), PREDICT_RENDER_BOUND);
    assert_int_equal(predict_bound(1, 1), PREDICT_RENDER_BOUND);
    assert_int_equal(predict_bound(1, 2), PREDICT_BUS_BOUND);
    assert_true(predict_ratio(3, 6) == 2.0 && predict_ratio(6, 3) == 2.0 && predict_ratio(0, 5) == 0.0 &&
                predict_ratio(7, 7) == 1.0);
    const sim_mcu_t mcu = {.name = "chip"};
    predict_t predict = {.mcu = &mcu, .frames = 2, .render_sum_ns = 72000000, .wire_sum_ns = 40000000, .frame_sum_ns = 80000000};
    predict_text(&predict, text, sizeof text);
    assert_string_equal(text, "chip: 25.0 frames a second (40.00 ms), render-bound: drawing takes 1.8 times as long as the wire");
    predict.render_sum_ns = 10000000;
    predict_text(&predict, text, sizeof text);
    assert_string_equal(text, "chip: 25.0 frames a second (40.00 ms), bus-bound: the wire takes 4.0 times as long as drawing");
}

static void overlay(void *context, tuile_canvas_t *canvas) { (void)context, (void)canvas; }

static void what_nobody_counted_is_said(void **state) {
    (void)state;
    char text[128];
    tuile_config_t config = {.effects = TUILE_SURFACES};
    const predict_costs_t costs = {.core = "x"}, compact = {.core = "compact"};
    assert_false(predict_leaves_out(&costs, &config, text, sizeof text));
    assert_string_equal(text, "");
    config =
        (tuile_config_t){.format = TUILE_GREY4, .dither = true, .overlay = overlay, .aa = TUILE_AA_2X2, .effects = TUILE_LAYERS};
    assert_true(predict_leaves_out(&costs, &config, text, sizeof text));
    assert_string_equal(text, "overlay, pixels that are not RGB565, dithering, anti-aliasing, layers");
    assert_true(predict_leaves_out(&costs, &config, text, 12)); /* cut short, not beyond */
    assert_string_equal(text, "overlay, pi");
    config = (tuile_config_t){.format = TUILE_MONO_PAGES, .dither = true};
    assert_false(predict_leaves_out(&compact, &config, text, sizeof text));
    assert_true(predict_leaves_out(&costs, &config, text, sizeof text));
    config.format = TUILE_RGB565_BE;
    assert_true(predict_leaves_out(&compact, &config, text, sizeof text));
    assert_string_equal(text, "pixels that are not black and white");
}

static void every_core_and_shading_has_costs(void **state) {
    (void)state;
    for (size_t i = 0; i < sim_mcu_count; i++) {
        const sim_mcu_t *mcu = &sim_mcus[i];
        const bool compact = strcmp(mcu->core, "compact") == 0;
        for (unsigned kind = 0; kind < 4 && !compact; kind++) {
            tuile_config_t config = {.shade = kind & 1 ? TUILE_GOURAUD : TUILE_FLAT, .effects = kind & 2 ? TUILE_SURFACES : 0};
            const predict_costs_t *costs = predict_costs_find(mcu, &config);
            assert_non_null(costs);
            assert_string_equal(costs->core, mcu->core);
            assert_int_equal(costs->shade, config.shade);
            assert_int_equal(costs->textured, config.effects != 0);
            config.method = TUILE_PAINTER;
            assert_null(predict_costs_find(mcu, &config));
        }
        assert_true(mcu->cycles_milli >= 1000 && mcu->cycles_from);
    }
    const sim_mcu_t *uno = sim_mcu_find("atmega328p");
    assert_non_null(predict_costs_find(uno, &(tuile_config_t){.method = TUILE_ZBUFFER}));
    assert_non_null(predict_costs_find(uno, &(tuile_config_t){.method = TUILE_TREE}));
    assert_null(predict_costs_find(uno, &(tuile_config_t){.method = TUILE_SCANLINE}));
    assert_null(predict_costs_find(uno, &(tuile_config_t){.shade = TUILE_GOURAUD}));
}

/* ---- events ------------------------------------------------------------------------------------------------------- */

static void check_events(const predict_events_t *events, const uint64_t expected[PREDICT_EVENT_COUNT]) {
    for (unsigned i = 0; i < PREDICT_EVENT_COUNT; i++) {
        if (events->count[i] != expected[i]) {
            fail_msg("event %u: %u, not %u", i, (unsigned)events->count[i], (unsigned)expected[i]);
        }
    }
}

/* A rectangle of 8 x 16 pixels in rows 4 to 19 of three tiles of 8 rows: 4, 8 and 4 of them. */
static void events_come_with_the_tile_that_they_happen_in(void **state) {
    (void)state;
    static const uint64_t expected[3][PREDICT_EVENT_COUNT] = {
        {[PREDICT_FRAME] = 1,
         [PREDICT_CLUSTER] = 1,
         [PREDICT_VERTEX] = 4,
         [PREDICT_POLYGON_TESTED] = 1,
         [PREDICT_FACE_BINNED] = 1,
         [PREDICT_FACE_SET_UP] = 1,
         [PREDICT_POLYGON_IN_TILE] = 1,
         [PREDICT_TILE] = 1,
         [PREDICT_TILE_SAMPLE] = 128,
         [PREDICT_FACE_OF_TILE] = 1,
         [PREDICT_POLYGON_ROW] = 4,
         [PREDICT_POLYGON_FRAGMENT] = 32},
        {[PREDICT_POLYGON_IN_TILE] = 1,
         [PREDICT_TILE] = 1,
         [PREDICT_TILE_SAMPLE] = 128,
         [PREDICT_FACE_OF_TILE] = 1,
         [PREDICT_POLYGON_ROW] = 8,
         [PREDICT_POLYGON_FRAGMENT] = 64},
        {[PREDICT_POLYGON_IN_TILE] = 1,
         [PREDICT_TILE] = 1,
         [PREDICT_TILE_SAMPLE] = 128,
         [PREDICT_FACE_OF_TILE] = 1,
         [PREDICT_POLYGON_ROW] = 4,
         [PREDICT_POLYGON_FRAGMENT] = 32},
    };
    static const uint64_t none[PREDICT_EVENT_COUNT] = {0};
    static _Alignas(8) uint8_t block[65536];
    test_scene_t scene;
    predict_meter_t meter;
    predict_events_t events;
    tuile_t *renderer;
    tuile_tile_t tile;
    test_scene_open(&scene, "screen 16 24\ncamera ortho\nsample 1/2 1/2\npoly 1 4,4,0 12,4,0 12,20,0 4,20,0\n");
    predict_meter_open(&meter);
    const tuile_config_t config = {.width = 16, .height = 24, .tile_height = 8, .trace = &meter.trace};
    events = predict_meter_take(&meter); /* no renderer yet */
    check_events(&events, none);
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
    meter.renderer = renderer;
    for (unsigned frame = 0; frame < 2; frame++) {
        predict_meter_begin(&meter);
        events = predict_meter_take(&meter);
        check_events(&events, none);
        assert_int_equal(tuile_begin(renderer, &scene.scene), 0);
        for (unsigned i = 0; i < 3; i++) {
            const bool first = frame == 1 && i == 0;
            predict_events_t prepared = {{0}};
            if (frame == 1) {
                assert_int_equal(tuile_prepare(renderer), 1);
                prepared = predict_meter_take(&meter);
                assert_int_equal(prepared.count[PREDICT_VERTEX], first ? 4 : 0);
                assert_int_equal(prepared.count[PREDICT_FACE_BINNED], first ? 1 : 0);
                assert_int_equal(prepared.count[PREDICT_TILE_SAMPLE] + prepared.count[PREDICT_POLYGON_FRAGMENT], 0);
            }
            assert_int_equal(tuile_next(renderer, &tile), 1);
            events = predict_meter_take(&meter);
            for (unsigned k = 0; k < PREDICT_EVENT_COUNT; k++) {
                events.count[k] += prepared.count[k];
            }
            check_events(&events, expected[i]);
        }
        events = predict_meter_take(&meter);
        check_events(&events, none);
        assert_int_equal(tuile_next(renderer, &tile), 0);
        assert_int_equal(tuile_end(renderer, NULL), 0);
        events = predict_meter_take(&meter);
        check_events(&events, none);
    }
    test_scene_close(&scene);
}

/* ---- the clock ---------------------------------------------------------------------------------------------------- */

static uint64_t take_work(void *context) {
    uint64_t *left = context;
    const uint64_t work = *left;
    *left = 0;
    return work;
}

/* Three tiles of 240 x 10 pixels at 10 MHz, 3.84 ms each, in windows of 11 bytes, 8.8 us; each drawn in so much. Returns the time.
 */
static uint64_t send_three(uint64_t work_ns, bool one_buffer, bool blocking, uint32_t gap_ns) {
    static const uint8_t bytes[4800];
    uint64_t left = 0, begun;
    board_t board;
    board_open(&board, &(sim_bus_config_t){.clock_hz = 10000000,
                                           .command_clock_hz = 10000000,
                                           .blocking = blocking,
                                           .command_gap_ns = gap_ns,
                                           .chunk_gap_ns = gap_ns});
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
    sim_bus_listen(&board.bus, take_work, &left);
    board.bus.counts = (sim_bus_counts_t){0};
    begun = board.bus.now_ns;
    for (uint32_t i = 0; i < 3; i++) {
        left = work_ns;
        assert_int_equal(tuile_display_window(&board.display, 0, 10 * i, 240, 10), 0);
        assert_int_equal(tuile_display_write(&board.display, bytes, sizeof bytes), 0);
        if (one_buffer) { assert_int_equal(tuile_display_wait(&board.display), 0); }
    }
    assert_int_equal(tuile_display_wait(&board.display), 0);
    assert_int_equal(left, 0);
    assert_true(board.bus.counts.work_ns == 3 * work_ns);
    const uint64_t taken = board.bus.now_ns - begun;
    board_check_clean(&board);
    board_close(&board);
    return taken;
}

static void drawing_hides_behind_the_wire_or_the_wire_behind_drawing(void **state) {
    (void)state;
    /* Drawing is longer: three times 5 ms and a window, and the last tile's 3.84 ms. */
    assert_int_equal(send_three(5000000, false, false, 0), 15000000 + 26400 + 3840000);
    /* The wire is: 1 ms, then three times a window and 3.84 ms. */
    assert_int_equal(send_three(1000000, false, false, 0), 1000000 + 26400 + 11520000);
    /* One buffer, and a core that feeds the wire itself: one after the other. */
    assert_int_equal(send_three(5000000, true, false, 0), 15000000 + 26400 + 11520000);
    assert_int_equal(send_three(5000000, false, true, 0), 15000000 + 26400 + 11520000);
    /* 1 us for each of three commands, which nothing hides, and for the last chunk; the other two are behind drawing. */
    assert_int_equal(send_three(5000000, false, false, 1000), 15000000 + 26400 + 9000 + 1000 + 3840000);
}

static void work_is_on_the_clock_before_anything_is_done(void **state) {
    (void)state;
    static const uint8_t window[] = {0x2c}, bytes[2];
    uint64_t left = 0, begun;
    board_t board;
    board_open(&board, &(sim_bus_config_t){.clock_hz = 10000000, .command_clock_hz = 10000000});
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
    sim_bus_listen(&board.bus, take_work, &left);
    begun = board.bus.now_ns;
    left = 1000;
    assert_int_equal(board.bus.bus.command(&board.bus, window, 1, 1), 0);
    assert_int_equal(board.bus.now_ns - begun, 1000 + 800);
    left = 2000;
    assert_int_equal(board.bus.bus.data(&board.bus, bytes, 2), 0);
    assert_int_equal(board.bus.now_ns - begun, 3000 + 800);
    left = 600; /* of 1600 that the data take */
    assert_int_equal(board.bus.bus.wait(&board.bus), 0);
    assert_int_equal(board.bus.now_ns - begun, 3000 + 800 + 1600);
    left = 5000;
    assert_int_equal(board.bus.bus.delay_ms(&board.bus, 1), 0);
    assert_int_equal(board.bus.now_ns - begun, 8000 + 800 + 1600 + 1000000);
    board_close(&board);
}

static void a_frame_begins_with_nothing(void **state) {
    (void)state;
    predict_t predict = {.lead_ns = 7, .render_sum_ns = 11, .events = {{1, 2, 3}}, .meter = {.seen = {{4}}, .in_frame = true}};
    sim_bus_t bus = {.now_ns = 5};
    predict_frame_begin(&predict, &bus);
    assert_int_equal(predict.lead_ns, 0);
    assert_int_equal(predict.started_ns, 5);
    assert_int_equal(predict.render_sum_ns, 11);
    assert_int_equal(predict.events.count[0] + predict.events.count[1] + predict.events.count[2] + predict.meter.seen.count[0], 0);
    bus = (sim_bus_t){.now_ns = 105, .counts = {.work_ns = 60, .wire_ns = 30, .gap_ns = 20}};
    predict_frame_end(&predict, &bus);
    assert_int_equal(predict.render_ns, 60);
    assert_int_equal(predict.wire_ns, 50);
    assert_int_equal(predict.frame_ns, 100);
    assert_int_equal(predict.render_sum_ns, 71);
}

/* ---- as a user meets it --------------------------------------------------------------------------------------------- */

/* Figures of the first frame of a report. */
typedef struct figures {
    double render, wire, frame, lead, tiles;
} figures_t;

static double number_after(const char *text, const char *word) {
    const char *at = strstr(text, word);
    if (!at) { fail_msg("no %s in %s", word, text); }
    return at ? strtod(at + strlen(word), NULL) : 0;
}

static char *report_of(const char *arguments) {
    char line[1024];
    (void)snprintf(line, sizeof line, "render %s --report @/p.json", arguments);
    cli_good_silent(line);
    char *text = command_read(cli_path("p.json"), NULL);
    assert_non_null(text);
    (void)unlink(cli_path("p.json"));
    return text;
}

static figures_t figures_of(const char *arguments) {
    char *text = report_of(arguments);
    const figures_t f = {number_after(text, "\"render_ns\": "), number_after(text, "\"wire_ns\": "),
                         number_after(text, "\"frame_ns\": "), number_after(text, "\"lead_ns\": "),
                         number_after(text, "\"tiles\": ")};
    free(text);
    return f;
}

static void a_report_says_what_binds_and_by_how_much(void **state) {
    const char *bunny = getenv("BUNNY_6000");
    char line[512];
    (void)state;
    assert_non_null(bunny);
    (void)snprintf(line, sizeof line, "%s --panel st7789-135x240 --tile 135x3 --mcu rp2040 --clock 62.5M", bunny);
    for (unsigned i = 0; i < 2; i++) {
        char *text = report_of(i ? line : "@/cube.obj --panel ili9341 --mcu stm32f4");
        const double render = number_after(text, "\"render_ns\": "), wire = number_after(text, "\"wire_ns\": ");
        const double frame = number_after(text, "\"frame_ns\": "), instructions = number_after(text, "\"instructions\": ");
        const sim_mcu_t *mcu = sim_mcu_find(i ? "rp2040" : "stm32f4");
        assert_non_null(strstr(text, i ? "\"bound\": \"render\"" : "\"bound\": \"bus\""));
        assert_true(fabs(number_after(text, "\"bound_by\": ") - (i ? render / wire : wire / render)) <= 0.005001);
        assert_true(fabs(number_after(text, "\"fps\": ") - 1e9 / frame) <= 0.005001);
        /* Rounded up for each tile. */
        assert_true(fabs(render - instructions * mcu->cycles_milli / 1000.0 * 1e9 / mcu->core_hz) < 1000);
        assert_true(frame >= render && frame >= wire && frame < render + wire);
        assert_non_null(strstr(text, "\"not_counted\": \"\""));
        free(text);
    }
    (void)snprintf(line, sizeof line,
                   "render %s --panel st7789-135x240 --tile 135x3 --mcu rp2040 --clock 62.5M --overlay-text 8,8,x", bunny);
    char *text = cli_good(line);
    assert_non_null(strstr(text, "rp2040: "));
    assert_non_null(strstr(text, " ms), render-bound: drawing takes "));
    assert_non_null(strstr(text, "; not counted: overlay\n"));
    free(text);
    text = cli_good("render @/cube.obj --mcu atmega328p");
    assert_non_null(strstr(text, "; not counted: pixels that are not black and white\n"));
    free(text);
    text = cli_good("render @/cube.obj --display sim:ili9341,mcu=rp2040 --method scanline");
    assert_non_null(strstr(text, "rp2040: no prediction: nobody has counted what this method and shading take there\n"));
    free(text);
}

static void with_one_buffer_drawing_and_sending_add_up(void **state) {
    (void)state;
    const char *scene = "@/torus.obj --panel st7789-240x240 --mcu rp2040 --clock 20M --tile 240x24";
    char line[256];
    (void)snprintf(line, sizeof line, "%s --buffers 1", scene);
    const figures_t one = figures_of(line), two = figures_of(scene);
    assert_true(one.frame == one.render + one.wire);
    /* Pixels that are queued do not wait for the driver. */
    assert_true(two.render == one.render && two.wire < one.wire && two.frame < one.frame);
    /* An Uno's core feeds the wire itself, however many buffers there are. */
    const figures_t uno = figures_of("@/cube.obj --panel ssd1306-128x64 --mcu atmega328p --method tree --tile 128x8");
    assert_true(uno.render > 0 && uno.wire > 0 && uno.frame == uno.render + uno.wire);
}

/* The first frame of an update is sent whole, and all its bytes are summed. */
static void sums_of_an_update_are_drawing(void **state) {
    (void)state;
    const char *scene = "@/torus.obj --panel ili9341 --mcu rp2040 --tile 240x16";
    char line[256];
    (void)snprintf(line, sizeof line, "%s --update 16", scene);
    char *without = report_of(scene), *with = report_of(line);
    const double more = number_after(with, "\"instructions\": ") - number_after(without, "\"instructions\": ");
    const predict_costs_t *costs = predict_costs_find(sim_mcu_find("rp2040"), &(tuile_config_t){0});
    assert_non_null(costs);
    assert_true(fabs(more - 153600.0 * costs->milli[PREDICT_BYTE_SUMMED] / 1000.0) <= 1.0);
    assert_true(costs->milli[PREDICT_BYTE_SUMMED] > 0);
    free(without);
    free(with);
}

/* Drawing before the first pixels go out has no wire to hide behind, and the last tile's pixels no drawing. Where every tile is
 * drawn faster than it is sent, a frame takes the wire's time and that drawing; where every tile with much in it takes longer,
 * drawing's time, the last tile's pixels and little more. Between the two tiles wait for one another, and no bound holds but the
 * sum. */
static void a_frame_takes_three_hundredths_over_the_longer_where_tiles_are_alike(void **state) {
    (void)state;
    const char *bunny = getenv("BUNNY_6000");
    static const char *const bus_bound[] = {
        "@/room.obj --panel ili9341 --mcu rp2040 --clock 10M --tile 240x8 --eye 0,0,2 --at 0,0,0 --fov 80",
        "@/cube.obj --panel ili9341 --mcu stm32f4 --clock 10M --tile 240x8",
        "@/room.obj --panel st7796 --mcu esp32 --clock 20M --tile 320x8 --eye 0,0,2 --at 0,0,0 --fov 80",
        "@/octahedron.obj --panel st7789-240x240 --mcu esp32c3 --clock 20M --tile 240x16",
    };
    static const struct {
        const char *options;
        unsigned last_rows; /* of 240: of the last tile */
    } render_bound[] = {
        {"--panel st7789-240x240 --mcu rp2040 --clock 62.5M --tile 240x40", 40},
        {"--panel st7789-240x240 --mcu rp2040 --clock 62.5M --tile 240x30 --shade gouraud", 30},
        {"--panel st7789-240x240 --mcu rp2040 --clock 62.5M --tile 240x40 --rotate 90 --shade gouraud", 40},
    };
    for (size_t i = 0; i < CHECK_COUNT(bus_bound); i++) {
        const figures_t f = figures_of(bus_bound[i]);
        assert_true(f.render < f.wire && f.lead < f.render);
        if (f.frame > 1.03 * f.wire || fabs(f.frame - f.wire - f.lead) > 1000) {
            fail_msg("%s: drawing %.3f ms, %.3f of it first, the wire %.3f, the frame %.3f", bus_bound[i], f.render / 1e6,
                     f.lead / 1e6, f.wire / 1e6, f.frame / 1e6);
        }
    }
    assert_non_null(bunny);
    for (size_t i = 0; i < CHECK_COUNT(render_bound); i++) {
        char line[512];
        (void)snprintf(line, sizeof line, "%s %s", bunny, render_bound[i].options);
        const figures_t f = figures_of(line);
        assert_true(f.render > f.wire);
        const double best = f.render + f.wire * render_bound[i].last_rows / 240.0;
        if (f.frame > 1.03 * best || f.frame < best) {
            fail_msg("%s: drawing %.3f ms, the wire %.3f, the frame %.3f", line, f.render / 1e6, f.wire / 1e6, f.frame / 1e6);
        }
    }
}

typedef struct flow {
    uint64_t frame_ns, render_ns, wire_ns; /* of four frames in a row, after two others */
} flow_t;

static flow_t flow_of(const tuile_scene_t *scene, const sim_mcu_t *mcu, uint16_t rows) {
    static _Alignas(8) uint8_t block[131072];
    board_t board;
    predict_t predict;
    tuile_t *renderer;
    uint64_t begun = 0;
    board_open_panel(&board, sim_panel_find("st7789-240x240"),
                     &(sim_bus_config_t){.clock_hz = 62500000,
                                         .command_clock_hz = 10000000,
                                         .command_gap_ns = sim_mcu_transfer_ns(mcu),
                                         .chunk_gap_ns = sim_mcu_transfer_ns(mcu),
                                         .queues = mcu->queues});
    assert_int_equal(board_start(&board, 0, TUILE_WIRE_RGB565), 0);
    predict_open(&predict, mcu);
    const tuile_config_t config = {
        .width = 240, .height = 240, .tile_height = rows, .format = TUILE_RGB565_BE, .trace = &predict.meter.trace};
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
    predict_start(&predict, renderer, NULL, &board.bus);
    assert_non_null(predict.costs);
    for (unsigned frame = 0; frame < 6; frame++) {
        if (frame == 2) {
            begun = board.bus.now_ns;
            board.bus.counts = (sim_bus_counts_t){0};
        }
        predict_frame_begin(&predict, &board.bus);
        assert_int_equal(tuile_stream_flow(renderer, scene, &board.display, NULL), 0);
    }
    const sim_bus_counts_t *counts = &board.bus.counts;
    const flow_t flow = {board.bus.now_ns - begun, counts->work_ns, counts->wire_ns + counts->gap_ns};
    assert_int_equal(tuile_stream_settle(&board.display), 0);
    board_check_clean(&board);
    board_close(&board);
    return flow;
}

/* On the Pico's bus, at its own pace and where drawing takes but twice as long as the wire. */
static void frames_in_a_row_take_three_hundredths_over_the_longer_where_the_bus_queues(void **state) {
    static const uint16_t rows[] = {28, 30, 40};
    sim_mcu_t mcu = *sim_mcu_find("rp2040");
    size_t size_bytes;
    tuile_model_t model;
    view_t view;
    (void)state;
    assert_non_null(getenv("BUNNY_6000"));
    char *bytes = command_read(getenv("BUNNY_6000"), &size_bytes);
    assert_non_null(bytes);
    assert_int_equal(tuile_model_open(&model, bytes, size_bytes), 0);
    assert_int_equal(view_make(&view, &VIEW_OPTIONS_DEFAULT, &model, 240, 240, 1, NULL), 0);
    for (unsigned pace = 0; pace < 2; pace++) {
        for (size_t i = 0; i < CHECK_COUNT(rows); i++) {
            const flow_t flow = flow_of(&view.scene, &mcu, rows[i]);
            assert_true(flow.render_ns > flow.wire_ns);
            if (flow.frame_ns > flow.render_ns + flow.render_ns * 3 / 100) {
                fail_msg("tiles of %u rows: four frames take %.3f ms, drawing %.3f, the wire %.3f", rows[i],
                         (double)flow.frame_ns / 1e6, (double)flow.render_ns / 1e6, (double)flow.wire_ns / 1e6);
            }
            if (i + 1 == CHECK_COUNT(rows)) { mcu.cycles_milli = (uint32_t)(mcu.cycles_milli * 2 * flow.wire_ns / flow.render_ns); }
        }
    }
    free(bytes);
}

static void bad_values_are_told(void **state) {
    (void)state;
    cli_fails("render @/cube.obj --mcu z80", "--mcu z80", "tuile mcus");
    cli_fails("render @/cube.obj --mcu", "--mcu", "value");
    cli_fails("render @/cube.obj --buffers 3", "--buffers", "out of range");
    cli_fails("render @/cube.obj --mcu rp2040 --display usb:gud", "--mcu rp2040", "usb:gud");
    cli_fails("render @/cube.obj --mcu rp2040 --display sim:ili9341,mcu=esp32", "--mcu rp2040", "names another");
    cli_fails("render @/cube.obj --mcu rp2040 --format grey8 --size 64x64", "--mcu rp2040", "--format");
    cli_fails("mcus rp2040", "mcus", "rp2040");
    char *text = cli_good("mcus");
    for (size_t i = 0; i < sim_mcu_count; i++) {
        assert_non_null(strstr(text, sim_mcus[i].name));
    }
    free(text);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(instructions_are_events_times_their_costs),
        cmocka_unit_test(time_is_cycles_of_the_core),
        cmocka_unit_test(the_longer_of_both_binds),
        cmocka_unit_test(what_nobody_counted_is_said),
        cmocka_unit_test(every_core_and_shading_has_costs),
        cmocka_unit_test(events_come_with_the_tile_that_they_happen_in),
        cmocka_unit_test(drawing_hides_behind_the_wire_or_the_wire_behind_drawing),
        cmocka_unit_test(work_is_on_the_clock_before_anything_is_done),
        cmocka_unit_test(a_frame_begins_with_nothing),
        cmocka_unit_test(a_report_says_what_binds_and_by_how_much),
        cmocka_unit_test(with_one_buffer_drawing_and_sending_add_up),
        cmocka_unit_test(sums_of_an_update_are_drawing),
        cmocka_unit_test(a_frame_takes_three_hundredths_over_the_longer_where_tiles_are_alike),
        cmocka_unit_test(frames_in_a_row_take_three_hundredths_over_the_longer_where_the_bus_queues),
        cmocka_unit_test(bad_values_are_told),
    };
    return cmocka_run_group_tests_name("predict", tests, cli_set_up, cli_tear_down);
}
