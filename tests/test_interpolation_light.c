/* Light at each pixel of a face against exact arithmetic: faces as small as they can be, slivers, and faces that span the guard
 * band. */
#include "support/canvas.h"
#include "support/check.h"
#include "support/random.h"

#include "../raster/fill/triangle.h"

#include <math.h>

#define SIDE 20 /* pixels of a region, each way */

typedef struct errors {
    long double small, large; /* levels */
    uint64_t pixels, small_pixels;
} errors_t;

typedef struct region {
    int32_t left, top;
} region_t;

/* Twice the area of a, b and the centre of a pixel, in (1/16 pixel)^2. */
static int64_t area_with(const vertex_t *a, const vertex_t *b, int32_t x, int32_t y) {
    const int64_t px = 16 * x + 8, py = 16 * y + 8;
    return (b->x - a->x) * (py - a->y) - (b->y - a->y) * (px - a->x);
}

/* The light at a pixel times `area`, and whether the pixel is in the face. */
static bool exact_light(const vertex_t v[3], int32_t x, int32_t y, int128_t *light, int64_t *area) {
    const int64_t a = area_with(&v[1], &v[2], x, y), b = area_with(&v[2], &v[0], x, y), c = area_with(&v[0], &v[1], x, y);
    *area = a + b + c;
    *light =
        (int128_t)a * (uint8_t)v[0].depth_light + (int128_t)b * (uint8_t)v[1].depth_light + (int128_t)c * (uint8_t)v[2].depth_light;
    return *area > 0 ? a >= 0 && b >= 0 && c >= 0 : a <= 0 && b <= 0 && c <= 0;
}

/* fill/triangle.c allows 1/8 level where sides are short. The reciprocal of an area below 2^18 is off by its 2^13th part at most,
 * and so is what a pixel's light differs from the first corner's by, 251 levels at most: 1/32 level. Else floors of 2^-24 level a
 * pixel add up over 2 * 2048. */
static void measure(const vertex_t v[3], region_t at, errors_t *errors) {
    uint64_t shade, dx, dy;
    light_plane_t plane;
    depth_plane_t depth;
    uint32_t least = 255, most = 0;
    const bool small = triangle_sides_short(&v[0], &v[1], &v[2]);
    triangle_shade(&v[0], &v[1], &v[2], true, &shade, &dx, &dy);
    triangle_planes(&v[0], &v[1], &v[2], &depth, &plane);
    for (int i = 0; i < 3; i++) {
        const uint32_t light = (uint8_t)v[i].depth_light;
        least = light < least ? light : least;
        most = light > most ? light : most;
    }
    for (int32_t y = at.top; y < at.top + SIDE; y++) {
        for (int32_t x = at.left; x < at.left + SIDE; x++) {
            int128_t exact;
            int64_t area;
            if (!exact_light(v, x, y, &exact, &area)) { continue; }
            const uint32_t light = plane.light + plane.dx * (uint32_t)x + plane.dy * (uint32_t)y;
            const uint32_t drawn = (uint32_t)(shade + dx * (uint64_t)(int64_t)x + dy * (uint64_t)(int64_t)y);
            if (light != drawn) { fail_msg("pixel %d,%d: %08x deferred, %08x drawn", x, y, light, drawn); }
            if (light >> 24 < least || light >> 24 > most) { fail_msg("pixel %d,%d: %u beyond the corners", x, y, light >> 24); }
            const int128_t off = ((int128_t)light - (1 << 23)) * area - exact * (1 << 24); /* * area * 2^24 */
            const long double error = fabsl((long double)off / (long double)area) * 0x1p-24L;
            long double *worst = small ? &errors->small : &errors->large;
            *worst = fmaxl(*worst, error);
            errors->pixels++;
            errors->small_pixels += small;
        }
    }
}

static uint32_t random_corner(random_source_t *random) {
    const uint32_t depth = (uint32_t)random_between(random, 512, 65529 * 256);
    const uint32_t light =
        (uint32_t)(random_one_in(random, 3) ? (random_one_in(random, 2) ? 2 : 253) : random_between(random, 2, 253));
    return depth << 8 | light;
}

static int32_t held(int32_t x, int32_t least, int32_t most) { return x < least ? least : x > most ? most : x; }

/* Shapes 0 ... 6: tiny, upright, lying, slivers through the region, wedges with an apex in it, as large as short sides may be, and
 * anywhere in the guard span. */
static void random_triangle(random_source_t *random, region_t at, int shape, vertex_t v[3]) {
    const int32_t guard = (1024 * 16 - GUARD_SPAN) / 2, end = guard + GUARD_SPAN - 1;
    const int32_t cx = 16 * at.left + random_between(random, 0, 16 * SIDE), cy = 16 * at.top + random_between(random, 0, 16 * SIDE);
    const int32_t far_x = random_between(random, guard, end), far_y = random_between(random, guard, end);
    const int32_t depth_near = random_between(random, 0, 1);
    const uint32_t corner = random_corner(random);
    for (int i = 0; i < 3; i++) {
        int32_t x = random_between(random, guard, end), y = random_between(random, guard, end);
        switch (shape) {
        case 0: x = cx + random_between(random, -24, 24), y = cy + random_between(random, -24, 24); break;
        case 1: x = cx + random_between(random, -8, 8), y = cy + random_between(random, -250, 250); break;
        case 2: x = cx + random_between(random, -250, 250), y = cy + random_between(random, -8, 8); break;
        case 3:
            x = (i == 0 ? cx : i == 1 ? far_x : cx - (far_x - cx) / 8) + random_between(random, -1, 1);
            y = (i == 0 ? cy : i == 1 ? far_y : cy - (far_y - cy) / 8) + random_between(random, -1, 1);
            break;
        case 4: /* an apex in the region, the other side far away */
            x = (i == 0 ? cx : far_x) + random_between(random, -40, 40),
            y = (i == 0 ? cy : far_y) + random_between(random, -40, 40);
            break;
        case 5: x = cx + random_between(random, -255, 255), y = cy + random_between(random, -255, 255); break;
        default: break;
        }
        /* Depths apart or not: light takes the short way only where depth does. */
        const uint32_t depth_light = depth_near ? (corner & ~255u) | (random_corner(random) & 255u) : random_corner(random);
        v[i] = (vertex_t){(int16_t)held(x, guard, end), (int16_t)held(y, guard, end), depth_light};
    }
}

static void light_is_within_its_bound_and_between_the_corners(void **state) {
    random_source_t random = random_seed(71);
    errors_t errors = {0};
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(60000); round++) {
        const region_t at = {random_between(&random, 0, 1024 - SIDE), random_between(&random, 0, 1024 - SIDE)};
        vertex_t v[3];
        canvas_face_t face = {.count = 3};
        random_triangle(&random, at, round % 7, v);
        for (int i = 0; i < 3; i++) {
            face.vertices[i] = v[i];
            face.corners[i] = (uint8_t)i;
        }
        if (!face_to_triangle(&face)) { continue; }
        const vertex_t t[3] = {*face_corner(&face, 0), *face_corner(&face, 1), *face_corner(&face, 2)};
        measure(t, at, &errors);
    }
    print_message("light: %.6Lf level off small, %.6Lf large; %llu pixels, %llu small\n", errors.small, errors.large,
                  (unsigned long long)errors.pixels, (unsigned long long)errors.small_pixels);
    assert_true(errors.small_pixels > 10000 && errors.pixels - errors.small_pixels > 10000);
    assert_true(errors.small <= 0x1p-5L);
    assert_true(errors.large <= 0x1p-11L);
}

/* The least areas that there are, as long as short sides may be: where one unit of the reciprocal weighs most. */
static void light_of_the_thinnest_short_faces(void **state) {
    random_source_t random = random_seed(72);
    errors_t errors = {0};
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(60000); round++) {
        const int32_t length = random_between(&random, 300, 511), wide = random_between(&random, 0, 511);
        const uint32_t depth = (uint32_t)random_between(&random, 512, 65000 * 256) << 8;
        canvas_face_t face = {.count = 3};
        for (int i = 0; i < 3; i++) {
            const int32_t t = i == 0   ? 0
                              : i == 1 ? length
                                       : random_between(&random, 0, length),
                          other = t * wide / length + random_between(&random, 0, 1);
            face.vertices[i] = (vertex_t){(int16_t)(round % 2 ? t : other), (int16_t)(round % 2 ? other : t),
                                          depth | (random_one_in(&random, 2) ? 2u : 253u)};
            face.corners[i] = (uint8_t)i;
        }
        if (!face_to_triangle(&face)) { continue; }
        const vertex_t t[3] = {*face_corner(&face, 0), *face_corner(&face, 1), *face_corner(&face, 2)};
        for (int part = 0; part < 4; part++) {
            measure(t, (region_t){part % 2 * SIDE, part / 2 * SIDE}, &errors);
        }
    }
    print_message("thin: %.6Lf level off, %llu pixels\n", errors.small, (unsigned long long)errors.small_pixels);
    assert_true(errors.small_pixels > 1000);
    assert_true(errors.small <= 0x1p-5L);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_within_its_bound_and_between_the_corners),
        cmocka_unit_test(light_of_the_thinnest_short_faces),
    };
    return cmocka_run_group_tests_name("interpolation of light", tests, NULL, NULL);
}
