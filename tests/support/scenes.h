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
void test_scene_close(test_scene_t *scene);

/* Index of the poly seen at each pixel + 1, 0 = background. config may be NULL; its window, format and tie are set here. stats may
 * be NULL. The result is malloc'ed. */
uint32_t *test_scene_ids(const test_scene_t *scene, const tuile_config_t *config, size_t memory_bytes, tuile_stats_t *stats);

/* The same with the tiles drawn one by one: way 0 backwards, 1 by columns, 2 in random order. */
uint32_t *test_scene_ids_in_order(const test_scene_t *scene, const tuile_config_t *config, size_t memory_bytes, unsigned way,
                                  uint64_t *random);

/* The least block for the configuration. */
size_t test_scene_least(const test_scene_t *scene, const tuile_config_t *config);

#endif
