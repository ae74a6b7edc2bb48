/* Between a walk and a loop in assembly over its small triangles: where either has come to. */
#ifndef TUILE_VISIBILITY_SMALLS_PLACE_H
#define TUILE_VISIBILITY_SMALLS_PLACE_H

#include "rows.h"

TUILE_INLINE small_place_t smalls_place(walk_t *walk) {
    return (small_place_t){.list = walk->list, .end = walk->left.end ? walk->left.end : &walk->left.first};
}

/* Where the number of the next face that the column to the right takes over is put. NULL: there is no such column. */
TUILE_INLINE uint16_t *smalls_place_right(const tuile_t *t, walk_t *walk) {
    const uint32_t width = t->config.tile_width;
    if ((uint32_t)t->tile.left + width >= t->tile_columns * width) { return NULL; }
    return walk->right.end ? walk->right.end : &walk->right.first;
}

/* The lists' ends, back to the walk. */
TUILE_INLINE void smalls_place_ends(walk_t *walk, const small_place_t *place, uint16_t *right) {
    walk->left.end = place->end == &walk->left.first ? NULL : place->end;
    walk->right.end = right == &walk->right.first ? NULL : right;
}

/* Past the next face, which C has drawn. right: smalls_place_right. reaches: below the tile. */
static inline void smalls_place_pass(tuile_t *t, walk_t *walk, small_place_t *place, uint16_t **right, bool reaches) {
    const uint32_t number = place->list - 1u;
    place->list = frame_record(t, number)->next;
    place->count++;
    smalls_place_ends(walk, place, *right);
    if (t->tile_columns > 1) {
        columns_hand_on(t, number, (uint32_t)t->tile.left / t->config.tile_width, t->tile.bottom, &walk->right, &walk->left);
    } else if (reaches) {
        list_append(t, &walk->left, number);
    }
    if (walk->left.end) { place->end = walk->left.end; }
    if (walk->right.end) { *right = walk->right.end; }
}

TUILE_INLINE void smalls_place_end(tuile_t *t, walk_t *walk, const small_place_t *place, uint16_t *right) {
    walk->list = (uint16_t)place->list;
    smalls_place_ends(walk, place, right);
    t->stats.faces_setup += place->count;
}

#endif
