/* GUD displays through the real libusb: modes, connectors, properties, and which of several displays. */
#include "support/check.h"

#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include "mock/gud_stand.h"

/* ---- modes and connectors --------------------------------------------------------------------------------------- */

static void test_modes(void **state) {
    static const struct {
        uint8_t preferred;
        tuile_gud_config_t wanted;
        int expected;
        uint16_t width, height;
    } cases[] = {
        {0, {0}, 0, 64, 32},
        {2, {0}, 0, 32, 64},
        {3, {0}, 0, 48, 32},
        {3, {.width = 32, .height = 64}, 0, 32, 64},
        {3, {.height = 32}, 0, 48, 32}, /* of those the one that is preferred */
        {2, {.height = 32}, 0, 64, 32},
        {2, {.width = 32, .height = 32}, TUILE_HAL_UNSUPPORTED, 0, 0},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        gud_stand_t stand;
        gud_stand_plug(&stand, &(sim_gud_config_t){.modes = {{64, 32}, {32, 64}, {48, 32}}, .preferred = cases[i].preferred});
        assert_int_equal(tuile_gud_open(&stand.gud, &cases[i].wanted), cases[i].expected);
        if (cases[i].expected) {
            assert_non_null(strstr(stand.gud.error_text, "no mode of 32 x 32"));
        } else {
            assert_int_equal(gud_stand_begin(&stand, 0, 0), 0);
            assert_int_equal(stand.display.width, cases[i].width);
            assert_int_equal(stand.display.height, cases[i].height);
            gud_stand_draw(&stand, &(usb_card_way_t){.seed = 60}, 0);
            assert_int_equal(sim_gud_state(stand.model).width, cases[i].width);
        }
        gud_stand_finish(&stand);
    }
}

/* 640 x 480 at 60 Hz as VESA times it: 25.18 MHz, blanks of 160 and 45, fronts of 16 and 10, syncs of 96 and 2. */
static void test_mode_from_edid(void **state) {
    uint8_t edid[128] = {0, 255, 255, 255, 255, 255, 255, 0}, sum = 0;
    static const uint8_t timing[18] = {0xD6, 0x09, 0x80, 0xA0, 0x20, 0xE0, 0x2D, 0x10, 0x10, 0x60, 0xA2, 0x00, 0, 0, 0, 0, 0, 0x18};

    (void)state;
    memcpy(edid + 54, (const uint8_t[18]){0, 0, 0, 0xFC, 0, 'T', 'u', 'i', 'l', 'e'}, 18); /* a name */
    memcpy(edid + 72, timing, sizeof timing);
    edid[72 + 5] = 0xF0, edid[72 + 17] |= 0x80; /* 240 lines, interlaced */
    memcpy(edid + 90, timing, sizeof timing);
    for (unsigned i = 0; i < 127; i++) {
        sum = (uint8_t)(sum + edid[i]);
    }
    for (int good = 0; good < 2; good++) {
        gud_stand_t stand;
        edid[127] = (uint8_t)((good ? 0 : 1) - sum);
        gud_stand_plug(&stand, &(sim_gud_config_t){
                                   .width = 640, .height = 480, .edid = edid, .edid_bytes = sizeof edid, .modes_from_edid = true});
        assert_int_equal(tuile_gud_open(&stand.gud, NULL), good ? 0 : TUILE_HAL_UNSUPPORTED);
        if (good) {
            /* clock, then begin and end of what is seen, of the sync, of all; flags: preferred, both syncs negative */
            static const uint8_t mode[24] = {0x5C, 0x62, 0,    0, 0x80, 2, 0x90, 2, 0xF0, 2, 0x20, 3,
                                             0xE0, 1,    0xEA, 1, 0xEC, 1, 0x0D, 2, 0x0A, 4, 0,    0};
            assert_memory_equal(stand.gud.mode, mode, sizeof mode);
            assert_int_equal(gud_stand_begin(&stand, 0, 0), 0);
            gud_stand_draw(&stand, &(usb_card_way_t){.seed = 61}, 0);
        }
        gud_stand_finish(&stand);
    }
}

static void test_connectors(void **state) {
    enum { NONE = SIM_GUD_DISCONNECTED + 1, THERE = SIM_GUD_CONNECTED + 1, WHO_KNOWS = SIM_GUD_UNKNOWN + 1 };
    static const struct {
        uint8_t status[2], wanted;
        int expected;
        uint8_t connector;
    } cases[] = {
        {{THERE, THERE}, 0, 0, 0},
        {{NONE, THERE}, 0, 0, 1},
        {{WHO_KNOWS, THERE}, 0, 0, 1},
        {{NONE, WHO_KNOWS}, 0, 0, 1},
        {{THERE, THERE}, 2, 0, 1},
        {{NONE, NONE}, 0, TUILE_HAL_NOT_FOUND, 0},
        {{NONE, THERE}, 1, TUILE_HAL_NOT_FOUND, 0},
        {{THERE, THERE}, 3, TUILE_HAL_NOT_FOUND, 0},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        sim_gud_config_t config = {.width = 16, .height = 8, .connectors = 2};
        gud_stand_t stand;
        memcpy(config.status, cases[i].status, 2);
        gud_stand_plug(&stand, &config);
        assert_int_equal(tuile_gud_open(&stand.gud, &(tuile_gud_config_t){.connector = cases[i].wanted}), cases[i].expected);
        if (!cases[i].expected) {
            assert_int_equal(gud_stand_begin(&stand, 0, 0), 0);
            gud_stand_draw(&stand, &(usb_card_way_t){.seed = 62}, 0);
            assert_int_equal(sim_gud_state(stand.model).connector, cases[i].connector);
        } else {
            assert_non_null(strstr(stand.gud.error_text, "connector"));
        }
        gud_stand_finish(&stand);
    }
}

/* ---- properties ------------------------------------------------------------------------------------------------- */

/* Levels of 255 to per cent: 128 / 2.55 = 50.2, 1 / 2.55 = 0.4. Dark is a display that is off. */
static void test_brightness(void **state) {
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 8, .backlight = true, .rotations = 1}, 0, 0);
    assert_true(stand.display.dimmable);
    usb_card_check_dark(stand.model);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 70}, 0);
    assert_int_equal(sim_gud_state(stand.model).backlight, 100);
    assert_int_equal(tuile_display_brightness(&stand.display, 128), 0);
    assert_int_equal(sim_gud_state(stand.model).backlight, 50);
    assert_int_equal(tuile_display_brightness(&stand.display, 1), 0);
    assert_int_equal(sim_gud_state(stand.model).backlight, 0);
    assert_true(sim_gud_state(stand.model).display);
    assert_int_equal(tuile_display_brightness(&stand.display, 0), 0);
    usb_card_check_dark(stand.model);
    assert_int_equal(tuile_display_brightness(&stand.display, 255), 0);
    usb_card_check(stand.model, stand.display.wire, &(usb_card_way_t){.seed = 70}, 0);
    gud_stand_finish(&stand);
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 8}, 0, 0);
    assert_false(stand.display.dimmable);
    assert_int_equal(tuile_display_brightness(&stand.display, 9), TUILE_HAL_UNSUPPORTED);
    gud_stand_finish(&stand);
}

static void test_rotation_is_the_devices_property(void **state) {
    (void)state;
    for (uint8_t rotation = 0; rotation < 4; rotation++) {
        for (unsigned full = 0; full < 2; full++) {
            gud_stand_t stand;
            gud_stand_start(&stand,
                            &(sim_gud_config_t){.width = 24, .height = 16, .rotations = 15, .full_update = full, .backlight = true},
                            0, rotation);
            assert_int_equal(stand.display.width, rotation % 2 ? 16 : 24);
            assert_int_equal(stand.display.height, rotation % 2 ? 24 : 16);
            gud_stand_draw(&stand, &(usb_card_way_t){.seed = 71, .tile_width = 10, .tile_height = 7}, rotation);
            gud_stand_finish(&stand);
        }
    }
}

static void test_rotation_that_the_device_does_not_have(void **state) {
    gud_stand_t stand;

    (void)state;
    gud_stand_plug(&stand, &(sim_gud_config_t){.rotations = 5}); /* none and half a turn */
    assert_int_equal(tuile_gud_open(&stand.gud, NULL), 0);
    assert_int_equal(gud_stand_begin(&stand, 0, 1), TUILE_HAL_UNSUPPORTED);
    assert_int_equal(gud_stand_begin(&stand, 0, 3), TUILE_HAL_UNSUPPORTED);
    assert_int_equal(gud_stand_begin(&stand, 0, 2), 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 72}, 2);
    gud_stand_finish(&stand);
    gud_stand_plug(&stand, NULL);
    assert_int_equal(tuile_gud_open(&stand.gud, NULL), 0);
    assert_int_equal(gud_stand_begin(&stand, 0, 2), TUILE_HAL_UNSUPPORTED);
    assert_int_equal(gud_stand_begin(&stand, 0, 0), 0);
    gud_stand_finish(&stand);
}

/* The model notes a host that does not read the status after each set. */
static void test_status_is_read_after_each_set_where_the_device_wants_it(void **state) {
    const char *text;
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 8, .status_on_set = true, .backlight = true}, 0, 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 73, .tile_height = 3}, 0);
    assert_int_equal(tuile_display_brightness(&stand.display, 30), 0);
    sim_gud_break(stand.model, SIM_GUD_BUSY);
    assert_int_equal(tuile_display_brightness(&stand.display, 60), TUILE_HAL_PROTOCOL);
    text = stand.gud.error_text;
    assert_string_equal(text, "usb 1-2: SET_STATE_CHECK: refused; status: busy");
    sim_gud_break(stand.model, 0);
    assert_int_equal(tuile_display_resume(&stand.display), 0);
    assert_string_equal(text, "");
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 74}, 0);
    assert_int_equal(tuile_display_close(&stand.display), 0);
    usb_card_check_dark(stand.model);
    assert_false(sim_gud_state(stand.model).controller);
    gud_stand_finish(&stand);
}

/* No bytes are no status, and least of all "no error": a set that is not confirmed has failed, whether the device stalls it or not.
 */
static void test_empty_answer_is_no_status(void **state) {
    static const struct {
        bool status_on_set;
        const char *text;
    } cases[] = {
        {true, "usb 1-2: SET_STATE_CHECK: no status: an empty answer"},
        {false, "usb 1-2: SET_STATE_CHECK: stalled; no status: an empty answer"},
    };

    (void)state;
    for (unsigned i = 0; i < 2; i++) {
        const sim_gud_config_t config = {.width = 16, .height = 8, .status_on_set = cases[i].status_on_set, .backlight = true};
        gud_stand_t stand;

        gud_stand_start(&stand, &config, 0, 0);
        gud_stand_draw(&stand, &(usb_card_way_t){.seed = 75}, 0);
        sim_gud_break(stand.model, SIM_GUD_SILENT);
        assert_int_equal(tuile_display_brightness(&stand.display, 30), TUILE_HAL_PROTOCOL);
        assert_string_equal(stand.gud.error_text, cases[i].text);
        sim_gud_break(stand.model, 0);
        assert_int_equal(tuile_display_resume(&stand.display), 0);
        gud_stand_draw(&stand, &(usb_card_way_t){.seed = 76}, 0);
        gud_stand_finish(&stand);
    }
}

/* A device that refuses everything is put to sleep in vain, but what is told is where it began. */
static void test_text_is_that_of_the_first_fault(void **state) {
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 8}, 0, 0);
    sim_gud_break(stand.model, SIM_GUD_ERROR);
    assert_int_equal(usb_card_draw(&stand.display, &(usb_card_way_t){.seed = 78}), TUILE_HAL_PROTOCOL);
    assert_string_equal(stand.gud.error_text, "usb 1-2: SET_BUFFER: stalled; status: error");
    assert_int_equal(tuile_display_close(&stand.display), TUILE_HAL_PROTOCOL);
    assert_string_equal(stand.gud.error_text, "usb 1-2: SET_BUFFER: stalled; status: error");
    gud_stand_finish(&stand);
}

static void test_sleep_and_resume(void **state) {
    gud_stand_t stand;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 8}, 0, 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 75}, 0);
    assert_int_equal(tuile_display_sleep(&stand.display), 0);
    usb_card_check_dark(stand.model);
    assert_int_equal(tuile_display_resume(&stand.display), 0);
    usb_card_check_dark(stand.model);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 76}, 0);
    assert_int_equal(tuile_display_close(&stand.display), 0);
    usb_card_check_dark(stand.model);
    gud_stand_finish(&stand);
}

/* ---- what goes over ---------------------------------------------------------------------------------------------- */

/* A model behind a pen: it writes down requests that set something, and sizes of bulk transfers. */
typedef struct pen {
    sim_usb_t usb;
    sim_usb_t *model;
    char text[4096];
    size_t count;
} pen_t;

static void pen_write(pen_t *pen, const char *what, unsigned number) {
    pen->count += (size_t)snprintf(pen->text + pen->count, sizeof pen->text - pen->count, what, number);
    assert_in_range(pen->count, 0, sizeof pen->text - 1);
}

static int pen_control(sim_usb_t *usb, const uint8_t setup[8], uint8_t *data, size_t length) {
    pen_t *pen = (pen_t *)usb;

    if (setup[0] == 0x41) {
        pen_write(pen, "%02X:", setup[1]);
        for (size_t i = 0; i < length; i++) {
            pen_write(pen, " %02X", data[i]);
        }
        pen_write(pen, "\n", 0);
    } else {
        assert_int_equal(setup[0], 0xC1);
    }
    return pen->model->control(pen->model, setup, data, length);
}

static int pen_bulk(sim_usb_t *usb, uint8_t endpoint, uint8_t *data, size_t length) {
    pen_t *pen = (pen_t *)usb;

    pen_write(pen, "bulk %u\n", (unsigned)length);
    return pen->model->bulk(pen->model, endpoint, data, length);
}

static void pen_reset(sim_usb_t *usb) { ((pen_t *)usb)->model->reset(((pen_t *)usb)->model); }

/* 16 x 8, of 40 x 14 with blanks at 60 Hz: 33.6, cut to 33 kHz; backlight 50 of 100 (32h), no rotation (bit 0). Windows of 16 x 5
 * and 16 x 3 pixels of 2 bytes: A0h and 60h. Then full light (64h), and off. */
static void test_requests_in_the_kernels_order(void **state) {
#define MODE "21 00 00 00 10 00 18 00 20 00 28 00 08 00 0A 00 0C 00 0E 00 00 04 00 00"
#define BACKLIGHT(percent) " 0C 00 " percent " 00 00 00 00 00 00 00"
#define ROTATION " 32 00 01 00 00 00 00 00 00 00"
    static const char expected[] = "53:\n"
                                   "61: " MODE " 40 00" BACKLIGHT("32") ROTATION
        "\n"
        "63: 01\n"
        "62:\n"
        "64: 00\n"
        "60: 00 00 00 00 00 00 00 00 10 00 00 00 05 00 00 00 A0 00 00 00 00 00 00 00 00\n"
        "bulk 160\n"
        "60: 00 00 00 00 05 00 00 00 10 00 00 00 03 00 00 00 60 00 00 00 00 00 00 00 00\n"
        "bulk 96\n"
        "64: 01\n"
        "61: " MODE " 40 00" BACKLIGHT("64") ROTATION "\n"
                                                      "62:\n"
                                                      "64: 00\n"
                                                      "63: 00\n";
    static pen_t pen;
    gud_stand_t stand = {0};

    (void)state;
    pen = (pen_t){.model = sim_gud_create(
                      &(sim_gud_config_t){.width = 16, .height = 8, .preferred = 1, .backlight = true, .rotations = 15}, NULL)};
    pen.usb = *pen.model;
    pen.usb.control = pen_control;
    pen.usb.bulk = pen_bulk;
    pen.usb.reset = pen_reset;
    stand.model = pen.model;
    stand.device = mock_usb_plug(1, &pen.usb);
    assert_int_equal(tuile_gud_open(&stand.gud, NULL), 0);
    assert_int_equal(gud_stand_begin(&stand, 0, 0), 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 77, .tile_height = 5}, 0);
    assert_int_equal(tuile_display_close(&stand.display), 0);
    gud_stand_finish(&stand);
    assert_string_equal(pen.text, expected);
}

/* ---- which device ----------------------------------------------------------------------------------------------- */

static void test_several_displays_by_serial_and_by_place(void **state) {
    static const char *const serials[3] = {"A1", "A12", "B2"};
    sim_usb_t *models[3];
    tuile_gud_t guds[3], other;
    tuile_display_t displays[3];

    (void)state;
    for (unsigned i = 0; i < 3; i++) {
        models[i] = sim_gud_create(
            &(sim_gud_config_t){
                .width = 16, .height = 8, .serial = serials[i], .interface = (uint8_t)i, .endpoint = (uint8_t)(i + 1)},
            NULL);
        assert_non_null(models[i]);
        (void)mock_usb_plug(i + 1, models[i]);
    }
    for (unsigned i = 0; i < 3; i++) {
        assert_int_equal(tuile_gud_open(&guds[i], i == 2 ? &(tuile_gud_config_t){.bus = 1, .address = 4}
                                                         : &(tuile_gud_config_t){.serial = serials[1 - i]}),
                         0);
        assert_int_equal(
            tuile_display_init(&displays[i], &(tuile_display_config_t){.device = &tuile_gud_device, .device_context = &guds[i]}),
            0);
    }
    for (unsigned i = 0; i < 3; i++) {
        assert_int_equal(usb_card_draw(&displays[i], &(usb_card_way_t){.seed = 80 + i}), 0);
    }
    usb_card_check(models[1], displays[0].wire, &(usb_card_way_t){.seed = 80}, 0);
    usb_card_check(models[0], displays[1].wire, &(usb_card_way_t){.seed = 81}, 0);
    usb_card_check(models[2], displays[2].wire, &(usb_card_way_t){.seed = 82}, 0);
    assert_int_equal(tuile_gud_open(&other, &(tuile_gud_config_t){.serial = "A"}), TUILE_HAL_NOT_FOUND);
    assert_string_equal(other.error_text, "usb: no GUD display is attached that has the serial number A");
    assert_int_equal(tuile_gud_open(&other, &(tuile_gud_config_t){.serial = "B23"}), TUILE_HAL_NOT_FOUND);
    assert_int_equal(tuile_gud_open(&other, &(tuile_gud_config_t){.bus = 1, .address = 9}), TUILE_HAL_NOT_FOUND);
    assert_int_equal(tuile_gud_open(&other, &(tuile_gud_config_t){.bus = 2, .address = 2}), TUILE_HAL_NOT_FOUND);
    for (unsigned i = 0; i < 3; i++) {
        tuile_gud_close(&guds[i]);
        assert_string_equal(models[i]->fault.text, "");
    }
    mock_usb_clear();
    for (unsigned i = 0; i < 3; i++) {
        models[i]->destroy(models[i]);
    }
}

static void test_nothing_attached(void **state) {
    tuile_gud_t gud;
    tuile_display_t display;

    (void)state;
    mock_usb_bed();
    assert_int_equal(tuile_gud_open(&gud, NULL), TUILE_HAL_NOT_FOUND);
    assert_string_equal(gud.error_text, "usb: no GUD display is attached");
    assert_int_equal(tuile_display_init(&display, &(tuile_display_config_t){.device = &tuile_gud_device, .device_context = &gud}),
                     TUILE_HAL_ARGUMENT);
    tuile_gud_close(&gud);
    tuile_gud_close(&gud);
    mock_usb_clear();
}

static void test_other_ids_of_gud(void **state) {
    static const uint16_t ids[][2] = {{0x1D50, 0x614D}, {0x16D0, 0x10A9}, {0x1209, 0x4FB3}};

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(ids); i++) {
        gud_stand_t stand;
        gud_stand_start(&stand, &(sim_gud_config_t){.vendor = ids[i][0], .product = ids[i][1]}, 0, 0);
        gud_stand_finish(&stand);
    }
}

static void test_what_does_not_answer_as_a_gud_display(void **state) {
    static const struct {
        sim_gud_config_t config;
        int expected;
        const char *text;
    } cases[] = {
        {{.magic = 0x12345678}, TUILE_HAL_PROTOCOL, "usb 1-2: not a GUD display: the magic number is 12345678"},
        {{.version = 2}, TUILE_HAL_UNSUPPORTED, "usb 1-2: version 2 of the GUD protocol; 1 is known here"},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        gud_stand_t stand;
        gud_stand_plug(&stand, &cases[i].config);
        assert_int_equal(tuile_gud_open(&stand.gud, NULL), cases[i].expected);
        assert_string_equal(stand.gud.error_text, cases[i].text);
        gud_stand_finish(&stand);
    }
}

static void test_kernel_driver_is_detached_and_given_back(void **state) {
    gud_stand_t stand;

    (void)state;
    gud_stand_plug(&stand, NULL);
    mock_usb_state(stand.device)->driver = true;
    assert_int_equal(tuile_gud_open(&stand.gud, NULL), 0);
    assert_false(mock_usb_state(stand.device)->driver);
    assert_int_equal(mock_usb_state(stand.device)->claims, 1);
    tuile_gud_close(&stand.gud);
    assert_int_equal(mock_usb_state(stand.device)->releases, 1);
    assert_true(mock_usb_state(stand.device)->driver);
    gud_stand_finish(&stand);
}

static void test_display_that_another_program_has(void **state) {
    gud_stand_t stand;

    (void)state;
    gud_stand_plug(&stand, NULL);
    mock_usb_state(stand.device)->busy = true;
    assert_int_equal(tuile_gud_open(&stand.gud, NULL), TUILE_HAL_BUSY);
    assert_string_equal(stand.gud.error_text, "usb 1-2: GUD display cannot be claimed: another program has the device");
    gud_stand_finish(&stand);
}

/* One that can be had, and no word about the one that could not; in either order. */
static void test_display_beside_one_that_another_program_has(void **state) {
    (void)state;
    for (unsigned port = 1; port <= 2; port++) {
        sim_usb_t *taken = sim_gud_create(&(sim_gud_config_t){.width = 8, .height = 8}, NULL);
        gud_stand_t stand = {0};
        mock_usb_state(mock_usb_plug(port, taken))->busy = true;
        stand.model = sim_gud_create(&(sim_gud_config_t){.width = 16, .height = 8}, NULL);
        stand.device = mock_usb_plug(3 - port, stand.model);
        assert_int_equal(tuile_gud_open(&stand.gud, NULL), 0);
        assert_int_equal(stand.gud.width, 16);
        assert_string_equal(stand.gud.error_text, "");
        gud_stand_finish(&stand);
        taken->destroy(taken);
    }
}

static int open_as_nobody(void) {
    tuile_gud_t gud;

    if (geteuid() == 0 && (setegid(65534) || seteuid(65534))) { return 2; }
    return tuile_gud_open(&gud, NULL) == TUILE_HAL_PERMISSION && strstr(gud.error_text, "60-tuile.rules") ? 0 : 1;
}

static void test_no_permission_names_the_rules(void **state) {
    int status = 0;
    pid_t child;
    gud_stand_t stand;

    (void)state;
    gud_stand_plug(&stand, NULL);
    mock_usb_forbid(stand.device);
    fflush(NULL);
    child = fork();
    assert_true(child >= 0);
    if (child == 0) { _exit(open_as_nobody()); }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
    gud_stand_finish(&stand);
}

/* ---- hot plug --------------------------------------------------------------------------------------------------- */

static void *plug_later(void *model) {
    usleep(100000);
    return mock_usb_plug(2, model);
}

static void test_waiting_for_a_display(void **state) {
    sim_usb_t *first = sim_gud_create(&(sim_gud_config_t){.serial = "FIRST"}, NULL);
    sim_usb_t *second = sim_gud_create(&(sim_gud_config_t){.serial = "SECOND"}, NULL);
    tuile_gud_t gud;
    pthread_t thread;

    (void)state;
    mock_usb_bed();
    assert_int_equal(tuile_gud_wait_for(NULL, 0), TUILE_HAL_TIMEOUT);
    assert_int_equal(tuile_gud_wait_for(NULL, 50), TUILE_HAL_TIMEOUT);
    (void)mock_usb_plug(1, first);
    assert_int_equal(tuile_gud_wait_for(NULL, 0), 0);
    assert_int_equal(tuile_gud_wait_for(&(tuile_gud_config_t){.serial = "SECOND"}, 50), TUILE_HAL_TIMEOUT);
    assert_int_equal(pthread_create(&thread, NULL, plug_later, second), 0);
    assert_int_equal(tuile_gud_wait_for(&(tuile_gud_config_t){.serial = "SECOND"}, 10000), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_int_equal(tuile_gud_open(&gud, &(tuile_gud_config_t){.serial = "SECOND"}), 0);
    tuile_gud_close(&gud);
    mock_usb_clear();
    first->destroy(first);
    second->destroy(second);
}

/* As long as the hub has not noticed, transfers to a device that was pulled out fail or stall: the status that is asked for tells.
 */
static void test_unplugged_in_a_transfer(void **state) {
    static const mock_usb_fault_t faults[] = {MOCK_USB_PROTO, MOCK_USB_STALL};

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(faults); i++) {
        for (unsigned urb = 1; urb <= 2; urb++) { /* SET_BUFFER, pixels */
            gud_stand_t stand;
            gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 8}, 0, 0);
            mock_usb_state(stand.device)->fault = faults[i];
            mock_usb_state(stand.device)->fault_at = mock_usb_state(stand.device)->submitted + urb;
            mock_usb_state(stand.device)->then_gone = true;
            assert_int_equal(usb_card_draw(&stand.display, &(usb_card_way_t){.seed = 90}), TUILE_HAL_GONE);
            assert_string_equal(stand.gud.error_text, urb == 1 ? "usb 1-2: SET_BUFFER: the device is gone, open it anew"
                                                               : "usb 1-2: pixels: the device is gone, open it anew");
            assert_int_equal(tuile_display_resume(&stand.display), TUILE_HAL_GONE);
            gud_stand_finish(&stand);
        }
    }
}

static void test_unplugged_and_plugged_in_again(void **state) {
    gud_stand_t stand;
    sim_usb_t *first;

    (void)state;
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 8}, 0, 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 91}, 0);
    mock_usb_unplug(stand.device);
    assert_int_equal(usb_card_draw(&stand.display, &(usb_card_way_t){.seed = 92}), TUILE_HAL_GONE);
    assert_int_equal(tuile_display_close(&stand.display), 0);
    tuile_gud_close(&stand.gud);
    assert_int_equal(tuile_gud_open(&stand.gud, NULL), TUILE_HAL_NOT_FOUND);
    assert_int_equal(tuile_gud_wait_for(NULL, 0), TUILE_HAL_TIMEOUT);
    first = stand.model;
    mock_usb_clear();
    first->destroy(first);
    gud_stand_start(&stand, &(sim_gud_config_t){.width = 16, .height = 8}, 0, 0);
    gud_stand_draw(&stand, &(usb_card_way_t){.seed = 93}, 0);
    gud_stand_finish(&stand);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_modes, mock_usb_set_up),
        cmocka_unit_test_setup(test_mode_from_edid, mock_usb_set_up),
        cmocka_unit_test_setup(test_connectors, mock_usb_set_up),
        cmocka_unit_test_setup(test_brightness, mock_usb_set_up),
        cmocka_unit_test_setup(test_rotation_is_the_devices_property, mock_usb_set_up),
        cmocka_unit_test_setup(test_rotation_that_the_device_does_not_have, mock_usb_set_up),
        cmocka_unit_test_setup(test_status_is_read_after_each_set_where_the_device_wants_it, mock_usb_set_up),
        cmocka_unit_test_setup(test_empty_answer_is_no_status, mock_usb_set_up),
        cmocka_unit_test_setup(test_text_is_that_of_the_first_fault, mock_usb_set_up),
        cmocka_unit_test_setup(test_sleep_and_resume, mock_usb_set_up),
        cmocka_unit_test_setup(test_requests_in_the_kernels_order, mock_usb_set_up),
        cmocka_unit_test_setup(test_several_displays_by_serial_and_by_place, mock_usb_set_up),
        cmocka_unit_test_setup(test_nothing_attached, mock_usb_set_up),
        cmocka_unit_test_setup(test_other_ids_of_gud, mock_usb_set_up),
        cmocka_unit_test_setup(test_what_does_not_answer_as_a_gud_display, mock_usb_set_up),
        cmocka_unit_test_setup(test_kernel_driver_is_detached_and_given_back, mock_usb_set_up),
        cmocka_unit_test_setup(test_display_that_another_program_has, mock_usb_set_up),
        cmocka_unit_test_setup(test_display_beside_one_that_another_program_has, mock_usb_set_up),
        cmocka_unit_test_setup(test_no_permission_names_the_rules, mock_usb_set_up),
        cmocka_unit_test_setup(test_waiting_for_a_display, mock_usb_set_up),
        cmocka_unit_test_setup(test_unplugged_in_a_transfer, mock_usb_set_up),
        cmocka_unit_test_setup(test_unplugged_and_plugged_in_again, mock_usb_set_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
