#include "exact_face.h"

#include "../support/check.h"
#include "../support/set_up.h"

#include "../../raster/geometry/model.h"

#include <math.h>

/* set_up.h has the definitions of tuile.h in real numbers. */
static set_up_t set_up_of(const tuile_scene_t *scene) {
    return (set_up_t){.model = *scene->instances->model, .instance = *scene->instances, .scene = *scene};
}

static void corner_open(const set_up_t *s, uint32_t vertex, const tuile_material_t *material, exact_corner_t *corner) {
    const tuile_model_t *model = s->instance.model;
    long double view[3];
    for (unsigned i = 0; i < 3; i++) {
        corner->position[i] = model_i16(model->positions + 6 * (size_t)vertex + 2 * i);
    }
    set_up_view(s, corner->position, view);
    corner->w = -view[2];
    set_up_window(s, view, &corner->x, &corner->y, &corner->depth);
    corner->over[0] = s->scene.camera.centre_x / 65536.0L * corner->w + s->scene.camera.focal_x / 65536.0L * view[0];
    corner->over[1] = s->scene.camera.centre_y / 65536.0L * corner->w - s->scene.camera.focal_y / 65536.0L * view[1];
    corner->snapped_x = floorl(corner->x * 16 + 0.5L) / 16;
    corner->snapped_y = floorl(corner->y * 16 + 0.5L) / 16;
    if (model->texcoords) {
        const uint8_t *at = model->texcoords + 4 * (size_t)vertex;
        corner->s = ldexpl(model_i16(at), -material->uv_bits);
        corner->t = ldexpl(model_i16(at + 2), -material->uv_bits);
    }
}

exact_face_t *exact_faces(const tuile_scene_t *scene) {
    const set_up_t s = set_up_of(scene);
    const tuile_model_t *model = s.instance.model;
    exact_face_t *faces = calloc(model->face_count, sizeof *faces), *face = faces;
    assert_non_null(faces);
    assert_null(model->fractions);
    for (uint32_t k = 0; k < model->cluster_count; k++) {
        const uint8_t *cluster = model->clusters + (size_t)k * MODEL_CLUSTER_BYTES;
        const uint8_t *at = model->faces + model_u32(cluster + CLUSTER_AT_FACE_BYTES);
        const uint32_t first = model_u32(cluster + CLUSTER_AT_FIRST_VERTEX);
        const bool polygons = cluster[CLUSTER_AT_KIND] != MODEL_CLUSTER_TRIANGLES;
        for (unsigned f = 0; f < model_u16(cluster + CLUSTER_AT_FACE_COUNT); f++, face++) {
            const uint8_t *corner = polygons ? at + 3 : at;
            if (polygons) { assert_int_equal(at[0], 3); }
            face->material = polygons ? at[2] : at[3];
            const tuile_material_t material = tuile_model_material(model, face->material);
            face->in_front = true;
            for (unsigned i = 0; i < 3; i++) {
                corner_open(&s, first + corner[i], &material, &face->corner[i]);
                face->in_front &= face->corner[i].w > 0;
            }
            at += polygons ? MODEL_POLYGON_BYTES(3) : 4;
        }
    }
    return faces;
}

/* Distance of a point from the segment between two others. */
static long double segment(long double px, long double py, long double ax, long double ay, long double bx, long double by) {
    const long double dx = bx - ax, dy = by - ay, length = dx * dx + dy * dy;
    long double along = length > 0 ? ((px - ax) * dx + (py - ay) * dy) / length : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    return hypotl(px - ax - along * dx, py - ay - along * dy);
}

exact_point_t exact_at(const exact_face_t *face, uint32_t x, uint32_t y, bool snapped) {
    const long double px = x + 0.5L, py = y + 0.5L;
    long double b[3], area = 0, q = 0;
    exact_point_t point = {.inside = true, .border = HUGE_VALL};
    for (int i = 0; i < 3; i++) {
        const exact_corner_t *a = &face->corner[(i + 1) % 3], *c = &face->corner[(i + 2) % 3];
        const long double ax = snapped ? a->snapped_x : a->x, ay = snapped ? a->snapped_y : a->y;
        const long double cx = snapped ? c->snapped_x : c->x, cy = snapped ? c->snapped_y : c->y;
        b[i] = (ax - px) * (cy - py) - (cx - px) * (ay - py);
        area += b[i];
        point.border = fminl(point.border, segment(px, py, ax, ay, cx, cy));
    }
    for (int i = 0; i < 3; i++) {
        const exact_corner_t *c = &face->corner[i];
        const long double weight = b[i] / area, over_w = weight / c->w;
        point.inside &= weight >= 0;
        point.depth += weight * c->depth;
        q += over_w;
        point.s += over_w * c->s;
        point.t += over_w * c->t;
    }
    point.s /= q;
    point.t /= q;
    return point;
}

/* Homogeneous: the point (x w, y w, w) is the sum of b_i (x_i w_i, y_i w_i, w_i), and b_i over their sum are its weights in space.
 */
bool exact_plane_at(const exact_face_t *face, long double x, long double y, exact_point_t *point) {
    long double b[3], sum = 0, w = 0;
    *point = (exact_point_t){.inside = true};
    for (int i = 0; i < 3; i++) {
        const exact_corner_t *a = &face->corner[(i + 1) % 3], *c = &face->corner[(i + 2) % 3];
        const long double ax = a->over[0] - x * a->w, ay = a->over[1] - y * a->w, cx = c->over[0] - x * c->w,
                          cy = c->over[1] - y * c->w;
        b[i] = ax * cy - cx * ay;
        sum += b[i];
    }
    for (int i = 0; i < 3; i++) {
        const exact_corner_t *c = &face->corner[i];
        const long double weight = b[i] / sum;
        point->inside &= weight >= 0;
        w += weight * c->w;
        point->s += weight * c->s;
        point->t += weight * c->t;
    }
    point->depth = face->corner[0].depth * face->corner[0].w / w;
    return w > 0;
}

bool exact_front(const exact_face_t *face) {
    const exact_corner_t *c = face->corner;
    return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y) < 0; /* y downwards */
}

void exact_clip_matrix(const tuile_scene_t *scene, uint32_t width, uint32_t height, double clip[4][4]) {
    const set_up_t s = set_up_of(scene);
    const tuile_camera_t *camera = &scene->camera;
    const long double near = camera->near / 65536.0L, far = camera->far / 65536.0L;
    const long double fx = camera->focal_x / 65536.0L, fy = camera->focal_y / 65536.0L;
    const long double cx = camera->centre_x / 65536.0L, cy = camera->centre_y / 65536.0L;
    static const int16_t units[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    long double origin[3];
    set_up_view(&s, units[3], origin);
    for (int j = 0; j < 4; j++) { /* the view of a position is affine: column by column */
        long double v[3];
        set_up_view(&s, units[j], v);
        for (int i = 0; i < 3 && j < 3; i++) {
            v[i] -= origin[i];
        }
        const long double w = -v[2];
        clip[0][j] = (double)(2 * fx / width * v[0] + (2 * cx / width - 1) * w);
        clip[1][j] = (double)(2 * fy / height * v[1] + (1 - 2 * cy / height) * w);
        clip[2][j] = (double)((far + near) / (far - near) * w - (j == 3 ? 2 * far * near / (far - near) : 0));
        clip[3][j] = (double)w;
    }
}
