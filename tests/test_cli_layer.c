/* tuile render --alpha, --blend, --edges, --line, --point and --sprite. */
#include "support/check.h"
#include "support/cli.h"
#include "support/images.h"

#include "../sim/picture.h"

#include <unistd.h>

#define AT "$(printf '\\100')" /* the sign itself: in a line for the shell it is the folder */

static const uint8_t *at(const sim_picture_t *picture, unsigned x, unsigned y) { return sim_picture_at(picture, x, y); }

static void put(const char *name, image_bytes_t bytes) {
    command_write(cli_path(name), bytes.at, bytes.size);
    free(bytes.at);
}

static void draw(sim_picture_t *picture, const char *options) {
    char line[400];
    (void)snprintf(line, sizeof line, "render @/cube.obj --eye 0,0,8 --at 0,0,0 --out @/seen.png %s", options);
    cli_good_silent(line);
    assert_int_equal(sim_picture_read(picture, cli_path("seen.png"), NULL), 0);
    (void)unlink(cli_path("seen.png"));
}

static void alpha_lets_the_background_through(void **state) {
    sim_picture_t opaque = {0}, half = {0}, added = {0}, none = {0};
    (void)state;
    draw(&opaque, "--background 0000ff");
    draw(&half, "--background 0000ff --alpha 128");
    draw(&added, "--background 0000ff --alpha 128 --blend add");
    draw(&none, "--background 0000ff --alpha 0");
    const uint8_t *o = at(&opaque, 120, 160), *h = at(&half, 120, 160), *a = at(&added, 120, 160), *n = at(&none, 120, 160);
    assert_in_range(h[0], o[0] / 2 - 6, o[0] / 2 + 6); /* half of it; panel colours are steps of 8 */
    assert_in_range(h[2], (o[2] + 255) / 2 - 6, (o[2] + 255) / 2 + 6);
    assert_in_range(a[0], o[0] / 2 - 6, o[0] / 2 + 6);
    assert_int_equal(a[2], 255);
    assert_int_equal(n[0], 0);
    assert_int_equal(n[2], 255);
    sim_picture_free(&opaque);
    sim_picture_free(&half);
    sim_picture_free(&added);
    sim_picture_free(&none);
}

static void lines_and_points_stand_before_and_behind_faces(void **state) {
    sim_picture_t picture = {0};
    (void)state;
    /* In front of the cube, which reaches from -1 to 1, and behind it. The line is 6.8 units off and so 0.05 * 386 / 6.8 = 2.84
     * pixels above the middle. */
    draw(&picture, "--line=-3,0.05,1.2,3,0.05,1.2,00ff00 --point 0,0.5,1.2,9,ff0000 --point 0,-0.5,-1.2,9,0000ff");
    assert_int_equal(at(&picture, 120, 157)[1], 255);
    assert_int_equal(at(&picture, 120, 157)[0], 0);
    unsigned red = 0, blue = 0;
    for (unsigned i = 0; i < 240 * 320; i++) {
        const uint8_t *p = at(&picture, i % 240, i / 240);
        red += p[0] == 255 && p[1] == 0;
        blue += p[2] == 255 && p[1] == 0;
    }
    assert_in_range(red, 55, 75); /* a disc of 9 pixels: 63.6 */
    assert_int_equal(blue, 0);
    sim_picture_free(&picture);
}

static void edges_have_their_colour(void **state) {
    static const char *const kinds[] = {"all", "front", "hidden", "outline"};
    (void)state;
    for (unsigned k = 0; k < CHECK_COUNT(kinds); k++) {
        sim_picture_t picture = {0};
        char line[80];
        unsigned red = 0, others = 0;
        (void)snprintf(line, sizeof line, "--edges %s --edge-colour ff0000", kinds[k]);
        draw(&picture, line);
        for (unsigned i = 0; i < 240 * 320; i++) {
            const uint8_t *p = at(&picture, i % 240, i / 240);
            red += p[0] == 255 && p[1] == 0;
            others += p[1] != 0;
        }
        assert_true(red > 200);
        assert_int_equal(others != 0, k == 3); /* the outline alone has faces within */
        sim_picture_free(&picture);
    }
}

/* Red, green, a blue that half of shines through, and nothing. */
static void put_quarters(void) {
    static const uint8_t pixels[4][4] = {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 128}, {255, 255, 255, 0}};
    put("quarters.png", images_png_rgb(2, 2, pixels[0], true));
}

/* Its middle on the axis, 6.8 units off: 0.6 units are 0.6 * 386 / 6.8 = 34 pixels, and the middles of its quarters 8.5 from its
 * own. */
static void sprites_stand_before_faces_with_their_alpha(void **state) {
    sim_picture_t plain = {0}, front = {0}, back = {0};
    (void)state;
    put_quarters();
    draw(&plain, "");
    draw(&front, "--sprite @/quarters.png" AT "0,0,1.2,0.6,0.6");
    draw(&back, "--sprite @/quarters.png" AT "0,0,-1.2,0.6,0.6 --eye 0,0,-8"); /* it faces any camera */
    const sim_picture_t *const pictures[] = {&front, &back};
    for (unsigned i = 0; i < 2; i++) {
        static const uint8_t red[3] = {255, 0, 0}, green[3] = {0, 255, 0};
        assert_memory_equal(at(pictures[i], 112, 152), red, 3);
        assert_memory_equal(at(pictures[i], 128, 152), green, 3);
    }
    const uint8_t *face = at(&plain, 112, 168), *half = at(&front, 112, 168);
    assert_true(face[0] > 30);
    assert_in_range(half[0], face[0] * 7 / 15 - 8, face[0] * 7 / 15 + 8); /* 8/15 of blue over it; steps of 8 */
    assert_in_range(half[2], (255 * 8 + face[2] * 7) / 15 - 8, (255 * 8 + face[2] * 7) / 15 + 8);
    assert_memory_equal(at(&front, 128, 168), at(&plain, 128, 168), 3);
    assert_memory_equal(at(&front, 101, 152), at(&plain, 101, 152), 3); /* beyond its side */
    sim_picture_free(&plain);
    sim_picture_free(&front);
    sim_picture_free(&back);
}

/* 9.2 units off, 4 units are 168 pixels; the cube hides the 110 in the middle. */
static void sprites_stand_behind_faces(void **state) {
    static const uint8_t red[3] = {255, 0, 0};
    sim_picture_t plain = {0}, hidden = {0}, wide = {0};
    (void)state;
    put_quarters();
    draw(&plain, "");
    draw(&hidden, "--sprite @/quarters.png" AT "0,0,-1.2,0.6,0.6");
    draw(&wide, "--point 0,0,-1.2 --sprite @/quarters.png" AT "0,0,-1.2,4,4");
    assert_memory_equal(plain.rgb, hidden.rgb, (size_t)3 * 240 * 320);
    assert_memory_equal(at(&wide, 50, 90), red, 3);
    assert_memory_equal(at(&wide, 112, 152), at(&plain, 112, 152), 3);
    assert_memory_equal(at(&wide, 34, 90), at(&plain, 34, 90), 3);
    sim_picture_free(&plain);
    sim_picture_free(&hidden);
    sim_picture_free(&wide);
}

static void sprites_may_be_jpeg(void **state) {
    uint8_t pixels[3 * 64];
    sim_picture_t picture = {0};
    (void)state;
    memset(pixels, 200, sizeof pixels);
    put("grey.jpg", images_jpeg(8, 8, pixels, 3));
    draw(&picture, "--sprite @/grey.jpg" AT "0,0,1.2,0.6,0.6");
    for (unsigned k = 0; k < 3; k++) {
        assert_in_range(at(&picture, 120, 160)[k], 192, 208);
    }
    sim_picture_free(&picture);
}

/* The numbers are of faces alone. */
static void ids_are_those_without_lines_and_sprites(void **state) {
    (void)state;
    put_quarters();
    cli_good_silent("render @/cube.obj --ids @/without.txt");
    cli_good_silent("render @/cube.obj --ids @/with.txt --line 0,0,0,3,3,3 --sprite @/quarters.png" AT "0,0,1.2,1,1 --edges all");
    char *with = command_read(cli_path("with.txt"), NULL), *without = command_read(cli_path("without.txt"), NULL);
    assert_string_equal(with, without);
    free(with);
    free(without);
}

static void frames_turn_translucent_models_too(void **state) {
    (void)state;
    char *hashes = cli_good("render @/cube.obj --alpha 100 --frames 3 --spin 20 --hash");
    const char *second = strstr(hashes, "frame 1 "), *third = strstr(hashes, "frame 2 ");
    assert_non_null(second);
    assert_non_null(third);
    assert_memory_not_equal(second + 8, third + 8, 16);
    free(hashes);
}

static void wrong_values_are_refused(void **state) {
    (void)state;
    cli_fails("render @/cube.obj --alpha 256", "--alpha", "255");
    cli_fails("render @/cube.obj --blend under", "--blend", "over");
    cli_fails("render @/cube.obj --edges some", "--edges", "all");
    cli_fails("render @/cube.obj --edge-colour red", "--edge-colour", "RRGGBB");
    cli_fails("render @/cube.obj --line 1,2,3,4,5", "--line", "six");
    cli_fails("render @/cube.obj --line 1,2,3,4,5,6,red", "--line", "colour");
    cli_fails("render @/cube.obj --point 1,2", "--point", "position");
    cli_fails("render @/cube.obj --point 1,2,3,-4", "--point", "size");
    cli_fails("render @/cube.obj --point 1e11,2,3", "--point", "far");
}

static void wrong_sprites_are_refused(void **state) {
    static const char *const bad[] = {"x.png",
                                      AT "0,0,0,1,1",
                                      "x.png" AT "0,0,0,1",
                                      "x.png" AT "0,0,0,1,0",
                                      "x.png" AT,
                                      "x.png" AT "a,0,0,1,1",
                                      "x.png" AT "0,0,0,-1,1",
                                      "x.png" AT "0,0,0,1,1,ff0000",
                                      "x.png" AT "0,0,nan,1,1"};
    char line[200];
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        (void)snprintf(line, sizeof line, "render @/cube.obj --sprite %s", bad[i]);
        cli_fails(line, "--sprite", "FILE");
    }
    put_quarters();
    cli_fails("render @/cube.obj --sprite @/quarters.png" AT "1e11,0,0,1,1", "--sprite", "far");
    cli_fails("render @/cube.obj --sprite @/quarters.png" AT "0,0,0,1e11,1", "--sprite", "far");
}

static void broken_pictures_are_refused(void **state) {
    static const uint8_t wide[3 * 2049];
    (void)state;
    put("wide.png", images_png_rgb(2049, 1, wide, false));
    image_bytes_t cut = images_png_rgb(20, 20, wide, false);
    cut.size -= 20; /* into the pixels, beyond the end's 12 bytes */
    put("cut.png", cut);
    cli_fails("render @/cube.obj --sprite @/nothing.png" AT "0,0,0,1,1", "--sprite", "No such file");
    cli_fails("render @/cube.obj --sprite @/cube.obj" AT "0,0,0,1,1", "--sprite", "cube.obj");
    cli_fails("render @/cube.obj --sprite @/cut.png" AT "0,0,0,1,1", "cut.png", "cut short");
    cli_fails("render @/cube.obj --sprite @/wide.png" AT "0,0,0,1,1", "wide.png", "2049x1");
}

static void sixteen_sprites_are_enough(void **state) {
    char line[2048] = "render @/cube.obj";
    (void)state;
    put_quarters();
    for (unsigned i = 0; i < 17; i++) {
        if (i == 16) { cli_good_silent(line); }
        (void)strcat(line, " --sprite @/quarters.png" AT "0,0,1.2,1,1");
    }
    cli_fails(line, "--sprite", "16 times at most");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alpha_lets_the_background_through),
        cmocka_unit_test(lines_and_points_stand_before_and_behind_faces),
        cmocka_unit_test(edges_have_their_colour),
        cmocka_unit_test(frames_turn_translucent_models_too),
        cmocka_unit_test(wrong_values_are_refused),
        cmocka_unit_test(sprites_stand_before_faces_with_their_alpha),
        cmocka_unit_test(sprites_stand_behind_faces),
        cmocka_unit_test(sprites_may_be_jpeg),
        cmocka_unit_test(ids_are_those_without_lines_and_sprites),
        cmocka_unit_test(wrong_sprites_are_refused),
        cmocka_unit_test(broken_pictures_are_refused),
        cmocka_unit_test(sixteen_sprites_are_enough),
    };
    return cmocka_run_group_tests(tests, cli_set_up, cli_tear_down);
}
