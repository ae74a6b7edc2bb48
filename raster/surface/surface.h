/* What a face looks like: everything that its pixels are computed from, made once for a face and tile.
 *
 * Deferred shading: methods decide which face is seen at each sample, and nothing else; then the faces that are seen are shaded,
 * run by run, by the same few functions whatever the method was. All that varies over a face is told by planes in the window that
 * can be entered at any pixel, so a pixel's colour does not depend on the runs, tiles or passes that led to it.
 *
 * A run goes through stages, 32 samples at a time: texture or one colour; material; light; fog; into the tile. Stages that a face
 * does not want are not there.
 */
#ifndef TUILE_SURFACE_SURFACE_H
#define TUILE_SURFACE_SURFACE_H

#include "../fill/triangle.h"
#include "../geometry/clip.h"
#include "../pixel.h"
#include "fog.h"
#include "texture.h"
#include "textured.h"

#define SURFACE_RUN 32 /* samples a stage is given at once, at most */

/* A corner of a face in the window, and what stands there. */
typedef struct surface_corner {
    vertex_t at; /* light: the white light, where the face is not coloured */
    clip_attributes_t attributes;
} surface_corner_t;

/* A face to be shaded. Corners are counter-clockwise or clockwise, with an area other than 0; of a polygon the largest triangle of
 * its fan. */
typedef struct surface_face {
    surface_corner_t corner[3];
    tuile_material_t material;
    tuile_texture_t texture; /* where material.texture is not TUILE_NO_TEXTURE */
    uint32_t least, most;    /* a polygon: depths of all its corners, 1/256 step; a triangle: 0 */
    bool triangle;           /* not a part of a polygon: the first corner is a topmost one, all are counter-clockwise */
    bool flat;               /* in one light: */
    uint8_t flat_light[3];   /* red, green, blue */
    bool coloured;           /* not flat: attributes.light is the light, else that of `at` */
    bool tinted;             /* attributes.colour is there; else all is white, opaque */
    bool perspective;        /* depth is proportional to 1 / w: texture coordinates follow it */
    uint8_t texturing;       /* tuile_texturing_t */
    bool whole;              /* the three corners are all it has */
    const fog_t *fog;        /* NULL: none */
} surface_face_t;

typedef struct surface surface_t;

/* Samples (x ... x + count - 1, y), count <= SURFACE_RUN. argb: 0xaarrggbb, one each. */
typedef void (*surface_stage_fn)(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb);

/* A run of any length into the samples of a tile, which begin at `samples` for x. */
typedef void (*surface_fill_fn)(const surface_t *surface, int32_t x, int32_t y, int32_t count, void *samples);

enum { SURFACE_STAGES = 7 };

struct surface {
    surface_fill_fn fill;
    surface_stage_fn stage[SURFACE_STAGES]; /* in their order; they end at NULL */
    pixel_kind_t kind;
    uint32_t argb;       /* what is the same all over: the colour, or of textures and of light that varies a factor, with alpha */
    uint32_t sample;     /* the same, in the tile's samples */
    light_plane_t light; /* white light, Q8.24, as fill/triangle.c has it */
    light_plane_t channel[5]; /* red, green, blue, highlight, alpha: surface/light.h */
    texture_plane_t texture;
    textured_map_t map;  /* the fast way */
    depth_plane_t depth; /* where fog or a layer wants it */
    const fog_t *fog;
    uint8_t blend; /* tuile_blend_t, where the face is translucent */
};

/* Makes a surface of a face: the planes and the functions that its pixels want. */
void surface_make(surface_t *surface, const surface_face_t *face, pixel_kind_t kind);

/* Fills the run with one value; any number of samples. */
void surface_fill_same(const surface_t *surface, int32_t x, int32_t y, int32_t count, void *samples);

/* The colours of a run as 0xaarrggbb, count <= SURFACE_RUN. The surface was made for PIXEL_RGB888, which no fast way leads to. */
void surface_run(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb);

/* Fills a run by its stages. */
void surface_fill_stages(const surface_t *surface, int32_t x, int32_t y, int32_t count, void *samples);

#endif
