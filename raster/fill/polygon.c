#include "../tune.h"

#include "polygon.h"

typedef struct point {
    int32_t x, y;
} point_t;

static point_t ring_point(const polygon_ring_t *ring, uint32_t i) {
    if (ring->wide) { return (point_t){ring->wide[i][0], ring->wide[i][1]}; }
    const vertex_t *vertex = polygon_ring_vertex(ring, i);
    return (point_t){vertex->x, vertex->y};
}

static uint32_t ring_next(const polygon_ring_t *ring, uint32_t i) { return i + 1 == ring->count ? 0 : i + 1; }

static uint32_t ring_step(const polygon_ring_t *ring, uint32_t i, int32_t direction) {
    return direction > 0 ? ring_next(ring, i) : (i == 0 ? ring->count - 1 : i - 1);
}

/* Side i leads from corner i to the next: 1 down, -1 up, 0 when it crosses no row of centres. */
static int side_direction(const polygon_ring_t *ring, uint32_t i) {
    const int32_t from = edge_row(ring_point(ring, i).y), to = edge_row(ring_point(ring, ring_next(ring, i)).y);
    return (to > from) - (to < from);
}

static void side_start(const polygon_ring_t *ring, edge_t *edge, uint32_t upper, uint32_t lower, int32_t row) {
    const point_t a = ring_point(ring, upper), b = ring_point(ring, lower);
    if (ring->wide) {
        edge_start_wide(edge, a.x, a.y, b.x, b.y, row);
    } else {
        edge_start(edge, a.x, a.y, b.x, b.y, row);
    }
}

unsigned polygon_chains(const polygon_ring_t *ring, polygon_chain_t *chains, unsigned capacity) {
    uint32_t start = 0, i;
    int before = 0;
    unsigned count = 0;

    for (i = ring->count; i > 0 && before == 0; i--) {
        before = side_direction(ring, i - 1);
    }
    if (before == 0) { return 0; }
    for (start = 0; start < ring->count; start++) { /* the first side that turns round begins a chain */
        const int direction = side_direction(ring, start);
        if (direction != 0 && direction != before) { break; }
    }
    uint32_t side = start;
    for (uint32_t walked = 0; walked < ring->count; count++) {
        const int direction = side_direction(ring, side);
        const uint32_t first = side;
        uint32_t last = side;
        for (; walked < ring->count; walked++, side = ring_next(ring, side)) {
            const int d = side_direction(ring, side);
            if (d == -direction) { break; }
            if (d != 0) { last = side; }
        }
        if (count >= capacity) { continue; }
        polygon_chain_t *chain = &chains[count];
        const uint32_t end = ring_next(ring, last);
        chain->direction = direction;
        chain->corner = direction > 0 ? first : end;
        chain->row_first = edge_row(ring_point(ring, direction > 0 ? first : end).y);
        chain->row_end = edge_row(ring_point(ring, direction > 0 ? end : first).y);
        chain->row_turn = chain->row_first; /* no side begun yet */
    }
    return count;
}

void polygon_chain_seek(const polygon_ring_t *ring, polygon_chain_t *chain, int32_t row) {
    for (;;) {
        const uint32_t next = ring_step(ring, chain->corner, chain->direction);
        chain->row_turn = edge_row(ring_point(ring, next).y);
        if (chain->row_turn > row) {
            side_start(ring, &chain->edge, chain->corner, next, row);
            return;
        }
        chain->corner = next;
    }
}

void polygon_chain_step(const polygon_ring_t *ring, polygon_chain_t *chain, int32_t row) {
    if (row + 1 < chain->row_turn) {
        edge_step(&chain->edge);
    } else if (row + 1 < chain->row_end) {
        polygon_chain_seek(ring, chain, row + 1);
    }
}

bool polygon_crossing(const polygon_ring_t *ring, int32_t row, polygon_cursor_t *cursor) {
    bool found = false;
    int32_t best_x = 0;
    uint32_t best_side = 0;
    for (uint32_t i = 0; i < ring->count; i++) {
        const uint32_t next = ring_next(ring, i);
        const int32_t from = edge_row(ring_point(ring, i).y), to = edge_row(ring_point(ring, next).y);
        if (!(from <= row && row < to) && !(to <= row && row < from)) { continue; }
        edge_t edge;
        side_start(ring, &edge, from < to ? i : next, from < to ? next : i, row);
        const bool after = !cursor->begun || edge.x > cursor->x || (edge.x == cursor->x && i > cursor->side);
        if (after && (!found || edge.x < best_x)) {
            best_x = edge.x;
            best_side = i;
            found = true;
        }
    }
    if (found) { *cursor = (polygon_cursor_t){best_x, best_side, true}; }
    return found;
}

/* Sorted crossings of the chains that are on this row: the order of the last row is nearly right, so insertion sort it is. */
static unsigned sorted_crossings(const polygon_chain_t *chains, unsigned count, int32_t row, int32_t *crossings) {
    unsigned n = 0;
    for (unsigned c = 0; c < count; c++) {
        if (row < chains[c].row_first || row >= chains[c].row_end) { continue; }
        const int32_t x = chains[c].edge.x;
        unsigned at = n++;
        for (; at > 0 && crossings[at - 1] > x; at--) {
            crossings[at] = crossings[at - 1];
        }
        crossings[at] = x;
    }
    return n;
}

/* Chains that begin at this row or lie across it are set to it. */
static void chains_enter(const polygon_ring_t *ring, polygon_chain_t *chains, unsigned count, int32_t row, bool all) {
    for (unsigned c = 0; c < count; c++) {
        polygon_chain_t *chain = &chains[c];
        if ((all ? chain->row_first <= row : chain->row_first == row) && row < chain->row_end) {
            polygon_chain_seek(ring, chain, row);
        }
    }
}

static void chains_step(const polygon_ring_t *ring, polygon_chain_t *chains, unsigned count, int32_t row) {
    for (unsigned c = 0; c < count; c++) {
        if (chains[c].row_first <= row && row < chains[c].row_end) { polygon_chain_step(ring, &chains[c], row); }
    }
    chains_enter(ring, chains, count, row + 1, false);
}

static void rows_of(const polygon_ring_t *ring, int32_t *first, int32_t *end) {
    int32_t low = INT32_MAX, high = INT32_MIN;
    for (uint32_t i = 0; i < ring->count; i++) {
        const int32_t y = ring_point(ring, i).y;
        low = y < low ? y : low;
        high = y > high ? y : high;
    }
    *first = edge_row(low);
    *end = edge_row(high);
}

void polygon_coverage(const polygon_ring_t *ring, int32_t width, int32_t height, polygon_chain_t *chains, unsigned capacity,
                      polygon_span_fn span, void *context) {
    int32_t row, end;
    if (ring->count < 3) { return; }
    rows_of(ring, &row, &end);
    row = row < 0 ? 0 : row;
    end = end > height ? height : end;
    if (row >= end) { return; }
    unsigned count = polygon_chains(ring, chains, capacity);
    const bool stepped = count <= capacity && count <= POLYGON_CHAINS;
    if (stepped) { chains_enter(ring, chains, count, row, true); }
    for (; row < end; row++) {
        int32_t crossings[POLYGON_CHAINS];
        const unsigned n = stepped ? sorted_crossings(chains, count, row, crossings) : 0;
        polygon_cursor_t cursor = {0, 0, false};
        for (uint32_t i = 0;; i += 2) {
            int32_t from, to;
            if (stepped) {
                if (i + 1 >= n) { break; }
                from = crossings[i];
                to = crossings[i + 1];
            } else {
                if (!polygon_crossing(ring, row, &cursor)) { break; }
                from = cursor.x;
                if (!polygon_crossing(ring, row, &cursor)) { break; }
                to = cursor.x;
            }
            from = from < 0 ? 0 : from;
            to = to > width ? width : to;
            if (from < to) { span(context, row, from, to); }
        }
        if (stepped) { chains_step(ring, chains, count, row); }
    }
}

/* Gradients from the largest triangle of the fan round the first corner: for a planar polygon any would do, and the largest is the
 * least disturbed by snapping. */
bool polygon_plane(const polygon_ring_t *ring, depth_plane_t *plane) {
    const vertex_t *v0 = polygon_ring_vertex(ring, 0), *best1 = v0, *best2 = v0;
    int64_t best = 0;
    uint32_t low = UINT32_MAX, high = 0;

    for (uint32_t i = 0; i < ring->count; i++) {
        const vertex_t *v1 = polygon_ring_vertex(ring, i);
        const uint32_t depth = v1->depth_light >> 8;
        low = depth < low ? depth : low;
        high = depth > high ? depth : high;
        if (i == 0 || i + 1 == ring->count) { continue; }
        const vertex_t *v2 = polygon_ring_vertex(ring, i + 1);
        int64_t area = (int64_t)(v2->x - v0->x) * (v1->y - v0->y) - (int64_t)(v1->x - v0->x) * (v2->y - v0->y);
        area = area < 0 ? -area : area;
        if (area > best) {
            best = area;
            best1 = v1;
            best2 = v2;
        }
    }
    plane->low = (low << 8) + 0x8000; /* with the rounding half */
    plane->high = (high << 8) + 0x8000;
    if (best == 0) { return false; }
    const int32_t x1 = best1->x - v0->x, y1 = best1->y - v0->y, x2 = best2->x - v0->x, y2 = best2->y - v0->y;
    const int64_t area = (int64_t)x2 * y1 - (int64_t)x1 * y2;
    const int32_t z0 = (int32_t)(v0->depth_light >> 8), z1 = (int32_t)(best1->depth_light >> 8) - z0;
    const int32_t z2 = (int32_t)(best2->depth_light >> 8) - z0;
    const int64_t nx = (int64_t)z2 * y1 - (int64_t)z1 * y2, ny = (int64_t)z1 * x2 - (int64_t)z2 * x1; /* < 2^40 */
    const int64_t sign = area < 0 ? -1 : 1;
    plane->dx = fixed_floor_div64(fixed_shift_left64(sign * nx, 12), sign * area);
    plane->dy = fixed_floor_div64(fixed_shift_left64(sign * ny, 12), sign * area);
    /* A gradient above 2^17 steps a pixel means that the face is seen from its edge: the range decides, not the plane. */
    const int64_t steep = (int64_t)1 << 33;
    plane->dx = plane->dx > steep ? steep : plane->dx < -steep ? -steep : plane->dx;
    plane->dy = plane->dy > steep ? steep : plane->dy < -steep ? -steep : plane->dy;
    plane->z = ((int64_t)z0 << 8) + 0x8000 + ((plane->dx * (8 - v0->x) + plane->dy * (8 - v0->y)) >> 4);
    return true;
}

bool polygon_start(polygon_t *polygon, const polygon_ring_t *ring, int32_t first_row) {
    if (!polygon_paint_start(polygon, ring, first_row) || !polygon_plane(ring, &polygon->depth)) { return false; }
    polygon->depth.z += polygon->depth.dy * polygon->row;
    return true;
}

bool polygon_paint_start(polygon_t *polygon, const polygon_ring_t *ring, int32_t first_row) {
    int32_t row, end, least = INT32_MAX, most = INT32_MIN;
    rows_of(ring, &row, &end);
    row = row < first_row ? first_row : row;
    if (row >= end) { return false; }
    polygon->depth = (depth_plane_t){0, 0, 0, 0, 0};
    for (uint32_t i = 0; i < ring->count; i++) {
        const int32_t x = ring_point(ring, i).x;
        least = x < least ? x : least;
        most = x > most ? x : most;
    }
    polygon->head.left = (int16_t)edge_row(least);
    polygon->head.right = (int16_t)edge_row(most);
    polygon->row = (int16_t)row;
    polygon->head.row_end = (int16_t)end;
    const unsigned count = polygon_chains(ring, polygon->chains, POLYGON_CHAINS);
    polygon->chain_count = (uint8_t)(count > POLYGON_CHAINS ? 0 : count);
    polygon->head.size_bytes = (uint16_t)(offsetof(polygon_t, chains) + polygon->chain_count * sizeof(polygon_chain_t));
    chains_enter(ring, polygon->chains, polygon->chain_count, row, true);
    return true;
}

/* A span whose plane leaves the face's depth range somewhere: pixel by pixel, clamped. */
static TUILE_NOINLINE void span_clamped(const polygon_t *polygon, const raster_tile_t *tile, size_t at, int32_t count, int64_t z,
                                        span_kind_t kind, bool last) {
    for (; count; count--, at++, z += polygon->depth.dx) {
        const uint32_t clamped = z < polygon->depth.low    ? polygon->depth.low
                                 : z > polygon->depth.high ? polygon->depth.high
                                                           : (uint32_t)z;
        if (kind == SPAN_IDS) {
            span_ids(tile->depth + at, (uint32_t *)tile->colour + at, 1, clamped, 0, polygon->value, last);
        } else {
            span_flat(tile->depth + at, (uint16_t *)tile->colour + at, 1, clamped, 0, (uint16_t)polygon->value, last);
        }
    }
}

/* tested, kind and last are constants where this is called, so that each combination gets a loop of its own. */
TUILE_INLINE void polygon_span(const polygon_t *polygon, const raster_tile_t *tile, int32_t row, int32_t from, int32_t to,
                               bool tested, span_kind_t kind, bool last) {
    from = from < tile->left ? tile->left : from;
    to = to > tile->right ? tile->right : to;
    if (from >= to) { return; }
    const size_t at = (size_t)(row - tile->top) * (size_t)tile->stride_px + (size_t)(from - tile->left);
    if (!tested) {
        if (kind == SPAN_IDS) {
            paint_ids((uint32_t *)tile->colour + at, to - from, polygon->value);
        } else {
            paint_flat((uint16_t *)tile->colour + at, to - from, (uint16_t)polygon->value);
        }
        return;
    }
    const int64_t z = polygon->depth.z + polygon->depth.dx * from, end = polygon->depth.z + polygon->depth.dx * (to - 1);
    const int64_t low = polygon->depth.low, high = polygon->depth.high;
    if (z < low || z > high || end < low || end > high) {
        span_clamped(polygon, tile, at, to - from, z, kind, last);
    } else if (kind == SPAN_IDS) {
        span_ids(tile->depth + at, (uint32_t *)tile->colour + at, to - from, (uint32_t)z, (uint32_t)polygon->depth.dx,
                 polygon->value, last);
    } else {
        span_flat(tile->depth + at, (uint16_t *)tile->colour + at, to - from, (uint32_t)z, (uint32_t)polygon->depth.dx,
                  (uint16_t)polygon->value, last);
    }
}

TUILE_INLINE void fill_rows(polygon_t *polygon, const polygon_ring_t *ring, const raster_tile_t *tile, bool tested,
                            span_kind_t kind, bool last) {
    const int32_t end = polygon->head.row_end < tile->bottom ? polygon->head.row_end : tile->bottom;
    for (; polygon->row < end; polygon->row++) {
        const int32_t row = polygon->row;
        int32_t crossings[POLYGON_CHAINS];
        if (polygon->chain_count) {
            const unsigned n = sorted_crossings(polygon->chains, polygon->chain_count, row, crossings);
            for (unsigned i = 0; i + 1 < n; i += 2) {
                polygon_span(polygon, tile, row, crossings[i], crossings[i + 1], tested, kind, last);
            }
        } else {
            polygon_cursor_t cursor = {0, 0, false};
            while (polygon_crossing(ring, row, &cursor)) {
                const int32_t from = cursor.x;
                if (polygon_crossing(ring, row, &cursor)) { polygon_span(polygon, tile, row, from, cursor.x, tested, kind, last); }
            }
        }
        chains_step(ring, polygon->chains, polygon->chain_count, row);
        polygon->depth.z += polygon->depth.dy;
    }
}

static TUILE_NOINLINE void fill_flat(polygon_t *polygon, const polygon_ring_t *ring, const raster_tile_t *tile) {
    fill_rows(polygon, ring, tile, true, SPAN_FLAT, false);
}

static TUILE_NOINLINE void fill_any(polygon_t *polygon, const polygon_ring_t *ring, const raster_tile_t *tile, span_kind_t kind,
                                    bool last) {
    fill_rows(polygon, ring, tile, true, kind, last);
}

void polygon_fill(polygon_t *polygon, const polygon_ring_t *ring, const raster_tile_t *tile, span_kind_t kind, bool last) {
    if (kind == SPAN_FLAT && !last) {
        fill_flat(polygon, ring, tile);
    } else {
        fill_any(polygon, ring, tile, kind, last);
    }
}

void polygon_paint(polygon_t *polygon, const polygon_ring_t *ring, const raster_tile_t *tile, span_kind_t kind) {
    if (kind == SPAN_FLAT) {
        fill_rows(polygon, ring, tile, false, SPAN_FLAT, false);
    } else {
        fill_rows(polygon, ring, tile, false, SPAN_IDS, false);
    }
}

void polygon_skip(polygon_t *polygon, const polygon_ring_t *ring, int32_t target) {
    const int32_t end = polygon->head.row_end < target ? polygon->head.row_end : target;
    for (; polygon->row < end; polygon->row++) {
        chains_step(ring, polygon->chains, polygon->chain_count, polygon->row);
        polygon->depth.z += polygon->depth.dy;
    }
}
