#include "twins_faces.h"

vertex_t faces_vertices[3 * FACES];
tuile_t t;

void faces_random_tile(random_source_t *random, faces_pixels_t *pixels) {
    const int32_t width = random_between(random, random_one_in(random, 2) ? 4 : 34, SIDE), height = random_between(random, 1, SIDE);
    const bool columns = random_one_in(random, 3);
    const int32_t column = columns ? random_between(random, 0, 2) : 0;
    const int32_t top = random_one_in(random, 2) ? 0 : random_between(random, 0, 1900);
    t.config.tile_width = (uint16_t)width;
    t.tile_columns = columns ? 3 : 1;
    t.tile = (raster_tile_t){.depth = pixels->depth + AROUND,
                             .colour = pixels->colour + AROUND,
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

bool faces_short(const vertex_t *v) {
    for (int i = 0; i < 3; i++) {
        const int32_t x = v[i].x - v[(i + 1) % 3].x, y = v[i].y - v[(i + 1) % 3].y;
        if (x >= SHORT_SIDE || x <= -SHORT_SIDE || y >= SHORT_SIDE || y <= -SHORT_SIDE) { return false; }
    }
    return true;
}

bool faces_inside(const vertex_t *v) {
    for (int i = 0; i < 3; i++) {
        if (edge_row(v[i].x) < t.tile.left || edge_row(v[i].x) > t.tile.right) { return false; }
    }
    return true;
}

bool faces_further(void) { return t.tile.left + t.config.tile_width < t.tile_columns * t.config.tile_width; }

void faces_count_on(faces_on_t *on, const vertex_t *v) {
    bool right = false, below = false;
    for (int i = 0; i < 3; i++) {
        right = right || (faces_further() && edge_row(v[i].x) > t.tile.right);
        below = below || edge_row(v[i].y) > t.tile.bottom;
    }
    if (t.tile_columns == 1) { return; }
    on->right += right;
    on->below += below && !right;
    on->both += below && right;
}

record_t *faces_random_record(random_source_t *random, uint32_t number, uint16_t next, bool small, int polygon_one_in) {
    vertex_t *v = &faces_vertices[3 * number];
    record_t *record = frame_record(&t, number);
    const bool swap = random_one_in(random, 2);
    do {
        random_triangle(random, v);
    } while (((small || t.tile_columns > 1) && !faces_short(v)) || (small && t.tile_columns == 1 && !faces_inside(v)));
    *record = (record_t){.next = next, .v0 = (uint16_t)(3 * number), .d1 = 1, .d2 = 2, .light = (uint8_t)random_bits(random)};
    if (swap) { /* the corners from the last one on */
        const vertex_t corner = v[0];
        v[0] = v[2], v[2] = corner;
        record->v0 = (uint16_t)(3 * number + 2);
        record->d1 = -1, record->d2 = -2;
    }
    if (random_one_in(random, polygon_one_in)) { record->d1 = record->d2 = 0; }
    return record;
}

void faces_random_pixels(random_source_t *random, faces_pixels_t *pixels) {
    for (size_t i = 0; i < PIXELS; i++) {
        const uint32_t at = (uint32_t)(random_bits(random) % (3 * FACES));
        pixels->depth[i] = (uint16_t)(random_one_in(random, 2) ? 0 : faces_vertices[at].depth_light >> 16);
        pixels->colour[i] = (uint16_t)random_bits(random);
    }
}
