/* vertex_thumb against the C of geometry/vertex.c, byte by byte: random rows, octaves, regions and lights of all sizes, positions
 * in and beyond the cluster's sphere.
 */
#include "twins.h"

#include "../../raster/geometry/model.h"
#include "../../raster/geometry/vertex_thumb.h"
#include "../support/random.h"

unsigned c_vertex_stage_region(transform_t *transform, const uint8_t *cluster, const int16_t *positions, const int8_t *normals,
                               unsigned count, vertex_t *out);
bool c_vertex_stage(const transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out);
unsigned __real_vertex_thumb(transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out,
                             const vertex_octave_t *octave);
unsigned __wrap_vertex_thumb(transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out,
                             const vertex_octave_t *octave);

/* Clusters that the assembly was called for, those of two octaves, and whether the last one was. */
static unsigned called, seconds;
static bool second;

unsigned __wrap_vertex_thumb(transform_t *transform, const int16_t *positions, const int8_t *normals, unsigned count, vertex_t *out,
                             const vertex_octave_t *octave) {
    called++;
    seconds += second = octave->second;
    return __real_vertex_thumb(transform, positions, normals, count, out, octave);
}

enum { ROUNDS = 6000, VERTICES = 24, ROOM = VERTICES + 2 };

static int32_t any32(random_source_t *random, unsigned bits) { return (int32_t)random_any_size(random, bits); }

static transform_row_t random_row(random_source_t *random, unsigned bits, unsigned t_bits) {
    transform_row_t row = {.t = random_any_size(random, t_bits)};
    for (int i = 0; i < 3; i++) {
        row.m[i] = any32(random, bits);
        row.low[i] = (int16_t)any32(random, 13);
    }
    return row;
}

/* Coarse values below 2^30 at positions that are off by less than 2^bits along each axis, or anywhere, where bits is 16. */
static transform_row_t random_bounded_row(random_source_t *random, const int16_t centre[3], unsigned bits) {
    const bool anywhere = bits == 16;
    const int32_t most = anywhere ? 29 : 44 - (int32_t)bits;
    transform_row_t row =
        random_row(random, (unsigned)random_between(random, 1, most < 31 ? most : 31), (unsigned)random_between(random, 1, 44));
    for (int i = 0; i < 3 && !anywhere; i++) {
        row.t -= (int64_t)row.m[i] * centre[i];
    }
    return row;
}

/* A transform whose W is w at the middle of the cluster, and may be in one octave all over it. */
static transform_t random_transform(random_source_t *random, const int16_t centre[3], unsigned reach_bits) {
    transform_t transform = {.perspective = true};
    const unsigned bits = (unsigned)random_between(random, 4, 31), zeros = 31 - bits + 1;
    const int32_t low = (int32_t)(1u << (bits - 1)),
                  w = low + (int32_t)(random_bits(random) % (uint32_t)(random_one_in(random, 4) ? low / 8 + 1 : low));
    const unsigned slope = reach_bits == 15 ? bits : (unsigned)random_between(random, 1, (int32_t)bits);
    int64_t sum = (int64_t)w * 65536 + random_between(random, 0, 65535);
    transform.w = random_row(random, slope, 1);
    uint64_t steepest = UINT16_MAX;
    for (int i = 0; i < 3; i++) {
        sum -= (int64_t)transform.w.m[i] * centre[i];
        steepest += (uint32_t)(transform.w.m[i] < 0 ? -transform.w.m[i] : transform.w.m[i]);
    }
    transform.w_slope = (uint32_t)(steepest >> 16);
    transform.w.t = sum;
    transform.w_high = INT64_C(1) << 46;
    if (w < INT32_MAX / 2 && random_one_in(random, 3)) { transform.w_high = (int64_t)(w + w / 2) * 65536; }
    transform.w_fast = random_one_in(random, 2) ? 1 : low + (w - low) / 2;
    transform.x = random_bounded_row(random, centre, reach_bits);
    transform.y = random_bounded_row(random, centre, reach_bits);
    transform.k = (int8_t)random_between(random, 0, zeros < 28 ? 28 - (int32_t)zeros : 0);
    transform.depth_shift = (int8_t)((int32_t)zeros + random_between(random, 6, 22));
    transform.region_x = (int16_t)any32(random, 15);
    transform.region_y = (int16_t)any32(random, 15);
    transform.region_width = (uint16_t)any32(random, 16);
    transform.region_height = (uint16_t)any32(random, 16);
    transform.guard_x = any32(random, 16);
    transform.guard_y = any32(random, 16);
    transform.ambient = (uint8_t)random_between(random, LIGHT_MIN, LIGHT_MAX);
    transform.light_count = !random_one_in(random, 8);
    for (int i = 0; i < 3 && transform.light_count; i++) {
        transform.lights[0][i] = (int16_t)(random_one_in(random, 8) ? (random_one_in(random, 2) ? 16512 : -16512)
                                                                    : random_between(random, -16512, 16512));
    }
    return transform;
}

/* Puts an edge of the region, or of the guard band, next to the first vertex that is not outside. */
static void put_edge(random_source_t *random, transform_t *transform, const vertex_t *vertices, unsigned count) {
    static const int16_t steps[4] = {-1, 0, 1, 2};
    while (count && vertices->x == VERTEX_OUTSIDE) {
        vertices++, count--;
    }
    if (!count) { return; }
    const int32_t step = steps[random_bits(random) % 4];
    switch (random_bits(random) % 8) {
    case 0: transform->region_x = (int16_t)(vertices->x + step); break;
    case 1: transform->region_y = (int16_t)(vertices->y + step); break;
    case 2: transform->region_width = (uint16_t)(vertices->x - transform->region_x + step); break;
    case 3: transform->region_height = (uint16_t)(vertices->y - transform->region_y + step); break;
    case 4: transform->guard_x = vertices->x - GUARD_MARGIN + step; break;
    case 5: transform->guard_y = vertices->y - GUARD_MARGIN + step; break;
    case 6: transform->guard_x = vertices->x - (GUARD_SPAN - GUARD_MARGIN) + step; break;
    default: transform->guard_y = vertices->y - (GUARD_SPAN - GUARD_MARGIN) + step; break;
    }
}

/* All upper halves that a W of 32 bits has, so that each reciprocal that tables lead to is made; depths show its lower 24 bits. */
static bool halves_test(random_source_t *random) {
    enum { ZEROS = 5, ROW = 128, STEP = 1 << (32 - 16 - ZEROS) };
    const vertex_octave_t octave = {.zeros = ZEROS, .shift = 25, .half = 1 << 24};
    for (int32_t half = 1 << 15; half < 1 << 16; half += ROW) {
        int16_t positions[3 * ROW] = {0};
        vertex_t assembly[ROW], c[ROW];
        transform_t transform = {.perspective = true,
                                 .depth_shift = ZEROS,
                                 .w_fast = 1,
                                 .w_high = INT64_C(1) << 46,
                                 .guard_x = -GUARD_SPAN / 2,
                                 .guard_y = -GUARD_SPAN / 2};
        transform.w.m[0] = STEP * 65536;
        transform.w.t = ((int64_t)half * STEP + random_between(random, 0, STEP - 1)) * 65536;
        for (int i = 0; i < ROW; i++) {
            positions[3 * i] = (int16_t)i;
        }
        vertex_thumb_make(&transform);
        (void)__real_vertex_thumb(&transform, positions, NULL, ROW, assembly, &octave);
        (void)c_vertex_stage(&transform, positions, NULL, ROW, c);
        if (c[0].x == VERTEX_OUTSIDE || !twins_equal("halves", assembly, c, sizeof c)) { return false; }
    }
    return true;
}

bool twins_test(void) {
    random_source_t random = random_seed(77);
    if (!halves_test(&random)) { return false; }
    unsigned within = 0, beyond = 0, outside = 0, dark = 0, bright = 0;
    for (int round = 0; round < ROUNDS; round++) {
        int16_t positions[3 * VERTICES + 1], centre[3];
        int8_t normals[3 * VERTICES];
        uint8_t cluster[MODEL_CLUSTER_BYTES] = {0};
        vertex_t assembly[ROOM], c[ROOM];
        const unsigned count = (unsigned)random_between(&random, 1, VERTICES),
                       reach_bits = random_one_in(&random, 6) ? 15 : (unsigned)random_between(&random, 0, 15);
        const bool damaged = random_one_in(&random, 8), lit = !random_one_in(&random, 3);
        int16_t *const first = positions + random_between(&random, 0, 1); /* 4-byte aligned, and not */
        for (int i = 0; i < 3; i++) {
            centre[i] = (int16_t)any32(&random, 15);
            cluster[CLUSTER_AT_CENTRE + 2 * i] = (uint8_t)centre[i];
            cluster[CLUSTER_AT_CENTRE + 2 * i + 1] = (uint8_t)((uint16_t)centre[i] >> 8);
        }
        cluster[CLUSTER_AT_RADIUS] = (uint8_t)(1u << reach_bits);
        cluster[CLUSTER_AT_RADIUS + 1] = (uint8_t)(1u << reach_bits >> 8);
        for (unsigned i = 0; i < 3 * count; i++) {
            const int32_t at = damaged ? any32(&random, 15) : centre[i % 3] + any32(&random, reach_bits);
            first[i] = (int16_t)(at < INT16_MIN ? INT16_MIN : at > INT16_MAX ? INT16_MAX : at);
            normals[i] = (int8_t)random_bits(&random);
        }
        if (random_one_in(&random, 4)) { /* a corner of what the radius tells */
            for (unsigned i = 0; i < 3; i++) {
                const int32_t at = centre[i] + (random_one_in(&random, 2) ? 1 : -1) * (int32_t)(1u << reach_bits);
                first[i] = (int16_t)(at < INT16_MIN ? INT16_MIN : at > INT16_MAX ? INT16_MAX : at);
            }
        }
        transform_t transform = random_transform(&random, centre, damaged ? 16 : reach_bits);
        const int8_t *const light = lit ? normals : NULL;
        if (random_one_in(&random, 2)) {
            (void)c_vertex_stage_region(&transform, cluster, first, light, count, c);
            put_edge(&random, &transform, c, count);
        }
        for (unsigned i = 0; i < ROOM; i++) {
            assembly[i] = c[i] = (vertex_t){(int16_t)(i + 1), 2, 3};
        }
        vertex_thumb_make(&transform);
        const unsigned before = called;
        second = false;
        const unsigned any = vertex_stage_region(&transform, cluster, first, light, count, assembly);
        const unsigned wanted = c_vertex_stage_region(&transform, cluster, first, light, count, c);
        if (second && damaged) { continue; } /* any picture will do */
        if (any != wanted || !twins_equal("vertices", assembly, c, sizeof c)) {
            twins_tell("round ", (int32_t)round, " of ", (int32_t)count, " vertices: any is ", (int32_t)any, ", in C ",
                       (int32_t)wanted, NULL);
            return false;
        }
        if (called == before) { continue; }
        within += any == 0;
        beyond += any == VERTEX_ANY_BEYOND;
        outside += any & VERTEX_ANY_OUTSIDE;
        for (unsigned i = 0; i < count && lit; i++) {
            dark += (uint8_t)assembly[i].depth_light == transform.ambient;
            bright += (uint8_t)assembly[i].depth_light == LIGHT_MAX;
        }
    }
    twins_tell("vertices: clusters in assembly ", (int32_t)called, ", of two octaves ", (int32_t)seconds, ", within ",
               (int32_t)within, ", beyond ", (int32_t)beyond, ", outside ", (int32_t)outside, ", dark ", (int32_t)dark, ", bright ",
               (int32_t)bright, NULL);
    return called > ROUNDS / 4 && (!ASSEMBLY_THUMB1 || seconds > 200) && within > 100 && beyond > 100 && outside > 100 &&
           dark > 100 && bright > 100;
}
