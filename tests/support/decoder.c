#include "decoder.h"

#include "../../raster/geometry/model.h"
#include "check.h"

#include <math.h>

uint32_t decoder_u32(const uint8_t *p) { return (uint32_t)p[0] + 256u * p[1] + 65536u * p[2] + 16777216u * p[3]; }
uint32_t decoder_u16(const uint8_t *p) { return (uint32_t)p[0] + 256u * p[1]; }
int32_t decoder_s16(const uint8_t *p) { return (int32_t)(decoder_u16(p) ^ 32768u) - 32768; }
static int32_t s8(const uint8_t *p) { return (int32_t)(p[0] ^ 128u) - 128; }

/* Bit by bit, as in the standard. */
uint32_t decoder_crc(const uint8_t *bytes, size_t size_bytes) {
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < 8 * size_bytes; i++) {
        uint32_t bit = ((uint32_t)bytes[i / 8] >> i % 8 ^ crc) & 1u;
        crc = crc >> 1 ^ (bit ? 0xedb88320 : 0);
    }
    return ~crc;
}

/* Reads everything and checks what has to hold of every model. */
static decoder_model_t read_model(const uint8_t *b, size_t size_bytes) {
    decoder_model_t m = {.bytes = b};
    assert_memory_equal(b, "TUIL", 4);
    assert_int_equal(decoder_u32(b + 4), size_bytes);
    assert_int_equal(decoder_u32(b + 8), decoder_crc(b + 12, size_bytes - 12));
    assert_int_equal(decoder_u16(b + 12), 3);
    m.vertex_count = decoder_u32(b + 16);
    m.face_count = decoder_u32(b + 20);
    m.cluster_count = decoder_u32(b + 24);
    m.material_count = decoder_u16(b + 32);
    m.step = ldexp(decoder_u32(b + 48), decoder_s16(b + 46));
    m.materials = b + decoder_u32(b + 88);
    m.faces = calloc(m.face_count, sizeof *m.faces);
    assert_non_null(m.faces);
    uint32_t vertex = 0, face = 0, largest = 0, corners_max = 0;
    for (int k = 0; k < 3; k++) {
        m.offset[k] = (int32_t)decoder_u32(b + 52 + 4 * k);
    }
    for (uint32_t k = 0; k < m.cluster_count; k++) {
        const uint8_t *c = b + decoder_u32(b + 72) + 28 * (size_t)k;
        uint32_t vertices = c[26], faces = decoder_u16(c + 24), radius = decoder_u16(c + 6);
        assert_int_equal(decoder_u32(c + 12), vertex);
        assert_int_equal(decoder_u32(c + 16), face);
        assert_int_equal(decoder_u32(c + 20) % 4, 0);
        assert_true(faces >= 1 && vertices >= 3 && vertices <= (c[27] == MODEL_CLUSTER_TRIANGLES ? 128u : 255u));
        largest = vertices > largest ? vertices : largest;
        for (uint32_t v = vertex; v < vertex + vertices; v++) { /* spheres hold their vertices, the model's all of them */
            const uint8_t *p = b + decoder_u32(b + 64) + 6 * (size_t)v;
            int64_t d = 0, whole = 0;
            for (int i = 0; i < 3; i++) {
                d += (int64_t)(decoder_s16(p + 2 * i) - decoder_s16(c + 2 * i)) * (decoder_s16(p + 2 * i) - decoder_s16(c + 2 * i));
                whole += (int64_t)(decoder_s16(p + 2 * i) - decoder_s16(b + 40 + 2 * i)) *
                         (decoder_s16(p + 2 * i) - decoder_s16(b + 40 + 2 * i));
            }
            assert_true(d <= (int64_t)radius * radius);
            assert_true(whole <= (int64_t)decoder_u16(b + 38) * decoder_u16(b + 38));
        }
        const uint8_t *at = b + decoder_u32(b + 76) + decoder_u32(c + 20);
        for (uint32_t f = face; f < face + faces; f++) {
            decoder_face_t *to = &m.faces[f];
            const uint8_t *corner = at;
            to->cluster = k;
            to->corners = 3;
            to->convex = true;
            if (c[27] == MODEL_CLUSTER_POLYGONS) {
                to->corners = at[0];
                to->convex = at[1] & MODEL_FACE_CONVEX;
                to->material = at[2];
                corner = at + 3;
                assert_int_equal(at[3 + to->corners], to->corners);
                at += 4 + to->corners;
            } else {
                to->material = at[3];
                at += 4;
            }
            corners_max = to->corners > corners_max ? to->corners : corners_max;
            assert_true(to->material < m.material_count);
            for (uint32_t i = 0; i < to->corners; i++) {
                assert_true(corner[i] < vertices);
                for (int j = 0; j < 3; j++) {
                    to->q[i][j] = decoder_s16(b + decoder_u32(b + 64) + 6 * (size_t)(vertex + corner[i]) + 2 * j);
                    to->normals[i][j] = (int8_t)s8(b + decoder_u32(b + 68) + 3 * (size_t)(vertex + corner[i]) + j);
                }
            }
            for (int j = 0; j < 3; j++) {
                to->plane[j] = (int8_t)s8(b + decoder_u32(b + 84) + 3 * (size_t)f + j);
            }
            to->source = f;
            if (decoder_u32(b + 92)) {
                bool wide = decoder_u16(b + 14) & MODEL_FLAG_SOURCE32;
                to->source = wide ? decoder_u32(b + decoder_u32(b + 92) + 4 * (size_t)f)
                                  : decoder_u16(b + decoder_u32(b + 92) + 2 * (size_t)f);
            }
            assert_true(to->source < decoder_u32(b + 28));
        }
        assert_true(at <= b + decoder_u32(b + 76) + decoder_u32(b + 80));
        vertex += vertices;
        face += faces;
    }
    assert_int_equal(vertex, m.vertex_count);
    assert_int_equal(face, m.face_count);
    assert_int_equal(largest, decoder_u16(b + 34));
    assert_int_equal(corners_max, decoder_u16(b + 36));
    return m;
}

void decoder_plane(const decoder_face_t *face, double n[3]) {
    n[0] = n[1] = n[2] = 0;
    for (uint32_t i = 0; i < face->corners; i++) {
        const int32_t *p = face->q[i], *q = face->q[(i + 1) % face->corners];
        for (int k = 0; k < 3; k++) {
            int y = (k + 1) % 3, z = (k + 2) % 3;
            n[k] += (double)p[y] * q[z] - (double)p[z] * q[y];
        }
    }
}

static double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static uint64_t random_state = 1;
double decoder_random_unit(void) { /* in -1 ... 1 */
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (double)(random_state >> 11) / 4503599627370496.0 - 1;
}

void decoder_random_seed(uint64_t seed) { random_state = seed; }

size_t decoder_check_cones(const decoder_model_t *m, int eyes) {
    size_t away = 0;
    for (int e = 0; e < eyes; e++) {
        double eye[3], far = e % 3 == 0 ? 40000 : 120000;
        for (int k = 0; k < 3; k++) {
            eye[k] = far * decoder_random_unit();
        }
        for (uint32_t f = 0; f < m->face_count; f++) {
            const uint8_t *c = m->bytes + decoder_u32(m->bytes + 72) + 28 * (size_t)m->faces[f].cluster;
            double d[3], axis[3], n[3];
            for (int k = 0; k < 3; k++) {
                d[k] = decoder_s16(c + 2 * k) - eye[k];
                axis[k] = s8(c + 8 + k);
            }
            double length = sqrt(dot3(axis, axis)), cutoff = c[11] / 254.0;
            bool perspective = dot3(d, axis) - decoder_u16(c + 6) * length >= cutoff * length * sqrt(dot3(d, d));
            bool orthographic = dot3(eye, axis) >= cutoff * length * sqrt(dot3(eye, eye));
            if (c[11] == 255 || !(perspective || orthographic)) { continue; }
            away++;
            decoder_plane(&m->faces[f], n);
            assert_true(!orthographic || dot3(eye, n) >= -1e-3 * sqrt(dot3(n, n)));
            for (uint32_t i = 0; perspective && i < m->faces[f].corners; i++) {
                const double view[3] = {m->faces[f].q[i][0] - eye[0], m->faces[f].q[i][1] - eye[1], m->faces[f].q[i][2] - eye[2]};
                assert_true(dot3(view, n) >= -1e-3 * sqrt(dot3(n, n)));
            }
        }
    }
    return away;
}

void decoder_check_faces(const decoder_model_t *m, const mesh_t *mesh) {
    uint8_t *met = calloc(mesh->source_face_count, 1);
    assert_non_null(met);
    for (uint32_t f = 0; f < m->face_count; f++) {
        const decoder_face_t *face = &m->faces[f];
        const mesh_face_t *from = NULL;
        for (size_t i = 0; i < mesh->face_count && !from; i++) {
            from = mesh->faces[i].source == face->source ? &mesh->faces[i] : NULL;
        }
        assert_non_null(from);
        assert_int_equal(met[face->source]++, 0);
        assert_int_equal(face->corners, from->count);
        assert_int_equal(face->material, from->material);
        for (uint32_t i = 0; i < face->corners; i++) {
            for (int k = 0; k < 3; k++) {
                double at = m->step * ((double)face->q[i][k] + m->offset[k]);
                assert_true(fabs(at - mesh->positions[mesh->corners[from->first + i]][k]) <= m->step * 0.5000001);
            }
        }
        double n[3];
        decoder_plane(face, n);
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(n[k] / sqrt(dot3(n, n)) - face->plane[k] / 127.0) < 0.0041);
        }
    }
    assert_int_equal(m->face_count, mesh->face_count);
    free(met);
}

void decoder_compile_mesh(compiled_t *c, const mesh_options_t *options) {
    sim_error_t error = {""};
    int status = mesh_compile(&c->mesh, options, &c->bytes, &c->size_bytes, &c->report, &error);
    assert_string_equal(error.text, "");
    assert_int_equal(status, 0);
    c->model = read_model(c->bytes, c->size_bytes);
    tuile_model_t opened;
    assert_int_equal(tuile_model_open(&opened, c->bytes, c->size_bytes), 0);
    assert_int_equal(c->report.faces, c->model.face_count);
    assert_int_equal(c->report.vertices, c->model.vertex_count);
    assert_int_equal(c->report.clusters, c->model.cluster_count);
    assert_int_equal(c->report.size_bytes, c->size_bytes);
}

compiled_t decoder_compile_file(const char *path, const mesh_options_t *options) {
    compiled_t c = {0};
    sim_error_t error = {""};
    int status = mesh_import(&c.mesh, path, &error);
    assert_string_equal(error.text, "");
    assert_int_equal(status, 0);
    decoder_compile_mesh(&c, options);
    return c;
}

void decoder_drop(compiled_t *c) {
    mesh_free(&c->mesh);
    free(c->bytes);
    free(c->model.faces);
    *c = (compiled_t){0};
}

const decoder_face_t *decoder_face_of_source(const decoder_model_t *m, uint32_t source) {
    for (uint32_t f = 0; f < m->face_count; f++) {
        if (m->faces[f].source == source) { return &m->faces[f]; }
    }
    fail_msg("no face has source %u", source);
    return NULL;
}
