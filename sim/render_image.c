#include "render_image.h"

#include "commands.h"
#include "input.h"
#include "mesh/image.h"
#include "mesh/texels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILE_MAX ((size_t)256 << 20)
#define PATH_BYTES 4096

const char *render_image_name(render_image_t *image, const char *value) {
    const char *sign = strrchr(value, '@');
    if (!sign || sign == value || sign - value >= PATH_BYTES) { return NULL; }
    image->path = value;
    image->path_length = (int)(sign - value);
    return sign + 1;
}

static int decode(image_t *pixels, const char *path, sim_error_t *error) {
    uint8_t *bytes = NULL;
    size_t size_bytes;
    const bool failed =
        input_read(path, FILE_MAX, &bytes, &size_bytes, error) != 0 || image_decode(pixels, bytes, size_bytes, path, error) != 0;
    free(bytes);
    return failed ? -1 : 0;
}

static int make(render_image_t *image, const image_t *pixels, const char *path, sim_error_t *error) {
    /* One level: images and sprites are drawn from the first. */
    static const mesh_options_t options = {.texture_format = MESH_TEXELS_AUTO, .no_mips = true};
    if (pixels->width > TUILE_TEXTURE_MAX || pixels->height > TUILE_TEXTURE_MAX) {
        return sim_fail(error, "%s: is %ux%u pixels; %ux%u fit", path, pixels->width, pixels->height, TUILE_TEXTURE_MAX,
                        TUILE_TEXTURE_MAX);
    }
    return texels_make(&image->made, pixels, 0, &options, path, error);
}

static tuile_texture_t texture_of(const mesh_texture_t *from) {
    return (tuile_texture_t){.texels = from->texels,
                             .palette = from->palette,
                             .width = from->width,
                             .height = from->height,
                             .format = from->format,
                             .levels = from->levels,
                             .flags = from->flags,
                             .key = from->key};
}

int render_image_load(render_image_t *image, const char *option) {
    sim_error_t error = {""};
    image_t pixels = {0};
    char path[PATH_BYTES];
    (void)snprintf(path, sizeof path, "%.*s", image->path_length, image->path);
    const bool failed = decode(&pixels, path, &error) != 0 || make(image, &pixels, path, &error) != 0;
    image_free(&pixels);
    if (failed) { return command_fail("%s: %s", option, error.text); }
    image->texture = texture_of(&image->made);
    return 0;
}

void render_image_free(render_image_t *image) {
    free(image->made.texels);
    free(image->made.palette);
    *image = (render_image_t){0};
}
