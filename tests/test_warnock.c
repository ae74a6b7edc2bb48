/* Warnock's subdivision: the picture of the z-buffer byte for byte, windows counted on paper, the bounds of stack and memory. */
#include "../raster/visibility/warnock_face.h"
#include "reference/scene_generator.h"
#include "support/check.h"
#include "support/frame.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/stage.h"

#define ALL_VARIANTS 32 /* 0 is the default */

/* ---- the same picture ---- */

static void random_scenes_equal_the_z_buffers(void **state) {
    static const uint16_t tiles[][2] = {{0, 0}, {1, 1}, {7, 5}, {64, 3}, {3, 64}, {32, 32}, {17, 1}, {1, 48}};
    random_source_t random = random_seed(2);
    (void)state;
    for (uint64_t seed = 1; seed <= CHECK_ROUNDS(1200u); seed++) {
        const scene_generator_t options = {.faces = seed % 3 == 0 ? 12 : 0, .convex = seed % 5 == 0};
        char *text = scene_generate(seed, &options);
        test_scene_t scene;
        assert_non_null(text);
        test_scene_open(&scene, text);
        uint32_t *expected = test_scene_ids(&scene, NULL, 1 << 20, NULL);
        const size_t bytes = sizeof *expected * scene.text.width * scene.text.height;
        for (unsigned round = 0; round < 6; round++) {
            const uint16_t *tile = tiles[random_between(&random, 0, CHECK_COUNT(tiles) - 1)];
            tuile_config_t config = {.method = TUILE_WARNOCK, .tile_width = tile[0], .tile_height = tile[1]};
            config.warnock = (uint8_t)random_between(&random, 0, ALL_VARIANTS - 1);
            uint32_t *ids;
            if (round < 4) {
                ids = test_scene_ids(&scene, &config, 1 << 20, NULL);
            } else {
                ids = test_scene_ids_in_order(&scene, &config, 1 << 20, 2, &random.state);
            }
            if (memcmp(ids, expected, bytes) != 0) {
                fail_msg("seed %llu, tile %ux%u, variant %u\n%s", (unsigned long long)seed, tile[0], tile[1], config.warnock, text);
            }
            free(ids);
        }
        free(expected);
        test_scene_close(&scene);
        free(text);
    }
}

static void check_model(stage_t *stage, const char *name, unsigned step) {
    static const uint16_t tiles[][2] = {{96, 10}, {32, 32}, {5, 70}, {96, 70}};
    const uint16_t width = 96, height = 70;
    for (unsigned format = 0; format < 3; format++) {
        for (unsigned shade = 0; shade < 2; shade++) {
            for (unsigned tie = 0; tie < 2; tie++) {
                tuile_config_t config = {.width = width,
                                         .height = height,
                                         .format = (uint8_t)format,
                                         .shade = (uint8_t)shade,
                                         .tie = (uint8_t)tie,
                                         .corners = 16};
                uint8_t *expected = frame_draw(&stage->view.scene, &config, 1 << 20, NULL);
                config.method = TUILE_WARNOCK;
                for (unsigned variant = 0; variant < ALL_VARIANTS; variant += step) {
                    const uint16_t *tile = tiles[(variant / step + format + shade) % CHECK_COUNT(tiles)];
                    config.warnock = (uint8_t)variant;
                    config.tile_width = tile[0];
                    config.tile_height = tile[1];
                    uint8_t *picture = frame_draw(&stage->view.scene, &config, 1 << 20, NULL);
                    if (memcmp(picture, expected, frame_bytes(&config)) != 0) {
                        fail_msg("%s: format %u, shade %u, tie %u, tile %ux%u, variant %u", name, format, shade, tie, tile[0],
                                 tile[1], variant);
                    }
                    free(picture);
                }
                free(expected);
            }
        }
    }
}

static void models_equal_the_z_buffers(void **state) {
    stage_t stage;
    mesh_t mesh;
    (void)state;
    model_room(&mesh);
    stage_open(&stage, &mesh, 96, 70);
    check_model(&stage, "room", 1);
    view_options_t inside = VIEW_OPTIONS_DEFAULT; /* cut by the near plane */
    inside.has_eye = inside.has_at = inside.has_near = true;
    inside.eye[2] = 3.5;
    inside.at[0] = 2.5;
    inside.at[1] = 0.2;
    inside.at[2] = 1;
    inside.near = 0.01;
    inside.fov = 100;
    stage_aim(&stage, &inside, 96, 70);
    check_model(&stage, "room from inside", 1);
    stage_close(&stage);
    model_staircase(&mesh, 9);
    stage_open(&stage, &mesh, 96, 70);
    check_model(&stage, "staircase", 3);
    stage_close(&stage);
    model_torus(&mesh, 30, 15, false);
    stage_open(&stage, &mesh, 96, 70);
    check_model(&stage, "torus", 5);
    stage_close(&stage);
    stage_open_torus(&stage, 96, 70);
    check_model(&stage, "fine torus", CHECK_SANITIZED ? 31 : 11);
    stage_close(&stage);
}

/* ---- depth ---- */

/* Faces of any plane and any range: what `hides` says holds at every pixel, with the depths that are compared. */
static void a_face_that_hides_another_wins_every_pixel(void **state) {
    random_source_t random = random_seed(7);
    unsigned hidden = 0, clamped = 0;
    (void)state;
    for (unsigned i = 0; i < CHECK_ROUNDS(400000u); i++) {
        warnock_face_t faces[2];
        const int32_t left = random_between(&random, 0, 40), top = random_between(&random, 0, 40);
        const window_t window = {(int16_t)left, (int16_t)top, (int16_t)(left + random_between(&random, 1, 6)),
                                 (int16_t)(top + random_between(&random, 1, 6))};
        const int32_t slope = random_one_in(&random, 2) ? 20000 : 400000;
        for (unsigned k = 0; k < 2; k++) {
            warnock_face_t *face = &faces[k];
            memset(face, 0, sizeof *face);
            face->is_triangle = random_one_in(&random, 2);
            face->dx = random_between(&random, -slope, slope);
            face->dy = random_between(&random, -slope, slope);
            const int64_t middle = 1000 * 65536 + random_between(&random, -4 * slope, 4 * slope);
            face->z = middle - (int64_t)face->dx * (left + 2) - (int64_t)face->dy * (top + 2);
            face->low = (uint32_t)(middle - random_between(&random, 0, 6 * slope));
            face->high = (uint32_t)(middle + random_between(&random, 0, 6 * slope));
        }
        const bool first = random_one_in(&random, 2);
        if (!warnock_face_hides(&faces[0], &faces[1], &window, first)) { continue; }
        hidden++;
        for (int32_t y = window.top; y < window.bottom; y++) {
            for (int32_t x = window.left; x < window.right; x++) {
                uint32_t depth[2];
                bool covers = true;
                for (unsigned k = 0; k < 2; k++) {
                    const warnock_face_t *face = &faces[k];
                    int64_t z = face->z + (int64_t)face->dx * x + (int64_t)face->dy * y;
                    const bool beyond = z < face->low || z > face->high;
                    covers &= !(beyond && face->is_triangle); /* the pixel is none of a triangle's */
                    clamped += beyond && !face->is_triangle;
                    z = z < face->low ? face->low : z > face->high ? face->high : z;
                    depth[k] = (uint32_t)(z >> 16);
                }
                if (covers && (first ? depth[0] < depth[1] : depth[0] <= depth[1])) { fail_msg("round %u, pixel %d,%d", i, x, y); }
            }
        }
    }
    assert_true(hidden > CHECK_ROUNDS(400000u) / 8 && clamped > 1000);
}

static void parallel_and_crossing_planes_hide_as_they_should(void **state) {
    const window_t window = {10, 10, 14, 14};
    warnock_face_t a = {.low = 100 << 16, .high = 9000 << 16, .z = 1000 << 16, .dx = 5 << 16, .is_triangle = true}, b = a;
    (void)state;
    assert_true(warnock_face_hides(&a, &b, &window, true)); /* in one plane: the first wins */
    assert_false(warnock_face_hides(&a, &b, &window, false));
    b.z -= 0xffff;
    assert_false(warnock_face_hides(&a, &b, &window, false));
    b.z -= 1; /* a whole step behind */
    assert_true(warnock_face_hides(&a, &b, &window, false));
    b = a;
    b.dx = -b.dx;
    assert_false(warnock_face_hides(&a, &b, &(window_t){0, 0, 1, 1}, false));
    assert_true(warnock_face_hides(&a, &b, &(window_t){1, 0, 9, 1}, false)); /* they cross at column 0 */
    assert_false(warnock_face_hides(&b, &a, &(window_t){1, 0, 9, 1}, true));
    /* Its plane is in front of a's, but the face ends before it gets there. */
    b.z = 5000 << 16;
    b.low = 200 << 16;
    b.high = 900 << 16;
    assert_true(warnock_face_hides(&a, &b, &window, false));
}

/* Depths at covered pixels of random triangles: within the range that is told, and now and then beyond that of the corners. */
static void a_triangles_pixels_lie_in_its_range(void **state) {
    static uint64_t arena[8];
    static tuile_t t;
    random_source_t random = random_seed(9);
    unsigned beyond = 0;
    (void)state;
    memset(&t, 0, sizeof t);
    t.vertices = (vertex_t *)(void *)arena;
    t.arena_end = (uint8_t *)(arena + 8);
    t.record_bytes = sizeof(record_t);
    t.span_kind = SPAN_GOURAUD;
    record_t *record = frame_record(&t, 0);
    for (unsigned i = 0; i < CHECK_ROUNDS(100000u); i++) {
        const int32_t size = random_one_in(&random, 3) ? 4000 : 500;
        const uint32_t base = (uint32_t)random_between(&random, 3000, 60000) * 256u, spread = size < 512 ? 262142u : 1000000u;
        vertex_t *v = t.vertices;
        uint32_t low = UINT32_MAX, high = 0;
        for (unsigned k = 0; k < 3; k++) {
            const uint32_t depth = base + (uint32_t)random_between(&random, 0, (int32_t)(spread / 2));
            const int32_t x = 16 * random_between(&random, 0, size / 16) + 8, y = 16 * random_between(&random, 0, size / 16) + 8;
            v[k] = (vertex_t){(int16_t)x, (int16_t)y, depth << 8 | 99}; /* a centre: the range is reached */
            low = depth < low ? depth : low;
            high = depth > high ? depth : high;
        }
        const int32_t area = (v[2].x - v[0].x) * (v[1].y - v[0].y) - (v[1].x - v[0].x) * (v[2].y - v[0].y);
        if (area == 0) { continue; }
        const unsigned second = area > 0 ? 1 : 2;
        unsigned top = 0;
        for (unsigned k = 1; k < 3; k++) {
            top = v[k].y < v[top].y ? k : top;
        }
        const unsigned order[3] = {0, second, 3 - second};
        unsigned at = 0;
        while (order[at] != top) {
            at++;
        }
        *record = (record_t){
            0, (uint16_t)top, (int8_t)((int)order[(at + 1) % 3] - (int)top), (int8_t)((int)order[(at + 2) % 3] - (int)top), 0, 0};
        warnock_face_t face;
        const window_t box = {0, 0, 256, 256};
        assert_true(warnock_face_start(&t, &face, 0, &box));
        if (face.is_steep) { continue; }
        for (unsigned n = 0; n < 12; n++) {
            const int32_t x = v[n % 3].x / 16 + (n < 3 ? 0 : random_between(&random, -2, 2)),
                          y = v[n % 3].y / 16 + (n < 3 ? 0 : random_between(&random, -2, 2));
            if (window_triangle(face.sides, &(window_t){(int16_t)x, (int16_t)y, (int16_t)(x + 1), (int16_t)(y + 1)}) !=
                WINDOW_SURROUNDING) {
                continue;
            }
            const int64_t z = face.z + (int64_t)face.dx * x + (int64_t)face.dy * y;
            assert_true(z >= face.low && z <= face.high);
            beyond += z < (int64_t)(low << 8) + 0x8000 || z > (int64_t)(high << 8) + 0x8000;
        }
        assert_true(face.low + 0x8000u >= low << 8 && face.high <= (high << 8) + 0x10000u); /* and tells not much more */
    }
    assert_true(beyond > 0);
}

/* ---- memory ---- */

static void less_memory_gives_the_same_picture_or_says_what_would_do(void **state) {
    stage_t stage;
    unsigned failed = 0, drawn = 0, shrunk = 0;
    (void)state;
    stage_open_torus(&stage, 240, 320);
    tuile_config_t config = stage_panel_config(&stage);
    config.shade = TUILE_GOURAUD;
    uint8_t *expected = frame_draw(&stage.view.scene, &config, 1 << 20, NULL);
    config.method = TUILE_WARNOCK;
    for (unsigned columns = 1; columns <= 5; columns += 4) {
        config.tile_width = (uint16_t)(240 / columns);
        config.tile_height = columns == 1 ? 8 : 32;
        for (size_t size = frame_least_bytes(&config); size < 300000; size += size / (CHECK_SANITIZED ? 3 : 9)) {
            block_t block;
            tuile_t *renderer;
            tuile_tile_t tile;
            tuile_stats_t stats;
            uint8_t *picture = frame_blank(&config);
            block_open(&block, size);
            assert_int_equal(tuile_init(&renderer, &config, block.bytes, size, NULL), TUILE_OK);
            assert_int_equal(tuile_begin(renderer, &stage.view.scene), TUILE_OK);
            int result;
            while ((result = tuile_next(renderer, &tile)) == 1) {
                frame_paste(picture, &config, &tile);
            }
            if (result == TUILE_ERROR_MEMORY) {
                failed++;
                assert_true(tuile_wanted(renderer) > size);
                /* What was wanted for this tile is enough for it, in a pass of its own. */
                block_t larger;
                tuile_t *again;
                tuile_stats_t so_far;
                const size_t wanted = tuile_wanted(renderer);
                assert_int_equal(tuile_end(renderer, &so_far), TUILE_OK);
                block_open(&larger, wanted);
                assert_int_equal(tuile_init(&again, &config, larger.bytes, wanted, NULL), TUILE_OK);
                assert_int_equal(tuile_begin(again, &stage.view.scene), TUILE_OK);
                assert_int_equal(tuile_seek(again, so_far.tiles), TUILE_OK);
                assert_int_equal(tuile_next(again, &tile), 1);
                block_close(&larger);
            } else {
                assert_int_equal(result, 0);
                assert_int_equal(tuile_end(renderer, &stats), TUILE_OK);
                assert_memory_equal(picture, expected, frame_bytes(&config));
                assert_true(stats.peak_bytes <= size);
                drawn++;
                shrunk += stats.passes > 1;
            }
            block_close(&block);
            free(picture);
        }
    }
    assert_true(failed > 1 && drawn > 1 && shrunk > 1);
    free(expected);
    stage_close(&stage);
}

/* 8 bytes a record, 8 a vertex and 90 a face; the tile has none of its own. */
static void the_memory_of_a_frame_is_the_one_stated(void **state) {
    stage_t stage;
    mesh_t mesh;
    tuile_stats_t stats;
    (void)state;
    model_cube(&mesh);
    stage_open(&stage, &mesh, 64, 64);
    tuile_config_t config = {.width = 64,
                             .height = 64,
                             .tile_height = 64,
                             .buffers = 1,
                             .method = TUILE_WARNOCK,
                             .corners = 4,
                             .warnock = TUILE_WARNOCK_QUARTERS};
    free(frame_draw(&stage.view.scene, &config, 1 << 16, &stats));
    const size_t faces = stats.faces_binned, fixed = TUILE_STATE_BYTES + 64 * 64 * 2 + 8;
    assert_int_equal(stats.faces_setup, faces);
    /* A record, a slot for the quad and one for its four corners. The cube's corners are 8 to 24 vertices. */
    const size_t least = fixed + faces * (8 + 16) + TUILE_ALIGN8(90 * faces), vertices = (stats.peak_bytes - least) / 8;
    assert_int_equal((stats.peak_bytes - least) % 8, 0);
    assert_in_range(vertices, 8, 24);
    config.method = TUILE_ZBUFFER;
    const size_t depth = frame_least_bytes(&config);
    config.method = TUILE_WARNOCK;
    assert_int_equal(depth - frame_least_bytes(&config), 64 * 64 * 2);
    stage_close(&stage);
}

/* One tile, one pass: eight bytes less than the peak are too few. */
static void eight_bytes_less_than_the_peak_are_too_few(void **state) {
    stage_t stage;
    tuile_stats_t stats;
    (void)state;
    stage_open_torus(&stage, 64, 64);
    const tuile_config_t config = {.width = 64,
                                   .height = 64,
                                   .tile_height = 64,
                                   .method = TUILE_WARNOCK,
                                   .cluster_vertices = stage.compiled.model.cluster_vertices_max};
    free(frame_draw(&stage.view.scene, &config, 1 << 20, &stats));
    const size_t peak = stats.peak_bytes;
    free(frame_draw(&stage.view.scene, &config, peak, &stats));
    assert_int_equal(stats.peak_bytes, peak);
    block_t block;
    tuile_t *renderer;
    tuile_tile_t tile;
    block_open(&block, peak - 8);
    assert_int_equal(tuile_init(&renderer, &config, block.bytes, peak - 8, NULL), TUILE_OK);
    assert_int_equal(tuile_begin(renderer, &stage.view.scene), TUILE_OK);
    assert_int_equal(tuile_next(renderer, &tile), TUILE_ERROR_MEMORY);
    assert_true(tuile_wanted(renderer) >= peak);
    block_close(&block);
    stage_close(&stage);
}

/* Rows 3 ... 19 of 64 in strips of 8: three of them set it up, and no strip below does. */
static void a_face_is_set_up_in_the_tiles_that_it_reaches(void **state) {
    test_scene_t scene;
    tuile_stats_t stats;
    (void)state;
    test_scene_open(&scene, "screen 64 64\ncamera ortho\nsample 1/2 1/2\npoly 1 1,3,5 30,3,5 30,20,5\n");
    tuile_config_t config = {.method = TUILE_WARNOCK, .tile_height = 8, .warnock = TUILE_WARNOCK_QUARTERS};
    free(test_scene_ids(&scene, &config, 1 << 20, &stats));
    assert_int_equal(stats.faces_setup, 3);
    config.tile_width = 16; /* columns 1 ... 29: two of four */
    free(test_scene_ids(&scene, &config, 1 << 20, &stats));
    assert_int_equal(stats.faces_setup, 6);
    test_scene_close(&scene);
}

/* ---- counted on paper ---- */

typedef struct tally {
    uint32_t *ids;
    unsigned width, decided[4], pixels, painted;
    uint8_t seen[64 * 64];
} tally_t;

static void count_window(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom, unsigned why) {
    tally_t *tally = context;
    assert_in_range(why, 0, 3);
    assert_true(left < right && top < bottom);
    tally->decided[why]++;
    for (unsigned y = top; y < bottom; y++) {
        for (unsigned x = left; x < right; x++) {
            tally->seen[y * 64 + x]++;
            if (tally->ids && why == TUILE_WHY_EMPTY) { assert_int_equal(tally->ids[y * tally->width + x], 0); }
            if (tally->ids && why == TUILE_WHY_SURROUNDED) {
                assert_int_not_equal(tally->ids[y * tally->width + x], 0);
                assert_int_equal(tally->ids[y * tally->width + x], tally->ids[top * tally->width + left]);
            }
        }
    }
    if (why == TUILE_WHY_PIXEL) { assert_true(right == left + 1 && bottom == top + 1); }
}

static tuile_stats_t draw_traced(const char *text, unsigned variant, tally_t *tally) {
    const tuile_trace_t trace = {.context = tally, .window = count_window};
    test_scene_t scene;
    tuile_stats_t stats;
    memset(tally, 0, sizeof *tally);
    test_scene_open(&scene, text);
    tuile_config_t config = {.method = TUILE_WARNOCK, .tile_height = scene.text.height, .warnock = (uint8_t)variant};
    config.trace = &trace;
    tally->ids = test_scene_ids(&scene, NULL, 1 << 20, NULL);
    tally->width = scene.text.width;
    uint32_t *ids = test_scene_ids(&scene, &config, 1 << 20, &stats);
    free(tally->ids);
    free(ids);
    for (unsigned y = 0; y < scene.text.height; y++) { /* every pixel in one window */
        for (unsigned x = 0; x < scene.text.width; x++) {
            assert_int_equal(tally->seen[y * 64 + x], 1);
        }
    }
    assert_int_equal(stats.windows_pixels, tally->decided[TUILE_WHY_PIXEL]);
    test_scene_close(&scene);
    return stats;
}

typedef struct counted {
    const char *text;
    unsigned variant;
    unsigned windows, depth, waiting;
    unsigned empty, single, surrounded, pixels;
} counted_t;

/* Columns 0, 1 and 2 of 8. */
#define THREE_COLUMNS "screen 8 8\ncamera ortho\nsample 1/2 1/2\npoly 1 0,0,5 3,0,5 3,8,5 0,8,5\n"
/* The same before a face that fills the screen. */
#define BEFORE_A_WALL THREE_COLUMNS "poly 2 -9,-9,9 99,-9,9 99,99,9 -9,99,9\n"
/* The same behind it. */
#define BEHIND_A_WALL THREE_COLUMNS "poly 2 -9,-9,1 99,-9,1 99,99,1 -9,99,1\n"

static const counted_t scenes[] = {
    /* The tile, 4 quarters of which the right two are empty; of the left two's 2 x 2 windows four lie in columns 0 and 1 and are
     * filled, four in 2 and 3 and go to pixels. On the stack at most: 3 quarters, 2 windows behind the first, 4 pixels. */
    {THREE_COLUMNS, TUILE_WARNOCK_QUARTERS, 1 + 4 + 8 + 16, 3, 9, 2, 0, 4, 16},
    {THREE_COLUMNS, TUILE_WARNOCK_SORTED, 1 + 4 + 8 + 16, 3, 9, 2, 0, 4, 16},
    {THREE_COLUMNS, TUILE_WARNOCK_SINGLE, 1, 0, 0, 0, 1, 0, 0},
    /* Cut at column 3, and halfway down: the face's upper and lower sides are the tile's. */
    {THREE_COLUMNS, TUILE_WARNOCK_BOX, 1 + 4, 1, 4, 2, 0, 2, 0},
    /* 64 pixels are halved, not quartered: the left half goes to pixels, the right one is empty. */
    {THREE_COLUMNS, TUILE_WARNOCK_PIXELS, 1 + 2 + 32, 1, 2, 1, 0, 0, 32},
    /* The wall fills the tile but is hidden by the other, or hides it. */
    {BEFORE_A_WALL, TUILE_WARNOCK_QUARTERS, 1 + 4 + 8 + 16, 3, 9, 0, 0, 2 + 4, 16},
    {BEFORE_A_WALL, TUILE_WARNOCK_SINGLE, 1, 0, 0, 0, 1, 0, 0},
    {BEHIND_A_WALL, TUILE_WARNOCK_QUARTERS, 1, 0, 0, 0, 0, 1, 0},
    /* No face; one on the tile exactly: a box that is the window. */
    {"screen 8 8\ncamera ortho\nsample 1/2 1/2\npoly 1 20,0,5 23,0,5 23,8,5\n", TUILE_WARNOCK_QUARTERS, 1, 0, 0, 1, 0, 0, 0},
    {"screen 8 8\ncamera ortho\nsample 1/2 1/2\npoly 1 0,0,5 8,0,5 8,8,5 0,8,5\n", TUILE_WARNOCK_QUARTERS, 1, 0, 0, 0, 0, 1, 0},
    /* 8 x 2: only the longer side is halved while it is twice the other. Pixel (0, 0): halves of 4 x 2, of 2 x 2, quarters. The
     * picture's order of parts: the smallest first, of equals the left upper one. */
    {"screen 8 2\ncamera ortho\nsample 1/2 1/2\npoly 1 0,0,5 1,0,5 1,1,5 0,1,5\n", TUILE_WARNOCK_QUARTERS, 1 + 2 + 2 + 4, 3, 6, 2,
     0, 0, 4},
    /* 3 x 3 is cut behind column 1 and row 1: pixel, two windows of two, one of four. Its middle pixel is the face's. */
    {"screen 3 3\ncamera ortho\nsample 1/2 1/2\npoly 1 1,1,5 2,1,5 2,2,5 1,2,5\n", TUILE_WARNOCK_QUARTERS, 1 + 4 + 4, 2, 4, 2, 0, 0,
     1 + 4},
};

static void windows_are_counted_as_on_paper(void **state) {
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(scenes); i++) {
        const counted_t *c = &scenes[i];
        tally_t tally;
        const tuile_stats_t stats = draw_traced(c->text, c->variant, &tally);
        const unsigned found[] = {stats.windows,    stats.windows_depth, stats.windows_waiting, tally.decided[0],
                                  tally.decided[1], tally.decided[2],    stats.windows_pixels};
        const unsigned expected[] = {c->windows, c->depth, c->waiting, c->empty, c->single, c->surrounded, c->pixels};
        for (unsigned k = 0; k < CHECK_COUNT(found); k++) {
            if (found[k] != expected[k]) { fail_msg("scene %u, figure %u: %u, on paper %u", i, k, found[k], expected[k]); }
        }
    }
}

static void each_pixel_of_random_scenes_is_decided_once(void **state) {
    static const char *const texts[] = {THREE_COLUMNS, BEFORE_A_WALL};
    tally_t tally;
    (void)state;
    for (unsigned variant = 0; variant < ALL_VARIANTS; variant++) {
        for (unsigned i = 0; i < CHECK_COUNT(texts); i++) {
            (void)draw_traced(texts[i], variant, &tally);
        }
        for (uint64_t seed = 1; seed < (CHECK_SANITIZED ? 3 : 20); seed++) {
            const scene_generator_t options = {.width = 1 + (int)(seed * 7 % 64), .height = 1 + (int)(seed * 11 % 64)};
            char *text = scene_generate(1000 * variant + seed, &options);
            (void)draw_traced(text, variant, &tally);
            free(text);
        }
    }
}

/* A pixel in the corner of a tile of 1024 x 1024 pixels: ten divisions by four, of which each leaves three windows waiting. */
static void the_stack_is_filled_to_its_bound(void **state) {
    test_scene_t scene;
    tuile_stats_t stats;
    (void)state;
    for (unsigned variant = 1; variant < ALL_VARIANTS; variant++) {
        if (variant & (TUILE_WARNOCK_SINGLE | TUILE_WARNOCK_PIXELS) && CHECK_SANITIZED) { continue; }
        test_scene_open(&scene, "screen 1024 1024\ncamera ortho\nsample 1/2 1/2\npoly 1 0,0,5 1,0,5 1,1,5 0,1,5\n"
                                "poly 2 0,0,7 1023,0,7 0,1023,7\n");
        tuile_config_t config = {.method = TUILE_WARNOCK, .tile_height = 1024, .buffers = 1, .warnock = (uint8_t)variant};
        free(test_scene_ids(&scene, &config, 8 << 20, &stats));
        assert_in_range(stats.windows_waiting, 0, 31);
        if (variant == TUILE_WARNOCK_QUARTERS) {
            assert_int_equal(stats.windows_waiting, 31);
            assert_int_equal(stats.windows_depth, 10);
        }
        test_scene_close(&scene);
    }
}

static void unknown_variants_are_refused(void **state) {
    static uint64_t block[4096];
    tuile_t *renderer;
    tuile_config_t config = {.width = 8, .height = 8, .method = TUILE_WARNOCK, .cluster_vertices = 8, .warnock = 32};
    (void)state;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_ERROR_ARGUMENT);
    config.warnock = 0;
    assert_int_equal(tuile_init(&renderer, &config, block, sizeof block, NULL), TUILE_OK);
    assert_int_equal(tuile_config(renderer)->warnock, TUILE_WARNOCK_SINGLE | TUILE_WARNOCK_BOX | TUILE_WARNOCK_PIXELS);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_scenes_equal_the_z_buffers),
        cmocka_unit_test(models_equal_the_z_buffers),
        cmocka_unit_test(a_face_that_hides_another_wins_every_pixel),
        cmocka_unit_test(parallel_and_crossing_planes_hide_as_they_should),
        cmocka_unit_test(a_triangles_pixels_lie_in_its_range),
        cmocka_unit_test(less_memory_gives_the_same_picture_or_says_what_would_do),
        cmocka_unit_test(the_memory_of_a_frame_is_the_one_stated),
        cmocka_unit_test(eight_bytes_less_than_the_peak_are_too_few),
        cmocka_unit_test(a_face_is_set_up_in_the_tiles_that_it_reaches),
        cmocka_unit_test(windows_are_counted_as_on_paper),
        cmocka_unit_test(each_pixel_of_random_scenes_is_decided_once),
        cmocka_unit_test(the_stack_is_filled_to_its_bound),
        cmocka_unit_test(unknown_variants_are_refused),
    };
    return cmocka_run_group_tests_name("warnock", tests, NULL, NULL);
}
