/* Model files: the bytes as they are, or as a C source. */
#include "../c_source.h"
#include "../output.h"
#include "stages.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* ---- the two formats: 0, or the errno of the failure ---------------------------------------------------------- */

static int put_source(FILE *file, const uint8_t *bytes, size_t size_bytes, const char *name) {
    (void)fprintf(
        file,
        "/* A compiled model for tuile_model_open(&model, %s, sizeof %s).\n"
        " * %u faces, %u vertices in %u clusters (at most %u each), %u materials, %zu bytes; one step is %u * 2^%d units.\n"
        " * The words are little-endian, as the machine has to be. */\n",
        name, name, model_u32(bytes + MODEL_AT_FACES), model_u32(bytes + MODEL_AT_VERTICES), model_u32(bytes + MODEL_AT_CLUSTERS),
        model_u16(bytes + MODEL_AT_CLUSTER_MAX), model_u16(bytes + MODEL_AT_MATERIALS), size_bytes,
        model_u32(bytes + MODEL_AT_STEP_MANTISSA), model_i16(bytes + MODEL_AT_STEP_EXPONENT));
    return c_put_words(file, bytes, size_bytes, name);
}

int mesh_write(const uint8_t *bytes, size_t size_bytes, const char *path, const char *name, sim_error_t *error) {
    char made_up[C_NAME_MAX_CHARS + 1];
    bool source = !strcmp(c_extension(path), ".c");
    if (!source && strcmp(c_extension(path), ".tuile")) {
        return sim_fail(error, "%s: compiled models are .tuile or .c files; give it one of these ends", path);
    }
    if (size_bytes < MODEL_HEADER_BYTES) {
        return sim_fail(error, "%s: %zu bytes are no model; nothing was written", path, size_bytes);
    }
    if (source && (!name || !*name)) {
        c_default_name(path, "model_", made_up);
        name = made_up;
    }
    if (source && !c_is_identifier(name)) {
        return sim_fail(error, "\"%.80s\" is no name for an object in C; take a letter, then letters, digits and _, at most %d",
                        name, C_NAME_MAX_CHARS);
    }
    output_t output;
    if (output_open(&output, path, error)) { return -1; }
    errno = 0;
    if (source ? put_source(output.file, bytes, size_bytes, name) != 0 : fwrite(bytes, 1, size_bytes, output.file) != size_bytes) {
        const int reason = errno ? errno : EIO;
        output_discard(&output);
        return sim_fail(error, "%s: cannot write: %s", path, strerror(reason));
    }
    return output_close(&output, error);
}
