/* What an instance needs to know of a frame: from its quantised vertices to the window, in integers. Made once per instance
 * and pass; geometry/vertex.c uses it per vertex, geometry/cull.c per cluster, geometry/clip.c per clipped face.
 */
#ifndef TUILE_GEOMETRY_TRANSFORM_H
#define TUILE_GEOMETRY_TRANSFORM_H

#include "../assembly.h"
#include "../fixed.h"
#include "../tuile.h"

#define TRANSFORM_LIGHTS_MAX 8

/* Light at vertices and faces, 255 = 1.0: away from both ends, so that the error of interpolation stays inside. */
#define LIGHT_MIN 2
#define LIGHT_MAX 253

/* An affine function of a quantised position q: the sum of (m[i] + low[i] / 2^14) * q[i], plus t, is the `fine` value, known to 2
 * units; without `low` and divided by 2^16 it is the `coarse` one, known to 2 units of its own. |m[i]| < 2^31, |low[i]| <= 2^13,
 * and |fine| < 2^46 for every position inside the model's bounding sphere. */
typedef struct transform_row {
    int32_t m[3];
    int16_t low[3];
    int64_t t;
} transform_row_t;

/* A half space: inside where (sum of n[i] * q[i]) + d >= 0. |n[i]| < 2^24. length >= |n|. */
typedef struct transform_plane {
    int32_t n[3];
    int64_t d;
    uint32_t length;
} transform_plane_t;

/* What the assembly reads, in its order. */
#if ASSEMBLY_THUMB1_COULD
typedef struct transform_run_entry { /* high * 2^15 + low, |low| <= 2^14 */
    int32_t low, high;
} transform_run_entry_t;

typedef struct transform_run_row {
    transform_run_entry_t t, m[3];
} transform_run_row_t;

typedef struct transform_run_row_y {
    transform_run_entry_t t, m[2];
    const void *at_minus_y;
    transform_run_entry_t last;
} transform_run_row_y_t;

typedef struct transform_run { /* geometry/vertex_thumb1.c */
    const void *at_w;
    int32_t light[3];
    uintptr_t normals; /* of positions at address 0 */
    transform_run_row_t x;
    transform_run_row_y_t y;
    transform_run_row_t w;
    const void *at_x_row;
    uint32_t zeros;
    int32_t minus_y, at_x;
    uint32_t shift, r;
    int32_t minus_x;
    uint32_t depth_shift;
    const void *lights; /* or w, where there is none */
    const void *position, *out, *end;
    const void *region; /* where region_x of the transform is */
    uint32_t any;
} transform_run_t;
#else
typedef struct transform_run_row {
    int32_t m[3];
    uint32_t low, high; /* t * 2^16 */
} transform_run_row_t;

typedef struct transform_run { /* geometry/vertex_thumb.c */
    transform_run_row_t w;
    uint32_t zeros, ones; /* ones: UINT32_MAX */
    transform_run_row_t x, y;
    int32_t half;
    uint32_t shift, depth_shift;
    int32_t region_x;
    uint32_t region_width;
    int32_t region_y;
    uint32_t region_height;
    int32_t light[3], ambient; /* ambient: with 2 added */
    const void *end;
    int32_t guard_x, guard_y; /* of those that are beyond the region */
    uint32_t any;
} transform_run_t;
#endif

enum { PLANE_NEAR, PLANE_FAR, PLANE_LEFT, PLANE_RIGHT, PLANE_TOP, PLANE_BOTTOM, PLANE_COUNT };

typedef struct transform {
    /* Perspective: x = X/W, y = Y/W; orthographic: X, Y; third row W, or the depth itself. All fine values. */
    transform_row_t x, y, w;
    bool perspective;
    int8_t k;           /* perspective: window coordinate in 1/16 pixel = X * 2^k / W, 0 <= k <= 32; orthographic: X * 2^k, k < 0 */
    int8_t depth_shift; /* perspective: depth in 1/256 step = reciprocal >> (depth_shift - n), geometry/vertex.c;
                           orthographic: fine w >> depth_shift */
    /* A face whose corners all have 0 <= x - region_x < region_width, and so for y, covers no pixel outside of the region. Widths
     * of 0: of no face can that be told so. */
    int16_t region_x, region_y;
    int64_t w_low, w_high; /* fine values between near and far plane */
    int32_t w_fast;        /* coarse: from here on 32-bit arithmetic is exact enough (perspective) */
    uint16_t region_width, region_height;
    int32_t guard_x, guard_y; /* least window coordinates that a vertex may have, 1/16 pixel; they span GUARD_SPAN */
    /* Culling of clusters. */
    transform_plane_t planes[PLANE_COUNT]; /* in the order of the enumeration until cull_model_outside has put it right */
    uint8_t crossed;       /* so many of the planes, the first ones, the model is not wholly inside of: geometry/cull.c */
    uint8_t eye_shift;     /* eyes far away are cut to 21 bits */
    int16_t observer_bits; /* <= 14 */
    int32_t eye[3];        /* perspective: steps >> eye_shift; orthographic: the view direction, |.| <= 2^20 */
    int32_t observer[3];   /* for the sides of planes: perspective: the eye, in steps * 2^observer_bits; orthographic: the way to
                              the observer. |.| < 2^30 */
    uint32_t w_slope;      /* coarse W changes by so much per step at most: < 2^17 */
    bool mirrored;         /* counter-clockwise in the model is clockwise in the window, seen from the same side */
    bool cones;            /* clusters may be dropped by their cones: one-sided, and the eye within 2^51 steps */
    /* Light. */
    int16_t lights[TRANSFORM_LIGHTS_MAX][3]; /* in model space, towards the light, scaled: (normal . light) >> 13 is 0 ... 255;
                                                |components| <= 16512 */
    uint8_t light_count, ambient;            /* ambient >= LIGHT_MIN */
    bool two_sided;
#if ASSEMBLY_THUMB2_COULD || ASSEMBLY_THUMB1_COULD
    transform_run_t run; /* made by transform_region; what differs by cluster, by the vertex stage */
#endif
} transform_t;

#define GUARD_SPAN 32768 /* 2048 pixels: differences of coordinates fit in 16 bits, their products in 31 */

/* The part of the window that a pass or a tile covers: pixels left ... right - 1, top ... bottom - 1. */
typedef struct transform_region {
    uint16_t left, top, right, bottom;
} transform_region_t;

/* What can be told of camera, pose and lights before anything is computed: 0, TUILE_ERROR_CAMERA or TUILE_ERROR_ARGUMENT. */
int transform_check(const tuile_scene_t *scene, const tuile_instance_t *instance);

/* 0, TUILE_ERROR_CAMERA, TUILE_ERROR_ARGUMENT or TUILE_ERROR_RANGE. */
int transform_make(transform_t *transform, const tuile_scene_t *scene, const tuile_instance_t *instance, uint16_t window_width,
                   uint16_t window_height);

/* The region, and its four sides as culling planes; transform_make must have been called. */
void transform_region(transform_t *transform, const transform_region_t *region);

TUILE_INLINE int64_t transform_fine(const transform_row_t *row, const int16_t q[3]) {
    const int32_t low = row->low[0] * q[0] + row->low[1] * q[1] + row->low[2] * q[2]; /* < 3 * 2^28 */
    return (int64_t)row->m[0] * q[0] + (int64_t)row->m[1] * q[1] + (int64_t)row->m[2] * q[2] + row->t + ((low + (1 << 13)) >> 14);
}

/* The same at q + f / 256. f may be NULL. */
TUILE_INLINE int64_t transform_finer(const transform_row_t *row, const int16_t q[3], const int8_t f[3]) {
    const int64_t whole = transform_fine(row, q);
    if (f == NULL) { return whole; }
    return whole + (((int64_t)row->m[0] * f[0] + (int64_t)row->m[1] * f[1] + (int64_t)row->m[2] * f[2]) >> 8);
}

#endif
