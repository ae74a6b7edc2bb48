/* The second key frame of a compiled model. */
#include "support/check.h"

#include <math.h>

#include "../raster/geometry/model.h"
#include "../sim/mesh/mesh.h"
#include "support/decoder.h"
#include "support/folder.h"
#include "support/random.h"

typedef struct built {
    uint8_t *bytes;
    size_t size;
    mesh_report_t report;
    tuile_model_t model;
} built_t;

static char first_path[200], second_path[200];

static void put(const char *first, const char *second) {
    (void)snprintf(first_path, sizeof first_path, "%s", folder_put_text("first.obj", first));
    (void)snprintf(second_path, sizeof second_path, "%s", folder_put_text("second.obj", second));
}

static built_t load(void) {
    built_t b;
    sim_error_t error = {""};
    const mesh_options_t options = {.morph_path = second_path};
    if (mesh_load(first_path, 0, &options, &b.bytes, &b.size, &b.report, &error) != 0) { fail_msg("%s", error.text); }
    assert_int_equal(tuile_model_open(&b.model, b.bytes, b.size), 0);
    assert_non_null(b.model.morph_positions);
    assert_non_null(b.model.morph_normals);
    assert_non_null(b.model.morph_face_normals);
    return b;
}

static void fails_with(const mesh_options_t *options, size_t max_faces, const char *expected) {
    uint8_t *bytes;
    size_t size;
    sim_error_t error = {""};
    if (mesh_load(first_path, max_faces, options, &bytes, &size, NULL, &error) == 0) { fail_msg("loads; expected: %s", expected); }
    if (!strstr(error.text, expected)) { fail_msg("got: %s\nexpected: %s", error.text, expected); }
}

static double place(const built_t *b, const uint8_t *positions, uint32_t v, int axis) {
    return (decoder_s16(positions + 6 * (size_t)v + 2 * axis) + b->model.offset[axis]) *
           ldexp(b->model.step.mantissa, b->model.step.exponent);
}

#define TRIANGLE "v 0 0 0\nv 4 0 0\nv 0 4 0\n"

/* ---- what stands there ------------------------------------------------------------------------------------------ */

static void both_key_frames_stand_on_one_grid(void **state) {
    (void)state;
    put(TRIANGLE "f 1 2 3\n", "v 0 0 20\nv 0 4 20\nv 0 0 24\nf 1 2 3\n"); /* looks along +x */
    built_t b = load();
    static const double first[3][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, second[3][3] = {{0, 0, 20}, {0, 4, 20}, {0, 0, 24}};
    static const int8_t along_z[3] = {0, 0, 127}, along_x[3] = {127, 0, 0};
    assert_int_equal(b.model.vertex_count, 3);
    for (uint32_t v = 0; v < 3; v++) {
        for (int k = 0; k < 3; k++) {
            assert_true(place(&b, b.model.positions, v, k) == first[v][k]);
            assert_true(place(&b, b.model.morph_positions, v, k) == second[v][k]);
        }
        assert_memory_equal(b.model.normals + 3 * v, along_z, 3);
        assert_memory_equal(b.model.morph_normals + 3 * v, along_x, 3);
    }
    assert_memory_equal(b.model.face_normals, along_z, 3);
    assert_memory_equal(b.model.morph_face_normals, along_x, 3);
    assert_true(b.report.quantisation_error == 0);
    for (int k = 0; k < 3; k++) { /* the box holds both */
        const double step = ldexp(b.model.step.mantissa, b.model.step.exponent);
        assert_true((b.model.low[k] + b.model.offset[k]) * step == 0);
        assert_true((b.model.high[k] + b.model.offset[k]) * step == (k == 2 ? 24 : 4));
    }
    free(b.bytes);
}

static void places_are_one_only_if_they_are_in_both(void **state) {
    (void)state;
    /* Two triangles that share an edge; then they come apart. */
    put(TRIANGLE "v 4 4 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\nf 5 4 6\n", TRIANGLE "v 5 4 0\nv 5 0 0\nv 1 4 0\nf 1 2 3\nf 5 4 6\n");
    built_t b = load();
    assert_int_equal(b.model.vertex_count, 6);
    free(b.bytes);
    put(TRIANGLE "v 4 4 0\nf 1 2 3\nf 2 4 3\n", TRIANGLE "v 5 4 0\nf 1 2 3\nf 2 4 3\n");
    b = load();
    assert_int_equal(b.model.vertex_count, 4);
    free(b.bytes);
}

static void polygons_stay_if_they_move_as_one(void **state) {
    (void)state;
    const char *square = DECODER_SQUARE "f 1 2 3 4\n";
    put(square, "v 1 2 3\nv 5 2 3\nv 5 6 3\nv 1 6 3\nf 1 2 3 4\n");
    built_t b = load();
    assert_int_equal(b.report.faces, 1);
    free(b.bytes);
    put(square, "v 0 0 0\nv 4 0 0\nv 4 4 1\nv 0 4 0\nf 1 2 3 4\n"); /* not flat any more */
    b = load();
    assert_int_equal(b.report.faces, 2);
    free(b.bytes);
    put(square, "v 0 0 0\nv 4 0 0\nv 5 5 0\nv 0 4 0\nf 1 2 3 4\n"); /* flat on the way, but of another shape */
    b = load();
    assert_int_equal(b.report.faces, 2);
    free(b.bytes);
}

static void a_face_without_an_area_in_one_key_frame_is_kept(void **state) {
    (void)state;
    static const int8_t along_z[3] = {0, 0, 127};
    put(TRIANGLE "v 9 9 0\nf 1 2 3\nf 2 4 3\n", TRIANGLE "v 2 2 0\nf 1 2 3\nf 2 4 3\n");
    built_t b = load();
    assert_int_equal(b.report.faces, 2);
    for (int f = 0; f < 2; f++) {
        assert_memory_equal(b.model.face_normals + 3 * f, along_z, 3);
        assert_memory_equal(b.model.morph_face_normals + 3 * f, along_z, 3);
    }
    free(b.bytes);
    put(TRIANGLE "v 2 2 0\nf 1 2 3\nf 2 4 3\n", TRIANGLE "v 9 9 0\nf 1 2 3\nf 2 4 3\n");
    b = load();
    assert_int_equal(b.report.faces, 2);
    free(b.bytes);
    put(TRIANGLE "v 2 2 0\nf 1 2 3\nf 2 4 3\n", TRIANGLE "v 2 2 0\nf 1 2 3\nf 2 4 3\n");
    b = load();
    assert_int_equal(b.report.faces, 1);
    free(b.bytes);
}

/* ---- bounds ----------------------------------------------------------------------------------------------------- */

/* A ball of 12 x 20 quads, cut; second: moved by `away`, and drawn out by `stretch` where x > 0. On a grid, so that nothing is
 * rounded. */
static double on_grid(double x) { return round(64 * x) / 64; }

static void put_balls(double away, double stretch) {
    char *texts[2];
    for (int frame = 0; frame < 2; frame++) {
        size_t used = 0;
        texts[frame] = malloc(1 << 16);
        assert_non_null(texts[frame]);
        for (int r = 0; r <= 12; r++) {
            for (int s = 0; s < 20; s++) {
                const double u = 3.14159265358979 * (r + 0.3) / 12.6, v = 2 * 3.14159265358979 * s / 20;
                const double x = 8 * sin(u) * cos(v), y = 8 * cos(u), z = -8 * sin(u) * sin(v);
                const double more = frame && x > 0 ? stretch : 1;
                used += (size_t)sprintf(texts[frame] + used, "v %.6f %.6f %.6f\n", on_grid(x * more + (frame ? away : 0)),
                                        on_grid(y), on_grid(z * more));
            }
        }
        for (int r = 0; r < 12; r++) {
            for (int s = 0; s < 20; s++) {
                const int a = 20 * r + s + 1, b = 20 * r + (s + 1) % 20 + 1;
                used += (size_t)sprintf(texts[frame] + used, "f %d %d %d\nf %d %d %d\n", a, a + 20, b, b, a + 20, b + 20);
            }
        }
    }
    put(texts[0], texts[1]);
    free(texts[0]);
    free(texts[1]);
}

static bool holds(const int centre[3], int radius, const int point[3]) {
    int64_t squares = 0;
    for (int k = 0; k < 3; k++) {
        squares += (int64_t)(point[k] - centre[k]) * (point[k] - centre[k]);
    }
    return squares <= (int64_t)radius * radius;
}

static void spheres_hold_all_that_is_between(void **state) {
    (void)state;
    put_balls(3, 2);
    built_t b = load();
    const tuile_model_t *m = &b.model;
    random_source_t random = random_seed(4);
    uint32_t vertex = 0;
    for (uint32_t k = 0; k < m->cluster_count; k++) {
        const uint8_t *cluster = m->clusters + MODEL_CLUSTER_BYTES * (size_t)k;
        const int centre[3] = {decoder_s16(cluster), decoder_s16(cluster + 2), decoder_s16(cluster + 4)};
        const int whole[3] = {m->centre[0], m->centre[1], m->centre[2]};
        for (unsigned v = 0; v < cluster[CLUSTER_AT_VERTEX_COUNT]; v++, vertex++) {
            for (int i = 0; i <= 20; i++) {
                const int32_t t = i == 0 ? 0 : i == 1 ? 32768 : random_between(&random, 0, 32768);
                int point[3];
                for (int axis = 0; axis < 3; axis++) {
                    const int p = decoder_s16(m->positions + 6 * (size_t)vertex + 2 * axis);
                    const int q = decoder_s16(m->morph_positions + 6 * (size_t)vertex + 2 * axis);
                    point[axis] = (int)floor(p + (double)(q - p) * t / 32768 + 0.5);
                    assert_in_range(point[axis] + 32768, m->low[axis] + 32768, m->high[axis] + 32768);
                }
                assert_true(holds(centre, (int)decoder_u16(cluster + 6), point));
                assert_true(holds(whole, m->radius, point));
            }
        }
    }
    assert_int_equal(vertex, m->vertex_count);
    free(b.bytes);
}

/* Corners go from place to place on a circle; on the way they are cut to 1/256 step, some of them outwards. */
static void spheres_have_room_for_rounding(void **state) {
    (void)state;
    put("v -3 -4 0\nv 3 4 0\nv -3 4 0\nf 1 2 3\n", "v -4 -3 0\nv 4 3 0\nv -4 3 0\nf 1 2 3\n");
    built_t b;
    sim_error_t error = {""};
    const mesh_options_t options = {.morph_path = second_path, .step = 1};
    if (mesh_load(first_path, 0, &options, &b.bytes, &b.size, &b.report, &error) != 0) { fail_msg("%s", error.text); }
    assert_int_equal(tuile_model_open(&b.model, b.bytes, b.size), 0);
    assert_int_equal(decoder_s16(b.model.positions), -3);
    assert_int_equal(decoder_s16(b.model.morph_positions), -4);
    const uint8_t *cluster = b.model.clusters;
    const int centre[3] = {256 * decoder_s16(cluster), 256 * decoder_s16(cluster + 2), 256 * decoder_s16(cluster + 4)};
    const int point[3] = {-3 * 256 - 1, -4 * 256, 0}; /* at 1 / 32768 of the way: 3.0039^2 + 4^2 > 5^2 */
    assert_false(holds((int[3]){0, 0, 0}, 5 * 256, point));
    assert_true(holds(centre, 256 * (int)decoder_u16(cluster + 6), point));
    free(b.bytes);
}

/* What turns on the way may be seen from anywhere; what only moves keeps its cone. */
static void cones_are_kept_where_all_goes_one_way(void **state) {
    (void)state;
    put_balls(3, 1);
    built_t b = load();
    for (uint32_t k = 0; k < b.model.cluster_count; k++) {
        assert_true(b.model.clusters[MODEL_CLUSTER_BYTES * k + CLUSTER_AT_CUTOFF] < 255);
    }
    free(b.bytes);
    put_balls(3, 1.5);
    b = load();
    uint32_t vertex = 0;
    unsigned kept = 0, lost = 0;
    for (uint32_t k = 0; k < b.model.cluster_count; k++) {
        const uint8_t *cluster = b.model.clusters + MODEL_CLUSTER_BYTES * (size_t)k;
        bool as_one = true;
        const uint32_t first = vertex;
        for (unsigned v = 0; v < cluster[CLUSTER_AT_VERTEX_COUNT]; v++, vertex++) {
            for (int axis = 0; axis < 3; axis++) {
                const size_t at = 6 * (size_t)vertex + 2 * (size_t)axis, of = 6 * (size_t)first + 2 * (size_t)axis;
                as_one = as_one && decoder_s16(b.model.morph_positions + at) - decoder_s16(b.model.positions + at) ==
                                       decoder_s16(b.model.morph_positions + of) - decoder_s16(b.model.positions + of);
            }
        }
        assert_int_equal(cluster[CLUSTER_AT_CUTOFF] < 255, as_one);
        kept += as_one;
        lost += !as_one;
    }
    assert_true(kept > 0 && lost > 0);
    free(b.bytes);
}

/* ---- errors ----------------------------------------------------------------------------------------------------- */

static void other_faces_are_refused_by_what_differs(void **state) {
    (void)state;
    const mesh_options_t options = {.morph_path = second_path};
    put(TRIANGLE "f 1 2 3\n", TRIANGLE "f 1 2 3\nf 3 2 1\n");
    fails_with(&options, 0, "first.obj has 1 faces (0 of them degenerate) and ");
    fails_with(&options, 0, "second.obj 2 (0): key frames need the same faces");
    put(DECODER_SQUARE "f 1 2 3\nf 1 2 3 4\n", DECODER_SQUARE "f 1 2 3 4\nf 1 2 3\n");
    fails_with(&options, 0, "face 0 has 3 corners in ");
    put(DECODER_SQUARE "f 1 2 3 4\n", DECODER_SQUARE "f 1 2 3\n");
    fails_with(&options, 0, "first.obj has 4 vertices and ");
    put(TRIANGLE "f 1 2 3\n", "v 0 0\n");
    fails_with(&options, 0, "second.obj:1: vertex 1 has 2 of 3 coordinates");
    (void)remove(second_path);
    fails_with(&options, 0, "second.obj: No such file");
}

static void corners_at_other_vertices_are_refused(void **state) {
    (void)state;
    static const char *const format =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n4 0 0\n4 4 0\n0 4 0\n3 0 1 %d\n";
    char text[1024];
    (void)snprintf(text, sizeof text, format, 2);
    (void)snprintf(first_path, sizeof first_path, "%s", folder_put_text("first.ply", text));
    (void)snprintf(text, sizeof text, format, 3);
    (void)snprintf(second_path, sizeof second_path, "%s", folder_put_text("second.ply", text));
    fails_with(&(mesh_options_t){.morph_path = second_path}, 0, "corner 2 of face 0 is vertex 2 in ");
}

static void trees_and_simplification_are_refused(void **state) {
    (void)state;
    put_balls(1, 1);
    fails_with(&(mesh_options_t){.morph_path = second_path, .tree = true}, 0, "a display tree holds for one key frame");
    fails_with(&(mesh_options_t){.morph_path = second_path}, 100, "second key frame cannot be simplified");
}

static void a_compiled_model_without_one_is_refused(void **state) {
    (void)state;
    uint8_t *bytes;
    size_t size;
    put(TRIANGLE "f 1 2 3\n", TRIANGLE "f 1 2 3\n");
    assert_int_equal(mesh_load(first_path, 0, NULL, &bytes, &size, NULL, NULL), 0);
    (void)snprintf(first_path, sizeof first_path, "%s", folder_put_bytes("first.tuile", bytes, size));
    free(bytes);
    fails_with(&(mesh_options_t){.morph_path = second_path}, 0, "without a second key frame");
}

/* ---- damage ----------------------------------------------------------------------------------------------------- */

static int opens_with(const built_t *b, size_t at, unsigned value, size_t count) {
    tuile_model_t model;
    uint8_t *copy = malloc(b->size);
    assert_non_null(copy);
    memcpy(copy, b->bytes, b->size);
    for (size_t i = 0; i < count; i++) {
        copy[at + i] = (uint8_t)(value >> 8 * i);
    }
    const uint32_t crc = model_crc32(0, copy + MODEL_AT_VERSION, b->size - MODEL_AT_VERSION);
    for (size_t i = 0; i < 4; i++) {
        copy[MODEL_AT_CRC32 + i] = (uint8_t)(crc >> 8 * i);
    }
    const int result = tuile_model_open(&model, copy, b->size);
    free(copy);
    return result;
}

static void half_a_key_frame_or_one_out_of_the_box_does_not_open(void **state) {
    (void)state;
    put(TRIANGLE "f 1 2 3\n", "v 0 0 0\nv 4 0 0\nv 1 4 0\nf 1 2 3\n");
    built_t b = load();
    const size_t positions = decoder_u32(b.bytes + MODEL_AT_MORPH_POSITIONS);
    assert_int_equal(opens_with(&b, MODEL_AT_MORPH_POSITIONS, (unsigned)positions, 4), 0);
    assert_int_equal(opens_with(&b, MODEL_AT_MORPH_POSITIONS, 0, 4), TUILE_ERROR_MODEL);
    assert_int_equal(opens_with(&b, MODEL_AT_MORPH_NORMALS, 0, 4), TUILE_ERROR_MODEL);
    assert_int_equal(opens_with(&b, MODEL_AT_MORPH_FACE_NORMALS, 0, 4), TUILE_ERROR_MODEL);
    assert_int_equal(opens_with(&b, MODEL_AT_MORPH_POSITIONS, (unsigned)b.size - 16, 4), TUILE_ERROR_MODEL);
    assert_int_equal(opens_with(&b, positions, (unsigned)(uint16_t)b.model.high[0], 2), 0);
    assert_int_equal(opens_with(&b, positions, (unsigned)(uint16_t)(b.model.high[0] + 1), 2), TUILE_ERROR_MODEL);
    assert_int_equal(opens_with(&b, positions, (unsigned)(uint16_t)(b.model.low[0] - 1), 2), TUILE_ERROR_MODEL);
    free(b.bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_key_frames_stand_on_one_grid),
        cmocka_unit_test(places_are_one_only_if_they_are_in_both),
        cmocka_unit_test(polygons_stay_if_they_move_as_one),
        cmocka_unit_test(a_face_without_an_area_in_one_key_frame_is_kept),
        cmocka_unit_test(spheres_hold_all_that_is_between),
        cmocka_unit_test(spheres_have_room_for_rounding),
        cmocka_unit_test(cones_are_kept_where_all_goes_one_way),
        cmocka_unit_test(other_faces_are_refused_by_what_differs),
        cmocka_unit_test(corners_at_other_vertices_are_refused),
        cmocka_unit_test(trees_and_simplification_are_refused),
        cmocka_unit_test(a_compiled_model_without_one_is_refused),
        cmocka_unit_test(half_a_key_frame_or_one_out_of_the_box_does_not_open),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
