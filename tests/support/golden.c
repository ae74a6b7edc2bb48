#include "golden.h"

#include "check.h"
#include "command.h"

#include <sys/stat.h>

static bool updating(void) {
    const char *update = getenv("UPDATE_GOLDEN");
    return update && strcmp(update, "1") == 0;
}

static const char *build_folder(void) {
    const char *build = getenv("BUILD");
    return build && *build ? build : "build";
}

/* FNV-1a, 64 bits. */
static uint64_t fnv(const uint8_t *bytes, size_t size_bytes) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size_bytes; i++) {
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    }
    return hash;
}

void golden_open(golden_t *golden, const char *path) {
    memset(golden, 0, sizeof *golden);
    golden->path = path;
    golden->old = command_read(path, NULL);
    if (!golden->old && !updating()) { fail_msg("%s is missing; `make golden` writes it", path); }
}

bool golden_hash(golden_t *golden, const char *name, const char *hash) {
    char line[128];
    const size_t used = strlen(golden->written);
    (void)snprintf(line, sizeof line, "%s %s\n", name, hash);
    assert_true(used + strlen(line) < sizeof golden->written);
    (void)snprintf(golden->written + used, sizeof golden->written - used, "%s", line);
    const bool same = updating() || strstr(golden->old, line) != NULL;
    golden->wrong += !same;
    return same;
}

/* Tells where the picture differs and leaves it in build/golden. */
static void show_difference(const sim_picture_t *drawn, const sim_picture_t *golden, const char *name) {
    char folder[512], path[640];
    sim_picture_t difference = {0};
    sim_error_t error = {""};
    size_t count = 0;
    (void)snprintf(folder, sizeof folder, "%s/golden", build_folder());
    (void)mkdir(folder, 0777);
    (void)snprintf(path, sizeof path, "%s/%s.png", folder, name);
    if (sim_picture_write(drawn, path, &error) != 0) { print_message("%s\n", error.text); }
    (void)snprintf(path, sizeof path, "%s/%s-difference.png", folder, name);
    if (sim_picture_difference(drawn, golden, &difference, &count, &error) != 0 ||
        sim_picture_write(&difference, path, &error) != 0) {
        print_message("%s\n", error.text);
    }
    sim_picture_free(&difference);
    print_message("%s: %zu pixels differ: %s\n", name, count, path);
}

static bool picture_same(const sim_picture_t *drawn, const char *name) {
    char path[128];
    sim_picture_t golden = {0};
    sim_error_t error = {""};
    (void)snprintf(path, sizeof path, "tests/golden/%s.png", name);
    if (updating()) {
        if (sim_picture_write(drawn, path, &error) != 0) { fail_msg("%s", error.text); }
        return true;
    }
    if (sim_picture_read(&golden, path, &error) != 0) {
        print_message("%s\n", error.text);
        return false;
    }
    const bool same = golden.width == drawn->width && golden.height == drawn->height &&
                      memcmp(golden.rgb, drawn->rgb, (size_t)3 * drawn->width * drawn->height) == 0;
    if (!same) { show_difference(drawn, &golden, name); }
    sim_picture_free(&golden);
    return same;
}

void golden_picture(golden_t *golden, const char *name, const uint8_t *bytes, size_t size_bytes, const sim_picture_t *drawn) {
    char hash[24];
    (void)snprintf(hash, sizeof hash, "%016llx", (unsigned long long)fnv(bytes, size_bytes));
    const bool same = golden_hash(golden, name, hash);
    if (!picture_same(drawn, name) && same) { golden->wrong++; }
}

void golden_close(golden_t *golden) {
    if (updating()) {
        command_write(golden->path, golden->written, strlen(golden->written));
    } else if (strcmp(golden->old, golden->written) != 0) {
        fail_msg("%s does not say what was drawn just now; if that is meant, `make golden` and look at the pictures\n%s",
                 golden->path, golden->written);
    }
    free(golden->old);
    if (golden->wrong) { fail_msg("%u pictures differ from those of %s", golden->wrong, golden->path); }
}
