/* The scene of the bench for a guest that has no floating point: its poses and camera as C, and the compiled model.
 * Usage: guest_scene MODEL WIDTH HEIGHT MODEL.tuile SCENE.h
 */
#include "../../../raster/tuile.h"
#include "../../../sim/mesh/mesh.h"
#include "../turntable.h"

#include <stdio.h>
#include <stdlib.h>

static void print_numbers(FILE *file, const q2_30_t *numbers, int count) {
    for (int i = 0; i < count; i++) {
        (void)fprintf(file, "%s%ld", i ? ", " : "", (long)numbers[i]);
    }
}

static void print_instance(FILE *file, const tuile_instance_t *instance) {
    (void)fprintf(file, "    {.model = &model, .pose = {.rotation = {{");
    for (int i = 0; i < 3; i++) {
        print_numbers(file, instance->pose.rotation[i], 3);
        (void)fprintf(file, i < 2 ? "}, {" : "}}, ");
    }
    (void)fprintf(file, ".scale = {%luu, %d}, .translation = {", (unsigned long)instance->pose.scale.mantissa,
                  (int)instance->pose.scale.exponent);
    print_numbers(file, instance->pose.translation, 3);
    (void)fprintf(file, "}}},\n");
}

static void print_camera(FILE *file, const tuile_camera_t *c) {
    (void)fprintf(file, "static const tuile_camera_t scene_camera = {.rotation = {{");
    for (int i = 0; i < 3; i++) {
        print_numbers(file, c->rotation[i], 3);
        (void)fprintf(file, i < 2 ? "}, {" : "}}, ");
    }
    (void)fprintf(file, ".focal_x = %ld, .focal_y = %ld, .centre_x = %ld, .centre_y = %ld, .near = %ld, .far = %ld};\n",
                  (long)c->focal_x, (long)c->focal_y, (long)c->centre_x, (long)c->centre_y, (long)c->near, (long)c->far);
}

int main(int count, char **arguments) {
    static view_t view;
    static tuile_model_t model;
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes;
    mesh_report_t report;
    if (count != 6) { return 2; }
    if (mesh_load(arguments[1], 0, NULL, &bytes, &size_bytes, &report, &error) != 0 ||
        tuile_model_open(&model, bytes, size_bytes) != 0) {
        (void)fprintf(stderr, "guest_scene: %s\n", error.text);
        return 1;
    }
    FILE *compiled = fopen(arguments[4], "wb"), *header = fopen(arguments[5], "w");
    if (!compiled || !header || fwrite(bytes, 1, size_bytes, compiled) != size_bytes || fclose(compiled) != 0) { return 1; }
    turntable_open(&view, (uint16_t)atoi(arguments[2]), (uint16_t)atoi(arguments[3]));
    print_camera(header, &view.scene.camera);
    (void)fprintf(header, "static const tuile_light_t scene_light = {.direction = {%d, %d, %d}, .intensity = %d};\n",
                  view.light.direction[0], view.light.direction[1], view.light.direction[2], view.light.intensity);
    (void)fprintf(
        header, "#define SCENE_AMBIENT %d\n#define SCENE_FRAMES %d\nstatic const tuile_instance_t scene_frames[SCENE_FRAMES] = {\n",
        view.scene.ambient, TURNTABLE_FRAMES);
    for (unsigned i = 0; i < TURNTABLE_FRAMES; i++) {
        turntable_place(&view.instance, &model, i);
        print_instance(header, &view.instance);
    }
    (void)fprintf(header, "};\n#define SCENE_CLUSTER_VERTICES %u\n#define SCENE_CORNERS %u\n#define SCENE_TREE_DEPTH %u\n",
                  model.cluster_vertices_max, model.corners_max, model.tree_depth);
    free(bytes);
    return fclose(header) != 0;
}
