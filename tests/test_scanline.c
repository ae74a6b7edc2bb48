/* The scan-line method (S14): the worked table of document 002, and frames that are those of the z-buffer, byte for byte. */
#include "../raster/fill/active.h"
#include "reference/scene_generator.h"
#include "support/check.h"
#include "support/frame.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/stage.h"

/* ---- the document's list ---- */

#define ROW_MAX 6
#define NONE 0, 0 /* no depth is kept there */
#define UNIT 65536

/* (xc, Δx, Δyc, zc), each a fraction. */
typedef struct entry {
    int x, x_den, dx, dx_den, rows, z, z_den;
} entry_t;

typedef struct row {
    int y;
    unsigned count;
    entry_t entries[ROW_MAX];
} row_t;

/* Polygon (3,9) (6,6) (9,8) (6,2) (4,6) (3,3) (1,5) in the plane x + y + z = 0. */
static const int polygon[][2] = {{3, 9}, {6, 6}, {9, 8}, {6, 2}, {4, 6}, {3, 3}, {1, 5}};
static const row_t table[] = {
    {9, 2, {{3, 1, -1, 2, 4, -12, 1}, {3, 1, 1, 1, 3, NONE}}},
    {8, 4, {{5, 2, -1, 2, 3, -21, 2}, {4, 1, 1, 1, 2, NONE}, {9, 1, -3, 2, 2, -17, 1}, {9, 1, -1, 2, 6, NONE}}},
    {7, 4, {{2, 1, -1, 2, 2, -9, 1}, {5, 1, 1, 1, 1, NONE}, {15, 2, -3, 2, 1, -29, 2}, {17, 2, -1, 2, 5, NONE}}},
    {6,
     6,
     {{3, 2, -1, 2, 1, -15, 2},
      {4, 1, -1, 3, 3, NONE},
      {4, 1, 1, 2, 4, -10, 1},
      {6, 1, 1, 1, 0, NONE},
      {6, 1, -3, 2, 0, -12, 1},
      {8, 1, -1, 2, 4, NONE}}},
    {5, 4, {{1, 1, 1, 1, 2, -6, 1}, {11, 3, -1, 3, 2, NONE}, {9, 2, 1, 2, 3, -19, 2}, {15, 2, -1, 2, 3, NONE}}},
    {4, 4, {{2, 1, 1, 1, 1, -6, 1}, {10, 3, -1, 3, 1, NONE}, {5, 1, 1, 2, 2, -9, 1}, {7, 1, -1, 2, 2, NONE}}},
    {3, 4, {{3, 1, 1, 1, 0, -6, 1}, {3, 1, -1, 3, 0, NONE}, {11, 2, 1, 2, 1, -17, 2}, {13, 2, -1, 2, 1, NONE}}},
    {2, 2, {{6, 1, 1, 2, 0, -8, 1}, {6, 1, -1, 2, 0, NONE}}},
    {1, 0, {{0}}},
};

/* A bow tie in the same plane, by hand: the diagonals change places and rank below y = 4. */
static const int bow_tie[][2] = {{0, 6}, {6, 1}, {6, 6}, {0, 1}};
static const row_t bow_tie_table[] = {
    {6, 4, {{0, 1, 0, 1, 5, -6, 1}, {0, 1, 6, 5, 5, NONE}, {6, 1, -6, 5, 5, -12, 1}, {6, 1, 0, 1, 5, NONE}}},
    {5, 4, {{0, 1, 0, 1, 4, -5, 1}, {6, 5, 6, 5, 4, NONE}, {24, 5, -6, 5, 4, -49, 5}, {6, 1, 0, 1, 4, NONE}}},
    {4, 4, {{0, 1, 0, 1, 3, -4, 1}, {12, 5, 6, 5, 3, NONE}, {18, 5, -6, 5, 3, -38, 5}, {6, 1, 0, 1, 3, NONE}}},
    {3, 4, {{0, 1, 0, 1, 2, -3, 1}, {12, 5, -6, 5, 2, NONE}, {18, 5, 6, 5, 2, -33, 5}, {6, 1, 0, 1, 2, NONE}}},
    {2, 4, {{0, 1, 0, 1, 1, -2, 1}, {6, 5, -6, 5, 1, NONE}, {24, 5, 6, 5, 1, -34, 5}, {6, 1, 0, 1, 1, NONE}}},
    {1, 4, {{0, 1, 0, 1, 0, -1, 1}, {0, 1, -6, 5, 0, NONE}, {6, 1, 6, 5, 0, -7, 1}, {6, 1, 0, 1, 0, NONE}}},
    {0, 0, {{0}}},
};

static void check_entry(int y, int32_t row, unsigned rank, const active_edge_t *e, const active_plane_t *plane,
                        const entry_t *expected) {
    const int64_t d = e->edge.d, back = d - 1 - e->edge.n; /* the crossing is back / d left of pixel x */
    const int64_t x = e->edge.x * d - back, dx = e->edge.q * d + e->edge.r;
    const int64_t z = e->deep ? (int64_t)e->z * d - (int64_t)plane->dx * back : 0;
    const bool deep = expected->z_den != 0;
    if (x * expected->x_den != expected->x * d || dx * expected->dx_den != expected->dx * d || e->row_end - row != expected->rows ||
        e->deep != deep || (deep && z * expected->z_den != expected->z * d * UNIT)) {
        fail_msg("y = %d, rank %u: (%lld/%lld, %lld/%lld, %d, %s %lld/%lld)", y, rank, (long long)x, (long long)d, (long long)dx,
                 (long long)d, e->row_end - row, e->deep ? "z" : "no z", (long long)z, (long long)d * UNIT);
    }
}

/* The document's y points up, rows down: row 0 is the first line of the table. `direction`: which way round the ring goes. */
static void check_table(const int (*points)[2], unsigned count, int direction, const row_t *rows, unsigned row_count) {
    uint64_t memory[100];
    vertex_t vertices[8];
    active_pool_t *pool = (active_pool_t *)(void *)memory;
    const int top = rows[0].y;
    const active_plane_t plane = {(uint64_t)((int64_t)-top * UNIT), (uint64_t)-UNIT, UNIT};
    *pool = (active_pool_t){16, sizeof memory, 0};
    for (unsigned i = 0; i < count; i++) {
        const int *point = points[direction > 0 ? i : count - 1 - i];
        vertices[i] = (vertex_t){(int16_t)(16 * point[0] + 8), (int16_t)(16 * (top - point[1]) + 8), 0};
    }
    const polygon_ring_t ring = {vertices, NULL, NULL, count};
    active_list_t list = {0};
    assert_true(active_begin(pool, &list, &ring, &plane, 0));
    for (unsigned row = 0; row < row_count; row++) {
        uint32_t at = list.first;
        assert_int_equal(rows[row].y, top - (int)row);
        for (unsigned rank = 0; rank < rows[row].count; rank++) {
            if (at == 0) { fail_msg("y = %d: %u entries, not %u", rows[row].y, rank, rows[row].count); }
            const active_edge_t *e = active_at(pool, at);
            check_entry(rows[row].y, (int32_t)row, rank + 1, e, &plane, &rows[row].entries[rank]);
            at = e->next;
        }
        assert_int_equal(at, 0);
        active_step(pool, &list, &plane, (int32_t)row + 1);
        if ((int32_t)row + 1 == list.row_next) { assert_true(active_change(pool, &list, &ring, &plane, (int32_t)row + 1)); }
    }
}

static void the_worked_table_of_the_document_comes_out_entry_by_entry(void **state) {
    (void)state;
    check_table(polygon, CHECK_COUNT(polygon), 1, table, CHECK_COUNT(table));
    check_table(polygon, CHECK_COUNT(polygon), -1, table, CHECK_COUNT(table));
}

static void sides_that_cross_change_places_and_the_depth_goes_to_the_odd_rank(void **state) {
    (void)state;
    check_table(bow_tie, CHECK_COUNT(bow_tie), 1, bow_tie_table, CHECK_COUNT(bow_tie_table));
    check_table(bow_tie, CHECK_COUNT(bow_tie), -1, bow_tie_table, CHECK_COUNT(bow_tie_table));
}

/* Entered at any row, the list is the one that was stepped there. */
static void a_list_may_begin_at_any_row(void **state) {
    (void)state;
    for (unsigned first = 1; first < 7; first++) {
        if (table[first].y == 6 || table[first].y == 3) { continue; } /* sides that have ended do not enter */
        uint64_t memory[100];
        vertex_t vertices[8];
        active_pool_t *pool = (active_pool_t *)(void *)memory;
        const active_plane_t plane = {(uint64_t)((int64_t)-9 * UNIT), (uint64_t)-UNIT, UNIT};
        *pool = (active_pool_t){16, sizeof memory, 0};
        for (unsigned i = 0; i < CHECK_COUNT(polygon); i++) {
            vertices[i] = (vertex_t){(int16_t)(16 * polygon[i][0] + 8), (int16_t)(16 * (9 - polygon[i][1]) + 8), 0};
        }
        const polygon_ring_t ring = {vertices, NULL, NULL, CHECK_COUNT(polygon)};
        active_list_t list = {0};
        assert_true(active_begin(pool, &list, &ring, &plane, (int32_t)first));
        assert_int_equal(list.row_end, 7);
        uint32_t at = list.first;
        for (unsigned rank = 0; rank < table[first].count; rank++) {
            assert_int_not_equal(at, 0);
            const active_edge_t *e = active_at(pool, at);
            check_entry(table[first].y, (int32_t)first, rank + 1, e, &plane, &table[first].entries[rank]);
            at = e->next;
        }
        assert_int_equal(at, 0);
    }
}

static vertex_t corner(random_source_t *random) {
    return (vertex_t){(int16_t)random_between(random, -300, 300), (int16_t)random_between(random, -300, 300), 0};
}

static void the_short_way_in_for_triangles_gives_the_same_list(void **state) {
    random_source_t random = random_seed(14);
    unsigned bent = 0, straight = 0;
    (void)state;
    for (unsigned round = 0; round < 20000; round++) {
        uint64_t memory[2][40];
        vertex_t v[3] = {corner(&random), corner(&random), corner(&random)};
        const int area = (v[2].x - v[0].x) * (v[1].y - v[0].y) - (v[1].x - v[0].x) * (v[2].y - v[0].y);
        const int first = edge_row(v[0].y), end = edge_row(v[1].y > v[2].y ? v[1].y : v[2].y);
        if (area <= 0 || v[0].y > v[1].y || v[0].y > v[2].y || first == end) { continue; }
        const active_plane_t plane = {random_bits(&random), random_bits(&random), random_bits(&random)};
        const polygon_ring_t ring = {v, NULL, NULL, 3};
        const int32_t row = random_between(&random, first, end - 1);
        active_pool_t *pools[2] = {(active_pool_t *)(void *)memory[0], (active_pool_t *)(void *)memory[1]};
        active_list_t lists[2] = {{0}, {0}};
        *pools[0] = *pools[1] = (active_pool_t){16, sizeof memory[0], 0};
        assert_true(active_begin(pools[0], &lists[0], &ring, &plane, row));
        assert_true(active_begin_triangle(pools[1], &lists[1], &v[0], &v[1], &v[2], &plane, row));
        assert_int_equal(lists[0].row_next, lists[1].row_next);
        assert_int_equal(lists[0].row_end, lists[1].row_end);
        uint32_t at[2] = {lists[0].first, lists[1].first};
        for (unsigned rank = 0; rank < 2; rank++) {
            const active_edge_t *a = active_at(pools[0], at[0]), *b = active_at(pools[1], at[1]);
            assert_memory_equal(&a->edge, &b->edge, sizeof a->edge);
            assert_int_equal(a->row_end, b->row_end);
            assert_int_equal(a->end_x, b->end_x);
            assert_int_equal(a->end_y, b->end_y);
            assert_int_equal(a->deep, rank == 0);
            assert_int_equal(b->deep, rank == 0);
            if (rank == 0) { assert_true(a->z == b->z); }
            at[0] = a->next;
            at[1] = b->next;
        }
        assert_int_equal(at[0], 0);
        assert_int_equal(at[1], 0);
        lists[0].row_next == end ? bent++ : straight++;
    }
    assert_true(bent > 100 && straight > 100);
}

/* ---- frames ---- */

typedef struct attempt {
    uint8_t *picture;
    int result;
    size_t wanted;
    tuile_stats_t stats;
} attempt_t;

/* way: 0 forward, else tile by tile in an order of its own. */
static attempt_t draw(const tuile_scene_t *scene, const tuile_config_t *config, size_t size_bytes, unsigned way) {
    attempt_t a = {.picture = frame_blank(config)};
    block_t block;
    tuile_t *renderer;
    tuile_tile_t tile;
    block_open(&block, size_bytes);
    assert_int_equal(tuile_init(&renderer, config, block.bytes, size_bytes, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, scene), TUILE_OK);
    const tuile_config_t *c = tuile_config(renderer);
    const uint32_t columns = (uint32_t)(c->width + c->tile_width - 1) / c->tile_width;
    const uint32_t tiles = columns * ((uint32_t)(c->height + c->tile_height - 1) / c->tile_height);
    for (uint32_t i = 0; way == 0 || i < tiles; i++) {
        if (way) { assert_int_equal(tuile_seek(renderer, way == 1 ? tiles - 1 - i : (i * 1009 + 3) % tiles), TUILE_OK); }
        a.result = tuile_next(renderer, &tile);
        if (a.result != 1) { break; }
        frame_paste(a.picture, config, &tile);
    }
    if (way && a.result == 1) { a.result = 0; }
    a.wanted = tuile_wanted(renderer);
    assert_int_equal(tuile_end(renderer, &a.stats), TUILE_OK);
    block_close(&block);
    return a;
}

static void check_same(const tuile_config_t *c, size_t size_bytes, attempt_t a, const uint8_t *expected, const char *what) {
    if (a.result != 0 || memcmp(a.picture, expected, frame_bytes(c)) != 0) {
        fail_msg("%s: tiles %ux%u, format %u, shade %u, tie %u, %zu bytes: %s", what, c->tile_width, c->tile_height, c->format,
                 c->shade, c->tie, size_bytes, a.result ? tuile_error_text(a.result) : "another picture");
    }
    free(a.picture);
}

/* From the least block upward: the picture, or TUILE_ERROR_MEMORY and a size that gets further. Returns how often that was. */
static unsigned check_memory(const tuile_scene_t *scene, const tuile_config_t *config, const uint8_t *expected, unsigned sizes,
                             const char *what) {
    unsigned failed = 0;
    const size_t least = frame_least_bytes(config);
    for (unsigned k = 0; k < sizes; k++) {
        size_t size = least + (size_t)k * k * 40;
        for (unsigned rounds = 0;; rounds++) {
            const attempt_t a = draw(scene, config, size, 0);
            if (a.result == 0) {
                check_same(config, size, a, expected, what);
                break;
            }
            free(a.picture);
            assert_int_equal(a.result, TUILE_ERROR_MEMORY);
            assert_true(a.wanted > size && rounds < 20);
            const attempt_t b = draw(scene, config, a.wanted, 0);
            free(b.picture);
            if (b.result != 0 && b.stats.tiles <= a.stats.tiles) {
                fail_msg("%s: tiles %ux%u: %zu bytes wanted %zu, which came no further than tile %u", what, config->tile_width,
                         config->tile_height, size, a.wanted, b.stats.tiles);
            }
            size = a.wanted;
            failed++;
        }
    }
    return failed;
}

static const uint16_t tiles[][2] = {{0, 5}, {0, 1}, {32, 32}, {1024, 1024}, {13, 9}, {7, 1}};

/* Everything that a frame may be asked for. Returns how many frames failed for lack of memory. */
static unsigned check_scene(const tuile_scene_t *scene, tuile_config_t config, unsigned sizes, const char *what) {
    unsigned failed = 0;
    for (unsigned kind = 0; kind < 6; kind++) {
        config.format = kind / 2 == 2 ? TUILE_FACE_IDS : TUILE_RGB565_BE;
        config.shade = kind / 2 == 1 ? TUILE_GOURAUD : TUILE_FLAT;
        config.tie = kind % 2 ? TUILE_TIE_LAST : TUILE_TIE_FIRST;
        config.method = TUILE_ZBUFFER;
        config.tile_width = config.tile_height = 0;
        uint8_t *expected = frame_draw(scene, &config, 1 << 21, NULL);
        config.method = TUILE_SCANLINE;
        for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
            config.tile_width = tiles[i][0];
            config.tile_height = tiles[i][1];
            for (unsigned way = 0; way < 3; way++) {
                check_same(&config, 1 << 21, draw(scene, &config, 1 << 21, way), expected, what);
            }
            if (sizes && kind % 3 == 0) { failed += check_memory(scene, &config, expected, sizes, what); }
        }
        free(expected);
    }
    return failed;
}

static const tuile_light_t light = {{-6500, -9750, -11400}, 191};

static unsigned check_seed(uint64_t seed, const scene_generator_t *options, unsigned sizes) {
    char *text = scene_generate(seed, options), name[32];
    test_scene_t scene;
    test_scene_open(&scene, text);
    scene.scene.lights = &light;
    scene.scene.light_count = 1;
    scene.scene.ambient = 60;
    tuile_config_t config = {.width = scene.text.width, .height = scene.text.height};
    if (scene.scene.instance_count) {
        config.cluster_vertices = scene.model.cluster_vertices_max;
        config.corners = scene.model.corners_max;
    }
    (void)snprintf(name, sizeof name, "seed %u", (unsigned)seed);
    const unsigned failed = check_scene(&scene.scene, config, sizes, name);
    test_scene_close(&scene);
    free(text);
    return failed;
}

static void random_scenes_are_those_of_the_z_buffer(void **state) {
    unsigned failed = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= (CHECK_SANITIZED ? 12 : 120); seed++) {
        const scene_generator_t options = {.faces = seed % 3 ? 0 : 30};
        failed += check_seed(seed, &options, seed % 10 ? 0 : 6);
    }
    assert_true(failed > 0 || CHECK_SANITIZED);
}

/* Among them (seed 81) polygons seen from their edge, whose planes leave the range of their snapped corners. */
static void crowded_perspectives_are_those_of_the_z_buffer(void **state) {
    const scene_generator_t options = {.faces = 30, .no_orthographic = true};
    (void)state;
    for (uint64_t seed = CHECK_SANITIZED ? 80 : 70; seed <= (CHECK_SANITIZED ? 82 : 90); seed++) {
        (void)check_seed(seed, &options, 0);
    }
}

static unsigned check_stage(stage_t *stage, unsigned sizes, const char *what) {
    const tuile_model_t *model = &stage->compiled.model;
    const tuile_config_t config = {
        .width = 96, .height = 72, .cluster_vertices = model->cluster_vertices_max, .corners = model->corners_max};
    return check_scene(&stage->view.scene, config, sizes, what);
}

static void models_are_those_of_the_z_buffer(void **state) {
    const unsigned sizes = CHECK_SANITIZED ? 2 : 6;
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_torus(&mesh, 30, 12, true);
    stage_open(&stage, &mesh, 96, 72);
    assert_true(check_stage(&stage, sizes, "torus") > 0);
    stage_close(&stage);
    model_sphere(&mesh, 7, 12);
    stage_open(&stage, &mesh, 96, 72);
    assert_true(check_stage(&stage, sizes, "sphere") > 0);
    stage_close(&stage);
    model_staircase(&mesh, 5);
    stage_open(&stage, &mesh, 96, 72);
    (void)check_stage(&stage, sizes, "staircase");
    stage_close(&stage);
    model_room(&mesh);
    stage_open(&stage, &mesh, 96, 72);
    view_options_t inside = VIEW_OPTIONS_DEFAULT;
    inside.has_eye = inside.has_at = inside.has_near = true;
    inside.eye[2] = 3.5;
    inside.at[0] = 0.3;
    inside.near = 0.01;
    inside.fov = 90;
    stage_aim(&stage, &inside, 96, 72);
    (void)check_stage(&stage, sizes, "room");
    stage_close(&stage);
}

/* Boxes in one another. */
static void a_heap_of_boxes_is_that_of_the_z_buffer(void **state) {
    random_source_t random = random_seed(2);
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_start(&mesh);
    for (unsigned i = 0; i < 120; i++) {
        double low[3], high[3];
        for (unsigned axis = 0; axis < 3; axis++) {
            low[axis] = random_real(&random, -1, 0.8);
            high[axis] = low[axis] + random_real(&random, 0.01, 0.4);
        }
        model_box(&mesh, low, high, model_material(&mesh, 40 * (i % 6) + 40, 60 * (i % 4) + 60, 255));
    }
    stage_open(&stage, &mesh, 40, 30);
    const tuile_model_t *model = &stage.compiled.model;
    const tuile_config_t config = {
        .width = 40, .height = 30, .cluster_vertices = model->cluster_vertices_max, .corners = model->corners_max};
    for (unsigned turn = 0; turn < (CHECK_SANITIZED ? 2 : 6); turn++) {
        tuile_rotation(stage.view.instance.pose.rotation, 1, (bam16_t)(turn * 5461 + turn % 4 * 100));
        (void)check_scene(&stage.view.scene, config, 0, "heap");
    }
    stage_close(&stage);
}

static void check_file(const char *path, bool rotate) {
    stage_t stage = {.compiled = {.bytes = NULL}};
    sim_error_t error = {""};
    if (mesh_load(path, 0, NULL, &stage.compiled.bytes, &stage.compiled.size_bytes, &stage.compiled.report, &error) != 0) {
        fail_msg("%s", error.text);
    }
    assert_int_equal(tuile_model_open(&stage.compiled.model, stage.compiled.bytes, stage.compiled.size_bytes), TUILE_OK);
    stage_aim(&stage, NULL, 96, 72);
    if (rotate) { tuile_rotation(stage.view.instance.pose.rotation, 1, 9000); }
    (void)check_stage(&stage, CHECK_SANITIZED ? 0 : 1, path);
    stage_close(&stage);
}

static void files_are_those_of_the_z_buffer(void **state) {
    const char *spider = getenv("SPIDER");
    (void)state;
    check_file("tests/models/room.obj", true);
    check_file(spider ? spider : "build/models/assimp-testmodels/usr/share/assimp/models/OBJ/spider.obj", false);
}

static void bands_and_shares_of_the_tiles_are_those_of_the_z_buffer(void **state) {
    const tuile_config_t shares[] = {
        {.tile_height = 4, .row_first = 20},
        {.tile_height = 4, .row_first = 13, .row_end = 50},
        {.tile_height = 4, .tile_first = 1, .tile_step = 3},
        {.tile_width = 16, .tile_height = 8, .tile_first = 1, .tile_step = 5},
        {.tile_width = 16, .tile_height = 8, .tile_first = 2, .tile_step = 13},
    };
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_torus(&mesh, 30, 12, true);
    stage_open(&stage, &mesh, 96, 72);
    for (unsigned i = 0; i < CHECK_COUNT(shares); i++) {
        for (size_t size = 20000; size <= 120000; size += 20000) {
            tuile_config_t config = shares[i];
            config.width = 96;
            config.height = 72;
            uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, NULL);
            config.method = TUILE_SCANLINE;
            check_same(&config, size, draw(&stage.view.scene, &config, size, 0), expected, "share");
            free(expected);
        }
    }
    stage_close(&stage);
}

/* ---- memory ---- */

/* count triangles or squares, behind one another or one above the other. */
static attempt_t draw_pile(unsigned count, bool square, bool apart, tuile_config_t *config) {
    mesh_t mesh;
    model_compiled_t pile;
    model_start(&mesh);
    for (unsigned i = 0; i < count; i++) {
        const double y = apart ? 1.4 - 0.25 * i : 1, height = apart ? 0.15 : 2;
        const double z = apart ? 0 : i * -0.5;
        const uint32_t corners[4] = {model_position(&mesh, -1, y, z), model_position(&mesh, -1 + (square ? 0 : 0.2), y - height, z),
                                     model_position(&mesh, 1, square ? y - height : y - height / 2, z),
                                     square ? model_position(&mesh, 1, y, z) : 0};
        model_face(&mesh, corners, square ? 4 : 3, model_material(&mesh, 255, 255, 255));
    }
    model_compile(&pile, &mesh);
    tuile_instance_t instance = stage_placed(&pile.model, 0);
    const tuile_scene_t scene = {
        .instances = &instance, .instance_count = 1, .ambient = 255, .camera = stage_plain_camera(config->width, config->height)};
    config->method = TUILE_SCANLINE;
    const attempt_t a = draw(&scene, config, 1 << 16, 0);
    assert_int_equal(a.result, 0);
    assert_int_equal(a.stats.faces_binned, count);
    model_free(&pile);
    return a;
}

#define UP64(n) (((n) + 63u) / 64 * 64)

static void the_memory_is_that_of_the_opening_comment(void **state) {
    (void)state;
    for (unsigned way = 0; way < 4; way++) {
        const bool square = way & 1, apart = way & 2;
        for (unsigned count = 1; count <= 9; count += 4) {
            tuile_config_t config = {.width = 64, .height = 48, .tile_height = 6, .buffers = 1};
            const attempt_t a = draw_pile(count, square, apart, &config);
            const unsigned active = apart ? 1 : count;
            const unsigned tile_memory = 128 + 2 * 6, room = 24 + active * (56 + 2 * 40);
            const unsigned faces = count * 8u + (square ? count * 16u : 0), vertices = a.stats.vertices * 8;
            assert_int_equal(a.stats.active_max, active);
            assert_int_equal(a.stats.vertices, count * (square ? 4 : 3));
            assert_int_equal(a.stats.peak_bytes, TUILE_STATE_BYTES + UP64(tile_memory) + 2 * 64 * 6 + 16 + vertices + faces + room);
            free(a.picture);
        }
    }
}

static void the_peak_told_is_a_block_that_gives_as_few_passes(void **state) {
    stage_t stage;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    for (unsigned i = 0; i < 2; i++) {
        tuile_config_t config = stage_panel_config(&stage);
        config.method = TUILE_SCANLINE;
        config.tile_width = i ? 48 : 0;
        config.tile_height = 8;
        const attempt_t a = draw(&stage.view.scene, &config, 1 << 20, 0);
        const attempt_t b = draw(&stage.view.scene, &config, (a.stats.peak_bytes + 7u) & ~(size_t)7, 0);
        const attempt_t c = draw(&stage.view.scene, &config, (a.stats.peak_bytes - 1u) & ~(size_t)7, 0);
        assert_int_equal(a.stats.passes, 1);
        assert_int_equal(b.stats.passes, 1);
        assert_true(c.stats.passes > 1);
        check_same(&config, a.stats.peak_bytes, b, a.picture, "peak");
        check_same(&config, a.stats.peak_bytes, c, a.picture, "below the peak");
        free(a.picture);
    }
    stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_worked_table_of_the_document_comes_out_entry_by_entry),
        cmocka_unit_test(sides_that_cross_change_places_and_the_depth_goes_to_the_odd_rank),
        cmocka_unit_test(a_list_may_begin_at_any_row),
        cmocka_unit_test(the_short_way_in_for_triangles_gives_the_same_list),
        cmocka_unit_test(random_scenes_are_those_of_the_z_buffer),
        cmocka_unit_test(models_are_those_of_the_z_buffer),
        cmocka_unit_test(crowded_perspectives_are_those_of_the_z_buffer),
        cmocka_unit_test(a_heap_of_boxes_is_that_of_the_z_buffer),
        cmocka_unit_test(files_are_those_of_the_z_buffer),
        cmocka_unit_test(bands_and_shares_of_the_tiles_are_those_of_the_z_buffer),
        cmocka_unit_test(the_memory_is_that_of_the_opening_comment),
        cmocka_unit_test(the_peak_told_is_a_block_that_gives_as_few_passes),
    };
    return cmocka_run_group_tests_name("scanline", tests, NULL, NULL);
}
