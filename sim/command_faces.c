/* tuile faces: the visible face of each pixel of a text scene, drawn by the renderer itself. */
#include "../raster/tuile.h"
#include "commands.h"
#include "ids.h"
#include "options.h"
#include "scene_draw.h"
#include "scene_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "Usage: tuile faces [--method zbuffer|scanline|warnock|painter|tree] [--tile WxH] [--memory 16K] SCENE\n"
    "       tuile faces --draw lines|triangles [--policy POLICY] [--tile WxH] SCENE\n"
    "\n"
    "Prints the ID of the face seen at each pixel, one row of the picture a line; 0 is the background. "
    "SCENE is a text scene, - for\n"
    "standard input.\n"
    "\n"
    "  --draw fill         the renderer's own way, by default: sixteenths of pixels, nearest face\n"
    "  --draw lines        the sides of all polygons by Bresenham's lines, from each corner to the next\n"
    "  --draw triangles    all polygons cut into triangles and filled between Bresenham edges\n"
    "  --policy POLICY     which pixel of a flat edge ends a row of such a triangle: the one that the document\n"
    "                      takes (document, by default), with its ends forced (ends), always walked upwards\n"
    "                      (upwards), or the outer, mid or inner one; inner leaves gaps between neighbours\n"
    "\n"
    "Lines and triangles have their corners at the nearest sample points and know no depth: polygons are drawn\n"
    "in the order of the file, later over earlier, whatever `near` and `tie` say.\n";

typedef struct faces {
    scene_text_t scene;
    mesh_t mesh;
    uint8_t *bytes;
    void *block;
    uint32_t *ids;
} faces_t;

static void print_row(const faces_t *faces, const uint32_t *polys) {
    for (unsigned x = 0; x < faces->scene.width; x++) {
        (void)printf(x ? " %u" : "%u", polys[x] ? faces->scene.polys[polys[x] - 1].id : 0);
    }
    (void)printf("\n");
}

static int draw_plain(faces_t *faces, const scene_drawing_t *drawing, const scene_quantisation_t *quantisation,
                      const scene_view_t *view) {
    const size_t width = faces->scene.width, height = faces->scene.height;
    sim_error_t error = {""};
    faces->ids = calloc(width * height, sizeof *faces->ids);
    if (!faces->ids) { return command_fail("out of memory"); }
    if (scene_draw(&faces->scene, &faces->mesh, quantisation, view, drawing, faces->ids, &error) != 0) {
        return command_fail("%s", error.text);
    }
    for (size_t y = 0; y < height; y++) {
        print_row(faces, faces->ids + y * width);
    }
    return command_finish();
}

static int draw(faces_t *faces, const tuile_config_t *wanted, const scene_drawing_t *drawing, size_t memory_bytes) {
    scene_quantisation_t quantisation;
    scene_view_t view;
    sim_error_t error = {""};
    tuile_model_t model;
    tuile_instance_t instance = {.model = &model, .two_sided = true};
    tuile_scene_t scene = {.instances = &instance};
    tuile_config_t config = *wanted;
    mesh_options_t options = scene_text_mesh_options();
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
    if (drawing->kind != SCENE_DRAW_FILL) { return draw_plain(faces, drawing, &quantisation, &view); }
    if (faces->mesh.face_count > 0) {
        options.tree = config.method == TUILE_TREE;
        if (mesh_compile(&faces->mesh, &options, &faces->bytes, &size_bytes, &report, &error) != 0) {
            return command_fail("%s", error.text);
        }
        result = tuile_model_open(&model, faces->bytes, size_bytes);
        if (result) { return command_fail("internal: %s", tuile_error_text(result)); }
        scene.instance_count = 1;
        config.cluster_vertices = model.cluster_vertices_max;
        config.corners = model.corners_max;
        config.tree_depth = model.tree_depth;
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
        uint32_t *row = faces->ids + (size_t)y * config.width;
        for (unsigned x = 0; x < config.width; x++) {
            if (row[x]) { row[x] = tuile_model_source_face(&model, row[x] - 1) + 1; }
        }
        print_row(faces, row);
    }
    return command_finish();
}

int command_faces(int count, char **arguments) {
    static const char *const drawings[] = {"fill", "lines", "triangles", NULL};
    static const char *const policies[] = {"document", "ends", "upwards", "outer", "mid", "inner", NULL};
    const char *path = NULL, *argument;
    options_t options;
    sim_error_t error = {""};
    tuile_config_t config = {0};
    faces_t faces = {0};
    size_t memory_bytes = 0;
    int method = 0, kind = SCENE_DRAW_FILL, policy = -1;
    bool has_method = false;

    options_open(&options, count, arguments);
    while ((argument = options_next(&options)) != NULL) {
        if (!options.name) {
            if (path) { return command_fail("faces: one scene at a time, but got %s and %s", path, argument), EXIT_USAGE; }
            path = argument;
        } else if (strcmp(argument, "--method") == 0) {
            has_method = options_choice(&options, &method, options_methods);
            if (has_method) { config.method = (uint8_t)method; }
        } else if (strcmp(argument, "--draw") == 0) {
            (void)options_choice(&options, &kind, drawings);
        } else if (strcmp(argument, "--policy") == 0) {
            (void)options_choice(&options, &policy, policies);
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
    if (policy >= 0 && kind != SCENE_DRAW_TRIANGLES) {
        return command_fail("faces: --policy is for --draw triangles, not %s", drawings[kind]), EXIT_USAGE;
    }
    if (kind != SCENE_DRAW_FILL && (has_method || memory_bytes)) {
        return command_fail("faces: %s is for --draw fill, not %s", has_method ? "--method" : "--memory", drawings[kind]),
               EXIT_USAGE;
    }
    const scene_drawing_t drawing = {(scene_drawing_kind_t)kind, policy >= 0 ? (edge_policy_t)policy : EDGE_DOCUMENT,
                                     config.tile_width, config.tile_height};
    if (scene_text_read(&faces.scene, path, &error) != 0) { return command_fail("%s", error.text); }
    const int code = draw(&faces, &config, &drawing, memory_bytes);
    scene_text_free(&faces.scene);
    mesh_free(&faces.mesh);
    free(faces.bytes);
    free(faces.block);
    free(faces.ids);
    return code;
}
