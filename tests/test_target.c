/* Displays by name: what --display takes, the clocks that controllers can make, and the test card on every panel.
 *
 * Clocks are from the data sheets and by hand. */
#include "support/check.h"

#include "../firmware/stream.h"
#include "../sim/card.h"
#include "../sim/font.h"
#include "../sim/target.h"
#include "../sim/wire.h"

/* ---- names -------------------------------------------------------------------------------------------------------- */

static void a_text_names_a_panel_and_what_is_changed_of_it(void **state) {
    target_config_t config;
    sim_error_t error = {""};
    (void)state;
    assert_int_equal(target_parse(&config, "sim:ili9341,clock=62.5M,command-clock=500k,mcu=rp2040,chunk=4096,brightness=7", &error),
                     0);
    assert_ptr_equal(config.module, sim_panel_find("ili9341"));
    assert_int_equal(config.clock_hz, 62500000);
    assert_int_equal(config.command_clock_hz, 500000);
    assert_ptr_equal(config.mcu, sim_mcu_find("rp2040"));
    assert_int_equal(config.max_chunk_bytes, 4096);
    assert_int_equal(config.brightness, 7);
    assert_false(config.identify);
    /* A copy is changed, never the panel itself: 08h is MADCTL's BGR bit, which the ILI9341 modules want. */
    assert_int_equal(config.panel.rotation_base, 0x08);
    assert_int_equal(target_parse(&config, "sim:ili9341,bgr=0,identify=1", &error), 0);
    assert_int_equal(config.panel.rotation_base, 0);
    assert_true(config.identify);
    assert_int_equal(sim_panel_find("ili9341")->panel->rotation_base, 0x08);
    assert_int_equal(target_parse(&config, "sim:ili9341", &error), 0);
    assert_int_equal(config.clock_hz, 0);
    assert_null(config.mcu);
}

static void what_is_wrong_in_a_text_is_named(void **state) {
    static const char *const cases[][2] = {
        {"", "unknown kind"},
        {"sim", "unknown kind"},
        {"sim:", "unknown panel ''"},
        {"tft:ili9341", "unknown kind"},
        {"sim:ili9342", "'ili9342'"},
        {"sim:ili9341,", "''"},
        {"sim:ili9341,clock", "'clock'"},
        {"sim:ili9341,clock=", "clock=: wants Hz"},
        {"sim:ili9341,clock=0", "clock=0"},
        {"sim:ili9341,clock=1001M", "clock=1001M"},
        {"sim:ili9341,clock=5G", "clock=5G"},
        {"sim:ili9341,clock=-5M", "clock=-5M"},
        {"sim:ili9341,clock=nan", "clock=nan"},
        {"sim:ili9341,command-clock=x", "command-clock=x"},
        {"sim:ili9341,mcu=z80", "tuile mcus"},
        {"sim:ili9341,chunk=5", "at least 6"},
        {"sim:ili9341,chunk=99999999999", "chunk=99999999999"},
        {"sim:ili9341,brightness=0", "1 to 255"},
        {"sim:ili9341,brightness=256", "1 to 255"},
        {"sim:ili9341,bgr=2", "0 or 1"},
        {"sim:ili9341,bgr=-1", "0 or 1"},
        {"sim:ili9341,identify=yes", "0 or 1"},
        {"sim:ili9341,offset=1:0", "at most 0:0"},
        {"sim:ili9341,offset=0", "X:Y"},
        {"sim:ili9341,offset=0:0:0", "X:Y"},
        {"sim:ili9341,dc=4", "unknown part 'dc'"},
        {"usb:", "''"},
        {"usb:tft", "'tft'"},
        {"usb:gud,serial=", "1 to 63"},
        {"usb:gud,mode=320", "WIDTHxHEIGHT"},
        {"usb:gud,mode=0x240", "WIDTHxHEIGHT"},
        {"usb:gud,lz4=2", "0 or 1"},
        {"usb:gud,wait=0", "seconds"},
        {"usb:gud,timeout=0", "ms"},
        {"usb:gud,brightness=256", "1 to 255"},
        {"usb:gud,clock=40M", "unknown part 'clock'"},
        {"usb:ax206,lz4=1", "unknown part 'lz4'"},
        {"usb:ax206,mode=320x240", "unknown part 'mode'"},
        {"spi:/dev/spidev0.0", "no panel="},
        {"spi:/dev/spidev0.0,panel=ili9341", "no dc=CHIP:LINE"},
        {"spi:spidev0.0,panel=ili9341,dc=gpiochip0:1", "'spidev0.0' is no device"},
        {"spi:,panel=ili9341,dc=gpiochip0:1", "'' is no device"},
        {"spi:/dev/spidev0.0,panel=ili9342", "'ili9342'"},
        {"spi:/dev/spidev0.0,panel=ili9341,dc=25", "dc=25: wants CHIP:LINE"},
        {"spi:/dev/spidev0.0,panel=ili9341,dc=:25", "dc=:25"},
        {"spi:/dev/spidev0.0,panel=ili9341,dc=gpiochip0:", "dc=gpiochip0:"},
        {"spi:/dev/spidev0.0,panel=ili9341,dc=gpiochip0:x", "dc=gpiochip0:x"},
        {"spi:/dev/spidev0.0,panel=ili9341,dc=gpiochip0:65536", "dc=gpiochip0:65536"},
        {"spi:/dev/spidev0.0,panel=ili9341,dc=gpiochip0:1:high", "dc=gpiochip0:1:high"},
        {"spi:/dev/spidev0.0,panel=ili9341,dc=gpiochip0:1,mode=4", "0 to 3"},
        {"spi:/dev/spidev0.0,panel=ili9341,dc=gpiochip0:1,worker=2", "0 or 1"},
        {"spi:/dev/spidev0.0,bgr=1,panel=ili9341,dc=gpiochip0:1", "name the panel before"},
        {"spi:/dev/spidev0.0,panel=ili9341,dc=gpiochip0:1,mcu=rp2040", "unknown part 'mcu'"},
    };
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        target_config_t config;
        sim_error_t error = {""};
        assert_int_equal(target_parse(&config, cases[i][0], &error), -1);
        if (!strstr(error.text, cases[i][1]) || !strstr(error.text, "--display ")) { fail_msg("%s: %s", cases[i][0], error.text); }
    }
}

static void a_text_names_a_panel_on_spidev_and_its_lines(void **state) {
    target_config_t config;
    sim_error_t error = {""};
    (void)state;
    assert_int_equal(target_parse(&config,
                                  "spi:/dev/spidev1.0,panel=ili9341,dc=gpiochip0:25,rst=/dev/gpiochip4:7:low,clock=62.5M,mode=3,"
                                  "te=gpiochip0:24,worker=0,bgr=0",
                                  &error),
                     0);
    assert_int_equal(config.kind, TARGET_SPI);
    assert_string_equal(config.device, "/dev/spidev1.0");
    assert_string_equal(config.panel.name, "ili9341");
    assert_int_equal(config.panel.rotation_base, 0);
    assert_string_equal(config.dc.chip, "gpiochip0");
    assert_int_equal(config.dc.offset, 25);
    assert_false(config.dc.active_low);
    assert_string_equal(config.reset.chip, "/dev/gpiochip4");
    assert_int_equal(config.reset.offset, 7);
    assert_true(config.reset.active_low);
    assert_string_equal(config.backlight.chip, "");
    assert_string_equal(config.tearing.chip, "gpiochip0");
    assert_true(config.tearing_timeout_ms > 33); /* panels refresh at 30 Hz and more */
    assert_int_equal(config.clock_hz, 62500000);
    assert_int_equal(config.mode, 3);
    assert_true(config.no_worker);
}

static void a_text_names_a_display_on_usb(void **state) {
    target_config_t config;
    sim_error_t error = {""};
    (void)state;
    assert_int_equal(target_parse(&config, "usb:gud,serial=A 1-b,mode=320x240,lz4=0,wait=2,timeout=50,brightness=9", &error), 0);
    assert_int_equal(config.kind, TARGET_GUD);
    assert_string_equal(config.serial, "A 1-b");
    assert_int_equal(config.mode_width, 320);
    assert_int_equal(config.mode_height, 240);
    assert_true(config.no_compression);
    assert_int_equal(config.wait_ms, 2000);
    assert_int_equal(config.timeout_ms, 50);
    assert_int_equal(config.brightness, 9);
    assert_int_equal(target_parse(&config, "usb:ax206", &error), 0);
    assert_int_equal(config.kind, TARGET_AX206);
    assert_string_equal(config.serial, "");
}

static void a_text_that_is_too_long_is_told_and_not_cut(void **state) {
    char text[300];
    target_config_t config;
    sim_error_t error = {""};
    (void)state;
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    memcpy(text, "sim:ili9341,clock=", 18);
    assert_int_equal(target_parse(&config, text, &error), -1);
    assert_non_null(strstr(error.text, "longer than 255"));
}

/* ---- clocks ------------------------------------------------------------------------------------------------------- */

static void controllers_make_the_nearest_clock_that_is_not_faster(void **state) {
    static const struct {
        const char *mcu;
        uint32_t asked_hz, hz;
    } cases[] = {
        {"rp2040", 62500000, 62500000}, /* 125 MHz / 2, the fastest */
        {"rp2040", 1000000000, 62500000},
        {"rp2040", 62499999, 31250000},
        {"rp2040", 40000000, 31250000},
        {"rp2040", 16000000, 15625000}, /* asked for 16, gets 15.6 */
        {"rp2040", 1, 244140},          /* 125 MHz / 512 */
        {"stm32f4", 62500000, 50000000},
        {"stm32f4", 40000000, 25000000},
        {"stm32f4", 1, 390625},
        {"esp32", 80000000, 80000000},
        {"esp32", 62500000, 40000000},
        {"esp32", 30000000, 26666666},
        {"atmega328p", 10000000, 8000000},
        {"atmega328p", 3999999, 2000000},
        {"atmega328p", 1, 125000},
    };
    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        const sim_mcu_t *mcu = sim_mcu_find(cases[i].mcu);
        assert_non_null(mcu);
        assert_int_equal(sim_mcu_clock(mcu, cases[i].asked_hz), cases[i].hz);
    }
    /* A clock that is made is made again when it is asked for. */
    for (size_t i = 0; i < sim_mcu_count; i++) {
        for (uint32_t hz = 1000000; hz < 80000000; hz += 777777) {
            const uint32_t made = sim_mcu_clock(&sim_mcus[i], hz);
            assert_true(made <= hz);
            assert_int_equal(sim_mcu_clock(&sim_mcus[i], made), made);
        }
    }
}

static void a_frame_takes_the_bits_at_the_real_clock(void **state) {
    static uint8_t frame[153600];
    target_t target;
    target_config_t config;
    sim_error_t error = {""};
    uint64_t bytes, frame_ns;
    (void)state;
    assert_int_equal(target_parse(&config, "sim:ili9341,clock=40M,mcu=rp2040", &error), 0);
    assert_int_equal(target_open(&target, &config, 0, TUILE_WIRE_DEFAULT, &error), 0);
    assert_int_equal(tuile_display_present(&target.display), 0);
    target_begin_frame(&target);
    assert_int_equal(tuile_display_window(&target.display, 0, 0, 240, 320), 0);
    assert_int_equal(tuile_display_write(&target.display, frame, sizeof frame), 0);
    assert_int_equal(tuile_display_present(&target.display), 0);
    target_frame_figures(&target, &bytes, &frame_ns);
    assert_int_equal(bytes, 153600 + 11);
    /* 125 MHz / 4 = 32 ns a bit; commands at 125 MHz / 14 = 8928571 Hz: 40, 40 and 8 bits, each rounded up; and 430 cycles of 8 ns
     * of the driver for each of three commands and the pixels */
    assert_int_equal(frame_ns, 153600ull * 8 * 32 + 4481 + 4481 + 897 + 4 * 3440);
    target_close(&target);
    target_close(&target); /* once more does nothing */
}

/* ---- the card ----------------------------------------------------------------------------------------------------- */

typedef struct card_set {
    uint8_t *bytes;
    tuile_font_t font;
} card_set_t;

static int set_up(void **state) {
    static card_set_t set;
    size_t size_bytes;
    *state = &set;
    return font_load(NULL, &set.bytes, &size_bytes, NULL) || tuile_font_open(&set.font, set.bytes, size_bytes);
}

static int tear_down(void **state) {
    free(((card_set_t *)*state)->bytes);
    return 0;
}

static const tuile_scene_t nothing = {
    .camera = {.focal_x = TUILE_Q16(100),
               .focal_y = TUILE_Q16(100),
               .near = TUILE_Q16(1),
               .far = TUILE_Q16(2),
               .rotation = {{TUILE_ONE_Q30, 0, 0}, {0, TUILE_ONE_Q30, 0}, {0, 0, TUILE_ONE_Q30}}}};

/* The card by the frame loop on the display; and the same tiles decoded without one. */
static void draw_both(const card_set_t *set, target_t *target, uint16_t tile_width, uint16_t tile_height, sim_picture_t *decoded) {
    card_t card = {&set->font, "card", target->config.panel.round != 0};
    tuile_config_t config = {.width = target->display.width,
                             .height = target->display.height,
                             .tile_width = tile_width,
                             .tile_height = tile_height,
                             .format = tuile_stream_format(&target->display)};
    tuile_t *renderer;
    tuile_tile_t tile;
    static _Alignas(8) uint8_t block[1 << 20];
    config.overlay = card_draw;
    config.overlay_context = &card;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
    assert_int_equal(tuile_stream_frame(renderer, &nothing, &target->display, NULL), 0);
    assert_string_equal(target_detail(target), "");
    assert_int_equal(sim_picture_create(decoded, config.width, config.height, NULL), 0);
    assert_int_equal(tuile_begin(renderer, &nothing), 0);
    while (tuile_next(renderer, &tile) == 1) {
        assert_int_equal(wire_paste(decoded, config.format, &tile, NULL), 0);
    }
    assert_int_equal(tuile_end(renderer, NULL), 0);
}

/* Bits of red, green and blue that a format carries. */
static void format_bits(uint8_t wire, unsigned bits[3]) {
    static const unsigned table[TUILE_WIRE_COUNT][3] = {
        [TUILE_WIRE_RGB565] = {5, 6, 5},     [TUILE_WIRE_RGB444] = {4, 4, 4},
        [TUILE_WIRE_RGB666] = {6, 6, 6},     [TUILE_WIRE_GREY4] = {4, 4, 4},
        [TUILE_WIRE_MONO_PAGES] = {1, 1, 1}, [TUILE_WIRE_GREY4_TURNED] = {4, 4, 4},
        [TUILE_WIRE_RGB111] = {1, 1, 1},     [TUILE_WIRE_MONO_PAGES_TURNED] = {1, 1, 1},
    };
    memcpy(bits, table[wire], sizeof table[wire]);
    assert_true(bits[0] > 0);
}

static bool in_circle(const sim_picture_t *picture, uint32_t x, uint32_t y) {
    const int64_t dx = 2 * (int64_t)x + 1 - picture->width, dy = 2 * (int64_t)y + 1 - picture->height;
    return dx * dx + dy * dy <= (int64_t)picture->width * picture->width;
}

static void check_seen(const target_t *target, const sim_picture_t *seen, const sim_picture_t *decoded) {
    unsigned bits[3];
    format_bits(target->display.wire, bits);
    assert_int_equal(seen->width, decoded->width);
    assert_int_equal(seen->height, decoded->height);
    for (uint32_t y = 0; y < seen->height; y++) {
        for (uint32_t x = 0; x < seen->width; x++) {
            const uint8_t *a = sim_picture_at(seen, x, y), *b = sim_picture_at(decoded, x, y);
            if (target->config.panel.round && !in_circle(seen, x, y)) { continue; }
            for (unsigned c = 0; c < 3; c++) {
                if (a[c] >> (8 - bits[c]) != b[c] >> (8 - bits[c])) {
                    fail_msg("%s, rotation %u, wire %u, pixel %u,%u: %02x%02x%02x, not %02x%02x%02x", target->config.panel.name,
                             target->rotation, target->display.wire, x, y, a[0], a[1], a[2], b[0], b[1], b[2]);
                }
            }
        }
    }
}

static void every_panel_shows_the_card_in_every_rotation_and_format(void **state) {
    unsigned shown = 0;
    for (size_t i = 0; i < sim_panel_count; i++) {
        const tuile_panel_t *panel = sim_panels[i].panel;
        for (unsigned turn = 0; turn < 4u * panel->format_count; turn++) {
            target_t target;
            target_config_t config;
            sim_error_t error = {""};
            sim_picture_t seen = {0}, decoded = {0};
            assert_int_equal(target_parse_panel(&config, panel->name, &error), 0);
            if (target_open(&target, &config, (uint8_t)(turn % 4), panel->formats[turn / 4].wire, &error) != 0) {
                fail_msg("%s: %s", panel->name, error.text);
            }
            const tuile_display_t *display = &target.display;
            const unsigned rows = 3u * (display->align_y < 8 ? 8u : display->align_y);
            const bool narrow = turn % 2 != 0; /* tiles of part of a row, too */
            const uint32_t half = display->width / 2u / display->align_x * display->align_x;
            draw_both(*state, &target, (uint16_t)(narrow ? half : 0u), (uint16_t)rows, &decoded);
            assert_int_equal(target_picture(&target, &seen, NULL, &error), 0);
            check_seen(&target, &seen, &decoded);
            sim_picture_free(&seen);
            sim_picture_free(&decoded);
            target_close(&target);
            shown++;
        }
    }
    assert_true(shown >= 8);
}

static void check_colour(const sim_picture_t *picture, int32_t x, int32_t y, unsigned red, unsigned green, unsigned blue) {
    const uint8_t *p = sim_picture_at(picture, (uint32_t)x, (uint32_t)y);
    if (p[0] != red || p[1] != green || p[2] != blue) { fail_msg("pixel %d,%d is %02x%02x%02x", (int)x, (int)y, p[0], p[1], p[2]); }
}

/* By hand, on the ILI9341: what a person would look for. */
static void the_card_tells_up_from_down_and_red_from_blue(void **state) {
    for (uint8_t rotation = 0; rotation < 4; rotation++) {
        target_t target;
        target_config_t config;
        sim_error_t error = {""};
        sim_picture_t seen = {0}, decoded = {0};
        const card_t card = {&((card_set_t *)*state)->font, NULL, false};
        assert_int_equal(target_parse_panel(&config, "ili9341", &error), 0);
        assert_int_equal(target_open(&target, &config, rotation, TUILE_WIRE_DEFAULT, &error), 0);
        draw_both(*state, &target, 0, 24, &decoded);
        assert_int_equal(target_picture(&target, &seen, NULL, &error), 0);
        const int32_t w = (int32_t)seen.width, h = (int32_t)seen.height;
        const card_layout_t l = card_layout(&card, (uint16_t)w, (uint16_t)h);
        for (int32_t x = 0; x < w; x++) { /* the border, and nothing beside it but the names */
            check_colour(&seen, x, 0, 255, 255, 255);
            check_colour(&seen, x, h - 1, 255, 255, 255);
            if (x > 0 && x < w - 1) { check_colour(&seen, x, 1, 0, 0, 0); }
        }
        for (int32_t y = 0; y < h; y++) {
            check_colour(&seen, 0, y, 255, 255, 255);
            check_colour(&seen, w - 1, y, 255, 255, 255);
        }
        const int32_t bar = (l.bars.right - l.bars.left) / 3, bars_y = (l.bars.top + l.bars.bottom) / 2;
        check_colour(&seen, l.bars.left + bar / 2, bars_y, 255, 0, 0);
        check_colour(&seen, l.bars.left + bar + bar / 2, bars_y, 0, 255, 0);
        check_colour(&seen, l.bars.left + 2 * bar + bar / 2, bars_y, 0, 0, 255);
        check_colour(&seen, l.ramp.left + 1, l.ramp.top + 1, 0, 0, 0);
        check_colour(&seen, l.ramp.right - 1, l.ramp.top + 1, 255, 255, 255);
        /* The arrow is wider in the middle than at its tip, and its shaft is narrow. */
        const int32_t middle = w / 2, quarter = (l.arrow.right - l.arrow.left) / 4;
        check_colour(&seen, middle, l.arrow.top + 2, 255, 255, 255);
        check_colour(&seen, middle + quarter, l.arrow.top + 2, 0, 0, 0);
        check_colour(&seen, middle + quarter, (l.arrow.top + l.arrow.bottom) / 2 - 2, 255, 255, 255);
        check_colour(&seen, middle + quarter, l.arrow.bottom - 2, 0, 0, 0);
        check_colour(&seen, middle, l.arrow.bottom - 2, 255, 255, 255);
        sim_picture_free(&seen);
        sim_picture_free(&decoded);
        target_close(&target);
    }
}

/* On the smallest windows nothing of it lies over anything else. */
static void the_card_has_room_on_every_panel(void **state) {
    const card_set_t *set = *state;
    for (size_t i = 0; i < sim_panel_count; i++) {
        for (unsigned turn = 0; turn < 2; turn++) {
            const tuile_panel_t *panel = sim_panels[i].panel;
            const card_t card = {&set->font, NULL, panel->round != 0};
            const uint16_t w = turn ? panel->view_height : panel->view_width, h = turn ? panel->view_width : panel->view_height;
            const card_layout_t l = card_layout(&card, w, h);
            const tuile_box_t names[4] = {
                {l.inset_x, l.inset_y, l.inset_x + 12, l.inset_y + 10},
                {w - l.inset_x - 12, l.inset_y, w - l.inset_x, l.inset_y + 10},
                {l.inset_x, h - l.inset_y - 10, l.inset_x + 12, h - l.inset_y},
                {w - l.inset_x - 12, h - l.inset_y - 10, w - l.inset_x, h - l.inset_y},
            };
            const tuile_box_t boxes[7] = {l.arrow, l.bars, l.ramp, names[0], names[1], names[2], names[3]};
            for (unsigned a = 0; a < 7; a++) {
                const tuile_box_t *p = &boxes[a];
                if (p->left < 1 || p->top < 1 || p->right > w - 1 || p->bottom > h - 1 || p->right - p->left < 6 ||
                    p->bottom - p->top < 6) {
                    fail_msg("%s, turned %u: part %u is %d,%d to %d,%d", panel->name, turn, a, p->left, p->top, p->right,
                             p->bottom);
                }
                for (unsigned b = 0; b < a; b++) {
                    const tuile_box_t *q = &boxes[b];
                    if (p->left < q->right && q->left < p->right && p->top < q->bottom && q->top < p->bottom) {
                        fail_msg("%s, turned %u: parts %u and %u overlap", panel->name, turn, a, b);
                    }
                }
            }
        }
    }
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_text_names_a_panel_and_what_is_changed_of_it),
        cmocka_unit_test(what_is_wrong_in_a_text_is_named),
        cmocka_unit_test(a_text_names_a_panel_on_spidev_and_its_lines),
        cmocka_unit_test(a_text_names_a_display_on_usb),
        cmocka_unit_test(a_text_that_is_too_long_is_told_and_not_cut),
        cmocka_unit_test(controllers_make_the_nearest_clock_that_is_not_faster),
        cmocka_unit_test(a_frame_takes_the_bits_at_the_real_clock),
        cmocka_unit_test(every_panel_shows_the_card_in_every_rotation_and_format),
        cmocka_unit_test(the_card_tells_up_from_down_and_red_from_blue),
        cmocka_unit_test(the_card_has_room_on_every_panel),
    };
    return cmocka_run_group_tests_name("target", tests, set_up, tear_down);
}
