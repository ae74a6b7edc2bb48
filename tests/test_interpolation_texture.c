/* Texture addresses of whole frames against exact arithmetic. The texture's colours are its addresses: 256 x 256 texels of 16 bits,
 * s in the upper and t in the lower byte. So each pixel of a picture tells which texel it was given. */
#include "reference/exact_face.h"
#include "support/check.h"
#include "support/frame.h"
#include "support/models.h"
#include "support/random.h"
#include "support/set_up.h"

#include "../raster/geometry/model.h"

#include <math.h>

#define WIDTH 96
#define HEIGHT 72
#define SIDE 256

/* A model of one triangle before a camera at the origin that looks along -z. */
typedef struct textured {
    uint8_t *bytes;
    tuile_model_t model;
    tuile_instance_t instance;
    tuile_scene_t scene;
    exact_face_t *face;
} textured_t;

static void addresses(mesh_t *mesh) {
    mesh->textures = calloc(1, sizeof *mesh->textures);
    assert_non_null(mesh->textures);
    mesh->texture_count = 1;
    mesh->textures[0] = (mesh_texture_t){.name = strdup("addresses"),
                                         .texels = malloc(2 * SIDE * SIDE),
                                         .size_bytes = 2 * SIDE * SIDE,
                                         .width = SIDE,
                                         .height = SIDE,
                                         .format = TUILE_TEXEL_RGB565,
                                         .levels = 1};
    assert_non_null(mesh->textures[0].texels);
    for (unsigned i = 0; i < SIDE * SIDE; i++) {
        mesh->textures[0].texels[2 * i] = (uint8_t)(i / SIDE);
        mesh->textures[0].texels[2 * i + 1] = (uint8_t)(i % SIDE);
    }
}

static bool textured_open(textured_t *x, const double at[3][3], const double st[3][2], uint8_t uv_bits) {
    mesh_t mesh;
    size_t size_bytes;
    sim_error_t error = {""};
    uint32_t corner[3];
    model_start(&mesh);
    for (int i = 0; i < 3; i++) {
        corner[i] = model_position(&mesh, at[i][0], at[i][1], at[i][2]);
    }
    model_face(&mesh, corner, 3, model_material(&mesh, 255, 255, 255));
    mesh.surfaces = calloc(1, sizeof *mesh.surfaces);
    mesh.texcoords = calloc(3, sizeof *mesh.texcoords);
    assert_true(mesh.surfaces && mesh.texcoords);
    mesh.surfaces[0] = (tuile_material_t){.alpha = 255, .uv_bits = uv_bits, .flags = TUILE_MATERIAL_UNLIT};
    memcpy(mesh.texcoords, st, 3 * sizeof *mesh.texcoords);
    addresses(&mesh);
    memset(x, 0, sizeof *x);
    const int result = mesh_compile(&mesh, NULL, &x->bytes, &size_bytes, NULL, &error);
    mesh_free(&mesh);
    if (result != 0) { return false; } /* no area */
    assert_int_equal(tuile_model_open(&x->model, x->bytes, size_bytes), TUILE_OK);
    x->instance = (tuile_instance_t){.model = &x->model, .pose = {.scale = TUILE_SCALE_ONE}, .two_sided = true};
    tuile_rotation(x->instance.pose.rotation, 0, 0);
    x->scene = (tuile_scene_t){.instances = &x->instance, .instance_count = 1};
    x->scene.camera = (tuile_camera_t){.focal_x = TUILE_Q16(60),
                                       .focal_y = TUILE_Q16(60),
                                       .centre_x = TUILE_Q16(WIDTH / 2),
                                       .centre_y = TUILE_Q16(HEIGHT / 2),
                                       .near = TUILE_Q16(1),
                                       .far = TUILE_Q16(128)};
    tuile_rotation(x->scene.camera.rotation, 0, 0);
    x->face = exact_faces(&x->scene);
    return true;
}

static void textured_close(textured_t *x) {
    free(x->face);
    free(x->bytes);
}

/* How far an address is from texel `texel` of a texture that repeats: 0 within it. */
static long double away(long double at, unsigned texel) {
    const long double in = at - texel, turn = in - SIDE * floorl(in / SIDE); /* 0 ... SIDE, wanted: 0 ... 1 */
    return turn <= 1 ? 0 : fminl(turn - 1, SIDE - turn);
}

typedef struct worst {
    long double off,
        excess_px; /* texels; pixels by which a corner's place would have to be off to explain more than half a texel */
    uint32_t faces, pixels;
} worst_t;

static uint8_t *draw(const textured_t *x, unsigned round, tuile_stats_t *stats) {
    const tuile_config_t config = {.width = WIDTH,
                                   .height = HEIGHT,
                                   .tile_width = round % 3 ? 0 : 40,
                                   .tile_height = 24,
                                   .format = TUILE_RGB565_LE,
                                   .method = (uint8_t)(round % TUILE_TREE),
                                   .shade = (uint8_t)(round / 4 % 2),
                                   .effects = TUILE_SURFACES,
                                   .texturing = TUILE_TEXTURE_NO_MIPS};
    return frame_draw(&x->scene, &config, (size_t)1 << 20, stats);
}

/* Depths are kept in 1/256 step and may be one such off. */
static long double depth_part(const exact_face_t *face) {
    long double least = HUGE_VALL, low[2] = {HUGE_VALL, HUGE_VALL}, high[2] = {-HUGE_VALL, -HUGE_VALL};
    for (int i = 0; i < 3; i++) {
        const exact_corner_t *c = &face->corner[i];
        least = fminl(least, c->depth);
        low[0] = fminl(low[0], c->s), high[0] = fmaxl(high[0], c->s);
        low[1] = fminl(low[1], c->t), high[1] = fmaxl(high[1], c->t);
    }
    return fmaxl(high[0] - low[0], high[1] - low[1]) / 256 / least;
}

/* Whole faces: through the snapped corners. */
static void measure_whole(const textured_t *x, const uint8_t *picture, const uint32_t *ids, worst_t *worst) {
    const long double allowed = 0.5L + depth_part(x->face);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        if (!ids[i]) { continue; }
        const exact_point_t p = exact_at(x->face, i % WIDTH, i / WIDTH, true);
        const long double off = fmaxl(away(p.s, picture[2 * i + 1]), away(p.t, picture[2 * i]));
        if (off > allowed) {
            fail_msg("pixel %u,%u: texel %u,%u for %.3Lf,%.3Lf", i % WIDTH, i / WIDTH, picture[2 * i + 1], picture[2 * i], p.s,
                     p.t);
        }
        worst->off = fmaxl(worst->off, off);
        worst->pixels++;
    }
    worst->faces++;
}

static double corner_at(random_source_t *random, double range) {
    return random_one_in(random, 3) ? random_real(random, -range, range) : random_real(random, -range, range) / 16;
}

/* In the window, from slivers to faces that fill it. */
static void corner_before(random_source_t *random, double spread, double w, double at[3]) {
    at[0] = random_real(random, -0.79, 0.79) * spread * w;
    at[1] = random_real(random, -0.59, 0.59) * spread * w;
    at[2] = -w;
}

/* 1 ... 100, so up to 100 to 1 in a face; or so near to `first` that a face `range` texels across is just or not quite affine. */
static double distance(random_source_t *random, bool alike, double first, double range) {
    if (alike) { return first * (1 + random_real(random, 0, 4 / range)); }
    return 1.001 * exp(random_real(random, 0, log(100)));
}

static void texels_of_whole_faces_are_within_half_a_texel(void **state) {
    random_source_t random = random_seed(61);
    worst_t worst = {0};
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(500); round++) {
        double at[3][3], st[3][2];
        const uint8_t bits = (uint8_t)random_between(&random, 0, 8);
        const double spread = round % 2 ? 1 : 0.1, most = 32767.0 / (1 << bits),
                     range = fmin(most, 16 << random_between(&random, 0, 11));
        const double first = distance(&random, false, 0, 0) * (round % 4 == 1 ? 0.9 : 1) + 0.11;
        for (int i = 0; i < 3; i++) {
            corner_before(&random, spread, distance(&random, round % 4 == 1, first, range), at[i]);
            if (round % 5 == 0 && i == 2) { /* a sliver */
                for (int k = 0; k < 3; k++) {
                    at[2][k] = (at[0][k] + at[1][k]) / 2 + (k < 2 ? random_real(&random, -0.05, 0.05) : 0);
                }
            }
            st[i][0] = corner_at(&random, range);
            st[i][1] = corner_at(&random, range);
        }
        textured_t x;
        if (!textured_open(&x, (const double(*)[3])at, (const double(*)[2])st, bits)) { continue; }
        tuile_stats_t stats;
        uint8_t *picture = draw(&x, round, &stats);
        uint32_t *ids = frame_draw_ids(&x.scene, WIDTH, HEIGHT);
        if (stats.faces_clipped == 0) { measure_whole(&x, picture, ids, &worst); }
        free(ids);
        free(picture);
        textured_close(&x);
    }
    print_message("whole faces: %u, %u pixels, at most %.4Lf texel off\n", worst.faces, worst.pixels, worst.off);
    assert_true(worst.pixels > CHECK_ROUNDS(10000));
}

/* What is left of a face that was cut has corners of its own, each snapped by up to 0.0442 pixel: as many texels more may an
 * address be off as lie there in that distance. (A polygon is drawn by the plane of three of its corners, and once was held to
 * their depths beyond them: up to 18 texels off.) */
#define SNAP_PX 0.0442L

static void measure_cut(const textured_t *x, const uint8_t *picture, const uint32_t *ids, worst_t *worst) {
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        exact_point_t p, right, below;
        const long double cx = i % WIDTH + 0.5L, cy = i / WIDTH + 0.5L;
        if (!ids[i] || !exact_plane_at(x->face, cx, cy, &p) || !exact_plane_at(x->face, cx + 0.125L, cy, &right) ||
            !exact_plane_at(x->face, cx, cy + 0.125L, &below)) {
            continue;
        }
        const unsigned texel[2] = {picture[2 * i + 1], picture[2 * i]};
        const long double at[2] = {p.s, p.t},
                          slope[2] = {8 * hypotl(right.s - p.s, below.s - p.s), 8 * hypotl(right.t - p.t, below.t - p.t)};
        for (int k = 0; k < 2; k++) {
            if (slope[k] > SIDE / 4) { continue; } /* an address modulo 256 would say nothing */
            const long double off = away(at[k], texel[k]);
            worst->off = fmaxl(worst->off, off);
            if (off > 0.5L) { worst->excess_px = fmaxl(worst->excess_px, (off - 0.5L) / slope[k]); }
        }
        worst->pixels++;
    }
    worst->faces++;
}

static void texels_of_cut_faces_are_where_the_uncut_face_has_them(void **state) {
    random_source_t random = random_seed(62);
    worst_t worst = {0};
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(500); round++) {
        double at[3][3], st[3][2];
        const double range = 16 << random_between(&random, 0, 5);
        for (int i = 0; i < 3; i++) {
            at[i][0] = random_real(&random, -1, 1) * (random_one_in(&random, 4) ? 400 : 10);
            at[i][1] = random_real(&random, -1, 1) * (random_one_in(&random, 4) ? 400 : 10);
            at[i][2] = random_real(&random, -60, 20);
            st[i][0] = random_real(&random, -range, range);
            st[i][1] = random_real(&random, -range, range);
        }
        textured_t x;
        if (!textured_open(&x, (const double(*)[3])at, (const double(*)[2])st, 4)) { continue; }
        tuile_stats_t stats;
        uint8_t *picture = draw(&x, round, &stats);
        uint32_t *ids = frame_draw_ids(&x.scene, WIDTH, HEIGHT);
        if (stats.faces_clipped > 0) { measure_cut(&x, picture, ids, &worst); }
        free(ids);
        free(picture);
        textured_close(&x);
    }
    print_message("cut faces: %u, %u pixels, at most %.4Lf texel off; half a texel and %.4Lf pixel\n", worst.faces, worst.pixels,
                  worst.off, worst.excess_px);
    assert_true(worst.pixels > CHECK_ROUNDS(10000));
    assert_true(worst.excess_px <= SNAP_PX);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texels_of_whole_faces_are_within_half_a_texel),
        cmocka_unit_test(texels_of_cut_faces_are_where_the_uncut_face_has_them),
    };
    return cmocka_run_group_tests_name("interpolation of textures", tests, NULL, NULL);
}
