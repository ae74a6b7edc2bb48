/* Whether what varies over a polygon may be told by a plane. */
#include "stages.h"

#include <math.h>

#define TEXEL_TOLERANCE (1.0 / 64)
#define COLOUR_TOLERANCE 0.5 /* of 255 */

typedef struct sheet { /* a polygon laid out in two axes */
    double origin[2], a[2], b[2], area;
    uint32_t corner[3]; /* the largest triangle of its fan */
    int axis[2];
} sheet_t;

static void point_of(const mesh_t *mesh, const sheet_t *sheet, uint32_t corner, double point[2]) {
    for (int k = 0; k < 2; k++) {
        point[k] = mesh->positions[mesh->corners[corner]][sheet->axis[k]];
    }
}

/* False when no triangle of the fan has an area. */
static bool lay_out(const mesh_t *mesh, const mesh_face_t *face, sheet_t *sheet) {
    double normal[3], origin[2], most = 0;
    mesh_face_normal(mesh, face, normal);
    int drop = 0;
    for (int k = 1; k < 3; k++) {
        drop = fabs(normal[k]) > fabs(normal[drop]) ? k : drop;
    }
    sheet->axis[0] = (drop + 1) % 3;
    sheet->axis[1] = (drop + 2) % 3;
    point_of(mesh, sheet, face->first, origin);
    for (uint32_t i = 1; i + 1 < face->count; i++) {
        double p[2], q[2];
        point_of(mesh, sheet, face->first + i, p);
        point_of(mesh, sheet, face->first + i + 1, q);
        const double area = (p[0] - origin[0]) * (q[1] - origin[1]) - (p[1] - origin[1]) * (q[0] - origin[0]);
        if (fabs(area) > fabs(most)) {
            most = area;
            *sheet = (sheet_t){.origin = {origin[0], origin[1]},
                               .a = {p[0] - origin[0], p[1] - origin[1]},
                               .b = {q[0] - origin[0], q[1] - origin[1]},
                               .area = area,
                               .corner = {face->first, face->first + i, face->first + i + 1},
                               .axis = {sheet->axis[0], sheet->axis[1]}};
        }
    }
    return fabs(most) > 0;
}

static double value_of(const mesh_t *mesh, uint32_t corner, int channel) {
    return channel < 2 ? mesh->texcoords[corner][channel] : mesh->colours[corner][channel - 2];
}

/* All corners, by the plane through three of them. */
static bool affine(const mesh_t *mesh, const mesh_face_t *face, const sheet_t *sheet, int channel, double tolerance) {
    const double base = value_of(mesh, sheet->corner[0], channel);
    const double to_a = value_of(mesh, sheet->corner[1], channel) - base, to_b = value_of(mesh, sheet->corner[2], channel) - base;
    for (uint32_t i = 0; i < face->count; i++) {
        double p[2];
        point_of(mesh, sheet, face->first + i, p);
        const double x = p[0] - sheet->origin[0], y = p[1] - sheet->origin[1];
        const double along_a = (x * sheet->b[1] - y * sheet->b[0]) / sheet->area;
        const double along_b = (sheet->a[0] * y - sheet->a[1] * x) / sheet->area;
        if (!(fabs(base + along_a * to_a + along_b * to_b - value_of(mesh, face->first + i, channel)) <= tolerance)) {
            return false;
        }
    }
    return true;
}

bool mesh_face_affine(const mesh_t *mesh, const mesh_face_t *face) {
    const bool textured = mesh->texcoords && mesh->surfaces && mesh->surfaces[face->material].texture != TUILE_NO_TEXTURE;
    sheet_t sheet = {.area = 0};
    if (face->count == 3 || (!textured && !mesh->colours)) { return true; }
    if (!lay_out(mesh, face, &sheet)) { return false; }
    for (int channel = textured ? 0 : 2; channel < (mesh->colours ? 6 : 2); channel++) {
        if (!affine(mesh, face, &sheet, channel, channel < 2 ? TEXEL_TOLERANCE : COLOUR_TOLERANCE)) { return false; }
    }
    return true;
}
