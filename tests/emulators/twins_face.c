/* face_thumb against the C of frame/face_plain.c: random clusters in strips of all heights, faces small, large and flat as a line,
 * both shadings, records of both sizes. Records, buckets and figures must be the same to the byte.
 */
#include "twins.h"

#include "../../raster/frame/face_thumb.h"
#include "../../raster/memory.h"
#include "../support/random.h"

bool c_face_bin_plain(tuile_t *t, const frame_cluster_t *cluster, unsigned count);
bool __real_face_thumb(tuile_t *t, const frame_cluster_t *cluster, unsigned count);
bool __wrap_face_thumb(tuile_t *t, const frame_cluster_t *cluster, unsigned count);

/* Clusters that the assembly took. */
static unsigned taken;

bool __wrap_face_thumb(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    const bool took = __real_face_thumb(t, cluster, count);
    taken += took;
    return took;
}

void frame_lights_flat(const tuile_t *t, record_surface_t *surface) {
    (void)t, (void)surface;
} /* nobody calls it: no coloured light */

enum { ROUNDS = 4000, FACES = 60, VERTICES = 128, ROWS = 64, BEFORE = 400, RECORDS = 5 + FACES + 8 };

typedef struct side {
    tuile_t t;
    uint16_t buckets[ROWS];
    _Alignas(8) vertex_t vertices[BEFORE + VERTICES];
    _Alignas(8) uint8_t records[RECORDS * sizeof(record_surface_t)];
} side_t;

static side_t assembly, c;
static uint8_t faces[4 * FACES];
static int8_t normals[3 * FACES];

static int32_t within(int32_t a, int32_t low, int32_t high) { return a < low ? low : a > high ? high : a; }

/* Vertices in the region, around a point of it, which are far from one another or near. */
static void random_vertices(random_source_t *random, const tuile_t *t, vertex_t *vertices, unsigned count) {
    const int32_t top = t->region.top * 16 - 7, bottom = t->region.bottom * 16 + 8, right = t->region.right * 16 + 8;
    const int32_t x = random_between(random, -7, right), y = random_between(random, top, bottom);
    const unsigned bits = (unsigned)random_between(random, 2, 14);
    for (unsigned i = 0; i < count; i++) {
        vertices[i] =
            (vertex_t){(int16_t)within(x + (int32_t)random_any_size(random, bits), -7, right),
                       (int16_t)within(y + (int32_t)random_any_size(random, bits), top, bottom), (uint32_t)random_bits(random)};
        if (i && random_one_in(random, 6)) { vertices[i].y = vertices[i - 1].y; }
        if (i && random_one_in(random, 12)) { vertices[i].x = (int16_t)within(vertices[i - 1].x + (i & 1 ? 255 : 256), -7, right); }
    }
}

static void random_side(random_source_t *random, side_t *s, unsigned vertices) {
    tuile_t *const t = &s->t;
    t->config.method = TUILE_ZBUFFER;
    t->config.tile_height = (uint16_t)random_between(random, 1, 40);
    t->pass_first = (uint16_t)random_between(random, 0, 3);
    t->region =
        (transform_region_t){0, (uint16_t)(t->pass_first * t->config.tile_height), (uint16_t)random_between(random, 1, 1024),
                             (uint16_t)(random_between(random, t->pass_first + 1, ROWS - 1) * t->config.tile_height)};
    if (t->region.bottom > 1000) { t->region.bottom = 1000; }
    t->config.shade = random_one_in(random, 2) ? TUILE_FLAT : TUILE_GOURAUD;
    const bool surface = t->config.shade == TUILE_GOURAUD && random_one_in(random, 2);
    t->record_bytes = surface ? sizeof(record_surface_t) : sizeof(record_t);
    t->sides = SIDE_FRONT;
    t->small = true;
    t->source = (uint16_t)random_bits(random);
    t->material_base = (uint16_t)random_between(random, 0, 255);
    t->record_count = (uint16_t)random_between(random, 0, 5);
    t->transform.ambient = (uint8_t)random_between(random, LIGHT_MIN, LIGHT_MAX);
    t->transform.light_count = !random_one_in(random, 8);
    for (int i = 0; i < 3 && t->transform.light_count; i++) {
        t->transform.lights[0][i] = (int16_t)random_between(random, -16512, 16512);
    }
    for (unsigned i = 0; i < ROWS; i++) {
        s->buckets[i] = (uint16_t)random_bits(random);
    }
    for (unsigned i = 0; i < sizeof s->records; i++) {
        s->records[i] = (uint8_t)random_bits(random);
    }
    t->vertex_count = BEFORE + vertices;
    t->numbers = surface ? (uint16_t *)1 : NULL;
}

/* What lies in the side itself. */
static void point(side_t *s) {
    s->t.buckets = s->buckets;
    s->t.vertices = s->vertices;
    s->t.arena_end = s->records + sizeof s->records;
}

static bool run(bool (*bin)(tuile_t *, const frame_cluster_t *, unsigned), side_t *s, unsigned first, unsigned count) {
    uint8_t bytes[MODEL_CLUSTER_BYTES] = {0};
    bytes[CLUSTER_AT_KIND] = MODEL_CLUSTER_TRIANGLES;
    const frame_cluster_t cluster = {.bytes = bytes,
                                     .faces = faces,
                                     .face_normals = s->t.config.shade == TUILE_FLAT ? normals : NULL,
                                     .vertices = s->vertices + first};
    return bin(&s->t, &cluster, count);
}

static bool equal(void) {
    const bool same = twins_equal("records", assembly.records, c.records, sizeof c.records) &&
                      twins_equal("buckets", assembly.buckets, c.buckets, sizeof c.buckets) &&
                      twins_equal("figures", &assembly.t.stats, &c.t.stats, sizeof c.t.stats);
    if (assembly.t.record_count != c.t.record_count || assembly.t.small != c.t.small) {
        twins_tell("records: ", (int32_t)assembly.t.record_count, ", in C ", (int32_t)c.t.record_count,
                   "; small: ", (int32_t)assembly.t.small, ", in C ", (int32_t)c.t.small, NULL);
        return false;
    }
    return same;
}

bool twins_test(void) {
    random_source_t random = random_seed(78);
    uint32_t seen[2][2] = {{0}}, large = 0;
    tuile_stats_t sum = {0};
    for (int round = 0; round < ROUNDS; round++) {
        const unsigned vertices = (unsigned)random_between(&random, 3, VERTICES),
                       count = (unsigned)random_between(&random, 1, FACES);
        const unsigned first = (unsigned)random_between(&random, 0, BEFORE);
        memset(&assembly, 0, sizeof assembly);
        random_side(&random, &assembly, vertices);
        random_vertices(&random, &assembly.t, assembly.vertices + first, vertices);
        for (unsigned i = 0; i < count; i++) {
            for (unsigned j = 0; j < 3; j++) {
                faces[4 * i + j] = (uint8_t)random_between(&random, 0, (int32_t)vertices - 1);
                normals[3 * i + j] = (int8_t)random_bits(&random);
            }
            faces[4 * i + 3] = (uint8_t)random_bits(&random);
        }
        memcpy(&c, &assembly, sizeof c);
        point(&assembly);
        point(&c);
        const unsigned before = taken;
        const bool did = run(face_bin_plain, &assembly, first, count), wanted = run(c_face_bin_plain, &c, first, count);
        if (!did || !wanted || taken != before + 1 || !equal()) {
            twins_tell("round ", (int32_t)round, " of ", (int32_t)count, " faces, flat ", (int32_t)(c.t.config.shade == TUILE_FLAT),
                       ", bytes of a record ", (int32_t)c.t.record_bytes, ", taken ", (int32_t)(taken - before), NULL);
            return false;
        }
        seen[c.t.config.shade == TUILE_FLAT][c.t.numbers != NULL]++;
        large += !c.t.small;
        sum.faces_binned += c.t.stats.faces_binned;
        sum.faces_back += c.t.stats.faces_back;
        sum.faces_degenerate += c.t.stats.faces_degenerate;
        sum.faces_outside += c.t.stats.faces_outside;
    }
    twins_tell("faces: clusters flat ", (int32_t)seen[1][0], ", smooth ", (int32_t)seen[0][0], ", textured ", (int32_t)seen[0][1],
               ", large ", (int32_t)large, "; faces binned ", (int32_t)sum.faces_binned, ", back ", (int32_t)sum.faces_back,
               ", degenerate ", (int32_t)sum.faces_degenerate, ", outside ", (int32_t)sum.faces_outside, NULL);
    return seen[1][0] > 500 && seen[0][0] > 500 && seen[0][1] > 500 && large > 100 && large < ROUNDS - 500 &&
           sum.faces_binned > 10000 && sum.faces_back > 10000 && sum.faces_degenerate > 1000 && sum.faces_outside > 1000;
}
