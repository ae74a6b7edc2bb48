/* The colours of materials, and the ramps from black to full light that Gouraud shading looks its pixels up in. */
#include "frame.h"

#include "../memory.h"

static bool same_materials(const tuile_instance_t *a, const tuile_instance_t *b) {
    return a->model == b->model && a->materials == b->materials;
}

bool frame_first_use(const tuile_scene_t *scene, unsigned instance) {
    unsigned first = 0;
    while (!same_materials(&scene->instances[first], &scene->instances[instance])) {
        first++;
    }
    return first == instance;
}

uint32_t frame_material_base(const tuile_scene_t *scene, unsigned instance) {
    uint32_t base = 0;
    for (unsigned i = 0; !same_materials(&scene->instances[i], &scene->instances[instance]); i++) {
        if (frame_first_use(scene, i)) { base += scene->instances[i].model->material_count; }
    }
    return base;
}

bool frame_materials_fit(const tuile_instance_t *instance) {
    for (uint32_t m = 0; instance->materials && m < instance->model->material_count; m++) {
        const tuile_material_t *material = &instance->materials[m];
        if (material->blend > TUILE_BLEND_MULTIPLY || material->shininess > MODEL_SHININESS_MAX ||
            material->uv_bits > MODEL_UV_BITS_MAX) {
            return false;
        }
    }
    return true;
}

tuile_material_t frame_instance_material(const tuile_instance_t *instance, uint32_t material) {
    return instance->materials ? instance->materials[material] : tuile_model_material(instance->model, material);
}

/* The instance whose materials, or whose model's, a number is among; *material becomes the number there. NULL: none. */
static const tuile_instance_t *material_owner(const tuile_t *t, uint32_t *material) {
    const tuile_scene_t *scene = t->scene;
    for (unsigned i = 0; i < scene->instance_count; i++) {
        const tuile_instance_t *instance = &scene->instances[i];
        if (i > 0 && !frame_first_use(scene, i)) { continue; }
        if (*material < instance->model->material_count) { return instance; }
        *material -= instance->model->material_count;
    }
    return NULL;
}

/* Its colour alone. */
TUILE_INLINE const uint8_t *material_colour(const tuile_t *t, uint32_t material) {
    const tuile_instance_t *instance = t->scene->instances;
    if (TUILE_UNLIKELY(material >= instance->model->material_count)) { instance = material_owner(t, &material); }
    if (instance == NULL) { return t->scene->background; }
    return instance->materials ? instance->materials[material].colour
                               : instance->model->materials + MODEL_MATERIAL_BYTES * material;
}

static TUILE_NOINLINE uint32_t flat_make(const tuile_t *t, const record_t *record) {
    return pixel_lit((pixel_kind_t)t->pixel_kind, material_colour(t, record->material), record->light);
}

uint16_t *frame_flat_ramp(const tuile_t *t, uint32_t material) {
    if (t->ramp_count == 0 || t->span_kind != SPAN_FLAT) { return NULL; }
    const uint32_t slot = TUILE_LIKELY(material < t->ramp_count) ? material : material % t->ramp_count;
    uint16_t *ramp = t->ramps + slot * RAMP_FLAT_COLOURS;
    if (TUILE_UNLIKELY(t->ramp_tags[slot] != (int16_t)material)) {
        memset(ramp, 0, RAMP_FLAT_BYTES);
        t->ramp_tags[slot] = (int16_t)material;
    }
    return ramp;
}

uint32_t frame_flat(const tuile_t *t, const record_t *record) {
    uint16_t *ramp = frame_flat_ramp(t, record->material);
    if (TUILE_UNLIKELY(ramp == NULL)) { return flat_make(t, record); }
    if (TUILE_UNLIKELY(ramp[record->light] == 0)) { ramp[record->light] = (uint16_t)flat_make(t, record); }
    return ramp[record->light];
}

/* A step of a ramp, 0 ... 255. Without long products a division is a function: 2^21 / 63 is less than 0.9 below the factor here,
 * and the numerator below 2^14, so that the product is less than 1 / 63 too large. */
TUILE_INLINE uint32_t ramp_light(uint32_t i) {
    const uint32_t sum = i * 255u + 31u;
    return FIXED_BY_HALVES ? sum * 33289u >> 21 : sum / 63u;
}

TUILE_NOINLINE void frame_ramp_make(tuile_t *t, uint32_t material, uint32_t slot) {
    uint16_t *ramp = t->ramps + slot * RAMP_COLOURS;
    const uint8_t *colour = material_colour(t, material);
    for (uint32_t i = 0; i < RAMP_COLOURS; i++) {
        ramp[i] = (uint16_t)pixel_lit((pixel_kind_t)t->pixel_kind, colour, ramp_light(i));
    }
    t->ramp_tags[slot] = (int16_t)material;
}
