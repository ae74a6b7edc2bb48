/* Of tuile render: an image file as a texture that is drawn by itself, over the model or in the scene. */
#ifndef SIM_RENDER_IMAGE_H
#define SIM_RENDER_IMAGE_H

#include "../raster/tuile.h"
#include "mesh/mesh.h"

typedef struct render_image {
    const char *path; /* not ended: a part of the argument */
    int path_length;
    mesh_texture_t made;
    tuile_texture_t texture; /* points into made */
} render_image_t;

/* "FILE@NUMBERS": takes FILE from value, which must outlive the image, and returns NUMBERS. NULL when there is no FILE or no @.
 * The last @ counts: names may have others. */
const char *render_image_name(render_image_t *image, const char *value);

/* PNG or JPEG: its alpha in 4 bits if it has any, else the smallest format that shows it. 0, or an exit code and a message that
 * begins with the option. */
int render_image_load(render_image_t *image, const char *option);

void render_image_free(render_image_t *image);

#endif
