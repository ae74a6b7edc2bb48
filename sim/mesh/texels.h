/* From an image to a texture in the bytes of geometry/model.h: size, mip levels, format, palette. */
#ifndef SIM_MESH_TEXELS_H
#define SIM_MESH_TEXELS_H

#include "image.h"
#include "mesh.h"

/* flags: TUILE_TEXTURE_CLAMP_... . texture->name is left to the caller. Errors begin with `name`. */
int texels_make(mesh_texture_t *texture, const image_t *image, unsigned flags, const mesh_options_t *options, const char *name,
                sim_error_t *error);

#endif
