#include "view.h"

#include "../raster/scene/camera.h"

#include <math.h>
#include <string.h>

static double length3(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static q16_16_t to_q16(double value) { return (q16_16_t)llround(value * 65536.0); }

static bam16_t to_bam16(double degrees) { return (bam16_t)(llround(fmod(degrees, 360.0) * (65536.0 / 360.0)) & 0xffff); }

/* Bounding sphere in model units. */
static void model_sphere(const tuile_model_t *model, double centre[3], double *radius) {
    const double step = ldexp((double)model->step.mantissa, model->step.exponent);
    for (int i = 0; i < 3; i++) {
        centre[i] = step * ((double)model->offset[i] + model->centre[i]);
    }
    *radius = step * (model->radius + 1.0);
}

typedef struct framing {
    double eye[3], at[3], near, far, fov;
    double centre[3], radius; /* of all that is to be seen */
    double distance;          /* from eye to at, unless the eye was given */
} framing_t;

/* The way from what is looked at to the eye, of any length. */
static void orbit_direction(const view_options_t *o, const double usual[3], double from[3]) {
    const double yaw = o->orbit[0] * 3.14159265358979323846 / 180.0, pitch = o->orbit[1] * 3.14159265358979323846 / 180.0;
    const double round[3] = {sin(yaw) * cos(pitch), sin(pitch), cos(yaw) * cos(pitch)};
    memcpy(from, o->has_orbit ? round : usual, sizeof round);
}

static void frame_model(framing_t *f, const view_options_t *o, const tuile_model_t *model, double aspect) {
    double distance[3];
    model_sphere(model, f->centre, &f->radius);
    if (o->has_sphere) {
        memcpy(f->centre, o->sphere_centre, sizeof f->centre);
        f->radius = o->sphere_radius;
    }
    f->fov = o->fov;
    memcpy(f->at, o->has_at ? o->at : f->centre, sizeof f->at);
    if (o->has_eye) {
        memcpy(f->eye, o->eye, sizeof f->eye);
    } else {
        /* Far enough back that the bounding sphere fits both ways, a little from the right and above. */
        const double half = f->fov * 3.14159265358979323846 / 360.0, across = atan(tan(half) * aspect);
        const double back = f->radius / sin(half < across ? half : across);
        static const double right_above[3] = {0.4, 0.3, 1.0};
        double from[3];
        orbit_direction(o, right_above, from);
        f->distance = o->has_orbit && o->orbit[2] > 0 ? o->orbit[2] : back;
        for (int i = 0; i < 3; i++) {
            f->eye[i] = f->at[i] + f->distance * from[i] / length3(from);
        }
    }
    for (int i = 0; i < 3; i++) {
        distance[i] = f->centre[i] - f->eye[i];
    }
    const double reach = length3(distance) + f->radius;
    f->far = o->has_far ? o->far : reach * 1.01;
    f->near = o->has_near ? o->near : fmax(length3(distance) - f->radius * 1.01, f->far / 1000.0);
}

/* World units are model units times a power of two that brings all distances close to 8192, so that q16_16_t neither overflows nor
 * wastes bits. */
static double world_unit(const framing_t *f) {
    double largest = fmax(fmax(fabs(f->near), fabs(f->far)), f->radius);
    int exponent;
    for (int i = 0; i < 3; i++) {
        largest = fmax(largest, fmax(fabs(f->eye[i]), fmax(fabs(f->at[i]), fabs(f->centre[i]) + f->radius)));
    }
    (void)frexp(largest, &exponent);
    return ldexp(1.0, 13 - exponent);
}

static int place_camera(view_t *view, const view_options_t *o, const framing_t *f, uint16_t width, uint16_t height,
                        sim_error_t *error) {
    tuile_camera_t *camera = &view->scene.camera;
    q16_16_t eye[3], at[3], up[3];
    const double up_length = length3(o->up);
    if (up_length == 0.0) { return sim_fail(error, "--up 0,0,0 is no direction"); }
    for (int i = 0; i < 3; i++) {
        eye[i] = to_q16(f->eye[i] * view->unit);
        at[i] = to_q16(f->at[i] * view->unit);
        up[i] = to_q16(o->up[i] / up_length * 16384.0);
    }
    if (o->has_orbit && !o->has_eye) {
        if (tuile_camera_orbit(camera, at, to_q16(f->distance * view->unit), to_bam16(o->orbit[0]), to_bam16(o->orbit[1]), 0) !=
            0) {
            return sim_fail(error, "--orbit: the distance is out of all proportion");
        }
    } else if (tuile_camera_look_at(camera, eye, at, up) != 0) {
        return sim_fail(error, "the camera looks nowhere: --eye and --at are the same point, or --up lies along the view");
    }
    const double near = f->near * view->unit, far = f->far * view->unit;
    camera->projection = o->has_ortho ? TUILE_ORTHOGRAPHIC : TUILE_PERSPECTIVE;
    const double focal =
        o->has_ortho ? height / (o->ortho * view->unit) : height / 2.0 / tan(f->fov * 3.14159265358979323846 / 360.0);
    camera->focal_x = to_q16(fmin(focal / o->pitch[0], 32767.0));
    camera->focal_y = to_q16(fmin(focal / o->pitch[1], 32767.0));
    camera->centre_x = o->has_centre ? to_q16(o->centre[0]) : (q16_16_t)width * 32768;
    camera->centre_y = o->has_centre ? to_q16(o->centre[1]) : (q16_16_t)height * 32768;
    camera->near = to_q16(near);
    camera->far = to_q16(far);
    if ((!o->has_ortho && camera->near <= 0) || camera->far <= camera->near) {
        return sim_fail(error,
                        "--near %g --far %g: near must be greater than 0 and less than far, and not millions of times smaller",
                        f->near, f->far);
    }
    if (camera->focal_x <= 0 || camera->focal_y <= 0 || focal / o->pitch[0] > 32767.0 || focal / o->pitch[1] > 32767.0) {
        return sim_fail(error, "%s: the picture would be magnified beyond what can be drawn", o->has_ortho ? "--ortho" : "--fov");
    }
    return 0;
}

static int place_light(view_t *view, const view_options_t *o, sim_error_t *error) {
    static const double over_the_shoulder[3] = {-0.4, -0.6, -1.0}; /* view space */
    double light[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            light[i] += view->scene.camera.rotation[k][i] / (double)TUILE_ONE_Q30 * over_the_shoulder[k];
        }
    }
    if (o->has_light) { memcpy(light, o->light, sizeof light); }
    const double length = length3(light);
    if (length == 0.0) { return sim_fail(error, "--light 0,0,0 is no direction"); }
    for (int i = 0; i < 3; i++) {
        view->light.direction[i] = (q2_14_t)lround(light[i] / length * 16384.0);
    }
    view->light.intensity = (uint8_t)lround(o->diffuse * 255.0);
    return 0;
}

int view_make(view_t *view, const view_options_t *options, const tuile_model_t *model, uint16_t width, uint16_t height,
              unsigned frames, sim_error_t *error) {
    framing_t framing;
    memset(view, 0, sizeof *view);
    frame_model(&framing, options, model, (double)width / height);
    view->unit = world_unit(&framing);
    for (int i = 0; i < 3; i++) {
        view->at[i] = framing.at[i] * view->unit;
        view->up[i] = options->up[i];
    }
    view->spin = options->has_spin ? options->spin : frames > 1 ? 360.0 / frames : 0.0;
    view->instance.model = model;
    view->instance.pose.scale = (tuile_scale_t){1, ilogb(view->unit)};
    view->scene.instances = &view->instance;
    view->scene.instance_count = 1;
    view->scene.lights = &view->light;
    view->scene.light_count = 1;
    view->scene.ambient = (uint8_t)lround(options->ambient * 255.0);
    memcpy(view->scene.background, options->background, 3);
    if (place_camera(view, options, &framing, width, height, error) != 0) { return -1; }
    view_frame(view, 0);
    return place_light(view, options, error);
}

void view_frame(view_t *view, unsigned frame) {
    /* Rodrigues' rotation about the unit vector u; whole turns are left out first, so that quarter turns come out exact. */
    const double degrees = fmod(view->spin * frame, 360.0), angle = degrees * 3.14159265358979323846 / 180.0;
    const double quarter = degrees / 90.0;
    double sine = sin(angle), cosine = cos(angle), u[3];
    if (quarter == floor(quarter)) {
        sine = round(sine);
        cosine = round(cosine);
    }
    const double length = length3(view->up);
    for (int i = 0; i < 3; i++) {
        u[i] = view->up[i] / length;
    }
    for (int i = 0; i < 3; i++) {
        double shifted = view->at[i];
        for (int j = 0; j < 3; j++) {
            const int k = 3 - i - j;
            const double cross = i == j ? 0.0 : ((j - i + 3) % 3 == 1 ? -1.0 : 1.0) * u[k];
            const double value = u[i] * u[j] * (1.0 - cosine) + (i == j ? cosine : 0.0) + cross * sine;
            view->instance.pose.rotation[i][j] = (q2_30_t)llround(value * (double)TUILE_ONE_Q30);
            shifted -= value * view->at[j];
        }
        view->instance.pose.translation[i] = to_q16(shifted);
    }
}
