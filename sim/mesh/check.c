/* What Assimp does not say.
 *
 * Tried with Assimp 5.2.5: an OBJ file that breaks off in the middle of a line loads as if nothing were missing, one with numbers
 * like 1e60 or nan loads (texture coordinates as 0), and an index out of range fails without a line number. A PLY file that breaks
 * off loads with indices that were never written, or never returns; an OFF file whose header promises more than follows loads with
 * empty faces, or asks for all memory there is. So these three are read over here first; every other format is left to Assimp.
 */
#include "stages.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

int mesh_read_file(const char *path, char **text, size_t *size_bytes, sim_error_t *error) {
    struct stat status;
    *text = NULL;
    *size_bytes = 0;
    if (stat(path, &status)) { return sim_fail(error, "%s: %s; check the name", path, strerror(errno)); }
    if (S_ISDIR(status.st_mode)) { return sim_fail(error, "%s: is a folder; name a model file in it", path); }
    FILE *file = fopen(path, "rb");
    if (!file) { return sim_fail(error, "%s: %s; check its permissions", path, strerror(errno)); }
    size_t capacity = 0, used = 0, got = 0;
    bool room = true;
    do { /* not by the size of stat, which pipes do not have */
        room = mesh_reserve(text, &capacity, used + 65536 + 1, 1);
        got = room ? fread(*text + used, 1, 65536, file) : 0;
        used += got;
    } while (got);
    const char *trouble = ferror(file) ? strerror(errno) : !room ? "out of memory" : used == 0 ? "is empty; export it again" : NULL;
    (void)fclose(file);
    if (trouble) {
        free(*text);
        *text = NULL;
        return sim_fail(error, "%s: %s", path, trouble);
    }
    (*text)[used] = 0;
    *size_bytes = used;
    return 0;
}

/* ---- lines --------------------------------------------------------------------------------------------------- */

typedef struct lines {
    char *at, *end;
    size_t number;   /* of the line that was read last, from 1 */
    size_t joined;   /* lines that continue it */
    bool terminated; /* it ended with a newline, not with the file */
} lines_t;

/* The next line, NUL in place of its newline, or NULL. joins: a backslash at its end joins the next to it. */
static char *next_line(lines_t *lines, bool joins) {
    if (lines->at >= lines->end) { return NULL; }
    char *line = lines->at, *p = line;
    lines->number += 1 + lines->joined;
    lines->joined = 0;
    for (; p < lines->end && *p != '\n' && *p != '\r'; p++) {
        if (joins && *p == '\\' && (p[1] == '\n' || (p[1] == '\r' && p[2] == '\n'))) {
            *p++ = ' ';
            if (*p == '\r') { *p++ = ' '; }
            *p = ' ';
            lines->joined++;
        }
    }
    lines->terminated = p < lines->end;
    lines->at = p + 1;
    if (p < lines->end && *p == '\r' && p[1] == '\n') { lines->at++; }
    *p = 0;
    return line;
}

static char *skip_blanks(char *p) { return p + strspn(p, " \t\v\f"); }

/* Reads up to three numbers; how many were there. */
static int read_point(char *p, double point[3]) {
    for (int k = 0; k < 3; k++) {
        char *after;
        point[k] = strtod(p, &after);
        if (after == p) { return k; }
        p = after;
    }
    return 3;
}

static bool fits(const double point[3]) {
    for (int k = 0; k < 3; k++) {
        if (!(fabs(point[k]) <= (double)FLT_MAX)) { return false; }
    }
    return true;
}

#define NOT_FINITE "(%g, %g, %g) is not finite; repair or remove it"

static int check_point(const char *path, const lines_t *lines, char *text, size_t vertex, sim_error_t *error) {
    double point[3] = {0};
    int found = read_point(text, point);
    if (found < 3) {
        return sim_fail(error, "%s:%zu: vertex %zu has %d of 3 coordinates: the file is %s; export it again", path, lines->number,
                        vertex, found, lines->terminated ? "damaged" : "cut short");
    }
    if (!fits(point)) {
        return sim_fail(error, "%s:%zu: vertex %zu " NOT_FINITE, path, lines->number, vertex, point[0], point[1], point[2]);
    }
    return 0;
}

/* ---- OBJ ----------------------------------------------------------------------------------------------------- */

typedef struct obj_counts {
    long long vertices, textures, normals;
} obj_counts_t;

static bool is_keyword(const char *line, const char *word) {
    size_t length = strlen(word);
    return !strncmp(line, word, length) && (line[length] == ' ' || line[length] == '\t' || line[length] == 0);
}

/* One index of a corner, 1-based, negative ones counted back from the latest. */
static int check_obj_index(const char *path, const lines_t *lines, const char *what, long long index, long long so_far,
                           long long in_all, sim_error_t *error) {
    if (index == 0 || index > in_all || index < -so_far) {
        return sim_fail(error, "%s:%zu: the face asks for %s %lld, but there are %lld; repair the line or export the file again",
                        path, lines->number, what, index, index < 0 ? so_far : in_all);
    }
    return 0;
}

static int check_obj_face(const char *path, const lines_t *lines, char *p, const obj_counts_t *so_far, const obj_counts_t *in_all,
                          sim_error_t *error) {
    const struct {
        const char *name;
        long long so_far, in_all;
        bool used;
    } kinds[3] = {{"vertex", so_far->vertices, in_all->vertices, true},
                  {"texture vertex", so_far->textures, in_all->textures, false}, /* textures are not looked at */
                  {"normal", so_far->normals, in_all->normals, true}};
    int corners = 0;
    for (p = skip_blanks(p); *p && *p != '#'; p = skip_blanks(p)) {
        for (int kind = 0; kind < 3; kind++) {
            char *after;
            long long index = strtoll(p, &after, 10);
            if (after != p) {
                if (kinds[kind].used &&
                    check_obj_index(path, lines, kinds[kind].name, index, kinds[kind].so_far, kinds[kind].in_all, error)) {
                    return -1;
                }
            } else if (kind == 0) {
                return sim_fail(error, "%s:%zu: \"%.20s\" is no corner of a face; repair the line or export the file again", path,
                                lines->number, p);
            }
            p = after;
            if (*p != '/') { break; }
            p++;
        }
        p += strcspn(p, " \t\v\f");
        corners++;
    }
    if (corners == 0 || (corners < 3 && !lines->terminated)) {
        return sim_fail(error, "%s:%zu: a face with %d corners: the file is %s; export it again", path, lines->number, corners,
                        lines->terminated ? "damaged" : "cut short");
    }
    return 0;
}

/* Assimp takes 0 for what is not finite. */
static int check_obj_texcoord(const char *path, const lines_t *lines, char *text, long long number, sim_error_t *error) {
    double at[3] = {0};
    (void)read_point(text, at);
    if (fits(at)) { return 0; }
    return sim_fail(error,
                    "%s:%zu: texture vertex %lld (%g, %g) is not finite; repair it, or draw without textures (--no-textures)", path,
                    lines->number, number, at[0], at[1]);
}

static int check_obj(const char *path, char *text, size_t size_bytes, bool textures, sim_error_t *error) {
    obj_counts_t in_all = {0}, so_far = {0};
    for (size_t i = 0; i < size_bytes; i++) { /* counted first, since a face may come before its vertices */
        if (i == 0 || text[i - 1] == '\n' || text[i - 1] == '\r') {
            const char *line = skip_blanks(text + i);
            in_all.vertices += is_keyword(line, "v");
            in_all.textures += is_keyword(line, "vt");
            in_all.normals += is_keyword(line, "vn");
        }
    }
    lines_t lines = {.at = text, .end = text + size_bytes};
    for (char *line; (line = next_line(&lines, true));) {
        line = skip_blanks(line);
        if (is_keyword(line, "vt")) {
            so_far.textures++;
            if (textures && check_obj_texcoord(path, &lines, line + 2, so_far.textures, error)) { return -1; }
        }
        so_far.normals += is_keyword(line, "vn");
        if (is_keyword(line, "v")) {
            so_far.vertices++;
            if (check_point(path, &lines, line + 1, (size_t)so_far.vertices, error)) { return -1; }
        } else if (is_keyword(line, "f") && check_obj_face(path, &lines, line + 1, &so_far, &in_all, error)) {
            return -1;
        }
    }
    return 0;
}

/* ---- OFF ----------------------------------------------------------------------------------------------------- */

static char *next_off_line(lines_t *lines) {
    for (char *line; (line = next_line(lines, false));) {
        line = skip_blanks(line);
        line[strcspn(line, "#")] = 0;
        if (*line) { return line; }
    }
    return NULL;
}

static int check_off(const char *path, char *text, size_t size_bytes, sim_error_t *error) {
    lines_t lines = {.at = text, .end = text + size_bytes};
    char *line = next_off_line(&lines);
    if (!line || strchr("0123456789", *line) || memchr(line, '4', strcspn(line, " \t")) ||
        memchr(line, 'n', strcspn(line, " \t"))) {
        return 0; /* without its keyword, or in more dimensions: Assimp's to judge */
    }
    line = skip_blanks(line + strcspn(line, " \t"));
    if (!*line) { line = next_off_line(&lines); }
    char *after = line;
    long long counts[2] = {-1, -1};
    for (int i = 0; line && i < 2; i++) {
        long long count = strtoll(line, &after, 10);
        counts[i] = after == line ? -1 : count;
        line = after;
    }
    if (counts[0] < 0 || counts[1] < 0) {
        return sim_fail(error, "%s:%zu: the numbers of vertices and faces are missing; export it again", path, lines.number);
    }
    for (long long i = 0; i < counts[0] + counts[1]; i++) {
        line = next_off_line(&lines);
        if (!line) {
            return sim_fail(
                error, "%s: cut short: the header promises %lld vertices and %lld faces, %lld lines are there; export it again",
                path, counts[0], counts[1], i);
        }
        if (i < counts[0]) {
            if (check_point(path, &lines, line, (size_t)i, error)) { return -1; }
            continue;
        }
        long long corners = strtoll(line, &after, 10);
        for (long long c = 0; c < corners; c++) {
            line = after;
            long long index = strtoll(line, &after, 10);
            if (after == line || index < 0 || index >= counts[0]) {
                return sim_fail(error,
                                "%s:%zu: face %lld has a corner that is missing or not one of the %lld vertices; export it again",
                                path, lines.number, i - counts[0], counts[0]);
            }
        }
    }
    return 0;
}

int mesh_check_text(const char *path, char *text, size_t size_bytes, bool textures, sim_error_t *error) {
    const char *dot = strrchr(path, '.');
    if (!dot || size_bytes < 2 || !memcmp(text, "\xff\xfe", 2) || !memcmp(text, "\xfe\xff", 2)) {
        return 0; /* UTF-16, which Assimp converts */
    }
    if (!strncmp(text, "ply\n", 4) || !strncmp(text, "ply\r", 4)) { return mesh_check_ply(path, text, size_bytes, error); }
    if (!strcasecmp(dot, ".obj")) { return check_obj(path, text, size_bytes, textures, error); }
    return strcasecmp(dot, ".off") ? 0 : check_off(path, text, size_bytes, error);
}
