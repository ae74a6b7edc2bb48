/* Instances between two key frames. The cluster that is being drawn has its positions and normals made anew beside the vertices of
 * the pass, in scratch memory that is taken at the start of the frame if any instance wants it.
 */
#include "frame.h"

#include "../geometry/morph.h"

/* Scratch: | positions | fractions | normals | face normals |. 12 bytes a vertex, 3 a face. */
static void scratch_room(const tuile_model_t *model, uint32_t *vertices, uint32_t *faces) {
    if (model->cluster_vertices_max > *vertices) { *vertices = model->cluster_vertices_max; }
    for (uint32_t k = 0; k < model->cluster_count; k++) {
        const uint32_t count = model_u16(model->clusters + (size_t)k * MODEL_CLUSTER_BYTES + CLUSTER_AT_FACE_COUNT);
        if (count > *faces) { *faces = count; }
    }
}

int frame_morph_begin(tuile_t *t, uint8_t **arena) {
    const tuile_scene_t *scene = t->scene;
    uint32_t vertices = 0, faces = 0;
    for (unsigned i = 0; i < scene->instance_count; i++) {
        if (scene->instances[i].morph != 0) { scratch_room(scene->instances[i].model, &vertices, &faces); }
    }
    if (vertices == 0) { return TUILE_OK; }
    const size_t bytes = TUILE_MORPH_BYTES((size_t)vertices, (size_t)faces), room = (size_t)(t->arena_end - *arena);
    const size_t least = TUILE_CLIP_BYTES + 8 * (size_t)t->config.cluster_vertices + TUILE_CORNERS_BYTES(t->config.corners) +
                         (t->numbers != NULL ? TUILE_SURFACE_BYTES((size_t)t->config.cluster_vertices) : 0);
    if (bytes + least > room) {
        t->wanted_bytes = (size_t)t->stats.size_bytes + (bytes + least - room);
        return TUILE_ERROR_MEMORY;
    }
    t->morph_scratch = *arena;
    t->morph_vertices = (uint16_t)vertices;
    *arena += bytes;
    pass_reaches(t, *arena + least);
    return TUILE_OK;
}

void frame_morph_cluster(tuile_t *t, frame_cluster_t *cluster) {
    const tuile_model_t *model = t->instance->model;
    const uint16_t morph = t->instance->morph;
    const size_t first_vertex = model_u32(cluster->bytes + CLUSTER_AT_FIRST_VERTEX);
    const size_t first_face = model_u32(cluster->bytes + CLUSTER_AT_FIRST_FACE);
    const unsigned vertices = cluster->bytes[CLUSTER_AT_VERTEX_COUNT], faces = model_u16(cluster->bytes + CLUSTER_AT_FACE_COUNT);
    int16_t *positions = (int16_t *)(void *)t->morph_scratch;
    int8_t *fractions = (int8_t *)(positions + 3 * (size_t)t->morph_vertices);
    int8_t *normals = fractions + 3 * (size_t)t->morph_vertices, *face_normals = normals + 3 * (size_t)t->morph_vertices;
    morph_positions(cluster->positions, (const int16_t *)(const void *)model->morph_positions + 3 * first_vertex,
                    cluster->fractions, vertices, morph, positions, fractions);
    cluster->positions = positions;
    cluster->fractions = fractions;
    if (t->config.shade != TUILE_FLAT) {
        morph_normals(cluster->normals, (const int8_t *)model->morph_normals + 3 * first_vertex, vertices, morph, normals);
        cluster->normals = normals;
    }
    if (cluster->face_normals || cluster->bytes[CLUSTER_AT_KIND] != MODEL_CLUSTER_TRIANGLES) {
        morph_normals(cluster->plane_normals, (const int8_t *)model->morph_face_normals + 3 * first_face, faces, morph,
                      face_normals);
        cluster->plane_normals = face_normals;
        if (cluster->face_normals) { cluster->face_normals = face_normals; }
    }
}
