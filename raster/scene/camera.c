#include "camera.h"

#include "rotation.h"

/* at = from + distance * direction, rounded; direction: Q2.30, a unit vector. */
static bool move(q16_16_t at[3], const q16_16_t from[3], q16_16_t distance, const q2_30_t direction[3]) {
    for (int i = 0; i < 3; i++) {
        const int64_t moved = from[i] + (((int64_t)distance * direction[i] + (INT32_C(1) << 29)) >> 30);
        if (moved > INT32_MAX || moved < INT32_MIN) { return false; }
        at[i] = (q16_16_t)moved;
    }
    return true;
}

static void transpose(q2_30_t out[3][3], const q2_30_t in[3][3]) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = in[j][i];
        }
    }
}

int tuile_camera_orbit(tuile_camera_t *camera, const q16_16_t target[3], q16_16_t distance, bam16_t yaw, bam16_t pitch,
                       bam16_t roll) {
    q2_30_t about[3][3], turned[3][3], tilted[3][3];
    q16_16_t eye[3];
    if (distance <= 0) { return TUILE_ERROR_CAMERA; }
    tuile_rotation(turned, 1, yaw);
    tuile_rotation(about, 0, (bam16_t)-pitch);
    (void)rotation_multiply(tilted, turned, (const q2_30_t(*)[3])about);
    tuile_rotation(about, 2, roll);
    (void)rotation_multiply(turned, (const q2_30_t(*)[3])tilted, (const q2_30_t(*)[3])about);
    const q2_30_t back[3] = {turned[0][2], turned[1][2], turned[2][2]};
    if (!move(eye, target, distance, back)) { return TUILE_ERROR_RANGE; }
    transpose(camera->rotation, (const q2_30_t(*)[3])turned);
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = eye[i];
    }
    return TUILE_OK;
}

int tuile_camera_attach(tuile_camera_t *camera, const tuile_pose_t *world) {
    if (!rotation_is_unit(world->rotation)) { return TUILE_ERROR_CAMERA; }
    transpose(camera->rotation, world->rotation);
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = world->translation[i];
    }
    return TUILE_OK;
}

/* What of a window of size_px lies on the narrower side of the principal point, in pixels. */
static int64_t narrower(q16_16_t centre, uint16_t size_px) {
    const int64_t rest = (int64_t)size_px * 65536 - centre;
    return centre < rest ? centre : rest;
}

/* The least distance at which a sphere fits into `half` pixels on each side: r / sin a for tan a = half / focal, rounded up.
 * (2^32 + 1) * 2^31 fits 64 bits. */
static uint64_t distance_for(q16_16_t radius, q16_16_t focal, int64_t half) {
    const uint64_t square = (uint64_t)((int64_t)focal * focal) + (uint64_t)(half * half);
    return ((uint64_t)radius * (fixed_sqrt64(square) + (uint64_t)1)) / (uint64_t)half + 1;
}

static int fit_orthographic(tuile_camera_t *camera, q16_16_t radius, int64_t half_x, int64_t half_y) {
    /* The factor that makes radius * focal as large as half: the smaller of the two, rounded down. */
    const wide_t r = wide_make(radius, -16);
    const wide_t x = wide_multiply(wide_make(half_x, 0), wide_reciprocal(wide_multiply(r, wide_make(camera->focal_x, 0))));
    const wide_t y = wide_multiply(wide_make(half_y, 0), wide_reciprocal(wide_multiply(r, wide_make(camera->focal_y, 0))));
    const wide_t factor = wide_sign(wide_add(x, wide_negate(y))) < 0 ? x : y;
    const int64_t focal_x = wide_to_integer(wide_multiply(factor, wide_make(camera->focal_x, 0)), 0) - 1;
    const int64_t focal_y = wide_to_integer(wide_multiply(factor, wide_make(camera->focal_y, 0)), 0) - 1;
    if (focal_x <= 0 || focal_y <= 0 || focal_x > INT32_MAX || focal_y > INT32_MAX) { return TUILE_ERROR_RANGE; }
    camera->focal_x = (q16_16_t)focal_x;
    camera->focal_y = (q16_16_t)focal_y;
    return TUILE_OK;
}

int tuile_camera_fit(tuile_camera_t *camera, const tuile_sphere_t *sphere, uint16_t width, uint16_t height) {
    const int64_t half_x = narrower(camera->centre_x, width), half_y = narrower(camera->centre_y, height);
    const q16_16_t radius = sphere->radius;
    tuile_camera_t made = *camera;
    if (radius <= 0 || camera->focal_x <= 0 || camera->focal_y <= 0 || half_x <= 0 || half_y <= 0 ||
        !rotation_is_unit(camera->rotation)) {
        return TUILE_ERROR_CAMERA;
    }
    uint64_t distance = 2 * (uint64_t)radius;
    if (camera->projection == TUILE_ORTHOGRAPHIC) {
        const int error = fit_orthographic(&made, radius, half_x, half_y);
        if (error) { return error; }
    } else {
        const uint64_t x = distance_for(radius, camera->focal_x, half_x), y = distance_for(radius, camera->focal_y, half_y);
        distance = x > y ? x : y;
    }
    const uint64_t slack = (uint64_t)radius / 1024 + 2, far = distance + (uint64_t)radius + slack;
    if (far > INT32_MAX) { return TUILE_ERROR_RANGE; }
    if (!move(made.eye, sphere->centre, (q16_16_t)distance, camera->rotation[2])) { return TUILE_ERROR_RANGE; }
    /* Very wide views come closer than the slack: half way to the sphere then. */
    const int64_t gap = (int64_t)distance - radius, near = gap - (int64_t)slack, least = gap / 2 + 1;
    made.near = (q16_16_t)(near > least ? near : least);
    made.far = (q16_16_t)far;
    *camera = made;
    return TUILE_OK;
}
