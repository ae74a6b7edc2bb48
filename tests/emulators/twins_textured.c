/* textured_thumb, and what calls it, against smalls_draw of visibility/rows.h: lists of random triangles of all sizes and slopes,
 * in strips and in columns, with polygons, other materials, instances, sources, levels and limits among them; textures of all
 * sizes, of colours and with palettes. Compared are the tile, the lists, the records and the counter.
 *
 * A small face that covers no centre of the tile may be left to whoever walks, or be done with: it comes to the same, and what
 * stands for the walk here does away with it.
 */
#include "twins.h"
#include "twins_faces.h"

#include "../../raster/fill/textured_thumb.h"
#include "../../raster/memory.h"

void c_smalls_textured(tuile_t *t, walk_t *walk, uint32_t limit);
void __real_textured_thumb(textured_run_t *run);
void __wrap_textured_thumb(textured_run_t *run);

/* Faces of a list that the assembly drew. */
static uint32_t drawn;

void __wrap_textured_thumb(textured_run_t *run) {
    const uint32_t before = run->place.count;
    __real_textured_thumb(run);
    drawn += run->place.count - before;
}

/* ---- the rest of the renderer, as far as it is called ---- */

enum { MATERIALS = 4, INSTANCES = 2, SOURCES = 5, SIDE_BITS = 9, TEXELS = (1 << 2 * SIDE_BITS) * 4 / 3 + 1 };
static uint16_t texels[TEXELS], palette[256];
static textured_material_t materials[INSTANCES * MATERIALS];

/* Of a model: those of the faces' corners as each source has them, behind one another. */
static int16_t texcoords[SOURCES * 3 * FACES][2];

/* What t.vertices is, and where sources are in it. */
static struct {
    vertex_t vertices[3 * FACES];
    source_slot_t sources[SOURCES];
} vertices;
#define SLOT(source) (3u * FACES + SOURCE_SLOTS * (uint32_t)(source))

/* Materials behind the last one are refused, and colours and attributes of vertices. */
bool textured_source_open(tuile_t *of, const record_t *record, uint32_t wanted) {
    const uint32_t refused = UINT32_C(1) << 31, slot = wanted & 0xffffu;
    const source_slot_t *source = &vertices.sources[(slot - SLOT(0)) / SOURCE_SLOTS];
    if (of->textured_source == (wanted | refused)) { return false; }
    of->textured_source = wanted | refused;
    if (record->material >= MATERIALS || source->colours || source->attributes) { return false; }
    if (of->textured_instance != source->instance || of->textured_number != record->material) {
        of->textured_last = materials[source->instance * MATERIALS + record->material];
    }
    of->textured_instance = source->instance;
    of->textured_number = record->material;
    of->textured_source = wanted;
    of->textured_texcoords =
        (const uint8_t *)texcoords + 4 * ((ptrdiff_t)source->first_vertex - (ptrdiff_t)slot - (ptrdiff_t)SOURCE_SLOTS);
    return true;
}

/* The vertex in slot 0 is the first one of the faces. */
static void random_sources(random_source_t *random) {
    for (uint32_t i = 0; i < SOURCES; i++) {
        vertices.sources[i] = (source_slot_t){.first_vertex = SLOT(i) + SOURCE_SLOTS + 3 * FACES * i,
                                              .instance = i == 2,
                                              .colours = (uint16_t)(i == 3 ? random_between(random, 1, UINT16_MAX) : 0),
                                              .attributes = (uint16_t)(i == 4 ? random_between(random, 1, UINT16_MAX) : 0)};
    }
}

static void random_materials(random_source_t *random) {
    for (int i = 0; i < INSTANCES * MATERIALS; i++) {
        const bool paletted = random_one_in(random, 2);
        const unsigned width = (unsigned)random_between(random, 1, SIDE_BITS),
                       height = (unsigned)random_between(random, 1, SIDE_BITS);
        const unsigned lesser = width < height ? width : height;
        const tuile_material_t material = {.colour = {255, 255, 255}};
        const tuile_texture_t texture = {
            .texels = (const uint8_t *)texels,
            .palette = paletted ? (const uint8_t *)palette : NULL,
            .width = (uint16_t)(1u << width),
            .height = (uint16_t)(1u << height),
            .levels = (uint8_t)(random_one_in(random, 3) ? 1 : random_between(random, 1, (int32_t)lesser + 1)),
            .format = paletted ? TUILE_TEXEL_PALETTE8 : TUILE_TEXEL_RGB565};
        textured_material_open(&materials[i], &material, &texture, random_one_in(random, 4) ? TUILE_TEXTURE_AFFINE : 0, true,
                               (unsigned)random_between(random, 0, 8));
    }
}

/* Coordinates of a face, as far across as suits its size in pixels, or as it comes. */
static void random_coordinates(random_source_t *random, uint32_t face, const textured_material_t *m) {
    const unsigned bits = (unsigned)random_between(random, 0, random_one_in(random, 16) ? 15 : m->uv_bits + 6);
    for (int source = 0; source < SOURCES; source++) {
        const int32_t s = (int32_t)random_any_size(random, 15), t_ = (int32_t)random_any_size(random, 15);
        for (int i = 0; i < 3; i++) {
            const int32_t at[2] = {s + random_between(random, 0, 1 << bits), t_ + random_between(random, 0, 1 << bits)};
            for (int k = 0; k < 2; k++) {
                texcoords[3 * (FACES * (uint32_t)source + face) + (uint32_t)i][k] = (int16_t)(at[k] > INT16_MAX   ? INT16_MAX
                                                                                              : at[k] < INT16_MIN ? INT16_MIN
                                                                                                                  : at[k]);
            }
        }
    }
}

/* ---- cases ---- */

enum { ROUNDS = 8000 };

typedef struct world {
    faces_pixels_t pixels;
    _Alignas(8) record_surface_t records[FACES]; /* the first one last */
    record_surface_t above, beside;              /* the last ones of the lists of those below, and to the right */
    walk_t walk;
    uint32_t faces_setup, left_out;
    bool any;
} world_t;

static world_t world, before, assembly;

/* Faces in a list, some of which is left out. */
static void random_list(random_source_t *random) {
    const bool small = !random_one_in(random, 4);
    uint16_t list = RECORD_NONE;
    for (uint32_t i = FACES; i-- > 0;) {
        record_t *record = faces_random_record(random, i, list, small, 64);
        record->material =
            (uint8_t)(random_one_in(random, 4) ? random_between(random, 0, random_one_in(random, 16) ? MATERIALS : MATERIALS - 1)
                                               : 1);
        const int32_t source = random_one_in(random, 3) ? random_between(random, 0, random_one_in(random, 8) ? SOURCES - 1 : 2) : 1;
        frame_record_surface(record)->source = (uint16_t)SLOT(source);
        random_coordinates(random, i, &materials[(source == 2) * MATERIALS + record->material % MATERIALS]);
        if (!random_one_in(random, 8)) { list = (uint16_t)(i + 1); }
    }
    memcpy(vertices.vertices, faces_vertices, sizeof vertices.vertices);
    t.small = small;
    world.walk = (walk_t){.list = list};
    if (random_one_in(random, 2)) { /* the list of those below has a record already */
        world.above.record.next = RECORD_NONE;
        world.walk.left = (list_end_t){FACES + 1, &world.above.record.next};
    }
    if (faces_further() && random_one_in(random, 2)) {
        world.beside.record.next = RECORD_NONE;
        world.walk.right = (list_end_t){FACES + 2, &world.beside.record.next};
    }
}

/* Is (x, y) right of the side from a to b, or on it where that is a left or an upper one? Corners are counter-clockwise, y down. */
static bool within(const vertex_t *a, const vertex_t *b, int32_t x, int32_t y) {
    const int64_t dx = b->x - a->x, dy = b->y - a->y, side = dx * (y - a->y) - dy * (x - a->x);
    return side < 0 || (side == 0 && (dy > 0 || (dy == 0 && dx < 0)));
}

/* Does it cover a pixel's centre in the tile? */
static bool covers(const vertex_t *a, const vertex_t *b, const vertex_t *c) {
    for (int32_t row = t.tile.top; row < t.tile.bottom; row++) {
        for (int32_t column = t.tile.left; column < t.tile.right; column++) {
            const int32_t x = 16 * column + 8, y = 16 * row + 8;
            if (within(a, b, x, y) && within(b, c, x, y) && within(c, a, x, y)) { return true; }
        }
    }
    return false;
}

/* What whoever walks does with a face that is left out. */
static void walk_past(uint32_t number) {
    const record_t *record = frame_record(&t, number);
    const vertex_t *v0 = t.vertices + record->v0, *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    const vertex_t corners[3] = {*v0, *v1, *v2};
    world.walk.list = record->next;
    if (!frame_record_is_triangle(record) || !faces_short(corners) || covers(v0, v1, v2)) {
        world.left_out += number + 1u; /* it is drawn in another way */
        return;
    }
    t.stats.faces_setup++;
    t.textured_any = true;
    if (t.tile_columns > 1) {
        columns_hand_on(&t, number, (uint32_t)t.tile.left / t.config.tile_width, t.tile.bottom, &world.walk.right,
                        &world.walk.left);
    } else if (edge_row(v1->y > v2->y ? v1->y : v2->y) > t.tile.bottom) {
        list_append(&t, &world.walk.left, number);
    }
}

static void draw(void (*smalls)(tuile_t *t, walk_t *walk, uint32_t limit), uint32_t limit) {
    t.stats.faces_setup = 0;
    t.textured_source = UINT16_MAX;
    t.textured_instance = t.textured_number = UINT16_MAX;
    t.textured_any = false;
    for (smalls(&t, &world.walk, limit); world.walk.list - 1u < limit; smalls(&t, &world.walk, limit)) {
        walk_past(world.walk.list - 1u);
    }
    world.faces_setup = t.stats.faces_setup;
    world.any = t.textured_any;
}

static bool equal(void) {
    return twins_equal("depth", assembly.pixels.depth, world.pixels.depth, sizeof world.pixels.depth) &&
           twins_equal("colour", assembly.pixels.colour, world.pixels.colour, sizeof world.pixels.colour) &&
           twins_equal("walk", &assembly.walk, &world.walk, sizeof world.walk) &&
           twins_equal("records", assembly.records, world.records, sizeof world.records) &&
           twins_equal("record above", &assembly.above, &world.above, sizeof world.above) &&
           twins_equal("record beside", &assembly.beside, &world.beside, sizeof world.beside) &&
           twins_equal("counter", &assembly.faces_setup, &world.faces_setup, sizeof world.faces_setup) &&
           twins_equal("left out", &assembly.left_out, &world.left_out, sizeof world.left_out) &&
           twins_equal("any", &assembly.any, &world.any, sizeof world.any);
}

/* Of the faces that are done with. */
static void count_on(faces_on_t *on) {
    for (uint32_t list = before.walk.list; list != world.walk.list;) {
        const record_t *record = &before.records[FACES - list].record;
        const vertex_t v[3] = {t.vertices[record->v0], t.vertices[record->v0 + record->d1], t.vertices[record->v0 + record->d2]};
        faces_count_on(on, v);
        list = record->next;
    }
}

bool twins_test(void) {
    random_source_t random = random_seed(0x5a11);
    uint32_t faces = 0, by_assembly = 0, all = 0, below = 0;
    faces_on_t on = {0};
    t.arena_end = (uint8_t *)(world.records + FACES);
    t.record_bytes = sizeof(record_surface_t);
    t.vertices = vertices.vertices;
    random_sources(&random);
    t.config.shade = TUILE_GOURAUD;
    t.working = world.pixels.colour + AROUND;
    for (size_t i = 0; i < TEXELS; i++) {
        texels[i] = (uint16_t)random_bits(&random);
    }
    for (int i = 0; i < 256; i++) {
        palette[i] = (uint16_t)random_bits(&random);
    }
    for (int round = 0; round < ROUNDS; round++) {
        const uint32_t limit = random_one_in(&random, 4) ? (uint32_t)random_between(&random, 0, FACES) : UINT32_MAX;
        world.left_out = 0;
        random_materials(&random);
        faces_random_tile(&random, &world.pixels);
        random_list(&random);
        faces_random_pixels(&random, &world.pixels);
        memcpy(&before, &world, sizeof world);
        drawn = 0;
        draw(smalls_textured, limit);
        memcpy(&assembly, &world, sizeof world);
        memcpy(&world, &before, sizeof world);
        draw(c_smalls_textured, limit);
        if (!equal()) {
            twins_tell("round ", (int32_t)round, ", limit ", (int32_t)limit, ", columns ", (int32_t)t.tile_columns, ", small ",
                       (int32_t)t.small, ", tile left ", t.tile.left, ", top ", t.tile.top, ", right ", t.tile.right, ", bottom ",
                       t.tile.bottom, NULL);
            return false;
        }
        count_on(&on);
        faces += world.faces_setup;
        by_assembly += drawn;
        all += world.walk.list == RECORD_NONE;
        below += world.walk.left.first != before.walk.left.first || world.walk.left.end != before.walk.left.end;
    }
    twins_tell("small textured triangles: drawn ", (int32_t)faces, ", in assembly ", (int32_t)by_assembly, ", lists to their end ",
               (int32_t)all, ", with faces that reach below ", (int32_t)below, "; faces in columns: to the right ",
               (int32_t)on.right, ", below ", (int32_t)on.below, ", both ", (int32_t)on.both, NULL);
    return by_assembly > 2 * ROUNDS && faces - by_assembly > ROUNDS / 8 && all > ROUNDS / 8 && below > ROUNDS / 8 &&
           on.right > ROUNDS / 8 && on.below > ROUNDS / 8 && on.both > ROUNDS / 8;
}
