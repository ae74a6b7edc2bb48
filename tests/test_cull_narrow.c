/* Culling of clusters, and steps of colours, on machines that make no long products: against the formulas in exact arithmetic. */
#define FIXED_BY_HALVES 1
#include "support/check.h"

#define cull_outside narrow_outside
#define cull_model_outside narrow_model_outside
#define cull_instance_outside narrow_instance_outside
#define cull_faces_away narrow_faces_away
#include "../raster/geometry/cull.c"

#include "../raster/pixel.h"
#include "support/random.h"

static void put16(uint8_t *p, int32_t value) {
    p[0] = (uint8_t)value;
    p[1] = (uint8_t)((uint32_t)value >> 8);
}

static void random_sphere(random_source_t *random, uint8_t *cluster, int32_t centre[3], int32_t *radius) {
    for (int i = 0; i < 3; i++) {
        centre[i] = (int32_t)random_any_size(random, 15);
        put16(cluster + CLUSTER_AT_CENTRE + 2 * i, centre[i]);
    }
    *radius = (int32_t)(random_bits(random) % 65536);
    put16(cluster + CLUSTER_AT_RADIUS, *radius);
}

/* The sphere touches a plane but for a step of the plane's value, or not. */
static void outside_is_exact_to_one(void **state) {
    (void)state;
    random_source_t random = random_seed(31);
    for (int round = 0; round < 20000; round++) {
        uint8_t cluster[MODEL_CLUSTER_BYTES] = {0};
        int32_t centre[3], radius;
        random_sphere(&random, cluster, centre, &radius);
        transform_t transform = {.crossed = 1};
        transform_plane_t *plane = transform.planes;
        int64_t sum = 0;
        for (int i = 0; i < 3; i++) {
            plane->n[i] = (int32_t)random_any_size(&random, 24);
            sum += (int64_t)plane->n[i] * centre[i];
        }
        plane->length = (uint32_t)random_between(&random, 0, 1 << 25);
        const int64_t touching = -sum - (int64_t)plane->length * radius;
        plane->d = touching;
        assert_false(cull_outside(&transform, cluster));
        plane->d = touching - 1;
        assert_true(cull_outside(&transform, cluster));
    }
}

static void cones_are_exact_for_all_cutoffs(void **state) {
    (void)state;
    random_source_t random = random_seed(32);
    unsigned away = 0, towards = 0;
    for (int round = 0; round < 3000; round++) {
        uint8_t cluster[MODEL_CLUSTER_BYTES] = {0};
        int32_t centre[3], radius, axis[3], squares_of_axis = 0;
        random_sphere(&random, cluster, centre, &radius);
        if (round & 1) { put16(cluster + CLUSTER_AT_RADIUS, radius = radius % 64); }
        transform_t transform = {.perspective = true, .cones = true, .mirrored = random_one_in(&random, 2)};
        for (int i = 0; i < 3; i++) {
            axis[i] = (int32_t)random_between(&random, -73, 73);
            cluster[CLUSTER_AT_AXIS + i] = (uint8_t)axis[i];
            squares_of_axis += axis[i] * axis[i];
            transform.eye[i] = (int32_t)random_any_size(&random, 20);
        }
        int128_t dot = 0, squares = 0;
        for (int i = 0; i < 3; i++) {
            const int32_t way = centre[i] - transform.eye[i];
            dot += way * axis[i];
            squares += (int128_t)way * way;
        }
        dot = (transform.mirrored ? -dot : dot) - (radius + 1) * 128;
        for (int cutoff = 0; cutoff < 255; cutoff++) {
            cluster[CLUSTER_AT_CUTOFF] = (uint8_t)cutoff;
            const int64_t scaled = ((int64_t)cutoff * cutoff * squares_of_axis + 64515) / 64516;
            const bool wanted = dot >= 0 && squares_of_axis <= 128 * 128 && dot * dot >= squares * scaled;
            assert_int_equal(cull_faces_away(&transform, cluster), wanted);
            away += wanted;
            towards += !wanted;
        }
    }
    assert_true(away > 10000 && towards > 10000);
}

static void steps_of_colours_are_rounded(void **state) {
    (void)state;
    for (uint32_t most = 1; most < 256; most++) {
        for (uint32_t component = 0; component < 256; component++) {
            assert_int_equal(pixel_steps(component, most), (2 * component * most + 254) / 510);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outside_is_exact_to_one),
        cmocka_unit_test(cones_are_exact_for_all_cutoffs),
        cmocka_unit_test(steps_of_colours_are_rounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
