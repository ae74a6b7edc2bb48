/* Cameras and rotations from what people think in: points, directions, angles. */
#include "vector.h"

#include "../trig.h"
#include "../tuile.h"

int tuile_camera_look_at(tuile_camera_t *camera, const q16_16_t eye[3], const q16_16_t at[3], const q16_16_t up[3]) {
    const int64_t towards[3] = {(int64_t)at[0] - eye[0], (int64_t)at[1] - eye[1], (int64_t)at[2] - eye[2]};
    const int64_t upward[3] = {up[0], up[1], up[2]};
    q2_30_t forward[3] = {0}, up_unit[3] = {0}, right[3] = {0}, above[3] = {0};
    int64_t cross[3];

    if (!vector_normalise(forward, towards) || !vector_normalise(up_unit, upward)) { return TUILE_ERROR_CAMERA; }
    vector_cross(cross, forward, up_unit);
    for (int i = 0; i < 3; i++) {
        /* 2^-40: not parallel within the precision of the input */
        if (cross[i] > (INT32_C(1) << 20) || cross[i] < -(INT32_C(1) << 20)) { break; }
        if (i == 2) { return TUILE_ERROR_CAMERA; }
    }
    (void)vector_normalise(right, cross);
    vector_cross(cross, right, forward);
    (void)vector_normalise(above, cross);
    for (int i = 0; i < 3; i++) {
        camera->rotation[0][i] = right[i];
        camera->rotation[1][i] = above[i];
        camera->rotation[2][i] = -forward[i];
        camera->eye[i] = eye[i];
    }
    return TUILE_OK;
}

q16_16_t tuile_focal_px(bam16_t fov, uint16_t size_px) {
    if (fov == 0 || fov >= 0x8000u || size_px == 0) { return 0; }
    const int64_t sine = trig_sine(fov), cosine = trig_sine(0x8000u + fov); /* of half the angle */
    const int64_t focal = (((int64_t)size_px << 15) * cosine) / sine;       /* 2^31 * 2^30 */
    return focal > INT32_MAX ? 0 : (q16_16_t)focal;
}

void tuile_rotation(q2_30_t rotation[3][3], int axis, bam16_t angle) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            rotation[i][j] = i == j ? TUILE_ONE_Q30 : 0;
        }
    }
    rotation[u][u] = rotation[v][v] = tuile_cos(angle);
    rotation[v][u] = tuile_sin(angle);
    rotation[u][v] = -rotation[v][u];
}
