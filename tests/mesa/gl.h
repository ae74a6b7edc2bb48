/* Textured triangles drawn by Mesa's software rasteriser into memory: what the renderer is compared with. Nearest texels, no light,
 * back faces culled, depth tested, one sample a pixel. */
#ifndef TESTS_MESA_GL_H
#define TESTS_MESA_GL_H

#include <stddef.h>
#include <stdint.h>

typedef struct gl_texture {
    uint32_t width, height;
    uint32_t *argb; /* 0xaarrggbb, row 0 = the top */
    int clamp_s, clamp_t;
} gl_texture_t;

typedef struct gl_triangle {
    double position[3][3];
    double st[3][2]; /* in widths and heights of the texture, t downwards */
    int texture;     /* -1: none */
    uint32_t rgb;    /* 0xrrggbb; without a texture */
} gl_triangle_t;

typedef struct gl_scene {
    double clip[4][4]; /* rows: position to clip coordinates; y is upwards in clip space and downwards in the picture */
    const gl_triangle_t *triangles;
    size_t triangle_count;
    const gl_texture_t *textures;
    size_t texture_count;
    uint32_t background; /* 0xrrggbb */
} gl_scene_t;

/* The picture as 0xrrggbb, row 0 at the top, to be released with free. Fails the test when Mesa is not there or is not llvmpipe. */
uint32_t *gl_draw(const gl_scene_t *scene, uint32_t width, uint32_t height);

#endif
