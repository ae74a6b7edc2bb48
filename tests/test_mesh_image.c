/* PNG and JPEG files, made here with known pixels, and damaged. */
#include "support/check.h"

#include <png.h>

#include "../sim/mesh/image.h"
#include "support/decoder.h"
#include "support/images.h"

static image_t decode(image_bytes_t bytes) {
    image_t image;
    sim_error_t error = {""};
    if (image_decode(&image, bytes.at, bytes.size, "x", &error) != 0) { fail_msg("%s", error.text); }
    free(bytes.at);
    return image;
}

static void check_pixels(image_t image, uint32_t width, uint32_t height, const uint8_t (*expected)[4]) {
    assert_int_equal(image.width, width);
    assert_int_equal(image.height, height);
    assert_memory_equal(image.pixels, expected, 4 * (size_t)width * height);
    image_free(&image);
    assert_null(image.pixels);
}

/* ---- PNG ------------------------------------------------------------------------------------------------------- */

static void png_of_rgb_has_its_values_and_is_opaque(void **state) {
    (void)state;
    static const uint8_t rows[] = {1, 2, 3, 250, 251, 252, 0, 0, 0, 255, 128, 7, 9, 8, 7, 31, 32, 33};
    static const uint8_t expected[][4] = {{1, 2, 3, 255},     {250, 251, 252, 255}, {0, 0, 0, 255},
                                          {255, 128, 7, 255}, {9, 8, 7, 255},       {31, 32, 33, 255}};
    check_pixels(decode(images_png_rgb(3, 2, rows, false)), 3, 2, expected);
}

static void png_with_alpha_keeps_it_and_colours_under_it(void **state) {
    (void)state;
    static const uint8_t rows[] = {1, 2, 3, 0, 200, 100, 50, 128};
    static const uint8_t expected[][4] = {{1, 2, 3, 0}, {200, 100, 50, 128}};
    check_pixels(decode(images_png_rgb(2, 1, rows, true)), 2, 1, expected);
}

static void png_interlaced_is_the_same(void **state) {
    (void)state;
    uint8_t rows[9 * 7 * 3], expected[9 * 7][4];
    for (unsigned i = 0; i < 63; i++) {
        const uint8_t pixel[4] = {(uint8_t)(i * 4), (uint8_t)(255 - i), (uint8_t)(i * i), 255};
        memcpy(rows + 3 * i, pixel, 3);
        memcpy(expected[i], pixel, 4);
    }
    const images_png_t png = {
        .width = 9, .height = 7, .colour_type = PNG_COLOR_TYPE_RGB, .depth = 8, .interlaced = true, .rows = rows, .row_bytes = 27};
    check_pixels(decode(images_png(&png)), 9, 7, (const uint8_t(*)[4])expected);
}

static void png_of_a_palette_has_its_colours_and_alphas(void **state) {
    (void)state;
    static const uint8_t palette[][3] = {{10, 20, 30}, {40, 50, 60}, {70, 80, 90}}, alphas[] = {255, 0, 128};
    static const uint8_t rows[] = {0x18}; /* 2 bits each: 0, 1, 2 */
    static const uint8_t expected[][4] = {{10, 20, 30, 255}, {40, 50, 60, 0}, {70, 80, 90, 128}};
    const images_png_t png = {.width = 3,
                              .height = 1,
                              .colour_type = PNG_COLOR_TYPE_PALETTE,
                              .depth = 2,
                              .rows = rows,
                              .row_bytes = 1,
                              .palette = palette,
                              .alphas = alphas,
                              .entries = 3};
    check_pixels(decode(images_png(&png)), 3, 1, expected);
}

static void png_of_grey_spreads_its_bits(void **state) {
    (void)state;
    static const uint8_t one[] = {0xa0}, four[] = {0x0f, 0x70}, eight[] = {3, 200}, with_alpha[] = {9, 100, 255, 0};
    static const uint8_t of_one[][4] = {{255, 255, 255, 255}, {0, 0, 0, 255}, {255, 255, 255, 255}};
    static const uint8_t of_four[][4] = {{0, 0, 0, 255}, {255, 255, 255, 255}, {0x77, 0x77, 0x77, 255}};
    static const uint8_t of_eight[][4] = {{3, 3, 3, 255}, {200, 200, 200, 255}};
    static const uint8_t of_alpha[][4] = {{9, 9, 9, 100}, {255, 255, 255, 0}};
    images_png_t png = {.width = 3, .height = 1, .colour_type = PNG_COLOR_TYPE_GRAY, .depth = 1, .rows = one, .row_bytes = 1};
    check_pixels(decode(images_png(&png)), 3, 1, of_one);
    png.depth = 4;
    png.rows = four;
    check_pixels(decode(images_png(&png)), 3, 1, of_four);
    png.depth = 8;
    png.width = 2;
    png.rows = eight;
    check_pixels(decode(images_png(&png)), 2, 1, of_eight);
    png.colour_type = PNG_COLOR_TYPE_GRAY_ALPHA;
    png.rows = with_alpha;
    check_pixels(decode(images_png(&png)), 2, 1, of_alpha);
}

static void png_of_16_bits_is_rounded_to_8(void **state) {
    (void)state;
    /* 0x8080 / 257 = 128 exactly; 0x00ff / 257 = 0.992; 0x007f / 257 = 0.494; 0xffff / 257 = 255. */
    static const uint8_t rows[] = {0x80, 0x80, 0x00, 0xff, 0x00, 0x7f, 0xff, 0xff, 0x00, 0x00, 0x12, 0x12};
    static const uint8_t expected[][4] = {{128, 1, 0, 255}, {255, 0, 0x12, 255}};
    const images_png_t png = {
        .width = 2, .height = 1, .colour_type = PNG_COLOR_TYPE_RGB, .depth = 16, .rows = rows, .row_bytes = 12};
    check_pixels(decode(images_png(&png)), 2, 1, expected);
}

static void png_with_a_gamma_is_taken_as_it_is(void **state) {
    (void)state;
    static const uint8_t rows[] = {10, 100, 200};
    static const uint8_t expected[][4] = {{10, 100, 200, 255}};
    const images_png_t png = {
        .width = 1, .height = 1, .colour_type = PNG_COLOR_TYPE_RGB, .depth = 8, .rows = rows, .row_bytes = 3, .gamma = 1.0};
    check_pixels(decode(images_png(&png)), 1, 1, expected);
}

/* ---- JPEG ------------------------------------------------------------------------------------------------------ */

static void jpeg_of_one_colour_has_it_within_two(void **state) {
    (void)state;
    uint8_t rows[16 * 8 * 3], grey[16 * 8];
    for (unsigned i = 0; i < 128; i++) {
        rows[3 * i] = 200;
        rows[3 * i + 1] = 100;
        rows[3 * i + 2] = 30;
        grey[i] = 77;
    }
    image_t image = decode(images_jpeg(16, 8, rows, 3));
    assert_int_equal(image.width, 16);
    assert_int_equal(image.height, 8);
    for (unsigned i = 0; i < 128; i++) {
        for (unsigned k = 0; k < 3; k++) {
            assert_in_range(image.pixels[i][k], rows[k] - 2, rows[k] + 2);
        }
        assert_int_equal(image.pixels[i][3], 255);
    }
    image_free(&image);
    image = decode(images_jpeg(16, 8, grey, 1));
    for (unsigned i = 0; i < 128; i++) {
        assert_in_range(image.pixels[i][0], 76, 78);
        assert_int_equal(image.pixels[i][0], image.pixels[i][1]);
        assert_int_equal(image.pixels[i][0], image.pixels[i][2]);
    }
    image_free(&image);
}

static void jpeg_rows_begin_on_top(void **state) {
    (void)state;
    uint8_t rows[8 * 16];
    memset(rows, 0, 64);
    memset(rows + 64, 255, 64);
    image_t image = decode(images_jpeg(8, 16, rows, 1));
    assert_in_range(image.pixels[0][0], 0, 3);
    assert_in_range(image.pixels[127][0], 252, 255);
    image_free(&image);
}

/* ---- errors ----------------------------------------------------------------------------------------------------- */

static void fails(const uint8_t *bytes, size_t size, const char *expected) {
    image_t image = {1, 1, NULL};
    sim_error_t error = {""};
    uint8_t *copy = malloc(size ? size : 1); /* no longer than it is */
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    assert_int_equal(image_decode(&image, copy, size, "file.x", &error), -1);
    free(copy);
    assert_null(image.pixels);
    assert_int_equal(image.width, 0);
    if (strncmp(error.text, "file.x: ", 8) != 0 || !strstr(error.text, expected)) { fail_msg("%s", error.text); }
}

static void other_files_are_refused(void **state) {
    (void)state;
    fails((const uint8_t *)"GIF89a", 6, "neither a PNG nor a JPEG");
    fails((const uint8_t *)"", 0, "neither a PNG nor a JPEG");
    fails((const uint8_t *)"\x89PNG\r\n\x1a", 7, "neither a PNG nor a JPEG");
}

static void a_png_cut_anywhere_is_refused(void **state) {
    (void)state;
    uint8_t rows[12 * 12 * 3];
    for (unsigned i = 0; i < sizeof rows; i++) {
        rows[i] = (uint8_t)(i * 37);
    }
    image_bytes_t bytes = images_png_rgb(12, 12, rows, false);
    for (size_t size = 8; size < bytes.size; size++) {
        fails(bytes.at, size, "broken PNG");
    }
    free(bytes.at);
}

static void a_png_with_a_wrong_sum_is_refused(void **state) {
    (void)state;
    static const uint8_t rows[] = {1, 2, 3};
    image_bytes_t bytes = images_png_rgb(1, 1, rows, false);
    bytes.at[18] ^= 4; /* the width */
    fails(bytes.at, bytes.size, "broken PNG");
    free(bytes.at);
}

static void a_png_of_no_size_or_too_large_is_refused(void **state) {
    (void)state;
    static const uint8_t rows[] = {1, 2, 3};
    static const struct {
        uint32_t width;
        const char *text;
    } cases[] = {{0, "broken PNG"}, {IMAGE_SIDE_MAX + 1, "16385x1 pixels"}, {0x7fffffff, "2147483647x1 pixels"}};
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        image_bytes_t bytes = images_png_rgb(1, 1, rows, false);
        for (unsigned k = 0; k < 4; k++) {
            bytes.at[16 + k] = (uint8_t)(cases[i].width >> (24 - 8 * k));
        }
        const uint32_t crc = decoder_crc(bytes.at + 12, 17);
        for (unsigned k = 0; k < 4; k++) {
            bytes.at[29 + k] = (uint8_t)(crc >> (24 - 8 * k));
        }
        fails(bytes.at, bytes.size, cases[i].text);
        free(bytes.at);
    }
}

static void a_jpeg_cut_short_is_refused(void **state) {
    (void)state;
    uint8_t rows[32 * 32 * 3];
    for (unsigned i = 0; i < sizeof rows; i++) {
        rows[i] = (uint8_t)(i * i >> 3);
    }
    image_bytes_t bytes = images_jpeg(32, 32, rows, 3);
    for (size_t size = 3; size + 2 < bytes.size; size++) { /* the two bytes at its end say no more than that */
        fails(bytes.at, size, "broken JPEG");
    }
    free(bytes.at);
}

static void a_jpeg_for_print_is_refused(void **state) {
    (void)state;
    uint8_t rows[8 * 8 * 4];
    memset(rows, 100, sizeof rows);
    image_bytes_t bytes = images_jpeg(8, 8, rows, 4);
    fails(bytes.at, bytes.size, "CMYK");
    free(bytes.at);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_of_rgb_has_its_values_and_is_opaque),
        cmocka_unit_test(png_with_alpha_keeps_it_and_colours_under_it),
        cmocka_unit_test(png_interlaced_is_the_same),
        cmocka_unit_test(png_of_a_palette_has_its_colours_and_alphas),
        cmocka_unit_test(png_of_grey_spreads_its_bits),
        cmocka_unit_test(png_of_16_bits_is_rounded_to_8),
        cmocka_unit_test(png_with_a_gamma_is_taken_as_it_is),
        cmocka_unit_test(jpeg_of_one_colour_has_it_within_two),
        cmocka_unit_test(jpeg_rows_begin_on_top),
        cmocka_unit_test(other_files_are_refused),
        cmocka_unit_test(a_png_cut_anywhere_is_refused),
        cmocka_unit_test(a_png_with_a_wrong_sum_is_refused),
        cmocka_unit_test(a_png_of_no_size_or_too_large_is_refused),
        cmocka_unit_test(a_jpeg_cut_short_is_refused),
        cmocka_unit_test(a_jpeg_for_print_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
