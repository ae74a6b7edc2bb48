/* Translucent faces: each sample gets its fragments farthest first, whatever the order of submission, the method, the tiles and the
 * memory. The reference asks tuile_pick for the depth of each face alone at each pixel, sorts and blends by itself. */
#include "support/check.h"
#include "support/frame.h"
#include "support/models.h"
#include "support/random.h"
#include "support/stage.h"

#include <stdlib.h>

#define WIDTH 56
#define HEIGHT 40
#define FACES 18

typedef struct crossing {
    model_compiled_t compiled;
    tuile_material_t materials[FACES];
    tuile_instance_t instances[FACES];
    tuile_scene_t scene;
} crossing_t;

static void triangle_model(model_compiled_t *compiled) {
    const mesh_options_t options = {.tree = true};
    mesh_t mesh;
    model_start(&mesh);
    const uint32_t corners[3] = {model_position(&mesh, -2, -2, 0), model_position(&mesh, 2, -1, 0), model_position(&mesh, 0, 2, 0)};
    model_face(&mesh, corners, 3, model_material(&mesh, 255, 255, 255));
    model_compile_with(compiled, &mesh, &options);
    mesh_free(&mesh);
}

static tuile_camera_t camera_at(int32_t z) {
    const q16_16_t eye[3] = {0, 0, z * 65536}, at[3] = {0, 0, 0}, up[3] = {0, 65536, 0};
    tuile_camera_t camera = {.focal_x = 50 << 16,
                             .focal_y = 50 << 16,
                             .centre_x = WIDTH << 15,
                             .centre_y = HEIGHT << 15,
                             .near = 65536,
                             .far = 20 * 65536};
    assert_int_equal(tuile_camera_look_at(&camera, eye, at, up), 0);
    return camera;
}

static void turn(tuile_pose_t *pose, random_source_t *random) {
    q2_30_t a[3][3], b[3][3];
    tuile_rotation(a, 0, (bam16_t)(random_bits(random) >> 20));
    tuile_rotation(b, 1, (bam16_t)(random_bits(random) >> 20));
    for (unsigned i = 0; i < 3; i++) {
        for (unsigned k = 0; k < 3; k++) {
            int64_t sum = 0;
            for (unsigned j = 0; j < 3; j++) {
                sum += (int64_t)a[i][j] * b[j][k] / 2;
            }
            pose->rotation[i][k] = (q2_30_t)(sum >> 29);
        }
        pose->translation[i] = random_between(random, -65536, 65536);
    }
    pose->scale = TUILE_SCALE_ONE;
}

/* Triangles through one another; every fifth is opaque. */
static void crossing_open(crossing_t *c, uint64_t seed) {
    random_source_t random = random_seed(seed);
    memset(c, 0, sizeof *c);
    triangle_model(&c->compiled);
    for (unsigned i = 0; i < FACES; i++) {
        tuile_material_t *m = &c->materials[i];
        *m = (tuile_material_t){.alpha = (uint8_t)(i % 5 == 0 ? 255 : random_between(&random, 40, 240)),
                                .texture = TUILE_NO_TEXTURE,
                                .flags = TUILE_MATERIAL_UNLIT,
                                .blend = (uint8_t)(i % 5 == 0 ? TUILE_BLEND_OVER : random_between(&random, 0, 2))};
        for (unsigned k = 0; k < 3; k++) {
            m->colour[k] = (uint8_t)random_between(&random, 0, 255);
        }
        c->instances[i] = (tuile_instance_t){.model = &c->compiled.model, .two_sided = true, .materials = m};
        turn(&c->instances[i].pose, &random);
    }
    c->scene =
        (tuile_scene_t){.instances = c->instances, .instance_count = FACES, .background = {30, 60, 90}, .camera = camera_at(6)};
}

static tuile_config_t crossing_config(const crossing_t *c, uint8_t format) {
    return (tuile_config_t){.width = WIDTH,
                            .height = HEIGHT,
                            .format = format,
                            .effects = TUILE_LAYERS,
                            .cluster_vertices = c->compiled.model.cluster_vertices_max,
                            .tree_depth = c->compiled.model.tree_depth};
}

/* ---- the reference ---- */

typedef struct fragment {
    int depth; /* 0: none */
    unsigned index;
} fragment_t;

static int farther_first(const void *a, const void *b) {
    const fragment_t *f = a, *g = b;
    return f->depth != g->depth ? (f->depth < g->depth ? -1 : 1) : f->index > g->index ? -1 : 1;
}

static fragment_t pick(const crossing_t *c, unsigned index, unsigned x, unsigned y) {
    static uint64_t block[2048];
    tuile_scene_t alone = c->scene;
    const tuile_config_t config = {.width = WIDTH, .height = HEIGHT, .cluster_vertices = 16};
    tuile_hit_t hit = {0};
    alone.instances = &c->instances[index];
    alone.instance_count = 1;
    const int result = tuile_pick(&alone, &config, (uint16_t)x, (uint16_t)y, block, sizeof block, &hit);
    assert_true(result == 0 || result == 1);
    return (fragment_t){result ? hit.depth : 0, index};
}

static unsigned rounded(unsigned x) { return (2 * x + 255) / 510; } /* x / 255 */

static unsigned blended(unsigned behind, unsigned colour, unsigned alpha, unsigned blend) {
    if (blend == TUILE_BLEND_OVER) { return rounded(alpha * colour + (255 - alpha) * behind); }
    if (blend == TUILE_BLEND_MULTIPLY) { return rounded(behind * (255 - alpha + rounded(alpha * colour))); }
    const unsigned sum = behind + rounded(alpha * colour);
    return sum < 255 ? sum : 255;
}

/* The colour of a pixel; false when two faces are equally deep there. */
static bool reference(const crossing_t *c, unsigned x, unsigned y, unsigned rgb[3]) {
    fragment_t fragments[FACES];
    bool apart = true;
    for (unsigned i = 0; i < FACES; i++) {
        fragments[i] = pick(c, i, x, y);
    }
    qsort(fragments, FACES, sizeof *fragments, farther_first);
    for (unsigned k = 0; k < 3; k++) {
        rgb[k] = c->scene.background[k];
    }
    for (unsigned i = 0; i < FACES; i++) {
        const tuile_material_t *m = c->instances[fragments[i].index].materials;
        if (fragments[i].depth == 0) { continue; }
        if (i > 0 && fragments[i].depth == fragments[i - 1].depth) { apart = false; }
        for (unsigned k = 0; k < 3; k++) {
            rgb[k] = blended(rgb[k], m->colour[k], m->alpha, m->blend);
        }
    }
    return apart;
}

/* ---- tests ---- */

static void fragments_are_blended_by_depth(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 2; seed++) {
        crossing_t c;
        unsigned compared = 0;
        crossing_open(&c, seed);
        const tuile_config_t config = crossing_config(&c, TUILE_RGB666);
        uint8_t *picture = frame_draw(&c.scene, &config, (size_t)1 << 20, NULL);
        for (unsigned y = 0; y < HEIGHT; y++) {
            for (unsigned x = 0; x < WIDTH; x++) {
                unsigned rgb[3];
                const uint8_t *seen = picture + 3 * (y * WIDTH + x);
                if (!reference(&c, x, y, rgb)) { continue; }
                compared++;
                for (unsigned k = 0; k < 3; k++) {
                    const unsigned six = (rgb[k] * 126 + 255) / 510; /* 63 steps, rounded */
                    if (seen[k] >> 2 != six) { fail_msg("seed %u: (%u, %u): %u, not %u", (unsigned)seed, x, y, seen[k] >> 2, six); }
                }
            }
        }
        assert_true(compared > WIDTH * HEIGHT * 9 / 10);
        free(picture);
        model_free(&c.compiled);
    }
}

static void order_of_submission_decides_ties_only(void **state) {
    crossing_t c;
    (void)state;
    crossing_open(&c, 7);
    const tuile_config_t config = crossing_config(&c, TUILE_RGB666);
    uint8_t *expected = frame_draw(&c.scene, &config, (size_t)1 << 20, NULL);
    bool *apart = calloc(WIDTH * HEIGHT, sizeof *apart);
    for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
        unsigned rgb[3];
        apart[i] = reference(&c, i % WIDTH, i / WIDTH, rgb);
    }
    random_source_t random = random_seed(99);
    for (unsigned n = 0; n < 8; n++) {
        for (unsigned i = FACES - 1; i > 0; i--) {
            const unsigned k = (unsigned)random_between(&random, 0, (int32_t)i);
            const tuile_instance_t other = c.instances[i];
            c.instances[i] = c.instances[k];
            c.instances[k] = other;
        }
        uint8_t *picture = frame_draw(&c.scene, &config, (size_t)1 << 20, NULL);
        for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
            if (apart[i] && memcmp(picture + 3 * i, expected + 3 * i, 3) != 0) { fail_msg("shuffle %u, pixel %u", n, i); }
        }
        free(picture);
    }
    free(apart);
    free(expected);
    model_free(&c.compiled);
}

static void all_methods_and_tiles_blend_alike(void **state) {
    static const uint16_t tiles[][2] = {{0, 0}, {16, 8}, {24, 5}, {0, 1}};
    crossing_t c;
    (void)state;
    crossing_open(&c, 3);
    for (unsigned format = 0; format < 2; format++) {
        const tuile_config_t config = crossing_config(&c, format ? TUILE_RGB666 : TUILE_RGB565_LE);
        uint8_t *expected = frame_draw(&c.scene, &config, (size_t)1 << 20, NULL);
        for (unsigned k = 0; k < CHECK_COUNT(tiles) * (TUILE_TREE + 1); k++) {
            tuile_config_t other = config;
            other.method = (uint8_t)(k % (TUILE_TREE + 1));
            other.tile_width = tiles[k / (TUILE_TREE + 1)][0];
            other.tile_height = tiles[k / (TUILE_TREE + 1)][1];
            uint8_t *picture = frame_draw(&c.scene, &other, (size_t)1 << 20, NULL);
            if (memcmp(picture, expected, frame_bytes(&config)) != 0) {
                fail_msg("format %u, method %u, tiles %u", format, other.method, k / (TUILE_TREE + 1));
            }
            free(picture);
        }
        free(expected);
    }
    model_free(&c.compiled);
}

/* A torus seen through, 240 faces in several clusters. */
static void see_through(stage_t *stage, tuile_material_t *material, tuile_instance_t *instance) {
    mesh_t mesh;
    model_torus(&mesh, 20, 12, false);
    stage_open(stage, &mesh, WIDTH, HEIGHT);
    *material = tuile_model_material(&stage->compiled.model, 0);
    material->alpha = 120;
    *instance = stage->view.instance;
    instance->materials = material;
    instance->two_sided = true;
    stage->view.scene.instances = instance;
}

static void memory_changes_no_picture(void **state) {
    stage_t stage;
    tuile_material_t material;
    tuile_instance_t instance;
    (void)state;
    see_through(&stage, &material, &instance);
    for (unsigned m = 0; m < TUILE_TREE; m++) {
        const tuile_config_t config = {.width = WIDTH,
                                       .height = HEIGHT,
                                       .tile_height = 8,
                                       .method = (uint8_t)m,
                                       .shade = TUILE_GOURAUD,
                                       .effects = TUILE_LAYERS,
                                       .cluster_vertices = stage.compiled.model.cluster_vertices_max};
        tuile_stats_t stats;
        uint8_t *expected = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, &stats);
        assert_int_equal(stats.passes, 1);
        for (unsigned k = 0; k < 12; k++) {
            const size_t size = frame_least_bytes(&config) + k * k * 160;
            uint8_t *picture = frame_draw(&stage.view.scene, &config, size, &stats);
            if (memcmp(picture, expected, frame_bytes(&config)) != 0) { fail_msg("method %u, %zu bytes", m, size); }
            free(picture);
        }
        free(expected);
    }
    stage_close(&stage);
}

static void of_two_faces_equally_deep_the_first_is_seen_over_the_other(void **state) {
    crossing_t c;
    (void)state;
    crossing_open(&c, 5);
    const tuile_config_t config = crossing_config(&c, TUILE_RGB666);
    for (unsigned i = 0; i < 2; i++) {
        c.materials[i] = (tuile_material_t){.alpha = 128, .texture = TUILE_NO_TEXTURE, .flags = TUILE_MATERIAL_UNLIT};
        c.materials[i].colour[i] = 255;
        tuile_rotation(c.instances[i].pose.rotation, 2, 0);
        memset(c.instances[i].pose.translation, 0, sizeof c.instances[i].pose.translation);
    }
    c.scene.instance_count = 2;
    memset(c.scene.background, 0, 3);
    uint8_t *picture = frame_draw(&c.scene, &config, (size_t)1 << 20, NULL);
    const uint8_t *seen = picture + 3 * (HEIGHT / 2 * WIDTH + WIDTH / 2);
    /* Green over black: 128; red over that: red 128, green 128 * 127 / 255 = 63.7. In 63 steps: 31.6 and 15.8. */
    assert_int_equal(seen[0] >> 2, 32);
    assert_int_equal(seen[1] >> 2, 16);
    free(picture);
    model_free(&c.compiled);
}

static void faces_of_one_model_may_be_opaque_and_translucent(void **state) {
    for (unsigned m = 0; m <= TUILE_TREE; m++) {
        const mesh_options_t options = {.tree = true};
        tuile_material_t materials[2];
        model_compiled_t compiled;
        mesh_t mesh;
        (void)state;
        model_octahedron(&mesh);
        model_compile_with(&compiled, &mesh, &options);
        mesh_free(&mesh);
        assert_int_equal(compiled.model.material_count, 2);
        for (unsigned i = 0; i < 2; i++) { /* red and blue: red faces are not there */
            materials[i] = tuile_model_material(&compiled.model, i);
            materials[i].flags = TUILE_MATERIAL_UNLIT;
            if (materials[i].colour[0] > materials[i].colour[2]) { materials[i].alpha = 0; }
        }
        tuile_instance_t instance = {.model = &compiled.model, .materials = materials, .two_sided = true};
        random_source_t random = random_seed(4);
        turn(&instance.pose, &random);
        memset(instance.pose.translation, 0, sizeof instance.pose.translation);
        const tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .camera = camera_at(5)};
        const tuile_config_t config = {.width = WIDTH,
                                       .height = HEIGHT,
                                       .method = (uint8_t)m,
                                       .format = TUILE_RGB666,
                                       .effects = TUILE_LAYERS,
                                       .cluster_vertices = compiled.model.cluster_vertices_max,
                                       .tree_depth = compiled.model.tree_depth};
        unsigned red = 0, blue = 0;
        for (unsigned with = 0; with < 2; with++) {
            uint8_t *picture = frame_draw(&scene, &config, (size_t)1 << 20, NULL);
            for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
                red += picture[3 * i] > picture[3 * i + 2];
                blue += picture[3 * i] < picture[3 * i + 2];
            }
            free(picture);
            if (with == 0) { assert_int_equal(red, 0); }
            materials[0].alpha = materials[1].alpha = 255;
        }
        assert_true(red > 50 && blue > 100);
        model_free(&compiled);
    }
}

static void vertex_colours_bring_their_alpha(void **state) {
    static const uint8_t alphas[] = {0, 128, 255};
    (void)state;
    for (unsigned a = 0; a < 3; a++) {
        uint8_t colours[3][4];
        mesh_t mesh;
        model_compiled_t compiled;
        model_start(&mesh);
        const uint32_t corners[3] = {model_position(&mesh, -2, -2, 0), model_position(&mesh, 2, -2, 0),
                                     model_position(&mesh, 0, 2, 0)};
        model_face(&mesh, corners, 3, model_material(&mesh, 255, 255, 255));
        for (unsigned i = 0; i < 3; i++) {
            memset(colours[i], 255, 3);
            colours[i][3] = alphas[a];
        }
        mesh.colours = colours;
        model_compile_with(&compiled, &mesh, NULL);
        mesh.colours = NULL;
        mesh_free(&mesh);
        tuile_material_t material = tuile_model_material(&compiled.model, 0);
        material.flags |= TUILE_MATERIAL_UNLIT;
        tuile_instance_t instance = {
            .model = &compiled.model, .materials = &material, .two_sided = true, .pose = {.scale = TUILE_SCALE_ONE}};
        tuile_rotation(instance.pose.rotation, 2, 0);
        const tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .camera = camera_at(6)};
        const tuile_config_t config = {.width = WIDTH,
                                       .height = HEIGHT,
                                       .format = TUILE_RGB666,
                                       .effects = TUILE_LAYERS,
                                       .cluster_vertices = compiled.model.cluster_vertices_max};
        uint8_t *picture = frame_draw(&scene, &config, (size_t)1 << 20, NULL);
        /* White over black: the alpha itself, in 63 steps. */
        assert_int_equal(picture[3 * (HEIGHT / 2 * WIDTH + WIDTH / 2)] >> 2, (alphas[a] * 126 + 255) / 510);
        free(picture);
        model_free(&compiled);
    }
}

static void without_layers_translucent_faces_are_opaque(void **state) {
    stage_t stage;
    tuile_material_t material;
    tuile_instance_t instance;
    (void)state;
    see_through(&stage, &material, &instance);
    const tuile_config_t config = {
        .width = WIDTH, .height = HEIGHT, .effects = TUILE_SURFACES, .cluster_vertices = stage.compiled.model.cluster_vertices_max};
    uint8_t *seen = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
    material.alpha = 255;
    uint8_t *opaque = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
    assert_memory_equal(seen, opaque, frame_bytes(&config));
    free(seen);
    free(opaque);
    stage_close(&stage);
}

static void alpha_0_shows_what_is_behind(void **state) {
    stage_t stage;
    tuile_material_t material;
    tuile_instance_t instance;
    (void)state;
    see_through(&stage, &material, &instance);
    tuile_config_t config = {
        .width = WIDTH, .height = HEIGHT, .effects = TUILE_LAYERS, .cluster_vertices = stage.compiled.model.cluster_vertices_max};
    material.alpha = 0;
    uint8_t *seen = frame_draw(&stage.view.scene, &config, (size_t)1 << 20, NULL);
    for (size_t i = 2; i < frame_bytes(&config); i += 2) {
        assert_memory_equal(seen, seen + i, 2);
    }
    free(seen);
    stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fragments_are_blended_by_depth),
        cmocka_unit_test(vertex_colours_bring_their_alpha),
        cmocka_unit_test(of_two_faces_equally_deep_the_first_is_seen_over_the_other),
        cmocka_unit_test(faces_of_one_model_may_be_opaque_and_translucent),
        cmocka_unit_test(order_of_submission_decides_ties_only),
        cmocka_unit_test(all_methods_and_tiles_blend_alike),
        cmocka_unit_test(memory_changes_no_picture),
        cmocka_unit_test(without_layers_translucent_faces_are_opaque),
        cmocka_unit_test(alpha_0_shows_what_is_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
