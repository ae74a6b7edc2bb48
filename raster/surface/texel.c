/* From bytes to colours. */
#include "../tune.h"

#include "texture.h"

TUILE_INLINE uint32_t read16(const uint8_t *at) { return at[0] | (uint32_t)at[1] << 8; }

/* Steps spread over 0 ... 255, rounded: (x * 255 + most / 2) / most, for most = 31 and 63 without a division. */
TUILE_INLINE uint32_t rgb565(uint32_t c) {
    const uint32_t r = (c >> 11) * 527u + 23u, g = (c >> 5 & 63u) * 259u + 33u, b = (c & 31u) * 527u + 23u;
    return 0xff000000u | (r >> 6) << 16 | (g >> 6) << 8 | b >> 6;
}

TUILE_INLINE uint32_t argb4444(uint32_t c) {
    const uint32_t spread = (c & 0xf000u) << 12 | (c & 0x0f00u) << 8 | (c & 0x00f0u) << 4 | (c & 0x000fu);
    return spread * 17u;
}

TUILE_INLINE uint32_t entry(const tuile_texture_t *texture, uint32_t index) {
    const uint32_t c = read16(texture->palette + 2 * index);
    return texture->flags & TUILE_TEXTURE_PALETTE_ALPHA ? argb4444(c) : rgb565(c);
}

uint32_t texture_level_texel(const tuile_texture_t *texture, const texture_level_t *level, uint32_t s, uint32_t t) {
    const uint8_t *row = level->texels + (size_t)t * level->row_bytes;
    const bool keyed = texture->flags & TUILE_TEXTURE_KEY;
    uint32_t bits;
    switch (texture->format) {
    case TUILE_TEXEL_PALETTE8: bits = row[s]; break;
    case TUILE_TEXEL_PALETTE4: bits = (uint32_t)row[s >> 1] >> (4 * (s & 1)) & 15u; break;
    case TUILE_TEXEL_GREY8: bits = row[s]; break;
    default: bits = read16(row + 2 * s); break;
    }
    if (keyed && bits == texture->key) { return 0; }
    switch (texture->format) {
    case TUILE_TEXEL_PALETTE8:
    case TUILE_TEXEL_PALETTE4: return entry(texture, bits);
    case TUILE_TEXEL_GREY8: return 0xff000000u | bits * 0x010101u;
    case TUILE_TEXEL_ARGB4444: return argb4444(bits);
    default: return rgb565(bits);
    }
}

texture_level_t texture_level(const tuile_texture_t *texture, unsigned number) {
    texture_level_t level = {texture->texels, texture->width, texture->height, texture_row_bytes(texture->format, texture->width)};
    for (; number > 0; number--) {
        const uint32_t bytes = level.row_bytes * level.height;
        level.texels += bytes + (bytes & 1);
        level.width = (uint16_t)(level.width > 1 ? level.width / 2 : 1);
        level.height = (uint16_t)(level.height > 1 ? level.height / 2 : 1);
        level.row_bytes = texture_row_bytes(texture->format, level.width);
    }
    return level;
}

/* Any number into 0 ... size - 1. */
static uint32_t bring_in(int32_t at, uint32_t size, bool clamp) {
    if (clamp) { return at < 0 ? 0 : (uint32_t)at >= size ? size - 1 : (uint32_t)at; }
    if ((size & (size - 1)) == 0) { return (uint32_t)at & (size - 1); }
    const int32_t rest = at % (int32_t)size;
    return (uint32_t)(rest < 0 ? rest + (int32_t)size : rest);
}

uint32_t texture_texel(const tuile_texture_t *texture, int32_t s, int32_t t) {
    const texture_level_t level = texture_level(texture, 0);
    return texture_level_texel(texture, &level, bring_in(s, level.width, texture->flags & TUILE_TEXTURE_CLAMP_S),
                               bring_in(t, level.height, texture->flags & TUILE_TEXTURE_CLAMP_T));
}
