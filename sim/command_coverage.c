/* tuile coverage: the pixels that polygons cover, by the edge stepper that draws frames. */
#include "../raster/fill/polygon.h"
#include "commands.h"
#include "coverage_text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "Usage: tuile coverage W H < FILE\n"
    "\n"
    "Each line of FILE is a polygon, x0 y0 x1 y1 x2 y2 ... in 1/16 pixel (whole numbers, at most 32767 * 16 either way; y down,\n"
    "pixels sampled at their centres, even-odd). Prints `polygon K` and then `y x0 x1` for each run of covered pixels in the W x "
    "H\n"
    "window, x1 included.\n";

static void print_span(void *context, int32_t row, int32_t first, int32_t end) {
    (void)context;
    (void)printf("%d %d %d\n", row, first, end - 1);
}

int command_coverage(int count, char **arguments) {
    long size[2];
    if (count == 1 && strcmp(arguments[0], "--help") == 0) {
        (void)fputs(usage, stdout);
        return command_finish();
    }
    if (count != 2) {
        (void)fputs(usage, stderr);
        return EXIT_USAGE;
    }
    for (int i = 0; i < 2; i++) {
        char *end;
        errno = 0;
        size[i] = strtol(arguments[i], &end, 10);
        if (end == arguments[i] || *end != '\0' || errno != 0 || size[i] < 1 || size[i] > 32767) {
            (void)command_fail("coverage: %s is no %s; 1 to 32767 pixels", arguments[i], i ? "height" : "width");
            return EXIT_USAGE;
        }
    }
    coverage_text_t text;
    sim_error_t error = {""};
    polygon_chain_t chains[POLYGON_CHAINS];
    int result;
    coverage_text_open(&text, stdin, "standard input");
    while ((result = coverage_text_next(&text, &error)) == 1) {
        const polygon_ring_t ring = {NULL, NULL, (const q28_4_t(*)[2])text.points, (uint32_t)text.count};
        (void)printf("polygon %lu\n", text.polygon);
        polygon_coverage(&ring, (int32_t)size[0], (int32_t)size[1], chains, POLYGON_CHAINS, print_span, NULL);
    }
    coverage_text_close(&text);
    if (result < 0) { return command_fail("%s", error.text); }
    return command_finish();
}
