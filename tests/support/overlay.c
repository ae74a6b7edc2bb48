#include "overlay.h"

#include "check.h"

#define MARGIN 16u /* samples */
#define CANARY 0xa5

void window_open(window_t *window, int32_t width, int32_t height) {
    memset(window, 0, sizeof *window);
    window->width = width;
    window->height = height;
    window->kind = PIXEL_RGB888;
}

/* Copies between the window and the samples of a tile. */
static void tile_copy(window_t *window, const tuile_canvas_t *canvas, bool back) {
    const unsigned shift = window->shift;
    const int32_t left = canvas->tile.left << shift, top = canvas->tile.top << shift;
    const int32_t rows = (canvas->tile.bottom << shift) - top;
    for (int32_t i = 0; i < canvas->stride * rows; i++) {
        const int32_t x = left + i % canvas->stride, y = top + i / canvas->stride;
        uint32_t *at = &window->samples[y * (window->width << shift) + x];
        uint16_t *narrow = (uint16_t *)canvas->samples + i;
        uint32_t *wide = (uint32_t *)canvas->samples + i;
        if (pixel_bytes(window->kind) == 4) {
            *(back ? at : wide) = *(back ? wide : at);
        } else if (back) {
            *at = *narrow;
        } else {
            *narrow = (uint16_t)*at;
        }
    }
}

static void draw_tile(window_t *window, tuile_box_t tile, window_draw_fn draw, const void *context) {
    const unsigned shift = window->shift;
    const size_t count = (size_t)(tile.right - tile.left) * (size_t)(tile.bottom - tile.top) << 2 * shift;
    const size_t margin = MARGIN * sizeof(uint32_t), bytes = count * pixel_bytes(window->kind);
    uint8_t *memory = malloc(bytes + 2 * margin + sizeof(uint32_t));
    assert_non_null(memory);
    memset(memory, CANARY, bytes + 2 * margin);
    tuile_canvas_t canvas = {.samples = memory + margin,
                             .stride = (tile.right - tile.left) << shift,
                             .width = (uint16_t)window->width,
                             .height = (uint16_t)window->height,
                             .tile = tile,
                             .clip = {0, 0, window->width, window->height},
                             .kind = (uint8_t)window->kind,
                             .shift = (uint8_t)shift,
                             .crisp = window->crisp};
    tile_copy(window, &canvas, false);
    draw(context, &canvas);
    for (size_t i = 0; i < margin; i++) {
        if (memory[i] != CANARY || memory[margin + bytes + i] != CANARY) { fail_msg("bytes beside the tile were written"); }
    }
    tile_copy(window, &canvas, true);
    window->glyphs_missing += canvas.glyphs_missing;
    free(memory);
}

void window_draw(window_t *window, int32_t tile_width, int32_t tile_height, window_draw_fn draw, const void *context) {
    assert_in_range((window->width * window->height) << 2 * window->shift, 1, WINDOW_SAMPLES_MAX);
    for (int32_t y = 0; y < window->height; y += tile_height) {
        for (int32_t x = 0; x < window->width; x += tile_width) {
            tuile_box_t tile = {x, y, x + tile_width, y + tile_height};
            if (tile.right > window->width) { tile.right = window->width; }
            if (tile.bottom > window->height) { tile.bottom = window->height; }
            draw_tile(window, tile, draw, context);
        }
    }
}

uint32_t window_at(const window_t *window, int32_t x, int32_t y) {
    return window->samples[y * (window->width << window->shift) + x];
}

static char letter(uint32_t rgb) {
    const uint32_t sixteenths = ((rgb & 255u) * 16u + 127u) / 255u;
    return sixteenths == 0 ? '.' : sixteenths == 16 ? '#' : "0123456789abcdef"[sixteenths];
}

bool window_looks(const window_t *window, const char *const *rows) {
    const int32_t width = window->width << window->shift, height = window->height << window->shift;
    bool same = true;
    for (int32_t y = 0; y < height; y++) {
        assert_int_equal(strlen(rows[y]), width);
        for (int32_t x = 0; x < width; x++) {
            same &= letter(window_at(window, x, y)) == rows[y][x];
        }
    }
    for (int32_t y = 0; !same && y < height; y++) {
        char line[129] = "";
        for (int32_t x = 0; x < width; x++) {
            line[x] = letter(window_at(window, x, y));
        }
        print_message("%s   wanted %s\n", line, rows[y]);
    }
    return same;
}
