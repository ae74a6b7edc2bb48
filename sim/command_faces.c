/* tuile faces: the visible face of each pixel of a text scene, drawn by the renderer itself. */
#include "../raster/tuile.h"
#include "commands.h"
#include "ids.h"
#include "options.h"
#include "scene_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "Usage: tuile faces [--method zbuffer|scanline|warnock|painter|tree] [--tile WxH] [--memory 16K] SCENE\n"
    "\n"
    "Prints the ID of the face seen at each pixel, one row of the picture a line; 0 is the background. "
    "SCENE is a text scene, - for\n"
    "standard input.\n";

typedef struct faces {
    scene_text_t scene;
    mesh_t mesh;
    uint8_t *bytes;
    void *block;
    uint32_t *ids;
} faces_t;

static int draw(faces_t *faces, const tuile_config_t *wanted, size_t memory_bytes) {
    scene_quantisation_t quantisation;
    scene_view_t view;
    sim_error_t error = {""};
    tuile_model_t model;
    tuile_instance_t instance = {.model = &model, .two_sided = true};
    tuile_scene_t scene = {.instances = &instance};
    tuile_config_t config = *wanted;
    const mesh_options_t options = scene_text_mesh_options();
    mesh_report_t report;
    size_t size_bytes, least;
    tuile_t *renderer;
    int result;

    if (scene_text_mesh(&faces->scene, &faces->mesh, &quantisation, &error) != 0) { return command_fail("%s", error.text); }
    if (!quantisation.exact) {
        (void)fprintf(stderr, "tuile: the coordinates have no common int16 scale; rounded to steps of 2^%d, largest error %.3g\n",
                      quantisation.exponent, quantisation.error_max);
    }
    if (scene_text_camera(&faces->scene, &quantisation, &view, &error) != 0) { return command_fail("%s", error.text); }
    if (faces->mesh.face_count > 0) {
        if (mesh_compile(&faces->mesh, &options, &faces->bytes, &size_bytes, &report, &error) != 0) {
            return command_fail("%s", error.text);
        }
        result = tuile_model_open(&model, faces->bytes, size_bytes);
        if (result) { return command_fail("internal: %s", tuile_error_text(result)); }
        scene.instance_count = 1;
        config.cluster_vertices = model.cluster_vertices_max;
        config.corners = model.corners_max;
    }
    instance.pose = view.pose;
    scene.camera = view.camera;
    config.width = faces->scene.width;
    config.height = faces->scene.height;
    config.format = TUILE_FACE_IDS;
    config.tie = (uint8_t)view.tie;
    if (memory_bytes == 0) { memory_bytes = (size_t)1 << 20; }
    faces->block = malloc(memory_bytes);
    faces->ids = calloc((size_t)config.width * config.height, sizeof *faces->ids);
    if (!faces->block || !faces->ids) { return command_fail("out of memory"); }
    result = tuile_init(&renderer, &config, faces->block, memory_bytes, &least);
    if (result == TUILE_ERROR_MEMORY) {
        return command_fail("--memory: %zu bytes are too few, this scene wants %zu", memory_bytes, least);
    }
    if (result == 0) { result = ids_draw(renderer, &scene, faces->ids); }
    if (result == TUILE_ERROR_MEMORY) {
        return command_fail("--memory: %zu bytes are too few for this method; %zu would do", memory_bytes, tuile_wanted(renderer));
    }
    if (result < 0) { return command_fail("%s", tuile_error_text(result)); }
    for (unsigned y = 0; y < config.height; y++) {
        for (unsigned x = 0; x < config.width; x++) {
            const uint32_t id = faces->ids[(size_t)y * config.width + x];
            const uint32_t shown = id ? faces->scene.polys[tuile_model_source_face(&model, id - 1)].id : 0;
            (void)printf(x ? " %u" : "%u", shown);
        }
        (void)printf("\n");
    }
    return command_finish();
}

int command_faces(int count, char **arguments) {
    const char *path = NULL, *argument;
    options_t options;
    sim_error_t error = {""};
    tuile_config_t config = {0};
    faces_t faces = {0};
    size_t memory_bytes = 0;
    int method = 0;

    options_open(&options, count, arguments);
    while ((argument = options_next(&options)) != NULL) {
        if (!options.name) {
            if (path) { return command_fail("faces: one scene at a time, but got %s and %s", path, argument), EXIT_USAGE; }
            path = argument;
        } else if (strcmp(argument, "--method") == 0) {
            if (options_choice(&options, &method, options_methods)) { config.method = (uint8_t)method; }
        } else if (strcmp(argument, "--memory") == 0) {
            (void)options_size(&options, &memory_bytes);
        } else if (strcmp(argument, "--tile") == 0) {
            (void)options_tile(&options, &config.tile_width, &config.tile_height);
        } else if (strcmp(argument, "--help") == 0) {
            (void)fputs(usage, stdout);
            return command_finish();
        } else {
            options_unknown(&options);
        }
    }
    if (options.failed) { return EXIT_USAGE; }
    if (!path) {
        (void)fputs(usage, stderr);
        return EXIT_USAGE;
    }
    if (scene_text_read(&faces.scene, path, &error) != 0) { return command_fail("%s", error.text); }
    const int code = draw(&faces, &config, memory_bytes);
    scene_text_free(&faces.scene);
    mesh_free(&faces.mesh);
    free(faces.bytes);
    free(faces.block);
    free(faces.ids);
    return code;
}
