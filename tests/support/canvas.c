#include "canvas.h"

#include "check.h"

typedef union canvas_face_state {
    triangle_t triangle;
    polygon_t polygon;
} canvas_face_state_t;

polygon_ring_t face_ring(const canvas_face_t *face) { return (polygon_ring_t){face->vertices, face->corners, NULL, face->count}; }

const vertex_t *face_corner(const canvas_face_t *face, uint32_t i) { return &face->vertices[face->corners[i]]; }

int32_t face_area(const vertex_t *a, const vertex_t *b, const vertex_t *c) {
    return (c->x - a->x) * (b->y - a->y) - (b->x - a->x) * (c->y - a->y);
}

bool face_to_triangle(canvas_face_t *face) {
    const int32_t area = face_area(face_corner(face, 0), face_corner(face, 1), face_corner(face, 2));
    if (area == 0) { return false; }
    if (area < 0) {
        const uint8_t swap = face->corners[1];
        face->corners[1] = face->corners[2];
        face->corners[2] = swap;
    }
    uint32_t top = 0;
    for (uint32_t i = 1; i < 3; i++) {
        top = face_corner(face, i)->y < face_corner(face, top)->y ? i : top;
    }
    const uint8_t turned[3] = {face->corners[top], face->corners[(top + 1) % 3], face->corners[(top + 2) % 3]};
    memcpy(face->corners, turned, 3);
    face->as_triangle = true;
    return true;
}

static bool face_start(const canvas_face_t *face, canvas_face_state_t *state, int32_t row, span_kind_t kind) {
    int32_t bottom = INT32_MIN, top = INT32_MAX;
    for (uint32_t i = 0; i < face->count; i++) {
        bottom = face_corner(face, i)->y > bottom ? face_corner(face, i)->y : bottom;
        top = face_corner(face, i)->y < top ? face_corner(face, i)->y : top;
    }
    if (edge_row(bottom) <= row || edge_row(bottom) <= edge_row(top)) { return false; }
    memset(state, 0xa5, sizeof *state);
    if (face->as_triangle) {
        const vertex_t *v0 = face_corner(face, 0), *v1 = face_corner(face, 1), *v2 = face_corner(face, 2);
        triangle_start(&state->triangle, v0, v1, v2, row, kind == SPAN_GOURAUD);
        state->triangle.value = 1;
        return true;
    }
    const polygon_ring_t ring = face_ring(face);
    const bool any = polygon_start(&state->polygon, &ring, row);
    state->polygon.value = 1;
    return any;
}

static void face_skip(const canvas_face_t *face, canvas_face_state_t *state, int32_t row) {
    const polygon_ring_t ring = face_ring(face);
    if (face->as_triangle) {
        triangle_skip(&state->triangle, row);
    } else {
        polygon_skip(&state->polygon, &ring, row);
    }
}

/* Draws one tile from the state and copies it to the canvas. Pixels beside and behind the tile must not change. */
static void face_fill_tile(const canvas_face_t *face, canvas_face_state_t *state, canvas_t *canvas, int32_t left, int32_t top,
                           int32_t width, int32_t height, span_kind_t kind) {
    static uint16_t depth[(CANVAS_PX + 2) * CANVAS_PX], colours[(CANVAS_PX + 2) * CANVAS_PX], ramp[64];
    static uint32_t ids[(CANVAS_PX + 2) * CANVAS_PX];
    if (ramp[0] == 0) {
        for (int i = 0; i < 64; i++) {
            ramp[i] = 1;
        }
    }
    const int32_t stride = width + 2;
    memset(depth, 0, sizeof depth[0] * (size_t)(stride * height));
    memset(ids, 0, sizeof ids[0] * (size_t)(stride * height));
    memset(colours, 0, sizeof colours[0] * (size_t)(stride * height));
    const raster_tile_t tile = {depth, kind == SPAN_IDS ? (void *)ids : colours, left, top, left + width, top + height, stride};
    if (face->as_triangle) {
        if (state->triangle.row >= tile.bottom || state->triangle.row >= state->triangle.head.row_end) { return; }
        triangle_fill(&state->triangle, &tile, kind, false, ramp);
    } else {
        const polygon_ring_t ring = face_ring(face);
        polygon_fill(&state->polygon, &ring, &tile, kind == SPAN_IDS ? SPAN_IDS : SPAN_FLAT, false);
    }
    for (int32_t i = 0; kind != SPAN_IDS && i < stride * height; i++) {
        ids[i] = colours[i];
    }
    for (int32_t y = 0; y < height; y++) {
        assert_int_equal(ids[y * stride + width], 0);
        assert_int_equal(ids[y * stride + width + 1], 0);
        for (int32_t x = 0; x < width; x++) {
            const int32_t at = (top - canvas->top + y) * canvas->width + left - canvas->left + x;
            canvas->ids[at] = ids[y * stride + x];
            canvas->depth[at] = depth[y * stride + x];
        }
    }
}

void canvas_draw_kind(const canvas_face_t *face, canvas_t *canvas, int32_t tile_width, int32_t tile_height, canvas_policy_t policy,
                      span_kind_t kind) {
    canvas_face_state_t state;
    bool started = false;
    memset(canvas->ids, 0, sizeof canvas->ids[0] * (size_t)(canvas->width * canvas->height));
    memset(canvas->depth, 0, sizeof canvas->depth[0] * (size_t)(canvas->width * canvas->height));
    for (int32_t y = 0; y < canvas->height; y += tile_height) {
        const int32_t height = canvas->height - y < tile_height ? canvas->height - y : tile_height, top = canvas->top + y;
        if (policy == CANVAS_RESTART || (policy == CANVAS_CARRY && !started)) {
            started = face_start(face, &state, top, kind);
        } else if (policy == CANVAS_SKIP) {
            started = face_start(face, &state, INT16_MIN, kind);
            if (started) { face_skip(face, &state, top); }
        }
        if (!started) { continue; }
        for (int32_t x = 0; x < canvas->width; x += tile_width) {
            const int32_t width = canvas->width - x < tile_width ? canvas->width - x : tile_width;
            canvas_face_state_t copy = state;
            face_fill_tile(face, x + width < canvas->width ? &copy : &state, canvas, canvas->left + x, top, width, height, kind);
        }
    }
}

void canvas_draw(const canvas_face_t *face, canvas_t *canvas, int32_t tile_width, int32_t tile_height, canvas_policy_t policy) {
    canvas_draw_kind(face, canvas, tile_width, tile_height, policy, SPAN_IDS);
}

canvas_face_t face_of_points(const int32_t (*points)[2], uint32_t count) {
    canvas_face_t face = {.count = count};
    for (uint32_t i = 0; i < count; i++) {
        face.vertices[i] = (vertex_t){(int16_t)points[i][0], (int16_t)points[i][1], 30000u << 16 | 100u};
        face.corners[i] = (uint8_t)i;
    }
    return face;
}

enum { KIND_TINY, KIND_LOCAL, KIND_TIES, KIND_HUGE, KIND_SLIVER, KIND_DEGENERATE, KIND_OFF, KIND_WALK, KIND_COMB, KIND_COUNT };

void canvas_random_points(random_source_t *random, int32_t (*points)[2], uint32_t count, int32_t size, int32_t limit) {
    const int kind = random_between(random, 0, KIND_COUNT - 1);
    const int32_t cx = random_between(random, -16, 16 * size + 16), cy = random_between(random, -16, 16 * size + 16);
    const int32_t sx = random_between(random, -limit, limit), sy = random_between(random, -limit, limit);
    for (uint32_t i = 0; i < count; i++) {
        int32_t x = random_between(random, -64, 16 * size + 64), y = random_between(random, -64, 16 * size + 64);
        switch (kind) {
        case KIND_TINY: x = cx + random_between(random, -20, 20), y = cy + random_between(random, -20, 20); break;
        case KIND_TIES: x = CENTRE(random_between(random, -1, size)), y = CENTRE(random_between(random, -1, size)); break;
        case KIND_HUGE: x = random_between(random, -limit, limit), y = random_between(random, -limit, limit); break;
        case KIND_SLIVER: { /* along a line */
            const int32_t t = random_between(random, -1000, 1000);
            x = cx + (int32_t)((int64_t)sx * t / 1000) + random_between(random, -1, 1);
            y = cy + (int32_t)((int64_t)sy * t / 1000) + random_between(random, -1, 1);
            break;
        }
        case KIND_DEGENERATE: /* all alike, or on one row or column, now and then something else */
            if (!random_one_in(random, 4)) { x = cx; }
            if (!random_one_in(random, 3)) { y = cy; }
            break;
        case KIND_OFF: x += random_one_in(random, 2) ? limit / 2 : 0; break;
        case KIND_WALK:
            x = (i ? points[i - 1][0] : cx) + random_between(random, -40, 40);
            y = (i ? points[i - 1][1] : cy) + random_between(random, -40, 40);
            break;
        case KIND_COMB: y = i % 2 ? random_between(random, -20, 8 * size) : random_between(random, 8 * size, 16 * size + 20); break;
        default: break;
        }
        points[i][0] = x < -limit ? -limit : x > limit ? limit : x;
        points[i][1] = y < -limit ? -limit : y > limit ? limit : y;
    }
}
