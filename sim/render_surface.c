#include "render_surface.h"

#include <string.h>

const char render_surface_usage[] = "  --plain                  neither textures nor vertex colours: materials in one colour\n"
                                    "  --affine                 textures without perspective correction, to see the difference\n"
                                    "  --nearest                the nearest texel, whatever the material says\n";

bool render_surface_option(render_surface_t *surface, options_t *options, const char *argument) {
    (void)options;
    if (strcmp(argument, "--plain") == 0) {
        surface->plain = true;
    } else if (strcmp(argument, "--affine") == 0) {
        surface->texturing |= TUILE_TEXTURE_AFFINE;
    } else if (strcmp(argument, "--nearest") == 0) {
        surface->texturing |= TUILE_TEXTURE_NEAREST;
    } else {
        return false;
    }
    return true;
}

void render_surface_apply(const render_surface_t *surface, const tuile_model_t *model, tuile_config_t *config) {
    config->texturing = surface->texturing;
    if (!surface->plain && (model->texture_count > 0 || model->colours != NULL)) { config->effects |= TUILE_SURFACES; }
}
