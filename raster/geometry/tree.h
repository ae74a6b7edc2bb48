/* Reading the display tree of a compiled model. The layout is model.h's. */
#ifndef TUILE_GEOMETRY_TREE_H
#define TUILE_GEOMETRY_TREE_H

#include "model.h"
#include "transform.h"

typedef struct tree_convex {
    uint32_t first;           /* face */
    uint32_t inward, outward; /* faces from there on, and behind those */
    uint32_t cluster;         /* of the first face */
} tree_convex_t;

typedef struct tree_plane {
    int32_t n[3];
    int64_t d;
} tree_plane_t;

static inline uint32_t tree_word(const TUILE_FLASH uint8_t *tree, uint32_t at) { return model_u32(tree + 4 * (size_t)at); }

static inline tree_convex_t tree_convex(const TUILE_FLASH uint8_t *node) {
    return (tree_convex_t){model_u32(node + 4) >> 1, model_u32(node + 8) >> 1, model_u32(node + 12) >> 1,
                           TREE_VALUE(model_u32(node))};
}

static inline uint32_t tree_second(const TUILE_FLASH uint8_t *node) { return model_u32(node + 4) >> 1; }

static inline tree_plane_t tree_plane(const TUILE_FLASH uint8_t *node) {
    tree_plane_t plane;
    for (unsigned i = 0; i < 3; i++) {
        plane.n[i] = (int32_t)model_u32(node + 8 + 4 * i) >> 1;
    }
    plane.d = (int64_t)((int32_t)model_u32(node + 24) >> 1) * (INT32_C(1) << 30) + (int64_t)(model_u32(node + 20) >> 1);
    return plane;
}

/* Which side of the plane the observer is on: > 0 the plus side. |n| < 2^30, |d| < 2^48 and |observer| < 2^30, observer_bits <= 14:
 * the sum is below 3 * 2^60 + 2^62. */
static inline int64_t tree_side(const tree_plane_t *plane, const transform_t *transform) {
    const int32_t *o = transform->observer;
    int64_t d = 0;
    if (transform->perspective) {
        const int bits = transform->observer_bits;
        d = bits >= 0 ? plane->d * ((int64_t)1 << bits) : plane->d >> (bits < -62 ? 62 : -bits);
    }
    return (int64_t)plane->n[0] * o[0] + (int64_t)plane->n[1] * o[1] + (int64_t)plane->n[2] * o[2] + d;
}

/* Whether the tree of a model that is sound otherwise is a tree, names each face once, in order, and nothing beyond the model. */
bool tree_check(const tuile_model_t *model);

#endif
