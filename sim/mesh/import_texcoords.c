/* Texture coordinates of a file, in repeats of the image, to texels that fit 16 bits. */
#include "import.h"

#include <math.h>

#define REPEATS_MAX 65536.0 /* of floats, as files have them, 1/128 of the image is left there */
#define TEXCOORD_MAX 32767.0

typedef struct extent {
    bool any;
    double low[2], high[2];
    double shift[2]; /* repeats, whole */
    double size[2];  /* texels */
} extent_t;

static bool is_textured(const collector_t *c, size_t face) {
    const uint32_t material = c->material[face];
    return !(material & IMPORT_BARE) && c->materials[material / 4].surface.texture != TUILE_NO_TEXTURE;
}

static int out_of_range(const collector_t *c, size_t face, const double texcoord[2]) {
    const import_material_t *material = &c->materials[c->material[face] / 4];
    const mesh_texture_t *texture = &c->mesh.textures[material->surface.texture];
    return sim_fail(
        c->error,
        "%.200s: face %u, material \"%s\": texture coordinates (%g, %g) are too far out: those of a material may span %g x "
        "%g repeats of its image of %ux%u texels; repair them, or take a smaller image (--texture-size)",
        c->path, c->mesh.faces[face].source, material->name, texcoord[0], 1 - texcoord[1], 2 * TEXCOORD_MAX / texture->width,
        2 * TEXCOORD_MAX / texture->height, texture->width, texture->height);
}

static int measure(const collector_t *c, extent_t *extents) {
    const mesh_t *mesh = &c->mesh;
    for (size_t f = 0; f < mesh->face_count; f++) {
        if (!is_textured(c, f)) { continue; }
        extent_t *extent = &extents[c->material[f] / 4];
        for (uint32_t i = 0; i < mesh->faces[f].count; i++) {
            const double *at = mesh->texcoords[mesh->faces[f].first + i];
            for (int k = 0; k < 2; k++) {
                if (!(fabs(at[k]) <= REPEATS_MAX)) { return out_of_range(c, f, at); }
                extent->low[k] = extent->any ? fmin(extent->low[k], at[k]) : at[k];
                extent->high[k] = extent->any ? fmax(extent->high[k], at[k]) : at[k];
            }
            extent->any = true;
        }
    }
    return 0;
}

/* The whole repeats that bring the middle nearest to 0, and the most fraction bits that then fit. */
static void fit(const mesh_texture_t *texture, extent_t *extent, tuile_material_t *surface) {
    double most = 0;
    extent->size[0] = texture->width;
    extent->size[1] = texture->height;
    for (int k = 0; k < 2; k++) {
        const bool clamped = texture->flags & (k ? TUILE_TEXTURE_CLAMP_T : TUILE_TEXTURE_CLAMP_S);
        extent->shift[k] = clamped ? 0 : floor((extent->low[k] + extent->high[k]) / 2 + 0.5);
        most = fmax(most, fabs(extent->low[k] - extent->shift[k]) * extent->size[k]);
        most = fmax(most, fabs(extent->high[k] - extent->shift[k]) * extent->size[k]);
    }
    surface->uv_bits = MODEL_UV_BITS_MAX;
    while (surface->uv_bits > 0 && ldexp(most, surface->uv_bits) > TEXCOORD_MAX) {
        surface->uv_bits--;
    }
}

static int to_texels(const collector_t *c, const extent_t *extents) {
    const mesh_t *mesh = &c->mesh;
    for (size_t f = 0; f < mesh->face_count; f++) {
        const bool textured = is_textured(c, f);
        const extent_t *extent = &extents[c->material[f] / 4];
        for (uint32_t i = 0; i < mesh->faces[f].count; i++) {
            double *at = mesh->texcoords[mesh->faces[f].first + i];
            const double was[2] = {at[0], at[1]};
            for (int k = 0; k < 2; k++) {
                at[k] = textured ? (was[k] - extent->shift[k]) * extent->size[k] : 0;
                if (fabs(at[k]) > TEXCOORD_MAX) { return out_of_range(c, f, was); }
            }
        }
    }
    return 0;
}

int import_fit_texcoords(collector_t *c) {
    const size_t materials = (size_t)c->scene->mNumMaterials + 1;
    extent_t *extents = mesh_array(materials, sizeof *extents);
    if (!extents) { return import_no_memory(c); }
    int status = measure(c, extents);
    for (size_t m = 0; !status && m < materials; m++) {
        tuile_material_t *surface = &c->materials[m].surface;
        if (extents[m].any) { fit(&c->mesh.textures[surface->texture], &extents[m], surface); }
    }
    if (!status) { status = to_texels(c, extents); }
    free(extents);
    return status;
}
