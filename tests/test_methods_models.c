/* Five methods, one picture: models as the demo shows them. Every frame is drawn by all five, from one and the same compiled model,
 * and their hashes are equal. Where the tree's picture differs, each pixel is shown to be a tie: at its centre the two faces lie
 * within a step of the 16-bit depth by which the others decide, while the tree knows which is in front. */
#include "support/check.h"
#include "support/decoder.h"
#include "support/frame.h"
#include "support/models.h"
#include "support/set_up.h"
#include "support/stage.h"

#include <math.h>

enum { WIDTH = 240, HEIGHT = 320 };

static const char *const names[] = {"zbuffer", "scanline", "warnock", "painter", "tree"};

/* The depth of a face's plane at the centre of a pixel, in steps. */
static long double depth_at_pixel(const set_up_t *s, const decoder_face_t *face, unsigned x, unsigned y) {
    const tuile_camera_t *camera = &s->scene.camera;
    long double corner[3][3], n[3], ray[3] = {0, 0, -1}, height = 0, slope = 0, best = 0;
    ray[0] = (x + 0.5L - camera->centre_x / 65536.0L) / (camera->focal_x / 65536.0L);
    ray[1] = -(y + 0.5L - camera->centre_y / 65536.0L) / (camera->focal_y / 65536.0L);
    for (uint32_t i = 1; i + 1 < face->corners; i++) { /* the largest triangle of the fan is the least disturbed by rounding */
        long double at[3][3], cross[3], size = 0;
        for (uint32_t c = 0; c < 3; c++) {
            const int32_t *q = face->q[c == 0 ? 0 : i + c - 1];
            const int16_t q16[3] = {(int16_t)q[0], (int16_t)q[1], (int16_t)q[2]};
            set_up_view(s, q16, at[c]);
        }
        for (int k = 0; k < 3; k++) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            cross[k] = (at[1][u] - at[0][u]) * (at[2][v] - at[0][v]) - (at[1][v] - at[0][v]) * (at[2][u] - at[0][u]);
            size += cross[k] * cross[k];
        }
        if (size <= best) { continue; }
        best = size;
        memcpy(corner, at, sizeof corner);
        memcpy(n, cross, sizeof n);
    }
    assert_true(best > 0);
    for (int k = 0; k < 3; k++) {
        height += n[k] * corner[0][k];
        slope += n[k] * ray[k];
    }
    const long double view[3] = {0, 0, -height / slope};
    long double wx, wy, depth;
    set_up_window(s, view, &wx, &wy, &depth);
    return depth;
}

static uint32_t *draw_ids(const tuile_scene_t *scene, tuile_config_t config) {
    config.format = TUILE_FACE_IDS;
    return (uint32_t *)(void *)frame_draw(scene, &config, (size_t)4 << 20, NULL);
}

/* Pixels where the tree shows another face than the z-buffer, all of them ties. */
static unsigned count_ties(const tuile_scene_t *scene, const tuile_config_t *config, const decoder_model_t *model) {
    set_up_t s;
    tuile_config_t c = *config;
    unsigned ties = 0;
    set_up_simple(&s);
    s.model = *scene->instances[0].model;
    s.instance = scene->instances[0];
    s.scene.camera = scene->camera;
    uint32_t *plain = draw_ids(scene, c);
    c.method = TUILE_TREE;
    uint32_t *tree = draw_ids(scene, c);
    for (unsigned p = 0; p < WIDTH * HEIGHT; p++) {
        if (plain[p] == tree[p]) { continue; }
        ties++;
        assert_true(plain[p] && tree[p]);
        const long double a = depth_at_pixel(&s, &model->faces[plain[p] - 1], p % WIDTH, p / WIDTH);
        const long double b = depth_at_pixel(&s, &model->faces[tree[p] - 1], p % WIDTH, p / WIDTH);
        /* Each is known to 0.53 steps. */
        if (fabsl(a - b) > 1.07L) {
            fail_msg("pixel %u,%u: face %u at %.3Lf, face %u of the tree at %.3Lf", p % WIDTH, p / WIDTH, plain[p], a, tree[p], b);
        }
    }
    free(plain);
    free(tree);
    return ties;
}

/* Frames of a model with a tree: equal by all methods, but for `ties_max` pixels of the tree in all. */
static void check_model(mesh_t *mesh, const view_options_t *options, unsigned ties_max, bool cut) {
    const mesh_options_t with = {.tree = true};
    const unsigned frames = CHECK_SANITIZED ? 1 : 4;
    compiled_t c = {.mesh = *mesh};
    tuile_model_t model;
    view_t view;
    sim_error_t error = {""};
    unsigned ties = 0;
    memset(mesh, 0, sizeof *mesh);
    decoder_compile_mesh(&c, &with);
    assert_int_equal(tuile_model_open(&model, c.bytes, c.size_bytes), 0);
    assert_int_equal(model.fractions != NULL, cut);
    assert_int_equal(view_make(&view, options, &model, WIDTH, HEIGHT, frames, &error), 0);
    for (unsigned frame = 0; frame < frames; frame++) {
        view_frame(&view, frame);
        tuile_config_t config = {
            .width = WIDTH, .height = HEIGHT, .tile_height = 24, .shade = frame % 2 ? TUILE_GOURAUD : TUILE_FLAT};
        config.cluster_vertices = model.cluster_vertices_max;
        config.corners = model.corners_max;
        config.tree_depth = model.tree_depth;
        uint8_t *expected = frame_draw(&view.scene, &config, (size_t)4 << 20, NULL);
        for (unsigned m = 1; m <= TUILE_TREE; m++) {
            tuile_config_t by = config;
            by.method = (uint8_t)m;
            uint8_t *picture = frame_draw(&view.scene, &by, (size_t)4 << 20, NULL);
            if (memcmp(picture, expected, frame_bytes(&config)) != 0) {
                if (m != TUILE_TREE || ties_max == 0) { fail_msg("frame %u: %s differs", frame, names[m]); }
                ties += count_ties(&view.scene, &config, &c.model);
            }
            free(picture);
        }
        free(expected);
    }
    print_message("%u ties\n", ties);
    assert_true(ties <= ties_max);
    decoder_drop(&c);
}

static void the_spider_has_one_hash(void **state) {
    (void)state;
    mesh_t mesh;
    sim_error_t error = {""};
    const char *path = getenv("SPIDER");
    if (!path) { skip(); }
    assert_int_equal(mesh_import(&mesh, path, &error), 0);
    check_model(&mesh, &VIEW_OPTIONS_DEFAULT, 0, true);
}

/* The crate and the step stand on the floor, and the lower edges of their sides lie in its plane: along them the depths are equal.
 */
static void the_room_has_one_hash_but_where_things_touch(void **state) {
    (void)state;
    mesh_t mesh;
    sim_error_t error = {""};
    view_options_t inside = VIEW_OPTIONS_DEFAULT;
    inside.has_eye = inside.has_at = true;
    memcpy(inside.eye, (const double[3]){0, 1, 3}, sizeof inside.eye);
    memcpy(inside.at, (const double[3]){0, 1, 0}, sizeof inside.at);
    assert_int_equal(mesh_import(&mesh, "tests/models/room.obj", &error), 0);
    check_model(&mesh, &inside, 200, false);
}

static void bodies_have_one_hash(void **state) {
    (void)state;
    mesh_t mesh;
    model_torus(&mesh, 24, 16, true);
    check_model(&mesh, &VIEW_OPTIONS_DEFAULT, 0, true);
    model_sphere(&mesh, 16, 24);
    check_model(&mesh, &VIEW_OPTIONS_DEFAULT, 0, false);
    model_octahedron(&mesh);
    check_model(&mesh, &VIEW_OPTIONS_DEFAULT, 0, false);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_spider_has_one_hash),
        cmocka_unit_test(the_room_has_one_hash_but_where_things_touch),
        cmocka_unit_test(bodies_have_one_hash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
