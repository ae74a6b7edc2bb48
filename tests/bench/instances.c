/* What is counted by `make bench-instances`: one frame of SIDE x SIDE instances of a model on a square of ground, of which the
 * camera in the middle sees some, drawn by bench_frame; or, with `seen`, of those instances alone that are not dropped as a whole.
 * The difference is what instances cost that nobody sees.
 *
 * Usage: instances MODEL SIDE [seen]
 */
#include "../../raster/scene/camera.h"
#include "../../sim/mesh/mesh.h"

#include <stdio.h>
#include <stdlib.h>

#define SIDE_MAX 64
#define PX_WIDE 320
#define PX_HIGH 240

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

static int fail(const char *what) {
    (void)fprintf(stderr, "instances: %s\n", what);
    return 1;
}

/* Bounding spheres of radius 1 at the corners of a grid, four apart. */
static int place(tuile_instance_t *instances, const tuile_model_t *model, int side) {
    tuile_pose_t pose = {.scale = TUILE_SCALE_ONE};
    tuile_sphere_t sphere;
    tuile_rotation(pose.rotation, 1, 0);
    while (tuile_sphere(&sphere, model, &pose) != TUILE_OK || sphere.radius > 1 << 16) {
        pose.scale.exponent--;
    }
    for (int i = 0; i < side * side; i++) {
        tuile_rotation(pose.rotation, 1, (bam16_t)(i * 977));
        pose.translation[0] = (i % side - side / 2) * 4 * 65536;
        pose.translation[2] = (i / side - side / 2) * 4 * 65536;
        instances[i] = (tuile_instance_t){.model = model, .pose = pose};
    }
    return side * side;
}

/* Leaves those that some frame of one instance does not drop. */
static int leave_seen(tuile_t *renderer, tuile_scene_t *scene, tuile_instance_t *instances, int count) {
    int seen = 0;
    scene->instance_count = 1;
    for (int i = 0; i < count; i++) {
        tuile_stats_t stats;
        tuile_tile_t tile;
        int result = 0;
        scene->instances = &instances[i];
        if (tuile_begin(renderer, scene) != TUILE_OK) { return -1; }
        while ((result = tuile_next(renderer, &tile)) == 1) {}
        (void)tuile_end(renderer, &stats);
        if (result < 0) { return -1; }
        if (stats.instances_outside < stats.instances) { instances[seen++] = instances[i]; }
    }
    return seen;
}

int main(int count, char **arguments) {
    static tuile_instance_t instances[SIDE_MAX * SIDE_MAX];
    static const q16_16_t middle[3] = {0, 0, 0};
    static const size_t block_bytes = (size_t)4 << 20;
    const int side = count >= 3 ? atoi(arguments[2]) : 0;
    uint8_t *bytes;
    size_t size_bytes;
    tuile_model_t model;
    tuile_t *renderer;
    tuile_stats_t stats;
    sim_error_t error;
    if (side < 1 || side > SIDE_MAX) { return fail("wants MODEL SIDE, 1 to 64, and perhaps `seen`"); }
    if (mesh_load(arguments[1], 0, NULL, &bytes, &size_bytes, NULL, &error) != 0) { return fail(error.text); }
    if (tuile_model_open(&model, bytes, size_bytes) != TUILE_OK) { return fail("no model"); }
    const tuile_light_t light = {{0, -TUILE_ONE_Q14, 0}, 200};
    tuile_scene_t scene = {.instances = instances, .lights = &light, .light_count = 1, .ambient = 50};
    int placed = place(instances, &model, side);
    tuile_camera_t *camera = &scene.camera;
    camera->focal_x = camera->focal_y = tuile_focal_px(0x2000, PX_WIDE);
    camera->centre_x = PX_WIDE * 32768;
    camera->centre_y = PX_HIGH * 32768;
    camera->near = 1 << 15;
    camera->far = 60 << 16;
    (void)tuile_camera_orbit(camera, middle, 1 << 16, 3000, 2000, 0);
    const tuile_config_t config = {.width = PX_WIDE, .height = PX_HIGH, .tile_height = 24, .corners = model.corners_max};
    void *block = malloc(block_bytes);
    if (!block || tuile_init(&renderer, &config, block, block_bytes, NULL) != TUILE_OK) { return fail("no renderer"); }
    if (count > 3) { placed = leave_seen(renderer, &scene, instances, placed); }
    scene.instances = instances;
    scene.instance_count = (uint16_t)placed;
    if (placed < 0 || bench_frame(renderer, &scene, &stats) != 0) { return fail("cannot be drawn"); }
    (void)printf("instances %u outside %u clusters %u passes %u\n", stats.instances, stats.instances_outside, stats.clusters,
                 stats.passes);
    free(block);
    free(bytes);
    return 0;
}
