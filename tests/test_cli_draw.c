/* tuile faces --draw: scenes in whole pixels, known by hand; the same picture through any tiles; wrong combinations. */
#include "support/check.h"
#include "support/cli.h"

#include "../sim/scene_draw.h"
#include "reference/scene_generator.h"
#include "support/random.h"

static void drawn(const char *options, const char *scene, const char *expected) {
    static const char *const tiles[] = {"", " --tile 1x1", " --tile=3x2", " --tile 1024x1"};
    char line[128];
    cli_put("scene", scene);
    for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
        (void)snprintf(line, sizeof line, "faces --draw %s%s @/scene", options, tiles[i]);
        cli_answers(line, expected);
    }
}

static void lines_known_by_hand(void **state) {
    (void)state;
    /* Both ends are drawn, also the lower right ones. (0,0)-(4,1): rows 0, 0.25, 0.5, 0.75, 1 to the nearest, halves on.
     * (4,1)-(4,3). (4,3)-(0,0) walks back: 3, 2.25, 1.5, 0.75, 0 rows from the top, the half again the way it walks, up. */
    drawn("lines", "screen 6 5\ncamera ortho\npoly 5 0,0,1 4,1,1 4,3,1\n",
          "5 5 0 0 0 0\n0 5 5 5 5 0\n0 0 0 5 5 0\n0 0 0 0 5 0\n0 0 0 0 0 0\n");
}

static void later_polygons_cover_earlier_ones_whatever_their_depth(void **state) {
    (void)state;
    drawn("lines", "screen 4 3\ncamera ortho\npoly 1 0,0,1 2,0,1 2,2,1 0,2,1\npoly 2 1,1,9 3,1,9 3,2,9 1,2,9\n",
          "1 1 1 0\n1 2 2 2\n1 2 2 2\n");
    drawn("triangles --policy outer",
          "screen 4 3\ncamera ortho\nnear max\ntie first\npoly 2 1,1,9 3,1,9 3,2,9 1,2,9\npoly 1 0,0,1 2,0,1 2,2,1 0,2,1\n",
          "1 1 1 0\n1 1 1 2\n1 1 1 2\n");
}

/* Pixel i is sampled at i + SX: a corner goes to the nearest sample, halves right and down. */
static void corners_go_to_the_nearest_sample(void **state) {
    (void)state;
    drawn("lines", "screen 5 2\ncamera ortho\npoly 1 1/2,0,1 1/2,1/4,1 2.49,0,1\n", "0 1 1 0 0\n0 0 0 0 0\n");
    drawn("lines", "screen 5 2\ncamera ortho\nsample 1/2 1/2\npoly 1 1/2,1/2,1 3,1/2,1 3,3/4,1\n", "1 1 1 1 0\n0 0 0 0 0\n");
    drawn("lines", "screen 5 2\ncamera ortho\nsample 1/4 0\npoly 1 3/4,0,1 3.7,0,1 3.7,0.4,1\n", "0 1 1 1 0\n0 0 0 0 0\n");
}

/* (0,0) (9,3) (0,3): the right side's runs are 0 1, 2 3 4, 5 6 7, 8 9. */
static void policies_known_by_hand(void **state) {
    static const char scene[] = "screen 11 4\ncamera ortho\npoly 7 0,0,1 9,3,1 0,3,1\n";
    (void)state;
    const char *outer = "7 7 0 0 0 0 0 0 0 0 0\n7 7 7 7 7 0 0 0 0 0 0\n7 7 7 7 7 7 7 7 0 0 0\n7 7 7 7 7 7 7 7 7 7 0\n";
    drawn("triangles --policy outer", scene, outer);
    drawn("triangles --policy upwards", scene, outer);
    drawn("triangles --policy ends", scene,
          "7 0 0 0 0 0 0 0 0 0 0\n7 7 7 7 7 0 0 0 0 0 0\n7 7 7 7 7 7 7 7 0 0 0\n7 7 7 7 7 7 7 7 7 7 0\n");
    drawn("triangles --policy mid", scene,
          "7 0 0 0 0 0 0 0 0 0 0\n7 7 7 7 0 0 0 0 0 0 0\n7 7 7 7 7 7 7 0 0 0 0\n7 7 7 7 7 7 7 7 7 0 0\n");
    drawn("triangles --policy inner", scene,
          "7 0 0 0 0 0 0 0 0 0 0\n7 7 7 0 0 0 0 0 0 0 0\n7 7 7 7 7 7 0 0 0 0 0\n7 7 7 7 7 7 7 7 7 0 0\n");
    /* The document's: of the last row only the corner that its last side leads to. */
    char *document = cli_good("faces --draw triangles --policy document @/scene"),
         *usual = cli_good("faces --draw triangles @/scene");
    assert_string_equal(document, usual);
    assert_int_equal(strncmp(document, outer, 66), 0);
    assert_int_equal(strlen(document), 88);
    unsigned left = 0;
    for (const char *at = document + 66; *at; at++) {
        left += *at == '7';
    }
    assert_int_equal(left, 1);
    free(document);
    free(usual);
}

/* An L, whose reflex corner a fan would cover, and what the renderer's own fill leaves of it: it takes no right and no lower edge.
 */
static void polygons_that_are_not_convex_are_cut(void **state) {
    static const char scene[] = "screen 6 5\ncamera ortho\npoly 3 0,0,1 1,0,1 1,3,1 4,3,1 4,4,1 0,4,1\n";
    (void)state;
    drawn("triangles --policy outer", scene, "3 3 0 0 0 0\n3 3 0 0 0 0\n3 3 0 0 0 0\n3 3 3 3 3 0\n3 3 3 3 3 0\n");
    drawn("fill", scene, "3 0 0 0 0 0\n3 0 0 0 0 0\n3 0 0 0 0 0\n3 3 3 3 0 0\n0 0 0 0 0 0\n");
    cli_answers("faces @/scene", "3 0 0 0 0 0\n3 0 0 0 0 0\n3 0 0 0 0 0\n3 3 3 3 0 0\n0 0 0 0 0 0\n");
}

static void perspective_ends_at_the_near_plane(void **state) {
    (void)state;
    /* F = 2 about (2, 2): +-1 at Z = 2 is 1 ... 3. */
    drawn("triangles --policy outer", "screen 5 5\ncamera persp 2\norigin 2 2\npoly 4 -1,-1,2 1,-1,2 1,1,2 -1,1,2\n",
          "0 0 0 0 0\n0 4 4 4 0\n0 4 4 4 0\n0 4 4 4 0\n0 0 0 0 0\n");
    drawn("lines", "screen 5 5\ncamera persp 2\norigin 2 2\nysign -1\npoly 4 -1,0,2 1,0,2 1,1,2 -1,1,2\n",
          "0 0 0 0 0\n0 4 4 4 0\n0 4 4 4 0\n0 0 0 0 0\n0 0 0 0 0\n");
    /* A floor from Z = 4 through the near plane at 1 to -5: x = 2 + 2 X / Z, y = 2 + 2 / Z. The sides X = +-1 leave (1.5, 2.5) for
     * (0, 4) and (2.5, 2.5) for (4, 4): corners (2, 3), (0, 4) and (3, 3), (4, 4). The side at Z = -5 is not drawn, nor is the cut.
     */
    drawn("lines", "screen 5 5\ncamera persp 2\norigin 2 2\npoly 8 -1,1,-5 1,1,-5 1,1,4 -1,1,4\n",
          "0 0 0 0 0\n0 0 0 0 0\n0 0 0 0 0\n0 0 8 8 0\n8 8 0 0 8\n");
    /* Filled: (2, 3) - (0, 4) is halfway in column 1 and takes the lower row there. */
    drawn("triangles --policy outer", "screen 5 5\ncamera persp 2\norigin 2 2\npoly 8 -1,1,-5 1,1,-5 1,1,4 -1,1,4\n",
          "0 0 0 0 0\n0 0 0 0 0\n0 0 0 0 0\n0 0 8 8 0\n8 8 8 8 8\n");
    drawn("lines", "screen 2 2\ncamera persp 2 3\npoly 4 -9,-9,2 9,-9,2 9,9,2 -9,9,2\n", "0 0\n0 0\n");
}

static void bad_combinations_are_refused(void **state) {
    (void)state;
    cli_put("scene", "screen 4 4\ncamera ortho\npoly 6 0,0,1 3,3,1 3,0,1 0,3,1\n");
    cli_fails("faces --policy outer @/scene", "--policy", "triangles");
    cli_fails("faces --draw lines --policy outer @/scene", "--policy", "lines");
    cli_fails("faces --draw fill --policy outer @/scene", "--policy", "fill");
    cli_fails("faces --draw lines --method zbuffer @/scene", "--method", "lines");
    cli_fails("faces --draw triangles --memory 16K @/scene", "--memory", "triangles");
    cli_fails("faces --draw dots @/scene", "--draw", "fill, lines, triangles");
    cli_fails("faces --draw triangles --policy best @/scene", "--policy", "document, ends, upwards, outer, mid, inner");
    cli_fails("faces --draw triangles @/scene", "line 3", "crosses itself");
    char *out = cli_good("faces --draw lines @/scene"); /* as an outline it is good */
    assert_string_equal(out, "6 0 0 6\n6 6 6 6\n6 6 6 6\n6 0 0 6\n");
    free(out);
    cli_put("scene", "screen 4 4\ncamera persp 16000 1/65536\npoly 1 0,0,2 30000,0,-2 30000,1,2\n");
    cli_fails("faces --draw lines @/scene", "line 3", "NEAR");
    cli_put("scene", "screen 2 1\ncamera ortho\n");
    cli_answers("faces --draw triangles @/scene", "0 0\n");
}

/* ---- any scene ------------------------------------------------------------------------------------------------------ */

static void any_tile_gives_the_same_picture(void **state) {
    enum { W = 40, H = 30 };
    const scene_generator_t options = {.width = W, .height = H, .simple = true};
    random_source_t random = random_seed(3);
    unsigned drawn_scenes = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= CHECK_ROUNDS(200); seed++) {
        char *text = scene_generate(seed, &options);
        scene_text_t scene;
        mesh_t mesh;
        scene_quantisation_t quantisation;
        scene_view_t view;
        sim_error_t error = {""};
        assert_int_equal(scene_text_parse(&scene, text, strlen(text), "scene", &error), 0);
        assert_int_equal(scene_text_mesh(&scene, &mesh, &quantisation, &error), 0);
        assert_int_equal(scene_text_camera(&scene, &quantisation, &view, &error), 0);
        for (int kind = SCENE_DRAW_LINES; kind <= SCENE_DRAW_TRIANGLES; kind++) {
            static uint32_t whole[W * H], tiled[W * H];
            scene_drawing_t drawing = {(scene_drawing_kind_t)kind, (edge_policy_t)(seed % 6), 0, 0};
            memset(whole, 0, sizeof whole);
            memset(tiled, 0, sizeof tiled);
            const int result = scene_draw(&scene, &mesh, &quantisation, &view, &drawing, whole, &error);
            drawing.tile_width = (uint16_t)random_between(&random, 1, 16);
            drawing.tile_height = (uint16_t)random_between(&random, 1, 16);
            assert_int_equal(scene_draw(&scene, &mesh, &quantisation, &view, &drawing, tiled, &error), result);
            if (result) { fail_msg("seed %llu: %s", (unsigned long long)seed, error.text); }
            assert_memory_equal(whole, tiled, sizeof whole);
            drawn_scenes++;
        }
        scene_text_free(&scene);
        mesh_free(&mesh);
        free(text);
    }
    assert_int_equal(drawn_scenes, 2 * CHECK_ROUNDS(200));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_known_by_hand),
        cmocka_unit_test(later_polygons_cover_earlier_ones_whatever_their_depth),
        cmocka_unit_test(corners_go_to_the_nearest_sample),
        cmocka_unit_test(policies_known_by_hand),
        cmocka_unit_test(polygons_that_are_not_convex_are_cut),
        cmocka_unit_test(perspective_ends_at_the_near_plane),
        cmocka_unit_test(bad_combinations_are_refused),
        cmocka_unit_test(any_tile_gives_the_same_picture),
    };
    return cmocka_run_group_tests_name("cli_draw", tests, cli_set_up, cli_tear_down);
}
