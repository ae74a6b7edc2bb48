#include "set_up.h"

#include <math.h>
#include <string.h>

static void identity(q2_30_t rotation[3][3]) { tuile_rotation(rotation, 0, 0); }

void set_up_simple(set_up_t *s) {
    memset(s, 0, sizeof *s);
    s->model.step = (tuile_scale_t){1, -8};
    s->model.radius = 60000;
    s->instance.model = &s->model;
    s->instance.pose.scale = TUILE_SCALE_ONE;
    identity(s->instance.pose.rotation);
    s->scene.instances = &s->instance;
    s->scene.instance_count = 1;
    identity(s->scene.camera.rotation);
    s->scene.camera.focal_x = s->scene.camera.focal_y = TUILE_Q16(100);
    s->scene.camera.centre_x = TUILE_Q16(160);
    s->scene.camera.centre_y = TUILE_Q16(120);
    s->scene.camera.near = TUILE_Q16(1);
    s->scene.camera.far = TUILE_Q16(1000);
    s->width = 320;
    s->height = 240;
}

int set_up_transform(const set_up_t *s, transform_t *transform) {
    return transform_make(transform, &s->scene, &s->instance, s->width, s->height);
}

void random_rotation(random_source_t *random, q2_30_t rotation[3][3]) {
    tuile_camera_t camera;
    q16_16_t at[3], up[3];
    do {
        for (int i = 0; i < 3; i++) {
            at[i] = random_between(random, -1000000, 1000000);
            up[i] = random_between(random, -1000000, 1000000);
        }
    } while (tuile_camera_look_at(&camera, (const q16_16_t[3]){0, 0, 0}, at, up) != TUILE_OK);
    memcpy(rotation, camera.rotation, sizeof camera.rotation);
}

void set_up_view(const set_up_t *s, const int16_t q[3], long double view[3]) {
    const tuile_pose_t *pose = &s->instance.pose;
    const tuile_camera_t *camera = &s->scene.camera;
    long double model[3], world[3];
    for (int i = 0; i < 3; i++) {
        model[i] = ldexpl((long double)s->model.step.mantissa * ((long double)s->model.offset[i] + q[i]), s->model.step.exponent);
    }
    for (int i = 0; i < 3; i++) {
        world[i] = 0;
        for (int j = 0; j < 3; j++) {
            world[i] += (long double)pose->rotation[i][j] * 0x1p-30L * model[j];
        }
        world[i] = ldexpl(world[i] * (long double)pose->scale.mantissa, pose->scale.exponent) +
                   (long double)pose->translation[i] / 65536 - (long double)camera->eye[i] / 65536;
    }
    for (int i = 0; i < 3; i++) {
        view[i] = 0;
        for (int j = 0; j < 3; j++) {
            view[i] += (long double)camera->rotation[i][j] * 0x1p-30L * world[j];
        }
    }
}

void set_up_window(const set_up_t *s, const long double view[3], long double *x, long double *y, long double *depth) {
    const tuile_camera_t *camera = &s->scene.camera;
    const long double near = camera->near / 65536.0L, far = camera->far / 65536.0L, w = -view[2];
    const long double fx = camera->focal_x / 65536.0L, fy = camera->focal_y / 65536.0L;
    const bool perspective = camera->projection == TUILE_PERSPECTIVE;
    *x = camera->centre_x / 65536.0L + fx * view[0] / (perspective ? w : 1);
    *y = camera->centre_y / 65536.0L - fy * view[1] / (perspective ? w : 1);
    *depth = perspective ? 65528 * near / w : 8 + 65520 * (far - w) / (far - near);
}

bool set_up_stand(set_up_t *s, const int16_t q[3], const long double wanted[3]) {
    long double view[3];
    set_up_view(s, q, view);
    for (int i = 0; i < 3; i++) {
        long double move = s->instance.pose.translation[i] / 65536.0L;
        for (int j = 0; j < 3; j++) {
            move += (long double)s->scene.camera.rotation[j][i] * 0x1p-30L * (wanted[j] - view[j]);
        }
        if (fabsl(move) > 32000) { return false; }
        s->instance.pose.translation[i] = (q16_16_t)(move * 65536);
    }
    return true;
}
