/* Random text scenes for property tests: the same seed and options give the same text, so a scene that fails can be printed, cut
 * down by hand and replayed. */
#ifndef TESTS_REFERENCE_SCENE_GENERATOR_H
#define TESTS_REFERENCE_SCENE_GENERATOR_H

#include <stdbool.h>
#include <stdint.h>

#define SCENE_GENERATOR_SIZE_MAX 256

/* Zero = default. */
typedef struct scene_generator {
    bool no_perspective, no_orthographic; /* not both */
    bool no_coplanar;                     /* no two faces in one plane (on purpose) */
    bool no_near_cut;                     /* perspective: every face wholly in front of the near plane */
    bool convex;                          /* convex faces only */
    bool simple;                          /* no face crosses itself */
    int width, height;                    /* pixels, up to SCENE_GENERATOR_SIZE_MAX; 0 = chosen at random, 1 ... 48 */
    int faces;                            /* 0 = chosen at random, 1 ... 12 */
} scene_generator_t;

/* A scene that scene_text_parse takes: planar polygons with whole coordinates within +-4000, crossing, nested, in one plane,
 * edge-on, partly outside the window, convex or stars, combs, L shapes, frames and polygons that cross themselves; in perspective
 * also across the near plane and behind the eye. Returns a string to be released with free, or NULL when out of memory. options may
 * be NULL. */
char *scene_generate(uint64_t seed, const scene_generator_t *options);

/* The generator's pseudo-random numbers, for tests that need more of them: uniform in low ... high, both included. */
int32_t scene_generator_between(uint64_t *state, int32_t low, int32_t high);

#endif
