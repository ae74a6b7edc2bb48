/* smalls_draw of rows.h for strips and columns, by the loops in assembly: fill/small_thumb.c. Here is what they leave to C. */
#ifndef TUILE_VISIBILITY_SMALLS_THUMB_H
#define TUILE_VISIBILITY_SMALLS_THUMB_H

#include "../fill/small_thumb.h"
#include "smalls_place.h"

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
                         .record_bytes = t->record_bytes,
                         .colour = tile->colour * (ptrdiff_t)sizeof(uint16_t),
                         .material = -1,
                         .left = tile->left,
                         .width = tile->width,
                         .place = smalls_place(walk),
                         .right = smalls_place_right(t, walk)};
}

TUILE_INLINE void smalls_run_draw(small_run_t *run, small_kind_t kind) {
    if (kind == SMALL_GOURAUD) {
        small_thumb_gouraud(run);
    } else {
        small_thumb_flat(run);
    }
}

/* Draws the next face with the given colour. False: it is not short. */
static TUILE_NOINLINE bool smalls_alone(small_run_t *run) {
    const uint16_t *const ramp = run->ramp;
    const uint32_t limit = run->limit, list = run->place.list;
    const int32_t known = run->known;
    run->ramp = NULL;
    run->known = -1;
    run->limit = list;
    small_thumb_flat(run);
    run->ramp = ramp;
    run->known = known;
    run->limit = limit;
    return run->place.list != list;
}

/* Flat, a face whose colour is not in the ramp: into the ramp with it, or drawn alone. False: it is not drawn. */
static inline bool smalls_given(tuile_t *t, small_run_t *run, const record_t *record) {
    run->given = frame_value(t, record, run->place.list - 1u);
    return (run->ramp && run->ramp[record->light]) || smalls_alone(run);
}

/* kind: SMALL_FLAT or SMALL_GOURAUD. */
static inline void smalls_thumb(tuile_t *t, walk_t *walk, uint32_t limit, small_kind_t kind) {
    const small_tile_t tile = small_tile(&t->tile);
    const bool known = t->tile_columns > 1 || t->small; /* columns.h has short ones only */
    const int32_t beside = t->tile_columns > 1 ? SMALL_RUN_SHORT : 0;
    small_run_t run = smalls_run(t, walk, limit, &tile);
    for (;;) {
        if (run.ramp) { smalls_run_draw(&run, kind); }
        if (run.place.list - 1u >= limit) { break; }
        const record_t *record = frame_record(t, run.place.list - 1u);
        if (!frame_record_is_triangle(record)) { break; }
        if (record->material != run.material) {
            run.material = record->material;
            run.ramp = kind == SMALL_GOURAUD ? frame_ramp(t, record->material) : frame_flat_ramp(t, record->material);
            run.known = known && run.ramp ? run.material + beside : -1;
            continue;
        }
        /* not short, or a colour is missing */
        if (kind != SMALL_FLAT || (run.ramp && run.ramp[record->light]) || !smalls_given(t, &run, record)) { break; }
    }
    smalls_place_end(t, walk, &run.place, run.right);
}

#endif
