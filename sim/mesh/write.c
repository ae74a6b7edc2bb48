/* Model files: the bytes as they are, or as a C source. */
#include "../output.h"
#include "stages.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#define NAME_MAX_CHARS 63 /* what C promises to tell apart */

static const char *const reserved[] = {"auto",     "break",  "case",     "char",     "const",    "continue", "default",  "do",
                                       "double",   "else",   "enum",     "extern",   "float",    "for",      "goto",     "if",
                                       "inline",   "int",    "long",     "register", "restrict", "return",   "short",    "signed",
                                       "sizeof",   "static", "struct",   "switch",   "typedef",  "union",    "unsigned", "void",
                                       "volatile", "while",  "uint32_t", "main"};

static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static bool is_identifier(const char *name) {
    size_t length = strlen(name);
    if (!is_letter(name[0]) || name[0] == '_' || length > NAME_MAX_CHARS) { /* C keeps most names with a leading _ to itself */
        return false;
    }
    for (size_t i = 0; i < length; i++) {
        if (!is_letter(name[i]) && !is_digit(name[i])) { return false; }
    }
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++) {
        if (!strcmp(name, reserved[i])) { return false; }
    }
    return true;
}

static const char *extension(const char *path) {
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    return dot && (!slash || dot > slash) ? dot : "";
}

/* The file's name without its end, other characters as _; "model_" in front where that is no identifier. */
static void default_name(const char *path, char name[NAME_MAX_CHARS + 1]) {
    const char *slash = strrchr(path, '/'), *stem = slash ? slash + 1 : path;
    size_t length = strlen(stem) - strlen(extension(path)), at = 0;
    for (int attempt = 0; attempt < 2 && (attempt == 0 || !is_identifier(name)); attempt++) {
        at = attempt ? (size_t)snprintf(name, NAME_MAX_CHARS + 1, "model_") : 0;
        for (size_t i = 0; i < length && at < NAME_MAX_CHARS; i++) {
            name[at++] = stem[i];
            if (!is_letter(stem[i]) && !is_digit(stem[i])) { name[at - 1] = '_'; }
        }
        name[at] = 0;
    }
}

/* ---- the two formats: 0, or the errno of the failure ---------------------------------------------------------- */

static int put_source(FILE *file, const uint8_t *bytes, size_t size_bytes, const char *name) {
    size_t words = (size_bytes + 3) / 4;
    int exponent = model_i16(bytes + MODEL_AT_STEP_EXPONENT);
    (void)fprintf(
        file,
        "/* A compiled model for tuile_model_open(&model, %s, sizeof %s).\n"
        " * %u faces, %u vertices in %u clusters (at most %u each), %u materials, %zu bytes; one step is %u * 2^%d units.\n"
        " * The words are little-endian, as the machine has to be. */\n"
        "#include <stdint.h>\n\n"
        "extern const uint32_t %s[%zu];\n"
        "const uint32_t %s[%zu] = {",
        name, name, model_u32(bytes + MODEL_AT_FACES), model_u32(bytes + MODEL_AT_VERTICES), model_u32(bytes + MODEL_AT_CLUSTERS),
        model_u16(bytes + MODEL_AT_CLUSTER_MAX), model_u16(bytes + MODEL_AT_MATERIALS), size_bytes,
        model_u32(bytes + MODEL_AT_STEP_MANTISSA), exponent, name, words, name, words);
    for (size_t w = 0; w < words; w++) {
        uint8_t word[4] = {0};
        memcpy(word, bytes + 4 * w, size_bytes - 4 * w < 4 ? size_bytes - 4 * w : 4);
        if (fprintf(file, "%s0x%08x,", w % 8 ? " " : "\n    ", model_u32(word)) < 0) { return errno ? errno : EIO; }
    }
    return fprintf(file, "\n};\n") < 0 ? (errno ? errno : EIO) : 0;
}

int mesh_write(const uint8_t *bytes, size_t size_bytes, const char *path, const char *name, sim_error_t *error) {
    char made_up[NAME_MAX_CHARS + 1];
    bool source = !strcmp(extension(path), ".c");
    if (!source && strcmp(extension(path), ".tuile")) {
        return sim_fail(error, "%s: compiled models are .tuile or .c files; give it one of these ends", path);
    }
    if (size_bytes < MODEL_HEADER_BYTES) {
        return sim_fail(error, "%s: %zu bytes are no model; nothing was written", path, size_bytes);
    }
    if (source && (!name || !*name)) {
        default_name(path, made_up);
        name = made_up;
    }
    if (source && !is_identifier(name)) {
        return sim_fail(error, "\"%.80s\" is no name for an object in C; take a letter, then letters, digits and _, at most %d",
                        name, NAME_MAX_CHARS);
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
