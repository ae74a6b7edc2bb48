/* The frame: tiles, faces in the order of the method, light. */
#include "inside.h"

#include "../geometry/model.h"
#include "../geometry/tree.h"
#include "../pixel.h"

/* As geometry/vertex.h */
#define LIGHT_MOST 253

/* ---- opening ---- */

/* Limits of faces; the corners of triangles need no look. */
static bool faces_fit(const tuile_compact_t *compact, uint32_t clusters) {
    for (uint32_t k = 0; k < clusters; k++) {
        const TUILE_FLASH uint8_t *cluster = compact->clusters + (size_t)(MODEL_CLUSTER_BYTES * k);
        const TUILE_FLASH uint8_t *face = compact->faces + (size_t)model_u32(cluster + CLUSTER_AT_FACE_BYTES);

        if (cluster[CLUSTER_AT_KIND] == MODEL_CLUSTER_TRIANGLES) { continue; }
        for (uint16_t count = model_u16(cluster + CLUSTER_AT_FACE_COUNT); count; count--) {
            if (face[0] > TUILE_COMPACT_CORNERS) { return false; }
            face += MODEL_POLYGON_BYTES(face[0]);
        }
    }
    return true;
}

static bool one_sided(const tuile_compact_t *compact, uint16_t materials) {
    for (uint16_t m = 0; m < materials; m++) {
        if (compact->materials[MODEL_MATERIAL_BYTES * (size_t)m + MATERIAL_AT_FLAGS] & TUILE_MATERIAL_TWO_SIDED) { return false; }
    }
    return true;
}

static int open_model(tuile_compact_t *compact, const TUILE_FLASH uint8_t *model) {
    const uint32_t vertices = model_u32(model + MODEL_AT_VERTICES), faces = model_u32(model + MODEL_AT_FACES);

    if (model_u32(model + MODEL_AT_MAGIC) != MODEL_MAGIC || model_u16(model + MODEL_AT_VERSION) != MODEL_VERSION) {
        return TUILE_ERROR_MODEL;
    }
    if (vertices >= UINT16_MAX || faces >= UINT16_MAX) { return TUILE_ERROR_LIMITS; }
#define SECTION(at) (model_u32(model + (at)) ? model + (size_t)model_u32(model + (at)) : NULL)
    compact->positions = SECTION(MODEL_AT_POSITIONS);
    compact->fractions = SECTION(MODEL_AT_FRACTIONS);
    compact->clusters = SECTION(MODEL_AT_CLUSTER_TABLE);
    compact->faces = SECTION(MODEL_AT_FACE_BYTES);
    compact->face_normals = SECTION(MODEL_AT_FACE_NORMALS);
    compact->materials = SECTION(MODEL_AT_MATERIAL_TABLE);
    compact->tree = SECTION(MODEL_AT_TREE);
#undef SECTION
    compact->vertex_count = (uint16_t)vertices;
    compact->face_count = (uint16_t)faces;
    compact->tree_depth = model_u16(model + MODEL_AT_TREE_DEPTH);
    if (!faces_fit(compact, model_u32(model + MODEL_AT_CLUSTERS))) { return TUILE_ERROR_LIMITS; }
    return one_sided(compact, model_u16(model + MODEL_AT_MATERIALS)) ? TUILE_OK : TUILE_ERROR_EFFECTS;
}

/* Takes bytes from the block. */
static void *take(uint8_t **at, size_t size_bytes) {
    uint8_t *taken = *at;

    *at += size_bytes;
    return taken;
}

int tuile_compact_open(tuile_compact_t *compact, const tuile_compact_config_t *config, const TUILE_FLASH uint8_t *model,
                       void *block, size_t block_bytes) {
    tuile_compact_config_t *c = &compact->config;
    uint8_t *at = block;
    int error;

    *compact = (tuile_compact_t){.config = *config};
    if (c->tile_width == 0) { c->tile_width = c->width; }
    if (c->tile_height == 0) { c->tile_height = c->height; }
    if (c->width == 0 || c->height == 0 || c->width > TUILE_WINDOW_MAX_PX || c->height > TUILE_WINDOW_MAX_PX ||
        c->tile_height % 8u || c->tile_width > c->width || (c->method != TUILE_ZBUFFER && c->method != TUILE_TREE)) {
        return TUILE_ERROR_ARGUMENT;
    }
    if ((error = open_model(compact, model))) { return error; }
    if (c->method == TUILE_TREE && !compact->tree) { return TUILE_ERROR_TREE; }
    if (block_bytes < TUILE_COMPACT_BYTES(c->method, compact->vertex_count, compact->tree_depth, c->tile_width, c->tile_height)) {
        return TUILE_ERROR_MEMORY;
    }
    compact->points = take(&at, sizeof *compact->points * compact->vertex_count);
    if (c->method == TUILE_ZBUFFER) {
        compact->depths = take(&at, sizeof *compact->depths * compact->vertex_count);
        compact->depth = take(&at, sizeof *compact->depth * c->tile_width * c->tile_height);
    } else {
        compact->stack = take(&at, sizeof *compact->stack * compact->tree_depth);
    }
    compact->bits = at;
    compact->next_top = c->height;
    return TUILE_OK;
}

/* ---- faces ---- */

/* Of the front, or of the back. */
static uint8_t light_of(const tuile_compact_view_t *view, const TUILE_FLASH uint8_t *normal, bool back) {
    int32_t sum = view->ambient, n[3];

    for (uint8_t k = 0; k < 3; k++) {
        n[k] = back ? -(int8_t)normal[k] : (int8_t)normal[k];
    }
    for (uint8_t i = 0; i < view->light_count; i++) {
        const int32_t dot = (n[0] * view->lights[i][0] + n[1] * view->lights[i][1] + n[2] * view->lights[i][2]) >> 13;

        if (dot > 0) { sum += dot; }
    }
    return (uint8_t)(sum > LIGHT_MOST ? LIGHT_MOST : sum);
}

static uint8_t level_of(const tuile_compact_t *compact, const TUILE_FLASH uint8_t *normal, uint8_t material, bool back) {
    const TUILE_FLASH uint8_t *from = compact->materials + MODEL_MATERIAL_BYTES * (size_t)material + MATERIAL_AT_COLOUR;
    const uint8_t colour[3] = {from[0], from[1], from[2]};

    return compact_level((uint16_t)pixel_lit(PIXEL_LUMA16, colour, light_of(&compact->view, normal, back)));
}

/* The sign of the area in the window, positive for counter-clockwise as seen. */
static int sign_of_area(const compact_ring_t *ring) {
    const tuile_compact_point_t *v0 = &ring->point[0];
    int64_t area = 0;

    for (uint8_t i = 1; i + 1u < ring->count; i++) {
        const tuile_compact_point_t *v1 = &ring->point[i], *v2 = &ring->point[i + 1];
        const int32_t x1 = (int32_t)v1->x - v0->x, y1 = (int32_t)v1->y - v0->y;

        area += (int64_t)(((int32_t)v2->x - v0->x) * y1) - (int64_t)(x1 * ((int32_t)v2->y - v0->y));
    }
    return (area > 0) - (area < 0);
}

typedef struct face {
    uint16_t corners[TUILE_COMPACT_CORNERS]; /* vertices of the model */
    uint8_t count, material;
    bool crossing;
} face_t;

static void find_face(const tuile_compact_t *compact, uint16_t number, face_t *face) {
    const TUILE_FLASH uint8_t *cluster = compact->clusters;
    uint16_t within = number, count;

    while (within >= (count = model_u16(cluster + CLUSTER_AT_FACE_COUNT))) {
        within = (uint16_t)(within - count);
        cluster += MODEL_CLUSTER_BYTES;
    }
    const uint16_t first = (uint16_t)model_u32(cluster + CLUSTER_AT_FIRST_VERTEX);
    const TUILE_FLASH uint8_t *bytes = compact->faces + (size_t)model_u32(cluster + CLUSTER_AT_FACE_BYTES);
    if (cluster[CLUSTER_AT_KIND] == MODEL_CLUSTER_TRIANGLES) {
        bytes += 4u * (size_t)within;
        face->count = 3;
        face->material = bytes[3];
        face->crossing = false;
    } else {
        for (; within; within--) {
            bytes += MODEL_POLYGON_BYTES(bytes[0]);
        }
        face->count = bytes[0];
        face->material = bytes[2];
        face->crossing = (bytes[1] & MODEL_FACE_CROSSING) != 0;
        bytes += 3;
    }
    for (uint8_t i = 0; i < face->count; i++) {
        face->corners[i] = (uint16_t)(first + bytes[i]);
    }
}

/* Polygons without area may still cover pixels, triangles do not. What crosses itself is seen whichever way it turns here. */
static void draw_ring(tuile_compact_t *compact, compact_ring_t *ring, const TUILE_FLASH uint8_t *normal, const face_t *face) {
    int16_t first, end;

    if (ring->count < 3 || !compact_rows(compact, ring, &first, &end)) { return; }
    const int sign = sign_of_area(ring);
    if ((ring->count == 3 && sign == 0) || (sign < 0 && !face->crossing)) { return; }
    if (ring->count == 3 && sign < 0) {
        const tuile_compact_point_t point = ring->point[1];
        const uint32_t depth = ring->depth[1];

        ring->point[1] = ring->point[2];
        ring->depth[1] = ring->depth[2];
        ring->point[2] = point;
        ring->depth[2] = depth;
    }
    compact_fill(compact, ring, first, end, level_of(compact, normal, face->material, sign < 0));
}

static int draw_face(tuile_compact_t *compact, uint16_t number) {
    const TUILE_FLASH uint8_t *normal = compact->face_normals + 3u * (size_t)number;
    compact_ring_t ring = {.count = 0};
    face_t face;
    bool outside = false;

    find_face(compact, number, &face);
    for (uint8_t i = 0; i < face.count; i++) {
        const uint16_t corner = face.corners[i];

        ring.point[i] = compact->points[corner];
        ring.depth[i] = compact->depths ? compact->depths[corner] : 0;
        outside |= ring.point[i].x == COMPACT_OUTSIDE;
    }
    ring.count = face.count;
    if (face.crossing && !compact_plane_front(compact, face.corners, face.count, normal)) { return TUILE_OK; }
    if (outside && !compact_clip(compact, face.corners, face.count, &ring)) { return TUILE_ERROR_LIMITS; }
    draw_ring(compact, &ring, normal, &face);
    return TUILE_OK;
}

/* ---- by z-buffer: in the order of the model ---- */

static int draw_all(tuile_compact_t *compact) {
    int error = TUILE_OK;

    for (uint16_t i = 0; i < compact->face_count && !error; i++) {
        error = draw_face(compact, i);
    }
    return error;
}

/* ---- by tree: from back to front (visibility/tree.c) ---- */

#define AFTER 0x8000u /* on the stack: a convex set whose child has been drawn */

/* Of coplanar faces the one with the lower index is seen. */
static int draw_run(tuile_compact_t *compact, uint32_t first, uint32_t count) {
    int error = TUILE_OK;

    for (; count && !error; count--) {
        error = draw_face(compact, (uint16_t)(first + count - 1u));
    }
    return error;
}

/* The faces of a set that show their inside, or those that show their outside; of either only fronts are seen. */
static int draw_set(tuile_compact_t *compact, const TUILE_FLASH uint8_t *node, bool outside) {
    const tree_convex_t set = tree_convex(node);

    return outside != compact->view.mirrored ? draw_run(compact, set.first + set.inward, set.outward)
                                             : draw_run(compact, set.first, set.inward);
}

/* Is the observer on the plus side? geometry/tree.h has the bounds. */
static bool on_plus_side(const tuile_compact_view_t *view, const tree_plane_t *plane) {
    const int bits = view->observer_bits;
    int64_t sum = bits >= 0 ? fixed_shift_left64(plane->d, (unsigned)bits) : plane->d >> (bits < -62 ? 62 : -bits);

    for (uint8_t i = 0; i < 3; i++) {
        sum += (int64_t)plane->n[i] * view->observer[i];
    }
    return sum >= 0;
}

static int draw_tree(tuile_compact_t *compact) {
    uint16_t at = 0, waiting = 0;

    for (;;) {
        const TUILE_FLASH uint8_t *node = compact->tree + 4u * (size_t)(at & ~AFTER);
        const uint32_t word = model_u32(node);
        const bool child = (word & TREE_FIRST) != 0;
        uint16_t next = 0; /* word 0 is the root, which is nobody's child */

        if (TREE_KIND(word) == TREE_CONVEX) {
            int error = at & AFTER ? TUILE_OK : draw_set(compact, node, false);

            if (!error && (at & AFTER || !child)) { error = draw_set(compact, node, true); }
            if (error) { return error; }
            if (child && !(at & AFTER)) {
                compact->stack[waiting++] = (uint16_t)(at | AFTER);
                next = (uint16_t)(at + TREE_CONVEX_WORDS);
            }
        } else {
            const tree_plane_t plane = tree_plane(node);
            const uint16_t first = (uint16_t)(child ? at + TREE_PLANE_WORDS : 0), second = (uint16_t)tree_second(node);
            const bool plus = on_plus_side(&compact->view, &plane);
            const uint16_t far = plus ? second : first, near = plus ? first : second;

            if (far && near) { compact->stack[waiting++] = near; }
            next = far ? far : near;
        }
        if (next == 0) {
            if (waiting == 0) { return TUILE_OK; }
            next = compact->stack[--waiting];
        }
        at = next;
    }
}

/* ---- tiles ---- */

void tuile_compact_begin(tuile_compact_t *compact, const TUILE_FLASH tuile_compact_view_t *view) {
    compact->view = *view;
    compact->next_left = compact->next_top = 0;
    compact_vertices(compact);
}

static uint16_t least(uint32_t a, uint16_t b) { return a < b ? (uint16_t)a : b; }

int tuile_compact_next(tuile_compact_t *compact, tuile_tile_t *tile) {
    const tuile_compact_config_t *c = &compact->config;
    int error;

    if (compact->next_top >= c->height) { return 0; }
    compact->left = compact->next_left;
    compact->top = compact->next_top;
    compact->right = least((uint32_t)compact->left + c->tile_width, c->width);
    compact->bottom = least((uint32_t)compact->top + c->tile_height, c->height);
    compact->next_left = compact->right;
    if (compact->right == c->width) {
        compact->next_left = 0;
        compact->next_top = compact->bottom;
    }
    compact_clear(compact);
    error = c->method == TUILE_TREE ? draw_tree(compact) : draw_all(compact);
    if (error) { return error; }
    tile->x = compact->left;
    tile->y = compact->top;
    tile->width = (uint16_t)(compact->right - compact->left);
    tile->height = (uint16_t)(compact->bottom - compact->top);
    tile->bytes = compact->bits;
    tile->size_bytes = (uint32_t)tile->width * ((tile->height + 7u) / 8u);
    return 1;
}
