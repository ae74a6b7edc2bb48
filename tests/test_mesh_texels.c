/* Textures from pixels: formats, palettes, levels and keys, by values made by hand. */
#include "support/check.h"

#include "../raster/geometry/model.h"
#include "../raster/surface/texture.h"
#include "../sim/mesh/texels.h"

static image_t image_of(uint32_t width, uint32_t height, const uint8_t (*pixels)[4]) {
    image_t image = {width, height, calloc((size_t)width * height, 4)};
    assert_non_null(image.pixels);
    if (pixels) { memcpy(image.pixels, pixels, 4 * (size_t)width * height); }
    return image;
}

static mesh_texture_t make(image_t image, const mesh_options_t *options) {
    mesh_texture_t texture;
    sim_error_t error = {""};
    if (texels_make(&texture, &image, TUILE_TEXTURE_CLAMP_T, options, "x", &error) != 0) { fail_msg("%s", error.text); }
    assert_true(texture.flags & TUILE_TEXTURE_CLAMP_T);
    image_free(&image);
    return texture;
}

static void drop(mesh_texture_t *texture) {
    free(texture->texels);
    free(texture->palette);
}

static mesh_options_t of_format(int format) { return (mesh_options_t){.texture_format = (uint8_t)(format + 1), .no_mips = true}; }

#define OPAQUE(r, g, b) \
    { r, g, b, 255 }

/* ---- formats ----------------------------------------------------------------------------------------------------- */

static void rgb565_is_rounded_and_little_endian(void **state) {
    (void)state;
    /* 8-bit value v to n steps: (v n + 127) / 255. 132: 16.05 of 31, 32.6 of 63. 4: 0.49, 0.99. 5: 0.61. */
    static const uint8_t pixels[][4] = {OPAQUE(255, 0, 132), OPAQUE(0, 132, 4), OPAQUE(5, 4, 255), OPAQUE(132, 255, 0)};
    static const uint8_t expected[] = {0x10, 0xf8, 0x20, 0x04, 0x3f, 0x08, 0xe0, 0x87};
    const mesh_options_t options = of_format(TUILE_TEXEL_RGB565);
    mesh_texture_t texture = make(image_of(2, 2, pixels), &options);
    assert_int_equal(texture.format, TUILE_TEXEL_RGB565);
    assert_int_equal(texture.width, 2);
    assert_int_equal(texture.height, 2);
    assert_int_equal(texture.levels, 1);
    assert_int_equal(texture.flags, TUILE_TEXTURE_CLAMP_T);
    assert_int_equal(texture.size_bytes, 8);
    assert_null(texture.palette);
    assert_memory_equal(texture.texels, expected, 8);
    drop(&texture);
}

static void argb4444_has_alpha_on_top(void **state) {
    (void)state;
    static const uint8_t pixels[][4] = {{255, 0, 17, 255}, {34, 51, 68, 0}, {0x88, 0x99, 0xaa, 0x77}};
    const mesh_options_t options = of_format(TUILE_TEXEL_ARGB4444);
    mesh_texture_t texture = make(image_of(3, 1, pixels), &options);
    assert_int_equal(texture.texels[0] | texture.texels[1] << 8, 0xff01);
    assert_int_equal(texture.texels[2] | texture.texels[3] << 8, 0x0000); /* what is not there has no colour */
    assert_int_equal(texture.texels[4] | texture.texels[5] << 8, 0x789a);
    drop(&texture);
}

static void grey8_is_luminance(void **state) {
    (void)state;
    static const uint8_t pixels[][4] = {OPAQUE(255, 255, 255), OPAQUE(255, 0, 0), OPAQUE(0, 255, 0), OPAQUE(0, 0, 255),
                                        OPAQUE(9, 9, 9)};
    static const uint8_t expected[] = {255, 77, 149, 29, 9}; /* 0.299, 0.587, 0.114 of 255: 76.2, 149.7, 29.1, in 1/256 */
    const mesh_options_t options = of_format(TUILE_TEXEL_GREY8);
    mesh_texture_t texture = make(image_of(5, 1, pixels), &options);
    assert_int_equal(texture.size_bytes, 5);
    assert_memory_equal(texture.texels, expected, 5);
    drop(&texture);
}

static void palette4_has_the_left_texel_in_the_low_half_and_rows_on_whole_bytes(void **state) {
    (void)state;
    static const uint8_t pixels[][4] = {OPAQUE(255, 0, 0), OPAQUE(0, 255, 0), OPAQUE(0, 0, 255),
                                        OPAQUE(0, 0, 255), OPAQUE(0, 0, 255), OPAQUE(255, 0, 0)};
    static const uint8_t texels[] = {0x10, 0x02, 0x22, 0x00};
    uint8_t palette[32] = {0x00, 0xf8, 0xe0, 0x07, 0x1f, 0x00}; /* in order of first use */
    const mesh_options_t options = of_format(TUILE_TEXEL_PALETTE4);
    mesh_texture_t texture = make(image_of(3, 2, pixels), &options);
    assert_int_equal(texture.size_bytes, 4);
    assert_memory_equal(texture.texels, texels, 4);
    assert_int_equal(texture.palette_bytes, 32);
    assert_memory_equal(texture.palette, palette, 32);
    drop(&texture);
}

static void palettes_of_images_with_alpha_are_argb4444(void **state) {
    (void)state;
    static const uint8_t pixels[][4] = {OPAQUE(255, 0, 0), {0x11, 0x22, 0x33, 0x44}};
    const mesh_options_t options = of_format(TUILE_TEXEL_PALETTE8);
    mesh_texture_t texture = make(image_of(2, 1, pixels), &options);
    assert_int_equal(texture.flags, TUILE_TEXTURE_CLAMP_T | TUILE_TEXTURE_PALETTE_ALPHA);
    assert_int_equal(texture.palette_bytes, 512);
    assert_int_equal(texture.palette[0] | texture.palette[1] << 8, 0xff00);
    assert_int_equal(texture.palette[2] | texture.palette[3] << 8, 0x4123);
    assert_int_equal(texture.texels[0], 0);
    assert_int_equal(texture.texels[1], 1);
    drop(&texture);
}

static void a_forced_palette_takes_means_of_neighbours(void **state) {
    (void)state;
    /* 32 reds of RGB565 onto 16 entries: neighbours share one, so none is off by more than two steps of 8. */
    uint8_t pixels[32][4];
    for (unsigned i = 0; i < 32; i++) {
        const uint8_t pixel[4] = OPAQUE((uint8_t)((i * 255 + 15) / 31), 0, 0);
        memcpy(pixels[i], pixel, 4);
    }
    const mesh_options_t options = of_format(TUILE_TEXEL_PALETTE4);
    mesh_texture_t texture = make(image_of(32, 1, (const uint8_t(*)[4])pixels), &options);
    for (unsigned i = 0; i < 32; i++) {
        const unsigned index = (unsigned)texture.texels[i / 2] >> 4 * (i % 2) & 15u;
        const int red = (int)(uint8_t)texture.palette[2u * index + 1u] >> 3;
        assert_in_range(red + 2 - (int)i, 0, 4);
    }
    drop(&texture);
}

/* ---- the choice ---------------------------------------------------------------------------------------------------- */

static uint8_t chosen(image_t image) {
    const mesh_options_t options = {.no_mips = true};
    mesh_texture_t texture = make(image, &options);
    const uint8_t format = texture.format;
    drop(&texture);
    return format;
}

/* `colours` distinct ones of RGB565, each a step from the next. */
static image_t of_colours(unsigned colours) {
    image_t image = image_of(colours, 2, NULL);
    for (unsigned i = 0; i < 2 * colours; i++) {
        const unsigned c = i % colours;
        const uint8_t pixel[4] = OPAQUE((uint8_t)((c % 32 * 255 + 15) / 31), (uint8_t)((c / 32 * 255 + 31) / 63), 0);
        memcpy(image.pixels[i], pixel, 4);
    }
    return image;
}

static void auto_takes_the_smallest_format_that_loses_nothing(void **state) {
    (void)state;
    assert_int_equal(chosen(of_colours(1)), TUILE_TEXEL_PALETTE4);
    assert_int_equal(chosen(of_colours(16)), TUILE_TEXEL_PALETTE4);
    assert_int_equal(chosen(of_colours(17)), TUILE_TEXEL_PALETTE8);
    assert_int_equal(chosen(of_colours(256)), TUILE_TEXEL_PALETTE8);
    assert_int_equal(chosen(of_colours(257)), TUILE_TEXEL_RGB565);
    image_t grey = image_of(40, 1, NULL);
    for (unsigned i = 0; i < 40; i++) {
        const uint8_t pixel[4] = OPAQUE((uint8_t)(6 * i), (uint8_t)(6 * i), (uint8_t)(6 * i));
        memcpy(grey.pixels[i], pixel, 4);
    }
    assert_int_equal(chosen(grey), TUILE_TEXEL_GREY8);
    image_t alpha = of_colours(2);
    alpha.pixels[1][3] = 254;
    assert_int_equal(chosen(alpha), TUILE_TEXEL_ARGB4444);
}

/* ---- levels -------------------------------------------------------------------------------------------------------- */

static const uint8_t *level_of(const mesh_texture_t *texture, unsigned number) {
    const tuile_texture_t t = {.texels = texture->texels,
                               .width = texture->width,
                               .height = texture->height,
                               .format = texture->format,
                               .levels = texture->levels};
    return texture_level(&t, number).texels;
}

static void levels_are_means_of_two_by_two(void **state) {
    (void)state;
    static const uint8_t values[16] = {0, 2, 100, 102, 4, 6, 104, 106, 200, 200, 10, 11, 200, 203, 11, 10};
    static const uint8_t half[4] = {3, 103, 201, 11}; /* 3, 103, 200.75, 10.5: halves up */
    image_t image = image_of(4, 4, NULL);
    for (unsigned i = 0; i < 16; i++) {
        const uint8_t pixel[4] = OPAQUE(values[i], values[i], values[i]);
        memcpy(image.pixels[i], pixel, 4);
    }
    mesh_options_t options = of_format(TUILE_TEXEL_GREY8);
    options.no_mips = false;
    mesh_texture_t texture = make(image, &options);
    assert_int_equal(texture.levels, 3);
    assert_int_equal(texture.size_bytes, 16 + 4 + 1);
    assert_memory_equal(level_of(&texture, 0), values, 16);
    assert_memory_equal(level_of(&texture, 1), half, 4);
    assert_int_equal(level_of(&texture, 2)[0], 79); /* the sum of all, 1269, / 16 = 79.3; of the rounded ones 79.5 */
    drop(&texture);
}

static void levels_of_odd_sizes_weigh_by_area(void **state) {
    (void)state;
    /* 3 to 1: a third each. 5 to 2: each covers 2.5 of them. */
    static const uint8_t three[3] = {30, 60, 120}, five[5] = {10, 20, 100, 200, 50};
    mesh_options_t options = of_format(TUILE_TEXEL_GREY8);
    options.no_mips = false;
    image_t image = image_of(3, 1, NULL);
    for (unsigned i = 0; i < 3; i++) {
        memset(image.pixels[i], three[i], 3);
        image.pixels[i][3] = 255;
    }
    mesh_texture_t texture = make(image, &options);
    assert_int_equal(texture.levels, 2);
    assert_int_equal(texture.size_bytes, 5); /* level 1 begins at an even byte */
    assert_int_equal(level_of(&texture, 1)[0], 70);
    drop(&texture);
    image = image_of(1, 5, NULL);
    for (unsigned i = 0; i < 5; i++) {
        memset(image.pixels[i], five[i], 3);
        image.pixels[i][3] = 255;
    }
    texture = make(image, &options);
    assert_int_equal(texture.levels, 3);
    assert_int_equal(level_of(&texture, 1)[0], 32);  /* (10 + 20 + 50) / 2.5 */
    assert_int_equal(level_of(&texture, 1)[1], 120); /* (50 + 200 + 50) / 2.5 */
    drop(&texture);
}

static void levels_weigh_colours_by_alpha(void **state) {
    (void)state;
    /* Opaque red beside clear blue: red of half the alpha, not violet. */
    static const uint8_t pixels[][4] = {{255, 0, 0, 255}, {0, 0, 255, 0}};
    mesh_options_t options = of_format(TUILE_TEXEL_ARGB4444);
    options.no_mips = false;
    mesh_texture_t texture = make(image_of(2, 1, pixels), &options);
    assert_int_equal(texture.texels[4] | texture.texels[5] << 8, 0x8f00); /* 127.5 of 255 is 7.5 of 15 */
    drop(&texture);
}

static void size_halves_until_it_fits(void **state) {
    (void)state;
    mesh_options_t options = {.no_mips = true, .texture_size = 5};
    mesh_texture_t texture = make(image_of(23, 9, NULL), &options);
    assert_int_equal(texture.width, 5);
    assert_int_equal(texture.height, 2);
    drop(&texture);
    options.texture_size = 1;
    texture = make(image_of(23, 9, NULL), &options);
    assert_int_equal(texture.width, 1);
    assert_int_equal(texture.height, 1);
    drop(&texture);
    options.texture_size = 2048;
    texture = make(image_of(4095, 1, NULL), &options);
    assert_int_equal(texture.width, 2047);
    drop(&texture);
}

static void fast_sides_are_the_nearest_powers_of_two(void **state) {
    (void)state;
    static const uint32_t sides[][3] = {/* of the image, the most that is asked for, of the texture */
                                        {1, 0, 2},       {2, 0, 2},       {3, 0, 2},     {4, 0, 4},      {5, 0, 4},   {6, 0, 4},
                                        {7, 0, 8},       {249, 0, 256},   {768, 0, 512}, {769, 0, 1024}, {250, 8, 8}, {15, 8, 8},
                                        {2048, 0, 2048}, {1537, 0, 2048}, {100, 1, 1},   {250, 250, 128}};
    for (unsigned i = 0; i < CHECK_COUNT(sides); i++) {
        const mesh_options_t options = {.no_mips = true, .texture_fast = true, .texture_size = (uint16_t)sides[i][1]};
        mesh_texture_t texture = make(image_of(sides[i][0], 4, NULL), &options);
        if (texture.width != sides[i][2]) { fail_msg("%u at most %u: %u", sides[i][0], sides[i][1], texture.width); }
        drop(&texture);
        texture = make(image_of(4, sides[i][0], NULL), &options);
        if (texture.height != sides[i][2]) { fail_msg("%u at most %u: %u high", sides[i][0], sides[i][1], texture.height); }
        drop(&texture);
    }
}

static void fast_texels_are_means_of_what_they_cover(void **state) {
    (void)state;
    /* 3 texels to 2: each has all of one and half of the middle one, (2 a + b) / 3. 7 to 8: texel i has 7 i / 8 ... 7 (i + 1) / 8.
     */
    static const uint8_t three[][4] = {OPAQUE(255, 0, 0), OPAQUE(0, 255, 0), OPAQUE(0, 0, 255)};
    mesh_options_t options = of_format(TUILE_TEXEL_RGB565);
    options.texture_fast = true;
    mesh_texture_t texture = make(image_of(3, 1, three), &options);
    assert_int_equal(texture.width, 2);
    assert_int_equal(texture.height, 2);
    for (unsigned row = 0; row < 8; row += 4) { /* 170 is 20.7 of 31, 85 is 21 of 63 */
        assert_int_equal(texture.texels[row] | texture.texels[row + 1] << 8, 21 << 11 | 21 << 5);
        assert_int_equal(texture.texels[row + 2] | texture.texels[row + 3] << 8, 21 << 5 | 21);
    }
    drop(&texture);
    static const uint8_t seven[7][4] = {OPAQUE(0, 0, 0), OPAQUE(56, 56, 56), OPAQUE(0, 0, 0),      OPAQUE(0, 0, 0),
                                        OPAQUE(0, 0, 0), OPAQUE(0, 0, 0),    OPAQUE(252, 252, 252)};
    /* Texel 1 has 1/8 of texel 0 and 6/8 of texel 1, of 7/8: 48; texel 2 has 2/8 of 7/8 of texel 1: 16; 6 has 1/8: 36; 7 has 7/8.
     */
    static const uint8_t expected[8] = {0, 48, 16, 0, 0, 0, 36, 252};
    options.texture_format = MESH_TEXELS_AUTO;
    texture = make(image_of(7, 1, seven), &options);
    assert_int_equal(texture.format, TUILE_TEXEL_PALETTE8);
    assert_int_equal(texture.width, 8);
    for (unsigned i = 0; i < 16; i++) {
        const uint8_t *entry = texture.palette + 2 * texture.texels[i];
        assert_int_equal((entry[0] | entry[1] << 8) >> 5 & 63, (expected[i % 8] * 63 + 127) / 255);
    }
    drop(&texture);
}

static void fast_images_too_large_are_refused_as_others(void **state) {
    (void)state;
    const mesh_options_t options = {.texture_fast = true};
    image_t image = image_of(2049, 4, NULL);
    mesh_texture_t texture;
    sim_error_t error = {""};
    assert_int_equal(texels_make(&texture, &image, 0, &options, "a.png", &error), -1);
    assert_non_null(strstr(error.text, "2049x4"));
    image_free(&image);
}

/* ---- keys ---------------------------------------------------------------------------------------------------------- */

static void texels_of_the_key_are_the_key_and_no_others(void **state) {
    (void)state;
    /* The second differs from the key by less than a step. */
    static const uint8_t pixels[][4] = {OPAQUE(255, 0, 255), OPAQUE(254, 0, 255), OPAQUE(0, 0, 0)};
    static const int formats[] = {TUILE_TEXEL_RGB565, TUILE_TEXEL_PALETTE8, TUILE_TEXEL_GREY8};
    for (unsigned i = 0; i < CHECK_COUNT(formats); i++) {
        mesh_options_t options = of_format(formats[i]);
        options.texture_keyed = true;
        options.texture_key[0] = options.texture_key[2] = 255;
        mesh_texture_t texture = make(image_of(3, 1, pixels), &options);
        assert_true(texture.flags & TUILE_TEXTURE_KEY);
        tuile_texture_t t = {.texels = texture.texels,
                             .palette = texture.palette,
                             .width = 3,
                             .height = 1,
                             .format = texture.format,
                             .levels = 1,
                             .flags = texture.flags,
                             .key = texture.key};
        assert_int_equal(texture_texel(&t, 0, 0), 0);
        assert_int_equal(texture_texel(&t, 1, 0) >> 24, 255);
        assert_int_equal(texture_texel(&t, 2, 0), 0xff000000u);
        drop(&texture);
    }
}

static void the_key_in_argb4444_is_alpha(void **state) {
    (void)state;
    static const uint8_t pixels[][4] = {OPAQUE(1, 2, 3), OPAQUE(255, 255, 255)};
    mesh_options_t options = of_format(TUILE_TEXEL_ARGB4444);
    options.texture_keyed = true;
    memcpy(options.texture_key, pixels[0], 3);
    mesh_texture_t texture = make(image_of(2, 1, pixels), &options);
    assert_int_equal(texture.flags, TUILE_TEXTURE_CLAMP_T);
    assert_int_equal(texture.key, 0);
    assert_int_equal(texture.texels[0] | texture.texels[1] << 8, 0x0000);
    assert_int_equal(texture.texels[2] | texture.texels[3] << 8, 0xffff);
    drop(&texture);
}

static void a_key_does_not_tint_levels_and_is_there_where_half_is(void **state) {
    (void)state;
    /* 4x1: key key key red | green green green key -> of 2: the key (1/4 is there), green (3/4). */
    static const uint8_t pixels[][4] = {OPAQUE(0, 0, 255), OPAQUE(0, 0, 255), OPAQUE(0, 255, 0), OPAQUE(0, 255, 0),
                                        OPAQUE(0, 0, 255), OPAQUE(255, 0, 0), OPAQUE(0, 255, 0), OPAQUE(0, 0, 255)};
    mesh_options_t options = of_format(TUILE_TEXEL_RGB565);
    options.no_mips = false;
    options.texture_keyed = true;
    options.texture_key[2] = 255;
    mesh_texture_t texture = make(image_of(4, 2, pixels), &options);
    assert_int_equal(texture.key, 0x001f);
    const uint8_t *half = level_of(&texture, 1);
    assert_int_equal(half[0] | half[1] << 8, 0x001f);
    assert_int_equal(half[2] | half[3] << 8, 0x07e0);
    drop(&texture);
}

static void a_full_palette_keeps_an_entry_for_the_key(void **state) {
    (void)state;
    image_t image = of_colours(16);
    mesh_options_t options = of_format(TUILE_TEXEL_PALETTE4);
    options.texture_keyed = true;
    options.texture_key[2] = 255; /* in no texel */
    mesh_texture_t texture = make(image, &options);
    assert_int_equal(texture.key, 15);
    for (size_t i = 0; i < texture.size_bytes; i++) {
        assert_true((texture.texels[i] & 15) < 15 && texture.texels[i] >> 4 < 15);
    }
    drop(&texture);
    options = (mesh_options_t){.texture_keyed = true, .texture_key = {0, 0, 255}};
    texture = make(of_colours(16), &options); /* 17 in all */
    assert_int_equal(texture.format, TUILE_TEXEL_PALETTE8);
    drop(&texture);
}

/* ---- errors --------------------------------------------------------------------------------------------------------- */

static void fails(image_t image, const mesh_options_t *options, const char *expected) {
    mesh_texture_t texture;
    sim_error_t error = {""};
    assert_int_equal(texels_make(&texture, &image, 0, options, "a.png", &error), -1);
    image_free(&image);
    assert_null(texture.texels);
    assert_null(texture.palette);
    assert_string_equal(error.text, expected);
}

static void what_does_not_fit_is_refused(void **state) {
    (void)state;
    static const uint8_t alpha[][4] = {{1, 2, 3, 254}};
    const mesh_options_t defaults = {0}, grey = of_format(TUILE_TEXEL_GREY8), rgb = of_format(TUILE_TEXEL_RGB565);
    fails(image_of(2049, 1, NULL), &defaults,
          "a.png: is 2049x1 pixels, and a texture has 2048 at most; make it smaller (--texture-size 2048)");
    fails(image_of(1, 2049, NULL), &defaults,
          "a.png: is 1x2049 pixels, and a texture has 2048 at most; make it smaller (--texture-size 2048)");
    fails(image_of(1, 1, alpha), &grey, "a.png: has alpha, and grey8 has none; take argb4444, palette8 or palette4");
    fails(image_of(1, 1, alpha), &rgb, "a.png: has alpha, and rgb565 has none; take argb4444, palette8 or palette4");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rgb565_is_rounded_and_little_endian),
        cmocka_unit_test(argb4444_has_alpha_on_top),
        cmocka_unit_test(grey8_is_luminance),
        cmocka_unit_test(palette4_has_the_left_texel_in_the_low_half_and_rows_on_whole_bytes),
        cmocka_unit_test(palettes_of_images_with_alpha_are_argb4444),
        cmocka_unit_test(a_forced_palette_takes_means_of_neighbours),
        cmocka_unit_test(auto_takes_the_smallest_format_that_loses_nothing),
        cmocka_unit_test(levels_are_means_of_two_by_two),
        cmocka_unit_test(levels_of_odd_sizes_weigh_by_area),
        cmocka_unit_test(levels_weigh_colours_by_alpha),
        cmocka_unit_test(size_halves_until_it_fits),
        cmocka_unit_test(fast_sides_are_the_nearest_powers_of_two),
        cmocka_unit_test(fast_texels_are_means_of_what_they_cover),
        cmocka_unit_test(fast_images_too_large_are_refused_as_others),
        cmocka_unit_test(texels_of_the_key_are_the_key_and_no_others),
        cmocka_unit_test(the_key_in_argb4444_is_alpha),
        cmocka_unit_test(a_key_does_not_tint_levels_and_is_there_where_half_is),
        cmocka_unit_test(a_full_palette_keeps_an_entry_for_the_key),
        cmocka_unit_test(what_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
