/* Each view draws the frame twice with a trace: once for its colours, once for the ids of its faces, and paints what it learnt over
 * the darkened picture. */
#include "show.h"

#include "options.h"
#include "show_paint.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK_BYTES ((size_t)32 << 20)
#define PLOT_PX 96u /* width of the plot beside the picture */

typedef struct window {
    uint16_t left, top, right, bottom;
    uint8_t why;
} window_t;

typedef struct tile {
    uint16_t left, top, right, bottom;
    uint32_t faces;
} tile_t;

typedef struct watch {
    unsigned width, height;
    bool failed;
    uint8_t *rgb;    /* of the frame */
    uint32_t *ids;   /* of the frame */
    uint32_t *cover; /* faces that cover each pixel */
    uint32_t *last;  /* number + 1 of the last one */
    uint32_t *edges; /* on each line */
    uint32_t number, number_max;
    bool counts; /* the second frame tells nothing new */
    tile_t *tiles;
    size_t tile_count, tile_capacity;
    window_t *windows;
    size_t window_count, window_capacity;
} watch_t;

/* The array with room for `count` items; NULL when there is none, and the array stays. */
static void *reserve(void *array, size_t *capacity, size_t count, size_t item_bytes) {
    if (count <= *capacity) { return array; }
    void *grown = realloc(array, 2 * count * item_bytes);
    if (grown) { *capacity = 2 * count; }
    return grown;
}

static void on_tile(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom) {
    watch_t *w = context;
    if (!w->counts || w->failed) { return; }
    tile_t *tiles = reserve(w->tiles, &w->tile_capacity, w->tile_count + 1, sizeof *w->tiles);
    w->failed = !tiles;
    if (tiles) {
        w->tiles = tiles;
        tiles[w->tile_count++] = (tile_t){(uint16_t)left, (uint16_t)top, (uint16_t)right, (uint16_t)bottom, 0};
    }
}

static void on_face(void *context, uint32_t number, uint32_t id) {
    watch_t *w = context;
    (void)id;
    w->number = number + 1;
    w->number_max = number + 1 > w->number_max ? number + 1 : w->number_max;
}

static void on_span(void *context, unsigned row, unsigned first, unsigned end) {
    watch_t *w = context;
    if (!w->counts || w->failed) { return; }
    tile_t *tile = &w->tiles[w->tile_count - 1];
    if (tile->faces == 0 || w->number != w->last[(size_t)w->width * w->height]) { tile->faces++; }
    w->last[(size_t)w->width * w->height] = w->number; /* behind the picture: the face counted last */
    w->edges[row] += 2;
    for (unsigned x = first; x < end; x++) {
        w->cover[(size_t)row * w->width + x]++;
        w->last[(size_t)row * w->width + x] = w->number;
    }
}

static void on_window(void *context, unsigned left, unsigned top, unsigned right, unsigned bottom, unsigned why) {
    watch_t *w = context;
    if (!w->counts || w->failed) { return; }
    window_t *windows = reserve(w->windows, &w->window_capacity, w->window_count + 1, sizeof *w->windows);
    w->failed = !windows;
    if (windows) {
        w->windows = windows;
        windows[w->window_count++] = (window_t){(uint16_t)left, (uint16_t)top, (uint16_t)right, (uint16_t)bottom, (uint8_t)why};
    }
}

static int watch_open(watch_t *w, unsigned width, unsigned height, sim_error_t *error) {
    const size_t pixels = (size_t)width * height;
    memset(w, 0, sizeof *w);
    w->width = width;
    w->height = height;
    w->rgb = calloc(pixels, 3);
    w->ids = calloc(pixels, sizeof *w->ids);
    w->cover = calloc(pixels, sizeof *w->cover);
    w->last = calloc(pixels + 1, sizeof *w->last);
    w->edges = calloc(height, sizeof *w->edges);
    return w->rgb && w->ids && w->cover && w->last && w->edges ? 0 : sim_fail(error, "out of memory");
}

static void watch_close(watch_t *w) {
    free(w->rgb);
    free(w->ids);
    free(w->cover);
    free(w->last);
    free(w->edges);
    free(w->tiles);
    free(w->windows);
}

static void paste(watch_t *w, const tuile_tile_t *tile, bool ids) {
    for (unsigned y = 0; y < tile->height; y++) {
        for (unsigned x = 0; x < tile->width; x++) {
            const size_t from = (size_t)y * tile->width + x, to = (size_t)(tile->y + y) * w->width + tile->x + x;
            if (ids) {
                memcpy(&w->ids[to], tile->bytes + 4 * from, 4);
                continue;
            }
            const unsigned c = tile->bytes[2 * from] | (unsigned)tile->bytes[2 * from + 1] << 8;
            w->rgb[3 * to] = (uint8_t)((c >> 11) * 255 / 31);
            w->rgb[3 * to + 1] = (uint8_t)((c >> 5 & 63) * 255 / 63);
            w->rgb[3 * to + 2] = (uint8_t)((c & 31) * 255 / 31);
        }
    }
}

static int draw(watch_t *w, const tuile_config_t *config, const tuile_scene_t *scene, void *block, tuile_stats_t *stats,
                sim_error_t *error) {
    tuile_t *renderer;
    tuile_tile_t tile;
    size_t wanted;
    int result = tuile_init(&renderer, config, block, BLOCK_BYTES, &wanted);
    if (result == 0) { result = tuile_begin(renderer, scene); }
    if (result) { return sim_fail(error, "--show: %s", tuile_error_text(result)); }
    while ((result = tuile_next(renderer, &tile)) == 1) {
        paste(w, &tile, config->format == TUILE_FACE_IDS);
    }
    (void)tuile_end(renderer, stats);
    if (w->failed) { return sim_fail(error, "out of memory"); }
    return result < 0 ? sim_fail(error, "--show: %s", tuile_error_text(result)) : 0;
}

/* ---- pictures ---------------------------------------------------------------------------------------------- */

/* The frame, its light divided. */
static void backdrop(const watch_t *w, const paint_t *p, unsigned divisor) {
    for (unsigned y = 0; y < w->height; y++) {
        for (unsigned x = 0; x < w->width; x++) {
            uint8_t rgb[3];
            for (unsigned k = 0; k < 3; k++) {
                rgb[k] = (uint8_t)(w->rgb[3 * ((size_t)y * w->width + x) + k] / divisor);
            }
            paint_pixel(p, x, y, rgb);
        }
    }
}

static void show_overdraw(const watch_t *w, const paint_t *p, char *summary, size_t size) {
    uint64_t sum = 0, covered = 0;
    uint32_t most = 1;
    for (size_t i = 0; i < (size_t)w->width * w->height; i++) {
        sum += w->cover[i];
        covered += w->cover[i] > 0;
        most = w->cover[i] > most ? w->cover[i] : most;
    }
    for (unsigned y = 0; y < w->height; y++) {
        for (unsigned x = 0; x < w->width; x++) {
            uint8_t rgb[3];
            const size_t at = (size_t)y * w->width + x;
            const bool border =
                (x + 1 < w->width && w->ids[at] != w->ids[at + 1]) || (y + 1 < w->height && w->ids[at] != w->ids[at + w->width]);
            paint_heat((double)w->cover[at] / (most < 4 ? 4 : most), rgb);
            for (unsigned k = 0; border && k < 3; k++) { /* the faces seen, darker round their borders */
                rgb[k] = (uint8_t)(rgb[k] / 2);
            }
            paint_pixel(p, x, y, rgb);
        }
    }
    for (uint32_t n = 0; n <= most && n < 10; n++) { /* the colours' meaning */
        uint8_t rgb[3];
        const unsigned left = 2 + 14 * n, top = w->height > 12 ? w->height - 11 : 0;
        paint_heat((double)n / (most < 4 ? 4 : most), rgb);
        for (unsigned i = 0; i < 13 * 9; i++) {
            paint_pixel(p, left + i % 13, top + i / 13, rgb);
        }
        paint_outline(p, left, top, left + 13, top + 9, (const uint8_t[3]){160, 160, 160});
        paint_number(p, left + 4, top + 1, n);
    }
    (void)snprintf(summary, size, "overdraw: %.2f faces a covered pixel, %u at most; %llu pixels drawn for %llu seen",
                   covered ? (double)sum / (double)covered : 0.0, most, (unsigned long long)sum, (unsigned long long)covered);
}

static void show_tiles(const watch_t *w, const paint_t *p, char *summary, size_t size) {
    static const uint8_t line[3] = {96, 96, 96};
    uint32_t most = 1;
    uint64_t sum = 0;
    for (size_t i = 0; i < w->tile_count; i++) {
        most = w->tiles[i].faces > most ? w->tiles[i].faces : most;
        sum += w->tiles[i].faces;
    }
    for (size_t i = 0; i < w->tile_count; i++) {
        const tile_t *tile = &w->tiles[i];
        uint8_t rgb[3];
        paint_heat((double)tile->faces / most, rgb);
        for (unsigned y = tile->top * p->zoom; y < tile->bottom * p->zoom; y++) {
            for (unsigned x = tile->left * p->zoom; x < tile->right * p->zoom; x++) {
                uint8_t *at = sim_picture_at(p->picture, x, y);
                for (unsigned k = 0; k < 3; k++) {
                    at[k] = (uint8_t)((at[k] + rgb[k]) / 2);
                }
            }
        }
        paint_outline(p, tile->left, tile->top, tile->right, tile->bottom, line);
        if (tile->bottom - tile->top > (int)PAINT_NUMBER_HEIGHT && tile->right - tile->left > 13) {
            paint_number(p, tile->left + 1u, tile->top + 1u, tile->faces);
        }
    }
    (void)snprintf(summary, size, "tiles: %zu, with %.1f faces each, %u at most", w->tile_count,
                   w->tile_count ? (double)sum / (double)w->tile_count : 0.0, most);
}

static void show_edges(const watch_t *w, const paint_t *p, char *summary, size_t size) {
    static const uint8_t bar[3] = {248, 176, 40}, rule[3] = {64, 64, 64};
    uint32_t most = 1;
    uint64_t sum = 0;
    for (unsigned y = 0; y < w->height; y++) {
        most = w->edges[y] > most ? w->edges[y] : most;
        sum += w->edges[y];
    }
    for (unsigned y = 0; y < w->height * p->zoom; y++) {
        const unsigned length = (unsigned)((uint64_t)w->edges[y / p->zoom] * (PLOT_PX * p->zoom - 1) / most);
        for (unsigned x = 0; x < PLOT_PX * p->zoom; x++) {
            paint_point(p, w->width * p->zoom + x, y, x == 0 ? rule : x <= length ? bar : (const uint8_t[3]){16, 16, 16});
        }
    }
    for (unsigned n = 0; n <= most; n += most > 40 ? 20 : most > 12 ? 4 : 2) {
        const unsigned x = w->width * p->zoom + (unsigned)((uint64_t)n * (PLOT_PX * p->zoom - 1) / most);
        for (unsigned y = 0; y < w->height * p->zoom; y++) {
            paint_point(p, x, y, rule);
        }
        paint_number(p, w->width + n * (PLOT_PX - 1) / most, w->height, n);
    }
    (void)snprintf(summary, size, "active edges: %.1f a line, %u at most", (double)sum / w->height, most);
}

static void show_windows(const watch_t *w, const paint_t *p, char *summary, size_t size) {
    static const uint8_t colours[4][3] = {{72, 72, 88}, {72, 200, 96}, {64, 144, 255}, {0, 0, 0}}; /* tuile_why_t */
    unsigned count[4] = {0};
    for (size_t i = 0; i < w->window_count; i++) {
        const window_t *window = &w->windows[i];
        if (window->why == TUILE_WHY_PIXEL) { /* too many for outlines */
            uint8_t *rgb = sim_picture_at(p->picture, window->left * p->zoom, window->top * p->zoom);
            const uint8_t tint[3] = {(uint8_t)(160 + rgb[0] / 2), (uint8_t)(32 + rgb[1] / 2), (uint8_t)(32 + rgb[2] / 2)};
            paint_pixel(p, window->left, window->top, tint);
            count[TUILE_WHY_PIXEL]++;
            continue;
        }
        paint_outline(p, window->left, window->top, window->right, window->bottom, colours[window->why & 3]);
        count[window->why & 3]++;
    }
    (void)snprintf(summary, size, "windows: %u empty (grey), %u single (green), %u surrounded (blue), %u pixels (red)", count[0],
                   count[1], count[2], count[3]);
}

/* A pixel and its neighbour belong to pieces of one face. */
static bool is_cut(const watch_t *w, const tuile_model_t *model, size_t a, size_t b) {
    if (w->ids[a] == 0 || w->ids[b] == 0 || w->last[a] == w->last[b]) { return false; }
    return w->ids[a] == w->ids[b] || tuile_model_source_face(model, w->ids[a] - 1) == tuile_model_source_face(model, w->ids[b] - 1);
}

#define LABEL_PX 100u /* pixels of a face that its number is worth */

/* Each face's number at the pixel seen of it that is nearest to the middle of all seen of it. */
static bool number_faces(const watch_t *w, const paint_t *p) {
    typedef struct seen {
        uint64_t x, y, distance;
        uint32_t count, nearest;
    } seen_t;
    seen_t *seen = calloc((size_t)w->number_max + 1, sizeof *seen);
    if (!seen) { return false; }
    for (uint32_t at = 0; at < w->width * w->height; at++) {
        seen_t *face = &seen[w->last[at]];
        face->x += at % w->width;
        face->y += at / w->width;
        face->count++;
        face->distance = UINT64_MAX;
    }
    for (uint32_t at = 0; at < w->width * w->height; at++) {
        seen_t *face = &seen[w->last[at]];
        const int64_t x = (int64_t)(at % w->width) - (int64_t)(face->x / face->count),
                      y = (int64_t)(at / w->width) - (int64_t)(face->y / face->count);
        const uint64_t distance = (uint64_t)(x * x + y * y);
        if (distance >= face->distance) { continue; }
        face->distance = distance;
        face->nearest = at;
    }
    for (uint32_t number = 1; number <= w->number_max; number++) {
        const uint32_t x = seen[number].nearest % w->width, y = seen[number].nearest / w->width,
                       half = paint_number_width(number) / 2;
        if (seen[number].count < LABEL_PX) { continue; }
        paint_number(p, x > half ? x - half : 0, y > 3 ? y - 3 : 0, number);
    }
    free(seen);
    return true;
}

static bool show_order(const watch_t *w, const tuile_model_t *model, const paint_t *p, char *summary, size_t size,
                       const tuile_stats_t *stats) {
    static const uint8_t white[3] = {255, 255, 255};
    for (unsigned y = 0; y < w->height; y++) {
        for (unsigned x = 0; x < w->width; x++) {
            uint8_t rgb[3] = {0, 0, 0};
            const size_t at = (size_t)y * w->width + x;
            if (w->last[at]) { paint_heat(0.1 + 0.8 * w->last[at] / w->number_max, rgb); }
            paint_pixel(p, x, y, rgb);
        }
    }
    for (unsigned y = 0; y + 1 < w->height; y++) {
        for (unsigned x = 0; x + 1 < w->width; x++) {
            const size_t at = (size_t)y * w->width + x;
            const bool right = is_cut(w, model, at, at + 1), down = is_cut(w, model, at, at + w->width);
            for (unsigned i = 0; i < p->zoom; i++) {
                if (right) { paint_point(p, (x + 1) * p->zoom - 1, y * p->zoom + i, white); }
                if (down) { paint_point(p, x * p->zoom + i, (y + 1) * p->zoom - 1, white); }
            }
        }
    }
    (void)snprintf(summary, size,
                   "order: %u faces from back (dark) to front (bright), cuts in white; %u splits in this frame, %u tree nodes",
                   w->number_max, stats->splits, stats->nodes);
    return number_faces(w, p);
}

/* ---- views ------------------------------------------------------------------------------------------------- */

static const char *const kinds[] = {"overdraw", "tiles", "edges", "windows", "order", NULL};

/* What can be seen of a method: bits of show_kind_t. */
static unsigned views_of(tuile_method_t method) {
    const unsigned always = 1u << SHOW_OVERDRAW | 1u << SHOW_TILES;
    switch (method) {
    case TUILE_SCANLINE: return always | 1u << SHOW_EDGES;
    case TUILE_WARNOCK: return 1u << SHOW_TILES | 1u << SHOW_WINDOWS;
    case TUILE_PAINTER:
    case TUILE_TREE: return always | 1u << SHOW_ORDER;
    case TUILE_ZBUFFER:
    default: return always;
    }
}

int show_parse(const char *text, show_view_t *view, sim_error_t *error) {
    char list[512] = "";
    for (unsigned m = 0; options_methods[m]; m++) {
        for (unsigned k = 0; kinds[k]; k++) {
            char name[48];
            if (!(views_of((tuile_method_t)m) >> k & 1u)) { continue; }
            (void)snprintf(name, sizeof name, "%s-%s", options_methods[m], kinds[k]);
            if (strcmp(name, text) == 0) {
                *view = (show_view_t){(tuile_method_t)m, (show_kind_t)k};
                return 0;
            }
            (void)snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", list[0] ? ", " : "", name);
        }
    }
    return sim_fail(error, "--show %s: the views are %s", text, list);
}

int show_draw(const show_view_t *view, const tuile_config_t *config, const tuile_scene_t *scene, const tuile_model_t *model,
              unsigned zoom, sim_picture_t *out, char *summary, size_t summary_size, sim_error_t *error) {
    watch_t w;
    const tuile_trace_t trace = {&w, on_tile, on_face, on_span, on_window};
    tuile_config_t c = *config;
    tuile_stats_t stats = {0};
    void *block = malloc(BLOCK_BYTES);
    int status = watch_open(&w, config->width, config->height, error);
    if (!status && !block) { status = sim_fail(error, "out of memory"); }
    c.method = (uint8_t)view->method;
    c.trace = &trace;
    c.aa = TUILE_AA_NONE;
    c.dither = false;
    c.effects = 0;
    c.format = TUILE_FACE_IDS;
    c.overlay = NULL;
    if (!status) { status = draw(&w, &c, scene, block, &stats, error); }
    c.format = TUILE_RGB565_LE;
    w.counts = true;
    if (!status) { status = draw(&w, &c, scene, block, &stats, error); }
    if (!status) {
        const unsigned plot = view->kind == SHOW_EDGES ? PLOT_PX : 0;
        status = sim_picture_create(out, (w.width + plot) * zoom, w.height * zoom, error);
    }
    const paint_t p = {out, zoom};
    if (!status) {
        backdrop(&w, &p, view->kind == SHOW_EDGES ? 1 : 2);
        switch (view->kind) {
        case SHOW_OVERDRAW: show_overdraw(&w, &p, summary, summary_size); break;
        case SHOW_TILES: show_tiles(&w, &p, summary, summary_size); break;
        case SHOW_EDGES: show_edges(&w, &p, summary, summary_size); break;
        case SHOW_WINDOWS: show_windows(&w, &p, summary, summary_size); break;
        case SHOW_ORDER:
            if (!show_order(&w, model, &p, summary, summary_size, &stats)) { status = sim_fail(error, "out of memory"); }
            break;
        }
    }
    free(block);
    watch_close(&w);
    return status;
}
