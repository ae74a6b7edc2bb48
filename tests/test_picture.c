/* Pictures: files of them, also where the disk is full or the folder is not there; differences, sizes, contact sheets. */
#define _XOPEN_SOURCE 700

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <dirent.h>
#include <limits.h>
#include <signal.h>
#include <stdbool.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../sim/picture.h"
#include "../sim/sheet.h"

static char folder[PATH_MAX];

static int make_folder(void **state) {
    const char *root = getenv("TMPDIR");

    (void)state;
    snprintf(folder, sizeof folder, "%s/picture-XXXXXX", root && *root ? root : "/tmp");
    return mkdtemp(folder) ? 0 : -1;
}

static unsigned count_files(void) {
    DIR *dir = opendir(folder);
    unsigned count = 0;
    struct dirent *entry;

    assert_non_null(dir);
    while ((entry = readdir(dir))) {
        count += entry->d_name[0] != '.';
    }
    closedir(dir);
    return count;
}

static int remove_folder(void **state) {
    DIR *dir = opendir(folder);
    struct dirent *entry;
    char path[PATH_MAX + 300];

    (void)state;
    while (dir && (entry = readdir(dir))) {
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (unlink(path)) { rmdir(path); }
    }
    if (dir) { closedir(dir); }
    return rmdir(folder);
}

static const char *in_folder(const char *name) {
    static char path[PATH_MAX + 300];

    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_bytes(const char *path, const char *bytes, size_t size) {
    FILE *file = fopen(path, "wb");

    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static sim_picture_t make(uint32_t width, uint32_t height, uint32_t seed) {
    sim_picture_t picture;

    assert_int_equal(sim_picture_create(&picture, width, height, NULL), 0);
    for (size_t i = 0; i < (size_t)width * height * 3; i++) {
        seed = seed * 1664525u + 1013904223u;
        picture.rgb[i] = (uint8_t)(seed >> 24);
    }
    return picture;
}

static void check_equal(const sim_picture_t *a, const sim_picture_t *b) {
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_memory_equal(a->rgb, b->rgb, (size_t)a->width * a->height * 3);
}

static void check_one_line(const sim_error_t *error, const char *part) {
    if (!strstr(error->text, part)) { fail_msg("\"%s\" has no \"%s\"", error->text, part); }
    assert_null(strchr(error->text, '\n'));
}

/* ---- files ------------------------------------------------------------------------------------------------- */

static void test_round_trip(void **state) {
    static const uint32_t sizes[][2] = {{1, 1}, {3, 2}, {240, 320}, {1, 500}, {701, 1}};
    static const char *const names[] = {"a.png", "a.ppm"};

    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (size_t k = 0; k < 2; k++) {
            sim_picture_t out = make(sizes[i][0], sizes[i][1], (uint32_t)i + 1), in;
            sim_error_t error = {""};
            assert_int_equal(sim_picture_write(&out, in_folder(names[k]), &error), 0);
            assert_int_equal(sim_picture_read(&in, in_folder(names[k]), &error), 0);
            assert_string_equal(error.text, "");
            check_equal(&in, &out);
            sim_picture_free(&in);
            sim_picture_free(&out);
            unlink(in_folder(names[k]));
            assert_int_equal(count_files(), 0);
        }
    }
}

static void test_ppm_bytes(void **state) {
    static const char expected[] = "P6\n2 1\n255\n\x01\x02\x03\xFF\xFE\x00";
    sim_picture_t picture;
    char bytes[64];
    FILE *file;

    (void)state;
    sim_picture_create(&picture, 2, 1, NULL);
    memcpy(picture.rgb, "\x01\x02\x03\xFF\xFE\x00", 6);
    assert_int_equal(sim_picture_write(&picture, in_folder("b.ppm"), NULL), 0);
    sim_picture_free(&picture);
    file = fopen(in_folder("b.ppm"), "rb");
    assert_non_null(file);
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), 17);
    fclose(file);
    assert_memory_equal(bytes, expected, 17);

    write_bytes(in_folder("c.ppm"), "P6 # a remark\n# another\n1\t1 255\nabc", 35);
    assert_int_equal(sim_picture_read(&picture, in_folder("c.ppm"), NULL), 0);
    assert_memory_equal(picture.rgb, "abc", 3);
    sim_picture_free(&picture);
    unlink(in_folder("b.ppm"));
    unlink(in_folder("c.ppm"));
}

/* A PNG that others write and that we did not: 1 x 1, grey, 8 bits, value 128, made by hand (stored deflate block). */
static void test_reads_a_grey_png(void **state) {
    static const char bytes[] = "\x89PNG\r\n\x1a\n"
                                "\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\0\0\0\0\x3a\x7e\x9b\x55"
                                "\0\0\0\x0dIDAT\x78\x01\x01\x02\0\xfd\xff\0\x80\0\x82\0\x81\xc3\x6e\x25\xe0"
                                "\0\0\0\0IEND\xae\x42\x60\x82";
    sim_picture_t picture;
    sim_error_t error = {""};

    (void)state;
    write_bytes(in_folder("d.png"), bytes, sizeof bytes - 1);
    if (sim_picture_read(&picture, in_folder("d.png"), &error)) { fail_msg("%s", error.text); }
    assert_memory_equal(picture.rgb, "\x80\x80\x80", 3);
    sim_picture_free(&picture);
    unlink(in_folder("d.png"));
}

static void test_write_replaces_and_keeps(void **state) {
    sim_picture_t one = make(5, 5, 1), two = make(6, 4, 2), in;
    char link[PATH_MAX + 300];
    struct stat status;

    (void)state;
    assert_int_equal(sim_picture_write(&one, in_folder("e.png"), NULL), 0);
    assert_int_equal(sim_picture_write(&two, in_folder("e.png"), NULL), 0);
    assert_int_equal(sim_picture_read(&in, in_folder("e.png"), NULL), 0);
    check_equal(&in, &two);
    sim_picture_free(&in);
    assert_int_equal(count_files(), 1);

    /* through a symbolic link, which stays one */
    strcpy(link, in_folder("f.png"));
    assert_int_equal(symlink("e.png", link), 0);
    assert_int_equal(sim_picture_write(&one, link, NULL), 0);
    assert_int_equal(lstat(link, &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(sim_picture_read(&in, in_folder("e.png"), NULL), 0);
    check_equal(&in, &one);
    sim_picture_free(&in);
    unlink(link);
    unlink(in_folder("e.png"));
    assert_int_equal(count_files(), 0);
    sim_picture_free(&one);
    sim_picture_free(&two);
}

static void test_unwritable(void **state) {
    sim_picture_t picture = make(3, 3, 1), empty = {0};
    sim_error_t error;

    (void)state;
    write_bytes(in_folder("file"), "x", 1);
    assert_int_equal(sim_picture_write(&picture, in_folder("missing/a.png"), &error), -1);
    check_one_line(&error, "missing/a.png: cannot create: No such file or directory");
    assert_int_equal(sim_picture_write(&picture, in_folder("file/a.ppm"), &error), -1);
    check_one_line(&error, "Not a directory");
    assert_int_equal(mkdir(in_folder("g.png"), 0777), 0);
    assert_int_equal(sim_picture_write(&picture, in_folder("g.png"), &error), -1);
    check_one_line(&error, "it is a folder");
    assert_int_equal(sim_picture_write(&picture, in_folder("h.gif"), &error), -1);
    check_one_line(&error, "end the name in .png or .ppm");
    assert_int_equal(sim_picture_write(&picture, ".png", &error), -1);
    assert_int_equal(sim_picture_write(&empty, in_folder("h.png"), &error), -1);
    check_one_line(&error, "empty");
    assert_int_equal(sim_picture_write(&picture, in_folder("missing/a.png"), NULL), -1);
    assert_int_equal(count_files(), 2);
    rmdir(in_folder("g.png"));
    unlink(in_folder("file"));
    sim_picture_free(&picture);
}

/* Nothing is read-only to root, who therefore becomes somebody else for a moment. */
static void test_read_only_folder(void **state) {
    bool root = geteuid() == 0;
    sim_picture_t picture;
    sim_error_t error;
    int result;

    (void)state;
    assert_int_equal(chmod(folder, 0555), 0);
    if (root && seteuid(65534)) { skip(); }
    picture = make(3, 3, 1);
    result = sim_picture_write(&picture, in_folder("a.png"), &error);
    sim_picture_free(&picture);
    if (root) { assert_int_equal(seteuid(0), 0); }
    assert_int_equal(chmod(folder, 0755), 0);
    assert_int_equal(result, -1);
    check_one_line(&error, "Permission denied");
    assert_int_equal(count_files(), 0);
}

/* A device is written to as it is, not replaced; the full one says so at the latest when it is closed. */
static void test_full_device(void **state) {
    static const char *const names[] = {"full.png", "full.ppm"};
    struct stat status;
    sim_error_t error;

    (void)state;
    if (stat("/dev/full", &status) || !S_ISCHR(status.st_mode)) { skip(); }
    for (size_t i = 0; i < 2; i++) {
        for (unsigned large = 0; large < 2; large++) {
            /* small: the failure is seen at the flush only */
            sim_picture_t picture = make(large ? 300 : 2, large ? 300 : 2, 1);
            assert_int_equal(symlink("/dev/full", in_folder(names[i])), 0);
            assert_int_equal(sim_picture_write(&picture, in_folder(names[i]), &error), -1);
            check_one_line(&error, "No space left on device");
            unlink(in_folder(names[i]));
            assert_int_equal(count_files(), 0);
            sim_picture_free(&picture);
        }
    }
    assert_int_equal(stat("/dev/full", &status), 0);
    assert_true(S_ISCHR(status.st_mode));
}

/* A disk that fills up in the middle: what was there stays, and nothing half-written is left. */
static void test_disk_full_in_the_middle(void **state) {
    static const char *const names[] = {"i.png", "i.ppm"};
    struct rlimit before, small;

    (void)state;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, SIG_IGN);
    for (size_t i = 0; i < 2; i++) {
        sim_picture_t old = make(4, 4, 1), large = make(300, 300, 2), in;
        sim_error_t error = {""};
        int result;
        assert_int_equal(sim_picture_write(&old, in_folder(names[i]), &error), 0);
        small = before;
        small.rlim_cur = 100000;
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
        result = sim_picture_write(&large, in_folder(names[i]), &error);
        setrlimit(RLIMIT_FSIZE, &before);
        assert_int_equal(result, -1);
        check_one_line(&error, "File too large");
        assert_int_equal(count_files(), 1);
        assert_int_equal(sim_picture_read(&in, in_folder(names[i]), &error), 0);
        check_equal(&in, &old);
        sim_picture_free(&in);
        sim_picture_free(&old);
        sim_picture_free(&large);
        unlink(in_folder(names[i]));
    }
    signal(SIGXFSZ, SIG_DFL);
}

static void test_unreadable(void **state) {
    static const struct {
        const char *bytes;
        size_t size;
        const char *part;
    } cases[] = {
        {"", 0, "too short"},
        {"P", 1, "too short"},
        {"P6\n2 2\n255\nabc", 14, "ends too early"},
        {"P6\n2 2\n65535\n", 13, "not a binary PPM"},
        {"P6\n0 2\n255\n", 11, "each side must be"},
        {"P6\n99999999999 2\n255\n", 21, "not a binary PPM"},
        {"P6\n-1 2\n255\n", 12, "not a binary PPM"},
        {"P6\n#", 4, "not a binary PPM"},
        {"hello, world", 12, "not a readable PNG"},
        {"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", 16, "not a readable PNG"},
    };
    sim_picture_t picture;
    sim_error_t error;

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_bytes(in_folder("bad"), cases[i].bytes, cases[i].size);
        assert_int_equal(sim_picture_read(&picture, in_folder("bad"), &error), -1);
        check_one_line(&error, cases[i].part);
        assert_null(picture.rgb);
    }
    unlink(in_folder("bad"));
    assert_int_equal(sim_picture_read(&picture, in_folder("none.png"), &error), -1);
    check_one_line(&error, "none.png: cannot open: No such file or directory");
}

/* Every beginning of a good PNG is refused, but for the few that lack only what comes after the pixels. */
static void test_cut_png(void **state) {
    sim_picture_t picture = make(20, 20, 3), in;
    static char bytes[4096];
    size_t size, good = 0;
    FILE *file;

    (void)state;
    assert_int_equal(sim_picture_write(&picture, in_folder("j.png"), NULL), 0);
    file = fopen(in_folder("j.png"), "rb");
    assert_non_null(file);
    size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    assert_true(size > 1000 && size < sizeof bytes);
    for (size_t length = 0; length < size; length++) {
        write_bytes(in_folder("k.png"), bytes, length);
        if (sim_picture_read(&in, in_folder("k.png"), NULL) == 0) {
            check_equal(&in, &picture);
            sim_picture_free(&in);
            good++;
        }
    }
    assert_true(good < 20);
    sim_picture_free(&picture);
    unlink(in_folder("j.png"));
    unlink(in_folder("k.png"));
}

/* ---- arithmetic -------------------------------------------------------------------------------------------- */

/* Pictures whose red is a letter, as rows of text. */
static sim_picture_t letters(uint32_t width, uint32_t height, const char *text) {
    sim_picture_t picture;

    assert_int_equal(sim_picture_create(&picture, width, height, NULL), 0);
    for (uint32_t i = 0; i < width * height; i++) {
        picture.rgb[3 * i] = (uint8_t)text[i];
    }
    return picture;
}

static void check_letters(const sim_picture_t *picture, uint32_t width, uint32_t height, const char *text) {
    assert_int_equal(picture->width, width);
    assert_int_equal(picture->height, height);
    for (uint32_t i = 0; i < width * height; i++) {
        assert_int_equal(picture->rgb[3 * i], text[i]);
    }
}

static void test_turn(void **state) {
    static const struct {
        int turns;
        uint32_t width, height;
        const char *text;
    } cases[] = {
        {0, 3, 2, "abcdef"},  {1, 2, 3, "daebfc"},  {2, 3, 2, "fedcba"}, {3, 2, 3, "cfbead"},
        {-1, 2, 3, "cfbead"}, {-2, 3, 2, "fedcba"}, {5, 2, 3, "daebfc"},
    };
    sim_picture_t picture = letters(3, 2, "abcdef"), out;

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(sim_picture_turn(&picture, cases[i].turns, &out, NULL), 0);
        check_letters(&out, cases[i].width, cases[i].height, cases[i].text);
        sim_picture_free(&out);
    }
    sim_picture_free(&picture);
}

static void test_magnify(void **state) {
    sim_picture_t picture = letters(2, 2, "abcd"), out;
    sim_error_t error;

    (void)state;
    assert_int_equal(sim_picture_magnify(&picture, 3, &out, &error), 0);
    check_letters(&out, 6, 6, "aaabbbaaabbbaaabbbcccdddcccdddcccddd");
    sim_picture_free(&out);
    assert_int_equal(sim_picture_magnify(&picture, 0, &out, &error), -1);
    check_one_line(&error, "0 times");
    assert_int_equal(sim_picture_magnify(&picture, SIM_PICTURE_MAX_PX, &out, &error), -1);
    assert_null(out.rgb);
    sim_picture_free(&picture);
}

static void test_halve(void **state) {
    /* (1 + 2 + 4 + 6) / 4 = 3.25, (3 + 8) / 2 = 5.5 rounded up, (10 + 13) / 2 = 11.5, 7 */
    sim_picture_t picture = letters(3, 3, "\x01\x02\x03\x04\x06\x08\x0A\x0D\x07"), out;

    (void)state;
    assert_int_equal(sim_picture_halve(&picture, &out, NULL), 0);
    check_letters(&out, 2, 2, "\x03\x06\x0C\x07");
    sim_picture_free(&out);
    sim_picture_free(&picture);
}

static void test_difference(void **state) {
    sim_picture_t a = make(4, 3, 1), b = make(4, 3, 1), c = make(3, 4, 1), out;
    sim_error_t error;
    size_t count = 99;

    (void)state;
    assert_int_equal(sim_picture_difference(&a, &b, &out, &count, NULL), 0);
    assert_int_equal(count, 0);
    for (size_t i = 0; i < 12; i++) {
        assert_int_equal(out.rgb[3 * i], out.rgb[3 * i + 1]); /* grey */
    }
    sim_picture_free(&out);

    memcpy(sim_picture_at(&a, 2, 1), "\x00\x50\x60", 3);
    memcpy(sim_picture_at(&b, 2, 1), "\xFF\x50\x60", 3);
    memcpy(sim_picture_at(&a, 0, 2), "\x10\x20\x31", 3);
    memcpy(sim_picture_at(&b, 0, 2), "\x10\x20\x30", 3);
    assert_int_equal(sim_picture_difference(&a, &b, &out, &count, NULL), 0);
    assert_int_equal(count, 2);
    assert_memory_equal(sim_picture_at(&out, 2, 1), "\xFF\x00\x00", 3);
    assert_memory_equal(sim_picture_at(&out, 0, 2), "\x40\x00\x00", 3);
    sim_picture_free(&out);

    assert_int_equal(sim_picture_difference(&a, &c, &out, &count, &error), -1);
    check_one_line(&error, "4 x 3 and 3 x 4");
    assert_null(out.rgb);
    sim_picture_free(&a);
    sim_picture_free(&b);
    sim_picture_free(&c);
}

static void test_size_limits(void **state) {
    sim_picture_t out;
    sim_error_t error;

    (void)state;
    assert_int_equal(sim_picture_create(&out, 0, 1, &error), -1);
    check_one_line(&error, "0 x 1");
    assert_int_equal(sim_picture_create(&out, 1, SIM_PICTURE_MAX_PX + 1, &error), -1);
    assert_int_equal(sim_picture_create(&out, SIM_PICTURE_MAX_PX, 1, &error), 0);
    sim_picture_free(&out);
    assert_null(out.rgb);
}

/* ---- sheets ------------------------------------------------------------------------------------------------ */

static void test_sheet(void **state) {
    sim_picture_t pictures[3] = {letters(2, 1, "ab"), letters(1, 2, "cd"), letters(2, 2, "efgh")}, out;

    (void)state;
    /* two columns of cells of 2 x 2, margins of 1 */
    assert_int_equal(
        sim_sheet(pictures, 3, &(sim_sheet_config_t){.columns = 2, .margin_px = 1, .background = {'.', 0, 0}}, &out, NULL), 0);
    check_letters(&out, 7, 7,
                  "......."
                  ".ab.c.."
                  "....d.."
                  "......."
                  ".ef...."
                  ".gh...."
                  ".......");
    sim_picture_free(&out);

    /* about square: two columns again; more columns than pictures are cut to them */
    assert_int_equal(sim_sheet(pictures, 3, &(sim_sheet_config_t){.background = {'.', 0, 0}}, &out, NULL), 0);
    check_letters(&out, 4, 4, "abc...d.ef..gh..");
    sim_picture_free(&out);
    assert_int_equal(sim_sheet(pictures, 3, &(sim_sheet_config_t){.columns = 9, .background = {'.', 0, 0}}, &out, NULL), 0);
    check_letters(&out, 6, 2, "abc.ef..d.gh");
    sim_picture_free(&out);

    /* halved: ab -> 97.5 rounded up, cd -> 99.5, efgh -> 102.5 */
    assert_int_equal(sim_sheet(pictures, 3, &(sim_sheet_config_t){.columns = 3, .half_size = true}, &out, NULL), 0);
    check_letters(&out, 3, 1, "bdg");
    sim_picture_free(&out);
    for (unsigned i = 0; i < 3; i++) {
        sim_picture_free(&pictures[i]);
    }
}

static void test_sheet_errors(void **state) {
    sim_picture_t pictures[2] = {letters(1, 1, "a"), {0}}, out;
    sim_error_t error;

    (void)state;
    assert_int_equal(sim_sheet(pictures, 0, &(sim_sheet_config_t){0}, &out, &error), -1);
    check_one_line(&error, "no pictures");
    assert_int_equal(sim_sheet(pictures, 2, &(sim_sheet_config_t){0}, &out, &error), -1);
    check_one_line(&error, "picture 2");
    assert_int_equal(sim_sheet(pictures, 1, &(sim_sheet_config_t){.margin_px = UINT32_MAX}, &out, &error), -1);
    check_one_line(&error, "too large");
    assert_null(out.rgb);
    sim_picture_free(&pictures[0]);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void) {
    static const struct CMUnitTest tests[] = {
        IN_FOLDER(test_round_trip),
        IN_FOLDER(test_ppm_bytes),
        IN_FOLDER(test_reads_a_grey_png),
        IN_FOLDER(test_write_replaces_and_keeps),
        IN_FOLDER(test_unwritable),
        IN_FOLDER(test_read_only_folder),
        IN_FOLDER(test_full_device),
        IN_FOLDER(test_disk_full_in_the_middle),
        IN_FOLDER(test_unreadable),
        IN_FOLDER(test_cut_png),
        IN_FOLDER(test_turn),
        IN_FOLDER(test_magnify),
        IN_FOLDER(test_halve),
        IN_FOLDER(test_difference),
        IN_FOLDER(test_size_limits),
        IN_FOLDER(test_sheet),
        IN_FOLDER(test_sheet_errors),
    };

    return cmocka_run_group_tests_name("picture", tests, NULL, NULL);
}
