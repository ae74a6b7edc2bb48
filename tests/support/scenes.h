/* Text scenes drawn by the renderer into an array of face ids. */
#ifndef TESTS_SUPPORT_SCENES_H
#define TESTS_SUPPORT_SCENES_H

#include "../../raster/tuile.h"
#include "../../sim/scene_text.h"

#define TEST_NOT_DRAWN UINT32_MAX /* pixels of tiles that the configuration leaves to others */

typedef struct test_scene {
    scene_text_t text;
    mesh_t mesh;
    uint8_t *bytes;
    tuile_model_t model;
    tuile_instance_t instance;
    scene_view_t view;
    tuile_scene_t scene; /* points into this struct */
} test_scene_t;

/* Parses and compiles; fails the test when that does not work. */
void test_scene_open(test_scene_t *scene, const char *text);
/* The same with a display tree. */
void test_scene_open_tree(test_scene_t *scene, const char *text);
void test_scene_close(test_scene_t *scene);

/* Index of the poly seen at each pixel + 1, 0 = background. config may be NULL; its window, format and tie are set here. stats may
 * be NULL. The result is malloc'ed. */
uint32_t *test_scene_ids(const test_scene_t *scene, const tuile_config_t *config, size_t memory_bytes, tuile_stats_t *stats);

/* The same with the tiles drawn one by one: way 0 backwards, 1 by columns, 2 in random order. */
uint32_t *test_scene_ids_in_order(const test_scene_t *scene, const tuile_config_t *config, size_t memory_bytes, unsigned way,
                                  uint64_t *random);

/* Compares every pixel with the exact reference (tests/reference/visibility_reference.h): how many show a face that cannot be seen
 * there, whatever is done to edges within 1/16 pixel and to depths within a step. Prints the first of them. */
unsigned test_scene_wrong_pixels(const test_scene_t *scene, const char *text, const uint32_t *ids);

/* The least block for the configuration. */
size_t test_scene_least(const test_scene_t *scene, const tuile_config_t *config);

#endif
