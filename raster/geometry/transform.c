/* From pose and camera to integer rows, with a block exponent for each so that no bit is wasted whatever the units are.
 *
 * In perspective a window coordinate is X / W. Both rows are multiplied by one constant so that W = 65536 / 65528 * w / near:
 * then depth = 65536 / W needs no multiplication (Tuile's depth is 65528 at the near plane, which leaves room for rounding).
 *
 * Precision. Entries have 31 bits for the fast path and 14 more for the fine one: a fine value is exact to 2^-44 of the row's
 * largest value over the model, so that a ground plane of 60 000 units is still drawn right where it passes one unit below the eye.
 */
#include "transform.h"

#include "vertex_thumb.h"
#include "wide.h"

#include "../memory.h"

typedef struct wide_row {
    wide_t m[3], t;
} wide_row_t;

static wide_row_t row_scale(const wide_row_t *row, wide_t factor) {
    wide_row_t result;
    for (int i = 0; i < 3; i++) {
        result.m[i] = wide_multiply(row->m[i], factor);
    }
    result.t = wide_multiply(row->t, factor);
    return result;
}

static wide_row_t row_add(const wide_row_t *a, const wide_row_t *b) {
    wide_row_t result;
    for (int i = 0; i < 3; i++) {
        result.m[i] = wide_add(a->m[i], b->m[i]);
    }
    result.t = wide_add(a->t, b->t);
    return result;
}

static wide_t q16(q16_16_t value) { return wide_make(value, -16); }

/* view[i] = component i of the view position, as a function of the quantised position. */
static void view_rows(wide_row_t view[3], const tuile_camera_t *camera, const tuile_instance_t *instance) {
    const tuile_pose_t *pose = &instance->pose;
    const wide_t step = wide_multiply(wide_scale(instance->model->step), wide_scale(pose->scale));
    for (int i = 0; i < 3; i++) {
        view[i].t = (wide_t){0, 0};
        for (int j = 0; j < 3; j++) {
            int64_t sum = 0; /* Q4.60; the rows are unit vectors, so |sum| <= 2^60 but for rounding */
            for (int k = 0; k < 3; k++) {
                sum += (int64_t)camera->rotation[i][k] * pose->rotation[k][j];
            }
            view[i].m[j] = wide_multiply(wide_make(sum, -60), step);
            view[i].t = wide_add(view[i].t, wide_multiply(view[i].m[j], wide_make(instance->model->offset[j], 0)));
            const wide_t distance = wide_make((int64_t)pose->translation[j] - camera->eye[j], -16);
            view[i].t = wide_add(view[i].t, wide_multiply(wide_make(camera->rotation[i][j], -30), distance));
        }
    }
}

/* The largest exponent e such that row * 2^e keeps the bounds of transform_row_t. */
static int32_t row_exponent(const wide_row_t *row, const tuile_model_t *model) {
    wide_t centre = row->t, spread = {0, 0};
    int32_t bits = -32768;
    for (int i = 0; i < 3; i++) {
        centre = wide_add(centre, wide_multiply(row->m[i], wide_make(model->centre[i], 0)));
        spread = wide_add(spread, wide_abs(row->m[i]));
        if (wide_bits(row->m[i]) + 15 > bits) { bits = wide_bits(row->m[i]) + 15; }
    }
    const wide_t largest = wide_add(wide_abs(centre), wide_multiply(spread, wide_make((int64_t)model->radius + 1, 0)));
    if (wide_bits(largest) > bits) { bits = wide_bits(largest); }
    if (bits < -1000) { bits = -1000; }
    return 45 - bits; /* one bit to spare for rounding */
}

static void row_store(transform_row_t *out, const wide_row_t *row, int32_t exponent) {
    for (int i = 0; i < 3; i++) {
        const int64_t exact = wide_to_integer(row->m[i], exponent + 14);
        out->m[i] = (int32_t)((exact + (1 << 13)) >> 14);
        out->low[i] = (int16_t)(exact - (int64_t)out->m[i] * (1 << 14));
    }
    out->t = wide_to_integer(row->t, exponent);
}

#define ROW_SLACK 4 /* by how much rounding may have moved a fine value */

static void plane_store(transform_plane_t *plane, const wide_row_t *row) {
    int32_t bits = -32768;
    uint64_t squares = 0;
    for (int i = 0; i < 3; i++) {
        if (wide_bits(row->m[i]) > bits) { bits = wide_bits(row->m[i]); }
    }
    if (bits < -1000) { bits = -1000; }
    for (int i = 0; i < 3; i++) {
        plane->n[i] = (int32_t)wide_to_integer(row->m[i], 24 - bits);
        squares += (uint64_t)((int64_t)plane->n[i] * plane->n[i]);
    }
    /* The roundings above are off by at most 3 * 2^15 * 1/2 for any int16 position, and a vertex between two key frames lies up to
     * 1/256 step along each axis from its place, 3 * 2^24 / 256: the plane moves out by more than both. */
    plane->d = wide_to_integer(row->t, 24 - bits);
    if (plane->d < ((int64_t)1 << 61)) { plane->d += INT32_C(1) << 18; }
    plane->length = fixed_sqrt64(squares) + 1;
}

static void light_vectors(transform_t *transform, const tuile_scene_t *scene, const tuile_instance_t *instance) {
    transform->light_count = scene->light_count;
    transform->ambient = scene->ambient < LIGHT_MIN ? LIGHT_MIN : scene->ambient;
    transform->two_sided = instance->two_sided;
    for (int l = 0; l < scene->light_count; l++) {
        for (int j = 0; j < 3; j++) {
            int64_t sum = 0; /* Q.44; |sum| < 2^46 even for careless unit vectors */
            for (int k = 0; k < 3; k++) {
                sum -= (int64_t)instance->pose.rotation[k][j] * scene->lights[l].direction[k];
            }
            /* normal (127 = 1) . light >> 13 = intensity at full incidence: light = intensity * 2^13 / 127 */
            const int64_t value = ((sum >> 14) * scene->lights[l].intensity * 8192 / 127 + (INT32_C(1) << 29)) >> 30;
            transform->lights[l][j] = (int16_t)(value > 16512 ? 16512 : value < -16512 ? -16512 : value);
        }
    }
}

/* The eye in the space of the quantised positions: the point whose view coordinates vanish; rotation matrices are inverted by
 * transposing. */
static void eye_position(transform_t *transform, const tuile_camera_t *camera, const tuile_instance_t *instance) {
    const tuile_pose_t *pose = &instance->pose;
    const wide_t per_step = wide_reciprocal(wide_multiply(wide_scale(instance->model->step), wide_scale(pose->scale)));
    wide_t eye[3];
    int32_t bits = 0;
    for (int j = 0; j < 3; j++) {
        wide_t sum = {0, 0};
        for (int k = 0; k < 3; k++) {
            sum = wide_add(sum, wide_multiply(wide_make(pose->rotation[k][j], -30),
                                              wide_make((int64_t)camera->eye[k] - pose->translation[k], -16)));
        }
        eye[j] = wide_add(wide_multiply(sum, per_step), wide_make(-(int64_t)instance->model->offset[j], 0));
        if (wide_bits(eye[j]) > bits) { bits = wide_bits(eye[j]); }
    }
    transform->observer_bits = (int16_t)(bits < 15 ? 14 : 29 - bits);
    for (int j = 0; j < 3; j++) {
        transform->observer[j] = (int32_t)wide_to_integer(eye[j], transform->observer_bits);
    }
    if (bits > 20 + 31) {
        transform->cones = false;
        return;
    }
    transform->eye_shift = (uint8_t)(bits > 20 ? bits - 20 : 0);
    for (int j = 0; j < 3; j++) {
        transform->eye[j] = (int32_t)wide_to_integer(eye[j], -(int32_t)transform->eye_shift);
    }
}

static void view_direction(transform_t *transform, const tuile_camera_t *camera, const tuile_instance_t *instance) {
    transform->eye_shift = 0;
    for (int j = 0; j < 3; j++) {
        int64_t sum = 0; /* -third row of the view rotation times the pose's, Q4.60 */
        for (int k = 0; k < 3; k++) {
            sum -= (int64_t)camera->rotation[2][k] * instance->pose.rotation[k][j];
        }
        transform->eye[j] = (int32_t)(sum >> 40);
        transform->observer[j] = -(int32_t)(sum >> 32);
    }
}

/* Do the rotations of pose and camera together turn the world inside out? */
static bool mirrored(const tuile_scene_t *scene, const tuile_instance_t *instance) {
    const q2_30_t(*m[2])[3] = {scene->camera.rotation, instance->pose.rotation};
    bool odd = false;
    for (int i = 0; i < 2; i++) {
        int64_t r[3][3], determinant = 0;
        for (int j = 0; j < 9; j++) {
            r[j / 3][j % 3] = m[i][j / 3][j % 3] >> 12; /* <= 2^18 */
        }
        for (int j = 0; j < 3; j++) {
            determinant += r[0][j] * (r[1][(j + 1) % 3] * r[2][(j + 2) % 3] - r[1][(j + 2) % 3] * r[2][(j + 1) % 3]);
        }
        odd ^= determinant < 0;
    }
    return odd;
}

int transform_check(const tuile_scene_t *scene, const tuile_instance_t *instance) {
    const tuile_camera_t *camera = &scene->camera;
    if (instance->model == NULL || instance->pose.scale.mantissa == 0 || instance->pose.scale.exponent < -1000 ||
        instance->pose.scale.exponent > 1000 || scene->light_count > TRANSFORM_LIGHTS_MAX) {
        return TUILE_ERROR_ARGUMENT;
    }
    if (camera->focal_x <= 0 || camera->focal_y <= 0 || camera->far <= camera->near || camera->projection > TUILE_ORTHOGRAPHIC ||
        (camera->projection == TUILE_PERSPECTIVE && camera->near <= 0)) {
        return TUILE_ERROR_CAMERA;
    }
    return TUILE_OK;
}

static int perspective_rows(transform_t *transform, const tuile_camera_t *camera, const tuile_model_t *model,
                            const wide_row_t view[3]) {
    const wide_t near = q16(camera->near);
    const wide_t factor =
        wide_multiply(wide_reciprocal(near), wide_multiply(wide_make(65536, 0), wide_reciprocal(wide_make(65528, 0))));
    wide_row_t w = row_scale(&view[2], wide_negate(factor));
    wide_row_t x = row_scale(&view[0], wide_multiply(q16(camera->focal_x), factor));
    wide_row_t y = row_scale(&view[1], wide_negate(wide_multiply(q16(camera->focal_y), factor)));
    const wide_row_t x_centre = row_scale(&w, q16(camera->centre_x)), y_centre = row_scale(&w, q16(camera->centre_y));
    x = row_add(&x, &x_centre);
    y = row_add(&y, &y_centre);

    const int32_t ex = row_exponent(&x, model), ey = row_exponent(&y, model);
    int32_t ew = row_exponent(&w, model), exy = ex < ey ? ex : ey;
    if (ew > 45) { ew = 45; } /* W = 1 is the near plane: nothing is gained beyond, the whole model lies before it */
    if (exy > ew + 4) { exy = ew + 4; }
    row_store(&transform->x, &x, exy);
    row_store(&transform->y, &y, exy);
    row_store(&transform->w, &w, ew);
    const int32_t k = 4 + ew - exy;
    if (k > 32 || ew < 23) { return TUILE_ERROR_RANGE; } /* the model reaches 2^22 times farther than the near plane */
    transform->k = (int8_t)k;
    transform->depth_shift = (int8_t)(54 - ew);
    /* A vertex that lies in the near or far plane is inside, whatever rounding says. */
    transform->w_low = wide_to_integer(wide_multiply(near, factor), ew) - ROW_SLACK;
    transform->w_high = wide_to_integer(wide_multiply(q16(camera->far), factor), ew) + ROW_SLACK;
    const int64_t limit = ((int64_t)1 << 46) - 1;
    if (transform->w_high > limit) { transform->w_high = limit; }
    /* From 2^(k + 5) on, a coarse unit of X is worth 1/32 unit of the window; from 2^20 on, one of W 1/16 depth step. */
    int32_t fast = k + 5 > 20 ? k + 5 : 20;
    transform->w_fast = fast < 30 ? (int32_t)1 << fast : INT32_MAX;
    const int64_t at_near = wide_to_integer(wide_multiply(near, factor), ew - 16);
    if (transform->w_fast <= at_near + 2) { transform->w_fast = (int32_t)at_near + 3; }
    return TUILE_OK;
}

static int orthographic_rows(transform_t *transform, const tuile_camera_t *camera, const tuile_model_t *model,
                             const wide_row_t view[3]) {
    wide_row_t x = row_scale(&view[0], q16(camera->focal_x)), y = row_scale(&view[1], wide_negate(q16(camera->focal_y)));
    x.t = wide_add(x.t, q16(camera->centre_x));
    y.t = wide_add(y.t, q16(camera->centre_y));
    /* depth = 8 + 65520 * (far - distance) / (far - near), distance = -view z */
    const wide_t per_unit =
        wide_multiply(wide_make(65520, 0), wide_reciprocal(wide_make((int64_t)camera->far - camera->near, -16)));
    wide_row_t depth = row_scale(&view[2], per_unit);
    depth.t = wide_add(depth.t, wide_add(wide_make(8, 0), wide_multiply(q16(camera->far), per_unit)));

    const int32_t ex = row_exponent(&x, model), ey = row_exponent(&y, model), exy = ex < ey ? ex : ey;
    int32_t ew = row_exponent(&depth, model);
    const int32_t finest = exy < 40 ? exy : 40;
    if (ew > 28) { ew = 28; } /* depths are below 2^17 between the planes, and w_high stays below 2^46 */
    if (finest < 5 || ew < 9) { return TUILE_ERROR_RANGE; }
    row_store(&transform->x, &x, finest);
    row_store(&transform->y, &y, finest);
    row_store(&transform->w, &depth, ew);
    transform->k = (int8_t)(4 - finest);
    transform->depth_shift = (int8_t)(ew - 8);
    /* Half a depth step of room: a face that lies in the far or near plane is not clipped away by a rounding. */
    transform->w_low = fixed_shift_left64(15, (unsigned)(ew - 1));
    transform->w_high = fixed_shift_left64(2 * 65528 + 1, (unsigned)(ew - 1));
    return TUILE_OK;
}

/* The sum of |m[i]| / 2^16, rounded up. */
static uint32_t slope(const transform_row_t *row) {
    uint64_t sum = UINT16_MAX;
    for (int i = 0; i < 3; i++) {
        sum += (uint32_t)(row->m[i] < 0 ? -row->m[i] : row->m[i]);
    }
    return (uint32_t)(sum >> 16);
}

int transform_make(transform_t *transform, const tuile_scene_t *scene, const tuile_instance_t *instance, uint16_t window_width,
                   uint16_t window_height) {
    const tuile_camera_t *camera = &scene->camera;
    wide_row_t view[3];
    int error = transform_check(scene, instance);
    if (error) { return error; }

    memset(transform, 0, sizeof *transform);
    view_rows(view, camera, instance);
    transform->perspective = camera->projection == TUILE_PERSPECTIVE;
    transform->guard_x = (window_width * 16 - GUARD_SPAN) / 2;
    transform->guard_y = (window_height * 16 - GUARD_SPAN) / 2;
    error = transform->perspective ? perspective_rows(transform, camera, instance->model, view)
                                   : orthographic_rows(transform, camera, instance->model, view);
    if (error) { return error; }
    transform->w_slope = slope(&transform->w);
    light_vectors(transform, scene, instance);
    transform->mirrored = mirrored(scene, instance);
    transform->cones = !instance->two_sided;
    if (transform->perspective) {
        eye_position(transform, camera, instance);
    } else {
        view_direction(transform, camera, instance);
    }
    return TUILE_OK;
}

/* row as a wide row again, in its own fine units. */
static wide_row_t row_load(const transform_row_t *row) {
    wide_row_t result;
    for (int i = 0; i < 3; i++) {
        result.m[i] = wide_make(row->m[i], 0);
    }
    result.t = wide_make(row->t, 0);
    return result;
}

/* sign * (row - bound * w) >= 0 as a plane; bound in pixels. */
static void side_plane(const transform_t *transform, transform_plane_t *plane, const transform_row_t *row, int32_t bound_px,
                       int sign) {
    wide_row_t a = row_load(row);
    const wide_t bound = wide_make((int64_t)bound_px * -16, -transform->k); /* in fine units of row per unit of w */
    if (transform->perspective) {
        const wide_row_t w = row_load(&transform->w), edge = row_scale(&w, bound);
        a = row_add(&a, &edge);
    } else {
        a.t = wide_add(a.t, bound);
    }
    if (sign < 0) { a = row_scale(&a, wide_make(-1, 0)); }
    plane_store(plane, &a);
}

void transform_region(transform_t *transform, const transform_region_t *region) {
    wide_row_t w = row_load(&transform->w);
    transform->crossed = PLANE_COUNT;
    const wide_t low = wide_make(-transform->w_low, 0), high = wide_make(transform->w_high, 0);
    wide_row_t plane = w;
    /* Where the first pixel whose centre is at or beyond a coordinate is left ... right, top ... bottom. */
    transform->region_x = (int16_t)(16 * region->left - 7); /* below 2^15: TUILE_SAMPLES_MAX */
    transform->region_y = (int16_t)(16 * region->top - 7);
    transform->region_width = (uint16_t)(16 * (region->right - region->left + 1));
    transform->region_height = (uint16_t)(16 * (region->bottom - region->top + 1));
    if (ASSEMBLY_VERTICES) { vertex_thumb_make(transform); }
    plane.t = wide_add(plane.t, low);
    plane_store(&transform->planes[PLANE_NEAR], &plane);
    plane = row_scale(&w, wide_make(-1, 0));
    plane.t = wide_add(plane.t, high);
    plane_store(&transform->planes[PLANE_FAR], &plane);
    /* One pixel more on each side: snapping may move a vertex by half a sixteenth. */
    side_plane(transform, &transform->planes[PLANE_LEFT], &transform->x, region->left - 1, 1);
    side_plane(transform, &transform->planes[PLANE_RIGHT], &transform->x, region->right + 1, -1);
    side_plane(transform, &transform->planes[PLANE_TOP], &transform->y, region->top - 1, 1);
    side_plane(transform, &transform->planes[PLANE_BOTTOM], &transform->y, region->bottom + 1, -1);
}
