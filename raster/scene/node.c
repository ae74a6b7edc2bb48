#include "node.h"

#include "../geometry/wide.h"
#include "rotation.h"

static bool scale_fits(int32_t exponent) { return exponent >= -1000 && exponent <= 1000; }

/* Rounded to 32 bits: 2^-32 of it. False beyond 2^+-1000. */
static bool scale_multiply(tuile_scale_t *out, tuile_scale_t a, tuile_scale_t b) {
    uint64_t mantissa = (uint64_t)a.mantissa * b.mantissa;
    int32_t exponent = a.exponent + b.exponent;
    if (mantissa >> 32) {
        const unsigned shift = 32 - fixed_clz64(mantissa);
        mantissa = (mantissa + ((uint64_t)1 << (shift - 1))) >> shift; /* 2^64 - 2^33 + 1 at most before: no overflow */
        exponent += (int32_t)shift;
        if (mantissa >> 32) {
            mantissa >>= 1;
            exponent++;
        }
    }
    *out = (tuile_scale_t){(uint32_t)mantissa, exponent};
    return scale_fits(exponent);
}

/* out = parent * local. */
static int pose_compose(tuile_pose_t *out, const tuile_pose_t *parent, const tuile_pose_t *local) {
    if (!rotation_multiply(out->rotation, parent->rotation, local->rotation) ||
        !scale_multiply(&out->scale, parent->scale, local->scale)) {
        return TUILE_ERROR_RANGE;
    }
    for (int i = 0; i < 3; i++) {
        int64_t sum = 0; /* Q17.46; |sum| < 3.01 * 2^61 */
        for (int k = 0; k < 3; k++) {
            sum += (int64_t)parent->rotation[i][k] * local->translation[k];
        }
        const int64_t way = wide_to_integer(wide_multiply(wide_make(sum, -46), wide_scale(parent->scale)), 16); /* <= 2^62 */
        const int64_t at = parent->translation[i] + way;
        if (at > INT32_MAX || at < INT32_MIN) { return TUILE_ERROR_RANGE; }
        out->translation[i] = (q16_16_t)at;
    }
    return TUILE_OK;
}

static int node_update(tuile_node_t *nodes, uint32_t index) {
    tuile_node_t *node = &nodes[index];
    const tuile_pose_t *local = &node->instance.pose;
    if (node->parent < TUILE_NODE_WORLD || node->parent >= (int32_t)index || !rotation_is_unit(local->rotation) ||
        local->scale.mantissa == 0 || !scale_fits(local->scale.exponent)) {
        return TUILE_ERROR_ARGUMENT;
    }
    node->concealed = node->hidden;
    if (node->parent == TUILE_NODE_WORLD) {
        node->world = *local;
        return TUILE_OK;
    }
    const tuile_node_t *parent = &nodes[node->parent];
    node->concealed |= parent->concealed;
    return pose_compose(&node->world, &parent->world, local);
}

int tuile_nodes_update(tuile_node_t *nodes, uint16_t count, uint16_t *faulty) {
    for (uint32_t i = 0; i < count; i++) {
        const int error = node_update(nodes, i);
        if (error) {
            if (faulty) { *faulty = (uint16_t)i; }
            return error;
        }
    }
    return TUILE_OK;
}

/* The model of a node for this frame; NULL: none. */
static int node_model(tuile_node_t *node, const tuile_camera_t *camera, const tuile_model_t **model) {
    *model = node->instance.model;
    if (node->lod == NULL) { return TUILE_OK; }
    const int level = tuile_lod_level(node->lod, &node->world, camera, node->level);
    if (level < 0) { return level; }
    node->level = (uint8_t)level;
    *model = level < node->lod->count ? node->lod->models[level] : NULL;
    return TUILE_OK;
}

int tuile_nodes_collect(tuile_node_t *nodes, uint16_t count, const tuile_camera_t *camera, tuile_instance_t *instances,
                        uint16_t capacity, tuile_collected_t *collected) {
    *collected = (tuile_collected_t){0};
    for (uint32_t i = 0; i < count; i++) {
        tuile_node_t *node = &nodes[i];
        const tuile_model_t *model;
        if (node->instance.model == NULL && node->lod == NULL) { continue; }
        if (node->concealed) {
            collected->hidden++;
            continue;
        }
        const int error = node_model(node, camera, &model);
        if (error) { return error; }
        if (model == NULL) {
            collected->too_far++;
            continue;
        }
        if (collected->instances < capacity) {
            tuile_instance_t *out = &instances[collected->instances];
            *out = node->instance;
            out->model = model;
            out->pose = node->world;
        }
        collected->instances++;
    }
    return collected->instances > capacity ? TUILE_ERROR_MEMORY : TUILE_OK;
}
