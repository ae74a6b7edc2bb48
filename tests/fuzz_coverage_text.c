/* Any bytes as polygons for `tuile coverage`; each polygon that is taken goes to the exact reference. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../sim/coverage_text.h"
#include "reference/coverage_reference.h"
#include "reference/fuzz_driver.h"
#include "reference/scene_generator.h"

static void require(bool condition, const char *what) {
    if (!condition) {
        (void)fprintf(stderr, "fuzz_coverage_text: %s\n", what);
        abort();
    }
}

static void look(const coverage_text_t *text) {
    enum { SIZE = 16 };
    reference_spans_t spans = {0};
    const int32_t(*points)[2] = (const int32_t(*)[2])text->points;
    require(coverage_reference(&spans, points, text->count, SIZE, SIZE) == 0, "out of memory");
    bool drawn[SIZE][SIZE] = {{false}};
    for (size_t i = 0; i < spans.count; i++) {
        const reference_span_t *span = &spans.items[i];
        require(span->y >= 0 && span->y < SIZE && span->x0 >= 0 && span->x0 <= span->x1 && span->x1 < SIZE,
                "a span out of the window");
        for (int x = span->x0; x <= span->x1; x++) {
            require(!drawn[span->y][x], "a pixel in two spans");
            drawn[span->y][x] = true;
        }
    }
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            require(drawn[y][x] == coverage_reference_pixel(points, text->count, x, y), "the two references differ");
        }
    }
    coverage_reference_free(&spans);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    FILE *file = tmpfile();
    if (!file) { return 0; }
    if (size) { (void)fwrite(bytes, 1, size, file); }
    rewind(file);
    coverage_text_t text;
    sim_error_t error = {""};
    coverage_text_open(&text, file, "fuzz");
    int result;
    while ((result = coverage_text_next(&text, &error)) == 1) {
        require(text.count >= 3, "fewer than three vertices");
        for (size_t i = 0; i < text.count; i++) {
            for (int c = 0; c < 2; c++) {
                require(abs(text.points[i][c]) <= COVERAGE_TEXT_COORDINATE_MAX, "a coordinate out of range");
            }
        }
        look(&text);
    }
    require(result == 0 || error.text[0], "refused without a word");
    coverage_text_close(&text);
    (void)fclose(file);
    return 0;
}

#ifdef FUZZ_DRIVER
static char *seed(uint64_t n) {
    enum { ROOM = 512 };
    uint64_t state = n + 1;
    char *text = calloc(1, ROOM);
    for (int i = 0; text && i < 24; i++) {
        (void)snprintf(text + strlen(text), ROOM - strlen(text), "%d%c", scene_generator_between(&state, -40, 300),
                       i % 8 == 7 ? '\n' : ' ');
    }
    return text;
}

int main(int argc, char **argv) { return fuzz_drive(argc, argv, seed); }
#endif
