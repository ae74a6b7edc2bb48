/* Fonts and text: characters as they are drawn, UTF-8, lines, numbers; and fonts that are damaged. */
#include "support/check.h"
#include "support/overlay.h"
#include "support/random.h"

#include "../raster/geometry/model.h"
#include "../raster/overlay/font.h"
#include "../sim/font.h"

#define WHITE TUILE_COLOUR(255, 255, 255)

static window_t window;
static uint8_t *font_bytes;
static size_t font_size;
static tuile_font_t font;

static int load(void **state) {
    sim_error_t error = {""};
    (void)state;
    if (font_load(NULL, &font_bytes, &font_size, &error) != 0) { fail_msg("%s", error.text); }
    return tuile_font_open(&font, font_bytes, font_size);
}

static int unload(void **state) {
    (void)state;
    free(font_bytes);
    return 0;
}

/* ---- UTF-8 ---- */

/* Unicode's own example of substitution (chapter 3, table 3-8 of version 15) among them: 61 F1 80 80 E1 80 C2 62 80 63 80 BF 64. */
static void utf8_is_strict(void **state) {
    static const struct {
        const char *text;
        uint32_t codes[14];
    } cases[] = {
        {"a\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80", {'a', 0xe9, 0x20ac, 0x1f600}},
        {"\x7f\xc2\x80\xdf\xbf\xe0\xa0\x80\xef\xbf\xbf\xf0\x90\x80\x80\xf4\x8f\xbf\xbf",
         {0x7f, 0x80, 0x7ff, 0x800, 0xffff, 0x10000, 0x10ffff}},
        {"a\xf1\x80\x80\xe1\x80\xc2"
         "b\x80"
         "c\x80\xbf"
         "d",
         {'a', 0xfffd, 0xfffd, 0xfffd, 'b', 0xfffd, 'c', 0xfffd, 0xfffd, 'd'}},
        {"\xc0\xaf\xe0\x80\xbf", {0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd}}, /* overlong */
        {"\xc1\xbf\xf0\x8f\xbf\xbf", {0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd}},
        {"\xed\xa0\x80\xed\x9f\xbf\xee\x80\x80", {0xfffd, 0xfffd, 0xfffd, 0xd7ff, 0xe000}}, /* a surrogate, and its neighbours */
        {"\xf4\x90\x80\x80\xf5\xff", {0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd}},     /* beyond U+10FFFF */
        {"\xe2\x82", {0xfffd}},                                                             /* cut short */
        {"\xf0\x9f\x98", {0xfffd}},
        {"\xc3", {0xfffd}},
        {"", {0}},
    };
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        const char *at = cases[i].text;
        unsigned k = 0;
        for (; *at; k++) {
            const uint32_t code = tuile_utf8_next(&at);
            if (code != cases[i].codes[k]) { fail_msg("case %u, character %u: U+%04X", i, k, code); }
        }
        assert_int_equal(cases[i].codes[k], 0);
        assert_ptr_equal(at, cases[i].text + strlen(cases[i].text));
        assert_int_equal(tuile_utf8_next(&at), 0);
        assert_ptr_equal(at, cases[i].text + strlen(cases[i].text));
    }
}

/* ---- text as it is drawn ---- */

typedef struct said {
    const char *text;
    int32_t x, y;
    tuile_text_style_t style;
} said_t;

static void draw_text(const void *context, tuile_canvas_t *canvas) {
    const said_t *said = context;
    tuile_text_styled(canvas, &font, said->x, said->y, said->text, &said->style);
}

static void see(const said_t *said, int32_t width, int32_t height, const char *const *rows) {
    window_open(&window, width, height);
    window_draw(&window, 7, 3, draw_text, said);
    assert_true(window_looks(&window, rows));
}

/* As the font was drawn: capitals 7 high on the base line behind row 7, descenders two rows below, accents in rows 0 and 1. */
static void characters_look_as_they_were_drawn(void **state) {
    static const said_t said = {"Ag\xc3\xa9\xc3\x96!", 0, 0, {.colour = WHITE}};
    static const char *const rows[] = {"...............#...#.#......", "..#...........#...........#.",
                                       ".#.#...............###....#.", "#...#..####..###..#...#...#.",
                                       "#...#.#...#.#...#.#...#...#.", "#####.#...#.#####.#...#...#.",
                                       "#...#.#...#.#.....#...#.....", "#...#..####..####..###....#.",
                                       "..........#.................", ".......###.................."};
    (void)state;
    see(&said, 28, 10, rows);
}

static void lines_are_aligned_scaled_and_have_backgrounds(void **state) {
    static const said_t right = {
        "i\n-i", 13, -1, {.colour = WHITE, .background = TUILE_COLOUR(64, 64, 64), .align = TUILE_ALIGN_RIGHT}};
    static const char *const rows[] = {".......44#444", ".......444444", ".......4##444", ".......44#444", ".......44#444",
                                       ".......44#444", ".......4###44", ".......444444", ".......444444", ".444444444444",
                                       ".44444444#444", ".444444444444", ".4444444##444"};
    static const said_t large = {".", -4, -22, {.colour = WHITE, .scale = 4}};
    static const char *const large_rows[] = {"........", "........", "########", "########", "########", "########",
                                             "########", "########", "########", "########", "........"};
    static const said_t centred = {".\n..", 6, -6, {.colour = WHITE, .align = TUILE_ALIGN_CENTRE}};
    static const char *const centred_rows[] = {"....##......", "....##......", "............", "............",
                                               "............", "............", "............", "............",
                                               "............", "............", ".##....##...", ".##....##..."};
    (void)state;
    see(&right, 13, 13, rows);
    see(&large, 8, 11, large_rows);
    see(&centred, 12, 12, centred_rows);
}

/* A box of 5 x 8 dots. Of a surrogate in UTF-8 there are three. */
static void a_character_without_a_glyph_is_a_box_and_counted_once(void **state) {
    static const said_t said = {"\xe6\x97\xa5", 1, 1, {.colour = WHITE}};
    static const char *const rows[] = {".......", ".#####.", ".#...#.", ".#...#.", ".#...#.",
                                       ".#...#.", ".#...#.", ".#...#.", ".#####.", "......."};
    static const said_t broken = {"\xed\xa0\x80", 0, 0, {.colour = WHITE}};
    static const said_t outside = {"\xe6\x97\xa5", 40, 0, {.colour = WHITE}}, half = {"\xe6\x97\xa5", -2, -3, {.colour = WHITE}};
    static const int32_t sizes[][2] = {{1, 1}, {3, 2}, {30, 30}};
    (void)state;
    see(&said, 7, 10, rows);
    for (unsigned i = 0; i < CHECK_COUNT(sizes); i++) {
        window_open(&window, 30, 30);
        window_draw(&window, sizes[i][0], sizes[i][1], draw_text, &said);
        assert_int_equal(window.glyphs_missing, 1);
        window_draw(&window, sizes[i][0], sizes[i][1], draw_text, &half);
        assert_int_equal(window.glyphs_missing, 2);
        window_draw(&window, sizes[i][0], sizes[i][1], draw_text, &outside);
        assert_int_equal(window.glyphs_missing, 2);
        window_draw(&window, sizes[i][0], sizes[i][1], draw_text, &broken);
        assert_int_equal(window.glyphs_missing, 5);
    }
}

static void text_is_as_wide_as_its_widest_line(void **state) {
    (void)state;
    assert_int_equal(tuile_text_width(&font, ""), 0);
    assert_int_equal(tuile_text_width(&font, "abc"), 18);
    assert_int_equal(tuile_text_width(&font, "a\n\xc3\xa9\xe2\x82\xac\xe6\x97\xa5\nbc"), 18);
    assert_int_equal(tuile_text_width(&font, "\n"), 0);
}

static void text_anywhere_is_the_same_in_any_tiles(void **state) {
    static const int32_t places[] = {INT32_MIN, INT32_MIN + 5, -260, -20, -3, 0, 9, 47, 300, INT32_MAX - 4, INT32_MAX};
    static window_t tiled;
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(places) * CHECK_COUNT(places) * 9; i++) {
        const said_t said = {
            "Ty\xc3\xa9\n\xe6\x97\xa5 (1)\n\nX",
            places[i / 9 % CHECK_COUNT(places)],
            places[i / 9 / CHECK_COUNT(places)],
            {WHITE, TUILE_ARGB(i % 256, 9, 99, 200), (uint8_t)(i % 3), (uint8_t)(i / 3 % 3 == 2 ? 255 : i / 3 % 3)}};
        window_open(&window, 48, 33);
        window.shift = i % 2;
        tiled = window;
        window_draw(&window, 48, 33, draw_text, &said);
        window_draw(&tiled, 11, 7, draw_text, &said);
        assert_memory_equal(window.samples, tiled.samples, sizeof window.samples);
        assert_int_equal(window.glyphs_missing, tiled.glyphs_missing);
    }
}

/* Lines of 2 dots; "a" is a column of 3 dots that ends 4 above the line, "b" one that begins 4 below it. */
static void glyphs_may_reach_out_of_their_lines(void **state) {
    static const char text[] = "STARTFONT 2.1\nFONT_ASCENT 2\nFONT_DESCENT 0\n"
                               "STARTCHAR a\nENCODING 97\nDWIDTH 2 0\nBBX 1 3 0 6\nBITMAP\n80\n80\n80\nENDCHAR\n"
                               "STARTCHAR b\nENCODING 98\nDWIDTH 2 0\nBBX 1 3 0 -7\nBITMAP\n80\n80\n80\nENDCHAR\nENDFONT\n";
    static const said_t said = {"ab", 0, 7, {.colour = WHITE}};
    static const char *const rows[] = {"#...", "#...", "#...", "....", "....", "....", "....", "....",
                                       "....", "....", "....", "....", "....", "..#.", "..#.", "..#."};
    const tuile_font_t kept = font;
    font_source_t source;
    uint8_t *bytes;
    size_t size;
    (void)state;
    assert_int_equal(font_bdf_parse(&source, text, sizeof text - 1, "tall", NULL), 0);
    assert_int_equal(font_compile(&source, NULL, 0, &bytes, &size, NULL, NULL), 0);
    font_source_free(&source);
    assert_int_equal(tuile_font_open(&font, bytes, size), 0);
    see(&said, 4, 16, rows);
    font = kept;
    free(bytes);
}

/* ---- numbers ---- */

static void numbers_are_written_with_their_point(void **state) {
    static const struct {
        int32_t value;
        unsigned decimals;
        const char *text;
    } cases[] = {{0, 0, "0"},
                 {7, 0, "7"},
                 {-7, 0, "-7"},
                 {375, 1, "37.5"},
                 {-5, 2, "-0.05"},
                 {0, 3, "0.000"},
                 {1000, 3, "1.000"},
                 {INT32_MAX, 0, "2147483647"},
                 {INT32_MIN, 0, "-2147483648"},
                 {INT32_MIN, 9, "-2.147483648"},
                 {-1, 9, "-0.000000001"},
                 {1, 200, "0.000000001"}};
    char text[TUILE_DECIMAL_BYTES];
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        tuile_decimal(text, cases[i].value, cases[i].decimals);
        assert_string_equal(text, cases[i].text);
    }
}

/* An eighth of the way each time: from 10 ms to 18 ms it is 11 ms after one frame. Thousandths of a frame a second as drawn: the
 * text is compared with the same words drawn as they are. */
static void frames_a_second_follow_slowly(void **state) {
    tuile_fps_t fps = {0};
    (void)state;
    tuile_fps_frame(&fps, 10000);
    assert_int_equal(fps.mean_us, 160000);
    tuile_fps_frame(&fps, 18000);
    assert_int_equal(fps.mean_us, 176000);
    tuile_fps_frame(&fps, UINT32_MAX);
    assert_int_equal(fps.mean_us, (176000u * 7 + 160000000u + 4) / 8);
    for (unsigned i = 0; i < 1000; i++) {
        tuile_fps_frame(&fps, UINT32_MAX);
    }
    assert_in_range(fps.mean_us, 159999990, 160000000);
    fps = (tuile_fps_t){0};
    tuile_fps_frame(&fps, 0);
    assert_int_equal(fps.mean_us, 16);
}

static void draw_fps(const void *context, tuile_canvas_t *canvas) { tuile_text_fps(canvas, &font, 0, 0, WHITE, context); }

static void the_counter_says_frames_a_second(void **state) {
    static const struct {
        uint32_t frame_us;
        const char *text;
    } cases[] = {{0, "--.- fps"}, {26667, "37.5 fps"}, {1000000, "1.0 fps"}, {1, "1000000.0 fps"}, {10000000, "0.1 fps"}};
    static window_t expected;
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        const said_t said = {cases[i].text, 0, 0, {.colour = WHITE}};
        tuile_fps_t fps = {0};
        if (cases[i].frame_us) { tuile_fps_frame(&fps, cases[i].frame_us); }
        window_open(&window, 96, 10);
        window_open(&expected, 96, 10);
        window_draw(&window, 96, 10, draw_fps, &fps);
        window_draw(&expected, 96, 10, draw_text, &said);
        assert_memory_equal(window.samples, expected.samples, sizeof window.samples);
    }
}

/* ---- damage ---- */

/* True when the bytes open; then every glyph is drawn, and a few that are not there. */
static bool try_font(const uint8_t *bytes, size_t size) {
    tuile_font_t opened;
    uint8_t *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    const int result = tuile_font_open(&opened, copy, size);
    assert_true(result == TUILE_OK || result == TUILE_ERROR_FONT);
    if (result == TUILE_OK) {
        const tuile_font_t kept = font;
        font = opened;
        for (unsigned i = 0; i < 24; i++) {
            const said_t said = {i % 2 ? "!\"#$%&'()*" : "\xc3\xa9\x7f",
                                 (int32_t)i * 7 - 60,
                                 (int32_t)i * 5 - 50,
                                 {.colour = WHITE, .background = WHITE / 3}};
            window_open(&window, 16, 12);
            window_draw(&window, 16, 12, draw_text, &said);
        }
        font = kept;
    }
    free(copy);
    return result == TUILE_OK;
}

static void put_right(uint8_t *bytes, size_t size) {
    for (unsigned i = 0; size >= FONT_HEADER_BYTES && i < 4; i++) {
        bytes[FONT_AT_SIZE + i] = (uint8_t)(size >> 8 * i);
    }
    const uint32_t crc = size >= FONT_HEADER_BYTES ? model_crc32(0, bytes + FONT_AT_VERSION, size - FONT_AT_VERSION) : 0;
    for (unsigned i = 0; size >= FONT_HEADER_BYTES && i < 4; i++) {
        bytes[FONT_AT_CRC32 + i] = (uint8_t)(crc >> 8 * i);
    }
}

static void damaged_fonts_are_refused_or_drawn_without_harm(void **state) {
    static const font_range_t some[] = {{'!', '*'}, {0xe9, 0xe9}};
    font_source_t source;
    uint8_t *bytes, *copy;
    size_t size;
    unsigned opened = 0, refused = 0;
    random_source_t random = random_seed(3);
    (void)state;
    assert_int_equal(font_bdf_parse(&source, font_default_text, (size_t)(font_default_end - font_default_text), "own", NULL), 0);
    assert_int_equal(font_compile(&source, some, 2, &bytes, &size, NULL, NULL), 0);
    font_source_free(&source);
    assert_true(try_font(bytes, size));
    copy = malloc(size + 4);
    assert_non_null(copy);
    for (size_t at = 0; at < size; at++) {
        for (unsigned bit = 0; bit < 9; bit++) {
            memcpy(copy, bytes, size);
            copy[at] = (uint8_t)(bit == 8 ? 255u - copy[at] : copy[at] ^ 1u << bit);
            if (try_font(copy, size)) { fail_msg("byte %zu, bit %u: not noticed", at, bit); }
            put_right(copy, size);
            if (at >= FONT_AT_CRC32 && at < FONT_AT_VERSION) { continue; }
            *(try_font(copy, size) ? &opened : &refused) += 1;
        }
    }
    for (size_t length = 0; length <= size + 4; length++) {
        memset(copy, 0, size + 4);
        memcpy(copy, bytes, length < size ? length : size);
        if (length != size) { assert_false(try_font(copy, length)); }
        put_right(copy, length);
        (void)try_font(copy, length);
    }
    for (int round = 0; round < CHECK_ROUNDS(8000); round++) {
        memcpy(copy, bytes, size);
        for (int32_t n = random_between(&random, 1, 6); n > 0; n--) {
            copy[random_between(&random, FONT_AT_GLYPHS, round % 2 ? 180 : (int32_t)size - 1)] =
                (uint8_t)random_between(&random, 0, 255);
        }
        put_right(copy, size);
        *(try_font(copy, size) ? &opened : &refused) += 1;
    }
    assert_true(opened > 400 && refused > 400);
    free(copy);
    free(bytes);
}

/* Each rule by itself, with the check sum right. The first glyph is '!', 1 x 7 dots; the second one '"'. */
static void fonts_that_break_a_rule_are_refused(void **state) {
    enum { FIRST = FONT_HEADER_BYTES, SECOND = FONT_HEADER_BYTES + FONT_GLYPH_BYTES };
    static const struct {
        unsigned at;
        uint8_t value;
    } rules[] = {
        {FONT_AT_MAGIC, 'X'},
        {FONT_AT_VERSION, 2},
        {FONT_AT_GLYPHS, 0},
        {FONT_AT_GLYPHS, 99},
        {FONT_AT_HEIGHT, 0},
        {FONT_AT_HEIGHT, 128},
        {FONT_AT_ASCENT, 11},
        {FONT_AT_ADVANCE, 0},
        {FONT_AT_ZERO, 1},
        {FONT_AT_BITS, 1},
        {SECOND, '!'},
        {SECOND, ' '},
        {SECOND + 2, 0x11},
        {SECOND + 1, 0xd8},
        {SECOND + 1, 0xdf},
        {SECOND + 2, 0x20},
        {FIRST + GLYPH_AT_WIDTH, 128},
        {FIRST + GLYPH_AT_HEIGHT, 128},
        {FIRST + GLYPH_AT_WIDTH, 0},
        {FIRST + GLYPH_AT_HEIGHT, 0},
        {FIRST + GLYPH_AT_BITS + 1, 1},
        {FIRST + GLYPH_AT_BITS + 3, 0x80},
        {FIRST + GLYPH_AT_WIDTH, 127},
    };
    static const font_range_t two[] = {{'!', '"'}};
    font_source_t source;
    uint8_t *bytes;
    _Alignas(4) uint8_t copy[256];
    size_t size;
    (void)state;
    assert_int_equal(font_bdf_parse(&source, font_default_text, (size_t)(font_default_end - font_default_text), "own", NULL), 0);
    assert_int_equal(font_compile(&source, two, 1, &bytes, &size, NULL, NULL), 0);
    font_source_free(&source);
    assert_in_range(size, FONT_HEADER_BYTES + 2 * FONT_GLYPH_BYTES + 2, sizeof copy);
    for (unsigned i = 0; i < CHECK_COUNT(rules); i++) {
        tuile_font_t opened;
        memcpy(copy, bytes, size);
        put_right(copy, size);
        assert_int_equal(tuile_font_open(&opened, copy, size), 0);
        copy[rules[i].at] = rules[i].value;
        put_right(copy, size);
        if (tuile_font_open(&opened, copy, size) != TUILE_ERROR_FONT) { fail_msg("rule %u", i); }
    }
    free(bytes);
}

static void what_cannot_be_opened_is_an_argument_error(void **state) {
    tuile_font_t opened;
    (void)state;
    assert_int_equal(tuile_font_open(NULL, font_bytes, font_size), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_font_open(&opened, NULL, font_size), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_font_open(&opened, font_bytes + 1, font_size - 1), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_font_open(&opened, font_bytes, 0), TUILE_ERROR_FONT);
}

/* ASCII and Latin-1 are all there, each 6 wide, and no two that people tell apart look the same. */
static void the_own_font_has_latin_1(void **state) {
    (void)state;
    assert_int_equal(font.height, 10);
    assert_int_equal(font.ascent, 8);
    for (uint32_t code = 32; code < 256; code++) {
        if (code >= 127 && code < 160) { continue; }
        const uint8_t *glyph = font_glyph(&font, code);
        assert_non_null(glyph);
        assert_int_equal(font_advance(&font, code), 6);
        for (uint32_t other = 32; other < code; other++) {
            const uint8_t *before = font_glyph(&font, other);
            if (!before || (code == 0xa0 && other == 32) || (code == 0xad && other == '-')) { continue; }
            const bool same_box = memcmp(glyph + GLYPH_AT_LEFT, before + GLYPH_AT_LEFT, 4) == 0;
            const size_t bytes = GLYPH_BIT_BYTES(glyph[GLYPH_AT_WIDTH], glyph[GLYPH_AT_HEIGHT]);
            if (same_box &&
                memcmp(font.bits + model_u32(glyph + GLYPH_AT_BITS), font.bits + model_u32(before + GLYPH_AT_BITS), bytes) == 0) {
                fail_msg("U+%04X looks like U+%04X", code, other);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(utf8_is_strict),
        cmocka_unit_test(characters_look_as_they_were_drawn),
        cmocka_unit_test(lines_are_aligned_scaled_and_have_backgrounds),
        cmocka_unit_test(a_character_without_a_glyph_is_a_box_and_counted_once),
        cmocka_unit_test(text_is_as_wide_as_its_widest_line),
        cmocka_unit_test(text_anywhere_is_the_same_in_any_tiles),
        cmocka_unit_test(glyphs_may_reach_out_of_their_lines),
        cmocka_unit_test(numbers_are_written_with_their_point),
        cmocka_unit_test(frames_a_second_follow_slowly),
        cmocka_unit_test(the_counter_says_frames_a_second),
        cmocka_unit_test(damaged_fonts_are_refused_or_drawn_without_harm),
        cmocka_unit_test(fonts_that_break_a_rule_are_refused),
        cmocka_unit_test(what_cannot_be_opened_is_an_argument_error),
        cmocka_unit_test(the_own_font_has_latin_1),
    };
    return cmocka_run_group_tests(tests, load, unload);
}
