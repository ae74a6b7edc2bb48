/* Picking (S3): the visible face by drawing one pixel, the point on it by intersecting the pixel's ray with the face's plane. */
#include "../geometry/morph.h"
#include "../geometry/wide.h"
#include "frame.h"

typedef struct ray {
    wide_t from[3], along[3]; /* in steps, relative to the model's offset */
} ray_t;

/* Rotation matrices are inverted by transposing. */
static void rotate_back(wide_t out[3], const q2_30_t rotation[3][3], const wide_t in[3]) {
    for (int j = 0; j < 3; j++) {
        wide_t sum = {0, 0};
        for (int k = 0; k < 3; k++) {
            sum = wide_add(sum, wide_multiply(wide_make(rotation[k][j], -30), in[k]));
        }
        out[j] = sum;
    }
}

static void pixel_ray(ray_t *ray, const tuile_camera_t *camera, const tuile_instance_t *instance, uint16_t x, uint16_t y) {
    const tuile_pose_t *pose = &instance->pose;
    const tuile_model_t *model = instance->model;
    const wide_t step = wide_multiply(wide_scale(model->step), wide_scale(pose->scale));
    const wide_t per_step = wide_reciprocal(step);
    const wide_t across = wide_multiply(wide_make((int64_t)x * 65536 + 32768 - camera->centre_x, -16),
                                        wide_reciprocal(wide_make(camera->focal_x, -16)));
    const wide_t down = wide_multiply(wide_make((int64_t)y * 65536 + 32768 - camera->centre_y, -16),
                                      wide_reciprocal(wide_make(camera->focal_y, -16)));
    const wide_t ahead = wide_make(-1, 0), nothing = {0, 0};
    const bool perspective = camera->projection == TUILE_PERSPECTIVE;
    const wide_t view_along[3] = {perspective ? across : nothing, perspective ? wide_negate(down) : nothing, ahead};
    const wide_t view_from[3] = {perspective ? nothing : across, perspective ? nothing : wide_negate(down), nothing};
    wide_t world[3] = {{0, 0}}, local[3] = {{0, 0}};

    rotate_back(world, camera->rotation, view_along);
    rotate_back(ray->along, pose->rotation, world);
    rotate_back(world, camera->rotation, view_from);
    for (int i = 0; i < 3; i++) {
        world[i] = wide_add(world[i], wide_make((int64_t)camera->eye[i] - pose->translation[i], -16));
    }
    rotate_back(local, pose->rotation, world);
    for (int i = 0; i < 3; i++) {
        ray->from[i] = wide_add(wide_multiply(local[i], per_step), wide_make(-(int64_t)model->offset[i], 0));
    }
}

/* A face's corners, found by walking its cluster: their numbers from first_vertex on. Returns how many. */
static unsigned face_corners(const tuile_model_t *model, uint32_t face, const uint8_t **corners, uint32_t *first_vertex) {
    uint32_t low = 0, high = model->cluster_count;
    while (high - low > 1) {
        const uint32_t mid = low + (high - low) / 2;
        if (model_u32(model->clusters + (size_t)mid * MODEL_CLUSTER_BYTES + CLUSTER_AT_FIRST_FACE) <= face) {
            low = mid;
        } else {
            high = mid;
        }
    }
    const uint8_t *cluster = model->clusters + (size_t)low * MODEL_CLUSTER_BYTES;
    const uint8_t *at = model->faces + model_u32(cluster + CLUSTER_AT_FACE_BYTES);
    uint32_t skip = face - model_u32(cluster + CLUSTER_AT_FIRST_FACE);
    *first_vertex = model_u32(cluster + CLUSTER_AT_FIRST_VERTEX);
    if (cluster[CLUSTER_AT_KIND] == MODEL_CLUSTER_TRIANGLES) {
        *corners = at + 4 * (size_t)skip;
        return 3;
    }
    for (; skip; skip--) {
        at += MODEL_POLYGON_BYTES(at[0]);
    }
    *corners = at + 3;
    return at[0];
}

/* In 1/256 step. */
static void corner_position(const tuile_instance_t *instance, uint32_t vertex, int32_t position[3]) {
    const tuile_model_t *model = instance->model;
    for (unsigned a = 0; a < 3; a++) {
        const size_t at = 6 * (size_t)vertex + 2 * a;
        const int8_t fraction = model->fractions ? (int8_t)model->fractions[3 * (size_t)vertex + a] : 0;
        const int16_t from = model_i16(model->positions + at);
        const int16_t to = model->morph_positions ? model_i16(model->morph_positions + at) : from;
        position[a] = morph_coordinate(from, to, fraction, instance->morph);
    }
}

static void face_plane(const tuile_instance_t *instance, uint32_t face, wide_t normal[3], wide_t point[3]) {
    const tuile_model_t *model = instance->model;
    const uint8_t *corners;
    uint32_t first;
    const unsigned count = face_corners(model, face, &corners, &first);
    int64_t sum[3] = {0, 0, 0};
    for (unsigned i = 0; i < count; i++) { /* Newell: components below 255 * 2^49 */
        int32_t p[3], q[3];
        corner_position(instance, first + corners[i], p);
        corner_position(instance, first + corners[(i + 1) % count], q);
        for (unsigned a = 0; a < 3 && i == 0; a++) {
            point[a] = wide_make(p[a], -8);
        }
        for (unsigned a = 0; a < 3; a++) {
            const unsigned b = (a + 1) % 3, c = (a + 2) % 3;
            sum[a] += (int64_t)(p[b] - q[b]) * (p[c] + q[c]);
        }
    }
    for (int a = 0; a < 3; a++) {
        normal[a] = wide_make(sum[a], 0);
    }
}

static void intersect(const tuile_scene_t *scene, tuile_hit_t *hit, uint16_t x, uint16_t y) {
    const tuile_instance_t *instance = &scene->instances[hit->instance];
    ray_t ray;
    wide_t normal[3], point[3] = {{0, 0}}, between[3];
    pixel_ray(&ray, &scene->camera, instance, x, y);
    face_plane(instance, hit->face, normal, point);
    for (int i = 0; i < 3; i++) {
        between[i] = wide_add(point[i], wide_negate(ray.from[i]));
    }
    const wide_t slope = wide_dot(normal, ray.along);
    const wide_t distance = wide_sign(slope) ? wide_multiply(wide_dot(normal, between), wide_reciprocal(slope)) : (wide_t){0, 0};
    for (int i = 0; i < 3; i++) {
        const wide_t at = wide_sign(slope) ? wide_add(ray.from[i], wide_multiply(distance, ray.along[i])) : point[i];
        const int64_t value = wide_to_integer(at, 16);
        hit->point[i] = (q16_16_t)(value > INT32_MAX ? INT32_MAX : value < INT32_MIN ? INT32_MIN : value);
    }
}

int tuile_pick(const tuile_scene_t *scene, const tuile_config_t *config, uint16_t x, uint16_t y, void *block, size_t size_bytes,
               tuile_hit_t *hit) {
    tuile_t *t;
    tuile_tile_t tile;
    tuile_config_t one = {0};

    if (scene == NULL || config == NULL || hit == NULL || x >= config->width || y >= config->height) {
        return TUILE_ERROR_ARGUMENT;
    }
    one.width = config->width;
    one.height = config->height;
    one.tile_width = one.tile_height = 1;
    one.format = TUILE_FACE_IDS;
    one.tie = config->tie;
    one.buffers = 1;
    one.cluster_vertices = config->cluster_vertices;
    one.corners = config->corners;
    int result = tuile_init(&t, &one, block, size_bytes, NULL);
    if (result < 0) { return result; }
    t->rows_hint = 1;
    result = tuile_begin(t, scene);
    if (result < 0) { return result; }
    (void)tuile_seek(t, (uint32_t)y * one.width + x);
    result = tuile_next(t, &tile);
    (void)tuile_end(t, NULL);
    if (result < 0) { return result; }

    uint32_t id = *(const uint32_t *)(const void *)tile.bytes;
    if (id == 0) { return 0; }
    hit->depth = *(const uint16_t *)t->tile_memory;
    hit->face = id - 1;
    hit->instance = 0;
    while (hit->face >= scene->instances[hit->instance].model->face_count) {
        hit->face -= scene->instances[hit->instance].model->face_count;
        hit->instance++;
    }
    intersect(scene, hit, x, y);
    return 1;
}
