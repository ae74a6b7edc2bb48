/* What the overlay draws, by pictures made by hand; blending by hand; and that tiles do not matter, whatever the numbers are. */
#include "support/check.h"
#include "support/overlay.h"
#include "support/random.h"

#define WHITE TUILE_COLOUR(255, 255, 255)

static window_t window;

/* Draws with a tile of 5 x 3 pixels, so that every shape is cut. */
static void see(window_draw_fn draw, const void *context, int32_t width, int32_t height, bool crisp, const char *const *rows) {
    window_open(&window, width, height);
    window.crisp = crisp;
    window_draw(&window, 5, 3, draw, context);
    assert_true(window_looks(&window, rows));
}

/* ---- rectangles ---- */

static void draw_rectangles(const void *context, tuile_canvas_t *canvas) {
    (void)context;
    tuile_draw_rectangle(canvas, 1, 1, 3, 2, WHITE);
    tuile_draw_rectangle(canvas, 6, -5, 2, 6, WHITE); /* one row of it is in the window */
    tuile_draw_rectangle(canvas, 9, 3, 1, 1000, WHITE);
    tuile_draw_rectangle(canvas, 0, 0, 0, 9, WHITE);
    tuile_draw_rectangle(canvas, 0, 0, 9, -9, WHITE);
    tuile_draw_pixel(canvas, 0, 4, WHITE);
    tuile_draw_pixel(canvas, -1, 4, WHITE);
    tuile_draw_pixel(canvas, 10, 4, WHITE);
}

static void rectangles_have_their_pixels_and_no_others(void **state) {
    static const char *const rows[] = {"......##..", ".###......", ".###......", ".........#", "#........#"};
    (void)state;
    see(draw_rectangles, NULL, 10, 5, false, rows);
}

static void draw_frames(const void *context, tuile_canvas_t *canvas) {
    const uint32_t *colour = context;
    tuile_draw_frame(canvas, 0, 0, 5, 4, 1, *colour);
    tuile_draw_frame(canvas, 6, 0, 6, 5, 2, *colour);
    tuile_draw_frame(canvas, 13, 0, 4, 3, 2, *colour); /* thicker than it has room for: filled */
    tuile_draw_frame(canvas, 13, 4, 4, 1, 0, *colour);
}

static void frames_draw_no_pixel_twice(void **state) {
    static const uint32_t white = WHITE, half = TUILE_ARGB(128, 255, 255, 255);
    static const char *const rows[] = {"#####.######.####", "#...#.######.####", "#...#.##..##.####", "#####.######.....",
                                       "......######....."};
    static const char *const halves[] = {"88888.888888.8888", "8...8.888888.8888", "8...8.88..88.8888", "88888.888888.....",
                                         "......888888....."};
    (void)state;
    see(draw_frames, &white, 17, 5, false, rows);
    see(draw_frames, &half, 17, 5, false, halves);
}

static void draw_clipped(const void *context, tuile_canvas_t *canvas) {
    (void)context;
    tuile_canvas_clip(canvas, 2, 1, 3, 2);
    tuile_draw_rectangle(canvas, INT32_MIN, INT32_MIN, INT32_MAX, INT32_MAX, WHITE); /* ends before 0 */
    tuile_draw_rectangle(canvas, 0, 0, INT32_MAX, INT32_MAX, WHITE);
    tuile_canvas_clip(canvas, -5, 4, 6, INT32_MAX);
    tuile_draw_rectangle(canvas, 0, 0, 100, 100, WHITE);
    tuile_canvas_clip(canvas, INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX);
    tuile_draw_rectangle(canvas, 0, 0, 100, 100, WHITE);
    tuile_canvas_clip(canvas, INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN);
    tuile_draw_rectangle(canvas, 0, 0, 100, 100, WHITE);
}

static void clips_hold_what_is_drawn(void **state) {
    static const char *const rows[] = {".......", "..###..", "..###..", ".......", "#......"};
    (void)state;
    see(draw_clipped, NULL, 7, 5, false, rows);
}

/* ---- round shapes without soft edges ---- */

static void draw_disc(const void *context, tuile_canvas_t *canvas) {
    const int32_t *radius = context;
    tuile_draw_disc(canvas, TUILE_PX(3) + 8, TUILE_PX(3) + 8, *radius, WHITE);
}

/* A pixel at (dx, dy) from the centre is in the disc iff dx^2 + dy^2 <= r^2: for r = 2.5, 6.25; for r = 3, 9. */
static void crisp_discs_are_those_pixels_whose_centres_are_inside(void **state) {
    static const char *const two_and_a_half[] = {".......", "..###..", ".#####.", ".#####.", ".#####.", "..###..", "......."};
    static const char *const three[] = {"...#...", ".#####.", ".#####.", "#######", ".#####.", ".#####.", "...#..."};
    static const int32_t radii[] = {40, 48};
    (void)state;
    see(draw_disc, &radii[0], 7, 7, true, two_and_a_half);
    see(draw_disc, &radii[1], 7, 7, true, three);
}

static void draw_arcs(const void *context, tuile_canvas_t *canvas) {
    const bam16_t *angles = context;
    tuile_draw_arc(canvas, TUILE_PX(3) + 8, TUILE_PX(3) + 8, 24, 56, angles[0], angles[1], WHITE);
}

/* The ring of 1.5 ... 3.5: 2.25 < dx^2 + dy^2 <= 12.25. Clockwise from the right: the first quarter is the lower right one and has
 * the pixels straight to the right, not those straight below. */
static void crisp_arcs_have_their_first_ray_and_not_their_last(void **state) {
    static const char *const quarter[] = {".......", ".......", ".......", ".....##", ".....##", "....##.", "....#.."};
    static const char *const rest[] = {"..###..", ".#####.", "##...##", "##.....", "##.....", ".###...", "..##..."};
    static const char *const upper[] = {"..###..", ".#####.", "##...##", "##.....", ".......", ".......", "......."};
    static const bam16_t first[] = {0, 0x4000}, others[] = {0x4000, 0}, half[] = {0x8000, 0}, none[] = {77, 77};
    static const char *const empty[] = {".......", ".......", ".......", ".......", ".......", ".......", "......."};
    (void)state;
    see(draw_arcs, first, 7, 7, true, quarter);
    see(draw_arcs, others, 7, 7, true, rest);
    see(draw_arcs, half, 7, 7, true, upper);
    see(draw_arcs, none, 7, 7, true, empty);
}

static void draw_rounded(const void *context, tuile_canvas_t *canvas) {
    (void)context;
    tuile_draw_rounded(canvas, 0, 0, 9, 7, 3, WHITE);
    tuile_draw_rounded(canvas, 10, 0, 4, 7, 99, WHITE); /* held to 2 */
    tuile_draw_rounded(canvas, 15, 1, 2, 2, 0, WHITE);
    tuile_draw_rounded(canvas, 15, 5, 0, 2, 1, WHITE);
}

/* Radius 3: the corner's pixels are (2.5, 1.5, 0.5) from its centre each way; 2.5^2 + 2.5^2 and 2.5^2 + 1.5^2 = 8.5 <= 9. Radius 2:
 * 1.5^2 + 1.5^2 = 4.5 > 4. */
static void rounded_rectangles_lose_their_corners(void **state) {
    static const char *const rows[] = {".#######...##....", "#########.####.##", "#########.####.##", "#########.####...",
                                       "#########.####...", "#########.####...", ".#######...##...."};
    (void)state;
    see(draw_rounded, NULL, 17, 7, true, rows);
}

/* ---- lines and polygons ---- */

static void draw_lines(const void *context, tuile_canvas_t *canvas) {
    (void)context;
    tuile_draw_line(canvas, 0, 0, 8, 3, WHITE); /* as test_line.c has it by hand */
    tuile_draw_line(canvas, 0, 4, 9, 4, WHITE);
    tuile_draw_line(canvas, 11, -3, 11, 2, WHITE);
    tuile_draw_line(canvas, 11, 4, 11, 4, WHITE);
}

static void lines_are_bresenhams(void **state) {
    static const char *const rows[] = {"##.........#", "..##.......#", "....###....#", ".......##...", "##########.#"};
    (void)state;
    see(draw_lines, NULL, 12, 5, false, rows);
}

static void draw_polygons(const void *context, tuile_canvas_t *canvas) {
    static const q28_4_t square[4][2] = {{16, 16}, {64, 16}, {64, 48}, {16, 48}},
                         triangle[3][2] = {{TUILE_PX(6), 0}, {TUILE_PX(10), TUILE_PX(4)}, {TUILE_PX(6), TUILE_PX(4)}};
    (void)context;
    assert_int_equal(tuile_draw_polygon(canvas, square, 4, WHITE), 0);
    assert_int_equal(tuile_draw_polygon(canvas, triangle, 3, WHITE), 0);
    assert_int_equal(tuile_draw_polygon(canvas, triangle, 2, WHITE), 0);
}

/* The hypotenuse passes through the centres of the diagonal's pixels: right edges do not count. */
static void polygons_have_the_coverage_of_faces(void **state) {
    static const char *const rows[] = {"..........", ".###..#...", ".###..##..", "......###."};
    q28_4_t many[TUILE_POLYGON_CORNERS + 1][2] = {{0}};
    tuile_canvas_t canvas = {0};
    (void)state;
    see(draw_polygons, NULL, 10, 4, false, rows);
    assert_int_equal(tuile_draw_polygon(&canvas, many, TUILE_POLYGON_CORNERS + 1, WHITE), TUILE_ERROR_ARGUMENT);
    assert_int_equal(tuile_draw_polygon(&canvas, NULL, 3, WHITE), TUILE_ERROR_ARGUMENT);
}

/* ---- images ---- */

static const uint8_t grey_texels[] = {0, 255, 128, 255, 0, 255};
static const uint8_t nibbles[] = {0x10, 0x02, 0x32, 0x01};                                /* 0 1 2, 2 3 1 */
static const uint8_t nibble_palette[] = {0x00, 0x00, 0xff, 0xff, 0xff, 0x8f, 0xff, 0x0f}; /* none, white, half, clear white */

static void draw_images(const void *context, tuile_canvas_t *canvas) {
    const tuile_texture_t grey = {.texels = grey_texels, .width = 3, .height = 2, .format = TUILE_TEXEL_GREY8, .levels = 1};
    tuile_texture_t keyed = grey;
    const tuile_texture_t palette = {.texels = nibbles,
                                     .palette = nibble_palette,
                                     .width = 3,
                                     .height = 2,
                                     .format = TUILE_TEXEL_PALETTE4,
                                     .levels = 1,
                                     .flags = TUILE_TEXTURE_PALETTE_ALPHA};
    (void)context;
    keyed.flags = TUILE_TEXTURE_KEY;
    keyed.key = 0;
    tuile_draw_rectangle(canvas, 0, 4, 20, 3, TUILE_COLOUR(64, 64, 64)); /* 4 of 16 */
    assert_int_equal(tuile_draw_image(canvas, &grey, 0, 0, 1, 255), 0);
    assert_int_equal(tuile_draw_image(canvas, &grey, 4, -1, 2, 255), 0);
    assert_int_equal(tuile_draw_image(canvas, &palette, 11, 0, 0, 255), 0);
    assert_int_equal(tuile_draw_image(canvas, &keyed, 0, 4, 1, 255), 0);
    assert_int_equal(tuile_draw_image(canvas, &grey, 4, 4, 1, 0), 0);
    assert_int_equal(tuile_draw_image(canvas, &grey, 8, 4, 1, 128), 0);
}

/* Half of 0 over 64 is 32 (2), of 255 over 64 160 (10), of 128 over 64 96 (6); alpha 8 of 15 of white over black 136 (9). */
static void images_have_their_texels_keys_and_alpha(void **state) {
    static const char *const rows[] = {".#8...##88..#9..", "#.#.##..##.9.#..", "....##..##......", "................",
                                       "4#8444442a644444", "#4#44444a2a44444", "4444444444444444"};
    (void)state;
    see(draw_images, NULL, 16, 7, false, rows);
}

static void what_is_no_texture_is_refused(void **state) {
    const tuile_texture_t good = {.texels = grey_texels, .width = 3, .height = 2, .format = TUILE_TEXEL_GREY8, .levels = 1};
    tuile_texture_t bad[6];
    tuile_canvas_t canvas = {0};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        bad[i] = good;
    }
    bad[0].texels = NULL;
    bad[1].width = 0;
    bad[2].height = 0;
    bad[3].width = TUILE_TEXTURE_MAX + 1;
    bad[4].format = TUILE_TEXEL_ARGB4444 + 1;
    bad[5].format = TUILE_TEXEL_PALETTE8; /* without a palette */
    assert_int_equal(tuile_draw_image(&canvas, NULL, 0, 0, 1, 255), TUILE_ERROR_ARGUMENT);
    for (unsigned i = 0; i < CHECK_COUNT(bad); i++) {
        assert_int_equal(tuile_draw_image(&canvas, &bad[i], 0, 0, 1, 255), TUILE_ERROR_ARGUMENT);
    }
    assert_int_equal(tuile_draw_image(&canvas, &good, 0, 0, 1, 255), 0);
}

/* ---- blending ---- */

static void fill_all(const void *context, tuile_canvas_t *canvas) {
    tuile_draw_rectangle(canvas, 0, 0, 4, 4, *(const uint32_t *)context);
}

static void fill_window(const void *context, tuile_canvas_t *canvas) {
    tuile_draw_rectangle(canvas, 0, 0, 128, 128, *(const uint32_t *)context);
}

/* Of 0x204060, alpha 64 of 0xff8000: (32 * 191 + 255 * 64 + 127) / 255 = 88.5 -> 88, (64 * 191 + 128 * 64 + 127) / 255 = 80.6 ->
 * 80, (96 * 191 + 127) / 255 = 72.4 -> 72. */
static void alpha_mixes_components_by_hand(void **state) {
    static const uint32_t over = TUILE_ARGB(64, 255, 128, 0), nothing = TUILE_ARGB(0, 255, 255, 255), all = TUILE_COLOUR(1, 2, 3);
    (void)state;
    window_open(&window, 4, 4);
    window.samples[0] = 0x204060;
    window_draw(&window, 4, 4, fill_all, &over);
    assert_int_equal(window.samples[0], 0x585048);
    window_draw(&window, 4, 4, fill_all, &nothing);
    assert_int_equal(window.samples[0], 0x585048);
    window_draw(&window, 4, 4, fill_all, &all);
    assert_int_equal(window.samples[0], 0x010203);
}

/* Half of white over black: 128 of 255. Red and blue have 31 steps: 15.56 -> 16; green 63: 31.6 -> 32; 15 steps: 7.5 -> 8;
 * 7 steps: 3.5 -> 4, 3 steps: 1.5 -> 2. Luminance 65535 * 128 / 255 = 32896. */
static void every_kind_of_sample_is_mixed(void **state) {
    static const uint32_t half = TUILE_ARGB(128, 255, 255, 255);
    static const struct {
        pixel_kind_t kind;
        uint32_t sample;
    } kinds[] = {{PIXEL_RGB565_LE, 0x8410}, {PIXEL_RGB565_BE, 0x1084}, {PIXEL_RGB444, 0x888},
                 {PIXEL_RGB332, 0x92},      {PIXEL_LUMA16, 32896},     {PIXEL_RGB888, 0x808080}};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(kinds); i++) {
        window_open(&window, 4, 4);
        window.kind = kinds[i].kind;
        window_draw(&window, 3, 4, fill_all, &half);
        assert_int_equal(window.samples[0], kinds[i].sample);
        assert_int_equal(window.samples[15], kinds[i].sample);
    }
}

/* All 65536 samples of both byte orders: the fast way of 565 is the way by eight bits a component. */
static void samples_of_565_are_mixed_exactly(void **state) {
    static const uint32_t alphas[] = {1, 2, 85, 127, 128, 200, 253, 254};
    (void)state;
    window_open(&window, 128, 128);
    for (unsigned k = 0; k < 8 * CHECK_COUNT(alphas); k++) {
        const uint32_t alpha = alphas[k / 8], colour = TUILE_ARGB(alpha, k * 37 % 256, 255 - k * 11 % 256, k * 91 % 256);
        window.kind = k & 1 ? PIXEL_RGB565_BE : PIXEL_RGB565_LE;
        for (uint32_t i = 0; i < 16384; i++) {
            window.samples[i] = (k / 2 % 4) * 16384 + i;
        }
        window_draw(&window, 128, 128, fill_window, &colour);
        for (uint32_t i = 0; i < 16384; i++) {
            const uint32_t behind = pixel_unpack(window.kind, (k / 2 % 4) * 16384 + i);
            uint32_t mixed = 0;
            for (unsigned shift = 0; shift < 24; shift += 8) {
                mixed |= ((behind >> shift & 255) * (255 - alpha) + (colour >> shift & 255) * alpha + 127) / 255 << shift;
            }
            assert_int_equal(window.samples[i], pixel_pack(window.kind, mixed));
        }
    }
}

/* ---- whatever the numbers ---- */

static int32_t any(random_source_t *random) {
    static const int32_t extremes[] = {INT32_MIN, INT32_MIN + 1, INT32_MAX, INT32_MAX - 1, 1 << 30, -(1 << 30), 1 << 22, 0, -1, 1};
    const int32_t kind = random_between(random, 0, 9);
    return kind == 0   ? extremes[random_between(random, 0, CHECK_COUNT(extremes) - 1)]
           : kind == 1 ? random_between(random, -100000, 100000)
           : kind < 6  ? random_between(random, -20, 60)
                       : random_between(random, -200, 900);
}

/* Twelve shapes with numbers of any size. context: the seed. */
static void draw_any(const void *context, tuile_canvas_t *canvas) {
    random_source_t random = random_seed(*(const uint64_t *)context);
    const tuile_texture_t grey = {.texels = grey_texels, .width = 3, .height = 2, .format = TUILE_TEXEL_GREY8, .levels = 1};
    for (unsigned i = 0; i < 12; i++) {
        int32_t n[10];
        for (unsigned k = 0; k < 10; k++) {
            n[k] = any(&random);
        }
        const uint32_t colour = (uint32_t)random_between(&random, 0, 0xffffff) |
                                (uint32_t)(random_between(&random, 0, 1) ? 255 : random_between(&random, 0, 255)) << 24;
        const q28_4_t points[5][2] = {{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}, {n[8], n[9]}};
        const tuile_gauge_t gauge = {n[0], n[1], n[2] & 127, n[3], -50, 50, 1, colour, colour, ~colour, colour, NULL};
        canvas->crisp = n[9] & 1;
        switch (random_between(&random, 0, 12)) {
        case 0: tuile_draw_rectangle(canvas, n[0], n[1], n[2], n[3], colour); break;
        case 1: tuile_draw_frame(canvas, n[0], n[1], n[2], n[3], n[4], colour); break;
        case 2: tuile_draw_rounded(canvas, n[0], n[1], n[2], n[3], n[4], colour); break;
        case 3: tuile_draw_line(canvas, n[0], n[1], n[2], n[3], colour); break;
        case 4: tuile_draw_stroke(canvas, n[0], n[1], n[2], n[3], n[4], colour); break;
        case 5: tuile_draw_disc(canvas, n[0], n[1], n[2], colour); break;
        case 6: tuile_draw_ring(canvas, n[0], n[1], n[2], n[3], colour); break;
        case 7: tuile_draw_arc(canvas, n[0], n[1], n[2], n[3], (bam16_t)(n[4] * 77), (bam16_t)(n[5] * 99), colour); break;
        case 8: (void)tuile_draw_polygon(canvas, points, (unsigned)(n[0] & 3) + 2, colour); break;
        case 9: (void)tuile_draw_image(canvas, &grey, n[0], n[1], (unsigned)n[2], (uint8_t)n[3]); break;
        case 10: tuile_draw_pixel(canvas, n[0], n[1], colour); break;
        case 11: tuile_canvas_clip(canvas, n[0] & 15, n[1] & 15, n[2] & 63, n[3] & 63); break;
        default: (void)tuile_draw_gauge(canvas, &gauge); break;
        }
    }
}

static void tiles_do_not_matter_whatever_the_numbers(void **state) {
    static window_t tiled;
    static const int32_t sizes[][2] = {{1, 1}, {7, 5}, {32, 3}, {13, 24}};
    (void)state;
    for (uint64_t seed = 1; seed <= (uint64_t)CHECK_ROUNDS(1600); seed++) {
        window_open(&window, 32, 24);
        window.kind = (pixel_kind_t)(seed % (PIXEL_RGB888 + 1));
        window.shift = (unsigned)(seed % 3);
        tiled = window;
        window_draw(&window, 32, 24, draw_any, &seed);
        window_draw(&tiled, sizes[seed % 4][0], sizes[seed % 4][1], draw_any, &seed);
        if (memcmp(window.samples, tiled.samples, sizeof window.samples) != 0) { fail_msg("seed %u", (unsigned)seed); }
    }
}

/* What is drawn 3 pixels right and 2 down is what was drawn, 3 pixels right and 2 down. */
static void draw_moved(const void *context, tuile_canvas_t *canvas) {
    const int32_t x = ((const int32_t *)context)[0], y = ((const int32_t *)context)[1];
    tuile_draw_disc(canvas, TUILE_PX(x + 8) + 3, TUILE_PX(y + 8) + 5, 77, WHITE);
    tuile_draw_arc(canvas, TUILE_PX(x + 12), TUILE_PX(y + 10), 40, 100, 5000, 40000, TUILE_ARGB(200, 255, 0, 0));
    tuile_draw_stroke(canvas, TUILE_PX(x + 2), TUILE_PX(y + 2) + 7, TUILE_PX(x + 18) + 1, TUILE_PX(y + 13), 40, WHITE);
    tuile_draw_rounded(canvas, x + 3, y + 9, 12, 7, 3, TUILE_ARGB(99, 0, 255, 0));
    tuile_draw_line(canvas, x + 1, y + 14, x + 17, y + 3, WHITE);
}

static void moved_shapes_look_the_same(void **state) {
    static window_t moved;
    static const int32_t here[] = {0, 0}, there[] = {3, 2};
    (void)state;
    for (unsigned shift = 0; shift < 3; shift++) {
        window_open(&window, 24, 20);
        window.shift = shift;
        moved = window;
        window_draw(&window, 24, 20, draw_moved, here);
        window_draw(&moved, 24, 20, draw_moved, there);
        for (int32_t y = 0; y < 18 << shift; y++) {
            for (int32_t x = 0; x < 21 << shift; x++) {
                assert_int_equal(window_at(&window, x, y), window_at(&moved, x + (3 << shift), y + (2 << shift)));
            }
        }
    }
}

/* ---- dials ---- */

static void draw_gauge(const void *context, tuile_canvas_t *canvas) { (void)tuile_draw_gauge(canvas, context); }

static void needles_stay_on_their_dials(void **state) {
    static const tuile_gauge_t good = {.x = 20, .y = 20, .radius = 18, .low = -5, .high = 10, .track = WHITE, .needle = WHITE};
    static const int32_t pairs[][2] = {{-6, -5}, {INT32_MIN, -5}, {11, 10}, {INT32_MAX, 10}};
    static window_t held;
    tuile_gauge_t gauge = good;
    tuile_canvas_t canvas = {0};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(pairs); i++) {
        window_open(&window, 40, 40);
        window_open(&held, 40, 40);
        gauge.value = pairs[i][0];
        window_draw(&window, 40, 40, draw_gauge, &gauge);
        gauge.value = pairs[i][1];
        window_draw(&held, 40, 40, draw_gauge, &gauge);
        assert_memory_equal(window.samples, held.samples, sizeof window.samples);
    }
    /* The lowest value points left below, the highest right below, the one between straight up. */
    gauge.track = 0;
    for (int32_t i = 0; i < 3; i++) {
        static const int32_t values[] = {-5, 10, 2}, tips[][2] = {{12, 28}, {28, 28}, {20, 9}};
        gauge.low = i == 2 ? -6 : -5;
        gauge.value = values[i];
        window_open(&window, 40, 40);
        window_draw(&window, 40, 40, draw_gauge, &gauge);
        assert_int_equal(window_at(&window, tips[i][0], tips[i][1]), 0xffffff);
        assert_int_equal(window_at(&window, 40 - tips[i][0], 40 - tips[i][1]), 0);
    }
    gauge.low = gauge.high;
    assert_int_equal(tuile_draw_gauge(&canvas, &gauge), TUILE_ERROR_ARGUMENT);
    gauge = good;
    gauge.radius = 3;
    assert_int_equal(tuile_draw_gauge(&canvas, &gauge), TUILE_ERROR_ARGUMENT);
    gauge.radius = 1025;
    assert_int_equal(tuile_draw_gauge(&canvas, &gauge), TUILE_ERROR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rectangles_have_their_pixels_and_no_others),
        cmocka_unit_test(frames_draw_no_pixel_twice),
        cmocka_unit_test(clips_hold_what_is_drawn),
        cmocka_unit_test(crisp_discs_are_those_pixels_whose_centres_are_inside),
        cmocka_unit_test(crisp_arcs_have_their_first_ray_and_not_their_last),
        cmocka_unit_test(rounded_rectangles_lose_their_corners),
        cmocka_unit_test(lines_are_bresenhams),
        cmocka_unit_test(polygons_have_the_coverage_of_faces),
        cmocka_unit_test(images_have_their_texels_keys_and_alpha),
        cmocka_unit_test(what_is_no_texture_is_refused),
        cmocka_unit_test(alpha_mixes_components_by_hand),
        cmocka_unit_test(every_kind_of_sample_is_mixed),
        cmocka_unit_test(samples_of_565_are_mixed_exactly),
        cmocka_unit_test(needles_stay_on_their_dials),
        cmocka_unit_test(tiles_do_not_matter_whatever_the_numbers),
        cmocka_unit_test(moved_shapes_look_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
