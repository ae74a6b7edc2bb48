/* What a compiled model has beside its faces: materials, textures, vertex colours and a second key frame, checked as all of it. */
#include "model.h"

#include "../surface/texture.h"

unsigned model_palette_entries(unsigned format) {
    return format == TUILE_TEXEL_PALETTE8 ? 256 : format == TUILE_TEXEL_PALETTE4 ? 16 : 0;
}

uint32_t model_texture_bytes(unsigned format, uint32_t width, uint32_t height, unsigned levels) {
    uint32_t size_bytes = 0;
    for (unsigned level = 0; level < levels; level++) {
        size_bytes = (size_bytes + 1) & ~1u;
        size_bytes += texture_row_bytes((uint8_t)format, width) * height;
        width = width > 1 ? width / 2 : 1;
        height = height > 1 ? height / 2 : 1;
    }
    return size_bytes;
}

/* Levels down to one texel. */
static unsigned levels_most(uint32_t width, uint32_t height) {
    unsigned levels = 1;
    for (uint32_t size = width > height ? width : height; size > 1; size /= 2) {
        levels++;
    }
    return levels;
}

/* ---- checks -------------------------------------------------------------------------------------------------- */

static bool block_holds(const tuile_model_t *model, uint32_t offset, uint32_t size_bytes) {
    return offset % 4 == 0 && offset >= MODEL_HEADER_BYTES && offset <= model->size_bytes &&
           size_bytes <= model->size_bytes - offset;
}

/* The largest number that a texel of the format can be. */
static uint32_t texel_most(unsigned format) {
    return format == TUILE_TEXEL_RGB565 || format == TUILE_TEXEL_ARGB4444 ? 0xffff : format == TUILE_TEXEL_PALETTE4 ? 15 : 255;
}

static bool check_texture(const tuile_model_t *model, const uint8_t *at) {
    const uint32_t width = model_u16(at + TEXTURE_AT_WIDTH), height = model_u16(at + TEXTURE_AT_HEIGHT);
    const uint32_t key = model_u16(at + TEXTURE_AT_KEY), palette = model_u32(at + TEXTURE_AT_PALETTE);
    const unsigned format = at[TEXTURE_AT_FORMAT], levels = at[TEXTURE_AT_LEVELS], flags = at[TEXTURE_AT_FLAGS];
    const unsigned known = TUILE_TEXTURE_CLAMP_S | TUILE_TEXTURE_CLAMP_T | TUILE_TEXTURE_KEY | TUILE_TEXTURE_PALETTE_ALPHA;
    const uint32_t entries = model_palette_entries(format);

    if (width < 1 || width > TUILE_TEXTURE_MAX || height < 1 || height > TUILE_TEXTURE_MAX || format > TUILE_TEXEL_ARGB4444 ||
        levels < 1 || levels > levels_most(width, height) || (flags & ~known) != 0 || at[TEXTURE_AT_ZERO] != 0 ||
        model_u16(at + TEXTURE_AT_ZERO2) != 0) {
        return false;
    }
    if (flags & TUILE_TEXTURE_KEY ? key > texel_most(format) : key != 0) { return false; }
    if (entries ? !block_holds(model, palette, 2 * entries) : palette != 0 || (flags & TUILE_TEXTURE_PALETTE_ALPHA) != 0) {
        return false;
    }
    return block_holds(model, model_u32(at + TEXTURE_AT_TEXELS), model_texture_bytes(format, width, height, levels));
}

static bool check_material(const tuile_model_t *model, const uint8_t *at) {
    const unsigned flags = TUILE_MATERIAL_TWO_SIDED | TUILE_MATERIAL_BILINEAR | TUILE_MATERIAL_UNLIT |
                           TUILE_MATERIAL_VERTEX_COLOURS | TUILE_MATERIAL_REPLACED;
    const unsigned texture = at[MATERIAL_AT_TEXTURE];
    if (texture != TUILE_NO_TEXTURE && (texture >= model->texture_count || !model->texcoords)) { return false; }
    if ((at[MATERIAL_AT_FLAGS] & TUILE_MATERIAL_VERTEX_COLOURS) != 0 && !model->colours) { return false; }
    return at[MATERIAL_AT_SHININESS] <= MODEL_SHININESS_MAX && at[MATERIAL_AT_BLEND] <= TUILE_BLEND_MULTIPLY &&
           (at[MATERIAL_AT_FLAGS] & ~flags) == 0 && at[MATERIAL_AT_UV_BITS] <= MODEL_UV_BITS_MAX && at[MATERIAL_AT_ZERO] == 0 &&
           at[MATERIAL_AT_ZERO + 1] == 0 && at[MATERIAL_AT_ZERO + 2] == 0;
}

/* A section that may be left out: *to is NULL then. False where it is there and wrong. */
static bool optional(const tuile_model_t *model, const uint8_t **to, unsigned at, uint32_t count, uint32_t item_bytes) {
    *to = NULL;
    if (model_u32(model->bytes + at) == 0) { return true; }
    *to = model_section(model, at, count, item_bytes);
    return *to != NULL;
}

bool model_open_surface(tuile_model_t *model) {
    const uint8_t *bytes = model->bytes;
    model->texture_count = model_u16(bytes + MODEL_AT_TEXTURE_COUNT);
    model->materials = model_section(model, MODEL_AT_MATERIAL_TABLE, model->material_count, MODEL_MATERIAL_BYTES);
    if (!model->materials || model->texture_count > TUILE_NO_TEXTURE || model_u16(bytes + MODEL_AT_ZERO2) != 0 ||
        !optional(model, &model->texcoords, MODEL_AT_TEXCOORDS, model->vertex_count, 4) ||
        !optional(model, &model->colours, MODEL_AT_COLOURS, model->vertex_count, 4) ||
        !optional(model, &model->textures, MODEL_AT_TEXTURES, model->texture_count, MODEL_TEXTURE_BYTES) ||
        (model->textures == NULL) != (model->texture_count == 0)) {
        return false;
    }
    for (uint32_t t = 0; t < model->texture_count; t++) {
        if (!check_texture(model, model->textures + t * MODEL_TEXTURE_BYTES)) { return false; }
    }
    for (uint32_t m = 0; m < model->material_count; m++) {
        if (!check_material(model, model->materials + m * MODEL_MATERIAL_BYTES)) { return false; }
    }
    return true;
}

bool model_open_morph(tuile_model_t *model) {
    if (!optional(model, &model->morph_positions, MODEL_AT_MORPH_POSITIONS, model->vertex_count, 6) ||
        !optional(model, &model->morph_normals, MODEL_AT_MORPH_NORMALS, model->vertex_count, 3) ||
        !optional(model, &model->morph_face_normals, MODEL_AT_MORPH_FACE_NORMALS, model->face_count, 3)) {
        return false;
    }
    const bool morphs = model->morph_positions != NULL;
    if ((model->morph_normals != NULL) != morphs || (model->morph_face_normals != NULL) != morphs) { return false; }
    return !morphs || (!model->tree && model_in_box(model, model->morph_positions));
}

/* ---- what is asked ------------------------------------------------------------------------------------------- */

tuile_material_t tuile_model_material(const tuile_model_t *model, uint32_t index) {
    const uint8_t *at = model->materials + (size_t)MODEL_MATERIAL_BYTES * index;
    return (tuile_material_t){.colour = {at[0], at[1], at[2]},
                              .alpha = at[MATERIAL_AT_ALPHA],
                              .emission = {at[MATERIAL_AT_EMISSION], at[MATERIAL_AT_EMISSION + 1], at[MATERIAL_AT_EMISSION + 2]},
                              .specular = at[MATERIAL_AT_SPECULAR],
                              .shininess = at[MATERIAL_AT_SHININESS],
                              .texture = at[MATERIAL_AT_TEXTURE],
                              .blend = at[MATERIAL_AT_BLEND],
                              .flags = at[MATERIAL_AT_FLAGS],
                              .uv_bits = at[MATERIAL_AT_UV_BITS]};
}

tuile_texture_t tuile_model_texture(const tuile_model_t *model, uint32_t index) {
    const uint8_t *at = model->textures + (size_t)MODEL_TEXTURE_BYTES * index;
    const uint32_t palette = model_u32(at + TEXTURE_AT_PALETTE);
    return (tuile_texture_t){.texels = model->bytes + model_u32(at + TEXTURE_AT_TEXELS),
                             .palette = palette ? model->bytes + palette : NULL,
                             .width = model_u16(at + TEXTURE_AT_WIDTH),
                             .height = model_u16(at + TEXTURE_AT_HEIGHT),
                             .format = at[TEXTURE_AT_FORMAT],
                             .levels = at[TEXTURE_AT_LEVELS],
                             .flags = at[TEXTURE_AT_FLAGS],
                             .key = model_u16(at + TEXTURE_AT_KEY)};
}
