/* What is counted by `make bench` and `make bench-methods`: eight frames of a turning model, drawn by bench_frame, under callgrind.
 *
 * The scene is that of turntable.h. With EYE, AT and FOV (as of tuile render, model units) the camera stands there and the model
 * turns about AT.
 *
 * All frames are drawn once more, and not counted, for a hash of their pictures. So is the first frame with a trace, for the pixels
 * that its faces cover, and in a block of as many bytes as the figures say that it needs, to see that it does.
 *
 * Usage: bench MODEL WIDTH HEIGHT TILE_WIDTH TILE_HEIGHT SHADE MEMORY_BYTES [METHOD [VARIANT [EYE AT FOV]]]
 * SHADE: flat, gouraud, textured-flat, textured-gouraud (the model's textures, in the same light).
 * METHOD as of tuile render, VARIANT: tuile_warnock_t, a number. Exit code 3: the renderer does not have that method.
 */
#include "../../raster/tuile.h"
#include "../../sim/mesh/mesh.h"
#include "../../sim/options.h"
#include "../../sim/view.h"
#include "turntable.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAMES TURNTABLE_FRAMES
#define EXIT_NO_METHOD 3

/* Callgrind collects in here only; not static, so that its name stays. */
int bench_frame(tuile_t *renderer, const tuile_scene_t *scene, tuile_stats_t *stats);

static inline int frame(tuile_t *renderer, const tuile_scene_t *scene, tuile_stats_t *stats) {
    tuile_tile_t tile;
    int result = tuile_begin(renderer, scene);
    if (result) { return result; }
    while ((result = tuile_next(renderer, &tile)) == 1) {}
    (void)tuile_end(renderer, stats);
    return result;
}

__attribute__((noinline)) int bench_frame(tuile_t *renderer, const tuile_scene_t *scene, tuile_stats_t *stats) {
    return frame(renderer, scene, stats);
}

static int fail(const char *what) {
    (void)fprintf(stderr, "bench: %s\n", what);
    return 1;
}

static bool numbers(const char *text, double *out) { return sscanf(text, "%lf,%lf,%lf", &out[0], &out[1], &out[2]) == 3; }

/* ---- the frames that are not counted -------------------------------------------------------------------------- */

typedef struct cover {
    unsigned width;
    unsigned long covering; /* pixels of all faces */
    unsigned long covered;  /* pixels that some face covers */
    uint8_t *seen;
} cover_t;

static void on_span(void *context, unsigned row, unsigned first, unsigned end) {
    cover_t *cover = context;
    for (unsigned x = first; x < end; x++) {
        uint8_t *seen = &cover->seen[(size_t)row * cover->width + x];
        cover->covering++;
        cover->covered += *seen == 0;
        *seen = 1;
    }
}

static int print_cover(const tuile_config_t *config, const tuile_scene_t *scene, void *block, size_t memory) {
    cover_t cover = {.width = config->width, .seen = calloc(config->width, config->height)};
    const tuile_trace_t trace = {.context = &cover, .span = on_span};
    tuile_config_t traced = *config;
    tuile_t *renderer;
    traced.trace = &trace;
    int result = cover.seen ? tuile_init(&renderer, &traced, block, memory, NULL) : TUILE_ERROR_MEMORY;
    if (!result) { result = frame(renderer, scene, NULL); }
    if (!result) { (void)printf("overdraw %.2f\n", cover.covered ? (double)cover.covering / (double)cover.covered : 0.0); }
    free(cover.seen);
    return result;
}

/* Passes of the frame in a block of so many bytes; negative: an error. */
static int passes_with(const tuile_config_t *config, const tuile_scene_t *scene, void *block, size_t bytes) {
    tuile_t *renderer;
    tuile_stats_t stats;
    int result = tuile_init(&renderer, config, block, bytes, NULL);
    for (int i = 0; i < 2 && !result; i++) { /* the first frame finds out what fits */
        result = frame(renderer, scene, &stats);
    }
    return result ? result : (int)stats.passes;
}

/* ---- the frames that are counted ------------------------------------------------------------------------------ */

typedef struct bench {
    tuile_config_t config;
    tuile_model_t model;
    view_t view;
    bool aimed; /* by EYE, AT and FOV */
    void *block;
    size_t memory;
} bench_t;

static void turn(bench_t *b, unsigned number) {
    if (b->aimed) {
        view_frame(&b->view, number);
    } else {
        turntable_place(&b->view.instance, &b->model, number);
    }
}

/* FNV-1a of the tiles of all frames. */
static int print_hash(bench_t *b) {
    tuile_t *renderer;
    tuile_tile_t tile;
    uint64_t hash = 14695981039346656037u;
    int result = tuile_init(&renderer, &b->config, b->block, b->memory, NULL);
    for (unsigned i = 0; i < FRAMES && !result; i++) {
        turn(b, i);
        result = tuile_begin(renderer, &b->view.scene);
        while (!result && (result = tuile_next(renderer, &tile)) == 1) {
            for (uint32_t at = 0; at < tile.size_bytes; at++) {
                hash = (hash ^ tile.bytes[at]) * 1099511628211u;
            }
            result = 0;
        }
        (void)tuile_end(renderer, NULL);
    }
    (void)printf("hash %016llx\n", (unsigned long long)hash);
    return result;
}

static int run(bench_t *b) {
    const tuile_config_t *config = &b->config;
    unsigned faces = 0, setup = 0, passes = 0, vertices = 0, peak = 0, least = 0, windows = 0, pixels = 0, splits = 0;
    size_t wanted = 0, needs = 0;
    tuile_t *renderer;
    int result = tuile_init(&renderer, config, b->block, b->memory, &wanted);
    if (result) {
        (void)fprintf(stderr, "bench: %s (wants %zu bytes)\n", tuile_error_text(result), wanted);
        return result == TUILE_ERROR_ARGUMENT ? EXIT_NO_METHOD : 1;
    }
    for (unsigned i = 0; i < FRAMES; i++) {
        tuile_stats_t stats;
        turn(b, i);
        result = bench_frame(renderer, &b->view.scene, &stats);
        if (result) { return fail(tuile_error_text(result)); }
        faces = stats.faces;
        setup += stats.faces_setup;
        vertices += stats.vertices;
        passes += stats.passes;
        windows += stats.windows;
        pixels += stats.windows_pixels;
        splits += stats.splits;
        least = stats.least_bytes;
        if (i == 0) { needs = stats.peak_bytes > least ? stats.peak_bytes : least; }
        peak = stats.peak_bytes > peak ? stats.peak_bytes : peak;
    }
    if (config->method == TUILE_WARNOCK) { (void)printf("windows %u pixels %u\n", windows / FRAMES, pixels / FRAMES); }
    if (config->method == TUILE_PAINTER) { (void)printf("splits %u\n", splits / FRAMES); }
    (void)printf("faces %u frames %u setup %u vertices %u passes %u peak %u\n", faces, FRAMES, setup / FRAMES, vertices / FRAMES,
                 passes, peak);
    peak = peak > least ? peak : least;
    const size_t colours = (size_t)(config->buffers ? config->buffers : 2) *
                           TUILE_ALIGN64(TUILE_WIRE_BYTES(config->format, config->tile_width, config->tile_height));
    (void)printf("beside %zu\n", peak - colours); /* the buffers of colours */
    result = print_hash(b);
    if (result) { return fail(tuile_error_text(result)); }
    turn(b, 0);
    result = print_cover(config, &b->view.scene, b->block, b->memory);
    if (result) { return fail(tuile_error_text(result)); }
    result = passes_with(config, &b->view.scene, b->block, needs);
    if (result > 1 && passes == FRAMES) { (void)printf("needs more than %zu: %d passes\n", needs, result); }
    if (result == TUILE_ERROR_MEMORY && config->method == TUILE_PAINTER) { /* how often it cuts cannot be foreseen */
        (void)printf("needs more than %zu\n", needs);
        result = 0;
    }
    return result < 0 ? fail(tuile_error_text(result)) : 0;
}

int main(int count, char **arguments) {
    if (count < 8 || count == 11 || count == 12 || count > 13) {
        (void)fprintf(stderr, "bench MODEL WIDTH HEIGHT TILE_WIDTH TILE_HEIGHT SHADE MEMORY_BYTES "
                              "[METHOD [VARIANT [EYE AT FOV]]]\n");
        return 2;
    }
    static bench_t b;
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes;
    mesh_report_t report;
    if (mesh_load(arguments[1], 0, NULL, &bytes, &size_bytes, &report, &error) != 0 ||
        tuile_model_open(&b.model, bytes, size_bytes) != 0) {
        return fail(error.text);
    }
    tuile_config_t *config = &b.config;
    config->width = (uint16_t)atoi(arguments[2]);
    config->height = (uint16_t)atoi(arguments[3]);
    config->tile_width = (uint16_t)atoi(arguments[4]);
    config->tile_height = (uint16_t)atoi(arguments[5]);
    config->shade = strstr(arguments[6], "gouraud") != NULL ? TUILE_GOURAUD : TUILE_FLAT;
    config->effects = strncmp(arguments[6], "textured-", 9) == 0 ? TUILE_SURFACES : 0;
    while (count > 8 && options_methods[config->method] && strcmp(options_methods[config->method], arguments[8]) != 0) {
        config->method++;
    }
    config->warnock = (uint8_t)(count > 9 ? atoi(arguments[9]) : 0);
    config->cluster_vertices = b.model.cluster_vertices_max;
    config->corners = b.model.corners_max;
    config->tree_depth = b.model.tree_depth;
    b.memory = (size_t)atol(arguments[7]);
    b.block = malloc(b.memory);
    if (!b.block) { return fail("out of memory"); }
    b.aimed = count > 10;
    if (b.aimed) {
        view_options_t o = VIEW_OPTIONS_DEFAULT;
        o.has_eye = o.has_at = true;
        o.fov = atof(arguments[12]);
        if (!numbers(arguments[10], o.eye) || !numbers(arguments[11], o.at)) { return fail("EYE and AT are three numbers each"); }
        if (view_make(&b.view, &o, &b.model, config->width, config->height, FRAMES, &error) != 0) { return fail(error.text); }
    } else {
        turntable_open(&b.view, config->width, config->height);
    }
    const int status = run(&b);
    free(b.block);
    free(bytes);
    return status;
}
