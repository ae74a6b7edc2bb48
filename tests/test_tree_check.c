/* What tuile_model_open makes of display trees, sound and damaged. Trees are written by hand, word by word as geometry/model.h has
 * it, behind a model of six faces, each a cluster of its own. */
#include "../raster/geometry/model.h"
#include "support/check.h"
#include "support/models.h"
#include "support/random.h"

enum { FACES = 6, TREE_MAX = 64 };

static model_compiled_t cube; /* six quads, six clusters: face n is in cluster n */

static void put32(uint8_t *at, uint32_t value) {
    for (int i = 0; i < 4; i++) {
        at[i] = (uint8_t)(value >> 8 * i);
    }
}

/* The cube with this tree behind it. */
static int open_with(const uint32_t *words, size_t count, unsigned depth, tuile_model_t *model) {
    static uint32_t block[16384];
    uint8_t *bytes = (uint8_t *)block;
    const size_t size = cube.size_bytes + 4 * count;
    assert_true(size <= sizeof block && cube.size_bytes % 4 == 0);
    memcpy(bytes, cube.bytes, cube.size_bytes);
    for (size_t i = 0; i < count; i++) {
        put32(bytes + cube.size_bytes + 4 * i, words[i]);
    }
    put32(bytes + MODEL_AT_SIZE, (uint32_t)size);
    put32(bytes + MODEL_AT_TREE, (uint32_t)cube.size_bytes);
    put32(bytes + MODEL_AT_TREE_WORDS, (uint32_t)count);
    bytes[MODEL_AT_TREE_DEPTH] = (uint8_t)depth;
    put32(bytes + MODEL_AT_CRC32, model_crc32(0, bytes + MODEL_AT_VERSION, size - MODEL_AT_VERSION));
    return tuile_model_open(model, bytes, size);
}

static int open_status(const uint32_t *words, size_t count) {
    tuile_model_t model;
    return open_with(words, count, 8, &model);
}

/* ---- words ------------------------------------------------------------------------------------------------- */

#define CONVEX(flags, first, inward, outward) 1u | 1u << 1 | (flags) | (first) << 8, (first) << 1, (inward) << 1, (outward) << 1
#define PLANE(flags, second, nx, ny, nz, d)                                                               \
    1u | 2u << 1 | (flags), (second) << 1, (uint32_t)(nx) << 1, (uint32_t)(ny) << 1, (uint32_t)(nz) << 1, \
        ((uint32_t)(d)&0x3fffffffu) << 1, (uint32_t)((d) < 0 ? -1 : 0) << 1
#define FIRST TREE_FIRST
#define SECOND TREE_SECOND
#define PARENT(at) (at) << 1

/* All faces in one set. */
static const uint32_t one_set[] = {CONVEX(0, 0, 2, 4)};

/* At word 0 a plane with both halves: a set of faces 0 and 1 with a set of face 2 inside it, and, from word 16 on, a set of the
 * others. */
static const uint32_t halves[] = {
    PLANE(FIRST, 16, 1, 0, 0, -5), CONVEX(FIRST, 0, 1, 1), CONVEX(0, 2, 0, 1), PARENT(0), CONVEX(SECOND, 3, 0, 3),
};

/* Planes one behind the other, each with its second half only, and a set. */
static const uint32_t chain[] = {
    PLANE(0, 8, 0, 1, 0, 7), PARENT(0), PLANE(SECOND, 16, 0, 0, 1, 9), PARENT(8), CONVEX(SECOND, 0, 6, 0),
};

static void sound_trees_are_opened(void **state) {
    (void)state;
    tuile_model_t model;
    assert_int_equal(open_with(one_set, CHECK_COUNT(one_set), 1, &model), TUILE_OK);
    assert_int_equal(model.tree_words, 4);
    assert_int_equal(model.tree_depth, 1);
    assert_non_null(model.tree);
    assert_int_equal(open_with(halves, CHECK_COUNT(halves), 3, &model), TUILE_OK);
    assert_int_equal(open_with(chain, CHECK_COUNT(chain), 3, &model), TUILE_OK);
    assert_int_equal(cube.model.tree == NULL, true);
}

/* Changes one word of a tree and expects it to be refused. */
static void refuse(const uint32_t *tree, size_t count, size_t at, uint32_t value, const char *what) {
    uint32_t words[TREE_MAX];
    memcpy(words, tree, count * sizeof *words);
    assert_true(at < count && words[at] != value);
    words[at] = value;
    if (open_status(words, count) != TUILE_ERROR_MODEL) { fail_msg("%s was let pass", what); }
}

#define REFUSE(tree, at, value, what) refuse(tree, CHECK_COUNT(tree), at, value, what)

static void cycles_and_strays_are_refused(void **state) {
    (void)state;
    REFUSE(chain, 1, 0u << 1, "a second child before its parent, and no child at all");
    REFUSE(chain, 9, 8u << 1, "a node that is its own child");
    REFUSE(chain, 9, 1u << 1, "a child above its parent");
    REFUSE(chain, 1, 16u << 1, "two parents with one child, and a node without one");
    REFUSE(chain, 15, 0u << 1, "a child that names another's parent");
    REFUSE(chain, 1, 9u << 1, "a child in the middle of a node");
    REFUSE(halves, 1, 11u << 1, "a second child that is the first of another");
    REFUSE(halves, 1, 0, "a half that no plane has");
    REFUSE(halves, 15, 7u << 1, "a convex set as parent of a second half");
    REFUSE(halves, 1, 1000u << 1, "a child behind the end");
    REFUSE(halves, 7, halves[7] & ~FIRST, "a node nobody leads to");
    REFUSE(halves, 16, halves[16] | FIRST, "a child behind the end");
    REFUSE(halves, 16, halves[16] & ~SECOND, "a second child that does not say so");
    REFUSE(halves, 7, halves[7] | SECOND, "a first child that says it is a second");
}

static void faces_out_of_range_twice_or_missing_are_refused(void **state) {
    (void)state;
    REFUSE(one_set, 1, 1u << 1, "a set that does not begin with the first face");
    REFUSE(one_set, 2, 1u << 1, "a face missing");
    REFUSE(one_set, 3, 5u << 1, "a face too many");
    REFUSE(one_set, 2, 0x7fffffffu << 1, "a number of faces that wraps");
    REFUSE(one_set, 0, one_set[0] | 1u << 8, "the wrong cluster");
    REFUSE(one_set, 0, one_set[0] | 0xffffffu << 8, "a cluster out of range");
    REFUSE(halves, 12, 1u << 1, "a face twice");
    REFUSE(halves, 12, 3u << 1, "a face left out");
    REFUSE(halves, 18, 1u << 1, "a face twice, one missing");
    const uint32_t nothing[] = {CONVEX(FIRST, 0, 0, 0), CONVEX(0, 0, 6, 0)};
    assert_int_equal(open_status(nothing, CHECK_COUNT(nothing)), TUILE_ERROR_MODEL);
}

static void words_that_are_no_nodes_are_refused(void **state) {
    (void)state;
    REFUSE(one_set, 0, one_set[0] & ~1u, "a node without its bit");
    REFUSE(one_set, 2, one_set[2] | 1u, "a value with the bit of a node");
    REFUSE(one_set, 0, (one_set[0] & ~6u), "kind 0");
    REFUSE(one_set, 0, one_set[0] | 6u, "kind 3");
    REFUSE(one_set, 0, one_set[0] | 0x20u, "a bit that means nothing");
    REFUSE(halves, 15, halves[15] | 1u, "a parent with the bit of a node");
    REFUSE(halves, 0, halves[0] | 1u << 8, "a plane with a cluster");
    REFUSE(halves, 2, 0, "a plane without a normal");
    REFUSE(halves, 2, (uint32_t)(1 << 30) << 1, "a normal beyond 30 bits");
    REFUSE(halves, 3, (uint32_t) - (1 << 30) << 1, "a normal beyond 30 bits");
    REFUSE(halves, 6, (uint32_t)(1 << 18) << 1, "a distance beyond 48 bits");
    REFUSE(halves, 6, (uint32_t)(-(1 << 18) - 1) << 1, "a distance beyond 48 bits");
    tuile_model_t model;
    assert_int_equal(open_with(one_set, CHECK_COUNT(one_set), 0, &model), TUILE_ERROR_MODEL); /* a depth of 0 */
    for (size_t count = 0; count < CHECK_COUNT(halves); count++) { /* cut short: the set of the first half may end a tree */
        assert_int_equal(open_status(halves, count), TUILE_ERROR_MODEL);
    }
    uint32_t longer[CHECK_COUNT(one_set) + 1] = {CONVEX(0, 0, 2, 4), 0};
    assert_int_equal(open_status(longer, CHECK_COUNT(longer)), TUILE_ERROR_MODEL);
    longer[CHECK_COUNT(one_set)] = 1;
    assert_int_equal(open_status(longer, CHECK_COUNT(longer)), TUILE_ERROR_MODEL);
}

/* ---- whatever opens is a tree -------------------------------------------------------------------------------- */

static uint32_t word_at(const tuile_model_t *model, uint32_t at) {
    assert_true(at < model->tree_words);
    return model_u32(model->tree + 4 * (size_t)at);
}

/* Walks all nodes and counts how often each face is named. Fails when a node is met twice. */
static void walk(const tuile_model_t *model, uint32_t at, bool *met, unsigned *named) {
    for (;;) {
        const uint32_t word = word_at(model, at);
        assert_false(met[at]);
        met[at] = true;
        assert_int_equal(word & 1u, 1);
        const bool convex = (word >> 1 & 3u) == 1;
        if (convex) {
            const uint32_t first = word_at(model, at + 1) / 2, count = word_at(model, at + 2) / 2 + word_at(model, at + 3) / 2;
            for (uint32_t f = first; f < first + count; f++) {
                assert_true(f < FACES);
                named[f]++;
            }
        } else if (word_at(model, at + 1) != 0) {
            walk(model, word_at(model, at + 1) / 2, met, named);
        }
        if (!(word & FIRST)) { return; }
        at += convex ? 4 : 7;
    }
}

static void damaged_trees_are_refused_or_still_trees(void **state) {
    (void)state;
    static const struct {
        const uint32_t *words;
        size_t count;
    } trees[] = {{one_set, CHECK_COUNT(one_set)}, {halves, CHECK_COUNT(halves)}, {chain, CHECK_COUNT(chain)}};
    random_source_t random = random_seed(11);
    unsigned opened = 0, refused = 0;
    for (unsigned round = 0; round < CHECK_ROUNDS(200000); round++) {
        uint32_t words[TREE_MAX];
        const unsigned which = (unsigned)random_between(&random, 0, 2);
        const size_t count = trees[which].count;
        memcpy(words, trees[which].words, count * sizeof *words);
        for (int changes = random_between(&random, 1, 3); changes > 0; changes--) {
            const size_t at = (size_t)random_between(&random, 0, (int32_t)count - 1);
            switch (random_between(&random, 0, 2)) {
            case 0: words[at] ^= 1u << random_between(&random, 0, 31); break;
            case 1: words[at] = (uint32_t)random_between(&random, 0, 40); break;
            default: words[at] = words[random_between(&random, 0, (int32_t)count - 1)]; break;
            }
        }
        tuile_model_t model;
        if (open_with(words, count, 8, &model) != TUILE_OK) {
            refused++;
            continue;
        }
        opened++;
        bool met[TREE_MAX] = {false};
        unsigned named[FACES] = {0};
        walk(&model, 0, met, named);
        for (unsigned f = 0; f < FACES; f++) {
            assert_int_equal(named[f], 1);
        }
    }
    assert_true(opened > 1000 / (CHECK_SANITIZED ? 16 : 1) && refused > opened);
}

static int set_up(void **state) {
    (void)state;
    mesh_t mesh = {0};
    model_cube(&mesh);
    model_compile(&cube, &mesh);
    return cube.model.face_count == FACES && cube.model.cluster_count == FACES ? 0 : -1;
}

static int tear_down(void **state) {
    (void)state;
    model_free(&cube);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_trees_are_opened),
        cmocka_unit_test(cycles_and_strays_are_refused),
        cmocka_unit_test(faces_out_of_range_twice_or_missing_are_refused),
        cmocka_unit_test(words_that_are_no_nodes_are_refused),
        cmocka_unit_test(damaged_trees_are_refused_or_still_trees),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
