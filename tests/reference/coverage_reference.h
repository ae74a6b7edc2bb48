/* Which pixels a polygon covers, by exact integer arithmetic and by nothing else: no stepping, no clipping, no shared code.
 *
 * Vertices are whole numbers of 1/16 pixel, y down; pixel (i, j) is sampled at (16 i + 8, 16 j + 8). Even-odd. Points on left and
 * top edges are in, points on right and bottom edges are out: an edge from y0 up to y1 > y0 meets the row at yc when y0 <= yc < y1,
 * and counts for the samples at or right of where it meets it. */
#ifndef TESTS_REFERENCE_COVERAGE_REFERENCE_H
#define TESTS_REFERENCE_COVERAGE_REFERENCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct reference_span {
    int32_t y, x0, x1; /* pixels; x1 inclusive, x0 <= x1 */
} reference_span_t;

/* Start from all zero; reuse from polygon to polygon; release with coverage_reference_free. */
typedef struct reference_spans {
    reference_span_t *items;
    size_t count, capacity;
    void *scratch;
    size_t scratch_bytes;
} reference_spans_t;

/* The spans of a polygon in a window of width x height pixels (0 ... 2^20 each), top to bottom, left to right, cut to the window.
 * One span for each pair of crossings that has a pixel between them: touching spans are not merged. |coordinate| < 2^28, any count
 * of vertices (fewer than three cover nothing). Returns 0, or -1 when out of memory. */
int coverage_reference(reference_spans_t *spans, const int32_t (*points)[2], size_t count, int32_t width, int32_t height);

/* Joins spans that touch ([3, 9] and [10, 18]), for comparing pixels rather than pairs. */
void coverage_reference_merge(reference_spans_t *spans);

/* The same question for one pixel, answered in another way: the parity of the edges at or left of its centre. */
bool coverage_reference_pixel(const int32_t (*points)[2], size_t count, int32_t x, int32_t y);

void coverage_reference_free(reference_spans_t *spans);

#endif
