/* The order of boxes in space: what is drawn before must nowhere hide what is drawn after, seen from the observer. Rays in double
 * precision are the judge. */
#include "../raster/visibility/arrange.h"
#include "support/check.h"
#include "support/random.h"
#include "support/set_up.h"

#include <math.h>

enum { BOXES_MAX = 8 };

typedef struct world {
    tuile_t tuile;
    tuile_scene_t scene;
    tuile_instance_t instances[BOXES_MAX];
    tuile_model_t models[BOXES_MAX];
    uint16_t order[BOXES_MAX];
    uint8_t scratch[BOXES_MAX * BOXES_MAX + 4 * BOXES_MAX + 2];
} world_t;

/* Steps are of 2^-8: boxes of some units. */
static void world_start(world_t *w, unsigned count) {
    memset(w, 0, sizeof *w);
    w->tuile.scene = &w->scene;
    w->tuile.instance_order = w->order;
    w->scene.instances = w->instances;
    w->scene.instance_count = (uint16_t)count;
    for (unsigned i = 0; i < 3; i++) {
        w->scene.camera.rotation[i][i] = TUILE_ONE_Q30;
    }
    for (unsigned i = 0; i < count; i++) {
        w->models[i].step = (tuile_scale_t){1, -8};
        w->instances[i].model = &w->models[i];
        w->instances[i].pose.scale = TUILE_SCALE_ONE;
        for (unsigned k = 0; k < 3; k++) {
            w->instances[i].pose.rotation[k][k] = TUILE_ONE_Q30;
        }
    }
}

static void box(world_t *w, unsigned i, int x0, int y0, int z0, int x1, int y1, int z1) { /* in units */
    const int low[3] = {x0, y0, z0}, high[3] = {x1, y1, z1};
    for (int k = 0; k < 3; k++) {
        w->models[i].low[k] = (int16_t)(256 * low[k]);
        w->models[i].high[k] = (int16_t)(256 * high[k]);
    }
}

static int arrange(world_t *w) { return arrange_instances(&w->tuile, w->scratch, sizeof w->scratch); }

static void eye_at(world_t *w, double x, double y, double z) {
    w->scene.camera.eye[0] = (q16_16_t)lround(x * 65536);
    w->scene.camera.eye[1] = (q16_16_t)lround(y * 65536);
    w->scene.camera.eye[2] = (q16_16_t)lround(z * 65536);
}

#define NEXT ARRANGE_FIRST /* an instance that begins a group */

static void the_box_beyond_the_gap_comes_first(void **state) {
    (void)state;
    world_t w;
    world_start(&w, 2);
    box(&w, 0, 0, 0, 0, 1, 1, 1);
    box(&w, 1, 2, 0, 0, 3, 1, 1);
    eye_at(&w, -5, 0, 0);
    assert_int_equal(arrange(&w), 0);
    assert_int_equal(w.order[0], 1 | NEXT);
    assert_int_equal(w.order[1], 0 | NEXT);
    eye_at(&w, 9, 0, 0);
    assert_int_equal(arrange(&w), 0);
    assert_int_equal(w.order[0], 0 | NEXT);
    assert_int_equal(w.order[1], 1 | NEXT);
    /* Parallel rays: where the camera looks from decides. It looks along -z: let that be the world's -x. */
    w.scene.camera.projection = TUILE_ORTHOGRAPHIC;
    memset(w.scene.camera.rotation, 0, sizeof w.scene.camera.rotation);
    w.scene.camera.rotation[0][2] = -TUILE_ONE_Q30;
    w.scene.camera.rotation[1][1] = TUILE_ONE_Q30;
    w.scene.camera.rotation[2][0] = TUILE_ONE_Q30;
    eye_at(&w, -5, 0, 0);
    assert_int_equal(arrange(&w), 0);
    assert_int_equal(w.order[0], 0 | NEXT);
    w.scene.camera.rotation[2][0] = -TUILE_ONE_Q30;
    w.scene.camera.rotation[0][2] = TUILE_ONE_Q30;
    assert_int_equal(arrange(&w), 0);
    assert_int_equal(w.order[0], 1 | NEXT);
}

static void boxes_that_touch_are_apart_and_boxes_that_overlap_are_a_group(void **state) {
    (void)state;
    world_t w;
    world_start(&w, 3);
    box(&w, 0, 0, 0, 0, 4, 1, 4); /* a table, something on it, and something that goes through both */
    box(&w, 1, 1, 1, 1, 2, 2, 2);
    box(&w, 2, 1, 0, 3, 2, 3, 5);
    eye_at(&w, 0, 9, 0);
    w.scene.instance_count = 2;
    assert_int_equal(arrange(&w), 0);
    assert_int_equal(w.order[0], 0 | NEXT);
    assert_int_equal(w.order[1], 1 | NEXT);
    w.scene.instance_count = 3;
    assert_int_equal(arrange(&w), 2); /* 0 and 2 */
    for (unsigned i = 0; i < 3; i++) {
        if ((w.order[i] & ~NEXT) == 2) { assert_int_equal(w.order[i], 2); }
        if ((w.order[i] & ~NEXT) == 0) { assert_int_equal(w.order[i], 0 | NEXT); }
    }
}

/* Bars along x, y and z. Seen from far along (1, 1, 1) the first is before the second (z > 1), the second before the third (x > 1),
 * and the third before the first (y > 1): every pair has a plane between, and no order is right. From elsewhere there is one. */
static void boxes_in_a_circle_are_a_group(void **state) {
    (void)state;
    world_t w;
    world_start(&w, 4);
    box(&w, 0, 0, 0, 1, 3, 1, 2);
    box(&w, 1, 1, 0, 0, 2, 3, 1);
    box(&w, 2, 0, 1, 0, 1, 2, 3);
    box(&w, 3, -9, -9, -9, -8, -8, -8);
    eye_at(&w, 9, 9, 9);
    assert_int_equal(arrange(&w), 3);
    assert_int_equal(w.order[0], 3 | NEXT);
    assert_int_equal(w.order[1], 0 | NEXT);
    assert_int_equal(w.order[2], 1);
    assert_int_equal(w.order[3], 2);
    eye_at(&w, 9, 9, -9); /* below z = 1: the first is behind the second; the rest as before */
    assert_int_equal(arrange(&w), 0);
    unsigned rank[4];
    for (unsigned i = 0; i < 4; i++) {
        rank[w.order[i] & ~NEXT] = i;
    }
    assert_true(rank[0] < rank[2] && rank[2] < rank[1]);
}

/* Seen from between them neither of two boxes hides anything of the other: x = 2 parts them, and so does y = 2, the other way. */
static void boxes_that_hide_nothing_of_one_another_bind_nothing(void **state) {
    (void)state;
    world_t w;
    world_start(&w, 3);
    box(&w, 0, 0, 3, 0, 1, 4, 1);
    box(&w, 1, 3, 0, 0, 4, 1, 1);
    box(&w, 2, 0, 0, 8, 4, 4, 9);
    eye_at(&w, 0, 0, 0); /* x asks for 1 first, y for 0 */
    assert_int_equal(arrange(&w), 0);
    assert_int_equal(w.order[0], 2 | NEXT); /* this one is behind both */
}

static void too_little_room_is_told(void **state) {
    (void)state;
    world_t w;
    world_start(&w, 4);
    w.tuile.stats.size_bytes = 5000;
    assert_int_equal(arrange_instances(&w.tuile, w.scratch, 33), TUILE_ERROR_MEMORY); /* 4 * 4 + 4 * 4 + 2 = 34 */
    assert_int_equal(w.tuile.wanted_bytes, 5001);
}

/* ---- random ------------------------------------------------------------------------------------------------ */

/* The world's place of a box's corner point u in [0, 1]^3. */
static void place(const world_t *w, unsigned i, const double u[3], double p[3]) {
    const tuile_instance_t *instance = &w->instances[i];
    for (int k = 0; k < 3; k++) {
        p[k] = instance->pose.translation[k] / 65536.0;
        for (int j = 0; j < 3; j++) {
            const double q = instance->model->low[j] + u[j] * (instance->model->high[j] - instance->model->low[j]);
            p[k] += instance->pose.rotation[k][j] / 1073741824.0 * (q + instance->model->offset[j]) *
                    ldexp(instance->model->step.mantissa, instance->model->step.exponent);
        }
    }
}

/* The part of the ray from + s * along that is inside the box: false when there is none. */
static bool through(const world_t *w, unsigned i, const double from[3], const double along[3], double *enter, double *leave) {
    double origin[3], edge[3][3];
    const double zero[3] = {0, 0, 0};
    place(w, i, zero, origin);
    *enter = -1e30;
    *leave = 1e30;
    for (int j = 0; j < 3; j++) {
        double unit[3] = {0, 0, 0}, top[3], length = 0, at = 0, speed = 0;
        unit[j] = 1;
        place(w, i, unit, top);
        for (int k = 0; k < 3; k++) {
            edge[j][k] = top[k] - origin[k];
            length += edge[j][k] * edge[j][k];
        }
        for (int k = 0; k < 3; k++) {
            at += (from[k] - origin[k]) * edge[j][k] / length;
            speed += along[k] * edge[j][k] / length;
        }
        double a = -at / speed, b = (1 - at) / speed;
        if (fabs(speed) < 1e-12) {
            if (at < 0 || at > 1) { return false; }
            continue;
        }
        *enter = fmax(*enter, fmin(a, b));
        *leave = fmin(*leave, fmax(a, b));
    }
    return *enter < *leave;
}

static void what_is_drawn_before_hides_nothing_drawn_after(void **state) {
    (void)state;
    static world_t w;
    random_source_t random = random_seed(5);
    unsigned apart = 0, grouped = 0, hits = 0;
    for (unsigned round = 0; round < CHECK_ROUNDS(2000); round++) {
        const unsigned count = (unsigned)random_between(&random, 2, BOXES_MAX);
        const bool orthographic = random_one_in(&random, 2);
        world_start(&w, count);
        for (unsigned i = 0; i < count; i++) {
            for (int k = 0; k < 3; k++) {
                w.models[i].low[k] = (int16_t)random_between(&random, -600, 0);
                w.models[i].high[k] = (int16_t)random_between(&random, 40, 600);
                w.models[i].offset[k] = random_between(&random, -300, 300);
                w.instances[i].pose.translation[k] = random_between(&random, -6 * 65536, 6 * 65536);
            }
            if (!random_one_in(&random, 3)) { random_rotation(&random, w.instances[i].pose.rotation); }
        }
        random_rotation(&random, w.scene.camera.rotation);
        eye_at(&w, random_real(&random, -9, 9), random_real(&random, -9, 9), random_real(&random, -9, 9));
        if (orthographic) { w.scene.camera.projection = TUILE_ORTHOGRAPHIC; }
        const int in_groups = arrange(&w);
        assert_true(in_groups >= 0 && in_groups != 1);
        unsigned seen = 0, group[BOXES_MAX], rank[BOXES_MAX], groups = 0;
        for (unsigned i = 0; i < count; i++) {
            const unsigned number = w.order[i] & ~NEXT;
            assert_true(number < count && !(seen >> number & 1));
            seen |= 1u << number;
            if (w.order[i] & NEXT) { groups++; }
            assert_true(groups > 0);
            group[number] = groups;
            rank[number] = i;
        }
        apart += in_groups == 0;
        grouped += in_groups > 0;
        for (unsigned ray = 0; ray < 200; ray++) {
            double from[3], along[3];
            for (int k = 0; k < 3; k++) {
                from[k] = w.scene.camera.eye[k] / 65536.0;
                along[k] = random_real(&random, -1, 1);
            }
            if (orthographic) { /* from anywhere, along -z of the view */
                for (int k = 0; k < 3; k++) {
                    from[k] = random_real(&random, -6, 6);
                    along[k] = -w.scene.camera.rotation[2][k] / 1073741824.0;
                }
            }
            for (unsigned i = 0; i < count; i++) {
                for (unsigned j = 0; j < count; j++) {
                    double enter_i, leave_i, enter_j, leave_j;
                    if (rank[i] >= rank[j] || group[i] == group[j]) { continue; }
                    if (!through(&w, i, from, along, &enter_i, &leave_i) || !through(&w, j, from, along, &enter_j, &leave_j)) {
                        continue;
                    }
                    if (!orthographic && (leave_i <= 0 || leave_j <= 0)) { continue; }
                    /* i is drawn first: no point of it before a point of j, up to the slack. */
                    const double least_i = orthographic ? enter_i : fmax(enter_i, 0);
                    if (!(least_i >= leave_j - 0.02)) {
                        fail_msg("round %u: box %u hides %u, which is drawn after it", round, i, j);
                    }
                    hits++;
                }
            }
        }
    }
    assert_true(apart > 100 / (CHECK_SANITIZED ? 16 : 1) && grouped > 100 / (CHECK_SANITIZED ? 16 : 1) &&
                hits > (CHECK_SANITIZED ? 60 : 1000));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_box_beyond_the_gap_comes_first),
        cmocka_unit_test(boxes_that_touch_are_apart_and_boxes_that_overlap_are_a_group),
        cmocka_unit_test(boxes_in_a_circle_are_a_group),
        cmocka_unit_test(boxes_that_hide_nothing_of_one_another_bind_nothing),
        cmocka_unit_test(too_little_room_is_told),
        cmocka_unit_test(what_is_drawn_before_hides_nothing_drawn_after),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
