/* smalls_draw of rows.h for textured faces with light at their corners, by the loop in assembly: fill/textured_thumb.c. Here is
 * what that leaves to C.
 */
#ifndef TUILE_VISIBILITY_SMALLS_TEXTURED_H
#define TUILE_VISIBILITY_SMALLS_TEXTURED_H

#include "../fill/textured_thumb.h"
#include "smalls_place.h"

/* The run of a tile, without what a source and a level decide. */
TUILE_INLINE textured_run_t smalls_textured_run(const tuile_t *t, walk_t *walk, uint32_t limit, const small_tile_t *tile) {
    return (textured_run_t){.colour = tile->colour * (ptrdiff_t)sizeof(uint16_t) - (ptrdiff_t)sizeof(uint16_t),
                            .round = TEXTURED_RUN_ROUND,
                            .limit = limit,
                            .arena_end = t->arena_end,
                            .record_bytes = t->record_bytes,
                            .source = UINT32_MAX,
                            .known = t->tile_columns == 1 && t->small,
                            .vertices = t->vertices,
                            .top = 16 * (int32_t)tile->top + 8,
                            .height = (int32_t)(tile->bottom - tile->top),
                            .depth = tile->depth - tile->first,
                            .stride = (int32_t)(tile->stride * (small_int_t)sizeof(uint16_t)),
                            .left = tile->left,
                            .width = tile->width,
                            .place = smalls_place(walk),
                            .right = smalls_place_right(t, walk),
                            .is_short = t->tile_columns > 1}; /* columns.h has no others */
}

/* What sources of one instance share. */
TUILE_INLINE void smalls_textured_instance(const tuile_t *t, textured_run_t *run) {
    const uint32_t slot = t->textured_source & 0xffffu;
    const source_slot_t *source = (const source_slot_t *)(const void *)&t->vertices[slot];
    run->instance = t->textured_instance;
    run->model_texcoords = t->textured_texcoords - 4 * ((ptrdiff_t)source->first_vertex - (ptrdiff_t)slot);
}

/* No level is made. */
static inline void smalls_textured_no_level(const textured_material_t *m, textured_run_t *run) {
    const unsigned log2_side = m->log2_width > m->log2_height ? m->log2_width : m->log2_height, twice = 2u * m->uv_bits;
    run->pixels_up = m->pixels_up;
    run->upper = run->lower = 31;
    run->always = 0;
    run->first_level = log2_side > TEXTURED_FRACTION ? log2_side - TEXTURED_FRACTION : 0;
    for (unsigned i = 0; i <= TEXTURED_RUN_LEVELS; i++) {
        const unsigned number = run->first_level + i, upper = (twice > 9 ? twice - 9 : 0) + 2 * number + 2;
        const bool last = i == TEXTURED_RUN_LEVELS || number + 1u >= m->levels || upper > 31;
        run->levels[i].upper = last ? 31 : upper;
        run->levels[i].lower = 31;
        run->levels[i].always = 0;
    }
}

/* Puts the current level into the run. False: it is there. */
static inline bool smalls_textured_put(const textured_material_t *m, textured_run_t *run) {
    const textured_level_t *level = &m->level;
    textured_run_level_t *to = &run->levels[level->number - run->first_level];
    if (to->lower == level->lower) { return false; }
    *to = (textured_run_level_t){.upper = level->upper,
                                 .lower = level->lower,
                                 .always = level->always,
                                 .up = level->up,
                                 .down = level->down,
                                 .t_unit = level->t_unit,
                                 .s_unit = level->s_unit,
                                 .from_corner = level->from_corner,
                                 .mask = level->mask | level->shift,
                                 .texels = level->texels};
    return true;
}

/* What t->textured_source decides. */
TUILE_INLINE void smalls_textured_source(const tuile_t *t, textured_run_t *run) {
    run->source = t->textured_source;
    run->texcoords = t->textured_texcoords;
    smalls_textured_instance(t, run);
}

/* What its material decides. */
static inline void smalls_textured_material(const tuile_t *t, textured_run_t *run) {
    const textured_material_t *m = &t->textured_last;
    run->palette = m->palette;
    run->s_inside = m->s_inside;
    run->across = (uint32_t)m->across - 4u;
    run->one = (uint32_t)m->one + 4u;
    run->log2_one = m->uv_bits;
    smalls_textured_no_level(m, run);
}

/* A face that the assembly leaves alone. False: it is not to be drawn so. */
static inline bool smalls_textured_beside(tuile_t *t, walk_t *walk, textured_run_t *run, const record_t *record,
                                          const small_tile_t *tile) {
    const vertex_t *v0 = t->vertices + record->v0, *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    const uint32_t number = run->place.list - 1u;
    small_paint_t paint = {.constants = textured_constants()};
    small_face_t face;
    if (!small_open(&face, v0, v1, v2, tile, 0) ||
        !small_prepare(t, record, number, SMALL_TEXTURED, true, &face, v0, v1, v2, &paint)) {
        return false;
    }
    const bool reaches = small_fill_clamped(&face, v0, v1, v2, tile, SMALL_TEXTURED, true, 0, &paint);
    smalls_place_pass(t, walk, &run->place, &run->right, reaches);
    return true;
}

/* Puts the level of a face into the run. False: it is there, or there is none. */
static inline bool smalls_textured_level(tuile_t *t, textured_run_t *run, const record_t *record) {
    const vertex_t *v0 = t->vertices + record->v0, *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    const small_corners_t c = {v0->x, v0->y, v1->x - v0->x, v1->y - v0->y, v2->x - v0->x, v2->y - v0->y};
    if (!small_short(&c)) { return false; }
    textured_material_t *m = &t->textured_last;
    const textured_face_t face = textured_face(t, record, v0, v1, v2, (int32_t)c.x1, (int32_t)c.y1, (int32_t)c.x2, (int32_t)c.y2);
    if (textured_across(&face) >= m->across || !textured_level_make(m, &face, face.x2 * face.y1 - face.x1 * face.y2)) {
        return false;
    }
    return smalls_textured_put(m, run);
}

static inline void smalls_textured_thumb(tuile_t *t, walk_t *walk, uint32_t limit) {
    small_tile_t tile = small_tile(&t->tile);
    tile.colour = (t->working ? (uint16_t *)t->working : (uint16_t *)(void *)t->colours[t->next_buffer]) - tile.depth;
    textured_run_t run = smalls_textured_run(t, walk, limit, &tile);
    uint32_t material = UINT32_MAX; /* of the run: by its number */
    for (;;) {
        textured_thumb(&run);
        if (run.place.list - 1u >= limit) { break; }
        const record_t *record = frame_record(t, run.place.list - 1u);
        if (!frame_record_is_triangle(record) || !textured_fits(t, record)) { break; }
        if (run.source == t->textured_source) {
            run.texcoords = t->textured_texcoords; /* the loop may have gone on to that source */
            if (!smalls_textured_level(t, &run, record) && !smalls_textured_beside(t, walk, &run, record, &tile)) { break; }
            continue;
        }
        const uint32_t number = t->textured_instance | (uint32_t)t->textured_number << 16;
        smalls_textured_source(t, &run);
        if (material != number) { smalls_textured_material(t, &run); }
        material = number;
    }
    smalls_place_end(t, walk, &run.place, run.right);
    if (run.place.count) { t->textured_any = true; }
}

#endif
