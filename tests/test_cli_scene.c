/* tuile scene, as a user meets it. */
#include "support/check.h"
#include "support/cli.h"

#include "../sim/picture.h"

#include <unistd.h>

/* The folder with the compiled models of cube and room. */
static int set_up(void **state) {
    if (cli_set_up(state) != 0) { return -1; }
    cli_good_silent("mesh firmware/models/cube.obj --tree -o @/cube.tuile");
    cli_good_silent("mesh tests/models/room.obj --tree -o @/room.tuile");
    return 0;
}

static void without_a_name_the_scenes_are_listed(void **state) {
    char *out = cli_good("scene");
    (void)state;
    assert_non_null(strstr(out, "cube "));
    assert_non_null(strstr(out, "room "));
    assert_non_null(strstr(out, "spider "));
    assert_non_null(strstr(out, "turning; zbuffer, scanline, warnock, painter\n"));
    assert_non_null(strstr(out, "turning; zbuffer, scanline, warnock, painter, tree\n"));
    free(out);
}

static void frames_have_numbers_and_hashes(void **state) {
    char *all = cli_good("scene room --models @ --panel ssd0323 --rotate 180 --frames 4 --hash");
    char *last = cli_good("scene room --models @ --panel ssd0323 --rotate 180 --first 3 --hash --method tree --memory 10K");
    (void)state;
    assert_non_null(strstr(all, "frame 0 "));
    assert_non_null(strstr(all, last));
    assert_int_equal(strncmp(last, "frame 3 ", 8), 0);
    free(all);
    free(last);
}

static void pictures_are_of_the_panel_s_size(void **state) {
    sim_picture_t picture;
    (void)state;
    cli_good_silent("scene cube --models @ --panel ssd0323 --rotate 90 --frames 2 --out @/cube-%d.ppm");
    assert_int_equal(sim_picture_read(&picture, cli_path("cube-1.ppm"), NULL), 0);
    assert_int_equal(picture.width, 64);
    assert_int_equal(picture.height, 128);
    sim_picture_free(&picture);
    (void)unlink(cli_path("cube-0.ppm"));
    (void)unlink(cli_path("cube-1.ppm"));
}

static void phases_lie_between_frames(void **state) {
    char *frame = cli_good("scene cube --models @ --first 5 --hash"),
         *phase = cli_good("scene cube --models @ --phase 10240 --hash");
    char *between = cli_good("scene cube --models @ --phase 11264 --hash"),
         *next = cli_good("scene cube --models @ --first 6 --hash");
    (void)state;
    assert_string_equal(strrchr(frame, ' '), strrchr(phase, ' ')); /* a period of 32: 5 * 65536 / 32 */
    assert_string_not_equal(strrchr(between, ' '), strrchr(phase, ' '));
    assert_string_not_equal(strrchr(between, ' '), strrchr(next, ' '));
    free(frame);
    free(phase);
    free(between);
    free(next);
}

/* The corners are black where text may be and white in it, whatever the room shows there; all else is as it was. The font has 6 by
 * 10 dots. */
static void captions_lie_in_the_corners(void **state) {
    static const struct {
        const char *options;
        unsigned left, right; /* characters in either corner */
    } cases[] = {
        {"--show-rate 0", 8, 0}, {"--show-rate 12.3", 8, 0}, {"--show-rate 999.9 --show-method", 9, 7}, {"--show-method", 0, 7}};
    sim_picture_t plain;
    (void)state;
    cli_good_silent("scene room --models @ --panel ssd0323 --out @/plain.ppm");
    assert_int_equal(sim_picture_read(&plain, cli_path("plain.ppm"), NULL), 0);
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        char line[200];
        sim_picture_t picture;
        unsigned white[2] = {0, 0};
        (void)snprintf(line, sizeof line, "scene room --models @ --panel ssd0323 --out @/caption.ppm %s", cases[i].options);
        cli_good_silent(line);
        assert_int_equal(sim_picture_read(&picture, cli_path("caption.ppm"), NULL), 0);
        for (unsigned y = 0; y < picture.height; y++) {
            for (unsigned x = 0; x < picture.width; x++) {
                const uint8_t *seen = picture.rgb + 3u * (y * picture.width + x), *was = plain.rgb + 3u * (y * picture.width + x);
                const bool left = y < 10 && x < 6 * cases[i].left, right = y < 10 && x >= picture.width - 6 * cases[i].right;
                assert_true(left || right ? seen[0] == 0 || seen[0] == 255 : memcmp(seen, was, 3) == 0);
                if (left || right) { white[right] += seen[0] == 255; }
            }
        }
        assert_int_equal(white[0] > 40, cases[i].left > 0);
        assert_int_equal(white[1] > 40, cases[i].right > 0);
        sim_picture_free(&picture);
    }
    sim_picture_free(&plain);
    (void)unlink(cli_path("plain.ppm"));
    (void)unlink(cli_path("caption.ppm"));
}

static void a_model_of_one_s_own_is_a_scene(void **state) {
    char *own = cli_good("scene model --model @/torus.obj --hash"),
         *tree = cli_good("scene model --model @/cube.obj --method tree --hash");
    (void)state;
    assert_non_null(strstr(own, "frame 0 "));
    assert_non_null(strstr(tree, "frame 0 "));
    free(own);
    free(tree);
}

/* The number behind a text, which must be there. */
static unsigned long number_behind(const char *out, const char *text) {
    const char *at = strstr(out, text);
    if (!at) { fail_msg("no \"%s\" in: %s", text, out); }
    return strtoul(at + strlen(text), NULL, 10);
}

/* 128 x 64 pixels of 4 bits are 4096 bytes. */
static void what_has_changed_is_sent_and_told(void **state) {
    char *whole = cli_good("scene cube --models @ --panel ssd0323 --frames 4 --tile 128x16 --out @/whole-%d.ppm");
    char *less = cli_good("scene cube --models @ --panel ssd0323 --frames 4 --tile 128x16 --update 16 --out @/less-%d.ppm");
    (void)state;
    const unsigned long sent = number_behind(less, "update: after the first frame ");
    assert_int_equal(number_behind(less, " of "), 3 * 4096);
    assert_in_range(sent, 3 * 128, 2 * 4096);
    assert_true(number_behind(less, "wire: after the first frame ") > sent);
    assert_true(number_behind(less, "wire: after the first frame ") < number_behind(whole, "wire: after the first frame "));
    assert_true(number_behind(whole, "wire: after the first frame ") > 3 * 4096);
    assert_null(strstr(whole, "update:"));
    for (unsigned i = 0; i < 4; i++) {
        char name[2][32];
        sim_picture_t pictures[2];
        for (unsigned k = 0; k < 2; k++) {
            (void)snprintf(name[k], sizeof name[k], "%s-%u.ppm", k ? "less" : "whole", i);
            assert_int_equal(sim_picture_read(&pictures[k], cli_path(name[k]), NULL), 0);
            (void)unlink(cli_path(name[k]));
        }
        assert_memory_equal(pictures[0].rgb, pictures[1].rgb, 3u * 128 * 64);
        sim_picture_free(&pictures[0]);
        sim_picture_free(&pictures[1]);
    }
    free(whole);
    free(less);
    cli_fails("scene cube --models @ --update 12", "--update", "8");
    cli_fails("scene cube --models @ --update-full 4", "--update-full", "--update");
}

static void another_model_takes_the_place_of_the_scene_s(void **state) {
    char *own = cli_good("scene cube --model @/torus.obj --hash"), *cube = cli_good("scene cube --models @ --hash");
    (void)state;
    assert_string_not_equal(own, cube);
    free(own);
    free(cube);
}

static void wrong_scenes_are_told(void **state) {
    (void)state;
    cli_fails("scene castle", "castle", "tuile scene");
    cli_fails("scene cube room", "cube", "room");
    cli_fails("scene spider --method tree", "--method tree", "spider");
    cli_fails("scene spider --models @", "spider.tuile", "firmware-models");
    cli_fails("scene cube --models @ --memory 1K", "--memory", "1024");
    cli_fails("scene cube --models @ --panel vt100", "vt100", NULL);
    cli_fails("scene cube --models @ --phase 65536", "--phase", "65535");
    cli_fails("scene cube --models @ --phase 1 --frames 2", "--phase", "2");
    cli_fails("scene cube --models @ --show-rate 1000", "--show-rate", "999.9");
    cli_fails("scene model", "--model", "model");
    cli_fails("scene model --model @/none.obj", "none.obj", NULL);
    cli_fails("scene cube --models @ --frames 0", "--frames", NULL);
    cli_fails("scene cube --models @ --frames 2 --out @/x.png", "--out", NULL);
    cli_fails("scene cube --models @ --colour red", "--colour", NULL);
    cli_fails("scene cube --models @ --panel ssd0323 --format rgb565be", "--format", "ssd0323");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_name_the_scenes_are_listed),
        cmocka_unit_test(frames_have_numbers_and_hashes),
        cmocka_unit_test(pictures_are_of_the_panel_s_size),
        cmocka_unit_test(phases_lie_between_frames),
        cmocka_unit_test(captions_lie_in_the_corners),
        cmocka_unit_test(a_model_of_one_s_own_is_a_scene),
        cmocka_unit_test(what_has_changed_is_sent_and_told),
        cmocka_unit_test(another_model_takes_the_place_of_the_scene_s),
        cmocka_unit_test(wrong_scenes_are_told),
    };
    return cmocka_run_group_tests_name("cli_scene", tests, set_up, cli_tear_down);
}
