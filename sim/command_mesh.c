/* tuile mesh: compile a model for flash. */
#include "commands.h"
#include "../raster/geometry/model.h"
#include "mesh/mesh.h"
#include "options.h"
#include "render_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "Usage: tuile mesh IN -o OUT.c|OUT.tuile [options]\n"
    "\n"
    "Reads a model (OBJ, glTF, PLY, STL, 3DS, Collada and what else Assimp knows) and writes it quantised, clustered and checked,\n"
    "as a C file with one const object for flash or as a .tuile file with the same bytes.\n"
    "\n"
    "  -o FILE          where to write; the ending decides the form\n"
    "  --name NAME      C identifier of the object (.c only); by default from FILE\n"
    "  --max-faces N    simplify to at most N triangles\n"
    "  --triangles      cut polygons into triangles (they keep the polygon's number); by default polygons stay polygons\n"
    "  --tree           with a display tree, by which faces are drawn from back to front without depth; it cuts some of them\n";

static void mesh_report_print(const mesh_report_t *report) {
    (void)printf("vertices %zu, faces %zu (%zu n-gons), clusters %zu, %zu bytes\n", report->vertices, report->faces,
                 report->polygons, report->clusters, report->size_bytes);
    (void)printf("non-planar faces split %zu, degenerate faces skipped %zu, largest quantisation error %.3g model units\n",
                 report->non_planar, report->skipped, report->quantisation_error);
}

static void tree_report_print(const mesh_tree_report_t *tree) {
    (void)printf("tree: faces %zu -> %zu, splits %zu, type-1 %zu, type-2 %zu, complexity %zu, depth %zu, bytes %zu\n",
                 tree->faces_in, tree->faces_out, tree->splits, tree->convex_nodes, tree->plane_nodes, tree->plane_nodes,
                 tree->depth, tree->size_bytes);
    (void)printf("      not flat on the grid %zu, corners inserted along cuts %zu, pieces without area dropped %zu\n",
                 tree->non_planar, tree->seam_corners, tree->dropped);
}

static bool is_power_of_two(unsigned side) { return side >= 2 && (side & (side - 1)) == 0; }

/* Without a key, clamping and alpha, which no size and format makes fast (surface/textured.h). */
static bool would_be_faster(const tuile_texture_t *texture) {
    const bool format = texture->format == TUILE_TEXEL_PALETTE4 || texture->format == TUILE_TEXEL_GREY8;
    return texture->flags == 0 && texture->format != TUILE_TEXEL_ARGB4444 &&
           (format || !is_power_of_two(texture->width) || !is_power_of_two(texture->height));
}

/* What stands of surfaces in the model: textures with the materials that have them, vertex colours, a second key frame. */
static void surface_report_print(const uint8_t *bytes, size_t size_bytes) {
    static const char *const formats[] = {"rgb565", "palette8", "palette4", "grey8", "argb4444"};
    tuile_model_t model;
    if (tuile_model_open(&model, bytes, size_bytes) != TUILE_OK) { return; }
    for (uint32_t t = 0; t < model.texture_count; t++) {
        const tuile_texture_t texture = tuile_model_texture(&model, t);
        const size_t palette = 2u * model_palette_entries(texture.format);
        (void)printf("texture %u: %ux%u %s, levels %u, %s%s%s, %zu bytes, materials", t, texture.width, texture.height,
                     formats[texture.format], texture.levels, texture.flags & TUILE_TEXTURE_CLAMP_S ? "s clamped" : "s repeated",
                     texture.flags & TUILE_TEXTURE_CLAMP_T ? ", t clamped" : ", t repeated",
                     texture.flags & TUILE_TEXTURE_KEY ? ", keyed" : "",
                     palette + model_texture_bytes(texture.format, texture.width, texture.height, texture.levels));
        for (uint32_t m = 0; m < model.material_count; m++) {
            const tuile_material_t material = tuile_model_material(&model, m);
            if (material.texture == t) { (void)printf(" %u (uv_bits %u)", m, material.uv_bits); }
        }
        (void)printf("\n");
        if (would_be_faster(&texture)) { (void)printf("  --texture-fast: its small faces would be drawn several times as fast\n"); }
    }
    if (model.texcoords) { (void)printf("texture coordinates %u bytes\n", 4 * model.vertex_count); }
    if (model.colours) { (void)printf("vertex colours %u bytes\n", 4 * model.vertex_count); }
    if (model.morph_positions) { (void)printf("second key frame %u bytes\n", 9 * model.vertex_count + 3 * model.face_count); }
}

/* In steps of 1/1000. context: the last one shown. */
static void show_progress(void *context, size_t done, size_t of) {
    unsigned *shown = context, now = (unsigned)(1000.0 * (double)done / (double)(of ? of : 1));
    if (now == *shown) { return; }
    *shown = now;
    command_progress(now, 1000);
}

int command_mesh(int count, char **arguments) {
    const char *in = NULL, *out = NULL, *name = NULL, *argument;
    long max_faces = 0;
    options_t options;
    sim_error_t error = {""};
    uint8_t *bytes = NULL;
    size_t size_bytes = 0;
    mesh_report_t report;
    unsigned shown = 0;
    mesh_options_t compile = {.progress = show_progress, .progress_context = &shown};

    options_open(&options, count, arguments);
    while ((argument = options_next(&options)) != NULL) {
        if (!options.name) {
            if (in) { return command_fail("mesh: one model at a time, but got %s and %s", in, argument), EXIT_USAGE; }
            in = argument;
        } else if (strcmp(argument, "-o") == 0) {
            out = options_value(&options);
        } else if (strcmp(argument, "--name") == 0) {
            name = options_value(&options);
        } else if (strcmp(argument, "--max-faces") == 0) {
            (void)options_integer(&options, &max_faces, 1, 100000000);
        } else if (strcmp(argument, "--triangles") == 0) {
            compile.triangles = true;
        } else if (strcmp(argument, "--tree") == 0) {
            compile.tree = true;
        } else if (render_mesh_option(&compile, &options, argument)) {
            continue;
        } else if (strcmp(argument, "--help") == 0) {
            (void)fputs(usage, stdout);
            (void)fputs(render_mesh_usage, stdout);
            return command_finish();
        } else {
            options_unknown(&options);
        }
    }
    if (options.failed) { return EXIT_USAGE; }
    if (!in || !out) {
        (void)fputs(usage, stderr);
        (void)fputs(render_mesh_usage, stderr);
        return EXIT_USAGE;
    }
    if (mesh_load(in, (size_t)max_faces, &compile, &bytes, &size_bytes, &report, &error) != 0) {
        return command_fail("%s", error.text);
    }
    render_mesh_warn(&report);
    if (mesh_write(bytes, size_bytes, out, name, &error)) {
        free(bytes);
        return command_fail("%s", error.text);
    }
    (void)printf("%s: ", out);
    mesh_report_print(&report);
    if (report.tree.size_bytes) { tree_report_print(&report.tree); }
    surface_report_print(bytes, size_bytes);
    free(bytes);
    return command_finish();
}
