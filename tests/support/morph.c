#include "morph.h"

#include "../../raster/geometry/model.h"
#include "check.h"

static void put16(uint8_t *at, uint32_t value) {
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
}

static void put32(uint8_t *at, uint32_t value) {
    put16(at, value);
    put16(at + 2, value >> 16);
}

static void move_all(const tuile_model_t *model, uint8_t *to, morph_position_fn position) {
    for (uint32_t v = 0; v < model->vertex_count; v++) {
        int16_t from[3], moved[3];
        memcpy(from, model->positions + 6 * (size_t)v, 6);
        position(model, from, moved);
        memcpy(to + 6 * (size_t)v, moved, 6);
    }
}

static void turn_all(const uint8_t *from, uint8_t *to, uint32_t count, morph_normal_fn normal) {
    for (uint32_t i = 0; i < count; i++) {
        int8_t a[3], b[3];
        memcpy(a, from + 3 * (size_t)i, 3);
        memcpy(b, a, 3);
        if (normal) { normal(a, b); }
        memcpy(to + 3 * (size_t)i, b, 3);
    }
}

/* Room behind the model for `extra` bytes; clusters as large as the model. */
static void copy(model_compiled_t *out, const model_compiled_t *from, size_t extra) {
    const tuile_model_t *model = &from->model;
    memset(out, 0, sizeof *out);
    out->size_bytes = (from->size_bytes + 3) / 4 * 4 + extra;
    out->bytes = calloc(1, out->size_bytes);
    assert_non_null(out->bytes);
    memcpy(out->bytes, from->bytes, from->size_bytes);
    for (uint32_t k = 0; k < model->cluster_count; k++) {
        uint8_t *cluster = out->bytes + (model->clusters - model->bytes) + (size_t)k * MODEL_CLUSTER_BYTES;
        for (unsigned i = 0; i < 3; i++) {
            put16(cluster + CLUSTER_AT_CENTRE + 2 * i, (uint32_t)model->centre[i]);
        }
        put16(cluster + CLUSTER_AT_RADIUS, model->radius);
        cluster[CLUSTER_AT_CUTOFF] = 255;
    }
}

static void finish(model_compiled_t *out) {
    put32(out->bytes + MODEL_AT_SIZE, (uint32_t)out->size_bytes);
    put32(out->bytes + MODEL_AT_CRC32, model_crc32(0, out->bytes + MODEL_AT_VERSION, out->size_bytes - MODEL_AT_VERSION));
    assert_int_equal(tuile_model_open(&out->model, out->bytes, out->size_bytes), TUILE_OK);
}

void morph_add(model_compiled_t *out, const model_compiled_t *from, morph_position_fn position, morph_normal_fn normal) {
    const tuile_model_t *model = &from->model;
    const size_t start = (from->size_bytes + 3) / 4 * 4, positions = (6 * (size_t)model->vertex_count + 3) / 4 * 4;
    const size_t normals = (3 * (size_t)model->vertex_count + 3) / 4 * 4, faces = (3 * (size_t)model->face_count + 3) / 4 * 4;
    copy(out, from, positions + normals + faces);
    move_all(model, out->bytes + start, position);
    turn_all(model->normals, out->bytes + start + positions, model->vertex_count, normal);
    turn_all(model->face_normals, out->bytes + start + positions + normals, model->face_count, normal);
    put32(out->bytes + MODEL_AT_MORPH_POSITIONS, (uint32_t)start);
    put32(out->bytes + MODEL_AT_MORPH_NORMALS, (uint32_t)(start + positions));
    put32(out->bytes + MODEL_AT_MORPH_FACE_NORMALS, (uint32_t)(start + positions + normals));
    finish(out);
}

void morph_apply(model_compiled_t *out, const model_compiled_t *from, morph_position_fn position, morph_normal_fn normal) {
    const tuile_model_t *model = &from->model;
    copy(out, from, 0);
    move_all(model, out->bytes + (model->positions - model->bytes), position);
    turn_all(model->normals, out->bytes + (model->normals - model->bytes), model->vertex_count, normal);
    turn_all(model->face_normals, out->bytes + (model->face_normals - model->bytes), model->face_count, normal);
    finish(out);
}
