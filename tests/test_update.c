/* Frames of which only what has changed is sent, or drawn: the glass shows what it would show without, and the wire has less to do.
 *
 * The reference is always a second board that is sent every frame whole. */
#include "support/check.h"

#include "../firmware/update.h"
#include "../raster/overlay/overlay.h"
#include "../sim/panels.h"
#include "support/board.h"
#include "support/random.h"
#include "support/stage.h"

#define CELLS_MAX 16384
#define WIDE 240
#define HIGH 320

typedef struct pair {
    board_t board[2]; /* sent whole; sent what has changed */
    tuile_t *renderer[2];
    tuile_config_t config;
    uint64_t blocks[2][1 << 16];
    uint32_t sums[CELLS_MAX];
    tuile_change_t instances[4];
    tuile_changes_t changes;
    tuile_update_t update;
    tuile_stats_t stats[2];
} pair_t;

static pair_t pair;

static void pair_open(const char *panel, uint8_t rotation, uint8_t wire, const tuile_config_t *config, uint16_t cell_width) {
    memset(&pair, 0, sizeof pair);
    pair.config = *config;
    for (unsigned i = 0; i < 2; i++) {
        board_open_panel(&pair.board[i], sim_panel_find(panel), NULL);
        assert_int_equal(board_start(&pair.board[i], rotation, wire), 0);
        pair.config.width = pair.board[i].display.width;
        pair.config.height = pair.board[i].display.height;
        pair.config.format = tuile_stream_format(&pair.board[i].display);
        assert_int_equal(tuile_init(&pair.renderer[i], &pair.config, pair.blocks[i], sizeof pair.blocks[i], NULL), 0);
    }
    pair.update = (tuile_update_t){.sums = pair.sums, .sum_count = CELLS_MAX, .cell_width = cell_width};
    pair.changes = (tuile_changes_t){.instances = pair.instances, .capacity = CHECK_COUNT(pair.instances)};
}

static void pair_close(void) {
    board_close(&pair.board[0]);
    board_close(&pair.board[1]);
}

/* One frame on both; the glasses must be alike. Returns the pixel bytes that the second took. */
static uint64_t pair_frame(const tuile_scene_t *scene, uint8_t rotation) {
    sim_picture_t seen[2] = {{0}};
    for (unsigned i = 0; i < 2; i++) {
        memset(&pair.board[i].bus.counts, 0, sizeof pair.board[i].bus.counts);
    }
    assert_int_equal(tuile_stream_frame(pair.renderer[0], scene, &pair.board[0].display, &pair.stats[0]), 0);
    assert_int_equal(tuile_update_frame(&pair.update, pair.renderer[1], scene, &pair.board[1].display, &pair.stats[1]), 0);
    for (unsigned i = 0; i < 2; i++) {
        board_check_clean(&pair.board[i]);
        assert_int_equal(sim_bus_picture(&pair.board[i].bus, rotation, &seen[i], NULL), 0);
    }
    for (uint32_t y = 0; y < seen[0].height; y++) {
        for (uint32_t x = 0; x < seen[0].width; x++) {
            if (memcmp(sim_picture_at(&seen[0], x, y), sim_picture_at(&seen[1], x, y), 3) != 0) {
                const uint8_t *a = sim_picture_at(&seen[0], x, y), *b = sim_picture_at(&seen[1], x, y);
                fail_msg("pixel %u,%u is %02x%02x%02x, not %02x%02x%02x: cells %u, sent %u, skipped %u", x, y, b[0], b[1], b[2],
                         a[0], a[1], a[2], pair.update.cells, pair.update.cells_sent, pair.update.tiles_skipped);
            }
        }
    }
    sim_picture_free(&seen[0]);
    sim_picture_free(&seen[1]);
    assert_int_equal(pair.update.bytes_whole, pair.board[0].bus.counts.data_bytes);
    assert_int_equal(pair.update.bytes_sent, pair.board[1].bus.counts.data_bytes);
    return pair.board[1].bus.counts.data_bytes;
}

/* ---- boxes, by an overlay: whose place on the wire can be told by hand ------------------------------------------- */

typedef struct boxes {
    unsigned count;
    struct {
        int32_t x, y, width, height;
        uint32_t colour;
    } box[8];
} boxes_t;

static boxes_t boxes;

static void draw_boxes(void *context, tuile_canvas_t *canvas) {
    const boxes_t *all = context;
    for (unsigned i = 0; i < all->count; i++) {
        tuile_draw_rectangle(canvas, all->box[i].x, all->box[i].y, all->box[i].width, all->box[i].height, all->box[i].colour);
    }
}

static const tuile_scene_t empty = {.camera = {.focal_x = TUILE_Q16(100),
                                               .focal_y = TUILE_Q16(100),
                                               .near = TUILE_Q16(1),
                                               .far = TUILE_Q16(2),
                                               .rotation = {{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}}};

static void open_boxes(uint16_t tile_height, uint16_t cell_width, uint8_t buffers) {
    const tuile_config_t config = {
        .tile_height = tile_height, .buffers = buffers, .overlay = draw_boxes, .overlay_context = &boxes};
    boxes = (boxes_t){0};
    pair_open("ili9341", 0, TUILE_WIRE_RGB565, &config, cell_width);
    assert_int_equal(pair_frame(&empty, 0), 153600); /* the first is whole */
    assert_true(pair.update.whole);
}

static void put_box(int32_t x, int32_t y, int32_t width, int32_t height) {
    boxes.box[boxes.count].x = x;
    boxes.box[boxes.count].y = y;
    boxes.box[boxes.count].width = width;
    boxes.box[boxes.count].height = height;
    boxes.box[boxes.count++].colour = TUILE_COLOUR(255, 128, 0);
}

static void what_is_equal_is_not_sent(void **state) {
    (void)state;
    for (uint8_t buffers = 1; buffers <= 2; buffers++) {
        open_boxes(16, 16, buffers);
        assert_int_equal(pair_frame(&empty, 0), 0);
        assert_int_equal(pair.update.cells, 15 * 20);
        assert_int_equal(pair.update.cells_sent, 0);
        assert_int_equal(pair.board[1].bus.counts.commands, 0);
        put_box(33, 33, 1, 1);
        assert_int_equal(pair_frame(&empty, 0), 16 * 16 * 2); /* one cell */
        assert_int_equal(pair.update.cells_sent, 1);
        assert_int_equal(pair.update.windows, 1);
        assert_int_equal(pair_frame(&empty, 0), 0);
        boxes.count = 0;
        assert_int_equal(pair_frame(&empty, 0), 16 * 16 * 2); /* it is gone again */
        pair_close();
    }
}

static void neighbours_share_a_window_and_gaps_are_bridged_where_that_is_cheaper(void **state) {
    (void)state;
    open_boxes(1, 8, 2); /* cells of 8 x 1: 16 bytes, just what a window costs */
    put_box(8, 40, 16, 1);
    assert_int_equal(pair_frame(&empty, 0), 2 * 16);
    assert_int_equal(pair.update.windows, 1);
    boxes.count = 0;
    pair_frame(&empty, 0);
    put_box(8, 40, 8, 1);
    put_box(24, 40, 8, 1); /* a gap of one cell: 16 bytes, no dearer than a window */
    assert_int_equal(pair_frame(&empty, 0), 3 * 16);
    assert_int_equal(pair.update.windows, 1);
    assert_int_equal(pair.update.cells_sent, 2);
    boxes.count = 0;
    pair_frame(&empty, 0);
    put_box(8, 40, 8, 1);
    put_box(32, 40, 8, 1); /* two cells */
    assert_int_equal(pair_frame(&empty, 0), 2 * 16);
    assert_int_equal(pair.update.windows, 2);
    pair.update.window_bytes = 32;
    boxes.count = 0;
    assert_int_equal(pair_frame(&empty, 0), 4 * 16);
    assert_int_equal(pair.update.windows, 1);
    pair_close();
}

/* Three windows in each tile, of which only the last can be moved together in the tile's own bytes. */
static void several_windows_of_a_tile_do_not_spoil_one_another(void **state) {
    (void)state;
    for (uint8_t buffers = 1; buffers <= 2; buffers++) {
        open_boxes(16, 8, buffers);
        for (unsigned i = 0; i < 8; i++) {
            put_box((int32_t)(3 + 30 * (i % 4) + i), (int32_t)(5 + 17 * i), (int32_t)(9 + i), 40);
            pair_frame(&empty, 0);
            assert_true(pair.update.windows >= 3);
        }
        pair_close();
    }
}

static void a_display_that_asks_for_it_and_every_so_many_frames_get_all(void **state) {
    (void)state;
    open_boxes(16, 16, 2);
    pair.update.full_every = 3;
    assert_int_equal(pair_frame(&empty, 0), 0);
    assert_int_equal(pair_frame(&empty, 0), 0);
    assert_int_equal(pair_frame(&empty, 0), 153600);
    assert_int_equal(pair_frame(&empty, 0), 0);
    pair.update.full_every = 0;
    for (unsigned i = 0; i < 5; i++) {
        assert_int_equal(pair_frame(&empty, 0), 0);
    }
    tuile_update_forget(&pair.update);
    assert_int_equal(pair_frame(&empty, 0), 153600);
    assert_int_equal(tuile_display_resume(&pair.board[1].display), 0); /* its memory is noise for all that is known */
    assert_int_equal(tuile_display_resume(&pair.board[0].display), 0);
    assert_int_equal(pair_frame(&empty, 0), 153600);
    assert_int_equal(pair_frame(&empty, 0), 0);
    pair_close();
}

static void after_an_error_nothing_is_taken_for_sent(void **state) {
    (void)state;
    open_boxes(16, 16, 2);
    put_box(0, 0, 240, 200);
    pair.board[1].bus.config.fail_transfer = pair.board[1].bus.transfers + 10;
    assert_int_equal(tuile_update_frame(&pair.update, pair.renderer[1], &empty, &pair.board[1].display, NULL), TUILE_HAL_IO);
    pair.board[1].bus.config.fail_transfer = 0;
    assert_int_equal(tuile_display_resume(&pair.board[1].display), 0);
    pair_frame(&empty, 0);
    assert_true(pair.update.whole);
    pair_close();
}

/* They may lie in memory that was another's before. */
static void sums_need_not_be_zero_at_first(void **state) {
    (void)state;
    open_boxes(16, 16, 2);
    for (unsigned i = 0; i < 2; i++) {
        memset(pair.sums, 0xA5, sizeof pair.sums);
        tuile_update_forget(&pair.update);
        assert_int_equal(pair_frame(&empty, 0), 153600);
        assert_int_equal(pair.update.cells_compared, 0);
        assert_int_equal(pair_frame(&empty, 0), 0); /* nothing was taken for changed nearly everywhere, so sums go on */
    }
    pair_close();
}

static void a_flight_rests_from_sums_and_comes_back(void **state) {
    unsigned summing = 0;
    (void)state;
    open_boxes(16, 16, 2);
    put_box(0, 0, 240, 320);
    for (unsigned i = 0; i < 64; i++) {
        boxes.box[0].colour = TUILE_COLOUR(4u * i, 255u - 4u * i, 7);
        assert_int_equal(pair_frame(&empty, 0), 153600);
        summing += pair.update.summing;
        /* One window for each of 20 tiles, of 5, 5 and 1 bytes, where they are compared; else one for all. */
        assert_int_equal(pair.update.one_window, !pair.update.summing);
        assert_int_equal(pair.board[1].bus.counts.command_bytes, pair.update.one_window ? 11 : 20 * 11);
        assert_int_equal(pair.board[0].bus.counts.command_bytes, 11);
    }
    assert_in_range(summing, 3, 8); /* of 64: two in twenty-two */
    unsigned frames = 0;
    while (frames < 30 && pair_frame(&empty, 0) > 0) {
        frames++;
    }
    assert_in_range(frames, 1, 23); /* then it is seen that all stands still */
    pair_close();
}

static void sums_must_have_room(void **state) {
    (void)state;
    open_boxes(16, 16, 2);
    pair.update.sum_count = 15 * 20 - 1;
    assert_int_equal(tuile_update_frame(&pair.update, pair.renderer[1], &empty, &pair.board[1].display, NULL),
                     TUILE_ERROR_ARGUMENT);
    pair.update.sum_count = 15 * 20;
    assert_int_equal(TUILE_UPDATE_CELLS(240u, 320u, 240u, 16u, 16u), 15 * 20);
    assert_int_equal(TUILE_UPDATE_CELLS(240u, 320u, 100u, 24u, 16u), 3 * 7 * 14);
    assert_int_equal(tuile_update_frame(&pair.update, pair.renderer[1], &empty, &pair.board[1].display, NULL), 0);
    pair.update.cell_width = 12;
    assert_int_equal(tuile_update_frame(&pair.update, pair.renderer[1], &empty, &pair.board[1].display, NULL),
                     TUILE_ERROR_ARGUMENT);
    pair_close();
}

/* Random boxes that come and go, in all formats and both ways of holding the panel that change how bytes lie. */
static void random_boxes_on_every_panel(void **state) {
    random_source_t random = random_seed(5);
    (void)state;
    for (size_t p = 0; p < sim_panel_count; p++) {
        const tuile_panel_t *panel = sim_panels[p].panel;
        for (unsigned turn = 0; turn < 4u * panel->format_count; turn++) {
            const uint8_t rotation = (uint8_t)(turn % 4), wire = panel->formats[turn / 4].wire;
            const tuile_config_t config = {.tile_height = 24,
                                           .tile_width = (uint16_t)(turn % 3 == 1 ? 64 : 0),
                                           .overlay = draw_boxes,
                                           .overlay_context = &boxes};
            pair_open(panel->name, rotation, wire, &config, 16);
            for (unsigned frame = 0; frame < 4; frame++) {
                boxes.count = (unsigned)random_between(&random, 0, 3);
                for (unsigned i = 0; i < boxes.count; i++) {
                    boxes.box[i].x = random_between(&random, -10, pair.config.width);
                    boxes.box[i].y = random_between(&random, -10, pair.config.height);
                    boxes.box[i].width = random_between(&random, 1, 60);
                    boxes.box[i].height = random_between(&random, 1, 60);
                    boxes.box[i].colour = 0xFF000000u | (uint32_t)random_bits(&random);
                }
                pair_frame(&empty, rotation);
            }
            pair_close();
        }
    }
}

/* ---- instances that move ----------------------------------------------------------------------------------------- */

typedef struct moving {
    stage_t stage;
    tuile_instance_t instances[3];
    tuile_light_t light;
    tuile_scene_t scene;
} moving_t;

static moving_t moving;

static void open_moving(const tuile_config_t *config) {
    stage_open_torus(&moving.stage, WIDE, HIGH);
    moving.scene = (tuile_scene_t){.instances = moving.instances, .lights = &moving.light};
    moving.scene.camera = stage_plain_camera(WIDE, HIGH);
    moving.light = (tuile_light_t){.direction = {0, 0, -16384}, .intensity = 200};
    moving.scene.light_count = 1;
    moving.scene.ambient = 40;
    moving.scene.instance_count = 3;
    for (int i = 0; i < 3; i++) {
        moving.instances[i] = stage_placed(&moving.stage.compiled.model, 0);
        moving.instances[i].pose.translation[1] = TUILE_Q16(2 * (i - 1));
    }
    pair_open("ili9341", 0, TUILE_WIRE_RGB565, config, 16);
    pair.update.changes = &pair.changes;
    pair_frame(&moving.scene, 0);
    assert_int_equal(pair.update.tiles_skipped, 0);
}

static void close_moving(void) {
    pair_close();
    stage_close(&moving.stage);
}

static void tiles_that_nothing_moves_in_are_not_drawn(void **state) {
    const tuile_config_t config = {.tile_height = 8, .tile_width = 40, .shade = TUILE_GOURAUD};
    (void)state;
    open_moving(&config);
    assert_true(pair.update.bytes_sent > 0);
    assert_int_equal(pair_frame(&moving.scene, 0), 0);
    assert_int_equal(pair.update.tiles_skipped, 6 * 40);
    assert_int_equal(pair.stats[1].tiles, 0);
    tuile_rotation(moving.instances[1].pose.rotation, 0, 3000);
    assert_true(pair_frame(&moving.scene, 0) > 0);
    assert_true(pair.update.tiles_skipped > 100);
    assert_true(pair.stats[1].tiles < 6 * 40 - 100);
    moving.instances[0].pose.translation[0] += TUILE_Q16(1) / 2; /* where it was, and where it is */
    assert_true(pair_frame(&moving.scene, 0) > 0);
    close_moving();
}

static void what_every_tile_may_show_draws_every_tile(void **state) {
    const tuile_config_t config = {.tile_height = 16, .effects = TUILE_SURFACES};
    const tuile_line_t line = {.from = {0, 0, 0}, .to = {TUILE_Q16(1), 0, 0}};
    (void)state;
    open_moving(&config);
    for (unsigned what = 0; what < 12; what++) {
        switch (what) {
        case 0: moving.scene.camera.eye[0]++; break;
        case 1: moving.scene.camera.focal_x += 65536; break;
        case 2: moving.light.direction[0] = 100; break;
        case 3: moving.light.intensity--; break;
        case 4: moving.scene.ambient++; break;
        case 5: moving.scene.background[2]++; break;
        case 6: moving.scene.instance_count = 2; break;
        case 7: moving.scene.instance_count = 3; break;
        case 8: tuile_changes_forget(&pair.changes); break;
        case 9: moving.light.colour[1] = 7; break;
        case 10: moving.scene.fog.far++; break;
        default:
            moving.scene.lines = &line;
            moving.scene.line_count = 0;
            break; /* no line, so nothing */
        }
        pair_frame(&moving.scene, 0);
        if (pair.update.tiles_skipped != (what == 11 ? 20 : 0)) { fail_msg("%u: skipped %u", what, pair.update.tiles_skipped); }
        pair_frame(&moving.scene, 0);
        if (pair.update.tiles_skipped != 20) { fail_msg("%u, then: skipped %u", what, pair.update.tiles_skipped); }
    }
    pair.changes.capacity = 2; /* too few to remember three */
    pair.changes.known = false;
    pair_frame(&moving.scene, 0);
    pair_frame(&moving.scene, 0);
    assert_int_equal(pair.update.tiles_skipped, 0);
    close_moving();
}

static void an_overlay_is_drawn_where_it_may_be(void **state) {
    const tuile_config_t config = {.tile_height = 16, .overlay = draw_boxes, .overlay_context = &boxes};
    (void)state;
    boxes = (boxes_t){0};
    open_moving(&config);
    pair_frame(&moving.scene, 0);
    assert_int_equal(pair.update.tiles_skipped, 0); /* it may be anywhere */
    pair.update.overlay_x = 10;
    pair.update.overlay_y = 32;
    pair.update.overlay_width = 50;
    pair.update.overlay_height = 17; /* to row 48, which is in the next tile */
    put_box(20, 40, 30, 9);
    pair_frame(&moving.scene, 0);
    assert_int_equal(pair.update.tiles_skipped, 18);
    close_moving();
}

static void random_motion_shows_what_it_would_show_drawn_whole(void **state) {
    static const tuile_config_t configs[] = {{.tile_height = 16, .shade = TUILE_GOURAUD},
                                             {.tile_height = 16, .tile_width = 32},
                                             {.tile_height = 8, .effects = TUILE_LAYERS, .edges = TUILE_EDGES_OUTLINE},
                                             {.tile_height = 8, .aa = TUILE_AA_2X2, .method = TUILE_SCANLINE}};
    random_source_t random = random_seed(11);
    unsigned skipped = 0;
    (void)state;
    for (unsigned c = 0; c < CHECK_COUNT(configs); c++) {
        open_moving(&configs[c]);
        for (unsigned frame = 0; frame < CHECK_ROUNDS(48); frame++) {
            tuile_instance_t *instance = &moving.instances[random_between(&random, 0, 2)];
            if (random_one_in(&random, 8)) { moving.scene.camera.eye[0] += random_between(&random, -9000, 9000); }
            instance->pose.translation[random_between(&random, 0, 2)] += random_between(&random, -40000, 40000);
            tuile_rotation(instance->pose.rotation, random_between(&random, 0, 2), (bam16_t)random_bits(&random));
            pair_frame(&moving.scene, 0);
            skipped += pair.update.tiles_skipped;
        }
        close_moving();
    }
    assert_true(skipped > 100);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_equal_is_not_sent),
        cmocka_unit_test(neighbours_share_a_window_and_gaps_are_bridged_where_that_is_cheaper),
        cmocka_unit_test(several_windows_of_a_tile_do_not_spoil_one_another),
        cmocka_unit_test(a_display_that_asks_for_it_and_every_so_many_frames_get_all),
        cmocka_unit_test(after_an_error_nothing_is_taken_for_sent),
        cmocka_unit_test(sums_need_not_be_zero_at_first),
        cmocka_unit_test(a_flight_rests_from_sums_and_comes_back),
        cmocka_unit_test(sums_must_have_room),
        cmocka_unit_test(random_boxes_on_every_panel),
        cmocka_unit_test(tiles_that_nothing_moves_in_are_not_drawn),
        cmocka_unit_test(what_every_tile_may_show_draws_every_tile),
        cmocka_unit_test(an_overlay_is_drawn_where_it_may_be),
        cmocka_unit_test(random_motion_shows_what_it_would_show_drawn_whole),
    };
    return cmocka_run_group_tests_name("update", tests, NULL, NULL);
}
