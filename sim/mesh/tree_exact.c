/* Planes and points without rounding; the bounds stand in tree_exact.h. */
#include "tree_exact.h"

#include <math.h>

/* ---- making ------------------------------------------------------------------------------------------------- */

static mesh_uint128_t magnitude(mesh_int128_t x) { return x < 0 ? -(mesh_uint128_t)x : (mesh_uint128_t)x; }

static int trailing_zeros(mesh_uint128_t x) {
    return (uint64_t)x ? __builtin_ctzll((uint64_t)x) : 64 + __builtin_ctzll((uint64_t)(x >> 64));
}

/* Stein's, as 128-bit division is slow; a and b not both 0. */
static mesh_uint128_t common_divisor(mesh_uint128_t a, mesh_uint128_t b) {
    if (!a || !b) { return a | b; }
    int shift = trailing_zeros(a | b);
    a >>= trailing_zeros(a);
    while (b) {
        b >>= trailing_zeros(b);
        if (a > b) {
            mesh_uint128_t swap = a;
            a = b;
            b = swap;
        }
        b -= a;
    }
    return a << shift;
}

bool exact_plane_make(exact_plane_t *plane, const int64_t normal[3], const int16_t through[3]) {
    mesh_uint128_t divisor = 0;
    for (int k = 0; k < 3; k++) {
        divisor = common_divisor(divisor, magnitude(normal[k]));
    }
    bool turned = normal[0] ? normal[0] < 0 : normal[1] ? normal[1] < 0 : normal[2] < 0;
    double sum = 0;
    plane->d = 0;
    for (int k = 0; k < 3; k++) {
        plane->n[k] = normal[k] / (int64_t)divisor * (turned ? -1 : 1);
        plane->d -= plane->n[k] * through[k];
        plane->through[k] = through[k];
        plane->f[k] = (double)plane->n[k];
        sum += fabs(plane->f[k]);
    }
    plane->e = (double)plane->d;
    plane->doubt = ldexp(sum, -33); /* twice what is proved: sum is rounded too */
    return turned;
}

void exact_point_whole(exact_point_t *point, const int16_t at[3]) {
    for (int k = 0; k < 3; k++) {
        point->x[k] = at[k];
        point->at[k] = at[k];
    }
    point->w = 1;
    point->doubt = 0;
}

static void reduce(exact_point_t *point) {
    mesh_uint128_t divisor = magnitude(point->w);
    for (int k = 0; k < 3 && divisor != 1; k++) {
        divisor = common_divisor(divisor, magnitude(point->x[k]));
    }
    mesh_int128_t by = point->w < 0 ? -(mesh_int128_t)divisor : (mesh_int128_t)divisor;
    if (by != 1) {
        for (int k = 0; k < 3; k++) {
            point->x[k] /= by;
        }
        point->w /= by;
    }
    for (int k = 0; k < 3; k++) {
        point->at[k] = (double)point->x[k] / (double)point->w;
    }
    point->doubt = point->w == 1 ? 0 : 1;
}

static int64_t value_at(const exact_plane_t *plane, const int16_t at[3]) {
    return plane->n[0] * at[0] + plane->n[1] * at[1] + plane->n[2] * at[2] + plane->d;
}

/* a + (b - a) A / (A - B) for the values A, B < 2^51 of the plane there. */
void exact_point_on_edge(exact_point_t *point, const int16_t a[3], const int16_t b[3], const exact_plane_t *plane) {
    mesh_int128_t value_a = value_at(plane, a), value_b = value_at(plane, b);
    point->w = value_a - value_b;
    for (int k = 0; k < 3; k++) {
        point->x[k] = a[k] * point->w + (b[k] - a[k]) * value_a;
    }
    reduce(point);
}

void exact_cross(const int64_t a[3], const int64_t b[3], mesh_int128_t cross[3]) {
    for (int k = 0; k < 3; k++) {
        int y = (k + 1) % 3, z = (k + 2) % 3;
        cross[k] = (mesh_int128_t)a[y] * b[z] - (mesh_int128_t)a[z] * b[y];
    }
}

void exact_point_of_planes(exact_point_t *point, const exact_plane_t *p, const exact_plane_t *q, const exact_plane_t *r) {
    mesh_int128_t qr[3], rp[3], pq[3];
    exact_cross(q->n, r->n, qr);
    exact_cross(r->n, p->n, rp);
    exact_cross(p->n, q->n, pq);
    point->w = 0;
    for (int k = 0; k < 3; k++) {
        point->w += p->n[k] * qr[k];
        point->x[k] = -(p->d * qr[k] + q->d * rp[k] + r->d * pq[k]);
    }
    reduce(point);
}

/* ---- asking ------------------------------------------------------------------------------------------------- */

int exact_side_unfiltered(const exact_plane_t *plane, const exact_point_t *point) {
    mesh_int128_t high = 0, low = 0; /* the value is high * 2^64 + low: |high| < 4 * 2^50 * 2^55, |low| < 4 * 2^50 * 2^64 */
    for (int k = 0; k < 4; k++) {
        mesh_int128_t x = k < 3 ? point->x[k] : point->w;
        int64_t n = k < 3 ? plane->n[k] : plane->d;
        high += (x >> 64) * n;
        low += (mesh_int128_t)(uint64_t)x * n;
    }
    high += low >> 64;
    if (high) { return high < 0 ? -1 : 1; }
    return (uint64_t)low != 0;
}

int exact_side(const exact_plane_t *plane, const exact_point_t *point) {
    double value = plane->f[0] * point->at[0] + plane->f[1] * point->at[1] + plane->f[2] * point->at[2] + plane->e;
    double doubt = plane->doubt * point->doubt;
    if (value > doubt) { return 1; }
    if (value < -doubt) { return -1; }
    return doubt > 0 ? exact_side_unfiltered(plane, point) : 0;
}

static void multiply(mesh_uint128_t a, mesh_uint128_t b, mesh_uint128_t product[2]) {
    uint64_t a0 = (uint64_t)a, a1 = (uint64_t)(a >> 64), b0 = (uint64_t)b, b1 = (uint64_t)(b >> 64);
    mesh_uint128_t low = (mesh_uint128_t)a0 * b0, middle = (mesh_uint128_t)a1 * b0 + (low >> 64);
    mesh_uint128_t other = (mesh_uint128_t)a0 * b1 + (uint64_t)middle;
    product[0] = other << 64 | (uint64_t)low;
    product[1] = (mesh_uint128_t)a1 * b1 + (middle >> 64) + (other >> 64);
}

int exact_order_unfiltered(const exact_point_t *a, const exact_point_t *b, int axis) {
    mesh_int128_t x = a->x[axis], y = b->x[axis];
    int sign_x = (x > 0) - (x < 0), sign_y = (y > 0) - (y < 0);
    if (sign_x != sign_y) { return sign_x < sign_y ? -1 : 1; }
    mesh_uint128_t left[2], right[2];
    multiply(magnitude(x), (mesh_uint128_t)b->w, left);
    multiply(magnitude(y), (mesh_uint128_t)a->w, right);
    int order = left[1] != right[1] ? (left[1] < right[1] ? -1 : 1) : (left[0] > right[0]) - (left[0] < right[0]);
    return sign_x < 0 ? -order : order;
}

int exact_order(const exact_point_t *a, const exact_point_t *b, int axis) {
    double off = a->at[axis] - b->at[axis];
    if (fabs(off) > 0x1p-33) { return off < 0 ? -1 : 1; }
    return exact_order_unfiltered(a, b, axis);
}

bool exact_same(const exact_point_t *a, const exact_point_t *b) {
    return a->w == b->w && a->x[0] == b->x[0] && a->x[1] == b->x[1] && a->x[2] == b->x[2];
}

uint64_t exact_hash(const exact_point_t *point) {
    uint64_t hash = 0;
    for (int k = 0; k < 4; k++) {
        mesh_int128_t x = k < 3 ? point->x[k] : point->w;
        hash = (hash ^ (uint64_t)x) * 0x9e3779b97f4a7c15u;
        hash = (hash ^ hash >> 32 ^ (uint64_t)(x >> 64)) * 0x9e3779b97f4a7c15u;
    }
    return hash ^ hash >> 29;
}

void exact_round(const exact_point_t *point, int32_t at[3]) {
    for (int k = 0; k < 3; k++) {
        const mesh_int128_t whole = point->x[k] / point->w - (point->x[k] % point->w < 0); /* floor */
        const mesh_int128_t rest = point->x[k] - whole * point->w;                         /* 0 <= rest < w < 2^102 */
        at[k] = (int32_t)(256 * whole + (512 * rest + point->w) / (2 * point->w));
    }
}
