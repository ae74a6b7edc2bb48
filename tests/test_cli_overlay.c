/* tuile font, and what tuile render draws over a model. */
#include "support/check.h"
#include "support/cli.h"

#include "../raster/overlay/font.h"
#include "../sim/picture.h"

#define OWN "sim/fonts/tuile-6x10.bdf"
#define AT "$(printf '\\100')" /* the sign itself: in a line for the shell it is the folder */
#define CUBE "render @/cube.obj --background 000000 "

/* ---- tuile font ---- */

static void font_writes_a_font_that_opens(void **state) {
    tuile_font_t font;
    size_t size;
    (void)state;
    char *out = cli_good("font " OWN " -o @/own.tuilefont");
    assert_non_null(strstr(out, "glyphs 203, "));
    free(out);
    char *bytes = command_read(cli_path("own.tuilefont"), &size);
    assert_int_equal(tuile_font_open(&font, bytes, size), 0);
    assert_int_equal(font.glyph_count, 203);
    free(bytes);
    out = cli_good("font " OWN " -o @/small.tuilefont --range 32-126,0xB0,0x400-0x404");
    assert_non_null(strstr(out, "glyphs 96, "));
    assert_non_null(strstr(out, "has not: 5\n"));
    free(out);
}

/* The words of the C source are those of the binary, and a compiler takes it. */
static void the_c_source_has_the_same_bytes(void **state) {
    command_result_t result;
    size_t size;
    (void)state;
    cli_good_silent("font " OWN " -o @/own.tuilefont");
    cli_good_silent("font " OWN " -o @/own-6x10.c --name own");
    cli_put("main.c",
            "#include <stdio.h>\n#include \"own-6x10.c\"\nint main(void) { fwrite(own, sizeof own, 1, stdout); return 0; }\n");
    cli_shell(&result, "cc -Wall -Werror -o @/main @/main.c && @/main");
    assert_int_equal(result.code, 0);
    char *bytes = command_read(cli_path("own.tuilefont"), &size);
    assert_int_equal(result.out_bytes, size);
    assert_memory_equal(result.out, bytes, size);
    free(bytes);
    command_free(&result);
}

static void font_refuses_what_it_cannot_compile(void **state) {
    (void)state;
    cli_put("broken.bdf", "STARTFONT 2.1\nSTARTCHAR a\nENCODING 65\nDWIDTH 900 0\n");
    cli_fails("font @/broken.bdf -o @/out.c", "broken.bdf:4:", "DWIDTH");
    cli_fails("font @/nothing.bdf -o @/out.c", "nothing.bdf", "No such file");
    cli_fails("font " OWN " -o @/out.ttf", "out.ttf", ".tuilefont");
    cli_fails("font " OWN " -o @/nowhere/out.c", "nowhere", "");
    cli_fails("font " OWN " -o @/out.c --name 6x10", "6x10", "no name");
    cli_fails("font " OWN " -o @/out.c --range 32-", "--range", "32-");
    cli_fails("font " OWN " -o @/out.c --range 0x65e5", "U+65E5", "no glyph");
    cli_fails("font " OWN " -o @/out.c --range 0x3000-0x3100", "no glyph", "range");
    cli_fails("font " OWN " " OWN " -o @/out.c", "one font at a time", OWN);
    cli_fails("font " OWN " -o @/out.c --size 3", "--size", "unknown");
}

/* ---- tuile render ---- */

/* A pixel of a picture in the folder, 0xrrggbb. */
static uint32_t pixel_of(const char *name, uint32_t x, uint32_t y) {
    sim_picture_t picture;
    sim_error_t error = {""};
    if (sim_picture_read(&picture, cli_path(name), &error) != 0) { fail_msg("%s", error.text); }
    const uint8_t *at = sim_picture_at(&picture, x, y);
    const uint32_t rgb = (uint32_t)at[0] << 16 | (uint32_t)at[1] << 8 | at[2];
    sim_picture_free(&picture);
    return rgb;
}

/* A full stop is two by two dots in columns 1 and 2, rows 6 and 7. */
static void text_stands_where_it_is_asked_for(void **state) {
    (void)state;
    cli_good_silent(CUBE "--overlay-text '3,5,.\\n.' --overlay-text -1,0,. --out @/text.png");
    assert_int_equal(pixel_of("text.png", 4, 11), 0xffffff);
    assert_int_equal(pixel_of("text.png", 5, 12), 0xffffff);
    assert_int_equal(pixel_of("text.png", 4, 22), 0xffffff);
    assert_int_equal(pixel_of("text.png", 0, 7), 0xffffff);
    assert_int_equal(pixel_of("text.png", 2, 7), 0);
    assert_int_equal(pixel_of("text.png", 3, 11), 0);
    assert_int_equal(pixel_of("text.png", 4, 13), 0);
}

static void hash_of(char *hash, size_t size, const char *options) {
    char line[400];
    (void)snprintf(line, sizeof line, CUBE "--hash %s", options);
    char *out = cli_good(line);
    assert_true(strlen(out) < size);
    (void)snprintf(hash, size, "%s", out);
    free(out);
}

static void methods_tiles_and_memory_draw_the_same_overlay(void **state) {
    static const char *const options[] = {"--method scanline", "--method warnock", "--method painter", "--tile 33x7",
                                          "--memory 14K --tile 32x32"};
    char first[64], other[64], line[300];
    (void)state;
    hash_of(first, sizeof first, "--overlay-text '8,8,Hello' --gauge 100,100,40,30 --overlay-fps");
    for (unsigned i = 0; i < CHECK_COUNT(options); i++) {
        (void)snprintf(line, sizeof line, "--overlay-text '8,8,Hello' --gauge 100,100,40,30 --overlay-fps %s", options[i]);
        hash_of(other, sizeof other, line);
        assert_string_equal(first, other);
    }
    hash_of(other, sizeof other, "");
    assert_string_not_equal(first, other);
}

static void fonts_may_be_sources_or_compiled(void **state) {
    char own[64], source[64], compiled[64];
    (void)state;
    cli_good_silent("font " OWN " -o @/own.tuilefont");
    hash_of(own, sizeof own, "--overlay-text 8,8,Text");
    hash_of(source, sizeof source, "--overlay-text 8,8,Text --font " OWN);
    hash_of(compiled, sizeof compiled, "--overlay-text 8,8,Text --font @/own.tuilefont");
    assert_string_equal(own, source);
    assert_string_equal(own, compiled);
}

static void characters_without_a_glyph_are_told(void **state) {
    (void)state;
    char *out = cli_good(CUBE "--overlay-text '8,8,\xe6\x97\xa5 \xff'");
    assert_non_null(strstr(out, "drawn as boxes: 2\n"));
    free(out);
    out = cli_good(CUBE "--overlay-text '8,8,\xc3\xa9'");
    assert_null(strstr(out, "boxes"));
    free(out);
}

/* A picture of the cube over the cube: where it is, its pixels. */
static void images_are_drawn_where_they_are_asked_for(void **state) {
    (void)state;
    cli_good_silent("render @/cube.obj --background 4060ff --out @/image.png");
    cli_good_silent(CUBE "--overlay-image @/image.png" AT "230,310 --out @/both.png");
    assert_int_equal(pixel_of("both.png", 229, 310), 0);
    assert_int_equal(pixel_of("both.png", 230, 309), 0);
    assert_int_equal(pixel_of("both.png", 230, 310), pixel_of("image.png", 0, 0));
}

static void views_and_ids_have_no_overlay(void **state) {
    (void)state;
    cli_good_silent(CUBE "--overlay-text 8,8,Hi --show zbuffer-overdraw --out @/show.png");
    cli_good_silent(CUBE "--overlay-text 8,8,Hi --ids @/with.txt");
    cli_good_silent(CUBE "--ids @/without.txt");
    char *with = command_read(cli_path("with.txt"), NULL), *without = command_read(cli_path("without.txt"), NULL);
    assert_string_equal(with, without);
    free(with);
    free(without);
}

static void wrong_overlays_are_refused(void **state) {
    static const char *const bad[][2] = {
        {"--overlay-text", "8,8"},
        {"--overlay-text", "8,8,"},
        {"--overlay-text", "x,8,a"},
        {"--overlay-text", "8"},
        {"--overlay-text", "8,,a"},
        {"--overlay-text", "40000,0,a"},
        {"--gauge", "1,2,3"},
        {"--gauge", "1,2,3,4"},
        {"--gauge", "1,2,30,4,5"},
        {"--gauge", "1,2,30,4,"},
        {"--gauge", "1,2,2000,4"},
        {"--gauge", "1.5,2,30,4"},
        {"--overlay-image", "x.png"},
        {"--overlay-image", AT "1,2"},
        {"--overlay-image", "x.png" AT "1,2,3"},
        {"--overlay-image", "x.png" AT "1"},
    };
    char line[200];
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        (void)snprintf(line, sizeof line, CUBE "%s %s", bad[i][0], bad[i][1]);
        cli_fails(line, bad[i][0], "wants");
    }
    cli_fails(CUBE "--overlay-image @/nothing.png" AT "1,2", "nothing.png", "No such file");
    cli_fails(CUBE "--overlay-image @/cube.obj" AT "1,2", "cube.obj", "");
    cli_fails(CUBE "--font @/cube.obj --overlay-text 1,1,a", "--font", "STARTFONT");
    cli_put("bad.tuilefont", "TUFNxxxxxxxxxxxxxxxxxxxxxxxxxx");
    cli_fails(CUBE "--font @/bad.tuilefont", "bad.tuilefont", "font");
    cli_fails(CUBE "--overlay-fps=1", "--overlay-fps", "no value");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(font_writes_a_font_that_opens),
        cmocka_unit_test(the_c_source_has_the_same_bytes),
        cmocka_unit_test(font_refuses_what_it_cannot_compile),
        cmocka_unit_test(text_stands_where_it_is_asked_for),
        cmocka_unit_test(methods_tiles_and_memory_draw_the_same_overlay),
        cmocka_unit_test(fonts_may_be_sources_or_compiled),
        cmocka_unit_test(characters_without_a_glyph_are_told),
        cmocka_unit_test(images_are_drawn_where_they_are_asked_for),
        cmocka_unit_test(views_and_ids_have_no_overlay),
        cmocka_unit_test(wrong_overlays_are_refused),
    };
    return cmocka_run_group_tests(tests, cli_set_up, cli_tear_down);
}
