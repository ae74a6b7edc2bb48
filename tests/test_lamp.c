/* Coloured and point lights and highlights against their formulas in long double, and planes of light against exact ones. */
#include "support/check.h"
#include "support/frame.h"
#include "support/models.h"
#include "support/stage.h"

#include "../raster/geometry/lamp.h"
#include "../raster/surface/light.h"

#include <math.h>

static uint32_t seed = 12345;

static uint32_t next(void) { return seed = seed * 1664525u + 1013904223u; }

static int32_t between(int32_t low, int32_t high) { return low + (int32_t)((uint64_t)next() * (uint32_t)(high - low + 1) >> 32); }

static void inverse_roots_are_within_their_bound(void **state) {
    (void)state;
    for (unsigned i = 0; i < 200000; i++) {
        const uint64_t any = (uint64_t)next() << 32 | next();
        uint64_t x = i < 64 ? (uint64_t)1 << i : i < 128 ? UINT64_MAX >> (i - 64) : any >> (next() >> 26);
        unsigned half;
        x = x ? x : 1;
        const uint32_t root = lamp_inverse_root(x, &half);
        const long double off = root * ldexpl(1, (int)half - 62) * sqrtl((long double)x) - 1;
        if (fabsl(off) > ldexpl(1, -27)) { fail_msg("%llu: off by %Lg", (unsigned long long)x, off); }
        assert_in_range(root, (1u << 30) - 8, 1u << 31);
    }
}

/* ---- light at a point ---- */

typedef struct world {
    tuile_model_t model;
    tuile_instance_t instance;
    tuile_light_t light[16];
    tuile_scene_t scene;
} world_t;

static void unit3(long double v[3]) {
    const long double length = sqrtl(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
}

/* A small model somewhere, seen from somewhere. step: log2 of model units a step. */
static void world_make(world_t *w, unsigned lights, int step, bool ortho) {
    static const q16_16_t up[3] = {0, 65536, 0};
    memset(w, 0, sizeof *w);
    w->model.step = (tuile_scale_t){1, step};
    w->model.radius = 32767;
    for (int i = 0; i < 3; i++) {
        w->model.offset[i] = between(-1000, 1000);
        w->instance.pose.translation[i] = between(-(1 << 20), 1 << 20);
    }
    w->instance.model = &w->model;
    w->instance.pose.scale = TUILE_SCALE_ONE;
    tuile_rotation(w->instance.pose.rotation, between(0, 2), (bam16_t)next());
    const q16_16_t eye[3] = {between(-(1 << 22), 1 << 22), between(-(1 << 22), 1 << 22), between(1 << 22, 1 << 23)};
    assert_int_equal(tuile_camera_look_at(&w->scene.camera, eye, w->instance.pose.translation, up), 0);
    w->scene.camera.projection = ortho ? TUILE_ORTHOGRAPHIC : TUILE_PERSPECTIVE;
    w->scene.camera.focal_x = w->scene.camera.focal_y = TUILE_Q16(100);
    w->scene.camera.near = TUILE_Q16(1);
    w->scene.camera.far = TUILE_Q16(1000);
    w->scene.lights = w->light;
    w->scene.light_count = (uint8_t)lights;
    w->scene.ambient = (uint8_t)next();
    for (int c = 0; c < 3; c++) {
        w->scene.ambient_colour[c] = (uint8_t)next();
    }
    for (unsigned l = 0; l < lights; l++) {
        tuile_light_t *light = &w->light[l];
        long double way[3];
        light->kind = l % 2 ? TUILE_LIGHT_POINT : TUILE_LIGHT_DIRECTIONAL;
        light->intensity = (uint8_t)(255 / lights);
        light->range = between(1 << 20, 1 << 24);
        for (int i = 0; i < 3; i++) {
            way[i] = between(-1000, 1000) + 0.5L;
            light->position[i] = w->instance.pose.translation[i] + between(-(1 << 21), 1 << 21);
            light->colour[i] = (uint8_t)next();
        }
        unit3(way);
        for (int i = 0; i < 3; i++) {
            light->direction[i] = (q2_14_t)lroundl(way[i] * 16384);
        }
    }
}

static void exact_light(const world_t *w, const lamp_point_t *p, long double sum[4]) {
    const tuile_scene_t *s = &w->scene;
    const long double step = ldexpl(w->model.step.mantissa, w->model.step.exponent);
    long double at[3] = {0}, n[3] = {0}, length = 0, eye[3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const long double r = w->instance.pose.rotation[i][j] * ldexpl(1, -30);
            at[i] += r * step * (w->model.offset[j] + p->at[j] / 256.0L);
            n[i] += r * p->normal[j];
        }
        at[i] += w->instance.pose.translation[i] / 65536.0L;
        length += n[i] * n[i];
    }
    length = sqrtl(length);
    for (int i = 0; i < 3; i++) {
        sum[i] = s->ambient * s->ambient_colour[i] / 255.0L;
        eye[i] = s->camera.projection == TUILE_PERSPECTIVE ? s->camera.eye[i] / 65536.0L - at[i]
                                                           : s->camera.rotation[2][i] * ldexpl(1, -30);
    }
    sum[3] = 0;
    unit3(eye);
    for (unsigned l = 0; l < s->light_count; l++) {
        const tuile_light_t *light = &s->lights[l];
        long double way[3], h[3], falloff = 1, distance2 = 0, dot = 0, shine = 0, greatest = 0;
        for (int i = 0; i < 3; i++) {
            way[i] = light->kind == TUILE_LIGHT_POINT ? light->position[i] / 65536.0L - at[i] : -light->direction[i] / 16384.0L;
            distance2 += way[i] * way[i];
        }
        if (light->kind == TUILE_LIGHT_POINT) {
            const long double range = light->range / 65536.0L, part = 1 - distance2 / (range * range);
            falloff = part > 0 ? part * part : 0;
        }
        unit3(way);
        for (int i = 0; i < 3; i++) {
            dot += way[i] * n[i] / 127;
        }
        const long double sign = dot < 0 && p->both_sides ? -1 : 1;
        dot *= sign;
        if (dot <= 0) { continue; }
        for (int i = 0; i < 3; i++) {
            h[i] = way[i] + eye[i];
        }
        unit3(h);
        for (int i = 0; i < 3; i++) {
            sum[i] += light->intensity * light->colour[i] / 255.0L * falloff * dot;
            shine += sign * h[i] * n[i] / length;
            greatest = light->colour[i] > greatest ? light->colour[i] : greatest;
        }
        if (p->shininess >= 0 && shine > 0) {
            sum[3] += light->intensity * greatest / 255.0L * falloff * powl(shine, 1 << p->shininess);
        }
    }
}

static void light_is_within_its_bound_of_the_formula(void **state) {
    static uint64_t room[256];
    static const int steps[] = {-12, -11, -10, -14};
    lamps_t *lamps = (lamps_t *)(void *)room;
    long double most = 0, most_shine = 0;
    (void)state;
    for (unsigned k = 0; k < CHECK_ROUNDS(4000); k++) {
        world_t w;
        transform_t transform;
        world_make(&w, 1 + k % 16, steps[k % 4], k % 3 == 0);
        if (transform_make(&transform, &(tuile_scene_t){.camera = w.scene.camera}, &w.instance, 100, 100) != 0) { continue; }
        lamps_make(lamps, &w.scene, &w.instance, &transform);
        for (unsigned i = 0; i < 20; i++) {
            lamp_point_t p = {.both_sides = next() >> 31, .shininess = (int8_t)between(-1, 7)};
            long double exact[4], normal[3];
            uint8_t light[4];
            for (int j = 0; j < 3; j++) {
                p.at[j] = between(-32768 * 256, 32767 * 256);
                normal[j] = between(-1000, 1000) + 0.5L;
            }
            unit3(normal);
            for (int j = 0; j < 3; j++) {
                p.normal[j] = (int8_t)lroundl(normal[j] * 127);
            }
            lamps_light(lamps, &p, light);
            exact_light(&w, &p, exact);
            for (int c = 0; c < 4; c++) {
                const long double held = exact[c] > 255 ? 255 : exact[c], off = fabsl(light[c] - held);
                const long double bound = c < 3 ? 0.5L + w.scene.light_count / 32.0L : 0.75L + w.scene.light_count / 32.0L;
                if (off > bound) { fail_msg("round %u, channel %d: %u for %Lg", k, c, light[c], held); }
                if (c < 3 && off > most) { most = off; }
                if (c == 3 && off > most_shine) { most_shine = off; }
            }
        }
    }
    print_message("light off by %.4Lf, highlights by %.4Lf level\n", most, most_shine);
}

/* ---- planes ---- */

static void planes_are_within_their_bound_of_exact_ones(void **state) {
    long double most = 0;
    (void)state;
    for (unsigned k = 0; k < CHECK_ROUNDS(200000); k++) {
        const int32_t reach = k % 3 == 0 ? 32000 : k % 3 == 1 ? 500 : 60;
        surface_corner_t corner[3] = {0};
        uint8_t value[3];
        for (int i = 0; i < 3; i++) {
            corner[i].at.x = (int16_t)between(-reach / 2, reach / 2);
            corner[i].at.y = (int16_t)between(-reach / 2, reach / 2);
            value[i] = (uint8_t)(k % 5 ? next() : (next() >> 31) * 255u);
        }
        if (k % 7 == 0) { corner[2].at.x = (int16_t)((corner[0].at.x + corner[1].at.x) / 2 + 1); }
        if (k % 7 == 0) { corner[2].at.y = (int16_t)((corner[0].at.y + corner[1].at.y) / 2); }
        const int64_t x1 = corner[1].at.x - corner[0].at.x, y1 = corner[1].at.y - corner[0].at.y,
                      x2 = corner[2].at.x - corner[0].at.x, y2 = corner[2].at.y - corner[0].at.y, area = x2 * y1 - x1 * y2;
        if (area == 0) { continue; }
        const light_plane_t plane = light_plane(corner, value);
        for (unsigned i = 0; i < 12; i++) {
            /* a point of the face, then the nearest pixel centre if that is inside */
            const int64_t a = between(0, 1000), b = between(0, 1000 - (int32_t)a);
            const int32_t x = (int32_t)((corner[0].at.x + (a * x1 + b * x2) / 1000) >> 4),
                          y = (int32_t)((corner[0].at.y + (a * y1 + b * y2) / 1000) >> 4);
            const int64_t px = 16 * x + 8 - corner[0].at.x, py = 16 * y + 8 - corner[0].at.y;
            const int64_t w2 = px * y1 - x1 * py, w1 = x2 * py - px * y2;
            const long double b1 = (long double)w1 / area, b2 = (long double)w2 / area;
            if (b1 < 0 || b2 < 0 || b1 + b2 > 1) { continue; }
            const long double exact = value[0] + b1 * (value[1] - value[0]) + b2 * (value[2] - value[0]);
            const uint32_t level = light_held(plane.light + plane.dx * (uint32_t)x + plane.dy * (uint32_t)y);
            const long double off = fabsl(level - exact);
            if (off > 0.5L + 0.125L + 1.0L / 64) { fail_msg("round %u: %u for %Lg", k, level, exact); }
            most = off > most ? off : most;
        }
    }
    print_message("planes off by %.4Lf level\n", most);
}

/* ---- pictures ---- */

static void expect_all_alike(const tuile_scene_t *scene, const tuile_model_t *model, const char *name) {
    for (unsigned shade = 0; shade < 2; shade++) {
        tuile_config_t config = {.width = 96, .height = 80, .tile_height = 8, .effects = TUILE_SURFACES, .shade = (uint8_t)shade};
        uint8_t *expected[2] = {NULL, NULL};
        config.cluster_vertices = model->cluster_vertices_max;
        config.corners = model->corners_max;
        config.tree_depth = model->tree_depth;
        const size_t more = TUILE_LIGHTS_BYTES((size_t)scene->light_count);
        for (unsigned k = 0; k < 20; k++) {
            tuile_config_t c = config;
            c.method = (uint8_t)(k % 5);
            if (k / 5 == 1) { c.tile_width = 32, c.tile_height = 16; }
            const bool small = k / 5 > 1 && (c.method == TUILE_ZBUFFER || c.method == TUILE_TREE);
            const size_t size = small ? frame_least_bytes(&c) + more + (k / 5 - 2) * 3000 : (size_t)1 << 20;
            uint8_t *picture = frame_draw(scene, &c, size, NULL), **first = &expected[c.method == TUILE_TREE];
            if (*first == NULL) {
                *first = picture;
                continue;
            }
            if (memcmp(picture, *first, frame_bytes(&c)) != 0) {
                fail_msg("%s: shade %u, case %u: another picture", name, shade, k);
            }
            free(picture);
        }
        free(expected[0]);
        free(expected[1]);
    }
}

static void all_methods_and_memories_show_the_same_light(void **state) {
    mesh_t mesh;
    model_compiled_t compiled;
    sim_error_t error = {""};
    view_t view;
    view_options_t options = VIEW_OPTIONS_DEFAULT;
    (void)state;
    for (unsigned m = 0; m < 2; m++) {
        const mesh_options_t with = {.tree = true};
        if (m == 0) {
            model_room(&mesh);
            options.has_eye = options.has_at = options.has_near = true;
            options.eye[0] = 0.3, options.eye[1] = 0.4, options.eye[2] = 3.5;
            options.at[0] = -1;
            options.fov = 100;
            options.near = 0.5;
        } else {
            model_torus(&mesh, 24, 10, true);
            options = VIEW_OPTIONS_DEFAULT;
        }
        model_compile_with(&compiled, &mesh, &with);
        mesh_free(&mesh);
        assert_int_equal(view_make(&view, &options, &compiled.model, 96, 80, 1, &error), 0);
        tuile_material_t materials[16];
        for (uint32_t i = 0; i < compiled.model.material_count; i++) {
            materials[i] = tuile_model_material(&compiled.model, i);
            materials[i].specular = 180;
            materials[i].shininess = (uint8_t)(i % 8);
            materials[i].flags |= i % 2 ? TUILE_MATERIAL_TWO_SIDED : 0;
            materials[i].emission[i % 3] = 20;
        }
        view.instance.materials = materials;
        tuile_light_t lights[12] = {{.kind = TUILE_LIGHT_POINT, .intensity = 255, .colour = {255, 200, 100}}};
        lights[0].range = (q16_16_t)(8 * view.unit * 65536);
        lights[0].position[1] = (q16_16_t)(0.5 * view.unit * 65536);
        for (unsigned l = 1; l < 12; l++) {
            lights[l] = view.light;
            lights[l].intensity = 20;
            lights[l].colour[l % 3] = 255;
        }
        view.scene.lights = lights;
        view.scene.light_count = 12;
        view.scene.fog = (tuile_fog_t){TUILE_FOG_EXPONENTIAL, {90, 100, 120}, 0, (q16_16_t)(6 * view.unit * 65536)};
        expect_all_alike(&view.scene, &compiled.model, m ? "torus" : "room");
        model_free(&compiled);
    }
}

static int begin_error(const tuile_scene_t *scene, uint8_t effects) {
    static uint64_t block[16384];
    const tuile_config_t config = {.width = 64, .height = 64, .effects = effects};
    tuile_t *t;
    assert_int_equal(tuile_init(&t, &config, block, sizeof block, NULL), 0);
    return tuile_begin(t, scene);
}

static void what_a_renderer_is_not_laid_out_for_is_refused(void **state) {
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 64, 64);
    tuile_light_t lights[9] = {{.kind = TUILE_LIGHT_POINT, .intensity = 9, .range = 65536}};
    tuile_scene_t s = stage.view.scene;
    s.lights = lights;
    assert_int_equal(begin_error(&s, 0), TUILE_ERROR_EFFECTS);
    assert_int_equal(begin_error(&s, TUILE_SURFACES), TUILE_OK);
    lights[0].range = 0;
    assert_int_equal(begin_error(&s, TUILE_SURFACES), TUILE_ERROR_ARGUMENT);
    lights[0] = (tuile_light_t){.kind = 2};
    assert_int_equal(begin_error(&s, TUILE_SURFACES), TUILE_ERROR_ARGUMENT);
    lights[0] = (tuile_light_t){.colour = {1, 2, 3}};
    assert_int_equal(begin_error(&s, 0), TUILE_ERROR_EFFECTS);
    lights[0] = (tuile_light_t){.colour = {255, 255, 255}};
    assert_int_equal(begin_error(&s, 0), TUILE_OK);
    s.light_count = 9;
    assert_int_equal(begin_error(&s, 0), TUILE_ERROR_ARGUMENT);
    assert_int_equal(begin_error(&s, TUILE_SURFACES), TUILE_OK);
    s.light_count = 1;
    s.fog = (tuile_fog_t){TUILE_FOG_LINEAR, {0}, 1, 2};
    assert_int_equal(begin_error(&s, 0), TUILE_ERROR_EFFECTS);
    assert_int_equal(begin_error(&s, TUILE_SURFACES), TUILE_OK);
    s.fog.far = 1;
    assert_int_equal(begin_error(&s, TUILE_SURFACES), TUILE_ERROR_ARGUMENT);
    stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inverse_roots_are_within_their_bound),
        cmocka_unit_test(light_is_within_its_bound_of_the_formula),
        cmocka_unit_test(planes_are_within_their_bound_of_exact_ones),
        cmocka_unit_test(all_methods_and_memories_show_the_same_light),
        cmocka_unit_test(what_a_renderer_is_not_laid_out_for_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
