/* Everything is made whole first: coordinates and NEAR times L, the least common multiple of their denominators; window quantities
 * (F, CX, CY, SX, SY) times S, that of theirs. A vertex is then (X, Y, W), W > 0, and its place relative to a sample has the sign
 * of A X - rx W and B Y - ry W, where rx / S and ry / S are the sample's coordinates: perspective   W = Z (times a positive number
 * for a vertex that the near plane made), A = F S, B = YSIGN F S, sample minus C orthographic  W = L, A = B = S so both cameras
 * share the even-odd test and no division happens anywhere. */
#include "visibility_reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef __int128 int128_t;

typedef struct point {
    int128_t x, y, w;
} point_t;

typedef struct face {
    size_t first, count; /* in points; count may be 0: cut away */
    /* The plane n . p = k in whole coordinates, n without a common divisor; turned so that k > 0 (perspective) or n[2] > 0
     * (orthographic). When that cannot be, the face is seen edge-on and covers nothing. */
    int128_t n[3], k;
    bool edge_on;
    /* Of the current sample. */
    bool inside, close;  /* close: an edge within the displacement */
    int128_t depth;      /* inside: perspective n . ray, orthographic k S - L (n . sample); see nearer() */
    double steps, slope; /* !edge_on: depth in steps, larger is nearer, and by how much it changes within the displacement */
} face_t;

struct visibility_reference {
    bool perspective, near_max, tie_last;
    int64_t window_unit, scene_unit; /* S, L */
    int64_t factor_x, factor_y;      /* A, B */
    int64_t offset[2];               /* rx = x S + offset[0] */
    int64_t focal, near;             /* F S, NEAR L */
    double displacement_px, depth_steps, depth_step;
    int width, height;
    point_t *points;
    struct {
        int128_t a, b;
        double x, y; /* a and b in pixels */
    } * at;          /* scratch: the points relative to the current sample */
    face_t *faces;
    int32_t face_count;
};

static int128_t absolute(int128_t a) { return a < 0 ? -a : a; }

static int128_t gcd(int128_t a, int128_t b) {
    a = absolute(a);
    b = absolute(b);
    while (b) {
        int128_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

static int bits(int128_t a) {
    int count = 0;
    for (a = absolute(a); a; a /= 2) {
        count++;
    }
    return count;
}

static int larger(int a, int b) { return a > b ? a : b; }

enum { COORDINATE_BITS = 40, WINDOW_BITS = 40 };

/* Multiplies *unit up so that number times it is whole; false when it leaves the bits. */
static bool cover(int64_t *unit, scene_number_t number, int unit_bits) {
    int128_t wanted = *unit / gcd(*unit, number.denominator) * number.denominator;
    if (bits(wanted) > unit_bits) { return false; }
    *unit = (int64_t)wanted;
    return true;
}

static bool make_whole(int64_t *whole, scene_number_t number, int64_t unit, int whole_bits) {
    int128_t value = (int128_t)number.numerator * (unit / number.denominator);
    if (bits(value) > whole_bits) { return false; }
    *whole = (int64_t)value;
    return true;
}

/* The plane of three vertices that span one. Coordinates of 40 bits make n 83 bits and k 126 bits. */
static void find_plane(face_t *face, int64_t (*v)[3], size_t count, bool perspective) {
    memset(face->n, 0, sizeof face->n);
    for (size_t i = 1; i < count && !face->n[0] && !face->n[1] && !face->n[2]; i++) {
        for (size_t j = i + 1; j < count && !face->n[0] && !face->n[1] && !face->n[2]; j++) {
            for (int c = 0; c < 3; c++) {
                int d = (c + 1) % 3, e = (c + 2) % 3;
                face->n[c] =
                    (int128_t)(v[i][d] - v[0][d]) * (v[j][e] - v[0][e]) - (int128_t)(v[i][e] - v[0][e]) * (v[j][d] - v[0][d]);
            }
        }
    }
    int128_t divisor = gcd(gcd(face->n[0], face->n[1]), face->n[2]);
    face->k = 0;
    for (int c = 0; c < 3; c++) {
        face->n[c] /= divisor; /* the parser refuses polygons without area: not 0 */
        face->k += face->n[c] * v[0][c];
    }
    int128_t front = perspective ? face->k : face->n[2];
    face->edge_on = front == 0;
    if (front < 0) {
        for (int c = 0; c < 3; c++) {
            face->n[c] = -face->n[c];
        }
        face->k = -face->k;
    }
}

/* Appends the part of the polygon with Z >= near. A new vertex is a weighted sum of two old ones, left undivided: the eye is the
 * origin, so a positive factor does not move its projection. */
static void cut_near(visibility_reference_t *reference, face_t *face, int64_t (*v)[3], size_t count, size_t *point_count) {
    face->first = *point_count;
    for (size_t i = 0; i < count; i++) {
        const int64_t *p = v[i], *q = v[(i + 1) % count];
        int128_t p_depth = (int128_t)p[2] - reference->near, q_depth = (int128_t)q[2] - reference->near;
        if (p_depth >= 0) { reference->points[(*point_count)++] = (point_t){p[0], p[1], p[2]}; }
        if ((p_depth > 0 && q_depth < 0) || (p_depth < 0 && q_depth > 0)) {
            int128_t p_weight = absolute(q_depth), q_weight = absolute(p_depth);
            reference->points[(*point_count)++] =
                (point_t){p[0] * p_weight + q[0] * q_weight, p[1] * p_weight + q[1] * q_weight, p[2] * p_weight + q[2] * q_weight};
        }
    }
    face->count = *point_count - face->first;
}

/* Do all products that will be formed for samples up to twice the window's size fit 126 bits? */
static bool fits(const visibility_reference_t *reference, size_t point_count) {
    int64_t reach = 2 * (int64_t)(reference->width > reference->height ? reference->width : reference->height);
    int128_t sample = reach * (int128_t)reference->window_unit;
    int sample_bits = larger(larger(bits(sample), bits(reference->offset[0])), bits(reference->offset[1])) + 1;
    int ray_bits = larger(sample_bits, bits(reference->factor_x)), point_bits = 0, n_bits = 0, k_bits = 0;
    for (size_t i = 0; i < point_count; i++) {
        point_bits = larger(larger(larger(point_bits, bits(reference->points[i].x)), bits(reference->points[i].y)),
                            bits(reference->points[i].w));
    }
    for (int32_t i = 0; i < reference->face_count; i++) {
        const face_t *face = &reference->faces[i];
        n_bits = larger(larger(larger(n_bits, bits(face->n[0])), bits(face->n[1])), bits(face->n[2]));
        k_bits = larger(k_bits, bits(face->k));
    }
    if (2 * (ray_bits + point_bits + 1) + 1 > 126) { return false; }
    if (reference->perspective) { return n_bits + ray_bits + 2 + k_bits <= 126; }
    int depth_bits = larger(k_bits + bits(reference->window_unit), n_bits + sample_bits + 1 + bits(reference->scene_unit)) + 1;
    return depth_bits + n_bits <= 126;
}

static double default_depth_step(const scene_text_t *scene) {
    double low = INFINITY, high = -INFINITY, largest = 32767;
    for (size_t i = 0; i < scene->vertex_count; i++) {
        for (int c = 0; c < 3; c++) {
            double value = (double)scene->vertices[i][c].numerator / (double)scene->vertices[i][c].denominator;
            largest = fmax(largest, fabs(value));
            low = c == 2 ? fmin(low, value) : low;
            high = c == 2 ? fmax(high, value) : high;
        }
    }
    double range = high > low ? high - low : 0;
    return (range + 2 * fmax(range / 4096, 2 * largest / 32767)) / 65472;
}

/* Window numbers as whole numbers of 1 / S. */
static bool set_window(visibility_reference_t *reference, const scene_text_t *scene) {
    int64_t origin, sample;
    int64_t *unit = &reference->window_unit;
    bool good = !reference->perspective || cover(unit, scene->focal, WINDOW_BITS);
    for (int i = 0; i < 2; i++) {
        good = good && cover(unit, scene->origin[i], WINDOW_BITS) && cover(unit, scene->sample[i], WINDOW_BITS);
    }
    for (int i = 0; i < 2 && good; i++) {
        good =
            make_whole(&origin, scene->origin[i], *unit, WINDOW_BITS) && make_whole(&sample, scene->sample[i], *unit, WINDOW_BITS);
        reference->offset[i] = good ? sample - (reference->perspective ? origin : 0) : 0;
    }
    reference->focal = *unit;
    good = good && (!reference->perspective || make_whole(&reference->focal, scene->focal, *unit, WINDOW_BITS));
    reference->factor_x = reference->focal;
    reference->factor_y = reference->perspective ? scene->y_sign * reference->focal : reference->focal;
    return good;
}

static bool set_faces(visibility_reference_t *reference, const scene_text_t *scene) {
    int64_t *unit = &reference->scene_unit;
    bool good = !reference->perspective || cover(unit, scene->near, COORDINATE_BITS);
    for (size_t i = 0; i < scene->vertex_count; i++) {
        for (int c = 0; c < 3; c++) {
            good = good && cover(unit, scene->vertices[i][c], COORDINATE_BITS);
        }
    }
    if (!good || (reference->perspective && !make_whole(&reference->near, scene->near, *unit, COORDINATE_BITS))) { return false; }
    size_t point_count = 0;
    for (size_t i = 0; i < scene->poly_count; i++) {
        const scene_poly_t *poly = &scene->polys[i];
        face_t *face = &reference->faces[i];
        int64_t v[SCENE_TEXT_CORNERS_MAX][3];
        for (size_t k = 0; k < poly->count; k++) {
            for (int c = 0; c < 3; c++) {
                if (!make_whole(&v[k][c], scene->vertices[poly->first + k][c], *unit, COORDINATE_BITS)) { return false; }
            }
        }
        find_plane(face, v, poly->count, reference->perspective);
        if (reference->perspective) {
            cut_near(reference, face, v, poly->count, &point_count);
        } else {
            face->first = point_count;
            face->count = poly->count;
            for (size_t k = 0; k < poly->count; k++) {
                reference->points[point_count++] = (point_t){v[k][0], v[k][1], *unit};
            }
        }
    }
    return fits(reference, point_count);
}

int visibility_reference_make(visibility_reference_t **out, const scene_text_t *scene, const visibility_options_t *options,
                              sim_error_t *error) {
    visibility_options_t given = options ? *options : (visibility_options_t){0};
    *out = NULL;
    if (scene->poly_count > INT32_MAX / 2) { return sim_fail(error, "the scene has too many faces"); }
    visibility_reference_t *reference = calloc(1, sizeof *reference);
    if (!reference) { return sim_fail(error, "out of memory"); }
    *reference = (visibility_reference_t){
        .perspective = scene->projection == TUILE_PERSPECTIVE,
        .near_max = scene->near_max,
        .tie_last = scene->tie_last,
        .window_unit = 1,
        .scene_unit = 1,
        .displacement_px = given.displacement_px > 0 ? given.displacement_px : 1.0 / 16,
        .depth_steps = given.depth_steps > 0 ? given.depth_steps : 1.0625,
        .depth_step = given.depth_step > 0 ? given.depth_step : default_depth_step(scene),
        .width = scene->width,
        .height = scene->height,
        .face_count = (int32_t)scene->poly_count,
    };
    size_t room = 2 * scene->vertex_count + 1; /* the near plane makes at most one vertex an edge */
    reference->points = calloc(room, sizeof *reference->points);
    reference->at = calloc(room, sizeof *reference->at);
    reference->faces = calloc(scene->poly_count + 1, sizeof *reference->faces);
    int result = 0;
    if (!reference->points || !reference->at || !reference->faces) {
        result = sim_fail(error, "out of memory");
    } else if (!set_window(reference, scene) || !set_faces(reference, scene)) {
        result = sim_fail(error, "the scene's numbers are too long for the exact reference");
    }
    if (result < 0) {
        visibility_reference_free(reference);
        return result;
    }
    *out = reference;
    return 0;
}

void visibility_reference_free(visibility_reference_t *reference) {
    if (!reference) { return; }
    free(reference->points);
    free(reference->at);
    free(reference->faces);
    free(reference);
}

/* Distance from the origin to the segment from (x0, y0) to (x1, y1). */
static double distance_to_segment(double x0, double y0, double x1, double y1) {
    double dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
    double along = length2 > 0 ? -(x0 * dx + y0 * dy) / length2 : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    return hypot(x0 + along * dx, y0 + along * dy);
}

/* Is the sample in the face's projection, and how close are its edges? */
static void look_at_edges(visibility_reference_t *reference, face_t *face, int64_t rx, int64_t ry) {
    const double reach = reference->displacement_px * 1.41422 + 1e-6; /* from the square's middle to its corners */
    for (size_t i = face->first; i < face->first + face->count; i++) {
        const point_t *p = &reference->points[i];
        reference->at[i].a = reference->factor_x * p->x - rx * p->w;
        reference->at[i].b = reference->factor_y * p->y - ry * p->w;
        double unit = (double)p->w * (double)reference->window_unit;
        reference->at[i].x = (double)reference->at[i].a / unit;
        reference->at[i].y = (double)reference->at[i].b / unit;
    }
    face->inside = face->close = false;
    for (size_t i = 0; i < face->count; i++) {
        size_t p = face->first + i, q = face->first + (i + 1) % face->count;
        if (distance_to_segment(reference->at[p].x, reference->at[p].y, reference->at[q].x, reference->at[q].y) <= reach) {
            face->close = true;
        }
        bool p_above = reference->at[p].b <= 0, q_above = reference->at[q].b <= 0;
        if (p_above == q_above) { continue; }
        /* Where the edge meets the row: p and q weighted with the other's b, both weights positive. */
        size_t above = p_above ? p : q, below = p_above ? q : p;
        int128_t a = reference->at[above].a * reference->at[below].b - reference->at[below].a * reference->at[above].b;
        if (a <= 0) { face->inside = !face->inside; }
    }
}

static void look_at_depth(const visibility_reference_t *reference, face_t *face, int64_t rx, int64_t ry) {
    if (face->edge_on) { return; }
    const int128_t *n = face->n;
    double displacement = reference->displacement_px, unit = (double)reference->window_unit;
    if (reference->perspective) {
        /* The ray is (rx, YSIGN ry, F S) / (F S) * Z, so 1 / Z = (n . ray) / (k F S). */
        int64_t sign = reference->factor_y < 0 ? -1 : 1;
        face->depth = n[0] * rx + n[1] * sign * ry + n[2] * reference->focal;
        double scale = 65528.0 * (double)reference->near / ((double)face->k * (double)reference->focal);
        face->steps = (double)face->depth * scale;
        face->slope = ((double)absolute(n[0]) + (double)absolute(n[1])) * unit * scale * displacement;
    } else {
        /* z = (k S - L (n . sample)) / (n[2] S), in 1 / L scene units. */
        face->depth = face->k * reference->window_unit - (n[0] * rx + n[1] * ry) * reference->scene_unit;
        double scale = 1 / ((double)n[2] * reference->depth_step);
        face->steps = (double)face->depth / (unit * (double)reference->scene_unit) * (reference->near_max ? scale : -scale);
        face->slope = ((double)absolute(n[0]) + (double)absolute(n[1])) * scale * displacement;
    }
}

/* 1 when f is nearer than g at the sample, -1 when farther, 0 when equally near. Both are inside, hence not edge-on. */
static int nearer(const visibility_reference_t *reference, const face_t *f, const face_t *g) {
    int128_t left, right;
    if (reference->perspective) { /* the larger 1 / Z */
        left = f->depth * g->k;
        right = g->depth * f->k;
    } else {
        left = f->depth * g->n[2];
        right = g->depth * f->n[2];
        if (!reference->near_max) {
            left = -left;
            right = -right;
        }
    }
    return (left > right) - (left < right);
}

static int32_t look(visibility_reference_t *reference, int x, int y) {
    int64_t rx = x * reference->window_unit + reference->offset[0], ry = y * reference->window_unit + reference->offset[1];
    int32_t seen = -1;
    for (int32_t i = 0; i < reference->face_count; i++) {
        face_t *face = &reference->faces[i];
        look_at_edges(reference, face, rx, ry);
        look_at_depth(reference, face, rx, ry);
        if (!face->inside) { continue; }
        int order = seen < 0 ? 1 : nearer(reference, face, &reference->faces[seen]);
        if (order > 0 || (order == 0 && reference->tie_last)) { seen = i; }
    }
    return seen;
}

static bool surely_there(const face_t *face) { return face->inside && !face->close; }

/* f is in front of g wherever the displacement may put the sample, by more than can be mistaken. */
static bool clearly_in_front(const visibility_reference_t *reference, const face_t *f, const face_t *g) {
    if (f->edge_on || g->edge_on) { return false; }
    return f->steps - g->steps - f->slope - g->slope > reference->depth_steps;
}

/* After look(): is the face possibly seen? */
static bool possibly_seen(const visibility_reference_t *reference, int32_t index) {
    const face_t *face = index < 0 ? NULL : &reference->faces[index];
    if (face && !face->inside && !face->close) { return false; }
    for (int32_t i = 0; i < reference->face_count; i++) {
        if (i != index && surely_there(&reference->faces[i]) &&
            (!face || clearly_in_front(reference, &reference->faces[i], face))) {
            return false;
        }
    }
    return true;
}

static bool same_plane(const face_t *f, const face_t *g) {
    return f->k == g->k && f->n[0] == g->n[0] && f->n[1] == g->n[1] && f->n[2] == g->n[2];
}

visibility_pixel_t visibility_reference_at(visibility_reference_t *reference, int x, int y) {
    visibility_pixel_t pixel = {.face = look(reference, x, y)};
    const face_t *seen = pixel.face < 0 ? NULL : &reference->faces[pixel.face];
    for (int32_t i = -1; i < reference->face_count; i++) {
        if (i == pixel.face || !possibly_seen(reference, i)) { continue; }
        if (!seen || i < 0 || !surely_there(seen) || !surely_there(&reference->faces[i])) {
            pixel.doubt |= VISIBILITY_EDGE;
        } else {
            pixel.doubt |= same_plane(seen, &reference->faces[i]) ? VISIBILITY_COPLANAR : VISIBILITY_DEPTH;
        }
    }
    return pixel;
}

bool visibility_reference_allows(visibility_reference_t *reference, int x, int y, int32_t face) {
    return face >= -1 && face < reference->face_count && (look(reference, x, y) == face || possibly_seen(reference, face));
}
