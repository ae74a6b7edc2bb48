/* From clusters to faces: culling of whole clusters and the vertex stage. */
#include "../tune.h"

#include "frame.h"

#include "../layer/layer.h"

#include "../features.h"

/* Vertices that still fit below the records. */
uint32_t frame_slots_left(const tuile_t *t) {
    const uint8_t *low = t->arena_end - (size_t)t->record_count * t->record_bytes;
    const uint32_t limit = (uint32_t)((size_t)(low - (uint8_t *)t->vertices) / sizeof(vertex_t));
    return (limit < t->vertex_limit ? limit : t->vertex_limit) - t->vertex_count;
}

int bin_cluster_open(tuile_t *t, const uint8_t *bytes, frame_cluster_t *cluster) {
    const unsigned vertices = bytes[CLUSTER_AT_VERTEX_COUNT], faces = model_u16(bytes + CLUSTER_AT_FACE_COUNT);
    const uint32_t first_vertex = model_u32(bytes + CLUSTER_AT_FIRST_VERTEX);

    t->stats.clusters++;
    if (cull_faces_away(&t->transform, bytes)) {
        t->stats.clusters_facing_away++;
        return BIN_CULLED;
    }
    if (cull_outside(&t->transform, bytes)) {
        t->stats.clusters_outside++;
        return BIN_CULLED;
    }
    const uint32_t ahead = t->numbers != NULL ? SOURCE_SLOTS : 0;
    const bool coloured = TUILE_HAS(LIGHTS) && t->coloured && t->config.shade != TUILE_FLAT;
    const uint32_t behind = coloured ? (vertices + 1u) / 2u : 0;
    if (vertices + ahead + behind > frame_slots_left(t)) { return FRAME_FULL; }
    if (ahead) {
        *(source_slot_t *)(void *)(t->vertices + t->vertex_count) =
            (source_slot_t){.first_vertex = first_vertex,
                            .instance = t->instance_number,
                            .colours = (uint16_t)(coloured ? t->vertex_count + ahead + vertices : 0)};
    }
    bin_cluster_at(t, bytes, t->vertex_count + ahead, cluster);
    if (TUILE_HAS(MORPH) && TUILE_UNLIKELY(t->instance->morph != 0)) { frame_morph_cluster(t, cluster); }
    const unsigned any = vertex_stage_region(&t->transform, bytes, cluster->positions,
                                             t->config.shade == TUILE_FLAT ? NULL : cluster->normals, vertices, cluster->vertices);
    cluster->any_outside = any & VERTEX_ANY_OUTSIDE;
    cluster->any_beyond = any != 0;
    if (cluster->fractions) {
        cluster->any_beyond = true;
        cluster->any_outside |=
            vertex_fractions(&t->transform, cluster->positions, cluster->fractions, vertices, cluster->vertices);
    }
    if (coloured) { frame_lights_cluster(t, cluster, t->vertex_count + ahead + vertices); }
    t->vertex_count += vertices + ahead + behind;
    t->cluster_end = t->vertex_count;
    t->stats.vertices += vertices;
    t->stats.faces_tested += faces;
    return FRAME_OK;
}

void bin_cluster_at(const tuile_t *t, const uint8_t *bytes, uint32_t slot, frame_cluster_t *cluster) {
    const tuile_model_t *model = t->instance->model;
    const uint32_t first_face = model_u32(bytes + CLUSTER_AT_FIRST_FACE);
    const size_t first = 3 * (size_t)model_u32(bytes + CLUSTER_AT_FIRST_VERTEX);
    cluster->bytes = bytes;
    cluster->faces = model->faces + model_u32(bytes + CLUSTER_AT_FACE_BYTES);
    cluster->positions = (const int16_t *)(const void *)model->positions + first;
    cluster->fractions = model->fractions ? (const int8_t *)model->fractions + first : NULL;
    cluster->normals = (const int8_t *)model->normals + first;
    cluster->plane_normals = (const int8_t *)model->face_normals + 3 * (size_t)first_face;
    cluster->face_normals = t->config.shade == TUILE_FLAT ? cluster->plane_normals : NULL;
    cluster->vertices = t->vertices + slot;
    cluster->any_outside = cluster->any_beyond = true;
    cluster->first_face = t->face_base + first_face;
    cluster->source = (uint16_t)(t->numbers != NULL ? slot - SOURCE_SLOTS : 0);
    cluster->tinted = TUILE_HAS(LIGHTS) && t->numbers != NULL && model->colours != NULL;
    cluster->coloured = t->numbers != NULL && ((const source_slot_t *)(const void *)&t->vertices[cluster->source])->colours != 0;
}

static int bin_cluster(tuile_t *t, const uint8_t *bytes) {
    const uint32_t mark = t->vertex_count, binned = t->record_count;
    frame_cluster_t cluster;
    int result = bin_cluster_open(t, bytes, &cluster);
    if (result != FRAME_OK) { return result == BIN_CULLED ? FRAME_OK : result; }
    result = face_bin_all(t, &cluster);
    if (t->record_count != binned) { return result; }
    pass_give_back(t, mark); /* none of its faces is left: nor need its vertices be */
    return result;
}

void bin_begin(tuile_t *t) {
    t->stats.passes++;
    t->textured_source = UINT16_MAX;
    t->vertex_count = t->record_count = 0;
    t->passing_bytes = 0;
    t->instance = NULL;
    t->small = true;
    for (uint32_t row = t->pass_first; row < t->pass_end; row++) {
        t->buckets[row] = RECORD_NONE;
    }
}

/* Ids of the faces of an instance begin where those of the one before it end. */
static void count_faces_before(tuile_t *t, unsigned number) {
    unsigned from = t->instance != NULL && t->instance_number < number ? t->instance_number : 0;
    if (from == 0) { t->face_base = 0; }
    for (; from < number; from++) {
        /* tuile_begin has refused scenes without instances or models. NOLINTNEXTLINE(clang-analyzer-core.NullDereference) */
        t->face_base += t->scene->instances[from].model->face_count;
    }
}

int bin_instance_open(tuile_t *t, unsigned number) {
    const tuile_scene_t *scene = t->scene;
    count_faces_before(t, number);
    t->stats.instances++;
    t->instance = &scene->instances[number];
    t->instance_number = (uint16_t)number;
    tuile_scene_t sampled = *scene;
    sampled.camera = t->camera;
    if (t->coloured_scene || t->span_kind == SPAN_IDS) { /* t->lamps have them */
        sampled.light_count = 0;
    }
    int error = transform_check(&sampled, t->instance);
    if (error) { return error; }
    const bool outside = cull_instance_outside(&t->camera, t->instance, &t->region);
    if (!outside) {
        error = transform_make(&t->transform, &sampled, t->instance, t->config.width, t->config.height);
        if (error) { return error; }
        transform_region(&t->transform, &t->region);
    }
    if (outside || cull_model_outside(&t->transform, t->instance->model)) {
        t->stats.instances_outside++;
        return BIN_CULLED;
    }
    t->material_base = (uint16_t)(frame_counts_materials(t) ? frame_material_base(scene, number) : 0);
    t->sides = t->instance->two_sided ? SIDE_FRONT | SIDE_BACK : SIDE_FRONT;
    if (TUILE_HAS(LIGHTS) && TUILE_UNLIKELY(t->lamps != NULL || t->backs)) { frame_lights_instance(t); }
    if (frame_layers(t) && !layer_sift(t)) { return BIN_CULLED; }
    return FRAME_OK;
}

int bin_instance(tuile_t *t, unsigned number) {
    const int opened = bin_instance_open(t, number);
    if (opened != FRAME_OK) { return opened == BIN_CULLED ? FRAME_OK : opened; }
    const tuile_model_t *model = t->instance->model;
    for (uint32_t k = 0; k < model->cluster_count; k++) {
        const int result = bin_cluster(t, model->clusters + (size_t)k * MODEL_CLUSTER_BYTES);
        if (result != FRAME_OK) { return result; }
    }
    return FRAME_OK;
}

int bin_pass(tuile_t *t) {
    bin_begin(t);
    for (unsigned i = 0; i < t->scene->instance_count; i++) {
        const int result = bin_instance(t, i);
        if (result != FRAME_OK) { return result; }
    }
    return FRAME_OK;
}

void bin_again(tuile_t *t, uint16_t row) {
    const int32_t top = row * t->config.tile_height;
    for (uint32_t r = row; r < t->pass_end; r++) {
        t->buckets[r] = RECORD_NONE;
    }
    for (uint32_t i = 0; i < t->record_count; i++) {
        record_t *record = frame_record(t, i);
        int32_t first, end;
        frame_record_rows(t, record, &first, &end);
        if (end <= top) { continue; }
        uint16_t *bucket = &t->buckets[(uint32_t)(first < top ? top : first) / t->config.tile_height];
        record->next = *bucket;
        *bucket = (uint16_t)(i + 1);
    }
}
