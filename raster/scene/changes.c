#include "changes.h"

#include "../geometry/cull.h"

/* Pixels round a face that its edges, drawn as lines, may reach. */
#define MARGIN_PX 4u

/* FNV-1a over words; fields and not bytes, since a struct may have gaps. */
static void add(uint32_t *sum, uint32_t word) { *sum = (*sum ^ word) * 16777619u; }

static void add_all(uint32_t *sum, const int32_t *words, unsigned count) {
    for (unsigned i = 0; i < count; i++) {
        add(sum, (uint32_t)words[i]);
    }
}

static void add_colour(uint32_t *sum, const uint8_t colour[3]) {
    add(sum, (uint32_t)colour[0] << 16 | (uint32_t)colour[1] << 8 | colour[2]);
}

static void add_light(uint32_t *sum, const tuile_light_t *light) {
    for (unsigned i = 0; i < 3; i++) {
        add(sum, (uint32_t)light->direction[i]);
    }
    add(sum, (uint32_t)light->intensity << 8 | light->kind);
    add_colour(sum, light->colour);
    add_all(sum, light->position, 3);
    add(sum, (uint32_t)light->range);
}

static void add_sprite(uint32_t *sum, const tuile_sprite_t *sprite) {
    add_all(sum, sprite->at, 3);
    add(sum, (uint32_t)sprite->width);
    add(sum, (uint32_t)sprite->height);
    add(sum, (uint32_t)(uintptr_t)sprite->texture);
    add_colour(sum, sprite->colour);
    add(sum,
        (uint32_t)sprite->alpha << 16 | (uint32_t)sprite->blend << 8 | (uint32_t)sprite->pixels << 1 | (uint32_t)sprite->round);
}

static void add_line(uint32_t *sum, const tuile_line_t *line) {
    add_all(sum, line->from, 3);
    add_all(sum, line->to, 3);
    add_colour(sum, line->colour);
    add(sum, (uint32_t)line->smooth);
}

/* Of all that is not an instance or the camera. */
static uint32_t sum_of(const tuile_scene_t *scene) {
    uint32_t sum = 2166136261u;
    add(&sum, (uint32_t)scene->light_count << 16 | (uint32_t)scene->ambient);
    add(&sum, (uint32_t)scene->line_count << 16 | scene->sprite_count);
    add_colour(&sum, scene->background);
    add_colour(&sum, scene->ambient_colour);
    add(&sum, (uint32_t)scene->fog.kind);
    add(&sum, (uint32_t)scene->fog.near);
    add(&sum, (uint32_t)scene->fog.far);
    add_colour(&sum, scene->fog.colour);
    for (unsigned i = 0; i < scene->light_count; i++) {
        add_light(&sum, &scene->lights[i]);
    }
    for (unsigned i = 0; i < scene->line_count; i++) {
        add_line(&sum, &scene->lines[i]);
    }
    for (unsigned i = 0; i < scene->sprite_count; i++) {
        add_sprite(&sum, &scene->sprites[i]);
    }
    return sum;
}

static bool same_rotation(const q2_30_t a[3][3], const q2_30_t b[3][3]) {
    for (unsigned i = 0; i < 9; i++) {
        if (a[i / 3][i % 3] != b[i / 3][i % 3]) { return false; }
    }
    return true;
}

static bool same_point(const q16_16_t a[3], const q16_16_t b[3]) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

static bool same_camera(const tuile_camera_t *a, const tuile_camera_t *b) {
    return a->projection == b->projection && same_rotation(a->rotation, b->rotation) && same_point(a->eye, b->eye) &&
           a->focal_x == b->focal_x && a->focal_y == b->focal_y && a->centre_x == b->centre_x && a->centre_y == b->centre_y &&
           a->near == b->near && a->far == b->far;
}

static bool same_instance(const tuile_instance_t *a, const tuile_instance_t *b) {
    return a->model == b->model && a->two_sided == b->two_sided && a->materials == b->materials && a->morph == b->morph &&
           same_rotation(a->pose.rotation, b->pose.rotation) && a->pose.scale.mantissa == b->pose.scale.mantissa &&
           a->pose.scale.exponent == b->pose.scale.exponent && same_point(a->pose.translation, b->pose.translation);
}

void tuile_changes_forget(tuile_changes_t *changes) { changes->known = false; }

void tuile_changes_next(tuile_changes_t *changes, const tuile_scene_t *scene) {
    const uint32_t sum = sum_of(scene);
    const bool fits = scene->instance_count <= changes->capacity;
    changes->all = !changes->known || !fits || scene->instance_count != changes->count || sum != changes->sum ||
                   !same_camera(&changes->camera, &scene->camera);
    for (unsigned i = 0; fits && i < scene->instance_count; i++) {
        tuile_change_t *change = &changes->instances[i];
        change->before = changes->all ? scene->instances[i] : change->now;
        change->now = scene->instances[i];
        change->moved = !same_instance(&change->before, &change->now);
    }
    changes->known = fits;
    changes->count = (uint16_t)scene->instance_count;
    changes->camera = scene->camera;
    changes->sum = sum;
}

bool tuile_changes_touch(const tuile_changes_t *changes, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    const transform_region_t region = {.left = (uint16_t)(x > MARGIN_PX ? x - MARGIN_PX : 0),
                                       .top = (uint16_t)(y > MARGIN_PX ? y - MARGIN_PX : 0),
                                       .right = (uint16_t)(x + width + MARGIN_PX),
                                       .bottom = (uint16_t)(y + height + MARGIN_PX)};
    if (changes->all) { return true; }
    for (unsigned i = 0; i < changes->count; i++) {
        const tuile_change_t *change = &changes->instances[i];
        if (change->moved && (!cull_instance_outside(&changes->camera, &change->before, &region) ||
                              !cull_instance_outside(&changes->camera, &change->now, &region))) {
            return true;
        }
    }
    return false;
}
