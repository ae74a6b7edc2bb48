/* tuile render: memory, pictures, hashes, ids, picking and the report. */
#include "support/check.h"
#include "support/cli.h"

#include "../sim/picture.h"

#include <ctype.h>
#include <unistd.h>

/* ---- memory --------------------------------------------------------------------------------------------------- */

static void too_little_memory_says_how_much_would_do(void **state) {
    command_result_t result;
    char line[256];
    (void)state;
    cli_fails("render @/torus.obj --memory 1000", "--memory", "at least");
    cli_fails("render @/torus.obj --memory 0", "--memory", "at least");
    cli_shell(&result, "% render @/torus.obj --tile 240x4 --memory 1000");
    const unsigned wanted = cli_number_after(result.err, "at least ");
    command_free(&result);
    assert_in_range(wanted, 5000, 10000);
    (void)snprintf(line, sizeof line, "render @/torus.obj --tile 240x4 --hash --memory %u", wanted - 1);
    cli_fails(line, "--memory", "at least");
    (void)snprintf(line, sizeof line, "render @/torus.obj --tile 240x4 --hash --memory %u", wanted);
    char *least = cli_good(line), *plenty = cli_good("render @/torus.obj --hash"),
         *some = cli_good("render @/torus.obj --hash --memory 16K --tile 32x32");
    assert_string_equal(least, plenty);
    assert_string_equal(some, plenty);
    free(least);
    free(plenty);
    free(some);
}

/* ---- pictures and figures -------------------------------------------------------------------------------------- */

static void frames_are_named_by_their_pattern(void **state) {
    (void)state;
    cli_good_silent(
        "render @/cube.obj --frames 3 --out @/frame-%03d.png --ids @/ids-%d.txt --sheet @/sheet.png --report @/report.json");
    static const char *const names[] = {"frame-000.png", "frame-001.png", "frame-002.png", "ids-0.txt",
                                        "ids-1.txt",     "ids-2.txt",     "sheet.png",     "report.json"};
    for (unsigned i = 0; i < CHECK_COUNT(names); i++) {
        if (!cli_exists(names[i])) { fail_msg("%s", names[i]); }
    }
    assert_false(cli_exists("frame-003.png"));
    sim_picture_t frames[2] = {{0}}, sheet = {0};
    assert_int_equal(sim_picture_read(&frames[0], cli_path("frame-000.png"), NULL), 0);
    assert_int_equal(sim_picture_read(&frames[1], cli_path("frame-001.png"), NULL), 0);
    assert_int_equal(sim_picture_read(&sheet, cli_path("sheet.png"), NULL), 0);
    assert_int_equal(frames[0].width, 240);
    assert_int_equal(frames[0].height, 320);
    assert_true(memcmp(frames[0].rgb, frames[1].rgb, 240 * 320 * 3) != 0);
    assert_int_equal(sheet.width, 2 * 120 + 3 * 4);
    assert_int_equal(sheet.height, 2 * 160 + 3 * 4);
    sim_picture_free(&frames[0]);
    sim_picture_free(&frames[1]);
    sim_picture_free(&sheet);
    for (unsigned i = 0; i < CHECK_COUNT(names); i++) {
        (void)unlink(cli_path(names[i]));
    }
}

static void ppm_and_png_show_the_same(void **state) {
    sim_picture_t png = {0}, ppm = {0};
    (void)state;
    cli_good_silent("render @/room.obj --rotate 270 --out @/a.png");
    cli_good_silent("render @/room.obj --rotate 270 --out @/a.ppm");
    size_t size;
    char *bytes = command_read(cli_path("a.ppm"), &size);
    assert_int_equal(strncmp(bytes, "P6\n320 240\n255\n", 15), 0);
    assert_int_equal(size, 15 + 320 * 240 * 3);
    free(bytes);
    assert_int_equal(sim_picture_read(&png, cli_path("a.png"), NULL), 0);
    assert_int_equal(sim_picture_read(&ppm, cli_path("a.ppm"), NULL), 0);
    assert_int_equal(png.width, 320);
    assert_int_equal(png.height, 240);
    assert_memory_equal(png.rgb, ppm.rgb, 320 * 240 * 3);
    sim_picture_free(&png);
    sim_picture_free(&ppm);
    (void)unlink(cli_path("a.png"));
    (void)unlink(cli_path("a.ppm"));
}

static void the_background_is_the_colour_asked_for(void **state) {
    sim_picture_t picture = {0};
    (void)state;
    cli_good_silent("render @/cube.obj --background FF0000 --out @/red.png");
    assert_int_equal(sim_picture_read(&picture, cli_path("red.png"), NULL), 0);
    assert_memory_equal(sim_picture_at(&picture, 0, 0), ((const uint8_t[3]){255, 0, 0}), 3);
    assert_memory_equal(sim_picture_at(&picture, 239, 319), ((const uint8_t[3]){255, 0, 0}), 3);
    sim_picture_free(&picture);
    (void)unlink(cli_path("red.png"));
}

static void the_hash_tells_pictures_apart_and_is_the_same_again(void **state) {
    static const char *const lines[] = {
        "render @/octahedron.obj --hash",
        "render @/octahedron.obj --hash --rotate 90",
        "render @/octahedron.obj --hash --rotate 180",
        "render @/octahedron.obj --hash --rotate 270",
        "render @/octahedron.obj --hash --background 010000",
        "render @/octahedron.obj --hash --background 800000",
        "render @/octahedron.obj --hash --fov 46",
        "render @/octahedron.obj --hash --light 0,-1,0",
    };
    char *out[CHECK_COUNT(lines)];
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(lines); i++) {
        out[i] = cli_good(lines[i]);
        assert_int_equal(strncmp(out[i], "frame 0 ", 8), 0);
        assert_int_equal(strspn(out[i] + 8, "0123456789abcdef"), 16);
        assert_string_equal(out[i] + 24, "\n");
        cli_answers(lines[i], out[i]);
        for (unsigned k = 0; k < i; k++) {
            const bool alike = i == 4 && k == 0; /* 1 of 255 is nothing in five bits */
            if ((strcmp(out[i], out[k]) == 0) != alike) { fail_msg("%s and %s", lines[i], lines[k]); }
        }
    }
    for (unsigned i = 0; i < CHECK_COUNT(lines); i++) {
        free(out[i]);
    }
}

static void a_turn_by_spin_is_a_turn_of_the_model(void **state) {
    (void)state;
    char *four = cli_good("render @/octahedron.obj --frames 4 --hash"),
         *again = cli_good("render @/octahedron.obj --frames 4 --spin 90 --hash");
    char *back = cli_good("render @/octahedron.obj --frames 5 --spin 90 --hash");
    assert_string_equal(four, again);
    assert_int_equal(strncmp(back, four, strlen(four)), 0);
    assert_int_equal(strncmp(back + strlen(four) + 8, four + 8, 16), 0); /* frame 4 is frame 0 */
    free(four);
    free(again);
    free(back);
}

/* ---- ids and picking ------------------------------------------------------------------------------------------- */

/* 240 numbers a row, 320 rows. */
static uint32_t *read_ids(const char *name) {
    char *text = command_read(cli_path(name), NULL), *at = text;
    uint32_t *ids = malloc(sizeof *ids * 240 * 320);
    assert_non_null(text);
    assert_non_null(ids);
    for (unsigned i = 0; i < 240 * 320; i++) {
        char *end;
        ids[i] = (uint32_t)strtoul(at, &end, 10);
        assert_true(end > at);
        assert_int_equal(*end, i % 240 == 239 ? '\n' : ' ');
        at = end + 1;
    }
    assert_int_equal(*at, '\0');
    free(text);
    (void)unlink(cli_path(name));
    return ids;
}

/* 80 pixels a unit: the side towards the eye covers x 40 ... 199, y 80 ... 239. */
static void ids_of_a_cube_are_the_numbers_of_its_lines(void **state) {
    static const char *const sides[] = {
        "--eye 0,0,5", "--eye 0,0,-5", "--eye 5,0,0", "--eye -5,0,0", "--eye 0,5,0 --up 0,0,-1", "--eye 0,-5,0 --up 0,0,1",
    };
    (void)state;
    for (unsigned side = 0; side < 6; side++) {
        char line[256];
        (void)snprintf(line, sizeof line, "render @/cube.obj --ortho 4 --at 0,0,0 %s --ids @/ids", sides[side]);
        cli_good_silent(line);
        uint32_t *ids = read_ids("ids");
        for (unsigned y = 0; y < 320; y++) {
            for (unsigned x = 0; x < 240; x++) {
                const bool inside = x >= 40 && x < 200 && y >= 80 && y < 240;
                if (ids[y * 240 + x] != (inside ? side + 1 : 0)) {
                    fail_msg("side %u: face %u at %u,%u", side, ids[y * 240 + x], x, y);
                }
            }
        }
        free(ids);
    }
}

static void ids_of_triangles_are_the_numbers_of_their_lines(void **state) {
    (void)state;
    cli_put("halves.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                          "v -3 -3 -1\nv 3 -3 -1\nv 0 3 -1\n"
                          "f 1 2 3\nf 5 6 7\nf 1 3 4\nf 7 6 5\n"); /* the last one faces away */
    cli_good_silent("render @/halves.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --ids @/ids");
    uint32_t *ids = read_ids("ids");
    for (unsigned y = 80; y < 240; y++) {
        for (unsigned x = 40; x < 200; x++) { /* the diagonal leads from (40, 240) to (200, 80) */
            const unsigned below = x - 40 + y - 80;
            if (below == 159) { continue; } /* centres on the diagonal */
            assert_int_equal(ids[y * 240 + x], below > 159 ? 1 : 3);
        }
    }
    assert_int_equal(ids[300 * 240 + 120], 2);
    assert_int_equal(ids[0], 0);
    free(ids);
}

static void picking_tells_face_and_place(void **state) {
    (void)state;
    cli_answers("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --pick 120,160",
                "pick 120,160: face 1 at 0.00625,-0.00625,1\n");
    cli_answers("render @/cube.obj --ortho 4 --eye 5,0,0 --at 0,0,0 --pick 40,80", "pick 40,80: face 3 at 1,0.99375,0.99375\n");
    cli_answers("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --pick 39,160", "pick 39,160: background\n");
    /* A quarter turn about y brings -x to the front; the point is in the model's own units. */
    cli_answers("render @/cube.obj --ortho 4 --eye 0,0,5 --at 0,0,0 --frames 2 --spin 90 --pick 120,160",
                "pick 120,160: face 4 at -1,-0.00625,0.00625\n");
}

/* ---- the report ------------------------------------------------------------------------------------------------ */

/* JSON, as far as RFC 8259 goes but for the insides of strings. NULL where it is not. */
static const char *json_value(const char *at, int depth);

static const char *json_blank(const char *at) {
    while (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r') {
        at++;
    }
    return at;
}

static const char *json_string(const char *at) {
    if (*at++ != '"') { return NULL; }
    for (; *at && *at != '"'; at++) {
        if (*at == '\\' && *++at == '\0') { return NULL; }
        if ((unsigned char)*at < ' ') { return NULL; }
    }
    return *at == '"' ? at + 1 : NULL;
}

static const char *json_number(const char *at) {
    at += *at == '-';
    if (!isdigit((unsigned char)*at) || (*at == '0' && isdigit((unsigned char)at[1]))) { return NULL; }
    while (isdigit((unsigned char)*at)) {
        at++;
    }
    if (*at == '.') {
        if (!isdigit((unsigned char)*++at)) { return NULL; }
        while (isdigit((unsigned char)*at)) {
            at++;
        }
    }
    return at;
}

static const char *json_list(const char *at, char end, int depth) {
    at = json_blank(at + 1);
    if (*at == end) { return at + 1; }
    for (;; at = json_blank(at + 1)) {
        if (end == '}') {
            at = json_string(at);
            at = at ? json_blank(at) : NULL;
            if (!at || *at != ':') { return NULL; }
            at++;
        }
        at = json_value(json_blank(at), depth - 1);
        at = at ? json_blank(at) : NULL;
        if (!at) { return NULL; }
        if (*at == end) { return at + 1; }
        if (*at != ',') { return NULL; }
    }
}

static const char *json_value(const char *at, int depth) {
    static const char *const words[] = {"true", "false", "null"};
    if (depth == 0) { return NULL; }
    if (*at == '{') { return json_list(at, '}', depth); }
    if (*at == '[') { return json_list(at, ']', depth); }
    if (*at == '"') { return json_string(at); }
    for (unsigned i = 0; i < 3; i++) {
        if (strncmp(at, words[i], strlen(words[i])) == 0) { return at + strlen(words[i]); }
    }
    return json_number(at);
}

static void the_ways_of_warnock_draw_alike_and_their_windows_are_in_the_report(void **state) {
    static const char *const ways[] = {"", " --warnock quarters", " --warnock single,box", " --warnock sorted,pixels"};
    double windows[4], pixels[4];
    (void)state;
    char *expected = cli_good("render @/torus.obj --hash");
    for (unsigned i = 0; i < CHECK_COUNT(ways); i++) {
        char line[256];
        (void)snprintf(line, sizeof line, "render @/torus.obj --method warnock --hash --report @/report.json%s", ways[i]);
        char *out = cli_good(line), *text = command_read(cli_path("report.json"), NULL);
        assert_non_null(text);
        if (strncmp(out, expected, strlen(expected)) != 0) { fail_msg("%s: %s", line, out); }
        const char *end = json_value(json_blank(text), 8);
        if (!end || *json_blank(end) != '\0') { fail_msg("no JSON:\n%s", text); }
        windows[i] = (double)cli_number_after(text, "\"windows\": ");
        pixels[i] = (double)cli_number_after(text, "\"windows_pixels\": ");
        assert_true(windows[i] > pixels[i] && pixels[i] > 0);
        assert_in_range(cli_number_after(text, "\"windows_depth\": "), 1, 20);
        assert_in_range(cli_number_after(text, "\"windows_waiting\": "), 2, 31);
        free(text);
        free(out);
    }
    assert_true(windows[2] < windows[1] && pixels[2] < pixels[1]);
    free(expected);
    (void)unlink(cli_path("report.json"));
}

static void the_report_is_json_with_every_figure_of_every_frame(void **state) {
    static const char *const fields[] = {"frame",
                                         "hash",
                                         "width",
                                         "height",
                                         "tile_width",
                                         "tile_height",
                                         "instances",
                                         "instances_outside",
                                         "faces",
                                         "clusters",
                                         "clusters_outside",
                                         "clusters_facing_away",
                                         "vertices",
                                         "faces_tested",
                                         "faces_back",
                                         "faces_degenerate",
                                         "faces_outside",
                                         "faces_clipped",
                                         "faces_clipped_away",
                                         "faces_binned",
                                         "faces_setup",
                                         "faces_resumed",
                                         "passes",
                                         "tiles",
                                         "tiles_narrow",
                                         "size_bytes",
                                         "least_bytes",
                                         "peak_bytes",
                                         "wire_bytes",
                                         "wire_ns",
                                         "fps_bus"};
    (void)state;
    char *out = cli_good("render @/torus.obj --frames 3 --hash --tile 240x8 --memory 64K --report @/report.json");
    char *text = command_read(cli_path("report.json"), NULL);
    assert_non_null(text);
    const char *end = json_value(json_blank(text), 8);
    if (!end || *json_blank(end) != '\0') { fail_msg("no JSON:\n%s", text); }
    const char *frame = text;
    for (unsigned k = 0; k < 3; k++) {
        char hash[64];
        frame = strstr(frame + 1, "{\"frame\"");
        assert_non_null(frame);
        const char *close = strchr(frame, '}');
        assert_non_null(close);
        for (unsigned i = 0; i < CHECK_COUNT(fields); i++) {
            char name[64];
            (void)snprintf(name, sizeof name, "\"%s\": ", fields[i]);
            const char *at = strstr(frame, name);
            if (!at || at > close) { fail_msg("frame %u has no %s", k, fields[i]); }
        }
        assert_int_equal(cli_number_after(frame, "\"frame\": "), k);
        assert_int_equal(cli_number_after(frame, "\"width\": "), 240);
        assert_int_equal(cli_number_after(frame, "\"height\": "), 320);
        assert_int_equal(cli_number_after(frame, "\"tile_height\": "), 8);
        assert_int_equal(cli_number_after(frame, "\"faces\": "), 400);
        assert_int_equal(cli_number_after(frame, "\"passes\": "), 1);
        assert_int_equal(cli_number_after(frame, "\"tiles\": "), 40);
        assert_int_equal(cli_number_after(frame, "\"size_bytes\": "), 65536);
        assert_int_equal(cli_number_after(frame, "\"wire_bytes\": "), 153600 + 11 + (k == 0)); /* one window; the first switches it on */
        /* Bits at the clock, and no less. */
        assert_true(cli_number_after(frame, "\"wire_ns\": ") > 1000000);
        const char *at = strstr(frame, "\"hash\": \"");
        (void)snprintf(hash, sizeof hash, "frame %u %.16s\n", k, at + 9);
        if (!strstr(out, hash)) { fail_msg("the report has '%s', printed was\n%s", hash, out); }
    }
    free(text);
    free(out);
    (void)unlink(cli_path("report.json"));
}

static void a_faster_clock_shortens_the_time_on_the_wire(void **state) {
    (void)state;
    cli_good_silent("render @/cube.obj --clock 10M --tile 240x320 --report @/slow.json");
    cli_good_silent("render @/cube.obj --clock 5M --tile 240x320 --report @/slower.json");
    char *slow = command_read(cli_path("slow.json"), NULL), *slower = command_read(cli_path("slower.json"), NULL);
    /* 153 600 bytes of 8 bits at 100 and at 200 ns, but for the commands of one window. */
    assert_in_range(cli_number_after(slow, "\"wire_ns\": "), 122880000, 122990000);
    assert_in_range(cli_number_after(slower, "\"wire_ns\": "), 245760000, 245980000);
    free(slow);
    free(slower);
    (void)unlink(cli_path("slow.json"));
    (void)unlink(cli_path("slower.json"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(too_little_memory_says_how_much_would_do),
        cmocka_unit_test(frames_are_named_by_their_pattern),
        cmocka_unit_test(ppm_and_png_show_the_same),
        cmocka_unit_test(the_background_is_the_colour_asked_for),
        cmocka_unit_test(the_hash_tells_pictures_apart_and_is_the_same_again),
        cmocka_unit_test(a_turn_by_spin_is_a_turn_of_the_model),
        cmocka_unit_test(ids_of_a_cube_are_the_numbers_of_its_lines),
        cmocka_unit_test(ids_of_triangles_are_the_numbers_of_their_lines),
        cmocka_unit_test(picking_tells_face_and_place),
        cmocka_unit_test(the_report_is_json_with_every_figure_of_every_frame),
        cmocka_unit_test(the_ways_of_warnock_draw_alike_and_their_windows_are_in_the_report),
        cmocka_unit_test(a_faster_clock_shortens_the_time_on_the_wire),
    };
    return cmocka_run_group_tests_name("cli_render", tests, cli_set_up, cli_tear_down);
}
