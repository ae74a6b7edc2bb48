/* The events that a frame of the bench consists of (sim/predict.h), as sums over its eight frames: what instructions are fitted to.
 * Usage: predict_events MODEL WIDTH HEIGHT TILE_WIDTH TILE_HEIGHT SHADE MEMORY_BYTES, as of tests/bench/bench.c
 *
 * Or those of the Uno's frames, a line for each: predict_events scene NAME MODEL.tuile METHOD TILE_WIDTH
 */
#include "../../firmware/scenes.h"
#include "../../firmware/uno/tell.h"
#include "../../sim/mesh/mesh.h"
#include "../../sim/predict.h"
#include "../bench/turntable.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int frame(tuile_t *renderer, const tuile_scene_t *scene, predict_meter_t *meter, predict_events_t *sum) {
    tuile_tile_t tile;
    predict_meter_begin(meter);
    int result = tuile_begin(renderer, scene);
    if (result) { return result; }
    while ((result = tuile_next(renderer, &tile)) == 1) {
        const predict_events_t events = predict_meter_take(meter);
        for (unsigned i = 0; i < PREDICT_EVENT_COUNT; i++) {
            sum->count[i] += events.count[i];
        }
    }
    (void)tuile_end(renderer, NULL);
    return result;
}

static void print(const char *before, const predict_events_t *events) {
    (void)printf("%s", before);
    for (unsigned i = 0; i < PREDICT_EVENT_COUNT; i++) {
        (void)printf(" %" PRIu64, events->count[i]);
    }
    (void)printf("\n");
}

static int uno(const char *name, const char *path, const char *method, const char *tile_width) {
    static scene_stage_t stage;
    static predict_meter_t meter;
    static _Alignas(8) uint8_t block[262144];
    const scene_script_t *script = scene_find(name);
    sim_error_t error = {""};
    mesh_report_t report;
    uint8_t *bytes;
    size_t size_bytes;
    tuile_t *renderer;
    if (!script || mesh_load(path, 0, NULL, &bytes, &size_bytes, &report, &error) != 0) {
        (void)fprintf(stderr, "predict_events: %s: %s\n", name, error.text);
        return 1;
    }
    predict_meter_open(&meter);
    tuile_config_t config = {.width = 128,
                             .height = 64,
                             .tile_width = (uint16_t)atoi(tile_width),
                             .tile_height = 8,
                             .format = TUILE_MONO_PAGES,
                             .method = strcmp(method, "tree") == 0 ? TUILE_TREE : TUILE_ZBUFFER,
                             .trace = &meter.trace};
    int result = scene_open(&stage, script, bytes, size_bytes, config.width, config.height);
    scene_configure(&stage, &config);
    if (!result) { result = tuile_init(&renderer, &config, block, sizeof block, NULL); }
    if (!result) { meter.renderer = renderer; }
    for (unsigned i = 0; i < UNO_FRAMES && !result; i++) {
        predict_events_t events = {{0}};
        result = scene_frame(&stage, i * UNO_STEP);
        if (!result) { result = frame(renderer, &stage.scene, &meter, &events); }
        if (!result) { print("events", &events); }
    }
    if (result) { (void)fprintf(stderr, "predict_events: %s\n", tuile_error_text(result)); }
    free(bytes);
    return result != 0;
}

int main(int count, char **arguments) {
    static view_t view;
    static tuile_model_t model;
    static predict_meter_t meter;
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes;
    mesh_report_t report;
    predict_events_t sum = {{0}};
    tuile_t *renderer;
    if (count == 6 && strcmp(arguments[1], "scene") == 0) { return uno(arguments[2], arguments[3], arguments[4], arguments[5]); }
    if (count != 8) { return 2; }
    if (mesh_load(arguments[1], 0, NULL, &bytes, &size_bytes, &report, &error) != 0 ||
        tuile_model_open(&model, bytes, size_bytes) != 0) {
        (void)fprintf(stderr, "predict_events: %s\n", error.text);
        return 1;
    }
    predict_meter_open(&meter);
    const tuile_config_t config = {.width = (uint16_t)atoi(arguments[2]),
                                   .height = (uint16_t)atoi(arguments[3]),
                                   .tile_width = (uint16_t)atoi(arguments[4]),
                                   .tile_height = (uint16_t)atoi(arguments[5]),
                                   .shade = strstr(arguments[6], "gouraud") ? TUILE_GOURAUD : TUILE_FLAT,
                                   .effects = strncmp(arguments[6], "textured-", 9) == 0 ? TUILE_SURFACES : 0,
                                   .cluster_vertices = model.cluster_vertices_max,
                                   .corners = model.corners_max,
                                   .trace = &meter.trace};
    const size_t memory = (size_t)atol(arguments[7]);
    void *block = malloc(memory);
    if (!block) { return 1; }
    turntable_open(&view, config.width, config.height);
    int result = tuile_init(&renderer, &config, block, memory, NULL);
    if (!result) { meter.renderer = renderer; }
    for (unsigned i = 0; i < TURNTABLE_FRAMES && !result; i++) {
        turntable_place(&view.instance, &model, i);
        result = frame(renderer, &view.scene, &meter, &sum);
    }
    if (result) {
        (void)fprintf(stderr, "predict_events: %s\n", tuile_error_text(result));
        return 1;
    }
    print("events", &sum);
    free(block);
    free(bytes);
    return 0;
}
