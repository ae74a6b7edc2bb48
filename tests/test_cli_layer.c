/* tuile render --alpha, --blend, --edges, --line and --point. */
#include "support/check.h"
#include "support/cli.h"

#include "../sim/picture.h"

#include <unistd.h>

static const uint8_t *at(const sim_picture_t *picture, unsigned x, unsigned y) { return sim_picture_at(picture, x, y); }

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

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alpha_lets_the_background_through), cmocka_unit_test(lines_and_points_stand_before_and_behind_faces),
        cmocka_unit_test(edges_have_their_colour),           cmocka_unit_test(frames_turn_translucent_models_too),
        cmocka_unit_test(wrong_values_are_refused),
    };
    return cmocka_run_group_tests(tests, cli_set_up, cli_tear_down);
}
