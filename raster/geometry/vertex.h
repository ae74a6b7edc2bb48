/* Vertices in the window: what faces are made of after the vertex stage. */
#ifndef TUILE_GEOMETRY_VERTEX_H
#define TUILE_GEOMETRY_VERTEX_H

#include "transform.h"

/* x, y: window, 1/16 pixel. x = VERTEX_OUTSIDE: beyond near plane, far plane or guard band; the rest then holds the light only.
 * depth_light: depth in 1/256 step (2 ... 65529 steps) << 8 | light (LIGHT_MIN ... LIGHT_MAX). */
typedef struct vertex {
    int16_t x, y;
    uint32_t depth_light;
} vertex_t;

#define VERTEX_OUTSIDE INT16_MIN
#define VERTEX_DEPTH_MIN 512u
#define VERTEX_DEPTH_MAX (65529u * 256u)

/* A vertex must keep this far from the ends of the guard span, so that clipping at GUARD_CLIP moves no vertex that is in. */
#define GUARD_MARGIN 16
#define GUARD_CLIP 8

/* What vertex_stage_region tells of the vertices of a cluster. */
enum {
    VERTEX_ANY_OUTSIDE = 1, /* some of them is outside */
    VERTEX_ANY_BEYOND = 2,  /* some of them is beyond the region (transform_region), so that a face may cover pixels there */
};

/* Fills out[0 ... count - 1], count >= 1, after transform_region. cluster: whose vertices they are (geometry/model.h). normals: 3 x
 * int8 each, or NULL when no light is wanted at the vertices. Returns VERTEX_ANY_... What is not const of the transform is scratch.
 */
unsigned vertex_stage_region(transform_t *transform, const uint8_t *cluster, const int16_t *positions, const int8_t *normals,
                             unsigned count, vertex_t *out);

/* The same of vertices of any clusters; whether any of them is outside. */
bool vertex_stage(const transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out);

/* Makes those of out[0 ... count - 1] anew, after vertex_stage, whose positions have fractions: 3 x int8 each, in 1/256. Returns
 * whether any of these is outside. */
bool vertex_fractions(const transform_t *transform, const int16_t *positions, const int8_t *fractions, unsigned count,
                      vertex_t *out);

/* Projects fine coordinates (clip-space, 46 bits). False outside near plane, far plane or guard band; with clamp, what lies beyond
 * the guard span is moved to its edge instead. Sets x, y and the depth; light is 0 ... 255. */
bool vertex_project(const transform_t *transform, int64_t x, int64_t y, int64_t w, uint8_t light, bool clamp, vertex_t *out);

/* Ambient and all directional lights at a normal, in LIGHT_MIN ... LIGHT_MAX. */
TUILE_INLINE uint8_t vertex_light(const transform_t *transform, int32_t nx, int32_t ny, int32_t nz) {
    int32_t sum = transform->ambient;
    const int16_t(*light)[3] = transform->lights, (*const end)[3] = light + transform->light_count;
    for (; light != end; light++) {
        const int32_t dot = (nx * (*light)[0] + ny * (*light)[1] + nz * (*light)[2]) >> 13; /* |sum| <= 3 * 128 * 16512 < 2^23 */
        if (dot > 0) {
            sum += dot;
        } else if (transform->two_sided) {
            sum -= dot;
        }
    }
    return (uint8_t)(sum > LIGHT_MAX ? LIGHT_MAX : sum);
}

/* The light of most scenes: none or one. */
typedef struct vertex_sun {
    int32_t x, y, z, ambient;
    bool alone, two_sided;
} vertex_sun_t;

TUILE_INLINE vertex_sun_t vertex_sun(const transform_t *transform) {
    return (vertex_sun_t){transform->lights[0][0], transform->lights[0][1],     transform->lights[0][2],
                          transform->ambient,      transform->light_count <= 1, transform->two_sided};
}

/* vertex_light at a normal of a model, where the light is alone and one-sided. */
TUILE_INLINE uint8_t vertex_sun_front(const vertex_sun_t *sun, const int8_t *n) {
    const int32_t dot = (n[0] * sun->x + n[1] * sun->y + n[2] * sun->z) >> 13;
    const int32_t sum = sun->ambient + (dot & ~(dot >> 31));
    return (uint8_t)(sum > LIGHT_MAX ? LIGHT_MAX : sum);
}

/* vertex_light at a normal of a model. */
TUILE_INLINE uint8_t vertex_sun_light(const transform_t *transform, const vertex_sun_t *sun, const int8_t *n) {
    if (TUILE_UNLIKELY(!sun->alone)) { return vertex_light(transform, n[0], n[1], n[2]); }
    const int32_t dot = (n[0] * sun->x + n[1] * sun->y + n[2] * sun->z) >> 13;
    int32_t sum = sun->ambient;
    if (dot > 0) {
        sum += dot;
    } else if (sun->two_sided) {
        sum -= dot;
    }
    return (uint8_t)(sum > LIGHT_MAX ? LIGHT_MAX : sum);
}

#endif
