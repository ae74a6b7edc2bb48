#include "folder.h"

#include "check.h"

#include <dirent.h>
#include <unistd.h>

static char folder[64];

int folder_make(void **state) {
    (void)state;
    (void)snprintf(folder, sizeof folder, "/tmp/test_mesh_XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

const char *folder_name(void) { return folder; }

size_t folder_files(bool remove_them) {
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

int folder_remove(void **state) {
    (void)state;
    (void)folder_files(true);
    return rmdir(folder);
}

const char *folder_path(const char *name) {
    static char path[128];
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

const char *folder_put_bytes(const char *name, const void *bytes, size_t size_bytes) {
    const char *path = folder_path(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size_bytes, file), size_bytes);
    assert_int_equal(fclose(file), 0);
    return path;
}

const char *folder_put_text(const char *name, const char *text) { return folder_put_bytes(name, text, strlen(text)); }
