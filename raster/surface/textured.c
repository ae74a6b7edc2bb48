#include "../tune.h"

#include "textured.h"

/* log2 of a power of two, 1 at least; else 0. */
static unsigned log2_side(uint32_t side) { return side >= 2 && (side & (side - 1)) == 0 ? 31 - fixed_clz32(side) : 0; }

/* False: the level does not fit, and is never taken for the wanted one. */
static bool level_set(textured_material_t *m, unsigned number) {
    const unsigned twice = 2u * m->uv_bits, lower = (twice > 9 ? twice - 9 : 0) + 2 * number;
    textured_level_t *level = &m->level;
    level->lower = level->upper = 31;
    level->always = 0;
    if (number >= m->log2_width || number >= m->log2_height) { return false; }
    const unsigned width = m->log2_width - number, height = m->log2_height - number, sides = width + height;
    const unsigned down = m->uv_bits + number; /* from coordinates to texels of the level */
    if (width > TEXTURED_FRACTION || height > TEXTURED_FRACTION || lower > 29) { return false; }
    const uint8_t *texels = m->texels;
    for (unsigned n = 0; n < number; n++) {
        texels += (size_t)(m->palette ? 1 : 2) << (m->log2_width - n + m->log2_height - n);
    }
    level->texels = texels;
    level->number = (uint8_t)number;
    level->lower = (uint8_t)lower;
    if (number + 1u < m->levels) { level->upper = (uint8_t)(lower + 2); }
    if (number == 0) { level->always = UINT32_C(1) << 31; }
    level->t_unit = UINT32_C(1) << (32 - height - TEXTURED_FRACTION);
    level->s_unit = UINT32_C(1) << (32 - sides - 2 * TEXTURED_FRACTION);
    level->shift = (uint8_t)(32 - sides);
    level->from_corner = (uint8_t)down;
    level->up = (uint8_t)(down < 13 ? 13 - down : 0); /* 5 + TEXTURED_FRACTION: from sixteenths of a pixel and 2^31 */
    level->down = (uint8_t)(down > 13 ? down - 13 : 0);
    level->mask = ~UINT32_C(0) << (32 - height) | ((UINT32_C(1) << width) - 1) * level->s_unit << TEXTURED_FRACTION;
    return true;
}

bool textured_level_find(textured_material_t *m, uint32_t texels, uint32_t pixels) {
    const unsigned twice = 2u * m->uv_bits, lower = twice > 9 ? twice - 9 : 0;
    unsigned number = 0;
    while (number + 1u < m->levels && texels >> (lower + 2 * number + 2) > pixels) { /* half an octave early: the nearest one */
        number++;
    }
    return level_set(m, number);
}

static uint32_t range3(int32_t a, int32_t b, int32_t c) {
    const texture_span3_t span = texture_span3(a, b, c);
    return (uint32_t)(span.most - span.least);
}

bool textured_affine(const textured_material_t *m, const textured_face_t *f) {
    const int32_t depth0 = (int32_t)f->depth0, depth1 = (int32_t)f->depth1, depth2 = (int32_t)f->depth2;
    const uint32_t s = range3(0, f->s1, f->s2), t = range3(0, f->t1, f->t2);
    const uint64_t deep = range3(depth0, depth1, depth2), least = (uint32_t)texture_span3(depth0, depth1, depth2).least;
    return m->affine || deep * (s > t ? s : t) <= least << m->uv_bits;
}

void textured_material_open(textured_material_t *m, const tuile_material_t *material, const tuile_texture_t *texture,
                            uint8_t texturing, bool perspective, unsigned uv_bits) {
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
    m->uv_bits = (uint8_t)uv_bits;
    m->pixels_up = (uint8_t)(2 * uv_bits < 9 ? 9 - 2 * uv_bits : 0);
    m->one = (uint16_t)(1u << uv_bits);
    m->s_inside = (INT32_C(1) << (m->log2_width + uv_bits)) - 1;
    m->across = (uint16_t)((m->log2_width < 4 ? 8u << m->log2_width : 127u) << uv_bits);
    m->texels = texture->texels;
    m->palette = (const uint16_t *)(const void *)texture->palette;
    (void)level_set(m, 0);
}
