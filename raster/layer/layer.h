/* Layers: what is drawn over the opaque faces of a tile, with depth: translucent faces, sprites, lines. They may lie in front of
 * and behind one another in any way, so each sample gets its fragments in the order of their depths, farthest first, by peeling:
 * the fragment that is farthest of those nearer than the last one is looked for among all, blended, and so on until there is none.
 * The order in which faces, sprites and lines were submitted decides ties only.
 *
 * Memory: a band of rows of the tile at a time, sizeof(layer_sample_t) + 2 bytes a sample.
 */
#ifndef TUILE_LAYER_LAYER_H
#define TUILE_LAYER_LAYER_H

#include "../frame/frame.h"

/* A place in the order of fragments: farther first, of equally deep ones the one with the lower number last, as it would be seen.
 */
typedef struct layer_key {
    uint16_t depth;  /* as in the depth buffer; 0: none */
    uint16_t number; /* of the item */
} layer_key_t;

typedef struct layer_sample {
    layer_key_t last; /* what was blended last */
    layer_key_t next; /* the farthest one nearer than that, so far */
    uint32_t argb;    /* its colour and alpha */
    uint8_t blend;    /* tuile_blend_t */
    uint8_t unused[3];
} layer_sample_t;

/* Rows of a tile that are drawn at once. All arrays begin at (left, top) and have right - left samples a row. */
typedef struct layer_band {
    int32_t left, top, right, bottom; /* samples of the window */
    const uint16_t *depth;            /* of the opaque faces; 0: background */
    layer_sample_t *samples;
    bool found; /* some sample has a next fragment */
} layer_band_t;

/* Offers a fragment of item `number` at (x, y), within the band. Hidden where an opaque face is as near or nearer. */
TUILE_INLINE bool layer_wants(layer_band_t *band, int32_t x, int32_t y, uint16_t depth, uint16_t number, layer_sample_t **sample) {
    const size_t at = (size_t)(y - band->top) * (size_t)(band->right - band->left) + (size_t)(x - band->left);
    layer_sample_t *s = *sample = &band->samples[at];
    if (depth <= band->depth[at]) { return false; }
    /* Nearer than the last, farther than the next: as numbers, with lower item numbers nearer. */
    const uint32_t key = (uint32_t)depth << 16 | (uint16_t)~number,
                   last = (uint32_t)s->last.depth << 16 | (uint16_t)~s->last.number,
                   next = (uint32_t)s->next.depth << 16 | (uint16_t)~s->next.number;
    return (s->last.depth == 0 || key > last) && (s->next.depth == 0 || key < next);
}

TUILE_INLINE void layer_put(layer_band_t *band, layer_sample_t *sample, uint16_t depth, uint16_t number, uint32_t argb,
                            uint8_t blend) {
    sample->next = (layer_key_t){depth, number};
    sample->argb = argb;
    sample->blend = blend;
    band->found = true;
}

#endif
