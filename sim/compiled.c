#include "compiled.h"

#include "c_source.h"
#include "output.h"

#include <errno.h>
#include <string.h>

/* 0, or the errno of the failure. */
static int put(FILE *file, const compiled_kind_t *kind, const uint8_t *bytes, size_t size_bytes, const char *name) {
    errno = 0;
    if (!name) { return fwrite(bytes, 1, size_bytes, file) == size_bytes ? 0 : errno ? errno : EIO; }
    kind->put_heading(file, bytes, size_bytes, name);
    return c_put_words(file, bytes, size_bytes, name);
}

int compiled_write(const compiled_kind_t *kind, const uint8_t *bytes, size_t size_bytes, const char *path, const char *name,
                   sim_error_t *error) {
    char made_up[C_NAME_MAX_CHARS + 1];
    const bool source = strcmp(c_extension(path), ".c") == 0;
    if (!source && strcmp(c_extension(path), kind->extension) != 0) {
        return sim_fail(error, "%s: compiled %s are %s or .c files; give it one of these ends", path, kind->things,
                        kind->extension);
    }
    if (source && (!name || !*name)) {
        c_default_name(path, kind->prefix, made_up);
        name = made_up;
    }
    if (source && !c_is_identifier(name)) {
        return sim_fail(error, "\"%.80s\" is no name for an object in C; take a letter, then letters, digits and _, at most %d",
                        name, C_NAME_MAX_CHARS);
    }
    output_t output;
    if (output_open(&output, path, error) != 0) { return -1; }
    const int reason = put(output.file, kind, bytes, size_bytes, source ? name : NULL);
    if (reason != 0) {
        output_discard(&output);
        return sim_fail(error, "%s: cannot write: %s", path, strerror(reason));
    }
    return output_close(&output, error);
}
