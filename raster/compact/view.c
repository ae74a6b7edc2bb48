#include "compact.h"

#include "../geometry/transform.h"
#include "../memory.h"
#include "../pixel.h"

static tuile_compact_row_t row_of(const transform_row_t *row) {
    tuile_compact_row_t result = {.t = row->t};

    for (unsigned i = 0; i < 3; i++) {
        result.m[i] = row->m[i];
        result.low[i] = row->low[i];
    }
    return result;
}

/* Only what flat white light on opaque faces is made of. */
static bool is_plain(const tuile_scene_t *scene) {
    const tuile_instance_t *instance = scene->instances;

    if (scene->instance_count != 1 || scene->line_count || scene->sprite_count || scene->fog.kind || instance->two_sided ||
        instance->morph || instance->materials || scene->light_count > TUILE_COMPACT_LIGHTS ||
        scene->camera.projection != TUILE_PERSPECTIVE ||
        scene->ambient_colour[0] | scene->ambient_colour[1] | scene->ambient_colour[2]) {
        return false;
    }
    for (unsigned i = 0; i < scene->light_count; i++) {
        const tuile_light_t *light = &scene->lights[i];

        if (light->kind != TUILE_LIGHT_DIRECTIONAL || light->colour[0] | light->colour[1] | light->colour[2]) { return false; }
    }
    return true;
}

int tuile_compact_view(tuile_compact_view_t *view, const tuile_scene_t *scene, uint16_t width, uint16_t height) {
    const uint8_t *background = scene->background;
    transform_t transform;
    int error;

    if (!is_plain(scene)) { return TUILE_ERROR_EFFECTS; }
    if ((error = transform_make(&transform, scene, scene->instances, width, height))) { return error; }
    const int32_t w_end = (int32_t)(transform.w_high >> 16) - 2;
    *view = (tuile_compact_view_t){
        .x = row_of(&transform.x),
        .y = row_of(&transform.y),
        .w = row_of(&transform.w),
        .w_low = transform.w_low,
        .w_high = transform.w_high,
        .w_fast = transform.w_fast,
        .w_range = w_end > transform.w_fast ? (uint32_t)(w_end - transform.w_fast) : 0,
        .observer_bits = transform.observer_bits,
        .guard_x = (int16_t)transform.guard_x,
        .guard_y = (int16_t)transform.guard_y,
        .background = (uint16_t)pixel_pack(PIXEL_LUMA16, PIXEL_RGB(background[0], background[1], background[2])),
        .k = transform.k,
        .depth_shift = (uint8_t)transform.depth_shift,
        .light_count = transform.light_count,
        .ambient = transform.ambient,
        .mirrored = transform.mirrored,
    };
    memcpy(view->observer, transform.observer, sizeof view->observer);
    memcpy(view->lights, transform.lights, sizeof view->lights);
    return TUILE_OK;
}
