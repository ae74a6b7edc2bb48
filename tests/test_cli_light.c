/* tuile render --light, --point-light, --ambient, --specular, --emission, --two-sided and --fog. */
#include "support/check.h"
#include "support/cli.h"

#include "../sim/picture.h"

#include <unistd.h>

/* The middle of the cube's front, which is grey and faces the eye 7 units off. */
static void middle(const char *options, uint8_t colour[3]) {
    char line[400];
    sim_picture_t picture = {0};
    (void)snprintf(line, sizeof line, "render @/cube.obj --eye 0,0,8 --at 0,0,0 --out @/seen.png %s", options);
    cli_good_silent(line);
    assert_int_equal(sim_picture_read(&picture, cli_path("seen.png"), NULL), 0);
    memcpy(colour, sim_picture_at(&picture, 120, 160), 3);
    sim_picture_free(&picture);
    (void)unlink(cli_path("seen.png"));
}

static void near_to(const uint8_t colour[3], double red, double green, double blue) {
    const double wanted[3] = {red, green, blue};
    for (int c = 0; c < 3; c++) {
        if (colour[c] < wanted[c] - 9 || colour[c] > wanted[c] + 9) { /* one step of the panel, and a rounding */
            fail_msg("%u, %u, %u instead of %g, %g, %g", colour[0], colour[1], colour[2], red, green, blue);
        }
    }
}

static void lights_have_their_colours(void **state) {
    uint8_t grey[3], seen[3];
    (void)state;
    middle("--light 0,0,-1,ffffff,1 --ambient 0", grey);
    middle("--light 0,0,-1,ff0000,1 --ambient 0", seen);
    near_to(seen, grey[0], 0, 0);
    middle("--light 0,0,-1,ff0000,0.5 --light 0,0,-1,00ff00,1 --ambient 0", seen);
    near_to(seen, grey[0] / 2.0, grey[1], 0);
    middle("--light 0,0,-1,000000 --ambient 0000ff", seen);
    near_to(seen, 0, 0, grey[2]);
    middle("--light 0,0,1,ffffff,1 --ambient 0 --emission 8000ff", seen); /* from behind: none but its own */
    near_to(seen, grey[0] / 2.0, 0, grey[2]);
}

static void a_point_light_fades_to_nothing_at_its_range(void **state) {
    uint8_t grey[3], seen[3];
    (void)state;
    middle("--light 0,0,-1,ffffff,1 --ambient 0 --shade flat", grey);
    /* The face is at z = 1: 4 units from the light, of 8: (1 - 1/4)^2. */
    middle("--point-light 0,0,5,8,ffffff --ambient 0 --shade flat", seen);
    near_to(seen, grey[0] * 0.5625, grey[1] * 0.5625, grey[2] * 0.5625);
    middle("--point-light 0,0,5,4,ffffff --ambient 0 --shade flat", seen);
    near_to(seen, 0, 0, 0);
}

static void fog_takes_its_share(void **state) {
    uint8_t plain[3], seen[3];
    (void)state;
    middle("--light 0,0,-1", plain);
    middle("--light 0,0,-1 --fog linear:6,8,ff0000", seen); /* 7 units: half */
    near_to(seen, (plain[0] + 255) / 2.0, plain[1] / 2.0, plain[2] / 2.0);
    middle("--light 0,0,-1 --fog exp:5,1,0000ff", seen); /* two halves */
    near_to(seen, plain[0] / 4.0, plain[1] / 4.0, (plain[2] + 3 * 255) / 4.0);
}

static void highlights_are_white_and_round_the_mirrored_eye(void **state) {
    uint8_t plain[3], seen[3];
    (void)state;
    middle("--light 0,0,-1,ffffff,0.5 --ambient 0 --shade flat", plain);
    middle("--light 0,0,-1,ffffff,0.5 --ambient 0 --shade flat --specular 1,128", seen); /* head on: all of it */
    assert_true(seen[0] > plain[0] + 40);
    middle("--light 1,0,-0.2,ffffff,1 --ambient 0 --shade flat", plain);
    middle("--light 1,0,-0.2,ffffff,1 --ambient 0 --shade flat --specular 1,128", seen); /* far off: none */
    near_to(seen, plain[0], plain[1], plain[2]);
}

static void wrong_values_are_told(void **state) {
    static const char *const wrong[][2] = {
        {"--light", "1,2"},
        {"--light", "1,2,3,red"},
        {"--light", "1,2,3,ff0000,2"},
        {"--light", "1,2,3,ff0000,1,1"},
        {"--point-light", "1,2,3"},
        {"--point-light", "1,2,3,0"},
        {"--ambient", "2"},
        {"--ambient", "grey"},
        {"--specular", "1"},
        {"--specular", "0.5,500"},
        {"--emission", "1,1,1"},
        {"--fog", "linear:5,4,ffffff"},
        {"--fog", "thick"},
        {"--fog", "exp:1,0,ffffff"},
        {"--fog", "exp:1,2"},
    };
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(wrong); i++) {
        char line[200];
        (void)snprintf(line, sizeof line, "render @/cube.obj --hash %s=%s", wrong[i][0], wrong[i][1]);
        cli_fails(line, wrong[i][0], NULL);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_have_their_colours), cmocka_unit_test(a_point_light_fades_to_nothing_at_its_range),
        cmocka_unit_test(fog_takes_its_share),       cmocka_unit_test(highlights_are_white_and_round_the_mirrored_eye),
        cmocka_unit_test(wrong_values_are_told),
    };
    return cmocka_run_group_tests(tests, cli_set_up, cli_tear_down);
}
