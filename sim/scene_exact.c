/* Integers as wide as the numbers of a text scene can make them, and the plane of a polygon in them. */
#include "scene_exact.h"

/* ---- wide integers ---------------------------------------------------------------------------------------- */

/* Sign and magnitude. Whether a vertex lies on a plane is the sign of a determinant of differences of fractions. With numerators
 * and denominators below 2^63 a difference times its common denominators is below 2^(127 + 252), the determinant, a sum of six
 * products of three, below 2^(3 * 379 + 3) = 2^1140. 40 limbs hold 2^1280. */
enum { WIDE_LIMBS = 40 };

typedef struct wide {
    int sign;  /* -1, 0, 1 */
    int count; /* limbs in use; the highest is not 0 */
    uint32_t limb[WIDE_LIMBS];
} wide_t;

static wide_t wide_from(int64_t value) {
    wide_t w = {.sign = (value > 0) - (value < 0)};
    uint64_t magnitude = value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
    for (; magnitude; magnitude >>= 32) {
        w.limb[w.count++] = (uint32_t)magnitude;
    }
    return w;
}

static int wide_compare_magnitude(const wide_t *a, const wide_t *b) {
    if (a->count != b->count) { return a->count < b->count ? -1 : 1; }
    for (int i = a->count - 1; i >= 0; i--) {
        if (a->limb[i] != b->limb[i]) { return a->limb[i] < b->limb[i] ? -1 : 1; }
    }
    return 0;
}

static wide_t wide_multiply(const wide_t *a, const wide_t *b) {
    wide_t product = {.sign = a->sign * b->sign};
    for (int i = 0; i < a->count; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < b->count || carry; j++) {
            uint64_t sum = product.limb[i + j] + carry + (j < b->count ? (uint64_t)a->limb[i] * b->limb[j] : 0);
            product.limb[i + j] = (uint32_t)sum;
            carry = sum >> 32;
        }
    }
    product.count = a->count + b->count;
    while (product.count > 0 && product.limb[product.count - 1] == 0) {
        product.count--;
    }
    return product;
}

static wide_t wide_subtract(const wide_t *a, const wide_t *b) {
    if (b->sign == 0) { return *a; }
    int order = wide_compare_magnitude(a, b);
    if (a->sign != b->sign) { /* magnitudes add */
        wide_t sum = {.sign = -b->sign};
        int count = a->count > b->count ? a->count : b->count;
        uint64_t carry = 0;
        for (int i = 0; i < count || carry; i++) {
            carry += (uint64_t)a->limb[i] + b->limb[i];
            sum.limb[i] = (uint32_t)carry;
            carry >>= 32;
            sum.count = i + 1;
        }
        return sum;
    }
    if (order == 0) { return (wide_t){0}; }
    const wide_t *large = order > 0 ? a : b, *small = order > 0 ? b : a;
    wide_t difference = {.sign = a->sign * order};
    int64_t borrow = 0;
    for (int i = 0; i < large->count; i++) {
        int64_t digit = (int64_t)large->limb[i] - small->limb[i] - borrow;
        borrow = digit < 0;
        difference.limb[i] = (uint32_t)(digit + (borrow << 32));
        if (difference.limb[i]) { difference.count = i + 1; }
    }
    return difference;
}

static wide_t wide_multiply_int(wide_t a, int64_t b) {
    wide_t factor = wide_from(b);
    return wide_multiply(&a, &factor);
}

/* ---- exact vectors ---------------------------------------------------------------------------------------- */

typedef struct wide_vector {
    wide_t at[3];
} wide_vector_t;

/* (to - from) times a positive number that makes it whole. */
static wide_vector_t vector_between(const scene_number_t from[3], const scene_number_t to[3]) {
    wide_vector_t vector;
    for (int i = 0; i < 3; i++) {
        wide_t a = wide_multiply_int(wide_from(to[i].numerator), from[i].denominator);
        wide_t b = wide_multiply_int(wide_from(from[i].numerator), to[i].denominator);
        vector.at[i] = wide_subtract(&a, &b);
        for (int k = 0; k < 3; k++) {
            if (k != i) {
                vector.at[i] = wide_multiply_int(wide_multiply_int(vector.at[i], from[k].denominator), to[k].denominator);
            }
        }
    }
    return vector;
}

static bool vector_is_zero(const wide_vector_t *v) { return v->at[0].sign == 0 && v->at[1].sign == 0 && v->at[2].sign == 0; }

static wide_vector_t vector_cross(const wide_vector_t *a, const wide_vector_t *b) {
    wide_vector_t cross;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        wide_t plus = wide_multiply(&a->at[j], &b->at[k]), minus = wide_multiply(&a->at[k], &b->at[j]);
        cross.at[i] = wide_subtract(&plus, &minus);
    }
    return cross;
}

static int vector_dot_sign(const wide_vector_t *a, const wide_vector_t *b) {
    wide_t sum = {0};
    for (int i = 0; i < 3; i++) {
        wide_t term = wide_multiply(&a->at[i], &b->at[i]);
        term.sign = -term.sign;
        sum = wide_subtract(&sum, &term);
    }
    return sum.sign;
}

/* Numbers are in lowest terms, so equal numbers have equal parts. */
static bool same_vertex(const scene_number_t a[3], const scene_number_t b[3]) {
    for (int i = 0; i < 3; i++) {
        if (a[i].numerator != b[i].numerator || a[i].denominator != b[i].denominator) { return false; }
    }
    return true;
}

scene_polygon_t scene_polygon_check(const scene_number_t (*v)[3], size_t count, size_t plane[3], size_t *off) {
    size_t second = 1;
    while (second < count && same_vertex(v[0], v[second])) {
        second++;
    }
    size_t third = second;
    while (third < count && (same_vertex(v[0], v[third]) || same_vertex(v[second], v[third]))) {
        third++;
    }
    if (third >= count) { return SCENE_POLYGON_FEW; }

    wide_vector_t along = vector_between(v[0], v[second]), normal = {0};
    for (; third < count; third++) {
        wide_vector_t other = vector_between(v[0], v[third]);
        normal = vector_cross(&along, &other);
        if (!vector_is_zero(&normal)) { break; }
    }
    if (third == count) { return SCENE_POLYGON_LINE; }
    plane[0] = 0;
    plane[1] = second;
    plane[2] = third;
    for (size_t k = third + 1; k < count; k++) {
        wide_vector_t other = vector_between(v[0], v[k]);
        if (vector_dot_sign(&normal, &other) != 0) {
            *off = k;
            return SCENE_POLYGON_BENT;
        }
    }
    return SCENE_POLYGON_GOOD;
}
