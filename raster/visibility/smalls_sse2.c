/* Vectors serve what is alike for several numbers of a face: light, s and t are of 16 bits, and so are the corners of a short
 * triangle, so that one instruction makes four determinants of them; the reciprocal makes two steps at a time of them, and those
 * two parts of the map at once. Depths have more bits and stay in ordinary registers, as do sides. A face's numbers are made in the
 * order of what may make an end of it: the questions of textured_map_make, its sides down to the first row that covers a pixel's
 * centre (one face in eight has none), then all else. What is seldom is left to C: loop_beside.
 *
 * Numbers are those of fill/small.h and surface/textured.h to the bit, and so are their bounds.
 */
#include "../tune.h"
#if defined(__GNUC__) && !defined(__clang__)
/* 9 % fewer of all of a frame: numbers that do not change are left in memory, which instructions take them from, instead of being
 * moved out of loops into registers that are not there. */
#pragma GCC optimize("no-ivopts", "no-gcse", "no-tree-loop-im", "no-move-loop-invariants", "no-tree-ter", "ira-region=one")
#endif

#include "smalls_sse2.h"

#include "../assembly.h"

#if ASSEMBLY_SSE2

#include "../fill/textured_rows_sse2.h"

/* ---- instructions that C has no operator for, by gcc's names: its header of intrinsics wants a C library ---- */

typedef int32_t __attribute__((vector_size(16))) sse2_signed_t;
typedef long long __attribute__((vector_size(16))) sse2_signed_quads_t;

#define LONGS_BY(function, type, a, b) ((sse2_longs_t)__builtin_ia32_##function((type)(a), (type)(b)))
/* a0 b0 + a1 b1, and so on, of words */
#define PAIRS(a, b) LONGS_BY(pmaddwd128, sse2_words_t, a, b)
/* of the longs 0 and 2, 64 bits each */
#define PRODUCTS(a, b) LONGS_BY(pmuludq128, sse2_signed_t, a, b)
/* of words, -2^15 ... 2^15 - 1 instead of what is beyond that */
#define DIFFERENCES(a, b) LONGS_BY(psubsw128, sse2_words_t, a, b)
/* a0 b0 a1 b1 ... of the lower halves; of the upper ones */
#define WORDS(a, b) LONGS_BY(punpcklwd128, sse2_words_t, a, b)
#define LONGS(a, b) LONGS_BY(punpckldq128, sse2_signed_t, a, b)
#define QUADS(a, b) LONGS_BY(punpcklqdq128, sse2_signed_quads_t, a, b)
#define UPPER_QUADS(a, b) LONGS_BY(punpckhqdq128, sse2_signed_quads_t, a, b)
/* the lower half of a, the upper one of b */
#define HALVES(a, b) ((sse2_longs_t)__builtin_shuffle((sse2_quads_t)(a), (sse2_quads_t)(b), (sse2_quads_t){0, 3}))
/* the longs, or the lower four words, of these numbers, 2 bits each */
#define LONGS_OF(a, order) ((sse2_longs_t)__builtin_ia32_pshufd((sse2_signed_t)(a), order))
#define WORDS_OF(a, order) __builtin_ia32_pshuflw((sse2_words_t)(a), order)
/* shifts by the number in another vector; signed */
#define COUNT(bits) ((sse2_quads_t){bits, 0})
#define LONGS_UP(a, bits) LONGS_BY(pslld128, sse2_signed_t, a, bits)
#define LONGS_DOWN(a, bits) LONGS_BY(psrad128, sse2_signed_t, a, bits)
/* x in the longs 0 and 2, 0 in the others; a and b in the longs 0 and 1 */
#define BOTH(x) QUADS(((sse2_longs_t){(uint32_t)(x), 0, 0, 0}), ((sse2_longs_t){(uint32_t)(x), 0, 0, 0}))
#define TWO(a, b) LONGS(((sse2_longs_t){(uint32_t)(a), 0, 0, 0}), ((sse2_longs_t){(uint32_t)(b), 0, 0, 0}))

TUILE_INLINE sse2_longs_t load_long(const void *at) {
    uint32_t x;
    __builtin_memcpy(&x, at, sizeof x);
    return (sse2_longs_t){x, 0, 0, 0};
}

TUILE_INLINE sse2_longs_t load_quad(const void *at) {
    uint64_t x;
    __builtin_memcpy(&x, at, sizeof x);
    return (sse2_longs_t)(sse2_quads_t){x, 0};
}

/* ---- what the loop finds in memory ---- */

/* A level. Faces want it for which texels < area * upper_times + upper_more and texels >= area * lower_times + lower_more: what
 * textured_level_make asks, the shifts moved to the other side. All 0: no face's. */
typedef struct level {
    sse2_longs_t units; /* s_unit, 0, t_unit, 0 */
    uint64_t up, from_corner;
    uint64_t upper_times, upper_more, lower_times, lower_more; /* up to 2^40; area < 2^18 */
    textured_rows_level_t rows;
} level_t;

enum { LEVELS = 4 }; /* at hand: the faces of a model want two or three in turn */

typedef struct loop {
    textured_rows_t rows; /* its level is the current one */
    const level_t *level; /* the current one, of these: */
    level_t levels[LEVELS];
    uint32_t oldest;     /* of the levels */
    uint32_t wanted;     /* of records: material, 0, source */
    uint32_t material;   /* t->textured_instance and t->textured_number, which decide the next four and the levels */
    uint32_t across;     /* textured_material_t, less 4; below 2^15 */
    uint32_t one;        /* its own, more 4 */
    uint32_t log2_one;   /* uv_bits */
    sse2_longs_t inside; /* s_inside, -1, 8 bits up */
    const uint8_t *texcoords;
    uintptr_t records; /* of number 0; the next one is record_bytes lower */
    uint64_t record_bytes;
    const vertex_t *vertices;
    uint16_t *depth; /* of the pixel in the tile's first row and in column 0 of the window */
    int64_t stride;  /* bytes */
    int32_t top;     /* 16 * the tile's first row + 8 */
    int32_t height;  /* rows */
    uint32_t limit;  /* the loop ends at the record of this number */
    uint32_t count;  /* faces that were drawn */
    bool all_short;
    bool crosses; /* the face touches columns beside the tile */
    small_tile_t tile;
} loop_t;

static TUILE_NOINLINE void loop_open(loop_t *loop, const tuile_t *t, uint32_t limit) {
    static const textured_numbers_t numbers = TEXTURED_NUMBERS;
    loop->tile = small_tile(&t->tile);
    loop->tile.colour = (t->working ? (uint16_t *)t->working : (uint16_t *)(void *)t->colours[t->next_buffer]) - loop->tile.depth;
    loop->rows.numbers = numbers;
    loop->rows.colour = loop->tile.colour * (ptrdiff_t)sizeof(uint16_t);
    loop->wanted = UINT32_MAX; /* none */
    loop->material = UINT32_MAX;
    loop->records = (uintptr_t)frame_record(t, 0);
    loop->vertices = t->vertices;
    loop->record_bytes = t->record_bytes;
    loop->stride = loop->tile.stride * (small_int_t)sizeof(uint16_t);
    loop->depth = t->tile.depth - t->tile.left;
    loop->top = 16 * t->tile.top + 8;
    loop->height = t->tile.bottom - t->tile.top;
    loop->limit = limit;
    loop->count = 0;
    loop->crosses = false;
    loop->all_short = t->tile_columns > 1 || t->small; /* columns.h has none but those */
}

TUILE_INLINE bool level_wanted(const level_t *level, uint64_t texels, uint64_t pixels) {
    return texels < pixels * level->upper_times + level->upper_more && texels >= pixels * level->lower_times + level->lower_more;
}

/* The material's current level becomes the loop's, in place of the oldest one. */
static TUILE_NOINLINE void loop_level(loop_t *loop, const textured_material_t *m) {
    const textured_level_t *from = &m->level;
    const uint64_t one = 1;
    level_t l = {.units = {from->s_unit, 0, from->t_unit, 0},
                 .up = from->up,
                 .from_corner = from->from_corner,
                 .rows = {.mask = from->mask, .shift = from->shift, .texels = from->texels}};
    if (from->down == 0) { /* else it is no face's: reciprocals are not shifted down here */
        l.upper_times = one << (m->pixels_up + from->upper);
        l.upper_more = one << from->upper;
    }
    if (!from->always) {
        l.lower_times = one << (m->pixels_up + from->lower);
        l.lower_more = one << from->lower;
    }
    loop->level = &loop->levels[loop->oldest];
    loop->levels[loop->oldest] = l;
    loop->oldest = (loop->oldest + 1) % LEVELS;
    loop->rows.level = l.rows;
}

/* Takes up the source of a record. False: its faces are not to be drawn so. */
static TUILE_NOINLINE bool loop_source(loop_t *loop, tuile_t *t, const record_t *record) {
    if (!textured_fits(t, record)) { return false; }
    const textured_material_t *m = &t->textured_last;
    const uint32_t material = t->textured_instance | (uint32_t)t->textured_number << 16;
    loop->wanted = t->textured_source >> 16 | t->textured_source << 16;
    loop->texcoords = t->textured_texcoords;
    if (material == loop->material) { return true; }
    loop->material = material;
    loop->rows.palette = m->palette;
    loop->inside = (sse2_longs_t){(uint32_t)m->s_inside << TEXTURED_FRACTION, ~UINT32_C(0) << TEXTURED_FRACTION, 0, 0};
    loop->across = (m->across < INT16_MAX ? m->across : INT16_MAX) - 4u;
    loop->one = m->one + 4u;
    loop->log2_one = m->uv_bits;
    memset(loop->levels, 0, sizeof loop->levels); /* none */
    loop->oldest = 0;
    loop_level(loop, m);
    return true;
}

static TUILE_NOINLINE void loop_hand_on(tuile_t *t, walk_t *walk, uint32_t number) {
    columns_hand_on(t, number, (uint32_t)t->tile.left / t->config.tile_width, t->tile.bottom, &walk->right, &walk->left);
}

/* A face that is left to C. False: it is not to be drawn so. */
static TUILE_NOINLINE bool loop_beside(const loop_t *loop, tuile_t *t, walk_t *walk, uint32_t number, const record_t *record) {
    const vertex_t *v0 = t->vertices + record->v0, *v1 = v0 + record->d1, *v2 = v0 + record->d2;
    const uint32_t next = record->next;
    small_paint_t paint = {.constants = textured_constants()};
    small_face_t face;
    if (!small_open(&face, v0, v1, v2, &loop->tile, 0) ||
        !small_prepare(t, record, number, SMALL_TEXTURED, true, &face, v0, v1, v2, &paint)) {
        return false;
    }
    const bool reaches = small_fill(&face, v0, v1, v2, &loop->tile, SMALL_TEXTURED, true, 0, &paint, true);
    if (t->tile_columns > 1) {
        loop_hand_on(t, walk, number);
    } else if (reaches) {
        list_append(t, &walk->left, number);
    }
    walk->list = (uint16_t)next;
    return true;
}

/* Takes up the level of a face. texels: by textured_size. False: it is left to C. */
static TUILE_NOINLINE bool loop_level_find(loop_t *loop, tuile_t *t, uint32_t texels, uint32_t area) {
    for (unsigned i = 0; i < LEVELS; i++) {
        if (level_wanted(&loop->levels[i], texels, area)) {
            loop->level = &loop->levels[i];
            loop->rows.level = loop->level->rows;
            return true;
        }
    }
    textured_material_t *m = &t->textured_last;
    if (!textured_level_find(m, texels, area << m->pixels_up)) { return false; }
    loop_level(loop, m);
    return level_wanted(loop->level, texels, area);
}

/* Is it short? */
static TUILE_NOINLINE bool loop_small(loop_t *loop, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2) {
    const small_corners_t c = {v0->x, v0->y, v1->x - v0->x, v1->y - v0->y, v2->x - v0->x, v2->y - v0->y};
    const small_int_t column = (c.x0 + 7) >> 4;
    loop->crosses = !small_inside(&c, &loop->tile);
    loop->rows.first = loop->tile.first - column;
    loop->rows.end = loop->tile.end - column;
    return loop->all_short || small_short(&c);
}

static TUILE_NOINLINE void loop_fill_clamped(textured_rows_t *rows, const textured_bend_t *bend, uint64_t dx, uint32_t map_dx) {
    if (rows->palette) {
        textured_rows_fill(rows, bend, dx, map_dx, true, true);
    } else {
        textured_rows_fill(rows, bend, dx, map_dx, false, true);
    }
}

/* ---- a face ---- */

/* What multiplies the words of both corners to determinants, by whether the corner between is on the left, as these words are laid
 * out: which of them change their signs. */
static const sse2_words_t turning[2] = {{0, -1, -1, 0, 0, 0, 0, 0}, {-1, 0, 0, -1, 0, 0, 0, 0}},
                          crossing[2] = {{-1, 0, 0, 0, 0, 0, 0, 0}, {0, -1, 0, 0, 0, 0, 0, 0}};

/* The rows that the face has in the tile. */
TUILE_INLINE void bend_rows(textured_bend_t *bend, int32_t first, int32_t row_end, int32_t height) {
    const int32_t row_mid = (bend->top + (int32_t)bend->mid_y + 15) >> 4;
    bend->row = first > 0 ? first : 0;
    bend->end = row_end < height ? row_end : height;
    bend->until = row_mid < bend->end ? row_mid : bend->end;
}

/* Both sides in the first row that covers a pixel's centre, in whatever column: bend->row. False: none does. */
TUILE_INLINE bool bend_seek(textured_bend_t *bend, textured_side_t *left, textured_side_t *right) {
    const int32_t to_y = 16 * bend->row - bend->top;
    const textured_side_t along = textured_side(bend->start, bend->low_x, bend->low_y, to_y);
    textured_side_t a = along, b = along, bent;
    if (bend->row < bend->until) {
        bent = textured_side(bend->start, bend->mid_x, bend->mid_y, to_y);
    } else {
        bent = textured_side_below(bend, bend->row);
        bend->until = bend->end;
    }
    if (bend->left) {
        a = bent;
    } else {
        b = bent;
    }
    while (TUILE_UNLIKELY(a.x >> 20 >= b.x >> 20)) {
        a.x = (int32_t)((uint32_t)a.x + (uint32_t)a.slope);
        b.x = (int32_t)((uint32_t)b.x + (uint32_t)b.slope);
        if (++bend->row < bend->until) { continue; }
        if (bend->row == bend->end) { return false; }
        bend->until = bend->end;
        bent = textured_side_below(bend, bend->row);
        if (bend->left) {
            a = bent;
        } else {
            b = bent;
        }
    }
    *left = a;
    *right = b;
    return true;
}

/* textured_map_make: at the pixel, in the long 2, and in the longs 0 and 2 a column to the right and a row down. `determinants` of
 * s right, s down, t right, t down; c0: the first corner's coordinates; to_x, to_y: the pixel's centre from there, to_y & 15
 * sixteenths and `rows` rows. */
typedef struct face_map {
    sse2_longs_t at, steps;
} face_map_t;

TUILE_INLINE face_map_t map_make(const loop_t *loop, sse2_longs_t determinants, uint32_t reciprocal, sse2_longs_t c0, uint32_t to_x,
                                 uint32_t to_y, uint32_t rows) {
    const uint32_t sign = UINT32_C(1) << 31;
    const sse2_quads_t half = {sign, sign};
    /* (determinant * 2^up * reciprocal + 2^31) / 2^32: the first factor as if 2^31 greater, so that it is not negative */
    const sse2_longs_t factors = LONGS_UP(determinants, COUNT(loop->level->up)) ^ (sse2_longs_t) { sign, sign, sign, sign },
                       r = BOTH(reciprocal);
    const sse2_quads_t round = half - ((sse2_quads_t)r << 31);
    const sse2_longs_t x = (sse2_longs_t)(((sse2_quads_t)PRODUCTS(factors, r) + round) >> 32),
                       y = (sse2_longs_t)(((sse2_quads_t)PRODUCTS((sse2_quads_t)factors >> 32, r) + round) >> 32);
    const sse2_longs_t units = loop->level->units, map_x = PRODUCTS(x, units), map_y = PRODUCTS(y, units);
    const sse2_longs_t steps = QUADS(map_x, map_y) + UPPER_QUADS(map_x, map_y);
    /* each word twice, so that it is one of them 2^16 times, of a long */
    const sse2_longs_t corner =
        LONGS_DOWN((sse2_longs_t)((sse2_signed_t)WORDS(c0, c0) >> 8) & loop->inside, COUNT(loop->level->from_corner));
    const sse2_longs_t part = PRODUCTS(x, BOTH(to_x)) + PRODUCTS(y, BOTH(to_y & 15));
    const sse2_longs_t at = PRODUCTS(LONGS_OF(corner, 0x10) + (sse2_longs_t)((sse2_signed_t)part >> 4), units);
    return (face_map_t){at + LONGS_OF(at, 0x4e) + PRODUCTS(steps, BOTH(rows)), steps};
}

/* ---- the loop ---- */

/* known: all faces are short, and touch no column beside the tile; a constant. */
TUILE_INLINE void loop_draw(tuile_t *t, walk_t *walk, uint32_t limit, bool known) {
    const sse2_words_t corner_fields = {-1, -1, 255, 0, 0, 0, 0, 0}, ones = {1, 1, 1, 1, 0, 0, 0, 0};
    loop_t loop;
    uint32_t number = walk->list - (uint32_t)1;
    loop_open(&loop, t, limit);
    __asm__("" : : "r"(&loop) : "memory"); /* a pixel's store might change it: textured_rows_t */
    while (number < loop.limit) {
        const record_t *record = (const record_t *)(loop.records - number * loop.record_bytes);
        uint32_t source;
        __builtin_memcpy(&source, (const uint8_t *)record + offsetof(record_t, material),
                         sizeof source); /* material, light, source */
        const ptrdiff_t d1 = record->d1, d2 = record->d2;
        if (TUILE_UNLIKELY(d1 == 0)) { break; } /* no triangle */
        if (TUILE_UNLIKELY((source & 0xffff00ffu) != loop.wanted) && !loop_source(&loop, t, record)) { break; }

        /* the corner between and the lowest one, which the long side ends at */
        const vertex_t *v0 = loop.vertices + record->v0, *mid = v0 + d1, *low = v0 + d2;
        const uint8_t *texcoords = loop.texcoords + 4 * (size_t)record->v0, *at_mid = texcoords + 4 * d1,
                      *at_low = texcoords + 4 * d2;
        uint64_t left = 1; /* the corner between is on the left side */
        if (mid->y >= low->y) {
            const vertex_t *const v1 = mid;
            const uint8_t *const at_v1 = at_mid;
            mid = low, low = v1;
            at_mid = at_low, at_low = at_v1;
            left = 0;
        }
        if (!known && !loop_small(&loop, v0, mid, low)) { goto beside; }

        /* s of both, t of both: what does not fit into a word is more than any face is across */
        const sse2_longs_t c0 = load_long(texcoords),
                           st = WORDS(DIFFERENCES(load_long(at_mid), c0), DIFFERENCES(load_long(at_low), c0));
        const sse2_words_t size = (sse2_words_t)st ^ (sse2_words_t)st >> 15;
        const sse2_longs_t sizes = PAIRS(size, ones);
        const uint32_t across = (sizes + LONGS_OF(sizes, 1))[0];
        if (TUILE_UNLIKELY(across >= loop.across)) { goto beside; }

        const uint32_t depth_light = v0->depth_light;
        const int64_t z0 = depth_light >> 8, z_mid = (mid->depth_light >> 8) - z0, z_low = (low->depth_light >> 8) - z0;
        const uint32_t size_mid = textured_size((int32_t)z_mid), size_low = textured_size((int32_t)z_low),
                       apart = size_mid | size_low;
        if (TUILE_UNLIKELY((((size_mid + size_low) >> 8) + 1) * (across + loop.one) > depth_light >> 16 << loop.log2_one)) {
            goto beside;
        }

        /* x, y and light of both; y of the lowest corner, y of the other, x of the lowest, x of the other, two of them negative:
         * they multiply what is affine to its determinants */
        const sse2_longs_t corner0 = load_quad(v0) & (sse2_longs_t)corner_fields,
                           corners = WORDS(DIFFERENCES(load_quad(mid) & (sse2_longs_t)corner_fields, corner0),
                                           DIFFERENCES(load_quad(low) & (sse2_longs_t)corner_fields, corner0));
        const sse2_words_t turned = (WORDS_OF(corners, 0x1b) ^ turning[left]) - turning[left],
                           crossed = (WORDS_OF(st, 0x0b) ^ crossing[left]) - crossing[left];
        const sse2_longs_t normal = QUADS(turned, turned);
        const uint32_t area = PAIRS(corners, normal)[0];
        if (TUILE_UNLIKELY(area < 8) && 8 * (across + 4) > (loop.across + 4) * area) { goto beside; }
        const uint32_t texels = textured_size((int32_t)PAIRS(st, crossed)[0]);
        if (TUILE_UNLIKELY(!level_wanted(loop.level, texels, area)) && !loop_level_find(&loop, t, texels, area)) { goto beside; }

        const int64_t x0 = v0->x, y0 = v0->y, mid_x = mid->x - x0, mid_y = mid->y - y0, low_x = low->x - x0, low_y = low->y - y0;
        const uint32_t to_x = (uint32_t)(8 - x0) & 15;
        textured_bend_t bend = {.mid_x = mid_x,
                                .mid_y = mid_y,
                                .low_x = low_x,
                                .low_y = low_y,
                                .start = (int32_t)small_start(-(small_int_t)to_x),
                                .top = (int32_t)y0 - loop.top,
                                .left = left};
        const int32_t first = (bend.top + 15) >> 4, row_end = (bend.top + (int32_t)low_y + 15) >> 4;
        textured_side_t a, b;
        bend_rows(&bend, first, row_end, loop.height);
        if (bend_seek(&bend, &a, &b)) {
            const uint32_t row = (uint32_t)bend.row, to_y = 16 * row - (uint32_t)bend.top,
                           reciprocal = (uint32_t)divide_area((int32_t)area);
            const face_map_t map = map_make(&loop, PAIRS(LONGS(st, st), normal), reciprocal, c0, to_x, to_y, row - (uint32_t)first);

            /* depth and light; a determinant that turns the other way changes its sign */
            const sse2_longs_t lights = PAIRS(LONGS_OF(corners, 0xaa), normal);
            const int64_t flip = (int64_t)left - 1;
            int64_t light_x = (int32_t)lights[0], light_y = (int64_t)((sse2_quads_t)lights)[0] >> 32,
                    depth_x = ((z_low * mid_y - z_mid * low_y) ^ flip) - flip,
                    depth_y = ((z_mid * low_x - z_low * mid_x) ^ flip) - flip;
            if (TUILE_LIKELY(apart < (uint32_t)TRIANGLE_SMALL_DEPTH)) { /* triangle_depths_near */
                depth_x = depth_x * reciprocal >> 19;
                depth_y = depth_y * reciprocal >> 19;
                light_x = light_x * reciprocal >> 3;
                light_y = light_y * reciprocal >> 3;
            } else {
                depth_x = fixed_floor_div64(fixed_shift_left64(depth_x, 12), area);
                depth_y = fixed_floor_div64(fixed_shift_left64(depth_y, 12), area);
                light_x = fixed_floor_div64(fixed_shift_left64(light_x, 28), area);
                light_y = fixed_floor_div64(fixed_shift_left64(light_y, 28), area);
            }
            const int64_t depth = (int64_t)(depth_light & ~UINT32_C(255)) + 0x8000 + ((depth_x * to_x + depth_y * to_y) >> 4),
                          light =
                              (int64_t)(depth_light << 24) + (0x800000 + TEXTURED_BIAS) + ((light_x * to_x + light_y * to_y) >> 4);
            uint16_t *const pixel = textured_rows_at(loop.depth, row * loop.stride) + ((x0 + 7) >> 4);

            loop.rows.edges.vector = HALVES(TWO(a.x, b.x), map.at);
            loop.rows.edges_down = HALVES(TWO(a.slope, b.slope), map.steps);
            loop.rows.place.vector = (sse2_quads_t){triangle_shade_pack(depth, light), (uintptr_t)pixel};
            loop.rows.place_down = (sse2_quads_t){triangle_shade_pack(depth_y, light_y), (uint64_t)loop.stride};
            if (!known && loop.crosses) {
                loop_fill_clamped(&loop.rows, &bend, triangle_shade_pack(depth_x, light_x), map.steps[0]);
            } else if (loop.rows.palette) {
                textured_rows_fill(&loop.rows, &bend, triangle_shade_pack(depth_x, light_x), map.steps[0], true, false);
            } else {
                textured_rows_fill(&loop.rows, &bend, triangle_shade_pack(depth_x, light_x), map.steps[0], false, false);
            }
        }
        loop.count++;
        const uint32_t drawn = number;
        number = record->next - (uint32_t)1;
        if (!known && loop.crosses && t->tile_columns > 1) {
            loop_hand_on(t, walk, drawn);
        } else if (row_end > loop.height) {
            list_append(t, &walk->left, drawn);
        }
        continue;
    beside:
        if (!loop_beside(&loop, t, walk, number, record)) { break; }
        loop.count++;
        number = walk->list - (uint32_t)1;
    }
    walk->list = (uint16_t)(number + 1);
    t->stats.faces_setup += loop.count;
    if (loop.count) { t->textured_any = true; }
}

static TUILE_NOINLINE void loop_draw_known(tuile_t *t, walk_t *walk, uint32_t limit) { loop_draw(t, walk, limit, true); }
static TUILE_NOINLINE void loop_draw_any(tuile_t *t, walk_t *walk, uint32_t limit) { loop_draw(t, walk, limit, false); }

void smalls_textured_sse2(tuile_t *t, walk_t *walk, uint32_t limit) {
    if (t->tile_columns == 1 && t->small) {
        loop_draw_known(t, walk, limit);
    } else {
        loop_draw_any(t, walk, limit);
    }
}

#endif
