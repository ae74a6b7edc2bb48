#include "edge_table.h"

enum { SIDE_12, SIDE_23, SIDE_13 };

/* x = floor((base + j * step) / d), and what a row adds to it. j * step <= 2^60. */
static void rows_start(edge_t *rows, int32_t base, int32_t step, int32_t d, int32_t j) {
    const int64_t numerator = base + (int64_t)j * step;
    rows->x = (int32_t)fixed_floor_div64(numerator, d);
    rows->n = (int32_t)(numerator - (int64_t)rows->x * d);
    rows->q = step / d;
    rows->r = step % d;
    rows->d = d;
}

/* y0 <= row <= y1. */
static void side_start(edge_side_t *side, const int32_t from[2], const int32_t to[2], int32_t row) {
    const int32_t dx = to[0] - from[0], width = dx < 0 ? -dx : dx, height = to[1] - from[1], j = row - from[1];
    *side = (edge_side_t){.x0 = from[0], .y0 = from[1], .x1 = to[0], .y1 = to[1], .flat = width > height};
    if (!side->flat) {
        rows_start(&side->rows, height / 2, width, height ? height : 1, j);
    } else if (height == 0) {
        side->rows.x = width + 1;
    } else { /* the run of row j begins at ceil((j * width - width / 2) / height), line.h */
        const int32_t base = height - 1 - width / 2;
        rows_start(&side->rows, base, width, height, j);
        side->begin = side->rows.x < 0 ? 0 : side->rows.x;
        edge_step(&side->rows); /* at most 1.5 * 2^30 + 1 */
    }
}

static void side_step(edge_side_t *side) {
    side->begin = side->rows.x;
    edge_step(&side->rows);
}

static int32_t least(int32_t a, int32_t b) { return a < b ? a : b; }
static int32_t most(int32_t a, int32_t b) { return a > b ? a : b; }

/* The x that the side has on this row. */
static int32_t side_pick(const edge_side_t *side, int32_t row, edge_policy_t policy, bool is_left) {
    const int32_t sign = side->x1 > side->x0 ? 1 : -1, width = (side->x1 - side->x0) * sign;
    const int32_t begin = side->flat ? side->begin : side->rows.x;
    const int32_t end = side->flat ? least(side->rows.x - 1, width) : side->rows.x;
    const int32_t first = side->x0 + sign * begin, last = side->x0 + sign * end;
    switch (policy) {
    case EDGE_ENDS: return row == side->y0 ? side->x0 : row == side->y1 ? side->x1 : last;
    case EDGE_OUTER: return is_left ? least(first, last) : most(first, last);
    case EDGE_INNER: return is_left ? most(first, last) : least(first, last);
    case EDGE_MID: return (first + last) >> 1; /* |sum| <= 2^30 */
    case EDGE_DOCUMENT:
    case EDGE_UPWARDS:
    default: return last;
    }
}

/* The bent border on this row, which both its sides have when it is P2's. */
static int32_t bent_pick(const edge_table_t *table) {
    const edge_side_t *a = &table->side[SIDE_12], *b = &table->side[SIDE_23];
    const int32_t row = table->row;
    const edge_policy_t policy = table->policy;
    bool in_a = row <= a->y1, in_b = row >= b->y0;
    if (in_a && in_b && policy != EDGE_DOCUMENT) { /* a side in one row is left to the other */
        in_a = a->y0 < a->y1;
        in_b = b->y0 < b->y1;
    }
    if (!in_b) { return side_pick(a, row, policy, table->bends_left); }
    const int32_t x = side_pick(b, row, policy, table->bends_left);
    if (!in_a || (policy != EDGE_OUTER && policy != EDGE_INNER)) { return x; }
    const int32_t other = side_pick(a, row, policy, table->bends_left);
    return (policy == EDGE_OUTER) == table->bends_left ? least(x, other) : most(x, other);
}

/* Corners by y; of equal ones the first given stays first. */
static void sort(const int32_t *sorted[3], const int32_t corners[3][2]) {
    for (int i = 0; i < 3; i++) {
        int at = i;
        for (; at > 0 && sorted[at - 1][1] > corners[i][1]; at--) {
            sorted[at] = sorted[at - 1];
        }
        sorted[at] = corners[i];
    }
}

bool edge_table_start(edge_table_t *table, const int32_t corners[3][2], edge_policy_t policy, int32_t first_row) {
    const int32_t *p[3] = {corners[0], corners[0], corners[0]};
    sort(p, corners);
    if (p[2][1] < first_row) { return false; }
    const int64_t cross = (int64_t)(p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (int64_t)(p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
    table->bends_left = cross <= 0;
    table->policy = policy;
    table->row = most(p[0][1], first_row);
    table->last_row = p[2][1];
    side_start(&table->side[SIDE_12], p[0], p[1], least(table->row, p[1][1]));
    side_start(&table->side[SIDE_23], p[1], p[2], most(table->row, p[1][1]));
    side_start(&table->side[SIDE_13], p[0], p[2], table->row);
    return true;
}

void edge_table_next(edge_table_t *table, int32_t *first, int32_t *last) {
    const edge_policy_t policy = table->policy;
    const edge_side_t *a = &table->side[SIDE_12], *c = &table->side[SIDE_13];
    if (policy != EDGE_DOCUMENT && c->y0 == c->y1) {
        *first = least(least(a->x0, a->x1), c->x1);
        *last = most(most(a->x0, a->x1), c->x1);
    } else {
        const int32_t bent = bent_pick(table), straight = side_pick(c, table->row, policy, !table->bends_left);
        const int32_t left = table->bends_left ? bent : straight, right = table->bends_left ? straight : bent;
        const bool crossed = left > right && policy != EDGE_DOCUMENT && policy != EDGE_INNER;
        *first = crossed ? right : left;
        *last = crossed ? left : right;
    }
    for (int i = 0; i < 3; i++) {
        edge_side_t *side = &table->side[i];
        if (side->y0 <= table->row && table->row < side->y1) { side_step(side); }
    }
    table->row++;
}

void edge_table_fill(const raster_tile_t *tile, const int32_t corners[3][2], edge_policy_t policy, uint32_t value,
                     unsigned pixel_bytes) {
    edge_table_t table;
    if (!edge_table_start(&table, corners, policy, tile->top)) { return; }
    const int32_t end = least(table.last_row + 1, tile->bottom);
    while (table.row < end) {
        const int32_t at = (table.row - tile->top) * tile->stride_px - tile->left;
        int32_t first, last;
        edge_table_next(&table, &first, &last);
        first = most(first, tile->left);
        last = least(last, tile->right - 1);
        if (pixel_bytes == 4) {
            for (int32_t x = first; x <= last; x++) {
                ((uint32_t *)tile->colour)[at + x] = value;
            }
        } else {
            for (int32_t x = first; x <= last; x++) {
                ((uint16_t *)tile->colour)[at + x] = (uint16_t)value;
            }
        }
    }
}
