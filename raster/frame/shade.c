/* Deferred shading. A method draws the numbers of faces in the place of colours; here the faces that are seen get their colours,
 * each once a tile: the first sample of a face that is met leads to all others, which lie within its bounding box, and takes them
 * out. So a face is set up if it is seen, no list of faces is needed, and nothing is kept from one tile to the next.
 *
 * Where faces are drawn as they come (an immediate pass) there is never more than one number in the tile.
 *
 * Where some faces are drawn with their texture at once (textured.c) they leave the numbers under them as they are: those are told
 * by the depth, which is no longer that of the number's face but greater.
 */
#include "../tune.h"

#include "shade.h"

#include "../features.h"
#include "../memory.h"

/* Layers want the depth of what is seen; the z-buffer has it. */
static bool shade_keeps_depth(const tuile_t *t) { return frame_layers(t) && t->layer_depth != t->tile_memory; }

TUILE_NOINLINE void shade_open(tuile_t *t) {
    frame_fill_words(t->numbers, 0, (size_t)t->tile.stride_px * (size_t)(t->tile.bottom - t->tile.top) * sizeof(uint16_t));
    t->numbered = true;
}

void shade_clear(tuile_t *t) {
    const size_t samples = (size_t)t->tile.stride_px * (size_t)(t->tile.bottom - t->tile.top);
    uint8_t *to = t->working ? t->working : t->colours[t->next_buffer];
    const bool wide = pixel_bytes((pixel_kind_t)t->pixel_kind) == 4;
    t->numbered = false;
    if (!t->textured) { shade_open(t); }
    if (shade_keeps_depth(t)) { frame_fill_words(t->layer_depth, 0, samples * sizeof(uint16_t)); }
    frame_fill_words(to, wide ? t->background : t->background * 0x10001u, samples * (wide ? 4 : 2));
}

/* ---- a record as a face to be shaded ---- */

/* The attributes of the vertex in slot `slot`. */
static void corner_open(const tuile_t *t, const record_surface_t *extra, const tuile_model_t *model, uint32_t slot,
                        surface_corner_t *corner) {
    const source_slot_t *source = (const source_slot_t *)(const void *)&t->vertices[extra->source];
    const uint32_t k = slot - extra->source - SOURCE_SLOTS;
    clip_attributes_t *to = &corner->attributes;
    corner->at = t->vertices[slot];
    if (TUILE_UNLIKELY(source->attributes)) {
        *to = ((const clip_attributes_t *)(const void *)&t->vertices[source->attributes])[k];
        return;
    }
    const size_t number = source->first_vertex + k;
    if (model->texcoords) {
        to->s = model_i16(model->texcoords + 4 * number) * 256;
        to->t = model_i16(model->texcoords + 4 * number + 2) * 256;
    }
    if (source->colours) { memcpy(to->light, (const uint8_t *)(t->vertices + source->colours) + 4 * (size_t)k, 4); }
    if (model->colours) { memcpy(to->colour, model->colours + 4 * number, 4); }
}

/* Of a polygon's fan the largest triangle, which snapping disturbs least. */
static void largest_triangle(const polygon_ring_t *ring, const vertex_t *corners[3]) {
    int64_t most = -1;
    const vertex_t *v0 = polygon_ring_vertex(ring, 0);
    corners[0] = corners[1] = corners[2] = v0;
    for (uint32_t i = 1; i + 1 < ring->count; i++) {
        const vertex_t *v1 = polygon_ring_vertex(ring, i), *v2 = polygon_ring_vertex(ring, i + 1);
        int64_t area = (int64_t)(v2->x - v0->x) * (v1->y - v0->y) - (int64_t)(v1->x - v0->x) * (v2->y - v0->y);
        area = area < 0 ? -area : area;
        if (area > most) {
            most = area;
            corners[0] = v0;
            corners[1] = v1;
            corners[2] = v2;
        }
    }
}

static void ring_depths(const polygon_ring_t *ring, uint32_t *least, uint32_t *most) {
    *least = UINT32_MAX;
    *most = 0;
    for (uint32_t i = 0; i < ring->count; i++) {
        const uint32_t depth = polygon_ring_vertex(ring, i)->depth_light >> 8;
        *least = depth < *least ? depth : *least;
        *most = depth > *most ? depth : *most;
    }
}

static void face_open(const tuile_t *t, const record_t *record, surface_face_t *face) {
    const record_t whole = frame_record_face(t, record);
    const record_surface_t *extra = (const record_surface_t *)(const void *)record;
    const source_slot_t *source = (const source_slot_t *)(const void *)&t->vertices[extra->source];
    const tuile_instance_t *instance = &t->scene->instances[source->instance];
    const vertex_t *corners[3];
    const bool triangle = frame_record_is_triangle(&whole);
    face->least = face->most = 0;
    face->whole = triangle;
    if (TUILE_LIKELY(triangle)) {
        corners[0] = &t->vertices[whole.v0];
        corners[1] = corners[0] + whole.d1;
        corners[2] = corners[0] + whole.d2;
    } else {
        const polygon_ring_t ring = frame_record_ring(t, &whole);
        largest_triangle(&ring, corners);
        ring_depths(&ring, &face->least, &face->most);
        face->whole = ring.count == 3;
    }
    for (unsigned i = 0; i < 3; i++) {
        corner_open(t, extra, instance->model, (uint32_t)(corners[i] - t->vertices), &face->corner[i]);
    }
    face->material = frame_instance_material(instance, record->material);
    if (face->material.texture < instance->model->texture_count) {
        face->texture = tuile_model_texture(instance->model, face->material.texture);
    } else {
        face->material.texture = TUILE_NO_TEXTURE;
    }
    if (TUILE_HAS(LIGHTS) && instance->model->colours != NULL && (face->material.flags & TUILE_MATERIAL_VERTEX_COLOURS)) {
        face->material.colour[0] = face->material.colour[1] = face->material.colour[2] = 255;
    }
    face->coloured = source->colours != 0 || source->is_coloured;
    face->triangle = triangle;
    /* A polygon that is in one light all over, or that is not convex. */
    face->flat = t->config.shade == TUILE_FLAT || (!triangle && !face->coloured);
    face->flat_light[0] = record->light;
    face->flat_light[1] = extra->green;
    face->flat_light[2] = extra->blue;
    face->tinted = instance->model->colours != NULL;
    face->perspective = t->camera.projection == TUILE_PERSPECTIVE;
    face->texturing = t->config.texturing;
    if (!(t->config.effects & TUILE_LAYERS)) { face->material.blend = TUILE_BLEND_OVER; } /* nothing is translucent */
    face->fog = TUILE_HAS(FOG) && t->fog.kind != TUILE_FOG_NONE ? &t->fog : NULL;
}

void shade_surface(const tuile_t *t, const record_t *record, surface_t *surface, pixel_kind_t kind) {
    surface_face_t face;
    face_open(t, record, &face);
    surface_make(surface, &face, kind);
}

bool shade_depth(const tuile_t *t, const record_t *record, depth_plane_t *depth) {
    const record_t whole = frame_record_face(t, record);
    if (frame_record_is_triangle(&whole)) {
        const vertex_t *v0 = &t->vertices[whole.v0];
        triangle_planes(v0, v0 + whole.d1, v0 + whole.d2, depth, NULL);
        return true;
    }
    const polygon_ring_t ring = frame_record_ring(t, &whole);
    return polygon_plane(&ring, depth);
}

/* ---- numbers to samples ---- */

static void depth_run(tuile_t *t, const depth_plane_t *depth, int32_t x, int32_t y, int32_t count, size_t at) {
    for (int32_t i = 0; i < count; i++) {
        t->layer_depth[at + (size_t)i] = depth_at(depth, x + i, y);
    }
}

/* All samples of the face with this number from row `top` of the window on, in columns left ... right - 1. depth: NULL, or the
 * plane of the depth that is wanted too. */
static void shade_runs(tuile_t *t, const surface_t *surface, const depth_plane_t *depth, uint16_t value, int32_t left, int32_t top,
                       int32_t right, int32_t bottom) {
    const int32_t stride = t->tile.stride_px;
    const size_t bytes = pixel_bytes((pixel_kind_t)t->pixel_kind);
    uint8_t *tile = t->working ? t->working : t->colours[t->next_buffer];
    uint16_t *row = t->numbers + (size_t)(top - t->tile.top) * (size_t)stride;
    for (int32_t y = top; y < bottom; y++, row += stride) {
        uint16_t *at = row + (left - t->tile.left), *end = row + (right - t->tile.left);
        while (at < end) {
            if (*at != value) {
                at++;
                continue;
            }
            const uint16_t *first = at;
            while (at < end && *at == value) {
                *at++ = 0;
            }
            const int32_t x = t->tile.left + (int32_t)(first - row);
            if (TUILE_HAS(LAYERS) && depth != NULL) {
                depth_run(t, depth, x, y, (int32_t)(at - first), (size_t)(first - t->numbers));
            }
            if (TUILE_HAS(LINES) && t->config.edges == TUILE_EDGES_HIDDEN) { continue; }
            surface->fill(surface, x, y, (int32_t)(at - first), tile + (size_t)(first - t->numbers) * bytes);
        }
    }
}

void shade_box(const tuile_t *t, const record_t *record, int32_t *left, int32_t *top, int32_t *right, int32_t *bottom) {
    frame_record_rows(t, record, top, bottom);
    if (frame_record_is_piece(record)) {
        const face_bounds_t *bounds = &frame_record_piece(t, record)->bounds;
        *left = bounds->left;
        *right = bounds->right;
    } else if (frame_record_is_triangle(record)) {
        const vertex_t *v0 = &t->vertices[record->v0];
        const int32_t x0 = v0->x, x1 = v0[record->d1].x, x2 = v0[record->d2].x;
        *left = edge_row(x0 < x1 ? (x0 < x2 ? x0 : x2) : (x1 < x2 ? x1 : x2));
        *right = edge_row(x0 > x1 ? (x0 > x2 ? x0 : x2) : (x1 > x2 ? x1 : x2));
    } else {
        const polygon_ring_t ring = frame_record_ring(t, record);
        int32_t least = INT32_MAX, most = INT32_MIN;
        for (uint32_t i = 0; i < ring.count; i++) {
            const int32_t x = polygon_ring_vertex(&ring, i)->x;
            least = x < least ? x : least;
            most = x > most ? x : most;
        }
        *left = edge_row(least);
        *right = edge_row(most);
    }
    *left = *left < t->tile.left ? t->tile.left : *left;
    *right = *right > t->tile.right ? t->tile.right : *right;
    *top = *top < t->tile.top ? t->tile.top : *top;
    *bottom = *bottom > t->tile.bottom ? t->tile.bottom : *bottom;
}

/* Takes out the numbers of a face where another one has been drawn over it. */
static TUILE_NOINLINE void clear_hidden(tuile_t *t, const record_t *record, uint16_t value, int32_t left, int32_t top,
                                        int32_t right, int32_t bottom) {
    const bool triangle = frame_record_is_triangle(record);
    depth_plane_t plane;
    if (!shade_depth(t, record, &plane)) { return; } /* without an area it was never drawn */
    for (int32_t y = top; y < bottom; y++) {
        const size_t row = (size_t)(y - t->tile.top) * (size_t)t->tile.stride_px;
        for (int32_t x = left; x < right; x++) {
            const size_t at = row + (size_t)(x - t->tile.left);
            if (t->numbers[at] != value) { continue; }
            /* A triangle's plane is right modulo 2^32, however steep. */
            const uint32_t z = (uint32_t)plane.z + (uint32_t)plane.dx * (uint32_t)x + (uint32_t)plane.dy * (uint32_t)y;
            if (t->tile.depth[at] != (triangle ? (uint16_t)(z >> 16) : depth_at(&plane, x, y))) { t->numbers[at] = 0; }
        }
    }
}

#if defined(__GNUC__)
typedef uint64_t __attribute__((may_alias)) numbers_t; /* four of them */
#else
typedef uint64_t numbers_t;
#endif

/* The face of a record from row `from` on. */
static TUILE_NOINLINE void shade_record(tuile_t *t, uint32_t number, int32_t from) {
    const record_t *record = frame_record(t, number);
    int32_t left, top, right, bottom;
    surface_t surface;
    depth_plane_t depth;
    shade_box(t, record, &left, &top, &right, &bottom);
    shade_surface(t, record, &surface, (pixel_kind_t)t->pixel_kind);
    const bool with_depth = shade_keeps_depth(t) && shade_depth(t, record, &depth);
    top = top > from ? top : from;
    if (t->textured_any && !t->immediate) { clear_hidden(t, record, (uint16_t)(number + 1), left, top, right, bottom); }
    shade_runs(t, &surface, with_depth ? &depth : NULL, (uint16_t)(number + 1), left, top, right, bottom);
}

void shade_tile(tuile_t *t) {
    if (!t->numbered) { return; }
    const uint32_t stride = (uint32_t)t->tile.stride_px, count = stride * (uint32_t)(t->tile.bottom - t->tile.top);
    for (uint32_t at = 0; at < count; at++) {
        if (at % 4 == 0) { /* nothing seen in four samples: the room behind the last one is 0 up to a multiple of 64 bytes */
            while (at < count && *(const numbers_t *)(const void *)(t->numbers + at) == 0) {
                at += 4;
            }
            if (at >= count) { return; }
        }
        if (t->numbers[at] != 0) { shade_record(t, t->numbers[at] - 1u, t->tile.top + (int32_t)(at / stride)); }
    }
}

void shade_now(tuile_t *t, uint32_t number) {
    t->method->draw_now(t, number);
    if (!t->numbered) { return; }
    shade_record(t, number, t->tile.top);
}
