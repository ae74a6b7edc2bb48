/* Pixels on GUD displays through the real libusb: formats, windows, splits, LZ4, whole frames. The device is sim/usb's model at the
 * far end of umockdev's usbfs. */
#include "support/check.h"

#include "mock/gud_stand.h"

/* ---- pixels ----------------------------------------------------------------------------------------------------- */

static const uint8_t wires[7] = {TUILE_WIRE_MONO_ROWS, TUILE_WIRE_GREY8,  TUILE_WIRE_XRGB1111, TUILE_WIRE_RGB332,
                                 TUILE_WIRE_RGB565_LE, TUILE_WIRE_BGR888, TUILE_WIRE_XRGB8888};

/* 40 x 21 pixels in windows that do not divide it, whole and in pieces that end within rows. */
static void test_all_formats_in_windows_and_pieces(void **state) {
    static const usb_card_way_t ways[] = {{.seed = 1},
                                          {.seed = 2, .tile_width = 16, .tile_height = 5},
                                          {.seed = 3, .tile_width = 8, .tile_height = 1},
                                          {.seed = 4, .tile_width = 24, .tile_height = 6, .piece_pixels = 40},
                                          {.seed = 5, .piece_pixels = 8}};

    (void)state;
    for (size_t f = 0; f < CHECK_COUNT(wires); f++) {
        gud_stand_t stand;
        gud_stand_start(&stand, &(sim_gud_config_t){.width = 40, .height = 21}, wires[f], 0);
        assert_int_equal(stand.display.wire, wires[f]);
        assert_int_equal(stand.display.width, 40);
        assert_int_equal(stand.display.height, 21);
        usb_card_check_dark(stand.model);
        for (size_t i = 0; i < CHECK_COUNT(ways); i++) {
            gud_stand_draw(&stand, &ways[i], 0);
        }
        gud_stand_finish(&stand);
    }
}

/* 2 and 8 pixels share a byte, so windows begin and end with whole ones; larger pixels may stand anywhere. */
static void test_odd_windows_where_pixels_are_whole_bytes(void **state) {
    (void)state;
    for (size_t f = 0; f < CHECK_COUNT(wires); f++) {
        const unsigned align = wires[f] == TUILE_WIRE_MONO_ROWS ? 8 : wires[f] == TUILE_WIRE_XRGB1111 ? 2 : 1;
        gud_stand_t stand;
        gud_stand_start(&stand, &(sim_gud_config_t){.width = 40, .height = 21}, wires[f], 0);
        assert_int_equal(stand.display.align_x, align);
        assert_int_equal(stand.display.align_y, 1);
        if (align == 1) { gud_stand_draw(&stand, &(usb_card_way_t){.seed = 7, .tile_width = 7, .tile_height = 3}, 0); }
        assert_int_equal(tuile_display_window(&stand.display, 0, 0, align + 1, 1), align == 1 ? 0 : TUILE_HAL_ARGUMENT);
        gud_stand_finish(&stand);
    }
}

/* A window in the middle leaves what is around it. */
static void test_partial_update(void **state) {
    static const usb_card_way_t before = {.seed = 11}, after = {.seed = 12};
    uint8_t pixels[2 * 5 * 3], rgb[3];
    sim_picture_t glass;
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 8}, TUILE_WIRE_RGB565_LE, 0);
    gud_stand_draw(&stand, &before, 0);
    for (uint32_t row = 0; row < 3; row++) {
        usb_card_row(TUILE_WIRE_RGB565_LE, &after, 9, 4 + row, 5, pixels + (size_t)row * 10);
    }
    assert_int_equal(tuile_display_window(&stand.display, 9, 4, 5, 3), 0);
    assert_int_equal(tuile_display_write(&stand.display, pixels, sizeof pixels), 0);
    assert_int_equal(tuile_display_present(&stand.display), 0);
    assert_int_equal(stand.model->picture(stand.model, &glass, NULL), 0);
    for (uint32_t y = 0; y < 8; y++) {
        for (uint32_t x = 0; x < 16; x++) {
            const bool inside = x >= 9 && x < 14 && y >= 4 && y < 7;
            usb_card_colour(TUILE_WIRE_RGB565_LE, usb_card_value(TUILE_WIRE_RGB565_LE, inside ? &after : &before, x, y), rgb);
            assert_memory_equal(sim_picture_at(&glass, x, y), rgb, 3);
        }
    }
    sim_picture_free(&glass);
    gud_stand_finish(&stand);
}

/* A row of 16 pixels is 32 bytes. Windows of 16 x 10 into a buffer of 100 bytes: 3 + 3 + 3 + 1 rows. */
static void test_windows_are_cut_at_the_devices_buffer(void **state) {
    static const struct { uint32_t most, updates; } cases[] = {{100, 4}, {32, 10}, {63, 10}, {64, 5}, {319, 2}, {320, 1}, {0, 1}};

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        gud_stand_t stand;
        gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 10, .max_buffer_bytes = cases[i].most},
                        TUILE_WIRE_RGB565_LE, 0);
        gud_stand_draw(&stand, &(usb_card_way_t){.seed = 20}, 0);
        assert_int_equal(sim_gud_counts(stand.model)->set_buffers, cases[i].updates);
        assert_int_equal(sim_gud_counts(stand.model)->updates, cases[i].updates);
        assert_int_equal(sim_gud_counts(stand.model)->payload_bytes, 320);
        gud_stand_finish(&stand);
    }
}

/* 320 x 240 x 2 bytes are ten URBs where the kernel wants 16 KB each, and one where it does not care. */
static void test_long_transfers_are_cut_by_libusb(void **state) {
    (void)state;
    for (int cut = 0; cut < 2; cut++) {
        unsigned before;
        gud_stand_t stand;
        gud_stand_plug(&stand, NULL);
        mock_usb_state(stand.device)->kernel = cut ? MOCK_USB_CUT : MOCK_USB_WHOLE;
        assert_int_equal(tuile_gud_open(&stand.gud, NULL), 0);
        assert_int_equal(gud_stand_begin(&stand, 0, 0), 0);
        before = mock_usb_state(stand.device)->submitted;
        gud_stand_draw(&stand, &(usb_card_way_t){.seed = 21}, 0);
        /* SET_BUFFER, pixels, SET_DISPLAY_ENABLE */
        assert_int_equal(mock_usb_state(stand.device)->submitted - before, cut ? 12 : 3);
        assert_int_equal(mock_usb_state(stand.device)->largest_bytes, cut ? 16384 : 153600);
        gud_stand_finish(&stand);
    }
}

/* 1100 x 1000 x 4 bytes in updates of at most 4 MB: 953 rows of 4400 bytes, then 47. */
static void test_large_pictures_go_in_several_updates(void **state) {
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 1100, .height = 1000}, TUILE_WIRE_XRGB8888, 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 22}, 0);
    assert_int_equal(sim_gud_counts(stand.model)->updates, 2);
    assert_int_equal(mock_usb_state(stand.device)->largest_bytes, 953 * 4400);
    gud_stand_finish(&stand);
}

static void test_write_returns_while_pixels_are_on_their_way(void **state) {
    uint8_t pixels[2 * 16 * 10] = {0};
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 10}, 0, 0);
    assert_int_equal(tuile_display_window(&stand.display, 0, 0, 16, 10), 0);
    assert_int_equal(tuile_display_write(&stand.display, pixels, sizeof pixels), 0);
    assert_int_equal(mock_usb_state(stand.device)->pending, 1);
    assert_int_equal(tuile_display_wait(&stand.display), 0);
    assert_int_equal(mock_usb_state(stand.device)->pending, 0);
    gud_stand_finish(&stand);
}

/* ---- compression ------------------------------------------------------------------------------------------------ */

/* LZ4 needs one byte for 255 more of a match, so a flat picture is at most 1 % of its size here. Noise is sent as it is. */
static void test_lz4_pays_on_flat_pictures_only(void **state) {
    sim_gud_counts_t *counts;
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.lz4 = true}, TUILE_WIRE_RGB565_LE, 0);
    assert_true(stand.gud.lz4);
    counts = sim_gud_counts(stand.model);
    gud_stand_draw(&stand, &(usb_card_way_t){.kind = USB_CARD_FLAT, .seed = 31, .tile_height = 24}, 0);
    assert_int_equal(counts->compressed, 10);
    assert_int_equal(counts->pixel_bytes, 153600);
    print_message("flat: %u of 153600 bytes\n", (unsigned)counts->payload_bytes);
    assert_in_range(counts->payload_bytes, 1, 1536);
    *counts = (sim_gud_counts_t){0};
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 32, .tile_height = 24}, 0);
    assert_int_equal(counts->compressed, 0);
    assert_int_equal(counts->payload_bytes, 153600);
    gud_stand_finish(&stand);
}

static void test_lz4_in_pieces_and_cut_at_the_devices_buffer(void **state) {
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 64, .height = 32, .lz4 = true, .max_buffer_bytes = 1000},
                    TUILE_WIRE_RGB565_LE, 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.kind = USB_CARD_FLAT, .seed = 33}, 0); /* 7 rows of 128 bytes fit: 5 updates */
    assert_int_equal(sim_gud_counts(stand.model)->compressed, 5);
    gud_stand_draw(&stand,
                   &(usb_card_way_t){.kind = USB_CARD_FLAT, .seed = 34, .tile_width = 30, .tile_height = 9, .piece_pixels = 50}, 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 35, .tile_width = 1, .tile_height = 1}, 0);
    gud_stand_finish(&stand);
}

static void test_compression_can_be_declined(void **state) {
    gud_stand_t stand;

    (void)state;
    gud_stand_plug(&stand, &(sim_gud_config_t){.lz4 = true});
    assert_int_equal(tuile_gud_open(&stand.gud, &(tuile_gud_config_t){.no_compression = true}), 0);
    assert_int_equal(gud_stand_begin(&stand, 0, 0), 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.kind = USB_CARD_FLAT}, 0);
    assert_int_equal(sim_gud_counts(stand.model)->compressed, 0);
    gud_stand_finish(&stand);
}

/* ---- whole frames ----------------------------------------------------------------------------------------------- */

static void test_whole_frames_are_gathered_from_windows(void **state) {
    (void)state;
    for (size_t f = 0; f < CHECK_COUNT(wires); f++) {
        sim_gud_counts_t *counts;
        gud_stand_t stand;
        gud_stand_start(&stand, &(sim_gud_config_t){.width = 40, .height = 21, .full_update = true, .status_on_set = f % 2 != 0},
                        wires[f], 0);
        counts = sim_gud_counts(stand.model);
        gud_stand_draw(&stand, &(usb_card_way_t){.seed = 41, .tile_width = 16, .tile_height = 5}, 0);
        assert_int_equal(counts->updates, 1);
        gud_stand_draw(&stand, &(usb_card_way_t){.seed = 42, .tile_width = 24, .tile_height = 6, .piece_pixels = 40}, 0);
        assert_int_equal(counts->updates, 2);
        assert_int_equal(counts->set_buffers, 0);
        gud_stand_finish(&stand);
    }
}

/* Pieces of the frame, cut between rows: 16 x 10 x 2 bytes into 100 are 3 + 3 + 3 + 1 rows of one frame. */
static void test_whole_frames_are_cut_at_the_devices_buffer(void **state) {
    unsigned before;
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 10, .full_update = true, .max_buffer_bytes = 100}, 0, 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 43}, 0);
    before = mock_usb_state(stand.device)->submitted;
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 44}, 0);
    assert_int_equal(mock_usb_state(stand.device)->submitted - before, 4);
    assert_int_equal(sim_gud_counts(stand.model)->updates, 2);
    gud_stand_finish(&stand);
}

/* Frames come without SET_BUFFER, but for the one after a frame that was cut. */
static void test_whole_frame_after_one_that_was_cut_is_announced(void **state) {
    sim_gud_counts_t *counts;
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 10, .full_update = true, .max_buffer_bytes = 160}, 0, 0);
    counts = sim_gud_counts(stand.model);
    mock_usb_state(stand.device)->fault = MOCK_USB_PROTO;
    mock_usb_state(stand.device)->fault_at = mock_usb_state(stand.device)->submitted + 2; /* the frame's second half */
    assert_int_equal(usb_card_draw(&stand.display, &(usb_card_way_t){.seed = 46}), TUILE_HAL_IO);
    assert_int_equal(counts->set_buffers, 0);
    assert_int_equal(tuile_display_resume(&stand.display), 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 47}, 0);
    assert_int_equal(counts->set_buffers, 1);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 48}, 0);
    assert_int_equal(counts->set_buffers, 1);
    gud_stand_finish(&stand);
}

/* What a window does not cover is sent as it was. */
static void test_whole_frames_keep_what_no_window_covers(void **state) {
    const uint8_t white[4] = {255, 255, 255, 255};
    sim_picture_t glass;
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 10, .full_update = true}, TUILE_WIRE_RGB565_LE, 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.kind = USB_CARD_FLAT, .seed = 45}, 0);
    assert_int_equal(tuile_display_window(&stand.display, 15, 9, 1, 1), 0);
    assert_int_equal(tuile_display_write(&stand.display, white, 2), 0);
    assert_int_equal(tuile_display_present(&stand.display), 0);
    assert_int_equal(stand.model->picture(stand.model, &glass, NULL), 0);
    assert_memory_equal(sim_picture_at(&glass, 15, 9), white, 3);
    assert_memory_equal(sim_picture_at(&glass, 14, 9), sim_picture_at(&glass, 0, 0), 3);
    assert_memory_not_equal(sim_picture_at(&glass, 14, 9), white, 3);
    sim_picture_free(&glass);
    gud_stand_finish(&stand);
}

/* ---- formats ---------------------------------------------------------------------------------------------------- */

static void test_default_is_the_best_that_is_offered(void **state) {
    static const struct {
        uint8_t offered[SIM_GUD_FORMATS_MAX];
        uint8_t wire;
    } cases[] = {
        {{SIM_GUD_R1, SIM_GUD_R8, SIM_GUD_XRGB1111, SIM_GUD_RGB332, SIM_GUD_RGB565, SIM_GUD_RGB888, SIM_GUD_XRGB8888},
         TUILE_WIRE_RGB565_LE},
        {{SIM_GUD_XRGB8888, SIM_GUD_RGB888, SIM_GUD_RGB332}, TUILE_WIRE_BGR888},
        {{SIM_GUD_R8, SIM_GUD_XRGB8888}, TUILE_WIRE_XRGB8888},
        {{SIM_GUD_R1, SIM_GUD_XRGB1111, SIM_GUD_R8, SIM_GUD_RGB332}, TUILE_WIRE_RGB332},
        {{SIM_GUD_R1, SIM_GUD_XRGB1111, SIM_GUD_R8}, TUILE_WIRE_GREY8},
        {{SIM_GUD_R1, SIM_GUD_XRGB1111}, TUILE_WIRE_XRGB1111},
        {{SIM_GUD_R1}, TUILE_WIRE_MONO_ROWS},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        sim_gud_config_t config = {.width = 16, .height = 8};
        gud_stand_t stand;
        memcpy(config.formats, cases[i].offered, sizeof config.formats);
        gud_stand_start(&stand, &config, TUILE_WIRE_DEFAULT, 0);
        assert_int_equal(stand.display.wire, cases[i].wire);
        gud_stand_draw(&stand, &(usb_card_way_t){.seed = 50}, 0);
        gud_stand_finish(&stand);
    }
}

static void test_formats_that_cannot_be_had(void **state) {
    static const struct {
        sim_gud_config_t config;
        uint8_t wire;
        int expected;
    } cases[] = {
        {{.formats = {SIM_GUD_RGB565}}, TUILE_WIRE_BGR888, TUILE_HAL_UNSUPPORTED},
        {{.formats = {SIM_GUD_RGB565}}, TUILE_WIRE_RGB565, TUILE_HAL_UNSUPPORTED}, /* the other byte order */
        {{.formats = {SIM_GUD_RGB565}}, TUILE_WIRE_RGB565_LE, 0},
        {{.width = 122, .height = 250}, TUILE_WIRE_MONO_ROWS, TUILE_HAL_UNSUPPORTED}, /* 122 / 8 leaves 2 pixels */
        {{.width = 122, .height = 250}, TUILE_WIRE_XRGB1111, 0},
        {{.width = 121, .height = 250}, TUILE_WIRE_XRGB1111, TUILE_HAL_UNSUPPORTED},
        {{.width = 100, .height = 9, .max_buffer_bytes = 199}, TUILE_WIRE_RGB565_LE, TUILE_HAL_UNSUPPORTED}, /* less than a row */
        {{.width = 100, .height = 9, .max_buffer_bytes = 200}, TUILE_WIRE_RGB565_LE, 0},
        {{.width = 100, .height = 9, .max_buffer_bytes = 199}, TUILE_WIRE_DEFAULT, 0}, /* RGB332 fits */
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        gud_stand_t stand;
        gud_stand_plug(&stand, &cases[i].config);
        assert_int_equal(tuile_gud_open(&stand.gud, NULL), 0);
        assert_int_equal(gud_stand_begin(&stand, cases[i].wire, 0), cases[i].expected);
        gud_stand_finish(&stand);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_all_formats_in_windows_and_pieces, mock_usb_set_up),
        cmocka_unit_test_setup(test_odd_windows_where_pixels_are_whole_bytes, mock_usb_set_up),
        cmocka_unit_test_setup(test_partial_update, mock_usb_set_up),
        cmocka_unit_test_setup(test_windows_are_cut_at_the_devices_buffer, mock_usb_set_up),
        cmocka_unit_test_setup(test_long_transfers_are_cut_by_libusb, mock_usb_set_up),
        cmocka_unit_test_setup(test_large_pictures_go_in_several_updates, mock_usb_set_up),
        cmocka_unit_test_setup(test_write_returns_while_pixels_are_on_their_way, mock_usb_set_up),
        cmocka_unit_test_setup(test_lz4_pays_on_flat_pictures_only, mock_usb_set_up),
        cmocka_unit_test_setup(test_lz4_in_pieces_and_cut_at_the_devices_buffer, mock_usb_set_up),
        cmocka_unit_test_setup(test_compression_can_be_declined, mock_usb_set_up),
        cmocka_unit_test_setup(test_whole_frames_are_gathered_from_windows, mock_usb_set_up),
        cmocka_unit_test_setup(test_whole_frames_are_cut_at_the_devices_buffer, mock_usb_set_up),
        cmocka_unit_test_setup(test_whole_frame_after_one_that_was_cut_is_announced, mock_usb_set_up),
        cmocka_unit_test_setup(test_whole_frames_keep_what_no_window_covers, mock_usb_set_up),
        cmocka_unit_test_setup(test_default_is_the_best_that_is_offered, mock_usb_set_up),
        cmocka_unit_test_setup(test_formats_that_cannot_be_had, mock_usb_set_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
