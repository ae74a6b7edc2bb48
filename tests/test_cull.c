/* Culling of clusters: what can be seen is never dropped. */
#include "support/check.h"
#include "support/frame.h"
#include "support/stage.h"

#include <math.h>

#include "../raster/geometry/cull.h"
#include "../raster/geometry/model.h"
#include "../raster/geometry/transform.h"
#include "support/random.h"
#include "support/set_up.h"

#define CLUSTER_VERTICES 12
#define CLUSTER_FACES 8

typedef struct test_cluster {
    uint8_t bytes[MODEL_CLUSTER_BYTES];
    int16_t q[CLUSTER_VERTICES][3];
    uint8_t faces[CLUSTER_FACES][3];
    long double normals[CLUSTER_FACES][3];
} test_cluster_t;

static void put16(uint8_t *p, int32_t value) {
    p[0] = (uint8_t)(value & 0xff);
    p[1] = (uint8_t)((value >> 8) & 0xff);
}

static long double dot3(const long double a[3], const long double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Vertices near one plane through a random centre; sphere, axis and cutoff by definition. */
static void random_cluster(random_source_t *random, test_cluster_t *c) {
    const int size = random_between(random, 3, random_one_in(random, 2) ? 300 : 8000), bump = random_between(random, 0, size / 2);
    const int axis_aligned = random_one_in(random, 3) ? random_between(random, 0, 2) : -1;
    q2_30_t r[3][3];
    int32_t centre[3], radius = 0;
    random_rotation(random, r);
    for (int i = 0; i < 3; i++) {
        centre[i] = random_between(random, -32767 + 2 * size, 32767 - 2 * size);
    }
    for (int v = 0; v < CLUSTER_VERTICES; v++) {
        const double local[3] = {random_real(random, -size, size), random_real(random, -size, size),
                                 random_real(random, -bump, bump)};
        for (int i = 0; i < 3; i++) {
            double at = 0;
            for (int j = 0; j < 3; j++) {
                at += r[j][i] * 0x1p-30 * local[j];
            }
            if (axis_aligned >= 0) { at = i == axis_aligned ? 0 : local[i == (axis_aligned + 1) % 3]; }
            c->q[v][i] = (int16_t)(centre[i] + (int)at);
        }
        const double dx = c->q[v][0] - centre[0], dy = c->q[v][1] - centre[1], dz = c->q[v][2] - centre[2];
        const int32_t away = (int32_t)ceil(sqrt(dx * dx + dy * dy + dz * dz));
        radius = away > radius ? away : radius;
    }
    long double mean[3] = {0, 0, 0};
    const long double up[3] = {r[2][0], r[2][1], r[2][2]};
    for (int f = 0; f < CLUSTER_FACES; f++) {
        long double length = 0;
        for (int tries = 0; length == 0 && tries < 100; tries++) {
            for (int i = 0; i < 3; i++) {
                c->faces[f][i] = (uint8_t)random_between(random, 0, CLUSTER_VERTICES - 1);
            }
            const int16_t *p0 = c->q[c->faces[f][0]], *p1 = c->q[c->faces[f][1]], *p2 = c->q[c->faces[f][2]];
            for (int i = 0; i < 3; i++) {
                const int j = (i + 1) % 3, k = (i + 2) % 3;
                c->normals[f][i] = (long double)(p1[j] - p0[j]) * (p2[k] - p0[k]) - (long double)(p1[k] - p0[k]) * (p2[j] - p0[j]);
            }
            length = sqrtl(dot3(c->normals[f], c->normals[f]));
        }
        if (length == 0) { length = 1; }
        if (axis_aligned >= 0 ? c->normals[f][axis_aligned] < 0 : dot3(c->normals[f], up) < 0) { length = -length; }
        for (int i = 0; i < 3; i++) {
            c->normals[f][i] /= length;
            mean[i] += c->normals[f][i];
        }
    }
    memset(c->bytes, 0, sizeof c->bytes);
    for (int i = 0; i < 3; i++) {
        put16(c->bytes + CLUSTER_AT_CENTRE + 2 * i, centre[i]);
    }
    put16(c->bytes + CLUSTER_AT_RADIUS, radius);
    const long double length = sqrtl(dot3(mean, mean));
    long double axis[3], least = 1;
    for (int i = 0; i < 3; i++) {
        const int a = length > 0 ? (int)lroundl(mean[i] / length * 127) : 0;
        c->bytes[CLUSTER_AT_AXIS + i] = (uint8_t)(a & 0xff);
        axis[i] = a;
    }
    const long double axis_length = sqrtl(dot3(axis, axis));
    for (int f = 0; f < CLUSTER_FACES; f++) {
        least = fminl(least, axis_length > 0 ? dot3(axis, c->normals[f]) / axis_length : -1);
    }
    if (least <= 0) {
        c->bytes[CLUSTER_AT_CUTOFF] = 255;
    } else {
        const long double cutoff = ceill(254 * sqrtl(fmaxl(0, 1 - least * least)) - 1e-12L);
        c->bytes[CLUSTER_AT_CUTOFF] = (uint8_t)(cutoff > 254 ? 255 : cutoff);
    }
}

static bool random_view(random_source_t *random, set_up_t *s) {
    set_up_simple(s);
    const bool ortho = random_one_in(random, 2);
    s->model.step = (tuile_scale_t){1, -8};
    if (random_one_in(random, 2)) {
        random_rotation(random, s->instance.pose.rotation);
        random_rotation(random, s->scene.camera.rotation);
    } else if (random_one_in(random, 2)) {
        tuile_rotation(s->instance.pose.rotation, random_between(random, 0, 2), (bam16_t)(random_between(random, 0, 3) * 0x4000));
    }
    for (int i = 0; i < 3; i++) {
        s->scene.camera.eye[i] =
            random_between(random, -200, 200) * (random_one_in(random, 2) ? 65536 : 1 << random_between(random, 8, 20));
        s->instance.pose.translation[i] = random_between(random, -65536, 65536);
        s->model.offset[i] = random_between(random, -1000, 1000);
    }
    s->scene.camera.near = TUILE_Q16(0.5);
    s->scene.camera.far = TUILE_Q16(20) + random_between(random, 0, 400) * 65536;
    if (ortho) {
        s->scene.camera.projection = TUILE_ORTHOGRAPHIC;
        s->scene.camera.focal_x = s->scene.camera.focal_y = random_between(random, 6553, 655360);
    }
    return ortho;
}

static void clusters_with_a_vertex_in_the_region_are_never_dropped(void **state) {
    random_source_t random = random_seed(34);
    unsigned culled = 0, seen = 0, missed = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(200000); round++) {
        set_up_t s;
        test_cluster_t c;
        transform_t transform;
        (void)random_view(&random, &s);
        random_cluster(&random, &c);
        if (!random_one_in(&random, 4)) {
            const int16_t centre[3] = {model_i16(c.bytes + CLUSTER_AT_CENTRE), model_i16(c.bytes + CLUSTER_AT_CENTRE + 2),
                                       model_i16(c.bytes + CLUSTER_AT_CENTRE + 4)};
            const double z = random_real(&random, 0, 40);
            const long double wanted[3] = {(long double)random_real(&random, -2 * z, 2 * z),
                                           (long double)random_real(&random, -2 * z, 2 * z), -(long double)z};
            if (!set_up_stand(&s, centre, wanted)) { continue; }
        }
        assert_int_equal(set_up_transform(&s, &transform), TUILE_OK);
        const int32_t left = random_between(&random, 0, 319), top = random_between(&random, 0, 239);
        const transform_region_t region = {(uint16_t)left, (uint16_t)top, (uint16_t)random_between(&random, left + 1, 320),
                                           (uint16_t)random_between(&random, top + 1, 240)};
        transform_region(&transform, &region);
        bool inside = false;
        long double near_by[6] = {-1, -1, -1, -1, -1, -1}; /* greatest distance inside each plane, by any vertex */
        for (int v = 0; v < CLUSTER_VERTICES; v++) {
            long double view[3], x, y, depth;
            set_up_view(&s, c.q[v], view);
            set_up_window(&s, view, &x, &y, &depth);
            const long double w = -view[2], n = s.scene.camera.near / 65536.0L, f = s.scene.camera.far / 65536.0L;
            inside |= w > n && w < f && x > region.left && x < region.right && y > region.top && y < region.bottom;
            near_by[0] = fmaxl(near_by[0], w - n);
            near_by[1] = fmaxl(near_by[1], f - w);
        }
        const bool dropped = cull_outside(&transform, c.bytes);
        assert_false(dropped && inside);
        /* Far behind the eye or beyond the far plane, by more than the sphere can reach: dropped for certain. */
        const long double diameter = 2 * (long double)model_u16(c.bytes + CLUSTER_AT_RADIUS) / 256 + 0.5L;
        if (near_by[0] < -diameter || near_by[1] < -diameter) { missed += !dropped; }
        culled += dropped;
        seen += inside;
    }
    print_message("clusters: %u dropped, %u with a vertex in the region\n", culled, seen);
    assert_int_equal(missed, 0);
    assert_true(culled > 1000 / (CHECK_SANITIZED ? 16 : 1) && seen > 1000 / (CHECK_SANITIZED ? 16 : 1));
}

static void clusters_with_a_front_face_are_never_dropped(void **state) {
    random_source_t random = random_seed(35);
    unsigned dropped = 0, could = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(300000); round++) {
        set_up_t s;
        test_cluster_t c;
        transform_t transform;
        const bool ortho = random_view(&random, &s);
        random_cluster(&random, &c);
        if (random_one_in(&random, 2)) { /* the eye beside the cluster, or in it */
            const int16_t centre[3] = {model_i16(c.bytes + CLUSTER_AT_CENTRE), model_i16(c.bytes + CLUSTER_AT_CENTRE + 2),
                                       model_i16(c.bytes + CLUSTER_AT_CENTRE + 4)};
            const double radius = model_u16(c.bytes + CLUSTER_AT_RADIUS) / 256.0;
            long double wanted[3];
            for (int i = 0; i < 3; i++) {
                wanted[i] = (long double)random_real(&random, -1.5 * radius, 1.5 * radius);
            }
            if (!set_up_stand(&s, centre, wanted)) { continue; }
        }
        assert_int_equal(set_up_transform(&s, &transform), TUILE_OK);
        bool front = false;
        for (int f = 0; f < CLUSTER_FACES; f++) {
            /* In view space: the way the eye looks at a corner, against the face's normal turned there. */
            long double p[3], normal[3], model_normal[3];
            set_up_view(&s, c.q[c.faces[f][0]], p);
            for (int i = 0; i < 3; i++) {
                model_normal[i] = 0;
                for (int j = 0; j < 3; j++) {
                    model_normal[i] += s.instance.pose.rotation[i][j] * 0x1p-30L * c.normals[f][j];
                }
            }
            for (int i = 0; i < 3; i++) {
                normal[i] = 0;
                for (int j = 0; j < 3; j++) {
                    normal[i] += s.scene.camera.rotation[i][j] * 0x1p-30L * model_normal[j];
                }
            }
            const long double facing = ortho ? -normal[2] : dot3(p, normal);
            const long double rounding =
                ortho ? 1e-9L : 1e-9L * sqrtl(dot3(p, p)); /* of normal and matrices, not of the cone test */
            front |= facing < -rounding;
        }
        const bool away = cull_faces_away(&transform, c.bytes);
        assert_false(away && front);
        dropped += away;
        could += !front;
        c.bytes[CLUSTER_AT_CUTOFF] = 255;
        assert_false(cull_faces_away(&transform, c.bytes));
    }
    print_message("cones: %u dropped of %u that face away\n", dropped, could);
    assert_true(dropped > could / 4);
}

/* A flat cluster seen from behind, from before, and by a two-sided instance. */
static void a_wall_is_dropped_from_behind_only(void **state) {
    set_up_t s;
    transform_t transform;
    uint8_t cluster[MODEL_CLUSTER_BYTES] = {0};
    (void)state;
    for (int ortho = 0; ortho < 2; ortho++) {
        set_up_simple(&s);
        s.scene.camera.projection = ortho ? TUILE_ORTHOGRAPHIC : TUILE_PERSPECTIVE;
        put16(cluster + CLUSTER_AT_CENTRE + 4, -10 * 256);
        put16(cluster + CLUSTER_AT_RADIUS, 256);
        cluster[CLUSTER_AT_AXIS + 2] = (uint8_t)-127;
        cluster[CLUSTER_AT_CUTOFF] = 0;
        assert_int_equal(set_up_transform(&s, &transform), TUILE_OK);
        assert_true(cull_faces_away(&transform, cluster));
        cluster[CLUSTER_AT_AXIS + 2] = 127;
        assert_false(cull_faces_away(&transform, cluster));
        cluster[CLUSTER_AT_AXIS + 2] = (uint8_t)-127;
        s.instance.two_sided = true;
        assert_int_equal(set_up_transform(&s, &transform), TUILE_OK);
        assert_false(cull_faces_away(&transform, cluster));
    }
}

/* A cube seen from +z: of its six faces only one looks there. Reflected upside down it shows the inside of its far side: counter-
 * clockwise has become clockwise, so that its near side is a back face. */
static void a_reflected_model_keeps_the_clusters_that_show_their_fronts(void **state) {
    (void)state;
    model_compiled_t cube;
    mesh_t mesh;
    model_cube(&mesh);
    model_compile(&cube, &mesh);
    for (unsigned kind = 0; kind < 4; kind++) {
        tuile_instance_t instance = stage_placed(&cube.model, 0);
        tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .camera = stage_plain_camera(64, 64)};
        if (kind / 2) { /* its size at z = -1 is 64 * 39 / 41 pixels */
            scene.camera.projection = TUILE_PERSPECTIVE;
            scene.camera.focal_x = scene.camera.focal_y = 39 * 24 << 16;
        }
        if (kind % 2) { instance.pose.rotation[1][1] = -TUILE_ONE_Q30; }
        uint32_t *ids = frame_draw_ids(&scene, 64, 64);
        const uint32_t seen = ids[30 * 64 + 34];
        assert_int_not_equal(seen, 0);
        assert_int_equal(tuile_model_source_face(&cube.model, seen - 1), kind % 2); /* +z, -z */
        free(ids);
    }
    model_free(&cube);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clusters_with_a_vertex_in_the_region_are_never_dropped),
        cmocka_unit_test(clusters_with_a_front_face_are_never_dropped),
        cmocka_unit_test(a_wall_is_dropped_from_behind_only),
        cmocka_unit_test(a_reflected_model_keeps_the_clusters_that_show_their_fronts),
    };
    return cmocka_run_group_tests_name("cull", tests, NULL, NULL);
}
