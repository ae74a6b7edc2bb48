/* A face is a shape on a lattice: points (p, q) with whole coordinates, put into space as o + p u + q v with whole vectors o, u, v.
 * So every polygon is planar exactly, whatever its shape and slope. */
#include "scene_generator.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SHAPE_POINTS = 64 };

typedef struct shape {
    int32_t at[SHAPE_POINTS][2];
    int count;
} shape_t;

typedef struct lattice {
    int32_t o[3], u[3], v[3];
} lattice_t;

typedef struct text {
    char *start;
    size_t length, capacity;
    bool failed;
} text_t;

/* Marsaglia's xorshift with a multiplier; the state is never 0. */
static uint32_t next(uint64_t *state) {
    uint64_t x = *state ? *state : 0x9e3779b97f4a7c15u;
    x ^= x >> 12;
    x ^= x << 25;
    x ^= x >> 27;
    *state = x;
    return (uint32_t)((x * 0x2545f4914f6cdd1du) >> 32);
}

int32_t scene_generator_between(uint64_t *state, int32_t low, int32_t high) {
    return (int32_t)(low + (int64_t)(next(state) % ((uint32_t)(high - low) + 1u)));
}

static int between(uint64_t *state, int low, int high) { return scene_generator_between(state, low, high); }
static bool chance(uint64_t *state, int percent) { return between(state, 1, 100) <= percent; }

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
say(text_t *text, const char *format, ...) {
    char piece[160];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(piece, sizeof piece, format, arguments);
    va_end(arguments);
    if (text->failed || length < 0) { return; }
    if (text->length + (size_t)length + 1 > text->capacity) {
        size_t capacity = text->capacity * 2 + 1024;
        char *grown = realloc(text->start, capacity);
        if (!grown) {
            text->failed = true;
            return;
        }
        text->start = grown;
        text->capacity = capacity;
    }
    memcpy(text->start + text->length, piece, (size_t)length + 1);
    text->length += (size_t)length;
}

/* ---- shapes, within about +-size -------------------------------------------------------------------------- */

static void add(shape_t *shape, int p, int q) {
    shape->at[shape->count][0] = p;
    shape->at[shape->count][1] = q;
    shape->count++;
}

/* Round (cos, sin) times 128 of k 24ths of a turn. */
static void add_polar(shape_t *shape, int k, int radius) {
    static const int cosine[24] = {128,  124,  111,  91,  64,  33,  0, -33, -64, -91, -111, -124,
                                   -128, -124, -111, -91, -64, -33, 0, 33,  64,  91,  111,  124};
    add(shape, cosine[k % 24] * radius / 128, cosine[(k + 18) % 24] * radius / 128);
}

static shape_t make_rectangle(uint64_t *state, int size) {
    shape_t shape = {.count = 0};
    int p = between(state, 1, size), q = between(state, 1, size);
    add(&shape, -p, -q);
    add(&shape, p, -q);
    add(&shape, p, q);
    add(&shape, -p, q);
    return shape;
}

static shape_t make_round(uint64_t *state, int size) {
    shape_t shape = {.count = 0};
    static const int steps[] = {2, 3, 4, 8};
    int step = steps[between(state, 0, 3)], radius = between(state, size / 2 + 1, size), turn = between(state, 0, 23);
    for (int k = 0; k < 24; k += step) {
        add_polar(&shape, k + turn, radius);
    }
    return shape;
}

static shape_t make_star(uint64_t *state, int size) {
    shape_t shape = {.count = 0};
    static const int steps[] = {1, 2, 3, 4};
    int step = steps[between(state, 0, 3)], inner = between(state, 1, size / 2 + 1), turn = between(state, 0, 23);
    for (int k = 0, point = 0; k < 24; k += step, point++) {
        add_polar(&shape, k + turn, point % 2 ? inner : size);
    }
    return shape;
}

static shape_t make_comb(uint64_t *state, int size) {
    shape_t shape = {.count = 0};
    int teeth = between(state, 2, 6), back = between(state, 1, size);
    add(&shape, 0, size + 1);
    for (int k = 0; k < teeth; k++) {
        add(&shape, 2 * k * size / teeth, between(state, -size, 0));
        add(&shape, (2 * k + 1) * size / teeth, between(state, -size, 0));
        if (k + 1 < teeth) {
            add(&shape, (2 * k + 1) * size / teeth, back);
            add(&shape, (2 * k + 2) * size / teeth, back);
        }
    }
    add(&shape, (2 * teeth - 1) * size / teeth, size + 1);
    return shape;
}

static shape_t make_corner(uint64_t *state, int size) {
    shape_t shape = {.count = 0};
    int p = between(state, -size + 1, size), q = between(state, -size + 1, size);
    add(&shape, -size, -size);
    add(&shape, size + 1, -size);
    add(&shape, size + 1, q);
    add(&shape, p, q);
    add(&shape, p, size + 1);
    add(&shape, -size, size + 1);
    return shape;
}

/* A square with a square hole, cut open along one line that is walked both ways. */
static shape_t make_frame(uint64_t *state, int size) {
    shape_t shape = {.count = 0};
    int hole = between(state, 0, size - 1);
    static const int corners[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    for (int k = 0; k < 5; k++) {
        add(&shape, corners[k][0] * size, corners[k][1] * size);
    }
    for (int k = 4; k >= 0; k--) {
        add(&shape, corners[k][0] * hole, corners[k][1] * hole);
    }
    return shape;
}

static shape_t make_pentagram(uint64_t *state, int size) {
    shape_t shape = {.count = 0};
    int turn = between(state, 0, 23), points = chance(state, 50) ? 5 : 7;
    for (int k = 0; k < points; k++) {
        add_polar(&shape, turn + 24 * ((2 * k) % points) / points, size);
    }
    return shape;
}

static shape_t make_scribble(uint64_t *state, int size) {
    shape_t shape = {.count = 0};
    int count = between(state, 4, 9);
    for (int k = 0; k < count; k++) {
        add(&shape, between(state, -size, size), between(state, -size, size));
    }
    return shape;
}

static shape_t make_triangle(uint64_t *state, int size) {
    shape_t shape = {.count = 0};
    for (int k = 0; k < 3; k++) {
        add(&shape, between(state, -size, size), between(state, -size, size));
    }
    return shape;
}

static int64_t doubled_area(const int32_t a[2], const int32_t b[2], const int32_t c[2]) {
    return (int64_t)(b[0] - a[0]) * (c[1] - a[1]) - (int64_t)(b[1] - a[1]) * (c[0] - a[0]);
}

static bool has_area(const shape_t *shape) {
    for (int i = 1; i < shape->count; i++) {
        for (int j = i + 1; j < shape->count; j++) {
            if (doubled_area(shape->at[0], shape->at[i], shape->at[j]) != 0) { return true; }
        }
    }
    return false;
}

static shape_t make_shape(uint64_t *state, int size, const scene_generator_t *options) {
    shape_t shape;
    int last = options->convex ? 2 : options->simple ? 6 : 8;
    do {
        switch (between(state, 0, last)) {
        case 0: shape = make_triangle(state, size); break;
        case 1: shape = make_rectangle(state, size); break;
        case 2: shape = make_round(state, size); break;
        case 3: shape = make_star(state, size); break;
        case 4: shape = make_comb(state, size); break;
        case 5: shape = make_corner(state, size); break;
        case 6: shape = make_frame(state, size); break;
        case 7: shape = make_pentagram(state, size); break;
        default: shape = make_scribble(state, size); break;
        }
    } while (!has_area(&shape));
    return shape;
}

/* ---- places ----------------------------------------------------------------------------------------------- */

static bool span_a_plane(const lattice_t *lattice) {
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        if (lattice->u[i] * lattice->v[j] != lattice->u[j] * lattice->v[i]) { return true; }
    }
    return false;
}

static void make_slope(uint64_t *state, lattice_t *lattice) {
    int kind = between(state, 0, 9);
    do {
        for (int i = 0; i < 3; i++) {
            lattice->u[i] = i == 0;
            lattice->v[i] = i == 1;
        }
        if (kind >= 3) { /* slanted */
            lattice->u[2] = between(state, -3, 3);
            lattice->v[2] = between(state, -3, 3);
        }
        if (kind >= 7) { /* any way, edge-on too */
            for (int i = 0; i < 3; i++) {
                lattice->u[i] = between(state, -2, 2);
                lattice->v[i] = between(state, -2, 2);
            }
        }
    } while (!span_a_plane(lattice));
}

typedef struct world {
    bool perspective;
    int width, height;
    int near; /* perspective: the least whole Z that is not cut */
    int focal, y_sign;
    int origin[2];
} world_t;

static void make_place(uint64_t *state, const world_t *world, const scene_generator_t *options, lattice_t *lattice, int *size) {
    int span = world->width > world->height ? world->width : world->height;
    make_slope(state, lattice);
    if (!world->perspective) {
        lattice->o[0] = between(state, -span / 4, world->width + span / 4);
        lattice->o[1] = between(state, -span / 4, world->height + span / 4);
        lattice->o[2] = between(state, -40, 40);
        *size = between(state, 1, span);
        return;
    }
    int z = between(state, world->near, 120);
    if (!options->no_near_cut && chance(state, 35)) {
        z = chance(state, 60) ? between(state, world->near - 2, world->near + 6) : between(state, -40, 0);
    }
    /* Aim at a place in or near the window, wherever the eye would see it from. */
    int reach = z > 0 ? z : -z + 4;
    lattice->o[0] = (between(state, 0, world->width) - world->origin[0]) * reach / world->focal;
    lattice->o[1] = world->y_sign * (between(state, 0, world->height) - world->origin[1]) * reach / world->focal;
    lattice->o[2] = z;
    int largest = span * reach / world->focal + 2;
    *size = between(state, 1, largest < 200 ? largest : 200);
}

static void to_space(const lattice_t *lattice, const int32_t at[2], int32_t vertex[3]) {
    for (int i = 0; i < 3; i++) {
        vertex[i] = lattice->o[i] + at[0] * lattice->u[i] + at[1] * lattice->v[i];
    }
}

static int least_z(const lattice_t *lattice, const shape_t *shape) {
    int least = INT32_MAX;
    for (int i = 0; i < shape->count; i++) {
        int32_t vertex[3];
        to_space(lattice, shape->at[i], vertex);
        least = vertex[2] < least ? vertex[2] : least;
    }
    return least;
}

static void write_faces(text_t *text, uint64_t *state, const world_t *world, const scene_generator_t *options) {
    int faces = options->faces ? options->faces : between(state, 1, 12), size = 1;
    lattice_t lattice = {{0}, {0}, {0}};
    shape_t shape = {.count = 0};
    for (int k = 0; k < faces; k++) {
        bool repeat = k > 0 && chance(state, 20) && !options->no_coplanar, nested = k > 0 && !repeat && chance(state, 12);
        if (nested) { /* the same shape, behind or before */
            lattice.o[2] += between(state, 1, 9) * (chance(state, 50) ? 1 : -1);
        } else if (repeat) { /* the same plane, another shape and place in it */
            int p = between(state, -size, size), q = between(state, -size, size);
            for (int i = 0; i < 3; i++) {
                lattice.o[i] += p * lattice.u[i] + q * lattice.v[i];
            }
            shape = make_shape(state, size, options);
        } else {
            make_place(state, world, options, &lattice, &size);
            shape = make_shape(state, size, options);
        }
        if (world->perspective && options->no_near_cut && least_z(&lattice, &shape) < world->near) {
            lattice.o[2] += world->near - least_z(&lattice, &shape);
        }
        for (int i = 0; i < 3; i++) { /* a chain of repeats must not wander off */
            lattice.o[i] = lattice.o[i] > 2000 ? 2000 : lattice.o[i] < -2000 ? -2000 : lattice.o[i];
        }
        say(text, "poly %d", chance(state, 5) ? between(state, 1, faces) : k + 1);
        for (int i = 0; i < shape.count; i++) {
            int32_t vertex[3];
            to_space(&lattice, shape.at[i], vertex);
            say(text, " %d,%d,%d", (int)vertex[0], (int)vertex[1], (int)vertex[2]);
        }
        say(text, "\n");
    }
}

char *scene_generate(uint64_t seed, const scene_generator_t *given) {
    static const char *const samples[] = {"0 0", "1/2 1/2", "0.25 3/4", "7/8 0"};
    scene_generator_t options = given ? *given : (scene_generator_t){.faces = 0};
    text_t text = {.start = NULL};
    uint64_t state = seed * 0x9e3779b97f4a7c15u + 0x632be59bd9b4e019u;
    for (int i = 0; i < 4; i++) {
        (void)next(&state);
    }
    world_t world = {
        .perspective = options.no_orthographic || (!options.no_perspective && chance(&state, 50)),
        .width = options.width ? options.width : between(&state, 1, 48),
        .height = options.height ? options.height : between(&state, 1, 48),
        .near = 1,
        .y_sign = 1,
    };
    say(&text, "# seed %llu\nscreen %d %d\n", (unsigned long long)seed, world.width, world.height);
    if (world.perspective) {
        static const struct {
            const char *text;
            int least; /* whole Z not cut */
        } nears[] = {{"", 1}, {" 1", 1}, {" 2", 2}, {" 3/2", 2}, {" 5", 5}};
        int near = between(&state, 0, 4);
        world.near = nears[near].least;
        world.focal = between(&state, 4, 2 * (world.width > world.height ? world.width : world.height) + 8);
        world.origin[0] = world.width / 2;
        world.origin[1] = world.height / 2;
        say(&text, "camera persp %d%s\n", world.focal, nears[near].text);
        if (chance(&state, 40)) {
            int twice_x = between(&state, 0, 2 * world.width), twice_y = between(&state, 0, 2 * world.height);
            world.origin[0] = twice_x / 2;
            world.origin[1] = twice_y / 2;
            say(&text, "origin %d/2 %d.%d\n", twice_x, twice_y / 2, twice_y % 2 * 5);
        }
        if (chance(&state, 50)) {
            world.y_sign = chance(&state, 60) ? -1 : 1;
            say(&text, "ysign %d\n", world.y_sign);
        }
    } else {
        say(&text, "camera ortho\n");
        if (chance(&state, 66)) { say(&text, "near %s\n", chance(&state, 60) ? "max" : "min"); }
    }
    if (chance(&state, 75)) { say(&text, "sample %s\n", samples[between(&state, 0, 3)]); }
    if (chance(&state, 50)) { say(&text, "tie %s\n", chance(&state, 60) ? "last" : "first"); }
    write_faces(&text, &state, &world, &options);
    if (text.failed) {
        free(text.start);
        return NULL;
    }
    return text.start;
}
