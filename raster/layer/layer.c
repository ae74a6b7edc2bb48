/* Tiles in bands, bands in rounds; where the translucent faces of a tile come from. */
#include "layer.h"

/* ---- blending ---- */

/* a * b / 255, rounded. */
static uint32_t part(uint32_t a, uint32_t b) { return pixel_div255(a * b + 127u); }

static uint32_t blend_component(uint32_t behind, uint32_t colour, uint32_t alpha, uint8_t blend) {
    switch (blend) {
    case TUILE_BLEND_ADD: {
        const uint32_t sum = behind + part(colour, alpha);
        return sum > 255 ? 255 : sum;
    }
    case TUILE_BLEND_MULTIPLY: return part(behind, 255u - alpha + part(colour, alpha));
    default: return pixel_div255(colour * alpha + behind * (255u - alpha) + 127u);
    }
}

uint32_t layer_blend(uint32_t behind, uint32_t argb, uint8_t blend) {
    const uint32_t alpha = argb >> 24;
    return PIXEL_RGB(blend_component(behind >> 16 & 255u, argb >> 16 & 255u, alpha, blend),
                     blend_component(behind >> 8 & 255u, argb >> 8 & 255u, alpha, blend),
                     blend_component(behind & 255u, argb & 255u, alpha, blend));
}

/* The fragments that a round found, into the tile. */
static void band_blend(layer_band_t *band) {
    const size_t samples = (size_t)(band->right - band->left) * (size_t)(band->bottom - band->top);
    const bool wide = pixel_bytes(band->kind) == 4;
    for (size_t i = 0; i < samples; i++) {
        layer_sample_t *s = &band->samples[i];
        if (s->next_depth == 0) { continue; }
        uint32_t *word = (uint32_t *)(void *)band->colours + i;
        uint16_t *half = (uint16_t *)(void *)band->colours + i;
        const uint32_t behind = pixel_unpack(band->kind, wide ? *word : *half);
        const uint32_t sample = pixel_pack(band->kind, layer_blend(behind, s->argb, s->next_rank & 3u));
        if (wide) {
            *word = sample;
        } else {
            *half = (uint16_t)sample;
        }
        s->last_depth = s->next_depth;
        s->last_rank = s->next_rank;
        s->next_depth = 0;
    }
}

/* ---- faces of the tile, from the models ----
 *
 * The parts are the translucent faces and those whose edges are drawn. Their records are numbered on from those of the pass, and
 * stand between its states and its records, until the tile is done. Where there is no room for them the pass is given up, so that
 * one cluster and one face find room, and each round offers the faces as they come; the next tile begins a pass of its own.
 */

enum { PARTS = 2 };

typedef struct items {
    bool gathered;
    uint32_t first, end[PARTS]; /* records: first ... end[0] - 1 of faces, end[0] ... end[1] - 1 of edges */
} items_t;

typedef struct kept {
    transform_region_t region;
    uint16_t *buckets;
    uint16_t tile_height, bucket;
    uint32_t vertex_count, record_count, cluster_end;
} kept_t;

/* Edges may be seen this far beyond the face, in samples. */
#define EDGE_MARGIN 3

static void region_of_tile(tuile_t *t) {
    const int32_t more = t->config.edges != TUILE_EDGES_NONE ? EDGE_MARGIN : 0;
    const raster_tile_t *tile = &t->tile;
    t->region = (transform_region_t){(uint16_t)(tile->left > more ? tile->left - more : 0),
                                     (uint16_t)(tile->top > more ? tile->top - more : 0), (uint16_t)(tile->right + more),
                                     (uint16_t)(tile->bottom + more)};
}

/* Faces of the tile are binned from here on: into one bucket that nobody asks. */
static void items_begin(tuile_t *t, kept_t *kept) {
    *kept = (kept_t){.region = t->region,
                     .buckets = t->buckets,
                     .tile_height = t->config.tile_height,
                     .vertex_count = t->vertex_count,
                     .record_count = t->record_count,
                     .cluster_end = t->cluster_end};
    t->buckets = &kept->bucket;
    t->config.tile_height = UINT16_MAX;
    t->instance = NULL;
    region_of_tile(t);
}

static void items_end(tuile_t *t, const kept_t *kept) {
    t->region = kept->region;
    t->buckets = kept->buckets;
    t->config.tile_height = kept->tile_height;
    t->vertex_count = kept->vertex_count;
    t->record_count = kept->record_count;
    t->cluster_end = kept->cluster_end;
    t->layer_part = LAYER_PART_OPAQUE;
}

static bool has_part(const tuile_t *t, unsigned part) {
    return part == 0 ? t->config.edges == TUILE_EDGES_NONE || t->config.edges == TUILE_EDGES_OUTLINE
                     : TUILE_HAS(LINES) && t->config.edges != TUILE_EDGES_NONE;
}

static int part_bin(tuile_t *t, unsigned part) {
    t->layer_part = part == 0 ? LAYER_PART_FACES : LAYER_PART_EDGES;
    if (!has_part(t, part)) { return FRAME_OK; }
    for (unsigned i = 0; i < t->scene->instance_count; i++) {
        if (part == 0 && !layer_translucent(t, &t->scene->instances[i])) { continue; }
        const int result = bin_instance(t, i);
        if (result != FRAME_OK) { return result; }
    }
    return FRAME_OK;
}

static int items_gather(tuile_t *t, items_t *items) {
    /* Behind the states of the pass. */
    const uint8_t *after = t->immediate ? (const uint8_t *)t->vertices : t->stream_end;
    if (t->immediate) { t->vertex_count = t->record_count = 0; }
    while ((const uint8_t *)(t->vertices + t->vertex_count) < after) {
        t->vertex_count++;
    }
    if (t->vertex_count > t->vertex_limit) { return FRAME_FULL; }
    items->first = t->record_count;
    const bool immediate = t->immediate;
    t->immediate = false;
    int result = FRAME_OK;
    for (unsigned part = 0; part < PARTS && result == FRAME_OK; part++) {
        result = part_bin(t, part);
        items->end[part] = t->record_count;
    }
    t->immediate = immediate;
    return result;
}

static void item_offer(tuile_t *t, layer_band_t *band, unsigned part, uint32_t record, uint32_t number) {
    if (part == 0) {
        layer_face(t, band, record, number);
    } else if (TUILE_HAS(LINES)) {
        layer_edges(t, band, record, number);
    }
}

/* Takes the place of draw_now. */
static void item_now(tuile_t *t, uint32_t number) {
    item_offer(t, t->layer_band, t->layer_part == LAYER_PART_FACES ? 0 : 1, number, t->layer_number++);
}

/* All faces once more. */
static int items_stream(tuile_t *t, layer_band_t *band) {
    int result = FRAME_OK;
    t->immediate = true;
    t->draw_now = item_now;
    t->layer_band = band;
    for (unsigned part = 0; part < PARTS && result == FRAME_OK; part++) {
        t->vertex_count = t->record_count = 0;
        t->layer_number = 0;
        result = part_bin(t, part);
    }
    return result;
}

/* ---- bands and rounds ---- */

static int round_offer(tuile_t *t, layer_band_t *band, const items_t *items) {
    band->found = false;
    if (items->gathered) {
        uint32_t number = items->first;
        for (unsigned part = 0; part < PARTS; part++) {
            for (uint32_t k = 0; number < items->end[part]; number++, k++) {
                item_offer(t, band, part, number, k);
            }
        }
    } else {
        const int result = items_stream(t, band);
        if (result != FRAME_OK) { return result; }
    }
    layer_sprites(t, band);
    if (TUILE_HAS(LINES)) { layer_lines(t, band); }
    return FRAME_OK;
}

static int band_draw(tuile_t *t, layer_band_t *band, const items_t *items) {
    const size_t samples = (size_t)(band->right - band->left) * (size_t)(band->bottom - band->top);
    frame_fill_words(band->samples, 0, samples * sizeof(layer_sample_t));
    band->solid = true;
    int result = round_offer(t, band, items);
    band->solid = false;
    while (result == FRAME_OK && band->found) {
        result = round_offer(t, band, items);
        band_blend(band);
    }
    return result;
}

static int bands_draw(tuile_t *t, const items_t *items) {
    const raster_tile_t *tile = &t->tile;
    const size_t stride = (size_t)tile->stride_px;
    uint8_t *colours = t->working ? t->working : t->colours[t->next_buffer];
    int result = FRAME_OK;
    for (int32_t top = tile->top; top < tile->bottom && result == FRAME_OK; top += t->layer_rows) {
        const size_t first = (size_t)(top - tile->top) * stride;
        layer_band_t band = {.left = tile->left, .top = top, .right = tile->right, .samples = t->layer_samples};
        band.bottom = top + t->layer_rows < tile->bottom ? top + t->layer_rows : tile->bottom;
        band.depth = t->layer_depth + first;
        band.kind = (pixel_kind_t)t->pixel_kind;
        band.colours = colours + first * pixel_bytes(band.kind);
        result = band_draw(t, &band, items);
    }
    return result;
}

int layer_tile(tuile_t *t) {
    items_t items = {.gathered = true};
    kept_t kept;
    items_begin(t, &kept);
    int result = items_gather(t, &items);
    if (result == FRAME_FULL) {
        items.gathered = false;
        if (!t->immediate) {
            t->pass_valid = false;
            t->shrunk = true;
            if (!t->narrow) { t->rows_hint = 1; }
        }
        result = FRAME_OK;
    }
    if (items.gathered) { pass_measure(t, 0); }
    const bool immediate = t->immediate;
    const bool any =
        !items.gathered || items.end[PARTS - 1] > items.first || t->scene->sprite_count != 0 || t->scene->line_count != 0;
    if (result == FRAME_OK && any) { result = bands_draw(t, &items); }
    t->immediate = immediate;
    items_end(t, &kept);
    if (result != FRAME_FULL) { return result; }
    t->wanted_bytes = (size_t)t->stats.size_bytes + t->stats.size_bytes / 8;
    return TUILE_ERROR_MEMORY;
}
