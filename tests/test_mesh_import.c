/* Importing models: what files of several formats become, and what is said of damaged ones. The bytes are read back by a reader of
 * our own. */
#include "support/check.h"

#include <math.h>
#include <sys/stat.h>

#include "../sim/mesh/mesh.h"
#include "support/decoder.h"
#include "support/folder.h"

/* ---- normals and colours ---------------------------------------------------------------------------------------- */

static void test_file_normals(void **state) {
    (void)state;
    compiled_t c =
        decoder_compile_file(folder_put_text("lit.obj", DECODER_SQUARE "vn 0 0 2\nvn 0 3 0\nf 1//1 2//1 3//2 4//2\n"), NULL);
    const int8_t along_z[3] = {0, 0, 127}, along_y[3] = {0, 127, 0};
    assert_memory_equal(c.model.faces[0].normals[1], along_z, 3);
    assert_memory_equal(c.model.faces[0].normals[2], along_y, 3);
    decoder_drop(&c);
}

static void test_two_materials(void **state) {
    (void)state;
    (void)folder_put_text("two.mtl", "newmtl red\nKd 1 0.2 0\nnewmtl blue\nKd 0 0.4 0.8\n");
    compiled_t c = decoder_compile_file(folder_put_text("two.obj", "mtllib two.mtl\n" DECODER_CUBE_VERTICES
                                                                   "usemtl red\nf 1 4 3 2\nf 5 6 7 8\n"
                                                                   "usemtl blue\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n"),
                                        NULL);
    const uint8_t materials[2][16] = {/* opaque; no emission, highlight, texture */
                                      {255, 51, 0, 255, 0, 0, 0, 0, 0, 255},
                                      {0, 102, 204, 255, 0, 0, 0, 0, 0, 255}};
    assert_int_equal(c.model.material_count, 2);
    assert_memory_equal(c.model.materials, materials, sizeof materials);
    assert_int_equal(c.mesh.position_count, 8); /* joined across the two */
    decoder_check_faces(&c.model, &c.mesh);
    assert_int_equal(decoder_face_of_source(&c.model, 1)->material, 0);
    assert_int_equal(decoder_face_of_source(&c.model, 2)->material, 1);
    decoder_drop(&c);
}

static void test_vertex_colours(void **state) {
    (void)state;
    compiled_t c = decoder_compile_file(
        folder_put_text("colours.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                       "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                                       "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                                       "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 30 0\n1 1 0 0 0 90\n"
                                       "3 0 1 2\n3 1 3 2\n"),
        NULL);
    const uint8_t first[3] = {255, 10, 0}, second[3] = {170, 10, 30};
    assert_memory_equal(c.model.materials + 16 * (size_t)decoder_face_of_source(&c.model, 0)->material, first, 3);
    assert_memory_equal(c.model.materials + 16 * (size_t)decoder_face_of_source(&c.model, 1)->material, second, 3);
    decoder_drop(&c);
}

/* ---- formats ---------------------------------------------------------------------------------------------------- */

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
        compiled_t c = decoder_compile_file(folder_put_text(files[f][0], files[f][1]), NULL);
        assert_int_equal(c.report.faces, 1);
        assert_int_equal(c.report.polygons, 1);
        decoder_check_faces(&c.model, &c.mesh);
        decoder_drop(&c);
    }
    /* The facets of an STL file share nothing and bear their own normals: they are joined and smoothed none the less. */
    compiled_t c = decoder_compile_file(
        folder_put_text("roof.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                    "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\n"
                                    "vertex -1 0 0.5\nendloop\nendfacet\nendsolid a\n"),
        NULL);
    assert_int_equal(c.mesh.position_count, 4);
    assert_true(decoder_face_of_source(&c.model, 0)->normals[0][0] > 10);
    decoder_drop(&c);
}

/* Two instances of a triangle in a node tree: one moved, one mirrored, whose front has to stay in front. */
static void test_node_transforms(void **state) {
    (void)state;
    compiled_t c = decoder_compile_file(
        folder_put_text(
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
        const decoder_face_t *face = decoder_face_of_source(&c.model, s);
        assert_memory_equal(face->plane, front, 3);
        assert_memory_equal(face->normals[0], front, 3);
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 3; k++) {
                double at = c.model.step * ((double)face->q[i][k] + c.model.offset[k]);
                assert_true(fabs(at - (s ? mirrored : moved)[i][k]) <= c.model.step / 2);
            }
        }
    }
    decoder_drop(&c);
}

/* ---- damaged files ---------------------------------------------------------------------------------------------- */

typedef struct damage {
    const char *file, *text, *words; /* the error has to contain */
} damage_t;

static void test_damaged_files(void **state) {
    (void)state;
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                              "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    static const damage_t damages[] = {
        {"empty.obj", "", "is empty"},
        {"vertices.obj", DECODER_SQUARE, "no face"},
        {"noise.obj", "\x01\x02 what is this\n\xff\xfe\n", "no face"},
        {"range.obj", DECODER_SQUARE "f 1 2 3\nf 1 2 9\n", ":6: the face asks for vertex 9, but there are 4"},
        {"zero.obj", DECODER_SQUARE "f 0 1 2\n", ":5: the face asks for vertex 0"},
        {"back.obj", DECODER_SQUARE "f -1 -2 -5\n", ":5: the face asks for vertex -5"},
        {"normal.obj", DECODER_SQUARE "vn 0 0 1\nf 1//1 2//1 3//2\n", ":6: the face asks for normal 2, but there are 1"},
        {"word.obj", DECODER_SQUARE "f 1 2 x\n", ":5: \"x\" is no corner"},
        {"bare.obj", DECODER_SQUARE "f\nf 1 2 3\n", ":5: a face with 0 corners: the file is damaged"},
        {"cut.obj", DECODER_SQUARE "f 1 2 3\nf 1 3", ":6: a face with 2 corners: the file is cut short"},
        {"cut2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 2 3", ":5: vertex 4 has 2 of 3 coordinates: the file is cut short"},
        {"text.obj", "v 0 0 0\nv 1 x 0\nv 0 1 0\nf 1 2 3\n", ":2: vertex 2 has 1 of 3 coordinates: the file is damaged"},
        {"nan.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", ":2: vertex 2 (1, 0, nan) is not finite"},
        {"inf.obj", "v 0 0 0\nv 1 0 0\nv 0 -inf 0\nf 1 2 3\n", ":3: vertex 3 (0, -inf, 0) is not finite"},
        {"huge.obj", "v 0 0 0\nv 1e60 0 0\nv 0 1 0\nf 1 2 3\n", ":2: vertex 2"},
        {"joined.obj", DECODER_SQUARE "f 1 2 \\\n3\nf 1 2 \\\n\\\n7\n", ":7: the face asks for vertex 7"},
        {"points.obj", DECODER_SQUARE "f 1 1 2\nf 3 3 3\n", "(2 degenerate faces"},
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
        const char *path = folder_put_text(damages[d].file, damages[d].text);
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
        int status = mesh_import(&mesh, folder_put_text(plies[d].file, text), &error);
        if (status != -1 || !strstr(error.text, plies[d].words)) {
            fail_msg("%s: status %d, \"%s\"", plies[d].file, status, error.text);
        }
    }
}

static void test_no_file(void **state) {
    (void)state;
    mesh_t mesh;
    sim_error_t error = {""};
    assert_int_equal(mesh_import(&mesh, folder_path("nowhere.obj"), &error), -1);
    assert_non_null(strstr(error.text, "nowhere.obj: No such file"));
    assert_int_equal(mkdir(folder_path("dir.obj"), 0700), 0);
    assert_int_equal(mesh_import(&mesh, folder_path("dir.obj"), &error), -1);
    assert_non_null(strstr(error.text, "dir.obj: is a folder"));
    assert_int_equal(mesh_import(&mesh, folder_path("nowhere.obj"), NULL), -1);
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
        int status = mesh_import(&mesh, folder_put_bytes("cut.ply", file, length), &error);
        if (status != (length == size ? 0 : -1)) {
            fail_msg("%zu of %zu bytes: status %d, \"%s\"", length, size, status, error.text);
        }
        mesh_free(&mesh);
    }
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_file_normals), cmocka_unit_test(test_two_materials),           cmocka_unit_test(test_vertex_colours),
        cmocka_unit_test(test_formats),      cmocka_unit_test(test_node_transforms),         cmocka_unit_test(test_damaged_files),
        cmocka_unit_test(test_no_file),      cmocka_unit_test(test_binary_ply_cut_anywhere),
    };
    return cmocka_run_group_tests_name("mesh import", tests, folder_make, folder_remove);
}
