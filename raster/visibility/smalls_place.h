/* Between a walk and a loop in assembly over its small triangles: where either has come to. */
#ifndef TUILE_VISIBILITY_SMALLS_PLACE_H
#define TUILE_VISIBILITY_SMALLS_PLACE_H

#include "rows.h"

TUILE_INLINE small_place_t smalls_place(walk_t *walk) {
    return (small_place_t){.list = walk->list, .end = walk->left.end ? walk->left.end : &walk->left.first};
}

TUILE_INLINE void smalls_place_left(walk_t *walk, const small_place_t *place) {
    walk->left.end = place->end == &walk->left.first ? NULL : place->end;
}

/* Past the next face, which C has drawn. reaches: below the tile. */
static inline void smalls_place_pass(tuile_t *t, walk_t *walk, small_place_t *place, bool reaches) {
    const uint32_t number = place->list - 1u;
    place->list = frame_record(t, number)->next;
    place->count++;
    smalls_place_left(walk, place);
    if (t->tile_columns > 1) {
        columns_hand_on(t, number, (uint32_t)t->tile.left / t->config.tile_width, t->tile.bottom, &walk->right, &walk->left);
    } else if (reaches) {
        list_append(t, &walk->left, number);
    }
    if (walk->left.end) { place->end = walk->left.end; }
}

TUILE_INLINE void smalls_place_end(tuile_t *t, walk_t *walk, const small_place_t *place) {
    walk->list = (uint16_t)place->list;
    smalls_place_left(walk, place);
    t->stats.faces_setup += place->count;
}

#endif
