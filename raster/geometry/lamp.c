#include "../tune.h"

#include "lamp.h"

#include "wide.h"

/* Newton's y (3 - m y^2) / 2 from below, for m in [1, 4). Two chords, let down by half of their sag, begin within 2.3 %; three
 * steps, each 3/2 of the square of the error, leave 2^-37 and the roundings. */
uint32_t lamp_inverse_root(uint64_t x, unsigned *half) {
    const unsigned n = fixed_clz64(x) & ~1u;
    const uint32_t m = (uint32_t)((x << n) >> 32); /* Q2.30 */
    uint32_t y = m < 0x80000000u ? 2735864235u - (uint32_t)((uint64_t)m * 1257966796u >> 31)
                                 : 1934548153u - (uint32_t)((uint64_t)m * 444758426u >> 31);
    for (unsigned i = 0; i < 3; i++) {
        const uint32_t square = (uint32_t)((uint64_t)y * y >> 32);       /* Q.30 */
        const uint32_t product = (uint32_t)((uint64_t)m * square >> 30); /* Q.30, near 1 */
        y = (uint32_t)((uint64_t)y * (3u * (UINT32_C(1) << 30) - product) >> 31);
    }
    *half = n / 2;
    return y;
}

/* v / |v| in Q.20; false for the zero vector. |v[i]| < 2^63. */
static bool unit_of(const int64_t v[3], int32_t unit[3]) {
    uint64_t all = 0, sum = 0;
    unsigned half;
    int32_t scaled[3];
    for (unsigned i = 0; i < 3; i++) {
        all |= (uint64_t)(v[i] < 0 ? -v[i] : v[i]);
    }
    if (all == 0) { return false; }
    const int up = (int)fixed_clz64(all) - 40; /* 24 bits */
    for (unsigned i = 0; i < 3; i++) {
        scaled[i] = (int32_t)(up >= 0 ? fixed_shift_left64(v[i], (unsigned)up) : v[i] >> -up);
        sum += (uint64_t)((int64_t)scaled[i] * scaled[i]);
    }
    const uint32_t root = lamp_inverse_root(sum, &half);
    for (unsigned i = 0; i < 3; i++) {
        unit[i] = (int32_t)(((int64_t)scaled[i] * root >> (41 - half)) + 1) >> 1;
    }
    return true;
}

/* ---- an instance ---- */

static void lamp_colour(lamp_t *lamp, const tuile_light_t *light) {
    const bool white = (light->colour[0] | light->colour[1] | light->colour[2]) == 0;
    lamp->greatest = 0;
    for (unsigned c = 0; c < 3; c++) {
        lamp->colour[c] = (uint16_t)(((white ? 255u : light->colour[c]) * light->intensity * 256u + 127u) / 255u);
        if (lamp->colour[c] > lamp->greatest) { lamp->greatest = lamp->colour[c]; }
    }
}

static bool lamp_directional(lamp_t *lamp, const tuile_light_t *light, const tuile_pose_t *pose) {
    int64_t way[3];
    for (unsigned j = 0; j < 3; j++) {
        way[j] = 0;
        for (unsigned k = 0; k < 3; k++) {
            way[j] -= (int64_t)pose->rotation[k][j] * light->direction[k];
        }
    }
    lamp->point = false;
    return unit_of(way, lamp->toward);
}

static bool lamp_at_point(lamp_t *lamp, const tuile_light_t *light, const tuile_instance_t *instance, wide_t per_step) {
    const tuile_pose_t *pose = &instance->pose;
    const wide_t range = wide_multiply(wide_make(light->range, -16), per_step);
    const int32_t shift = 30 - (wide_bits(range) + 8);
    if (shift > 36) { return false; } /* reaches 2^-14 step: no vertex but one that is the light itself */
    const int64_t most = ((int64_t)1 << 30) - 1, exact = wide_to_integer(range, shift + 8);
    lamp->point = true;
    lamp->shift = (int16_t)shift;
    lamp->range = (uint32_t)(exact > most ? most : exact);
    lamp->per_range = (uint32_t)(((uint64_t)1 << 48) / ((uint64_t)lamp->range * lamp->range >> 28));
    for (unsigned j = 0; j < 3; j++) {
        wide_t sum = {0, 0};
        for (unsigned k = 0; k < 3; k++) {
            const wide_t distance = wide_make((int64_t)light->position[k] - pose->translation[k], -16);
            sum = wide_add(sum, wide_multiply(wide_make(pose->rotation[k][j], -30), distance));
        }
        sum = wide_add(wide_multiply(sum, per_step), wide_make(-(int64_t)instance->model->offset[j], 0));
        lamp->at[j] = wide_to_integer(sum, shift + 8);
    }
    return true;
}

void lamps_make(lamps_t *lamps, const tuile_scene_t *scene, const tuile_instance_t *instance, const transform_t *transform) {
    const uint8_t *colour = scene->ambient_colour;
    const bool white = (colour[0] | colour[1] | colour[2]) == 0;
    const wide_t per_step = wide_reciprocal(wide_multiply(wide_scale(instance->model->step), wide_scale(instance->pose.scale)));
    lamps->perspective = transform->perspective;
    lamps->eye_bits = transform->observer_bits;
    for (unsigned c = 0; c < 3; c++) {
        lamps->ambient[c] = (scene->ambient * (white ? 255u : colour[c]) * 65536u + 127u) / 255u;
        lamps->eye[c] = transform->observer[c];
    }
    if (!lamps->perspective) {
        const int64_t way[3] = {lamps->eye[0], lamps->eye[1], lamps->eye[2]};
        (void)unit_of(way, lamps->eye);
    }
    lamps->count = 0;
    for (unsigned l = 0; l < scene->light_count; l++) {
        const tuile_light_t *light = &scene->lights[l];
        lamp_t *lamp = &lamps->lamp[lamps->count];
        const bool seen = light->kind == TUILE_LIGHT_POINT ? lamp_at_point(lamp, light, instance, per_step)
                                                           : lamp_directional(lamp, light, &instance->pose);
        lamp_colour(lamp, light);
        lamps->count = (uint16_t)(lamps->count + (seen && lamp->greatest > 0));
    }
}

/* ---- a point ---- */

/* a * 2^up, cut where it is made smaller. |a| <= 2^24, up <= 38. */
TUILE_INLINE int64_t scaled_by(int32_t a, int up) {
    return up >= 0 ? fixed_shift_left64(a, (unsigned)up) : a >> (up < -30 ? 30 : -up);
}

/* The way to a lamp and its falloff in 1/65536, 65535 at most; false where it does not reach. */
static bool lamp_reaches(const lamp_t *lamp, const int32_t at[3], int32_t toward[3], uint32_t *falloff) {
    const int64_t range = lamp->range;
    uint64_t distance2 = 0;
    int64_t way[3];
    for (unsigned i = 0; i < 3; i++) {
        way[i] = lamp->at[i] - scaled_by(at[i], lamp->shift);
        if (way[i] >= range || way[i] <= -range) { return false; }
        distance2 += (uint64_t)(way[i] * way[i]);
    }
    const uint64_t range2 = (uint64_t)(range * range); /* below 2^60 */
    if (distance2 >= range2 || !unit_of(way, toward)) { return false; }
    uint32_t part = (uint32_t)((((range2 - distance2) >> 28) * lamp->per_range) >> 32);
    if (part > 65535) { part = 65535; }
    *falloff = part * part >> 16;
    return true;
}

/* What N . H is made from. */
typedef struct lamp_shine {
    int32_t eye[3]; /* the way to it, Q.20 */
    uint32_t root;  /* of the normal's square */
    unsigned half;
    int8_t shininess;
} lamp_shine_t;

static bool shine_open(const lamps_t *lamps, const lamp_point_t *point, lamp_shine_t *shine) {
    const int8_t *n = point->normal;
    const uint32_t square = (uint32_t)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (point->shininess < 0 || square == 0) { return false; }
    shine->shininess = point->shininess;
    shine->root = lamp_inverse_root(square, &shine->half);
    int64_t way[3];
    for (unsigned i = 0; i < 3; i++) {
        way[i] = lamps->eye[i];
        shine->eye[i] = lamps->eye[i];
        if (lamps->perspective) { way[i] -= scaled_by(point->at[i], lamps->eye_bits - 8); }
    }
    return !lamps->perspective || unit_of(way, shine->eye);
}

/* (N . H)^(2^shininess), Q.30. sign: -1 for the back of the normal. */
static uint32_t shine_power(const lamp_shine_t *shine, const int8_t normal[3], int32_t sign, const int32_t toward[3]) {
    uint64_t square = 0;
    int64_t dot = 0;
    unsigned half;
    for (unsigned i = 0; i < 3; i++) {
        const int32_t h = toward[i] + shine->eye[i]; /* <= 2^21 */
        square += (uint64_t)((int64_t)h * h);
        dot += (int64_t)h * normal[i] * sign;
    }
    if (dot <= 0 || square == 0) { return 0; }
    const uint32_t root = lamp_inverse_root(square, &half);
    const uint64_t across = (uint64_t)dot * root >> (40 - half); /* |N| (N . H), Q.22: below 2^30 */
    uint64_t c = across * shine->root >> (54 - shine->half);
    if (c > UINT32_C(1) << 30) { c = UINT32_C(1) << 30; }
    for (int i = 0; i < shine->shininess; i++) {
        c = (c * c + (UINT32_C(1) << 29)) >> 30;
    }
    return (uint32_t)c;
}

#define LIGHT_ENOUGH (UINT32_C(256) << 16)

static void sum_up(uint32_t *sum, uint32_t part) {
    *sum += part;
    if (*sum > LIGHT_ENOUGH) { *sum = LIGHT_ENOUGH; }
}

void lamps_light(const lamps_t *lamps, const lamp_point_t *point, uint8_t light[4]) {
    uint32_t sum[4] = {lamps->ambient[0], lamps->ambient[1], lamps->ambient[2], 0};
    const int8_t *n = point->normal;
    lamp_shine_t shine;
    const bool shines = shine_open(lamps, point, &shine);
    for (const lamp_t *lamp = lamps->lamp, *end = lamp + lamps->count; lamp != end; lamp++) {
        int32_t way[3];
        const int32_t *toward = lamp->toward;
        uint32_t falloff = 65536;
        if (lamp->point) {
            if (!lamp_reaches(lamp, point->at, way, &falloff)) { continue; }
            toward = way;
        }
        int32_t dot = n[0] * toward[0] + n[1] * toward[1] + n[2] * toward[2], sign = 1; /* Q.20 * 127, below 2^29 */
        if (dot < 0 && point->both_sides) {
            dot = -dot;
            sign = -1;
        }
        if (dot <= 0) { continue; }
        /* 1/32768; a normal is 222 long at most, so below 57300 */
        const uint32_t part = (uint32_t)((uint64_t)(((uint32_t)dot + 2032u) / 4064u) * falloff >> 16);
        for (unsigned c = 0; c < 3; c++) {
            sum_up(&sum[c], lamp->colour[c] * part >> 7);
        }
        if (shines) {
            const uint64_t power = (uint64_t)shine_power(&shine, n, sign, toward) * falloff >> 16;
            sum_up(&sum[3], (uint32_t)((uint64_t)lamp->greatest * power >> 22));
        }
    }
    for (unsigned c = 0; c < 4; c++) {
        const uint32_t level = (sum[c] + 32768u) >> 16;
        light[c] = (uint8_t)(level > 255 ? 255 : level);
    }
}
