#include "../tune.h"

#include "textured.h"

#include "triangle_rows.h"

/* What stays the same over the rows. */
typedef struct textured_context {
    textured_map_t map;
    textured_tile_t to;
    uint64_t dx;
    ptrdiff_t samples; /* from the depth of a pixel to its sample, in steps of 2 bytes */
} textured_context_t;

TUILE_INLINE uint64_t map_at(const textured_map_t *map, int32_t x, int32_t y) {
    return map->v + map->dx * (uint64_t)(int64_t)x + map->dy * (uint64_t)(int64_t)y;
}

TUILE_INLINE uint32_t texel_at(const void *texels, const uint16_t *palette, uint32_t index, bool paletted) {
    return paletted ? palette[((const uint8_t *)texels)[index]] : ((const uint16_t *)texels)[index];
}

TUILE_INLINE uint16_t ordered(uint32_t colour, bool swap) {
    const uint16_t value = (uint16_t)colour;
    return swap ? (uint16_t)(value >> 8 | value << 8) : value;
}

/* paletted and swap are constants in the loops that most frames are drawn by. */
TUILE_INLINE void span_textured(const triangle_t *triangle, const raster_tile_t *tile, const triangle_span_t *span,
                                const textured_context_t *context, bool paletted, bool swap) {
    const textured_map_t *map = &context->map;
    (void)triangle;
    const uint64_t dx = context->dx, at_dx = map->dx, mask = map->mask;
    const ptrdiff_t samples = context->samples;
    uint64_t shade = span->shade + dx * (uint64_t)(int64_t)span->from, at = map_at(map, span->from, span->row);
    for (uint16_t *depth = tile->depth + span->at, *const end = depth + span->count; depth != end; depth++) {
        const uint16_t z = (uint16_t)(shade >> 48);
        if (z > *depth) {
            const uint32_t texel = texel_at(map->texels, map->palette, textured_index(at, mask), paletted);
            *depth = z;
            depth[samples] = ordered(textured_lit(texel, textured_levels((uint32_t)shade)), swap);
        }
        shade += dx;
        at += at_dx;
    }
}

TUILE_INLINE void span_colours(const triangle_t *triangle, const raster_tile_t *tile, const triangle_span_t *span,
                               const void *context) {
    span_textured(triangle, tile, span, context, false, true);
}

TUILE_INLINE void span_paletted(const triangle_t *triangle, const raster_tile_t *tile, const triangle_span_t *span,
                                const void *context) {
    span_textured(triangle, tile, span, context, true, true);
}

TUILE_INLINE void span_any(const triangle_t *triangle, const raster_tile_t *tile, const triangle_span_t *span,
                           const void *context) {
    const textured_context_t *c = context;
    span_textured(triangle, tile, span, c, c->map.palette != NULL, c->to.swap);
}

TUILE_INLINE textured_context_t context_of(const textured_t *textured, const raster_tile_t *tile, const textured_tile_t *to) {
    return (textured_context_t){textured->map, *to, textured->triangle.dx, to->samples - tile->depth};
}

static TUILE_NOINLINE void fill_colours(textured_t *textured, const raster_tile_t *tile, const textured_tile_t *to) {
    const textured_context_t context = context_of(textured, tile, to);
    triangle_rows(&textured->triangle, tile, true, false, span_colours, &context);
}

static TUILE_NOINLINE void fill_paletted(textured_t *textured, const raster_tile_t *tile, const textured_tile_t *to) {
    const textured_context_t context = context_of(textured, tile, to);
    triangle_rows(&textured->triangle, tile, true, false, span_paletted, &context);
}

static TUILE_NOINLINE void fill_any(textured_t *textured, const raster_tile_t *tile, const textured_tile_t *to) {
    const textured_context_t context = context_of(textured, tile, to);
    triangle_rows(&textured->triangle, tile, true, true, span_any, &context);
}

void textured_fill(textured_t *textured, const raster_tile_t *tile, const textured_tile_t *to) {
    const fill_head_t *head = &textured->triangle.head;
    if (head->left < tile->left || head->right > tile->right || !to->swap) {
        fill_any(textured, tile, to);
    } else if (textured->map.palette != NULL) {
        fill_paletted(textured, tile, to);
    } else {
        fill_colours(textured, tile, to);
    }
}

void textured_run(const textured_map_t *map, int32_t x, int32_t y, int32_t count, uint32_t light, uint32_t light_dx, bool swap,
                  uint16_t *samples) {
    uint64_t at = map_at(map, x, y);
    for (int32_t i = 0; i < count; i++) {
        const uint32_t texel = texel_at(map->texels, map->palette, textured_index(at, map->mask), map->palette != NULL);
        samples[i] = ordered(textured_lit(texel, textured_levels(light)), swap);
        at += map->dx;
        light += light_dx;
    }
}
