/* Opening a compiled model: nothing in it is believed before it was checked, since it may come from a damaged file. */
#include "model.h"

#include "../memory.h"
#include "tree.h"

_Static_assert(sizeof(void *) >= 4 || sizeof(void *) == 2, "pointers");
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "compiled models are little-endian and read in place"
#endif

uint32_t model_crc32(uint32_t crc, const uint8_t *bytes, size_t size_bytes) {
    crc = ~crc;
    for (size_t i = 0; i < size_bytes; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) {
            crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
        }
    }
    return ~crc;
}

const uint8_t *model_section(const tuile_model_t *model, unsigned at, uint32_t count, uint32_t item_bytes) {
    const uint32_t offset = model_u32(model->bytes + at), size_bytes = model->size_bytes;
    const uint64_t length = (uint64_t)count * item_bytes;
    if (offset % 4 != 0 || offset < MODEL_HEADER_BYTES || offset > size_bytes || length > size_bytes - offset) { return NULL; }
    return model->bytes + offset;
}

/* Bytes of the faces of one cluster, 0 when any of them is wrong. */
static uint32_t check_faces(const tuile_model_t *model, const uint8_t *cluster, uint32_t face_bytes_size) {
    const uint32_t start = model_u32(cluster + CLUSTER_AT_FACE_BYTES);
    const unsigned vertices = cluster[CLUSTER_AT_VERTEX_COUNT], faces = model_u16(cluster + CLUSTER_AT_FACE_COUNT);
    uint32_t at = start;

    if (start % 4 != 0 || start > face_bytes_size) { return 0; }
    for (unsigned f = 0; f < faces; f++) {
        const uint8_t *face = model->faces + at;
        const uint32_t left = face_bytes_size - at;
        unsigned corners = 3, material;
        const uint8_t *corner = face;
        if (cluster[CLUSTER_AT_KIND] == MODEL_CLUSTER_TRIANGLES) {
            if (left < 4) { return 0; }
            material = face[3];
            at += 4;
        } else {
            if (left < MODEL_POLYGON_BYTES(3) || face[0] < 3 || left < MODEL_POLYGON_BYTES(face[0]) ||
                face[3 + face[0]] != face[0]) {
                return 0;
            }
            corners = face[0];
            material = face[2];
            corner = face + 3;
            at += MODEL_POLYGON_BYTES(corners);
        }
        if (material >= model->material_count || corners > model->corners_max) { return 0; }
        for (unsigned c = 0; c < corners; c++) {
            if (corner[c] >= vertices) { return 0; }
        }
    }
    return at - start;
}

static bool check_clusters(const tuile_model_t *model, uint32_t face_bytes_size) {
    uint32_t vertex = 0, face = 0;
    for (uint32_t k = 0; k < model->cluster_count; k++) {
        const uint8_t *cluster = model->clusters + (size_t)k * MODEL_CLUSTER_BYTES;
        const unsigned vertices = cluster[CLUSTER_AT_VERTEX_COUNT], faces = model_u16(cluster + CLUSTER_AT_FACE_COUNT);
        const unsigned kind = cluster[CLUSTER_AT_KIND];
        if (vertices < 3 || vertices > model->cluster_vertices_max || faces == 0 || kind > MODEL_CLUSTER_POLYGONS ||
            (kind == MODEL_CLUSTER_TRIANGLES && vertices > MODEL_TRIANGLE_CLUSTER_VERTICES) ||
            model_u32(cluster + CLUSTER_AT_FIRST_VERTEX) != vertex || model_u32(cluster + CLUSTER_AT_FIRST_FACE) != face ||
            vertices > model->vertex_count - vertex || faces > model->face_count - face ||
            check_faces(model, cluster, face_bytes_size) == 0) {
            return false;
        }
        vertex += vertices;
        face += faces;
    }
    return vertex == model->vertex_count && face == model->face_count;
}

bool model_in_box(const tuile_model_t *model, const uint8_t *positions) {
    for (uint32_t v = 0; v < model->vertex_count; v++) {
        for (unsigned i = 0; i < 3; i++, positions += 2) {
            if (model_i16(positions) < model->low[i] || model_i16(positions) > model->high[i]) { return false; }
        }
    }
    return true;
}

int tuile_model_open(tuile_model_t *model, const void *data, size_t size_bytes) {
    const uint8_t *bytes = data;
    tuile_model_t m;

    if (model == NULL || bytes == NULL || (uintptr_t)bytes % 4 != 0) { return TUILE_ERROR_ARGUMENT; }
    if (size_bytes < MODEL_HEADER_BYTES || size_bytes > UINT32_MAX) { return TUILE_ERROR_MODEL; }
    m.bytes = bytes;
    m.size_bytes = (uint32_t)size_bytes;
    m.flags = model_u16(bytes + MODEL_AT_FLAGS);
    if (model_u32(bytes + MODEL_AT_MAGIC) != MODEL_MAGIC || model_u16(bytes + MODEL_AT_VERSION) != MODEL_VERSION ||
        model_u32(bytes + MODEL_AT_SIZE) != size_bytes || (m.flags & ~MODEL_FLAG_SOURCE32) != 0 ||
        model_crc32(0, bytes + MODEL_AT_VERSION, size_bytes - MODEL_AT_VERSION) != model_u32(bytes + MODEL_AT_CRC32)) {
        return TUILE_ERROR_MODEL;
    }
    m.vertex_count = model_u32(bytes + MODEL_AT_VERTICES);
    m.face_count = model_u32(bytes + MODEL_AT_FACES);
    m.cluster_count = model_u32(bytes + MODEL_AT_CLUSTERS);
    m.source_face_count = model_u32(bytes + MODEL_AT_SOURCE_FACES);
    m.material_count = model_u16(bytes + MODEL_AT_MATERIALS);
    m.cluster_vertices_max = model_u16(bytes + MODEL_AT_CLUSTER_MAX);
    m.corners_max = model_u16(bytes + MODEL_AT_CORNERS_MAX);
    m.radius = model_u16(bytes + MODEL_AT_RADIUS);
    m.step = (tuile_scale_t){model_u32(bytes + MODEL_AT_STEP_MANTISSA), model_i16(bytes + MODEL_AT_STEP_EXPONENT)};
    for (unsigned i = 0; i < 3; i++) {
        m.centre[i] = model_i16(bytes + MODEL_AT_CENTRE + 2 * i);
        m.offset[i] = (int32_t)model_u32(bytes + MODEL_AT_OFFSET + 4 * i);
        m.low[i] = model_i16(bytes + MODEL_AT_LOW + 2 * i);
        m.high[i] = model_i16(bytes + MODEL_AT_HIGH + 2 * i);
    }
    if (m.face_count == 0 || m.cluster_count == 0 || m.material_count == 0 || m.material_count > 256 || m.step.mantissa == 0 ||
        m.step.exponent < -1000 || m.step.exponent > 1000 || m.cluster_vertices_max > 255 || m.corners_max > 255) {
        return TUILE_ERROR_MODEL;
    }
    const uint32_t face_bytes_size = model_u32(bytes + MODEL_AT_FACE_BYTES_SIZE);
    m.positions = model_section(&m, MODEL_AT_POSITIONS, m.vertex_count, 6);
    m.normals = model_section(&m, MODEL_AT_NORMALS, m.vertex_count, 3);
    m.clusters = model_section(&m, MODEL_AT_CLUSTER_TABLE, m.cluster_count, MODEL_CLUSTER_BYTES);
    m.faces = model_section(&m, MODEL_AT_FACE_BYTES, face_bytes_size, 1);
    m.face_normals = model_section(&m, MODEL_AT_FACE_NORMALS, m.face_count, 3);
    m.source = NULL;
    if (!m.positions || !m.normals || !m.clusters || !m.faces || !m.face_normals || !model_open_surface(&m)) {
        return TUILE_ERROR_MODEL;
    }
    if (model_u32(bytes + MODEL_AT_SOURCE) != 0) {
        m.source = model_section(&m, MODEL_AT_SOURCE, m.face_count, m.flags & MODEL_FLAG_SOURCE32 ? 4 : 2);
        if (!m.source) { return TUILE_ERROR_MODEL; }
    }
    if (!check_clusters(&m, face_bytes_size) || !model_in_box(&m, m.positions)) { return TUILE_ERROR_MODEL; }
    m.fractions = NULL;
    if (model_u32(bytes + MODEL_AT_FRACTIONS) != 0) {
        m.fractions = model_section(&m, MODEL_AT_FRACTIONS, m.vertex_count, 3);
        if (!m.fractions) { return TUILE_ERROR_MODEL; }
    }
    m.tree = NULL;
    m.tree_words = model_u32(bytes + MODEL_AT_TREE_WORDS);
    m.tree_depth = model_u16(bytes + MODEL_AT_TREE_DEPTH);
    if (model_u32(bytes + MODEL_AT_TREE) != 0) {
        m.tree = model_section(&m, MODEL_AT_TREE, m.tree_words, 4);
        if (!m.tree || !tree_check(&m)) { return TUILE_ERROR_MODEL; }
    } else if (m.tree_words != 0 || m.tree_depth != 0) {
        return TUILE_ERROR_MODEL;
    }
    if (!model_open_morph(&m)) { return TUILE_ERROR_MODEL; }
    memcpy(model, &m, sizeof m);
    return TUILE_OK;
}

uint32_t tuile_model_source_face(const tuile_model_t *model, uint32_t face) {
    if (model->source == NULL || face >= model->face_count) { return face; }
    return model->flags & MODEL_FLAG_SOURCE32 ? model_u32(model->source + 4 * (size_t)face)
                                              : model_u16(model->source + 2 * (size_t)face);
}
