/* Texture coordinates over a face, and texels. */
#ifndef TUILE_SURFACE_TEXTURE_H
#define TUILE_SURFACE_TEXTURE_H

#include "../tuile.h"

typedef struct texture_plane {
    tuile_texture_t texture;
} texture_plane_t;

#endif
