/* What is counted by `make bench`: eight frames of a turning model, drawn by bench_frame, under callgrind.
 *
 * The scene: camera at the origin looking along -z, vertical field of view 45 degrees, near 1, far 10; the model turned about y by
 * i * 360 / 64 degrees and moved to (0, 0, -3); one directional light along (-0.4, -0.6, -1), ambient 0.15, diffuse 0.75. A model
 * whose bounding sphere is not about 1 in radius is centred and scaled to 1, and the output says so.
 *
 * Usage: bench MODEL WIDTH HEIGHT TILE_WIDTH TILE_HEIGHT flat|gouraud MEMORY_BYTES [METHOD]
 */
#include "../../raster/tuile.h"
#include "../../sim/mesh/mesh.h"
#include "../../sim/options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAMES 8

/* Callgrind collects in here only; not static, so that its name stays. */
int bench_frame(tuile_t *renderer, const tuile_scene_t *scene, tuile_stats_t *stats);

__attribute__((noinline)) int bench_frame(tuile_t *renderer, const tuile_scene_t *scene, tuile_stats_t *stats) {
    tuile_tile_t tile;
    int result = tuile_begin(renderer, scene);
    if (result) { return result; }
    while ((result = tuile_next(renderer, &tile)) == 1) {}
    (void)tuile_end(renderer, stats);
    return result;
}

static void place(tuile_instance_t *instance, const tuile_model_t *model, unsigned frame) {
    const double step = ldexp((double)model->step.mantissa, model->step.exponent), radius = step * model->radius;
    const bool as_it_is = radius > 0.5 && radius < 1.9;
    const double scale = as_it_is ? 1.0 : 1.0 / radius;
    int exponent;
    const double mantissa = frexp(scale, &exponent);
    double centre[3] = {0, 0, 0};

    instance->model = model;
    instance->pose.scale = (tuile_scale_t){(uint32_t)ldexp(mantissa, 31), exponent - 31};
    if (as_it_is) { instance->pose.scale = TUILE_SCALE_ONE; }
    tuile_rotation(instance->pose.rotation, 1, (bam16_t)(frame * 1024u));
    for (int i = 0; i < 3 && !as_it_is; i++) {
        centre[i] = scale * step * (model->offset[i] + (double)model->centre[i]);
    }
    for (int i = 0; i < 3; i++) {
        double at = i == 2 ? -3.0 : 0.0;
        for (int j = 0; j < 3; j++) {
            at -= instance->pose.rotation[i][j] / (double)TUILE_ONE_Q30 * centre[j];
        }
        instance->pose.translation[i] = TUILE_Q16(at);
    }
    if (frame == 0 && !as_it_is) { (void)printf("scaled by %g\n", scale); }
}

int main(int count, char **arguments) {
    if (count != 8 && count != 9) {
        (void)fprintf(stderr, "bench MODEL WIDTH HEIGHT TILE_WIDTH TILE_HEIGHT flat|gouraud MEMORY_BYTES [METHOD]\n");
        return 2;
    }
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes, wanted = 0;
    mesh_report_t report;
    tuile_model_t model;
    tuile_t *renderer;
    if (mesh_load(arguments[1], 0, &bytes, &size_bytes, &report, &error) != 0 || tuile_model_open(&model, bytes, size_bytes) != 0) {
        (void)fprintf(stderr, "bench: %s\n", error.text);
        return 1;
    }
    tuile_config_t config = {0};
    config.width = (uint16_t)atoi(arguments[2]);
    config.height = (uint16_t)atoi(arguments[3]);
    config.tile_width = (uint16_t)atoi(arguments[4]);
    config.tile_height = (uint16_t)atoi(arguments[5]);
    config.shade = strcmp(arguments[6], "gouraud") == 0 ? TUILE_GOURAUD : TUILE_FLAT;
    for (int m = 0; count == 9 && options_methods[m] != NULL; m++) {
        if (strcmp(arguments[8], options_methods[m]) == 0) { config.method = (uint8_t)m; }
    }
    config.cluster_vertices = model.cluster_vertices_max;
    config.corners = model.corners_max;
    const size_t memory = (size_t)atol(arguments[7]);
    void *block = malloc(memory);
    int result = block ? tuile_init(&renderer, &config, block, memory, &wanted) : TUILE_ERROR_MEMORY;
    if (result) {
        (void)fprintf(stderr, "bench: %s (wants %zu bytes)\n", tuile_error_text(result), wanted);
        return 1;
    }

    const double length = sqrt(0.4 * 0.4 + 0.6 * 0.6 + 1.0);
    const tuile_light_t light = {
        {(q2_14_t)lround(-0.4 / length * 16384), (q2_14_t)lround(-0.6 / length * 16384), (q2_14_t)lround(-1 / length * 16384)},
        191};
    tuile_instance_t instance = {0};
    tuile_scene_t scene = {.instances = &instance, .instance_count = 1, .lights = &light, .light_count = 1, .ambient = 38};
    static const q16_16_t eye[3] = {0, 0, 0}, at[3] = {0, 0, -65536}, up[3] = {0, 65536, 0};
    (void)tuile_camera_look_at(&scene.camera, eye, at, up);
    scene.camera.focal_x = scene.camera.focal_y = tuile_focal_px(8192, config.height);
    scene.camera.centre_x = config.width * 32768;
    scene.camera.centre_y = config.height * 32768;
    scene.camera.near = 65536;
    scene.camera.far = 655360;

    unsigned faces = 0, setup = 0, passes = 0, vertices = 0, peak = 0, compared = 0, moved = 0, splits = 0;
    for (unsigned frame = 0; frame < 64; frame += 64 / FRAMES) {
        tuile_stats_t stats;
        place(&instance, &model, frame);
        result = bench_frame(renderer, &scene, &stats);
        if (result) {
            (void)fprintf(stderr, "bench: %s\n", tuile_error_text(result));
            return 1;
        }
        faces = stats.faces;
        setup += stats.faces_setup;
        vertices += stats.vertices;
        passes += stats.passes;
        compared += stats.compared;
        moved += stats.moved;
        splits += stats.splits;
        peak = stats.peak_bytes > peak ? stats.peak_bytes : peak;
    }
    (void)printf("faces %u frames %u setup %u vertices %u passes %u peak %u\n", faces, FRAMES, setup / FRAMES, vertices / FRAMES,
                 passes, peak);
    if (config.method == TUILE_PAINTER) {
        (void)printf("compared %u moved %u splits %u\n", compared / FRAMES, moved / FRAMES, splits / FRAMES);
    }
    free(block);
    free(bytes);
    return 0;
}
