#include "models.h"

#include "check.h"

#include <math.h>

#define TURN 6.28318530717958647693

static void *more(void *array, size_t count, size_t item_bytes) {
    if ((count & (count - 1)) == 0) { /* a power of two, or nothing yet */
        array = realloc(array, (count ? 2 * count : 1) * item_bytes);
        assert_non_null(array);
    }
    return array;
}

void model_start(mesh_t *mesh) { memset(mesh, 0, sizeof *mesh); }

uint32_t model_position(mesh_t *mesh, double x, double y, double z) {
    mesh->positions = more(mesh->positions, mesh->position_count, sizeof *mesh->positions);
    double *position = mesh->positions[mesh->position_count];
    position[0] = x;
    position[1] = y;
    position[2] = z;
    return (uint32_t)mesh->position_count++;
}

uint32_t model_material(mesh_t *mesh, unsigned red, unsigned green, unsigned blue) {
    const uint8_t colour[3] = {(uint8_t)red, (uint8_t)green, (uint8_t)blue};
    for (size_t m = 0; m < mesh->material_count; m++) {
        if (memcmp(mesh->materials[m], colour, 3) == 0) { return (uint32_t)m; }
    }
    mesh->materials = more(mesh->materials, mesh->material_count, sizeof *mesh->materials);
    memcpy(mesh->materials[mesh->material_count], colour, 3);
    return (uint32_t)mesh->material_count++;
}

void model_face(mesh_t *mesh, const uint32_t *corners, uint32_t count, uint32_t material) {
    mesh->faces = more(mesh->faces, mesh->face_count, sizeof *mesh->faces);
    mesh->faces[mesh->face_count] = (mesh_face_t){
        .first = (uint32_t)mesh->corner_count, .count = count, .material = material, .source = (uint32_t)mesh->face_count};
    mesh->source_face_count = ++mesh->face_count;
    for (uint32_t i = 0; i < count; i++) {
        mesh->corners = more(mesh->corners, mesh->corner_count, sizeof *mesh->corners);
        mesh->corners[mesh->corner_count++] = corners[i];
    }
}

static uint32_t grey(mesh_t *mesh) { return model_material(mesh, 204, 204, 204); }

/* Corner c of a box: bit 0 of c is x, bit 1 y, bit 2 z. */
static const uint32_t box_faces[6][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}};

static uint32_t box_corners(mesh_t *mesh, const double low[3], const double high[3]) {
    const uint32_t first = (uint32_t)mesh->position_count;
    for (unsigned c = 0; c < 8; c++) {
        (void)model_position(mesh, c & 1 ? high[0] : low[0], c & 2 ? high[1] : low[1], c & 4 ? high[2] : low[2]);
    }
    return first;
}

void model_box(mesh_t *mesh, const double low[3], const double high[3], uint32_t material) {
    const uint32_t first = box_corners(mesh, low, high);
    for (unsigned f = 0; f < 6; f++) {
        uint32_t corners[4];
        for (unsigned i = 0; i < 4; i++) {
            corners[i] = first + box_faces[f][i];
        }
        model_face(mesh, corners, 4, material);
    }
}

void model_cube(mesh_t *mesh) {
    const double low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    model_start(mesh);
    model_box(mesh, low, high, grey(mesh));
}

void model_flat_normals(mesh_t *mesh) {
    mesh->normals = calloc(mesh->face_count, sizeof *mesh->normals);
    mesh->corner_normals = calloc(mesh->corner_count, sizeof *mesh->corner_normals);
    assert_non_null(mesh->normals);
    assert_non_null(mesh->corner_normals);
    mesh->normal_count = mesh->face_count;
    for (size_t f = 0; f < mesh->face_count; f++) {
        const mesh_face_t *face = &mesh->faces[f];
        double *normal = mesh->normals[f];
        for (uint32_t i = 0; i < face->count; i++) { /* Newell */
            const double *p = mesh->positions[mesh->corners[face->first + i]];
            const double *q = mesh->positions[mesh->corners[face->first + (i + 1) % face->count]];
            for (unsigned a = 0; a < 3; a++) {
                const unsigned b = (a + 1) % 3, c = (a + 2) % 3;
                normal[a] += (p[b] - q[b]) * (p[c] + q[c]);
            }
            mesh->corner_normals[face->first + i] = (uint32_t)f;
        }
        const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        for (unsigned a = 0; a < 3; a++) {
            normal[a] /= length;
        }
    }
}

static void quad(mesh_t *mesh, const uint32_t corners[4], bool triangles, uint32_t material) {
    if (!triangles) {
        model_face(mesh, corners, 4, material);
        return;
    }
    const uint32_t halves[2][3] = {{corners[0], corners[1], corners[2]}, {corners[0], corners[2], corners[3]}};
    model_face(mesh, halves[0], 3, material);
    model_face(mesh, halves[1], 3, material);
}

void model_torus(mesh_t *mesh, unsigned rings, unsigned sides, bool triangles) {
    model_start(mesh);
    const uint32_t material = model_material(mesh, 224, 160, 64);
    for (unsigned r = 0; r < rings; r++) {
        for (unsigned s = 0; s < sides; s++) {
            const double around = TURN * r / rings, across = TURN * s / sides, from_axis = 1.0 + 0.4 * cos(across);
            (void)model_position(mesh, from_axis * cos(around), 0.4 * sin(across), -from_axis * sin(around));
        }
    }
    for (unsigned r = 0; r < rings; r++) {
        for (unsigned s = 0; s < sides; s++) {
            const unsigned r1 = (r + 1) % rings, s1 = (s + 1) % sides;
            const uint32_t corners[4] = {r * sides + s, r1 * sides + s, r1 * sides + s1, r * sides + s1};
            quad(mesh, corners, triangles, material);
        }
    }
}

void model_sphere(mesh_t *mesh, unsigned belts, unsigned sides) {
    model_start(mesh);
    const uint32_t material = model_material(mesh, 96, 176, 224);
    const uint32_t south = model_position(mesh, 0, -1, 0), north = model_position(mesh, 0, 1, 0);
    for (unsigned b = 1; b <= belts; b++) { /* circles between the belts, from the south */
        for (unsigned s = 0; s < sides; s++) {
            const double up = TURN / 2 * b / (belts + 1), around = TURN * s / sides;
            (void)model_position(mesh, sin(up) * cos(around), -cos(up), -sin(up) * sin(around));
        }
    }
    for (unsigned s = 0; s < sides; s++) {
        const uint32_t s1 = (s + 1) % sides, first = 2, last = 2 + (belts - 1) * sides;
        const uint32_t bottom[3] = {south, first + s1, first + s}, top[3] = {north, last + s, last + s1};
        model_face(mesh, bottom, 3, material);
        model_face(mesh, top, 3, material);
        for (unsigned b = 0; b + 1 < belts; b++) {
            const uint32_t low = 2 + b * sides, high = low + sides;
            const uint32_t corners[4] = {low + s, low + s1, high + s1, high + s};
            model_face(mesh, corners, 4, material);
        }
    }
}

void model_staircase(mesh_t *mesh, unsigned steps) {
    model_start(mesh);
    const uint32_t materials[2] = {model_material(mesh, 176, 144, 112), model_material(mesh, 112, 144, 176)};
    for (unsigned s = 0; s < steps; s++) {
        const double low[3] = {s, 0, 0}, high[3] = {s + 1.0, 0.5 * (s + 1), 3};
        model_box(mesh, low, high, materials[s % 2]);
    }
}

void model_room(mesh_t *mesh) {
    static const unsigned colours[6][3] = {{96, 96, 128}, {200, 200, 160}, {192, 96, 96},
                                           {96, 192, 96}, {224, 224, 224}, {144, 112, 80}};
    const double low[3] = {-4, -2, -4}, high[3] = {4, 2, 4};
    model_start(mesh);
    const uint32_t first = box_corners(mesh, low, high);
    for (unsigned f = 0; f < 6; f++) {
        const uint32_t material = model_material(mesh, colours[f][0], colours[f][1], colours[f][2]);
        uint32_t corners[10];
        uint32_t count = 4;
        for (unsigned i = 0; i < 4; i++) {
            corners[i] = first + box_faces[f][3 - i];
        } /* turned inward */
        if (f == 1) {
            /* The far wall counter-clockwise from its bottom left, along a bridge to the window, round that clockwise, and back. */
            static const double window[4][2] = {{-2, -1}, {-2, 1}, {1, 1}, {1, -1}};
            corners[0] = first; /* (-, -), then (+, -), (+, +), (-, +) */
            corners[1] = first + 1;
            corners[2] = first + 3;
            corners[3] = first + 2;
            corners[4] = first;
            for (unsigned i = 0; i < 4; i++) {
                corners[5 + i] = model_position(mesh, window[i][0], window[i][1], -4);
            }
            corners[9] = corners[5];
            count = 10;
        }
        model_face(mesh, corners, count, material);
    }
    const double box_low[3] = {0.5, -2, -2.5}, box_high[3] = {2.5, -0.5, -1};
    model_box(mesh, box_low, box_high, model_material(mesh, 240, 192, 64));
}

void model_octahedron(mesh_t *mesh) {
    model_start(mesh);
    const uint32_t red = model_material(mesh, 224, 48, 48), blue = model_material(mesh, 48, 80, 224);
    for (unsigned i = 0; i < 6; i++) {
        const double sign = i % 2 ? -1 : 1;
        (void)model_position(mesh, i / 2 == 0 ? sign : 0, i / 2 == 1 ? sign : 0, i / 2 == 2 ? sign : 0);
    }
    for (uint32_t octant = 0; octant < 8; octant++) {
        const uint32_t x = octant & 1, y = 2 + (octant >> 1 & 1), z = 4 + (octant >> 2);
        const bool odd = ((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0;
        const uint32_t corners[3] = {x, odd ? z : y, odd ? y : z};
        model_face(mesh, corners, 3, odd ? blue : red);
    }
}

/* ---- files -------------------------------------------------------------------------------------------------- */

static FILE *create(const char *path) {
    FILE *file = fopen(path, "w");
    if (!file) { fail_msg("%s cannot be written", path); }
    return file;
}

static void write_materials(const mesh_t *mesh, const char *path) {
    FILE *file = create(path);
    for (size_t m = 0; m < mesh->material_count; m++) {
        (void)fprintf(file, "newmtl m%zu\nKd %.9f %.9f %.9f\n", m, mesh->materials[m][0] / 255.0, mesh->materials[m][1] / 255.0,
                      mesh->materials[m][2] / 255.0);
    }
    assert_int_equal(fclose(file), 0);
}

void model_write_obj(const mesh_t *mesh, const char *path) {
    FILE *file = create(path);
    const bool coloured = mesh->material_count > 1;
    size_t material = SIZE_MAX;
    if (coloured) {
        char beside[512];
        const char *slash = strrchr(path, '/');
        (void)snprintf(beside, sizeof beside, "%s.mtl", path);
        write_materials(mesh, beside);
        (void)fprintf(file, "mtllib %s.mtl\n", slash ? slash + 1 : path);
    }
    for (size_t p = 0; p < mesh->position_count; p++) {
        const double *at = mesh->positions[p];
        (void)fprintf(file, "v %.17g %.17g %.17g\n", at[0], at[1], at[2]);
    }
    for (size_t f = 0; f < mesh->face_count; f++) {
        const mesh_face_t *face = &mesh->faces[f];
        if (coloured && face->material != material) {
            material = face->material;
            (void)fprintf(file, "usemtl m%zu\n", material);
        }
        (void)fputc('f', file);
        for (uint32_t i = 0; i < face->count; i++) {
            (void)fprintf(file, " %u", mesh->corners[face->first + i] + 1);
        }
        (void)fputc('\n', file);
    }
    assert_int_equal(fclose(file), 0);
}

void model_compile_with(model_compiled_t *compiled, const mesh_t *mesh, const mesh_options_t *options) {
    sim_error_t error = {""};
    memset(compiled, 0, sizeof *compiled);
    if (mesh_compile(mesh, options, &compiled->bytes, &compiled->size_bytes, &compiled->report, &error) != 0) {
        fail_msg("%s", error.text);
    }
    assert_int_equal(tuile_model_open(&compiled->model, compiled->bytes, compiled->size_bytes), TUILE_OK);
}

void model_compile(model_compiled_t *compiled, mesh_t *mesh) {
    model_compile_with(compiled, mesh, NULL);
    mesh_free(mesh);
}

void model_free(model_compiled_t *compiled) {
    free(compiled->bytes);
    memset(compiled, 0, sizeof *compiled);
}
