/* Files of our own: compiled models written, as data and as C source, and loaded again; and disks that are full. */
#include "support/check.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../sim/mesh/mesh.h"
#include "support/decoder.h"
#include "support/folder.h"

static void test_write_and_load(void **state) {
    (void)state;
    (void)folder_files(true);
    compiled_t c = decoder_compile_file(folder_put_text("cube.obj", DECODER_CUBE_VERTICES DECODER_CUBE_FACES), NULL);
    sim_error_t error = {""};
    uint8_t *bytes;
    size_t size_bytes;
    mesh_report_t report;
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("cube.tuile"), NULL, &error), 0);
    assert_int_equal(folder_files(false), 2);
    assert_int_equal(mesh_load(folder_path("cube.tuile"), 0, NULL, &bytes, &size_bytes, &report, &error), 0);
    assert_int_equal(size_bytes, c.size_bytes);
    assert_memory_equal(bytes, c.bytes, size_bytes);
    assert_int_equal(report.faces, 6);
    assert_int_equal(report.polygons, 6);
    free(bytes);
    assert_int_equal(mesh_load(folder_path("cube.obj"), 0, NULL, &bytes, &size_bytes, NULL, &error), 0);
    assert_memory_equal(bytes, c.bytes, size_bytes);
    free(bytes);
    assert_int_equal(mesh_load(folder_path("cube.obj"), 6, NULL, &bytes, &size_bytes, &report, &error), 0); /* few enough as quads */
    assert_int_equal(report.polygons, 6);
    free(bytes);
    assert_int_equal(mesh_load(folder_path("cube.tuile"), 5, NULL, &bytes, &size_bytes, &report, &error), -1);
    assert_non_null(strstr(error.text, "more than the 5"));
    for (size_t at = 0; at < c.size_bytes; at++) { /* any byte changed, any length: refused */
        uint8_t kept = c.bytes[at];
        c.bytes[at] = (uint8_t)(kept ^ 16u);
        assert_int_equal(mesh_load(folder_put_bytes("bad.tuile", c.bytes, c.size_bytes), 0, NULL, &bytes, &size_bytes, NULL, &error), -1);
        c.bytes[at] = kept;
        assert_int_equal(mesh_load(folder_put_bytes("bad.tuile", c.bytes, at), 0, NULL, &bytes, &size_bytes, NULL, &error), -1);
    }
    assert_non_null(strstr(error.text, "cut short"));
    decoder_drop(&c);
}

static void test_source_file(void **state) {
    (void)state;
    compiled_t c = decoder_compile_file(folder_put_text("cube.obj", DECODER_CUBE_VERTICES DECODER_CUBE_FACES), NULL);
    sim_error_t error = {""};
    char command[500];
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("3-cube.c"), NULL, &error), 0);
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("my.c"), "my_cube", &error), 0);
    (void)folder_put_text("main.c",
                          "#include <stdint.h>\n#include <stdio.h>\nextern const uint32_t model_3_cube[], my_cube[];\n"
                          "int main(void) {\n    return fwrite(model_3_cube, 1, model_3_cube[1], stdout) != model_3_cube[1] ||\n"
                          "           fwrite(my_cube, 1, my_cube[1], stdout) != my_cube[1];\n}\n");
    (void)snprintf(command, sizeof command,
                   "cd %s && ${CC:-cc} -std=c11 -Wall -Wextra -Wpedantic -Werror main.c 3-cube.c my.c -o main && ./main > both",
                   folder_name());
    assert_int_equal(system(command), 0);
    uint8_t both[20000];
    FILE *file = fopen(folder_path("both"), "rb");
    assert_non_null(file);
    assert_int_equal(fread(both, 1, sizeof both, file), 2 * c.size_bytes);
    assert_int_equal(fclose(file), 0);
    assert_memory_equal(both, c.bytes, c.size_bytes);
    assert_memory_equal(both + c.size_bytes, c.bytes, c.size_bytes);
    const char *const names[] = {"a b", "3d", "for", "", "_x", "caf\xc3\xa9", "main", "a-b"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("no.c"), names[n], &error), *names[n] ? -1 : 0);
    }
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("no.obj"), NULL, &error), -1);
    assert_non_null(strstr(error.text, ".tuile or .c"));
    decoder_drop(&c);
}

static void test_write_fails(void **state) {
    (void)state;
    (void)folder_files(true);
    compiled_t c = decoder_compile_file(folder_put_text("cube.obj", DECODER_CUBE_VERTICES DECODER_CUBE_FACES), NULL);
    sim_error_t error = {""};
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("nowhere/a.tuile"), NULL, &error), -1);
    assert_int_equal(mkdir(folder_path("dir.c"), 0700), 0);
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("dir.c"), NULL, &error), -1);
    assert_int_equal(symlink("/dev/full", folder_path("full.c")), 0); /* a device: written to, and the failure seen */
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("full.c"), "a", &error), -1);
    assert_non_null(strstr(error.text, "No space left"));
    /* A disk that is full after any number of bytes leaves the old file as it was, and nothing else. */
    (void)folder_put_text("old.tuile", "the old one");
    size_t files = folder_files(false);
    struct rlimit limit, unlimited;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
    limit = unlimited;
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    for (size_t room = 0; room < c.size_bytes; room += 37) {
        limit.rlim_cur = room;
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        int status = mesh_write(c.bytes, c.size_bytes, folder_path("old.tuile"), NULL, &error);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &unlimited), 0);
        assert_int_equal(status, -1);
    }
    (void)signal(SIGXFSZ, handler);
    assert_int_equal(folder_files(false), files);
    char text[20] = {0};
    FILE *file = fopen(folder_path("old.tuile"), "rb");
    assert_non_null(file);
    assert_int_equal(fread(text, 1, sizeof text - 1, file), 11);
    assert_int_equal(fclose(file), 0);
    assert_string_equal(text, "the old one");
    /* Through a link, what it names is replaced. */
    assert_int_equal(symlink("old.tuile", folder_path("link.tuile")), 0);
    assert_int_equal(mesh_write(c.bytes, c.size_bytes, folder_path("link.tuile"), NULL, &error), 0);
    struct stat status;
    assert_int_equal(lstat(folder_path("link.tuile"), &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(stat(folder_path("old.tuile"), &status), 0);
    assert_int_equal(status.st_size, c.size_bytes);
    decoder_drop(&c);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_write_and_load),
        cmocka_unit_test(test_source_file),
        cmocka_unit_test(test_write_fails),
    };
    return cmocka_run_group_tests_name("mesh write", tests, folder_make, folder_remove);
}
