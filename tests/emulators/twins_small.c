/* small_thumb_gouraud and small_thumb_flat, and what calls them, against smalls_draw of visibility/rows.h: lists of random
 * triangles of all sizes and slopes, in strips and in columns, with polygons, other materials, colours that are not made yet and
 * limits among them. Compared are the tile, the lists, the records and the counter; not the ramps, which
 * may be made for a face that is then left alone.
 */
#include "twins.h"

#include "../../raster/fill/small_thumb.h"
#include "../../raster/memory.h"
#include "../../raster/visibility/rows.h"
#include "../support/random.h"

void c_smalls_plain(tuile_t *t, walk_t *walk, uint32_t limit);
void __real_small_thumb_gouraud(small_run_t *run);
void __wrap_small_thumb_gouraud(small_run_t *run);
void __real_small_thumb_flat(small_run_t *run);
void __wrap_small_thumb_flat(small_run_t *run);

enum {
    ROUNDS = 12000,
    FACES = 12,
    SIDE = 48,         /* the largest tile */
    AROUND = 3 * SIDE, /* pixels before and behind it, which must stay as they are */
    RAMPS = 3,
    PIXELS = SIDE * SIDE + 2 * AROUND,
};

typedef struct world {
    uint16_t depth[PIXELS], colour[PIXELS];
    uint16_t ramps[RAMPS][RAMP_COLOURS], flat[RAMPS][256];
    int16_t tags[RAMPS];
    _Alignas(8) uint8_t records[FACES * sizeof(record_surface_t)]; /* the first one last */
    record_t above;                                                /* the last one of the list of those below */
    walk_t walk;
    uint32_t faces_setup;
} world_t;

static world_t world, before, assembly;
/* Faces of a list that the assembly drew. */
static uint32_t drawn;

void __wrap_small_thumb_gouraud(small_run_t *run) {
    const uint32_t before = run->count;
    __real_small_thumb_gouraud(run);
    drawn += run->count - before;
}

void __wrap_small_thumb_flat(small_run_t *run) {
    const uint32_t before = run->count;
    __real_small_thumb_flat(run);
    drawn += run->count - before;
}

/* ---- the rest of the renderer, as far as it is called ---- */

void frame_ramp_make(tuile_t *of, uint32_t material, uint32_t slot) {
    (void)of;
    world.tags[slot] = (int16_t)material;
    for (uint32_t i = 0; i < RAMP_COLOURS; i++) {
        world.ramps[slot][i] = (uint16_t)(material << 12 | (i + 1));
    }
}

/* Flat colours: materials from RAMPS on have no ramp. */
uint16_t *frame_flat_ramp(const tuile_t *of, uint32_t material) {
    return of->numbers == NULL && material < RAMPS ? world.flat[material] : NULL;
}

/* Black is among them. */
uint32_t frame_flat(const tuile_t *of, const record_t *record) {
    const uint32_t colour = record->light % 8 == 0 ? 0 : (uint32_t)record->material << 12 | record->light;
    uint16_t *const ramp = frame_flat_ramp(of, record->material);
    if (ramp) { ramp[record->light] = (uint16_t)colour; }
    return colour;
}

/* ---- cases ---- */

static vertex_t vertices[3 * FACES];
static tuile_t t;

/* What a case is drawn in; lists of columns.h are not asked for. */
static void random_tile(random_source_t *random) {
    const int32_t width = random_between(random, random_one_in(random, 2) ? 4 : 34, SIDE), height = random_between(random, 1, SIDE);
    const bool columns = random_one_in(random, 3);
    const int32_t column = columns ? random_between(random, 0, 2) : 0;
    const int32_t top = random_one_in(random, 2) ? 0 : random_between(random, 0, 1900);
    t.config.tile_width = (uint16_t)width;
    t.tile_columns = columns ? 3 : 1;
    t.tile = (raster_tile_t){.depth = world.depth + AROUND,
                             .colour = world.colour + AROUND,
                             .left = column * width,
                             .top = top,
                             .right = (column + 1) * width,
                             .bottom = top + height,
                             .stride_px = random_between(random, width, SIDE)};
}

static int32_t clamped(int64_t x, int64_t low, int64_t high) { return (int32_t)(x < low ? low : x > high ? high : x); }

static int64_t area_of(const vertex_t *v) {
    return (int64_t)(v[2].x - v[0].x) * (v[1].y - v[0].y) - (int64_t)(v[1].x - v[0].x) * (v[2].y - v[0].y);
}

/* Three corners, the first one topmost, counter-clockwise as seen, which span a row of the tile. */
static void random_triangle(random_source_t *random, vertex_t *v) {
    const raster_tile_t *tile = &t.tile;
    for (;;) {
        const int32_t size = random_one_in(random, 8) ? random_between(random, SHORT_SIDE - 64, 16 * SIDE)
                                                      : 1 << random_between(random, 1, random_one_in(random, 16) ? 14 : 9);
        const int64_t steep = (int64_t)1 << random_between(random, 0, 25);
        const int32_t x = random_between(random, 16 * tile->left - 60, 16 * tile->right + 20),
                      y = random_between(random, 16 * tile->top - 150, 16 * tile->bottom + 8);
        const int64_t z = random_between(random, (int32_t)VERTEX_DEPTH_MIN, (int32_t)VERTEX_DEPTH_MAX);
        const bool edge = random_one_in(random, 4), even = random_one_in(random, 4);
        int first = 0, last = 0;
        for (int i = 0; i < 3; i++) {
            const int64_t depth = random_one_in(random, 16)
                                      ? z + (random_one_in(random, 2) ? -1 : 1) * ((INT64_C(1) << 17) - (i & 1))
                                      : z + random_between(random, (int32_t)-steep, (int32_t)steep);
            const int32_t light =
                edge ? (random_one_in(random, 2) ? LIGHT_MIN : LIGHT_MAX) : random_between(random, LIGHT_MIN, LIGHT_MAX);
            v[i] = (vertex_t){(int16_t)clamped(x + random_between(random, 0, size), -32760, 32752),
                              (int16_t)clamped(y + random_between(random, 0, size), -32760, 32752),
                              (uint32_t)clamped(depth, VERTEX_DEPTH_MIN, VERTEX_DEPTH_MAX) << 8 | (uint32_t)light};
            if (even && i == 2) { v[2].y = v[random_bits(random) & 1].y; } /* flat above or below */
        }
        if (random_one_in(random, 12)) { /* a side at the limit of short ones */
            const int corner = random_between(random, 0, 2), next = (corner + 1) % 3, last_one = (corner + 2) % 3;
            const int32_t side = SHORT_SIDE + random_between(random, -1, 1);
            v[corner].x = (int16_t)(16 * tile->left + random_between(random, -7, 40));
            v[next].x = (int16_t)(v[corner].x + side);
            v[last_one].x = (int16_t)(v[corner].x + random_between(random, 0, side));
        }
        if (random_one_in(random, 16)) { v[1].x = (int16_t)(v[0].x < 0 ? 32752 : v[0].x > 0 ? -32760 : v[1].x); }
        if (area_of(v) < 0) {
            const vertex_t swap = v[1];
            v[1] = v[2];
            v[2] = swap;
        }
        while (v[0].y > v[1].y || v[0].y > v[2].y) {
            const vertex_t swap = v[0];
            v[0] = v[1];
            v[1] = v[2];
            v[2] = swap;
        }
        first = edge_row(v[0].y);
        last = edge_row(v[1].y > v[2].y ? v[1].y : v[2].y);
        if (area_of(v) > 0 && first < last && first < tile->bottom && last > tile->top) { return; }
    }
}

static bool is_short(const vertex_t *v) {
    for (int i = 0; i < 3; i++) {
        const int32_t x = v[i].x - v[(i + 1) % 3].x, y = v[i].y - v[(i + 1) % 3].y;
        if (x >= SHORT_SIDE || x <= -SHORT_SIDE || y >= SHORT_SIDE || y <= -SHORT_SIDE) { return false; }
    }
    return true;
}

/* It touches no column beside the tile. */
static bool is_inside(const vertex_t *v) {
    for (int i = 0; i < 3; i++) {
        if (edge_row(v[i].x) < t.tile.left || edge_row(v[i].x) > t.tile.right) { return false; }
    }
    return true;
}

static const record_t *record_before(uint32_t number) {
    return (const record_t *)(const void *)(before.records + sizeof before.records - (number + 1) * t.record_bytes);
}

/* Faces in a list, some of which is left out. In columns all triangles are short (columns.h). */
static void random_list(random_source_t *random) {
    const bool small = random_one_in(random, 2);
    uint16_t list = RECORD_NONE;
    for (uint32_t i = FACES; i-- > 0;) {
        vertex_t *v = &vertices[3 * i];
        const bool swap = random_one_in(random, 2);
        do {
            random_triangle(random, v);
        } while (((small || t.tile_columns > 1) && !is_short(v)) || (small && t.tile_columns == 1 && !is_inside(v)));
        *frame_record(&t, i) =
            (record_t){.next = list, .v0 = (uint16_t)(3 * i), .d1 = 1, .d2 = 2, .light = (uint8_t)random_bits(random)};
        frame_record(&t, i)->material = (uint8_t)(random_one_in(random, 4) ? random_between(random, 0, 5) : 1);
        if (swap) { /* the corners from the last one on */
            const vertex_t corner = v[0];
            v[0] = v[2], v[2] = corner;
            frame_record(&t, i)->v0 = (uint16_t)(3 * i + 2);
            frame_record(&t, i)->d1 = -1, frame_record(&t, i)->d2 = -2;
        }
        if (random_one_in(random, 24)) { frame_record(&t, i)->d1 = frame_record(&t, i)->d2 = 0; }
        if (!random_one_in(random, 8)) { list = (uint16_t)(i + 1); }
    }
    t.small = small;
    for (int i = 0; i < RAMPS; i++) {
        world.tags[i] = -1;
        for (int light = 0; light < 256; light++) {
            world.flat[i][light] = (uint16_t)(random_one_in(random, 4) ? 0 : i << 12 | light);
        }
    }
    world.walk = (walk_t){.list = list};
    if (random_one_in(random, 2)) { /* the list of those below has a record already */
        world.walk.left = (list_end_t){FACES + 1, &world.above.next};
    }
}

static void random_pixels(random_source_t *random) {
    for (size_t i = 0; i < PIXELS; i++) {
        const uint32_t at = (uint32_t)(random_bits(random) % (3 * FACES));
        world.depth[i] = (uint16_t)(random_one_in(random, 2) ? 0 : vertices[at].depth_light >> 16);
        world.colour[i] = (uint16_t)random_bits(random);
    }
}

static void draw(void (*smalls)(tuile_t *t, walk_t *walk, uint32_t limit), uint32_t limit) {
    t.stats.faces_setup = 0;
    smalls(&t, &world.walk, limit);
    world.faces_setup = t.stats.faces_setup;
}

/* Faces that were drawn, of those that are short and inside: the assembly's share. */
static uint32_t share(void) {
    uint32_t faces = 0;
    for (uint16_t list = before.walk.list; list != world.walk.list;) {
        const record_t *record = record_before(list - 1u);
        const vertex_t v[3] = {vertices[record->v0], vertices[record->v0 + record->d1], vertices[record->v0 + record->d2]};
        faces += is_short(v) && is_inside(v);
        list = record->next;
    }
    return faces;
}

static bool equal(void) {
    return twins_equal("depth", assembly.depth, world.depth, sizeof world.depth) &&
           twins_equal("colour", assembly.colour, world.colour, sizeof world.colour) &&
           twins_equal("walk", &assembly.walk, &world.walk, sizeof world.walk) &&
           twins_equal("records", assembly.records, world.records, sizeof world.records) &&
           twins_equal("record above", &assembly.above, &world.above, sizeof world.above) &&
           twins_equal("counter", &assembly.faces_setup, &world.faces_setup, sizeof world.faces_setup);
}

bool twins_test(void) {
    random_source_t random = random_seed(0x5a11);
    uint32_t faces = 0, by_assembly = 0, all = 0, below = 0;
    t.arena_end = world.records + sizeof world.records;
    t.vertices = vertices;
    t.ramps = world.ramps[0];
    t.ramp_tags = world.tags;
    t.ramp_count = RAMPS;
    for (int round = 0; round < ROUNDS; round++) {
        const uint32_t limit = random_one_in(&random, 4) ? (uint32_t)random_between(&random, 0, FACES) : UINT32_MAX;
        const bool deferred = random_one_in(&random, 8);
        t.span_kind = deferred || random_one_in(&random, 2) ? SPAN_FLAT : SPAN_GOURAUD;
        t.numbers = deferred ? world.colour : NULL;
        t.record_bytes = deferred ? sizeof(record_surface_t) : sizeof(record_t);
        random_tile(&random);
        random_list(&random);
        random_pixels(&random);
        memcpy(&before, &world, sizeof world);
        drawn = 0;
        draw(smalls_plain, limit);
        memcpy(&assembly, &world, sizeof world);
        memcpy(&world, &before, sizeof world);
        draw(c_smalls_plain, limit);
        if (drawn != share()) { twins_tell("in assembly ", (int32_t)drawn, ", not ", (int32_t)share(), NULL); }
        if (drawn != share() || !equal()) {
            twins_tell("round ", (int32_t)round, ", limit ", (int32_t)limit, ", flat ", t.span_kind == SPAN_FLAT, ", deferred ",
                       (int32_t)deferred, ", columns ", (int32_t)t.tile_columns, ", small ", (int32_t)t.small, ", tile left ",
                       t.tile.left, ", top ", t.tile.top, ", right ", t.tile.right, ", bottom ", t.tile.bottom, NULL);
            return false;
        }
        faces += world.faces_setup;
        by_assembly += drawn;
        all += world.walk.list == RECORD_NONE;
        below += world.walk.left.first != before.walk.left.first || world.walk.left.end != before.walk.left.end;
    }
    twins_tell("small triangles: drawn ", (int32_t)faces, ", in assembly ", (int32_t)by_assembly, ", lists to their end ",
               (int32_t)all, ", with faces that reach below ", (int32_t)below, NULL);
    return by_assembly > 2 * ROUNDS && faces - by_assembly > ROUNDS / 8 && all > ROUNDS / 8 && below > ROUNDS / 8;
}
