/* Sprites, lines and edges, pixel by pixel, in an orthographic view of 16 pixels a unit: (0, 0) is the middle of the window. */
#include "support/check.h"
#include "support/frame.h"
#include "support/models.h"
#include "support/stage.h"

#include <stdlib.h>

#define SIDE 32
#define UNIT 65536

static tuile_config_t config_of(uint8_t effects) {
    return (tuile_config_t){.width = SIDE, .height = SIDE, .format = TUILE_RGB666, .effects = effects};
}

static tuile_scene_t empty_scene(void) { return (tuile_scene_t){.camera = stage_plain_camera(SIDE, SIDE)}; }

/* Pixels that are not black, row by row as bits from the left. */
static void draw(const tuile_scene_t *scene, const tuile_config_t *config, uint32_t rows[SIDE]) {
    uint8_t *picture = frame_draw(scene, config, (size_t)1 << 18, NULL);
    for (unsigned y = 0; y < SIDE; y++) {
        rows[y] = 0;
        for (unsigned x = 0; x < SIDE; x++) {
            const uint8_t *p = picture + 3 * (y * SIDE + x);
            if (p[0] | p[1] | p[2]) { rows[y] |= 1u << x; }
        }
    }
    free(picture);
}

static unsigned count(const uint32_t rows[SIDE]) {
    unsigned n = 0;
    for (unsigned i = 0; i < SIDE * SIDE; i++) {
        n += rows[i / SIDE] >> i % SIDE & 1u;
    }
    return n;
}

static tuile_sprite_t square(int32_t pixels) {
    return (tuile_sprite_t){
        .width = pixels * UNIT, .height = pixels * UNIT, .colour = {255, 255, 255}, .alpha = 255, .pixels = true};
}

/* A wall of 1 x 1 units before, at z = 1, and behind, at z = -1. */
static void wall(model_compiled_t *compiled, int z) {
    mesh_t mesh;
    model_start(&mesh);
    const uint32_t corners[4] = {model_position(&mesh, -0.5, -0.5, z), model_position(&mesh, 0.5, -0.5, z),
                                 model_position(&mesh, 0.5, 0.5, z), model_position(&mesh, -0.5, 0.5, z)};
    model_face(&mesh, corners, 4, model_material(&mesh, 255, 0, 0));
    model_compile(compiled, &mesh);
    mesh_free(&mesh);
}

/* ---- sprites ---- */

static void a_square_of_four_pixels_covers_four_by_four(void **state) {
    tuile_sprite_t sprite = square(4);
    tuile_scene_t scene = empty_scene();
    const tuile_config_t config = config_of(TUILE_LAYERS);
    uint32_t rows[SIDE];
    (void)state;
    scene.sprites = &sprite;
    scene.sprite_count = 1;
    draw(&scene, &config, rows);
    for (unsigned y = 0; y < SIDE; y++) {
        assert_int_equal(rows[y], y >= 14 && y < 18 ? 0xfu << 14 : 0);
    }
    sprite.pixels = false; /* units of the world: 16 pixels each */
    sprite.width = UNIT / 2;
    sprite.height = UNIT;
    draw(&scene, &config, rows);
    for (unsigned y = 0; y < SIDE; y++) {
        assert_int_equal(rows[y], y >= 8 && y < 24 ? 0xffu << 12 : 0);
    }
}

static void a_disc_covers_the_pixels_whose_centres_are_in_it(void **state) {
    tuile_sprite_t sprite = square(10);
    tuile_scene_t scene = empty_scene();
    const tuile_config_t config = config_of(TUILE_LAYERS);
    uint32_t rows[SIDE];
    (void)state;
    sprite.round = true;
    scene.sprites = &sprite;
    scene.sprite_count = 1;
    draw(&scene, &config, rows);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int x = 2 * (i % SIDE) + 1 - SIDE, y = 2 * (i / SIDE) + 1 - SIDE; /* half pixels from the centre */
        assert_int_equal(rows[i / SIDE] >> i % SIDE & 1u, x * x + y * y <= 100);
    }
}

static void a_texture_is_spread_over_the_sprite(void **state) {
    static const uint8_t grey[4] = {40, 80, 120, 160};
    const tuile_texture_t texture = {.texels = grey, .width = 2, .height = 2, .format = TUILE_TEXEL_GREY8, .levels = 1};
    tuile_sprite_t sprite = square(8);
    tuile_scene_t scene = empty_scene();
    const tuile_config_t config = config_of(TUILE_LAYERS);
    (void)state;
    sprite.texture = &texture;
    scene.sprites = &sprite;
    scene.sprite_count = 1;
    uint8_t *picture = frame_draw(&scene, &config, (size_t)1 << 18, NULL);
    for (unsigned i = 0; i < 64; i++) {
        const unsigned x = i % 8, y = i / 8, level = grey[x / 4 + 2 * (y / 4)];
        assert_int_equal(picture[3 * ((y + 12) * SIDE + x + 12)] >> 2, (level * 126 + 255) / 510);
    }
    free(picture);
}

static void faces_before_hide_sprites_and_lines_and_faces_behind_do_not(void **state) {
    static const tuile_line_t line = {.from = {-UNIT, UNIT / 4, 0}, .to = {UNIT, UNIT / 4, 0}, .colour = {0, 255, 0}};
    const tuile_config_t config = config_of(TUILE_LAYERS);
    (void)state;
    for (int z = -1; z <= 1; z += 2) {
        model_compiled_t compiled;
        wall(&compiled, z);
        tuile_instance_t instance = stage_placed(&compiled.model, 0);
        tuile_sprite_t sprite = square(4);
        tuile_scene_t scene = empty_scene();
        sprite.colour[0] = sprite.colour[2] = 0;
        scene.ambient = 255;
        scene.instances = &instance;
        scene.instance_count = 1;
        scene.lines = &line;
        scene.line_count = 1;
        scene.sprites = &sprite;
        scene.sprite_count = 1;
        uint8_t *picture = frame_draw(&scene, &config, (size_t)1 << 18, NULL);
        assert_int_equal(picture[3 * (16 * SIDE + 16) + 1] != 0, z < 0);
        assert_int_equal(picture[3 * (12 * SIDE + 16) + 1] != 0, z < 0);
        assert_int_equal(picture[3 * (12 * SIDE + 2) + 1] != 0, true); /* beside the wall */
        free(picture);
        model_free(&compiled);
    }
}

/* ---- lines ---- */

static void lines_are_bresenham_s_whichever_way_round(void **state) {
    /* From pixel (8, 16) to (24, 20): 4 rows down in 16 columns; a step down every fourth pixel, the first after two. */
    tuile_line_t line = {.from = {-UNIT / 2, 0, 0}, .to = {UNIT / 2, -UNIT / 4, 0}, .colour = {255, 255, 255}};
    const tuile_config_t config = config_of(TUILE_LAYERS);
    tuile_scene_t scene = empty_scene();
    uint32_t rows[SIDE], turned[SIDE];
    (void)state;
    scene.lines = &line;
    scene.line_count = 1;
    draw(&scene, &config, rows);
    for (unsigned x = 0; x < SIDE; x++) {
        const unsigned y = 16 + (x - 8 + 2) / 4;
        for (unsigned k = 0; k < SIDE; k++) {
            assert_int_equal(rows[k] >> x & 1u, x >= 8 && x <= 24 && k == y);
        }
    }
    for (unsigned i = 0; i < 3; i++) {
        const q16_16_t from = line.from[i];
        line.from[i] = line.to[i];
        line.to[i] = from;
    }
    draw(&scene, &config, turned);
    assert_memory_equal(rows, turned, sizeof rows);
}

static void lines_from_behind_the_eye_are_cut_at_the_near_plane(void **state) {
    /* Perspective, looking along -z from (0, 0, 4): a line one unit below the eye comes up the middle column towards the horizon.
     */
    static const q16_16_t eye[3] = {0, 0, 4 * UNIT}, at[3] = {0, 0, 0}, up[3] = {0, UNIT, 0};
    const tuile_line_t line = {.from = {0, -UNIT, 1000 * UNIT}, .to = {0, -UNIT, -12 * UNIT}, .colour = {255, 255, 255}};
    const tuile_config_t config = config_of(TUILE_LAYERS);
    tuile_scene_t scene = empty_scene();
    uint32_t rows[SIDE];
    (void)state;
    scene.camera.projection = TUILE_PERSPECTIVE;
    scene.camera.focal_x = scene.camera.focal_y = 32 * UNIT;
    scene.camera.near = UNIT;
    scene.camera.far = 100 * UNIT;
    assert_int_equal(tuile_camera_look_at(&scene.camera, eye, at, up), 0);
    scene.lines = &line;
    scene.line_count = 1;
    draw(&scene, &config, rows);
    for (unsigned y = 0; y < SIDE; y++) { /* 16 units off: 32 / 16 = 2 pixels below the middle */
        assert_int_equal(rows[y], y >= 18 ? 1u << 16 : 0);
    }
}

static void smooth_lines_share_a_pixel_s_worth_between_two(void **state) {
    const tuile_line_t line = {
        .from = {-3 * UNIT / 4, -UNIT / 5, 0}, .to = {2 * UNIT / 3, UNIT / 3, 0}, .colour = {255, 255, 255}, .smooth = true};
    tuile_config_t config = config_of(TUILE_LAYERS);
    tuile_scene_t scene = empty_scene();
    (void)state;
    config.format = TUILE_GREY8;
    scene.lines = &line;
    scene.line_count = 1;
    uint8_t *picture = frame_draw(&scene, &config, (size_t)1 << 18, NULL);
    for (unsigned x = 0; x < SIDE; x++) {
        unsigned sum = 0;
        double height = 0;
        for (unsigned y = 0; y < SIDE; y++) {
            sum += picture[y * SIDE + x];
            height += (y + 0.5) * picture[y * SIDE + x];
        }
        /* From x = 4 to 26 2/3: columns whose centres lie between. */
        assert_in_range(sum, x >= 4 && x <= 26 ? 254 : 0, x >= 4 && x <= 26 ? 256 : 0);
        if (sum != 0) {
            const double exact = 16 + 16.0 / 5 - (x + 0.5 - 4) * (16.0 / 5 + 16.0 / 3) / (12 + 32.0 / 3);
            const double off = height / sum - exact;
            if (off > 0.07 || off < -0.07) { fail_msg("column %u: %f off", x, off); } /* ends are snapped to 1/16 */
        }
    }
    free(picture);
}

/* ---- edges ---- */

static void edges(uint8_t kind, int turn, uint32_t rows[SIDE], uint8_t method, uint16_t tile) {
    mesh_t mesh;
    model_compiled_t compiled;
    model_cube(&mesh);
    const mesh_options_t options = {.tree = true};
    model_compile_with(&compiled, &mesh, &options);
    mesh_free(&mesh);
    tuile_instance_t instance = stage_placed(&compiled.model, 0);
    tuile_scene_t scene = empty_scene();
    tuile_config_t config = config_of(TUILE_LAYERS);
    scene.camera.focal_x = scene.camera.focal_y = 6 * UNIT; /* faces are 12 pixels wide, from 10 to 22 */
    config.edges = kind;
    config.edge_colour[0] = config.edge_colour[1] = config.edge_colour[2] = 255;
    config.method = method;
    config.tile_width = config.tile_height = tile;
    config.cluster_vertices = compiled.model.cluster_vertices_max;
    config.tree_depth = compiled.model.tree_depth;
    tuile_rotation(instance.pose.rotation, 1, (bam16_t)turn);
    scene.instances = &instance;
    scene.instance_count = 1;
    draw(&scene, &config, rows);
    model_free(&compiled);
}

static void edges_of_a_face_are_a_frame(void **state) {
    uint32_t rows[SIDE];
    (void)state;
    for (uint8_t kind = TUILE_EDGES_ALL; kind <= TUILE_EDGES_HIDDEN; kind++) {
        edges(kind, 0, rows, TUILE_ZBUFFER, 0);
        for (unsigned y = 0; y < SIDE; y++) {
            const uint32_t full = 0x1fffu << 10, sides = 1u << 10 | 1u << 22;
            assert_int_equal(rows[y], y == 10 || y == 22 ? full : y > 10 && y < 22 ? sides : 0);
        }
    }
}

static void a_turned_cube_hides_its_back_edges(void **state) {
    uint32_t all[SIDE], front[SIDE], hidden[SIDE];
    (void)state;
    edges(TUILE_EDGES_ALL, 5000, all, TUILE_ZBUFFER, 0);
    edges(TUILE_EDGES_FRONT, 5000, front, TUILE_ZBUFFER, 0);
    edges(TUILE_EDGES_HIDDEN, 5000, hidden, TUILE_ZBUFFER, 0);
    assert_memory_equal(front, hidden, sizeof front); /* convex: no front edge is hidden */
    assert_true(count(all) > count(front));
    for (unsigned y = 0; y < SIDE; y++) {
        assert_int_equal(front[y] & ~all[y], 0);
    }
}

static void an_outline_lies_round_the_face(void **state) {
    uint32_t rows[SIDE];
    (void)state;
    edges(TUILE_EDGES_OUTLINE, 0, rows, TUILE_ZBUFFER, 0);
    for (unsigned y = 10; y < 22; y++) { /* the face is unlit, black */
        assert_int_equal(rows[y] & 0xfffu << 10, 0);
        assert_int_equal(rows[y] >> 9 & 1u, 1);
        assert_int_equal(rows[y] >> 22 & 1u, 1);
    }
    assert_int_equal(rows[9] & 0xfffu << 10, 0xfffu << 10);
    assert_int_equal(rows[22] & 0xfffu << 10, 0xfffu << 10);
    assert_int_equal(rows[7] | rows[25], 0);
}

static void edges_are_the_same_in_all_methods_and_tiles(void **state) {
    (void)state;
    for (uint8_t kind = TUILE_EDGES_ALL; kind <= TUILE_EDGES_OUTLINE; kind++) {
        uint32_t expected[SIDE], rows[SIDE];
        edges(kind, 5000, expected, TUILE_ZBUFFER, 0);
        for (unsigned k = 0; k < 2 * (TUILE_TREE + 1); k++) {
            edges(kind, 5000, rows, (uint8_t)(k / 2), k % 2 ? 8 : 5);
            if (memcmp(rows, expected, sizeof rows) != 0) { fail_msg("edges %u, method %u, tiles %u", kind, k / 2, k % 2); }
        }
    }
}

/* ---- what is refused ---- */

static int begin(const tuile_scene_t *scene, uint8_t effects) {
    static uint64_t block[8192];
    const tuile_config_t config = config_of(effects);
    tuile_t *renderer;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), 0);
    return tuile_begin(renderer, scene);
}

static void layers_must_be_asked_for(void **state) {
    static const tuile_line_t line = {.to = {UNIT, 0, 0}};
    static uint64_t block[8192];
    tuile_sprite_t sprite = square(1);
    tuile_scene_t scene = empty_scene();
    tuile_config_t config = config_of(TUILE_SURFACES);
    tuile_t *renderer;
    (void)state;
    config.edges = TUILE_EDGES_ALL;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_ERROR_ARGUMENT);
    scene.line_count = 1;
    assert_int_equal(begin(&scene, TUILE_LAYERS), TUILE_ERROR_ARGUMENT); /* lines is NULL */
    scene.lines = &line;
    assert_int_equal(begin(&scene, TUILE_SURFACES), TUILE_ERROR_EFFECTS);
    assert_int_equal(begin(&scene, TUILE_LAYERS), 0);
    scene.sprites = &sprite;
    scene.line_count = 0;
    scene.sprite_count = 1;
    assert_int_equal(begin(&scene, TUILE_SURFACES), TUILE_ERROR_EFFECTS);
    sprite.width = -1;
    assert_int_equal(begin(&scene, TUILE_LAYERS), TUILE_ERROR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_of_four_pixels_covers_four_by_four),
        cmocka_unit_test(a_disc_covers_the_pixels_whose_centres_are_in_it),
        cmocka_unit_test(a_texture_is_spread_over_the_sprite),
        cmocka_unit_test(faces_before_hide_sprites_and_lines_and_faces_behind_do_not),
        cmocka_unit_test(lines_are_bresenham_s_whichever_way_round),
        cmocka_unit_test(lines_from_behind_the_eye_are_cut_at_the_near_plane),
        cmocka_unit_test(smooth_lines_share_a_pixel_s_worth_between_two),
        cmocka_unit_test(edges_of_a_face_are_a_frame),
        cmocka_unit_test(a_turned_cube_hides_its_back_edges),
        cmocka_unit_test(an_outline_lies_round_the_face),
        cmocka_unit_test(edges_are_the_same_in_all_methods_and_tiles),
        cmocka_unit_test(layers_must_be_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
