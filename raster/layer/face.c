/* Which faces are translucent, and such faces as fragments. */
#include "layer.h"

#include "../frame/shade.h"
#include "../memory.h"

/* ---- which ---- */

static bool texture_translucent(const tuile_texture_t *texture) {
    return texture->format == TUILE_TEXEL_ARGB4444 || (texture->flags & (TUILE_TEXTURE_KEY | TUILE_TEXTURE_PALETTE_ALPHA)) != 0;
}

static bool material_translucent(const tuile_t *t, const tuile_instance_t *instance, uint32_t number) {
    const tuile_material_t material = frame_instance_material(instance, number);
    if (material.alpha < 255 || material.blend != TUILE_BLEND_OVER) { return true; }
    if (material.texture >= instance->model->texture_count || t->config.texturing & TUILE_TEXTURE_OFF) { return false; }
    const tuile_texture_t texture = tuile_model_texture(instance->model, material.texture);
    return texture_translucent(&texture);
}

static bool colours_translucent(const tuile_model_t *model) {
    for (uint32_t i = 0; model->colours != NULL && i < model->vertex_count; i++) {
        if (model->colours[4 * (size_t)i + 3] != 255) { return true; }
    }
    return false;
}

bool layer_translucent(const tuile_t *t, const tuile_instance_t *instance) {
    for (uint32_t i = 0; i < instance->model->material_count; i++) {
        if (material_translucent(t, instance, i)) { return true; }
    }
    return colours_translucent(instance->model);
}

static bool sift_edges(tuile_t *t) {
    const uint8_t edges = t->config.edges;
    if (edges == TUILE_EDGES_ALL) { t->sides = SIDE_FRONT | SIDE_BACK; }
    if (edges == TUILE_EDGES_OUTLINE) { t->sides = SIDE_BACK; }
    if (t->sides & SIDE_BACK) { t->transform.cones = false; }
    if (edges == TUILE_EDGES_ALL || edges == TUILE_EDGES_OUTLINE) { t->mixed = false; } /* whatever sides the materials show */
    t->sift = SIFT_ALL;
    return true;
}

bool layer_sift(tuile_t *t) {
    const uint8_t edges = t->config.edges;
    const uint32_t count = t->instance->model->material_count;
    t->sift = SIFT_NONE;
    if (t->layer_part == LAYER_PART_EDGES) { return sift_edges(t); }
    if (edges == TUILE_EDGES_ALL || edges == TUILE_EDGES_FRONT) { return false; }
    if (edges == TUILE_EDGES_HIDDEN) { return true; }

    const bool all = colours_translucent(t->instance->model);
    uint32_t translucent = 0;
    memset(t->translucent, 0, 256 / 8);
    for (uint32_t i = 0; i < count && i < 256; i++) {
        if (all || material_translucent(t, t->instance, i)) {
            t->translucent[i / 32] |= 1u << i % 32;
            translucent++;
        }
    }
    if (t->layer_part == LAYER_PART_OPAQUE) {
        t->sift = translucent ? SIFT_OPAQUE : SIFT_NONE;
        return translucent < count;
    }
    t->sift = SIFT_TRANSLUCENT;
    return translucent != 0;
}

/* ---- fragments ---- */

typedef struct offer {
    tuile_t *t;
    const record_t *record;
    layer_band_t *band;
    uint32_t rank;
    depth_plane_t depth;
    surface_t surface;
    bool is_made; /* surface */
} offer_t;

/* Samples first ... end - 1 of row y, at most SURFACE_RUN. */
static void offer_some(offer_t *offer, int32_t y, int32_t first, int32_t end) {
    uint16_t depth[SURFACE_RUN];
    uint32_t argb[SURFACE_RUN], wanted = 0;
    for (int32_t x = first; x < end; x++) {
        depth[x - first] = depth_at(&offer->depth, x, y);
        if (layer_wants(offer->band, x, y, depth[x - first], offer->rank)) { wanted |= 1u << (x - first); }
    }
    if (wanted == 0) { return; }
    if (!offer->is_made) {
        shade_surface(offer->t, offer->record, &offer->surface, PIXEL_RGB888);
        offer->is_made = true;
    }
    surface_run(&offer->surface, first, y, end - first, argb);
    for (int32_t x = first; x < end; x++) {
        if (wanted >> (x - first) & 1u) { layer_put(offer->band, x, y, depth[x - first], offer->rank, argb[x - first]); }
    }
}

static void offer_run(offer_t *offer, int32_t y, int32_t first, int32_t end) {
    for (; first < end; first += SURFACE_RUN) {
        offer_some(offer, y, first, end - first < SURFACE_RUN ? end : first + SURFACE_RUN);
    }
}

/* The face's pixels from row `top` on as ones among the numbers of the tile, which are all 0; false when there are none. */
static bool paint(const tuile_t *t, const record_t *record, const raster_tile_t *to, int32_t top) {
    if (frame_record_is_triangle(record)) {
        const vertex_t *v0 = &t->vertices[record->v0];
        triangle_t triangle;
        triangle_paint_start(&triangle, v0, v0 + record->d1, v0 + record->d2, top, false);
        triangle.value = 1;
        triangle_paint(&triangle, to, SPAN_FLAT, NULL);
        return true;
    }
    const polygon_ring_t ring = frame_record_ring(t, record);
    polygon_t polygon;
    if (!polygon_paint_start(&polygon, &ring, top)) { return false; }
    polygon.value = 1;
    polygon_paint(&polygon, &ring, to, SPAN_FLAT);
    return true;
}

void layer_face(tuile_t *t, layer_band_t *band, uint32_t record, uint32_t number) {
    const int32_t stride = band->right - band->left;
    raster_tile_t to = {.left = band->left, .top = band->top, .right = band->right, .bottom = band->bottom, .stride_px = stride};
    offer_t offer = {.t = t, .record = frame_record(t, record), .band = band};
    const uint32_t material = offer.record->material;
    int32_t left, top, right, bottom;
    shade_box(t, offer.record, &left, &top, &right, &bottom);
    if (top < band->top) { top = band->top; }
    if (bottom > band->bottom) { bottom = band->bottom; }
    if (top >= bottom || left >= right) { return; }

    uint16_t *row = t->numbers + (size_t)(band->top - t->tile.top) * (size_t)stride;
    to.colour = row;
    if (!shade_depth(t, offer.record, &offer.depth) || !paint(t, offer.record, &to, top)) { return; }
    const source_slot_t *source =
        (const source_slot_t *)(const void *)&t->vertices[frame_record_surface(frame_record(t, record))->source];
    offer.rank = layer_rank(LAYER_FACES, number, frame_instance_material(&t->scene->instances[source->instance], material).blend);
    row += (size_t)(top - band->top) * (size_t)stride;
    for (int32_t y = top; y < bottom; y++, row += stride) {
        uint16_t *at = row + (left - band->left), *end = row + (right - band->left);
        while (at < end) {
            if (*at == 0) {
                at++;
                continue;
            }
            const uint16_t *first = at;
            while (at < end && *at != 0) {
                *at++ = 0;
            }
            offer_run(&offer, y, band->left + (int32_t)(first - row), band->left + (int32_t)(at - row));
        }
    }
}
