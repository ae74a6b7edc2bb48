/* Corners between the whole steps, where the display tree cut a face: where they come to stand, how they are clipped, and picked.
 */
#include "support/check.h"
#include "support/frame.h"
#include "support/random.h"
#include "support/set_up.h"
#include "support/solids.h"

#include <math.h>

#include "../raster/geometry/clip.h"
#include "../raster/geometry/vertex.h"

/* The view of q + f / 256: it is affine in the position. */
static void view_between(const set_up_t *s, const int16_t q[3], const int8_t f[3], long double view[3]) {
    set_up_view(s, q, view);
    long double whole[3] = {view[0], view[1], view[2]};
    for (unsigned k = 0; k < 3; k++) {
        int16_t next[3] = {q[0], q[1], q[2]};
        const int16_t way = q[k] < 0 ? 1 : -1;
        long double beside[3];
        next[k] = (int16_t)(q[k] + way);
        set_up_view(s, next, beside);
        for (unsigned i = 0; i < 3; i++) {
            view[i] += (beside[i] - whole[i]) * way * f[k] / 256;
        }
    }
}

static void random_set_up(set_up_t *s, random_source_t *random, bool orthographic) {
    set_up_simple(s);
    const int bits = random_between(random, 2, 12); /* a step is 1/4 ... 1/4096 units: from 25 pixels to 1/40 at a distance of 1 */
    s->model.step.exponent = -bits;
    random_rotation(random, s->instance.pose.rotation);
    random_rotation(random, s->scene.camera.rotation);
    s->scene.camera.near = TUILE_Q16(0.5);
    if (orthographic) {
        s->scene.camera.projection = TUILE_ORTHOGRAPHIC;
        s->scene.camera.focal_x = s->scene.camera.focal_y = TUILE_Q16(2) << random_between(random, 0, 3);
    }
    const long double middle[3] = {0, 0, -(long double)random_real(random, 1, 300)};
    assert_true(set_up_stand(s, (const int16_t[3]){0, 0, 0}, middle));
}

static void corners_between_steps_land_within_their_error(void **state) {
    random_source_t random = random_seed(81);
    long double worst = 0, worst_depth = 0;
    unsigned inside = 0, moved = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(30000); round++) {
        enum { COUNT = 6 };
        set_up_t s;
        transform_t transform;
        int16_t q[COUNT][3];
        int8_t f[COUNT][3];
        vertex_t v[COUNT], before[COUNT];
        random_set_up(&s, &random, round % 2);
        const int error = set_up_transform(&s, &transform);
        if (error) {
            assert_int_equal(error, TUILE_ERROR_RANGE);
            continue;
        }
        for (unsigned i = 0; i < COUNT; i++) {
            for (unsigned k = 0; k < 3; k++) {
                q[i][k] = (int16_t)random_any_size(&random, 12);
                f[i][k] = (int8_t)random_between(&random, -128, 127);
            }
        }
        memset(f[1], 0, sizeof f[1]);
        memcpy(q[5], q[4], sizeof q[5]); /* the same place twice */
        memcpy(f[5], f[4], sizeof f[5]);
        (void)vertex_stage(&transform, q[0], NULL, COUNT, v);
        for (unsigned i = 0; i < COUNT; i++) {
            v[i].depth_light = (v[i].depth_light & ~255u) | (17 * i + 2);
        }
        memcpy(before, v, sizeof v);
        const bool any_outside = vertex_fractions(&transform, q[0], f[0], COUNT, v);
        bool found = false;
        assert_memory_equal(&v[1], &before[1], sizeof v[1]); /* whole: left alone */
        assert_int_equal(v[4].x, v[5].x);
        assert_int_equal(v[4].y, v[5].y);
        assert_int_equal(v[4].depth_light >> 8, v[5].depth_light >> 8);
        for (unsigned i = 0; i < COUNT; i++) {
            long double view[3], x, y, depth;
            assert_int_equal(v[i].depth_light & 255, 17 * i + 2); /* light is kept */
            if (i == 1) { continue; }
            found |= v[i].x == VERTEX_OUTSIDE;
            view_between(&s, q[i], f[i], view);
            const bool clearly = -view[2] > 0.51L && -view[2] < 999;
            if (clearly || round % 2) { set_up_window(&s, view, &x, &y, &depth); }
            if (v[i].x == VERTEX_OUTSIDE) {
                assert_true(!clearly || fabsl(x) > 700 || fabsl(y) > 700); /* the guard band reaches 864 pixels beyond the window */
                continue;
            }
            set_up_window(&s, view, &x, &y, &depth);
            worst = fmaxl(worst, fmaxl(fabsl(x - v[i].x / 16.0L), fabsl(y - v[i].y / 16.0L)));
            worst_depth = fmaxl(worst_depth, fabsl(depth - (v[i].depth_light >> 8) / 256.0L) / fmaxl(1, depth / 65536 * 8));
            moved += v[i].x != before[i].x || v[i].y != before[i].y;
            inside++;
        }
        assert_int_equal(any_outside, found);
    }
    print_message("%u corners, %u moved by their fraction; off by at most %.4Lf px, %.3Lf steps\n", inside, moved, worst,
                  worst_depth);
    assert_true(inside > CHECK_ROUNDS(30000) && moved * 4 > inside);
    assert_true(worst < 1 / 32.0L + 1 / 80.0L); /* half of 1/16, and the error before the snap (DESIGN.md) */
    assert_true(worst_depth < 1);
}

/* One corner of a triangle is behind the near plane: the sides that lead to it end where they meet that plane. */
static void faces_are_clipped_where_their_corners_between_steps_lead(void **state) {
    random_source_t random = random_seed(82);
    unsigned clipped = 0;
    long double worst = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(4000); round++) {
        static const uint8_t corners[3] = {0, 1, 2};
        set_up_t s;
        transform_t transform;
        vertex_t v[3], out[16];
        int8_t f[3][3];
        set_up_simple(&s);
        s.model.step.exponent = -3; /* 1/8 unit: a fraction of a half is some pixels */
        const int16_t q[3][3] = {{(int16_t)random_between(&random, -30, 30), (int16_t)random_between(&random, -30, 30), -80},
                                 {(int16_t)random_between(&random, -30, 30), (int16_t)random_between(&random, -30, 30), -60},
                                 {(int16_t)random_between(&random, -4, 4), (int16_t)random_between(&random, -4, 4),
                                  (int16_t)random_between(&random, 2, 30)}};
        for (unsigned i = 0; i < 9; i++) {
            f[i / 3][i % 3] = (int8_t)random_between(&random, -128, 127);
        }
        assert_int_equal(set_up_transform(&s, &transform), TUILE_OK);
        (void)vertex_stage(&transform, q[0], NULL, 3, v);
        assert_true(vertex_fractions(&transform, q[0], f[0], 3, v));
        const clip_face_t face = {q[0], f[0], v, corners, 3};
        assert_int_equal(clip_polygon(&transform, &face, out, 16), 4);
        long double views[3][3];
        for (unsigned i = 0; i < 3; i++) {
            view_between(&s, q[i], f[i], views[i]);
        }
        for (unsigned i = 0; i < 2; i++) { /* each of the others, as it was; and the side from it to the plane w = 1 */
            const long double at = (-1 - views[i][2]) / (views[2][2] - views[i][2]);
            long double place[3], x, y, depth, least = 1e9L;
            for (unsigned k = 0; k < 3; k++) {
                place[k] = views[i][k] + at * (views[2][k] - views[i][k]);
            }
            set_up_window(&s, place, &x, &y, &depth);
            bool kept = false;
            for (unsigned o = 0; o < 4; o++) {
                kept |= out[o].x == v[i].x && out[o].y == v[i].y;
                least = fminl(least, fmaxl(fabsl(out[o].x / 16.0L - x), fabsl(out[o].y / 16.0L - y)));
            }
            assert_true(kept);
            worst = fmaxl(worst, least);
        }
        clipped++;
    }
    print_message("%u clipped, off by at most %.4Lf px\n", clipped, worst);
    assert_true(worst < 1 / 16.0L);
}

/* ---- picking -------------------------------------------------------------------------------------------------- */

/* Bars through one another: a tree that cuts. */
static void crossed(mesh_t *mesh) {
    model_start(mesh);
    for (unsigned k = 0; k < 3; k++) {
        const double thick[3] = {0.31, 0.43, 0.52};
        double low[3], high[3];
        for (unsigned i = 0; i < 3; i++) {
            high[i] = i == k ? 1.5 : thick[(i + k) % 3] + 0.01 * i;
            low[i] = -high[i] - 0.03 * k;
        }
        model_box(mesh, low, high, model_material(mesh, 200, 90, 60 + 70 * k));
    }
    for (size_t p = 0; p < mesh->position_count; p++) { /* leaning */
        double *at = mesh->positions[p];
        at[0] += 0.21 * at[1] + 0.13 * at[2];
        at[1] += 0.17 * at[2];
    }
}

/* The point is on the plane of the piece; its corners were rounded to 1/256 step, the source's to whole ones: where faces of the
 * source are flat on the grid the point is within some 1/256 of their plane. Here each is of three corners. */
static void a_point_picked_on_a_cut_face_lies_in_its_plane(void **state) {
    static uint64_t block[4096];
    random_source_t random = random_seed(83);
    solid_model_t model;
    mesh_t mesh, triangles;
    unsigned hits = 0, between = 0;
    double worst = 0, sum = 0;
    (void)state;
    crossed(&mesh);
    model_start(&triangles);
    const uint32_t grey = model_material(&triangles, 128, 128, 128);
    for (size_t p = 0; p < mesh.position_count; p++) {
        (void)model_position(&triangles, mesh.positions[p][0], mesh.positions[p][1], mesh.positions[p][2]);
    }
    for (size_t i = 0; i < mesh.face_count; i++) {
        const uint32_t *c = mesh.corners + mesh.faces[i].first;
        model_face(&triangles, (const uint32_t[3]){c[0], c[1], c[2]}, 3, grey);
        model_face(&triangles, (const uint32_t[3]){c[0], c[2], c[3]}, 3, grey);
    }
    mesh_free(&mesh);
    solid_model_open(&model, &triangles, false);
    const tuile_model_t *opened = &model.compiled.model;
    assert_non_null(opened->fractions);
    for (uint32_t v = 0; v < 3 * opened->vertex_count; v++) {
        between += opened->fractions[v] != 0;
    }
    assert_true(between > 0 && model.compiled.report.tree.splits > 0);
    const double step = ldexp(opened->step.mantissa, opened->step.exponent);
    for (unsigned round = 0; round < CHECK_ROUNDS(600); round++) {
        solids_t solids;
        solids_start(&solids, 64, 48);
        (void)solids_add(&solids, &model);
        double eye[3];
        for (unsigned k = 0; k < 3; k++) {
            eye[k] = random_real(&random, -4, 4);
        }
        solids_look(&solids, eye, (const double[3]){0, 0, 0});
        const tuile_config_t config = solids_config(&solids, TUILE_TREE);
        for (unsigned n = 0; n < 4; n++) {
            tuile_hit_t hit;
            const int result = tuile_pick(&solids.scene, &config, (uint16_t)random_between(&random, 16, 47),
                                          (uint16_t)random_between(&random, 12, 35), block, sizeof block, &hit);
            assert_true(result >= 0);
            if (result == 0) { continue; }
            const mesh_face_t *face = &model.mesh.faces[tuile_model_source_face(opened, hit.face)];
            double at[3][3], normal[3], off = 0, length = 0;
            for (unsigned i = 0; i < 3; i++) {
                for (unsigned k = 0; k < 3; k++) {
                    at[i][k] = floor(model.mesh.positions[model.mesh.corners[face->first + i]][k] / step + 0.5) - opened->offset[k];
                }
            }
            for (unsigned k = 0; k < 3; k++) {
                const unsigned b = (k + 1) % 3, c = (k + 2) % 3;
                normal[k] = (at[1][b] - at[0][b]) * (at[2][c] - at[0][c]) - (at[1][c] - at[0][c]) * (at[2][b] - at[0][b]);
                length += normal[k] * normal[k];
            }
            for (unsigned k = 0; k < 3; k++) {
                off += normal[k] / sqrt(length) * (hit.point[k] / 65536.0 - at[0][k]);
            }
            worst = fmax(worst, fabs(off));
            sum += fabs(off);
            hits++;
        }
    }
    print_message("%u hits, off the plane of their source by %.4f steps, in the mean %.4f\n", hits, worst, sum / hits);
    assert_true(hits > CHECK_ROUNDS(600));
    assert_true(worst < 2 && sum / hits < 0.02); /* a piece that is long and narrow may lean on its rounded corners */
    solid_model_close(&model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_between_steps_land_within_their_error),
        cmocka_unit_test(faces_are_clipped_where_their_corners_between_steps_lead),
        cmocka_unit_test(a_point_picked_on_a_cut_face_lies_in_its_plane),
    };
    return cmocka_run_group_tests_name("fractions", tests, NULL, NULL);
}
