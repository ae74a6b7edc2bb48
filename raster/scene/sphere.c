#include "sphere.h"

void sphere_wide(wide_t centre[3], wide_t *radius, const tuile_model_t *model, const tuile_pose_t *pose) {
    const wide_t step = wide_multiply(wide_scale(model->step), wide_scale(pose->scale));
    for (int i = 0; i < 3; i++) {
        wide_t sum = {0, 0};
        for (int j = 0; j < 3; j++) {
            const wide_t steps = wide_make((int64_t)model->offset[j] + model->centre[j], -30);
            sum = wide_add(sum, wide_multiply(wide_make(pose->rotation[i][j], 0), steps));
        }
        centre[i] = wide_add(wide_multiply(sum, step), wide_make(pose->translation[i], -16));
    }
    *radius = wide_multiply(step, wide_make(model->radius, 0));
}

int tuile_sphere(tuile_sphere_t *sphere, const tuile_model_t *model, const tuile_pose_t *pose) {
    wide_t centre[3], radius;
    sphere_wide(centre, &radius, model, pose);
    for (int i = 0; i < 3; i++) {
        const int64_t at = wide_to_integer(centre[i], 16);
        if (at > INT32_MAX || at < INT32_MIN) { return TUILE_ERROR_RANGE; }
        sphere->centre[i] = (q16_16_t)at;
    }
    const int64_t most = wide_to_integer(radius, 16) + 2; /* the radius was rounded by 1/2, the centre by sqrt(3) / 2 */
    if (most > INT32_MAX) { return TUILE_ERROR_RANGE; }
    sphere->radius = (q16_16_t)most;
    return TUILE_OK;
}
