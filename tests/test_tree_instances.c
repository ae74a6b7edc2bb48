/* Several models with display trees in one world: an order among them where planes part them, depth's own picture where none does.
 */
#include "support/check.h"
#include "support/frame.h"
#include "support/solids.h"

static solid_model_t cube, ring, octahedron, bar, room;
static const solid_model_t *const kinds[] = {&cube, &ring, &octahedron};

static int set_up(void **state) {
    mesh_t mesh;
    const double low[3] = {-1.5, -0.5, -0.5}, high[3] = {1.5, 0.5, 0.5};
    (void)state;
    model_cube(&mesh);
    solid_model_open(&cube, &mesh, false);
    model_torus(&mesh, 12, 6, true);
    solid_model_open(&ring, &mesh, false);
    model_octahedron(&mesh);
    solid_model_open(&octahedron, &mesh, false);
    model_start(&mesh);
    model_box(&mesh, low, high, model_material(&mesh, 90, 180, 90));
    solid_model_open(&bar, &mesh, false);
    model_room(&mesh);
    solid_model_open(&room, &mesh, false);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    solid_model_close(&cube);
    solid_model_close(&ring);
    solid_model_close(&octahedron);
    solid_model_close(&bar);
    solid_model_close(&room);
    return 0;
}

static uint32_t *draw_ids(const solids_t *solids, tuile_method_t method, tuile_stats_t *stats) {
    tuile_config_t config = solids_config(solids, method);
    config.format = TUILE_FACE_IDS;
    return (uint32_t *)(void *)frame_draw(&solids->scene, &config, 1 << 20, stats);
}

static void random_eye(solids_t *solids, random_source_t *random, double reach) {
    double eye[3], at[3];
    for (unsigned k = 0; k < 3; k++) {
        eye[k] = random_real(random, -reach, reach);
        at[k] = random_real(random, -2, 2);
    }
    solids_look(solids, eye, at);
    if (random_one_in(random, 3)) { solids_orthographic(solids, 5); }
}

/* One in each of some cells of 4 units, in any pose: none of them reaches 2 units from its middle (a cube's corner is sqrt 3 off).
 */
static void models_apart_are_drawn_as_by_depth(void **state) {
    random_source_t random = random_seed(31);
    solids_difference_t total = {0};
    unsigned ordered = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(160); round++) {
        solids_t solids;
        tuile_stats_t stats;
        char name[32];
        unsigned taken = 0;
        const unsigned count = (unsigned)random_between(&random, 2, SOLIDS_MAX);
        solids_start(&solids, 64, 48);
        while (solids.scene.instance_count < count) {
            const unsigned cell = (unsigned)random_between(&random, 0, 26);
            if (taken >> cell & 1) { continue; }
            taken |= 1u << cell;
            tuile_instance_t *instance = solids_add(&solids, kinds[random_between(&random, 0, 2)]);
            solids_place(instance, 4.0 * (cell % 3) - 4, 4.0 * (cell / 3 % 3) - 4, 4.0 * (cell / 9) - 4);
            if (!random_one_in(&random, 3)) { solids_turn(instance, &random, random_one_in(&random, 2)); }
            instance->two_sided = random_one_in(&random, 3);
        }
        random_eye(&solids, &random, 9);
        (void)snprintf(name, sizeof name, "round %u", round);
        solids_check(&solids, name, round % 2 ? TUILE_TIE_LAST : TUILE_TIE_FIRST, &total);
        free(draw_ids(&solids, TUILE_TREE, &stats));
        ordered += stats.instances_sorted == 0;
    }
    print_message("%llu pixels, %llu covered, %llu differ, %llu beside\n", (unsigned long long)total.pixels,
                  (unsigned long long)total.covered, (unsigned long long)total.differ, (unsigned long long)total.beside);
    print_message("%u of %u scenes without a group\n", ordered, (unsigned)CHECK_ROUNDS(160));
    assert_true(ordered * 10 > CHECK_ROUNDS(160) * 9); /* in an order of their own, not as one group in a circle */
    assert_true(total.covered * 10 > total.pixels && total.differ * 500 <= total.covered && total.beside * 10000 <= total.covered);
}

/* All through one another near the origin: one group, and then the picture is the z-buffer's to the last bit. */
static void models_through_one_another_are_a_group(void **state) {
    random_source_t random = random_seed(32);
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(60); round++) {
        solids_t solids;
        tuile_stats_t stats;
        const unsigned count = (unsigned)random_between(&random, 2, 4);
        solids_start(&solids, 64, 48);
        for (unsigned i = 0; i < count; i++) {
            tuile_instance_t *instance = solids_add(&solids, kinds[(round + i) % 3]);
            solids_place(instance, random_real(&random, -0.3, 0.3), random_real(&random, -0.3, 0.3),
                         random_real(&random, -0.3, 0.3));
            solids_turn(instance, &random, random_one_in(&random, 2));
            instance->two_sided = random_one_in(&random, 3);
        }
        random_eye(&solids, &random, 4);
        uint32_t *ids = draw_ids(&solids, TUILE_TREE, &stats), *expected = draw_ids(&solids, TUILE_ZBUFFER, NULL);
        assert_int_equal(stats.instances_sorted, count);
        assert_memory_equal(ids, expected, sizeof *ids * 64 * 48);
        free(ids);
        free(expected);
    }
}

/* A pair through one another with others before and behind it, and a room round all of it: its box holds theirs, so that all are
 * one group with it, and only the pair is without. */
static void groups_and_trees_are_drawn_in_one_picture(void **state) {
    random_source_t random = random_seed(33);
    solids_difference_t total = {0};
    unsigned pairs = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(80); round++) {
        solids_t solids;
        tuile_stats_t stats;
        char name[32];
        solids_start(&solids, 64, 48);
        solids_place(solids_add(&solids, &ring), -0.8, 0.2, -0.8);
        solids_place(solids_add(&solids, &octahedron), 0.9, 0.4, 2.2);
        solids_turn(solids_add(&solids, &cube), &random, round % 2);
        solids_place(&solids.instances[2], -0.5, 0.2, -1.1);
        solids_place(solids_add(&solids, &bar), 0.3, -0.4, -4.8);
        if (round % 4 == 3) { solids_add(&solids, &room)->pose.scale = (tuile_scale_t){2, 0}; }
        random_eye(&solids, &random, 7);
        (void)snprintf(name, sizeof name, "round %u", round);
        solids_check(&solids, name, TUILE_TIE_FIRST, &total);
        free(draw_ids(&solids, TUILE_TREE, &stats));
        /* Others may join the pair where they are said to be before the one and behind the other. */
        assert_in_range(stats.instances_sorted, round % 4 == 3 ? 5 : 2, round % 4 == 3 ? 5 : 4);
        pairs += stats.instances_sorted == 2;
    }
    assert_true(pairs * 2 > CHECK_ROUNDS(80));
    assert_true(total.covered * 10 > total.pixels && total.differ * 500 <= total.covered);
}

/* Bars along x, y and z, each before the next one seen from far along (1, 1, 1), as in the tests of the order of boxes. */
static void bars_in_a_circle_are_a_group(void **state) {
    (void)state;
    solids_t solids;
    tuile_stats_t stats;
    solids_start(&solids, 64, 48);
    for (unsigned i = 0; i < 3; i++) {
        static const double places[3][3] = {{1.5, 0.5, 1.5}, {1.5, 1.5, 0.5}, {0.5, 1.5, 1.5}};
        tuile_instance_t *instance = solids_add(&solids, &bar);
        solids_place(instance, places[i][0], places[i][1], places[i][2]);
        if (i == 1) { tuile_rotation(instance->pose.rotation, 2, 16384); }
        if (i == 2) { tuile_rotation(instance->pose.rotation, 1, 16384); }
    }
    solids_look(&solids, (const double[3]){6, 6, 6}, (const double[3]){1.2, 1.2, 1.2});
    uint32_t *ids = draw_ids(&solids, TUILE_TREE, &stats), *expected = draw_ids(&solids, TUILE_ZBUFFER, NULL);
    assert_int_equal(stats.instances_sorted, 3);
    assert_memory_equal(ids, expected, sizeof *ids * 64 * 48);
    free(ids);
    free(expected);
    solids_look(&solids, (const double[3]){6, 6, -6}, (const double[3]){1.2, 1.2, 1.2});
    ids = draw_ids(&solids, TUILE_TREE, &stats);
    assert_int_equal(stats.instances_sorted, 0);
    free(ids);
}

/* Two cubes in a row along z, and the same the other way round: the sides towards the eye at z = 8 are seen, with their numbers. */
static void ids_count_through_the_instances_as_they_stand_in_the_scene(void **state) {
    (void)state;
    const uint32_t faces = cube.compiled.model.face_count;
    for (unsigned turn = 0; turn < 2; turn++) {
        solids_t solids;
        solids_start(&solids, 64, 48);
        (void)solids_add(&solids, &ring); /* far below: only its faces count */
        solids_place(&solids.instances[0], 0, -90, 0);
        solids_place(solids_add(&solids, &cube), 0, 0, turn ? 0 : -5);
        solids_place(solids_add(&solids, &cube), 0, 0, turn ? -5 : 0);
        solids_look(&solids, (const double[3]){0, 0, 8}, (const double[3]){0, 0, 0});
        uint32_t *ids = draw_ids(&solids, TUILE_TREE, NULL);
        const uint32_t before = ring.compiled.model.face_count + (turn ? 0 : faces), id = ids[24 * 64 + 32];
        assert_in_range(id, before + 1, before + faces);
        assert_int_equal(tuile_model_source_face(&cube.compiled.model, id - 1 - before), 0); /* +z */
        free(ids);
    }
}

static void a_group_in_little_memory_is_right_or_an_error_that_tells_a_size(void **state) {
    static const uint16_t tiles[][2] = {{64, 4}, {16, 16}, {64, 48}};
    unsigned refused = 0, drawn = 0;
    (void)state;
    solids_t solids;
    solids_start(&solids, 64, 48);
    solids_place(solids_add(&solids, &ring), -0.8, 0.2, -0.8);
    solids_place(solids_add(&solids, &ring), -0.5, 0.2, -1.1);
    solids_place(solids_add(&solids, &octahedron), 0.9, 0.4, 2.2);
    tuile_rotation(solids.instances[1].pose.rotation, 0, 9000);
    solids_look(&solids, (const double[3]){1, 2, 5}, (const double[3]){0, 0, 0});
    uint32_t *expected = draw_ids(&solids, TUILE_TREE, NULL);
    for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
        tuile_config_t config = solids_config(&solids, TUILE_TREE);
        config.format = TUILE_FACE_IDS;
        config.tile_width = tiles[i][0];
        config.tile_height = tiles[i][1];
        const size_t least = frame_least_bytes(&config);
        for (unsigned k = 0; k < 40; k++) {
            size_t size_bytes = least + 64 * k * k;
            for (unsigned tries = 0;; tries++) {
                block_t block;
                tuile_t *renderer;
                tuile_tile_t tile;
                block_open(&block, size_bytes);
                uint8_t *picture = frame_blank(&config);
                assert_int_equal(tuile_init(&renderer, &config, block.bytes, size_bytes, NULL), TUILE_OK);
                int result = tuile_begin(renderer, &solids.scene);
                while (result >= 0 && (result = tuile_next(renderer, &tile)) == 1) {
                    frame_paste(picture, &config, &tile);
                }
                if (result == 0) { assert_memory_equal(picture, expected, frame_bytes(&config)); }
                const size_t wanted = tuile_wanted(renderer);
                block_close(&block);
                free(picture);
                if (result == 0) { break; }
                assert_int_equal(result, TUILE_ERROR_MEMORY);
                assert_true(wanted > size_bytes && tries < 20); /* cuts cannot be foreseen: it grows by steps */
                size_bytes = wanted;
                refused++;
            }
            drawn++;
        }
    }
    assert_true(refused > 0 && drawn > 0);
    free(expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_apart_are_drawn_as_by_depth),
        cmocka_unit_test(models_through_one_another_are_a_group),
        cmocka_unit_test(groups_and_trees_are_drawn_in_one_picture),
        cmocka_unit_test(bars_in_a_circle_are_a_group),
        cmocka_unit_test(ids_count_through_the_instances_as_they_stand_in_the_scene),
        cmocka_unit_test(a_group_in_little_memory_is_right_or_an_error_that_tells_a_size),
    };
    return cmocka_run_group_tests_name("tree_instances", tests, set_up, tear_down);
}
