/* Polygons to triangles by ear clipping, in exact integers.
 *
 * The polygon is looked at along the axis in which its Newell normal is longest. Of the ears there the roundest is cut first,
 * which keeps slivers few. A corner between two collinear edges is no ear; it stays, as a neighbour may share that vertex, until
 * nothing else is left, and then falls without a triangle. Repeated vertices and the tips of spikes fall at once: left to the
 * end, the two sides of a spike would seem to enclose something. Polygons that touch themselves, as those do whose holes are
 * joined to the outline by a bridge, come out right. Where one crosses itself as seen (a bent one may, though it does not in
 * space) there is no right cut: the widest corner is taken, and its triangle kept even if it comes out reversed, as the surface
 * would else have a hole there.
 */
#include "stages.h"

#include <math.h>

typedef struct flat_point {
    int64_t x, y; /* counter-clockwise as seen; |coordinate| <= MESH_TRIANGULATE_RANGE */
} flat_point_t;

typedef struct ring {
    const int32_t (*solid)[3]; /* the polygon as given */
    const flat_point_t *points;
    uint32_t *next, *previous;
    double *roundness; /* of an ear, > 0; 0 = not an ear */
    uint32_t left;     /* corners still there */
} ring_t;

/* Twice the signed area, exact: |differences| <= 2^29, so products < 2^59. */
static int64_t area(flat_point_t a, flat_point_t b, flat_point_t c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static bool same(flat_point_t a, flat_point_t b) { return a.x == b.x && a.y == b.y; }

/* Is d strictly inside the angle at `at` from `from` counter-clockwise to `to`, that angle being below 180 degrees? */
static bool in_wedge(flat_point_t at, flat_point_t from, flat_point_t to, flat_point_t d) {
    return area(at, from, d) > 0 && area(at, d, to) > 0;
}

/* Does the vertex q keep the corner b of the ring, between a and c, from being cut off? */
static bool blocks(const ring_t *ring, uint32_t a, uint32_t b, uint32_t c, uint32_t q) {
    const flat_point_t *p = ring->points;
    const flat_point_t before = p[ring->previous[q]], after = p[ring->next[q]];
    if (same(p[q], p[a])) { /* another visit to a corner of the ear: only if it turns into the ear */
        return in_wedge(p[a], p[b], p[c], before) || in_wedge(p[a], p[b], p[c], after);
    }
    if (same(p[q], p[b])) { return in_wedge(p[b], p[c], p[a], before) || in_wedge(p[b], p[c], p[a], after); }
    if (same(p[q], p[c])) { return in_wedge(p[c], p[a], p[b], before) || in_wedge(p[c], p[a], p[b], after); }
    int64_t ab = area(p[a], p[b], p[q]), bc = area(p[b], p[c], p[q]), ca = area(p[c], p[a], p[q]);
    if (ab < 0 || bc < 0 || ca < 0) { return false; }
    if (ab > 0 && bc > 0) { return true; /* inside, or on the cut itself */ }
    /* On one of the two old edges: an outline that comes from there into the ear crosses it. */
    flat_point_t from = ab == 0 ? p[a] : p[b], to = ab == 0 ? p[b] : p[c];
    return area(from, to, before) > 0 || area(from, to, after) > 0;
}

static double roundness(const ring_t *ring, uint32_t b) {
    uint32_t a = ring->previous[b], c = ring->next[b];
    const flat_point_t *p = ring->points;
    int64_t twice = area(p[a], p[b], p[c]);
    if (twice <= 0) { return 0; }
    for (uint32_t q = ring->next[c]; q != a; q = ring->next[q]) {
        if (blocks(ring, a, b, c, q)) { return 0; }
    }
    double squares = 0;
    const uint32_t corners[4] = {a, b, c, a};
    for (int i = 0; i < 3; i++) {
        double dx = (double)(p[corners[i + 1]].x - p[corners[i]].x), dy = (double)(p[corners[i + 1]].y - p[corners[i]].y);
        squares += dx * dx + dy * dy;
    }
    return (double)twice / squares;
}

static uint32_t roundest(const ring_t *ring, uint32_t start) {
    uint32_t best = start;
    for (uint32_t i = 0, at = start; i < ring->left; i++, at = ring->next[at]) {
        if (ring->roundness[at] > ring->roundness[best]) { best = at; }
    }
    return best;
}

/* Where no ear is left: a corner without area, else the one with most. */
static uint32_t least_bad(const ring_t *ring, uint32_t start) {
    uint32_t best = start;
    int64_t most = INT64_MIN;
    for (uint32_t i = 0, at = start; i < ring->left; i++, at = ring->next[at]) {
        int64_t twice = area(ring->points[ring->previous[at]], ring->points[at], ring->points[ring->next[at]]);
        if (twice == 0) { return at; }
        if (twice > most) {
            most = twice;
            best = at;
        }
    }
    return best;
}

static void cut(ring_t *ring, uint32_t at) {
    ring->next[ring->previous[at]] = ring->next[at];
    ring->previous[ring->next[at]] = ring->previous[at];
    ring->left--;
}

/* Is there a triangle in space, exactly? Differences <= 2^29, as above. */
static bool has_area(const ring_t *ring, uint32_t a, uint32_t b, uint32_t c) {
    const int32_t *p = ring->solid[a], *q = ring->solid[b], *r = ring->solid[c];
    for (int k = 0; k < 3; k++) {
        int y = (k + 1) % 3, z = (k + 2) % 3;
        if ((int64_t)(q[y] - p[y]) * (r[z] - p[z]) != (int64_t)(q[z] - p[z]) * (r[y] - p[y])) { return true; }
    }
    return false;
}

/* A vertex repeated, or the tip of a spike: the outline goes back the way it came. */
static bool is_spike(const ring_t *ring, uint32_t at) {
    uint32_t before = ring->previous[at], after = ring->next[at];
    const int32_t *a = ring->solid[before], *b = ring->solid[at], *c = ring->solid[after];
    int64_t forth = 0, along = 0, back = 0;
    for (int k = 0; k < 3; k++) {
        forth += llabs((int64_t)b[k] - a[k]);
        back += llabs((int64_t)c[k] - b[k]);
        along += (int64_t)(a[k] - b[k]) * (c[k] - b[k]);
    }
    return !has_area(ring, before, at, after) && (!forth || !back || along > 0);
}

/* Cuts off the spikes at `at` and behind it, and those that appear thereby; what stands at `at` then. */
static uint32_t trim(ring_t *ring, uint32_t at) {
    while (ring->left >= 3) {
        if (is_spike(ring, at)) {
            cut(ring, at);
            at = ring->previous[at];
        } else if (is_spike(ring, ring->next[at])) {
            cut(ring, ring->next[at]);
        } else {
            break;
        }
    }
    return at;
}

static long clip(ring_t *ring, uint32_t (*triangles)[3]) {
    long count = 0;
    uint32_t start = 0;
    for (uint32_t i = ring->left; i > 0; i--) {
        start = ring->next[trim(ring, start)];
    }
    for (uint32_t i = 0, at = start; i < ring->left; i++, at = ring->next[at]) {
        ring->roundness[at] = ring->left < 3 ? 0 : roundness(ring, at);
    }
    while (ring->left >= 3) {
        uint32_t ear = roundest(ring, start);
        if (!(ring->roundness[ear] > 0)) { /* a cut may have freed corners further away */
            for (uint32_t i = 0, at = start; i < ring->left; i++, at = ring->next[at]) {
                ring->roundness[at] = roundness(ring, at);
            }
            ear = roundest(ring, start);
        }
        if (!(ring->roundness[ear] > 0)) { ear = least_bad(ring, start); }
        uint32_t a = ring->previous[ear], c = ring->next[ear];
        if (has_area(ring, a, ear, c)) {
            triangles[count][0] = a;
            triangles[count][1] = ear;
            triangles[count][2] = c;
            count++;
        }
        cut(ring, ear);
        start = trim(ring, a);
        if (ring->left >= 3) {
            ring->roundness[start] = roundness(ring, start);
            ring->roundness[ring->next[start]] = roundness(ring, ring->next[start]);
        }
    }
    return count;
}

/* Doubles are enough to choose the axis to look along and the side to look from; a polygon for which they are not has hardly any
 * area, and its triangles are then checked exactly. */
static bool flatten(const int32_t (*points)[3], size_t count, flat_point_t *flat) {
    double normal[3] = {0};
    for (size_t i = 1; i + 1 < count; i++) {
        double a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = (double)(points[i][k] - points[0][k]);
            b[k] = (double)(points[i + 1][k] - points[0][k]);
        }
        for (int k = 0; k < 3; k++) {
            normal[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        }
    }
    int axis = 0;
    for (int k = 1; k < 3; k++) {
        if (fabs(normal[k]) > fabs(normal[axis])) { axis = k; }
    }
    if (!(fabs(normal[axis]) > 0)) { return false; }
    int x = (axis + 1) % 3, y = (axis + 2) % 3;
    for (size_t i = 0; i < count; i++) {
        flat[i].x = points[i][normal[axis] > 0 ? x : y];
        flat[i].y = points[i][normal[axis] > 0 ? y : x];
    }
    return true;
}

long mesh_triangulate(const int32_t (*points)[3], size_t count, uint32_t (*triangles)[3]) {
    flat_point_t *flat = mesh_array(count, sizeof *flat);
    ring_t ring = {.solid = points,
                   .points = flat,
                   .next = mesh_array(count, sizeof *ring.next),
                   .previous = mesh_array(count, sizeof *ring.previous),
                   .roundness = mesh_array(count, sizeof *ring.roundness),
                   .left = (uint32_t)count};
    long made = -1;
    if (flat && ring.next && ring.previous && ring.roundness && count < UINT32_MAX) {
        made = 0;
        if (count >= 3 && flatten(points, count, flat)) {
            for (uint32_t i = 0; i < ring.left; i++) {
                ring.next[i] = i + 1 < ring.left ? i + 1 : 0;
                ring.previous[i] = i ? i - 1 : ring.left - 1;
            }
            made = clip(&ring, triangles);
        }
    }
    free(flat);
    free(ring.next);
    free(ring.previous);
    free(ring.roundness);
    return made;
}
