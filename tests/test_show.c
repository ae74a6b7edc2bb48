/* tuile render --show, and what a trace tells: views by name, figures of small scenes by hand, Warnock's windows, the painters'
 * order.
 *
 * The scenes by hand: an orthographic camera, 16 pixels a unit, the origin of the model in the middle of the window. */
#include "support/check.h"
#include "support/cli.h"
#include "support/frame.h"
#include "support/stage.h"

#include "../sim/show.h"

#include <unistd.h>

#define WIDTH 112u
#define HEIGHT 80u
#define PLOT_PX 96u

/* ---- names ---------------------------------------------------------------------------------------------------- */

static const char *const views[] = {
    "zbuffer-overdraw", "zbuffer-tiles",   "scanline-overdraw", "scanline-tiles", "scanline-edges",
    "warnock-tiles",    "warnock-windows", "painter-overdraw",  "painter-tiles",  "painter-order",
    "tree-overdraw",    "tree-tiles",      "tree-order",
};

static void every_view_is_a_picture_of_its_size(void **state) {
    (void)state;
    cli_good_silent("mesh @/room.obj --tree -o @/room-tree.tuile");
    for (unsigned i = 0; i < CHECK_COUNT(views); i++) {
        const bool tree = strncmp(views[i], "tree", 4) == 0, plot = strcmp(views[i], "scanline-edges") == 0;
        char line[256];
        sim_picture_t picture = {0};
        (void)snprintf(line, sizeof line, "render @/%s --eye 0,1,3 --at 0,1,0 --rotate 90 --show %s --out @/view.png",
                       tree ? "room-tree.tuile" : "room.obj", views[i]);
        char *out = cli_good(line);
        const char *kind = strchr(views[i], '-') + 1, *colon = strchr(out, ':'); /* "edges" stand as "active edges" */
        assert_true(colon - out >= (int)strlen(kind) && strncmp(colon - strlen(kind), kind, strlen(kind)) == 0);
        assert_int_equal(sim_picture_read(&picture, cli_path("view.png"), NULL), 0);
        assert_int_equal(picture.width, 3 * (320 + (plot ? PLOT_PX : 0)));
        assert_int_equal(picture.height, 3 * 240);
        bool blank = true;
        for (size_t k = 3; k < (size_t)3 * picture.width * picture.height && blank; k++) {
            blank = picture.rgb[k] == picture.rgb[k % 3];
        }
        assert_false(blank);
        sim_picture_free(&picture);
        free(out);
        (void)unlink(cli_path("view.png"));
    }
    (void)unlink(cli_path("room-tree.tuile"));
}

static void names_of_no_view_are_refused_with_a_list(void **state) {
    static const char *const wrong[] = {"zbuffer-windows", "warnock-overdraw", "scanline-order", "tree-edges",    "tree",
                                        "overdraw",        "zbuffer-",         "zbuffer-tile",   "zbuffer-tilesx"};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(wrong); i++) {
        char line[128];
        (void)snprintf(line, sizeof line, "render @/cube.obj --out @/x.png --show %s", wrong[i]);
        for (unsigned k = 0; k < CHECK_COUNT(views); k++) {
            cli_fails(line, wrong[i], views[k]);
        }
    }
    cli_fails("render @/cube.obj --show zbuffer-tiles", "--show", "--out");
}

/* ---- scenes by hand ------------------------------------------------------------------------------------------- */

typedef struct set {
    uint8_t *bytes;
    tuile_model_t model;
    tuile_instance_t instance;
    tuile_scene_t scene;
    tuile_config_t config;
} set_t;

static void rectangle(mesh_t *mesh, double left, double low, double right, double high, double z) {
    const uint32_t corners[4] = {model_position(mesh, left, low, z), model_position(mesh, right, low, z),
                                 model_position(mesh, right, high, z), model_position(mesh, left, high, z)};
    model_face(mesh, corners, 4, model_material(mesh, 200, 200, 200));
}

/* Compiles and frees the mesh, on a grid of 1/16, with a display tree for TUILE_TREE. */
static void set_open(set_t *set, mesh_t *mesh, tuile_method_t method) {
    const mesh_options_t options = {.step = 1.0 / 16, .tree = method == TUILE_TREE};
    mesh_report_t report;
    sim_error_t error = {""};
    size_t size_bytes;
    memset(set, 0, sizeof *set);
    if (mesh_compile(mesh, &options, &set->bytes, &size_bytes, &report, &error) != 0) { fail_msg("%s", error.text); }
    mesh_free(mesh);
    assert_int_equal(tuile_model_open(&set->model, set->bytes, size_bytes), 0);
    set->instance = stage_placed(&set->model, 0);
    set->scene = (tuile_scene_t){.instances = &set->instance, .instance_count = 1, .ambient = 255};
    set->scene.camera = stage_plain_camera(WIDTH, HEIGHT);
    set->config = (tuile_config_t){.width = WIDTH,
                                   .height = HEIGHT,
                                   .tile_height = 24,
                                   .method = (uint8_t)method,
                                   .cluster_vertices = set->model.cluster_vertices_max,
                                   .corners = set->model.corners_max,
                                   .tree_depth = set->model.tree_depth};
}

static void set_close(set_t *set) { free(set->bytes); }

/* The picture in pixels of the window. */
static void show(const set_t *set, show_kind_t kind, sim_picture_t *picture, char *summary, size_t size) {
    const show_view_t view = {(tuile_method_t)set->config.method, kind};
    sim_error_t error = {""};
    memset(picture, 0, sizeof *picture);
    if (show_draw(&view, &set->config, &set->scene, &set->model, 1, picture, summary, size, &error) != 0) {
        fail_msg("%s", error.text);
    }
}

/* 64 x 64 pixels, and 48 x 48 nearer, 32 x 32 of which are over the first: 4096 + 2304 drawn, 1024 fewer seen. */
static void overdraw_by_hand(void **state) {
    (void)state;
    for (unsigned m = 0; m < 5; m++) {
        set_t set;
        mesh_t mesh;
        sim_picture_t picture;
        char summary[200];
        if (m == TUILE_WARNOCK) { continue; }
        model_start(&mesh);
        rectangle(&mesh, -2, -2, 2, 2, 0);
        rectangle(&mesh, 0, -2.5, 3, 0.5, 1); /* x 0 ... 2, y -2 ... 0.5 are over the first */
        set_open(&set, &mesh, (tuile_method_t)m);
        show(&set, SHOW_OVERDRAW, &picture, summary, sizeof summary);
        /* 2 x 2.5 units of 256 pixels are 1280: 5120 seen. */
        assert_string_equal(summary, "overdraw: 1.25 faces a covered pixel, 2 at most; 6400 pixels drawn for 5120 seen");
        const uint8_t *one = sim_picture_at(&picture, 40, 20), *other = sim_picture_at(&picture, 98, 60),
                      *two = sim_picture_at(&picture, 70, 50), *none = sim_picture_at(&picture, 5, 5);
        assert_memory_equal(one, other, 3);
        assert_memory_not_equal(one, two, 3);
        assert_memory_not_equal(one, none, 3);
        assert_memory_not_equal(two, none, 3);
        sim_picture_free(&picture);
        set_close(&set);
    }
}

/* A U from -2 to 2 both ways, its notch from -1 to 1 above 0: four edges on rows 8 ... 39, two on 40 ... 71, none else. */
static void edges_by_hand(void **state) {
    static const double ring[8][2] = {{-2, -2}, {2, -2}, {2, 2}, {1, 2}, {1, 0}, {-1, 0}, {-1, 2}, {-2, 2}};
    set_t set;
    mesh_t mesh;
    sim_picture_t picture;
    char summary[200];
    uint32_t corners[8];
    (void)state;
    model_start(&mesh);
    for (unsigned i = 0; i < 8; i++) {
        corners[i] = model_position(&mesh, ring[i][0], ring[i][1], 0);
    }
    model_face(&mesh, corners, 8, model_material(&mesh, 200, 200, 200));
    set_open(&set, &mesh, TUILE_SCANLINE);
    show(&set, SHOW_EDGES, &picture, summary, sizeof summary);
    assert_string_equal(summary, "active edges: 2.4 a line, 4 at most"); /* (32 * 4 + 32 * 2) / 80 */
    assert_int_equal(picture.width, WIDTH + PLOT_PX);
    /* The plot is as wide as the longest bar: columns within a quarter, beyond a half, and close to its end. */
    const uint8_t *bar = sim_picture_at(&picture, WIDTH + 90, 20), *empty = sim_picture_at(&picture, WIDTH + 90, 4);
    assert_memory_not_equal(bar, empty, 3);
    for (unsigned y = 0; y < HEIGHT - 7; y++) { /* the scale stands below */
        const unsigned edges = y < 8 || y >= 72 ? 0 : y < 40 ? 4 : 2;
        assert_memory_equal(sim_picture_at(&picture, WIDTH + 20, y), edges >= 2 ? bar : empty, 3);
        assert_memory_equal(sim_picture_at(&picture, WIDTH + 44, y), edges >= 2 ? bar : empty, 3);
        assert_memory_equal(sim_picture_at(&picture, WIDTH + 52, y), edges == 4 ? bar : empty, 3);
        assert_memory_equal(sim_picture_at(&picture, WIDTH + 90, y), edges == 4 ? bar : empty, 3);
    }
    sim_picture_free(&picture);
    set_close(&set);
}

/* ---- windows -------------------------------------------------------------------------------------------------- */

typedef struct windows {
    unsigned tile_width, tile_height;
    unsigned count, whys;
    uint8_t times[HEIGHT][WIDTH];
} windows_t;

static void window(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom, unsigned why) {
    windows_t *w = context;
    assert_true(left < right && top < bottom);
    assert_int_equal(left / w->tile_width, (right - 1) / w->tile_width);
    assert_int_equal(top / w->tile_height, (bottom - 1) / w->tile_height);
    assert_true(why <= TUILE_WHY_PIXEL);
    if (why == TUILE_WHY_PIXEL) { assert_true(right - left == 1 && bottom - top == 1); }
    for (unsigned y = top; y < bottom; y++) {
        for (unsigned x = left; x < right; x++) {
            w->times[y][x]++;
        }
    }
    w->whys |= 1u << why;
    w->count++;
}

static void windows_tile_the_window(void **state) {
    static const uint8_t variants[] = {0,
                                       TUILE_WARNOCK_QUARTERS,
                                       TUILE_WARNOCK_SINGLE,
                                       TUILE_WARNOCK_BOX,
                                       TUILE_WARNOCK_PIXELS,
                                       TUILE_WARNOCK_SINGLE | TUILE_WARNOCK_BOX | TUILE_WARNOCK_SORTED | TUILE_WARNOCK_PIXELS};
    static const uint16_t tiles[][2] = {{WIDTH, 24}, {32, 32}, {WIDTH, HEIGHT}, {17, 13}};
    (void)state;
    for (unsigned v = 0; v < CHECK_COUNT(variants); v++) {
        for (unsigned k = 0; k < CHECK_COUNT(tiles); k++) {
            stage_t stage;
            mesh_t mesh;
            windows_t w = {.tile_width = tiles[k][0], .tile_height = tiles[k][1]};
            const tuile_trace_t trace = {.context = &w, .window = window};
            model_torus(&mesh, 12, 7, false);
            stage_open(&stage, &mesh, WIDTH, HEIGHT);
            tuile_config_t config = stage_panel_config(&stage);
            config.width = WIDTH;
            config.height = HEIGHT;
            config.tile_width = tiles[k][0];
            config.tile_height = tiles[k][1];
            config.method = TUILE_WARNOCK;
            config.warnock = variants[v];
            config.trace = &trace;
            free(frame_draw(&stage.view.scene, &config, 1 << 20, NULL));
            for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
                if (w.times[i / WIDTH][i % WIDTH] != 1) {
                    fail_msg("variant %u, tile %u: %u windows hold pixel %u, %u", variants[v], k, w.times[i / WIDTH][i % WIDTH],
                             i % WIDTH, i / WIDTH);
                }
            }
            assert_true(w.whys & 1u << TUILE_WHY_EMPTY && w.whys & 1u << TUILE_WHY_PIXEL);
            assert_in_range(w.count, 50, WIDTH * HEIGHT);
            stage_close(&stage);
        }
    }
}

/* ---- order ---------------------------------------------------------------------------------------------------- */

typedef struct order {
    const tuile_model_t *model;
    uint32_t number, id;
    bool open;                      /* a face of this tile has come */
    uint32_t last[HEIGHT][WIDTH];   /* number + 1 of the last face at each pixel */
    uint32_t source[HEIGHT][WIDTH]; /* its source + 1 */
    uint32_t before[HEIGHT][WIDTH]; /* sources + 1, four bits each, the latest lowest */
} order_t;

static void tile_of_order(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom) {
    order_t *o = context;
    (void)left, (void)top, (void)right, (void)bottom;
    o->open = false;
}

static void face_of_order(void *context, uint32_t number, uint32_t id) {
    order_t *o = context;
    assert_true(!o->open || number > o->number);
    assert_in_range(id, 1, o->model->face_count);
    o->open = true;
    o->number = number;
    o->id = id;
}

static void span_of_order(void *context, unsigned row, unsigned first, unsigned end) {
    order_t *o = context;
    for (unsigned x = first; x < end; x++) {
        assert_true(o->number + 1 > o->last[row][x]);
        o->last[row][x] = o->number + 1;
        o->source[row][x] = 1 + tuile_model_source_face(o->model, o->id - 1);
        o->before[row][x] = o->before[row][x] << 4 | o->source[row][x];
    }
}

static void draw_order(set_t *set, order_t *order) {
    const tuile_trace_t trace = {.context = order, .tile = tile_of_order, .face = face_of_order, .span = span_of_order};
    tuile_config_t config = set->config;
    memset(order, 0, sizeof *order);
    order->model = &set->model;
    config.trace = &trace;
    config.format = TUILE_FACE_IDS;
    free(frame_draw(&set->scene, &config, 1 << 20, NULL));
}

static const tuile_method_t painters[] = {TUILE_PAINTER, TUILE_TREE};

/* Three sheets over one another, the middle one first in the model. */
static void sheets_are_numbered_from_back_to_front(void **state) {
    static order_t order;
    (void)state;
    for (unsigned m = 0; m < CHECK_COUNT(painters); m++) {
        set_t set;
        mesh_t mesh;
        model_start(&mesh);
        rectangle(&mesh, -2, -2, 1, 2, 0);
        rectangle(&mesh, -1, -1.5, 2, 1.5, 3);
        rectangle(&mesh, -3, -1, 3, 1, -3);
        set_open(&set, &mesh, painters[m]);
        draw_order(&set, &order);
        assert_int_equal(order.before[40][56], 0x312);     /* x = 0, y = 0: all three */
        assert_int_equal(order.before[60][56], 0x12);      /* y = -1.25: above the last */
        assert_int_equal(order.before[10][40], 0x1);       /* x = -1, y = 1.9 */
        assert_int_equal(order.before[40][10], 0x3);       /* x = -2.9 */
        assert_int_equal(order.before[40][56 - 24], 0x31); /* x = -1.5 */
        assert_int_equal(order.before[40][56 + 24], 0x32);
        assert_int_equal(order.before[2][2], 0);
        set_close(&set);
    }
}

/* Four beams in a ring, each over the next one: what is painted last is what the z-buffer sees, and some face was cut. */
static void beams(mesh_t *mesh) {
    static const double turns[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    model_start(mesh);
    for (unsigned i = 0; i < 4; i++) {
        static const uint32_t sides[6][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}};
        const double c = turns[i][0], s = turns[i][1];
        uint32_t first = 0;
        for (unsigned k = 0; k < 8; k++) {
            const double x = k & 1 ? 1.5 : -1.5, y = k & 2 ? -0.75 : -1.25, z = (k & 1 ? 0.375 : -0.625) + (k & 4 ? 0.25 : 0);
            const uint32_t at = model_position(mesh, c * x - s * y, s * x + c * y, z);
            first = k == 0 ? at : first;
        }
        for (unsigned f = 0; f < 6; f++) {
            uint32_t corners[4];
            for (unsigned k = 0; k < 4; k++) {
                corners[k] = first + sides[f][k];
            }
            model_face(mesh, corners, 4, model_material(mesh, 200, 200, 200));
        }
    }
}

static void the_last_face_painted_is_the_one_seen(void **state) {
    static order_t order;
    (void)state;
    for (unsigned m = 0; m < CHECK_COUNT(painters); m++) {
        set_t set, plain;
        mesh_t mesh;
        unsigned pieces[25] = {0}, seen = 0;
        uint32_t piece_of[25] = {0};
        beams(&mesh);
        set_open(&plain, &mesh, TUILE_ZBUFFER);
        beams(&mesh);
        set_open(&set, &mesh, painters[m]);
        draw_order(&set, &order);
        uint32_t *ids = frame_draw_ids(&plain.scene, WIDTH, HEIGHT);
        for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
            const uint32_t id = ids[i], source = order.source[i / WIDTH][i % WIDTH], last = order.last[i / WIDTH][i % WIDTH];
            const uint32_t expected = id ? 1 + tuile_model_source_face(&plain.model, id - 1) : 0;
            if (source != expected) { fail_msg("%u, %u: %u painted last, %u seen", i % WIDTH, i / WIDTH, source, expected); }
            seen += id > 0;
            if (source && piece_of[source] != last) {
                piece_of[source] = last;
                pieces[source]++;
            }
        }
        assert_int_equal(seen, 4 * 48 * 8 - 4 * 8 * 8); /* four beams and four crossings */
        unsigned cut = 0;
        for (unsigned source = 1; source <= 24; source++) {
            cut += pieces[source] > 1;
        }
        assert_true(cut > 0);
        free(ids);
        set_close(&set);
        set_close(&plain);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_view_is_a_picture_of_its_size),
        cmocka_unit_test(names_of_no_view_are_refused_with_a_list),
        cmocka_unit_test(overdraw_by_hand),
        cmocka_unit_test(edges_by_hand),
        cmocka_unit_test(windows_tile_the_window),
        cmocka_unit_test(sheets_are_numbered_from_back_to_front),
        cmocka_unit_test(the_last_face_painted_is_the_one_seen),
    };
    return cmocka_run_group_tests_name("show", tests, cli_set_up, cli_tear_down);
}
