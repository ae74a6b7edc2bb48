/* Layers: what is drawn over the opaque faces of a tile, with depth: translucent faces, sprites, lines and edges. They may lie in
 * front of and behind one another in any way, so each sample gets its fragments in the order of their depths, farthest first, by
 * peeling: the fragment that is farthest of those nearer than the last one is looked for among all, blended, and so on until there
 * is none. The order in which faces, sprites and lines were submitted decides ties only: the first is seen over the others.
 *
 * Fragments that hide all behind them (alpha 255, TUILE_BLEND_OVER) need no order: they are drawn first, by depth, as opaque faces
 * are. So lines and cut-out textures take one round, whatever lies behind what.
 *
 * Memory: a band of rows of the tile at a time, sizeof(layer_sample_t) bytes a sample, and the depth of the opaque faces over the
 * whole tile. The faces of a tile are gathered behind those of the pass; where there is no room for them each round goes through
 * the models again (layer.c).
 */
#ifndef TUILE_LAYER_LAYER_H
#define TUILE_LAYER_LAYER_H

#include "../frame/frame.h"

#include "../features.h"

/* The order of fragments. A rank is that of an item, larger for the one that is seen where both are equally deep, and its blend. */
typedef struct layer_sample {
    uint32_t argb;                   /* of `next` */
    uint32_t last_rank, next_rank;   /* layer_rank */
    uint16_t last_depth, next_depth; /* as in the depth buffer: of what was blended last, and of the farthest nearer one; 0: none */
} layer_sample_t;
_Static_assert(sizeof(layer_sample_t) == TUILE_LAYER_SAMPLE_BYTES, "TUILE_LAYER_SAMPLE_BYTES");

/* Items are numbered in the order of submission: faces, then edges, sprites, lines. Each kind has 2^28 numbers. */
enum { LAYER_FACES = 0, LAYER_EDGES = 1, LAYER_SPRITES = 2, LAYER_LINES = 3 };

TUILE_INLINE uint32_t layer_rank(uint32_t kind, uint32_t number, uint8_t blend) {
    return ~(kind << 28 | number) << 2 | (blend <= TUILE_BLEND_MULTIPLY ? blend : (uint32_t)TUILE_BLEND_OVER);
}

/* Rows of a tile that are drawn at once. All arrays begin at (left, top) and have right - left samples a row. */
typedef struct layer_band {
    int32_t left, top, right, bottom; /* samples of the window */
    uint16_t *depth;                  /* of what is opaque; 0: background */
    layer_sample_t *samples;
    uint8_t *colours; /* of the tile */
    pixel_kind_t kind;
    bool solid; /* the round of fragments that hide all behind them, else one of the others */
    bool found; /* there is a fragment for the next round */
} layer_band_t;

/* Is a fragment at (x, y), within the band, to be looked at in this round? Hidden where something opaque is as near or nearer. */
TUILE_INLINE bool layer_wants(const layer_band_t *band, int32_t x, int32_t y, uint16_t depth, uint32_t rank) {
    const size_t at = (size_t)(y - band->top) * (size_t)(band->right - band->left) + (size_t)(x - band->left);
    if (depth <= band->depth[at]) { return false; }
    if (band->solid) { return true; }
    const layer_sample_t *s = &band->samples[at];
    const uint64_t key = (uint64_t)depth << 32 | rank;
    return key > ((uint64_t)s->last_depth << 32 | s->last_rank) &&
           (s->next_depth == 0 || key < ((uint64_t)s->next_depth << 32 | s->next_rank));
}

/* Offers a fragment that layer_wants. argb: 0xaarrggbb; alpha 0: nothing is there. */
TUILE_INLINE void layer_put(layer_band_t *band, int32_t x, int32_t y, uint16_t depth, uint32_t rank, uint32_t argb) {
    const size_t at = (size_t)(y - band->top) * (size_t)(band->right - band->left) + (size_t)(x - band->left);
    const bool hides = argb >> 24 == 255 && (rank & 3u) == TUILE_BLEND_OVER;
    if (argb >> 24 == 0) { return; }
    if (hides != band->solid) {
        band->found = true;
        return;
    }
    if (hides) {
        const uint32_t sample = pixel_pack(band->kind, argb & 0xffffffu);
        band->depth[at] = depth;
        if (pixel_bytes(band->kind) == 4) {
            ((uint32_t *)(void *)band->colours)[at] = sample;
        } else {
            ((uint16_t *)(void *)band->colours)[at] = (uint16_t)sample;
        }
        return;
    }
    layer_sample_t *s = &band->samples[at];
    s->argb = argb;
    s->next_rank = rank;
    s->next_depth = depth;
    band->found = true;
}

/* A fragment's colour in the fog of the scene, if there is any. depth: 1/256 step. */
TUILE_INLINE uint32_t layer_fogged(const tuile_t *t, uint32_t depth, uint32_t argb, uint8_t blend) {
    if (!TUILE_HAS(FOG) || t->fog.kind == TUILE_FOG_NONE) { return argb; }
    return fog_fade(&t->fog, depth << 8, argb, fog_goal(&t->fog, blend));
}

/* colour over, added to or multiplied with what is behind (0x00rrggbb), each component rounded to the nearest. */
uint32_t layer_blend(uint32_t behind, uint32_t argb, uint8_t blend);

/* All layers into the tile, whose samples show its opaque faces. FRAME_OK or a negative error. */
int layer_tile(tuile_t *t);

/* ---- face.c: which faces are translucent; faces as items ---- */

/* Has the instance any translucent face? */
bool layer_translucent(const tuile_t *t, const tuile_instance_t *instance);

/* The instance that was opened last: whether any of its faces are wanted, and which, as t->sift and t->layer_part say. */
bool layer_sift(tuile_t *t);

/* Offers what a record's face shows in the band. */
void layer_face(tuile_t *t, layer_band_t *band, uint32_t record, uint32_t rank_number);

/* ---- place.c: points of the world ---- */

/* A point in the window. x, y: 1/16 sample; depth: 1/256 step. */
typedef struct layer_place {
    int32_t x, y;
    uint32_t depth;
} layer_place_t;

/* View coordinates, Q.16: x right, y up, w along the view. */
typedef struct layer_view {
    int64_t x, y, w;
} layer_view_t;

layer_view_t layer_to_view(const tuile_camera_t *camera, const q16_16_t at[3]);

/* Between near and far plane, and not too far out of the window (LAYER_GUARD samples). */
bool layer_inside(const tuile_camera_t *camera, const layer_view_t *at);
#define LAYER_GUARD 8192

/* Of a point that is inside. */
layer_place_t layer_project(const tuile_camera_t *camera, const layer_view_t *at);

/* A length across the view, Q.16, at distance w > 0, in 1/16 sample. */
int64_t layer_project_length(const tuile_camera_t *camera, q16_16_t focal, int64_t length, int64_t w);

/* ---- sprite.c, line.c ---- */

void layer_sprites(tuile_t *t, layer_band_t *band);
void layer_lines(tuile_t *t, layer_band_t *band);

/* The edges of a record's face, as config.edges says. */
void layer_edges(tuile_t *t, layer_band_t *band, uint32_t record, uint32_t rank_number);

#endif
