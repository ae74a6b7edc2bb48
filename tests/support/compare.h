/* One picture by every method, through any tiles and in any memory. */
#ifndef TESTS_SUPPORT_COMPARE_H
#define TESTS_SUPPORT_COMPARE_H

#include <stddef.h>
#include <stdint.h>

#include "../../raster/tuile.h"

/* Draws the scene in all these ways beside expected[0], or, by the tree, expected[1]: it decides ties otherwise than depth does.
 * more_bytes: what the scene needs beyond the least block. Fails the test on any other picture. */
void compare_all_ways(const tuile_scene_t *scene, const tuile_config_t *config, uint8_t *const expected[2], size_t more_bytes,
                      const char *name);

/* The two that are expected, by the z-buffer and by the tree in plenty of memory, to be released with free. */
void compare_expected(const tuile_scene_t *scene, const tuile_config_t *config, uint8_t *expected[2]);

#endif
