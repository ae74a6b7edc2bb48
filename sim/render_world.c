#include "render_world.h"

#include "commands.h"
#include "render_value.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char render_world_usage[] =
    "  --add FILE[,KEY=VALUE...]  one more model; repeat it for others. Keys: at=X,Y,Z in units of the main model; scale=S;\n"
    "                           turn=AX,AY,AZ degrees about x, y and z; spin=DEG per frame about its y; parent=N, on whose axes\n"
    "                           it stands: 0 is the main model, 1 the first --add; colour=RRGGBB; morph=0...1\n"
    "  --lod FILE:DISTANCE      from that distance on FILE is drawn for the main model, `none:DISTANCE` nothing; repeat it\n"
    "  --morph-at M             0...1, how far the main model is towards its second key frame; 1 by default\n"
    "  --morph-swing            there and back in all frames\n";

/* ---- options ---- */

static bool fail(options_t *options) {
    options->failed = true;
    return true;
}

/* "1,2,3" up to `count` numbers at *text, which moves on behind them. */
static bool take_numbers(const char **text, double *values, unsigned count, double most) {
    for (unsigned i = 0; i < count; i++) {
        char *end;
        if (i > 0 && *(*text)++ != ',') { return false; }
        values[i] = strtod(*text, &end);
        if (end == *text || !(fabs(values[i]) <= most)) { return false; }
        *text = end;
    }
    return true;
}

static bool take_colour(const char **text, world_thing_t *thing) {
    thing->has_colour = render_value_next_colour(text, thing->colour);
    return thing->has_colour;
}

static bool take_key(const char **text, world_thing_t *thing, unsigned things) {
    static const char *const names[] = {"at=", "scale=", "turn=", "spin=", "parent=", "colour=", "morph="};
    double parent;
    unsigned k = 0;
    while (k < 7 && strncmp(*text, names[k], strlen(names[k])) != 0) {
        k++;
    }
    if (k == 7) { return false; }
    *text += strlen(names[k]);
    switch (k) {
    case 0: return take_numbers(text, thing->at, 3, 1e9);
    case 1: return take_numbers(text, &thing->scale, 1, 1e9) && thing->scale >= 1e-9;
    case 2: return take_numbers(text, thing->turn, 3, 1e6);
    case 3: return take_numbers(text, &thing->spin, 1, 1e6);
    case 4:
        if (!take_numbers(text, &parent, 1, things) || parent < 0 || parent != floor(parent)) { return false; }
        thing->parent = (long)parent;
        return true;
    case 5: return take_colour(text, thing);
    default: return take_numbers(text, &thing->morph, 1, 1) && thing->morph >= 0;
    }
}

/* A path may have commas in it, but not before a key. */
static const char *path_end(const char *text) {
    for (; *text; text++) {
        const size_t word = *text == ',' ? strspn(text + 1, "abcdefghijklmnopqrstuvwxyz") : 0;
        if (word > 0 && text[1 + word] == '=') { break; }
    }
    return text;
}

static bool copy_path(char *to, size_t size, const char *text, size_t length) {
    if (length == 0 || length >= size) { return false; }
    memcpy(to, text, length);
    to[length] = '\0';
    return true;
}

static bool add_option(render_world_t *world, options_t *options) {
    const char *text = options_value(options);
    if (!text) { return true; }
    if (world->thing_count == WORLD_THINGS) {
        (void)command_fail("--add %s: more than %d", text, WORLD_THINGS);
        return fail(options);
    }
    world_thing_t *thing = &world->things[world->thing_count];
    *thing = (world_thing_t){.scale = 1, .parent = -1};
    const char *at = path_end(text);
    bool good = copy_path(thing->path, sizeof thing->path, text, (size_t)(at - text));
    while (good && *at == ',') {
        at++;
        good = take_key(&at, thing, world->thing_count);
    }
    if (!good || *at != '\0') {
        (void)command_fail("--add %s: wants FILE, then at=X,Y,Z scale=S turn=AX,AY,AZ spin=DEG parent=N (a model before this one) "
                           "colour=RRGGBB morph=0...1 with commas between%s%s",
                           text, *at ? "; wrong from here: " : "", at);
        return fail(options);
    }
    world->thing_count++;
    return true;
}

static bool lod_option(render_world_t *world, options_t *options) {
    const char *text = options_value(options), *colon = text ? strrchr(text, ':') : NULL;
    double distance = 0;
    char rest;
    if (!text) { return true; }
    const double least = world->level_count ? world->levels[world->level_count - 1].distance : 0;
    if (!colon || sscanf(colon + 1, "%lf%c", &distance, &rest) != 1 || !(distance > least && distance <= 1e9) ||
        (world->level_count > 0 && strcmp(world->levels[world->level_count - 1].path, "none") == 0) ||
        world->level_count == WORLD_LEVELS ||
        !copy_path(world->levels[world->level_count].path, sizeof world->levels[0].path, text, (size_t)(colon - text))) {
        (void)command_fail(
            "--lod %s: wants FILE:DISTANCE, %d of them at most, each farther than the one before, and none:DISTANCE last", text,
            WORLD_LEVELS);
        return fail(options);
    }
    world->levels[world->level_count++].distance = distance;
    return true;
}

bool render_world_option(render_world_t *world, options_t *options, const char *argument) {
    if (strcmp(argument, "--add") == 0) { return add_option(world, options); }
    if (strcmp(argument, "--lod") == 0) { return lod_option(world, options); }
    if (strcmp(argument, "--morph-at") == 0) {
        world->has_morph_at = options_number(options, &world->morph_at, 0, 1);
        return true;
    }
    if (strcmp(argument, "--morph-swing") == 0) {
        world->morph_swing = true;
        return true;
    }
    return false;
}

bool render_world_has_more(const render_world_t *world) { return world->thing_count > 0 || world->level_count > 0; }

/* ---- models ---- */

static const tuile_model_t *load(render_world_t *world, const char *path, const mesh_options_t *options, sim_error_t *error) {
    world_model_t *entry = &world->models[world->model_count];
    mesh_options_t own = *options;
    size_t size_bytes;
    own.morph_path = NULL;
    if (mesh_load(path, 0, &own, &entry->bytes, &size_bytes, NULL, error) != 0) { return NULL; }
    world->model_count++;
    const int result = tuile_model_open(&entry->model, entry->bytes, size_bytes);
    if (result) {
        (void)sim_fail(error, "%s: %s", path, tuile_error_text(result));
        return NULL;
    }
    return &entry->model;
}

/* From the origin of the model to the farthest point of its sphere, in its units. */
static double model_reach(const tuile_model_t *model) {
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const double centre = (double)model->offset[i] + model->centre[i];
        square += centre * centre;
    }
    return ldexp((double)model->step.mantissa, model->step.exponent) * (sqrt(square) + model->radius + 1.0);
}

/* A sphere about the main model's middle that holds all things however they spin: ways add up along the parents. */
static void frame_all(const render_world_t *world, const tuile_model_t *model, view_options_t *view) {
    double ways[WORLD_THINGS + 1] = {0}, scales[WORLD_THINGS + 1] = {1};
    const double step = ldexp((double)model->step.mantissa, model->step.exponent);
    view->sphere_radius = step * (model->radius + 1.0);
    for (int i = 0; i < 3; i++) {
        view->sphere_centre[i] = step * ((double)model->offset[i] + model->centre[i]);
    }
    for (unsigned k = 1; k <= world->thing_count; k++) {
        const world_thing_t *thing = &world->things[k - 1];
        const tuile_model_t *own = world->nodes[k].instance.model;
        const unsigned parent = thing->parent > 0 ? (unsigned)thing->parent : 0;
        double square = 0;
        for (int i = 0; i < 3; i++) {
            const double off = thing->at[i] - (parent == 0 ? view->sphere_centre[i] : 0);
            square += off * off;
        }
        ways[k] = ways[parent] + scales[parent] * sqrt(square);
        scales[k] = scales[parent] * thing->scale;
        view->sphere_radius = fmax(view->sphere_radius, ways[k] + scales[k] * model_reach(own));
    }
    view->has_sphere = world->thing_count > 0;
}

int render_world_load(render_world_t *world, const tuile_model_t *model, const mesh_options_t *options, view_options_t *view,
                      sim_error_t *error) {
    world->nodes[0].instance.model = model;
    for (unsigned k = 0; k < world->thing_count; k++) {
        const world_thing_t *thing = &world->things[k];
        tuile_instance_t *instance = &world->nodes[k + 1].instance;
        instance->model = load(world, thing->path, options, error);
        if (!instance->model) { return -1; }
        if (thing->morph > 0 && !instance->model->morph_positions) {
            return sim_fail(error, "--add %s: morph= wants a compiled model with a second key frame (tuile mesh --morph)",
                            thing->path);
        }
    }
    for (unsigned k = 0; k < world->level_count; k++) {
        if (strcmp(world->levels[k].path, "none") == 0) { continue; }
        world->level_models[k + 1] = load(world, world->levels[k].path, options, error);
        if (!world->level_models[k + 1]) { return -1; }
    }
    if ((world->has_morph_at || world->morph_swing) && !model->morph_positions) {
        return sim_fail(error, "--morph-%s: the model has no second key frame; see --morph", world->has_morph_at ? "at" : "swing");
    }
    if (world->level_count && model->morph_positions) { return sim_fail(error, "--lod: not together with --morph"); }
    frame_all(world, model, view);
    return 0;
}

static void grow(uint16_t *most, uint16_t value) { *most = value > *most ? value : *most; }

void render_world_sizes(const render_world_t *world, tuile_model_t *sizes) {
    for (unsigned k = 0; k < world->thing_count + world->model_count; k++) {
        /* Models that several things share count as often. */
        const tuile_model_t *model =
            k < world->thing_count ? world->nodes[k + 1].instance.model : &world->models[k - world->thing_count].model;
        sizes->vertex_count += model->vertex_count;
        sizes->face_count += model->face_count;
        sizes->material_count += model->material_count;
        sizes->texture_count = (uint16_t)(sizes->texture_count | model->texture_count);
        if (model->colours) { sizes->colours = model->colours; }
        grow(&sizes->cluster_vertices_max, model->cluster_vertices_max);
        grow(&sizes->corners_max, model->corners_max);
        grow(&sizes->tree_depth, model->tree_depth);
    }
}

/* ---- nodes ---- */

static int to_q16(q16_16_t *out, double value) {
    if (!(fabs(value) < 32767.0)) { return -1; }
    *out = (q16_16_t)lround(value * 65536.0);
    return 0;
}

static tuile_scale_t to_scale(double value) {
    int exponent;
    const double mantissa = frexp(value, &exponent);
    return (tuile_scale_t){(uint32_t)llround(ldexp(mantissa, 31)), exponent - 31};
}

/* a * b in doubles, since a turn of whole degrees is no whole bam16_t. */
static void turn(double a[3][3], int axis, double degrees) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double angle = degrees * 3.14159265358979323846 / 180.0, sine = sin(angle), cosine = cos(angle);
    for (int i = 0; i < 3; i++) {
        const double at_u = a[i][u], at_v = a[i][v];
        a[i][u] = at_u * cosine + at_v * sine;
        a[i][v] = at_v * cosine - at_u * sine;
    }
}

static void thing_rotation(const world_thing_t *thing, unsigned frame, q2_30_t rotation[3][3]) {
    double r[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int axis = 2; axis >= 0; axis--) {
        turn(r, axis, thing->turn[axis]);
    }
    turn(r, 1, fmod(thing->spin * frame, 360.0));
    for (int i = 0; i < 9; i++) {
        rotation[i / 3][i % 3] = (q2_30_t)llround(r[i / 3][i % 3] * (double)TUILE_ONE_Q30);
    }
}

static int colour_thing(world_thing_t *thing, tuile_instance_t *instance) {
    const uint32_t count = instance->model->material_count;
    if (!thing->has_colour) { return 0; }
    thing->materials = calloc(count, sizeof *thing->materials);
    if (!thing->materials) { return -1; }
    for (uint32_t m = 0; m < count; m++) {
        thing->materials[m] = tuile_model_material(instance->model, m);
        memcpy(thing->materials[m].colour, thing->colour, 3);
    }
    instance->materials = thing->materials;
    return 0;
}

static int place_levels(render_world_t *world, const tuile_model_t *model, double unit, sim_error_t *error) {
    unsigned count = 1;
    world->level_models[0] = model;
    for (unsigned k = 0; k < world->level_count; k++) {
        if (to_q16(&world->reach[k], world->levels[k].distance * unit) != 0 || world->reach[k] <= (k ? world->reach[k - 1] : 0)) {
            return sim_fail(error, "--lod %s:%g: the distance is out of all proportion to the model", world->levels[k].path,
                            world->levels[k].distance);
        }
        count += world->level_models[k + 1] != NULL;
    }
    if (count > world->level_count) { world->reach[count - 1] = INT32_MAX; } /* the last one has no end */
    world->lod = (tuile_lod_t){world->level_models, world->reach, (uint8_t)count, 8};
    world->nodes[0].lod = &world->lod;
    world->nodes[0].level = TUILE_LOD_FRESH;
    return 0;
}

int render_world_place(render_world_t *world, const view_t *view, unsigned frames, sim_error_t *error) {
    world->unit = ilogb(view->unit);
    world->frames = frames;
    world->nodes[0].parent = TUILE_NODE_WORLD;
    for (unsigned k = 0; k < world->thing_count; k++) {
        world_thing_t *thing = &world->things[k];
        tuile_node_t *node = &world->nodes[k + 1];
        node->parent = (int32_t)thing->parent;
        node->instance.pose.scale = to_scale(thing->scale);
        node->instance.morph = (uint16_t)lround(thing->morph * TUILE_MORPH_ONE);
        for (int i = 0; i < 3; i++) {
            if (to_q16(&node->instance.pose.translation[i], thing->at[i] * view->unit) != 0) {
                return sim_fail(error, "--add %s: at= is out of all proportion to the main model", thing->path);
            }
        }
        if (colour_thing(thing, &node->instance) != 0) { return sim_fail(error, "out of memory"); }
    }
    if (world->level_count == 0) { return 0; }
    return place_levels(world, view->instance.model, view->unit, error);
}

static uint16_t main_morph(const render_world_t *world, unsigned frame) {
    const double way = world->morph_swing ? (1 - cos(6.28318530717958648 * frame / world->frames)) / 2 : 1;
    return (uint16_t)lround((world->has_morph_at ? world->morph_at : way) * TUILE_MORPH_ONE);
}

int render_world_frame(render_world_t *world, view_t *view, unsigned frame, sim_error_t *error) {
    const unsigned count = world->thing_count + 1;
    tuile_node_t *first = &world->nodes[0];
    uint16_t faulty = 0;
    first->instance = view->instance;
    first->instance.pose.scale = TUILE_SCALE_ONE;
    if (first->instance.model->morph_positions) { first->instance.morph = main_morph(world, frame); }
    for (unsigned k = 1; k < count; k++) {
        thing_rotation(&world->things[k - 1], frame, world->nodes[k].instance.pose.rotation);
    }
    int result = tuile_nodes_update(world->nodes, (uint16_t)count, &faulty);
    if (result) { return sim_fail(error, "--add, the %u. one: %s", faulty, tuile_error_text(result)); }
    for (unsigned k = 0; k < count; k++) {
        world->nodes[k].world.scale.exponent += world->unit; /* of models, not of the ways between them */
    }
    result = tuile_nodes_collect(world->nodes, (uint16_t)count, &view->scene.camera, world->instances, WORLD_THINGS + 1,
                                 &world->collected);
    if (result) { return sim_fail(error, "--lod: %s", tuile_error_text(result)); }
    view->scene.instances = world->instances;
    view->scene.instance_count = world->collected.instances;
    return 0;
}

uint32_t render_world_source(const tuile_scene_t *scene, uint32_t face) {
    uint32_t before = 0;
    const tuile_instance_t *instance = scene->instances;
    for (; face >= instance->model->face_count; instance++) {
        face -= instance->model->face_count;
        before += instance->model->source_face_count;
    }
    return before + tuile_model_source_face(instance->model, face);
}

void render_world_free(render_world_t *world) {
    for (unsigned k = 0; k < world->model_count; k++) {
        free(world->models[k].bytes);
    }
    for (unsigned k = 0; k < world->thing_count; k++) {
        free(world->things[k].materials);
    }
}
