/* Texture coordinates against exact arithmetic, and texels brought into a texture by hand. */
#include "support/check.h"
#include "support/random.h"

#include "../raster/surface/surface.h"

#include <math.h>
#include <stdlib.h>

/* ---- coordinates ---- */

typedef struct worst {
    double all, affine;
    uint32_t faces, affine_faces, pixels;
} worst_t;

/* Exact: s at the centre of pixel (x, y), through the snapped corners. False outside the face. */
static bool exact(const texture_corner_t c[3], int32_t x, int32_t y, bool perspective, long double st[2]) {
    const int64_t px = 16 * x + 8, py = 16 * y + 8;
    int64_t b[3], area = 0;
    long double q = 0, u = 0, v = 0;
    for (int i = 0; i < 3; i++) {
        const texture_corner_t *a = &c[(i + 1) % 3], *d = &c[(i + 2) % 3];
        b[i] = (a->x - px) * (d->y - py) - (d->x - px) * (a->y - py);
        area += b[i];
    }
    for (int i = 0; i < 3; i++) {
        if (area > 0 ? b[i] < 0 : b[i] > 0) { return false; }
        const long double weight = (long double)b[i] * (perspective ? c[i].depth : 1u);
        q += weight;
        u += weight * c[i].s;
        v += weight * c[i].t;
    }
    st[0] = u / q / 256;
    st[1] = v / q / 256;
    return true;
}

static void walk(const texture_corner_t c[3], bool perspective, int32_t tile, worst_t *worst) {
    tuile_texture_t texture = {.texels = (const uint8_t *)"", .width = 64, .height = 64, .levels = 1};
    texture_plane_t plane;
    int32_t low[2] = {INT32_MAX, INT32_MAX}, high[2] = {INT32_MIN, INT32_MIN};
    texture_plane_make(&plane, &texture, c, (texture_wish_t){.perspective = perspective});
    for (int i = 0; i < 3; i++) {
        const int32_t at[2] = {c[i].x >> 4, c[i].y >> 4};
        for (int k = 0; k < 2; k++) {
            low[k] = at[k] < low[k] ? at[k] : low[k];
            high[k] = at[k] > high[k] ? at[k] : high[k];
        }
    }
    const int32_t steps = (high[1] - low[1]) / 24 + 1;
    worst->faces++;
    worst->affine_faces += !plane.perspective;
    for (int32_t y = low[1]; y <= high[1]; y += steps) {
        for (int32_t x = low[0]; x <= high[0]; x += tile) {
            int32_t s[32], t[32];
            texture_coordinates(&plane, x, y, tile, s, t);
            for (int32_t i = 0; i < tile; i++) {
                long double st[2];
                if (!exact(c, x + i, y, perspective, st)) { continue; }
                for (int k = 0; k < 2; k++) {
                    const double off = (double)fabsl((k ? t : s)[i] / 65536.0L - st[k]);
                    if (off > 0.5) {
                        fail_msg("pixel %d,%d: %f for %Lf; corners %d,%d,%u,%d,%d %d,%d,%u,%d,%d %d,%d,%u,%d,%d", x + i, y,
                                 (k ? t : s)[i] / 65536.0, st[k], c[0].x, c[0].y, c[0].depth, c[0].s, c[0].t, c[1].x, c[1].y,
                                 c[1].depth, c[1].s, c[1].t, c[2].x, c[2].y, c[2].depth, c[2].s, c[2].t);
                    }
                    worst->all = fmax(worst->all, off);
                    if (!plane.perspective) { worst->affine = fmax(worst->affine, off); }
                }
                worst->pixels++;
            }
        }
    }
}

static void at_every_pixel_the_address_is_within_half_a_texel(void **state) {
    random_source_t random = random_seed(42);
    worst_t worst = {0};
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(20000); round++) {
        texture_corner_t c[3];
        const int32_t size = 1 << random_between(&random, 3, 14), ratio = random_between(&random, 0, 7),
                      span = 1 << random_between(&random, 4, 22);
        const uint32_t nearest = 1u << random_between(&random, 16, 23);
        for (int i = 0; i < 3; i++) {
            c[i] = (texture_corner_t){random_between(&random, -size, size), random_between(&random, -size, size),
                                      nearest - (uint32_t)random_between(&random, 0, (int32_t)(nearest - (nearest >> ratio))),
                                      random_between(&random, -span, span), random_between(&random, -span, span)};
        }
        const int64_t area = (int64_t)(c[2].x - c[0].x) * (c[1].y - c[0].y) - (int64_t)(c[1].x - c[0].x) * (c[2].y - c[0].y);
        if (area == 0) { continue; }
        walk(c, round % 4 != 0, random_between(&random, 1, 32), &worst);
    }
    print_message("%u faces, %u of them affine, %u pixels: at most %.4f texel off, of affine faces %.4f\n", worst.faces,
                  worst.affine_faces, worst.pixels, worst.all, worst.affine);
    assert_true(worst.pixels > 1000);
}

/* ---- texels ---- */

static const uint8_t palette_565[32] = {0x00, 0x00, 0x00, 0xf8, 0xe0, 0x07, 0x1f, 0x00, 0xff, 0xff};

static void every_format_gives_its_colours(void **state) {
    static const uint8_t rgb565[] = {0x00, 0xf8, 0xe0, 0x07, 0x1f, 0x00, 0x10, 0x84}; /* red, green, blue, (16, 32, 16) steps */
    static const uint8_t argb4444[] = {0x23, 0x81, 0xff, 0x0f};                       /* 0x8123, 0x0fff */
    static const uint8_t grey[] = {0, 127, 255};
    static const uint8_t nibbles[] = {0x21, 0x04}; /* 1, 2, 4 */
    const tuile_texture_t a = {.texels = rgb565, .width = 2, .height = 2, .levels = 1, .format = TUILE_TEXEL_RGB565};
    const tuile_texture_t b = {.texels = argb4444, .width = 2, .height = 1, .levels = 1, .format = TUILE_TEXEL_ARGB4444};
    const tuile_texture_t c = {.texels = grey, .width = 3, .height = 1, .levels = 1, .format = TUILE_TEXEL_GREY8};
    const tuile_texture_t d = {
        .texels = nibbles, .palette = palette_565, .width = 3, .height = 1, .levels = 1, .format = TUILE_TEXEL_PALETTE4};
    (void)state;
    assert_int_equal(texture_texel(&a, 0, 0), 0xffff0000);
    assert_int_equal(texture_texel(&a, 1, 0), 0xff00ff00);
    assert_int_equal(texture_texel(&a, 0, 1), 0xff0000ff);
    assert_int_equal(texture_texel(&a, 1, 1), 0xff848284); /* 16 * 255 / 31 = 131.6, 32 * 255 / 63 = 129.5 */
    assert_int_equal(texture_texel(&b, 0, 0), 0x88112233);
    assert_int_equal(texture_texel(&b, 1, 0), 0x00ffffff);
    assert_int_equal(texture_texel(&c, 1, 0), 0xff7f7f7f);
    assert_int_equal(texture_texel(&d, 0, 0), 0xffff0000);
    assert_int_equal(texture_texel(&d, 1, 0), 0xff00ff00);
    assert_int_equal(texture_texel(&d, 2, 0), 0xffffffff);
}

static void textures_repeat_or_end_at_their_border(void **state) {
    static const uint8_t grey[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    tuile_texture_t texture = {.texels = grey, .width = 4, .height = 3, .levels = 1, .format = TUILE_TEXEL_GREY8};
    (void)state;
    assert_int_equal(texture_texel(&texture, -1, 0) & 255, 3);
    assert_int_equal(texture_texel(&texture, 5, -1) & 255, 9);
    assert_int_equal(texture_texel(&texture, INT32_MIN, INT32_MIN) & 255, 4); /* -2^31 = 1 (mod 3) */
    assert_int_equal(texture_texel(&texture, INT32_MAX, INT32_MAX) & 255, 7); /* 2^31 - 1 = 3 (mod 4), 1 (mod 3) */
    texture.flags = TUILE_TEXTURE_CLAMP_S;
    assert_int_equal(texture_texel(&texture, -1, 4) & 255, 4);
    assert_int_equal(texture_texel(&texture, 100, 4) & 255, 7);
    texture.flags = TUILE_TEXTURE_CLAMP_T;
    assert_int_equal(texture_texel(&texture, 5, INT32_MIN) & 255, 1);
    assert_int_equal(texture_texel(&texture, 5, INT32_MAX) & 255, 9);
}

static void a_texel_that_is_the_key_is_not_there(void **state) {
    static const uint8_t indices[] = {3, 1};
    const tuile_texture_t texture = {.texels = indices,
                                     .palette = palette_565,
                                     .width = 2,
                                     .height = 1,
                                     .levels = 1,
                                     .format = TUILE_TEXEL_PALETTE8,
                                     .flags = TUILE_TEXTURE_KEY,
                                     .key = 3};
    (void)state;
    assert_int_equal(texture_texel(&texture, 0, 0), 0);
    assert_int_equal(texture_texel(&texture, 1, 0), 0xffff0000);
}

static void levels_lie_behind_one_another(void **state) {
    static const uint8_t texels[22] = {0};
    const tuile_texture_t texture = {.texels = texels, .width = 5, .height = 3, .levels = 3, .format = TUILE_TEXEL_GREY8};
    const texture_level_t one = texture_level(&texture, 1), two = texture_level(&texture, 2);
    (void)state;
    assert_ptr_equal(one.texels, texels + 16); /* 15 bytes, and one to be even */
    assert_int_equal(one.width, 2);
    assert_int_equal(one.height, 1);
    assert_ptr_equal(two.texels, texels + 18);
    assert_int_equal(two.width, 1);
    assert_int_equal(two.height, 1);
}

/* A plane whose coordinates do not matter. */
static texture_plane_t plane_of(const tuile_texture_t *texture, bool bilinear) {
    return (texture_plane_t){.texture = *texture, .level = texture_level(texture, 0), .bilinear = bilinear};
}

static void between_the_centres_of_texels_colours_are_mixed(void **state) {
    static const uint8_t grey[] = {0, 100, 200, 40};
    const tuile_texture_t texture = {.texels = grey, .width = 2, .height = 2, .levels = 1, .format = TUILE_TEXEL_GREY8};
    const texture_plane_t plane = plane_of(&texture, true);
    const int32_t s[] = {0x8000, 0x10000, 0x18000, 0x8000, 0x10000, 0}, t[] = {0x8000, 0x8000, 0x8000, 0x10000, 0x10000, 0x8000};
    const uint32_t expected[] = {0, 50, 100, 100, 85, 50}; /* (0 + 100 + 200 + 40) / 4; half of the left one and of the right one */
    uint32_t argb[6];
    (void)state;
    texture_fetch(&plane, &plane.level, 0, s, t, 6, argb);
    for (unsigned i = 0; i < 6; i++) {
        assert_int_equal(argb[i], 0xff000000u | expected[i] * 0x010101u);
    }
}

static void beside_a_texel_that_is_not_there_the_other_one_fades(void **state) {
    static const uint8_t grey[] = {9, 200};
    const tuile_texture_t texture = {
        .texels = grey, .width = 2, .height = 1, .levels = 1, .format = TUILE_TEXEL_GREY8, .flags = TUILE_TEXTURE_KEY, .key = 9};
    const texture_plane_t plane = plane_of(&texture, true);
    const int32_t s[] = {0x10000}, t[] = {0x8000};
    uint32_t argb[1];
    (void)state;
    texture_fetch(&plane, &plane.level, 0, s, t, 1, argb);
    assert_int_equal(argb[0], 0x80c8c8c8);
}

static void texels_of_odd_levels_cover_the_whole_texture(void **state) {
    static const uint8_t grey[] = {0, 0, 0, 0, 0, 0, 11, 22}; /* 5x1, a byte, 2x1 */
    const tuile_texture_t texture = {.texels = grey, .width = 5, .height = 1, .levels = 2, .format = TUILE_TEXEL_GREY8};
    const texture_plane_t plane = plane_of(&texture, false);
    const texture_level_t one = texture_level(&texture, 1);
    const int32_t s[] = {0, 0x27fff, 0x28000, 0x4ffff, 0x50000, -1}, t[] = {0, 0, 0, 0, 0, 0};
    const uint32_t expected[] = {11, 11, 22, 22, 11, 22};
    uint32_t argb[6];
    (void)state;
    texture_fetch(&plane, &one, 1, s, t, 6, argb);
    for (unsigned i = 0; i < 6; i++) {
        assert_int_equal(argb[i] & 255, expected[i]);
    }
}

static void a_pixel_is_drawn_from_the_level_whose_texels_are_its_size(void **state) {
    tuile_texture_t texture = {.texels = (const uint8_t *)"", .width = 64, .height = 64, .levels = 7};
    (void)state;
    for (int level = -1; level < 8; level++) { /* 16 pixels that are 16 * 2^level texels */
        const int32_t size = level < 0 ? 8 * 256 : (16 << level) * 256;
        const texture_corner_t c[3] = {{0, 0, 1 << 20, 0, 0}, {0, 256, 1 << 20, 0, size}, {256, 0, 1 << 20, size, 0}};
        texture_plane_t plane;
        texture_plane_make(&plane, &texture, c, (texture_wish_t){.mips = true, .perspective = true});
        assert_int_equal(plane.level_number, level < 0 ? 0 : level > 6 ? 6 : level);
        texture_plane_make(&plane, &texture, c, (texture_wish_t){.mips = false});
        assert_int_equal(plane.level_number, 0);
    }
}

/* A floor: 64 pixels wide at the near end, 16 at the far one, four times as far away; the texture's side 64 texels all the way. */
static void in_perspective_the_level_follows_the_distance(void **state) {
    tuile_texture_t texture = {.texels = (const uint8_t *)"", .width = 64, .height = 64, .levels = 7};
    const texture_corner_t c[3] = {
        {0, 0, 1 << 22, 0, 0}, {1024, 0, 1 << 22, 64 * 256, 0}, {512, -256, 1 << 20, 32 * 256, 64 * 256}};
    texture_plane_t plane;
    (void)state;
    texture_plane_make(&plane, &texture, c, (texture_wish_t){.mips = true, .perspective = true});
    assert_true(plane.perspective);
    const unsigned near = texture_level_at(&plane, 32, -1), far = texture_level_at(&plane, 32, -15);
    assert_true(near < far);
    for (int32_t y = -15; y < -1; y++) {
        assert_true(texture_level_at(&plane, 32, y) >= texture_level_at(&plane, 32, y + 1));
        assert_int_equal(texture_level_at(&plane, 32, y), texture_level_at(&plane, 47, y));
    }
}

/* ---- the fast way ---- */

/* The distance of two places on a circle of `size`. */
static double apart(long double a, long double b, double size) {
    const double d = fabs(fmod((double)(a - b), size));
    return d < size - d ? d : size - d;
}

/* A map of three corners whose coordinates have uv_bits bits of fraction. */
static bool map_of(textured_map_t *map, textured_material_t *m, const texture_corner_t c[3]) {
    const textured_face_t face = {.x1 = c[1].x - c[0].x,
                                  .y1 = c[1].y - c[0].y,
                                  .x2 = c[2].x - c[0].x,
                                  .y2 = c[2].y - c[0].y,
                                  .depth0 = c[0].depth,
                                  .depth1 = c[1].depth,
                                  .depth2 = c[2].depth,
                                  .s0 = c[0].s,
                                  .t0 = c[0].t,
                                  .s1 = c[1].s - c[0].s,
                                  .t1 = c[1].t - c[0].t,
                                  .s2 = c[2].s - c[0].s,
                                  .t2 = c[2].t - c[0].t};
    return textured_map_at_origin(map, m, &face, c[0].x, c[0].y);
}

/* In texels of the level that is drawn, with sides of up to 1024 texels, from 1/256 to 128 texels across. */
static void the_fast_way_addresses_within_half_a_texel(void **state) {
    random_source_t random = random_seed(7);
    const textured_constants_t constants = textured_constants();
    unsigned maps = 0, pixels = 0, levels_seen = 0;
    double worst = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(60000); round++) {
        const unsigned width = (unsigned)random_between(&random, 1, 10), height = (unsigned)random_between(&random, 1, 10);
        const unsigned uv_bits = (unsigned)random_between(&random, 0, 8);
        const tuile_texture_t texture = {.texels = (const uint8_t *)"",
                                         .width = (uint16_t)(1u << width),
                                         .height = (uint16_t)(1u << height),
                                         .levels = (uint8_t)random_between(&random, 1, 8)};
        const tuile_material_t material = {.colour = {255, 255, 255}};
        const int32_t size = random_between(&random, 16, 500), most = random_between(&random, 0, 7 + (int32_t)uv_bits),
                      span = random_between(&random, 1, 1 << most), middle = random_between(&random, span - 32767, 32767 - span);
        const int32_t far = random_between(&random, -1800, 1800) * 16, depth = random_between(&random, 1 << 10, 1 << 23);
        texture_corner_t c[3], exactly[3];
        textured_material_t m;
        textured_map_t map;
        for (int i = 0; i < 3; i++) {
            c[i] = (texture_corner_t){far + random_between(&random, 0, size), random_between(&random, i ? 1 : 0, i ? size : 0),
                                      (uint32_t)(depth - random_between(&random, 0, depth / 8)),
                                      middle + random_between(&random, -span, span), middle + random_between(&random, -span, span)};
            exactly[i] = c[i];
            exactly[i].s = c[i].s * (1 << (8 - uv_bits));
            exactly[i].t = c[i].t * (1 << (8 - uv_bits));
        }
        if (round % 4 == 0) { /* slivers that end at the centre of a pixel */
            c[1].x = exactly[1].x = (c[1].x & -16) + 8;
            c[1].y = exactly[1].y = (c[1].y & -16) + 8;
            c[2].x = exactly[2].x = c[1].x + random_between(&random, -2, 2);
            c[2].y = exactly[2].y = c[1].y + random_between(&random, -2, 2);
        }
        if ((c[2].x - c[0].x) * (c[1].y - c[0].y) - (c[1].x - c[0].x) * (c[2].y - c[0].y) <= 0) { continue; }
        textured_material_open(&m, &material, &texture, 0, true, uv_bits);
        if (!m.fit || !map_of(&map, &m, c)) { continue; }
        const unsigned number = m.level.number;
        const uint32_t w = 1u << (width - number), h = 1u << (height - number);
        levels_seen |= 1u << number;
        maps++;
        /* A step of s is the exact one, rounded to 1/256 texel; the reciprocal of the area is 2^-13 of itself off at most. */
        const double area = (c[2].x - c[0].x) * (c[1].y - c[0].y) - (c[1].x - c[0].x) * (c[2].y - c[0].y);
        const double turned = (c[2].s - c[0].s) * (c[1].y - c[0].y) - (c[1].s - c[0].s) * (c[2].y - c[0].y);
        const double step = turned / area * 16 * 256 / (1 << (uv_bits + number));
        const double rounded = apart(map.dx / m.level.s_unit % (w * 256), step, w * 256);
        if (rounded > 0.51 + fabs(step) / 8192) { fail_msg("round %u: a step is %f / 256 texel off", round, rounded); }
        for (int32_t y = 0; y <= size >> 4; y++) {
            for (int32_t x = far >> 4; x <= (far + size) >> 4; x++) {
                long double st[2];
                if (!exact(exactly, x, y, true, st)) { continue; }
                const uint32_t at = map.v + map.dx * (uint32_t)x + map.dy * (uint32_t)y;
                const double s = at / m.level.s_unit % (w * 256) / 256.0, t = at / m.level.t_unit / 256.0;
                const double off =
                    fmax(apart(s, st[0] / (1 << number), w), apart(t, st[1] / (1 << number), h)); /* texels of the level */
                if (off > 0.5) { fail_msg("round %u, pixel %d,%d: %f texel off", round, x, y, off); }
                const uint32_t index = textured_index(at, map.mask, map.shift, &constants);
                assert_true(index < w * h);
                assert_int_equal(index, (uint32_t)t * w + (uint32_t)s);
                worst = fmax(worst, off);
                pixels++;
            }
        }
    }
    print_message("%u faces, %u pixels, levels %x: at most %.4f texel off\n", maps, pixels, levels_seen, worst);
    assert_true(maps > CHECK_ROUNDS(60000) / 20 && pixels > CHECK_ROUNDS(60000) / 6 && (levels_seen & 7) == 7);
}

/* Twice the area is one (1/16 pixel)^2, and the second corner the centre of pixel (30, 31): 120 texels across, a prestep would pass
 * 2^31; with an eighth of that it does not. */
static void slivers_of_many_texels_take_another_way(void **state) {
    const tuile_texture_t texture = {.texels = (const uint8_t *)"", .width = 256, .height = 256, .levels = 1};
    const tuile_material_t material = {.colour = {255, 255, 255}};
    texture_corner_t c[3] = {{9, 8, 1 << 20, 0, 0}, {488, 504, 1 << 20, 60 * 256, 0}, {319, 329, 1 << 20, -60 * 256, 0}};
    textured_material_t m;
    textured_map_t map;
    (void)state;
    textured_material_open(&m, &material, &texture, 0, true, 8);
    assert_true(m.fit && !map_of(&map, &m, c));
    c[1].s /= 8;
    c[2].s /= 8;
    assert_true(map_of(&map, &m, c));
    const uint32_t at = map.v + map.dx * 30 + map.dy * 31;
    assert_true(apart(at / m.level.s_unit % 65536 / 256.0, 7.5, 256) <= 0.5);
}

/* What clipping makes lies between the coordinates that a model can have: half a texel, where these have no fraction. */
static void corners_made_by_clipping_keep_their_fraction(void **state) {
    static const uint16_t texels[64 * 64];
    surface_face_t face = {
        .corner = {{.at = {8, 8, UINT32_C(1) << 28 | 100}},
                   {.at = {8, 264, UINT32_C(1) << 28 | 100}},
                   {.at = {264, 8, UINT32_C(1) << 28 | 100}}},
        .material = {.colour = {255, 255, 255}, .alpha = 255},
        .texture = {.texels = (const uint8_t *)texels, .width = 64, .height = 64, .levels = 1, .format = TUILE_TEXEL_RGB565},
        .triangle = true,
        .perspective = true,
        .whole = true};
    surface_t surface;
    (void)state;
    for (int i = 0; i < 3; i++) {
        face.corner[i].attributes.s = 10 * 256 + 128 + (i == 2 ? 16 * 256 : 0);
        face.corner[i].attributes.t = 20 * 256 + 128 + (i == 1 ? 16 * 256 : 0);
    }
    surface_make(&surface, &face, PIXEL_RGB565_BE);
    assert_true(surface.map.mask != 0 && surface.fill != surface_fill_stages);
    const uint32_t at = surface.map.v; /* of pixel (0, 0), the first corner; from the top 6 and 8 bits of t, as many of s, 4 */
    assert_int_equal(at >> 18, 20 * 256 + 128);
    assert_int_equal(at >> 4 & 0x3fff, 10 * 256 + 128);
}

static void the_fast_way_s_light_is_within_a_step(void **state) {
    const textured_constants_t constants = textured_constants();
    double worst_five = 0, worst_six = 0;
    (void)state;
    for (uint32_t light = 2; light <= 253; light++) {
        const uint32_t levels = textured_levels(light << 24);
        for (uint32_t k = 0; k < 64; k++) {
            const uint32_t texel = (k & 31) << 11 | k << 5 | (31 - (k & 31));
            const uint16_t lit = textured_lit(texel, levels, &constants, false);
            worst_five = fmax(worst_five, fabs((lit >> 11) - (k & 31) * (light / 255.0)));
            worst_five = fmax(worst_five, fabs((lit & 31) - (31 - (k & 31)) * (light / 255.0)));
            worst_six = fmax(worst_six, fabs((lit >> 5 & 63) - k * (light / 255.0)));
        }
    }
    print_message("red and blue %.3f, green %.3f steps\n", worst_five, worst_six);
    assert_true(worst_five <= 1.0 && worst_six <= 1.25);
}

/* Each channel of each colour at each level, in both orders of bytes, by the form of either size of registers. */
static void the_fast_way_s_light_is_the_same_on_all_machines(void **state) {
    const textured_constants_t constants = textured_constants();
    (void)state;
    for (uint32_t levels = 0; levels < 64; levels++) {
        for (uint32_t texel = 0; texel < 0x10000; texel++) {
            const uint32_t lit = ((texel >> 11) * levels + 32) / 64 << 11 | ((texel >> 5 & 63) * levels + 32) / 64 << 5 |
                                 ((texel & 31) * levels + 32) / 64;
            const uint32_t swapped = (lit << 8 | lit >> 8) & 0xffff;
            if (textured_lit_by_words(texel, levels, &constants, false) != lit ||
                textured_lit_by_words(texel, levels, &constants, true) != swapped ||
                textured_lit_by_long_words(texel, levels, &constants, false) != lit ||
                textured_lit_by_long_words(texel, levels, &constants, true) != swapped) {
                fail_msg("%04x at %u of 64", texel, levels);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_every_pixel_the_address_is_within_half_a_texel),
        cmocka_unit_test(the_fast_way_addresses_within_half_a_texel),
        cmocka_unit_test(slivers_of_many_texels_take_another_way),
        cmocka_unit_test(corners_made_by_clipping_keep_their_fraction),
        cmocka_unit_test(the_fast_way_s_light_is_within_a_step),
        cmocka_unit_test(the_fast_way_s_light_is_the_same_on_all_machines),
        cmocka_unit_test(every_format_gives_its_colours),
        cmocka_unit_test(textures_repeat_or_end_at_their_border),
        cmocka_unit_test(a_texel_that_is_the_key_is_not_there),
        cmocka_unit_test(levels_lie_behind_one_another),
        cmocka_unit_test(between_the_centres_of_texels_colours_are_mixed),
        cmocka_unit_test(beside_a_texel_that_is_not_there_the_other_one_fades),
        cmocka_unit_test(texels_of_odd_levels_cover_the_whole_texture),
        cmocka_unit_test(a_pixel_is_drawn_from_the_level_whose_texels_are_its_size),
        cmocka_unit_test(in_perspective_the_level_follows_the_distance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
