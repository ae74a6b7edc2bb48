/* Light in colours and fog in whole frames: the same bits by every method, through any tiles and in any memory; and a face before
 * an orthographic camera, whose colour can be told by hand. */
#include "support/check.h"
#include "support/compare.h"
#include "support/frame.h"
#include "support/models.h"
#include "support/stage.h"

#include <math.h>

/* ---- methods, tiles, memory ---- */

enum { LIGHTS = 3 };

typedef struct lit_stage {
    stage_t stage;
    tuile_light_t light[LIGHTS];
    tuile_material_t *materials;
} lit_stage_t;

/* Lights round the sphere of the model: one over the shoulder, two points close to it. */
static void lit_open(lit_stage_t *s) {
    const tuile_model_t *model = &s->stage.compiled.model;
    tuile_scene_t *scene = &s->stage.view.scene;
    const double size = model->radius * ldexp((double)model->step.mantissa, model->step.exponent) * s->stage.view.unit;
    memset(s->light, 0, sizeof s->light);
    s->light[0] = (tuile_light_t){.direction = {-6000, -9000, -12257}, .intensity = 120, .colour = {255, 160, 90}};
    for (unsigned l = 1; l < LIGHTS; l++) {
        s->light[l].kind = TUILE_LIGHT_POINT;
        s->light[l].intensity = 255;
        s->light[l].colour[l] = 255;
        s->light[l].range = (q16_16_t)(size * 1.3 * 65536);
        for (unsigned i = 0; i < 3; i++) {
            s->light[l].position[i] = (q16_16_t)((s->stage.view.at[i] + (i == l ? size * 0.9 : size * 0.2)) * 65536);
        }
    }
    scene->lights = s->light;
    scene->light_count = LIGHTS;
    memcpy(scene->ambient_colour, (const uint8_t[3]){120, 140, 255}, 3);
    s->materials = malloc(sizeof *s->materials * model->material_count);
    assert_non_null(s->materials);
    for (uint32_t m = 0; m < model->material_count; m++) {
        s->materials[m] = tuile_model_material(model, m);
        s->materials[m].specular = 200;
        s->materials[m].shininess = (uint8_t)(m % 8);
        s->materials[m].emission[m % 3] = 30;
        if (m % 2) { s->materials[m].flags |= TUILE_MATERIAL_TWO_SIDED; }
    }
    s->stage.view.instance.materials = s->materials;
}

static void lit_fog(lit_stage_t *s, unsigned kind) {
    const tuile_camera_t *c = &s->stage.view.scene.camera;
    s->stage.view.scene.fog = (tuile_fog_t){(uint8_t)kind, {90, 110, 200}, c->near, kind == TUILE_FOG_LINEAR ? c->far : c->far / 4};
}

static void compare(const tuile_scene_t *scene, tuile_config_t config, const char *name) {
    config.effects = TUILE_SURFACES;
    for (unsigned shade = 0; shade < 2; shade++) {
        uint8_t *expected[2];
        config.shade = (uint8_t)shade;
        compare_expected(scene, &config, expected);
        compare_all_ways(scene, &config, expected, TUILE_LIGHTS_BYTES(scene->light_count), name);
        free(expected[0]);
        free(expected[1]);
    }
}

/* From within: polygons that are not convex, faces that are clipped on all sides. */
static void room_open(lit_stage_t *s, uint16_t width, uint16_t height) {
    mesh_t mesh;
    view_options_t options = VIEW_OPTIONS_DEFAULT;
    const mesh_options_t with = {.tree = true};
    model_room(&mesh);
    model_compile_with(&s->stage.compiled, &mesh, &with);
    mesh_free(&mesh);
    options.has_eye = options.has_at = options.has_near = true;
    options.eye[0] = 0.3, options.eye[1] = 0.4, options.eye[2] = 3.5;
    options.at[0] = -1;
    options.fov = 100;
    options.near = 0.5;
    stage_aim(&s->stage, &options, width, height);
    lit_open(s);
}

static void lit_close(lit_stage_t *s) {
    free(s->materials);
    stage_close(&s->stage);
}

static void lit_compare(const lit_stage_t *s, const char *name) {
    const tuile_model_t *model = &s->stage.compiled.model;
    const tuile_config_t config = {.width = 100,
                                   .height = 76,
                                   .tile_height = 6,
                                   .cluster_vertices = model->cluster_vertices_max,
                                   .corners = model->corners_max,
                                   .tree_depth = model->tree_depth};
    compare(&s->stage.view.scene, config, name);
}

static void all_methods_light_a_room_alike(void **state) {
    lit_stage_t s;
    (void)state;
    room_open(&s, 100, 76);
    lit_compare(&s, "room");
    lit_fog(&s, TUILE_FOG_LINEAR);
    lit_compare(&s, "room in linear fog");
    lit_close(&s);
}

static void all_methods_fog_white_light_alike(void **state) {
    lit_stage_t s;
    (void)state;
    room_open(&s, 100, 76);
    s.stage.view.instance.materials = NULL;
    s.stage.view.scene.light_count = 0;
    memset(s.stage.view.scene.ambient_colour, 0, 3);
    lit_fog(&s, TUILE_FOG_EXPONENTIAL);
    lit_compare(&s, "white room in exponential fog");
    lit_close(&s);
}

/* A wall of many corners that is not convex reaches behind the eye. With nothing but ambient light, of a colour, each face has one
 * colour, whatever the shading; so has it when its vertex colours are the same. */
static void clipped_faces_that_are_not_convex_keep_their_holes(void **state) {
    static const double eyes[][6] = {{0.5, 0.5, -3.2, 0, 0.2, -4.4}, {-1.2, 0.3, -3.7, 3, 0, -4.1}, {1.5, -1, -3.6, -3, 0.8, -4.2}};
    lit_stage_t s;
    (void)state;
    room_open(&s, 100, 76);
    tuile_model_t model = s.stage.compiled.model;
    uint8_t *colours = malloc((size_t)4 * model.vertex_count);
    assert_non_null(colours);
    memset(colours, 255, (size_t)4 * model.vertex_count);
    unsigned clipped = 0;
    for (unsigned k = 0; k < 4 * CHECK_COUNT(eyes); k++) {
        view_options_t options = VIEW_OPTIONS_DEFAULT;
        options.has_eye = options.has_at = options.has_near = true;
        memcpy(options.eye, eyes[k / 4], sizeof options.eye);
        memcpy(options.at, eyes[k / 4] + 3, sizeof options.at);
        options.fov = 100;
        options.near = 0.5;
        stage_aim(&s.stage, &options, 100, 76);
        s.stage.view.instance.two_sided = true;
        s.stage.view.scene.light_count = 0;
        s.stage.view.scene.ambient = 255;
        memcpy(s.stage.view.scene.ambient_colour, (const uint8_t[3]){255, 255, 254}, 3);
        tuile_config_t c = {
            .width = 100, .height = 76, .cluster_vertices = model.cluster_vertices_max, .corners = model.corners_max};
        c.effects = TUILE_SURFACES;
        tuile_stats_t stats;
        s.stage.view.instance.model = &s.stage.compiled.model;
        uint8_t *flat = frame_draw(&s.stage.view.scene, &c, (size_t)1 << 20, &stats);
        clipped += stats.faces_clipped;
        c.shade = (uint8_t)(k % 2);
        model.colours = k / 2 % 2 ? colours : NULL;
        s.stage.view.instance.model = &model;
        uint8_t *other = frame_draw(&s.stage.view.scene, &c, (size_t)1 << 20, NULL);
        if (memcmp(flat, other, frame_bytes(&c)) != 0) { fail_msg("eye %u, case %u: another picture", k / 4, k % 4); }
        free(flat);
        free(other);
    }
    assert_true(clipped > 0);
    free(colours);
    lit_close(&s);
}

/* ---- one face, by hand ---- */

typedef struct wall {
    model_compiled_t compiled;
    tuile_model_t model;
    tuile_instance_t instance;
    tuile_material_t material;
    tuile_light_t light[120];
    tuile_scene_t scene;
    tuile_config_t config;
    uint8_t colours[4 * 4];
} wall_t;

/* A square of 32 pixels before the camera, which fills the window; its colour is 200, 100, 50. */
static void wall_open(wall_t *w) {
    mesh_t mesh;
    static const uint32_t corners[4] = {0, 1, 2, 3};
    memset(w, 0, sizeof *w);
    model_start(&mesh);
    for (unsigned i = 0; i < 4; i++) {
        (void)model_position(&mesh, i == 1 || i == 2 ? 1 : -1, i >= 2 ? 1 : -1, 0);
    }
    model_face(&mesh, corners, 4, model_material(&mesh, 200, 100, 50));
    model_flat_normals(&mesh);
    model_compile(&w->compiled, &mesh);
    w->model = w->compiled.model;
    w->instance = stage_placed(&w->model, 0);
    assert_int_equal(w->model.face_count, 1);
    const uint32_t number = w->model.material_count - 1;
    w->material = tuile_model_material(&w->model, number);
    assert_int_equal(w->material.colour[0], 200);
    w->instance.materials = &w->material;
    w->model.material_count = 1;
    assert_int_equal(number, 0);
    w->scene =
        (tuile_scene_t){.instances = &w->instance, .instance_count = 1, .lights = w->light, .camera = stage_plain_camera(32, 32)};
    for (unsigned l = 0; l < CHECK_COUNT(w->light); l++) {
        w->light[l] = (tuile_light_t){.direction = {0, 0, -TUILE_ONE_Q14}};
    }
    w->config = (tuile_config_t){.width = 32, .height = 32, .format = TUILE_RGB666, .effects = TUILE_SURFACES};
}

static void wall_close(wall_t *w) { model_free(&w->compiled); }

/* The pixel in column x of row 16 by every method: red, green, blue in steps of 1/63, each within `slack` of it. */
static void wall_shaded_has(const wall_t *w, unsigned shade, unsigned x, double red, double green, double blue, int slack) {
    const double exact[3] = {red, green, blue};
    for (unsigned method = 0; method < TUILE_TREE; method++) {
        tuile_config_t c = w->config;
        c.shade = (uint8_t)shade;
        c.method = (uint8_t)method;
        uint8_t *picture = frame_draw(&w->scene, &c, (size_t)1 << 20, NULL);
        for (unsigned i = 0; i < 3; i++) {
            const int is = picture[(16 * 32 + x) * 3 + i] >> 2, want = (int)lround((exact[i] > 255 ? 255 : exact[i]) * 63 / 255);
            if (is < want - slack || is > want + slack) {
                fail_msg("method %u, shade %u, component %u: %d, but it is %d", c.method, c.shade, i, is, want);
            }
        }
        free(picture);
    }
}

static void wall_has(const wall_t *w, unsigned x, double red, double green, double blue, int slack) {
    wall_shaded_has(w, TUILE_FLAT, x, red, green, blue, slack);
    wall_shaded_has(w, TUILE_GOURAUD, x, red, green, blue, slack);
}

/* light: 0 ... 255 each. */
static void wall_is_lit(const wall_t *w, double red, double green, double blue) {
    wall_has(w, 16, 200 * red / 255, 100 * green / 255, 50 * blue / 255, 0);
}

static void light_and_ambient_have_their_colours(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.scene.light_count = 1;
    w.scene.ambient = 51;
    w.light[0].intensity = 102;
    memcpy(w.light[0].colour, (const uint8_t[3]){255, 0, 128}, 3);
    wall_is_lit(&w, 51 + 102, 51, 51 + 102 * 128 / 255.0);
    memcpy(w.scene.ambient_colour, (const uint8_t[3]){0, 255, 100}, 3);
    wall_is_lit(&w, 102, 51, 51 * 100 / 255.0 + 102 * 128 / 255.0);
    w.light[0].direction[2] = TUILE_ONE_Q14; /* from behind */
    wall_is_lit(&w, 0, 51, 51 * 100 / 255.0);
    wall_close(&w);
}

/* Midway to its range a point gives (3/4)^2 of its light, straight before the middle; nothing from its range on. */
static void points_fall_off(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.scene.light_count = 1;
    w.light[0] = (tuile_light_t){.kind = TUILE_LIGHT_POINT, .intensity = 224, .colour = {255, 255, 0}, .range = TUILE_Q16(200)};
    w.light[0].position[2] = TUILE_Q16(100); /* so far that the corners are lit as the middle is */
    wall_is_lit(&w, 126, 126, 0);
    w.light[0].position[2] = TUILE_Q16(200.5);
    wall_is_lit(&w, 0, 0, 0);
    wall_close(&w);
}

static void many_lights_add_up(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.scene.light_count = 100;
    for (unsigned l = 0; l < 100; l++) {
        w.light[l].intensity = 2;
    }
    wall_is_lit(&w, 200, 200, 200);
    w.scene.light_count = 120;
    w.light[119].intensity = 255; /* more than full */
    wall_is_lit(&w, 255, 255, 255);
    wall_close(&w);
}

static void emission_adds_to_the_light(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.scene.ambient = 60;
    memcpy(w.material.emission, (const uint8_t[3]){20, 0, 255}, 3);
    wall_is_lit(&w, 80, 60, 255);
    wall_close(&w);
}

static void unlit_faces_have_their_own_colour(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.scene.ambient = 60;
    w.material.flags = TUILE_MATERIAL_UNLIT;
    wall_is_lit(&w, 255, 255, 255);
    wall_close(&w);
}

/* Light and eye straight before the face: N . H is 1. Interpolated highlights lie white over the light; those of a face in one
 * light are a part of it. */
static void highlights_lie_over_the_light(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.scene.light_count = 1;
    w.light[0].intensity = 100;
    w.material.specular = 102;
    w.material.shininess = 7;
    wall_shaded_has(&w, TUILE_GOURAUD, 16, 200 * 100 / 255.0 + 40, 100 * 100 / 255.0 + 40, 50 * 100 / 255.0 + 40, 1);
    wall_shaded_has(&w, TUILE_FLAT, 16, 200 * 140 / 255.0, 100 * 140 / 255.0, 50 * 140 / 255.0, 1);
    wall_close(&w);
}

/* The wall turned round: drawn for two-sided materials only, and lit as from before. */
static void two_sided_materials_show_their_backs(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.instance.pose.rotation[0][0] = w.instance.pose.rotation[2][2] = -TUILE_ONE_Q30;
    w.scene.ambient = 51;
    w.scene.light_count = 1;
    w.light[0].intensity = 102;
    memcpy(w.scene.background, (const uint8_t[3]){0, 0, 255}, 3);
    wall_has(&w, 16, 0, 0, 255, 0);
    w.material.flags = TUILE_MATERIAL_TWO_SIDED;
    wall_is_lit(&w, 153, 153, 153);
    wall_close(&w);
}

/* Red grows from left to right, green from the bottom up; light multiplies. */
static void vertex_colours_are_interpolated(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.scene.ambient = 255;
    for (unsigned v = 0; v < 4; v++) {
        const int16_t *q = (const int16_t *)(const void *)w.model.positions + 3 * v;
        w.colours[4 * v] = q[0] > 0 ? 255 : 0;
        w.colours[4 * v + 1] = q[1] > 0 ? 200 : 0;
        w.colours[4 * v + 2] = 100;
        w.colours[4 * v + 3] = 255;
    }
    w.model.colours = w.colours;
    w.material.flags = TUILE_MATERIAL_VERTEX_COLOURS;
    for (unsigned x = 0; x < 32; x += 5) {
        wall_has(&w, x, (x + 0.5) / 32 * 255, (15.5 / 32) * 200, 100, 1);
    }
    wall_close(&w);
}

/* The face is 40 units away: halfway through the fog, which takes half; and two half-lives, three quarters. The background stays.
 */
static void fog_takes_its_share(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.scene.ambient = 255;
    w.scene.fog = (tuile_fog_t){TUILE_FOG_LINEAR, {100, 200, 250}, TUILE_Q16(30), TUILE_Q16(50)};
    wall_has(&w, 16, 150, 150, 150, 1);
    w.scene.fog = (tuile_fog_t){TUILE_FOG_EXPONENTIAL, {100, 200, 250}, TUILE_Q16(30), TUILE_Q16(5)};
    wall_has(&w, 16, 125, 175, 200, 1);
    w.scene.instance_count = 0;
    wall_has(&w, 16, 0, 0, 0, 0);
    wall_close(&w);
}

/* Halfway through the fog what is added has lost half of itself, and what multiplies is halfway to white. */
static void blended_faces_fade_to_nothing(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.config.effects = TUILE_LAYERS;
    w.scene.ambient = 255;
    w.scene.fog = (tuile_fog_t){TUILE_FOG_LINEAR, {100, 200, 250}, TUILE_Q16(30), TUILE_Q16(50)};
    w.material.blend = TUILE_BLEND_ADD;
    wall_has(&w, 16, 100, 50, 25, 1);
    w.material.blend = TUILE_BLEND_MULTIPLY;
    memset(w.scene.background, 255, 3);
    wall_has(&w, 16, 227.5, 177.5, 152.5, 1);
    w.config.effects = TUILE_SURFACES; /* nothing is translucent */
    wall_has(&w, 16, 150, 150, 150, 1);
    wall_close(&w);
}

static void sprites_and_lines_are_fogged(void **state) {
    const tuile_sprite_t sprite = {
        .width = TUILE_Q16(8), .height = TUILE_Q16(8), .colour = {200, 100, 50}, .alpha = 255, .pixels = true};
    const tuile_line_t line = {.from = {-65536, 0, 0}, .to = {65536, 0, 0}, .colour = {200, 100, 50}};
    wall_t w;
    (void)state;
    wall_open(&w);
    w.config.effects = TUILE_LAYERS;
    w.scene.instance_count = 0;
    w.scene.fog = (tuile_fog_t){TUILE_FOG_LINEAR, {100, 200, 250}, TUILE_Q16(30), TUILE_Q16(50)};
    w.scene.sprites = &sprite;
    w.scene.sprite_count = 1;
    wall_has(&w, 16, 150, 150, 150, 1);
    w.scene.sprite_count = 0;
    w.scene.lines = &line;
    w.scene.line_count = 1;
    wall_has(&w, 16, 150, 150, 150, 1);
    wall_close(&w);
}

/* Half of a closed thing's faces have two sides: its outline is what it was. */
static void outlines_do_not_mind_two_sided_materials(void **state) {
    stage_t stage;
    mesh_t mesh;
    tuile_material_t materials[2];
    uint8_t *picture[2];
    (void)state;
    model_octahedron(&mesh);
    stage_open(&stage, &mesh, 64, 64);
    tuile_config_t config = stage_panel_config(&stage);
    config.width = config.height = 64;
    config.effects = TUILE_LAYERS;
    config.edges = TUILE_EDGES_OUTLINE;
    memset(config.edge_colour, 255, 3);
    assert_int_equal(stage.compiled.model.material_count, 2);
    stage.view.instance.materials = materials;
    for (unsigned k = 0; k < 2; k++) {
        for (unsigned m = 0; m < 2; m++) {
            materials[m] = tuile_model_material(&stage.compiled.model, m);
        }
        materials[1].flags = k ? TUILE_MATERIAL_TWO_SIDED : 0;
        picture[k] = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
    }
    unsigned different = 0; /* lamps round otherwise than the short way: what counts is where white is */
    for (size_t i = 0; i < frame_bytes(&config); i += 2) {
        different += (picture[0][i] == 255 && picture[0][i + 1] == 255) != (picture[1][i] == 255 && picture[1][i + 1] == 255);
    }
    assert_int_equal(different, 0);
    free(picture[0]);
    free(picture[1]);
    stage_close(&stage);
}

/* ---- what is refused ---- */

static int begun(const wall_t *w, unsigned effects) {
    static uint8_t block[1 << 16] __attribute__((aligned(8)));
    tuile_config_t c = w->config;
    tuile_t *renderer;
    c.format = TUILE_RGB565_BE;
    c.effects = (uint8_t)effects;
    assert_int_equal(tuile_init(&renderer, &c, block, sizeof block, NULL), TUILE_OK);
    const int result = tuile_begin(renderer, &w->scene);
    return result;
}

static void what_is_not_laid_out_for_is_refused(void **state) {
    wall_t w;
    (void)state;
    wall_open(&w);
    w.scene.light_count = 9;
    assert_int_equal(begun(&w, 0), TUILE_ERROR_ARGUMENT);
    assert_int_equal(begun(&w, TUILE_SURFACES), TUILE_OK);
    w.scene.light_count = 1;
    assert_int_equal(begun(&w, 0), TUILE_OK);
    w.light[0].colour[0] = 9;
    assert_int_equal(begun(&w, 0), TUILE_ERROR_EFFECTS);
    w.light[0].colour[0] = 0;
    w.scene.ambient_colour[2] = 9;
    assert_int_equal(begun(&w, 0), TUILE_ERROR_EFFECTS);
    w.scene.ambient_colour[2] = 0;
    w.light[0].kind = TUILE_LIGHT_POINT;
    assert_int_equal(begun(&w, TUILE_SURFACES), TUILE_ERROR_ARGUMENT); /* it reaches nowhere */
    w.light[0].range = 1;
    assert_int_equal(begun(&w, TUILE_SURFACES), TUILE_OK);
    assert_int_equal(begun(&w, 0), TUILE_ERROR_EFFECTS);
    w.light[0].kind = 2;
    assert_int_equal(begun(&w, TUILE_SURFACES), TUILE_ERROR_ARGUMENT);
    w.light[0].kind = TUILE_LIGHT_DIRECTIONAL;
    w.scene.fog = (tuile_fog_t){TUILE_FOG_LINEAR, {1, 2, 3}, 0, 5};
    assert_int_equal(begun(&w, 0), TUILE_ERROR_EFFECTS);
    assert_int_equal(begun(&w, TUILE_SURFACES), TUILE_OK);
    w.scene.fog.far = 0;
    assert_int_equal(begun(&w, TUILE_SURFACES), TUILE_ERROR_ARGUMENT);
    wall_close(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_methods_light_a_room_alike),
        cmocka_unit_test(all_methods_fog_white_light_alike),
        cmocka_unit_test(clipped_faces_that_are_not_convex_keep_their_holes),
        cmocka_unit_test(light_and_ambient_have_their_colours),
        cmocka_unit_test(points_fall_off),
        cmocka_unit_test(many_lights_add_up),
        cmocka_unit_test(emission_adds_to_the_light),
        cmocka_unit_test(unlit_faces_have_their_own_colour),
        cmocka_unit_test(highlights_lie_over_the_light),
        cmocka_unit_test(two_sided_materials_show_their_backs),
        cmocka_unit_test(vertex_colours_are_interpolated),
        cmocka_unit_test(fog_takes_its_share),
        cmocka_unit_test(blended_faces_fade_to_nothing),
        cmocka_unit_test(sprites_and_lines_are_fogged),
        cmocka_unit_test(outlines_do_not_mind_two_sided_materials),
        cmocka_unit_test(what_is_not_laid_out_for_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
