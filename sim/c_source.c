#include "c_source.h"

#include <errno.h>
#include <string.h>

static const char *const reserved[] = {"auto",     "break",  "case",     "char",     "const",    "continue", "default",  "do",
                                       "double",   "else",   "enum",     "extern",   "float",    "for",      "goto",     "if",
                                       "inline",   "int",    "long",     "register", "restrict", "return",   "short",    "signed",
                                       "sizeof",   "static", "struct",   "switch",   "typedef",  "union",    "unsigned", "void",
                                       "volatile", "while",  "uint32_t", "main"};

static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
static bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool c_is_identifier(const char *name) {
    size_t length = strlen(name);
    if (!is_letter(name[0]) || name[0] == '_' || length > C_NAME_MAX_CHARS) { /* C keeps most names with a leading _ to itself */
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

const char *c_extension(const char *path) {
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    return dot && (!slash || dot > slash) ? dot : "";
}

void c_default_name(const char *path, const char *prefix, char name[C_NAME_MAX_CHARS + 1]) {
    const char *slash = strrchr(path, '/'), *stem = slash ? slash + 1 : path;
    size_t length = strlen(stem) - strlen(c_extension(path)), at = 0;
    for (int attempt = 0; attempt < 2 && (attempt == 0 || !c_is_identifier(name)); attempt++) {
        at = attempt ? (size_t)snprintf(name, C_NAME_MAX_CHARS + 1, "%s", prefix) : 0;
        for (size_t i = 0; i < length && at < C_NAME_MAX_CHARS; i++) {
            name[at++] = stem[i];
            if (!is_letter(stem[i]) && !is_digit(stem[i])) { name[at - 1] = '_'; }
        }
        name[at] = 0;
    }
}

int c_put_words(FILE *file, const uint8_t *bytes, size_t size_bytes, const char *name) {
    const size_t words = (size_bytes + 3) / 4;
    (void)fprintf(file,
                  "#include <stdint.h>\n\n"
                  "extern const uint32_t %s[%zu];\n"
                  "const uint32_t %s[%zu] = {",
                  name, words, name, words);
    for (size_t w = 0; w < words; w++) {
        uint8_t b[4] = {0};
        memcpy(b, bytes + 4 * w, size_bytes - 4 * w < 4 ? size_bytes - 4 * w : 4);
        const uint32_t word = b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
        if (fprintf(file, "%s0x%08x,", w % 8 ? " " : "\n    ", word) < 0) { return errno ? errno : EIO; }
    }
    return fprintf(file, "\n};\n") < 0 ? (errno ? errno : EIO) : 0;
}
