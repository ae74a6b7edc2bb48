/* The exact arithmetic of the display tree's compiler against plain long multiplication, with and without its filter, where points
 * lie in planes, or off them by less than doubles can tell. */
#include "support/check.h"
#include "support/random.h"

#include <math.h>

#include "../sim/mesh/tree_exact.h"

/* ---- long integers: 384 bits, two's complement ---------------------------------------------------------------- */

enum { LIMBS = 12 };
typedef struct big {
    uint32_t limb[LIMBS];
} big_t;

static big_t big_of(int128_t x) {
    big_t big;
    for (int i = 0; i < LIMBS; i++) {
        big.limb[i] = i < 4 ? (uint32_t)((uint128_t)x >> 32 * i) : x < 0 ? UINT32_MAX : 0;
    }
    return big;
}

static big_t big_times(big_t a, big_t b) {
    big_t product = {{0}};
    for (int i = 0; i < LIMBS; i++) {
        uint64_t carry = 0;
        for (int j = 0; i + j < LIMBS; j++) {
            carry += (uint64_t)a.limb[i] * b.limb[j] + product.limb[i + j];
            product.limb[i + j] = (uint32_t)carry;
            carry >>= 32;
        }
    }
    return product;
}

static big_t big_plus(big_t a, big_t b) {
    uint64_t carry = 0;
    for (int i = 0; i < LIMBS; i++) {
        carry += (uint64_t)a.limb[i] + b.limb[i];
        a.limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    return a;
}

static int big_sign(big_t a) {
    if (a.limb[LIMBS - 1] >> 31) { return -1; }
    for (int i = 0; i < LIMBS; i++) {
        if (a.limb[i]) { return 1; }
    }
    return 0;
}

static int side_of(const exact_plane_t *plane, const exact_point_t *point) {
    big_t sum = big_times(big_of(plane->d), big_of(point->w));
    for (int k = 0; k < 3; k++) {
        sum = big_plus(sum, big_times(big_of(plane->n[k]), big_of(point->x[k])));
    }
    return big_sign(sum);
}

/* ---- planes and points at random -------------------------------------------------------------------------------- */

static random_source_t source;

static void random_place(int16_t at[3], int32_t range) {
    for (int k = 0; k < 3; k++) {
        at[k] = (int16_t)random_between(&source, -range, range);
    }
}

/* Any of nearly the largest size. */
static void random_normal(int64_t normal[3]) {
    for (int k = 0; k < 3; k++) {
        normal[k] = (int64_t)(random_bits(&source) >> 30) - ((int64_t)1 << 33);
    }
}

static bool plane_through(exact_plane_t *plane, const int16_t at[3][3]) {
    int64_t normal[3];
    for (int k = 0; k < 3; k++) {
        const int y = (k + 1) % 3, z = (k + 2) % 3;
        normal[k] = (int64_t)(at[1][y] - at[0][y]) * (at[2][z] - at[0][z]) - (int64_t)(at[1][z] - at[0][z]) * (at[2][y] - at[0][y]);
    }
    if (!normal[0] && !normal[1] && !normal[2]) { return false; }
    (void)exact_plane_make(plane, normal, at[0]);
    return true;
}

/* Three planes that meet in one point within the range; near: they are almost the same plane, or contain almost the same line. */
static void random_meeting(exact_plane_t planes[3], exact_point_t *point, bool near) {
    for (;;) {
        int16_t at[3][3];
        bool good = true;
        for (int i = 0; i < 3; i++) {
            random_place(at[i], 32767);
        }
        for (int p = 0; p < 3; p++) {
            for (int i = 0; i < 3; i++) {
                if (!near) { random_place(at[i], 32767); }
                for (int k = 0; k < 3 && near; k++) {
                    const int32_t moved = at[i][k] + random_between(&source, -1, 1);
                    at[i][k] = (int16_t)(moved > 32767 ? 32767 : moved < -32767 ? -32767 : moved);
                }
            }
            good = good && plane_through(&planes[p], (const int16_t(*)[3])at);
        }
        if (!good) { continue; }
        mesh_int128_t cross[3], w = 0;
        exact_cross(planes[0].n, planes[1].n, cross);
        for (int k = 0; k < 3; k++) {
            w += cross[k] * planes[2].n[k];
        }
        if (!w) { continue; }
        exact_point_of_planes(point, &planes[0], &planes[1], &planes[2]);
        if (fabs(point->at[0]) <= 32767 && fabs(point->at[1]) <= 32767 && fabs(point->at[2]) <= 32767) { return; }
    }
}

static void check_sides(const exact_plane_t *plane, const exact_point_t *point, int expected) {
    assert_int_equal(side_of(plane, point), expected);
    assert_int_equal(exact_side_unfiltered(plane, point), expected);
    assert_int_equal(exact_side(plane, point), expected);
}

/* ---- tests ------------------------------------------------------------------------------------------------------- */

static void a_point_lies_in_the_planes_that_make_it(void **state) {
    (void)state;
    source = random_seed(21);
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        exact_plane_t planes[3];
        exact_point_t point;
        random_meeting(planes, &point, round % 2);
        assert_true(point.w > 0);
        for (int p = 0; p < 3; p++) {
            check_sides(&planes[p], &point, 0);
        }
        int16_t ends[2][3]; /* an edge and a plane */
        int sides[2];
        for (int i = 0; i < 2; i++) {
            exact_point_t end;
            random_place(ends[i], 32767);
            exact_point_whole(&end, ends[i]);
            sides[i] = exact_side(&planes[0], &end);
            check_sides(&planes[0], &end, side_of(&planes[0], &end));
        }
        if (sides[0] * sides[1] < 0) {
            exact_point_on_edge(&point, ends[0], ends[1], &planes[0]);
            check_sides(&planes[0], &point, 0);
            for (int k = 0; k < 3; k++) { /* on the line: (x - a w) (b - a)[j] == (y - ...) (b - a)[k] */
                const int j = (k + 1) % 3;
                const int128_t off_k = point.x[k] - ends[0][k] * point.w, off_j = point.x[j] - ends[0][j] * point.w;
                assert_true(off_k * (ends[1][j] - ends[0][j]) == off_j * (ends[1][k] - ends[0][k]));
            }
        }
    }
}

/* Planes of arbitrary normals, moved so that they pass by the point at less than half a unit of n . q + d: the doubt of a normal of
 * 33 bits is some units. All answers must be those of long multiplication. */
static void the_filter_never_lies(void **state) {
    (void)state;
    size_t near = 0, sides[3] = {0};
    source = random_seed(22);
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        exact_plane_t planes[3], plane;
        exact_point_t point;
        const int16_t origin[3] = {0};
        random_meeting(planes, &point, round % 2);
        for (int trial = 0; trial < 4; trial++) {
            int64_t normal[3];
            random_normal(normal);
            (void)exact_plane_make(&plane, normal, origin);
            /* the whole number next to -n . x / w, by long division of the three terms */
            double rest = 0;
            int128_t whole = 0;
            for (int k = 0; k < 3; k++) {
                const int128_t quotient = point.x[k] / point.w, remainder = point.x[k] % point.w;
                whole -= plane.n[k] * quotient;
                rest -= (double)plane.n[k] * ((double)remainder / (double)point.w);
            }
            plane.d = (int64_t)whole + llround(rest) + (trial == 3 ? random_between(&source, -40, 40) : 0);
            plane.e = (double)plane.d;
            const int side = side_of(&plane, &point);
            check_sides(&plane, &point, side);
            const double value = plane.f[0] * point.at[0] + plane.f[1] * point.at[1] + plane.f[2] * point.at[2] + plane.e;
            near += fabs(value) <= plane.doubt * point.doubt;
            sides[side + 1]++;
        }
    }
    assert_true(near > (size_t)CHECK_ROUNDS(20000) && sides[0] > 1000 && sides[2] > 1000);
}

static void the_order_along_a_line_is_exact(void **state) {
    (void)state;
    size_t orders[3] = {0}, near = 0;
    source = random_seed(23);
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        exact_plane_t planes[3], other[3];
        exact_point_t a, b;
        random_meeting(planes, &a, round % 2);
        random_meeting(other, &b, false);
        if (round % 4 < 3) { /* where one line meets two parallel planes that are as near as they can be, or one plane twice */
            int64_t normal[3];
            mesh_int128_t cross[3], w = 0;
            random_normal(normal);
            exact_cross(planes[0].n, planes[1].n, cross);
            for (int k = 0; k < 3; k++) {
                w += cross[k] * normal[k];
            }
            if (!w) { continue; }
            (void)exact_plane_make(&other[2], normal, planes[2].through);
            exact_point_of_planes(&a, &planes[0], &planes[1], &other[2]);
            other[2].d += round % 4;
            exact_point_of_planes(&b, &planes[1], &other[2], &planes[0]);
            assert_int_equal(exact_same(&a, &b), round % 4 == 0);
            if (round % 4 == 0) { assert_true(exact_hash(&a) == exact_hash(&b)); }
        }
        if (!(fabs(a.at[0]) <= 32767 && fabs(a.at[1]) <= 32767 && fabs(a.at[2]) <= 32767)) { continue; }
        if (!(fabs(b.at[0]) <= 32767 && fabs(b.at[1]) <= 32767 && fabs(b.at[2]) <= 32767)) { continue; }
        for (int axis = 0; axis < 3; axis++) {
            const int order =
                big_sign(big_plus(big_times(big_of(a.x[axis]), big_of(b.w)), big_times(big_of(-b.x[axis]), big_of(a.w))));
            assert_int_equal(exact_order_unfiltered(&a, &b, axis), order);
            assert_int_equal(exact_order(&a, &b, axis), order);
            assert_int_equal(exact_order(&b, &a, axis), -order);
            orders[order + 1]++;
            near += order && fabs(a.at[axis] - b.at[axis]) <= 0x1p-33;
        }
    }
    assert_true(orders[0] > 100 && orders[1] > 100 && orders[2] > 100 && near > 10);
}

/* By hand: an edge along x, cut by n x + y = c. */
static void points_are_rounded_to_the_nearest_halves_up(void **state) {
    static const struct {
        int32_t n, c, rounded; /* x = c / n, times 256 */
    } cases[] = {{2, 1, 128},  {2, -1, -128}, {2, -3, -384}, {2, 3, 384},   {3, 1, 85},    {3, 2, 171}, {512, 1, 1},
                 {512, -1, 0}, {3, -1, -85},  {3, -2, -171}, {3, -4, -341}, {3, -5, -427}, {5, 0, 0},   {7, -21, -768}};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        const int64_t normal[3] = {cases[i].n, 1, 0};
        const int16_t through[3] = {0, (int16_t)cases[i].c, 9}, a[3] = {-100, 0, 4}, b[3] = {100, 0, 4};
        exact_plane_t plane, floor, wall;
        exact_point_t point, same;
        int32_t at[3];
        const int64_t y[3] = {0, 5, 0}, z[3] = {0, 0, -3};
        assert_false(exact_plane_make(&plane, normal, through));
        exact_point_on_edge(&point, a, b, &plane);
        exact_round(&point, at);
        assert_int_equal(at[0], cases[i].rounded);
        assert_int_equal(at[1], 0);
        assert_int_equal(at[2], 1024);
        assert_false(exact_plane_make(&floor, y, a)); /* the same point where three planes meet */
        assert_true(exact_plane_make(&wall, z, a));
        exact_point_of_planes(&same, &wall, &plane, &floor);
        assert_true(exact_same(&point, &same));
        assert_int_equal(exact_hash(&point), exact_hash(&same));
        if (cases[i].c % cases[i].n == 0) { /* and a whole one */
            const int16_t whole[3] = {(int16_t)(cases[i].c / cases[i].n), 0, 4};
            exact_point_whole(&same, whole);
            assert_true(exact_same(&point, &same));
            assert_true(point.doubt == 0);
        }
    }
}

static void equal_planes_are_equal_bits(void **state) {
    (void)state;
    source = random_seed(24);
    for (int round = 0; round < CHECK_ROUNDS(2000); round++) {
        int16_t at[3][3];
        exact_plane_t plane, other;
        for (int i = 0; i < 3; i++) {
            random_place(at[i], 10000);
        }
        if (!plane_through(&plane, (const int16_t(*)[3])at)) { continue; }
        int64_t normal[3];
        const int64_t factor = random_between(&source, 1, 1000) * (round % 2 ? -1 : 1);
        for (int k = 0; k < 3; k++) {
            normal[k] = plane.n[k] * factor;
            at[0][k] = (int16_t)(at[0][k] + (at[1][k] - at[2][k])); /* another place of the same plane */
        }
        assert_int_equal(exact_plane_make(&other, normal, at[0]), factor < 0);
        assert_memory_equal(other.n, plane.n, sizeof plane.n);
        assert_true(other.d == plane.d);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_lies_in_the_planes_that_make_it),
        cmocka_unit_test(the_filter_never_lies),
        cmocka_unit_test(the_order_along_a_line_is_exact),
        cmocka_unit_test(points_are_rounded_to_the_nearest_halves_up),
        cmocka_unit_test(equal_planes_are_equal_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
