/* A frame drawn by two threads as two cores do it: the bits of one, wherever the border is; faults; the border's way.
 *
 * Also built with -fsanitize=thread (make test-tsan), which sees the threads touch what is not theirs. */
#include "support/check.h"

#include <pthread.h>
#include <sched.h>

#include "../firmware/cores.h"
#include "../firmware/scenes.h"
#include "support/board.h"

#define PANEL "st7789-240x240"
#define BLOCK_BYTES (512u * 1024u)
#define SMALL_BYTES (32u * 1024u) /* a band of the bunny takes several passes in it */

static _Alignas(8) uint8_t blocks[3][BLOCK_BYTES]; /* of the two cores, and of one alone */
static _Alignas(4) uint8_t model[1u << 20];
static size_t model_bytes;

/* ---- two threads ------------------------------------------------------------------------------------------------- */

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

static void lock(void *context) { (void)context, (void)pthread_mutex_lock(&mutex); }

static void unlock(void *context) { (void)context, (void)pthread_mutex_unlock(&mutex); }

static void pause_thread(void *context) { (void)context, (void)sched_yield(); }

static const cores_port_t port = {.lock = lock, .unlock = unlock, .pause = pause_thread};

typedef struct pair {
    board_t board, alone;
    scene_stage_t stage;
    tuile_config_t config;
    cores_t cores;
    pthread_t thread;
} pair_t;

static void *serve(void *context) {
    cores_serve(context);
    return NULL;
}

static void open_board(board_t *board, const sim_bus_config_t *config) {
    board_open_panel(board, sim_panel_find(PANEL), config);
    assert_int_equal(board_start(board, 0, TUILE_WIRE_RGB565), 0);
}

static cores_config_t config_of(pair_t *pair, const cores_port_t *with, size_t block_bytes) {
    return (cores_config_t){.renderer = &pair->config,
                            .display = &pair->board.display,
                            .port = with,
                            .blocks = {blocks[0], blocks[1]},
                            .block_bytes = {block_bytes, block_bytes}};
}

static void open_scene(pair_t *pair, uint8_t method, uint16_t tile_height) {
    assert_int_equal(scene_open(&pair->stage, scene_find("bunny"), model, model_bytes, 240, 240), 0);
    pair->config = (tuile_config_t){.width = 240, .height = 240, .tile_height = tile_height, .method = method};
    scene_configure(&pair->stage, &pair->config);
}

static void open_pair(pair_t *pair, uint8_t method, uint16_t tile_height, size_t block_bytes, const cores_port_t *with) {
    cores_config_t config;

    open_board(&pair->board, NULL);
    open_board(&pair->alone, NULL);
    open_scene(pair, method, tile_height);
    config = config_of(pair, with, block_bytes);
    assert_int_equal(cores_open(&pair->cores, &config), 0);
    assert_int_equal(pthread_create(&pair->thread, NULL, serve, &pair->cores), 0);
}

static void close_pair(pair_t *pair) {
    cores_close(&pair->cores);
    assert_int_equal(pthread_join(pair->thread, NULL), 0);
    board_check_clean(&pair->board);
    board_close(&pair->board);
    board_close(&pair->alone);
}

/* ---- the same bits ------------------------------------------------------------------------------------------------ */

static void check_same(const pair_t *pair) {
    sim_picture_t two = {0}, one = {0};

    assert_int_equal(pair->board.chip->glass(pair->board.chip, &two, NULL), 0);
    assert_int_equal(pair->alone.chip->glass(pair->alone.chip, &one, NULL), 0);
    assert_memory_equal(two.rgb, one.rgb, 3u * 240u * 240u);
    sim_picture_free(&two);
    sim_picture_free(&one);
}

static void draw_alone(pair_t *pair, uint32_t frame) {
    tuile_t *renderer;

    assert_int_equal(tuile_init(&renderer, &pair->config, blocks[2], BLOCK_BYTES, NULL), 0);
    assert_int_equal(scene_frame(&pair->stage, frame), 0);
    assert_int_equal(tuile_stream_frame(renderer, &pair->stage.scene, &pair->alone.display, NULL), 0);
}

static void check_frame(pair_t *pair, uint32_t frame) {
    draw_alone(pair, frame);
    assert_int_equal(cores_frame(&pair->cores, &pair->stage.scene), 0);
    check_same(pair);
}

static void test_every_method_draws_the_bits_of_one_core(void **state) {
    pair_t pair;
    (void)state;
    for (uint8_t method = 0; method < TUILE_TREE; method++) {
        open_pair(&pair, method, 8, BLOCK_BYTES, &port);
        for (uint32_t frame = 0; frame < 4; frame++) {
            check_frame(&pair, 5 * frame);
        }
        close_pair(&pair);
    }
}

/* 18 rows of 13 pixels and one of 6; in a small block too, where bands take passes of their own. */
static void test_every_border_gives_the_same_picture(void **state) {
    pair_t pair;
    (void)state;
    for (unsigned small = 0; small < 2; small++) {
        open_pair(&pair, TUILE_ZBUFFER, 13, small ? SMALL_BYTES : BLOCK_BYTES, &port);
        assert_int_equal(pair.cores.border, 10);
        for (uint16_t border = 1; border < 19; border++) {
            pair.cores.border = border;
            check_frame(&pair, border);
            assert_int_equal(pair.cores.border, border); /* nobody has a clock */
            assert_int_equal(pair.cores.halves[0].stats.tiles, border);
            assert_int_equal(pair.cores.halves[1].stats.tiles, 19 - border);
            if (small) { assert_true(pair.cores.halves[0].stats.passes > 1 || pair.cores.halves[1].stats.passes > 1); }
        }
        close_pair(&pair);
    }
}

static void test_the_second_core_has_nothing_to_do_in_one_row(void **state) {
    pair_t pair;
    (void)state;
    open_pair(&pair, TUILE_ZBUFFER, 240, BLOCK_BYTES, &port);
    check_frame(&pair, 3);
    check_frame(&pair, 4);
    assert_int_equal(pair.cores.halves[0].stats.tiles, 1);
    assert_int_equal(pair.cores.halves[1].stats.tiles, 0);
    close_pair(&pair);
}

/* Where no height of tiles is asked for, the smaller block has its say. */
static void test_tiles_suit_both_blocks(void **state) {
    pair_t pair;
    cores_config_t config;
    (void)state;
    open_board(&pair.board, NULL);
    open_scene(&pair, TUILE_ZBUFFER, 0);
    config = config_of(&pair, &port, BLOCK_BYTES);
    config.block_bytes[1] = SMALL_BYTES;
    assert_int_equal(cores_open(&pair.cores, &config), 0);
    assert_int_equal(tuile_config(pair.cores.halves[0].renderer)->tile_height,
                     tuile_config(pair.cores.halves[1].renderer)->tile_height);
    board_close(&pair.board);
}

/* ---- errors --------------------------------------------------------------------------------------------------- */

static void test_what_does_not_fit_is_refused_at_once(void **state) {
    pair_t pair;
    cores_config_t config;
    (void)state;
    open_board(&pair.board, NULL);
    open_scene(&pair, TUILE_ZBUFFER, 8);
    for (unsigned core = 0; core < 2; core++) {
        config = config_of(&pair, &port, BLOCK_BYTES);
        config.block_bytes[core] = 4096;
        assert_int_equal(cores_open(&pair.cores, &config), TUILE_ERROR_MEMORY);
    }
    config = config_of(&pair, &port, BLOCK_BYTES);
    pair.config.height = 239;
    assert_int_equal(cores_open(&pair.cores, &config), TUILE_ERROR_ARGUMENT);
    board_close(&pair.board);
}

/* The wire fails at each transfer of a frame: told, both cores have stopped, and the next frame is right. */
static void test_a_fault_at_any_transfer_is_told_and_got_over(void **state) {
    pair_t pair;
    uint64_t first, count;
    (void)state;
    open_pair(&pair, TUILE_ZBUFFER, 40, BLOCK_BYTES, &port);
    first = pair.board.bus.transfers;
    check_frame(&pair, 0);
    count = pair.board.bus.transfers - first;
    assert_true(count >= 4u * 6u); /* columns, rows, write, data: for each of six tiles */
    for (uint64_t k = 1; k < count; k++) {
        pair.board.bus.config.fail_transfer = pair.board.bus.transfers + k;
        assert_int_equal(cores_frame(&pair.cores, &pair.stage.scene), TUILE_HAL_IO);
        assert_int_equal(pair.board.display.error, TUILE_HAL_IO);
        assert_int_equal(cores_frame(&pair.cores, &pair.stage.scene), TUILE_HAL_IO);
        assert_int_equal(tuile_display_resume(&pair.board.display), 0);
        check_frame(&pair, (uint32_t)k);
    }
    close_pair(&pair);
}

/* A lock that nobody gets before a core has met an error. */
static void lock_late(void *context) {
    const cores_t *cores = context;

    while (!__atomic_load_n(&cores->broken, __ATOMIC_ACQUIRE)) {
        (void)sched_yield();
    }
    lock(NULL);
}

/* The painter's method wants room for all faces of a tile, and one core has it not: the other stops at its next tile. */
static void test_an_error_of_one_core_stops_both(void **state) {
    cores_port_t late = {.lock = lock_late, .unlock = unlock, .pause = pause_thread};
    pair_t pair;
    cores_config_t config;
    (void)state;
    for (unsigned poor = 0; poor < 2; poor++) {
        cores_half_t *half = &pair.cores.halves[poor];

        open_board(&pair.board, NULL);
        open_board(&pair.alone, NULL);
        open_scene(&pair, TUILE_PAINTER, 40);
        late.context = &pair.cores;
        config = config_of(&pair, &late, BLOCK_BYTES);
        assert_int_equal(tuile_init(&half->renderer, &pair.config, blocks[0], 4096, &config.block_bytes[poor]), TUILE_ERROR_MEMORY);
        assert_int_equal(cores_open(&pair.cores, &config), 0);
        assert_int_equal(pthread_create(&pair.thread, NULL, serve, &pair.cores), 0);
        assert_int_equal(scene_frame(&pair.stage, 0), 0);
        assert_int_equal(cores_frame(&pair.cores, &pair.stage.scene), TUILE_ERROR_MEMORY);
        assert_int_equal(half->result, TUILE_ERROR_MEMORY);
        assert_true(tuile_wanted(half->renderer) > config.block_bytes[poor]);
        assert_int_equal(pair.cores.halves[!poor].result, 0);
        assert_true(pair.cores.halves[!poor].stats.tiles <= 1);
        assert_int_equal(pair.board.display.error, 0);
        assert_false(pair.board.display.in_flight);
        close_pair(&pair);
    }
}

/* ---- the border ----------------------------------------------------------------------------------------------- */

static void test_the_border_moves_by_half_of_what_differs(void **state) {
    (void)state;
    assert_int_equal(cores_border(4, 8, 100, 100), 4);
    assert_int_equal(cores_border(4, 8, 0, 0), 4);
    assert_int_equal(cores_border(4, 8, 200, 100), 3); /* 100 are two rows of the first; one goes over */
    assert_int_equal(cores_border(4, 8, 100, 200), 5);
    assert_int_equal(cores_border(15, 30, 300, 100), 10); /* 200 are ten rows */
    assert_int_equal(cores_border(10, 30, 200, 200), 10);
    assert_int_equal(cores_border(15, 30, 1000, 0), 8); /* 7.5 rows, rounded down */
    assert_int_equal(cores_border(15, 30, 0, 1000), 22);
    assert_int_equal(cores_border(1, 2, 1000, 1), 1);
    assert_int_equal(cores_border(1, 2, 1, 1000), 1);
    assert_int_equal(cores_border(29, 30, 0, 1), 29);
    assert_int_equal(cores_border(1, 1, 1000, 0), 1);
    assert_int_equal(cores_border(1, 1, 0, 1000), 1);
    assert_int_equal(cores_border(60000, 65535, UINT32_MAX, 0), 30000);
}

static _Thread_local uint32_t thread_time, thread_step;

static uint32_t thread_now(void *context) {
    const uint32_t *second_step = context;
    return thread_time += thread_step ? thread_step : *second_step;
}

/* The first thread's clock goes three times as fast: 300 to 100, as above, then 200 to 200 would be even. */
static void test_a_frame_moves_the_border(void **state) {
    static uint32_t second_step = 100;
    const cores_port_t clocked = {
        .lock = lock, .unlock = unlock, .pause = pause_thread, .now = thread_now, .context = &second_step};
    pair_t pair;
    (void)state;
    thread_step = 300;
    open_pair(&pair, TUILE_ZBUFFER, 8, BLOCK_BYTES, &clocked);
    assert_int_equal(pair.cores.border, 15);
    check_frame(&pair, 0);
    assert_int_equal(pair.cores.halves[0].busy, 300);
    assert_int_equal(pair.cores.halves[1].busy, 100);
    assert_int_equal(pair.cores.border, 10);
    thread_step = 100;
    check_frame(&pair, 1);
    assert_int_equal(pair.cores.border, 10);
    close_pair(&pair);
}

static int read_model(void **state) {
    const char *path = getenv("BUNNY_6000");
    FILE *file = path ? fopen(path, "rb") : NULL;
    (void)state;
    if (!file) { return -1; }
    model_bytes = fread(model, 1, sizeof model, file);
    (void)fclose(file);
    return model_bytes > 0 && model_bytes < sizeof model ? 0 : -1;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_method_draws_the_bits_of_one_core),
        cmocka_unit_test(test_every_border_gives_the_same_picture),
        cmocka_unit_test(test_the_second_core_has_nothing_to_do_in_one_row),
        cmocka_unit_test(test_tiles_suit_both_blocks),
        cmocka_unit_test(test_what_does_not_fit_is_refused_at_once),
        cmocka_unit_test(test_a_fault_at_any_transfer_is_told_and_got_over),
        cmocka_unit_test(test_an_error_of_one_core_stops_both),
        cmocka_unit_test(test_the_border_moves_by_half_of_what_differs),
        cmocka_unit_test(test_a_frame_moves_the_border),
    };
    return cmocka_run_group_tests(tests, read_model, NULL);
}
