/* Model files: the bytes as they are, or as a C source. */
#include "../compiled.h"
#include "stages.h"

#include <stdio.h>

static void put_heading(FILE *file, const uint8_t *bytes, size_t size_bytes, const char *name) {
    (void)fprintf(
        file,
        "/* A compiled model for tuile_model_open(&model, %s, sizeof %s).\n"
        " * %u faces, %u vertices in %u clusters (at most %u each), %u materials, %zu bytes; one step is %u * 2^%d units.\n"
        " * The words are little-endian, as the machine has to be. */\n",
        name, name, model_u32(bytes + MODEL_AT_FACES), model_u32(bytes + MODEL_AT_VERTICES), model_u32(bytes + MODEL_AT_CLUSTERS),
        model_u16(bytes + MODEL_AT_CLUSTER_MAX), model_u16(bytes + MODEL_AT_MATERIALS), size_bytes,
        model_u32(bytes + MODEL_AT_STEP_MANTISSA), model_i16(bytes + MODEL_AT_STEP_EXPONENT));
}

int mesh_write(const uint8_t *bytes, size_t size_bytes, const char *path, const char *name, sim_error_t *error) {
    static const compiled_kind_t kind = {"models", ".tuile", "model_", put_heading};
    if (size_bytes < MODEL_HEADER_BYTES) {
        return sim_fail(error, "%s: %zu bytes are no model; nothing was written", path, size_bytes);
    }
    return compiled_write(&kind, bytes, size_bytes, path, name, error);
}
