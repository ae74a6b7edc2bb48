/* Reads over a PLY file, text or binary, before Assimp does: see check.c for why. */
#include "stages.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PLY_TEXT, PLY_LITTLE, PLY_BIG };
#define PLY_PROPERTIES 128 /* of all elements; more is no file that was meant for a mesh */
#define PLY_ELEMENTS 16

typedef struct ply_property {
    char role;             /* 'x', 'y', 'z': of a vertex; 'i': the indices of a face; 0: not looked at */
    char type, count_type; /* as in type_of; count_type 0 = no list */
} ply_property_t;

typedef struct ply_element {
    char name[32];
    unsigned long long count;
    size_t first, properties;
} ply_element_t;

typedef struct ply {
    const char *path;
    char *at, *end;
    int format;
    ply_element_t elements[PLY_ELEMENTS];
    size_t element_count;
    ply_property_t properties[PLY_PROPERTIES];
    size_t property_count;
    unsigned long long vertices;
} ply_t;

/* b, h, w: signed integers of 1, 2, 4 bytes; B, H, W: unsigned; f, d: floating point; 0: no type. */
static char type_of(const char *name) {
    static const struct {
        const char *name;
        char type;
    } types[] = {{"char", 'b'},   {"int8", 'b'},    {"uchar", 'B'},  {"uint8", 'B'},  {"short", 'h'}, {"int16", 'h'},
                 {"ushort", 'H'}, {"uint16", 'H'},  {"int", 'w'},    {"int32", 'w'},  {"uint", 'W'},  {"uint32", 'W'},
                 {"float", 'f'},  {"float32", 'f'}, {"double", 'd'}, {"float64", 'd'}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (!strcmp(types[i].name, name)) { return types[i].type; }
    }
    return 0;
}

static size_t size_of(char type) { return type == 'd' ? 8 : strchr("wWf", type) ? 4 : strchr("hH", type) ? 2 : 1; }

/* One number; false at the end of the file or where there is none. */
static bool read_number(ply_t *ply, char type, double *value) {
    if (ply->format == PLY_TEXT) {
        char *after;
        *value = strtod(ply->at, &after);
        bool found = after != ply->at;
        ply->at = after;
        return found;
    }
    size_t size = size_of(type);
    if ((size_t)(ply->end - ply->at) < size) { return false; }
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++) {
        size_t from = ply->format == PLY_LITTLE ? i : size - 1 - i;
        bits |= (uint64_t)(uint8_t)ply->at[from] << 8 * i;
    }
    ply->at += size;
    uint32_t low = (uint32_t)bits;
    float single;
    switch (type) {
    case 'b': *value = (int8_t)bits; break;
    case 'h': *value = (int16_t)bits; break;
    case 'w': *value = (int32_t)bits; break;
    case 'f':
        memcpy(&single, &low, sizeof single);
        *value = (double)single;
        break;
    case 'd': memcpy(value, &bits, sizeof *value); break;
    default: *value = low; break;
    }
    return true;
}

static int read_property(ply_t *ply, const char *words, sim_error_t *error) {
    char type[16], count[16], name[32];
    ply_property_t property = {0};
    if (ply->property_count == PLY_PROPERTIES || ply->element_count == 0) {
        return sim_fail(error, "%s: its header has too many properties, or one before any element; export it again", ply->path);
    }
    if (sscanf(words, "list %15s %15s %31s", count, type, name) == 3) {
        property.count_type = type_of(count);
    } else if (sscanf(words, "%15s %31s", type, name) != 2) {
        type[0] = 0;
    }
    property.type = type_of(type);
    if (!property.type || (!property.count_type && !strncmp(words, "list", 4))) {
        return sim_fail(error, "%s: its header has a property \"%.40s\" of no known type; export it again", ply->path, words);
    }
    ply_element_t *element = &ply->elements[ply->element_count - 1];
    if (!strcmp(element->name, "vertex") && !property.count_type && name[0] >= 'x' && name[0] <= 'z' && !name[1]) {
        property.role = name[0];
    }
    if (!strcmp(element->name, "face") && property.count_type &&
        (!strcmp(name, "vertex_indices") || !strcmp(name, "vertex_index"))) {
        property.role = 'i';
    }
    ply->properties[ply->property_count++] = property;
    element->properties++;
    return 0;
}

static int read_header(ply_t *ply, sim_error_t *error) {
    bool done = false;
    while (!done && ply->at < ply->end) {
        char *line = ply->at;
        size_t length = strcspn(line, "\r\n");
        char *after = line + length;
        if (*after == '\r' && after[1] == '\n') { *after++ = 0; }
        done = !strncmp(line, "end_header", 10);
        ply->at = after < ply->end ? after + 1 : ply->end;
        *after = 0;
        if (!strncmp(line, "format binary_", 14)) {
            ply->format = strstr(line, "big") ? PLY_BIG : PLY_LITTLE;
        } else if (!strncmp(line, "element ", 8)) {
            if (ply->element_count == PLY_ELEMENTS) {
                return sim_fail(error, "%s: its header has more than %d elements; export it again", ply->path, PLY_ELEMENTS);
            }
            ply_element_t *element = &ply->elements[ply->element_count++];
            element->first = ply->property_count;
            if (sscanf(line, "element %31s %llu", element->name, &element->count) != 2) {
                return sim_fail(error, "%s: its header has an element without a name or a count; export it again", ply->path);
            }
            if (!strcmp(element->name, "vertex")) { ply->vertices = element->count; }
        } else if (!strncmp(line, "property ", 9) && read_property(ply, line + 9, error)) {
            return -1;
        }
    }
    return done ? 0 : sim_fail(error, "%s: cut short in its header; export it again", ply->path);
}

static int cut_short(const ply_t *ply, const ply_element_t *element, unsigned long long item, sim_error_t *error) {
    return sim_fail(error, "%s: cut short or damaged in %s %llu of %llu; export it again", ply->path, element->name, item,
                    element->count);
}

static int check_list(ply_t *ply, const ply_element_t *element, const ply_property_t *property, unsigned long long item,
                      sim_error_t *error) {
    double count = 0, index;
    if (!read_number(ply, property->count_type, &count) || !(count >= 0)) { return cut_short(ply, element, item, error); }
    for (uint64_t left = count < 1e15 ? (uint64_t)count : UINT64_MAX; left; left--) { /* the end of the file comes first */
        if (!read_number(ply, property->type, &index)) { return cut_short(ply, element, item, error); }
        if (property->role == 'i' && !(index >= 0 && index < (double)ply->vertices)) {
            return sim_fail(error, "%s: face %llu asks for vertex %.0f, but there are %llu (from 0); repair it or export it again",
                            ply->path, item, index, ply->vertices);
        }
    }
    return 0;
}

static int check_element(ply_t *ply, const ply_element_t *element, sim_error_t *error) {
    for (unsigned long long item = 0; element->properties && item < element->count; item++) {
        for (size_t p = element->first; p < element->first + element->properties; p++) {
            const ply_property_t *property = &ply->properties[p];
            double value;
            if (property->count_type) {
                if (check_list(ply, element, property, item, error)) { return -1; }
            } else if (!read_number(ply, property->type, &value)) {
                return cut_short(ply, element, item, error);
            } else if (property->role && !(fabs(value) <= (double)FLT_MAX)) {
                return sim_fail(error, "%s: coordinate %c of vertex %llu (from 0) is not finite; repair or remove it", ply->path,
                                property->role, item);
            }
        }
    }
    return 0;
}

int mesh_check_ply(const char *path, char *text, size_t size_bytes, sim_error_t *error) {
    ply_t *ply = mesh_array(1, sizeof *ply);
    if (!ply) { return sim_fail(error, "%s: out of memory", path); }
    ply->path = path;
    ply->at = text;
    ply->end = text + size_bytes;
    int status = read_header(ply, error);
    for (size_t e = 0; !status && e < ply->element_count; e++) {
        status = check_element(ply, &ply->elements[e], error);
    }
    free(ply);
    return status;
}
