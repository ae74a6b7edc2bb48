#include "coverage_reference.h"

#include <stdlib.h>

__extension__ typedef __int128 int128_t;

/* Where an edge meets a row: numerator / denominator in 1/16 pixel, denominator > 0. |numerator| < 2^60 for |coordinate| < 2^28. */
typedef struct crossing {
    int64_t numerator, denominator;
} crossing_t;

static bool is_left_of(crossing_t a, crossing_t b) {
    return (int128_t)a.numerator * b.denominator < (int128_t)b.numerator * a.denominator;
}

/* Does the edge from a to b, either way up, meet the row? */
static bool meets_row(const int32_t a[2], const int32_t b[2], int64_t row_y, crossing_t *crossing) {
    const int32_t *top = a[1] < b[1] ? a : b, *bottom = a[1] < b[1] ? b : a;
    if (!(top[1] <= row_y && row_y < bottom[1])) { return false; }
    int64_t dx = (int64_t)bottom[0] - top[0], dy = (int64_t)bottom[1] - top[1];
    crossing->numerator = top[0] * dy + dx * (row_y - top[1]);
    crossing->denominator = dy;
    return true;
}

/* The first pixel whose centre is at or right of the crossing: the least i with (16 i + 8) d >= n. */
static int64_t first_pixel(crossing_t crossing) {
    int64_t n = crossing.numerator - 8 * crossing.denominator, d = 16 * crossing.denominator;
    int64_t quotient = n / d;
    return quotient + (n % d > 0);
}

static bool reserve(void **memory, size_t *capacity, size_t wanted, size_t item_bytes) {
    if (wanted <= *capacity) { return true; }
    size_t more = wanted > *capacity * 2 ? wanted : *capacity * 2;
    if (more > SIZE_MAX / item_bytes) { return false; }
    void *grown = realloc(*memory, more * item_bytes);
    if (!grown) { return false; }
    *memory = grown;
    *capacity = more;
    return true;
}

static bool append(reference_spans_t *spans, int32_t y, int64_t x0, int64_t x1) {
    void *items = spans->items;
    bool room = reserve(&items, &spans->capacity, spans->count + 1, sizeof *spans->items);
    spans->items = items;
    if (room) { spans->items[spans->count++] = (reference_span_t){y, (int32_t)x0, (int32_t)x1}; }
    return room;
}

int coverage_reference(reference_spans_t *spans, const int32_t (*points)[2], size_t count, int32_t width, int32_t height) {
    spans->count = 0;
    if (count > SIZE_MAX / sizeof(crossing_t) / 2 ||
        !reserve(&spans->scratch, &spans->scratch_bytes, count * sizeof(crossing_t), 1)) {
        return -1;
    }
    crossing_t *crossings = spans->scratch;
    int64_t top = INT64_MAX, bottom = INT64_MIN;
    for (size_t i = 0; i < count; i++) {
        top = points[i][1] < top ? points[i][1] : top;
        bottom = points[i][1] > bottom ? points[i][1] : bottom;
    }
    for (int32_t y = 0; y < height; y++) {
        int64_t row_y = 16 * (int64_t)y + 8;
        if (row_y < top) { continue; }
        if (row_y >= bottom) { break; }
        size_t found = 0;
        for (size_t i = 0; i < count; i++) {
            crossing_t crossing;
            if (!meets_row(points[i], points[(i + 1) % count], row_y, &crossing)) { continue; }
            size_t at = found++;
            for (; at > 0 && is_left_of(crossing, crossings[at - 1]); at--) {
                crossings[at] = crossings[at - 1];
            }
            crossings[at] = crossing;
        }
        for (size_t i = 0; i + 1 < found; i += 2) {
            int64_t x0 = first_pixel(crossings[i]), x1 = first_pixel(crossings[i + 1]) - 1;
            x0 = x0 < 0 ? 0 : x0;
            x1 = x1 >= width ? (int64_t)width - 1 : x1;
            if (x0 <= x1 && !append(spans, y, x0, x1)) { return -1; }
        }
    }
    return 0;
}

void coverage_reference_merge(reference_spans_t *spans) {
    size_t kept = 0;
    for (size_t i = 0; i < spans->count; i++) {
        reference_span_t span = spans->items[i];
        if (kept && spans->items[kept - 1].y == span.y && spans->items[kept - 1].x1 + 1 == span.x0) {
            spans->items[kept - 1].x1 = span.x1;
        } else {
            spans->items[kept++] = span;
        }
    }
    spans->count = kept;
}

bool coverage_reference_pixel(const int32_t (*points)[2], size_t count, int32_t x, int32_t y) {
    int64_t centre_x = 16 * (int64_t)x + 8, centre_y = 16 * (int64_t)y + 8;
    bool inside = false;
    for (size_t i = 0; i < count; i++) {
        crossing_t crossing;
        if (meets_row(points[i], points[(i + 1) % count], centre_y, &crossing) &&
            crossing.numerator <= (int128_t)centre_x * crossing.denominator) {
            inside = !inside;
        }
    }
    return inside;
}

void coverage_reference_free(reference_spans_t *spans) {
    free(spans->items);
    free(spans->scratch);
    *spans = (reference_spans_t){0};
}
