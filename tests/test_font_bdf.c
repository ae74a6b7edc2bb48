/* BDF: what is read of it, and how broken files are refused, each by the line that is wrong. */
#include "support/check.h"
#include "support/random.h"

#include "../raster/geometry/model.h"
#include "../raster/overlay/font.h"
#include "../sim/font.h"

/* Line 12 begins the first glyph, line 21 the second one. */
#define HEAD                     \
    "STARTFONT 2.1\n"            \
    "COMMENT ENDFONT\n"          \
    "FONT any\n"                 \
    "SIZE 8 75 75\n"             \
    "FONTBOUNDINGBOX 9 4 0 -1\n" \
    "STARTPROPERTIES 3\n"        \
    "FONT_ASCENT 3\n"            \
    "FONT_DESCENT 2\n"           \
    "FOUNDRY \"BITMAP of\"\n"    \
    "ENDPROPERTIES\n"            \
    "CHARS 2\n"
#define FIRST "STARTCHAR wide\nENCODING 300\nSWIDTH 1 0\nDWIDTH 10 0\nBBX 9 2 -1 0\nBITMAP\n4080\n0100\nENDCHAR\n"
#define SECOND "STARTCHAR one\nENCODING 65\nDWIDTH 3 0\nBBX 3 3 0 -1\nBITMAP\n00\n60\n40\nENDCHAR\n"

static font_source_t source;
static sim_error_t error;

static int parse(const char *text) { return font_bdf_parse(&source, text, strlen(text), "f.bdf", &error); }

/* ---- what is right ---- */

static void check_glyph(const uint8_t *bytes, unsigned index, const uint8_t *expected) {
    assert_memory_equal(bytes + FONT_HEADER_BYTES + index * FONT_GLYPH_BYTES, expected, FONT_GLYPH_BYTES);
}

/* "one": its dots are .## and .#. in the lower two rows of a box whose lowest row is below the base line: rows 1 and 2 of 0 ... 2
 * from row 3 - (-1) - 3 = 1 of the line on, so from row 2, column 1. Bits 11 10 -> 1110. "wide": .#......# and .......#. of 9
 * columns, cut to columns 1 ... 8, rows from 3 - 0 - 2 = 1; 10000001 00000010, from column 0 to the pen. */
static void glyphs_are_cut_to_their_dots_and_sorted(void **state) {
    static const uint8_t one[] = {65, 0, 0, 3, 0, 0, 0, 0, 1, 2, 2, 2}, wide[] = {0x2c, 1, 0, 10, 1, 0, 0, 0, 0, 1, 8, 2};
    static const uint8_t bits[] = {0xe0, 0x81, 0x02, 0};
    uint8_t *bytes;
    size_t size;
    font_report_t report;
    tuile_font_t font;
    (void)state;
    assert_int_equal(parse(HEAD FIRST SECOND "ENDFONT\n"), 0);
    assert_int_equal(font_compile(&source, NULL, 0, &bytes, &size, &report, &error), 0);
    assert_int_equal(size, FONT_HEADER_BYTES + 2 * FONT_GLYPH_BYTES + sizeof bits);
    assert_int_equal(report.glyphs, 2);
    assert_int_equal(bytes[FONT_AT_HEIGHT], 5);
    assert_int_equal(bytes[FONT_AT_ASCENT], 3);
    assert_int_equal(bytes[FONT_AT_ADVANCE], 9);
    check_glyph(bytes, 0, one);
    check_glyph(bytes, 1, wide);
    assert_memory_equal(bytes + FONT_HEADER_BYTES + 2 * FONT_GLYPH_BYTES, bits, sizeof bits);
    assert_int_equal(tuile_font_open(&font, bytes, size), 0);
    assert_non_null(font_glyph(&font, 300));
    assert_null(font_glyph(&font, 66));
    assert_int_equal(font_advance(&font, 66), 9);
    free(bytes);
    font_source_free(&source);
}

static void what_files_may_leave_out_or_spell_otherwise(void **state) {
    static const char *const good[] = {
        "STARTFONT 2.1\nFONTBOUNDINGBOX 9 4 0 -1\n" FIRST SECOND "ENDFONT", /* ascent 3, descent 1 from the box; no newline */
        "STARTFONT 2.1\r\nFONT_ASCENT 3\r\nFONT_DESCENT 1\r\n\r\nSTARTCHAR e\r\nENCODING 65\r\nDWIDTH 0 0\r\nBBX 0 0 0 0\r\n"
        "BITMAP\r\nENDCHAR\r\nENDFONT\r\nrest",
        "STARTFONT 2.1\nFONT_ASCENT 3 \nFONT_DESCENT\t1\nSTARTCHAR e\nDWIDTH 3 0\nBBX 3 1 0 0\nENCODING "
        "65\nBITMAP\naF\nENDCHAR\nENDFONT\n",
    };
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(good); i++) {
        if (parse(good[i]) != 0) { fail_msg("%u: %s", i, error.text); }
        assert_int_equal(source.ascent + source.descent, 4);
        font_source_free(&source);
    }
    assert_int_equal(parse(HEAD "STARTCHAR x\nENCODING -1\nDWIDTH 1 0\nBBX 1 1 0 0\nBITMAP\n80\nENDCHAR\n" SECOND "ENDFONT\n"), 0);
    assert_int_equal(source.count, 1);
    assert_int_equal(source.unencoded, 1);
    font_source_free(&source);
}

/* ---- what is wrong ---- */

#define GLYPH(encoding, width, box, rows) "STARTCHAR x\n" encoding "\n" width "\n" box "\nBITMAP\n" rows "ENDCHAR\n"
#define GOOD_ENCODING "ENCODING 65"
#define GOOD_WIDTH "DWIDTH 3 0"
#define GOOD_BOX "BBX 3 1 0 0"
#define WITH(glyph) HEAD FIRST glyph "ENDFONT\n"

static void broken_files_are_refused_by_their_lines(void **state) {
    static const struct {
        const char *text, *line, *what;
    } bad[] = {
        {"", "f.bdf:0", "STARTFONT"},
        {"%PDF-1.4\n", "f.bdf:1", "STARTFONT"},
        {"STARTFONTS 2.1\n", "f.bdf:1", "STARTFONT"},
        {HEAD, "f.bdf:11", "ENDFONT is missing"},
        {HEAD "ENDFONT\n", "f.bdf:12", "promises 2 glyphs, but there are 0"},
        {HEAD FIRST "ENDFONT\n", "f.bdf:21", "promises 2 glyphs, but there are 1"},
        {HEAD FIRST SECOND, "f.bdf:29", "ENDFONT is missing"},
        {"STARTFONT 2.1\nCHARS 0\nENDFONT\n", "f.bdf:3", "no glyph"},
        {WITH(GLYPH("ENCODING 300", GOOD_WIDTH, GOOD_BOX, "80\n")), "f.bdf:21", "300 has a glyph already, in line 12"},
        {WITH(GLYPH("ENCODING 1114112", GOOD_WIDTH, GOOD_BOX, "80\n")), "f.bdf:22", "out of range"},
        {WITH(GLYPH("ENCODING 99999999999999999999", GOOD_WIDTH, GOOD_BOX, "80\n")), "f.bdf:22", "out of range"},
        {WITH(GLYPH("ENCODING 55296", GOOD_WIDTH, GOOD_BOX, "80\n")), "f.bdf:22", "no character"},
        {WITH(GLYPH("ENCODING x", GOOD_WIDTH, GOOD_BOX, "80\n")), "f.bdf:22", "no whole number"},
        {WITH(GLYPH("ENCODING", GOOD_WIDTH, GOOD_BOX, "80\n")), "f.bdf:22", "wants 1 number"},
        {WITH(GLYPH("ENCODING 1 2 3", GOOD_WIDTH, GOOD_BOX, "80\n")), "f.bdf:22", "more than 2"},
        {WITH(GLYPH("ENCODINGS 1", GOOD_WIDTH, GOOD_BOX, "80\n")), "f.bdf:25", "ENCODING is missing"},
        {WITH(GLYPH(GOOD_ENCODING, "DWIDTH 256 0", GOOD_BOX, "80\n")), "f.bdf:23", "0 to 255"},
        {WITH(GLYPH(GOOD_ENCODING, "DWIDTH -1 0", GOOD_BOX, "80\n")), "f.bdf:23", "0 to 255"},
        {WITH(GLYPH(GOOD_ENCODING, "DWIDTH 3 1", GOOD_BOX, "80\n")), "f.bdf:23", "to the right"},
        {WITH(GLYPH(GOOD_ENCODING, "SWIDTH 3 0", GOOD_BOX, "80\n")), "f.bdf:25", "DWIDTH is missing"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, "BBX 128 1 0 0", "80\n")), "f.bdf:24", "128x1"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, "BBX 3 128 0 0", "80\n")), "f.bdf:24", "3x128"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, "BBX -1 1 0 0", "80\n")), "f.bdf:24", "-1x1"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, "BBX 3 1 128 0", "80\n")), "f.bdf:24", "128,0"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, "BBX 3 1 0 -129", "80\n")), "f.bdf:24", "0,-129"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, "BBX 3 1 0", "80\n")), "f.bdf:24", "wants 4 numbers, but has 3"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, "BBX 3 1 0 2147483648", "80\n")), "f.bdf:24", "out of range"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, "BOX 3 1 0 0", "80\n")), "f.bdf:25", "BBX is missing"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, GOOD_BOX, "")), "f.bdf:26", "0 rows instead of 1"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, GOOD_BOX, "80\n80\n")), "f.bdf:27", "more than 1 rows"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, GOOD_BOX, "8\n")), "f.bdf:26", "2 hexadecimal digits"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, GOOD_BOX, "8000\n")), "f.bdf:26", "2 hexadecimal digits"},
        {WITH(GLYPH(GOOD_ENCODING, GOOD_WIDTH, GOOD_BOX, "8g\n")), "f.bdf:26", "no hexadecimal digits"},
        {WITH("STARTCHAR x\nENCODING 65\nDWIDTH 3 0\nBBX 3 1 0 0\nBITMAP\n80\n"), "f.bdf:27", "ENDCHAR is missing"},
        {WITH("STARTCHAR x\nENCODING 65\nDWIDTH 3 0\nBBX 3 1 0 0\nBITMAP\n"), "f.bdf:26", "0 rows instead of 1"},
        {WITH("STARTCHAR x\nENCODING 65\nDWIDTH 3 0\nBBX 3 1 0 0\n"), "f.bdf:25", "BITMAP is missing"},
        {WITH("STARTCHAR x\nENCODING 65\nENDCHAR\n"), "f.bdf:23", "BITMAP is missing"},
        {HEAD FIRST "STARTCHAR x\nENCODING 65\n", "f.bdf:22", "ends within the glyph that begins in line 21"},
        {HEAD FIRST "STARTCHAR x\nENCODING 65\nDWIDTH 3 0\nBBX 3 1 0 0\nBITMAP\n80", "f.bdf:26", "ENDCHAR is missing"},
        {WITH("ENDCHAR\n"), "f.bdf:21", "without STARTCHAR"},
        {WITH("BITMAP\n"), "f.bdf:21", "without STARTCHAR"},
        {"STARTFONT 2.1\nFONT_ASCENT 128\n", "f.bdf:2", "out of range"},
        {"STARTFONT 2.1\nFONT_ASCENT 0\nFONT_DESCENT 0\n" SECOND "ENDFONT\n", "f.bdf:13", "lines of 0 + 0"},
        {"STARTFONT 2.1\nFONT_ASCENT 100\nFONT_DESCENT 100\n" SECOND "ENDFONT\n", "f.bdf:13", "lines of 100 + 100"},
        {"STARTFONT 2.1\nFONTBOUNDINGBOX 1 32767 0 32767\n" SECOND "ENDFONT\n", "f.bdf:12", "lines of 65534 + -32767"},
        {"STARTFONT 2.1\nCHARS -1\n", "f.bdf:2", "out of range"},
    };
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        char line[32];
        (void)snprintf(line, sizeof line, "%s: ", bad[i].line);
        if (parse(bad[i].text) != -1) { fail_msg("%u: nothing was noticed", i); }
        if (strncmp(error.text, line, strlen(line)) != 0 || !strstr(error.text, bad[i].what) || strchr(error.text, '\n')) {
            fail_msg("%u: \"%s\" instead of %s ... %s", i, error.text, line, bad[i].what);
        }
        assert_null(source.glyphs);
    }
}

static void lines_that_are_no_text_are_refused(void **state) {
    static const char zero[] = "STARTFONT 2.1\nFONT a\0b\n";
    char *longest = malloc(4000);
    (void)state;
    assert_non_null(longest);
    assert_int_equal(font_bdf_parse(&source, zero, sizeof zero - 1, "f.bdf", &error), -1);
    assert_non_null(strstr(error.text, "f.bdf:2: a zero byte"));
    memset(longest, 'x', 4000);
    memcpy(longest, "STARTFONT 2.1\n", 14);
    assert_int_equal(font_bdf_parse(&source, longest, 4000, "f.bdf", &error), -1);
    assert_non_null(strstr(error.text, "f.bdf:2: a line of more than 1000"));
    free(longest);
}

/* A line lost, doubled or cut, or bytes changed, anywhere: one line of error or a font that opens. */
static void damaged_text_is_refused_or_compiled_without_harm(void **state) {
    static const char text[] = HEAD FIRST SECOND "ENDFONT\n";
    random_source_t random = random_seed(11);
    unsigned opened = 0;
    (void)state;
    for (int round = 0; round < CHECK_ROUNDS(20000); round++) {
        size_t size = sizeof text - 1;
        char *copy = malloc(size);
        assert_non_null(copy);
        memcpy(copy, text, size);
        for (int32_t n = random_between(&random, 1, 3); n > 0; n--) {
            const int32_t at = random_between(&random, 0, (int32_t)size - 1), kind = random_between(&random, 0, 3);
            if (kind == 0) { copy[at] = (char)random_between(&random, 0, 255); }
            if (kind == 1) { copy[at] = "0123456789-\n "[random_between(&random, 0, 12)]; }
            if (kind == 2) { memmove(copy + at, copy + at + 1, --size - (size_t)at); }
            if (kind == 3 && n == 1 && round % 8 == 0) { size = (size_t)at; }
            if (size == 0) { break; }
        }
        if (font_bdf_parse(&source, copy, size, "f.bdf", &error) == 0) {
            uint8_t *bytes;
            size_t bytes_size;
            tuile_font_t font;
            if (font_compile(&source, NULL, 0, &bytes, &bytes_size, NULL, &error) == 0) {
                assert_int_equal(tuile_font_open(&font, bytes, bytes_size), 0);
                opened++;
                free(bytes);
            }
            font_source_free(&source);
        } else {
            assert_int_equal(strncmp(error.text, "f.bdf:", 6), 0);
        }
        free(copy);
    }
    assert_true(opened > (unsigned)CHECK_ROUNDS(20000) / 100);
}

/* ---- ranges ---- */

static void ranges_take_what_they_name(void **state) {
    font_range_t ranges[FONT_RANGES_MAX];
    size_t count;
    (void)state;
    assert_int_equal(font_ranges_parse("32-126,0xB0,0x20aC-8365", ranges, &count, &error), 0);
    assert_int_equal(count, 3);
    assert_int_equal(ranges[0].first, 32);
    assert_int_equal(ranges[0].last, 126);
    assert_int_equal(ranges[1].first, 0xb0);
    assert_int_equal(ranges[1].last, 0xb0);
    assert_int_equal(ranges[2].first, 0x20ac);
    assert_int_equal(ranges[2].last, 8365);
}

static void wrong_ranges_are_refused(void **state) {
    static const char *const bad[] = {
        "", ",", "1,", "a", "5-4", "1-", "-1", "0x", "1-2-3", "1 2", "1114112", "99999999999999999999", "1;2"};
    font_range_t ranges[FONT_RANGES_MAX];
    size_t count;
    char many[2 * FONT_RANGES_MAX + 3] = "1";
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        if (font_ranges_parse(bad[i], ranges, &count, &error) != -1) { fail_msg("\"%s\" was taken", bad[i]); }
        assert_non_null(strstr(error.text, "--range"));
    }
    for (unsigned i = 1; i < FONT_RANGES_MAX; i++) {
        strcat(many, ",1");
    }
    assert_int_equal(font_ranges_parse(many, ranges, &count, &error), 0);
    assert_int_equal(font_ranges_parse(strcat(many, ",1"), ranges, &count, &error), -1);
}

static void fonts_have_the_glyphs_of_their_ranges(void **state) {
    static const font_range_t part[] = {{60, 70}, {65, 66}}, absent[] = {{66, 66}}, empty[] = {{66, 70}};
    uint8_t *bytes;
    size_t size;
    font_report_t report;
    (void)state;
    assert_int_equal(parse(HEAD FIRST SECOND "ENDFONT\n"), 0);
    assert_int_equal(font_compile(&source, part, 2, &bytes, &size, &report, &error), 0);
    assert_int_equal(report.glyphs, 1);
    assert_int_equal(report.absent, 10);
    free(bytes);
    assert_int_equal(font_compile(&source, absent, 1, &bytes, &size, &report, &error), -1);
    assert_non_null(strstr(error.text, "U+0042"));
    assert_int_equal(font_compile(&source, empty, 1, &bytes, &size, &report, &error), -1);
    assert_null(bytes);
    font_source_free(&source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glyphs_are_cut_to_their_dots_and_sorted),
        cmocka_unit_test(what_files_may_leave_out_or_spell_otherwise),
        cmocka_unit_test(broken_files_are_refused_by_their_lines),
        cmocka_unit_test(lines_that_are_no_text_are_refused),
        cmocka_unit_test(damaged_text_is_refused_or_compiled_without_harm),
        cmocka_unit_test(ranges_take_what_they_name),
        cmocka_unit_test(wrong_ranges_are_refused),
        cmocka_unit_test(fonts_have_the_glyphs_of_their_ranges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
