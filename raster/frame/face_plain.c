/* The loop that most faces go through. No vertex of the cluster is outside of the region, so that no face of it need be compared
 * with that, and there is room for the records of all of them, so that no record need be compared with that.
 */
#include "../tune.h"

#include "../assembly.h"
#include "face.h"
#include "face_thumb.h"

static bool is_plain(const tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    return cluster->bytes[CLUSTER_AT_KIND] == MODEL_CLUSTER_TRIANGLES && !cluster->any_beyond && t->sides == SIDE_FRONT &&
           !t->immediate && !(TUILE_HAS(LIGHTS) && t->careful) && t->record_count + count < UINT16_MAX - 1 &&
           (size_t)count * t->record_bytes <=
               (size_t)(t->arena_end - (uint8_t *)(t->vertices + t->vertex_count)) - (size_t)t->record_count * t->record_bytes;
}

/* The bucket that is being filled: neighbouring faces mostly start in the same row of tiles. */
typedef struct face_bucket {
    uint16_t *list;
    uint32_t top; /* pixel row */
} face_bucket_t;

TUILE_INLINE void bucket_at(const tuile_t *t, face_bucket_t *bucket, uint32_t row) {
    const uint32_t height = t->config.tile_height;
    if (TUILE_LIKELY(row - bucket->top < height)) { return; }
    const uint32_t number = row / height;
    bucket->list = &t->buckets[number];
    bucket->top = number * height;
}

/* flat, bytes of a record and columns are constants where it matters. columns: a face without columns is left out. They are one in
 * sixty, for which the z-buffer does not ask: such a face is soon drawn there, but other methods keep it among the rest. surface: a
 * larger record is a surface's, of light at the vertices. */
TUILE_INLINE void bin_plain(tuile_t *t, const frame_cluster_t *cluster, unsigned count, bool flat, uint32_t bytes, bool columns,
                            bool surface) {
    const vertex_t *const v = cluster->vertices;
    const uint32_t base = (uint32_t)(v - t->vertices), before = t->record_count;
    const uint8_t material_base = (uint8_t)t->material_base;
    const vertex_sun_t sun = vertex_sun(&t->transform);
    const bool larger = bytes != sizeof(record_t);
    const uint16_t source = t->source;
    const int8_t *normal = cluster->face_normals;
    uint8_t *at = t->arena_end - (size_t)(before + 1) * bytes;
    face_bucket_t bucket = {&t->buckets[t->pass_first], (uint32_t)t->pass_first * t->config.tile_height};
    uint32_t number = before, degenerate = 0, outside = 0, longest = 0;

    for (const uint8_t *face = cluster->faces, *const end = face + (size_t)4 * count; face != end; face += 4) {
        uint32_t a = face[0], b = face[1], c = face[2];
        const int32_t xa = v[a].x, xb = v[b].x, xc = v[c].x;
        int32_t ya = v[a].y, yb = v[b].y, yc = v[c].y;
        const int32_t xab = xb - xa, xac = xc - xa, area = xac * (yb - ya) - xab * (yc - ya);
        const int8_t *const n = normal;
        if (flat) { normal += 3; }
        if (area <= 0) {
            if (TUILE_UNLIKELY(area == 0)) { degenerate++; }
            continue;
        }
        /* The topmost corner becomes the first; the order round the face stays. */
        if (yb < ya && yb <= yc) {
            const uint32_t first = a;
            const int32_t y = ya;
            a = b, b = c, c = first;
            ya = yb, yb = yc, yc = y;
        } else if (yc < ya) {
            const uint32_t last = c;
            const int32_t y = yc;
            c = b, b = a, a = last;
            yc = yb, yb = ya, ya = y;
        }
        const int32_t bottom = yb > yc ? yb : yc, row = edge_row(ya);
        if (row >= edge_row(bottom) || (columns && edge_row(least3(xa, xb, xc)) >= edge_row(most3(xa, xb, xc)))) {
            outside++;
            continue;
        }
        /* Two sides within half of SHORT_SIDE, a power of two: so the third is within it. */
        longest |= (uint32_t)(xab + SHORT_SIDE / 2) | (uint32_t)(xac + SHORT_SIDE / 2) | (uint32_t)(bottom - ya);
        record_t *record = (record_t *)(void *)at;
        at -= bytes;
        record->v0 = (uint16_t)(base + a);
        record->d1 = (int8_t)(b - a);
        record->d2 = (int8_t)(c - a);
        record->material = (uint8_t)(face[3] + material_base);
        record->light = flat ? vertex_sun_light(&t->transform, &sun, n) : 0;
        bucket_at(t, &bucket, (uint32_t)row);
        record->next = *bucket.list;
        *bucket.list = (uint16_t)++number;
        if (larger && surface) {
            record_surface_t *extended = frame_record_surface(record);
            extended->source = source;
            extended->green = extended->blue = record->light;
        } else if (larger) {
            face_extend(t, record, cluster->first_face + (uint32_t)(face - cluster->faces) / 4);
        }
    }
    face_binned(t, count, number, degenerate, outside, longest);
}

static TUILE_NOINLINE void bin_flat(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    bin_plain(t, cluster, count, true, sizeof(record_t), false, false);
}

static TUILE_NOINLINE void bin_smooth(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    bin_plain(t, cluster, count, false, sizeof(record_t), false, false);
}

static TUILE_NOINLINE void bin_any(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    bin_plain(t, cluster, count, cluster->face_normals != NULL, t->record_bytes, t->config.method != TUILE_ZBUFFER, false);
}

static TUILE_NOINLINE void bin_smooth_surface(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    bin_plain(t, cluster, count, false, sizeof(record_surface_t), false, true);
}

bool face_bin_plain(tuile_t *t, const frame_cluster_t *cluster, unsigned count) {
    if (!is_plain(t, cluster, count)) { return false; }
    if (ASSEMBLY_FACES && face_thumb(t, cluster, count)) { return true; }
    if (FIXED_WIDE_REGISTERS && t->config.method == TUILE_ZBUFFER && t->numbers && !cluster->face_normals) {
        bin_smooth_surface(t, cluster, count);
    } else if (ASSEMBLY_FACES || t->config.method != TUILE_ZBUFFER ||
               t->record_bytes != sizeof(record_t)) { /* there what is rare */
        bin_any(t, cluster, count);
    } else if (cluster->face_normals) {
        bin_flat(t, cluster, count);
    } else {
        bin_smooth(t, cluster, count);
    }
    return true;
}
