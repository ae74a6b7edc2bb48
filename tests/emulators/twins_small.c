/* small_thumb_gouraud and small_thumb_flat, and what calls them, against smalls_draw of visibility/rows.h: lists of random
 * triangles of all sizes and slopes, in strips and in columns, with polygons, other materials, colours that are not made yet and
 * limits among them. Compared are the tile, the lists, the records and the counter; not the ramps, which
 * may be made for a face that is then left alone.
 */
#include "twins.h"
#include "twins_faces.h"

#include "../../raster/fill/small_thumb.h"
#include "../../raster/memory.h"

void c_smalls_plain(tuile_t *t, walk_t *walk, uint32_t limit);
void __real_small_thumb_gouraud(small_run_t *run);
void __wrap_small_thumb_gouraud(small_run_t *run);
void __real_small_thumb_flat(small_run_t *run);
void __wrap_small_thumb_flat(small_run_t *run);

enum {
    ROUNDS = 12000,
    RAMPS = 3,
};

typedef struct world {
    faces_pixels_t pixels;
    uint16_t ramps[RAMPS][RAMP_COLOURS], flat[RAMPS][256];
    int16_t tags[RAMPS];
    _Alignas(8) uint8_t records[FACES * sizeof(record_surface_t)]; /* the first one last */
    record_t above, beside;                                        /* the last ones of the lists of those below, and to the right */
    walk_t walk;
    uint32_t faces_setup;
} world_t;

static world_t world, before, assembly;
/* Faces of a list that the assembly drew. */
static uint32_t drawn;

void __wrap_small_thumb_gouraud(small_run_t *run) {
    const uint32_t before = run->place.count;
    __real_small_thumb_gouraud(run);
    drawn += run->place.count - before;
}

void __wrap_small_thumb_flat(small_run_t *run) {
    const uint32_t before = run->place.count;
    __real_small_thumb_flat(run);
    drawn += run->place.count - before;
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

static const record_t *record_before(uint32_t number) {
    return (const record_t *)(const void *)(before.records + sizeof before.records - (number + 1) * t.record_bytes);
}

/* Faces in a list, some of which is left out. */
static void random_list(random_source_t *random) {
    const bool small = random_one_in(random, 2);
    uint16_t list = RECORD_NONE;
    for (uint32_t i = FACES; i-- > 0;) {
        record_t *record = faces_random_record(random, i, list, small, 24);
        record->material = (uint8_t)(random_one_in(random, 4) ? random_between(random, 0, 5) : 1);
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
    if (faces_further() && random_one_in(random, 2)) { world.walk.right = (list_end_t){FACES + 2, &world.beside.next}; }
}

static void draw(void (*smalls)(tuile_t *t, walk_t *walk, uint32_t limit), uint32_t limit) {
    t.stats.faces_setup = 0;
    smalls(&t, &world.walk, limit);
    world.faces_setup = t.stats.faces_setup;
}

/* Faces that were drawn, of those that are short: the assembly's share. */
static uint32_t share(faces_on_t *on) {
    uint32_t faces = 0;
    for (uint16_t list = before.walk.list; list != world.walk.list;) {
        const record_t *record = record_before(list - 1u);
        const vertex_t v[3] = {faces_vertices[record->v0], faces_vertices[record->v0 + record->d1],
                               faces_vertices[record->v0 + record->d2]};
        faces += faces_short(v);
        faces_count_on(on, v);
        list = record->next;
    }
    return faces;
}

static bool equal(void) {
    return twins_equal("depth", assembly.pixels.depth, world.pixels.depth, sizeof world.pixels.depth) &&
           twins_equal("colour", assembly.pixels.colour, world.pixels.colour, sizeof world.pixels.colour) &&
           twins_equal("walk", &assembly.walk, &world.walk, sizeof world.walk) &&
           twins_equal("records", assembly.records, world.records, sizeof world.records) &&
           twins_equal("record above", &assembly.above, &world.above, sizeof world.above) &&
           twins_equal("record beside", &assembly.beside, &world.beside, sizeof world.beside) &&
           twins_equal("counter", &assembly.faces_setup, &world.faces_setup, sizeof world.faces_setup);
}

bool twins_test(void) {
    random_source_t random = random_seed(0x5a11);
    uint32_t faces = 0, by_assembly = 0, all = 0, below = 0;
    faces_on_t on = {0};
    t.arena_end = world.records + sizeof world.records;
    t.vertices = faces_vertices;
    t.ramps = world.ramps[0];
    t.ramp_tags = world.tags;
    t.ramp_count = RAMPS;
    for (int round = 0; round < ROUNDS; round++) {
        const uint32_t limit = random_one_in(&random, 4) ? (uint32_t)random_between(&random, 0, FACES) : UINT32_MAX;
        const bool deferred = random_one_in(&random, 8);
        t.span_kind = deferred || random_one_in(&random, 2) ? SPAN_FLAT : SPAN_GOURAUD;
        t.numbers = deferred ? world.pixels.colour : NULL;
        t.record_bytes = deferred ? sizeof(record_surface_t) : sizeof(record_t);
        faces_random_tile(&random, &world.pixels);
        random_list(&random);
        faces_random_pixels(&random, &world.pixels);
        memcpy(&before, &world, sizeof world);
        drawn = 0;
        draw(smalls_plain, limit);
        memcpy(&assembly, &world, sizeof world);
        memcpy(&world, &before, sizeof world);
        draw(c_smalls_plain, limit);
        const uint32_t wanted = share(&on);
        if (drawn != wanted) { twins_tell("in assembly ", (int32_t)drawn, ", not ", (int32_t)wanted, NULL); }
        if (drawn != wanted || !equal()) {
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
               (int32_t)all, ", with faces that reach below ", (int32_t)below, "; faces in columns: to the right ",
               (int32_t)on.right, ", below ", (int32_t)on.below, ", both ", (int32_t)on.both, NULL);
    return by_assembly > 2 * ROUNDS && all > ROUNDS / 8 && below > ROUNDS / 8 && on.right > ROUNDS / 8 && on.below > ROUNDS / 8 &&
           on.both > ROUNDS / 8;
}
