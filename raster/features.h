/* What a build has of the effects: boards that do not want all leave out their code with -DTUILE_FEATURES=BITS. */
#ifndef TUILE_FEATURES_H
#define TUILE_FEATURES_H

#ifndef TUILE_FEATURES
#define TUILE_FEATURES 0x3ff
#endif

/* Formats (1 << tuile_format_t, or-ed) that a build has. */
#ifndef TUILE_FORMATS
#define TUILE_FORMATS 0xffff
#endif

#define FEATURE_SURFACES 1 /* deferred shading, which the next four build on */
#define FEATURE_TEXTURES 2
#define FEATURE_LIGHTS 4 /* coloured and point lights, highlights, vertex colours */
#define FEATURE_FOG 8
#define FEATURE_LAYERS 16   /* translucent faces, sprites */
#define FEATURE_LINES 32    /* lines, edges of faces */
#define FEATURE_RESOLVE 64  /* formats that are not drawn in wire bytes, dithering */
#define FEATURE_MORPH 128   /* instances between two key frames */
#define FEATURE_SAMPLES 256 /* several samples a pixel: anti-aliasing; on top of RESOLVE */
#define FEATURE_OVERLAY 512 /* config.overlay; what it calls is linked by those who call it */

#define TUILE_HAS(feature) (((TUILE_FEATURES) & (FEATURE_##feature)) != 0)
#define TUILE_HAS_FORMAT(format) (((TUILE_FORMATS) >> (format)&1) != 0)

#endif
