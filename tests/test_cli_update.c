/* tuile render --update and --display: what a user sees of frames of which only the changes are sent, and of displays by name. */
#include "support/check.h"
#include "support/cli.h"

#include <unistd.h>

/* The sum of a figure over all frames of a report but the first. */
static double sum_of(const char *report, const char *word) {
    char *text = command_read(cli_path(report), NULL), *at = text;
    double sum = 0;
    assert_non_null(text);
    for (unsigned frame = 0; (at = strstr(at, word)) != NULL; frame++, at++) {
        if (frame > 0) { sum += cli_number_after(at, word); }
    }
    free(text);
    (void)unlink(cli_path(report));
    return sum;
}

/* How many times less whole frames cost than updates. */
typedef struct gain {
    double bytes, wire, frame; /* on the wire; its time; the frame's as predicted, 0 without a microcontroller */
} gain_t;

/* Both ways; the pictures must be the same. */
static gain_t gain_of(const char *scene) {
    char line[512];
    double bytes[2], ns[2], frame[2];
    char *hashes[2];
    for (unsigned i = 0; i < 2; i++) {
        (void)snprintf(line, sizeof line, "render %s --hash --report @/r.json %s", scene, i ? "--update 16" : "");
        hashes[i] = cli_good(line);
        bytes[i] = sum_of("r.json", "\"wire_bytes\": ");
        cli_good_silent(line);
        ns[i] = sum_of("r.json", "\"wire_ns\": ");
        cli_good_silent(line);
        frame[i] = sum_of("r.json", "\"frame_ns\": ");
    }
    for (const char *a = hashes[0], *b = hashes[1]; strncmp(a, "frame ", 6) == 0;
         a = strchr(a, '\n') + 1, b = strchr(b, '\n') + 1) {
        if (strncmp(a, b, (size_t)(strchr(a, '\n') - a)) != 0) { fail_msg("%s: not the same pictures", scene); }
    }
    free(hashes[0]);
    free(hashes[1]);
    return (gain_t){bytes[0] / bytes[1], ns[0] / ns[1], frame[1] > 0 ? frame[0] / frame[1] : 0};
}

#define TURNING "@/torus.obj --frames 12 --shade gouraud --overlay-text 8,8,Tuile --gauge 40,280,30,50 --tile 240x16"
#define FLIGHT \
    "@/room.obj --frames 24 --shade gouraud --eye 0.5,1.2,1 --at 0,1,0 --fov 90 --point-light 0.6,1.4,0.5,5,ffc080 --tile 240x16"

static void a_turning_object_with_text_and_a_dial_sends_half_or_less(void **state) {
    (void)state;
    const gain_t gain = gain_of(TURNING);
    assert_true(gain.bytes >= 1.9);
    assert_true(gain.wire >= 1.9);
}

/* Where the wire binds, frames come as much faster as it has less to do, but for what is drawn before the first bytes are known; on
 * the slowest of these cores drawing binds then. */
static void the_predicted_frame_rate_rises_accordingly(void **state) {
    (void)state;
    static const struct {
        const char *mcu;
        double least;
    } cases[] = {{"rp2040", 1.5}, {"stm32f4", 1.9}, {"esp32", 1.9}, {"esp32c3", 1.9}};
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        char scene[256];
        (void)snprintf(scene, sizeof scene, TURNING " --mcu %s", cases[i].mcu);
        const gain_t gain = gain_of(scene);
        assert_true(gain.bytes >= 1.9);
        if (gain.frame < cases[i].least) { fail_msg("%s: frames come %.2f times as fast", cases[i].mcu, gain.frame); }
    }
}

/* So close that nearly every cell changes. Sums are made in two frames of 22. */
static void in_a_flight_frames_take_a_hundredth_longer_at_most(void **state) {
    (void)state;
    static const char *const mcus[] = {"rp2040", "stm32f4", "esp32", "esp32c3"};
    assert_non_null(getenv("BUNNY_6000"));
    for (size_t i = 0; i < CHECK_COUNT(mcus); i++) {
        char scene[512];
        (void)snprintf(
            scene, sizeof scene,
            "%s --frames 45 --spin 3 --shade gouraud --orbit 200,10,1.1 --at 0,-0.1,0 --near 0.05 --fov 40 --tile 240x16 --mcu %s",
            getenv("BUNNY_6000"), mcus[i]);
        const gain_t gain = gain_of(scene);
        assert_true(gain.bytes < 1.05);
        if (gain.frame < 1 / 1.01) { fail_msg("%s: frames take %.2f %% longer", mcus[i], 100 * (1 / gain.frame - 1)); }
    }
}

static void a_flight_costs_a_hundredth_more_at_most(void **state) {
    (void)state;
    const gain_t gain = gain_of(FLIGHT);
    assert_true(gain.bytes >= 1 / 1.01);
    assert_true(gain.wire >= 1 / 1.01);
}

static void any_panel_takes_updates(void **state) {
    (void)state;
    assert_true(gain_of("@/octahedron.obj --frames 6 --panel ssd1306-128x64 --rotate 90").bytes > 0.99);
    assert_true(gain_of("@/octahedron.obj --frames 6 --panel ssd1322 --rotate 270").bytes > 0.99);
    assert_true(gain_of("@/octahedron.obj --frames 6 --display sim:st7789-135x240,mcu=rp2040,bgr=1 --format rgb444").bytes > 0.99);
}

static void what_does_not_go_together_is_told(void **state) {
    (void)state;
    cli_fails("render @/cube.obj --update 12", "--update 12", "multiple of 8");
    cli_fails("render @/cube.obj --update 4", "--update", "out of range");
    cli_fails("render @/cube.obj --update-full 5", "--update-full", "--update");
    cli_fails("render @/cube.obj --panel ssd1306-128x64 --format rgb666", "--format rgb666", "ssd1306-128x64 takes mono-pages");
    cli_fails("render @/cube.obj --panel ssd1306-128x64 --tile 128x12", "--tile 128x12", "multiple");
    cli_fails("render @/cube.obj --panel ssd1322 --rotate 90 --tile 64x6", "--tile 64x6", "multiples of 1x4");
    cli_fails("render @/cube.obj --panel st7789-240x240 --size 100x100", "--size", "display");
    cli_fails("render @/cube.obj --display spi:/dev/spidev9.9,panel=ili9341,dc=gpiochip9:1", "/dev/spidev9.9", "No such file");
    cli_fails("card --display usb:gud", "usb:gud", "no GUD display is attached");
    cli_fails("card --display sim:ili9342", "ili9342", "tuile panels");
    cli_fails("card --out @/card-%d-%d.png", "--out", "only one number");
    cli_fails("card ili9341", "plain arguments", "ili9341");
    cli_fails("panels ili9341", "panels", "ili9341");
}

static void several_displays_show_the_card_each_its_own(void **state) {
    (void)state;
    cli_good_silent("card --display sim:ssd1306-128x64 --display sim:gc9a01 --out @/card-%d.png");
    assert_true(cli_exists("card-0.png"));
    assert_true(cli_exists("card-1.png"));
    (void)unlink(cli_path("card-0.png"));
    (void)unlink(cli_path("card-1.png"));
    cli_fails("card --display sim:ssd1306-128x64 --display sim:gc9a01 --out @/card.png", "--out", "2");
}

static void a_clock_above_the_rating_is_noted(void **state) {
    command_result_t result;
    (void)state;
    cli_shell(&result, "% card --panel ili9341 --clock 62.5M");
    assert_int_equal(result.code, 0);
    assert_non_null(strstr(result.err, "62500000 Hz; the data sheet promises 10000000"));
    command_free(&result);
    cli_shell(&result, "% card --panel ili9341 --clock 10M");
    assert_string_equal(result.err, "");
    command_free(&result);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_turning_object_with_text_and_a_dial_sends_half_or_less),
        cmocka_unit_test(the_predicted_frame_rate_rises_accordingly),
        cmocka_unit_test(in_a_flight_frames_take_a_hundredth_longer_at_most),
        cmocka_unit_test(a_flight_costs_a_hundredth_more_at_most),
        cmocka_unit_test(any_panel_takes_updates),
        cmocka_unit_test(what_does_not_go_together_is_told),
        cmocka_unit_test(several_displays_show_the_card_each_its_own),
        cmocka_unit_test(a_clock_above_the_rating_is_noted),
    };
    return cmocka_run_group_tests_name("cli update", tests, cli_set_up, cli_tear_down);
}
