/* Deferred shading: the picture of a scene that wants no effects is the one that is drawn without them, by all methods, in any
 * memory, through any tiles. */
#include "support/check.h"
#include "support/compare.h"
#include "support/frame.h"
#include "support/models.h"
#include "support/stage.h"

#include <math.h>

typedef struct inside {
    model_compiled_t model;
    view_t view;
} inside_t;

/* A room from within: polygons that are not convex, faces that reach behind the eye and far out of the window. */
static void inside_open(inside_t *in, uint16_t width, uint16_t height) {
    mesh_t mesh;
    sim_error_t error = {""};
    view_options_t options = VIEW_OPTIONS_DEFAULT;
    const mesh_options_t with = {.tree = true};
    model_room(&mesh);
    model_compile_with(&in->model, &mesh, &with);
    mesh_free(&mesh);
    options.has_eye = options.has_at = options.has_near = true;
    options.eye[0] = 0.3, options.eye[1] = 0.4, options.eye[2] = 3.5;
    options.at[0] = -1, options.at[1] = 0, options.at[2] = 0;
    options.fov = 100;
    options.near = 0.5;
    assert_int_equal(view_make(&in->view, &options, &in->model.model, width, height, 1, &error), 0);
    view_frame(&in->view, 0);
}

static void compare(const tuile_scene_t *scene, tuile_config_t config, const char *name) {
    for (unsigned shade = 0; shade < 2; shade++) {
        uint8_t *expected[2];
        config.shade = (uint8_t)shade;
        config.effects = shade == 0 ? 0 : TUILE_SURFACES;
        compare_expected(scene, &config, expected);
        config.effects = TUILE_SURFACES;
        compare_all_ways(scene, &config, expected, 0, name);
        free(expected[0]);
        free(expected[1]);
    }
}

static void deferred_torus(void **state) {
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 120, 160);
    tuile_config_t config = stage_panel_config(&stage);
    config.tree_depth = 1000;
    tuile_config_t without = config;
    without.tile_height = 8;
    for (unsigned shade = 0; shade < 2; shade++) {
        uint8_t *expected = NULL;
        for (unsigned m = 0; m < TUILE_TREE; m++) {
            tuile_config_t c = without;
            c.shade = (uint8_t)shade;
            c.method = (uint8_t)m;
            c.effects = shade == 0 && m == 0 ? 0 : TUILE_SURFACES;
            uint8_t *picture = frame_draw(&stage.view.scene, &c, (size_t)4 << 20, NULL);
            if (expected == NULL) {
                expected = picture;
                continue;
            }
            assert_memory_equal(picture, expected, frame_bytes(&c));
            free(picture);
        }
        free(expected);
    }
    stage_close(&stage);
}

static void deferred_room(void **state) {
    inside_t in;
    (void)state;
    inside_open(&in, 120, 90);
    tuile_config_t config = {.width = 120, .height = 90, .tile_height = 6};
    config.cluster_vertices = in.model.model.cluster_vertices_max;
    config.corners = in.model.model.corners_max;
    config.tree_depth = in.model.model.tree_depth;
    compare(&in.view.scene, config, "room");
    model_free(&in.model);
}

/* ---- textures ---- */

/* A model with texture coordinates and one texture that the compiler did not make: s and t follow the positions, and the material
 * is the instance's own. */
typedef struct textured_model {
    stage_t stage;
    tuile_model_t model;
    tuile_material_t material[2];
    int16_t *texcoords;
    uint8_t *bytes; /* of the model, with the table of textures and texels behind them */
} textured_model_t;

enum { SIDE_LOG2 = 6, TEXELS = 5462 * 2 };

static void textured_open(textured_model_t *m, unsigned format, unsigned levels, double texels_a_unit, uint16_t width,
                          uint16_t height) {
    stage_open_torus(&m->stage, width, height);
    m->model = m->stage.compiled.model;
    m->texcoords = malloc(4 * m->model.vertex_count);
    m->bytes = malloc(m->model.size_bytes + 20 + 512 + TEXELS);
    assert_true(m->texcoords && m->bytes);
    memcpy(m->bytes, m->model.bytes, m->model.size_bytes);
    uint8_t *table = m->bytes + m->model.size_bytes;
    const uint32_t palette = m->model.size_bytes + 20, texels = palette + 512;
    memset(table, 0, 20);
    memcpy(table, &texels, 4);
    if (format == TUILE_TEXEL_PALETTE8) { memcpy(table + 4, &palette, 4); }
    table[8] = table[10] = 1 << SIDE_LOG2;
    table[12] = (uint8_t)format;
    table[13] = (uint8_t)levels;
    for (unsigned i = 0; i < 512 + TEXELS; i++) {
        table[20 + i] = (uint8_t)(i * 2654435761u >> 13);
    }
    const double step = ldexp((double)m->model.step.mantissa, m->model.step.exponent);
    for (uint32_t v = 0; v < m->model.vertex_count; v++) {
        const int16_t *q = (const int16_t *)(const void *)m->model.positions + 3 * v;
        m->texcoords[2 * v] = (int16_t)(q[0] * step * texels_a_unit * 16);
        m->texcoords[2 * v + 1] = (int16_t)(q[1] * step * texels_a_unit * 16);
    }
    m->model.bytes = m->bytes;
    m->model.textures = table;
    m->model.texture_count = 1;
    m->model.texcoords = (const uint8_t *)m->texcoords;
    m->material[0] = m->material[1] = (tuile_material_t){.colour = {255, 255, 255}, .alpha = 255, .texture = 0, .uv_bits = 4};
    m->stage.view.instance.model = &m->model;
    m->stage.view.instance.materials = m->material;
}

static void textured_close(textured_model_t *m) {
    free(m->texcoords);
    free(m->bytes);
    stage_close(&m->stage);
}

static void check_textured(const textured_model_t *m, const char *what) {
    const tuile_scene_t *scene = &m->stage.view.scene;
    tuile_config_t config = {.width = 120, .height = 160, .tile_height = 9, .effects = TUILE_SURFACES};
    config.cluster_vertices = m->model.cluster_vertices_max;
    for (unsigned shade = 0; shade < 2; shade++) {
        config.shade = (uint8_t)shade;
        config.method = TUILE_SCANLINE; /* all faces are deferred */
        uint8_t *expected = frame_draw(scene, &config, (size_t)4 << 20, NULL);
        for (unsigned k = 0; k < 6; k++) {
            static const uint8_t methods[] = {TUILE_ZBUFFER, TUILE_ZBUFFER, TUILE_ZBUFFER,
                                              TUILE_ZBUFFER, TUILE_WARNOCK, TUILE_PAINTER};
            tuile_config_t c = config;
            c.method = methods[k];
            if (k == 1) { c.tile_width = c.tile_height = 32; }
            size_t size = (size_t)4 << 20;
            if (k == 2) { size = frame_least_bytes(&c); }
            if (k == 3) { size = frame_least_bytes(&c) + 20000; }
            uint8_t *picture = frame_draw(scene, &c, size, NULL);
            if (memcmp(picture, expected, frame_bytes(&c)) != 0) {
                fail_msg("%s: shade %u, case %u: another picture", what, shade, k);
            }
            free(picture);
        }
        free(expected);
    }
}

static void textures_are_drawn_alike_at_once_and_deferred(void **state) {
    static const double texels_a_unit[] = {20, 100, 700};
    (void)state;
    for (unsigned k = 0; k < 12; k++) {
        textured_model_t m;
        char what[64];
        const unsigned format = k % 2 ? TUILE_TEXEL_PALETTE8 : TUILE_TEXEL_RGB565;
        (void)snprintf(what, sizeof what, "format %u, %u levels, %g texels a unit", format, k % 4 < 2 ? 1 : 7,
                       texels_a_unit[k / 4]);
        textured_open(&m, format, k % 4 < 2 ? 1 : 7, texels_a_unit[k / 4], 120, 160);
        check_textured(&m, what);
        textured_close(&m);
    }
}

/* Faces that are deferred, and others that are drawn at once, through one another and in the very same places, in either order. */
static void faces_drawn_at_once_and_deferred_ones_hide_one_another(void **state) {
    (void)state;
    for (unsigned order = 0; order < 4; order++) {
        textured_model_t m;
        tuile_material_t soft[2], fine[2];
        tuile_instance_t instances[4];
        textured_open(&m, TUILE_TEXEL_RGB565, 1, 20, 120, 160);
        for (unsigned k = 0; k < 2; k++) {
            soft[k] = fine[k] = m.material[k];
            soft[k].flags = TUILE_MATERIAL_BILINEAR;
            fine[k].uv_bits = 6;
        }
        for (unsigned k = 0; k < 4; k++) {
            instances[k] = m.stage.view.instance;
            instances[k].materials = (k ^ order) & 1 ? m.material : (k ^ order) & 2 ? fine : soft;
            if (k >= 2) { /* across the first two, which stand in one place */
                for (unsigned r = 0; r < 3; r++) {
                    const q2_30_t held = instances[k].pose.rotation[r][1];
                    instances[k].pose.rotation[r][1] = -instances[k].pose.rotation[r][2];
                    instances[k].pose.rotation[r][2] = held;
                }
            }
        }
        m.stage.view.scene.instances = instances;
        m.stage.view.scene.instance_count = 4;
        check_textured(&m, "four in one another");
        textured_close(&m);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(deferred_torus),
        cmocka_unit_test(deferred_room),
        cmocka_unit_test(textures_are_drawn_alike_at_once_and_deferred),
        cmocka_unit_test(faces_drawn_at_once_and_deferred_ones_hide_one_another),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
