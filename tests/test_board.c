/* What boards have in the place of a C library: copying and filling at every alignment, lines of text, options. */
#include "support/check.h"

#include "../firmware/board/line.h"

#define memcpy board_memcpy
#define memmove board_memmove
#define memset board_memset
#define memcmp board_memcmp
#include "../firmware/board/memory.c"
#undef memcpy
#undef memmove
#undef memset
#undef memcmp
#include "../firmware/board/line.c"

#define SPAN 40u /* of both buffers; positions and sizes go all the way round */

static void fill(uint8_t *bytes) {
    for (unsigned i = 0; i < SPAN; i++) {
        bytes[i] = (uint8_t)(17u * i + 3u);
    }
}

/* ---- memory ----------------------------------------------------------------------------------------------------- */

static void copies_are_right_at_every_alignment(void **state) {
    (void)state;
    for (unsigned to = 0; to < 8; to++) {
        for (unsigned from = 0; from < 8; from++) {
            for (unsigned size = 0; size <= SPAN - 8; size++) {
                _Alignas(8) uint8_t source[SPAN], target[SPAN], expected[SPAN];
                fill(source);
                for (unsigned i = 0; i < SPAN; i++) {
                    target[i] = expected[i] = 0xEE;
                    if (i >= to && i < to + size) { expected[i] = (uint8_t)(17u * (i - to + from) + 3u); }
                }
                assert_ptr_equal(board_memcpy(target + to, source + from, size), target + to);
                assert_memory_equal(target, expected, SPAN);
            }
        }
    }
}

static void moves_are_right_where_they_overlap(void **state) {
    (void)state;
    for (unsigned to = 0; to < 16; to++) {
        for (unsigned from = 0; from < 16; from++) {
            for (unsigned size = 0; size <= SPAN - 16; size++) {
                _Alignas(8) uint8_t bytes[SPAN], expected[SPAN];
                fill(bytes);
                for (unsigned i = 0; i < SPAN; i++) {
                    expected[i] = (uint8_t)(17u * (i >= to && i < to + size ? i - to + from : i) + 3u);
                }
                assert_ptr_equal(board_memmove(bytes + to, bytes + from, size), bytes + to);
                assert_memory_equal(bytes, expected, SPAN);
            }
        }
    }
}

static void fills_are_right_at_every_alignment(void **state) {
    (void)state;
    for (unsigned to = 0; to < 8; to++) {
        for (unsigned size = 0; size <= SPAN - 8; size++) {
            _Alignas(8) uint8_t bytes[SPAN], expected[SPAN];
            for (unsigned i = 0; i < SPAN; i++) {
                bytes[i] = 0xEE;
                expected[i] = i >= to && i < to + size ? 0xA5 : 0xEE;
            }
            assert_ptr_equal(board_memset(bytes + to, (int)0xFFFFFFA5u, size), bytes + to); /* the lowest byte counts */
            assert_memory_equal(bytes, expected, SPAN);
        }
    }
}

static void bytes_are_compared_as_unsigned_ones(void **state) {
    (void)state;
    assert_int_equal(board_memcmp("abc", "abc", 3), 0);
    assert_int_equal(board_memcmp("abc", "abd", 2), 0);
    assert_int_equal(board_memcmp("", "x", 0), 0);
    assert_true(board_memcmp("abc", "abd", 3) < 0);
    assert_true(board_memcmp("\x80", "\x7f", 1) > 0);
}

/* ---- lines ------------------------------------------------------------------------------------------------------ */

static void words_and_numbers_stand_apart(void **state) {
    line_t line = {.used = 0};
    (void)state;
    line_word(&line, "frame");
    line_number(&line, 0);
    line_number(&line, 4294967295u);
    line_number(&line, 1000);
    line_word(&line, "end");
    assert_string_equal(line.text, "frame 0 4294967295 1000 end");
}

static void what_does_not_fit_is_cut_off(void **state) {
    line_t line = {.used = 0};
    (void)state;
    for (unsigned i = 0; i < 50; i++) {
        line_word(&line, "abc");
    }
    assert_int_equal(strlen(line.text), sizeof line.text - 1);
    assert_int_equal(strncmp(line.text + sizeof line.text - 8, "abc abc", 7), 0);
}

static void options_are_found_by_their_whole_name(void **state) {
    static const char text[] = "frames=12 scene=spider xframes=3  method=tree";
    (void)state;
    assert_int_equal(line_value(line_option(text, "frames"), 8), 12);
    assert_int_equal(strncmp(line_option(text, "scene"), "spider ", 7), 0);
    assert_string_equal(line_option(text, "method"), "tree");
    assert_int_equal(line_value(line_option(text, "xframes"), 8), 3);
    assert_null(line_option(text, "rames"));
    assert_null(line_option(text, "frame"));
    assert_null(line_option(text, "spider"));
    assert_null(line_option("", "frames"));
    assert_null(line_option("frames", "frames"));
    assert_int_equal(line_value(NULL, 8), 8);
    assert_int_equal(line_value(line_option("frames=", "frames"), 8), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copies_are_right_at_every_alignment),   cmocka_unit_test(moves_are_right_where_they_overlap),
        cmocka_unit_test(fills_are_right_at_every_alignment),    cmocka_unit_test(bytes_are_compared_as_unsigned_ones),
        cmocka_unit_test(words_and_numbers_stand_apart),         cmocka_unit_test(what_does_not_fit_is_cut_off),
        cmocka_unit_test(options_are_found_by_their_whole_name),
    };
    return cmocka_run_group_tests_name("board", tests, NULL, NULL);
}
