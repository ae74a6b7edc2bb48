/* The colours of materials, and the ramps from black to full light that Gouraud shading looks its pixels up in. */
#include "frame.h"

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

tuile_material_t frame_instance_material(const tuile_instance_t *instance, uint32_t material) {
    return instance->materials ? instance->materials[material] : tuile_model_material(instance->model, material);
}

tuile_material_t frame_material(const tuile_t *t, uint32_t material) {
    const tuile_scene_t *scene = t->scene;
    for (unsigned i = 0; i < scene->instance_count; i++) {
        const tuile_instance_t *instance = &scene->instances[i];
        if (!frame_first_use(scene, i)) { continue; }
        if (material < instance->model->material_count) { return frame_instance_material(instance, material); }
        material -= instance->model->material_count;
    }
    return (tuile_material_t){.alpha = 255, .texture = TUILE_NO_TEXTURE};
}

uint32_t frame_flat(const tuile_t *t, const record_t *record) {
    const tuile_material_t material = frame_material(t, record->material);
    return pixel_lit((pixel_kind_t)t->pixel_kind, material.colour, record->light);
}

TUILE_NOINLINE void frame_ramp_make(tuile_t *t, uint32_t material, uint32_t slot) {
    uint16_t *ramp = t->ramps + slot * RAMP_COLOURS;
    const tuile_material_t made = frame_material(t, material);
    for (uint32_t i = 0; i < RAMP_COLOURS; i++) {
        ramp[i] = (uint16_t)pixel_lit((pixel_kind_t)t->pixel_kind, made.colour, (i * 255u + 31u) / 63u);
    }
    t->ramp_tags[slot] = (int16_t)material;
}
