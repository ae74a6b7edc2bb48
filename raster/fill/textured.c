#include "../tune.h"
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-gcse", "ira-region=one") /* 1.5 % fewer: more stays in registers */
#endif

#include "textured.h"

#include "triangle_set_up.h"

TUILE_INLINE uint32_t map_at(const textured_map_t *map, int32_t x, int32_t y) {
    return map->v + map->dx * (uint32_t)x + map->dy * (uint32_t)y;
}

/* One row: `depth` is that of its first pixel; samples lie `samples` places of 2 bytes from there. paletted and swap are constants
 * in the loops that most frames are drawn by. */
TUILE_INLINE void span_textured(const textured_t *textured, uint16_t *depth, ptrdiff_t samples, int32_t count, uint64_t shade,
                                uint32_t at, const textured_constants_t *constants, bool paletted, bool swap) {
    const textured_map_t *map = &textured->map;
    const uint64_t dx = textured->triangle.dx;
    const uint32_t at_dx = map->dx, mask = map->mask, shift = map->shift;
    for (const uint16_t *const end = depth + count; depth != end; depth++) {
        const uint16_t z = (uint16_t)(shade >> 48);
        if (z > *depth) {
            const uint32_t texel = textured_texel(map->texels, map->palette, textured_index(at, mask, shift, constants), paletted);
            *depth = z;
            depth[samples] = textured_lit(texel, textured_levels((uint32_t)shade), constants, swap);
        }
        shade += dx;
        at += at_dx;
    }
}

/* Row by row, as fill/triangle.c does; both numbers are stepped from row to row, which saves what entering a row by its number
 * would cost. */
TUILE_INLINE void fill_rows(textured_t *textured, const raster_tile_t *tile, ptrdiff_t samples, bool clamp, bool paletted,
                            bool swap) {
    const textured_constants_t constants = textured_constants();
    triangle_t *t = &textured->triangle;
    const int32_t end = t->head.row_end < tile->bottom ? t->head.row_end : tile->bottom;
    int32_t row = t->row;
    uint16_t *depth = tile->depth + ((ptrdiff_t)(row - tile->top) * tile->stride_px - tile->left);
    uint64_t shade = t->shade;
    uint32_t at = map_at(&textured->map, 0, row);
    for (;;) {
        const int32_t until = t->row_mid < end ? t->row_mid : end;
        short_edge_t a = t->side.brief.a, b = t->side.brief.b;
        for (; row < until; row++) {
            int32_t from = short_edge_pixel(a.x), to = short_edge_pixel(b.x);
            if (clamp) {
                from = from > tile->left ? from : tile->left;
                to = to < tile->right ? to : tile->right;
            }
            if (to > from) {
                span_textured(textured, depth + from, samples, to - from, shade + t->dx * (uint64_t)(int64_t)from,
                              at + textured->map.dx * (uint32_t)from, &constants, paletted, swap);
            }
            a.x = (int32_t)((uint32_t)a.x + (uint32_t)a.slope); /* may wrap behind the last row */
            b.x = (int32_t)((uint32_t)b.x + (uint32_t)b.slope);
            shade += t->dy;
            at += textured->map.dy;
            depth += tile->stride_px;
        }
        if (row >= t->head.row_end) { break; }
        t->side.brief.a = a;
        t->side.brief.b = b;
        if (row == t->row_mid) { triangle_bend(t); }
        if (row >= end) { break; }
    }
    t->row = (int16_t)row;
    t->shade = shade;
}

static TUILE_NOINLINE void fill_colours(textured_t *textured, const raster_tile_t *tile, ptrdiff_t samples) {
    fill_rows(textured, tile, samples, false, false, true);
}

static TUILE_NOINLINE void fill_paletted(textured_t *textured, const raster_tile_t *tile, ptrdiff_t samples) {
    fill_rows(textured, tile, samples, false, true, true);
}

static TUILE_NOINLINE void fill_any(textured_t *textured, const raster_tile_t *tile, ptrdiff_t samples, bool swap) {
    fill_rows(textured, tile, samples, true, textured->map.palette != NULL, swap);
}

void textured_fill(textured_t *textured, const raster_tile_t *tile, const textured_tile_t *to) {
    const fill_head_t *head = &textured->triangle.head;
    const ptrdiff_t samples = to->samples - tile->depth; /* both have the tile's pixels */
    if (head->left < tile->left || head->right > tile->right || !to->swap) {
        fill_any(textured, tile, samples, to->swap);
    } else if (textured->map.palette != NULL) {
        fill_paletted(textured, tile, samples);
    } else {
        fill_colours(textured, tile, samples);
    }
}

void textured_run(const textured_map_t *map, int32_t x, int32_t y, int32_t count, uint32_t light, uint32_t light_dx, bool swap,
                  uint16_t *samples) {
    const textured_constants_t constants = textured_constants();
    uint32_t at = map_at(map, x, y);
    for (int32_t i = 0; i < count; i++) {
        const uint32_t texel =
            textured_texel(map->texels, map->palette, textured_index(at, map->mask, map->shift, &constants), map->palette != NULL);
        samples[i] = textured_lit(texel, textured_levels(light), &constants, swap);
        at += map->dx;
        light += light_dx;
    }
}
