/* tuile mesh with images, vertex colours and key frames: options, report, warnings and errors. */
#include "support/check.h"
#include "support/cli.h"
#include "support/images.h"

static void put_image(const char *name, uint32_t width, uint32_t height) {
    uint8_t *pixels = calloc((size_t)width * height, 3);
    assert_non_null(pixels);
    for (size_t i = 0; i < (size_t)width * height; i++) {
        pixels[3 * i] = (uint8_t)(i * 8);
        pixels[3 * i + 1] = (uint8_t)(i / 32 * 8);
    }
    image_bytes_t bytes = images_png_rgb(width, height, pixels, false);
    FILE *file = fopen(cli_path(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes.at, 1, bytes.size, file), bytes.size);
    assert_int_equal(fclose(file), 0);
    free(bytes.at);
    free(pixels);
}

static void put_textured(void) {
    put_image("image.png", 32, 32);
    cli_put("textured.mtl", "newmtl wood\nKd 1 1 1\nmap_Kd image.png\n");
    cli_put("textured.obj", "mtllib textured.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 3 0\nvt 0 1\nusemtl wood\nf 1/1 2/2 3/3\n");
}

static void textures_are_reported(void **state) {
    (void)state;
    put_textured();
    char *out = cli_good("mesh @/textured.obj -o @/t.tuile");
    /* 1024 + 256 + 64 + 16 + 4 + 1 texels of 2 bytes; +-1.5 repeats of 32 texels: 48 * 256 fits. */
    assert_non_null(
        strstr(out, "texture 0: 32x32 rgb565, levels 6, s repeated, t repeated, 2730 bytes, materials 0 (uv_bits 8)\n"));
    assert_non_null(strstr(out, "texture coordinates 12 bytes\n"));
    free(out);
    out = cli_good("mesh @/textured.obj -o @/t.tuile --texture-format palette4 --texture-size 16 --no-mips --texture-key 000000");
    assert_non_null(
        strstr(out, "texture 0: 16x16 palette4, levels 1, s repeated, t repeated, keyed, 160 bytes, materials 0 (uv_bits 8)\n"));
    free(out);
    put_image("image.png", 24, 40);
    out = cli_good("mesh @/textured.obj -o @/t.tuile");
    assert_non_null(strstr(out, "\n  --texture-fast: "));
    free(out);
    out = cli_good("mesh @/textured.obj -o @/t.tuile --texture-fast --no-mips");
    assert_non_null(strstr(out, "texture 0: 16x32 rgb565, levels 1,"));
    assert_null(strstr(out, "--texture-fast"));
    free(out);
    out = cli_good("mesh @/textured.obj -o @/t.tuile --no-textures");
    assert_null(strstr(out, "texture"));
    free(out);
}

static void a_compiled_model_is_told_to_be_what_it_is(void **state) {
    (void)state;
    put_textured();
    cli_good_silent("mesh @/textured.obj -o @/t.tuile");
    char *out = cli_good("mesh @/t.tuile -o @/again.tuile");
    assert_non_null(strstr(out, "texture 0: 32x32 rgb565"));
    free(out);
}

static void a_missing_image_is_an_error_that_names_the_way_out(void **state) {
    (void)state;
    put_textured();
    cli_put("textured.mtl", "newmtl wood\nKd 1 1 1\nmap_Kd gone.png\n");
    cli_fails("mesh @/textured.obj -o @/gone.tuile", "gone.png", "--no-textures");
    cli_fails("render @/textured.obj --hash", "wood", "--no-textures");
    cli_good_silent("mesh @/textured.obj -o @/plain.tuile --no-textures");
    cli_good_silent("render @/textured.obj --hash --no-textures");
}

static void wrong_values_are_refused_by_name(void **state) {
    static const char *const cases[][2] = {
        {"--texture-format bmp", "rgb565, palette8, palette4, grey8, argb4444"},
        {"--texture-size 0", "1 to 2048"},
        {"--texture-size 2049", "1 to 2048"},
        {"--texture-key red", "RRGGBB"},
        {"--texture-key 12345", "RRGGBB"},
        {"--vertex-colours some", "vertices, faces"},
        {"--morph", "value"},
    };
    (void)state;
    put_textured();
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        char line[200];
        (void)snprintf(line, sizeof line, "mesh @/textured.obj -o @/wrong.tuile %s", cases[i][0]);
        cli_fails(line, "--", cases[i][1]);
        (void)snprintf(line, sizeof line, "render @/textured.obj --hash %s", cases[i][0]);
        cli_fails(line, "--", cases[i][1]);
    }
}

static void warnings_go_to_stderr_and_the_model_is_written(void **state) {
    command_result_t result;
    (void)state;
    put_textured();
    cli_put("bare.obj", "mtllib textured.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
    cli_shell(&result, "% mesh @/bare.obj -o @/bare.tuile");
    assert_int_equal(result.code, 0);
    assert_int_equal(strncmp(result.err, "warning: ", 9), 0);
    assert_non_null(strstr(result.err, "has no texture coordinates"));
    command_free(&result);
    assert_true(cli_exists("bare.tuile"));
}

static void key_frames_are_reported_and_go_without_trees(void **state) {
    (void)state;
    cli_put("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    cli_put("two.obj", "v 0 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    char *out = cli_good("mesh @/one.obj --morph @/two.obj -o @/both.tuile");
    assert_non_null(strstr(out, "second key frame 30 bytes\n")); /* 3 x 9 and 1 x 3 */
    free(out);
    cli_fails("mesh @/one.obj --morph @/two.obj --tree -o @/no.tuile", "display tree", "one key frame");
    cli_fails("mesh @/one.obj --morph @/cube.obj -o @/no.tuile", "1 faces", "key frames need the same faces");
}

static void vertex_colours_are_reported(void **state) {
    (void)state;
    cli_put("colours.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
            "property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n");
    char *out = cli_good("mesh @/colours.ply -o @/c.tuile");
    assert_non_null(strstr(out, "vertex colours 12 bytes\n"));
    free(out);
    out = cli_good("mesh @/colours.ply -o @/c.tuile --vertex-colours faces");
    assert_null(strstr(out, "vertex colours"));
    free(out);
}

static void help_names_the_options(void **state) {
    static const char *const options[] = {"--no-textures",    "--texture-format", "--texture-size", "--texture-fast",
                                          "--texture-key",    "--mips",           "--no-mips",      "--bilinear",
                                          "--vertex-colours", "--morph"};
    char *mesh = cli_good("mesh --help"), *render = cli_good("render --help");
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(options); i++) {
        if (!strstr(mesh, options[i]) || !strstr(render, options[i])) { fail_msg("%s", options[i]); }
    }
    free(mesh);
    free(render);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(textures_are_reported),
        cmocka_unit_test(a_compiled_model_is_told_to_be_what_it_is),
        cmocka_unit_test(a_missing_image_is_an_error_that_names_the_way_out),
        cmocka_unit_test(wrong_values_are_refused_by_name),
        cmocka_unit_test(warnings_go_to_stderr_and_the_model_is_written),
        cmocka_unit_test(key_frames_are_reported_and_go_without_trees),
        cmocka_unit_test(vertex_colours_are_reported),
        cmocka_unit_test(help_names_the_options),
    };
    return cmocka_run_group_tests(tests, cli_set_up, cli_tear_down);
}
