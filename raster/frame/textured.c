/* Records whose faces are drawn with their texture at once. */
#include "../tune.h"
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-gcse", "ira-region=one") /* 1.5 % fewer: more stays in registers */
#endif

#include "textured.h"

#include "../fill/triangle_set_up.h"

/* Another material: textured_last, and the level that its faces want, go with it. */
static void material_open(tuile_t *t, const tuile_instance_t *instance, uint16_t number, uint8_t material) {
    const tuile_model_t *model = instance->model;
    const tuile_material_t m = frame_instance_material(instance, material);
    t->textured_instance = number;
    t->textured_number = material;
    t->textured_last.fit = m.texture < model->texture_count && model->texcoords != NULL && model->colours == NULL;
    if (!t->textured_last.fit) { return; }
    const tuile_texture_t texture = tuile_model_texture(model, m.texture);
    textured_material_open(&t->textured_last, &m, &texture, t->config.texturing, t->camera.projection == TUILE_PERSPECTIVE,
                           m.uv_bits);
}

#define REFUSED (UINT32_C(1) << 31)

TUILE_NOINLINE bool textured_source_open(tuile_t *t, const record_t *record, uint32_t wanted) {
    const uint32_t at = wanted & 0xffffu;
    if (t->textured_source == (wanted | REFUSED)) { return false; }
    const source_slot_t *source = (const source_slot_t *)(const void *)&t->vertices[at];
    const tuile_instance_t *instance = &t->scene->instances[source->instance];
    if (t->textured_instance != source->instance || t->textured_number != record->material) {
        material_open(t, instance, source->instance, record->material);
    }
    t->textured_source = wanted | REFUSED;
    if (!t->textured_last.fit || source->colours != 0 || source->attributes != 0) { return false; }
    t->textured_source = wanted;
    t->textured_texcoords =
        instance->model->texcoords + 4 * ((ptrdiff_t)source->first_vertex - (ptrdiff_t)at - (ptrdiff_t)SOURCE_SLOTS);
    return true;
}

bool textured_start(tuile_t *t, textured_t *textured, const record_t *record, int32_t row) {
    const record_surface_t *extra = (const record_surface_t *)(const void *)record;
    if (!textured_fits(t, record)) { return false; }
    const vertex_t *v0 = &t->vertices[record->v0], *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    triangle_t *triangle = &textured->triangle;
    if (TUILE_LIKELY(t->config.shade == TUILE_GOURAUD)) {
        triangle_set_up(triangle, v0, v1, v2, row, true, true);
    } else {
        if (extra->green != record->light || extra->blue != record->light) { return false; }
        triangle_start(triangle, v0, v1, v2, row, false);
        triangle->shade += (uint64_t)record->light << 24;
    }
    if (TUILE_UNLIKELY(!triangle->is_short)) { return false; }
    const textured_face_t face = textured_face(t, record, v0, v1, v2, v1->x - v0->x, v1->y - v0->y, v2->x - v0->x, v2->y - v0->y);
    if (!textured_map_at_origin(&textured->map, &t->textured_last, &face, v0->x, v0->y)) { return false; }
    triangle->value = 0;
    triangle->head.size_bytes = (sizeof(textured_t) + 7u) & ~7u;
    t->textured_any = true;
    return true;
}
