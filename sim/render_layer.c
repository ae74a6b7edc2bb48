#include "render_layer.h"

#include "commands.h"
#include "render_value.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char render_layer_usage[] =
    "  --alpha 0...255          of all materials: below 255 faces are translucent\n"
    "  --blend over|add|multiply   how translucent faces meet what is behind them\n"
    "  --edges all|front|hidden|outline   edges of all faces, of front faces, of those no face hides; silhouettes over the faces\n"
    "  --edge-colour RRGGBB     black by default, white without faces\n"
    "  --line X,Y,Z,X,Y,Z[,RRGGBB]   a line in model units, between --near and --far, that faces may hide; up to 64\n"
    "  --smooth-lines           anti-aliased\n"
    "  --point X,Y,Z[,SIZE[,RRGGBB]]   a disc, SIZE pixels across (5), that faces may hide; up to 64\n"
    "  --sprite FILE@X,Y,Z,W,H  a PNG or JPEG picture that faces the camera, W x H model units round a point; up to 16\n";

/* `least` to `most` numbers with commas between, and then, where all are there and colour is not NULL, perhaps a colour. */
static bool read_numbers(const char *text, double *numbers, unsigned least, unsigned most, uint8_t colour[3]) {
    for (unsigned i = 0; i < most; i++) {
        char *end;
        numbers[i] = strtod(text, &end);
        if (end == text || !isfinite(numbers[i]) || fabs(numbers[i]) > 1e12) { return false; }
        if (*end == '\0') { return i + 1 >= least; }
        if (*end != ',') { return false; }
        text = end + 1;
    }
    return colour && render_value_colour(text, colour);
}

static void fail(options_t *options, const char *name, const char *value, const char *wants) {
    (void)command_fail("%s %s: wants %s", name, value, wants);
    options->failed = true;
}

static void line_option(render_layer_t *part, options_t *options) {
    const char *value = options_value(options);
    if (!value) { return; }
    if (part->line_count == RENDER_LAYER_MAX) {
        fail(options, "--line", value, "to be there 64 times at most");
        return;
    }
    tuile_line_t *line = &part->lines[part->line_count];
    *line = (tuile_line_t){.colour = {255, 255, 255}};
    if (!read_numbers(value, part->line_at[part->line_count++], 6, 6, line->colour)) {
        fail(options, "--line", value, "six numbers and perhaps a colour: X,Y,Z,X,Y,Z,RRGGBB");
    }
}

static void point_option(render_layer_t *part, options_t *options) {
    const char *value = options_value(options);
    double numbers[4] = {0, 0, 0, 5};
    if (!value) { return; }
    if (part->point_count == RENDER_LAYER_MAX) {
        fail(options, "--point", value, "to be there 64 times at most");
        return;
    }
    tuile_sprite_t *point = &part->points[part->point_count];
    *point = (tuile_sprite_t){.colour = {255, 255, 255}, .alpha = 255, .pixels = true, .round = true};
    if (!read_numbers(value, numbers, 3, 4, point->colour) || numbers[3] < 0 || numbers[3] > 1024) {
        fail(options, "--point", value, "a position, perhaps a size of 0 to 1024 pixels and a colour: X,Y,Z,SIZE,RRGGBB");
        return;
    }
    memcpy(part->point_at[part->point_count++], numbers, sizeof part->point_at[0]);
    point->width = point->height = (q16_16_t)lround(numbers[3] * 65536.0);
}

static void sprite_option(render_layer_t *part, options_t *options) {
    const char *value = options_value(options);
    double numbers[5];
    if (!value) { return; }
    if (part->sprite_count == RENDER_SPRITES_MAX) {
        fail(options, "--sprite", value, "to be there 16 times at most");
        return;
    }
    render_sprite_t *sprite = &part->sprites[part->sprite_count];
    const char *text = render_image_name(&sprite->image, value);
    if (!text || !read_numbers(text, numbers, 5, 5, NULL) || numbers[3] <= 0 || numbers[4] <= 0) {
        fail(options, "--sprite", value, "a file, its centre and a size above 0: FILE@X,Y,Z,W,H");
        return;
    }
    memcpy(sprite->at, numbers, sizeof sprite->at);
    memcpy(sprite->size, numbers + 3, sizeof sprite->size);
    part->sprite_count++;
}

bool render_layer_option(render_layer_t *part, options_t *options, const char *argument) {
    static const char *const blends[] = {"over", "add", "multiply", NULL};
    static const char *const edges[] = {"all", "front", "hidden", "outline", NULL};
    long number;
    int choice;
    if (strcmp(argument, "--alpha") == 0) {
        part->has_alpha = options_integer(options, &number, 0, 255);
        if (part->has_alpha) { part->alpha = (uint8_t)number; }
    } else if (strcmp(argument, "--blend") == 0) {
        part->has_blend = options_choice(options, &choice, blends);
        if (part->has_blend) { part->blend = (uint8_t)choice; }
    } else if (strcmp(argument, "--edges") == 0) {
        if (options_choice(options, &choice, edges)) {
            part->edges = (uint8_t)(choice + 1);
            if (part->edge_colour[0] == 0 && part->edges != TUILE_EDGES_OUTLINE) { memset(part->edge_colour, 255, 3); }
        }
    } else if (strcmp(argument, "--edge-colour") == 0) {
        const char *value = options_value(options);
        if (value && !render_value_colour(value, part->edge_colour)) {
            fail(options, "--edge-colour", value, "six hexadecimal digits, RRGGBB");
        }
    } else if (strcmp(argument, "--smooth-lines") == 0) {
        part->smooth = true;
    } else if (strcmp(argument, "--line") == 0) {
        line_option(part, options);
    } else if (strcmp(argument, "--point") == 0) {
        point_option(part, options);
    } else if (strcmp(argument, "--sprite") == 0) {
        sprite_option(part, options);
    } else {
        return false;
    }
    return true;
}

int render_layer_apply(render_layer_t *part, tuile_config_t *config) {
    int code = 0;
    for (unsigned i = 0; code == 0 && i < part->sprite_count; i++) {
        code = render_image_load(&part->sprites[i].image, "--sprite");
    }
    if (part->has_alpha || part->has_blend || part->edges || part->line_count || part->point_count || part->sprite_count) {
        config->effects |= TUILE_LAYERS;
    }
    config->edges = part->edges;
    memcpy(config->edge_colour, part->edge_colour, 3);
    return code;
}

bool render_layer_translucent(const tuile_model_t *model, bool plain) {
    for (uint32_t m = 0; m < model->material_count; m++) {
        const tuile_material_t material = tuile_model_material(model, m);
        if (material.alpha < 255 || material.blend != TUILE_BLEND_OVER) { return true; }
        if (plain || material.texture >= model->texture_count) { continue; }
        const tuile_texture_t texture = tuile_model_texture(model, material.texture);
        if (texture.format == TUILE_TEXEL_ARGB4444 || texture.flags & (TUILE_TEXTURE_KEY | TUILE_TEXTURE_PALETTE_ALPHA)) {
            return true;
        }
    }
    for (uint32_t v = 0; !plain && model->colours && v < model->vertex_count; v++) {
        if (model->colours[4 * (size_t)v + 3] != 255) { return true; }
    }
    return false;
}

static int place(const double *at, size_t count, double unit, q16_16_t *to, sim_error_t *error) {
    for (size_t i = 0; i < count; i++) {
        const double value = at[i] * unit * 65536.0;
        if (fabs(value) > 2147483647.0) { return sim_fail(error, "--line, --point, --sprite: %g is too far out", at[i]); }
        to[i] = (q16_16_t)lround(value);
    }
    return 0;
}

static void free_materials(render_layer_t *part) {
    free(part->instances);
    free(part->materials);
    part->instances = NULL;
    part->materials = NULL;
}

/* Copies of all instances, whose materials differ. */
static int change_materials(render_layer_t *part, tuile_scene_t *scene, sim_error_t *error) {
    size_t count = 0, at = 0;
    if (scene->instances != part->instances) { part->given = scene->instances; }
    for (unsigned i = 0; i < scene->instance_count; i++) {
        count += part->given[i].model->material_count;
    }
    free_materials(part);
    part->instances = malloc((scene->instance_count + 1u) * sizeof *part->instances);
    part->materials = malloc((count + 1) * sizeof *part->materials);
    if (!part->instances || !part->materials) { return sim_fail(error, "out of memory"); }
    for (unsigned i = 0; i < scene->instance_count; i++) {
        tuile_instance_t *instance = &part->instances[i];
        *instance = part->given[i];
        const tuile_material_t *own = instance->materials;
        instance->materials = part->materials + at;
        for (uint32_t m = 0; m < instance->model->material_count; m++) {
            tuile_material_t *material = &part->materials[at++];
            *material = own ? own[m] : tuile_model_material(instance->model, m);
            if (part->has_alpha) { material->alpha = part->alpha; }
            if (part->has_blend) { material->blend = part->blend; }
        }
    }
    scene->instances = part->instances;
    return 0;
}

static int place_sprite(const render_sprite_t *sprite, double unit, tuile_sprite_t *to, sim_error_t *error) {
    q16_16_t size[2] = {0, 0};
    *to = (tuile_sprite_t){.texture = &sprite->image.texture, .colour = {255, 255, 255}, .alpha = 255};
    if (place(sprite->at, 3, unit, to->at, error) != 0 || place(sprite->size, 2, unit, size, error) != 0) { return -1; }
    to->width = size[0];
    to->height = size[1];
    return 0;
}

int render_layer_frame(render_layer_t *part, tuile_scene_t *scene, double unit, sim_error_t *error) {
    for (unsigned i = 0; i < part->line_count; i++) {
        part->lines[i].smooth = part->smooth;
        if (place(part->line_at[i], 3, unit, part->lines[i].from, error) != 0 ||
            place(part->line_at[i] + 3, 3, unit, part->lines[i].to, error) != 0) {
            return -1;
        }
    }
    for (unsigned i = 0; i < part->point_count; i++) {
        if (place(part->point_at[i], 3, unit, part->points[i].at, error) != 0) { return -1; }
    }
    for (unsigned i = 0; i < part->sprite_count; i++) {
        if (place_sprite(&part->sprites[i], unit, &part->points[part->point_count + i], error) != 0) { return -1; }
    }
    scene->lines = part->lines;
    scene->line_count = part->line_count;
    scene->sprites = part->points;
    scene->sprite_count = (uint16_t)(part->point_count + part->sprite_count);
    return part->has_alpha || part->has_blend ? change_materials(part, scene, error) : 0;
}

void render_layer_free(render_layer_t *part) {
    free_materials(part);
    for (unsigned i = 0; i < part->sprite_count; i++) {
        render_image_free(&part->sprites[i].image);
    }
}
