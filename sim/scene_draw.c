#include "scene_draw.h"

#include "../raster/geometry/model.h"

#include <stdlib.h>
#include <string.h>

__extension__ typedef __int128 int128_t;

/* Lines (the last two corners alike) or triangles, in the window. */
typedef struct shape {
    int32_t corners[3][2];
    uint32_t value;
} shape_t;

typedef struct drawer {
    const scene_text_t *scene;
    const scene_view_t *view;
    int exponent;
    shape_t *shapes;
    size_t count, capacity;
    sim_error_t *error;
} drawer_t;

/* A corner in steps, homogeneous: (x, y, z) / w; w > 0. Of the file: w = 1, |.| < 2^15; cut: below 2^66. */
typedef struct corner {
    int128_t x, y, z, w;
} corner_t;

static int128_t floor_divide(int128_t a, int128_t b) { /* b > 0 */
    const int128_t quotient = a / b;
    return quotient - (a % b < 0);
}

/* The pixel whose sample is nearest: the camera's centre is moved so that it lies in the middle of the pixel. */
static bool snap(const drawer_t *d, const corner_t *p, int32_t pixel[2]) {
    const tuile_camera_t *camera = &d->view->camera;
    const q16_16_t centre[2] = {camera->centre_x, camera->centre_y};
    const int128_t at[2] = {p->x, p->y * d->scene->y_sign};
    for (int k = 0; k < 2; k++) {
        int128_t place;
        if (camera->projection == TUILE_PERSPECTIVE) {
            place = floor_divide(centre[k] * p->z + camera->focal_x * at[k], p->z * 65536);
        } else { /* w = 1; -32 <= exponent <= 14 */
            const int128_t unit = (int128_t)1 << 48;
            place = floor_divide(centre[k] * ((int128_t)1 << 32) + at[k] * ((int128_t)1 << (48 + d->exponent)), unit);
        }
        if (place < -LINE_RANGE || place > LINE_RANGE) { return false; }
        pixel[k] = (int32_t)place;
    }
    return true;
}

static int add(drawer_t *d, const corner_t *corners, int count, uint32_t face) {
    if (d->count == d->capacity) {
        const size_t capacity = d->capacity ? 2 * d->capacity : 256;
        shape_t *shapes = realloc(d->shapes, capacity * sizeof *shapes);
        if (!shapes) { return sim_fail(d->error, "out of memory"); }
        d->shapes = shapes;
        d->capacity = capacity;
    }
    shape_t *shape = &d->shapes[d->count++];
    shape->value = face + 1;
    for (int i = 0; i < 3; i++) {
        if (!snap(d, &corners[i < count ? i : count - 1], shape->corners[i])) {
            return sim_fail(d->error, "line %lu: polygon %lu reaches further than 2^29 pixels; move NEAR away from the eye",
                            d->scene->polys[face].line, (unsigned long)d->scene->polys[face].id);
        }
    }
    return 0;
}

/* How far before the near plane, in 2^-16 step times w. */
static int128_t before_near(const drawer_t *d, const corner_t *p) { return p->z * 65536 - p->w * d->view->camera.near; }

/* Cuts off what is nearer than the near plane, and adds what is left of a line (count 2) or a triangle (3). */
static int cut_and_add(drawer_t *d, const corner_t *corners, int count, uint32_t face) {
    corner_t kept[4];
    int left = 0;
    if (d->scene->projection == TUILE_ORTHOGRAPHIC) { return add(d, corners, count, face); }
    for (int i = 0; i < count; i++) {
        const corner_t *p = &corners[i], *q = &corners[(i + 1) % count];
        const int128_t a = before_near(d, p), b = before_near(d, q);
        if (a >= 0) { kept[left++] = *p; }
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
            const int128_t u = b < 0 ? -b : b, v = a < 0 ? -a : a;
            kept[left++] = (corner_t){p->x * u + q->x * v, p->y * u + q->y * v, p->z * u + q->z * v, u + v};
        }
    }
    for (int i = 2; count == 3 && i < left; i++) {
        const corner_t part[3] = {kept[0], kept[i - 1], kept[i]};
        if (add(d, part, 3, face)) { return -1; }
    }
    /* Of a line the way back is met, too: only the first two count. */
    return count == 2 && left > 0 ? add(d, kept, left < 2 ? 1 : 2, face) : 0;
}

static corner_t corner_of(const double position[3]) {
    return (corner_t){(int128_t)position[0], (int128_t)position[1], (int128_t)position[2], 1};
}

static int collect_lines(drawer_t *d, const mesh_t *mesh) {
    for (size_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *corners = mesh->corners + mesh->faces[f].first;
        for (uint32_t i = 0; i < mesh->faces[f].count; i++) {
            const corner_t side[2] = {corner_of(mesh->positions[corners[i]]),
                                      corner_of(mesh->positions[corners[(i + 1) % mesh->faces[f].count]])};
            if (cut_and_add(d, side, 2, (uint32_t)f)) { return -1; }
        }
    }
    return 0;
}

/* ---- triangles ------------------------------------------------------------------------------------------------------ */

/* Twice the area of p q r as seen along an axis; whole steps, so that doubles are exact. */
static double area(const double *p, const double *q, const double *r, int axis) {
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    return (q[x] - p[x]) * (r[y] - p[y]) - (q[y] - p[y]) * (r[x] - p[x]);
}

/* Two sides that are no neighbours cross between their ends. */
static bool crosses_itself(const mesh_t *mesh, const mesh_face_t *face) {
    const uint32_t *corners = mesh->corners + face->first;
    const double(*at)[3] = (const double(*)[3])mesh->positions;
    const double *origin = at[corners[0]];
    int axis = -1; /* along which the polygon is not seen from its edge */
    for (uint32_t i = 1; i + 1 < face->count && axis < 0; i++) {
        for (uint32_t j = i + 1; j < face->count && axis < 0; j++) {
            for (int k = 0; k < 3; k++) {
                if (area(origin, at[corners[i]], at[corners[j]], k) != 0) { axis = k; }
            }
        }
    }
    for (uint32_t i = 0; i < face->count && axis >= 0; i++) {
        const double *a = at[corners[i]], *b = at[corners[(i + 1) % face->count]];
        for (uint32_t j = i + 2; j < face->count; j++) {
            const double *c = at[corners[j]], *e = at[corners[(j + 1) % face->count]];
            if (area(a, b, c, axis) * area(a, b, e, axis) < 0 && area(c, e, a, axis) * area(c, e, b, axis) < 0) { return true; }
        }
    }
    return false;
}

static int collect_model(drawer_t *d, const tuile_model_t *model) {
    for (uint32_t k = 0; k < model->cluster_count; k++) {
        const uint8_t *cluster = model->clusters + (size_t)k * MODEL_CLUSTER_BYTES;
        const uint8_t *face = model->faces + model_u32(cluster + CLUSTER_AT_FACE_BYTES);
        const uint32_t first = model_u32(cluster + CLUSTER_AT_FIRST_FACE), faces = model_u16(cluster + CLUSTER_AT_FACE_COUNT);
        const uint8_t *positions = model->positions + (size_t)model_u32(cluster + CLUSTER_AT_FIRST_VERTEX) * 6;
        for (uint32_t f = 0; f < faces; f++, face += 4) {
            corner_t corners[3];
            for (int i = 0; i < 3; i++) {
                const uint8_t *p = positions + (size_t)face[i] * 6;
                corners[i] = (corner_t){model_i16(p), model_i16(p + 2), model_i16(p + 4), 1};
            }
            if (cut_and_add(d, corners, 3, tuile_model_source_face(model, first + f))) { return -1; }
        }
    }
    return 0;
}

static int collect_triangles(drawer_t *d, const mesh_t *mesh) {
    mesh_options_t options = scene_text_mesh_options();
    tuile_model_t model;
    uint8_t *bytes;
    size_t size_bytes;
    options.triangles = true;
    for (size_t f = 0; f < mesh->face_count; f++) {
        if (crosses_itself(mesh, &mesh->faces[f])) {
            return sim_fail(d->error,
                            "line %lu: polygon %lu crosses itself, so that it has no triangles; draw it filled or as lines",
                            d->scene->polys[f].line, (unsigned long)d->scene->polys[f].id);
        }
    }
    if (mesh_compile(mesh, &options, &bytes, &size_bytes, NULL, d->error)) { return -1; }
    int result = tuile_model_open(&model, bytes, size_bytes);
    result = result ? sim_fail(d->error, "internal: %s", tuile_error_text(result)) : collect_model(d, &model);
    free(bytes);
    return result;
}

/* ---- tiles ---------------------------------------------------------------------------------------------------------- */

static void draw_tile(const drawer_t *d, const scene_drawing_t *drawing, const raster_tile_t *tile) {
    for (size_t i = 0; i < d->count; i++) {
        const shape_t *shape = &d->shapes[i];
        if (drawing->kind == SCENE_DRAW_LINES) {
            line_draw(tile, shape->corners[0], shape->corners[1], shape->value, 4);
        } else {
            edge_table_fill(tile, (const int32_t(*)[2])shape->corners, drawing->policy, shape->value, 4);
        }
    }
}

static int draw_tiles(const drawer_t *d, const scene_drawing_t *drawing, uint32_t *ids) {
    const int32_t width = d->scene->width, height = d->scene->height;
    const int32_t tile_width = drawing->tile_width ? drawing->tile_width : width;
    const int32_t tile_height = drawing->tile_height ? drawing->tile_height : height;
    const size_t pixels = (size_t)tile_width * (size_t)tile_height;
    uint32_t *colours = malloc(pixels * sizeof *colours);
    if (!colours) { return sim_fail(d->error, "out of memory"); }
    for (int32_t top = 0; top < height; top += tile_height) {
        for (int32_t left = 0; left < width; left += tile_width) {
            raster_tile_t tile = {NULL, colours, left, top, left + tile_width, top + tile_height, tile_width};
            tile.right = tile.right < width ? tile.right : width;
            tile.bottom = tile.bottom < height ? tile.bottom : height;
            memset(colours, 0, pixels * sizeof *colours);
            draw_tile(d, drawing, &tile);
            for (int32_t y = top; y < tile.bottom; y++) {
                memcpy(ids + (size_t)y * (size_t)width + left, colours + (size_t)(y - top) * (size_t)tile_width,
                       (size_t)(tile.right - left) * sizeof *ids);
            }
        }
    }
    free(colours);
    return 0;
}

int scene_draw(const scene_text_t *scene, const mesh_t *mesh, const scene_quantisation_t *quantisation, const scene_view_t *view,
               const scene_drawing_t *drawing, uint32_t *ids, sim_error_t *error) {
    drawer_t d = {.scene = scene, .view = view, .exponent = quantisation->exponent, .error = error};
    int result = 0;
    if (mesh->face_count) { result = drawing->kind == SCENE_DRAW_LINES ? collect_lines(&d, mesh) : collect_triangles(&d, mesh); }
    if (!result) { result = draw_tiles(&d, drawing, ids); }
    free(d.shapes);
    return result;
}
