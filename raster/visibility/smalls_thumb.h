/* smalls_draw of rows.h for strips and columns, by the loop in assembly: fill/small_thumb.c. Here is what that leaves to C. */
#ifndef TUILE_VISIBILITY_SMALLS_THUMB_H
#define TUILE_VISIBILITY_SMALLS_THUMB_H

#include "../fill/small_thumb.h"
#include "rows.h"

/* The run of a tile whose next face is the first one of the list. */
TUILE_INLINE small_run_t smalls_run(tuile_t *t, walk_t *walk, uint32_t limit, const small_tile_t *tile) {
    return (small_run_t){.limit = limit,
                         .arena_end = t->arena_end,
                         .vertices = t->vertices,
                         .known = -1,
                         .top = 16 * (int32_t)tile->top + 8,
                         .height = (int32_t)(tile->bottom - tile->top),
                         .depth = tile->depth - tile->first,
                         .stride = (int32_t)(tile->stride * (small_int_t)sizeof(uint16_t)),
                         .colour = tile->colour * (ptrdiff_t)sizeof(uint16_t) - (ptrdiff_t)sizeof(uint16_t),
                         .material = -1,
                         .left = tile->left,
                         .width = tile->width,
                         .list = walk->list,
                         .end = walk->left.end ? walk->left.end : &walk->left.first};
}

/* A face that the assembly leaves alone, of the run's material. False: it is not small. */
static inline bool smalls_beside(tuile_t *t, walk_t *walk, small_run_t *run, const record_t *record, const small_tile_t *tile) {
    const vertex_t *v0 = t->vertices + record->v0, *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    const uint32_t number = run->list - 1u;
    const small_paint_t paint = {.ramp = run->ramp};
    small_face_t face;
    if (!small_open(&face, v0, v1, v2, tile, 0)) { return false; }
    const bool reaches = small_fill_clamped(&face, v0, v1, v2, tile, SMALL_GOURAUD, true, 0, &paint);
    run->list = record->next;
    run->count++;
    walk->left.end = run->end == &walk->left.first ? NULL : run->end;
    if (t->tile_columns > 1) {
        columns_hand_on(t, number, (uint32_t)t->tile.left / t->config.tile_width, (int32_t)tile->bottom, &walk->right, &walk->left);
    } else if (reaches) {
        list_append(t, &walk->left, number);
    }
    if (walk->left.end) { run->end = walk->left.end; }
    return true;
}

static inline void smalls_thumb(tuile_t *t, walk_t *walk, uint32_t limit) {
    const small_tile_t tile = small_tile(&t->tile);
    const bool known = t->tile_columns == 1 && t->small;
    small_run_t run = smalls_run(t, walk, limit, &tile);
    for (;;) {
        small_thumb_gouraud(&run);
        if (run.list - 1u >= limit) { break; }
        const record_t *record = frame_record(t, run.list - 1u);
        if (!frame_record_is_triangle(record)) { break; }
        if (record->material != run.material) {
            run.material = record->material;
            run.known = known ? run.material : -1;
            run.ramp = frame_ramp(t, record->material);
        } else if (!smalls_beside(t, walk, &run, record, &tile)) {
            break;
        }
    }
    walk->list = (uint16_t)run.list;
    walk->left.end = run.end == &walk->left.first ? NULL : run.end;
    t->stats.faces_setup += run.count;
}

#endif
