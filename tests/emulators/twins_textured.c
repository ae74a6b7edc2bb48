/* textured_thumb, and what calls it, against smalls_draw of visibility/rows.h: lists of random triangles of all sizes and slopes,
 * in strips and in columns, with polygons, other materials, sources, levels and limits among them; textures of all sizes, of
 * colours and with palettes. Compared are the tile, the lists, the records and the counter.
 */
#include "twins.h"

#include "../../raster/fill/textured_thumb.h"
#include "../../raster/memory.h"
#include "../../raster/visibility/rows.h"
#include "../support/random.h"

void c_smalls_textured(tuile_t *t, walk_t *walk, uint32_t limit);
void __real_textured_thumb(textured_run_t *run);
void __wrap_textured_thumb(textured_run_t *run);

/* Faces of a list that the assembly drew. */
static uint32_t drawn;

void __wrap_textured_thumb(textured_run_t *run) {
    const uint32_t before = run->count;
    __real_textured_thumb(run);
    drawn += run->count - before;
}

/* ---- the rest of the renderer, as far as it is called ---- */

enum { MATERIALS = 4, SOURCES = 3, FACES = 12, SIDE_BITS = 9, TEXELS = (1 << 2 * SIDE_BITS) * 4 / 3 + 1 };
static uint16_t texels[TEXELS], palette[256];
static textured_material_t materials[MATERIALS];
static int16_t texcoords[SOURCES][3 * FACES][2];

/* Materials behind the last one are refused. */
bool textured_source_open(tuile_t *of, const record_t *record, uint32_t wanted) {
    const record_surface_t *surface = (const record_surface_t *)(const void *)record;
    const uint32_t refused = UINT32_C(1) << 31;
    if (of->textured_source == (wanted | refused)) { return false; }
    of->textured_source = wanted | refused;
    if (record->material >= MATERIALS) { return false; }
    if (of->textured_number != record->material) { of->textured_last = materials[record->material]; }
    of->textured_number = record->material;
    of->textured_source = wanted;
    of->textured_texcoords = (const uint8_t *)texcoords[surface->source];
    return true;
}

static void random_materials(random_source_t *random) {
    for (int i = 0; i < MATERIALS; i++) {
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
                texcoords[source][3 * face + (uint32_t)i][k] = (int16_t)(at[k] > INT16_MAX   ? INT16_MAX
                                                                         : at[k] < INT16_MIN ? INT16_MIN
                                                                                             : at[k]);
            }
        }
    }
}

/* ---- cases ---- */

enum {
    ROUNDS = 8000,
    SIDE = 40,         /* the largest tile */
    AROUND = 3 * SIDE, /* pixels before and behind it, which must stay as they are */
    PIXELS = SIDE * SIDE + 2 * AROUND,
};

typedef struct world {
    uint16_t depth[PIXELS], colour[PIXELS];
    _Alignas(8) record_surface_t records[FACES]; /* the first one last */
    record_surface_t above;                      /* the last one of the list of those below */
    walk_t walk;
    uint32_t faces_setup, left_out;
    bool any;
} world_t;

static world_t world, before, assembly;
static vertex_t vertices[3 * FACES];
static tuile_t t;

/* What a case is drawn in; lists of columns.h are not asked for. */
static void random_tile(random_source_t *random) {
    const int32_t width = random_between(random, 4, SIDE), height = random_between(random, 1, SIDE);
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

static record_t *record_of(uint32_t number) { return &world.records[FACES - 1 - number].record; }

/* Faces in a list, some of which is left out. In columns all triangles are short (columns.h). */
static void random_list(random_source_t *random) {
    const bool small = !random_one_in(random, 4);
    uint16_t list = RECORD_NONE;
    for (uint32_t i = FACES; i-- > 0;) {
        vertex_t *v = &vertices[3 * i];
        const bool swap = random_one_in(random, 2);
        do {
            random_triangle(random, v);
        } while (((small || t.tile_columns > 1) && !is_short(v)) || (small && t.tile_columns == 1 && !is_inside(v)));
        *record_of(i) = (record_t){.next = list, .v0 = (uint16_t)(3 * i), .d1 = 1, .d2 = 2, .light = (uint8_t)random_bits(random)};
        record_of(i)->material =
            (uint8_t)(random_one_in(random, 4) ? random_between(random, 0, random_one_in(random, 16) ? MATERIALS : MATERIALS - 1)
                                               : 1);
        frame_record_surface(record_of(i))->source =
            (uint16_t)(random_one_in(random, 4) ? random_between(random, 0, SOURCES - 1) : 1);
        random_coordinates(random, i, &materials[record_of(i)->material % MATERIALS]);
        if (swap) { /* the corners from the last one on */
            const vertex_t corner = v[0];
            v[0] = v[2], v[2] = corner;
            record_of(i)->v0 = (uint16_t)(3 * i + 2);
            record_of(i)->d1 = -1, record_of(i)->d2 = -2;
        }
        if (random_one_in(random, 64)) { record_of(i)->d1 = record_of(i)->d2 = 0; }
        if (!random_one_in(random, 8)) { list = (uint16_t)(i + 1); }
    }
    t.small = small;
    world.walk = (walk_t){.list = list};
    if (random_one_in(random, 2)) { /* the list of those below has a record already */
        world.walk.left = (list_end_t){FACES + 1, &world.above.record.next};
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
    t.textured_source = UINT16_MAX;
    t.textured_number = UINT16_MAX;
    t.textured_any = false;
    for (smalls(&t, &world.walk, limit); world.walk.list - 1u < limit; smalls(&t, &world.walk, limit)) {
        world.left_out += world.walk.list; /* whoever walks draws it in another way */
        world.walk.list = record_of(world.walk.list - 1u)->next;
    }
    world.faces_setup = t.stats.faces_setup;
    world.any = t.textured_any;
}

static bool equal(void) {
    return twins_equal("depth", assembly.depth, world.depth, sizeof world.depth) &&
           twins_equal("colour", assembly.colour, world.colour, sizeof world.colour) &&
           twins_equal("walk", &assembly.walk, &world.walk, sizeof world.walk) &&
           twins_equal("records", assembly.records, world.records, sizeof world.records) &&
           twins_equal("record above", &assembly.above, &world.above, sizeof world.above) &&
           twins_equal("counter", &assembly.faces_setup, &world.faces_setup, sizeof world.faces_setup) &&
           twins_equal("left out", &assembly.left_out, &world.left_out, sizeof world.left_out) &&
           twins_equal("any", &assembly.any, &world.any, sizeof world.any);
}

bool twins_test(void) {
    random_source_t random = random_seed(0x5a11);
    uint32_t faces = 0, by_assembly = 0, all = 0, below = 0;
    t.arena_end = (uint8_t *)(world.records + FACES);
    t.record_bytes = sizeof(record_surface_t);
    t.vertices = vertices;
    t.config.shade = TUILE_GOURAUD;
    t.working = world.colour + AROUND;
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
        random_tile(&random);
        random_list(&random);
        random_pixels(&random);
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
        faces += world.faces_setup;
        by_assembly += drawn;
        all += world.walk.list == RECORD_NONE;
        below += world.walk.left.first != before.walk.left.first || world.walk.left.end != before.walk.left.end;
    }
    twins_tell("small textured triangles: drawn ", (int32_t)faces, ", in assembly ", (int32_t)by_assembly, ", lists to their end ",
               (int32_t)all, ", with faces that reach below ", (int32_t)below, NULL);
    return by_assembly > 2 * ROUNDS && faces - by_assembly > ROUNDS / 8 && all > ROUNDS / 8 && below > ROUNDS / 8;
}
