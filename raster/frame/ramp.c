/* The colours of materials, and the ramps from black to full light that Gouraud shading looks its pixels up in. */
#include "frame.h"

bool frame_first_use(const tuile_scene_t *scene, unsigned instance) {
    unsigned first = 0;
    while (scene->instances[first].model != scene->instances[instance].model) {
        first++;
    }
    return first == instance;
}

uint32_t frame_material_base(const tuile_scene_t *scene, unsigned instance) {
    uint32_t base = 0;
    for (unsigned i = 0; scene->instances[i].model != scene->instances[instance].model; i++) {
        if (frame_first_use(scene, i)) { base += scene->instances[i].model->material_count; }
    }
    return base;
}

const uint8_t *frame_material(const tuile_t *t, uint32_t material) {
    const tuile_scene_t *scene = t->scene;
    for (unsigned i = 0; i < scene->instance_count; i++) {
        const tuile_model_t *model = scene->instances[i].model;
        if (!frame_first_use(scene, i)) { continue; }
        if (material < model->material_count) { return model->materials + 4 * material; }
        material -= model->material_count;
    }
    return scene->background;
}

TUILE_NOINLINE void frame_ramp_make(tuile_t *t, uint32_t material, uint32_t slot) {
    uint16_t *ramp = t->ramps + slot * RAMP_COLOURS;
    const uint8_t *colour = frame_material(t, material);
    for (uint32_t i = 0; i < RAMP_COLOURS; i++) {
        ramp[i] = resolve_lit(t->config.format, colour, (i * 255u + 31u) / 63u);
    }
    t->ramp_tags[slot] = (int16_t)material;
}
