/* Model files, whole or not at all: the bytes go to a new file beside the old one, which takes its place only when every one of
 * them is known to be on the disk. What is no ordinary file (a pipe, a device) has no place to be taken and is written to
 * directly.
 */
#include "stages.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

/* Writes and closes. */
static int put_all(int descriptor, const uint8_t *bytes, size_t size_bytes, const char *name, bool sync) {
    FILE *file = fdopen(descriptor, "wb");
    if (!file) {
        int trouble = errno;
        (void)close(descriptor);
        return trouble;
    }
    errno = 0;
    int trouble = 0;
    if (name) {
        trouble = put_source(file, bytes, size_bytes, name);
    } else if (fwrite(bytes, 1, size_bytes, file) != size_bytes) {
        trouble = errno ? errno : EIO;
    }
    if (!trouble && (fflush(file) || (sync && fsync(descriptor)))) { trouble = errno ? errno : EIO; }
    if (fclose(file) && !trouble) { trouble = errno ? errno : EIO; }
    return trouble;
}

/* ---- taking the place of a file ------------------------------------------------------------------------------- */

static int fail(const char *path, const char *what, int trouble, sim_error_t *error) {
    return sim_fail(error, "%s: %s: %s; nothing was written", path, what, strerror(trouble));
}

static int replace(const char *path, const uint8_t *bytes, size_t size_bytes, const char *name, mode_t mode, sim_error_t *error) {
    size_t length = strlen(path) + sizeof ".XXXXXX";
    char *beside = malloc(length);
    if (!beside) { return sim_fail(error, "%s: out of memory; nothing was written", path); }
    (void)snprintf(beside, length, "%s.XXXXXX", path);
    int descriptor = mkstemp(beside);
    if (descriptor < 0) {
        int trouble = errno;
        free(beside);
        return fail(path, "no file can be made in its folder", trouble, error);
    }
    int trouble = fchmod(descriptor, mode) ? errno : 0;
    if (trouble) {
        (void)close(descriptor);
    } else {
        trouble = put_all(descriptor, bytes, size_bytes, name, true);
    }
    if (!trouble && rename(beside, path)) { trouble = errno; }
    if (trouble) { (void)unlink(beside); }
    free(beside);
    return trouble ? fail(path, "writing failed", trouble, error) : 0;
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
    mode_t mask = umask(0);
    (void)umask(mask);
    mode_t mode = 0666 & ~mask;
    struct stat status;
    bool there = !stat(path, &status);
    if (there && !S_ISREG(status.st_mode)) {
        if (S_ISDIR(status.st_mode)) { return sim_fail(error, "%s: is a folder; name a file in it", path); }
        int descriptor = open(path, O_WRONLY | O_CLOEXEC);
        int trouble = descriptor < 0 ? errno : put_all(descriptor, bytes, size_bytes, source ? name : NULL, false);
        return trouble ? sim_fail(error, "%s: writing failed: %s", path, strerror(trouble)) : 0;
    }
    char *real = there ? realpath(path, NULL) : NULL; /* what a link names is replaced, not the link */
    int result = replace(real ? real : path, bytes, size_bytes, source ? name : NULL, there ? status.st_mode & 0777 : mode, error);
    free(real);
    return result;
}
