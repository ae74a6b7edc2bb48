/* Poses that hang on one another, against products in long double. */
#include "support/check.h"

#include <math.h>

#include "../raster/scene/node.h"
#include "support/random.h"
#include "support/stage.h"

#define NODES 64

static tuile_node_t joint(int32_t parent) {
    tuile_node_t node = {.parent = parent, .instance.pose.scale = TUILE_SCALE_ONE};
    for (unsigned i = 0; i < 3; i++) {
        node.instance.pose.rotation[i][i] = TUILE_ONE_Q30;
    }
    return node;
}

typedef struct exact {
    long double rotation[3][3], scale, translation[3];
    long double way; /* the longest between a node and its parent */
    unsigned depth;
} exact_t;

static exact_t exact_of(const tuile_pose_t *pose) {
    exact_t e = {.scale = ldexpl(pose->scale.mantissa, pose->scale.exponent), .depth = 1};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            e.rotation[i][j] = pose->rotation[i][j] * 0x1p-30L;
        }
        e.translation[i] = pose->translation[i] * 0x1p-16L;
    }
    return e;
}

static exact_t exact_product(const exact_t *a, const exact_t *b) {
    exact_t e = {.scale = a->scale * b->scale, .depth = a->depth + 1};
    long double square = 0;
    for (int i = 0; i < 3; i++) {
        long double way = 0;
        for (int j = 0; j < 3; j++) {
            for (int k = 0; k < 3; k++) {
                e.rotation[i][j] += a->rotation[i][k] * b->rotation[k][j];
            }
            way += a->rotation[i][j] * b->translation[j] * a->scale;
        }
        e.translation[i] = a->translation[i] + way;
        square += way * way;
    }
    e.way = fmaxl(a->way, sqrtl(square));
    return e;
}

static void assert_near(const tuile_pose_t *world, const exact_t *e) {
    const long double n = e->depth, scale = ldexpl(world->scale.mantissa, world->scale.exponent);
    long double squares = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const long double off = world->rotation[i][j] * 0x1p-30L - e->rotation[i][j];
            squares += off * off;
            assert_true(n > 2 || fabsl(off) <= 0.5001L * 0x1p-30L);
        }
        const long double off = fabsl(world->translation[i] * 0x1p-16L - e->translation[i]);
        assert_true(off <= n * 0x1p-17L + (n - 1) * (n - 1) * 0x1p-30L * e->way);
    }
    assert_true(sqrtl(squares) <= 1.51L * n * 0x1p-30L);
    assert_true(fabsl(scale - e->scale) <= n * 0x1p-32L * e->scale);
}

static void world_poses_are_within_their_bounds_of_the_exact_products(void **state) {
    static tuile_node_t nodes[NODES];
    static exact_t exact[NODES];
    random_source_t random = random_seed(84);
    unsigned deepest = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(3000); round++) {
        for (int i = 0; i < NODES; i++) {
            nodes[i] = joint(random_one_in(&random, 8) ? random_between(&random, -1, i - 1) : i - 1);
            tuile_pose_t *pose = &nodes[i].instance.pose;
            tuile_rotation(pose->rotation, random_between(&random, 0, 2), (bam16_t)random_between(&random, 0, 65535));
            /* odd mantissas, near 1 */
            pose->scale =
                (tuile_scale_t){(uint32_t)random_between(&random, 1 << 29, 1 << 30) * 2u + 1u, -30 - random_one_in(&random, 2)};
            for (int k = 0; k < 3; k++) {
                pose->translation[k] = (q16_16_t)random_any_size(&random, 26);
            }
        }
        uint16_t faulty = 999;
        const int result = tuile_nodes_update(nodes, NODES, &faulty);
        const unsigned good = result ? faulty : NODES;
        for (unsigned i = 0; i < NODES; i++) {
            const exact_t local = exact_of(&nodes[i].instance.pose);
            exact[i] = nodes[i].parent < 0 ? local : exact_product(&exact[nodes[i].parent], &local);
            if (i < good) { assert_near(&nodes[i].world, &exact[i]); }
            if (i < good && exact[i].depth > deepest) { deepest = exact[i].depth; }
        }
        if (result) { /* too far out, and not before it must be */
            long double most = 0;
            assert_int_equal(result, TUILE_ERROR_RANGE);
            for (int k = 0; k < 3; k++) {
                most = fmaxl(most, fabsl(exact[good].translation[k]));
            }
            assert_true(most > 32767.9L);
        }
    }
    print_message("deepest chain: %u\n", deepest);
    assert_true(deepest > 20);
}

static void a_hand_turns_with_its_arm(void **state) {
    tuile_node_t nodes[3] = {joint(TUILE_NODE_WORLD), joint(0), joint(1)};
    (void)state;
    /* A shoulder at (1, 2, 3) turned by a quarter about z, twice as large; the elbow 5 along its x; the hand 1 along y. */
    tuile_rotation(nodes[0].instance.pose.rotation, 2, 0x4000);
    nodes[0].instance.pose.scale = (tuile_scale_t){2, 0};
    for (int i = 0; i < 3; i++) {
        nodes[0].instance.pose.translation[i] = (i + 1) << 16;
    }
    nodes[1].instance.pose.translation[0] = 5 << 16;
    nodes[2].instance.pose.translation[1] = 1 << 16;
    nodes[2].instance.pose.scale = (tuile_scale_t){1, -1};
    assert_int_equal(tuile_nodes_update(nodes, 3, NULL), TUILE_OK);
    assert_memory_equal(nodes[1].world.translation, ((const q16_16_t[3]){1 << 16, 12 << 16, 3 << 16}), 12);
    assert_memory_equal(nodes[2].world.translation, ((const q16_16_t[3]){-(1 << 16), 12 << 16, 3 << 16}), 12);
    assert_int_equal(nodes[2].world.scale.mantissa * 2, 2u << -(nodes[2].world.scale.exponent));
    assert_memory_equal(nodes[2].world.rotation, nodes[0].instance.pose.rotation, sizeof nodes[2].world.rotation);
}

static void scales_are_multiplied_to_the_ends_of_their_range(void **state) {
    tuile_node_t nodes[2] = {joint(TUILE_NODE_WORLD), joint(0)};
    (void)state;
    nodes[0].instance.pose.scale = nodes[1].instance.pose.scale = (tuile_scale_t){UINT32_MAX, 400};
    assert_int_equal(tuile_nodes_update(nodes, 2, NULL), TUILE_OK);
    /* (2^32 - 1)^2 = 2^64 - 2^33 + 1, to 32 bits 2^32 - 2 */
    assert_int_equal(nodes[1].world.scale.mantissa, UINT32_MAX - 1);
    assert_int_equal(nodes[1].world.scale.exponent, 832);
    nodes[1].instance.pose.scale.exponent = 600;
    assert_int_equal(tuile_nodes_update(nodes, 2, NULL), TUILE_ERROR_RANGE);
    nodes[0].instance.pose.scale = (tuile_scale_t){1, -600};
    nodes[1].instance.pose.scale = (tuile_scale_t){1, -400};
    assert_int_equal(tuile_nodes_update(nodes, 2, NULL), TUILE_OK);
    nodes[1].instance.pose.scale.exponent = -401;
    assert_int_equal(tuile_nodes_update(nodes, 2, NULL), TUILE_ERROR_RANGE);
    /* 0xffffffff * 0x80000001 = 0x8000000080000000 - 1 ... rounds up to a bit more than 32 */
    nodes[0].instance.pose.scale = (tuile_scale_t){0xfffffffeu, 0};
    nodes[1].instance.pose.scale = (tuile_scale_t){0x80000001u, 0};
    assert_int_equal(tuile_nodes_update(nodes, 2, NULL), TUILE_OK);
    /* 0xfffffffe * 0x80000001 = 0x7fffffff fffffffe = (2^32 - 2^-30) * 2^31: rounds to 2^32 * 2^31 */
    assert_int_equal(nodes[1].world.scale.mantissa, 1u << 31);
    assert_int_equal(nodes[1].world.scale.exponent, 32);
}

static void faults_name_the_node(void **state) {
    tuile_node_t nodes[4];
    uint16_t faulty;
    (void)state;
#define FAULT(change, error, index)                                        \
    do {                                                                   \
        for (int k = 0; k < 4; k++) {                                      \
            nodes[k] = joint(k - 1);                                       \
        }                                                                  \
        assert_int_equal(tuile_nodes_update(nodes, 4, &faulty), TUILE_OK); \
        change;                                                            \
        faulty = 77;                                                       \
        assert_int_equal(tuile_nodes_update(nodes, 4, &faulty), error);    \
        assert_int_equal(faulty, index);                                   \
    } while (0)
    FAULT(nodes[2].parent = 2, TUILE_ERROR_ARGUMENT, 2); /* itself */
    FAULT(nodes[1].parent = 3, TUILE_ERROR_ARGUMENT, 1); /* one behind it, as in a circle */
    FAULT(nodes[3].parent = 4, TUILE_ERROR_ARGUMENT, 3); /* none at all */
    FAULT(nodes[0].parent = -2, TUILE_ERROR_ARGUMENT, 0);
    FAULT(nodes[0].parent = INT32_MAX, TUILE_ERROR_ARGUMENT, 0);
    FAULT(nodes[2].instance.pose.scale.mantissa = 0, TUILE_ERROR_ARGUMENT, 2);
    FAULT(nodes[2].instance.pose.scale.exponent = 1001, TUILE_ERROR_ARGUMENT, 2);
    FAULT(nodes[2].instance.pose.rotation[1][1] = 0, TUILE_ERROR_ARGUMENT, 2);
    FAULT(nodes[3].instance.pose.rotation[0][0] = INT32_MIN, TUILE_ERROR_ARGUMENT, 3);
    FAULT(nodes[3].instance.pose.rotation[0][0] = TUILE_ONE_Q30 + TUILE_ONE_Q30 / 4096, TUILE_ERROR_ARGUMENT, 3);
    FAULT(nodes[1].instance.pose.translation[0] = nodes[2].instance.pose.translation[0] = INT32_MAX, TUILE_ERROR_RANGE, 2);
    FAULT(nodes[0].instance.pose.scale.exponent = 900; nodes[1].instance.pose.translation[2] = -1, TUILE_ERROR_RANGE, 1);
    FAULT((nodes[1].instance.pose.translation[0] = INT32_MIN, nodes[2].instance.pose.translation[0] = -1), TUILE_ERROR_RANGE, 2);
    assert_int_equal(tuile_nodes_update(nodes, 0, NULL), TUILE_OK);
}

static void hidden_nodes_hide_what_hangs_on_them(void **state) {
    model_compiled_t compiled;
    mesh_t mesh;
    tuile_node_t nodes[5];
    tuile_instance_t instances[5];
    tuile_collected_t collected;
    const tuile_camera_t camera = {0};
    (void)state;
    model_cube(&mesh);
    model_compile(&compiled, &mesh);
    for (int k = 0; k < 5; k++) {
        nodes[k] = joint(k == 4 ? 0 : k - 1);
        nodes[k].instance.pose.translation[0] = 1 << 16;
        if (k != 1) { nodes[k].instance.model = &compiled.model; }
    }
    nodes[0].instance.two_sided = true;
    assert_int_equal(tuile_nodes_update(nodes, 5, NULL), TUILE_OK);
    assert_int_equal(tuile_nodes_collect(nodes, 5, &camera, instances, 5, &collected), TUILE_OK);
    assert_int_equal(collected.instances, 4); /* node 1 is a joint */
    assert_int_equal(collected.hidden + collected.too_far, 0);
    assert_int_equal(instances[1].pose.translation[0], 3 << 16); /* node 2 */
    assert_true(instances[0].two_sided && !instances[1].two_sided);
    nodes[1].hidden = true;
    assert_int_equal(tuile_nodes_update(nodes, 5, NULL), TUILE_OK);
    assert_int_equal(tuile_nodes_collect(nodes, 5, &camera, instances, 2, &collected), TUILE_OK);
    assert_int_equal(collected.instances, 2);
    assert_int_equal(collected.hidden, 2);
    assert_int_equal(instances[1].pose.translation[0], 2 << 16); /* node 4 */
    instances[1].pose.translation[0] = 99;
    assert_int_equal(tuile_nodes_collect(nodes, 5, &camera, instances, 1, &collected), TUILE_ERROR_MEMORY);
    assert_int_equal(collected.instances, 2);
    assert_int_equal(instances[1].pose.translation[0], 99);
    model_free(&compiled);
}

/* ---- level of detail ---- */

static void the_model_follows_the_distance(void **state) {
    model_compiled_t compiled[3];
    tuile_node_t node = joint(TUILE_NODE_WORLD);
    tuile_instance_t instance;
    tuile_collected_t collected;
    tuile_camera_t camera = {0};
    (void)state;
    for (unsigned k = 0; k < 3; k++) {
        mesh_t mesh;
        model_sphere(&mesh, 12 - 4 * k, 12 - 4 * k);
        model_compile(&compiled[k], &mesh);
    }
    const tuile_model_t *models[3] = {&compiled[0].model, &compiled[1].model, &compiled[2].model};
    const q16_16_t reach[3] = {10 << 16, 20 << 16, 40 << 16};
    const tuile_lod_t lod = {models, reach, 3, 26}; /* a tenth */
    node.lod = &lod;
    node.level = TUILE_LOD_FRESH;
    static const struct {
        int tenths, level;
    } way[] = {{50, 0},  {99, 0},  {105, 0}, {109, 0}, {112, 1}, {105, 1}, {91, 1},  {89, 0},
               {105, 0}, {250, 2}, {199, 2}, {185, 2}, {179, 1}, {219, 1}, {221, 2}, {405, 2},
               {439, 2}, {442, 3}, {390, 3}, {361, 3}, {358, 2}, {900, 3}, {30, 0}};
    for (size_t i = 0; i < CHECK_COUNT(way); i++) {
        camera.eye[1] = (q16_16_t)(way[i].tenths * 65536LL / 10);
        assert_int_equal(tuile_nodes_update(&node, 1, NULL), TUILE_OK);
        assert_int_equal(tuile_nodes_collect(&node, 1, &camera, &instance, 1, &collected), TUILE_OK);
        if (node.level != way[i].level) { fail_msg("stop %zu: level %u", i, node.level); }
        assert_int_equal(collected.instances, way[i].level < 3);
        assert_int_equal(collected.too_far, way[i].level == 3);
        if (way[i].level < 3) { assert_ptr_equal(instance.model, models[way[i].level]); }
    }
    /* Without hysteresis the borders are exact: the sphere's centre is the origin. */
    const tuile_lod_t plain = {models, reach, 3, 0};
    assert_int_equal(compiled[0].model.offset[1] + compiled[0].model.centre[1], 0);
    for (int k = 0; k < 3; k++) {
        for (int level = 0; level < 5; level++) {
            const uint8_t before = level == 4 ? TUILE_LOD_FRESH : (uint8_t)level;
            camera.eye[1] = reach[k];
            assert_int_equal(tuile_lod_level(&plain, &node.world, &camera, before), k);
            camera.eye[1] = reach[k] + 1;
            assert_int_equal(tuile_lod_level(&plain, &node.world, &camera, before), k + 1);
        }
    }
    const q16_16_t falling[3] = {10, 10, 20}, nothing[3] = {0, 10, 20};
    tuile_lod_t bad = plain;
#define BAD(change)                                                                                               \
    do {                                                                                                          \
        bad = plain;                                                                                              \
        change;                                                                                                   \
        assert_int_equal(tuile_lod_level(&bad, &node.world, &camera, 0), TUILE_ERROR_ARGUMENT);                   \
        node.lod = &bad;                                                                                          \
        assert_int_equal(tuile_nodes_collect(&node, 1, &camera, &instance, 1, &collected), TUILE_ERROR_ARGUMENT); \
    } while (0)
    BAD(bad.count = 0);
    BAD(bad.count = 255);
    BAD(bad.models = NULL);
    BAD(bad.reach = NULL);
    BAD(bad.reach = falling);
    BAD(bad.reach = nothing);
    models[1] = NULL;
    BAD((void)0);
    for (unsigned k = 0; k < 3; k++) {
        model_free(&compiled[k]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(world_poses_are_within_their_bounds_of_the_exact_products),
        cmocka_unit_test(a_hand_turns_with_its_arm),
        cmocka_unit_test(scales_are_multiplied_to_the_ends_of_their_range),
        cmocka_unit_test(faults_name_the_node),
        cmocka_unit_test(hidden_nodes_hide_what_hangs_on_them),
        cmocka_unit_test(the_model_follows_the_distance),
    };
    return cmocka_run_group_tests_name("scene nodes", tests, NULL, NULL);
}
