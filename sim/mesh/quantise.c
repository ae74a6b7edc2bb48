/* The mesh on an integer grid of one step for all three axes, so that angles survive: position = step * (offset + q).
 *
 * A face counts as planar when no vertex is further from its Newell plane than one step. That is asked of the places the file
 * gives, not of the rounded ones: rounding alone can lift a corner of a flat polygon by 0.87 steps, and coordinates that are on a
 * coarse grid would make everything planar. What is decided afterwards (area, convexity) is exact, on the rounded ones.
 */
#include "stages.h"

#include <math.h>
#include <meshoptimizer.h>
#include <string.h>

#define Q_MAX 32767
#define OFFSET_MAX 2147400000.0 /* leaves room for q in an int32 */

typedef struct extent {
    double low[3], high[3], widest, farthest; /* farthest: the largest |coordinate| */
    int finest;                               /* all coordinates are multiples of 2^finest */
} extent_t;

void solid_free(solid_t *solid) {
    free(solid->vertices);
    free(solid->places);
    free(solid->corners);
    free(solid->faces);
    memset(solid, 0, sizeof *solid);
}

/* The exponent of the lowest bit set in x. */
static int lowest_bit(double x) {
    int exponent;
    int64_t mantissa = (int64_t)ldexp(frexp(fabs(x), &exponent), 53);
    for (exponent -= 53; mantissa % 2 == 0; mantissa /= 2) {
        exponent++;
    }
    return exponent;
}

static void measure_point(extent_t *extent, const double at[3]) {
    for (int k = 0; k < 3; k++) {
        extent->low[k] = fmin(extent->low[k], at[k]);
        extent->high[k] = fmax(extent->high[k], at[k]);
        if (at[k] != 0 && isfinite(at[k])) {
            int bit = lowest_bit(at[k]);
            extent->finest = bit < extent->finest ? bit : extent->finest;
        }
    }
}

static extent_t measure(const mesh_t *mesh) {
    extent_t extent = {.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}, .finest = INT32_MAX};
    for (size_t f = 0; f < mesh->face_count; f++) {
        for (uint32_t i = 0; i < mesh->faces[f].count; i++) { /* not all positions: some may belong to no face */
            const uint32_t p = mesh->corners[mesh->faces[f].first + i];
            measure_point(&extent, mesh->positions[p]);
            if (mesh->morph.positions) { measure_point(&extent, mesh->morph.positions[p]); }
        }
    }
    for (int k = 0; k < 3; k++) {
        extent.widest = fmax(extent.widest, extent.high[k] - extent.low[k]);
        extent.farthest = fmax(extent.farthest, fmax(fabs(extent.low[k]), fabs(extent.high[k])));
    }
    return extent;
}

/* The smallest scale >= value that 32 bits of mantissa can name; exact when value needs no more. */
static tuile_scale_t scale_of(double value) {
    int exponent;
    double mantissa = ceil(ldexp(frexp(value, &exponent), 32));
    if (mantissa >= 4294967296.0) {
        mantissa /= 2;
        exponent++;
    }
    return (tuile_scale_t){(uint32_t)mantissa, exponent - 32};
}

static void set_step(solid_t *solid, tuile_scale_t step) {
    solid->step = step;
    solid->step_value = ldexp(step.mantissa, step.exponent);
}

static int64_t round_to_step(double x, double step) { return (int64_t)floor(x / step + 0.5); }

static int choose_grid(solid_t *solid, const extent_t *extent, double step, sim_error_t *error) {
    if (!(extent->widest > 0) || !(extent->widest < 1e280) || !(extent->farthest < 1e280) || extent->widest < 1e-280) {
        return sim_fail(error, "the model is %g units wide; scale it to between 1e-280 and 1e280 and give it finite coordinates",
                        extent->widest);
    }
    if (step > 0) {
        set_step(solid, scale_of(step));
        if (extent->farthest / solid->step_value >= Q_MAX + 0.5) {
            return sim_fail(error, "the model reaches out to %g units, and %d steps of %g do not; take a step of %g or more",
                            extent->farthest, Q_MAX, step, extent->farthest / Q_MAX);
        }
        return 0;
    }
    if (extent->farthest <= ldexp(Q_MAX, extent->finest)) { /* exact; the finest such step, as spheres and planes gain by it */
        int exponent = extent->finest;
        while (extent->farthest <= ldexp(Q_MAX, exponent - 1)) {
            exponent--;
        }
        set_step(solid, (tuile_scale_t){1, exponent});
        return 0;
    }
    /* One step to spare for the rounding of the division; far from the origin the offset's range decides. */
    set_step(solid, scale_of(fmax(extent->widest / (2 * Q_MAX - 1), extent->farthest / OFFSET_MAX)));
    for (int k = 0; k < 3; k++) {
        int64_t low = round_to_step(extent->low[k], solid->step_value), high = round_to_step(extent->high[k], solid->step_value);
        solid->offset[k] = (int32_t)(low + (high - low) / 2);
    }
    return 0;
}

/* ---- faces -------------------------------------------------------------------------------------------------- */

typedef struct work {
    solid_t *solid;
    const mesh_t *mesh;
    const mesh_options_t *options;
    int16_t (*places)[8];  /* of each position of the mesh: in the first and, from [4] on, in the second key frame; the rest 0 */
    uint32_t *place_index; /* of each position: equal for equal places */
    int8_t (*normals)[3];  /* of each normal of the mesh */
    int8_t (*morph_normals)[3];
    uint32_t *corner;                         /* of the face at hand, without repetitions: indices into mesh->corners */
    int32_t (*points)[3], (*morph_points)[3]; /* of the face at hand */
    uint32_t (*triangles)[3];
    solid_vertex_t *vertices; /* one for each corner of the solid */
    uint32_t *vertex_places;
    size_t corner_capacity, place_capacity, face_capacity, vertex_capacity;
} work_t;

static void work_free(work_t *w) {
    free(w->places);
    free(w->place_index);
    free(w->normals);
    free(w->morph_normals);
    free(w->corner);
    free(w->points);
    free(w->morph_points);
    free(w->triangles);
    free(w->vertices);
    free(w->vertex_places);
}

static void quantise_place(work_t *w, const double from[3], int16_t to[3]) {
    solid_t *solid = w->solid;
    double squares = 0;
    for (int k = 0; k < 3; k++) {
        int64_t q = round_to_step(from[k], solid->step_value) - solid->offset[k];
        q = q > Q_MAX ? Q_MAX : q < -Q_MAX ? -Q_MAX : q; /* a step named by the caller may end half a step early */
        double off = from[k] - (double)(q + solid->offset[k]) * solid->step_value;
        to[k] = (int16_t)q;
        squares += off * off;
    }
    solid->error = fmax(solid->error, sqrt(squares));
}

static void quantise_normals(int8_t (*to)[3], const double (*from)[3], size_t count) {
    for (size_t n = 0; n < count; n++) {
        for (int k = 0; k < 3; k++) {
            to[n][k] = (int8_t)lround(fmax(-1, fmin(1, from[n][k])) * 127);
        }
    }
}

static void quantise_places(work_t *w) {
    const mesh_t *mesh = w->mesh;
    for (size_t f = 0; f < mesh->face_count; f++) {
        for (uint32_t i = 0; i < mesh->faces[f].count; i++) {
            uint32_t p = mesh->corners[mesh->faces[f].first + i];
            quantise_place(w, mesh->positions[p], w->places[p]);
            if (mesh->morph.positions) { quantise_place(w, mesh->morph.positions[p], w->places[p] + 4); }
        }
    }
    w->solid->place_count =
        meshopt_generateVertexRemap(w->place_index, NULL, mesh->position_count, w->places, mesh->position_count, sizeof *w->places);
    quantise_normals(w->normals, (const double(*)[3])mesh->normals, mesh->normal_count);
    quantise_normals(w->morph_normals, (const double(*)[3])mesh->morph.normals, mesh->morph.normal_count);
}

static bool planar(const mesh_t *mesh, const mesh_face_t *face, double tolerance) {
    double normal[3], centre[3] = {0};
    mesh_face_normal(mesh, face, normal);
    double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (uint32_t i = 0; i < face->count; i++) {
        for (int k = 0; k < 3; k++) {
            centre[k] += mesh->positions[mesh->corners[face->first + i]][k] / face->count;
        }
    }
    for (uint32_t i = 0; i < face->count; i++) {
        const double *at = mesh->positions[mesh->corners[face->first + i]];
        double off = 0;
        for (int k = 0; k < 3; k++) {
            off += normal[k] * (at[k] - centre[k]);
        }
        if (fabs(off) > tolerance * length) { return false; }
    }
    return true;
}

/* Newell's normal, exact: differences < 2^17, so a term is below 2^35, and 2^28 corners would fit. */
void solid_newell(const int32_t (*points)[3], size_t count, int64_t normal[3]) {
    normal[0] = normal[1] = normal[2] = 0;
    for (size_t i = 1; i + 1 < count; i++) {
        int64_t a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = points[i][k] - points[0][k];
            b[k] = points[i + 1][k] - points[0][k];
        }
        for (int k = 0; k < 3; k++) {
            normal[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        }
    }
}

/* The plane's normal of a polygon that crosses itself so that Newell's sum vanishes (a bow tie still covers pixels): from its first
 * three corners that are not in line. False when all are. */
static bool first_normal(const int32_t (*points)[3], size_t count, int64_t normal[3]) {
    for (size_t i = 2; i < count; i++) {
        for (size_t j = 1; j < i; j++) {
            const int32_t corner[3][3] = {{points[0][0], points[0][1], points[0][2]},
                                          {points[j][0], points[j][1], points[j][2]},
                                          {points[i][0], points[i][1], points[i][2]}};
            solid_newell(corner, 3, normal);
            if (normal[0] || normal[1] || normal[2]) { return true; }
        }
    }
    return false;
}

/* dot(cross(b - a, c - a), normal) > 0; each factor of the sum is below 2^63, their product below 2^100. */
static bool turns_left(const int32_t a[3], const int32_t b[3], const int32_t c[3], const int64_t normal[3]) {
    const int32_t corners[3][3] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]}};
    int64_t cross[3];
    solid_newell(corners, 3, cross);
    mesh_int128_t sum = 0;
    for (int k = 0; k < 3; k++) {
        sum += (mesh_int128_t)cross[k] * normal[k];
    }
    return sum > 0;
}

/* Every corner turns left, every triangle of the fan from the first corner does, and the fan stays within half a turn: then its
 * triangles cover the polygon once. The last is what a polygon that winds around twice fails. */
bool solid_convex(const int32_t (*points)[3], size_t count, const int64_t normal[3]) {
    for (size_t i = 0; i < count; i++) {
        if (!turns_left(points[i], points[(i + 1) % count], points[(i + 2) % count], normal) ||
            (i > 0 && i + 1 < count && !turns_left(points[0], points[i], points[i + 1], normal)) ||
            (i > 1 && !turns_left(points[0], points[1], points[i], normal))) {
            return false;
        }
    }
    return true;
}

static solid_vertex_t make_vertex(const work_t *w, const mesh_face_t *face, uint32_t corner) {
    const mesh_t *mesh = w->mesh;
    const uint32_t position = mesh->corners[corner];
    solid_vertex_t vertex = {.zero = 0};
    memcpy(vertex.position, w->places[position], sizeof vertex.position);
    memcpy(vertex.normal, w->normals[mesh->corner_normals[corner]], sizeof vertex.normal);
    if (w->solid->textured && mesh->surfaces[face->material].texture != TUILE_NO_TEXTURE) {
        for (int k = 0; k < 2; k++) {
            const double texels = ldexp(mesh->texcoords[corner][k], mesh->surfaces[face->material].uv_bits);
            vertex.texcoord[k] = (int16_t)lround(fmax(-Q_MAX, fmin(Q_MAX, texels)));
        }
    }
    if (w->solid->coloured) { memcpy(vertex.colour, mesh->colours[corner], sizeof vertex.colour); }
    if (w->solid->morphs) {
        memcpy(vertex.morph, w->places[position] + 4, sizeof vertex.morph);
        memcpy(vertex.morph_normal, w->morph_normals[mesh->morph.corner_normals[corner]], sizeof vertex.morph_normal);
    }
    return vertex;
}

static bool is_zero(const int64_t v[3]) { return !v[0] && !v[1] && !v[2]; }

static void unit_of(const int64_t normal[3], double unit[3]) {
    double length = 0;
    for (int k = 0; k < 3; k++) {
        length += (double)normal[k] * (double)normal[k];
    }
    for (int k = 0; k < 3; k++) {
        unit[k] = length > 0 ? (double)normal[k] / sqrt(length) : 0;
    }
}

/* Of the face's `count` corners, corner[pick[i]] or corner[i], in a key frame. False when they have no area. */
static bool normal_of(const work_t *w, const uint32_t *pick, size_t count, bool second, int64_t normal[3]) {
    const int32_t(*all)[3] = (const int32_t(*)[3])(second ? w->morph_points : w->points);
    int32_t triangle[3][3];
    for (int i = 0; pick && i < 3; i++) {
        memcpy(triangle[i], all[pick[i]], sizeof triangle[i]);
    }
    const int32_t(*points)[3] = pick ? (const int32_t(*)[3])triangle : all;
    solid_newell(points, count, normal);
    return !is_zero(normal) || (count > 3 && first_normal(points, count, normal));
}

/* Appends a face of `count` corners, corner[pick[i]] or corner[i]; 0 when it has no area, -1 without memory. A face that has one in
 * one key frame only takes its normal for both. */
static int emit(work_t *w, const mesh_face_t *from, const uint32_t *pick, size_t count) {
    solid_t *solid = w->solid;
    solid_face_t face = {
        .first = (uint32_t)solid->corner_count, .count = (uint32_t)count, .material = from->material, .source = from->source};
    int64_t second[3] = {0};
    const bool has_second = solid->morphs && normal_of(w, pick, count, true, second);
    if (!normal_of(w, pick, count, false, face.normal)) {
        if (!has_second) { return 0; }
        memcpy(face.normal, second, sizeof second);
    }
    face.convex = count == 3 || solid_convex((const int32_t(*)[3])w->points, count, face.normal);
    unit_of(face.normal, face.unit);
    unit_of(has_second ? second : face.normal, face.morph_unit);
    size_t corners = solid->corner_count + count;
    if (corners >= UINT32_MAX || !mesh_reserve(&w->vertices, &w->vertex_capacity, corners, sizeof *w->vertices) ||
        !mesh_reserve(&w->vertex_places, &w->place_capacity, corners, sizeof *w->vertex_places) ||
        !mesh_reserve(&solid->faces, &w->face_capacity, solid->face_count + 1, sizeof *solid->faces)) {
        return -1;
    }
    for (size_t i = 0; i < count; i++) {
        const uint32_t c = w->corner[pick ? pick[i] : i];
        w->vertices[solid->corner_count + i] = make_vertex(w, from, c);
        w->vertex_places[solid->corner_count + i] = w->place_index[w->mesh->corners[c]];
    }
    solid->corner_count = corners;
    solid->faces[solid->face_count++] = face;
    solid->polygons += count > 3;
    return 1;
}

/* The corners of a face once rounded, those dropped that came to lie on the one before. Their number. */
static size_t gather(work_t *w, const mesh_face_t *face) {
    size_t count = 0;
    for (uint32_t i = 0; i < face->count; i++) {
        uint32_t place = w->place_index[w->mesh->corners[face->first + i]];
        if (count && w->place_index[w->mesh->corners[w->corner[count - 1]]] == place) { continue; }
        w->corner[count++] = face->first + i;
    }
    while (count > 1 && w->place_index[w->mesh->corners[w->corner[count - 1]]] == w->place_index[w->mesh->corners[w->corner[0]]]) {
        count--;
    }
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            w->points[i][k] = w->places[w->mesh->corners[w->corner[i]]][k];
            w->morph_points[i][k] = w->places[w->mesh->corners[w->corner[i]]][4 + k];
        }
    }
    return count;
}

static bool evenly_lit(const work_t *w, size_t count) {
    const mesh_t *mesh = w->mesh;
    for (size_t i = 1; i < count; i++) {
        const uint32_t *of = mesh->corner_normals, *second = mesh->morph.corner_normals;
        if (memcmp(w->normals[of[w->corner[i]]], w->normals[of[w->corner[0]]], sizeof *w->normals) != 0 ||
            (w->solid->morphs && memcmp(w->morph_normals[second[w->corner[i]]], w->morph_normals[second[w->corner[0]]],
                                        sizeof *w->morph_normals) != 0)) {
            return false;
        }
    }
    return true;
}

/* In the second key frame it is the same polygon elsewhere: then it stays one on the way. */
static bool moves_as_one(const work_t *w, size_t count) {
    for (size_t i = 1; w->solid->morphs && i < count; i++) {
        for (int k = 0; k < 3; k++) {
            if (w->morph_points[i][k] - w->points[i][k] != w->morph_points[0][k] - w->points[0][k]) { return false; }
        }
    }
    return true;
}

static bool quantise_face(work_t *w, const mesh_face_t *face) {
    solid_t *solid = w->solid;
    size_t count = gather(w, face);
    bool bent = count > 3 && !w->options->keep_planar && !planar(w->mesh, face, solid->step_value);
    bool split = bent || count > MESH_CORNERS_MAX || (w->options->triangles && count > 3) ||
                 (count > 3 && (!moves_as_one(w, count) || !mesh_face_affine(w->mesh, face)));
    if (count > 3 && !split && !evenly_lit(w, count)) { /* interpolated light is only right on triangles: no fan, no single face */
        int64_t normal[3];
        solid_newell((const int32_t(*)[3])w->points, count, normal);
        split = !solid_convex((const int32_t(*)[3])w->points, count, normal);
    }
    if (count < 3) {
        solid->skipped++;
        return true;
    }
    if (!split) {
        int made = emit(w, face, NULL, count);
        solid->skipped += made == 0;
        return made >= 0;
    }
    const int32_t(*points)[3] = (const int32_t(*)[3])w->points;
    long triangles = mesh_triangulate(points, count, w->triangles);
    if (triangles == 0 && w->solid->morphs) { /* no area but in the second key frame */
        triangles = mesh_triangulate((const int32_t(*)[3])w->morph_points, count, w->triangles);
    }
    size_t before = solid->face_count;
    for (long t = 0; t < triangles; t++) {
        if (emit(w, face, w->triangles[t], 3) < 0) { return false; }
    }
    if (solid->face_count == before) {
        solid->skipped++;
    } else if (bent) {
        solid->non_planar++;
    } else {
        solid->split++;
    }
    return triangles >= 0;
}

/* One vertex for each place, normal and whatever else there is. */
static bool join(work_t *w) {
    solid_t *solid = w->solid;
    solid->corners = mesh_array(solid->corner_count, sizeof *solid->corners);
    if (!solid->corners) { return false; }
    if (!w->vertices) { /* no face was left */
        return true;
    }
    solid->vertex_count = meshopt_generateVertexRemap(solid->corners, NULL, solid->corner_count, w->vertices, solid->corner_count,
                                                      sizeof *w->vertices);
    for (size_t c = 0; c < solid->corner_count; c++) { /* in place: a vertex never moves up */
        w->vertices[solid->corners[c]] = w->vertices[c];
        w->vertex_places[solid->corners[c]] = w->vertex_places[c];
    }
    solid->vertices = w->vertices;
    solid->places = w->vertex_places;
    w->vertices = NULL;
    w->vertex_places = NULL;
    return true;
}

int solid_quantise(solid_t *solid, const mesh_t *mesh, const mesh_options_t *options, sim_error_t *error) {
    memset(solid, 0, sizeof *solid);
    solid->textured = mesh->texcoords && mesh->surfaces;
    solid->coloured = mesh->colours != NULL;
    solid->morphs = mesh->morph.positions != NULL;
    if (mesh->face_count == 0) { return sim_fail(error, "the model has no faces; there is nothing to draw"); }
    extent_t extent = measure(mesh);
    if (choose_grid(solid, &extent, options->step, error)) { return -1; }
    uint32_t largest = 3;
    for (size_t f = 0; f < mesh->face_count; f++) {
        largest = mesh->faces[f].count > largest ? mesh->faces[f].count : largest;
    }
    work_t w = {.solid = solid, .mesh = mesh, .options = options};
    w.places = mesh_array(mesh->position_count, sizeof *w.places);
    w.place_index = mesh_array(mesh->position_count, sizeof *w.place_index);
    w.normals = mesh_array(mesh->normal_count, sizeof *w.normals);
    w.morph_normals = mesh_array(mesh->morph.normal_count, sizeof *w.morph_normals);
    w.corner = mesh_array(largest, sizeof *w.corner);
    w.points = mesh_array(largest, sizeof *w.points);
    w.morph_points = mesh_array(largest, sizeof *w.morph_points);
    w.triangles = mesh_array(largest, sizeof *w.triangles);
    bool done = w.places && w.place_index && w.normals && w.corner && w.points && w.morph_points && w.triangles && w.morph_normals;
    if (done) { quantise_places(&w); }
    for (size_t f = 0; done && f < mesh->face_count; f++) {
        done = quantise_face(&w, &mesh->faces[f]);
    }
    size_t faces = solid->face_count;
    if (done && faces) { done = join(&w); }
    work_free(&w);
    if (!done || !faces) {
        solid_free(solid);
        return !done ? sim_fail(error, "out of memory for a model of %zu faces", mesh->face_count)
                     : sim_fail(error, "all %zu faces of the model are degenerate; there is nothing to draw", mesh->face_count);
    }
    return 0;
}
