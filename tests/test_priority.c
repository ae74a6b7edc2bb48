/* The parts of the painter's algorithm by hand: which of two faces is painted first, pieces of faces, orders of a range of records,
 * and the bands that tell which boxes may meet. */
#include "support/check.h"
#include "support/random.h"

#include "../raster/visibility/bands.h"
#include "../raster/visibility/painter.h"
#include "../raster/visibility/priority.h"

#include <math.h>

/* A pass made by hand: vertices from the beginning of the block, records from its end. */
typedef struct pass {
    tuile_t t;
    vertex_t arena[4096];
} pass_t;

static void pass_open(pass_t *pass) {
    memset(pass, 0, sizeof *pass);
    pass->t.config.width = pass->t.region.right = 64;
    pass->t.config.height = pass->t.region.bottom = 64;
    pass->t.arena = (uint8_t *)pass->arena;
    pass->t.arena_end = (uint8_t *)(pass->arena + 4096);
    pass->t.vertices = pass->arena;
    pass->t.vertex_limit = 4096;
    pass->t.record_bytes = sizeof(record_t);
}

static vertex_t corner(int x_px, int y_px, int depth_steps) {
    return (vertex_t){(int16_t)(16 * x_px), (int16_t)(16 * y_px), (uint32_t)depth_steps << 16 | 128};
}

/* Corners as x, y, depth; turned and begun as bin_triangle does. Returns the record's number; its material is the number, too. */
static uint32_t add_triangle(pass_t *pass, vertex_t a, vertex_t b, vertex_t c) {
    tuile_t *t = &pass->t;
    vertex_t *v = t->vertices + t->vertex_count;
    if ((c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y) < 0) {
        const vertex_t swap = b;
        b = c;
        c = swap;
    }
    v[0] = a, v[1] = b, v[2] = c;
    const int top = b.y < a.y && b.y <= c.y ? 1 : c.y < a.y && c.y < b.y ? 2 : 0;
    *frame_record(t, t->record_count) = (record_t){.v0 = (uint16_t)(t->vertex_count + (uint32_t)top),
                                                   .d1 = (int8_t)((top + 1) % 3 - top),
                                                   .d2 = (int8_t)((top + 2) % 3 - top),
                                                   .material = (uint8_t)t->record_count};
    t->vertex_count += 3;
    return t->record_count++;
}

/* A quad whose corners go round; all from slot v on. */
static uint32_t add_quad(pass_t *pass, const vertex_t corners[4]) {
    tuile_t *t = &pass->t;
    const uint32_t base = t->vertex_count;
    memcpy(t->vertices + base, corners, 4 * sizeof *corners);
    const polygon_slot_t slot = {4, (uint16_t)base, 0, 0};
    memcpy(t->vertices + base + 4, &slot, sizeof slot);
    *frame_record(t, t->record_count) = (record_t){.v0 = (uint16_t)(base + 4), .material = (uint8_t)t->record_count};
    t->vertex_count += 5;
    return t->record_count++;
}

static uint32_t add_rectangle(pass_t *pass, int left, int top, int right, int bottom, int depth_left, int depth_right) {
    const vertex_t corners[4] = {corner(left, top, depth_left), corner(left, bottom, depth_left),
                                 corner(right, bottom, depth_right), corner(right, top, depth_right)};
    return add_quad(pass, corners);
}

static priority_t compare(const pass_t *pass, uint32_t p, uint32_t q) {
    priority_face_t a, b;
    face_bounds_t a_bounds, b_bounds;
    priority_open(&a, &pass->t, p);
    priority_open(&b, &pass->t, q);
    priority_bounds(&pass->t, frame_record(&pass->t, p), &a_bounds);
    priority_bounds(&pass->t, frame_record(&pass->t, q), &b_bounds);
    if (!priority_boxes_meet(&a_bounds, &b_bounds)) { return PRIORITY_FREE; }
    return priority_compare(&pass->t, &a, &a_bounds, &b, &b_bounds);
}

static void expect_pair(const pass_t *pass, uint32_t p, uint32_t q, priority_t pq, priority_t qp) {
    assert_int_equal(compare(pass, p, q), pq);
    assert_int_equal(compare(pass, q, p), qp);
}

/* ---- pairs ---- */

static void faces_beside_one_another_are_free(void **state) {
    pass_t pass;
    (void)state;
    pass_open(&pass);
    const uint32_t a = add_rectangle(&pass, 0, 0, 20, 20, 100, 200), right = add_rectangle(&pass, 20, 0, 40, 20, 200, 100),
                   below = add_rectangle(&pass, 0, 20, 20, 40, 50, 300);
    expect_pair(&pass, a, right, PRIORITY_FREE, PRIORITY_FREE);
    expect_pair(&pass, a, below, PRIORITY_FREE, PRIORITY_FREE);
    expect_pair(&pass, right, below, PRIORITY_FREE, PRIORITY_FREE);
}

/* The boxes meet, the triangles do not, and each plane has corners of the other on both sides. */
static void triangles_whose_boxes_alone_meet_are_free(void **state) {
    pass_t pass;
    (void)state;
    pass_open(&pass);
    const uint32_t a = add_triangle(&pass, corner(0, 0, 100), corner(0, 30, 300), corner(30, 0, 500)),
                   b = add_triangle(&pass, corner(31, 2, 900), corner(2, 31, 100), corner(31, 31, 150));
    expect_pair(&pass, a, b, PRIORITY_FREE, PRIORITY_FREE);
}

static void a_face_behind_another_at_all_depths_is_first(void **state) {
    pass_t pass;
    (void)state;
    pass_open(&pass);
    const uint32_t far = add_rectangle(&pass, 0, 0, 20, 20, 100, 110), near = add_rectangle(&pass, 10, 10, 30, 30, 300, 310);
    expect_pair(&pass, far, near, PRIORITY_FREE, PRIORITY_AFTER);
}

/* Depths overlap: 100 ... 500 and 250 ... 280. Over x = 0 ... 10 the slanted one has 100 ... 200, over 30 ... 40 it has 400 ...
 * 500. */
static void a_face_behind_the_plane_of_another_is_first(void **state) {
    pass_t pass;
    (void)state;
    pass_open(&pass);
    const uint32_t slanted = add_rectangle(&pass, 0, 0, 40, 20, 100, 500), left = add_rectangle(&pass, 0, 4, 10, 16, 250, 280),
                   right = add_rectangle(&pass, 30, 4, 40, 16, 280, 250);
    expect_pair(&pass, slanted, left, PRIORITY_FREE, PRIORITY_AFTER);
    expect_pair(&pass, right, slanted, PRIORITY_FREE, PRIORITY_AFTER);
}

/* Each goes through the other's plane, but beside the other face: where they overlap, x and y = 8 ... 12, `across` has 116 ... 124
 * and `along` 180. */
static void faces_that_cross_planes_only_are_not_cut(void **state) {
    pass_t pass;
    (void)state;
    pass_open(&pass);
    const vertex_t slope[4] = {corner(8, 0, 220), corner(8, 40, 20), corner(12, 40, 20), corner(12, 0, 220)};
    const uint32_t across = add_rectangle(&pass, 0, 8, 40, 12, 100, 180), along = add_quad(&pass, slope);
    expect_pair(&pass, across, along, PRIORITY_FREE, PRIORITY_AFTER);
}

static void faces_that_cross_are_told(void **state) {
    pass_t pass;
    (void)state;
    pass_open(&pass);
    const uint32_t a = add_rectangle(&pass, 0, 0, 40, 20, 100, 500), b = add_rectangle(&pass, 0, 4, 40, 16, 500, 100),
                   c = add_triangle(&pass, corner(0, 0, 300), corner(0, 40, 300), corner(40, 0, 320));
    expect_pair(&pass, a, b, PRIORITY_CROSSED, PRIORITY_CROSSED);
    expect_pair(&pass, a, c, PRIORITY_CROSSED, PRIORITY_CROSSED);
}

static void of_equally_deep_faces_the_tie_rule_tells(void **state) {
    pass_t pass;
    (void)state;
    for (unsigned tie = 0; tie < 2; tie++) {
        pass_open(&pass);
        pass.t.config.tie = (uint8_t)tie;
        const uint32_t a = add_rectangle(&pass, 0, 0, 20, 20, 300, 300), b = add_rectangle(&pass, 10, 10, 30, 30, 300, 300),
                       c = add_rectangle(&pass, 0, 0, 20, 20, 300, 300);
        const priority_t first = tie ? PRIORITY_FREE : PRIORITY_AFTER, second = tie ? PRIORITY_AFTER : PRIORITY_FREE;
        expect_pair(&pass, a, b, first, second);
        expect_pair(&pass, a, c, first, second);
        expect_pair(&pass, b, c, first, second);
    }
}

/* Triangles of a mesh share corners: depths are equal there, and nothing is hidden. */
static void neighbours_in_a_mesh_are_free(void **state) {
    pass_t pass;
    (void)state;
    pass_open(&pass);
    const vertex_t middle = corner(20, 20, 300), a = corner(0, 10, 100), b = corner(30, 0, 280), c = corner(40, 33, 500);
    const uint32_t one = add_triangle(&pass, middle, a, b), two = add_triangle(&pass, middle, b, c),
                   three = add_triangle(&pass, middle, c, a);
    expect_pair(&pass, one, two, PRIORITY_FREE, PRIORITY_FREE);
    expect_pair(&pass, two, three, PRIORITY_FREE, PRIORITY_FREE);
    expect_pair(&pass, three, one, PRIORITY_FREE, PRIORITY_FREE);
}

/* ---- pieces ---- */

static vertex_t random_corner(random_source_t *random) {
    vertex_t v = corner(0, 0, random_between(random, 2, 60000));
    v.x = (int16_t)random_between(random, -100, 1123);
    v.y = (int16_t)random_between(random, -100, 1123);
    return v;
}

static uint32_t random_triangle(pass_t *pass, random_source_t *random) {
    for (;;) {
        const vertex_t a = random_corner(random), b = random_corner(random), c = random_corner(random);
        if ((c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y) != 0) { return add_triangle(pass, a, b, c); }
    }
}

typedef struct inside {
    uint8_t pixel[64][64];
} inside_t;

static void mark(void *context, int32_t row, int32_t first, int32_t end) {
    inside_t *inside = context;
    memset(&inside->pixel[row][first], 1, (size_t)(end - first));
}

/* Of a face that is cut again and again each covered pixel is in exactly one piece, bounds included, and on the right side. */
static void pieces_share_no_pixel_and_leave_none_out(void **state) {
    random_source_t random = random_seed(11);
    unsigned pixels = 0;
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(400); round++) {
        pass_t pass;
        pass_open(&pass);
        const uint32_t face = random_triangle(&pass, &random);
        const record_t whole = *frame_record(&pass.t, face);
        uint32_t others[3];
        for (unsigned k = 0; k < 3; k++) {
            others[k] = random_triangle(&pass, &random);
        }
        const uint32_t first_piece = pass.t.record_count;
        for (unsigned k = 0; k < 4; k++) { /* all pieces so far, by a face or, the last time, between pixels */
            const uint32_t count = pass.t.record_count;
            for (uint32_t number = face; number < count; number = number == face ? first_piece : number + 1) {
                face_bounds_t bounds;
                const record_t *record = frame_record(&pass.t, number);
                priority_bounds(&pass.t, record, &bounds);
                const uint32_t added = pass.t.record_count++;
                const uint8_t *end = (const uint8_t *)frame_record(&pass.t, added);
                const int result =
                    k < 3
                        ? piece_cut(&pass.t, number, added, &bounds, frame_record(&pass.t, others[k]), 0, true, end)
                        : piece_cut_at(&pass.t, number, added, &bounds, (int)(round % 2), (bounds.left + bounds.right) / 2, 0, end);
                assert_int_equal(result, FRAME_OK);
            }
        }
        inside_t inside = {{{0}}};
        uint8_t list[3];
        polygon_chain_t chains[4];
        const polygon_ring_t ring = piece_ring(&pass.t, &whole, list);
        polygon_coverage(&ring, 64, 64, chains, 4, mark, &inside);
        for (int32_t y = 0; y < 64; y++) {
            uint8_t in[64] = {0};
            for (uint32_t number = face; number < pass.t.record_count; number = number == face ? first_piece : number + 1) {
                uint32_t mask[PIECE_MASK_WORDS];
                piece_mask(&pass.t, frame_record(&pass.t, number), y, 0, 64, mask);
                for (int32_t x = 0; x < 64; x++) {
                    in[x] = (uint8_t)(in[x] + piece_mask_bit(mask, x));
                }
            }
            for (int32_t x = 0; x < 64; x++) {
                if (inside.pixel[y][x] && in[x] != 1) { fail_msg("round %u, pixel %d,%d: in %u pieces", round, x, y, in[x]); }
                pixels += inside.pixel[y][x];
            }
        }
    }
    assert_true(pixels > 0);
}

/* The piece behind a face is free of it, the one before it comes after it, and neither crosses it. */
static void a_piece_is_on_its_side_of_the_face_that_cut_it(void **state) {
    pass_t pass;
    (void)state;
    pass_open(&pass);
    const uint32_t a = add_rectangle(&pass, 0, 0, 40, 20, 100, 500), b = add_rectangle(&pass, 0, 4, 40, 16, 500, 100);
    face_bounds_t bounds;
    priority_bounds(&pass.t, frame_record(&pass.t, a), &bounds);
    const uint32_t added = pass.t.record_count++;
    assert_int_equal(piece_cut(&pass.t, a, added, &bounds, frame_record(&pass.t, b), 0, true, pass.t.arena_end - 64), FRAME_OK);
    expect_pair(&pass, a, b, PRIORITY_FREE, PRIORITY_AFTER);
    expect_pair(&pass, added, b, PRIORITY_AFTER, PRIORITY_FREE);
    expect_pair(&pass, a, added, PRIORITY_FREE, PRIORITY_FREE);
    /* They meet at x = 20, at the depth of 300. */
    const face_bounds_t *behind = &frame_record_piece(&pass.t, frame_record(&pass.t, a))->bounds,
                        *before = &frame_record_piece(&pass.t, frame_record(&pass.t, added))->bounds;
    assert_int_equal(behind->left, 0);
    assert_in_range(behind->right, 20, 21);
    assert_in_range(before->left, 19, 20);
    assert_int_equal(before->right, 40);
}

static void a_cut_without_room_is_full(void **state) {
    pass_t pass;
    (void)state;
    for (unsigned slots = 0; slots < 20; slots++) {
        pass_open(&pass);
        const uint32_t a = add_rectangle(&pass, 0, 0, 40, 20, 100, 500), b = add_rectangle(&pass, 0, 4, 40, 16, 500, 100);
        face_bounds_t bounds;
        priority_bounds(&pass.t, frame_record(&pass.t, a), &bounds);
        const uint32_t added = pass.t.record_count++;
        const vertex_t *end = pass.t.vertices + pass.t.vertex_count + slots;
        /* A cut, a piece of four slots and four corners, twice. */
        assert_int_equal(piece_cut(&pass.t, a, added, &bounds, frame_record(&pass.t, b), 0, true, (const uint8_t *)end),
                         slots < 2 * (1 + 4 + 4) ? FRAME_FULL : FRAME_OK);
        assert_true(pass.t.vertices + pass.t.vertex_count <= end);
    }
}

/* ---- pairs that lie close together ---- */

/* A plane, z in 1/256 step at points in sixteenths of a pixel. */
typedef struct slope {
    double z, dx, dy;
} slope_t;

/* A corner of the plane that was somewhere else before it was snapped. */
static vertex_t snapped(random_source_t *random, const slope_t *slope) {
    const double x = random_real(random, -64, 1088), y = random_real(random, -64, 1088);
    const double z = slope->z + slope->dx * x + slope->dy * y;
    return (vertex_t){(int16_t)lround(x), (int16_t)lround(y),
                      (uint32_t)lround(z < 512        ? 512
                                       : z > 16000000 ? 16000000
                                                      : z)
                              << 8 |
                          9};
}

static uint32_t random_face(pass_t *pass, random_source_t *random, const slope_t *slope) {
    for (;;) {
        vertex_t v[4];
        for (unsigned i = 0; i < 4; i++) {
            v[i] = snapped(random, slope);
        }
        const bool area = (v[2].x - v[0].x) * (v[1].y - v[0].y) - (v[1].x - v[0].x) * (v[2].y - v[0].y) != 0;
        if (area) { return random_one_in(random, 2) ? add_quad(pass, v) : add_triangle(pass, v[0], v[1], v[2]); }
    }
}

typedef struct drawn {
    inside_t inside;
    depth_plane_t plane;
} drawn_t;

/* The pixels of a record and the plane that a z-buffer follows. */
static void draw(const pass_t *pass, uint32_t number, drawn_t *drawn) {
    const record_t *record = frame_record(&pass->t, number), whole = frame_record_face(&pass->t, record);
    polygon_chain_t chains[4];
    uint8_t list[3];
    const polygon_ring_t ring = piece_ring(&pass->t, &whole, list);
    memset(drawn, 0, sizeof *drawn);
    polygon_coverage(&ring, 64, 64, chains, 4, mark, &drawn->inside);
    if (frame_record_is_triangle(&whole)) {
        const vertex_t *v0 = &pass->t.vertices[whole.v0];
        triangle_planes(v0, v0 + whole.d1, v0 + whole.d2, &drawn->plane, NULL);
    } else {
        (void)polygon_plane(&ring, &drawn->plane);
    }
    for (int32_t y = 0; y < 64 && frame_record_is_piece(record); y++) {
        uint32_t mask[PIECE_MASK_WORDS];
        piece_mask(&pass->t, record, y, 0, 64, mask);
        for (int32_t x = 0; x < 64; x++) {
            drawn->inside.pixel[y][x] &= (uint8_t)piece_mask_bit(mask, x);
        }
    }
}

/* What is told of two faces agrees with each pixel of both. */
static void expect_pixels(const pass_t *pass, uint32_t p, uint32_t q, unsigned round) {
    static drawn_t a, b;
    const priority_t priority = compare(pass, p, q);
    draw(pass, p, &a);
    draw(pass, q, &b);
    for (int32_t y = 0; y < 64; y++) {
        for (int32_t x = 0; x < 64; x++) {
            if (!a.inside.pixel[y][x] || !b.inside.pixel[y][x]) { continue; }
            const uint16_t depth_a = depth_at(&a.plane, x, y), depth_b = depth_at(&b.plane, x, y);
            const bool seen = depth_a > depth_b || (depth_a == depth_b && p < q);
            if (seen ? priority == PRIORITY_FREE : priority == PRIORITY_AFTER) {
                fail_msg("round %u, pixel %d,%d: depths %u and %u, but %s", round, x, y, depth_a, depth_b,
                         seen ? "p is said to hide nothing" : "p is said to be nearer");
            }
        }
    }
}

/* Planes that differ by a few steps, flat and steep, corners off them by snapping; whole faces and pieces of them. */
static void pairs_agree_with_every_pixel(void **state) {
    random_source_t random = random_seed(21);
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(6000); round++) {
        const double steep = round % 3 == 0 ? 1 : round % 3 == 1 ? 30 : 3000;
        const slope_t one = {8e6, random_real(&random, -steep, steep), random_real(&random, -steep, steep)},
                      other = {one.z + random_real(&random, -900, 900), one.dx + random_real(&random, -1, 1), one.dy},
                      across = {one.z, -one.dx, random_real(&random, -steep, steep)};
        pass_t pass;
        pass_open(&pass);
        const uint32_t p = random_face(&pass, &random, &one), q = random_face(&pass, &random, &other),
                       by = random_face(&pass, &random, &across);
        expect_pixels(&pass, p, q, round);
        expect_pixels(&pass, q, p, round);
        face_bounds_t bounds;
        priority_bounds(&pass.t, frame_record(&pass.t, p), &bounds);
        if (bounds.left >= bounds.right || bounds.top >= bounds.bottom) { continue; }
        const uint32_t added = pass.t.record_count++;
        assert_int_equal(piece_cut(&pass.t, p, added, &bounds, frame_record(&pass.t, by), (uint16_t)p, true,
                                   (const uint8_t *)frame_record(&pass.t, added)),
                         FRAME_OK);
        expect_pixels(&pass, p, q, round);
        expect_pixels(&pass, q, p, round);
        expect_pixels(&pass, p, by, round);
    }
}

/* ---- orders ---- */

/* Records 1 ... 4 of six are put in order, which cuts two of them; the others stay, those behind moved up. */
static void a_range_of_records_is_put_in_order(void **state) {
    pass_t pass;
    (void)state;
    pass_open(&pass);
    (void)add_rectangle(&pass, 0, 0, 40, 40, 900, 900);
    (void)add_rectangle(&pass, 0, 0, 40, 40, 400, 400);
    (void)add_rectangle(&pass, 0, 0, 40, 40, 200, 200);
    (void)add_rectangle(&pass, 0, 10, 40, 12, 350, 250);
    (void)add_rectangle(&pass, 0, 8, 40, 16, 250, 350);
    (void)add_rectangle(&pass, 0, 0, 40, 40, 800, 800);
    assert_int_equal(painter_order(&pass.t, 1, 5), FRAME_OK);
    assert_int_equal(pass.t.record_count, 7);
    assert_int_equal(pass.t.stats.splits, 1);
    const unsigned expected[7] = {0, 2, 3, 4, 3, 1, 5}; /* 3 is the smaller one of the two that cross */
    for (unsigned i = 0; i < 7; i++) {
        assert_int_equal(frame_record(&pass.t, i)->material, expected[i]);
    }
    assert_true(frame_record_is_piece(frame_record(&pass.t, 2)) && frame_record_is_piece(frame_record(&pass.t, 4)));
}

/* Any order that comes out has each record once, and no face after one that it is hidden by. */
static void any_order_is_one_from_back_to_front(void **state) {
    random_source_t random = random_seed(5);
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(100); round++) {
        pass_t pass;
        pass_open(&pass);
        for (unsigned k = 0; k < 25; k++) { /* flat ones: there are no cycles and no crossings, and some ties */
            const int left = random_between(&random, 0, 40), top = random_between(&random, 0, 40),
                      depth = random_between(&random, 2, 30);
            (void)add_rectangle(&pass, left, top, left + random_between(&random, 1, 20), top + random_between(&random, 1, 20),
                                depth, depth);
        }
        assert_int_equal(painter_order(&pass.t, 0, 25), FRAME_OK);
        assert_int_equal(pass.t.record_count, 25);
        unsigned seen = 0;
        for (unsigned i = 0; i < 25; i++) {
            const record_t *record = frame_record(&pass.t, i);
            const polygon_ring_t ring = frame_record_ring(&pass.t, record);
            seen |= 1u << record->material;
            for (unsigned k = i + 1; k < 25; k++) {
                const record_t *later = frame_record(&pass.t, k);
                const polygon_ring_t other = frame_record_ring(&pass.t, later);
                const vertex_t *a = ring.vertices, *b = other.vertices; /* corners 0 and 2 are opposite */
                const bool meet = a[0].x < b[2].x && b[0].x < a[2].x && a[0].y < b[2].y && b[0].y < a[2].y;
                if (meet) {
                    assert_true(a->depth_light < b->depth_light ||
                                (a->depth_light == b->depth_light && record->material > later->material));
                }
            }
        }
        assert_int_equal(seen, (1u << 25) - 1);
    }
}

/* ---- bands ---- */

static face_bounds_t random_box(random_source_t *random, const face_bounds_t *all) {
    face_bounds_t box = {0};
    box.left = (int16_t)random_between(random, all->left, all->right - 1);
    box.right = (int16_t)random_between(random, box.left + 1, all->right);
    box.top = (int16_t)random_between(random, all->top, all->bottom - 1);
    box.bottom = (int16_t)random_between(random, box.top + 1, all->bottom);
    return box;
}

static void bands_tell_all_boxes_that_meet(void **state) {
    random_source_t random = random_seed(3);
    (void)state;
    for (unsigned round = 0; round < CHECK_ROUNDS(64); round++) {
        static uint32_t memory[4 * 32];
        const face_bounds_t all = {(int16_t)random_between(&random, 0, 100),
                                   (int16_t)random_between(&random, 0, 100),
                                   (int16_t)random_between(&random, 101, 1024),
                                   (int16_t)random_between(&random, 101, 1024),
                                   0,
                                   0};
        face_bounds_t boxes[128];
        uint32_t count = 0;
        bands_t bands;
        assert_true(bands_bytes(128) <= sizeof memory);
        bands_open(&bands, memory, 128, &all);
        for (; count < 60; count++) {
            boxes[count] = random_box(&random, &all);
            bands_set(&bands, count, &boxes[count], true);
        }
        for (; count < 128; count++) {
            const uint32_t at = (uint32_t)random_between(&random, 0, (int32_t)count - 1);
            memmove(&boxes[at + 1], &boxes[at], (count - at) * sizeof *boxes);
            bands_insert(&bands, at, count);
        }
        for (unsigned k = 0; k < 20; k++) {
            const face_bounds_t box = random_box(&random, &all);
            for (uint32_t i = 0; i < count; i++) {
                const bool near = bands_near(&bands, i / 32, &box) >> (i % 32) & 1u;
                if (priority_boxes_meet(&box, &boxes[i])) { assert_true(near); }
            }
            bands_set(&bands, k, &boxes[k], false);
            assert_int_equal(bands_near(&bands, 0, &all) >> k & 1u, 0);
            boxes[k] = (face_bounds_t){0};
        }
    }
}

/* A window of 160 x 160 pixels has bands of 16. */
static void boxes_in_other_bands_are_not_told(void **state) {
    uint32_t memory[32];
    bands_t bands;
    const face_bounds_t all = {0, 0, 160, 160, 0, 0}, box = {16, 32, 32, 48, 0, 0};
    (void)state;
    bands_open(&bands, memory, 32, &all);
    bands_set(&bands, 7, &box, true);
    assert_int_equal(bands_near(&bands, 0, &(const face_bounds_t){31, 47, 40, 50, 0, 0}), 1u << 7);
    assert_int_equal(bands_near(&bands, 0, &(const face_bounds_t){32, 32, 48, 48, 0, 0}), 0);
    assert_int_equal(bands_near(&bands, 0, &(const face_bounds_t){16, 48, 32, 64, 0, 0}), 0);
    assert_int_equal(bands_near(&bands, 0, &(const face_bounds_t){0, 0, 16, 160, 0, 0}), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_beside_one_another_are_free),
        cmocka_unit_test(triangles_whose_boxes_alone_meet_are_free),
        cmocka_unit_test(a_face_behind_another_at_all_depths_is_first),
        cmocka_unit_test(a_face_behind_the_plane_of_another_is_first),
        cmocka_unit_test(faces_that_cross_planes_only_are_not_cut),
        cmocka_unit_test(faces_that_cross_are_told),
        cmocka_unit_test(of_equally_deep_faces_the_tie_rule_tells),
        cmocka_unit_test(neighbours_in_a_mesh_are_free),
        cmocka_unit_test(pieces_share_no_pixel_and_leave_none_out),
        cmocka_unit_test(a_piece_is_on_its_side_of_the_face_that_cut_it),
        cmocka_unit_test(a_cut_without_room_is_full),
        cmocka_unit_test(pairs_agree_with_every_pixel),
        cmocka_unit_test(a_range_of_records_is_put_in_order),
        cmocka_unit_test(any_order_is_one_from_back_to_front),
        cmocka_unit_test(bands_tell_all_boxes_that_meet),
        cmocka_unit_test(boxes_in_other_bands_are_not_told),
    };
    return cmocka_run_group_tests_name("priority", tests, NULL, NULL);
}
