/* AX206 photo frames through the real libusb: bytes of the transport, pixels, brightness, faults. The device is sim/usb's model at
 * the far end of umockdev's usbfs. */
#include "support/check.h"

#include "../hal/display.h"
#include "../hal/usb/ax206.h"
#include "../sim/usb/ax206_model.h"
#include "mock/mock_usb.h"
#include "support/usb_card.h"

typedef struct stand {
    sim_usb_t *model;
    mock_usb_t *device;
    tuile_ax206_t frame;
    tuile_display_t display;
} stand_t;

static void plug(stand_t *stand, uint16_t width, uint16_t height) {
    *stand = (stand_t){0};
    stand->model = sim_ax206_create(&(sim_ax206_config_t){.width = width, .height = height, .serial = "0001"}, NULL);
    assert_non_null(stand->model);
    stand->device = mock_usb_plug(1, stand->model);
}

static int begin(stand_t *stand, const tuile_ax206_config_t *config) {
    const int result = tuile_ax206_open(&stand->frame, config);

    if (result) { return result; }
    return tuile_display_init(&stand->display,
                              &(tuile_display_config_t){.device = &tuile_ax206_device, .device_context = &stand->frame});
}

static void start(stand_t *stand, uint16_t width, uint16_t height) {
    plug(stand, width, height);
    assert_int_equal(begin(stand, NULL), 0);
}

static void finish(stand_t *stand) {
    tuile_ax206_close(&stand->frame);
    assert_string_equal(stand->model->fault.text, "");
    assert_int_equal(mock_usb_state(stand->device)->pending, 0);
    mock_usb_clear();
    stand->model->destroy(stand->model);
}

static void draw(stand_t *stand, const usb_card_way_t *way) {
    const int result = usb_card_draw(&stand->display, way);

    assert_string_equal(stand->model->fault.text, "");
    assert_string_equal(stand->frame.error_text, "");
    assert_int_equal(result, 0);
    usb_card_check(stand->model, TUILE_WIRE_RGB565, way, 0);
}

/* ---- what goes over -------------------------------------------------------------------------------------------------- */

static void test_pixels_in_windows_and_pieces(void **state) {
    static const usb_card_way_t ways[] = {{.seed = 1},
                                          {.seed = 2, .tile_width = 13, .tile_height = 5},
                                          {.seed = 3, .tile_width = 1, .tile_height = 1},
                                          {.seed = 4, .tile_width = 17, .tile_height = 6, .piece_pixels = 7}};
    stand_t stand;

    (void)state;
    start(&stand, 40, 21);
    assert_int_equal(stand.display.width, 40);
    assert_int_equal(stand.display.height, 21);
    assert_int_equal(stand.display.wire, TUILE_WIRE_RGB565);
    usb_card_check_dark(stand.model);
    for (size_t i = 0; i < CHECK_COUNT(ways); i++) {
        draw(&stand, &ways[i]);
    }
    finish(&stand);
}

/* 480 x 320 x 2 bytes are 18.75 URBs of 16 KB. */
static void test_whole_picture_cut_by_libusb(void **state) {
    stand_t stand;

    (void)state;
    plug(&stand, 480, 320);
    mock_usb_state(stand.device)->kernel = MOCK_USB_CUT;
    assert_int_equal(begin(&stand, NULL), 0);
    draw(&stand, &(usb_card_way_t){.seed = 5});
    assert_int_equal(sim_ax206_counts(stand.model)->blits, 1);
    assert_int_equal(sim_ax206_counts(stand.model)->pixel_bytes, 307200);
    assert_int_equal(mock_usb_state(stand.device)->largest_bytes, 16384);
    finish(&stand);
}

/* A device that only keeps what it is sent, and answers what it is told to. */
typedef struct tape {
    sim_usb_t usb;
    uint8_t bytes[512];
    size_t count;
    const uint8_t *answers;
} tape_t;

static int tape_bulk(sim_usb_t *usb, uint8_t endpoint, uint8_t *data, size_t length) {
    tape_t *tape = (tape_t *)usb;

    if (endpoint & 0x80u) {
        memcpy(data, tape->answers, length);
        tape->answers += length;
    } else {
        assert_in_range(tape->count + length, 0, sizeof tape->bytes);
        memcpy(tape->bytes + tape->count, data, length);
        tape->count += length;
    }
    return (int)length;
}

static void tape_reset(sim_usb_t *usb) { ((tape_t *)usb)->count = 0; }

#define STATUS(tag) 'U', 'S', 'B', 'S', tag, 0, 0, 0, 0, 0, 0, 0, 0

/* Bulk-Only Transport 1.0, 5.1: signature, tag, length, flags, LUN, length of the CDB, and the vendor's 16 bytes. */
static void test_bytes_on_the_wire(void **state) {
    static const uint8_t expected[] = {
        'U',  'S', 'B', 'C', 1,  0,  0,    0,    5,    0,   0, 0,    0x80, 0, 16, /* the size is read: 5 bytes in */
        0xCD, 0,   0,   0,   0,  2,  0,    0,    0,    0,   0, 0,    0,    0, 0,  0, 'U', 'S', 'B', 'C', 2,  0,
        0,    0,   0,   0,   0,  0,  0,    0,    16, /* dark */
        0xCD, 0,   0,   0,   0,  6,  0x01, 1,    0,    0,   0, 0,    0,    0, 0,  0, 'U', 'S', 'B', 'C', 3,  0,
        0,    0,   12,  0,   0,  0,  0,    0,    16, /* 3 x 2 pixels at (258, 5): to 260 = 0104h and 6 */
        0xCD, 0,   0,   0,   0,  6,  0x12, 0x02, 0x01, 5,   0, 0x04, 0x01, 6, 0,  0, 1,   2,   3,   4,   5,  6,
        7,    8,   9,   10,  11, 12, 'U',  'S',  'B',  'C', 4, 0,    0,    0, 0,  0, 0,   0,   0,   0,   16, /* light */
        0xCD, 0,   0,   0,   0,  6,  0x01, 1,    0,    7,   0, 0,    0,    0, 0,  0,
    };
    static const uint8_t answers[] = {0xE0, 1, 0x40, 1, 0, STATUS(1), STATUS(2), STATUS(3), STATUS(4)};
    static const uint8_t pixels[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    sim_usb_t *model = sim_ax206_create(NULL, NULL);
    tape_t tape = {.usb = *model, .answers = answers};
    tuile_ax206_t frame;
    tuile_display_t display;

    (void)state;
    tape.usb.bulk = tape_bulk;
    tape.usb.reset = tape_reset;
    (void)mock_usb_plug(1, &tape.usb);
    assert_int_equal(tuile_ax206_open(&frame, NULL), 0);
    assert_int_equal(frame.width, 480);
    assert_int_equal(frame.height, 320);
    assert_int_equal(
        tuile_display_init(&display, &(tuile_display_config_t){.device = &tuile_ax206_device, .device_context = &frame}), 0);
    assert_int_equal(tuile_display_window(&display, 258, 5, 3, 2), 0);
    assert_int_equal(tuile_display_write(&display, pixels, 12), 0);
    assert_int_equal(tuile_display_present(&display), 0);
    tuile_ax206_close(&frame);
    mock_usb_clear();
    assert_int_equal(tape.count, sizeof expected);
    assert_memory_equal(tape.bytes, expected, sizeof expected);
    model->destroy(model);
}

static void test_write_returns_while_pixels_are_on_their_way(void **state) {
    uint8_t pixels[2 * 8 * 4] = {0};
    stand_t stand;

    (void)state;
    start(&stand, 8, 4);
    assert_int_equal(tuile_display_window(&stand.display, 0, 0, 8, 4), 0);
    assert_int_equal(tuile_display_write(&stand.display, pixels, sizeof pixels), 0);
    assert_int_equal(mock_usb_state(stand.device)->pending, 1);
    assert_int_equal(tuile_display_wait(&stand.display), 0);
    assert_int_equal(mock_usb_state(stand.device)->pending, 0);
    finish(&stand);
}

/* 7 steps of 36.4: 18 is nearer to none, but dark is for 0 alone. */
static void test_brightness(void **state) {
    static const struct {
        uint8_t level;
        unsigned step;
    } cases[] = {{255, 7}, {237, 7}, {236, 6}, {128, 4}, {127, 3}, {19, 1}, {18, 1}, {1, 1}, {0, 0}};
    stand_t stand;

    (void)state;
    start(&stand, 8, 4);
    assert_int_equal(sim_ax206_brightness(stand.model), 0);
    draw(&stand, &(usb_card_way_t){.seed = 6});
    assert_int_equal(sim_ax206_brightness(stand.model), 7);
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        assert_int_equal(tuile_display_brightness(&stand.display, cases[i].level), 0);
        assert_int_equal(sim_ax206_brightness(stand.model), cases[i].step);
    }
    assert_int_equal(tuile_display_brightness(&stand.display, 255), 0);
    assert_int_equal(tuile_display_close(&stand.display), 0);
    usb_card_check_dark(stand.model);
    finish(&stand);
}

static void test_what_it_does_not_have(void **state) {
    static const tuile_display_config_t configs[] = {
        {.rotation = 1},    {.rotation = 2},          {.wire = TUILE_WIRE_RGB565_LE}, {.wire = TUILE_WIRE_BGR888},
        {.identify = true}, {.tearing_timeout_ms = 1}};
    stand_t stand;

    (void)state;
    plug(&stand, 8, 4);
    assert_int_equal(tuile_ax206_open(&stand.frame, NULL), 0);
    for (size_t i = 0; i < CHECK_COUNT(configs); i++) {
        tuile_display_config_t config = configs[i];
        config.device = &tuile_ax206_device;
        config.device_context = &stand.frame;
        assert_int_equal(tuile_display_init(&stand.display, &config), TUILE_HAL_UNSUPPORTED);
    }
    finish(&stand);
}

static void test_which_of_two(void **state) {
    sim_usb_t *other = sim_ax206_create(&(sim_ax206_config_t){.width = 6, .height = 6, .serial = "0002"}, NULL);
    stand_t stand;

    (void)state;
    plug(&stand, 8, 4);
    (void)mock_usb_plug(2, other);
    assert_int_equal(begin(&stand, &(tuile_ax206_config_t){.serial = "0002"}), 0);
    assert_int_equal(stand.display.width, 6);
    tuile_ax206_close(&stand.frame);
    assert_int_equal(begin(&stand, &(tuile_ax206_config_t){.bus = 1, .address = 2}), 0);
    assert_int_equal(stand.display.width, 8);
    tuile_ax206_close(&stand.frame);
    assert_int_equal(begin(&stand, &(tuile_ax206_config_t){.serial = "0003"}), TUILE_HAL_NOT_FOUND);
    assert_int_equal(tuile_ax206_wait_for(&(tuile_ax206_config_t){.serial = "0002"}, 0), 0);
    assert_int_equal(tuile_ax206_wait_for(&(tuile_ax206_config_t){.serial = "0003"}, 0), TUILE_HAL_TIMEOUT);
    finish(&stand);
    other->destroy(other);
}

/* ---- faults ------------------------------------------------------------------------------------------------------ */

static void test_command_that_fails_says_so(void **state) {
    stand_t stand;

    (void)state;
    start(&stand, 8, 4);
    draw(&stand, &(usb_card_way_t){.seed = 7});
    sim_ax206_break(stand.model, 1);
    assert_int_equal(usb_card_draw(&stand.display, &(usb_card_way_t){.seed = 8}), TUILE_HAL_PROTOCOL);
    assert_string_equal(stand.frame.error_text, "usb 1-2: pixels: the frame says that the command failed");
    sim_ax206_break(stand.model, 0);
    assert_int_equal(tuile_display_resume(&stand.display), 0);
    draw(&stand, &(usb_card_way_t){.seed = 9});
    finish(&stand);
}

/* Whoever closes after a fault leaves the frame dark all the same. */
static void test_dark_after_a_fault_without_resume(void **state) {
    stand_t stand;

    (void)state;
    start(&stand, 8, 4);
    draw(&stand, &(usb_card_way_t){.seed = 10});
    mock_usb_state(stand.device)->fault = MOCK_USB_PROTO;
    mock_usb_state(stand.device)->fault_at = mock_usb_state(stand.device)->submitted + 2; /* pixels, after their command */
    assert_int_equal(usb_card_draw(&stand.display, &(usb_card_way_t){.seed = 11}), TUILE_HAL_IO);
    assert_int_equal(tuile_display_close(&stand.display), 0);
    usb_card_check_dark(stand.model);
    finish(&stand);
}

static void test_size_that_is_cut(void **state) {
    stand_t stand;

    (void)state;
    plug(&stand, 8, 4);
    mock_usb_state(stand.device)->fault = MOCK_USB_SHORT;
    mock_usb_state(stand.device)->fault_at = 2;
    assert_int_equal(begin(&stand, NULL), TUILE_HAL_PROTOCOL);
    assert_string_equal(stand.frame.error_text, "usb 1-2: reading the size: the answer is too short");
    finish(&stand);
}

/* A status for another command is no status, nor is one without its signature. */
static void test_status_that_is_not_the_commands(void **state) {
    static const uint8_t answers[2][18] = {{0xE0, 1, 0x40, 1, 0, STATUS(9)}, {0xE0, 1, 0x40, 1, 0, 'U', 'S', 'B', 'C', 1}};

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(answers); i++) {
        sim_usb_t *model = sim_ax206_create(NULL, NULL);
        tape_t tape = {.usb = *model, .answers = answers[i]};
        tuile_ax206_t frame;
        tape.usb.bulk = tape_bulk;
        tape.usb.reset = tape_reset;
        (void)mock_usb_plug(1, &tape.usb);
        assert_int_equal(tuile_ax206_open(&frame, NULL), TUILE_HAL_PROTOCOL);
        assert_string_equal(frame.error_text, "usb 1-2: reading the size: what came is not the status of the command");
        mock_usb_clear();
        model->destroy(model);
    }
}

static void test_frame_without_an_endpoint_to_the_host(void **state) {
    sim_usb_t *model = sim_ax206_create(NULL, NULL);
    uint8_t descriptors[64];
    tuile_ax206_t frame;

    (void)state;
    memcpy(descriptors, model->descriptors, model->descriptors_bytes);
    assert_int_equal(descriptors[18 + 9 + 9 + 7 + 2], 0x81);
    descriptors[18 + 9 + 9 + 7 + 2] = 0x02;
    model->descriptors = descriptors;
    (void)mock_usb_plug(1, model);
    assert_int_equal(tuile_ax206_open(&frame, NULL), TUILE_HAL_UNSUPPORTED);
    assert_string_equal(frame.error_text, "usb 1-2: AX206 frame: no interface with the bulk endpoints that it needs");
    mock_usb_clear();
    model->destroy(model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_pixels_in_windows_and_pieces, mock_usb_set_up),
        cmocka_unit_test_setup(test_whole_picture_cut_by_libusb, mock_usb_set_up),
        cmocka_unit_test_setup(test_bytes_on_the_wire, mock_usb_set_up),
        cmocka_unit_test_setup(test_write_returns_while_pixels_are_on_their_way, mock_usb_set_up),
        cmocka_unit_test_setup(test_brightness, mock_usb_set_up),
        cmocka_unit_test_setup(test_what_it_does_not_have, mock_usb_set_up),
        cmocka_unit_test_setup(test_which_of_two, mock_usb_set_up),
        cmocka_unit_test_setup(test_command_that_fails_says_so, mock_usb_set_up),
        cmocka_unit_test_setup(test_dark_after_a_fault_without_resume, mock_usb_set_up),
        cmocka_unit_test_setup(test_size_that_is_cut, mock_usb_set_up),
        cmocka_unit_test_setup(test_status_that_is_not_the_commands, mock_usb_set_up),
        cmocka_unit_test_setup(test_frame_without_an_endpoint_to_the_host, mock_usb_set_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
