/* Which faces lie next to one another. */
#include "stages.h"

int keyed_face_order(const void *x, const void *y) {
    const keyed_face_t *a = x, *b = y;
    if (a->key != b->key) { return a->key < b->key ? -1 : 1; }
    return (a->item > b->item) - (a->item < b->item);
}

/* An edge with more than two faces links each to the next. Vertices are compared by place, as normals may differ along a crease.
 */
long solid_neighbours(const solid_t *solid, uint32_t (**pairs)[2]) {
    keyed_face_t *edges = mesh_array(solid->corner_count, sizeof *edges);
    *pairs = mesh_array(solid->corner_count, sizeof **pairs);
    if (!edges || !*pairs) {
        free(edges);
        return -1;
    }
    for (size_t f = 0; f < solid->face_count; f++) {
        const solid_face_t *face = &solid->faces[f];
        for (uint32_t i = 0; i < face->count; i++) {
            uint64_t p = solid->places[solid->corners[face->first + i]];
            uint64_t q = solid->places[solid->corners[face->first + (i + 1) % face->count]];
            edges[face->first + i] = (keyed_face_t){p < q ? p << 32 | q : q << 32 | p, (uint32_t)f};
        }
    }
    qsort(edges, solid->corner_count, sizeof *edges, keyed_face_order);
    long count = 0;
    for (size_t e = 1; e < solid->corner_count; e++) {
        if (edges[e].key == edges[e - 1].key && edges[e].item != edges[e - 1].item) {
            (*pairs)[count][0] = edges[e - 1].item;
            (*pairs)[count++][1] = edges[e].item;
        }
    }
    free(edges);
    return count;
}

uint64_t solid_z_order(const solid_t *solid, const uint32_t *faces, size_t count) {
    int64_t sum[3] = {0}, corners = 0;
    for (size_t f = 0; f < count; f++) {
        const solid_face_t *face = &solid->faces[faces[f]];
        for (uint32_t i = 0; i < face->count; i++, corners++) {
            for (int k = 0; k < 3; k++) {
                sum[k] += solid->vertices[solid->corners[face->first + i]].position[k] + 32768;
            }
        }
    }
    uint64_t key = 0;
    if (corners == 0) { return 0; }
    for (int bit = 15; bit >= 0; bit--) {
        for (int k = 0; k < 3; k++) {
            key = key << 1 | (uint64_t)(sum[k] / corners >> bit & 1);
        }
    }
    return key;
}
