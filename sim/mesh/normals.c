/* Normals for corners that have none.
 *
 * A corner takes the mean of the faces around its vertex, each weighted by its angle there (so that the way in which a flat
 * region is cut into triangles does not tilt the normal), but only of those faces that differ from its own by less than the
 * crease angle: a cube stays a cube and a ball becomes round.
 */
#include "stages.h"

#include <math.h>
#include <meshoptimizer.h>
#include <string.h>

#define CREASE_COSINE (0.5 + 1e-6) /* 60 degrees; the sides of a hexagonal prism are flat */
#define HUB_FACES 256u             /* comparing all pairs of faces around a vertex is quadratic */

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static bool normalise(double v[3]) {
    double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    if (!(largest > 0) || !isfinite(largest)) { return false; }
    for (int k = 0; k < 3; k++) { /* first by the largest: squares of tiny lengths would underflow */
        v[k] /= largest;
    }
    double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
    return true;
}

void mesh_face_normal(const mesh_t *mesh, const mesh_face_t *face, double normal[3]) {
    const uint32_t *corners = mesh->corners + face->first;
    const double *origin = mesh->positions[corners[0]];
    normal[0] = normal[1] = normal[2] = 0;
    for (uint32_t i = 1; i + 1 < face->count; i++) {
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = mesh->positions[corners[i]][k] - origin[k];
            b[k] = mesh->positions[corners[i + 1]][k] - origin[k];
        }
        normal[0] += a[1] * b[2] - a[2] * b[1];
        normal[1] += a[2] * b[0] - a[0] * b[2];
        normal[2] += a[0] * b[1] - a[1] * b[0];
    }
}

static double corner_angle(const mesh_t *mesh, const mesh_face_t *face, uint32_t i) {
    const uint32_t *corners = mesh->corners + face->first;
    const double *at = mesh->positions[corners[i]];
    const double *before = mesh->positions[corners[(i + face->count - 1) % face->count]];
    const double *after = mesh->positions[corners[(i + 1) % face->count]];
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = before[k] - at[k];
        b[k] = after[k] - at[k];
    }
    if (!normalise(a) || !normalise(b)) { return 0; }
    return acos(fmax(-1.0, fmin(1.0, dot(a, b))));
}

typedef struct wheel {  /* the faces around each position */
    double (*units)[3]; /* of each face; zero for one without area */
    double *angles;     /* of each corner */
    uint32_t *face_of;  /* of each corner */
    uint32_t *first;    /* position_count + 1 entries, in spokes */
    uint32_t *spokes;   /* corners */
} wheel_t;

static void wheel_free(wheel_t *wheel) {
    free(wheel->units);
    free(wheel->angles);
    free(wheel->face_of);
    free(wheel->first);
    free(wheel->spokes);
}

static bool wheel_make(wheel_t *wheel, const mesh_t *mesh) {
    wheel->units = mesh_array(mesh->face_count, sizeof *wheel->units);
    wheel->angles = mesh_array(mesh->corner_count, sizeof *wheel->angles);
    wheel->face_of = mesh_array(mesh->corner_count, sizeof *wheel->face_of);
    wheel->first = mesh_array(mesh->position_count + 2, sizeof *wheel->first);
    wheel->spokes = mesh_array(mesh->corner_count, sizeof *wheel->spokes);
    if (!wheel->units || !wheel->angles || !wheel->face_of || !wheel->first || !wheel->spokes) { return false; }
    for (size_t f = 0; f < mesh->face_count; f++) {
        const mesh_face_t *face = &mesh->faces[f];
        mesh_face_normal(mesh, face, wheel->units[f]);
        if (!normalise(wheel->units[f])) { memset(wheel->units[f], 0, sizeof wheel->units[f]); }
        for (uint32_t i = 0; i < face->count; i++) {
            wheel->angles[face->first + i] = corner_angle(mesh, face, i);
            wheel->face_of[face->first + i] = (uint32_t)f;
            wheel->first[mesh->corners[face->first + i] + 2]++;
        }
    }
    for (size_t p = 0; p < mesh->position_count; p++) {
        wheel->first[p + 2] += wheel->first[p + 1];
    }
    for (size_t f = 0; f < mesh->face_count; f++) {
        const mesh_face_t *face = &mesh->faces[f];
        for (uint32_t i = 0; i < face->count; i++) {
            wheel->spokes[wheel->first[mesh->corners[face->first + i] + 1]++] = face->first + i;
        }
    }
    return true;
}

static void smooth(const mesh_t *mesh, const wheel_t *wheel, uint32_t corner, double normal[3]) {
    const double *own = wheel->units[wheel->face_of[corner]];
    uint32_t position = mesh->corners[corner];
    uint32_t begin = wheel->first[position], end = wheel->first[position + 1];
    bool hub = end - begin > HUB_FACES;
    normal[0] = normal[1] = normal[2] = 0;
    for (uint32_t s = begin; s < end; s++) {
        const double *unit = wheel->units[wheel->face_of[wheel->spokes[s]]];
        if (hub || dot(unit, own) > CREASE_COSINE) {
            for (int k = 0; k < 3; k++) {
                normal[k] += unit[k] * wheel->angles[wheel->spokes[s]];
            }
        }
    }
    if (!normalise(normal) || (hub && dot(normal, own) <= CREASE_COSINE)) {
        memcpy(normal, own, 3 * sizeof *normal);
        if (!normalise(normal)) { /* a face without area, which will be left out */
            normal[0] = normal[1] = 0;
            normal[2] = 1;
        }
    }
}

int mesh_make_normals(mesh_t *mesh, bool flat, sim_error_t *error) {
    wheel_t wheel = {0};
    uint32_t *remap = mesh_array(mesh->corner_count, sizeof *remap);
    double(*normals)[3] = mesh_array(mesh->corner_count, sizeof *normals);
    uint32_t *corner_normals = mesh_array(mesh->corner_count, sizeof *corner_normals);
    if (!remap || !normals || !corner_normals || !wheel_make(&wheel, mesh)) {
        wheel_free(&wheel);
        free(remap);
        free(normals);
        free(corner_normals);
        return sim_fail(error, "out of memory for the normals of %zu corners", mesh->corner_count);
    }
    for (size_t c = 0; c < mesh->corner_count; c++) {
        if (mesh->corner_normals && mesh->corner_normals[c] != MESH_NO_NORMAL) {
            memcpy(normals[c], mesh->normals[mesh->corner_normals[c]], sizeof normals[c]);
        } else if (flat) {
            memcpy(normals[c], wheel.units[wheel.face_of[c]], sizeof normals[c]);
        } else {
            smooth(mesh, &wheel, (uint32_t)c, normals[c]);
        }
        for (int k = 0; k < 3; k++) {
            normals[c][k] += 0.0; /* -0 and 0 are one normal */
        }
    }
    mesh->normal_count = meshopt_generateVertexRemap(remap, NULL, mesh->corner_count, normals, mesh->corner_count, sizeof *normals);
    for (size_t c = 0; c < mesh->corner_count; c++) { /* in place: a normal never moves up */
        corner_normals[c] = remap[c];
        memmove(normals[remap[c]], normals[c], sizeof normals[c]);
    }
    free(mesh->normals);
    free(mesh->corner_normals);
    mesh->normals = normals;
    mesh->corner_normals = corner_normals;
    wheel_free(&wheel);
    free(remap);
    return 0;
}
