#include "turntable.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void turntable_place(tuile_instance_t *instance, const tuile_model_t *model, unsigned number) {
    const double step = ldexp((double)model->step.mantissa, model->step.exponent), radius = step * model->radius;
    const bool as_it_is = radius > 0.5 && radius < 1.9;
    const double scale = as_it_is ? 1.0 : 1.0 / radius;
    int exponent;
    const double mantissa = frexp(scale, &exponent);
    double centre[3] = {0, 0, 0};

    instance->model = model;
    instance->pose.scale = (tuile_scale_t){(uint32_t)ldexp(mantissa, 31), exponent - 31};
    if (as_it_is) { instance->pose.scale = TUILE_SCALE_ONE; }
    tuile_rotation(instance->pose.rotation, 1, (bam16_t)(number * (65536u / TURNTABLE_FRAMES)));
    for (int i = 0; i < 3 && !as_it_is; i++) {
        centre[i] = scale * step * (model->offset[i] + (double)model->centre[i]);
    }
    for (int i = 0; i < 3; i++) {
        double at = i == 2 ? -3.0 : 0.0;
        for (int j = 0; j < 3; j++) {
            at -= instance->pose.rotation[i][j] / (double)TUILE_ONE_Q30 * centre[j];
        }
        instance->pose.translation[i] = TUILE_Q16(at);
    }
    if (number == 0 && !as_it_is) { (void)printf("scaled by %g\n", scale); }
}

void turntable_open(view_t *view, uint16_t width, uint16_t height) {
    static const q16_16_t eye[3] = {0, 0, 0}, at[3] = {0, 0, -65536}, up[3] = {0, 65536, 0};
    const double length = sqrt(0.4 * 0.4 + 0.6 * 0.6 + 1.0);
    tuile_camera_t *camera = &view->scene.camera;
    memset(view, 0, sizeof *view);
    view->light = (tuile_light_t){
        {(q2_14_t)lround(-0.4 / length * 16384), (q2_14_t)lround(-0.6 / length * 16384), (q2_14_t)lround(-1 / length * 16384)},
        191};
    view->scene.instances = &view->instance;
    view->scene.instance_count = 1;
    view->scene.lights = &view->light;
    view->scene.light_count = 1;
    view->scene.ambient = 38;
    (void)tuile_camera_look_at(camera, eye, at, up);
    camera->focal_x = camera->focal_y = tuile_focal_px(8192, height);
    camera->centre_x = width * 32768;
    camera->centre_y = height * 32768;
    camera->near = 65536;
    camera->far = 655360;
}
