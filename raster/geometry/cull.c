/* The cone test.
 *
 * A face with outward normal n through p faces away from the eye e when dot(p - e, n) >= 0. Let all normals of a cluster lie within
 * an angle alpha < 90 degrees of the axis a, and all points within radius r of the centre c. For v = c - e the direction v leaves
 * every such n on the far side when angle(v, a) <= 90 - alpha, that is dot(v, a) >= sin(alpha) |v| |a|; and moving from c to any
 * point of the sphere changes dot(v, n) by r at most, which the term r |a| covers, with 128 for |a| there. The cutoff in the model
 * is sin(alpha), rounded up.
 *
 * In integers: dot - r |a| >= (cutoff / 254) |a| |v|, both sides squared once the left one is known to be positive. |v| has 22 bits
 * a component, so the squares stay below 2^62.
 */
#include "cull.h"

#include "../divide.h"
#include "model.h"
#include "wide.h"

#define AXIS_LENGTH_MAX 128 /* axes are about 127 long; one that were longer would cull nothing */

/* Products by halves are long: once only. */
#if FIXED_BY_HALVES
#define PLANE_INLINE static TUILE_NOINLINE
#else
#define PLANE_INLINE TUILE_INLINE
#endif

/* How far inside of a plane a point is, times the plane's length. */
PLANE_INLINE int64_t plane_value(const transform_plane_t *plane, const int16_t at[3]) {
    if (!FIXED_BY_HALVES) {
        return (int64_t)plane->n[0] * at[0] + (int64_t)plane->n[1] * at[1] + (int64_t)plane->n[2] * at[2] + plane->d;
    }
    int32_t high = 0, low = 0; /* of 10 and 14 bits by 16 */
    for (int i = 0; i < 3; i++) {
        high += (plane->n[i] >> 14) * at[i];
        low += (plane->n[i] & 0x3fff) * at[i];
    }
    return fixed_shift_left64(high, 14) + low + plane->d;
}

bool cull_outside(const transform_t *transform, const uint8_t *cluster) {
    const transform_plane_t *plane = transform->planes, *const end = plane + transform->crossed;
    if (plane == end) { return false; }
    const int16_t centre[3] = {model_i16(cluster + CLUSTER_AT_CENTRE), model_i16(cluster + CLUSTER_AT_CENTRE + 2),
                               model_i16(cluster + CLUSTER_AT_CENTRE + 4)};
    const uint32_t radius = model_u16(cluster + CLUSTER_AT_RADIUS);
    for (; plane != end; plane++) {
        if (plane_value(plane, centre) + (int64_t)fixed_mul_part(plane->length, radius) < 0) { return true; }
    }
    return false;
}

bool cull_model_outside(transform_t *transform, const tuile_model_t *model) {
    bool outside = false;
    transform->crossed = 0;
    for (unsigned i = 0; i < PLANE_COUNT; i++) {
        const transform_plane_t plane = transform->planes[i];
        const int64_t value = plane_value(&plane, model->centre), reach = (int64_t)fixed_mul_part(plane.length, model->radius);
        outside |= value + reach < 0;
        if (value - reach >= 0) { continue; }
        transform->planes[i] = transform->planes[transform->crossed];
        transform->planes[transform->crossed++] = plane;
    }
    return outside;
}

/* ---- whole instances ---- */

typedef struct view_sphere {
    int64_t at[3], radius; /* view space, Q.16; |at| < 2^33, radius < 2^32 */
} view_sphere_t;

/* False when it is too far away or too large for the arithmetic here. The radius holds all roundings: half a unit for each axis in
 * the world, one for each in view space. */
static bool view_sphere(view_sphere_t *sphere, const tuile_camera_t *camera, const tuile_instance_t *instance) {
    const tuile_model_t *model = instance->model;
    const tuile_pose_t *pose = &instance->pose;
    const wide_t step = wide_multiply(wide_scale(model->step), wide_scale(pose->scale));
    int64_t way[3];
    for (int i = 0; i < 3; i++) {
        int64_t sum = 0; /* Q.30; |sum| < 3 * 2^61 */
        for (int j = 0; j < 3; j++) {
            sum += pose->rotation[i][j] * ((int64_t)model->offset[j] + model->centre[j]);
        }
        way[i] = wide_to_integer(wide_multiply(wide_make(sum, -30), step), 16) + pose->translation[i] - camera->eye[i];
        if (way[i] > INT32_MAX || way[i] < INT32_MIN) { return false; }
    }
    for (int i = 0; i < 3; i++) {
        int64_t sum = 0; /* |sum| < 3 * 2^61 */
        for (int j = 0; j < 3; j++) {
            sum += camera->rotation[i][j] * way[j];
        }
        sphere->at[i] = sum >> 30;
    }
    sphere->radius = wide_to_integer(wide_multiply(wide_make((int64_t)model->radius + 1, 0), step), 16) + 8;
    return sphere->radius < ((int64_t)1 << 32);
}

static int64_t magnitude(int64_t a) { return a < 0 ? -a : a; }

/* Does the sphere lie wholly where focal * x + room * w < 0? x: sideways, w: along the view; room: Q.16 pixels. Orthographic: where
 * focal * x + room < 0. Factors are cut to 24 bits, so a product is off by its coordinate. The length of a normal (a, b) is at most
 * the larger of both and half the smaller. */
static bool beyond_side(const view_sphere_t *sphere, bool perspective, q16_16_t focal, int64_t x, int64_t room) {
    const int64_t w = -sphere->at[2], a = focal >> 8, b = room >> 8;
    if (!perspective) { return a * x + room * 256 + sphere->radius * (a + 2) + magnitude(x) < 0; }
    const int64_t size = magnitude(b), length = a > size ? a + size / 2 : size + a / 2;
    return a * x + b * w + sphere->radius * (length + 3) + magnitude(x) + magnitude(w) < 0;
}

bool cull_instance_outside(const tuile_camera_t *camera, const tuile_instance_t *instance, const transform_region_t *region) {
    const bool perspective = camera->projection == TUILE_PERSPECTIVE;
    view_sphere_t sphere;
    if (!view_sphere(&sphere, camera, instance)) { return false; }
    const int64_t x = sphere.at[0], y = sphere.at[1], w = -sphere.at[2], one = 65536;
    /* One pixel more on each side: snapping may move a vertex by half a sixteenth. */
    return w + sphere.radius < camera->near || w - sphere.radius > camera->far ||
           beyond_side(&sphere, perspective, camera->focal_x, x, camera->centre_x - (region->left - 1) * one) ||
           beyond_side(&sphere, perspective, camera->focal_x, -x, (region->right + 1) * one - camera->centre_x) ||
           beyond_side(&sphere, perspective, camera->focal_y, -y, camera->centre_y - (region->top - 1) * one) ||
           beyond_side(&sphere, perspective, camera->focal_y, y, (region->bottom + 1) * one - camera->centre_y);
}

/* ---- faces that are turned away ---- */

/* x^2 + y^2 + z^2, of 22 bits and a sign each. By halves of 11 bits sums fit in words. */
TUILE_INLINE uint64_t sum_of_squares(int32_t x, int32_t y, int32_t z) {
    if (!FIXED_BY_HALVES) { return (uint64_t)((int64_t)x * x + (int64_t)y * y + (int64_t)z * z); }
    const int32_t xh = x >> 11, yh = y >> 11, zh = z >> 11, xl = x & 0x7ff, yl = y & 0x7ff, zl = z & 0x7ff;
    const int32_t across = xh * xl + yh * yl + zh * zl;
    return ((uint64_t)(uint32_t)(xh * xh + yh * yh + zh * zh) << 22) + (uint64_t)fixed_shift_left64(across, 12) +
           (uint32_t)(xl * xl + yl * yl + zl * zl);
}

/* n / 64516, rounded up, n <= 64516 * 2^14. Without long products by the upper half: 2^16 / 64516 = 1 + 1036.1 / 2^16. */
TUILE_INLINE uint32_t divide_cutoff(uint32_t n) {
    n += 64515u;
    if (!FIXED_BY_HALVES) { return n / 64516u; }
    const uint32_t high = n >> 16, quotient = high + (high * 1036u >> 16);
    return divide_settle(quotient, (int32_t)(n - quotient * 64516u), 64516);
}

bool cull_faces_away(const transform_t *transform, const uint8_t *cluster) {
    const uint32_t cutoff = cluster[CLUSTER_AT_CUTOFF];
    const int32_t ax = (int8_t)cluster[CLUSTER_AT_AXIS], ay = (int8_t)cluster[CLUSTER_AT_AXIS + 1],
                  az = (int8_t)cluster[CLUSTER_AT_AXIS + 2];
    const unsigned shift = transform->eye_shift;
    int32_t x = transform->eye[0], y = transform->eye[1], z = transform->eye[2];
    int32_t room = 0; /* what the cluster's size takes of the product */
    if (cutoff == 255 || !transform->cones) { return false; }
    if (transform->perspective) {
        x = (model_i16(cluster + CLUSTER_AT_CENTRE) >> shift) - x;
        y = (model_i16(cluster + CLUSTER_AT_CENTRE + 2) >> shift) - y;
        z = (model_i16(cluster + CLUSTER_AT_CENTRE + 4) >> shift) - z;
        /* What the shifts cut off is below 2 in each component and in the radius. */
        room = ((model_u16(cluster + CLUSTER_AT_RADIUS) >> shift) + (shift ? 8 : 1)) * AXIS_LENGTH_MAX; /* < 2^24 */
    }
    int32_t dot = ax * x + ay * y + az * z;  /* |x|, |y|, |z| < 2^22: below 3 * 2^29 */
    if (transform->mirrored) { dot = -dot; } /* the faces that look at the eye are the back faces */
    dot -= room;
    const uint32_t axis_squares = (uint32_t)(ax * ax + ay * ay + az * az);
    if (dot < 0 || axis_squares > AXIS_LENGTH_MAX * AXIS_LENGTH_MAX) { return false; }
    const uint32_t scaled = divide_cutoff(cutoff * cutoff * axis_squares); /* (cutoff / 254)^2 |a|^2, rounded up; <= 2^14 */
    return (uint64_t)fixed_mul_wide(dot, dot) >= fixed_mul_part(sum_of_squares(x, y, z), scaled);
}
