#include "../tune.h"

#include "textured.h"

/* log2 of a power of two, 1 at least; else 0. */
static unsigned log2_side(uint32_t side) { return side >= 2 && (side & (side - 1)) == 0 ? 31 - fixed_clz32(side) : 0; }

static void level_set(textured_material_t *m, unsigned number) {
    const unsigned width = m->log2_width - number, height = m->log2_height - number;
    textured_level_t *level = &m->level;
    level->number = (uint8_t)number;
    level->upper = number + 1u < m->levels ? (uint8_t)(2 * number + 2) : 31;
    level->lower = (uint8_t)(2 * number);
    level->always = number > 0 ? 0 : UINT32_C(1) << 31;
    level->fit = number < m->log2_width && number < m->log2_height && width + height <= 16;
    if (!level->fit) { return; }
    level->width = (uint8_t)width;
    level->mask = (uint64_t)((1u << height) - 1) << (48 + width) | (uint64_t)((1u << width) - 1) << 16;
    level->texels = m->texels;
    for (unsigned n = 0; n < number; n++) {
        level->texels += (size_t)(m->palette ? 1 : 2) << (m->log2_width - n + m->log2_height - n);
    }
}

void textured_level_find(textured_material_t *m, uint32_t texels, uint32_t pixels) {
    unsigned number = 0;
    while (number + 1u < m->levels && texels >> (2 * number + 2) > pixels) { /* half an octave early: the nearest one */
        number++;
    }
    level_set(m, number);
}

void textured_material_open(textured_material_t *m, const tuile_material_t *material, const tuile_texture_t *texture,
                            uint8_t texturing, bool perspective) {
    const uint8_t *colour = material->colour;
    const bool white = material->flags & TUILE_MATERIAL_REPLACED || (colour[0] & colour[1] & colour[2]) == 255;
    const bool nearest = !(material->flags & TUILE_MATERIAL_BILINEAR) || texturing & TUILE_TEXTURE_NEAREST;
    m->fit = white && nearest && !(material->flags & TUILE_MATERIAL_UNLIT) && !(texturing & TUILE_TEXTURE_OFF) &&
             (texture->format == TUILE_TEXEL_RGB565 || texture->format == TUILE_TEXEL_PALETTE8) && texture->flags == 0 &&
             material->specular == 0 && (material->emission[0] | material->emission[1] | material->emission[2]) == 0;
    m->log2_width = (uint8_t)log2_side(texture->width);
    m->log2_height = (uint8_t)log2_side(texture->height);
    if (!m->fit || m->log2_width == 0 || m->log2_height == 0) {
        m->fit = false;
        return;
    }
    m->affine = texturing & TUILE_TEXTURE_AFFINE || !perspective;
    m->levels = texturing & TUILE_TEXTURE_NO_MIPS ? 1 : texture->levels;
    m->uv_bits = material->uv_bits;
    m->texels = texture->texels;
    m->palette = (const uint16_t *)(const void *)texture->palette;
    level_set(m, 0);
}
