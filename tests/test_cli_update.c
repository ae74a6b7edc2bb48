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

/* Both ways; the pictures must be the same. Returns how many times less is on the wire, and gets that of the time. */
static double gain(const char *scene, double *time) {
    char line[512];
    double bytes[2], ns[2];
    char *hashes[2];
    for (unsigned i = 0; i < 2; i++) {
        (void)snprintf(line, sizeof line, "render %s --hash --report @/r.json %s", scene, i ? "--update 16" : "");
        hashes[i] = cli_good(line);
        bytes[i] = sum_of("r.json", "\"wire_bytes\": ");
        cli_good_silent(line);
        ns[i] = sum_of("r.json", "\"wire_ns\": ");
    }
    for (const char *a = hashes[0], *b = hashes[1]; strncmp(a, "frame ", 6) == 0;
         a = strchr(a, '\n') + 1, b = strchr(b, '\n') + 1) {
        if (strncmp(a, b, (size_t)(strchr(a, '\n') - a)) != 0) { fail_msg("%s: not the same pictures", scene); }
    }
    free(hashes[0]);
    free(hashes[1]);
    *time = ns[0] / ns[1];
    return bytes[0] / bytes[1];
}

static void a_turning_object_with_text_and_a_dial_sends_half_or_less(void **state) {
    double time;
    (void)state;
    const double bytes =
        gain("@/torus.obj --frames 12 --shade gouraud --overlay-text 8,8,Tuile --gauge 40,280,30,50 --tile 240x16", &time);
    assert_true(bytes >= 1.9);
    assert_true(time >= 1.9);
}

static void a_flight_costs_a_hundredth_more_at_most(void **state) {
    double time;
    (void)state;
    assert_true(
        gain("@/room.obj --frames 12 --shade gouraud --eye 0.5,1.2,1 --at 0,1,0 --fov 90 --point-light 0.6,1.4,0.5,5,ffc080 "
             "--tile 240x16",
             &time) >= 1 / 1.01);
    assert_true(time >= 1 / 1.01);
}

static void any_panel_takes_updates(void **state) {
    double time;
    (void)state;
    assert_true(gain("@/octahedron.obj --frames 6 --panel ssd1306-128x64 --rotate 90", &time) > 0.99);
    assert_true(gain("@/octahedron.obj --frames 6 --panel ssd1322 --rotate 270", &time) > 0.99);
    assert_true(gain("@/octahedron.obj --frames 6 --display sim:st7789-135x240,mcu=rp2040,bgr=1 --format rgb444", &time) > 0.99);
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
        cmocka_unit_test(a_flight_costs_a_hundredth_more_at_most),
        cmocka_unit_test(any_panel_takes_updates),
        cmocka_unit_test(what_does_not_go_together_is_told),
        cmocka_unit_test(several_displays_show_the_card_each_its_own),
        cmocka_unit_test(a_clock_above_the_rating_is_noted),
    };
    return cmocka_run_group_tests_name("cli update", tests, cli_set_up, cli_tear_down);
}
