/* Pictures by the display tree, against those by depth of the same models: which face is seen at each pixel, from everywhere. */
#include "../raster/geometry/model.h"
#include "support/check.h"
#include "support/frame.h"
#include "support/solids.h"

#include <math.h>

static void torus(mesh_t *mesh) { model_torus(mesh, 16, 8, true); }
static void torus_of_quads(mesh_t *mesh) { model_torus(mesh, 12, 7, false); }
static void sphere(mesh_t *mesh) { model_sphere(mesh, 6, 11); }
static void staircase(mesh_t *mesh) { model_staircase(mesh, 5); }

/* Bars along x, y and z that go through one another: faces are cut, with corners between whole steps. */
static void crossed_bars(mesh_t *mesh) {
    model_start(mesh);
    for (unsigned k = 0; k < 3; k++) {
        double low[3] = {-0.43 - 0.05 * k, -0.37, -0.31 + 0.04 * k}, high[3] = {0.41, 0.45 + 0.06 * k, 0.33};
        low[1] += 0.03 * k;
        high[0] -= 0.07 * k;
        high[2] += 0.09 * k;
        low[k] = -1.3;
        high[k] = 1.2;
        model_box(mesh, low, high, model_material(mesh, 200 - 60 * k, 90, 60 + 70 * k));
    }
    for (size_t p = 0; p < mesh->position_count; p++) { /* leaning, so that no plane is a round number */
        double *at = mesh->positions[p];
        at[0] += 0.21 * at[1] + (p < 8 ? 0.07 : 0.13) * at[2];
        at[1] += 0.11 * at[2] - 0.03 * at[0];
    }
}

static const struct {
    const char *name;
    void (*make)(mesh_t *mesh);
    double size; /* from the middle to the outside */
} models[] = {{"cube", model_cube, 1},
              {"torus", torus, 1.2},
              {"torus of quads", torus_of_quads, 1.2},
              {"sphere", sphere, 1},
              {"staircase", staircase, 3},
              {"room", model_room, 4},
              {"octahedron", model_octahedron, 1},
              {"crossed bars", crossed_bars, 1}};

/* The middle of the box that holds the model, in its own units. */
static void middle_of(const tuile_model_t *model, double middle[3]) {
    for (unsigned k = 0; k < 3; k++) {
        middle[k] = ldexp(model->step.mantissa, model->step.exponent) * (model->offset[k] + (model->low[k] + model->high[k]) / 2.0);
    }
}

/* A point in the plane of some face, up to 3 units from it. */
static void in_a_plane(const mesh_t *mesh, random_source_t *random, double point[3]) {
    const mesh_face_t *face = &mesh->faces[(size_t)random_between(random, 0, (int32_t)mesh->face_count - 1)];
    const uint32_t *corners = mesh->corners + face->first;
    const double u = random_between(random, -6, 6) / 4.0, v = random_between(random, -6, 6) / 4.0;
    for (unsigned k = 0; k < 3; k++) {
        const double a = mesh->positions[corners[0]][k], b = mesh->positions[corners[1]][k], c = mesh->positions[corners[2]][k];
        point[k] = a + u * (b - a) + v * (c - b);
    }
}

enum { EYE_OUTSIDE, EYE_INSIDE, EYE_IN_A_PLANE, EYES };

/* Every model in many poses under many cameras. */
static void models_are_drawn_as_by_depth_from_everywhere(void **state) {
    random_source_t random = random_seed(71);
    (void)state;
    for (unsigned m = 0; m < CHECK_COUNT(models); m++) {
        solids_difference_t total = {0};
        solid_model_t sided[2]; /* seen from one side, from both */
        mesh_t mesh;
        for (unsigned i = 0; i < 2; i++) {
            models[m].make(&mesh);
            solid_model_open(&sided[i], &mesh, i == 1);
        }
        for (unsigned round = 0; round < CHECK_ROUNDS(300); round++) {
            solids_t solids;
            double eye[3], at[3], point[3];
            char name[128];
            const unsigned where = round % EYES;
            const bool two_sided = round / EYES % 2, mirrored = round / EYES / 2 % 2, plain = random_one_in(&random, 2);
            solids_start(&solids, 64, 48);
            const solid_model_t *model = &sided[two_sided];
            double middle[3];
            middle_of(&model->compiled.model, middle);
            tuile_instance_t *instance = solids_add(&solids, model);
            instance->two_sided = two_sided;
            if (random_one_in(&random, 2)) { instance->pose.scale = (tuile_scale_t){3, -1}; }
            solids_place(instance, random_between(&random, -4, 4), random_between(&random, -4, 4), random_between(&random, -4, 4));
            if (!plain) { solids_turn(instance, &random, mirrored); }
            if (plain && mirrored) { instance->pose.rotation[1][1] = -TUILE_ONE_Q30; }
            const double reach = models[m].size * (where == EYE_OUTSIDE ? 2.5 : 1);
            for (unsigned k = 0; k < 3; k++) {
                point[k] = middle[k] + random_real(&random, -reach, reach);
            }
            if (where == EYE_IN_A_PLANE) { in_a_plane(&model->mesh, &random, point); }
            solids_world(instance, point, eye);
            for (unsigned k = 0; k < 3; k++) {
                point[k] = middle[k] + random_real(&random, -0.5, 0.5) * models[m].size;
            }
            solids_world(instance, point, at);
            solids_look(&solids, eye, at);
            solids.scene.camera.near = random_one_in(&random, 2) ? 1 << 12 : 1 << 15;
            if (random_one_in(&random, 3)) { solids_orthographic(&solids, 12 / models[m].size); }
            (void)snprintf(name, sizeof name, "%s, round %u", models[m].name, round);
            solids_check(&solids, name, random_one_in(&random, 2) ? TUILE_TIE_LAST : TUILE_TIE_FIRST, &total);
        }
        print_message("%s: %llu pixels, %llu covered, %llu differ, %llu beside an edge, %llu ties\n", models[m].name,
                      (unsigned long long)total.pixels, (unsigned long long)total.covered, (unsigned long long)total.differ,
                      (unsigned long long)total.beside, (unsigned long long)total.ties);
        assert_true(total.covered * 10 > total.pixels); /* there was something to see */
        assert_true(total.differ * 500 <= total.covered && total.beside * 10000 <= total.covered);
        solid_model_close(&sided[0]);
        solid_model_close(&sided[1]);
    }
}

/* ---- ties ---------------------------------------------------------------------------------------------------- */

enum { SHEETS = 7, UNIT_PX = 4 };

/* A rectangle of whole units in the plane z = 0. */
typedef struct sheet {
    int left, bottom, right, top;
    bool towards; /* its front looks along +z */
} sheet_t;

/* The sheets, in their order, and two walls across them, seen from their edges. */
static void sheets_make(mesh_t *mesh, const sheet_t sheets[SHEETS], int x, int y) {
    model_start(mesh);
    const uint32_t grey = model_material(mesh, 128, 128, 128);
    for (unsigned i = 0; i < SHEETS; i++) {
        const sheet_t *s = &sheets[i];
        const uint32_t corners[4] = {model_position(mesh, s->left, s->bottom, 0), model_position(mesh, s->right, s->bottom, 0),
                                     model_position(mesh, s->right, s->top, 0), model_position(mesh, s->left, s->top, 0)};
        const uint32_t turned[4] = {corners[3], corners[2], corners[1], corners[0]};
        model_face(mesh, s->towards ? corners : turned, 4, grey);
    }
    const uint32_t upright[4] = {model_position(mesh, x, -5, -2), model_position(mesh, x, 5, -2), model_position(mesh, x, 5, 2),
                                 model_position(mesh, x, -5, 2)};
    const uint32_t lying[4] = {model_position(mesh, -7, y, -3), model_position(mesh, 7, y, -3), model_position(mesh, 7, y, 3),
                               model_position(mesh, -7, y, 3)};
    model_face(mesh, upright, 4, grey);
    model_face(mesh, lying, 4, grey);
}

/* 1 + the sheet that is to be seen at a point of the plane, 0: none. */
static uint32_t sheet_seen(const sheet_t sheets[SHEETS], double x, double y, bool from_behind, bool two_sided, tuile_tie_t tie) {
    uint32_t seen = 0;
    for (uint32_t i = 0; i < SHEETS; i++) {
        const sheet_t *s = &sheets[i];
        if (x < s->left || x > s->right || y < s->bottom || y > s->top) { continue; }
        if (!two_sided && s->towards == from_behind) { continue; }
        if (seen == 0 || tie == TUILE_TIE_LAST) { seen = i + 1; }
    }
    return seen;
}

static void of_faces_in_one_plane_the_first_or_the_last_is_seen(void **state) {
    random_source_t random = random_seed(72);
    size_t cut = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(200); round++) {
        sheet_t sheets[SHEETS];
        solid_model_t model;
        solids_t solids;
        mesh_t mesh;
        const bool two_sided = round % 2, from_behind = round / 2 % 2;
        for (unsigned i = 0; i < SHEETS; i++) {
            const int x = random_between(&random, -6, 3), y = random_between(&random, -5, 3);
            sheets[i] =
                (sheet_t){x, y, random_between(&random, x + 1, 6), random_between(&random, y + 1, 5), random_one_in(&random, 2)};
        }
        sheets_make(&mesh, sheets, random_between(&random, -4, 4), random_between(&random, -3, 3));
        solid_model_open(&model, &mesh, two_sided);
        cut += model.compiled.report.tree.splits;
        solids_start(&solids, 64, 48);
        tuile_instance_t *instance = solids_add(&solids, &model);
        instance->two_sided = two_sided;
        solids_orthographic(&solids, UNIT_PX);
        if (from_behind) { solids.scene.camera.rotation[0][0] = solids.scene.camera.rotation[2][2] = -TUILE_ONE_Q30; }
        const bool mirrored = random_one_in(&random, 2); /* upside down by a reflection: fronts are backs */
        if (mirrored) { instance->pose.rotation[1][1] = -TUILE_ONE_Q30; }
        for (unsigned tie = TUILE_TIE_FIRST; tie <= TUILE_TIE_LAST; tie++) {
            tuile_config_t config = solids_config(&solids, TUILE_TREE);
            config.format = TUILE_FACE_IDS;
            config.tie = (uint8_t)tie;
            uint32_t *ids = (uint32_t *)(void *)frame_draw(&solids.scene, &config, 1 << 16, NULL);
            for (unsigned i = 0; i < 64 * 48; i++) {
                const double right = (i % 64 + 0.5 - 32) / UNIT_PX, up = (24 - (i / 64 + 0.5)) / UNIT_PX;
                const uint32_t expected = sheet_seen(sheets, from_behind ? -right : right, mirrored ? -up : up,
                                                     from_behind != mirrored, two_sided, (tuile_tie_t)tie);
                const uint32_t seen = ids[i] ? tuile_model_source_face(instance->model, ids[i] - 1) + 1 : 0;
                if (seen != expected) {
                    fail_msg("round %u, tie %u: sheet %u at %u,%u instead of %u", round, tie, seen, i % 64, i / 64, expected);
                }
            }
            free(ids);
        }
        solid_model_close(&model);
    }
    assert_true(cut > 0);
}

/* ---- errors -------------------------------------------------------------------------------------------------- */

static void a_model_without_a_tree_is_refused(void **state) {
    (void)state;
    static uint64_t block[8192];
    model_compiled_t plain;
    solid_model_t model;
    solids_t solids;
    mesh_t mesh;
    tuile_t *renderer;
    model_cube(&mesh);
    model_compile(&plain, &mesh);
    model_cube(&mesh);
    solid_model_open(&model, &mesh, false);
    solids_start(&solids, 64, 48);
    (void)solids_add(&solids, &model);
    solids_place(solids_add(&solids, &model), 0, 0, -8);
    tuile_config_t config = solids_config(&solids, TUILE_TREE);
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    for (unsigned i = 0; i < 2; i++) { /* whichever it is */
        solids.instances[i].model = &plain.model;
        assert_int_equal(tuile_begin(renderer, &solids.scene), TUILE_ERROR_TREE);
        solids.instances[i].model = &model.compiled.model;
    }
    assert_int_equal(tuile_begin(renderer, &solids.scene), TUILE_OK);
    assert_int_equal(tuile_end(renderer, NULL), TUILE_OK);
    config.method = TUILE_ZBUFFER; /* needs none */
    solids.instances[0].model = &plain.model;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, &solids.scene), TUILE_OK);
    model_free(&plain);
    solid_model_close(&model);
}

static void a_tree_deeper_than_the_renderer_is_refused(void **state) {
    (void)state;
    static uint64_t block[8192];
    solid_model_t model;
    solids_t solids;
    mesh_t mesh;
    tuile_t *renderer;
    torus(&mesh);
    solid_model_open(&model, &mesh, false);
    const uint16_t depth = model.compiled.model.tree_depth;
    assert_in_range(depth, 3, 64);
    solids_start(&solids, 64, 48);
    (void)solids_add(&solids, &model);
    tuile_config_t config = solids_config(&solids, TUILE_TREE);
    config.tree_depth = (uint16_t)(depth - 1);
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, &solids.scene), TUILE_ERROR_LIMITS);
    config.tree_depth = depth;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, &solids.scene), TUILE_OK);
    config.tree_depth = 0; /* the default of 64 */
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    assert_int_equal(tuile_config(renderer)->tree_depth, 64);
    assert_int_equal(tuile_begin(renderer, &solids.scene), TUILE_OK);
    solid_model_close(&model);
}

static void put32(uint8_t *at, uint32_t value) {
    for (int i = 0; i < 4; i++) {
        at[i] = (uint8_t)(value >> 8 * i);
    }
}

/* A header may tell less than the depth of its tree, which nobody checks: the walk must notice when its stack is full. */
static void a_tree_deeper_than_its_header_says_is_an_error_or_drawn_right(void **state) {
    random_source_t random = random_seed(73);
    solid_model_t model;
    mesh_t mesh;
    unsigned errors = 0, drawn = 0;
    (void)state;
    torus(&mesh);
    solid_model_open(&model, &mesh, false);
    tuile_model_t *opened = &model.compiled.model;
    const uint16_t depth = opened->tree_depth;
    for (uint16_t told = 1; told < depth; told++) {
        uint8_t *bytes = model.compiled.bytes;
        const size_t size = model.compiled.size_bytes;
        bytes[MODEL_AT_TREE_DEPTH] = (uint8_t)told;
        bytes[MODEL_AT_TREE_DEPTH + 1] = (uint8_t)(told >> 8);
        put32(bytes + MODEL_AT_CRC32, model_crc32(0, bytes + MODEL_AT_VERSION, size - MODEL_AT_VERSION));
        assert_int_equal(tuile_model_open(opened, bytes, size), TUILE_OK);
        unsigned errors_here = 0;
        for (unsigned round = 0; round < 16; round++) {
            solids_t solids;
            solids_start(&solids, 64, 48);
            (void)solids_add(&solids, &model);
            double eye[3];
            for (unsigned k = 0; k < 3; k++) {
                eye[k] = random_real(&random, -2, 2);
            }
            solids_look(&solids, eye, (const double[3]){0, 0, 0});
            tuile_config_t config = solids_config(&solids, TUILE_TREE);
            assert_int_equal(config.tree_depth, told);
            config.tile_height = 8;
            block_t block; /* tells of anything beyond it; in the least block the stack ends where vertices begin */
            tuile_t *renderer;
            tuile_tile_t tile;
            int result;
            config.tile_width = round % 2 ? 16 : 64;
            block_open(&block, round % 4 < 2 ? frame_least_bytes(&config) : 1 << 16);
            uint8_t *picture = frame_blank(&config);
            assert_int_equal(tuile_init(&renderer, &config, block.bytes, block.size_bytes, NULL), TUILE_OK);
            assert_int_equal(tuile_begin(renderer, &solids.scene), TUILE_OK);
            while ((result = tuile_next(renderer, &tile)) == 1) {
                frame_paste(picture, &config, &tile);
            }
            assert_int_equal(tuile_end(renderer, NULL), TUILE_OK);
            block_close(&block);
            if (result == 0) {
                tuile_config_t plenty = config;
                opened->tree_depth = plenty.tree_depth = depth;
                uint8_t *expected = frame_draw(&solids.scene, &plenty, 1 << 18, NULL);
                assert_memory_equal(picture, expected, frame_bytes(&config));
                free(expected);
                opened->tree_depth = told;
                drawn++;
            } else {
                assert_int_equal(result, TUILE_ERROR_MODEL);
                errors_here++;
            }
            free(picture);
        }
        errors += errors_here;
        if (told * 4 <= depth) { assert_int_equal(errors_here, 16); }
    }
    assert_true(errors > 0 && drawn > 0);
    solid_model_close(&model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_are_drawn_as_by_depth_from_everywhere),
        cmocka_unit_test(of_faces_in_one_plane_the_first_or_the_last_is_seen),
        cmocka_unit_test(a_model_without_a_tree_is_refused),
        cmocka_unit_test(a_tree_deeper_than_the_renderer_is_refused),
        cmocka_unit_test(a_tree_deeper_than_its_header_says_is_an_error_or_drawn_right),
    };
    return cmocka_run_group_tests_name("tree_draw", tests, NULL, NULL);
}
