/* Five methods, one picture. Random scenes are drawn by all of them; each pixel is compared with the exact reference, which tells
 * where a renderer of 1/16 pixel and 16 bits of depth is free to differ. There, and nowhere else, the methods may show different
 * faces; those that decide by depth may not even there. */
#include "support/check.h"
#include "support/scenes.h"

#include "reference/scene_generator.h"

enum { METHODS = TUILE_TREE + 1 };

static const char *const names[METHODS] = {"zbuffer", "scanline", "warnock", "painter", "tree"};

typedef struct five {
    test_scene_t plain, tree;
    uint32_t *ids[METHODS];
    tuile_stats_t stats[METHODS];
} five_t;

static void five_draw(five_t *five, const char *text, const tuile_config_t *config) {
    test_scene_open(&five->plain, text);
    test_scene_open_tree(&five->tree, text);
    for (unsigned m = 0; m < METHODS; m++) {
        tuile_config_t c = *config;
        c.method = (uint8_t)m;
        five->ids[m] = test_scene_ids(m == TUILE_TREE ? &five->tree : &five->plain, &c, 1 << 20, &five->stats[m]);
    }
}

static size_t five_pixels(const five_t *five) { return (size_t)five->plain.text.width * five->plain.text.height; }

static void five_close(five_t *five) {
    for (unsigned m = 0; m < METHODS; m++) {
        free(five->ids[m]);
    }
    test_scene_close(&five->plain);
    test_scene_close(&five->tree);
}

/* Exactly the same picture by all. */
static void expect_one_picture(const five_t *five, const char *text) {
    for (unsigned m = 1; m < METHODS; m++) {
        for (size_t i = 0; i < five_pixels(five); i++) {
            if (five->ids[m][i] == five->ids[0][i]) { continue; }
            fail_msg("%s: face %u at %u,%u instead of %u\n%s", names[m], five->ids[m][i], (unsigned)(i % five->plain.text.width),
                     (unsigned)(i / five->plain.text.width), five->ids[0][i], text);
        }
    }
}

/* The same scene sampled dx, dy sixteenths of a pixel beside. The result is malloc'ed. */
static char *moved_sample(const char *text, const scene_text_t *scene, int dx, int dy) {
    const char *line = strstr(text, "\nsample "), *rest = line ? strchr(line + 1, '\n') : "";
    const scene_number_t *at = scene->sample;
    char *moved = malloc(strlen(text) + 128);
    assert_non_null(moved);
    (void)sprintf(moved, "%.*s\nsample %lld/%lld %lld/%lld%s\n", line ? (int)(line - text) : (int)strlen(text), text,
                  (long long)(16 * at[0].numerator + dx * at[0].denominator), (long long)(16 * at[0].denominator),
                  (long long)(16 * at[1].numerator + dy * at[1].denominator), (long long)(16 * at[1].denominator), rest);
    return moved;
}

/* Where the tree has cut a face, its corners are snapped to 1/16 pixel like all others, and what lies behind may show at a pixel
 * centre that the cut passes by so closely: pixels that are wrong but right where they are sampled 1/16 pixel beside. Cuts are no
 * edges of the scene, so the reference does not know of them. */
static unsigned wrong_beside_cuts_too(const char *text, const five_t *five) {
    const size_t pixels = five_pixels(five);
    uint32_t *best = malloc(pixels * sizeof *best);
    unsigned wrong = test_scene_wrong_pixels(&five->plain, text, five->ids[TUILE_TREE]);
    memcpy(best, five->ids[TUILE_TREE], pixels * sizeof *best);
    for (int i = 0; i < 9 && wrong > 0; i++) {
        char *moved = moved_sample(text, &five->plain.text, i % 3 - 1, i / 3 - 1);
        const tuile_config_t config = {.method = TUILE_TREE};
        test_scene_t scene;
        test_scene_open_tree(&scene, moved);
        uint32_t *ids = test_scene_ids(&scene, &config, 1 << 20, NULL);
        for (size_t p = 0; p < pixels; p++) {
            if (five->ids[TUILE_TREE][p] != five->ids[TUILE_ZBUFFER][p] && ids[p] == five->ids[TUILE_ZBUFFER][p]) {
                best[p] = ids[p];
            }
        }
        free(ids);
        test_scene_close(&scene);
        free(moved);
        wrong = test_scene_wrong_pixels(&five->plain, text, best);
    }
    free(best);
    return wrong;
}

static void check_seeds(const scene_generator_t *options, uint64_t first, unsigned count) {
    static const tuile_config_t configs[] = {{.tile_height = 0}, {.tile_height = 3}, {.tile_width = 16, .tile_height = 8}};
    uint64_t differ = 0, beside = 0, pixels = 0;
    for (uint64_t seed = first; seed < first + count; seed++) {
        char *text = scene_generate(seed, options);
        five_t five;
        assert_non_null(text);
        five_draw(&five, text, &configs[seed % CHECK_COUNT(configs)]);
        for (unsigned m = 0; m < METHODS; m++) {
            unsigned wrong = test_scene_wrong_pixels(&five.plain, text, five.ids[m]);
            if (wrong && m == TUILE_TREE) {
                beside += wrong;
                wrong = wrong_beside_cuts_too(text, &five);
            }
            if (wrong) { fail_msg("seed %llu, %s: %u pixels wrong\n%s", (unsigned long long)seed, names[m], wrong, text); }
            for (size_t i = 0; i < five_pixels(&five); i++) {
                const bool same = five.ids[m][i] == five.ids[TUILE_ZBUFFER][i];
                if (m <= TUILE_WARNOCK && !same) {
                    fail_msg("seed %llu: %s differs\n%s", (unsigned long long)seed, names[m], text);
                }
                differ += !same;
            }
        }
        pixels += five_pixels(&five);
        five_close(&five);
        free(text);
    }
    /* Were the reference to let everything pass, this would not. */
    print_message("%llu of %llu pixels differ, %llu beside cuts of the tree\n", (unsigned long long)differ,
                  (unsigned long long)pixels, (unsigned long long)beside);
    assert_true(differ * (CHECK_SANITIZED ? 10 : 50) < pixels && beside * 1000 < pixels);
}

static void random_orthographic_scenes_are_one_picture(void **state) {
    (void)state;
    const scene_generator_t options = {.no_perspective = true};
    check_seeds(&options, 200001, CHECK_ROUNDS(600));
}

static void random_perspective_scenes_are_one_picture(void **state) {
    (void)state;
    const scene_generator_t options = {.no_orthographic = true};
    check_seeds(&options, 300001, CHECK_ROUNDS(600));
}

/* ---- by hand ------------------------------------------------------------------------------------------------- */

/* One letter a pixel: '.' background, else the ID. */
static void expect_rows(const char *text, const char *const *rows) {
    five_t five;
    const tuile_config_t config = {.tile_height = 0};
    five_draw(&five, text, &config);
    expect_one_picture(&five, text);
    for (unsigned y = 0; y < five.plain.text.height; y++) {
        for (unsigned x = 0; x < five.plain.text.width; x++) {
            const uint32_t id = five.ids[0][(size_t)y * five.plain.text.width + x];
            assert_int_equal(rows[y][x], id ? (int)('0' + five.plain.text.polys[id - 1].id) : '.');
        }
    }
    five_close(&five);
}

#define ORTHO(w, h) "screen " #w " " #h "\ncamera ortho\nsample 1/2 1/2\n"

/* Three squares in one plane, overlapping: the first of the file is seen, or with `tie last` the last, by all methods. */
static void coplanar_faces_are_decided_by_their_order(void **state) {
    (void)state;
#define THREE "poly 1 0,0,5 4,0,5 4,3,5 0,3,5\npoly 2 2,1,5 6,1,5 6,4,5 2,4,5\npoly 3 1,2,5 3,2,5 3,5,5 1,5,5\n"
    static const char *const first[] = {"1111..", "111122", "111122", ".32222", ".33..."};
    static const char *const last[] = {"1111..", "112222", "133222", ".33222", ".33..."};
    expect_rows(ORTHO(6, 5) THREE, first);
    expect_rows(ORTHO(6, 5) "tie last\n" THREE, last);
    expect_rows(ORTHO(6, 5) "near max\n" THREE, first);
#undef THREE
}

/* Four bars, two lying and two standing, each leaning through the picture so that every pair changes places somewhere or hides one
 * another in turn: no order of whole faces is right. Where each is seen is left to the reference. */
static void bars_in_a_circle_are_one_picture(void **state) {
    (void)state;
    const char *text = ORTHO(12, 12) "poly 1 0,2,0 12,2,24 12,4,24 0,4,0\n"
                                     "poly 2 2,0,10 4,0,10 4,12,34 2,12,34\n"
                                     "poly 3 12,8,36 0,8,24 0,10,24 12,10,36\n"
                                     "poly 4 8,0,14 10,0,14 10,12,30 8,12,30\n";
    five_t five;
    const tuile_config_t config = {.tile_height = 5};
    five_draw(&five, text, &config);
    for (unsigned m = 0; m < METHODS; m++) {
        assert_int_equal(test_scene_wrong_pixels(&five.plain, text, five.ids[m]), 0);
    }
    assert_true(five.stats[TUILE_PAINTER].splits > 0);
    five_close(&five);
}

/* From the inside of a closed room with a box on its floor and a frame on its wall. Z runs away from the eye. */
static void a_closed_room_is_one_picture(void **state) {
    (void)state;
    const char *text = "screen 48 36\ncamera persp 40 1/2\nsample 1/2 1/2\n"
                       "poly 1 -10,-6,-5 10,-6,-5 10,-6,30 -10,-6,30\n"
                       "poly 2 -10,6,-5 10,6,-5 10,6,30 -10,6,30\n"
                       "poly 3 -10,-6,-5 -10,6,-5 -10,6,30 -10,-6,30\n"
                       "poly 4 10,-6,-5 10,6,-5 10,6,30 10,-6,30\n"
                       "poly 5 -10,-6,30 10,-6,30 10,6,30 -10,6,30\n"
                       "poly 6 -10,-6,-5 10,-6,-5 10,6,-5 -10,6,-5\n"
                       "poly 7 -2,6,12 4,6,10 4,1,10 -2,1,12\n"
                       "poly 8 4,6,10 6,6,16 6,1,16 4,1,10\n"
                       "poly 9 -2,1,12 4,1,10 6,1,16 0,1,18\n"
                       "poly 10 -10,-2,14 -10,3,14 -10,3,24 -10,-2,24\n"
                       "poly 11 -3,-4,30 3,-4,30 3,1,30 -3,1,30 -2,0,30 2,0,30 2,-3,30 -2,-3,30 -2,0,30 -3,1,30\n";
    five_t five;
    const tuile_config_t config = {.tile_height = 0};
    five_draw(&five, text, &config);
    for (unsigned m = 0; m < METHODS; m++) {
        assert_int_equal(test_scene_wrong_pixels(&five.plain, text, five.ids[m]), 0);
        for (size_t i = 0; i < five_pixels(&five); i++) {
            assert_int_not_equal(five.ids[m][i], 0); /* it is closed */
        }
    }
    five_close(&five);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coplanar_faces_are_decided_by_their_order),
        cmocka_unit_test(bars_in_a_circle_are_one_picture),
        cmocka_unit_test(a_closed_room_is_one_picture),
        cmocka_unit_test(random_orthographic_scenes_are_one_picture),
        cmocka_unit_test(random_perspective_scenes_are_one_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
