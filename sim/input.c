#include "input.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 0, or the errno of the failure; EFBIG when there is more. */
static int read_all(FILE *file, size_t most_bytes, uint8_t **bytes, size_t *size_bytes) {
    size_t room = 0, size = 0;
    uint8_t *read = NULL;
    for (bool more = true; more;) {
        room = room ? 2 * room : 1 << 16;
        room = room > most_bytes + 1 ? most_bytes + 1 : room;
        uint8_t *larger = size < room ? realloc(read, room) : NULL;
        if (!larger) {
            free(read);
            return size < room ? ENOMEM : EFBIG;
        }
        read = larger;
        errno = 0;
        size += fread(read + size, 1, room - size, file);
        more = size == room;
    }
    if (ferror(file)) {
        free(read);
        return errno ? errno : EIO;
    }
    *bytes = read;
    *size_bytes = size;
    return 0;
}

int input_read(const char *path, size_t most_bytes, uint8_t **bytes, size_t *size_bytes, sim_error_t *error) {
    FILE *file = fopen(path, "rb");
    *bytes = NULL;
    *size_bytes = 0;
    if (!file) { return sim_fail(error, "%s: cannot read: %s", path, strerror(errno)); }
    const int reason = read_all(file, most_bytes, bytes, size_bytes);
    (void)fclose(file);
    if (reason == EFBIG) { return sim_fail(error, "%s: more than %zu MB, the most that is read", path, most_bytes >> 20); }
    return reason ? sim_fail(error, "%s: cannot read: %s", path, strerror(reason)) : 0;
}
