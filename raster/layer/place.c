/* Points of the world in the window, by the scene's camera: for sprites and lines, which have no model. */
#include "layer.h"

layer_view_t layer_to_view(const tuile_camera_t *camera, const q16_16_t at[3]) {
    int64_t v[3];
    for (unsigned i = 0; i < 3; i++) {
        int64_t sum = 0; /* 3 * 2^28 * 2^32 */
        for (unsigned k = 0; k < 3; k++) {
            sum += (int64_t)(camera->rotation[i][k] >> 2) * ((int64_t)at[k] - camera->eye[k]);
        }
        v[i] = (sum + (INT32_C(1) << 27)) >> 28;
    }
    return (layer_view_t){v[0], v[1], -v[2]};
}

/* |focal * across| in 1/256 sample against the guard: |across| < 2^35, focal < 2^31. */
static bool within(q16_16_t focal, int64_t across, int64_t w) {
    const int64_t at = (int64_t)(focal >> 8) * (across < 0 ? -across : across);
    return at <= (int64_t)LAYER_GUARD * 256 * w;
}

bool layer_inside(const tuile_camera_t *camera, const layer_view_t *at) {
    if (at->w < camera->near || at->w > camera->far) { return false; }
    const int64_t w = camera->projection == TUILE_PERSPECTIVE ? at->w : INT32_C(1) << 16;
    return within(camera->focal_x, at->x, w) && within(camera->focal_y, at->y, w);
}

int64_t layer_project_length(const tuile_camera_t *camera, q16_16_t focal, int64_t length, int64_t w) {
    if (camera->projection == TUILE_ORTHOGRAPHIC) { w = INT32_C(1) << 16; }
    while (length >= INT32_MAX || length <= INT32_MIN || w >= INT32_MAX) { /* 32768 units off, 2^-16 of them do not count */
        length >>= 1;
        w >>= 1;
    }
    return (fixed_floor_div64((int64_t)focal * length, w > 0 ? w : 1) + (1 << 11)) >> 12;
}

/* 8 ... 65528 steps, as geometry/transform.c has it. */
static uint32_t place_depth(const tuile_camera_t *camera, int64_t w) {
    if (camera->projection == TUILE_PERSPECTIVE) { return (uint32_t)((int64_t)65528 * 256 * camera->near / w); }
    const int64_t range = (int64_t)camera->far - camera->near;
    return 8 * 256 + (uint32_t)((int64_t)65520 * 256 * (camera->far - w) / range);
}

layer_place_t layer_project(const tuile_camera_t *camera, const layer_view_t *at) {
    return (layer_place_t){
        ((camera->centre_x + (1 << 11)) >> 12) + (int32_t)layer_project_length(camera, camera->focal_x, at->x, at->w),
        ((camera->centre_y + (1 << 11)) >> 12) - (int32_t)layer_project_length(camera, camera->focal_y, at->y, at->w),
        place_depth(camera, at->w)};
}
