#include "render_mesh.h"

#include "commands.h"
#include "render_value.h"

#include <stdio.h>
#include <string.h>

const char render_mesh_usage[] =
    "  --no-textures            images are left alone, and materials keep their plain colours\n"
    "  --texture-format F       rgb565, palette8, palette4, grey8, argb4444 or auto (default): the smallest that shows all "
    "colours\n"
    "  --texture-size N         halves images until they are at most N texels wide and high\n"
    "  --texture-fast           images as small faces are drawn fastest: sides to the nearest powers of two, palette8 or rgb565\n"
    "  --texture-key RRGGBB     texels of this colour are not there\n"
    "  --mips | --no-mips       with smaller copies of each image for faces far away (default), or without\n"
    "  --bilinear               marks textured materials to be interpolated; by default the nearest texel is taken\n"
    "  --vertex-colours V       auto (default), vertices, faces: colours of the file for each vertex, or their mean for each face\n"
    "  --morph FILE             a model of the same faces, which the first one can become: its second key frame\n";

static void take_key(mesh_options_t *mesh, options_t *options) {
    const char *text = options_value(options);
    if (!text) { return; }
    if (!render_value_colour(text, mesh->texture_key)) {
        (void)command_fail("--texture-key takes six hexadecimal digits, RRGGBB, not \"%s\"", text);
        options->failed = true;
        return;
    }
    mesh->texture_keyed = true;
}

bool render_mesh_option(mesh_options_t *mesh, options_t *options, const char *argument) {
    static const char *const formats[] = {"auto", "rgb565", "palette8", "palette4", "grey8", "argb4444", NULL};
    static const char *const colours[] = {"auto", "vertices", "faces", NULL};
    int choice = 0;
    long size = 0;
    if (strcmp(argument, "--no-textures") == 0) {
        mesh->no_textures = true;
    } else if (strcmp(argument, "--texture-format") == 0) {
        if (options_choice(options, &choice, formats)) { mesh->texture_format = (uint8_t)choice; }
    } else if (strcmp(argument, "--texture-size") == 0) {
        if (options_integer(options, &size, 1, TUILE_TEXTURE_MAX)) { mesh->texture_size = (uint16_t)size; }
    } else if (strcmp(argument, "--texture-fast") == 0) {
        mesh->texture_fast = true;
    } else if (strcmp(argument, "--texture-key") == 0) {
        take_key(mesh, options);
    } else if (strcmp(argument, "--mips") == 0 || strcmp(argument, "--no-mips") == 0) {
        mesh->no_mips = argument[2] == 'n';
    } else if (strcmp(argument, "--bilinear") == 0) {
        mesh->bilinear = true;
    } else if (strcmp(argument, "--vertex-colours") == 0) {
        if (options_choice(options, &choice, colours)) { mesh->vertex_colours = (uint8_t)choice; }
    } else if (strcmp(argument, "--morph") == 0) {
        mesh->morph_path = options_value(options);
    } else {
        return false;
    }
    return true;
}

void render_mesh_warn(const mesh_report_t *report) {
    const char *line = report->warnings;
    for (const char *end; (end = strchr(line, '\n')); line = end + 1) {
        (void)fprintf(stderr, "warning: %.*s\n", (int)(end - line), line);
    }
}
