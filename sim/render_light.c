#include "render_light.h"

#include "commands.h"
#include "render_value.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char render_light_usage[] =
    "  --light X,Y,Z[,RRGGBB[,I]]   the way the light travels, its colour and intensity, 0 ... 1; may be given several times\n"
    "  --point-light X,Y,Z,RANGE[,RRGGBB[,I]]   a light at a point, which reaches so far; in model units\n"
    "  --ambient RRGGBB | 0...1     light from everywhere\n"
    "  --specular LEVEL,EXPONENT    highlights, level 0 ... 1, exponent 1 ... 128, for all materials of the model\n"
    "  --emission RRGGBB            light of their own, for all materials of the model\n"
    "  --two-sided                  back faces are drawn too\n"
    "  --fog linear:NEAR,FAR,RRGGBB | exp:NEAR,HALF,RRGGBB   none until NEAR; all from FAR on, or half of the rest every HALF\n";

static void fail(options_t *options, const char *what, const char *text) {
    (void)command_fail("%s takes %s, not \"%s\"", options->name, what, text);
    options->failed = true;
}

/* The next part of a list, up to a comma or the end; *text moves behind it. NULL: there is none. */
static const char *next_part(const char **text, char part[64]) {
    if (*text == NULL) { return NULL; }
    const char *end = strchr(*text, ',');
    const size_t length = end ? (size_t)(end - *text) : strlen(*text);
    if (length > 63) { return NULL; }
    memcpy(part, *text, length);
    part[length] = '\0';
    *text = end ? end + 1 : NULL;
    return part;
}

static bool part_number(const char **text, double *value, double low, double high) {
    char part[64], *end;
    if (!next_part(text, part) || part[0] == '\0') { return false; }
    *value = strtod(part, &end);
    return *end == '\0' && *value >= low && *value <= high;
}

static bool part_colour(const char **text, uint8_t colour[3]) {
    char part[64];
    return next_part(text, part) && render_value_colour(part, colour);
}

static void take_light(render_light_t *l, options_t *options, unsigned numbers, const char *what) {
    const char *text = options_value(options), *rest = text;
    tuile_light_t light = {.kind = numbers == 4 ? TUILE_LIGHT_POINT : TUILE_LIGHT_DIRECTIONAL, .intensity = 255};
    double intensity = 1.0, at[4] = {0};
    bool right = true, has_intensity = false;
    if (!text) { return; }
    if (l->count == RENDER_LIGHTS_MAX) {
        (void)command_fail("%s: %d lights are enough", options->name, RENDER_LIGHTS_MAX);
        options->failed = true;
        return;
    }
    for (unsigned i = 0; i < numbers; i++) {
        right = right && part_number(&rest, &at[i], i == 3 ? 1e-12 : -1e12, 1e12);
    }
    const bool has_colour = right && rest;
    if (has_colour) { right = part_colour(&rest, light.colour); }
    if (right && rest) { right = has_intensity = part_number(&rest, &intensity, 0.0, 1.0); }
    if (!right || rest) {
        fail(options, what, text);
        return;
    }
    if (has_colour && (light.colour[0] | light.colour[1] | light.colour[2]) == 0) { /* the scene's word for white */
        intensity = 0.0;
        has_intensity = true;
    }
    light.intensity = (uint8_t)lround(intensity * 255.0);
    memcpy(l->at[l->count], at, sizeof at);
    l->has_intensity[l->count] = has_intensity || light.kind == TUILE_LIGHT_POINT;
    l->light[l->count++] = light;
}

static void take_ambient(render_light_t *l, options_t *options) {
    const char *text = options_value(options), *rest = text;
    if (!text) { return; }
    l->has_ambient = true;
    l->ambient = 1.0;
    if (part_colour(&rest, l->ambient_colour)) {
        if ((l->ambient_colour[0] | l->ambient_colour[1] | l->ambient_colour[2]) == 0) { l->ambient = 0; }
        if (!rest) { return; }
    }
    rest = text;
    memset(l->ambient_colour, 0, 3);
    if (!part_number(&rest, &l->ambient, 0.0, 1.0) || rest) { fail(options, "RRGGBB or 0 ... 1", text); }
}

static void take_specular(render_light_t *l, options_t *options) {
    const char *text = options_value(options), *rest = text;
    double level, exponent;
    if (!text) { return; }
    if (!part_number(&rest, &level, 0.0, 1.0) || !part_number(&rest, &exponent, 1.0, 128.0) || rest) {
        fail(options, "a level 0 ... 1 and an exponent 1 ... 128", text);
        return;
    }
    l->has_specular = true;
    l->specular = (uint8_t)lround(level * 255.0);
    l->shininess = (uint8_t)lround(log2(exponent));
}

static void take_fog(render_light_t *l, options_t *options) {
    const char *text = options_value(options), *rest = text ? strchr(text, ':') : NULL;
    if (!text) { return; }
    const bool linear = strncmp(text, "linear:", 7) == 0, exponential = strncmp(text, "exp:", 4) == 0;
    if (rest) { rest++; }
    if (!(linear || exponential) || !part_number(&rest, &l->fog_near, 0.0, 1e12) || !part_number(&rest, &l->fog_far, 1e-12, 1e12) ||
        !part_colour(&rest, l->fog.colour) || rest || (linear && l->fog_far <= l->fog_near)) {
        fail(options, "linear:NEAR,FAR,RRGGBB (FAR beyond NEAR) or exp:NEAR,HALF,RRGGBB", text);
        return;
    }
    l->fog.kind = linear ? TUILE_FOG_LINEAR : TUILE_FOG_EXPONENTIAL;
}

bool render_light_option(render_light_t *l, options_t *options, const char *argument) {
    if (strcmp(argument, "--light") == 0) {
        take_light(l, options, 3, "X,Y,Z[,RRGGBB[,INTENSITY]]");
    } else if (strcmp(argument, "--point-light") == 0) {
        take_light(l, options, 4, "X,Y,Z,RANGE[,RRGGBB[,INTENSITY]]");
    } else if (strcmp(argument, "--ambient") == 0) {
        take_ambient(l, options);
    } else if (strcmp(argument, "--specular") == 0) {
        take_specular(l, options);
    } else if (strcmp(argument, "--emission") == 0) {
        const char *text = options_value(options), *rest = text;
        l->has_emission = text != NULL;
        if (text && (!part_colour(&rest, l->emission) || rest)) { fail(options, "RRGGBB", text); }
    } else if (strcmp(argument, "--two-sided") == 0) {
        l->two_sided = true;
    } else if (strcmp(argument, "--fog") == 0) {
        take_fog(l, options);
    } else {
        return false;
    }
    return true;
}

static bool wants_surfaces(const render_light_t *l) {
    bool wants = l->fog.kind != TUILE_FOG_NONE || l->has_specular || l->has_emission || l->count > 8 ||
                 (l->ambient_colour[0] | l->ambient_colour[1] | l->ambient_colour[2]) != 0;
    for (unsigned i = 0; i < l->count; i++) {
        const uint8_t *c = l->light[i].colour;
        wants |= l->light[i].kind == TUILE_LIGHT_POINT || (c[0] | c[1] | c[2]) != 0;
    }
    return wants;
}

void render_light_apply(const render_light_t *l, tuile_config_t *config) {
    if (wants_surfaces(l)) { config->effects |= TUILE_SURFACES; }
}

/* Model units to world units. */
static bool world(const view_t *view, double value, q16_16_t *to) {
    const double scaled = value * view->unit * 65536.0;
    if (fabs(scaled) > 2147483647.0) { return false; }
    *to = (q16_16_t)llround(scaled);
    return true;
}

static int place_light(render_light_t *l, unsigned i, const view_t *view, sim_error_t *error) {
    tuile_light_t *light = &l->light[i];
    const double *at = l->at[i];
    if (light->kind == TUILE_LIGHT_POINT) {
        bool fits = world(view, at[3], &light->range);
        for (int k = 0; k < 3; k++) {
            fits = fits && world(view, at[k], &light->position[k]);
        }
        if (light->range == 0) { light->range = 1; }
        return fits ? 0
                    : sim_fail(error, "--point-light %g,%g,%g,%g: out of all proportion to what is seen", at[0], at[1], at[2],
                               at[3]);
    }
    const double length = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
    if (length == 0.0) { return sim_fail(error, "--light 0,0,0 is no direction"); }
    for (int k = 0; k < 3; k++) {
        light->direction[k] = (q2_14_t)lround(at[k] / length * 16384.0);
    }
    if (!l->has_intensity[i]) { light->intensity = view->light.intensity; }
    return 0;
}

static int place_materials(render_light_t *l, view_t *view, sim_error_t *error) {
    const tuile_model_t *model = view->instance.model;
    l->materials = malloc(sizeof *l->materials * (model->material_count + 1));
    if (!l->materials) { return sim_fail(error, "out of memory"); }
    for (uint32_t m = 0; m < model->material_count; m++) {
        tuile_material_t *to = &l->materials[m];
        *to = view->instance.materials ? view->instance.materials[m] : tuile_model_material(model, m);
        if (l->has_specular) {
            to->specular = l->specular;
            to->shininess = l->shininess;
        }
        if (l->has_emission) { memcpy(to->emission, l->emission, 3); }
    }
    view->instance.materials = l->materials;
    return 0;
}

int render_light_place(render_light_t *l, view_t *view, sim_error_t *error) {
    tuile_scene_t *scene = &view->scene;
    for (unsigned i = 0; i < l->count; i++) {
        if (place_light(l, i, view, error) != 0) { return -1; }
    }
    if (l->count > 0) {
        scene->lights = l->light;
        scene->light_count = (uint8_t)l->count;
    }
    if (l->has_ambient) {
        scene->ambient = (uint8_t)lround(l->ambient * 255.0);
        memcpy(scene->ambient_colour, l->ambient_colour, 3);
    }
    if (l->fog.kind != TUILE_FOG_NONE) {
        if (!world(view, l->fog_near, &l->fog.near) || !world(view, l->fog_far, &l->fog.far) || l->fog.far <= 0 ||
            (l->fog.kind == TUILE_FOG_LINEAR && l->fog.far <= l->fog.near)) {
            return sim_fail(error, "--fog: %g and %g are out of all proportion to what is seen", l->fog_near, l->fog_far);
        }
        scene->fog = l->fog;
    }
    if (l->two_sided) { view->instance.two_sided = true; }
    return l->has_specular || l->has_emission ? place_materials(l, view, error) : 0;
}

void render_light_free(render_light_t *l) {
    free(l->materials);
    l->materials = NULL;
}
