#include "lod.h"

#include "sphere.h"

static bool lod_is_good(const tuile_lod_t *lod) {
    if (lod->count == 0 || lod->count == TUILE_LOD_FRESH || lod->models == NULL || lod->reach == NULL) { return false; }
    for (unsigned k = 0; k < lod->count; k++) {
        if (lod->models[k] == NULL || lod->reach[k] <= (k ? lod->reach[k - 1] : 0)) { return false; }
    }
    return true;
}

/* Is the squared distance more than that of reach * share / 256? */
static bool is_beyond(wide_t square, q16_16_t reach, int32_t share) {
    const wide_t border = wide_make((int64_t)reach * share, -24);
    return wide_sign(wide_add(square, wide_negate(wide_multiply(border, border)))) > 0;
}

int tuile_lod_level(const tuile_lod_t *lod, const tuile_pose_t *pose, const tuile_camera_t *camera, uint8_t level) {
    wide_t from_eye[3], radius;
    if (!lod_is_good(lod) || pose->scale.mantissa == 0) { return TUILE_ERROR_ARGUMENT; }
    sphere_wide(from_eye, &radius, lod->models[0], pose);
    for (int i = 0; i < 3; i++) {
        from_eye[i] = wide_add(from_eye[i], wide_make(-(int64_t)camera->eye[i], -16));
    }
    const wide_t square = wide_dot(from_eye, from_eye);
    const int32_t slack = lod->hysteresis;
    if (level <= lod->count && (level == 0 || is_beyond(square, lod->reach[level - 1], 256 - slack)) &&
        (level == lod->count || !is_beyond(square, lod->reach[level], 256 + slack))) {
        return level;
    }
    int chosen = 0;
    while (chosen < lod->count && is_beyond(square, lod->reach[chosen], 256)) {
        chosen++;
    }
    return chosen;
}
