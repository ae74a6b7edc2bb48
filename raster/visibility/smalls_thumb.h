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

/* Flat, a face whose colour is not in the ramp: into the ramp with it, or drawn alone. False: it is not drawn. */
static inline bool smalls_given(tuile_t *t, small_run_t *run, const record_t *record) {
    const uint16_t *const ramp = run->ramp;
    const uint32_t number = run->place.list - 1u, limit = run->limit;
    const int32_t known = run->known;
    run->given = frame_value(t, record, number);
    if (ramp && ramp[record->light]) { return true; }
    run->ramp = NULL;
    run->known = -1;
    run->limit = number + 1u;
    small_thumb_flat(run);
    run->ramp = ramp;
    run->known = known;
    run->limit = limit;
    return run->place.list != number + 1u;
}

/* A face that the assembly leaves alone, of the run's material. False: it is not small. */
static inline bool smalls_beside(tuile_t *t, walk_t *walk, small_run_t *run, const record_t *record, const small_tile_t *tile,
                                 small_kind_t kind) {
    const vertex_t *v0 = t->vertices + record->v0, *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    const small_paint_t paint = {.value = (uint16_t)run->given, .ramp = run->ramp};
    small_face_t face;
    if (!small_open(&face, v0, v1, v2, tile, 0)) { return false; }
    const bool reaches = small_fill_clamped(&face, v0, v1, v2, tile, kind, kind == SMALL_GOURAUD, record->light, &paint);
    smalls_place_pass(t, walk, &run->place, &run->right, reaches);
    return true;
}

/* kind: SMALL_FLAT or SMALL_GOURAUD. */
static inline void smalls_thumb(tuile_t *t, walk_t *walk, uint32_t limit, small_kind_t kind) {
    const small_tile_t tile = small_tile(&t->tile);
    const bool known = t->tile_columns == 1 && t->small;
    small_run_t run = smalls_run(t, walk, limit, &tile);
    for (;;) {
        if (run.ramp) { smalls_run_draw(&run, kind); }
        if (run.place.list - 1u >= limit) { break; }
        const record_t *record = frame_record(t, run.place.list - 1u);
        if (!frame_record_is_triangle(record)) { break; }
        if (record->material != run.material) {
            run.material = record->material;
            run.ramp = kind == SMALL_GOURAUD ? frame_ramp(t, record->material) : frame_flat_ramp(t, record->material);
            run.known = known && run.ramp ? run.material : -1;
            continue;
        }
        if (kind == SMALL_FLAT) {
            const bool missing = run.ramp == NULL || run.ramp[record->light] == 0;
            if (missing && smalls_given(t, &run, record)) { continue; }
            if (!missing) { run.given = run.ramp[record->light]; }
        }
        if (!smalls_beside(t, walk, &run, record, &tile, kind)) { break; }
    }
    smalls_place_end(t, walk, &run.place, run.right);
}

#endif
