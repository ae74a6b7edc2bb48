/* The model compiler: what it makes of small models whose outcome is known by hand, of damaged files, and, by brute force,
 * whether the spheres and cones it writes say the truth. The bytes are read back by a reader of our own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <dirent.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../raster/geometry/model.h"
#include "../sim/mesh/mesh.h"
#include "../sim/mesh/stages.h"

/* ---- a folder for models ----------------------------------------------------------------------------------- */

static char folder[64];

static int make_folder(void **state) {
    (void)state;
    (void)snprintf(folder, sizeof folder, "/tmp/test_mesh_XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static size_t files_in_folder(bool remove_them) {
    size_t count = 0;
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));) {
        char path[400];
        if (entry->d_name[0] == '.') { continue; }
        count++;
        (void)snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (remove_them && unlink(path)) { (void)rmdir(path); }
    }
    (void)closedir(directory);
    return count;
}

static int remove_folder(void **state) {
    (void)state;
    (void)files_in_folder(true);
    return rmdir(folder);
}

static const char *path_of(const char *name) {
    static char path[128];
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static const char *put_bytes(const char *name, const void *bytes, size_t size_bytes) {
    const char *path = path_of(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size_bytes, file), size_bytes);
    assert_int_equal(fclose(file), 0);
    return path;
}

static const char *put_text(const char *name, const char *text) { return put_bytes(name, text, strlen(text)); }

/* ---- a reader of models ------------------------------------------------------------------------------------ */

typedef struct read_face {
    uint32_t cluster, corners, material, source;
    bool convex;
    int32_t q[255][3];
    int8_t normals[255][3], plane[3];
} read_face_t;

typedef struct read_model {
    read_face_t *faces;
    uint32_t face_count, vertex_count, cluster_count, material_count;
    double step;
    int32_t offset[3];
    const uint8_t *bytes, *materials;
} read_model_t;

static uint32_t u32(const uint8_t *p) { return (uint32_t)p[0] + 256u * p[1] + 65536u * p[2] + 16777216u * p[3]; }
static uint32_t u16(const uint8_t *p) { return (uint32_t)p[0] + 256u * p[1]; }
static int32_t s16(const uint8_t *p) { return (int32_t)(u16(p) ^ 32768u) - 32768; }
static int32_t s8(const uint8_t *p) { return (int32_t)(p[0] ^ 128u) - 128; }

/* Bit by bit, as in the standard. */
static uint32_t crc_of(const uint8_t *bytes, size_t size_bytes) {
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < 8 * size_bytes; i++) {
        uint32_t bit = ((uint32_t)bytes[i / 8] >> i % 8 ^ crc) & 1u;
        crc = crc >> 1 ^ (bit ? 0xedb88320 : 0);
    }
    return ~crc;
}

/* Reads everything and checks what has to hold of every model. */
static read_model_t read_model(const uint8_t *b, size_t size_bytes) {
    read_model_t m = {.bytes = b};
    assert_memory_equal(b, "TUIL", 4);
    assert_int_equal(u32(b + 4), size_bytes);
    assert_int_equal(u32(b + 8), crc_of(b + 12, size_bytes - 12));
    assert_int_equal(u16(b + 12), 1);
    m.vertex_count = u32(b + 16);
    m.face_count = u32(b + 20);
    m.cluster_count = u32(b + 24);
    m.material_count = u16(b + 32);
    m.step = ldexp(u32(b + 48), s16(b + 46));
    m.materials = b + u32(b + 88);
    m.faces = calloc(m.face_count, sizeof *m.faces);
    assert_non_null(m.faces);
    uint32_t vertex = 0, face = 0, largest = 0, corners_max = 0;
    for (int k = 0; k < 3; k++) {
        m.offset[k] = (int32_t)u32(b + 52 + 4 * k);
    }
    for (uint32_t k = 0; k < m.cluster_count; k++) {
        const uint8_t *c = b + u32(b + 72) + 28 * (size_t)k;
        uint32_t vertices = c[26], faces = u16(c + 24), radius = u16(c + 6);
        assert_int_equal(u32(c + 12), vertex);
        assert_int_equal(u32(c + 16), face);
        assert_int_equal(u32(c + 20) % 4, 0);
        assert_true(faces >= 1 && vertices >= 3 && vertices <= (c[27] == MODEL_CLUSTER_TRIANGLES ? 128u : 255u));
        largest = vertices > largest ? vertices : largest;
        for (uint32_t v = vertex; v < vertex + vertices; v++) { /* spheres hold their vertices, the model's all of them */
            const uint8_t *p = b + u32(b + 64) + 6 * (size_t)v;
            int64_t d = 0, whole = 0;
            for (int i = 0; i < 3; i++) {
                d += (int64_t)(s16(p + 2 * i) - s16(c + 2 * i)) * (s16(p + 2 * i) - s16(c + 2 * i));
                whole += (int64_t)(s16(p + 2 * i) - s16(b + 40 + 2 * i)) * (s16(p + 2 * i) - s16(b + 40 + 2 * i));
            }
            assert_true(d <= (int64_t)radius * radius);
            assert_true(whole <= (int64_t)u16(b + 38) * u16(b + 38));
        }
        const uint8_t *at = b + u32(b + 76) + u32(c + 20);
        for (uint32_t f = face; f < face + faces; f++) {
            read_face_t *to = &m.faces[f];
            const uint8_t *corner = at;
            to->cluster = k;
            to->corners = 3;
            to->convex = true;
            if (c[27] == MODEL_CLUSTER_POLYGONS) {
                to->corners = at[0];
                to->convex = at[1] & MODEL_FACE_CONVEX;
                to->material = at[2];
                corner = at + 3;
                at += 3 + to->corners;
            } else {
                to->material = at[3];
                at += 4;
            }
            corners_max = to->corners > corners_max ? to->corners : corners_max;
            assert_true(to->material < m.material_count);
            for (uint32_t i = 0; i < to->corners; i++) {
                assert_true(corner[i] < vertices);
                for (int j = 0; j < 3; j++) {
                    to->q[i][j] = s16(b + u32(b + 64) + 6 * (size_t)(vertex + corner[i]) + 2 * j);
                    to->normals[i][j] = (int8_t)s8(b + u32(b + 68) + 3 * (size_t)(vertex + corner[i]) + j);
                }
            }
            for (int j = 0; j < 3; j++) {
                to->plane[j] = (int8_t)s8(b + u32(b + 84) + 3 * (size_t)f + j);
            }
            to->source = f;
            if (u32(b + 92)) {
                bool wide = u16(b + 14) & MODEL_FLAG_SOURCE32;
                to->source = wide ? u32(b + u32(b + 92) + 4 * (size_t)f) : u16(b + u32(b + 92) + 2 * (size_t)f);
            }
            assert_true(to->source < u32(b + 28));
        }
        assert_true(at <= b + u32(b + 76) + u32(b + 80));
        vertex += vertices;
        face += faces;
    }
    assert_int_equal(vertex, m.vertex_count);
    assert_int_equal(face, m.face_count);
    assert_int_equal(largest, u16(b + 34));
    assert_int_equal(corners_max, u16(b + 36));
    return m;
}

static void plane_of(const read_face_t *face, double n[3]) {
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
static double random_unit(void) { /* in -1 ... 1 */
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return (double)(random_state >> 11) / 4503599627370496.0 - 1;
}

/* A cluster that is said to face away has only faces that do, from any eye or direction. Returns how many were. */
static size_t check_cones(const read_model_t *m, int eyes) {
    size_t away = 0;
    for (int e = 0; e < eyes; e++) {
        double eye[3], far = e % 3 == 0 ? 40000 : 120000;
        for (int k = 0; k < 3; k++) {
            eye[k] = far * random_unit();
        }
        for (uint32_t f = 0; f < m->face_count; f++) {
            const uint8_t *c = m->bytes + u32(m->bytes + 72) + 28 * (size_t)m->faces[f].cluster;
            double d[3], axis[3], n[3];
            for (int k = 0; k < 3; k++) {
                d[k] = s16(c + 2 * k) - eye[k];
                axis[k] = s8(c + 8 + k);
            }
            double length = sqrt(dot3(axis, axis)), cutoff = c[11] / 254.0;
            bool perspective = dot3(d, axis) - u16(c + 6) * length >= cutoff * length * sqrt(dot3(d, d));
            bool orthographic = dot3(eye, axis) >= cutoff * length * sqrt(dot3(eye, eye));
            if (c[11] == 255 || !(perspective || orthographic)) { continue; }
            away++;
            plane_of(&m->faces[f], n);
            assert_true(!orthographic || dot3(eye, n) >= -1e-3 * sqrt(dot3(n, n)));
            for (uint32_t i = 0; perspective && i < m->faces[f].corners; i++) {
                const double view[3] = {m->faces[f].q[i][0] - eye[0], m->faces[f].q[i][1] - eye[1], m->faces[f].q[i][2] - eye[2]};
                assert_true(dot3(view, n) >= -1e-3 * sqrt(dot3(n, n)));
            }
        }
    }
    return away;
}

/* Every face stands where the mesh has it, with its winding, its first corner first, to within half a step on each axis. */
static void check_faces(const read_model_t *m, const mesh_t *mesh) {
    uint8_t *met = calloc(mesh->source_face_count, 1);
    assert_non_null(met);
    for (uint32_t f = 0; f < m->face_count; f++) {
        const read_face_t *face = &m->faces[f];
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
        plane_of(face, n);
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(n[k] / sqrt(dot3(n, n)) - face->plane[k] / 127.0) < 0.0041);
        }
    }
    assert_int_equal(m->face_count, mesh->face_count);
    free(met);
}

typedef struct compiled {
    mesh_t mesh;
    mesh_report_t report;
    uint8_t *bytes;
    size_t size_bytes;
    read_model_t model;
} compiled_t;

static void compile_mesh(compiled_t *c, const mesh_options_t *options) {
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

static compiled_t compile_file(const char *path, const mesh_options_t *options) {
    compiled_t c = {0};
    sim_error_t error = {""};
    int status = mesh_import(&c.mesh, path, &error);
    assert_string_equal(error.text, "");
    assert_int_equal(status, 0);
    compile_mesh(&c, options);
    return c;
}

static void drop(compiled_t *c) {
    mesh_free(&c->mesh);
    free(c->bytes);
    free(c->model.faces);
    *c = (compiled_t){0};
}

static const read_face_t *face_of_source(const read_model_t *m, uint32_t source) {
    for (uint32_t f = 0; f < m->face_count; f++) {
        if (m->faces[f].source == source) { return &m->faces[f]; }
    }
    fail_msg("no face has source %u", source);
    return NULL;
}

/* ---- models ------------------------------------------------------------------------------------------------ */

#define CUBE_VERTICES "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
#define CUBE_FACES "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n"
#define SQUARE "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n"

static void test_cube(void **state) {
    (void)state;
    compiled_t c = compile_file(put_text("cube.obj", CUBE_VERTICES CUBE_FACES), NULL);
    assert_int_equal(c.mesh.position_count, 8);
    assert_int_equal(c.mesh.source_face_count, 6);
    assert_int_equal(c.report.faces, 6);
    assert_int_equal(c.report.polygons, 6);
    assert_int_equal(c.report.non_planar + c.report.split + c.report.skipped, 0);
    assert_true(c.report.quantisation_error == 0);
    assert_true(c.model.step == 1.0 / 16384); /* the finest power of two that holds 1 in 32767 steps */
    check_faces(&c.model, &c.mesh);
    const int8_t planes[6][3] = {{0, 0, -127}, {0, 0, 127}, {0, -127, 0}, {0, 127, 0}, {-127, 0, 0}, {127, 0, 0}};
    for (uint32_t s = 0; s < 6; s++) { /* edges of 90 degrees are not smoothed: all normals are the plane's */
        const read_face_t *face = face_of_source(&c.model, s);
        assert_memory_equal(face->plane, planes[s], 3);
        assert_true(face->convex);
        for (int i = 0; i < 4; i++) {
            assert_memory_equal(face->normals[i], planes[s], 3);
        }
    }
    assert_true(check_cones(&c.model, 300) > 0);
    drop(&c);
}

static void test_smooth_normals(void **state) {
    (void)state;
    /* Two squares with 45 degrees between them: smooth across the shared edge x = 0, flat at the other ends. */
    compiled_t c = compile_file(put_text("roof.obj", "v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv -1 1 1\nv -1 0 1\n"
                                                     "f 4 3 2 1\nf 1 2 5 6\n"),
                                NULL);
    const read_face_t *flat = face_of_source(&c.model, 0);
    /* Halfway between (0, 0, 1) and (1, 0, 1) / sqrt 2: sin and cos of 22.5 degrees are 0.38268 and 0.92388. */
    const int8_t own[3] = {0, 0, 127}, mean[3] = {49, 0, 117};
    assert_memory_equal(flat->normals[0], own, 3);
    assert_memory_equal(flat->normals[1], own, 3);
    assert_memory_equal(flat->normals[2], mean, 3);
    assert_memory_equal(flat->normals[3], mean, 3);
    drop(&c);
}

static void test_file_normals(void **state) {
    (void)state;
    compiled_t c = compile_file(put_text("lit.obj", SQUARE "vn 0 0 2\nvn 0 3 0\nf 1//1 2//1 3//2 4//2\n"), NULL);
    const int8_t along_z[3] = {0, 0, 127}, along_y[3] = {0, 127, 0};
    assert_memory_equal(c.model.faces[0].normals[1], along_z, 3);
    assert_memory_equal(c.model.faces[0].normals[2], along_y, 3);
    drop(&c);
}

static void test_two_materials(void **state) {
    (void)state;
    (void)put_text("two.mtl", "newmtl red\nKd 1 0.2 0\nnewmtl blue\nKd 0 0.4 0.8\n");
    compiled_t c = compile_file(put_text("two.obj", "mtllib two.mtl\n" CUBE_VERTICES "usemtl red\nf 1 4 3 2\nf 5 6 7 8\n"
                                                    "usemtl blue\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n"),
                                NULL);
    const uint8_t colours[8] = {255, 51, 0, 0, 0, 102, 204, 0};
    assert_int_equal(c.model.material_count, 2);
    assert_memory_equal(c.model.materials, colours, 8);
    assert_int_equal(c.mesh.position_count, 8); /* joined across the two */
    check_faces(&c.model, &c.mesh);
    assert_int_equal(face_of_source(&c.model, 1)->material, 0);
    assert_int_equal(face_of_source(&c.model, 2)->material, 1);
    drop(&c);
}

static void test_vertex_colours(void **state) {
    (void)state;
    compiled_t c =
        compile_file(put_text("colours.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                             "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                                             "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                                             "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 30 0\n1 1 0 0 0 90\n"
                                             "3 0 1 2\n3 1 3 2\n"),
                     NULL);
    const uint8_t first[3] = {255, 10, 0}, second[3] = {170, 10, 30};
    assert_memory_equal(c.model.materials + 4 * (size_t)face_of_source(&c.model, 0)->material, first, 3);
    assert_memory_equal(c.model.materials + 4 * (size_t)face_of_source(&c.model, 1)->material, second, 3);
    drop(&c);
}

static void test_palette(void **state) {
    (void)state;
    static uint8_t colours[4096][3], palette[256][3];
    static uint32_t index[4096];
    size_t count;
    for (int i = 0; i < 4096; i++) {
        colours[i][0] = (uint8_t)(i % 16 * 17);
        colours[i][1] = (uint8_t)(i / 16 % 16 * 17);
        colours[i][2] = (uint8_t)(i / 256 * 17);
    }
    assert_int_equal(mesh_palette((const uint8_t(*)[3])colours, 256, palette, &count, index), 0);
    assert_int_equal(count, 256);
    for (size_t i = 0; i < 256; i++) { /* 256 colours are kept, in order of first use */
        assert_int_equal(index[i], i);
        assert_memory_equal(palette[i], colours[i], 3);
    }
    assert_int_equal(mesh_palette((const uint8_t(*)[3])colours, 4096, palette, &count, index), 0);
    assert_int_equal(count, 256);
    for (size_t i = 0; i < 4096; i++) { /* 16 neighbours to a colour: within two levels of 17 in each channel */
        for (int k = 0; k < 3; k++) {
            assert_true(abs(palette[index[i]][k] - colours[i][k]) <= 34);
        }
    }
}

/* ---- polygons ---------------------------------------------------------------------------------------------- */

static void test_concave(void **state) {
    (void)state;
    /* An arrow head; lit evenly it stays one face that is not convex. */
    const char *arrow = "v 0 0 0\nv 4 -2 0\nv 0 4 0\nv -4 -2 0\n";
    char text[200];
    (void)snprintf(text, sizeof text, "%sf 1 2 3 4\n", arrow);
    compiled_t c = compile_file(put_text("arrow.obj", text), NULL);
    assert_int_equal(c.report.faces, 1);
    assert_int_equal(c.report.split, 0);
    assert_false(c.model.faces[0].convex);
    check_faces(&c.model, &c.mesh);
    drop(&c);
    /* Lit unevenly it is cut through the reflex corner: the only cut there is. */
    (void)snprintf(text, sizeof text, "%svn 0 0 1\nvn 0 1 1\nf 1//1 2//1 3//2 4//2\n", arrow);
    c = compile_file(put_text("arrow.obj", text), NULL);
    assert_int_equal(c.report.faces, 2);
    assert_int_equal(c.report.split, 1);
    assert_int_equal(c.report.non_planar, 0);
    for (uint32_t f = 0; f < 2; f++) {
        double n[3];
        int reflex = 0;
        assert_int_equal(c.model.faces[f].source, 0);
        plane_of(&c.model.faces[f], n);
        assert_true(n[2] > 0);
        for (int i = 0; i < 3; i++) {
            reflex += c.model.faces[f].q[i][0] == 0 && c.model.faces[f].q[i][1] == 0;
        }
        assert_int_equal(reflex, 1);
    }
    drop(&c);
}

static void test_non_planar(void **state) {
    (void)state;
    compiled_t c = compile_file(put_text("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.25\nv 0 1 0\nf 1 2 3 4\n"), NULL);
    assert_int_equal(c.report.non_planar, 1);
    assert_int_equal(c.report.faces, 2);
    assert_int_equal(c.report.polygons, 0);
    drop(&c);
    const mesh_options_t keep = {.keep_planar = true, .keep_order = true};
    c = compile_file(path_of("bent.obj"), &keep);
    assert_int_equal(c.report.non_planar, 0);
    assert_int_equal(c.report.faces, 1);
    assert_int_equal(c.report.polygons, 1);
    drop(&c);
    /* A step is 1 / 16384 here; the corners are 1/4 of the lift off the plane: 3 steps of lift pass, 5 do not. */
    c = compile_file(put_text("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.00018310546875\nv 0 1 0\nf 1 2 3 4\n"), NULL);
    assert_int_equal(c.report.non_planar, 0);
    drop(&c);
    c = compile_file(put_text("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.00030517578125\nv 0 1 0\nf 1 2 3 4\n"), NULL);
    assert_int_equal(c.report.non_planar, 1);
    drop(&c);
}

static void test_many_corners(void **state) {
    (void)state;
    char text[40000];
    const int sizes[3] = {255, 256, 1000};
    for (int s = 0; s < 3; s++) {
        size_t at = 0;
        for (int i = 0; i < sizes[s]; i++) {
            double angle = 2 * 3.14159265358979 * i / sizes[s];
            at += (size_t)snprintf(text + at, sizeof text - at, "v %.5f %.5f 0\n", cos(angle), sin(angle));
        }
        at += (size_t)snprintf(text + at, sizeof text - at, "f");
        for (int i = 1; i <= sizes[s]; i++) {
            at += (size_t)snprintf(text + at, sizeof text - at, " %d", i);
        }
        (void)snprintf(text + at, sizeof text - at, "\n");
        compiled_t c = compile_file(put_text("disc.obj", text), NULL);
        assert_int_equal(c.report.faces, sizes[s] == 255 ? 1 : sizes[s] - 2);
        assert_int_equal(c.report.split, sizes[s] == 255 ? 0 : 1);
        assert_int_equal(u16(c.bytes + 36), sizes[s] == 255 ? 255 : 3);
        drop(&c);
    }
}

static void test_degenerate_faces(void **state) {
    (void)state;
    /* One corner twice, all corners at two places, collinear corners, and points and lines, which are no faces. */
    compiled_t c = compile_file(put_text("bad.obj", SQUARE "v 8 0 0\nf 1 1 2\nf 1 2 3\nf 1 2 1 2\nf 1 2 5\nf 1 3 3 4\n"), NULL);
    assert_int_equal(c.mesh.source_face_count, 5);
    assert_int_equal(c.mesh.skipped_count, 2);
    assert_int_equal(c.report.skipped, 3);
    assert_int_equal(c.report.faces, 2);
    assert_int_equal(face_of_source(&c.model, 4)->corners, 3); /* a quad that repeats a corner is a triangle */
    (void)face_of_source(&c.model, 1);
    drop(&c);
    c = compile_file(put_text("loose.obj", SQUARE "f 1 2 3\nl 1 2 3\np 4\n"), NULL);
    assert_int_equal(c.report.faces, 1);
    assert_int_equal(c.mesh.source_face_count, 1);
    assert_int_equal(c.mesh.loose_count, 3);
    drop(&c);
    /* 1 / 70000 of the model is less than a step: that triangle vanishes in the rounding. */
    c = compile_file(put_text("speck.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.3 0.3 0.1\nv 0.300001 0.3 0.1\nv 0.3 0.300001 0.1\n"
                                           "f 1 2 3\nf 4 5 6\n"),
                     NULL);
    assert_int_equal(c.report.faces, 1);
    assert_int_equal(c.report.skipped, 1);
    drop(&c);
}

/* ---- ear clipping ------------------------------------------------------------------------------------------ */

typedef struct outline {
    const char *what;
    int32_t points[16][3];
    size_t count;
    long triangles; /* -1: any number */
    int64_t twice;  /* area */
} outline_t;

static void test_triangulate(void **state) {
    (void)state;
    static const outline_t outlines[] = {
        {"a triangle", {{0, 0, 5}, {4, 0, 5}, {0, 4, 5}}, 3, 1, 16},
        {"a square", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 4, 2, 32},
        {"an arrow head", {{0, 0, 0}, {4, -2, 0}, {0, 4, 0}, {-4, -2, 0}}, 4, 2, 32},
        {"a corner amid each side",
         {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {4, 4, 0}, {2, 4, 0}, {0, 4, 0}, {0, 2, 0}},
         8,
         6,
         32},
        {"a repeated corner", {{0, 0, 0}, {4, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 5, 2, 32},
        {"a spike", {{0, 0, 0}, {4, 0, 0}, {9, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 6, -1, 32},
        {"a comb", {{0, 0, 0}, {8, 0, 0}, {8, 4, 0}, {6, 1, 0}, {5, 4, 0}, {4, 1, 0}, {3, 4, 0}, {2, 1, 0}, {0, 4, 0}}, 9, 7, 40},
        {"a hole joined by a bridge",
         {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0}, {3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}, {3, 3, 0}},
         10,
         8,
         144},
        {"one that touches itself", {{0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 0}}, 6, -1, 16},
        {"no area", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}, 4, 0, 0},
    };
    for (size_t o = 0; o < sizeof outlines / sizeof *outlines; o++) {
        const outline_t *outline = &outlines[o];
        for (int axis = 0; axis < 3; axis++) {
            for (size_t turn = 0; turn < outline->count; turn++) { /* from every side, beginning anywhere */
                int32_t points[16][3];
                uint32_t triangles[16][3];
                int64_t twice = 0;
                for (size_t i = 0; i < outline->count; i++) {
                    for (int k = 0; k < 3; k++) {
                        points[i][(k + axis) % 3] = outline->points[(i + turn) % outline->count][k];
                    }
                }
                long count = mesh_triangulate((const int32_t(*)[3])points, outline->count, triangles);
                for (long t = 0; t < count; t++) {
                    const int32_t *a = points[triangles[t][0]], *b = points[triangles[t][1]], *c = points[triangles[t][2]];
                    int x = axis % 3, y = (axis + 1) % 3;
                    int64_t area = (int64_t)(b[x] - a[x]) * (c[y] - a[y]) - (int64_t)(b[y] - a[y]) * (c[x] - a[x]);
                    assert_true(area > 0);
                    twice += area;
                }
                if (twice != outline->twice || (outline->triangles >= 0 && count != outline->triangles)) {
                    fail_msg("%s from corner %zu: %ld triangles with twice the area %lld", outline->what, turn, count,
                             (long long)twice);
                }
            }
        }
    }
}

/* Star-shaped polygons of any jaggedness: the areas of the triangles add up to the polygon's. */
static void test_triangulate_stars(void **state) {
    (void)state;
    enum { CORNERS = 60 };
    for (int round = 0; round < 200; round++) {
        int32_t points[CORNERS][3];
        uint32_t triangles[CORNERS][3];
        int64_t whole = 0, sum = 0;
        for (int i = 0; i < CORNERS; i++) {
            double angle = 2 * 3.14159265358979 * i / CORNERS,
                   radius = round % 2 ? 20 + 15 * random_unit() : 6e7 + 5e7 * random_unit();
            points[i][0] = (int32_t)(radius * cos(angle));
            points[i][1] = (int32_t)(radius * sin(angle));
            points[i][2] = 0;
        }
        for (int i = 0; i < CORNERS; i++) {
            const int32_t *p = points[i], *q = points[(i + 1) % CORNERS];
            whole += (int64_t)p[0] * q[1] - (int64_t)p[1] * q[0];
        }
        long count = mesh_triangulate((const int32_t(*)[3])points, CORNERS, triangles);
        for (long t = 0; t < count; t++) {
            const int32_t *a = points[triangles[t][0]], *b = points[triangles[t][1]], *c = points[triangles[t][2]];
            sum += (int64_t)(b[0] - a[0]) * (c[1] - a[1]) - (int64_t)(b[1] - a[1]) * (c[0] - a[0]);
        }
        assert_true(sum == whole || round % 2); /* on the coarse grid corners may fold over one another */
    }
}

/* ---- damaged files ----------------------------------------------------------------------------------------- */

typedef struct damage {
    const char *file, *text, *words; /* the error has to contain */
} damage_t;

static void test_damaged_files(void **state) {
    (void)state;
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                              "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    static const damage_t damages[] = {
        {"empty.obj", "", "is empty"},
        {"vertices.obj", SQUARE, "no face"},
        {"noise.obj", "\x01\x02 what is this\n\xff\xfe\n", "no face"},
        {"range.obj", SQUARE "f 1 2 3\nf 1 2 9\n", ":6: the face asks for vertex 9, but there are 4"},
        {"zero.obj", SQUARE "f 0 1 2\n", ":5: the face asks for vertex 0"},
        {"back.obj", SQUARE "f -1 -2 -5\n", ":5: the face asks for vertex -5"},
        {"normal.obj", SQUARE "vn 0 0 1\nf 1//1 2//1 3//2\n", ":6: the face asks for normal 2, but there are 1"},
        {"word.obj", SQUARE "f 1 2 x\n", ":5: \"x\" is no corner"},
        {"bare.obj", SQUARE "f\nf 1 2 3\n", ":5: a face with 0 corners: the file is damaged"},
        {"cut.obj", SQUARE "f 1 2 3\nf 1 3", ":6: a face with 2 corners: the file is cut short"},
        {"cut2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 2 3", ":5: vertex 4 has 2 of 3 coordinates: the file is cut short"},
        {"text.obj", "v 0 0 0\nv 1 x 0\nv 0 1 0\nf 1 2 3\n", ":2: vertex 2 has 1 of 3 coordinates: the file is damaged"},
        {"nan.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", ":2: vertex 2 (1, 0, nan) is not finite"},
        {"inf.obj", "v 0 0 0\nv 1 0 0\nv 0 -inf 0\nf 1 2 3\n", ":3: vertex 3 (0, -inf, 0) is not finite"},
        {"huge.obj", "v 0 0 0\nv 1e60 0 0\nv 0 1 0\nf 1 2 3\n", ":2: vertex 2"},
        {"joined.obj", SQUARE "f 1 2 \\\n3\nf 1 2 \\\n\\\n7\n", ":7: the face asks for vertex 7"},
        {"points.obj", SQUARE "f 1 1 2\nf 3 3 3\n", "(2 degenerate faces"},
        {"head.ply", "ply\nformat ascii 1.0\nelement vertex 3\nprop", "cut short in its header"},
        {"type.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\nend_header\n", "no known type"},
        {"empty.stl", "solid a\nendsolid a\n", ""},
        {"cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
         "EOF"},
        {"cut.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n", "2 faces, 5 lines are there"},
        {"much.off", "OFF\n4 999999999999 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n", "cut short"},
        {"range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ":6: face 0"},
        {"nan.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n", ":5: vertex 2"},
        {"count.off", "OFF\n3\n", "missing"},
        {"what.xyzzy", "hello", "No suitable reader"},
        {"cut.dae", "<COLLADA><library_geometries>", "export it again"},
    };
    for (size_t d = 0; d < sizeof damages / sizeof *damages; d++) {
        mesh_t mesh;
        sim_error_t error = {""};
        const char *path = put_text(damages[d].file, damages[d].text);
        int status = mesh_import(&mesh, path, &error);
        if (status != -1 || strncmp(error.text, path, strlen(path)) || !strstr(error.text, damages[d].words) ||
            strchr(error.text, '\n')) {
            fail_msg("%s: status %d, \"%s\"", damages[d].file, status, error.text);
        }
        assert_null(mesh.faces);
    }
    static const damage_t plies[] = {
        {"vertex.ply", "0 0 0\n1 0 0\n0 1", "in vertex 2 of 3"},
        {"face.ply", "0 0 0\n1 0 0\n0 1 0\n3 0 1", "in face 0 of 1"},
        {"range.ply", "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "face 0 asks for vertex 3"},
        {"minus.ply", "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "face 0 asks for vertex -1"},
        {"nan.ply", "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "coordinate y of vertex 1"},
    };
    for (size_t d = 0; d < sizeof plies / sizeof *plies; d++) {
        char text[400];
        mesh_t mesh;
        sim_error_t error = {""};
        (void)snprintf(text, sizeof text, "%s%s", ply, plies[d].text);
        int status = mesh_import(&mesh, put_text(plies[d].file, text), &error);
        if (status != -1 || !strstr(error.text, plies[d].words)) {
            fail_msg("%s: status %d, \"%s\"", plies[d].file, status, error.text);
        }
    }
}

static void test_no_file(void **state) {
    (void)state;
    mesh_t mesh;
    sim_error_t error = {""};
    assert_int_equal(mesh_import(&mesh, path_of("nowhere.obj"), &error), -1);
    assert_non_null(strstr(error.text, "nowhere.obj: No such file"));
    assert_int_equal(mkdir(path_of("dir.obj"), 0700), 0);
    assert_int_equal(mesh_import(&mesh, path_of("dir.obj"), &error), -1);
    assert_non_null(strstr(error.text, "dir.obj: is a folder"));
    assert_int_equal(mesh_import(&mesh, path_of("nowhere.obj"), NULL), -1);
}

/* A binary PLY cut at every length is refused; some of these never come back from Assimp. */
static void test_binary_ply_cut_anywhere(void **state) {
    (void)state;
    static const char header[] = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const float at[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    uint8_t file[400];
    size_t size = sizeof header - 1;
    memcpy(file, header, size);
    memcpy(file + size, at, sizeof at);
    size += sizeof at;
    file[size++] = 3;
    for (uint8_t i = 0; i < 12; i++) {
        file[size++] = i % 4 ? 0 : i / 4;
    }
    for (size_t length = 5; length <= size; length++) {
        mesh_t mesh;
        sim_error_t error = {""};
        int status = mesh_import(&mesh, put_bytes("cut.ply", file, length), &error);
        if (status != (length == size ? 0 : -1)) {
            fail_msg("%zu of %zu bytes: status %d, \"%s\"", length, size, status, error.text);
        }
        mesh_free(&mesh);
    }
}

/* ---- other formats ------------------------------------------------------------------------------------------ */

static void test_formats(void **state) {
    (void)state;
    static const char *const files[][2] = {
        {"quad.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"},
        {"quad.off", "OFF\n# a square\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"},
        {"cr.obj", "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf -4 -3 -2 -1\r\n"},
        {"early.obj", "f 1/1 2/2 3/3 4/4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0"},
    };
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        compiled_t c = compile_file(put_text(files[f][0], files[f][1]), NULL);
        assert_int_equal(c.report.faces, 1);
        assert_int_equal(c.report.polygons, 1);
        check_faces(&c.model, &c.mesh);
        drop(&c);
    }
    /* The facets of an STL file share nothing and bear their own normals: they are joined and smoothed none the less. */
    compiled_t c =
        compile_file(put_text("roof.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                          "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\n"
                                          "vertex -1 0 0.5\nendloop\nendfacet\nendsolid a\n"),
                     NULL);
    assert_int_equal(c.mesh.position_count, 4);
    assert_true(face_of_source(&c.model, 0)->normals[0][0] > 10);
    drop(&c);
}

/* Two instances of a triangle in a node tree: one moved, one mirrored, whose front has to stay in front. */
static void test_node_transforms(void **state) {
    (void)state;
    compiled_t c = compile_file(
        put_text(
            "tree.dae",
            "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
            "<asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id=\"g\"><mesh><source id=\"s\">"
            "<float_array id=\"a\" count=\"9\">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source=\"#a\" "
            "count=\"3\" "
            "stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/>"
            "</accessor></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#s\"/></vertices>"
            "<polylist count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>3</vcount><p>0 1 "
            "2</p></polylist>"
            "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id=\"w\"><node id=\"n\">"
            "<translate>0 0 3</translate><node id=\"m\"><translate>4 0 0</translate><instance_geometry url=\"#g\"/></node>"
            "<node id=\"o\"><scale>-2 2 2</scale><instance_geometry url=\"#g\"/></node></node></visual_scene>"
            "</library_visual_scenes><scene><instance_visual_scene url=\"#w\"/></scene></COLLADA>\n"),
        NULL);
    assert_int_equal(c.report.faces, 2);
    const double moved[3][3] = {{4, 0, 3}, {5, 0, 3}, {4, 1, 3}}, mirrored[3][3] = {{0, 0, 3}, {0, 2, 3}, {-2, 0, 3}};
    const int8_t front[3] = {0, 0, 127};
    for (uint32_t s = 0; s < 2; s++) {
        const read_face_t *face = face_of_source(&c.model, s);
        assert_memory_equal(face->plane, front, 3);
        assert_memory_equal(face->normals[0], front, 3);
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                double at = c.model.step * ((double)face->q[i][k] + c.model.offset[k]);
                assert_true(fabs(at - (s ? mirrored : moved)[i][k]) <= c.model.step / 2);
            }
        }
    }
    drop(&c);
}

/* ---- larger models ------------------------------------------------------------------------------------------ */

/* A lumpy ball of quads (bent a little, so cut or not as the lumps have it) with triangles at the poles; alternate == true paints
 * its halves in two colours. */
static mesh_t make_ball(uint32_t rings, uint32_t sectors, double lumps) {
    mesh_t mesh = {0};
    size_t faces = (size_t)rings * sectors;
    mesh.position_count = (rings - 1) * sectors + 2;
    mesh.positions = calloc(mesh.position_count, sizeof *mesh.positions);
    mesh.corners = calloc(4 * faces, sizeof *mesh.corners);
    mesh.faces = calloc(faces, sizeof *mesh.faces);
    mesh.materials = calloc(2, sizeof *mesh.materials);
    assert_true(mesh.positions && mesh.corners && mesh.faces && mesh.materials);
    mesh.material_count = 2;
    mesh.materials[0][0] = 200;
    mesh.materials[1][2] = 200;
    for (uint32_t r = 1; r < rings; r++) {
        for (uint32_t s = 0; s < sectors; s++) {
            double u = 3.14159265358979 * r / rings, v = 2 * 3.14159265358979 * s / sectors, radius = 10 + lumps * random_unit();
            double *at = mesh.positions[(r - 1) * sectors + s];
            at[0] = radius * sin(u) * cos(v) + 3;
            at[1] = radius * cos(u) - 100;
            at[2] = -radius * sin(u) * sin(v);
        }
    }
    uint32_t top = (uint32_t)mesh.position_count - 2, bottom = top + 1;
    memcpy(mesh.positions[top], (const double[3]){3, -90, 0}, sizeof mesh.positions[top]);
    memcpy(mesh.positions[bottom], (const double[3]){3, -110, 0}, sizeof mesh.positions[bottom]);
    for (uint32_t r = 0; r < rings; r++) {
        for (uint32_t s = 0; s < sectors; s++) {
            uint32_t next = (s + 1) % sectors, *c = mesh.corners + mesh.corner_count;
            uint32_t a = r ? (r - 1) * sectors + s : top, b = r + 1 < rings ? r * sectors + s : bottom;
            uint32_t d = r + 1 < rings ? r * sectors + next : bottom, e = r ? (r - 1) * sectors + next : top;
            uint32_t count = 0;
            c[count++] = a;
            c[count++] = b;
            if (d != b) { c[count++] = d; }
            if (e != a) { c[count++] = e; }
            mesh.faces[mesh.face_count] = (mesh_face_t){.first = (uint32_t)mesh.corner_count,
                                                        .count = count,
                                                        .material = s < sectors / 2,
                                                        .source = (uint32_t)mesh.face_count};
            mesh.face_count++;
            mesh.corner_count += count;
        }
    }
    mesh.source_face_count = mesh.face_count;
    return mesh;
}

static void test_ball(void **state) {
    (void)state;
    const double lumps[3] = {0, 0.05, 2};
    for (int l = 0; l < 3; l++) {
        const mesh_options_t keep = {.keep_planar = true};
        for (int kept = 0; kept < 2; kept++) {
            random_state = 7;
            compiled_t c = {.mesh = make_ball(24, 48, lumps[l])};
            compile_mesh(&c, kept ? &keep : NULL);
            if (kept || l == 0) { /* rings of trapezoids: planar */
                check_faces(&c.model, &c.mesh);
                assert_int_equal(c.report.polygons, 22 * 48);
            } else {
                assert_true(c.report.non_planar > 500);
                assert_int_equal(c.report.faces, 24 * 48 + c.report.non_planar);
            }
            assert_true(c.report.quantisation_error > 0 && c.report.quantisation_error <= c.model.step * 0.8661);
            assert_true(kept || l == 2 || c.report.clusters < c.report.faces / 6); /* where faces share vertices and normals */
            size_t away = check_cones(&c.model, 60);
            assert_true(l == 2 || away > 60 * c.report.faces / 5); /* of those that face away, about half, most are found */
            drop(&c);
        }
    }
}

/* A soup of triangles without a common edge ends in clusters all the same, which are disjoint and complete. */
static void test_soup(void **state) {
    (void)state;
    compiled_t c = {.mesh = make_ball(16, 32, 0)};
    double(*positions)[3] = calloc(c.mesh.corner_count, sizeof *positions);
    assert_non_null(positions);
    for (size_t f = 0; f < c.mesh.face_count; f++) {
        for (uint32_t i = 0; i < c.mesh.faces[f].count; i++) { /* each face drawn in a little */
            uint32_t at = c.mesh.faces[f].first + i;
            for (int k = 0; k < 3; k++) {
                double middle = 0;
                for (uint32_t j = 0; j < c.mesh.faces[f].count; j++) {
                    middle += c.mesh.positions[c.mesh.corners[c.mesh.faces[f].first + j]][k] / c.mesh.faces[f].count;
                }
                positions[at][k] = middle + 0.9 * (c.mesh.positions[c.mesh.corners[at]][k] - middle);
            }
        }
    }
    for (size_t i = 0; i < c.mesh.corner_count; i++) {
        c.mesh.corners[i] = (uint32_t)i;
    }
    free(c.mesh.positions);
    c.mesh.positions = positions;
    c.mesh.position_count = c.mesh.corner_count;
    compile_mesh(&c, NULL);
    check_faces(&c.model, &c.mesh);
    assert_true(c.report.clusters <= c.report.faces / 2); /* with nothing to share, a face more or less is not worth much */
    (void)check_cones(&c.model, 30);
    drop(&c);
}

static void test_keep_order(void **state) {
    (void)state;
    compiled_t c = {.mesh = make_ball(24, 48, 0)};
    const mesh_options_t options = {.keep_order = true, .keep_planar = true};
    compile_mesh(&c, &options);
    check_faces(&c.model, &c.mesh);
    for (uint32_t f = 0; f < c.model.face_count; f++) {
        assert_int_equal(c.model.faces[f].source, f);
    }
    assert_int_equal(u32(c.bytes + 92), 0); /* no map needed */
    assert_true(check_cones(&c.model, 30) > 0);
    drop(&c);
}

static void test_wide_source_map(void **state) {
    (void)state;
    compiled_t c = {.mesh = make_ball(6, 12, 0)};
    c.mesh.source_face_count = 70000;
    c.mesh.faces[5].source = 69999;
    compile_mesh(&c, NULL);
    assert_int_equal(u16(c.bytes + 14), MODEL_FLAG_SOURCE32);
    check_faces(&c.model, &c.mesh);
    drop(&c);
}

static void test_same_bytes(void **state) {
    (void)state;
    compiled_t a = {.mesh = make_ball(20, 30, 1)}, b = {.mesh = a.mesh};
    compile_mesh(&a, NULL);
    compile_mesh(&b, NULL);
    assert_int_equal(a.size_bytes, b.size_bytes);
    assert_memory_equal(a.bytes, b.bytes, a.size_bytes);
    b.mesh = (mesh_t){0};
    drop(&a);
    drop(&b);
}

static void test_simplify(void **state) {
    (void)state;
    const size_t targets[4] = {3000, 1000, 200, 20};
    for (int t = 0; t < 4; t++) {
        compiled_t c = {.mesh = make_ball(40, 80, 0.02)};
        sim_error_t error = {""};
        assert_int_equal(mesh_simplify(&c.mesh, targets[t], &error), 0);
        assert_true(c.mesh.face_count <= targets[t] && c.mesh.face_count > targets[t] / 2);
        assert_int_equal(c.mesh.source_face_count, c.mesh.face_count);
        compile_mesh(&c, NULL);
        size_t colours[2] = {0, 0}, outward = 0;
        for (uint32_t f = 0; f < c.model.face_count; f++) {
            const read_face_t *face = &c.model.faces[f];
            double n[3], from_middle = 0;
            plane_of(face, n);
            for (int k = 0; k < 3; k++) {
                from_middle += n[k] * (c.model.step * (face->q[0][k] + c.model.offset[k]) - (k == 0 ? 3 : k == 1 ? -100 : 0));
            }
            outward += from_middle > 0;
            colours[face->material]++;
        }
        assert_true(outward >= c.model.face_count - c.model.face_count / 50); /* it is still a ball, and not inside out */
        assert_true(colours[0] > 0 && colours[1] > 0);
        (void)check_cones(&c.model, 20);
        drop(&c);
    }
    compiled_t cube = {.mesh = make_ball(4, 4, 0)};
    sim_error_t error = {""};
    size_t before = cube.mesh.face_count;
    assert_int_equal(mesh_simplify(&cube.mesh, 0, &error), -1);
    assert_int_equal(mesh_simplify(&cube.mesh, 24, &error), 0); /* 8 quads and 8 triangles make 24 */
    assert_int_equal(cube.mesh.face_count, before);
    assert_int_equal(cube.mesh.faces[5].count, 4);
    mesh_free(&cube.mesh);
}

/* ---- the grid ------------------------------------------------------------------------------------------------ */

static void compile_triangle(compiled_t *c, double scale, double shift, double step) {
    static const double places[3][3] = {{0, 0, 0}, {1, 0, 0.25}, {0, 1, 0}};
    *c = (compiled_t){0};
    c->mesh = (mesh_t){.position_count = 3, .corner_count = 3, .face_count = 1, .material_count = 1, .source_face_count = 1};
    c->mesh.positions = calloc(3, sizeof *c->mesh.positions);
    c->mesh.corners = calloc(3, sizeof *c->mesh.corners);
    c->mesh.faces = calloc(1, sizeof *c->mesh.faces);
    c->mesh.materials = calloc(1, sizeof *c->mesh.materials);
    assert_true(c->mesh.positions && c->mesh.corners && c->mesh.faces && c->mesh.materials);
    c->mesh.faces[0].count = 3;
    for (uint32_t i = 0; i < 3; i++) {
        c->mesh.corners[i] = i;
        for (int k = 0; k < 3; k++) {
            c->mesh.positions[i][k] = places[i][k] * scale + shift;
        }
    }
    const mesh_options_t options = {.step = step};
    compile_mesh(c, &options);
    check_faces(&c->model, &c->mesh);
}

static void test_grid(void **state) {
    (void)state;
    compiled_t c;
    compile_triangle(&c, 4, 32763, 0); /* integers up to 32767: exact in steps of 1, as they stand */
    assert_true(c.report.quantisation_error == 0 && c.model.step == 1 && c.model.offset[0] == 0);
    drop(&c);
    compile_triangle(&c, 4, 32764, 0); /* 32768 is one too far for that */
    assert_true(c.model.step < 1.001 * 4 / 65533 && c.model.offset[0] != 0);
    assert_true(c.report.quantisation_error < c.model.step);
    drop(&c);
    compile_triangle(&c, 4, 0.3, 0.0625); /* a step of one's own: offset 0 */
    assert_true(c.model.step == 0.0625 && c.model.offset[1] == 0);
    assert_int_equal(u32(c.bytes + 48), 2147483648u);
    drop(&c);
    compile_triangle(&c, 1e-30, 0, 0);
    assert_true(c.model.step < 1.001e-30 / 16384);
    drop(&c);
    compile_triangle(&c, 1e30, 1e29, 0);
    drop(&c);
    compile_triangle(&c, 1, 1e7, 0); /* far from the origin: the offset's 31 bits limit the step */
    assert_true(c.model.step < 1e7 / 2147000000.0 + 1.001 / 65533);
    drop(&c);
    for (int i = 0; i < 2000; i++) { /* nothing leaves the range for any size and place */
        compile_triangle(&c, exp(5 * random_unit()), exp(8 * random_unit()) * random_unit(), 0);
        drop(&c);
    }
}

static void test_grid_refuses(void **state) {
    (void)state;
    compiled_t c;
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes;
    compile_triangle(&c, 4, 0, 0);
    const mesh_options_t fine = {.step = 4.0 / 32768};
    assert_int_equal(mesh_compile(&c.mesh, &fine, &bytes, &size_bytes, NULL, &error), -1);
    assert_non_null(strstr(error.text, "take a step of 0.00012207"));
    assert_null(bytes);
    c.mesh.positions[1][2] = NAN;
    assert_int_equal(mesh_compile(&c.mesh, NULL, &bytes, &size_bytes, NULL, &error), -1);
    c.mesh.positions[1][2] = INFINITY;
    assert_int_equal(mesh_compile(&c.mesh, NULL, &bytes, &size_bytes, NULL, &error), -1);
    memset(c.mesh.positions, 0, 9 * sizeof(double));
    assert_int_equal(mesh_compile(&c.mesh, NULL, &bytes, &size_bytes, NULL, &error), -1);
    c.mesh.corners[2] = 3;
    assert_int_equal(mesh_compile(&c.mesh, NULL, &bytes, &size_bytes, NULL, &error), -1);
    assert_non_null(strstr(error.text, "corner 2"));
    drop(&c);
}

/* ---- files of our own ---------------------------------------------------------------------------------------- */

static void test_write_and_load(void **state) {
    (void)state;
    (void)files_in_folder(true);
    compiled_t c = compile_file(put_text("cube.obj", CUBE_VERTICES CUBE_FACES), NULL);
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes;
    mesh_report_t report;
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, path_of("cube.tuile"), NULL, &error), 0);
    assert_int_equal(files_in_folder(false), 2);
    assert_int_equal(mesh_load(path_of("cube.tuile"), 0, &bytes, &size_bytes, &report, &error), 0);
    assert_int_equal(size_bytes, c.size_bytes);
    assert_memory_equal(bytes, c.bytes, size_bytes);
    assert_int_equal(report.faces, 6);
    assert_int_equal(report.polygons, 6);
    free(bytes);
    assert_int_equal(mesh_load(path_of("cube.obj"), 0, &bytes, &size_bytes, NULL, &error), 0);
    assert_memory_equal(bytes, c.bytes, size_bytes);
    free(bytes);
    assert_int_equal(mesh_load(path_of("cube.obj"), 6, &bytes, &size_bytes, &report, &error), 0); /* few enough as quads */
    assert_int_equal(report.polygons, 6);
    free(bytes);
    assert_int_equal(mesh_load(path_of("cube.tuile"), 5, &bytes, &size_bytes, &report, &error), -1);
    assert_non_null(strstr(error.text, "more than the 5"));
    for (size_t at = 0; at < c.size_bytes; at++) { /* any byte changed, any length: refused */
        uint8_t kept = c.bytes[at];
        c.bytes[at] = (uint8_t)(kept ^ 16u);
        assert_int_equal(mesh_load(put_bytes("bad.tuile", c.bytes, c.size_bytes), 0, &bytes, &size_bytes, NULL, &error), -1);
        c.bytes[at] = kept;
        assert_int_equal(mesh_load(put_bytes("bad.tuile", c.bytes, at), 0, &bytes, &size_bytes, NULL, &error), -1);
    }
    assert_non_null(strstr(error.text, "cut short"));
    drop(&c);
}

static void test_source_file(void **state) {
    (void)state;
    compiled_t c = compile_file(put_text("cube.obj", CUBE_VERTICES CUBE_FACES), NULL);
    sim_error_t error = {""};
    char command[500];
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, path_of("3-cube.c"), NULL, &error), 0);
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, path_of("my.c"), "my_cube", &error), 0);
    (void)put_text("main.c", "#include <stdint.h>\n#include <stdio.h>\nextern const uint32_t model_3_cube[], my_cube[];\n"
                             "int main(void) {\n    return fwrite(model_3_cube, 1, model_3_cube[1], stdout) != model_3_cube[1] ||\n"
                             "           fwrite(my_cube, 1, my_cube[1], stdout) != my_cube[1];\n}\n");
    (void)snprintf(command, sizeof command,
                   "cd %s && ${CC:-cc} -std=c11 -Wall -Wextra -Wpedantic -Werror main.c 3-cube.c my.c -o main && ./main > both",
                   folder);
    assert_int_equal(system(command), 0);
    uint8_t both[20000];
    FILE *file = fopen(path_of("both"), "rb");
    assert_non_null(file);
    assert_int_equal(fread(both, 1, sizeof both, file), 2 * c.size_bytes);
    assert_int_equal(fclose(file), 0);
    assert_memory_equal(both, c.bytes, c.size_bytes);
    assert_memory_equal(both + c.size_bytes, c.bytes, c.size_bytes);
    const char *const names[] = {"a b", "3d", "for", "", "_x", "caf\xc3\xa9", "main", "a-b"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        assert_int_equal(mesh_write(c.bytes, c.size_bytes, path_of("no.c"), names[n], &error), *names[n] ? -1 : 0);
    }
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, path_of("no.obj"), NULL, &error), -1);
    assert_non_null(strstr(error.text, ".tuile or .c"));
    drop(&c);
}

static void test_write_fails(void **state) {
    (void)state;
    (void)files_in_folder(true);
    compiled_t c = compile_file(put_text("cube.obj", CUBE_VERTICES CUBE_FACES), NULL);
    sim_error_t error = {""};
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, path_of("nowhere/a.tuile"), NULL, &error), -1);
    assert_int_equal(mkdir(path_of("dir.c"), 0700), 0);
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, path_of("dir.c"), NULL, &error), -1);
    assert_int_equal(symlink("/dev/full", path_of("full.c")), 0); /* a device: written to, and the failure seen */
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, path_of("full.c"), "a", &error), -1);
    assert_non_null(strstr(error.text, "No space left"));
    /* A disk that is full after any number of bytes leaves the old file as it was, and nothing else. */
    (void)put_text("old.tuile", "the old one");
    size_t files = files_in_folder(false);
    struct rlimit limit, unlimited;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
    limit = unlimited;
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    for (size_t room = 0; room < c.size_bytes; room += 37) {
        limit.rlim_cur = room;
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        int status = mesh_write(c.bytes, c.size_bytes, path_of("old.tuile"), NULL, &error);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &unlimited), 0);
        assert_int_equal(status, -1);
    }
    (void)signal(SIGXFSZ, handler);
    assert_int_equal(files_in_folder(false), files);
    char text[20] = {0};
    FILE *file = fopen(path_of("old.tuile"), "rb");
    assert_non_null(file);
    assert_int_equal(fread(text, 1, sizeof text - 1, file), 11);
    assert_int_equal(fclose(file), 0);
    assert_string_equal(text, "the old one");
    /* Through a link, what it names is replaced. */
    assert_int_equal(symlink("old.tuile", path_of("link.tuile")), 0);
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, path_of("link.tuile"), NULL, &error), 0);
    struct stat status;
    assert_int_equal(lstat(path_of("link.tuile"), &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(stat(path_of("old.tuile"), &status), 0);
    assert_int_equal(status.st_size, c.size_bytes);
    drop(&c);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cube),
        cmocka_unit_test(test_smooth_normals),
        cmocka_unit_test(test_file_normals),
        cmocka_unit_test(test_two_materials),
        cmocka_unit_test(test_vertex_colours),
        cmocka_unit_test(test_palette),
        cmocka_unit_test(test_concave),
        cmocka_unit_test(test_non_planar),
        cmocka_unit_test(test_many_corners),
        cmocka_unit_test(test_degenerate_faces),
        cmocka_unit_test(test_triangulate),
        cmocka_unit_test(test_triangulate_stars),
        cmocka_unit_test(test_damaged_files),
        cmocka_unit_test(test_no_file),
        cmocka_unit_test(test_binary_ply_cut_anywhere),
        cmocka_unit_test(test_formats),
        cmocka_unit_test(test_node_transforms),
        cmocka_unit_test(test_ball),
        cmocka_unit_test(test_soup),
        cmocka_unit_test(test_keep_order),
        cmocka_unit_test(test_wide_source_map),
        cmocka_unit_test(test_same_bytes),
        cmocka_unit_test(test_simplify),
        cmocka_unit_test(test_grid),
        cmocka_unit_test(test_grid_refuses),
        cmocka_unit_test(test_write_and_load),
        cmocka_unit_test(test_source_file),
        cmocka_unit_test(test_write_fails),
    };
    return cmocka_run_group_tests_name("mesh", tests, make_folder, remove_folder);
}
