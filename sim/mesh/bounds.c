/* Spheres and cones that let a cluster be dropped whole.
 *
 * WHEN A CLUSTER FACES AWAY. Let c, r be its sphere, d = c - e for an eye e, and let every normal n of its faces make at most the
 * angle alpha < 90 degrees with the axis a. A face lies in the sphere, and is turned away from e when dot(p - e, n) >= 0 for
 * each of its points p (for the flat face that n belongs to, one point is enough). As |p - c| <= r,
 *
 *     dot(p - e, n) = dot(d, n) + dot(p - c, n) >= |d| cos(theta + alpha) - r,      theta = angle(d, a),
 *
 * so |d| cos(theta + alpha) >= r does. The test at run time is the cheaper  |d| cos(theta) >= |d| sin(alpha) + r.  It implies the
 * other: it can only hold where cos(theta) >= sin(alpha), that is theta <= 90 - alpha, and there
 *
 *     f(theta) = cos(theta + alpha) - cos(theta) + sin(alpha)
 *
 * falls (f' = sin(theta) - sin(theta + alpha) <= 0) down to f(90 - alpha) = 0, so cos(theta + alpha) >= cos(theta) - sin(alpha)
 * >= r / |d|. An orthographic camera is the same with the direction of view for d and r = 0. The model stores sin(alpha), rounded
 * up to 1/254; for alpha >= 90 degrees nothing can be said.
 *
 * POLYGONS. Whether a polygon is turned away is the sign of its area in the window, which is the sum of those of any triangles
 * that it is cut into. If it is exactly planar they all share its normal; if it is only nearly so, their normals are
 * taken into the cone as well, as for each of them the argument holds by itself. Not so those of pieces that the display tree's
 * compiler has cut: they are flat before they are rounded, and slivers among them may point anywhere afterwards.
 */
#include "stages.h"

#include <math.h>

/* ---- spheres ------------------------------------------------------------------------------------------------ */

/* Badoiu and Clarkson: walk towards the furthest point by ever smaller parts; the radius ends near the least one. */
#define WALK_STEPS 128

/* Point i of those that a sphere has to hold: positions of the first key frame, then, if there is one, of the second. */
static const int16_t *point_of(const solid_t *solid, const uint32_t *vertices, size_t count, size_t i) {
    return i < count ? solid->vertices[vertices[i]].position : solid->vertices[vertices[i - count]].morph;
}

static uint32_t radius_around(const solid_t *solid, const uint32_t *vertices, size_t count, const int16_t centre[3]) {
    int64_t most = 0; /* 3 * (2^16)^2 < 2^34 */
    for (size_t i = 0; i < (solid->morphs ? 2 * count : count); i++) {
        int64_t squares = 0;
        for (int k = 0; k < 3; k++) {
            int64_t off = point_of(solid, vertices, count, i)[k] - centre[k];
            squares += off * off;
        }
        most = squares > most ? squares : most;
    }
    int64_t radius = (int64_t)sqrt((double)most);
    while (radius * radius < most) {
        radius++;
    }
    while (radius > 0 && (radius - 1) * (radius - 1) >= most) {
        radius--;
    }
    return (uint32_t)radius;
}

bounds_sphere_t bounds_of_vertices(const solid_t *solid, const uint32_t *vertices, size_t count) {
    const size_t points = solid->morphs ? 2 * count : count;
    double centre[3], low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = high[k] = solid->vertices[vertices[0]].position[k];
        for (size_t i = 1; i < points; i++) {
            low[k] = fmin(low[k], point_of(solid, vertices, count, i)[k]);
            high[k] = fmax(high[k], point_of(solid, vertices, count, i)[k]);
        }
        centre[k] = (low[k] + high[k]) / 2;
    }
    bounds_sphere_t sphere = {{0}, 0};
    uint32_t least = UINT32_MAX;
    for (int step = 0; step < WALK_STEPS; step++) {
        int16_t rounded[3];
        for (int k = 0; k < 3; k++) {
            rounded[k] = (int16_t)lround(centre[k]);
        }
        uint32_t radius = radius_around(solid, vertices, count, rounded);
        if (radius < least) {
            least = radius;
            sphere = (bounds_sphere_t){{rounded[0], rounded[1], rounded[2]}, (uint16_t)radius};
        }
        double furthest = -1;
        const int16_t *to = solid->vertices[vertices[0]].position;
        for (size_t i = 0; i < points; i++) {
            const int16_t *point = point_of(solid, vertices, count, i);
            double squares = 0;
            for (int k = 0; k < 3; k++) {
                double off = point[k] - centre[k];
                squares += off * off;
            }
            if (squares > furthest) {
                furthest = squares;
                to = point;
            }
        }
        for (int k = 0; k < 3; k++) {
            centre[k] += (to[k] - centre[k]) / (step + 2);
        }
    }
    if (solid->morphs) { sphere.radius++; } /* between the key frames places are rounded */
    for (size_t i = 0; i < count; i++) {    /* a fraction reaches less than one step further */
        const int8_t *f = solid->vertices[vertices[i]].fraction;
        if (f[0] | f[1] | f[2]) {
            sphere.radius++;
            break;
        }
    }
    return sphere;
}

/* ---- cones -------------------------------------------------------------------------------------------------- */

typedef struct normals {
    int64_t (*exact)[3];
    size_t count, capacity;
} normals_t;

static bool add_triangle(normals_t *normals, const solid_t *solid, const uint32_t *corners, uint32_t a, uint32_t b, uint32_t c) {
    const int16_t *p = solid->vertices[corners[a]].position, *q = solid->vertices[corners[b]].position;
    const int16_t *r = solid->vertices[corners[c]].position;
    if (!mesh_reserve(&normals->exact, &normals->capacity, normals->count + 1, sizeof *normals->exact)) { return false; }
    int64_t *normal = normals->exact[normals->count];
    for (int k = 0; k < 3; k++) {
        int y = (k + 1) % 3, z = (k + 2) % 3;
        normal[k] = (int64_t)(q[y] - p[y]) * (r[z] - p[z]) - (int64_t)(q[z] - p[z]) * (r[y] - p[y]);
    }
    normals->count += normal[0] || normal[1] || normal[2];
    return true;
}

static bool exactly_planar(const solid_t *solid, const solid_face_t *face) {
    const uint32_t *corners = solid->corners + face->first;
    for (uint32_t i = 1; i < face->count; i++) {
        mesh_int128_t off = 0;
        for (int k = 0; k < 3; k++) {
            off += (mesh_int128_t)face->normal[k] *
                   (solid->vertices[corners[i]].position[k] - solid->vertices[corners[0]].position[k]);
        }
        if (off != 0) { return false; }
    }
    return true;
}

/* A convex polygon may be drawn as the fan from its first corner, so it is that fan which counts. */
static bool add_face(normals_t *normals, const solid_t *solid, const solid_face_t *face) {
    const uint32_t *corners = solid->corners + face->first;
    if (!mesh_reserve(&normals->exact, &normals->capacity, normals->count + 1, sizeof *normals->exact)) { return false; }
    for (int k = 0; k < 3; k++) {
        normals->exact[normals->count][k] = face->normal[k];
    }
    normals->count++;
    if (face->count == 3 || face->piece || exactly_planar(solid, face)) { return true; }
    if (face->convex) {
        bool done = true;
        for (uint32_t i = 1; done && i + 1 < face->count; i++) {
            done = add_triangle(normals, solid, corners, 0, i, i + 1);
        }
        return done;
    }
    int32_t points[MESH_CORNERS_MAX][3];
    uint32_t triangles[MESH_CORNERS_MAX][3];
    for (uint32_t i = 0; i < face->count; i++) {
        for (int k = 0; k < 3; k++) {
            points[i][k] = solid->vertices[corners[i]].position[k];
        }
    }
    long count = mesh_triangulate((const int32_t(*)[3])points, face->count, triangles);
    bool done = count >= 0;
    for (long t = 0; done && t < count; t++) {
        done = add_triangle(normals, solid, corners, triangles[t][0], triangles[t][1], triangles[t][2]);
    }
    return done;
}

static double length(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* Cosine and sine between an exact normal and the axis; the sine by the cross product, so that parallel ones give 0. */
static void angle(const int64_t normal[3], const double axis[3], double *cosine, double *sine) {
    const double n[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
    const double cross[3] = {n[1] * axis[2] - n[2] * axis[1], n[2] * axis[0] - n[0] * axis[2], n[0] * axis[1] - n[1] * axis[0]};
    double lengths = length(n) * length(axis);
    *cosine = (n[0] * axis[0] + n[1] * axis[1] + n[2] * axis[2]) / lengths;
    *sine = length(cross) / lengths;
}

/* The axis whose furthest normal is nearest, by the same walk as the sphere's centre. */
static void widest_axis(const normals_t *normals, double axis[3]) {
    axis[0] = axis[1] = axis[2] = 0;
    if (normals->count == 0) { return; }
    for (size_t i = 0; i < normals->count; i++) {
        const double n[3] = {(double)normals->exact[i][0], (double)normals->exact[i][1], (double)normals->exact[i][2]};
        for (int k = 0; k < 3; k++) {
            axis[k] += n[k] / length(n);
        }
    }
    double at[3], best = -2;
    for (int k = 0; k < 3; k++) {
        at[k] = axis[k] / (double)normals->count;
    }
    for (int step = 0; step < WALK_STEPS && length(at) > 1e-6; step++) {
        double least = 2;
        size_t furthest = 0;
        for (size_t i = 0; i < normals->count; i++) {
            double cosine, sine;
            angle(normals->exact[i], at, &cosine, &sine);
            if (cosine < least) {
                least = cosine;
                furthest = i;
            }
        }
        if (least > best) {
            best = least;
            for (int k = 0; k < 3; k++) {
                axis[k] = at[k] / length(at);
            }
        }
        const int64_t *to = normals->exact[furthest];
        const double n[3] = {(double)to[0], (double)to[1], (double)to[2]};
        for (int k = 0; k < 3; k++) {
            at[k] += (n[k] / length(n) - at[k]) / (step + 2);
        }
    }
}

/* Do all vertices of the faces go the same way to the second key frame? Only then do normals stay what they are in between: they
 * are quadratic on the way, and lie in no cone around those of its two ends. A triangle in one plane may even turn over and back.
 */
static bool moves_as_one(const solid_t *solid, const uint32_t *faces, size_t count) {
    const solid_vertex_t *first = &solid->vertices[solid->corners[solid->faces[faces[0]].first]];
    for (size_t f = 0; solid->morphs && f < count; f++) {
        const solid_face_t *face = &solid->faces[faces[f]];
        for (uint32_t i = 0; i < face->count; i++) {
            const solid_vertex_t *vertex = &solid->vertices[solid->corners[face->first + i]];
            for (int k = 0; k < 3; k++) {
                if (vertex->morph[k] - vertex->position[k] != first->morph[k] - first->position[k]) { return false; }
            }
        }
    }
    return true;
}

int bounds_of_normals(const solid_t *solid, const uint32_t *faces, size_t count, bounds_cone_t *cone) {
    normals_t normals = {0};
    double axis[3];
    *cone = (bounds_cone_t){{0, 0, 127}, 255};
    if (!moves_as_one(solid, faces, count)) { return 0; }
    for (size_t i = 0; i < count; i++) {
        if (!add_face(&normals, solid, &solid->faces[faces[i]])) {
            free(normals.exact);
            return -1;
        }
    }
    widest_axis(&normals, axis);
    double size = length(axis), widest = 0;
    if (size > 0.5) {
        for (int k = 0; k < 3; k++) {
            cone->axis[k] = (int8_t)lround(axis[k] / size * 127);
            axis[k] = cone->axis[k]; /* what follows holds for the rounded axis */
        }
        for (size_t i = 0; i < normals.count; i++) {
            double cosine, sine;
            angle(normals.exact[i], axis, &cosine, &sine);
            widest = fmax(widest, cosine > 1e-6 ? sine : 2);
        }
        double cutoff = ceil(254 * widest * (1 + 1e-9));
        cone->cutoff = (uint8_t)(cutoff <= 254 ? cutoff : 255);
    }
    free(normals.exact);
    return 0;
}
