/* Any bytes as a text scene: read, quantised, given a camera, put to the exact reference and drawn by all five methods. What must
 * hold of every scene that is taken is checked; overflow and bad accesses are left to the sanitizers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../raster/tuile.h"
#include "../sim/scene_text.h"
#include "reference/fuzz_driver.h"
#include "reference/scene_generator.h"
#include "reference/visibility_reference.h"

static void require(bool condition, const char *what) {
    if (!condition) {
        (void)fprintf(stderr, "fuzz_scene_text: %s\n", what);
        abort();
    }
}

static void look(const scene_text_t *scene) {
    visibility_reference_t *reference;
    sim_error_t error = {""};
    if (visibility_reference_make(&reference, scene, NULL, &error) < 0) {
        require(error.text[0] && !reference, "the reference refuses without a word");
        return;
    }
    for (int i = 0; i < 9; i++) {
        int x = (i % 3) * (scene->width - 1) / 2, y = (i / 3) * (scene->height - 1) / 2;
        visibility_pixel_t pixel = visibility_reference_at(reference, x, y);
        require(pixel.face >= -1 && pixel.face < (int32_t)scene->poly_count, "no such face");
        require(visibility_reference_allows(reference, x, y, pixel.face), "the answer is not allowed");
    }
    visibility_reference_free(reference);
}

/* ---- drawing --------------------------------------------------------------------------------------------------- */

enum { METHODS = TUILE_TREE + 1, BLOCK_BYTES = 1 << 20 };

/* The middle of the scene's window, so many pixels each way at most: any scene is drawn quickly. */
#define SIDE_MOST 96

typedef struct drawing {
    uint8_t *bytes; /* of the model */
    tuile_model_t model;
    tuile_instance_t instance;
    tuile_scene_t scene; /* points into this struct */
    tuile_config_t config;
} drawing_t;

/* False when the scene does not make a model. */
static bool drawing_open(drawing_t *d, const scene_text_t *text, const mesh_t *mesh, const scene_view_t *view, bool tree) {
    mesh_options_t options = scene_text_mesh_options();
    sim_error_t error = {""};
    size_t size;
    const int width = text->width < SIDE_MOST ? text->width : SIDE_MOST,
              height = text->height < SIDE_MOST ? text->height : SIDE_MOST;
    *d = (drawing_t){0};
    options.tree = tree;
    if (mesh_compile(mesh, &options, &d->bytes, &size, NULL, &error) != 0) {
        require(error.text[0] && !d->bytes, "the compiler refuses without a word");
        return false;
    }
    require(tuile_model_open(&d->model, d->bytes, size) == TUILE_OK, "what was compiled is no model");
    d->instance = (tuile_instance_t){&d->model, view->pose, true};
    d->scene = (tuile_scene_t){.instances = &d->instance, .instance_count = 1, .camera = view->camera};
    d->scene.camera.centre_x -= (text->width - width) / 2 * 65536;
    d->scene.camera.centre_y -= (text->height - height) / 2 * 65536;
    d->config = (tuile_config_t){.width = (uint16_t)width,
                                 .height = (uint16_t)height,
                                 .tile_height = (uint16_t)(1 + text->vertex_count % 32),
                                 .tile_width = (uint16_t)(text->poly_count % 3 ? 0 : 8 + text->vertex_count % 32),
                                 .format = TUILE_FACE_IDS,
                                 .tie = (uint8_t)view->tie,
                                 .cluster_vertices = d->model.cluster_vertices_max,
                                 .corners = d->model.corners_max,
                                 .tree_depth = d->model.tree_depth};
    return true;
}

/* The faces seen, numbered as in the text; the frame's error, or TUILE_OK. */
static int drawing_draw(const drawing_t *d, unsigned method, void *block, uint32_t *ids) {
    tuile_config_t config = d->config;
    tuile_t *renderer;
    tuile_tile_t tile;
    config.method = (uint8_t)method;
    require(tuile_init(&renderer, &config, block, BLOCK_BYTES, NULL) == TUILE_OK, "the block is refused");
    int result = tuile_begin(renderer, &d->scene);
    if (result != TUILE_OK) { return result; }
    while ((result = tuile_next(renderer, &tile)) == 1) {
        for (uint32_t i = 0; i < tile.size_bytes / 4; i++) {
            const size_t x = tile.x + i % tile.width, y = tile.y + i / tile.width;
            uint32_t id;
            memcpy(&id, tile.bytes + 4 * (size_t)i, 4);
            require(id <= d->model.face_count, "a face that the model has not");
            ids[y * config.width + x] = id ? tuile_model_source_face(&d->model, id - 1) + 1 : 0;
        }
    }
    require(tuile_end(renderer, NULL) == TUILE_OK, "a frame that does not end");
    return result;
}

static struct { unsigned long drawn[METHODS], refused[METHODS], pixels, tree_differs; } counts;

static bool draw_counted(const drawing_t *d, unsigned method, void *block, uint32_t *ids) {
    const int result = drawing_draw(d, method, block, ids);
    require(result == TUILE_OK || result == TUILE_ERROR_RANGE || (result == TUILE_ERROR_MEMORY && method != TUILE_ZBUFFER),
            tuile_error_text(result));
    ++*(result == TUILE_OK ? &counts.drawn[method] : &counts.refused[method]);
    return result == TUILE_OK;
}

/* One picture by the methods that decide by depth, pixel by pixel. The tree's may differ beside its cuts. */
static void draw(const scene_text_t *text, const mesh_t *mesh, const scene_view_t *view) {
    static _Alignas(8) uint8_t block[BLOCK_BYTES];
    static uint32_t first[SIDE_MOST * SIDE_MOST], ids[SIDE_MOST * SIDE_MOST];
    drawing_t plain, tree;
    if (mesh->face_count == 0 || !drawing_open(&plain, text, mesh, view, false)) { return; }
    const size_t pixels = (size_t)plain.config.width * plain.config.height;
    const bool drawn = draw_counted(&plain, TUILE_ZBUFFER, block, first);
    for (unsigned method = TUILE_SCANLINE; method <= TUILE_PAINTER; method++) {
        if (!draw_counted(&plain, method, block, ids)) { continue; }
        require(drawn, "the z-buffer alone refuses");
        for (size_t i = 0; i < pixels; i++) {
            require(ids[i] == first[i], "two methods show different faces");
        }
    }
    free(plain.bytes);
    if (!drawing_open(&tree, text, mesh, view, true)) { return; }
    if (draw_counted(&tree, TUILE_TREE, block, ids) && drawn) {
        counts.pixels += pixels;
        for (size_t i = 0; i < pixels; i++) {
            counts.tree_differs += ids[i] != first[i];
        }
    }
    free(tree.bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    scene_text_t scene;
    sim_error_t error = {""};
    if (scene_text_parse(&scene, (const char *)bytes, size, "fuzz", &error) < 0) {
        require(error.text[0] != 0, "refused without a word");
        for (const char *c = error.text; *c; c++) {
            require(*c >= ' ' && *c <= '~', "the error is not printable");
        }
        require(!scene.polys && !scene.vertices, "a refused scene is not empty");
        return 0;
    }
    mesh_t mesh;
    scene_quantisation_t quantisation;
    scene_view_t view;
    require(scene_text_mesh(&scene, &mesh, &quantisation, &error) == 0, "no mesh");
    for (size_t i = 0; i < mesh.position_count; i++) {
        for (int c = 0; c < 3; c++) {
            require(mesh.positions[i][c] >= -32767 && mesh.positions[i][c] <= 32767, "a position out of range");
        }
    }
    require(quantisation.exact == (quantisation.error_max <= 0) || !quantisation.exact, "exact with an error");
    if (scene_text_camera(&scene, &quantisation, &view, &error) == 0) {
        require(view.camera.near > 0 && view.camera.near < view.camera.far, "near and far");
        require(view.camera.focal_x > 0 && view.camera.focal_y == view.camera.focal_x, "focal length");
        draw(&scene, &mesh, &view);
    } else {
        require(scene.projection == TUILE_ORTHOGRAPHIC && error.text[0], "no camera");
    }
    free(mesh.positions);
    free(mesh.corners);
    free(mesh.faces);
    free(mesh.materials);
    look(&scene);
    scene_text_free(&scene);
    return 0;
}

#ifdef FUZZ_DRIVER
static char *seed(uint64_t n) { return scene_generate(n, NULL); }

int main(int argc, char **argv) {
    const int result = fuzz_drive(argc, argv, seed);
    for (unsigned m = 0; m < METHODS; m++) {
        (void)printf("method %u: %lu drawn, %lu out of range or memory\n", m, counts.drawn[m], counts.refused[m]);
    }
    (void)printf("%lu of %lu pixels of the trees differ\n", counts.tree_differs, counts.pixels);
    return result;
}
#endif
