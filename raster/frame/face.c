/* From the faces of a cluster to records: culling by signed area, clipping, and the bucket of the tile row where each face starts.
 */
#include "../tune.h"

#include "face.h"

#include "../geometry/wide.h"
#include "../memory.h"

/* A slot for one record, NULL when the arena is full. */
TUILE_INLINE record_t *record_claim(tuile_t *t) {
    record_t *record = frame_record(t, t->record_count);
    if (TUILE_UNLIKELY((uint8_t *)record < (uint8_t *)(t->vertices + t->vertex_count) || t->record_count >= UINT16_MAX - 1)) {
        return NULL;
    }
    return record;
}

/* Hangs the claimed record into the bucket of its first row, or draws it at once. */
TUILE_INLINE void record_emit(tuile_t *t, record_t *record, int32_t row, uint32_t id) {
    if (t->record_bytes == sizeof(record_id_t)) { face_extend(t, record, id); }
    t->stats.faces_binned++;
    if (TUILE_UNLIKELY(t->immediate)) {
        t->draw_now(t, t->record_count);
        return;
    }
    if (row < t->region.top) { row = t->region.top; }
    uint16_t *bucket = &t->buckets[(uint32_t)row / t->config.tile_height];
    record->next = *bucket;
    *bucket = (uint16_t)++t->record_count;
}

/* The face covers a pixel centre's row and column of the region, as far as its bounding box tells. */
TUILE_INLINE bool box_in_region(const tuile_t *t, int32_t left, int32_t right, int32_t top, int32_t bottom) {
    const int32_t row = edge_row(top), row_end = edge_row(bottom), column = edge_row(left), column_end = edge_row(right);
    return row < row_end && column < column_end && row < t->region.bottom && row_end > t->region.top && column < t->region.right &&
           column_end > t->region.left;
}

/* One triangle, all corners in the window's guard band: vertices a, b and c behind slot `base`. */
TUILE_INLINE int bin_triangle(tuile_t *t, uint32_t base, uint32_t a, uint32_t b, uint32_t c, uint8_t material, const int8_t *normal,
                              uint32_t id, unsigned sides) {
    const vertex_t *v = t->vertices + base, *va = &v[a], *vb = &v[b], *vc = &v[c];
    const int32_t area = signed_area(va, vb, vc);
    bool back = false;
    if (area <= 0) {
        if (area == 0) {
            t->stats.faces_degenerate++;
            return FRAME_OK;
        }
        if (TUILE_LIKELY(!(sides & SIDE_BACK))) {
            t->stats.faces_back++;
            return FRAME_OK;
        }
        const uint32_t swap = b;
        b = c;
        c = swap;
        vb = &v[b];
        vc = &v[c];
        back = true;
    } else if (!(sides & SIDE_FRONT)) {
        return FRAME_OK;
    }
    /* The topmost corner becomes the first; the order round the face stays. */
    int32_t top = va->y, bottom;
    if (vb->y < top && vb->y <= vc->y) {
        const uint32_t first = a;
        a = b, b = c, c = first;
        bottom = vc->y > top ? vc->y : top;
        top = vb->y;
    } else if (vc->y < top) {
        const uint32_t last = c;
        c = b, b = a, a = last;
        bottom = vb->y > top ? vb->y : top;
        top = vc->y;
    } else {
        bottom = vb->y > vc->y ? vb->y : vc->y;
    }
    const int32_t left = least3(va->x, vb->x, vc->x), right = most3(va->x, vb->x, vc->x);
    if (!box_in_region(t, left, right, top, bottom)) {
        t->stats.faces_outside++;
        return FRAME_OK;
    }
    if (TUILE_UNLIKELY(right - left >= SHORT_SIDE || bottom - top >= SHORT_SIDE || edge_row(left) < t->region.left ||
                       edge_row(right) > t->region.right)) {
        t->small = false;
    }
    record_t *record = record_claim(t);
    if (TUILE_UNLIKELY(record == NULL)) { return FRAME_FULL; }
    record->v0 = (uint16_t)(base + a);
    record->d1 = (int8_t)(b - a);
    record->d2 = (int8_t)(c - a);
    record->material = (uint8_t)(material + t->material_base);
    record->light = normal ? flat_light(t, normal, back) : 0;
    record_emit(t, record, edge_row(top), id);
    return FRAME_OK;
}

/* The same for the rarer callers, so that it is not inlined once more for each. */
static TUILE_NOINLINE int bin_one_triangle(tuile_t *t, uint32_t base, uint32_t a, uint32_t b, uint32_t c, uint8_t material,
                                           const int8_t *normal, uint32_t id) {
    return bin_triangle(t, base, a, b, c, material, normal, id, t->sides);
}

/* A polygon of more than three corners. listed: corners are relative to `base`; else they follow on one another from base. */
static int bin_polygon(tuile_t *t, const polygon_ring_t *ring, const vertex_t *base, uint8_t material, const int8_t *normal,
                       uint32_t id) {
    int64_t area = 0;
    int32_t left = INT32_MAX, right = INT32_MIN, top = INT32_MAX, bottom = INT32_MIN;
    const vertex_t *v0 = polygon_ring_vertex(ring, 0);
    for (uint32_t i = 0; i < ring->count; i++) {
        const uint32_t j = i + 1 == ring->count ? 0 : i + 1;
        const vertex_t *a = polygon_ring_vertex(ring, i), *b = polygon_ring_vertex(ring, j);
        area += (int64_t)(b->x - v0->x) * (a->y - v0->y) - (int64_t)(a->x - v0->x) * (b->y - v0->y);
        left = a->x < left ? a->x : left;
        right = a->x > right ? a->x : right;
        top = a->y < top ? a->y : top;
        bottom = a->y > bottom ? a->y : bottom;
    }
    if (area < 0 ? !(t->sides & SIDE_BACK) : area > 0 && !(t->sides & SIDE_FRONT)) {
        t->stats.faces_back += area < 0;
        return FRAME_OK;
    }
    if (!box_in_region(t, left, right, top, bottom)) {
        t->stats.faces_outside++;
        return FRAME_OK;
    }
    /* An area of 0 may still cover pixels (a bow tie), so only a box without area is degenerate, and that was dropped above. */
    const uint32_t slots = 1 + (ring->corners ? (ring->count + 7) / 8 : 0);
    if (slots > frame_slots_left(t)) { return FRAME_FULL; }
    polygon_slot_t *slot = (polygon_slot_t *)(void *)(t->vertices + t->vertex_count);
    t->vertex_count += slots;
    record_t *record = record_claim(t);
    if (record == NULL) { return FRAME_FULL; }
    *slot = (polygon_slot_t){(uint16_t)ring->count, (uint16_t)(base - t->vertices), ring->corners != NULL, 0};
    if (ring->corners) {
        uint8_t *list = (uint8_t *)(slot + 1);
        for (uint32_t i = 0; i < ring->count; i++) {
            list[i] = ring->corners[i];
        }
    }
    *record = (record_t){0,
                         (uint16_t)((vertex_t *)(void *)slot - t->vertices),
                         0,
                         0,
                         (uint8_t)(material + t->material_base),
                         normal ? flat_light(t, normal, area < 0) : (uint8_t)v0->depth_light};
    record_emit(t, record, edge_row(top), id);
    if (t->immediate) { t->vertex_count -= slots; }
    return FRAME_OK;
}

/* ---- clipped faces, where shading is deferred: | source_slot_t | vertices | their attributes | ---- */

#define CLIPPED_SLOTS (uint32_t)(sizeof(clip_attributes_t) / sizeof(vertex_t))

static void clipped_attributes(const tuile_t *t, const frame_cluster_t *cluster, clip_face_t *face, uint32_t slot) {
    const tuile_model_t *model = t->instance->model;
    const source_slot_t *source = (const source_slot_t *)(const void *)&t->vertices[cluster->source];
    const size_t first = source->first_vertex;
    face->attributes = (clip_attributes_t *)(void *)(t->vertices + slot);
    if (model->texcoords) { face->texcoords = model->texcoords + 4 * first; }
    if (model->colours) { face->colours = model->colours + 4 * first; }
    if (source->colours) { face->lights = (const uint8_t *)(t->vertices + source->colours); }
}

/* The clipped face's vertices stand behind slot `at` and its source slot, its attributes farther on. */
static void clipped_source(tuile_t *t, const frame_cluster_t *cluster, const clip_face_t *face, uint32_t at, uint32_t count) {
    const source_slot_t *whole = (const source_slot_t *)(const void *)&t->vertices[cluster->source];
    const uint32_t slot = at + SOURCE_SLOTS + count;
    memmove(t->vertices + slot, face->attributes, count * sizeof(clip_attributes_t));
    *(source_slot_t *)(void *)(t->vertices + at) = (source_slot_t){.first_vertex = whole->first_vertex,
                                                                   .instance = whole->instance,
                                                                   .attributes = (uint16_t)slot,
                                                                   .is_coloured = whole->colours != 0};
    t->vertex_count = slot + count * CLIPPED_SLOTS;
    t->source = (uint16_t)at;
}

/* A face of which some corner is beyond near plane, far plane or guard band. */
static TUILE_NOINLINE int bin_clipped(tuile_t *t, const frame_cluster_t *cluster, const uint8_t *corners, unsigned count,
                                      uint8_t material, const int8_t *normal, uint32_t id) {
    clip_face_t face = {.positions = cluster->positions,
                        .fractions = cluster->fractions,
                        .vertices = cluster->vertices,
                        .corners = corners,
                        .count = count};
    const uint32_t mark = t->vertex_count, source = t->source;
    uint32_t room = frame_slots_left(t), base = mark;
    if (t->numbers != NULL) {
        if (room < SOURCE_SLOTS) { return FRAME_FULL; }
        base += SOURCE_SLOTS;
        room = (room - SOURCE_SLOTS) / (1 + CLIPPED_SLOTS);
        clipped_attributes(t, cluster, &face, base + room);
    }
    vertex_t *out = t->vertices + base;
    const int left = clip_polygon(&t->transform, &face, out, room);
    int result = FRAME_OK;

    if (left < 0) { return FRAME_FULL; }
    t->stats.faces_clipped++;
    if (left == 0) {
        t->stats.faces_clipped_away++;
        pass_give_up(t, base + 2 * (t->numbers != NULL ? 1 + CLIPPED_SLOTS : 1)); /* up to two corners were written */
        return FRAME_OK;
    }
    t->vertex_count = base + (uint32_t)left;
    if (t->numbers != NULL) { clipped_source(t, cluster, &face, mark, (uint32_t)left); }
    const uint32_t binned = t->record_count;
    bool lit_alike = true;
    for (int i = 1; i < left; i++) {
        lit_alike &= (uint8_t)out[i].depth_light == (uint8_t)out[0].depth_light;
    }
    lit_alike &= !cluster->coloured;
    if (left == 3) {
        result = bin_one_triangle(t, base, 0, 1, 2, material, normal, id);
    } else if (count == 3 && ((normal == NULL && !lit_alike) || cluster->tinted) && left <= 100) { /* others may not be convex */
        for (uint32_t i = 1; i + 1 < (uint32_t)left && result == FRAME_OK; i++) {
            result = bin_one_triangle(t, base, 0, i, i + 1, material, normal, id);
        }
    } else {
        const polygon_ring_t ring = {out, NULL, NULL, (uint32_t)left};
        result = bin_polygon(t, &ring, out, material, normal, id);
    }
    t->source = (uint16_t)source;
    if (t->immediate || (result == FRAME_OK && t->record_count == binned)) { pass_give_back(t, mark); }
    return result;
}

/* The loop that most faces go through: no vertex of the cluster is outside. */
static TUILE_NOINLINE int bin_triangles(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    const uint8_t *face = cluster->faces;
    const int8_t *normal = cluster->face_normals;
    const unsigned normal_step = normal ? 3 : 0;
    const uint32_t base = (uint32_t)(cluster->vertices - t->vertices);
    for (unsigned f = 0; f < count; f++, face += 4, normal += normal_step) {
        const int result =
            bin_triangle(t, base, face[0], face[1], face[2], face[3], normal, cluster->first_face + f, t->sides | SIDE_FRONT);
        if (TUILE_UNLIKELY(result != FRAME_OK)) { return result; }
    }
    return FRAME_OK;
}

/* Before each face that is told by its material and corners (frame/lights.c). */
TUILE_INLINE void face_lit(tuile_t *t, frame_lit_face_t *lit, const uint8_t *corners, unsigned count, uint8_t material,
                           const int8_t *normal, unsigned sides) {
    if (TUILE_HAS(LIGHTS) && TUILE_UNLIKELY(t->careful)) {
        lit->corners = corners;
        lit->count = (uint8_t)count;
        lit->material = material;
        lit->normal = normal;
        frame_lights_face(t, lit, sides);
    }
}

static TUILE_NOINLINE int bin_outside_triangles(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    const uint8_t *face = cluster->faces;
    const uint8_t sides = t->sides;
    frame_lit_face_t lit = {.cluster = cluster};
    int result = FRAME_OK;
    const uint32_t base = (uint32_t)(cluster->vertices - t->vertices);
    for (unsigned f = 0; f < count; f++, face += 4) {
        const vertex_t *v = cluster->vertices;
        const int8_t *normal = cluster->face_normals ? cluster->face_normals + 3 * f : NULL;
        const bool outside = v[face[0]].x == VERTEX_OUTSIDE || v[face[1]].x == VERTEX_OUTSIDE || v[face[2]].x == VERTEX_OUTSIDE;
        const uint32_t id = cluster->first_face + f;
        face_lit(t, &lit, face, 3, face[3], normal, sides);
        result = outside ? bin_clipped(t, cluster, face, 3, face[3], normal, id)
                         : bin_one_triangle(t, base, face[0], face[1], face[2], face[3], normal, id);
        if (TUILE_UNLIKELY(result != FRAME_OK)) { break; }
    }
    t->sides = sides;
    return result;
}

/* A triangle in a cluster whose vertices may lie too far apart for a record: it gets copies that stand together. */
static int bin_far_triangle(tuile_t *t, const frame_cluster_t *cluster, const uint8_t corners[3], uint8_t material,
                            const int8_t *normal, uint32_t id) {
    if (frame_slots_left(t) < 3) { return FRAME_FULL; }
    vertex_t *v = t->vertices + t->vertex_count;
    const uint32_t binned = t->record_count;
    for (unsigned i = 0; i < 3; i++) {
        v[i] = cluster->vertices[corners[i]];
    }
    t->vertex_count += 3;
    const int result = bin_one_triangle(t, t->vertex_count - 3, 0, 1, 2, material, normal, id);
    if (t->record_count == binned) { pass_give_back(t, t->vertex_count - 3); }
    return result;
}

/* The side of a polygon that is seen, by its plane: SIDE_FRONT or SIDE_BACK. For polygons that cross themselves. */
static unsigned side_by_plane(const tuile_t *t, const frame_cluster_t *cluster, const uint8_t *corner, unsigned corners,
                              unsigned f) {
    const transform_t *transform = &t->transform;
    const int8_t *outward = cluster->plane_normals + 3 * (size_t)f;
    wide_t first[3] = {{0, 0}}, normal[3] = {{0, 0}}, most = {0, 0}, height = {0, 0}, turned = {0, 0};
    for (unsigned i = 0; i < corners; i++) {
        const unsigned j = i + 1 == corners ? 0 : i + 1;
        wide_t a[3], b[3], cross[3], size = {0, 0};
        for (unsigned k = 0; k < 3; k++) {
            const size_t at[3] = {3 * (size_t)corner[0] + k, 3 * (size_t)corner[i] + k, 3 * (size_t)corner[j] + k};
            int32_t q[3];
            for (unsigned c = 0; c < 3; c++) {
                q[c] = 256 * cluster->positions[at[c]] + (cluster->fractions ? cluster->fractions[at[c]] : 0);
            }
            first[k] = wide_make(q[0], -8);
            a[k] = wide_make(q[1] - q[0], -8);
            b[k] = wide_make(q[2] - q[0], -8);
        }
        wide_cross(a, b, cross);
        for (unsigned k = 0; k < 3; k++) {
            size = wide_add(size, wide_abs(cross[k]));
        }
        if (wide_sign(wide_add(size, wide_negate(most))) > 0) { /* the largest triangle is the least disturbed by rounding */
            most = size;
            for (unsigned k = 0; k < 3; k++) {
                normal[k] = cross[k];
            }
        }
    }
    for (unsigned k = 0; k < 3; k++) {
        wide_t to = wide_make(transform->observer[k], transform->perspective ? -transform->observer_bits : 0);
        if (transform->perspective) { to = wide_add(to, wide_negate(first[k])); }
        height = wide_add(height, wide_multiply(normal[k], to));
        turned = wide_add(turned, wide_multiply(normal[k], wide_make(outward[k], 0)));
    }
    const bool outside = (wide_sign(height) >= 0) == (wide_sign(turned) >= 0);
    return outside == transform->mirrored ? SIDE_BACK : SIDE_FRONT;
}

/* One face of a cluster of polygons. */
static int bin_polygon_any(tuile_t *t, const frame_cluster_t *cluster, const uint8_t *face, unsigned f) {
    const bool far_apart = cluster->bytes[CLUSTER_AT_VERTEX_COUNT] > MODEL_TRIANGLE_CLUSTER_VERTICES;
    const int8_t *normal = cluster->face_normals ? cluster->face_normals + 3 * (size_t)f : NULL;
    const unsigned corners = face[0];
    const uint8_t flags = face[1], material = face[2], *corner = face + 3;
    const uint32_t id = cluster->first_face + f;
    const vertex_t *v = cluster->vertices;
    bool outside = false, lit_alike = true;
    int result = FRAME_OK;
    for (unsigned i = 0; i < corners; i++) {
        outside |= v[corner[i]].x == VERTEX_OUTSIDE;
        lit_alike &= (uint8_t)v[corner[i]].depth_light == (uint8_t)v[corner[0]].depth_light;
    }
    /* Gouraud: light is affine on a triangle only, so a smooth convex polygon is cut into a fan. */
    lit_alike &= !cluster->coloured;
    const bool fan = ((normal == NULL && !lit_alike) || cluster->tinted) && flags & MODEL_FACE_CONVEX;
    const unsigned parts = fan ? corners - 2 : 1;
    for (unsigned p = 1; p <= parts && result == FRAME_OK; p++) {
        const uint8_t part[3] = {corner[0], corner[p], corner[p + 1]};
        if (outside) {
            result = bin_clipped(t, cluster, fan ? part : corner, fan ? 3 : corners, material, normal, id);
        } else if (far_apart && (fan || corners == 3) && t->numbers != NULL) {
            const polygon_ring_t ring = {v, part, NULL,
                                         3}; /* a listed polygon's corners stand where their attributes are told by */
            result = bin_polygon(t, &ring, v, material, normal, id);
        } else if (far_apart && (fan || corners == 3)) {
            result = bin_far_triangle(t, cluster, part, material, normal, id);
        } else if (fan || corners == 3) {
            result = bin_one_triangle(t, (uint32_t)(v - t->vertices), part[0], part[1], part[2], material, normal, id);
        } else {
            const polygon_ring_t ring = {v, corner, NULL, corners};
            result = bin_polygon(t, &ring, v, material, normal, id);
        }
    }
    return result;
}

/* Is a face of this material left out, where only translucent or only opaque ones are wanted? */
static bool sifted_out(const tuile_t *t, uint8_t material) {
    if (t->sift == SIFT_NONE || t->sift == SIFT_ALL) { return false; }
    const bool translucent = t->translucent[material / 32] >> material % 32 & 1u;
    return translucent != (t->sift == SIFT_TRANSLUCENT);
}

static int bin_polygon_sided(tuile_t *t, const frame_cluster_t *cluster, const uint8_t *face, unsigned f) {
    if (TUILE_HAS(LAYERS) && sifted_out(t, face[2])) { return FRAME_OK; }
    if (TUILE_LIKELY(!(face[1] & MODEL_FACE_CROSSING))) { return bin_polygon_any(t, cluster, face, f); }
    if (!(side_by_plane(t, cluster, face + 3, face[0], f) & t->sides)) {
        t->stats.faces_back++;
        return FRAME_OK;
    }
    const uint8_t sides = t->sides;
    t->sides = SIDE_FRONT | SIDE_BACK;
    const int result = bin_polygon_any(t, cluster, face, f);
    t->sides = sides;
    return result;
}

static TUILE_NOINLINE int bin_polygon_lit(tuile_t *t, const frame_cluster_t *cluster, const uint8_t *face, unsigned f) {
    const uint8_t sides = t->sides;
    frame_lit_face_t lit = {.cluster = cluster};
    const int8_t *normal = cluster->face_normals ? cluster->face_normals + 3 * (size_t)f : NULL;
    face_lit(t, &lit, face + 3, face[0], face[2], normal, sides);
    const int result = bin_polygon_sided(t, cluster, face, f);
    t->sides = sides;
    return result;
}

TUILE_INLINE int bin_polygon_face(tuile_t *t, const frame_cluster_t *cluster, const uint8_t *face, unsigned f) {
    if (TUILE_HAS(LIGHTS) && TUILE_UNLIKELY(t->careful)) { return bin_polygon_lit(t, cluster, face, f); }
    return bin_polygon_sided(t, cluster, face, f);
}

static TUILE_NOINLINE int bin_polygons(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    const uint8_t *face = cluster->faces;
    int result = FRAME_OK;
    for (unsigned f = 0; f < count && result == FRAME_OK; f++, face += MODEL_POLYGON_BYTES(face[0])) {
        result = bin_polygon_face(t, cluster, face, f);
    }
    return result;
}

/* Triangles first ... end - 1 that are not sifted out. */
static TUILE_NOINLINE int bin_triangle_run(tuile_t *t, const frame_cluster_t *cluster, unsigned first, unsigned end,
                                           bool backwards);

static TUILE_NOINLINE int bin_sifted_triangles(tuile_t *t, const frame_cluster_t *cluster, unsigned first, unsigned end,
                                               bool backwards) {
    for (unsigned i = first; i < end; i++) {
        const unsigned f = backwards ? end - 1 - (i - first) : i;
        if (sifted_out(t, cluster->faces[4 * (size_t)f + 3])) { continue; }
        const int result = bin_triangle_run(t, cluster, f, f + 1, false);
        if (result != FRAME_OK) { return result; }
    }
    return FRAME_OK;
}

static bool cluster_is_sifted(const tuile_t *t, const frame_cluster_t *cluster) {
    return TUILE_HAS(LAYERS) && TUILE_UNLIKELY(t->sift != SIFT_NONE) && cluster->bytes[CLUSTER_AT_KIND] == MODEL_CLUSTER_TRIANGLES;
}

int face_bin_all(tuile_t *t, const frame_cluster_t *cluster) {
    t->source = cluster->source;
    const unsigned count = model_u16(cluster->bytes + CLUSTER_AT_FACE_COUNT);
    if (cluster_is_sifted(t, cluster)) { return bin_sifted_triangles(t, cluster, 0, count, false); }
    if (face_bin_plain(t, cluster, count)) { return FRAME_OK; }
    return cluster->bytes[CLUSTER_AT_KIND] != MODEL_CLUSTER_TRIANGLES  ? bin_polygons(t, cluster, count)
           : cluster->any_outside || (TUILE_HAS(LIGHTS) && t->careful) ? bin_outside_triangles(t, cluster, count)
                                                                       : bin_triangles(t, cluster, count);
}

/* ---- some faces of a cluster, in either direction ---- */

static TUILE_NOINLINE int bin_triangle_run(tuile_t *t, const frame_cluster_t *cluster, unsigned first, unsigned end,
                                           bool backwards) {
    const uint32_t base = (uint32_t)(cluster->vertices - t->vertices);
    const vertex_t *v = cluster->vertices;
    const uint8_t sides = t->sides;
    frame_lit_face_t lit = {.cluster = cluster};
    int result = FRAME_OK;
    for (unsigned i = first; i < end; i++) {
        const unsigned f = backwards ? end - 1 - (i - first) : i;
        const uint8_t *face = cluster->faces + 4 * (size_t)f;
        const int8_t *normal = cluster->face_normals ? cluster->face_normals + 3 * (size_t)f : NULL;
        const uint32_t id = cluster->first_face + f;
        const bool outside = v[face[0]].x == VERTEX_OUTSIDE || v[face[1]].x == VERTEX_OUTSIDE || v[face[2]].x == VERTEX_OUTSIDE;
        face_lit(t, &lit, face, 3, face[3], normal, sides);
        result = TUILE_UNLIKELY(outside) ? bin_clipped(t, cluster, face, 3, face[3], normal, id)
                                         : bin_triangle(t, base, face[0], face[1], face[2], face[3], normal, id, t->sides);
        if (TUILE_UNLIKELY(result != FRAME_OK)) { break; }
    }
    t->sides = sides;
    return result;
}

static int bin_polygon_run(tuile_t *t, const frame_cluster_t *cluster, unsigned first, unsigned end, bool backwards) {
    const uint8_t *face = cluster->faces;
    unsigned f = 0;
    int result = FRAME_OK;
    for (; f < (backwards ? end - 1 : first); f++) {
        face += MODEL_POLYGON_BYTES(face[0]);
    }
    if (!backwards) {
        for (; f < end && result == FRAME_OK; f++, face += MODEL_POLYGON_BYTES(face[0])) {
            result = bin_polygon_face(t, cluster, face, f);
        }
        return result;
    }
    for (;; f--) {
        result = bin_polygon_face(t, cluster, face, f);
        if (f == first || result != FRAME_OK) { return result; }
        face -= MODEL_POLYGON_BYTES(face[-1]);
    }
}

int face_bin_run(tuile_t *t, const frame_cluster_t *cluster, unsigned first, unsigned end, bool backwards) {
    t->source = cluster->source;
    if (cluster_is_sifted(t, cluster)) { return bin_sifted_triangles(t, cluster, first, end, backwards); }
    return cluster->bytes[CLUSTER_AT_KIND] != MODEL_CLUSTER_TRIANGLES ? bin_polygon_run(t, cluster, first, end, backwards)
                                                                      : bin_triangle_run(t, cluster, first, end, backwards);
}
