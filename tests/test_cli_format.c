/* tuile render --format, --dither, --aa and --size: what goes to the panel and what is decoded without one. */
#include "support/check.h"
#include "support/cli.h"

#include "../sim/picture.h"
#include "../sim/wire.h"

#include <unistd.h>

/* ---- the decoder, by hand ------------------------------------------------------------------------------------- */

/* A row of `width` pixels, their bytes, and what is seen of each as 0xrrggbb. */
static struct {
    uint8_t format;
    uint16_t width;
    uint8_t bytes[8];
    unsigned size_bytes;
    uint32_t rgb[10];
} rows[] = {
    /* Five bits become six, then eight, their upper ones repeated: 16 -> 33 -> 134, 32 of six -> 130. */
    {TUILE_RGB565_BE, 3, {0xf8, 0x00, 0x84, 0x10, 0xff, 0xff}, 6, {0xff0000, 0x868286, 0xffffff}},
    {TUILE_RGB565_LE, 3, {0x00, 0xf8, 0x10, 0x84, 0xff, 0xff}, 6, {0xff0000, 0x868286, 0xffffff}},
    {TUILE_RGB444, 3, {0x12, 0x34, 0x5f, 0x0a, 0x80}, 5, {0x112233, 0x4455ff, 0x00aa88}},
    {TUILE_RGB666, 2, {0xfc, 0x00, 0x80, 0x04, 0x40, 0xfc}, 6, {0xff0082, 0x0441ff}},
    /* Three bits 5 = 101: 10110110; two bits 2: 10101010. */
    {TUILE_RGB332, 3, {0xe0, 0xb6, 0x03}, 3, {0xff0000, 0xb6b6aa, 0x0000ff}},
    {TUILE_GREY8, 3, {0, 0x7b, 255}, 3, {0, 0x7b7b7b, 0xffffff}},
    {TUILE_GREY4, 3, {0x1f, 0x80}, 2, {0x111111, 0xffffff, 0x888888}},
    {TUILE_MONO_ROWS, 10, {0x81, 0x40}, 2, {0xffffff, 0, 0, 0, 0, 0, 0, 0xffffff, 0, 0xffffff}},
    {TUILE_MONO_PAGES, 3, {0x01, 0xfe, 0x81}, 3, {0xffffff, 0, 0xffffff}},
    {TUILE_MONO_PAGES_TURNED, 10, {0x81, 0x02}, 2, {0xffffff, 0, 0, 0, 0, 0, 0, 0xffffff, 0, 0xffffff}},
    {TUILE_GREY4_TURNED, 3, {0x10, 0xf0, 0x80}, 3, {0x111111, 0xffffff, 0x888888}},
    {TUILE_RGB111, 5, {0x22, 0x0f, 0x18}, 3, {0xff0000, 0x00ff00, 0x0000ff, 0xffffff, 0x00ffff}},
    {TUILE_XRGB1111, 3, {0x46, 0x50}, 2, {0xff0000, 0xffff00, 0xff00ff}},
    {TUILE_BGR888, 2, {0x56, 0x34, 0x12, 0xef, 0xcd, 0xab}, 6, {0x123456, 0xabcdef}},
    {TUILE_XRGB8888, 2, {0x56, 0x34, 0x12, 0x00, 0xef, 0xcd, 0xab, 0x00}, 8, {0x123456, 0xabcdef}},
};

static void the_decoder_reads_what_is_on_the_wire(void **state) {
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(rows); i++) {
        sim_picture_t picture = {0};
        tuile_tile_t tile = {.width = rows[i].width, .height = 1, .bytes = rows[i].bytes, .size_bytes = rows[i].size_bytes};
        assert_int_equal(sim_picture_create(&picture, rows[i].width, 1, NULL), 0);
        assert_int_equal(wire_paste(&picture, rows[i].format, &tile, NULL), 0);
        for (unsigned x = 0; x < rows[i].width; x++) {
            const uint8_t *p = sim_picture_at(&picture, x, 0);
            const uint32_t rgb = (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
            if (rgb != rows[i].rgb[x]) { fail_msg("row %u, pixel %u: %06x", i, x, rgb); }
        }
        tile.size_bytes++;
        assert_int_equal(wire_paste(&picture, rows[i].format, &tile, NULL), -1);
        tile.size_bytes--;
        tile.x = 1;
        assert_int_equal(wire_paste(&picture, rows[i].format, &tile, NULL), -1); /* out of the picture */
        sim_picture_free(&picture);
    }
}

static void pages_are_read_downwards_from_bit_0(void **state) {
    static uint8_t bytes[] = {0x05, 0x80, 0x01, 0x00};
    const tuile_tile_t tile = {.width = 2, .height = 9, .bytes = bytes, .size_bytes = 4};
    sim_picture_t picture = {0};
    (void)state;
    assert_int_equal(sim_picture_create(&picture, 2, 9, NULL), 0);
    assert_int_equal(wire_paste(&picture, TUILE_MONO_PAGES, &tile, NULL), 0);
    for (unsigned y = 0; y < 9; y++) {
        assert_int_equal(*sim_picture_at(&picture, 0, y), y == 0 || y == 2 || y == 8 ? 255 : 0);
        assert_int_equal(*sim_picture_at(&picture, 1, y), y == 7 ? 255 : 0);
    }
    sim_picture_free(&picture);
}

static void turned_pages_are_read_to_the_right_from_bit_0(void **state) {
    static uint8_t bytes[] = {0x05, 0x80, 0x01, 0x00};
    const tuile_tile_t tile = {.width = 9, .height = 2, .bytes = bytes, .size_bytes = 4};
    sim_picture_t picture = {0};
    (void)state;
    assert_int_equal(sim_picture_create(&picture, 9, 2, NULL), 0);
    assert_int_equal(wire_paste(&picture, TUILE_MONO_PAGES_TURNED, &tile, NULL), 0);
    for (unsigned x = 0; x < 9; x++) {
        assert_int_equal(*sim_picture_at(&picture, x, 0), x == 0 || x == 2 || x == 8 ? 255 : 0);
        assert_int_equal(*sim_picture_at(&picture, x, 1), x == 7 ? 255 : 0);
    }
    sim_picture_free(&picture);
}

static void turned_greys_are_read_downwards_from_the_high_half(void **state) {
    static uint8_t bytes[] = {0x13, 0x50, 0x24, 0x60};
    const tuile_tile_t tile = {.width = 2, .height = 3, .bytes = bytes, .size_bytes = 4};
    sim_picture_t picture = {0};
    (void)state;
    assert_int_equal(sim_picture_create(&picture, 2, 3, NULL), 0);
    assert_int_equal(wire_paste(&picture, TUILE_GREY4_TURNED, &tile, NULL), 0);
    for (unsigned i = 0; i < 6; i++) {
        assert_int_equal(*sim_picture_at(&picture, i % 2, i / 2), 0x11 * (i + 1));
    }
    sim_picture_free(&picture);
}

static void rows_of_rgb111_are_one_string_and_of_xrgb1111_are_not(void **state) {
    static uint8_t bytes[] = {0x0a, 0x1c, 0x26, 0x00}; /* 001 010, 011 100, 100 110; rows of nibbles: 0 a 1, 2 6 0 */
    const tuile_tile_t tile = {.width = 3, .height = 2, .bytes = bytes, .size_bytes = 3},
                       whole = {.width = 3, .height = 2, .bytes = bytes, .size_bytes = 4};
    static const uint32_t string[] = {0x0000ff, 0x00ff00, 0x00ffff, 0xff0000, 0xff0000, 0xffff00},
                          rows_of[] = {0x000000, 0x00ff00, 0x0000ff, 0x00ff00, 0xffff00, 0x000000};
    (void)state;
    for (unsigned k = 0; k < 2; k++) {
        sim_picture_t picture = {0};
        assert_int_equal(sim_picture_create(&picture, 3, 2, NULL), 0);
        assert_int_equal(wire_paste(&picture, k ? TUILE_XRGB1111 : TUILE_RGB111, k ? &whole : &tile, NULL), 0);
        for (unsigned i = 0; i < 6; i++) {
            const uint8_t *p = sim_picture_at(&picture, i % 3, i / 3);
            assert_int_equal((uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2], k ? rows_of[i] : string[i]);
        }
        sim_picture_free(&picture);
    }
}

static void a_tile_that_begins_within_a_byte_is_refused(void **state) {
    static const struct {
        uint8_t format;
        uint16_t x, y;
        unsigned size_bytes; /* of 8x8 pixels */
        int result;
    } tiles[] = {
        {TUILE_MONO_PAGES_TURNED, 4, 0, 8, -1},
        {TUILE_MONO_PAGES_TURNED, 8, 1, 8, 0},
        {TUILE_MONO_PAGES, 8, 1, 8, -1},
        {TUILE_MONO_PAGES, 4, 8, 8, 0},
        {TUILE_GREY4_TURNED, 0, 1, 32, -1},
        {TUILE_GREY4_TURNED, 1, 2, 32, 0},
        {TUILE_GREY4, 1, 0, 32, -1},
        {TUILE_RGB111, 1, 0, 32, -1},
        {TUILE_RGB111, 2, 1, 32, 0},
        {TUILE_XRGB1111, 3, 0, 32, -1},
        {TUILE_XRGB1111, 2, 1, 32, 0},
        {TUILE_BGR888, 1, 1, 192, 0},
        {TUILE_XRGB8888, 1, 1, 256, 0},
    };
    static uint8_t bytes[256];
    sim_picture_t picture = {0};
    (void)state;
    assert_int_equal(sim_picture_create(&picture, 16, 16, NULL), 0);
    for (unsigned i = 0; i < CHECK_COUNT(tiles); i++) {
        const tuile_tile_t tile = {tiles[i].x, tiles[i].y, 8, 8, bytes, tiles[i].size_bytes};
        if (wire_paste(&picture, tiles[i].format, &tile, NULL) != tiles[i].result) { fail_msg("tile %u", i); }
    }
    sim_picture_free(&picture);
}

/* ---- the program ---------------------------------------------------------------------------------------------- */

/* The hash of one frame of a model of two colours. */
static void hash_of(char *hash, size_t size, const char *arguments) {
    char line[256];
    (void)snprintf(line, sizeof line, "render @/octahedron.obj --hash --background 804020 %s", arguments);
    char *out = cli_good(line);
    assert_true(strlen(out) < size);
    (void)snprintf(hash, size, "%s", out);
    free(out);
}

static void the_decoder_shows_what_the_panel_shows(void **state) {
    static const char *const options[] = {
        "",         "--rotate 90",          "--rotate 180 --shade gouraud", "--rotate 270 --tile 50x24",
        "--aa 2x2", "--aa 4x4 --rotate 90", "--dither --shade gouraud",     "--dither --aa 2x2 --memory 64K"};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(options); i++) {
        char line[160], panel[64], decoded[64];
        hash_of(panel, sizeof panel, options[i]);
        (void)snprintf(line, sizeof line, "--format rgb565le %s", options[i]);
        hash_of(decoded, sizeof decoded, line);
        if (strcmp(panel, decoded) != 0) { fail_msg("%s", options[i]); }
    }
}

/* Every option makes another picture, and the same one in any memory and tiles. */
static void every_format_has_a_picture_of_its_own(void **state) {
    static const char *const formats[] = {"rgb565be", "rgb444",     "rgb666", "rgb332", "grey8",
                                          "grey4",    "mono-pages", "rgb111", "bgr888"};
    static const char *const same[][2] = {{"mono-rows", "mono-pages"},
                                          {"mono-pages-turned", "mono-pages"},
                                          {"grey4-turned", "grey4"},
                                          {"xrgb1111", "rgb111"},
                                          {"xrgb8888", "bgr888"}};
    char hashes[CHECK_COUNT(formats)][64], other[64], line[160];
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(formats); i++) {
        (void)snprintf(line, sizeof line, "--shade gouraud --format %s", formats[i]);
        hash_of(hashes[i], sizeof hashes[i], line);
        for (unsigned k = 0; k < i; k++) {
            assert_string_not_equal(hashes[i], hashes[k]);
        }
        (void)snprintf(line, sizeof line, "--shade gouraud --format %s --method scanline --memory 64K --tile 80x16", formats[i]);
        hash_of(other, sizeof other, line);
        assert_string_equal(hashes[i], other);
    }
    for (unsigned i = 0; i < CHECK_COUNT(same); i++) {
        char hash[64];
        (void)snprintf(line, sizeof line, "--shade gouraud --format %s", same[i][0]);
        hash_of(other, sizeof other, line);
        (void)snprintf(line, sizeof line, "--shade gouraud --format %s", same[i][1]);
        hash_of(hash, sizeof hash, line);
        assert_string_equal(hash, other);
    }
}

static void bytes_on_the_wire_are_the_formats(void **state) {
    static const struct {
        const char *format;
        unsigned bytes; /* of 240x320 pixels */
    } formats[] = {
        {"rgb565le", 153600}, {"rgb444", 115200},   {"rgb666", 230400},  {"rgb332", 76800},           {"grey8", 76800},
        {"grey4", 38400},     {"mono-pages", 9600}, {"mono-rows", 9600}, {"mono-pages-turned", 9600}, {"grey4-turned", 38400},
        {"rgb111", 38400},    {"xrgb1111", 38400},  {"bgr888", 230400},  {"xrgb8888", 307200}};
    char line[160];
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(formats); i++) {
        (void)snprintf(line, sizeof line, "render @/cube.obj --format %s --report @/report.json", formats[i].format);
        cli_good_silent(line);
        char *report = command_read(cli_path("report.json"), NULL);
        assert_int_equal(cli_number_after(report, "\"wire_bytes\": "), formats[i].bytes);
        assert_non_null(strstr(report, formats[i].format));
        free(report);
    }
    (void)unlink(cli_path("report.json"));
}

/* One tile of 129x61 pixels: in one string, rows of 65 or 17 bytes, columns of 31, 8 pages of 129, 17 turned ones of 61. */
static void sides_that_are_odd_tell_strings_rows_and_columns_apart(void **state) {
    static const struct {
        const char *format;
        unsigned bytes;
    } formats[] = {{"rgb444", 11804},      {"grey4", 65 * 61},         {"mono-pages", 8 * 129},
                   {"mono-rows", 17 * 61}, {"grey4-turned", 31 * 129}, {"mono-pages-turned", 17 * 61},
                   {"rgb111", 3935},       {"xrgb1111", 65 * 61}};
    char line[160];
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(formats); i++) {
        (void)snprintf(line, sizeof line, "render @/cube.obj --format %s --size 129x61 --tile 129x61 --report @/report.json",
                       formats[i].format);
        cli_good_silent(line);
        char *report = command_read(cli_path("report.json"), NULL);
        assert_int_equal(cli_number_after(report, "\"wire_bytes\": "), formats[i].bytes);
        free(report);
    }
    (void)unlink(cli_path("report.json"));
}

static void a_window_may_have_another_size(void **state) {
    sim_picture_t picture = {0};
    (void)state;
    cli_good_silent("render @/torus.obj --format mono-pages --size 129x61 --out @/dots.png --sheet @/sheet.png");
    assert_int_equal(sim_picture_read(&picture, cli_path("dots.png"), NULL), 0);
    assert_int_equal(picture.width, 129);
    assert_int_equal(picture.height, 61);
    unsigned white = 0;
    for (size_t i = 0; i < (size_t)3 * 129 * 61; i++) {
        assert_true(picture.rgb[i] == 0 || picture.rgb[i] == 255);
        white += picture.rgb[i] != 0;
    }
    assert_in_range(white, 300, 3 * 129 * 61 / 2);
    sim_picture_free(&picture);
    cli_good_silent("render @/torus.obj --format grey4 --size 129x61 --rotate 90 --out @/dots.png");
    assert_int_equal(sim_picture_read(&picture, cli_path("dots.png"), NULL), 0);
    assert_int_equal(picture.width, 61);
    assert_int_equal(picture.height, 129);
    sim_picture_free(&picture);
    (void)unlink(cli_path("dots.png"));
    (void)unlink(cli_path("sheet.png"));
}

static void ids_pick_and_show_do_not_mind_the_format(void **state) {
    (void)state;
    char *plain = cli_good("render @/torus.obj --pick 120,100 --ids @/ids.txt"), *ids = command_read(cli_path("ids.txt"), NULL);
    char *other = cli_good("render @/torus.obj --pick 120,100 --ids @/ids.txt --format grey4 --dither --aa 2x2"),
         *same = command_read(cli_path("ids.txt"), NULL);
    assert_string_equal(plain, other);
    assert_string_equal(ids, same);
    cli_good_silent("render @/cube.obj --format mono-rows --aa 2x2 --show zbuffer-tiles --out @/show.png");
    free(plain);
    free(ids);
    free(other);
    free(same);
    (void)unlink(cli_path("ids.txt"));
    (void)unlink(cli_path("show.png"));
}

static void what_does_not_go_together_is_refused(void **state) {
    (void)state;
    cli_fails("render @/cube.obj --format rgb888", "--format", "mono-pages");
    cli_fails("render @/cube.obj --aa 3x3", "--aa", "2x2");
    cli_fails("render @/cube.obj --aa 8", "--aa", "4x4");
    cli_fails("render @/cube.obj --dither=on", "--dither", "value");
    cli_fails("render @/cube.obj --size 100", "--size", "WIDTHxHEIGHT");
    cli_fails("render @/cube.obj --size 100x100", "--size", "--format");
    cli_fails("render @/cube.obj --format grey8 --size 1000x20 --aa 2x2", "--aa 2x2", "960");
    cli_fails("render @/cube.obj --format grey8 --size 20x481 --aa 4x4", "--aa 4x4", "480");
    cli_fails("render @/cube.obj --format mono-pages --tile 240x12", "--tile 240x12", "multiple of 8");
    cli_fails("render @/cube.obj --format mono-rows --tile 12x8", "--tile 12x8", "multiple of 8");
    cli_fails("render @/cube.obj --format rgb444 --tile 15x8", "--tile 15x8", "multiple of 2");
    cli_fails("render @/cube.obj --format grey4 --tile 1x8", "--tile 1x8", "multiple of 2");
    cli_fails("render @/cube.obj --format mono-pages-turned --tile 12x8", "--tile 12x8", "multiple of 8");
    cli_fails("render @/cube.obj --format grey4-turned --tile 240x5", "--tile 240x5", "multiple of 2");
    cli_fails("render @/cube.obj --format rgb111 --tile 15x8", "--tile 15x8", "multiple of 2");
    cli_fails("render @/cube.obj --format xrgb1111 --tile 15x8", "--tile 15x8", "multiple of 2");
    cli_fails("render @/cube.obj --format grey8 --memory 2K", "--memory", "at least");
}

static void help_names_the_options(void **state) {
    static const char *const options[] = {"--format",          "--dither",     "--aa",   "--size",   "rgb332", "mono-rows",
                                          "mono-pages-turned", "grey4-turned", "rgb111", "xrgb1111", "bgr888", "xrgb8888"};
    char *out = cli_good("render --help");
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(options); i++) {
        assert_non_null(strstr(out, options[i]));
    }
    free(out);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_decoder_reads_what_is_on_the_wire),
        cmocka_unit_test(pages_are_read_downwards_from_bit_0),
        cmocka_unit_test(turned_pages_are_read_to_the_right_from_bit_0),
        cmocka_unit_test(turned_greys_are_read_downwards_from_the_high_half),
        cmocka_unit_test(rows_of_rgb111_are_one_string_and_of_xrgb1111_are_not),
        cmocka_unit_test(a_tile_that_begins_within_a_byte_is_refused),
        cmocka_unit_test(the_decoder_shows_what_the_panel_shows),
        cmocka_unit_test(every_format_has_a_picture_of_its_own),
        cmocka_unit_test(bytes_on_the_wire_are_the_formats),
        cmocka_unit_test(sides_that_are_odd_tell_strings_rows_and_columns_apart),
        cmocka_unit_test(a_window_may_have_another_size),
        cmocka_unit_test(ids_pick_and_show_do_not_mind_the_format),
        cmocka_unit_test(what_does_not_go_together_is_refused),
        cmocka_unit_test(help_names_the_options),
    };
    return cmocka_run_group_tests_name("cli_format", tests, cli_set_up, cli_tear_down);
}
